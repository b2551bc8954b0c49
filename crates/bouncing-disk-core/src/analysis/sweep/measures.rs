//! What is asked of many orbits at once.

use core::ops::ControlFlow;

use super::{SweepEvent, SweepImpact, sweep};
use crate::chatter::accumulation::ChatterPolicy;
use crate::error::Error;
use crate::map::impact_map::{ImpactMap, ImpactState, Orbit};
use crate::numerics::elementary::ln;

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

/// Growth of a small perturbation along the impacts of an orbit.
#[derive(Debug, Clone, Copy)]
struct Growth {
    state: ImpactState,
    transient: usize,
    impacts: usize,
    tangent: (f64, f64),
    sum: f64,
    /// False from the first rest or graze on.
    holds: bool,
}

impl Growth {
    const fn new(state: ImpactState) -> Self {
        Self { state, transient: 0, impacts: 0, tangent: (1.0, 0.0), sum: 0.0, holds: true }
    }

    /// Follows the tangent through one impact.
    fn grow(&mut self, map: &ImpactMap, landing: &SweepImpact) {
        let jacobian = map.derivative(self.state, landing.state, landing.duration);
        let (by_phase, by_velocity) = (jacobian.x_axis, jacobian.y_axis);
        let x = by_phase.x * self.tangent.0 + by_velocity.x * self.tangent.1;
        let y = by_phase.y * self.tangent.0 + by_velocity.y * self.tangent.1;
        let length = (x * x + y * y).sqrt();
        self.holds &= length > 0.0 && length.is_finite();
        self.sum += ln(length);
        self.tangent = (x / length, y / length);
        self.impacts += 1;
    }

    fn exponent(&self) -> Option<f64> {
        (self.holds && self.impacts > 0).then(|| self.sum / self.impacts as f64)
    }
}

/// The largest Lyapunov exponent per impact of each orbit of `starts`: the mean logarithmic growth of a small perturbation
/// over `impacts` impacts after `transient` ones. `None` where the disk comes to rest (the motion after a rest does not
/// depend on the one before) or grazes the platform (the derivative is unbounded there).
///
/// # Errors
/// Those of [`sweep`].
pub fn lyapunov_exponents(
    starts: &[(ImpactMap, ImpactState)],
    transient: usize,
    impacts: usize,
) -> Result<Vec<Option<f64>>, Error> {
    let orbits: Vec<Orbit> =
        starts.iter().map(|(map, state)| map.orbit(*state, ChatterPolicy::Complete)).collect();
    if impacts == 0 {
        return Ok(vec![None; orbits.len()]);
    }
    let growths = sweep(
        &orbits,
        |index| (starts[index].0, Growth::new(starts[index].1)),
        |(map, growth), event| {
            let SweepEvent::Impact(landing) = event else {
                growth.holds = false;
                return ControlFlow::Break(());
            };
            if growth.transient < transient {
                growth.transient += 1;
            } else {
                growth.grow(map, landing);
            }
            growth.state = landing.state;
            if growth.holds && growth.impacts < impacts {
                ControlFlow::Continue(())
            } else {
                ControlFlow::Break(())
            }
        },
    )?;
    Ok(growths.into_iter().map(|(_, growth)| growth.exponent()).collect())
}
