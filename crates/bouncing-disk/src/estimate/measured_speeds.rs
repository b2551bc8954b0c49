//! Measured speeds against time: one run or several of the same motor.

#[cfg(feature = "csv")]
pub(crate) mod csv_file;
#[cfg(feature = "csv")]
pub(crate) mod decimal_marks;
#[cfg(feature = "csv")]
pub(crate) mod error;
pub(crate) mod units;

use bouncing_disk_core::Observer;

use crate::error::{Error, check, within_limit};
use crate::estimate::measured_speeds::units::{SpeedUnit, TimeUnit};
use crate::estimate::refusal::FitError;
use crate::estimate::transient_fit::{FitSettings, TransientFit};
use crate::motor::batch::members::MAX_SPEEDS;
use crate::motor::data_sheet::Motor;
use crate::motor::data_sheet::warning::MotorWarning;
use crate::motor::rotor::transient::check_rows;

/// A measurement this many times above or below the drive's prediction seems to be in another unit.
const OTHER_SCALE: f64 = 100.0;

/// One run: angular speed against time.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct MeasuredRun {
    /// Number that identifies the run; 0 if there is only one.
    pub member: u32,
    /// Times (s), rising, possibly below zero: the switch-on and any dead time may be unknown.
    pub times: Vec<f64>,
    /// Angular speeds (rad/s).
    pub speeds: Vec<f64>,
}

/// Measured speeds of one motor, in one or several runs.
///
/// ```
/// # use bouncing_disk::core::Unobserved;
/// use bouncing_disk::core::numerics::elementary::exp;
/// use bouncing_disk::estimate::{FitSettings, MeasuredRun, MeasuredSpeeds};
///
/// // Synthetic: every 20 ms, rounded to a tenth of a rad/s as an instrument shows it.
/// let times: Vec<f64> = (0..200).map(|i| 0.02 * f64::from(i)).collect();
/// let speeds = times.iter().map(|time| 200.0 * (1.0 - exp(-time / 0.5))).map(|speed| speed.round() / 10.0);
/// let measured = MeasuredSpeeds::new(vec![MeasuredRun { member: 0, speeds: speeds.collect(), times }])?;
/// let fit = measured.fit(&FitSettings::default(), &Unobserved)?;
/// assert!((fit.time_constant().value - 0.5).abs() < 1e-3);
/// # Ok::<(), bouncing_disk::estimate::FitError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct MeasuredSpeeds {
    runs: Vec<MeasuredRun>,
    #[cfg_attr(feature = "serde", serde(skip))]
    units: (TimeUnit, SpeedUnit),
}

impl MeasuredSpeeds {
    /// The speeds of at least one run, with increasing run numbers.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if there are no runs, for run numbers that do not rise, fewer than three points in a run,
    /// lists of different lengths, times that do not rise, and numbers that are not finite; an error of the
    /// core for more than [`MAX_SPEEDS`] speeds.
    pub fn new(runs: Vec<MeasuredRun>) -> Result<Self, Error> {
        check(!runs.is_empty(), "runs", 0.0, "[1, inf)")?;
        for (k, run) in runs.iter().enumerate() {
            check_rows(&run.times, &run.speeds)?;
            let again = k > 0 && runs[k - 1].member >= run.member;
            check(!again, "member", f64::from(run.member), "greater than the number of the run before")?;
        }
        let speeds = runs.iter().map(|run| run.speeds.len()).sum();
        within_limit("speeds of all runs", speeds, MAX_SPEEDS)?;
        Ok(Self { runs, units: Default::default() })
    }

    /// The runs, at least one.
    #[must_use]
    pub fn runs(&self) -> &[MeasuredRun] {
        &self.runs
    }

    /// The units of the file, from which times and speeds were converted.
    #[must_use]
    pub const fn file_units(&self) -> (TimeUnit, SpeedUnit) {
        self.units
    }

    /// Steady speed and time constant with intervals, from all runs together ([`TransientFit::of_measured`]).
    ///
    /// The observer's items are the resampled curves, once for each form.
    ///
    /// # Errors
    /// The errors of [`TransientFit::of_measured`].
    pub fn fit(&self, settings: &FitSettings, observer: &dyn Observer) -> Result<TransientFit, FitError> {
        let runs: Vec<_> =
            self.runs.iter().map(|run| (run.times.as_slice(), run.speeds.as_slice())).collect();
        TransientFit::of_measured(&runs, settings, observer)
    }
}

impl Motor {
    /// Warnings if measured run-ups are faster or slower than the drive allows by a factor of 100. The fastest
    /// speed is compared with omega Phi, and the time from the first row to half that speed with the shortest
    /// rise time ([`System::rise_time`](crate::System::rise_time)).
    #[must_use]
    pub fn warnings_on(&self, speeds: &MeasuredSpeeds) -> Vec<MotorWarning> {
        let system = self.system();
        let mut warnings = Vec::new();
        for run in speeds.runs() {
            let fastest = run.speeds.iter().fold(0.0, |most: f64, speed| most.max(speed.abs()));
            let half = run.speeds.iter().position(|speed| speed.abs() >= 0.5 * fastest);
            let rise = half.map_or(0.0, |row| run.times[row] - run.times[0]);
            for (measured, drive, unit) in
                [(fastest, system.platform().peak_angular_speed(), "rad/s"), (rise, system.rise_time(), "s")]
            {
                // A zero measurement, or a stator that does not twist, shows nothing about the unit.
                let ratio = measured / drive;
                if ratio > 0.0 && ratio.is_finite() && !(1.0 / OTHER_SCALE..=OTHER_SCALE).contains(&ratio) {
                    warnings.push(MotorWarning::OtherScale { measured, drive, unit });
                }
            }
        }
        warnings
    }
}

#[cfg(test)]
mod tests;
