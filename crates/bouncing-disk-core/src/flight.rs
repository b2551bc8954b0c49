//! The first impact of a flight: Eq. (11), with the guarantee that no earlier one is missed.
//!
//! In units of 1/omega and g/omega^2 a disk that leaves the platform at phase tau with relative speed w is above
//! it by
//!
//! ```text
//! gap(h) = w h - h^2/2 + P [h cos tau + sin tau - sin(tau + h)]
//! ```
//!
//! Three facts make the first zero h > 0 certain and its cost independent of the length of the flight (proofs in
//! docs/numerics.md):
//!
//! 1. *One crest decides.* At a crest of the platform (phase pi/2) the disk is hit at the latest if it is below
//!    the crest. So the impact lies before the first crest after the launch that finds the disk below it, or,
//!    if the disk rises above the crests, before the first crest after it has come down to their height, a
//!    moment known in closed form. Either window is shorter than one period.
//! 2. *The curvature of the gap, P sin(tau + h) - 1, changes sign at two phases known in closed form.* A window
//!    has at most three pieces of constant curvature; a concave piece that starts above zero has a root only if
//!    it ends below, and then one; a convex piece can only be entered and left again through one minimum.
//! 3. *gap(h)/h is regular*, so the launch itself is divided out and flights of any brevity have relative accuracy.

use core::f64::consts::{PI, TAU};

use serde::Serialize;

use crate::elementary::{
    CREST, nearby_wrapped, nearest_periods, rotated, sin_cos_bounded, sine_deficit_ratio, versine_ratio,
};
use crate::error::Error;
use crate::phase::Phase;
use crate::vibration::Vibration;

/// Flights up to this long (rad) are solved through the series of gap(h)/h; longer ones through the pair.
pub(crate) const SHORT_FLIGHT: f64 = 0.5;

/// Longest flight accepted, in radians: beyond it the period count times 2 pi is no longer exact.
pub const MAX_FLIGHT_DURATION: f64 = 1.6e9;

/// Bounds the last step (rad) times one plus its relative curvature: what the sixth-order series reversal leaves
/// is below twice the seventh power, 4e-17 rad.
const LAST_STEP: f64 = 4.0e-3;

/// Relative size of the last Newton step on gap/h: what it leaves is its square.
const LAST_SHORT_STEP: f64 = 1.0e-9;

/// Evaluations after which the search reports [`Error::NoConvergence`]; bisection alone needs about 60.
const MAX_EVALUATIONS: u32 = 200;

/// Rounding error of one evaluation of the gap, relative to the sum of the sizes of its terms.
const GAP_ROUNDING: f64 = 4.5e-16;

/// A launch of the disk from the platform.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Launch {
    phase: Phase,
    relative_speed: f64,
}

impl Launch {
    /// A launch at `phase` with `relative_speed` >= 0 (disk minus platform, in units of g/omega).
    ///
    /// Speed zero means "from rest on the platform": legal only where the platform falls away, P sin tau >= 1.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a negative or non-finite speed.
    pub fn new(phase: Phase, relative_speed: f64) -> Result<Self, Error> {
        if relative_speed >= 0.0 && relative_speed.is_finite() {
            Ok(Self { phase, relative_speed })
        } else {
            Err(Error::OutOfRange {
                field: "relative_speed",
                value: relative_speed,
                legal: "[0, inf) (units of g/omega)",
            })
        }
    }

    /// Launch phase.
    #[must_use]
    pub const fn phase(&self) -> Phase {
        self.phase
    }

    /// Launch speed relative to the platform, in units of g/omega.
    #[must_use]
    pub const fn relative_speed(&self) -> f64 {
        self.relative_speed
    }
}

/// The first impact after a launch.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Impact {
    /// Whole periods of the duration of the flight.
    pub periods: u64,
    /// The rest of the duration in radians, in [0, 2 pi).
    pub remainder: f64,
    /// How often the phase passed 0 (mod 2 pi) during the flight: what a period counter advances by.
    pub turns: u64,
    /// Phase of the impact.
    pub phase: Phase,
    /// Relative axial velocity w_A (disk minus platform) just before the impact, <= 0, in units of g/omega.
    pub velocity: f64,
    /// Evaluations of the gap.
    pub evaluations: u32,
}

impl Impact {
    /// Duration of the flight in radians (rounded: the exact value is `periods` and `remainder`).
    #[must_use]
    pub fn duration(&self) -> f64 {
        self.periods as f64 * TAU + self.remainder
    }
}

/// A window in time from the reference of an [`Arc`] with exactly one root, the gap falling through it.
#[derive(Clone, Copy)]
pub(crate) struct Bracket {
    pub(crate) lo: f64,
    pub(crate) hi: f64,
}

/// What an arc's root gives: time from the reference, phase pair there, relative velocity.
#[derive(Clone, Copy)]
pub(crate) struct Root {
    pub(crate) time: f64,
    sin: f64,
    cos: f64,
    velocity: f64,
    evaluations: u32,
}

/// The gap in the form gap(t) = P [1 - sin(angle + t)] - depth + t (speed - t/2): heights are counted from the
/// platform's crest, so that nothing large cancels however long the disk has been flying.
#[derive(Clone, Copy)]
pub(crate) struct Arc {
    pub(crate) peak: f64,
    pub(crate) angle: f64,
    /// Disk speed (not relative) at t = 0.
    pub(crate) speed: f64,
    /// Disk depth below the crest at t = 0.
    pub(crate) depth: f64,
}

impl Arc {
    /// Gap at a time whose platform depth below the crest, P (1 - sin), is known in closed form.
    #[inline(always)]
    pub(crate) fn gap_over(&self, platform_depth: f64, t: f64) -> f64 {
        (platform_depth - self.depth) + t * (self.speed - 0.5 * t)
    }

    /// The root in `bracket`, which must hold exactly one, the gap falling through it, and the first guess.
    ///
    /// Fifth-order series reversal steps from a pair; each is kept inside the shrinking bracket, with a step of
    /// the quadratic model or bisection where the series is useless (near a graze).
    #[inline(always)]
    pub(crate) fn root(&self, mut bracket: Bracket, guess: f64, evaluations: u32) -> Result<Root, Error> {
        let p = self.peak;
        let mut t = guess;
        let mut used = evaluations;
        loop {
            let (s, c) = sin_cos_bounded(self.angle + t);
            used += 1;
            let platform = p * s;
            let gap = ((p - platform) - self.depth) + t * (self.speed - 0.5 * t);
            let third = p * c;
            let slope = (self.speed - t) - third;
            let curvature = platform - 1.0;
            let inverse = 1.0 / slope;
            let x = gap * inverse;
            if x.abs() * (1.0 + (curvature * inverse).abs()) <= LAST_STEP && slope < 0.0 {
                let delta = reverted(-x, inverse, curvature, third, platform);
                let (sin, cos) = rotated(s, c, delta);
                let time = t + delta;
                let velocity = (self.speed - time) - p * cos;
                return Ok(Root { time, sin, cos, velocity, evaluations: used });
            }
            if gap > 0.0 {
                bracket.lo = t;
            } else {
                bracket.hi = t;
            }
            let radicand = slope * slope - 2.0 * gap * curvature;
            let step = if radicand > 0.0 {
                // The root of the quadratic model, with the sign that does not cancel; the slope of the model
                // there is -sqrt(radicand), which turns the next two terms into a correction.
                let root = radicand.sqrt();
                let step = -2.0 * gap / (slope - root);
                let correction =
                    step * step * step * ((1.0 / 6.0) * third - (1.0 / 24.0) * platform * step) / root;
                if correction.abs() < 0.5 * step.abs() { step + correction } else { step }
            } else {
                -x
            };
            let next = t + step;
            t = if slope < 0.0 && next > bracket.lo && next < bracket.hi {
                next
            } else {
                0.5 * (bracket.lo + bracket.hi)
            };
            if used >= 8 && self.is_settled(bracket, gap) {
                return Ok(self.root_as_found(t, used));
            }
            if used >= MAX_EVALUATIONS {
                return Err(Error::NoConvergence { evaluations: used, phase: self.angle + t, gap });
            }
        }
    }

    /// Whether the gap is nothing but rounding, or the bracket two neighbours: the impact is a graze, known to
    /// its conditioning limit.
    #[cold]
    fn is_settled(&self, bracket: Bracket, gap: f64) -> bool {
        let scale = 2.0 * self.peak + self.depth.abs() + bracket.hi * (self.speed.abs() + bracket.hi);
        gap.abs() <= GAP_ROUNDING * scale
            || bracket.hi - bracket.lo <= 2.0 * f64::EPSILON * (self.angle + bracket.hi)
    }

    #[cold]
    fn root_as_found(&self, time: f64, evaluations: u32) -> Root {
        let (sin, cos) = sin_cos_bounded(self.angle + time);
        let velocity = ((self.speed - time) - self.peak * cos).min(0.0);
        Root { time, sin, cos, velocity, evaluations: evaluations + 1 }
    }

    /// The smallest gap in [`lo`, `hi`], a piece of positive curvature whose slope changes from negative to
    /// positive, and its time: Newton steps on the slope, which increases, kept in a bracket.
    #[cold]
    pub(crate) fn lowest(&self, mut lo: f64, mut hi: f64, evaluations: &mut u32) -> (f64, f64) {
        let mut t = 0.5 * (lo + hi);
        loop {
            let (s, c) = sin_cos_bounded(self.angle + t);
            *evaluations += 1;
            let slope = (self.speed - t) - self.peak * c;
            let curvature = self.peak * s - 1.0;
            if slope < 0.0 {
                lo = t;
            } else {
                hi = t;
            }
            let step = -slope / curvature;
            let next = t + step;
            let next = if next > lo && next < hi { next } else { 0.5 * (lo + hi) };
            // The gap is flat at its minimum: an error d in time costs d^2 in the gap.
            let settled = (next - t).abs() <= 1.0e-9 || hi - lo <= 1.0e-9;
            if settled || *evaluations >= MAX_EVALUATIONS {
                let (s, _) = sin_cos_bounded(self.angle + next);
                let gap = ((self.peak - self.peak * s) - self.depth) + next * (self.speed - 0.5 * next);
                return (next, gap);
            }
            t = next;
        }
    }
}

/// The step d with gap + slope d + curvature d^2/2 + ... = 0 by series reversal to the sixth order, given the
/// Newton step `z` = -gap/slope, 1/slope, and the derivatives of a gap whose platform part is -`platform` (fourth
/// derivative), -`third` (fifth) and so on.
#[inline(always)]
fn reverted(z: f64, inverse: f64, curvature: f64, third: f64, platform: f64) -> f64 {
    let a2 = 0.5 * curvature * inverse;
    let a3 = (1.0 / 6.0) * third * inverse;
    let a4 = (-1.0 / 24.0) * platform * inverse;
    let a5 = (-1.0 / 120.0) * third * inverse;
    let b = a2 * a2;
    let c3 = 2.0 * b - a3;
    let c4 = a2 * (5.0 * (a3 - b)) - a4;
    let c5 = (6.0 * a2 * a4 + 3.0 * a3 * a3) + (b * (14.0 * b - 21.0 * a3) - a5);
    let z2 = z * z;
    z + z2 * ((c3 * z - a2) + z2 * (c4 + c5 * z))
}

/// gap(h)/h and the relative velocity of a flight of at most [`SHORT_FLIGHT`], in relative accuracy.
#[derive(Clone, Copy)]
struct ShortFlight {
    speed: f64,
    /// P sin tau and P cos tau at launch.
    sine: f64,
    cosine: f64,
    /// 1 - P sin tau: what pulls the disk back at launch.
    pull: f64,
}

impl ShortFlight {
    /// (gap(h)/h, relative velocity at h).
    #[inline(always)]
    fn at(&self, h: f64) -> (f64, f64) {
        let versine = versine_ratio(h);
        let deficit = sine_deficit_ratio(h);
        let h2 = h * h;
        // P sin tau (1 - cos h)/h is written with 1/2 - (1/2 - versine) so that P sin tau = 1 cancels exactly.
        let ratio =
            self.speed - h * (0.5 * self.pull + self.sine * (0.5 - versine)) + self.cosine * (h2 * deficit);
        let velocity =
            self.speed - h * self.pull + (self.cosine * (h2 * versine) - self.sine * (h2 * h * deficit));
        (ratio, velocity)
    }

    /// The root of gap(h)/h in a bracket that holds exactly one.
    #[inline(always)]
    fn root(&self, mut bracket: Bracket, evaluations: &mut u32) -> Result<(f64, f64), Error> {
        // Two terms of the expansion in the launch speed; elsewhere the middle of the bracket.
        let reach = self.speed / self.pull;
        let mut h = 2.0 * reach * (1.0 + (2.0 / 3.0) * self.cosine * reach / self.pull);
        if !(h > bracket.lo && h < bracket.hi) {
            h = 0.5 * (bracket.lo + bracket.hi);
        }
        loop {
            let (ratio, velocity) = self.at(h);
            *evaluations += 1;
            if ratio > 0.0 {
                bracket.lo = h;
            } else {
                bracket.hi = h;
            }
            let slope = velocity - ratio;
            let step = -ratio * h / slope;
            let next = h + step;
            if step.abs() <= LAST_SHORT_STEP * h && slope < 0.0 {
                let acceleration = -self.pull + self.cosine * h;
                return Ok((next, (velocity + acceleration * step).min(0.0)));
            }
            if bracket.hi - bracket.lo <= 2.0 * f64::EPSILON * bracket.hi {
                return Ok((h, velocity.min(0.0)));
            }
            h = if slope < 0.0 && next > bracket.lo && next < bracket.hi {
                next
            } else {
                0.5 * (bracket.lo + bracket.hi)
            };
            if *evaluations >= MAX_EVALUATIONS {
                return Err(Error::NoConvergence { evaluations: *evaluations, phase: h, gap: ratio * h });
            }
        }
    }

    /// The lowest gap/h of a convex piece [lo, hi] by golden-free bisection on the relative velocity.
    #[cold]
    fn lowest(&self, mut lo: f64, mut hi: f64, evaluations: &mut u32) -> (f64, f64) {
        while hi - lo > 1.0e-9 * hi && *evaluations < MAX_EVALUATIONS {
            let middle = 0.5 * (lo + hi);
            *evaluations += 1;
            if self.at(middle).1 < 0.0 {
                lo = middle;
            } else {
                hi = middle;
            }
        }
        let h = 0.5 * (lo + hi);
        (h, self.at(h).0 * h)
    }
}

impl Vibration {
    /// The first impact after `launch` (Eq. 11).
    ///
    /// The impact phase is accurate to 1e-14 of a period or to the conditioning of the problem, whichever is
    /// larger (docs/numerics.md states the bound).
    ///
    /// # Errors
    /// [`Error::NoLiftOff`] for a launch from rest where the platform does not fall away;
    /// [`Error::FlightTooLong`] beyond [`MAX_FLIGHT_DURATION`].
    pub fn first_impact(&self, launch: Launch) -> Result<Impact, Error> {
        self.impact_after(launch.phase, launch.relative_speed)
    }

    /// [`Self::first_impact`] for a speed that is known to be finite and not negative.
    #[inline]
    pub(crate) fn impact_after(&self, from: Phase, speed: f64) -> Result<Impact, Error> {
        let p = self.peak_acceleration();
        let angle = from.angle();
        if speed < self.long_launch_speed
            && let Some(done) = self.short_flight(from, speed)?
        {
            return Ok(done);
        }
        let disk_speed = speed + p * from.cos();
        let depth = p - p * from.sin();
        let rising = Arc { peak: p, angle, speed: disk_speed, depth };
        let mut evaluations = 0;

        // Until the first crest. A disk launched while the platform falls away, its crest still ahead, is above
        // that crest for certain. One branch for the whole question: each part of it is a coin toss in a chaotic
        // orbit, the answer hardly ever.
        let inflection = self.time_to_separation(angle);
        let crest = inflection + (CREST - self.separation_angle);
        let from_falling_away = (angle >= self.separation_angle) & (angle < CREST);
        let above =
            (rising.gap_over(self.separation_depth, inflection) > 0.0) & (rising.gap_over(0.0, crest) > 0.0);
        let no_dip = (disk_speed - inflection >= self.separation_speed) | (disk_speed <= crest);
        if !(from_falling_away | (above & no_dip))
            && let Some(bracket) =
                self.bracket_before_crest_of_launch(&rising, inflection, crest, &mut evaluations)
        {
            return self.impact_before_crest(from, speed, rising, bracket, evaluations);
        }
        self.impact_from_above(angle, disk_speed, depth, speed, evaluations)
    }

    /// The window of the first root of a launch before the crest, where it is not plain that there is none.
    #[cold]
    fn bracket_before_crest_of_launch(
        &self,
        rising: &Arc,
        inflection: f64,
        crest: f64,
        evaluations: &mut u32,
    ) -> Option<Bracket> {
        if rising.gap_over(self.separation_depth, inflection) <= 0.0 {
            Some(Bracket { lo: 0.0, hi: inflection })
        } else if rising.gap_over(0.0, crest) <= 0.0 {
            Some(Bracket { lo: inflection, hi: crest })
        } else {
            let (lowest, gap) = rising.lowest(inflection, crest, evaluations);
            (gap <= 0.0).then_some(Bracket { lo: inflection, hi: lowest })
        }
    }

    /// The impact of a disk that rises above the crests: down to their height it flies free, in closed form.
    /// `disk_speed` and `depth` (below the crest) are those at `angle`; `speed` is only for the error.
    #[inline(always)]
    pub(crate) fn impact_from_above(
        &self,
        angle: f64,
        disk_speed: f64,
        depth: f64,
        speed: f64,
        mut evaluations: u32,
    ) -> Result<Impact, Error> {
        let p = self.peak_acceleration();
        let radicand = disk_speed * disk_speed - 2.0 * depth;
        let fall = if radicand > 0.0 { radicand.sqrt() } else { 0.0 };
        let free = disk_speed + fall;
        if free > MAX_FLIGHT_DURATION {
            return Err(Error::FlightTooLong {
                relative_speed: speed,
                duration: free,
                limit: MAX_FLIGHT_DURATION,
            });
        }
        let (free_periods, rest) = nearest_periods(free);
        let start = angle + rest;
        let falling = Arc { peak: p, angle: start, speed: -fall, depth: 0.0 };
        let (turned, _) = nearby_wrapped(start);
        let crest = (CREST - turned) + if turned < CREST { 0.0 } else { TAU };
        // One root, unless the disk comes down slower than the platform can fall and just behind a crest.
        let behind_crest = (turned > CREST) & (turned < self.retention_angle);
        let bracket = if (fall < p) & behind_crest {
            self.bracket_behind_crest(&Arc { angle: turned, ..falling }, crest, &mut evaluations)
        } else {
            Bracket { lo: 0.0, hi: crest }
        };
        let guess = first_guess(&falling, bracket);
        let root = falling.root(bracket, guess, evaluations)?;
        Ok(landed(angle, start, free_periods, root))
    }

    /// The window of the first root of an arc that starts at the crests' height while the platform falls away
    /// below the disk: the disk may catch up with the platform and be left behind again.
    #[cold]
    fn bracket_behind_crest(&self, falling: &Arc, crest: f64, evaluations: &mut u32) -> Bracket {
        let end = self.retention_angle - falling.angle;
        if falling.gap_over(self.separation_depth, end) <= 0.0 {
            return Bracket { lo: 0.0, hi: end };
        }
        let (_, cos) = sin_cos_bounded(falling.angle);
        if falling.speed < self.peak_acceleration() * cos && falling.speed - end > -self.separation_speed {
            let (lowest, gap) = falling.lowest(0.0, end, evaluations);
            if gap <= 0.0 {
                return Bracket { lo: 0.0, hi: lowest };
            }
        }
        Bracket { lo: end, hi: crest }
    }

    /// An impact before the first crest, longer than a short flight.
    #[cold]
    fn impact_before_crest(
        &self,
        from: Phase,
        speed: f64,
        rising: Arc,
        bracket: Bracket,
        evaluations: u32,
    ) -> Result<Impact, Error> {
        // No impact before this: the gap bends down by 1 + P at the most.
        let earliest = (2.0 * speed / (1.0 + self.peak_acceleration())).max(SHORT_FLIGHT);
        let bracket = Bracket { lo: bracket.lo.max(earliest.min(bracket.hi)), hi: bracket.hi };
        let root = rising.root(bracket, 0.5 * (bracket.lo + bracket.hi), evaluations)?;
        let mut impact = landed(from.angle(), from.angle(), 0.0, root);
        impact.periods = 0;
        impact.remainder = root.time;
        if impact.remainder >= TAU {
            impact.periods = 1;
            impact.remainder -= TAU;
        }
        Ok(impact)
    }

    /// The impact if it comes within [`SHORT_FLIGHT`], else `None`.
    fn short_flight(&self, from: Phase, speed: f64) -> Result<Option<Impact>, Error> {
        let p = self.peak_acceleration();
        let angle = from.angle();
        let away = self.falls_away_at(angle);
        if speed <= 0.0 && !away {
            return Err(Error::NoLiftOff { phase: angle, peak_acceleration: p });
        }
        let sine = p * from.sin();
        let flight = ShortFlight { speed, sine, cosine: p * from.cos(), pull: 1.0 - sine };
        let mut evaluations = 0;
        // Pieces of constant curvature: `away` (convex) until retention, else concave until separation.
        let mut lo = 0.0;
        let mut convex = away;
        let mut end = if away { self.retention_angle - angle } else { self.time_to_separation(angle) };
        let bracket = loop {
            let hi = end.min(SHORT_FLIGHT);
            let (ratio, velocity) = flight.at(hi);
            evaluations += 1;
            if ratio <= 0.0 {
                break Some(Bracket { lo, hi });
            }
            if convex && lo > 0.0 && velocity > 0.0 && flight.at(lo).1 < 0.0 {
                let (lowest, gap) = flight.lowest(lo, hi, &mut evaluations);
                if gap <= 0.0 {
                    break Some(Bracket { lo, hi: lowest });
                }
            }
            if end >= SHORT_FLIGHT {
                break None;
            }
            lo = end;
            end += if convex { PI + 2.0 * self.separation_angle } else { PI - 2.0 * self.separation_angle };
            convex = !convex;
        };
        let Some(bracket) = bracket else { return Ok(None) };
        let (h, velocity) = flight.root(bracket, &mut evaluations)?;
        let h2 = h * h;
        let (sin_h, versine) = (h - h2 * h * sine_deficit_ratio(h), h2 * versine_ratio(h));
        let (s, c) = (from.sin(), from.cos());
        let sum = angle + h;
        let (wrapped, turns) = if sum >= TAU { (sum - TAU, 1) } else { (sum, 0) };
        Ok(Some(Impact {
            periods: 0,
            remainder: h,
            turns,
            phase: Phase::from_parts(wrapped, s + (c * sin_h - s * versine), c - (s * sin_h + c * versine)),
            velocity,
            evaluations,
        }))
    }
}

/// The start of the search on an arc that comes down from the crests' height.
#[inline(always)]
fn first_guess(_falling: &Arc, bracket: Bracket) -> f64 {
    bracket.lo
}

/// The impact of an arc whose reference is `start`, in [-pi, 3 pi), `periods` whole periods later than a launch at
/// `angle` would put it.
#[inline(always)]
pub(crate) fn landed(angle: f64, start: f64, periods: f64, root: Root) -> Impact {
    let (wrapped, turns) = nearby_wrapped(start + root.time);
    // The sum of a seam: -1e-17 + 2 pi rounds to 2 pi itself.
    let wrapped = if wrapped < TAU { wrapped } else { 0.0 };
    let turns = (periods + turns) as u64;
    let ahead = wrapped - angle;
    let (periods, remainder) =
        if ahead >= 0.0 { (turns, ahead) } else { (turns.saturating_sub(1), ahead + TAU) };
    Impact {
        periods,
        remainder,
        turns,
        phase: Phase::from_parts(wrapped, root.sin, root.cos),
        velocity: if root.velocity < 0.0 { root.velocity } else { 0.0 },
        evaluations: root.evaluations,
    }
}
