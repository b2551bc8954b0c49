//! `bouncing-disk motor traps`: the preloads at which the motor is locked on a short cycle, and its speed there.

use bouncing_disk::LEAST_TRAP_WIDTH;
use clap::Args;
use serde::Serialize;

use super::curve::state;
use super::settings::{OperationArgs, OperationJob};
use crate::arguments::OWN;
use crate::context::Context;
use crate::failure::Failure;
use crate::output::report::{Report, provenance, ready, stored};
use crate::output::table::Table;

/// What stands at the end of the help.
const AFTER: &str = "\
A motor in a trap repeats a short cycle of flights and rest, whose speed may be far from that beside the trap, or near it. A \
motor whose preload is known to 1 % meets a trap of relative width w with a chance of up to w/2 %. Speeds are \
those near both edges and in the middle of the range, under the load of the data sheet. See docs/designing-a-motor.md.

Example:
  bouncing-disk motor traps motor.toml --from 4 --to 6";

/// Ranges of the preload that trap the motor, with the speed inside
#[derive(Debug, Args)]
#[command(after_help = AFTER)]
pub(crate) struct TrapsArgs {
    #[command(flatten)]
    operation: OperationArgs,
    /// Least preload (N); 0.9 times that of the motor unless given
    #[arg(help_heading = OWN, long, allow_hyphen_values = true, value_name = "FORCE")]
    from: Option<f64>,
    /// Largest preload (N); 1.1 times that of the motor unless given
    #[arg(help_heading = OWN, long, allow_hyphen_values = true, value_name = "FORCE")]
    to: Option<f64>,
    /// Least width of a range, relative to the preload
    #[arg(help_heading = OWN, long, allow_hyphen_values = true, value_name = "SHARE", default_value_t = LEAST_TRAP_WIDTH)]
    least_width: f64,
}

#[derive(Serialize)]
struct Job {
    #[serde(flatten)]
    operation: OperationJob,
    preload_from_to: [f64; 2],
    least_width: f64,
}

/// Runs the command.
pub(super) fn run(args: &TrapsArgs, context: Context) -> Result<(), Failure> {
    let Some(operation) = args.operation.job(context)? else { return Ok(()) };
    let OperationJob { motor, settings } = operation;
    let (own, mass) = (motor.preload_force(), motor.mass());
    let preload_from_to = [args.from.unwrap_or(0.9 * own), args.to.unwrap_or(1.1 * own)];
    let [from, to] = preload_from_to.map(|force| force / mass);
    let watch = context.watch("motor traps");
    let traps = motor.trap_ranges([from, to], args.least_width, &settings, &watch)?;
    let mut table = Table::new(&[
        ("preload_from", "N"),
        ("preload_to", "N"),
        ("relative_width", "%"),
        ("long_flights", "1"),
        ("platform_periods", "1"),
        ("state", "1"),
        ("lower_speed", "rad/s"),
        ("middle_speed", "rad/s"),
        ("upper_speed", "rad/s"),
        ("speed_error", "rad/s"),
    ]);
    for trap in &traps {
        let [lower, middle, upper] = trap.operations.map(|own| own.point().map(|point| point.speed));
        table.push([
            (mass * trap.preload_from_to[0]).into(),
            (mass * trap.preload_from_to[1]).into(),
            (100.0 * trap.relative_width).into(),
            trap.verdict.cycle.map(|cycle| cycle.long_flights as f64).into(),
            trap.verdict.cycle.map(|cycle| cycle.platform_periods as f64).into(),
            state(&trap.operations[1]).into(),
            lower.map(|speed| speed.value).into(),
            middle.map(|speed| speed.value).into(),
            upper.map(|speed| speed.value).into(),
            middle.map(|speed| speed.standard_error).into(),
        ]);
    }
    let job = Job { operation, preload_from_to, least_width: args.least_width };
    let report = Report {
        provenance: provenance("bouncing-disk motor traps", &job)?,
        text: table.to_text(),
        table: ready(table),
        data: vec![("traps", stored(&traps)?)],
        figure: None,
    };
    report.deliver(&args.operation.output, context.quiet)
}
