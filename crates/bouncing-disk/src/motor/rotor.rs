//! The rotary motion alone, carried along an orbit of the core without records or energy balance.
//!
//! The contact motion is the same as that of [`crate::Engine`] ([`crate::motion::contact_motion`]). Only the
//! sum over a chattering sequence is simpler: if all of its impacts slide the same way, the total impulse is
//! known in closed form.

pub(crate) mod transient;

use bouncing_disk_core::{Attachment, ChatterPolicy, Launch, Orbit, OrbitEvent, Phase};

use crate::error::Error;
use crate::motion::chatter::Chatter;
use crate::motion::contact_motion::{Lying, Placed};
use crate::motion::friction::Friction;
use crate::motion::impact::{FrictionImpact, axial_impulse, friction_impact};
use crate::motion::phase_time::{PhaseSpan, PhaseTime};
use crate::motion::rotary_change::RotaryChange;
use crate::motion::rotary_change::{change_in_contact, change_in_flight};
use crate::parameters::dimensionless::DimensionlessSystem;

/// The end of the last step of a [`Rotor`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum RotorStep {
    /// An impact.
    Impact,
    /// The end of a chattering sequence, or a change between sticking and sliding.
    Contact,
    /// The disk has separated from rest: the next flight starts here.
    Separation,
    /// No further event: the disk stays on the platform for ever, at rest, sliding or turning with it.
    Ended,
}

/// The rotary part of a flight and the impact that ends it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Bounce {
    /// Duration of the flight (rad).
    pub(crate) duration: f64,
    /// Angular speed of the platform at the impact.
    pub(crate) platform_speed: f64,
    /// Relative axial velocity before the impact.
    pub(crate) velocity: f64,
    pub(crate) restitution: f64,
    pub(crate) friction: f64,
    pub(crate) load: f64,
}

impl Bounce {
    /// The rotary motion of the flight, for a disk with angular `speed` at launch.
    #[inline(always)]
    pub(crate) fn flight(self, speed: f64) -> RotaryChange {
        change_in_flight(self.load, speed, self.duration)
    }

    /// The effect of friction in the impact, for a `slip` (disk minus platform).
    #[inline(always)]
    pub(crate) fn friction_impact(self, slip: f64) -> FrictionImpact {
        friction_impact(self.friction, axial_impulse(self.restitution, self.velocity), slip)
    }

    /// Angular speed after the impact, and the angle turned in the flight, for a disk with angular `speed` at
    /// launch.
    #[inline(always)]
    pub(crate) fn after(self, speed: f64) -> (f64, f64) {
        let flight = self.flight(speed);
        let rotary = self.friction_impact(flight.speed - self.platform_speed);
        (rotary.speed_after(flight.speed, self.platform_speed), flight.angle)
    }
}

/// A disk of which only the angular speed is followed.
#[derive(Debug, Clone)]
pub(crate) struct Rotor {
    system: DimensionlessSystem,
    friction: Friction,
    orbit: Option<Orbit>,
    /// `None` in flight.
    contact: Option<Lying>,
    now: PhaseTime,
    speed: f64,
    /// Angle turned in the last step.
    turned: f64,
}

impl Rotor {
    /// A disk that lies on the platform at `phase` with angular `speed`; the disk is in flight if the
    /// platform falls away there.
    pub(crate) fn at_rest(
        system: &DimensionlessSystem,
        phase: Phase,
        speed: f64,
        policy: ChatterPolicy,
    ) -> Result<Self, Error> {
        let friction = Friction::new(system);
        let Placed { orbit, lying: contact, speed } =
            Placed::new(system, system.map(), &friction, phase, speed, policy)?;
        let now = PhaseTime::in_first_period(phase);
        Ok(Self { system: *system, friction, orbit, contact, now, speed, turned: 0.0 })
    }

    pub(crate) const fn time(&self) -> PhaseTime {
        self.now
    }

    /// Angular speed just after the last step.
    pub(crate) const fn speed(&self) -> f64 {
        self.speed
    }

    /// Angle turned during the last step.
    pub(crate) const fn turned(&self) -> f64 {
        self.turned
    }

    pub(crate) const fn system(&self) -> &DimensionlessSystem {
        &self.system
    }

    /// The flight that starts now, if one does.
    pub(crate) fn launch(&self) -> Option<Launch> {
        if self.contact.is_some() {
            return None;
        }
        self.orbit.as_ref().and_then(Orbit::launch)
    }

    /// Continues with an orbit that was computed elsewhere, after an impact at `phase` that leaves the
    /// angular speed `speed`.
    pub(crate) fn go_on_after(&mut self, phase: Phase, orbit: Orbit, periods: u64, speed: f64) {
        self.orbit = Some(orbit);
        self.now = PhaseTime { periods, phase };
        self.speed = speed;
    }

    /// Continues with a launch that was computed elsewhere, at angular speed `speed`.
    pub(crate) fn go_on_with(
        &mut self,
        launch: Launch,
        policy: ChatterPolicy,
        periods: u64,
        speed: f64,
    ) -> Result<(), Error> {
        let (phase, relative_speed) = (launch.phase(), launch.relative_speed());
        self.orbit = Some(self.system.map().orbit_from_launch(Launch::new(phase, relative_speed)?, policy));
        self.now = PhaseTime { periods, phase };
        self.speed = speed;
        Ok(())
    }

    /// Sets the relative launch speed of the flight that starts now.
    pub(crate) fn perturb_launch(&mut self, relative_speed: f64) -> Result<(), Error> {
        if let Some(orbit) = &mut self.orbit {
            orbit.perturb_launch(relative_speed)?;
        }
        Ok(())
    }

    #[inline]
    pub(crate) fn advance(&mut self) -> Result<RotorStep, Error> {
        if let Some(contact) = self.contact {
            return self.advance_contact(contact);
        }
        let event = match &mut self.orbit {
            Some(orbit) => orbit.advance()?,
            None => None,
        };
        match event {
            Some(OrbitEvent::Impact(impact)) => {
                let bounce = Bounce {
                    duration: impact.duration(),
                    platform_speed: self.system.platform_angular_speed(impact.phase),
                    velocity: impact.velocity,
                    restitution: self.system.restitution(),
                    friction: self.system.friction(),
                    load: self.system.load(),
                };
                (self.speed, self.turned) = bounce.after(self.speed);
                self.now = PhaseTime { periods: self.now.periods + impact.turns, phase: impact.phase };
                Ok(RotorStep::Impact)
            }
            Some(OrbitEvent::Attachment(rest)) => {
                self.attach(&rest);
                Ok(RotorStep::Contact)
            }
            Some(_) | None => Ok(RotorStep::Ended),
        }
    }

    fn attach(&mut self, rest: &Attachment) {
        let at = rest.accumulation;
        let start = self.speed;
        if !at.error_bound.is_infinite() && rest.last_speed > 0.0 {
            self.speed = match self.slide_throughout(rest) {
                Some(speed) => speed,
                None => self.sum_chatter(rest),
            };
        }
        self.turned = 0.5 * (start + self.speed) * at.duration;
        self.now = PhaseTime { periods: self.now.periods + at.turns, phase: at.phase };
        let contact = Lying::after_attachment(&self.system, &self.friction, self.now, self.speed, rest);
        self.contact = Some(contact);
    }

    /// The speed after a chattering sequence in which all impacts slide the same way; `None` if this is not
    /// certain.
    ///
    /// The relative velocity ends at zero, 0 = w - integral of N + sum. So the sum of the impulses is the
    /// integral of the normal force N up to the accumulation point minus the launch speed w.
    fn slide_throughout(&self, rest: &Attachment) -> Option<f64> {
        let duration = rest.accumulation.duration;
        let vibration = self.system.vibration();
        let from = self.now.phase;
        // N = a - b t + (1 - a) t^2/2 about the start, to the accuracy of the duration itself.
        let pull = vibration.contact_force(from);
        let drift = vibration.velocity(from);
        let normal = duration * (pull - duration * (0.5 * drift - duration * (1.0 - pull) * (1.0 / 6.0)));
        let sum = self.system.friction() * (normal - rest.last_speed);
        let load = self.system.load() * duration;
        let slip = self.speed - self.system.platform_angular_speed(from);
        let most = sum + load.abs() + self.system.twist_speed() * duration;
        if slip > most {
            Some(self.speed - sum - load)
        } else if slip < -most {
            Some(self.speed + sum - load)
        } else {
            None
        }
    }

    /// The speed after a chattering sequence, impact by impact.
    #[cold]
    fn sum_chatter(&self, rest: &Attachment) -> f64 {
        let at = rest.accumulation;
        let chatter = Chatter::new(&self.system, self.now.phase, rest.last_speed, self.speed, at.duration);
        if chatter.capped {
            self.system.platform_angular_speed(at.phase)
        } else {
            chatter.angular_speed - self.system.load() * (at.duration - chatter.time)
        }
    }

    /// Angle turned within `span` after the last step by a rotor that stays on the stator without a change of
    /// mode; zero in flight.
    pub(crate) fn turned_since_event(&self, span: PhaseSpan) -> f64 {
        let Some(contact) = self.contact else { return 0.0 };
        let phases = (self.now.phase, self.now.after(span).phase);
        change_in_contact(&self.system, contact.mode(), self.speed, phases, span).angle
    }

    fn advance_contact(&mut self, contact: Lying) -> Result<RotorStep, Error> {
        let Some(step) = contact.next(&self.system, &self.friction, self.now, self.speed)? else {
            self.turned = 0.0;
            return Ok(RotorStep::Ended);
        };
        self.turned = step.change.angle;
        self.speed = step.speed;
        self.now = step.time;
        self.contact = step.next;
        Ok(if self.contact.is_some() { RotorStep::Contact } else { RotorStep::Separation })
    }
}

#[cfg(test)]
mod tests;
