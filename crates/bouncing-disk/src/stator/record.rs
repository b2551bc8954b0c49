//! A disk on a compliant stator: its state, its event records, and the possible next events.

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

/// A chatter that would last less than this (rad) ends at once, with its momentum kept. During that time the
/// positions are wrong by its square, and afterwards the states by its cube.
pub(super) const CHATTER: f64 = 1.0e-7;

/// Rounding of a functional at an event, relative to the magnitudes of its terms.
pub(super) const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// If the modes return to the same state after a period, within this share of it, the contact repeats for
/// ever.
pub(super) const SAME: f64 = 1.0e-13;

/// Disk and modes at an instant.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct StatorState {
    /// The disk.
    pub disk: DiskState,
    /// Coordinate and speed of each mode, including the steady motion; zero for an absent mode.
    pub modes: [[f64; 2]; MODES],
}

/// An event, and the balances since the previous one.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct StatorRecord {
    /// Time of the event.
    pub time: PhaseTime,
    /// The event.
    pub event: Event,
    /// State just before.
    pub before: StatorState,
    /// State just after.
    pub after: StatorState,
    /// Axial impulse per unit mass; zero without an impact.
    pub axial_impulse: f64,
    /// Angular impulse of friction per moment of inertia; zero without an impact.
    pub angular_impulse: f64,
    /// Energy balance of the disk.
    pub ledger: EnergyLedger,
    /// Energy balance of the modes.
    pub stator: StatorLedger,
    /// Time since the previous event.
    pub span: PhaseSpan,
}

impl StatorRecord {
    /// The larger of the two ledgers' closures, relative to the magnitudes of their terms.
    #[must_use]
    pub fn relative_closure(&self) -> f64 {
        let least = f64::MIN_POSITIVE / f64::EPSILON;
        (self.stator.closure().abs() / self.stator.magnitude.max(least)).max(self.ledger.relative_closure())
    }
}

/// How a flight begins, which determines the derivatives of the gap that vanish at its start.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Launch {
    /// A start above the platform.
    Air,
    /// A launch from the platform with a speed.
    Rebound,
    /// A contact force that falls to zero: in a rigid contact without acceleration, in a compliant one below the
    /// platform. Contains the third derivative of the gap.
    Release(f64),
    /// A start below the platform in a compliant contact, where spring and damper would pull.
    Below,
}

/// The disk's motion until the next event.
pub(super) type StatorStage = Stage<Launch, Sometime>;

/// The motion of a disk on a compliant stator, as a lazy sequence of [`StatorRecord`]s. It ends when no
/// further event is possible, and after an error.
#[derive(Debug, Clone)]
pub struct StatorEngine {
    pub(super) system: StatorSystem,
    pub(super) stage: StatorStage,
    pub(super) now: PhaseTime,
    pub(super) state: State,
    pub(super) angle: LongSum,
    /// The piece of the load.
    pub(super) line: usize,
    /// Number of changes between stick and slide at the same instant.
    pub(super) ties: u32,
    /// Time after the last event up to which the flight is known to have no event.
    pub(super) searched: f64,
    /// Duration of the flight before `now`.
    pub(super) aloft: f64,
    /// If false, ledgers stay empty.
    pub(crate) with_energy: bool,
    /// Whether a long flight is searched only from the time at which the stator can reach the disk. That is
    /// many times faster but rounds differently; run-ups do without it so that their bits do not change.
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

/// A disk that lies on the stator, sliding in this direction or sticking.
pub(super) const fn lying(slip: Option<SlipDirection>) -> StatorStage {
    Stage::Lying(Lying { slip, end: Some(Sometime) })
}

/// The next event of a stage, with the time until it.
pub(super) type Next = Option<(f64, Crossing)>;

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Crossing {
    /// The gap closes, with this relative velocity.
    Touch(f64),
    /// The force of a compliant contact returns before the spring is free.
    Recontact,
    /// The normal force falls to zero.
    Release,
    /// The slip ends.
    SlipEnd,
    /// Friction gives way, and the disk slides in this direction.
    Slips(SlipDirection),
    /// The speed reaches another piece of the load.
    LoadNode(usize),
}

impl Crossing {
    pub(super) const fn is_of_friction(self) -> bool {
        matches!(self, Self::SlipEnd | Self::Slips(_))
    }
}

/// The lowest derivative of a functional that exceeds rounding, and whether it is positive; `None` if all are
/// below rounding.
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
