//! Branches on the sine. The doubling of one impact agrees with its closed form to 1e-14, folds to 1e-13,
//! later doublings with the cascade to 1e-12, births with the doubling of the other branch to 1e-14. Of 2,236
//! branches of 60 random maps 1,625 end at the limits of the range, 607 in a graze, vanishing impact or
//! birth, and 4 are closed.

use super::*;
use crate::flight::launch::Launch;
use crate::map::impact_map::ImpactState;
use crate::map::impact_map::map;
use crate::numerics::random::SplitMix64;
use crate::numerics::testing::stored;
use crate::orbits::cascade::doubling_cascade;
use crate::orbits::periodic::catalogue::OrbitSearch;
use crate::run::Unobserved;

fn forcing(low: f64, high: f64, rising: bool) -> Continuation {
    Continuation::new(ContinuationParameter::Forcing, (low, high), rising).expect("legal")
}

/// The forcing at which the orbits of one impact every k periods are born, in closed form.
fn birth(k: u64, restitution: f64) -> f64 {
    k as f64 * (1.0 - restitution) / (1.0 + restitution)
}

/// The node of one impact every k periods, at a forcing this far above its birth.
fn node(k: u64, restitution: f64, above: f64) -> (ImpactMap, PeriodicOrbit) {
    let map = map(birth(k, restitution) + above, restitution);
    let pair = map.period_one_pair(k).expect("above its birth");
    let orbit = pair.node.orbit(&map).expect("no failure").expect("admissible");
    (map, orbit)
}

/// Every point, even the last one before a graze, is an orbit of the map, and so is every bifurcation within
/// the branch. Traces and determinants of points agree with the derivatives of their orbits.
fn check_points(branch: &Branch) {
    let mut arclength = -1.0;
    let within =
        |kind| matches!(kind, BifurcationKind::Doubling | BifurcationKind::Fold | BifurcationKind::Birth);
    let located = branch.bifurcations.iter().filter(|found| within(found.kind));
    let located = located.map(|found| (&found.point, false));
    for (point, is_next) in branch.points.iter().map(|point| (point, true)).chain(located) {
        let (map, states) = (branch.map_at(point.parameter).expect("legal"), &point.orbit.states);
        let n = states.len();
        for i in 0..n {
            let impact = map.step(states[i]).expect("flies");
            let next = states[(i + 1) % n];
            let turned = (impact.phase.angle() - next.phase().angle()).abs();
            // Near a graze the end of a flight is as uncertain as the root of the rounding.
            assert!(turned.min(core::f64::consts::TAU - turned) < 1e-7, "{map}: {point:?}");
            assert!((impact.velocity - next.velocity()).abs() < 1e-7 * (1.0 + next.velocity().abs()));
        }
        if !is_next {
            continue;
        }
        assert!(point.arclength > arclength, "{} after {arclength}", point.arclength);
        arclength = point.arclength;
        let size = point.orbit.monodromy.x_axis.length() * point.orbit.monodromy.y_axis.length();
        assert!((point.orbit.monodromy.determinant() - point.determinant).abs() <= 1e-11 * (1.0 + size));
        assert_eq!(point.is_stable(), point.multipliers().spectral_radius() < 1.0);
    }
}

#[test]
fn the_first_doubling_is_that_of_the_closed_form_to_1e_14() {
    for tenths in 1..10 {
        let r = f64::from(tenths) / 10.0;
        let first = ImpactMap::first_doubling_forcing(r);
        let (map, orbit) = node(1, r, 0.5 * (first - birth(1, r)));
        let branch =
            map.continued(&orbit, &forcing(0.5 * first, 1.03 * first, true), &Unobserved).expect("continued");
        check_points(&branch);
        assert_eq!((branch.end, branch.bifurcations.len()), (BranchEnd::RangeLimit(1.03 * first), 1), "{r}");
        let found = &branch.bifurcations[0];
        assert_eq!(found.kind, BifurcationKind::Doubling);
        assert!((found.point.parameter - first).abs() <= 1e-14, "{r}: {} {first}", found.point.parameter);
        let last = branch.points.last().expect("points");
        assert!((last.parameter - 1.03 * first).abs() < 1e-12 && !last.is_stable());
        assert!(branch.points[0].is_stable());
    }
}

#[test]
fn folds_are_those_of_the_closed_form_to_1e_13() {
    let mut saddles = 0;
    for tenths in 1..10 {
        let r = f64::from(tenths) / 10.0;
        for k in 1..=3 {
            let (map, orbit) = node(k, r, 0.05);
            let (at, high) = (birth(k, r), birth(k, r) + 0.06);
            let branch =
                map.continued(&orbit, &forcing(0.5 * at, high, false), &Unobserved).expect("continued");
            check_points(&branch);
            let folds: Vec<_> = branch.of_kind(BifurcationKind::Fold).collect();
            assert_eq!(folds.len(), 1, "{r} {k}: {:?}", branch.end);
            let parameter = folds[0].point.parameter;
            assert!((parameter - at).abs() <= 1e-13 * (1.0 + at), "{r} {k}: {parameter} {at}");
            if branch.end == BranchEnd::RangeLimit(high) {
                saddles += 1;
                let last = branch.points.last().expect("points");
                let saddle = branch.map_at(high).expect("legal").period_one_pair(k).expect("exists").saddle;
                assert!((last.orbit.states[0].phase().angle() - saddle.state.phase().angle()).abs() < 1e-9);
                assert!((last.trace - saddle.trace).abs() < 1e-9 * (1.0 + saddle.trace.abs()));
            }
        }
    }
    assert!(saddles > 10, "{saddles}");
}

/// From branch to doubled branch: the same cascade as `doubling_cascade` finds by another method.
#[test]
fn doubled_branches_double_where_the_cascade_does() {
    let cascade = doubling_cascade(0.5, 3, &Unobserved).expect("found").doublings;
    let (map, orbit) = node(1, 0.5, 0.1);
    let settings = forcing(0.3, 0.6, true).with_steps(0.003, 0.02, 10_000).expect("legal");
    let mut branch = map.continued(&orbit, &settings, &Unobserved).expect("continued");
    for (n, known) in cascade.iter().enumerate() {
        let index = branch.bifurcations.iter().position(|found| found.kind == BifurcationKind::Doubling);
        let index = index.expect("doubles");
        let point = &branch.bifurcations[index].point;
        assert_eq!(point.orbit.period(), known.period);
        let off = (point.parameter - known.axial_forcing).abs();
        assert!(off <= 1e-12, "{n}: {} {}", point.parameter, known.axial_forcing);
        if n + 1 < cascade.len() {
            branch = branch.switched(index, &settings, &Unobserved).expect("switches");
            check_points(&branch);
            assert_eq!(branch.points[0].orbit.period(), 2 * known.period);
            assert!(branch.points[0].is_stable() && branch.points[0].parameter > known.axial_forcing);
            assert!(
                branch.of_kind(BifurcationKind::Fold).next().is_none_or(|fold| fold.point.arclength > 0.1)
            );
        }
    }
}

/// Followed back to its birth, the orbit of two impacts ends in the orbit that doubled.
#[test]
fn a_doubled_orbit_is_born_in_the_doubling() {
    let map = map(0.5, 0.5);
    let start = ImpactState::from_normalised(0.8, 1.3).expect("legal");
    let orbit = map.settled_orbit(start, 4_000, 4, 1e-9, &Unobserved).expect("no failure").expect("settles");
    assert_eq!(orbit.period(), 2);
    let branch = map.continued(&orbit, &forcing(0.3, 0.6, false), &Unobserved).expect("continued");
    check_points(&branch);
    let [birth] = branch.bifurcations.as_slice() else { panic!("{:?}", branch.bifurcations) };
    assert_eq!((birth.kind, branch.end), (BifurcationKind::Birth, BranchEnd::Bifurcation));
    assert_eq!(birth.point.orbit.period(), 1);
    assert!((birth.point.parameter - ImpactMap::first_doubling_forcing(0.5)).abs() < 1e-14);
    let last = branch.points.last().expect("points");
    assert!((last.parameter - birth.point.parameter).abs() < 1e-2 && last.orbit.period() == 2);
}

/// With the largest and the smallest steps, near the elastic limit and far from it. A branch turns at its
/// fold, however closely beyond the fold its range ends. It ends at the end of its range, however closely
/// before the fold this is. No step leaps over the fold, where there is no orbit.
#[test]
fn a_range_ends_a_branch_on_its_own_side_of_the_fold_only() {
    for (r, k) in [(0.3, 1), (0.8, 2), (0.99, 1), (0.999_999, 1), (1.0 - 1e-9, 1), (1.0 - 1e-12, 3)] {
        let (map, orbit) = node(k, r, 0.15);
        let fold = birth(k, r);
        for steps in [(0.01, 0.5), (1e-6, 0.05)] {
            for low in [0.0, 0.5 * fold, fold - 1e-8, fold * (1.0 - 1e-10)] {
                let Ok(settings) =
                    Continuation::new(ContinuationParameter::Forcing, (low, fold + 0.3), false)
                else {
                    continue;
                };
                let settings = settings.with_steps(steps.0, steps.1, 10_000).expect("legal");
                let branch = map.continued(&orbit, &settings, &Unobserved).expect("continued");
                let folds: Vec<_> = branch.of_kind(BifurcationKind::Fold).collect();
                let place = format!("{r} {k} {low} {steps:?}: {:?}", branch.end);
                assert_eq!(folds.len(), 1, "{place}");
                assert!((folds[0].point.parameter - fold).abs() <= 1e-13 * (1.0 + fold), "{place}");
                assert!(!matches!(branch.end, BranchEnd::StepTooSmall(_) | BranchEnd::PointLimit(_)));
                assert_ne!(branch.end, BranchEnd::RangeLimit(low), "{place}");
            }
            for low in [fold * (1.0 + 1e-10) + 1e-13, fold + 1e-8] {
                let settings = forcing(low, fold + 0.3, false).with_steps(steps.0, steps.1, 10_000);
                let branch =
                    map.continued(&orbit, &settings.expect("legal"), &Unobserved).expect("continued");
                let last = branch.points.last().expect("points").parameter;
                assert_eq!(branch.end, BranchEnd::RangeLimit(low), "{r}");
                assert_eq!(branch.of_kind(BifurcationKind::Fold).count(), 0, "{r}");
                assert!((low..low + 1e-12).contains(&last), "{r}: {last} {low}");
            }
        }
    }
}

/// The same for births, on doubled branches and on those that double again, with each doubling listed once.
#[test]
fn a_range_ends_a_doubled_branch_on_its_own_side_of_the_birth_only() {
    for r in [0.1, 0.5, 0.8, 0.99] {
        let cascade = doubling_cascade(r, 3, &Unobserved).expect("found").doublings;
        let (map, orbit) = node(1, r, 0.8 * (cascade[0].axial_forcing - birth(1, r)));
        let settings = forcing(0.5 * birth(1, r), 1.5, true).with_steps(0.002, 0.02, 10_000).expect("legal");
        let mut branch = map.continued(&orbit, &settings, &Unobserved).expect("continued");
        for known in &cascade {
            let index = branch.bifurcations.iter().position(|found| found.kind == BifurcationKind::Doubling);
            branch = branch.switched(index.expect("doubles"), &settings, &Unobserved).expect("switches");
            let born = known.axial_forcing;
            for start in branch.points.iter().take(12).step_by(8) {
                let map = branch.map_at(start.parameter).expect("legal");
                for steps in [(0.01, 0.05), (1.0, 1.0)] {
                    for below in [0.1, 1e-8, 1e-12, -1e-9, -1e-8] {
                        let low = born - below;
                        let settings = forcing(low, 1.5, false).with_steps(steps.0, steps.1, 10_000);
                        let settings = settings.expect("legal");
                        if start.parameter <= low {
                            continue;
                        }
                        let falling = map.continued(&start.orbit, &settings, &Unobserved).expect("continued");
                        let last = falling.points.last().expect("points").parameter;
                        let kinds: Vec<_> = falling.bifurcations.iter().map(|found| found.kind).collect();
                        let place = format!("{r} {} {below} {steps:?}: {kinds:?} {last}", known.number);
                        let doublings = kinds.iter().filter(|kind| **kind == BifurcationKind::Doubling);
                        assert!(doublings.count() <= 1 && !kinds.contains(&BifurcationKind::Fold), "{place}");
                        if below > 0.0 {
                            let birth = falling.bifurcations.last().expect("born");
                            assert_eq!(
                                (birth.kind, falling.end),
                                (BifurcationKind::Birth, BranchEnd::Bifurcation)
                            );
                            assert!((birth.point.parameter - born).abs() < 1e-12, "{place}");
                            assert_eq!(birth.point.orbit.period(), known.period);
                        } else {
                            assert_eq!(falling.end, BranchEnd::RangeLimit(low), "{place}");
                            assert!((low..low + 1e-9).contains(&last), "{place}");
                        }
                    }
                }
            }
        }
    }
}

/// The halves of this orbit lie on two sides of the seam at 2 pi.
#[test]
fn a_birth_across_the_seam_is_the_doubling_of_the_closed_form() {
    let map = map(0.9, 0.8);
    let search = OrbitSearch::new(2, 2).expect("legal").with_starts(24, 24).expect("legal");
    let found = map.periodic_orbits(&search, &Unobserved).expect("no failure").orbits;
    let orbit = found.iter().find(|orbit| orbit.period() == 2 && orbit.platform_periods == 2);
    let branch =
        map.continued(orbit.expect("found"), &forcing(0.1, 1.5, false), &Unobserved).expect("continued");
    let [doubling, birth] = branch.bifurcations.as_slice() else { panic!("{:?}", branch.bifurcations) };
    assert_eq!((doubling.kind, birth.kind), (BifurcationKind::Doubling, BifurcationKind::Birth));
    assert!((birth.point.parameter - ImpactMap::first_doubling_forcing(0.8)).abs() < 1e-15);
    assert_eq!((branch.end, birth.point.orbit.period()), (BranchEnd::Bifurcation, 1));
}

/// At the end of a range, or at the start of a branch, a doubling counts within rounding.
#[test]
fn a_doubling_at_the_end_of_a_range_is_listed() {
    for r in [0.1, 0.5, 0.8, 0.99, 1.0 - 1e-9] {
        let first = ImpactMap::first_doubling_forcing(r);
        let listed = |from: f64, range: (f64, f64)| {
            let map = map(from, r);
            let orbit = map.refine(&[map.period_one(1).expect("exists")]).expect("settles");
            let branch = map
                .continued(&orbit, &forcing(range.0, range.1, from < range.1), &Unobserved)
                .expect("continued");
            branch.of_kind(BifurcationKind::Doubling).count()
        };
        let low = 0.5 * (first + birth(1, r));
        for (high, expected) in
            [(first.next_down(), 1), (first, 1), (first.next_up(), 1), (first - 1e-11, 0), (first + 1e-11, 1)]
        {
            assert_eq!(listed(low, (low, high)), expected, "{r} {high}");
        }
        assert_eq!((listed(first, (low, first)), listed(first, (first, first + 0.1))), (1, 1), "{r}");
    }
}

/// The saddle of one impact ends where the platform's crest touches its flight: before this, the first impact
/// is the orbit's own; after it, an earlier one.
#[test]
fn a_branch_that_ends_in_a_graze_ends_where_the_first_impact_changes() {
    for (k, r) in [(1, 0.3), (1, 0.5), (1, 0.8), (2, 0.5)] {
        let (map, orbit) = node(k, r, 0.05);
        // Down to the fold, and up again as the saddle.
        let branch =
            map.continued(&orbit, &forcing(0.5 * birth(k, r), 6.0, false), &Unobserved).expect("continued");
        assert_eq!(branch.end, BranchEnd::Bifurcation, "{k} {r}");
        let graze = branch.bifurcations.last().expect("ends");
        assert_eq!(graze.kind, BifurcationKind::Graze { flight: 0 }, "{k} {r}");
        let at = graze.point.parameter;
        let closed = |forcing: f64| {
            let map = branch.map_at(forcing).expect("legal");
            map.period_one_pair(k).expect("exists").saddle.is_admissible(&map).expect("no failure")
        };
        assert_eq!([at * (1.0 - 1e-11), at * (1.0 + 1e-11)].map(closed), [true, false], "{k} {r}: {at}");
        // At the graze itself rounding decides which impact is the first.
        let near = branch.map_at(at * (1.0 - 1e-10)).expect("legal");
        let state = near.period_one_pair(k).expect("exists").saddle.state;
        let launch = Launch::new(state.phase(), -r * state.velocity()).expect("legal");
        let margin = near.vibration().graze_margin(launch, &near.step(state).expect("flies"));
        assert!(margin > 0.0 && margin < 1e-8, "{k} {r}: {margin:e}");
    }
}

/// Every orbit that the search finds is continued both ways, only through orbits of the map, to an end with a
/// reason.
#[test]
fn all_orbits_of_random_maps_have_branches_that_end() {
    let mut random = SplitMix64::new(7);
    let mut ends = [0; 5];
    for _ in 0..60 {
        let map = map(0.2 + 1.3 * random.unit(), 0.2 + 0.6 * random.unit());
        let search = OrbitSearch::new(4, 4).expect("legal").with_starts(24, 24).expect("legal");
        for orbit in map.periodic_orbits(&search, &Unobserved).expect("no failure").orbits.iter().take(12) {
            for (parameter, range) in [
                (ContinuationParameter::Forcing, (0.05, 1.6)),
                (ContinuationParameter::Restitution, (0.1, 0.9)),
            ] {
                for rising in [true, false] {
                    let settings = Continuation::new(parameter, range, rising).expect("legal");
                    let settings = settings.with_steps(0.01, 0.1, 400).expect("legal");
                    let branch = map.continued(orbit, &settings, &Unobserved).expect("continued");
                    check_points(&branch);
                    let kinds = branch.bifurcations.iter().map(|found| found.kind);
                    let last = |kind| {
                        matches!(
                            kind,
                            BifurcationKind::Graze { .. }
                                | BifurcationKind::VanishingImpact { .. }
                                | BifurcationKind::Birth
                        )
                    };
                    let lost = kinds.filter(|kind| last(*kind)).count();
                    assert_eq!(lost, usize::from(branch.end == BranchEnd::Bifurcation), "{map} {branch:?}");
                    if branch.end == BranchEnd::Closed {
                        let folds = branch.of_kind(BifurcationKind::Fold).count();
                        assert!(folds >= 2 && folds.is_multiple_of(2), "{map} {branch:?}");
                    }
                    ends[match branch.end {
                        BranchEnd::RangeLimit(_) => 0,
                        BranchEnd::Bifurcation => 1,
                        BranchEnd::Closed => 2,
                        BranchEnd::PointLimit(_) => 3,
                        BranchEnd::StepTooSmall(_) => 4,
                    }] += 1;
                }
            }
        }
    }
    assert!(ends[0] > 500 && ends[1] > 200, "{ends:?}");
    assert!(ends[2] > 0, "some branches close: {ends:?}");
    assert_eq!(ends[4], 0, "{ends:?}");
}

/// Where the flight of the saddle grazes, an orbit of two impacts is born, one of them still without speed:
/// both branches end there.
#[test]
fn an_impact_vanishes_where_the_flight_without_it_grazes() {
    let (own, _) = node(1, 0.21, 0.05);
    let map = map(0.72, own.restitution());
    let search = OrbitSearch::new(2, 1).expect("legal").with_starts(48, 48).expect("legal");
    let found = map.periodic_orbits(&search, &Unobserved).expect("no failure").orbits;
    let ends = |impacts: usize, kind: fn(BifurcationKind) -> bool| {
        let mut ends = Vec::new();
        for orbit in found.iter().filter(|orbit| orbit.period() == impacts) {
            for rising in [true, false] {
                let branch =
                    map.continued(orbit, &forcing(0.3, 1.2, rising), &Unobserved).expect("continued");
                check_points(&branch);
                ends.extend(
                    branch
                        .bifurcations
                        .last()
                        .filter(|last| kind(last.kind))
                        .map(|last| last.point.parameter),
                );
            }
        }
        ends
    };
    let grazes = ends(1, |kind| matches!(kind, BifurcationKind::Graze { .. }));
    let vanishing = ends(2, |kind| matches!(kind, BifurcationKind::VanishingImpact { .. }));
    assert!(!grazes.is_empty() && !vanishing.is_empty(), "{grazes:?} {vanishing:?}");
    for graze in &grazes {
        assert!(vanishing.iter().any(|other| (other - graze).abs() < 1e-12), "{grazes:?} {vanishing:?}");
    }
}

/// In the restitution: the closed form at every point, and the same doubling.
#[test]
fn a_branch_in_the_restitution_is_that_of_the_closed_form() {
    let (map, orbit) = node(1, 0.5, 0.1);
    let fold = (1.0 - map.vibration().axial_forcing()) / (1.0 + map.vibration().axial_forcing());
    for rising in [true, false] {
        let settings =
            Continuation::new(ContinuationParameter::Restitution, (0.05, 0.95), rising).expect("legal");
        let branch = map.continued(&orbit, &settings, &Unobserved).expect("continued");
        check_points(&branch);
        for point in &branch.points {
            let own = branch.map_at(point.parameter).expect("legal").period_one_pair(1).expect("exists");
            let off = [own.node, own.saddle].map(|own| (point.trace - own.trace).abs());
            assert!(off[0].min(off[1]) < 1e-10 * (1.0 + point.trace.abs()), "{point:?}");
        }
        for found in &branch.bifurcations {
            match found.kind {
                BifurcationKind::Fold => assert!((found.point.parameter - fold).abs() < 1e-13),
                BifurcationKind::Doubling => {
                    let first = ImpactMap::first_doubling_forcing(found.point.parameter);
                    assert!((first - map.vibration().axial_forcing()).abs() < 1e-13);
                }
                BifurcationKind::Graze { .. } | BifurcationKind::VanishingImpact { .. } => {}
                BifurcationKind::Birth | BifurcationKind::BorderCollision { .. } => {
                    panic!("one impact has no halves, and a sine no joints")
                }
            }
        }
        assert_eq!(branch, stored(&branch));
        let seen = |kind| branch.of_kind(kind).count();
        assert_eq!(
            (seen(BifurcationKind::Fold), seen(BifurcationKind::Doubling)),
            (usize::from(!rising), usize::from(rising))
        );
    }
}

/// Almost without restitution, almost without loss, and flights of 900 periods.
#[test]
fn branches_reach_the_limits_of_the_parameters() {
    let all = (f64::MIN_POSITIVE, 1.0 - f64::EPSILON / 2.0);
    let map = map(1.2, 0.5);
    let pair = map.period_one_pair(1).expect("exists");
    let orbit = pair.node.orbit(&map).expect("no failure").expect("admissible");
    for (rising, end) in [(false, all.0), (true, all.1)] {
        let settings = Continuation::new(ContinuationParameter::Restitution, all, rising).expect("legal");
        let branch = map.continued(&orbit, &settings, &Unobserved).expect("continued");
        check_points(&branch);
        assert_eq!(branch.end, BranchEnd::RangeLimit(end), "{:?}", branch.bifurcations);
    }
    let (map, orbit) = node(900, 0.5, 1.0);
    let settings = forcing(200.0, 301.5, false).with_steps(1e-4, 0.01, 10_000).expect("legal");
    let branch = map.continued(&orbit, &settings, &Unobserved).expect("continued");
    check_points(&branch);
    let fold = branch.of_kind(BifurcationKind::Fold).next().expect("born at 300");
    assert!((fold.point.parameter - 300.0).abs() <= 1e-13 * 300.0, "{}", fold.point.parameter);
    assert_eq!(fold.point.orbit.platform_periods, 900);
}

#[test]
fn a_branch_ends_at_its_limits() {
    let (map, orbit) = node(1, 0.5, 0.1);
    let few = forcing(0.1, 0.6, true).with_steps(1e-3, 1e-3, 5).expect("legal");
    let branch = map.continued(&orbit, &few, &Unobserved).expect("continued");
    assert_eq!((branch.points.len(), branch.end), (5, BranchEnd::PointLimit(5)));
    assert!((branch.points[4].arclength - 4e-3).abs() < 1e-12);
    // The start is the limit.
    let at = map.vibration().axial_forcing();
    let empty = map.continued(&orbit, &forcing(0.1, at, true), &Unobserved).expect("continued");
    assert_eq!(empty.end, BranchEnd::RangeLimit(at));
    assert!(empty.points.iter().all(|point| (point.parameter - at).abs() < 1e-12));
}

/// P/pi is not always the forcing that P was computed from.
#[test]
fn an_orbit_of_a_map_made_for_an_end_of_the_range_lies_in_it() {
    let mut rounded = 0;
    for hundredths in 40..400 {
        let end = f64::from(hundredths) / 100.0;
        let map = map(end, 0.5);
        rounded += usize::from(map.vibration().axial_forcing().to_bits() != end.to_bits());
        let orbit = map.refine(&[map.period_one(1).expect("born")]).expect("settles");
        for (range, rising) in [((end, end + 0.1), true), ((end - 0.01, end), false)] {
            let branch =
                map.continued(&orbit, &forcing(range.0, range.1, rising), &Unobserved).expect("continued");
            let begun = branch.points[0].parameter;
            assert!((range.0..=range.1).contains(&begun), "{begun} {range:?}");
            assert!((begun - end).abs() <= ROUNDED * end, "{begun} {end}");
        }
    }
    assert!(rounded > 20, "{rounded}");
}

#[test]
fn what_cannot_be_continued_is_refused() {
    let (own, orbit) = node(1, 0.5, 0.1);
    let outside = own.continued(&orbit, &forcing(0.5, 0.6, true), &Unobserved);
    assert!(matches!(outside, Err(Error::OutOfRange { field: "parameter of a continuation", .. })));
    let plastic = map(1.05, 0.0);
    let without = plastic.continued(&orbit, &forcing(0.5, 1.6, true), &Unobserved);
    assert!(matches!(without, Err(Error::OutOfRange { field: "restitution of a continuation", .. })));
    let other = map(0.2, 0.5).continued(&orbit, &forcing(0.1, 0.3, true), &Unobserved);
    assert!(matches!(other, Err(Error::NotAnOrbit { impact: 0, distance }) if distance > 0.1), "{other:?}");
    // A fold is where the two orbits are one, and no branch is the only one.
    let birth = map(1.0 / 3.0, 0.5);
    let at_birth =
        birth.period_one_pair(1).expect("born").node.orbit(&birth).expect("flies").expect("an orbit");
    let refused = birth.continued(&at_birth, &forcing(0.1, 0.6, true), &Unobserved);
    assert!(matches!(refused, Err(Error::NoBranch { parameter: 0.33..0.34, .. })), "{refused:?}");
    let branch = own.continued(&orbit, &forcing(0.1, 0.44, true), &Unobserved).expect("continued");
    let refused = branch.switched(7, &forcing(0.1, 0.6, true), &Unobserved).expect_err("none there");
    assert!(matches!(refused, Error::NotOfKind { index: 7, count: 0, .. }), "{refused}");
    let legal = forcing(0.1, 0.6, true);
    assert_eq!(legal, stored(&legal));
}
