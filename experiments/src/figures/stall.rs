//! The load at which a motor stalls.
//!
//! A constant load torque T takes T/(m a_g²) of angular speed per time. The *stall load* is the T/(m a_g²) at which the rotor's mean speed over a long run is
//! zero. The vertical motion knows no load, so all loads share one seeded list of collisions and segments of contact, along which the speed is carried and the load
//! bisected. Friction never holds the rotor meanwhile: at speed zero it would have to follow the stator, whose angular acceleration is some thousand
//! times what friction can give ([`Stall::hold_share`] is the inverse), so that there is no range of loads that all stall it.
//!
//! Beside it stands what the balance of the normal impulse says ([`super::impulse`]): a rotor held at rest gets the mean acceleration
//! (μ a_e g/a_g²) S(0), and a load of this size stalls it as long as its speed strays little from zero.

use bouncing_disk::core::elementary::cos;
use bouncing_disk::core::{ChatterPolicy, ImpactMap, Launch, OrbitEvent};
use bouncing_disk::{ExponentialFit, Spread};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::impulse::Impulses;
use super::motor_case::{MotorCase, core_error};
use super::synthetic::Noise;
use crate::experiment::ExperimentError;

/// Duration of a run in rise times ωΦ a_g²/(μ a_e g): a dozen relaxation times of the speed, so that where it starts does not matter.
const RISES: f64 = 12.0;

/// Duration of the transients for α̇_ss/t_c, as in Fig. 11.
const TRANSIENT_RISES: f64 = 6.0;

/// Halvings of the range of loads, from minus to plus the most that friction can give: to 2e-6 of it, far below the statistical error.
const HALVINGS: u32 = 20;

/// Parts into which a segment of contact is divided.
const CONTACT_PARTS: u32 = 16;

/// Points of the transient that the balance of the impulse predicts.
const PREDICTED_POINTS: u32 = 240;

/// Impacts of each orbit for the balance of the normal impulse.
const BALANCED_IMPACTS: usize = 6_000;

/// Seed of the relaunches.
const SEED: u64 = 11;

/// What stalls one motor, as accelerations (rad/s²): times m a_g² they are torques.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Stall {
    pub(crate) members: usize,
    /// Duration of each run, in rise times.
    pub(crate) rises: f64,
    pub(crate) relaunch_perturbation: f64,
    /// The load at which the mean speed is zero, over the members.
    pub(crate) load_rad_per_s2: Spread,
    /// (μ a_e g/a_g²) S(0): the mean acceleration of a rotor held at rest, over orbits with other relaunches.
    pub(crate) balance_rad_per_s2: Spread,
    /// The paper's estimate α̇_ss/t_c of the same motor without load, over the members.
    pub(crate) estimate_rad_per_s2: Spread,
    /// μ a_e g/a_g², which no load can exceed.
    pub(crate) limit_rad_per_s2: f64,
    /// The estimate over the load, minus one, and its standard error.
    pub(crate) estimate_off: f64,
    pub(crate) estimate_off_error: f64,
    /// The same of the speed that the balance of the impulse predicts, fitted by the same exponential: what is off because the speed does not rise exponentially.
    pub(crate) predicted_off: f64,
    /// The largest angular acceleration that friction can give in contact over the stator's largest one: where it is small, friction cannot hold
    /// the rotor on the stator but for an instant about the turning points of the stator's speed.
    pub(crate) hold_share: f64,
}

impl Stall {
    /// Of `members` runs, each with relaunches of its own.
    pub(crate) fn of(
        case: &MotorCase,
        members: usize,
        relaunch_perturbation: f64,
    ) -> Result<Self, ExperimentError> {
        let system = case.system()?;
        let without_units = system.dimensionless();
        let (map, limit) = (without_units.map(), case.largest_acceleration());
        // Per radian, friction with the mean normal force gives this share of the stator's largest speed.
        let grip = without_units.friction() / without_units.twist_speed();
        let shares = (0..members)
            .into_par_iter()
            .map(|member| {
                let noise = Noise::new(SEED + member as u64);
                let kicks = kicks(map, case.phase_lag_rad, RISES / grip, relaunch_perturbation, noise)?;
                Ok(stall_share(&kicks, grip))
            })
            .collect::<Vec<Result<f64, ExperimentError>>>();
        let orbits = (0..members)
            .into_par_iter()
            .map(|member| {
                // A slightly smaller perturbation is another orbit.
                let smaller = 1.0 - 0.5 * member as f64 / members as f64;
                let impulses = Impulses::of(map, BALANCED_IMPACTS, smaller * relaunch_perturbation)?;
                let levels = impulses.levels(case.phase_lag_rad);
                let (times, speeds) = levels.transient(TRANSIENT_RISES, PREDICTED_POINTS);
                let fit = ExponentialFit::new(&times, &speeds).map_err(ExperimentError::model)?;
                Ok((levels.net_share(0.0), fit.stall_acceleration()))
            })
            .collect::<Vec<Result<(f64, f64), ExperimentError>>>();
        let orbits = orbits.into_iter().collect::<Result<Vec<_>, _>>()?;
        let mean = |of: fn(&(f64, f64)) -> f64| orbits.iter().map(of).sum::<f64>();
        let predicted_off = mean(|orbit| orbit.1) / mean(|orbit| orbit.0) - 1.0;
        let balance = orbits.iter().map(|orbit| Ok(orbit.0)).collect();
        let load_rad_per_s2 = spread(shares, limit)?;
        let statistics = case.statistics(TRANSIENT_RISES, members, relaunch_perturbation)?;
        let estimate_rad_per_s2 = statistics.stall_acceleration_rad_per_s2.ok_or_else(|| {
            ExperimentError::NoData { quantity: "stall torque from a transient".to_owned() }
        })?;
        let ratio = estimate_rad_per_s2.mean / load_rad_per_s2.mean;
        let relative = |spread: Spread| spread.standard_error / spread.mean;
        let (one, other) = (relative(estimate_rad_per_s2), relative(load_rad_per_s2));
        Ok(Self {
            members,
            rises: RISES,
            relaunch_perturbation,
            load_rad_per_s2,
            balance_rad_per_s2: spread(balance, limit)?,
            estimate_rad_per_s2,
            limit_rad_per_s2: limit,
            estimate_off: ratio - 1.0,
            predicted_off,
            estimate_off_error: ratio.abs() * (one * one + other * other).sqrt(),
            hold_share: grip * (1.0 + without_units.peak_acceleration()),
        })
    }

    /// By how many standard errors load and balance differ.
    pub(crate) fn balance_deviation(&self) -> f64 {
        let (load, balance) = (self.load_rad_per_s2, self.balance_rad_per_s2);
        let squares =
            load.standard_error * load.standard_error + balance.standard_error * balance.standard_error;
        (load.mean - balance.mean).abs() / squares.sqrt()
    }

    /// The numbers in one phrase.
    pub(crate) fn words(&self) -> String {
        format!(
            "stalls at {:.2} ± {:.2} rad/s² (balance of the impulse {:.2} ± {:.2}), α̇_ss/t_c is {:.2} ± {:.2}, {:+.0} ± {:.0} % (of the speed that the \
             balance predicts {:+.0} %)",
            self.load_rad_per_s2.mean,
            self.load_rad_per_s2.standard_error,
            self.balance_rad_per_s2.mean,
            self.balance_rad_per_s2.standard_error,
            self.estimate_rad_per_s2.mean,
            self.estimate_rad_per_s2.standard_error,
            100.0 * self.estimate_off,
            100.0 * self.estimate_off_error,
            100.0 * self.predicted_off,
        )
    }
}

fn spread(shares: Vec<Result<f64, ExperimentError>>, limit: f64) -> Result<Spread, ExperimentError> {
    let loads: Vec<f64> =
        shares.into_iter().map(|share| share.map(|share| limit * share)).collect::<Result<_, _>>()?;
    Spread::of(&loads).map_err(ExperimentError::model)
}

/// S(0): the share of the normal impulse that pushes a rotor held at rest forwards, minus the rest.
pub(crate) fn net_share_at_rest(
    case: &MotorCase,
    impacts: usize,
    relaunch_perturbation: f64,
) -> Result<f64, ExperimentError> {
    let system = case.system()?;
    let impulses = Impulses::of(system.dimensionless().map(), impacts, relaunch_perturbation)?;
    Ok(impulses.levels(case.phase_lag_rad).net_share(0.0))
}

/// A time without friction and the normal impulse at its end.
#[derive(Clone, Copy, Debug)]
struct Kick {
    /// Radians since the kick before.
    duration: f64,
    /// The stator's angular speed in units of ωΦ.
    stator: f64,
    /// In units of m g/ω.
    impulse: f64,
}

/// The normal impulses of at least `radians` of a motor from a separation on, in their order. Every separation gets a relative speed drawn evenly below
/// `perturbation` (g/ω).
fn kicks(
    map: &ImpactMap,
    phase_lag: f64,
    radians: f64,
    perturbation: f64,
    mut noise: Noise,
) -> Result<Vec<Kick>, ExperimentError> {
    let mut kicks = Vec::new();
    let Some(phase) = map.vibration().separation_phase() else { return Ok(kicks) };
    let first = perturbation * noise.even();
    let mut orbit =
        map.orbit_from_launch(Launch::new(phase, first).map_err(core_error)?, ChatterPolicy::Complete);
    let (mut elapsed, mut last) = (0.0, phase.angle());
    while elapsed < radians {
        let Some(event) = orbit.advance().map_err(core_error)? else { break };
        match event {
            OrbitEvent::Impact(impact) => {
                last = impact.phase.angle();
                elapsed += impact.duration();
                kicks.push(Kick {
                    duration: impact.duration(),
                    stator: cos(last + phase_lag),
                    impulse: -(1.0 + map.restitution()) * impact.velocity,
                });
            }
            OrbitEvent::Attachment(rest) => {
                let Some((leaves, turns)) = rest.separation else { break };
                let (at, from) = (rest.accumulation, rest.accumulation.phase.angle());
                // Impulse is change of velocity plus weight times time.
                let peak = map.vibration().peak_acceleration();
                let impulse = at.duration - rest.last_speed + peak * (cos(from) - cos(last));
                kicks.push(Kick { duration: at.duration, stator: cos(from + phase_lag), impulse });
                let until = leaves.angle() + std::f64::consts::TAU * turns as f64;
                let step = (until - from) / f64::from(CONTACT_PARTS);
                kicks.extend((0..CONTACT_PARTS).map(|part| {
                    let (start, end) = (from + step * f64::from(part), from + step * f64::from(part + 1));
                    Kick {
                        duration: step,
                        stator: cos(0.5 * (start + end) + phase_lag),
                        impulse: step + peak * (cos(end) - cos(start)),
                    }
                }));
                elapsed += at.duration + (until - from);
                last = leaves.angle();
                orbit.perturb_launch(perturbation * noise.even()).map_err(core_error)?;
            }
            _ => {}
        }
    }
    Ok(kicks)
}

/// The mean speed in units of ωΦ, from rest, against a load of `share` times the most that friction can give on average. `grip` is the change of
/// speed, in these units, by an impulse of 1.
fn mean_speed(kicks: &[Kick], grip: f64, share: f64) -> f64 {
    let (mut speed, mut turned, mut elapsed) = (0.0, 0.0, 0.0);
    for kick in kicks {
        let lost = share * grip * kick.duration;
        turned += kick.duration * (speed - 0.5 * lost);
        elapsed += kick.duration;
        speed -= lost;
        let most = grip * kick.impulse;
        speed -= (speed - kick.stator).clamp(-most, most);
    }
    turned / elapsed
}

/// The load, as a share of the most that friction can give, at which the mean speed changes its sign.
fn stall_share(kicks: &[Kick], grip: f64) -> f64 {
    let (mut low, mut high) = (-1.0, 1.0);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if mean_speed(kicks, grip, middle) > 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use bouncing_disk::{Engine, Event, InitialCondition, System};

    use super::*;
    use crate::paper;

    const PERTURBATION: f64 = 1e-3;

    fn motor() -> MotorCase {
        let (table, section) = (paper::table_three().expect("reads"), paper::section_five().expect("reads"));
        MotorCase::default_of(&table, &section)
    }

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

    /// The engine integrates flights, impacts, chattering and contact with the load; the list of kicks is none of its business.
    #[test]
    fn the_engine_stands_still_on_average_at_the_stall_load_and_turns_with_less_or_more() {
        let case = motor();
        let stall = Stall::of(&case, 8, PERTURBATION).expect("no failure");
        let load = stall.load_rad_per_s2.mean;
        let [less, still, more] = [0.8, 1.0, 1.2].map(|share| engine_speed(&case, share * load, 6.0));
        assert!(less > 0.0 && more < 0.0, "{less} {still} {more}");
        assert!(still.abs() < 0.25 * less.min(-more), "{less} {still} {more}");
        assert!(load < stall.limit_rad_per_s2, "{stall:?}");
        assert!(stall.balance_deviation() < 4.0, "{stall:?}");
        assert!(stall.hold_share < 1e-2, "{stall:?}");
    }

    /// All the impulse at one phase: the load that balances is all that friction can give, with the sign of the stator's speed. Over n kicks the speed falls by the load
    /// before each of them, so that its mean is zero for (n − 1)/n of that.
    #[test]
    fn a_stator_that_is_always_hit_at_one_phase_bears_the_whole_limit() {
        for (stator, share) in [(0.7, 0.999), (-0.7, -0.999)] {
            let kicks = vec![Kick { duration: 1.0, stator, impulse: 1.0 }; 1_000];
            let found = stall_share(&kicks, 1e-4);
            assert!((found - share).abs() < 1e-5, "{found} {share}");
        }
        // Two thirds forwards and one third backwards.
        let kicks: Vec<Kick> = (0..3_000)
            .map(|index| Kick {
                duration: 1.0,
                stator: if index % 3 == 0 { -0.7 } else { 0.7 },
                impulse: 1.0,
            })
            .collect();
        assert!((stall_share(&kicks, 1e-5) - 1.0 / 3.0).abs() < 1e-3);
    }

    #[test]
    fn the_kicks_carry_the_weight() {
        let case = motor();
        let system = case.system().expect("legal");
        let map = system.dimensionless().map();
        let kicks = kicks(map, 0.0, 2e5, PERTURBATION, Noise::new(1)).expect("no failure");
        let (duration, impulse) =
            kicks.iter().fold((0.0, 0.0), |(time, sum), kick| (time + kick.duration, sum + kick.impulse));
        // All but what the last flight, cut off after its impact, has above the stator's speed.
        assert!((impulse / duration - 1.0).abs() < 5e-3, "{duration} {impulse}");
    }
}
