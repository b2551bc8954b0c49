use super::*;
use crate::Vibration;
use crate::numerics::roots::bisected_bracket;
use crate::testing::{StopAfter, stored};

fn map(peak: f64, restitution: f64) -> ImpactMap {
    ImpactMap::new(Vibration::new(peak).expect("legal"), restitution).expect("legal")
}

fn cycle(peak: f64, restitution: f64) -> SeparationCycle {
    match separation_cycle(map(peak, restitution), CycleBudget::default()) {
        Ok(SeparationOutcome::Cycle(cycle)) => cycle,
        other => panic!("P {peak}, r {restitution}: {other:?}"),
    }
}

/// Periods and phases from a program that shares nothing with this one: mpmath with 60 to 120 digits, a scan
/// for the first zero of the gap, and a leading-order sum of the chatter, which is off by less than 3e-6 rad.
/// The first two are the motor of Table III, and one with the restitution 0.3; the others lie in Fig. 6.
#[test]
fn cycles_are_those_of_an_independent_program() {
    for (peak, restitution, periods, phase) in [
        (197.392_088_021_787_14, 0.5, 1_055, 4.614_371_032_721_149),
        (197.392_088_021_787_14, 0.3, 327, 5.940_709_171_878_452),
        (3.769_911_184_307_752, 0.5, 133, 5.457_177_122_473_639),
        (1.884_955_592_153_876, 0.5, 52, 5.629_980_548_878_433),
    ] {
        let found = cycle(peak, restitution);
        assert_eq!(found.platform_periods, periods, "{found:?}");
        assert!((found.rest_phase - phase).abs() < 3e-6, "{found:?}");
    }
}

/// What no double can follow is followed: the motor of Table III loses 27 digits in 25 impacts, and doubles
/// end another way.
#[test]
fn a_motor_in_doubles_is_on_a_cycle_of_its_rounding() {
    let motor = cycle(197.392_088_021_787_14, 0.5);
    assert!((20.0..35.0).contains(&motor.lost_digits), "{motor:?}");
    assert!(motor.impacts_in_doubles < 8 && motor.impacts > 20, "{motor:?}");
    assert!(!motor.is_that_of_doubles(), "{motor:?}");
    // As many impacts by chance, but not the same ones.
    assert_ne!(motor.in_doubles.map(|cycle| cycle.platform_periods), Some(motor.platform_periods));
}

/// As long as an error of a rounding stays below the tolerance, doubles find the same cycle; the other way
/// round doubles that follow an orbit to its rest have lost few digits.
#[test]
fn short_cycles_are_those_of_doubles() {
    let mut trusted = 0;
    for k in 0..60 {
        let peak = 1.05 + 0.06 * f64::from(k);
        for restitution in [0.1, 0.3] {
            let budget = CycleBudget { max_impacts: 200, max_digits: 200 };
            let outcome = separation_cycle(map(peak, restitution), budget).expect("no error");
            let SeparationOutcome::Cycle(cycle) = outcome else { continue };
            if cycle.lost_digits < 9.0 {
                assert!(cycle.is_that_of_doubles(), "P {peak}, r {restitution}: {cycle:?}");
                trusted += 1;
            }
            if cycle.is_that_of_doubles() {
                assert!(cycle.lost_digits < 17.0, "P {peak}, r {restitution}: {cycle:?}");
            }
        }
    }
    assert!(trusted > 40, "{trusted}");
}

/// Twice and four times the digits of what was needed give the same rest.
#[test]
fn more_digits_change_nothing() {
    let watch = Watch::begin(&Unobserved, 0, 1_000).expect("nobody stops it");
    let rest = |bits: usize| {
        let orbit = ExactOrbit::new(map(1_973.920_880_217_871_2, 0.5), bits).expect("separates");
        match orbit.follow(1_000, &watch) {
            Ok(Followed::Rest { impacts, periods, phase, .. }) => (impacts, periods, phase.to_bits()),
            other => panic!("{other:?}"),
        }
    };
    let (first, second) = (rest(1_024), rest(4_096));
    assert_eq!((first.0, first.1), (second.0, second.1));
    assert!((f64::from_bits(first.2) - f64::from_bits(second.2)).abs() < 1e-14);
}

#[test]
fn what_does_not_rest_says_why() {
    let outcome = |forcing: f64, restitution: f64, max_impacts: u64, max_digits: usize| {
        let map = ImpactMap::new(Vibration::from_axial_forcing(forcing).expect("legal"), restitution)
            .expect("legal");
        separation_cycle(map, CycleBudget { max_impacts, max_digits }).expect("no error")
    };
    // It settles on the orbit of period 2.
    let settled = outcome(0.51, 0.5, 400, 1_000);
    assert!(matches!(settled, SeparationOutcome::NoRestWithin { impacts: 400, .. }), "{settled:?}");
    // Chaos for longer than 256 bits can follow.
    let spent = outcome(0.555, 0.5, 100_000, 20);
    assert!(matches!(spent, SeparationOutcome::DigitsSpent { impacts: 50.., digits: 77 }), "{spent:?}");
    for forcing in [0.0, 0.1, 0.3] {
        assert_eq!(outcome(forcing, 0.5, 10, 20), SeparationOutcome::NeverSeparates, "{forcing}");
    }
    assert_eq!(
        separation_cycle(map(1.0, 0.5), CycleBudget::default()),
        Ok(SeparationOutcome::NeverSeparates)
    );
}

/// The seams: a platform that just falls away, no restitution at all, one next to 1, a long flight.
#[test]
fn at_the_edges_of_the_parameters_there_is_an_outcome() {
    let budget = CycleBudget { max_impacts: 60, max_digits: 100 };
    for peak in [1.0_f64.next_up(), 1.0 + 1e-9, 1.000_1, 1.01, 50.0, 1e4, 1e6] {
        for restitution in [0.0, 1e-300, 1e-8, 0.05, 0.99, 1.0 - f64::EPSILON] {
            let outcome = separation_cycle(map(peak, restitution), budget);
            assert!(outcome.is_ok(), "P {peak}, r {restitution}: {outcome:?}");
            let disagrees = matches!(outcome, Ok(SeparationOutcome::Disagreement { .. }));
            assert!(!disagrees, "P {peak}, r {restitution}: {outcome:?}");
        }
    }
}

/// Where a flight just misses the platform, doubles cannot know which impact is the first.
#[test]
fn a_graze_within_rounding_is_not_decided() {
    // The second or third flight after the separation; its duration jumps where it grazes.
    let flight = |peak: f64, flights: u32| {
        let map = map(peak, 0.5);
        let mut launch =
            Launch::new(map.vibration().separation_phase().expect("separates"), 0.0).expect("legal");
        for _ in 1..flights {
            let impact = map.vibration().first_impact(launch).expect("lands");
            launch = map.rebound(impact.into());
        }
        let impact = map.vibration().first_impact(launch).expect("lands");
        (impact.duration(), map.vibration().graze_margin(launch, &impact), -impact.velocity)
    };
    let duration = |peak: f64, flights: u32| flight(peak, flights).0;
    let mut unsure = 0;
    for (k, flights) in (0..700).flat_map(|k| [(k, 2), (k, 3)]) {
        let (low, high) = (3.0 + 0.01 * f64::from(k), 3.01 + 0.01 * f64::from(k));
        let (from, to) = (duration(low, flights), duration(high, flights));
        if (to - from).abs() < 1.0 {
            continue;
        }
        let Ok((before, after)) = bisected_bracket(low, high, 80, |peak| {
            let here = duration(peak, flights);
            Ok::<_, core::convert::Infallible>((here - from).abs() < (here - to).abs())
        });
        let jump = |flights: u32| (duration(before, flights) - duration(after, flights)).abs();
        // Steep without a jump, or the jump of an earlier flight.
        if jump(flights) < 0.5 || jump(flights - 1) > 1e-6 {
            continue;
        }
        for peak in [before, after] {
            // A rounding of P moves some of the launches by more than what is in doubt.
            let (_, margin, speed) = flight(peak, flights);
            if margin > 0.5e-10 * (1.0 + peak) && speed > 0.5e-6 * (1.0 + peak) {
                continue;
            }
            let outcome = separation_cycle(map(peak, 0.5), CycleBudget::default());
            let expected = u64::from(flights - 1);
            let undecided = matches!(outcome, Ok(SeparationOutcome::UnsureFlight { impacts, margin })
                if impacts == expected && (0.0..1e-8).contains(&margin));
            assert!(undecided, "P {peak}, flight {flights}: {outcome:?}");
            unsure += 1;
        }
    }
    assert!(unsure >= 4, "{unsure}");
}

#[test]
fn a_search_can_be_stopped_and_refuses_no_budget() {
    let (motor, budget) = (map(197.392_088_021_787_14, 0.5), CycleBudget::default());
    let all = StopAfter::calls(u64::MAX);
    assert_eq!(separation_cycle_observed(motor, budget, &all), separation_cycle(motor, budget));
    for calls in [1, 2, 10, all.asked() - 1] {
        let stopped = separation_cycle_observed(motor, budget, &StopAfter::calls(calls));
        assert!(matches!(stopped, Err(Error::Stopped { total: 5_000, .. })), "{calls}: {stopped:?}");
    }
    for (max_impacts, max_digits) in [(0, 100), (10_000_001, 100), (10, 19), (10, 100_001)] {
        let refused = separation_cycle(motor, CycleBudget { max_impacts, max_digits });
        assert!(matches!(refused, Err(Error::OutOfRange { .. })), "{refused:?}");
    }
}

#[test]
fn a_cycle_is_stored_and_printed_as_it_is() {
    let motor = map(197.392_088_021_787_14, 0.5);
    let outcome = separation_cycle(motor, CycleBudget::default()).expect("followed");
    assert_eq!(stored(&outcome), outcome);
    let SeparationOutcome::Cycle(cycle) = outcome else { panic!("{outcome:?}") };
    assert_eq!(stored(&cycle), cycle);
    assert_eq!(
        format!("{outcome:.0}"),
        "25 impacts in 1055 periods of the platform, 27 digits lost; in doubles 25 impacts in 865 periods (6 as they are)"
    );
    let short = separation_cycle(map(19.739_208_802_178_714, 0.5), CycleBudget::default()).expect("followed");
    assert!(short.to_string().ends_with("the same in doubles"), "{short}");
    for outcome in [
        SeparationOutcome::NeverSeparates,
        SeparationOutcome::NoRestWithin { impacts: 9, lost_digits: 2.5, impacts_in_doubles: 9 },
        SeparationOutcome::DigitsSpent { impacts: 7, digits: 77 },
        SeparationOutcome::UnsureFlight { impacts: 0, margin: 0.0 },
        SeparationOutcome::Disagreement { impacts: 7, digits: 77 },
    ] {
        assert_eq!(stored(&outcome), outcome);
        assert!(!outcome.to_string().is_empty());
    }
    assert_eq!(stored(&CycleBudget::default()), CycleBudget::default());
}

#[cfg(feature = "serde")]
#[test]
fn a_stored_cycle_that_is_none_is_refused() {
    let motor = map(19.739_208_802_178_714, 0.5);
    let outcome = separation_cycle(motor, CycleBudget::default()).expect("followed");
    let whole = serde_json::to_value(outcome).expect("writes");
    for (place, value) in [
        ("/Cycle/rest_phase", serde_json::json!(core::f64::consts::TAU)),
        ("/Cycle/lost_digits", serde_json::json!(-1.0)),
        ("/Cycle/impacts_in_doubles", serde_json::json!(1_000)),
        ("/Cycle/digits", serde_json::json!(null)),
    ] {
        let mut wrong = whole.clone();
        *wrong.pointer_mut(place).expect("is there") = value;
        assert!(serde_json::from_value::<SeparationOutcome>(wrong).is_err(), "{place}");
    }
    let budget = serde_json::json!({"max_impacts": 0, "max_digits": 100});
    assert!(serde_json::from_value::<CycleBudget>(budget).is_err());
}
