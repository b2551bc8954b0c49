//! How long the residuals of a fit remember each other.

/// The window of the autocorrelation ends after so many correlation times (Sokal).
const WINDOW: f64 = 5.0;

/// The integrated correlation time of residuals, 1 + 2 (rho_1 + rho_2 + ...), in points: at least 1, and 1 for independent ones.
///
/// `parameters` have been fitted. It is the larger one of two estimates: the sum of the autocorrelations up to
/// five times their sum so far, which knows no model, and (1 + rho_1)/(1 - rho_1) of residuals of which each remembers
/// only the one before, which has the smaller error (docs/numerics/motors.md, "Fits with intervals").
/// `None` where the window has not ended before a fourth of the residuals: they remember each other for too long.
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
    // Each fitted parameter takes from the residuals what they have in common.
    let unbiased = first + (1.0 + 3.0 * first.max(0.0)) * parameters as f64 / (2.0 * n as f64);
    if unbiased >= 1.0 {
        return None;
    }
    let of_neighbours = (1.0 + unbiased) / (1.0 - unbiased);
    Some(sum.max(of_neighbours).max(1.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::Noise;

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
