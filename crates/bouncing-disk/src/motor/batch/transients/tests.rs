use std::f64::consts::TAU;

use bouncing_disk_core::{Phase, Unobserved};

use super::*;
use crate::motor::TransientSettings;
use crate::testing::check_endless;
use crate::{DiskParameters, PlatformParameters, System};

/// Motors near Table III: chattering ones, plastic ones, loaded ones, some that never bounce, some that fail.
fn member(k: u32) -> TransientMember {
    let share = |factor: f64| (f64::from(k) * factor) % 1.0;
    let omega = TAU * [70e3, 70e3, 30e3][k as usize % 3];
    let platform = PlatformParameters {
        amplitude: [1e-8, 1e-8, 1e-9, 3e-8, 1e-8, 3e-10, 4e-11][k as usize % 7],
        twist_amplitude: 30.0 / omega,
        angular_frequency: omega,
        phase_lag: if k % 4 == 3 { TAU * share(0.618_034) } else { 0.0 },
    };
    let disk = DiskParameters {
        friction: [0.1, 0.1, 0.3, 0.0, 0.1, 1.0, 1e-3][k as usize / 3 % 7],
        restitution: [0.5, 0.5, 0.0, 0.3, 0.5, 0.8, 0.99][k as usize / 5 % 7],
        preload_acceleration: if k.is_multiple_of(2) { 9.8 } else { 1.0 + 80.0 * share(0.754_878) },
        load_acceleration: if k % 6 == 1 { 20.0 * share(0.569_84) } else { 0.0 },
        ..System::motor().disk().parameters()
    };
    TransientMember {
        system: System::new(platform.build().expect("legal"), disk.build().expect("legal")).expect("legal"),
        phase: Phase::new(TAU * share(0.324_718)).expect("finite"),
        settings: TransientSettings {
            duration: 0.01 + 0.3 * share(0.137) * share(0.236_068),
            intervals: if k % 41 == 40 { 2 } else { 3 + (k as usize % 11) * 20 },
            relaunch_perturbation: [1e-3, 1e-3, 0.0, 0.3][k as usize % 4],
            seed: u64::from(k),
            policy: if k % 23 == 22 { crate::motion::PAPER_CHATTER } else { ChatterPolicy::Complete },
        },
    }
}

/// A stator so violent that a flight lasts too long to be followed.
fn violent(k: u32) -> TransientMember {
    let mut member = member(k);
    let platform = PlatformParameters {
        amplitude: 4.9e-3,
        twist_amplitude: 1e-6,
        angular_frequency: TAU * 70e3,
        phase_lag: 0.0,
    };
    let disk = DiskParameters { restitution: 0.99, ..member.system.disk().parameters() };
    member.system =
        System::new(platform.build().expect("legal"), disk.build().expect("legal")).expect("legal");
    member.settings.duration = 1e9;
    member
}

fn bits(outcome: &Result<SpeedCurve, Error>) -> Result<(Vec<u64>, u64, u64), String> {
    match outcome {
        Ok(curve) => {
            let numbers = curve.times.iter().chain(&curve.speeds).map(|value| value.to_bits());
            Ok((numbers.collect(), curve.impacts, curve.separations))
        }
        Err(error) => Err(format!("{error:?}")),
    }
}

fn alone(member: &TransientMember) -> Result<SpeedCurve, Error> {
    crate::motor::transient(&member.system, member.phase, &member.settings, &Unobserved)
}

#[test]
fn together_they_are_what_they_are_alone() {
    let members: Vec<_> = (0..400).map(|k| if k % 57 == 50 { violent(k) } else { member(k) }).collect();
    let alone: Vec<_> = members.iter().map(alone).collect();
    let expected: Vec<_> = alone.iter().map(bits).collect();
    let curves = || alone.iter().flatten();
    let (impacts, separations) =
        curves().fold((0, 0), |(impacts, rests), curve| (impacts + curve.impacts, rests + curve.separations));
    assert!(impacts > 50_000 && separations > 2_000, "{impacts} {separations}");
    for kind in ["intervals", "FlightTooLong"] {
        let failed =
            expected.iter().filter(|outcome| outcome.as_ref().is_err_and(|text| text.contains(kind)));
        assert!(failed.count() > 1, "{kind}");
    }
    for set in InstructionSet::available() {
        for threads in [1, 7] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("pool");
            let together =
                pool.install(|| with_instructions(&members, &Unobserved, set)).expect("unobserved");
            let together: Vec<_> = together.iter().map(bits).collect();
            for (k, (together, expected)) in together.iter().zip(&expected).enumerate() {
                assert!(together == expected, "{set:?}, {threads} threads: {:?}", members[k]);
            }
            assert_eq!(together.len(), expected.len());
        }
    }
}

#[test]
fn few_or_none_are_legal() {
    assert!(transients(&[], &Unobserved).expect("unobserved").is_empty());
    let few: Vec<_> = (0..3).map(member).collect();
    let alone: Vec<_> = few.iter().map(alone).collect();
    assert_eq!(transients(&few, &Unobserved), Ok(alone));
}

#[test]
fn one_long_transient_can_be_stopped() {
    let mut long = member(0);
    long.settings.duration = 1e6;
    check_endless(long.settings.intervals as u64, |observer| {
        crate::motor::transient(&long.system, long.phase, &long.settings, observer)
    });
    check_endless(70, |observer| transients(&[long; 70], observer));
}
