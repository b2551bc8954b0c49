//! `bouncing-disk verdicts`: the long-term motion of the disk, over the forcing, or over forcing and
//! restitution.

use bouncing_disk::Observer;
use bouncing_disk::core::{
    ChatterPolicy,
    attractors::{MAX_CELLS, Verdict, VerdictSettings, each_verdict},
};
use bouncing_disk::parameters::Waveform;
use serde::{Deserialize, Serialize};

use super::map::{
    ContactArgs, MapArgs, NO_PERIOD_ONE, STARTS, Start, VERTICAL, driven_map, is_rigid_sine, is_sine, map,
};
use super::prelude::*;

const FORCINGS: &str = "0.30:0.62:33";

/// Largest number of cells that keep their evidence.
const MOST_DETAILED: u64 = 1 << 24;

/// Bytes of a cell while the result is made, with its evidence and without.
const DETAILED: u64 = 2 * size_of::<Option<Verdict>>() as u64;
const PLAIN: u64 = 4;

/// Verdicts on the long-term motion of the disk, over forcing and restitution
#[derive(Debug, Args)]
#[command(after_help = "\
A verdict names the long-term motion from the start, with its evidence: rest; a cycle with rest; a period proved by \
Newton's method; chaos, if perturbations grow over --impacts impacts faster than in neutral motion by more than the \
error; or undecided. A range of restitutions makes a map of regimes, with a row for each restitution. The terminal \
shows the number of each verdict in a map. See docs/studying-the-dynamics.md.

Examples:
  bouncing-disk verdicts --axial-forcing 0.3:0.6:7
  bouncing-disk verdicts -G 0.3:1:15 --contact-periods 0.1
  bouncing-disk verdicts -G 0:3:300 -r 0:0.95:200 --impacts 20000 --out map.png
  bouncing-disk verdicts -G 0:3:4000 -r 0:0.95:4000 --chunk 17/500 --out part-17.json")]
pub(crate) struct VerdictsArgs {
    /// Axial forcing parameter Gamma = A omega^2/(pi g): a number, or a range FIRST:LAST:POINTS, both ends
    /// included. Taken from FILE, --preset or --set unless given; without these 0.30:0.62:33
    #[arg(help_heading = VERTICAL, long, short = 'G', value_name = "GAMMA", allow_hyphen_values = true)]
    axial_forcing: Option<Range>,
    #[command(flatten)]
    map: MapArgs,
    #[command(flatten)]
    contact: ContactArgs,
    #[arg(help_heading = OWN, long, allow_hyphen_values = true, value_name = "START", default_value_t = Start::Rise, help = format!("How each orbit starts: {STARTS}"))]
    start: Start,
    /// Impacts before the exponent is measured
    #[arg(help_heading = OWN, long, allow_negative_numbers = true, value_name = "N", default_value_t = VerdictSettings::default().transient)]
    transient: u64,
    /// Impacts over which the exponent is measured, at least 64
    #[arg(help_heading = OWN, long, allow_negative_numbers = true, value_name = "N", default_value_t = VerdictSettings::default().impacts)]
    impacts: u64,
    /// The longest period to find, in impacts, at most 4096
    #[arg(help_heading = OWN, long, allow_negative_numbers = true, value_name = "N", default_value_t = VerdictSettings::default().longest_period)]
    longest_period: usize,
    /// Distance of an impact from an earlier one below which a period is tried, in (0, 0.01]
    #[arg(help_heading = OWN, long, allow_hyphen_values = true, value_name = "T", default_value_t = VerdictSettings::default().tolerance)]
    tolerance: f64,
    /// Keeps the evidence of each cell of a map, which makes the file a hundred times larger; without a
    /// range of restitutions it is always kept
    #[arg(help_heading = OWN, long)]
    details: bool,
    #[command(flatten)]
    grid: GridArgs,
    #[command(flatten)]
    output: OutputArgs,
}

pub(super) fn run(args: &VerdictsArgs, context: Context) -> Result<()> {
    let given = args.map.begin(&args.output, Some(&args.grid), context)?;
    let Some((system, drive)) = given else { return Ok(()) };
    let contact_periods = args.contact.contact_periods;
    if args.start == Start::PeriodOne && !is_rigid_sine(&drive, contact_periods) {
        return Err(Failure::Usage(NO_PERIOD_ONE.to_owned()));
    }
    let otherwise = FORCINGS.parse().map_err(Failure::Usage)?;
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
        drive,
        contact_periods,
    };
    grid::run(job, &args.grid, &args.output, context)
}

#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct VerdictsJob {
    axial_forcings: Range,
    restitutions: Range,
    start: Start,
    settings: VerdictSettings,
    /// Whether the evidence is kept, or only the kinds.
    details: bool,
    /// The shape of the height.
    #[serde(default, skip_serializing_if = "is_sine")]
    drive: Waveform,
    /// How long an impact lasts (periods).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    contact_periods: Option<f64>,
}

impl GridJob for VerdictsJob {
    const COMMAND: &'static str = "verdicts";

    /// In a map one restitution over all forcings, else one forcing.
    type Row = Row;

    type Prepared = ();

    fn rows(&self) -> usize {
        if self.is_map() { self.restitutions.count() } else { self.axial_forcings.count() }
    }

    fn prepare(&self, _: &dyn Observer) -> Result<()> {
        self.settings.check()?;
        let ((low, high), (least, largest)) = (self.axial_forcings.ends(), self.restitutions.ends());
        for (forcing, restitution) in [(low, least), (high, largest)] {
            map(forcing, restitution)?;
            driven_map(&self.drive, self.contact_periods, forcing, restitution)?;
        }
        let cells = (self.rows() as u64).saturating_mul(self.columns() as u64);
        if self.details {
            grid::check_room("verdicts with their evidence", cells, MOST_DETAILED, DETAILED)
        } else {
            grid::check_room("cells of a map of verdicts", cells, MAX_CELLS, PLAIN)
        }
    }

    fn compute(&self, (): &(), rows: Rows, observer: &dyn Observer) -> Result<Vec<Self::Row>> {
        let columns = self.columns();
        let cell = |index: usize| self.cell(rows.start + index / columns, index % columns);
        let (mut all, mut seen) = (Vec::new(), 0_usize);
        let each = |cell: Option<Verdict>| {
            if seen.is_multiple_of(columns) {
                all.push(if self.details { Row::Verdicts(Vec::new()) } else { Row::Kinds(String::new()) });
            }
            seen += 1;
            match all.last_mut() {
                Some(Row::Verdicts(row)) => row.push(cell),
                Some(Row::Kinds(row)) => row.push(char::from(b'0' + kind(cell.as_ref()))),
                None => {}
            }
        };
        let count = rows.len() * columns;
        if is_rigid_sine(&self.drive, self.contact_periods) {
            let start = |index: usize| {
                let (forcing, restitution) = cell(index);
                let map = map(forcing, restitution)?;
                Ok::<_, Failure>(self.start.of(&map, 0.0)?.map(|state| (map, state)))
            };
            each_verdict(count, start, self.settings, observer, each)?;
        } else {
            let start = |index: usize| {
                let (forcing, restitution) = cell(index);
                let own = driven_map(&self.drive, self.contact_periods, forcing, restitution)?;
                let state = self.start.of(&map(forcing, restitution)?, own.drive().fastest_rise_phase())?;
                Ok::<_, Failure>(state.map(|state| (own, state)))
            };
            each_verdict(count, start, self.settings, observer, each)?;
        }
        Ok(all)
    }

    fn report<'a>(&'a self, (): &'a (), rows: &'a [Row]) -> Result<Report<'a>> {
        let columns = self.columns();
        if let Some(row) = rows.iter().position(|row| !row.is_whole(columns, self.details)) {
            return Err(Failure::Usage(format!("row {} does not have {columns} verdicts", row + 1)));
        }
        let found = Found { job: self, rows };
        let mut data = vec![("kinds", stored(&KINDS)?)];
        if self.details {
            let listed = move || {
                found.cells().map(|(forcing, restitution, _, verdict)| {
                    json!({ "axial_forcing": forcing, "restitution": restitution, "verdict": verdict })
                })
            };
            data.push(("cells", json::list(listed)));
        } else {
            data.push(("kinds_by_restitution", stored(rows)?));
        }
        let figure = move || {
            let regimes = pictures::Regimes {
                axial_forcings: self.axial_forcings.cell_ends(0.01),
                restitutions: self.restitutions.cell_ends(1.0),
                only: self.restitutions.only(),
                rows: self.restitutions.count(),
                cells: &found.kinds().collect::<Vec<_>>(),
            };
            regimes.draw()
        };
        Ok(Report {
            provenance: provenance("bouncing-disk verdicts", self)?
                .with_chatter_policy(ChatterPolicy::Complete),
            text: found.text(),
            table: Box::new(move |to| found.columns().write_csv(to, found.cells())),
            data,
            figure: Some(Box::new(figure)),
        })
    }
}

/// A row as kept and stored: one byte per cell in a map without details, about a hundred with them.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(untagged)]
pub(crate) enum Row {
    /// The digits of the kinds, by their places in [`KINDS`].
    Kinds(String),
    /// `None` if there is no such start.
    Verdicts(Vec<Option<Verdict>>),
}

impl Row {
    /// Whether it has this many cells, with or without their evidence.
    fn is_whole(&self, columns: usize, details: bool) -> bool {
        match self {
            Self::Kinds(kinds) => {
                !details && kinds.len() == columns && kinds.bytes().all(|kind| kind.is_ascii_digit())
            }
            Self::Verdicts(cells) => details && cells.len() == columns,
        }
    }

    /// The kind of a cell, and its evidence if kept.
    fn cell(&self, column: usize) -> (u8, Option<Verdict>) {
        match self {
            Self::Kinds(kinds) => (kinds.as_bytes()[column] - b'0', None),
            Self::Verdicts(cells) => (kind(cells[column].as_ref()), cells[column]),
        }
    }
}

impl VerdictsJob {
    fn is_map(&self) -> bool {
        self.restitutions.count() > 1
    }

    fn columns(&self) -> usize {
        if self.is_map() { self.axial_forcings.count() } else { 1 }
    }

    fn cell(&self, row: usize, column: usize) -> (f64, f64) {
        if self.is_map() {
            (self.axial_forcings.value(column), self.restitutions.value(row))
        } else {
            (self.axial_forcings.value(row), self.restitutions.value(0))
        }
    }
}

/// Forcing and restitution of a cell, its verdict, and the evidence if kept.
type Cell = (f64, f64, u8, Option<Verdict>);

/// The verdicts, cell by cell in the order of the rows.
#[derive(Clone, Copy)]
struct Found<'a> {
    job: &'a VerdictsJob,
    rows: &'a [Row],
}

impl<'a> Found<'a> {
    fn cells(self) -> impl Iterator<Item = Cell> + 'a {
        let columns = self.job.columns();
        (0..self.rows.len() * columns).map(move |index| {
            let (row, column) = (index / columns, index % columns);
            let (forcing, restitution) = self.job.cell(row, column);
            let (kind, verdict) = self.rows[row].cell(column);
            (forcing, restitution, kind, verdict)
        })
    }

    fn kinds(self) -> impl Iterator<Item = u8> + 'a {
        self.cells().map(|cell| cell.2)
    }

    /// The text: for a map the number of cells of each kind, else each verdict in words.
    fn text(self) -> String {
        if !self.job.is_map() {
            let columns = Columns::<Cell>::new().column("axial_forcing", "1", |row| row.0);
            let columns = columns.column("verdict", "1", |row| {
                row.3.map_or(KINDS[usize::from(row.2)].to_owned(), |verdict| verdict.to_string())
            });
            return columns.to_text(self.cells());
        }
        let mut counts = [0_usize; KINDS.len()];
        self.kinds().for_each(|kind| counts[usize::from(kind)] += 1);
        let all: usize = counts.iter().sum();
        let columns = Columns::<(&str, usize)>::new()
            .column("verdict", "1", |row| row.0)
            .column("cells", "1", |row| row.1)
            .column("share", "%", move |row| 100.0 * row.1 as f64 / all as f64);
        let there = KINDS.into_iter().zip(counts).filter(|(_, count)| *count > 0);
        columns.to_text(there)
    }

    /// The columns of a file: each cell is a row, with its details if any.
    fn columns(self) -> Columns<Cell> {
        let plain = Columns::<Cell>::new()
            .column("axial_forcing", "1", |row| row.0)
            .column("restitution", "1", |row| row.1)
            .column("verdict", "1", |row| KINDS[usize::from(row.2)]);
        if !self.job.details {
            return plain;
        }
        // Impacts and periods of the platform of a cycle; the spectral radius; an exponent and its error.
        let cycle = |row: &Cell| match row.3? {
            Verdict::Periodic { impacts, platform_periods, .. } => Some((impacts, platform_periods)),
            Verdict::Chattering { cycle, .. } => Some((cycle.impacts, cycle.platform_periods)),
            _ => None,
        };
        let radius = |row: &Cell| match row.3? {
            Verdict::Periodic { multipliers, .. } => Some(multipliers.spectral_radius()),
            _ => None,
        };
        let exponent = |row: &Cell| match row.3? {
            Verdict::Chaotic { exponent, standard_error, .. } => Some((exponent, standard_error)),
            _ => None,
        };
        plain
            .column("impacts", "1", move |row| cycle(row).map(|own| own.0))
            .column("platform_periods", "1", move |row| cycle(row).map(|own| own.1))
            .column("spectral_radius", "1", radius)
            .column("exponent", "per impact", move |row| exponent(row).map(|own| own.0))
            .column("exponent_error", "per impact", move |row| exponent(row).map(|own| own.1))
            .column("words", "1", |row| row.3.map(|verdict| verdict.to_string()))
    }
}

/// The kinds of motion that the disk settles on, without the evidence; their places match the
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

/// The place in [`KINDS`], which is a digit.
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kinds_have_a_digit_each() {
        for kind in 0..KINDS.len() as u8 {
            let row = Row::Kinds(char::from(b'0' + kind).to_string());
            assert!(row.is_whole(1, false) && !row.is_whole(2, false) && !row.is_whole(1, true));
            assert_eq!(row.cell(0).0, kind);
        }
        for letter in [":", "/", "a"] {
            assert!(!Row::Kinds(letter.to_owned()).is_whole(1, false), "{letter}");
        }
        assert_eq!(KINDS.len(), pictures::REGIMES.len());
    }
}
