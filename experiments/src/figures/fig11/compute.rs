//! The computation of Fig. 11, and what becomes of a bouncing rotor when its stator vibrates too little to throw it (Γ < 1/π).
//!
//! A rotor at rest is not thrown then, by Eq. (3). One that bounces already need not come to rest: the period-1 orbit needs Γ > (1 − ε)/(1 + ε) only,
//! which is less than 1/π for ε > (π − 1)/(π + 1).

use std::f64::consts::{FRAC_1_PI, PI, TAU};

use bouncing_disk::core::numerics::elementary::acos;
use bouncing_disk::core::run::in_parallel;
use bouncing_disk::core::{ChatterPolicy, ImpactMap, Launch, OrbitEvent, Phase};
use bouncing_disk::motor::TransientSettings;

use super::data::{
    Coexisting, Curve, EndOfBouncing, Fig11Data, Holes, Point, ReducedTwist, StallAt, Trend, trend_mn,
};
use super::trends;
use crate::claims::{Cases, catalogue, paper};
use crate::experiment::{ExperimentError, Quality};
use crate::figures::shared::alike::{AlikeMotor, DRAWN, PrintedInputs, alike, alike_groups};
use crate::figures::shared::map;
use crate::figures::shared::motor::{MotorCase, MotorStatistics, statistics};
use crate::figures::shared::numbers::Noise;
use crate::figures::shared::stall::{Stall, net_share_at_rest};
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
    let motor = MotorCase::table_three()?;
    let rotor_mass_kg = section.rotor_mass_kg();
    let members = quality.choose([2, 3, 6], [3, 6, 24]);
    let relaunch_perturbation = TransientSettings::default().relaunch_perturbation;
    let count = quality.choose(20, 112);
    let frequencies = printed.frequencies_hz;
    let amplitudes = section.amplitudes_of_fig10_m;
    let [low, high] = printed.measured_range_n.map(|preload| preload / rotor_mass_kg);
    let three_preloads = [low, 0.5 * (low + high), high];
    progress.start((frequencies.len() * (amplitudes.len() + three_preloads.len())) as u64, "curves");

    let mut noise = Noise::new(PRELOAD_SEED);
    let mut groups = Vec::new();
    let mut ensembles = Vec::new();
    for frequency_hz in frequencies {
        for (amplitude_m, members) in amplitudes.into_iter().zip(members) {
            let [first, last] = printed.preload_accelerations_m_per_s2;
            for (from, count) in [(first, count), (high, quality.choose(4, MORE_ABOVE))] {
                let preloads = preloads([from, last], count, &mut noise);
                let with = |preload_acceleration_m_per_s2| MotorCase {
                    frequency_hz,
                    amplitude_m,
                    preload_acceleration_m_per_s2,
                    ..motor
                };
                let cases: Vec<MotorCase> = preloads.map(with).collect();
                ensembles.extend(cases.iter().map(|case| (*case, members)));
                groups.push(cases);
            }
        }
    }
    let singles = alike_groups(&groups, RISES)?.into_iter().flat_map(|group| group.0);
    let statistics = statistics(&ensembles, RISES, relaunch_perturbation)?;
    let mut motors = singles.zip(statistics);
    let mut points = |cases: &[MotorCase]| {
        let computed: Vec<_> = motors.by_ref().take(cases.len()).collect();
        let point = |k: usize| point(&cases[k], &computed[k], rotor_mass_kg, relaunch_perturbation);
        in_parallel(cases.len(), point).into_iter().collect::<Result<Vec<Point>, ExperimentError>>()
    };
    let mut curves = Vec::new();
    for pair in groups.chunks_exact(2) {
        let MotorCase { frequency_hz, amplitude_m, .. } = pair[0][0];
        let (points, further) = (points(&pair[0])?, points(&pair[1])?);
        curves.push(Curve { frequency_hz, amplitude_m, points, further });
        progress.advance(1);
    }
    let mut stalls = Vec::new();
    for frequency_hz in frequencies {
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
    (single, statistics): &(AlikeMotor, MotorStatistics),
    mass: f64,
    relaunch_perturbation: f64,
) -> Result<Point, ExperimentError> {
    let preload = case.preload_acceleration_m_per_s2;
    Ok(Point {
        preload_acceleration_m_per_s2: preload,
        preload_mn: 1e3 * mass * preload,
        axial_forcing: case.system()?.axial_forcing(),
        statistics: *statistics,
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

/// Seed of the rotors.
pub(super) const BOUNCING_SEED: u64 = 318;

/// A rotor that has not come to rest after so many impacts goes on bouncing: those that come to rest need some tens.
const MOST_IMPACTS: usize = 10_000;

impl EndOfBouncing {
    pub(super) fn of(motor: &MotorCase) -> Result<Self, ExperimentError> {
        let largest_launch_speed = motor.system()?.peak_acceleration();
        let printed = catalogue::number("table3.restitution", 0)?;
        let restitutions = [printed.value - printed.half_unit, printed.value + printed.half_unit];
        let mut noise = Noise::new(BOUNCING_SEED);
        let mut rested = Vec::with_capacity(DRAWN);
        for _ in 0..DRAWN {
            let restitution = restitutions[0] + (restitutions[1] - restitutions[0]) * noise.even();
            let map = map(FRAC_1_PI * noise.even(), restitution)?;
            let (phase, speed) = (TAU * noise.even(), largest_launch_speed * noise.even());
            rested.push(comes_to_rest(&map, phase, speed)?);
        }
        let restitution = restitutions[1];
        let birth = (1.0 - restitution) / (1.0 + restitution);
        let axial_forcing = 0.5 * (birth + FRAC_1_PI);
        // Period 1: cos τ = (1 − ε)/((1 + ε) Γ), flights of one period.
        let phase = acos(birth / axial_forcing);
        let speed = TAU * restitution / (1.0 + restitution);
        let map = map(axial_forcing, restitution)?;
        let mut bounces = true;
        // A basin and no point: so do those that are launched a little differently.
        for share in [0.99, 1.0, 1.01] {
            bounces &= !comes_to_rest(&map, phase, share * speed)?;
        }
        Ok(Self {
            restitutions,
            at_rest: Cases::of(rested),
            threshold_restitution: (PI - 1.0) / (PI + 1.0),
            coexisting: Coexisting { restitution, axial_forcing, impacts: MOST_IMPACTS, bounces },
        })
    }
}

/// Whether the rotor is at rest for good within [`MOST_IMPACTS`].
fn comes_to_rest(map: &ImpactMap, phase: f64, speed: f64) -> Result<bool, ExperimentError> {
    let launch = Launch::new(Phase::new(phase)?, speed)?;
    let mut orbit = map.orbit_from_launch(launch, ChatterPolicy::Complete);
    let mut impacts = 0;
    while impacts < MOST_IMPACTS {
        match orbit.advance()? {
            Some(OrbitEvent::Impact(_)) => impacts += 1,
            Some(OrbitEvent::Attachment(rest)) if rest.separation.is_none() => return Ok(true),
            Some(_) => {}
            None => return Ok(true),
        }
    }
    Ok(false)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn below_the_period_one_orbit_everything_rests_and_above_it_can_bounce() {
        let bouncing = |forcing: f64, restitution: f64| {
            let birth = (1.0 - restitution) / (1.0 + restitution);
            let phase = if forcing > birth { acos(birth / forcing) } else { 0.0 };
            let speed = TAU * restitution / (1.0 + restitution);
            let map = map(forcing, restitution).expect("legal");
            !comes_to_rest(&map, phase, speed).expect("no failure")
        };
        assert!(!bouncing(0.28, 0.55) && bouncing(0.30, 0.55));
        assert!(!bouncing(0.31, 0.5), "the orbit of ε = 0.5 begins at Γ = 1/3");
    }
}
