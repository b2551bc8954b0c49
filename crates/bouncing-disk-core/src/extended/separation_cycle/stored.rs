//! How a cycle is read and printed.

use core::fmt::{Display, Formatter, Result as Written};

use super::{DoublesCycle, SeparationCycle, SeparationOutcome};
use crate::error::{Error, not_negative, within};

/// Checks how many of the impacts doubles follow.
fn check_followed(followed: u64, impacts: u64) -> Result<(), Error> {
    within("impacts in doubles", followed as f64, 0.0, impacts as f64, "at most all impacts")?;
    Ok(())
}

impl SeparationCycle {
    /// Checks what is read.
    pub(super) fn check(&self) -> Result<(), Error> {
        let below = core::f64::consts::TAU.next_down();
        within("phase of rest", self.rest_phase, 0.0, below, "[0, 2 pi) (rad)")?;
        not_negative("lost digits", self.lost_digits)?;
        check_followed(self.impacts_in_doubles, self.impacts)
    }
}

impl SeparationOutcome {
    /// Checks what is read.
    pub(super) fn check(&self) -> Result<(), Error> {
        match *self {
            Self::NoRestWithin { impacts, lost_digits, impacts_in_doubles } => {
                not_negative("lost digits", lost_digits)?;
                check_followed(impacts_in_doubles, impacts)
            }
            Self::UnsureFlight { margin, .. } => not_negative("margin", margin).map(|_| ()),
            Self::Cycle(_) | Self::NeverSeparates | Self::DigitsSpent { .. } | Self::Disagreement { .. } => {
                Ok(())
            }
        }
    }
}

/// `25 impacts in 1055 periods of the platform, 27.1 digits lost; in doubles 25 impacts in 865 periods (6 as
/// they are)`; a precision given applies to the digits.
impl Display for SeparationCycle {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> Written {
        let digits = formatter.precision().unwrap_or(1);
        let Self { impacts, platform_periods, lost_digits, impacts_in_doubles, .. } = self;
        write!(formatter, "{impacts} impacts in {platform_periods} periods of the platform, ")?;
        write!(formatter, "{lost_digits:.digits$} digits lost; ")?;
        match self.in_doubles {
            _ if self.is_that_of_doubles() => formatter.write_str("the same in doubles"),
            Some(own) => write!(formatter, "in doubles {own} ({impacts_in_doubles} as they are)"),
            None => write!(formatter, "none in doubles ({impacts_in_doubles} impacts as they are)"),
        }
    }
}

/// `25 impacts in 865 periods`.
impl Display for DoublesCycle {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> Written {
        write!(formatter, "{} impacts in {} periods", self.impacts, self.platform_periods)
    }
}

/// The cycle, or why there is none.
impl Display for SeparationOutcome {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> Written {
        match *self {
            Self::Cycle(ref cycle) => Display::fmt(cycle, formatter),
            Self::NeverSeparates => formatter.write_str("the platform never falls away"),
            Self::NoRestWithin { impacts, lost_digits, .. } => {
                write!(formatter, "no rest within {impacts} impacts, {lost_digits:.1} digits lost")
            }
            Self::DigitsSpent { impacts, digits } => {
                write!(formatter, "{digits} digits are spent after {impacts} impacts")
            }
            Self::UnsureFlight { impacts, margin } => {
                write!(formatter, "the flight after {impacts} impacts passes the platform by {margin:e}")
            }
            Self::Disagreement { impacts, digits } => {
                write!(formatter, "a cycle of {impacts} impacts in {digits} digits is none in more")
            }
        }
    }
}
