//! An ultrasonic motor as a functional mock-up unit (FMU) of [FMI 3.0](https://fmi-standard.org), for co-simulation with
//! the drive train around it.
//!
//! This library is the binary of the unit, and [`packed`] makes the unit of a data sheet from it. The motor is a
//! [`MotorSimulation`](bouncing_disk::motor::MotorSimulation): impacts are exact inside of a step, and for constant
//! inputs the motion does not depend on the steps, to the last bit.
//!
//! All variables are of the type Float64, because some masters know no other. Every instance is independent of the
//! others, states can be stored and restored, and the log names each error.
//!
//! No crate writes this interface here: the one there is (`fmi-export`) has no stored states, and brings 150 others.

#![deny(unsafe_op_in_unsafe_fn)]

mod abi;
mod description;
mod instance;
mod package;
mod variables;

pub use package::{PackageError, library_name, packed};
