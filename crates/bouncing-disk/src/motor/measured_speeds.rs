//! Measured speeds against time: one run or several of the same motor.

#[cfg(feature = "csv")]
pub(crate) mod csv_file;
#[cfg(feature = "csv")]
pub(crate) mod error;

use bouncing_disk_core::{Observer, Unobserved, read_checked};

use crate::error::{Error, check, within_limit};
use crate::motor::braking_fit::{BrakingFit, BrakingRotor};
use crate::motor::ensemble::MAX_SPEEDS;
use crate::motor::fit::check_curve;
use crate::motor::transient_fit::{FitSettings, TransientFit};

/// One run: angular speed against time.
///
/// One that is read is a curve: at least three points, as many speeds as times, times that are not negative
/// and rise.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedRun"))]
pub struct MeasuredRun {
    /// Number by which the run is known; 0 where there is only one.
    pub member: u32,
    /// Times (s), not negative, rising: since the motor was switched on, or since it brakes.
    pub times: Vec<f64>,
    /// Angular speeds (rad/s).
    pub speeds: Vec<f64>,
}

read_checked!(MeasuredRun as UncheckedRun {
    member: u32,
    times: Vec<f64>,
    speeds: Vec<f64>,
});

impl MeasuredRun {
    fn check(&self) -> Result<(), Error> {
        check_curve(&self.times, &self.speeds)
    }
}

/// Measured speeds of one motor, in one run or several.
///
/// ```
/// use bouncing_disk::core::elementary::exp;
/// use bouncing_disk::{FitSettings, MeasuredRun, MeasuredSpeeds};
///
/// // Synthetic: every 20 ms, rounded to a tenth of a rad/s as an instrument shows it.
/// let times: Vec<f64> = (0..200).map(|i| 0.02 * f64::from(i)).collect();
/// let speeds = times.iter().map(|time| 200.0 * (1.0 - exp(-time / 0.5))).map(|speed| speed.round() / 10.0);
/// let measured = MeasuredSpeeds::new(vec![MeasuredRun { member: 0, speeds: speeds.collect(), times }])?;
/// let fit = measured.fit(&FitSettings::default())?;
/// assert!((fit.time_constant().value - 0.5).abs() < 1e-3);
/// # Ok::<(), bouncing_disk::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedSpeeds"))]
pub struct MeasuredSpeeds {
    runs: Vec<MeasuredRun>,
}

read_checked!(MeasuredSpeeds as UncheckedSpeeds {
    runs: Vec<MeasuredRun>,
});

impl MeasuredSpeeds {
    fn check(&self) -> Result<(), Error> {
        check(!self.runs.is_empty(), "runs", 0.0, "[1, inf)")?;
        for (k, run) in self.runs.iter().enumerate() {
            run.check()?;
            let again = self.runs[..k].last().is_some_and(|before| before.member >= run.member);
            check(!again, "member", f64::from(run.member), "rising from run to run")?;
        }
        let speeds = self.runs.iter().map(|run| run.speeds.len()).sum();
        within_limit("speeds of all runs", speeds, MAX_SPEEDS)?;
        Ok(())
    }

    /// Of at least one run, their numbers rising.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for no run, numbers that do not rise, fewer than three points in a run, lists of
    /// different lengths, times that do not rise and numbers that are not finite; an error of the core for
    /// more than [`MAX_SPEEDS`] speeds.
    pub fn new(runs: Vec<MeasuredRun>) -> Result<Self, Error> {
        let measured = Self { runs };
        measured.check()?;
        Ok(measured)
    }

    /// The runs, at least one.
    #[must_use]
    pub fn runs(&self) -> &[MeasuredRun] {
        &self.runs
    }

    /// Steady speed and time constant with intervals: of the mean over all runs, which must have been
    /// measured at the same times, or of the only one ([`TransientFit::of_runs`],
    /// [`TransientFit::of_measured`]).
    ///
    /// # Errors
    /// Those of [`TransientFit::new`]; [`Error::OutOfRange`] names a time that is not that of the first run.
    pub fn fit(&self, settings: &FitSettings) -> Result<TransientFit, Error> {
        self.fit_observed(settings, &Unobserved)
    }

    /// [`Self::fit`] with an observer; the items are the resampled curves, once for each form.
    ///
    /// # Errors
    /// Those of [`Self::fit`]; an error of the core ([`Stopped`](bouncing_disk_core::Error::Stopped)) if the
    /// observer breaks.
    pub fn fit_observed(
        &self,
        settings: &FitSettings,
        observer: &dyn Observer,
    ) -> Result<TransientFit, Error> {
        if let [run] = self.runs.as_slice() {
            return TransientFit::of_measured_observed(&run.times, &run.speeds, settings, observer);
        }
        let times = &self.runs[0].times;
        for run in &self.runs {
            let (own, first) = (run.times.len(), times.len());
            check(own == first, "number of times of a run", own as f64, "that of the first run")?;
            for (&own, first) in run.times.iter().zip(times) {
                check(own.total_cmp(first).is_eq(), "time of a run (s)", own, "that of the first run")?;
            }
        }
        let runs: Vec<&[f64]> = self.runs.iter().map(|run| run.speeds.as_slice()).collect();
        TransientFit::of_runs_observed(times, &runs, settings, observer)
    }

    /// The friction with its interval from each run, all of which are braking curves of this rotor.
    ///
    /// # Errors
    /// Those of [`BrakingFit::new`], for the first run that has one.
    pub fn fit_braking(&self, rotor: &BrakingRotor) -> Result<Vec<BrakingFit>, Error> {
        self.runs.iter().map(|run| BrakingFit::new(&run.times, &run.speeds, rotor)).collect()
    }
}

#[cfg(test)]
mod tests;
