//! `bouncing-disk motor`: a motor from its data sheet.

mod curve;
mod lag;
mod report;
mod settings;
mod stall;
pub(super) mod sweep;
pub(super) mod transient;
mod traps;

use clap::{Args, Subcommand};

use crate::context::Context;
use crate::failure::Failure;

/// A motor from its data sheet: report, run-up, torque-speed curve, stall, traps, sweeps
#[derive(Debug, Args)]
#[command(subcommand_required = true, arg_required_else_help = true)]
pub(crate) struct MotorCommand {
    #[command(subcommand)]
    command: Motors,
}

#[derive(Debug, Subcommand)]
enum Motors {
    Report(report::ReportArgs),
    Transient(transient::TransientArgs),
    Curve(curve::CurveArgs),
    Stall(stall::StallArgs),
    PhaseLag(lag::LagArgs),
    Traps(traps::TrapsArgs),
    Sweep(sweep::SweepArgs),
}

/// Runs the command.
pub(super) fn run(command: MotorCommand, context: Context) -> Result<(), Failure> {
    match command.command {
        Motors::Report(args) => report::run(&args, context),
        Motors::Transient(args) => transient::run(&args, context),
        Motors::Curve(args) => curve::run(&args, context),
        Motors::Stall(args) => stall::run(&args, context),
        Motors::PhaseLag(args) => lag::run(&args, context),
        Motors::Traps(args) => traps::run(&args, context),
        Motors::Sweep(args) => sweep::run(&args, context),
    }
}
