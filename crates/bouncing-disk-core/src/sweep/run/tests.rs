//! Runs that are stopped, stored, read and resumed, against one call.

use super::*;
use crate::chatter::policy::ChatterPolicy;
use crate::flight::platform::vibration::Vibration;
use crate::map::impact_map::{ImpactMap, ImpactState};
use crate::numerics::testing::Storable;
use crate::numerics::testing::stored;
use crate::run::testing::StopAfter;
use crate::run::{Progress, Unobserved};
use crate::sweep::{orbit_diagram, survival_times, sweep};

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

/// Goes on until all is done, each time stopped a little later and stored in between.
fn in_parts<T: Storable + Send>(
    items: usize,
    threads: usize,
    advance: impl Fn(&mut SweepRun<T>, &dyn Observer) -> Result<(), Error> + Sync,
) -> Vec<T> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("starts");
    let mut run = SweepRun::new(items);
    for stops in 0.. {
        run = stored(&run);
        match pool.install(|| advance(&mut run, &StopAfter::calls(1 + 3 * stops))) {
            Ok(()) => {
                // Each of several threads may finish its last items after another one was stopped.
                assert!(stops >= if threads == 1 { 2 } else { 1 }, "{threads} threads: {stops}");
                // Nothing is left to do or to stop.
                let observer = StopAfter::calls(2);
                let all = run.results().total();
                assert_eq!(advance(&mut run, &observer), Ok(()));
                assert_eq!((observer.asked(), observer.last()), (2, Progress { done: all, total: all }));
                return run.into_results().expect("done");
            }
            Err(error) => {
                let results = run.results();
                assert_eq!(error, results.stopped());
                assert!(!run.is_done());
                assert!(
                    (0..items)
                        .filter(|index| results.get(*index).is_some())
                        .eq(results.iter().map(|(k, _)| k))
                );
            }
        }
    }
    unreachable!()
}

#[test]
fn a_run_that_is_stopped_ends_in_the_results_of_one_call() {
    for count in [5, 11, 300, 1_500] {
        let orbits = orbits(count);
        let impacts = if count < 12 { 12_000 } else { 300 };
        let lives = survival_times(&orbits, impacts, &Unobserved).expect("no failure");
        let columns = orbit_diagram(&orbits, impacts - 100, 100, &Unobserved).expect("no failure");
        let counted = |events: &mut usize, _: &SweepEvent| {
            *events += 1;
            if *events < impacts { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
        };
        let swept = sweep(&orbits, |index| index % 7, counted, &Unobserved).expect("no failure");
        for threads in [1, 2, 7] {
            let items = count as usize;
            let parts = in_parts(items, threads, |run, observer| {
                run.advance_survival_times(&orbits, impacts, observer)
            });
            assert_eq!(parts, lives, "{threads} threads");
            let parts = in_parts(items, threads, |run, observer| {
                run.advance_orbit_diagram(&orbits, impacts - 100, 100, observer)
            });
            assert_eq!(parts, columns, "{threads} threads");
            let parts = in_parts(items, threads, |run, observer| {
                run.advance(&orbits, |index| index % 7, counted, observer)
            });
            assert_eq!(parts, swept, "{threads} threads");
        }
    }
}

/// Alone and in lockstep.
#[test]
fn an_endless_sweep_can_be_stopped() {
    for count in [1, 20] {
        let orbits = &orbits(40)[20..20 + count];
        let mut run = SweepRun::new(count);
        let endless = run.advance(orbits, |_| (), |(), _| ControlFlow::Continue(()), &StopAfter::calls(9));
        assert!(matches!(endless, Err(Error::Stopped { total, .. }) if total == count as u64), "{endless:?}");
    }
}

#[test]
fn an_orbit_that_fails_is_not_finished_and_the_others_are() {
    let map = ImpactMap::new(Vibration::new(2.0).expect("legal"), 0.5).expect("legal");
    let fast = ImpactState::from_normalised(1.0, 1e12).expect("legal");
    let mut orbits = orbits(30);
    orbits[17] = map.orbit(fast, ChatterPolicy::Complete);
    let mut run = SweepRun::new(30);
    for _ in 0..2 {
        let error = run.advance_survival_times(&orbits, 50, &Unobserved).expect_err("too fast");
        assert!(matches!(error, Error::FlightTooLong { .. }), "{error}");
        assert_eq!(run.results().open(30), Ok(vec![17]));
    }
    assert_eq!(run.into_results(), Err(Error::Stopped { done: 29, total: 30 }));
}

#[test]
fn a_run_of_other_orbits_is_refused() {
    let (orbits, mut run) = (orbits(3), SweepRun::new(4));
    let refusal = Err(Error::Unfitting { what: "items of a run", found: 3, expected: 4 });
    assert_eq!(run.advance_survival_times(&orbits, 5, &Unobserved), refusal);
    assert_eq!(run.advance_survival_times(&orbits, 0, &Unobserved), refusal);
}

#[test]
fn results_come_in_any_order_and_the_first_one_stays() {
    let mut results = PartialResults::new(6);
    results.extend([(4, 'd'), (1, 'a'), (9, 'x'), (1, 'b')]);
    results.extend([(3, 'c'), (4, 'e'), (0, 'f')]);
    let found: Vec<_> = results.iter().map(|(index, result)| (index, *result)).collect();
    assert_eq!(found, [(0, 'f'), (1, 'a'), (3, 'c'), (4, 'd')]);
    assert_eq!(results.open(6), Ok(vec![2, 5]));
}

#[cfg(feature = "serde")]
#[test]
fn stored_results_that_do_not_fit_are_refused() {
    for (text, complaint) in [
        (r#"{"total":2,"finished":[[2,0.5]]}"#, "index of a finished item: 2; legal is 1"),
        (r#"{"total":0,"finished":[[0,0.5]]}"#, "index of a finished item: 0"),
        (r#"{"total":3,"finished":[[1,0.5],[0,0.5]]}"#, "out of order"),
        (r#"{"total":3,"finished":[[1,0.5],[1,0.5]]}"#, "out of order"),
        (r#"{"total":-3,"finished":[]}"#, "-3"),
        (r#"{"total":3,"finished":[],"done":0}"#, "done"),
        (r#"{"total":3}"#, "finished"),
    ] {
        let error = serde_json::from_str::<SweepRun<Option<f64>>>(text).expect_err(text).to_string();
        assert!(error.contains(complaint), "{error}");
    }
    // No memory is asked for what is not there.
    let text = r#"{"total":18446744073709551615,"finished":[[0,null],[5,1.5]]}"#;
    let run = serde_json::from_str::<SweepRun<Option<f64>>>(text).expect("legal");
    assert_eq!(
        (run.results().get(0), run.results().get(5), run.results().get(1)),
        (Some(&None), Some(&Some(1.5)), None)
    );
}
