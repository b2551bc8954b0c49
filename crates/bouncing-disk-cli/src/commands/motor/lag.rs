//! `bouncing-disk motor phase-lag`: the phase lag at which the motor turns fastest.

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
Under the load of the data sheet; the other direction is best half a circle away. Errors are standard errors. See \
docs/designing-a-motor.md.

Example:
  bouncing-disk motor phase-lag motor.toml --set load_torque=1e-5";

/// The phase lag at which the motor turns fastest
#[derive(Debug, Args)]
#[command(after_help = AFTER)]
pub(crate) struct LagArgs {
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
pub(super) fn run(args: &LagArgs, context: Context) -> Result<(), Failure> {
    if wrote_template(&args.motor)? {
        return Ok(());
    }
    args.output.check(false)?;
    let motor = args.motor.motor(context.quiet)?;
    let settings = args.settings.settings();
    let best = motor.best_phase_lag_observed(&settings, &context.watch("motor phase-lag"))?;
    let mut list = Quantities::default();
    list.push("best_phase_lag", best.phase_lag.value, "rad");
    list.push("best_phase_lag_error", best.phase_lag.standard_error, "rad");
    list.push("speed", best.speed.value, "rad/s");
    list.push("speed_error", best.speed.standard_error, "rad/s");
    list.push("within_1_percent_from", best.good_from_to[0], "rad");
    list.push("within_1_percent_to", best.good_from_to[1], "rad");
    let report = Report {
        provenance: provenance("bouncing-disk motor phase-lag", &Job { motor: &motor, settings })?,
        text: list.to_text(),
        table: ready(list.to_table()),
        data: vec![("best_phase_lag", value(&best)?)],
        figure: None,
    };
    report.deliver(&args.output, context.quiet)
}
