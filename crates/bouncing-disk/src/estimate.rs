//! Estimates from computed or measured speeds of a rotor, with intervals, or the reason why a fit was
//! rejected.
//!
//! A run-up determines the steady speed and the time constant of alpha_ss (1 - exp(-t/t_c)), by least squares
//! over its mean curve, with 95 % intervals by resampling. A braking curve with the angular acceleration alpha
//! determines the friction mu = -m a_g^2 alpha/(a_e N) (Eq. 17 of Liu, Friend and Yeo).
//!
//! ```
//! use bouncing_disk::estimate::BrakingRotor;
//!
//! // A rotor of 1 kg that slows down by 10 rad/s^2 from 50 rad/s.
//! let rotor = BrakingRotor { normal_force: 9.8, mass: 1.0, contact_radius: 0.1, gyration_radius: 0.1 };
//! assert!((rotor.friction(-10.0)? - 1.0 / 9.8).abs() < 1e-15);
//! # Ok::<(), bouncing_disk::estimate::FitError>(())
//! ```
//!
//! [`TransientFit`] fits run-ups, and `MotorFit` (feature `fit`) finds the motor parameters that explain
//! run-ups, braking tails and catalogue points. [`MeasuredSpeeds`] contains measurements, which can be
//! read from files with the feature `csv`. Run-ups of the model are in [`motor`](crate::motor).
//! docs/numerics-dynamics.md derives the intervals.

pub(crate) mod braking_rotor;
pub(crate) mod ensemble;
pub(crate) mod fit;
pub(crate) mod interval;
pub(crate) mod measured_speeds;
#[cfg(feature = "fit")]
pub(crate) mod motor_fit;
pub(crate) mod refusal;
pub(crate) mod transient_fit;

pub use braking_rotor::BrakingRotor;
pub use ensemble::{Spread, TransientEnsemble};
pub use fit::{ExponentialFit, RampFit};
pub use interval::IntervalEstimate;
#[cfg(feature = "csv")]
pub use measured_speeds::csv_file::CsvColumns;
#[cfg(feature = "csv")]
pub use measured_speeds::error::{CsvFault, MeasuredSpeedsError};
pub use measured_speeds::units::{SpeedUnit, TimeUnit, UnknownUnit};
pub use measured_speeds::{MeasuredRun, MeasuredSpeeds};
#[cfg(feature = "fit")]
pub use motor_fit::estimate::{AcceptedRange, UndeterminedDirection};
#[cfg(feature = "fit")]
pub use motor_fit::parameter::{FitParameter, FitRange};
#[cfg(feature = "fit")]
pub use motor_fit::point::{RatedCondition, RatedPoint};
#[cfg(feature = "fit")]
pub use motor_fit::transient::{MeasuredTransient, TransientKind};
#[cfg(feature = "fit")]
pub use motor_fit::{FittedParameter, FittedPoint, MotorFit, MotorFitSettings};
pub use refusal::{FitError, FitRefusal};
pub use transient_fit::{FitSettings, LEAST_MEMBERS, RiseEstimate, RiseForm, TransientFit};
