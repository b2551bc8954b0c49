//! What the paper offers for what its simulations do not show: a stator that twists less, and one that vibrates too little to
//! throw the rotor (Γ < 1/π).
//!
//! A rotor at rest is not thrown then, by Eq. (3). One that bounces already need not come to rest: the period-1 orbit needs Γ > (1 − ε)/(1 + ε) only,
//! which is less than 1/π for ε > (π − 1)/(π + 1).

use std::f64::consts::{FRAC_1_PI, PI, TAU};

use bouncing_disk::core::numerics::elementary::acos;
use bouncing_disk::core::{ChatterPolicy, ImpactMap, Launch, OrbitEvent, Phase};
use bouncing_disk::estimate::Spread;
use serde::Serialize;

use super::{PRELOAD_SEED, RISES};
use crate::claims::{Cases, Claim};
use crate::experiment::{ExperimentError, Quality};
use crate::figures::shared::alike::{DRAWN, PrintedInputs, Range, alike_groups};
use crate::figures::shared::inputs::motor as inputs;
use crate::figures::shared::map;
use crate::figures::shared::motor::{MotorCase, statistics};
use crate::figures::shared::numbers::Noise;

/// The share to which the stator's twist is reduced, to see the effect of a smaller one.
const REDUCED_TWIST: f64 = 0.5;

/// A difference of more than so many standard errors is one.
const STANDARD_ERRORS: f64 = 3.0;

/// A motor whose stator twists less.
#[derive(Debug, Serialize)]
pub(super) struct ReducedTwist {
    /// ωΦ (rad/s), printed and reduced.
    peak_angular_speeds_rad_per_s: [f64; 2],
    steady_speeds_rad_per_s: [Spread; 2],
    stall_accelerations_rad_per_s2: Option<[Spread; 2]>,
    /// Single orbits that are slower with the reduced one.
    slower: Cases,
}

impl ReducedTwist {
    pub(super) fn of(
        motor: &MotorCase,
        quality: Quality,
        relaunch_perturbation: f64,
    ) -> Result<Self, ExperimentError> {
        let (members, drawn) = (quality.choose(4, 16), quality.choose(DRAWN / 10, DRAWN));
        let twist = motor.peak_angular_speed_rad_per_s;
        let speeds = [twist, REDUCED_TWIST * twist];
        let ensembles = speeds
            .map(|speed| (inputs::PEAK_ANGULAR_SPEED.set(motor, speed), members, relaunch_perturbation));
        let statistics = statistics(&ensembles, RISES)?;
        let [printed, reduced] = [statistics[0], statistics[1]];
        let single = PrintedInputs::table_three()?.drawn(drawn, PRELOAD_SEED);
        let with = |speed: f64| {
            single.iter().map(move |motor| inputs::PEAK_ANGULAR_SPEED.set(motor, speed)).collect()
        };
        let orbits = alike_groups(&speeds.map(with), RISES)?;
        let pairs = orbits[0].0.iter().zip(&orbits[1].0);
        let slower =
            Cases::of(pairs.map(|(one, other)| other.steady_speed_rad_per_s < one.steady_speed_rad_per_s));
        Ok(Self {
            peak_angular_speeds_rad_per_s: speeds,
            steady_speeds_rad_per_s: [printed.steady_speed_rad_per_s, reduced.steady_speed_rad_per_s],
            stall_accelerations_rad_per_s2: printed
                .stall_acceleration_rad_per_s2
                .zip(reduced.stall_acceleration_rad_per_s2)
                .map(|(printed, reduced)| [printed, reduced]),
            slower,
        })
    }

    pub(super) fn claim(&self) -> Claim {
        let [printed, reduced] = self.steady_speeds_rad_per_s;
        let [full, part] = self.peak_angular_speeds_rad_per_s;
        let error = (printed.standard_error * printed.standard_error
            + reduced.standard_error * reduced.standard_error)
            .sqrt();
        let torques = self.stall_accelerations_rad_per_s2.map_or_else(String::new, |[one, other]| {
            format!(
                ". The stall acceleration stays, {:.2} ± {:.2} and {:.2} ± {:.2} rad/s²: no plateau",
                one.mean, one.standard_error, other.mean, other.standard_error
            )
        });
        Claim::printed_statement(
            "section5.reduced_twist_lowers_speed",
            printed.mean - reduced.mean > STANDARD_ERRORS * error,
            format!(
                "{:.2} ± {:.2} rad/s at full preload with ωΦ = {full} rad/s, {:.2} ± {:.2} with {part}{torques}",
                printed.mean, printed.standard_error, reduced.mean, reduced.standard_error,
            ),
        )
        .single_orbits(self.slower)
    }
}

/// Seed of the rotors.
pub(super) const BOUNCING_SEED: u64 = 318;

/// A rotor that has not come to rest after so many impacts goes on bouncing: those that come to rest need some tens.
const MOST_IMPACTS: usize = 10_000;

/// The fate of bouncing rotors at Γ < 1/π.
#[derive(Debug, Serialize)]
pub(super) struct EndOfBouncing {
    /// What still prints as the ε of Table III.
    restitutions: [f64; 2],
    /// How many come to rest for good.
    at_rest: Cases,
    /// The restitution above which a rotor can go on bouncing at some Γ < 1/π.
    threshold_restitution: f64,
    coexisting: Coexisting,
}

/// A rotor that is launched on the period-1 orbit below Γ = 1/π.
#[derive(Debug, Serialize)]
pub(super) struct Coexisting {
    restitution: f64,
    axial_forcing: f64,
    /// After so many impacts ...
    impacts: usize,
    /// ... it still bounces.
    bounces: bool,
}

impl EndOfBouncing {
    pub(super) fn of(motor: &MotorCase) -> Result<Self, ExperimentError> {
        let largest_launch_speed = motor.system()?.peak_acceleration();
        let restitutions = Range::printed("table3.restitution", 0)?.ends();
        let mut noise = Noise::new(BOUNCING_SEED);
        let mut rested = Vec::with_capacity(DRAWN);
        for _ in 0..DRAWN {
            let restitution = restitutions[0] + (restitutions[1] - restitutions[0]) * noise.even();
            let map = map(FRAC_1_PI * noise.even(), restitution)?;
            let (phase, speed) = (TAU * noise.even(), largest_launch_speed * noise.even());
            rested.push(comes_to_rest(&map, phase, speed)?);
        }
        let restitution = restitutions[1];
        let birth = (1.0 - restitution) / (1.0 + restitution);
        let axial_forcing = 0.5 * (birth + FRAC_1_PI);
        // Period 1: cos τ = (1 − ε)/((1 + ε) Γ), flights of one period.
        let phase = acos(birth / axial_forcing);
        let speed = TAU * restitution / (1.0 + restitution);
        let map = map(axial_forcing, restitution)?;
        let mut bounces = true;
        // A basin and no point: so do those that are launched a little differently.
        for share in [0.99, 1.0, 1.01] {
            bounces &= !comes_to_rest(&map, phase, share * speed)?;
        }
        Ok(Self {
            restitutions,
            at_rest: Cases::of(rested),
            threshold_restitution: (PI - 1.0) / (PI + 1.0),
            coexisting: Coexisting { restitution, axial_forcing, impacts: MOST_IMPACTS, bounces },
        })
    }
    /// A statement about the motor, whose restitution is an estimate.
    pub(super) fn claim(&self) -> Claim {
        let [low, high] = self.restitutions;
        let coexisting = &self.coexisting;
        Claim::printed_statement(
            "section5.bouncing_ends",
            self.at_rest,
            format!(
                "{} of {} rotors with ε = {low} to {high} and Γ < 1/π come to rest. \"Can\" is right: at ε = {} and Γ = {:.3} \
                 one in period 1 {} after {} impacts",
                self.at_rest.holding,
                self.at_rest.tried,
                coexisting.restitution,
                coexisting.axial_forcing,
                if coexisting.bounces { "bounces" } else { "rests" },
                coexisting.impacts
            ),
        )
    }
}

/// Whether the rotor is at rest for good within [`MOST_IMPACTS`].
fn comes_to_rest(map: &ImpactMap, phase: f64, speed: f64) -> Result<bool, ExperimentError> {
    let launch = Launch::new(Phase::new(phase)?, speed)?;
    let mut orbit = map.orbit_from_launch(launch, ChatterPolicy::Complete);
    let mut impacts = 0;
    while impacts < MOST_IMPACTS {
        match orbit.advance()? {
            Some(OrbitEvent::Impact(_)) => impacts += 1,
            Some(OrbitEvent::Attachment(rest)) if rest.separation.is_none() => return Ok(true),
            Some(_) => {}
            None => return Ok(true),
        }
    }
    Ok(false)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn below_the_period_one_orbit_everything_rests_and_above_it_can_bounce() {
        let bouncing = |forcing: f64, restitution: f64| {
            let birth = (1.0 - restitution) / (1.0 + restitution);
            let phase = if forcing > birth { acos(birth / forcing) } else { 0.0 };
            let speed = TAU * restitution / (1.0 + restitution);
            let map = map(forcing, restitution).expect("legal");
            !comes_to_rest(&map, phase, speed).expect("no failure")
        };
        assert!(!bouncing(0.28, 0.55) && bouncing(0.30, 0.55));
        assert!(!bouncing(0.31, 0.5), "the orbit of ε = 0.5 begins at Γ = 1/3");
    }
}
