//! Platforms with arbitrary periodic motion, and compliant contacts, for the analyses of
//! [`bouncing_disk_core`].
//!
//! A [`Drive`] is the height of a platform over one period: a Fourier sum, or polynomial pieces. A
//! [`DrivenMap`] is the impact map of a disk on it, with rigid impacts or a [compliant contact](compliance).
//! The analyses of verdicts, exponents, attractors, basins and diagrams accept this map like the map of the
//! sine. A [`DrivenFamily`] can be continued in any of its parameters. Lengths, times and speeds are
//! dimensionless, as in the core.
//!
//! ```
//! use bouncing_disk_core::attractors::{AttractorSearch, Attractors};
//! use bouncing_disk_core::Unobserved;
//! use bouncing_disk_drives::{Drive, DrivenMap};
//! use std::f64::consts::PI;
//!
//! // A platform that follows parabolas, with a forcing of 0.36: the disk lands once in every period.
//! let map = DrivenMap::new(Drive::parabolas(0.36 * PI)?, 0.5)?;
//! let found = Attractors::find(&map, &AttractorSearch::default(), &Unobserved)?;
//! assert!(found.all().iter().any(|one| one.kind.orbit().is_some_and(|orbit| orbit.period() == 1)));
//! # Ok::<(), bouncing_disk_core::Error>(())
//! ```
//!
//! | chapter | about |
//! | --- | --- |
//! | [`quasi_polynomial`] | sums of polynomials and damped sines, and their first roots |
//! | [`drive`] | the motions of a platform, and the first impact on them |
//! | [`compliance`] | compliant contacts |
//!
//! The methods are described in docs/numerics-impacts.md and docs/numerics-dynamics.md.

mod analyses;
mod cascade;
pub mod compliance;
pub mod drive;
mod driven_map;
mod family;
mod periodic;
pub mod quasi_polynomial;

pub use cascade::driven_doubling_cascade;
pub use drive::Drive;
pub use driven_map::{DrivenMap, DrivenOrbit};
pub use family::DrivenFamily;

/// Compiles and runs the example of the README.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadmeExamples;
