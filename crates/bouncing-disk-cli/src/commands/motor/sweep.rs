//! `bouncing-disk motor sweep`: a motor over one or two fields of its data sheet.

use bouncing_disk::motor::{
    MotorField, MotorSweep, MotorSweepResult, OperatingRow, OperatingSettings, Operation, SweepAxis,
    SweepQuantity,
};
use bouncing_disk::{Motor, Observer};
use bouncing_disk_plot::{Figure, SINGLE_COLUMN};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::settings::{SettingsArgs, interval, motion, shown_unit, state, warn, with_details};
use crate::commands::prelude::*;

/// A motor over one or two fields of its data sheet
#[derive(Debug, Args)]
#[command(after_help = "\
One --over makes a curve, two make a map, the first being that of the rows. Cells of one vertical motion (they differ in \
load, friction, phase lag, twist, radii or mass only) are computed on one orbit, as a row of the computation: --chunk and \
--journal divide and keep these. Fields are those of the data sheet, in its units; \
contact.time makes contacts take time, cell by cell. See docs/designing-a-motor.md.

Examples:
  bouncing-disk motor sweep --over load_torque=0:30e-6:7 --out curve.csv
  bouncing-disk motor sweep --over preload_force=0.2:0.4:3 --over phase_lag=-1:1:9 --out map.png
  bouncing-disk motor sweep motor.toml --over amplitude=1e-9:1e-7:50 --journal sweep.journal")]
pub(crate) struct SweepArgs {
    #[command(flatten)]
    motor: MotorArgs,
    /// A field of the data sheet and its values, FIELD=FIRST:LAST:POINTS; one or two of them
    #[arg(help_heading = OWN, long, value_name = "FIELD=RANGE", required_unless_present = "template", value_parser = over)]
    over: Vec<Over>,
    /// The values go up and down again, each cell from where the one before was left: for a [stator] that yields, over
    /// one field
    #[arg(help_heading = OWN, long)]
    up_and_down: bool,
    /// The quantity of a picture
    #[arg(help_heading = OWN, long, value_name = "QUANTITY", default_value = "speed", value_parser = one_of(PICTURES))]
    picture: SweepQuantity,
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
    let form = || "an axis is FIELD=FIRST:LAST:POINTS, such as load_torque=0:30e-6:7".to_owned();
    let (field, values) = text.split_once('=').ok_or_else(form)?;
    let field = field.trim().parse::<MotorField>().map_err(|unknown| unknown.to_string())?;
    Ok(Over { field, values: values.parse()? })
}

const PICTURES: Words<SweepQuantity> = &[
    ("speed", "Mean angular speed", SweepQuantity::Speed),
    ("mechanical-power", "Load torque times mean speed", SweepQuantity::MechanicalPower),
    ("input-power", "Power that the stator puts in", SweepQuantity::InputPower),
    ("efficiency", "Mechanical power over the power put in", SweepQuantity::Efficiency),
    ("speed-deviation", "Standard deviation of the speed over time", SweepQuantity::SpeedDeviation),
    ("blocked-torque", "Mean torque on a rotor that is held at rest", SweepQuantity::BlockedTorque),
    ("stator-amplitude", "Amplitude under load of a stator that yields", SweepQuantity::StatorAmplitude),
    ("drive-power", "Power that the drive puts into such a stator", SweepQuantity::DrivePower),
    ("electrical-efficiency", "Mechanical power over that of the drive", SweepQuantity::ElectricalEfficiency),
];

pub(super) fn run(args: &SweepArgs, context: Context) -> Result<()> {
    let Some(motor) = args.motor.unless_template(&args.output, context)? else { return Ok(()) };
    warn(&motor, context);
    let job = SweepJob {
        motor,
        axes: args.over.clone(),
        up_and_down: args.up_and_down,
        settings: args.settings.settings(),
        picture: args.picture.name().to_owned(),
        groups: 0,
    };
    let sweep = job.sweep()?;
    let replaced = sweep.replaced();
    replaced.iter().for_each(|field| context.note(&format!("the {field} of the data sheet is left out")));
    let job = SweepJob { groups: sweep.groups().len(), ..job };
    grid::run(job, &args.motor.inputs(), &args.grid, &args.output, context)
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
    /// Number of vertical motions, which are the rows.
    groups: usize,
}

impl SweepJob {
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
        type Row = (Vec<f64>, Operation);
        let of = |row: &Row, quantity: SweepQuantity| quantity.of(&row.1);
        let mut columns = Columns::<Row>::new();
        for (index, axis) in result.axes().iter().enumerate() {
            columns = columns.column(axis.parameter.name(), axis.parameter.unit(), move |row| row.0[index]);
        }
        columns = columns
            .column("motion", "1", |row| motion(&row.1))
            .column("state", "1", |row| state(&row.1))
            .column("speed", "rad/s", move |row| of(row, SweepQuantity::Speed).map(|own| own.value))
            .column("error", "rad/s", move |row| of(row, SweepQuantity::Speed).map(|own| own.standard_error))
            .column("power", "W", move |row| of(row, SweepQuantity::MechanicalPower).map(|own| own.value))
            .column("efficiency", "%", move |row| {
                of(row, SweepQuantity::Efficiency).map(|own| 100.0 * own.value)
            });
        let branches = |(values, row): (Vec<(MotorField, f64)>, &OperatingRow)| {
            let values: Vec<f64> = values.into_iter().map(|(_, value)| value).collect();
            row.branches.clone().into_iter().map(move |operation| (values.clone(), operation))
        };
        let rows: Vec<Row> = result.iter().flat_map(branches).collect();
        let csv = result.to_csv();
        let Some(quantity) = SweepQuantity::WITH_STATOR.into_iter().find(|own| own.name() == self.picture)
        else {
            return Err(Failure::Usage(format!("there is no quantity {}", self.picture)));
        };
        Ok(Report {
            provenance: provenance("bouncing-disk motor sweep", self)?,
            text: with_details(columns, result.cells(), |row| &row.1).to_text(&rows),
            table: Box::new(move |to| to.write_all(csv.as_bytes())),
            data: vec![("axes", stored(result.axes())?), ("cells", stored(result.cells())?)],
            figure: Some(Box::new(move || draw(&result, quantity))),
        })
    }
}

/// The quantity over the axes. A missing value is a gap in a curve, and grey in a map.
fn draw<'a>(result: &'a MotorSweepResult, quantity: SweepQuantity) -> Figure {
    let (name, (unit, scale)) = (quantity.name(), shown_unit(quantity));
    let estimates = result
        .cells()
        .iter()
        .map(|cell| quantity.of(cell.operation()).map_or((f64::NAN, f64::NAN), interval));
    let (values, halves): (Vec<f64>, Vec<f64>) =
        estimates.map(|(value, half)| (scale * value, scale * half)).unzip();
    let cells = pictures::Quantity { name, unit, values: &values };
    let along = |axis: &'a SweepAxis| pictures::Quantity {
        name: axis.parameter.name(),
        unit: axis.parameter.unit(),
        values: &axis.values,
    };
    match result.axes() {
        [rows, columns, ..] => pictures::heat_map(&along(columns), &along(rows), &cells),
        [only] => pictures::swept_curve(&along(only), &cells, &halves),
        [] => Figure::new(SINGLE_COLUMN, SINGLE_COLUMN),
    }
}
