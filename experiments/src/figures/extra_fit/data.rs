//! The data of the figure.

use bouncing_disk::{FitSettings, IntervalEstimate, TransientFit};
use serde::{Deserialize, Serialize};

/// The data of the fits of synthetic transients.
#[derive(Debug, Serialize, Deserialize)]
pub struct ExtraFitData {
    /// Of the synthetic transients.
    pub(super) steady_speed_rad_per_s: f64,
    pub(super) time_constant_s: f64,
    /// Standard deviation of the members' steady speeds, relative.
    pub(super) member_scatter: f64,
    /// Standard deviation of the noise (rad/s), and its correlation from point to point.
    pub(super) noise_rad_per_s: f64,
    pub(super) noise_memory: f64,
    pub(super) members: usize,
    pub(super) points_per_time_constant: u32,
    pub(super) settings: FitSettings,
    pub(super) times_s: Vec<f64>,
    /// Synthetic members, rows.
    pub(super) members_rad_per_s: Vec<Vec<f64>>,
    pub(super) mean_rad_per_s: Vec<f64>,
    pub(super) fit: TransientFit,
    pub(super) exponential_rad_per_s: Vec<f64>,
    pub(super) ramp_rad_per_s: Option<Vec<f64>>,
    pub(super) durations: Vec<Duration>,
}

/// What a duration allows.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Duration {
    /// In time constants.
    pub(super) time_constants: f64,
    /// The time constant from the transients of the figure, cut there; `None` where the fit is refused.
    pub(super) time_constant_s: Option<IntervalEstimate>,
    pub(super) steady_speed_rad_per_s: Option<IntervalEstimate>,
    /// Why it is refused.
    pub(super) refusal: Option<String>,
    /// Further synthetic ensembles: tried, accepted, and of these the intervals that cover the truth.
    pub(super) tried: usize,
    pub(super) accepted: usize,
    pub(super) constants_covered: usize,
    pub(super) speeds_covered: usize,
}

impl ExtraFitData {
    pub(super) fn caption(&self) -> String {
        format!(
            "Fits of synthetic transients, made from a steady speed of {} rad/s and a time constant of {} s with {} members, whose steady \
             speeds scatter by {} %, and correlated noise of {} rad/s. (a) Members (grey), their mean (dots), and the exponential (solid) and \
             the ramp (dashed) fitted to it. (b) The time constant with its 95 % interval from the same members, cut after so many time \
             constants; crosses: durations at which the fit is refused. (c) Of {} such ensembles, the share whose interval covers the \
             time constant (dots) and the steady speed (squares) if the fit is accepted, and the share that is refused (bars). Dashed: the truth \
             in (b), 95 % in (c).",
            self.steady_speed_rad_per_s,
            self.time_constant_s,
            self.members,
            100.0 * self.member_scatter,
            self.noise_rad_per_s,
            self.durations.first().map_or(0, |duration| duration.tried),
        )
    }

    pub(super) fn parameters(&self) -> Vec<(String, String)> {
        [
            ("steady speed", format!("{} rad/s", self.steady_speed_rad_per_s)),
            ("time constant", format!("{} s", self.time_constant_s)),
            ("members", self.members.to_string()),
            ("points in a time constant", self.points_per_time_constant.to_string()),
            ("correlation of the noise", self.noise_memory.to_string()),
            ("resampled curves", self.settings.resamples.to_string()),
            ("fewest time constants", self.settings.least_duration.to_string()),
        ]
        .map(|(name, value)| (name.to_owned(), value))
        .into()
    }
}
