//! A motor under loads: its torque-speed curve with power and efficiency, its stall load, and its best phase
//! lag.
//!
//!     cargo run --release -p bouncing-disk --example torque_speed
#![allow(clippy::print_stdout, reason = "an example shows its result")]

use bouncing_disk::core::Unobserved;
use std::f64::consts::{FRAC_PI_6, TAU};

use bouncing_disk::motor::{
    BestSearch, MotorField, OperatingSettings, Operation, SearchRange, SweepQuantity,
};
use bouncing_disk::{Error, Motor};

fn main() -> Result<(), Error> {
    // The motor of the data sheet above: 40 kHz, 0.5 um, 20 g under 5 N.
    let motor = Motor::paper_70_khz().with(|sheet| {
        sheet.drive_frequency = 40e3;
        sheet.amplitude = Some(0.5e-6);
        (sheet.peak_angular_speed, sheet.twist_amplitude) = (Some(12.0), None);
        sheet.phase_lag = FRAC_PI_6;
        (sheet.mass, sheet.density, sheet.rotor_radius) = (Some(0.020), None, None);
        (sheet.preload_force, sheet.preload_acceleration) = (Some(5.0), None);
        sheet.friction = 0.1;
        sheet.restitution = 0.5;
    })?;
    let settings = OperatingSettings::default();

    // All loads share one vertical motion. Each number comes with its standard error.
    let loads = [0.0, 0.2, 0.4, 0.6, 0.8, 1.2].map(|share| share * motor.largest_torque());
    for operation in motor.torque_speed_curve(&loads, &settings, &Unobserved)? {
        let load = 1e3 * operation.load_torque();
        match operation.operation() {
            // One that lacks something is known all the same: its error is larger than was asked for.
            Operation::Steady(point) | Operation::Unsettled(point, _) => {
                let efficiency = point.efficiency.map_or("driven by the load".to_owned(), |efficiency| {
                    format!("efficiency {:.2} %", 100.0 * efficiency.value)
                });
                println!(
                    "{load:.3} mN m: {:6.2} +- {:.2} rad/s, {:6.3} mW of {:.0}, {efficiency}",
                    point.speed.value,
                    point.speed.standard_error,
                    1e3 * point.mechanical_power.value,
                    1e3 * point.input_power.value,
                );
            }
            Operation::Runaway { acceleration, .. } => {
                println!("{load:.3} mN m: overpowered, {acceleration:.0} rad/s^2");
            }
            unsettled => println!("{load:.3} mN m: {unsettled:?}"),
        }
    }

    // The load that stops it, and the lag at which it turns fastest.
    let stall = motor.stall_load(&settings, &Unobserved)?;
    println!(
        "stalls at {:.4} +- {:.4} mN m, {:.2} mu m g a_e",
        1e3 * stall.torque.value,
        1e3 * stall.torque.standard_error,
        stall.share
    );
    let turn = SearchRange { field: MotorField::PhaseLag, low: 0.0, high: TAU };
    let sought = BestSearch { objective: SweepQuantity::Speed, ranges: vec![turn], bounds: vec![] };
    let best = motor.best(&sought, &settings, &Unobserved)?;
    let lag = &best.values[0];
    println!(
        "fastest at a lag of {:.2} +- {:.2} rad: {:.2} +- {:.2} rad/s",
        lag.value.value, lag.value.standard_error, best.value.value, best.value.standard_error
    );
    if let Some([low, high]) = lag.good_from_to {
        println!("within 1 % of it from {low:.2} to {high:.2} rad");
    }
    Ok(())
}
