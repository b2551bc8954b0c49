//! The printed inputs of the diagrams and the systems made from them, what is stored of the attractors at one Γ, and what
//! follows from several of them: where branches of the speed cross, and what Γ_T does to the rotation.

use std::f64::consts::PI;

use bouncing_disk::InitialCondition;
use bouncing_disk::core::orbits::Followed;
use bouncing_disk::core::{ImpactState, Phase, Unobserved};
use bouncing_disk::estimate::Spread;
use bouncing_disk::parameters::{DimensionlessSystem, ForcingParameters};
use bouncing_disk::toss::{
    ChatteringCycle, MultiTossSettings, OrbitClass, TOSS_START, TossOrbit, multi_toss,
};

use super::data::{ForcingEffect, Slice, Twist};
use crate::claims::paper::SectionFour;
use crate::experiment::ExperimentError;
use crate::figures::shared::numbers::{self, six_decimals};

/// The printed inputs of the diagrams.
#[derive(Clone, Copy, Debug)]
pub(super) struct Inputs {
    pub(super) restitution: f64,
    pub(super) followed_from: f64,
    /// (c).
    pub(super) linear: Twist,
    /// (d).
    pub(super) semielliptical: Twist,
}

impl Inputs {
    /// With the angular forcings of (c) and (d) exchanged.
    pub(super) fn exchanged(self) -> Self {
        let Self { linear, semielliptical, .. } = self;
        Self {
            linear: Twist { angular_forcing: semielliptical.angular_forcing, ..linear },
            semielliptical: Twist { angular_forcing: linear.angular_forcing, ..semielliptical },
            ..self
        }
    }
}

impl From<&SectionFour> for Inputs {
    fn from(section: &SectionFour) -> Self {
        Self {
            restitution: section.restitution,
            followed_from: section.followed_from,
            linear: Twist {
                phase_lag_rad: section.linear_phase_lag_rad,
                angular_forcing: section.linear_angular_forcing,
            },
            semielliptical: Twist {
                phase_lag_rad: section.semielliptical_phase_lag_rad,
                angular_forcing: section.semielliptical_angular_forcing,
            },
        }
    }
}

/// The two rotary motions over one vertical one.
pub(super) struct Systems {
    pub(super) linear: DimensionlessSystem,
    pub(super) semielliptical: DimensionlessSystem,
}

impl Systems {
    pub(super) fn at(axial_forcing: f64, inputs: Inputs) -> Result<Self, ExperimentError> {
        let build = |twist: Twist| {
            ForcingParameters {
                axial_forcing,
                angular_forcing: twist.angular_forcing,
                phase_lag: twist.phase_lag_rad,
                restitution: inputs.restitution,
            }
            .build()
            .map_err(ExperimentError::model)
        };
        Ok(Self { linear: build(inputs.linear)?, semielliptical: build(inputs.semielliptical)? })
    }
}

/// A disk after this impact, or without one at rest on the platform at its lowest point; it turns with the platform, or not at all.
pub(super) fn start(
    system: &DimensionlessSystem,
    state: Option<ImpactState>,
    turns: bool,
) -> Result<InitialCondition, ExperimentError> {
    let phase = state.map_or_else(|| Phase::new(TOSS_START), |state| Ok(state.phase()))?;
    let angular_speed = if turns { system.platform_angular_speed(phase) } else { 0.0 };
    Ok(match state {
        Some(state) => InitialCondition::Launch {
            phase,
            relative_speed: -system.restitution() * state.velocity(),
            angular_speed,
        },
        None => InitialCondition::Contact { phase, angular_speed },
    })
}

pub(super) fn no_orbit(axial_forcing: f64) -> ExperimentError {
    ExperimentError::model(bouncing_disk::core::Error::NotSettled {
        what: "period-1 orbit",
        iterations: 0,
        residual: axial_forcing,
    })
}

/// The impacts of the followed attractor, or `None` if the disk comes to rest.
pub(super) fn followed_slice(
    followed: &Followed,
    inputs: Inputs,
    settings: MultiTossSettings,
) -> Result<Option<Slice>, ExperimentError> {
    let systems = Systems::at(followed.axial_forcing, inputs)?;
    let tosses = |system: &DimensionlessSystem| {
        let start = start(system, Some(followed.state), true)?;
        multi_toss(*system, start, settings, &Unobserved).map_err(ExperimentError::model)
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
