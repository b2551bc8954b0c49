//! The data of Fig. 2.

use serde::{Deserialize, Serialize};

use crate::figures::hand_path::HandPath;

/// The data of Fig. 2; lengths in units of the contact radius.
#[derive(Debug, Serialize, Deserialize)]
pub struct Fig02Data {
    pub(super) stroke_over_contact_radius: f64,
    pub(super) panels: Vec<Trajectory>,
}

/// One trajectory.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Trajectory {
    pub(super) phase_lag_rad: f64,
    pub(super) amplitude_angle_rad: f64,
    /// Lengths of the path are in units of the contact radius.
    pub(super) path: HandPath,
}
