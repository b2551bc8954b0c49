//! Impacts as two numbers.

use bouncing_disk::Error;
use bouncing_disk::core::{ImpactState, Phase};

use crate::names::{Name, name};

/// What the library calls the phase of an impact.
pub(crate) const PHASE: Name = name("phase", &["impact_phase"]);

/// And the restitution that a map has no inverse with.
pub(crate) const INVERSE: Name = name("restitution of an inverse", &["self.restitution"]);

/// An impact of these two numbers.
pub(crate) fn state(impact_phase: f64, axial_impact_velocity: f64) -> Result<ImpactState, Error> {
    Ok(ImpactState::new(Phase::new(impact_phase)?, axial_impact_velocity)?)
}

/// The two numbers of an impact.
pub(crate) fn pair(state: ImpactState) -> (f64, f64) {
    (state.phase().angle(), state.velocity())
}
