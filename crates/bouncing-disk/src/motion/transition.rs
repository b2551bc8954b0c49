//! The events that lead from each mode to the next: the flow chart of the simulation (Sec. II B, Fig. 3).

use crate::motion::event::{Event, EventRecord};
use crate::motion::state::Mode;
use std::fmt::{self, Display, Formatter};

/// A [`Mode`] without its direction.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum ModeKind {
    /// [`Mode::Flight`].
    Flight,
    /// [`Mode::Sticking`].
    Sticking,
    /// [`Mode::Sliding`].
    Sliding,
}

impl ModeKind {
    /// All modes.
    pub const ALL: [Self; 3] = [Self::Flight, Self::Sticking, Self::Sliding];
}

/// An [`Event`] without its numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum EventKind {
    /// [`Event::Impact`].
    Impact,
    /// [`Event::Attachment`].
    Attachment,
    /// [`Event::Separation`].
    Separation,
    /// [`Event::StickToSlip`].
    StickToSlip,
    /// [`Event::SlipToStick`].
    SlipToStick,
    /// [`Event::SlipReversal`].
    SlipReversal,
    /// [`Event::Kick`].
    Kick,
    /// [`Event::SlipJump`].
    SlipJump,
    /// [`Event::Recontact`].
    Recontact,
    /// [`Event::Turn`].
    Turn,
    /// [`Event::Joint`].
    Joint,
}

impl EventKind {
    /// All events.
    pub const ALL: [Self; 11] = [
        Self::Impact,
        Self::Attachment,
        Self::Separation,
        Self::StickToSlip,
        Self::SlipToStick,
        Self::SlipReversal,
        Self::Kick,
        Self::SlipJump,
        Self::Recontact,
        Self::Turn,
        Self::Joint,
    ];
}

/// An event with the modes before and after it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Transition {
    /// The mode that the event ends.
    pub from: ModeKind,
    /// The event.
    pub event: EventKind,
    /// The mode that follows.
    pub to: ModeKind,
}

impl Transition {
    /// The transitions that the equations of motion allow on the platform of Eq. (1); every other combination
    /// is a programming error.
    pub const LEGAL: [Self; 8] = [
        Self::new(ModeKind::Flight, EventKind::Impact, ModeKind::Flight),
        Self::new(ModeKind::Flight, EventKind::Attachment, ModeKind::Sticking),
        Self::new(ModeKind::Flight, EventKind::Attachment, ModeKind::Sliding),
        Self::new(ModeKind::Sticking, EventKind::Separation, ModeKind::Flight),
        Self::new(ModeKind::Sticking, EventKind::StickToSlip, ModeKind::Sliding),
        Self::new(ModeKind::Sliding, EventKind::Separation, ModeKind::Flight),
        Self::new(ModeKind::Sliding, EventKind::SlipToStick, ModeKind::Sticking),
        Self::new(ModeKind::Sliding, EventKind::SlipReversal, ModeKind::Sliding),
    ];

    const fn new(from: ModeKind, event: EventKind, to: ModeKind) -> Self {
        Self { from, event, to }
    }

    /// Whether the equations of motion allow this transition on the platform of Eq. (1).
    #[must_use]
    pub fn is_legal(&self) -> bool {
        Self::LEGAL.contains(self)
    }
}

impl Mode {
    /// The mode without its direction.
    #[must_use]
    pub const fn kind(self) -> ModeKind {
        match self {
            Self::Flight => ModeKind::Flight,
            Self::Sticking => ModeKind::Sticking,
            Self::Sliding(_) => ModeKind::Sliding,
        }
    }
}

impl Event {
    /// Whether the event relaunches a disk that lay on the platform: a separation, as the platform falls
    /// away, or a kick, as it hits the disk. All such relaunches are perturbed alike.
    pub(crate) const fn is_relaunch(&self) -> bool {
        matches!(self, Self::Separation | Self::Kick { .. })
    }

    /// The event without its numbers.
    #[must_use]
    pub const fn kind(&self) -> EventKind {
        match self {
            Self::Impact { .. } => EventKind::Impact,
            Self::Attachment { .. } => EventKind::Attachment,
            Self::Separation => EventKind::Separation,
            Self::StickToSlip(_) => EventKind::StickToSlip,
            Self::SlipToStick => EventKind::SlipToStick,
            Self::SlipReversal(_) => EventKind::SlipReversal,
            Self::Kick { .. } => EventKind::Kick,
            Self::SlipJump(_) => EventKind::SlipJump,
            Self::Recontact => EventKind::Recontact,
            Self::Turn => EventKind::Turn,
            Self::Joint => EventKind::Joint,
        }
    }
}

impl EventRecord {
    /// The event with the modes before and after it.
    #[must_use]
    pub const fn transition(&self) -> Transition {
        Transition::new(self.before.mode.kind(), self.event.kind(), self.after.mode.kind())
    }
}

impl Display for ModeKind {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Flight => "flight",
            Self::Sticking => "sticking",
            Self::Sliding => "sliding",
        })
    }
}

impl Display for EventKind {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Impact => "impact",
            Self::Attachment => "attachment",
            Self::Separation => "separation",
            Self::StickToSlip => "stick to slip",
            Self::SlipToStick => "slip to stick",
            Self::SlipReversal => "slip reversal",
            Self::Kick => "kick",
            Self::SlipJump => "slip jump",
            Self::Recontact => "recontact",
            Self::Turn => "turn",
            Self::Joint => "joint",
        })
    }
}

impl Display for Transition {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "{} -> {} -> {}", self.from, self.event, self.to)
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use crate::motion::engine::Engine;
    use crate::testing;

    proptest! {
        #[test]
        fn only_legal_transitions_happen((system, start, policy) in testing::motion()) {
            let Ok(engine) = Engine::new(system, start, policy) else { return Ok(()) };
            for record in engine.take(200).map_while(Result::ok) {
                prop_assert!(record.transition().is_legal(), "{:?}", record.transition());
            }
        }
    }
}
