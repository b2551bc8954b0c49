//! Grids that are observed, stopped and computed in parts.

use core::ops::ControlFlow;
use core::sync::atomic::{AtomicU64, Ordering};

use super::*;
use crate::attractors::basin::{Axis, FIRST_ORBIT};
use crate::flight::platform::vibration::Vibration;
use crate::map::impact_map::ImpactState;
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

/// Includes a grid whose starts are all decided at once, and one with all cells in one row.
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

/// More known impacts than a batch is compared with at once: the first orbit that captures a start decides
/// its label, and the observer is called in between.
#[test]
fn many_known_orbits_are_compared_in_parts() {
    let (map, settings) = (map(), BasinSettings { max_impacts: 60, ..BasinSettings::default() });
    let orbit = known()[0].orbit().clone();
    let some = KnownOrbit::new(orbit.clone(), 0.02).expect("legal");
    let more = KnownOrbit::new(orbit.clone(), 0.05).expect("legal");
    // Many impacts at the same two places that capture nothing.
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
        // One batch is enough for a call between the parts, of 4,096 impacts each.
        let cell = StopAfter::calls(u64::MAX);
        map.basins(grid(1, 1), &known, settings, &cell).expect("no failure");
        assert!(many == 1 || cell.asked() > many as u64, "{}", cell.asked());
    }
}

#[test]
fn a_flight_that_is_too_long_ends_the_grid() {
    let axis = |high, cells| Axis::new(0.0, high, cells).expect("legal");
    // The upper rows are too fast for a flight.
    let grid = Grid::new(axis(1.0, 40), axis(4.0e9, 80)).expect("legal");
    let settings = BasinSettings { max_impacts: 30, ..BasinSettings::default() };
    for threads in [1, 2, 7] {
        let error = on(threads, || map().basins(grid, &[], settings, &Unobserved)).expect_err("too fast");
        assert!(matches!(error, Error::FlightTooLong { .. }), "{error}");
    }
}

#[test]
fn parts_of_the_rows_have_the_labels_of_the_whole() {
    let (map, known, grid) = (map(), known(), grid(30, 23));
    let settings = BasinSettings { max_impacts: 400, ..BasinSettings::default() };
    let whole = map.basins(grid, &known, settings, &Unobserved).expect("no failure");
    for part in [0..23, 0..1, 5..11, 22..23, 7..7, 20..90, 90..99] {
        let labels = map.labels_of_rows(grid, part.clone(), &known, settings, &Unobserved);
        for (row, own) in labels.expect("no failure").chunks_exact(30).enumerate() {
            let undecided = [UNDECIDED; 30];
            let expected = if part.contains(&row) { whole.row(row) } else { &undecided };
            assert_eq!(own, expected, "{part:?}: {row}");
        }
    }
}
