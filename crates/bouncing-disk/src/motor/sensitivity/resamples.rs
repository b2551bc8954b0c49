//! Standard errors by resampling: rows, each a set of numbers that belong together, are drawn with
//! replacement.

use bouncing_disk_core::numerics::random::SplitMix64;
use bouncing_disk_core::numerics::statistics::standard_deviation;

use crate::statistics::drawn_index;

/// Resamples: the standard deviation of so many values is known to 4 %.
const RESAMPLES: usize = 300;

/// The standard errors of `N` statistics of `rows` rows. `statistics` gets the numbers of the drawn rows.
pub(crate) fn standard_errors<const N: usize>(
    rows: usize,
    seed: u64,
    statistics: impl Fn(&[usize]) -> [f64; N],
) -> [f64; N] {
    let mut random = SplitMix64::new(seed);
    let mut drawn = vec![0; rows];
    let mut values = vec![Vec::with_capacity(RESAMPLES); N];
    for _ in 0..RESAMPLES {
        for row in &mut drawn {
            *row = drawn_index(&mut random, rows);
        }
        for (values, value) in values.iter_mut().zip(statistics(&drawn)) {
            values.push(value);
        }
    }
    std::array::from_fn(|index| standard_deviation(&values[index]))
}
