//! `bouncing-disk motor phase-lag`: the phase lag at which the motor turns fastest.

use super::settings::OperationArgs;
use crate::commands::prelude::*;

/// The phase lag at which the motor turns fastest
#[derive(Debug, Args)]
#[command(after_help = "\
Under the load of the data sheet; the other direction is best half a circle away. Errors are standard errors. See \
docs/designing-a-motor.md.

Example:
  bouncing-disk motor phase-lag motor.toml --set load_torque=1e-5")]
pub(crate) struct LagArgs {
    #[command(flatten)]
    operation: OperationArgs,
}

/// Runs the command.
pub(super) fn run(args: &LagArgs, context: Context) -> Result<(), Failure> {
    let Some(job) = args.operation.job(context)? else { return Ok(()) };
    let best = job.motor.best_phase_lag(&job.settings, &context.watch("motor phase-lag"))?;
    let mut list = Quantities::default();
    list.push("best_phase_lag", best.phase_lag.value, "rad");
    list.push("best_phase_lag_error", best.phase_lag.standard_error, "rad");
    list.push("speed", best.speed.value, "rad/s");
    list.push("speed_error", best.speed.standard_error, "rad/s");
    list.push("within_1_percent_from", best.good_from_to[0], "rad");
    list.push("within_1_percent_to", best.good_from_to[1], "rad");
    let report = Report {
        provenance: provenance("bouncing-disk motor phase-lag", &job)?,
        text: list.to_text(),
        table: list.into_csv(),
        data: vec![("best_phase_lag", stored(&best)?)],
        figure: None,
    };
    report.deliver(&args.operation.output, context.quiet)
}
