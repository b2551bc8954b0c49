//! A motor that drives a fan: where the fan's torque crosses the torque-speed curve, and how it turns.
//!
//!     cargo run --release -p bouncing-disk --example fan
#![allow(clippy::print_stdout, reason = "an example shows its result")]

use bouncing_disk::core::Unobserved;
use bouncing_disk::motor::{OperatingPoint, OperatingSettings};
use bouncing_disk::parameters::LoadLaw;
use bouncing_disk::{Error, Motor};

/// The paper's motor at this amplitude (m) with this load, under each of these torques (N m) on top of it.
fn points(amplitude: f64, load: LoadLaw, torques: &[f64]) -> Result<Vec<OperatingPoint>, Error> {
    let motor =
        Motor::paper_70_khz().with(|sheet| (sheet.amplitude, sheet.load) = (Some(amplitude), Some(load)))?;
    let settings = OperatingSettings { relative_error: 0.005, ..OperatingSettings::default() };
    let found = motor.torque_speed_curve(torques, &settings, &Unobserved)?;
    Ok(found.iter().filter_map(|operation| operation.point().copied()).collect())
}

fn main() -> Result<(), Error> {
    // 18 uN m at 20 rad/s.
    let fan = LoadLaw::fan(20.0, 18e-6, 7)?;
    let rotor = Motor::paper_70_khz().inertia();
    for (amplitude, shaft, torques) in
        [(1e-8, 0.0, [10e-6, 11e-6]), (1e-6, 0.0, [11e-6, 12e-6]), (1e-6, 10.0, [11e-6, 12e-6])]
    {
        let constant = LoadLaw::constant(0.0)?.with_inertia(shaft * rotor)?;
        let curve = points(amplitude, constant, &torques)?;
        // How much more the fan would take at the speed of a point.
        let more = |point: &OperatingPoint| fan.torque_at(point.speed.value, 0.0) - point.load_torque;
        let run = points(amplitude, fan.with_inertia(shaft * rotor)?, &[0.0])?;
        for pair in curve.windows(2).filter(|pair| more(&pair[0]) >= 0.0 && more(&pair[1]) < 0.0) {
            let share = more(&pair[0]) / (more(&pair[0]) - more(&pair[1]));
            let crossing = pair[0].speed.value + share * (pair[1].speed.value - pair[0].speed.value);
            let error = pair[0].speed.standard_error.max(pair[1].speed.standard_error);
            println!(
                "{:4.0} nm, shaft {shaft:2.0}: curves cross at {crossing:.2} +- {error:.2} rad/s, {:.2} uN m",
                1e9 * amplitude,
                1e6 * fan.torque_at(crossing, 0.0)
            );
        }
        for point in &run {
            println!(
                "                   it turns at {:.2} +- {:.2} rad/s, {:.2} +- {:.2} uN m",
                point.speed.value,
                point.speed.standard_error,
                1e6 * point.load_torque,
                1e6 * point.load_torque_error
            );
        }
    }
    Ok(())
}
