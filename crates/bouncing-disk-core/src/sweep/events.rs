//! Many orbits of impact maps at once: the flights are computed in lockstep, with the same events as for each
//! orbit on its own.

use core::f64::consts::TAU;

use crate::chatter::policy::ChatterPolicy;
use crate::flight::launch::Impact;
use crate::flight::platform::phase::Phase;
use crate::map::impact_map::{Attachment, ContactChange, ImpactState, Orbit, OrbitEvent};
use crate::numerics::error::Error;

/// One event of an orbit of a sweep.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub enum SweepEvent {
    /// The disk hits the platform.
    Impact(SweepImpact),
    /// The disk comes to rest on the platform and, if the platform ever falls away, separates again.
    Attachment(Attachment),
    /// On a drive: the disk leaves the platform. See [`OrbitEvent::Separation`].
    Separation(ContactChange),
    /// On a drive: the platform hits the disk that rests on it. See [`OrbitEvent::Kick`].
    Kick(ContactChange),
}

impl SweepEvent {
    /// The event of a separately advanced orbit that left the platform at `from`.
    #[inline(always)]
    pub fn of(from: Option<Phase>, event: OrbitEvent) -> Self {
        match event {
            OrbitEvent::Impact(impact) => Self::Impact(SweepImpact::of(from, impact)),
            OrbitEvent::Attachment(rest) => Self::Attachment(rest),
            OrbitEvent::Separation(change) => Self::Separation(change),
            OrbitEvent::Kick(change) => Self::Kick(change),
        }
    }
}

/// An impact of a sweep: an [`Impact`] with fewer data on the flight before it.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct SweepImpact {
    /// The impact.
    pub state: ImpactState,
    /// How many times the phase passed 0 (mod 2 pi) during the flight.
    pub turns: u64,
    /// The duration of the flight in radians, computed from the two phases. Its absolute error is their
    /// rounding, while [`Impact::remainder`] has relative accuracy, however short the flight.
    pub duration: f64,
}

impl SweepImpact {
    #[inline(always)]
    pub(super) fn new(from: Phase, state: ImpactState, turns: u64) -> Self {
        let ahead = state.phase().angle() - from.angle();
        Self { state, turns, duration: turns as f64 * TAU + ahead }
    }

    /// The landing of a separately advanced orbit.
    #[inline(always)]
    fn of(from: Option<Phase>, impact: Impact) -> Self {
        // A disk that started in the air has no launch.
        from.map_or(Self { state: impact.into(), turns: impact.turns, duration: impact.duration() }, |from| {
            Self::new(from, impact.into(), impact.turns)
        })
    }

    /// A duration for which a cut decides as for the exact one whether the flight is short; `orbit` has not
    /// landed yet.
    #[inline(always)]
    pub(super) fn decisive_duration(&self, orbit: &Orbit) -> f64 {
        if let ChatterPolicy::Cut(cut) = orbit.policy()
            && cut.may_hang_on(self.duration)
            && let Some(launch) = orbit.launch()
            && let Ok(impact) = orbit.map().vibration().first_impact(launch)
        {
            return impact.duration();
        }
        self.duration
    }
}

/// The next event of a separately advanced orbit, in the form of a sweep.
#[inline]
pub(super) fn advance(orbit: &mut Orbit) -> Result<Option<SweepEvent>, Error> {
    let from = orbit.launch().map(|launch| launch.phase());
    Ok(orbit.advance()?.map(|event| SweepEvent::of(from, event)))
}
