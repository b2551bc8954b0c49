//! Ranges of a parameter that a fit accepts, and the directions that it leaves undetermined.

use std::fmt::{self, Display, Formatter};

use crate::display::numbers;
use crate::estimate::motor_fit::display::behind;
use crate::estimate::motor_fit::parameter::FitParameter;

/// A range of a parameter that a fit does not exclude with 95 % confidence.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct AcceptedRange {
    /// The parameter.
    pub parameter: FitParameter,
    /// The lowest value (SI); `None` if the range reaches the lower end of the search, or contact times below
    /// a tenth of a period, which can hardly be distinguished from rigid impacts.
    pub low: Option<f64>,
    /// The highest value (SI); `None` if the range reaches the upper end.
    pub high: Option<f64>,
}

impl AcceptedRange {
    /// Whether the range contains a value that lies within the searched range.
    #[must_use]
    pub fn contains(&self, value: f64) -> bool {
        self.low.is_none_or(|low| low <= value) && self.high.is_none_or(|high| value <= high)
    }
}

impl Display for AcceptedRange {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let (n, unit) = (numbers(f), behind(self.parameter.unit()));
        match (self.low, self.high) {
            (Some(low), Some(high)) => write!(f, "{} to {}{unit}", n(low), n(high)),
            (None, Some(high)) => write!(f, "at most {}{unit}", n(high)),
            (Some(low), None) => write!(f, "at least {}{unit}", n(low)),
            (None, None) => f.write_str("anywhere in the range"),
        }
    }
}

/// A direction in the space of the fitted parameters along which the measurements hardly change, so that the
/// motor's position along it remains unknown.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct UndeterminedDirection {
    /// The direction as a change of each fitted parameter's coordinate ([`FitParameter`]): the logarithm of a
    /// size, the restitution, or the phase lag (rad). The largest change is 1; each parameter appears once.
    pub direction: Vec<(FitParameter, f64)>,
    /// The standard error along the direction, in multiples of `direction`, positive; infinite if the
    /// measurements do not change at all.
    pub standard_error: f64,
}
