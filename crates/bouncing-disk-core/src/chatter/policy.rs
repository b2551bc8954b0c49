//! The two ways to end a chatter: its sum, and a cut.

use core::f64::consts::{PI, TAU};

use crate::numerics::error::Error;
use crate::numerics::stored::read_checked;

/// Largest error of the end of a chatter on a drive (rad) that [`ChatterPolicy::Complete`] accepts.
const COMPLETION_ERROR: f64 = 1.0e-14;

/// Launch speed (g/omega) below which a disk on a drive that pulls it attaches even if no bound proves that
/// its chatter ends.
const SMALLEST_SPEED: f64 = 1.0e-18;

/// The treatment of the infinite sequence of impacts of a chattering disk.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum ChatterPolicy {
    /// The sequence is summed in closed form and the disk attaches at the accumulation point, provided that a
    /// bound proves a pull towards the platform up to this point.
    #[default]
    Complete,
    /// The disk attaches as soon as a rule applies, as in all simulations impact by impact, including the
    /// paper's (Sec. IV A).
    Cut(ChatterCut),
}

/// The duration of a chatter, from a launch to the rest.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ChatterDuration {
    /// The duration in radians, from the Taylor series of the acceleration at the launch.
    pub duration: f64,
    /// Bound on its error.
    pub error: f64,
}

/// A platform on which a disk may chatter.
#[doc(hidden)]
pub trait Surface {
    /// Whether a disk that rests on the platform at `time` stays there.
    fn holds(&self, time: f64) -> bool;

    /// The time from a launch at `time` with relative `speed` to the rest after infinitely many impacts, if
    /// it is proven.
    fn chatter_duration(&self, time: f64, speed: f64, restitution: f64) -> Option<ChatterDuration>;
}

/// The motion of a disk after an impact on any platform.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum AfterImpact {
    /// It leaves the platform with this relative speed, in units of g/omega: zero if a cut has removed the
    /// rebound of a disk that the platform then leaves behind.
    Launch(f64),
    /// It chatters, and rests after this time.
    Chatter(ChatterDuration),
    /// It rests at once. The error is infinite if a rebound was cut off: no bound proves that the disk stays.
    Rest {
        /// Bound on the error of the time (rad).
        error: f64,
    },
}

impl ChatterPolicy {
    /// The motion after an impact on `surface` at `time` with this relative velocity <= 0, at the end of a
    /// flight of this duration (rad; infinite if it does not count as a flight).
    pub fn after_impact(
        &self,
        (surface, restitution): (&impl Surface, f64),
        (time, velocity): (f64, f64),
        flight: f64,
        short_flights: &mut ShortFlightCount,
    ) -> AfterImpact {
        let speed = -restitution * velocity;
        let holds = surface.holds(time);
        let rest = AfterImpact::Rest { error: if speed > 0.0 { f64::INFINITY } else { 0.0 } };
        match self {
            Self::Cut(cut) => match short_flights.attaches(cut, flight, -velocity) || speed == 0.0 {
                false => AfterImpact::Launch(speed),
                true if holds => rest,
                true => AfterImpact::Launch(0.0),
            },
            Self::Complete => {
                let chatter = surface.chatter_duration(time, speed, restitution);
                match chatter.filter(|chatter| chatter.error <= COMPLETION_ERROR) {
                    Some(chatter) => AfterImpact::Chatter(chatter),
                    None if speed <= SMALLEST_SPEED && holds => rest,
                    None => AfterImpact::Launch(speed),
                }
            }
        }
    }
}

/// The rule by which a disk that is followed impact by impact attaches: as soon as an impact is slower than a
/// smallest speed, or after a number of consecutive short flights.
///
/// A cut that never applies leaves a chattering disk bouncing until its speed underflows.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedCut"))]
pub struct ChatterCut {
    smallest_speed: f64,
    short_flight: f64,
    short_flights: u32,
}

read_checked!(ChatterCut as UncheckedCut {
    smallest_speed: f64,
    short_flight: f64,
    short_flights: u32,
} => ChatterCut::new);

const fn out_of_range(field: &'static str, value: f64, legal: &'static str) -> Result<ChatterCut, Error> {
    Err(Error::OutOfRange { field, value, legal })
}

impl ChatterCut {
    /// The cut below the normalised impact speed `smallest_speed` = |w_A Gamma/(omega A)| >= 0, or after
    /// `short_flights` >= 1 consecutive flights shorter than `short_flight` >= 0 periods of the platform.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a number outside its range.
    pub const fn new(smallest_speed: f64, short_flight: f64, short_flights: u32) -> Result<Self, Error> {
        if !(smallest_speed >= 0.0 && smallest_speed <= f64::MAX) {
            return out_of_range("smallest_speed", smallest_speed, "[0, inf), as |w|/pi");
        }
        if !(short_flight >= 0.0 && short_flight <= f64::MAX) {
            return out_of_range("short_flight", short_flight, "[0, inf) periods");
        }
        if short_flights == 0 {
            return out_of_range("short_flights", 0.0, "[1, 4294967295]");
        }
        Ok(Self { smallest_speed, short_flight, short_flights })
    }

    /// The normalised impact speed |w_A Gamma/(omega A)| below which the disk attaches.
    #[must_use]
    pub const fn smallest_speed(&self) -> f64 {
        self.smallest_speed
    }

    /// The duration, in periods, below which a flight is short.
    #[must_use]
    pub const fn short_flight(&self) -> f64 {
        self.short_flight
    }

    /// The number of consecutive short flights after which the disk attaches.
    #[must_use]
    pub const fn short_flights(&self) -> u32 {
        self.short_flights
    }

    /// Whether a flight of this duration (rad), taken from two phases and a count of periods, is so close to
    /// the limit for short flights that its rounding may decide. The rounding is so small that a flight is
    /// almost never recomputed.
    #[inline(always)]
    pub(crate) fn may_hang_on(&self, duration: f64) -> bool {
        let threshold = self.short_flight * TAU;
        (duration - threshold).abs() < 1.0e-12 * (1.0 + threshold)
    }
}

/// The number of consecutive short flights of an orbit, which a cut must remember.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct ShortFlightCount(u32);

impl ShortFlightCount {
    /// No short flight yet.
    pub const fn new() -> Self {
        Self(0)
    }

    /// Whether the disk attaches after a flight of this duration (rad) and an impact at this speed.
    #[inline]
    pub(crate) fn attaches(&mut self, cut: &ChatterCut, duration: f64, impact_speed: f64) -> bool {
        self.0 = if duration < cut.short_flight * TAU { self.0 + 1 } else { 0 };
        let attaches = impact_speed < cut.smallest_speed * PI || self.0 >= cut.short_flights;
        if attaches {
            self.0 = 0;
        }
        attaches
    }
}

/// The paper's cut (Sec. IV A).
#[cfg(test)]
pub(crate) const PAPER_CUT: ChatterCut = match ChatterCut::new(1.0e-6, 1.0e-4, 20) {
    Ok(cut) => cut,
    Err(_) => panic!("legal"),
};

/// [`PAPER_CUT`] as a policy.
#[cfg(test)]
pub(crate) const PAPER_POLICY: ChatterPolicy = ChatterPolicy::Cut(PAPER_CUT);

#[cfg(test)]
mod tests {
    use super::*;

    /// The paper's cut (Sec. IV A): the twentieth consecutive flight *shorter* than 1e-4 periods, or a speed
    /// *below* 1e-6.
    #[test]
    fn the_cut_of_the_paper_is_where_the_paper_says() {
        let (short, fast) = (1e-4 * TAU, 1e-6 * PI);
        let below = |x: f64| f64::from_bits(x.to_bits() - 1);
        let mut count = ShortFlightCount::new();
        assert!(!count.attaches(&PAPER_CUT, 1.0, fast) && count.attaches(&PAPER_CUT, 1.0, below(fast)));
        // After any other flight the count of twenty restarts.
        for _ in 0..2 {
            assert!((1..20).all(|_| !count.attaches(&PAPER_CUT, below(short), 1.0)));
            assert!(count.attaches(&PAPER_CUT, below(short), 1.0), "the twentieth");
        }
        assert!((1..20).all(|_| !count.attaches(&PAPER_CUT, below(short), 1.0)));
        assert!(!count.attaches(&PAPER_CUT, short, 1.0), "not shorter");
        assert!((1..20).all(|_| !count.attaches(&PAPER_CUT, below(short), 1.0)));
        assert!(count.attaches(&PAPER_CUT, 1.0, 0.0), "too slow");
        assert!(
            (1..20).all(|_| !count.attaches(&PAPER_CUT, below(short), 1.0)),
            "the cut starts the count again"
        );
    }

    #[cfg(feature = "serde")]
    #[test]
    fn a_cut_that_is_read_is_legal() {
        let text = serde_json::to_string(&PAPER_CUT).expect("serialisable");
        assert_eq!(serde_json::from_str::<ChatterCut>(&text).expect("legal"), PAPER_CUT);
        for text in [
            r#"{"smallest_speed":-1.0,"short_flight":0.0,"short_flights":1}"#,
            r#"{"smallest_speed":0.0,"short_flight":0.0,"short_flights":0}"#,
        ] {
            let refusal = serde_json::from_str::<ChatterCut>(text).expect_err("out of range").to_string();
            assert!(refusal.contains("outside its legal range"), "{refusal}");
        }
    }
}
