//! What is stored of the attractors at one Γ.

use std::f64::consts::PI;

use bouncing_disk::InitialCondition;
use bouncing_disk::core::Unobserved;
use bouncing_disk::core::orbits::Followed;
use bouncing_disk::parameters::DimensionlessSystem;
use bouncing_disk::toss::{ChatteringCycle, MultiTossSettings, OrbitClass, TossOrbit, multi_toss};

use super::data::{Slice, Twist};
use super::inputs::{Inputs, Systems};
use crate::experiment::ExperimentError;
use crate::figures::numbers::six_decimals;

/// The impacts of the followed attractor, or `None` if the disk comes to rest.
pub(super) fn followed_slice(
    followed: &Followed,
    inputs: Inputs,
    settings: MultiTossSettings,
) -> Result<Option<Slice>, ExperimentError> {
    let systems = Systems::at(followed.axial_forcing, inputs)?;
    let phase = followed.state.phase();
    let tosses = |system: &DimensionlessSystem| {
        let start = InitialCondition::Launch {
            phase,
            relative_speed: -system.restitution() * followed.state.velocity(),
            angular_speed: system.platform_angular_speed(phase),
        };
        multi_toss(*system, start, settings, &Unobserved)
    };
    let linear = tosses(&systems.linear)?;
    if matches!(linear.class, OrbitClass::Chattering { .. } | OrbitClass::AtRest) {
        return Ok(None);
    }
    let semielliptical = tosses(&systems.semielliptical)?;
    Ok(Some(slice(followed.axial_forcing, inputs, &linear, &semielliptical)))
}

/// The impacts of two rotary motions over the same vertical one.
pub(super) fn slice(
    axial_forcing: f64,
    inputs: Inputs,
    linear: &TossOrbit,
    semielliptical: &TossOrbit,
) -> Slice {
    let speeds = |orbit: &TossOrbit, twist: Twist| -> Vec<f64> {
        let scale = PI * twist.angular_forcing;
        orbit.collisions.iter().map(|collision| six_decimals(collision.angular_speed / scale)).collect()
    };
    let mean = |orbit: &TossOrbit, twist: Twist| {
        orbit.mean_angular_speed.unwrap_or_default() / (PI * twist.angular_forcing)
    };
    let period = match linear.class {
        OrbitClass::Periodic { period, .. } => Some(period),
        OrbitClass::Chattering(cycle) => Some(cycle.impacts),
        _ => None,
    };
    let impacts = &linear.collisions;
    let platform_periods = match linear.class {
        OrbitClass::Periodic { platform_periods, .. }
        | OrbitClass::Chattering(ChatteringCycle { platform_periods, .. }) => Some(platform_periods),
        _ => None,
    };
    Slice {
        axial_forcing,
        period,
        platform_periods,
        impact_phase_cycles: impacts
            .iter()
            .map(|collision| six_decimals(collision.state.phase.cycles()))
            .collect(),
        normalised_impact_speed: impacts
            .iter()
            .map(|collision| six_decimals(-collision.state.axial_impact_velocity / PI))
            .collect(),
        linear: speeds(linear, inputs.linear),
        linear_mean: mean(linear, inputs.linear),
        semielliptical: speeds(semielliptical, inputs.semielliptical),
        semielliptical_mean: mean(semielliptical, inputs.semielliptical),
    }
}
