//! The computation of the figure.

use bouncing_disk::core::Unobserved;
use std::f64::consts::PI;

use bouncing_disk::{Motor, MotorRegime, TrapVerdict, low_period_traps};
use rayon::prelude::*;

use super::data::{Checked, ExtraTrapsData, Map, SingleFlight, TrappedShare};
use crate::experiment::{ExperimentError, Quality};
use crate::figures::synthetic::Noise;
use crate::paper;
use crate::progress::Progress;

/// Seed of the motors whose regime is found in another way.
pub(super) const SEED: u64 = 17;

/// Γ of the second map.
const FORCINGS: [f64; 2] = [12.0, 14.0];

/// Restitutions of the second map.
const RESTITUTIONS: [f64; 2] = [0.02, 0.9];

pub(super) fn compute(quality: Quality, progress: &dyn Progress) -> Result<ExtraTrapsData, ExperimentError> {
    let motor = Motor::paper_70_khz();
    let (rows, columns) = quality.choose((24, 80), (64, 400));
    let whole_forcings: Vec<u32> = (1..=rows).collect();
    let forcing_fractions = middles([0.0, 1.0], columns);
    let (high, wide) = quality.choose((24, 80), (120, 400));
    let (axial_forcings, restitutions) = (middles(FORCINGS, wide), middles(RESTITUTIONS, high));
    progress.start(u64::from(rows) + high as u64 + 2, "rows");
    let by_fraction = map(progress, &whole_forcings, |whole| {
        let forcings = forcing_fractions.iter().map(|fraction| f64::from(*whole) + fraction);
        verdicts(&motor, forcings)
    })?;
    let by_restitution = map(progress, &restitutions, |restitution| {
        let motor = motor.with(|sheet| sheet.restitution = *restitution)?;
        verdicts(&motor, axial_forcings.iter().copied())
    })?;
    let checked = checked(&motor, quality.choose(60, 400))?;
    progress.advance(1);
    let share_of_fig11 = shares(&motor, quality.choose(400, 4_000))?;
    progress.advance(1);
    Ok(ExtraTrapsData {
        single_flight: single_flight(&by_fraction, &forcing_fractions),
        motor,
        whole_forcings,
        forcing_fractions,
        by_fraction,
        axial_forcings,
        restitutions,
        by_restitution,
        checked,
        share_of_fig11,
    })
}

/// The middles of equal parts of a range.
fn middles([from, to]: [f64; 2], count: usize) -> Vec<f64> {
    (0..count).map(|k| from + (to - from) * (k as f64 + 0.5) / count as f64).collect()
}

/// Verdicts on a motor with the preloads that give these Γ.
fn verdicts(motor: &Motor, forcings: impl Iterator<Item = f64>) -> Result<Vec<TrapVerdict>, ExperimentError> {
    let peak = motor.system().platform().peak_acceleration();
    let preloads: Vec<f64> = forcings.map(|forcing| peak / (PI * forcing)).collect();
    Ok(low_period_traps(motor, &preloads, &Unobserved)?)
}

/// The rows of a map, in parallel and in their order.
fn map<T: Sync>(
    progress: &dyn Progress,
    rows: &[T],
    verdicts: impl Fn(&T) -> Result<Vec<TrapVerdict>, ExperimentError> + Sync,
) -> Result<Map, ExperimentError> {
    let rows: Vec<Result<Vec<TrapVerdict>, ExperimentError>> = rows
        .par_iter()
        .map(|row| {
            let done = verdicts(row);
            progress.advance(1);
            done
        })
        .collect();
    let mut map = Map::default();
    for row in rows {
        let row = row?;
        map.long_flights
            .push(row.iter().map(|verdict| verdict.cycle.map_or(0, |cycle| cycle.long_flights)).collect());
        map.is_trap.push(row.iter().map(|verdict| verdict.is_trap).collect());
    }
    Ok(map)
}

fn single_flight(map: &Map, fractions: &[f64]) -> Option<SingleFlight> {
    let of_row = |row: usize| -> Vec<f64> {
        let cells = map.long_flights[row].iter().zip(&map.is_trap[row]).zip(fractions);
        cells.filter(|((flights, is_trap), _)| **flights == 1 && **is_trap).map(|(_, at)| *at).collect()
    };
    let rows: Vec<Vec<f64>> =
        (0..map.is_trap.len()).map(of_row).filter(|fractions| !fractions.is_empty()).collect();
    let all = || rows.iter().flatten().copied();
    let last = rows.last()?;
    let (first, end) = (*last.first()?, *last.last()?);
    Some(SingleFlight {
        rows: rows.len(),
        least_fraction: all().fold(f64::INFINITY, f64::min),
        most_fraction: all().fold(0.0, f64::max),
        last_middle: 0.5 * (first + end),
        last_half_width: 0.5 * (end - first + 1.0 / fractions.len() as f64),
    })
}

/// Motors with Γ and restitution drawn at random, whose regime is that of the report.
fn checked(motor: &Motor, motors: usize) -> Result<Checked, ExperimentError> {
    let mut noise = Noise::new(SEED);
    let peak = motor.system().platform().peak_acceleration();
    let cases = (0..motors)
        .map(|_| {
            let forcing = 2.0 + 14.0 * noise.even();
            let restitution = 0.05 + 0.6 * noise.even();
            motor.with(|sheet| {
                sheet.preload_acceleration = Some(peak / (PI * forcing));
                sheet.restitution = restitution;
            })
        })
        .collect::<Result<Vec<Motor>, _>>()?;
    let found: Vec<Result<(bool, bool), ExperimentError>> = cases
        .par_iter()
        .map(|motor| {
            let regime = motor.report(&Unobserved)?.regime;
            Ok((motor.trap_verdict()?.is_trap, matches!(regime, MotorRegime::LowPeriodChattering(_))))
        })
        .collect();
    let found = found.into_iter().collect::<Result<Vec<_>, _>>()?;
    Ok(Checked {
        motors,
        trapped: found.iter().filter(|(trap, _)| *trap).count(),
        agreeing: found.iter().filter(|(trap, regime)| trap == regime).count(),
    })
}

/// How many of the preloads of Fig. 11, on a regular grid, are trapped.
fn shares(motor: &Motor, motors: usize) -> Result<Vec<TrappedShare>, ExperimentError> {
    let section = paper::section_five()?;
    let ends = paper::preloads()?.preload_accelerations_m_per_s2;
    let preloads = middles(ends, motors);
    section
        .amplitudes_of_fig10_m
        .into_iter()
        .map(|amplitude_m| {
            let motor = motor.with(|sheet| sheet.amplitude = amplitude_m)?;
            let peak = motor.system().platform().peak_acceleration();
            let trapped = low_period_traps(&motor, &preloads, &Unobserved)?;
            Ok(TrappedShare {
                amplitude_m,
                preloads_m_per_s2: ends,
                forcings: [ends[1], ends[0]].map(|preload| peak / (PI * preload)),
                motors,
                trapped: trapped.iter().filter(|verdict| verdict.is_trap).count(),
            })
        })
        .collect()
}
