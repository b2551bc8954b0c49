//! Chattering: an infinite sequence of ever smaller impacts that brings the disk to rest on the platform.
//!
//! Flights and speeds shrink by the restitution r from one impact to the next. So after a launch with the
//! relative speed w the disk rests after about 2 w / (a (1 - r)), where a = 1 - P sin tau is the relative
//! gravity. [`ChatterPolicy`](crate::ChatterPolicy) selects how an orbit treats this chatter: it is summed to
//! the end with a proven error bound, or cut off as in Sec. IV A of the paper (docs/numerics-impacts.md).
//!
//! ```
//! use bouncing_disk_core::{ImpactMap, Launch, Phase, Vibration};
//!
//! let map = ImpactMap::new(Vibration::from_axial_forcing(0.45)?, 0.5)?;
//! let rest = map.accumulation(Launch::new(Phase::new(4.0)?, 1e-5)?).expect("chatters to rest");
//! assert!(rest.error_bound < 1e-12);
//! # Ok::<(), bouncing_disk_core::Error>(())
//! ```
//!
//! After the rest the disk separates when the platform falls away from it, and the orbit continues with
//! [`OrbitEvent::Attachment`](crate::OrbitEvent).

pub(crate) mod accumulation;
pub(crate) mod expansion;
pub(crate) mod impact_series;
pub(crate) mod policy;
pub(crate) mod rest_proof;

pub use accumulation::{Accumulation, ChatterImpact};
pub use impact_series::{ChatterSeries, ImpactRange, PowerSeries};
pub use policy::{AfterImpact, ChatterDuration, ShortFlightCount};
