//! Statistics of small and correlated samples.

use bouncing_disk_core::numerics::random::SplitMix64;
use bouncing_disk_core::numerics::statistics::NORMAL_975;

/// The 97.5 % quantiles of Student's distribution with 1 to 10 degrees of freedom.
const STUDENT_QUANTILES: [f64; 10] = [
    12.706_204_736_432_1,
    4.302_652_729_911_28,
    3.182_446_305_284_26,
    2.776_445_105_197_79,
    2.570_581_836_614_74,
    2.446_911_848_791_68,
    2.364_624_251_592_78,
    2.306_004_135_204_17,
    2.262_157_162_740_99,
    2.228_138_851_964_94,
];

/// The window of the autocorrelation ends after this many correlation times (Sokal).
const WINDOW: f64 = 5.0;

/// The integrated correlation time of residuals, 1 + 2 (rho_1 + rho_2 + ...), in points: at least 1, and 1
/// for independent ones.
///
/// `parameters` is the number of fitted parameters. The result is the larger of two estimates. The first,
/// without a model, is the sum of the autocorrelations up to five times their sum so far. The second, with a
/// smaller error, is (1 + rho_1)/(1 - rho_1) for residuals each of which depends only on the previous one
/// (docs/numerics-dynamics.md, "Fits with intervals"). `None` if the window does not end within a fourth of the
/// residuals, which are then correlated for too long.
pub(crate) fn correlation_time(residuals: &[f64], parameters: usize) -> Option<f64> {
    let n = residuals.len();
    let variance: f64 = residuals.iter().map(|value| value * value).sum();
    if variance <= 0.0 || n < 4 {
        return Some(1.0);
    }
    let correlation =
        |lag: usize| residuals.iter().zip(&residuals[lag..]).map(|(a, b)| a * b).sum::<f64>() / variance;
    let mut sum = 1.0;
    let mut first = 0.0;
    let mut ended = false;
    for lag in 1..=n / 4 {
        let rho = correlation(lag);
        if lag == 1 {
            first = rho;
        }
        sum += 2.0 * rho;
        if lag as f64 >= WINDOW * sum {
            ended = true;
            break;
        }
    }
    if !ended {
        return None;
    }
    // Each fitted parameter removes part of what the residuals have in common.
    let unbiased = first + (1.0 + 3.0 * first.max(0.0)) * parameters as f64 / (2.0 * n as f64);
    if unbiased >= 1.0 {
        return None;
    }
    let of_neighbours = (1.0 + unbiased) / (1.0 - unbiased);
    Some(sum.max(of_neighbours).max(1.0))
}

/// The 97.5 % quantile of Student's distribution for the integer part of the degrees of freedom, at least 1.
///
/// Fewer degrees of freedom have a larger quantile, so truncation makes an interval wider. Beyond ten, the
/// quantile is computed from the expansion in the inverse degrees of freedom (Abramowitz and Stegun 26.7.5),
/// with an error below 1e-6.
pub(crate) fn student_quantile(degrees: f64) -> f64 {
    let whole = (degrees as u64).max(1);
    if let Some(quantile) = usize::try_from(whole - 1).ok().and_then(|index| STUDENT_QUANTILES.get(index)) {
        return *quantile;
    }
    let (z, inverse) = (NORMAL_975, 1.0 / whole as f64);
    let square = z * z;
    let terms = [
        z,
        z * (square + 1.0) / 4.0,
        z * ((5.0 * square + 16.0) * square + 3.0) / 96.0,
        z * (((3.0 * square + 19.0) * square + 17.0) * square - 15.0) / 384.0,
        z * ((((79.0 * square + 776.0) * square + 1_482.0) * square - 1_920.0) * square - 945.0) / 92_160.0,
    ];
    terms.iter().rev().fold(0.0, |sum, term| sum * inverse + term)
}

/// The factor by which an interval must be wider than the bootstrap's to be valid for a sample of `size`
/// independent values. The resampled variance lacks the factor size/(size - 1), and the rest has Student's
/// distribution (docs/numerics-dynamics.md, "Fits with intervals").
pub(crate) fn small_sample_widening(size: usize) -> f64 {
    let size = size as f64;
    (size / (size - 1.0)).sqrt() * student_quantile(size - 1.0) / NORMAL_975
}

/// The quantile of sorted numbers at this share, interpolated linearly between neighbours.
pub(crate) fn percentile(sorted: &[f64], share: f64) -> f64 {
    let place = share * (sorted.len() - 1) as f64;
    let left = (place as usize).min(sorted.len() - 1);
    let right = (left + 1).min(sorted.len() - 1);
    sorted[left] + (place - left as f64) * (sorted[right] - sorted[left])
}

/// The means of groups of numbers, scaled.
pub(crate) fn group_means(values: &[f64], group: usize, scale: f64) -> Vec<f64> {
    let mean = |values: &[f64]| values.iter().map(|value| value * scale).sum::<f64>() / values.len() as f64;
    values.chunks(group).map(mean).collect()
}

/// An index below `count`, uniformly distributed.
pub(crate) fn drawn_index(random: &mut SplitMix64, count: usize) -> usize {
    ((random.unit() * count as f64) as usize).min(count.saturating_sub(1))
}

/// A number of mean 0 and deviation 1 (Box and Muller).
#[cfg(any(test, feature = "fit"))]
pub(crate) fn normal(random: &mut SplitMix64) -> f64 {
    use bouncing_disk_core::numerics::elementary::{cos, ln};
    let radius = (-2.0 * ln(1.0 - random.unit())).sqrt();
    radius * cos(std::f64::consts::TAU * random.unit())
}

#[cfg(test)]
mod tests {
    use bouncing_disk_core::numerics::elementary::{ln, pow};

    use super::*;
    use crate::testing::Noise;

    /// The probability that a variable of Student's distribution is between -t and t, by Simpson's rule over
    /// the angle atan(x/sqrt(degrees)), in which its density is a power of the cosine.
    fn share_within(t: f64, degrees: f64) -> f64 {
        let end = bouncing_disk_core::numerics::elementary::atan(t / degrees.sqrt());
        let density = |angle: f64| pow(bouncing_disk_core::numerics::elementary::cos(angle), degrees - 1.0);
        let integral = |to: f64| {
            let (n, h) = (4_000, to / 4_000.0);
            (0..=n).fold(0.0, |sum, i| {
                let weight = if i == 0 || i == n { 1.0 } else { f64::from(2 + 2 * (i % 2)) };
                sum + weight * density(h * f64::from(i))
            }) * h
                / 3.0
        };
        integral(end) / integral(std::f64::consts::FRAC_PI_2)
    }

    #[test]
    fn quantiles_leave_a_fortieth_on_each_side() {
        for degrees in (1..=40).chain([100, 1_000]) {
            let share = share_within(student_quantile(f64::from(degrees)), f64::from(degrees));
            assert!((share - 0.95).abs() < 1e-6, "{degrees}: {share}");
        }
        assert!((student_quantile(1e15) - NORMAL_975).abs() < 1e-12);
        // Fractions of a degree, zero and NaN count as the next legal degrees below.
        for (degrees, same) in [(7.9, 7.0), (0.3, 1.0), (-3.0, 1.0), (f64::NAN, 1.0)] {
            assert!((student_quantile(degrees) - student_quantile(same)).abs() <= 0.0, "{degrees}");
        }
        assert!(ln(student_quantile(f64::INFINITY)).is_finite());
    }

    #[test]
    fn correlation_times_are_those_of_the_noise() {
        for (memory, points) in [(0.0, 4_000), (0.5, 8_000), (0.9, 20_000)] {
            let expected = (1.0 + memory) / (1.0 - memory);
            let residuals = Noise::new(3).correlated(points, memory);
            let time = correlation_time(&residuals, 0).expect("long enough");
            assert!((time / expected - 1.0).abs() < 0.2, "{memory}: {time} {expected}");
        }
    }

    #[test]
    fn residuals_without_an_end_of_memory_have_no_correlation_time() {
        let line: Vec<f64> = (0..100).map(|i| f64::from(i) - 49.5).collect();
        assert_eq!(correlation_time(&line, 0), None);
        let alternating: Vec<f64> = (0..100).map(|i| f64::from(1 - 2 * (i % 2))).collect();
        assert_eq!(correlation_time(&alternating, 0), Some(1.0), "they do not add up");
        assert_eq!(correlation_time(&[0.0; 10], 2), Some(1.0));
        assert_eq!(correlation_time(&[], 2), Some(1.0));
    }
}
