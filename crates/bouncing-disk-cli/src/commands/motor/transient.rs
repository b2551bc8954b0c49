//! `bouncing-disk motor transient`: the run-up of a motor from rest.

use bouncing_disk::core::Unobserved;
use bouncing_disk::estimate::{FitSettings, LEAST_MEMBERS, TransientEnsemble, TransientFit};
use bouncing_disk::motor::{SpeedCurve, TransientMember, TransientSettings};
use bouncing_disk::{Motor, Observer};
use bouncing_disk_plot::Figure;
use serde::{Deserialize, Serialize};

use super::settings::begin;
use crate::commands::fit::{estimates, fitted_curve, refusal};
use crate::commands::prelude::*;

/// The run-up from rest, of one motor or many, with its fit
#[derive(Debug, Args)]
#[command(after_help = "\
Each member is a run from rest with another starting phase and seed, as in Fig. 10 of the paper; with five or more \
members alpha_ss (1 - exp(-t/t_c)) is fitted to their mean, with 95 % intervals. In .csv each row is one instant of \
one member, in the columns that `bouncing-disk fit` reads. See docs/designing-a-motor.md.

Examples:
  bouncing-disk motor transient --duration 2 --members 5
  bouncing-disk motor transient motor.toml --members 100 --out run-up.csv --out run-up.png")]
pub(crate) struct TransientArgs {
    #[command(flatten)]
    motor: MotorArgs,
    /// Runs
    #[arg(help_heading = OWN, long, allow_negative_numbers = true, value_name = "N", default_value_t = 10)]
    members: usize,
    /// Duration of a run (s)
    #[arg(help_heading = OWN, long, allow_hyphen_values = true, value_name = "SECONDS", default_value_t = TransientSettings::default().duration)]
    duration: f64,
    /// Equal intervals over which the speed is averaged
    #[arg(help_heading = OWN, long, allow_negative_numbers = true, value_name = "N", default_value_t = TransientSettings::default().intervals)]
    intervals: usize,
    /// Size of the relaunch perturbation, in units of g/omega
    #[arg(help_heading = OWN, long, alias = "perturbation", allow_hyphen_values = true, value_name = "SIZE", default_value_t = TransientSettings::default().relaunch_perturbation)]
    relaunch_perturbation: f64,
    /// Seed of the perturbations and of the starting phases
    #[arg(help_heading = OWN, long, allow_negative_numbers = true, value_name = "SEED", default_value_t = TransientSettings::default().seed)]
    seed: u64,
    #[command(flatten)]
    grid: GridArgs,
    #[command(flatten)]
    output: OutputArgs,
}

pub(super) fn run(args: &TransientArgs, context: Context) -> Result<()> {
    let given = begin(&args.motor, &args.output, true, Some(&args.grid), context)?;
    let Some(motor) = given else { return Ok(()) };
    let job = TransientJob {
        motor,
        members: args.members,
        settings: TransientSettings {
            duration: args.duration,
            intervals: args.intervals,
            relaunch_perturbation: args.relaunch_perturbation,
            seed: args.seed,
            ..TransientSettings::default()
        },
    };
    grid::run(job, &args.grid, &args.output, context)
}

#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct TransientJob {
    motor: Motor,
    members: usize,
    settings: TransientSettings,
}

impl GridJob for TransientJob {
    const COMMAND: &'static str = "motor transient";

    type Row = SpeedCurve;

    type Prepared = Vec<TransientMember>;

    fn rows(&self) -> usize {
        self.members
    }

    fn prepare(&self, _: &dyn Observer) -> Result<Vec<TransientMember>> {
        Ok(TransientMember::of_ensemble(self.motor.system(), &self.settings, self.members)?)
    }

    fn compute(&self, all: &Self::Prepared, rows: Rows, observer: &dyn Observer) -> Result<Vec<Self::Row>> {
        Ok(self.motor.transients(&all[rows], observer)?)
    }

    fn report<'a>(&'a self, _: &'a Vec<TransientMember>, rows: &'a [SpeedCurve]) -> Result<Report<'a>> {
        let fit = (rows.len() >= LEAST_MEMBERS).then(|| TransientFit::new(rows, &FitSettings::default()));
        let ensemble = TransientEnsemble::of_results(rows.iter().cloned().map(Ok).collect(), &Unobserved)?;
        let mut list = Quantities::default();
        list.push("members", ensemble.curves.len(), "1");
        list.push("duration", self.settings.duration, "s");
        let refused = match &fit {
            Some(Ok(fit)) => {
                estimates(fit, &mut list);
                None
            }
            Some(Err(error)) => Some(refusal(error)?),
            None => Some(format!("no intervals: they need {LEAST_MEMBERS} members")),
        };
        // A rejected fit has no numbers; with too few members to judge it, each has its own.
        if fit.is_none() {
            list.push("steady_speed", ensemble.steady_speed.mean, "rad/s");
            list.push("time_constant", ensemble.time_constant.mean, "s");
            list.push("stall_acceleration", ensemble.stall_acceleration.mean, "rad/s^2");
        }
        let columns = Columns::<(f64, f64, usize)>::new()
            .column("time", "s", |row| row.0)
            .column("speed", "rad/s", |row| row.1)
            .column("member", "1", |row| row.2 + 1);
        let instants = ensemble.curves.iter().enumerate().flat_map(|(member, curve)| {
            curve.times.iter().zip(&curve.speeds).map(move |(time, speed)| (*time, *speed, member))
        });
        let table = columns.csv_of(instants.collect());
        let text = list.to_text() + &refused.map_or_else(String::new, |refused| format!("{refused}\n"));
        let judged = fit.is_some();
        let fit = fit.and_then(Result::ok);
        let policy = self.settings.policy;
        Ok(Report {
            provenance: provenance("bouncing-disk motor transient", self)?
                .with_seed(self.settings.seed)
                .with_chatter_policy(policy),
            text,
            table,
            data: vec![
                ("fit", stored(&fit)?),
                ("curves", stored(&ensemble.curves)?),
                ("member_fits", stored(&ensemble.fits)?),
            ],
            figure: Some(Box::new(move || draw(&ensemble, fit.as_ref(), judged))),
        })
    }
}

/// Runs with their fit, or with the fit of the first if they are too few to judge one. A rejected fit is not
/// drawn.
fn draw(ensemble: &TransientEnsemble, fit: Option<&TransientFit>, judged: bool) -> Figure {
    let times = &ensemble.curves[0].times;
    let end = times.last().copied().unwrap_or(1.0);
    let own = ensemble.fits[0];
    let of_one = || {
        pictures::FittedCurve::new((own.steady_speed, own.time_constant), (0.0, end), |time| own.speed(time))
    };
    let runs: Vec<&[f64]> = ensemble.curves.iter().map(|curve| curve.speeds.as_slice()).collect();
    let fit = match fit {
        Some(fit) => Some((fitted_curve(fit, end), "fit of the mean")),
        None if judged => None,
        None => Some((of_one(), "fit of the run")),
    };
    pictures::RunUp { times, runs: &runs, name: "one run", fit }.draw()
}
