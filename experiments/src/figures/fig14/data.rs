//! The data of Fig. 14.

use serde::{Deserialize, Serialize};

use crate::figures::dough_record::Growth;

/// The printed line, what follows from it, and the estimator on synthetic diameters.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Fig14Data {
    /// Time of the start of the line (s), the end of the second toss.
    pub start_s: f64,
    /// Slope of d/d_0 (1/s).
    pub slope_per_s: f64,
    /// Growth between the first and the last toss, as a share.
    pub growth: f64,
    /// Duration of that growth on the printed line (s).
    pub duration_s: f64,
    /// The growth taken from the start of the first toss to the start of the last: number of tosses.
    pub tosses_between: u32,
    /// The growth taken from the start of the first toss to the end of the last: number of tosses.
    pub tosses_inclusive: u32,
    /// Growth per toss by the first of both readings, in per cent.
    pub growth_per_toss_percent: f64,
    /// By the second.
    pub growth_per_toss_inclusive_percent: f64,
    /// Number and start (s) of each toss, evenly spaced, by the first of both readings.
    pub toss_start_s: Vec<(u32, f64)>,
    /// Synthetic diameters, not measured: times (s) and d/d_0.
    pub synthetic: Vec<(f64, f64)>,
    /// Slope (1/s) of the least-squares line through them over its value at the start, and its standard
    /// error.
    pub synthetic_slope_per_s: f64,
    /// Standard error of that slope (1/s).
    pub synthetic_slope_error_per_s: f64,
    /// Change of the airborne speed of Table I's toss if the dough is larger, in all its radii, by the growth
    /// of one toss (rad/s).
    pub airborne_speed_change_rad_per_s: f64,
    /// Share of its rotation, in per cent, that a dough loses which grows so much while it flies: its angular
    /// momentum does not change.
    pub flight_spin_loss_percent: f64,
    /// A user's own diameters.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub measured: Option<Growth>,
}

impl Fig14Data {
    pub(super) fn on_line(&self, time: f64) -> f64 {
        1.0 + self.slope_per_s * (time - self.start_s)
    }
}
