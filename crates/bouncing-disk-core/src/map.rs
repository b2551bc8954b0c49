//! The impact map, its derivative, and the orbits that it makes.

pub(crate) mod impact_map;
