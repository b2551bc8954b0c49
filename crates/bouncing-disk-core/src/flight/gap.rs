//! Three forms of the gap between disk and platform, each without cancellation in its range, and the search
//! for the only root in a window.

use crate::flight::platform::vibration::Vibration;
use crate::numerics::elementary::{
    rotated, sin_cos_bounded, sine_deficit, sine_deficit_ratio, versine_ratio, versine_shortfall,
};
use crate::numerics::error::Error;

/// Longest flight (rad) solved with the series of gap(h)/h; longer ones use the phase pair.
pub(crate) const SHORT_FLIGHT: f64 = 0.5;

/// Bounds the last step (rad) times one plus its relative curvature. The remainder of the fifth-order series
/// reversal is then below 0.6 times the sixth power, 2.5e-15 rad (docs/numerics-impacts.md, "The first impact
/// is certain").
const LAST_STEP: f64 = 4.0e-3;

/// Relative size of the last Newton step on gap/h: the remaining error is its square.
const LAST_SHORT_STEP: f64 = 1.0e-9;

/// Evaluations after which the search reports [`Error::NoConvergence`]; bisection alone needs about 60.
const MAX_EVALUATIONS: u32 = 200;

/// Evaluations after which the root may be a graze, at which the gap is flat and series do not converge.
const PATIENCE: u32 = 8;

/// The duration (rad) up to which a flight lasts 2 w/(1 - P sin tau), to all digits: the terms of a further
/// evaluation would underflow.
pub(crate) const BRIEFEST: f64 = 1.0e-290;

/// Evaluations after which the search of a short flight bisects the logarithm of the time: halving would take
/// too long to approach a root tens of decades below the bracket's end.
const PATIENCE_OF_SCALE: u32 = 64;

/// Rounding error of one evaluation of the gap, relative to the sum of the sizes of its terms.
const GAP_ROUNDING: f64 = 4.5e-16;

/// A time window with exactly one root, at which the gap falls through zero.
#[derive(Clone, Copy)]
pub(crate) struct Bracket {
    pub(crate) lo: f64,
    pub(crate) hi: f64,
}

impl Bracket {
    /// A time between the ends that roughly halves the number of doubles between them. Bisection needs this if
    /// the root may be many decades below the upper end. At most 12 steps are needed to come within a factor of
    /// two of the root.
    pub(crate) fn geometric_middle(self) -> f64 {
        let arithmetic = 0.5 * (self.lo + self.hi);
        // The bits of positive doubles are ordered like the doubles.
        let (lo, hi) = (self.lo.max(0.0).to_bits(), self.hi.max(0.0).to_bits());
        let middle = f64::from_bits(lo + hi.saturating_sub(lo) / 2);
        if middle > self.lo && middle < self.hi { middle } else { arithmetic }
    }
}

/// An impact in the time of its gap form, with the phase pair and the relative velocity.
#[derive(Clone, Copy)]
pub(crate) struct Root {
    pub(crate) time: f64,
    pub(crate) sin: f64,
    pub(crate) cos: f64,
    pub(crate) velocity: f64,
    pub(crate) evaluations: u32,
}

/// The gap and its derivatives at one time; the fourth derivative is -`platform`, the fifth -`third`.
#[derive(Clone, Copy)]
pub(crate) struct GapTaylor {
    pub(crate) gap: f64,
    pub(crate) slope: f64,
    pub(crate) curvature: f64,
    /// P cos: the third derivative.
    pub(crate) third: f64,
    /// P sin: the platform's height.
    pub(crate) platform: f64,
}

impl GapTaylor {
    /// Whether the gap falls and the series reversal of [`Self::last_step`] reaches the root from here.
    ///
    /// With the Newton step x = gap/slope: |x| (1 + |curvature/slope|) and x^2 (|third| + |platform|)/|slope|
    /// are small; the second quantity bounds the terms of the third order and above. The conditions are
    /// multiplied out, because a division is slow.
    #[inline(always)]
    pub(crate) fn is_near_root(&self) -> bool {
        let (gap, fall) = (self.gap.abs(), -self.slope);
        let square = fall * fall;
        let bent = gap * (fall + self.curvature.abs()) <= LAST_STEP * square;
        let third = (gap * gap) * (self.third.abs() + self.platform.abs())
            <= (1.5 * LAST_STEP * LAST_STEP) * (square * fall);
        bent & third & (fall > 0.0)
    }

    /// A sufficient condition for [`Self::is_near_root`], tested in half the time: |x| (|s| + |c| + m) <= L |s|.
    /// Here x is the Newton step, s the slope, c the curvature, p and q the third and fourth derivatives, m =
    /// (|p| + |q|)/6 and L = [`LAST_STEP`]. Both conditions follow, since (|s| + m)^2 >= 4 |s| m implies x^2
    /// (|p| + |q|) <= L^2 s^2 (6 m)/(4 |s| m) = 3 L^2 |s|/2. For every gap m may be replaced by 0.24 P > sqrt(2)
    /// P/6.
    #[inline(always)]
    pub(crate) fn is_surely_near_root(&self, peak: f64) -> bool {
        let fall = -self.slope;
        let fall = if fall > 0.0 { fall } else { 0.0 };
        self.gap.abs() * (fall + (self.curvature.abs() + 0.24 * peak)) < (0.999 * LAST_STEP) * (fall * fall)
    }

    /// The radicand in the root of the quadratic model.
    #[inline(always)]
    pub(crate) fn radicand(&self) -> f64 {
        self.slope * self.slope - 2.0 * self.gap * self.curvature
    }

    /// The step to the root of the quadratic model, given the square `root` of its radicand, in the form that
    /// does not cancel.
    #[inline(always)]
    pub(crate) fn quadratic_step(&self, root: f64) -> f64 {
        -2.0 * self.gap / (self.slope - root)
    }

    /// The quadratic step `d` improved by one Newton step on the sixth-order polynomial, whose quadratic part
    /// has the slope -`root` there.
    #[inline(always)]
    pub(crate) fn corrected_step(&self, d: f64, root: f64) -> f64 {
        let correction = self.correction(d, root);
        if correction.abs() < 0.5 * d.abs() { d + correction } else { d }
    }

    /// [`Self::corrected_step`] with a mask instead of a selection; the result is the same except for the sign
    /// of zero.
    #[inline(always)]
    pub(crate) fn corrected_step_of_lane(&self, d: f64, root: f64) -> f64 {
        let correction = self.correction(d, root);
        d + if correction.abs() < 0.5 * d.abs() { correction } else { 0.0 }
    }

    #[inline(always)]
    fn correction(&self, d: f64, root: f64) -> f64 {
        let (third, platform) = (self.third, self.platform);
        let d2 = d * d;
        let rest = (d2 * d)
            * (((1.0 / 6.0) * third - (1.0 / 24.0) * (platform * d))
                - d2 * ((1.0 / 120.0) * third - (1.0 / 720.0) * (platform * d)));
        let rest_slope = d2 * ((0.5 * third - (1.0 / 6.0) * (platform * d)) - d2 * ((1.0 / 24.0) * third));
        rest / (root - rest_slope)
    }

    /// The step from a point near the root to the root, by series reversal to the fifth order.
    #[inline(always)]
    pub(crate) fn last_step(&self) -> f64 {
        let inverse = 1.0 / self.slope;
        self.reverted(-(self.gap * inverse), inverse)
    }

    /// The step d with gap + slope d + curvature d^2/2 + ... = 0, given the Newton step `z` = -gap/slope and
    /// `inverse` = 1/slope.
    #[inline(always)]
    pub(crate) fn reverted(&self, z: f64, inverse: f64) -> f64 {
        let a2 = 0.5 * self.curvature * inverse;
        let a3 = (1.0 / 6.0) * self.third * inverse;
        let a4 = (-1.0 / 24.0) * self.platform * inverse;
        let a5 = (-1.0 / 120.0) * self.third * inverse;
        let b = a2 * a2;
        let c3 = 2.0 * b - a3;
        let c4 = a2 * (5.0 * (a3 - b)) - a4;
        let c5 = (6.0 * a2 * a4 + 3.0 * a3 * a3) + (b * (14.0 * b - 21.0 * a3) - a5);
        let z2 = z * z;
        z + z2 * ((c3 * z - a2) + z2 * (c4 + c5 * z))
    }
}

/// A way to evaluate the gap.
pub(crate) trait GapForm: Copy {
    /// Gap and derivatives at time `t` from the form's reference, with sine and cosine of the phase there.
    fn taylor(&self, t: f64) -> (GapTaylor, (f64, f64));
    /// Relative velocity at `t`, where the phase has this cosine.
    fn velocity(&self, t: f64, cos: f64) -> f64;
    /// Bound on the rounding error of the gap at `t`.
    fn rounding(&self, t: f64) -> f64;

    /// The root in `bracket`, found from a first `guess`. The bracket must contain exactly one root, at which
    /// the gap falls through zero.
    ///
    /// Each step is the root of the quadratic model with the next two terms as a correction, kept inside the
    /// shrinking bracket by bisection; the last one is the fifth-order series reversal, whose criterion bounds
    /// the remaining error.
    #[inline(always)]
    fn root(&self, mut bracket: Bracket, guess: f64, evaluations: u32) -> Result<Root, Error> {
        let mut t = guess;
        let mut used = evaluations;
        loop {
            let (taylor, (sin, cos)) = self.taylor(t);
            used += 1;
            let GapTaylor { gap, slope, .. } = taylor;
            if taylor.is_near_root() {
                let delta = taylor.last_step();
                let time = t + delta;
                let (sin, cos) = rotated(sin, cos, delta);
                return Ok(Root { time, sin, cos, velocity: self.velocity(time, cos), evaluations: used });
            }
            if gap > 0.0 {
                bracket.lo = t;
            } else {
                bracket.hi = t;
            }
            if used >= evaluations + PATIENCE && self.is_settled(bracket, t, gap) {
                let velocity = if slope < 0.0 { slope } else { 0.0 };
                return Ok(Root { time: t, sin, cos, velocity, evaluations: used });
            }
            if used >= MAX_EVALUATIONS {
                return Err(Error::NoConvergence { evaluations: used, time: t, gap });
            }
            let radicand = taylor.radicand();
            let step = if radicand > 0.0 {
                let root = radicand.sqrt();
                taylor.corrected_step(taylor.quadratic_step(root), root)
            } else {
                -(gap * (1.0 / slope))
            };
            let next = t + step;
            t = if slope < 0.0 && next > bracket.lo && next < bracket.hi {
                next
            } else {
                0.5 * (bracket.lo + bracket.hi)
            };
        }
    }

    /// Whether the gap is pure rounding error, or the bracket two neighbouring doubles: then the impact is a
    /// graze, known to its conditioning limit.
    #[cold]
    fn is_settled(&self, bracket: Bracket, t: f64, gap: f64) -> bool {
        gap.abs() <= self.rounding(t) || bracket.hi - bracket.lo <= 4.0 * f64::EPSILON * (1.0 + bracket.hi)
    }

    /// A time in (`lo`, `hi`) at which the gap is not positive, if there is one. The piece must be convex,
    /// with a slope that changes from negative to positive.
    ///
    /// Newton steps on the slope approach the minimum; the tangents, which a convex function never crosses,
    /// end the search as soon as they prove that the minimum is positive.
    #[cold]
    fn dip(&self, mut lo: f64, mut hi: f64, evaluations: &mut u32) -> Option<f64> {
        let mut t = 0.5 * (lo + hi);
        loop {
            let (GapTaylor { gap, slope, curvature, .. }, _) = self.taylor(t);
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
            let next = t - slope / curvature;
            let next = if next > lo && next < hi { next } else { 0.5 * (lo + hi) };
            // The gap is flat at its minimum: an error d in time costs d^2 in the gap.
            if hi - lo <= 1.0e-9 || *evaluations >= MAX_EVALUATIONS {
                return None;
            }
            t = next;
        }
    }
}

/// The gap counted from the platform's crest, P [1 - sin(angle + t)] - depth + t (speed - t/2): nothing large
/// cancels however long the disk has been flying before t = 0.
#[derive(Clone, Copy)]
pub(crate) struct CrestForm {
    pub(crate) peak: f64,
    pub(crate) angle: f64,
    /// Disk speed (not relative) at t = 0.
    pub(crate) speed: f64,
    /// Disk depth below the crest at t = 0.
    pub(crate) depth: f64,
}

impl CrestForm {
    /// Gap at a time at which the platform's depth below the crest, P (1 - sin), is known in closed form.
    #[inline(always)]
    pub(crate) fn gap_over(&self, platform_depth: f64, t: f64) -> f64 {
        (platform_depth - self.depth) + t * (self.speed - 0.5 * t)
    }

    /// The height at which the tangents at both ends of a convex piece of length `end` meet: the gap lies above
    /// it.
    #[inline(always)]
    pub(crate) fn lowest_of_tangents(gap: f64, gap_at_end: f64, first: f64, last: f64, end: f64) -> f64 {
        let meet = (gap - gap_at_end + last * end) / (last - first);
        gap + first * meet
    }

    /// Gap and derivatives at `t`, where the phase has this pair.
    #[inline(always)]
    pub(crate) fn taylor_of_pair(&self, t: f64, sin: f64, cos: f64) -> GapTaylor {
        let platform = self.peak * sin;
        let third = self.peak * cos;
        GapTaylor {
            gap: ((self.peak - platform) - self.depth) + t * (self.speed - 0.5 * t),
            slope: (self.speed - t) - third,
            curvature: platform - 1.0,
            third,
            platform,
        }
    }
}

impl GapForm for CrestForm {
    #[inline(always)]
    fn taylor(&self, t: f64) -> (GapTaylor, (f64, f64)) {
        let (sin, cos) = sin_cos_bounded(self.angle + t);
        (self.taylor_of_pair(t, sin, cos), (sin, cos))
    }

    #[inline(always)]
    fn velocity(&self, t: f64, cos: f64) -> f64 {
        (self.speed - t) - self.peak * cos
    }

    fn rounding(&self, t: f64) -> f64 {
        GAP_ROUNDING * (2.0 * self.peak + self.depth.abs() + t * (self.speed.abs() + t))
    }
}

/// The gap counted from the launch, w t - t^2/2 + P [sin tau (1 - cos t) + cos tau (t - sin t)]: accurate
/// relative to its own terms, for flights that stay low.
#[derive(Clone, Copy)]
pub(crate) struct LaunchForm {
    pub(crate) angle: f64,
    pub(crate) peak: f64,
    /// Relative launch speed w.
    pub(crate) speed: f64,
    /// P sin tau and P cos tau at launch.
    pub(crate) sine: f64,
    pub(crate) cosine: f64,
}

impl LaunchForm {
    /// 1 - cos t and sin t, each with relative accuracy.
    #[inline(always)]
    fn versine_and_sine(t: f64) -> (f64, f64) {
        Self::versine_and_sine_of_half(sin_cos_bounded(0.5 * t))
    }

    /// 1 - cos t and sin t from the pair of t/2.
    #[inline(always)]
    pub(crate) fn versine_and_sine_of_half((half_sin, half_cos): (f64, f64)) -> (f64, f64) {
        (2.0 * half_sin * half_sin, 2.0 * half_sin * half_cos)
    }

    /// The gap alone.
    pub(crate) fn gap(&self, t: f64) -> f64 {
        self.gap_of(t, Self::versine_and_sine(t))
    }

    /// The relative velocity.
    pub(crate) fn slope(&self, t: f64) -> f64 {
        self.slope_of(t, Self::versine_and_sine(t))
    }

    /// The gap at `t`, with 1 - cos t and sin t known.
    #[inline(always)]
    pub(crate) fn gap_of(&self, t: f64, (versine, sin_t): (f64, f64)) -> f64 {
        t * (self.speed - 0.5 * t) + (self.sine * versine + self.cosine * sine_deficit(t, sin_t))
    }

    /// The relative velocity at `t`, with 1 - cos t and sin t known.
    #[inline(always)]
    pub(crate) fn slope_of(&self, t: f64, (versine, sin_t): (f64, f64)) -> f64 {
        (self.speed - t) + (self.cosine * versine + self.sine * sin_t)
    }

    /// Gap and derivatives at `t`, with the pair of the phase there, and 1 - cos t and sin t, known.
    #[inline(always)]
    pub(crate) fn taylor_of_pairs(&self, t: f64, (sin, cos): (f64, f64), of_time: (f64, f64)) -> GapTaylor {
        let platform = self.peak * sin;
        GapTaylor {
            gap: self.gap_of(t, of_time),
            slope: self.slope_of(t, of_time),
            curvature: platform - 1.0,
            third: self.peak * cos,
            platform,
        }
    }
}

impl GapForm for LaunchForm {
    #[inline(always)]
    fn taylor(&self, t: f64) -> (GapTaylor, (f64, f64)) {
        let pair = sin_cos_bounded(self.angle + t);
        (self.taylor_of_pairs(t, pair, Self::versine_and_sine(t)), pair)
    }

    fn velocity(&self, t: f64, _cos: f64) -> f64 {
        self.slope(t)
    }

    fn rounding(&self, t: f64) -> f64 {
        let (versine, sin_t) = Self::versine_and_sine(t);
        let sides = self.sine.abs() * versine + self.cosine.abs() * sine_deficit(t, sin_t);
        GAP_ROUNDING * (t * (self.speed + 0.5 * t) + sides)
    }
}

/// Largest speed of a [brief](is_brief) launch, for any pull on the disk: the pull is below 1 + P.
pub(crate) const FASTEST_BRIEF: f64 = BRIEFEST * Vibration::MAX_PEAK_ACCELERATION;

/// Whether a launch with `speed` against `pull` returns within [`BRIEFEST`].
#[inline(always)]
pub(crate) fn is_brief(speed: f64, pull: f64) -> bool {
    speed < 0.5 * BRIEFEST * pull
}

/// gap(h)/h for h up to [`SHORT_FLIGHT`], with relative accuracy: the launch itself is divided out.
#[derive(Clone, Copy)]
pub(crate) struct ShortForm {
    pub(crate) speed: f64,
    /// P sin tau and P cos tau at launch.
    pub(crate) sine: f64,
    pub(crate) cosine: f64,
    /// 1 - P sin tau, the pull of the platform on the disk at launch.
    pub(crate) pull: f64,
}

impl ShortForm {
    /// (gap(h)/h, relative velocity at h).
    #[inline(always)]
    pub(crate) fn at(&self, h: f64) -> (f64, f64) {
        let shortfall = versine_shortfall(h);
        let deficit = sine_deficit_ratio(h);
        let h2 = h * h;
        // sin tau (1 - cos h)/h is split at 1/2 so that P sin tau = 1 cancels exactly.
        let ratio =
            self.speed - h * (0.5 * self.pull + self.sine * (h2 * shortfall)) + self.cosine * (h2 * deficit);
        let versine = 0.5 - h2 * shortfall;
        let velocity =
            self.speed - h * self.pull + (self.cosine * (h2 * versine) - self.sine * (h2 * h * deficit));
        (ratio, velocity)
    }

    /// The gap's second derivative at h.
    #[inline(always)]
    pub(crate) fn curvature(&self, h: f64) -> f64 {
        let h2 = h * h;
        let sin_h = h - h2 * h * sine_deficit_ratio(h);
        (self.cosine * sin_h - self.pull) - self.sine * (h2 * versine_ratio(h))
    }

    /// Whether the error left by this Newton step is below rounding.
    #[inline(always)]
    pub(crate) fn is_last(step: f64, h: f64, slope: f64) -> bool {
        (step.abs() <= LAST_SHORT_STEP * h) & (slope < 0.0)
    }

    /// The relative velocity after a last `step` from `h`, given the `velocity` at `h`; never positive.
    #[inline(always)]
    pub(crate) fn impact_velocity(&self, h: f64, velocity: f64, step: f64) -> f64 {
        let impact = velocity + self.curvature(h) * step;
        if impact < 0.0 { impact } else { 0.0 }
    }

    /// The duration of a flight such as the first of a chattering sequence, from the expansion in the launch
    /// speed.
    #[inline(always)]
    pub(crate) fn expected(&self) -> f64 {
        let inverse = 1.0 / self.pull;
        let x = self.speed * inverse;
        let beta = self.cosine * inverse;
        // (a - 1)/a with a - 1 = -P sin tau.
        let gamma = -self.sine * inverse;
        2.0 * x * (1.0 + x * ((2.0 / 3.0) * beta + x * ((1.0 / 3.0) * gamma + (8.0 / 9.0) * (beta * beta))))
    }

    /// The root in (0, `end`) of a flight that starts in a concave piece that reaches to `end`. There gap/h
    /// has at most one root, so the root found by Newton's iteration is the first. `None` if the iteration
    /// does not find one at once.
    #[inline(always)]
    pub(crate) fn root_in_first_piece(&self, end: f64, evaluations: &mut u32) -> Option<(f64, f64)> {
        let mut h = self.expected();
        for _ in 0..4 {
            if !(h > 0.0 && h < end) {
                return None;
            }
            let (ratio, velocity) = self.at(h);
            *evaluations += 1;
            let slope = velocity - ratio;
            let step = -ratio * h / slope;
            if Self::is_last(step, h, slope) {
                return Some((h + step, self.impact_velocity(h, velocity, step)));
            }
            h += step;
        }
        None
    }

    /// The root of gap(h)/h in a bracket that contains exactly one, and the relative velocity there.
    pub(crate) fn root(&self, mut bracket: Bracket, evaluations: &mut u32) -> Result<(f64, f64), Error> {
        let mut h = 0.5 * (bracket.lo + bracket.hi);
        let before = *evaluations;
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
            if Self::is_last(step, h, slope) {
                return Ok((next, self.impact_velocity(h, velocity, step)));
            }
            if bracket.hi - bracket.lo <= 2.0 * f64::EPSILON * bracket.hi || bracket.hi <= f64::from_bits(1) {
                return Ok((h, velocity.min(0.0)));
            }
            if *evaluations >= MAX_EVALUATIONS {
                return Err(Error::NoConvergence { evaluations: *evaluations, time: h, gap: ratio * h });
            }
            h = if *evaluations - before >= PATIENCE_OF_SCALE {
                bracket.geometric_middle()
            } else if slope < 0.0 && next > bracket.lo && next < bracket.hi {
                next
            } else {
                0.5 * (bracket.lo + bracket.hi)
            };
        }
    }

    /// A time in (`lo`, `hi`) at which the gap is not positive, or `None`: like [`GapForm::dip`], by
    /// bisection.
    #[cold]
    pub(crate) fn dip(&self, mut lo: f64, mut hi: f64, evaluations: &mut u32) -> Option<f64> {
        while hi - lo > 1.0e-9 * hi && *evaluations < MAX_EVALUATIONS {
            let middle = 0.5 * (lo + hi);
            *evaluations += 1;
            let (ratio, slope) = self.at(middle);
            let gap = ratio * middle;
            if gap <= 0.0 {
                return Some(middle);
            }
            let far = if slope < 0.0 { hi } else { lo };
            if gap + slope * (far - middle) > 0.0 {
                return None;
            }
            if slope < 0.0 {
                lo = middle;
            } else {
                hi = middle;
            }
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::testing::spread;

    /// Taylor coefficients of gaps of every size, above platforms of every strength.
    fn taylors() -> impl Iterator<Item = (f64, GapTaylor)> {
        (0..400_000).map(|k| {
            let peak = libm::exp10(4.0 * spread(k, 0.754_877_666) - 1.0);
            let (sin, cos) = sin_cos_bounded(core::f64::consts::TAU * spread(k, 0.569_840_29));
            let slope = (1.0 + peak) * (0.2 - 2.0 * spread(k, 0.618_033_99));
            let gap =
                slope * libm::exp10(-4.0 * spread(k, 0.819_172_513)) * if k % 2 == 0 { 1.0 } else { -1.0 };
            let (platform, third) = (peak * sin, peak * cos);
            (peak, GapTaylor { gap, slope, curvature: platform - 1.0, third, platform })
        })
    }

    #[test]
    fn a_root_that_is_surely_near_is_near() {
        let (mut surely, mut near) = (0, 0);
        for (peak, taylor) in taylors() {
            assert!(!taylor.is_surely_near_root(peak) || taylor.is_near_root());
            surely += u32::from(taylor.is_surely_near_root(peak));
            near += u32::from(taylor.is_near_root());
        }
        assert!(near > 100_000 && surely > near - near / 10, "{surely} of {near}");
        // A gap that does not fall has no root ahead, however small it is.
        let flat = GapTaylor { gap: 0.0, slope: 0.0, curvature: -1.0, third: 0.0, platform: 0.0 };
        assert!(!flat.is_near_root() && !flat.is_surely_near_root(1.0));
    }

    /// At the largest gap of either sign that the quick test accepts, at which its two estimates are nearly
    /// equalities: for the first condition on a still platform, for the second near P = sqrt(2) and 45
    /// degrees, where the curvature vanishes.
    #[test]
    fn the_quick_test_is_right_up_to_its_limit() {
        let mut limits = 0;
        for k in 0..20_000 {
            let still = k % 4 == 0;
            let peak = if still { 0.0 } else { 1.3 + 0.25 * spread(k, 0.754_877_666) };
            let (sin, cos) = sin_cos_bounded(0.65 + 0.3 * spread(k, 0.569_840_29));
            let slope = if still { -10.0 } else { -0.2 - 0.3 * spread(k, 0.618_033_99) };
            let (platform, third) = (peak * sin, peak * cos);
            let taylor = |gap: f64| GapTaylor { gap, slope, curvature: platform - 1.0, third, platform };
            let (mut accepted, mut refused) = (0.0, 1.0);
            while refused - accepted > 1e-12 * refused {
                let middle = 0.5 * (accepted + refused);
                if taylor(middle).is_surely_near_root(peak) {
                    accepted = middle;
                } else {
                    refused = middle;
                }
            }
            assert!(
                taylor(accepted).is_near_root() && taylor(-accepted).is_near_root(),
                "{peak} {slope} {accepted}"
            );
            // The test is effective: it accepts nearly all points near the root.
            limits += u32::from(!taylor(1.06 * accepted).is_near_root());
        }
        assert!(limits > 1_000, "{limits}");
    }

    #[test]
    fn steps_of_lanes_are_those_of_single_flights() {
        let mut corrected = 0;
        for (_, taylor) in taylors() {
            let root = taylor.radicand().sqrt();
            let step = taylor.quadratic_step(root);
            let (alone, lane) =
                (taylor.corrected_step(step, root), taylor.corrected_step_of_lane(step, root));
            assert!(alone.to_bits() == lane.to_bits() || (alone.is_nan() && lane.is_nan()), "{alone} {lane}");
            corrected += u32::from(alone.to_bits() != step.to_bits() && !alone.is_nan());
        }
        assert!(corrected > 100_000, "{corrected}");
    }
}
