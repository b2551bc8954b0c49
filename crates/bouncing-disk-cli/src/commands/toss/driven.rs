//! Tosses on a drive that is not a sine, or with contacts that take time.

use std::f64::consts::TAU;

use bouncing_disk::core::{ChatterPolicy, Phase};
use bouncing_disk::driven::{
    DrivenStart, DrivenSystem, Schedule, ScheduleSegment, ScheduledEngine, ScheduledRecord, multi_toss,
    single_toss,
};
use bouncing_disk::parameters::{DriveParameters, DrivenPlatform};
use bouncing_disk::toss::InitialSpin;
use bouncing_disk::{Event, System};
use serde::Serialize;

use super::{Sample, TossArgs, deliver, described, instants, quantities};
use crate::commands::prelude::*;

/// Most events in which a disk is expected to come down.
const MOST_EVENTS: usize = 10_000;

pub(super) fn run(system: &System, drive: &DriveParameters, args: &TossArgs, context: Context) -> Result<()> {
    if args.many {
        // Cycles and exponents are those of rigid impacts.
        system.rigid()?;
    }
    let own = (system, Some(drive));
    let period = TAU / system.platform().angular_frequency();
    let platform = DrivenPlatform::of_drive(*system.platform(), drive);
    let platform = platform.map(|platform| platform.with_contact(system.soft_contact()));
    let of_disk = match &platform {
        Ok(platform) => Some(DrivenSystem::new(platform, system.disk())?),
        Err(_) => None,
    };
    let lowest = of_disk.as_ref().map_or(0.0, |of_disk| of_disk.height().lowest_phase());
    let motion = motion(system, drive, lowest, args.spin)?;
    let toss = match &platform {
        Ok(platform) if !args.many => Some(single_toss(platform, system.disk(), None, args.spin)?),
        _ => None,
    };
    let landing = landing(motion.clone());
    let speed = landing.as_ref().ok().map(|(_, speed)| *speed);
    let end = if args.many { args.periods as f64 * period } else { landing?.0 };
    let instants = instants(args.samples, (end / period) as u64) as usize;
    let (impacts, samples) = sampled(motion, end, instants)?;
    if let Some(toss) = toss {
        let told = (String::new(), quantities(system, &toss), speed);
        return deliver(own, args, context, &samples, told, ("performance", stored(&toss)?));
    }
    let Some(of_disk) = of_disk else {
        let columns = Columns::<Impact>::new()
            .column("time", "s", |row| row.time_s)
            .column("segment", "1", |row| row.segment)
            .column("impact_velocity", "m/s", |row| row.impact_velocity_m_s)
            .column("angular_speed", "rad/s", |row| row.angular_speed_rad_s);
        let text = columns.to_text(&impacts);
        let told = (text, Quantities::default(), speed);
        return deliver(own, args, context, &samples, told, ("impacts", stored(&impacts)?));
    };
    let phase = Phase::new(lowest)?;
    let angular_speed = match args.spin {
        InitialSpin::AbsoluteRest => 0.0,
        _ => of_disk.angle().velocity(phase.angle()),
    };
    let start = DrivenStart::Contact { phase, angular_speed };
    let orbit = multi_toss(of_disk, start, &args.settings(), &context.watch("toss"))?;
    let told = (String::new(), described(system, &orbit), speed);
    deliver(own, args, context, &samples, told, ("orbit", stored(&orbit)?))
}

/// The motion from rest on the platform; a periodic drive starts at its lowest point.
fn motion(
    system: &System,
    drive: &DriveParameters,
    lowest: f64,
    spin: InitialSpin,
) -> Result<ScheduledEngine> {
    let mut drive = drive.clone();
    if !drive.is_schedule() {
        (drive.start_phase, drive.segments) = (lowest, vec![ScheduleSegment::default()]);
    }
    let schedule = Schedule::of_drive(system, &drive)?;
    let at_rest = |speed| ScheduledEngine::at_rest(&schedule, system.disk(), speed, ChatterPolicy::Complete);
    let motion = at_rest(0.0)?;
    let (engine, unit) = (motion.engine(), motion.scales_of(0).map_or(0.0, |scales| scales.angular_speed));
    Ok(match spin {
        InitialSpin::AbsoluteRest => motion,
        _ => at_rest(engine.system().angle().velocity(engine.time().phase.angle()) * unit)?,
    })
}

/// When the disk comes down for the first time (s), and at which speed (m/s).
fn landing(mut motion: ScheduledEngine) -> Result<(f64, f64)> {
    for _ in 0..MOST_EVENTS {
        let Some(event) = motion.advance()? else { break };
        if let Event::Impact { axial_impact_velocity, .. } = event.record.event {
            let unit = motion.scales_of(event.segment).map_or(f64::NAN, |scales| scales.velocity);
            return Ok((event.time, axial_impact_velocity.abs() * unit));
        }
    }
    Err(Failure::Failed(format!(
        "the disk does not leave its platform and come down in {MOST_EVENTS} events"
    )))
}

/// An impact in SI units.
#[derive(Debug, Clone, Copy, Serialize)]
struct Impact {
    time_s: f64,
    segment: usize,
    impact_velocity_m_s: f64,
    angular_speed_rad_s: f64,
}

/// The impacts up to a time (s), and the motion at so many instants of equal distances.
fn sampled(mut now: ScheduledEngine, end: f64, count: usize) -> Result<(Vec<Impact>, Vec<Sample>)> {
    let (mut impacts, mut samples) = (Vec::new(), Vec::with_capacity(count));
    let mut next = now.clone();
    let mut coming = next.advance()?;
    for instant in 0..count {
        // The last one is the end itself, not a rounding before.
        let time = if instant + 1 < count { end * instant as f64 / (count - 1) as f64 } else { end };
        while let Some(ScheduledRecord { segment, time: time_s, record }) =
            coming.filter(|own| own.time <= time)
        {
            if let Event::Impact { axial_impact_velocity, .. } | Event::Kick { axial_impact_velocity, .. } =
                record.event
                && let Some(scales) = now.scales_of(segment)
            {
                impacts.push(Impact {
                    time_s,
                    segment,
                    impact_velocity_m_s: axial_impact_velocity * scales.velocity,
                    angular_speed_rad_s: record.after.angular_speed * scales.angular_speed,
                });
            }
            now.clone_from(&next);
            coming = next.advance()?;
        }
        let (disk, platform) = now.states_after(time - now.time());
        samples.push(Sample {
            time_s: time,
            disk_height_m: disk.height,
            platform_height_m: platform.height,
            disk_angle_rad: disk.angle,
            platform_angle_rad: platform.angle,
            disk_angular_speed_rad_s: disk.angular_speed,
            platform_angular_speed_rad_s: platform.angular_speed,
        });
    }
    Ok((impacts, samples))
}
