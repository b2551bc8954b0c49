//! The computation of Fig. 13.

use std::f64::consts::{FRAC_PI_4, PI};

use bouncing_disk::core::elementary::{ln, pow};
use bouncing_disk::{ExponentialFit, TransientSettings};

use super::data::{
    AlikeMotors, Draw, Fig13Data, ImpulsePhases, Parameter, PerturbedMotor, Prevalence, Sweep, SweepPoint,
};
use crate::claim::Agreement;
use crate::experiment::{ExperimentError, Quality};
use crate::figures::alike::{AlikeMotor, alike};
use crate::figures::impulse::Impulses;
use crate::figures::motor_case::{MotorCase, perturbation_table};
use crate::figures::printed_inputs::{DRAWN, PrintedInputs};
use crate::figures::regression::StraightLine;
use crate::figures::samples;
use crate::paper;
use crate::progress::Progress;

/// Duration of a transient in rise times ωΦ a_g²/(μ a_e g).
const RISES: f64 = 6.0;
/// The perturbation (g/ω) with which each sweep is repeated.
const BREAKING_PERTURBATION: f64 = 0.1;
/// Sizes (g/ω) that are compared.
const PERTURBATIONS: [f64; 7] = [1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-9, 0.0];
/// Another ε for which the sizes are compared: one where low-period cycles govern.
const LOW_PERIOD_RESTITUTION: f64 = 0.3;
/// ε of the distributions of impulse.
const RESTITUTIONS: [f64; 3] = [0.2, 0.5, 0.8];
/// Parts of the cycle in these distributions.
const PARTS: usize = 48;
/// Largest ε of a sweep.
const LARGEST_RESTITUTION: f64 = 0.9;
/// Seed of the inputs that print alike.
const SEED: u64 = 13;
/// Numbers of flights for which the share of cycles is counted.
const FLIGHT_COUNTS: [usize; 5] = [2, 4, 8, 16, 32];
/// A cycle is short if it takes this share of the rise time.
const SHORT_CYCLE: f64 = 0.01;
pub(super) fn run(quality: Quality, progress: &dyn Progress) -> Result<Fig13Data, ExperimentError> {
    let section = paper::section_five()?;
    let motor = MotorCase::default_of(&paper::table_three()?, &section);
    let members = quality.choose(4, 16);
    let impacts = quality.choose(4_000, 40_000);
    let relaunch_perturbation = TransientSettings::default().relaunch_perturbation;
    let grids = Parameter::ALL.map(|parameter| values(parameter, &section.amplitudes_of_fig10_m, quality));
    progress.start(grids.iter().map(|grid| grid.len() as u64).sum::<u64>() + 3, "motors");

    let mut sweeps = Vec::new();
    for (parameter, grid) in Parameter::ALL.into_iter().zip(grids) {
        let mut points = Vec::new();
        for value in grid {
            let case = parameter.set(&motor, value);
            let system = case.system()?;
            let impulses = Impulses::of(system.dimensionless().map(), impacts, relaunch_perturbation)?;
            let count = impulses.impacts.len() as f64;
            let speeds = impulses.impacts.iter().map(|(_, impulse)| impulse / (1.0 + case.restitution));
            let mean_impact_speed_m_per_s = system.scales().velocity * speeds.sum::<f64>() / count;
            let (predicted_speed_ratio, predicted_stall_acceleration_rad_per_s2) = predict(&case, &impulses);
            points.push(SweepPoint {
                value,
                peak_angular_speed_rad_per_s: case.peak_angular_speed_rad_per_s,
                statistics: case.statistics(RISES, members, relaunch_perturbation)?,
                broken: case.statistics(RISES, members, BREAKING_PERTURBATION)?,
                predicted_speed_ratio,
                predicted_stall_acceleration_rad_per_s2,
                mean_impact_speed_m_per_s,
                mean_impact_interval_s: system.scales().time * impulses.duration / count,
                impulse_share_near_zero: impulses.share_near_zero(FRAC_PI_4),
            });
            progress.advance(1);
        }
        sweeps.push(Sweep { parameter, points });
    }
    let impulses = RESTITUTIONS
        .iter()
        .map(|&restitution| {
            let case = MotorCase { restitution, ..motor };
            let map = *case.system()?.dimensionless().map();
            let impulses = Impulses::of(&map, 5 * impacts, BREAKING_PERTURBATION)?;
            let contact: f64 = impulses.contact.iter().map(|(_, impulse)| impulse).sum();
            Ok(ImpulsePhases {
                restitution,
                shares: impulses.histogram(PARTS),
                share_near_zero: impulses.share_near_zero(FRAC_PI_4),
                impulse: impulses.concentration(),
                collisions: impulses.concentration_of_collisions(),
                contact_share: contact / impulses.total(),
            })
        })
        .collect::<Result<Vec<_>, ExperimentError>>()?;
    progress.advance(1);
    let alike = alike_motors(quality)?;
    progress.advance(1);
    let perturbations = [motor.restitution, LOW_PERIOD_RESTITUTION]
        .into_iter()
        .map(|restitution| {
            let case = MotorCase { restitution, ..motor };
            let effects = perturbation_table(&case, &PERTURBATIONS, 2.0 * RISES, 2 * members)?;
            Ok(PerturbedMotor { restitution, effects })
        })
        .collect::<Result<Vec<_>, ExperimentError>>()?;
    progress.advance(1);
    Ok(Fig13Data {
        default: motor.statistics(RISES, 2 * members, relaunch_perturbation)?,
        motor,
        members,
        rises: RISES,
        relaunch_perturbation,
        breaking_perturbation: BREAKING_PERTURBATION,
        sweeps,
        impulses,
        alike,
        perturbations,
    })
}

/// The values of a sweep. The paper's ranges are not in its text; A runs over its three amplitudes.
fn values(parameter: Parameter, amplitudes: &[f64; 3], quality: Quality) -> Vec<f64> {
    let even = |first: f64, last: f64, count: u32| -> Vec<f64> {
        (0..count).map(|index| first + (last - first) * f64::from(index) / f64::from(count - 1)).collect()
    };
    match parameter {
        Parameter::Friction => even(0.02, 0.4, quality.choose(5, 20)),
        Parameter::Restitution => even(0.0, LARGEST_RESTITUTION, quality.choose(7, 19)),
        Parameter::PhaseLag => even(-PI, PI, quality.choose(9, 25)),
        Parameter::Amplitude => {
            let ratio = amplitudes[2] / amplitudes[0];
            even(0.0, 1.0, quality.choose(5, 25))
                .iter()
                .map(|share| amplitudes[0] * pow(ratio, *share))
                .collect()
        }
        Parameter::PeakAngularSpeed => even(5.0, 60.0, quality.choose(4, 12)),
    }
}

/// Steady speed over ωΦ and stall acceleration of the transient that the impulses give, fitted as the ensembles are.
fn predict(case: &MotorCase, impulses: &Impulses) -> (f64, Option<f64>) {
    let levels = impulses.levels(case.phase_lag_rad);
    let (times, speeds) = levels.transient(RISES, 240);
    let fit = ExponentialFit::new(&times, &speeds).ok();
    let stall = fit
        .filter(|fit| fit.time_constant < 0.5 * RISES && fit.residual < 0.25 * fit.steady_speed.abs())
        .map(|fit| case.largest_acceleration() * fit.stall_acceleration());
    (levels.steady_speed(), stall)
}

/// The motors of Table III, every input but ε anywhere between what still rounds to the printed one.
fn alike_motors(quality: Quality) -> Result<AlikeMotors, ExperimentError> {
    let inputs = PrintedInputs::table_three()?;
    let count = quality.choose(DRAWN / 5, DRAWN);
    let steps = quality.choose(4, 10);
    let mut restitutions = Vec::new();
    let mut motors: Vec<Vec<AlikeMotor>> = Vec::new();
    for step in 0..steps {
        let restitution = LARGEST_RESTITUTION * f64::from(step) / f64::from(steps - 1);
        restitutions.push(restitution);
        motors.push(alike(&inputs.restitution(restitution).drawn(count, SEED), RISES)?);
    }
    let amplitudes = [
        "section5.smallest_amplitude_of_fig10",
        "section5.middle_amplitude_of_fig10",
        "section5.largest_amplitude_of_fig10",
    ];
    let by_amplitude = amplitudes
        .iter()
        .map(|key| alike(&inputs.amplitude(key)?.drawn(count, SEED), RISES))
        .collect::<Result<Vec<_>, ExperimentError>>()?;
    let rise = |motor: &MotorCase| motor.rise_time_s();
    let rises: Vec<f64> = inputs.drawn(count, SEED).iter().map(rise).collect();
    Ok(AlikeMotors {
        inputs: inputs.words(),
        drawn: count,
        prevalence: restitutions
            .iter()
            .zip(&motors)
            .map(|(&restitution, motors)| prevalence(restitution, motors, &rises))
            .collect(),
        draws: (0..count)
            .map(|index| {
                draw(
                    &restitutions,
                    motors.iter().map(|motors| &motors[index]),
                    by_amplitude.iter().map(|motors| &motors[index]),
                )
            })
            .collect(),
    })
}

/// Steady speed over ωΦ. Each of these motors has the ωΦ that was drawn for it.
fn speed_ratio(motor: &AlikeMotor) -> f64 {
    motor.steady_speed_rad_per_s / motor.peak_angular_speed_rad_per_s
}

fn draw<'a>(
    restitutions: &[f64],
    motors: impl Iterator<Item = &'a AlikeMotor> + Clone,
    by_amplitude: impl Iterator<Item = &'a AlikeMotor> + Clone,
) -> Draw {
    let line = |of: fn(&AlikeMotor) -> Option<f64>| {
        let points = restitutions.iter().zip(motors.clone());
        let points: Vec<_> = points.filter_map(|(x, motor)| of(motor).map(|y| (*x, y))).collect();
        StraightLine::through(&points)
    };
    let range = restitutions.last().zip(restitutions.first()).map_or(0.0, |(last, first)| last - first);
    let exponent = |of: fn(&AlikeMotor) -> Option<f64>| {
        let points = by_amplitude.clone().filter_map(|motor| {
            of(motor).filter(|value| *value > 0.0).map(|value| (ln(motor.amplitude_m), ln(value)))
        });
        StraightLine::through(&points.collect::<Vec<_>>()).map(|line| line.slope)
    };
    let largest =
        |of: fn(&AlikeMotor) -> Option<f64>| motors.clone().filter_map(of).fold(f64::NEG_INFINITY, f64::max);
    let speed = |motor: &AlikeMotor| Some(speed_ratio(motor));
    let stall = |motor: &AlikeMotor| motor.stall_over_limit;
    Draw {
        speed_ratio_slope: line(speed).map(|line| line.slope),
        stall_over_limit_slope: line(stall).map(|line| line.slope),
        stall_over_limit_rise: line(stall).map(|line| line.slope * range / line.intercept),
        largest_stall_over_limit: largest(stall),
        largest_speed_ratio: largest(speed),
        share_of_exponential: motors.clone().filter(|motor| motor.is_exponential()).count() as f64
            / restitutions.len() as f64,
        speed_amplitude_exponent: exponent(speed),
        stall_amplitude_exponent: exponent(stall),
    }
}

fn prevalence(restitution: f64, motors: &[AlikeMotor], rises: &[f64]) -> Prevalence {
    let count = motors.len() as f64;
    let share_where = |holds: &dyn Fn(usize, &AlikeMotor) -> bool| {
        motors.iter().enumerate().filter(|(index, motor)| holds(*index, motor)).count() as f64 / count
    };
    let mut flights: Vec<usize> =
        motors.iter().map(|motor| motor.cycle.chattering_flights().unwrap_or(usize::MAX)).collect();
    flights.sort_unstable();
    let share = |most: usize| flights.partition_point(|flights| *flights <= most) as f64 / count;
    let median = |of: fn(&AlikeMotor) -> Option<f64>| samples::median(motors.iter().filter_map(of));
    Prevalence {
        restitution,
        share_of_low_period: share_where(&|_, motor| motor.cycle.is_low_period()),
        share_up_to: FLIGHT_COUNTS.iter().map(|&count| (count, share(count))).collect(),
        share_of_short: share_where(&|index, motor| {
            motor
                .cycle
                .platform_periods()
                .is_some_and(|periods| periods as f64 / motor.frequency_hz <= SHORT_CYCLE * rises[index])
        }),
        median_flights: flights.get(flights.len() / 2).copied().filter(|flights| *flights < usize::MAX),
        within_limit: Agreement::of(
            motors.iter().filter_map(|motor| motor.stall_over_limit).map(|stall| stall <= 1.0),
        ),
        median_speed_ratio: median(|motor| Some(speed_ratio(motor))).unwrap_or_default(),
        median_stall_over_limit: median(|motor| motor.stall_over_limit),
    }
}
