//! The data of Fig. 5.

use bouncing_disk::InitialSpin;
use serde::{Deserialize, Serialize};

use crate::claims::paper::{SectionThree, TableOne};

/// The data of Fig. 5.
#[derive(Debug, Serialize, Deserialize)]
pub struct Fig05Data {
    pub(super) table_i: TableOne,
    pub(super) printed: SectionThree,
    pub(super) initial_state: InitialSpin,
    pub(super) columns: Vec<Column>,
    /// The toss at the printed optimal φ_L with phase lags about 0.
    pub(super) lags: Vec<Dependence>,
    pub(super) firm_grip: Vec<Grip>,
    pub(super) grid_point: GridPoint,
}

/// The φ_L of panel (c) as a point of the even grid on which the three printed angles lie.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct GridPoint {
    /// ω of Eq. (14), not rounded.
    pub(super) angular_frequency_rad_per_s: f64,
    pub(super) largest_amplitude_angle_rad: f64,
    pub(super) intervals: u32,
    pub(super) index: u32,
    pub(super) amplitude_angle_rad: f64,
}

/// One amplitude ratio.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Column {
    /// φ_L as printed.
    pub(super) printed: String,
    pub(super) amplitude_angle_rad: f64,
    pub(super) amplitude_m: f64,
    /// ωΦ.
    pub(super) largest_hand_speed_rad_per_s: f64,
    /// A ω²/g: the contact force lies between 1 + this, at the lowest point, and 0, at the separation (in m
    /// g).
    pub(super) peak_acceleration: f64,
    /// One per phase lag of the caption.
    pub(super) tosses: Vec<Toss>,
}

/// One toss, from the lowest point of the hand until the dough lands. Time runs from the start, heights from
/// the hand's mean height.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Toss {
    pub(super) phase_lag_rad: f64,
    pub(super) time_s: Vec<f64>,
    pub(super) hand_height_m: Vec<f64>,
    pub(super) dough_height_m: Vec<f64>,
    pub(super) hand_angle_rad: Vec<f64>,
    pub(super) dough_angle_rad: Vec<f64>,
    pub(super) hand_speed_rad_per_s: Vec<f64>,
    pub(super) dough_speed_rad_per_s: Vec<f64>,
    pub(super) separation_time_s: f64,
    pub(super) separation_phase_rad: f64,
    pub(super) landing_time_s: f64,
    /// The highest point of the flight.
    pub(super) apex_height_m: f64,
    pub(super) airborne_speed_rad_per_s: f64,
    pub(super) hand_speed_at_separation_rad_per_s: f64,
    pub(super) largest_hand_speed_rad_per_s: f64,
    /// Hand minus dough at the separation.
    pub(super) slip_at_separation_rad_per_s: f64,
    pub(super) sliding_at_separation: bool,
    /// Share of the time in contact during which the dough slides.
    pub(super) sliding_share_of_contact: f64,
    /// The dough's lowest speed in contact.
    pub(super) lowest_speed_rad_per_s: f64,
    /// What the speed gains in the second half of the time in contact.
    pub(super) late_gain_rad_per_s: f64,
}

/// What a phase lag does to the toss.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Dependence {
    pub(super) phase_lag_rad: f64,
    pub(super) airborne_speed_rad_per_s: f64,
    pub(super) lowest_speed_rad_per_s: f64,
    pub(super) late_gain_rad_per_s: f64,
}

/// The tosses of the three columns at θ_1 with more friction.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Grip {
    pub(super) friction: f64,
    /// 1 minus airborne speed over hand speed at the separation, by column.
    pub(super) missing_share: Vec<f64>,
}
