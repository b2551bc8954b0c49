//! The parameters of the vertical motion, which has no units: axial forcing and restitution.

use super::prelude::*;
use bouncing_disk::System;
use bouncing_disk::core::{Error, ImpactMap, Vibration};

/// The heading of forcing and restitution in the help.
pub(super) const VERTICAL: &str = "Vertical motion (no units)";

/// The restitution, and the system that both it and the forcing are taken from unless they are given. The
/// forcing is an option of each command, whose help says what it takes without any system.
#[derive(Debug, Clone, Args)]
#[command(next_help_heading = VERTICAL)]
pub(super) struct MapArgs {
    /// Coefficient of restitution, in [0, 1); with `verdicts` a range, too. That of FILE, --preset or --set
    /// unless given, else 0.5
    #[arg(long, short, value_name = "EPSILON", allow_hyphen_values = true)]
    restitution: Option<Range>,
    #[command(flatten)]
    pub(super) system: SystemArgs,
}

impl MapArgs {
    /// Forcings and restitutions: those that are given, else those of the system if any was given, else
    /// `otherwise` and the restitution of the toss.
    pub(super) fn values(&self, system: &System, given: Option<Range>, otherwise: Range) -> (Range, Range) {
        let own = if self.system.is_given() { Range::single(system.axial_forcing()) } else { otherwise };
        let restitution = Range::single(system.disk().restitution());
        (given.unwrap_or(own), self.restitution.unwrap_or(restitution))
    }

    /// The same where each is a single number.
    pub(super) fn single_values(
        &self,
        system: &System,
        given: Option<Range>,
        otherwise: f64,
    ) -> Result<(f64, f64), Failure> {
        let (forcings, restitutions) = self.values(system, given, Range::single(otherwise));
        Ok((single(forcings, "--axial-forcing")?, single(restitutions, "--restitution")?))
    }
}

/// The only value of a range.
///
/// # Errors
/// [`Failure::Usage`] if there are several.
pub(super) fn single(range: Range, option: &str) -> Result<f64, Failure> {
    range
        .only()
        .ok_or_else(|| Failure::usage(format!("{option} {range}: this command takes a single number")))
}

/// The impact map of a disk.
pub(super) fn map(axial_forcing: f64, restitution: f64) -> Result<ImpactMap, Error> {
    ImpactMap::new(Vibration::from_axial_forcing(axial_forcing)?, restitution)
}
