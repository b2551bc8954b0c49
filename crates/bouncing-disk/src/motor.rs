//! The motor: speed transients, ensembles of them and their statistics, fits with and without intervals, the balance of
//! the impulse, stall, and braking.

pub(crate) mod brake;
pub(crate) mod braking_fit;
pub(crate) mod correlation;
pub(crate) mod ensemble;
pub(crate) mod estimate;
pub(crate) mod fit;
pub(crate) mod fit_refusal;
pub(crate) mod impulse;
pub(crate) mod measured_speeds;
pub(crate) mod rotor;
pub(crate) mod rotors;
pub(crate) mod stall;
pub(crate) mod statistics;
pub(crate) mod transient;
pub(crate) mod transient_fit;
pub(crate) mod transients;
