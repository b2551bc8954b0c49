//! Rotors that are each followed by an engine of its own: the first one decides when a window ends. Where a sine
//! and a contact that takes time allow it, they go from release to release [together](Tapped).

use std::f64::consts::TAU;
use std::ops::RangeInclusive;

use bouncing_disk_core::Phase;
use bouncing_disk_core::numerics::random::SplitMix64;
use bouncing_disk_core::run::WorkCount;

use crate::driven::DrivenStart;
use crate::error::Error;
use crate::motion::event::{Energies, Event, MotionRecord, SteeredMotion};
use crate::motion::phase_time::{PhaseSpan, PhaseTime};
use crate::motor::rotor::transient::FLIGHTS_OF_EVENT;
use crate::motor::tape::window::{AxialWindow, RotorWindow, Window};
use crate::parameters::scales::Scales;
use crate::stator::{MODES, StatorEngine, StatorState, StatorSystem};

/// Where a rotor on a stator that yields was left.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Left {
    pub(crate) time: PhaseTime,
    pub(crate) state: StatorState,
    /// Whether the coordinate of a mode is a height.
    rises: [bool; MODES],
}

impl Left {
    /// Of an engine at a time before its next event.
    pub(crate) fn of(engine: &StatorEngine, time: PhaseTime) -> Self {
        let state = engine.state_after(time.since(&engine.time()).radians()).1;
        Self { time, state, rises: engine.system().modes.map(|mode| mode.height != 0.0) }
    }

    /// In SI units, or from them by `f64::recip` of each unit; time, angle and angular speed begin anew.
    pub(crate) fn scaled(self, unit: &Scales, of: fn(f64) -> f64) -> Self {
        let (mut state, time) = (self.state, PhaseTime::in_first_period(self.time.phase));
        state.disk.height *= of(unit.length);
        state.disk.axial_velocity *= of(unit.velocity);
        (state.disk.angle, state.disk.angular_speed) = (0.0, 0.0);
        for ([place, speed], rises) in state.modes.iter_mut().zip(self.rises) {
            *place *= of(if rises { unit.length } else { unit.angle });
            *speed *= of(if rises { unit.velocity } else { unit.angular_speed });
        }
        Self { time, state, ..self }
    }
}

/// All rotors of a member.
#[derive(Debug)]
pub(crate) struct Followed<E> {
    rotors: Vec<Rotor<E>>,
    /// The end of the last window.
    reached: PhaseTime,
}

/// A rotor, and what it has done since its start.
#[derive(Debug)]
struct Rotor<E> {
    engine: E,
    takes_time: bool,
    generator: SplitMix64,
    perturbation: f64,
    energies: Energies,
    /// Energy given by the perturbations.
    given: f64,
    impacts: u64,
    /// Impacts, and what of the events of a contact that takes time recurs without an impact.
    recurrences: u64,
    /// At the end of the last window.
    before: Totals,
}

/// What a rotor has done up to a time.
#[derive(Debug, Clone, Copy, Default)]
struct Totals {
    energies: Energies,
    given: f64,
    impacts: u64,
    axial_energy: f64,
    angle: f64,
    angular_speed: f64,
}

impl Followed<StatorEngine> {
    /// As [`Followed::on_driven`], on a stator that yields.
    pub(crate) fn on_yielding<'a>(
        starts: impl Iterator<Item = (&'a StatorSystem, f64)>,
        phase: Phase,
        perturbation: (f64, u64),
    ) -> Result<Self, Error> {
        let rotors = starts.map(|(system, angular_speed)| {
            let engine = StatorEngine::new(system.clone(), DrivenStart::Contact { phase, angular_speed })?;
            Ok(Rotor::new(engine, system.takes_time(), phase, perturbation))
        });
        let reached = PhaseTime::in_first_period(phase);
        Ok(Self { rotors: rotors.collect::<Result<_, Error>>()?, reached })
    }

    /// A rotor goes on from where another one was left, as all that do at the same time.
    pub(crate) fn resume(&mut self, place: usize, system: &StatorSystem, left: &Left) -> Result<(), Error> {
        self.reached = left.time;
        let rotor = &mut self.rotors[place];
        rotor.engine = StatorEngine::of_state(system.clone(), left.time, left.state)?;
        rotor.before = rotor.totals(&self.reached);
        Ok(())
    }

    /// Where a rotor is at the end of the last window.
    pub(crate) fn left(&self, place: usize) -> Left {
        Left::of(&self.rotors[place].engine, self.reached)
    }
}

impl<E: SteeredMotion> Followed<E> {
    /// The next window by the engines; `anywhere`: a contact that takes time may be its end.
    pub(crate) fn general_window(
        &mut self,
        duration: f64,
        impacts: &RangeInclusive<u64>,
        anywhere: bool,
        work: &mut WorkCount<'_>,
    ) -> Result<Window, Error> {
        let from = self.reached;
        let (mut window, mut lies) = (Window::default(), false);
        for (index, rotor) in self.rotors.iter_mut().enumerate() {
            if index == 0 {
                (self.reached, lies) = rotor.lead(&from, (duration, anywhere), impacts, work)?;
            } else {
                rotor.follow(&self.reached, work)?;
            }
            let (before, now) = (rotor.before, rotor.totals(&self.reached));
            let change = |of: fn(&Totals) -> f64| of(&now) - of(&before);
            let axial = || {
                let duration = self.reached.since(&from).radians();
                AxialWindow {
                    duration,
                    normal_work: change(|totals| totals.energies.disk.normal_work),
                    perturbation_work: change(|totals| totals.given),
                    restitution_loss: change(|totals| totals.energies.disk.restitution_loss),
                    energy_change: change(|totals| totals.axial_energy),
                    impacts: if lies || now.impacts == before.impacts {
                        (duration / TAU + 0.5) as u64
                    } else {
                        now.impacts - before.impacts
                    },
                }
            };
            if index == 0 {
                window.axial = axial();
            }
            window.rotors.push(RotorWindow {
                angle: change(|totals| totals.angle),
                square: f64::NAN,
                friction_work: change(|totals| totals.energies.disk.friction_work),
                friction_loss: change(|totals| totals.energies.disk.friction_loss),
                load_work: change(|totals| totals.energies.disk.load_work),
                load_impulse: now.energies.stator.load_impulse - before.energies.stator.load_impulse,
                kinetic_change: 0.5
                    * change(|totals| totals.angular_speed)
                    * (now.angular_speed + before.angular_speed),
                stator: E::YIELDS.then(|| (now.energies.stator - before.energies.stator, axial())),
            });
            rotor.before = now;
        }
        Ok(window)
    }
}

impl<E: SteeredMotion> Rotor<E> {
    fn new(engine: E, takes_time: bool, phase: Phase, (perturbation, seed): (f64, u64)) -> Self {
        let mut rotor = Self {
            engine,
            takes_time,
            generator: SplitMix64::new(seed),
            perturbation,
            energies: Energies::default(),
            given: 0.0,
            impacts: 0,
            recurrences: 0,
            before: Totals::default(),
        };
        rotor.before = rotor.totals(&PhaseTime::in_first_period(phase));
        rotor
    }

    /// Goes on until a flight begins and the window is long enough; when that is, and whether the disk lies on
    /// the stator for ever.
    fn lead(
        &mut self,
        from: &PhaseTime,
        (duration, anywhere): (f64, bool),
        impacts: &RangeInclusive<u64>,
        work: &mut WorkCount<'_>,
    ) -> Result<(PhaseTime, bool), Error> {
        let end = from.after(PhaseSpan::from_radians(duration));
        let before = self.recurrences;
        let anywhere = anywhere && (self.takes_time || E::YIELDS);
        let impacts_before = self.impacts;
        loop {
            let (now, done) = (self.engine.time(), self.recurrences - before);
            // A rotor that lies on a stator that yields has events of friction only, or none.
            let lies = E::YIELDS && self.impacts == impacts_before;
            let lasts = now.order(&end).is_ge() && (lies || done >= *impacts.start());
            if (lasts || done >= *impacts.end()) && (anywhere || self.engine.launches()) {
                return Ok((now, false));
            }
            if self.engine.lies_for_ever() {
                let periods = ((duration / TAU) as u64).saturating_add(1).min(*impacts.end());
                let end = from.after(PhaseSpan { periods, remainder: 0.0 });
                self.follow(&end, work)?;
                return Ok((end, true));
            }
            self.advance(f64::INFINITY, work)?;
        }
    }

    /// Goes on to this time.
    fn follow(&mut self, to: &PhaseTime, work: &mut WorkCount<'_>) -> Result<(), Error> {
        while self.advance(to.since(&self.engine.time()).radians(), work)? {}
        if let Some(energies) = self.engine.pause_contact(to.since(&self.engine.time()).radians()) {
            self.energies += energies;
        }
        Ok(())
    }

    /// The next event within `limit`, if there is one.
    fn advance(&mut self, limit: f64, work: &mut WorkCount<'_>) -> Result<bool, Error> {
        work.spend(FLIGHTS_OF_EVENT)?;
        let Some(record) = self.engine.advance_within(limit)? else { return Ok(false) };
        let event = record.event();
        self.energies += record.energies();
        match event {
            Event::Impact { .. } | Event::Kick { .. } | Event::Recontact => {
                self.impacts += 1;
                self.recurrences += 1;
            }
            Event::Turn => self.recurrences += 1,
            Event::SlipToStick | Event::SlipReversal(_) if E::YIELDS => self.recurrences += 1,
            _ => {}
        }
        if event.is_relaunch() {
            let speed = self.perturbation * self.generator.unit();
            let before = self.engine.disk().axial_velocity;
            self.engine.perturb_launch(speed);
            let after = self.engine.disk().axial_velocity;
            self.given += 0.5 * (after - before) * (after + before);
        }
        Ok(true)
    }

    /// At a time before the next event.
    fn totals(&self, at: &PhaseTime) -> Totals {
        let span = at.since(&self.engine.time()).radians();
        let state = self.engine.disk_after(span);
        let mut energies = self.engine.energies_after(span);
        energies += self.energies;
        Totals {
            energies,
            given: self.given,
            impacts: self.impacts,
            axial_energy: 0.5 * state.axial_velocity * state.axial_velocity
                + state.height
                + self.engine.spring_energy(span, &state),
            angle: state.angle,
            angular_speed: state.angular_speed,
        }
    }
}
