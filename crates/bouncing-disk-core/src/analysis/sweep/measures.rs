//! What is asked of many orbits at once.

use core::ops::ControlFlow;

use super::{SweepEvent, sweep};
use crate::error::Error;
use crate::map::impact_map::{ImpactState, Orbit};

/// Most impacts that [`orbit_diagram`] records, of all orbits together.
pub const MAX_RECORDED: u64 = 1 << 31;

/// How many impacts each orbit has before the disk comes to rest, at most `most`: an orbit that never comes to rest is followed
/// for as many.
///
/// # Errors
/// Those of [`sweep`].
pub fn survival_times(orbits: &[Orbit], most: usize) -> Result<Vec<usize>, Error> {
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
            SweepEvent::Attachment(_) => ControlFlow::Break(()),
        },
    )
}

/// The columns of a bifurcation diagram: of each orbit the `recorded` impacts that follow the first `transient` ones. A disk
/// that comes to rest goes on with its next separation; one that rests for ever has fewer impacts.
///
/// # Errors
/// [`Error::TooLarge`] for more than [`MAX_RECORDED`] impacts of all orbits together or than there is memory for; those of
/// [`sweep`].
pub fn orbit_diagram(
    orbits: &[Orbit],
    transient: usize,
    recorded: usize,
) -> Result<Vec<Vec<ImpactState>>, Error> {
    if recorded == 0 {
        return Ok(vec![Vec::new(); orbits.len()]);
    }
    let count = (orbits.len() as u64).saturating_mul(recorded as u64);
    let refusal = Error::TooLarge { what: "recorded impacts", count, limit: MAX_RECORDED };
    if count > MAX_RECORDED {
        return Err(refusal);
    }
    let columns = sweep(
        orbits,
        |_| (0, Some(Vec::new())),
        |(skipped, column), event| {
            let Some(states) = column else { return ControlFlow::Break(()) };
            match event {
                SweepEvent::Impact(_) if *skipped < transient => *skipped += 1,
                SweepEvent::Impact(landing) => {
                    // Not all at once: a disk that rests for ever needs little.
                    if states.try_reserve(1).is_err() {
                        *column = None;
                        return ControlFlow::Break(());
                    }
                    states.push(landing.state);
                }
                SweepEvent::Attachment(_) => {}
            }
            if states.len() < recorded { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
        },
    )?;
    columns.into_iter().map(|(_, states)| states.ok_or(refusal)).collect()
}
