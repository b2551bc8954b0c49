//! The speed transient of one motor.

use std::f64::consts::TAU;

use bouncing_disk_core::numerics::random::SplitMix64;
use bouncing_disk_core::numerics::statistics::mean;
use bouncing_disk_core::run::{Watch, WorkCount};
use bouncing_disk_core::{ChatterPolicy, Observer, Phase, read_checked};

use crate::error::{Error, check, finite, moderate_not_negative, positive, room_for};
use crate::motion::phase_time::PhaseSpan;
use crate::motor::rotor::{Rotor, RotorStep};
use crate::parameters::dimensionless::DimensionlessSystem;
use crate::parameters::scales::Scales;
use crate::parameters::system::System;

/// Largest number of periods of the platform in a transient: beyond 2^53 a double cannot count them one by
/// one.
const MAX_PERIODS: f64 = 9_007_199_254_740_992.0;

/// Shortest interval of a curve (rad): the rounding of a phase.
const SHORTEST_INTERVAL: f64 = 1.0e-15;

/// Largest number of intervals of a curve.
pub(crate) const MAX_INTERVALS: usize = 1_000_000;

/// The cost of an event, in flights: the end of a chatter takes longer to compute than a flight.
pub(crate) const FLIGHTS_OF_EVENT: u64 = 4;

/// Events after which the work is counted.
const EVENTS_BETWEEN_COUNTS: u64 = 64;

/// Settings for computing and sampling a transient.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedSettings"))]
pub struct TransientSettings {
    /// Duration (s), positive: at most 2^53 periods of the platform. Default 3.
    pub duration: f64,
    /// Number of equal intervals over which the speed is averaged, in [3, 1000000]. No interval may be
    /// shorter than 1e-15 rad of the platform's motion. Default 600.
    pub intervals: usize,
    /// Size of the relaunch perturbation in units of g/omega, in [0, 1e100]: each launch from rest, by a
    /// separation or a kick, has a relative velocity sampled uniformly from [0, size). With zero, rounding
    /// selects a cycle. Default 1e-3.
    pub relaunch_perturbation: f64,
    /// Seed of the perturbations and of the starting phases. Default 1.
    pub seed: u64,
    /// How chattering sequences end. Default [`ChatterPolicy::Complete`].
    pub policy: ChatterPolicy,
}

impl Default for TransientSettings {
    fn default() -> Self {
        Self {
            duration: 3.0,
            intervals: 600,
            relaunch_perturbation: 1.0e-3,
            seed: 1,
            policy: ChatterPolicy::Complete,
        }
    }
}

impl TransientSettings {
    /// Checks that do not depend on the motor.
    fn check(&self) -> Result<(), Error> {
        positive("duration", self.duration)?;
        moderate_not_negative("relaunch_perturbation", self.relaunch_perturbation)?;
        let intervals = self.intervals as f64;
        check((3..=MAX_INTERVALS).contains(&self.intervals), "intervals", intervals, "[3, 1000000]")?;
        Ok(())
    }

    /// Checks the settings of a motor with these units.
    pub(crate) fn check_for(&self, unit: &Scales) -> Result<(), Error> {
        self.check()?;
        let radians = self.duration / unit.time;
        let (periods, interval) = (radians / TAU, radians / self.intervals as f64);
        check(
            periods <= MAX_PERIODS,
            "duration in periods of the platform",
            periods,
            "(0, 9007199254740992]",
        )?;
        // The first also holds in seconds, unless they are subnormal.
        let lasts =
            interval >= SHORTEST_INTERVAL && self.duration / self.intervals as f64 >= f64::MIN_POSITIVE;
        check(lasts, "duration of an interval", interval, "[1e-15, inf) (rad), at least 2.3e-308 s")?;
        Ok(())
    }
}

read_checked!(TransientSettings as UncheckedSettings {
    duration: f64,
    intervals: usize,
    relaunch_perturbation: f64,
    seed: u64,
    policy: ChatterPolicy,
});

/// Angular speed as a function of time, from rest.
///
/// Deserialisation checks that the curve can be fitted: at least three points, as many speeds as times, and
/// rising times.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedCurve"))]
pub struct SpeedCurve {
    /// Midpoints of the intervals (s).
    pub times: Vec<f64>,
    /// Mean angular speed in each interval (rad/s).
    pub speeds: Vec<f64>,
    /// Number of impacts, without those of summed chattering sequences.
    pub impacts: u64,
    /// Number of separations from rest.
    pub separations: u64,
}

impl SpeedCurve {
    fn check(&self) -> Result<(), Error> {
        check_curve(&self.times, &self.speeds)
    }

    /// [`transient`](crate::motor::transient()) as a part of a longer call.
    pub(crate) fn alone(
        system: &System,
        phase: Phase,
        settings: &TransientSettings,
        work: &mut WorkCount<'_>,
    ) -> Result<Self, Error> {
        let mut run = TransientRun::new(system, phase, settings)?;
        while run.advance(work)? {}
        run.finished()
    }

    /// Mean speed (rad/s) over the last `fraction`, in (0, 1], of the curve's points, at least one.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a fraction outside (0, 1], for a curve without speeds, and for speeds that
    /// are not finite.
    pub fn mean_over_last(&self, fraction: f64) -> Result<f64, Error> {
        let points = self.speeds.len();
        check(fraction > 0.0 && fraction <= 1.0, "fraction of the curve", fraction, "(0, 1]")?;
        check(points > 0, "number of speeds", 0.0, "[1, inf)")?;
        let count = ((points as f64 * fraction) as usize).clamp(1, points);
        finite("mean speed", mean(&self.speeds[points - count..]))
    }
}

read_checked!(SpeedCurve as UncheckedCurve {
    times: Vec<f64>,
    speeds: Vec<f64>,
    impacts: u64,
    separations: u64,
});

/// Checks that times and speeds form a curve that can be fitted and begins at time zero or later.
pub(crate) fn check_curve(times: &[f64], speeds: &[f64]) -> Result<(), Error> {
    let first = times.first().copied().unwrap_or(0.0);
    check(
        first >= 0.0 || first.is_nan(),
        "times of the speed curve",
        first,
        "finite, not negative and rising (s)",
    )?;
    check_rows(times, speeds)
}

/// [`check_curve`] for a record that may begin before time zero.
pub(crate) fn check_rows(times: &[f64], speeds: &[f64]) -> Result<(), Error> {
    let n = times.len();
    check(n >= 3, "number of points of the speed curve", n as f64, "[3, inf)")?;
    check(speeds.len() == n, "number of speeds", speeds.len() as f64, "equal to the number of times")?;
    for (k, &time) in times.iter().enumerate() {
        let rises = time.is_finite() && (k == 0 || time > times[k - 1]);
        check(rises, "times of the speed curve", time, "finite and rising (s)")?;
    }
    for &speed in speeds {
        check(speed.is_finite(), "speed", speed, "finite (rad/s)")?;
    }
    Ok(())
}

/// The speed transient of a rotor that lies at rest at `phase` on the stator, which starts to vibrate.
///
/// The observer's items are the intervals of the curve.
///
/// # Errors
/// [`Error::OutOfRange`] for illegal settings, and for a speed that a double cannot represent; an error of
/// the core if there is no memory for the curve; the errors of the flights.
pub fn transient(
    system: &System,
    phase: Phase,
    settings: &TransientSettings,
    observer: &dyn Observer,
) -> Result<SpeedCurve, Error> {
    let mut run = TransientRun::new(system, phase, settings)?;
    let watch = Watch::begin(observer, 0, settings.intervals as u64)?;
    let mut work = watch.work();
    while run.advance(&mut work)? {
        watch.set_done(run.bins.present.index as u64);
    }
    watch.end();
    run.finished()
}

/// A transient under way.
#[derive(Debug)]
pub(crate) struct TransientRun {
    pub(crate) rotor: Rotor,
    pub(crate) bins: Bins,
    pub(crate) impacts: u64,
    separations: u64,
    generator: SplitMix64,
    relaunch_perturbation: f64,
    /// Duration (s).
    pub(crate) duration: f64,
    /// Angle (rad) of the start.
    pub(crate) start: f64,
    pub(crate) unit: Scales,
}

impl TransientRun {
    pub(crate) fn new(system: &System, phase: Phase, settings: &TransientSettings) -> Result<Self, Error> {
        let unit = system.scales();
        let own = DimensionlessSystem::try_from(system)?;
        settings.check_for(&unit)?;
        Ok(Self {
            rotor: Rotor::at_rest(&own, phase, 0.0, settings.policy)?,
            bins: Bins::new(settings.duration, settings.intervals)?,
            impacts: 0,
            separations: 0,
            generator: SplitMix64::new(settings.seed),
            relaunch_perturbation: settings.relaunch_perturbation,
            duration: settings.duration,
            start: phase.angle(),
            unit,
        })
    }

    /// Whether the motion has been accumulated up to the end.
    #[inline(always)]
    pub(crate) fn is_done(&self) -> bool {
        self.bins.present.reached >= self.duration
    }

    /// Accumulates the motion over several events, unless the transient is complete; returns whether events
    /// are left. The work is counted for an observer.
    pub(crate) fn advance(&mut self, work: &mut WorkCount<'_>) -> Result<bool, Error> {
        let mut events = 0;
        while events < EVENTS_BETWEEN_COUNTS && !self.is_done() {
            self.step()?;
            events += 1;
        }
        work.spend(FLIGHTS_OF_EVENT * events)?;
        Ok(!self.is_done())
    }

    /// Accumulates the motion up to the next event.
    #[inline(always)]
    pub(crate) fn step(&mut self) -> Result<(), Error> {
        match self.rotor.advance()? {
            RotorStep::Ended => {
                self.add_interval_of_contact();
                return Ok(());
            }
            RotorStep::Impact => self.impacts += 1,
            RotorStep::Contact => {}
            RotorStep::Separation => {
                self.separations += 1;
                if self.relaunch_perturbation > 0.0 {
                    self.rotor.perturb_launch(self.relaunch_perturbation * self.generator.unit())?;
                }
            }
        }
        let now = self.rotor.time();
        let to = seconds(now.periods as f64, now.phase.angle() - self.start, self.unit.time);
        self.bins.add(to, self.rotor.turned());
        Ok(())
    }

    /// Accumulates the rest of the present interval for a rotor that stays on the stator and no longer
    /// changes its mode: the rotor swings with the stator, or continues to slide.
    fn add_interval_of_contact(&mut self) {
        let now = self.rotor.time();
        let began = seconds(now.periods as f64, now.phase.angle() - self.start, self.unit.time);
        let turned_by = |time: f64| {
            self.rotor.turned_since_event(PhaseSpan::from_radians((time - began) / self.unit.time))
        };
        let Interval { index, end, reached, .. } = self.bins.present;
        // The end of the last interval may be a rounding short of the duration.
        let last = self.bins.turned.len() - 1;
        let next = if reached < end { index } else { index + 1 };
        let to = if next < last { (next + 1) as f64 * self.bins.width } else { end.max(self.duration) };
        let angle = turned_by(to) - turned_by(reached);
        self.bins.add(to, angle);
    }

    /// The curve of a completed transient.
    pub(crate) fn finished(self) -> Result<SpeedCurve, Error> {
        curve(self.bins, &self.unit, (self.impacts, self.separations))
    }
}

/// The curve of the angles turned in its intervals, in units of `unit`.
pub(crate) fn curve(
    bins: Bins,
    unit: &Scales,
    (impacts, separations): (u64, u64),
) -> Result<SpeedCurve, Error> {
    let width = bins.width;
    let mut speeds = bins.finished();
    let factor = unit.angular_speed * unit.time / width;
    speeds.iter_mut().for_each(|angle| *angle *= factor);
    if let Some(&speed) = speeds.iter().find(|speed| !speed.is_finite()) {
        finite("angular speed (rad/s)", speed)?;
    }
    let mut times = room_for("intervals of a curve", speeds.len(), MAX_INTERVALS)?;
    times.extend((0..speeds.len()).map(|i| (i as f64 + 0.5) * width));
    Ok(SpeedCurve { times, speeds, impacts, separations })
}

/// Time (s) from whole periods and the change of the phase's angle, without accumulated rounding.
#[inline(always)]
pub(crate) fn seconds(periods: f64, ahead: f64, unit: f64) -> f64 {
    (periods * TAU + ahead) * unit
}

/// The angle turned in each of a number of equal intervals of time.
#[derive(Debug)]
pub(crate) struct Bins {
    /// The angles turned in the intervals that have passed.
    pub(crate) turned: Vec<f64>,
    /// Duration of an interval (s).
    pub(crate) width: f64,
    pub(crate) present: Interval,
}

/// The interval that the motion has reached.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Interval {
    pub(crate) index: usize,
    /// The end of the interval (s).
    pub(crate) end: f64,
    /// The angle turned in the interval so far.
    pub(crate) turned: f64,
    /// Time up to which the motion has been added (s).
    pub(crate) reached: f64,
}

impl Bins {
    pub(crate) fn new(duration: f64, count: usize) -> Result<Self, Error> {
        let width = duration / count as f64;
        let present = Interval { index: 0, end: width, turned: 0.0, reached: 0.0 };
        let mut turned = room_for("intervals of a curve", count, MAX_INTERVALS)?;
        turned.resize(count, 0.0);
        Ok(Self { turned, width, present })
    }

    /// Adds the `angle` turned from the time reached until `to`, evenly in time; any part beyond the last
    /// interval is dropped.
    #[inline]
    pub(crate) fn add(&mut self, to: f64, angle: f64) {
        if to <= self.present.end {
            self.present.turned += angle;
            self.present.reached = to;
        } else {
            self.present.pass(&mut self.turned, self.width, to, angle);
        }
    }

    fn finished(mut self) -> Vec<f64> {
        self.turned[self.present.index] = self.present.turned;
        self.turned
    }
}

impl Interval {
    /// Like [`Bins::add`], for a time after the end of the interval.
    #[inline]
    pub(crate) fn pass(&mut self, passed: &mut [f64], width: f64, to: f64, angle: f64) {
        let rate = angle / (to - self.reached);
        while to > self.end {
            self.turned += rate * (self.end - self.reached);
            self.reached = self.end;
            if self.index + 1 == passed.len() {
                self.reached = to;
                return;
            }
            passed[self.index] = self.turned;
            self.turned = 0.0;
            self.index += 1;
            self.end = (self.index + 1) as f64 * width;
        }
        self.turned += rate * (to - self.reached);
        self.reached = to;
    }
}

#[cfg(test)]
mod tests {
    use bouncing_disk_core::Unobserved;

    use super::*;
    use crate::testing::{self, refused};

    /// With a wrong sign, a curve would be displaced by up to a period of the platform, which no other test
    /// would detect.
    #[test]
    fn the_angle_turned_in_a_period_adds_to_the_whole_ones() {
        let time = seconds(2.0, 0.5, 3.0);
        assert!((time - 3.0 * (2.0 * TAU + 0.5)).abs() < 1e-13, "{time}");
        // The phase may be behind the initial one.
        let time = seconds(2.0, -0.5, 3.0);
        assert!((time - 3.0 * (2.0 * TAU - 0.5)).abs() < 1e-13, "{time}");
    }

    #[test]
    fn the_mean_is_over_the_last_part_of_the_curve() {
        let curve = SpeedCurve {
            times: vec![0.5, 1.5, 2.5, 3.5],
            speeds: vec![1.0, 2.0, 4.0, 8.0],
            impacts: 0,
            separations: 0,
        };
        for (fraction, mean) in [(1.0, 3.75), (0.75, 14.0 / 3.0), (0.5, 6.0), (0.25, 8.0), (0.01, 8.0)] {
            assert!((curve.mean_over_last(fraction).expect("legal") - mean).abs() < 1e-15, "{fraction}");
        }
    }

    /// The angles turned in the intervals, for a uniform rotation between events, compared with the angle
    /// reached at the ends of the intervals.
    #[test]
    fn intervals_hold_what_was_turned_in_them() {
        let events: Vec<(f64, f64)> = (1..=40_u32)
            // Some events on the boundary of intervals, some several intervals apart.
            .scan(0.0, |time, k| {
                *time += [0.25, 0.125, 0.0625, 1.0 + 0.0625, 2.5][k as usize * 7 % 5];
                Some((*time, f64::from(k * 13 % 9) - 3.0))
            })
            .collect();
        let angle_at = |time: f64| {
            let (mut from, mut angle) = (0.0, 0.0);
            for &(to, turned) in &events {
                if to > time {
                    return angle + turned * (time - from) / (to - from);
                }
                angle += turned;
                from = to;
            }
            angle
        };
        let (duration, count) = (19.5, 39);
        let mut bins = Bins::new(duration, count).expect("room");
        for &(to, turned) in &events {
            bins.add(to, turned);
            assert!((bins.present.reached - to).abs() <= 0.0);
            if to >= duration {
                break;
            }
        }
        assert!(bins.present.reached > duration);
        for (k, turned) in bins.finished().into_iter().enumerate() {
            let (from, to) = (0.5 * k as f64, 0.5 * (k + 1) as f64);
            assert!((turned - (angle_at(to) - angle_at(from))).abs() < 1e-12, "{k}: {turned}");
        }
    }

    #[test]
    fn curve_keeps_the_angle_turned() {
        let mut bins = Bins::new(1.0, 10).expect("few");
        bins.add(0.05, 0.0);
        bins.add(0.77, 7.2);
        let sum = bins.turned.iter().sum::<f64>() + bins.present.turned;
        assert!((sum - 7.2).abs() < 1e-14);
        assert!((bins.turned[0] - 0.5).abs() < 1e-14 && (bins.turned[3] - 1.0).abs() < 1e-14);
        assert!(bins.turned[8].abs() <= 0.0);
        bins.add(0.95, 0.0);
        bins.add(1.4, 4.5);
        assert!((bins.finished()[9] - 0.5).abs() < 1e-13, "what lies beyond the end is dropped");
    }

    /// A subnormal duration once led to NaN as speeds, and a huge duration to an endless transient.
    #[test]
    fn durations_that_periods_cannot_count_are_refused() {
        let phase = Phase::new(4.0).expect("finite");
        let run = |duration: f64, intervals: usize| {
            transient(
                &testing::motor(1e-8, 0.0),
                phase,
                &TransientSettings { duration, intervals, ..Default::default() },
                &Unobserved,
            )
        };
        let of = |duration| run(duration, 600);
        refused("duration of an interval", [5e-324, 1e-310, 1e-300, 1e-21], of);
        refused("duration in periods of the platform", [1e308, f64::MAX, 1e12], of);
        let short = run(1e-17, 600).expect("legal");
        assert!(short.fit().is_ok_and(|fit| fit.steady_speed.is_finite() && fit.residual.is_finite()));
        assert!(short.speeds.iter().all(|speed| speed.is_finite()));
    }

    #[cfg(feature = "serde")]
    #[test]
    fn settings_that_are_read_are_legal() {
        let text = serde_json::to_string(&TransientSettings::default()).expect("writes");
        let read =
            |good: &str, bad: &str| serde_json::from_str::<TransientSettings>(&text.replace(good, bad));
        assert_eq!(read("", "").expect("legal"), TransientSettings::default());
        for (good, bad, complaint) in [
            ("3.0", "-3.0", "duration = -3"),
            ("600", "2", "intervals = 2"),
            ("600", "18446744073709551615", "intervals"),
            ("0.001", "-0.001", "relaunch_perturbation = -0.001"),
            ("seed", "sead", "sead"),
        ] {
            let error = read(good, bad).expect_err(bad).to_string();
            assert!(error.contains(complaint), "{error}");
        }
    }

    fn curve(speeds: &[f64]) -> SpeedCurve {
        let times = (0..speeds.len()).map(|i| i as f64 + 0.5).collect();
        SpeedCurve { times, speeds: speeds.to_vec(), impacts: 0, separations: 0 }
    }

    /// Once an empty curve caused a panic, the fraction 7 returned the mean of the whole curve, and NaN
    /// returned its last point.
    #[test]
    fn the_mean_of_a_part_that_is_none_is_refused() {
        let mean = |(speeds, share): (&[f64], f64)| curve(speeds).mean_over_last(share);
        refused("number of speeds", [(&[][..], 0.5)], mean);
        let rising = curve(&[1.0, 2.0, 3.0, 4.0]);
        let fractions = [0.0, -0.5, 7.0, 1.0 + f64::EPSILON, f64::NAN, f64::INFINITY];
        refused("fraction of the curve", fractions, |fraction| rising.mean_over_last(fraction));
        for (fraction, mean) in [(1.0, 2.5), (0.5, 3.5), (0.25, 4.0), (1e-300, 4.0)] {
            assert_eq!(rising.mean_over_last(fraction), Ok(mean));
        }
        refused("mean speed", [(&[1.0, f64::NAN][..], 1.0)], mean);
        let huge = curve(&[1.7e308; 4]).mean_over_last(1.0);
        assert_eq!(huge, Ok(1.7e308), "its sum is more than a double holds");
    }

    #[cfg(feature = "serde")]
    #[test]
    fn a_curve_that_is_read_can_be_fitted() {
        let own = curve(&[1.0, 1.5, 1.75]);
        let text = serde_json::to_string(&own).expect("writes");
        let read = |good: &str, bad: &str| serde_json::from_str::<SpeedCurve>(&text.replace(good, bad));
        assert_eq!(read("", "").expect("legal"), own);
        for (good, bad, complaint) in [
            ("[1.0,1.5,1.75]", "[1.0]", "number of speeds = 1"),
            ("[0.5,1.5,2.5]", "[]", "number of points of the speed curve = 0"),
            ("[0.5,1.5,2.5]", "[0.5,2.5,1.5]", "times of the speed curve"),
            ("impacts", "impakts", "impakts"),
        ] {
            let error = read(good, bad).expect_err(bad).to_string();
            assert!(error.contains(complaint), "{error}");
        }
    }

    /// A rotor that never leaves the stator and sticks to it swings to and fro, and a rotor whose load
    /// exceeds friction slides ever faster: neither keeps the speed of its last event.
    #[test]
    fn a_rotor_on_a_calm_stator_sticks_or_slides_on() {
        let motor = |friction: f64, load_acceleration: f64| {
            System::motor()
                .with_platform(|stator| {
                    stator.amplitude = 2e-11;
                    stator.twist_amplitude = 30e-6 / stator.angular_frequency;
                })
                .and_then(|motor| {
                    motor.with_disk(|rotor| {
                        rotor.friction = friction;
                        rotor.load_acceleration = load_acceleration;
                    })
                })
                .expect("legal")
        };
        let settings = TransientSettings { duration: 1.0, intervals: 8, ..TransientSettings::default() };
        let phase = Phase::new(4.0).expect("finite");
        let sticking = transient(&motor(1.0, 0.0), phase, &settings, &Unobserved).expect("no failure");
        // Over 8750 periods only the ends of the interval contribute.
        assert!(sticking.speeds[1..].iter().all(|speed| speed.abs() < 1e-8), "{:?}", sticking.speeds);
        // Friction subtracts mu g a_e/a_g^2 = 30.9 rad/s^2 from a load of 50.
        let sliding = transient(&motor(0.1, 50.0), phase, &settings, &Unobserved).expect("no failure");
        let slowing = 50.0 - motor(0.1, 50.0).disk().friction_acceleration();
        for (time, speed) in sliding.times.iter().zip(&sliding.speeds) {
            assert!((speed + slowing * time).abs() < 1e-3, "{time} {speed} {slowing}");
        }
    }
}
