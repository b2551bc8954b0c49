//! A disk on a stator that yields: the state, the records of events, and what may come next.

use super::linear_flow::{LinearFlow, dot, size};
use super::regime::{CLOSING, N, State};
use super::{MODES, StatorSystem};
use crate::motion::contact_motion::Lying;
use crate::motion::energy::EnergyLedger;
use crate::motion::engine::Stage;
use crate::motion::event::{Energies, Event, MotionRecord};
use crate::motion::phase_time::{PhaseSpan, PhaseTime};
use crate::motion::state::{DiskState, LongSum, SlipDirection};
use crate::motion::stator_ledger::StatorLedger;

/// A chatter that would last for less than this (rad) ends at once, and the momentum is kept. During that time the positions are
/// off by its square, and after it the states are off by its third power.
pub(super) const CHATTER: f64 = 1.0e-7;

/// Rounding of a functional at an event, in units of the sizes of its terms.
pub(super) const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// A contact whose modes come back to the same state after a period, within this share of it, repeats for ever.
pub(super) const SAME: f64 = 1.0e-13;

/// Disk and modes at an instant.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct StatorState {
    /// The disk.
    pub disk: DiskState,
    /// Coordinate and speed of each mode, the steady motion included; zero for a mode that is not there.
    pub modes: [[f64; 2]; MODES],
}

/// An event, with what happened since the one before.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct StatorRecord {
    /// When it happened.
    pub time: PhaseTime,
    /// The event.
    pub event: Event,
    /// Just before.
    pub before: StatorState,
    /// Just after.
    pub after: StatorState,
    /// Axial impulse per unit mass, and angular impulse per moment of inertia; zero without an impact.
    pub axial_impulse: f64,
    /// The same by friction.
    pub angular_impulse: f64,
    /// Energy balance of the disk.
    pub ledger: EnergyLedger,
    /// Energy balance of the modes.
    pub stator: StatorLedger,
    /// Since the event before.
    pub span: PhaseSpan,
}

impl StatorRecord {
    /// The largest of the closures of both ledgers, relative to the sizes of the added terms.
    #[must_use]
    pub fn relative_closure(&self) -> f64 {
        let least = f64::MIN_POSITIVE / f64::EPSILON;
        (self.stator.closure().abs() / self.stator.magnitude.max(least)).max(self.ledger.relative_closure())
    }
}

/// How a flight begins, which says which derivatives of the gap vanish at its start.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Launch {
    /// Above the platform.
    Air,
    /// From the platform with a speed.
    Rebound,
    /// By a force that falls to zero: in a rigid contact with no acceleration, in a soft one below the platform.
    /// With its third derivative.
    Release(f64),
    /// Below the platform of a soft contact, where spring and damper would pull.
    Below,
}

/// What the disk does until the next event.
pub(super) type StatorStage = Stage<Launch, Sometime>;

/// The motion of a disk on a stator that yields, as a lazy sequence of [`StatorRecord`]s. It ends where nothing more
/// can happen, and after an error.
#[derive(Debug, Clone)]
pub struct StatorEngine {
    pub(super) system: StatorSystem,
    pub(super) stage: StatorStage,
    pub(super) now: PhaseTime,
    pub(super) state: State,
    pub(super) angle: LongSum,
    /// The line of the load.
    pub(super) line: usize,
    /// Changes between stick and slide at the same instant.
    pub(super) ties: u32,
    /// So long after the last event the disk flies without another one.
    pub(super) searched: f64,
    /// So long the disk has flown before `now`.
    pub(super) aloft: f64,
    /// Without it ledgers stay empty.
    pub(crate) with_energy: bool,
    /// Whether long flights are searched from where the stator can come on them, which needs many times less time and rounds
    /// otherwise than a run-up, whose bits stay.
    pub(crate) bounds_closely: bool,
}

impl MotionRecord for StatorRecord {
    fn time(&self) -> PhaseTime {
        self.time
    }

    fn event(&self) -> Event {
        self.event
    }

    fn energies(&self) -> Energies {
        Energies { disk: self.ledger, stator: self.stator }
    }
}

/// The end of a contact that is not known to last for ever.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Sometime;

/// A disk that lies on the stator, and slides in this direction or sticks.
pub(super) const fn lying(slip: Option<SlipDirection>) -> StatorStage {
    Stage::Lying(Lying { slip, end: Some(Sometime) })
}

/// The next event of a stage: after which time, and which.
pub(super) type Next = Option<(f64, Crossing)>;

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Crossing {
    /// The gap closes, with this relative velocity.
    Touch(f64),
    /// The force of a soft contact sets in before the spring is free.
    Recontact,
    /// The normal force falls to zero.
    Release,
    /// The slip ends.
    SlipEnd,
    /// Friction gives way, and the disk slides so.
    Slips(SlipDirection),
    /// The speed reaches another line of the load.
    LoadNode(usize),
}

impl Crossing {
    pub(super) const fn is_of_friction(self) -> bool {
        matches!(self, Self::SlipEnd | Self::Slips(_))
    }
}

/// Which derivative of a functional is the first one beyond rounding, and whether it is positive; `None` if none is.
pub(super) fn first_sign(flow: &LinearFlow<N>, functional: &State, state: &State) -> Option<(usize, bool)> {
    let mut of = *functional;
    for order in 0..6 {
        let value = dot(&of, state);
        if value.abs() > ROUNDING * size(&of, state) {
            return Some((order, value > 0.0));
        }
        of = flow.derivative(&of);
    }
    None
}

pub(super) fn closing() -> State {
    let mut of = [0.0; N];
    of[CLOSING] = 1.0;
    of
}
