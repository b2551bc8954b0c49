//! Elementary functions with the same bits on every machine.
//!
//! The sine and cosine pair of the impact solver is our own code, because it determines the speed of every
//! computation; all other functions are from the `libm` crate. Only IEEE addition, subtraction,
//! multiplication, division and square root are used, in a fixed order and never fused.

#![expect(clippy::excessive_precision, reason = "constants are quoted as their sources print them")]

use core::f64::consts::{FRAC_PI_2, TAU};

/// Largest argument of [`sin_cos`] that the fast reduction accepts, in radians.
const FAST_REDUCTION_LIMIT: f64 = 1.0e5;

/// 1.5 * 2^52: adding it rounds a double to the nearest integer and leaves that integer in the low bits.
const ROUND_MAGIC: f64 = 6_755_399_441_055_744.0;

/// The first 33 bits of pi/2, so that its product with a small integer is exact.
const FRAC_PI_2_HEAD: f64 = 1.570_796_326_734_125_614_17;
/// The next 33 bits of pi/2.
const FRAC_PI_2_MIDDLE: f64 = 6.077_100_506_303_965_976_6e-11;
/// The rest of pi/2.
const FRAC_PI_2_TAIL: f64 = 2.022_266_248_795_950_631_54e-21;

/// The first 25 bits of 2 pi, so that its product with a period count below 2^28 is exact.
const TAU_HEAD: f64 = 6.283_185_243_606_567;
/// The rest of 2 pi.
const TAU_TAIL: f64 = 6.357_301_909_411_279e-8;

/// Largest argument of [`sin_cos_bounded`], in radians.
const BOUND: f64 = 100.0;

/// Sine and cosine of `x` radians; absolute error below 1.3e-16 for |x| up to 20 and below 1.5e-16 up to 1e5;
/// for larger |x| the `libm` crate is used.
#[must_use]
#[inline]
pub fn sin_cos(x: f64) -> (f64, f64) {
    if x.abs() <= BOUND {
        sin_cos_bounded(x)
    } else if x.abs() <= FAST_REDUCTION_LIMIT {
        let (n, quadrant) = nearest_quarter_turns(x);
        let head = (x - n * FRAC_PI_2_HEAD) - n * FRAC_PI_2_MIDDLE;
        sin_cos_reduced(head - n * FRAC_PI_2_TAIL, quadrant)
    } else {
        libm::sincos(x)
    }
}

/// Sine and cosine for |x| up to 100 rad, without a branch (Cody and Waite reduction; its third part would
/// add less than 2e-19).
#[inline(always)]
pub(crate) fn sin_cos_bounded(x: f64) -> (f64, f64) {
    let (n, quadrant) = nearest_quarter_turns(x);
    sin_cos_reduced((x - n * FRAC_PI_2_HEAD) - n * FRAC_PI_2_MIDDLE, quadrant)
}

/// The nearest whole number of quarter turns, as a double and as bits, of which the lowest two matter.
#[inline(always)]
fn nearest_quarter_turns(x: f64) -> (f64, u64) {
    let shifted = x * core::f64::consts::FRAC_2_PI + ROUND_MAGIC;
    (shifted - ROUND_MAGIC, shifted.to_bits())
}

/// Sine and cosine of `r` in [-pi/4, pi/4] plus `quadrant` quarter turns.
#[inline(always)]
fn sin_cos_reduced(r: f64, quadrant: u64) -> (f64, f64) {
    let (sine, cosine) = pair_polynomials(r);
    // Quadrant q: (sin, cos) is (s, c), (c, -s), (-s, -c), (-c, s).
    let swap = quadrant & 1 == 1;
    let (s, c) = if swap { (cosine, sine) } else { (sine, cosine) };
    let s = if quadrant & 2 == 0 { s } else { -s };
    let c = if quadrant.wrapping_add(1) & 2 == 0 { c } else { -c };
    (s, c)
}

/// [`sin_cos_bounded`], bit for bit, with integer operations instead of selections: every instruction set
/// offers these for many lanes at once.
#[inline(always)]
pub(crate) fn sin_cos_of_lane(x: f64) -> (f64, f64) {
    let (r, quadrant) = reduced_of_lane(x);
    sin_cos_of_reduced(r, quadrant, false)
}

/// The angle minus the nearest whole number of quarter turns, and that number.
#[inline(always)]
pub(crate) fn reduced_of_lane(x: f64) -> (f64, u64) {
    let (n, quadrant) = nearest_quarter_turns(x);
    ((x - n * FRAC_PI_2_HEAD) - n * FRAC_PI_2_MIDDLE, quadrant)
}

/// The second part of [`sin_cos_of_lane`], with the same bits with selections (`blends`) or without.
#[inline(always)]
pub(crate) fn sin_cos_of_reduced(r: f64, quadrant: u64, blends: bool) -> (f64, f64) {
    let (sine, cosine) = pair_polynomials(r);
    // Quadrant q: the pair is swapped if q is odd; the signs are given by the bits 1, and 1 xor 0.
    let (odd, second) = (quadrant << 63, (quadrant << 62) & (1 << 63));
    let (s, c) = if blends {
        // A vector selection depends on the sign alone.
        if (odd as i64) < 0 { (cosine, sine) } else { (sine, cosine) }
    } else {
        let (sine, cosine) = (sine.to_bits(), cosine.to_bits());
        let swapped = (sine ^ cosine) & 0_u64.wrapping_sub(quadrant & 1);
        (f64::from_bits(sine ^ swapped), f64::from_bits(cosine ^ swapped))
    };
    (f64::from_bits(s.to_bits() ^ second), f64::from_bits(c.to_bits() ^ (second ^ odd)))
}

/// Sine and cosine of `r` in [-pi/4, pi/4]: the minimax polynomials of FreeBSD's `k_sin.c` and `k_cos.c`,
/// summed as z A + z^2 B + z^3 C to keep the chains short.
#[inline(always)]
fn pair_polynomials(r: f64) -> (f64, f64) {
    let z = r * r;
    let z2 = z * z;
    let rz = r * z;
    let z4 = z2 * z2;
    let half = 0.5 * z;
    let head = 1.0 - half;
    let lost = (1.0 - head) - half;
    let cosine_low = 4.166_666_666_666_660_190_37e-2 - z * 1.388_888_888_887_410_957_49e-3;
    let cosine_middle = 2.480_158_728_947_672_941_78e-5 - z * 2.755_731_435_139_066_330_35e-7;
    let cosine_high = 2.087_572_321_298_174_827_90e-9 - z * 1.135_964_755_778_819_482_65e-11;
    let cosine = head + ((lost + z2 * cosine_low) + (z4 * cosine_middle + (z4 * z2) * cosine_high));
    let sine_low = z * 8.333_333_333_322_489_461_24e-3 - 1.666_666_666_666_663_243_48e-1;
    let sine_middle = z * 2.755_731_370_707_006_767_89e-6 - 1.984_126_982_985_794_931_34e-4;
    let sine_high = z * 1.589_690_995_211_550_102_21e-10 - 2.505_076_025_340_686_341_95e-8;
    let sine = r + rz * ((sine_low + z2 * sine_middle) + z4 * sine_high);
    (sine, cosine)
}

/// Sine and cosine of `angle + delta` from sine and cosine of `angle`, for |delta| up to 4e-3 rad (truncation
/// error below 6e-18).
#[inline(always)]
pub(crate) fn rotated(sin: f64, cos: f64, delta: f64) -> (f64, f64) {
    let d2 = delta * delta;
    let versine = d2 * (0.5 - d2 * (1.0 / 24.0));
    let sine = delta - (delta * d2) * (1.0 / 6.0 - d2 * (1.0 / 120.0));
    (sin + (cos * sine - sin * versine), cos - (sin * sine + cos * versine))
}

/// (1/2 - (1 - cos h) / h^2) / h^2 for |h| up to 1/2; relative error below 2e-16.
#[inline(always)]
pub(crate) fn versine_shortfall(h: f64) -> f64 {
    let z = h * h;
    1.0 / 24.0
        - z * (1.0 / 720.0
            - z * (1.0 / 40_320.0
                - z * (1.0 / 3_628_800.0 - z * (1.0 / 479_001_600.0 - z * (1.0 / 87_178_291_200.0)))))
}

/// (1 - cos h) / h^2 for |h| up to 1/2; relative error below 2e-16.
#[must_use]
#[inline(always)]
pub fn versine_ratio(h: f64) -> f64 {
    0.5 - h * h * versine_shortfall(h)
}

/// h - sin h for h in [0, 2 pi], with relative accuracy, given sin h.
#[must_use]
#[inline(always)]
pub fn sine_deficit(h: f64, sin_h: f64) -> f64 {
    // The Taylor series up to h^23/23!, 6e-18 of the sum at 1.7.
    let z = h * h;
    let z2 = z * z;
    let low = (1.0 / 6.0 - z * (1.0 / 120.0)) + z2 * (1.0 / 5_040.0 - z * (1.0 / 362_880.0));
    let middle = (1.0 / 39_916_800.0 - z * (1.0 / 6_227_020_800.0))
        + z2 * (1.0 / 1_307_674_368_000.0 - z * (1.0 / 3.556_874_280_96e14));
    let high = (1.0 / 1.216_451_004_088_32e17 - z * (1.0 / 5.109_094_217_170_944e19))
        + z2 * (1.0 / 2.585_201_673_888_498e22);
    let z4 = z2 * z2;
    let series = (h * z) * (low + z4 * (middle + z4 * high));
    if h > 1.7 { h - sin_h } else { series }
}

/// (h - sin h) / h^3 for |h| up to 1/2; relative error below 2e-16.
#[must_use]
#[inline(always)]
pub fn sine_deficit_ratio(h: f64) -> f64 {
    let z = h * h;
    1.0 / 6.0
        - z * (1.0 / 120.0
            - z * (1.0 / 5_040.0
                - z * (1.0 / 362_880.0
                    - z * (1.0 / 39_916_800.0
                        - z * (1.0 / 6_227_020_800.0 - z * (1.0 / 1_307_674_368_000.0))))))
}

/// Splits a non-negative duration in radians, at most 1.6e9, into the nearest whole number of periods and the
/// rest, in [-pi, pi].
///
/// The error of the remainder is at most 5e-16 + 2e-24 duration (two-part reduction), in addition to the
/// rounding of `duration` itself.
#[inline(always)]
pub fn nearest_periods(duration: f64) -> (f64, f64) {
    let periods = (duration * (1.0 / TAU) + ROUND_MAGIC) - ROUND_MAGIC;
    let rest = (duration - periods * TAU_HEAD) - periods * TAU_TAIL;
    (periods, rest)
}

/// Reduces an angle in [-2 pi, 6 pi] to [0, 2 pi), without a branch that depends on the turn. Also returns
/// the number of turns removed (negative if added).
#[inline(always)]
pub(crate) fn nearby_wrapped(angle: f64) -> (f64, f64) {
    let turns = ((angle * (1.0 / TAU) - 0.5) + ROUND_MAGIC) - ROUND_MAGIC;
    let wrapped = angle - turns * TAU;
    // Only at the seam itself can rounding leave the interval.
    if wrapped < 0.0 {
        (wrapped + TAU, turns - 1.0)
    } else if wrapped >= TAU {
        (wrapped - TAU, turns + 1.0)
    } else {
        (wrapped, turns)
    }
}

/// [`nearby_wrapped`], bit for bit except for an angle of -0, without a branch at the seam.
#[inline(always)]
pub(crate) fn nearby_wrapped_of_lane(angle: f64) -> (f64, f64) {
    let turns = ((angle * (1.0 / TAU) - 0.5) + ROUND_MAGIC) - ROUND_MAGIC;
    let wrapped = angle - turns * TAU;
    let share = |of: f64| {
        let (below, above) = (if wrapped < 0.0 { of } else { 0.0 }, if wrapped >= TAU { of } else { 0.0 });
        below - above
    };
    (wrapped + share(TAU), turns - share(1.0))
}

/// The phase of an impact in [0, 2 pi), and the number of turns removed, from its unwrapped angle in [-2 pi,
/// 6 pi].
///
/// It differs from [`nearby_wrapped`] only at the seam: an angle below zero by less than half the spacing of
/// doubles below 2 pi rounds to 2 pi itself. This is phase 0 of the next turn, and the turn counts.
#[inline(always)]
pub(crate) fn impact_phase(angle: f64) -> (f64, f64) {
    let (wrapped, turns) = nearby_wrapped(angle);
    if wrapped < TAU { (wrapped, turns) } else { (0.0, turns + 1.0) }
}

/// [`impact_phase`], bit for bit, without a branch.
#[inline(always)]
pub(crate) fn impact_phase_of_lane(angle: f64) -> (f64, f64) {
    let (wrapped, turns) = nearby_wrapped_of_lane(angle);
    (if wrapped < TAU { wrapped } else { 0.0 }, turns + if wrapped < TAU { 0.0 } else { 1.0 })
}

/// The nearest whole number to `x`, for |x| below 2^51.
#[inline(always)]
pub fn nearest_whole(x: f64) -> f64 {
    (x + ROUND_MAGIC) - ROUND_MAGIC
}

/// Reduces any finite angle to [0, 2 pi).
#[must_use]
pub fn wrapped_angle(angle: f64) -> f64 {
    if (0.0..TAU).contains(&angle) {
        return angle;
    }
    let wrapped = libm::fmod(angle, TAU);
    let wrapped = if wrapped < 0.0 { wrapped + TAU } else { wrapped };
    if wrapped < TAU { wrapped } else { 0.0 }
}

/// Arc sine in radians, argument in [-1, 1].
#[must_use]
pub fn asin(x: f64) -> f64 {
    libm::asin(x)
}

/// Arc cosine in radians, argument in [-1, 1].
#[must_use]
pub fn acos(x: f64) -> f64 {
    libm::acos(x)
}

/// The angle of the point (`x`, `y`) in radians, in (-pi, pi].
#[must_use]
pub fn atan2(y: f64, x: f64) -> f64 {
    libm::atan2(y, x)
}

/// Arc tangent in radians.
#[must_use]
pub fn atan(x: f64) -> f64 {
    libm::atan(x)
}

/// Tangent of an angle in radians.
#[must_use]
pub fn tan(x: f64) -> f64 {
    libm::tan(x)
}

/// Sine of any finite angle in radians.
#[must_use]
pub fn sin(x: f64) -> f64 {
    sin_cos(x).0
}

/// Cosine of any finite angle in radians.
#[must_use]
pub fn cos(x: f64) -> f64 {
    sin_cos(x).1
}

/// Exponential function.
#[must_use]
pub fn exp(x: f64) -> f64 {
    libm::exp(x)
}

/// exp(x) - 1, accurate near zero.
#[must_use]
pub fn exp_m1(x: f64) -> f64 {
    libm::expm1(x)
}

/// Natural logarithm.
#[must_use]
pub fn ln(x: f64) -> f64 {
    libm::log(x)
}

/// ln(1 + x), accurate near zero.
#[must_use]
pub fn ln_1p(x: f64) -> f64 {
    libm::log1p(x)
}

/// `base` to the power `exponent`.
#[must_use]
pub fn pow(base: f64, exponent: f64) -> f64 {
    libm::pow(base, exponent)
}

/// Length of the vector (`x`, `y`).
#[must_use]
pub fn hypot(x: f64, y: f64) -> f64 {
    libm::hypot(x, y)
}

/// pi/2: the platform's crest.
pub(crate) const CREST: f64 = FRAC_PI_2;

#[cfg(test)]
mod tests {
    use super::*;
    use dashu_float::FBig;
    use dashu_float::round::mode::HalfEven;

    type High = FBig<HalfEven, 2>;

    fn high(x: f64) -> High {
        High::try_from(x).unwrap().with_precision(160).value()
    }

    fn error(value: f64, exact: &High) -> f64 {
        (high(value) - exact).to_f64().value().abs()
    }

    fn relative_error(value: f64, exact: &High) -> f64 {
        error(value, exact) / exact.to_f64().value().abs()
    }

    /// Evenly spread numbers in [0, 1).
    fn spread(count: u32) -> impl Iterator<Item = f64> {
        (0..count).map(|k| f64::from(k) * 0.618_033_988_749_894_9 % 1.0)
    }

    #[test]
    fn a_pair_is_rotated_without_loss() {
        for (k, share) in spread(300).enumerate() {
            let angle = TAU * share;
            let delta = (f64::from(k as u32) - 150.0) * 2.6e-5;
            let (s, c) = sin_cos(angle);
            let (sin, cos) = rotated(s, c, delta);
            let (exact_sin, exact_cos) = (high(angle) + high(delta)).sin_cos();
            assert!(error(sin, &exact_sin) < 2.6e-16, "{angle} + {delta}");
            assert!(error(cos, &exact_cos) < 2.6e-16, "{angle} + {delta}");
        }
    }

    #[test]
    fn a_pair_has_the_same_bits_with_selections_or_without() {
        for share in spread(20_000) {
            let x = 2.0 * BOUND * (share - 0.5);
            let (r, quadrant) = reduced_of_lane(x);
            let (s, c) = sin_cos_bounded(x);
            for blends in [false, true] {
                let (sin, cos) = sin_cos_of_reduced(r, quadrant, blends);
                assert_eq!((sin.to_bits(), cos.to_bits()), (s.to_bits(), c.to_bits()), "{x} {blends}");
            }
        }
    }

    #[test]
    fn angles_next_to_the_seam_are_wrapped_alike() {
        for turn in -1..=3 {
            let seam = f64::from(turn) * TAU;
            for step in -200..=200 {
                let angle = seam + 0.25 * f64::EPSILON * f64::from(step);
                let (alone, lane) = (nearby_wrapped(angle), nearby_wrapped_of_lane(angle));
                assert_eq!((alone.0.to_bits(), alone.1), (lane.0.to_bits(), lane.1), "{angle:e}");
            }
        }
    }

    #[test]
    fn short_series_are_relative() {
        for share in spread(300) {
            let h = if share < 0.5 { share + 1.0e-9 } else { libm::exp10(-20.0 * share) };
            let x = High::try_from(h).unwrap().with_precision(400).value();
            let one = high(1.0);
            let (s, c) = x.sin_cos();
            let square = &x * &x;
            let versine = (&one - c) / &square;
            assert!(relative_error(versine_ratio(h), &versine) < 2.3e-16, "{h}");
            let deficit = (&x - s) / (&square * &x);
            assert!(relative_error(sine_deficit_ratio(h), &deficit) < 2.3e-16, "{h}");
        }
    }

    #[test]
    fn angles_are_wrapped() {
        assert_eq!(wrapped_angle(-1.0e-30).to_bits(), 0);
        assert_eq!(wrapped_angle(TAU).to_bits(), 0);
        assert_eq!(wrapped_angle(TAU.next_down()).to_bits(), TAU.next_down().to_bits());
        for share in spread(300) {
            let angle = 400.0 * (share - 0.5);
            let (wrapped, again) = (wrapped_angle(angle), wrapped_angle(wrapped_angle(angle)));
            assert!((0.0..TAU).contains(&wrapped) && wrapped.to_bits() == again.to_bits(), "{angle}");
        }
    }

    #[test]
    fn near_angles_are_wrapped_with_their_turns() {
        for share in spread(300) {
            let angle = 0.4999 * TAU * (4.0 * share - 1.0);
            let (wrapped, turns) = nearby_wrapped(angle);
            assert!((0.0..=TAU).contains(&wrapped), "{angle}");
            assert!((wrapped + turns * TAU - angle).abs() <= 1.0e-15, "{angle}");
        }
    }

    #[test]
    fn whole_periods_are_taken_off_exactly() {
        let two_pi = High::pi(240) * High::from(2);
        for share in spread(300) {
            let duration = libm::exp10(9.2 * share);
            let (periods, rest) = nearest_periods(duration);
            let exact = high(duration) - &two_pi * high(periods);
            assert!(rest.abs() <= 3.2 && periods >= 0.0, "{duration}");
            // One rounding of the rest, and one of the tail's product, which grows with the periods.
            let tolerance = 5.0e-16 + 2.0e-24 * duration;
            assert!(error(rest, &exact) <= tolerance, "{duration}: {:e}", error(rest, &exact));
        }
    }

    #[test]
    fn the_deficit_of_the_sine_is_relative() {
        for share in spread(300) {
            let h = 8.0 * share + 1.0e-6;
            let x = high(h);
            let exact = &x - x.sin();
            assert!(relative_error(sine_deficit(h, sin_cos(h).0), &exact) < 6.0e-16, "{h}");
        }
    }
}
