//! `bouncing-disk orbits`: the periodic orbits, stable and unstable.

use bouncing_disk::core::orbits::{OrbitCoverage, OrbitSearch, PeriodicOrbit, Stability};
use bouncing_disk_plot::Figure;

use super::map::{ContactArgs, MapArgs, VERTICAL, and_shape, driven_map, is_rigid_sine, map, with_shape};
use super::prelude::*;

/// Above the second period doubling.
const FORCING: f64 = 0.535;

/// All periodic orbits with few impacts, stable and unstable
#[derive(Debug, Args)]
#[command(after_help = "\
Orbits of one impact have a closed form; all others come from Newton's method on a grid of starts, and the result \
states whether half the resolution finds the same. An orbit attracts if its largest multiplier is below 1 in modulus \
by more than rounding errors, and is marginal if it equals 1 within rounding, as at a fold. Phases are in periods \
(tau_imp/2pi), speeds normalised, |w_A Gamma/(omega A)|. In .csv each impact is a row. See \
docs/studying-the-dynamics.md, \"All periodic orbits\".

Examples:
  bouncing-disk orbits --axial-forcing 0.535
  bouncing-disk orbits --axial-forcing 0.535 --max-impacts 2 --out orbits.json")]
pub(crate) struct OrbitsArgs {
    /// Axial forcing parameter Gamma = A omega^2/(pi g), a number. Taken from FILE, --preset or --set unless
    /// given; without these 0.535, above the second period doubling
    #[arg(help_heading = VERTICAL, long, short = 'G', value_name = "GAMMA", allow_hyphen_values = true)]
    axial_forcing: Option<Range>,
    #[command(flatten)]
    map: MapArgs,
    #[command(flatten)]
    contact: ContactArgs,
    /// Largest number of impacts of an orbit, in [1, 64]
    #[arg(help_heading = OWN, long, alias = "impacts", allow_negative_numbers = true, value_name = "N", default_value_t = 4)]
    max_impacts: usize,
    /// Largest number of periods of the platform in an orbit, in [1, 10000]
    #[arg(help_heading = OWN, long, alias = "platform-periods", allow_negative_numbers = true, value_name = "N", default_value_t = 4)]
    max_platform_periods: u64,
    /// Starts along each axis, in [2, 4096]
    #[arg(help_heading = OWN, long, allow_negative_numbers = true, value_name = "N", default_value_t = 96)]
    starts: u32,
    #[command(flatten)]
    output: OutputArgs,
}

pub(super) fn run(args: &OrbitsArgs, context: Context) -> Result<()> {
    let Some((system, drive)) = args.map.begin(&args.output, None, context)? else { return Ok(()) };
    let contact_periods = args.contact.contact_periods;
    let (axial_forcing, restitution) = args.map.pair(&system, args.axial_forcing, FORCING)?;
    let search = OrbitSearch::new(args.max_impacts, args.max_platform_periods)?
        .with_starts(args.starts, args.starts)?;
    let watch = context.watch("orbits");
    let (orbits, coverage) = if is_rigid_sine(&drive, contact_periods) {
        let found = map(axial_forcing, restitution)?.periodic_orbits(&search, &watch)?;
        (found.orbits, Some(found.coverage))
    } else {
        let map = driven_map(&drive, contact_periods, axial_forcing, restitution)?;
        (map.periodic_orbits(&search, &watch)?, None)
    };
    let job = json!({ "axial_forcing": axial_forcing, "restitution": restitution, "search": search });
    let job = with_shape(job, &drive, contact_periods);
    let numbered = orbits.iter().enumerate();
    let rows = numbered
        .flat_map(|(number, orbit)| (0..orbit.states.len()).map(move |impact| (number, orbit, impact)))
        .collect();
    let report = Report {
        provenance: provenance("bouncing-disk orbits", &job)?,
        text: text(&orbits, coverage.as_ref()),
        table: impacts().csv_of(rows),
        data: vec![("orbits", stored(&orbits)?), ("coverage", stored(&coverage)?)],
        figure: Some(Box::new(|| {
            let title = pictures::forcing_and_restitution(axial_forcing, restitution);
            draw(&(title + &and_shape(&drive, contact_periods)), &orbits)
        })),
    };
    report.deliver(&args.output, context)
}

fn text(orbits: &[PeriodicOrbit], coverage: Option<&OrbitCoverage>) -> String {
    let columns = Columns::<PeriodicOrbit>::new()
        .column("impacts", "1", |orbit| orbit.period())
        .column("platform_periods", "1", |orbit| orbit.platform_periods)
        .column("first_phase", "periods", |orbit| orbit.states.first().map(|state| state.phase().cycles()))
        .column("first_speed", "1", |orbit| orbit.states.first().map(|state| state.normalised_speed()))
        .column("largest_multiplier", "1", |orbit| orbit.multipliers().spectral_radius())
        .column("stability", "1", |orbit| orbit.stability().to_string());
    let Some(coverage) = coverage else { return columns.to_text(orbits) };
    format!(
        "{}{} starts up to an impact speed of {:.3} g/omega; {} of {} orbits are also found from half the resolution\n",
        columns.to_text(orbits),
        coverage.starts,
        coverage.impact_speed_bound,
        coverage.found_by_coarser,
        orbits.len()
    )
}

fn draw(title: &str, orbits: &[PeriodicOrbit]) -> Figure {
    let impacts = |orbit: &PeriodicOrbit| {
        let states = orbit.states.iter().map(|state| (state.phase().cycles(), state.normalised_speed()));
        (orbit.stability() == Stability::Stable, states.collect())
    };
    pictures::periodic_orbits(title, &orbits.iter().map(impacts).collect::<Vec<_>>())
}

/// An orbit with its number, and the place of one of its impacts in it.
type Row<'r> = (usize, &'r PeriodicOrbit, usize);

/// The columns of a file: each impact is a row.
fn impacts<'r>() -> Columns<Row<'r>> {
    Columns::<Row<'_>>::new()
        .column("orbit", "1", |row| row.0 + 1)
        .column("impacts", "1", |row| row.1.period())
        .column("platform_periods", "1", |row| row.1.platform_periods)
        .column("spectral_radius", "1", |row| row.1.multipliers().spectral_radius())
        .column("stability", "1", |row| row.1.stability().to_string())
        .column("impact", "1", |row| row.2 + 1)
        .column("impact_phase", "rad", |row| row.1.states[row.2].phase().angle())
        .column("impact_phase_share", "periods", |row| row.1.states[row.2].phase().cycles())
        .column("normalised_impact_speed", "1", |row| row.1.states[row.2].normalised_speed())
}
