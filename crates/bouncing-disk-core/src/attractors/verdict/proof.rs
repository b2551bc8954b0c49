//! The proof that an orbit that nearly repeats itself approaches an attracting periodic orbit, or stays at
//! one.

use super::VerdictSettings;
use crate::map::impact_map::ImpactState;
use crate::numerics::elementary::{exp, ln};
use crate::orbits::periodic::newton::repetitions;
use crate::orbits::periodic::{Multipliers, PeriodicOrbit, Stability};
use crate::sweep::bouncing_map::BouncingMap;

/// If the parts of a solution repeat each other to within this (rad, relative speed), the code looks for the
/// shorter orbit: near a doubling the equations are nearly singular, and rounding may move their solution
/// that far.
const NEARLY_SAME: f64 = 1.0e-2;

/// At this distance (rad) rounding keeps an orbit from approaching further.
const ROUNDING_DISTANCE: f64 = 1.0e-11;

/// Largest number of impacts within which an orbit must come nearer.
const MOST_CONFIRMING: u64 = 8_192;

/// An orbit farther from a periodic one than this (rad) may come nearer by chance: it wanders, or circles it.
const NEAR: f64 = 1.0e-2;

/// Largest factor by which a more distant orbit may recede again while it approaches.
const MOST_DETOUR: f64 = 10.0;

/// An orbit that rotates about a periodic one cannot be seen to approach if the multipliers leave more than
/// this share of the distance, unless it is within [`LINEAR`].
const UNSEEN: f64 = 0.9;

/// Distance (rad) within which no other orbit attracts.
const LINEAR: f64 = 1.0e-5;

/// The distance (rad) within which an orbit that was on a neutral one must stay near it.
const STAYS_WITHIN: f64 = 2.0e-6;

/// Largest error of multipliers that still prove anything.
const LARGEST_ERROR: f64 = 1.0e-2;

/// A periodic orbit near a followed orbit.
pub(super) struct Proof {
    pub(super) orbit: PeriodicOrbit,
    pub(super) distance: f64,
    pub(super) stability: Stability,
}

/// The periodic orbit that the orbit from `state` approaches, otherwise one at which it stays. The orbit from
/// `state` nearly repeats itself after `period` impacts.
pub(super) fn prove(
    map: &impl BouncingMap,
    state: ImpactState,
    period: usize,
    settings: &VerdictSettings,
) -> Option<Proof> {
    // Near a doubling the impacts of both halves of the orbit look the same.
    let twice = 2 * period;
    let candidates = [Some(period), (twice <= settings.longest_period).then_some(twice)];
    let orbits = candidates.into_iter().flatten().map_while(|period| {
        let guess = impacts_from(map, state, period)?;
        Some(prime(map, map.refine(&guess).ok()?))
    });
    let orbit = orbits.filter(is_known).min_by_key(PeriodicOrbit::stability)?;
    let stability = orbit.stability();
    let bounces_on = |impact: &ImpactState| !map.chatters_to_rest_after(*impact);
    let distance = orbit.distance(state, map.speed_scale());
    let proved = orbit.states.iter().all(bounces_on)
        && match stability {
            Stability::Stable => comes_nearer(map, &orbit, state, distance),
            Stability::Marginal => stays_within(map, &orbit, state, 2.0 * distance.max(STAYS_WITHIN)),
            Stability::Unstable => distance <= STAYS_WITHIN,
        };
    proved.then_some(Proof { orbit, distance, stability })
}

/// Whether the multipliers of an orbit are known well enough to judge it.
fn is_known(orbit: &PeriodicOrbit) -> bool {
    orbit.multiplier_error() <= LARGEST_ERROR * orbit.multipliers().spectral_radius().max(1.0)
}

/// `count` impacts, beginning with `state`.
fn impacts_from(map: &impl BouncingMap, state: ImpactState, count: usize) -> Option<Vec<ImpactState>> {
    let mut impacts = Vec::with_capacity(count);
    let mut state = state;
    loop {
        impacts.push(state);
        if impacts.len() >= count {
            return Some(impacts);
        }
        state = map.step(state).ok()?.into();
    }
}

/// The orbit with its smallest period: a shorter one that it nearly repeats, unless the shorter repels and
/// this one does not.
fn prime(map: &impl BouncingMap, orbit: PeriodicOrbit) -> PeriodicOrbit {
    let is = |orbit: &PeriodicOrbit, least| is_known(orbit) && orbit.stability() <= least;
    let least = if is(&orbit, Stability::Marginal) { Stability::Marginal } else { Stability::Unstable };
    let states = &orbit.states;
    let mut shorter = repetitions(states, NEARLY_SAME).filter_map(|part| map.refine(&states[..part]).ok());
    let found = shorter.find(|orbit| is(orbit, least));
    drop(shorter);
    found.unwrap_or(orbit)
}

/// Whether the orbit from `state` comes nearer to the periodic one, after whole periods. It must achieve at
/// least half of the decrease that the multipliers predict, within about twice the time in which they shrink
/// a distance to a third, or within [`MOST_CONFIRMING`] impacts if these are fewer. A distant orbit must come
/// [near](NEAR) first, and then not recede.
fn comes_nearer(
    map: &impl BouncingMap,
    orbit: &PeriodicOrbit,
    mut state: ImpactState,
    mut from: f64,
) -> bool {
    let period = orbit.period() as u64;
    let most_rounds = (MOST_CONFIRMING / period).max(1);
    let farthest = if from > NEAR { MOST_DETOUR * NEAR } else { f64::INFINITY };
    for _ in 0..most_rounds {
        if from <= NEAR {
            break;
        }
        let Ok(next) = map.steps(state, period) else { return false };
        (state, from) = (next, orbit.distance(next, map.speed_scale()));
    }
    if from > NEAR {
        return false;
    }
    if from <= ROUNDING_DISTANCE {
        return true;
    }
    let radius = orbit.multipliers().spectral_radius();
    let periods = 2.0 / (1.0 - radius) + 2.0;
    let rounds = most_rounds.min(periods as u64);
    let promised = if radius > 0.0 { exp(rounds as f64 * ln(radius)) } else { 0.0 };
    let turns = matches!(orbit.multipliers(), Multipliers::Complex { .. });
    if turns && promised > UNSEEN && from > LINEAR {
        return false;
    }
    let near = 0.5 * (1.0 + promised) * from;
    let distances = distances(map, orbit, state).take(rounds as usize);
    distances.map_while(|distance| distance.filter(|own| *own <= farthest)).any(|own| own <= near)
}

/// Whether the orbit from `state` stays within `most` of the periodic one over the largest number of impacts
/// of a proof.
fn stays_within(map: &impl BouncingMap, orbit: &PeriodicOrbit, state: ImpactState, most: f64) -> bool {
    let rounds = (MOST_CONFIRMING as usize / orbit.period()).max(1);
    let mut distances = distances(map, orbit, state).take(rounds);
    distances.all(|distance| distance.is_some_and(|distance| distance <= most))
}

/// The distances between the orbit from `state` and the periodic one after each period of the latter; `None`
/// once it has no next impact.
fn distances(
    map: &impl BouncingMap,
    orbit: &PeriodicOrbit,
    state: ImpactState,
) -> impl Iterator<Item = Option<f64>> {
    let scale = map.speed_scale();
    let mut state = Some(state);
    core::iter::repeat_with(move || {
        state = state.and_then(|state| map.steps(state, orbit.period() as u64).ok());
        state.map(|state| orbit.distance(state, scale))
    })
}
