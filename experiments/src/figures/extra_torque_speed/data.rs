//! The data of the figure.

use bouncing_disk::{Estimate, IntervalEstimate, Motor, OperatingSettings};
use serde::{Deserialize, Serialize};

use crate::figures::operating_curve::{Curve, Peak};
use crate::figures::stall::Stall;

/// The data of the torque-speed figure.
#[derive(Debug, Serialize, Deserialize)]
pub struct ExtraTorqueSpeedData {
    pub(super) motor: Motor,
    pub(super) settings: OperatingSettings,
    /// μ m g a_e: no load above it is held.
    pub(super) largest_torque_n_m: f64,
    pub(super) curve: Curve,
    /// Loads above the largest torque that were tried, and whether the motor runs away under them.
    pub(super) overloads: Vec<Overload>,
    pub(super) stall: TrueStall,
    /// The highest power of ensembles with other seeds.
    pub(super) peaks: Peak,
    /// The highest power on the drawn curve.
    pub(super) drawn_peak: DrawnPeak,
    pub(super) transient: Transient,
    /// The stall load and the paper's estimate of it by other means: impulses alone, and transients fitted one by one.
    pub(super) by_impulses: Stall,
}

/// A load above the largest torque.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub(super) struct Overload {
    pub(super) load_torque_n_m: f64,
    pub(super) runs_away: bool,
}

/// The load that stops the motor.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub(super) struct TrueStall {
    pub(super) torque_n_m: Estimate,
    pub(super) share: f64,
    pub(super) bracket_n_m: [f64; 2],
    /// Speeds at both ends of the bracket, of an ensemble with another seed.
    pub(super) speeds_at_bracket_rad_per_s: [Estimate; 2],
    pub(super) other_seed: u64,
}

/// The highest power on the drawn curve.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub(super) struct DrawnPeak {
    pub(super) load_torque_n_m: f64,
    pub(super) power_w: f64,
    /// Of the power at the load nearest to it.
    pub(super) standard_error_w: f64,
}

/// The fit of the mean transient without load.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub(super) struct Transient {
    pub(super) members: usize,
    pub(super) duration_s: f64,
    /// That of the exponential.
    pub(super) steady_speed_rad_per_s: IntervalEstimate,
    /// The mean over the last part of all members, without any form of the rise.
    pub(super) settled_speed_rad_per_s: Estimate,
    /// α̇_ss/t_c times the moment of inertia.
    pub(super) stall_estimate_n_m: IntervalEstimate,
}
