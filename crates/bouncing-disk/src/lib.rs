//! A disk bouncing on a platform that vibrates and twists: pizza dough on a hand, the rotor of an
//! ultrasonic motor on its stator (Liu, Friend and Yeo, Phys. Rev. E 80, 046201 (2009)).
//!
//! A [`System`] is a [`Disk`] on a [`Platform`], in SI units. [`Engine`] computes its motion event by event.
//! A [`Motor`] is a system described by its data sheet.
//!
//! ```
//! use bouncing_disk::System;
//! use bouncing_disk::toss::{InitialSpin, single_toss};
//!
//! # fn main() -> Result<(), bouncing_disk::Error> {
//! // The single pizza toss of Table I.
//! let toss = single_toss(&System::pizza_toss(), InitialSpin::AbsoluteRest)?;
//! assert_eq!(toss.airborne_speed.round(), 14.0);
//! # Ok(())
//! # }
//! ```
//!
//! The names at the root describe one disk on one platform. Everything else is in modules, each of which
//! begins with an example and an equation:
//!
//! | module | contents |
//! | --- | --- |
//! | [`parameters`] | stroke, units, and the dimensionless numbers that determine the motion |
//! | [`motion`] | states, segments and energies between events |
//! | [`toss`] | single tosses, many tosses |
//! | [`driven`] | platforms with any periodic motion: waveforms and their tosses |
//! | [`stator`] | compliant stators, whose modes react to impacts and friction |
//! | [`motor`] | motors: run-up, speed under a load, sweeps, sensitivities |
//! | [`estimate`] | fits of computed and measured speeds, with intervals |
//! | `store` | the origin of files, and the journal of a long computation (feature `storage`) |
//! | [`mod@core`] | the vertical motion: flights, the impact map and its orbits, attractors, chaos |
//!
//! | feature | default | effect |
//! | --- | --- | --- |
//! | `parallel` | yes | ensembles, grids and sweeps use the threads of rayon's pool, with identical results |
//! | `serde` | yes | `Serialize` for results; `Deserialize` for users' input |
//! | `json` | yes | a motor's data sheet as JSON |
//! | `toml` | no | a motor's data sheet as TOML |
//! | `storage` | yes | provenance of stored files, and the journal of a long computation |
//! | `fit` | no | estimates of unknown motor parameters from transients or catalogue points |
//! | `csv` | no | reading measured speeds from CSV files, writing sweeps to them |
//!
//! Deserialising runs the same checks as construction: a value outside its range, a missing required key and
//! an unknown key are errors. JSON has no infinity or NaN, so an infinite error bound or an undefined
//! efficiency is `null`. The feature `json` enables `float_roundtrip` of `serde_json`, without which a third
//! of all numbers change in the last bit when read from JSON.
//!
//! Everything is deterministic to the last bit: the same parameters and start produce the same events on every
//! machine.

// Public because the experiments of the workspace read such files, too. Not part of the documented interface;
// may change.
#[cfg(feature = "csv")]
#[doc(hidden)]
pub mod csv_records;
mod display;
pub mod driven;
mod error;
pub mod estimate;
pub mod motion;
pub mod motor;
pub mod parameters;
// Public for the experiments, like `csv_records`; may change.
#[cfg(feature = "csv")]
#[doc(hidden)]
pub mod regular_file;
// Public for the command line, which reads files of systems as it reads data sheets.
#[doc(hidden)]
pub mod sheet_text;
mod statistics;
pub mod stator;
#[cfg(feature = "storage")]
pub mod store;
#[cfg(test)]
mod testing;
pub mod toss;

/// The math core: the vertical motion, its impact map and their analysis.
pub use bouncing_disk_core as core;
/// Platforms with any periodic motion and compliant contacts, for the same analyses.
pub use bouncing_disk_drives as drives;

pub use bouncing_disk_core::{Observer, Progress, Unobserved};
pub use error::Error;
pub use motion::engine::Engine;
pub use motion::event::{Event, EventRecord};
pub use motion::initial_condition::InitialCondition;
pub use motion::trajectory::Trajectory;
pub use motor::data_sheet::Motor;
pub use parameters::disk::{Disk, DiskParameters};
pub use parameters::platform::{Platform, PlatformParameters};
pub use parameters::system::System;

/// Compiles and runs the example of the README.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadmeExamples;

/// Compiles and runs the programs of the tutorial.
#[cfg(doctest)]
#[doc = include_str!("../../../docs/tutorial.md")]
struct TutorialExamples;

/// Compiles and runs the programs of the page on motors.
#[cfg(all(doctest, feature = "storage", feature = "fit"))]
#[doc = include_str!("../../../docs/designing-a-motor.md")]
struct MotorExamples;
