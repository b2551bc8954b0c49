//! The platform: its phase, its vibration P sin tau, and the phases at which it falls away from a disk at
//! rest. Its twist, Eq. (1), belongs to the model (`parameters/platform.rs`).

pub(crate) mod phase;
pub(crate) mod vibration;
