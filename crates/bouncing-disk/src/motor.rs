//! The motor: speed transients, ensembles of them, fits, and braking.

pub(crate) mod brake;
pub(crate) mod ensemble;
pub(crate) mod fit;
pub(crate) mod rotor;
pub(crate) mod rotors;
pub(crate) mod transient;
pub(crate) mod transients;
