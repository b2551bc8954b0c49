//! Tosses: a single one, the best one, and many in a row.

pub(crate) mod chattering_cycle;
pub(crate) mod collisions;
pub(crate) mod design;
pub(crate) mod multiple;
pub(crate) mod rotary_response;
pub(crate) mod single;
