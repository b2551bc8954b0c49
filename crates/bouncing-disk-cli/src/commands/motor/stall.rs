//! `bouncing-disk motor stall`: the load that stops the motor.

use clap::Args;

use super::settings::OperationArgs;
use crate::context::Context;
use crate::failure::Failure;
use crate::output::report::{Report, provenance, ready, stored};
use crate::output::table::Quantities;

/// What stands at the end of the help.
const AFTER: &str = "\
The true stall: the load torque at which the mean speed vanishes, not the paper's estimate from the run-up without load \
(`bouncing-disk fit` has that one). Errors are standard errors. See docs/designing-a-motor.md.

Example:
  bouncing-disk motor stall motor.toml";

/// The load torque that stops the motor
#[derive(Debug, Args)]
#[command(after_help = AFTER)]
pub(crate) struct StallArgs {
    #[command(flatten)]
    operation: OperationArgs,
}

/// Runs the command.
pub(super) fn run(args: &StallArgs, context: Context) -> Result<(), Failure> {
    let Some(job) = args.operation.job(context)? else { return Ok(()) };
    let stall = job.motor.stall_load_observed(&job.settings, &context.watch("motor stall"))?;
    let mut list = Quantities::default();
    list.push("stall_torque", stall.torque.value, "N m");
    list.push("stall_torque_error", stall.torque.standard_error, "N m");
    list.push("share_of_largest_torque", stall.share, "1");
    list.push("surely_turns_at", stall.bracket[0], "N m");
    list.push("surely_driven_back_at", stall.bracket[1], "N m");
    list.push("no_load_speed", stall.no_load_speed.value, "rad/s");
    list.push("no_load_speed_error", stall.no_load_speed.standard_error, "rad/s");
    let report = Report {
        provenance: provenance("bouncing-disk motor stall", &job)?,
        text: list.to_text(),
        table: ready(list.to_table()),
        data: vec![("stall_load", stored(&stall)?)],
        figure: None,
    };
    report.deliver(&args.operation.output, context.quiet)
}
