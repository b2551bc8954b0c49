//! Reading off the sweeps of Fig. 13.

use bouncing_disk::core::elementary::ln;

use super::data::{Fig13Data, Parameter, Sweep, SweepPoint};
use crate::figures::regression::StraightLine;
pub(super) use crate::figures::samples::extent;

pub(super) fn sweep_points(data: &Fig13Data) -> impl Iterator<Item = &SweepPoint> {
    data.sweeps.iter().flat_map(|sweep| &sweep.points)
}

pub(super) fn sweep(data: &Fig13Data, parameter: Parameter) -> Option<&Sweep> {
    data.sweeps.iter().find(|sweep| sweep.parameter == parameter)
}

/// What is read from a point: the steady speed in rad/s, or the stall acceleration.
pub(super) type Reading = fn(&SweepPoint) -> Option<f64>;

pub(super) fn speed(point: &SweepPoint) -> Option<f64> {
    Some(point.statistics.steady_speed_rad_per_s.mean)
}

pub(super) fn stall(point: &SweepPoint) -> Option<f64> {
    point.stall()
}

/// All points drawn, those on a low-period cycle among them, as (value, reading).
pub(super) fn read(data: &Fig13Data, parameter: Parameter, of: Reading) -> Vec<(f64, f64)> {
    let points = sweep(data, parameter).map_or(&[][..], |sweep| &sweep.points);
    points.iter().filter_map(|point| of(point).map(|value| (point.value, value))).collect()
}

/// How many of the points of a sweep a low-period cycle governs, in words.
pub(super) fn low_period_words(data: &Fig13Data, parameter: Parameter) -> String {
    let points = sweep(data, parameter).map_or(&[][..], |sweep| &sweep.points);
    let low = points.iter().filter(|point| point.statistics.is_low_period()).count();
    format!("{low} of {} motors on a low-period cycle", points.len())
}

/// The values below which a tenth of the readings lies, and above which a tenth does: isolated motors on a short cycle lie outside.
pub(super) fn tenths(values: &[f64]) -> Option<(f64, f64)> {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let last = sorted.len().checked_sub(1)?;
    let at = |share: f64| sorted[(share * last as f64).round() as usize];
    Some((at(0.1), at(0.9)))
}

/// Elasticity: the exponent of a power law through all positive points.
pub(super) fn elasticity(data: &Fig13Data, parameter: Parameter, of: Reading) -> Option<StraightLine> {
    let points: Vec<(f64, f64)> = read(data, parameter, of)
        .into_iter()
        .filter(|(value, reading)| *value > 0.0 && *reading > 0.0)
        .map(|(value, reading)| (ln(value), ln(reading)))
        .collect();
    StraightLine::through(&points)
}

pub(super) fn words(line: Option<StraightLine>) -> String {
    line.map_or_else(|| "no fit".to_owned(), |line| format!("{:+.3} ± {:.3}", line.slope, line.slope_error))
}
