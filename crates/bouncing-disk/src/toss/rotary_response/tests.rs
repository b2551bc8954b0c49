use std::f64::consts::{PI, TAU};

use bouncing_disk_core::numerics::random::SplitMix64;
use bouncing_disk_core::orbits::OrbitSearch;
use bouncing_disk_core::{ChatterPolicy, Unobserved};

use super::*;
use crate::parameters::dimensionless::{DimensionlessParameters, ForcingParameters};
use crate::toss::collisions::{CollisionEvent, CollisionState, Collisions};
use crate::toss::rotary_response::period_one_rotary_speed;

/// A system with a friction of 0.4.
pub(in crate::toss) fn system(
    forcing: f64,
    restitution: f64,
    twist: f64,
    lag: f64,
    load: f64,
) -> DimensionlessSystem {
    DimensionlessParameters {
        peak_acceleration: PI * forcing,
        twist_speed: twist,
        phase_lag: lag,
        friction: 0.4,
        restitution,
        load,
    }
    .build()
    .expect("legal")
}

/// Periodic orbits of several maps, stable and unstable.
pub(in crate::toss) fn orbits() -> Vec<(f64, f64, PeriodicOrbit)> {
    let mut all = Vec::new();
    for (forcing, restitution) in [(0.45, 0.5), (0.5, 0.5), (0.6, 0.5), (0.9, 0.3), (0.5, 0.75)] {
        let map = *system(forcing, restitution, 0.0, 0.0, 0.0).map();
        let search = OrbitSearch::new(3, 3).expect("legal");
        for orbit in map.periodic_orbits(&search, &Unobserved).expect("found").orbits {
            all.push((forcing, restitution, orbit));
        }
    }
    assert!(all.len() > 15 && all.iter().any(|(_, _, orbit)| orbit.period() == 3), "{}", all.len());
    all
}

/// Systems with random twist, lag and load, from nearly zero to strong.
fn random_systems(forcing: f64, restitution: f64, random: &mut SplitMix64) -> Vec<DimensionlessSystem> {
    (0..12)
        .map(|k| {
            let twist = [0.1, 1.0, 10.0, 100.0][k % 4] * (0.5 + random.unit());
            let load = if k < 6 { 0.0 } else { 0.4 * (1.8 * random.unit() - 0.9) };
            system(forcing, restitution, twist, 2.0 * PI * random.unit(), load)
        })
        .collect()
}

/// The engine, which uses none of this, keeps the steady spin for a period of the orbit.
#[test]
fn the_engine_keeps_the_steady_spin_on_every_orbit() {
    let mut random = SplitMix64::new(1);
    let (mut unstable, mut sliding) = (0, 0);
    for (forcing, restitution, orbit) in orbits() {
        for system in random_systems(forcing, restitution, &mut random) {
            let outcome = rotary_response(&system, &orbit).expect("an orbit");
            let steady = outcome.steady().expect("a load below friction");
            sliding += usize::from(steady.sticking_impacts() < orbit.period());
            unstable += usize::from(orbit.multipliers().spectral_radius() > 1.0);
            let start = CollisionState {
                phase: orbit.states[0].phase(),
                axial_impact_velocity: orbit.states[0].velocity(),
                tangential_impact_velocity: steady.slips[0],
            };
            let mut collisions = Collisions::after(system, start, ChatterPolicy::Complete).expect("starts");
            for step in 1..=orbit.period() {
                let Some(CollisionEvent::Collision(found)) = collisions.advance().expect("flies") else {
                    panic!("no impact")
                };
                let index = step % orbit.period();
                let scale = 1.0 + system.twist_speed();
                let off = (found.angular_speed - steady.angular_speeds[index]).abs() / scale;
                assert!(off < 1e-8, "{system:?} {index}: {off:e}");
                let off = (found.state.tangential_impact_velocity - steady.slips[index]).abs() / scale;
                assert!(off < 1e-8, "{system:?} {index}: {off:e}");
                assert_eq!(found.capped, steady.sliding[index].is_none(), "{system:?} {index}");
            }
        }
    }
    assert!(unstable > 50 && sliding > 50, "{unstable} {sliding}");
}

/// On an attracting orbit the engine reaches the steady spin from a different spin.
#[test]
fn the_engine_settles_on_the_steady_spin() {
    let mut random = SplitMix64::new(2);
    let mut tried = 0;
    for (forcing, restitution, orbit) in orbits() {
        if orbit.multipliers().spectral_radius() > 0.95 {
            continue;
        }
        for system in random_systems(forcing, restitution, &mut random) {
            let outcome = rotary_response(&system, &orbit).expect("an orbit");
            let steady = outcome.steady().expect("a load below friction");
            let start = CollisionState {
                phase: orbit.states[0].phase(),
                axial_impact_velocity: orbit.states[0].velocity(),
                tangential_impact_velocity: 3.0 * system.twist_speed() + 1.0,
            };
            let mut collisions = Collisions::after(system, start, ChatterPolicy::Complete).expect("starts");
            let impacts = orbit.period() * 3_000;
            let mut last = 0.0;
            for _ in 0..impacts {
                let Some(CollisionEvent::Collision(found)) = collisions.advance().expect("flies") else {
                    panic!("no impact")
                };
                last = found.angular_speed;
            }
            let off = (last - steady.angular_speeds[0]).abs() / (1.0 + system.twist_speed());
            assert!(off < 1e-8, "{system:?}: {off:e}");
            tried += 1;
        }
    }
    assert!(tried > 30, "{tried}");
}

/// Single rounds from any spin: at first no impact ends the slip, and finally at least one always does.
#[test]
fn every_spin_is_forgotten_in_finitely_many_rounds() {
    let mut random = SplitMix64::new(3);
    let (mut slid, mut rounds_of_all) = (0, 0);
    for (forcing, restitution, orbit) in orbits().into_iter().step_by(3) {
        for system in random_systems(forcing, restitution, &mut random).into_iter().take(8) {
            let outcome = rotary_response(&system, &orbit).expect("an orbit");
            let steady = outcome.steady().expect("a load below friction");
            let mut speed = (6.0 * random.unit() - 3.0) * system.twist_speed();
            let mut rounds = 0;
            loop {
                let round = rotary_round(&system, &orbit, speed).expect("a round");
                slid += usize::from(round.sticking_impacts == 0);
                rounds += 1;
                let settled = round.angular_speed.to_bits() == speed.to_bits();
                speed = round.angular_speed;
                if settled {
                    assert_eq!(round.sticking_impacts, steady.sticking_impacts());
                    break;
                }
                assert!(rounds < 100_000, "{system:?}: {speed} {steady:?}");
            }
            rounds_of_all += rounds;
            let off = (speed - steady.angular_speeds[0]).abs() / (1.0 + system.twist_speed());
            assert!(off < 1e-12, "{system:?}: {off:e}");
        }
    }
    assert!(slid > 20 && rounds_of_all > 100, "{slid} {rounds_of_all}");
}

/// Over a period friction balances the load; its capacity is mu times the time, because the mean normal force
/// is the weight.
#[test]
fn impulses_balance_the_load_and_the_weight() {
    let mut random = SplitMix64::new(4);
    for (forcing, restitution, orbit) in orbits() {
        for system in random_systems(forcing, restitution, &mut random) {
            let map = SpinMap::of(&system, &orbit).expect("an orbit");
            let time = orbit.platform_periods as f64 * TAU;
            let available: f64 = map.available.iter().sum();
            assert!((available - system.friction() * time).abs() < 1e-9 * time);
            let steady = map.steady();
            let given: f64 = (0..map.len())
                .map(|i| match steady.sliding[i] {
                    None => -steady.slips[i],
                    Some(direction) => -direction.sign() * map.available[i],
                })
                .sum();
            let scale = 1.0 + system.twist_speed();
            assert!((given - system.load() * time).abs() < 1e-9 * scale, "{given} {}", system.load() * time);
            assert!(steady.stick_margin >= 0.0);
        }
    }
}

/// With a twist far beyond friction the disk turns as the platform does at one of the impacts: the weighted
/// median of the platform's speeds.
#[test]
fn a_strong_twist_leaves_the_weighted_median() {
    for (forcing, restitution, orbit) in orbits() {
        for step in 0..7 {
            let twist = 1e6;
            let system = system(forcing, restitution, twist, 0.9 * f64::from(step), 0.0);
            let map = SpinMap::of(&system, &orbit).expect("an orbit");
            let mut order: Vec<usize> = (0..map.len()).collect();
            order.sort_by(|a, b| map.platform_speeds[*a].total_cmp(&map.platform_speeds[*b]));
            let half = 0.5 * map.available.iter().sum::<f64>();
            let mut sum = 0.0;
            let median = order.iter().find(|i| {
                sum += map.available[**i];
                sum >= half
            });
            let median = map.platform_speeds[*median.expect("one")];
            let steady = map.steady();
            assert!((steady.mean_angular_speed - median).abs() < 20.0, "{orbit:?} {steady:?} {median}");
        }
    }
}

/// One impact: Eq. (16), minus the loss by the load during the flight.
#[test]
fn one_impact_turns_by_equation_16() {
    for load in [0.0, 0.3, -0.39] {
        for k in 1..=3 {
            let system = system(1.5, 0.5, 2.0, 0.7, load);
            let pair = system.map().period_one_pair(k).expect("exists");
            let Some(orbit) = pair.node.orbit(system.map()).expect("no failure") else { continue };
            let outcome = rotary_response(&system, &orbit).expect("an orbit");
            let steady = outcome.steady().expect("a load below friction");
            let flight = TAU * k as f64;
            let expected = period_one_rotary_speed(&system, pair.node.state.phase()) - load * flight;
            assert!((steady.angular_speeds[0] - expected).abs() < 1e-12);
            assert!((steady.stick_margin - (0.4 - load.abs()) * flight).abs() < 1e-9);
            assert!((steady.mean_angular_speed - (expected + 0.5 * load * flight)).abs() < 1e-12);
            assert_eq!((steady.sliding.as_slice(), outcome.multiplier()), ([None].as_slice(), Some(0.0)));
        }
    }
}

#[test]
fn a_load_as_large_as_friction_keeps_spins_and_a_larger_one_none() {
    for (forcing, restitution, orbit) in orbits().into_iter().step_by(2) {
        for sign in [1.0, -1.0] {
            let held = system(forcing, restitution, 3.0, 0.4, 0.4 * sign);
            let outcome = rotary_response(&held, &orbit).expect("an orbit");
            let RotaryOutcome::Kept { limit: Some(limit) } = outcome else { panic!("{outcome:?}") };
            assert_eq!(outcome.multiplier(), Some(1.0));
            // Just beyond the limit all impacts slide, and the spin is kept; within it, one sticks.
            for off in [1e-6, 0.5, 50.0] {
                let speed = limit - sign * off;
                let round = rotary_round(&held, &orbit, speed).expect("a round");
                assert_eq!(round.sticking_impacts, 0, "{orbit:?}");
                assert!((round.angular_speed - speed).abs() < 1e-9, "{round:?} {speed}");
            }
            let round = rotary_round(&held, &orbit, limit + sign * 1e-6).expect("a round");
            assert!(round.sticking_impacts > 0);
            let heavy = system(forcing, restitution, 3.0, 0.4, 0.5 * sign);
            let outcome = rotary_response(&heavy, &orbit).expect("an orbit");
            let RotaryOutcome::Runaway { change } = outcome else { panic!("{outcome:?}") };
            let expected = -0.1 * sign * TAU * orbit.platform_periods as f64;
            assert!((change - expected).abs() < 1e-9, "{change} {expected}");
            let round = rotary_round(&heavy, &orbit, -1e4 * sign).expect("a round");
            assert!((round.angular_speed + 1e4 * sign - change).abs() < 1e-8);
            assert_eq!(outcome.multiplier(), None);
        }
    }
    let free =
        ForcingParameters { axial_forcing: 0.45, angular_forcing: 1.0, phase_lag: 0.0, restitution: 0.5 };
    let mut parameters = free.build().expect("legal").parameters();
    parameters.friction = 0.0;
    let free = parameters.build().expect("legal");
    let orbit = free.map().period_one_pair(1).expect("exists").node.orbit(free.map()).expect("no failure");
    let orbit = orbit.expect("admissible");
    assert_eq!(rotary_response(&free, &orbit), Ok(RotaryOutcome::Kept { limit: None }));
}

#[test]
fn what_is_no_orbit_of_the_system_is_refused() {
    let here = system(0.5, 0.5, 1.0, 0.0, 0.0);
    let there = system(0.52, 0.5, 1.0, 0.0, 0.0);
    let orbit = here.map().period_one_pair(1).expect("exists").saddle.orbit(here.map()).expect("no failure");
    let mut orbit = orbit.expect("admissible");
    assert!(rotary_response(&here, &orbit).is_ok());
    let error = rotary_response(&there, &orbit).expect_err("another map");
    assert!(matches!(error, Error::NotAnOrbit { impact: 0, distance } if distance > 1e-3), "{error}");
    assert!(rotary_round(&here, &orbit, f64::NAN).is_err());
    orbit.states.clear();
    assert!(matches!(rotary_response(&here, &orbit), Err(Error::OutOfRange { .. })));
}

/// Without twist the disk does not turn, and every impact sticks.
#[test]
fn without_twist_and_load_the_disk_stands_still() {
    for (forcing, restitution, orbit) in orbits() {
        let still = system(forcing, restitution, 0.0, 1.0, 0.0);
        let outcome = rotary_response(&still, &orbit).expect("an orbit");
        let steady = outcome.steady().expect("no load");
        assert!(steady.angular_speeds.iter().all(|speed| *speed == 0.0));
        assert_eq!(steady.sticking_impacts(), orbit.period());
    }
}
