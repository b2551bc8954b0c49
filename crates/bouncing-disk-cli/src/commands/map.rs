//! The parameters of the vertical motion, which has no units: axial forcing and restitution.

use std::path::Path;

use bouncing_disk::System;
use bouncing_disk::core::{Error, ImpactMap, Vibration};
use clap::Args;

use crate::arguments::OutputArgs;
use crate::context::Context;
use crate::failure::Failure;
use crate::parameters::system::{SystemArgs, template};
use crate::range::Range;

/// The heading of forcing and restitution in the help.
pub(crate) const VERTICAL: &str = "Vertical motion (no units)";

/// The restitution, and the system that both it and the forcing are taken from unless they are given. The
/// forcing is an option of each command, whose help says what it takes without any system.
#[derive(Debug, Clone, Args)]
#[command(next_help_heading = VERTICAL)]
pub(crate) struct MapArgs {
    /// Coefficient of restitution, in [0, 1); with `verdicts` a range, too. That of FILE, --preset or --set
    /// unless given, else 0.5
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
    pub(crate) fn wrote_template(&self, output: &OutputArgs, context: Context) -> Result<bool, Failure> {
        wrote_template(&self.system, output, context)
    }

    /// The file that the system is read from, if any.
    pub(crate) fn inputs(&self) -> Vec<&Path> {
        self.system.inputs()
    }

    /// The values: the forcing that is given, else that of the system that is given, else `otherwise`.
    pub(crate) fn values(&self, given: Option<Range>, otherwise: Range) -> Result<MapValues, Failure> {
        let system: System = self.system.system()?;
        let own = if self.system.is_given() { Range::single(system.axial_forcing()) } else { otherwise };
        Ok(MapValues {
            axial_forcings: given.unwrap_or(own),
            restitutions: self.restitution.unwrap_or(Range::single(system.disk().restitution())),
        })
    }

    /// The restitution, which is a single number.
    pub(crate) fn single_restitution(&self) -> Result<f64, Failure> {
        single(self.values(None, Range::single(0.0))?.restitutions, "--restitution")
    }
}

/// Writes the template of a system if that is asked for, and says whether it was.
pub(crate) fn wrote_template(
    args: &SystemArgs,
    output: &OutputArgs,
    context: Context,
) -> Result<bool, Failure> {
    if args.template {
        output.write_template(&template(&args.system()?), context)?;
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
