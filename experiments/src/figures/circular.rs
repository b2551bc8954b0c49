//! Where angles are on a circle: the core's own statistics.

pub(crate) use bouncing_disk::core::numerics::circular::{Concentration, distance, occupied_arc};
