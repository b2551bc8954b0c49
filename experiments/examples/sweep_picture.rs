//! A map of a motor's efficiency over load and phase lag, written as a picture.
//!
//!     cargo run --release -p bouncing-disk-experiments --example sweep_picture -- efficiency.png
#![allow(clippy::print_stdout, reason = "an example shows its result")]

use bouncing_disk::core::Unobserved;
use std::error::Error;

use bouncing_disk::{Motor, MotorField, MotorSweep, OperatingSettings, SweepAxis, SweepQuantity};
use bouncing_disk_experiments::sweep_picture;

fn main() -> Result<(), Box<dyn Error>> {
    let motor = Motor::paper_70_khz();
    let largest = motor.largest_torque();
    let lags = (-10..=10).map(|k| 0.15 * f64::from(k)).collect();
    let loads = (0..18).map(|k| largest * f64::from(k) / 20.0).collect();
    let axes =
        vec![SweepAxis::new(MotorField::LoadTorque, loads), SweepAxis::new(MotorField::PhaseLag, lags)];
    let settings = OperatingSettings { relative_error: 0.03, members: 8, ..OperatingSettings::default() };
    let result = MotorSweep::new(motor, axes, settings)?.run(&Unobserved)?;

    let path = std::env::args().nth(1).unwrap_or_else(|| "efficiency.png".to_owned());
    std::fs::write(&path, sweep_picture(&result, SweepQuantity::Efficiency).to_png()?)?;
    println!("{path} is written");
    Ok(())
}
