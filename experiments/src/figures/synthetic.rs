//! Seeded random numbers: noise for estimators that have no measured points to run on (whatever is made with it is labelled
//! synthetic), and inputs that print alike.

use bouncing_disk::core::numerics::elementary::{exp, ln};
use bouncing_disk::core::numerics::random::SplitMix64;

/// A documented, reproducible stream of numbers for each seed (splitmix64).
#[derive(Clone, Debug)]
pub(crate) struct Noise(SplitMix64);

impl Noise {
    pub(crate) const fn new(seed: u64) -> Self {
        Self(SplitMix64::new(seed))
    }

    /// Evenly in [0, 1).
    pub(crate) fn even(&mut self) -> f64 {
        self.0.unit()
    }

    /// Bell-shaped with mean 0 and standard deviation 1, within ±6: the sum of twelve even numbers less 6.
    pub(crate) fn bell(&mut self) -> f64 {
        (0..12).map(|_| self.even()).sum::<f64>() - 6.0
    }

    /// Log-normal with this mean and standard deviation, both positive: for quantities that cannot be negative. A bell cut
    /// at zero would have a larger mean and less scatter than asked for.
    pub(crate) fn log_normal(&mut self, mean: f64, deviation: f64) -> f64 {
        let relative = deviation / mean;
        let variance = ln(1.0 + relative * relative);
        exp(ln(mean) - 0.5 * variance + variance.sqrt() * self.bell())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_bell_has_unit_spread_and_repeats() {
        let draw = |seed| {
            let mut noise = Noise::new(seed);
            (0..20_000).map(|_| noise.bell()).collect::<Vec<_>>()
        };
        let numbers = draw(7);
        assert_eq!(numbers, draw(7));
        let mean = numbers.iter().sum::<f64>() / 2e4;
        let variance = numbers.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / 2e4;
        // Four standard errors.
        assert!(mean.abs() < 0.029 && (variance - 1.0).abs() < 0.04, "{mean} {variance}");
    }

    #[test]
    fn the_log_normal_is_positive_and_has_the_moments_asked_for() {
        let mut noise = Noise::new(7);
        let numbers: Vec<f64> = (0..100_000).map(|_| noise.log_normal(0.10, 0.06)).collect();
        assert!(numbers.iter().all(|&x| x > 0.0));
        let mean = numbers.iter().sum::<f64>() / 1e5;
        let deviation = (numbers.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / 1e5).sqrt();
        // Four standard errors.
        assert!((mean - 0.10).abs() < 0.0008 && (deviation - 0.06).abs() < 0.0012, "{mean} {deviation}");
    }
}
