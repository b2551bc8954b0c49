//! An ultrasonic motor as a functional mock-up unit (FMU) of [FMI 3.0](https://fmi-standard.org), for
//! co-simulation with the drive train around it.
//!
//! This library is the binary of the unit; [`packed`] makes a unit of it and a data sheet. The motor is a
//! [`MotorSimulation`](bouncing_disk::motor::MotorSimulation): impacts within a step are exact, and for
//! constant inputs the motion does not depend on the steps, to the last bit.
//!
//! All variables are of the type Float64, because some masters support no other. Instances are independent of
//! each other, states can be stored and restored, and the log names each error.
//!
//! The interface is written by hand: the existing crate for it (`fmi-export`) cannot store states and depends
//! on 150 others.

#![deny(unsafe_op_in_unsafe_fn)]

mod abi;
mod description;
mod instance;
mod package;
mod variables;

pub use package::{PackageError, library_name, packed};
