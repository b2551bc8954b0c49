//! The impact map, its derivative, and the orbits that it makes.

mod chattering;
pub(crate) mod impact_map;
