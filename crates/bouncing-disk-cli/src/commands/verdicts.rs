//! `bouncing-disk verdicts`: what the disk does for good, over the forcing, or over forcing and restitution.

mod found;
mod kind;

use std::ops::Range as Rows;
use std::rc::Rc;

use bouncing_disk::Observer;
use bouncing_disk::core::ChatterPolicy;
use bouncing_disk::core::attractors::{MAX_CELLS, Verdict, VerdictSettings, each_verdict};
use clap::Args;
use serde::{Deserialize, Serialize};

use self::found::Found;
pub(crate) use self::kind::Kind;
use crate::arguments::{GridArgs, OWN, OutputArgs};
use crate::commands::map::{MapArgs, VERTICAL, map};
use crate::commands::start::{STARTS, Start};
use crate::context::Context;
use crate::failure::Failure;
use crate::grid::{self, GridJob};
use crate::output::json::Data;
use crate::output::report::{Report, provenance, stored};
use crate::pictures;
use crate::range::Range;

/// What stands at the end of the help.
const AFTER: &str = "\
A verdict says what the orbit from the start does for good, with its evidence: rest, a cycle with rest, a period that is \
proved by Newton's method, chaos by growth that neither neutral motion nor the error explains, or undecided. A range of restitutions \
makes a map of regimes, a row for each. On the terminal a map is a count of its verdicts. See \
docs/studying-the-dynamics.md.

Examples:
  bouncing-disk verdicts --axial-forcing 0.3:0.6:7
  bouncing-disk verdicts -G 0:3:300 -r 0:0.95:200 --impacts 2000 --out map.png
  bouncing-disk verdicts -G 0:3:4000 -r 0:0.95:4000 --chunk 17/500 --out part-17.json";

/// Forcings unless given.
const FORCINGS: (f64, f64, usize) = (0.30, 0.62, 33);

/// Orbits that are followed together.
const TOGETHER: usize = 4_096;

/// Most cells that keep their evidence.
const MOST_DETAILED: u64 = 1 << 24;

/// What a cell takes while the result is made (bytes), with its evidence and without.
const DETAILED: u64 = 2 * size_of::<Option<Verdict>>() as u64;
const PLAIN: u64 = 4;

/// Verdicts on what the disk does for good, over forcing and restitution
#[derive(Debug, Args)]
#[command(after_help = AFTER)]
pub(crate) struct VerdictsArgs {
    /// Axial forcing parameter Gamma = A omega^2/(pi g): a number, or a range FIRST:LAST:POINTS, both ends
    /// included. That of FILE, --preset or --set unless given; without these 0.30:0.62:33
    #[arg(help_heading = VERTICAL, long, short = 'G', value_name = "GAMMA", allow_hyphen_values = true)]
    axial_forcing: Option<Range>,
    #[command(flatten)]
    map: MapArgs,
    #[arg(help_heading = OWN, long, allow_hyphen_values = true, value_name = "START", default_value_t = Start::Rise, help = format!("How each orbit starts: {STARTS}"))]
    start: Start,
    /// Impacts before the exponent is measured
    #[arg(help_heading = OWN, long, allow_negative_numbers = true, value_name = "N", default_value_t = VerdictSettings::default().transient)]
    transient: u64,
    /// Impacts that the exponent is measured over, at least 64
    #[arg(help_heading = OWN, long, allow_negative_numbers = true, value_name = "N", default_value_t = VerdictSettings::default().impacts)]
    impacts: u64,
    /// The longest period that is looked for, in impacts, at most 4096
    #[arg(help_heading = OWN, long, allow_negative_numbers = true, value_name = "N", default_value_t = VerdictSettings::default().longest_period)]
    longest_period: usize,
    /// How near an impact must come to an earlier one for a period to be tried, in (0, 0.01]
    #[arg(help_heading = OWN, long, allow_hyphen_values = true, value_name = "T", default_value_t = VerdictSettings::default().tolerance)]
    tolerance: f64,
    /// Keeps the evidence of each cell of a map in the file, which makes it a hundred times larger; without a
    /// range of restitutions it is always kept
    #[arg(help_heading = OWN, long)]
    details: bool,
    #[command(flatten)]
    grid: GridArgs,
    #[command(flatten)]
    output: OutputArgs,
}

/// Runs the command.
pub(crate) fn run(args: &VerdictsArgs, context: Context) -> Result<(), Failure> {
    if args.map.wrote_template(&args.output, context)? {
        return Ok(());
    }
    let (first, last, count) = FORCINGS;
    let values =
        args.map.values(args.axial_forcing, Range::new(first, last, count).map_err(Failure::usage)?)?;
    let job = VerdictsJob {
        axial_forcings: values.axial_forcings,
        restitutions: values.restitutions,
        start: args.start,
        settings: VerdictSettings {
            transient: args.transient,
            impacts: args.impacts,
            longest_period: args.longest_period,
            tolerance: args.tolerance,
        },
        details: args.details || values.restitutions.count() == 1,
    };
    grid::run(job, &args.map.inputs(), &args.grid, &args.output, context)
}

/// What verdicts depend on.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct VerdictsJob {
    axial_forcings: Range,
    restitutions: Range,
    start: Start,
    settings: VerdictSettings,
    /// Whether the evidence is kept, or the kinds alone.
    details: bool,
}

impl GridJob for VerdictsJob {
    const COMMAND: &'static str = "verdicts";

    /// Of a map a restitution over all forcings, else a forcing.
    type Row = Row;

    type Prepared = ();

    fn rows(&self) -> usize {
        if self.is_map() { self.restitutions.count() } else { self.axial_forcings.count() }
    }

    fn together(&self) -> usize {
        (TOGETHER / self.columns()).max(1)
    }

    fn prepare(&self, _: &dyn Observer) -> Result<(), Failure> {
        self.settings.check()?;
        let ((low, high), (least, largest)) = (self.axial_forcings.ends(), self.restitutions.ends());
        for (forcing, restitution) in [(low, least), (high, largest)] {
            map(forcing, restitution)?;
        }
        let cells = (self.rows() as u64).saturating_mul(self.columns() as u64);
        if self.details {
            grid::check_room("verdicts with their evidence", cells, MOST_DETAILED, DETAILED)
        } else {
            grid::check_room("cells of a map of verdicts", cells, MAX_CELLS, PLAIN)
        }
    }

    fn compute(
        &self,
        (): &(),
        rows: Rows<usize>,
        observer: &dyn Observer,
    ) -> Result<Vec<Self::Row>, Failure> {
        let columns = self.columns();
        let start = |index: usize| {
            let (forcing, restitution) = self.cell(rows.start + index / columns, index % columns);
            let map = map(forcing, restitution)?;
            Ok::<_, Failure>(self.start.of(&map)?.map(|state| (map, state)))
        };
        let (mut all, mut seen) = (Vec::new(), 0_usize);
        let each = |cell: Option<Verdict>| {
            if seen.is_multiple_of(columns) {
                all.push(if self.details { Row::Verdicts(Vec::new()) } else { Row::Kinds(String::new()) });
            }
            seen += 1;
            match all.last_mut() {
                Some(Row::Verdicts(row)) => row.push(cell),
                Some(Row::Kinds(row)) => row.push(Kind::of(cell.as_ref()).digit()),
                None => {}
            }
        };
        each_verdict(rows.len() * columns, start, self.settings, observer, each)?;
        Ok(all)
    }

    fn report(self, (): (), rows: Vec<Row>) -> Result<Report, Failure> {
        let (mut kinds, mut verdicts, mut digits) = (Vec::new(), Vec::new(), Vec::new());
        for row in rows {
            match row {
                Row::Verdicts(cells) => {
                    kinds.extend(cells.iter().map(|cell| Kind::of(cell.as_ref())));
                    verdicts.extend(cells);
                }
                Row::Kinds(row) => {
                    kinds.extend(row.chars().filter_map(Kind::of_digit));
                    digits.push(row);
                }
            }
        }
        let (expected, complete) =
            (self.rows() * self.columns(), !self.details || verdicts.len() == kinds.len());
        if kinds.len() != expected || !complete {
            return Err(Failure::usage(format!("{} verdicts are there, of {expected}", kinds.len())));
        }
        let provenance =
            provenance("bouncing-disk verdicts", &self)?.with_chatter_policy(ChatterPolicy::Complete);
        let mut data = vec![("kinds", stored(&Kind::ALL.map(Kind::name))?)];
        if !self.details {
            data.push(("kinds_by_restitution", stored(&digits)?));
        }
        let found = Rc::new(Found { job: self, kinds, verdicts });
        if found.job.details {
            let listed = Rc::clone(&found);
            data.push(("cells", Data::list(listed.kinds.len(), move |index| listed.cell(index))));
        }
        let drawn = Rc::clone(&found);
        let figure = move || {
            let Self { axial_forcings, restitutions, .. } = drawn.job;
            pictures::regimes::draw(axial_forcings, restitutions, &drawn.kinds)
        };
        Ok(Report {
            provenance,
            text: found.text(),
            table: Box::new(move |to| found.write_csv(to)),
            data,
            figure: Some(Box::new(figure)),
        })
    }
}

/// A row as it is kept and stored. A map without details takes a byte a cell; with them some hundred.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(untagged)]
pub(crate) enum Row {
    /// The digits of the kinds, by their places in [`Kind::ALL`].
    Kinds(String),
    /// `None` where there is no such start.
    Verdicts(Vec<Option<Verdict>>),
}

impl VerdictsJob {
    /// Whether both vary.
    fn is_map(&self) -> bool {
        self.restitutions.count() > 1
    }

    fn columns(&self) -> usize {
        if self.is_map() { self.axial_forcings.count() } else { 1 }
    }

    /// Forcing and restitution of a cell.
    fn cell(&self, row: usize, column: usize) -> (f64, f64) {
        if self.is_map() {
            (self.axial_forcings.value(column), self.restitutions.value(row))
        } else {
            (self.axial_forcings.value(row), self.restitutions.value(0))
        }
    }
}
