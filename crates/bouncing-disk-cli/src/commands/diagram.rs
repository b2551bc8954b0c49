//! `bouncing-disk diagram`: orbit diagrams over the forcing.

use bouncing_disk::Observer;
use bouncing_disk::core::numerics::statistics::extent;
use bouncing_disk::core::{
    ChatterPolicy, ImpactState, Orbit,
    sweep::{MAX_RECORDED, orbit_diagram},
};
use bouncing_disk::drives::DrivenOrbit;
use bouncing_disk::motor::circular::distinct;
use bouncing_disk::parameters::Waveform;
use bouncing_disk_plot::Figure;
use bouncing_disk_plot::pictures::{OrbitDiagram, OrbitsFrom};
use serde::{Deserialize, Serialize};

use super::map::{
    ContactArgs, MapArgs, NO_PERIOD_ONE, STARTS, Start, VERTICAL, and_shape, driven_map, is_rigid_sine,
    is_sine, map, single,
};
use super::prelude::*;

/// Forcings of the paper's Fig. 6.
const FORCINGS: &str = "0.30:0.62:641";

/// An orbit diagram: the impacts after the transient, over the axial forcing
#[derive(Debug, Args)]
#[command(after_help = "\
Each forcing gives one row, the impacts of an orbit after its transient, as in Figs. 6(a) and 6(b) of the paper. \
Phases are in periods of the platform (tau_imp/2pi), speeds normalised, |w_A Gamma/(omega A)|. The table on the \
terminal counts phases that differ by more than a millionth of a period. See docs/studying-the-dynamics.md.

Examples:
  bouncing-disk diagram --out diagram.png
  bouncing-disk diagram -G 0.45:0.55:1001 --start period-1 --out cascade.csv
  bouncing-disk diagram -G 0:3:601 --contact-periods 0.3 --out soft.png
  bouncing-disk diagram --chunk 1/10 --out part-1.json")]
pub(crate) struct DiagramArgs {
    /// Axial forcing parameter Gamma = A omega^2/(pi g): a number, or a range FIRST:LAST:POINTS, both ends
    /// included. Taken from FILE, --preset or --set unless given; without these 0.30:0.62:641, as in the
    /// paper's Fig. 6
    #[arg(help_heading = VERTICAL, long, short = 'G', value_name = "GAMMA", allow_hyphen_values = true)]
    axial_forcing: Option<Range>,
    #[command(flatten)]
    map: MapArgs,
    #[command(flatten)]
    contact: ContactArgs,
    #[arg(help_heading = OWN, long, allow_hyphen_values = true, value_name = "START", help = format!("How orbits start: {STARTS}. May be repeated. Default: `rest` and `period-1`; with a [drive] or a contact time `rest` and `rise`"))]
    start: Vec<Start>,
    /// Impacts to discard before the recorded ones
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

pub(super) fn run(args: &DiagramArgs, context: Context) -> Result<()> {
    let given = args.map.begin(&args.output, Some(&args.grid), context)?;
    let Some((system, drive)) = given else { return Ok(()) };
    let contact_periods = args.contact.contact_periods;
    let otherwise = FORCINGS.parse().map_err(Failure::Usage)?;
    let (axial_forcings, restitutions) = args.map.values(&system, args.axial_forcing, otherwise);
    let starts = match (&args.start[..], is_rigid_sine(&drive, contact_periods)) {
        ([], true) => vec![Start::Rest, Start::PeriodOne],
        ([], false) => vec![Start::Rest, Start::Rise],
        (starts, is_rigid_sine) if is_rigid_sine || !starts.contains(&Start::PeriodOne) => starts.to_vec(),
        _ => return Err(Failure::Usage(NO_PERIOD_ONE.to_owned())),
    };
    let job = DiagramJob {
        axial_forcings,
        restitution: single(restitutions, "--restitution")?,
        starts,
        transient: args.transient,
        recorded: args.recorded,
        drive,
        contact_periods,
    };
    grid::run(job, &args.grid, &args.output, context)
}

/// Phases nearer than this count as one (periods).
const SAME_PHASE: f64 = 1e-6;

/// The size of an impact (bytes): a phase and a speed.
const IMPACT: u64 = 16;

#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct DiagramJob {
    axial_forcings: Range,
    restitution: f64,
    starts: Vec<Start>,
    transient: usize,
    recorded: usize,
    /// The shape of the height.
    #[serde(default, skip_serializing_if = "is_sine")]
    drive: Waveform,
    /// How long an impact lasts (periods).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    contact_periods: Option<f64>,
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
}

/// The impacts of each start at one forcing; empty if the start does not exist there.
type Column = Vec<Option<Impacts>>;

#[derive(Clone, Copy)]
struct Diagram<'a> {
    job: &'a DiagramJob,
    rows: &'a [Column],
}

impl<'a> Diagram<'a> {
    /// Forcing, index of the start and impacts of all orbits.
    fn orbits(self) -> impl Iterator<Item = (f64, usize, &'a Impacts)> {
        self.job.axial_forcings.values().zip(self.rows).flat_map(|(forcing, row)| {
            let there = row.iter().enumerate();
            there.filter_map(move |(start, impacts)| Some((forcing, start, impacts.as_ref()?)))
        })
    }

    /// Forcing, index of the start, phase and speed of all impacts.
    fn impacts(self) -> impl Iterator<Item = (f64, usize, f64, f64)> + 'a {
        self.orbits().flat_map(|(forcing, start, impacts)| {
            let both = impacts.impact_phase_periods.iter().zip(&impacts.normalised_impact_speed);
            both.map(move |(phase, speed)| (forcing, start, *phase, *speed))
        })
    }

    /// One row per orbit.
    fn text(self) -> String {
        type Row<'r> = (f64, Start, &'r [f64], &'r [f64]);
        let columns = Columns::<Row<'_>>::new()
            .column("axial_forcing", "1", |row| row.0)
            .column("start", "1", |row| row.1.to_string())
            .column("impacts", "1", |row| row.2.len())
            .column("distinct_phases", "1", |row| distinct(row.2.iter().copied(), SAME_PHASE))
            .column("least_phase", "periods", |row| ends(row.2).map(|ends| ends.0))
            .column("largest_phase", "periods", |row| ends(row.2).map(|ends| ends.1))
            .column("largest_speed", "1", |row| ends(row.3).map(|ends| ends.1));
        let rows = self.orbits().map(
            |(forcing, start, Impacts { impact_phase_periods, normalised_impact_speed })| {
                (forcing, self.job.starts[start], &impact_phase_periods[..], &normalised_impact_speed[..])
            },
        );
        columns.to_text(rows)
    }

    fn draw(self) -> Figure {
        let DiagramJob { axial_forcings, restitution, starts, drive, contact_periods, .. } = self.job;
        let named = |start: &Start| (start.in_words(), Vec::new());
        let mut starts: Vec<OrbitsFrom> = starts.iter().map(named).collect();
        for (forcing, start, phase, speed) in self.impacts() {
            starts[start].1.push((forcing, phase, speed));
        }
        let axial_forcings = axial_forcings.cell_ends(0.01);
        let shape = and_shape(drive, *contact_periods);
        OrbitDiagram { axial_forcings, restitution: *restitution, shape: &shape, starts: &starts }.draw()
    }
}

impl GridJob for DiagramJob {
    const COMMAND: &'static str = "diagram";

    type Row = Column;

    type Prepared = ();

    fn rows(&self) -> usize {
        self.axial_forcings.count()
    }

    /// Checks everything before hours are spent.
    fn prepare(&self, _: &dyn Observer) -> Result<()> {
        let (low, high) = self.axial_forcings.ends();
        for forcing in [low, high] {
            map(forcing, self.restitution)?;
            driven_map(&self.drive, self.contact_periods, forcing, self.restitution)?;
        }
        let orbits = (self.axial_forcings.count() * self.starts.len()) as u64;
        grid::check_room(
            "impacts of a diagram",
            orbits.saturating_mul(self.recorded as u64),
            MAX_RECORDED,
            IMPACT,
        )
    }

    fn compute(&self, (): &(), rows: Rows, observer: &dyn Observer) -> Result<Vec<Self::Row>> {
        let (mut orbits, mut driven) = (Vec::<Orbit>::new(), Vec::<DrivenOrbit>::new());
        let mut places = Vec::new();
        for row in rows.clone() {
            let (forcing, restitution) = (self.axial_forcings.value(row), self.restitution);
            let map = map(forcing, restitution)?;
            let own = (!is_rigid_sine(&self.drive, self.contact_periods))
                .then(|| driven_map(&self.drive, self.contact_periods, forcing, restitution))
                .transpose()?;
            let rise = own.as_ref().map_or(0.0, |own| own.drive().fastest_rise_phase());
            for (start, kind) in self.starts.iter().enumerate() {
                if let Some(state) = kind.of(&map, rise)? {
                    match &own {
                        None => orbits.push(map.orbit(state, ChatterPolicy::Complete)),
                        Some(own) => driven.push(own.orbit(state, ChatterPolicy::Complete)),
                    }
                    places.push((row - rows.start, start));
                }
            }
        }
        let (transient, recorded) = (self.transient, self.recorded);
        let found = if is_rigid_sine(&self.drive, self.contact_periods) {
            orbit_diagram(&orbits, transient, recorded, observer)?
        } else {
            orbit_diagram(&driven, transient, recorded, observer)?
        };
        let mut columns = vec![vec![None; self.starts.len()]; rows.len()];
        for ((row, start), impacts) in places.into_iter().zip(found) {
            columns[row][start] = Some(Impacts::of(&impacts));
        }
        Ok(columns)
    }

    fn report<'a>(&'a self, (): &'a (), rows: &'a [Column]) -> Result<Report<'a>> {
        let diagram = Diagram { job: self, rows };
        let table = move |to: &mut dyn Write| {
            let columns = Columns::<(f64, Start, f64, f64)>::new()
                .column("axial_forcing", "1", |row| row.0)
                .column("start", "1", |row| row.1.to_string())
                .column("impact_phase", "periods", |row| row.2)
                .column("normalised_impact_speed", "1", |row| row.3);
            let impacts = diagram.impacts();
            columns.write_csv(
                to,
                impacts.map(|(forcing, start, phase, speed)| (forcing, self.starts[start], phase, speed)),
            )
        };
        let listed = move || {
            diagram.orbits().map(|(forcing, start, impacts)| {
                json!({ "axial_forcing": forcing, "start": self.starts[start].to_string(), "impacts": impacts })
            })
        };
        Ok(Report {
            provenance: provenance("bouncing-disk diagram", self)?
                .with_chatter_policy(ChatterPolicy::Complete),
            text: diagram.text(),
            table: Box::new(table),
            data: vec![("columns", json::list(listed))],
            figure: Some(Box::new(move || diagram.draw())),
        })
    }
}

/// The least and the largest value, if there are any.
fn ends(values: &[f64]) -> Option<(f64, f64)> {
    (!values.is_empty()).then(|| extent(values.iter().copied()))
}
