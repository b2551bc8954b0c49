//! `bouncing-disk motor sweep`: a motor over one or two fields of its data sheet.

use bouncing_disk::core::Unobserved;
use bouncing_disk::motor::{
    AxialMotion, MotorField, MotorSweep, MotorSweepResult, OperatingPoint, OperatingRow, OperatingSettings,
    Operation, QuantityBound, SweepAxis, SweepQuantity,
};
use bouncing_disk::{Motor, Observer};
use bouncing_disk_plot::{Figure, SINGLE_COLUMN, rounded};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::settings::{SettingsArgs, begin, interval, motion, shown_life, shown_unit, state, with_details};
use crate::commands::prelude::*;

/// A motor over one or two fields of its data sheet
#[derive(Debug, Args)]
#[command(after_help = "\
One --over makes a curve; two make a map with a row for each value of the first field. Cells that share a vertical \
motion (they differ only in load, friction, phase lag, twist, radii or mass) are computed on one orbit, as one row \
for --chunk and --journal. Fields are named as in the data sheet, in its units; contact.time makes contacts \
compliant, cell by cell. A cell has one line for each coexisting motion. A map shows the first motion, which most \
rotors reach from rest, and marks cells with several motions, with a periodic one, and unsettled cells. With \
--up-and-down all fields except the one of --over are held, and the first line of the output names the drive, the \
preload and the phase lag. See docs/designing-a-motor.md.

Examples:
  bouncing-disk motor sweep --over load_torque=0:30e-6:7 --out curve.csv
  bouncing-disk motor sweep --over preload_force=0.2:0.4:3 --over phase_lag=-1:1:9 --out map.png
  bouncing-disk motor sweep motor.toml --over amplitude=1e-9:1e-7:50 --journal sweep.journal")]
pub(crate) struct SweepArgs {
    #[command(flatten)]
    motor: MotorArgs,
    /// A field of the data sheet and its values, FIELD=FIRST:LAST:POINTS; at most two
    #[arg(help_heading = OWN, long, value_name = "FIELD=RANGE", required_unless_present = "template", value_parser = over)]
    over: Vec<Over>,
    /// Runs through the values up and down again, each cell starting from the final state of its predecessor; for a
    /// compliant [stator], over one field
    #[arg(help_heading = OWN, long)]
    up_and_down: bool,
    /// The quantity of a picture
    #[arg(help_heading = OWN, long, value_name = "QUANTITY", default_value = "speed", value_parser = one_of(PICTURES))]
    picture: SweepQuantity,
    /// A bound as in `motor best`, drawn in a map as a line between cells that satisfy it and cells that do not
    #[arg(help_heading = OWN, long = "where", value_name = "BOUND")]
    bound: Option<QuantityBound>,
    #[command(flatten)]
    settings: SettingsArgs,
    #[command(flatten)]
    grid: GridArgs,
    #[command(flatten)]
    output: OutputArgs,
}

#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Over {
    field: MotorField,
    values: Range,
}

fn over(text: &str) -> Result<Over, String> {
    let (field, values) =
        assignment(text, "an axis is FIELD=FIRST:LAST:POINTS, such as load_torque=0:30e-6:7")?;
    let field = field.parse::<MotorField>().map_err(|unknown| unknown.to_string())?;
    Ok(Over { field, values: values.parse()? })
}

/// The held inputs that a continued sweep names, if the sheet gives them: the one amplitude of the drive (the
/// others follow from it at each frequency), the frequency, the twist, the preload and the phase lag.
const HELD: [MotorField; 9] = [
    MotorField::DriveFrequency,
    MotorField::Amplitude,
    MotorField::StatorForce,
    MotorField::StatorVolts,
    MotorField::PeakAngularSpeed,
    MotorField::TwistAmplitude,
    MotorField::PreloadForce,
    MotorField::PreloadAcceleration,
    MotorField::PhaseLag,
];

const PICTURES: Words<SweepQuantity> = &[
    ("speed", "Mean angular speed", SweepQuantity::Speed),
    ("mechanical-power", "Load torque times mean speed", SweepQuantity::MechanicalPower),
    ("input-power", "Power supplied by the stator", SweepQuantity::InputPower),
    ("efficiency", "Mechanical power over supplied power", SweepQuantity::Efficiency),
    ("speed-deviation", "Standard deviation of the speed over time", SweepQuantity::SpeedDeviation),
    ("blocked-torque", "Mean torque on a rotor held at rest", SweepQuantity::BlockedTorque),
    ("stator-amplitude", "Amplitude of a compliant stator under load", SweepQuantity::StatorAmplitude),
    ("drive-power", "Power supplied by the drive to a compliant stator", SweepQuantity::DrivePower),
    ("electrical-efficiency", "Mechanical power over drive power", SweepQuantity::ElectricalEfficiency),
];

pub(super) fn run(args: &SweepArgs, context: Context) -> Result<()> {
    let given = begin(&args.motor, &args.output, true, Some(&args.grid), context)?;
    let Some(motor) = given else { return Ok(()) };
    let job = SweepJob {
        motor,
        axes: args.over.clone(),
        up_and_down: args.up_and_down,
        settings: args.settings.settings(),
        picture: args.picture.name().to_owned(),
        bound: args.bound.map(|bound| bound.to_string()),
        groups: 0,
    };
    let sweep = job.sweep()?;
    let replaced = sweep.replaced();
    replaced.iter().for_each(|field| context.note(&format!("the {field} of the data sheet is ignored")));
    let job = SweepJob { groups: sweep.groups().len(), ..job };
    grid::run(job, &args.grid, &args.output, context)
}

#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct SweepJob {
    motor: Motor,
    axes: Vec<Over>,
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    up_and_down: bool,
    settings: OperatingSettings,
    picture: String,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    bound: Option<String>,
    /// Number of vertical motions, which are the rows.
    groups: usize,
}

impl SweepJob {
    /// The line on a continued sweep: where its cells start, and which inputs it holds. The held inputs are the
    /// given ones, except the swept input and those that it replaces.
    fn held(&self, replaced: &[MotorField]) -> String {
        if !self.up_and_down {
            return String::new();
        }
        let sheet = self.motor.parameters();
        let swept = |field: &MotorField| {
            replaced.contains(field) || self.axes.iter().any(|axis| axis.field == *field)
        };
        let shown = |field: &MotorField| {
            let unit = if field.unit() == "1" { String::new() } else { format!(" {}", field.unit()) };
            let which = if *field == MotorField::Amplitude { " without a rotor" } else { "" };
            Some(format!("{} = {}{unit}{which}", field.name(), rounded(field.value(sheet)?, 6)))
        };
        let held: Vec<String> = HELD.iter().filter(|field| !swept(field)).filter_map(shown).collect();
        format!(
            "continued: each cell starts from the final state of its predecessor, the first from rest; held: {}, and everything else in \
             the sheet\n",
            held.join(", ")
        )
    }

    fn sweep(&self) -> Result<MotorSweep> {
        let axis = |over: &Over| {
            let mut values: Vec<f64> = over.values.values().collect();
            if self.up_and_down {
                values.extend_from_within(..values.len() - 1);
                values[over.values.values().count()..].reverse();
            }
            SweepAxis::new(over.field, values)
        };
        let sweep = MotorSweep::new(self.motor.clone(), self.axes.iter().map(axis).collect(), self.settings)?;
        Ok(if self.up_and_down { sweep.continued()? } else { sweep })
    }
}

impl GridJob for SweepJob {
    const COMMAND: &'static str = "motor sweep";

    /// The operations of the cells of one vertical motion.
    type Row = Vec<OperatingRow>;

    type Prepared = MotorSweep;

    fn rows(&self) -> usize {
        self.groups
    }

    fn prepare(&self, _: &dyn Observer) -> Result<MotorSweep> {
        self.sweep()
    }

    fn compute(&self, sweep: &MotorSweep, rows: Rows, observer: &dyn Observer) -> Result<Vec<Self::Row>> {
        let group = |row: usize| sweep.operations(row, observer);
        Ok(rows.into_par_iter().map(group).collect::<Result<_, bouncing_disk::Error>>()?)
    }

    fn report<'a>(&'a self, sweep: &'a MotorSweep, rows: &'a [Vec<OperatingRow>]) -> Result<Report<'a>> {
        let result = sweep.result(rows)?;
        type Row = (Vec<f64>, Operation, usize, Option<&'static str>);
        let of = |row: &Row, quantity: SweepQuantity| quantity.of(&row.1);
        let coexist = result.cells().iter().any(|row| row.branches.len() > 1);
        let mut columns = Columns::<Row>::new();
        for (index, axis) in result.axes().iter().enumerate() {
            columns = columns.column(axis.parameter.name(), axis.parameter.unit(), move |row| row.0[index]);
        }
        if self.up_and_down {
            columns = columns.column("way", "1", |row| row.3);
        }
        if coexist {
            columns = columns.column("branch", "1", |row| row.2);
        }
        columns = columns.column("motion", "1", |row| motion(&row.1));
        if coexist {
            columns = columns.column("life", "s", |row| shown_life(&row.1));
        }
        columns = columns
            .column("state", "1", |row| state(&row.1))
            .column("speed", "rad/s", move |row| of(row, SweepQuantity::Speed).map(|own| own.value))
            .column("error", "rad/s", move |row| of(row, SweepQuantity::Speed).map(|own| own.standard_error))
            .column("power", "W", move |row| of(row, SweepQuantity::MechanicalPower).map(|own| own.value))
            .column("efficiency", "%", move |row| {
                of(row, SweepQuantity::Efficiency).map(|own| 100.0 * own.value)
            });
        let mut rows: Vec<Row> = Vec::new();
        for (cell, (values, row)) in result.iter().enumerate() {
            let values: Vec<f64> = values.into_iter().map(|(_, value)| value).collect();
            let way = result.way(cell);
            let all = row.branches.iter().copied().zip(1..);
            rows.extend(all.map(|(operation, branch)| (values.clone(), operation, branch, way)));
        }
        let csv = result.to_csv();
        let Some(quantity) = SweepQuantity::WITH_STATOR.into_iter().find(|own| own.name() == self.picture)
        else {
            return Err(Failure::Usage(format!("there is no quantity {}", self.picture)));
        };
        let bound = self.bound.as_ref().map(|bound| bound.parse::<QuantityBound>());
        let bound = bound.transpose().map_err(Failure::Usage)?;
        let locked = locked(sweep)?;
        let turns_at = self.up_and_down.then(|| result.cells().len() / 2);
        Ok(Report {
            provenance: provenance("bouncing-disk motor sweep", self)?,
            text: self.held(&sweep.replaced())
                + &with_details(columns, result.cells(), |row| &row.1).to_text(&rows),
            table: Box::new(move |to| to.write_all(csv.as_bytes())),
            data: vec![("axes", stored(result.axes())?), ("cells", stored(result.cells())?)],
            figure: Some(Box::new(move || draw(&result, quantity, bound, turns_at, &locked))),
        })
    }
}

/// Maps with more vertical motions do not mark locked cells.
const MOST_REGIMES: usize = 2_000;

/// Whether the motor of each cell locks to a short cycle. The cells of a group share their vertical motion.
fn locked(sweep: &MotorSweep) -> Result<Vec<bool>> {
    let mut locked = vec![false; sweep.cells()];
    if sweep.motor().rigid_sine().is_err() || sweep.groups().len() > MOST_REGIMES {
        return Ok(locked);
    }
    for group in sweep.groups() {
        let motor = sweep.motor_of(group[0])?;
        if motor.rigid_sine().is_ok() && motor.report(&Unobserved)?.regime.is_locked() {
            group.iter().for_each(|cell| locked[*cell] = true);
        }
    }
    Ok(locked)
}

/// Marks of an operation in the picture, besides its value.
fn marks(operation: &Operation, coexisting: bool, bound: Option<QuantityBound>) -> pictures::CellMarks {
    let repeats = |point: &OperatingPoint| matches!(point.motion, AxialMotion::Periodic { .. });
    pictures::CellMarks {
        coexisting,
        periodic: operation.point().is_some_and(repeats),
        unsettled: matches!(operation, Operation::Unsettled(..)),
        runaway: matches!(operation, Operation::Runaway { .. }),
        locked: false,
        keeps: bound.and_then(|bound| bound.is_kept(operation)),
    }
}

/// The quantity over the axes. A missing value is a gap in a curve, and grey in a map.
fn draw<'a>(
    result: &'a MotorSweepResult,
    quantity: SweepQuantity,
    bound: Option<QuantityBound>,
    turns_at: Option<usize>,
    locked: &[bool],
) -> Figure {
    let (name, (unit, scale)) = (quantity.name(), shown_unit(quantity));
    let estimates = result
        .cells()
        .iter()
        .map(|cell| quantity.of(cell.operation()).map_or((f64::NAN, f64::NAN), interval));
    let (values, halves): (Vec<f64>, Vec<f64>) =
        estimates.map(|(value, half)| (scale * value, scale * half)).unzip();
    // A curve shows all branches, a map the first one.
    let is_map = result.axes().len() > 1;
    let of_first = |row: &OperatingRow| marks(row.operation(), is_map && row.branches.len() > 1, bound);
    let mut cell_marks: Vec<_> = result.cells().iter().map(of_first).collect();
    cell_marks.iter_mut().zip(locked).for_each(|(marks, locked)| marks.locked = *locked);
    let most = result.cells().iter().map(|row| row.branches.len()).max().unwrap_or(0);
    let others: Vec<Vec<(f64, f64, pictures::CellMarks)>> = (1..most)
        .map(|branch| {
            let of = |row: &OperatingRow| {
                let operation = row.branches.get(branch)?;
                let (value, half) = quantity.of(operation).map(interval)?;
                Some((scale * value, scale * half, marks(operation, false, bound)))
            };
            let none = (f64::NAN, f64::NAN, pictures::CellMarks::default());
            result.cells().iter().map(|row| of(row).unwrap_or(none)).collect()
        })
        .collect();
    let cells = pictures::Quantity { name, unit, values: &values };
    let along = |axis: &'a SweepAxis| pictures::Quantity {
        name: axis.parameter.name(),
        unit: axis.parameter.unit(),
        values: &axis.values,
    };
    match result.axes() {
        [rows, columns, ..] => {
            let words = bound.map(|bound| bound.to_string());
            pictures::heat_map(&along(columns), &along(rows), &cells, &cell_marks, words.as_deref())
        }
        [only] => pictures::swept_curve(&along(only), &cells, &halves, &cell_marks, &others, turns_at),
        [] => Figure::new(SINGLE_COLUMN, SINGLE_COLUMN),
    }
}
