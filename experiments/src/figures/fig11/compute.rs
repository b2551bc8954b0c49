//! The computation of Fig. 11.

use bouncing_disk::estimate::Spread;
use bouncing_disk::motor::TransientSettings;
use rayon::prelude::*;

use super::data::{
    Curve, EndOfBouncing, Fig11Data, Holes, MeasuredMotors, Mirrored, Point, ReducedTwist, StallAt, Trend,
    trend_mn,
};
use super::trends;
use crate::claims::Cases;
use crate::claims::paper;
use crate::experiment::{ExperimentError, Quality};
use crate::figures::alike::{AlikeMotor, alike};
use crate::figures::motor_case::MotorCase;
use crate::figures::numbers::Noise;
use crate::figures::printed_inputs::{DRAWN, PrintedInputs};
use crate::figures::stall::{Stall, net_share_at_rest};
use crate::progress::Progress;

/// Duration of a transient in rise times ωΦ a_g²/(μ a_e g): seven time constants or more.
const RISES: f64 = 6.0;

/// Seed of the preloads.
pub(super) const PRELOAD_SEED: u64 = 46_201;

/// Impacts of the orbit that gives a motor's S(0).
const BALANCED_IMPACTS: usize = 1_500;

/// Motors above the preloads of the trends for each curve beside those drawn: together at least 200 of them
/// at each frequency.
const MORE_ABOVE: u32 = 52;

/// The share to which the stator's twist is reduced, to see the effect of a smaller one.
const REDUCED_TWIST: f64 = 0.5;

pub(super) fn compute(quality: Quality, progress: &dyn Progress) -> Result<Fig11Data, ExperimentError> {
    let printed = paper::preloads()?;
    let section = paper::section_five()?;
    let motor = MotorCase::default_of(&paper::table_three()?, &section);
    let rotor_mass_kg = section.rotor_mass_kg();
    let members = quality.choose([2, 3, 6], [3, 6, 24]);
    let relaunch_perturbation = TransientSettings::default().relaunch_perturbation;
    let count = quality.choose(20, 112);
    let frequencies = printed.frequencies_hz;
    let amplitudes = section.amplitudes_of_fig10_m;
    let [low, high] = printed.measured_range_n.map(|preload| preload / rotor_mass_kg);
    let three_preloads = [low, 0.5 * (low + high), high];
    let [_, middle, _] = three_preloads;
    progress.start((frequencies.len() * (amplitudes.len() + three_preloads.len())) as u64, "curves");

    let mut noise = Noise::new(PRELOAD_SEED);
    let (mut curves, mut stalls) = (Vec::new(), Vec::new());
    for frequency_hz in frequencies {
        for (amplitude_m, members) in amplitudes.into_iter().zip(members) {
            let case = MotorCase { frequency_hz, amplitude_m, ..motor };
            let [first, last] = printed.preload_accelerations_m_per_s2;
            let mut motors = |from: f64, count: u32| {
                let cases: Vec<MotorCase> = preloads([from, last], count, &mut noise)
                    .map(|preload| MotorCase { preload_acceleration_m_per_s2: preload, ..case })
                    .collect();
                let single = alike(&cases, RISES)?;
                let points = cases.par_iter().zip(single).map(|(case, single)| {
                    point(case, &single, rotor_mass_kg, members, relaunch_perturbation)
                });
                points.collect::<Vec<_>>().into_iter().collect::<Result<Vec<Point>, ExperimentError>>()
            };
            let (points, further) = (motors(first, count)?, motors(high, quality.choose(4, MORE_ABOVE))?);
            curves.push(Curve { frequency_hz, amplitude_m, points, further });
            progress.advance(1);
        }
        for preload in three_preloads {
            let case = MotorCase { frequency_hz, preload_acceleration_m_per_s2: preload, ..motor };
            stalls.push(StallAt {
                frequency_hz,
                preload_mn: 1e3 * rotor_mass_kg * preload,
                stall: Stall::of(&case, quality.choose(4, 16), relaunch_perturbation)?,
            });
            progress.advance(1);
        }
    }
    let trends: Vec<Trend> =
        curves.iter().map(|curve| Trend::of(curve, trend_mn(&printed), 1e3 * printed.plateau_n)).collect();
    let over_balance = estimates_over_balance(&curves, &motor, [low, high]);
    let second = MotorCase { frequency_hz: frequencies[1], preload_acceleration_m_per_s2: middle, ..motor };
    Ok(Fig11Data {
        holes: Holes::of(&curves),
        estimate_over_balance: trends::extent(&over_balance).ok_or_else(|| no_data("stall torque"))?,
        mean_estimate_over_balance: over_balance.iter().sum::<f64>() / over_balance.len() as f64,
        reduced_twist: reduced_twist(
            &motor,
            quality.choose(4, 16),
            quality.choose(DRAWN / 10, DRAWN),
            relaunch_perturbation,
        )?,
        mirrored: mirrored(&second, rotor_mass_kg, members[1], relaunch_perturbation)?,
        end_of_bouncing: EndOfBouncing::of(&motor)?,
        motor,
        printed,
        rotor_mass_kg,
        members,
        rises: RISES,
        relaunch_perturbation,
        preload_seed: PRELOAD_SEED,
        curves,
        trends,
        stalls,
        measured: MeasuredMotors::default(),
    })
}

/// α̇_ss/t_c over (μ a_e g/a_g²) S(0) of the motors between two preloads that are on no low-period cycle.
fn estimates_over_balance(curves: &[Curve], motor: &MotorCase, [low, high]: [f64; 2]) -> Vec<f64> {
    curves
        .iter()
        .flat_map(|curve| &curve.points)
        .filter(|point| point.preload_acceleration_m_per_s2 >= low)
        .filter(|point| point.preload_acceleration_m_per_s2 <= high && !point.statistics.is_low_period())
        .filter_map(|point| {
            let estimate = point.statistics.stall_acceleration_rad_per_s2?.mean;
            let limit =
                MotorCase { preload_acceleration_m_per_s2: point.preload_acceleration_m_per_s2, ..*motor }
                    .largest_acceleration();
            Some(estimate / (limit * point.net_share_at_rest))
        })
        .collect()
}

fn no_data(quantity: &str) -> ExperimentError {
    ExperimentError::NoData { quantity: quantity.to_owned() }
}

fn point(
    case: &MotorCase,
    single: &AlikeMotor,
    mass: f64,
    members: usize,
    relaunch_perturbation: f64,
) -> Result<Point, ExperimentError> {
    let preload = case.preload_acceleration_m_per_s2;
    Ok(Point {
        preload_acceleration_m_per_s2: preload,
        preload_mn: 1e3 * mass * preload,
        axial_forcing: case.system()?.axial_forcing(),
        statistics: case.statistics(RISES, members, relaunch_perturbation)?,
        net_share_at_rest: net_share_at_rest(case, BALANCED_IMPACTS, relaunch_perturbation)?,
        single_speed_rad_per_s: single.steady_speed_rad_per_s,
        single_stall_rad_per_s2: single.stall_over_limit.map(|share| share * case.largest_acceleration()),
    })
}

/// Preload accelerations over a range: its equal parts, and in each of them one, drawn evenly. Which values
/// the authors took is not printed, and a motor's orbit depends on it; a regular grid could meet or miss the
/// preloads at which the motor is on a short cycle.
fn preloads([first, last]: [f64; 2], count: u32, noise: &mut Noise) -> impl Iterator<Item = f64> {
    (0..count).map(move |index| first + (last - first) * (f64::from(index) + noise.even()) / f64::from(count))
}

fn reduced_twist(
    motor: &MotorCase,
    members: usize,
    drawn: usize,
    relaunch_perturbation: f64,
) -> Result<ReducedTwist, ExperimentError> {
    let twist = motor.peak_angular_speed_rad_per_s;
    let speeds = [twist, REDUCED_TWIST * twist];
    let statistics = |peak_angular_speed_rad_per_s: f64| {
        MotorCase { peak_angular_speed_rad_per_s, ..*motor }.statistics(RISES, members, relaunch_perturbation)
    };
    let [printed, reduced] = [statistics(speeds[0])?, statistics(speeds[1])?];
    let single = PrintedInputs::table_three()?.drawn(drawn, PRELOAD_SEED);
    let orbits = |peak_angular_speed_rad_per_s: f64| {
        let with = |motor: &MotorCase| MotorCase { peak_angular_speed_rad_per_s, ..*motor };
        alike(&single.iter().map(with).collect::<Vec<_>>(), RISES)
    };
    let pairs = orbits(speeds[0])?.into_iter().zip(orbits(speeds[1])?);
    let slower =
        Cases::of(pairs.map(|(one, other)| other.steady_speed_rad_per_s < one.steady_speed_rad_per_s));
    Ok(ReducedTwist {
        peak_angular_speeds_rad_per_s: speeds,
        steady_speeds_rad_per_s: [printed.steady_speed_rad_per_s, reduced.steady_speed_rad_per_s],
        stall_accelerations_rad_per_s2: printed
            .stall_acceleration_rad_per_s2
            .zip(reduced.stall_acceleration_rad_per_s2)
            .map(|(printed, reduced)| [printed, reduced]),
        slower,
    })
}

fn mirrored(
    motor: &MotorCase,
    mass: f64,
    members: usize,
    relaunch_perturbation: f64,
) -> Result<Mirrored, ExperimentError> {
    let lags = [motor.phase_lag_rad, motor.phase_lag_rad + std::f64::consts::PI];
    let speed = |phase_lag_rad: f64| -> Result<Spread, ExperimentError> {
        let case = MotorCase { phase_lag_rad, ..*motor };
        Ok(case.statistics(RISES, members, relaunch_perturbation)?.steady_speed_rad_per_s)
    };
    Ok(Mirrored {
        preload_mn: 1e3 * mass * motor.preload_acceleration_m_per_s2,
        phase_lags_rad: lags,
        steady_speeds_rad_per_s: [speed(lags[0])?, speed(lags[1])?],
    })
}
