//! Time as a whole number of periods and a phase, so that long runs lose no precision.

use crate::display::numbers;
use std::cmp::Ordering;
use std::f64::consts::TAU;
use std::fmt::{self, Display, Formatter};

use bouncing_disk_core::Phase;
use bouncing_disk_core::flight::MAX_FLIGHT_DURATION;
use bouncing_disk_core::numerics::elementary::wrapped_angle;

/// An instant: `periods` whole periods of the platform after phase 0 of its first period, and a phase.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct PhaseTime {
    /// Whole periods.
    pub periods: u64,
    /// Phase of the platform.
    pub phase: Phase,
}

impl PhaseTime {
    /// The instant in the first period at `phase`.
    #[must_use]
    pub const fn in_first_period(phase: Phase) -> Self {
        Self { periods: 0, phase }
    }

    /// The instant `span` later, [normalised](PhaseSpan::normalised). The count of periods stops at
    /// `u64::MAX`; from there only the phase advances.
    #[must_use]
    pub fn after(&self, span: PhaseSpan) -> Self {
        let span = span.normalised();
        let sum = self.phase.angle() + span.remainder;
        let (angle, turns) = if sum >= TAU { (sum - TAU, 1) } else { (sum, 0) };
        let periods = self.periods.saturating_add(span.periods).saturating_add(turns);
        Self { periods, phase: phase_at(angle) }
    }

    /// The time from `earlier` to this instant; zero if `earlier` is later.
    #[must_use]
    pub fn since(&self, earlier: &Self) -> PhaseSpan {
        if self.order(earlier) != Ordering::Greater {
            return PhaseSpan::ZERO;
        }
        let ahead = self.phase.angle() - earlier.phase.angle();
        let periods = self.periods - earlier.periods;
        if ahead >= 0.0 {
            PhaseSpan { periods, remainder: ahead }
        } else {
            PhaseSpan { periods: periods - 1, remainder: ahead + TAU }
        }
    }

    /// This instant in periods (rounded: the exact value is `periods` and `phase`).
    #[must_use]
    pub fn cycles(&self) -> f64 {
        self.periods as f64 + self.phase.cycles()
    }

    /// Which of two instants comes first.
    #[must_use]
    pub fn order(&self, other: &Self) -> Ordering {
        self.periods.cmp(&other.periods).then(self.phase.angle().total_cmp(&other.phase.angle()))
    }
}

/// A duration: whole periods and a remainder in radians.
///
/// Every function of a span accepts any span and [normalises](Self::normalised) it.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct PhaseSpan {
    /// Whole periods.
    pub periods: u64,
    /// The remainder in radians, in [0, 2 pi).
    pub remainder: f64,
}

impl PhaseSpan {
    /// The empty span.
    pub const ZERO: Self = Self { periods: 0, remainder: 0.0 };

    /// The longest span: `u64::MAX` whole periods.
    pub const LONGEST: Self = Self { periods: u64::MAX, remainder: 0.0 };

    /// A span of `radians`; a negative number and NaN count as zero, and the maximum is [`Self::LONGEST`],
    /// 1.16e20 rad.
    #[must_use]
    pub fn from_radians(radians: f64) -> Self {
        // As a double this is 2^64 periods: a time that rounds to it is too long as well.
        const TOO_LONG: f64 = TAU * u64::MAX as f64;
        if radians.is_nan() || radians <= 0.0 {
            return Self::ZERO;
        }
        if radians >= TOO_LONG {
            return Self::LONGEST;
        }
        let remainder = wrapped_angle(radians);
        // Round, because the difference is a whole number of periods up to rounding.
        Self { periods: ((radians - remainder) / TAU + 0.5) as u64, remainder }
    }

    /// The same span with its remainder in [0, 2 pi]: whole periods in a larger remainder are moved to the
    /// periods, up to [`Self::LONGEST`]; a negative remainder and NaN count as zero. A normalised span keeps
    /// its bits.
    #[must_use]
    pub fn normalised(self) -> Self {
        if (0.0..=TAU).contains(&self.remainder) {
            return self;
        }
        let rest = Self::from_radians(self.remainder);
        match self.periods.checked_add(rest.periods) {
            Some(periods) => Self { periods, remainder: rest.remainder },
            None => Self::LONGEST,
        }
    }

    /// The span in radians (rounded: the exact value is `periods` and `remainder`).
    #[must_use]
    pub fn radians(&self) -> f64 {
        let Self { periods, remainder } = self.normalised();
        periods as f64 * TAU + remainder
    }
}

/// A time ahead (rad): a negative one and NaN count as zero, and it is limited to the longest flight.
pub(crate) const fn legal_span(span: f64) -> f64 {
    if span > 0.0 { span.min(MAX_FLIGHT_DURATION) } else { 0.0 }
}

/// The phase at a finite angle.
pub(crate) fn phase_at(angle: f64) -> Phase {
    // Only a non-finite angle is an error, and validated parameters cannot produce one.
    Phase::new(angle).unwrap_or_else(|_| unreachable!("angle {angle}"))
}

impl Display for PhaseTime {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "{} periods and {} rad", self.periods, numbers(f)(self.phase.angle()))
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::testing;

    proptest! {
        #[test]
        fn since_undoes_after(
            phase in testing::phase(), start in 0..1_u64 << 50, periods in 0..1_u64 << 50, remainder in 0.0..TAU,
        ) {
            let from = PhaseTime { periods: start, phase };
            let span = PhaseSpan { periods, remainder };
            let back = from.after(span).since(&from);
            let error = (back.periods as f64 - periods as f64) * TAU + (back.remainder - remainder);
            prop_assert!(error.abs() < 4.0 * f64::EPSILON * TAU, "{back:?}");
        }

        #[test]
        fn a_span_keeps_its_radians(radians in 0.0..1e9_f64) {
            let span = PhaseSpan::from_radians(radians);
            prop_assert!((0.0..TAU).contains(&span.remainder));
            prop_assert!((span.radians() - radians).abs() <= 2.0 * f64::EPSILON * radians);
        }
    }

    #[test]
    fn time_does_not_run_back() {
        let early = PhaseTime::in_first_period(phase_at(6.0));
        let late = PhaseTime { periods: 1, phase: phase_at(1.0) };
        assert_eq!(early.since(&late), PhaseSpan::ZERO);
        assert_eq!(late.since(&early).periods, 0);
        assert_eq!(PhaseSpan::from_radians(f64::NAN), PhaseSpan::ZERO);
        assert_eq!(PhaseSpan::from_radians(-1.0), PhaseSpan::ZERO);
    }

    /// The remainder of a span is a public field; NaN in it once caused a panic, and many turns counted as
    /// one.
    #[test]
    fn a_remainder_that_is_none_counts_as_what_it_is() {
        let now = PhaseTime { periods: 7, phase: phase_at(1.0) };
        let later = |remainder: f64| now.after(PhaseSpan { periods: 2, remainder });
        for remainder in [f64::NAN, -1.0, f64::NEG_INFINITY] {
            assert_eq!(later(remainder), PhaseTime { periods: 9, ..now }, "{remainder}");
            assert!((PhaseSpan { periods: 2, remainder }.radians() - 2.0 * TAU).abs() <= 0.0, "{remainder}");
        }
        let three = later(3.0 * TAU + 0.5);
        assert_eq!(three.periods, 12);
        assert!((three.phase.angle() - 1.5).abs() < 1e-14);
        assert!((later(1e20).periods as f64 * TAU / 1e20 - 1.0).abs() < 1e-15);
    }

    #[test]
    fn the_count_of_periods_stops_at_its_end() {
        let last = PhaseTime { periods: u64::MAX, phase: phase_at(6.0) };
        assert_eq!(last.after(PhaseSpan { periods: 0, remainder: 1.0 }).periods, u64::MAX);
        assert_eq!(last.after(PhaseSpan::LONGEST), last);
        for radians in [1.2e20, 1e300, f64::INFINITY] {
            assert_eq!(PhaseSpan::from_radians(radians), PhaseSpan::LONGEST, "{radians}");
        }
        let below = PhaseSpan::from_radians(1.15e20);
        assert!((below.radians() / 1.15e20 - 1.0).abs() < 1e-15);
        assert_eq!(PhaseSpan { periods: u64::MAX, remainder: 7.0 }.normalised(), PhaseSpan::LONGEST);
        assert_eq!(last.since(&PhaseTime::in_first_period(phase_at(6.0))), PhaseSpan::LONGEST);
    }
}
