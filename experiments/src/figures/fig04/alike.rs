//! The printed numbers of Sec. III B over tosses whose inputs all round to those of Table I.

use bouncing_disk::InitialSpin;

use super::data::{PrintedShare, TossPoint};
use super::sweep::{best_angle, speed};
use crate::experiment::{ExperimentError, Quality};
use crate::figures::printed_inputs::{DRAWN, agreement, tosses};

/// Seed of the tosses.
pub(super) const SEED: u64 = 4;

pub(super) fn alike(quality: Quality) -> Result<Vec<PrintedShare>, ExperimentError> {
    let rest = InitialSpin::AbsoluteRest;
    let cases = tosses(quality.choose(DRAWN / 5, DRAWN), SEED)?;
    let speeds = cases.iter().map(|case| case.airborne_speed()).collect::<Result<Vec<_>, _>>()?;
    let fastest = cases.iter().map(|case| best_angle(case, rest, speed)).collect::<Result<Vec<_>, _>>()?;
    let share = |key: &str, values: &mut dyn Iterator<Item = f64>| {
        Ok::<_, ExperimentError>(PrintedShare { key: key.to_owned(), agreement: agreement(key, values)? })
    };
    let of = |key: &str, read: fn(&TossPoint) -> f64| share(key, &mut fastest.iter().map(read));
    Ok(vec![
        share("section3.predicted_airborne_speed", &mut speeds.into_iter())?,
        of("section3.optimal_amplitude_angle", |toss| toss.amplitude_angle_rad)?,
        of("section3.largest_airborne_speed", |toss| toss.airborne_speed_rad_per_s)?,
        of("section3.largest_efficiency", |toss| toss.efficiency)?,
        of("section3.speed_ratio_at_optimum", |toss| toss.speed_ratio.unwrap_or(f64::NAN))?,
    ])
}
