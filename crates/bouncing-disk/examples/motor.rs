//! An ultrasonic motor: how it runs up, and how fast it turns in the end (Fig. 10 of the paper).
//!
//!     cargo run --release -p bouncing-disk --example motor
#![allow(clippy::print_stdout, reason = "an example shows its result")]

use bouncing_disk::core::{Phase, Unobserved};
use bouncing_disk::estimate::{ExponentialFit, TransientEnsemble};
use bouncing_disk::motor::{TransientSettings, transient};
use bouncing_disk::{Error, System};

fn main() -> Result<(), Error> {
    // Table III of the paper: 70 kHz, an amplitude of 10 nm, and a steel ball under its own weight.
    let motor = System::motor();
    let settings = TransientSettings { duration: 8.0, intervals: 160, ..TransientSettings::default() };

    // One run: the mean speed in each of 160 intervals, and the curve that the paper fits to it.
    let curve = transient(&motor, Phase::new(0.0)?, &settings, &Unobserved)?;
    let fit = ExponentialFit::new(&curve.times, &curve.speeds, &Unobserved)?;
    for i in [4, 19, 39, 79, 159] {
        println!(
            "{:5.3} s: {:5.2} rad/s, fitted {:5.2}",
            curve.times[i],
            curve.speeds[i],
            fit.speed(curve.times[i])
        );
    }

    // One run is one throw of the dice. The behaviour of a motor is the mean over many, with its error.
    let motors = TransientEnsemble::new(&motor, &settings, 32, &Unobserved)?;
    let (speed, stall) = (motors.steady_speed, motors.stall_acceleration);
    println!("steady speed {:.2} +- {:.2} rad/s", speed.mean, speed.standard_error);
    // After this time the motor has reached its steady speed but for a share of 1/e.
    let constant = motors.time_constant;
    println!("time constant {:.3} +- {:.3} s", constant.mean, constant.standard_error);
    println!("stall acceleration {:.1} +- {:.1} rad/s^2", stall.mean, stall.standard_error);
    Ok(())
}
