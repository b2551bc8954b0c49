//! The printed inputs of the diagrams, and the systems and maps made from them.

use bouncing_disk::core::{ImpactMap, Vibration};
use bouncing_disk::parameters::{DimensionlessSystem, ForcingParameters};

use super::data::Twist;
use crate::claims::paper::SectionFour;
use crate::experiment::ExperimentError;

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

pub(super) fn map(axial_forcing: f64, restitution: f64) -> Result<ImpactMap, ExperimentError> {
    let vibration = Vibration::from_axial_forcing(axial_forcing)?;
    ImpactMap::new(vibration, restitution).map_err(ExperimentError::model)
}

pub(super) fn no_orbit(axial_forcing: f64) -> ExperimentError {
    ExperimentError::model(bouncing_disk::core::Error::NotSettled {
        what: "period-1 orbit",
        iterations: 0,
        residual: axial_forcing,
    })
}
