//! `bouncing-disk motor curve`: speed, power and efficiency over the load.

use bouncing_disk::{
    InputSpread, InputTolerance, Motor, MotorField, OperatingSettings, Operation, SweepQuantity,
};
use clap::Args;
use serde::Serialize;

use super::settings::{SettingsArgs, SpreadArgs, lock_note};
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
All loads ride on one vertical motion: a curve costs little more than a point. Errors are standard errors at exactly these \
inputs; the spread is over motors whose preload and amplitude lie within the tolerance, and the relaunch perturbation within \
a decade: 95 of 100 further ones lie between its ends. A load beyond \
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
    spread: SpreadArgs,
    #[command(flatten)]
    output: OutputArgs,
}

#[derive(Serialize)]
struct Job<'a> {
    motor: &'a Motor,
    load_torques: Range,
    settings: OperatingSettings,
    tolerance: Option<InputTolerance>,
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
    let found = motor.torque_speed_curve(&loads, &settings, &context.watch("motor curve"))?;
    let tolerance = args.spread.tolerance();
    let spreads = match &tolerance {
        Some(tolerance) => {
            let watch = context.watch("motor curve: spread");
            motor.speed_spreads(&loads, &settings, tolerance, &watch)?
        }
        None => vec![None; loads.len()],
    };
    let table = table(&found, &spreads);
    let job = Job { motor: &motor, load_torques, settings, tolerance };
    let report = Report {
        provenance: provenance("bouncing-disk motor curve", &job)?,
        text: shown(&found, &spreads).to_text() + &lock_note(&motor)?,
        table: ready(table),
        data: vec![("operations", stored(&found)?), ("spreads", stored(&spreads)?)],
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

fn shown(found: &[Operation], spreads: &[Option<InputSpread>]) -> Table {
    let mut table = Table::new(&[
        ("load_torque", "N m"),
        ("state", "1"),
        ("speed", "rad/s"),
        ("error", "rad/s"),
        ("from", "rad/s"),
        ("to", "rad/s"),
        ("power", "W"),
        ("input_power", "W"),
        ("efficiency", "%"),
    ]);
    for (operation, spread) in found.iter().zip(spreads) {
        let value = |quantity: SweepQuantity| quantity.of(operation).map(|estimate| estimate.value);
        table.push([
            operation.load_torque().into(),
            state(operation).into(),
            value(SweepQuantity::Speed).into(),
            SweepQuantity::Speed.of(operation).map(|estimate| estimate.standard_error).into(),
            spread.map(|spread| spread.from_to[0]).into(),
            spread.map(|spread| spread.from_to[1]).into(),
            value(SweepQuantity::MechanicalPower).into(),
            value(SweepQuantity::InputPower).into(),
            value(SweepQuantity::Efficiency).map(|share| 100.0 * share).into(),
        ]);
    }
    table
}

/// All quantities with their standard errors, and the spread of the speed.
fn table(found: &[Operation], spreads: &[Option<InputSpread>]) -> Table {
    let load = MotorField::LoadTorque;
    let mut columns = vec![(load.name(), load.unit()), ("state", "1")];
    for (quantity, error) in SweepQuantity::ALL.into_iter().zip(ERRORS) {
        columns.push((quantity.name(), quantity.unit()));
        columns.push((error, quantity.unit()));
    }
    for name in ["speed_spread", "speed_spread_error", "speed_from", "speed_to"] {
        columns.push((name, SweepQuantity::Speed.unit()));
    }
    let mut table = Table::new(&columns);
    for (operation, spread) in found.iter().zip(spreads) {
        let mut row: Vec<Cell> = vec![operation.load_torque().into(), state(operation).into()];
        for quantity in SweepQuantity::ALL {
            let estimate = quantity.of(operation);
            row.push(estimate.map(|estimate| estimate.value).into());
            row.push(estimate.map(|estimate| estimate.standard_error).into());
        }
        let deviation = spread.map(|spread| spread.standard_deviation);
        row.push(deviation.map(|estimate| estimate.value).into());
        row.push(deviation.map(|estimate| estimate.standard_error).into());
        row.extend([0, 1].map(|end| spread.map(|spread| spread.from_to[end]).into()));
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
