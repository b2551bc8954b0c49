//! The impact map, its derivative, its laws of restitution, and the orbits that it makes.

mod chattering;
pub(crate) mod impact_map;
mod inverse;
mod rest_bound;
pub(crate) mod restitution_law;
