//! The computation of the figure.

use std::f64::consts::PI;

use bouncing_disk::{Estimate, Motor, OperatingPoint, OperatingSettings, Operation, operations};

use super::data::{Best, ExtraEfficiencyData};
use crate::experiment::{ExperimentError, Quality};
use crate::figures::operating_curve::Curve;
use crate::progress::Progress;

/// Seed of the ensemble that checks the best cell.
pub(super) const OTHER_SEED: u64 = 2;

/// The phase lags reach this far to either side: as far as a motor turns forwards, and a little more.
const FARTHEST_LAG: f64 = 0.6 * PI;

/// The highest load of the map, as a share of the largest torque.
const LAST_SHARE: f64 = 0.8;

/// Lags whose counterparts half a circle away are looked at.
const MIRRORED: usize = 6;

pub(super) fn compute(
    quality: Quality,
    progress: &dyn Progress,
) -> Result<ExtraEfficiencyData, ExperimentError> {
    let motor = Motor::paper_70_khz();
    let settings = OperatingSettings {
        relative_error: quality.choose(0.03, 0.015),
        members: quality.choose(8, 16),
        most_impacts: quality.choose(2_000_000, 40_000_000),
        ..OperatingSettings::default()
    };
    progress.start(4, "ensembles");
    let (columns, rows) = quality.choose((25, 12), (73, 41));
    let phase_lags_rad: Vec<f64> =
        (0..columns).map(|k| FARTHEST_LAG * (2.0 * k as f64 / (columns - 1) as f64 - 1.0)).collect();
    let load_shares: Vec<f64> = (0..rows).map(|k| LAST_SHARE * k as f64 / (rows - 1) as f64).collect();
    let cells = load_shares.iter().flat_map(|share| phase_lags_rad.iter().map(move |lag| (*lag, *share)));
    let motors = cells.map(|(lag, share)| at(&motor, lag, share)).collect::<Result<Vec<_>, _>>()?;
    let map = operations(&motors, &settings)?;
    progress.advance(1);
    let points: Vec<Option<&OperatingPoint>> = map.iter().map(Operation::point).collect();
    let matrix = |of: fn(&OperatingPoint) -> Option<f64>| -> Vec<Vec<Option<f64>>> {
        points.chunks(columns).map(|row| row.iter().map(|point| point.and_then(of)).collect()).collect()
    };
    let best = best(&motor, &motors, &map, &settings, (&phase_lags_rad, columns), &load_shares)?;
    progress.advance(1);
    let at_best = at(&motor, best.phase_lag_rad, 0.0)?;
    let fine = quality.choose(16, 48);
    let shares: Vec<f64> = (0..=fine).map(|k| LAST_SHARE * f64::from(k) / f64::from(fine)).collect();
    let along_load = Curve::of(&at_best, &shares, &settings)?;
    progress.advance(1);
    let mirrored = mirrored(&motor, &settings)?;
    progress.advance(1);
    Ok(ExtraEfficiencyData {
        motor,
        settings,
        power_ratios: matrix(power_ratio),
        speeds_rad_per_s: matrix(|point| Some(point.speed.value)),
        unsettled: map.iter().filter(|operation| operation.steady().is_none()).count(),
        largest_energy_residual: points
            .iter()
            .flatten()
            .chain(&along_load.points.iter().collect::<Vec<_>>())
            .map(|point| point.energy_residual.abs())
            .fold(0.0, f64::max),
        phase_lags_rad,
        load_shares,
        best,
        along_load,
        mirrored,
    })
}

/// The motor with this lag under this share of the largest torque.
fn at(motor: &Motor, phase_lag: f64, share: f64) -> Result<Motor, bouncing_disk::Error> {
    let largest = motor.largest_torque();
    motor.with(|sheet| {
        sheet.phase_lag = phase_lag;
        sheet.load_torque = share * largest;
    })
}

/// Mechanical power over the power put in.
fn power_ratio(point: &OperatingPoint) -> Option<f64> {
    let input = point.input_power.value;
    (input > 0.0).then(|| point.mechanical_power.value / input)
}

fn best(
    motor: &Motor,
    motors: &[Motor],
    map: &[Operation],
    settings: &OperatingSettings,
    (lags, columns): (&[f64], usize),
    shares: &[f64],
) -> Result<Best, ExperimentError> {
    let efficiency = |operation: &Operation| operation.point().and_then(|point| point.efficiency);
    let no_data = || ExperimentError::NoData { quantity: "best efficiency".to_owned() };
    let (index, found) = map
        .iter()
        .enumerate()
        .filter_map(|(index, operation)| efficiency(operation).map(|found| (index, found)))
        .max_by(|one, other| one.1.value.total_cmp(&other.1.value))
        .ok_or_else(no_data)?;
    let other = OperatingSettings { seed: OTHER_SEED, ..*settings };
    let load = motors[index].load_torque();
    let again = at(motor, lags[index % columns], 0.0)?.operating_point(load, &other)?;
    Ok(Best {
        phase_lag_rad: lags[index % columns],
        load_share: shares[index / columns],
        efficiency: found,
        again: efficiency(&again).ok_or_else(no_data)?,
        other_seed: OTHER_SEED,
    })
}

/// Speeds without load at some lags and half a circle away from them.
fn mirrored(motor: &Motor, settings: &OperatingSettings) -> Result<Vec<[Estimate; 2]>, ExperimentError> {
    let lags = (0..MIRRORED).map(|k| PI * k as f64 / MIRRORED as f64);
    let motors =
        lags.flat_map(|lag| [lag, lag + PI]).map(|lag| at(motor, lag, 0.0)).collect::<Result<Vec<_>, _>>()?;
    let speeds: Vec<Estimate> = operations(&motors, settings)?
        .iter()
        .filter_map(|operation| operation.point().map(|point| point.speed))
        .collect();
    Ok(speeds.as_chunks::<2>().0.to_vec())
}
