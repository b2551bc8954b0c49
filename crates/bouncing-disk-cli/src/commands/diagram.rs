//! `bouncing-disk diagram`: where the disk lands, as the platform shakes harder.

use std::ops::Range as Rows;

use bouncing_disk::Observer;
use bouncing_disk::core::{ChatterPolicy, ImpactState, Orbit, orbit_diagram_observed};
use clap::Args;
use serde::{Deserialize, Serialize};
use serde_json::json;

use crate::arguments::{GridArgs, OWN, OutputArgs};
use crate::commands::map::{MapArgs, map, single};
use crate::commands::start::{STARTS, Start};
use crate::context::Context;
use crate::failure::Failure;
use crate::grid::{self, GridJob};
use crate::output::report::{Report, provenance, ready, value};
use crate::output::table::Table;
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
    #[command(flatten)]
    map: MapArgs,
    #[arg(help_heading = OWN, long, value_name = "START", help = format!("How orbits start: {STARTS}. May be repeated; `rest` and `period-1` unless given"))]
    start: Vec<Start>,
    /// Impacts that are not looked at
    #[arg(help_heading = OWN, long, value_name = "N", default_value_t = 3_000)]
    transient: usize,
    /// Impacts of each orbit that are recorded
    #[arg(help_heading = OWN, long, value_name = "N", default_value_t = 256)]
    recorded: usize,
    #[command(flatten)]
    grid: GridArgs,
    #[command(flatten)]
    output: OutputArgs,
}

/// Runs the command.
pub(crate) fn run(args: &DiagramArgs, context: Context) -> Result<(), Failure> {
    if args.map.wrote_template()? {
        return Ok(());
    }
    let (first, last, count) = FORCINGS;
    let values = args.map.values(Range::new(first, last, count).map_err(Failure::usage)?)?;
    let starts = if args.start.is_empty() { vec![Start::Rest, Start::PeriodOne] } else { args.start.clone() };
    let job = DiagramJob {
        axial_forcings: values.axial_forcings,
        restitution: single(values.restitutions, "--restitution")?,
        starts,
        transient: args.transient,
        recorded: args.recorded,
    };
    grid::run(job, &args.grid, &args.output, context)
}

/// Phases nearer than this count as one (periods).
const SAME_PHASE: f64 = 1e-6;

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
        let mut phases = self.impact_phase_periods.clone();
        phases.sort_unstable_by(f64::total_cmp);
        let (Some(first), Some(last)) = (phases.first(), phases.last()) else { return 0 };
        let gaps = phases.windows(2).filter(|pair| pair[1] - pair[0] > SAME_PHASE).count();
        // The end of a period is the beginning of the next.
        (gaps + usize::from(first + 1.0 - last > SAME_PHASE)).max(1)
    }
}

impl GridJob for DiagramJob {
    const COMMAND: &'static str = "diagram";

    /// The impacts of each start; none where the forcing has no such start.
    type Row = Vec<Option<Impacts>>;

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
        Ok(())
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
        let found = orbit_diagram_observed(&orbits, self.transient, self.recorded, observer)?;
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
        let columns = [
            ("axial_forcing", "1"),
            ("start", "1"),
            ("impact_phase", "periods"),
            ("normalised_impact_speed", "1"),
        ];
        let mut table = Table::new(&columns);
        let mut data = Vec::new();
        let mut layers = vec![Vec::new(); self.starts.len()];
        for (forcing, row) in self.axial_forcings.values().zip(&rows) {
            for ((start, impacts), layer) in self.starts.iter().zip(row).zip(&mut layers) {
                let Some(impacts) = impacts else { continue };
                let ends = |values: &[f64]| {
                    let low = values.iter().copied().reduce(f64::min);
                    (low, values.iter().copied().reduce(f64::max))
                };
                let (least, largest) = ends(&impacts.impact_phase_periods);
                let fastest = ends(&impacts.normalised_impact_speed).1;
                let phases = impacts.impact_phase_periods.len();
                let start = start.to_string();
                shown.push([
                    forcing.into(),
                    start.as_str().into(),
                    phases.into(),
                    impacts.distinct().into(),
                    least.into(),
                    largest.into(),
                    fastest.into(),
                ]);
                for (phase, speed) in
                    impacts.impact_phase_periods.iter().zip(&impacts.normalised_impact_speed)
                {
                    table.push([forcing.into(), start.as_str().into(), (*phase).into(), (*speed).into()]);
                    layer.push((forcing, *phase, *speed));
                }
                data.push(json!({ "axial_forcing": forcing, "start": start, "impacts": value(impacts)? }));
            }
        }
        let ends = self.axial_forcings.cell_ends(0.01);
        let provenance =
            provenance("bouncing-disk diagram", &self)?.with_chatter_policy(ChatterPolicy::Complete);
        let names: Vec<String> = self.starts.iter().map(Start::to_string).collect();
        Ok(Report {
            provenance,
            text: shown.to_text(),
            table: ready(table),
            data: vec![("columns", data.into())],
            figure: Some(Box::new(move || pictures::diagram::draw(ends, &names, &layers))),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn phases_are_counted_whatever_millionth_they_are_next_to() {
        let counted = |phases: &[f64]| {
            let speeds = vec![1.0; phases.len()];
            Impacts { impact_phase_periods: phases.to_vec(), normalised_impact_speed: speeds }.distinct()
        };
        assert_eq!(counted(&[]), 0);
        assert_eq!(counted(&[0.3]), 1);
        let ulp = f64::EPSILON;
        assert_eq!(counted(&[0.125, 0.125 - ulp, 0.125 + ulp]), 1);
        assert_eq!(counted(&[0.05 * (1.0 - ulp), 0.05, 0.7, 0.7]), 2);
        // One place at the seam of the phase.
        assert_eq!(counted(&[0.0, 1.0 - ulp, ulp]), 1);
        assert_eq!(counted(&[0.0, 0.5, 1.0 - ulp]), 2);
    }
}
