//! Numbers that several figures need: statistics of samples and angles, straight lines, seeded noise,
//! propagated uncertainties, powers of ten.

use bouncing_disk::core::{
    numerics::elementary::{exp, ln},
    numerics::random::SplitMix64,
};
use serde::Serialize;

use crate::claims::paper::Uncertain;

pub(crate) use bouncing_disk::core::numerics::statistics::{extent, median};
pub(crate) use bouncing_disk::motor::circular::{Concentration, distance, occupied_arc};

/// The power of ten of a number that is one.
pub(crate) fn exponent(value: f64) -> String {
    let text = format!("{value:e}");
    text.split_once('e').map_or(text.clone(), |(_, power)| power.replace('-', "\u{2212}"))
}

/// A number rounded to six decimals, where no more are meant.
pub(crate) fn six_decimals(value: f64) -> f64 {
    (value * 1.0e6).round() / 1.0e6
}

/// The exponent of a power law, the median over all pairs of positive points (Theil and Sen, in logarithms),
/// which a few points off the law do not move.
pub(crate) fn median_exponent(points: impl IntoIterator<Item = (f64, f64)>) -> Option<f64> {
    let positive = points.into_iter().filter(|(x, y)| *x > 0.0 && *y > 0.0);
    let points: Vec<(f64, f64)> = positive.map(|(x, y)| (ln(x), ln(y))).collect();
    let pairs = points.iter().enumerate().flat_map(|(index, one)| {
        points[index + 1..]
            .iter()
            .filter(move |other| other.0.total_cmp(&one.0).is_ne())
            .map(move |other| (one, other))
    });
    median(pairs.map(|(one, other)| (other.1 - one.1) / (other.0 - one.0)))
}

/// The range of the middle nine tenths of some values: between those of which a twentieth of all is lower,
/// and a twentieth higher. `None` of none.
pub(crate) fn middle_range(values: impl IntoIterator<Item = f64>) -> Option<[f64; 2]> {
    let mut sorted: Vec<f64> = values.into_iter().collect();
    sorted.sort_by(f64::total_cmp);
    let outside = sorted.len() / 20;
    Some([*sorted.get(outside)?, *sorted.get(sorted.len().checked_sub(outside + 1)?)?])
}

/// The line y = intercept + slope x of least squares, with the standard error of the slope.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct StraightLine {
    pub(crate) slope: f64,
    pub(crate) intercept: f64,
    pub(crate) slope_error: f64,
    /// Share of the variance of y that the line explains.
    pub(crate) explained: f64,
    /// Mean and variance of x.
    x_mean: f64,
    x_variance: f64,
}

impl StraightLine {
    /// Through at least three points that do not all have the same x.
    pub(crate) fn through(points: &[(f64, f64)]) -> Option<Self> {
        let n = points.len() as f64;
        if points.len() < 3 {
            return None;
        }
        let mean = |of: fn(&(f64, f64)) -> f64| points.iter().map(of).sum::<f64>() / n;
        let (x_mean, y_mean) = (mean(|point| point.0), mean(|point| point.1));
        let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
        for (x, y) in points {
            let (dx, dy) = (x - x_mean, y - y_mean);
            xx += dx * dx;
            xy += dx * dy;
            yy += dy * dy;
        }
        if xx <= 0.0 || xx.is_nan() {
            return None;
        }
        let slope = xy / xx;
        let rest = (yy - slope * xy).max(0.0);
        Some(Self {
            slope,
            intercept: y_mean - slope * x_mean,
            slope_error: (rest / (n - 2.0) / xx).sqrt(),
            explained: if yy > 0.0 { 1.0 - rest / yy } else { 1.0 },
            x_mean,
            x_variance: xx / n,
        })
    }

    /// The slope over the line's own value at `x`, and its standard error: value and slope come from the same
    /// points, so that their errors are correlated.
    pub(crate) fn slope_over_value_at(&self, x: f64) -> (f64, f64) {
        let value = self.intercept + self.slope * x;
        let relative = self.slope / value;
        let lever = 1.0 + relative * (self.x_mean - x);
        let error = self.slope_error / value * (lever * lever + relative * relative * self.x_variance).sqrt();
        (relative, error)
    }
}

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

    /// Log-normal with this mean and standard deviation, both positive: for quantities that cannot be
    /// negative. A bell cut at zero would have a larger mean and less scatter than requested.
    pub(crate) fn log_normal(&mut self, mean: f64, deviation: f64) -> f64 {
        let relative = deviation / mean;
        let variance = ln(1.0 + relative * relative);
        exp(ln(mean) - 0.5 * variance + variance.sqrt() * self.bell())
    }
}

/// A result and its uncertainty. The effect of an input is half the difference of the results at both ends of
/// its range.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub(crate) struct Propagated {
    pub(crate) value: f64,
    /// Sum of the effects of all inputs: none of them need be independent.
    pub(crate) sum: f64,
    /// Root of the sum of their squares: for independent inputs.
    pub(crate) root_sum_of_squares: f64,
}

impl Propagated {
    /// The result of `formula` for `inputs`, which it gets in the same order.
    pub(crate) fn of<const N: usize, E>(
        inputs: [Uncertain; N],
        formula: impl Fn([f64; N]) -> Result<f64, E>,
    ) -> Result<Self, E> {
        let middle = inputs.map(|input| input.value);
        let (mut sum, mut squares) = (0.0, 0.0);
        for (index, input) in inputs.iter().enumerate() {
            let moved = |share: f64| {
                let mut values = middle;
                values[index] += share * input.uncertainty;
                formula(values)
            };
            let effect = 0.5 * (moved(1.0)? - moved(-1.0)?).abs();
            sum += effect;
            squares += effect * effect;
        }
        Ok(Self { value: formula(middle)?, sum, root_sum_of_squares: squares.sqrt() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn textbook_line() {
        let line =
            StraightLine::through(&[(0.0, 1.0), (1.0, 2.0), (2.0, 2.0), (3.0, 5.0)]).expect("four points");
        assert!((line.slope - 1.2).abs() < 1e-12 && (line.intercept - 0.7).abs() < 1e-12);
        // Residuals 0.3, 0.1, −1.1, 0.7: sum of squares 1.8; slope error sqrt(1.8/2/5).
        assert!((line.slope_error - 0.18_f64.sqrt()).abs() < 1e-12);
        assert!((line.explained - 0.8).abs() < 1e-12);
    }

    #[test]
    fn too_few_points() {
        assert!(StraightLine::through(&[(0.0, 1.0), (1.0, 1.0)]).is_none());
        assert!(StraightLine::through(&[(1.0, 1.0), (1.0, 2.0), (1.0, 3.0)]).is_none());
    }

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

    #[test]
    fn a_linear_formula_adds_its_coefficients() {
        let inputs = [Uncertain { value: 2.0, uncertainty: 0.3 }, Uncertain { value: 1.0, uncertainty: 0.2 }];
        let result = Propagated::of(inputs, |[x, y]| Ok::<_, ()>(5.0 + x - 2.0 * y)).expect("no failure");
        assert!((result.value - 5.0).abs() < 1e-15);
        assert!((result.sum - 0.7).abs() < 1e-15 && (result.root_sum_of_squares - 0.5).abs() < 1e-15);
    }
}
