//! Parameters: from a file, a preset of the paper, and single values on the command line, the same for a
//! system and for a motor.

pub(crate) mod motor;
pub(crate) mod system;

use std::fmt::Debug;
use std::path::{Path, PathBuf};

use bouncing_disk::parameters::DriveParameters;
use bouncing_disk::regular_file;
use clap::{Args, ValueEnum};

use crate::context::Context;
use crate::failure::{Failure, Result, unreadable};
use crate::grid::GridArgs;
use crate::output::OutputArgs;
use crate::range::{Words, assignment, one_of};

pub(crate) trait Described: Clone + Debug + Send + Sync + 'static {
    /// The presets of the paper; the first is the default.
    const PRESETS: Words<fn() -> Self>;

    /// Whether files may have a table `[load]`.
    const HAS_LOAD: bool = false;

    /// Reads a file. The settings replace its values before anything is checked, so that they can correct it.
    fn read(text: &str, format: Format, settings: &[Setting]) -> Result<Self, String>;

    /// The table `[drive]`.
    fn drive(&self) -> &DriveParameters;

    /// The tables that a template omits, except for the drive, and whether the file has them.
    fn tables(&self) -> [(&'static str, bool); 2];

    /// A commented file with the same parameters, without the tables.
    fn template(&self) -> String;
}

/// A file, a preset, and single values.
#[derive(Debug, Clone, Args)]
#[command(next_help_heading = "Parameters")]
pub(crate) struct SourceArgs<D: Described> {
    /// A file of parameters, .toml or .json, in SI units; --template writes one
    #[arg(help_heading = None)]
    pub(crate) file: Option<PathBuf>,
    /// Parameters of the paper, instead of a file
    #[arg(long, conflicts_with = "file", value_name = "NAME", value_parser = one_of(D::PRESETS))]
    pub(crate) preset: Option<fn() -> D>,
    /// Sets a parameter by its key in the file, in its unit: KEY=VALUE; may be repeated
    #[arg(long, value_name = "KEY=VALUE", value_parser = setting)]
    pub(crate) set: Vec<Setting>,
    /// Writes the parameters as a commented TOML file, to the terminal or with --out FILE.toml into a file,
    /// and computes nothing
    #[arg(long)]
    pub(crate) template: bool,
}

impl<D: Described> SourceArgs<D> {
    /// Whether parameters are given; otherwise the defaults hold.
    pub(crate) fn is_given(&self) -> bool {
        self.file.is_some() || self.preset.is_some() || !self.set.is_empty()
    }

    /// The parameters.
    pub(crate) fn get(&self) -> Result<D> {
        let (text, format) = match &self.file {
            Some(path) => read_text(path)?,
            // Reading a template gives the same parameters to the last bit.
            None => (self.preset.unwrap_or(D::PRESETS[0].2)().template(), Format::Toml),
        };
        let name = self.file.as_ref().map(|path| path.display());
        D::read(&text, format, &self.set).map_err(|why| {
            Failure::Usage(match name {
                Some(name) if self.set.is_empty() => format!("{name}: {why}"),
                Some(name) => format!("{name} with --set: {why}"),
                None => format!("--set: {why}"),
            })
        })
    }

    /// The parameters; `None` if the template was requested, and is now written.
    pub(crate) fn unless_template(&self, output: &OutputArgs, context: Context) -> Result<Option<D>> {
        let parameters = self.get()?;
        if self.template {
            let drive = [("[drive]", !parameters.drive().is_sine())];
            let mut tables = drive.into_iter().chain(parameters.tables());
            if let Some((table, _)) = tables.find(|(_, given)| *given) {
                let copy = format!("--template writes no table {table}; copy it from the file");
                return Err(Failure::Usage(copy));
            }
            let load = if D::HAS_LOAD { LOAD } else { "" };
            output.write_template(&format!("{}\n{DRIVE}{load}", parameters.template()), context.quiet)?;
            return Ok(None);
        }
        parameters.drive().warnings().for_each(|warning| context.note(&format!("warning: {warning}")));
        Ok(Some(parameters))
    }

    /// [`Self::unless_template`] after a check that the result can be written, for a command with or
    /// without pictures and parts.
    pub(crate) fn begin(
        &self,
        output: &OutputArgs,
        picture: bool,
        grid: Option<&GridArgs>,
        context: Context,
    ) -> Result<Option<D>> {
        if !self.template {
            let inputs: Vec<&Path> = self.file.as_deref().into_iter().collect();
            output.check(picture, &inputs, grid.and_then(GridArgs::journal))?;
            grid.map_or(Ok(()), |grid| grid.check(output))?;
        }
        self.unless_template(output, context)
    }
}

/// The end of a template.
const DRIVE: &str = "# Motion of the platform other than the sine, for toss, diagram, orbits, basins, verdicts, \
                     doublings, and motor transient,
# curve, stall, best and sweep.
# Shapes: sine, triangle, \
                     parabolas, cubics, { sawtooth = 0.3 }, { fourier = [[1.0, 0.0], [0.1, 1.5]] }, { sampled = \
                     [...] }
# [drive]
# height = \"triangle\"
# angle = \"sine\"

# Duration of an impact (s), \
                     for toss and motor transient, curve, stall, best and sweep; or data from which reports
# \
                     estimate it while impacts stay rigid; the geometries are plane, ring and layer.
# [contact]
# time = \
                     1e-5
# law = \"damper\" # or hysteresis
# or
# materials = [\"steel\", \"aluminium\"]
# \
                     geometry = \"ring\"
# ball_radius = 0.01
# ring_radius = 0.00125
";

/// The end of a motor's template.
const LOAD: &str = "
# A load that depends on the speed, instead of load_torque: torques (N m) at rising speeds (rad/s), interpolated
# and extrapolated by lines. The values describe a fan of 18e-6 N m at 20 rad/s, within 1 % of this torque.
# [load]
# speeds = [-20, -16, -12, -8, -4, 0, 4, 8, 12, 16, 20]
# torques = [-18e-6, -11.52e-6, -6.48e-6, -2.88e-6, -0.72e-6, 0, 0.72e-6, 2.88e-6, 6.48e-6, 11.52e-6, 18e-6]
# inertia = 1e-9 # of the parts that turn with the rotor (kg m^2)
";

/// A key and its number from the command line. Setting it checks that the key exists and that the number is
/// legal.
pub(crate) type Setting = (String, f64);

pub(crate) fn setting(text: &str) -> Result<Setting, String> {
    let (key, value) = assignment(text, "a setting is KEY=VALUE, such as disk.friction=0.2")?;
    let value = value.trim();
    Ok((key.to_owned(), value.parse().map_err(|_| format!("{value:?} is not a number"))?))
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Format {
    Json,
    Toml,
}

/// The largest file of parameters that is read (bytes): a hundred times the size of a real one.
const LARGEST: u64 = 1 << 20;

fn read_text(path: &Path) -> Result<(String, Format)> {
    let name = path.display();
    let ending = path.extension().unwrap_or_default().to_string_lossy();
    let format = Format::from_str(&ending, true)
        .map_err(|_| Failure::Usage(format!("{name}: a file of parameters must end in .json or .toml")))?;
    let bytes = regular_file::read(path, LARGEST).map_err(|error| unreadable(path, error))?;
    let text = String::from_utf8(bytes).map_err(|_| unreadable(path, "it is not UTF-8 text"))?;
    Ok((text, format))
}
