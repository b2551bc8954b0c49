//! The best toss of a dough on hands whose flour makes the friction uncertain, and the trap nearest to a
//! motor.
//!
//!     cargo run --release -p bouncing-disk --example design_toss
#![allow(clippy::print_stdout, reason = "an example shows its result")]

use bouncing_disk::core::Unobserved;
use std::f64::consts::PI;

use bouncing_disk::toss::{TossConstraints, TossHalfUnits, TossObjective, best_toss};
use bouncing_disk::{Error, Motor};

fn main() -> Result<(), Error> {
    // The dough and the stroke of Table I; a friction anywhere from 0.5 to 0.7, and a low ceiling.
    let constraints = TossConstraints {
        friction: [0.5, 0.7],
        angular_frequency: [10.0, 18.0],
        highest_flight: Some(0.5),
        ..TossConstraints::pizza_toss()
    };
    // Hands keep to these digits.
    let half_units = TossHalfUnits {
        stroke: 0.005,
        angular_frequency: 0.5,
        amplitude_angle: 0.02,
        phase_lag: 0.1,
        ..TossHalfUnits::default()
    };
    for (objective, unit) in [
        (TossObjective::AirborneSpeed, "rad/s"),
        (TossObjective::Efficiency, "of the energy"),
        (TossObjective::TurnsPerToss, "turns"),
    ] {
        let design = best_toss(&TossConstraints { objective, ..constraints }, &Unobserved)?;
        let digits = design.robustness(&half_units)?.digits;
        println!(
            "{objective:?}: phi_L = {:.3} pi, omega = {:.2} rad/s, theta = {:.3} pi, {:.2} m high",
            design.hand.amplitude_angle / PI,
            design.hand.angular_frequency,
            design.hand.phase_lag / PI + 0.0,
            design.flight_height,
        );
        println!(
            "  at least {:.3} {unit} at any friction; {:.3} to {:.3} with the digits of the hands, worst {:?}",
            design.value, digits.least, digits.most, digits.worst_input,
        );
    }

    let motor = Motor::paper_70_khz();
    if let Some(trap) = motor.nearest_trap(0.1, &Unobserved)? {
        println!(
            "The motor of Table III: the nearest trap begins {:.2} % away, at {:.4} m/s^2: {}",
            1e2 * trap.relative_distance,
            trap.preload_acceleration,
            trap.verdict.cycle.map_or_else(String::new, |cycle| cycle.to_string()),
        );
    }
    Ok(())
}
