//! The speed transient of one motor.

use std::f64::consts::TAU;

use bouncing_disk_core::{ChatterPolicy, Phase};
use serde::{Deserialize, Serialize};

use crate::error::{Error, not_negative, positive};
use crate::fit::ExponentialFit;
use crate::rotor::{Rotor, RotorStep};
use crate::scales::Scales;
use crate::system::System;

/// How a transient is computed and sampled.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct TransientSettings {
    /// Duration (s), positive.
    pub duration: f64,
    /// Number of equal intervals over which the speed is averaged, in [3, 1000000].
    pub intervals: usize,
    /// Size of the relaunch perturbation in units of g/omega, not negative: each separation from rest gets a
    /// relative velocity drawn evenly from [0, size). Zero gives the cycle of the rounding. Default 1e-3.
    pub relaunch_perturbation: f64,
    /// Seed of the perturbations and of the starting phases.
    pub seed: u64,
    /// What ends a chattering sequence.
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
    pub(crate) fn check(&self) -> Result<(), Error> {
        positive("duration", self.duration)?;
        not_negative("relaunch_perturbation", self.relaunch_perturbation)?;
        if (3..=1_000_000).contains(&self.intervals) {
            Ok(())
        } else {
            Err(Error::OutOfRange { field: "intervals", value: self.intervals as f64, legal: "[3, 1000000]" })
        }
    }
}

/// Angular speed against time, from rest.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SpeedCurve {
    /// Middles of the intervals (s).
    pub times: Vec<f64>,
    /// Mean angular speed in each interval (rad/s).
    pub speeds: Vec<f64>,
    /// Impacts on the way, those of summed chattering sequences not counted.
    pub impacts: u64,
    /// Separations from rest on the way.
    pub separations: u64,
}

impl SpeedCurve {
    /// The fit of alpha_ss (1 - exp(-t/t_c)).
    ///
    /// # Errors
    /// Those of [`ExponentialFit::new`].
    pub fn fit(&self) -> Result<ExponentialFit, Error> {
        ExponentialFit::new(&self.times, &self.speeds)
    }

    /// Mean speed (rad/s) over the last `fraction` in (0, 1] of the curve.
    #[must_use]
    pub fn mean_over_last(&self, fraction: f64) -> f64 {
        let count = ((self.speeds.len() as f64 * fraction) as usize).clamp(1, self.speeds.len());
        let last = &self.speeds[self.speeds.len() - count..];
        last.iter().sum::<f64>() / count as f64
    }
}

/// The splitmix64 generator: a documented, reproducible stream for each seed.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SplitMix(pub(crate) u64);

impl SplitMix {
    pub(crate) const fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Evenly in [0, 1).
    fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 * (1.0 / 9_007_199_254_740_992.0)
    }
}

/// The speed transient of a rotor that at `phase` lies at rest on the stator, which starts to vibrate.
///
/// # Errors
/// [`Error::OutOfRange`] for illegal settings; the errors of the flights.
pub fn transient(system: &System, phase: Phase, settings: &TransientSettings) -> Result<SpeedCurve, Error> {
    let mut run = Run::new(system, phase, settings)?;
    while !run.is_done() {
        run.step()?;
    }
    Ok(run.finished())
}

/// A transient under way.
#[derive(Debug)]
pub(crate) struct Run {
    pub(crate) rotor: Rotor,
    pub(crate) bins: Bins,
    pub(crate) impacts: u64,
    separations: u64,
    generator: SplitMix,
    relaunch_perturbation: f64,
    /// Duration (s).
    pub(crate) duration: f64,
    /// Angle (rad) of the start.
    pub(crate) start: f64,
    pub(crate) unit: Scales,
}

impl Run {
    pub(crate) fn new(system: &System, phase: Phase, settings: &TransientSettings) -> Result<Self, Error> {
        settings.check()?;
        Ok(Self {
            rotor: Rotor::at_rest(system.dimensionless(), phase, 0.0, settings.policy)?,
            bins: Bins::new(settings.duration, settings.intervals),
            impacts: 0,
            separations: 0,
            generator: SplitMix(settings.seed),
            relaunch_perturbation: settings.relaunch_perturbation,
            duration: settings.duration,
            start: phase.angle(),
            unit: system.scales(),
        })
    }

    /// Whether the motion has been added up to the end.
    #[inline(always)]
    pub(crate) fn is_done(&self) -> bool {
        self.bins.present.reached >= self.duration
    }

    /// Adds the motion up to the next event.
    #[inline(always)]
    pub(crate) fn step(&mut self) -> Result<(), Error> {
        match self.rotor.advance()? {
            RotorStep::Ended => {
                let rest = self.duration - self.bins.present.reached;
                self.bins.add(self.duration, self.rotor.speed() * (rest / self.unit.time));
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

    /// The curve of a transient that is done.
    pub(crate) fn finished(self) -> SpeedCurve {
        let width = self.bins.width;
        let turned = self.bins.finished();
        let factor = self.unit.angular_speed * self.unit.time / width;
        SpeedCurve {
            times: (0..turned.len()).map(|i| (i as f64 + 0.5) * width).collect(),
            speeds: turned.into_iter().map(|angle| angle * factor).collect(),
            impacts: self.impacts,
            separations: self.separations,
        }
    }
}

/// Time (s) from whole periods and the change of the phase's angle; none is accumulated.
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
    /// When it ends (s).
    pub(crate) end: f64,
    /// The angle turned in it so far.
    pub(crate) turned: f64,
    /// Time up to which the motion has been added (s).
    pub(crate) reached: f64,
}

impl Bins {
    fn new(duration: f64, count: usize) -> Self {
        let width = duration / count as f64;
        let present = Interval { index: 0, end: width, turned: 0.0, reached: 0.0 };
        Self { turned: vec![0.0; count], width, present }
    }

    /// Adds the `angle` turned from the time reached until `to`, evenly in time; what lies beyond the last interval
    /// is dropped.
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
    /// As [`Bins::add`], for a time behind the end of the interval.
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
    use super::*;

    /// The published values of the generator for the seed 1234567.
    #[test]
    fn the_generator_is_splitmix64() {
        let mut generator = SplitMix(1_234_567);
        let published = [
            6_457_827_717_110_365_317,
            3_203_168_211_198_807_973,
            9_817_491_932_198_370_423,
            4_593_380_528_125_082_431,
            16_408_922_859_458_223_821,
        ];
        assert_eq!(published.map(|_| generator.next()), published);
        // The highest 53 bits, as a share of one.
        let mut generator = SplitMix(1_234_567);
        for bits in published {
            assert_eq!((generator.unit() * (1_u64 << 53) as f64) as u64, bits >> 11);
        }
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
            assert!((curve.mean_over_last(fraction) - mean).abs() < 1e-15, "{fraction}");
        }
    }

    /// A motion that turns evenly between events, against the angle reached at the ends of the intervals.
    #[test]
    fn intervals_hold_what_was_turned_in_them() {
        let events: Vec<(f64, f64)> = (1..=40_u32)
            // Some events on the border of intervals, some several intervals apart.
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
        let mut bins = Bins::new(duration, count);
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
        let mut bins = Bins::new(1.0, 10);
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
}
