//! How the period-1 orbit turns: Eq. (16), and the best motion of the platform.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use bouncing_disk::core::numerics::elementary::cos;
use bouncing_disk::core::{ChatterPolicy, ImpactMap, ImpactState};
use bouncing_disk::parameters::DimensionlessSystem;
use bouncing_disk::toss::{CollisionEvent, CollisionState, Collisions};
use serde::Serialize;

use super::diagram::{Diagram, Inputs, Slice, Twist};
use super::doublings::in_closed_form;
use super::no_orbit;
use crate::claims::judging::trend;
use crate::claims::{Claim, all, catalogue};
use crate::experiment::{ExperimentError, Paper};
use crate::figures::shared::map;
use crate::figures::shared::numbers::{distance, extent};

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
/// A speed, as a share of ωΦ, that differs from another one by the rounding of some hundred impacts only.
const SETTLED: f64 = 1.0e-9;
/// Rounding of stored phases and speeds (1e-6) seen through the slopes of Eq. (16), and the slow convergence
/// to the orbit next to a doubling.
pub(super) const STORED: f64 = 1.0e-5;

/// The rotation of period-1 orbits, from many starts and for many motions of the platform.
#[derive(Serialize)]
struct PeriodOne {
    /// Orbits: of one impact every one, two or three periods of the platform, by Γ, θ, Γ_T and the speed of
    /// the disk at first.
    orbits: usize,
    impacts_each: usize,
    /// The largest |w_T|/(ωΦ) in the last impact of an orbit.
    largest_tangential_speed: f64,
    lags: Vec<LagScan>,
}

/// The steady speeds of one period-1 orbit against the phase lag.
#[derive(Serialize)]
struct LagScan {
    axial_forcing: f64,
    impact_phase_rad: f64,
    /// Distance between the lags tried (rad), and the one with the highest speed.
    lag_step_rad: f64,
    best_lag_rad: f64,
    /// Speed/(ωΦ) at θ = −τ_imp, and at θ = −π/2.
    speed_at_impact_phase: f64,
    speed_of_elliptical: f64,
}

/// |w_T|/(ωΦ) and the disk's speed/(ωΦ) just before the last impact on the orbit.
fn turn(
    system: &DimensionlessSystem,
    orbit: ImpactState,
    first_speed: f64,
) -> Result<(f64, f64), ExperimentError> {
    let scale = system.twist_speed();
    let mut state = CollisionState {
        phase: orbit.phase(),
        axial_impact_velocity: orbit.velocity(),
        tangential_impact_velocity: first_speed * scale - system.platform_angular_speed(orbit.phase()),
    };
    let mut collisions = Collisions::after(*system, state, ChatterPolicy::Complete)?;
    for _ in 0..IMPACTS {
        let Some(CollisionEvent::Collision(next)) = collisions.advance()? else {
            return Err(no_orbit(system.axial_forcing()));
        };
        state = next.state;
    }
    Ok((state.tangential_impact_velocity.abs() / scale, state.angular_speed(system) / scale))
}

fn period_one(inputs: Inputs) -> Result<PeriodOne, ExperimentError> {
    let threshold = in_closed_form(inputs.restitution);
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
            let Some(orbit) = map(forcing, inputs.restitution)?.period_one(flight) else { continue };
            for lag in LAGS {
                for angular_forcing in ANGULAR_FORCINGS {
                    let system =
                        inputs.system(forcing, Twist { phase_lag_rad: PI * lag, angular_forcing })?;
                    for speed in FIRST_SPEEDS {
                        let (slip, _) = turn(&system, orbit, speed)?;
                        result.orbits += 1;
                        result.largest_tangential_speed = result.largest_tangential_speed.max(slip);
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
    let speed = |phase_lag_rad: f64| -> Result<f64, ExperimentError> {
        let system = inputs.system(axial_forcing, Twist { phase_lag_rad, angular_forcing: 1.0 })?;
        Ok(turn(&system, orbit, 0.0)?.1)
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

/// Eq. (16) and what follows from it.
pub(super) fn equation_16(fig: &mut Paper<'_>, diagram: &Diagram) -> Result<(), ExperimentError> {
    let inputs = diagram.inputs;
    let of = period_one(inputs)?;
    fig.claim(Claim::printed_statement(
        "section4.slip_vanishes",
        all(Some(of.largest_tangential_speed).filter(|_| of.orbits > 0), |slip| slip < SETTLED),
        format!("|w_T| in the last of {IMPACTS} impacts is at most {:.0e} ωΦ", of.largest_tangential_speed),
    ));
    fig.claim(Claim::printed_statement(
        "section4.maximum_speed",
        all(&of.lags, |scan| {
            (scan.best_lag_rad + scan.impact_phase_rad).abs() <= 0.5 * scan.lag_step_rad
                && (scan.speed_at_impact_phase - 1.0).abs() < SETTLED
        }),
        "the fastest of all lags tried is next to it",
    ));
    let (least, most) = extent(of.lags.iter().map(|scan| scan.speed_of_elliptical));
    fig.claim(Claim::printed_statement(
        "section4.elliptical_not_optimal",
        all(&of.lags, |scan| scan.speed_of_elliptical < scan.speed_at_impact_phase - SETTLED),
        format!("the disk turns at {least:.3} to {most:.3} ωΦ with θ = −π/2, and at ωΦ with θ = −τ_imp"),
    ));
    fig.record("period_one", &of)?;

    let ones = diagram.period_ones();
    let phase = |one: &Slice| TAU * one.impact_phase_cycles[0];
    let miss = |one: &Slice| {
        let linear = one.linear_mean - cos(phase(one) + inputs.linear.phase_lag_rad);
        let semielliptical = one.semielliptical_mean - cos(phase(one) + inputs.semielliptical.phase_lag_rad);
        linear.abs().max(semielliptical.abs())
    };
    fig.claim(Claim::printed_statement(
        "section4.period_one_speed",
        all(&ones, |one| miss(one) < STORED),
        format!(
            "largest deviation {:.1e} ωΦ at {} values of Γ in (c) and (d), whose phases are rounded to 1e-6 of a period",
            extent(ones.iter().map(|one| miss(one))).1,
            ones.len()
        ),
    ));
    let (low, high) = extent(ones.iter().map(|one| phase(one)));
    fig.claim(Claim::printed_statement(
        "section4.impact_phase_not_quarter",
        all(&ones, |one| distance(phase(one) / TAU, 0.25) > STORED),
        format!("in period 1 τ_imp/2π runs from {:.4} to {:.4}", low / TAU, high / TAU),
    ));
    for (key, of, sign) in [
        ("section4.linear_falls", (|one| one.linear_mean) as fn(&Slice) -> f64, -1.0),
        ("section4.semielliptical_rises", |one| one.semielliptical_mean, 1.0),
    ] {
        let pairs = trend(ones.iter().map(|one| (one.axial_forcing, of(one))), sign);
        fig.claim(Claim::printed_statement(key, pairs, format!("in {} of all pairs of Γ", pairs.words())));
    }
    // The first and the last of the orbits: which of the two motions is the faster.
    let ends = ones.first().zip(ones.last());
    let lag = catalogue::number("section4.semielliptical_phase_lag", 0)?;
    let [least, most] = [1.0, -1.0].map(|sign| cos(lag.value.abs() + sign * lag.half_unit));
    fig.claim(Claim::printed_statement(
        "section4.speed_at_doubling",
        ends.map(|(_, last)| (least..=most).contains(&last.linear_mean)),
        ends.map_or_else(String::new, |(_, last)| {
            format!(
                "{:.4} ωΦ; the cosine is {least:.4} to {most:.4} for values that round to 0.26π",
                last.linear_mean
            )
        }),
    ));
    fig.claim(Claim::printed_statement(
        "section4.best_motion_varies",
        ends.map(|(first, last)| {
            first.linear_mean > first.semielliptical_mean && last.semielliptical_mean > last.linear_mean
        }),
        ends.map_or_else(String::new, |(first, last)| {
            format!(
                "θ of (c) gives {:.3} ωΦ and θ of (d) {:.3} ωΦ at Γ = {:.4}, {:.3} and {:.3} ωΦ at Γ = {:.4}",
                first.linear_mean,
                first.semielliptical_mean,
                first.axial_forcing,
                last.linear_mean,
                last.semielliptical_mean,
                last.axial_forcing,
            )
        }),
    ));
    // The birth of the orbit, where τ_imp = 0 and Eq. (16) gives ωΦ cos θ.
    let at_birth = cos(inputs.semielliptical.phase_lag_rad);
    let fastest = extent(ones.iter().map(|one| one.semielliptical_mean)).1;
    fig.claim(Claim::printed_statement(
        "section4.semielliptical_slow_at_birth",
        all(ones.first(), |first| {
            at_birth < cos(inputs.linear.phase_lag_rad)
                && first.semielliptical_mean < fastest.min(first.linear_mean)
        }),
        format!("{at_birth:.3} ωΦ at Γ = 1/3 by Eq. (16), against ωΦ with θ = 0"),
    ));
    // The effect of half a unit of the last digit of the printed lag on the speed.
    let least = cos(lag.half_unit);
    let last = ones.last();
    let reached = last.map(|one| one.semielliptical_mean);
    fig.claim(Claim::printed_statement(
        "section4.semielliptical_reaches_maximum",
        all(reached, |speed| speed >= least),
        format!(
            "{:.7} ωΦ at the last period-1 orbit of (d), Γ = {:.4}; half a unit of the last digit of 0.26π reduces it to {least:.7}",
            reached.unwrap_or(f64::NAN),
            last.map_or(f64::NAN, |one| one.axial_forcing),
        ),
    ));
    Ok(())
}
