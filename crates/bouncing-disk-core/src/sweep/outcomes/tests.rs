//! Stopped and failing sweeps, and partial results.

use super::*;
use crate::chatter::policy::ChatterPolicy;
use crate::flight::platform::vibration::Vibration;
use crate::map::impact_map::{ImpactMap, ImpactState, Orbit};
use crate::run::Unobserved;
use crate::sweep::survival_times;

/// Orbits from rest to chaos.
fn starts(count: u32) -> Vec<(ImpactMap, ImpactState)> {
    let start = ImpactState::from_normalised(0.8, 1.3).expect("legal");
    let map = |k: u32| {
        let vibration = Vibration::from_axial_forcing(0.3 + 0.3 * f64::from(k) / f64::from(count))?;
        ImpactMap::new(vibration, 0.5)
    };
    (0..count).map(|k| (map(k).expect("legal"), start)).collect()
}

fn orbits(count: u32) -> Vec<Orbit> {
    starts(count).iter().map(|(map, start)| map.orbit(*start, ChatterPolicy::Complete)).collect()
}

/// The sweep returns the error of the first orbit that fails, in the order of the orbits.
#[test]
fn an_orbit_that_fails_ends_the_sweep() {
    let map = ImpactMap::new(Vibration::new(2.0).expect("legal"), 0.5).expect("legal");
    let fast = ImpactState::from_normalised(1.0, 1e12).expect("legal");
    let mut orbits = orbits(30);
    orbits[17] = map.orbit(fast, ChatterPolicy::Complete);
    let error = survival_times(&orbits, 50, &Unobserved).expect_err("too fast");
    assert!(matches!(error, Error::FlightTooLong { .. }), "{error}");
}

#[test]
fn results_come_in_any_order_and_the_first_one_stays() {
    let mut results = PartialResults::new(6);
    results.extend([(4, 'd'), (1, 'a'), (9, 'x'), (1, 'b')]);
    results.extend([(3, 'c'), (4, 'e'), (0, 'f')]);
    let found: Vec<_> = results.iter().map(|(index, result)| (index, *result)).collect();
    assert_eq!(found, [(0, 'f'), (1, 'a'), (3, 'c'), (4, 'd')]);
    assert_eq!(results.open(6), Ok(vec![2, 5]));
    let refusal = Error::Unfitting { what: "items of a run", found: 3, expected: 6 };
    assert_eq!(results.open(3), Err(refusal));
    assert_eq!(results.into_results(), Err(Error::Stopped { done: 4, total: 6 }));
}

#[cfg(feature = "serde")]
#[test]
fn stored_results_that_do_not_fit_are_refused() {
    for (text, complaint) in [
        (r#"{"total":2,"finished":[[2,0.5]]}"#, "index of a finished item: found 2, expected 1"),
        (r#"{"total":0,"finished":[[0,0.5]]}"#, "index of a finished item: found 0"),
        (r#"{"total":3,"finished":[[1,0.5],[0,0.5]]}"#, "out of order"),
        (r#"{"total":3,"finished":[[1,0.5],[1,0.5]]}"#, "out of order"),
        (r#"{"total":-3,"finished":[]}"#, "-3"),
        (r#"{"total":3,"finished":[],"done":0}"#, "done"),
        (r#"{"total":3}"#, "finished"),
    ] {
        let error = serde_json::from_str::<PartialResults<Option<f64>>>(text).expect_err(text).to_string();
        assert!(error.contains(complaint), "{error}");
    }
    // No memory is reserved for missing results.
    let text = r#"{"total":18446744073709551615,"finished":[[0,null],[5,1.5]]}"#;
    let results = serde_json::from_str::<PartialResults<Option<f64>>>(text).expect("legal");
    assert_eq!((results.get(0), results.get(5), results.get(1)), (Some(&None), Some(&Some(1.5)), None));
}
