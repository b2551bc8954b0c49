//! `bouncing-disk toss`: a single toss, or many on end.

use bouncing_disk::core::{ChatterPolicy, Phase};
use bouncing_disk::{
    Engine, InitialCondition, InitialSpin, MultiTossSettings, OrbitClass, System, TOSS_START, TossOrbit,
    TossPerformance, Trajectory, multi_toss_observed, single_toss, toss_trajectory,
};
use clap::{Args, ValueEnum};
use serde::Serialize;

use crate::arguments::{OWN, OutputArgs};
use crate::commands::map::wrote_template;
use crate::context::Context;
use crate::failure::Failure;
use crate::output::report::{Report, provenance, ready, value};
use crate::output::table::{Quantities, Table};
use crate::parameters::system::SystemArgs;
use crate::pictures;

/// What stands at the end of the help.
const AFTER: &str = "\
The first toss from rest is that of Sec. III of the paper; with --many the disk is followed through all tosses that come \
after it (Sec. IV). .csv and pictures show the motion, .json has both the motion and the numbers. Units are SI; energies \
are per unit mass (J/kg). See docs/model.md and docs/tutorial.md.

Examples:
  bouncing-disk toss
  bouncing-disk toss --set disk.friction=0.05 --out toss.png
  bouncing-disk toss --many --set platform.angular_frequency=12";

/// How the disk turns at the start.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Spin {
    /// It does not turn
    AbsoluteRest,
    /// It turns with the platform
    RestRelativeToHand,
}

impl From<Spin> for InitialSpin {
    fn from(spin: Spin) -> Self {
        match spin {
            Spin::AbsoluteRest => Self::AbsoluteRest,
            Spin::RestRelativeToHand => Self::RestRelativeToHand,
        }
    }
}

/// One toss of a disk from its platform, or many
#[derive(Debug, Args)]
#[command(after_help = AFTER)]
pub(crate) struct TossArgs {
    #[command(flatten)]
    system: SystemArgs,
    /// How the disk turns at the start, at the lowest point of the platform
    #[arg(help_heading = OWN, long, value_name = "SPIN", default_value = "absolute-rest")]
    spin: Spin,
    /// Follows the disk through many tosses, and says what it settles on
    #[arg(help_heading = OWN, long)]
    many: bool,
    /// With --many: impacts that are not looked at before the motion is judged
    #[arg(help_heading = OWN, long, value_name = "N", default_value_t = 4_000, requires = "many")]
    transient: usize,
    /// With --many: impacts that the motion is judged by
    #[arg(help_heading = OWN, long, value_name = "N", default_value_t = 1_024, requires = "many")]
    examined: usize,
    /// With --many: periods of the platform in the file of the motion, from the start
    #[arg(help_heading = OWN, long, value_name = "N", default_value_t = 10, requires = "many")]
    periods: u64,
    /// Instants of the motion in a file
    #[arg(help_heading = OWN, long, value_name = "N", default_value_t = 400, value_parser = clap::value_parser!(u32).range(2..=1_000_000))]
    samples: u32,
    #[command(flatten)]
    output: OutputArgs,
}

#[derive(Serialize)]
struct Job<'a> {
    system: &'a System,
    spin: InitialSpin,
    many: bool,
    samples: u32,
    transient_impacts: Option<usize>,
    examined_impacts: Option<usize>,
    periods: Option<u64>,
}

/// Runs the command.
pub(crate) fn run(args: &TossArgs, context: Context) -> Result<(), Failure> {
    if wrote_template(&args.system)? {
        return Ok(());
    }
    args.output.check(true)?;
    let system = args.system.system()?;
    let report = if args.many { many(&system, args, context)? } else { single(&system, args)? };
    report.deliver(&args.output, context.quiet)
}

fn job<'a>(system: &'a System, args: &TossArgs) -> Job<'a> {
    let many = |value: usize| args.many.then_some(value);
    Job {
        system,
        spin: args.spin.into(),
        many: args.many,
        samples: args.samples,
        transient_impacts: many(args.transient),
        examined_impacts: many(args.examined),
        periods: args.many.then_some(args.periods),
    }
}

fn single(system: &System, args: &TossArgs) -> Result<Report, Failure> {
    let toss = single_toss(system, args.spin.into())?;
    let trajectory = toss_trajectory(system, args.spin.into())?;
    let text = quantities(system, &toss).to_text();
    report(system, args, &trajectory, text, vec![("performance", value(&toss)?)])
}

/// The numbers of a toss, in the order in which the paper speaks of them.
pub(crate) fn quantities(system: &System, toss: &TossPerformance) -> Quantities {
    let mut list = Quantities::default();
    list.push("axial_forcing", system.axial_forcing(), "1");
    list.push("angular_forcing", system.angular_forcing(), "1");
    list.push("airborne_speed", toss.airborne_speed, "rad/s");
    list.push("speed_ratio", toss.speed_ratio, "1");
    list.push("efficiency", toss.efficiency, "1");
    list.push("separation_phase", toss.separation_phase, "rad");
    list.push("slides_at_separation", if toss.sliding_at_separation { "yes" } else { "no" }, "1");
    list.push("launch_speed", toss.launch_speed, "m/s");
    list.push("rotary_energy_gain", toss.rotary_energy_gain, "J/kg");
    list.push("work_of_normal_force", toss.energy.normal_work, "J/kg");
    list.push("work_of_friction", toss.energy.friction_work, "J/kg");
    list.push("loss_in_friction", toss.energy.friction_loss, "J/kg");
    list
}

fn many(system: &System, args: &TossArgs, context: Context) -> Result<Report, Failure> {
    let settings = MultiTossSettings {
        transient_impacts: args.transient,
        examined_impacts: args.examined,
        ..MultiTossSettings::default()
    };
    let start = start(system, args.spin)?;
    let orbit = multi_toss_observed(system, start, settings, &context.watch("toss"))?;
    let mut engine = Engine::new(system, start, ChatterPolicy::Complete)?;
    let periods = args.periods;
    let motion = Trajectory::record(&mut engine, |record| record.time.periods >= periods)?;
    let text = described(system, &orbit).to_text();
    report(system, args, &motion, text, vec![("orbit", value(&orbit)?)])
}

/// At rest on the platform at its lowest point, as a single toss starts.
fn start(system: &System, spin: Spin) -> Result<InitialCondition, Failure> {
    let phase = Phase::new(TOSS_START)?;
    let angular_speed = match spin {
        Spin::AbsoluteRest => 0.0,
        Spin::RestRelativeToHand => system.dimensionless().platform_angular_speed(phase),
    };
    Ok(InitialCondition::Contact { phase, angular_speed })
}

fn described(system: &System, orbit: &TossOrbit) -> Quantities {
    let mut list = Quantities::default();
    list.push("axial_forcing", system.axial_forcing(), "1");
    list.push("angular_forcing", system.angular_forcing(), "1");
    match &orbit.class {
        OrbitClass::Periodic { period, platform_periods, vertical, rotary } => {
            list.push("motion", "periodic", "1");
            list.push("impacts", *period, "1");
            list.push("platform_periods", *platform_periods, "1");
            list.push("largest_vertical_multiplier", vertical.spectral_radius(), "1");
            list.push("rotary_multiplier", *rotary, "1");
        }
        OrbitClass::Chattering(cycle) => {
            list.push("motion", "comes to rest again and again", "1");
            list.push("impacts", cycle.impacts, "1");
            list.push("platform_periods", cycle.platform_periods, "1");
            list.push("long_flights", cycle.long_flights, "1");
        }
        OrbitClass::ChaoticOrLong { impacts, lyapunov_exponent } => {
            list.push("motion", "chaotic, or of a long period", "1");
            list.push("impacts", *impacts, "1");
            list.push("lyapunov_exponent", *lyapunov_exponent, "1");
        }
        OrbitClass::AtRest => list.push("motion", "at rest on the platform for ever", "1"),
        _ => list.push("motion", "unknown", "1"),
    }
    let unit = system.scales().angular_speed;
    list.push("mean_angular_speed", orbit.mean_angular_speed.map(|speed| speed * unit), "rad/s");
    let repeats = orbit.rotation_repeats.map(|repeats| if repeats { "yes" } else { "no" });
    list.push("rotation_repeats", repeats, "1");
    list
}

/// Disk and platform at an instant, in SI units.
#[derive(Debug, Clone, Copy, Serialize)]
pub(crate) struct Sample {
    pub(crate) time_s: f64,
    pub(crate) disk_height_m: f64,
    pub(crate) platform_height_m: f64,
    pub(crate) disk_angle_rad: f64,
    pub(crate) platform_angle_rad: f64,
    pub(crate) disk_angular_speed_rad_s: f64,
    pub(crate) platform_angular_speed_rad_s: f64,
}

/// Disk and platform at so many instants; the time is 0 at the start.
pub(crate) fn samples(system: &System, motion: &Trajectory, count: u32) -> Vec<Sample> {
    let scales = system.scales();
    let start = scales.time_seconds(motion.start());
    motion
        .uniform(count as usize)
        .map(|snapshot| {
            let disk = scales.state(&snapshot.disk);
            let platform = snapshot.platform;
            Sample {
                time_s: scales.time_seconds(snapshot.time) - start,
                disk_height_m: disk.height,
                platform_height_m: platform.height * scales.length,
                disk_angle_rad: disk.angle,
                platform_angle_rad: platform.angle * scales.angle,
                disk_angular_speed_rad_s: disk.angular_speed,
                platform_angular_speed_rad_s: platform.angular_speed * scales.angular_speed,
            }
        })
        .collect()
}

fn report(
    system: &System,
    args: &TossArgs,
    motion: &Trajectory,
    text: String,
    found: Vec<(&'static str, serde_json::Value)>,
) -> Result<Report, Failure> {
    let samples = samples(system, motion, args.samples);
    let mut data = found;
    data.push(("motion", value(&samples)?));
    Ok(Report {
        provenance: provenance("bouncing-disk toss", &job(system, args))?,
        text,
        table: ready(table(&samples)),
        data,
        figure: Some(Box::new(move || pictures::toss::draw(&samples))),
    })
}

/// The motion as a table.
pub(crate) fn table(samples: &[Sample]) -> Table {
    let mut table = Table::new(&[
        ("time", "s"),
        ("disk_height", "m"),
        ("platform_height", "m"),
        ("disk_angle", "rad"),
        ("platform_angle", "rad"),
        ("disk_angular_speed", "rad/s"),
        ("platform_angular_speed", "rad/s"),
    ]);
    for sample in samples {
        table.push(
            [
                sample.time_s,
                sample.disk_height_m,
                sample.platform_height_m,
                sample.disk_angle_rad,
                sample.platform_angle_rad,
                sample.disk_angular_speed_rad_s,
                sample.platform_angular_speed_rad_s,
            ]
            .map(Into::into),
        );
    }
    table
}
