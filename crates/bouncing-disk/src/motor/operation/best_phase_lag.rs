//! The phase lag at which a motor turns fastest.

use std::f64::consts::{PI, TAU};

use bouncing_disk_core::Observer;
use bouncing_disk_core::numerics::elementary::wrapped_angle;
use bouncing_disk_core::run::Watch;

use crate::error::Error;
use crate::motor::operation::loaded_motor::LoadedMotor;
use crate::motor::operation::point::Estimate;
use crate::motor::operation::settings::OperatingSettings;
use crate::motor::operation::steady_run::{Operations, operate};

/// Lags around the whole circle.
const COARSE: usize = 32;

/// Lags on either side of the best one, up to its second neighbours, in each further search.
const FINE: usize = 8;

/// Searches after the first, each with lags four times as near to each other, while no parabola goes through the speeds.
const SEARCHES: usize = 4;

/// The first search is at most so accurate.
const ROUGH: f64 = 0.03;

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
    let survey = motor.survey(&Watch::begin(observer, 0, settings.most_impacts)?)?;
    let motor = &LoadedMotor { surveyed: survey.as_ref(), first_only: motor.stator.acts_back(), ..*motor };
    let over = |lags: &[f64], settings: &OperatingSettings| -> Result<Operations, Error> {
        let motors = lags.iter().map(|&lag| motor.with_phase_lag(lag)).collect::<Result<Vec<_>, _>>()?;
        operate(&motors, settings, observer)
    };
    let rough = OperatingSettings { relative_error: settings.relative_error.max(ROUGH), ..*settings };
    let mut step = TAU / COARSE as f64;
    let coarse: Vec<f64> = (0..COARSE).map(|k| k as f64 * step).collect();
    let first = over(&coarse, &motor.for_search(&rough))?;
    let Some((index, speed)) = fastest(&first) else {
        return Err(Error::Overpowered { load: motor.load() });
    };
    if !motor.turns(speed) {
        return Err(Error::DoesNotTurn { speed: speed.value, standard_error: speed.standard_error });
    }
    let mut best = coarse[index];
    // Lag and speed of all that is known, the coarse ones once for each turn of the circle next to the best.
    let mean = |results: &Operations, k: usize| {
        results.rows[k].point().map_or(f64::NEG_INFINITY, |point| point.speed.value)
    };
    let mut means: Vec<(f64, f64)> = Vec::new();
    for turn in [-TAU, 0.0, TAU] {
        means.extend(coarse.iter().enumerate().map(|(k, lag)| (lag + turn, mean(&first, k))));
    }
    for _ in 0..SEARCHES {
        let part = 2.0 * step / FINE as f64;
        let offsets: Vec<f64> = (0..=2 * FINE).map(|k| part * (k as f64 - FINE as f64)).collect();
        let lags: Vec<f64> = offsets.iter().map(|offset| best + offset).collect();
        let found = over(&lags, &motor.for_search(settings))?;
        let offset = Estimate::of(&tops(&offsets, &found.speeds, 2.0 * step))?;
        means.retain(|(lag, _)| (lag - best).abs() > 2.0 * step + 0.5 * part);
        means.extend(lags.iter().enumerate().map(|(k, lag)| (*lag, mean(&found, k))));
        // The top of a curve that is no parabola is near its largest value.
        let Some((index, speed)) = fastest(&found) else { break };
        let fits = top_fits(&offsets, |k| mean(&found, k), speed.standard_error.max(FLAT * speed.value));
        if fits {
            // A curve that is no parabola has its top elsewhere by some share of what a narrower one says.
            let inner = FINE / 2..3 * FINE / 2 + 1;
            let narrow = top(&offsets[inner], |k| mean(&found, k + FINE / 2)).0;
            best += offset.value;
            // The top for rotors from above, or for coarser steps of a cycle, bounds the bias.
            let above = Estimate::of(&tops(&offsets, &found.speeds_from_above, 2.0 * step))?;
            step = offset.bounded_by(Estimate { value: narrow, ..offset }).bounded_by(above).standard_error;
            break;
        }
        best = lags[index];
        step = part;
    }
    let speed = match over(&[best], settings)?.rows[0].point() {
        Some(point) => point.speed,
        None => return Err(Error::Overpowered { load: motor.load() }),
    };
    means.sort_by(|one, other| one.0.total_cmp(&other.0));
    let least = 0.99 * speed.value;
    let centre = means.partition_point(|(lag, _)| *lag <= best);
    let last_good = |all: &mut dyn Iterator<Item = &(f64, f64)>| {
        let good = all.take_while(|(lag, speed)| *speed >= least && (lag - best).abs() <= WIDEST);
        good.last().map_or(best, |(lag, _)| *lag)
    };
    let low = last_good(&mut means[..centre].iter().rev());
    let high = last_good(&mut means[centre..].iter());
    let wrapped = wrapped_angle(best);
    let shift = if wrapped > PI { wrapped - TAU - best } else { wrapped - best };
    Ok(BestPhaseLag {
        phase_lag: Estimate { value: best + shift, standard_error: step },
        speed,
        good_from_to: [low + shift, high + shift],
    })
}

/// Largest range of good lags on either side (rad).
const WIDEST: f64 = TAU / 5.0;

/// A curve is known well enough where this share of the speed is.
const FLAT: f64 = 1.0e-6;

/// Whether the least-squares parabola goes through all values within three of this error.
fn top_fits(offsets: &[f64], value: impl Fn(usize) -> f64, error: f64) -> bool {
    let parabola = Parabola::through(offsets, &value);
    (0..offsets.len()).all(|k| (value(k) - parabola.at(offsets[k])).abs() <= 3.0 * error)
}

/// The index of the fastest motor, and its speed; `None` if all run away.
fn fastest(results: &Operations) -> Option<(usize, Estimate)> {
    let speeds = results.rows.iter().enumerate();
    speeds
        .filter_map(|(index, row)| row.point().map(|point| (index, point.speed)))
        .max_by(|one, other| one.1.value.total_cmp(&other.1.value))
}

/// The offset at which each member is fastest, within this size: each has a parabola of its own through all its speeds,
/// which share their perturbations. Where each lag has a motion of its own, some members of one may have come to another
/// motion.
fn tops(offsets: &[f64], speeds: &[Vec<f64>], within: f64) -> Vec<f64> {
    let members = speeds.iter().map(Vec::len).min().unwrap_or(0);
    (0..members).map(|member| top(offsets, |k| speeds[k][member]).0.clamp(-within, within)).collect()
}

/// Top (offset and height) of the least-squares parabola through values at offsets that are symmetric about
/// zero; where it has none, the largest value.
fn top(offsets: &[f64], value: impl Fn(usize) -> f64) -> (f64, f64) {
    let parabola = Parabola::through(offsets, &value);
    if parabola.curvature < 0.0 {
        let offset = -0.5 * parabola.slope / parabola.curvature;
        return (offset, parabola.at(offset));
    }
    let best = (0..offsets.len()).max_by(|one, other| value(*one).total_cmp(&value(*other))).unwrap_or(0);
    (offsets[best], value(best))
}

/// The least-squares parabola through values at offsets that are symmetric about zero.
struct Parabola {
    mean: f64,
    slope: f64,
    curvature: f64,
    /// Mean square of the offsets.
    square: f64,
}

impl Parabola {
    fn through(offsets: &[f64], value: &impl Fn(usize) -> f64) -> Self {
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
        Self { mean, slope: slope / second, curvature: curvature / fourth, square }
    }

    fn at(&self, x: f64) -> f64 {
        self.mean + self.slope * x + self.curvature * (x * x - self.square)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_top_of_a_parabola_is_found() {
        let offsets: Vec<f64> = (-8..=8).map(|k| 0.05 * f64::from(k)).collect();
        let (offset, height) = top(&offsets, |k| 7.0 - 3.0 * (offsets[k] - 0.123) * (offsets[k] - 0.123));
        assert!((offset - 0.123).abs() < 1e-14 && (height - 7.0).abs() < 1e-14, "{offset} {height}");
        let all: Vec<Vec<f64>> = offsets.iter().map(|x| vec![-(x - 0.1) * (x - 0.1); 4]).collect();
        let mut fewer = all.clone();
        fewer[3].pop();
        assert_eq!(
            (tops(&offsets, &all, 0.05), tops(&offsets, &fewer, 0.05)),
            (vec![0.05; 4], vec![0.05; 3])
        );
        // One that is open upwards has none.
        let (offset, height) = top(&offsets, |k| offsets[k] * offsets[k] + offsets[k]);
        assert!((offset - 0.4).abs() < 1e-15 && (height - 0.56).abs() < 1e-15, "{offset} {height}");
    }
}
