//! The cycle of a chattering orbit.

use std::f64::consts::PI;
use std::fmt;

/// A flight is long if it lasts longer than this (rad), half a period of the platform. The short flights of a
/// chattering sequence become ever shorter, so their number depends on how the sequence was truncated rather
/// than on the motion.
pub const LONG_FLIGHT: f64 = PI;

/// A cycle is judged to survive the perturbation if the mean interval from one separation to the next differs from
/// the unperturbed one by at most this fraction. Cycles of more long flights than [`LOCKED_FLIGHTS`]
/// approach the mean by chance.
pub const LOCKED_WITHIN: f64 = 0.05;
/// Largest number of long flights of a cycle to which [`LOCKED_WITHIN`] applies.
pub const LOCKED_FLIGHTS: usize = 8;

/// Impacts searched for an unperturbed cycle; a cycle of up to half of them is found.
pub const EXAMINED_IMPACTS: usize = 2_048;

/// One round of a disk that repeatedly comes to rest on the platform: from one separation to the next.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ChatteringCycle {
    /// Impacts, without those summed by the complete policy.
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
