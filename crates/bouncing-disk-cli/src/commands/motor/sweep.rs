//! `bouncing-disk motor sweep`: a motor over one or two fields of its data sheet.

use std::ops::Range as Rows;
use std::str::FromStr;

use bouncing_disk::core::PartialResults;
use bouncing_disk::{
    Motor, MotorField, MotorSweep, MotorSweepRun, Observer, OperatingSettings, Operation, SweepAxis,
    SweepQuantity, operations,
};
use clap::{Args, ValueEnum};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::curve::state;
use super::settings::SettingsArgs;
use super::wrote_template;
use crate::arguments::{GridArgs, OWN, OutputArgs};
use crate::context::Context;
use crate::failure::Failure;
use crate::grid::{self, GridJob};
use crate::output::lines::complain;
use crate::output::report::{Report, provenance, ready, stored};
use crate::output::table::{Cell, Table};
use crate::parameters::motor::MotorArgs;
use crate::pictures;
use crate::range::Range;

/// What stands at the end of the help.
const AFTER: &str = "\
One --over makes a curve, two make a map, the first being that of the rows. Cells of one vertical motion (they differ in \
load, friction, phase lag, twist, radii or mass only) are computed on one orbit, as a row of the computation: --chunk and \
--journal divide and keep these. Fields are those of the data sheet, in its units. See docs/designing-a-motor.md.

Examples:
  bouncing-disk motor sweep --over load_torque=0:30e-6:7 --out curve.csv
  bouncing-disk motor sweep --over preload_force=0.2:0.4:3 --over phase_lag=-1:1:9 --out map.png
  bouncing-disk motor sweep motor.toml --over amplitude=1e-9:1e-7:50 --journal sweep.journal";

/// A motor over one or two fields of its data sheet
#[derive(Debug, Args)]
#[command(after_help = AFTER)]
pub(crate) struct SweepArgs {
    #[command(flatten)]
    motor: MotorArgs,
    /// A field of the data sheet and its values, FIELD=FIRST:LAST:POINTS; one or two of them
    #[arg(help_heading = OWN, long, value_name = "FIELD=RANGE", required_unless_present = "template")]
    over: Vec<Over>,
    /// The quantity of a picture
    #[arg(help_heading = OWN, long, value_name = "QUANTITY", default_value = "speed")]
    picture: Picture,
    #[command(flatten)]
    settings: SettingsArgs,
    #[command(flatten)]
    grid: GridArgs,
    #[command(flatten)]
    output: OutputArgs,
}

/// A field and the values that it takes.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Over {
    field: MotorField,
    values: Range,
}

impl FromStr for Over {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let form = || "an axis is FIELD=FIRST:LAST:POINTS, such as load_torque=0:30e-6:7".to_owned();
        let (field, values) = text.split_once('=').ok_or_else(form)?;
        let field = field.trim().parse::<MotorField>().map_err(|unknown| unknown.to_string())?;
        Ok(Self { field, values: values.parse()? })
    }
}

/// What a picture shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
enum Picture {
    /// Mean angular speed
    Speed,
    /// Load torque times mean speed
    MechanicalPower,
    /// Power that the stator puts in
    InputPower,
    /// Mechanical power over the power put in
    Efficiency,
}

impl From<Picture> for SweepQuantity {
    fn from(picture: Picture) -> Self {
        match picture {
            Picture::Speed => Self::Speed,
            Picture::MechanicalPower => Self::MechanicalPower,
            Picture::InputPower => Self::InputPower,
            Picture::Efficiency => Self::Efficiency,
        }
    }
}

/// Runs the command.
pub(super) fn run(args: &SweepArgs, context: Context) -> Result<(), Failure> {
    if wrote_template(&args.motor, &args.output, context)? {
        return Ok(());
    }
    let job = SweepJob {
        motor: args.motor.motor(context.quiet)?,
        axes: args.over.clone(),
        settings: args.settings.settings(),
        picture: args.picture,
        groups: 0,
    };
    let sweep = job.sweep()?;
    if !context.quiet {
        sweep.replaced().iter().for_each(|field| complain!("the {field} of the data sheet is left out"));
    }
    let job = SweepJob { groups: sweep.groups().len(), ..job };
    grid::run(job, &args.motor.inputs(), &args.grid, &args.output, context)
}

/// What a sweep depends on.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct SweepJob {
    motor: Motor,
    axes: Vec<Over>,
    settings: OperatingSettings,
    picture: Picture,
    /// Number of vertical motions, which are the rows.
    groups: usize,
}

impl SweepJob {
    fn sweep(&self) -> Result<MotorSweep, Failure> {
        let axis = |over: &Over| SweepAxis::new(over.field, over.values.values().collect());
        Ok(MotorSweep::new(self.motor, self.axes.iter().map(axis).collect(), self.settings)?)
    }
}

impl GridJob for SweepJob {
    const COMMAND: &'static str = "motor sweep";

    /// The operations of the cells of one vertical motion.
    type Row = Vec<Operation>;

    type Prepared = MotorSweep;

    fn rows(&self) -> usize {
        self.groups
    }

    fn together(&self) -> usize {
        rayon::current_num_threads()
    }

    fn prepare(&self, _: &dyn Observer) -> Result<MotorSweep, Failure> {
        let sweep = self.sweep()?;
        if sweep.groups().len() != self.groups {
            return Err(Failure::usage(format!(
                "the sweep has {} vertical motions, where {} are stored",
                sweep.groups().len(),
                self.groups
            )));
        }
        Ok(sweep)
    }

    fn compute(
        &self,
        sweep: &MotorSweep,
        rows: Rows<usize>,
        observer: &dyn Observer,
    ) -> Result<Vec<Vec<Operation>>, Failure> {
        let group = |row: usize| {
            let cells = sweep.groups()[row].iter();
            let motors = cells.map(|cell| sweep.motor_of(*cell)).collect::<Result<Vec<_>, _>>()?;
            operations(&motors, sweep.settings(), observer)
        };
        Ok(rows.into_par_iter().map(group).collect::<Result<_, bouncing_disk::Error>>()?)
    }

    fn report(self, sweep: MotorSweep, rows: Vec<Vec<Operation>>) -> Result<Report, Failure> {
        let mut all = PartialResults::new(rows.len());
        all.extend(rows.into_iter().enumerate());
        let result = MotorSweepRun::from(all).into_result(&sweep)?;
        let fields: Vec<MotorField> = result.axes().iter().map(|axis| axis.parameter).collect();
        let mut columns: Vec<_> = fields.iter().map(|field| (field.name(), field.unit())).collect();
        columns.extend([
            ("state", "1"),
            ("speed", "rad/s"),
            ("error", "rad/s"),
            ("power", "W"),
            ("efficiency", "%"),
        ]);
        let mut shown = Table::new(&columns);
        for (values, operation) in result.iter() {
            let of = |quantity: SweepQuantity| quantity.of(operation);
            let mut row: Vec<Cell> = values.iter().map(|(_, value)| (*value).into()).collect();
            row.push(state(operation).into());
            row.push(of(SweepQuantity::Speed).map(|speed| speed.value).into());
            row.push(of(SweepQuantity::Speed).map(|speed| speed.standard_error).into());
            row.push(of(SweepQuantity::MechanicalPower).map(|power| power.value).into());
            row.push(of(SweepQuantity::Efficiency).map(|share| 100.0 * share.value).into());
            shown.push(row);
        }
        let quantity = self.picture.into();
        Ok(Report {
            provenance: provenance("bouncing-disk motor sweep", &self)?,
            text: shown.to_text(),
            table: ready(Table::of_csv(result.to_csv())),
            data: vec![("axes", stored(result.axes())?), ("cells", stored(result.cells())?)],
            figure: Some(Box::new(move || pictures::sweep::draw(&result, quantity))),
        })
    }
}
