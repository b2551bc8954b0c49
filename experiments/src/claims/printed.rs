//! Numbers as the paper prints them.

use std::f64::consts::PI;

use bouncing_disk::core::numerics::elementary::cos;

/// The precision to which an exact expression (π/4, 1/3, "nine") is compared.
const EXACT: f64 = 1e-9;

/// Numbers that are printed as words.
const WORDS: [&str; 10] = ["zero", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine"];

/// A printed number: its value, half a unit of its last digit, and the uncertainty behind ±.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct PrintedNumber {
    /// The value, in the unit of the text.
    pub value: f64,
    /// Half a unit of the last printed digit of the value.
    pub half_unit: f64,
    /// The uncertainty, where one is printed.
    pub uncertainty: Option<f64>,
}

impl PrintedNumber {
    /// Reads a number as the paper prints it; `None` if the text is no number.
    pub fn read(text: &str) -> Option<Self> {
        Self::read_shifted(text, 0)
    }

    /// Reads a number and multiplies it by a power of ten (a unit with a prefix, a percentage) in the text,
    /// so that it is rounded once.
    pub fn read_shifted(text: &str, power: i32) -> Option<Self> {
        let text = plain_ascii(text);
        let (number, uncertainty) = match text.split_once("+-") {
            Some((number, uncertainty)) => (number, Some(part(uncertainty, power)?.0)),
            None => (text.as_str(), None),
        };
        let number = number.trim().trim_start_matches(['~', ' ']);
        let (value, half_unit) = match number.strip_prefix("cos(").and_then(|rest| rest.strip_suffix(')')) {
            Some(angle) => {
                let (angle, half_unit) = part(angle, power)?;
                (cos(angle), 0.5 * (cos(angle - half_unit) - cos(angle + half_unit)).abs())
            }
            None => part(number, power)?,
        };
        Some(Self { value, half_unit, uncertainty })
    }
}

/// Whether a printed number is a multiple of π, so that one compares with ours in the same form. In
/// `cos(0.26π)` the π belongs to the angle, and the number itself is no multiple.
pub(crate) fn is_multiple_of_pi(text: &str) -> bool {
    text.contains('π') && !text.contains('(')
}

/// Value and half unit of a number without uncertainty.
fn part(text: &str, power: i32) -> Option<(f64, f64)> {
    let text = text.trim().trim_end_matches(['%', ' ']);
    if let Some(value) = WORDS.iter().position(|word| *word == text) {
        return Some((value as f64, EXACT));
    }
    if let Some((above, below)) = text.split_once('/') {
        let below = decimal(below, 0)?.0;
        let above = match above {
            "pi" => PI,
            "-pi" => -PI,
            other => multiple(other, power)?.0,
        };
        return Some((above / below, EXACT));
    }
    multiple(text, power)
}

/// "0.323pi" or "0.323".
fn multiple(text: &str, power: i32) -> Option<(f64, f64)> {
    let (text, factor) = match text.strip_suffix("pi") {
        Some(rest) => (rest.trim_end().trim_end_matches('*').trim_end(), PI),
        None => (text, 1.0),
    };
    decimal(text, power).map(|(value, half_unit)| (value * factor, half_unit * factor))
}

fn decimal(text: &str, power: i32) -> Option<(f64, f64)> {
    let (mantissa, exponent) = split_exponent(text)?;
    let exponent = exponent + power;
    // A comma or a thin space groups digits: "70,000".
    let digits: String = mantissa.chars().filter(|c| !matches!(c, ',' | ' ')).collect();
    let decimals = match digits.split_once('.') {
        Some((_, fraction)) => i32::try_from(fraction.len()).ok()?,
        None => 0,
    };
    if !digits.bytes().any(|b| b.is_ascii_digit()) {
        return None;
    }
    // Parsing the decimal text rounds once; multiplying by a power of ten would round twice.
    let value: f64 = format!("{digits}e{exponent}").parse().ok()?;
    let half_unit: f64 = format!("5e{}", exponent - decimals - 1).parse().ok()?;
    Some((value, half_unit))
}

/// "2.5*10^-6", "10^-6", "2.5e-6", "2.5" as mantissa and exponent.
fn split_exponent(text: &str) -> Option<(&str, i32)> {
    let (mantissa, exponent) = if let Some((mantissa, exponent)) = text.split_once("10^") {
        let mantissa = mantissa.trim_end().trim_end_matches('*').trim_end();
        let mantissa = match mantissa {
            "" => "1",
            "-" => "-1",
            other => other,
        };
        (mantissa, exponent.trim_start_matches('{').trim_end_matches('}'))
    } else if let Some((mantissa, exponent)) = text.split_once(['e', 'E']) {
        (mantissa, exponent)
    } else {
        (text, "0")
    };
    Some((mantissa, exponent.trim().trim_start_matches('+').parse().ok()?))
}

/// Unicode signs of printed numbers in ASCII: `−` to `-`, `×` to `*`, `±` to `+-`, `π` to `pi`, `10⁻⁹` to
/// `10^-9`.
fn plain_ascii(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    let mut raised = false;
    for c in text.trim().chars() {
        let superscript = match c {
            '⁻' => Some('-'),
            '⁰' => Some('0'),
            '¹' => Some('1'),
            '²' => Some('2'),
            '³' => Some('3'),
            '⁴'..='⁹' => char::from_u32(u32::from('4') + (u32::from(c) - u32::from('⁴'))),
            _ => None,
        };
        if let Some(digit) = superscript {
            if !raised {
                out.push('^');
            }
            raised = true;
            out.push(digit);
            continue;
        }
        raised = false;
        match c {
            '−' | '–' => out.push('-'),
            '×' | '·' => out.push('*'),
            '±' => out.push_str("+-"),
            'π' => out.push_str("pi"),
            '≈' | '∼' => out.push('~'),
            '\u{2009}' | '\u{a0}' | '\u{202f}' => out.push(' '),
            other => out.push(other),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> (f64, f64) {
        let number = PrintedNumber::read(text).unwrap_or_else(|| panic!("{text} is a number"));
        (number.value, number.half_unit)
    }

    #[test]
    fn the_tolerance_is_half_a_unit_of_the_last_printed_digit() {
        assert_eq!(read("0.486"), (0.486, 0.0005));
        assert_eq!(read("14"), (14.0, 0.5));
        assert_eq!(read("14 ± 5"), (14.0, 0.5));
        assert_eq!(read("14 ± 1.5"), (14.0, 0.5));
        assert_eq!(read("1e-6"), (1e-6, 0.5e-6));
        assert_eq!(read("10⁻⁹"), (1e-9, 0.5e-9));
        assert_eq!(read("10^{-8}"), (1e-8, 0.5e-8));
        assert_eq!(read("9 × 10³"), (9e3, 0.5e3));
        assert_eq!(read("1.5 × 10⁻⁶"), (1.5e-6, 0.05e-6));
        assert_eq!(read("−0.40"), (-0.4, 0.005));
        assert_eq!(read("0.323π"), (0.323 * PI, 0.0005 * PI));
        assert_eq!(read("−0.26π"), (-0.26 * PI, 0.005 * PI));
        assert_eq!(read("11.6 %"), (11.6, 0.05));
        assert_eq!(read("≈ 22"), (22.0, 0.5));
        assert_eq!(read("70,000"), (70_000.0, 0.5));
        assert_eq!(read("4.750"), (4.75, 0.0005));
    }

    #[test]
    fn expressions_and_words_are_numbers() {
        assert_eq!(read("−π/4").0.to_bits(), (-std::f64::consts::FRAC_PI_4).to_bits());
        assert_eq!(read("3π/2").0.to_bits(), (1.5 * PI).to_bits());
        assert_eq!(read("1/3").0.to_bits(), (1.0_f64 / 3.0).to_bits());
        assert_eq!(read("nine"), (9.0, EXACT));
        let (value, half_unit) = read("cos(0.26π)");
        assert_eq!(value.to_bits(), (cos(0.26 * PI)).to_bits());
        assert!((half_unit - 0.011_45).abs() < 1e-5, "{half_unit}");
    }

    #[test]
    fn a_cosine_of_a_multiple_of_pi_is_none() {
        for text in ["0.323π", "−0.26π", "0.175π ± 0.045π", "3π/2"] {
            assert!(is_multiple_of_pi(text), "{text}");
        }
        for text in ["0.486", "cos(0.26π)", "nine"] {
            assert!(!is_multiple_of_pi(text), "{text}");
        }
    }

    #[test]
    fn the_uncertainty_is_read_with_its_own_factor() {
        let uncertainty = |text| PrintedNumber::read(text).and_then(|number| number.uncertainty);
        assert_eq!(uncertainty("14 ± 1.5"), Some(1.5));
        assert_eq!(uncertainty("0.175π ± 0.045π"), Some(0.045 * PI));
        assert_eq!(uncertainty("14"), None);
        assert!(PrintedNumber::read("14 ± some").is_none());
    }

    #[test]
    fn a_prefix_of_the_unit_is_applied_without_a_second_rounding() {
        let shifted = |text, power| PrintedNumber::read_shifted(text, power).map(|number| number.value);
        assert_eq!(shifted("11.6 %", -2), Some(0.116));
        assert_eq!(shifted("5", -6), Some(5e-6));
        assert_eq!(shifted("9 × 10³", 3), Some(9e6));
    }

    #[test]
    fn what_is_no_number_is_refused() {
        for text in ["", "π", "about ten", "1.2.3", "10^x", "-", "e5", "cos(x)", "π/", "/2"] {
            assert!(PrintedNumber::read(text).is_none(), "{text}");
        }
    }
}
