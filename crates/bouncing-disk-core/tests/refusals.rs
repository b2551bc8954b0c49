//! Calls with numbers outside their ranges: each error names the number.

const INF: f64 = f64::INFINITY;
const NAN: f64 = f64::NAN;

use bouncing_disk_core::attractors::{
    AttractorSearch, Axis, Basins, Grid, KnownOrbit, VerdictSettings, verdicts,
};
use bouncing_disk_core::chaos::{CrisisEvent, CrisisSearch, ManifoldSettings, lyapunov_spectra};
use bouncing_disk_core::flight::MAX_FLIGHT_DURATION;
use bouncing_disk_core::map::{Constant, KuwabaraKono};
use bouncing_disk_core::numerics::power_law::{PowerLawPoint, fit_power_law};
use bouncing_disk_core::orbits::{
    Continuation, ContinuationParameter, MAX_PERIOD, OrbitSearch, doubling_cascade,
};
use bouncing_disk_core::sweep::{MAX_RECORDED, orbit_diagram};
use bouncing_disk_core::{
    ChatterCut, ChatterPolicy, Error, ImpactMap, ImpactState, Launch, Orbit, Phase, Unobserved, Vibration,
};

type Table = Vec<(&'static str, Vec<Option<Error>>)>;

/// The errors of a call for each of these arguments.
fn each<A, T>(
    arguments: impl IntoIterator<Item = A>,
    call: impl Fn(A) -> Result<T, Error>,
) -> Vec<Option<Error>> {
    arguments.into_iter().map(|argument| call(argument).err()).collect()
}

fn check(table: Table) {
    for (name, errors) in table {
        for (index, error) in errors.into_iter().enumerate() {
            let named = matches!(error, Some(Error::OutOfRange { field, .. }) if field == name);
            assert!(named, "{name}, number {index}: {error:?}");
        }
    }
}

fn map() -> ImpactMap {
    ImpactMap::new(Vibration::from_axial_forcing(0.45).expect("legal"), 0.5).expect("legal")
}

fn state() -> ImpactState {
    map().period_one(1).expect("exists")
}

#[test]
fn of_one_disk_on_one_platform() {
    let phase = Phase::new(0.3).expect("finite");
    let vibration = Vibration::new(2.0).expect("legal");
    let none = [NAN, INF, -1.0];
    check(vec![
        ("peak_acceleration", each(none, Vibration::new)),
        ("axial_forcing", each(none, Vibration::from_axial_forcing)),
        ("relative_speed", each(none, |speed| Launch::new(phase, speed))),
        ("phase", each([NAN, INF], Phase::new)),
        ("axial_impact_velocity", each([0.1, NAN], |velocity| ImpactState::new(phase, velocity))),
        ("restitution", each([1.0, -0.1, NAN], |restitution| ImpactMap::new(vibration, restitution))),
        ("restitution", each([-f64::MIN_POSITIVE, 1.0, 1.5, NAN, INF], Constant::new)),
        (
            "reference_restitution",
            each([0.0, -0.0, -0.5, 1.0, 1.5, NAN, INF, -INF], |of| KuwabaraKono::new(of, 1.0)),
        ),
        ("reference_speed", each([0.0, -0.0, -1.0, NAN, INF, -INF], |speed| KuwabaraKono::new(0.5, speed))),
        ("smallest_speed", each(none, |speed| ChatterCut::new(speed, 0.0, 1))),
        ("short_flight", each([-1e-9], |flight| ChatterCut::new(0.0, flight, 1))),
        ("short_flights", each([0], |flights| ChatterCut::new(0.0, 0.0, flights))),
    ]);
    let rest = Launch::new(phase, 0.0).expect("legal");
    for peak in [0.0, 0.5, 1.0, 3.0] {
        let refused = Vibration::new(peak).expect("legal").first_impact(rest);
        assert!(matches!(refused, Err(Error::NoLiftOff { .. })), "{peak}: {refused:?}");
    }
    let fast = Launch::new(phase, MAX_FLIGHT_DURATION).expect("legal");
    assert!(matches!(vibration.first_impact(fast), Err(Error::FlightTooLong { .. })));
}

#[test]
fn of_orbits() {
    let legal = Continuation::new(ContinuationParameter::Forcing, (0.1, 0.6), true).expect("legal");
    let over = |parameter| move |range| Continuation::new(parameter, range, true);
    let (forcing, restitution) = (ContinuationParameter::Forcing, ContinuationParameter::Restitution);
    let search = OrbitSearch::new(64, 10_000).expect("legal");
    let settled = |(longest, tolerance)| map().settled_orbit(state(), 0, longest, tolerance, &Unobserved);
    let period = |(longest, tolerance)| map().period_of(state(), longest, tolerance);
    let (long, vague) = ([(0, 1e-8), (usize::MAX, 1e-8), (1 << 63, 1e-8)], [(8, NAN), (8, -1.0)]);
    check(vec![
        ("longest period", [each(long, settled), each(long, period)].concat()),
        ("tolerance", [each(vague, settled), each(vague, period)].concat()),
        (
            "impacts of an orbit",
            each([(0, 1), (65, 1), (usize::MAX, u64::MAX)], |(n, k)| OrbitSearch::new(n, k)),
        ),
        ("platform periods of an orbit", each([(1, 0), (1, 10_001)], |(n, k)| OrbitSearch::new(n, k))),
        ("restitution", each([0.0, 1.0, -0.1, NAN, INF], |of: f64| doubling_cascade(of, 1, &Unobserved))),
        ("count", each([0, 14], |count| doubling_cascade(0.5, count, &Unobserved))),
        ("first step", each([(0.0, 0.1), (0.2, 0.1), (NAN, 0.1)], |(a, b)| legal.with_steps(a, b, 9))),
        ("largest step", each([(0.1, 2.0), (0.1, NAN)], |(a, b)| legal.with_steps(a, b, 9))),
        ("points of a branch", each([1], |points| legal.with_steps(0.1, 0.1, points))),
        ("high end of a continuation", each([(0.5, 0.5), (0.6, 0.5), (0.1, INF)], over(forcing))),
        ("high end of a continuation", each([(0.5, 0.5), (0.5, 1.0), (0.1, INF)], over(restitution))),
        ("low end of a continuation", each([(-1.0, 0.5), (NAN, 1.0)], over(forcing))),
        ("low end of a continuation", each([(-1.0, 0.5), (NAN, 1.0), (0.0, 0.5)], over(restitution))),
    ]);
    for (phases, speeds) in [(1, 2), (2, 1), (4_097, 2), (2, u32::MAX)] {
        assert!(
            matches!(search.with_starts(phases, speeds), Err(Error::OutOfRange { .. })),
            "{phases} {speeds}"
        );
    }
    assert!(map().refine(&[]).is_err());
    assert_eq!(MAX_PERIOD, 4_096);
}

#[test]
fn of_attractors_and_basins() {
    let (search, verdict) = (AttractorSearch::default(), VerdictSettings::default());
    let judged = |settings| verdicts(&[(map(), state())], settings, &Unobserved);
    let axis = |low, high| Axis::new(low, high, 3).expect("legal");
    let ordinary = axis(0.0, 1.0);
    let orbit = map().refine(&[state()]).expect("refines");
    let small = Basins::of_labels(vec![1; 9 * 40], 9).expect("legal");
    let one = Basins::of_labels(vec![1], 1).expect("legal");
    let apart = [&[0][..], &[1, 1], &[2, 1], &[1, 5], &[usize::MAX]];
    check(vec![
        ("impacts", each([63], |impacts| judged(VerdictSettings { impacts, ..verdict }))),
        (
            "longest period",
            each([0, 4_097, usize::MAX], |longest_period| {
                judged(VerdictSettings { longest_period, ..verdict })
            }),
        ),
        (
            "tolerance",
            each([0.0, -1.0, 0.011, NAN, INF], |tolerance| judged(VerdictSettings { tolerance, ..verdict })),
        ),
        ("starts", each([AttractorSearch::MAX_STARTS + 1], |starts| search.with_starts(starts))),
        ("transient", each([0, u64::MAX], |transient| search.with_impacts(transient, 100))),
        ("impacts", each([63], |impacts| search.with_impacts(10, impacts))),
        ("longest period", each([0, 4_097], |longest| search.with_longest_period(longest))),
        ("cells along an axis", each([7, u32::MAX], |cells| search.with_cells(cells))),
        ("axis high end", each([(0.0, 0.0), (1.0, 0.0), (f64::MIN, f64::MAX)], |(a, b)| Axis::new(a, b, 3))),
        ("axis cells", each([0], |cells| Axis::new(0.0, 1.0, cells))),
        ("impact phase", each([(0.0, 1e300), (-1e16, 1.0)], |(a, b)| Grid::new(axis(a, b), ordinary))),
        ("highest normalised speed", each([1.7e308], |high| Grid::new(ordinary, axis(0.0, high)))),
        ("lowest normalised speed", each([-1.0], |low| Grid::new(ordinary, axis(low, 1.0)))),
        ("attraction radius", each([NAN, -1.0, INF, -INF], |radius| KnownOrbit::new(orbit.clone(), radius))),
        ("distance of cells", each(apart, |distances| small.boundary_scaling(distances, &Unobserved))),
        ("distance of cells", each([1], |distance| one.boundary_scaling(&[distance], &Unobserved))),
    ]);
    for side in [0, 1, 10, usize::MAX] {
        assert!(matches!(small.entropy(side), Err(Error::OutOfRange { .. })), "{side}");
    }
    assert!(small.boundary_scaling(&[1, 4], &Unobserved).is_ok() && small.entropy(9).is_ok());
    assert!(one.boundary_scaling(&[], &Unobserved).is_ok());
}

#[test]
fn of_chaos_and_laws() {
    let manifold = ManifoldSettings::new(1.0, 20_000).expect("legal");
    let crisis = CrisisSearch::new(0.5, (0.5, 0.6)).expect("legal");
    let between = |(low, high)| CrisisSearch::new(0.5, (low, high));
    let good = PowerLawPoint { x: 1.0, y: 1.0, relative_error: 0.1 };
    let starts = [(map(), state())];
    check(vec![
        ("impacts", each([0, 15], |impacts| lyapunov_spectra(&starts, 0, impacts, &Unobserved))),
        ("arclength of a manifold", each([0.0, NAN, 2e6], |arclength| ManifoldSettings::new(arclength, 100))),
        ("points of a manifold", each([15, 10_000_001], |points| ManifoldSettings::new(1.0, points))),
        ("chord of a manifold", each([0.0], |chord| manifold.with_resolution(chord, 0.1))),
        ("turn of a manifold", each([NAN], |turn| manifold.with_resolution(0.1, turn))),
        ("generations of a manifold", each([0, 10_001], |count| manifold.with_generations(count))),
        ("launch speed of a manifold", each([NAN, -1.0, INF], |speed| manifold.with_launch_speed(speed))),
        (
            "restitution of a crisis",
            each([0.0, 1.0, NAN], |restitution| CrisisSearch::new(restitution, (0.5, 0.6))),
        ),
        ("forcing below a crisis", each([(-0.1, 0.6), (NAN, 0.6)], between)),
        ("forcing beyond a crisis", each([(0.6, 0.6), (0.5, INF)], between)),
        ("samples of a crisis", each([15], |samples| crisis.with_samples(samples, 100_000))),
        ("impacts of a crisis", each([9_999], |impacts| crisis.with_samples(64, impacts))),
        ("bands of a crisis", each([0, 17], |bands| crisis.for_event(CrisisEvent::BandMerging { bands }))),
    ]);
    for bad in [0.0, -1.0, NAN, INF, 5e-324] {
        for point in [
            PowerLawPoint { x: bad, ..good },
            PowerLawPoint { y: bad, ..good },
            PowerLawPoint { relative_error: bad, ..good },
        ] {
            assert!(matches!(fit_power_law(&[point]), Err(Error::OutOfRange { .. })), "{bad}");
        }
    }
    let orbits = vec![map().orbit(state(), ChatterPolicy::Complete); 20];
    for recorded in [usize::MAX, 1 << 40] {
        let error = orbit_diagram(&orbits, 0, recorded, &Unobserved).expect_err("too many");
        let count = 20_u64.saturating_mul(recorded as u64);
        assert_eq!(error, Error::TooLarge { what: "recorded impacts", count, limit: MAX_RECORDED });
    }
    assert_eq!(orbit_diagram::<Orbit>(&[], 0, usize::MAX, &Unobserved), Ok(Vec::new()));
    assert_eq!(lyapunov_spectra::<ImpactMap>(&[], 0, 16, &Unobserved), Ok(Vec::new()));
}
