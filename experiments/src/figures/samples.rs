//! What is said of a sample of numbers in one number or two: the core's own statistics.

pub(crate) use bouncing_disk::core::numerics::statistics::{extent, median};

/// A number rounded to six decimals, where no more are meant.
pub(crate) fn six_decimals(value: f64) -> f64 {
    (value * 1.0e6).round() / 1.0e6
}
