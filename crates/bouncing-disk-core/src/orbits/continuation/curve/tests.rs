use std::collections::BTreeMap;

use super::*;
use crate::map::impact_map::map;
use crate::numerics::elementary::sin;
use crate::numerics::random::SplitMix64;
use crate::orbits::closing::ContinuationParameter::{Forcing, Restitution};
use crate::orbits::continuation::BranchPoint;
use crate::orbits::periodic::PeriodicOrbit;
use crate::orbits::periodic::catalogue::OrbitSearch;
use crate::run::Unobserved;

/// (1 - r)/(1 + r).
fn loss(restitution: f64) -> f64 {
    (1.0 - restitution) / (1.0 + restitution)
}

/// By hand: one impact every k periods doubles where 2 (1 + r^2) = (1 + r)^2 pi Gamma sin tau, with
/// cos tau = k (1 - r)/((1 + r) Gamma).
fn doubling(k: u64, restitution: f64) -> f64 {
    let whole = 1.0 + restitution;
    let sine = 2.0 * (1.0 + restitution * restitution) / (core::f64::consts::PI * whole * whole);
    let cosine = k as f64 * loss(restitution);
    (sine * sine + cosine * cosine).sqrt()
}

/// The branch over the forcing of one impact every k periods.
fn branch(k: u64, restitution: f64) -> Branch {
    let fold = k as f64 * loss(restitution);
    let doubling = doubling(k, restitution);
    let map = map(0.5 * (fold + doubling), restitution);
    let node = map.period_one_pair(k).expect("above its birth").node;
    let orbit: PeriodicOrbit = node.orbit(&map).expect("no failure").expect("admissible");
    let settings = Continuation::new(Forcing, (0.5 * fold, 2.0 * doubling), false).expect("legal");
    let down = map.continued(&orbit, &settings, &Unobserved).expect("continued");
    let settings = Continuation::new(Forcing, (0.5 * fold, 2.0 * doubling), true).expect("legal");
    let up = map.continued(&orbit, &settings, &Unobserved).expect("continued");
    let bifurcations = [down.bifurcations, up.bifurcations].concat();
    Branch { bifurcations, ..up }
}

fn index(branch: &Branch, kind: BifurcationKind) -> usize {
    branch.bifurcations.iter().position(|found| found.kind == kind).expect("found")
}

#[test]
fn period_one_folds_and_doubles_where_it_does_by_hand() {
    for k in 1..=3 {
        for (kind, by_hand) in [
            (BifurcationKind::Fold, (|k, r| k as f64 * loss(r)) as fn(u64, f64) -> f64),
            (BifurcationKind::Doubling, doubling),
        ] {
            let branch = branch(k, 0.5);
            let start = index(&branch, kind);
            for (rising, limit) in [(true, 0.999), (false, 0.05)] {
                let settings = Continuation::new(Restitution, (0.05, 0.999), rising).expect("legal");
                let curve = branch.curve(start, (1e-4, 6.0), &settings, &Unobserved).expect("continued");
                for point in &curve.points {
                    let [forcing, restitution] = point.parameters;
                    let off = (forcing - by_hand(k, restitution)).abs();
                    assert!(off < 1e-12, "{point:?}");
                    assert!(off <= point.errors[0], "{off} {point:?}");
                    // The cascade to chaos begins with it: the doubled orbit attracts.
                    let expected = (kind == BifurcationKind::Doubling).then_some(true);
                    assert_eq!(point.is_supercritical, expected, "{point:?}");
                }
                assert_eq!(curve.end, CurveEnd::RangeLimit { parameter: Restitution, value: limit });
            }
        }
    }
}

/// The curves, in both directions, from all bifurcations with curves on the branches of the orbits of random
/// maps.
fn random_curves(maps: u32, impacts: usize, mut see: impl FnMut(&Branch, Curve)) {
    let mut random = SplitMix64::new(7);
    for _ in 0..maps {
        let map = map(0.2 + 1.3 * random.unit(), 0.2 + 0.6 * random.unit());
        let search = OrbitSearch::new(impacts, 4).expect("legal").with_starts(24, 24).expect("legal");
        for orbit in map.periodic_orbits(&search, &Unobserved).expect("no failure").orbits.iter().take(12) {
            let settings = |parameter, range, rising| {
                let settings = Continuation::new(parameter, range, rising).expect("legal");
                settings.with_steps(0.01, 0.1, 400).expect("legal")
            };
            for up in [true, false] {
                let branch = map.continued(orbit, &settings(Forcing, (0.05, 1.6), up), &Unobserved);
                let branch = branch.expect("continued");
                for index in 0..branch.bifurcations.len() {
                    for rising in [true, false] {
                        let second = settings(Restitution, (0.05, 0.95), rising);
                        match branch.curve(index, (0.05, 2.0), &second, &Unobserved) {
                            Ok(curve) => see(&branch, curve),
                            Err(Error::NotOfKind { .. }) => {}
                            // A flight that grazes twice at the start.
                            Err(error) => assert!(matches!(error, Error::NoBranch { .. }), "{error}"),
                        }
                    }
                }
            }
        }
    }
}

/// From an independent program with 70 digits, which finds the closed sequences by Newton's method with differences of
/// 1e-30. At a cusp the first two derivatives of the forcing over the first phase vanish. At a change of criticality
/// the doubled orbit at a distance of 1e-9 has the forcing of the doubling.
const CUSPS: [[f64; 2]; 2] =
    [[0.800_880_630_061_099_9, 0.477_639_290_488_790_2], [0.440_254_309_679_521_6, 0.746_770_725_654_488_3]];
const CRITICALITY_CHANGES: [[f64; 2]; 2] =
    [[0.375_700_644_652_223, 0.808_519_467_060_148_3], [0.404_659_544_998_400_1, 0.784_089_120_051_399_5]];

#[test]
fn curves_of_random_maps_end_with_a_reason_and_have_the_points_of_another_program() {
    let (mut ends, mut judged) = (BTreeMap::<(&str, &str), u32>::new(), [0; 4]);
    let (mut checked, mut grazing) = (0, Vec::new());
    random_curves(30, 4, |branch, curve| {
        *ends.entry((curve.kind.name(), curve.end.name())).or_default() += 1;
        // A gap has a minimum only where the platform accelerates upwards against the disk by more than its weight.
        let lift_off = core::f64::consts::FRAC_1_PI;
        let grazes = matches!(curve.kind, BifurcationKind::Graze { .. });
        assert!(!grazes || curve.points.iter().all(|point| point.parameters[0] > lift_off - point.errors[0]));
        for special in &curve.special {
            let CurvePoint { parameters, errors, .. } = special.point;
            for (index, exact) in CUSPS.iter().chain(&CRITICALITY_CHANGES).enumerate() {
                let kind = if index < 2 { SpecialKind::Cusp } else { SpecialKind::CriticalityChange };
                let off = [0, 1].map(|k| (parameters[k] - exact[k]).abs());
                if special.kind == kind && off[0].max(off[1]) < 1e-4 {
                    assert!(off[0] <= errors[0] && off[1] <= errors[1], "{off:?} {special:?}");
                    let room = if index < 2 { 1e-13 } else { 1e-6 };
                    assert!(errors[0].max(errors[1]) < room, "{special:?}");
                    judged[index] += 1;
                }
            }
            if matches!(special.kind, SpecialKind::GrazingFold { .. } | SpecialKind::GrazingDoubling { .. }) {
                grazing.push((curve.kind.name(), special.kind.name(), parameters, errors));
            }
        }
        checked += agrees_with_continued(branch, &curve);
    });
    assert!(judged.iter().all(|count| *count > 0), "{judged:?}");
    assert!(checked >= 200, "{checked}");
    assert!(!ends.keys().any(|(_, end)| ["step too small", "point limit"].contains(end)), "{ends:?}");
    // Where a curve of folds or doublings ends in a graze, a curve of grazes passes: the two cross there.
    let mut crossings = 0;
    for (_, kind, one, errors) in grazing.iter().filter(|own| own.0 == "graze") {
        for (_, other_kind, other, more) in grazing.iter().filter(|own| own.0 != "graze") {
            let off = [0, 1].map(|k| (one[k] - other[k]).abs());
            if kind == other_kind && off[0].max(off[1]) < 1e-6 {
                assert!((0..2).all(|k| off[k] <= errors[k] + more[k]), "{off:?} {errors:?} {more:?}");
                crossings += 1;
            }
        }
    }
    assert!(crossings > 0);
}

/// How many points of a curve are bifurcations of the branch at their restitution, as `continued` finds them: none is
/// off by more than the sum of its error and that of the branch.
fn agrees_with_continued(branch: &Branch, curve: &Curve) -> u32 {
    let start = &branch.points[0];
    let mut checked = 0;
    for point in curve.points.iter().skip(1).step_by(8).take(3) {
        let [forcing, restitution] = point.parameters;
        // The same orbit at this restitution.
        let map = branch.map_at(start.parameter).expect("legal");
        let own = map.restitution();
        let range = (own.min(restitution) - 1e-3, own.max(restitution) + 1e-3);
        let settings = Continuation::new(Restitution, range, restitution > own).expect("legal");
        let Ok(aside) = map.continued_from(&start.orbit, &settings, &Unobserved) else { continue };
        let near = |point: &&BranchPoint| (point.parameter - restitution).abs() < 2e-3;
        let Some(there) = aside.points.iter().rev().find(near) else { continue };
        let Ok(map) = ImpactMap::new(*map.vibration(), restitution) else { continue };
        let Ok(orbit) = map.refine(&there.orbit.states) else { continue };
        for rising in [true, false] {
            let settings = Continuation::new(Forcing, (0.05, 2.0), rising).expect("legal");
            let Ok(found) = map.continued_from(&orbit, &settings, &Unobserved) else { continue };
            let offs = found.of_kind(curve.kind).map(|found| (found.point.parameter - forcing).abs());
            let nearest = offs.fold(f64::INFINITY, f64::min);
            if nearest < 1e-5 {
                // A branch locates a graze to 1e-11, and the other points to the rounding of the orbit.
                let own = if curve.kind.name() == "graze" { 1e-11 } else { 1e-13 };
                assert!(nearest <= point.errors[0] + own, "{nearest:e} {:?} {point:?}", curve.kind);
                checked += 1;
                break;
            }
        }
    }
    checked
}

/// Near the restitutions 0 and 1. At 1 both multipliers are 1 or -1, and the fold reaches the forcing 0. Towards 0 the
/// flight of the fold grazes the platform first.
#[test]
fn curves_reach_the_limits_of_the_restitution() {
    let branch = branch(1, 0.5);
    let limits = (f64::MIN_POSITIVE, 1.0 - f64::EPSILON / 2.0);
    let curve = |kind, rising| {
        let settings = Continuation::new(Restitution, limits, rising).expect("legal");
        branch.curve(index(&branch, kind), (0.0, 6.0), &settings, &Unobserved).expect("continued")
    };
    let (fold, doubled) = (BifurcationKind::Fold, BifurcationKind::Doubling);
    for (kind, rising, end, special) in [
        (fold, true, CurveEnd::RangeLimit { parameter: Forcing, value: 0.0 }, Some(SpecialKind::Resonance11)),
        (fold, false, CurveEnd::Graze { flight: 0 }, Some(SpecialKind::GrazingFold { flight: 0 })),
        (
            doubled,
            true,
            CurveEnd::RangeLimit { parameter: Restitution, value: limits.1 },
            Some(SpecialKind::Resonance12),
        ),
        (doubled, false, CurveEnd::RangeLimit { parameter: Restitution, value: limits.0 }, None),
    ] {
        let curve = curve(kind, rising);
        let [forcing, restitution] = curve.points.last().expect("some").parameters;
        assert_eq!(curve.end, end, "{forcing} {restitution}");
        assert_eq!(curve.special.iter().map(|special| special.kind).next(), special);
        let by_hand = if kind == fold { loss(restitution) } else { doubling(1, restitution) };
        assert!((forcing - by_hand).abs() <= 1e-14, "{forcing} {restitution}");
        if special != Some(SpecialKind::GrazingFold { flight: 0 }) {
            assert!(restitution.min(1.0 - restitution) < 1e-7, "{restitution}");
            continue;
        }
        // By hand: the smallest gap of the flight from phase 0, w t - t^2/2 + P (t - sin t).
        let lowest = |r: f64| {
            let (peak, speed) = (core::f64::consts::PI * loss(r), core::f64::consts::TAU * r / (1.0 + r));
            let gaps = (1..15_000).map(|step| {
                let t = 1e-4 * f64::from(step);
                speed * t - 0.5 * t * t + peak * (t - sin(t))
            });
            gaps.fold(f64::INFINITY, f64::min)
        };
        assert!(lowest(restitution - 1e-7) < 0.0 && lowest(restitution + 1e-7) > 0.0, "{restitution}");
    }
}

/// Where the platform begins to throw a disk off, Gamma = 1/pi, nothing happens to orbits that bounce: their folds pass,
/// and their doublings come down to it at restitution 1, where 2 (1 + r^2) = (1 + r)^2. Maps and ends of ranges lie
/// within a few units in the last place of it.
#[test]
fn curves_pass_lift_off_as_by_hand() {
    let lift_off = core::f64::consts::FRAC_1_PI;
    let around = |value: f64, ulps: i64| f64::from_bits(value.to_bits().wrapping_add_signed(ulps));
    for k in 1..=3 {
        // By hand: the fold of k periods is at this restitution.
        let there = |forcing: f64| (k as f64 - forcing) / (k as f64 + forcing);
        let up = Continuation::new(Restitution, (0.3, 0.999), true).expect("legal");
        let down = Continuation::new(Restitution, (0.3, 0.999), false).expect("legal");
        for ulps in -4..=4 {
            let end = around(lift_off, ulps);
            // From above the curve of folds falls to the end of its range, from below it rises to it.
            for (restitution, range, settings) in [(0.4, (end, 6.0), &up), (0.99, (1e-6, end), &down)] {
                let branch = branch(k, restitution);
                let curve = branch.curve(index(&branch, BifurcationKind::Fold), range, settings, &Unobserved);
                let curve = curve.expect("continued");
                let last = curve.points.last().expect("some");
                assert_eq!(curve.end, CurveEnd::RangeLimit { parameter: Forcing, value: end }, "{ulps}");
                let off = [(last.parameters[0] - end).abs(), (last.parameters[1] - there(end)).abs()];
                assert!(off[0] <= 1e-15 && off[1] <= 1e-14 + last.errors[1], "{ulps}: {off:?}");
                let by_hand = curve.points.iter().map(|point| (k as f64 * loss(point.parameters[1]), point));
                for (by_hand, point) in by_hand {
                    let off = (point.parameters[0] - by_hand).abs();
                    assert!(off <= point.errors[0] && off < 1e-14, "{ulps} {off:e} {point:?}");
                }
            }
            // A branch over the restitution at lift-off has the same fold, and its curve leaves both ways.
            let map = map(end, 0.5 * (1.0 + there(end)));
            let node = map.period_one_pair(k).expect("above its birth").node;
            let orbit: PeriodicOrbit = node.orbit(&map).expect("no failure").expect("admissible");
            let falling = Continuation::new(Restitution, (0.1, 0.9999), false).expect("legal");
            let branch = map.continued(&orbit, &falling, &Unobserved).expect("continued");
            let fold = index(&branch, BifurcationKind::Fold);
            let off = (branch.bifurcations[fold].point.parameter - there(end)).abs();
            assert!(off <= 1e-14, "{ulps}: {off:e}");
            for (rising, value) in [(true, 0.4), (false, 0.25)] {
                let settings = Continuation::new(Forcing, (0.25, 0.4), rising).expect("legal");
                let curve = branch.curve(fold, (0.1, 0.9999), &settings, &Unobserved).expect("continued");
                assert_eq!(curve.end, CurveEnd::RangeLimit { parameter: Forcing, value }, "{ulps}");
                for CurvePoint { parameters: [restitution, forcing], errors, .. } in &curve.points {
                    let off = (restitution - there(*forcing)).abs();
                    assert!(off <= errors[0] && off < 1e-14, "{ulps}: {off:e} {restitution} {forcing}");
                }
            }
        }
        // The doublings stay above it: with rho of the fold Gamma^2 is k^2 rho^2 + (1 + rho^2)^2/pi^2.
        let branch = branch(k, 0.5);
        let most = 1.0 - f64::EPSILON / 2.0;
        let settings = Continuation::new(Restitution, (0.5, most), true).expect("legal");
        let doublings =
            branch.curve(index(&branch, BifurcationKind::Doubling), (0.2, 6.0), &settings, &Unobserved);
        let doublings = doublings.expect("continued");
        for CurvePoint { parameters: [forcing, restitution], errors, .. } in &doublings.points {
            assert!(*forcing >= lift_off - errors[0], "{forcing} {restitution}");
            assert!(
                (forcing - doubling(k, *restitution)).abs() <= errors[0].min(1e-14),
                "{forcing} {restitution}"
            );
        }
        let [forcing, restitution] = doublings.points.last().expect("some").parameters;
        assert!((forcing - lift_off).abs() <= 1e-15 && 1.0 - restitution < 1e-7, "{forcing} {restitution}");
    }
}

#[test]
fn what_has_no_curve_is_refused() {
    let branch = branch(1, 0.5);
    let second = Continuation::new(Restitution, (0.1, 0.9), true).expect("legal");
    let refused = |index, range, settings: &Continuation| {
        branch.curve(index, range, settings, &Unobserved).expect_err("refused")
    };
    assert!(matches!(refused(9, (0.1, 2.0), &second), Error::NotOfKind { index: 9, .. }));
    assert!(matches!(refused(0, (2.0, 3.0), &second), Error::OutOfRange { .. }));
    assert!(matches!(refused(0, (1.0, 0.1), &second), Error::OutOfRange { .. }));
    let same = Continuation::new(Forcing, (0.1, 0.9), true).expect("legal");
    assert!(matches!(refused(0, (0.1, 2.0), &same), Error::NotOfKind { .. }));
    let none = Continuation::new(ContinuationParameter::SecondNumber, (0.1, 0.9), true).expect("legal");
    assert!(matches!(refused(0, (0.1, 2.0), &none), Error::NotOfKind { .. }));
    let stop = |_| core::ops::ControlFlow::Break(());
    let stopped = branch.curve(0, (0.1, 2.0), &second, &stop);
    assert!(matches!(stopped, Err(Error::Stopped { .. })), "{stopped:?}");
    let both = [second, Continuation::new(Restitution, (0.1, 0.9), false).expect("legal")];
    assert!(matches!(branch.curves((0.1, 2.0), &both, &stop), Err(Error::Stopped { .. })));
    let all = branch.curves((0.1, 2.0), &both, &Unobserved).expect("continued");
    let expected: Vec<_> = (0..branch.bifurcations.len()).flat_map(|index| [index, index]).collect();
    assert_eq!(all.iter().map(|own| own.0).collect::<Vec<_>>(), expected);
    assert_eq!(all[0].1, branch.curve(0, (0.1, 2.0), &second, &Unobserved).expect("continued"));
    let few = second.with_steps(1e-3, 1e-3, 5).expect("legal");
    let curve = branch.curve(0, (0.1, 2.0), &few, &Unobserved).expect("continued");
    assert_eq!((curve.points.len(), curve.end), (5, CurveEnd::PointLimit(5)));
}
