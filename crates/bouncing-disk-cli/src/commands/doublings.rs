//! `bouncing-disk doublings`: the period-doubling cascade.

use bouncing_disk::core::{CascadeDoubling, FeigenbaumEstimate, doubling_cascade, feigenbaum_estimates};
use clap::Args;
use serde::Serialize;

use crate::arguments::{OWN, OutputArgs};
use crate::commands::map::MapArgs;
use crate::context::Context;
use crate::failure::Failure;
use crate::output::numbers::rounded;
use crate::output::report::{Report, provenance, ready, stored};
use crate::output::table::Table;
use crate::pictures;

/// What stands at the end of the help.
const AFTER: &str = "\
The cascade starts from the orbit with one impact in each period of the platform, at the paper's Gamma_1, Gamma_2, ... From \
the seventh doubling on there are estimates of Feigenbaum's constants. The error is what rounding may have moved a \
forcing by. The forcings are what is found, so that there is no --axial-forcing; of a system its restitution alone matters. See docs/numerics/dynamics.md.

Examples:
  bouncing-disk doublings
  bouncing-disk doublings --restitution 0.3 --count 12 --out cascade.csv";

/// The period-doubling cascade, forcing by forcing, with Feigenbaum's constants
#[derive(Debug, Args)]
#[command(after_help = AFTER)]
pub(crate) struct DoublingsArgs {
    #[command(flatten)]
    map: MapArgs,
    /// Doublings that are looked for, at most 13
    #[arg(help_heading = OWN, long, allow_negative_numbers = true, short = 'n', value_name = "N", default_value_t = 8)]
    count: usize,
    #[command(flatten)]
    output: OutputArgs,
}

#[derive(Serialize)]
struct Job {
    restitution: f64,
    count: usize,
}

/// Runs the command.
pub(crate) fn run(args: &DoublingsArgs, context: Context) -> Result<(), Failure> {
    if args.map.wrote_template(&args.output, context)? {
        return Ok(());
    }
    args.output.check(true, &args.map.inputs(), None)?;
    let job = Job { restitution: args.map.single_restitution()?, count: args.count };
    let found = doubling_cascade(job.restitution, job.count, &context.watch("doublings"))?;
    let estimates = feigenbaum_estimates(&found);
    let report = Report {
        provenance: provenance("bouncing-disk doublings", &job)?,
        text: text(&found, &estimates),
        table: ready(table(&found, &estimates)),
        data: vec![("doublings", stored(&found)?), ("feigenbaum_estimates", stored(&estimates)?)],
        figure: Some(Box::new(move || pictures::doublings::draw(job.restitution, &found))),
    };
    report.deliver(&args.output, context.quiet)
}

fn text(found: &[CascadeDoubling], estimates: &[FeigenbaumEstimate]) -> String {
    let columns =
        [("number", "1"), ("period", "impacts"), ("axial_forcing", "1"), ("error", "1"), ("width", "rad")];
    let mut table = Table::new(&columns);
    for doubling in found {
        table.push([
            doubling.number.into(),
            doubling.period.into(),
            rounded(doubling.axial_forcing, 13).into(),
            rounded(doubling.forcing_error, 1).into(),
            doubling.width.into(),
        ]);
    }
    let mut text = table.to_text();
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
    text
}

fn table(found: &[CascadeDoubling], estimates: &[FeigenbaumEstimate]) -> Table {
    let mut table = Table::new(&[
        ("number", "1"),
        ("period", "1"),
        ("axial_forcing", "1"),
        ("forcing_error", "1"),
        ("width", "rad"),
        ("multiplier", "1"),
        ("delta", "1"),
        ("delta_error", "1"),
        ("alpha", "1"),
        ("alpha_error", "1"),
    ]);
    for doubling in found {
        let estimate = estimates.iter().find(|estimate| estimate.number == doubling.number);
        table.push([
            doubling.number.into(),
            doubling.period.into(),
            doubling.axial_forcing.into(),
            doubling.forcing_error.into(),
            doubling.width.into(),
            doubling.multiplier.into(),
            estimate.map(|estimate| estimate.delta).into(),
            estimate.map(|estimate| estimate.delta_error).into(),
            estimate.map(|estimate| estimate.alpha).into(),
            estimate.map(|estimate| estimate.alpha_error).into(),
        ]);
    }
    table
}
