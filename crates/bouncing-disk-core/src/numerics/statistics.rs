//! Summaries of a sample of numbers.

/// The 97.5 % quantile of the normal distribution: the 95 % interval of a mean extends this many standard
/// errors to either side.
pub const NORMAL_975: f64 = 1.959_963_984_540_054;

/// Size up to which, and down to whose inverse, squares of numbers can be summed without overflow or
/// underflow.
const ORDINARY: f64 = 1.0e120;

/// The power of two by which numbers are multiplied before they or their squares are summed, so that the sum
/// neither overflows nor vanishes. It is one for ordinary numbers, whose results keep their bits.
#[must_use]
pub fn summing_scale(values: &[f64]) -> f64 {
    let largest = values.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
    if largest > ORDINARY {
        power_of_two(-600)
    } else if largest > 0.0 && largest < 1.0 / ORDINARY {
        power_of_two(700)
    } else {
        1.0
    }
}

const fn power_of_two(exponent: i64) -> f64 {
    f64::from_bits(((1_023 + exponent) as u64) << 52)
}

/// The mean of finite numbers, even if their sum would overflow a double; NaN if empty.
#[must_use]
pub fn mean(values: &[f64]) -> f64 {
    let scale = summing_scale(values);
    let sum = values.iter().map(|value| value * scale).sum::<f64>();
    sum / values.len() as f64 / scale
}

/// The standard deviation (with n - 1) of finite numbers about their [`mean`]; zero for fewer than two
/// numbers, infinite if it overflows a double.
#[must_use]
pub fn standard_deviation(values: &[f64]) -> f64 {
    let n = values.len() as f64;
    if n <= 1.0 {
        return 0.0;
    }
    let (mean, scale) = (mean(values), summing_scale(values));
    let squares = values.iter().fold(0.0, |sum, value| {
        let difference = value * scale - mean * scale;
        sum + difference * difference
    });
    (squares / (n - 1.0)).sqrt() / scale
}

/// The median, or the upper one of two in the middle; `None` if empty.
pub fn median(values: impl IntoIterator<Item = f64>) -> Option<f64> {
    let mut values: Vec<f64> = values.into_iter().collect();
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied()
}

/// The smallest and the largest number; infinity and minus infinity if empty.
pub fn extent(values: impl IntoIterator<Item = f64>) -> (f64, f64) {
    let start = (f64::INFINITY, f64::NEG_INFINITY);
    values.into_iter().fold(start, |(low, high), value| (low.min(value), high.max(value)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_middle_and_the_ends_of_a_sample() {
        assert_eq!(
            (median([3.0, 1.0, 2.0]), median([4.0, 1.0, 3.0, 2.0]), median([])),
            (Some(2.0), Some(3.0), None)
        );
        assert_eq!((extent([2.0, -1.0, 5.0]), extent([7.0])), ((-1.0, 5.0), (7.0, 7.0)));
        assert!(extent([]).0 > extent([]).1);
    }

    #[test]
    fn numbers_of_any_size_have_a_mean_and_a_deviation() {
        for size in [1.0, 1e300, 1e-300, 1e-200, -1e308] {
            let values = [1.0 * size, 1.25 * size, 1.5 * size];
            assert!((mean(&values) / (1.25 * size) - 1.0).abs() < 1e-15, "{size}");
            assert!((standard_deviation(&values) / (0.25 * size.abs()) - 1.0).abs() < 1e-14, "{size}");
        }
        assert!(mean(&[]).is_nan() && standard_deviation(&[]).abs() <= 0.0);
        assert!(standard_deviation(&[7.0]).abs() <= 0.0);
        assert!(standard_deviation(&[f64::MAX, -f64::MAX]).is_infinite());
    }
}
