//! The platform: its phase, and its vibration P sin tau. (Its twist, Eq. (1), is the model's: `parameters/platform.rs`.)

pub(crate) mod crests;
pub(crate) mod phase;
pub(crate) mod vibration;
