//! The dependence of a motor's steady speed and stall torque on its parameters near the data sheet, as
//! exponents, each with its standard error.
//!
//! Derivations and choices: docs/numerics-dynamics.md, "Sensitivities".

pub(crate) mod local;
pub(crate) mod parameter;
