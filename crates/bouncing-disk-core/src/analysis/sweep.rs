//! Many orbits of impact maps at once: the events are those of each orbit by itself, the flights are computed in lockstep.

mod orbit_diagram;
mod run;
mod runner;
mod settling;

use core::f64::consts::TAU;
use core::ops::ControlFlow;

use crate::chatter::policy::ChatterPolicy;
use crate::error::{Error, not_negative};
use crate::flight::impact::Impact;
use crate::map::impact_map::{Attachment, ImpactState, Orbit, OrbitEvent};
use crate::observer::Observer;
use crate::platform::phase::Phase;
use crate::read_checked;

pub use orbit_diagram::{MAX_RECORDED, orbit_diagram, survival_times};
pub use run::{PartialResults, SweepRun};
pub use settling::{is_settling, repeats_every};

/// One event of an orbit of a sweep.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum SweepEvent {
    /// The disk hits the platform.
    Impact(SweepImpact),
    /// The disk comes to rest on the platform and, if the platform ever falls away, separates again.
    Attachment(Attachment),
}

/// An impact of a sweep: what [`Impact`] says, but for the flight before it, of which the lockstep keeps less.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedSweepImpact"))]
pub struct SweepImpact {
    /// The impact.
    pub state: ImpactState,
    /// How often the phase passed 0 (mod 2 pi) during the flight.
    pub turns: u64,
    /// The duration of the flight in radians, from the two phases: its absolute error is their rounding, where
    /// [`Impact::remainder`] is accurate relative to itself, however short the flight.
    pub duration: f64,
}

read_checked!(SweepImpact as UncheckedSweepImpact {
    state: ImpactState,
    turns: u64,
    duration: f64,
});

impl SweepImpact {
    /// Checks what is read.
    fn check(&self) -> Result<(), Error> {
        not_negative("duration", self.duration).map(|_| ())
    }

    #[inline(always)]
    fn new(from: Phase, state: ImpactState, turns: u64) -> Self {
        let ahead = state.phase().angle() - from.angle();
        Self { state, turns, duration: turns as f64 * TAU + ahead }
    }

    /// The landing of an orbit that is advanced by itself.
    #[inline(always)]
    fn of(from: Option<Phase>, impact: Impact) -> Self {
        // A disk that started in the air has no launch.
        from.map_or(Self { state: impact.into(), turns: impact.turns, duration: impact.duration() }, |from| {
            Self::new(from, impact.into(), impact.turns)
        })
    }

    /// A duration that decides as the exact one does whether a cut counts the flight as short; `orbit` has not landed.
    #[inline(always)]
    fn decisive_duration(&self, orbit: &Orbit) -> f64 {
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

/// The next event of an orbit that is advanced by itself, as a sweep reports it.
#[inline]
fn advance(orbit: &mut Orbit) -> Result<Option<SweepEvent>, Error> {
    let from = orbit.launch().map(|launch| launch.phase());
    Ok(orbit.advance()?.map(|event| match event {
        OrbitEvent::Impact(impact) => SweepEvent::Impact(SweepImpact::of(from, impact)),
        OrbitEvent::Attachment(rest) => SweepEvent::Attachment(rest),
    }))
}

/// Follows many independent orbits, each until its visitor has seen enough or it ends, and returns what the visitors
/// made of them, in the order of the orbits.
///
/// `start` makes the value of the orbit of an index; `visit` is shown the events one by one, those of
/// [`Orbit::advance`], and breaks where the orbit need not be followed further. With the feature `parallel` the
/// orbits are spread over the threads of rayon's pool. Neither their number nor the instructions of the processor
/// change a bit.
///
/// An orbit that its visitor never breaks off and that never ends is followed for ever, or until the observer
/// of [`sweep`] breaks.
///
/// The items of `observer` are the orbits. A [`SweepRun`] keeps the finished ones of a call that is
/// stopped.
///
/// ```
/// use core::ops::ControlFlow;
/// use bouncing_disk_core::{ChatterPolicy, ImpactMap, ImpactState, SweepEvent, Unobserved, Vibration, sweep};
///
/// // How many impacts, up to a hundred, before a disk comes to rest, against the forcing.
/// let start = ImpactState::from_normalised(0.8, 1.3)?;
/// let orbits = (0..200)
///     .map(|k| {
///         let map = ImpactMap::new(Vibration::from_axial_forcing(0.3 + 1e-3 * f64::from(k))?, 0.5)?;
///         Ok(map.orbit(start, ChatterPolicy::Complete))
///     })
///     .collect::<Result<Vec<_>, bouncing_disk_core::Error>>()?;
/// let lives = sweep(&orbits, |_| 0, |lived, event| match event {
///     SweepEvent::Impact(_) if *lived < 100 => {
///         *lived += 1;
///         ControlFlow::Continue(())
///     }
///     _ => ControlFlow::Break(()),
/// }, &Unobserved)?;
/// assert!(lives[0] < 100 && lives[150] == 100);
/// # Ok::<(), bouncing_disk_core::Error>(())
/// ```
///
/// # Errors
/// That of the first orbit, in their order, that has no next impact (see [`Orbit::advance`]).
pub fn sweep<S: Send>(
    orbits: &[Orbit],
    start: impl Fn(usize) -> S + Sync,
    visit: impl Fn(&mut S, &SweepEvent) -> ControlFlow<()> + Sync,
    observer: &dyn Observer,
) -> Result<Vec<S>, Error> {
    let mut run = SweepRun::new(orbits.len());
    run.advance(orbits, start, visit, observer)?;
    run.into_results()
}

#[cfg(test)]
mod tests;
