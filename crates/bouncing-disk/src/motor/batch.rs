//! Many rotors at once: the transients of an ensemble in lockstep, and all rotors that share one vertical
//! motion.

pub(crate) mod members;
pub(crate) mod rotor_rows;
pub(crate) mod rotors;
pub(crate) mod shared_orbit;
pub(crate) mod transients;
