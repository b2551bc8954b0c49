//! What is said of a sample of numbers in one number or two: the core's own statistics.

pub(crate) use bouncing_disk::core::numerics::statistics::{extent, median};
