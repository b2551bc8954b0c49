//! Chattering: infinitely many impacts in a finite time, and the two ways to end it.
//!
//! The summed duration of such a sequence is [`Accumulation`]; the other sums over its impacts (rotary
//! impulses, losses) are in `impact_series.rs`, and the model uses both in its `motion/chatter.rs`.
//!
//! Near an impact at phase tau with a = 1 - P sin tau > 0 the disk is pulled back with acceleration a and the
//! flights form a near-geometric sequence with ratio `restitution`. Let b = P cos tau, so that da/dtau = -b,
//! db/dtau = a - 1. The time T to the accumulation point is a power series in the launch speed w. It
//! satisfies T(tau, w) = h + T(tau + h, restitution * u), with the first flight h and its impact speed u. Its
//! coefficients and the bound on their error are in `expansion.rs`, their derivation in
//! docs/numerics-impacts.md.

use core::f64::consts::TAU;

use super::expansion::{Expansion, LAST_SHARE, MAJORANT};
use super::impact_series::ChatterSeries;
use crate::flight::platform::phase::Phase;
use crate::flight::platform::vibration::Vibration;
use crate::numerics::elementary::{CREST, sin_cos_bounded};
use crate::numerics::error::{Error, not_negative, within};
use crate::numerics::stored::read_checked;

/// Largest error of the accumulation phase (rad) that the complete policy accepts: half the spacing of
/// doubles in [pi/2, pi].
const COMPLETION_ERROR: f64 = 1.0e-16;

/// Speed below which a chatter may end within a rounding of the phase, without a series.
const LARGEST_NEGLIGIBLE_SPEED: f64 = 1.0e-30;

/// Largest remaining chatter (rad) that is summed in closed form. This limit keeps visible bounces visible.
const LONGEST_COMPLETION: f64 = 1.0e-2;

/// Bounds on the pull in a summed chatter, as shares of its first value: 2/3 and 4/3, widened for rounding.
const PULL_SHARES: (f64, f64) = (0.6, 1.4);

/// Generous bound on the relative rounding of the bound in [`window_holds_every_impact`].
const WINDOW_ROUNDING: f64 = 1.0e-14;

/// The accumulation point of a chattering sequence.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedAccumulation"))]
pub struct Accumulation {
    /// Time from the last impact to the accumulation point, in radians.
    pub duration: f64,
    /// Bound on the error of `duration` due to truncating the series, in radians.
    pub error_bound: f64,
    /// The accumulation phase.
    pub phase: Phase,
    /// 1 if the phase passed 0 (mod 2 pi) on the way, otherwise 0.
    pub turns: u64,
}

read_checked!(Accumulation as UncheckedAccumulation {
    duration: f64,
    #[serde(deserialize_with = "crate::numerics::stored::infinite_if_none")]
    error_bound: f64,
    phase: Phase,
    turns: u64,
});

impl Accumulation {
    /// Checks a value that was deserialised. The bound may be infinite: there is none for the bounces omitted
    /// by a cut.
    fn check(&self) -> Result<(), Error> {
        not_negative("duration", self.duration)?;
        within("error_bound", self.error_bound, 0.0, f64::INFINITY, "[0, inf] (rad)")?;
        within("turns", self.turns as f64, 0.0, 1.0, "0 or 1")?;
        Ok(())
    }
}

/// One impact of a chattering sequence, from the expansion.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ChatterImpact {
    /// Time since the impact from which the sequence started, in radians.
    pub time: f64,
    /// Impact speed |w_A| in units of g/omega.
    pub speed: f64,
    /// Phase pair (sin, cos) at this impact.
    pub pair: (f64, f64),
}

impl Vibration {
    /// The accumulation point of the chatter that follows a launch at `phase` with `speed` >= 0. `None`
    /// unless a bound shows that the disk chatters to rest and that the closed form is exact to 1e-16 rad,
    /// for the pull 1 - P sin tau computed from P and the carried pair. Near weightlessness one rounding of P
    /// or of the phase changes the pull and the duration; this conditioning of the problem is not part of the
    /// bound.
    ///
    /// The accumulation point lies before the next separation. A chatter too short to change the phase has
    /// the duration 0.
    ///
    /// `restitution` in [0, 1).
    #[must_use]
    #[inline]
    pub(crate) fn accumulation(&self, phase: Phase, speed: f64, restitution: f64) -> Option<Accumulation> {
        if self.bounces_on(phase, speed, restitution) {
            return None;
        }
        let reach = self.contact_force(phase) * (1.0 - restitution);
        // A pull <= 0 and NaN also fail here.
        let small = speed > 0.0 && speed <= 0.5 * LONGEST_COMPLETION * reach;
        if !small || self.falls_away_at(phase.angle()) {
            return self.at_rest(phase, speed, restitution);
        }
        self.accumulation_of_small(phase, speed, restitution, speed / reach)
    }

    /// Whether a launch is too fast for [`Self::accumulation`] to exist: a cheap test for ordinary impacts.
    #[inline(always)]
    pub(crate) fn bounces_on(&self, phase: Phase, speed: f64, restitution: f64) -> bool {
        bounces_on(self.contact_force(phase), speed, restitution)
    }

    /// [`Self::accumulation`] for an expansion parameter `x` small enough to try.
    fn accumulation_of_small(
        &self,
        phase: Phase,
        speed: f64,
        restitution: f64,
        x: f64,
    ) -> Option<Accumulation> {
        let expansion =
            Expansion { pull: self.contact_force(phase), drift: self.velocity(phase), restitution };
        let error_bound = expansion.error_bound(x)?;
        if error_bound > COMPLETION_ERROR || !self.pulls_back_throughout(phase, speed, restitution, 2.0 * x) {
            return None;
        }
        let duration = expansion.duration(speed);
        let (angle, turns) = wrapped(phase.angle() + duration);
        if self.peak_acceleration() > 1.0
            && (duration >= self.time_to_separation(phase.angle()) || self.falls_away_at(angle))
        {
            return self.rests_until_separation(phase, speed);
        }
        Some(Accumulation { duration, error_bound, phase: Phase::of_angle(angle), turns })
    }

    /// A chatter whose sum ends at the separation or beyond, because the pull used in the proof is pure
    /// rounding error. The disk rests if its next flight, of 2 w/(1 - P sin tau) <= 2e-16 rad, is too short
    /// to change the phase; otherwise it continues to bounce.
    #[cold]
    fn rests_until_separation(&self, phase: Phase, speed: f64) -> Option<Accumulation> {
        (speed <= COMPLETION_ERROR * self.contact_force(phase)).then_some(Accumulation {
            duration: 0.0,
            error_bound: COMPLETION_ERROR,
            phase,
            turns: 0,
        })
    }

    /// A disk without relative speed rests at once, unless the platform falls away; so does a disk whose
    /// chatter ends before the phase has moved by a rounding.
    #[inline]
    fn at_rest(&self, phase: Phase, speed: f64, restitution: f64) -> Option<Accumulation> {
        let rests = speed <= 0.0
            || (speed <= LARGEST_NEGLIGIBLE_SPEED && self.ends_within_a_rounding(phase, speed, restitution));
        (rests && !self.falls_away_at(phase.angle())).then_some(Accumulation {
            duration: 0.0,
            error_bound: if speed > 0.0 { COMPLETION_ERROR } else { 0.0 },
            phase,
            turns: 0,
        })
    }

    /// Whether a chatter against a growing pull lasts at most [`COMPLETION_ERROR`]: without this test a disk
    /// could hop forever if the pull is rounding error and its flights are too short to change the phase
    /// (docs/numerics-impacts.md, "No time left").
    #[cold]
    fn ends_within_a_rounding(&self, phase: Phase, speed: f64, restitution: f64) -> bool {
        let (peak, angle) = (self.peak_acceleration(), phase.angle());
        let left = COMPLETION_ERROR * (1.0 - restitution);
        // 1 - P sin tau from the distances to the phases where it vanishes, or to the crest: without
        // cancellation.
        let sine_of_half = |angle: f64| sin_cos_bounded(0.5 * angle).0;
        let pull = if peak > 1.0 {
            2.0 * peak
                * sine_of_half(angle - self.separation_angle)
                * sine_of_half(angle - self.retention_angle)
        } else {
            let half = sine_of_half(angle - CREST);
            (1.0 - peak) + 2.0 * peak * (half * half)
        };
        phase.cos() <= 0.0
            && (2.0 * speed <= left * pull
                || 17.0 * speed <= (left * left) * -self.velocity(phase)
                || 24.0 * speed <= (left * left) * (left * peak))
    }

    /// Proof that all impacts fall within 3/2 of the leading estimate: over that window the pull lies in
    /// [least, most] > 0, so a flight lasts at most 2 w / least and returns at most sqrt(most/least) w.
    fn pulls_back_throughout(&self, phase: Phase, speed: f64, restitution: f64, leading: f64) -> bool {
        window_holds_all(
            self.peak_acceleration(),
            self.contact_force(phase),
            self.velocity(phase),
            speed,
            restitution,
            leading,
        )
    }

    /// The impacts of the chatter after a launch at `phase` with `speed`, for a sequence that
    /// [`Self::accumulation`] accepts with a duration above 0. They end when an impact carries less than
    /// 1e-17 of the first one's impulse, or if its launch speed is below the smallest normal number.
    ///
    /// The iterator computes them one by one, and there are 39/(1 - r) of them: near r = 1 this may take
    /// forever. [`Self::chatter_series`] computes any of them and their sums at once.
    pub(crate) fn chatter_impacts(
        &self,
        phase: Phase,
        speed: f64,
        restitution: f64,
    ) -> impl Iterator<Item = ChatterImpact> + use<> {
        let vibration = *self;
        // Rounding to the nearest multiple of the smallest number would never reduce a launch close to it.
        let last_speed = (speed * LAST_SHARE).max(f64::MIN_POSITIVE);
        let mut time = 0.0;
        let mut pair = (phase.sin(), phase.cos());
        let mut launch = speed;
        // The proof of the window keeps the pull within a third of the first one; near a separation the pull
        // of a rounded pair may differ, or be zero.
        let first = self.contact_force(phase);
        let (least, most) = (PULL_SHARES.0 * first, PULL_SHARES.1 * first);
        core::iter::from_fn(move || {
            // NaN ends the sequence as well; without a pull no disk bounces.
            if !(launch > last_speed && first > 0.0) {
                return None;
            }
            let peak = vibration.peak_acceleration();
            let pull = (1.0 - peak * pair.0).max(least).min(most);
            let expansion = Expansion { pull, drift: peak * pair.1, restitution };
            let (flight, impact_speed) = expansion.flight(launch);
            time += flight;
            pair = sin_cos_bounded(phase.angle() + time);
            launch = restitution * impact_speed;
            Some(ChatterImpact { time, speed: impact_speed, pair })
        })
    }
}

/// [`Vibration::bounces_on`], given the pull.
#[inline(always)]
pub(crate) fn bounces_on(pull: f64, speed: f64, restitution: f64) -> bool {
    (speed > LARGEST_NEGLIGIBLE_SPEED) & (speed > 0.5 * LONGEST_COMPLETION * (pull * (1.0 - restitution)))
}

/// A cheap test that is true only if [`Vibration::accumulation`] is `None` for a launch with `speed` against
/// `pull`.
///
/// Beyond [`bounces_on`], it also recognises most chatters whose series is still too inaccurate: with x as in
/// [`Expansion::error_bound`], this bound is at least [`MAJORANT`] (P/pull) x^5, because |P sin| + |P cos| >=
/// P.
#[inline(always)]
pub(crate) fn surely_bounces_on(peak: f64, pull: f64, speed: f64, restitution: f64) -> bool {
    let reach = pull * (1.0 - restitution);
    let (speed2, reach2) = (speed * speed, reach * reach);
    let least = (MAJORANT * peak * speed) * (speed2 * speed2);
    // Above the bound by far more than the rounding of both.
    let inaccurate = least > (1.000_001 * COMPLETION_ERROR) * (pull * reach) * (reach2 * reach2);
    bounces_on(pull, speed, restitution) | (inaccurate & (speed > LARGEST_NEGLIGIBLE_SPEED))
}

/// Whether the impacts after a launch with `speed` against `pull` and its `drift` all fall within 3/2 of
/// `leading`.
#[inline(always)]
fn window_holds_all(peak: f64, pull: f64, drift: f64, speed: f64, restitution: f64, leading: f64) -> bool {
    let window = 1.5 * leading;
    let change = (drift.abs() + peak * window) * window;
    if ChatterSeries::is_needed(speed, restitution) {
        return window_holds_every_impact(pull, change, restitution);
    }
    let (least, most) = (pull - change, pull + change);
    let ratio = restitution * (most / least).sqrt();
    (least > 0.0) & (ratio < 1.0) & (2.0 * speed <= window * least * (1.0 - ratio))
}

/// [`window_holds_all`] if `1 - ratio` would cancel or the speed has lost digits. With the window 3 w/(a (1 - r))
/// the condition 2 w <= window least (1 - ratio) does not contain the speed: it becomes 2 <= 3 (least/a) (1 - r -
/// r e)/(1 - r) with e = sqrt(most/least) - 1. With s = 2 change/least, e is formed as s/(sqrt(1 + s) + 1):
/// nothing cancels, and no product of the speed underflows. Hence least >= (2/3) a; a rounded pair with a smaller
/// value near a separation is rejected.
#[cold]
fn window_holds_every_impact(pull: f64, change: f64, restitution: f64) -> bool {
    let least = pull - change;
    let spread = 2.0 * change / least;
    let excess = spread / ((1.0 + spread).sqrt() + 1.0);
    let lost = 1.0 - restitution;
    (least > 0.0) & ((2.0 + WINDOW_ROUNDING) * (pull * lost) <= 3.0 * least * (lost - restitution * excess))
}

#[inline(always)]
fn wrapped(angle: f64) -> (f64, u64) {
    if angle >= TAU { (angle - TAU, 1) } else { (angle, 0) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::chatter::expansion::LARGEST_COUNTED_RESTITUTION;
    use crate::numerics::testing::spread;

    /// Launches near the largest expansion parameter for which the bound may be small enough.
    #[test]
    fn chatters_that_surely_bounce_on_have_no_sum_yet() {
        let (mut summed, mut refused, mut seen) = (0, 0, 0);
        for k in 0..400_000 {
            let vibration =
                Vibration::new(libm::exp10(10.0 * spread(k, 0.754_877_666) - 6.0)).expect("legal");
            let phase = Phase::new(TAU * spread(k, 0.569_840_29)).expect("finite");
            let restitution = 0.98 * spread(k, 0.414_213_562);
            let (peak, pull) = (vibration.peak_acceleration(), vibration.contact_force(phase));
            let longest = libm::pow(COMPLETION_ERROR * pull / (MAJORANT * peak), 0.2);
            let speed = longest * (0.7 + 0.6 * spread(k, 0.618_033_99)) * (pull * (1.0 - restitution));
            if pull <= 0.0 || bounces_on(pull, speed, restitution) {
                continue;
            }
            let none = vibration.accumulation(phase, speed, restitution).is_none();
            let surely = surely_bounces_on(peak, pull, speed, restitution);
            assert!(none || !surely, "{vibration:?} {phase:?} {speed} {restitution}");
            summed += u32::from(!none);
            refused += u32::from(none);
            seen += u32::from(surely);
        }
        assert!(summed > 1_000 && 5 * seen > 2 * refused, "{seen} of {refused}, not of {summed}");
    }

    /// One case for each of the three bounds: an ordinary pull, a zero pull that grows with time, and a zero
    /// pull that grows with its square.
    #[test]
    fn what_ends_within_a_rounding_is_told_to_the_digit() {
        for restitution in [0.0, 0.5, 1.0 - 1e-6] {
            let left = COMPLETION_ERROR * (1.0 - restitution);
            let calm = Vibration::new(0.5).expect("legal");
            let falling = Phase::new(2.0).expect("finite");
            let strong = Vibration::new(1.5).expect("legal");
            let end = Phase::new(strong.retention_angle).expect("finite");
            let just = Vibration::new(1.0).expect("legal");
            let crest = Phase::from_parts(CREST, 1.0, 0.0);
            for (vibration, phase, slowest) in [
                (calm, falling, 0.5 * left * calm.contact_force(falling)),
                (strong, end, left * left * -strong.velocity(end) / 17.0),
                (just, crest, left * left * left / 24.0),
            ] {
                for (share, ends) in [(0.999_999, true), (1.000_001, false)] {
                    let speed = share * slowest;
                    assert_eq!(
                        vibration.ends_within_a_rounding(phase, speed, restitution),
                        ends,
                        "{vibration:?} {restitution} {share}"
                    );
                }
            }
            // Before the crest the pull shrinks.
            let rising = Phase::new(1.0).expect("finite");
            assert!(!calm.ends_within_a_rounding(rising, f64::MIN_POSITIVE, restitution));
        }
    }

    /// The pull is rounding error here, and so would be a proof of rest before the separation: the disk would
    /// attach at or after the separation, and rest for a period on a platform that falls away.
    #[test]
    fn no_chatter_ends_behind_the_separation() {
        let (mut attached, mut at_once) = (0, 0);
        for k in 0..200_000 {
            // P from just above 1, and distances to the separation at which the pull is a few roundings.
            let excess = libm::exp10(9.0 * spread(k, 0.754_877_666) - 9.0);
            let vibration = Vibration::new(1.0 + excess).expect("legal");
            let separation = vibration.separation_phase().expect("separates").angle();
            let slope = libm::sqrt(excess * (2.0 + excess));
            let distance = f64::EPSILON / slope * libm::exp10(4.0 * spread(k, 0.569_840_29) - 2.0);
            let fresh = Phase::new((separation - distance).max(0.0)).expect("finite");
            let by = [0.0, 1.1e-16, -1.1e-16][k as usize % 3];
            let phase = Phase::from_parts(fresh.angle(), fresh.sin() + by, fresh.cos());
            let restitution = [0.5, 0.1, 0.99][k as usize / 3 % 3];
            let pull = vibration.contact_force(phase).max(1e-17);
            let speed = pull * distance * libm::exp10(-4.0 * spread(k, 0.414_213_562));
            let Some(at) = vibration.accumulation(phase, speed, restitution) else { continue };
            attached += 1;
            at_once += u32::from(at.duration <= 0.0);
            assert!(
                at.duration < vibration.time_to_separation(phase.angle())
                    && !vibration.falls_away_at(at.phase.angle()),
                "{vibration:?} {phase:?} {speed:e} {restitution}: {at:?}"
            );
        }
        assert!(attached > 10_000 && at_once > 10, "{attached} {at_once}");
    }

    /// Just after the platform has stopped falling away, the pull is zero: no flight follows, and the impacts
    /// would never end.
    #[test]
    fn impacts_come_to_an_end_where_nothing_pulls() {
        let vibration = Vibration::new(1.0).expect("legal");
        let phase = Phase::new(CREST.next_up()).expect("finite");
        let at = vibration.accumulation(phase, 1e-60, 0.5).expect("rests");
        assert!(at.duration <= 0.0 && vibration.contact_force(phase) <= 0.0);
        assert_eq!(vibration.chatter_impacts(phase, 1e-60, 0.5).count(), 0);
    }

    /// The proof that all impacts lie in the window, near restitution 1 and for speeds without digits left.
    fn window_holds_all_exactly(peak: f64, pull: f64, drift: f64, restitution: f64, x: f64) -> bool {
        type High = dashu_float::FBig<dashu_float::round::mode::HalfEven, 2>;
        let high = |x: f64| High::try_from(x).expect("finite").with_precision(500).value();
        let (pull, r) = (high(pull), high(restitution));
        let window = high(3.0) * high(x);
        let change = (high(drift.abs()) + high(peak) * &window) * &window;
        let (least, most) = (&pull - &change, &pull + &change);
        if least <= high(0.0) {
            return false;
        }
        let ratio = r * (most / &least).sqrt();
        high(2.0) * high(x) * (high(1.0) - high(restitution)) * pull <= window * least * (high(1.0) - ratio)
    }

    #[test]
    fn a_window_is_proven_where_the_ratio_of_launches_rounds_to_one() {
        let (mut held, mut refused) = (0, 0);
        for k in 0..20_000 {
            let restitution =
                [1.0 - 1e-3, 1.0 - 1e-9, 1.0 - f64::EPSILON, 1.0 - f64::EPSILON / 2.0][k as usize % 4];
            let peak = libm::exp10(4.0 * spread(k, 0.754_877_666) - 2.0);
            let vibration = Vibration::new(peak).expect("legal");
            let phase = Phase::new(TAU * spread(k, 0.569_840_29)).expect("finite");
            let (pull, drift) = (vibration.contact_force(phase), vibration.velocity(phase));
            if pull <= 0.0 {
                continue;
            }
            // Near the drift at which the pull's change over the window equals the loss by restitution.
            let bound = (1.0 - restitution) * pull / (9.0 * drift.abs());
            let x = bound * libm::exp10(0.1 * spread(k, 0.414_213_562) - 0.05);
            let speed = x * (pull * (1.0 - restitution));
            let holds = window_holds_all(peak, pull, drift, speed, restitution, 2.0 * x);
            assert!(
                !holds || window_holds_all_exactly(peak, pull, drift, restitution, x),
                "{peak} {phase:?} {restitution} {x:e}"
            );
            held += u32::from(holds);
            refused += u32::from(!holds);
        }
        assert!(held > 5_000 && refused > 5_000, "{held} {refused}");
    }

    /// At ordinary restitutions the ratio of launches decides, not the least pull.
    #[test]
    fn a_window_is_proven_as_far_as_the_launches_shrink() {
        let (mut held, mut refused) = (0, 0);
        for k in 0..4_000 {
            let restitution = [0.1, 0.3, 0.5, 0.8, 0.95][k as usize % 5];
            let peak = libm::exp10(4.0 * spread(k, 0.754_877_666) - 2.0);
            let vibration = Vibration::new(peak).expect("legal");
            let phase = Phase::new(TAU * spread(k, 0.569_840_29)).expect("finite");
            let (pull, drift) = (vibration.contact_force(phase), vibration.velocity(phase));
            if pull <= 1e-3 * peak || drift.abs() <= 0.1 * peak {
                continue;
            }
            // The share of the pull that changes within the window: up to all of it.
            let x = pull / (3.0 * drift.abs()) * spread(k, 0.414_213_562);
            let holds =
                window_holds_all(peak, pull, drift, x * (pull * (1.0 - restitution)), restitution, 2.0 * x);
            assert_eq!(
                holds,
                window_holds_all_exactly(peak, pull, drift, restitution, x),
                "{peak} {phase:?} {restitution} {x:e}"
            );
            held += u32::from(holds);
            refused += u32::from(!holds);
        }
        assert!(held > 100 && refused > 500, "{held} {refused}");
    }

    /// From the smallest number upwards, and near separations, where the pull is rounding error: no summed
    /// chatter is reported to bounce on, the sum ends before the separation, and the impacts end.
    #[test]
    fn the_slowest_chatters_come_to_an_end() {
        let mut summed = 0;
        for k in 0..60_000_u32 {
            let peak = [0.0, 1e-9, 0.5, 1.0, 1.000_000_267_196_965_4, 2.0, 197.39, 1e8][k as usize % 8];
            let vibration = Vibration::new(peak).expect("legal");
            let angle = match vibration.separation_phase() {
                Some(at) if k % 3 > 0 => at.angle() * (1.0 - libm::exp10(-16.0 * spread(k, 0.754_877_666))),
                _ => TAU * spread(k, 0.754_877_666),
            };
            let exact = Phase::new(angle).expect("finite");
            // A carried pair has an error of up to one rounding.
            let off = |by: f64| 1.1e-16 * (spread(k, by) * 3.0 - 1.5);
            let phase = Phase::from_parts(angle, exact.sin() + off(0.33), exact.cos() + off(0.77));
            let restitution =
                [1e-300, 0.3, 0.5, 0.7246, 0.99, 1.0 - 1e-7, 1.0 - f64::EPSILON / 2.0][k as usize / 8 % 7];
            let speed = libm::exp10(-323.3 * libm::pow(spread(k, 0.618_033_99), 0.3)).max(f64::from_bits(1));
            let (pull, sum) =
                (vibration.contact_force(phase), vibration.accumulation(phase, speed, restitution));
            let Some(sum) = sum else { continue };
            summed += 1;
            assert!(
                !surely_bounces_on(peak, pull, speed, restitution),
                "{peak} {phase:?} {speed:e} {restitution}"
            );
            assert!(sum.duration >= 0.0 && sum.duration < 2.0 * LONGEST_COMPLETION);
            assert!(
                !vibration.falls_away_at(sum.phase.angle()),
                "{peak} {phase:?} {speed:e} {restitution} {sum:?} {pull:e}"
            );
            if restitution <= LARGEST_COUNTED_RESTITUTION {
                let impacts = vibration.chatter_impacts(phase, speed, restitution).take(8_000).count();
                assert!(impacts < 7_600, "{impacts} {peak} {phase:?} {speed:e} {restitution}");
            }
            if speed < 1e-290 && ChatterSeries::is_needed(speed, restitution) {
                let series = vibration.chatter_series(phase, speed, restitution);
                assert_eq!(series.duration().to_bits(), sum.duration.to_bits());
                assert!(series.impacts_by(sum.duration).is_none());
            }
        }
        assert!(summed > 20_000, "{summed}");
    }

    /// The phase decides whether the platform falls away, not the force, which is rounding error there.
    #[test]
    fn a_disk_without_speed_rests_where_the_platform_does_not_fall_away() {
        let mut pulled_off = 0;
        for k in 1..10_000 {
            let vibration = Vibration::new(1.0 + 20.0 * spread(k, 0.754_877_666)).expect("legal");
            let below = f64::from_bits(vibration.separation_angle.to_bits() - 1);
            for (angle, rests) in [
                (below, true),
                (vibration.separation_angle, false),
                (f64::from_bits(vibration.retention_angle.to_bits() - 1), false),
                (vibration.retention_angle, true),
            ] {
                let phase = Phase::new(angle).expect("finite");
                let at_rest = Accumulation { duration: 0.0, error_bound: 0.0, phase, turns: 0 };
                assert_eq!(vibration.accumulation(phase, 0.0, 0.5), rests.then_some(at_rest), "{angle}");
                pulled_off += u32::from(rests && vibration.contact_force(phase) < 0.0);
            }
        }
        assert!(pulled_off > 100, "{pulled_off}");
    }

    /// A chatter that ends beyond phase 0 has passed it once.
    #[test]
    fn an_accumulation_point_is_wrapped_into_the_period() {
        let below = f64::from_bits(TAU.to_bits() - 1);
        assert_eq!((wrapped(TAU), wrapped(below)), ((0.0, 1), (below, 0)));
        let vibration = Vibration::new(0.5).expect("legal");
        let phase = Phase::new(TAU - 1e-6).expect("finite");
        let sum = vibration.accumulation(phase, 1e-6, 0.5).expect("chatters to rest");
        assert!((sum.duration - 4e-6).abs() < 1e-10 && sum.turns == 1, "{sum:?}");
        assert!((sum.phase.angle() - (sum.duration - 1e-6)).abs() < 1e-15, "{sum:?}");
    }

    /// The impacts continue until 1e-17 of the first impulse is left, and no longer.
    #[test]
    fn impacts_of_a_chatter_are_followed_to_1e_17_of_the_first() {
        let vibration = Vibration::new(0.5).expect("legal");
        let phase = Phase::new(1.0).expect("finite");
        let (speed, restitution) = (1e-4, 0.5);
        let impacts: Vec<_> = vibration.chatter_impacts(phase, speed, restitution).collect();
        let launches: Vec<_> = impacts.iter().map(|impact| restitution * impact.speed / speed).collect();
        let (last, before) = launches.split_last().expect("some");
        assert!(*last <= 1e-17 && before.iter().all(|launch| *launch > 1e-17), "{launches:?}");
    }

    /// On a still platform the series is exact at once: only the limit for visible bounces, a hundredth of a
    /// radian, decides.
    #[test]
    fn visible_bounces_of_a_still_platform_are_not_summed() {
        let phase = Phase::new(1.0).expect("finite");
        let sum = |longest: f64| Vibration::still().accumulation(phase, 0.5 * longest * (1.0 - 0.25), 0.25);
        assert!(sum(0.01 * (1.0 + 1e-12)).is_none());
        let longest = sum(0.01 * (1.0 - 1e-12)).expect("short enough");
        assert!((longest.duration - 0.01).abs() < 1e-13 && longest.error_bound.abs() <= 0.0, "{longest:?}");
    }
}
