//! What a fit says of a parameter, and of the directions in which it says nothing.

use bouncing_disk_core::read_checked;

use super::parameter::FitParameter;
use crate::error::{Error, check, finite};
use crate::motor::interval_estimate::IntervalEstimate;

/// A parameter and what the transients say of it.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedEstimate"))]
pub struct ParameterEstimate {
    /// The parameter.
    pub parameter: FitParameter,
    /// Its value in the data sheet, from which the search began (SI).
    pub nominal: f64,
    /// Its value and 95 % interval (SI), within its range; `None` where it has a part in a direction that the
    /// transients do not determine.
    pub estimate: Option<IntervalEstimate>,
}

read_checked!(ParameterEstimate as UncheckedEstimate {
    parameter: FitParameter,
    nominal: f64,
    estimate: Option<IntervalEstimate>,
});

impl ParameterEstimate {
    fn check(&self) -> Result<(), Error> {
        self.parameter.check("nominal", self.nominal)?;
        if let Some(IntervalEstimate { value: _, low, high }) = self.estimate {
            // The value lies between them.
            self.parameter.check("low", low)?;
            self.parameter.check("high", high)?;
        }
        Ok(())
    }
}

/// A direction in the space of the fitted parameters along which the transients hardly change: they do not
/// say where on it the motor is.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedDirection"))]
pub struct UndeterminedDirection {
    /// The direction as a change of each fitted parameter's coordinate ([`FitParameter`]): of the logarithm
    /// of a size, of the restitution, of the phase lag (rad). The largest change is 1; no parameter is named
    /// twice.
    pub direction: Vec<(FitParameter, f64)>,
    /// The standard error along it, in multiples of the direction as it stands, positive; infinite where the
    /// transients do not change at all.
    pub standard_error: f64,
}

read_checked!(UndeterminedDirection as UncheckedDirection {
    direction: Vec<(FitParameter, f64)>,
    #[serde(deserialize_with = "bouncing_disk_core::stored::infinite_if_none")]
    standard_error: f64,
});

impl UndeterminedDirection {
    fn check(&self) -> Result<(), Error> {
        let mut largest = f64::NEG_INFINITY;
        for (k, (parameter, change)) in self.direction.iter().enumerate() {
            let again = self.direction[..k].iter().filter(|(before, _)| before == parameter).count();
            check(again == 0, parameter.name(), (again + 1) as f64, "once in a direction")?;
            finite("direction", *change)?;
            check(change.abs() <= 1.0, "direction", *change, "[-1, 1]")?;
            largest = largest.max(*change);
        }
        check(largest >= 1.0, "direction", largest, "1 for its largest change")?;
        check(self.standard_error > 0.0, "standard_error", self.standard_error, "(0, inf]")?;
        Ok(())
    }
}
