use super::*;
use crate::attractors::basin::{Axis, BasinSettings, Grid, KnownOrbit};
#[cfg(feature = "serde")]
use crate::attractors::{AttractorSearch, Attractors};
use crate::chaos::{ManifoldKind, ManifoldSettings};
use crate::map::impact_map::map;
use crate::numerics::random::SplitMix64;
use crate::numerics::testing::stored;
use crate::orbits::continuation::{BifurcationKind, Continuation};
use crate::orbits::periodic::catalogue::OrbitSearch;
use crate::orbits::{ContinuationParameter, ContinuedMap as _, PeriodOneOrbit};
use crate::run::Unobserved;

fn orbit_of(map: &ImpactMap, member: PeriodOneOrbit) -> PeriodicOrbit {
    member.orbit(map).expect("no failure").expect("admissible")
}

fn misses<T: core::fmt::Debug>(result: Result<T, Error>) -> f64 {
    match result {
        Err(Error::NotAnOrbit { impact: 0, distance }) => distance,
        other => panic!("{other:?}"),
    }
}

#[test]
fn orbits_of_another_map_are_refused_by_all_that_take_one() {
    let (own, other) = (map(0.2, 0.8), map(0.345, 0.8));
    let pair = own.period_one_pair(1).expect("exists");
    let (node, saddle) = (orbit_of(&own, pair.node), orbit_of(&own, pair.saddle));
    let moved = misses(other.check_orbit(&node));
    // By hand: from tau = acos(5/9) with w = 2 pi/1.8, under P = 0.345 pi.
    let phase = other.step(node.states[0]).expect("flies").phase.angle();
    assert!((moved - phase_difference(phase, node.states[0].phase().angle()).abs()).abs() < 1e-15);
    assert!((moved - 0.45).abs() < 0.005, "{moved}");

    let grid = Grid::new(Axis::new(0.0, 1.0, 4).expect("legal"), Axis::new(0.0, 2.0, 4).expect("legal"));
    let (grid, settings) = (grid.expect("legal"), BasinSettings::default());
    let known = [KnownOrbit::new(node.clone(), 0.01).expect("legal")];
    let way = Continuation::new(ContinuationParameter::Forcing, (0.15, 0.4), true).expect("legal");
    let manifold = ManifoldSettings::new(1.0, 100).expect("legal");
    let refusals = |other: &ImpactMap| {
        [
            misses(node.trapping_radius(other, 64, &Unobserved)),
            misses(node.proven_radius(other)),
            misses(other.basins(grid, &known, settings, &Unobserved)),
            misses(other.continued(&node, &way, &Unobserved)),
            misses(other.manifold(&saddle, ManifoldKind::Unstable, &manifold, &Unobserved)),
        ]
    };
    assert!(refusals(&other).iter().all(|distance| *distance > 0.1));
    // Nearly the same map; and a map with another restitution, on which the disk comes to rest at once.
    assert!(refusals(&map(0.2 * (1.0 + 1e-6), 0.8)).iter().all(|distance| *distance < 1e-3));
    assert!(misses(map(0.2, 0.8 + 1e-6).check_orbit(&node)) > 1e-7);
    assert!(misses(map(0.2, 0.0).check_orbit(&node)).is_infinite());
    assert_eq!(pair.node.is_admissible(&other), Ok(false));
}

#[cfg(feature = "serde")]
#[test]
fn stored_results_with_orbits_of_another_map_are_refused() {
    let own = map(0.45, 0.5);
    let found = own.attractors(&AttractorSearch::default(), &Unobserved).expect("finds");
    assert_eq!(stored(&found), found);
    let of_another = |text: Result<String, serde_json::Error>| {
        text.expect("writes").replacen("\"restitution\":0.5", "\"restitution\":0.51", 1)
    };
    let found = serde_json::from_str::<Attractors>(&of_another(serde_json::to_string(&found)));
    let error = found.expect_err("another map").to_string();
    assert!(error.contains("not an orbit of this map: after impact 1 "), "{error}");
}

/// Orbits from searches, refinements and branches, stable or not, near folds and grazes, even after storing.
#[test]
fn own_orbits_are_never_refused() {
    let mut random = SplitMix64::new(64);
    let search = |impacts, starts| {
        let search = OrbitSearch::new(impacts, 4).and_then(|search| search.with_starts(starts, starts));
        search.expect("legal")
    };
    let mut checked = 0;
    for _ in 0..16 {
        let own = map(0.1 + 2.4 * random.unit(), 0.98 * random.unit());
        for orbit in own.periodic_orbits(&search(5, 12), &Unobserved).expect("no failure").orbits {
            assert_eq!(own.check_orbit(&orbit), Ok(()), "{own} {orbit:?}");
            assert_eq!(own.check_orbit(&stored(&orbit)), Ok(()), "{own} {orbit:?}");
            checked += 1;
        }
    }
    for (restitution, above) in [(0.0, 1e-9), (0.3, 1e-12), (0.8, 0.05), (0.97, 1e-3)] {
        let own = map((1.0 - restitution) / (1.0 + restitution) * (1.0 + above), restitution);
        let pair = own.period_one_pair(1).expect("exists");
        // Without restitution there is no saddle.
        let members = [pair.node, pair.saddle].map(|member| member.orbit(&own).expect("no failure"));
        for orbit in members.iter().flatten() {
            assert_eq!(own.check_orbit(orbit), Ok(()), "{own} {orbit:?}");
        }
    }
    // Branches to their grazes and vanishing impacts.
    let own = map(0.55, 0.5);
    let mut ends = 0;
    for orbit in own.periodic_orbits(&search(3, 16), &Unobserved).expect("no failure").orbits {
        for rising in [false, true] {
            let way = Continuation::new(ContinuationParameter::Forcing, (0.3, 1.2), rising).expect("legal");
            let branch = own.continued(&orbit, &way, &Unobserved).expect("continued");
            ends += branch
                .bifurcations
                .iter()
                .filter(|found| {
                    matches!(
                        found.kind,
                        BifurcationKind::Graze { .. } | BifurcationKind::VanishingImpact { .. }
                    )
                })
                .count();
            for point in &branch.points {
                let there = branch.map_at(point.parameter).expect("legal");
                assert_eq!(there.check_orbit(&point.orbit), Ok(()), "{there} {point:?}");
                checked += 1;
            }
        }
    }
    assert!(checked > 500 && ends > 3, "{checked} {ends}");
}
