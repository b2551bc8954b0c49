use bouncing_disk_core::Unobserved;
use bouncing_disk_core::run::Watch;

use super::*;
use crate::System;
use crate::testing::motor;

/// The engine of one rotor, perturbed by the same stream: the same speed to the bit, and the same energy.
#[test]
fn a_member_is_the_engine_of_each_rotor() {
    let settings = OperatingSettings { members: 5, seed: 9, ..OperatingSettings::default() };
    for amplitude in [1e-8, 2e-9, 6e-11] {
        let systems: Vec<System> = (0..11_u32)
            .map(|k| {
                motor(amplitude, 3.0 * f64::from(k) - 9.0)
                    .with_disk(|rotor| rotor.friction *= 0.2 + 0.3 * f64::from(k))
                    .expect("legal")
            })
            .collect();
        let dimensionless: Vec<DimensionlessSystem> =
            systems.iter().map(|system| *system.dimensionless()).collect();
        for index in [0, 3] {
            let watch = Watch::begin(&Unobserved, 0, 1).expect("goes on");
            let mut member =
                Member::new(&dimensionless, &vec![Stator::Sine; dimensionless.len()], 0, index, &settings)
                    .expect("legal");
            let windows: Vec<Window> = (0..3)
                .map(|_| member.next_window(300.0, 40..=1_000_000, &mut watch.work()).expect("no failure"))
                .collect();
            let Member::Bouncing(member) = member else { panic!("it bounces") };
            for (rotor, system) in dimensionless.iter().enumerate() {
                let phase = starting_phase(settings.seed, index, 5).expect("finite");
                let start = InitialCondition::Contact { phase, angular_speed: 0.0 };
                let mut engine = Engine::new(*system, start, ChatterPolicy::Complete).expect("legal");
                let seed = SplitMix64::seed_of_stream(settings.seed, index as u64);
                let mut generator = SplitMix64::new(seed);
                let mut perturb = |engine: &mut Engine| {
                    engine.perturb_launch(settings.relaunch_perturbation * generator.unit()).expect("legal");
                };
                let (mut ledger, mut impacts, mut begun) = (EnergyLedger::default(), 0, engine.launches());
                while engine.time().order(&member.vertical.now()).is_lt() {
                    let record = engine.advance().expect("no failure").expect("it goes on");
                    if begun {
                        ledger += record.ledger;
                    }
                    match record.event {
                        Event::Separation => {
                            perturb(&mut engine);
                            begun = true;
                        }
                        Event::Impact { .. } => impacts += 1,
                        _ => {}
                    }
                }
                assert_eq!(engine.time(), member.vertical.now());
                assert_eq!(engine.state().angular_speed.to_bits(), member.speeds()[rotor].to_bits());
                let mut all = windows[0].clone();
                windows[1..].iter().for_each(|window| all.add(window));
                assert_eq!(all.axial.impacts, impacts);
                let own = &all.rotors[rotor];
                for (one, other, size) in [
                    (own.friction_work, ledger.friction_work, ledger.rotary_magnitude),
                    (own.friction_loss, ledger.friction_loss, ledger.rotary_magnitude),
                    (own.load_work, ledger.load_work, ledger.rotary_magnitude),
                    (own.kinetic_change, ledger.rotary_kinetic_change, ledger.rotary_magnitude),
                    (all.axial.normal_work, ledger.normal_work, ledger.axial_magnitude),
                    (all.axial.restitution_loss, ledger.restitution_loss, ledger.axial_magnitude),
                    (
                        all.axial.energy_change,
                        ledger.axial_kinetic_change + ledger.potential_change + all.axial.perturbation_work,
                        ledger.axial_magnitude,
                    ),
                ] {
                    assert!((one - other).abs() <= 1e-12 * size, "{amplitude} {rotor}: {one} {other}");
                }
            }
        }
    }
}
