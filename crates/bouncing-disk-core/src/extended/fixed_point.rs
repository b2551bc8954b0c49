//! Numbers with a fixed number of bits behind the point, as many as are asked for.
//!
//! What an orbit needs is bounded and wanted to an absolute accuracy, so that whole numbers do: a number x is
//! the whole number next to x 2^bits. Multiplication is `dashu-int`'s; sine, cosine and pi are here.

use dashu_int::{IBig, Sign};

/// Bits beyond those asked for, within sine and cosine: for the roundings of a thousand terms and of the
/// doublings.
const GUARD_BITS: usize = 32;

/// The arithmetic of numbers with so many bits behind the point.
#[derive(Debug, Clone)]
pub(super) struct FixedPoint {
    bits: usize,
    /// pi with [`GUARD_BITS`] and 64 bits more.
    pi: IBig,
}

/// Bits of pi beyond those of the numbers.
const BITS_OF_PI: usize = GUARD_BITS + 64;

/// atan(1/x) times 2^bits, by its series.
fn arc_tangent_of_inverse(x: u32, bits: usize) -> IBig {
    let mut power = (IBig::ONE << bits) / x;
    let mut sum = power.clone();
    let mut k = 1_u32;
    while !power.is_zero() {
        power /= x * x;
        k += 2;
        if k % 4 == 3 {
            sum -= &power / k;
        } else {
            sum += &power / k;
        }
    }
    sum
}

/// A double times 2^bits, rounded down.
pub(super) fn scaled(value: f64, bits: usize) -> IBig {
    let exponent = ((value.to_bits() >> 52) & 0x7ff) as i64;
    let fraction = (value.to_bits() & ((1 << 52) - 1)) as i64;
    let mantissa = if exponent == 0 { fraction } else { fraction | (1 << 52) };
    let shift = exponent.max(1) - 1_075 + bits as i64;
    let magnitude = IBig::from(mantissa);
    let magnitude =
        if shift >= 0 { magnitude << shift as usize } else { magnitude >> shift.unsigned_abs() as usize };
    if value < 0.0 { -magnitude } else { magnitude }
}

/// 2 to a power from -1,022 on; nothing below.
fn power_of_two(exponent: i64) -> f64 {
    if exponent < -1_022 { 0.0 } else { f64::from_bits(((exponent + 1_023) as u64) << 52) }
}

impl FixedPoint {
    /// Numbers with so many bits.
    pub(super) fn new(bits: usize) -> Self {
        let of_pi = bits + BITS_OF_PI;
        // J. Machin's sum. Every term is rounded: fewer than 2^20 of them, in bits that are taken off again.
        let spare = 32;
        let sum =
            arc_tangent_of_inverse(5, of_pi + spare) * 16 - arc_tangent_of_inverse(239, of_pi + spare) * 4;
        Self { bits, pi: sum >> spare }
    }

    /// The same with fewer bits.
    pub(super) fn with_fewer(&self, bits: usize) -> Self {
        Self { bits, pi: &self.pi >> (self.bits - bits) }
    }

    pub(super) const fn bits(&self) -> usize {
        self.bits
    }

    /// The number that a double is; what lies below the last bit is cut off.
    pub(super) fn number(&self, value: f64) -> IBig {
        scaled(value, self.bits)
    }

    /// The nearest double but for a rounding.
    pub(super) fn value(&self, number: &IBig) -> f64 {
        let (sign, words) = number.as_sign_words();
        let Some(&last) = words.last() else { return 0.0 };
        // Three words hold all bits of a double, and what is below them cannot be seen.
        let word_bits = 8 * size_of_val(&last);
        let kept = words.len().min(3);
        let dropped = words.len() - kept;
        let mut value = 0.0;
        for (k, &word) in words[dropped..].iter().enumerate() {
            let exponent = (word_bits * (dropped + k)) as i64 - self.bits as i64;
            value += word as f64 * power_of_two(exponent);
        }
        if sign == Sign::Negative { -value } else { value }
    }

    /// Bits behind the point before the first one that is not zero.
    pub(super) fn zero_bits(&self, number: &IBig) -> usize {
        let (_, words) = number.as_sign_words();
        let used = words
            .last()
            .map_or(0, |last| 8 * size_of_val(last) * words.len() - last.leading_zeros() as usize);
        self.bits.saturating_sub(used)
    }

    pub(super) fn product(&self, a: &IBig, b: &IBig) -> IBig {
        (a * b) >> self.bits
    }

    pub(super) fn square(&self, a: &IBig) -> IBig {
        IBig::from(a.sqr()) >> self.bits
    }

    /// a/b for a b that is not zero.
    pub(super) fn quotient(&self, a: &IBig, b: &IBig) -> IBig {
        (a << self.bits) / b
    }

    /// 2 pi.
    pub(super) fn period(&self) -> IBig {
        &self.pi >> (BITS_OF_PI - 1)
    }

    /// Sine and cosine of an angle (rad) within +-2^30, to some units of the last bit.
    ///
    /// What is left of whole right angles is halved some more times, so that the series of both is short, and
    /// the angle doubled again: sin 2x = 2 sin x (1 - v), versin 2x = 2 sin^2 x, without cancellation.
    pub(super) fn sin_cos(&self, angle: &IBig) -> (IBig, IBig) {
        // Half as many doublings as the terms that they save: measured to be the best within a tenth.
        let doublings = 4 + self.bits.isqrt() / 4;
        let bits = self.bits + GUARD_BITS + doublings;
        // Right angles, at the precision of the work and above that of pi.
        let right_angles = (self.value(angle) / core::f64::consts::FRAC_PI_2).round();
        let half_pi = &self.pi * IBig::from(right_angles as i64);
        let reduced = (angle << (bits - self.bits))
            - shifted(half_pi, bits as i64 - (self.bits + BITS_OF_PI + 1) as i64);
        let small = reduced >> doublings;
        let one = IBig::ONE << bits;
        let (mut sine, mut versine) = (IBig::ZERO, IBig::ZERO);
        let mut term = small.clone();
        let mut k = 1_u32;
        while !term.is_zero() {
            match k % 4 {
                1 => sine += &term,
                2 => versine += &term,
                3 => sine -= &term,
                _ => versine -= &term,
            }
            k += 1;
            // The shift rounds down: a negative term would end at -1 for ever.
            term = rounded_product(&term, &small, bits) / k;
        }
        for _ in 0..doublings {
            let square = IBig::from(sine.sqr()) >> (bits - 1);
            sine = (&sine * (&one - &versine)) >> (bits - 1);
            versine = square;
        }
        let spare = bits - self.bits;
        let (sine, cosine) = (sine >> spare, (one - versine) >> spare);
        match (right_angles as i64).rem_euclid(4) {
            0 => (sine, cosine),
            1 => (cosine, -sine),
            2 => (-sine, -cosine),
            _ => (-cosine, sine),
        }
    }
}

/// A product of two numbers, rounded towards zero.
fn rounded_product(a: &IBig, b: &IBig, bits: usize) -> IBig {
    let product = a * b;
    if product.sign() == Sign::Negative { -((-product) >> bits) } else { product >> bits }
}

/// A number by a power of two.
fn shifted(number: IBig, by: i64) -> IBig {
    let places = by.unsigned_abs() as usize;
    if by >= 0 { number << places } else { number >> places }
}

#[cfg(test)]
mod tests {
    use dashu_float::FBig;
    use dashu_float::round::mode::HalfEven;

    use super::*;
    use crate::numerics::random::SplitMix64;

    type High = FBig<HalfEven, 2>;

    fn exact(number: &IBig, bits: usize) -> High {
        let one = High::from(1).with_precision(bits + 100).value();
        let whole = High::from(number.clone()).with_precision(bits + 100).value();
        whole * one / (High::from(IBig::ONE << bits))
    }

    /// How far a number is from what it should be, in units of its last bit.
    fn units(number: &IBig, expected: &High, bits: usize) -> f64 {
        let scale = High::from(IBig::ONE << bits);
        ((exact(number, bits) - expected) * scale).to_f64().value().abs()
    }

    #[test]
    fn sine_cosine_and_pi_are_those_of_the_oracle() {
        let mut random = SplitMix64::new(7);
        for bits in [64, 100, 300, 1_000, 3_000] {
            let arithmetic = FixedPoint::new(bits);
            let two_pi = High::pi(bits + 100) * High::from(2);
            assert!(units(&arithmetic.period(), &two_pi, bits) <= 1.0, "{bits}");
            for k in 0..20 {
                let angle = if k == 0 { 0.0 } else { 60.0 * (random.unit() - 0.5) };
                // With bits below those of a double.
                let number = arithmetic.number(angle) + arithmetic.number(random.unit() * 1e-17);
                let (sin, cos) = arithmetic.sin_cos(&number);
                let (s, c) = exact(&number, bits).sin_cos();
                assert!(units(&sin, &s, bits) < 4.0, "{bits} {angle}: {}", units(&sin, &s, bits));
                assert!(units(&cos, &c, bits) < 4.0, "{bits} {angle}: {}", units(&cos, &c, bits));
            }
            let fewer = arithmetic.with_fewer(64);
            assert_eq!((fewer.period() - FixedPoint::new(64).period()).sign(), Sign::Positive);
        }
    }

    #[test]
    fn doubles_are_numbers_and_back() {
        let arithmetic = FixedPoint::new(200);
        for value in [0.0, 1.0, -1.0, 0.1, -0.1, 1e300, -1e300, 1e-30, core::f64::consts::PI, 3.0e9, -2.5e-20]
        {
            let back = arithmetic.value(&arithmetic.number(value));
            assert!((back - value).abs() <= 2.0 * f64::EPSILON * value.abs(), "{value} {back}");
        }
        // Below the last bit.
        for value in [5e-324, 1e-310, 1e-100] {
            assert_eq!(arithmetic.value(&arithmetic.number(value)).to_bits(), 0, "{value}");
        }
        let (three, two) = (arithmetic.number(3.0), arithmetic.number(2.0));
        assert_eq!(arithmetic.product(&three, &two), arithmetic.number(6.0));
        assert_eq!(arithmetic.quotient(&three, &two), arithmetic.number(1.5));
        assert_eq!(arithmetic.square(&three), arithmetic.number(9.0));
    }
}
