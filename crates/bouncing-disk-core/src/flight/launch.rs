//! A launch of the disk from the platform.

use crate::flight::platform::phase::Phase;
use crate::numerics::error::{Error, within};
use crate::numerics::stored::read_checked;
use core::f64::consts::TAU;

/// A launch of the disk from the platform.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedLaunch"))]
pub struct Launch {
    phase: Phase,
    relative_speed: f64,
}

read_checked!(Launch as UncheckedLaunch { phase: Phase, relative_speed: f64 } => Launch::new);

impl Launch {
    /// A launch at `phase` with `relative_speed` >= 0 (disk minus platform, in units of g/omega).
    ///
    /// Speed zero means "from rest on the platform". If the platform falls away, P sin tau >= 1, the disk
    /// separates; otherwise the flight returns [`Error::NoLiftOff`]. The launch itself is legal, because it
    /// does not depend on the platform.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a negative or non-finite speed.
    pub fn new(phase: Phase, relative_speed: f64) -> Result<Self, Error> {
        if relative_speed >= 0.0 && relative_speed.is_finite() {
            Ok(Self { phase, relative_speed })
        } else {
            Err(Error::OutOfRange {
                field: "relative_speed",
                value: relative_speed,
                legal: "[0, inf) (units of g/omega)",
            })
        }
    }

    /// A launch with a speed that is known to be legal.
    pub const fn known(phase: Phase, relative_speed: f64) -> Self {
        Self { phase, relative_speed }
    }

    /// Launch phase.
    #[must_use]
    pub const fn phase(&self) -> Phase {
        self.phase
    }

    /// Launch speed relative to the platform, in units of g/omega.
    #[must_use]
    pub const fn relative_speed(&self) -> f64 {
        self.relative_speed
    }
}

/// The first impact after a launch.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedImpact"))]
pub struct Impact {
    /// Whole periods of the duration of the flight.
    pub periods: u64,
    /// The rest of the duration in radians, in [0, 2 pi).
    pub remainder: f64,
    /// How many times the phase passed 0 (mod 2 pi) during the flight: the advance of a period counter.
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
    /// Checks a value that was deserialised; rounding may take the remainder to 2 pi.
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

    /// A copy field by field: reading as a whole a value that was just written in parts causes a stall.
    #[inline(always)]
    pub(crate) const fn in_parts(self) -> Self {
        let Self { periods, remainder, turns, phase, velocity, evaluations } = self;
        Self { periods, remainder, turns, phase: phase.in_parts(), velocity, evaluations }
    }
}

/// Phase and relative speed of a disk about as fast as a platform with P = 2 at its fastest. Such a launch
/// may dip below the platform between separation and crest. If the speed is negative there is no such launch.
#[cfg(test)]
pub(crate) fn launch_that_may_dip(
    vibration: &crate::flight::platform::vibration::Vibration,
    k: u64,
) -> (Phase, f64) {
    let phase = Phase::new(vibration.separation_angle - 2.0 * crate::numerics::testing::golden_spread(k))
        .expect("finite");
    (phase, 1.9 + 0.8 * crate::numerics::testing::golden_spread(7 * k) - vibration.velocity(phase))
}
