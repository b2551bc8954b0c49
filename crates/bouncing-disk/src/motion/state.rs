//! The state of the disk and of the platform at an instant.

use bouncing_disk_core::Phase;
use std::fmt::{self, Display, Formatter};

use crate::motion::phase_time::PhaseTime;
use crate::parameters::dimensionless::DimensionlessSystem;

/// The direction in which the disk slides on the platform.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum SlipDirection {
    /// The disk turns faster than the platform.
    Forward,
    /// The disk turns slower than the platform.
    Backward,
}

impl SlipDirection {
    /// +1 for forward, -1 for backward: the sign of disk minus platform.
    #[must_use]
    pub const fn sign(self) -> f64 {
        match self {
            Self::Forward => 1.0,
            Self::Backward => -1.0,
        }
    }

    /// The other direction.
    #[must_use]
    pub const fn reversed(self) -> Self {
        match self {
            Self::Forward => Self::Backward,
            Self::Backward => Self::Forward,
        }
    }

    /// The direction of an angular speed relative to the platform; `None` for zero.
    pub(crate) fn of(relative_speed: f64) -> Option<Self> {
        if relative_speed > 0.0 {
            Some(Self::Forward)
        } else if relative_speed < 0.0 {
            Some(Self::Backward)
        } else {
            None
        }
    }
}

/// The mode of motion of the disk between two events.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Mode {
    /// Free of the platform.
    Flight,
    /// On the platform and turning with it.
    Sticking,
    /// On the platform and turning faster or slower than it.
    Sliding(SlipDirection),
}

/// The disk's state, dimensionless (see [`crate::parameters::Scales`] for the units).
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct DiskState {
    /// The mode of motion.
    pub mode: Mode,
    /// Height above the platform's mean height, in units of g/omega^2.
    pub height: f64,
    /// Axial velocity, in units of g/omega.
    pub axial_velocity: f64,
    /// Angle turned, in units of g a_e/(a_g omega)^2. It is not wrapped. It starts at the platform's own
    /// angle, so marks on disk and platform coincide at the start. The engine sums it in two doubles, so that
    /// its error does not grow with the number of events.
    pub angle: f64,
    /// Angular speed, in units of g a_e/(a_g^2 omega).
    pub angular_speed: f64,
}

impl DiskState {
    /// A disk in flight with angle zero.
    pub(crate) const fn flying(height: f64, axial_velocity: f64, angular_speed: f64) -> Self {
        Self { mode: Mode::Flight, height, axial_velocity, angle: 0.0, angular_speed }
    }
}

/// The platform's state, dimensionless.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct PlatformState {
    /// Height, in units of g/omega^2.
    pub height: f64,
    /// Axial velocity, in units of g/omega.
    pub axial_velocity: f64,
    /// Angle, in units of g a_e/(a_g omega)^2.
    pub angle: f64,
    /// Angular speed, in units of g a_e/(a_g^2 omega).
    pub angular_speed: f64,
}

impl PlatformState {
    /// The platform at `phase`.
    #[must_use]
    pub fn at(system: &DimensionlessSystem, phase: Phase) -> Self {
        Self {
            height: system.vibration().height(phase),
            axial_velocity: system.vibration().velocity(phase),
            angle: system.platform_angle(phase),
            angular_speed: system.platform_angular_speed(phase),
        }
    }
}

/// Disk and platform at an instant.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Snapshot {
    /// The instant.
    pub time: PhaseTime,
    /// The disk.
    pub disk: DiskState,
    /// The platform.
    pub platform: PlatformState,
}

/// A sum kept in two doubles (Knuth's exact addition).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct LongSum {
    high: f64,
    low: f64,
}

impl LongSum {
    pub(crate) const fn new(value: f64) -> Self {
        Self { high: value, low: 0.0 }
    }

    pub(crate) fn add(&mut self, term: f64) {
        let sum = self.high + term;
        let virtual_term = sum - self.high;
        let lost = (self.high - (sum - virtual_term)) + (term - virtual_term);
        self.high = sum;
        self.low += lost;
    }

    /// The sum in another unit.
    pub(crate) fn scale(&mut self, factor: f64) {
        (self.high, self.low) = (self.high * factor, self.low * factor);
    }

    pub(crate) fn value(&self) -> f64 {
        self.high + self.low
    }
}

impl Display for SlipDirection {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Forward => "forward",
            Self::Backward => "backward",
        })
    }
}

impl Display for Mode {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Sliding(SlipDirection::Forward) => f.pad("sliding forward"),
            Self::Sliding(SlipDirection::Backward) => f.pad("sliding backward"),
            Self::Flight | Self::Sticking => self.kind().fmt(f),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_sum_keeps_what_one_double_loses() {
        let mut sum = LongSum::new(1.0e16);
        for _ in 0..1000 {
            sum.add(0.5);
        }
        sum.add(-1.0e16);
        assert!((sum.value() - 500.0).abs() < 1e-9);
    }
}
