//! The computation of Fig. 14.

use super::data::Fig14Data;
use crate::experiment::ExperimentError;
use crate::figures::regression::StraightLine;
use crate::figures::synthetic::Noise;
use crate::figures::toss_case::TossCase;
use crate::claims::paper;
use crate::progress::Progress;

/// Frames per second of the synthetic record, and the standard deviation of its relative diameters: made up.
pub(super) const FRAMES_PER_S: f64 = 25.0;
pub(super) const SCATTER: f64 = 0.012;
pub(super) const SEED: u64 = 14;

pub(super) fn compute(progress: &dyn Progress) -> Result<Fig14Data, ExperimentError> {
    progress.start(1, "records");
    let printed = paper::dough_growth()?;
    let duration_s = printed.growth / printed.fit_slope_per_s;
    let [first, last] = printed.tosses.map(|toss| toss as u32);
    let tosses_between = last - first;
    let line = (printed.fit_start_s, printed.fit_slope_per_s, duration_s);
    let (synthetic, slope, error) = record(line, SEED).unwrap_or_default();
    progress.advance(1);
    let toss = TossCase::from(&paper::table_one()?);
    let larger = 1.0 + printed.growth / f64::from(tosses_between);
    Ok(Fig14Data {
        start_s: printed.fit_start_s,
        slope_per_s: printed.fit_slope_per_s,
        growth: printed.growth,
        duration_s,
        tosses_between,
        tosses_inclusive: tosses_between + 1,
        growth_per_toss_percent: 100.0 * printed.growth / f64::from(tosses_between),
        growth_per_toss_inclusive_percent: 100.0 * printed.growth / f64::from(tosses_between + 1),
        toss_start_s: (0..=tosses_between)
            .map(|k| {
                let share = f64::from(k) / f64::from(tosses_between);
                (first + k, printed.fit_start_s + share * duration_s)
            })
            .collect(),
        synthetic,
        synthetic_slope_per_s: slope,
        synthetic_slope_error_per_s: error,
        airborne_speed_change_rad_per_s: TossCase {
            gyration_radius_m: larger * toss.gyration_radius_m,
            ..toss
        }
        .airborne_speed()?
            - toss.airborne_speed()?,
        flight_spin_loss_percent: 100.0 * (1.0 - 1.0 / (larger * larger)),
        measured: None,
    })
}

/// A synthetic record, and the slope of the line through it over its value at the start, with its standard
/// error.
type Record = (Vec<(f64, f64)>, f64, f64);

/// A record on the line `1 + slope (t − start)` for `duration`.
fn record((start, slope, duration): (f64, f64, f64), seed: u64) -> Option<Record> {
    let mut noise = Noise::new(seed);
    let frames = (duration * FRAMES_PER_S) as u32;
    let points: Vec<_> = (0..=frames)
        .map(|frame| f64::from(frame) / FRAMES_PER_S)
        .map(|after| (start + after, (1.0 + slope * after) * (1.0 + SCATTER * noise.bell())))
        .collect();
    let line = StraightLine::through(&points)?;
    let (slope, error) = line.slope_over_value_at(start);
    Some((points, slope, error))
}
