//! A motor from its data sheet: what follows from it, what the motor does, and what may not be meant.
//!
//!     cargo run --release -p bouncing-disk --example motor_from_json
#![allow(clippy::print_stdout, reason = "an example shows its result")]

use bouncing_disk::core::Unobserved;
use std::error::Error;

use bouncing_disk::Motor;

/// SI units throughout; `MotorParameters` describes all fields, and says which of them may be missing.
const DATA_SHEET: &str = r#"{
    "drive_frequency": 40e3,
    "amplitude": 0.5e-6,
    "peak_angular_speed": 12.0,
    "phase_lag": 0.5236,
    "mass": 0.020,
    "contact_radius": 1.25e-3,
    "gyration_radius": 6.3e-3,
    "preload_force": 5.0,
    "spring_constant": 2000.0,
    "friction": 0.1,
    "restitution": 0.5
}"#;

fn main() -> Result<(), Box<dyn Error>> {
    let motor = Motor::from_json(DATA_SHEET)?;
    println!("{}\n", motor.report(&Unobserved)?);

    // A preload in N that was given as an acceleration: legal, but with a warning.
    let mistaken = Motor::from_json(&DATA_SHEET.replace("preload_force", "preload_acceleration"))?;
    for warning in mistaken.warnings() {
        println!("warning: {warning}");
    }
    // A misspelt key: refused.
    if let Err(error) = Motor::from_json(&DATA_SHEET.replace("contact_radius", "contact_raduis")) {
        println!("error: {error}");
    }
    Ok(())
}
