//! The diagrams: following the period-1 attractor, and the chattering orbit from rest.

use std::f64::consts::PI;

use bouncing_disk::core::{ChatterPolicy, Followed, ImpactMap, Vibration, follow, period_doublings};
use bouncing_disk::{
    Dimensionless, ForcingParameters, MultiTossSettings, OrbitClass, Start, TossOrbit, multi_toss,
};
use rayon::prelude::*;

use super::data::{Fig06Data, Slice, Twist};
use super::{chattering, merging};
use crate::experiment::{ExperimentError, Quality};
use crate::paper::{self, SectionFour};
use crate::progress::Progress;

/// The range of Γ of the diagram.
const FORCING_RANGE: (f64, f64) = (0.30, 0.62);
/// The printed inputs of the diagrams.
#[derive(Clone, Copy, Debug)]
pub(super) struct Inputs {
    pub(super) restitution: f64,
    pub(super) followed_from: f64,
    /// (c).
    linear: Twist,
    /// (d).
    semielliptical: Twist,
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
    pub(super) linear: Dimensionless,
    pub(super) semielliptical: Dimensionless,
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

fn map(axial_forcing: f64, restitution: f64) -> Result<ImpactMap, ExperimentError> {
    let vibration = Vibration::from_axial_forcing(axial_forcing).map_err(ExperimentError::model)?;
    ImpactMap::new(vibration, restitution).map_err(ExperimentError::model)
}

fn no_orbit(axial_forcing: f64) -> ExperimentError {
    ExperimentError::model(bouncing_disk::core::Error::NotSettled {
        what: "period-1 orbit",
        iterations: 0,
        residual: axial_forcing,
    })
}

pub(super) fn run(quality: Quality, progress: &dyn Progress) -> Result<Fig06Data, ExperimentError> {
    let section = paper::section_four()?;
    let inputs = Inputs::from(&section);
    let Inputs { restitution, followed_from, linear, semielliptical } = inputs;
    let values = quality.choose(200, 2_000);
    let settings = MultiTossSettings {
        policy: ChatterPolicy::Paper,
        transient_impacts: quality.choose(1_000, 3_000),
        examined_impacts: quality.choose(100, 300),
        longest_period: quality.choose(50, 128),
        tolerance: 1.0e-7,
    };
    let forcings: Vec<f64> = (0..values)
        .map(|i| {
            let (low, high) = FORCING_RANGE;
            low + (high - low) * i as f64 / (values - 1) as f64
        })
        .collect();
    progress.start(2 * values as u64, "orbits");
    let first_map = map(followed_from, restitution)?;
    let first = first_map.period_one(1).ok_or_else(|| no_orbit(followed_from))?;
    let first_orbit = first_map.refine(&[first]).map_err(ExperimentError::model)?;
    let above = forcings.iter().copied().filter(|forcing| *forcing >= followed_from);
    let walk: Vec<Followed> =
        follow(restitution, above, first, settings.transient_impacts, ChatterPolicy::Paper)
            .collect::<Result<_, _>>()
            .map_err(ExperimentError::model)?;
    progress.advance((values - walk.len()) as u64);
    let followed: Vec<Option<Slice>> = walk
        .par_iter()
        .map(|followed| {
            let slice = followed_slice(followed, inputs, settings);
            progress.advance(1);
            slice
        })
        .collect::<Result<_, _>>()?;
    // The attractor is lost where its orbit comes to rest in the longer run, too.
    let followed: Vec<Slice> = followed.into_iter().map_while(|slice| slice).collect();
    let cycles =
        chattering::cycles(&forcings, restitution, settings.policy).map_err(ExperimentError::model)?;
    let cycles: Vec<_> = forcings.iter().copied().zip(cycles).collect();
    let chattering: Vec<Option<Slice>> = cycles
        .par_iter()
        .map(|&(forcing, cycle)| {
            let slice = chattering::chattering_slice(forcing, cycle, inputs, settings);
            progress.advance(1);
            slice
        })
        .collect::<Result<_, _>>()?;
    progress.start(4, "searches");
    let not_chattering = forcings
        .iter()
        .zip(&chattering)
        .filter(|(forcing, slice)| **forcing * PI > 1.0 && slice.is_none())
        .map(|(forcing, _)| *forcing)
        .collect();
    // Side by side, for in most of them one step follows from another.
    let some: Vec<f64> = forcings.iter().copied().step_by(10).collect();
    let crisis = || merging::merging(first, inputs, quality.choose(40_000, 400_000));
    let others = || -> Result<_, ExperimentError> {
        let single_tosses = chattering::single_tosses(&cycles, &section, settings.policy)?;
        progress.advance(1);
        let policies = chattering::policies(&some, inputs, settings)?;
        progress.advance(1);
        let doublings = period_doublings(restitution, 7).map_err(ExperimentError::model)?;
        progress.advance(1);
        Ok((single_tosses, policies, doublings))
    };
    let (merging, others) = rayon::join(crisis, others);
    let (merging, (single_tosses, policies, doublings)) = (merging?, others?);
    progress.advance(1);
    let doublings: Vec<f64> = doublings.into_iter().map(|doubling| doubling.axial_forcing).collect();
    let at_doubling = doublings.first().copied().unwrap_or(f64::NAN);
    let phase = map(at_doubling, restitution)?.period_one(1).ok_or_else(|| no_orbit(at_doubling))?.phase();
    Ok(Fig06Data {
        restitution,
        axial_forcing_range: FORCING_RANGE,
        basin_axial_forcings: section.axial_forcings_of_fig7,
        axial_forcing_values: values,
        transient_impacts: settings.transient_impacts,
        examined_impacts: settings.examined_impacts,
        linear,
        semielliptical,
        followed_from,
        followed,
        chattering: chattering.into_iter().flatten().collect(),
        not_chattering,
        doublings,
        period_one_threshold: (1.0 - restitution) / (1.0 + restitution),
        phase_at_first_doubling_rad: phase.angle(),
        multiplier_where_followed_from: bouncing_disk::core::Multipliers::of(first_orbit.monodromy)
            .spectral_radius(),
        merging,
        single_tosses,
        policies,
    })
}

/// The impacts of the followed attractor, or `None` if the disk comes to rest.
fn followed_slice(
    followed: &Followed,
    inputs: Inputs,
    settings: MultiTossSettings,
) -> Result<Option<Slice>, ExperimentError> {
    let systems = Systems::at(followed.axial_forcing, inputs)?;
    let phase = followed.state.phase();
    let tosses = |system: &Dimensionless| {
        let start = Start::Launch {
            phase,
            relative_speed: -system.restitution() * followed.state.velocity(),
            angular_speed: system.platform_angular_speed(phase),
        };
        multi_toss(*system, start, settings).map_err(ExperimentError::model)
    };
    let linear = tosses(&systems.linear)?;
    if matches!(linear.class, OrbitClass::Chattering { .. } | OrbitClass::AtRest) {
        return Ok(None);
    }
    let semielliptical = tosses(&systems.semielliptical)?;
    Ok(Some(slice(followed.axial_forcing, inputs, &linear, &semielliptical)))
}

/// Six decimals.
fn rounded(value: f64) -> f64 {
    (value * 1.0e6).round() / 1.0e6
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
        orbit.collisions.iter().map(|collision| rounded(collision.angular_speed / scale)).collect()
    };
    let mean = |orbit: &TossOrbit, twist: Twist| {
        orbit.mean_angular_speed.unwrap_or_default() / (PI * twist.angular_forcing)
    };
    let period = match linear.class {
        OrbitClass::Periodic { period, .. } => Some(period),
        OrbitClass::Chattering { impacts_per_cycle, .. } => Some(impacts_per_cycle),
        _ => None,
    };
    let impacts = &linear.collisions;
    let vertical = |orbit: &TossOrbit| {
        let states = orbit.collisions.iter().map(|collision| collision.state);
        states.map(|state| (state.phase, state.axial_impact_velocity)).collect::<Vec<_>>()
    };
    let shared = linear.collisions.len().min(semielliptical.collisions.len());
    Slice {
        axial_forcing,
        period,
        vertical_motions_agree: vertical(linear)[..shared] == vertical(semielliptical)[..shared],
        impact_phase_cycles: impacts
            .iter()
            .map(|collision| rounded(collision.state.phase.cycles()))
            .collect(),
        normalised_impact_speed: impacts
            .iter()
            .map(|collision| rounded(-collision.state.axial_impact_velocity / PI))
            .collect(),
        linear: speeds(linear, inputs.linear),
        linear_mean: mean(linear, inputs.linear),
        semielliptical: speeds(semielliptical, inputs.semielliptical),
        semielliptical_mean: mean(semielliptical, inputs.semielliptical),
    }
}
