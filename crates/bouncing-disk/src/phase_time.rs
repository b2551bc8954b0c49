//! Time as a whole number of periods and a phase, so that long runs lose no precision.

use std::cmp::Ordering;
use std::f64::consts::TAU;

use bouncing_disk_core::Phase;
use bouncing_disk_core::elementary::wrapped_angle;
use serde::Serialize;

/// An instant: `periods` whole periods of the platform after phase 0 of its first period, and a phase.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
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

    /// The instant `span` later.
    #[must_use]
    pub fn after(&self, span: PhaseSpan) -> Self {
        let sum = self.phase.angle() + span.remainder;
        let (angle, turns) = if sum >= TAU { (sum - TAU, 1) } else { (sum, 0) };
        Self { periods: self.periods + span.periods + turns, phase: phase_at(angle) }
    }

    /// The time from `earlier` to this instant; zero if `earlier` is not earlier.
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

    /// This instant as a number of periods (rounded: the exact value is `periods` and `phase`).
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
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct PhaseSpan {
    /// Whole periods.
    pub periods: u64,
    /// The rest in radians, in [0, 2 pi).
    pub remainder: f64,
}

impl PhaseSpan {
    /// No time at all.
    pub const ZERO: Self = Self { periods: 0, remainder: 0.0 };

    /// A span of `radians`; a negative or non-finite number counts as zero.
    #[must_use]
    pub fn from_radians(radians: f64) -> Self {
        if !(radians > 0.0 && radians.is_finite()) {
            return Self::ZERO;
        }
        let remainder = wrapped_angle(radians);
        // Round: the difference is a whole number of periods up to rounding.
        Self { periods: ((radians - remainder) / TAU + 0.5) as u64, remainder }
    }

    /// The span in radians (rounded: the exact value is `periods` and `remainder`).
    #[must_use]
    pub fn radians(&self) -> f64 {
        self.periods as f64 * TAU + self.remainder
    }
}

/// The phase at a finite angle.
pub(crate) fn phase_at(angle: f64) -> Phase {
    // Only a non-finite angle is refused, and none can arise from validated parameters.
    Phase::new(angle).unwrap_or_else(|_| unreachable!("angle {angle}"))
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
}
