//! Emulates a smooth response, known with errors at some points, by a Gaussian process with a linear trend. Its
//! variance v states the possible error far from these points.
//!
//! The errors of the computed values are known, the covariance is Matern's of order 5/2 with a length along
//! each coordinate, and a rough variance represents motions that lock to a cycle. Lengths and variances
//! maximise the likelihood. Motions may lock only in part of the ranges. Therefore v and the rough variance
//! are multiplied by the ratio of the mean square of nearby leave-one-out errors to its expectation, if above
//! one, and by the square of Student's factor for the number of points.

use bouncing_disk_core::numerics::elementary::{exp, ln};
use bouncing_disk_core::numerics::statistics::NORMAL_975;
use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

use crate::statistics::student_quantile;

/// The ratio of the variance of the trend's coefficients to the variance of the values; large, so that any
/// trend is possible.
const TREND: f64 = 10.0;

/// Bounds of the lengths, and of the variances relative to the variance of the values.
const LENGTHS: [f64; 2] = [0.15, 20.0];
const VARIANCES: [f64; 2] = [1e-8, 100.0];

/// Prior: the response bends over about this length, within a factor of [`SPREAD`] either way.
const LENGTH: f64 = 1.5;
const SPREAD: f64 = 3.0;

/// Distance within which values are evidence of roughness, as a share of half the ranges.
const NEAR: f64 = 0.3;

/// A response computed at a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Response {
    pub(crate) value: f64,
    /// Its standard error, independent between points.
    pub(crate) error: f64,
    /// Its possible systematic error, perhaps in the same direction at other points.
    pub(crate) bias: f64,
    /// The variance of a measurement of a motor at this point, without the error of the computed value.
    pub(crate) scatter: f64,
}

#[derive(Debug, Clone)]
pub(crate) struct Emulator {
    places: Vec<DVector<f64>>,
    values: DVector<f64>,
    /// Variance of each value, and the square of its bias.
    errors: Vec<f64>,
    biases: Vec<f64>,
    scatters: Vec<f64>,
    mean: f64,
    /// Logarithms of a length along each coordinate, of the variance of the smooth part, and of the rough
    /// variance (motions that lock to a cycle).
    scales: Vec<f64>,
    /// Inverse squares of the lengths along each coordinate, and both variances.
    rates: Vec<f64>,
    signal: f64,
    roughness: f64,
    trend: f64,
    root: Cholesky<f64, Dyn>,
    weights: DVector<f64>,
    /// For each value, its deviation from the prediction by all others and the variance of that deviation; then
    /// the ratio of the squared deviation to this variance.
    pub(crate) left_out: Vec<(f64, f64)>,
    surprises: Vec<f64>,
}

impl Emulator {
    /// The emulator with the scales of maximum likelihood, searched from the previous scales.
    pub(crate) fn of(
        places: Vec<DVector<f64>>,
        values: &[Response],
        earlier: Option<&Self>,
        goes_on: &(dyn Fn() -> bool + Sync),
    ) -> Option<Self> {
        let count = values.len() as f64;
        let mean = values.iter().map(|own| own.value).sum::<f64>() / count;
        let errors: Vec<f64> = values.iter().map(|own| own.error * own.error).collect();
        let biases: Vec<f64> = values.iter().map(|own| own.bias * own.bias).collect();
        let scatters: Vec<f64> = values.iter().map(|own| own.scatter).collect();
        let values = DVector::from_iterator(values.len(), values.iter().map(|own| own.value - mean));
        let least = errors.iter().copied().fold(f64::INFINITY, f64::min);
        let size = (values.norm_squared() / count).max(least).max(f64::MIN_POSITIVE);
        let coordinates = places.first()?.len();
        let mut scales = vec![ln(LENGTH); coordinates];
        scales.extend([ln(size), ln(1e-4 * size)]);
        let scales = earlier.map_or(scales, |earlier| earlier.scales.clone());
        let build = |scales: Vec<f64>| {
            let (places, values) = (places.clone(), values.clone());
            Self::with(
                places,
                values,
                [errors.clone(), biases.clone(), scatters.clone()],
                (mean, TREND * size),
                scales,
            )
        };
        let mut best = build(scales)?;
        let mut likelihood = best.likelihood(size);
        let mut step = 1.2;
        while step > 0.2 && goes_on() {
            let mut found = false;
            for index in 0..best.scales.len() {
                for change in [step, -step] {
                    let mut scales = best.scales.clone();
                    let [low, high] = if index < coordinates { LENGTHS } else { VARIANCES.map(|v| v * size) };
                    scales[index] = (scales[index] + change).clamp(ln(low), ln(high));
                    let Some(other) = build(scales) else { continue };
                    let own = other.likelihood(size);
                    if own > likelihood + 1e-3 {
                        (best, likelihood, found) = (other, own, true);
                        break;
                    }
                }
            }
            if !found {
                step *= 0.5;
            }
        }
        let inverse = best.root.inverse().diagonal();
        let each = best.weights.iter().zip(inverse.iter());
        (best.left_out, best.surprises) =
            each.map(|(weight, own)| ((weight / own, 1.0 / own), weight * weight / own)).unzip();
        Some(best)
    }

    /// The factor of the variances at a point. If values near it are further from their predictions than
    /// expected, the response is rougher there than elsewhere (motions lock to a cycle only in part of the
    /// ranges). Student's factor allows for scales determined by few values.
    fn inflation(&self, place: &DVector<f64>) -> f64 {
        let (mut sum, mut weights) = (0.0, 0.0);
        for (node, surprise) in self.places.iter().zip(&self.surprises) {
            let weight = 1e-3 + exp(-(node - place).norm_squared() / (2.0 * NEAR * NEAR));
            (sum, weights) = (sum + weight * surprise, weights + weight);
        }
        let degrees = self.surprises.len() as f64 - place.len() as f64 - 1.0;
        let few = student_quantile(degrees) / NORMAL_975;
        few * few * (sum / weights).max(1.0)
    }

    fn with(
        places: Vec<DVector<f64>>,
        values: DVector<f64>,
        [errors, biases, scatters]: [Vec<f64>; 3],
        (mean, trend): (f64, f64),
        scales: Vec<f64>,
    ) -> Option<Self> {
        let none = DMatrix::identity(0, 0);
        let variances = &scales[scales.len() - 2..];
        let (signal, roughness) = (exp(variances[0]), exp(variances[1]));
        let mut own = Self {
            rates: scales[..scales.len() - 2].iter().map(|scale| exp(-2.0 * scale)).collect(),
            signal,
            roughness,
            places,
            values,
            errors,
            biases,
            scatters,
            mean,
            scales,
            trend,
            root: Cholesky::new(none)?,
            weights: DVector::zeros(0),
            left_out: Vec::new(),
            surprises: Vec::new(),
        };
        let count = own.places.len();
        let mut covariance = DMatrix::zeros(count, count);
        for i in 0..count {
            for j in 0..=i {
                let value = own.covariance(&own.places[i], &own.places[j]);
                (covariance[(i, j)], covariance[(j, i)]) = (value, value);
            }
            // A share of the trend's size bounds the condition number of the matrix.
            covariance[(i, i)] += own.errors[i] + own.roughness + 1e-10 * own.trend;
        }
        own.root = Cholesky::new(covariance)?;
        own.weights = own.root.solve(&own.values);
        Some(own)
    }

    /// The covariance of the smooth part between two points (Matern's of order 5/2).
    fn covariance(&self, one: &DVector<f64>, other: &DVector<f64>) -> f64 {
        let root = 5.0_f64.sqrt() * self.distance(one, other);
        self.signal * (1.0 + root + root * root / 3.0) * exp(-root) + self.trend * (1.0 + one.dot(other))
    }

    fn distance(&self, one: &DVector<f64>, other: &DVector<f64>) -> f64 {
        let terms = one.iter().zip(other.iter()).zip(&self.rates);
        terms.map(|((a, b), rate)| (a - b) * (a - b) * rate).sum::<f64>().sqrt()
    }

    /// The rough variance at a point.
    pub(crate) fn roughness(&self, place: &DVector<f64>) -> f64 {
        self.roughness * self.inflation(place)
    }

    /// The logarithm of the likelihood, including the prior for the lengths.
    fn likelihood(&self, size: f64) -> f64 {
        let determinant = self.root.l_dirty().diagonal().iter().map(|root| ln(*root)).sum::<f64>();
        let coordinates = self.scales.len() - 2;
        let off = |scale: f64, expected: f64| {
            ((scale - ln(expected)) / ln(SPREAD)) * ((scale - ln(expected)) / ln(SPREAD))
        };
        let before: f64 = self.scales[..coordinates].iter().map(|scale| off(*scale, LENGTH)).sum();
        let signal = 0.1 * off(self.scales[coordinates], size);
        -0.5 * (self.values.dot(&self.weights) + before + signal) - determinant
    }

    /// The smooth response at a point, and the variance of its error without the bias.
    pub(crate) fn at(&self, place: &DVector<f64>) -> (f64, f64) {
        let mut covariances = self.covariances(place);
        let value = self.mean + covariances.dot(&self.weights);
        let own = self.covariance(place, place);
        // The diagonal of a Cholesky factor is positive.
        let _ = self.root.l_dirty().solve_lower_triangular_mut(&mut covariances);
        (value, (own - covariances.norm_squared()).max(0.0) * self.inflation(place))
    }

    /// The square of the bias, interpolated from the nearest points.
    pub(crate) fn bias(&self, place: &DVector<f64>) -> f64 {
        self.nearby(place, &self.biases)
    }

    /// The variance of a measurement, interpolated from the nearest points.
    pub(crate) fn scatter(&self, place: &DVector<f64>) -> f64 {
        self.nearby(place, &self.scatters)
    }

    fn nearby(&self, place: &DVector<f64>, values: &[f64]) -> f64 {
        let (mut sum, mut weights) = (0.0, 0.0);
        for (node, value) in self.places.iter().zip(values) {
            let distance = self.distance(place, node);
            let weight = 1.0 / (1e-6 + distance * distance * distance * distance);
            (sum, weights) = (sum + weight * value, weights + weight);
        }
        sum / weights
    }

    fn covariances(&self, place: &DVector<f64>) -> DVector<f64> {
        DVector::from_iterator(self.places.len(), self.places.iter().map(|node| self.covariance(place, node)))
    }

    /// The derivatives of the response.
    pub(crate) fn slopes(&self, place: &DVector<f64>) -> DVector<f64> {
        let mut slopes = DVector::zeros(place.len());
        for (node, weight) in self.places.iter().zip(self.weights.iter()) {
            let root = 5.0_f64.sqrt() * self.distance(place, node);
            let factor = -5.0 / 3.0 * self.signal * (1.0 + root) * exp(-root);
            for (index, slope) in slopes.iter_mut().enumerate() {
                let along = (place[index] - node[index]) * self.rates[index];
                *slope += weight * (factor * along + self.trend * node[index]);
            }
        }
        slopes
    }

    /// Adds a data point equal to the prediction there (kriging believer).
    pub(crate) fn believing(&self, place: &DVector<f64>) -> Option<Self> {
        let (value, _) = self.at(place);
        let (mut places, mut errors) = (self.places.clone(), self.errors.clone());
        let (mut biases, mut scatters) = (self.biases.clone(), self.scatters.clone());
        biases.push(self.bias(place));
        scatters.push(self.scatter(place));
        errors.push(errors.iter().sum::<f64>() / errors.len() as f64);
        places.push(place.clone());
        let values = self.values.push(value - self.mean);
        let scales = self.scales.clone();
        let mut own =
            Self::with(places, values, [errors, biases, scatters], (self.mean, self.trend), scales)?;
        own.surprises.clone_from(&self.surprises);
        Some(own)
    }
}
