//! k of n: a share with the confidence interval of the true share.

use crate::numerics::error::{Error, within};
use crate::numerics::statistics::NORMAL_975;
use crate::numerics::stored::read_checked;

/// The number of members of a sample with a property, by default 0 of 0.
///
/// ```
/// use bouncing_disk_core::numerics::fraction::Fraction;
///
/// // None of a hundred: the share may still be some per cent.
/// let none = Fraction::new(0, 100)?;
/// let (low, high) = none.interval();
/// assert!(low <= 0.0 && high > 0.03 && high < 0.04);
/// # Ok::<(), bouncing_disk_core::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedFraction"))]
pub struct Fraction {
    count: u64,
    of: u64,
}

read_checked!(Fraction as UncheckedFraction { count: u64, of: u64 } => Fraction::new);

impl Fraction {
    /// `count` members with the property in a sample of size `of`, which may be 0.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for more members than the sample has.
    pub fn new(count: u64, of: u64) -> Result<Self, Error> {
        within("members with a property", count as f64, 0.0, of as f64, "at most the size of the sample")?;
        Ok(Self { count, of: of.max(count) })
    }

    /// The number of members with the property.
    #[must_use]
    pub const fn count(&self) -> u64 {
        self.count
    }

    /// The size of the sample.
    #[must_use]
    pub const fn of(&self) -> u64 {
        self.of
    }

    /// The share, in [0, 1]; 0 for an empty sample.
    #[must_use]
    pub fn value(&self) -> f64 {
        if self.of == 0 { 0.0 } else { self.count as f64 / self.of as f64 }
    }

    /// The 95 % interval by [`Self::wilson`].
    #[must_use]
    pub fn interval(&self) -> (f64, f64) {
        self.wilson(NORMAL_975)
    }

    /// The interval of the true shares for which this sample is at most `z` standard errors away (E. B.
    /// Wilson, J. Am. Stat. Assoc. 22, 209 (1927)), within [0, 1]: with f = k/n,
    ///
    /// (f + z^2/2n +- z sqrt(f (1 - f)/n + z^2/4n^2))/(1 + z^2/n).
    ///
    /// For an empty sample, or if `z` is NaN, the interval is [0, 1]. The sign of `z` does not matter. Points
    /// of an even grid or sequence are spread more evenly than a random sample, so the interval is too wide
    /// rather than too narrow.
    #[must_use]
    pub fn wilson(&self, z: f64) -> (f64, f64) {
        let (n, f) = (self.of as f64, self.value());
        let relative = z * z / n;
        if !relative.is_finite() {
            return (0.0, 1.0);
        }
        let middle = f + 0.5 * relative;
        let half = z.abs() * ((f * (1.0 - f) + 0.25 * relative) / n).sqrt();
        let part = 1.0 / (1.0 + relative);
        // The share itself belongs to it, even if rounding would exclude it.
        (((middle - half) * part).clamp(0.0, f), ((middle + half) * part).clamp(f, 1.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::random::SplitMix64;
    use crate::numerics::testing::stored;

    fn fraction(count: u64, of: u64) -> Fraction {
        Fraction::new(count, of).expect("legal")
    }

    /// Both ends solve (f - p)^2 = z^2 p (1 - p)/n.
    #[test]
    fn the_ends_are_so_many_standard_errors_away() {
        for (count, of) in [(0, 1), (1, 1), (0, 100), (3, 100), (50, 100), (100, 100), (7, 1 << 40)] {
            let own = stored(&fraction(count, of));
            for z in [0.0, 1.0, NORMAL_975, -3.0] {
                let (low, high) = own.wilson(z);
                assert!(0.0 <= low && low <= own.value() && own.value() <= high && high <= 1.0);
                for end in [low, high] {
                    let away = own.value() - end;
                    let allowed = z * z * end * (1.0 - end) / own.of() as f64;
                    assert!((away * away - allowed).abs() < 1e-14, "{count} of {of}, {z}: {low} to {high}");
                }
            }
        }
    }

    /// For nearly nineteen in twenty random samples the interval contains the true share.
    #[test]
    fn intervals_hold_the_true_share_as_often_as_they_say() {
        let mut random = SplitMix64::new(3);
        for share in [0.02, 0.1, 0.5] {
            let held = (0..2_000).filter(|_| {
                let count = (0..200).filter(|_| random.unit() < share).count() as u64;
                let (low, high) = fraction(count, 200).interval();
                low <= share && share <= high
            });
            let held = held.count();
            assert!((1_840..=1_960).contains(&held), "{share}: {held}");
        }
    }

    #[test]
    fn of_nothing_nothing_is_known() {
        let none = fraction(0, 0);
        assert_eq!((none.value().to_bits(), none.interval()), (0, (0.0, 1.0)));
        assert_eq!(fraction(1, 2).wilson(f64::NAN), (0.0, 1.0));
        assert_eq!(fraction(1, 2).wilson(f64::INFINITY), (0.0, 1.0));
        assert!(Fraction::new(3, 2).is_err());
        assert!(Fraction::new(u64::MAX, u64::MAX - 1).is_ok_and(|own| own.value() <= 1.0));
    }
}
