//! Quantity off the sweeps of Fig. 13.

use bouncing_disk::core::numerics::elementary::{cos, ln};

use super::data::{Fig13Data, Parameter, Sweep, SweepPoint};
use crate::figures::numbers::StraightLine;
pub(super) use crate::figures::numbers::extent;

pub(super) fn sweep_points(data: &Fig13Data) -> impl Iterator<Item = &SweepPoint> {
    data.sweeps.iter().flat_map(|sweep| &sweep.points)
}

pub(super) fn sweep(data: &Fig13Data, parameter: Parameter) -> Option<&Sweep> {
    data.sweeps.iter().find(|sweep| sweep.parameter == parameter)
}

/// The quantity of a point: the steady speed in rad/s, or the stall acceleration.
pub(super) type Quantity = fn(&SweepPoint) -> Option<f64>;

pub(super) fn speed(point: &SweepPoint) -> Option<f64> {
    Some(point.statistics.steady_speed_rad_per_s.mean)
}

/// How far α̇_ss/t_c is above the largest acceleration that friction gives, as a share of it.
pub(super) fn stall_over_limit(data: &Fig13Data, parameter: Parameter, point: &SweepPoint) -> Option<f64> {
    let limit = parameter.set(&data.motor, point.value).largest_acceleration();
    Some(point.stall()?.abs() / limit)
}

pub(super) fn stall(point: &SweepPoint) -> Option<f64> {
    point.stall()
}

/// All points drawn, those on a low-period cycle among them, as (value, quantity).
pub(super) fn read(data: &Fig13Data, parameter: Parameter, of: Quantity) -> Vec<(f64, f64)> {
    let points = sweep(data, parameter).map_or(&[][..], |sweep| &sweep.points);
    points.iter().filter_map(|point| of(point).map(|value| (point.value, value))).collect()
}

/// How many of the points of a sweep a low-period cycle governs, in words.
pub(super) fn low_period_words(data: &Fig13Data, parameter: Parameter) -> String {
    let points = sweep(data, parameter).map_or(&[][..], |sweep| &sweep.points);
    let low = points.iter().filter(|point| point.statistics.is_low_period()).count();
    format!("{low} of {} motors on a low-period cycle", points.len())
}

/// y = c cos θ by least squares: c, and the share of the variance that it explains. `None` of fewer than
/// three points.
pub(super) fn cosine_fit(points: &[(f64, f64)]) -> Option<(f64, f64)> {
    if points.len() < 3 {
        return None;
    }
    let (mut products, mut squares) = (0.0, 0.0);
    for (angle, value) in points {
        products += cos(*angle) * value;
        squares += cos(*angle) * cos(*angle);
    }
    let factor = products / squares;
    let mean = points.iter().map(|point| point.1).sum::<f64>() / points.len() as f64;
    let (mut rest, mut all) = (0.0, 0.0);
    for (angle, value) in points {
        let (off, from_mean) = (value - factor * cos(*angle), value - mean);
        rest += off * off;
        all += from_mean * from_mean;
    }
    Some((factor, 1.0 - rest / all))
}

/// By how much a quantity changes over the range of a parameter: along a straight line, of A in its
/// logarithm, of θ along a cosine.
pub(super) fn trend_change(parameter: Parameter, points: &[(f64, f64)]) -> Option<f64> {
    let (first, last) = (points.first()?.0, points.last()?.0);
    match parameter {
        Parameter::PhaseLag => cosine_fit(points).map(|fit| 2.0 * fit.0),
        Parameter::Amplitude => {
            let logarithms: Vec<_> = points.iter().map(|(x, y)| (ln(*x), *y)).collect();
            Some(StraightLine::through(&logarithms)?.slope * (ln(last) - ln(first)))
        }
        _ => Some(StraightLine::through(points)?.slope * (last - first)),
    }
}

pub(super) fn words(line: Option<StraightLine>) -> String {
    line.map_or_else(|| "no fit".to_owned(), |line| format!("{:+.3} ± {:.3}", line.slope, line.slope_error))
}
