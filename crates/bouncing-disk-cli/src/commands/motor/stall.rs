//! `bouncing-disk motor stall`: the load that stops the motor.

use bouncing_disk::{Motor, OperatingSettings};
use clap::Args;
use serde::Serialize;

use super::settings::SettingsArgs;
use super::wrote_template;
use crate::arguments::OutputArgs;
use crate::context::Context;
use crate::failure::Failure;
use crate::output::report::{Report, provenance, ready, value};
use crate::output::table::Quantities;
use crate::parameters::motor::MotorArgs;

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
    motor: MotorArgs,
    #[command(flatten)]
    settings: SettingsArgs,
    #[command(flatten)]
    output: OutputArgs,
}

#[derive(Serialize)]
struct Job<'a> {
    motor: &'a Motor,
    settings: OperatingSettings,
}

/// Runs the command.
pub(super) fn run(args: &StallArgs, context: Context) -> Result<(), Failure> {
    if wrote_template(&args.motor)? {
        return Ok(());
    }
    args.output.check(false)?;
    let motor = args.motor.motor(context.quiet)?;
    let settings = args.settings.settings();
    let stall = motor.stall_load_observed(&settings, &context.watch("motor stall"))?;
    let mut list = Quantities::default();
    list.push("stall_torque", stall.torque.value, "N m");
    list.push("stall_torque_error", stall.torque.standard_error, "N m");
    list.push("share_of_largest_torque", stall.share, "1");
    list.push("surely_turns_at", stall.bracket[0], "N m");
    list.push("surely_driven_back_at", stall.bracket[1], "N m");
    list.push("no_load_speed", stall.no_load_speed.value, "rad/s");
    list.push("no_load_speed_error", stall.no_load_speed.standard_error, "rad/s");
    let report = Report {
        provenance: provenance("bouncing-disk motor stall", &Job { motor: &motor, settings })?,
        text: list.to_text(),
        table: ready(list.to_table()),
        data: vec![("stall_load", value(&stall)?)],
        figure: None,
    };
    report.deliver(&args.output, context.quiet)
}
