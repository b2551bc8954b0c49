//! The motor: its data sheet, its steady operation under a load and sweeps of it, speed transients and ensembles of
//! them, fits with and without intervals, the balance of the impulse, stall, and braking.

pub(crate) mod brake;
pub(crate) mod braking_fit;
pub(crate) mod correlation;
pub(crate) mod data_sheet;
pub(crate) mod ensemble;
pub(crate) mod fit;
pub(crate) mod fit_refusal;
pub(crate) mod impulse;
pub(crate) mod interval_estimate;
pub(crate) mod measured_speeds;
pub(crate) mod operation;
#[cfg(feature = "fit")]
pub(crate) mod parameter_fit;
pub(crate) mod rotor;
pub(crate) mod rotor_rows;
pub(crate) mod rotors;
pub(crate) mod sensitivity;
pub(crate) mod shared_orbit;
pub(crate) mod stall;
pub(crate) mod statistics;
pub(crate) mod sweep;
pub(crate) mod transient;
pub(crate) mod transient_fit;
pub(crate) mod transients;
pub(crate) mod traps;
