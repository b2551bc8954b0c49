//! The vertical motion of a disk that bounces on a sinusoidally vibrating platform, in dimensionless form.
//!
//! Time is counted in radians of the platform's phase (1/omega), length in g/omega^2; the platform's only
//! parameter is its peak acceleration P = pi Gamma in units of g.
//!
//! ```
//! use std::f64::consts::TAU;
//! use bouncing_disk_core::sweep::orbit_diagram;
//! use bouncing_disk_core::{ChatterPolicy, ImpactMap, Unobserved, Vibration};
//!
//! # fn main() -> Result<(), bouncing_disk_core::Error> {
//! // Gamma = 0.45 and restitution 0.5: a disk on the period-1 orbit lands once in every period.
//! let map = ImpactMap::new(Vibration::from_axial_forcing(0.45)?, 0.5)?;
//! let state = map.period_one(1).expect("it exists from Gamma = 1/3 on");
//! assert!((map.step(state)?.duration() - TAU).abs() < 1e-12);
//! // One column of the orbit diagram: 50 impacts, after 200 that are discarded.
//! let column = orbit_diagram(&[map.orbit(state, ChatterPolicy::Complete)], 200, 50, &Unobserved)?;
//! assert_eq!(column[0].len(), 50);
//! # Ok(())
//! # }
//! ```
//!
//! The names at the root describe one disk on one platform. All other items are in chapters; the first page
//! of each contains an example and an equation:
//!
//! | chapter | about |
//! | --- | --- |
//! | [`flight`] | one flight and its first impact |
//! | [`chatter`] | infinitely many impacts that end at rest |
//! | [`map`] | from impact to impact; laws of restitution |
//! | [`orbits`] | periodic orbits, their branches, the doubling cascade |
//! | [`attractors`] | the disk's final motion: attractors, basins, verdicts |
//! | [`chaos`] | Lyapunov exponents, manifolds, crises |
//! | [`mod@sweep`] | many orbits at once |
//! | [`run`] | progress of long calls, and how to stop them |
//! | [`numerics`] | functions with the same bits on every processor, roots, statistics |
//!
//! | feature | default | what it does |
//! | --- | --- | --- |
//! | `parallel` | yes | grids and sweeps run on the threads of rayon's pool, with the same bits |
//! | `serde` | yes | `Serialize` for results, `Deserialize` for settings and inputs of computations |
//!
//! Deserialising runs the same checks as construction: a value outside its range, a missing key of a required
//! value and an unknown key are errors. An infinite error bound is `null` in JSON, which cannot represent
//! infinity. With `serde_json`, enable its feature `float_roundtrip`: without it a third of all numbers change
//! in their last bit when they are read.

pub mod attractors;
pub mod chaos;
pub mod chatter;
pub mod flight;
pub mod map;
pub mod numerics;
pub mod orbits;
#[doc(hidden)]
pub mod parts;
pub mod run;
pub mod sweep;

pub use chatter::policy::{ChatterCut, ChatterPolicy};

pub use flight::launch::{Impact, Launch};
pub use flight::platform::phase::Phase;
pub use flight::platform::vibration::Vibration;
pub use map::impact_map::{Attachment, ImpactMap, ImpactState, Orbit, OrbitEvent};
pub use numerics::error::Error;
pub use sweep::bouncing_map::BouncingMap;
// The model deserialises in the same way as the core.
#[doc(hidden)]
pub use numerics::stored;
pub use run::{Observer, Progress, Unobserved};

/// Compiles and runs the example of the README.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadmeExamples;
