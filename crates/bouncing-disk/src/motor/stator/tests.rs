//! Motors on all kinds of stators, compared with each other and with known results.

use bouncing_disk_core::numerics::elementary::hypot;
use bouncing_disk_core::numerics::statistics::NORMAL_975;
use bouncing_disk_core::{Phase, Unobserved};

use super::*;
use crate::Motor;
use crate::driven::DrivenStart;
use crate::motor::operation::steady_run::operate_for;
use crate::motor::{
    AxialMotion, Estimate, MotorParameters, OperatingRow, OperatingSettings, Operation, SensitivityParameter,
    SensitivityQuantity, SensitivitySettings, Shortfall, TransientSettings,
};
use crate::parameters::contact::Contact;
use crate::parameters::driven_platform::Waveform;
use crate::parameters::stator::StatorParameters;
use crate::stator::StatorEngine;

fn settings() -> OperatingSettings {
    OperatingSettings { relative_error: 0.04, members: 4, ..OperatingSettings::default() }
}

/// The motor with a stator that moves by these waveforms.
fn moved(motor: &Motor, height: Waveform, angle: Waveform) -> Motor {
    motor.with(|sheet| (sheet.drive.height, sheet.drive.angle) = (height, angle)).expect("legal")
}

/// The motor with its sine as a sum of one harmonic, which is computed like any waveform.
fn as_a_sum(motor: &Motor) -> Motor {
    moved(motor, Waveform::Fourier(vec![(1.0, 0.0)]), Waveform::Sine)
}

/// The motor with contacts of this duration (s).
fn touching(motor: &Motor, time: f64) -> Motor {
    motor.with(|sheet| sheet.contact = Some(Contact::lasting(time))).expect("legal")
}

/// One motor on both engines. The orbits are chaotic, so only the means agree, not the impacts.
#[test]
fn a_sine_as_a_waveform_turns_the_motor_as_the_sine_does() {
    let motor = Motor::paper_70_khz();
    let driven = as_a_sum(&motor);
    let loads = [0.0, 0.4 * motor.largest_torque(), 1.5 * motor.largest_torque()];
    let curve = driven.torque_speed_curve(&loads, &settings(), &Unobserved).expect("no failure");
    let known = motor.torque_speed_curve(&loads, &settings(), &Unobserved).expect("no failure");
    for (own, known) in curve.iter().zip(&known).take(2) {
        let (own, known) = (own.steady().expect("known"), known.steady().expect("known"));
        assert!(own.energy_residual < 1e-9, "{own:?}");
        let near = |one: Estimate, other: Estimate| {
            let error = one.standard_error + other.standard_error;
            assert!((one.value - other.value).abs() < 3.0 * error, "{one:?} {other:?}");
        };
        near(own.speed, known.speed);
        near(own.input_power, known.input_power);
        near(own.friction_loss, known.friction_loss);
        near(own.restitution_loss, known.restitution_loss);
    }
    assert_eq!(curve[2], known[2], "a runaway");
    let strong = motor.with(|sheet| sheet.amplitude = Some(1e-7)).expect("legal");
    let driven = as_a_sum(&strong);
    let settings = TransientSettings {
        duration: 0.02,
        intervals: 4,
        relaunch_perturbation: 0.0,
        ..TransientSettings::default()
    };
    for phase in [0.3, 0.69, 1.08, 3.0, 5.0] {
        let phase = Phase::new(phase).expect("finite");
        let own = driven.transient(phase, &settings, &Unobserved).expect("no failure");
        let sine = crate::motor::transient(strong.system(), phase, &settings, &Unobserved);
        let sine = sine.expect("no failure");
        // Flights of hundreds of periods round the phase by 1e-13 rad. Each of the few impacts that follow
        // multiplies this by about a hundred, because its speed determines another long flight.
        let near = |(own, sine): (&f64, &f64)| (own - sine).abs() <= 1e-8 * sine.abs();
        assert!(own.speeds.iter().zip(&sine.speeds).all(near), "{own:?} {sine:?}");
    }
}

/// A stator that moves as a sawtooth, whose kinks end each rest by a kick, never by a separation.
fn sawing(amplitude: f64) -> Motor {
    let sheet = Motor::paper_70_khz().with(|sheet| sheet.amplitude = Some(amplitude)).expect("legal");
    let shape = Waveform::Sawtooth(0.7);
    moved(&sheet, shape.clone(), shape)
}

/// The seed of the perturbations matters only if there are any.
#[test]
fn relaunches_by_kicks_are_perturbed_as_separations_are() {
    let run = |relaunch_perturbation: f64, seed: u64| {
        let settings = TransientSettings {
            duration: 0.02,
            intervals: 4,
            relaunch_perturbation,
            seed,
            ..TransientSettings::default()
        };
        // It starts on the falling line.
        let phase = Phase::new(std::f64::consts::PI).expect("finite");
        sawing(3e-10).transient(phase, &settings, &Unobserved).expect("no failure")
    };
    let calm = run(0.0, 1);
    assert_eq!((calm.separations, run(0.0, 2).speeds), (0, calm.speeds.clone()));
    let known = run(1e-3, 1);
    assert!(known.speeds != calm.speeds && run(1e-3, 2).speeds != known.speeds, "{known:?}");
}

/// Amplitudes that differ by a billionth lead to the same speed within the stated errors, whatever cycle
/// rounding would select.
#[test]
fn a_stator_with_kinks_does_not_lock_the_motor_on_a_rounded_cycle() {
    let points = [0.0, 1.0, 2.0, 3.0].map(|k| {
        let motor = sawing(3e-10 * (1.0 + 1e-9 * k));
        let curve = motor.torque_speed_curve(&[0.0], &settings(), &Unobserved).expect("no failure");
        *curve[0].steady().expect("known")
    });
    for (own, known) in points.iter().flat_map(|own| points.iter().map(move |known| (own, known))) {
        let error = own.speed.standard_error + known.speed.standard_error;
        assert!((own.speed.value - known.speed.value).abs() <= 3.0 * error, "{own:?} {known:?}");
    }
    assert!(points.iter().all(|point| point.perturbation_power > 0.0), "{points:?}");
}

/// A triangle at 1 nm kicks the rotor once, and then keeps it in flights of constant phase, so each start
/// leads to its own speed.
#[test]
fn a_neutral_family_of_motions_is_said_to_depend_on_the_start() {
    let sheet = Motor::paper_70_khz().with(|sheet| sheet.amplitude = Some(1e-9)).expect("legal");
    let motor = moved(&sheet, Waveform::Triangle, Waveform::Sine);
    let few = OperatingSettings { most_impacts: 200_000, ..settings() };
    let curve = motor.torque_speed_curve(&[0.0], &few, &Unobserved).expect("no failure");
    let Operation::Unsettled(point, Shortfall::Start { spread, .. }) = curve[0].operation() else {
        panic!("{:?}", curve[0])
    };
    // The 95 % interval covers the speed from each start, and so the speed of a motor started once.
    assert!(*spread > 1.0, "{point:?} {spread}");
    for seed in 1..4 {
        let settings =
            TransientSettings { duration: 1.0, intervals: 10, seed, ..TransientSettings::default() };
        let curve = motor.transient(Phase::new(0.3).expect("finite"), &settings, &Unobserved);
        let speed = curve.expect("no failure").speeds[9];
        let off = (speed - point.speed.value).abs();
        assert!(off < 1.96 * point.speed.standard_error, "{speed} {point:?}");
    }
}

/// A short contact leads to the speed for rigid impacts. A contact of one period taps the rotor in every
/// period at the crest, so that the lag of its predecessors is better than the paper's.
#[test]
fn the_contact_time_decides_on_the_best_lag() {
    let period = 1.0 / 70e3;
    let speed = |lag: f64, share: f64| {
        let motor = Motor::paper_70_khz().with(|sheet| sheet.phase_lag = lag).expect("legal");
        let motor = if share > 0.0 { touching(&motor, share * period) } else { as_a_sum(&motor) };
        let settings = TransientSettings { duration: 0.4, intervals: 4, ..TransientSettings::default() };
        let curve = motor.transient(Phase::new(0.3).expect("finite"), &settings, &Unobserved);
        curve.expect("no failure").speeds[3]
    };
    let crest = -std::f64::consts::FRAC_PI_2;
    assert!(speed(crest, 1.0) > 1.2 * speed(0.0, 1.0));
    assert!(speed(crest, 0.05) < 0.3 * speed(0.0, 0.05));
    let motor = as_a_sum(&Motor::paper_70_khz());
    let known = &motor.torque_speed_curve(&[0.0], &settings(), &Unobserved).expect("no failure")[0];
    let short = touching(&Motor::paper_70_khz(), 0.02 * period);
    let own = &short.torque_speed_curve(&[0.0], &settings(), &Unobserved).expect("no failure")[0];
    let steady = |row: &OperatingRow| *row.steady().unwrap_or_else(|| panic!("{row:?}"));
    let (own, known) = (steady(own), steady(known));
    let error = own.speed.standard_error + known.speed.standard_error;
    assert!((own.speed.value - known.speed.value).abs() < 3.0 * error, "{own:?} {known:?}");
    assert!(own.energy_residual < 1e-9, "{own:?}");
}

/// Without amplitude the stator turns the rotor forwards as much as backwards: its speed is exactly zero, not
/// a rounding error.
#[test]
fn a_stator_that_only_turns_leaves_the_rotor_at_rest() {
    let motor = Motor::paper_70_khz().with(|sheet| sheet.amplitude = Some(0.0)).expect("legal");
    for motor in [motor.clone(), touching(&motor, 7e-6)] {
        let row = motor.operating_point(0.0, &settings(), &Unobserved).expect("no failure");
        let speed = row.steady().expect("settled").speed;
        assert!(speed.value == 0.0 && speed.standard_error < 1e-9, "{row:?}");
        assert_eq!(row.starts(), Some(false));
        assert!(motor.stall_load(&settings(), &Unobserved).is_err());
    }
}

/// The inertia of a slow rotor is reduced if the tape takes long to record. At its own inertia the rotor has
/// the same speed within the errors, which include the bias. The time constants are 10,000 to 60,000 periods.
#[test]
fn slow_rotors_turn_as_fast_at_their_own_inertia() {
    let mut within = 0;
    for k in 0..10_u32 {
        let share = f64::from(k) / 10.0;
        let motor = Motor::paper_70_khz().with(|sheet| {
            (sheet.drive_frequency, sheet.amplitude) = (40e3, Some(0.3e-6 + 0.4e-6 * share));
            (sheet.peak_angular_speed, sheet.twist_amplitude) = (Some(12.0), None);
            (sheet.mass, sheet.density, sheet.rotor_radius) = (Some(0.020), None, None);
            (sheet.contact_radius, sheet.gyration_radius) = (12.5e-3, Some(80e-3 + 100e-3 * share));
            (sheet.preload_force, sheet.preload_acceleration) = (Some(5.0 - 2.0 * share), None);
            (sheet.restitution, sheet.phase_lag) = (0.3 + 0.3 * share, 1.5 * share - 0.5);
            sheet.contact = Some(Contact::lasting((2.0 + 6.0 * (3.0 * share).fract()) * 1e-6));
        });
        let motor = motor.expect("legal");
        let load = 0.5 * (2.0 * share).fract() * motor.largest_torque();
        let loaded = motor.loaded().and_then(|motor| motor.with_load(load)).expect("legal");
        let settings = OperatingSettings::default();
        let run = |length| {
            let found = operate_for(length, &[loaded], &settings, &Unobserved).expect("no failure");
            let point = *found.rows[0].point().expect("no runaway");
            assert!(matches!(point.motion, AxialMotion::Irregular { .. }), "{k} {point:?}");
            point.speed
        };
        let (own, quick) = (run(Some((1.0, 1e9))), run(None));
        let error = hypot(own.standard_error, quick.standard_error);
        within += u32::from((own.value - quick.value).abs() <= NORMAL_975 * error);
    }
    assert!(within >= 9, "{within} of 10");
}

/// Taps in closed form lead to the same run-up as the engine, which is used as soon as the angle has a second
/// harmonic, however small.
#[test]
fn run_ups_by_taps_are_those_of_the_engine() {
    let speeds = |angle: Waveform, lag: f64| {
        let motor = Motor::paper_70_khz().with(|sheet| sheet.phase_lag = lag).expect("legal");
        let motor = touching(&moved(&motor, Waveform::Sine, angle), 1.0 / 70e3);
        let settings = TransientSettings { duration: 0.06, intervals: 12, ..TransientSettings::default() };
        motor.transient(Phase::new(0.3).expect("finite"), &settings, &Unobserved).expect("no failure").speeds
    };
    for lag in [0.0, -1.2] {
        let own = speeds(Waveform::Sine, lag);
        let engine = speeds(Waveform::Fourier(vec![(1.0, 0.0), (1e-300, 0.0)]), lag);
        for (own, engine) in own.iter().zip(&engine) {
            // A tap lasts a thousandth of an interval, within which its angle is assumed to grow uniformly.
            assert!((own - engine).abs() < 1e-4 * engine, "{lag}: {own} {engine}");
        }
    }
}

/// The no-load speed and the stall load are those of the motor without the law.
#[test]
fn a_speed_without_load_is_without_the_law_of_the_load() {
    let paper = Motor::paper_70_khz();
    let speed = |load: Option<LoadLaw>| {
        let motor = paper.with(|sheet| sheet.load = load).expect("legal");
        motor.no_load_speed(&settings()).expect("known")
    };
    let fan = LoadLaw::fan(10.0, 2e-5, 4).expect("legal");
    let (own, known) = (speed(Some(fan)), speed(LoadLaw::constant(0.0).ok()));
    assert_eq!(own, known);
}

#[test]
fn calls_of_the_sine_say_what_a_sheet_has_instead() {
    let paper = Motor::paper_70_khz();
    let (soft, stiff) = (touching(&paper, 1e-5), touching(&paper, 1e-12));
    assert_eq!(soft.nearest_trap(0.1, &Unobserved), Err(Error::SoftContact));
    assert_eq!(soft.trap_verdict().map(|_| ()), Err(Error::SoftContact));
    let all = SensitivitySettings::default();
    let sensitivities = |motor: &Motor, quantity| {
        motor.local_sensitivities(quantity, &[SensitivityParameter::Amplitude], &all, &Unobserved).map(|_| ())
    };
    for quantity in [SensitivityQuantity::SteadySpeed, SensitivityQuantity::StallTorque] {
        assert_eq!(sensitivities(&soft, quantity), Err(Error::SoftContact));
    }
    let driven = moved(&paper, Waveform::Triangle, Waveform::Sine);
    assert_eq!(driven.nearest_trap(0.1, &Unobserved), Err(Error::DriveNotSine));
    assert_eq!(driven.report(&Unobserved), Err(Error::DriveNotSine));
    let phase = Phase::new(0.3).expect("finite");
    let settings = TransientSettings { duration: 1e-3, intervals: 4, ..TransientSettings::default() };
    let run = |motor: &Motor| crate::motor::transient(motor.system(), phase, &settings, &Unobserved);
    assert_eq!(run(&soft), Err(Error::SoftContact));
    assert_eq!(run(&stiff), run(&paper));
    assert_eq!((stiff.stator_motion(), paper.stator_motion()), (&Stator::Sine, &Stator::Sine));
    assert!(stiff.warnings().iter().any(|warning| warning.to_string().ends_with("computed as rigid")));
}

/// On a stator too slow to throw the rotor, it creeps under a load, as on the sine.
#[test]
fn a_rotor_that_never_leaves_the_stator_has_its_steady_speed() {
    let calm = Motor::paper_70_khz().with(|sheet| sheet.amplitude = Some(4e-11)).expect("legal");
    let driven = as_a_sum(&calm);
    let loads = [0.0, 0.3 * calm.largest_torque()];
    let curve = driven.torque_speed_curve(&loads, &settings(), &Unobserved).expect("no failure");
    let known = calm.torque_speed_curve(&loads, &settings(), &Unobserved).expect("no failure");
    for (own, known) in curve.iter().zip(&known) {
        let (own, known) = (own.steady().expect("known"), known.steady().expect("known"));
        let error = own.speed.standard_error + known.speed.standard_error;
        assert!((own.speed.value - known.speed.value).abs() < 3.0 * error, "{own:?} {known:?}");
        let loss = known.friction_loss.value;
        assert!((own.friction_loss.value - loss).abs() < 1e-6 * loss, "{own:?} {known:?}");
        assert!(own.energy_residual < 1e-9, "{own:?}");
    }
}

fn on_stator(mass: f64, quality: f64, change: impl FnOnce(&mut MotorParameters)) -> Motor {
    let modes = StatorParameters { mass: Some(mass), quality: Some(quality), ..StatorParameters::default() };
    let motor = Motor::paper_70_khz().with(|sheet| {
        sheet.stator = Some(modes);
        change(sheet);
    });
    motor.expect("legal")
}

/// The motion of a stator of a thousand tonnes is effectively prescribed. A stator of 10 g is damped by the
/// rotor, and does not lift it under too large a preload, but an operation is still found.
#[test]
fn a_stator_yields_by_its_mass() {
    let point = |motor: &Motor| {
        motor.torque_speed_curve(&[0.0], &settings(), &Unobserved).expect("no failure").swap_remove(0)
    };
    let heavy = point(&on_stator(1e6, 300.0, |_| {}));
    let known =
        Motor::paper_70_khz().torque_speed_curve(&[0.0], &settings(), &Unobserved).expect("no failure");
    let (own, known) = (heavy.steady().expect("known"), known[0].steady().expect("known"));
    let error = own.speed.standard_error + known.speed.standard_error;
    assert!((own.speed.value - known.speed.value).abs() < 3.0 * error, "{own:?} {known:?}");
    let stator = own.stator.expect("yields");
    assert!((stator.amplitude.value / 1e-8 - 1.0).abs() < 1e-6 && own.energy_residual < 1e-9, "{own:?}");
    let light = |preload: f64| {
        on_stator(0.01, 300.0, |sheet| {
            (sheet.amplitude, sheet.preload_acceleration) = (Some(1e-7), Some(preload));
        })
    };
    let own = *point(&light(5.0)).point().expect("it turns");
    let stator = own.stator.expect("yields");
    // By an integration in small steps: 0.6861 of the amplitude without a rotor, 8.10 mW.
    assert!((stator.amplitude.value / 1e-7 - 0.686).abs() < 0.01, "{own:?}");
    let drive = stator.drive_power.value;
    let lost = stator.damping_loss.value + own.restitution_loss.value + own.friction_loss.value;
    assert!((drive / 8.17e-3 - 1.0).abs() < 0.02 && (drive / lost - 1.0).abs() < 0.02, "{own:?}");
    // A rotor that is never lifted off, for which periods count instead of impacts.
    let few = OperatingSettings { most_impacts: 2_000, ..settings() };
    let weighed = light(25.0).torque_speed_curve(&[0.0], &few, &Unobserved).expect("no failure");
    let weighed = *weighed[0].point().expect("it does not run away");
    assert!(weighed.impacts > 0 && weighed.energy_residual < 1e-9, "{weighed:?}");
    assert!(weighed.stator.expect("yields").amplitude.value < 1e-9, "{weighed:?}");
}

/// Under a load that decreases with the speed, a slow rotor has two stable speeds. In the first state it is
/// driven back, on the steep part of the load below zero speed; the second state is beyond the decrease.
/// Under a load above the torque at rest, a rotor that starts from rest stays in the first state.
#[test]
fn a_load_that_falls_with_the_speed_leaves_two_operations() {
    let sheet = |inertia: f64, most: f64| {
        let law = LoadLaw::new(&[-1.0, 0.0, 0.5, 3.0, 10.0], &[0.0, most, most, 1e-3, 1e-3]).expect("legal");
        let wave = |sheet: &mut MotorParameters| {
            (sheet.drive_frequency, sheet.amplitude) = (40e3, Some(0.5e-6));
            (sheet.peak_angular_speed, sheet.twist_amplitude) = (Some(12.0), None);
            (sheet.mass, sheet.density, sheet.rotor_radius) = (Some(0.020), None, None);
            (sheet.contact_radius, sheet.gyration_radius) = (12.5e-3, Some(inertia));
            (sheet.preload_force, sheet.preload_acceleration) = (Some(5.0), None);
            sheet.load = Some(law);
        };
        Motor::paper_70_khz().with(wave).expect("legal")
    };
    let operated = |motor: &Motor| motor.operating_point(0.0, &settings(), &Unobserved).expect("no failure");
    let speeds = |row: &OperatingRow| -> Vec<f64> {
        row.branches.iter().map(|one| one.steady().expect("settled").speed.value).collect()
    };
    let (most, motor) = (5.2e-3, sheet(71e-3, 5.2e-3));
    let both = operated(&motor);
    let found = speeds(&both);
    assert!(found.len() == 2 && found[0] < 0.0 && (found[1] - 7.3).abs() < 0.3, "{both:?}");
    // The piece of the load has the torque at rest there.
    let blocked = both.point().and_then(|point| point.blocked_torque).expect("nothing acts back").value;
    assert!((found[0] - (blocked / most - 1.0)).abs() < 0.05, "{both:?}");
    // Between them a rotor falls back or speeds up, by integration in small steps with the speed held. The
    // engine of the whole motor falls back from below the unstable speed, and speeds up from above it.
    let between = both.point().and_then(|point| point.unstable_speed).expect("found");
    let unit = motor.system().scales().angular_speed;
    let system = motor.stator_motion().yielded().expect("it has a law").clone();
    let rising = |offset: f64| {
        let rises = |k: u32| {
            let phase = Phase::new(0.39 * f64::from(k)).expect("finite");
            let angular_speed = (between.value + offset) / unit;
            let start = DrivenStart::Contact { phase, angular_speed };
            let mut engine = StatorEngine::new(system.clone(), start).expect("legal");
            while engine.time().periods < 40_000 {
                engine.advance().expect("no failure").expect("goes on");
            }
            engine.state().disk.angular_speed > between.value / unit
        };
        (0..16).filter(|k| rises(*k)).count()
    };
    let ends = [-NORMAL_975, NORMAL_975].map(|errors| rising(errors * between.standard_error));
    assert!(ends[0] <= 2 && ends[1] >= 14, "{between:?} {ends:?}");
    let one = operated(&sheet(71e-3, 3.6e-3));
    assert!(one.branches.len() == 1 && (speeds(&one)[0] - 7.3).abs() < 0.3, "{one:?}");
    // A quick rotor swings from one to the other.
    assert_eq!(operated(&sheet(10e-3, 5.2e-3)).branches.len(), 1);
}

/// The mean torque of a load that depends on the speed is the torque at the mean speed if this stays on one
/// straight line, with or without a node on it. The requested torque is added. A time-dependent load is an
/// error.
#[test]
fn operating_points_are_under_the_law_of_the_load() {
    let motor = |load: LoadLaw| Motor::paper_70_khz().with(|sheet| sheet.load = Some(load)).expect("legal");
    let point = |load: Result<LoadLaw, Error>, torque: f64| {
        let motor = motor(load.expect("legal"));
        motor.torque_speed_curve(&[torque], &settings(), &Unobserved).expect("no failure").swap_remove(0)
    };
    let lines = [(&[0.0, 20.0][..], &[0.0, 14e-6][..]), (&[0.0, 10.0, 20.0], &[0.0, 7e-6, 14e-6])];
    let [line, bent] = lines.map(|(speeds, torques)| {
        let law = LoadLaw::new(speeds, torques).and_then(|law| law.with_inertia(1e-7));
        let found = *point(law, 3e-6).steady().expect("known");
        let mean = 3e-6 + 0.7e-6 * found.speed.value;
        assert!((found.load_torque / mean - 1.0).abs() < 1e-9, "{found:?}");
        // In addition to the scatter both have the error of the steps, which is a share of each value.
        let [error, steps] = [0.7e-6 * found.speed.standard_error, 3e-6 * 1.1e-4];
        assert!((found.load_torque_error - error).abs() < 1e-6 * error + steps, "{found:?}");
        assert!(found.energy_residual < 1e-9 && found.stator.is_none(), "{found:?}");
        found
    });
    let error = line.speed.standard_error + bent.speed.standard_error;
    assert!((line.speed.value - bent.speed.value).abs() < error, "{line:?} {bent:?}");
    let constant = point(LoadLaw::constant(4e-6), 6e-6);
    let known = Motor::paper_70_khz().operating_point(10e-6, &settings(), &Unobserved).expect("no failure");
    let (own, known) = (constant.steady().expect("known"), known.steady().expect("known"));
    let error = own.speed.standard_error + known.speed.standard_error;
    assert!((own.load_torque / 10e-6 - 1.0).abs() < 1e-9 && own.load_torque_error < 1e-15);
    assert!((own.speed.value - known.speed.value).abs() < 3.0 * error, "{own:?} {known:?}");
    let Operation::Runaway { load_torque, .. } = *point(LoadLaw::constant(38e-6), 4e-6).operation() else {
        panic!("friction holds {}", Motor::paper_70_khz().largest_torque())
    };
    assert!((load_torque / 42e-6 - 1.0).abs() < 1e-9, "{load_torque}");
    let stops = LoadLaw::constant(1e-6).and_then(|law| law.with_factors(&[1.0], &[0.0])).expect("legal");
    let refused = motor(stops).torque_speed_curve(&[0.0], &settings(), &Unobserved);
    assert_eq!(refused, Err(Error::LoadInTime));
}

/// Requested errors are relative to the speed without load or law, both for a fan that nearly stalls the
/// motor and for a load that friction alone does not balance.
#[test]
fn errors_are_relative_to_the_speed_without_the_law_of_the_load() {
    let wanted = |load: Result<LoadLaw, Error>, torque: f64| {
        let motor = Motor::paper_70_khz().with(|sheet| sheet.load = load.ok()).expect("legal");
        // A random drift does not state which error is missing.
        let mut seeds = (1..10).filter_map(|seed| {
            let few = OperatingSettings { relative_error: 1e-6, most_impacts: 100_000, seed, ..settings() };
            match *motor.torque_speed_curve(&[torque], &few, &Unobserved).expect("no failure")[0].operation()
            {
                Operation::Unsettled(_, Shortfall::Error { wanted, .. }) => Some(wanted / few.relative_error),
                _ => None,
            }
        });
        seeds.next().expect("one that does not drift")
    };
    let known = Motor::paper_70_khz().no_load_speed(&settings()).expect("known").value;
    let loads = [(LoadLaw::constant(60e-6), -50e-6), (LoadLaw::fan(2.0, 30e-6, 3), 0.0)];
    for (load, torque) in loads {
        let own = wanted(load, torque);
        assert!((own / known - 1.0).abs() < 0.2, "{own} {known}");
    }
}

#[test]
fn a_stall_is_that_of_the_motor_without_the_law_of_its_load() {
    let few = OperatingSettings { relative_error: 0.3, most_impacts: 20_000, ..settings() };
    let stall = |load: Result<LoadLaw, Error>| {
        let motor = Motor::paper_70_khz().with(|sheet| sheet.load = load.ok()).expect("legal");
        motor.stall_load(&few, &Unobserved)
    };
    // Bit for bit, even if the budget is too small for a stall.
    assert_eq!(stall(LoadLaw::constant(10e-6)), stall(LoadLaw::constant(0.0)));
}

/// When the drive is switched off during a run-up, the modes ring down within 2 Q/omega, and the rotor stops.
#[test]
fn a_run_up_ends_when_the_drive_is_switched_off() {
    let motor = on_stator(1.0, 300.0, |sheet| {
        sheet.load = LoadLaw::fan(20.0, 1e-7, 4).and_then(|load| load.with_drive(0.005, 0.05)).ok();
        sheet.peak_angular_speed = Some(3.0);
    });
    let settings = TransientSettings { duration: 0.1, intervals: 100, ..TransientSettings::default() };
    let (curve, amplitudes) =
        motor.run_up(Phase::new(1.0).expect("finite"), &settings, &Unobserved).expect("legal");
    assert!(amplitudes.len() == 100 && curve.speeds.len() == 100);
    assert!(amplitudes[..4].iter().all(|amplitude| *amplitude < 1e-10), "{amplitudes:?}");
    assert!(amplitudes[48] > 5e-9 && amplitudes[99] < 0.2 * amplitudes[48], "{amplitudes:?}");
    assert!(curve.speeds[48] > 0.1, "{:?}", curve.speeds);
}
