//! One flight: from the launch to the first impact on the platform.
//!
//! The gap between disk and platform after a flight of h radians is (w + P cos tau) h - h^2/2 - P (sin(tau +
//! h) - sin tau). Its first zero h > 0 is the impact (Eq. 11 of Liu, Friend and Yeo).
//! [`Vibration::first_impact`](crate::Vibration::first_impact) finds it with certainty
//! (docs/numerics-impacts.md); [`mod@reference`] finds it slowly by an independent method, as a check.
//!
//! ```
//! use bouncing_disk_core::{Launch, Phase, Vibration};
//!
//! let vibration = Vibration::from_axial_forcing(0.45)?;
//! let impact = vibration.first_impact(Launch::new(Phase::new(1.0)?, 3.0)?)?;
//! assert!(impact.velocity < 0.0);
//! # Ok::<(), bouncing_disk_core::Error>(())
//! ```
//!
//! One flight is one step of the [impact map](crate::map).

pub(crate) mod bounds;
pub(crate) mod drop;
pub(crate) mod first_impact;
pub(crate) mod gap;
mod graze_margin;
pub(crate) mod launch;
pub(crate) mod platform;
pub mod reference;

// The model checks the drops that it reads with this function.
#[doc(hidden)]
pub use drop::check_drop;
pub use first_impact::MAX_FLIGHT_DURATION;
