//! Arithmetic that gives the same bits on every processor, minima, and random streams.

pub(crate) mod block_cyclic;
pub mod elementary;
pub mod minimum;
pub mod random;
