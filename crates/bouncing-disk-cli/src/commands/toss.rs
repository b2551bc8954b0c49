//! `bouncing-disk toss`: one toss, or many in succession.

use std::f64::consts::TAU;

use bouncing_disk::core::{ChatterPolicy, Phase};
use bouncing_disk::motion::{PhaseSpan, Snapshot};
use bouncing_disk::parameters::{ContactStatement, DriveParameters};
use bouncing_disk::toss::{
    InitialSpin, MultiTossSettings, OrbitClass, TOSS_START, TossOrbit, TossPerformance, multi_toss,
    single_toss, toss_trajectory,
};
use bouncing_disk::{Engine, Event, InitialCondition, System};
use bouncing_disk_plot::Figure;
use serde::Serialize;

mod driven;

use super::prelude::*;
use crate::output::WriteTable;

/// How the disk turns at the start.
pub(super) const SPINS: Words<InitialSpin> = &[
    ("absolute-rest", "It does not turn", InitialSpin::AbsoluteRest),
    ("with-hand", "It turns with the platform", InitialSpin::RestRelativeToHand),
    ("rest-relative-to-hand", "", InitialSpin::RestRelativeToHand),
];

pub(super) const MOST_INSTANTS: i64 = 1_000_000;

/// Default instants of a motion over this many periods of the platform: fewer would distort the motion of the
/// platform.
pub(super) fn instants(given: Option<u32>, periods: u64) -> u32 {
    const LEAST: u64 = 400;
    const A_PERIOD: u64 = 40;
    let otherwise = (A_PERIOD.saturating_mul(periods)).clamp(LEAST, MOST_INSTANTS.unsigned_abs());
    given.unwrap_or(u32::try_from(otherwise).unwrap_or(u32::MAX))
}

/// One toss of a disk from its platform, or many
#[derive(Debug, Args)]
#[command(after_help = "\
The first toss from rest is the toss of Sec. III of the paper. A contact.time (soft hands) makes the contacts of a \
single toss compliant. With --many the disk is followed through all later tosses (Sec. IV). A [drive] that gives only \
the height leaves the angle a sine, and vice versa; its start_phase (rad) is the phase at the start. A .csv file or \
a picture shows the motion; a .json file contains the motion and the numbers. With --many a picture of more than 20 \
periods of the platform shows the last 20. Units are SI; energies are per unit mass (J/kg). See docs/model.md and \
docs/tutorial.md.

Examples:
  bouncing-disk toss
  bouncing-disk toss --set disk.friction=0.05 --out toss.png
  bouncing-disk toss --set contact.time=0.05
  bouncing-disk toss --many --set platform.angular_frequency=12")]
pub(crate) struct TossArgs {
    #[command(flatten)]
    system: SystemArgs,
    /// Rotation of the disk at the start, at the lowest point of the platform unless the drive has a start_phase
    #[arg(help_heading = OWN, long, alias = "spin", value_name = "SPIN", default_value = "absolute-rest", value_parser = one_of(SPINS))]
    initial_spin: InitialSpin,
    /// Follows the disk through many tosses to its long-term motion
    #[arg(help_heading = OWN, long)]
    many: bool,
    /// With --many: impacts to discard before the motion is judged
    #[arg(help_heading = OWN, long, allow_negative_numbers = true, value_name = "N", default_value_t = 4_000, requires = "many")]
    transient: usize,
    /// With --many: impacts over which the motion is judged
    #[arg(help_heading = OWN, long, allow_negative_numbers = true, value_name = "N", default_value_t = 1_024, requires = "many")]
    examined: usize,
    /// With --many: number of platform periods, from the start, to write to a file of the motion, at most 2^30
    #[arg(help_heading = OWN, long, allow_negative_numbers = true, value_name = "N", default_value_t = 10, requires = "many")]
    periods: u64,
    /// Number of instants to write to a file of the motion, at most a million; by default 40 in each period of
    /// the platform, and at least 400
    #[arg(help_heading = OWN, long, allow_negative_numbers = true, value_name = "N", value_parser = clap::value_parser!(u32).range(2..=MOST_INSTANTS))]
    samples: Option<u32>,
    #[command(flatten)]
    output: OutputArgs,
}

pub(super) fn run(args: &TossArgs, context: Context) -> Result<()> {
    let given = args.system.begin(&args.output, true, None, context)?;
    let Some(DrivenDisk { system, drive }) = given else { return Ok(()) };
    if !drive.is_sine() || system.soft_contact().is_some() {
        return driven::run(&system, &drive, args, context);
    }
    if args.many { many(&system, args, context) } else { single(&system, args, context) }
}

impl TossArgs {
    fn settings(&self) -> MultiTossSettings {
        MultiTossSettings {
            transient_impacts: self.transient,
            examined_impacts: self.examined,
            ..MultiTossSettings::default()
        }
    }
}

fn single(system: &System, args: &TossArgs, context: Context) -> Result<()> {
    let toss = single_toss(system, args.initial_spin)?;
    let trajectory = toss_trajectory(system, args.initial_spin)?;
    let periods = trajectory.end().since(&trajectory.start()).periods;
    let samples = samples(system, trajectory.uniform(instants(args.samples, periods) as usize));
    let told = (quantities(system, &toss), landing_speed(system, args.initial_spin));
    deliver((system, None), args, context, &samples, told, ("performance", stored(&toss)?))
}

/// The numbers of a toss, in the paper's order.
pub(super) fn quantities(system: &System, toss: &TossPerformance) -> Quantities {
    let mut list = Quantities::default();
    list.push("axial_forcing", system.axial_forcing(), "1");
    list.push("angular_forcing", system.angular_forcing(), "1");
    list.push("airborne_speed", toss.airborne_speed, "rad/s");
    list.push("speed_ratio", toss.speed_ratio, "1");
    list.push("efficiency", toss.efficiency, "1");
    list.push("separation_phase", toss.separation_phase, "rad");
    list.push("slides_at_separation", toss.sliding_at_separation, "1");
    list.push("launch_speed", toss.launch_speed, "m/s");
    list.push("rotary_energy_gain", toss.rotary_energy_gain, "J/kg");
    list.push("work_of_normal_force", toss.energy.normal_work, "J/kg");
    list.push("work_of_friction", toss.energy.friction_work, "J/kg");
    list.push("loss_in_friction", toss.energy.friction_loss, "J/kg");
    list
}

fn many(system: &System, args: &TossArgs, context: Context) -> Result<()> {
    let settings = args.settings();
    let start = start(system, args.initial_spin)?;
    // Before the long part, so that an illegal number of periods is an error at once.
    let mut engine = Engine::new(system, start, ChatterPolicy::Complete)?;
    let span = PhaseSpan { periods: args.periods, remainder: 0.0 };
    let instants = instants(args.samples, args.periods) as usize;
    let motion = engine.sample(span, instants, &context.watch("motion of the toss"))?;
    let orbit = multi_toss(system, start, settings, &context.watch("toss"))?;
    let told = (described(system, &orbit), landing_speed(system, args.initial_spin));
    deliver((system, None), args, context, &samples(system, motion), told, ("orbit", stored(&orbit)?))
}

/// The speed of the impact that ends the first flight (m/s); `None` if there is no flight.
fn landing_speed(system: &System, spin: InitialSpin) -> Option<f64> {
    let trajectory = toss_trajectory(system, spin).ok()?;
    match trajectory.records().last()?.event {
        Event::Impact { axial_impact_velocity, .. } => {
            Some(axial_impact_velocity.abs() * system.scales().velocity)
        }
        _ => None,
    }
}

/// At rest on the platform at its lowest point, as a single toss starts.
fn start(system: &System, spin: InitialSpin) -> Result<InitialCondition> {
    let phase = Phase::new(TOSS_START)?;
    let angular_speed = match spin {
        InitialSpin::AbsoluteRest => 0.0,
        _ => system.dimensionless().platform_angular_speed(phase),
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
        OrbitClass::Chaotic { lyapunov_exponent } => {
            list.push("motion", "chaotic", "1");
            list.push("lyapunov_exponent", lyapunov_exponent.exponent, "per impact");
            list.push("lyapunov_exponent_error", lyapunov_exponent.standard_error, "per impact");
        }
        OrbitClass::Undecided { impacts, lyapunov_exponent } => {
            list.push("motion", "undecided", "1");
            list.push("reason", orbit.class.reason(), "1");
            list.push("impacts", *impacts, "1");
            list.push("lyapunov_exponent", lyapunov_exponent.map(|own| own.exponent), "per impact");
            let error = lyapunov_exponent.map(|own| own.standard_error);
            list.push("lyapunov_exponent_error", error, "per impact");
        }
        OrbitClass::AtRest => list.push("motion", "at rest on the platform for ever", "1"),
        _ => list.push("motion", "unknown", "1"),
    }
    let unit = system.scales().angular_speed;
    list.push("mean_angular_speed", orbit.mean_angular_speed.map(|speed| speed * unit), "rad/s");
    list.push("rotation_repeats", orbit.rotation_repeats, "1");
    list
}

/// Disk and platform at an instant, in SI units.
#[derive(Debug, Clone, Copy, Serialize)]
pub(super) struct Sample {
    time_s: f64,
    disk_height_m: f64,
    platform_height_m: f64,
    disk_angle_rad: f64,
    platform_angle_rad: f64,
    disk_angular_speed_rad_s: f64,
    platform_angular_speed_rad_s: f64,
}

/// Disk and platform in SI units; the time is 0 at the first instant.
pub(super) fn samples(system: &System, motion: impl IntoIterator<Item = Snapshot>) -> Vec<Sample> {
    let scales = system.scales();
    let mut start = None;
    let sample = |snapshot: Snapshot| {
        let (disk, platform) = (scales.state(&snapshot.disk), snapshot.platform);
        let time = scales.time_seconds(snapshot.time);
        Sample {
            time_s: time - *start.get_or_insert(time),
            disk_height_m: disk.height,
            platform_height_m: platform.height * scales.length,
            disk_angle_rad: disk.angle,
            platform_angle_rad: platform.angle * scales.angle,
            disk_angular_speed_rad_s: disk.angular_speed,
            platform_angular_speed_rad_s: platform.angular_speed * scales.angular_speed,
        }
    };
    motion.into_iter().map(sample).collect()
}

fn deliver(
    (system, drive): (&System, Option<&DriveParameters>),
    args: &TossArgs,
    context: Context,
    samples: &[Sample],
    (mut list, landing_speed): (Quantities, Option<f64>),
    found: (&'static str, json::Data<'_>),
) -> Result<()> {
    let many = |value: u64| args.many.then_some(value);
    let mut job = json!({
        "system": system,
        "spin": args.initial_spin,
        "many": args.many,
        "samples": samples.len(),
        "transient_impacts": many(args.transient as u64),
        "examined_impacts": many(args.examined as u64),
        "periods": many(args.periods),
    });
    if let Some(drive) = drive.filter(|drive| !drive.is_sine()) {
        job["drive"] = json!(drive);
    }
    let contact = system.contact_statement(landing_speed);
    for (name, value) in ContactStatement::rows(contact.as_ref()) {
        list.push(name, value, "1");
    }
    for warning in contact.iter().flat_map(ContactStatement::warnings) {
        list.push("warning", warning.to_string(), "1");
    }
    let text = list.to_text();
    let period = args.many.then(|| TAU / system.platform().angular_frequency());
    let report = Report {
        provenance: provenance("bouncing-disk toss", &job)?,
        text,
        table: write_table(samples),
        data: vec![found, ("contact", stored(&contact)?), ("motion", json::list(|| samples.iter()))],
        figure: Some(Box::new(move || picture(samples, period))),
    };
    report.deliver(&args.output, context)
}

/// The picture of a motion; see [`pictures::toss`].
pub(super) fn picture(samples: &[Sample], period: Option<f64>) -> Figure {
    let instant = |own: &Sample| pictures::TossInstant {
        time: own.time_s,
        heights: [own.disk_height_m, own.platform_height_m],
        angles: [own.disk_angle_rad, own.platform_angle_rad],
        angular_speeds: [own.disk_angular_speed_rad_s, own.platform_angular_speed_rad_s],
    };
    pictures::toss(&samples.iter().map(instant).collect::<Vec<_>>(), period)
}

pub(super) fn write_table(samples: &[Sample]) -> WriteTable<'_> {
    Box::new(move |to| {
        let mut csv = csv::Writer::from_writer(to);
        samples.iter().try_for_each(|sample| csv.serialize(sample))?;
        csv.flush()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_period_of_the_platform_has_instants_enough() {
        for (periods, expected) in [(0, 400), (10, 400), (11, 440), (400, 16_000), (u64::MAX, 1_000_000)] {
            assert_eq!(instants(None, periods), expected);
            assert_eq!(instants(Some(7), periods), 7);
        }
    }
}
