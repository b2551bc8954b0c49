//! `bouncing-disk motor`: a motor from its data sheet.

mod curve;
mod fmu;
mod operations;
mod settings;
pub(super) mod sweep;
pub(super) mod transient;

use bouncing_disk::Motor;
use bouncing_disk::motor::StatorReport;
use bouncing_disk::parameters::ContactStatement;
use clap::Subcommand;

use super::prelude::*;

#[derive(Debug, Subcommand)]
pub(crate) enum MotorCommand {
    Report(ReportArgs),
    Transient(transient::TransientArgs),
    Curve(curve::CurveArgs),
    Stall(operations::StallArgs),
    Best(operations::BestArgs),
    Traps(operations::TrapsArgs),
    Sweep(sweep::SweepArgs),
    Fmu(fmu::FmuArgs),
}

pub(super) fn run(command: MotorCommand, context: Context) -> Result<()> {
    match command {
        MotorCommand::Report(args) => report(&args, context),
        MotorCommand::Transient(args) => transient::run(&args, context),
        MotorCommand::Curve(args) => curve::run(&args, context),
        MotorCommand::Stall(args) => operations::stall(&args, context),
        MotorCommand::Best(args) => operations::best(&args, context),
        MotorCommand::Traps(args) => operations::traps(&args, context),
        MotorCommand::Sweep(args) => sweep::run(&args, context),
        MotorCommand::Fmu(args) => fmu::run(&args, context),
    }
}

/// Forcing, regime, largest torque and warnings that follow from the data sheet
#[derive(Debug, Args)]
#[command(after_help = "\
Prints the forcing parameters, the regime of the vertical motion, the largest torque, and warnings of unlikely \
values; for a compliant [stator] also its circuit and the preload above which it does not lift a rotor at rest. The \
load affects only the warning of an overload. See docs/designing-a-motor.md.

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

fn report(args: &ReportArgs, context: Context) -> Result<()> {
    let Some(motor) = args.motor.begin(&args.output, false, None, context)? else { return Ok(()) };
    if let Some(report) = motor.stator_report() {
        return of_stator(&motor, &report)?.deliver(&args.output, context);
    }
    let report = motor.report(&context.watch("motor report"))?;
    let mut list = Quantities::default();
    list.push("axial_forcing", report.axial_forcing, "1");
    list.push("angular_forcing", report.angular_forcing, "1");
    // In units of the preload acceleration, which the paper calls g, so P has no unit.
    list.push("peak_acceleration_over_preload", report.peak_acceleration, "1");
    list.push("regime", report.regime.to_string(), "1");
    list.push("periods_per_flight", report.periods_per_flight, "periods");
    list.push("impact_speed", report.impact_speed, "m/s");
    for (name, value) in ContactStatement::rows(report.contact.as_ref()) {
        list.push(name, value, "1");
    }
    list.push("largest_torque", report.largest_torque, "N m");
    list.push("static_deflection", report.static_deflection, "m");
    list.push("preload_change_bound", report.preload_change_bound, "1");
    for warning in &report.warnings {
        list.push("warning", warning.to_string(), "1");
    }
    written(&motor, report.to_string(), list)?.deliver(&args.output, context)
}

/// The report of a motor with a compliant stator.
fn of_stator<'a>(motor: &Motor, report: &StatorReport) -> Result<Report<'a>> {
    let mut list = Quantities::default();
    report.rows().for_each(|(name, value, unit)| list.push(name, value, unit));
    list.push("largest_torque", motor.largest_torque(), "N m");
    for warning in motor.warnings() {
        list.push("warning", warning.to_string(), "1");
    }
    written(motor, report.to_string(), list)
}

fn written<'a>(motor: &Motor, mut text: String, list: Quantities) -> Result<Report<'a>> {
    if motor.load().is_some() {
        text += "\nthe table [load] affects only the warning of an overload";
    }
    Ok(Report {
        provenance: provenance("bouncing-disk motor report", &json!({ "motor": motor }))?,
        text,
        data: vec![("quantities", json::whole(list.to_json()))],
        table: list.into_csv(),
        figure: None,
    })
}
