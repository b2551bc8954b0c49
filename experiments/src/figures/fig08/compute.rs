//! The computation of Fig. 8.

use bouncing_disk::core::numerics::elementary::asin;

use super::data::Fig08Data;
use crate::experiment::ExperimentError;
use crate::paper::{self, STEEL_DENSITY};
use crate::progress::Progress;

/// Carbon and stainless steels lie between these densities (kg/m³; handbook values, not in the paper).
const STEEL_DENSITIES: [f64; 2] = [7700.0, 8000.0];

pub(super) fn compute(progress: &dyn Progress) -> Result<Fig08Data, ExperimentError> {
    progress.start(1, "checks");
    let table_iii = paper::table_three()?;
    let section = paper::section_five()?;
    let preloads = paper::preloads()?;
    let gravity = section.gravity_m_per_s2;
    let mass = section.rotor_mass_kg();
    let radius_mm = 500.0 * section.rotor_diameter_m;
    let volume_m3 = mass / STEEL_DENSITY;
    let contact = table_iii.contact_radius_mm;
    progress.advance(1);
    Ok(Fig08Data {
        ball_diameter_mm: 2.0 * radius_mm,
        steel_density_kg_per_m3: STEEL_DENSITY,
        steel_densities_kg_per_m3: STEEL_DENSITIES,
        gravity_m_per_s2: gravity,
        ball_mass_kg: mass,
        ball_weight_n: gravity * mass,
        ball_weights_n: STEEL_DENSITIES.map(|density| gravity * density * volume_m3),
        gyration_radius_mm: 0.4_f64.sqrt() * radius_mm,
        contact_angle_rad: asin(contact / radius_mm),
        contact_depth_mm: radius_mm - (radius_mm * radius_mm - contact * contact).sqrt(),
        preloads_n: preloads.measured_range_n,
        preload_accelerations_m_per_s2: preloads.measured_range_n.map(|preload| preload / mass),
        preload_acceleration_range_m_per_s2: preloads.preload_accelerations_m_per_s2,
        table_iii,
    })
}
