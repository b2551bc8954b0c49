//! Arithmetic that gives the same bits on every processor, roots, minima, statistics of samples and angles, random streams and
//! digests.

pub mod batch_means;
pub(crate) mod block_cyclic;
pub(crate) mod bordered_cyclic;
pub mod circular;
pub mod digest;
#[cfg_attr(
    not(feature = "extended"),
    expect(dead_code, unreachable_pub, reason = "only the feature needs all of it")
)]
pub(crate) mod double_double;
pub mod elementary;
pub mod fraction;
pub mod minimum;
pub mod power_law;
pub mod random;
pub(crate) mod real;
pub mod roots;
pub mod statistics;
