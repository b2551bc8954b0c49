//! Whether an orbit that nearly repeats itself is on its way to an attracting periodic orbit, or stays at one.

use glam::{DMat2, DVec2};

use super::VerdictSettings;
use crate::analysis::periodic::{Multipliers, PeriodicOrbit, distance};
use crate::error::Error;
use crate::map::impact_map::{ImpactMap, ImpactState};
use crate::numerics::elementary::{exp, ln};
use crate::platform::phase::Phase;

/// Where the parts of a solution repeat each other to within this (rad, relative speed), the shorter orbit is
/// sought: next to a doubling the equations are nearly singular, and a solution of rounded ones is that far
/// from the exact one.
const NEARLY_SAME: f64 = 1.0e-2;

/// Nearer than this (rad) rounding keeps an orbit from coming nearer.
const ROUNDING_DISTANCE: f64 = 1.0e-11;

/// Most impacts over which an orbit must come nearer.
const MOST_CONFIRMING: u64 = 8_192;

/// The displacement (rad, g/omega) by which the change of a multiplier along its direction is measured.
const DISPLACEMENT: f64 = 1.0e-6;

/// How near an orbit must stay to a neutral one that it was on (rad).
const STAYS_WITHIN: f64 = 2.0e-6;

/// Multipliers that may be off by more say nothing.
const LARGEST_ERROR: f64 = 1.0e-2;

/// A periodic orbit next to a followed one.
pub(super) struct Proof {
    pub(super) orbit: PeriodicOrbit,
    pub(super) distance: f64,
    pub(super) multiplier_error: f64,
    pub(super) stability: Stability,
}

/// What the larger modulus of the multipliers says, with its error.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Stability {
    Attracts,
    Neutral,
    Repels,
}

/// The periodic orbit that the orbit from `state`, which nearly repeats itself after `period` impacts, comes
/// ever nearer to, or else one that it stays at.
pub(super) fn prove(
    map: &ImpactMap,
    state: ImpactState,
    period: usize,
    settings: &VerdictSettings,
) -> Option<Proof> {
    // Next to a doubling the impacts of both halves of the orbit look like one.
    let twice = 2 * period;
    let candidates = [Some(period), (twice <= settings.longest_period).then_some(twice)];
    let orbits = candidates.into_iter().flatten().map_while(|period| {
        let guess = impacts_from(map, state, period)?;
        Some(prime(map, map.refine(&guess).ok()?))
    });
    let known = orbits.filter_map(|orbit| Some((stability(map, &orbit)?, orbit)));
    let ((stability, multiplier_error), orbit) = known.min_by_key(|((stability, _), _)| *stability)?;
    let bounces_on = |impact: &ImpactState| !map.chatters_to_rest(map.rebound(*impact));
    let distance = orbit.distance(state, map.vibration().peak_acceleration());
    let proved = orbit.states.iter().all(bounces_on)
        && match stability {
            Stability::Attracts => comes_nearer(map, &orbit, state, distance),
            Stability::Neutral => stays_within(map, &orbit, state, 2.0 * distance.max(STAYS_WITHIN)),
            Stability::Repels => distance <= STAYS_WITHIN,
        };
    proved.then_some(Proof { orbit, distance, multiplier_error, stability })
}

/// Whether an orbit attracts, and the error of its multipliers.
fn stability(map: &ImpactMap, orbit: &PeriodicOrbit) -> Option<(Stability, f64)> {
    let radius = orbit.multipliers().spectral_radius();
    let error = map.multiplier_error(orbit).ok().filter(|error| *error <= LARGEST_ERROR * radius.max(1.0))?;
    let stability = if radius + error < 1.0 {
        Stability::Attracts
    } else if radius - error <= 1.0 {
        Stability::Neutral
    } else {
        Stability::Repels
    };
    Some((stability, error))
}

impl ImpactMap {
    /// How far the multipliers of a periodic orbit may be off.
    ///
    /// Let the orbit return to within t of itself, and m be its larger multiplier, with the slope s along its
    /// own direction. The true orbit is then x away with |1 - m| x - (s/2) x^2 = t, at a fold sqrt(2 t/s), and
    /// m is off by s x; to this comes the rounding of the derivative. Where no x solves this the orbit may not
    /// exist, and the error is above |1 - m|.
    ///
    /// # Errors
    /// Those of [`Self::step`].
    pub fn multiplier_error(&self, orbit: &PeriodicOrbit) -> Result<f64, Error> {
        let Some(&state) = orbit.states.first() else { return Ok(0.0) };
        let period = orbit.period();
        let matrix = orbit.monodromy;
        let size = matrix.x_axis.length_squared() + matrix.y_axis.length_squared();
        let rounding = 8.0 * f64::EPSILON * period as f64 * (1.0 + size);
        // The modulus of a pair is known without the orbit: their product is that of the restitutions.
        let Multipliers::Real(large, _) = orbit.multipliers() else { return Ok(rounding) };
        let speed = 1.0 + state.velocity().abs();
        let (returned, _) = self.around(state, period)?;
        // Twice what was seen and the rounding of it.
        let miss = 2.0 * distance(returned, state, 1.0) + 4.0 * f64::EPSILON * speed;
        let [one, other] = [
            DVec2::new(matrix.y_axis.x, large - matrix.x_axis.x),
            DVec2::new(large - matrix.y_axis.y, matrix.x_axis.y),
        ];
        let along = if one.length_squared() >= other.length_squared() { one } else { other };
        let along = along.try_normalize().unwrap_or(DVec2::X) * DISPLACEMENT;
        let displaced = |sign: f64| {
            let phase = Phase::new(state.phase().angle() + sign * along.x)?;
            let velocity = (state.velocity() + sign * along.y).min(0.0);
            let (_, matrix) = self.around(ImpactState::new(phase, velocity)?, period)?;
            Ok::<_, Error>(match Multipliers::of(matrix) {
                Multipliers::Real(large, _) => large,
                Multipliers::Complex { real, .. } => real,
            })
        };
        let slope = (displaced(1.0)? - displaced(-1.0)?).abs() / (2.0 * DISPLACEMENT);
        let gap = (1.0 - large).abs();
        let radicand = gap * gap - 2.0 * slope * miss;
        let off = if radicand > 0.0 {
            2.0 * slope * miss / (gap + radicand.sqrt())
        } else {
            gap + (2.0 * slope * miss).sqrt()
        };
        Ok(off + rounding)
    }

    /// The impact after so many, and the derivative of the map over them.
    fn around(&self, state: ImpactState, impacts: usize) -> Result<(ImpactState, DMat2), Error> {
        let (mut state, mut matrix) = (state, DMat2::IDENTITY);
        for _ in 0..impacts {
            let (impact, derivative) = self.step_with_derivative(state)?;
            (state, matrix) = (impact.into(), derivative * matrix);
        }
        Ok((state, matrix))
    }
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

/// The orbit with its smallest period: a shorter one that it nearly repeats, unless that repels and this one
/// does not.
fn prime(map: &ImpactMap, orbit: PeriodicOrbit) -> PeriodicOrbit {
    let states = &orbit.states;
    let n = states.len();
    let fastest = states.iter().fold(1.0_f64, |most, state| most.max(state.velocity().abs()));
    let repeats = |part: &usize| {
        n.is_multiple_of(*part)
            && (0..n - part).all(|i| distance(states[i], states[i + part], fastest) <= NEARLY_SAME)
    };
    let is = |orbit: &PeriodicOrbit, least| stability(map, orbit).is_some_and(|(own, _)| own <= least);
    let least = if is(&orbit, Stability::Neutral) { Stability::Neutral } else { Stability::Repels };
    let mut shorter = (1..n).filter(repeats).filter_map(|part| map.refine(&states[..part]).ok());
    shorter.find(|orbit| is(orbit, least)).unwrap_or(orbit)
}

/// Whether the orbit from `state` comes nearer to the periodic one, after whole periods of it: by half of
/// what its multipliers promise within twice the time that they take to shrink a distance to a third, or
/// within the impacts that there are for it.
fn comes_nearer(map: &ImpactMap, orbit: &PeriodicOrbit, state: ImpactState, from: f64) -> bool {
    if from <= ROUNDING_DISTANCE {
        return true;
    }
    let period = orbit.period() as u64;
    let radius = orbit.multipliers().spectral_radius();
    let periods = 2.0 / (1.0 - radius) + 2.0;
    let rounds = (MOST_CONFIRMING / period).max(1).min(periods as u64);
    let promised = if radius > 0.0 { exp(rounds as f64 * ln(radius)) } else { 0.0 };
    let near = 0.5 * (1.0 + promised) * from;
    let mut distances = distances(map, orbit, state).take(rounds as usize);
    distances.any(|distance| distance.is_some_and(|distance| distance <= near))
}

/// Whether the orbit from `state` stays so near to the periodic one over the most impacts of a proof.
fn stays_within(map: &ImpactMap, orbit: &PeriodicOrbit, state: ImpactState, most: f64) -> bool {
    let rounds = (MOST_CONFIRMING as usize / orbit.period()).max(1);
    let mut distances = distances(map, orbit, state).take(rounds);
    distances.all(|distance| distance.is_some_and(|distance| distance <= most))
}

/// The distances of the orbit from `state` from the periodic one after each of its periods; `None` from where
/// it has no next impact.
fn distances(
    map: &ImpactMap,
    orbit: &PeriodicOrbit,
    state: ImpactState,
) -> impl Iterator<Item = Option<f64>> {
    let scale = map.vibration().peak_acceleration();
    let mut state = Some(state);
    core::iter::repeat_with(move || {
        state = state.and_then(|state| map.iterate(state, orbit.period() as u64).ok());
        state.map(|state| orbit.distance(state, scale))
    })
}
