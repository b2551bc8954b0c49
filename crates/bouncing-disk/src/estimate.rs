//! What measured or computed curves say of a motor: fits of transients and of braking, with intervals, or a reason why
//! there is none.

pub(crate) mod braking_fit;
pub(crate) mod ensemble;
pub(crate) mod fit;
pub(crate) mod interval;
pub(crate) mod measured_speeds;
#[cfg(feature = "fit")]
pub(crate) mod parameter_fit;
pub(crate) mod refusal;
pub(crate) mod statistics;
pub(crate) mod transient_fit;
