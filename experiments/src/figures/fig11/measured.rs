//! A user's steady speeds and stall torques over the curves of Fig. 11.

use bouncing_disk::core::numerics::elementary::ln;

use super::data::{Fig11Data, MeasuredExponent, MeasuredMotor, MeasuredMotors};
use crate::experiment::ExperimentError;
use crate::figures::regression::StraightLine;
use crate::measured::{Column, Layout, Range, Series};

/// The file.
pub(super) const LAYOUT: Layout = Layout {
    file: "fig11.csv",
    columns: &[
        Column::value("frequency_hz", Range::Positive),
        Column::value("preload_n", Range::Positive),
        Column::value("steady_speed_rad_per_s", Range::Signed),
        Column::value("stall_torque_n_m", Range::Positive),
    ],
    least_rows: 1,
};

/// A measured frequency that differs by less than this share from that of a panel belongs there: a motor's resonance
/// moves by a few percent.
const SAME_FREQUENCY_WITHIN: f64 = 0.05;

/// Sorts the points into the panels and fits the stall torques of each within the preloads of the trends, as those of
/// the model are.
pub(super) fn read(data: &Fig11Data, series: &Series) -> Result<MeasuredMotors, ExperimentError> {
    let frequencies = data.printed.frequencies_hz;
    let mut points = Vec::new();
    for (row, [frequency_hz, preload_n, speed, torque]) in series.rows::<4>().enumerate() {
        let near = |panel: &f64| (frequency_hz - panel).abs() <= SAME_FREQUENCY_WITHIN * panel;
        let panel_frequency_hz = frequencies.into_iter().find(near).ok_or_else(|| {
            let legal = frequencies.map(|frequency| frequency.to_string()).join(" or ");
            series.illegal(row, 0, format!("within {} % of {legal}", 100.0 * SAME_FREQUENCY_WITHIN))
        })?;
        points.push(MeasuredMotor {
            panel_frequency_hz,
            frequency_hz,
            preload_mn: 1e3 * preload_n,
            steady_speed_rad_per_s: speed,
            stall_torque_n_m: torque,
            stall_acceleration_rad_per_s2: torque / data.moment_of_inertia(),
        });
    }
    let [from, to] = data.trend_mn();
    let exponents = frequencies.into_iter().filter_map(|panel_frequency_hz| {
        let logarithms: Vec<(f64, f64)> = points
            .iter()
            .filter(|point| point.panel_frequency_hz.total_cmp(&panel_frequency_hz).is_eq())
            .filter(|point| (from..=to).contains(&point.preload_mn))
            .map(|point| (ln(point.preload_mn), ln(point.stall_torque_n_m)))
            .collect();
        StraightLine::through(&logarithms).map(|line| MeasuredExponent {
            panel_frequency_hz,
            value: line.slope,
            standard_error: line.slope_error,
            explained: line.explained,
            points: logarithms.len(),
        })
    });
    let exponents = exponents.collect();
    Ok(MeasuredMotors { points, exponents })
}

impl MeasuredMotors {
    pub(super) fn is_empty(&self) -> bool {
        self.points.is_empty()
    }

    /// The points of a panel.
    pub(super) fn at(&self, frequency_hz: f64) -> Vec<MeasuredMotor> {
        let wanted = |point: &&MeasuredMotor| point.panel_frequency_hz.total_cmp(&frequency_hz).is_eq();
        self.points.iter().filter(wanted).copied().collect()
    }

    /// The words in the panel of the torques, if an exponent could be fitted.
    pub(super) fn label(&self, frequency_hz: f64) -> Option<String> {
        let wanted = |fit: &&MeasuredExponent| fit.panel_frequency_hz.total_cmp(&frequency_hz).is_eq();
        let fit = self.exponents.iter().find(wanted)?;
        Some(format!(r"measured: exponent ${:.2} \pm {:.2}$", fit.value, fit.standard_error))
    }

    /// What the caption says; nothing when there are no measurements.
    pub(super) fn caption(&self, data: &Fig11Data) -> String {
        if self.is_empty() {
            return String::new();
        }
        let [from, to] = data.trend_mn();
        let words = data.printed.frequencies_hz.map(|frequency| {
            let khz = frequency / 1e3;
            let fit = self.exponents.iter().find(|fit| fit.panel_frequency_hz.total_cmp(&frequency).is_eq());
            fit.map_or_else(
                || format!("{khz} kHz: fewer than three points at different preloads"),
                |fit| {
                    format!(
                        "{khz} kHz: {:.3} ± {:.3} (R² = {:.4}, {} points)",
                        fit.value, fit.standard_error, fit.explained, fit.points
                    )
                },
            )
        });
        format!(
            " Crosses: measurements read from {}; exponent of their stall torque against preload from {from} to {to} mN: {}.",
            LAYOUT.file,
            words.join("; ")
        )
    }
}
