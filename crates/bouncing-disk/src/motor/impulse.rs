//! Where in the cycle of the stator the rotor gets its normal impulse, and the speed that follows.
//!
//! Between two moments of the same vertical state the normal impulse, of impacts and contact together, equals
//! the weight times the time between them. Friction passes on mu a_e of it, forwards wherever the stator
//! turns faster than the rotor and backwards elsewhere. For a rotor whose speed q changes little in one
//! impact therefore
//!
//! ```text
//! dq/dt = (mu a_e g/a_g^2) S(q/(omega Phi)),
//! S(x) = share of the impulse with cos(tau + theta) > x minus the rest
//! ```
//!
//! The steady speed is omega Phi times the impulse-weighted median of cos(tau + theta), and for a cycle of
//! few impacts the speed rises in straight lines that break where the rotor catches up with the stator at one
//! of them.
//!
//! The *stall load* is the T/(m a_g^2) of a constant load torque T at which the mean speed of the rotor over
//! a long run is zero. The vertical motion does not depend on the load, so all loads share one seeded list of
//! impulses, along which the speed is computed and the load bisected ([`ImpulseTrain`]). Friction never holds
//! the rotor meanwhile: at speed zero it would have to follow the stator, whose angular acceleration is some
//! thousand times the largest by friction in a motor ([`ImpulseTrain::hold_share`] is the inverse), so that
//! no range of loads stalls it.

mod compliant;

use std::convert::Infallible;
use std::f64::consts::TAU;

use bouncing_disk_core::numerics::elementary::cos;
use bouncing_disk_core::numerics::random::SplitMix64;
use bouncing_disk_core::numerics::roots::bisection;
use bouncing_disk_core::{Attachment, ChatterPolicy, ImpactMap, Launch, Orbit, OrbitEvent, Phase};

use crate::error::{Error, moderate_not_negative, positive, within_limit};
use crate::motor::batch::members::golden_share;
use crate::motor::circular::Concentration;
use crate::parameters::dimensionless::DimensionlessSystem;
use crate::toss::chattering_cycle::LONG_FLIGHT;
use crate::toss::multiple::MAX_EXAMINED;

/// Parts into which a segment of contact is divided.
const CONTACT_PARTS: u32 = 32;

/// Impacts after which a motion that does not come to rest is given up.
const LONGEST_CYCLE: usize = 10_000;

/// A normal impulse, and where in the cycle of the platform it acts.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct PhasedImpulse {
    /// Phase of the platform (rad).
    pub phase: f64,
    /// Impulse per mass of the disk, in units of g/omega.
    pub impulse: f64,
}

/// The normal impulses of an orbit, of impacts and of contact.
#[derive(Debug, Clone, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct NormalImpulses {
    /// Of single impacts.
    pub impacts: Vec<PhasedImpulse>,
    /// Phases (rad) of the impacts that end a flight longer than [`LONG_FLIGHT`], those of a last,
    /// incomplete cycle included. The infinitely many of a chattering sequence are not.
    pub landings: Vec<f64>,
    /// Of summed chattering and of contact, in parts.
    pub contact: Vec<PhasedImpulse>,
    /// Duration in radians, equal to the sum of all impulses between two separations.
    pub duration: f64,
}

impl NormalImpulses {
    /// The impulses of at least `impacts` impacts from one separation to a later one; none if the platform
    /// never falls away. Each separation gets a relative speed drawn evenly below `perturbation` (in units of
    /// g/omega, in [0, 1e100]); the last, incomplete cycle is omitted unless it is the only one.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for the perturbation; an error of the core for more than [`MAX_EXAMINED`]
    /// impacts; those of the flights.
    pub fn of(map: &ImpactMap, impacts: usize, perturbation: f64) -> Result<Self, Error> {
        moderate_not_negative("perturbation", perturbation)?;
        within_limit("impacts whose impulses are wanted", impacts, MAX_EXAMINED)?;
        let mut impulses = Self::default();
        let Some(phase) = map.vibration().separation_phase() else { return Ok(impulses) };
        let mut orbit = map.orbit_from_launch(Launch::new(phase, 0.0)?, ChatterPolicy::Complete);
        let mut separations = 0_u32;
        // The impulses after a separation are kept only once the next separation comes.
        let mut complete = (0, 0, 0.0);
        let mut flown = 0.0;
        let most = 4 * impacts + LONGEST_CYCLE;
        while impulses.impacts.len() < most {
            let Some(event) = orbit.advance()? else { break };
            match event {
                OrbitEvent::Impact(impact) => {
                    flown += impact.duration();
                    if impact.duration() > LONG_FLIGHT {
                        impulses.landings.push(impact.phase.angle());
                    }
                    let impulse = -(1.0 + map.restitution()) * impact.velocity;
                    impulses.impacts.push(PhasedImpulse { phase: impact.phase.angle(), impulse });
                }
                OrbitEvent::Attachment(rest) => {
                    let from = impulses.impacts.last().map_or(phase.angle(), |impact| impact.phase);
                    let Some(contact) = RestImpulses::of(map, &rest, from, CONTACT_PARTS) else { break };
                    impulses.contact.push(contact.chatter);
                    impulses.contact.extend(contact.parts().map(|part| {
                        let phase = Phase::new(part.middle).map_or(part.middle, |phase| phase.angle());
                        PhasedImpulse { phase, impulse: part.duration + part.gain }
                    }));
                    impulses.duration += flown + rest.accumulation.duration + contact.lasts();
                    flown = 0.0;
                    complete = (impulses.impacts.len(), impulses.contact.len(), impulses.duration);
                    if complete.0 >= impacts {
                        break;
                    }
                    separations += 1;
                    relaunch(&mut orbit, perturbation, separations)?;
                }
                _ => {}
            }
        }
        if complete.0 > 0 {
            impulses.impacts.truncate(complete.0);
            impulses.contact.truncate(complete.1);
            impulses.duration = complete.2;
        } else {
            impulses.duration = flown;
        }
        Ok(impulses)
    }

    fn all(&self) -> impl Iterator<Item = PhasedImpulse> {
        self.impacts.iter().chain(&self.contact).copied()
    }

    /// The sum of all impulses, in units of g/omega.
    #[must_use]
    pub fn total(&self) -> f64 {
        self.all().map(|one| one.impulse).sum()
    }

    /// Shares of the impulse in equal parts of the cycle, from tau = -pi to pi; NaN without impulse.
    #[must_use]
    pub fn histogram(&self, parts: usize) -> Vec<f64> {
        let mut shares = vec![0.0; parts];
        for one in self.all() {
            let turned = (one.phase / TAU + 0.5).rem_euclid(1.0);
            let part = ((turned * parts as f64) as usize).min(parts.saturating_sub(1));
            if let Some(share) = shares.get_mut(part) {
                *share += one.impulse;
            }
        }
        let total: f64 = shares.iter().sum();
        shares.iter().map(|share| share / total).collect()
    }

    /// Where in the cycle the impulse is concentrated; `None` without impulse.
    #[must_use]
    pub fn concentration(&self) -> Option<Concentration> {
        Concentration::of(self.all().map(|one| (one.phase, one.impulse)))
    }

    /// Where the [`landings`](Self::landings) are; `None` without any.
    #[must_use]
    pub fn concentration_of_collisions(&self) -> Option<Concentration> {
        Concentration::of(self.landings.iter().map(|phase| (*phase, 1.0)))
    }

    /// The balance of friction on a stator with this phase lag theta (rad).
    #[must_use]
    pub fn balance(&self, phase_lag: f64) -> ImpulseBalance {
        let mut levels: Vec<(f64, f64)> =
            self.all().map(|one| (cos(one.phase + phase_lag), one.impulse)).collect();
        levels.sort_by(|one, other| one.0.total_cmp(&other.0));
        let mut below = Vec::with_capacity(levels.len());
        let mut sum = 0.0;
        for (_, impulse) in &levels {
            sum += impulse;
            below.push(sum);
        }
        ImpulseBalance { speeds: levels.into_iter().map(|level| level.0).collect(), below }
    }
}

/// Gives the launch that is due a relative speed of an evenly filling sequence.
fn relaunch(orbit: &mut Orbit, perturbation: f64, index: u32) -> Result<(), Error> {
    if perturbation > 0.0 {
        let share = golden_share(index as usize);
        orbit.perturb_launch(perturbation * share)?;
    }
    Ok(())
}

/// The normal impulses from the last single impact before a rest to the separation after it.
#[derive(Debug, Clone, Copy)]
struct RestImpulses {
    /// Of the chattering sequence, as one at the attachment: impulse is change of velocity plus weight times
    /// time.
    chatter: PhasedImpulse,
    /// Angle of the separation, counted on from that of the attachment.
    until: f64,
    peak_acceleration: f64,
    parts: u32,
}

impl RestImpulses {
    /// Of a rest whose last single impact, or separation, was at the angle `last`; `None` if it lasts for
    /// ever. The contact is divided into `parts`.
    fn of(map: &ImpactMap, rest: &Attachment, last: f64, parts: u32) -> Option<Self> {
        let (leaves, turns) = rest.separation?;
        let peak_acceleration = map.vibration().peak_acceleration();
        let attached = rest.accumulation.phase.angle();
        let impulse =
            rest.accumulation.duration - rest.last_speed + peak_acceleration * (cos(attached) - cos(last));
        let until = leaves.angle() + TAU * turns as f64;
        Some(Self { chatter: PhasedImpulse { phase: attached, impulse }, until, peak_acceleration, parts })
    }

    /// Duration of the contact (rad).
    fn lasts(&self) -> f64 {
        self.until - self.chatter.phase
    }

    /// Duration of one part of it.
    fn step(&self) -> f64 {
        self.lasts() / f64::from(self.parts)
    }

    /// The parts of the contact, in their order.
    fn parts(&self) -> impl Iterator<Item = ContactPart> + use<> {
        let (from, step, peak) = (self.chatter.phase, self.step(), self.peak_acceleration);
        (0..self.parts).map(move |part| {
            let (start, end) = (from + step * f64::from(part), from + step * f64::from(part + 1));
            ContactPart {
                middle: 0.5 * (start + end),
                duration: end - start,
                gain: peak * (cos(end) - cos(start)),
            }
        })
    }
}

/// A part of a segment of contact: the impulse of the normal force 1 - P sin tau in it is the duration plus
/// the gain.
#[derive(Debug, Clone, Copy)]
struct ContactPart {
    /// Angle of its middle, not wrapped.
    middle: f64,
    /// Duration (rad).
    duration: f64,
    /// The change of the platform's axial velocity in it.
    gain: f64,
}

/// The balance between impulses that drive a rotor forwards and those that brake it: [`NormalImpulses`]
/// ordered by cos(tau + theta), the speed of the stator.
///
/// ```
/// use bouncing_disk::System;
/// use bouncing_disk::motor::NormalImpulses;
///
/// // The motor of Table III: where friction pushes forwards half of the time is its steady speed.
/// let motor = System::motor();
/// let impulses = NormalImpulses::of(motor.dimensionless().map(), 2_000, 1e-3)?;
/// let balance = impulses.balance(motor.platform().phase_lag());
/// let steady = balance.steady_speed() * motor.platform().peak_angular_speed();
/// assert!(steady > 10.0 && steady < 25.0);
/// // From rest it accelerates by (mu a_e g/a_g^2) S(0).
/// let stall = balance.net_share(0.0) * motor.disk().friction_acceleration();
/// assert!(stall > 0.0 && stall < motor.disk().friction_acceleration());
/// # Ok::<(), bouncing_disk::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct ImpulseBalance {
    speeds: Vec<f64>,
    /// Sum of the impulses up to each.
    below: Vec<f64>,
}

impl ImpulseBalance {
    /// S: share of the impulse where the stator turns faster than `speed` (in units of omega Phi) minus the
    /// rest.
    #[must_use]
    pub fn net_share(&self, speed: f64) -> f64 {
        let slower = self.speeds.partition_point(|level| *level <= speed);
        let total = self.below.last().copied().unwrap_or(1.0);
        let below = if slower == 0 { 0.0 } else { self.below[slower - 1] };
        1.0 - 2.0 * below / total
    }

    /// The steady speed in units of omega Phi: the weighted median; zero without impulse.
    #[must_use]
    pub fn steady_speed(&self) -> f64 {
        let half = 0.5 * self.below.last().copied().unwrap_or(0.0);
        let index = self.below.partition_point(|sum| *sum < half);
        self.speeds.get(index).or(self.speeds.last()).copied().unwrap_or(0.0)
    }

    /// Times in units of the rise time omega Phi a_g^2/(mu a_e g) ([`crate::System::rise_time`]), and the
    /// speed from rest at them in units of omega Phi: `count` equal steps up to `rises`.
    #[must_use]
    pub fn transient(&self, rises: f64, count: u32) -> (Vec<f64>, Vec<f64>) {
        let step = rises / f64::from(count);
        let mut speed = 0.0;
        let (mut times, mut speeds) = (Vec::new(), Vec::new());
        for index in 1..=count {
            let half = speed + 0.5 * step * self.net_share(speed);
            speed += step * self.net_share(half);
            times.push(step * f64::from(index));
            speeds.push(speed);
        }
        (times, speeds)
    }
}

/// Halvings of the range of loads, from minus to plus the most that friction can give: to 2e-6 of it, far
/// below the statistical error.
const HALVINGS: u32 = 20;

/// Parts into which a segment of contact is divided.
const TRAIN_PARTS: u32 = 16;

/// Most impulses of an [`ImpulseTrain`]: about a gigabyte with their times.
pub const MAX_IMPULSES: usize = 50_000_000;

/// A time without friction and the normal impulse at its end.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Kick {
    /// Radians since the kick before.
    duration: f64,
    /// The stator's angular speed in units of omega Phi.
    stator: f64,
    /// In units of m g/omega.
    impulse: f64,
}

/// The normal impulses of a motor in their order, and the motion of a rotor under them against a load.
#[derive(Debug, Clone, PartialEq)]
pub struct ImpulseTrain {
    kicks: Vec<Kick>,
    /// The change of speed, in units of omega Phi, by an impulse of 1.
    grip: f64,
    hold_share: f64,
}

impl ImpulseTrain {
    /// The impulses of at least `duration` (rad, positive) from a separation on. Every separation gets a
    /// relative speed drawn evenly below `perturbation` (in units of g/omega, in [0, 1e100]) from the stream
    /// of `seed`. A motor whose stator never throws the rotor has no impulses.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for the numbers, and for a stator that does not twist; an error of the core for
    /// more than [`MAX_IMPULSES`]; those of the flights.
    pub fn new(
        system: &DimensionlessSystem,
        duration: f64,
        perturbation: f64,
        seed: u64,
    ) -> Result<Self, Error> {
        positive("duration", duration)?;
        moderate_not_negative("perturbation", perturbation)?;
        // Per radian, friction with the mean normal force gives this share of the stator's largest speed.
        let grip = system.friction() / positive("twist_speed", system.twist_speed())?;
        let hold_share = grip * (1.0 + system.peak_acceleration());
        Ok(Self { kicks: kicks(system, duration, perturbation, SplitMix64::new(seed))?, grip, hold_share })
    }

    /// The largest angular acceleration that friction can give in contact over the stator's largest one:
    /// where it is small, friction can hold the rotor on the stator only for an instant about the extremes
    /// of the stator's speed.
    #[must_use]
    pub const fn hold_share(&self) -> f64 {
        self.hold_share
    }

    /// The mean speed in units of omega Phi, from rest, against a load of `share` times the most that
    /// friction can give on average ([`crate::Disk::friction_acceleration`]); zero without impulses.
    #[must_use]
    pub fn mean_speed(&self, share: f64) -> f64 {
        let (mut speed, mut turned, mut elapsed) = (0.0, 0.0, 0.0);
        for kick in &self.kicks {
            let lost = share * self.grip * kick.duration;
            turned += kick.duration * (speed - 0.5 * lost);
            elapsed += kick.duration;
            speed -= lost;
            let most = self.grip * kick.impulse;
            speed -= (speed - kick.stator).clamp(-most, most);
        }
        if elapsed > 0.0 { turned / elapsed } else { 0.0 }
    }

    /// The load at which the mean speed changes its sign, as a share of the most that friction can give on
    /// average: between -1 and 1, to 2e-6.
    ///
    /// ```
    /// use bouncing_disk::System;
    /// use bouncing_disk::motor::ImpulseTrain;
    ///
    /// let motor = System::motor();
    /// // Twelve rise times of the speed: where it starts does not matter.
    /// let duration = 12.0 * motor.rise_time() * motor.platform().angular_frequency();
    /// let train = ImpulseTrain::new(motor.dimensionless(), duration, 1e-3, 11)?;
    /// // The load in rad/s^2 that stalls the motor.
    /// let load = train.stall_share() * motor.disk().friction_acceleration();
    /// assert!(load > 10.0 && load < 30.0);
    /// # Ok::<(), bouncing_disk::Error>(())
    /// ```
    #[must_use]
    pub fn stall_share(&self) -> f64 {
        let Ok(share) =
            bisection(-1.0, 1.0, HALVINGS, |share| Ok::<_, Infallible>(self.mean_speed(share) > 0.0));
        share
    }
}

fn kicks(
    system: &DimensionlessSystem,
    duration: f64,
    perturbation: f64,
    mut random: SplitMix64,
) -> Result<Vec<Kick>, Error> {
    let (map, phase_lag) = (system.map(), system.phase_lag());
    let mut kicks = Vec::new();
    let Some(phase) = map.vibration().separation_phase() else { return Ok(kicks) };
    let first = perturbation * random.unit();
    let mut orbit = map.orbit_from_launch(Launch::new(phase, first)?, ChatterPolicy::Complete);
    let (mut elapsed, mut last) = (0.0, phase.angle());
    while elapsed < duration {
        within_limit("impulses of a motor", kicks.len(), MAX_IMPULSES)?;
        let Some(event) = orbit.advance()? else { break };
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
                let Some(contact) = RestImpulses::of(map, &rest, last, TRAIN_PARTS) else { break };
                let chattered = rest.accumulation.duration;
                kicks.push(Kick {
                    duration: chattered,
                    stator: cos(contact.chatter.phase + phase_lag),
                    impulse: contact.chatter.impulse,
                });
                let step = contact.step();
                kicks.extend(contact.parts().map(|part| Kick {
                    duration: step,
                    stator: cos(part.middle + phase_lag),
                    impulse: step + part.gain,
                }));
                elapsed += chattered + contact.lasts();
                last = rest.separation.map_or(last, |(leaves, _)| leaves.angle());
                orbit.perturb_launch(perturbation * random.unit())?;
            }
            _ => {}
        }
    }
    Ok(kicks)
}

#[cfg(test)]
mod tests {
    use crate::System;
    use bouncing_disk_core::Vibration;

    use super::*;

    fn map(peak: f64, restitution: f64) -> ImpactMap {
        let forcing = peak / std::f64::consts::PI;
        ImpactMap::new(Vibration::from_axial_forcing(forcing).expect("legal"), restitution).expect("legal")
    }

    #[test]
    fn the_impulse_of_a_cycle_is_the_weight_times_its_duration() {
        for (peak, restitution) in [(19.739_208_8, 0.5), (197.4, 0.3), (3.0, 0.0), (1.5, 0.5)] {
            let impulses = NormalImpulses::of(&map(peak, restitution), 1, 0.0).expect("no failure");
            let off = impulses.total() / impulses.duration - 1.0;
            assert!(off.abs() < 1e-9, "{peak} {restitution}: {off}");
        }
    }

    #[test]
    fn half_of_the_impulse_lies_below_the_steady_speed() {
        let impulses = NormalImpulses::of(&map(197.4, 0.5), 2_000, 1e-3).expect("no failure");
        let balance = impulses.balance(0.0);
        let steady = balance.steady_speed();
        assert!(balance.net_share(steady - 1e-6) >= 0.0 && balance.net_share(steady + 1e-6) <= 0.0);
        assert!(balance.net_share(-1.0 - 1e-9) >= 1.0 && balance.net_share(1.0) <= -1.0 + 1e-12);
        let (_, speeds) = balance.transient(20.0, 4_000);
        assert!((speeds[3_999] - steady).abs() < 0.02, "{} {steady}", speeds[3_999]);
        assert!((impulses.histogram(16).iter().sum::<f64>() - 1.0).abs() < 1e-12);
    }

    #[test]
    fn what_never_leaves_has_no_impulses_and_too_many_are_refused() {
        let none = NormalImpulses::of(&map(0.5, 0.5), 10, 0.0).expect("legal");
        assert_eq!(none, NormalImpulses::default());
        assert!(none.concentration().is_none() && none.histogram(0).is_empty());
        assert!(none.balance(0.0).steady_speed().abs() <= 0.0);
        for (impacts, perturbation) in [(usize::MAX, 0.0), (10, -1.0), (10, f64::NAN)] {
            assert!(NormalImpulses::of(&map(2.0, 0.5), impacts, perturbation).is_err());
        }
    }

    /// All the impulse at one phase: the load that balances is all that friction can give, with the sign of
    /// the stator's speed. Over n kicks the speed falls by the load before each of them, so that its mean is
    /// zero for (n - 1)/n of that.
    #[test]
    fn a_stator_that_is_always_hit_at_one_phase_bears_the_whole_limit() {
        let train = |kicks: Vec<Kick>, grip: f64| ImpulseTrain { kicks, grip, hold_share: 0.0 };
        for (stator, share) in [(0.7, 0.999), (-0.7, -0.999)] {
            let kicks = vec![Kick { duration: 1.0, stator, impulse: 1.0 }; 1_000];
            let found = train(kicks, 1e-4).stall_share();
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
        assert!((train(kicks, 1e-5).stall_share() - 1.0 / 3.0).abs() < 1e-3);
    }

    #[test]
    fn the_kicks_carry_the_weight() {
        let motor = System::motor();
        let train = ImpulseTrain::new(motor.dimensionless(), 2e5, 1e-3, 1).expect("no failure");
        let (duration, impulse) = train
            .kicks
            .iter()
            .fold((0.0, 0.0), |(time, sum), kick| (time + kick.duration, sum + kick.impulse));
        // All but what the last flight, cut off after its impact, has above the stator's speed.
        assert!((impulse / duration - 1.0).abs() < 5e-3, "{duration} {impulse}");
        assert!(train.hold_share() < 1e-2);
    }

    #[test]
    fn a_motor_that_does_not_twist_has_no_unit_of_speed_and_one_that_does_not_bounce_no_impulses() {
        let motor = System::motor();
        let still = motor.with_platform(|stator| stator.twist_amplitude = 0.0).expect("legal");
        assert!(ImpulseTrain::new(still.dimensionless(), 1e3, 0.0, 1).is_err());
        let gentle = motor.with_platform(|stator| stator.amplitude = 1e-12).expect("legal");
        let train = ImpulseTrain::new(gentle.dimensionless(), 1e3, 0.0, 1).expect("legal");
        assert!(train.mean_speed(0.5).abs() <= 0.0);
        for (duration, perturbation) in [(0.0, 0.0), (f64::NAN, 0.0), (1.0, -1.0)] {
            assert!(ImpulseTrain::new(motor.dimensionless(), duration, perturbation, 1).is_err());
        }
    }
}
