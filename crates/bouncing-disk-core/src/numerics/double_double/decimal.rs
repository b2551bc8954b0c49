//! Decimal digits of a double-double number, written exactly and read to within its last two bits.

use core::fmt;
use core::str::FromStr;

use super::DoubleDouble;
use crate::numerics::error::Error;

/// Decimal places that represent every double exactly.
const EXACT_PLACES: usize = 1_074;

/// Significant digits if no precision is requested: more than 106 bits can hold.
const SIGNIFICANT_DIGITS: i32 = 33;

/// The smallest and the largest power of ten accepted when reading a number.
const EXPONENTS: core::ops::RangeInclusive<i32> = -250..=280;

/// The digits of |a| plus or minus |b|: the number of places before the point, and all digits.
fn digits_of_sum(a: f64, b: f64) -> (usize, Vec<u8>) {
    let digits = |x: f64| {
        let text = format!("{:.EXACT_PLACES$}", x.abs());
        let whole = text.find('.').unwrap_or(text.len());
        let digits: Vec<u8> = text.bytes().filter(u8::is_ascii_digit).map(|digit| digit - b'0').collect();
        (whole, digits)
    };
    let ((whole, mut sum), (whole_of_b, part)) = (digits(a), digits(b));
    let subtracted = (a < 0.0) != (b < 0.0);
    // The second number is far smaller: it has no more places before the point.
    let shift = whole - whole_of_b;
    let mut carry = 0_i8;
    for (k, digit) in sum.iter_mut().enumerate().rev() {
        let other = if k >= shift { part[k - shift] as i8 } else { 0 };
        let value = *digit as i8 + if subtracted { -other } else { other } + carry;
        carry = value.div_euclid(10);
        *digit = value.rem_euclid(10) as u8;
    }
    (whole, sum)
}

/// Keeps `keep` digits, rounded half up; returns the carry out of the first digit.
fn rounded(digits: &mut Vec<u8>, keep: usize) -> bool {
    let up = digits.get(keep).is_some_and(|&digit| digit >= 5);
    digits.resize(keep, 0);
    if !up {
        return false;
    }
    for digit in digits.iter_mut().rev() {
        if *digit < 9 {
            *digit += 1;
            return false;
        }
        *digit = 0;
    }
    true
}

/// As many places as the given precision, or 33 significant digits.
impl fmt::Display for DoubleDouble {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        if !self.is_finite() {
            return fmt::Display::fmt(&(self.high + self.low), formatter);
        }
        let (mut whole, mut digits) = digits_of_sum(self.high, self.low);
        let first = digits.iter().position(|&digit| digit != 0);
        let places = formatter.precision().unwrap_or_else(|| {
            let before = first.map_or(0, |first| whole as i32 - first as i32);
            (SIGNIFICANT_DIGITS - before).max(0) as usize
        });
        if rounded(&mut digits, whole + places) {
            digits.insert(0, 1);
            whole += 1;
        }
        let mut text: String = digits[..whole].iter().map(|&digit| char::from(b'0' + digit)).collect();
        if places > 0 {
            text.push('.');
            text.extend(digits[whole..].iter().map(|&digit| char::from(b'0' + digit)));
        }
        formatter.pad_integral(self.high >= 0.0, "", &text)
    }
}

impl FromStr for DoubleDouble {
    type Err = Error;

    /// Reads a decimal number like `-1.25e-3`.
    ///
    /// # Errors
    /// [`Error::NoDecimal`] for a text that is not a decimal number; [`Error::OutOfRange`] for a non-zero
    /// number outside 1e-250 to 1e280.
    fn from_str(text: &str) -> Result<Self, Error> {
        let bad = |at: usize| Error::NoDecimal { at };
        let bytes = text.as_bytes();
        let negative = bytes.first() == Some(&b'-');
        let mut at = usize::from(negative || bytes.first() == Some(&b'+'));
        let (mut value, mut power, mut seen, mut point) = (Self::ZERO, 0_i32, false, false);
        let ten = Self::from(10.0);
        while let Some(&byte) = bytes.get(at) {
            match byte {
                b'0'..=b'9' => {
                    // Digits beyond the 40th are too small for the number to represent.
                    if value.high < 1.0e40 {
                        value = value * ten + Self::from(f64::from(byte - b'0'));
                        power -= i32::from(point);
                    } else {
                        power += i32::from(!point);
                    }
                    seen = true;
                }
                b'.' if !point => point = true,
                b'e' | b'E' if seen => break,
                _ => return Err(bad(at)),
            }
            at += 1;
        }
        if !seen {
            return Err(bad(at));
        }
        if at < bytes.len() {
            let exponent: i32 = text[at + 1..].parse().map_err(|_| bad(at + 1))?;
            power = power.saturating_add(exponent);
        }
        let order = if value.high > 0.0 { power.saturating_add(power_of_ten(value.high)) } else { 0 };
        if !EXPONENTS.contains(&order) {
            return Err(Error::OutOfRange {
                field: "power of ten of a decimal number",
                value: f64::from(order),
                legal: "[-250, 280]",
            });
        }
        let mut scale = Self::ONE;
        let mut factor = ten;
        let mut left = if value.high > 0.0 { power.unsigned_abs() } else { 0 };
        while left > 0 {
            if left % 2 == 1 {
                scale = scale * factor;
            }
            left /= 2;
            if left > 0 {
                factor = factor * factor;
            }
        }
        let value = if power < 0 { value / scale } else { value * scale };
        Ok(if negative { -value } else { value })
    }
}

/// The power of ten of a number >= 1, by comparison.
fn power_of_ten(value: f64) -> i32 {
    let (mut power, mut bound) = (0, 10.0);
    while value >= bound {
        bound *= 10.0;
        power += 1;
    }
    power
}
