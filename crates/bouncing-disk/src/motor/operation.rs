//! A motor in steady operation: mean speed, powers, losses and efficiency under a load, each with its
//! standard error.
//!
//! All numbers come from the same perturbed runs: an ensemble of vertical motions, each of which carries
//! every requested rotor (see [`crate::motor::batch::shared_orbit`]). The scatter of the members determines
//! how long they run, which part counts as start-up, and when a number is known well enough. See
//! docs/numerics-dynamics.md.

mod averages;
pub(crate) mod coupled;
mod crossing;
pub(crate) mod loaded_motor;
mod member;
pub(crate) mod of_motor;
pub(crate) mod point;
pub(crate) mod settings;
mod settling;
pub(crate) mod spread;
pub(crate) mod stall_load;
pub(crate) mod steady_run;
pub(crate) mod survey;
pub(crate) mod trap_ranges;
