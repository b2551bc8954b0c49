//! The trends of Fig. 11 over the preloads.

use bouncing_disk::core::elementary::ln;

use super::data::{Curve, Fig11Data, Point};
use crate::claim::Claim;
use crate::figures::motor_case::relative_range;
use crate::figures::regression::StraightLine;

/// Largest difference of a fitted exponent from 1 at which stall torque counts as proportional to preload.
const PROPORTIONAL_WITHIN: f64 = 0.1;

/// Largest exponent (of either sign, with two standard errors) at which the steady speed counts as relatively independent of the preload:
/// over the 3.5-fold range of preloads it then changes by 13 % at most.
const INDEPENDENT_WITHIN: f64 = 0.1;

/// A change of the steady speed by more than this share of its mean is sharp.
const SHARP: f64 = 0.2;

/// The points of a curve between the preloads of the trends; with or without those on a low-period cycle.
pub(super) fn in_range<'a>(data: &Fig11Data, curve: &'a Curve, with_locked: bool) -> Vec<&'a Point> {
    let [from, to] = data.trend_mn();
    let inside = curve.points.iter().filter(|point| (from..=to).contains(&point.preload_mn));
    inside.filter(|point| with_locked || !point.statistics.is_low_period()).collect()
}

/// The straight line through the logarithms of preload and of what `of` reads, and the relative range of that.
fn power_law(points: &[&Point], of: fn(&Point) -> Option<f64>) -> Option<(StraightLine, f64)> {
    let read: Vec<(f64, f64)> = points
        .iter()
        .filter_map(|point| of(point).map(|value| (point.preload_mn, value.abs())))
        .filter(|(_, value)| *value > 0.0)
        .collect();
    let logarithms: Vec<_> = read.iter().map(|(x, y)| (ln(*x), ln(*y))).collect();
    let values: Vec<_> = read.iter().map(|point| point.1).collect();
    StraightLine::through(&logarithms).map(|line| (line, relative_range(&values)))
}

pub(super) fn stall(point: &Point) -> Option<f64> {
    point.statistics.stall_acceleration_rad_per_s2.map(|spread| spread.mean)
}

pub(super) fn speed(point: &Point) -> Option<f64> {
    Some(point.statistics.steady_speed_rad_per_s.mean)
}

fn name(curve: &Curve) -> String {
    format!("{:e} m", curve.amplitude_m)
}

/// Whether the trends hold at one frequency, and the numbers.
pub(super) struct Trends {
    pub(super) proportional: bool,
    pub(super) stalls: String,
    pub(super) independent: bool,
    pub(super) speeds: String,
}

/// Proportional stall torque and constant speed.
pub(super) fn trends(data: &Fig11Data, frequency_hz: f64) -> Trends {
    let (mut proportional, mut independent) = (true, true);
    let (mut stalls, mut speeds) = (Vec::new(), Vec::new());
    for curve in at_frequency(data, frequency_hz) {
        let chaotic = in_range(data, curve, false);
        let all = in_range(data, curve, true);
        let left_out = all.len() - chaotic.len();
        match power_law(&chaotic, stall) {
            Some((line, _)) => {
                proportional &= (line.slope - 1.0).abs() <= PROPORTIONAL_WITHIN;
                stalls.push(format!(
                    "{}: {:.3} ± {:.3} (R² = {:.4}; {} points, {left_out} on a low-period cycle left out)",
                    name(curve),
                    line.slope,
                    line.slope_error,
                    line.explained,
                    chaotic.len(),
                ));
            }
            None => proportional = false,
        }
        match power_law(&chaotic, speed).zip(power_law(&all, speed)) {
            Some(((line, range), (_, full_range))) => {
                independent &= line.slope.abs() + 2.0 * line.slope_error <= INDEPENDENT_WITHIN;
                speeds.push(format!(
                    "{}: {:+.3} ± {:.3}, range {:.1} % of the mean ({:.1} % with the {left_out} on a low-period cycle)",
                    name(curve),
                    line.slope,
                    line.slope_error,
                    100.0 * range,
                    100.0 * full_range,
                ));
            }
            None => independent = false,
        }
    }
    Trends {
        proportional,
        stalls: format!("exponent of stall acceleration against preload: {}", stalls.join("; ")),
        independent,
        speeds: format!("exponent of steady speed against preload: {}", speeds.join("; ")),
    }
}

fn at_frequency(data: &Fig11Data, frequency_hz: f64) -> impl Iterator<Item = &Curve> {
    data.curves.iter().filter(move |curve| curve.frequency_hz.total_cmp(&frequency_hz).is_eq())
}

/// A preload against the range of the trends.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Place {
    Below,
    Inside,
    Above,
}

/// That no steady speed at the preloads `wanted` leaves the range of those inside by more than [`SHARP`] of their mean,
/// downwards for a negative `direction`.
pub(super) fn no_sharp_change(
    data: &Fig11Data,
    key: &str,
    frequency: usize,
    wanted: fn(Place) -> bool,
    direction: f64,
) -> Claim {
    let [from, to] = data.trend_mn();
    let place = |point: &Point| match point.preload_mn {
        preload if preload < from => Place::Below,
        preload if preload > to => Place::Above,
        _ => Place::Inside,
    };
    let mut holds = true;
    let mut words = Vec::new();
    for curve in at_frequency(data, data.printed.frequencies_hz[frequency]) {
        let speeds = |chosen: &dyn Fn(Place) -> bool| -> Vec<f64> {
            let chaotic = curve.points.iter().filter(|point| !point.statistics.is_low_period());
            chaotic.filter(|point| chosen(place(point))).filter_map(speed).collect()
        };
        let inside = speeds(&|place| place == Place::Inside);
        let outside = speeds(&wanted);
        let mean = inside.iter().sum::<f64>() / inside.len() as f64;
        let farthest =
            outside.iter().map(|speed| direction * (speed - mean)).fold(f64::NEG_INFINITY, f64::max);
        holds &= !outside.is_empty() && farthest <= SHARP * mean;
        let (slow, fast) = extent(&outside);
        words.push(format!("{}: {slow:.1} to {fast:.1} rad/s, mean inside {mean:.1}", name(curve)));
    }
    Claim::printed_statement(
        key,
        holds,
        format!(
            "steady speeds outside the range, motors on a low-period cycle left out: {}",
            words.join("; ")
        ),
    )
}

/// The exponent of the stall torque above the preload of the measured plateau: 0 there, 1 on the trend.
pub(super) fn plateau(data: &Fig11Data) -> Claim {
    let from = 1e3 * data.printed.plateau_n;
    let mut none = true;
    let mut words = Vec::new();
    for curve in at_frequency(data, data.printed.frequencies_hz[0]) {
        let high =
            curve.points.iter().filter(|point| point.preload_mn > from && !point.statistics.is_low_period());
        if let Some((line, _)) = power_law(&high.collect::<Vec<_>>(), stall) {
            none &= line.slope - 2.0 * line.slope_error > 0.0;
            words.push(format!("{}: {:.2} ± {:.2}", name(curve), line.slope, line.slope_error));
        }
    }
    Claim::printed_statement(
        "section5.no_plateau",
        none && !words.is_empty(),
        format!("exponent of stall acceleration against preload above {from} mN: {}", words.join("; ")),
    )
}

/// Smallest and largest value.
pub(super) fn extent(values: &[f64]) -> (f64, f64) {
    values
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(*value), high.max(*value)))
}
