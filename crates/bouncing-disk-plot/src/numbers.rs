//! Numbers in readable form, and the extent of a list of numbers.

/// A number with at most `digits` significant digits, without trailing zeros; powers of ten only if they
/// are needed.
pub fn rounded(value: f64, digits: usize) -> String {
    let rounded: f64 = format!("{value:.*e}", digits.saturating_sub(1)).parse().unwrap_or(value);
    match rounded.abs() {
        size if size > 0.0 && !(1e-4..1e6).contains(&size) => format!("{rounded:e}"),
        _ => format!("{rounded}"),
    }
}

/// A number with six significant digits as mathematics for a label, with powers of ten written as powers.
pub fn in_math(value: f64) -> String {
    let text = rounded(value, 6);
    match text.split_once('e') {
        Some((mantissa, exponent)) => format!(r"{mantissa}\times 10^{{{exponent}}}"),
        None => text,
    }
}

/// The least and the largest of the finite values; infinite and in reverse order if no value is finite.
pub(crate) fn extent(values: impl IntoIterator<Item = f64>) -> (f64, f64) {
    let finite = values.into_iter().filter(|value| value.is_finite());
    finite.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(value), high.max(value)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::label::Label;

    #[test]
    fn numbers_are_as_long_as_they_need_to_be() {
        for (value, text) in [
            (0.0, "0"),
            (-0.0, "-0"),
            (1.0, "1"),
            (13.995_123_4, "13.9951"),
            (0.5, "0.5"),
            (1e-4, "0.0001"),
            (1.5e-7, "1.5e-7"),
            (123_456.7, "123457"),
            (999_999.7, "1e6"),
            (1_234_567.0, "1.23457e6"),
            (-0.000_123_456_78, "-0.000123457"),
            (5e-324, "5e-324"),
            (f64::MAX, "1.79769e308"),
            (f64::INFINITY, "inf"),
            (f64::NAN, "NaN"),
        ] {
            assert_eq!(rounded(value, 6), text);
        }
        assert_eq!(rounded(0.530_664_170_882_77, 12), "0.530664170883");
        assert_eq!(rounded(3.0, 0), "3");
    }

    #[test]
    fn numbers_in_mathematics_have_powers_of_ten() {
        for (value, text) in [
            (0.486, "0.486"),
            (0.0, "0"),
            (1e300, r"1\times 10^{300}"),
            (1.5e-7, r"1.5\times 10^{-7}"),
            (f64::MAX, r"1.79769\times 10^{308}"),
        ] {
            assert_eq!(in_math(value), text);
            assert!(Label::new(&format!("${text}$")).spans().is_ok(), "{text}");
        }
    }
}
