//! A disk that bounces on a platform which vibrates and twists: pizza dough on a hand, the rotor of an ultrasonic
//! motor on its stator (Liu, Friend and Yeo, Phys. Rev. E 80, 046201 (2009)).
//!
//! Parameters are SI ([`Platform`], [`Disk`], [`System`]); motion is computed without units ([`Dimensionless`],
//! [`Engine`]) and carried back by [`Scales`].
//!
//! ```
//! use bouncing_disk::{DiskParameters, InitialState, Platform, Stroke, System, single_toss};
//!
//! # fn main() -> Result<(), bouncing_disk::Error> {
//! // The single pizza toss of Table I.
//! let platform = Platform::from_stroke(Stroke {
//!     stroke: 0.25,
//!     amplitude_angle: 0.55,
//!     contact_radius: 0.135,
//!     angular_frequency: 15.0,
//!     phase_lag: 0.0,
//! })?;
//! let dough = DiskParameters {
//!     contact_radius: 0.135,
//!     gyration_radius: 0.11,
//!     friction: 0.6,
//!     restitution: 0.0,
//!     preload_acceleration: 9.8,
//!     load_acceleration: 0.0,
//! };
//! let system = System::new(platform, dough.build()?)?;
//! let toss = single_toss(&system, InitialState::AbsoluteRest)?;
//! assert_eq!(toss.airborne_speed.round(), 14.0);
//! # Ok(())
//! # }
//! ```
//!
//! Everything is deterministic to the last bit: the same parameters and start give the same events on every machine.

mod arc;
mod brake;
mod chatter;
mod contact;
mod dimensionless;
mod disk;
mod engine;
mod error;
mod event;
mod fit;
mod impact;
mod ledger;
mod motor;
mod multi_toss;
mod phase_time;
mod platform;
mod rotor;
mod scales;
mod spell;
mod start;
mod state;
mod system;
#[cfg(test)]
mod testing;
mod toss;
mod trajectory;
mod transient;
mod transients;
mod transition;

/// The math core: the vertical motion, its impact map and what is done with it.
pub use bouncing_disk_core as core;

pub use brake::{Braking, friction_from_braking};
pub use contact::MAX_CONTACT_EVENTS;
pub use dimensionless::{Dimensionless, DimensionlessParameters, ForcingParameters};
pub use disk::{Disk, DiskParameters};
pub use engine::Engine;
pub use error::Error;
pub use event::{Event, EventRecord};
pub use fit::{ExponentialFit, RampFit};
pub use ledger::EnergyLedger;
pub use motor::{Ensemble, MAX_MEMBERS, MAX_SPEEDS, Spread, ensemble};
pub use multi_toss::{
    Collision, CollisionEvent, CollisionState, Collisions, MAX_EXAMINED, MultiTossSettings, OrbitClass,
    TossOrbit, multi_toss, period_one_rotary_speed,
};
pub use phase_time::{PhaseSpan, PhaseTime};
pub use platform::{LaunchSpeeds, Platform, PlatformParameters, Stroke};
pub use scales::{Scales, SiEnergy, SiState};
pub use spell::Spell;
pub use start::Start;
pub use state::{DiskState, Mode, PlatformState, SlipDirection, Snapshot};
pub use system::System;
pub use toss::{InitialState, TOSS_START, TossPerformance, single_toss, toss_trajectory};
pub use trajectory::Trajectory;
pub use transient::{SpeedCurve, TransientSettings, transient};
pub use transients::{TransientMember, transients};
pub use transition::{EventKind, ModeKind, Transition};

/// Compiles and runs the examples of the README.
#[cfg(doctest)]
#[doc = include_str!("../../../README.md")]
struct ReadmeExamples;
