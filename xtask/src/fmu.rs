//! `cargo xtask fmu`: a motor as a functional mock-up unit.

use std::path::PathBuf;
use std::process::{Command, ExitCode};

use anyhow::Result;
use clap::Args;

use crate::explorer::succeed;
use crate::workspace::{cargo, target_folder};

/// The packages of the program that packs a unit, and of the library that the unit holds.
const PACKAGES: [&str; 2] = ["bouncing-disk-cli", "bouncing-disk-fmu"];

#[derive(Args)]
pub(crate) struct Options {
    /// The data sheet of the motor, as for `bouncing-disk motor` (.toml or .json)
    #[arg(long, value_name = "FILE")]
    motor: PathBuf,
    /// The unit to write (.fmu)
    #[arg(long, value_name = "FILE")]
    out: PathBuf,
    /// Replace a file that exists
    #[arg(long)]
    force: bool,
}

/// Builds both in one run of cargo, which finds the library for the program.
pub(crate) fn run(options: &Options) -> Result<ExitCode> {
    let mut build = cargo();
    // Another target would put them into a folder of its own.
    build.args(["build", "--release", "--locked"]).env_remove("CARGO_BUILD_TARGET");
    succeed(build.args(PACKAGES.map(|package| ["--package", package]).as_flattened()))?;
    let program = format!("release/bouncing-disk{}", std::env::consts::EXE_SUFFIX);
    let mut pack = Command::new(target_folder()?.join(program));
    pack.args(["motor", "fmu"]).arg(&options.motor).arg("--out").arg(&options.out);
    succeed(pack.args(options.force.then_some("--force")))?;
    Ok(ExitCode::SUCCESS)
}
