//! Tosses on a drive that is not a sine, or with compliant contacts.

use std::f64::consts::TAU;

use bouncing_disk::core::{ChatterPolicy, Phase};
use bouncing_disk::driven::{DrivenEngine, DrivenStart, DrivenSystem, multi_toss, single_toss};
use bouncing_disk::parameters::{DimensionlessSystem, DriveParameters, Scales};
use bouncing_disk::toss::InitialSpin;
use bouncing_disk::{Event, System};

use super::{Sample, TossArgs, deliver, described, instants, quantities};
use crate::commands::prelude::*;

/// Largest number of events before a disk is expected to come down.
const MOST_EVENTS: usize = 10_000;

pub(super) fn run(system: &System, drive: &DriveParameters, args: &TossArgs, context: Context) -> Result<()> {
    if args.many {
        // Cycles and exponents exist only for rigid impacts.
        DimensionlessSystem::try_from(system)?;
    }
    let own = (system, Some(drive));
    let period = TAU / system.platform().angular_frequency();
    let platform = system.driven_platform(drive)?;
    let of_disk = DrivenSystem::new(&platform, system.disk())?;
    let phase = Phase::new(drive.start_phase.unwrap_or_else(|| of_disk.height().lowest_phase()))?;
    let angular_speed = match args.initial_spin {
        InitialSpin::AbsoluteRest => 0.0,
        _ => of_disk.angle().velocity(phase.angle()),
    };
    let start = DrivenStart::Contact { phase, angular_speed };
    let engine = DrivenEngine::new(of_disk.clone(), start, ChatterPolicy::Complete)?;
    let motion = Timed { engine, radians: 0.0, scales: platform.scales(system.disk()) };
    let landing = landing(motion.clone());
    let speed = landing.as_ref().ok().map(|(_, speed)| *speed);
    let single = || single_toss(&platform, system.disk(), Some(phase), args.initial_spin);
    let toss = (!args.many).then(single).transpose()?;
    let end = if args.many { args.periods as f64 * period } else { landing?.0 };
    let samples = sampled(motion, end, instants(args.samples, (end / period) as u64) as usize)?;
    if let Some(toss) = toss {
        let told = (quantities(system, &toss), speed);
        return deliver(own, args, context, &samples, told, ("performance", stored(&toss)?));
    }
    let orbit = multi_toss(of_disk, start, &args.settings(), &context.watch("toss"))?;
    let told = (described(system, &orbit), speed);
    deliver(own, args, context, &samples, told, ("orbit", stored(&orbit)?))
}

/// A motion with its time since the start.
#[derive(Clone)]
struct Timed {
    engine: DrivenEngine,
    /// Since the start (rad).
    radians: f64,
    scales: Scales,
}

impl Timed {
    /// Time of the last event since the start (s).
    fn time(&self) -> f64 {
        self.radians * self.scales.time
    }

    fn advance(&mut self) -> Result<Option<Event>> {
        let Some(record) = self.engine.advance()? else { return Ok(None) };
        self.radians += record.span.radians();
        Ok(Some(record.event))
    }

    /// Disk and platform at this time (s), up to the next event.
    fn sample(&self, time_s: f64) -> Sample {
        let (time, disk) = self.engine.state_after((time_s - self.time()) / self.scales.time);
        let (disk, at) = (self.scales.state(&disk), time.phase.angle());
        let (height, angle) = (self.engine.system().height(), self.engine.system().angle());
        Sample {
            time_s,
            disk_height_m: disk.height,
            platform_height_m: height.height(at) * self.scales.length,
            disk_angle_rad: disk.angle,
            platform_angle_rad: angle.height(at) * self.scales.angle,
            disk_angular_speed_rad_s: disk.angular_speed,
            platform_angular_speed_rad_s: angle.velocity(at) * self.scales.angular_speed,
        }
    }
}

/// When the disk comes down for the first time (s), and at which speed (m/s).
fn landing(mut motion: Timed) -> Result<(f64, f64)> {
    for _ in 0..MOST_EVENTS {
        let Some(event) = motion.advance()? else { break };
        if let Event::Impact { axial_impact_velocity, .. } = event {
            return Ok((motion.time(), axial_impact_velocity.abs() * motion.scales.velocity));
        }
    }
    Err(Failure::Failed(format!("the disk does not leave the platform and land within {MOST_EVENTS} events")))
}

/// The motion up to a time (s) at this many equidistant instants.
fn sampled(mut now: Timed, end: f64, count: usize) -> Result<Vec<Sample>> {
    let mut samples = Vec::with_capacity(count);
    let mut next = now.clone();
    let mut goes_on = next.advance()?.is_some();
    for instant in 0..count {
        // The last instant is the end itself, without rounding.
        let time = if instant + 1 < count { end * instant as f64 / (count - 1) as f64 } else { end };
        while goes_on && next.time() <= time {
            now.clone_from(&next);
            goes_on = next.advance()?.is_some();
        }
        samples.push(now.sample(time));
    }
    Ok(samples)
}
