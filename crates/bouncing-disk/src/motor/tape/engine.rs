//! A tape recorded from an engine: with any drive, rigid or compliant contacts, or a compliant stator.

use std::f64::consts::TAU;

use bouncing_disk_core::numerics::random::SplitMix64;
use bouncing_disk_core::run::WorkCount;

use super::Tape;
use super::recurrence::{AT_ONCE, Key, Touch};
use crate::error::Error;
use crate::motion::event::{Event, MotionRecord, SteeredMotion};
use crate::motion::phase_time::PhaseTime;
use crate::motion::state::{DiskState, Mode};
use crate::motor::rotor::transient::FLIGHTS_OF_EVENT;

/// The engine of a disk without friction, as the source of a tape.
#[derive(Debug, Clone)]
pub(crate) struct EngineTape<E> {
    pub(crate) engine: E,
    /// Whether contacts are compliant.
    takes_time: bool,
    generator: SplitMix64,
    perturbation: f64,
    /// Kinetic and potential energy after the last event.
    energy: f64,
    /// Whether the disk has turned and not left the platform since.
    has_turned: bool,
    /// Time of the last touch.
    touched: Option<PhaseTime>,
}

impl<E: SteeredMotion + Clone> EngineTape<E> {
    /// Each separation is perturbed by a speed of up to this size from a stream with this seed.
    pub(crate) fn new(engine: E, takes_time: bool, (perturbation, seed): (f64, u64)) -> Self {
        let mut tape = Self {
            engine,
            takes_time,
            generator: SplitMix64::new(seed),
            perturbation,
            energy: 0.0,
            has_turned: false,
            touched: None,
        };
        tape.energy = tape.energy_now();
        tape
    }

    /// Whether contacts are compliant.
    pub(crate) const fn takes_time(&self) -> bool {
        self.takes_time
    }

    /// The perturbing speed for the next separation.
    pub(crate) fn perturbation(&mut self) -> f64 {
        self.perturbation * self.generator.unit()
    }

    /// Sum of kinetic energy, height and energy of a spring, just after the last event.
    pub(crate) fn energy_now(&self) -> f64 {
        let state = self.engine.disk();
        0.5 * state.axial_velocity * state.axial_velocity
            + state.height
            + self.engine.spring_energy(0.0, &state)
    }

    /// Continues with another engine.
    pub(crate) fn resume(&mut self, engine: E) {
        self.engine = engine;
        self.energy = self.energy_now();
    }

    /// Continues from a disk that another source has left with this energy.
    pub(crate) const fn energy_is(&mut self, energy: f64) {
        self.energy = energy;
    }

    /// Records the motion up to the next event, or for a period if the disk lies for ever. Returns the touch,
    /// if the event is one.
    pub(crate) fn record(&mut self, tape: &mut Tape, work: &mut WorkCount<'_>) -> Result<Touch, Error> {
        work.spend(FLIGHTS_OF_EVENT)?;
        let before = self.engine.clone();
        let (start, from) = (before.disk(), before.time().phase.angle());
        let record = if before.lies_for_ever() { None } else { self.engine.advance_within(f64::INFINITY)? };
        let Some(record) = record else {
            return self.record_period(tape, &before);
        };
        let (event, span) = (record.event(), record.time().since(&before.time()).radians());
        let energies = record.energies();
        let after = self.engine.disk();
        let ended = match start.mode {
            Mode::Flight => start.axial_velocity - span,
            _ => before.disk_after(span).axial_velocity,
        };
        let phase = record.time().phase;
        let mut gained = after.axial_velocity - ended;
        if start.mode != Mode::Flight {
            let mut velocity = before.velocities();
            tape.press(from, span, |to| velocity(to) - start.axial_velocity + to);
        } else if let Event::Attachment { .. } = event {
            // The impacts of a chatter press on the disk as evenly as the contact that follows.
            let total = after.axial_velocity - start.axial_velocity + span;
            let share = total.max(0.0) / span.max(f64::MIN_POSITIVE);
            tape.press(from, span, |to| share * to);
            gained = 0.0;
        } else {
            let (sin, cos) = (phase.sin(), phase.cos());
            tape.push(super::Knot { duration: span, sin, cos, pressed: 0.0, hit: 0.0 }, phase.angle());
        }
        let is_impact = !self.takes_time && matches!(event, Event::Impact { .. } | Event::Kick { .. });
        if is_impact && let Some(last) = tape.knots.last_mut() {
            last.hit = gained.max(0.0);
        }
        let axial = &mut tape.axial;
        axial.duration += span;
        axial.normal_work += energies.disk.normal_work;
        axial.restitution_loss += energies.disk.restitution_loss;
        tape.stator += energies.stator;
        if event.is_relaunch() && self.perturbation > 0.0 {
            let speed = self.perturbation();
            let velocity = self.engine.disk().axial_velocity;
            self.engine.perturb_launch(speed);
            let perturbed = self.engine.disk().axial_velocity;
            tape.axial.perturbation_work += 0.5 * (perturbed - velocity) * (perturbed + velocity);
        }
        let energy = self.energy_now();
        tape.axial.energy_change += energy - std::mem::replace(&mut self.energy, energy);
        // In a contact with hysteresis, a disk that never leaves the platform may turn there.
        let turns = event == Event::Turn;
        let is_touch = matches!(event, Event::Impact { .. } | Event::Kick { .. } | Event::Recontact)
            || turns && self.has_turned;
        self.has_turned = turns || self.has_turned && !is_touch && event != Event::Separation;
        if !is_touch {
            return Ok(Touch::None);
        }
        let now = self.engine.time();
        if self.touched.replace(now).is_some_and(|touched| now.since(&touched).radians() < AT_ONCE) {
            return Ok(Touch::None);
        }
        tape.axial.impacts += 1;
        let disk = self.engine.disk();
        Ok(Touch::At(Key::new(phase, [disk.axial_velocity, disk.height, 0.0], self.engine.modes())))
    }

    /// Records a period of the drive for a disk that lies on the platform for ever; a compliant stator may
    /// take many periods to settle.
    fn record_period(&mut self, tape: &mut Tape, lying: &E) -> Result<Touch, Error> {
        let period = TAU;
        let from = lying.time().phase.angle();
        let start: DiskState = lying.disk_after(0.0);
        let mut velocity = lying.velocities();
        tape.press(from, period, |to| velocity(to) - start.axial_velocity + to);
        let energies = lying.energies_after(period);
        tape.axial.duration += period;
        tape.axial.normal_work += energies.disk.normal_work;
        tape.axial.restitution_loss += energies.disk.restitution_loss;
        tape.axial.impacts += 1;
        tape.stator += energies.stator;
        if self.engine.pause_contact(period).is_none() {
            return Ok(Touch::Lies);
        }
        let (energy, disk) = (self.energy_now(), self.engine.disk());
        tape.axial.energy_change += energy - std::mem::replace(&mut self.energy, energy);
        let phase = self.engine.time().phase;
        Ok(Touch::At(Key::new(phase, [disk.axial_velocity, disk.height, 0.0], self.engine.modes())))
    }
}
