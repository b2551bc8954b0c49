//! Verdicts in words.

use super::{RestCycle, UndecidedReason, Verdict};

/// `2 impacts in 2 periods of the platform, multipliers ...`, `chaos, exponent 0.41 +- 0.01`, and so on; a
/// given precision applies to the numbers.
impl core::fmt::Display for Verdict {
    fn fmt(&self, formatter: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let digits = formatter.precision().unwrap_or(4);
        match *self {
            Self::Periodic { impacts, platform_periods, multipliers, .. } => {
                let (impacts, periods) = (counted(impacts, "impact"), counted(platform_periods, "period"));
                write!(formatter, "{impacts} in {periods} of the platform, ")?;
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

/// `1 impact`, `2 impacts`.
fn counted(count: u64, thing: &str) -> String {
    format!("{count} {thing}{}", if count == 1 { "" } else { "s" })
}

impl core::fmt::Display for RestCycle {
    fn fmt(&self, formatter: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let Self { impacts, platform_periods, long_flights, .. } = self;
        let (impacts, long) = (counted(*impacts, "impact"), counted(*long_flights, "long flight"));
        let periods = counted(*platform_periods, "period");
        write!(formatter, "rest after {impacts} and {long}, every {periods} of the platform")?;
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
            Self::OnPeriodicOrbit { impacts, platform_periods, multipliers, multiplier_error, .. } => {
                let neutral = multipliers.spectral_radius() - multiplier_error <= 1.0;
                let kind = if neutral { "a neutral" } else { "a repelling" };
                let (impacts, periods) =
                    (counted(impacts, "impact"), counted(platform_periods, "platform period"));
                write!(formatter, "at {kind} orbit of {impacts} in {periods}, ")?;
                write!(formatter, "multipliers {multipliers:.digits$} +- {multiplier_error:.0e}")
            }
            Self::TransientMayLast { exponent, standard_error, needed } => {
                write!(formatter, "exponent {exponent:.digits$} +- {standard_error:.digits$}, ")?;
                write!(formatter, "a transient may last {needed:.0} impacts")
            }
            Self::RestNotProven { phase, .. } => {
                write!(formatter, "rests at {:.digits$} rad, perhaps not for ever", phase.angle())
            }
            Self::Grazing { impacts, phase } => {
                write!(formatter, "impact {impacts} grazes at {:.digits$} rad", phase.angle())
            }
        }
    }
}
