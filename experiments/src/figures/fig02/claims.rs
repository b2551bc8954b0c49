//! What the paper says about Fig. 2, compared with the data.

use std::f64::consts::PI;

use bouncing_disk::core::elementary::tan;

use super::data::Fig02Data;
use crate::claim::Claim;

/// Quantities that should vanish or agree do so within this share: a hundred roundings.
const ROUNDING: f64 = 100.0 * f64::EPSILON;

/// An angle as a multiple of π.
pub(super) fn pi(angle: f64) -> String {
    format!("{:.2}π", angle / PI)
}

pub(super) fn claims(data: &Fig02Data) -> Vec<Claim> {
    let panels = &data.panels;
    let ratio_fault = panels
        .iter()
        .map(|panel| {
            let ratio = panel.twist_amplitude_rad / panel.amplitude_over_contact_radius;
            (ratio / tan(panel.amplitude_angle_rad) - 1.0).abs()
        })
        .fold(0.0, f64::max);
    let ratios: Vec<_> = panels
        .iter()
        .map(|panel| format!("{}: {:.3}", pi(panel.amplitude_angle_rad), tan(panel.amplitude_angle_rad)))
        .collect();
    let shapes: Vec<_> = panels
        .iter()
        .map(|panel| {
            format!(
                "θ = {}, φ_L = {}: {:.4}, {:.4} a_e²",
                pi(panel.phase_lag_rad),
                pi(panel.amplitude_angle_rad),
                panel.axis_ratio,
                panel.enclosed_area.abs()
            )
        })
        .collect();
    let family = match &panels[..] {
        [ellipse, semi, line, low, middle, high] => Some(
            line.axis_ratio <= ROUNDING
                && line.enclosed_area.abs() <= ROUNDING
                && semi.axis_ratio > line.axis_ratio
                && ellipse.axis_ratio > semi.axis_ratio
                && low.axis_ratio > 0.0
                && middle.axis_ratio > low.axis_ratio
                && high.axis_ratio > 0.0
                && middle.axis_ratio > high.axis_ratio,
        ),
        _ => None,
    };
    vec![
        Claim::printed_statement(
            "section1.amplitude_ratio",
            (!panels.is_empty()).then_some(ratio_fault <= ROUNDING),
            format!(
                "L at the six φ_L: {}; largest relative difference of a_e Φ/A from tan φ_L: {ratio_fault:.1e}",
                ratios.join(", ")
            ),
        ),
        Claim::printed_statement(
            "section1.family_of_motions",
            family,
            format!(
                "minor over major axis and enclosed area of the ellipse on the unrolled cylinder: {}. The curve of θ = 0 \
                 encloses nothing, an ellipse is widest at θ = −π/2, the semielliptical curves lie between",
                shapes.join("; ")
            ),
        ),
    ]
}
