//! A tape of rigid impacts on a sine: flights and impacts of the core's orbit, with rests in between.

use std::f64::consts::TAU;

use bouncing_disk_core::numerics::elementary::cos;
use bouncing_disk_core::run::WorkCount;
use bouncing_disk_core::{Attachment, ChatterPolicy, Impact, OrbitEvent, Phase};

use super::recurrence::{Key, Touch};
use super::{Knot, Tape};
use crate::error::Error;
use crate::motion::chatter::Chatter;
use crate::motion::energy::EnergyLedger;
use crate::motion::engine::{Engine, chatter_speed};
use crate::motion::event::Event;
use crate::motion::impact::{axial_impulse, rebound_velocity};
use crate::motion::initial_condition::InitialCondition;
use crate::motion::phase_time::PhaseTime;
use crate::motion::state::{DiskState, Mode};
use crate::motor::batch::shared_orbit::vertical::VerticalMotion;
use crate::motor::rotor::transient::FLIGHTS_OF_EVENT;
use crate::parameters::dimensionless::{DimensionlessParameters, DimensionlessSystem};
use crate::stator::MODES;

/// Rigid impacts on a sine.
#[derive(Debug, Clone)]
pub(crate) struct RigidTape {
    /// `None` for a platform that never falls away.
    vertical: Option<VerticalMotion>,
    /// The disk while it lies on the platform, without friction.
    engine: Engine,
    /// Whether the disk lies on the platform.
    rests: bool,
    /// Kinetic and potential energy after the last event.
    energy: f64,
}

impl RigidTape {
    /// A disk that lies on the platform at `phase`, or is thrown up from it with this multiple of the
    /// platform's largest speed. Each separation is perturbed by a speed of up to this size from a stream
    /// with this seed.
    pub(crate) fn new(
        system: &DimensionlessSystem,
        (phase, thrown): (Phase, Option<f64>),
        perturbation: (f64, u64),
    ) -> Result<Self, Error> {
        let own = system.parameters();
        let still = DimensionlessParameters { friction: 0.0, load: 0.0, twist_speed: 0.0, ..own }.build()?;
        let (policy, angular_speed) = (ChatterPolicy::Complete, 0.0);
        let engine = Engine::new(still, InitialCondition::Contact { phase, angular_speed }, policy)?;
        let vertical = VerticalMotion::from_rest(system, phase, policy, perturbation)?;
        let speed = thrown.map_or(0.0, |thrown| thrown * system.peak_acceleration());
        let vertical = match vertical {
            Some(vertical) if thrown.is_some() => Some(vertical.thrown(phase, speed, policy)?),
            vertical => vertical,
        };
        let rests = thrown.is_none() && !engine.launches();
        let mut tape = Self { vertical, engine, rests, energy: 0.0 };
        tape.energy = tape.energy_at(PhaseTime::in_first_period(phase), speed);
        Ok(tape)
    }

    /// The end of the recorded motion.
    pub(crate) fn time(&self) -> PhaseTime {
        self.vertical.as_ref().map_or_else(|| self.engine.time(), VerticalMotion::now)
    }

    /// Records the motion up to the next impact or the end of a rest, or for a period if the disk lies for
    /// ever.
    pub(crate) fn record(&mut self, tape: &mut Tape, work: &mut WorkCount<'_>) -> Result<Touch, Error> {
        let Some(vertical) = &mut self.vertical else {
            work.spend(FLIGHTS_OF_EVENT)?;
            self.press(tape, self.engine.time().phase.angle(), TAU);
            tape.axial.impacts += 1;
            return Ok(Touch::Lies);
        };
        if std::mem::take(&mut self.rests) {
            work.spend(FLIGHTS_OF_EVENT)?;
            self.rest(None, tape)?;
            return Ok(Touch::None);
        }
        match vertical.advance()? {
            Some(OrbitEvent::Impact(impact)) => {
                work.spend(1)?;
                Ok(Touch::At(self.hit(&impact, tape)))
            }
            Some(OrbitEvent::Attachment(rest)) => {
                work.spend(2 * FLIGHTS_OF_EVENT)?;
                self.rest(Some(&rest), tape)?;
                Ok(Touch::None)
            }
            // A platform that has once fallen away from the disk does so again and again.
            Some(_) | None => Ok(Touch::None),
        }
    }

    fn hit(&mut self, impact: &Impact, tape: &mut Tape) -> Key {
        let Some(vertical) = &self.vertical else {
            return Key::new(impact.phase, [0.0; 3], [[0.0; 2]; MODES]);
        };
        let restitution = vertical.restitution();
        let impulse = axial_impulse(restitution, impact.velocity);
        let (sin, cos) = (impact.phase.sin(), impact.phase.cos());
        let knot = Knot { duration: impact.duration(), sin, cos, pressed: 0.0, hit: impulse };
        let energy = self.energy_at(vertical.now(), rebound_velocity(restitution, impact.velocity));
        tape.push(knot, impact.phase.angle());
        let axial = &mut tape.axial;
        axial.duration += impact.duration();
        axial.impacts += 1;
        axial.normal_work += impulse * self.engine.system().vibration().velocity(impact.phase);
        axial.restitution_loss +=
            0.5 * ((1.0 - restitution) * (1.0 + restitution)) * (impact.velocity * impact.velocity);
        axial.energy_change += energy - std::mem::replace(&mut self.energy, energy);
        Key::new(impact.phase, [impact.velocity, 0.0, 0.0], [[0.0; 2]; MODES])
    }

    /// Records a rest of the disk up to its separation, with the preceding chatter; without an attachment,
    /// this is the first rest.
    fn rest(&mut self, rest: Option<&Attachment>, tape: &mut Tape) -> Result<(), Error> {
        let Some(vertical) = &self.vertical else { return Ok(()) };
        let began = vertical.now();
        let mut ledger = EnergyLedger::default();
        let mut from = began.phase.angle();
        if let Some(rest) = rest {
            let system = *self.engine.system();
            let vibration = system.vibration();
            let state = DiskState {
                mode: Mode::Flight,
                height: vibration.height(began.phase),
                axial_velocity: vibration.velocity(began.phase) + rest.last_speed,
                angle: 0.0,
                angular_speed: 0.0,
            };
            let lasts = rest.accumulation.duration;
            let chatters =
                Chatter::of_rotors(std::iter::once((&system, 0.0)), began.phase, chatter_speed(rest), lasts);
            ledger = self.engine.rest_after(began, state, rest, &chatters[0]).ledger;
            // The impacts of a chatter press on the disk as evenly as the contact that follows.
            let impulse = |to: f64| to + vibration.peak_acceleration() * (cos(from + to) - cos(from));
            let whole = impulse(lasts);
            let share = if whole > 0.0 { ((whole - rest.last_speed) / whole).max(0.0) } else { 0.0 };
            if lasts > 0.0 {
                tape.press(from, lasts, |to| share * impulse(to));
            }
            tape.axial.duration += lasts;
            from = rest.accumulation.phase.angle();
        }
        let attached = self.engine.time();
        let mut separation = None;
        while let Some(record) = self.engine.advance()? {
            ledger += record.ledger;
            if record.event == Event::Separation {
                separation = Some(record.time);
                break;
            }
        }
        let Some(time) = separation else { return Ok(()) };
        let lasts = time.since(&attached).radians();
        let peak = self.engine.system().vibration().peak_acceleration();
        if lasts > 0.0 {
            tape.press(from, lasts, |to| to + peak * (cos(from + to) - cos(from)));
        }
        let Some(vertical) = &mut self.vertical else { return Ok(()) };
        let given = vertical.given_by_perturbations();
        vertical.separate(time)?;
        let axial = &mut tape.axial;
        axial.duration += lasts;
        axial.normal_work += ledger.normal_work;
        axial.restitution_loss += ledger.restitution_loss;
        axial.perturbation_work += vertical.given_by_perturbations() - given;
        let speed = vertical.launch().map_or(0.0, |launch| launch.relative_speed());
        let energy = self.energy_at(time, speed);
        tape.axial.energy_change += energy - std::mem::replace(&mut self.energy, energy);
        Ok(())
    }

    /// A contact without an event at its end.
    fn press(&self, tape: &mut Tape, from: f64, duration: f64) {
        let peak = self.engine.system().vibration().peak_acceleration();
        tape.press(from, duration, |to| to + peak * (cos(from + to) - cos(from)));
        tape.axial.duration += duration;
    }

    /// Kinetic and potential energy (per mass) of a disk that leaves the platform with a relative speed.
    fn energy_at(&self, time: PhaseTime, relative_speed: f64) -> f64 {
        let vibration = self.engine.system().vibration();
        let velocity = vibration.velocity(time.phase) + relative_speed;
        0.5 * velocity * velocity + vibration.height(time.phase)
    }
}
