//! What the paper says about Fig. 9, compared with the data.

use super::data::{Curve, Fig09Data};
use crate::claim::{Claim, all};

const ROUNDING: f64 = 1e-10;

pub(super) fn claims(data: &Fig09Data) -> Vec<Claim> {
    let expected = |curve: &Curve| {
        let case = &data.case;
        -case.friction * case.contact_radius_m * curve.preload_n
            / (data.rotor_mass_kg * case.gyration_radius_m * case.gyration_radius_m)
    };
    let largest = |of: &dyn Fn(&Curve) -> f64| data.curves.iter().map(of).fold(0.0, f64::max);
    let slope = |curve: &Curve| (curve.brake_rad_per_s2 / expected(curve) - 1.0).abs();
    let off = |curve: &Curve| (curve.friction / data.case.friction - 1.0).abs();
    let ratio = |reference: f64| reference / data.printed_mean;
    vec![
        Claim::printed_statement(
            "section5.braking",
            all(&data.curves, |curve| slope(curve) <= ROUNDING && curve.residual <= ROUNDING),
            format!(
                "at {} preloads the slope is off by at most {:.1e} of μ a_e N/(m a_g²), and the curve from its line \
                 by {:.1e} of the first speed",
                data.curves.len(),
                largest(&slope),
                largest(&|curve| curve.residual)
            ),
        ),
        Claim::printed_statement(
            "section5.reference_friction_is_threefold",
            (ratio(data.lowest_reference) - 3.0).abs() < 0.5,
            format!(
                "{:.1} to {:.1} times the printed mean",
                ratio(data.lowest_reference),
                ratio(data.highest_reference)
            ),
        ),
        Claim::printed_statement(
            "section5.brake_estimator",
            all(&data.curves, |curve| off(curve) <= ROUNDING),
            format!(
                "the model's own μ = {} is recovered at every preload, off by at most {:.1e} of it",
                data.case.friction,
                largest(&off)
            ),
        ),
    ]
}
