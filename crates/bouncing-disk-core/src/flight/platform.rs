//! The platform: its phase, its vibration P sin tau, and where it falls away from a disk at rest. (Its twist,
//! Eq. (1), is the model's: `parameters/platform.rs`.)

pub(crate) mod phase;
pub(crate) mod vibration;
