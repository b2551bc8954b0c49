//! A number estimated from scattered data, with its interval.

use crate::display::numbers;
use crate::error::{Error, check, finite};
use std::fmt::{self, Display, Formatter};

/// An estimated value and the 95 % interval about it, in the unit of the field.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct IntervalEstimate {
    /// The estimate, finite.
    pub value: f64,
    /// Lower end of the 95 % interval, finite, not above the value.
    pub low: f64,
    /// Upper end of the 95 % interval, finite, not below the value.
    pub high: f64,
}

impl IntervalEstimate {
    fn check(&self) -> Result<(), Error> {
        finite("value", self.value)?;
        finite("low", self.low)?;
        finite("high", self.high)?;
        check(self.low <= self.value, "low", self.low, "(-inf, value]")?;
        check(self.high >= self.value, "high", self.high, "[value, inf)")?;
        Ok(())
    }

    /// The value with an interval that contains it, even if the sampled ends do not.
    pub(crate) fn about(value: f64, low: f64, high: f64) -> Result<Self, Error> {
        let estimate = Self { value, low: low.min(value), high: high.max(value) };
        estimate.check()?;
        Ok(estimate)
    }

    /// Whether a number lies in the interval, its ends included.
    #[must_use]
    pub fn contains(&self, number: f64) -> bool {
        (self.low..=self.high).contains(&number)
    }
}

impl Display for IntervalEstimate {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let n = numbers(f);
        write!(f, "{} (95 %: {} to {})", n(self.value), n(self.low), n(self.high))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_interval_holds_its_value() {
        let estimate = IntervalEstimate::about(2.0, 2.5, 1.0).expect("finite");
        assert_eq!(estimate, IntervalEstimate { value: 2.0, low: 2.0, high: 2.0 });
        assert!(estimate.contains(2.0) && !estimate.contains(2.1) && !estimate.contains(f64::NAN));
        for bad in [f64::NAN, f64::INFINITY] {
            assert!(
                IntervalEstimate::about(bad, 0.0, 1.0).is_err()
                    && IntervalEstimate::about(0.0, -1.0, bad.abs() + bad).is_err() == bad.is_infinite()
            );
        }
    }
}
