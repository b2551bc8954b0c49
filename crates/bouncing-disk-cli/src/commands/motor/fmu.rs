//! `bouncing-disk motor fmu`: a motor as a functional mock-up unit.

use std::path::{Path, PathBuf};

use bouncing_disk_fmu::{library_name, packed};

use crate::commands::prelude::*;
use crate::failure::unreadable;
use crate::output::files::Kind;

/// The motor as a functional mock-up unit (FMI 3.0, co-simulation) for this machine
#[derive(Debug, Args)]
#[command(after_help = "\
Inputs are the load torque, the drive (amplitude, volts or force, as in the data sheet), its frequency, and drive_on; \
outputs are angle, speed, shaft_torque, vibration_amplitude, power, impacts, and, if a capacitance is given, current. \
The data sheet's numbers are parameters. See docs/designing-a-motor.md.

Examples:
  bouncing-disk motor fmu motor.toml --out motor.fmu
  bouncing-disk motor fmu motor.toml --out motor.fmu --library target/release/libbouncing_disk_fmu.so")]
pub(crate) struct FmuArgs {
    #[command(flatten)]
    motor: MotorArgs,
    /// The shared library to include; by default it is searched for next to this program
    #[arg(help_heading = OWN, long, value_name = "FILE")]
    library: Option<PathBuf>,
    #[command(flatten)]
    output: OutputArgs,
}

pub(super) fn run(args: &FmuArgs, context: Context) -> Result<()> {
    let Some(motor) = args.motor.unless_template(&args.output, context)? else { return Ok(()) };
    let [target] = &args.output.out[..] else {
        return Err(Failure::Usage("motor fmu writes one file; give --out FILE.fmu".to_owned()));
    };
    if target.kind != Kind::Fmu {
        return Err(Failure::Usage(format!("{target}: the file of motor fmu must end in .fmu")));
    }
    target.check(args.output.force)?;
    let library = match &args.library {
        Some(given) => given.clone(),
        None => beside_this_program()?,
    };
    let bytes = std::fs::read(&library).map_err(|error| unreadable(&library, error))?;
    let unit = packed(&motor, &bytes).map_err(|error| {
        Failure::Usage(match error {
            error @ bouncing_disk_fmu::PackageError::Library => format!("{}: {error}", library.display()),
            error => error.to_string(),
        })
    })?;
    target.write(args.output.force, context.quiet, |to| to.write_all(&unit))
}

/// In the folder `deps` where cargo has just built it, next to the program, or in the folder `lib` of an
/// installation.
fn beside_this_program() -> Result<PathBuf> {
    let name = library_name();
    let program = std::env::current_exe().unwrap_or_default();
    let folder = program.parent().unwrap_or(Path::new("."));
    let places = [folder.join("deps").join(&name), folder.join(&name), folder.join("../lib").join(&name)];
    places.into_iter().find(|place| place.is_file()).ok_or_else(|| {
        Failure::Usage(format!(
            "{name} is not next to this program: copy it from the program's archive, or build \
             it by `cargo xtask fmu` in a copy of the repository"
        ))
    })
}
