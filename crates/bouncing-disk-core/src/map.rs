//! The impact map: from one impact to the next, its derivative, its inverse and the law of restitution.
//!
//! A disk that arrives with the velocity w' leaves with the speed -r w', and the next impact is the first
//! zero of the gap of its flight. The map contracts areas of (phase, velocity) by r^2.
//! [`ImpactMap`](crate::ImpactMap) steps, [`Orbit`](crate::Orbit) follows all events, chattering included.
//! Laws of restitution other than a constant are [`RestitutionLaw`]s (docs/numerics-dynamics.md).
//!
//! ```
//! use bouncing_disk_core::{ImpactMap, Vibration};
//!
//! let map = ImpactMap::new(Vibration::from_axial_forcing(0.45)?, 0.5)?;
//! let state = map.period_one(1).expect("it exists from Gamma = 1/3 on");
//! assert!((map.step(state)?.duration() - std::f64::consts::TAU).abs() < 1e-12);
//! # Ok::<(), bouncing_disk_core::Error>(())
//! ```
//!
//! Periodic orbits are in [`orbits`](crate::orbits), batches of orbits in [`sweep`](mod@crate::sweep).

mod chattering;
pub(crate) mod impact_map;
mod inverse;
pub(crate) mod restitution_law;
mod trapping_region;

pub use impact_map::ContactChange;
pub use restitution_law::kuwabara_kono::KuwabaraKono;
pub use restitution_law::{Constant, RestitutionLaw};
