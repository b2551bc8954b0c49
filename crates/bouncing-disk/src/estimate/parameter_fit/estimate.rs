//! What a fit says of a parameter, and of the directions in which it says nothing.

use crate::estimate::interval::IntervalEstimate;
use crate::estimate::parameter_fit::parameter::FitParameter;

/// A parameter and what the transients say of it.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ParameterEstimate {
    /// The parameter.
    pub parameter: FitParameter,
    /// Its value in the data sheet, from which the search began (SI).
    pub nominal: f64,
    /// Its value and 95 % interval (SI), within its range; `None` where it has a part in a direction that the
    /// transients do not determine.
    pub estimate: Option<IntervalEstimate>,
}

/// A direction in the space of the fitted parameters along which the transients hardly change: they do not
/// say where on it the motor is.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct UndeterminedDirection {
    /// The direction as a change of each fitted parameter's coordinate ([`FitParameter`]): of the logarithm
    /// of a size, of the restitution, of the phase lag (rad). The largest change is 1; no parameter is named
    /// twice.
    pub direction: Vec<(FitParameter, f64)>,
    /// The standard error along it, in multiples of the direction as it stands, positive; infinite where the
    /// transients do not change at all.
    pub standard_error: f64,
}
