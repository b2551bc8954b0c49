//! The motor: speed transients, ensembles of them and their statistics, fits, the balance of the impulse,
//! stall, and braking.

pub(crate) mod brake;
pub(crate) mod ensemble;
pub(crate) mod fit;
pub(crate) mod impulse;
pub(crate) mod rotor;
pub(crate) mod rotors;
pub(crate) mod shared_orbit;
pub(crate) mod stall;
pub(crate) mod statistics;
pub(crate) mod transient;
pub(crate) mod transients;
