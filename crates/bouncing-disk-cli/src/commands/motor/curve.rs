//! `bouncing-disk motor curve`: speed, power and efficiency over the load.

use bouncing_disk::{Motor, MotorField, OperatingSettings, Operation, SweepQuantity};
use clap::Args;
use serde::Serialize;

use super::settings::SettingsArgs;
use super::wrote_template;
use crate::arguments::{OWN, OutputArgs};
use crate::context::Context;
use crate::failure::Failure;
use crate::output::report::{Report, provenance, ready, stored};
use crate::output::table::{Cell, Table};
use crate::parameters::motor::MotorArgs;
use crate::pictures;
use crate::range::Range;

/// What stands at the end of the help.
const AFTER: &str = "\
All loads ride on one vertical motion: a curve costs little more than a point. Errors are standard errors. A load beyond \
the largest torque mu m g a_e overpowers the motor, which then has no mean speed. A picture marks the stall where the \
speed changes its sign, on a straight line between two loads; `motor stall` computes it. See docs/designing-a-motor.md.

Examples:
  bouncing-disk motor curve
  bouncing-disk motor curve motor.toml --loads 0:40e-6:21 --out curve.png --out curve.csv";

/// Loads unless given: points from none to the largest torque.
const POINTS: usize = 11;

/// The torque-speed curve, with power and efficiency
#[derive(Debug, Args)]
#[command(after_help = AFTER)]
pub(crate) struct CurveArgs {
    #[command(flatten)]
    motor: MotorArgs,
    /// Load torques (N m), FIRST:LAST:POINTS; eleven from none to the largest torque unless given
    #[arg(help_heading = OWN, long, value_name = "LOADS", allow_hyphen_values = true)]
    loads: Option<Range>,
    #[command(flatten)]
    settings: SettingsArgs,
    #[command(flatten)]
    output: OutputArgs,
}

#[derive(Serialize)]
struct Job<'a> {
    motor: &'a Motor,
    load_torques: Range,
    settings: OperatingSettings,
}

/// Runs the command.
pub(super) fn run(args: &CurveArgs, context: Context) -> Result<(), Failure> {
    if wrote_template(&args.motor, &args.output, context)? {
        return Ok(());
    }
    args.output.check(true, &args.motor.inputs(), None)?;
    let motor = args.motor.motor(context.quiet)?;
    let load_torques = match args.loads {
        Some(loads) => loads,
        None => Range::new(0.0, motor.largest_torque(), POINTS).map_err(Failure::usage)?,
    };
    let loads: Vec<f64> = load_torques.values().collect();
    let settings = args.settings.settings();
    let found = motor.torque_speed_curve_observed(&loads, &settings, &context.watch("motor curve"))?;
    let table = table(&found);
    let report = Report {
        provenance: provenance("bouncing-disk motor curve", &Job { motor: &motor, load_torques, settings })?,
        text: shown(&found).to_text(),
        table: ready(table),
        data: vec![("operations", stored(&found)?)],
        figure: Some(Box::new(move || pictures::motor_curve::draw(motor.largest_torque(), &found))),
    };
    report.deliver(&args.output, context.quiet)
}

/// What became of a motor.
pub(super) const fn state(operation: &Operation) -> &'static str {
    match operation {
        Operation::Steady(_) => "steady",
        Operation::Unsettled(..) => "unsettled",
        Operation::Runaway { .. } => "runaway",
        _ => "unknown",
    }
}

fn shown(found: &[Operation]) -> Table {
    let mut table = Table::new(&[
        ("load_torque", "N m"),
        ("state", "1"),
        ("speed", "rad/s"),
        ("error", "rad/s"),
        ("power", "W"),
        ("input_power", "W"),
        ("efficiency", "%"),
    ]);
    for operation in found {
        let value = |quantity: SweepQuantity| quantity.of(operation).map(|estimate| estimate.value);
        table.push([
            operation.load_torque().into(),
            state(operation).into(),
            value(SweepQuantity::Speed).into(),
            SweepQuantity::Speed.of(operation).map(|estimate| estimate.standard_error).into(),
            value(SweepQuantity::MechanicalPower).into(),
            value(SweepQuantity::InputPower).into(),
            value(SweepQuantity::Efficiency).map(|share| 100.0 * share).into(),
        ]);
    }
    table
}

/// All quantities with their standard errors.
fn table(found: &[Operation]) -> Table {
    let load = MotorField::LoadTorque;
    let mut columns = vec![(load.name(), load.unit()), ("state", "1")];
    for (quantity, error) in SweepQuantity::ALL.into_iter().zip(ERRORS) {
        columns.push((quantity.name(), quantity.unit()));
        columns.push((error, quantity.unit()));
    }
    let mut table = Table::new(&columns);
    for operation in found {
        let mut row: Vec<Cell> = vec![operation.load_torque().into(), state(operation).into()];
        for quantity in SweepQuantity::ALL {
            let estimate = quantity.of(operation);
            row.push(estimate.map(|estimate| estimate.value).into());
            row.push(estimate.map(|estimate| estimate.standard_error).into());
        }
        table.push(row);
    }
    table
}

/// The names of the errors of the quantities.
const ERRORS: [&str; 6] = [
    "speed_error",
    "mechanical_power_error",
    "input_power_error",
    "restitution_loss_error",
    "friction_loss_error",
    "efficiency_error",
];
