use std::f64::consts::{FRAC_PI_2, TAU};
use std::ops::ControlFlow;

use bouncing_disk_core::numerics::random::SplitMix64;

use super::*;
use crate::toss::rotary_response::rotary_response;
use crate::toss::rotary_response::tests::{orbits, system};

/// What the pieces say is what is found at any value, but next to the changes.
fn check_pieces(system: &DimensionlessSystem, orbit: &PeriodicOrbit, branch: &RotaryBranch) -> usize {
    let (first, last) = (branch.pieces.first().expect("pieces"), branch.pieces.last().expect("pieces"));
    let (low, high) = (first.low, last.high);
    let mut compared = 0;
    for step in 0..=400 {
        let value = low + (high - low) * f64::from(step) / 400.0;
        if branch.changes().chain([low, high]).any(|change| (change - value).abs() < 1e-6 * (high - low)) {
            continue;
        }
        let piece = branch.pieces.iter().find(|piece| piece.low <= value && value < piece.high).expect("one");
        let here = branch.parameter.applied(system, value).expect("legal");
        let outcome = rotary_response(&here, orbit).expect("an orbit");
        let found = &outcome.steady().expect("steady").sliding;
        assert_eq!(found, &piece.sliding, "{:?} {value} of {branch:?}", branch.parameter);
        compared += 1;
    }
    for pair in branch.pieces.windows(2) {
        assert_eq!(pair[0].high.to_bits(), pair[1].low.to_bits());
        assert_ne!(pair[0].sliding, pair[1].sliding);
    }
    compared
}

/// Against the response at 400 values, for all orbits and random systems.
#[test]
fn pieces_are_those_of_a_scan() {
    let mut random = SplitMix64::new(7);
    let (mut changes, mut compared) = ([0; 3], 0);
    for (forcing, restitution, orbit) in orbits() {
        for _ in 0..3 {
            let load = 0.4 * (1.6 * random.unit() - 0.8);
            let system = system(forcing, restitution, 20.0 * random.unit(), TAU * random.unit(), load);
            let ranges = [
                (RotaryParameter::AngularForcing, (0.0, 30.0)),
                (RotaryParameter::PhaseLag, (-1.0, TAU - 1.0)),
                (RotaryParameter::Load, (-0.399, 0.399)),
            ];
            for (k, (parameter, range)) in ranges.into_iter().enumerate() {
                let branch = rotary_branch(&system, &orbit, parameter, range).expect("a branch");
                compared += check_pieces(&system, &orbit, &branch);
                changes[k] += branch.changes().count();
            }
        }
    }
    assert!(changes.iter().all(|count| *count > 20) && compared > 20_000, "{changes:?} {compared}");
}

/// Two impacts: the weaker one begins to slide where the platform's speeds differ by what it can give.
#[test]
fn the_first_slip_of_two_impacts_is_in_closed_form() {
    let mut found = 0;
    for (forcing, restitution, orbit) in orbits().into_iter().filter(|(_, _, orbit)| orbit.period() == 2) {
        for lag in [0.0, 0.5, FRAC_PI_2, 4.0] {
            let system = system(forcing, restitution, 1.0, lag, 0.0);
            let cosines = orbit.states.iter().map(|state| sin_cos(state.phase().angle() + lag).1);
            let [one, other] = cosines.collect::<Vec<_>>()[..] else { panic!("two impacts") };
            let slowest = orbit.states.iter().map(|state| -state.velocity()).fold(f64::INFINITY, f64::min);
            let expected = (1.0 + restitution) * slowest / (PI * (one - other).abs());
            let range = (0.0, 2.0 * expected);
            let branch =
                rotary_branch(&system, &orbit, RotaryParameter::AngularForcing, range).expect("a branch");
            let changes: Vec<f64> = branch.changes().collect();
            assert_eq!(changes.len(), 1, "{branch:?}");
            assert!((changes[0] - expected).abs() < 1e-9 * expected, "{changes:?} {expected}");
            assert_eq!(branch.pieces[0].sliding, [None, None]);
            assert_eq!(branch.pieces[1].sliding.iter().filter(|slides| slides.is_none()).count(), 1);
            found += 1;
        }
    }
    assert!(found > 10, "{found}");
}

/// One impact sticks for whatever twist, lag and load below friction.
#[test]
fn one_impact_always_sticks() {
    let system = system(0.45, 0.5, 50.0, 0.3, 0.1);
    let orbit =
        system.map().period_one_pair(1).expect("exists").node.orbit(system.map()).expect("no failure");
    let orbit = orbit.expect("admissible");
    for (parameter, range) in [
        (RotaryParameter::AngularForcing, (0.0, 1e6)),
        (RotaryParameter::PhaseLag, (0.0, 20.0)),
        (RotaryParameter::Load, (-0.4_f64.next_down(), 0.4_f64.next_down())),
        (RotaryParameter::PhaseLag, (1.0, 1.0_f64.next_up())),
    ] {
        let branch = rotary_branch(&system, &orbit, parameter, range).expect("a branch");
        assert_eq!(branch.pieces.len(), 1, "{branch:?}");
        assert_eq!(branch.pieces[0], RotaryPiece { low: range.0, high: range.1, sliding: vec![None] });
    }
}

#[test]
fn what_has_no_branch_is_refused() {
    let system = system(0.45, 0.5, 1.0, 0.0, 0.0);
    let orbit =
        system.map().period_one_pair(1).expect("exists").node.orbit(system.map()).expect("no failure");
    let orbit = orbit.expect("admissible");
    let refused = |system: &DimensionlessSystem, parameter, range| {
        rotary_branch(system, &orbit, parameter, range).expect_err("refused").to_string()
    };
    use RotaryParameter::{AngularForcing, Load, PhaseLag};
    for (parameter, range, complaint) in [
        (AngularForcing, (1.0, 1.0), "high end"),
        (AngularForcing, (2.0, 1.0), "high end"),
        (AngularForcing, (-1.0, 1.0), "angular_forcing"),
        (AngularForcing, (0.0, 1e200), "twist_speed"),
        (PhaseLag, (f64::NAN, 1.0), "low end"),
        (PhaseLag, (0.0, f64::INFINITY), "high end"),
        (Load, (-0.1, 0.4), "load"),
        (Load, (-0.5, 0.1), "load"),
    ] {
        let error = refused(&system, parameter, range);
        assert!(error.contains(complaint), "{parameter:?} {range:?}: {error}");
    }
    let mut parameters = system.parameters();
    parameters.load = -0.4;
    let loaded = parameters.build().expect("legal");
    assert!(refused(&loaded, PhaseLag, (0.0, 1.0)).contains("overpowers"));
    parameters.friction = 0.0;
    parameters.load = 0.0;
    assert!(refused(&parameters.build().expect("legal"), PhaseLag, (0.0, 1.0)).contains("friction"));
    let stop = |_: crate::Progress| ControlFlow::Break(());
    let stopped = rotary_branch_observed(&system, &orbit, PhaseLag, (0.0, 1.0), &stop);
    assert!(matches!(stopped, Err(Error::Core(bouncing_disk_core::Error::Stopped { .. }))));
}
