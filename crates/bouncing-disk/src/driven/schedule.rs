//! Schedules: a platform that changes its motion from time to time, as in a start-up, a burst or a ramp.

use std::f64::consts::TAU;

use bouncing_disk_core::{ChatterPolicy, Drive};

use super::engine::DrivenEngine;
use super::{DrivenStart, DrivenSystem};
use crate::error::{Error, check, finite};
use crate::motion::event::EventRecord;
use crate::motion::phase_time::phase_at;
use crate::motion::si::SiState;
use crate::motion::state::{DiskState, Mode};
use crate::parameters::disk::Disk;
use crate::parameters::driven_platform::{
    AfterSchedule, DriveParameters, DrivenPlatform, ScheduleSegment, Waveform,
};
use crate::parameters::scales::Scales;
use crate::parameters::system::System;

/// A jump of the height at a joint that is smaller than this share of the heights is rounding.
const JOINT_ROUNDING: f64 = 1.0e-9;

/// Segments of motion, one after the other. The phase of the fundamental goes on from one to the next; the height
/// must be continuous at each joint, while its velocity may jump (a kink). The angle of each segment is counted from
/// where the one before has ended: only its speed may jump.
///
/// ```
/// use std::f64::consts::PI;
///
/// use bouncing_disk::core::ChatterPolicy;
/// use bouncing_disk::System;
/// use bouncing_disk::driven::{AfterSchedule, Schedule, ScheduleSegment, ScheduledEngine};
///
/// // From the lowest point two periods and a quarter with a larger amplitude, then the motion itself: both are at
/// // height zero where they join.
/// let first = ScheduleSegment { periods: 2.25, amplitude: 1.5, ..ScheduleSegment::default() };
/// let schedule = Schedule {
///     platform: (*System::pizza_toss().platform()).into(),
///     start_phase: 1.5 * PI,
///     segments: vec![first, ScheduleSegment::default()],
///     then: AfterSchedule::Repeat,
/// };
/// let motion = ScheduledEngine::at_rest(&schedule, System::pizza_toss().disk(), 0.0, ChatterPolicy::Complete)?;
/// assert!(motion.take(50).all(|event| event.is_ok_and(|event| event.record.ledger.relative_closure() < 1e-12)));
/// # Ok::<(), bouncing_disk::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Schedule {
    /// The platform that the segments change.
    pub platform: DrivenPlatform,
    /// Phase of the fundamental at the start (rad), finite.
    pub start_phase: f64,
    /// At least one.
    pub segments: Vec<ScheduleSegment>,
    /// What comes then.
    pub then: AfterSchedule,
}

/// A segment for a disk.
#[derive(Debug, Clone)]
struct Part {
    system: DrivenSystem,
    /// Time of the drive at its start, and its duration (rad).
    start: f64,
    duration: f64,
    scales: Scales,
}

impl Part {
    /// Height of the platform `after` radians (m).
    fn height(&self, after: f64) -> f64 {
        self.system.height.at(self.start + after).height * self.scales.length
    }
}

impl Schedule {
    /// The platform of a system, with its contact, and the schedule of a file's table.
    ///
    /// # Errors
    /// Those of [`DrivenPlatform::new`]; [`Error::YieldingStator`]; the rest is checked by [`ScheduledEngine::at_rest`].
    pub fn of_drive(system: &System, drive: &DriveParameters) -> Result<Self, Error> {
        let DriveParameters { height, angle, start_phase, segments, then } = drive.clone();
        let platform = DrivenPlatform::new(*system.platform(), height, angle)?;
        system.prescribed()?;
        let platform = platform.with_contact(system.soft_contact());
        Ok(Self { platform, start_phase, segments, then })
    }

    fn parts(&self, disk: &Disk) -> Result<Vec<Part>, Error> {
        finite("start_phase", self.start_phase)?;
        let count = self.segments.len();
        check(count > 0, "number of segments", 0.0, "[1, inf): start_phase and then need segments")?;
        if let (Some((_, time)), true) =
            (self.platform.contact(), count > 1 || self.then == AfterSchedule::Rest)
        {
            check(false, "contact.time", time, "(none: segments that join have rigid impacts)")?;
        }
        let mut parts: Vec<Part> = Vec::with_capacity(count + 1);
        let mut cycles = self.start_phase / TAU;
        for (index, segment) in self.segments.iter().enumerate() {
            let lasts = index + 1 == count && self.then == AfterSchedule::Repeat;
            let part = self.part(index, lasts, cycles % 1.0, disk).map_err(|error| match error {
                Error::OutOfRange { field, value, legal } => {
                    let source = bouncing_disk_core::Error::OutOfRange { field, value, legal };
                    Error::Segment { segment: index, source }
                }
                Error::Waveform { source, .. } => Error::Segment { segment: index, source },
                other => other,
            })?;
            join(&parts, &part, index)?;
            parts.push(Part { duration: if lasts { f64::INFINITY } else { part.duration }, ..part });
            cycles += segment.periods;
        }
        if let (AfterSchedule::Rest, Some(last)) = (self.then, parts.last()) {
            let length = self.platform.scales(disk).length;
            let height = last.height(last.duration) / length;
            let still = |height: f64| {
                Drive::pieces(&[(TAU, [height, 0.0, 0.0, 0.0])])
                    .map_err(|source| Error::Waveform { of: "height", source })
            };
            parts.push(Part {
                system: DrivenSystem {
                    height: still(height)?,
                    angle: Waveform::Sine.track("angle", 0.0, 0.0)?,
                    ..last.system.clone()
                },
                start: 0.0,
                duration: f64::INFINITY,
                scales: self.platform.scales(disk),
            });
        }
        Ok(parts)
    }

    fn part(&self, index: usize, repeats: bool, cycles: f64, disk: &Disk) -> Result<Part, Error> {
        let ScheduleSegment { periods, amplitude, ramp_to, frequency, lag } = self.segments[index];
        if let (true, Some(ramp)) = (repeats, ramp_to) {
            check(false, "ramp_to", ramp, "(none: the last segment repeats)")?;
        }
        check(periods > 0.0 && periods <= 1.0e5, "periods", periods, "(0, 1e5]")?;
        check(frequency > 0.0 && frequency <= 1.0e6, "frequency", frequency, "(0, 1e6]")?;
        finite("lag", lag)?;
        for amplitude in [Some(amplitude), ramp_to].into_iter().flatten() {
            let legal = (0.0..=1.0e6).contains(&amplitude);
            check(legal, "amplitude", amplitude, "[0, 1e6]")?;
        }
        let scales = Scales::of(self.platform.platform().angular_frequency() * frequency, disk);
        scales.check()?;
        let (duration, phase) = (periods * TAU, cycles * TAU);
        let hand = self.platform.platform();
        // One full amplitude in units of the segment.
        let track = |of, waveform: &Waveform, full: f64, lag: f64| match ramp_to {
            None => waveform.track(of, full * amplitude, lag),
            Some(ramp_to) => {
                let harmonics = waveform.harmonics().ok_or(Error::RampOfPieces { segment: index })?;
                let rate = (ramp_to - amplitude) / duration;
                let ramped = |(j, (a, phi)): (usize, (f64, f64))| {
                    (a * full * amplitude, a * full * rate, phi + (j + 1) as f64 * (phase + lag))
                };
                let harmonics: Vec<_> = harmonics.into_iter().enumerate().map(ramped).collect();
                Drive::ramped_fourier(&harmonics, duration).map_err(|source| Error::Waveform { of, source })
            }
        };
        let rigid = DrivenSystem {
            height: track("height", self.platform.height(), hand.amplitude() / scales.length, 0.0)?,
            angle: track(
                "angle",
                self.platform.angle(),
                hand.twist_amplitude() / scales.angle,
                hand.phase_lag() + lag,
            )?,
            friction: disk.friction(),
            restitution: disk.restitution(),
            load: disk.load_acceleration() / scales.angular_acceleration,
            compliance: None,
        };
        Ok(Part {
            system: rigid.with_contact(self.platform.contact(), hand.angular_frequency() * frequency)?,
            start: if ramp_to.is_some() { 0.0 } else { phase_at(phase).angle() },
            duration,
            scales,
        })
    }
}

/// Checks that a segment begins where the one before has ended.
fn join(parts: &[Part], part: &Part, segment: usize) -> Result<(), Error> {
    let Some(before) = parts.last() else { return Ok(()) };
    let (end, start) = (before.height(before.duration), part.height(0.0));
    let sizes = [before, part].map(|part| {
        let bounds = part.system.height().bounds();
        bounds.highest.abs().max(bounds.lowest.abs()) * part.scales.length
    });
    let jump = start - end;
    // The time at the end of a long segment is rounded.
    let late = 4.0 * f64::EPSILON * (before.start + before.duration);
    let moved = late * before.system.height().bounds().speed * before.scales.length;
    let joins = jump.abs() <= JOINT_ROUNDING * sizes[0].max(sizes[1]) + moved;
    if joins { Ok(()) } else { Err(Error::ScheduleJump { segment, jump }) }
}

/// An event of a [`ScheduledEngine`].
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ScheduledRecord {
    /// The segment; one more than the last where the platform has come to rest.
    pub segment: usize,
    /// Time since the start (s).
    pub time: f64,
    /// The event in the units of its segment ([`ScheduledEngine::scales_of`]).
    pub record: EventRecord,
}

/// The motion of a disk through a [`Schedule`], as a lazy sequence of events: where a segment ends there is a
/// [`Event::Joint`](crate::Event::Joint), and a kink there is the event after it.
#[derive(Debug, Clone)]
pub struct ScheduledEngine {
    parts: Vec<Part>,
    segment: usize,
    engine: DrivenEngine,
    policy: ChatterPolicy,
    /// Time since the segment began (rad), and when it began (s).
    elapsed: f64,
    began: f64,
    /// Angle of the platform that the segment counts as zero (rad).
    turned: f64,
}

impl ScheduledEngine {
    /// A disk that lies on the platform at the start, with this angular speed (rad/s).
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a start phase that is not finite or a schedule without segments;
    /// [`Error::Segment`] for a number of a segment outside its range, and for accelerations beyond 1e8
    /// preloads; [`Error::ScheduleJump`] for a height that jumps at a joint; [`Error::RampOfPieces`].
    pub fn at_rest(
        schedule: &Schedule,
        disk: &Disk,
        angular_speed: f64,
        policy: ChatterPolicy,
    ) -> Result<Self, Error> {
        let parts = schedule.parts(disk)?;
        let first = &parts[0];
        let start = DrivenStart::Contact {
            phase: phase_at(first.start),
            angular_speed: angular_speed / first.scales.angular_speed,
        };
        let engine = DrivenEngine::new(first.system.clone(), start, policy)?;
        Ok(Self { parts, segment: 0, engine, policy, elapsed: 0.0, began: 0.0, turned: 0.0 })
    }

    /// The units of a segment's records.
    #[must_use]
    pub fn scales_of(&self, segment: usize) -> Option<&Scales> {
        self.parts.get(segment).map(|part| &part.scales)
    }

    /// The engine of the present segment, in the units of the segment.
    #[must_use]
    pub const fn engine(&self) -> &DrivenEngine {
        &self.engine
    }

    /// Time since the start at the last event (s).
    #[must_use]
    pub fn time(&self) -> f64 {
        self.began + self.elapsed * self.parts[self.segment].scales.time
    }

    /// Disk and platform `after` seconds after the last event, if no event comes before.
    #[must_use]
    pub fn states_after(&self, after: f64) -> (SiState, SiState) {
        let Part { system, scales, .. } = &self.parts[self.segment];
        let (time, disk) = self.engine.state_after(after / scales.time);
        let in_ramp = if system.is_ramp() { time.periods as f64 * TAU } else { 0.0 };
        let at = in_ramp + time.phase.angle();
        let (height, angle) = (system.height.at(at), system.angle.at(at));
        let mut platform = scales.state(&DiskState {
            mode: Mode::Sticking,
            height: height.height,
            axial_velocity: height.velocity,
            angle: angle.height,
            angular_speed: angle.velocity,
        });
        platform.angle += self.turned;
        (scales.state(&disk), platform)
    }

    /// The next event, or `None` after the last one.
    ///
    /// # Errors
    /// Those of [`DrivenEngine::advance`].
    pub fn advance(&mut self) -> Result<Option<ScheduledRecord>, Error> {
        let left = (self.parts[self.segment].duration - self.elapsed).max(0.0);
        let found = self.engine.advance_within(left)?;
        let record = match found {
            Some(record) => record,
            None if left == f64::INFINITY => return Ok(None),
            None => self.engine.pause(left),
        };
        self.elapsed += record.span.radians();
        let event = ScheduledRecord { segment: self.segment, time: self.time(), record };
        if found.is_none() {
            self.begin_next(&record)?;
        }
        Ok(Some(event))
    }

    fn begin_next(&mut self, joint: &EventRecord) -> Result<(), Error> {
        let (old, new) = (&self.parts[self.segment], &self.parts[self.segment + 1]);
        self.began += old.duration * old.scales.time;
        self.turned += old.system.angle.at(old.start + old.duration).height * old.scales.angle
            - new.system.angle.at(new.start).height * new.scales.angle;
        let faster = old.scales.velocity / new.scales.velocity;
        let mut state = joint.after;
        let gap = state.height - old.system.height.at(old.start + old.duration).height;
        state.height = new.system.height.at(new.start).height;
        if state.mode == Mode::Flight {
            state.height += gap.max(0.0) * (faster * faster);
        }
        state.axial_velocity *= faster;
        state.angular_speed *= faster;
        state.angle *= faster * faster;
        let flights = self.engine.short_flights();
        self.engine = DrivenEngine::joined(new.system.clone(), new.start, state, self.policy, flights)?;
        self.segment += 1;
        self.elapsed = 0.0;
        Ok(())
    }
}

impl Iterator for ScheduledEngine {
    type Item = Result<ScheduledRecord, Error>;

    fn next(&mut self) -> Option<Self::Item> {
        self.advance().transpose()
    }
}

#[cfg(test)]
mod tests;
