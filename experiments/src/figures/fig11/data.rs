//! The numbers of Fig. 11.

use bouncing_disk::{Spread, TransientSettings};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::bouncing::EndOfBouncing;
use super::measured::Measured;
use super::trends::{Holes, Trend};
use crate::experiment::{ExperimentError, Quality};
use crate::figures::motor_case::{MotorCase, MotorStatistics, PerturbationEffect, perturbation_table};
use crate::figures::stall::{Stall, net_share_at_rest};
use crate::figures::synthetic::Noise;
use crate::paper::{self, Preloads};
use crate::progress::Progress;

/// Duration of a transient in rise times ωΦ a_g²/(μ a_e g): seven time constants or more.
const RISES: f64 = 6.0;

/// Relaunch perturbations (g/ω) for which the results are compared: none, and all sizes that were tried.
const PERTURBATIONS: [f64; 8] = [0.0, 1e-9, 1e-7, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1];

/// Seed of the preloads.
const PRELOAD_SEED: u64 = 46_201;

/// Impacts of the orbit that gives a motor's S(0).
const BALANCED_IMPACTS: usize = 1_500;

/// Motors above the preloads of the trends for each curve beside those drawn: together at least 200 of them at each frequency.
const MORE_ABOVE: u32 = 52;

/// The share to which the stator's twist is reduced where a smaller one is looked at.
const REDUCED_TWIST: f64 = 0.5;

/// The data of Fig. 11.
#[derive(Debug, Serialize, Deserialize)]
pub struct Fig11Data {
    pub(super) motor: MotorCase,
    pub(super) printed: Preloads,
    /// Mass of the rotor, a solid steel ball.
    pub(super) rotor_mass_kg: f64,
    /// Members of an ensemble, by amplitude: the larger the amplitude, the fewer collisions a transient averages over, and the cheaper it is.
    pub(super) members: [usize; 3],
    pub(super) rises: f64,
    pub(super) relaunch_perturbation: f64,
    pub(super) preload_seed: u64,
    /// By frequency, then amplitude.
    pub(super) curves: Vec<Curve>,
    /// Of each curve.
    pub(super) trends: Vec<Trend>,
    /// The motors on a low-period cycle, of all curves.
    pub(super) holes: Holes,
    /// α̇_ss/t_c over (μ a_e g/a_g²) S(0), the least and the most between the preloads of the trends; motors on a low-period cycle left out.
    pub(super) estimate_over_balance: [f64; 2],
    /// Its mean over these motors.
    pub(super) mean_estimate_over_balance: f64,
    /// What stalls the default motor at the lowest, the middle and the highest preload of the trends, by frequency.
    pub(super) stalls: Vec<StallAt>,
    /// The default amplitude at the middle of these preloads, by frequency.
    pub(super) perturbations: Vec<Vec<PerturbationEffect>>,
    /// The default motor at full preload with the printed and with a smaller ωΦ.
    pub(super) reduced_twist: ReducedTwist,
    /// The motor at the second frequency with θ and with θ + π.
    pub(super) mirrored: Mirrored,
    pub(super) end_of_bouncing: EndOfBouncing,
    /// A user's own measurements.
    #[serde(default, skip_serializing_if = "Measured::is_empty")]
    pub(super) measured: Measured,
}

/// One amplitude at one frequency.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Curve {
    pub(super) frequency_hz: f64,
    pub(super) amplitude_m: f64,
    pub(super) points: Vec<Point>,
    /// Further motors above the preloads of the trends, which are not drawn: the statements about them shall rest on enough.
    pub(super) further: Vec<Point>,
}

/// One preload.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub(super) struct Point {
    pub(super) preload_acceleration_m_per_s2: f64,
    pub(super) preload_mn: f64,
    pub(super) axial_forcing: f64,
    pub(super) statistics: MotorStatistics,
    /// S(0): the share of the normal impulse that pushes a rotor held at rest forwards, minus the rest.
    pub(super) net_share_at_rest: f64,
}

/// The stall load at one preload.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub(super) struct StallAt {
    pub(super) frequency_hz: f64,
    pub(super) preload_mn: f64,
    pub(super) stall: Stall,
}

/// A motor whose stator twists less.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct ReducedTwist {
    /// ωΦ (rad/s), printed and reduced.
    pub(super) peak_angular_speeds_rad_per_s: [f64; 2],
    pub(super) steady_speeds_rad_per_s: [Spread; 2],
    pub(super) stall_accelerations_rad_per_s2: Option<[Spread; 2]>,
}

/// A motor and the same with the phase lag shifted by π.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Mirrored {
    pub(super) preload_mn: f64,
    pub(super) phase_lags_rad: [f64; 2],
    pub(super) steady_speeds_rad_per_s: [Spread; 2],
}

impl Fig11Data {
    /// The range of preloads (mN) of the measured trends.
    pub(super) fn trend_mn(&self) -> [f64; 2] {
        trend_mn(&self.printed)
    }

    /// m a_g² (kg m²), which makes a torque of an angular acceleration.
    pub(super) fn moment_of_inertia(&self) -> f64 {
        self.rotor_mass_kg * self.motor.gyration_radius_m * self.motor.gyration_radius_m
    }
}

/// The range of preloads (mN) of the measured trends.
fn trend_mn(printed: &Preloads) -> [f64; 2] {
    printed.measured_range_n.map(|preload| 1e3 * preload)
}

pub(super) fn run(quality: Quality, progress: &dyn Progress) -> Result<Fig11Data, ExperimentError> {
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
    progress.start((frequencies.len() * (amplitudes.len() + three_preloads.len() + 1)) as u64, "curves");

    let mut noise = Noise::new(PRELOAD_SEED);
    let (mut curves, mut perturbations, mut stalls) = (Vec::new(), Vec::new(), Vec::new());
    for frequency_hz in frequencies {
        for (amplitude_m, members) in amplitudes.into_iter().zip(members) {
            let case = MotorCase { frequency_hz, amplitude_m, ..motor };
            let [first, last] = printed.preload_accelerations_m_per_s2;
            let mut motors = |from: f64, count: u32| {
                let points = preloads([from, last], count, &mut noise)
                    .into_par_iter()
                    .map(|preload| {
                        let case = MotorCase { preload_acceleration_m_per_s2: preload, ..case };
                        point(&case, rotor_mass_kg, members, relaunch_perturbation)
                    })
                    .collect::<Vec<Result<Point, ExperimentError>>>();
                points.into_iter().collect::<Result<Vec<Point>, ExperimentError>>()
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
        let case = MotorCase { frequency_hz, preload_acceleration_m_per_s2: middle, ..motor };
        perturbations.push(perturbation_table(&case, &PERTURBATIONS, 2.0 * RISES, quality.choose(4, 24))?);
        progress.advance(1);
    }
    let trends: Vec<Trend> =
        curves.iter().map(|curve| Trend::of(curve, trend_mn(&printed), 1e3 * printed.plateau_n)).collect();
    let over_balance: Vec<f64> = curves
        .iter()
        .flat_map(|curve| &curve.points)
        .filter(|point| point.preload_acceleration_m_per_s2 >= low)
        .filter(|point| point.preload_acceleration_m_per_s2 <= high && !point.statistics.is_low_period())
        .filter_map(|point| {
            let estimate = point.statistics.stall_acceleration_rad_per_s2?.mean;
            let limit =
                MotorCase { preload_acceleration_m_per_s2: point.preload_acceleration_m_per_s2, ..motor }
                    .largest_acceleration();
            Some(estimate / (limit * point.net_share_at_rest))
        })
        .collect();
    let second = MotorCase { frequency_hz: frequencies[1], preload_acceleration_m_per_s2: middle, ..motor };
    Ok(Fig11Data {
        holes: Holes::of(&curves),
        estimate_over_balance: super::trends::extent(&over_balance).ok_or_else(|| no_data("stall torque"))?,
        mean_estimate_over_balance: over_balance.iter().sum::<f64>() / over_balance.len() as f64,
        reduced_twist: reduced_twist(&motor, quality.choose(4, 16), relaunch_perturbation)?,
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
        perturbations,
        measured: Measured::default(),
    })
}

fn no_data(quantity: &str) -> ExperimentError {
    ExperimentError::NoData { quantity: quantity.to_owned() }
}

fn point(
    case: &MotorCase,
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
    })
}

/// Preload accelerations over a range: its equal parts, and in each of them one, drawn evenly. Which values the authors took is not printed, and a motor's
/// orbit depends on it; a regular grid could meet or miss the preloads at which the motor is on a short cycle.
fn preloads([first, last]: [f64; 2], count: u32, noise: &mut Noise) -> Vec<f64> {
    (0..count)
        .map(|index| first + (last - first) * (f64::from(index) + noise.even()) / f64::from(count))
        .collect()
}

fn reduced_twist(
    motor: &MotorCase,
    members: usize,
    relaunch_perturbation: f64,
) -> Result<ReducedTwist, ExperimentError> {
    let twist = motor.peak_angular_speed_rad_per_s;
    let speeds = [twist, REDUCED_TWIST * twist];
    let statistics = |peak_angular_speed_rad_per_s: f64| {
        MotorCase { peak_angular_speed_rad_per_s, ..*motor }.statistics(RISES, members, relaunch_perturbation)
    };
    let [printed, reduced] = [statistics(speeds[0])?, statistics(speeds[1])?];
    Ok(ReducedTwist {
        peak_angular_speeds_rad_per_s: speeds,
        steady_speeds_rad_per_s: [printed.steady_speed_rad_per_s, reduced.steady_speed_rad_per_s],
        stall_accelerations_rad_per_s2: printed
            .stall_acceleration_rad_per_s2
            .zip(reduced.stall_acceleration_rad_per_s2)
            .map(|(printed, reduced)| [printed, reduced]),
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
