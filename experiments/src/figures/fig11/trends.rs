//! The trends of Fig. 11 over the preloads.

use super::data::{Curve, Holes, Point, Trend};
use crate::claims::Cases;
use crate::figures::shared::numbers;

/// A change by more than this share is one that a reader of the figure would see: a motor whose steady speed,
/// or whose stall torque over preload, is farther from the middle of its curve is off the trend, and a steady
/// speed that differs as much from the others is a sharp fall or rise.
pub(super) const SHARP: f64 = 0.2;

/// Largest difference of a fitted exponent from 1 at which stall torque counts as proportional to preload,
/// and largest exponent of either sign (with two standard errors) at which the speed counts as independent of
/// it: over the 3.5-fold range of preloads both make 13 %.
pub(super) const EXPONENT_WITHIN: f64 = 0.1;

/// The ends are one in so many of the motors below, and above, the preloads of the trends.
const OUTERMOST: usize = 4;

impl Trend {
    pub(super) fn of(curve: &Curve, [from, to]: [f64; 2], plateau_mn: f64) -> Self {
        let inside: Vec<&Point> =
            curve.points.iter().filter(|point| (from..=to).contains(&point.preload_mn)).collect();
        let below: Vec<&Point> = curve.points.iter().filter(|point| point.preload_mn < from).collect();
        let every = || curve.points.iter().chain(&curve.further);
        let above: Vec<&Point> = every().filter(|point| point.preload_mn > to).collect();
        let per_preload = |point: &Point| single_stall(point).map(|stall| stall / point.preload_mn);
        let median_speed = median(inside.iter().map(|point| speed(point)));
        let single_speed = median(inside.iter().map(|point| point.single_speed_rad_per_s));
        let single_stall_per_preload = median(inside.iter().filter_map(|point| per_preload(point)));
        let near = |value: f64, middle: f64| (value - middle).abs() <= SHARP * middle.abs();
        let speed_holds = |point: &Point| near(point.single_speed_rad_per_s, single_speed);
        let torque_holds =
            |point: &Point| per_preload(point).is_some_and(|value| near(value, single_stall_per_preload));
        let no_fall = |points: &[&Point]| {
            Cases::of(points.iter().map(|point| point.single_speed_rad_per_s >= (1.0 - SHARP) * single_speed))
        };
        let no_rise = |points: &[&Point]| {
            Cases::of(points.iter().map(|point| point.single_speed_rad_per_s <= (1.0 + SHARP) * single_speed))
        };
        // Only the outermost motors: a fall at the lowest preloads does not show in the middle one of all
        // below.
        let outermost = |points: &[&Point], sign: f64| {
            let mut points = points.to_vec();
            points.sort_by(|one, other| (sign * one.preload_mn).total_cmp(&(sign * other.preload_mn)));
            let count = points.len().div_ceil(OUTERMOST);
            median(points.iter().take(count).map(|point| speed(point))) / median_speed
        };
        let outside_over_inside = [outermost(&below, 1.0), outermost(&above, -1.0)];
        let outside = [below, above.clone()].concat();
        let high: Vec<&Point> = every().filter(|point| point.preload_mn > plateau_mn).collect();
        Self {
            frequency_hz: curve.frequency_hz,
            amplitude_m: curve.amplitude_m,
            median_speed_rad_per_s: median_speed,
            speed: Cases::of(inside.iter().map(|point| speed_holds(point))),
            torque: Cases::of(inside.iter().map(|point| torque_holds(point))),
            both: Cases::of(inside.iter().map(|point| speed_holds(point) && torque_holds(point))),
            no_plateau: Cases::of(high.iter().map(|point| {
                // Halfway between the line through the origin and what the torque is where the plateau
                // begins.
                let halfway = 0.5 * single_stall_per_preload * (point.preload_mn + plateau_mn);
                single_stall(point).is_some_and(|stall| stall > halfway)
            })),
            speed_exponent: median_exponent(&inside, |point| Some(speed(point))),
            torque_exponent: median_exponent(&inside, stall),
            high_torque_exponent: median_exponent(&high, stall),
            no_fall: no_fall(&outside),
            no_rise_above: no_rise(&above),
            outside_over_inside,
        }
    }

    /// The amplitude in words.
    pub(super) fn name(&self) -> String {
        format!("{:e} m", self.amplitude_m)
    }
}

impl Holes {
    pub(super) fn of(curves: &[Curve]) -> Self {
        let points: Vec<&Point> = curves.iter().flat_map(|curve| &curve.points).collect();
        let is_one_flight =
            |point: &Point| point.statistics.is_low_period() && point.statistics.cycle.is_one_flight();
        let one_flight: Vec<_> = points.iter().filter(|point| is_one_flight(point)).collect();
        let fractions: Vec<f64> =
            one_flight.iter().map(|point| point.axial_forcing.rem_euclid(1.0)).collect();
        let speeds: Vec<f64> = one_flight.iter().map(|point| speed(point)).collect();
        let one_flight_fractions = extent(&fractions);
        Self {
            motors: points.len(),
            low_period: points.iter().filter(|point| point.statistics.is_low_period()).count(),
            one_flight: one_flight.len(),
            one_flight_fractions,
            one_flight_window: one_flight_fractions.map(|[least, most]| most - least),
            one_flight_speeds_rad_per_s: extent(&speeds),
        }
    }
}

pub(super) fn stall(point: &Point) -> Option<f64> {
    point.statistics.stall_acceleration_rad_per_s2.map(|spread| spread.mean)
}

fn single_stall(point: &Point) -> Option<f64> {
    point.single_stall_rad_per_s2
}

pub(super) fn speed(point: &Point) -> f64 {
    point.statistics.steady_speed_rad_per_s.mean
}

/// The exponent of what `of` reads against preload.
fn median_exponent(points: &[&Point], of: fn(&Point) -> Option<f64>) -> Option<f64> {
    numbers::median_exponent(points.iter().filter_map(|point| Some((point.preload_mn, of(point)?))))
}

/// The middle one; zero of none.
fn median(values: impl Iterator<Item = f64>) -> f64 {
    numbers::median(values).unwrap_or(0.0)
}

/// Smallest and largest value; `None` of none.
pub(super) fn extent(values: &[f64]) -> Option<[f64; 2]> {
    let (low, high) = numbers::extent(values.iter().copied());
    (!values.is_empty()).then_some([low, high])
}

#[cfg(test)]
mod tests {
    use bouncing_disk::estimate::Spread;
    use bouncing_disk::toss::ChatteringCycle;

    use super::*;
    use crate::figures::shared::motor::{Cycle, MotorStatistics};

    fn point(preload_mn: f64, speed: f64, stall: Option<f64>, long_flights: usize) -> Point {
        let spread = |mean: f64| Spread { mean, deviation: 0.0, standard_error: 0.0 };
        Point {
            preload_acceleration_m_per_s2: preload_mn / 33.0,
            preload_mn,
            axial_forcing: 10.5,
            statistics: MotorStatistics {
                steady_speed_rad_per_s: spread(speed),
                stall_acceleration_rad_per_s2: stall.map(spread),
                cycle: Cycle::Chattering(ChatteringCycle { impacts: 9, platform_periods: 11, long_flights }),
                locked: true,
            },
            net_share_at_rest: 0.5,
            single_speed_rad_per_s: speed,
            single_stall_rad_per_s2: stall,
        }
    }

    /// A motor that turns much more slowly counts against the trend, and against "no sharp fall" where it
    /// lies outside.
    #[test]
    fn a_motor_in_a_hole_counts_against_the_statement() {
        let mut points: Vec<Point> = (0..30)
            .map(|index| 20.0 + 10.0 * f64::from(index))
            .map(|preload| point(preload, 20.0, Some(0.1 * preload), 30))
            .collect();
        points[10] = point(120.0, 3.0, None, 1);
        points[2] = point(40.0, 3.0, None, 1);
        let curve = Curve { frequency_hz: 7e4, amplitude_m: 1e-8, points, further: Vec::new() };
        let trend = Trend::of(&curve, [80.0, 280.0], 200.0);
        assert_eq!(trend.speed, Cases { holding: 20, tried: 21 });
        assert_eq!(trend.torque, Cases { holding: 20, tried: 21 });
        assert_eq!(trend.no_fall, Cases { holding: 8, tried: 9 });
        // The outermost quarter below 80 mN are those at 20 and at 30 mN.
        assert!((trend.outside_over_inside[0] - 1.0).abs() < 1e-12, "the hole is not at the end");
        assert_eq!(trend.no_rise_above, Cases { holding: 3, tried: 3 });
        let exponent = trend.torque_exponent.expect("many motors");
        assert!((exponent - 1.0).abs() < 1e-12, "{exponent}");
        assert!(trend.speed_exponent.is_some_and(|exponent| exponent.abs() < 1e-12), "{trend:?}");
        assert_eq!(trend.no_plateau, Cases { holding: 11, tried: 11 });
        let holes = Holes::of(&[curve]);
        assert_eq!((holes.motors, holes.low_period, holes.one_flight), (30, 2, 2));
        assert_eq!(
            holes.one_flight_speeds_rad_per_s.map(|speeds| speeds.map(f64::to_bits)),
            Some([3.0_f64.to_bits(); 2])
        );
    }

    #[test]
    fn a_speed_that_follows_the_preload_is_no_trend_of_independence() {
        let points: Vec<Point> = (8..=28)
            .map(|index| 10.0 * f64::from(index))
            .map(|preload| point(preload, 0.1 * preload, Some(7.0), 30))
            .collect();
        let curve = Curve { frequency_hz: 7e4, amplitude_m: 1e-8, points, further: Vec::new() };
        let trend = Trend::of(&curve, [80.0, 280.0], 200.0);
        assert!(trend.speed.holding < 10 && trend.torque.holding < 12, "{trend:?}");
        assert!(trend.torque_exponent.expect("many motors").abs() < 1e-12);
        assert!((trend.speed_exponent.expect("many motors") - 1.0).abs() < 1e-12);
        assert_eq!(trend.no_plateau.holding, 0, "{:?}", trend.no_plateau);
        assert!(trend.high_torque_exponent.expect("many motors").abs() < 1e-12);
    }
}
