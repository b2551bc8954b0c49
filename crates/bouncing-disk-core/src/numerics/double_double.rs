//! Numbers stored as the sum of two doubles: about 31 decimal digits, with the same bits on every machine.
//!
//! The code uses only IEEE `+ - * /` and the square root, and computes the rounding error of a product by
//! splitting its factors (Dekker), not by a fused multiply-add. So the two doubles are the same for every
//! processor and compiler. The algorithms are from T. J. Dekker, Numer. Math. 18, 224 (1971); their error
//! bounds are from M. Joldes, J.-M. Muller and V. Popescu, ACM Trans. Math. Softw. 44, 15 (2017).

use core::ops::{Add, Div, Mul, Neg, Sub};

use crate::numerics::real::Real;

mod decimal;

/// The unevaluated sum of two doubles, together 106 bits; the first is the sum rounded to a double.
///
/// Products and quotients have a relative error of at most 2^-100 if no part underflows, that is for
/// magnitudes from 1e-250 to 1e290. A number that overflows is not finite.
///
/// ```
/// use bouncing_disk_core::numerics::double_double::DoubleDouble;
///
/// let tenth: DoubleDouble = "0.1".parse()?;
/// assert_ne!(tenth, DoubleDouble::from(0.1), "the double is not a tenth");
/// assert_eq!(format!("{:.28}", tenth * DoubleDouble::from(3.0)), "0.3000000000000000000000000000");
/// # Ok::<(), bouncing_disk_core::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd, Default)]
pub struct DoubleDouble {
    high: f64,
    low: f64,
}

/// 2^27 + 1, which splits a double into two halves.
const SPLITTER: f64 = 134_217_729.0;

/// pi/2 in three parts.
const HALF_PI: [f64; 3] =
    [core::f64::consts::FRAC_PI_2, 6.123_233_995_736_766e-17, -1.497_384_904_859_169_8e-33];

/// 2^26: for larger angles the number of right angles has too many bits for exact multiplication.
const LARGEST_ANGLE: f64 = 67_108_864.0;

/// 1/k! for k = 2, 3, ...
const INVERSE_FACTORIALS: [(f64, f64); 28] = [
    (0.5, 0.0),
    (0.16666666666666666, 9.25185853854297e-18),
    (0.041666666666666664, 2.3129646346357427e-18),
    (0.008333333333333333, 1.1564823173178714e-19),
    (0.001388888888888889, -5.300543954373577e-20),
    (0.0001984126984126984, 1.7209558293420705e-22),
    (2.48015873015873e-05, 2.1511947866775882e-23),
    (2.7557319223985893e-06, -1.858393274046472e-22),
    (2.755731922398589e-07, 2.3767714622250297e-23),
    (2.505210838544172e-08, -1.448814070935912e-24),
    (2.08767569878681e-09, -1.20734505911326e-25),
    (1.6059043836821613e-10, 1.2585294588752098e-26),
    (1.1470745597729725e-11, 2.0655512752830745e-28),
    (7.647163731819816e-13, 7.03872877733453e-30),
    (4.779477332387385e-14, 4.399205485834081e-31),
    (2.8114572543455206e-15, 1.6508842730861433e-31),
    (1.5619206968586225e-16, 1.1910679660273754e-32),
    (8.22063524662433e-18, 2.2141894119604265e-34),
    (4.110317623312165e-19, 1.4412973378659527e-36),
    (1.9572941063391263e-20, -1.3643503830087908e-36),
    (8.896791392450574e-22, -7.911402614872376e-38),
    (3.868170170630684e-23, -8.843177655482344e-40),
    (1.6117375710961184e-24, -3.6846573564509766e-41),
    (6.446950284384474e-26, -1.9330404233703465e-42),
    (2.4795962632247976e-27, -1.2953730964765229e-43),
    (9.183689863795546e-29, 1.4303150396787322e-45),
    (3.279889237069838e-30, 1.5117542744029879e-46),
    (1.1309962886447716e-31, 1.0498015412959506e-47),
];

/// Sum and error of the sum of two doubles in any order.
#[inline(always)]
fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let other = sum - a;
    (sum, (a - (sum - other)) + (b - other))
}

/// Sum and error of the sum of two doubles, the larger one first.
#[inline(always)]
fn quick_two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    (sum, b - (sum - a))
}

/// The two halves of a double.
#[inline(always)]
fn split(a: f64) -> (f64, f64) {
    let t = SPLITTER * a;
    let high = t - (t - a);
    (high, a - high)
}

/// Product and error of the product.
#[inline(always)]
fn two_product(a: f64, b: f64) -> (f64, f64) {
    let product = a * b;
    let ((a, a_low), (b, b_low)) = (split(a), split(b));
    (product, ((a * b - product) + a * b_low + a_low * b) + a_low * b_low)
}

impl DoubleDouble {
    /// Zero.
    pub const ZERO: Self = Self { high: 0.0, low: 0.0 };
    /// One.
    pub const ONE: Self = Self { high: 1.0, low: 0.0 };
    /// pi.
    pub const PI: Self = Self { high: 2.0 * HALF_PI[0], low: 2.0 * HALF_PI[1] };

    /// The nearest double.
    #[must_use]
    pub const fn high(self) -> f64 {
        self.high
    }

    /// The difference from the nearest double.
    #[must_use]
    pub const fn low(self) -> f64 {
        self.low
    }

    /// Whether the number is finite: neither NaN nor infinite.
    #[must_use]
    pub const fn is_finite(self) -> bool {
        self.high.is_finite() && self.low.is_finite()
    }

    /// The magnitude.
    #[must_use]
    pub fn abs(self) -> Self {
        if self.high < 0.0 { -self } else { self }
    }

    /// The square root; NaN below zero.
    #[must_use]
    pub fn sqrt(self) -> Self {
        if self.high <= 0.0 {
            return if self.high == 0.0 { Self::ZERO } else { Self { high: f64::NAN, low: f64::NAN } };
        }
        // One Newton step from the root of the nearest double, in which the large parts cancel.
        let root = self.high.sqrt();
        let (square, error) = two_product(root, root);
        let left = (self - Self { high: square, low: error }).high;
        let (high, low) = quick_two_sum(root, left / (2.0 * root));
        Self { high, low }
    }

    /// Sine and cosine of an angle below 2^26 rad, to 2e-32 plus the effect of the angle's own rounding; NaN
    /// for larger angles.
    #[must_use]
    pub fn sin_cos(self) -> (Self, Self) {
        if self.high.abs() >= LARGEST_ANGLE || !self.is_finite() {
            let none = Self { high: f64::NAN, low: f64::NAN };
            return (none, none);
        }
        let right_angles = (self.high / HALF_PI[0]).round();
        let mut reduced = self;
        for part in HALF_PI {
            let (high, low) = two_product(right_angles, part);
            reduced = reduced - Self { high, low };
        }
        let (sin, cos) = reduced.sin_cos_of_reduced();
        // The remainder is 0 to 3 even for negative numbers.
        match right_angles.rem_euclid(4.0) as u8 {
            0 => (sin, cos),
            1 => (cos, -sin),
            2 => (-sin, -cos),
            _ => (-cos, sin),
        }
    }

    /// Sine and cosine of an angle not much larger than pi/4, by their series: the first omitted term is
    /// below 1e-33.
    fn sin_cos_of_reduced(self) -> (Self, Self) {
        let square = self * self;
        let term = |k: usize| {
            let (high, low) = INVERSE_FACTORIALS[k - 2];
            Self { high, low }
        };
        let (mut sine, mut cosine) = (term(29), term(28));
        for k in (2..=26).rev().step_by(2) {
            sine = term(k + 1) - square * sine;
            cosine = term(k) - square * cosine;
        }
        (self - self * (square * sine), Self::ONE - square * cosine)
    }
}

impl From<f64> for DoubleDouble {
    fn from(value: f64) -> Self {
        Self { high: value, low: 0.0 }
    }
}

impl Neg for DoubleDouble {
    type Output = Self;

    #[inline]
    fn neg(self) -> Self {
        Self { high: -self.high, low: -self.low }
    }
}

impl Add for DoubleDouble {
    type Output = Self;

    #[inline]
    fn add(self, other: Self) -> Self {
        let (high, error) = two_sum(self.high, other.high);
        let (low, error_of_low) = two_sum(self.low, other.low);
        let (high, error) = quick_two_sum(high, error + low);
        let (high, low) = quick_two_sum(high, error + error_of_low);
        Self { high, low }
    }
}

impl Sub for DoubleDouble {
    type Output = Self;

    #[inline]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for DoubleDouble {
    type Output = Self;

    #[inline]
    fn mul(self, other: Self) -> Self {
        let (product, error) = two_product(self.high, other.high);
        let (high, low) = quick_two_sum(product, error + (self.high * other.low + self.low * other.high));
        Self { high, low }
    }
}

impl Div for DoubleDouble {
    type Output = Self;

    #[inline]
    fn div(self, other: Self) -> Self {
        // Long division, three digits of 53 bits.
        let first = self.high / other.high;
        let left = self - other * Self::from(first);
        let second = left.high / other.high;
        let left = left - other * Self::from(second);
        let third = left.high / other.high;
        let (high, low) = quick_two_sum(first, second);
        Self { high, low } + Self::from(third)
    }
}

impl Real for DoubleDouble {
    const EPSILON: f64 = 4.930_380_657_631_324e-32;
    const PI: Self = Self::PI;

    fn of(value: f64) -> Self {
        Self::from(value)
    }

    fn value(self) -> f64 {
        self.high
    }

    fn sin_cos(self) -> (Self, Self) {
        Self::sin_cos(self)
    }

    fn sqrt(self) -> Self {
        Self::sqrt(self)
    }
}

#[cfg(test)]
mod tests;
