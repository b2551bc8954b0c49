//! What carries a rotor from event to event.

use crate::driven::DrivenEngine;
use crate::error::Error;
use crate::motion::energy::EnergyLedger;
use crate::motion::event::{Event, Motion};
use crate::motion::phase_time::PhaseTime;
use crate::motion::state::DiskState;
use crate::stator::{StatorEngine, StatorLedger};

/// An event, and the energy balances of rotor and modes up to it.
pub(crate) struct CarriedEvent {
    pub(crate) event: Event,
    pub(crate) ledger: EnergyLedger,
    pub(crate) stator: StatorLedger,
}

/// An engine with a rotor.
pub(crate) trait Carried: std::fmt::Debug + Send {
    /// Whether the rotor acts back on the stator.
    const YIELDS: bool;

    fn time(&self) -> PhaseTime;
    fn disk(&self) -> DiskState;
    /// The next event within `limit` (rad).
    fn advance_within(&mut self, limit: f64) -> Result<Option<CarriedEvent>, Error>;
    /// The rotor so long after the last event, if no event comes before.
    fn disk_after(&self, span: f64) -> DiskState;
    fn ledgers_after(&self, span: f64) -> (EnergyLedger, StatorLedger);
    /// The energy of the spring of a contact so long after the last event, with the rotor in this state.
    fn spring_energy(&self, span: f64, state: &DiskState) -> f64;
    fn launches(&self) -> bool;
    fn lies_for_ever(&self) -> bool;
    fn perturb_launch(&mut self, speed: f64);
    /// Goes on from so long after the last event, if none comes before: what follows need not be followed from there.
    fn pause(&mut self, span: f64) -> (EnergyLedger, StatorLedger);

    /// Gap and relative velocity of a flight that begins now, on a prescribed stator.
    fn flight(&self) -> Option<[f64; 2]> {
        None
    }

    /// Goes on from such a flight.
    fn fly_from(&mut self, _time: PhaseTime, _launch: [f64; 2], _angular_speed: f64) {}
}

impl Carried for DrivenEngine {
    const YIELDS: bool = false;

    fn time(&self) -> PhaseTime {
        self.time()
    }

    fn disk(&self) -> DiskState {
        *self.state()
    }

    fn advance_within(&mut self, limit: f64) -> Result<Option<CarriedEvent>, Error> {
        let record = self.advance_within(limit)?;
        Ok(record.map(|own| CarriedEvent {
            event: own.event,
            ledger: own.ledger,
            stator: StatorLedger::default(),
        }))
    }

    fn disk_after(&self, span: f64) -> DiskState {
        self.state_after(span).1
    }

    fn ledgers_after(&self, span: f64) -> (EnergyLedger, StatorLedger) {
        (self.ledger_after(span), StatorLedger::default())
    }

    fn spring_energy(&self, span: f64, state: &DiskState) -> f64 {
        self.spring_energy(span, state)
    }

    fn launches(&self) -> bool {
        self.launches()
    }

    fn lies_for_ever(&self) -> bool {
        Motion::lies_for_ever(self)
    }

    fn perturb_launch(&mut self, speed: f64) {
        self.perturb_launch(speed);
    }

    fn pause(&mut self, _: f64) -> (EnergyLedger, StatorLedger) {
        Default::default()
    }

    fn flight(&self) -> Option<[f64; 2]> {
        self.flight()
    }

    fn fly_from(&mut self, time: PhaseTime, launch: [f64; 2], angular_speed: f64) {
        self.fly_from(time, launch, angular_speed);
    }
}

impl Carried for StatorEngine {
    const YIELDS: bool = true;

    fn time(&self) -> PhaseTime {
        self.time()
    }

    fn disk(&self) -> DiskState {
        self.state().disk
    }

    fn advance_within(&mut self, limit: f64) -> Result<Option<CarriedEvent>, Error> {
        let record = self.advance_within(limit)?;
        Ok(record.map(|own| CarriedEvent { event: own.event, ledger: own.ledger, stator: own.stator }))
    }

    fn disk_after(&self, span: f64) -> DiskState {
        self.state_after(span).1.disk
    }

    fn ledgers_after(&self, span: f64) -> (EnergyLedger, StatorLedger) {
        self.ledgers_after(span)
    }

    fn spring_energy(&self, span: f64, _: &DiskState) -> f64 {
        self.spring_energy(span)
    }

    fn launches(&self) -> bool {
        self.launches()
    }

    fn lies_for_ever(&self) -> bool {
        self.lies_for_ever()
    }

    fn perturb_launch(&mut self, speed: f64) {
        self.perturb_launch(speed);
    }

    fn pause(&mut self, span: f64) -> (EnergyLedger, StatorLedger) {
        let record = self.pause(span);
        (record.ledger, record.stator)
    }
}
