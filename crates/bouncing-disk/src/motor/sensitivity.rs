//! How the steady speed and the stall torque of a motor depend on its parameters, next to its data sheet, as
//! exponents, each with its standard error.
//!
//! Derivations and choices: docs/numerics-dynamics.md, "Sensitivities".

pub(crate) mod local;
pub(crate) mod parameter;
