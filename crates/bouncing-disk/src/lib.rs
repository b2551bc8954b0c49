//! A disk that bounces on a platform which vibrates and twists: pizza dough on a hand, the rotor of an ultrasonic
//! motor on its stator (Liu, Friend and Yeo, Phys. Rev. E 80, 046201 (2009)).
//!
//! Parameters are SI ([`Platform`], [`Disk`], [`System`]); motion is computed without units ([`DimensionlessSystem`],
//! [`Engine`]) and carried back by [`Scales`].
//!
//! ```
//! use bouncing_disk::{InitialSpin, System, single_toss};
//!
//! # fn main() -> Result<(), bouncing_disk::Error> {
//! // The single pizza toss of Table I.
//! let toss = single_toss(&System::pizza_toss(), InitialSpin::AbsoluteRest)?;
//! assert_eq!(toss.airborne_speed.round(), 14.0);
//! # Ok(())
//! # }
//! ```
//!
//! | about | items |
//! | --- | --- |
//! | parameters in SI | [`Platform`], [`Stroke`], [`Disk`], [`System`] |
//! | without units | [`DimensionlessSystem`], [`ForcingParameters`], [`Scales`] |
//! | motion | [`Engine`], [`InitialCondition`], [`EventRecord`], [`Segment`], [`Trajectory`], [`EnergyLedger`], [`Transition`] |
//! | tosses | [`single_toss`], [`multi_toss`], [`Collisions`] (the next-collision map), [`period_one_rotary_speed`] (Eq. 16) |
//! | the spin on a periodic orbit | [`rotary_response`], [`RotaryOutcome`], [`rotary_round`] |
//! | a motor's data sheet | [`Motor`], [`MotorParameters`], [`MotorReport`], [`MotorRegime`], [`MotorWarning`]; `MotorFileError` (features `json`, `toml`) |
//! | a motor under a load | [`Motor::torque_speed_curve`], [`Motor::stall_load`], [`Motor::best_phase_lag`], [`operations()`], [`Operation`], [`OperatingPoint`], [`OperatingSettings`] |
//! | sweeps of a motor | [`MotorSweep`], [`SweepAxis`], [`MotorField`], [`MotorSweepRun`], [`MotorSweepResult`], [`SweepQuantity`] |
//! | what a motor depends on | [`Motor::local_sensitivities`], [`Motor::sobol_indices`], [`Motor::elementary_effects`]; [`sobol_indices()`], [`elementary_effects()`] of any function |
//! | best designs | [`best_toss`], [`TossConstraints`], [`TossDesign`], [`TossRobustness`]; [`low_period_traps`], [`Motor::nearest_trap`] |
//! | the motor | [`transient`], [`transients`], [`TransientEnsemble`], [`MotorStatistics`], [`ExponentialFit`], [`RampFit`], [`BrakingRotor::friction`] |
//! | fits with intervals | [`TransientFit`], [`FitSettings`], [`RiseEstimate`], [`BrakingFit`], [`IntervalEstimate`], [`FitError`], [`FitRefusal`] |
//! | measured curves | [`MeasuredSpeeds`], [`MeasuredRun`], [`TimeUnit`], [`SpeedUnit`] (from files with the feature `csv`: `CsvColumns`) |
//! | parameters from transients (feature `fit`) | `ParameterFit`, `MeasuredTransient`, `RunPreload`, `FitParameter`, `FitRange`, `ParameterFitSettings`, `ParameterEstimate`, `UndeterminedDirection` |
//! | what drives and stalls it | [`NormalImpulses`], [`ImpulseBalance`], [`ImpulseTrain`], [`Disk::friction_acceleration`], [`System::rise_time`] |
//! | long calls | [`Observer`], [`Progress`], [`MotorSweepRun`] |
//! | stored files (feature `storage`) | `Provenance`, `Format`; `Journal`, `MotorSweep::run_with_journal`; `StorageError` |
//! | vertical motion | [`mod@core`] |
//!
//! | feature | default | what it does |
//! | --- | --- | --- |
//! | `parallel` | yes | ensembles, grids and sweeps over the threads of rayon's pool, with the same bits |
//! | `serde` | yes | `Serialize` for every result; `Deserialize` for systems, motors, settings and what a stopped run goes on with |
//! | `json` | yes | a motor's data sheet as JSON |
//! | `toml` | no | a motor's data sheet as TOML |
//! | `storage` | yes | provenance of stored files, and the journal of a long computation |
//! | `fit` | no | friction, restitution, phase lag and amplitudes of a motor from its transients |
//! | `csv` | no | measured speeds from comma-separated files, sweeps as such |
//!
//! Systems, motors and the settings of users pass the checks of what is made when they are read: a value outside its
//! range, a key that is missing, unless it is that of an optional value, and one that is unknown are errors. An infinite
//! error bound, or the efficiency of nothing, is `null` in JSON, which has no such number.
//! The feature `json` switches on `float_roundtrip` of `serde_json`; without either a third of all numbers change in the
//! last bit when they are read as JSON.
//!
//! Everything is deterministic to the last bit: the same parameters and start give the same events on every machine.

// The workspace's experiments read such files, too. No part of the documented surface, and no promise.
#[cfg(feature = "csv")]
#[doc(hidden)]
pub mod csv_records;
mod display;
mod error;
mod estimate;
mod motion;
mod motor;
mod parameters;
// As `csv_records`: for the experiments as well, and no promise.
#[cfg(feature = "csv")]
#[doc(hidden)]
pub mod regular_file;
mod statistics;
#[cfg(feature = "storage")]
mod store;
#[cfg(test)]
mod testing;
mod toss;

/// The math core: the vertical motion, its impact map and what is done with it.
pub use bouncing_disk_core as core;

pub use bouncing_disk_core::{Observer, Progress, Unobserved};
pub use error::Error;
pub use estimate::braking_fit::{BrakingFit, BrakingRotor};
pub use estimate::ensemble::{Spread, TransientEnsemble};
pub use estimate::fit::{ExponentialFit, RampFit};
pub use estimate::interval::IntervalEstimate;
#[cfg(feature = "csv")]
pub use estimate::measured_speeds::csv_file::CsvColumns;
#[cfg(feature = "csv")]
pub use estimate::measured_speeds::error::{CsvFault, MeasuredSpeedsError};
pub use estimate::measured_speeds::units::{SpeedUnit, TimeUnit, UnknownUnit};
pub use estimate::measured_speeds::{MeasuredRun, MeasuredSpeeds};
#[cfg(feature = "fit")]
pub use estimate::parameter_fit::ParameterFit;
#[cfg(feature = "fit")]
pub use estimate::parameter_fit::estimate::{ParameterEstimate, UndeterminedDirection};
#[cfg(feature = "fit")]
pub use estimate::parameter_fit::measured_transient::{MeasuredTransient, RunPreload};
#[cfg(feature = "fit")]
pub use estimate::parameter_fit::parameter::{FitParameter, FitRange};
#[cfg(feature = "fit")]
pub use estimate::parameter_fit::settings::ParameterFitSettings;
pub use estimate::refusal::{FitError, FitRefusal};
pub use estimate::statistics::{
    LARGEST_CONSTANT, LARGEST_RESIDUAL, MotorStatistics, RiseForm, unperturbed_orbit,
};
pub use estimate::transient_fit::{FitSettings, LEAST_MEMBERS, RiseEstimate, TransientFit};
pub use motion::energy::EnergyLedger;
pub use motion::engine::Engine;
pub use motion::engine::sample::{MAX_SAMPLED_PERIODS, MAX_SAMPLES};
pub use motion::event::{Event, EventRecord};
pub use motion::friction::MAX_CONTACT_EVENTS;
pub use motion::initial_condition::InitialCondition;
pub use motion::paper_chatter::{PAPER_CHATTER, PAPER_CUT};
pub use motion::phase_time::{PhaseSpan, PhaseTime};
pub use motion::segment::Segment;
pub use motion::si::{SiEnergy, SiState};
pub use motion::state::{DiskState, Mode, PlatformState, SlipDirection, Snapshot};
pub use motion::trajectory::Trajectory;
pub use motion::transition::{EventKind, ModeKind, Transition};
pub use motor::batch::members::{MAX_MEMBERS, MAX_SPEEDS, TransientMember};
pub use motor::batch::transients::transients;
pub use motor::data_sheet::Motor;
#[cfg(any(feature = "json", feature = "toml"))]
pub use motor::data_sheet::file::MotorFileError;
pub use motor::data_sheet::motor_field::{MotorField, UnknownMotorField};
pub use motor::data_sheet::parameters::MotorParameters;
pub use motor::data_sheet::regime::MotorRegime;
pub use motor::data_sheet::report::MotorReport;
pub use motor::data_sheet::traps::{TrapVerdict, low_period_traps};
pub use motor::data_sheet::warning::MotorWarning;
pub use motor::impulse::{ImpulseBalance, ImpulseTrain, MAX_IMPULSES, NormalImpulses, PhasedImpulse};
pub use motor::operation::best_phase_lag::BestPhaseLag;
pub use motor::operation::ensemble::MAX_OPERATED_ROTORS;
pub use motor::operation::of_motor::operations;
pub use motor::operation::point::{Estimate, OperatingPoint, Operation, Shortfall};
pub use motor::operation::settings::OperatingSettings;
pub use motor::operation::spread::{InputSpread, InputTolerance};
pub use motor::operation::stall_load::StallLoad;
pub use motor::operation::trap_ranges::{LEAST_TRAP_WIDTH, NearestTrap, TrapRange};
pub use motor::rotor::transient::{SpeedCurve, TransientSettings, transient};
pub use motor::sensitivity::global::ParameterRange;
pub use motor::sensitivity::local::{LocalSensitivity, SensitivityMethod, SensitivitySettings};
pub use motor::sensitivity::morris::{ElementaryEffects, elementary_effects};
pub use motor::sensitivity::parameter::{SensitivityParameter, SensitivityQuantity};
pub use motor::sensitivity::sobol::{SamplingSettings, SobolIndices, sobol_indices};
pub use motor::sweep::MotorSweep;
pub use motor::sweep::axis::{MAX_SWEEP_CELLS, SweepAxis};
pub use motor::sweep::quantity::SweepQuantity;
pub use motor::sweep::result::MotorSweepResult;
pub use motor::sweep::run::MotorSweepRun;
pub use parameters::dimensionless::{DimensionlessParameters, DimensionlessSystem, ForcingParameters};
pub use parameters::disk::{Disk, DiskParameters};
pub use parameters::platform::{Platform, PlatformParameters};
pub use parameters::scales::Scales;
pub use parameters::stroke::{LaunchSpeeds, Stroke};
pub use parameters::system::System;
#[cfg(feature = "storage")]
pub use store::error::StorageError;
#[cfg(feature = "storage")]
pub use store::journal::{JOURNAL, Journal};
#[cfg(feature = "storage")]
pub use store::provenance::{Format, Provenance};
pub use toss::chattering_cycle::{ChatteringCycle, EXAMINED_IMPACTS, LONG_FLIGHT};
pub use toss::collisions::{Collision, CollisionEvent, CollisionState, Collisions};
pub use toss::design::constraints::{OverFriction, TossCertificate, TossConstraints, TossObjective};
pub use toss::design::robustness::{Robustness, TossHalfUnits, TossInput, TossRobustness};
pub use toss::design::{TossDesign, best_toss};
pub use toss::multiple::{MAX_EXAMINED, MultiTossSettings, OrbitClass, TossOrbit, multi_toss};
pub use toss::rotary_response::{
    RotaryOutcome, RotaryResponse, RotaryRound, period_one_rotary_speed, rotary_response, rotary_round,
};
pub use toss::single::{InitialSpin, TOSS_START, TossPerformance, single_toss, toss_trajectory};

/// Compiles and runs the example of the README.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadmeExamples;

/// Compiles and runs the programs of the tutorial.
#[cfg(doctest)]
#[doc = include_str!("../../../docs/tutorial.md")]
struct TutorialExamples;

/// Compiles and runs the programs of the page on motors.
#[cfg(all(doctest, feature = "storage"))]
#[doc = include_str!("../../../docs/designing-a-motor.md")]
struct MotorExamples;
