//! Measured run-ups of one motor at a known preload.

use crate::error::{Error, check, not_negative};
use crate::estimate::measured_speeds::MeasuredSpeeds;
use crate::estimate::refusal::{FitError, FitRefusal, refused};
use crate::motor::data_sheet::Motor;

/// The fewest points of a run.
pub(crate) const LEAST_POINTS: usize = 8;

/// The preload of a run.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum RunPreload {
    /// The total force F that presses the rotor onto the stator (N), positive.
    Force(f64),
    /// The acceleration g = F/m (m/s^2), positive.
    Acceleration(f64),
}

/// Run-ups from rest of one motor at one preload: one, or several independent ones.
///
/// Times count from the instant at which the motor is switched on. Only the time covered by all runs is used,
/// up to the last time of the shortest.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct MeasuredTransient {
    /// The preload.
    pub preload: RunPreload,
    /// The runs, each of at least eight points.
    pub runs: MeasuredSpeeds,
    /// Standard deviation of the error of one measured speed (rad/s), not negative, independent from point to
    /// point. `None` takes the distance of each point from the line between its neighbours: this counts some
    /// of the motor's own fluctuation as error, and makes intervals a little wider.
    pub speed_error: Option<f64>,
}

impl MeasuredTransient {
    /// Whether a fit can begin with it.
    pub(crate) fn check_for_fit(&self) -> Result<(), FitError> {
        let (RunPreload::Force(preload) | RunPreload::Acceleration(preload)) = self.preload;
        check(preload.is_finite() && preload > 0.0, "preload", preload, "(0, inf)")?;
        self.speed_error.map_or(Ok(0.0), |error| not_negative("speed_error", error))?;
        for run in self.runs.runs() {
            let points = run.times.iter().filter(|&&time| time > 0.0 && time <= self.duration()).count();
            if points < LEAST_POINTS {
                return refused(FitRefusal::TooFewPoints { points, least: LEAST_POINTS });
            }
        }
        if self.runs.runs().iter().all(|run| run.speeds.iter().all(|&speed| speed.abs() <= 0.0)) {
            return refused(FitRefusal::NoRise);
        }
        Ok(())
    }

    /// How long all runs last (s).
    pub(crate) fn duration(&self) -> f64 {
        let last = |times: &[f64]| times.last().copied().unwrap_or(0.0);
        self.runs.runs().iter().fold(f64::INFINITY, |least, run| least.min(last(&run.times)))
    }

    /// The motor at this preload.
    pub(crate) fn motor(&self, motor: &Motor) -> Result<Motor, Error> {
        motor.with(|sheet| match self.preload {
            RunPreload::Force(force) => {
                (sheet.preload_force, sheet.preload_acceleration) = (Some(force), None);
            }
            RunPreload::Acceleration(acceleration) => {
                (sheet.preload_force, sheet.preload_acceleration) = (None, Some(acceleration));
            }
        })
    }

    /// Variance of the error of one measured speed.
    pub(crate) fn error_variance(&self) -> Result<f64, Error> {
        if let Some(error) = self.speed_error {
            return check((error * error).is_finite(), "speed_error", error, "[0, 1e154] (rad/s)")
                .map(|e| e * e);
        }
        let (mut sum, mut count) = (0.0, 0.0);
        for run in self.runs.runs() {
            for (t, y) in run.times.windows(3).zip(run.speeds.windows(3)) {
                // Of independent errors of variance one this has the variance 1 + share^2 + (1 - share)^2.
                let share = (t[1] - t[0]) / (t[2] - t[0]);
                let off = y[1] - y[0] - share * (y[2] - y[0]);
                sum += off * off / (1.0 + share * share + (1.0 - share) * (1.0 - share));
                count += 1.0;
            }
        }
        let variance: f64 = sum / count;
        check(variance.is_finite(), "square of a measured speed", variance, "finite")
    }
}
