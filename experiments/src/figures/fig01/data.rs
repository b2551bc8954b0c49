//! The data of Fig. 1.

use serde::{Deserialize, Serialize};

use crate::figures::hand_path::HandPath;
use crate::claims::paper::TableOne;

/// The data of Fig. 1: the toss of Table I with another phase lag, and one instant of it.
#[derive(Debug, Serialize, Deserialize)]
pub struct Fig01Data {
    pub(super) table_i: TableOne,
    pub(super) phase_lag_rad: f64,
    pub(super) contact_radius_m: f64,
    /// The radius of a uniform disk with Table I's radius of gyration.
    pub(super) disk_radius_m: f64,
    pub(super) amplitude_m: f64,
    pub(super) twist_amplitude_rad: f64,
    pub(super) phase_rad: f64,
    pub(super) platform_height_m: f64,
    pub(super) platform_angle_rad: f64,
    pub(super) disk_height_m: f64,
    pub(super) disk_angle_rad: f64,
    pub(super) path: HandPath,
}
