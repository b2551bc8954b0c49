//! Chores that need the figures, run by this program with them: it is compiled only where such a chore is asked
//! for.

use std::ffi::OsString;
use std::process::{Command, ExitCode};

use anyhow::{Context as _, Result};
use clap::Args;

use crate::output::complain;
use crate::workspace::in_workspace;

/// Whatever follows the name of the chore, for the program that knows what it means.
#[derive(Args)]
#[command(disable_help_flag = true)]
pub(crate) struct Options {
    #[arg(trailing_var_arg = true, allow_hyphen_values = true, hide = true)]
    all: Vec<OsString>,
}

/// Optimised, since figures compute; in another folder than this program, which Windows cannot replace while
/// it runs.
pub(crate) fn run(_: &Options) -> Result<ExitCode> {
    complain!("The chore needs the figures; compiling them takes a few minutes the first time.");
    let mut cargo = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| OsString::from("cargo")));
    cargo.args(["run", "--release", "--package", "xtask", "--manifest-path"]).arg(in_workspace("Cargo.toml"));
    let status = cargo.arg("--").args(std::env::args_os().skip(1)).status();
    let code = status.context("cargo cannot be run")?.code();
    Ok(code.and_then(|code| u8::try_from(code).ok()).map_or(ExitCode::FAILURE, ExitCode::from))
}
