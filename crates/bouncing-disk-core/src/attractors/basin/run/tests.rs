//! Runs that are stopped, stored, read and resumed, against one call.

use core::ops::ControlFlow;
use core::sync::atomic::{AtomicU64, Ordering};

use super::*;
use crate::attractors::basin::{ATTACHED, Axis, FIRST_ORBIT};
use crate::chatter::policy::ChatterPolicy;
use crate::chatter::policy::PAPER_POLICY;
use crate::flight::platform::vibration::Vibration;
use crate::map::impact_map::ImpactState;
use crate::numerics::testing::stored;
use crate::orbits::periodic::PeriodicOrbit;
use crate::run::testing::StopAfter;
use crate::run::{Progress, Unobserved};

fn map() -> ImpactMap {
    ImpactMap::new(Vibration::from_axial_forcing(0.5).expect("legal"), 0.5).expect("legal")
}

fn grid(columns: usize, rows: usize) -> Grid {
    let axis = |high, cells| Axis::new(0.0, high, cells).expect("legal");
    Grid::new(axis(1.0, columns), axis(2.0, rows)).expect("legal")
}

fn known() -> Vec<KnownOrbit> {
    let start = ImpactState::from_normalised(0.8, 1.3).expect("legal");
    let orbit =
        map().settled_orbit(start, 4_000, 4, 1e-8, &Unobserved).expect("no failure").expect("settles");
    vec![KnownOrbit::new(orbit, 0.01).expect("legal")]
}

fn on<T: Send>(threads: usize, work: impl FnOnce() -> T + Send) -> T {
    rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("starts").install(work)
}

/// Goes on until all is done, each time stopped after so many calls and stored in between; how often it was
/// stopped.
fn in_parts(mut run: BasinRun, threads: usize, calls: impl Fn(u64) -> u64 + Sync) -> (Basins, u64) {
    for stops in 0.. {
        run = stored(&run);
        match on(threads, || run.advance(&StopAfter::calls(calls(stops)))) {
            Ok(()) => return (stored(&run).into_basins().expect("done"), stops),
            Err(Error::Stopped { done, total }) => {
                assert_eq!((done, total), (run.done(), run.total()));
                assert_eq!(run.clone().into_basins(), Err(Error::Stopped { done, total }));
            }
            Err(error) => panic!("{error}"),
        }
    }
    unreachable!()
}

#[test]
fn a_run_that_is_stopped_ends_in_the_labels_of_one_call() {
    let (map, known) = (map(), known());
    for (policy, columns, rows) in [(ChatterPolicy::Complete, 150, 230), (PAPER_POLICY, 40, 60)] {
        let settings = BasinSettings { max_impacts: 400, policy };
        let at_once = map.basins(grid(columns, rows), &known, settings, &Unobserved).expect("no failure");
        assert!(at_once.fraction(ATTACHED) > 0.1 && at_once.fraction(FIRST_ORBIT) > 0.1);
        for threads in [1, 2, 7] {
            // Stopped at the first call, before anything is begun, then later and later.
            let run = BasinRun::new(map, grid(columns, rows), &known, settings).expect("few cells");
            let (basins, stops) = in_parts(run, threads, |stops| 1 + stops);
            assert_eq!(basins, at_once, "{threads} threads");
            // Each of several threads may finish its last cells after another one was stopped.
            assert!(stops >= if threads == 1 { 3 } else { 1 }, "{threads} threads: {stops}");
        }
    }
}

/// Nothing is computed twice, and nothing is left to stop.
#[test]
fn a_run_that_is_done_stays_so() {
    let mut run = BasinRun::new(map(), grid(30, 20), &known(), BasinSettings::default()).expect("few cells");
    run.advance(&Unobserved).expect("no failure");
    let mut again = stored(&run);
    let observer = StopAfter::calls(2);
    assert_eq!(again.advance(&observer), Ok(()));
    assert_eq!((observer.asked(), observer.last()), (2, Progress { done: 20, total: 20 }));
    assert_eq!(again, run);
    assert_eq!(run.row(19).map(<[Label]>::len), Some(30));
    assert_eq!(run.row(20), None);
}

/// Also where every start is decided at once, and where one row holds all cells.
#[test]
fn observers_hear_of_all_rows_and_often() {
    for (columns, rows, radius) in [(1, 1, 0.01), (3, 50, 0.01), (70, 131, 10.0), (30_000, 2, 10.0)] {
        for threads in [1, 2, 7] {
            let (calls, most) = (AtomicU64::new(0), AtomicU64::new(0));
            let observer = |progress: Progress| {
                calls.fetch_add(1, Ordering::Relaxed);
                most.fetch_max(progress.done, Ordering::Relaxed);
                assert_eq!(progress.total, rows as u64);
                ControlFlow::Continue(())
            };
            let known = [KnownOrbit::new(known()[0].orbit().clone(), radius).expect("legal")];
            let settings = BasinSettings { max_impacts: 50, ..BasinSettings::default() };
            let basins = on(threads, || map().basins(grid(columns, rows), &known, settings, &observer));
            assert_eq!(basins.expect("no failure").labels().len(), columns * rows);
            assert_eq!(most.into_inner(), rows as u64, "{columns} by {rows}, {threads} threads");
            let least = 2 + (columns * rows / 10_000 / threads) as u64;
            assert!(calls.into_inner() >= least, "{columns} by {rows}, {threads} threads");
        }
    }
}

/// More known impacts than a batch is compared with at once: the first orbit that catches a start has it, and
/// an observer is asked in between. Stopped at each of the calls, a run comes to the same labels.
#[test]
fn many_known_orbits_are_compared_in_parts() {
    let (map, settings) = (map(), BasinSettings { max_impacts: 60, ..BasinSettings::default() });
    let orbit = known()[0].orbit().clone();
    let some = KnownOrbit::new(orbit.clone(), 0.02).expect("legal");
    let more = KnownOrbit::new(orbit.clone(), 0.05).expect("legal");
    // Many impacts at the same two places that catch nothing.
    let none = PeriodicOrbit { states: orbit.states.repeat(2_000), ..orbit };
    let none = KnownOrbit::new(none, f64::MIN_POSITIVE).expect("legal");
    for many in [1, 5] {
        let mut known = vec![none.clone(); many];
        known.extend([some.clone(), more.clone()]);
        let own = Label::try_from(many).expect("few");
        let observer = StopAfter::calls(u64::MAX);
        let at_once = map.basins(grid(20, 10), &known, settings, &observer).expect("no failure");
        let caught = (at_once.fraction(FIRST_ORBIT + own), at_once.fraction(FIRST_ORBIT + own + 1));
        assert!(caught.0 > 0.01 && caught.1 > 0.01, "{caught:?}");
        let few = map.basins(grid(20, 10), &known[many..], settings, &Unobserved).expect("no failure");
        let labels = few.labels().iter().map(|&label| if label < FIRST_ORBIT { label } else { label + own });
        assert_eq!(at_once.labels(), labels.collect::<Vec<_>>());
        // One batch is enough to be asked between the parts: one part is of 4,096 impacts.
        let cell = StopAfter::calls(u64::MAX);
        map.basins(grid(1, 1), &known, settings, &cell).expect("no failure");
        assert!(many == 1 || cell.asked() > many as u64, "{}", cell.asked());
        let run = BasinRun::new(map, grid(20, 10), &known, settings).expect("few cells");
        let (basins, stops) = in_parts(run, 1, |stops| 1 + 4 * stops);
        assert_eq!(basins, at_once);
        assert!(stops >= 2, "{stops}");
    }
}

/// A start that is followed for ever.
#[test]
fn one_endless_start_can_be_stopped() {
    let chaos = ImpactMap::new(Vibration::from_axial_forcing(0.55).expect("legal"), 0.5).expect("legal");
    for policy in [ChatterPolicy::Complete, PAPER_POLICY] {
        let settings = BasinSettings { max_impacts: u32::MAX, policy };
        let one =
            Grid::new(Axis::new(0.12, 0.13, 1).expect("legal"), Axis::new(1.29, 1.31, 1).expect("legal"));
        let basins = chaos.basins(one.expect("legal"), &[], settings, &StopAfter::calls(5));
        assert_eq!(basins, Err(Error::Stopped { done: 0, total: 1 }));
    }
}

#[test]
fn a_failure_leaves_what_was_finished() {
    let axis = |high, cells| Axis::new(0.0, high, cells).expect("legal");
    // The upper rows are too fast for a flight.
    let grid = Grid::new(axis(1.0, 40), axis(4.0e9, 80)).expect("legal");
    let settings = BasinSettings { max_impacts: 30, ..BasinSettings::default() };
    let mut run = BasinRun::new(map(), grid, &[], settings).expect("few cells");
    for _ in 0..2 {
        let error = on(1, || run.advance(&Unobserved)).expect_err("too fast");
        assert!(matches!(error, Error::FlightTooLong { .. }), "{error}");
        assert_eq!(stored(&run), run);
    }
}

#[cfg(feature = "serde")]
#[test]
fn a_stored_run_that_does_not_fit_is_refused() {
    let mut run = BasinRun::new(map(), grid(2, 3), &known(), BasinSettings::default()).expect("few cells");
    run.advance(&Unobserved).expect("no failure");
    run.finished[1] = false;
    let text = serde_json::to_string(&run).expect("writes");
    let labels = text.split("\"labels\":").nth(1).expect("has labels").trim_end_matches('}').to_owned();
    assert!(text.contains("\"finished_rows\":[0,2]"), "{text}");
    for (good, bad, complaint) in [
        ("[0,2]", "[0,3]", "finished row of a basin run: 3; legal is 2"),
        ("[0,2]", "[2,0]", "out of order"),
        ("[0,2]", "[2,2]", "out of order"),
        ("[0,2]", "[0]", "labels of a basin run: 4; legal is 2"),
        (&*labels, "[1,1,1,3]", "label of a basin run: 3; legal is 2"),
        (&*labels, "[1,1,1]", "labels of a basin run: 3; legal is 4"),
        (&*labels, "[1,1,1,256]", "256"),
        ("\"finished_rows\"", "\"finished\"", "finished"),
        ("\"radius\":0.01", "\"radius\":-0.01", "attraction radius"),
        ("\"restitution\":0.5", "\"restitution\":1.5", "restitution"),
        ("\"cells\":3", "\"cells\":0", "axis cells"),
    ] {
        assert!(text.contains(good), "{good}");
        let error = serde_json::from_str::<BasinRun>(&text.replace(good, bad)).expect_err(bad).to_string();
        assert!(error.contains(complaint), "{error}");
    }
}

#[test]
fn parts_of_the_rows_have_the_labels_of_the_whole() {
    let (map, known, grid) = (map(), known(), grid(30, 23));
    let settings = BasinSettings { max_impacts: 400, ..BasinSettings::default() };
    let whole = map.basins(grid, &known, settings, &Unobserved).expect("no failure");
    let begin = || BasinRun::new(map, grid, &known, settings).expect("few cells");
    for part in [0..23, 0..1, 5..11, 22..23, 7..7, 20..90, 90..99] {
        let mut run = begin();
        run.advance_rows(part.clone(), &Unobserved).expect("no failure");
        for row in 0..23 {
            assert_eq!(run.row(row), part.contains(&row).then(|| whole.row(row)), "{part:?}: {row}");
        }
    }
    // One part after the other, each stopped at first, ends in the whole.
    let mut run = begin();
    for part in [11..23, 0..11] {
        let stopped = run.advance_rows(part.clone(), &StopAfter::calls(1));
        assert!(matches!(stopped, Err(Error::Stopped { .. })), "{stopped:?}");
        run.advance_rows(part, &Unobserved).expect("no failure");
    }
    assert_eq!(run.into_basins(), Ok(whole));
}
