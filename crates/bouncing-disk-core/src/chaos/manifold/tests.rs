//! Among the tests: starts 1e-3 to either side of the stable manifold of the period-1 saddle (sin tau < 0)
//! end differently, one at rest, one on the period-1 orbit (restitution 0.5; Gamma = 0.40, 0.45 and 0.47).
//! Every point of the manifolds of five saddles leads back to the saddle to 1e-3 under the inverse of the map
//! that grew it.

use crate::run::Unobserved;
use core::f64::consts::TAU;

use glam::DVec2;

use super::*;
use crate::attractors::basin::{ATTACHED, BasinSettings, KnownOrbit, UNDECIDED};
use crate::flight::platform::phase::Phase;
use crate::map::impact_map::map;
use crate::numerics::elementary::atan2;
use crate::numerics::testing::stored;
use crate::orbits::periodic::phase_difference;

fn saddle(map: &ImpactMap) -> PeriodicOrbit {
    map.period_one_pair(1).expect("exists").saddle.orbit(map).expect("flies").expect("admissible")
}

fn settings(arclength: f64) -> ManifoldSettings {
    ManifoldSettings::new(arclength, 20_000).expect("legal")
}

fn displacement(map: &ImpactMap, from: ImpactState, to: ImpactState) -> DVec2 {
    let phase = phase_difference(to.phase().angle(), from.phase().angle());
    DVec2::new(phase, (to.velocity() - from.velocity()) / (1.0 + map.vibration().peak_acceleration()))
}

/// The smallest distance of an orbit from a state.
fn nearest(map: &ImpactMap, start: ImpactState, target: ImpactState, kind: ManifoldKind) -> f64 {
    let mut nearest = f64::INFINITY;
    let mut state = start;
    for _ in 0..400 {
        nearest = nearest.min(displacement(map, state, target).length());
        let next = match kind {
            ManifoldKind::Stable => map.step(state).map(ImpactState::from),
            ManifoldKind::Unstable => map.step_back(state),
        };
        match next {
            Ok(next) => state = next,
            Err(_) => break,
        }
    }
    nearest
}

/// A manifold grown by one map is checked by the inverse: every point of the unstable manifold comes from the
/// saddle, and every point of the stable one leads there.
#[test]
fn every_point_comes_from_the_saddle_or_goes_there() {
    for (forcing, restitution) in [(0.45, 0.5), (0.40, 0.5), (0.561, 0.5), (0.50, 0.6), (0.25, 0.8)] {
        let map = map(forcing, restitution);
        let saddle = saddle(&map);
        for kind in [ManifoldKind::Stable, ManifoldKind::Unstable] {
            let manifold = map.manifold(&saddle, kind, &settings(8.0), &Unobserved).expect("grows");
            assert_eq!(manifold.branches.len(), 2);
            let (mut points, mut worst) = (0, 0.0_f64);
            for branch in &manifold.branches {
                assert!(branch.arclength > 0.0, "{map} {kind:?}");
                // Backwards, rounding errors grow by 1/r^2 in every flight. These saddles repel by more than
                // 2, so there are at most a dozen flights, and their restitution is not small.
                for state in branch.pieces.iter().flat_map(|piece| &piece.states) {
                    worst = worst.max(nearest(&map, *state, saddle.states[0], kind));
                    points += 1;
                }
            }
            assert!(points > 50 && worst < 1e-3, "{map} {kind:?}: {points} points, {worst}");
        }
    }
}

/// If the period-1 orbit attracts, the stable manifold of its partner separates it from rest.
#[test]
fn the_basin_changes_across_the_stable_manifold() {
    for (forcing, restitution) in [(0.40, 0.5), (0.45, 0.5), (0.47, 0.5)] {
        let map = map(forcing, restitution);
        let node = map.refine(&[map.period_one(1).expect("exists")]).expect("an orbit");
        let radius = node.trapping_radius(&map, 64, &Unobserved).expect("attracts");
        let known = [KnownOrbit::new(node, radius).expect("legal")];
        let manifold =
            map.manifold(&saddle(&map), ManifoldKind::Stable, &settings(20.0), &Unobserved).expect("grows");
        let [mut changes, mut same] = [0_u32; 2];
        let label = |state: ImpactState, by: DVec2| {
            let phase = Phase::new(state.phase().angle() + by.x).expect("finite");
            let velocity = state.velocity() + by.y * (1.0 + map.vibration().peak_acceleration());
            let start = ImpactState::new(phase, velocity).ok()?;
            let label = map.basin_label(start, &known, BasinSettings::default()).expect("decided");
            assert_ne!(label, UNDECIDED);
            Some(label == ATTACHED)
        };
        for piece in manifold.pieces() {
            for pair in piece.states.windows(2).step_by(3) {
                let along = displacement(&map, pair[0], pair[1]);
                let across = along.perp() / along.length() * 1e-3;
                if let (Some(left), Some(right)) = (label(pair[0], across), label(pair[0], -across)) {
                    if left == right { same += 1 } else { changes += 1 }
                }
            }
        }
        assert!(changes > 50 && same == 0, "{map}: {changes} {same}");
    }
}

/// Beyond the doubling the period-1 node has turned into a saddle with negative multipliers; its unstable
/// manifold ends on the orbit of twice the period.
#[test]
fn a_negative_multiplier_takes_two_rounds() {
    let map = map(0.50, 0.5);
    let node = map.refine(&[map.period_one(1).expect("exists")]).expect("an orbit");
    let manifold = map.manifold(&node, ManifoldKind::Unstable, &settings(50.0), &Unobserved).expect("grows");
    assert!(manifold.multiplier < -1.0);
    for branch in &manifold.branches {
        assert_eq!(branch.end, ManifoldEnd::Attracted, "{branch:?}");
        let last = *branch.pieces.last().and_then(|piece| piece.states.last()).expect("points");
        let after = map.iterate(last, 200, &Unobserved).expect("flies");
        assert_eq!(map.period_of(after, 8, 1e-9), Ok(Some(2)));
        assert!(displacement(&map, after, last).length() < 0.01, "{after} {last}");
    }
}

#[test]
fn a_finer_polygon_is_the_same_curve() {
    let map = map(0.561, 0.5);
    let saddle = saddle(&map);
    for kind in [ManifoldKind::Stable, ManifoldKind::Unstable] {
        let coarse = map.manifold(&saddle, kind, &settings(12.0), &Unobserved).expect("grows");
        let fine = settings(13.0).with_resolution(0.01, 0.05).expect("legal");
        let fine = map.manifold(&saddle, kind, &fine, &Unobserved).expect("grows");
        for (coarse, fine) in coarse.branches.iter().zip(&fine.branches) {
            assert!(coarse.end == fine.end && coarse.arclength > 10.0, "{:?} {:?}", coarse.end, fine.end);
            let mut worst = 0.0_f64;
            for state in coarse.pieces.iter().flat_map(|piece| &piece.states) {
                let near =
                    fine.pieces.iter().flat_map(|piece| &piece.states).fold(f64::INFINITY, |near, other| {
                        near.min(displacement(&map, *state, *other).length())
                    });
                worst = worst.max(near);
            }
            assert!(worst <= 0.01, "{kind:?}: {worst}");
        }
    }
}

/// Between two parts that are long enough to be divided the polygon turns by no more than requested.
#[test]
fn no_long_part_turns_by_more_than_was_asked() {
    let map = map(0.561, 0.5);
    let (chord, turn) = (0.05, 0.2);
    let settings = settings(12.0).with_resolution(chord, turn).expect("legal");
    let mut corners = 0;
    for kind in [ManifoldKind::Stable, ManifoldKind::Unstable] {
        let manifold = map.manifold(&saddle(&map), kind, &settings, &Unobserved).expect("grows");
        for piece in manifold.pieces() {
            let parts: Vec<_> =
                piece.states.windows(2).map(|ends| displacement(&map, ends[0], ends[1])).collect();
            for pair in parts.windows(2).filter(|pair| pair.iter().all(|part| part.length() > 0.1 * chord)) {
                let turned = atan2(pair[0].perp_dot(pair[1]), pair[0].dot(pair[1])).abs();
                assert!(turned <= turn + 1e-9, "{kind:?}: {turned}");
                corners += 1;
            }
        }
    }
    assert!(corners > 100, "{corners}");
}

/// A saddle of two impacts has four branches, and the branches at its second impact are the images of those
/// at the first.
#[test]
fn each_impact_of_a_saddle_has_its_branches() {
    let map = map(0.561, 0.5);
    let found = map
        .periodic_orbits(
            &crate::orbits::OrbitSearch::new(2, 2).expect("legal").with_starts(24, 24).expect("legal"),
            &Unobserved,
        )
        .expect("searched");
    let orbit = found
        .orbits
        .iter()
        .find(|orbit| orbit.period() == 2 && Saddle::of(&map, orbit, 0).is_ok())
        .expect("a saddle of two impacts");
    for kind in [ManifoldKind::Stable, ManifoldKind::Unstable] {
        let manifold = map.manifold(orbit, kind, &settings(2.0), &Unobserved).expect("grows");
        let places: Vec<_> = manifold.branches.iter().map(|branch| (branch.impact, branch.side)).collect();
        let expected = [(0, Side::Later), (0, Side::Earlier), (1, Side::Later), (1, Side::Earlier)];
        assert_eq!(places, expected);
        for branch in &manifold.branches {
            assert_eq!(branch.pieces[0].states[0], orbit.states[branch.impact]);
            assert_eq!(branch.pieces[0].start, PieceEnd::Saddle);
        }
    }
}

#[test]
fn limits_end_a_branch_and_say_so() {
    let map = map(0.561, 0.5);
    let saddle = saddle(&map);
    let grown = |settings: ManifoldSettings| {
        map.manifold(&saddle, ManifoldKind::Stable, &settings, &Unobserved).expect("grows").branches
    };
    for branch in grown(ManifoldSettings::new(1e6, 50).expect("legal")) {
        let points: usize = branch.pieces.iter().map(|piece| piece.states.len()).sum();
        assert!(branch.end == ManifoldEnd::Points && points <= 52, "{:?} {points}", branch.end);
    }
    for branch in grown(settings(1e6).with_generations(3).expect("legal")) {
        assert_eq!((branch.end, branch.generations), (ManifoldEnd::Generations, 3));
    }
    for branch in grown(settings(0.5)) {
        assert!(branch.end == ManifoldEnd::Arclength && branch.arclength < 0.56);
    }
    // Faster impacts, and only these, are omitted as requested.
    let bound = map.launch_speed_bound();
    let own = |state: &ImpactState| {
        (map.vibration().velocity(state.phase()) - map.restitution() * state.velocity()).abs()
    };
    let fastest = |branches: Vec<ManifoldBranch>| {
        branches
            .iter()
            .flat_map(|branch| &branch.pieces)
            .flat_map(|piece| &piece.states)
            .fold(0.0_f64, |most, state| most.max(own(state)))
    };
    let (near, far) = (
        fastest(grown(settings(60.0))),
        fastest(grown(settings(60.0).with_launch_speed(9.0).expect("legal"))),
    );
    assert!(near <= bound && near > 0.9 * bound, "{near} {bound}");
    assert!(far <= 9.0 && far > 8.0, "{far}");
    let less = grown(settings(60.0).with_launch_speed(0.0).expect("legal"));
    assert_eq!(less, grown(settings(60.0)));
}

#[test]
fn what_is_no_saddle_has_no_manifold() {
    let map = map(0.45, 0.5);
    let node = map.refine(&[map.period_one(1).expect("exists")]).expect("an orbit");
    let refused = |map: &ImpactMap, orbit: &PeriodicOrbit, kind: ManifoldKind| {
        map.manifold(orbit, kind, &settings(1.0), &Unobserved).expect_err("refused")
    };
    for kind in [ManifoldKind::Stable, ManifoldKind::Unstable] {
        assert!(matches!(refused(&map, &node, kind), Error::OutOfRange { .. }));
    }
    let moved = ImpactState::new(node.states[0].phase(), -4.0).expect("legal");
    let none = PeriodicOrbit { states: vec![moved], ..node.clone() };
    assert!(
        matches!(refused(&map, &none, ManifoldKind::Stable), Error::NotAnOrbit { distance, .. } if distance > 0.01)
    );
    let empty = PeriodicOrbit { states: Vec::new(), ..node };
    assert!(matches!(refused(&map, &empty, ManifoldKind::Stable), Error::OutOfRange { .. }));
    // Restitution 0 has no inverse, but an unstable manifold.
    let dead = self::map(1.3, 0.0);
    let orbit = dead.refine(&[dead.period_one(1).expect("exists")]).expect("an orbit");
    assert!(matches!(refused(&dead, &orbit, ManifoldKind::Stable), Error::OutOfRange { .. }));
    assert!(dead.manifold(&orbit, ManifoldKind::Unstable, &settings(1.0), &Unobserved).is_ok());
}

#[test]
fn settings_and_results_are_what_they_say() {
    let legal = settings(1.0);
    stored(&legal.with_launch_speed(3.0).expect("legal"));
}

/// Near its birth the saddle lies on the seam of the phase.
#[test]
fn a_saddle_at_the_seam_is_like_any_other() {
    let map = map(1.0 / 3.0 + 1e-6, 0.5);
    let saddle = saddle(&map);
    assert!(TAU - saddle.states[0].phase().angle() < 0.01);
    let manifold = map.manifold(&saddle, ManifoldKind::Stable, &settings(3.0), &Unobserved).expect("grows");
    for piece in manifold.pieces() {
        for pair in piece.states.windows(2) {
            assert!(displacement(&map, pair[0], pair[1]).length() < 0.08);
        }
    }
}
