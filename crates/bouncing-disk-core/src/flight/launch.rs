//! A launch of the disk from the platform.

use crate::flight::platform::phase::Phase;
use crate::numerics::error::Error;
use crate::read_checked;

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
    /// Speed zero means "from rest on the platform": where the platform falls away, P sin tau >= 1, the disk
    /// separates; elsewhere the flight is refused ([`Error::NoLiftOff`]), since a launch knows no platform.
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
    pub(crate) const fn known(phase: Phase, relative_speed: f64) -> Self {
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
