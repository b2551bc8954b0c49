//! The load at which a motor stalls.
//!
//! A constant load torque T takes T/(m a_g^2) of angular speed per time. The *stall load* is the T/(m a_g^2)
//! at which the rotor's mean speed over a long run is zero. The vertical motion knows no load, so all loads
//! share one seeded list of collisions and segments of contact, along which the speed is carried and the load
//! bisected. Friction never holds the rotor meanwhile: at speed zero it would have to follow the stator,
//! whose angular acceleration is some thousand times what friction can give in a motor
//! ([`ImpulseTrain::hold_share`] is the inverse), so that there is no range of loads that all stall it.
//!
//! Beside it stands what the balance of the normal impulse says ([`crate::ImpulseBalance`]): a rotor held at
//! rest gets the mean acceleration (mu a_e g/a_g^2) S(0), and a load of this size stalls it as long as its
//! speed strays little from zero.

use std::convert::Infallible;

use bouncing_disk_core::numerics::elementary::cos;
use bouncing_disk_core::numerics::random::SplitMix64;
use bouncing_disk_core::numerics::roots::bisection;
use bouncing_disk_core::{ChatterPolicy, Launch, OrbitEvent};

use crate::error::{Error, moderate_not_negative, positive, within_limit};
use crate::motor::impulse::RestImpulses;
use crate::parameters::dimensionless::DimensionlessSystem;

/// Halvings of the range of loads, from minus to plus the most that friction can give: to 2e-6 of it, far
/// below the statistical error.
const HALVINGS: u32 = 20;

/// Parts into which a segment of contact is divided.
const CONTACT_PARTS: u32 = 16;

/// Most impulses of an [`ImpulseTrain`]: with their times some gigabyte.
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

/// The normal impulses of a motor in their order, and what a rotor does under them against a load.
#[derive(Debug, Clone, PartialEq)]
pub struct ImpulseTrain {
    kicks: Vec<Kick>,
    /// The change of speed, in units of omega Phi, by an impulse of 1.
    grip: f64,
    hold_share: f64,
}

impl ImpulseTrain {
    /// Of at least `duration` (rad, positive) from a separation on. Every separation gets a relative speed
    /// drawn evenly below `perturbation` (in units of g/omega, in [0, 1e100]) from the stream of `seed`. A
    /// motor whose stator never throws the rotor has no impulses.
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
    /// where it is small, friction cannot hold the rotor on the stator but for an instant about the turning
    /// points of the stator's speed.
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
    /// use bouncing_disk::{ImpulseTrain, System};
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
                let Some(contact) = RestImpulses::of(map, &rest, last, CONTACT_PARTS) else { break };
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
    use super::*;
    use crate::System;

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
