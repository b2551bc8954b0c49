//! The data of Fig. 8.

use serde::{Deserialize, Serialize};

use crate::claims::paper::TableThree;

/// The data of Fig. 8.
#[derive(Debug, Serialize, Deserialize)]
pub struct Fig08Data {
    pub(super) table_iii: TableThree,
    pub(super) ball_diameter_mm: f64,
    pub(super) steel_density_kg_per_m3: f64,
    pub(super) steel_densities_kg_per_m3: [f64; 2],
    pub(super) gravity_m_per_s2: f64,
    pub(super) ball_mass_kg: f64,
    pub(super) ball_weight_n: f64,
    /// For the two ends of the range of densities.
    pub(super) ball_weights_n: [f64; 2],
    /// sqrt(2/5) of the radius: a homogeneous sphere.
    pub(super) gyration_radius_mm: f64,
    /// Between the axis and the normal of the ball where it touches the stator.
    pub(super) contact_angle_rad: f64,
    /// How far the ball reaches into the circle of contact.
    pub(super) contact_depth_mm: f64,
    pub(super) preloads_n: [f64; 2],
    /// Preload over mass.
    pub(super) preload_accelerations_m_per_s2: [f64; 2],
    pub(super) preload_acceleration_range_m_per_s2: [f64; 2],
}
