//! The phase lag at which a motor turns fastest.

use std::f64::consts::{PI, TAU};

use bouncing_disk_core::Observer;
use bouncing_disk_core::numerics::elementary::wrapped_angle;

use crate::error::Error;
use crate::motor::operation::point::Estimate;
use crate::motor::operation::settings::OperatingSettings;
use crate::motor::operation::steady_run::{LoadedMotor, Operations, operate};

/// Lags around the whole circle.
const COARSE: usize = 32;

/// Lags on either side of the best of these, up to its second neighbour.
const FINE: usize = 16;

/// The phase lag at which a motor turns fastest forwards, under its load.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct BestPhaseLag {
    /// The lag theta (rad), in (-pi, pi]. The other direction is best half a circle away.
    pub phase_lag: Estimate,
    /// The mean speed there (rad/s).
    pub speed: Estimate,
    /// The range of lags (rad) around it with at least 99 % of that speed, at most a fifth of a circle on
    /// either side: the tolerance of the lag. The first is below the second; they may lie beyond the circle.
    pub good_from_to: [f64; 2],
}

/// The best phase lag of a motor under the load that it has.
pub(crate) fn best_phase_lag(
    motor: &LoadedMotor<'_>,
    settings: &OperatingSettings,
    observer: &dyn Observer,
) -> Result<BestPhaseLag, Error> {
    let over = |lags: &[f64]| -> Result<Operations, Error> {
        let motors = lags.iter().map(|&lag| motor.with_phase_lag(lag)).collect::<Result<Vec<_>, _>>()?;
        operate(&motors, settings, observer)
    };
    let step = TAU / COARSE as f64;
    let coarse: Vec<f64> = (0..COARSE).map(|k| k as f64 * step).collect();
    let first = over(&coarse)?;
    let Some((best, speed)) = fastest(&first) else { return Err(Error::Overpowered { load: motor.load() }) };
    if !motor.turns(speed) {
        return Err(Error::DoesNotTurn { speed: speed.value, standard_error: speed.standard_error });
    }
    let offsets: Vec<f64> =
        (0..=2 * FINE).map(|k| 2.0 * step * (k as f64 - FINE as f64) / FINE as f64).collect();
    let fine: Vec<f64> = offsets.iter().map(|offset| coarse[best] + offset).collect();
    let second = over(&fine)?;
    // Each member has a parabola of its own through all its speeds: they share their perturbations.
    let members = second.speeds[0].len();
    let tops: Vec<(f64, f64)> = (0..members)
        .map(|member| top(&offsets, |k| second.speeds[k][member]))
        .map(|(offset, speed)| (offset.clamp(-2.0 * step, 2.0 * step), speed))
        .collect();
    let offset = Estimate::of(&tops.iter().map(|top| top.0).collect::<Vec<_>>())?;
    let speed = Estimate::of(&tops.iter().map(|top| top.1).collect::<Vec<_>>())?;
    let lag = coarse[best] + offset.value;
    let mean = |k: usize| second.rows[k].point().map_or(f64::NEG_INFINITY, |point| point.speed.value);
    // The fine lags inside, the coarse ones beyond them.
    let mut means: Vec<(f64, f64)> = (0..offsets.len()).map(|k| (fine[k], mean(k))).collect();
    for away in 3..=COARSE / 5 {
        let coarse_mean = |k: usize| first.rows[k % COARSE].point().map(|point| point.speed.value);
        let (up, down) = (best + away, best + COARSE - away);
        means.push((coarse[best] + away as f64 * step, coarse_mean(up).unwrap_or(f64::NEG_INFINITY)));
        means.push((coarse[best] - away as f64 * step, coarse_mean(down).unwrap_or(f64::NEG_INFINITY)));
    }
    means.sort_by(|one, other| one.0.total_cmp(&other.0));
    let centre = means.iter().rposition(|(other, _)| *other <= lag).unwrap_or(0);
    let least = 0.99 * speed.value;
    let (mut low, mut high) = (lag, lag);
    for (other, _) in means[..=centre].iter().rev().take_while(|(_, speed)| *speed >= least) {
        low = *other;
    }
    for (other, _) in means[centre + 1..].iter().take_while(|(_, speed)| *speed >= least) {
        high = *other;
    }
    let wrapped = wrapped_angle(lag);
    let shift = if wrapped > PI { wrapped - TAU - lag } else { wrapped - lag };
    Ok(BestPhaseLag {
        phase_lag: Estimate { value: lag + shift, standard_error: offset.standard_error },
        speed,
        good_from_to: [low + shift, high + shift],
    })
}

/// The index of the fastest motor, and its speed; `None` if all run away.
fn fastest(results: &Operations) -> Option<(usize, Estimate)> {
    let speeds = results.rows.iter().enumerate();
    speeds
        .filter_map(|(index, row)| row.point().map(|point| (index, point.speed)))
        .max_by(|one, other| one.1.value.total_cmp(&other.1.value))
}

/// Top (offset and height) of the least-squares parabola through values at offsets that are symmetric about
/// zero; where it has none, the largest value.
fn top(offsets: &[f64], value: impl Fn(usize) -> f64) -> (f64, f64) {
    let count = offsets.len() as f64;
    let square = offsets.iter().map(|x| x * x).sum::<f64>() / count;
    let (mut mean, mut slope, mut curvature, mut fourth, mut second) = (0.0, 0.0, 0.0, 0.0, 0.0);
    for (k, x) in offsets.iter().enumerate() {
        let (y, even) = (value(k), x * x - square);
        mean += y / count;
        slope += x * y;
        second += x * x;
        curvature += even * y;
        fourth += even * even;
    }
    let (slope, curvature) = (slope / second, curvature / fourth);
    if curvature < 0.0 {
        let offset = -0.5 * slope / curvature;
        return (offset, mean + slope * offset + curvature * (offset * offset - square));
    }
    let best = (0..offsets.len()).max_by(|one, other| value(*one).total_cmp(&value(*other))).unwrap_or(0);
    (offsets[best], value(best))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_top_of_a_parabola_is_found() {
        let offsets: Vec<f64> = (-8..=8).map(|k| 0.05 * f64::from(k)).collect();
        let (offset, height) = top(&offsets, |k| 7.0 - 3.0 * (offsets[k] - 0.123) * (offsets[k] - 0.123));
        assert!((offset - 0.123).abs() < 1e-14 && (height - 7.0).abs() < 1e-14, "{offset} {height}");
        // One that is open upwards has none.
        let (offset, height) = top(&offsets, |k| offsets[k] * offsets[k] + offsets[k]);
        assert!((offset - 0.4).abs() < 1e-15 && (height - 0.56).abs() < 1e-15, "{offset} {height}");
    }
}
