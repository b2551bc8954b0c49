//! The data of Fig. 9.

use bouncing_disk::Spread;
use serde::{Deserialize, Serialize};

use crate::figures::braking_record::Deceleration;
use crate::figures::motor_case::MotorCase;

/// Braking curves of the model, a synthetic record, and a user's own measurements.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Fig09Data {
    pub(super) case: MotorCase,
    pub(super) rotor_mass_kg: f64,
    /// The rotor's speed as the motor is switched off (rad/s): ωΦ, the most it can have.
    pub(super) first_speed_rad_per_s: f64,
    pub(super) curves: Vec<Curve>,
    pub(super) printed_mean: f64,
    pub(super) printed_deviation: f64,
    /// Synthetic, not measured: preload (N) and μ.
    pub(super) synthetic: Vec<(f64, f64)>,
    pub(super) synthetic_spread: Spread,
    /// Slope of the synthetic μ against preload (1/N) and its standard error.
    pub(super) synthetic_slope_per_n: f64,
    pub(super) synthetic_slope_error_per_n: f64,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(super) measured_decelerations: Vec<Deceleration>,
    /// Preload (N) and μ.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(super) measured_frictions: Vec<(f64, f64)>,
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub(super) measured_words: String,
}

/// A braking curve and its straight line.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Curve {
    pub(super) preload_n: f64,
    pub(super) time_s: Vec<f64>,
    pub(super) angular_speed_rad_per_s: Vec<f64>,
    /// Slope of the line (rad/s²) and the time (s) at which it reaches 0.
    pub(super) brake_rad_per_s2: f64,
    pub(super) stop_s: f64,
    /// μ by Eq. (17).
    pub(super) friction: f64,
}
