//! The trends of Fig. 11 over the preloads, and the statements about them.

use serde::Serialize;

use super::{Curve, Point};
use crate::claims::{Cases, Claim, all};
use crate::figures::shared::numbers;

/// A change by more than this share is one that a reader of the figure would see: a motor whose steady speed,
/// or whose stall torque over preload, is farther from the middle of its curve is off the trend, and a steady
/// speed that differs as much from the others is a sharp fall or rise.
const SHARP: f64 = 0.2;

/// Largest difference of a fitted exponent from 1 at which stall torque counts as proportional to preload,
/// and largest exponent of either sign (with two standard errors) at which the speed counts as independent of
/// it: over the 3.5-fold range of preloads both make 13 %.
const EXPONENT_WITHIN: f64 = 0.1;

/// An exponent of the stall torque above this is nearer to the trend (1) than to a plateau (0).
const NEARER_TO_TREND: f64 = 0.5;

/// The ends are one in so many of the motors below, and above, the preloads of the trends.
const OUTERMOST: usize = 4;

/// One curve: the behaviour of its motors inside the preloads of the measured trends, and beside them.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct Trend {
    frequency_hz: f64,
    amplitude_m: f64,
    /// The middle steady speed of all motors inside.
    median_speed_rad_per_s: f64,
    /// How many single orbits inside have a speed, a torque or both on the trend. One without a stall torque is off it.
    speed: Cases,
    torque: Cases,
    both: Cases,
    /// How many single orbits above the preload of the measured plateau have a torque nearer to the trend
    /// than to that plateau.
    no_plateau: Cases,
    /// Exponents of speed and torque inside, of all motors that have them: the median over all pairs of
    /// motors, which a few off the trend do not move.
    speed_exponent: Option<f64>,
    torque_exponent: Option<f64>,
    /// The same of the torque above the preload of the measured plateau: 1 on the trend, 0 on a plateau.
    high_torque_exponent: Option<f64>,
    /// How many single orbits below and above do not turn more slowly by a sharp change than the middle of
    /// those inside, and how many above not faster.
    no_fall: Cases,
    no_rise_above: Cases,
    /// Middle steady speed of the lowest and of the highest quarter of those beside the preloads of the
    /// trends, over that inside.
    outside_over_inside: [f64; 2],
}

/// The motors on a low-period cycle, and what those of a single flight do.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct Holes {
    motors: usize,
    pub(super) low_period: usize,
    pub(super) one_flight: usize,
    /// Smallest and largest fraction of Γ of the motors on a cycle of one flight, and the difference.
    one_flight_fractions: Option<[f64; 2]>,
    one_flight_window: Option<f64>,
    /// Slowest and fastest steady speed (rad/s) of these, of all motors on a low-period cycle, and of all
    /// others.
    one_flight_speeds_rad_per_s: Option<[f64; 2]>,
}

/// A motor: the mean of its ensemble, or the single orbit that nothing perturbs.
#[derive(Clone, Copy)]
struct Reading {
    preload_mn: f64,
    speed: f64,
    stall: Option<f64>,
}

impl Reading {
    fn mean(point: &Point) -> Self {
        let stall = point.statistics.stall_acceleration_rad_per_s2.map(|spread| spread.mean);
        Self { preload_mn: point.preload_mn, speed: mean_speed(point), stall }
    }

    fn single(point: &Point) -> Self {
        let (speed, stall) = (point.single_speed_rad_per_s, point.single_stall_rad_per_s2);
        Self { preload_mn: point.preload_mn, speed, stall }
    }

    fn stall_per_preload(&self) -> Option<f64> {
        self.stall.map(|stall| stall / self.preload_mn)
    }
}

/// Whether a speed, or a torque over preload, is no farther from the middle of its curve than a sharp change.
fn is_near(value: f64, middle: f64) -> bool {
    (value - middle).abs() <= SHARP * middle.abs()
}

/// Whether a speed over that inside the preloads of the trends is no sharp fall.
fn is_no_fall(ratio: f64) -> bool {
    ratio >= 1.0 - SHARP
}

/// Whether it is no sharp rise.
fn is_no_rise(ratio: f64) -> bool {
    ratio <= 1.0 + SHARP
}

fn is_near_exponent(exponent: Option<f64>, of: f64) -> bool {
    exponent.is_some_and(|exponent| (exponent - of).abs() <= EXPONENT_WITHIN)
}

impl Trend {
    pub(super) fn of(curve: &Curve, [from, to]: [f64; 2], plateau_mn: f64) -> Self {
        let every = || curve.points.iter().chain(&curve.further);
        let inside: Vec<&Point> =
            curve.points.iter().filter(|point| (from..=to).contains(&point.preload_mn)).collect();
        let below: Vec<&Point> = curve.points.iter().filter(|point| point.preload_mn < from).collect();
        let above: Vec<&Point> = every().filter(|point| point.preload_mn > to).collect();
        let high: Vec<&Point> = every().filter(|point| point.preload_mn > plateau_mn).collect();
        let means = |points: &[&Point]| points.iter().map(|point| Reading::mean(point)).collect::<Vec<_>>();
        let singles =
            |points: &[&Point]| points.iter().map(|point| Reading::single(point)).collect::<Vec<_>>();

        let median_speed = median(means(&inside).iter().map(|motor| motor.speed));
        let orbits = singles(&inside);
        let speed = median(orbits.iter().map(|motor| motor.speed));
        let stall_per_preload = median(orbits.iter().filter_map(Reading::stall_per_preload));
        let speed_holds = |motor: &Reading| is_near(motor.speed, speed);
        let torque_holds = |motor: &Reading| {
            motor.stall_per_preload().is_some_and(|value| is_near(value, stall_per_preload))
        };
        let ratios = |points: &[&Point]| singles(points).into_iter().map(move |motor| motor.speed / speed);
        // Only the outermost motors: a fall at the lowest preloads does not show in the middle one of all
        // below.
        let outermost = |points: &[&Point], sign: f64| {
            let mut motors = means(points);
            motors.sort_by(|one, other| (sign * one.preload_mn).total_cmp(&(sign * other.preload_mn)));
            let count = motors.len().div_ceil(OUTERMOST);
            median(motors.iter().take(count).map(|motor| motor.speed)) / median_speed
        };
        Self {
            frequency_hz: curve.frequency_hz,
            amplitude_m: curve.amplitude_m,
            median_speed_rad_per_s: median_speed,
            speed: Cases::of(orbits.iter().map(speed_holds)),
            torque: Cases::of(orbits.iter().map(torque_holds)),
            both: Cases::of(orbits.iter().map(|motor| speed_holds(motor) && torque_holds(motor))),
            no_plateau: Cases::of(singles(&high).iter().map(|motor| {
                // Halfway between the line through the origin and what the torque is where the plateau
                // begins.
                let halfway = 0.5 * stall_per_preload * (motor.preload_mn + plateau_mn);
                motor.stall.is_some_and(|stall| stall > halfway)
            })),
            speed_exponent: median_exponent(&means(&inside), |motor| Some(motor.speed)),
            torque_exponent: median_exponent(&means(&inside), |motor| motor.stall),
            high_torque_exponent: median_exponent(&means(&high), |motor| motor.stall),
            no_fall: Cases::of(ratios(&[below.clone(), above.clone()].concat()).map(is_no_fall)),
            no_rise_above: Cases::of(ratios(&above).map(is_no_rise)),
            outside_over_inside: [outermost(&below, 1.0), outermost(&above, -1.0)],
        }
    }
}

/// What the paper says of the trends. The means have exponents; a single motor has a distance from the middle of its curve.
pub(super) fn claims(trends: &[Trend], [first, second]: [f64; 2], plateau_mn: f64) -> Vec<Claim> {
    let at = |frequency_hz: f64| -> Vec<&Trend> {
        trends.iter().filter(|trend| trend.frequency_hz.total_cmp(&frequency_hz).is_eq()).collect()
    };
    let (default, second) = (at(first), at(second));
    let total =
        |trends: &[&Trend], of: fn(&Trend) -> Cases| trends.iter().map(|trend| of(trend)).sum::<Cases>();
    // By amplitude.
    let exponents = |trends: &[&Trend], of: fn(&Trend) -> Option<f64>| {
        let words = trends
            .iter()
            .map(|trend| of(trend).map_or_else(|| "none".to_owned(), |exponent| format!("{exponent:+.3}")));
        words.collect::<Vec<_>>().join(", ")
    };
    let ratios = |trends: &[&Trend]| {
        let words = trends
            .iter()
            .map(|Trend { outside_over_inside: [below, above], .. }| format!("{below:.3} and {above:.3}"));
        words.collect::<Vec<_>>().join(", ")
    };
    let percent = 100.0 * SHARP;
    let is_on_torque = |trend: &Trend| is_near_exponent(trend.torque_exponent, 1.0);
    let is_on_speed = |trend: &Trend| is_near_exponent(trend.speed_exponent, 0.0);
    vec![
        Claim::printed_statement(
            "section5.torque_proportional_to_preload",
            all(&default, |trend| is_on_torque(trend)),
            format!(
                "exponents by rising A: {}, within {EXPONENT_WITHIN} of 1; a single motor is within {percent} % of the middle torque over preload of its curve",
                exponents(&default, |trend| trend.torque_exponent),
            ),
        )
        .single_orbits(total(&default, |trend| trend.torque)),
        Claim::printed_statement(
            "section5.speed_independent_of_preload",
            all(&default, |trend| is_on_speed(trend)),
            format!(
                "exponents by rising A: {}, within {EXPONENT_WITHIN} of 0; a single motor is within {percent} % of the middle speed of its curve",
                exponents(&default, |trend| trend.speed_exponent),
            ),
        )
        .single_orbits(total(&default, |trend| trend.speed)),
        Claim::printed_statement(
            "section5.both_frequencies",
            all(default.iter().chain(&second), |trend| is_on_torque(trend) && is_on_speed(trend)),
            format!(
                "exponents at the second frequency by rising A: torque {}, speed {}; a single motor is on both trends",
                exponents(&second, |trend| trend.torque_exponent),
                exponents(&second, |trend| trend.speed_exponent),
            ),
        )
        .single_orbits([&default, &second].into_iter().map(|trends| total(trends, |trend| trend.both)).sum()),
        Claim::printed_statement(
            "section5.no_sharp_fall",
            all(default.iter().flat_map(|trend| trend.outside_over_inside), is_no_fall),
            format!(
                "middle speeds of the outer quarters below and above the trends' preloads over the one inside, by rising A: {}; sharp is {percent} %",
                ratios(&default),
            ),
        )
        .single_orbits(total(&default, |trend| trend.no_fall)),
        Claim::printed_statement(
            "section5.no_plateau",
            all(&default, |trend| trend.high_torque_exponent.is_some_and(|exponent| exponent > NEARER_TO_TREND)),
            format!(
                "exponents of the torque above {plateau_mn} mN by rising A: {}, 1 on the trend and 0 on a plateau; a single motor is nearer to the trend",
                exponents(&default, |trend| trend.high_torque_exponent),
            ),
        )
        .single_orbits(total(&default, |trend| trend.no_plateau)),
        Claim::printed_statement(
            "section5.no_sharp_rise",
            all(&second, |trend| is_no_rise(trend.outside_over_inside[1])),
            format!("middle speeds outside over inside the trends' preloads: {}", ratios(&second)),
        )
        .single_orbits(total(&second, |trend| trend.no_rise_above)),
    ]
}

impl Holes {
    pub(super) fn of(curves: &[Curve]) -> Self {
        let points: Vec<&Point> = curves.iter().flat_map(|curve| &curve.points).collect();
        let low: Vec<_> = points.iter().filter(|point| point.statistics.is_low_period()).collect();
        let one_flight = || low.iter().filter(|point| point.statistics.cycle.is_one_flight());
        let ends = |of: &dyn Fn(&Point) -> f64| {
            let (low, high) = numbers::extent(one_flight().map(|point| of(point)));
            (one_flight().count() > 0).then_some([low, high])
        };
        let fractions = ends(&|point| point.axial_forcing.rem_euclid(1.0));
        Self {
            motors: points.len(),
            low_period: low.len(),
            one_flight: one_flight().count(),
            one_flight_fractions: fractions,
            one_flight_window: fractions.map(|[least, most]| most - least),
            one_flight_speeds_rad_per_s: ends(&mean_speed),
        }
    }
}

fn mean_speed(point: &Point) -> f64 {
    point.statistics.steady_speed_rad_per_s.mean
}

/// The exponent of what `of` reads against preload.
fn median_exponent(motors: &[Reading], of: fn(&Reading) -> Option<f64>) -> Option<f64> {
    numbers::median_exponent(motors.iter().filter_map(|motor| Some((motor.preload_mn, of(motor)?))))
}

/// The middle one; zero of none.
fn median(values: impl Iterator<Item = f64>) -> f64 {
    numbers::median(values).unwrap_or(0.0)
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
                is_exponential: true,
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
