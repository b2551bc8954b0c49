//! Measured run-ups and braking tails, and the quantities by which a fit compares them.
//!
//! The switch-on time of a motor is rarely known to a few per cent of the rise. So times in a run, measured
//! or computed, are counted from the instant at which the speed is half-way between its first and its last
//! value. A clock error, a dead time and an initial speed then have no effect. The compared quantities are
//! means over time windows on either side of that instant.
//!
//! There are two windows before the half-way instant and five after it, each later one twice as long as the
//! previous one. At that instant the integral of the distance from the half-way level is least. Computed
//! members are sampled at the measured instants, shifted by a random part of half a step, with the measured
//! errors. If the error of a point is not given, it is estimated from the deviations of points from the line
//! between their neighbours. A braking tail is compared in the same windows.

use std::f64::consts::TAU;

use bouncing_disk_core::numerics::random::SplitMix64;
use bouncing_disk_core::{ChatterPolicy, Observer, Phase};
use nalgebra::DVector;

use crate::error::{Error, check, finite, not_negative};
use crate::estimate::measured_speeds::{MeasuredRun, MeasuredSpeeds};
use crate::estimate::motor_fit::parameter::FitRange;
use crate::estimate::refusal::{FitError, FitRefusal, refused};
use crate::motor::batch::members::TransientMember;
use crate::motor::data_sheet::Motor;
use crate::motor::data_sheet::motor_field::MotorField;
use crate::motor::rotor::transient::TransientSettings;
use crate::statistics::normal;

/// The fewest points of a run.
const LEAST_POINTS: usize = 8;

/// Intervals of a computed curve.
const INTERVALS: usize = 512;

/// Windows after the half-way instant, each twice as long as the previous one; there are two before it.
const LATER: i32 = 5;

/// The first and the last part of a run, whose means define its end values.
const END: f64 = 0.1;

/// End values closer to each other than this number of errors of a point are equal.
const LEAST_CHANGE: f64 = 4.0;

/// Steps of a computed braking tail, and its initial speed relative to the largest measured one.
const STEPS: usize = 8;
const FASTER: f64 = 1.5;

/// The kind of a measured transient.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum TransientKind {
    /// The motor is on, and its speed rises.
    RunUp,
    /// The drive is off, and friction and load brake a rotor that slides on a stator at rest.
    Braking,
}

/// One run-up or braking tail of a motor, or several independent ones.
///
/// Neither the time of the switch nor the speed at the first point need be known.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct MeasuredTransient {
    /// The kind of transient.
    pub kind: TransientKind,
    /// The runs, each of at least eight points.
    pub runs: MeasuredSpeeds,
    /// Standard deviation of the error of one measured speed (rad/s), not negative, independent from point to
    /// point. `None` estimates it from the distance of each point from the line between its neighbours. This
    /// counts some of the motor's own fluctuation as error and widens the intervals slightly.
    pub speed_error: Option<f64>,
    /// Fields whose exact values differ from the data sheet: preload, volts, load.
    pub conditions: Vec<(MotorField, f64)>,
}

impl MeasuredTransient {
    /// Runs under the conditions of the data sheet.
    #[must_use]
    pub const fn new(kind: TransientKind, runs: MeasuredSpeeds) -> Self {
        Self { kind, runs, speed_error: None, conditions: Vec::new() }
    }

    /// The same runs under another value of a field.
    #[must_use]
    pub fn at(mut self, field: MotorField, value: f64) -> Self {
        self.conditions.push((field, value));
        self
    }

    /// The motor under these conditions.
    pub(super) fn motor(&self, mut sheet: crate::motor::MotorParameters) -> Result<Motor, Error> {
        for (field, value) in &self.conditions {
            field.set(&mut sheet, *value);
        }
        sheet.build()
    }

    /// The standard deviation of the error of one measured speed.
    fn error(&self) -> Result<f64, Error> {
        if let Some(error) = self.speed_error {
            return not_negative("speed_error", error);
        }
        let (mut sum, mut count) = (0.0, 0.0);
        for run in self.runs.runs() {
            for (t, y) in run.times.windows(3).zip(run.speeds.windows(3)) {
                // For independent errors of variance one, this has the variance 1 + share^2 + (1 - share)^2.
                let share = (t[1] - t[0]) / (t[2] - t[0]);
                let off = y[1] - y[0] - share * (y[2] - y[0]);
                sum += off * off / (1.0 + share * share + (1.0 - share) * (1.0 - share));
                count += 1.0;
            }
        }
        finite("square of a measured speed", sum / count).map(f64::sqrt)
    }
}

/// Runs in the form in which they are compared.
#[derive(Debug, Clone)]
pub(super) struct Observed {
    kind: TransientKind,
    /// The half-way speed, and 1 if speeds rise through it, -1 if they fall.
    level: f64,
    sign: f64,
    /// Bounds of the windows (s), counted from the half-way instant.
    bounds: Vec<f64>,
    /// For each run its times counted from the half-way instant.
    patterns: Vec<Vec<f64>>,
    /// The half-way instant of each run on its own clock.
    pub(super) halfway: Vec<f64>,
    error: f64,
    fastest: f64,
    /// Duration of the computed runs (s).
    duration: f64,
    /// Means over the windows (rad/s).
    pub(super) means: DVector<f64>,
}

/// Times and speeds.
type Curve = (Vec<f64>, Vec<f64>);

/// Computed quantities of a motor: the means over the windows for each member, and the time of its half-way
/// instant after the switch-on (s).
pub(super) struct Computed {
    pub(super) means: Vec<DVector<f64>>,
    pub(super) halfway: Vec<f64>,
}

impl Observed {
    pub(super) fn of(transient: &MeasuredTransient, ranges: &[FitRange]) -> Result<Self, FitError> {
        for (index, (field, value)) in transient.conditions.iter().enumerate() {
            finite(field.name(), *value)?;
            let before = transient.conditions[..index].iter().map(|(field, _)| *field);
            for other in before.chain(ranges.iter().map(|range| range.parameter.field())) {
                if other == *field || field.excluded().contains(&other) || other.excluded().contains(field) {
                    return Err(Error::BothGiven { one: field.name(), other: other.name() }.into());
                }
            }
        }
        let (runs, error) = (transient.runs.runs(), transient.error()?);
        let points = runs.iter().map(|run| run.times.len()).min().unwrap_or(0);
        if points < LEAST_POINTS {
            return refused(FitRefusal::TooFewPoints { points, least: LEAST_POINTS });
        }
        let part = |run: &MeasuredRun| ((END * run.times.len() as f64) as usize).max(1);
        let mean = |of: &dyn Fn(&MeasuredRun) -> f64| runs.iter().map(of).sum::<f64>() / runs.len() as f64;
        let first = mean(&|run| run.speeds[..part(run)].iter().sum::<f64>() / part(run) as f64);
        let last =
            mean(&|run| run.speeds[run.speeds.len() - part(run)..].iter().sum::<f64>() / part(run) as f64);
        if (last - first).abs() <= LEAST_CHANGE * error || (last - first).abs() <= 0.0 {
            return refused(FitRefusal::NoRise);
        }
        if transient.kind == TransientKind::Braking && last.abs() >= first.abs() {
            return refused(FitRefusal::NotBraking { first, last });
        }
        let (level, sign) = (0.5 * (first + last), (last - first).signum());
        let halfway: Vec<f64> =
            runs.iter().map(|run| crossing(&run.times, &run.speeds, level, sign)).collect();
        let ends = |of: fn(&MeasuredRun, f64) -> f64| {
            let all = runs.iter().zip(&halfway).map(|(run, at)| of(run, *at));
            all.fold(f64::INFINITY, f64::min)
        };
        let before = ends(|run, at| at - run.times[0]);
        let after = ends(|run, at| run.times[run.times.len() - 1] - at);
        let span = before.min(after);
        let later = (0..LATER).rev().map(|halving| after / f64::from(1 << halving));
        let mut bounds: Vec<f64> = [-span, -0.5 * span, 0.0].into_iter().chain(later).collect();
        // A window holds two points on average.
        let least = 2.0 * runs.iter().map(step).fold(0.0, f64::max);
        let mut kept = vec![bounds.remove(0)];
        for bound in bounds {
            if bound - kept[kept.len() - 1] >= least {
                kept.push(bound);
            }
        }
        let patterns = runs.iter().zip(&halfway);
        let patterns = patterns.map(|(run, at)| run.times.iter().map(|time| time - at).collect()).collect();
        let fastest = runs.iter().flat_map(|run| &run.speeds).fold(0.0, |most: f64, own| most.max(own.abs()));
        let mut observed = Self {
            kind: transient.kind,
            level,
            sign,
            bounds: kept,
            patterns,
            halfway,
            error,
            fastest,
            duration: after + before.max(after),
            means: DVector::zeros(0),
        };
        check(
            observed.bounds.len() > 1,
            "points of a transient",
            points as f64,
            "more, on both sides of half-way",
        )?;
        let means: Vec<_> = runs.iter().map(|run| observed.windows(&run.times, &run.speeds).0).collect();
        observed.means = means.iter().sum::<DVector<f64>>() / means.len() as f64;
        Ok(observed)
    }

    pub(super) fn is_braking(&self) -> bool {
        self.kind == TransientKind::Braking
    }

    /// The number of independent runs over which the means are taken.
    pub(super) fn runs(&self) -> usize {
        self.patterns.len()
    }

    /// The derivative of the means with respect to a multiple of `added`, a function of the time from the
    /// half-way instant, that is added to the speeds.
    pub(super) fn change(&self, transient: &MeasuredTransient, added: impl Fn(f64) -> f64) -> DVector<f64> {
        let size = 1e-3 * self.fastest;
        let of = |run: &MeasuredRun, at: f64| {
            let speeds: Vec<f64> =
                run.times.iter().zip(&run.speeds).map(|(time, own)| own + size * added(time - at)).collect();
            self.windows(&run.times, &speeds).0
        };
        let all: DVector<f64> =
            transient.runs.runs().iter().zip(&self.halfway).map(|(run, at)| of(run, *at)).sum();
        (all / self.runs() as f64 - &self.means) / size
    }

    /// The means of a curve over the windows, and its half-way instant.
    fn windows(&self, times: &[f64], speeds: &[f64]) -> (DVector<f64>, f64) {
        let at = crossing(times, speeds, self.level, self.sign);
        let means = self.bounds.windows(2).map(|ends| {
            let [from, to] = [at + ends[0], at + ends[1]];
            integral(times, speeds, from, to) / (to - from)
        });
        (DVector::from_iterator(self.bounds.len() - 1, means), at)
    }

    /// The means and half-way instants of computed members, at the measured instants and with the measured
    /// errors.
    pub(super) fn compute(
        &self,
        motor: &Motor,
        (members, seed): (usize, u64),
        observer: &dyn Observer,
    ) -> Result<Computed, Error> {
        let curves = match self.kind {
            TransientKind::RunUp => self.run_ups(motor, members, seed, observer)?,
            TransientKind::Braking => vec![self.braking(motor)?; members],
        };
        let mut computed = Computed { means: Vec::new(), halfway: Vec::new() };
        for (member, (times, speeds)) in curves.iter().enumerate() {
            let mut generator = SplitMix64::new(SplitMix64::seed_of_stream(seed ^ 0x70_7E57, member as u64));
            let pattern = &self.patterns[member % self.patterns.len()];
            let at = crossing(times, speeds, self.level, self.sign);
            let last = pattern.len() - 1;
            let shift = at + (pattern[last] - pattern[0]) / last as f64 * (generator.unit() - 0.5);
            let measured: Vec<f64> = pattern.iter().map(|time| time + shift).collect();
            let of = |time: &f64| interpolated(times, speeds, *time) + self.error * normal(&mut generator);
            let noisy: Vec<f64> = measured.iter().map(of).collect();
            computed.means.push(self.windows(&measured, &noisy).0);
            computed.halfway.push(at);
        }
        Ok(computed)
    }

    /// Run-ups from rest, at evenly spaced phases.
    fn run_ups(
        &self,
        motor: &Motor,
        members: usize,
        seed: u64,
        observer: &dyn Observer,
    ) -> Result<Vec<Curve>, Error> {
        let member = |index: usize| {
            let phase = Phase::new(TAU * (index as f64 + 0.5) / members as f64)?;
            let settings = TransientSettings {
                duration: self.duration,
                intervals: INTERVALS,
                seed: SplitMix64::seed_of_stream(seed, index as u64),
                policy: ChatterPolicy::Complete,
                ..TransientSettings::default()
            };
            Ok(TransientMember { system: motor.system().bare(), phase, settings })
        };
        let members = (0..members).map(member).collect::<Result<Vec<_>, Error>>()?;
        let curves = motor.transients(&members, observer)?;
        // From rest at the switch-on.
        let from_rest = |curve: crate::motor::SpeedCurve| {
            let times = std::iter::once(0.0).chain(curve.times).collect();
            (times, std::iter::once(0.0).chain(curve.speeds).collect())
        };
        Ok(curves.into_iter().map(from_rest).collect())
    }

    /// A rotor that slides on a stator at rest, from a speed above all measured ones until it stops.
    fn braking(&self, motor: &Motor) -> Result<Curve, Error> {
        let system = motor.on_shaft()?;
        let inertia = motor.mass() * system.disk().gyration_radius() * system.disk().gyration_radius();
        let law = |speed: f64| motor.load().map_or(motor.load_torque(), |load| load.torque_at(speed, 0.0));
        let direction = if self.level < 0.0 { -1.0 } else { 1.0 };
        let duration = 2.0 * self.duration;
        let step = duration / (INTERVALS * STEPS) as f64;
        let (mut speed, mut times, mut speeds) = (FASTER * self.fastest, Vec::new(), Vec::new());
        for index in 0..INTERVALS * STEPS {
            if index % STEPS == 0 {
                times.push(index as f64 * step);
                speeds.push(direction * speed);
            }
            // Half a step, and then the whole one with the slope there.
            let slope = |speed: f64| -(motor.largest_torque() + direction * law(direction * speed)) / inertia;
            let middle = speed + 0.5 * step * slope(speed);
            speed = (speed + step * slope(middle)).max(0.0);
        }
        Ok((times, speeds))
    }
}

/// The mean time between points.
fn step(run: &MeasuredRun) -> f64 {
    (run.times[run.times.len() - 1] - run.times[0]) / (run.times.len() - 1) as f64
}

/// The time at which a curve rises (or falls) through a level for good: judged by the integral of its distance
/// from the level, the curve is on one side before this time and on the other afterwards. Points are joined by
/// straight lines.
fn crossing(times: &[f64], speeds: &[f64], level: f64, sign: f64) -> f64 {
    let above = |index: usize| sign * (speeds[index] - level);
    let (mut sum, mut least, mut best) = (0.0, 0.0, 0);
    for index in 1..times.len() {
        sum += 0.5 * (above(index - 1) + above(index)) * (times[index] - times[index - 1]);
        if sum < least {
            (least, best) = (sum, index);
        }
    }
    // The integral is least next to a change of sign.
    let crosses = |index: usize| above(index) < 0.0 && above(index + 1) >= 0.0;
    let near = [best.saturating_sub(1), best].into_iter().filter(|index| index + 1 < times.len());
    let share = |index: usize| above(index) / (above(index) - above(index + 1));
    let found = near.into_iter().find(|index| crosses(*index));
    found.map_or(times[best], |index| times[index] + share(index) * (times[index + 1] - times[index]))
}

/// A curve at a time: linear between two points, and constant beyond the ends.
fn interpolated(times: &[f64], speeds: &[f64], time: f64) -> f64 {
    let after = times.partition_point(|own| *own <= time);
    if after == 0 || after == times.len() {
        return speeds[after.min(times.len() - 1)];
    }
    let share = (time - times[after - 1]) / (times[after] - times[after - 1]);
    speeds[after - 1] + share * (speeds[after] - speeds[after - 1])
}

/// The integral of a piecewise linear curve, constant beyond its ends.
fn integral(times: &[f64], speeds: &[f64], from: f64, to: f64) -> f64 {
    let inner = times.partition_point(|time| *time <= from)..times.partition_point(|time| *time < to);
    let (mut last, mut value, mut sum) = (from, interpolated(times, speeds, from), 0.0);
    for index in inner {
        sum += 0.5 * (value + speeds[index]) * (times[index] - last);
        (last, value) = (times[index], speeds[index]);
    }
    sum + 0.5 * (value + interpolated(times, speeds, to)) * (to - last)
}
