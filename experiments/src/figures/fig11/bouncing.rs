//! The fate of a bouncing rotor whose stator vibrates too little to throw it (Γ < 1/π).
//!
//! A rotor at rest is not thrown then, by Eq. (3). One that bounces already need not come to rest: the
//! period-1 orbit needs Γ > (1 − ε)/(1 + ε) only, which is less than 1/π for ε > (π − 1)/(π + 1).

use std::f64::consts::{FRAC_1_PI, PI, TAU};

use bouncing_disk::core::numerics::elementary::acos;
use bouncing_disk::core::{ChatterPolicy, ImpactMap, Launch, OrbitEvent, Phase, Vibration};

use super::data::{Coexisting, EndOfBouncing};
use crate::claims::Cases;
use crate::claims::catalogue;
use crate::experiment::ExperimentError;
use crate::figures::motor_case::{MotorCase, core_error};
use crate::figures::numbers::Noise;
use crate::figures::printed_inputs::DRAWN;

/// Seed of the rotors.
pub(super) const SEED: u64 = 318;

/// A rotor that has not come to rest after so many impacts goes on bouncing: those that come to rest need
/// some tens.
const MOST_IMPACTS: usize = 10_000;

impl EndOfBouncing {
    pub(super) fn of(motor: &MotorCase) -> Result<Self, ExperimentError> {
        let largest_launch_speed = motor.system()?.peak_acceleration();
        let printed = catalogue::number("table3.restitution", 0)?;
        let restitutions = [printed.value - printed.half_unit, printed.value + printed.half_unit];
        let mut noise = Noise::new(SEED);
        let mut most_impacts = 0;
        let mut rested = Vec::with_capacity(DRAWN);
        for _ in 0..DRAWN {
            let restitution = restitutions[0] + (restitutions[1] - restitutions[0]) * noise.even();
            let map = map(FRAC_1_PI * noise.even(), restitution)?;
            let (phase, speed) = (TAU * noise.even(), largest_launch_speed * noise.even());
            let impacts = impacts_to_rest(&map, phase, speed)?;
            most_impacts = most_impacts.max(impacts.unwrap_or(0));
            rested.push(impacts.is_some());
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
            bounces &= impacts_to_rest(&map, phase, share * speed)?.is_none();
        }
        Ok(Self {
            seed: SEED,
            restitutions,
            largest_launch_speed,
            at_rest: Cases::of(rested),
            most_impacts,
            threshold_restitution: (PI - 1.0) / (PI + 1.0),
            coexisting: Coexisting { restitution, axial_forcing, impacts: MOST_IMPACTS, bounces },
        })
    }
}

fn map(axial_forcing: f64, restitution: f64) -> Result<ImpactMap, ExperimentError> {
    let vibration = Vibration::from_axial_forcing(axial_forcing).map_err(core_error)?;
    ImpactMap::new(vibration, restitution).map_err(core_error)
}

/// The impacts until the rotor is at rest for good; `None` if it is not after [`MOST_IMPACTS`].
fn impacts_to_rest(map: &ImpactMap, phase: f64, speed: f64) -> Result<Option<usize>, ExperimentError> {
    let phase = Phase::new(phase).map_err(core_error)?;
    let mut orbit =
        map.orbit_from_launch(Launch::new(phase, speed).map_err(core_error)?, ChatterPolicy::Complete);
    let mut impacts = 0;
    while impacts < MOST_IMPACTS {
        match orbit.advance().map_err(core_error)? {
            Some(OrbitEvent::Impact(_)) => impacts += 1,
            Some(OrbitEvent::Attachment(rest)) if rest.separation.is_none() => return Ok(Some(impacts)),
            Some(_) => {}
            None => return Ok(Some(impacts)),
        }
    }
    Ok(None)
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
            impacts_to_rest(&map, phase, speed).expect("no failure").is_none()
        };
        assert!(!bouncing(0.28, 0.55) && bouncing(0.30, 0.55));
        assert!(!bouncing(0.31, 0.5), "the orbit of ε = 0.5 begins at Γ = 1/3");
    }
}
