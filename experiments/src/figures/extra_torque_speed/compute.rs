//! The computation of the figure.

use bouncing_disk::{
    FitSettings, IntervalEstimate, Motor, OperatingSettings, Operation, TransientFit, TransientSettings,
    ensemble,
};

use super::data::{DrawnPeak, ExtraTorqueSpeedData, Overload, Transient, TrueStall};
use crate::experiment::{ExperimentError, Quality};
use crate::figures::motor_case::MotorCase;
use crate::figures::operating_curve::{Curve, Peak, mean_of};
use crate::figures::stall::Stall;
use crate::paper;
use crate::progress::Progress;

/// The highest load of the curve, as a share of the largest torque. Beyond it the motor is driven back faster and faster, and
/// needs ever longer to settle.
const LAST_SHARE: f64 = 0.8;

/// Shares of the largest torque that no motor holds.
const OVERLOADS: [f64; 3] = [1.0, 1.02, 1.2];

/// The top of the power is that of a parabola through the points above this share of it.
const TOP: f64 = 0.85;

/// Duration of the transients in rise times ωΦ a_g²/(μ a_e g).
const RISES: f64 = 8.0;

/// The last part of the transients, of which the speed is that of a motor that has settled: what an exponential with their
/// time constant lacks there is a thousandth.
const SETTLED: f64 = 0.25;

pub(super) fn compute(
    quality: Quality,
    progress: &dyn Progress,
) -> Result<ExtraTorqueSpeedData, ExperimentError> {
    let motor = Motor::paper_70_khz();
    let settings = OperatingSettings {
        relative_error: quality.choose(0.02, 0.0075),
        members: quality.choose(8, 16),
        most_impacts: quality.choose(10_000_000, 200_000_000),
        ..OperatingSettings::default()
    };
    let repeats = quality.choose(4_u64, 6);
    progress.start(repeats + 4, "ensembles");
    let count = quality.choose(16, 48);
    let shares: Vec<f64> = (0..=count).map(|k| LAST_SHARE * f64::from(k) / f64::from(count)).collect();
    let curve = Curve::of(&motor, &shares, &settings)?;
    progress.advance(1);
    let drawn_peak = drawn_peak(&curve).ok_or_else(|| no_data("peak power"))?;
    let seeds: Vec<u64> = (1..=repeats).map(|k| settings.seed + k).collect();
    let mut tops = Vec::new();
    for &seed in &seeds {
        let other = Curve::of(&motor, &shares, &OperatingSettings { seed, ..settings })?;
        tops.push(other.top(TOP).ok_or_else(|| no_data("peak power"))?);
        progress.advance(1);
    }
    let stall = true_stall(&motor, &settings, settings.seed + repeats + 1)?;
    progress.advance(1);
    let transient = transient(&motor, quality.choose(12, 64))?;
    progress.advance(1);
    let case = MotorCase::default_of(&paper::table_three()?, &paper::section_five()?);
    let by_impulses = Stall::of(&case, quality.choose(8, 32), settings.relaunch_perturbation)?;
    progress.advance(1);
    Ok(ExtraTorqueSpeedData {
        motor,
        settings,
        largest_torque_n_m: motor.largest_torque(),
        overloads: overloads(&motor, &settings)?,
        curve,
        stall,
        peaks: Peak::of(seeds, &tops).ok_or_else(|| no_data("peak power"))?,
        drawn_peak,
        transient,
        by_impulses,
    })
}

fn no_data(quantity: &str) -> ExperimentError {
    ExperimentError::NoData { quantity: quantity.to_owned() }
}

fn drawn_peak(curve: &Curve) -> Option<DrawnPeak> {
    let (load_torque_n_m, power_w) = curve.top(TOP)?;
    let distance = |load: f64| (load - load_torque_n_m).abs();
    let nearest = curve
        .points
        .iter()
        .min_by(|one, other| distance(one.load_torque).total_cmp(&distance(other.load_torque)))?;
    let standard_error_w = nearest.mechanical_power.standard_error;
    Some(DrawnPeak { load_torque_n_m, power_w, standard_error_w })
}

fn overloads(motor: &Motor, settings: &OperatingSettings) -> Result<Vec<Overload>, ExperimentError> {
    let loads = OVERLOADS.map(|share| share * motor.largest_torque());
    let operations = motor.torque_speed_curve(&loads, settings)?;
    Ok(operations
        .iter()
        .map(|operation| Overload {
            load_torque_n_m: operation.load_torque(),
            runs_away: matches!(operation, Operation::Runaway { .. }),
        })
        .collect())
}

fn true_stall(
    motor: &Motor,
    settings: &OperatingSettings,
    other_seed: u64,
) -> Result<TrueStall, ExperimentError> {
    let stall = motor.stall_load(settings)?;
    let other = OperatingSettings { seed: other_seed, ..*settings };
    let speed = |load: f64| {
        let operation = motor.operating_point(load, &other)?;
        let point = operation.point().ok_or_else(|| no_data("speed at the stall load"))?;
        Ok::<_, ExperimentError>(point.speed)
    };
    let [low, high] = stall.bracket;
    Ok(TrueStall {
        torque_n_m: stall.torque,
        share: stall.share,
        bracket_n_m: stall.bracket,
        speeds_at_bracket_rad_per_s: [speed(low)?, speed(high)?],
        other_seed,
    })
}

fn transient(motor: &Motor, members: usize) -> Result<Transient, ExperimentError> {
    let system = motor.system();
    let duration_s = RISES * system.rise_time();
    let settings = TransientSettings { duration: duration_s, intervals: 240, ..TransientSettings::default() };
    let runs = ensemble(system, &settings, members)?;
    let fit = TransientFit::new(&runs.curves, &FitSettings::default())?;
    let settled =
        runs.curves.iter().map(|curve| curve.mean_over_last(SETTLED)).collect::<Result<Vec<_>, _>>()?;
    let IntervalEstimate { value, low, high } = fit.stall_acceleration();
    let inertia = motor.inertia();
    Ok(Transient {
        members,
        duration_s,
        steady_speed_rad_per_s: fit.steady_speed(),
        settled_speed_rad_per_s: mean_of(settled.into_iter()).ok_or_else(|| no_data("settled speed"))?,
        stall_estimate_n_m: IntervalEstimate {
            value: inertia * value,
            low: inertia * low,
            high: inertia * high,
        },
    })
}
