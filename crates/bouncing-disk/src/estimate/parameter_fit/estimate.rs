//! The estimate of a parameter, and the directions that a fit leaves undetermined.

use std::fmt::{self, Display, Formatter};

use crate::display::numbers;
use crate::estimate::interval::IntervalEstimate;
use crate::estimate::parameter_fit::parameter::FitParameter;

/// A parameter and its estimate from the transients.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ParameterEstimate {
    /// The parameter.
    pub parameter: FitParameter,
    /// Its value in the data sheet, from which the search began (SI).
    pub nominal: f64,
    /// Its value and 95 % interval (SI), within its range; `None` if it takes part in a direction that the
    /// transients do not determine.
    pub estimate: Option<IntervalEstimate>,
}

/// Contact times that a fit of the contact time does not exclude with 95 % confidence.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ContactTimes {
    /// The shortest (s); `None` where they reach the lower end of the range that was scanned, or times below a
    /// tenth of a period, which transients hardly tell from rigid impacts.
    pub low: Option<f64>,
    /// The longest (s); `None` where they reach the upper end of the range.
    pub high: Option<f64>,
}

impl Display for ContactTimes {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let n = numbers(f);
        match (self.low, self.high) {
            (Some(low), Some(high)) => write!(f, "{} to {} s", n(low), n(high)),
            (None, Some(high)) => write!(f, "at most {} s", n(high)),
            (Some(low), None) => write!(f, "at least {} s", n(low)),
            (None, None) => f.write_str("anywhere in the range"),
        }
    }
}

/// A direction in the space of the fitted parameters along which the transients hardly change: they do not
/// determine the motor's place on it.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct UndeterminedDirection {
    /// The direction as a change of each fitted parameter's coordinate ([`FitParameter`]): of the logarithm
    /// of a size, of the restitution, of the phase lag (rad). The largest change is 1; no parameter is named
    /// twice.
    pub direction: Vec<(FitParameter, f64)>,
    /// The standard error along it, in multiples of the direction as given, positive; infinite where the
    /// transients do not change at all.
    pub standard_error: f64,
}
