use std::f64::consts::TAU;

use bouncing_disk_core::run::Watch;
use bouncing_disk_core::{ChatterPolicy, Unobserved};

use super::*;
use crate::motion::PAPER_CHATTER;
use crate::motor::transient;
use crate::testing::{check_endless, motor, refused};

fn zero() -> Phase {
    Phase::new(0.0).expect("finite")
}

/// Motors that differ in everything that one vertical motion allows: load, friction, lag, twist, radii.
fn varied(base: &System, count: u32) -> Vec<System> {
    (0..count)
        .map(|k| {
            let share = f64::from(k) / f64::from(count.max(2) - 1);
            base.with_platform(|stator| {
                stator.phase_lag = 6.0 * share;
                stator.twist_amplitude *= if k % 5 == 4 { 0.0 } else { 0.5 + share };
            })
            .and_then(|motor| {
                motor.with_disk(|rotor| {
                    rotor.friction = if k % 7 == 6 { 0.0 } else { 0.02 + 0.4 * share };
                    rotor.load_acceleration = 30.0 * (share - 0.5);
                    rotor.contact_radius *= 1.0 + 0.3 * share;
                    rotor.gyration_radius *= 1.0 - 0.3 * share;
                })
            })
            .expect("legal")
        })
        .collect()
}

fn unobserved(
    systems: &[System],
    phase: Phase,
    settings: &TransientSettings,
    set: InstructionSet,
) -> Result<Vec<SpeedCurve>, Error> {
    let watch = Watch::begin(&Unobserved, 0, 1).expect("goes on");
    shared_transients(systems, phase, settings, set, &mut watch.work())
}

fn assert_as_alone(systems: &[System], phase: Phase, settings: &TransientSettings) {
    for set in InstructionSet::available() {
        let curves = unobserved(systems, phase, settings, set).expect("no failure");
        assert_eq!(curves.len(), systems.len());
        for (system, curve) in systems.iter().zip(&curves) {
            let alone = transient(system, phase, settings, &Unobserved).expect("no failure");
            assert_eq!(*curve, alone, "{set:?}");
        }
    }
}

/// Flights, taps, and a rotor that never leaves the stator: that of the engine that
/// knows no taps, which shares neither windows nor the common motion.
#[test]
fn contacts_that_take_time_carry_rotors_as_the_engine_does() {
    let settings = TransientSettings {
        duration: 0.01,
        intervals: 8,
        relaunch_perturbation: 0.0,
        ..TransientSettings::default()
    };
    for (periods, amplitude) in [(0.3, 1e-8), (1.0, 1e-8), (8.0, 1e-8), (1.0, 4e-11)] {
        let one = crate::Motor::paper_70_khz().with(|sheet| {
            sheet.amplitude = Some(amplitude);
            sheet.contact = Some(crate::parameters::contact::Contact::lasting(periods / 70e3));
        });
        let one = one.expect("legal");
        let other = one.with(|sheet| (sheet.friction, sheet.phase_lag) = (0.3, -1.0)).expect("legal");
        let systems = [*one.system(), *other.system()];
        let own = unobserved(&systems, zero(), &settings, InstructionSet::best()).expect("no failure");
        for (own, motor) in own.iter().zip([one, other]) {
            // A second harmonic, be it ever so small, makes it follow each event.
            let angle = Waveform::Fourier(vec![(1.0, 0.0), (1e-300, 0.0)]);
            let engine = motor.with(|sheet| sheet.drive.angle = angle).expect("legal");
            let engine = engine.transient(zero(), &settings, &Unobserved).expect("no failure");
            // The first intervals are as long as the first flights.
            for (own, engine) in own.speeds.iter().zip(&engine.speeds).skip(3) {
                assert!((own - engine).abs() < 0.005 * engine.abs(), "{periods} {amplitude}: {own} {engine}");
            }
        }
    }
}

/// Rows that are full, half full, and of one rotor; platforms that throw the rotor far, hardly and never;
/// both ends of a chatter; starts that lie, that fly at once, and on the seams between the two.
#[test]
fn each_curve_is_that_of_the_motor_alone() {
    for (amplitude, duration) in [(1e-8, 0.3), (5e-11, 0.02), (1e-12, 0.01)] {
        let base = motor(amplitude, 0.0);
        let leaves = base.dimensionless().vibration().separation_phase();
        let mut phases = vec![zero(), Phase::new(4.0).expect("finite"), Phase::new(1.6).expect("finite")];
        phases.extend(leaves);
        for (index, phase) in phases.into_iter().enumerate() {
            for policy in [ChatterPolicy::Complete, PAPER_CHATTER] {
                for relaunch_perturbation in [0.0, 1e-3] {
                    let settings = TransientSettings {
                        duration,
                        intervals: 40,
                        policy,
                        relaunch_perturbation,
                        seed: 7 + index as u64,
                    };
                    let count = [1, 7, 8, 19][index];
                    assert_as_alone(&varied(&base, count), phase, &settings);
                }
            }
        }
    }
}

/// A curve that ends within a flight, a rest or the first rest of all.
#[test]
fn curves_of_any_length_are_those_of_the_motor_alone() {
    let systems = varied(&motor(1e-8, 0.0), 9);
    let phase = Phase::new(3.0).expect("finite");
    let period = TAU / systems[0].platform().angular_frequency();
    for periods in [1e-9, 0.1, 0.3, 0.5, 0.9, 1.0, 3.3, 40.0, 1000.0] {
        for intervals in [3, 1000] {
            let settings =
                TransientSettings { duration: periods * period, intervals, ..TransientSettings::default() };
            if settings.check_for(&systems[0].scales()).is_ok() {
                assert_as_alone(&systems, phase, &settings);
            }
        }
    }
}

/// The least loads, frictions and twists that are numbers; loads that equal the friction, and miss it by a
/// rounding; starts in roundings about the phase at which the platform falls away, and about a whole turn.
#[test]
fn curves_on_the_seams_are_those_of_the_motor_alone() {
    let base = motor(1e-8, 0.0);
    let neighbour = |value: f64, steps: i64| f64::from_bits(value.to_bits().wrapping_add_signed(steps));
    let holds = base.dimensionless().friction() * base.scales().angular_acceleration;
    let least = [5e-324, 1e-310, f64::MIN_POSITIVE, 1e-300];
    let loads = least.into_iter().chain([-2, -1, 0, 1, 2].map(|steps| neighbour(holds, steps)));
    let mut systems: Vec<System> = loads
        .flat_map(|load| [load, -load])
        .map(|load| base.with_disk(|rotor| rotor.load_acceleration = load).expect("legal"))
        .collect();
    for value in least {
        systems.push(base.with_disk(|rotor| rotor.friction = value).expect("legal"));
        systems.push(base.with_platform(|stator| stator.twist_amplitude = value).expect("legal"));
    }
    let leaves = base.dimensionless().vibration().separation_phase().expect("it throws the rotor").angle();
    let about = |angle: f64| [-2, -1, 0, 1, 2].map(|steps| neighbour(angle, steps));
    let settings = TransientSettings { duration: 0.02, intervals: 20, ..TransientSettings::default() };
    for angle in about(leaves).into_iter().chain(about(TAU)).chain([5e-324, -5e-324]) {
        assert_as_alone(&systems, Phase::new(angle).expect("finite"), &settings);
    }
}

#[test]
fn motors_without_a_common_vertical_motion_and_too_many_curves_are_refused() {
    let base = System::motor();
    let settings = TransientSettings { duration: 1e-3, intervals: 3, ..TransientSettings::default() };
    let of = |systems: &[System], settings| unobserved(systems, zero(), settings, InstructionSet::best());
    let next = |value: f64| f64::from_bits(value.to_bits() + 1);
    let lifted = base.with_platform(|stator| stator.amplitude *= 2.0).expect("legal");
    let pressed = |system: System, by: f64| system.with_disk(|rotor| rotor.preload_acceleration *= by);
    // The same P, at another preload and another frequency: not the same seconds.
    let scaled = base.with_platform(|stator| stator.angular_frequency *= 2.0);
    for (told, other) in [
        ("peak acceleration P", Ok(lifted)),
        ("peak acceleration P", pressed(base, 0.5)),
        ("restitution", base.with_disk(|rotor| rotor.restitution = next(rotor.restitution))),
        ("angular frequency", scaled.and_then(|system| pressed(system, 4.0))),
        ("preload acceleration", pressed(lifted, 2.0)),
    ] {
        let told = format!("rotors that share one vertical motion differ in {told}");
        refused(&*told, [other.expect("legal")], |other| of(&[base, other], &settings));
    }
    refused("number of rotors", [()], |()| of(&[], &settings));
    let long = TransientSettings { intervals: 1_000_000, ..TransientSettings::default() };
    let error = of(&vec![base; 100], &long).expect_err("too many");
    assert!(matches!(error, Error::Core(bouncing_disk_core::Error::TooLarge { .. })), "{error}");
}

#[test]
fn a_longer_call_may_stop() {
    let systems = varied(&motor(1e-8, 0.0), 16);
    let settings = TransientSettings { duration: 20.0, intervals: 50, ..TransientSettings::default() };
    check_endless(1, |observer| {
        let watch = Watch::begin(observer, 0, 1).expect("goes on");
        shared_transients(&systems, zero(), &settings, InstructionSet::best(), &mut watch.work())
    });
}
