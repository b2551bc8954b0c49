//! `bouncing-disk verdicts`: what the disk does for good, over the forcing, or over forcing and restitution.

use std::ops::Range as Rows;

use bouncing_disk::Observer;
use bouncing_disk::core::{ChatterPolicy, Verdict, VerdictSettings, verdicts_observed};
use clap::Args;
use serde::{Deserialize, Serialize};
use serde_json::json;

use crate::arguments::{GridArgs, OutputArgs};
use crate::commands::map::{MapArgs, map};
use crate::commands::start::{STARTS, Start};
use crate::context::Context;
use crate::failure::Failure;
use crate::grid::{self, GridJob};
use crate::output::report::{Report, provenance, value};
use crate::output::table::{Cell, Table};
use crate::pictures;
use crate::range::Range;

/// What stands at the end of the help.
const AFTER: &str = "\
A verdict says what the orbit from the start does for good, with its evidence: rest, a cycle with rest, a period that is
proved by Newton's method, chaos by an exponent three standard errors above zero, or undecided. A range of restitutions
makes a map of regimes, a row for each. On the terminal a map is a count of its verdicts. See
docs/studying-the-dynamics.md.

Examples:
  bouncing-disk verdicts --axial-forcing 0.3:0.6:7
  bouncing-disk verdicts --axial-forcing 0:3:300 --restitution 0:0.95:200 --impacts 2000 --transient 1000 --out map.png
  bouncing-disk verdicts --axial-forcing 0:3:20000 --restitution 0:0.95:20000 --chunk 17/500 --out part-17.json";

/// Forcings unless given.
const FORCINGS: (f64, f64, usize) = (0.30, 0.62, 33);

/// Orbits that are followed together.
const TOGETHER: usize = 4_096;

/// Verdicts on what the disk does for good, over forcing and restitution
#[derive(Debug, Args)]
#[command(after_help = AFTER)]
pub(crate) struct VerdictsArgs {
    #[command(flatten)]
    map: MapArgs,
    #[arg(long, value_name = "START", default_value_t = Start::Rise, help = format!("How each orbit starts: {STARTS}"))]
    start: Start,
    /// Impacts before the exponent is measured
    #[arg(long, value_name = "N", default_value_t = VerdictSettings::default().transient)]
    transient: u64,
    /// Impacts that the exponent is measured over, at least 64
    #[arg(long, value_name = "N", default_value_t = VerdictSettings::default().impacts)]
    impacts: u64,
    /// The longest period that is looked for, in impacts, at most 4096
    #[arg(long, value_name = "N", default_value_t = VerdictSettings::default().longest_period)]
    longest_period: usize,
    /// How near an impact must come to an earlier one for a period to be tried, in (0, 0.01]
    #[arg(long, value_name = "T", default_value_t = VerdictSettings::default().tolerance)]
    tolerance: f64,
    #[command(flatten)]
    grid: GridArgs,
    #[command(flatten)]
    output: OutputArgs,
}

/// Runs the command.
pub(crate) fn run(args: &VerdictsArgs, context: Context) -> Result<(), Failure> {
    if args.map.wrote_template()? {
        return Ok(());
    }
    let (first, last, count) = FORCINGS;
    let values = args.map.values(Range::new(first, last, count).map_err(Failure::usage)?)?;
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
    };
    grid::run(job, &args.grid, &args.output, context)
}

/// What verdicts depend on.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct VerdictsJob {
    axial_forcings: Range,
    restitutions: Range,
    start: Start,
    settings: VerdictSettings,
}

/// The kind of a verdict, as files and pictures have it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    AtRest,
    ExactCycle,
    LongCycle,
    PeriodOne,
    PeriodTwo,
    PeriodThree,
    LongerPeriod,
    Chaotic,
    Undecided,
    /// There is no such start.
    NoStart,
}

impl Kind {
    pub(crate) const ALL: [Self; 10] = [
        Self::AtRest,
        Self::ExactCycle,
        Self::LongCycle,
        Self::PeriodOne,
        Self::PeriodTwo,
        Self::PeriodThree,
        Self::LongerPeriod,
        Self::Chaotic,
        Self::Undecided,
        Self::NoStart,
    ];

    pub(crate) fn of(verdict: Option<&Verdict>) -> Self {
        match verdict {
            None => Self::NoStart,
            Some(Verdict::AtRest { .. }) => Self::AtRest,
            Some(Verdict::Chattering { cycle, .. }) if cycle.is_exact() => Self::ExactCycle,
            Some(Verdict::Chattering { .. }) => Self::LongCycle,
            Some(Verdict::Periodic { impacts: 1, .. }) => Self::PeriodOne,
            Some(Verdict::Periodic { impacts: 2, .. }) => Self::PeriodTwo,
            Some(Verdict::Periodic { impacts: 3, .. }) => Self::PeriodThree,
            Some(Verdict::Periodic { .. }) => Self::LongerPeriod,
            Some(Verdict::Chaotic { .. }) => Self::Chaotic,
            Some(_) => Self::Undecided,
        }
    }

    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::AtRest => "at rest",
            Self::ExactCycle => "cycle with rest",
            Self::LongCycle => "cycle with rest, chosen by rounding",
            Self::PeriodOne => "period 1",
            Self::PeriodTwo => "period 2",
            Self::PeriodThree => "period 3",
            Self::LongerPeriod => "period 4 or longer",
            Self::Chaotic => "chaotic",
            Self::Undecided => "undecided",
            Self::NoStart => "no such start",
        }
    }
}

impl GridJob for VerdictsJob {
    const COMMAND: &'static str = "verdicts";

    /// The verdicts of one restitution over all forcings; where there are several forcings and one restitution, a row is a
    /// forcing. `None` where there is no such start.
    type Row = Vec<Option<Verdict>>;

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
        Ok(())
    }

    fn compute(
        &self,
        (): &(),
        rows: Rows<usize>,
        observer: &dyn Observer,
    ) -> Result<Vec<Self::Row>, Failure> {
        let columns = self.columns();
        let mut starts = Vec::new();
        let mut has_start = Vec::new();
        for row in rows {
            for column in 0..columns {
                let (forcing, restitution) = self.cell(row, column);
                let map = map(forcing, restitution)?;
                let state = self.start.of(&map)?;
                has_start.push(state.is_some());
                starts.extend(state.map(|state| (map, state)));
            }
        }
        let mut found = verdicts_observed(&starts, self.settings, observer)?.into_iter();
        let cells: Vec<Option<Verdict>> =
            has_start.into_iter().map(|there| if there { found.next() } else { None }).collect();
        Ok(cells.chunks(columns).map(<[_]>::to_vec).collect())
    }

    fn report(self, (): (), rows: Vec<Self::Row>) -> Result<Report, Failure> {
        let cells: Vec<(f64, f64, Option<Verdict>)> = rows
            .into_iter()
            .enumerate()
            .flat_map(|(row, cells)| {
                cells.into_iter().enumerate().map(move |(column, cell)| (row, column, cell))
            })
            .map(|(row, column, verdict)| {
                let (forcing, restitution) = self.cell(row, column);
                (forcing, restitution, verdict)
            })
            .collect();
        let data = cells
            .iter()
            .map(|(forcing, restitution, verdict)| {
                Ok(json!({ "axial_forcing": forcing, "restitution": restitution, "verdict": value(verdict)? }))
            })
            .collect::<Result<Vec<_>, Failure>>()?;
        let kinds: Vec<Kind> = cells.iter().map(|(.., verdict)| Kind::of(verdict.as_ref())).collect();
        let text = if self.is_map() { counted(&kinds) } else { listed(&cells) };
        let provenance =
            provenance("bouncing-disk verdicts", &self)?.with_chatter_policy(ChatterPolicy::Complete);
        let (forcings, restitutions) = (self.axial_forcings, self.restitutions);
        Ok(Report {
            provenance,
            text,
            table: table(&cells),
            data: vec![("cells", data.into())],
            figure: Some(Box::new(move || pictures::regimes::draw(forcings, restitutions, &kinds))),
        })
    }
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

fn listed(cells: &[(f64, f64, Option<Verdict>)]) -> String {
    let mut table = Table::new(&[("axial_forcing", "1"), ("verdict", "1")]);
    for (forcing, _, verdict) in cells {
        let words = verdict.map_or(Kind::NoStart.name().to_owned(), |verdict| verdict.to_string());
        table.push([(*forcing).into(), words.into()]);
    }
    table.to_text()
}

/// How many cells there are of each kind that there is.
fn counted(kinds: &[Kind]) -> String {
    let mut table = Table::new(&[("verdict", "1"), ("cells", "1"), ("share", "%")]);
    for kind in Kind::ALL {
        let count = kinds.iter().filter(|own| **own == kind).count();
        if count > 0 {
            table.push([
                kind.name().into(),
                count.into(),
                (100.0 * count as f64 / kinds.len() as f64).into(),
            ]);
        }
    }
    table.to_text()
}

fn table(cells: &[(f64, f64, Option<Verdict>)]) -> Table {
    let mut table = Table::new(&[
        ("axial_forcing", "1"),
        ("restitution", "1"),
        ("verdict", "1"),
        ("impacts", "1"),
        ("platform_periods", "1"),
        ("spectral_radius", "1"),
        ("exponent", "1"),
        ("exponent_error", "1"),
        ("words", "1"),
    ]);
    for (forcing, restitution, verdict) in cells {
        let mut row: Vec<Cell> =
            vec![(*forcing).into(), (*restitution).into(), Kind::of(verdict.as_ref()).name().into()];
        row.extend(match verdict {
            Some(Verdict::Periodic { impacts, platform_periods, multipliers, .. }) => [
                (*impacts).into(),
                (*platform_periods).into(),
                multipliers.spectral_radius().into(),
                Cell::Nothing,
                Cell::Nothing,
            ],
            Some(Verdict::Chaotic { exponent, standard_error, .. }) => {
                [Cell::Nothing, Cell::Nothing, Cell::Nothing, (*exponent).into(), (*standard_error).into()]
            }
            Some(Verdict::Chattering { cycle, .. }) => {
                let counts = [cycle.impacts, cycle.platform_periods].map(Cell::from);
                let [impacts, periods] = counts;
                [impacts, periods, Cell::Nothing, Cell::Nothing, Cell::Nothing]
            }
            _ => [const { Cell::Nothing }; 5],
        });
        row.push(verdict.map(|verdict| verdict.to_string()).into());
        table.push(row);
    }
    table
}
