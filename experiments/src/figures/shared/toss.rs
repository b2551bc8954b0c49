//! A single toss given by the quantities of Table I, the search for the best of a family of tosses, and the even grid of
//! amplitude angles on which the printed angles of Sec. III B and Fig. 5 lie.

use std::f64::consts::PI;

use bouncing_disk::core::numerics::elementary::{acos, atan, cos};
use bouncing_disk::core::numerics::roots::golden_section;
use bouncing_disk::parameters::Stroke;
use bouncing_disk::toss::{InitialSpin, TossPerformance, single_toss};
use bouncing_disk::{DiskParameters, Platform, System};
use serde::Serialize;

use crate::claims::paper::{SectionThree, TableOne};
use crate::claims::printed::PrintedNumber;
use crate::experiment::ExperimentError;

/// The parameters of a single toss, in the paper's order.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub(crate) struct TossCase {
    pub(crate) phase_lag_rad: f64,
    pub(crate) amplitude_angle_rad: f64,
    pub(crate) stroke_m: f64,
    pub(crate) angular_frequency_rad_per_s: f64,
    pub(crate) contact_radius_m: f64,
    pub(crate) gyration_radius_m: f64,
    pub(crate) friction: f64,
    pub(crate) preload_acceleration_m_per_s2: f64,
}

impl From<&TableOne> for TossCase {
    fn from(table: &TableOne) -> Self {
        Self {
            phase_lag_rad: table.phase_lag_rad,
            amplitude_angle_rad: table.amplitude_angle_rad.value,
            stroke_m: table.stroke_m.value,
            angular_frequency_rad_per_s: table.angular_frequency_rad_per_s.value,
            contact_radius_m: table.contact_radius_m.value,
            gyration_radius_m: table.gyration_radius_m.value,
            friction: table.friction.value,
            preload_acceleration_m_per_s2: table.preload_acceleration_m_per_s2,
        }
    }
}

impl TossCase {
    /// The same toss with another amplitude angle.
    pub(crate) fn at_angle(self, amplitude_angle_rad: f64) -> Self {
        Self { amplitude_angle_rad, ..self }
    }

    /// The same toss with another phase lag.
    pub(crate) fn at_lag(self, phase_lag_rad: f64) -> Self {
        Self { phase_lag_rad, ..self }
    }

    /// c ω²/g: the hand's peak acceleration for a purely vertical stroke.
    pub(crate) fn stroke_acceleration(&self) -> f64 {
        let omega = self.angular_frequency_rad_per_s;
        self.stroke_m * omega * omega / self.preload_acceleration_m_per_s2
    }

    /// acos(g/(c ω²)): a hand that moves more horizontally never lets go of the dough. NaN if it never does.
    pub(crate) fn largest_angle(&self) -> f64 {
        acos(1.0 / self.stroke_acceleration())
    }

    /// The largest angle at which the dough still leaves in floating-point arithmetic, to within rounding.
    pub(crate) fn last_angle(&self) -> f64 {
        (1.0 - 1e-12) * self.largest_angle()
    }

    /// The dough and the hand. The motion after the separation does not matter, so neither does the
    /// restitution (`table1` checks it).
    pub(crate) fn system(&self) -> Result<System, ExperimentError> {
        self.system_with(0.0)
    }

    /// The same with a coefficient of restitution.
    pub(crate) fn system_with(&self, restitution: f64) -> Result<System, ExperimentError> {
        let stroke = Stroke {
            stroke: self.stroke_m,
            amplitude_angle: self.amplitude_angle_rad,
            contact_radius: self.contact_radius_m,
            angular_frequency: self.angular_frequency_rad_per_s,
            phase_lag: self.phase_lag_rad,
        };
        let disk = DiskParameters {
            contact_radius: self.contact_radius_m,
            gyration_radius: self.gyration_radius_m,
            friction: self.friction,
            restitution,
            preload_acceleration: self.preload_acceleration_m_per_s2,
            load_acceleration: 0.0,
        };
        let platform = Platform::from_stroke(stroke)?;
        let disk = disk.build()?;
        System::new(platform, disk).map_err(ExperimentError::model)
    }

    /// The performance of the toss.
    pub(crate) fn toss(&self, initial: InitialSpin) -> Result<TossPerformance, ExperimentError> {
        single_toss(&self.system()?, initial).map_err(ExperimentError::model)
    }

    /// The airborne speed in rad/s; the dough starts at rest.
    pub(crate) fn airborne_speed(&self) -> Result<f64, ExperimentError> {
        Ok(self.toss(InitialSpin::AbsoluteRest)?.airborne_speed)
    }
}

/// Where a function is largest, and its value there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Maximum {
    pub(crate) place: f64,
    pub(crate) value: f64,
}

/// Steps of the golden section: they narrow the bracket by a factor of 3e12.
const GOLDEN_STEPS: u32 = 60;

/// The largest value of a function that has one maximum between neighbours of its best sample; `intervals` +
/// 1 samples are taken. The golden section then finds the value to rounding. The place of a smooth maximum is
/// known to the square root of that, about 1e-8: more is not in the values of a function.
pub(crate) fn maximum<E>(
    (low, high): (f64, f64),
    intervals: u32,
    mut function: impl FnMut(f64) -> Result<f64, E>,
) -> Result<Maximum, E> {
    let sample = |index: u32| low + (high - low) * f64::from(index) / f64::from(intervals);
    let mut best = Maximum { place: low, value: f64::NEG_INFINITY };
    let mut best_index = 0;
    for index in 0..=intervals {
        let value = function(sample(index))?;
        if value > best.value {
            (best, best_index) = (Maximum { place: sample(index), value }, index);
        }
    }
    let bracket = (sample(best_index.saturating_sub(1)), sample((best_index + 1).min(intervals)));
    golden_section(bracket.0, bracket.1, GOLDEN_STEPS, |place| {
        let value = function(place)?;
        if value > best.value {
            best = Maximum { place, value };
        }
        Ok(-value)
    })?;
    Ok(best)
}

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
    fn a_smooth_maximum_is_found_to_the_root_of_the_rounding() {
        let parabola = |x: f64| Ok::<_, std::convert::Infallible>(3.0 - (x - 0.4321) * (x - 0.4321));
        let found = maximum((0.0, 1.0), 7, parabola).expect("never fails");
        assert!((found.place - 0.4321).abs() < 3e-8, "{found:?}");
        assert!((found.value - 3.0).abs() < 1e-15);
        let edge = maximum((0.0, 1.0), 5, Ok::<_, std::convert::Infallible>).expect("never fails");
        assert!((edge.place - 1.0).abs() < 1e-15);
    }

    #[test]
    fn the_dough_still_leaves_at_the_last_angle() {
        let case = TossCase::from(&crate::claims::paper::table_one().expect("reads"));
        let last = case.at_angle(case.last_angle()).toss(InitialSpin::AbsoluteRest).expect("leaves");
        let early = std::f64::consts::FRAC_PI_2 - last.separation_phase;
        assert!((0.0..1e-5).contains(&early), "{early}");
        assert!(case.at_angle(1.000_000_1 * case.largest_angle()).toss(InitialSpin::AbsoluteRest).is_err());
    }

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
