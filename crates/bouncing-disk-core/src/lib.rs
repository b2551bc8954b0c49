//! Placeholder docs
pub mod elementary;
mod error;
mod flight;
mod phase;
mod vibration;

pub use error::Error;
pub use flight::{Impact, Launch, MAX_FLIGHT_DURATION};
pub use phase::Phase;
pub use vibration::Vibration;
