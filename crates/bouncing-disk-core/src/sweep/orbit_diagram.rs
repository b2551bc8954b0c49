//! Orbit diagrams and survival times of many orbits at once.

use core::ops::ControlFlow;

use super::events::SweepEvent;
use super::outcomes::{sweep, sweep_with};
use crate::map::impact_map::ImpactState;
use crate::numerics::error::Error;
use crate::run::Observer;
use crate::sweep::bouncing_map::BouncingOrbit;

/// Largest number of events without an impact, after which a disk counts as no longer bouncing: kinks may hit
/// it forever.
const MOST_CONTACT_EVENTS: usize = 10_000;

/// Largest number of impacts that [`orbit_diagram`] records, of all orbits together.
pub const MAX_RECORDED: u64 = 1 << 31;

/// The number of impacts of each orbit before the disk comes to rest, at most `most`. The result `most` means
/// that the disk did not come to rest.
///
/// The items of `observer` are the orbits.
///
/// # Errors
/// Errors of [`sweep`](super::sweep).
pub fn survival_times<O: BouncingOrbit>(
    orbits: &[O],
    most: usize,
    observer: &dyn Observer,
) -> Result<Vec<usize>, Error> {
    if most == 0 {
        return Ok(vec![0; orbits.len()]);
    }
    sweep(
        orbits,
        |_| 0,
        |lived, event| match event {
            SweepEvent::Impact(_) => {
                *lived += 1;
                if *lived < most { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
            }
            _ => ControlFlow::Break(()),
        },
        observer,
    )
}

/// The columns of a bifurcation diagram: for each orbit the `recorded` impacts after the first `transient`
/// ones. A disk that comes to rest continues with its next separation. A disk that rests forever, or is only
/// hit by kinks of the platform, has fewer impacts.
///
/// The items of `observer` are the orbits.
///
/// # Errors
/// [`Error::TooLarge`] for more than [`MAX_RECORDED`] impacts of all orbits together, or too many for the
/// memory; errors of [`sweep`](super::sweep).
pub fn orbit_diagram<O: BouncingOrbit>(
    orbits: &[O],
    transient: usize,
    recorded: usize,
    observer: &dyn Observer,
) -> Result<Vec<Vec<ImpactState>>, Error> {
    if recorded == 0 {
        return Ok(vec![Vec::new(); orbits.len()]);
    }
    let count = (orbits.len() as u64).saturating_mul(recorded as u64);
    let refusal = Error::TooLarge { what: "recorded impacts", count, limit: MAX_RECORDED };
    if count > MAX_RECORDED {
        return Err(refusal);
    }
    sweep_with(
        orbits,
        |_| (0, 0, Some(Vec::new())),
        |(skipped, contacts, column), event| {
            *contacts = if matches!(event, SweepEvent::Impact(_)) { 0 } else { *contacts + 1 };
            if *contacts > MOST_CONTACT_EVENTS {
                return ControlFlow::Break(());
            }
            let Some(states) = column else { return ControlFlow::Break(()) };
            match event {
                SweepEvent::Impact(_) if *skipped < transient => *skipped += 1,
                SweepEvent::Impact(landing) => {
                    // Not all at once: a disk that rests forever needs little.
                    if states.try_reserve(1).is_err() {
                        *column = None;
                        return ControlFlow::Break(());
                    }
                    states.push(landing.state);
                }
                _ => {}
            }
            if states.len() < recorded { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
        },
        |(.., states)| states.ok_or(refusal),
        observer,
    )
}
