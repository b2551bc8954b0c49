//! What carries a rotor: a stator that moves in any way whatever lies on it, or one that yields.

use bouncing_disk_core::{ChatterPolicy, Phase};

use crate::driven::{DrivenEngine, DrivenStart, DrivenSystem};
use crate::error::Error;
use crate::motion::energy::EnergyLedger;
use crate::motion::event::Event;
use crate::motion::phase_time::PhaseTime;
use crate::motion::state::DiskState;
use crate::parameters::driven_platform::DrivenPlatform;
use crate::parameters::scales::Scales;
use crate::parameters::system::System;
use crate::stator::{LoadLine, MODES, StatorEngine, StatorLedger, StatorState, StatorSystem};

/// Where a rotor on a stator that yields was left.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Left {
    pub(crate) time: PhaseTime,
    pub(crate) state: StatorState,
    /// Whether the coordinate of a mode is a height.
    rises: [bool; MODES],
}

impl Left {
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

/// The system of a motor.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Carrier {
    Driven(DrivenSystem),
    Yielding(Box<StatorSystem>),
}

impl Carrier {
    /// This carrier with the load, friction and phase lag of another motor.
    pub(crate) fn for_motor(&self, stator: &DrivenPlatform, motor: &System) -> Result<Self, Error> {
        Ok(match self {
            Self::Driven(system) => Self::Driven(system.for_motor(stator, motor)?),
            Self::Yielding(system) => Self::Yielding(Box::new(system.with_base(motor.dimensionless())?)),
        })
    }

    /// This carrier without the law of the load.
    pub(crate) fn without_law(&self) -> Result<Self, Error> {
        Ok(match self {
            Self::Driven(_) => self.clone(),
            Self::Yielding(system) => {
                let line = LoadLine { from: f64::NEG_INFINITY, to: f64::INFINITY, torque: 0.0, slope: 0.0 };
                Self::Yielding(Box::new((**system).clone().with_load(&[line])?))
            }
        })
    }

    pub(crate) const fn driven(&self) -> Option<&DrivenSystem> {
        match self {
            Self::Driven(system) => Some(system),
            Self::Yielding(_) => None,
        }
    }

    pub(crate) const fn yielding(&self) -> Option<&StatorSystem> {
        match self {
            Self::Yielding(system) => Some(system),
            Self::Driven(_) => None,
        }
    }

    pub(crate) fn takes_time(&self) -> bool {
        match self {
            Self::Driven(system) => system.compliance.is_some(),
            Self::Yielding(system) => system.takes_time(),
        }
    }

    /// A rotor that goes on from where it was left on another stator that yields; elsewhere one that starts anew.
    pub(crate) fn resume(&self, from: &Left) -> Result<Option<CarriedEngine>, Error> {
        let Self::Yielding(system) = self else { return Ok(None) };
        let engine = StatorEngine::of_state((**system).clone(), from.time, from.state)?;
        Ok(Some(CarriedEngine::Yielding(Box::new(engine))))
    }

    /// A rotor that lies on it.
    pub(crate) fn start(
        &self,
        phase: Phase,
        angular_speed: f64,
        policy: ChatterPolicy,
    ) -> Result<CarriedEngine, Error> {
        let start = DrivenStart::Contact { phase, angular_speed };
        Ok(match self {
            Self::Driven(system) => {
                CarriedEngine::Driven(Box::new(DrivenEngine::new(system.clone(), start, policy)?))
            }
            Self::Yielding(system) => {
                CarriedEngine::Yielding(Box::new(StatorEngine::new((**system).clone(), start)?))
            }
        })
    }
}

/// Its engine.
#[derive(Debug)]
pub(crate) enum CarriedEngine {
    Driven(Box<DrivenEngine>),
    Yielding(Box<StatorEngine>),
}

/// Calls the engine that there is.
macro_rules! either {
    ($self:expr, $engine:ident => $call:expr) => {
        match $self {
            CarriedEngine::Driven($engine) => $call,
            CarriedEngine::Yielding($engine) => $call,
        }
    };
}

impl CarriedEngine {
    pub(crate) fn time(&self) -> PhaseTime {
        either!(self, engine => engine.time())
    }

    pub(crate) fn launches(&self) -> bool {
        either!(self, engine => engine.launches())
    }

    pub(crate) fn lies_for_ever(&self) -> bool {
        use crate::motion::event::Motion;
        match self {
            Self::Driven(engine) => engine.lies_for_ever(),
            Self::Yielding(engine) => engine.lies_for_ever(),
        }
    }

    pub(crate) fn disk(&self) -> DiskState {
        match self {
            Self::Driven(engine) => *engine.state(),
            Self::Yielding(engine) => engine.state().disk,
        }
    }

    /// The next event within `limit`, the energy balances up to it
    pub(crate) fn advance_within(
        &mut self,
        limit: f64,
    ) -> Result<Option<(Event, EnergyLedger, StatorLedger)>, Error> {
        Ok(match self {
            Self::Driven(engine) => engine
                .advance_within(limit)?
                .map(|record| (record.event, record.ledger, StatorLedger::default())),
            Self::Yielding(engine) => {
                engine.advance_within(limit)?.map(|record| (record.event, record.ledger, record.stator))
            }
        })
    }

    pub(crate) fn perturb_launch(&mut self, speed: f64) {
        either!(self, engine => engine.perturb_launch(speed));
    }

    /// The rotor so long after the last event, if no event comes before.
    pub(crate) fn disk_after(&self, span: f64) -> DiskState {
        match self {
            Self::Driven(engine) => engine.state_after(span).1,
            Self::Yielding(engine) => engine.state_after(span).1.disk,
        }
    }

    pub(crate) fn ledgers_after(&self, span: f64) -> (EnergyLedger, StatorLedger) {
        match self {
            Self::Driven(engine) => (engine.ledger_after(span), StatorLedger::default()),
            Self::Yielding(engine) => engine.ledgers_after(span),
        }
    }

    /// The energy of the spring of a contact so long after the last event, with the rotor in this state.
    pub(crate) fn spring_energy(&self, span: f64, state: &DiskState) -> f64 {
        match self {
            Self::Driven(engine) => engine.spring_energy(span, state),
            Self::Yielding(engine) => engine.spring_energy(span),
        }
    }

    /// Disk and modes of a stator that yields at a time before the next event.
    pub(crate) fn left_at(&self, time: PhaseTime) -> Option<Left> {
        let Self::Yielding(engine) = self else { return None };
        let state = engine.state_after(time.since(&engine.time()).radians()).1;
        Some(Left { time, state, rises: engine.system().modes.map(|mode| mode.height != 0.0) })
    }

    /// The engine of a stator that does not yield.
    pub(crate) fn driven(&mut self) -> Option<&mut DrivenEngine> {
        match self {
            Self::Driven(engine) => Some(engine),
            Self::Yielding(_) => None,
        }
    }

    /// The amplitude of the axial mode, so long after the last event.
    pub(crate) fn amplitude_after(&self, span: f64) -> Option<f64> {
        match self {
            Self::Driven(_) => None,
            Self::Yielding(engine) => engine.amplitude_after(span),
        }
    }

    /// Whether the rotor lies on a stator that yields.
    pub(crate) fn lies(&self) -> bool {
        matches!(self, Self::Yielding(engine) if !engine.launches())
    }

    /// Goes on from so long after the last event, if none comes before: what follows need not be followed from there.
    pub(crate) fn pause(&mut self, span: f64) -> (EnergyLedger, StatorLedger) {
        match self {
            Self::Driven(_) => Default::default(),
            Self::Yielding(engine) => {
                let record = engine.pause(span);
                (record.ledger, record.stator)
            }
        }
    }

    /// Stills the modes of a stator at its start.
    pub(crate) fn calm(&mut self) {
        if let Self::Yielding(engine) = self {
            engine.calm();
        }
    }

    /// Goes on with another stator or load.
    pub(crate) fn switch(&mut self, span: f64, to: StatorSystem) {
        if let Self::Yielding(engine) = self {
            engine.switch(span, to);
        }
    }

    /// Without energies, of which a run-up needs none.
    pub(crate) fn without_energy(mut self) -> Self {
        either!(&mut self, engine => engine.with_energy = false);
        self
    }
}
