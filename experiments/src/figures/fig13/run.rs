//! The computation of Fig. 13.

use std::f64::consts::{FRAC_PI_4, PI};

use bouncing_disk::core::ChatterPolicy;
use bouncing_disk::core::elementary::pow;
use bouncing_disk::{ExponentialFit, TransientSettings};

use super::data::{Fig13Data, ImpulsePhases, Parameter, PerturbedMotor, Prevalence, Sweep, SweepPoint};
use crate::experiment::{ExperimentError, Quality};
use crate::figures::impulse::Impulses;
use crate::figures::motor_case::{MotorCase, perturbation_table};
use crate::paper;
use crate::progress::Progress;

/// Duration of a transient in rise times ωΦ a_g²/(μ a_e g).
const RISES: f64 = 6.0;
/// The perturbation (g/ω) with which each sweep is repeated.
const BREAKING_PERTURBATION: f64 = 0.1;
/// Sizes (g/ω) that are compared.
const PERTURBATIONS: [f64; 6] = [1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-9];
/// Another ε for which the sizes are compared: one where low-period cycles govern.
const LOW_PERIOD_RESTITUTION: f64 = 0.3;
/// ε of the distributions of impulse.
const RESTITUTIONS: [f64; 3] = [0.2, 0.5, 0.8];
/// Parts of the cycle in these distributions.
const PARTS: usize = 48;
/// Largest ε of the prevalence; beyond, cycles are longer than what is examined.
const LARGEST_PREVALENCE: f64 = 0.65;
/// Numbers of flights for which the share of cycles is counted.
const FLIGHT_COUNTS: [usize; 5] = [2, 4, 8, 16, 32];
/// A cycle is short if it takes this share of the rise time.
const SHORT_CYCLE: f64 = 0.01;
/// The amplitudes of the prevalence round to the default one: relative half width.
const AMPLITUDE_HALF_WIDTH: f64 = 0.05;

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
                contact_share: contact / impulses.total(),
            })
        })
        .collect::<Result<Vec<_>, ExperimentError>>()?;
    progress.advance(1);
    let prevalence = (0..)
        .map(|index| 0.05 * f64::from(index))
        .take_while(|restitution| *restitution < LARGEST_PREVALENCE + 0.01)
        .map(|restitution| prevalence(&MotorCase { restitution, ..motor }, quality.choose(24, 400)))
        .collect::<Result<Vec<_>, _>>()?;
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
        prevalent_below_restitution: paper::value("section5.low_period_restitution")?,
        members,
        rises: RISES,
        relaunch_perturbation,
        breaking_perturbation: BREAKING_PERTURBATION,
        sweeps,
        impulses,
        prevalence,
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
        Parameter::Restitution => even(0.0, 0.9, quality.choose(7, 19)),
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

fn prevalence(case: &MotorCase, amplitudes: u32) -> Result<Prevalence, ExperimentError> {
    let mut flights = Vec::new();
    let mut short = 0;
    for index in 0..amplitudes {
        let share = (f64::from(index) + 0.5) / f64::from(amplitudes);
        let amplitude_m = case.amplitude_m * (1.0 + AMPLITUDE_HALF_WIDTH * (2.0 * share - 1.0));
        let cycle = MotorCase { amplitude_m, ..*case }.cycle(ChatterPolicy::Complete)?;
        let seconds = cycle.platform_periods().map(|periods| periods as f64 / case.frequency_hz);
        short += usize::from(seconds.is_some_and(|seconds| seconds <= SHORT_CYCLE * case.rise_time_s()));
        flights.push(cycle.flights().unwrap_or(usize::MAX));
    }
    flights.sort_unstable();
    let share =
        |count: usize| flights.partition_point(|flights| *flights <= count) as f64 / flights.len() as f64;
    Ok(Prevalence {
        restitution: case.restitution,
        amplitudes: flights.len(),
        share_up_to: FLIGHT_COUNTS.iter().map(|&count| (count, share(count))).collect(),
        share_of_short: short as f64 / flights.len() as f64,
        median_flights: flights.get(flights.len() / 2).copied().filter(|flights| *flights < usize::MAX),
    })
}
