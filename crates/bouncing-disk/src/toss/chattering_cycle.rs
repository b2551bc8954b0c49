//! The cycle of a chattering orbit.

use std::f64::consts::PI;
use std::fmt;

/// A flight is long if it lasts longer than this (rad): half a period of the platform. The short ones of a
/// chattering sequence get shorter without end, so that their number depends on how the sequence was cut
/// rather than on the motion.
pub const LONG_FLIGHT: f64 = PI;

/// The mean time between separations agrees with the unperturbed cycle to this share: the cycle survives the
/// perturbation. Longer cycles than those of [`LOCKED_FLIGHTS`] come near the mean by chance.
pub const LOCKED_WITHIN: f64 = 0.05;
/// See [`LOCKED_WITHIN`].
pub const LOCKED_FLIGHTS: usize = 8;

/// Impacts in which to look for an unperturbed cycle; a cycle of up to half of them is found.
pub const EXAMINED_IMPACTS: usize = 2_048;

/// One round of a disk that comes to rest on the platform again and again: from one separation to the next.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ChatteringCycle {
    /// Impacts, without those that the complete policy sums.
    pub impacts: usize,
    /// Periods of the platform.
    pub platform_periods: u64,
    /// Flights longer than [`LONG_FLIGHT`].
    pub long_flights: usize,
}

impl ChatteringCycle {
    /// Whether the disk is thrown, chatters and rests within each period of the platform: a chain of single
    /// tosses.
    #[must_use]
    pub const fn is_single_toss(&self) -> bool {
        self.platform_periods == 1
    }
}

impl fmt::Display for ChatteringCycle {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { impacts, platform_periods, long_flights } = *self;
        let of = |count: u64, one: &str| format!("{count} {one}{}", if count == 1 { "" } else { "s" });
        let (flights, impacts) = (of(long_flights as u64, "long flight"), of(impacts as u64, "impact"));
        write!(f, "{flights}, {impacts}, {}", of(platform_periods, "period"))
    }
}
