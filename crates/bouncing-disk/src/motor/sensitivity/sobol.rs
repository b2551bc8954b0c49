//! Sobol' indices of any function: the share of each argument in its variance, over ranges of the
//! arguments.

use bouncing_disk_core::Observer;
use bouncing_disk_core::numerics::random::SplitMix64;
use bouncing_disk_core::run::Watch;

use crate::error::{Error, check, finite};
use crate::motor::operation::point::Estimate;
use crate::motor::sensitivity::resamples::standard_errors;

/// Least and most rows of a sample.
const ROWS: std::ops::RangeInclusive<usize> = 8..=1_000_000;

/// Most arguments.
const MOST_ARGUMENTS: usize = 64;

/// How a function is sampled over ranges.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct SamplingSettings {
    /// Rows of the sample, in [8, 1e6]; for d arguments a row takes d + 2 evaluations for Sobol' indices, and
    /// d + 1 for elementary effects. Default 256.
    pub rows: usize,
    /// Seed of the sample and of the resampling that gives the errors. Default 1.
    pub seed: u64,
}

impl Default for SamplingSettings {
    fn default() -> Self {
        Self { rows: 256, seed: 1 }
    }
}

impl SamplingSettings {
    pub(crate) fn check(&self) -> Result<(), Error> {
        check(ROWS.contains(&self.rows), "rows", self.rows as f64, "[8, 1000000]")?;
        Ok(())
    }
}

/// The Sobol' indices of one argument.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct SobolIndices {
    /// First order: the share of the variance that vanishes if this argument alone is known. An estimate near
    /// zero may be negative.
    pub first: Estimate,
    /// Total: the share of the variance that remains if all others are known; it exceeds the first order by
    /// the argument's interactions with others.
    pub total: Estimate,
}

/// Checks the ranges of arguments.
pub(crate) fn check_ranges(ranges: &[[f64; 2]]) -> Result<(), Error> {
    let count = ranges.len();
    check((1..=MOST_ARGUMENTS).contains(&count), "number of ranges", count as f64, "[1, 64]")?;
    for &[low, high] in ranges {
        finite("range (low)", low)?;
        finite("range (high)", high)?;
        check(low <= high, "range (high)", high, "[range (low), inf)")?;
        finite("range (width)", high - low)?;
    }
    Ok(())
}

/// The values of a batch of points, as many as points, finite.
pub(crate) fn evaluated(
    points: &[Vec<f64>],
    evaluate: &mut impl FnMut(&[Vec<f64>]) -> Result<Vec<f64>, Error>,
) -> Result<Vec<f64>, Error> {
    let values = evaluate(points)?;
    check(values.len() == points.len(), "number of values", values.len() as f64, "as many as points")?;
    for &value in &values {
        finite("value", value)?;
    }
    Ok(values)
}

/// The Sobol' indices of a function of independent arguments, each spread evenly over its range, in their
/// order.
///
/// `function` gets a batch of points, each with its arguments in the order of the ranges, and returns
/// their values. A batch is a row of the sample: two random points A and B, and A with each argument in turn
/// from B. The estimators are Jansen's; rows are drawn independently, so that resampling them gives the
/// standard errors.
///
/// The items of `observer` are the rows.
///
/// ```
/// # use bouncing_disk::core::Unobserved;
/// use bouncing_disk::motor::{SamplingSettings, sobol_indices};
///
/// // x + 2 y over the unit square: the variances are as 1 to 4.
/// let function = |points: &[Vec<f64>]| Ok(points.iter().map(|at| at[0] + 2.0 * at[1]).collect());
/// let indices = sobol_indices(function, &[[0.0, 1.0]; 2], SamplingSettings { rows: 2000, seed: 1 }, &Unobserved)?;
/// assert!((indices[0].first.value - 0.2).abs() < 4.0 * indices[0].first.standard_error);
/// assert!((indices[1].total.value - 0.8).abs() < 4.0 * indices[1].total.standard_error);
/// # Ok::<(), bouncing_disk::Error>(())
/// ```
///
/// # Errors
/// [`Error::OutOfRange`] for illegal ranges or settings, for a value that is not finite, and for a function
/// that does not return one value for each point; its own errors.
pub fn sobol_indices(
    mut function: impl FnMut(&[Vec<f64>]) -> Result<Vec<f64>, Error>,
    ranges: &[[f64; 2]],
    settings: SamplingSettings,
    observer: &dyn Observer,
) -> Result<Vec<SobolIndices>, Error> {
    settings.check()?;
    check_ranges(ranges)?;
    let watch = Watch::begin(observer, 0, settings.rows as u64)?;
    let mut random = SplitMix64::new(settings.seed);
    let mut values = Vec::with_capacity(settings.rows);
    for _ in 0..settings.rows {
        let mut random_point =
            || ranges.iter().map(|[low, high]| low + (high - low) * random.unit()).collect::<Vec<f64>>();
        let (first, second) = (random_point(), random_point());
        let mut points = vec![first.clone(), second.clone()];
        for (index, value) in second.iter().enumerate() {
            let mut mixed = first.clone();
            mixed[index] = *value;
            points.push(mixed);
        }
        values.push(evaluated(&points, &mut function)?);
        watch.finish(1);
        watch.ask()?;
    }
    let all: Vec<usize> = (0..settings.rows).collect();
    let indices = (0..ranges.len()).map(|argument| {
        let of = |rows: &[usize]| indices_of(&values, rows, argument);
        let [first, total] = of(&all);
        let [first_error, total_error] = standard_errors(settings.rows, settings.seed ^ 1, of);
        SobolIndices {
            first: Estimate { value: first, standard_error: first_error },
            total: Estimate { value: total, standard_error: total_error },
        }
    });
    let indices = indices.collect();
    watch.end();
    Ok(indices)
}

/// First and total index of an argument from some rows; zeros for a function that is constant.
fn indices_of(values: &[Vec<f64>], rows: &[usize], argument: usize) -> [f64; 2] {
    let count = rows.len() as f64;
    let mean = rows.iter().map(|&row| 0.5 * (values[row][0] + values[row][1])).sum::<f64>() / count;
    let (mut variance, mut first, mut total) = (0.0, 0.0, 0.0);
    for &row in rows {
        let (a, b, mixed) = (values[row][0], values[row][1], values[row][2 + argument]);
        variance += 0.5 * ((a - mean) * (a - mean) + (b - mean) * (b - mean));
        first += 0.5 * (b - mixed) * (b - mixed);
        total += 0.5 * (a - mixed) * (a - mixed);
    }
    if variance > 0.0 { [1.0 - first / variance, total / variance] } else { [0.0; 2] }
}

#[cfg(test)]
mod tests;
