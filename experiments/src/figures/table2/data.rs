//! The data of Table II.

use serde::{Deserialize, Serialize};

use crate::claims::paper::{SectionThree, TableOne};

/// The data of Table II.
#[derive(Debug, Serialize, Deserialize)]
pub struct Table2Data {
    pub(super) table_i: TableOne,
    pub(super) section: SectionThree,
    pub(super) airborne_speed_rad_per_s: f64,
    pub(super) effects: Vec<Effect>,
    pub(super) combined: Combined,
    /// Effect of c, a_e, a_g, μ and both launch speeds, from which Eq. (14) computes ω and φ_L: the root sum of
    /// squares.
    pub(super) uncertainty_from_launch_speeds_rad_per_s: f64,
}

/// The effect of one input's uncertainty on the airborne speed, in rad/s.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Effect {
    pub(super) input: String,
    /// The entry of the catalogue.
    pub(super) key: String,
    pub(super) unit: String,
    pub(super) value: f64,
    pub(super) uncertainty: f64,
    /// Change of the speed if the input is larger by its uncertainty.
    pub(super) upper_rad_per_s: f64,
    /// Change of the speed if it is smaller.
    pub(super) lower_rad_per_s: f64,
    /// Half the difference of the two.
    pub(super) central_rad_per_s: f64,
    /// Slope times uncertainty.
    pub(super) linear_rad_per_s: f64,
    pub(super) printed_rad_per_s: f64,
    /// The symbol as it is set in print.
    pub(super) label: String,
}

/// The effects of all inputs together, in rad/s, from central effects.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Combined {
    pub(super) root_sum_of_squares_rad_per_s: f64,
    pub(super) sum_rad_per_s: f64,
    pub(super) largest_rad_per_s: f64,
    /// Root sum of squares without the largest.
    pub(super) without_largest_rad_per_s: f64,
}
