//! Branches on drives and compliant contacts, against closed forms and programs that are independent of the
//! equations of a branch.
//!
//! On 24 sums of three harmonics 84 folds and 38 doublings of one impact satisfy s' = k pi (1 - r)/(1 + r)
//! and s'' = 0 or -2 (1 + r^2)/(1 + r)^2 to 1e-12. Compliant branches have the multipliers of differences of
//! the map. For 83 of 84 doublings on the sine and on the sine as a sum the stated error covers the
//! difference from the cascade in double-doubles.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::f64::consts::{PI, TAU};

use bouncing_disk_core::numerics::elementary::hypot;
use bouncing_disk_core::numerics::random::SplitMix64;
use bouncing_disk_core::orbits::{
    BifurcationKind, Branch, BranchEnd, BranchPoint, ClosingMap as _, Continuation, ContinuationParameter,
    ContinuedMap as _, OrbitSearch, PeriodicOrbit, Stability, doubling_cascade,
};
use bouncing_disk_core::{Error, ImpactMap, ImpactState, Phase, Unobserved, Vibration};
use bouncing_disk_drives::{Drive, DrivenFamily, DrivenMap, driven_doubling_cascade};

const NUMBER: ContinuationParameter = ContinuationParameter::Number;

fn continuation(low: f64, high: f64, rising: bool) -> Continuation {
    Continuation::new(NUMBER, (low, high), rising).unwrap()
}

/// The branch through the first stable orbit with these numbers of impacts and periods.
fn branch(
    family: &DrivenFamily,
    impacts: usize,
    periods: u64,
    settings: &Continuation,
) -> Branch<DrivenFamily> {
    let search = OrbitSearch::new(impacts, periods).unwrap().with_starts(16, 16).unwrap();
    let found = family.map().periodic_orbits(&search, &Unobserved).unwrap();
    let stable = |orbit: &&PeriodicOrbit| orbit.period() == impacts && orbit.stability() == Stability::Stable;
    let orbit = found.iter().find(stable).expect("exists");
    family.continued(orbit, settings, &Unobserved).unwrap()
}

fn places(branch: &Branch<DrivenFamily>, kind: BifurcationKind) -> Vec<f64> {
    branch.of_kind(kind).map(|found| found.point.parameter).collect()
}

/// Every point is an orbit of its map, by single steps.
fn check_points(branch: &Branch<DrivenFamily>) {
    for point in &branch.points {
        let map = branch.map_at(point.parameter).unwrap();
        let states = &point.orbit.states;
        for (i, state) in states.iter().enumerate() {
            let (impact, next) = (map.map().step(*state).unwrap().impact, states[(i + 1) % states.len()]);
            let apart = (impact.phase.angle() - next.phase().angle()).abs();
            let velocity = (impact.velocity - next.velocity()).abs();
            // If a force only touches zero, the release is uncertain by the square root of the rounding.
            let room = if point.orbit.trace_error < f64::MAX { 1e-7 } else { 1e-6 };
            assert!(apart.min(TAU - apart) < room && velocity < room, "{apart:e} {velocity:e} {i} {point:?}");
        }
    }
}

/// A sum of three harmonics, scaled by an amplitude.
fn sum(
    shape: [(f64, f64); 3],
    restitution: f64,
) -> impl Fn(f64) -> Option<DrivenMap> + Copy + Send + Sync + 'static {
    move |forcing| {
        let harmonics = shape.map(|(size, phase)| (PI * forcing * size, phase));
        DrivenMap::new(Drive::fourier(&harmonics).ok()?, restitution).ok()
    }
}

#[test]
fn the_sine_as_a_sum_has_the_branches_of_the_sine() {
    for r in [0.2, 0.5, 0.8] {
        let fold = (1.0 - r) / (1.0 + r);
        let first = ImpactMap::first_doubling_forcing(r);
        let start = 0.5 * (fold + first);
        let with = sum([(1.0, 0.0), (0.0, 0.0), (0.0, 0.0)], r);
        let family = DrivenFamily::new(start, start, with).unwrap();
        let sine = ImpactMap::new(Vibration::from_axial_forcing(start).unwrap(), r).unwrap();
        let orbit = sine.refine(&[sine.period_one(1).unwrap()]).unwrap();
        for rising in [true, false] {
            let range = (0.5 * fold, 1.2 * first);
            let own = family.continued(&orbit, &continuation(range.0, range.1, rising), &Unobserved).unwrap();
            check_points(&own);
            let other = family.with_parameter(NUMBER, 1.001 * start).unwrap();
            let refused = other.continued(&orbit, &continuation(range.0, range.1, rising), &Unobserved);
            assert!(matches!(refused, Err(Error::NotAnOrbit { .. })), "{refused:?}");
            let settings = Continuation::new(ContinuationParameter::Forcing, range, rising).unwrap();
            let known = sine.continued(&orbit, &settings, &Unobserved).unwrap();
            assert_eq!(own.points.len(), known.points.len(), "{r} {:?} {:?}", own.end, known.end);
            assert_eq!(own.end, known.end);
            for (one, other) in own.bifurcations.iter().zip(&known.bifurcations) {
                assert_eq!(one.kind, other.kind);
                assert!((one.point.parameter - other.point.parameter).abs() < 1e-12, "{r} {one:?} {other:?}");
            }
            for (one, other) in own.points.iter().zip(&known.points) {
                assert!((one.parameter - other.parameter).abs() < 1e-9, "{one:?} {other:?}");
                assert!((one.trace - other.trace).abs() < 1e-7 * (1.0 + other.trace.abs()));
            }
        }
    }
}

/// By hand for one impact in k periods: the platform's velocity is k pi (1 - r)/(1 + r), and its acceleration
/// is 0 at a fold and -2 (1 + r^2)/(1 + r)^2 at a doubling. The distance of a point from this is measured by
/// the first Newton step in the number.
fn off_by_hand(family: &DrivenFamily, kind: BifurcationKind, (phase, number): (f64, f64)) -> f64 {
    let residual = |phase: f64, number: f64| {
        let family = family.with_parameter(NUMBER, number).unwrap();
        let (at, r) = (family.map().drive().at(phase), family.map().restitution());
        let wanted =
            if kind == BifurcationKind::Fold { 0.0 } else { 2.0 * (1.0 + r * r) / ((1.0 + r) * (1.0 + r)) };
        [at.velocity - PI * (1.0 - r) / (1.0 + r), at.acceleration + wanted]
    };
    let [f, g] = residual(phase, number);
    let d = 1e-6;
    let slope = |high: [f64; 2], low: [f64; 2]| [0, 1].map(|i| (high[i] - low[i]) / (2.0 * d));
    let by_phase = slope(residual(phase + d, number), residual(phase - d, number));
    let by_number = slope(residual(phase, number + d), residual(phase, number - d));
    (by_phase[0] * g - by_phase[1] * f) / (by_phase[0] * by_number[1] - by_phase[1] * by_number[0])
}

#[test]
fn folds_and_doublings_of_one_impact_on_sums_are_those_by_hand() {
    let mut random = SplitMix64::new(7);
    let mut uniform = move |low: f64, high: f64| low + (high - low) * random.unit();
    let (mut folds, mut doublings, mut births) = (0, 0, 0);
    for case in 0..24 {
        let r = uniform(0.1, 0.85);
        let shape =
            [(1.0, 0.0), (uniform(-0.3, 0.3), uniform(0.0, TAU)), (uniform(-0.15, 0.15), uniform(0.0, TAU))];
        let whole = sum(shape, r);
        // A forcing between the birth at the unit shape's fastest phase and the doubling.
        let unit = whole(1.0 / PI).unwrap();
        let birth = (1.0 - r) / (1.0 + r) / unit.drive().peak_speed();
        let start = birth * (1.0 + 0.05);
        let search = OrbitSearch::new(1, 1).unwrap().with_starts(12, 12).unwrap();
        let found = whole(start).unwrap().periodic_orbits(&search, &Unobserved).unwrap();
        let Some(orbit) = found.iter().find(|orbit| orbit.stability() == Stability::Stable) else { continue };
        // Over the forcing, over the restitution, and over a harmonic's size and phase.
        let over_size = move |size| sum([shape[0], (size, shape[1].1), shape[2]], r)(start);
        let over_phase = move |phase| sum([shape[0], shape[1], (shape[2].0, phase)], r)(start);
        let families = [
            (DrivenFamily::new(start, start, whole), (0.3 * start, 3.0 * start)),
            (DrivenFamily::new(r, 1.0, move |r| sum(shape, r)(start)), (0.02, 0.97)),
            (DrivenFamily::new(shape[1].0, 1.0, over_size), (-1.0, 1.0)),
            (DrivenFamily::new(shape[2].1, 1.0, over_phase), (shape[2].1 - 4.0, shape[2].1 + 4.0)),
        ];
        for (which, (family, (low, high))) in families.into_iter().enumerate() {
            let family = family.unwrap();
            for rising in [true, false] {
                let branch = family.continued(orbit, &continuation(low, high, rising), &Unobserved).unwrap();
                check_points(&branch);
                let known = !matches!(branch.end, BranchEnd::StepTooSmall(_) | BranchEnd::PointLimit(_));
                assert!(known, "{case} {which}: {:?}", branch.end);
                for found in &branch.bifurcations {
                    let kind = found.kind;
                    if !matches!(kind, BifurcationKind::Fold | BifurcationKind::Doubling) {
                        continue;
                    }
                    let (point, state) = (&found.point, found.point.orbit.states[0]);
                    let off = off_by_hand(&family, kind, (state.phase().angle(), point.parameter));
                    assert!(
                        off.abs() < 1e-12 * (1.0 + point.parameter.abs()),
                        "{case} {which} {kind:?} {off:e}"
                    );
                    if kind == BifurcationKind::Fold {
                        folds += 1;
                        continue;
                    }
                    doublings += 1;
                    let index = branch.bifurcations.iter().position(|other| other == found).unwrap();
                    let settings = continuation(low, high, true).with_steps(1e-4, 0.05, 200).unwrap();
                    let doubled = branch.switched(index, &settings, &Unobserved).unwrap();
                    check_points(&doubled);
                    // Back to where it began.
                    let start = doubled.points.get(4).unwrap_or(&doubled.points[0]);
                    let family = doubled.map_at(start.parameter).unwrap();
                    let rising = start.parameter < point.parameter;
                    let back = family
                        .continued(&start.orbit, &continuation(low, high, rising), &Unobserved)
                        .unwrap();
                    let born = back.bifurcations.last().filter(|last| last.kind == BifurcationKind::Birth);
                    let born = born
                        .unwrap_or_else(|| panic!("{case} {which} {:?} {:?}", back.end, back.bifurcations));
                    assert!((born.point.parameter - point.parameter).abs() < 1e-11);
                    births += 1;
                }
            }
        }
    }
    assert!(folds > 40 && doublings > 30 && births > 30, "{folds} {doublings} {births}");
}

/// A branch that begins near a fold, a doubling or a corner finds it.
#[test]
fn branches_begin_beside_folds_doublings_and_corners() {
    for r in [0.2, 0.5, 0.8] {
        // A second harmonic of a tenth of the first, in phase: the velocity is 1.2 units at phase 0, the
        // phase of the fold.
        let smooth = sum([(1.0, 0.0), (0.1, 0.0), (0.0, 0.0)], r);
        let fold = (1.0 - r) / (1.0 + r) / 1.2;
        let family = DrivenFamily::new(1.1 * fold, fold, smooth).unwrap();
        let up = branch(&family, 1, 1, &continuation(0.5 * fold, 3.0, true));
        let double = places(&up, BifurcationKind::Doubling)[0];
        let corner = 0.25 * PI * (1.0 - r) / (1.0 + r);
        let arcs = move |forcing: f64| DrivenMap::new(Drive::parabolas(PI * forcing).ok()?, r).ok();
        let border = BifurcationKind::BorderCollision { impact: 0 };
        for beside in [1e-6, 1e-8, 1e-10, 1e-12] {
            let places_of = [
                (DrivenFamily::new(fold + beside, fold, smooth), BifurcationKind::Fold, fold, false),
                (DrivenFamily::new(double + beside, fold, smooth), BifurcationKind::Doubling, double, false),
                (DrivenFamily::new(double - beside, fold, smooth), BifurcationKind::Doubling, double, true),
                (DrivenFamily::new(corner + beside, corner, arcs), border, corner, false),
            ];
            for (which, (family, kind, place, rising)) in places_of.into_iter().enumerate() {
                let family = family.unwrap();
                let search = OrbitSearch::new(1, 1).unwrap().with_starts(12, 12).unwrap();
                let orbits = family.map().periodic_orbits(&search, &Unobserved).unwrap();
                assert_eq!(orbits.len(), 2, "{r} {beside:e} {which}");
                let off = orbits.iter().filter_map(|orbit| {
                    let settings = continuation(0.3 * fold, 3.0, rising);
                    let branch = family.continued(orbit, &settings, &Unobserved).unwrap();
                    let off = places(&branch, kind).into_iter().map(|own| (own - place).abs());
                    off.min_by(f64::total_cmp)
                });
                let off: Vec<f64> = off.collect();
                // Upwards from a doubling, the other one-impact orbit has none.
                assert_eq!(off.len(), if rising { 1 } else { 2 }, "{r} {beside:e} {which}");
                assert!(off.iter().all(|off| *off < 1e-14), "{r} {beside:e} {which} {off:?}");
            }
        }
    }
}

/// 40 restitutions, some of them round numbers.
fn restitutions(seed: u64) -> impl Iterator<Item = f64> {
    let mut random = SplitMix64::new(seed);
    [0.1, 0.3, 0.5, 0.8, 0.95].into_iter().chain((0..35).map(move |_| 0.1 + 0.85 * random.unit()))
}

/// A cubic that rises through 0 has the velocity 3 a (1 - y^2)/pi and the acceleration -12 a y/pi^2 at the
/// phase pi y/2: its fold lies on the joint of two pieces.
#[test]
fn cubics_have_a_fold_and_a_doubling_by_hand() {
    for r in restitutions(9) {
        let slow = PI * PI * (1.0 - r) / (3.0 * (1.0 + r));
        let brakes = PI * PI * (1.0 + r * r) / (6.0 * (1.0 + r) * (1.0 + r));
        let (fold, double) = (slow / PI, 0.5 * (slow + hypot(slow, 2.0 * brakes)) / PI);
        let start = 0.5 * (fold + double);
        let with = move |forcing: f64| DrivenMap::new(Drive::cubics(PI * forcing).ok()?, r).ok();
        let family = DrivenFamily::new(start, start, with).unwrap();
        let up = branch(&family, 1, 1, &continuation(0.5 * fold, 1.2 * double, true));
        check_points(&up);
        let doublings = places(&up, BifurcationKind::Doubling);
        assert!((doublings[0] - double).abs() < 1e-12, "{r}: {doublings:?} {double}");
        let down = branch(&family, 1, 1, &continuation(0.5 * fold, start, false));
        check_points(&down);
        let folds = places(&down, BifurcationKind::Fold);
        assert!((folds[0] - fold).abs() < 1e-12, "{r}: {folds:?} {fold} {:?}", down.end);
    }
}

#[test]
fn parabolas_have_a_corner_and_a_doubling_by_hand() {
    for r in restitutions(8) {
        let corner = 0.25 * PI * (1.0 - r) / (1.0 + r);
        let double = 0.25 * PI * (1.0 + r * r) / ((1.0 + r) * (1.0 + r));
        let start = 0.5 * (corner + double);
        let with = move |forcing: f64| DrivenMap::new(Drive::parabolas(PI * forcing).ok()?, r).ok();
        let family = DrivenFamily::new(start, start, with).unwrap();
        let up = branch(&family, 1, 1, &continuation(0.5 * corner, 1.3 * double, true));
        check_points(&up);
        let [doubling] = places(&up, BifurcationKind::Doubling)[..] else { panic!("{:?}", up.bifurcations) };
        assert!((doubling - double).abs() < 1e-13, "{r}: {doubling} {double}");
        // All two-impact orbits exist at this one forcing: only rounding turns it back and forth.
        let index = up.bifurcations.iter().position(|found| found.kind == BifurcationKind::Doubling).unwrap();
        let two = up.switched(index, &continuation(0.5 * corner, 1.3 * double, true), &Unobserved).unwrap();
        assert_eq!(places(&two, BifurcationKind::Fold), [0.0; 0], "{r}");
        let near = |point: &&BranchPoint| (point.parameter - double).abs() < 1e-13;
        assert!(two.points.iter().filter(near).count() > 3, "{r} {:?}", two.bifurcations);
        // The node turns back at the corner as a saddle.
        let down = branch(&family, 1, 1, &continuation(0.5 * corner, start, false));
        check_points(&down);
        let [border] = places(&down, BifurcationKind::BorderCollision { impact: 0 })[..] else {
            panic!("{r} {:?} {:?}", down.end, down.bifurcations)
        };
        assert!((border - corner).abs() < 1e-12, "{r}: {border} {corner}");
        assert_eq!(places(&down, BifurcationKind::Fold), [0.0; 0]);
        let last = down.points.last().unwrap();
        assert!(last.orbit.stability() == Stability::Unstable, "{r} {:?} {last:?}", down.end);
    }
}

/// From the elastic limit to restitutions at which the orbit doubles near its birth: the first doubling by
/// hand, within its error.
#[test]
fn cascades_on_drives_begin_with_the_doubling_by_hand() {
    for r in [0.02, 0.05, 0.5, 0.9, 0.99] {
        let shape = sum([(1.0, 0.0), (0.2, 0.5), (0.0, 0.0)], r);
        let found = driven_doubling_cascade(shape, 1, &Unobserved).unwrap();
        let first = found.doublings[0];
        let family = DrivenFamily::new(first.axial_forcing, 1.0, shape).unwrap();
        let search = OrbitSearch::new(1, 1).unwrap().with_starts(16, 16).unwrap();
        let orbits = family.map().periodic_orbits(&search, &Unobserved).unwrap();
        let flips = |orbit: &&PeriodicOrbit| orbit.flip_function().abs() < 1e-9;
        let phase = orbits.iter().find(flips).unwrap().states[0].phase().angle();
        let off = off_by_hand(&family, BifurcationKind::Doubling, (phase, first.axial_forcing));
        assert!(off.abs() <= first.forcing_error + 1e-15, "{r} {off:e} {first:?}");
        assert!((first.multiplier + 1.0).abs() < 1e-10 && first.forcing_error < 1e-12, "{first:?}");
        let arcs = move |forcing: f64| DrivenMap::new(Drive::parabolas(PI * forcing).ok()?, r).ok();
        let first = driven_doubling_cascade(arcs, 1, &Unobserved).unwrap().doublings[0];
        let off = first.axial_forcing - 0.25 * PI * (1.0 + r * r) / ((1.0 + r) * (1.0 + r));
        assert!(off.abs() <= first.forcing_error, "{r} {off:e} {first:?}");
    }
    let triangle = |forcing: f64| DrivenMap::new(Drive::triangle(PI * forcing).ok()?, 0.5).ok();
    let refused = driven_doubling_cascade(triangle, 1, &Unobserved);
    assert!(matches!(refused, Err(Error::NoBranch { .. })), "{refused:?}");
}

/// One arc, with a kink at the start of each period: an orbit that reaches the kink ends there.
#[test]
fn a_branch_ends_on_a_kink() {
    let r = 0.5;
    // s = a t (2 pi - t), with the velocity 2 pi a at its start.
    let with = move |a: f64| DrivenMap::new(Drive::pieces(&[(TAU, [0.0, TAU * a, -a, 0.0])]).ok()?, r).ok();
    let kink = 0.5 * (1.0 - r) / (1.0 + r);
    let family = DrivenFamily::new(1.4 * kink, 1.0, with).unwrap();
    let down = branch(&family, 1, 1, &continuation(0.1 * kink, 2.0 * kink, false));
    let last = down.bifurcations.last().unwrap();
    assert_eq!(
        (last.kind, down.end),
        (BifurcationKind::BorderCollision { impact: 0 }, BranchEnd::Bifurcation)
    );
    assert!((last.point.parameter - kink).abs() < 1e-9, "{} {kink}", last.point.parameter);
}

/// The trace of the derivative around an orbit, by differences of the map.
fn trace_by_differences(map: &DrivenMap, orbit: &PeriodicOrbit) -> f64 {
    let states = &orbit.states;
    let around = |by: [f64; 2]| {
        let first = states[0];
        let phase = Phase::new(first.phase().angle() + by[0]).unwrap();
        let mut state = ImpactState::new(phase, first.velocity() + by[1]).unwrap();
        for _ in states {
            state = map.step(state).unwrap().impact.into();
        }
        let turned = (state.phase().angle() - first.phase().angle() + PI).rem_euclid(TAU) - PI;
        [turned, state.velocity()]
    };
    let d = 1e-4 / (10.0 + orbit.monodromy.x_axis.length() + orbit.monodromy.y_axis.length());
    let by = |direction: [f64; 2], of: usize| {
        let moved = |k: f64| around(direction.map(|part| k * d * part))[of];
        // Differences of the fourth order.
        (8.0 * (moved(1.0) - moved(-1.0)) - (moved(2.0) - moved(-2.0))) / (12.0 * d)
    };
    by([1.0, 0.0], 0) + by([0.0, 1.0], 1)
}

/// Whether the orbit exists on the map this far beyond the end of its branch, starting from the point nearest
/// in the parameter.
fn exists_beside_end(branch: &Branch<DrivenFamily>, by: f64) -> bool {
    let [before, end] = [2, 1].map(|back| &branch.points[branch.points.len() - back]);
    let number = end.parameter + by * (end.parameter - before.parameter).signum();
    let apart = |point: &&BranchPoint| (point.parameter - number).abs();
    let late = branch.points.iter().filter(|point| point.arclength > end.arclength - 0.1);
    let guess = late.min_by(|one, other| apart(one).total_cmp(&apart(other))).unwrap();
    let found = branch.map_at(number).unwrap().map().refine(&guess.orbit.states);
    let off = |found: &PeriodicOrbit| (found.states[0].velocity() - end.orbit.states[0].velocity()).abs();
    found.is_ok_and(|found| off(&found) < 0.1)
}

#[test]
fn branches_of_compliant_contacts_have_the_multipliers_of_their_map() {
    let (mut doublings, mut folds, mut lost) = (0, 0, 0);
    for (r, forcing, hysteretic) in
        [(0.5, 0.45, false), (0.5, 0.45, true), (0.3, 0.58, false), (0.8, 0.2, false)]
    {
        let sine = move |forcing: f64| Some(Drive::from(Vibration::from_axial_forcing(forcing).ok()?));
        let contact = move |map: DrivenMap, time: f64| {
            let own =
                if hysteretic { map.with_hysteretic_contact(time) } else { map.with_contact_time(time) };
            own.ok()
        };
        let over_time = move |time| contact(DrivenMap::new(sine(forcing)?, r).ok()?, time);
        let over_forcing = move |forcing| contact(DrivenMap::new(sine(forcing)?, r).ok()?, 0.1 * TAU);
        let families = [
            (DrivenFamily::new(0.1 * TAU, 1.0, over_time).unwrap(), (1e-3, TAU)),
            (DrivenFamily::new(forcing, forcing, over_forcing).unwrap(), (0.1, 1.5)),
        ];
        for (family, (low, high)) in families {
            for rising in [true, false] {
                let branch = branch(&family, 1, 1, &continuation(low, high, rising));
                check_points(&branch);
                for found in &branch.bifurcations {
                    let (map, orbit) = (branch.map_at(found.point.parameter).unwrap(), &found.point.orbit);
                    let trace = || trace_by_differences(map.map(), orbit);
                    let determinant = found.point.determinant;
                    match found.kind {
                        BifurcationKind::Doubling => {
                            assert!((1.0 + trace() + determinant).abs() < 1e-6, "{found:?}");
                            doublings += 1;
                        }
                        BifurcationKind::Fold => {
                            assert!((1.0 - trace() + determinant).abs() < 1e-5, "{found:?}");
                            folds += 1;
                        }
                        _ => {
                            assert_eq!(branch.end, BranchEnd::Bifurcation);
                            assert_eq!([-1e-6, 1e-6].map(|by| exists_beside_end(&branch, by)), [true, false]);
                            lost += 1;
                        }
                    }
                }
                // Near the end of a branch the differences may reach beyond it.
                let before = branch.points.last().unwrap().arclength - 0.01;
                let is_smooth = |point: &&BranchPoint| point.arclength < before;
                for point in branch.points.iter().filter(is_smooth).step_by(7) {
                    let map = branch.map_at(point.parameter).unwrap();
                    let trace = trace_by_differences(map.map(), &point.orbit);
                    assert!((trace - point.trace).abs() < 1e-5 * (1.0 + trace.abs()), "{trace} {point:?}");
                }
            }
        }
    }
    assert!(doublings > 3 && folds > 2 && lost > 6, "{doublings} {folds} {lost}");
}

/// On a triangle the platform's velocity does not change along a slope: its orbits come in families.
#[test]
fn a_member_of_a_family_of_orbits_begins_no_branch() {
    let with = |a: f64| DrivenMap::new(Drive::triangle(a).ok()?, 0.5).ok();
    let family = DrivenFamily::new(PI * PI / 6.0, 1.0, with).unwrap();
    let search = OrbitSearch::new(1, 1).unwrap().with_starts(12, 12).unwrap();
    for orbit in family.map().periodic_orbits(&search, &Unobserved).unwrap() {
        let branch = family.continued(&orbit, &continuation(0.5, 5.0, true), &Unobserved);
        assert!(matches!(branch, Err(Error::NoBranch { .. })), "{branch:?}");
    }
}

#[test]
fn what_a_family_has_not_is_refused() {
    let with = |a: f64| (a < 2.0).then(|| DrivenMap::new(Drive::parabolas(a).ok()?, 0.5).ok())?;
    assert!(matches!(DrivenFamily::new(3.0, 1.0, with), Err(Error::OutOfRange { value: 3.0, .. })));
    assert!(matches!(DrivenFamily::new(1.0, 0.0, with), Err(Error::OutOfRange { value: 0.0, .. })));
    assert!(matches!(DrivenFamily::new(f64::NAN, 1.0, with), Err(Error::OutOfRange { .. })));
    let family = DrivenFamily::new(1.1, 1.0, with).unwrap();
    let up = branch(&family, 1, 1, &continuation(0.5, 5.0, true));
    // The last point lies at the end of the family.
    let last = up.points.last().unwrap().parameter;
    assert!(
        matches!(up.end, BranchEnd::StepTooSmall(_)) && (2.0 - 1e-9..2.0).contains(&last),
        "{:?} {last}",
        up.end
    );
    let orbit = &up.points[0].orbit;
    let forcing = Continuation::new(ContinuationParameter::Forcing, (0.1, 5.0), true).unwrap();
    let refused = family.continued(orbit, &forcing, &Unobserved);
    assert!(matches!(refused, Err(Error::NotOfKind { index: 0, .. })), "{refused:?}");
    let sine = ImpactMap::new(Vibration::new(1.5).unwrap(), 0.5).unwrap();
    let refused = sine.continued(orbit, &continuation(0.1, 5.0, true), &Unobserved);
    assert!(matches!(refused, Err(Error::NotOfKind { index: 2, .. })), "{refused:?}");
}

/// The errors for the sine and for the sine as a sum, against the cascade in double-doubles.
#[test]
fn the_errors_of_doublings_hold() {
    let (mut count, mut covered) = (0, 0);
    for r in [0.1, 0.2, 0.3, 0.5, 0.7, 0.8, 0.9] {
        let restitution = bouncing_disk_core::numerics::double_double::DoubleDouble::from(r);
        let known = doubling_cascade(restitution, 6, &Unobserved).unwrap().doublings;
        let start = 0.5 * ((1.0 - r) / (1.0 + r) + ImpactMap::first_doubling_forcing(r));
        let sine = ImpactMap::new(Vibration::from_axial_forcing(start).unwrap(), r).unwrap();
        let orbit = sine.refine(&[sine.period_one(1).unwrap()]).unwrap();
        let with = |parameter| {
            Continuation::new(parameter, (0.5 * start, 3.0), true)
                .unwrap()
                .with_steps(1e-3, 0.02, 10_000)
                .unwrap()
        };
        let family = DrivenFamily::new(start, start, sum([(1.0, 0.0), (0.0, 0.0), (0.0, 0.0)], r)).unwrap();
        let found = [
            sine.doublings(&orbit, &with(ContinuationParameter::Forcing), 6, &Unobserved).unwrap(),
            family.doublings(&orbit, &with(NUMBER), 6, &Unobserved).unwrap(),
        ];
        for found in found {
            assert_eq!(found.len(), known.len(), "{r}");
            for (own, known) in found.iter().zip(&known) {
                assert_eq!(own.point.orbit.period(), known.period);
                assert!((own.width - known.width.high()).abs() < 1e-12);
                let off = (own.point.parameter - known.axial_forcing.high()).abs();
                eprintln!(
                    "{r} {} {off:e} {:e} {:e}",
                    known.number,
                    own.parameter_error,
                    own.width - known.width.high()
                );
                count += 1;
                covered += usize::from(off <= own.parameter_error);
            }
        }
    }
    assert!(10 * covered >= 9 * count, "{covered} of {count}");
}
