//! A branch under way, and its tip as plain data, from which it is extended.

use super::{Bifurcation, Branch, BranchPoint, Continuation};
use crate::numerics::error::{Error, finite, not_negative, within};
use crate::orbits::closing::{Closed, Closing};
use crate::orbits::periodic::MAX_PERIOD;
use crate::read_checked;

/// The smallest arclength of a step.
pub(super) const SMALLEST_STEP: f64 = 1.0e-10;

/// A point of the branch with its direction.
#[derive(Debug, Clone)]
pub(super) struct Located {
    pub(super) at: Closed,
    /// Of scaled length 1 in first impact and parameter.
    pub(super) direction: Closed,
    pub(super) arclength: f64,
    pub(super) corrections: u32,
}

/// Where a branch began, and in which direction (scaled; phase, speed, parameter): whether it is back there.
#[derive(Debug, Clone, Copy)]
pub(super) struct Start {
    pub(super) at: [f64; 3],
    pub(super) direction: [f64; 3],
}

/// A walk under way: all that the rest of it depends on.
#[derive(Debug)]
pub(super) struct Underway {
    pub(super) start: Start,
    pub(super) base: Located,
    pub(super) step: f64,
    pub(super) points: Vec<BranchPoint>,
    pub(super) bifurcations: Vec<Bifurcation>,
}

/// Where a branch goes on that has ended for its number of points: [`Branch::extended`]. It has all that the
/// rest of the branch depends on, to the bit, and is stored with the branch.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedTip"))]
pub struct BranchTip {
    /// Of the branch so far; the number of points is that of the next call.
    settings: Continuation,
    /// The units of speed and parameter.
    scale: (f64, f64),
    /// The turns of the phase in each flight.
    turns: Vec<f64>,
    /// The last point, its direction and its arclength.
    at: Closed,
    direction: Closed,
    arclength: f64,
    /// The arclength of the next step.
    step: f64,
    /// First impact and parameter at the start, scaled, and the direction there.
    start: [f64; 3],
    start_direction: [f64; 3],
}

read_checked!(BranchTip as UncheckedTip {
    settings: Continuation,
    scale: (f64, f64),
    turns: Vec<f64>,
    at: Closed,
    direction: Closed,
    arclength: f64,
    step: f64,
    start: [f64; 3],
    start_direction: [f64; 3],
});

impl BranchTip {
    /// Checks a value that was deserialised.
    fn check(&self) -> Result<(), Error> {
        let impacts = self.at.impacts.len();
        within("impacts of a branch", impacts as f64, 1.0, MAX_PERIOD as f64, "[1, 4096]")?;
        for (what, found) in [
            ("impacts of a direction", self.direction.impacts.len()),
            ("turns of the flights", self.turns.len()),
        ] {
            if found != impacts {
                return Err(Error::Unfitting { what, found: found as u64, expected: impacts as u64 });
            }
        }
        for turns in &self.turns {
            finite("turns of a flight", *turns)?;
        }
        for unit in [self.scale.0, self.scale.1] {
            within("unit of a branch", unit, f64::MIN_POSITIVE, f64::MAX, "(0, inf)")?;
        }
        for number in self.start.iter().chain(&self.start_direction) {
            finite("start of a branch", *number)?;
        }
        for (field, part) in [("tip of a branch", &self.at), ("direction of a branch", &self.direction)] {
            // The parameter stands for the first part that is no number.
            let number = if part.is_finite() { part.parameter } else { f64::NAN };
            finite(field, number)?;
        }
        not_negative("arclength", self.arclength)?;
        within("step of a branch", self.step, SMALLEST_STEP, 1.0, "[1e-10, 1]")?;
        Ok(())
    }

    /// The tip of a branch that has as many points as it may.
    pub(super) fn of(
        closing: &Closing,
        settings: &Continuation,
        start: Start,
        base: Located,
        step: f64,
    ) -> Self {
        let (scale, turns) = closing.scale_and_turns();
        Self {
            settings: *settings,
            scale,
            turns,
            at: base.at,
            direction: base.direction,
            arclength: base.arclength,
            step,
            start: start.at,
            start_direction: start.direction,
        }
    }

    /// How the branch was continued.
    #[must_use]
    pub const fn settings(&self) -> &Continuation {
        &self.settings
    }

    /// The walk along the branch, from its tip on.
    pub(super) fn underway(&self, branch: &Branch) -> Result<(Closing, Underway), Error> {
        let impacts = branch.points.last().map_or(0, |last| last.orbit.period());
        if impacts != self.at.impacts.len() || branch.parameter != self.settings.parameter() {
            let (found, expected) = (self.at.impacts.len() as u64, impacts as u64);
            return Err(Error::Unfitting { what: "impacts at the tip of a branch", found, expected });
        }
        let closing = Closing::of_parts(branch.map, branch.parameter, self.scale, self.turns.clone());
        let base = Located {
            at: self.at.clone(),
            direction: self.direction.clone(),
            arclength: self.arclength,
            corrections: 0,
        };
        let underway = Underway {
            start: Start { at: self.start, direction: self.start_direction },
            base,
            step: self.step,
            points: branch.points.clone(),
            bifurcations: branch.bifurcations.clone(),
        };
        Ok((closing, underway))
    }
}
