//! Many orbits at once: orbit diagrams, survival times, or any results that a visitor collects from their
//! events.
//!
//! The events have the same bits as if each orbit were followed on its own, for any number of threads. Several
//! flights are computed at a time in lockstep, in the lanes of vector instructions (docs/numerics-impacts.md).
//!
//! ```
//! use bouncing_disk_core::sweep::orbit_diagram;
//! use bouncing_disk_core::{ChatterPolicy, ImpactMap, Unobserved, Vibration};
//!
//! // One column of the orbit diagram: 50 impacts, after 200 that are discarded.
//! let map = ImpactMap::new(Vibration::from_axial_forcing(0.45)?, 0.5)?;
//! let start = map.period_one(1).expect("it exists from Gamma = 1/3 on");
//! let column = orbit_diagram(&[map.orbit(start, ChatterPolicy::Complete)], 200, 50, &Unobserved)?;
//! assert_eq!(column[0].len(), 50);
//! # Ok::<(), bouncing_disk_core::Error>(())
//! ```
//!
//! The final motions of orbits are in [`attractors`](crate::attractors).

pub(crate) mod bouncing_map;
mod events;
pub(crate) mod lockstep;
pub(crate) mod lyapunov;
pub(crate) mod orbit_batch;
mod orbit_diagram;
mod outcomes;
pub(crate) mod runner;
#[cfg(test)]
mod tests;

pub use bouncing_map::{BouncingOrbit, OrbitOutcome};
pub use events::{SweepEvent, SweepImpact};
// Hidden because the number of flights computed at once may change: only the model, benches and tests use
// these.
#[doc(hidden)]
pub use lockstep::flights::{Flights, LaneImpacts, LaneLoop, LaneRunner};
#[doc(hidden)]
pub use lockstep::lanes::InstructionSet;
pub use orbit_batch::OrbitBatch;
pub use orbit_diagram::{MAX_RECORDED, orbit_diagram, survival_times};
pub(crate) use outcomes::sweep_with;
pub use outcomes::{PartialResults, sweep};
