//! The platform: its phase, and its vibration P sin tau.

pub(crate) mod crests;
pub(crate) mod phase;
pub(crate) mod vibration;
