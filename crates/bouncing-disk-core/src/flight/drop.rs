//! The first impact of a disk that starts in the air.
//!
//! Up to the first crest that rises above the disk, the gap is followed in the form
//!
//! ```text
//! gap(t) = gap_0 + v t - t^2/2 + P [sin tau (1 - cos t) + cos tau (t - sin t)]
//! ```
//!
//! whose terms are each accurate in the relative sense: neither a gap far below the rounding of P nor a
//! velocity far above the platform's is lost by cancellation. A disk that stays above the crests longer is
//! followed from the moment it comes down to them.

use core::f64::consts::{PI, TAU};

use crate::flight::first_impact::{landed_within_a_turn, turned_by};
use crate::flight::gap::SHORT_FLIGHT;
use crate::flight::gap::{BRIEFEST, Bracket, GapForm, LaunchForm, Root, ShortForm};
use crate::flight::launch::Impact;
use crate::flight::platform::phase::Phase;
use crate::flight::platform::vibration::Vibration;
use crate::numerics::elementary::{CREST, hypot};
use crate::numerics::error::{Error, within};

/// Largest gap accepted, in units of g/omega^2.
const LARGEST_GAP: f64 = 1.0e17;

/// Largest velocity accepted, in units of g/omega.
const LARGEST_VELOCITY: f64 = 1.0e9;

/// Relative size of the last Newton step of the search: the remaining error is of the order of its square.
const LAST_STEP: f64 = 1.0e-9;

/// Relative distance from the lowest point of the gap at which a dip counts as found. The gap there exceeds
/// the minimum by at most the square of this number, relative to the terms that form it.
const DIP_ACCURACY: f64 = 1.0e-9;

/// A disk that falls at least this fast, and lands within [`BRIEFEST`] rad, lands with the velocity that it
/// started with, to all digits: a pull of up to 1e8 has no time to change it.
const SLOWEST_BRIEF: f64 = 1.0e-200;

/// Evaluations after which the search bisects the logarithm of the time, and after which it reports an error;
/// this bisection needs about 75.
const PATIENCE: u32 = 40;
const MAX_EVALUATIONS: u32 = 200;

/// Checks that `gap` and `relative_velocity` of a disk that starts in the air are within the ranges of
/// [`Vibration::first_impact_of_drop`].
///
/// # Errors
/// [`Error::OutOfRange`] names the offending number.
pub fn check_drop(gap: f64, relative_velocity: f64) -> Result<(), Error> {
    within("gap", gap, f64::MIN_POSITIVE, LARGEST_GAP, "[2.3e-308, 1e17] (units of g/omega^2)")?;
    within(
        "relative_velocity",
        relative_velocity,
        -LARGEST_VELOCITY,
        LARGEST_VELOCITY,
        "[-1e9, 1e9] (units of g/omega)",
    )?;
    Ok(())
}

impl Vibration {
    /// The first impact of a disk that starts in the air at `phase`. It is `gap` above the platform (a normal
    /// number up to 1e17, in units of g/omega^2) and moves with `relative_velocity` in [-1e9, 1e9] (disk
    /// minus platform, units of g/omega, of either sign).
    ///
    /// The guarantee of [`Self::first_impact`] holds; here the first piece may be convex and entered with a
    /// falling gap. A short flight is accurate in the relative sense, however small the gap and however fast
    /// the disk.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a gap or a velocity outside these ranges;
    /// [`Error::FlightTooLong`] beyond [`crate::flight::MAX_FLIGHT_DURATION`].
    pub fn first_impact_of_drop(
        &self,
        phase: Phase,
        gap: f64,
        relative_velocity: f64,
    ) -> Result<Impact, Error> {
        check_drop(gap, relative_velocity)?;
        let impact = self.impact_of_drop(phase, gap, relative_velocity);
        #[cfg(debug_assertions)]
        if let Ok(impact) = &impact {
            self.assert_clock(phase, relative_velocity, (impact.phase, impact.velocity), impact.duration());
        }
        impact
    }

    fn impact_of_drop(&self, phase: Phase, gap: f64, velocity: f64) -> Result<Impact, Error> {
        let p = self.peak_acceleration();
        if velocity < -SLOWEST_BRIEF && gap < BRIEFEST * -velocity {
            let h = (gap / -velocity).max(f64::from_bits(1));
            let (phase, turns) = turned_by(phase, h);
            return Ok(Impact { periods: 0, remainder: h, turns, phase, velocity, evaluations: 0 });
        }
        let form = DropForm::new(p, phase, gap, velocity);
        let disk_speed = velocity + p * phase.cos();
        let depth = (p - p * phase.sin()) - gap;
        // Speed at which the disk comes down to the height of the crests, and the time, computed as the root
        // that does not cancel; if it does not reach that height, the time of its highest point.
        let radicand = disk_speed * disk_speed - 2.0 * depth;
        let fall = if radicand > 0.0 { radicand.sqrt() } else { 0.0 };
        let free = if disk_speed > 0.0 { disk_speed + fall } else { -2.0 * depth / (fall - disk_speed) };
        let free = free.max(0.0);
        let mut evaluations = 0;
        let brief = free <= SHORT_FLIGHT;
        if brief || depth > 0.0 {
            let crest = self.crest_after(phase.angle(), if brief { free } else { 0.0 });
            let bracket = self
                .bracket_of_drop(&form, crest, &mut evaluations)
                // A disk that clears its crest by a rounding error is hit by the next one.
                .or_else(|| {
                    brief.then(|| self.bracket_of_drop(&form, crest + TAU, &mut evaluations)).flatten()
                });
            if let Some(bracket) = bracket {
                let (h, velocity) = form.root(bracket, &mut evaluations)?;
                return Ok(form.landed(phase, h, velocity, evaluations));
            }
        }
        self.impact_after_arc(phase.angle(), (free, fall), velocity, evaluations)
    }

    /// The time from a phase with this angle to the first crest after `time` < 2 pi.
    fn crest_after(&self, angle: f64, time: f64) -> f64 {
        let crest = if angle < CREST { CREST - angle } else { (CREST - angle) + TAU };
        if crest > time { crest } else { crest + TAU }
    }

    /// The window of the first root up to the crest, searched over pieces of constant curvature sign; `None`
    /// if the disk clears the crest.
    fn bracket_of_drop(&self, form: &DropForm, crest: f64, evaluations: &mut u32) -> Option<Bracket> {
        let angle = form.phase.angle();
        let mut convex = self.falls_away_at(angle);
        let mut end = if convex { self.retention_angle - angle } else { self.time_to_separation(angle) };
        let mut lo = 0.0;
        let mut slope = form.velocity;
        loop {
            let hi = end.min(crest);
            let (gap, slope_at_end) = form.at(hi);
            *evaluations += 1;
            if gap <= 0.0 {
                return Some(Bracket { lo, hi });
            }
            // Only a convex piece can dip; within the rounding of 1 - P sin tau a concave piece may be
            // convex.
            if slope < 0.0
                && slope_at_end > 0.0
                && let Some(hi) = form.dip(lo, hi, evaluations)
            {
                return Some(Bracket { lo, hi });
            }
            if end >= crest {
                return None;
            }
            (lo, slope) = (end, slope_at_end);
            end += if convex { PI + 2.0 * self.separation_angle } else { PI - 2.0 * self.separation_angle };
            convex = !convex;
        }
    }
}

/// The gap of a disk that starts in the air.
#[derive(Clone, Copy)]
struct DropForm {
    phase: Phase,
    gap: f64,
    velocity: f64,
    short: ShortForm,
    long: LaunchForm,
}

impl DropForm {
    fn new(peak: f64, phase: Phase, gap: f64, velocity: f64) -> Self {
        let (sine, cosine) = (peak * phase.sin(), peak * phase.cos());
        Self {
            phase,
            gap,
            velocity,
            short: ShortForm { speed: velocity, sine, cosine, pull: 1.0 - sine },
            long: LaunchForm { angle: phase.angle(), peak, speed: velocity, sine, cosine },
        }
    }

    /// Gap and relative velocity at `t`.
    fn at(&self, t: f64) -> (f64, f64) {
        if t <= SHORT_FLIGHT {
            let (ratio, slope) = self.short.at(t);
            (self.gap + t * ratio, slope)
        } else {
            (self.gap + self.long.gap(t), self.long.slope(t))
        }
    }

    /// The gap's second derivative.
    fn curvature(&self, t: f64) -> f64 {
        if t <= SHORT_FLIGHT { self.short.curvature(t) } else { self.long.taylor(t).0.curvature }
    }

    /// The end of the parabola with the pull at the start.
    fn guess(&self) -> f64 {
        let pull = self.short.pull.max(0.0);
        // `hypot` does not underflow.
        let fall = hypot(self.velocity, (2.0 * pull).sqrt() * self.gap.sqrt());
        if self.velocity < 0.0 {
            2.0 * self.gap / (fall - self.velocity)
        } else {
            (self.velocity + fall) / pull
        }
    }

    /// The root in a bracket with exactly one, at which the gap falls through zero, and the relative velocity
    /// there.
    fn root(&self, mut bracket: Bracket, evaluations: &mut u32) -> Result<(f64, f64), Error> {
        let before = *evaluations;
        let guess = self.guess();
        let mut t = if guess > bracket.lo && guess < bracket.hi { guess } else { bracket.hi };
        loop {
            let (gap, slope) = self.at(t);
            *evaluations += 1;
            if gap > 0.0 {
                bracket.lo = t;
            } else {
                bracket.hi = t;
            }
            let step = -gap / slope;
            let next = t + step;
            let last = step.abs() <= LAST_STEP * t && next >= bracket.lo && next <= bracket.hi;
            if slope < 0.0 && last {
                return Ok((next, (slope + self.curvature(t) * step).min(0.0)));
            }
            if bracket.hi - bracket.lo <= 2.0 * f64::EPSILON * bracket.hi || bracket.hi <= f64::from_bits(1) {
                // A graze, whose velocity is rounding.
                return Ok((t, slope.min(0.0)));
            }
            if *evaluations - before >= MAX_EVALUATIONS {
                return Err(Error::NoConvergence { evaluations: *evaluations, time: t, gap });
            }
            t = if *evaluations - before >= PATIENCE {
                bracket.geometric_middle()
            } else if slope < 0.0 && next > bracket.lo && next < bracket.hi {
                next
            } else {
                0.5 * (bracket.lo + bracket.hi)
            };
        }
    }

    /// A time in (`lo`, `hi`) at which the gap is not positive, or `None`. The slope must change from
    /// negative to positive, and the piece must be convex up to rounding. Like [`GapForm::dip`], but relative
    /// to the time since the start.
    fn dip(&self, mut lo: f64, mut hi: f64, evaluations: &mut u32) -> Option<f64> {
        let before = *evaluations;
        // The time at which the curvature at the start would stop the disk.
        let stop = -self.velocity / self.curvature(0.0);
        let mut t = if stop > lo && stop < hi { stop } else { 0.5 * (lo + hi) };
        loop {
            let (gap, slope) = self.at(t);
            *evaluations += 1;
            if gap <= 0.0 {
                return Some(t);
            }
            let far = if slope < 0.0 { hi } else { lo };
            if gap + slope * (far - t) > 0.0 {
                return None;
            }
            if slope < 0.0 {
                lo = t;
            } else {
                hi = t;
            }
            let next = t - slope / self.curvature(t);
            let used = *evaluations - before;
            if (next - t).abs() <= DIP_ACCURACY * t || hi - lo <= DIP_ACCURACY * hi || used >= MAX_EVALUATIONS
            {
                return None;
            }
            t = if used >= PATIENCE {
                Bracket { lo, hi }.geometric_middle()
            } else if next > lo && next < hi {
                next
            } else {
                0.5 * (lo + hi)
            };
        }
    }

    fn landed(&self, from: Phase, h: f64, velocity: f64, evaluations: u32) -> Impact {
        if h <= SHORT_FLIGHT {
            let (phase, turns) = turned_by(from, h);
            return Impact { periods: 0, remainder: h, turns, phase, velocity, evaluations };
        }
        let (_, (sin, cos)) = self.long.taylor(h);
        landed_within_a_turn(from.angle(), Root { time: h, sin, cos, velocity, evaluations })
    }
}
