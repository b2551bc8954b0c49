//! The period-1 orbit: where it begins, and how it turns.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use bouncing_disk::core::numerics::roots::bracket_of_width;
use bouncing_disk::core::{ChatterPolicy, ImpactMap, ImpactState};
use bouncing_disk::parameters::{DimensionlessSystem, ForcingParameters};
use bouncing_disk::toss::{CollisionEvent, CollisionState, Collisions};

use super::data::{LagScan, PeriodOne};
use super::slices::{Inputs, no_orbit};
use crate::experiment::ExperimentError;
use crate::figures::shared::map;

/// Width at which the bisection on the threshold ends. The orbit is found next to its birth as far as
/// Newton's iteration goes there; its phase moves with the square root of the distance.
const BRACKET: f64 = 1.0e-9;
/// Γ at which there is no such orbit at restitution 0.5, and far from the printed threshold.
const BELOW_THRESHOLD: f64 = 0.30;
/// One impact every so many periods of the platform, at most.
const LONGEST_FLIGHT: u64 = 3;
/// Places in a window of Γ, as shares of it: away from its ends, where an orbit attracts slowly.
const PLACES: [f64; 4] = [0.1, 0.4, 0.7, 0.9];
/// Phase lags (as multiples of π) and angular forcings, of both motions of Fig. 6 and others.
const LAGS: [f64; 4] = [0.0, -0.26, 0.5, -0.75];
/// See [`LAGS`].
const ANGULAR_FORCINGS: [f64; 4] = [0.1, 1.0, 10.0, 100.0];
/// The disk's speed at first, in units of the platform's largest.
const FIRST_SPEEDS: [f64; 3] = [-2.0, 0.0, 2.0];
/// An impact takes at least 2π of the slip of at most 3πΓ_T: this is more than enough.
const IMPACTS: usize = 200;
/// Lags tried over a whole turn.
const LAGS_TRIED: u32 = 72;

/// The lowest Γ at which Newton's iteration finds the orbit.
pub(super) fn threshold(inputs: Inputs, first: ImpactState) -> Result<f64, ExperimentError> {
    let mut state = first;
    let (_, found) = bracket_of_width(BELOW_THRESHOLD, inputs.followed_from, BRACKET, |forcing| {
        // The same orbit, not another one: one impact in one period of the platform.
        let refined = map(forcing, inputs.restitution)?.refine(&[state]);
        let orbit = refined.ok().filter(|orbit| orbit.platform_periods == 1);
        if let Some(orbit) = &orbit {
            state = orbit.states[0];
        }
        Ok::<_, ExperimentError>(orbit.is_none())
    })?;
    Ok(found)
}

fn system(
    axial_forcing: f64,
    angular_forcing: f64,
    phase_lag: f64,
    inputs: Inputs,
) -> Result<DimensionlessSystem, ExperimentError> {
    ForcingParameters { axial_forcing, angular_forcing, phase_lag, restitution: inputs.restitution }
        .build()
        .map_err(ExperimentError::model)
}

/// A disk on the period-1 orbit, by its first impacts.
struct Turning {
    /// |w_T|/(ωΦ) just before the last impact.
    slip: f64,
    /// The disk's speed/(ωΦ) just before it.
    speed: f64,
}

fn turn(
    system: &DimensionlessSystem,
    orbit: ImpactState,
    first_speed: f64,
    impacts: usize,
) -> Result<Turning, ExperimentError> {
    let scale = system.twist_speed();
    let slip = first_speed * scale - system.platform_angular_speed(orbit.phase());
    let mut state = CollisionState {
        phase: orbit.phase(),
        axial_impact_velocity: orbit.velocity(),
        tangential_impact_velocity: slip,
    };
    let mut collisions = Collisions::after(*system, state, ChatterPolicy::Complete)?;
    for _ in 0..impacts {
        let Some(CollisionEvent::Collision(next)) = collisions.advance()? else {
            return Err(no_orbit(system.axial_forcing()));
        };
        state = next.state;
    }
    Ok(Turning {
        slip: state.tangential_impact_velocity.abs() / scale,
        speed: state.angular_speed(system) / scale,
    })
}

pub(super) fn period_one(inputs: Inputs) -> Result<PeriodOne, ExperimentError> {
    let threshold = (1.0 - inputs.restitution) / (1.0 + inputs.restitution);
    let first_doubling = ImpactMap::first_doubling_forcing(inputs.restitution);
    let mut result =
        PeriodOne { orbits: 0, impacts_each: IMPACTS, largest_tangential_speed: 0.0, lags: Vec::new() };
    // The window of one impact every k periods runs from k times the threshold to the doubling, of which the
    // height above the threshold, in squares, does not depend on k.
    let squared = |value: f64| value * value;
    let height = squared(first_doubling) - squared(threshold);
    for flight in 1..=LONGEST_FLIGHT {
        let low = flight as f64 * threshold;
        let high = (squared(low) + height).sqrt();
        for place in PLACES {
            let forcing = low + place * (high - low);
            let orbit =
                map(forcing, inputs.restitution)?.period_one(flight).ok_or_else(|| no_orbit(forcing))?;
            for lag in LAGS {
                for angular_forcing in ANGULAR_FORCINGS {
                    let system = system(forcing, angular_forcing, PI * lag, inputs)?;
                    for speed in FIRST_SPEEDS {
                        let turning = turn(&system, orbit, speed, IMPACTS)?;
                        result.orbits += 1;
                        result.largest_tangential_speed = result.largest_tangential_speed.max(turning.slip);
                    }
                }
            }
            if flight == 1 {
                result.lags.push(lag_scan(forcing, orbit, inputs)?);
            }
        }
    }
    Ok(result)
}

/// The steady speed against the phase lag, with Γ_T = 1: a few impacts end the slip.
fn lag_scan(axial_forcing: f64, orbit: ImpactState, inputs: Inputs) -> Result<LagScan, ExperimentError> {
    let speed = |lag: f64| -> Result<f64, ExperimentError> {
        Ok(turn(&system(axial_forcing, 1.0, lag, inputs)?, orbit, 0.0, IMPACTS)?.speed)
    };
    let lag_step_rad = TAU / f64::from(LAGS_TRIED);
    let mut best = (f64::NEG_INFINITY, 0.0);
    for index in 0..LAGS_TRIED {
        let lag = -PI + lag_step_rad * f64::from(index);
        let reached = speed(lag)?;
        if reached > best.0 {
            best = (reached, lag);
        }
    }
    Ok(LagScan {
        axial_forcing,
        impact_phase_rad: orbit.phase().angle(),
        lag_step_rad,
        best_lag_rad: best.1,
        speed_at_impact_phase: speed(-orbit.phase().angle())?,
        speed_of_elliptical: speed(-FRAC_PI_2)?,
    })
}
