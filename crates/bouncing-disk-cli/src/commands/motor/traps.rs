//! `bouncing-disk motor traps`: the preloads at which the motor is locked on a short cycle, and its speed
//! there.

use bouncing_disk::motor::{Estimate, LEAST_TRAP_WIDTH, TrapRange};

use super::settings::{OperationArgs, OperationJob, state};
use crate::commands::prelude::*;

/// Ranges of the preload that trap the motor, with the speed inside
#[derive(Debug, Args)]
#[command(after_help = "\
A motor in a trap repeats a short cycle of flights and rest, whose speed may be far from that beside the trap, or near it. A \
motor whose preload is known to 1 % meets a trap of relative width w with a chance of up to w/2 %. Speeds are \
those near both edges and in the middle of the range, under the load of the data sheet. See docs/designing-a-motor.md.

Example:
  bouncing-disk motor traps motor.toml --from 4 --to 6")]
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

/// Runs the command.
pub(super) fn run(args: &TrapsArgs, context: Context) -> Result<(), Failure> {
    let Some(operation) = args.operation.job(context)? else { return Ok(()) };
    let OperationJob { motor, settings } = operation;
    let (own, mass) = (motor.preload_force(), motor.mass());
    let preload_from_to = [args.from.unwrap_or(0.9 * own), args.to.unwrap_or(1.1 * own)];
    let [from, to] = preload_from_to.map(|force| force / mass);
    let watch = context.watch("motor traps");
    let traps = motor.trap_ranges([from, to], args.least_width, &settings, &watch)?;
    let speed = |trap: &TrapRange, at: usize| trap.operations[at].point().map(|point| point.speed);
    let value = |estimate: Estimate| estimate.value;
    let columns = Columns::<TrapRange>::new()
        .column("preload_from", "N", move |trap| mass * trap.preload_from_to[0])
        .column("preload_to", "N", move |trap| mass * trap.preload_from_to[1])
        .column("relative_width", "%", |trap| 100.0 * trap.relative_width)
        .column("long_flights", "1", |trap| trap.verdict.cycle.map(|cycle| cycle.long_flights as f64))
        .column("platform_periods", "1", |trap| trap.verdict.cycle.map(|cycle| cycle.platform_periods as f64))
        .column("state", "1", |trap| state(&trap.operations[1]))
        .column("lower_speed", "rad/s", move |trap| speed(trap, 0).map(value))
        .column("middle_speed", "rad/s", move |trap| speed(trap, 1).map(value))
        .column("upper_speed", "rad/s", move |trap| speed(trap, 2).map(value))
        .column("speed_error", "rad/s", move |trap| speed(trap, 1).map(|speed| speed.standard_error));
    let job = json!({
        "motor": motor,
        "settings": settings,
        "preload_from_to": preload_from_to,
        "least_width": args.least_width,
    });
    let report = Report {
        provenance: provenance("bouncing-disk motor traps", &job)?,
        text: columns.to_text(&traps),
        data: vec![("traps", stored(&traps)?)],
        table: columns.csv_of(traps),
        figure: None,
    };
    report.deliver(&args.operation.output, context.quiet)
}
