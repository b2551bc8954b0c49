//! Numbers as people read them, and as programs do.

/// Significant digits of a number in a table.
const DIGITS: usize = 6;

/// A number with six significant digits at most, without trailing zeros.
pub(crate) fn shown(value: f64) -> String {
    rounded(value, DIGITS)
}

/// A number with so many significant digits at most, without trailing zeros; powers of ten only where they
/// are needed.
pub(crate) fn rounded(value: f64, digits: usize) -> String {
    if !value.is_finite() {
        return format!("{value}");
    }
    let digits = digits.max(1);
    let scientific = format!("{value:.*e}", digits - 1);
    let Some((mantissa, exponent)) = scientific.split_once('e') else { return scientific };
    let exponent: i32 = exponent.parse().unwrap_or_default();
    if !(-4..=5.max(digits as i32 - 1)).contains(&exponent) {
        return format!("{}e{exponent}", trimmed(mantissa));
    }
    let decimals = usize::try_from(digits as i32 - 1 - exponent).unwrap_or(0);
    trimmed(&format!("{value:.decimals$}")).to_owned()
}

fn trimmed(text: &str) -> &str {
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;

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
            (1_234_567.0, "1.23457e6"),
            (-0.000_123_456_78, "-0.000123457"),
            (5e-324, "4.94066e-324"),
            (f64::MAX, "1.79769e308"),
            (f64::INFINITY, "inf"),
            (f64::NAN, "NaN"),
        ] {
            assert_eq!(shown(value), text);
        }
        assert_eq!(rounded(0.530_664_170_882_77, 12), "0.530664170883");
        assert_eq!(rounded(3.0, 0), "3");
    }
}
