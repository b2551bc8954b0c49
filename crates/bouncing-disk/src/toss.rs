//! Tosses: a single one, and many in a row.
//!
//! A single toss starts at rest at the lowest point of the hand (Sec. III of Liu, Friend and Yeo). Its
//! efficiency is the rotary energy divided by the work of the hand; its speed ratio is the spin divided by the
//! hand's largest angular speed. Many tosses (Sec. IV) settle on an orbit. On an orbit with one impact per
//! period, the disk turns with the hand at the impact (Eq. 16), at omega Phi cos(tau + theta) with cos tau =
//! (1 - r)/((1 + r) Gamma).
//!
//! ```
//! use bouncing_disk::System;
//! use bouncing_disk::toss::{InitialSpin, single_toss};
//!
//! // The toss of Table I, and the same toss by a hand that is faster by a tenth.
//! let toss = single_toss(&System::pizza_toss(), InitialSpin::AbsoluteRest)?;
//! let hand = System::pizza_toss().with_platform(|hand| hand.angular_frequency *= 1.1)?;
//! let faster = single_toss(&hand, InitialSpin::AbsoluteRest)?;
//! assert!(faster.airborne_speed > toss.airborne_speed);
//! # Ok::<(), bouncing_disk::Error>(())
//! ```
//!
//! [`multi_toss`] classifies the orbit of many tosses. All orbits of the vertical motion are in
//! [`core::orbits`](crate::core::orbits).

pub(crate) mod chattering_cycle;
pub(crate) mod collisions;
pub(crate) mod multiple;
pub(crate) mod rotary_response;
pub(crate) mod single;

pub use chattering_cycle::{ChatteringCycle, EXAMINED_IMPACTS, LOCKED_FLIGHTS, LOCKED_WITHIN, LONG_FLIGHT};
pub use collisions::{Collision, CollisionEvent, CollisionState, Collisions};
pub use multiple::{MAX_EXAMINED, MultiTossSettings, OrbitClass, TossOrbit, multi_toss};
pub use rotary_response::{
    RotaryOutcome, RotaryResponse, RotaryRound, period_one_rotary_speed, rotary_response, rotary_round,
};
pub use single::{InitialSpin, TOSS_START, TossPerformance, single_toss, toss_trajectory};
