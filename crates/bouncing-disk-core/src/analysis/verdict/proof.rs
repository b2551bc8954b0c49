//! Whether an orbit that nearly repeats itself is on its way to an attracting periodic orbit.

use super::VerdictSettings;
use crate::analysis::periodic::{PeriodicOrbit, distance};
use crate::map::impact_map::{ImpactMap, ImpactState};
use crate::numerics::elementary::{exp, ln};

/// Where the parts of a solution repeat each other to within this (rad, relative speed), the shorter orbit is
/// sought: next to a doubling the equations are nearly singular, and a solution of rounded ones is that far
/// from the exact one.
const NEARLY_SAME: f64 = 1.0e-2;

/// Nearer than this (rad) rounding keeps an orbit from coming nearer.
const ROUNDING_DISTANCE: f64 = 1.0e-11;

/// Most impacts over which an orbit must come nearer.
const MOST_CONFIRMING: u64 = 8_192;

/// An attracting periodic orbit, and how near it the state was that it was found from.
pub(super) struct Proof {
    pub(super) orbit: PeriodicOrbit,
    pub(super) distance: f64,
}

/// The attracting orbit that the orbit from `state`, which nearly repeats itself after `period` impacts,
/// comes ever nearer to.
pub(super) fn prove(
    map: &ImpactMap,
    state: ImpactState,
    period: usize,
    settings: &VerdictSettings,
) -> Option<Proof> {
    // Next to a doubling the impacts of both halves of the orbit look like one.
    let twice = 2 * period;
    let candidates = [Some(period), (twice <= settings.longest_period).then_some(twice)];
    let mut orbits = candidates.into_iter().flatten().map_while(|period| {
        let guess = impacts_from(map, state, period)?;
        Some(prime(map, map.refine(&guess).ok()?))
    });
    let orbit = orbits.find(attracts)?;
    let bounces_on = |impact: &ImpactState| !map.chatters_to_rest(map.rebound(*impact));
    let distance = orbit.distance(state, map.vibration().peak_acceleration());
    let proved = orbit.states.iter().all(bounces_on) && comes_nearer(map, &orbit, state, distance);
    proved.then_some(Proof { orbit, distance })
}

fn attracts(orbit: &PeriodicOrbit) -> bool {
    orbit.multipliers().spectral_radius() < 1.0
}

/// So many impacts from this one on.
fn impacts_from(map: &ImpactMap, state: ImpactState, count: usize) -> Option<Vec<ImpactState>> {
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

/// The orbit with its smallest period: a shorter one that it nearly repeats, if that attracts.
fn prime(map: &ImpactMap, orbit: PeriodicOrbit) -> PeriodicOrbit {
    let states = &orbit.states;
    let n = states.len();
    let fastest = states.iter().fold(1.0_f64, |most, state| most.max(state.velocity().abs()));
    let repeats = |part: &usize| {
        n.is_multiple_of(*part)
            && (0..n - part).all(|i| distance(states[i], states[i + part], fastest) <= NEARLY_SAME)
    };
    (1..n).filter(repeats).filter_map(|part| map.refine(&states[..part]).ok()).find(attracts).unwrap_or(orbit)
}

/// Whether the orbit from `state` comes nearer to the periodic one, after whole periods of it: by half of
/// what its multipliers promise within twice the time that they take to shrink a distance to a third, or
/// within the impacts that there are for it.
fn comes_nearer(map: &ImpactMap, orbit: &PeriodicOrbit, state: ImpactState, from: f64) -> bool {
    if from <= ROUNDING_DISTANCE {
        return true;
    }
    let period = orbit.period() as u64;
    let scale = map.vibration().peak_acceleration();
    let radius = orbit.multipliers().spectral_radius();
    let periods = 2.0 / (1.0 - radius) + 2.0;
    let rounds = (MOST_CONFIRMING / period).max(1).min(periods as u64);
    let promised = if radius > 0.0 { exp(rounds as f64 * ln(radius)) } else { 0.0 };
    let mut state = state;
    for _ in 0..rounds {
        let Ok(next) = map.iterate(state, period) else { return false };
        state = next;
        if orbit.distance(state, scale) <= 0.5 * (1.0 + promised) * from {
            return true;
        }
    }
    false
}
