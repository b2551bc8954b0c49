//! A motor's steady operation against its load, as data of a figure.

use bouncing_disk::{Estimate, Motor, OperatingPoint, OperatingSettings, Operation};
use serde::{Deserialize, Serialize};

use crate::experiment::ExperimentError;

/// The operating points of one ensemble; a runaway has none.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Curve {
    pub(crate) points: Vec<OperatingPoint>,
    /// How many of them are not known as well as was asked for.
    pub(crate) unsettled: usize,
}

impl Curve {
    /// Of loads that are given as shares of the largest torque of friction, all below one.
    pub(crate) fn of(
        motor: &Motor,
        shares: &[f64],
        settings: &OperatingSettings,
    ) -> Result<Self, ExperimentError> {
        let largest = motor.largest_torque();
        let loads: Vec<f64> = shares.iter().map(|share| share * largest).collect();
        let operations = motor.torque_speed_curve(&loads, settings)?;
        let points = operations.iter().filter_map(Operation::point).copied().collect();
        let unsettled = operations.iter().filter(|operation| operation.steady().is_none()).count();
        Ok(Self { points, unsettled })
    }

    /// Load and power at the top of the least-squares parabola through all points with at least this share of the highest
    /// power; `None` where they have no top.
    pub(crate) fn top(&self, share: f64) -> Option<(f64, f64)> {
        let power = |point: &&OperatingPoint| point.mechanical_power.value;
        let highest = self.points.iter().map(|point| power(&point)).fold(0.0_f64, f64::max);
        let high: Vec<(f64, f64)> = self
            .points
            .iter()
            .filter(|point| power(point) >= share * highest)
            .map(|point| (point.load_torque, point.mechanical_power.value))
            .collect();
        top(&high)
    }
}

/// The highest mechanical power, over ensembles with seeds of their own.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Peak {
    pub(crate) seeds: Vec<u64>,
    pub(crate) load_torque_n_m: Estimate,
    pub(crate) power_w: Estimate,
}

impl Peak {
    /// Of the tops of several curves, at least two.
    pub(crate) fn of(seeds: Vec<u64>, tops: &[(f64, f64)]) -> Option<Self> {
        let load_torque_n_m = mean_of(tops.iter().map(|top| top.0))?;
        let power_w = mean_of(tops.iter().map(|top| top.1))?;
        Some(Self { seeds, load_torque_n_m, power_w })
    }
}

/// The mean of independent numbers and its standard error; `None` for fewer than two.
pub(crate) fn mean_of(values: impl Iterator<Item = f64>) -> Option<Estimate> {
    let values: Vec<f64> = values.collect();
    let count = values.len() as f64;
    if values.len() < 2 {
        return None;
    }
    let value = values.iter().sum::<f64>() / count;
    let squares = values.iter().map(|other| (other - value) * (other - value)).sum::<f64>();
    Some(Estimate { value, standard_error: (squares / (count - 1.0) / count).sqrt() })
}

/// The top of the least-squares parabola through points; `None` for fewer than three or one that opens upwards.
pub(crate) fn top(points: &[(f64, f64)]) -> Option<(f64, f64)> {
    let count = points.len() as f64;
    if points.len() < 3 {
        return None;
    }
    let centre = points.iter().map(|point| point.0).sum::<f64>() / count;
    let width = points.iter().map(|point| (point.0 - centre).abs()).fold(0.0_f64, f64::max);
    // In units of the width the normal equations are well conditioned.
    let (mut s1, mut s2, mut s3, mut s4) = (0.0, 0.0, 0.0, 0.0);
    let (mut y0, mut y1, mut y2) = (0.0, 0.0, 0.0);
    for (x, y) in points {
        let x = (x - centre) / width;
        let square = x * x;
        s1 += x;
        s2 += square;
        s3 += square * x;
        s4 += square * square;
        y0 += y;
        y1 += x * y;
        y2 += square * y;
    }
    // Cramer's rule for the coefficients of 1, x and x².
    let determinant = |a: [f64; 3], b: [f64; 3], c: [f64; 3]| {
        a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
            + a[2] * (b[0] * c[1] - b[1] * c[0])
    };
    let whole = determinant([count, s1, s2], [s1, s2, s3], [s2, s3, s4]);
    let constant = determinant([y0, s1, s2], [y1, s2, s3], [y2, s3, s4]) / whole;
    let slope = determinant([count, y0, s2], [s1, y1, s3], [s2, y2, s4]) / whole;
    let curvature = determinant([count, s1, y0], [s1, s2, y1], [s2, s3, y2]) / whole;
    let x = -0.5 * slope / curvature;
    (curvature < 0.0).then_some((centre + width * x, constant + 0.5 * slope * x))
}

/// Names and values with units of a motor and of how its operation is computed, for the gallery.
pub(crate) fn parameters(motor: &Motor, settings: &OperatingSettings) -> Vec<(String, String)> {
    let sheet = motor.parameters();
    [
        ("ω/2π", format!("{} kHz", 1e-3 * sheet.drive_frequency)),
        ("A", format!("{:e} m", sheet.amplitude)),
        ("ωΦ", format!("{} rad/s", sheet.peak_angular_speed.unwrap_or_default())),
        ("θ", format!("{} rad", sheet.phase_lag)),
        ("μ", sheet.friction.to_string()),
        ("ε", sheet.restitution.to_string()),
        ("g", format!("{} m/s²", motor.preload_acceleration())),
        ("a_e", format!("{} m", sheet.contact_radius)),
        ("m", format!("{:.5} kg", motor.mass())),
        ("moment of inertia", format!("{:.4e} kg m²", motor.inertia())),
        ("members", settings.members.to_string()),
        ("standard error asked for", format!("{} of the speed without load", settings.relative_error)),
        ("relaunch perturbation", format!("{} g/ω", settings.relaunch_perturbation)),
        ("seed", settings.seed.to_string()),
    ]
    .map(|(name, value)| (name.to_owned(), value))
    .into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_top_of_a_parabola_is_found_and_a_valley_has_none() {
        let points: Vec<_> =
            [0.1, 0.17, 0.3, 0.36, 0.5].map(|x: f64| (x, 2.0 - 5.0 * (x - 0.32) * (x - 0.32))).to_vec();
        let (x, y) = top(&points).expect("a top");
        assert!((x - 0.32).abs() < 1e-13 && (y - 2.0).abs() < 1e-13, "{x} {y}");
        let valley: Vec<_> = points.iter().map(|(x, y)| (*x, -y)).collect();
        assert_eq!(top(&valley), None);
        assert_eq!(top(&points[..2]), None);
    }

    #[test]
    fn a_mean_has_the_error_of_a_mean() {
        let mean = mean_of([1.0, 2.0, 3.0, 4.0].into_iter()).expect("four numbers");
        assert!((mean.value - 2.5).abs() < 1e-15);
        assert!((mean.standard_error - (5.0_f64 / 12.0).sqrt()).abs() < 1e-15);
        assert_eq!(mean_of([1.0].into_iter()), None);
    }
}
