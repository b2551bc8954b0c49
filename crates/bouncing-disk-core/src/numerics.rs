//! Arithmetic with the same bits on every processor; roots, minima, statistics of samples, random streams and
//! digests.

pub mod batch_means;
pub(crate) mod block_cyclic;
pub(crate) mod bordered_cyclic;
pub mod digest;
pub mod double_double;
pub mod elementary;
pub(crate) mod error;
pub mod fraction;
pub mod lifetime;
pub mod power_law;
pub mod random;
pub mod real;
pub mod roots;
pub mod statistics;
pub mod stored;
#[cfg(test)]
pub(crate) mod testing;
