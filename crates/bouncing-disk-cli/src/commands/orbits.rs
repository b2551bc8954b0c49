//! `bouncing-disk orbits`: the periodic orbits, stable and unstable.

use bouncing_disk::core::{OrbitSearch, OrbitsFound};
use clap::Args;
use serde::Serialize;

use crate::arguments::{OWN, OutputArgs};
use crate::commands::map::{MapArgs, VERTICAL, map, single};
use crate::context::Context;
use crate::failure::Failure;
use crate::output::report::{Report, provenance, ready, stored};
use crate::output::table::Table;
use crate::pictures;
use crate::range::Range;

/// What stands at the end of the help.
const AFTER: &str = "\
Orbits of one impact come from their closed form, all others from Newton's method on the impacts of a grid of starts: the \
result says whether half the resolution finds the same. An orbit attracts if its largest multiplier is below 1 in \
modulus by more than rounding may change it, and is marginal if rounding decides, as in a fold. Phases are in periods (tau_imp/2pi), speeds normalised, |w_A Gamma/(omega A)|. In .csv each impact is a row. See \
docs/studying-the-dynamics.md, \"All periodic orbits\".

Examples:
  bouncing-disk orbits --axial-forcing 0.535
  bouncing-disk orbits --axial-forcing 0.535 --impacts 2 --out orbits.json";

/// Past the second period doubling.
const FORCING: f64 = 0.535;

/// All periodic orbits of few impacts, stable and unstable
#[derive(Debug, Args)]
#[command(after_help = AFTER)]
pub(crate) struct OrbitsArgs {
    /// Axial forcing parameter Gamma = A omega^2/(pi g), a number. That of FILE, --preset or --set unless
    /// given; without these 0.535, past the second period doubling
    #[arg(help_heading = VERTICAL, long, short = 'G', value_name = "GAMMA", allow_hyphen_values = true)]
    axial_forcing: Option<Range>,
    #[command(flatten)]
    map: MapArgs,
    /// Most impacts of an orbit, in [1, 64]
    #[arg(help_heading = OWN, long, allow_negative_numbers = true, value_name = "N", default_value_t = 4)]
    impacts: usize,
    /// Most periods of the platform that an orbit takes, in [1, 10000]
    #[arg(help_heading = OWN, long, allow_negative_numbers = true, value_name = "N", default_value_t = 4)]
    platform_periods: u64,
    /// Starts along each axis, in [2, 4096]
    #[arg(help_heading = OWN, long, allow_negative_numbers = true, value_name = "N", default_value_t = 96)]
    starts: u32,
    #[command(flatten)]
    output: OutputArgs,
}

#[derive(Serialize)]
struct Job {
    axial_forcing: f64,
    restitution: f64,
    search: OrbitSearch,
}

/// Runs the command.
pub(crate) fn run(args: &OrbitsArgs, context: Context) -> Result<(), Failure> {
    if args.map.wrote_template(&args.output, context)? {
        return Ok(());
    }
    args.output.check(true, &args.map.inputs(), None)?;
    let values = args.map.values(args.axial_forcing, Range::single(FORCING))?;
    let job = Job {
        axial_forcing: single(values.axial_forcings, "--axial-forcing")?,
        restitution: single(values.restitutions, "--restitution")?,
        search: OrbitSearch::new(args.impacts, args.platform_periods)?
            .with_starts(args.starts, args.starts)?,
    };
    let map = map(job.axial_forcing, job.restitution)?;
    let found = map.periodic_orbits(&job.search, &context.watch("orbits"))?;
    let report = Report {
        provenance: provenance("bouncing-disk orbits", &job)?,
        text: text(&found),
        table: ready(table(&found)),
        data: vec![("orbits", stored(&found.orbits)?), ("coverage", stored(&found.coverage)?)],
        figure: Some(Box::new(move || pictures::orbits::draw(job.axial_forcing, job.restitution, &found))),
    };
    report.deliver(&args.output, context.quiet)
}

fn text(found: &OrbitsFound) -> String {
    let mut table = Table::new(&[
        ("impacts", "1"),
        ("platform_periods", "1"),
        ("first_phase", "periods"),
        ("first_speed", "1"),
        ("largest_multiplier", "1"),
        ("stability", "1"),
    ]);
    for orbit in &found.orbits {
        let radius = orbit.multipliers().spectral_radius();
        let first = orbit.states.first();
        table.push([
            orbit.period().into(),
            orbit.platform_periods.into(),
            first.map(|state| state.phase().cycles()).into(),
            first.map(|state| state.normalised_speed()).into(),
            radius.into(),
            orbit.stability().to_string().into(),
        ]);
    }
    let coverage = &found.coverage;
    format!(
        "{}{} starts up to an impact speed of {:.3} g/omega; {} of {} orbits are found from half the resolution, too\n",
        table.to_text(),
        coverage.starts,
        coverage.impact_speed_bound,
        coverage.found_by_coarser,
        found.orbits.len()
    )
}

fn table(found: &OrbitsFound) -> Table {
    let mut table = Table::new(&[
        ("orbit", "1"),
        ("impacts", "1"),
        ("platform_periods", "1"),
        ("spectral_radius", "1"),
        ("stability", "1"),
        ("impact", "1"),
        ("impact_phase", "rad"),
        ("impact_phase_share", "periods"),
        ("normalised_impact_speed", "1"),
    ]);
    for (number, orbit) in found.orbits.iter().enumerate() {
        let radius = orbit.multipliers().spectral_radius();
        for (impact, state) in orbit.states.iter().enumerate() {
            table.push([
                (number + 1).into(),
                orbit.period().into(),
                orbit.platform_periods.into(),
                radius.into(),
                orbit.stability().to_string().into(),
                (impact + 1).into(),
                state.phase().angle().into(),
                state.phase().cycles().into(),
                state.normalised_speed().into(),
            ]);
        }
    }
    table
}
