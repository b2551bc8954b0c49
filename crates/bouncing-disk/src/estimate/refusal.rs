//! Why a fit has no result.

use crate::error::Error;
use crate::estimate::interval::IntervalEstimate;
#[cfg(feature = "fit")]
use crate::estimate::parameter_fit::parameter::FitParameter;

/// Why a fit has no result.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FitError {
    /// A curve gives no trustworthy fit.
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

/// A fit that is refused.
pub(crate) const fn refused<T>(reason: FitRefusal) -> Result<T, FitError> {
    Err(FitError::Refused(reason))
}

/// Why a curve gives no trustworthy fit. Every reason carries the numbers by which it was judged.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub enum FitRefusal {
    /// The curve has too few points.
    #[error("it has {points} points, but {least} are needed: sample it more often")]
    TooFewPoints {
        /// Points of the curve, or of its part that counts.
        points: usize,
        /// The fewest that are fitted.
        least: usize,
    },
    /// There are too few members for their scatter to give the error.
    #[error(
        "it has {members} members, but {least} are needed: compute more, or fit a single curve as a measured one"
    )]
    TooFewMembers {
        /// Members that were given.
        members: usize,
        /// The fewest that are resampled.
        least: usize,
    },
    /// The speed does not change, and a time constant has no meaning.
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
        "its duration {duration:?} s is less than {least:?} times the time constant, which is or may be {time_constant:?} \
         s: take a longer one"
    )]
    TooShort {
        /// Last time of the curve (s).
        duration: f64,
        /// Time constant t_c (s): the fitted one, or, where `least` is 1, the upper end of its interval.
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
    /// The members hardly fly within the time constant: an apparent plateau is a flight, during which no
    /// speed changes.
    #[error(
        "{flights:?} flights within the time constant {time_constant:?} s are too few, {least:?} are needed: what \
         looks like a plateau is a flight, so take a longer duration"
    )]
    TooFewFlights {
        /// Flights of a member within the time constant, on average.
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
        /// The largest share of the steady speed that is accepted.
        largest: f64,
    },
    /// The residuals are correlated for so long that the curve holds too few independent ones.
    #[error(
        "its residuals are correlated over {correlated_points:?} of its {points} points, too many to estimate the error: \
         another form, such as that of a motor whose drive or load changes, or slow noise; leave out the rows in which the \
         form is another, or repeat a curve whose noise is slow"
    )]
    Correlated {
        /// Integrated correlation time of the residuals, in points.
        correlated_points: f64,
        /// Points of the curve, or of its part that counts.
        points: usize,
    },
    /// Many of the resampled curves have no time constant near that of the curve.
    #[error(
        "{astray} of {resamples} resampled curves have a time constant five times as long or as short: take more \
         members or a longer duration"
    )]
    Undetermined {
        /// Resampled curves whose time constant is out of reach.
        astray: usize,
        /// All resampled curves.
        resamples: usize,
    },
    /// The speed does not fall, or its fall is not significant.
    #[error(
        "the deceleration {deceleration:?} rad/s^2 is not significantly above zero: its interval begins at {low:?} rad/s^2"
    )]
    NotBraking {
        /// Fitted angular deceleration (rad/s^2).
        deceleration: f64,
        /// Lower end of its 95 % interval (rad/s^2).
        low: f64,
    },
    /// The speed does not fall along a straight line.
    #[error(
        "the deceleration changes from {first_half:?} to {last_half:?} rad/s^2 while the disk slides: use the part \
         of the curve in which only friction brakes"
    )]
    NotStraight {
        /// Angular deceleration in the first half of the sliding part (rad/s^2).
        first_half: f64,
        /// Angular deceleration in its last half (rad/s^2).
        last_half: f64,
    },
    /// The times of a transient do not count from the switch-on.
    #[cfg(feature = "fit")]
    #[error(
        "transient {transient} (counted from 0) rises as if it had been switched on about {early:?} s before time zero, where the \
         standard error of a correct clock is {standard_error:?} s: count its times from the switch-on"
    )]
    ShiftedClock {
        /// Its place in the list.
        transient: usize,
        /// The time from the switch-on to time zero (s), to first order; below zero for a dead time.
        early: f64,
        /// Its standard error (s) if the clock is right.
        standard_error: f64,
    },
    /// The search for the best parameters did not converge.
    #[cfg(feature = "fit")]
    #[error(
        "the search found no best parameters in {evaluations} evaluations: allow more, or begin nearer to them"
    )]
    NotConverged {
        /// Evaluations of all motors.
        evaluations: usize,
    },
    /// A parameter lies at the end of its range: the range was too narrow, or the model is not that of the
    /// motor.
    #[cfg(feature = "fit")]
    #[error("{parameter} = {value:?} lies at the end of its range [{low:?}, {high:?}]: take a wider one")]
    AtRangeEnd {
        /// The parameter.
        parameter: FitParameter,
        /// Its value (SI).
        value: f64,
        /// Lower end of its range.
        low: f64,
        /// Upper end of its range.
        high: f64,
    },
    /// No parameters in their ranges describe the transients.
    #[cfg(feature = "fit")]
    #[error(
        "the sum of weighted squares is {misfit:?} for {degrees_of_freedom} degrees of freedom, more than the largest \
         accepted {largest:?}: the model does not describe these transients, or their errors are larger than stated"
    )]
    Misfit {
        /// Sum of the weighted squares.
        misfit: f64,
        /// Its expectation.
        degrees_of_freedom: usize,
        /// The largest that is accepted.
        largest: f64,
    },
}
