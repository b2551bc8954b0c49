//! Long calls on any number of threads, watched and stopped at any call of their observer: they report their
//! progress or give the same result.

use std::fmt::Debug;
use std::ops::ControlFlow;
use std::sync::Mutex;

use bouncing_disk_core::attractors::{
    AttractorSearch, Axis, BasinSettings, Basins, Grid, KnownOrbit, VerdictSettings, basin_fractions_over,
    verdicts,
};
use bouncing_disk_core::chaos::{
    CrisisSearch, ManifoldKind, ManifoldSettings, lyapunov_exponents, lyapunov_spectra,
};
use bouncing_disk_core::orbits::{
    Continuation, ContinuationParameter, ContinuedMap as _, OrbitSearch, PeriodicOrbit, doubling_cascade,
};
use bouncing_disk_core::run::FLIGHTS_BETWEEN_CALLS;
use bouncing_disk_core::sweep::{SweepEvent, orbit_diagram, survival_times, sweep};
use bouncing_disk_core::{
    ChatterCut, ChatterPolicy, Error, ImpactMap, ImpactState, Observer, Orbit, Progress, Unobserved,
    Vibration,
};

/// An observer that breaks at its nth call and at every later one.
struct StopAfter {
    calls: u64,
    /// The number of calls, and the last progress.
    seen: Mutex<(u64, Progress)>,
}

impl StopAfter {
    fn calls(calls: u64) -> Self {
        Self { calls, seen: Mutex::default() }
    }

    fn seen(&self) -> (u64, Progress) {
        *self.seen.lock().expect("no panic")
    }
}

impl Observer for StopAfter {
    fn observe(&self, progress: Progress) -> ControlFlow<()> {
        let mut seen = self.seen.lock().expect("no panic");
        *seen = (seen.0 + 1, progress);
        assert!(progress.done <= progress.total, "{progress:?}");
        if seen.0 < self.calls { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    }
}

fn on<T: Send>(threads: usize, work: impl FnOnce() -> T + Send) -> T {
    rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("starts").install(work)
}

/// Checks a call with this many items, stopped at every call of its observer on one thread if there are few.
fn check<T: PartialEq + Debug + Send + Sync>(
    name: &str,
    items: u64,
    call: impl Fn(&dyn Observer) -> Result<T, Error> + Sync,
) {
    let whole = call(&Unobserved).expect("no failure");
    for threads in [1, 2, 7] {
        let patient = StopAfter::calls(u64::MAX);
        assert_eq!(on(threads, || call(&patient)).as_ref(), Ok(&whole), "{name} on {threads} threads");
        let (all, last) = patient.seen();
        assert_eq!(last, Progress { done: items, total: items }, "{name} on {threads} threads");
        assert!(all > 2, "{name}: nobody is asked on the way");
        let mut stops = 0;
        let few = threads == 1 && all <= 100;
        let stops_at = if few { (1..=all).collect() } else { vec![1, 2, 3, all / 2, all - 1, all] };
        for calls in stops_at {
            if !(1..=all).contains(&calls) {
                continue;
            }
            let observer = StopAfter::calls(calls);
            let at = || format!("{name} on {threads} threads, stopped at call {calls} of {all}");
            match on(threads, || call(&observer)) {
                Ok(found) => assert!(found == whole && calls > 1, "{}", at()),
                Err(Error::Stopped { done, total }) => {
                    assert!(total == items && done <= total, "{}: {done} of {total}", at());
                    // There are no further calls, except for the ends of a part and of the whole if they were
                    // still completed.
                    assert!(threads > 1 || observer.seen().0 <= calls + 2, "{}: {:?}", at(), observer.seen());
                    stops += 1;
                }
                Err(error) => panic!("{}: {error}", at()),
            }
        }
        assert!(stops >= if all > 3 && threads == 1 { 2 } else { 1 }, "{name} on {threads} threads: {stops}");
    }
}

/// Checks a call that would take a very long time, on one thread that counts every flight.
fn check_endless<T: Debug + Send>(
    name: &str,
    done: std::ops::RangeInclusive<u64>,
    call: impl Fn(&dyn Observer) -> Result<T, Error> + Sync + Send,
) {
    match on(1, || call(&StopAfter::calls(3))) {
        Err(Error::Stopped { done: found, .. }) => assert!(done.contains(&found), "{name}: {found}"),
        other => panic!("{name}: {other:?}"),
    }
}

fn map(axial_forcing: f64, restitution: f64) -> ImpactMap {
    ImpactMap::new(Vibration::from_axial_forcing(axial_forcing).expect("legal"), restitution).expect("legal")
}

fn start() -> ImpactState {
    ImpactState::from_normalised(0.8, 1.3).expect("legal")
}

/// From rest to chaos.
fn starts(count: u32) -> Vec<(ImpactMap, ImpactState)> {
    let forcing = |k: u32| 0.3 + 0.3 * f64::from(k) / f64::from(count);
    (0..count).map(|k| (map(forcing(k), 0.5), start())).collect()
}

fn orbits(count: u32) -> Vec<Orbit> {
    starts(count).iter().map(|(map, start)| map.orbit(*start, ChatterPolicy::Complete)).collect()
}

fn grid(columns: usize, rows: usize) -> Grid {
    let axis = |high, cells| Axis::new(0.0, high, cells).expect("legal");
    Grid::new(axis(1.0, columns), axis(3.0, rows)).expect("legal")
}

fn node(map: &ImpactMap) -> PeriodicOrbit {
    map.period_one_pair(1).expect("exists").node.orbit(map).expect("flies").expect("admissible")
}

fn cut() -> ChatterPolicy {
    ChatterPolicy::Cut(ChatterCut::new(1e-6, 1e-4, 20).expect("legal"))
}

/// A quick search.
fn quick(starts: u32) -> AttractorSearch {
    let search = AttractorSearch::default().with_starts(starts).expect("legal");
    search.with_impacts(500, 4_000).expect("legal").with_orbits(None)
}

/// One by one, in lockstep, and with more lanes than threads have at once.
#[test]
fn sweeps() {
    for (count, impacts) in [(5, 12_000), (11, 12_000), (300, 300), (1_500, 300)] {
        let orbits = orbits(count);
        check("survival times", count.into(), |observer| survival_times(&orbits, impacts, observer));
        check("columns", count.into(), |observer| orbit_diagram(&orbits, impacts - 100, 100, observer));
        check("sweep", count.into(), |observer| {
            let counted = |events: &mut usize, _: &SweepEvent| {
                *events += 1;
                if *events < impacts { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
            };
            sweep(&orbits, |index| index % 7, counted, observer)
        });
    }
    let starts = starts(200);
    check("exponents", 200, |observer| lyapunov_exponents(&starts, 100, 2_000, observer));
    check("spectra", 200, |observer| {
        // NaN does not equal itself.
        lyapunov_spectra(&starts, 100, 2_000, observer).map(|all| format!("{all:?}"))
    });
    let settings = VerdictSettings { impacts: 2_000, transient: 500, ..VerdictSettings::default() };
    check("verdicts", 200, |observer| verdicts(&starts, settings, observer));
}

#[test]
fn attractors_and_basins() {
    let own = map(0.5, 0.5);
    let orbit =
        own.settled_orbit(start(), 4_000, 4, 1e-8, &Unobserved).expect("no failure").expect("settles");
    let known = [KnownOrbit::new(orbit, 0.01).expect("legal")];
    for (policy, columns, rows) in [(ChatterPolicy::Complete, 100, 130), (cut(), 40, 60)] {
        let settings = BasinSettings { max_impacts: 400, policy };
        check("basins", rows as u64, |observer| own.basins(grid(columns, rows), &known, settings, observer));
    }
    let settings = BasinSettings { max_impacts: 400, ..BasinSettings::default() };
    for forcing in [0.486, 0.55] {
        let map = map(forcing, 0.5);
        check("attractors", 200, |observer| map.attractors(&quick(100), observer));
        let found = map.attractors(&quick(100), &Unobserved).expect("no failure");
        // Chaotic starts are compared with the cells a second time.
        let twice = if forcing > 0.5 { 2 } else { 1 };
        let grid = grid(60, 50);
        check("basins of all", 50 * twice, |observer| found.basins(grid, settings, observer));
        check("rows", 46 * twice, |observer| found.basins_of_rows(grid, 2..48, settings, observer));
    }
    check("shares", 3, |observer| basin_fractions_over(0.5, &[0.5, 0.51, 0.52], &quick(100), 0.3, observer));
    let halves = (0..100).flat_map(|row| std::iter::repeat_n(if row < 50 { 1 } else { 2 }, 3_000));
    let halves = Basins::of_labels(halves.collect(), 3_000).expect("legal");
    check("boundary", 3 * 92, |observer| halves.boundary_scaling(&[1, 2, 4], observer));
    let map = map(0.45, 0.5);
    let orbit = node(&map);
    // Fourteen halvings, and seventeen wider circles with four times as many starts.
    check("radius", 5_248, |observer| orbit.trapping_radius(&map, 64, observer));
}

#[test]
fn orbits_and_branches() {
    let own = map(0.5, 0.5);
    let search = OrbitSearch::new(1, 1).expect("legal").with_starts(4_096, 2).expect("legal");
    check("periodic orbits", 8_192, |observer| own.periodic_orbits(&search, observer));
    check("settled orbit", 20_212, |observer| own.settled_orbit(start(), 20_000, 4, 1e-8, observer));
    check("cascade", 12, |observer| doubling_cascade(0.5, 12, observer));
    let map = map(1.0 / 3.0 + 0.1, 0.5);
    let orbit = node(&map);
    let settings = Continuation::new(ContinuationParameter::Forcing, (0.3, 0.52), true).expect("legal");
    let settings = settings.with_steps(1e-4, 1e-4, 20_000).expect("legal");
    // Includes locating a doubling, and the branch that begins there.
    check("branch", 20_000, |observer| map.continued(&orbit, &settings, observer));
    let branch = map.continued(&orbit, &settings, &Unobserved).expect("continued");
    check("doubled branch", 20_000, |observer| branch.switched(0, &settings, observer));
    check("doublings", 2, |observer| map.doublings(&orbit, &settings, 2, observer));
}

#[test]
fn manifolds_and_crises() {
    let map = map(0.561, 0.5);
    let saddle = map.period_one_pair(1).expect("exists").saddle.orbit(&map);
    let saddle = saddle.expect("flies").expect("admissible");
    let settings = ManifoldSettings::new(600.0, 20_000).expect("legal");
    check("manifold", 40_000, |observer| map.manifold(&saddle, ManifoldKind::Stable, &settings, observer));
    let search = CrisisSearch::new(0.5, (0.5595, 0.5615)).and_then(|own| own.with_samples(64, 20_000));
    let search = search.expect("legal");
    let stopped = search.crisis(None, &StopAfter::calls(3));
    assert!(matches!(stopped, Err(Error::Stopped { .. })), "{stopped:?}");
    if let Ok(crisis) = search.crisis(None, &Unobserved).expect("no failure") {
        let stopped = crisis.lives(&[4e-4, 2e-4], 20, 1_000, &StopAfter::calls(2));
        assert!(matches!(stopped, Err(Error::Stopped { .. })), "{stopped:?}");
    }
}

/// The second call of an observer comes after [`FLIGHTS_BETWEEN_CALLS`] flights, the third after as many
/// again.
#[test]
fn calls_that_never_end_can_be_stopped() {
    const TWICE: u64 = 2 * FLIGHTS_BETWEEN_CALLS;
    let (chaos, doubled) = (map(0.55, 0.5), map(0.5, 0.5));
    for policy in [ChatterPolicy::Complete, cut()] {
        check_endless("transient", TWICE..=TWICE, |observer| {
            chaos.state_after(start(), usize::MAX, policy, observer)
        });
        let settings = BasinSettings { max_impacts: u32::MAX, policy };
        let (phase, speed) = (Axis::new(0.12, 0.13, 1), Axis::new(1.29, 1.31, 1));
        let one = Grid::new(phase.expect("legal"), speed.expect("legal")).expect("legal");
        check_endless("one start", 0..=0, |observer| chaos.basins(one, &[], settings, observer));
    }
    check_endless("steps", TWICE..=TWICE, |observer| chaos.iterate(start(), u64::MAX, observer));
    check_endless("settled orbit", TWICE..=TWICE, |observer| {
        doubled.settled_orbit(start(), usize::MAX, 4, 1e-8, observer)
    });
    for count in [1, 20] {
        let orbits = &orbits(40)[20..20 + count];
        check_endless("sweep", 0..=count as u64, |observer| {
            sweep(orbits, |_| (), |(), _| ControlFlow::Continue(()), observer)
        });
    }
    let own = map(1.0 / 3.0 + 0.1, 0.5);
    let many = Continuation::new(ContinuationParameter::Forcing, (0.1, 0.6), true).expect("legal");
    let many = many.with_steps(1e-9, 1e-9, 1_000_000).expect("legal");
    check_endless("branch", 1..=1_000_000, |observer| own.continued(&node(&own), &many, observer));
    check_endless("radius", 1..=16_400, |observer| node(&own).trapping_radius(&own, u32::MAX, observer));
}
