//! Arithmetic that gives the same bits on every processor, roots, minima, statistics of samples and angles,
//! and random streams.

pub mod circular;
pub mod elementary;
pub mod minimum;
pub mod random;
pub mod roots;
pub mod statistics;
