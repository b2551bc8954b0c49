//! The numbers that the next-collision map depends on, and what Γ_T compares.

use std::f64::consts::TAU;

use bouncing_disk::System;
use bouncing_disk::core::{ChatterPolicy, Phase};
use bouncing_disk::parameters::DimensionlessSystem;
use bouncing_disk::toss::{CollisionEvent, CollisionState, Collisions};
use faer::Mat;

use super::data::{Dimension, TorqueRatio};
use super::inputs::no_orbit;
use crate::claims::paper;
use crate::experiment::ExperimentError;
use crate::figures::motor_case::MotorCase;
use crate::figures::numbers::six_decimals;
use crate::figures::toss_case::TossCase;

/// Relative change of a parameter (of the phase lag, in rad): its square, the error of a central difference,
/// and the rounding that it divides are both far below the sixth decimal.
const CHANGE: f64 = 1.0e-5;
/// The phase (rad), w_A/(ωA) and w_T/(ωΦ) of the impacts that are mapped: no special ones, slow and fast,
/// forward and backward, in which the slip ends (the first and the last) or goes on (the others).
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
    let system: DimensionlessSystem = case.system()?.into();
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

/// The pivots of a set of rows over the largest, falling: the remainder of each row after the components
/// along the rows before are taken out. They are those of a QR decomposition with exchanges, to six decimals:
/// independent rows leave ten thousand units of the last one, dependent ones a hundredth of a unit, which
/// difference quotients and rounding make.
fn pivots(rows: &[Vec<f64>]) -> Vec<f64> {
    let length = rows.first().map_or(0, Vec::len);
    let decomposition = Mat::from_fn(length, rows.len(), |place, row| rows[row][place]).col_piv_qr();
    let triangle = decomposition.thin_R();
    let sizes: Vec<f64> = (0..length.min(rows.len())).map(|index| triangle[(index, index)].abs()).collect();
    let first = sizes.first().copied().unwrap_or(1.0);
    sizes.into_iter().map(|size| six_decimals(size / first)).collect()
}

/// The rank of the derivatives of the next collisions by the nine inputs, at the toss of Table I as a motor
/// of those inputs.
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
    let pivots = pivots(&rows);
    Ok(Dimension {
        parameters: NAMES.map(str::to_owned).to_vec(),
        outcomes,
        rank: pivots.iter().filter(|pivot| **pivot > 0.0).count(),
        pivots,
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
    let motor = MotorCase::default_of(&paper::table_three()?, &paper::section_five()?).system()?;
    Ok(vec![torque_ratio("the toss of Table I", &toss)?, torque_ratio("the motor of Table III", &motor)?])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pivots_count_independent_rows() {
        let rows = vec![vec![1.0, 0.0, 2.0], vec![0.0, 3.0, 0.0], vec![2.0, 3.0, 4.0], vec![0.0; 3]];
        // The longest row is the third, of length sqrt(29). Of the second row 9/sqrt(29) lies along it.
        let pivots = pivots(&rows);
        let second = (9.0 - 81.0 / 29.0_f64).sqrt() / 29.0_f64.sqrt();
        assert!((pivots[1] - second).abs() <= 0.5e-6, "{pivots:?} {second}");
        assert!(pivots.len() == 3 && pivots[0] >= 1.0 && pivots[2] <= 0.0, "{pivots:?}");
    }
}
