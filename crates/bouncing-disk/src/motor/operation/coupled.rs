//! A rotor that acts back on its stator; one engine follows both.

use std::f64::consts::TAU;
use std::ops::RangeInclusive;

use bouncing_disk_core::Phase;
use bouncing_disk_core::numerics::random::SplitMix64;
use bouncing_disk_core::run::WorkCount;

use crate::driven::DrivenStart;
use crate::error::Error;
use crate::motion::event::{Energies, Event, Motion, MotionRecord, SteeredMotion};
use crate::motion::phase_time::{PhaseSpan, PhaseTime};
use crate::motor::rotor::transient::FLIGHTS_OF_EVENT;
use crate::motor::tape::cycle::Cycle;
use crate::motor::tape::left::Left;
use crate::motor::tape::recurrence::{AT_ONCE, Key, Recurrence, Repeats, Touch};
use crate::motor::tape::window::{AxialWindow, RotorWindow, Speeds, Window};
use crate::stator::{StatorEngine, StatorState, StatorSystem};

/// A rotor with its stator, and the sums since the start.
#[derive(Debug)]
pub(crate) struct Coupled {
    engine: StatorEngine,
    generator: SplitMix64,
    perturbation: f64,
    energies: Energies,
    /// Energy that the perturbations have supplied.
    given: f64,
    impacts: u64,
    /// Number of impacts, and of recurring events of a compliant contact without an impact.
    recurrences: u64,
    start: PhaseTime,
    /// The present time, and the end of the last window with the sums up to it.
    reached: PhaseTime,
    ended: PhaseTime,
    before: Totals,
    recurrence: Recurrence,
    /// Time of the last touch.
    touched: Option<PhaseTime>,
    /// The cycle that the motion was found to repeat, after which no window is complete.
    repeats: Option<Repeats>,
}

/// The sums of a rotor up to a time.
#[derive(Debug, Clone, Copy, Default)]
struct Totals {
    energies: Energies,
    given: f64,
    impacts: u64,
    axial_energy: f64,
    angle: f64,
    angular_speed: f64,
}

impl Coupled {
    /// A rotor that lies on its stator at `phase` with an angular speed. If impacts are rigid, each
    /// separation is perturbed by a speed of up to `perturbation`, from a stream with this `seed`.
    pub(crate) fn new(
        system: &StatorSystem,
        phase: Phase,
        angular_speed: f64,
        (perturbation, seed): (f64, u64),
    ) -> Result<Self, Error> {
        let mut engine = StatorEngine::new(system.clone(), DrivenStart::Contact { phase, angular_speed })?;
        engine.bounds_closely = true;
        let reached = PhaseTime::in_first_period(phase);
        let mut coupled = Self {
            perturbation: if system.takes_time() { 0.0 } else { perturbation },
            engine,
            generator: SplitMix64::new(seed),
            energies: Energies::default(),
            given: 0.0,
            impacts: 0,
            recurrences: 0,
            start: reached,
            reached,
            ended: reached,
            before: Totals::default(),
            recurrence: Recurrence::default(),
            touched: None,
            repeats: None,
        };
        coupled.before = coupled.totals(&reached);
        Ok(coupled)
    }

    /// Continues from the state in which another motion was left.
    pub(crate) fn go_on_from(&mut self, time: PhaseTime, state: StatorState) -> Result<(), Error> {
        (self.start, self.reached, self.ended) = (time, time, time);
        self.engine = StatorEngine::of_state(self.engine.system().clone(), time, state)?;
        self.engine.bounds_closely = true;
        self.before = self.totals(&self.reached);
        Ok(())
    }

    /// The angular speed of the rotor after the last event.
    pub(crate) fn angular_speed(&self) -> f64 {
        self.engine.disk().angular_speed
    }

    /// The state at the end of the last window.
    pub(crate) fn left(&self) -> Left {
        Left::of(&self.engine, self.reached)
    }

    pub(crate) const fn repeats(&self) -> Option<Repeats> {
        self.repeats
    }

    /// Registers cycles with these touches that other members have reached.
    pub(crate) fn know(&mut self, cycles: &[&[Key]]) {
        self.recurrence.know(cycles);
    }

    /// The time (rad) for which the motion was followed.
    pub(crate) fn followed(&self) -> f64 {
        self.reached.since(&self.start).radians()
    }

    /// The cycle that the motion repeats, if one was found.
    pub(crate) fn cycle(&mut self, work: &mut WorkCount<'_>) -> Result<Option<Cycle>, Error> {
        let Some(repeats) = self.repeats else { return Ok(None) };
        let mut round = |touches: u64| {
            let mut keys = Vec::new();
            while (keys.len() as u64) < touches {
                if let Some(Touch::At(key)) = self.advance(f64::INFINITY, work)? {
                    keys.push(key);
                }
            }
            Ok::<_, Error>((self.window(false), keys))
        };
        // From the last touch on.
        let (_, keys) = round(repeats.touches)?;
        let touches = Cycle::least_touches(&keys);
        let (window, keys) = round(touches)?;
        Ok(Some(Cycle::of_window(window, keys, Repeats { touches, ..repeats })))
    }

    /// The next window, up to the end of an event. It lasts for at least `duration` rad, but the number of
    /// its impacts stays within `impacts`. The window ends early if the motion is found to repeat.
    pub(crate) fn next_window(
        &mut self,
        duration: f64,
        impacts: &RangeInclusive<u64>,
        work: &mut WorkCount<'_>,
    ) -> Result<Window, Error> {
        let from = self.reached;
        let end = from.after(PhaseSpan::from_radians(duration));
        let (before, impacts_before) = (self.recurrences, self.impacts);
        loop {
            let (now, done) = (self.engine.time(), self.recurrences - before);
            // A rotor that lies on the stator has friction events only, or no events.
            let lies = self.impacts == impacts_before;
            let lasts = now.order(&end).is_ge() && (lies || done >= *impacts.start());
            if lasts || done >= *impacts.end() {
                return Ok(self.window(false));
            }
            if self.engine.lies_for_ever() {
                let periods = ((duration / TAU) as u64).saturating_add(1).min(*impacts.end());
                self.follow(&from.after(PhaseSpan { periods, remainder: 0.0 }), work)?;
                return Ok(self.window(true));
            }
            let before = self.engine.time();
            if let Some(touch) = self.advance(f64::INFINITY, work)? {
                let lasted = self.engine.time().since(&before).radians();
                self.repeats = self.recurrence.add(touch, lasted);
                if self.repeats.is_some() {
                    return Ok(self.window(false));
                }
            }
        }
    }

    /// Continues to this time.
    fn follow(&mut self, to: &PhaseTime, work: &mut WorkCount<'_>) -> Result<(), Error> {
        while self.advance(to.since(&self.engine.time()).radians(), work)?.is_some() {}
        if let Some(energies) = self.engine.pause_contact(to.since(&self.engine.time()).radians()) {
            self.energies += energies;
        }
        self.reached = *to;
        Ok(())
    }

    /// The next event within `limit`, if any, and whether it is a touch.
    fn advance(&mut self, limit: f64, work: &mut WorkCount<'_>) -> Result<Option<Touch>, Error> {
        work.spend(FLIGHTS_OF_EVENT)?;
        let Some(record) = self.engine.advance_within(limit)? else { return Ok(None) };
        let event = record.event();
        self.energies += record.energies();
        let mut touch = Touch::None;
        match event {
            Event::Impact { .. } | Event::Kick { .. } | Event::Recontact => {
                self.impacts += 1;
                self.recurrences += 1;
                let (now, disk) = (record.time(), self.engine.disk());
                let at_once = |touched: PhaseTime| now.since(&touched).radians() < AT_ONCE;
                if !self.touched.replace(now).is_some_and(at_once) {
                    let own = [disk.axial_velocity, disk.height, disk.angular_speed];
                    touch = Touch::At(Key::new(now.phase, own, self.engine.modes()));
                }
            }
            Event::Turn | Event::SlipToStick | Event::SlipReversal(_) => self.recurrences += 1,
            _ => {}
        }
        if event.is_relaunch() && self.perturbation > 0.0 {
            let speed = self.perturbation * self.generator.unit();
            let before = self.engine.disk().axial_velocity;
            self.engine.perturb_launch(speed);
            let after = self.engine.disk().axial_velocity;
            self.given += 0.5 * (after - before) * (after + before);
        }
        self.reached = self.engine.time();
        Ok(Some(touch))
    }

    /// The sums since the last window; for a rotor that `lies` for ever, periods count as impacts.
    fn window(&mut self, lies: bool) -> Window {
        let now = self.totals(&self.reached);
        let before = std::mem::replace(&mut self.before, now);
        let change = |of: fn(&Totals) -> f64| of(&now) - of(&before);
        let duration = self.reached.since(&std::mem::replace(&mut self.ended, self.reached)).radians();
        let impacts = now.impacts - before.impacts;
        let axial = AxialWindow {
            duration,
            normal_work: change(|totals| totals.energies.disk.normal_work),
            perturbation_work: change(|totals| totals.given),
            restitution_loss: change(|totals| totals.energies.disk.restitution_loss),
            energy_change: change(|totals| totals.axial_energy),
            pressed: 0.0,
            impacts: if lies || impacts == 0 { (duration / TAU + 0.5) as u64 } else { impacts },
        };
        let ledger = now.energies.stator - before.energies.stator;
        let rotor = RotorWindow {
            angle: change(|totals| totals.angle),
            square: f64::NAN,
            held: f64::NAN,
            friction_work: change(|totals| totals.energies.disk.friction_work),
            friction_loss: change(|totals| totals.energies.disk.friction_loss),
            load_work: change(|totals| totals.energies.disk.load_work),
            load_impulse: ledger.load_impulse,
            kinetic_change: 0.5
                * change(|totals| totals.angular_speed)
                * (now.angular_speed + before.angular_speed),
            speeds: Speeds::Unknown,
            stator: Some(Box::new((ledger, axial))),
        };
        Window { axial, rotors: vec![rotor] }
    }

    /// The sums at a time before the next event.
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
