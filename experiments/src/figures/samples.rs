//! What is said of a sample of numbers in one number or two.

/// The middle of some numbers, or the upper one of two in the middle; `None` of none.
pub(crate) fn median(values: impl IntoIterator<Item = f64>) -> Option<f64> {
    let mut values: Vec<f64> = values.into_iter().collect();
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied()
}

/// The smallest and the largest of some numbers; infinity and minus infinity of none.
pub(crate) fn extent(values: impl IntoIterator<Item = f64>) -> (f64, f64) {
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
}
