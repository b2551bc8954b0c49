//! The friction of a motor in volts from the points that its maker prints.
//!
//!     cargo run --release -p bouncing-disk --features fit --example fit_rated_points
#![allow(clippy::print_stdout, reason = "an example shows its result")]

use bouncing_disk::Motor;
use bouncing_disk::core::Unobserved;
use bouncing_disk::estimate::{FitError, FitParameter, FitRange, MotorFit, MotorFitSettings, RatedPoint};

/// The sheet in volts above with a larger contact radius, and a friction that nobody has measured.
const DATA_SHEET: &str = r#"{
    "drive_frequency": 70e3, "peak_angular_speed": 30.0, "mass": 0.033, "contact_radius": 5e-3,
    "gyration_radius": 6.3e-3, "preload_force": 0.3, "friction": 0.2, "restitution": 0.5,
    "stator": {"mass": 0.05, "quality": 300, "resonance": 70e3, "anti_resonance": 70.4e3, "capacitance": 1.2e-9, "volts": 10}
}"#;

fn main() -> Result<(), FitError> {
    let motor = Motor::from_json(DATA_SHEET).expect("a legal sheet");
    // 26 rad/s without load and 19 under 80 uN m, to 0.5; it stops at 150 uN m, to 3 %.
    let points = [
        RatedPoint::under_load([0.0, 0.0], [26.0, 0.5]),
        RatedPoint::under_load([8e-5, 0.0], [19.0, 0.5]),
        RatedPoint::under_load([1.5e-4, 5e-6], [0.0, 0.0]),
    ];
    let friction = FitRange { parameter: FitParameter::Friction, low: 0.05, high: 0.4 };
    // Some seconds; the default takes what is needed.
    let mut settings = MotorFitSettings { most_evaluations: 24, ..MotorFitSettings::default() };
    settings.operating.most_impacts = 50_000;
    let fit = MotorFit::new(&motor, &points, &[], &[friction], &settings, &Unobserved)?;
    println!("{fit:.3}");
    for (point, printed) in fit.points.iter().zip(["no load", "rated", "stall"]) {
        println!(
            "{printed}: {:.1} printed, {:.1} +- {:.1} fitted",
            point.printed, point.fitted, point.standard_error
        );
    }
    Ok(())
}
