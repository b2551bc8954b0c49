//! Rotors on a platform that never falls away: they stick and slide, each by itself, and nothing is chaotic.

use std::f64::consts::TAU;

use bouncing_disk_core::{Phase, WorkCount};

use super::member::{AxialWindow, RotorWindow, Window};
use crate::error::Error;
use crate::motion::energy::EnergyLedger;
use crate::motion::engine::Engine;
use crate::motion::event::Event;
use crate::motion::phase_time::{PhaseSpan, PhaseTime};
use crate::motor::transient::FLIGHTS_OF_EVENT;

/// Rotors that lie on the platform for ever.
#[derive(Debug)]
pub(super) struct Lying {
    engines: Vec<Engine>,
    now: PhaseTime,
}

impl Lying {
    pub(super) const fn new(engines: Vec<Engine>, phase: Phase) -> Self {
        Self { engines, now: PhaseTime::in_first_period(phase) }
    }

    /// A window of whole periods, at least of `duration` rad but for the most of them: at its ends the platform is in the
    /// same state.
    pub(super) fn next_window(
        &mut self,
        duration: f64,
        most: u64,
        work: &mut WorkCount<'_>,
    ) -> Result<Window, Error> {
        let periods = ((duration / TAU) as u64).saturating_add(1).min(most);
        let end = self.now.after(PhaseSpan { periods, remainder: 0.0 });
        let mut window = Window {
            axial: AxialWindow {
                duration: end.since(&self.now).radians(),
                impacts: periods,
                ..AxialWindow::default()
            },
            rotors: Vec::with_capacity(self.engines.len()),
        };
        for (index, engine) in self.engines.iter_mut().enumerate() {
            let (angle, speed) = (engine.state().angle, engine.state().angular_speed);
            let mut ledger = EnergyLedger::default();
            engine.pause_at(end);
            while let Some(record) = engine.advance()? {
                work.spend(FLIGHTS_OF_EVENT)?;
                ledger += record.ledger;
                if record.event == Event::Separation {
                    engine.resume_in(record.before.mode);
                    break;
                }
            }
            let after = engine.state().angular_speed;
            window.rotors.push(RotorWindow {
                angle: engine.state().angle - angle,
                friction_work: ledger.friction_work,
                friction_loss: ledger.friction_loss,
                load_work: ledger.load_work,
                kinetic_change: 0.5 * (after - speed) * (after + speed),
            });
            if index == 0 {
                window.axial.normal_work = ledger.normal_work;
                window.axial.energy_change = ledger.axial_kinetic_change + ledger.potential_change;
            }
        }
        self.now = end;
        Ok(window)
    }
}
