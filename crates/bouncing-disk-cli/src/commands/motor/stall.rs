//! `bouncing-disk motor stall`: the load that stops the motor.

use super::settings::{OperationArgs, OperationJob, SpreadArgs, lock_note};
use crate::commands::prelude::*;

/// The load torque that stops the motor
#[derive(Debug, Args)]
#[command(after_help = "\
The true stall: the load torque at which the mean speed vanishes, not the paper's estimate from the run-up without load \
(`bouncing-disk fit` has that one). Errors are standard errors at exactly these inputs; the spread is over motors whose \
preload and amplitude lie within the tolerance, and the relaunch perturbation within a decade. See \
docs/designing-a-motor.md.

Example:
  bouncing-disk motor stall motor.toml")]
pub(crate) struct StallArgs {
    #[command(flatten)]
    operation: OperationArgs,
    #[command(flatten)]
    spread: SpreadArgs,
}

/// Runs the command.
pub(super) fn run(args: &StallArgs, context: Context) -> Result<(), Failure> {
    let Some(OperationJob { motor, settings }) = args.operation.job(context)? else { return Ok(()) };
    let stall = motor.stall_load(&settings, &context.watch("motor stall"))?;
    let tolerance = args.spread.tolerance();
    let watch = context.watch("motor stall: spread");
    let spread = tolerance.map(|tolerance| motor.stall_spread(&settings, &tolerance, &watch));
    let spread = spread.transpose()?.flatten();
    let mut list = Quantities::default();
    list.push("stall_torque", stall.torque.value, "N m");
    list.push("stall_torque_error", stall.torque.standard_error, "N m");
    if let Some(spread) = spread {
        list.push("spread", spread.standard_deviation.value, "N m");
        list.push("spread_error", spread.standard_deviation.standard_error, "N m");
        list.push("draws_from", spread.from_to[0], "N m");
        list.push("draws_to", spread.from_to[1], "N m");
        list.push("draws_in_a_trap", format!("{} of {}", spread.trapped, spread.draws + spread.without), "1");
    }
    list.push("share_of_largest_torque", stall.share, "1");
    list.push("surely_turns_at", stall.bracket[0], "N m");
    list.push("surely_driven_back_at", stall.bracket[1], "N m");
    list.push("no_load_speed", stall.no_load_speed.value, "rad/s");
    list.push("no_load_speed_error", stall.no_load_speed.standard_error, "rad/s");
    let job = json!({ "motor": motor, "settings": settings, "tolerance": tolerance });
    let report = Report {
        provenance: provenance("bouncing-disk motor stall", &job)?,
        text: list.to_text() + &lock_note(&motor)?,
        table: list.into_csv(),
        data: vec![("stall_load", stored(&stall)?), ("spread", stored(&spread)?)],
        figure: None,
    };
    report.deliver(&args.operation.output, context.quiet)
}
