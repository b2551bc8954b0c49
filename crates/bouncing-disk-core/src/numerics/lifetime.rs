//! The mean lifetime of a motion that orbits leave at a constant rate, estimated from orbits followed on it.

use crate::numerics::error::{Error, not_negative};
use crate::numerics::statistics::NORMAL_975;
use crate::numerics::stored::read_checked;

/// With 95 % confidence the mean lifetime of a motion that no orbit has left exceeds the impacts of all
/// orbits divided by this: ln 20.
const NONE_LEFT: f64 = 2.995_732_273_553_991;

/// The 2.5 % quantile of chi squared for two degrees of freedom, halved: -ln 0.975.
const ONE_LEFT: f64 = 0.025_317_807_984_289_876;

/// The mean lifetime of a motion that orbits leave at a constant rate: the impacts of all orbits followed on
/// it, over the number of orbits that left. The impacts of orbits that have not left also count.
///
/// ```
/// use bouncing_disk_core::numerics::lifetime::Lifetime;
///
/// let life = Lifetime::new(1.0e6, 40)?;
/// assert_eq!(life.mean(), Some(25_000.0));
/// let (low, high) = life.interval();
/// assert!(low > 18_000.0 && high < 35_000.0);
/// # Ok::<(), bouncing_disk_core::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedLifetime"))]
pub struct Lifetime {
    impacts: f64,
    left: u64,
}

read_checked!(Lifetime as UncheckedLifetime { impacts: f64, left: u64 } => Lifetime::new);

impl Lifetime {
    /// `left` orbits left after `impacts` >= 0 impacts of all orbits together.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for impacts that are negative or not finite.
    pub fn new(impacts: f64, left: u64) -> Result<Self, Error> {
        not_negative("impacts of all orbits", impacts)?;
        Ok(Self { impacts, left })
    }

    /// Impacts of all orbits.
    #[must_use]
    pub const fn impacts(&self) -> f64 {
        self.impacts
    }

    /// Orbits that left.
    #[must_use]
    pub const fn left(&self) -> u64 {
        self.left
    }

    /// The mean lifetime in impacts; `None` if no orbit has left.
    #[must_use]
    pub fn mean(&self) -> Option<f64> {
        (self.left > 0).then(|| self.impacts / self.left as f64)
    }

    /// The 95 % interval of the mean lifetime (impacts): twice the impacts over the quantiles of chi squared
    /// (B. Epstein, Technometrics 2, 447 (1960)). If n orbits left, there are 2 n degrees of freedom for the
    /// upper end and 2 n + 2 for the lower. The quantiles are approximated after E. B. Wilson and M. M.
    /// Hilferty, except at the upper end for n = 1. If no orbit has left, the lower end is a bound with 95 %
    /// confidence and the upper end is infinite.
    #[must_use]
    pub fn interval(&self) -> (f64, f64) {
        if self.left == 0 {
            return (self.impacts / NONE_LEFT, f64::INFINITY);
        }
        let left = self.left as f64;
        let quantile = |half: f64, z: f64| {
            let ninth = 1.0 / (9.0 * half);
            let root = 1.0 - ninth + z * ninth.sqrt();
            half * root * root * root
        };
        let fewest = if self.left == 1 { ONE_LEFT } else { quantile(left, -NORMAL_975) };
        let most = quantile(left + 1.0, NORMAL_975);
        (self.impacts / most, self.impacts / fewest)
    }
}

/// `mean life 25000 impacts (18400 to 35000)`, or a bound: `mean life above 1000000 impacts`; three digits.
impl core::fmt::Display for Lifetime {
    fn fmt(&self, formatter: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let (low, high) = self.interval();
        match self.mean() {
            Some(mean) => {
                let [mean, low, high] = [mean, low, high].map(three_digits);
                write!(formatter, "mean life {mean} impacts ({low} to {high})")
            }
            None => write!(formatter, "mean life above {} impacts", three_digits(low)),
        }
    }
}

/// A number of impacts with three significant digits.
fn three_digits(impacts: f64) -> f64 {
    let mut unit = 1.0;
    while impacts / unit >= 1_000.0 && unit < 1.0e300 {
        unit *= 10.0;
    }
    (impacts / unit).round() * unit
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::elementary::ln;
    use crate::numerics::random::SplitMix64;
    use crate::numerics::testing::stored;

    /// Quantiles of chi squared from tables: 0.05064 and 11.143 for 2 and 4 degrees of freedom, 0.4844 and
    /// 14.449 for 4 and 6 (approximated from below), 9.591 and 36.781 for 20 and 22, 162.73 and 243.26 for
    /// 200 and 202.
    #[test]
    fn intervals_follow_from_chi_squared() {
        assert!((ln(20.0) - NONE_LEFT).abs() < 1e-15);
        let none = stored(&Lifetime::new(3.0e6, 0).expect("legal"));
        assert_eq!((none.mean(), none.interval()), (None, (3.0e6 / NONE_LEFT, f64::INFINITY)));
        for (left, fewest, most) in
            [(1_u64, 0.050_64, 11.143), (2, 0.484_4, 14.449), (10, 9.591, 36.781), (100, 162.73, 243.26)]
        {
            let (low, high) = Lifetime::new(1.0e6, left).expect("legal").interval();
            assert!((low * most / 2.0e6 - 1.0).abs() < 2e-3, "{left}: {low}");
            let wider = high * fewest / 2.0e6;
            assert!(wider > 0.999 && wider < if left == 2 { 1.1 } else { 1.002 }, "{left}: {high}");
        }
        for wrong in [-1.0, f64::NAN, f64::INFINITY] {
            assert!(Lifetime::new(wrong, 1).is_err(), "{wrong}");
        }
    }

    /// For exponential lifetimes, cut off at a time below or above their mean, at least 93 of 100 intervals
    /// contain the mean.
    #[test]
    fn intervals_cover_the_mean_of_exponential_lives() {
        let mut random = SplitMix64::new(7);
        for cut in [0.02, 0.3, 5.0] {
            let mut holds = 0;
            for _ in 0..1_000 {
                let (mut impacts, mut left) = (0.0, 0);
                for _ in 0..100 {
                    let life = -ln(1.0 - random.unit());
                    impacts += life.min(cut);
                    left += u64::from(life < cut);
                }
                let (low, high) = Lifetime::new(impacts, left).expect("legal").interval();
                holds += u64::from(low <= 1.0 && 1.0 <= high);
            }
            assert!(holds >= 930, "cut at {cut}: {holds}");
        }
    }
}
