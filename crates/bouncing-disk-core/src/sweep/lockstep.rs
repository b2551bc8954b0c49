//! Many flights at once, bit for bit those of one at a time: an implementation detail of what is done with many orbits.

pub(crate) mod flights;
pub(crate) mod lanes;
