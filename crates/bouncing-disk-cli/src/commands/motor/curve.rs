//! `bouncing-disk motor curve`: speed, power and efficiency over the load.

use bouncing_disk::motor::{InputSpread, MotorField, OperatingRow, Operation, SweepQuantity};

use bouncing_disk_plot::{Figure, rounded};

use super::settings::{
    SettingsArgs, SpreadArgs, begin, interval, life, lock_note, motion, needs_friction, shown_life, state,
    with_details,
};
use crate::commands::prelude::*;

/// The torque-speed curve, with power and efficiency
#[derive(Debug, Args)]
#[command(after_help = "\
All loads share one vertical motion, so a curve costs little more than a point, unless loads settle slowly. Errors \
are standard errors at exactly these inputs. The spread is computed over motors whose preload and amplitude lie \
within the tolerance, with a relaunch perturbation within a decade; with 39 samples or more, at least 95 of 100 \
further motors lie between its ends. A load beyond the largest torque mu m g a_e overpowers the motor, which then \
has no mean speed. A picture marks the stall by linear interpolation of the speed between two loads; `motor stall` \
computes it. With a [drive] that is not a sine, or a compliant [stator], each load has its own vertical motion; with \
either, or with a contact.time, no spread is computed. See docs/designing-a-motor.md.

Examples:
  bouncing-disk motor curve
  bouncing-disk motor curve motor.toml --load-torques 0:40e-6:21 --out curve.png --out curve.csv
  bouncing-disk motor curve --set contact.time=14e-6")]
pub(crate) struct CurveArgs {
    #[command(flatten)]
    motor: MotorArgs,
    /// Load torques (N m), FIRST:LAST:POINTS, in addition to a table [load]; by default eleven from zero to
    /// the largest torque, or none with such a table
    #[arg(help_heading = OWN, long, alias = "loads", value_name = "LOADS", allow_hyphen_values = true)]
    load_torques: Option<Range>,
    #[command(flatten)]
    settings: SettingsArgs,
    #[command(flatten)]
    spread: SpreadArgs,
    #[command(flatten)]
    output: OutputArgs,
}

pub(super) fn run(args: &CurveArgs, context: Context) -> Result<()> {
    let Some(motor) = begin(&args.motor, &args.output, true, None, context)? else { return Ok(()) };
    // A load law already has a torque.
    let has_law = motor.load().is_some();
    let load_torques = match args.load_torques {
        Some(loads) => loads,
        None if has_law => Range::new(0.0, 0.0, 1).map_err(Failure::Usage)?,
        None => {
            needs_friction(&motor, "torque-speed curve")?;
            Range::new(0.0, motor.largest_torque(), 11).map_err(Failure::Usage)?
        }
    };
    let loads: Vec<f64> = load_torques.values().collect();
    let settings = args.settings.settings();
    let watch = context.watch("motor curve");
    let found = motor.torque_speed_curve(&loads, &settings, &watch)?;
    let tolerance = args.spread.of(&motor, context);
    let spreads = match &tolerance {
        Some(tolerance) => {
            let watch = context.watch("motor curve: spread");
            motor.speed_spreads(&loads, &settings, tolerance, &watch)?
        }
        None => vec![None; loads.len()],
    };
    // Only the first branch has a spread.
    let branches = |((row, spread), load): ((&OperatingRow, &Option<InputSpread>), &f64)| {
        let (spread, load) = (*spread, *load);
        let all = row.branches.clone().into_iter().zip(1..);
        all.map(move |(operation, branch)| (operation, spread.filter(|_| branch == 1), branch, load))
    };
    let rows: Vec<Row> = found.iter().zip(&spreads).zip(&loads).flat_map(branches).collect();
    let coexist = found.iter().any(|row| row.branches.len() > 1);
    let job =
        json!({ "motor": motor, "load_torques": load_torques, "settings": settings, "tolerance": tolerance });
    let starts =
        found.iter().zip(&loads).filter(|(row, _)| row.starts() == Some(true)).map(|(_, load)| *load);
    let of_these = if has_law { "of these added torques" } else { "of these loads" };
    let note = match starts.reduce(f64::max) {
        Some(most) => format!(
            "\nstarts from rest under {} N m, the largest {of_these} for which this is certain\n",
            rounded(most, 6)
        ),
        None => "\na start from rest is not certain under any of these loads\n".to_owned(),
    } + &lock_note(&motor)?;
    let report = Report {
        provenance: provenance("bouncing-disk motor curve", &job)?,
        text: with_details(shown(has_law, coexist, tolerance.is_some()), &found, |row| &row.0).to_text(&rows)
            + &note,
        table: columns(SweepQuantity::of_table(&found)).csv_of(rows.clone()),
        data: vec![("operations", stored(&found)?), ("spreads", stored(&spreads)?)],
        figure: Some(Box::new(|| draw(motor.largest_torque(), &found, &spreads))),
    };
    report.deliver(&args.output, context)
}

fn draw(largest_torque: f64, found: &[OperatingRow], spreads: &[Option<InputSpread>]) -> Figure {
    let point = |operation: &Operation, spread: Option<InputSpread>| {
        let of = |quantity: SweepQuantity| quantity.of(operation).map(interval);
        pictures::LoadPoint {
            load_torque: operation.load_torque(),
            speed: of(SweepQuantity::Speed),
            spread: spread.map(|spread| spread.from_to),
            most: spread.map(|spread| spread.most_from_to),
            input_power: of(SweepQuantity::InputPower),
            mechanical_power: of(SweepQuantity::MechanicalPower),
            efficiency: of(SweepQuantity::Efficiency),
            amplitude: of(SweepQuantity::StatorAmplitude),
            electrical_efficiency: of(SweepQuantity::ElectricalEfficiency),
        }
    };
    let first: Vec<_> =
        found.iter().zip(spreads).map(|(row, spread)| point(row.operation(), *spread)).collect();
    let most = found.iter().map(|row| row.branches.len()).max().unwrap_or(0);
    let branch =
        |index: usize| found.iter().filter_map(|row| Some(point(row.branches.get(index)?, None))).collect();
    let others: Vec<Vec<_>> = (1..most).map(branch).collect();
    pictures::torque_speed(largest_torque, &first, &others)
}

/// A load, the spread over motors within the tolerance, if requested, the number of the branch (1 for the branch that
/// most rotors reach from rest), and the requested load torque (N m).
type Row = (Operation, Option<InputSpread>, usize, f64);

fn value(row: &Row, quantity: SweepQuantity) -> Option<f64> {
    quantity.of(&row.0).map(|estimate| estimate.value)
}

fn error(row: &Row, quantity: SweepQuantity) -> Option<f64> {
    quantity.of(&row.0).map(|estimate| estimate.standard_error)
}

fn end(row: &Row, end: usize) -> Option<f64> {
    row.1.map(|spread| spread.from_to[end])
}

fn shown(has_law: bool, coexist: bool, has_spread: bool) -> Columns<Row> {
    let mut columns = Columns::<Row>::new();
    if has_law {
        columns = columns.column("added_torque", "N m", |row| row.3);
    }
    columns = columns
        .column("load_torque", "N m", |row| row.0.load_torque())
        .column("state", "1", |row| state(&row.0));
    if coexist {
        columns = columns
            .column("branch", "1", |row| row.2)
            .column("motion", "1", |row| motion(&row.0))
            .column("life", "s", |row| shown_life(&row.0));
    }
    columns = columns.column("speed", "rad/s", |row| value(row, SweepQuantity::Speed)).column(
        "error",
        "rad/s",
        |row| error(row, SweepQuantity::Speed),
    );
    if has_spread {
        columns = columns.column("from", "rad/s", |row| end(row, 0)).column("to", "rad/s", |row| end(row, 1));
    }
    columns
        .column("power", "W", |row| value(row, SweepQuantity::MechanicalPower))
        .column("input_power", "W", |row| value(row, SweepQuantity::InputPower))
        .column("efficiency", "%", |row| value(row, SweepQuantity::Efficiency).map(|share| 100.0 * share))
}

/// The columns of a file: the quantities with their standard errors, and the spread of the speed.
fn columns(quantities: &[SweepQuantity]) -> Columns<Row> {
    let load = MotorField::LoadTorque;
    let mut columns = Columns::<Row>::new()
        .column(load.name(), load.unit(), |row| row.0.load_torque())
        .column("branch", "1", |row| row.2)
        .column("motion", "1", |row| motion(&row.0))
        .column("life", "s", |row| life(&row.0))
        .column("state", "1", |row| state(&row.0));
    for &quantity in quantities {
        columns = columns.column(quantity.name(), quantity.unit(), move |row| value(row, quantity)).column(
            format!("{}_error", quantity.name()),
            quantity.unit(),
            move |row| error(row, quantity),
        );
    }
    let unit = SweepQuantity::Speed.unit();
    columns
        .column("speed_spread", unit, |row| row.1.map(|spread| spread.standard_deviation.value))
        .column("speed_spread_error", unit, |row| {
            row.1.map(|spread| spread.standard_deviation.standard_error)
        })
        .column("speed_from", unit, |row| end(row, 0))
        .column("speed_to", unit, |row| end(row, 1))
}
