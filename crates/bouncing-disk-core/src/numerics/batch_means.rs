//! The mean of a long correlated sequence, and its standard error.
//!
//! The batches are sums of neighbouring numbers, and their length doubles as the sequence grows. Errors are
//! computed from 64 to 128 batches, and from 32 to 64 and 16 to 32 joined ones. The drift is the distance of
//! the mean from the mean of the second half, and covers the whole bias of a transient that ends within the
//! first half. For growth like n^k, whose logarithms sum to k ln n, the drift is (k/n)(ln n - 2 ln 2) and the
//! mean (k/n) ln n. In a sequence without a drift it is the error from two batches.

use crate::numerics::statistics::standard_deviation;

/// Largest number of batches; when it is reached, neighbours are joined.
const MOST_BATCHES: usize = 128;

/// Smallest number of batches for a standard error, whose own uncertainty with 16 batches is 18 %.
const FEWEST_BATCHES: usize = 16;

/// Smallest number of values for a standard error.
pub const FEWEST_NUMBERS: u64 = FEWEST_BATCHES as u64;

/// The mean of a stream of numbers, with a standard error that covers scatter, drift and rounding. The
/// scatter of correlated numbers follows from batch means, if the correlation dies out within a sixteenth of
/// the sequence; a drift is a difference between the two halves.
///
/// It keeps between 64 and 128 sums of batches, however long the stream is.
///
/// ```
/// use bouncing_disk_core::numerics::batch_means::BatchMeans;
///
/// // Each number repeats the last one's sign: these are 40 independent numbers and not 4,000.
/// let mut means = BatchMeans::default();
/// for k in 0..4_000 {
///     means.push(if k / 100 % 2 == 0 { 1.0 } else { -1.0 });
/// }
/// assert!(means.mean().is_some_and(|mean| mean.abs() < 1e-15));
/// assert!(means.standard_error().is_some_and(|error| error > 0.05));
/// ```
#[derive(Debug, Clone)]
pub struct BatchMeans {
    sums: Vec<f64>,
    /// Numbers in each of these batches.
    length: u64,
    /// Sum and count of the incomplete batch.
    open: (f64, u64),
    resolution: f64,
    /// The largest modulus of a number.
    largest: f64,
}

impl Default for BatchMeans {
    fn default() -> Self {
        Self::with_resolution(0.0)
    }
}

/// The mean of the numbers in batches with these sums.
fn mean_of(sums: &[f64], length: u64) -> f64 {
    sums.iter().sum::<f64>() / (sums.len() as f64 * length as f64)
}

/// The sums of pairs of neighbours; the last of an odd number of them is omitted.
fn joined(sums: &[f64]) -> Vec<f64> {
    sums.as_chunks::<2>().0.iter().map(|[first, second]| first + second).collect()
}

impl BatchMeans {
    /// An empty mean of numbers whose errors may be up to `resolution` >= 0, all to the same side.
    #[must_use]
    pub const fn with_resolution(resolution: f64) -> Self {
        Self { sums: Vec::new(), length: 1, open: (0.0, 0), resolution, largest: 0.0 }
    }

    /// Adds the next number.
    #[inline]
    pub fn push(&mut self, value: f64) {
        self.largest = self.largest.max(value.abs());
        self.open.0 += value;
        self.open.1 += 1;
        if self.open.1 == self.length {
            self.close();
        }
    }

    fn close(&mut self) {
        self.sums.push(self.open.0);
        self.open = (0.0, 0);
        if self.sums.len() == MOST_BATCHES {
            self.sums = joined(&self.sums);
            self.length *= 2;
        }
    }

    /// The number of values.
    #[must_use]
    pub const fn count(&self) -> u64 {
        self.sums.len() as u64 * self.length + self.open.1
    }

    /// Their mean; `None` without numbers.
    #[must_use]
    pub fn mean(&self) -> Option<f64> {
        let sum = self.sums.iter().sum::<f64>() + self.open.0;
        (self.count() > 0).then(|| sum / self.count() as f64)
    }

    /// The standard error of the mean; `None` for fewer than [`FEWEST_NUMBERS`].
    ///
    /// It is the largest of the following (docs/numerics-dynamics.md, "The standard error"):
    /// - the errors from batches of this length, twice and four times this length and so on, down to 16
    ///   batches: batches shorter than the correlation underestimate the error;
    /// - half of the difference between the means of the two halves: the bias from a transient that ends in
    ///   the first half, and from any drift;
    /// - the resolution of a number, and the rounding of the sums.
    ///
    /// So for uncorrelated numbers the standard error is too large by about a fifth.
    #[must_use]
    pub fn standard_error(&self) -> Option<f64> {
        if self.sums.len() < FEWEST_BATCHES {
            return None;
        }
        let (former, latter) = self.sums.split_at(self.sums.len() / 2);
        let drift = 0.5 * (mean_of(former, self.length) - mean_of(latter, self.length)).abs();
        let additions = self.length as f64 + MOST_BATCHES as f64;
        let rounding = self.resolution + 0.5 * f64::EPSILON * additions * self.largest;
        let (mut sums, mut length, mut largest) =
            (self.sums.clone(), self.length as f64, drift.max(rounding));
        while sums.len() >= FEWEST_BATCHES {
            let means: Vec<f64> = sums.iter().map(|sum| sum / length).collect();
            largest = largest.max(standard_deviation(&means) / (means.len() as f64).sqrt());
            sums = joined(&sums);
            length *= 2.0;
        }
        Some(largest)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::random::SplitMix64;

    /// A sequence around zero in which each number keeps a share of the last one.
    fn correlated(share: f64, count: usize, random: &mut SplitMix64) -> BatchMeans {
        let (mut means, mut value) = (BatchMeans::default(), 0.0);
        for _ in 0..count {
            value = share * value + (random.unit() - 0.5);
            means.push(value);
        }
        means
    }

    /// The variance of such a mean is known: the variance 1/12 of the kicks over n (1 - share)^2.
    #[test]
    fn the_error_of_correlated_numbers_is_that_of_their_mean() {
        let mut random = SplitMix64::new(7);
        for share in [-0.5, 0.0, 0.5, 0.9, 0.99] {
            let count = 20_000;
            let exact = (1.0 / 12.0 / count as f64).sqrt() / (1.0 - share);
            let (mut sum, mut within, tries) = (0.0, 0, 100);
            for _ in 0..tries {
                let means = correlated(share, count, &mut random);
                let error = means.standard_error().expect("many numbers");
                sum += error;
                within += u32::from(means.mean().expect("some").abs() <= 2.0 * error);
            }
            let ratio = sum / f64::from(tries) / exact;
            assert!((0.95..1.5).contains(&ratio), "share {share}: {ratio}");
            assert!(within >= 92, "share {share}: {within} of {tries} within two errors");
        }
    }

    #[test]
    fn few_numbers_have_a_mean_and_no_error() {
        let mut means = BatchMeans::default();
        assert_eq!((means.mean(), means.standard_error(), means.count()), (None, None, 0));
        for k in 0..15 {
            means.push(f64::from(k));
        }
        assert_eq!((means.mean(), means.standard_error(), means.count()), (Some(7.0), None, 15));
        means.push(7.0);
        // The halves of 15 numbers from 0 to 14 and their middle: 3.5 and 10.5.
        assert_eq!(means.standard_error(), Some(3.5));
    }

    /// No number is lost in a sequence of any length, and the error of equal numbers is their rounding.
    #[test]
    fn the_batches_grow_with_the_sequence() {
        let mut means = BatchMeans::default();
        for k in 1..=100_003_u64 {
            means.push(0.5);
            assert_eq!(means.count(), k);
            assert!(means.sums.len() < MOST_BATCHES);
        }
        let error = means.standard_error().expect("many numbers");
        assert!(means.mean() == Some(0.5) && (1e-16..2e-13).contains(&error), "{error:e}");
    }

    /// The mean of a sequence that decays, grows in steps of 1/k, or is constant with rounding: the limit
    /// lies within three errors.
    #[test]
    fn the_error_holds_a_transient_a_drift_and_rounding() {
        type Sequence = fn(f64) -> f64;
        for count in [100_u32, 5_000, 100_000] {
            let sequences: [(Sequence, f64); 4] = [
                (|k| crate::numerics::elementary::exp(-0.02 * k), 0.0),
                (|k| 2.0 / (k + 1.0), 0.0),
                (|k| -1.5 / (k + 1.0), 0.0),
                (|_| 0.1, 0.1),
            ];
            for (of, limit) in sequences {
                let mut means = BatchMeans::default();
                (0..count).for_each(|k| means.push(of(f64::from(k))));
                let (mean, error) = (means.mean().expect("many"), means.standard_error().expect("many"));
                assert!((mean - limit).abs() <= 3.0 * error, "{count}: {mean:e} +- {error:e} of {limit}");
            }
        }
        let mut means = BatchMeans::with_resolution(1e-9);
        (0..64).for_each(|_| means.push(1e-10));
        assert!(means.standard_error().is_some_and(|error| (1e-9..1.1e-9).contains(&error)));
    }

    #[test]
    fn what_is_no_number_is_not_hidden() {
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let mut means = BatchMeans::default();
            for k in 0..300 {
                means.push(if k == 17 { bad } else { 1.0 });
            }
            assert!(means.mean().is_some_and(|mean| !mean.is_finite()));
        }
    }
}
