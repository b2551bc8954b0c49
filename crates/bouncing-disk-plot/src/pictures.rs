//! Complete pictures of results, each computed from plain numbers: slices, axis ends, words.

mod diagram;
mod impact_plane;
mod maps;
mod marks;
mod torque_speed;
mod toss;
mod transient;

pub use diagram::{OrbitDiagram, OrbitsFrom, doublings};
pub use impact_plane::{IMPACT_PHASE, IMPACT_SPEED, crosses, forcing_and_restitution, periodic_orbits};
pub use maps::{Basins, REGIMES, Regimes, heat_map, key};
pub use marks::CellMarks;
pub use torque_speed::{LoadPoint, Quantity, interval_curve, swept_curve, torque_speed};
pub use toss::{LONGEST_MOTION, TossInstant, toss};
pub use transient::{FittedCurve, RunUp};
