//! The impact that ends a flight: when, where and how fast. What it does to the disk, Eqs. (5)-(10), is the model's
//! (`motion/impact.rs` there).

use core::f64::consts::TAU;

use crate::flight::platform::phase::Phase;
use crate::numerics::error::{Error, within};
use crate::read_checked;

/// The first impact after a launch.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedImpact"))]
pub struct Impact {
    /// Whole periods of the duration of the flight.
    pub periods: u64,
    /// The rest of the duration in radians, in [0, 2 pi).
    pub remainder: f64,
    /// How often the phase passed 0 (mod 2 pi) during the flight: what a period counter advances by.
    pub turns: u64,
    /// Phase of the impact.
    pub phase: Phase,
    /// Relative axial velocity w_A (disk minus platform) just before the impact, <= 0, in units of g/omega.
    pub velocity: f64,
    /// Evaluations of the gap.
    pub evaluations: u32,
}

read_checked!(Impact as UncheckedImpact {
    periods: u64,
    remainder: f64,
    turns: u64,
    phase: Phase,
    velocity: f64,
    evaluations: u32,
});

impl Impact {
    /// Checks what is read; rounding may take the remainder to 2 pi.
    fn check(&self) -> Result<(), Error> {
        within("remainder", self.remainder, 0.0, TAU, "[0, 2 pi] (rad)")?;
        within("velocity", self.velocity, f64::MIN, 0.0, "(-inf, 0] (units of g/omega)")?;
        Ok(())
    }

    /// Duration of the flight in radians (rounded: the exact value is `periods` and `remainder`).
    #[must_use]
    pub fn duration(&self) -> f64 {
        self.periods as f64 * TAU + self.remainder
    }

    /// The same, field by field: what a function has just written in parts is read whole only after a stall.
    #[inline(always)]
    pub(crate) const fn in_parts(self) -> Self {
        let Self { periods, remainder, turns, phase, velocity, evaluations } = self;
        Self { periods, remainder, turns, phase: phase.in_parts(), velocity, evaluations }
    }
}
