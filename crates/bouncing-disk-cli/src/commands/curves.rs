//! `bouncing-disk curves`: where folds, doublings and grazes are in the plane of forcing and restitution.

use bouncing_disk::core::orbits::{
    Bifurcation, Continuation, ContinuationParameter, ContinuedMap, Curve, CurveEnd, CurvePoint, OrbitSearch,
    PeriodicOrbit, SpecialPoint,
};
use bouncing_disk::parameters::MapNumber;
use serde::Serialize;

use super::map::{ContactArgs, MapArgs, driven_map, is_rigid_sine, map, with_shape};
use super::prelude::*;

/// Between the birth of the orbit with one impact per period and its doubling.
const FORCING: f64 = 0.45;

/// Two bifurcations at forcings and speeds that differ by less are one.
const SAME: f64 = 1.0e-9;

/// Curves of folds, doublings and grazes over forcing and restitution
#[derive(Debug, Args)]
#[command(after_help = "\
The periodic orbits at the given forcing and restitution are followed over the forcing. Each fold, doubling and \
graze on the way is then followed over both. A row with a special point names the change of the bifurcation there: a \
cusp, a doubling that turns from supercritical to subcritical, or a graze in a fold or doubling. The error states \
how far rounding may have moved the curve along the forcing. See docs/studying-the-dynamics.md, \"Curves in two \
parameters\".

Examples:
  bouncing-disk curves
  bouncing-disk curves -G 0.52 --restitution 0.45 --out curves.csv")]
pub(crate) struct CurvesArgs {
    /// Axial forcing parameter Gamma = A omega^2/(pi g), a number. Taken from FILE, --preset or --set unless
    /// given; without these 0.45
    #[arg(help_heading = super::map::VERTICAL, long, short = 'G', value_name = "GAMMA", allow_hyphen_values = true)]
    axial_forcing: Option<Range>,
    #[command(flatten)]
    map: MapArgs,
    #[command(flatten)]
    contact: ContactArgs,
    /// Forcings of the curves, LOW:HIGH
    #[arg(help_heading = OWN, long, allow_hyphen_values = true, value_name = "LOW:HIGH", default_value = "0.05:2", value_parser = interval)]
    branch_range: [f64; 2],
    /// Restitutions of the curves, LOW:HIGH
    #[arg(help_heading = OWN, long, allow_hyphen_values = true, value_name = "LOW:HIGH", default_value = "0.05:0.95", value_parser = interval)]
    parameter_range: [f64; 2],
    /// Largest number of impacts of an orbit, in [1, 64]
    #[arg(help_heading = OWN, long, allow_negative_numbers = true, value_name = "N", default_value_t = 1)]
    max_impacts: usize,
    /// Largest number of periods of the platform in an orbit, in [1, 10000]
    #[arg(help_heading = OWN, long, allow_negative_numbers = true, value_name = "N", default_value_t = 1)]
    max_platform_periods: u64,
    /// Largest number of points of a curve, in [2, 1000000]
    #[arg(help_heading = OWN, long, allow_negative_numbers = true, value_name = "N", default_value_t = 10_000)]
    max_points: usize,
    #[command(flatten)]
    output: OutputArgs,
}

pub(super) fn run(args: &CurvesArgs, context: Context) -> Result<()> {
    let Some((system, drive)) = args.map.begin(&args.output, None, context)? else { return Ok(()) };
    let contact_periods = args.contact.contact_periods;
    let (axial_forcing, restitution) = args.map.pair(&system, args.axial_forcing, FORCING)?;
    let search = OrbitSearch::new(args.max_impacts, args.max_platform_periods)?;
    let watch = context.watch("curves");
    let sine = map(axial_forcing, restitution)?;
    let found = if is_rigid_sine(&drive, contact_periods) {
        let orbits = sine.periodic_orbits(&search, &watch)?.orbits;
        let parameters = [ContinuationParameter::Forcing, ContinuationParameter::Restitution];
        curves(args, &sine, &orbits, parameters, &watch)?
    } else {
        let orbits = driven_map(&drive, contact_periods, axial_forcing, restitution)?;
        let orbits = orbits.periodic_orbits(&search, &watch)?;
        let numbers = [MapNumber::AxialForcing, MapNumber::Restitution];
        let family = drive.family_of_two(&sine, contact_periods, numbers)?;
        let parameters = [ContinuationParameter::Number, ContinuationParameter::SecondNumber];
        curves(args, &family, &orbits, parameters, &watch)?
    };
    let job = json!({
        "axial_forcing": axial_forcing, "restitution": restitution, "search": search,
        "branch_range": args.branch_range, "parameter_range": args.parameter_range, "max_points": args.max_points,
    });
    let report = Report {
        provenance: provenance("bouncing-disk curves", &with_shape(job, &drive, contact_periods))?,
        text: text(&found),
        table: points().csv_of(rows(&found)),
        data: vec![("curves", stored(&found)?)],
        figure: None,
    };
    report.deliver(&args.output, context)
}

/// A curve without its map.
#[derive(Debug, Serialize)]
struct Found {
    kind: &'static str,
    impacts: usize,
    points: Vec<CurvePoint>,
    special: Vec<SpecialPoint>,
    end: CurveEnd,
}

/// The curves, in both directions, of the bifurcations of these orbits over the forcing.
fn curves<M: ContinuedMap>(
    args: &CurvesArgs,
    map: &M,
    orbits: &[PeriodicOrbit],
    [first, second]: [ContinuationParameter; 2],
    watch: &impl bouncing_disk::core::Observer,
) -> Result<Vec<Found>> {
    let settings = |rising| {
        let own = Continuation::new(second, args.parameter_range.into(), rising)?;
        own.with_steps(0.01, 0.05, args.max_points)
    };
    let directions = [settings(true)?, settings(false)?];
    let (mut known, mut found) = (Vec::<Bifurcation>::new(), Vec::new());
    for orbit in orbits {
        for rising in [true, false] {
            let along = Continuation::new(first, args.branch_range.into(), rising)?;
            let mut branch = map.continued(orbit, &along, watch)?;
            branch.bifurcations.retain(|own| !known.iter().any(|other| is_same(own, other)));
            known.extend(branch.bifurcations.iter().cloned());
            let curves = branch.curves(args.branch_range.into(), &directions, watch)?;
            found.extend(curves.into_iter().map(|(_, curve)| {
                let Curve { kind, points, special, end, .. } = curve;
                let impacts = points.first().map_or(0, |point| point.states.len());
                Found { kind: kind.name(), impacts, points, special, end }
            }));
        }
    }
    Ok(found)
}

/// Whether two orbits have met the same bifurcation.
fn is_same(one: &Bifurcation, other: &Bifurcation) -> bool {
    let fastest = |own: &Bifurcation| {
        own.point.orbit.states.iter().fold(0.0_f64, |most, state| most.max(-state.velocity()))
    };
    one.kind.name() == other.kind.name()
        && one.point.orbit.period() == other.point.orbit.period()
        && (one.point.parameter - other.point.parameter).abs() <= SAME
        && (fastest(one) - fastest(other)).abs() <= SAME * (1.0 + fastest(one))
}

fn text(found: &[Found]) -> String {
    let columns = Columns::<Found>::new()
        .column("kind", "1", |own| own.kind)
        .column("impacts", "1", |own| own.impacts)
        .column("points", "1", |own| own.points.len())
        .column("axial_forcing", "1", |own| own.points.last().map(|point| point.parameters[0]))
        .column("restitution", "1", |own| own.points.last().map(|point| point.parameters[1]))
        .column("end", "1", |own| own.end.name())
        .column("special_points", "1", |own| {
            own.special.iter().map(|special| special.kind.name()).collect::<Vec<_>>().join(", ")
        });
    columns.to_text(found)
}

/// A curve with its number, one of its points, and the kind of a special point.
type Row<'r> = (usize, &'r Found, &'r CurvePoint, &'static str);

fn rows(found: &[Found]) -> Vec<Row<'_>> {
    let mut rows = Vec::new();
    for (number, own) in found.iter().enumerate() {
        rows.extend(own.points.iter().map(|point| (number, own, point, "")));
        rows.extend(own.special.iter().map(|special| (number, own, &special.point, special.kind.name())));
    }
    rows
}

/// The columns of a file: each point is a row.
fn points<'r>() -> Columns<Row<'r>> {
    Columns::<Row<'_>>::new()
        .column("curve", "1", |row| row.0 + 1)
        .column("kind", "1", |row| row.1.kind)
        .column("impacts", "1", |row| row.1.impacts)
        .column("axial_forcing", "1", |row| row.2.parameters[0])
        .column("restitution", "1", |row| row.2.parameters[1])
        .column("forcing_error", "1", |row| row.2.errors[0])
        .column("restitution_error", "1", |row| row.2.errors[1])
        .column("special_point", "1", |row| row.3)
        .column("end", "1", |row| row.1.end.name())
}
