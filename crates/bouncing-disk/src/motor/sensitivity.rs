//! How the steady speed and the stall torque of a motor depend on its parameters: locally, as exponents, and
//! over ranges, as shares of the variance (Sobol' indices) and as elementary effects (Morris), each with its
//! standard error.
//!
//! Derivations and choices: docs/numerics/design.md, "Sensitivities".

pub(crate) mod global;
pub(crate) mod local;
pub(crate) mod morris;
pub(crate) mod parameter;
pub(crate) mod resamples;
pub(crate) mod sobol;
