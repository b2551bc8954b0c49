//! The stored properties of the attractors at one Γ, and results from several of them: where branches of the
//! speed cross, and the effect of Γ_T on the rotation.

use std::f64::consts::PI;

use bouncing_disk::InitialCondition;
use bouncing_disk::core::Unobserved;
use bouncing_disk::core::orbits::Followed;
use bouncing_disk::estimate::Spread;
use bouncing_disk::parameters::DimensionlessSystem;
use bouncing_disk::toss::{ChatteringCycle, MultiTossSettings, OrbitClass, TossOrbit, multi_toss};

use super::data::{ForcingEffect, Slice, Twist};
use super::inputs::{Inputs, Systems};
use crate::experiment::ExperimentError;
use crate::figures::numbers::{self, six_decimals};

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

/// The Γ at which two branches of the period-4 orbit have the same speed in (d), between two slices each.
pub(super) fn branch_crossings(followed: &[Slice], doublings: &[f64]) -> Vec<f64> {
    let [_, low, high, ..] = doublings else { return Vec::new() };
    let mut crossings = Vec::new();
    let mut before: Option<(f64, Vec<[f64; 3]>)> = None;
    let inside = followed.iter().filter(|slice| slice.axial_forcing > *low && slice.axial_forcing < *high);
    for slice in inside.filter(|slice| slice.period == Some(4)) {
        let mut impacts: Vec<[f64; 3]> = (0..slice.semielliptical.len())
            .map(|i| {
                [slice.impact_phase_cycles[i], slice.normalised_impact_speed[i], slice.semielliptical[i]]
            })
            .collect();
        if let Some((forcing, last)) = &before {
            // A round may begin with any of its impacts: the one that continues the branches.
            let apart = |shift: usize| -> f64 {
                let pairs = last.iter().zip(impacts.iter().cycle().skip(shift));
                pairs.map(|(a, b)| numbers::distance(a[0], b[0]) + (a[1] - b[1]).abs()).sum()
            };
            let shift = (0..impacts.len()).min_by(|a, b| apart(*a).total_cmp(&apart(*b))).unwrap_or_default();
            impacts.rotate_left(shift);
            for one in 0..impacts.len() {
                for other in 0..one {
                    let was = last[one][2] - last[other][2];
                    let is = impacts[one][2] - impacts[other][2];
                    if (was < 0.0) != (is < 0.0) {
                        crossings.push(forcing + (slice.axial_forcing - forcing) * was / (was - is));
                    }
                }
            }
        }
        before = Some((slice.axial_forcing, impacts));
    }
    crossings
}

/// How far the angular speeds of the impacts vary, as shares of ωΦ: their standard deviation.
fn variation(speeds: &[f64]) -> Option<f64> {
    Spread::of(speeds).ok().map(|spread| spread.deviation)
}

/// The effect of Γ_T on the rotation at one Γ: the slice drawn, and that of the same vertical motion with the
/// angular forcings of (c) and (d) exchanged.
pub(super) fn forcing_effect(drawn: &Slice, exchanged: &Slice) -> Option<ForcingEffect> {
    Some(ForcingEffect {
        axial_forcing: drawn.axial_forcing,
        added_variation: [
            variation(&exchanged.linear)? - variation(&drawn.linear)?,
            variation(&drawn.semielliptical)? - variation(&exchanged.semielliptical)?,
        ],
    })
}
