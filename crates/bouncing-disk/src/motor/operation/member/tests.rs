use bouncing_disk_core::run::Watch;
use bouncing_disk_core::{ChatterPolicy, Unobserved};

use super::*;
use crate::driven::{DrivenEngine, DrivenStart, DrivenSystem};
use crate::motion::engine::Engine;
use crate::motion::event::Event;
use crate::motion::initial_condition::InitialCondition;
use crate::motion::phase_time::{PhaseSpan, PhaseTime};
use crate::motor::tape::taped::sampled_at;
use crate::testing::motor;
use crate::{Motor, System};

fn member(systems: &[DimensionlessSystem], stators: &[Stator], index: usize) -> (Taped, OperatingSettings) {
    let settings = OperatingSettings { members: 5, seed: 9, ..OperatingSettings::default() };
    let quicker = vec![1.0; systems.len()];
    match Member::new(systems, stators, 0, index, &quicker, None, &settings).expect("legal") {
        Member::Taped(member) => (*member, settings),
        Member::Coupled(_) => panic!("nothing acts back"),
    }
}

/// The engine of each rotor alone, perturbed by the same stream, has impacts at the same times. Its speed
/// agrees within the error due to the steps of a rest.
#[test]
fn a_rotor_on_a_tape_of_rigid_impacts_is_that_of_its_engine() {
    for amplitude in [1e-8, 2e-9, 6e-11] {
        let systems: Vec<System> = (0..11_u32)
            .map(|k| {
                motor(amplitude, 3.0 * f64::from(k) - 9.0)
                    .with_disk(|rotor| rotor.friction *= 0.2 + 0.3 * f64::from(k))
                    .expect("legal")
            })
            .collect();
        let systems: Vec<DimensionlessSystem> =
            systems.iter().map(|system| *system.dimensionless()).collect();
        let (mut member, settings) = member(&systems, &vec![Stator::Sine; systems.len()], 0);
        let watch = Watch::begin(&Unobserved, 0, 1).expect("goes on");
        let mut sampled = Vec::new();
        for window in 0..3 {
            let begins = member.time();
            let found = member.next_window(300.0, &(40..=1_000_000), &mut watch.work()).expect("no failure");
            for (sample, after) in sampled_at(window, 300.0).into_iter().enumerate() {
                let speeds =
                    found.rotors.iter().map(|rotor| rotor.speeds.samples().nth(sample).expect("noted"));
                sampled.push((begins.after(PhaseSpan::from_radians(after)), speeds.collect::<Vec<f64>>()));
            }
        }
        for (rotor, system) in systems.iter().enumerate() {
            let phase = starting_phase(settings.seed, 0, 5).expect("finite");
            let start = InitialCondition::Contact { phase, angular_speed: 0.0 };
            let mut engine = Engine::new(*system, start, ChatterPolicy::Complete).expect("legal");
            let mut generator = SplitMix64::new(SplitMix64::seed_of_stream(settings.seed, 0));
            let size = system.twist_speed();
            let mut samples = sampled.iter().peekable();
            while engine.time().order(&member.time()).is_lt() {
                let begins = engine.time();
                let record = engine.advance().expect("no failure").expect("it goes on");
                while let Some((at, speeds)) = samples.next_if(|(at, _)| at.order(&engine.time()).is_lt()) {
                    let share = at.since(&begins).radians() / record.span.radians();
                    let (own, known) = (speeds[rotor], record.evaluate(system, share).disk.angular_speed);
                    // The linear approximation over a step of a rest is off by an eighth of its square.
                    assert!(
                        (own - known).abs() < 5e-4 * size,
                        "{amplitude} {rotor}: {own} {known} of {size}"
                    );
                }
                if record.event == Event::Separation {
                    let speed = settings.relaunch_perturbation * generator.unit();
                    engine.perturb_launch(speed).expect("legal");
                }
            }
            assert_eq!(engine.time(), member.time());
            let (own, known) = (member.speeds()[rotor], engine.state().angular_speed);
            assert!((own - known).abs() < 2e-5 * size, "{amplitude} {rotor}: {own} {known} of {size}");
        }
    }
}

/// The same for compliant contacts and waveforms, but only over a few flights, because chaos amplifies the
/// rounding differences of the two motions.
#[test]
fn a_rotor_on_any_tape_is_that_of_its_engine() {
    let sheet = Motor::paper_70_khz().with(|sheet| sheet.friction = 1.0).expect("legal");
    let waves = |sheet: &Motor| {
        use crate::parameters::driven_platform::Waveform;
        let height = Waveform::Fourier(vec![(1.0, 0.0), (0.2, 0.4)]);
        let angle = Waveform::Fourier(vec![(1.0, 0.3), (0.1, 0.0)]);
        sheet.with(|sheet| (sheet.drive.height, sheet.drive.angle) = (height, angle)).expect("legal")
    };
    let touching = |sheet: &Motor, periods: f64| {
        let contact = crate::parameters::contact::Contact::lasting(periods / 70e3);
        sheet.with(|sheet| sheet.contact = Some(contact)).expect("legal")
    };
    let soft = [0.1, 0.5, 1.0, 5.0].map(|periods| touching(&sheet, periods));
    let others = [waves(&sheet), touching(&waves(&sheet), 2.0)];
    for motor in soft.into_iter().chain(others) {
        let Some(system) = motor.stator_motion().driven() else { panic!("by waveforms, or soft") };
        let still = *motor.system().dimensionless();
        let (mut member, _) = member(&[still], &[motor.stator_motion().clone()], 0);
        let watch = Watch::begin(&Unobserved, 0, 1).expect("goes on");
        member.next_window(1.0, &(6..=6), &mut watch.work()).expect("no failure");
        let phase = starting_phase(9, 0, 5).expect("finite");
        let start = DrivenStart::Contact { phase, angular_speed: 0.0 };
        let mut engine: DrivenEngine =
            Engine::new(DrivenSystem::clone(system), start, ChatterPolicy::Complete).expect("legal");
        let close = |engine: &DrivenEngine, time: PhaseTime| time.since(&engine.time()).radians() < 1e-9;
        while engine.time().order(&member.time()).is_lt() && !close(&engine, member.time()) {
            engine.advance().expect("no failure").expect("it goes on");
        }
        let (own, known) = (member.speeds()[0], engine.state().angular_speed);
        let turned = system.friction * member.time().since(&PhaseTime::in_first_period(phase)).radians();
        assert!((own - known).abs() < 2e-3 * turned, "{motor:?}: {own} {known} of {turned}");
    }
}
