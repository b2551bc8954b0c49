//! The data of Table III.

use serde::{Deserialize, Serialize};

use crate::claims::Cases;
use crate::figures::stall::Stall;
use crate::figures::uncertainty::Propagated;
use crate::claims::paper::BallDrop;

/// The data of Table III.
#[derive(Debug, Serialize, Deserialize)]
pub struct Table3Data {
    pub(super) inputs: Vec<Input>,
    /// How many of the inputs the table prints.
    pub(super) printed_inputs: usize,
    pub(super) printed_preload_acceleration_m_per_s2: f64,
    pub(super) frequency_khz: f64,
    pub(super) gravity_m_per_s2: f64,
    /// Preload of the rotor, a steel ball, for the two readings of g.
    pub(super) preloads_n: [f64; 2],
    /// Range of preloads in the experiments, as accelerations.
    pub(super) varied_m_per_s2: [f64; 2],
    pub(super) derived: Vec<Following>,
    /// The load that stalls the motor, for the two readings.
    pub(super) stalls: [Stall; 2],
    /// The speed without load, and how far it and that load lie apart over the tolerances of the inputs.
    pub(super) speeds: [Speed; 2],
    pub(super) drop: Drop,
    /// a_g of a solid ball of the rotor's diameter.
    pub(super) ball_gyration_radius_mm: f64,
}

/// The steady speed of a motor without load, and what the tolerances of its inputs make of it and of the stall load.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub(super) struct Speed {
    pub(super) speed_rad_per_s: f64,
    pub(super) standard_error_rad_per_s: f64,
    pub(super) over_inputs_rad_per_s: OverInputs,
    pub(super) stall_over_inputs_rad_per_s2: OverInputs,
}

/// A number of motors that are drawn: preload and amplitude within a tolerance, the relaunch perturbation within a decade.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub(super) struct OverInputs {
    pub(super) tolerance: f64,
    pub(super) mean: f64,
    pub(super) deviation: f64,
    /// The least and the largest.
    pub(super) from_to: [f64; 2],
    pub(super) draws: usize,
    pub(super) trapped: usize,
}

impl OverInputs {
    pub(super) fn words(&self) -> String {
        format!(
            "{:.2} to {:.2}, mean {:.2}, over {} motors whose preload and amplitude lie within {} %, {} of them in a trap",
            self.from_to[0],
            self.from_to[1],
            self.mean,
            self.draws,
            100.0 * self.tolerance,
            self.trapped
        )
    }
}

/// An input of a simulation, for both readings.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Input {
    pub(super) symbol: String,
    /// The symbol as it is set in print.
    pub(super) label: String,
    pub(super) unit: String,
    /// As printed; empty if the table does not print it.
    pub(super) printed: String,
    /// "Accurately known" by Sec. V A; the others are estimated.
    pub(super) known: bool,
    pub(super) values: [f64; 2],
}

/// A quantity that follows from the inputs, for both readings.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Following {
    pub(super) symbol: String,
    pub(super) label: String,
    pub(super) unit: String,
    pub(super) values: [f64; 2],
    pub(super) origin: String,
}

/// The drop of the steel ball.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Drop {
    pub(super) heights: BallDrop,
    pub(super) restitution: Propagated,
    /// The least and the largest ε of heights that round to the printed ones.
    pub(super) restitution_range: [f64; 2],
    /// Of these heights, drawn evenly, those whose ε rounds to the printed one.
    pub(super) restitution_agreement: Cases,
    pub(super) impact_speed_m_per_s: f64,
    /// For the heights that are printed as the drop height.
    pub(super) impact_speed_range_m_per_s: [f64; 2],
    /// The heights that give the printed speed, as rounded.
    pub(super) heights_of_printed_speed_m: [f64; 2],
    /// v²/(2 h) of the printed speed and height, and for everything that rounds to them.
    pub(super) gravity_of_printed_speed_m_per_s2: f64,
    pub(super) gravity_range_of_printed_speed_m_per_s2: [f64; 2],
    /// What rounds to the printed gravity, up to the highest g of Sec. V B: no g is printed for the drop.
    pub(super) printed_gravity_range_m_per_s2: [f64; 2],
    /// Of the heights that round to the printed one and of these g, drawn evenly, those that give the printed speed.
    pub(super) agreement: Cases,
    /// The highest g of Sec. V B, and the impact speed with it.
    pub(super) highest_varied_m_per_s2: f64,
    pub(super) impact_speed_at_highest_m_per_s: f64,
}
