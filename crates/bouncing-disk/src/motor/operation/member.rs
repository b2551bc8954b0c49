//! One vertical motion with all rotors on it, in windows of time.

use std::f64::consts::TAU;
use std::ops::RangeInclusive;

use bouncing_disk_core::numerics::random::SplitMix64;
use bouncing_disk_core::run::WorkCount;
use bouncing_disk_core::sweep::{InstructionSet, LaneRunner};
use bouncing_disk_core::{Attachment, ChatterPolicy, Impact, OrbitEvent};

use crate::driven::DrivenEngine;
use crate::error::Error;
use crate::motion::chatter::Chatter;
use crate::motion::energy::EnergyLedger;
use crate::motion::engine::{Engine, chatter_speed};
use crate::motion::event::Event;
use crate::motion::impact::{axial_impulse, rebound_velocity};
use crate::motion::initial_condition::InitialCondition;
use crate::motion::phase_time::PhaseTime;
use crate::motion::state::{DiskState, Mode};
use crate::motor::batch::members::starting_phase;
use crate::motor::batch::rotor_rows::{RotorRows, SharedImpact, WIDTH};
use crate::motor::batch::shared_orbit::vertical::VerticalMotion;
use crate::motor::operation::energy_rows::{CarryAll, Energies};
use crate::motor::operation::followed::Followed;
use crate::motor::operation::no_lift_off::Lying;
use crate::motor::operation::settings::OperatingSettings;
use crate::motor::operation::window::{AxialWindow, RotorWindow, Window};
use crate::motor::rotor::transient::FLIGHTS_OF_EVENT;
use crate::motor::stator::Stator;
use crate::parameters::dimensionless::DimensionlessSystem;
use crate::stator::StatorEngine;

/// An angular speed above which no rotor under a braking load stays, nor comes to: that of the platform, and
/// what friction brakes in a period. Without friction a rotor keeps its speed, and starts at rest.
pub(crate) fn far_above(system: &DimensionlessSystem) -> f64 {
    let friction = system.friction();
    if friction > 0.0 { system.twist_speed() + TAU * friction } else { 0.0 }
}

/// A member of the ensemble: it starts at a phase and with a stream of random numbers of its own.
#[derive(Debug)]
pub(crate) enum Member {
    /// The platform throws the rotors up.
    Bouncing(Box<Bouncing>),
    /// It never does: each rotor moves by itself.
    Lying(Lying),
    /// The stator moves by waveforms, or contacts take time.
    Driven(Box<Followed<DrivenEngine>>),
    /// The stator yields, or the load follows a law.
    Yielding(Box<Followed<StatorEngine>>),
}

impl Member {
    /// The member of this `index` among so many as `settings` says. The first `bracketed` of the systems have
    /// two rotors, one from far below all steady speeds and one, behind those of all systems, from as far
    /// above; the others start at rest. Each system has its stator, all of one kind.
    pub(crate) fn new(
        systems: &[DimensionlessSystem],
        stators: &[Stator],
        bracketed: usize,
        index: usize,
        settings: &OperatingSettings,
    ) -> Result<Self, Error> {
        let phase = starting_phase(settings.seed, index, settings.members)?;
        let seed = SplitMix64::seed_of_stream(settings.seed, index as u64);
        let policy = ChatterPolicy::Complete;
        let perturbation = (settings.relaunch_perturbation, seed);
        let from_below = |own| (own, if own < bracketed { -far_above(&systems[own]) } else { 0.0 });
        let from_above = |own| (own, far_above(&systems[own]));
        let starts: Vec<(usize, f64)> =
            (0..systems.len()).map(from_below).chain((0..bracketed).map(from_above)).collect();
        let lying = || {
            let own = |&(motor, _): &(usize, f64)| (systems[motor], stators[motor].driven().cloned());
            Self::Lying(Lying::new(starts.iter().map(own).collect(), phase))
        };
        let on = |&(motor, speed): &(usize, f64)| (&stators[motor], speed);
        match stators[0] {
            Stator::Driven(_) => {
                let starts = starts.iter().map(on).filter_map(|(own, speed)| Some((own.driven()?, speed)));
                let member = Followed::on_driven(starts, phase, perturbation)?;
                return Ok(if member.lies_for_ever() { lying() } else { Self::Driven(Box::new(member)) });
            }
            Stator::Yielding(_) => {
                let starts = starts.iter().map(on).filter_map(|(own, speed)| Some((own.yielded()?, speed)));
                return Ok(Self::Yielding(Box::new(Followed::on_yielding(starts, phase, perturbation)?)));
            }
            Stator::Sine => {}
        }
        let mut rows = RotorRows::of(starts.iter().map(|&(motor, _)| systems[motor]));
        let mut engines = Vec::with_capacity(starts.len());
        for (own, &(motor, angular_speed)) in starts.iter().enumerate() {
            let start = InitialCondition::Contact { phase, angular_speed };
            engines.push(Engine::new(systems[motor], start, policy)?);
            rows[own / WIDTH].speed[own % WIDTH] = angular_speed;
        }
        Ok(match VerticalMotion::from_rest(&systems[0], phase, policy, perturbation)? {
            Some(vertical) => Self::Bouncing(Box::new(Bouncing {
                vertical,
                bracketed,
                joined: 0,
                engines,
                rows,
                runner: LaneRunner::new(InstructionSet::best()),
                window: Window::default(),
                begun: false,
                energy: 0.0,
            })),
            None => lying(),
        })
    }

    /// The next window: of `duration` rad at least, and of a number of impacts in a range, whatever the
    /// duration; up to the end of an event. Rotors that never bounce have periods instead of impacts.
    pub(crate) fn next_window(
        &mut self,
        duration: f64,
        impacts: RangeInclusive<u64>,
        work: &mut WorkCount<'_>,
    ) -> Result<Window, Error> {
        match self {
            Self::Bouncing(member) => member.next_window(duration, impacts, work),
            Self::Lying(member) => member.next_window(duration, *impacts.end(), work),
            Self::Driven(member) => member.next_window(duration, impacts, work),
            Self::Yielding(member) => member.general_window(duration, &impacts, true, work),
        }
    }
}

/// Rotors that bounce.
#[derive(Debug)]
pub(crate) struct Bouncing {
    vertical: VerticalMotion,
    /// How many of the first systems have a second rotor.
    bracketed: usize,
    /// How many had one that has met the first.
    joined: usize,
    /// The rotors while the disk lies on the platform.
    engines: Vec<Engine>,
    rows: Vec<RotorRows<Energies>>,
    runner: LaneRunner,
    window: Window,
    /// Whether the disk has left the platform for the first time.
    begun: bool,
    /// Axial energy after the last event.
    energy: f64,
}

impl Bouncing {
    fn next_window(
        &mut self,
        duration: f64,
        impacts: RangeInclusive<u64>,
        work: &mut WorkCount<'_>,
    ) -> Result<Window, Error> {
        let rotors = self.engines.len();
        self.window = Window { axial: AxialWindow::default(), rotors: vec![RotorWindow::default(); rotors] };
        let mut from = self.vertical.now();
        if !self.begun {
            self.begun = true;
            from = PhaseTime::in_first_period(from.phase);
            self.energy = self.energy_at(from, 0.0);
            // A start on a platform that falls away is a flight.
            if !self.engines[0].launches() {
                self.rest(None)?;
            }
        }
        let given = self.vertical.given_by_perturbations();
        let (energy, speeds) = (self.energy, self.speeds());
        // The first rest of all belongs to no window: there is nothing before it to compare with.
        self.window = Window { axial: AxialWindow::default(), rotors: vec![RotorWindow::default(); rotors] };
        from = if self.vertical.now().order(&from).is_gt() { self.vertical.now() } else { from };
        loop {
            match self.vertical.advance()? {
                Some(OrbitEvent::Impact(impact)) => {
                    self.hit(&impact);
                    work.spend(1 + (rotors / WIDTH) as u64)?;
                }
                Some(OrbitEvent::Attachment(rest)) => {
                    self.rest(Some(&rest))?;
                    work.spend(FLIGHTS_OF_EVENT * (1 + rotors as u64))?;
                }
                // A platform that has let the disk go once does so for ever.
                Some(_) | None => break,
            }
            let lasts = self.vertical.now().since(&from).radians() >= duration;
            let done = self.window.axial.impacts;
            let is_enough = (lasts && done >= *impacts.start()) || done >= *impacts.end();
            // Where an attachment is due next, the impact is not the end of an event.
            if is_enough && self.vertical.launch().is_some() {
                break;
            }
        }
        let axial = &mut self.window.axial;
        axial.duration = self.vertical.now().since(&from).radians();
        axial.perturbation_work = self.vertical.given_by_perturbations() - given;
        axial.energy_change = self.energy - energy;
        for (index, before) in speeds.into_iter().enumerate() {
            let (row, own) = (&mut self.rows[index / WIDTH], index % WIDTH);
            let rotor = &mut self.window.rotors[index];
            let angle = std::mem::take(&mut row.tally.angle[own]);
            rotor.angle += angle;
            rotor.load_work += self.engines[index].system().load() * angle;
            rotor.friction_work += std::mem::take(&mut row.tally.work[own]);
            rotor.friction_loss += std::mem::take(&mut row.tally.loss[own]);
            let after = row.speed[own];
            rotor.kinetic_change = 0.5 * (after - before) * (after + before);
        }
        let joined = self.window.rotors[..self.joined].to_vec();
        self.window.rotors.extend(joined);
        self.join();
        Ok(std::mem::take(&mut self.window))
    }

    /// Two rotors that have met stay together for ever: where all have, one of each is carried on and counts
    /// twice.
    fn join(&mut self) {
        let systems = self.engines.len() - self.bracketed;
        let speeds = self.speeds();
        if self.bracketed > 0 && speeds[..self.bracketed] == speeds[systems..] {
            self.engines.truncate(systems);
            self.rows.truncate(systems.div_ceil(WIDTH));
            self.joined = std::mem::take(&mut self.bracketed);
        }
    }

    fn speeds(&self) -> Vec<f64> {
        (0..self.engines.len()).map(|index| self.rows[index / WIDTH].speed[index % WIDTH]).collect()
    }

    /// Kinetic and potential energy (per mass) of a disk that leaves the platform with a relative speed.
    fn energy_at(&self, time: PhaseTime, relative_speed: f64) -> f64 {
        let vibration = self.engines[0].system().vibration();
        let velocity = vibration.velocity(time.phase) + relative_speed;
        0.5 * velocity * velocity + vibration.height(time.phase)
    }

    fn hit(&mut self, impact: &Impact) {
        let restitution = self.vertical.restitution();
        let axial = &mut self.window.axial;
        axial.impacts += 1;
        let platform_velocity = self.engines[0].system().vibration().velocity(impact.phase);
        axial.normal_work += axial_impulse(restitution, impact.velocity) * platform_velocity;
        axial.restitution_loss +=
            0.5 * ((1.0 - restitution) * (1.0 + restitution)) * (impact.velocity * impact.velocity);
        self.energy = self.energy_at(self.vertical.now(), rebound_velocity(restitution, impact.velocity));
        let impact = SharedImpact::new(impact, restitution);
        self.runner.run(CarryAll { impact, rows: &mut self.rows });
    }

    /// Carries each rotor through a rest of the disk up to its separation; without an attachment, through the
    /// first one.
    fn rest(&mut self, rest: Option<&Attachment>) -> Result<(), Error> {
        let (began, mut separation) = (self.vertical.now(), None);
        let vibration = *self.engines[0].system().vibration();
        let chatters = rest.map_or_else(Vec::new, |rest| {
            let systems = self.engines.iter().map(Engine::system);
            let duration = rest.accumulation.duration;
            Chatter::of_rotors(systems.zip(self.speeds()), began.phase, chatter_speed(rest), duration)
        });
        for (index, engine) in self.engines.iter_mut().enumerate() {
            let (row, own) = (&mut self.rows[index / WIDTH], index % WIDTH);
            let mut ledger = EnergyLedger::default();
            if let Some(rest) = rest {
                let state = DiskState {
                    mode: Mode::Flight,
                    height: vibration.height(began.phase),
                    axial_velocity: vibration.velocity(began.phase) + rest.last_speed,
                    angle: 0.0,
                    angular_speed: row.speed[own],
                };
                ledger = engine.rest_after(began, state, rest, &chatters[index]).ledger;
            }
            let start = if rest.is_some() { 0.0 } else { engine.state().angle };
            while let Some(record) = engine.advance()? {
                ledger += record.ledger;
                if record.event == Event::Separation {
                    separation = Some(record.time);
                    break;
                }
            }
            let rotor = &mut self.window.rotors[index];
            rotor.angle += engine.state().angle - start;
            rotor.load_work += ledger.load_work;
            rotor.friction_work += ledger.friction_work;
            rotor.friction_loss += ledger.friction_loss;
            row.speed[own] = engine.state().angular_speed;
            if index == 0 {
                self.window.axial.normal_work += ledger.normal_work;
                self.window.axial.restitution_loss += ledger.restitution_loss;
            }
        }
        if let Some(time) = separation {
            self.vertical.separate(time)?;
            let speed = self.vertical.launch().map_or(0.0, |launch| launch.relative_speed());
            self.energy = self.energy_at(time, speed);
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests;
