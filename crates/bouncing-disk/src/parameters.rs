//! The parameters of a disk and its platform in SI units, and the six dimensionless numbers that determine
//! the motion.
//!
//! The platform moves by s = A sin(omega t) and turns by beta = Phi sin(omega t + theta) (Eq. 1 of Liu, Friend
//! and Yeo); a [`Stroke`] determines A and Phi from the path of a hand (Eqs. 13 and 14). In the units 1/omega
//! and g/omega^2 only the [`DimensionlessParameters`] remain. The first of them is pi Gamma, with the axial
//! forcing Gamma = A omega^2/(pi g): the disk leaves the platform if Gamma > 1/pi.
//!
//! ```
//! use std::f64::consts::PI;
//!
//! use bouncing_disk::System;
//!
//! // The hand of Table I throws the dough; at a third of its frequency the dough stays on it.
//! let toss = System::pizza_toss();
//! let slow = toss.with_platform(|hand| hand.angular_frequency /= 3.0)?;
//! assert!(toss.axial_forcing() > 1.0 / PI && slow.axial_forcing() < 1.0 / PI);
//! # Ok::<(), bouncing_disk::Error>(())
//! ```
//!
//! [`Scales`] converts dimensionless results to SI. The resulting motion is in [`motion`](crate::motion).
//! Equations and units are in docs/model.md.

pub(crate) mod contact;
pub(crate) mod dimensionless;
pub(crate) mod disk;
pub(crate) mod driven_platform;
pub(crate) mod load;
pub(crate) mod platform;
pub(crate) mod presets;
pub(crate) mod scales;
pub(crate) mod stator;
pub(crate) mod stroke;
pub(crate) mod system;

pub use contact::estimate::{ContactStatement, ContactWarning, LiftOff};
pub use contact::{Contact, ContactLaw, Geometry, Material};
pub use dimensionless::{DimensionlessParameters, DimensionlessSystem, ForcingParameters};
pub use driven_platform::{DriveParameters, DrivenPlatform, MapNumber, Waveform};
pub use load::{LoadLaw, LoadSegment, MAX_LOAD_NODES};
pub use scales::Scales;
pub use stator::{Circuit, ElectricalInput, StatorKind, StatorModes, StatorParameters, VibrationMode};
pub use stroke::{LaunchSpeeds, Stroke};
