//! `bouncing-disk verdicts`: what the disk does for good, over the forcing, or over forcing and restitution.

use std::ops::Range as Rows;
use std::rc::Rc;

use bouncing_disk::Observer;
use bouncing_disk::core::{ChatterPolicy, Verdict, VerdictSettings, verdicts_observed};
use clap::Args;
use serde::{Deserialize, Serialize};
use serde_json::json;

use crate::arguments::{GridArgs, OWN, OutputArgs};
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
A verdict says what the orbit from the start does for good, with its evidence: rest, a cycle with rest, a period that is \
proved by Newton's method, chaos by an exponent three standard errors above zero, or undecided. A range of restitutions \
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

/// Verdicts on what the disk does for good, over forcing and restitution
#[derive(Debug, Args)]
#[command(after_help = AFTER)]
pub(crate) struct VerdictsArgs {
    #[command(flatten)]
    map: MapArgs,
    #[arg(help_heading = OWN, long, value_name = "START", default_value_t = Start::Rise, help = format!("How each orbit starts: {STARTS}"))]
    start: Start,
    /// Impacts before the exponent is measured
    #[arg(help_heading = OWN, long, value_name = "N", default_value_t = VerdictSettings::default().transient)]
    transient: u64,
    /// Impacts that the exponent is measured over, at least 64
    #[arg(help_heading = OWN, long, value_name = "N", default_value_t = VerdictSettings::default().impacts)]
    impacts: u64,
    /// The longest period that is looked for, in impacts, at most 4096
    #[arg(help_heading = OWN, long, value_name = "N", default_value_t = VerdictSettings::default().longest_period)]
    longest_period: usize,
    /// How near an impact must come to an earlier one for a period to be tried, in (0, 0.01]
    #[arg(help_heading = OWN, long, allow_negative_numbers = true, value_name = "T", default_value_t = VerdictSettings::default().tolerance)]
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
        details: args.details || values.restitutions.count() == 1,
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
    /// Whether the evidence is kept, or the kinds alone.
    details: bool,
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

    /// Its place in [`Self::ALL`], as a letter.
    fn digit(self) -> char {
        char::from(b'0' + self as u8)
    }

    fn of_digit(letter: char) -> Option<Self> {
        Self::ALL.get(letter.to_digit(10)? as usize).copied()
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
        let kind = |cell: &Option<Verdict>| Kind::of(cell.as_ref()).digit();
        Ok(cells
            .chunks(columns)
            .map(|row| {
                if self.details {
                    Row::Verdicts(row.to_vec())
                } else {
                    Row::Kinds(row.iter().map(kind).collect())
                }
            })
            .collect())
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
        let mut data = vec![("kinds", value(&Kind::ALL.map(Kind::name))?)];
        if self.details {
            let cells = verdicts.iter().enumerate().map(|(index, verdict)| {
                let (forcing, restitution) = self.cell(index / self.columns(), index % self.columns());
                Ok(json!({ "axial_forcing": forcing, "restitution": restitution, "verdict": value(verdict)? }))
            });
            data.push(("cells", cells.collect::<Result<Vec<_>, Failure>>()?.into()));
        } else {
            data.push(("kinds_by_restitution", value(&digits)?));
        }
        let text = if self.is_map() { counted(&kinds) } else { self.listed(&verdicts) };
        let provenance =
            provenance("bouncing-disk verdicts", &self)?.with_chatter_policy(ChatterPolicy::Complete);
        let kinds: Rc<[Kind]> = kinds.into();
        let (forcings, restitutions) = (self.axial_forcings, self.restitutions);
        let drawn = Rc::clone(&kinds);
        Ok(Report {
            provenance,
            text,
            table: Box::new(move || self.table(&kinds, &verdicts)),
            data,
            figure: Some(Box::new(move || pictures::regimes::draw(forcings, restitutions, &drawn))),
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

    /// The verdicts in words.
    fn listed(&self, verdicts: &[Option<Verdict>]) -> String {
        let mut table = Table::new(&[("axial_forcing", "1"), ("verdict", "1")]);
        for (forcing, verdict) in self.axial_forcings.values().zip(verdicts) {
            let words = verdict.map_or(Kind::NoStart.name().to_owned(), |verdict| verdict.to_string());
            table.push([forcing.into(), words.into()]);
        }
        table.to_text()
    }

    /// Each cell a row, with the details where there are any.
    fn table(&self, kinds: &[Kind], verdicts: &[Option<Verdict>]) -> Table {
        let plain = [("axial_forcing", "1"), ("restitution", "1"), ("verdict", "1")];
        let details = [
            ("impacts", "1"),
            ("platform_periods", "1"),
            ("spectral_radius", "1"),
            ("exponent", "1"),
            ("exponent_error", "1"),
            ("words", "1"),
        ];
        let columns = if self.details { [&plain[..], &details[..]].concat() } else { plain.to_vec() };
        let mut table = Table::new(&columns);
        for (index, kind) in kinds.iter().enumerate() {
            let (forcing, restitution) = self.cell(index / self.columns(), index % self.columns());
            let mut row: Vec<Cell> = vec![forcing.into(), restitution.into(), kind.name().into()];
            row.extend(verdicts.get(index).copied().flatten().map(detailed).into_iter().flatten());
            table.push(row);
        }
        table
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

/// Impacts, periods of the platform, spectral radius, exponent and its error, and all in words.
fn detailed(verdict: Verdict) -> [Cell; 6] {
    let [impacts, periods, radius, exponent, error] = match verdict {
        Verdict::Periodic { impacts, platform_periods, multipliers, .. } => {
            let radius = multipliers.spectral_radius();
            [impacts.into(), platform_periods.into(), radius.into(), Cell::Nothing, Cell::Nothing]
        }
        Verdict::Chaotic { exponent, standard_error, .. } => {
            [Cell::Nothing, Cell::Nothing, Cell::Nothing, exponent.into(), standard_error.into()]
        }
        Verdict::Chattering { cycle, .. } => {
            [cycle.impacts.into(), cycle.platform_periods.into(), Cell::Nothing, Cell::Nothing, Cell::Nothing]
        }
        _ => [const { Cell::Nothing }; 5],
    };
    [impacts, periods, radius, exponent, error, verdict.to_string().into()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kinds_have_a_digit_each() {
        for kind in Kind::ALL {
            assert_eq!(Kind::of_digit(kind.digit()), Some(kind));
        }
        assert_eq!([':', '/', 'a'].map(Kind::of_digit), [None; 3]);
    }
}
