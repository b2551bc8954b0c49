//! Verdicts in words.

use super::{RestCycle, UndecidedReason, Verdict};

/// `2 impacts in 2 periods of the platform, multipliers ...`, `chaos, exponent 0.41 +- 0.01`, and so on; a
/// precision given applies to the numbers.
impl core::fmt::Display for Verdict {
    fn fmt(&self, formatter: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let digits = formatter.precision().unwrap_or(4);
        match *self {
            Self::Periodic { impacts, platform_periods, multipliers, .. } => {
                write!(formatter, "{impacts} impacts in {platform_periods} periods of the platform, ")?;
                write!(formatter, "multipliers {multipliers:.digits$}")
            }
            Self::Chaotic { exponent, standard_error, .. } => {
                write!(formatter, "chaos, exponent {exponent:.digits$} +- {standard_error:.digits$}")
            }
            Self::Chattering { cycle, .. } => core::fmt::Display::fmt(&cycle, formatter),
            Self::AtRest { phase, .. } => write!(formatter, "at rest from {:.digits$} rad on", phase.angle()),
            Self::Undecided { reason, .. } => write!(formatter, "undecided: {reason:.digits$}"),
        }
    }
}

impl core::fmt::Display for RestCycle {
    fn fmt(&self, formatter: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let Self { impacts, platform_periods, long_flights, .. } = self;
        write!(formatter, "rest after {impacts} impacts, {long_flights} of them behind long flights, ")?;
        write!(formatter, "every {platform_periods} periods of the platform")?;
        if self.is_exact() { Ok(()) } else { formatter.write_str(" (chosen by rounding)") }
    }
}

impl core::fmt::Display for UndecidedReason {
    fn fmt(&self, formatter: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let digits = formatter.precision().unwrap_or(4);
        match *self {
            Self::ExponentNearZero { exponent, standard_error } => {
                write!(formatter, "exponent {exponent:.digits$} +- {standard_error:.digits$} near zero")
            }
            Self::NoPeriodFound { exponent, standard_error } => {
                write!(
                    formatter,
                    "exponent {exponent:.digits$} +- {standard_error:.digits$}, no period found"
                )
            }
            Self::Grazing { impacts, phase } => {
                write!(formatter, "impact {impacts} grazes at {:.digits$} rad", phase.angle())
            }
        }
    }
}
