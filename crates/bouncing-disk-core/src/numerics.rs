//! Arithmetic that gives the same bits on every processor, minima, random streams and digests.

pub(crate) mod block_cyclic;
pub mod digest;
pub mod elementary;
pub mod minimum;
pub mod random;
