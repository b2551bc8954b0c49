//! Which parameters give the numbers that Sec. III B prints for the best toss.
//!
//! Table I as printed does not give all of them. Can the printed maxima be points of an even grid of
//! amplitude angles?

use bouncing_disk::core::numerics::elementary::sin;
use bouncing_disk::toss::InitialSpin;

use super::data::{CoarseGrid, Comparison, Consistency, HandSpeed, Reading, TossPoint};
use super::sweep::{best_angle, maximum_index, ratio, speed, speed_curve, speeds};
use crate::claims::paper::{SectionThree, TableOne};
use crate::claims::printed::PrintedNumber;
use crate::experiment::ExperimentError;
use crate::figures::angle_grid::{
    AngleGrid, MOST_INTERVALS, frequency_of, grid_angle, launch_case, printed_angles, unreadable,
};
use crate::figures::toss_case::TossCase;

/// Numbers that the paper prints about tosses with θ = 0.
const NUMBERS: usize = 7;
/// The names of the printed numbers in `data/paper/section3.json`.
const NAMES: [&str; NUMBERS] = [
    "predicted_airborne_speed",
    "optimal_amplitude_angle",
    "largest_airborne_speed",
    "largest_efficiency",
    "speed_ratio_at_optimum",
    "largest_speed_ratio",
    "amplitude_angle_of_largest_speed_ratio",
];

/// The printed numbers as intervals.
struct Printed {
    texts: [(&'static str, String); NUMBERS],
    centres: [f64; NUMBERS],
    half_units: [f64; NUMBERS],
}

impl Printed {
    /// The last number is the angle of the largest speed ratio.
    fn new(section: &SectionThree) -> Option<Self> {
        let texts = [
            ("airborne speed of Table I's toss (rad/s)", &section.predicted_airborne_speed_rad_per_s),
            ("φ_L of the fastest toss (rad)", &section.optimal_amplitude_angle_rad),
            ("airborne speed of the fastest toss (rad/s)", &section.largest_airborne_speed_rad_per_s),
            ("efficiency of the fastest toss", &section.largest_efficiency),
            ("speed ratio of the fastest toss", &section.speed_ratio_at_optimum),
            ("largest speed ratio at θ = 0", &section.largest_speed_ratio),
            (
                "φ_L of the largest speed ratio at θ = 0 (rad)",
                &section.amplitude_angle_of_largest_speed_ratio_rad,
            ),
        ]
        .map(|(name, text)| (name, text.clone()));
        let mut centres = [0.0; NUMBERS];
        let mut half_units = [0.0; NUMBERS];
        for (index, (_, text)) in texts.iter().enumerate() {
            let number = PrintedNumber::read(text)?;
            (centres[index], half_units[index]) = (number.value, number.half_unit);
        }
        Some(Self { texts, centres, half_units })
    }

    /// Distance from the printed value in half units of its last digit.
    fn misses(&self, numbers: &[f64; NUMBERS]) -> [f64; NUMBERS] {
        std::array::from_fn(|index| (numbers[index] - self.centres[index]) / self.half_units[index])
    }

    fn reading(&self, parameters: TossCase, numbers: &[f64; NUMBERS]) -> Reading {
        let misses = self.misses(numbers);
        let compare = |index: usize| Comparison {
            quantity: self.texts[index].0.to_owned(),
            key: format!("section3.{}", NAMES[index]),
            printed: self.texts[index].1.clone(),
            computed: numbers[index],
            reproduced: misses[index].abs() <= 1.0,
        };
        Reading { parameters, numbers: (0..NUMBERS).map(compare).collect() }
    }
}

fn in_order(table_speed: f64, fastest: &TossPoint, largest_ratio: &TossPoint) -> [f64; NUMBERS] {
    [
        table_speed,
        fastest.amplitude_angle_rad,
        fastest.airborne_speed_rad_per_s,
        fastest.efficiency,
        fastest.speed_ratio.unwrap_or(0.0),
        largest_ratio.speed_ratio.unwrap_or(0.0),
        largest_ratio.amplitude_angle_rad,
    ]
}

/// The numbers with maxima found to full precision.
fn smooth_numbers(case: &TossCase) -> Result<[f64; NUMBERS], ExperimentError> {
    let initial = InitialSpin::AbsoluteRest;
    let fastest = best_angle(case, initial, speed)?;
    Ok(in_order(case.airborne_speed()?, &fastest, &best_angle(case, initial, ratio)?))
}

/// See [`HandSpeed`]. Speed and ratio together fix the hand's speed, whatever the friction.
fn hand_speed(printed: &Printed, table: &TossCase) -> HandSpeed {
    let (centre, half) = (&printed.centres, &printed.half_units);
    let rim = table.stroke_m * table.angular_frequency_rad_per_s / table.contact_radius_m;
    HandSpeed {
        least_rad_per_s: rim * sin(centre[1] - half[1]),
        most_rad_per_s: (centre[2] + half[2]) / (centre[4] - half[4]),
    }
}

/// The printed numbers with maxima picked from a grid.
fn grid_numbers(case: &TossCase, intervals: u32) -> Result<[f64; NUMBERS], ExperimentError> {
    // At the largest angle itself the dough does not leave the hand.
    let tosses = (1..intervals)
        .map(|index| {
            let case = case.at_angle(grid_angle(case.largest_angle(), index, intervals));
            Ok((TossPoint::new(&case, &case.toss(InitialSpin::AbsoluteRest)?), case))
        })
        .collect::<Result<Vec<_>, ExperimentError>>()?;
    let fastest = maximum_index(tosses.iter().map(|(toss, _)| toss.airborne_speed_rad_per_s));
    let largest_ratio = maximum_index(tosses.iter().map(|(toss, _)| toss.speed_ratio.unwrap_or(0.0)));
    Ok(in_order(case.airborne_speed()?, &tosses[fastest].0, &tosses[largest_ratio].0))
}

fn coarse_grid(
    table_one: &TableOne,
    printed: &Printed,
    section: &SectionThree,
) -> Result<CoarseGrid, ExperimentError> {
    /// Radii of gyration are tried in steps of 0.1 mm over the uncertainty of Table I.
    const RADIUS_STEPS: i32 = 100;
    let table = TossCase::from(table_one);
    let case = launch_case(table_one, section);
    let angles = printed_angles(section)?;
    let largest = case.largest_angle();
    let grid = AngleGrid::with(largest, &angles).ok_or_else(unreadable)?;
    let intervals = grid.intervals;
    let range = grid.range(&angles);
    let radius = &table_one.gyration_radius_m;
    let mut fitting = Vec::new();
    for step in -RADIUS_STEPS..=RADIUS_STEPS {
        let gyration_radius_m = radius.value + radius.uncertainty * f64::from(step) / f64::from(RADIUS_STEPS);
        let case = TossCase { gyration_radius_m, ..case };
        let numbers = grid_numbers(&case, intervals)?;
        if printed.misses(&numbers).iter().all(|miss| miss.abs() <= 1.0) {
            fitting.push((case, numbers));
        }
    }
    let off = |case: &TossCase| (case.gyration_radius_m - radius.value).abs();
    let nearest = fitting.iter().min_by(|one, other| off(&one.0).total_cmp(&off(&other.0)));
    let (chosen, numbers) = match nearest {
        Some(nearest) => *nearest,
        None => (case, grid_numbers(&case, intervals)?),
    };
    let grid_angle_rad: Vec<_> =
        (0..intervals).map(|index| grid_angle(chosen.largest_angle(), index, intervals)).collect();
    Ok(CoarseGrid {
        angular_frequency_rad_per_s: case.angular_frequency_rad_per_s,
        amplitude_angle_rad: case.amplitude_angle_rad,
        largest_amplitude_angle_rad: largest,
        share_by_chance: grid.share_by_chance(&angles),
        intervals,
        indices: grid.indices,
        intervals_with_printed_frequency: AngleGrid::with(table.largest_angle(), &angles)
            .map(|grid| grid.intervals),
        most_intervals: MOST_INTERVALS,
        frequency_range_rad_per_s: (frequency_of(&table, range.0), frequency_of(&table, range.1)),
        gyration_radius_range_m: fitting
            .first()
            .zip(fitting.last())
            .map(|(first, last)| (first.0.gyration_radius_m, last.0.gyration_radius_m)),
        reading: printed.reading(chosen, &numbers),
        grid_speed_rad_per_s: speeds(&chosen, &grid_angle_rad)?,
        grid_angle_rad,
    })
}

/// Answers the question; `count` is the number of points of the curve.
pub(super) fn consistency(
    table: &TableOne,
    section: &SectionThree,
    count: u32,
) -> Result<Consistency, ExperimentError> {
    let printed = Printed::new(section).ok_or_else(unreadable)?;
    let case = TossCase::from(table);
    let coarse_grid = coarse_grid(table, &printed, section)?;
    Ok(Consistency {
        as_printed: printed.reading(case, &smooth_numbers(&case)?),
        coarse_grid_curve: speed_curve(&coarse_grid.reading.parameters, count)?,
        hand_speed: hand_speed(&printed, &case),
        coarse_grid,
    })
}
