//! The even grid of amplitude angles on which the printed angles of Sec. III B and Fig. 5 lie.

use std::f64::consts::PI;

use bouncing_disk::core::numerics::elementary::{atan, cos};

use super::toss_case::TossCase;
use crate::claims::paper::{SectionThree, TableOne};
use crate::claims::printed::PrintedNumber;
use crate::experiment::ExperimentError;

/// Intervals beyond which a grid holds any three angles of three digits.
pub(crate) const MOST_INTERVALS: u32 = 50;

/// Table I's toss with ω and φ_L as Eq. (14) gives them, not rounded.
pub(crate) fn launch_case(table: &TableOne, section: &SectionThree) -> TossCase {
    let table = TossCase::from(table);
    let (axial, rotary) = (section.launch_speed_m_per_s.value, section.launch_angular_speed_rad_per_s.value);
    let rim = table.contact_radius_m * rotary;
    TossCase {
        angular_frequency_rad_per_s: (axial * axial + rim * rim).sqrt() / table.stroke_m,
        amplitude_angle_rad: atan(rim / axial),
        ..table
    }
}

/// A grid that holds all three printed angles.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct AngleGrid {
    /// The end of the range of φ_L.
    pub(crate) largest: f64,
    pub(crate) intervals: u32,
    /// The index of each printed angle: of the largest speed ratio, of the fastest toss, of Fig. 5(c).
    pub(crate) indices: Vec<u32>,
}

impl AngleGrid {
    /// The grid with the fewest intervals.
    pub(crate) fn with(largest: f64, angles: &[PrintedNumber]) -> Option<Self> {
        fewest(largest, angles, MOST_INTERVALS).map(|(intervals, indices)| Self {
            largest,
            intervals,
            indices,
        })
    }

    /// An angle of the grid.
    pub(crate) fn angle(&self, index: u32) -> f64 {
        grid_angle(self.largest, index, self.intervals)
    }

    /// The ends of the range of φ_L for which the grid holds all printed angles.
    pub(crate) fn range(&self, angles: &[PrintedNumber]) -> (f64, f64) {
        let mut range = (0.0_f64, f64::INFINITY);
        for (angle, index) in angles.iter().zip(&self.indices) {
            let stretch = f64::from(self.intervals) / f64::from(*index);
            range.0 = range.0.max((angle.value - angle.half_unit) * stretch);
            range.1 = range.1.min((angle.value + angle.half_unit) * stretch);
        }
        range
    }

    /// Share of all ends of the range between 0.40 π and 0.48 π for which as few intervals work.
    pub(crate) fn share_by_chance(&self, angles: &[PrintedNumber]) -> f64 {
        /// Samples of the end of the range.
        const SAMPLES: u32 = 20_000;
        let fits = |sample: &u32| {
            let share = (f64::from(*sample) + 0.5) / f64::from(SAMPLES);
            fewest(PI * (0.40 + 0.08 * share), angles, self.intervals).is_some()
        };
        (0..SAMPLES).filter(fits).count() as f64 / f64::from(SAMPLES)
    }
}

/// The ω for which the range of φ_L ends at `largest`.
pub(crate) fn frequency_of(case: &TossCase, largest: f64) -> f64 {
    (case.preload_acceleration_m_per_s2 / (case.stroke_m * cos(largest))).sqrt()
}

/// The printed angles: of the largest speed ratio, of the fastest toss, of Fig. 5(c).
pub(crate) fn printed_angles(section: &SectionThree) -> Result<Vec<PrintedNumber>, ExperimentError> {
    let texts = [
        &section.amplitude_angle_of_largest_speed_ratio_rad,
        &section.optimal_amplitude_angle_rad,
        &section.amplitude_angle_of_fig5c_rad,
    ];
    let angles: Option<Vec<_>> = texts.into_iter().map(|text| PrintedNumber::read(text)).collect();
    angles.ok_or_else(unreadable)
}

/// The error for printed numbers that cannot be read, or angles that lie on no grid.
pub(crate) fn unreadable() -> ExperimentError {
    ExperimentError::Input {
        path: "data/paper/section3.json".into(),
        source: "a printed number cannot be read, or the printed angles lie on no grid".into(),
    }
}

/// The angle of a point of an even grid.
pub(crate) fn grid_angle(largest: f64, index: u32, intervals: u32) -> f64 {
    largest * f64::from(index) / f64::from(intervals)
}

/// The smallest number of intervals of [0, largest] whose points have all printed angles, and their indices.
fn fewest(largest: f64, angles: &[PrintedNumber], most: u32) -> Option<(u32, Vec<u32>)> {
    (angles.len() as u32..=most).find_map(|intervals| {
        let indices: Option<Vec<u32>> = angles
            .iter()
            .map(|angle| {
                let index = (angle.value / largest * f64::from(intervals)).round() as u32;
                let miss = (grid_angle(largest, index, intervals) - angle.value).abs();
                (index <= intervals && miss <= angle.half_unit).then_some(index)
            })
            .collect();
        indices.map(|indices| (intervals, indices))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_grid_is_found_by_its_angles() {
        let angles: Vec<_> =
            ["0.25", "0.50", "0.75"].iter().filter_map(|text| PrintedNumber::read(text)).collect();
        assert_eq!(fewest(1.0, &angles, 9), Some((4, vec![1, 2, 3])));
        assert_eq!(fewest(1.1, &angles, 9), None);
        let grid = AngleGrid::with(1.0, &angles).expect("exists");
        let (low, high) = grid.range(&angles);
        assert!((low - 0.745 / 0.75).abs() < 1e-15 && (high - 0.755 / 0.75).abs() < 1e-15, "{low} {high}");
        assert!((grid.angle(3) - 0.75).abs() < 1e-15);
    }
}
