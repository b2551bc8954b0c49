//! `bouncing-disk verdicts`: the long-term motion of the disk, over the forcing, or over forcing and
//! restitution.

use std::io::Write;
use std::ops::Range as Rows;
use std::rc::Rc;

use bouncing_disk::Observer;
use bouncing_disk::core::{
    ChatterPolicy,
    attractors::{MAX_CELLS, Verdict, VerdictSettings, each_verdict},
};
use serde::{Deserialize, Serialize};

use super::map::{MapArgs, VERTICAL, map};
use super::prelude::*;
use super::start::{STARTS, Start};
use crate::output::json::Data;

/// Forcings unless given.
const FORCINGS: &str = "0.30:0.62:33";

/// Orbits that are followed together.
const TOGETHER: usize = 4_096;

/// Most cells that keep their evidence.
const MOST_DETAILED: u64 = 1 << 24;

/// Bytes of a cell while the result is made, with its evidence and without.
const DETAILED: u64 = 2 * size_of::<Option<Verdict>>() as u64;
const PLAIN: u64 = 4;

/// Verdicts on what the disk does for good, over forcing and restitution
#[derive(Debug, Args)]
#[command(after_help = "\
A verdict says what the orbit from the start does for good, with its evidence: rest, a cycle with rest, a period that is \
proved by Newton's method, chaos by growth that neither neutral motion nor the error explains, or undecided. A range of restitutions \
makes a map of regimes, a row for each. On the terminal a map is a count of its verdicts. See \
docs/studying-the-dynamics.md.

Examples:
  bouncing-disk verdicts --axial-forcing 0.3:0.6:7
  bouncing-disk verdicts -G 0:3:300 -r 0:0.95:200 --impacts 2000 --out map.png
  bouncing-disk verdicts -G 0:3:4000 -r 0:0.95:4000 --chunk 17/500 --out part-17.json")]
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
pub(super) fn run(args: &VerdictsArgs, context: Context) -> Result<(), Failure> {
    let Some(system) = args.map.system.unless_template(&args.output, context)? else { return Ok(()) };
    let otherwise = FORCINGS.parse().map_err(Failure::usage)?;
    let (axial_forcings, restitutions) = args.map.values(&system, args.axial_forcing, otherwise);
    let job = VerdictsJob {
        axial_forcings,
        restitutions,
        start: args.start,
        settings: VerdictSettings {
            transient: args.transient,
            impacts: args.impacts,
            longest_period: args.longest_period,
            tolerance: args.tolerance,
        },
        details: args.details || restitutions.count() == 1,
    };
    grid::run(job, &args.map.system.inputs(), &args.grid, &args.output, context)
}

/// The inputs of verdicts.
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
                Some(Row::Kinds(row)) => row.push(digit(kind(cell.as_ref()))),
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
                    kinds.extend(cells.iter().map(|cell| kind(cell.as_ref())));
                    verdicts.extend(cells);
                }
                Row::Kinds(row) => {
                    kinds.extend(row.chars().filter_map(of_digit));
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
        let mut data = vec![("kinds", stored(&KINDS)?)];
        if !self.details {
            data.push(("kinds_by_restitution", stored(&digits)?));
        }
        let found = Rc::new(Found { job: self, kinds, verdicts });
        if self.details {
            let listed = Rc::clone(&found);
            let cell = move |index| {
                let (forcing, restitution) = listed.place(index);
                let verdict = serde_json::to_value(listed.verdicts.get(index))?;
                Ok(json!({ "axial_forcing": forcing, "restitution": restitution, "verdict": verdict }))
            };
            data.push(("cells", Data::list(found.kinds.len(), cell)));
        }
        let (text, drawn) = (found.text(), Rc::clone(&found));
        let figure = move || {
            let regimes = pictures::Regimes {
                axial_forcings: self.axial_forcings.cell_ends(0.01),
                restitutions: self.restitutions.cell_ends(1.0),
                only: self.restitutions.only(),
                rows: self.restitutions.count(),
                cells: &drawn.kinds,
            };
            regimes.draw()
        };
        let table = move |to: &mut dyn Write| {
            let columns = found.columns();
            columns.write_csv(to, (0..found.kinds.len()).map(|index| found.row(index)))
        };
        Ok(Report { provenance, text, table: Box::new(table), data, figure: Some(Box::new(figure)) })
    }
}

/// A row as it is kept and stored. A map without details takes a byte a cell; with them some hundred.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(untagged)]
pub(crate) enum Row {
    /// The digits of the kinds, by their places in [`KINDS`].
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

/// The verdicts, cell by cell in the order of the rows.
struct Found {
    job: VerdictsJob,
    kinds: Vec<u8>,
    /// Of each cell, where the job keeps the evidence; else none at all.
    verdicts: Vec<Option<Verdict>>,
}

/// Forcing and restitution of a cell, what the disk does there, and the evidence where it is kept.
type Cell = (f64, f64, u8, Option<Verdict>);

impl Found {
    /// Forcing and restitution of a cell.
    fn place(&self, index: usize) -> (f64, f64) {
        self.job.cell(index / self.job.columns(), index % self.job.columns())
    }

    fn row(&self, index: usize) -> Cell {
        let (forcing, restitution) = self.place(index);
        (forcing, restitution, self.kinds[index], self.verdicts.get(index).copied().flatten())
    }

    /// The text: for a map the number of cells of each kind that occurs, else each verdict in words.
    fn text(&self) -> String {
        if !self.job.is_map() {
            let columns = Columns::<Cell>::new().column("axial_forcing", "1", |row| row.0);
            let columns = columns.column("verdict", "1", |row| {
                row.3.map_or(name(row.2).to_owned(), |verdict| verdict.to_string())
            });
            return columns.to_text(&(0..self.kinds.len()).map(|index| self.row(index)).collect::<Vec<_>>());
        }
        let all = self.kinds.len() as f64;
        let columns = Columns::<(&str, usize)>::new()
            .column("verdict", "1", |row| row.0)
            .column("cells", "1", |row| row.1)
            .column("share", "%", move |row| 100.0 * row.1 as f64 / all);
        let count = |(kind, name)| (name, self.kinds.iter().filter(|own| **own == kind).count());
        let there = (0..).zip(KINDS).map(count).filter(|(_, count)| *count > 0);
        columns.to_text(&there.collect::<Vec<_>>())
    }

    /// The columns of a file: each cell is a row, with the details where there are any.
    fn columns(&self) -> Columns<Cell> {
        let plain = Columns::<Cell>::new()
            .column("axial_forcing", "1", |row| row.0)
            .column("restitution", "1", |row| row.1)
            .column("verdict", "1", |row| name(row.2));
        if !self.job.details {
            return plain;
        }
        plain
            .column("impacts", "1", |row| match row.3? {
                Verdict::Periodic { impacts, .. } => Some(impacts),
                Verdict::Chattering { cycle, .. } => Some(cycle.impacts),
                _ => None,
            })
            .column("platform_periods", "1", |row| match row.3? {
                Verdict::Periodic { platform_periods, .. } => Some(platform_periods),
                Verdict::Chattering { cycle, .. } => Some(cycle.platform_periods),
                _ => None,
            })
            .column("spectral_radius", "1", |row| match row.3? {
                Verdict::Periodic { multipliers, .. } => Some(multipliers.spectral_radius()),
                _ => None,
            })
            .column("exponent", "per impact", |row| match row.3? {
                Verdict::Chaotic { exponent, .. } => Some(exponent),
                _ => None,
            })
            .column("exponent_error", "per impact", |row| match row.3? {
                Verdict::Chaotic { standard_error, .. } => Some(standard_error),
                _ => None,
            })
            .column("words", "1", |row| row.3.map(|verdict| verdict.to_string()))
    }
}

/// The kinds of motion that the disk settles on, without the evidence; their places are those of the
/// picture's [`REGIMES`](pictures::REGIMES).
const KINDS: [&str; 10] = [
    "at rest",
    "cycle with rest",
    "cycle with rest, chosen by rounding",
    "period 1",
    "period 2",
    "period 3",
    "period 4 or longer",
    "chaotic",
    "undecided",
    "no such start",
];

/// The place in [`KINDS`].
fn kind(verdict: Option<&Verdict>) -> u8 {
    match verdict {
        Some(Verdict::AtRest { .. }) => 0,
        Some(Verdict::Chattering { cycle, .. }) if cycle.is_exact() => 1,
        Some(Verdict::Chattering { .. }) => 2,
        Some(Verdict::Periodic { impacts, .. }) => 2 + (*impacts).min(4) as u8,
        Some(Verdict::Chaotic { .. }) => 7,
        Some(_) => 8,
        None => 9,
    }
}

/// The name of a kind.
fn name(kind: u8) -> &'static str {
    KINDS[usize::from(kind)]
}

/// A kind as a digit.
fn digit(kind: u8) -> char {
    char::from(b'0' + kind)
}

/// The kind of a digit.
fn of_digit(letter: char) -> Option<u8> {
    letter.to_digit(10).map(|digit| digit as u8)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kinds_have_a_digit_each() {
        for kind in 0..KINDS.len() as u8 {
            assert_eq!(of_digit(digit(kind)), Some(kind));
        }
        assert_eq!([':', '/', 'a'].map(of_digit), [None; 3]);
        assert_eq!(KINDS.len(), pictures::REGIMES.len());
    }
}
