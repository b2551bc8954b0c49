//! A start-up: a first motion takes a dough that rests in the hand to the fast orbit of the semielliptical
//! motion, which does not reach it alone (Sec. IV B of the paper: performers begin with a linear motion). It
//! searches first motions, and repeats the safest with errors of 2 %. One engine follows the other: the disk
//! goes on in the state in which the first motion leaves it.
//!
//!     cargo run --release -p bouncing-disk --example start_up
#![allow(clippy::print_stdout, reason = "an example shows its result")]

use std::f64::consts::{PI, TAU};

use bouncing_disk::core::numerics::random::SplitMix64;
use bouncing_disk::core::{ChatterPolicy, Phase};
use bouncing_disk::driven::{DrivenEngine, DrivenStart, DrivenSystem};
use bouncing_disk::motion::{Mode, PhaseTime};
use bouncing_disk::parameters::DrivenPlatform;
use bouncing_disk::{Error, Event, System};

/// The quantities with errors: amplitude and frequency of the first motion as factors of those of the second,
/// the forcing of the second, and the restitution.
#[derive(Clone, Copy)]
struct StartUp {
    periods: f64,
    amplitude: f64,
    frequency: f64,
    forcing: f64,
    restitution: f64,
}

/// Periods of the second motion, counted from the start, after which the last impacts are examined.
const PERIODS: f64 = 40.0;

/// Phase lag of the fastest rotation.
const LAG: f64 = -0.26 * PI;

fn main() -> Result<(), Error> {
    let mut works = Vec::new();
    for k in 0..720 {
        let (periods, amplitude, frequency) = (1 + k % 3, 5 + k / 3 % 16, 6 + k / 48);
        let start_up = StartUp {
            periods: f64::from(periods),
            amplitude: 0.1 * f64::from(amplitude),
            frequency: 0.1 * f64::from(frequency),
            forcing: 0.47,
            restitution: 0.5,
        };
        if start_up.reaches_orbit()? {
            works.push((start_up.successes(20)?, start_up));
        }
    }
    println!("{} of 720 first motions reach the fast orbit", works.len());
    let alone = StartUp { periods: 0.0, amplitude: 1.0, frequency: 1.0, forcing: 0.47, restitution: 0.5 };
    println!("the semielliptical motion alone reaches it: {}", alone.reaches_orbit()?);
    let Some((_, best)) = works.into_iter().max_by_key(|(successes, _)| *successes) else { return Ok(()) };
    let successes = best.successes(400)?;
    println!(
        "{} periods and a quarter with amplitude x{:.1}, frequency x{:.1}: {successes} of 400 with errors of 2 % succeed",
        best.periods, best.amplitude, best.frequency
    );
    Ok(())
}

impl StartUp {
    /// The dough of Table I on its hand with this forcing, and with factors of amplitude and frequency.
    fn system(&self, amplitude: f64, frequency: f64, lag: f64) -> Result<System, Error> {
        let table = System::pizza_toss();
        let hand = table.with_platform(|hand| {
            hand.amplitude *= amplitude * self.forcing / table.axial_forcing();
            hand.twist_amplitude *= amplitude;
            hand.angular_frequency *= frequency;
            hand.phase_lag = lag;
        });
        hand?.with_disk(|dough| dough.restitution = self.restitution)
    }

    /// The second motion from where it follows the first one: from the lowest point in phase, up to height zero, where
    /// the two motions join. The hand changes its velocity there, and with it the dough in it: it leaves or is hit.
    fn second_motion(&self) -> Result<DrivenEngine, Error> {
        let lag = if self.periods > 0.0 { 0.0 } else { LAG };
        let (first, second) =
            (self.system(self.amplitude, self.frequency, lag)?, self.system(1.0, 1.0, LAG)?);
        let of =
            |system: &System| DrivenSystem::new(&DrivenPlatform::from(*system.platform()), system.disk());
        let start = DrivenStart::Contact { phase: Phase::new(1.5 * PI)?, angular_speed: 0.0 };
        let mut engine = DrivenEngine::new(of(&first)?, start, ChatterPolicy::Complete)?;
        let mut left = (self.periods + 0.25) * TAU;
        loop {
            let mut next = engine.clone();
            match next.advance()?.map(|record| record.span.radians()) {
                Some(span) if span < left => (engine, left) = (next, left - span),
                _ => break,
            }
        }
        let (time, mut disk) = engine.state_after(left);
        let gap = disk.height - engine.system().height().height(time.phase.angle());
        // From the units of the one motion to those of the other.
        let faster = first.scales().velocity / second.scales().velocity;
        let (joint, second) = (Phase::new(0.0)?, of(&second)?);
        disk.height = second.height().height(joint.angle());
        if disk.mode == Mode::Flight {
            disk.height += gap.max(0.0) * faster * faster;
        }
        disk.axial_velocity *= faster;
        disk.angular_speed *= faster;
        if (disk.axial_velocity - second.height().velocity(joint.angle())).abs() > 1e-9 {
            disk.mode = Mode::Flight;
        }
        DrivenEngine::of_state(second, PhaseTime::in_first_period(joint), disk, ChatterPolicy::Complete)
    }

    /// Whether the last impacts are one period apart, within a tenth: near a doubling orbits settle slowly.
    fn reaches_orbit(&self) -> Result<bool, Error> {
        let mut elapsed = (self.periods + 0.25) / self.frequency;
        let mut impacts = Vec::new();
        for record in self.second_motion()? {
            let record = record?;
            elapsed += record.span.radians() / TAU;
            match record.event {
                Event::Impact { .. } => impacts.push(elapsed),
                Event::Attachment { .. } => impacts.clear(),
                _ => {}
            }
            if elapsed > PERIODS {
                break;
            }
        }
        let steady = |two: &[f64]| (two[1] - two[0] - 1.0).abs() < 0.1;
        Ok(impacts.len() > 8 && impacts[impacts.len() - 8..].windows(2).all(steady))
    }

    /// How many repetitions succeed, with uniform errors of up to 2 % in all but the number of periods.
    fn successes(&self, repetitions: usize) -> Result<usize, Error> {
        let mut random = SplitMix64::new(1);
        let mut successes = 0;
        for _ in 0..repetitions {
            let mut off = |value: f64| value * (1.0 + 0.02 * (2.0 * random.unit() - 1.0));
            let other = Self {
                periods: self.periods,
                amplitude: off(self.amplitude),
                frequency: off(self.frequency),
                forcing: off(self.forcing),
                restitution: off(self.restitution),
            };
            successes += usize::from(other.reaches_orbit()?);
        }
        Ok(successes)
    }
}
