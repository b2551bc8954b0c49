//! Table I as printed does not give all numbers that Sec. III B prints for the best toss. Can the printed maxima be points
//! of an even grid of amplitude angles?

use std::collections::BTreeMap;

use bouncing_disk::core::numerics::elementary::sin;
use bouncing_disk::toss::InitialSpin;
use serde::Serialize;

use super::tosses::{TossPoint, angles, best_angle, maximum_index, ratio, speed, speeds};
use crate::claims::catalogue;
use crate::claims::paper::{SectionThree, TableOne};
use crate::experiment::ExperimentError;
use crate::figures::shared::toss::{
    AngleGrid, MOST_INTERVALS, TossCase, frequency_of, grid_angle, launch_case, printed_angles, unreadable,
};

/// The numbers that the paper prints about tosses with θ = 0, in `data/paper/section3.json`.
const NUMBERS: [&str; 7] = [
    "predicted_airborne_speed",
    "optimal_amplitude_angle",
    "largest_airborne_speed",
    "largest_efficiency",
    "speed_ratio_at_optimum",
    "largest_speed_ratio",
    "amplitude_angle_of_largest_speed_ratio",
];

/// A parameter set and what it gives in place of the printed numbers, in their units; angles in rad.
#[derive(Debug, Serialize)]
pub(super) struct Reading {
    pub(super) parameters: TossCase,
    numbers: BTreeMap<&'static str, f64>,
}

impl Reading {
    fn new(case: TossCase, fastest: &TossPoint, firmest: &TossPoint) -> Result<Self, ExperimentError> {
        let computed = [
            case.airborne_speed()?,
            fastest.amplitude_angle_rad,
            fastest.airborne_speed_rad_per_s,
            fastest.efficiency,
            fastest.speed_ratio.unwrap_or(0.0),
            firmest.speed_ratio.unwrap_or(0.0),
            firmest.amplitude_angle_rad,
        ];
        Ok(Self { parameters: case, numbers: NUMBERS.into_iter().zip(computed).collect() })
    }

    /// With maxima picked from a grid. At its last angle the dough does not leave the hand.
    fn on_grid(case: TossCase, intervals: u32) -> Result<Self, ExperimentError> {
        let tosses = (1..intervals)
            .map(|index| case.at_angle(grid_angle(case.largest_angle(), index, intervals)))
            .map(|case| TossPoint::of(&case, InitialSpin::AbsoluteRest))
            .collect::<Result<Vec<_>, _>>()?;
        let fastest = maximum_index(tosses.iter().map(|toss| toss.airborne_speed_rad_per_s));
        let firmest = maximum_index(tosses.iter().map(|toss| toss.speed_ratio.unwrap_or(0.0)));
        Self::new(case, &tosses[fastest], &tosses[firmest])
    }

    /// Whether all numbers round to the printed ones.
    fn prints_alike(&self) -> Result<bool, ExperimentError> {
        for (name, number) in &self.numbers {
            let printed = catalogue::number(&format!("section3.{name}"), 0)?;
            if ((number - printed.value) / printed.half_unit).abs() > 1.0 {
                return Ok(false);
            }
        }
        Ok(true)
    }
}

/// Which parameters give the numbers that the paper prints for θ = 0.
#[derive(Debug, Serialize)]
pub(super) struct Consistency {
    /// Table I as printed, with maxima found to full precision.
    as_printed: Reading,
    hand_speed: HandSpeed,
    pub(super) coarse_grid: CoarseGrid,
    /// The curve of the grid's parameters.
    pub(super) coarse_grid_curve: SpeedCurve,
}

/// The hand's largest speed ωΦ at the printed optimum. Speed and ratio together fix it, whatever the friction.
#[derive(Debug, Serialize)]
struct HandSpeed {
    /// The least that Table I gives for an angle that rounds to the printed one.
    least_rad_per_s: f64,
    /// The most that a speed and a ratio that round to the printed ones allow.
    most_rad_per_s: f64,
}

/// A curve of panel (f).
#[derive(Debug, Serialize)]
pub(super) struct SpeedCurve {
    pub(super) amplitude_angle_rad: Vec<f64>,
    pub(super) airborne_speed_rad_per_s: Vec<f64>,
}

/// The grid with the fewest intervals whose points hold all printed angles.
#[derive(Debug, Serialize)]
pub(super) struct CoarseGrid {
    /// ω that Eq. (14) gives, not rounded, and acos(g/(c ω²)) with it.
    pub(super) angular_frequency_rad_per_s: f64,
    largest_amplitude_angle_rad: f64,
    pub(super) intervals: u32,
    /// The index of each printed angle among its points.
    indices: Vec<u32>,
    most_intervals: u32,
    /// Share of all largest angles between 0.40 π and 0.48 π for which `intervals` or fewer intervals work.
    share_by_chance: f64,
    /// The range of ω for which the printed angles lie on the grid.
    frequency_range_rad_per_s: (f64, f64),
    /// The radii of gyration, in steps of 0.1 mm, with which all printed numbers come out.
    gyration_radius_range_m: Option<(f64, f64)>,
    /// The one of them that is nearest to Table I; all other parameters are those of Table I, except for ω.
    pub(super) reading: Reading,
    pub(super) grid_angle_rad: Vec<f64>,
    pub(super) grid_speed_rad_per_s: Vec<f64>,
}

impl CoarseGrid {
    fn new(table_i: &TableOne, section: &SectionThree) -> Result<Self, ExperimentError> {
        /// Radii of gyration are tried in steps of 0.1 mm over the uncertainty of Table I.
        const RADIUS_STEPS: i32 = 100;
        let (table, case) = (TossCase::from(table_i), launch_case(table_i, section));
        let printed = printed_angles(section)?;
        let grid = AngleGrid::with(case.largest_angle(), &printed).ok_or_else(unreadable)?;
        let range = grid.range(&printed);
        let radius = table_i.gyration_radius_m;
        let mut fitting = Vec::new();
        for step in -RADIUS_STEPS..=RADIUS_STEPS {
            let gyration_radius_m =
                radius.value + radius.uncertainty * f64::from(step) / f64::from(RADIUS_STEPS);
            let reading = Reading::on_grid(TossCase { gyration_radius_m, ..case }, grid.intervals)?;
            if reading.prints_alike()? {
                fitting.push(reading);
            }
        }
        let radius_of = |reading: &Reading| reading.parameters.gyration_radius_m;
        let off = |reading: &Reading| (radius_of(reading) - radius.value).abs();
        let radii = fitting.first().zip(fitting.last()).map(|(one, last)| (radius_of(one), radius_of(last)));
        let nearest = fitting.into_iter().min_by(|one, other| off(one).total_cmp(&off(other)));
        let reading = nearest.map_or_else(|| Reading::on_grid(case, grid.intervals), Ok)?;
        let end = reading.parameters.largest_angle();
        let points: Vec<_> =
            (0..grid.intervals).map(|index| grid_angle(end, index, grid.intervals)).collect();
        Ok(Self {
            angular_frequency_rad_per_s: case.angular_frequency_rad_per_s,
            largest_amplitude_angle_rad: grid.largest,
            share_by_chance: grid.share_by_chance(&printed),
            intervals: grid.intervals,
            indices: grid.indices,
            most_intervals: MOST_INTERVALS,
            frequency_range_rad_per_s: (frequency_of(&table, range.0), frequency_of(&table, range.1)),
            gyration_radius_range_m: radii,
            grid_speed_rad_per_s: speeds(&reading.parameters, &points)?,
            grid_angle_rad: points,
            reading,
        })
    }
}

impl Consistency {
    /// `count` is the number of points of the curve.
    pub(super) fn new(
        table_i: &TableOne,
        section: &SectionThree,
        count: u32,
    ) -> Result<Self, ExperimentError> {
        let table = TossCase::from(table_i);
        let best = |of: fn(&_) -> f64| best_angle(&table, InitialSpin::AbsoluteRest, of);
        let printed = |name: &str| catalogue::number(&format!("section3.{name}"), 0);
        let (angle, fastest) = (printed("optimal_amplitude_angle")?, printed("largest_airborne_speed")?);
        let at_optimum = printed("speed_ratio_at_optimum")?;
        let rim = table.stroke_m * table.angular_frequency_rad_per_s / table.contact_radius_m;
        let coarse_grid = CoarseGrid::new(table_i, section)?;
        let curve = angles(&coarse_grid.reading.parameters, count);
        Ok(Self {
            as_printed: Reading::new(table, &best(speed)?, &best(ratio)?)?,
            hand_speed: HandSpeed {
                least_rad_per_s: rim * sin(angle.value - angle.half_unit),
                most_rad_per_s: (fastest.value + fastest.half_unit)
                    / (at_optimum.value - at_optimum.half_unit),
            },
            coarse_grid_curve: SpeedCurve {
                airborne_speed_rad_per_s: speeds(&coarse_grid.reading.parameters, &curve)?,
                amplitude_angle_rad: curve,
            },
            coarse_grid,
        })
    }
}
