//! `bouncing-disk fit`: steady speed and time constant, or parameters of a motor, from measured run-ups.

use std::path::{Path, PathBuf};

use bouncing_disk::Motor;
use bouncing_disk::estimate::{
    CsvColumns, FitError, FitParameter, FitRange, FitSettings, FittedParameter, MeasuredRun, MeasuredSpeeds,
    MeasuredTransient, MotorFit, MotorFitSettings, RatedPoint, SpeedUnit, TimeUnit, TransientFit,
    TransientKind,
};
use bouncing_disk::motor::OperatingSettings;
use bouncing_disk_plot::Figure;

use super::prelude::*;
use crate::failure::unmeasured;
use crate::parameters::{Described as _, Setting, setting};

/// Fits measured run-ups: steady speed and time constant, or parameters of a motor
#[derive(Debug, Args)]
#[command(after_help = "\
The file has the columns time_s, speed_rad_s and, for repeated runs, member, or times and speeds with units in their \
names, such as \"t (ms)\" and \"n (rpm)\"; commas, semicolons or tabs separate them. Without --parameter, alpha_ss - \
b exp(-t/t_c) is fitted to their mean, with 95 % intervals; time zero, dead time and initial speed need not be \
known. --from-rest fits alpha_ss (1 - exp(-t/t_c)) to times that count from the start of the rise, with narrower \
intervals. With --parameter FIELD=LOW:HIGH, parameters of a motor are fitted: friction, restitution, phase_lag \
(rad), amplitude (m), twist_amplitude (rad), contact.time (s), stator.mass (kg), stator.quality, \
stator.twist_per_height (rad/m), each within its range; all others are taken from the motor of --motor or --preset. \
Runs whose speeds rise are run-ups; those whose speeds fall are braking tails with the drive off. The switching time \
and the speed in the first row need not be known.

A table of a maker's rated points has no times. Its columns are speed_rad_s (or \"speed (rpm)\"), speed_error, and \
fields of the data sheet such as load_torque (0 without load), stator.volts or preload_force, each optionally with \
its error (load_torque_error); each line is a point, with speed 0 at the stall torque. See \
docs/designing-a-motor.md.

Examples:
  bouncing-disk fit run-up.csv --out fit.png
  bouncing-disk fit scope.txt --time-column CH1 --speed-column CH2 --time-unit ms --speed-unit rpm
  bouncing-disk fit run-up.csv --motor motor.toml --parameter friction=0.05:0.4
  bouncing-disk fit points.csv --motor motor.toml --parameter stator.mass=0.005:0.1")]
pub(crate) struct FitArgs {
    /// Measured speeds: time_s, speed_rad_s and, for several runs, member
    file: PathBuf,
    /// The motor rises from rest at time zero, without a dead time
    #[arg(help_heading = OWN, long, conflicts_with = "parameter")]
    from_rest: bool,
    /// Name of the time column; other columns are ignored
    #[arg(help_heading = OWN, long, value_name = "NAME")]
    time_column: Option<String>,
    /// Name of the speed column; other columns are ignored
    #[arg(help_heading = OWN, long, value_name = "NAME")]
    speed_column: Option<String>,
    /// Unit of the times, if the file does not state it: s, ms, us, min
    #[arg(help_heading = OWN, long, value_name = "UNIT")]
    time_unit: Option<TimeUnit>,
    /// Unit of the speeds, if the file does not state it: rad/s, rpm, rev/s, deg/s
    #[arg(help_heading = OWN, long, value_name = "UNIT")]
    speed_unit: Option<SpeedUnit>,
    /// A parameter of the motor to fit, and its range; may be repeated
    #[arg(help_heading = OWN, long, value_name = "FIELD=LOW:HIGH", value_parser = fitted)]
    parameter: Vec<FitRange>,
    /// With --parameter: the data sheet of the motor, where the search begins
    #[arg(help_heading = OWN, long, value_name = "FILE", requires = "parameter")]
    motor: Option<PathBuf>,
    /// With --parameter: a motor of the paper instead of a data sheet
    #[arg(help_heading = OWN, long, value_name = "NAME", requires = "parameter", conflicts_with = "motor", value_parser = one_of(Motor::PRESETS))]
    preset: Option<fn() -> Motor>,
    /// With --parameter: sets a field of the data sheet
    #[arg(help_heading = OWN, long, value_name = "KEY=VALUE", requires = "parameter", value_parser = setting)]
    set: Vec<Setting>,
    /// With --parameter: largest number of points in the ranges at which the motor is computed, 8 to 400
    #[arg(help_heading = OWN, long, alias = "evaluations", allow_negative_numbers = true, value_name = "N", requires = "parameter",
          default_value_t = MotorFitSettings::default().most_evaluations)]
    most_evaluations: usize,
    /// For rated points: largest number of impacts for one computed speed, all members together, at least 1
    #[arg(help_heading = OWN, long, allow_negative_numbers = true, value_name = "N", requires = "parameter",
          default_value_t = MotorFitSettings::default().operating.most_impacts)]
    most_impacts: u64,
    /// Resampled fits of run-ups, 200 to 100000
    #[arg(help_heading = OWN, long, allow_negative_numbers = true, value_name = "N", default_value_t = FitSettings::default().resamples)]
    resamples: usize,
    /// Seed of the resampling
    #[arg(help_heading = OWN, long, allow_negative_numbers = true, value_name = "SEED", default_value_t = FitSettings::default().seed)]
    seed: u64,
    #[command(flatten)]
    output: OutputArgs,
}

fn fitted(text: &str) -> Result<FitRange, String> {
    let (name, range) = assignment(text, "a fitted parameter is FIELD=LOW:HIGH, such as friction=0.05:0.4")?;
    let parameter =
        FitParameter::ALL.into_iter().find(|parameter| parameter.name() == name).ok_or_else(|| {
            format!(
                "{name:?} cannot be fitted; choose from {}",
                FitParameter::ALL.map(FitParameter::name).join(", ")
            )
        })?;
    let [low, high] = interval(range)?;
    Ok(FitRange { parameter, low, high })
}

pub(super) fn run(args: &FitArgs, context: Context) -> Result<()> {
    let inputs: Vec<&Path> =
        [Some(&args.file), args.motor.as_ref()].into_iter().flatten().map(PathBuf::as_path).collect();
    // A parameter fit needs its own motor: data of another motor fit the paper's motor badly, without a visible
    // reason.
    if !args.parameter.is_empty() && args.motor.is_none() && args.preset.is_none() {
        let message = "--parameter needs a motor: give its data sheet (--motor FILE) or one of the \
                       paper (--preset NAME)";
        return Err(Failure::Usage(message.to_owned()));
    }
    args.output.check(args.parameter.is_empty(), &inputs, None)?;
    let of_run_ups = args.time_column.is_some() || args.speed_column.is_some() || args.time_unit.is_some();
    if !args.parameter.is_empty() && !of_run_ups {
        let points = RatedPoint::table_from_csv(&args.file, args.speed_unit);
        if let Some(points) = points.map_err(|error| unmeasured(&args.file, error))? {
            return parameters(args, &points, None, context)?.deliver(&args.output, context);
        }
    }
    let columns = CsvColumns {
        time: args.time_column.clone(),
        speed: args.speed_column.clone(),
        time_unit: args.time_unit,
        speed_unit: args.speed_unit,
    };
    let speeds =
        MeasuredSpeeds::from_csv_with(&args.file, &columns).map_err(|error| unmeasured(&args.file, error))?;
    let report = if args.parameter.is_empty() {
        rise(args, speeds, context)?
    } else {
        parameters(args, &[], Some(speeds), context)?
    };
    report.deliver(&args.output, context)
}

fn rise(args: &FitArgs, speeds: MeasuredSpeeds, context: Context) -> Result<Report<'static>> {
    let settings = FitSettings {
        resamples: args.resamples,
        seed: args.seed,
        from_rest: args.from_rest,
        ..FitSettings::default()
    };
    let fit = speeds.fit(&settings, &context.watch("fit"))?;
    let mut list = Quantities::default();
    list.push("runs", speeds.runs().len(), "1");
    list.push("points", fit.points, "1");
    list.push("duration", fit.duration, "s");
    let (time_unit, speed_unit) = speeds.file_units();
    list.push("file_units", format!("{time_unit}, {speed_unit}"), "1");
    if let Some(start_speed) = fit.exponential.start_speed {
        list.push("start_time", fit.start_time, "s");
        list.push_interval("start_speed", start_speed, "rad/s");
        list.push("zero_time", fit.zero_time(), "s");
    }
    estimates(&fit, &mut list);
    let job = json!({ "speeds": speeds, "settings": settings });
    Ok(Report {
        provenance: provenance("bouncing-disk fit", &job)?.with_seed(args.seed),
        text: list.to_text(),
        table: list.into_csv(),
        data: vec![("fit", stored(&fit)?)],
        figure: Some(Box::new(move || draw(&speeds, &fit))),
    })
}

pub(super) fn estimates(fit: &TransientFit, list: &mut Quantities) {
    // From the form that fits: the other form may rise beyond every speed of the run.
    list.push_interval("steady_speed", fit.better().steady_speed, "rad/s");
    list.push_interval("time_constant", fit.time_constant(), "s");
    list.push_interval("stall_acceleration", fit.stall_acceleration(), "rad/s^2");
    list.push("residual", fit.exponential.residual, "rad/s");
    list.push("better_form", format!("{:?}", fit.form).to_lowercase(), "1");
}

/// A fit as drawn, up to a time (s).
pub(super) fn fitted_curve(fit: &TransientFit, end: f64) -> pictures::FittedCurve {
    let numbers = (fit.better().steady_speed.value, fit.time_constant().value);
    pictures::FittedCurve::new(numbers, (fit.start_time, end), |time| fit.better_speed(time))
}

/// Measured runs and their fit; if the runs have different times, only the first.
fn draw(speeds: &MeasuredSpeeds, fit: &TransientFit) -> Figure {
    let times = &speeds.runs()[0].times;
    let runs: Vec<&[f64]> =
        speeds.runs().iter().filter(|run| run.times == *times).map(|run| run.speeds.as_slice()).collect();
    let fit = fitted_curve(fit, times.last().copied().unwrap_or(1.0));
    pictures::RunUp { times, runs: &runs, name: "measured", fit: Some((fit, "fit of the mean")) }.draw()
}

/// The reason for a rejected fit; any other error is a failure.
pub(super) fn refusal(error: &FitError) -> Result<String> {
    match error {
        FitError::Refused(_) => Ok(error.to_string()),
        other => Err((*other).into()),
    }
}

/// The motor whose parameters are fitted.
fn motor_of(args: &FitArgs) -> Result<Motor> {
    MotorArgs { file: args.motor.clone(), preset: args.preset, set: args.set.clone(), template: false }.get()
}

/// Parameters of a motor from points or from runs.
fn parameters(
    args: &FitArgs,
    points: &[RatedPoint],
    runs: Option<MeasuredSpeeds>,
    context: Context,
) -> Result<Report<'static>> {
    let motor = motor_of(args)?;
    let of_runs = runs.iter().flat_map(|runs| motor.warnings_on(runs));
    let warnings = motor.warnings().into_iter().chain(of_runs);
    warnings.for_each(|warning| context.note(&format!("warning: {warning}")));
    let transients: Vec<MeasuredTransient> = runs.into_iter().map(transient).collect();
    for transient in &transients {
        if transient.kind == TransientKind::Braking {
            context.note("the speed falls, so the run is read as a braking tail with the drive off");
        }
    }
    let mut settings = MotorFitSettings::default();
    settings.most_evaluations = args.most_evaluations;
    settings.operating =
        OperatingSettings { seed: args.seed, most_impacts: args.most_impacts, ..settings.operating };
    let watch = context.watch("fit");
    let fit = MotorFit::new(&motor, points, &transients, &args.parameter, &settings, &watch)?;
    let columns = Columns::<FittedParameter>::new()
        .column("parameter", "1", |own| own.range.parameter.name())
        .column("unit", "1", |own| own.range.parameter.unit())
        .column("nominal", "1", |own| own.nominal)
        .column("value", "1", |own| own.value)
        .column("accepted", "1", |own| {
            own.accepted.iter().map(|range| format!("{range:.3}")).collect::<Vec<_>>().join(", or ")
        });
    let job = json!({
        "points": points,
        "transients": transients,
        "motor": motor,
        "ranges": args.parameter,
        "settings": settings,
    });
    Ok(Report {
        provenance: provenance("bouncing-disk parameter fit", &job)?.with_seed(args.seed),
        text: format!("{fit:.3}\n"),
        table: columns.csv_of(fit.parameters.clone()),
        data: vec![("fit", stored(&fit)?)],
        figure: None,
    })
}

/// Runs whose speeds rise are run-ups, and those whose speeds fall braking tails.
fn transient(runs: MeasuredSpeeds) -> MeasuredTransient {
    let end = |of: fn(&[f64]) -> &[f64]| {
        let part = |run: &MeasuredRun| of(&run.speeds).iter().map(|speed| speed.abs()).sum::<f64>();
        runs.runs().iter().map(part).sum::<f64>()
    };
    let first = end(|speeds| &speeds[..speeds.len() / 2]);
    let last = end(|speeds| &speeds[speeds.len() - speeds.len() / 2..]);
    MeasuredTransient::new(if last < first { TransientKind::Braking } else { TransientKind::RunUp }, runs)
}
