//! A map of a motor: its speed and efficiency over the preload and the load.
//!
//!     cargo run --release -p bouncing-disk --example motor_sweep
#![allow(clippy::print_stdout, reason = "an example shows its result")]

use bouncing_disk::core::Unobserved;
use bouncing_disk::motor::{MotorField, MotorSweep, OperatingSettings, SweepAxis, SweepQuantity};
use bouncing_disk::{Error, Motor};

fn main() -> Result<(), Error> {
    let motor = Motor::paper_70_khz();
    let loads = [0.0, 0.25, 0.5, 0.75, 1.0].map(|share| share * motor.largest_torque());
    let sweep = MotorSweep::new(
        motor,
        vec![
            SweepAxis::new(MotorField::PreloadForce, vec![0.2, 0.3, 0.4]),
            SweepAxis::new(MotorField::LoadTorque, loads.to_vec()),
        ],
        OperatingSettings { relative_error: 0.02, ..OperatingSettings::default() },
    )?;
    for field in sweep.replaced() {
        println!("(the {field} of the data sheet is left out)");
    }
    // All loads at one preload share one vertical motion.
    println!("{} cells in {} groups", sweep.cells(), sweep.groups().len());

    let result = sweep.run(&Unobserved)?;
    let maps = [SweepQuantity::Speed, SweepQuantity::Efficiency].map(|quantity| result.matrix(quantity));
    print!("{:>12}", "load (uN m)");
    for load in &result.axes()[1].values {
        print!("{:>21.2}", load * 1e6);
    }
    println!();
    for (row, preload) in result.axes()[0].values.iter().enumerate() {
        print!("{:>12}", format!("{preload} N"));
        for (speed, efficiency) in maps[0][row].iter().zip(&maps[1][row]) {
            let cell = match (speed, efficiency) {
                (Some(speed), Some(efficiency)) => {
                    format!("{speed:.1} rad/s {:.1} %", 100.0 * efficiency)
                }
                (Some(speed), None) => format!("{speed:.1} rad/s"),
                (None, _) => "runs away".to_owned(),
            };
            print!("{cell:>21}");
        }
        println!();
    }
    Ok(())
}
