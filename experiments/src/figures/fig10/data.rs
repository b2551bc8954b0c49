//! The numbers of Fig. 10.

use bouncing_disk::estimate::{ExponentialFit, Spread};
use serde::Serialize;

use crate::claims::Cases;
use crate::figures::shared::alike::{AlikeMotor, SpeedBand};
use crate::figures::shared::motor::{Cycle, MotorCase, MotorStatistics, RobustCycle};

/// The data of Fig. 10.
#[derive(Debug, Serialize)]
pub(crate) struct Fig10Data {
    pub(super) motor: MotorCase,
    pub(super) members: usize,
    pub(super) relaunch_perturbation: f64,
    /// With standard gravity, and as printed.
    pub(super) readings: Vec<Reading>,
    /// The motor of the smallest amplitude at exactly the printed 9.8 m/s².
    pub(super) exception: Exception,
    /// Many motors that print alike, for the verdicts.
    pub(super) alike: Alike,
    pub(super) perturbations: Vec<PerturbationEffect>,
    pub(super) own_motor_axial_forcing: f64,
    pub(super) tsujino_axial_forcing: f64,
    pub(super) tsujino_peak_acceleration: f64,
}

/// One reading of Table III.
#[derive(Debug, Serialize)]
pub(super) struct Reading {
    pub(super) preload_acceleration_m_per_s2: f64,
    pub(super) duration_s: f64,
    pub(super) panels: Vec<Transient>,
}

/// One amplitude: a member with its fit, and the ensemble.
#[derive(Debug, Serialize)]
pub(super) struct Transient {
    pub(super) amplitude_m: f64,
    pub(super) axial_forcing: f64,
    pub(super) member_time_s: Vec<f64>,
    pub(super) member_speed_rad_per_s: Vec<f64>,
    pub(super) member_fit: ExponentialFit,
    pub(super) band_time_s: Vec<f64>,
    pub(super) band_low_rad_per_s: Vec<f64>,
    pub(super) band_high_rad_per_s: Vec<f64>,
    pub(super) steady_speed_rad_per_s: Spread,
    pub(super) time_constant_s: Spread,
    /// Root mean square of member minus exponential fit, over the steady speed; mean over the ensemble.
    pub(super) relative_exponential_residual: f64,
    /// The same for the fit of a linear rise to a constant speed.
    pub(super) relative_ramp_residual: f64,
    /// Standard deviation of the speed from its straight line in the second half, as a share of ωΦ; mean over
    /// the ensemble.
    pub(super) oscillation: f64,
    /// The motion that the unperturbed motor repeats.
    pub(super) cycle: Cycle,
    pub(super) impacts_per_s: f64,
}

/// The robust low-period cycle at A = 1 nm and exactly g = 9.8 m/s², and how narrow it is.
#[derive(Debug, Serialize)]
pub(super) struct Exception {
    pub(super) amplitude_m: f64,
    pub(super) preload_acceleration_m_per_s2: f64,
    /// Aω²/g over 2π².
    pub(super) peak_acceleration_over_two_pi_squared: f64,
    pub(super) robust_cycle: RobustCycle,
    /// The preload accelerations, next to the printed one, between which the motor repeats this cycle.
    pub(super) lowest_preload_acceleration_m_per_s2: f64,
    pub(super) highest_preload_acceleration_m_per_s2: f64,
    /// The width of this range, over the printed g.
    pub(super) relative_width: f64,
    /// The transient there.
    pub(super) time_s: Vec<f64>,
    pub(super) speed_rad_per_s: Vec<f64>,
}

/// The growth of a small perturbation of a motor's vertical motion between two rests.
#[derive(Debug, Serialize)]
pub(super) struct BetweenRests {
    pub(super) amplitude_m: f64,
    /// How many motors it grows in for certain, by the measure of a chaotic attractor.
    pub(super) grows: Cases,
    /// Medians over these motors: impacts from the separation to the next rest, and mean logarithmic growth
    /// per impact.
    pub(super) impacts: Option<f64>,
    pub(super) growth_per_impact: Option<f64>,
}

/// Motors whose inputs all print like the paper's: the same draws at the three amplitudes.
#[derive(Debug, Serialize)]
pub(super) struct Alike {
    /// The ranges drawn from.
    pub(super) inputs: String,
    /// By amplitude, then by draw.
    pub(super) motors: [Vec<AlikeMotor>; 3],
    /// The middle nine tenths of their speeds, by amplitude.
    pub(super) bands: [SpeedBand; 3],
    pub(super) between_rests: [BetweenRests; 3],
}

impl Alike {
    /// The three motors of each draw.
    pub(super) fn draws(&self) -> impl Iterator<Item = [&AlikeMotor; 3]> {
        let [small, middle, large] = &self.motors;
        small.iter().zip(middle).zip(large).map(|((small, middle), large)| [small, middle, large])
    }
}

/// Steady speed and stall acceleration for one size of the relaunch perturbation.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub(super) struct PerturbationEffect {
    /// In units of g/ω.
    pub(super) relaunch_perturbation: f64,
    pub(super) statistics: MotorStatistics,
}
