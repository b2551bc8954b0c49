//! Many flights at once, bit for bit as if computed one at a time: an implementation detail of computations
//! with many orbits.

pub(crate) mod flights;
pub(crate) mod lanes;
