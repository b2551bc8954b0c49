//! Arithmetic that gives the same bits on every processor, roots, minima, statistics of samples and angles, random streams and
//! digests.

pub mod batch_means;
pub(crate) mod block_cyclic;
pub mod circular;
pub mod digest;
pub mod elementary;
pub mod minimum;
pub mod random;
pub mod roots;
pub mod statistics;
