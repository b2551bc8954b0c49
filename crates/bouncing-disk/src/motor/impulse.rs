//! The distribution of the rotor's normal impulse over the stator's cycle, and the resulting speed.
//!
//! Between two instants with the same vertical state, the total normal impulse of impacts and contact equals
//! the weight times the time between them. Friction transmits mu a_e times this impulse to the rotor,
//! forwards while the stator turns faster than the rotor and backwards otherwise. For a rotor whose speed q
//! changes little in one impact, therefore,
//!
//! ```text
//! dq/dt = (mu a_e g/a_g^2) S(q/(omega Phi)),
//! S(x) = share of the impulse with cos(tau + theta) > x minus the rest
//! ```
//!
//! The steady speed is omega Phi times the impulse-weighted median of cos(tau + theta). For a cycle of few
//! impacts the speed rises along straight lines, whose slope changes whenever the rotor reaches the stator's
//! speed at one of the impacts.

mod compliant;

use std::f64::consts::TAU;

use bouncing_disk_core::numerics::elementary::cos;
use bouncing_disk_core::{Attachment, ChatterPolicy, ImpactMap, Launch, Orbit, OrbitEvent, Phase};

use crate::error::{Error, moderate_not_negative, within_limit};
use crate::motor::batch::members::golden_share;
use crate::motor::circular::Concentration;
use crate::toss::chattering_cycle::LONG_FLIGHT;
use crate::toss::multiple::MAX_EXAMINED;

/// Parts into which a segment of contact is divided.
const CONTACT_PARTS: u32 = 32;

/// Impacts after which a motion that does not come to rest is abandoned.
const LONGEST_CYCLE: usize = 10_000;

/// A normal impulse and the phase of the platform at which it acts.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct PhasedImpulse {
    /// Phase of the platform (rad).
    pub phase: f64,
    /// Impulse per mass of the disk, in units of g/omega.
    pub impulse: f64,
}

/// The normal impulses of impacts and of contact along an orbit.
#[derive(Debug, Clone, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct NormalImpulses {
    /// Impulses of single impacts.
    pub impacts: Vec<PhasedImpulse>,
    /// Phases (rad) of the impacts that end a flight longer than [`LONG_FLIGHT`], including those of a last,
    /// incomplete cycle, but not the infinitely many of a chattering sequence.
    pub landings: Vec<f64>,
    /// Impulses of summed chattering and of contact, divided into parts.
    pub contact: Vec<PhasedImpulse>,
    /// Duration in radians, equal to the sum of all impulses between two separations.
    pub duration: f64,
}

impl NormalImpulses {
    /// The impulses of at least `impacts` impacts from one separation to a later one; empty if the platform
    /// never falls away. Each separation is perturbed by a relative speed, uniformly distributed below
    /// `perturbation` (in units of g/omega, in [0, 1e100]). The last, incomplete cycle is omitted unless it
    /// is the only one.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for the perturbation; an error of the core for more than [`MAX_EXAMINED`]
    /// impacts; the errors of the flights.
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
                    let Some(contact) = RestImpulses::of(map, &rest, from) else { break };
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

    /// Shares of the impulse in equal parts of the cycle, from tau = -pi to pi; NaN if the impulse is zero.
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

    /// The concentration of the impulse in the cycle; `None` if the impulse is zero.
    #[must_use]
    pub fn concentration(&self) -> Option<Concentration> {
        Concentration::of(self.all().map(|one| (one.phase, one.impulse)))
    }

    /// The concentration of the [`landings`](Self::landings); `None` without any.
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

/// Sets the relative speed of the next launch, from a sequence that fills its range evenly.
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
    /// Impulse of the chattering sequence, treated as a single impulse at the attachment: change of velocity
    /// plus weight times time.
    chatter: PhasedImpulse,
    /// Angle of the separation, counted from the attachment without wrapping.
    until: f64,
    peak_acceleration: f64,
}

impl RestImpulses {
    /// The impulses of a rest whose last single impact, or separation, was at the angle `last`; `None` if the
    /// rest lasts for ever.
    fn of(map: &ImpactMap, rest: &Attachment, last: f64) -> Option<Self> {
        let (leaves, turns) = rest.separation?;
        let peak_acceleration = map.vibration().peak_acceleration();
        let attached = rest.accumulation.phase.angle();
        let impulse =
            rest.accumulation.duration - rest.last_speed + peak_acceleration * (cos(attached) - cos(last));
        let until = leaves.angle() + TAU * turns as f64;
        Some(Self { chatter: PhasedImpulse { phase: attached, impulse }, until, peak_acceleration })
    }

    /// Duration of the contact (rad).
    fn lasts(&self) -> f64 {
        self.until - self.chatter.phase
    }

    /// Duration of one part of the contact.
    fn step(&self) -> f64 {
        self.lasts() / f64::from(CONTACT_PARTS)
    }

    /// The parts of the contact, in their order.
    fn parts(&self) -> impl Iterator<Item = ContactPart> + use<> {
        let (from, step, peak) = (self.chatter.phase, self.step(), self.peak_acceleration);
        (0..CONTACT_PARTS).map(move |part| {
            let (start, end) = (from + step * f64::from(part), from + step * f64::from(part + 1));
            ContactPart {
                middle: 0.5 * (start + end),
                duration: end - start,
                gain: peak * (cos(end) - cos(start)),
            }
        })
    }
}

/// A part of a segment of contact. The impulse of the normal force 1 - P sin tau over this part is the
/// duration plus the gain.
#[derive(Debug, Clone, Copy)]
struct ContactPart {
    /// Angle of its midpoint, not wrapped.
    middle: f64,
    /// Duration (rad).
    duration: f64,
    /// The change of the platform's axial velocity during the part.
    gain: f64,
}

/// The balance between impulses that drive a rotor forwards and impulses that brake it: [`NormalImpulses`]
/// ordered by cos(tau + theta), the speed of the stator.
///
/// ```
/// use bouncing_disk::System;
/// use bouncing_disk::motor::NormalImpulses;
///
/// // The motor of Table III: at its steady speed friction pushes forwards half of the time.
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
    /// Cumulative sums of the impulses.
    below: Vec<f64>,
}

impl ImpulseBalance {
    /// The net share S: the share of the impulse that acts while the stator turns faster than `speed` (in
    /// units of omega Phi), minus the remaining share.
    #[must_use]
    pub fn net_share(&self, speed: f64) -> f64 {
        let slower = self.speeds.partition_point(|level| *level <= speed);
        let total = self.below.last().copied().unwrap_or(1.0);
        let below = if slower == 0 { 0.0 } else { self.below[slower - 1] };
        1.0 - 2.0 * below / total
    }

    /// The steady speed in units of omega Phi: the weighted median; zero if the impulse is zero.
    #[must_use]
    pub fn steady_speed(&self) -> f64 {
        let half = 0.5 * self.below.last().copied().unwrap_or(0.0);
        let index = self.below.partition_point(|sum| *sum < half);
        self.speeds.get(index).or(self.speeds.last()).copied().unwrap_or(0.0)
    }

    /// The run-up from rest, in `count` equal steps up to the time `rises`: times in units of the rise time
    /// omega Phi a_g^2/(mu a_e g) ([`crate::System::rise_time`]), and the speeds at these times in units of
    /// omega Phi.
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

#[cfg(test)]
mod tests {
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
}
