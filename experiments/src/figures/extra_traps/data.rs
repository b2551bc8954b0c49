//! The data of the figure.

use bouncing_disk::Motor;
use serde::{Deserialize, Serialize};

/// The data of the maps of traps.
#[derive(Debug, Serialize, Deserialize)]
pub struct ExtraTrapsData {
    /// The motor whose preload is changed.
    pub(super) motor: Motor,
    /// Integer parts of Γ of the rows, and fractions of the columns.
    pub(super) whole_forcings: Vec<u32>,
    pub(super) forcing_fractions: Vec<f64>,
    pub(super) by_fraction: Map,
    /// Γ of the columns and restitutions of the rows.
    pub(super) axial_forcings: Vec<f64>,
    pub(super) restitutions: Vec<f64>,
    pub(super) by_restitution: Map,
    pub(super) single_flight: Option<SingleFlight>,
    pub(super) checked: Checked,
    /// Preloads of Fig. 11 (m/s²) and the share of them that is trapped, at each amplitude (m).
    pub(super) share_of_fig11: Vec<TrappedShare>,
}

/// What the motors of a grid do, row by row.
#[derive(Debug, Default, Serialize, Deserialize)]
pub(super) struct Map {
    /// Long flights of the unperturbed cycle; 0 where it is not short.
    pub(super) long_flights: Vec<Vec<usize>>,
    /// Whether the perturbed motor repeats it.
    pub(super) is_trap: Vec<Vec<bool>>,
}

impl Map {
    /// The share of the motors that is trapped.
    pub(super) fn trapped_share(&self) -> f64 {
        let all = self.is_trap.iter().flatten();
        all.clone().filter(|is_trap| **is_trap).count() as f64 / all.count() as f64
    }
}

/// Fractions of Γ of the traps of a single flight.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub(super) struct SingleFlight {
    /// Rows with such traps.
    pub(super) rows: usize,
    pub(super) least_fraction: f64,
    pub(super) most_fraction: f64,
    /// The middle of those in the last row.
    pub(super) last_middle: f64,
    /// Half of what they cover there.
    pub(super) last_half_width: f64,
}

/// Motors whose regime was found in another way.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub(super) struct Checked {
    pub(super) motors: usize,
    pub(super) trapped: usize,
    pub(super) agreeing: usize,
}

/// How many of the preloads of a range are trapped.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub(super) struct TrappedShare {
    pub(super) amplitude_m: f64,
    pub(super) preloads_m_per_s2: [f64; 2],
    pub(super) forcings: [f64; 2],
    pub(super) motors: usize,
    pub(super) trapped: usize,
}

impl ExtraTrapsData {
    pub(super) fn caption(&self) -> String {
        let [from, to] = [self.whole_forcings.first(), self.whole_forcings.last()]
            .map(|end| end.copied().unwrap_or_default());
        let shares: Vec<String> = self
            .share_of_fig11
            .iter()
            .map(|share| {
                format!(
                    "{:.1} % at A = {:e} m",
                    100.0 * share.trapped as f64 / share.motors as f64,
                    share.amplitude_m
                )
            })
            .collect();
        format!(
            "Preloads that trap a motor in a short cycle of flights and rest. (a) The restitution of Table III, {}: the integer part of \
             Γ = Aω²/(πg), {from} to {to}, against its fraction. (b) Γ against the restitution. Full colours: the cycle survives the \
             perturbation of its relaunches, and the motor has the speed of the cycle; pale: the unperturbed motor has a cycle of so many flights \
             longer than half a period, which the perturbation ends; white: its cycle is longer. The preload enters by Γ alone: of the preloads \
             of Fig. 11, {} are trapped.",
            self.motor.parameters().restitution,
            shares.join(", "),
        )
    }

    pub(super) fn parameters(&self) -> Vec<(String, String)> {
        [
            ("ε of (a)", self.motor.parameters().restitution.to_string()),
            ("motors", format!("{} by {}", self.forcing_fractions.len(), self.whole_forcings.len())),
            ("relaunch perturbation", "1e-3 g/ω".to_owned()),
            ("relaunches", "64".to_owned()),
        ]
        .map(|(name, value)| (name.to_owned(), value))
        .into()
    }
}
