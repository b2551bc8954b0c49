//! How far a disk goes, where it gets its angular momentum, the numbers that the next-collision map depends on, and what Γ_T
//! compares.

use std::f64::consts::TAU;

use bouncing_disk::core::{ChatterPolicy, ImpactState, Phase};
use bouncing_disk::parameters::{DimensionlessSystem, ForcingParameters};
use bouncing_disk::toss::{CollisionEvent, CollisionState, Collisions};
use bouncing_disk::{Engine, Event, EventRecord, InitialCondition, System};

use super::data::{Dimension, Motion, TorqueRatio, Transfer};
use super::slices::{Inputs, Systems, no_orbit, start};
use crate::claims::paper;
use crate::experiment::ExperimentError;
use crate::figures::shared::map_in_parallel;
use crate::figures::shared::motor::MotorCase;
use crate::figures::shared::numbers::six_decimals;
use crate::figures::shared::toss::TossCase;

/// Impacts of a long motion.
const LONG: usize = 4_000;
/// Restitutions other than the paper's: nearly elastic ones.
const NEARLY_ELASTIC: [f64; 2] = [0.9, 0.99];

/// No impact is faster than this, relative to the platform: between two impacts the disk falls by no more
/// than the platform's 2P, and the platform moves with no more than P. In units of g/ω.
fn speed_bound(peak: f64, restitution: f64) -> f64 {
    let mut speed = 0.0_f64;
    // A contraction by the restitution.
    for _ in 0..10_000 {
        let launched = restitution * speed + peak;
        speed = (launched * launched + 4.0 * peak).sqrt() + peak;
    }
    speed
}

fn motion(axial_forcing: f64, system: &DimensionlessSystem) -> Result<Motion, ExperimentError> {
    let peak = system.peak_acceleration();
    let mut collisions = Collisions::new(*system, start(system, None, true)?, ChatterPolicy::Complete)?;
    let (mut impacts, mut highest) = (0, peak);
    let (mut first, mut half, mut last) = (None, 0.0, None);
    while impacts < LONG {
        let Some(event) = collisions.advance()? else { break };
        let CollisionEvent::Collision(collision) = event else { continue };
        impacts += 1;
        let phase = collision.state.phase;
        let launched = -system.restitution() * collision.state.axial_impact_velocity + peak * phase.cos();
        let rise = if launched > 0.0 { 0.5 * launched * launched } else { 0.0 };
        highest = highest.max(peak * phase.sin() + rise);
        if first.is_none() {
            first = Some(collision);
        }
        if impacts <= LONG / 2 {
            half = collision.angle;
        }
        last = Some(collision);
    }
    let (Some(first), Some(last)) = (first, last) else {
        return Err(super::slices::no_orbit(axial_forcing));
    };
    let launched = system.restitution() * speed_bound(peak, system.restitution()) + peak;
    Ok(Motion {
        axial_forcing,
        restitution: system.restitution(),
        highest: highest / peak,
        height_bound: (peak + 0.5 * launched * launched) / peak,
        turned_in_first_half: (half - first.angle) / system.twist_speed(),
        turned_in_second_half: (last.angle - half) / system.twist_speed(),
    })
}

/// Motions from rest at the Γ of Fig. 7, at the paper's restitution and nearly elastic.
pub(super) fn motions(forcings: &[f64], inputs: Inputs) -> Result<Vec<Motion>, ExperimentError> {
    let restitutions = [inputs.restitution, NEARLY_ELASTIC[0], NEARLY_ELASTIC[1]];
    let cases: Vec<(f64, f64)> =
        forcings.iter().flat_map(|forcing| restitutions.map(|restitution| (*forcing, restitution))).collect();
    map_in_parallel(&cases, |&(axial_forcing, restitution)| {
        let system = ForcingParameters {
            axial_forcing,
            angular_forcing: inputs.semielliptical.angular_forcing,
            phase_lag: inputs.semielliptical.phase_lag_rad,
            restitution,
        };
        motion(axial_forcing, &system.build()?)
    })
}

/// Impacts over which the angular impulses are added up, from a disk that does not turn: once it turns in
/// step with the platform, nothing is transferred in period 1.
const TRANSFERS: usize = 600;
/// Parts into which a segment on the platform is divided: the impulse of friction may change its sign within
/// a segment.
const PARTS: usize = 16;

/// The share of the angular impulses, by size, that impacts transfer; `None` where there are none.
fn share_in_impacts(
    system: &DimensionlessSystem,
    start: InitialCondition,
) -> Result<Option<f64>, ExperimentError> {
    let mut engine = Engine::new(*system, start, bouncing_disk::motion::PAPER_CHATTER)?;
    let (mut impacts, mut impulsive, mut contact) = (0, 0.0, 0.0);
    while impacts < TRANSFERS {
        let Some(record) = engine.advance()? else { break };
        impacts += usize::from(matches!(record.event, Event::Impact { .. }));
        impulsive += record.angular_impulse.abs();
        contact += turned_in_contact(&record, system);
    }
    let all = impulsive + contact;
    Ok((all > 0.0).then(|| impulsive / all))
}

/// The sum of the sizes of the changes of angular speed on the platform; zero in flight.
fn turned_in_contact(record: &EventRecord, system: &DimensionlessSystem) -> f64 {
    let speed = |part: usize| record.evaluate(system, part as f64 / PARTS as f64).disk.angular_speed;
    if record.segment.state.mode == bouncing_disk::motion::Mode::Flight {
        return 0.0;
    }
    (0..PARTS).map(|part| (speed(part + 1) - speed(part)).abs()).sum()
}

/// The share of the motor of Table III, from rest.
pub(super) fn motor_transfer() -> Result<Option<f64>, ExperimentError> {
    let motor = MotorCase::table_three()?.system()?;
    share_in_impacts(motor.dimensionless(), start(motor.dimensionless(), None, false)?)
}

/// The transfers of both rotary motions, for the followed attractor from its states and for a disk from rest.
pub(super) fn transfers(
    followed: &[(f64, ImpactState)],
    from_rest: &[f64],
    inputs: Inputs,
) -> Result<Vec<Transfer>, ExperimentError> {
    let starts: Vec<(f64, Option<ImpactState>)> = followed
        .iter()
        .map(|(forcing, state)| (*forcing, Some(*state)))
        .chain(from_rest.iter().map(|forcing| (*forcing, None)))
        .collect();
    let pairs = map_in_parallel(&starts, |&(axial_forcing, state)| {
        let systems = Systems::at(axial_forcing, inputs)?;
        let transfer = |system: &DimensionlessSystem, angular_forcing: f64| -> Result<_, ExperimentError> {
            let share_in_impacts = share_in_impacts(system, start(system, state, false)?)?;
            Ok(share_in_impacts.map(|share_in_impacts| Transfer {
                axial_forcing,
                angular_forcing,
                from_rest: state.is_none(),
                share_in_impacts,
            }))
        };
        Ok([
            transfer(&systems.linear, inputs.linear.angular_forcing)?,
            transfer(&systems.semielliptical, inputs.semielliptical.angular_forcing)?,
        ])
    })?;
    Ok(pairs.into_iter().flatten().flatten().collect())
}

/// Relative change of a parameter (of the phase lag, in rad): its square, the error of a central difference, and the rounding
/// that it divides are both far below the sixth decimal.
const CHANGE: f64 = 1.0e-5;
/// The phase (rad), w_A/(ωA) and w_T/(ωΦ) of the impacts that are mapped: no special ones, slow and fast, forward and backward, in
/// which the slip ends (the first and the last) or goes on (the others).
const IMPACTS: [(f64, f64, f64); 4] =
    [(0.3, -0.9, 0.4), (1.2, -0.5, -6.0), (5.9, -0.6, 5.0), (0.7, -2.3, -2.1)];

/// The names of the nine inputs of Sec. V A.
const NAMES: [&str; 9] = ["a_g", "a_e", "ω", "g", "μ", "ε", "A", "ωΦ", "θ"];

/// The motor with the input of this index changed by `relative`.
fn changed(case: MotorCase, index: usize, relative: f64) -> MotorCase {
    let mut case = case;
    let factor = 1.0 + relative;
    match index {
        0 => case.gyration_radius_m *= factor,
        1 => case.contact_radius_m *= factor,
        2 => case.frequency_hz *= factor,
        3 => case.preload_acceleration_m_per_s2 *= factor,
        4 => case.friction *= factor,
        5 => case.restitution *= factor,
        6 => case.amplitude_m *= factor,
        7 => case.peak_angular_speed_rad_per_s *= factor,
        _ => case.phase_lag_rad += relative,
    }
    case
}

/// The impacts that follow [`IMPACTS`], in the same units.
fn next_collisions(case: MotorCase) -> Result<Vec<f64>, ExperimentError> {
    let system: DimensionlessSystem = case.system()?.try_into()?;
    let (peak, twist) = (system.peak_acceleration(), system.twist_speed());
    let mut outcomes = Vec::with_capacity(3 * IMPACTS.len());
    for (angle, axial, tangential) in IMPACTS {
        let state = CollisionState {
            phase: Phase::new(angle)?,
            axial_impact_velocity: axial * peak,
            tangential_impact_velocity: tangential * twist,
        };
        let next = Collisions::after(system, state, ChatterPolicy::Complete)
            .and_then(|mut collisions| collisions.advance())?;
        let Some(CollisionEvent::Collision(next)) = next else {
            return Err(no_orbit(system.axial_forcing()));
        };
        outcomes.extend([
            TAU * next.time.cycles(),
            next.state.axial_impact_velocity / peak,
            next.state.tangential_impact_velocity / twist,
        ]);
    }
    Ok(outcomes)
}

/// The pivots of a set of rows over the largest, falling: what is left of the largest row when the ones before are taken out. They
/// are those of a QR decomposition with exchanges, to six decimals: independent rows leave ten thousand units of the last one,
/// dependent ones a hundredth of a unit, which difference quotients and rounding make.
fn pivots(mut rows: Vec<Vec<f64>>) -> Vec<f64> {
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let mut sizes = Vec::with_capacity(rows.len());
    while let Some((largest, square)) =
        rows.iter().map(|row| dot(row, row)).enumerate().max_by(|a, b| a.1.total_cmp(&b.1))
    {
        sizes.push(square.sqrt());
        let pivot = rows.swap_remove(largest);
        for row in rows.iter_mut().filter(|_| square > 0.0) {
            let along = dot(row, &pivot) / square;
            row.iter_mut().zip(&pivot).for_each(|(entry, pivot)| *entry -= along * pivot);
        }
    }
    let first = sizes.first().copied().unwrap_or(1.0);
    sizes.into_iter().map(|size| six_decimals(size / first)).collect()
}

/// The rank of the derivatives of the next collisions by the nine inputs, at the toss of Table I as a motor of those inputs.
pub(super) fn dimension() -> Result<Dimension, ExperimentError> {
    let section = paper::section_four()?;
    let toss = TossCase::from(&paper::table_one()?);
    let platform = toss.system()?;
    let case = MotorCase {
        friction: toss.friction,
        restitution: section.restitution,
        phase_lag_rad: section.semielliptical_phase_lag_rad,
        amplitude_m: platform.platform().parameters().amplitude,
        peak_angular_speed_rad_per_s: platform.platform().peak_angular_speed(),
        contact_radius_m: toss.contact_radius_m,
        gyration_radius_m: toss.gyration_radius_m,
        preload_acceleration_m_per_s2: toss.preload_acceleration_m_per_s2,
        frequency_hz: toss.angular_frequency_rad_per_s / TAU,
    };
    let rows = (0..NAMES.len())
        .map(|index| {
            let above = next_collisions(changed(case, index, CHANGE))?;
            let below = next_collisions(changed(case, index, -CHANGE))?;
            Ok(above.iter().zip(&below).map(|(above, below)| (above - below) / (2.0 * CHANGE)).collect())
        })
        .collect::<Result<Vec<Vec<f64>>, ExperimentError>>()?;
    let outcomes = rows.first().map_or(0, Vec::len);
    Ok(Dimension {
        parameters: NAMES.map(str::to_owned).to_vec(),
        outcomes,
        rank: pivots(rows).into_iter().filter(|pivot| *pivot > 0.0).count(),
    })
}

/// The inertial and the frictional torque of a disk that follows the platform under its preload.
fn torque_ratio(name: &str, system: &System) -> Result<TorqueRatio, ExperimentError> {
    let (disk, platform) = (system.disk(), system.platform());
    // Per unit mass: a_g² times the largest angular acceleration, and μ a_e g.
    let inertial = disk.gyration_radius()
        * disk.gyration_radius()
        * platform.parameters().angular_frequency
        * platform.peak_angular_speed();
    let frictional = disk.friction() * disk.contact_radius() * disk.preload_acceleration();
    let angular_forcing = system.angular_forcing().ok_or_else(|| no_orbit(system.axial_forcing()))?;
    Ok(TorqueRatio { system: name.to_owned(), angular_forcing, ratio: inertial / frictional })
}

pub(super) fn torque_ratios() -> Result<Vec<TorqueRatio>, ExperimentError> {
    let toss = TossCase::from(&paper::table_one()?).system()?;
    let motor = MotorCase::table_three()?.system()?;
    Ok(vec![torque_ratio("the toss of Table I", &toss)?, torque_ratio("the motor of Table III", &motor)?])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pivots_count_independent_rows() {
        let rows = vec![vec![1.0, 0.0, 2.0], vec![0.0, 3.0, 0.0], vec![2.0, 3.0, 4.0], vec![0.0; 3]];
        // The longest row is the third, of length sqrt(29). Of the second row 9/sqrt(29) lies along it.
        let pivots = pivots(rows);
        let second = (9.0 - 81.0 / 29.0_f64).sqrt() / 29.0_f64.sqrt();
        assert!((pivots[1] - second).abs() <= 0.5e-6, "{pivots:?} {second}");
        assert!(pivots[0] >= 1.0 && pivots[2..].iter().all(|pivot| *pivot <= 0.0), "{pivots:?}");
    }

    /// Against faer: dependent rows, and independent ones.
    #[test]
    fn pivots_are_those_of_a_qr_decomposition_with_exchanges() {
        let plain = vec![vec![1.0, 0.0, 2.0], vec![0.0, 3.0, 0.0], vec![2.0, 3.0, 4.0]];
        let independent =
            (1..=5).map(|row| (1..=7).map(|place| f64::from(row * place * place % 11)).collect()).collect();
        for rows in [plain, independent] {
            let length = rows[0].len();
            let matrix = faer::Mat::from_fn(length, rows.len(), |place, row: usize| rows[row][place]);
            let decomposition = matrix.col_piv_qr();
            let triangle = decomposition.thin_R();
            let expected = (0..rows.len()).map(|index| (triangle[(index, index)] / triangle[(0, 0)]).abs());
            let pivots = pivots(rows);
            assert_eq!(pivots.len(), expected.len());
            for (pivot, expected) in pivots.into_iter().zip(expected) {
                assert!((pivot - expected).abs() <= 0.51e-6, "{pivot} {expected}");
            }
        }
    }
}
