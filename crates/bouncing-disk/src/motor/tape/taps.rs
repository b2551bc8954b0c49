//! A tape of taps, recorded from release to release in closed form, for a sine and compliant contacts with a
//! damper.

use bouncing_disk_core::run::WorkCount;

use super::engine::EngineTape;
use super::recurrence::{Key, Touch};
use super::{Knot, Tape};
use crate::driven::DrivenEngine;
use crate::error::Error;
use crate::motion::event::Motion;
use crate::motion::phase_time::PhaseTime;
use crate::motion::state::DiskState;
use crate::motor::tape::tap::TapSolver;
use crate::stator::MODES;

/// Taps, and the engine that takes over if the closed forms do not decide.
#[derive(Debug, Clone)]
pub(crate) struct TapTape {
    solver: TapSolver,
    pub(crate) engine: EngineTape<DrivenEngine>,
    /// The last release, with gap and velocity relative to the platform; `None` while the engine is ahead.
    release: Option<(PhaseTime, [f64; 2])>,
}

impl TapTape {
    /// A tape from the present state of an engine; only the engine is used if the solver has no closed form.
    pub(crate) const fn new(solver: TapSolver, engine: EngineTape<DrivenEngine>) -> Self {
        Self { solver, engine, release: None }
    }

    /// The end of the recorded motion.
    pub(crate) fn time(&self) -> PhaseTime {
        self.release.map_or_else(|| self.engine.engine.time(), |(time, _)| time)
    }

    /// The disk at the end.
    pub(crate) fn disk(&self) -> DiskState {
        let Some((time, [gap, velocity])) = self.release else { return self.engine.engine.disk() };
        let vibration = self.solver.vibration();
        let (height, speed) = (vibration.height(time.phase), vibration.velocity(time.phase));
        DiskState::flying(height + gap, speed + velocity, 0.0)
    }

    /// Records a tap, or the motion up to the engine's next event.
    pub(crate) fn record(&mut self, tape: &mut Tape, work: &mut WorkCount<'_>) -> Result<Touch, Error> {
        if self.release.is_none() {
            self.release = self.engine.engine.flight().map(|launch| (self.engine.engine.time(), launch));
        }
        if let Some((time, launch)) = self.release {
            work.spend(1)?;
            if let Some(touch) = self.tap(time, launch, tape) {
                return Ok(touch);
            }
            // One tap by the engine.
            self.engine.engine.fly_from(time, launch, 0.0);
            self.engine.energy_is(self.solver_energy(time, launch));
            self.release = None;
        }
        self.engine.record(tape, work)
    }

    fn tap(&mut self, time: PhaseTime, [gap, velocity]: [f64; 2], tape: &mut Tape) -> Option<Touch> {
        let touch = self.solver.flight(time.phase, gap, velocity)?;
        let tap = self.solver.contact(&touch)?;
        let (span, count) = (tap.end.after, tape.steps(tap.end.after));
        let step = span / f64::from(count);
        let (from, to) = (self.solver.integrals(&tap.start), self.solver.integrals(&tap.end));
        let mut steps = Vec::with_capacity(count as usize);
        let mut before = from.impulse;
        for index in 1..=count {
            let at = if index == count {
                tap.end
            } else {
                self.solver.instant(&tap.start, step * f64::from(index))?
            };
            let impulse = self.solver.impulse(&at);
            let pressed = (impulse - before).max(0.0);
            steps.push(Knot { duration: step, sin: at.sin, cos: at.cos, pressed, hit: 0.0 });
            before = impulse;
        }
        let flown = Knot {
            duration: touch.duration,
            sin: touch.phase.sin(),
            cos: touch.phase.cos(),
            pressed: 0.0,
            hit: 0.0,
        };
        tape.push(flown, touch.phase.angle());
        for (knot, index) in steps.into_iter().zip(1_u32..) {
            tape.push(knot, tap.angle + step * f64::from(index));
        }
        let peak = self.solver.vibration().peak_acceleration();
        let axial = &mut tape.axial;
        axial.duration += touch.duration + span;
        axial.pressed += span;
        axial.normal_work += peak * (to.force_cos - from.force_cos);
        axial.restitution_loss +=
            (to.loss - from.loss) + (self.solver.spring_energy(gap) - self.solver.spring_energy(touch.gap));
        axial.impacts += 1;
        let speed = self.engine.perturbation();
        let before = self.solver.vibration().velocity(tap.phase) + tap.velocity;
        axial.perturbation_work += 0.5 * speed * (2.0 * before + speed);
        let release = PhaseTime { periods: time.periods + touch.turns + tap.turns, phase: tap.phase };
        let launch = [tap.gap, tap.velocity + speed];
        axial.energy_change +=
            self.solver_energy(release, launch) - self.solver_energy(time, [gap, velocity]);
        self.release = Some((release, launch));
        Some(Touch::At(Key::new(tap.phase, [tap.velocity, tap.gap, 0.0], [[0.0; 2]; MODES])))
    }

    /// Kinetic and potential energy at a release.
    fn solver_energy(&self, time: PhaseTime, [gap, velocity]: [f64; 2]) -> f64 {
        let vibration = self.solver.vibration();
        let speed = vibration.velocity(time.phase) + velocity;
        0.5 * speed * speed + (vibration.height(time.phase) + gap) + self.solver.spring_energy(gap)
    }
}
