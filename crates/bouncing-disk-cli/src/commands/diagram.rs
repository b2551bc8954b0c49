//! `bouncing-disk diagram`: where the disk lands, as the platform shakes harder.

use std::io::{self, Write};
use std::ops::Range as Rows;
use std::rc::Rc;

use bouncing_disk::Observer;
use bouncing_disk::core::numerics::circular::distinct;
use bouncing_disk::core::numerics::statistics::extent;
use bouncing_disk::core::{ChatterPolicy, ImpactState, MAX_RECORDED, Orbit, orbit_diagram};
use clap::Args;
use serde::{Deserialize, Serialize};
use serde_json::json;

use crate::arguments::{GridArgs, OWN, OutputArgs};
use crate::commands::map::{MapArgs, VERTICAL, map, single};
use crate::commands::start::{STARTS, Start};
use crate::context::Context;
use crate::failure::Failure;
use crate::grid::{self, GridJob};
use crate::output::json::{Data, Elements};
use crate::output::report::{Report, provenance};
use crate::output::table::{self, Csv, Table};
use crate::pictures;
use crate::range::Range;

/// What stands at the end of the help.
const AFTER: &str = "\
Of each forcing a row: the impacts of an orbit after its transient, as Figs. 6(a) and 6(b) of the paper. Phases are in \
periods of the platform (tau_imp/2pi), speeds normalised, |w_A Gamma/(omega A)|. The table on the terminal counts the \
phases that differ by a millionth of a period. See docs/studying-the-dynamics.md.

Examples:
  bouncing-disk diagram --out diagram.png
  bouncing-disk diagram -G 0.45:0.55:1001 --start period-1 --out cascade.csv
  bouncing-disk diagram --chunk 1/10 --out part-1.json";

/// Forcings of the paper's Fig. 6.
const FORCINGS: (f64, f64, usize) = (0.30, 0.62, 641);

/// Orbits that are followed together.
const TOGETHER: usize = 256;

/// An orbit diagram: the impacts for good, over the axial forcing
#[derive(Debug, Args)]
#[command(after_help = AFTER)]
pub(crate) struct DiagramArgs {
    /// Axial forcing parameter Gamma = A omega^2/(pi g): a number, or a range FIRST:LAST:POINTS, both ends
    /// included. That of FILE, --preset or --set unless given; without these 0.30:0.62:641, those of the
    /// paper's Fig. 6
    #[arg(help_heading = VERTICAL, long, short = 'G', value_name = "GAMMA", allow_hyphen_values = true)]
    axial_forcing: Option<Range>,
    #[command(flatten)]
    map: MapArgs,
    #[arg(help_heading = OWN, long, allow_hyphen_values = true, value_name = "START", help = format!("How orbits start: {STARTS}. May be repeated; `rest` and `period-1` unless given"))]
    start: Vec<Start>,
    /// Impacts that are not looked at
    #[arg(help_heading = OWN, long, allow_negative_numbers = true, value_name = "N", default_value_t = 3_000)]
    transient: usize,
    /// Impacts of each orbit that are recorded
    #[arg(help_heading = OWN, long, allow_negative_numbers = true, value_name = "N", default_value_t = 256)]
    recorded: usize,
    #[command(flatten)]
    grid: GridArgs,
    #[command(flatten)]
    output: OutputArgs,
}

/// Runs the command.
pub(crate) fn run(args: &DiagramArgs, context: Context) -> Result<(), Failure> {
    if args.map.wrote_template(&args.output, context)? {
        return Ok(());
    }
    let (first, last, count) = FORCINGS;
    let values =
        args.map.values(args.axial_forcing, Range::new(first, last, count).map_err(Failure::usage)?)?;
    let starts = if args.start.is_empty() { vec![Start::Rest, Start::PeriodOne] } else { args.start.clone() };
    let job = DiagramJob {
        axial_forcings: values.axial_forcings,
        restitution: single(values.restitutions, "--restitution")?,
        starts,
        transient: args.transient,
        recorded: args.recorded,
    };
    grid::run(job, &args.map.inputs(), &args.grid, &args.output, context)
}

/// Phases nearer than this count as one (periods).
const SAME_PHASE: f64 = 1e-6;

/// What an impact takes (bytes): a phase and a speed.
const IMPACT: u64 = 16;

/// What a diagram depends on.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct DiagramJob {
    axial_forcings: Range,
    restitution: f64,
    starts: Vec<Start>,
    transient: usize,
    recorded: usize,
}

/// The impacts of one forcing and one start: phases (periods) and normalised speeds.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Impacts {
    pub(crate) impact_phase_periods: Vec<f64>,
    pub(crate) normalised_impact_speed: Vec<f64>,
}

impl Impacts {
    fn of(states: &[ImpactState]) -> Self {
        Self {
            impact_phase_periods: states.iter().map(|state| state.phase().cycles()).collect(),
            normalised_impact_speed: states.iter().map(ImpactState::normalised_speed).collect(),
        }
    }

    /// How many phases differ by more than a millionth of a period from the next one.
    fn distinct(&self) -> usize {
        distinct(self.impact_phase_periods.iter().copied(), SAME_PHASE)
    }
}

/// The impacts of each start of one forcing; none where it has no such start.
type Column = Vec<Option<Impacts>>;

/// The columns of the diagram, each with its forcing, and the names of the starts.
struct Columns {
    axial_forcings: Range,
    starts: Vec<String>,
    rows: Vec<Column>,
}

impl Columns {
    /// Forcing, place of the start and impacts of all orbits that there are.
    fn orbits(&self) -> impl Iterator<Item = (f64, usize, &Impacts)> {
        self.axial_forcings.values().zip(&self.rows).flat_map(|(forcing, row)| {
            let there = row.iter().enumerate();
            there.filter_map(move |(start, impacts)| Some((forcing, start, impacts.as_ref()?)))
        })
    }

    /// Each impact a row.
    fn write_csv(&self, to: &mut dyn Write) -> io::Result<()> {
        let columns = [
            ("axial_forcing", "1"),
            ("start", "1"),
            ("impact_phase", "periods"),
            ("normalised_impact_speed", "1"),
        ];
        let mut csv = Csv::begin(to, &columns.map(|(name, unit)| table::Column::new(name, unit)))?;
        for (forcing, start, impacts) in self.orbits() {
            let start = &self.starts[start];
            for (phase, speed) in impacts.impact_phase_periods.iter().zip(&impacts.normalised_impact_speed) {
                csv.row(&[forcing.into(), start.as_str().into(), (*phase).into(), (*speed).into()])?;
            }
        }
        Ok(())
    }

    /// Each orbit a line.
    fn write_json(&self, each: &mut Elements<'_>) -> io::Result<()> {
        self.orbits().try_for_each(|(forcing, start, impacts)| {
            each(&json!({ "axial_forcing": forcing, "start": self.starts[start], "impacts": impacts }))
        })
    }

    /// The points of a picture: forcing, phase and speed, in a layer for each start.
    fn layers(&self) -> Vec<Vec<(f64, f64, f64)>> {
        let mut layers = vec![Vec::new(); self.starts.len()];
        for (forcing, start, impacts) in self.orbits() {
            let speeds = &impacts.normalised_impact_speed;
            let points = impacts.impact_phase_periods.iter().zip(speeds);
            layers[start].extend(points.map(|(phase, speed)| (forcing, *phase, *speed)));
        }
        layers
    }
}

impl GridJob for DiagramJob {
    const COMMAND: &'static str = "diagram";

    type Row = Column;

    type Prepared = ();

    fn rows(&self) -> usize {
        self.axial_forcings.count()
    }

    fn together(&self) -> usize {
        TOGETHER
    }

    /// Sees that all is legal before hours are spent.
    fn prepare(&self, _: &dyn Observer) -> Result<(), Failure> {
        let (low, high) = self.axial_forcings.ends();
        for forcing in [low, high] {
            map(forcing, self.restitution)?;
        }
        let orbits = (self.axial_forcings.count() * self.starts.len()) as u64;
        grid::check_room(
            "impacts of a diagram",
            orbits.saturating_mul(self.recorded as u64),
            MAX_RECORDED,
            IMPACT,
        )
    }

    fn compute(
        &self,
        (): &(),
        rows: Rows<usize>,
        observer: &dyn Observer,
    ) -> Result<Vec<Self::Row>, Failure> {
        let mut orbits: Vec<Orbit> = Vec::new();
        let mut places = Vec::new();
        for row in rows.clone() {
            let map = map(self.axial_forcings.value(row), self.restitution)?;
            for (start, kind) in self.starts.iter().enumerate() {
                if let Some(state) = kind.of(&map)? {
                    orbits.push(map.orbit(state, ChatterPolicy::Complete));
                    places.push((row - rows.start, start));
                }
            }
        }
        let found = orbit_diagram(&orbits, self.transient, self.recorded, observer)?;
        let mut columns = vec![vec![None; self.starts.len()]; rows.len()];
        for ((row, start), impacts) in places.into_iter().zip(found) {
            columns[row][start] = Some(Impacts::of(&impacts));
        }
        Ok(columns)
    }

    fn report(self, (): (), rows: Vec<Self::Row>) -> Result<Report, Failure> {
        let mut shown = Table::new(&[
            ("axial_forcing", "1"),
            ("start", "1"),
            ("impacts", "1"),
            ("distinct_phases", "1"),
            ("least_phase", "periods"),
            ("largest_phase", "periods"),
            ("largest_speed", "1"),
        ]);
        let starts = self.starts.iter().map(Start::to_string).collect();
        let columns = Columns { axial_forcings: self.axial_forcings, starts, rows };
        for (forcing, start, impacts) in columns.orbits() {
            let (least, largest) = ends(&impacts.impact_phase_periods);
            shown.push([
                forcing.into(),
                columns.starts[start].as_str().into(),
                impacts.impact_phase_periods.len().into(),
                impacts.distinct().into(),
                least.into(),
                largest.into(),
                ends(&impacts.normalised_impact_speed).1.into(),
            ]);
        }
        let ends = self.axial_forcings.cell_ends(0.01);
        let provenance =
            provenance("bouncing-disk diagram", &self)?.with_chatter_policy(ChatterPolicy::Complete);
        let from: Vec<String> = self.starts.iter().map(Start::in_words).collect();
        let restitution = self.restitution;
        let columns = Rc::new(columns);
        let (listed, drawn) = (Rc::clone(&columns), Rc::clone(&columns));
        Ok(Report {
            provenance,
            text: shown.to_text(),
            table: Box::new(move |to| columns.write_csv(to)),
            data: vec![("columns", Data::List(Box::new(move |each| listed.write_json(each))))],
            figure: Some(Box::new(move || {
                pictures::diagram::draw(ends, restitution, &from, &drawn.layers())
            })),
        })
    }
}

/// The least and the largest value, if there are any.
fn ends(values: &[f64]) -> (Option<f64>, Option<f64>) {
    let (least, largest) = extent(values.iter().copied());
    if values.is_empty() { (None, None) } else { (Some(least), Some(largest)) }
}
