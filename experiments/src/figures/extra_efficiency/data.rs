//! The data of the figure.

use std::f64::consts::PI;

use bouncing_disk::{Estimate, Motor, OperatingSettings};
use serde::{Deserialize, Serialize};

use crate::figures::operating_curve::{self, Curve};

/// The data of the efficiency map.
#[derive(Debug, Serialize, Deserialize)]
pub struct ExtraEfficiencyData {
    pub(super) motor: Motor,
    pub(super) settings: OperatingSettings,
    /// Phase lags of the columns (rad).
    pub(super) phase_lags_rad: Vec<f64>,
    /// Loads of the rows, as shares of the largest torque μ m g a_e.
    pub(super) load_shares: Vec<f64>,
    /// Mechanical power over the power put in, row by row: negative where the load drives the motor back. `None` where no
    /// power is put in.
    pub(super) power_ratios: Vec<Vec<Option<f64>>>,
    pub(super) speeds_rad_per_s: Vec<Vec<Option<f64>>>,
    /// Motors that are not known as well as was asked for.
    pub(super) unsettled: usize,
    /// The largest rest of the energy balance, relative.
    pub(super) largest_energy_residual: f64,
    pub(super) best: Best,
    /// Along the loads, at the best lag.
    pub(super) along_load: Curve,
    /// Speeds without load at the sampled lags, and at those half a circle away.
    pub(super) mirrored: Vec<[Estimate; 2]>,
}

/// The best cell of the map.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub(super) struct Best {
    pub(super) phase_lag_rad: f64,
    pub(super) load_share: f64,
    pub(super) efficiency: Estimate,
    /// Of an ensemble with another seed.
    pub(super) again: Estimate,
    pub(super) other_seed: u64,
}

impl ExtraEfficiencyData {
    pub(super) fn caption(&self) -> String {
        let best = &self.best;
        format!(
            "Efficiency of the motor of Table III at 70 kHz: mechanical power over the power that the stator puts in. (a) Over \
             load torque and phase lag, {} by {} motors on one vertical motion of {} perturbed members; colours between them are \
             interpolated. Below the black line, on which the mean speed is zero, the motor turns forwards; above it (grey) the \
             load drives it back. Circle: the best motor of the map, {:.2} ± {:.2} % at θ = {:.3}π and {:.3} μ m g a_e. Dotted: the \
             printed lag. (b) Where the energy goes at the best lag, as shares of what is put in, up to stall.",
            self.phase_lags_rad.len(),
            self.load_shares.len(),
            self.settings.members,
            100.0 * best.efficiency.value,
            100.0 * best.efficiency.standard_error,
            best.phase_lag_rad / PI,
            best.load_share,
        )
    }

    pub(super) fn parameters(&self) -> Vec<(String, String)> {
        operating_curve::parameters(&self.motor, &self.settings)
    }
}
