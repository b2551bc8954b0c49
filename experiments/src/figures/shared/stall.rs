//! The load at which a motor stalls.
//!
//! The model finds it ([`bouncing_disk::Motor::stall_load`]). The balance of the normal impulse ([`NormalImpulses`]) predicts it.

use bouncing_disk::core::Unobserved;
use bouncing_disk::core::run::in_parallel;
use bouncing_disk::estimate::{ExponentialFit, Spread};
use bouncing_disk::motor::{Estimate, NormalImpulses, OperatingSettings};
use serde::Serialize;

use super::motor::{MotorCase, MotorStatistics, statistics};
use crate::experiment::ExperimentError;

/// Duration of the transients for α̇_ss/t_c, as in Fig. 11.
const TRANSIENT_RISES: f64 = 6.0;

/// Points of the transient that the balance of the impulse predicts.
const PREDICTED_POINTS: u32 = 240;

/// Impacts of each orbit for the balance of the normal impulse.
const BALANCED_IMPACTS: usize = 6_000;

/// The stall of one motor, as accelerations (rad/s²): times m a_g² they are torques.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub(crate) struct Stall {
    pub(crate) members: usize,
    pub(crate) relaunch_perturbation: f64,
    /// The load at which the mean speed is zero.
    pub(crate) load_rad_per_s2: Estimate,
    /// (μ a_e g/a_g²) S(0): the mean acceleration of a rotor held at rest, over orbits with other relaunches.
    pub(crate) balance_rad_per_s2: Spread,
    /// The paper's estimate α̇_ss/t_c of the same motor without load, over the members.
    pub(crate) estimate_rad_per_s2: Spread,
    /// μ a_e g/a_g², which no load can exceed.
    pub(crate) limit_rad_per_s2: f64,
    /// The estimate over the load, minus one, and its standard error.
    pub(crate) estimate_off: f64,
    pub(crate) estimate_off_error: f64,
    /// The same of the speed that the balance of the impulse predicts, fitted by the same exponential: the
    /// part of the excess that is due to a rise that is not exponential.
    pub(crate) predicted_off: f64,
    /// The largest angular acceleration that friction can give in contact over the stator's largest one:
    /// where it is small, friction cannot hold the rotor on the stator but for an instant about the turning
    /// points of the stator's speed.
    pub(crate) hold_share: f64,
}

impl Stall {
    /// Of each motor with `members` runs, each of these with relaunches of its own.
    pub(crate) fn of_each(
        cases: &[MotorCase],
        members: usize,
        relaunch_perturbation: f64,
    ) -> Result<Vec<Self>, ExperimentError> {
        let ensembles: Vec<_> = cases.iter().map(|case| (*case, members, relaunch_perturbation)).collect();
        let transients = statistics(&ensembles, TRANSIENT_RISES)?;
        let of = |(case, transients)| Self::of(case, transients, members, relaunch_perturbation);
        cases.iter().zip(&transients).map(of).collect()
    }

    /// Of a motor whose transients without load have these statistics.
    fn of(
        case: &MotorCase,
        transients: &MotorStatistics,
        members: usize,
        relaunch_perturbation: f64,
    ) -> Result<Self, ExperimentError> {
        let system = case.system()?;
        let (map, limit) = (system.dimensionless().map(), case.largest_acceleration());
        let settings = OperatingSettings { members, relaunch_perturbation, ..OperatingSettings::default() };
        let motor = case.motor()?;
        let stall = motor.stall_load(&settings, &Unobserved)?.torque;
        let inertia = motor.mass() * case.gyration_radius_m * case.gyration_radius_m;
        let [value, standard_error] = [stall.value, stall.standard_error].map(|torque| torque / inertia);
        let load_rad_per_s2 = Estimate { value, standard_error };
        let orbits = in_parallel(members, |member| -> Result<(f64, f64), ExperimentError> {
            // A slightly smaller perturbation is another orbit.
            let smaller = 1.0 - 0.5 * member as f64 / members as f64;
            let impulses = NormalImpulses::of(map, BALANCED_IMPACTS, smaller * relaunch_perturbation)?;
            let balance = impulses.balance(case.phase_lag_rad);
            let (times, speeds) = balance.transient(TRANSIENT_RISES, PREDICTED_POINTS);
            let fit = ExponentialFit::new(&times, &speeds, &Unobserved)?;
            Ok((balance.net_share(0.0), fit.stall_acceleration()))
        });
        let orbits = orbits.into_iter().collect::<Result<Vec<_>, _>>()?;
        let mean = |of: fn(&(f64, f64)) -> f64| orbits.iter().map(of).sum::<f64>();
        let predicted_off = mean(|orbit| orbit.1) / mean(|orbit| orbit.0) - 1.0;
        let balance: Vec<f64> = orbits.iter().map(|orbit| limit * orbit.0).collect();
        let estimate_rad_per_s2 = transients.stall_acceleration_rad_per_s2.ok_or_else(|| {
            ExperimentError::NoData { quantity: "stall torque from a transient".to_owned() }
        })?;
        let ratio = estimate_rad_per_s2.mean / value;
        let one = estimate_rad_per_s2.standard_error / estimate_rad_per_s2.mean;
        let other = standard_error / value;
        let without_units = system.dimensionless();
        let grip = without_units.friction() / without_units.twist_speed();
        Ok(Self {
            hold_share: grip * (1.0 + without_units.peak_acceleration()),
            members,
            relaunch_perturbation,
            load_rad_per_s2,
            balance_rad_per_s2: Spread::of(&balance).map_err(ExperimentError::model)?,
            estimate_rad_per_s2,
            limit_rad_per_s2: limit,
            estimate_off: ratio - 1.0,
            predicted_off,
            estimate_off_error: ratio.abs() * (one * one + other * other).sqrt(),
        })
    }
}

/// S(0): the share of the normal impulse that pushes a rotor held at rest forwards, minus the rest.
pub(crate) fn net_share_at_rest(
    case: &MotorCase,
    impacts: usize,
    relaunch_perturbation: f64,
) -> Result<f64, ExperimentError> {
    let system = case.system()?;
    let impulses = NormalImpulses::of(system.dimensionless().map(), impacts, relaunch_perturbation)?;
    Ok(impulses.balance(case.phase_lag_rad).net_share(0.0))
}

#[cfg(test)]
mod tests {
    use bouncing_disk::core::ChatterPolicy;
    use bouncing_disk::{Engine, Event, InitialCondition, System};

    use super::*;
    use crate::figures::shared::numbers::Noise;

    const PERTURBATION: f64 = 1e-3;

    /// The mean speed over ωΦ of the event engine against a load, over a few seeded members.
    fn engine_speed(case: &MotorCase, load: f64, rises: f64) -> f64 {
        let system = case.system().expect("legal");
        let mut disk = system.disk().parameters();
        disk.load_acceleration = load;
        let system = System::new(*system.platform(), disk.build().expect("legal")).expect("legal");
        let without_units = *system.dimensionless();
        let radians = rises * without_units.twist_speed() / without_units.friction();
        let speeds = (0..4).map(|member| {
            let mut noise = Noise::new(100 + member);
            let phase = without_units.vibration().separation_phase().expect("bounces");
            let start = InitialCondition::Launch {
                phase,
                relative_speed: PERTURBATION * noise.even(),
                angular_speed: 0.0,
            };
            let mut engine = Engine::new(system, start, ChatterPolicy::Complete).expect("legal");
            let (mut elapsed, mut first) = (0.0, None);
            loop {
                let record = engine.advance().expect("no failure").expect("goes on");
                elapsed += record.span.radians();
                let angle = record.after.angle;
                let first = *first.get_or_insert(angle);
                if record.event == Event::Separation {
                    engine.perturb_launch(PERTURBATION * noise.even()).expect("legal");
                }
                if elapsed >= radians {
                    break (angle - first) / elapsed / without_units.twist_speed();
                }
            }
        });
        speeds.sum::<f64>() / 4.0
    }

    /// The engine integrates flights, impacts, chattering and contact with the load, without a tape.
    #[test]
    fn the_engine_stands_still_on_average_at_the_stall_load_and_turns_with_less_or_more() {
        let case = MotorCase::table_three().expect("reads");
        let stall = Stall::of_each(&[case], 8, PERTURBATION).expect("no failure")[0];
        let load = stall.load_rad_per_s2.value;
        let [less, still, more] = [0.8, 1.0, 1.2].map(|share| engine_speed(&case, share * load, 6.0));
        assert!(less > 0.0 && more < 0.0, "{less} {still} {more}");
        assert!(still.abs() < 0.25 * less.min(-more), "{less} {still} {more}");
        assert!(load < stall.limit_rad_per_s2, "{stall:?}");
        let (found, balance) = (stall.load_rad_per_s2, stall.balance_rad_per_s2);
        assert!(stall.hold_share < 1e-2, "{stall:?}");
        let error_squared =
            found.standard_error * found.standard_error + balance.standard_error * balance.standard_error;
        assert!((found.value - balance.mean).abs() < 4.0 * error_squared.sqrt(), "{stall:?}");
    }
}
