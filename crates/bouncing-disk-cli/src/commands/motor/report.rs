//! `bouncing-disk motor report`: the derived quantities of a data sheet, and the behaviour of the motor.

use crate::commands::prelude::*;

/// Forcing, regime, largest torque and warnings that follow from the data sheet
#[derive(Debug, Args)]
#[command(after_help = "\
Forcing parameters, the regime of the vertical motion, the largest torque, and what in the data sheet is unlikely to be \
meant. See docs/designing-a-motor.md.

Examples:
  bouncing-disk motor report --template > motor.toml
  bouncing-disk motor report motor.toml
  bouncing-disk motor report motor.toml --set preload_force=5 --out report.json")]
pub(crate) struct ReportArgs {
    #[command(flatten)]
    motor: MotorArgs,
    #[command(flatten)]
    output: OutputArgs,
}

/// Runs the command.
pub(super) fn run(args: &ReportArgs, context: Context) -> Result<(), Failure> {
    let Some(motor) = args.motor.begin(&args.output, false, context)? else { return Ok(()) };
    let report = motor.report(&context.watch("motor report"))?;
    let mut list = Quantities::default();
    list.push("axial_forcing", report.axial_forcing, "1");
    list.push("angular_forcing", report.angular_forcing, "1");
    // In units of the preload acceleration, which the paper calls g: P has no unit.
    list.push("peak_acceleration_over_preload", report.peak_acceleration, "1");
    list.push("regime", report.regime.to_string(), "1");
    list.push("periods_per_flight", report.periods_per_flight, "periods");
    list.push("largest_torque", report.largest_torque, "N m");
    list.push("static_deflection", report.static_deflection, "m");
    list.push("preload_change_bound", report.preload_change_bound, "1");
    for warning in &report.warnings {
        list.push("warning", warning.to_string(), "1");
    }
    let report = Report {
        provenance: provenance("bouncing-disk motor report", &json!({ "motor": motor }))?,
        text: report.to_string(),
        data: vec![("quantities", list.to_json().into())],
        table: list.into_csv(),
        figure: None,
    };
    report.deliver(&args.output, context.quiet)
}
