//! Ultrasonic motors: data sheet, run-up, speed under a load, sweeps and sensitivities.
//!
//! The stator throws the rotor, and friction turns it at each impact. Because the mean normal force equals
//! the preload, no motor delivers more torque than mu m g a_e. From rest the mean speed rises about as
//! alpha_ss (1 - exp(-t/t_c)) (Sec. V of Liu, Friend and Yeo). Single run-ups are chaotic, so speeds are
//! means over ensembles, with standard errors.
//!
//! ```
//! use bouncing_disk::core::Unobserved;
//! use bouncing_disk::Motor;
//! use bouncing_disk::motor::{OperatingSettings, Operation};
//!
//! // The motor of Table III under a fifth of the largest torque, its speed known to 5 % of the no-load speed.
//! let motor = Motor::paper_70_khz();
//! let settings = OperatingSettings { relative_error: 0.05, ..OperatingSettings::default() };
//! let load = 0.2 * motor.largest_torque();
//! let row = motor.operating_point(load, &settings, &Unobserved)?;
//! let Operation::Steady(point) = row.operation() else {
//!     panic!("it turns");
//! };
//! assert!(point.speed.value > 0.0);
//! # Ok::<(), bouncing_disk::Error>(())
//! ```
//!
//! [`Motor::transient`](crate::Motor::transient) computes the run-up of one rotor,
//! [`Motor::transients`](crate::Motor::transients) the run-ups of many; [`MotorSweep`] varies the data sheet.
//! All accept any sheet, including waveforms, compliant stators and compliant contacts. Fits of computed or
//! measured run-ups are in [`estimate`](crate::estimate). docs/numerics-dynamics.md states how far the speeds
//! can be trusted.

pub(crate) mod batch;
pub(crate) mod best;
pub mod circular;
pub(crate) mod data_sheet;
pub(crate) mod impulse;
pub(crate) mod operation;
pub(crate) mod parameter_sweep;
pub(crate) mod rotor;
mod run_up;
pub(crate) mod sensitivity;
pub(crate) mod simulation;
mod stator;
pub(crate) mod tape;

pub use batch::members::{MAX_MEMBERS, MAX_SPEEDS, TransientMember};
pub use batch::transients::transients;
pub use best::{Best, BestSearch, BestValue, QuantityBound, SearchRange};
#[cfg(any(feature = "json", feature = "toml"))]
pub use data_sheet::file::MotorFileError;
pub use data_sheet::motor_field::{MotorField, UnknownMotorField};
pub use data_sheet::parameters::MotorParameters;
pub use data_sheet::regime::MotorRegime;
pub use data_sheet::report::{MotorReport, StatorReport};
pub use data_sheet::traps::{TrapVerdict, low_period_traps};
pub use data_sheet::warning::MotorWarning;
pub use impulse::{ImpulseBalance, NormalImpulses, PhasedImpulse};
pub use operation::of_motor::operations;
pub use operation::point::{
    AxialMotion, Estimate, Life, OperatingPoint, OperatingRow, Operation, Shortfall, StatorPoint,
};
pub use operation::settings::OperatingSettings;
pub use operation::spread::{InputSpread, InputTolerance};
pub use operation::stall_load::StallLoad;
pub use operation::steady_run::MAX_OPERATED_ROTORS;
pub use operation::trap_ranges::{LEAST_TRAP_WIDTH, NearestTrap, TrapRange};
pub use parameter_sweep::MotorSweep;
pub use parameter_sweep::axis::{MAX_SWEEP_CELLS, SweepAxis};
pub use parameter_sweep::quantity::SweepQuantity;
pub use parameter_sweep::result::MotorSweepResult;
pub use rotor::transient::{SpeedCurve, TransientSettings, transient};
pub use sensitivity::local::{LocalSensitivity, SensitivityMethod, SensitivitySettings};
pub use sensitivity::parameter::{SensitivityParameter, SensitivityQuantity};
pub use simulation::{MotorInputs, MotorOutputs, MotorSimulation, SimulationSettings};
