//! A number that was estimated from scattered data, with its interval, and what small samples make intervals
//! with.

use bouncing_disk_core::numerics::statistics::NORMAL_975;

use crate::error::{Error, check, finite};

/// The 97.5 % quantiles of Student's distribution with 1 to 10 degrees of freedom.
const STUDENT_QUANTILES: [f64; 10] = [
    12.706_204_736_432_1,
    4.302_652_729_911_28,
    3.182_446_305_284_26,
    2.776_445_105_197_79,
    2.570_581_836_614_74,
    2.446_911_848_791_68,
    2.364_624_251_592_78,
    2.306_004_135_204_17,
    2.262_157_162_740_99,
    2.228_138_851_964_94,
];

/// An estimated value and the 95 % interval about it, in the unit that stands with the field.
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

    /// The value with an interval that holds it, whatever the sample says of its ends.
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

    /// Whether the intervals of two estimates have a number in common.
    #[must_use]
    pub fn agrees_with(&self, other: &Self) -> bool {
        self.low <= other.high && other.low <= self.high
    }
}

/// The 97.5 % quantile of Student's distribution, for the whole part of the degrees of freedom, at least 1.
///
/// Fewer degrees of freedom have the larger quantile, so that cutting off their fraction makes an interval wider. Beyond
/// ten it is the expansion in the inverse degrees of freedom (Abramowitz and Stegun 26.7.5), off by less than 1e-6.
pub(crate) fn student_quantile(degrees: f64) -> f64 {
    let whole = (degrees as u64).max(1);
    if let Some(quantile) = usize::try_from(whole - 1).ok().and_then(|index| STUDENT_QUANTILES.get(index)) {
        return *quantile;
    }
    let (z, inverse) = (NORMAL_975, 1.0 / whole as f64);
    let square = z * z;
    let terms = [
        z,
        z * (square + 1.0) / 4.0,
        z * ((5.0 * square + 16.0) * square + 3.0) / 96.0,
        z * (((3.0 * square + 19.0) * square + 17.0) * square - 15.0) / 384.0,
        z * ((((79.0 * square + 776.0) * square + 1_482.0) * square - 1_920.0) * square - 945.0) / 92_160.0,
    ];
    terms.iter().rev().fold(0.0, |sum, term| sum * inverse + term)
}

/// How much wider than the bootstrap's an interval must be so that it holds for a sample of `size` independent values: the
/// resampled variance lacks the factor size/(size - 1), and what is left has Student's distribution
/// (docs/numerics/motors.md, "Fits with intervals").
pub(crate) fn small_sample_widening(size: usize) -> f64 {
    let size = size as f64;
    (size / (size - 1.0)).sqrt() * student_quantile(size - 1.0) / NORMAL_975
}

#[cfg(test)]
mod tests {
    use bouncing_disk_core::elementary::{ln, pow};

    use super::*;

    /// The share of Student's distribution between -t and t, by Simpson's rule over the angle atan(x/sqrt(degrees)), in which
    /// its density is a power of the cosine.
    fn share_within(t: f64, degrees: f64) -> f64 {
        let end = bouncing_disk_core::elementary::atan(t / degrees.sqrt());
        let density = |angle: f64| pow(bouncing_disk_core::elementary::cos(angle), degrees - 1.0);
        let integral = |to: f64| {
            let (n, h) = (4_000, to / 4_000.0);
            (0..=n).fold(0.0, |sum, i| {
                let weight = if i == 0 || i == n { 1.0 } else { f64::from(2 + 2 * (i % 2)) };
                sum + weight * density(h * f64::from(i))
            }) * h
                / 3.0
        };
        integral(end) / integral(std::f64::consts::FRAC_PI_2)
    }

    #[test]
    fn quantiles_leave_a_fortieth_on_each_side() {
        for degrees in (1..=40).chain([100, 1_000]) {
            let share = share_within(student_quantile(f64::from(degrees)), f64::from(degrees));
            assert!((share - 0.95).abs() < 1e-6, "{degrees}: {share}");
        }
        assert!((student_quantile(1e15) - NORMAL_975).abs() < 1e-12);
        // Parts of a degree, none, and what is no number are the next legal degrees below.
        for (degrees, same) in [(7.9, 7.0), (0.3, 1.0), (-3.0, 1.0), (f64::NAN, 1.0)] {
            assert!((student_quantile(degrees) - student_quantile(same)).abs() <= 0.0, "{degrees}");
        }
        assert!(ln(student_quantile(f64::INFINITY)).is_finite());
    }

    #[test]
    fn an_interval_holds_its_value() {
        let estimate = IntervalEstimate::about(2.0, 2.5, 1.0).expect("finite");
        assert_eq!(estimate, IntervalEstimate { value: 2.0, low: 2.0, high: 2.0 });
        assert!(estimate.contains(2.0) && !estimate.contains(2.1) && !estimate.contains(f64::NAN));
        let wide = IntervalEstimate { value: 1.0, low: 0.5, high: 2.0 };
        assert!(wide.agrees_with(&estimate) && estimate.agrees_with(&wide));
        assert!(!wide.agrees_with(&IntervalEstimate { value: 3.0, low: 2.1, high: 4.0 }));
        for bad in [f64::NAN, f64::INFINITY] {
            assert!(
                IntervalEstimate::about(bad, 0.0, 1.0).is_err()
                    && IntervalEstimate::about(0.0, -1.0, bad.abs() + bad).is_err() == bad.is_infinite()
            );
        }
    }
}
