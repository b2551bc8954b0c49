//! Why a fit has no result.

use crate::display::rough;
use crate::error::Error;
use crate::estimate::interval::IntervalEstimate;

/// Why a fit has no result.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FitError {
    /// A curve does not allow a trustworthy fit.
    #[error("the curve is not fitted: {0}")]
    Refused(FitRefusal),
    /// An error of the model, or of the core, which includes a stop by the observer.
    #[error(transparent)]
    Model(#[from] Error),
}

impl From<bouncing_disk_core::Error> for FitError {
    fn from(error: bouncing_disk_core::Error) -> Self {
        Self::Model(error.into())
    }
}

/// A rejected fit.
pub(crate) const fn refused<T>(reason: FitRefusal) -> Result<T, FitError> {
    Err(FitError::Refused(reason))
}

/// Why a curve does not allow a trustworthy fit. Every reason states the numbers on which it is based.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub enum FitRefusal {
    /// The curve has too few points.
    #[error("it has {points} points, but {least} are needed: sample it more often")]
    TooFewPoints {
        /// Number of points of the curve, or of the part that counts.
        points: usize,
        /// Fewest points that are fitted.
        least: usize,
    },
    /// There are too few members to estimate the error from their scatter.
    #[error(
        "it has {members} members, but {least} are needed: compute more, or fit a single curve as a measured one"
    )]
    TooFewMembers {
        /// Number of members given.
        members: usize,
        /// Fewest members that are resampled.
        least: usize,
    },
    /// The speed does not change, so a time constant has no meaning.
    #[error(
        "the speed does not change, so the time constant is undefined: take a smaller load or a stronger stator"
    )]
    NoRise,
    /// The motor does not rise from rest at time zero, contrary to the settings.
    #[error(
        "the motor does not rise from rest at time zero: at {start_time:?} s its speed is {:?} rad/s ({:?} to {:?}), as if \
         it rose from rest at {zero_time:?} s. Fit it without a start from rest, or subtract the time of the switch-on \
         and the dead time from the times", start_speed.value, start_speed.low, start_speed.high
    )]
    NotFromRest {
        /// Time of the first row after a dead time (s).
        start_time: f64,
        /// Speed at this time (rad/s).
        start_speed: IntervalEstimate,
        /// The time at which the fitted exponential is at rest (s).
        zero_time: f64,
    },
    /// The fitted time constant lies at an end of its search range: the curve does not determine it.
    #[error(
        "the time constant {time_constant:?} s lies at the limit of its search, {shortest:?} to {longest:?} s: the \
         speed is a straight line or constant, so take another duration"
    )]
    AtSearchLimit {
        /// Fitted time constant t_c (s).
        time_constant: f64,
        /// Lower limit of the search (s).
        shortest: f64,
        /// Upper limit of the search (s).
        longest: f64,
    },
    /// The curve ends before its speed has settled.
    #[error(
        "its duration of {duration:?} s is less than {least:?} times the time constant, which may be {} s: take a \
         longer one",
        rough(*time_constant)
    )]
    TooShort {
        /// Last time of the curve (s).
        duration: f64,
        /// Time constant t_c (s): the fitted one, or, if `least` is 1, the upper end of its interval.
        time_constant: f64,
        /// The fewest time constants that a curve must last.
        least: f64,
    },
    /// The curve has too few points while its speed rises.
    #[error(
        "only {points} of its points lie within the time constant {time_constant:?} s, but {least} are needed: take \
         shorter intervals, or a shorter duration"
    )]
    TooCoarse {
        /// Points up to the fitted time constant.
        points: usize,
        /// Fitted time constant t_c (s).
        time_constant: f64,
        /// The fewest points.
        least: usize,
    },
    /// The members make too few flights within the time constant: an apparent plateau is a flight, during which
    /// the speed does not change.
    #[error(
        "it has {flights:?} flights within the time constant {time_constant:?} s, but {least:?} are needed: the \
         apparent plateau is a flight, so take a longer duration"
    )]
    TooFewFlights {
        /// Mean number of flights of a member within the time constant.
        flights: f64,
        /// Fitted time constant t_c (s).
        time_constant: f64,
        /// The fewest flights.
        least: f64,
    },
    /// The curve has another form, or scatters too much.
    #[error(
        "its residual {residual:?} rad/s is more than {largest:?} of the steady speed {steady_speed:?} rad/s: take \
         more members, or allow a larger residual"
    )]
    Residual {
        /// Root mean square of the residuals (rad/s).
        residual: f64,
        /// Fitted steady speed alpha_ss (rad/s).
        steady_speed: f64,
        /// Largest accepted share of the steady speed.
        largest: f64,
    },
    /// The residuals are correlated over so many points that too few are independent.
    #[error(
        "its residuals are correlated over {correlated_points:?} of its {points} points, too many to estimate the \
         error. Either the drive or the load changes, so that the curve has another form: leave out the rows \
         measured during the change. Or the noise is slow: repeat the measurement"
    )]
    Correlated {
        /// Integrated correlation time of the residuals, in points.
        correlated_points: f64,
        /// Number of points of the curve, or of the part that counts.
        points: usize,
    },
    /// Many of the resampled curves have no time constant near the curve's own.
    #[error(
        "{astray} of {resamples} resampled curves have a time constant at least five times longer or shorter: take \
         more members or a longer duration"
    )]
    Undetermined {
        /// Number of resampled curves whose time constant is out of range.
        astray: usize,
        /// Number of all resampled curves.
        resamples: usize,
    },
    /// A braking tail does not slow down.
    #[cfg(feature = "fit")]
    #[error("its speed goes from {first:?} to {last:?} rad/s, but a braking tail must slow down")]
    NotBraking {
        /// Mean speed of its first tenth (rad/s).
        first: f64,
        /// Mean speed of its last tenth (rad/s).
        last: f64,
    },
    /// The speeds of a transient have an offset.
    #[cfg(feature = "fit")]
    #[error(
        "the speeds of transient {transient} (counted from 0) seem to be offset by {offset:?} rad/s (standard \
         error {standard_error:?} rad/s): subtract the reading of the instrument at rest"
    )]
    Offset {
        /// Index of the transient.
        transient: usize,
        /// The offset (rad/s).
        offset: f64,
        /// The standard error of the offset if its true value is zero (rad/s).
        standard_error: f64,
    },
    /// The speeds of a transient drift.
    #[cfg(feature = "fit")]
    #[error(
        "the speeds of transient {transient} (counted from 0) seem to drift by {drift:?} rad/s^2 (standard error \
         {standard_error:?}): the motor warms up, the load changes, or the instrument drifts"
    )]
    Drift {
        /// Index of the transient.
        transient: usize,
        /// The drift (rad/s^2).
        drift: f64,
        /// The standard error of the drift if its true value is zero (rad/s^2).
        standard_error: f64,
    },
    /// No parameters in their ranges describe the measurements.
    #[cfg(feature = "fit")]
    #[error(
        "the sum of weighted squares is {misfit:?} for {degrees_of_freedom} degrees of freedom, more than the \
         largest accepted {largest:?}: the model does not describe the measurements, or their errors are larger \
         than stated"
    )]
    Misfit {
        /// Sum of the weighted squares.
        misfit: f64,
        /// Its expectation.
        degrees_of_freedom: usize,
        /// Largest accepted sum.
        largest: f64,
    },
}
