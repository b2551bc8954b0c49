//! When a mean over windows is steady, and how well it is known: judged by the spread over independent members.

use bouncing_disk_core::numerics::statistics::{mean, standard_deviation};

use super::point::Shortfall;

/// A drift counts as one beyond so many of its standard errors, however loose the error is that was asked for: what is
/// left of a start-up is in no member's scatter, so that the standard error would not tell of it. A drift has about
/// twice the standard error of the mean. With 15 degrees of freedom chance gives one of these in 16 judgements; a
/// motor is then only followed for longer.
const DRIFT: f64 = 2.0;

/// Motors that lock on one motion have next to no scatter, and what is left of a start-up decays for as long as one
/// waits. This share of the error that was asked for is too little to wait for.
const NEGLIGIBLE: f64 = 1e-3;

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
    if drift.abs() > (DRIFT * standard_error).max(NEGLIGIBLE * wanted) || !drift.is_finite() {
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
        for wanted in [0.1, 100.0] {
            assert!(matches!(shortfall(&speeds, wanted), Some(Shortfall::Drift { .. })), "{wanted}");
        }
        // One that is lost in the scatter is none.
        assert_eq!(shortfall(&noisy(16, 12, |window| 1e-4 * window), 0.1), None);
    }

    #[test]
    fn motions_without_spread_are_steady_only_if_they_do_not_change() {
        assert_eq!(shortfall(&vec![vec![1.0; 6]; 4], 1e-9), None);
        let drifting: Vec<f64> = (0..6).map(f64::from).collect();
        // The early third of six windows has 0 and 1, the rest 2 to 5: a drift of 3.
        for (wanted, drifts) in [(1e-9, true), (2.9e3, true), (3.1e3, false)] {
            let shortfall = shortfall(&vec![drifting.clone(); 4], wanted);
            assert_eq!(matches!(shortfall, Some(Shortfall::Drift { .. })), drifts, "{wanted}");
        }
        assert!(matches!(shortfall(&vec![vec![f64::NAN; 6]; 4], 1.0), Some(Shortfall::Drift { .. })));
    }
}
