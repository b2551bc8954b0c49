//! A motor that lifts a weight: its speed against the torque of the load, and the power it gives.
//!
//!     cargo run --release -p bouncing-disk --example motor_with_load
#![allow(clippy::print_stdout, reason = "an example shows its result")]

use bouncing_disk::core::Unobserved;
use bouncing_disk::estimate::TransientEnsemble;
use bouncing_disk::motor::TransientSettings;
use bouncing_disk::{Error, System};

fn main() -> Result<(), Error> {
    let motor = System::motor();
    // The model needs no mass, but a torque does: a steel ball of 20 mm.
    let mass = 0.033;
    let settings = TransientSettings { duration: 8.0, intervals: 160, ..TransientSettings::default() };

    for torque in [0.0, 5e-6, 10e-6, 15e-6, 20e-6, 25e-6, 30e-6] {
        let loaded = motor.with_load_torque(torque, mass)?;
        let motors = TransientEnsemble::new(&loaded, &settings, 16, &Unobserved)?;
        // The second half of each run: the motor has run up.
        let mut speed = 0.0;
        for curve in &motors.curves {
            speed += curve.mean_over_last(0.5)? / motors.curves.len() as f64;
        }
        println!("{:4.1} uN m: {speed:6.2} rad/s, {:6.1} uW", torque * 1e6, torque * speed * 1e6);
    }
    Ok(())
}
