//! Which parameters give the numbers that Sec. III B prints for the best toss.
//!
//! Table I as printed does not give all of them. Two questions are answered: what is the nearest set of parameters
//! whose true maxima have the printed numbers, and can the printed maxima be points of an even grid of amplitude
//! angles?

use bouncing_disk::InitialSpin;
use bouncing_disk::core::elementary::sin;
use bouncing_disk::core::numerics::roots::bisection;

use super::data::{CoarseGrid, Comparison, Conflict, Consistency, HandSpeed, Reading, TossPoint};
use super::sweep::{best_angle, maximum_index, ratio, speed, speed_curve, speeds};
use crate::experiment::ExperimentError;
use crate::figures::angle_grid::{
    AngleGrid, MOST_INTERVALS, frequency_of, grid_angle, launch_case, printed_angles, unreadable,
};
use crate::figures::least_squares::{Bound, NoShortest, shortest};
use crate::figures::samples::six_decimals;
use crate::figures::toss_case::TossCase;
use crate::paper::{SectionThree, TableOne, Uncertain};
use crate::printed::PrintedNumber;

/// Numbers that the paper prints about tosses with θ = 0.
const NUMBERS: usize = 7;
/// Parameters that are varied: c, ω, a_e, a_g, μ.
const PARAMETERS: usize = 5;
/// The names of the parameters.
pub(super) const PARAMETER_NAMES: [&str; PARAMETERS] = ["c", "ω", "a_e", "a_g", "μ"];

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

    fn reading(&self, search: &Search<'_>, parameters: TossCase, numbers: &[f64; NUMBERS]) -> Reading {
        let misses = self.misses(numbers);
        let shifts = search.shifts(&parameters);
        let compare = |index: usize| Comparison {
            quantity: self.texts[index].0.to_owned(),
            key: format!("section3.{}", NAMES[index]),
            printed: self.texts[index].1.clone(),
            computed: numbers[index],
            reproduced: misses[index].abs() <= 1.0,
        };
        Reading {
            parameters,
            shifts: shifts.to_vec(),
            distance: dot(&shifts, &shifts).sqrt(),
            numbers: (0..NUMBERS).map(compare).collect(),
        }
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

/// A search in units of the uncertainties of Table I.
struct Search<'a> {
    table: &'a TableOne,
}

impl Search<'_> {
    fn inputs(&self) -> [&Uncertain; PARAMETERS] {
        let table = self.table;
        [
            &table.stroke_m,
            &table.angular_frequency_rad_per_s,
            &table.contact_radius_m,
            &table.gyration_radius_m,
            &table.friction,
        ]
    }

    fn case(&self, shifts: &[f64; PARAMETERS]) -> TossCase {
        let inputs = self.inputs();
        let value = |index: usize| inputs[index].value + shifts[index] * inputs[index].uncertainty;
        TossCase {
            stroke_m: value(0),
            angular_frequency_rad_per_s: value(1),
            contact_radius_m: value(2),
            gyration_radius_m: value(3),
            friction: value(4),
            ..TossCase::from(self.table)
        }
    }

    fn shifts(&self, case: &TossCase) -> [f64; PARAMETERS] {
        let values = [
            case.stroke_m,
            case.angular_frequency_rad_per_s,
            case.contact_radius_m,
            case.gyration_radius_m,
            case.friction,
        ];
        let inputs = self.inputs();
        std::array::from_fn(|index| (values[index] - inputs[index].value) / inputs[index].uncertainty)
    }

    /// The set of parameters nearest to Table I, within its uncertainties, that has the first `count` printed
    /// numbers: the shortest vector of shifts in a region with smooth bounds, by successive linearisation. Each shift
    /// has six decimals: the places of the maxima say no more.
    fn nearest(&self, printed: &Printed, count: usize) -> Result<Reading, ExperimentError> {
        /// Steps of the linearisation; it needs about ten.
        const STEPS: u32 = 40;
        /// Shift for the difference quotients, far above the 1e-8 of the place of a maximum.
        const DIFFERENCE: f64 = 1e-3;
        /// Largest change of a shift in one step, within which the linearisation is fair.
        const REACH: f64 = 0.25;
        /// Change of the shifts, in uncertainties, at which the search ends: their last decimal.
        const END: f64 = 1e-6;
        /// Keeps a number that lies on its bound from falling outside by rounding.
        const MARGIN: f64 = 1e-4;
        let mut shifts = [0.0; PARAMETERS];
        for _ in 0..STEPS {
            let misses = printed.misses(&smooth_numbers(&self.case(&shifts))?);
            let mut slopes = [[0.0; PARAMETERS]; NUMBERS];
            for parameter in 0..PARAMETERS {
                let at = |difference: f64| {
                    let mut moved = shifts;
                    moved[parameter] += difference;
                    Ok::<_, ExperimentError>(printed.misses(&smooth_numbers(&self.case(&moved))?))
                };
                let (above, below) = (at(DIFFERENCE)?, at(-DIFFERENCE)?);
                for number in 0..NUMBERS {
                    slopes[number][parameter] = (above[number] - below[number]) / (2.0 * DIFFERENCE);
                }
            }
            let mut bounds = Vec::new();
            for (slope, miss) in slopes.iter().zip(misses).take(count) {
                // |miss + slope (new - old)| <= 1 - MARGIN.
                let offset = dot(slope, &shifts) - miss;
                bounds.push(Bound { normal: *slope, limit: 1.0 - MARGIN + offset });
                bounds.push(Bound { normal: slope.map(|part| -part), limit: 1.0 - MARGIN - offset });
            }
            for parameter in 0..PARAMETERS {
                let mut normal = [0.0; PARAMETERS];
                normal[parameter] = 1.0;
                bounds.push(Bound { normal, limit: 1.0 });
                bounds.push(Bound { normal: normal.map(|part| -part), limit: 1.0 });
            }
            let target = shortest(&bounds).map_err(|error| {
                let quantity =
                    "set of parameters within Table I's uncertainties with the printed numbers".to_owned();
                match error {
                    NoShortest::Exclusive => ExperimentError::NoData { quantity },
                    // Such a set may exist.
                    other => ExperimentError::Search { quantity, source: Box::new(other) },
                }
            })?;
            let steps: [f64; PARAMETERS] = std::array::from_fn(|index| target[index] - shifts[index]);
            let longest = steps.iter().fold(0.0_f64, |longest, step| longest.max(step.abs()));
            let share = if longest > REACH { REACH / longest } else { 1.0 };
            for (shift, step) in shifts.iter_mut().zip(steps) {
                *shift = six_decimals((*shift + share * step).clamp(-1.0, 1.0));
            }
            if longest < END {
                break;
            }
        }
        let case = self.case(&shifts);
        Ok(printed.reading(self, case, &smooth_numbers(&case)?))
    }
}

fn dot(one: &[f64; PARAMETERS], other: &[f64; PARAMETERS]) -> f64 {
    one.iter().zip(other).map(|(one, other)| one * other).sum()
}

/// Halvings that find a parameter to 1e-12 of the range in which it is looked for.
const HALVINGS: u32 = 40;

/// See [`Conflict`]. The two numbers are moved by ω and a_g.
fn conflict(printed: &Printed, table: &TossCase) -> Result<Conflict, ExperimentError> {
    let lowest = |number: usize| printed.centres[number] - printed.half_units[number];
    let (lowest_ratio, lowest_angle) = (lowest(5), lowest(6));
    let omega = table.angular_frequency_rad_per_s;
    let largest_ratio = |case: &TossCase| best_angle(case, InitialSpin::AbsoluteRest, ratio);
    // The largest ratio rises with ω, its angle with a_g.
    let with_radius = |gyration_radius_m: f64| {
        let at = |omega: f64| TossCase { gyration_radius_m, angular_frequency_rad_per_s: omega, ..*table };
        let omega = bisection(0.7 * omega, 1.3 * omega, HALVINGS, |omega| {
            Ok::<_, ExperimentError>(largest_ratio(&at(omega))?.speed_ratio.unwrap_or(0.0) <= lowest_ratio)
        })?;
        Ok::<_, ExperimentError>(at(omega))
    };
    let radius = table.gyration_radius_m;
    let radius = bisection(0.8 * radius, 1.2 * radius, HALVINGS, |radius| {
        Ok::<_, ExperimentError>(largest_ratio(&with_radius(radius)?)?.amplitude_angle_rad <= lowest_angle)
    })?;
    let case = with_radius(radius)?;
    let reach = case.contact_radius_m / case.gyration_radius_m;
    let largest = largest_ratio(&case)?;
    Ok(Conflict {
        stroke_acceleration: case.stroke_acceleration(),
        grip: case.friction * reach * reach,
        largest_speed_ratio: largest.speed_ratio.unwrap_or(0.0),
        amplitude_angle_of_largest_speed_ratio_rad: largest.amplitude_angle_rad,
        optimal_amplitude_angle_rad: best_angle(&case, InitialSpin::AbsoluteRest, speed)?.amplitude_angle_rad,
    })
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

/// See [`Consistency::radius_alone`].
fn radius_alone(search: &Search<'_>, printed: &Printed) -> Result<Reading, ExperimentError> {
    let table = TossCase::from(search.table);
    let at = |gyration_radius_m: f64| TossCase { gyration_radius_m, ..table };
    let radius = table.gyration_radius_m;
    // The angle falls as the radius grows.
    let radius = bisection(0.8 * radius, 1.2 * radius, HALVINGS, |radius| {
        let fastest = best_angle(&at(radius), InitialSpin::AbsoluteRest, speed)?;
        Ok::<_, ExperimentError>(fastest.amplitude_angle_rad >= printed.centres[1])
    })?;
    Ok(printed.reading(search, at(radius), &smooth_numbers(&at(radius))?))
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
    search: &Search<'_>,
    printed: &Printed,
    section: &SectionThree,
) -> Result<CoarseGrid, ExperimentError> {
    /// Radii of gyration are tried in steps of 0.1 mm over the uncertainty of Table I.
    const RADIUS_STEPS: i32 = 100;
    let table = TossCase::from(search.table);
    let case = launch_case(search.table, section);
    let angles = printed_angles(section)?;
    let largest = case.largest_angle();
    let grid = AngleGrid::with(largest, &angles).ok_or_else(unreadable)?;
    let intervals = grid.intervals;
    let range = grid.range(&angles);
    let radius = &search.table.gyration_radius_m;
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
        reading: printed.reading(search, chosen, &numbers),
        grid_speed_rad_per_s: speeds(&chosen, &grid_angle_rad)?,
        grid_angle_rad,
    })
}

/// Answers both questions; `count` is the number of points of the curves.
pub(super) fn consistency(
    table: &TableOne,
    section: &SectionThree,
    count: u32,
) -> Result<Consistency, ExperimentError> {
    let printed = Printed::new(section).ok_or_else(unreadable)?;
    let search = Search { table };
    let case = TossCase::from(table);
    let nearest = search.nearest(&printed, NUMBERS - 1)?;
    let coarse_grid = coarse_grid(&search, &printed, section)?;
    Ok(Consistency {
        as_printed: printed.reading(&search, case, &smooth_numbers(&case)?),
        nearest_curve: speed_curve(&nearest.parameters, count)?,
        coarse_grid_curve: speed_curve(&coarse_grid.reading.parameters, count)?,
        nearest,
        conflict: conflict(&printed, &case)?,
        hand_speed: hand_speed(&printed, &case),
        radius_alone: radius_alone(&search, &printed)?,
        coarse_grid,
    })
}
