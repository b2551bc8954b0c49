//! What is said of a sample of numbers in one number or two: the core's own statistics.

use bouncing_disk::core::numerics::elementary::ln;
pub(crate) use bouncing_disk::core::numerics::statistics::{extent, median};

/// A number rounded to six decimals, where no more are meant.
pub(crate) fn six_decimals(value: f64) -> f64 {
    (value * 1.0e6).round() / 1.0e6
}

/// The exponent of a power law, the median over all pairs of positive points (Theil and Sen, in logarithms), which a few points off the law do not move.
pub(crate) fn median_exponent(points: impl IntoIterator<Item = (f64, f64)>) -> Option<f64> {
    let positive = points.into_iter().filter(|(x, y)| *x > 0.0 && *y > 0.0);
    let points: Vec<(f64, f64)> = positive.map(|(x, y)| (ln(x), ln(y))).collect();
    let pairs = points.iter().enumerate().flat_map(|(index, one)| {
        points[index + 1..]
            .iter()
            .filter(move |other| other.0.total_cmp(&one.0).is_ne())
            .map(move |other| (one, other))
    });
    median(pairs.map(|(one, other)| (other.1 - one.1) / (other.0 - one.0)))
}
