//! When a mean over windows is steady, and how well it is known: judged by the spread over independent members.

use bouncing_disk_core::numerics::statistics::{mean, standard_deviation};

use super::point::Shortfall;

/// A drift counts as one beyond so many of its standard errors. With 15 degrees of freedom chance gives that once in a
/// thousand times; a motor is then only followed for longer.
const DRIFT: f64 = 4.0;

/// Parts of the windows: the first is always left out, as the start-up.
const PARTS: usize = 4;

/// Windows that are left out of so many.
pub(super) const fn left_out(windows: usize) -> usize {
    windows / PARTS
}

/// Judges the mean speed of windows in order of time, `speeds[member][window]` without the start-up: `None` if it is steady
/// and its standard error at most `wanted`.
pub(super) fn shortfall(speeds: &[Vec<f64>], wanted: f64) -> Option<Shortfall> {
    let members = (speeds.len() as f64).sqrt();
    let error_of = |values: &[f64]| standard_deviation(values) / members;
    let means: Vec<f64> = speeds.iter().map(|windows| mean(windows)).collect();
    let drifts: Vec<f64> = speeds
        .iter()
        .map(|windows| {
            let (early, late) = windows.split_at(windows.len().div_ceil(3));
            mean(late) - mean(early)
        })
        .collect();
    let (drift, standard_error) = (mean(&drifts), error_of(&drifts));
    // A drift below what is asked of the mean does not matter, and without any spread none is zero.
    if drift.abs() > (DRIFT * standard_error).max(wanted) || !drift.is_finite() {
        return Some(Shortfall::Drift { drift, standard_error });
    }
    let standard_error = error_of(&means);
    (standard_error > wanted).then_some(Shortfall::Error { standard_error, wanted })
}

#[cfg(test)]
mod tests {
    use bouncing_disk_core::elementary::exp;
    use bouncing_disk_core::numerics::random::SplitMix64;

    use super::*;

    fn noisy(members: u64, windows: usize, curve: impl Fn(f64) -> f64) -> Vec<Vec<f64>> {
        (0..members)
            .map(|seed| {
                let mut random = SplitMix64::new(seed);
                (0..windows).map(|window| curve(window as f64) + random.unit() - 0.5).collect()
            })
            .collect()
    }

    #[test]
    fn steady_means_are_judged_by_their_errors() {
        let speeds = noisy(16, 12, |_| 5.0);
        // The deviation of a mean of 12 x 16 evenly distributed numbers.
        let error = (1.0_f64 / 12.0 / 192.0).sqrt();
        assert_eq!(shortfall(&speeds, 2.0 * error), None);
        let Some(Shortfall::Error { standard_error, .. }) = shortfall(&speeds, 0.3 * error) else {
            panic!("too well known")
        };
        assert!((standard_error / error - 1.0).abs() < 0.5, "{standard_error} {error}");
    }

    #[test]
    fn a_start_up_is_seen() {
        let speeds = noisy(16, 12, |window| 5.0 * (1.0 - exp(-window / 6.0)));
        assert!(matches!(shortfall(&speeds, 0.1), Some(Shortfall::Drift { .. })));
        // One that is below what is asked for is none.
        assert_eq!(shortfall(&noisy(16, 12, |window| 1e-4 * window), 0.1), None);
    }

    #[test]
    fn motions_without_spread_are_steady_only_if_they_do_not_change() {
        assert_eq!(shortfall(&vec![vec![1.0; 6]; 4], 1e-9), None);
        let drifting: Vec<f64> = (0..6).map(f64::from).collect();
        assert!(matches!(shortfall(&vec![drifting; 4], 1e-9), Some(Shortfall::Drift { .. })));
        assert!(matches!(shortfall(&vec![vec![f64::NAN; 6]; 4], 1.0), Some(Shortfall::Drift { .. })));
    }
}
