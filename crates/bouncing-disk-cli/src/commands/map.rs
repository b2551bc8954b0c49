//! The parameters of the vertical motion, which has no units: axial forcing and restitution.

use bouncing_disk::System;
use bouncing_disk::core::{Error, ImpactMap, Vibration};
use clap::Args;

use crate::failure::Failure;
use crate::output::lines::say;
use crate::parameters::system::{SystemArgs, template};
use crate::range::Range;

/// Forcing and restitution, each from the system unless given.
#[derive(Debug, Clone, Args)]
#[command(next_help_heading = "Vertical motion (no units)")]
pub(crate) struct MapArgs {
    /// Axial forcing parameter Gamma = A omega^2/(pi g): a number, or where several are possible a range
    /// FIRST:LAST:POINTS, both ends included. That of the system unless given
    #[arg(long, short = 'G', value_name = "GAMMA", allow_hyphen_values = true)]
    pub(crate) axial_forcing: Option<Range>,
    /// Coefficient of restitution, in [0, 1). That of the system unless given, which is 0.5 by default
    #[arg(long, short, value_name = "EPSILON", allow_hyphen_values = true)]
    pub(crate) restitution: Option<Range>,
    #[command(flatten)]
    pub(crate) system: SystemArgs,
}

/// What the arguments say.
pub(crate) struct MapValues {
    pub(crate) axial_forcings: Range,
    pub(crate) restitutions: Range,
}

impl MapArgs {
    /// Writes the template if that is asked for, and says whether it was.
    pub(crate) fn wrote_template(&self) -> Result<bool, Failure> {
        wrote_template(&self.system)
    }

    /// The values; without any system `forcings` take the place of its forcing.
    pub(crate) fn values(&self, forcings: Range) -> Result<MapValues, Failure> {
        let system: System = self.system.system()?;
        let own = if self.system.is_given() { Range::single(system.axial_forcing()) } else { forcings };
        Ok(MapValues {
            axial_forcings: self.axial_forcing.unwrap_or(own),
            restitutions: self.restitution.unwrap_or(Range::single(system.disk().restitution())),
        })
    }
}

/// Writes the template of a system if that is asked for, and says whether it was.
pub(crate) fn wrote_template(args: &SystemArgs) -> Result<bool, Failure> {
    if args.template {
        say!("{}", template(&args.system()?).trim_end())?;
    }
    Ok(args.template)
}

/// The only value of a range.
///
/// # Errors
/// [`Failure::Usage`] if there are several.
pub(crate) fn single(range: Range, option: &str) -> Result<f64, Failure> {
    range
        .only()
        .ok_or_else(|| Failure::usage(format!("{option} {range}: this command takes a single number")))
}

/// The impact map of a disk.
pub(crate) fn map(axial_forcing: f64, restitution: f64) -> Result<ImpactMap, Error> {
    ImpactMap::new(Vibration::from_axial_forcing(axial_forcing)?, restitution)
}
