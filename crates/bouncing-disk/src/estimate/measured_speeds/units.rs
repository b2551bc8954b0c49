//! The units in which instruments write times and speeds.

use std::f64::consts::TAU;
use std::fmt::{self, Display, Formatter};
use std::str::FromStr;

/// A text is not the name of a unit.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{unit:?} is not a known unit; known units are {legal}")]
pub struct UnknownUnit {
    /// The text.
    pub unit: String,
    /// The legal units.
    pub legal: &'static str,
}

/// The unit of a time.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub enum TimeUnit {
    /// s.
    #[default]
    Second,
    /// ms.
    Millisecond,
    /// Microseconds, us.
    Microsecond,
    /// min.
    Minute,
}

/// The unit of an angular speed.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub enum SpeedUnit {
    /// rad/s.
    #[default]
    RadianPerSecond,
    /// Revolutions per minute, rpm.
    RevolutionPerMinute,
    /// Revolutions per second, rev/s.
    RevolutionPerSecond,
    /// deg/s.
    DegreePerSecond,
}

impl TimeUnit {
    pub(crate) const NAMES: &'static str = "s, ms, us, min";

    /// The unit that a text names.
    pub(crate) fn of(text: &str) -> Option<Self> {
        Some(match text {
            "s" | "sec" | "second" | "seconds" => Self::Second,
            "ms" | "msec" | "millisecond" | "milliseconds" => Self::Millisecond,
            "us" | "\u{b5}s" | "\u{3bc}s" | "microsecond" | "microseconds" => Self::Microsecond,
            "min" | "minute" | "minutes" => Self::Minute,
            _ => return None,
        })
    }

    /// A time in this unit in s.
    #[must_use]
    pub fn to_si(self, time: f64) -> f64 {
        match self {
            Self::Second => time,
            Self::Millisecond => time / 1.0e3,
            Self::Microsecond => time / 1.0e6,
            Self::Minute => time * 60.0,
        }
    }
}

impl SpeedUnit {
    pub(crate) const NAMES: &'static str = "rad/s, rpm, rev/s, deg/s";

    /// The unit that a text names.
    pub(crate) fn of(text: &str) -> Option<Self> {
        Some(match text {
            "rad/s" | "rad_s" | "rad_per_s" | "rad s^-1" => Self::RadianPerSecond,
            "rpm" | "RPM" | "rev/min" | "r/min" | "U/min" | "1/min" | "min^-1" | "min-1" => {
                Self::RevolutionPerMinute
            }
            "rev/s" | "r/s" | "rps" | "1/s" => Self::RevolutionPerSecond,
            "deg/s" | "\u{b0}/s" => Self::DegreePerSecond,
            _ => return None,
        })
    }

    /// A speed in this unit in rad/s.
    #[must_use]
    pub fn to_si(self, speed: f64) -> f64 {
        match self {
            Self::RadianPerSecond => speed,
            Self::RevolutionPerMinute => speed * (TAU / 60.0),
            Self::RevolutionPerSecond => speed * TAU,
            Self::DegreePerSecond => speed * (TAU / 360.0),
        }
    }
}

impl FromStr for TimeUnit {
    type Err = UnknownUnit;

    fn from_str(text: &str) -> Result<Self, UnknownUnit> {
        Self::of(text).ok_or_else(|| UnknownUnit { unit: text.to_owned(), legal: Self::NAMES })
    }
}

impl FromStr for SpeedUnit {
    type Err = UnknownUnit;

    fn from_str(text: &str) -> Result<Self, UnknownUnit> {
        Self::of(text).ok_or_else(|| UnknownUnit { unit: text.to_owned(), legal: Self::NAMES })
    }
}

impl Display for TimeUnit {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Second => "s",
            Self::Millisecond => "ms",
            Self::Microsecond => "us",
            Self::Minute => "min",
        })
    }
}

impl Display for SpeedUnit {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::RadianPerSecond => "rad/s",
            Self::RevolutionPerMinute => "rpm",
            Self::RevolutionPerSecond => "rev/s",
            Self::DegreePerSecond => "deg/s",
        })
    }
}
