//! Cheap sufficient tests that avoid a root search; failing one proves nothing.
//!
//! **Short flights** ([`may_return_soon`]). Let a = 1 - P sin tau and b = P cos tau. Over a time t the pull on a
//! disk launched at tau is 1 - P sin(tau + t) <= a - b t + P t^2/2, so
//!
//! ```text
//! gap(t)/t >= w - (a t/2 - b t^2/6) - P t^3/24.
//! ```
//!
//! For a < 0 take a = 0. The bracket is largest at t = 3 a/(2 b) if that comes before half a radian, that is for
//! b > 3 a: there it is (3/8) a^2/b < a/8. Otherwise it is largest at t = 1/2: a/4 - b/24, which is at least a/8.
//! A launch faster than the larger of a/8 and a/4 - b/24, plus the last term at t = 1/2, cannot land within half a
//! radian. 1/24 is rounded down to 0.0416 and 1/192 up to 0.0053; for b < 0 the latter adds at least 2e-5 P more
//! than the former removes.
//!
//! **The first crest** (`Crests::surely_cleared`). Let t_c be the time to the crest, kappa the time from
//! separation to crest, u the disk's speed at launch and f its speed when it comes down to the height of the
//! crests. At the crest the disk has the speed e = u - t_c, and f^2 - e^2 is twice its height above the crest.
//! No impact occurs between half a radian and the crest
//!
//! 1. if t_c <= kappa: launched while the platform falls away, the disk moves away from it until the crest,
//!    because the gap is convex;
//!
//! 2. if e >= P cos sigma - kappa: at the separation the disk is not slower than the platform. From the
//!    launch to the separation the slope of the gap only falls (or first rises, behind the last crest), from
//!    w >= 0 to a value that is not negative; from there to the crest it rises. So the gap grows all the way.
//!    The test requires 1e-9 (1 + P) more, which is then the least slope, so that after half a radian the gap
//!    is beyond any rounding. (Behind the last crest the slope loses more in the concave piece than it gains
//!    before: w is larger still.)
//!
//! 3. if e <= 0 and f + e > 0: when the platform is at the crest, the disk is above it and falls. In the convex
//!    piece before the crest the slope is then negative throughout, and the gap larger than at its end. In the
//!    concave piece before that the gap is positive at both ends (a disk launched behind the last crest first
//!    moves away). The test requires f + e >= d = 1e-5 (1 + P), in case 2 too. The gap at the crest, (f -
//!    e)(f + e)/2 >= d^2/2, is then 5e-11 (1 + P)^2, thousands of times the rounding of u^2 <= t_c^2.
//!
//! The test leaves undecided the launches that are slower than the platform at the separation and faster at the
//! crest, and those that are hit.
//!
//! **Dips before the crest** ([`clears_by_tangents`]). Between the separation and the crest the gap is
//! convex, so it lies above the tangents at both ends. Its slopes there are u - t_s - P cos sigma and u -
//! t_c, with t_s and t_c the times to separation and crest. If the gap is positive at both ends and where the
//! tangents meet, no dip exists; all three must exceed 1e-9 (1 + P).

use crate::flight::gap::{CrestForm, SHORT_FLIGHT};
use crate::flight::platform::vibration::CLEAR;

/// The factors of the drift P cos and of P in gap(T)/T for T = [`SHORT_FLIGHT`], half a radian: T^2/6, rounded
/// down, and T^3/24, rounded up by more than that.
const DRIFT_SHARE: f64 = 0.0416;
const BEND_SHARE: f64 = 0.0053;

/// Whether a launch may land within [`SHORT_FLIGHT`], given P sin and P cos at launch. No launch that lands is
/// missed: over half a radian the pull is at most its value at launch, less its drift, plus the curvature of
/// the platform.
#[inline(always)]
pub(crate) fn may_return_soon(peak: f64, sine: f64, cosine: f64, speed: f64) -> bool {
    let pull = 1.0 - sine;
    let pull = if pull > 0.0 { pull } else { 0.0 };
    let late = (0.5 * SHORT_FLIGHT) * pull - DRIFT_SHARE * cosine;
    // The pull of a disk that is about to separate is strongest before half a radian.
    let early = (0.25 * SHORT_FLIGHT) * pull;
    speed < (if late > early { late } else { early }) + BEND_SHARE * peak
}

/// The (negative) speed with which a disk comes down to the height of the crests; NaN if it stays below them.
///
/// `disk_speed` is the speed at launch, from `depth` below the crests.
#[inline(always)]
pub(crate) fn arc_speed(disk_speed: f64, depth: f64) -> f64 {
    -(disk_speed * disk_speed - 2.0 * depth).sqrt()
}

/// Whether a launch certainly clears inflection and crest without a dip between them, given the times and gaps
/// there. A launch that fails the test may clear them too.
///
/// The gap is convex between the two. It does not dip to zero if it falls or rises all the way, or if the
/// tangents at both ends, below which a convex function cannot lie, meet at a positive gap.
#[inline(always)]
pub(crate) fn clears_by_tangents(
    peak: f64,
    separation_speed: f64,
    (inflection, at_inflection): (f64, f64),
    (crest, at_crest): (f64, f64),
    disk_speed: f64,
) -> bool {
    let first = (disk_speed - inflection) - separation_speed;
    let last = disk_speed - crest;
    let lowest = CrestForm::lowest_of_tangents(at_inflection, at_crest, first, last, crest - inflection);
    let falls_or_rises = clears(first, peak) | clears(-last, peak);
    clears(at_inflection, peak) & clears(at_crest, peak) & (falls_or_rises | clears(lowest, peak))
}

/// Whether a gap or a relative speed is positive beyond any rounding.
#[inline(always)]
pub(crate) fn clears(gap: f64, peak: f64) -> bool {
    gap > CLEAR * (1.0 + peak)
}

#[cfg(test)]
mod tests {
    use core::f64::consts::TAU;

    use super::*;
    use crate::flight::gap::LaunchForm;
    use crate::flight::launch::Launch;
    use crate::flight::platform::phase::Phase;
    use crate::flight::platform::vibration::Vibration;
    use crate::numerics::elementary::{CREST, sin_cos};
    use crate::numerics::testing::spread;

    fn vibration(k: u32) -> Vibration {
        Vibration::new(libm::exp10(4.0 * spread(k, 0.754_877_666) - 1.0)).expect("legal")
    }

    #[test]
    fn no_short_flight_is_missed() {
        let (mut short, mut spared) = (0, 0);
        for k in 0..100_000 {
            let vibration = vibration(k);
            let (p, phase) =
                (vibration.peak_acceleration(), Phase::new(TAU * spread(k, 0.569_840_29)).expect("finite"));
            // Around the bounds for an immediate return and for a disk about to separate.
            let pull = (1.0 - p * phase.sin()).max(0.0);
            let share = spread(k, 0.618_033_99);
            let speed = match k % 3 {
                0 => 0.25 * SHORT_FLIGHT * (1.0 + p) * (1.0 + share),
                1 => (0.5 * SHORT_FLIGHT * pull + 0.01 * p) * libm::exp10(-2.0 * share),
                _ => 0.375 * pull * pull / (p * phase.cos().abs()) * (0.8 + 0.3 * share),
            };
            // Without speed no disk leaves a platform that is about to catch up with it.
            if !(speed > 0.0 && speed.is_finite()) {
                continue;
            }
            let (sine, cosine) = (p * phase.sin(), p * phase.cos());
            if may_return_soon(p, sine, cosine, speed) {
                let launch = Launch::new(phase, speed).expect("legal");
                let flight = vibration.first_impact(launch).expect("lands");
                short += u32::from(flight.duration() <= SHORT_FLIGHT);
            } else {
                let form = LaunchForm { angle: phase.angle(), peak: p, speed, sine, cosine };
                for step in 1..=100 {
                    let t = SHORT_FLIGHT * f64::from(step) / 100.0;
                    assert!(form.gap(t) > 0.0, "{vibration:?} {phase:?} {speed} {t}");
                }
                spared += 1;
            }
        }
        assert!(short > 10_000 && spared > 10_000, "{short} {spared}");
    }

    /// No launch that is certain to clear the first crest touches the platform before it, at any phase and
    /// speed, unless within half a radian. Most launches that clear the crest are certain to.
    #[test]
    fn a_crest_that_is_surely_cleared_is_cleared() {
        let (mut certain, mut hit, mut doubtful) = (0, 0, 0);
        for k in 0..60_000 {
            let vibration = vibration(k);
            let p = vibration.peak_acceleration();
            let phase = Phase::new(TAU * spread(k, 0.569_840_29)).expect("finite");
            let speed = (1.0 + p) * libm::exp10(2.0 * spread(k, 0.618_033_99) - 1.5);
            let (sine, cosine) = (p * phase.sin(), p * phase.cos());
            let disk_speed = speed + cosine;
            let arc_speed = arc_speed(disk_speed, p - sine);
            let ahead = CREST - phase.angle();
            let crest = if ahead > 0.0 { ahead } else { ahead + TAU };
            let form = LaunchForm { angle: phase.angle(), peak: p, speed, sine, cosine };
            if vibration.crests.surely_cleared(p, phase.angle(), disk_speed, arc_speed) {
                certain += 1;
                // A short flight is found before the crest matters.
                if may_return_soon(p, sine, cosine, speed) {
                    continue;
                }
                for step in 0..=200 {
                    let t = SHORT_FLIGHT + (crest - SHORT_FLIGHT) * f64::from(step) / 200.0;
                    assert!(form.gap(t) > 0.0, "{vibration:?} {phase:?} {speed} {t}");
                }
            } else {
                let flight =
                    vibration.first_impact(Launch::new(phase, speed).expect("legal")).expect("lands");
                hit += u32::from(flight.duration() <= crest);
                doubtful += u32::from(flight.duration() > crest);
            }
        }
        assert!(certain > 20_000 && hit > 20_000 && doubtful < certain / 5, "{certain} {hit} {doubtful}");
    }

    #[test]
    fn no_dip_is_missed() {
        let (mut certain, mut hit) = (0, 0);
        for k in 0..20_000 {
            let vibration = vibration(k);
            let p = vibration.peak_acceleration();
            if p <= 1.0 {
                continue;
            }
            // Disks that are about as fast as the platform at its fastest, launched before the separation.
            let angle = vibration.separation_angle - 0.5 * TAU * spread(k, 0.569_840_29);
            let (sin, cos) = sin_cos(angle);
            let disk_speed = p * (0.8 + 0.6 * spread(k, 0.618_033_99));
            if disk_speed <= p * cos {
                continue;
            }
            let form = CrestForm { peak: p, angle, speed: disk_speed, depth: p - p * sin };
            let inflection = vibration.separation_angle - angle;
            let crest = CREST - angle;
            let ends = (
                (inflection, form.gap_over(vibration.separation_depth, inflection)),
                (crest, form.gap_over(0.0, crest)),
            );
            if !clears_by_tangents(p, vibration.separation_speed, ends.0, ends.1, disk_speed) {
                hit += 1;
                continue;
            }
            certain += 1;
            for step in 0..=200 {
                let t = inflection + (crest - inflection) * f64::from(step) / 200.0;
                let platform_depth = p - p * sin_cos(angle + t).0;
                assert!(form.gap_over(platform_depth, t) > 0.0, "{vibration:?} {angle} {disk_speed}");
            }
        }
        assert!(certain > 500 && hit > 500, "{certain} {hit}");
    }
}
