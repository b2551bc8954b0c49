//! The paper's motor at both of its frequencies, as data sheets. Its numbers are in `parameters/presets.rs`.

use std::f64::consts::PI;

use crate::motor::data_sheet::Motor;
use crate::motor::data_sheet::parameters::MotorParameters;
use crate::parameters::presets::{DRIVE_FREQUENCY, ROTOR, STATOR_AMPLITUDE, STATOR_SPEED};

/// The second drive frequency (Hz) of the paper's motor (Sec. V B, Fig. 11).
const SECOND_DRIVE_FREQUENCY: f64 = 184e3;

/// Diameter (m) of the rotor, a steel ball.
const BALL_DIAMETER: f64 = 0.02;

/// Density of steel (kg/m^3): a handbook value, not in the paper.
const STEEL_DENSITY: f64 = 7850.0;

/// Table III at a drive frequency.
fn table_iii(drive_frequency: f64) -> Motor {
    MotorParameters {
        drive_frequency,
        amplitude: Some(STATOR_AMPLITUDE),
        peak_angular_speed: Some(STATOR_SPEED),
        mass: Some(STEEL_DENSITY * PI * BALL_DIAMETER * BALL_DIAMETER * BALL_DIAMETER / 6.0),
        contact_radius: ROTOR.contact_radius,
        gyration_radius: Some(ROTOR.gyration_radius),
        preload_acceleration: Some(ROTOR.preload_acceleration),
        friction: ROTOR.friction,
        restitution: ROTOR.restitution,
        ..MotorParameters::EMPTY
    }
    .build()
    .expect("the values of Table III are legal, which a test shows")
}

impl Motor {
    /// The motor of Table III at 70 kHz: its system equals [`System::motor`](crate::System::motor) to the
    /// last bit.
    ///
    /// The paper does not print the mass. The value used here, 33 g, is that of a solid steel ball with the
    /// printed diameter of 20 mm and a handbook density of 7850 kg/m^3. No-load speeds do not depend on the
    /// mass; torques do.
    #[must_use]
    pub fn paper_70_khz() -> Self {
        table_iii(DRIVE_FREQUENCY)
    }

    /// The motor of Table III at its second operating frequency, 184 kHz.
    ///
    /// For this frequency the paper states that the default values of omega Phi and theta were used, and
    /// shows results for amplitudes of 1e-9, 1e-8 and 1e-7 m. The middle amplitude, the default of Table III,
    /// is used here. The true motion of the stator at 184 kHz is not printed. The measured rotor turns the
    /// other way, as it does in the model with a phase lag of pi; the printed default is 0. The mass is that
    /// of [`Self::paper_70_khz`].
    #[must_use]
    pub fn paper_184_khz() -> Self {
        table_iii(SECOND_DRIVE_FREQUENCY)
    }
}
