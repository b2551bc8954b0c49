//! `bouncing-disk doublings`: the period-doubling cascade.

use bouncing_disk::core::orbits::{
    CascadeDoubling, FeigenbaumEstimate, doubling_cascade, feigenbaum_estimates,
};
use bouncing_disk::drives::driven_doubling_cascade;

use bouncing_disk_plot::rounded;

use super::map::{ContactArgs, MapArgs, driven_map, is_rigid_sine, with_shape};
use super::prelude::*;

/// The period-doubling cascade, forcing by forcing, with Feigenbaum's constants
#[derive(Debug, Args)]
#[command(after_help = "\
The cascade starts from the orbit with one impact in each period of the platform; its doublings are the paper's \
Gamma_1, Gamma_2, ... From the seventh doubling on the table includes estimates of Feigenbaum's constants. The error \
is a bound on the effect of rounding on a forcing. If the cascade ends early, the doublings found so far are printed \
with the reason. The command finds the forcings, so there is no --axial-forcing; from a system it takes the \
restitution and the shape of the drive. With another drive or --contact-periods the cascade begins with the \
attracting orbit of one impact per period at the lowest forcing, and the error follows from the rounding error of \
the trace. See docs/numerics-dynamics.md.

Examples:
  bouncing-disk doublings
  bouncing-disk doublings --restitution 0.3 --count 12 --out cascade.csv")]
pub(crate) struct DoublingsArgs {
    #[command(flatten)]
    map: MapArgs,
    #[command(flatten)]
    contact: ContactArgs,
    /// Number of doublings to find, in [1, 13]
    #[arg(help_heading = OWN, long, allow_negative_numbers = true, short = 'n', value_name = "N", default_value_t = 8)]
    count: usize,
    #[command(flatten)]
    output: OutputArgs,
}

pub(super) fn run(args: &DoublingsArgs, context: Context) -> Result<()> {
    let Some((system, drive)) = args.map.begin(&args.output, None, context)? else { return Ok(()) };
    let contact_periods = args.contact.contact_periods;
    let (_, restitution) = args.map.pair(&system, None, 0.0)?;
    let watch = context.watch("doublings");
    let cascade = if is_rigid_sine(&drive, contact_periods) {
        doubling_cascade(restitution, args.count, &watch)?
    } else {
        // Finds a fault of the map before the search builds many.
        driven_map(&drive, contact_periods, 1.0, restitution)?;
        let shape = drive.clone();
        let maps = move |forcing| driven_map(&shape, contact_periods, forcing, restitution).ok();
        driven_doubling_cascade(maps, args.count, &watch)?
    };
    let (found, ended_by) = (cascade.doublings, cascade.ended_by.map(|error| error.to_string()));
    let estimates = feigenbaum_estimates(&found);
    let of = |doubling: &CascadeDoubling| estimates.iter().find(|own| own.number == doubling.number).copied();
    let forcings: Vec<f64> = found.iter().map(|doubling| doubling.axial_forcing).collect();
    let rows = found.iter().map(|doubling| (*doubling, of(doubling))).collect();
    let job = with_shape(json!({ "restitution": restitution, "count": args.count }), &drive, contact_periods);
    let report = Report {
        provenance: provenance("bouncing-disk doublings", &job)?,
        text: text(&found, &estimates, ended_by.as_deref()),
        table: columns().csv_of(rows),
        data: vec![
            ("doublings", stored(&found)?),
            ("feigenbaum_estimates", stored(&estimates)?),
            ("ended_by", stored(&ended_by)?),
        ],
        figure: Some(Box::new(move || pictures::doublings(restitution, &forcings))),
    };
    report.deliver(&args.output, context)?;
    // The text contains the reason; a table or a picture has no place for it.
    if let Some(error) = ended_by.filter(|_| !args.output.out.is_empty()) {
        context.note(&format!("warning: no doubling {}: {error}", found.len() + 1));
    }
    Ok(())
}

fn text(found: &[CascadeDoubling], estimates: &[FeigenbaumEstimate], ended_by: Option<&str>) -> String {
    let columns = Columns::<CascadeDoubling>::new()
        .column("number", "1", |own| own.number)
        .column("period", "impacts", |own| own.period)
        .column("axial_forcing", "1", |own| rounded(own.axial_forcing, 13))
        .column("error", "1", |own| rounded(own.forcing_error, 1))
        .column("width", "rad", |own| own.width);
    let mut text = columns.to_text(found);
    if let Some(last) = estimates.last() {
        text += &format!(
            "delta = {:.6} +- {}, alpha = {:.6} +- {}, from the doublings up to {}\n",
            last.delta,
            rounded(last.delta_error, 1),
            last.alpha,
            rounded(last.alpha_error, 1),
            last.number
        );
    }
    if let Some(error) = ended_by {
        text += &format!("no doubling {}: {error}\n", found.len() + 1);
    }
    text
}

/// The columns of a file: a doubling, with the estimates up to it.
fn columns() -> Columns<(CascadeDoubling, Option<FeigenbaumEstimate>)> {
    Columns::new()
        .column("number", "1", |row: &(CascadeDoubling, Option<FeigenbaumEstimate>)| row.0.number)
        .column("period", "1", |row| row.0.period)
        .column("axial_forcing", "1", |row| row.0.axial_forcing)
        .column("forcing_error", "1", |row| row.0.forcing_error)
        .column("width", "rad", |row| row.0.width)
        .column("multiplier", "1", |row| row.0.multiplier)
        .column("delta", "1", |row| row.1.map(|own| own.delta))
        .column("delta_error", "1", |row| row.1.map(|own| own.delta_error))
        .column("alpha", "1", |row| row.1.map(|own| own.alpha))
        .column("alpha_error", "1", |row| row.1.map(|own| own.alpha_error))
}
