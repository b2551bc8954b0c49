//! Which parameters give the numbers that Sec. III B prints for the best toss.
//!
//! Table I as printed does not give all of them. Can the printed maxima be points of an even grid of
//! amplitude angles?

use bouncing_disk::core::numerics::elementary::sin;
use bouncing_disk::toss::InitialSpin;

use super::data::{CoarseGrid, Comparison, Consistency, HandSpeed, Reading, TossPoint};
use super::sweep::{best_angle, maximum_index, ratio, speed, speed_curve, speeds};
use crate::claims::catalogue;
use crate::claims::paper::{SectionThree, TableOne};
use crate::claims::printed::PrintedNumber;
use crate::experiment::ExperimentError;
use crate::figures::shared::toss::{
    AngleGrid, MOST_INTERVALS, TossCase, frequency_of, grid_angle, launch_case, printed_angles, unreadable,
};

/// Numbers that the paper prints about tosses with θ = 0.
const NUMBERS: usize = 7;
/// The printed numbers in `data/paper/section3.json`, and what they are.
const NAMES: [(&str, &str); NUMBERS] = [
    ("predicted_airborne_speed", "airborne speed of Table I's toss (rad/s)"),
    ("optimal_amplitude_angle", "φ_L of the fastest toss (rad)"),
    ("largest_airborne_speed", "airborne speed of the fastest toss (rad/s)"),
    ("largest_efficiency", "efficiency of the fastest toss"),
    ("speed_ratio_at_optimum", "speed ratio of the fastest toss"),
    ("largest_speed_ratio", "largest speed ratio at θ = 0"),
    ("amplitude_angle_of_largest_speed_ratio", "φ_L of the largest speed ratio at θ = 0 (rad)"),
];

/// The printed numbers as intervals.
struct Printed([PrintedNumber; NUMBERS]);

impl Printed {
    fn new() -> Result<Self, ExperimentError> {
        let numbers = NAMES.iter().map(|(name, _)| catalogue::number(&format!("section3.{name}"), 0));
        let numbers = numbers.collect::<Result<Vec<_>, _>>()?;
        numbers.try_into().map(Self).map_err(|_| unreadable())
    }

    fn are_all(&self, numbers: &[f64; NUMBERS]) -> bool {
        let mut pairs = self.0.iter().zip(numbers);
        pairs.all(|(printed, number)| ((number - printed.value) / printed.half_unit).abs() <= 1.0)
    }
}

fn reading(parameters: TossCase, numbers: &[f64; NUMBERS]) -> Reading {
    let compare = |((_, quantity), computed): (&(&str, &str), &f64)| Comparison {
        quantity: (*quantity).to_owned(),
        computed: *computed,
    };
    Reading { parameters, numbers: NAMES.iter().zip(numbers).map(compare).collect() }
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
    let [_, angle, speed, _, ratio, ..] = &printed.0;
    let rim = table.stroke_m * table.angular_frequency_rad_per_s / table.contact_radius_m;
    HandSpeed {
        least_rad_per_s: rim * sin(angle.value - angle.half_unit),
        most_rad_per_s: (speed.value + speed.half_unit) / (ratio.value - ratio.half_unit),
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
        if printed.are_all(&numbers) {
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
        most_intervals: MOST_INTERVALS,
        frequency_range_rad_per_s: (frequency_of(&table, range.0), frequency_of(&table, range.1)),
        gyration_radius_range_m: fitting
            .first()
            .zip(fitting.last())
            .map(|(first, last)| (first.0.gyration_radius_m, last.0.gyration_radius_m)),
        reading: reading(chosen, &numbers),
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
    let printed = Printed::new()?;
    let case = TossCase::from(table);
    let coarse_grid = coarse_grid(table, &printed, section)?;
    Ok(Consistency {
        as_printed: reading(case, &smooth_numbers(&case)?),
        coarse_grid_curve: speed_curve(&coarse_grid.reading.parameters, count)?,
        hand_speed: hand_speed(&printed, &case),
        coarse_grid,
    })
}
