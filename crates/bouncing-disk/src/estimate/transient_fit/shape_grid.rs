//! Least-squares fits of many curves by their moments with shapes that are computed once.
//!
//! With f the shape at the times of the curve y for a constant t_c, the best t_c maximises G = (f.y)^2/(f.f). The
//! products f.y are linear in y and computed once on a grid of ln t_c with h = 0.02. The parabola through three
//! values of G has the error h^2 G'''/(6 G''), at most 1e-4 of t_c, and 5e-3 for a ramp, which has kinks; intervals
//! are at least ten times wider.

use bouncing_disk_core::numerics::elementary::{exp, exp_m1, ln};
use bouncing_disk_core::run::WorkCount;

use crate::error::Error;
use crate::estimate::fit::Start;

/// Extent of the grid to either side, in the logarithm of the constant: a factor of five.
const REACH: f64 = 1.6;

/// Steps of the grid to either side. The parabola through three of them misses the best constant by less than
/// 1e-4 of it, far below any interval.
const STEPS: i32 = 80;

/// Number of constants of the grid.
const CONSTANTS: usize = 2 * STEPS as usize + 1;

/// Number of moments of a curve, the sums that its fit needs: its weight; for each constant, the sums of the
/// shapes f and of their squares; the sum of its speeds; and, for each constant, the sum of the products of
/// speeds and shapes. The moments of several curves add up.
pub(crate) const MOMENTS: usize = SPEEDS + OF_SPEEDS;

/// Index of the first moment that depends on the speeds.
pub(crate) const SPEEDS: usize = 1 + 2 * CONSTANTS;

/// Number of moments that depend on the speeds.
pub(crate) const OF_SPEEDS: usize = 1 + CONSTANTS;

/// 1 - exp(-x).
pub(crate) fn exponential(x: f64) -> f64 {
    -exp_m1(-x)
}

/// min(x, 1).
pub(crate) fn ramp(x: f64) -> f64 {
    x.min(1.0)
}

/// A run, or the mean of a group of runs with the same times.
pub(crate) struct RunSpeeds {
    pub(crate) times: Vec<f64>,
    pub(crate) speeds: Vec<f64>,
    /// Number of runs that it represents.
    pub(crate) weight: f64,
}

/// The least-squares fit steady - rise (1 - shape(t/constant)).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Rise {
    pub(crate) steady: f64,
    pub(crate) rise: f64,
    pub(crate) log_constant: f64,
}

/// Constants about a fit's own, from which the best one for the moments of a curve is chosen.
///
/// For a given constant the best rise B is (f.y)/(f.f), and it reduces the sum of squares by G =
/// (f.y)^2/(f.f). If the initial speed is free, f and y are taken relative to their means
/// (docs/numerics-dynamics.md, "Fits with intervals").
pub(crate) struct ShapeGrid {
    logs: Vec<f64>,
    shape: fn(f64) -> f64,
    start: Start,
}

/// The shapes of a grid at the times of one curve.
pub(crate) struct Shapes {
    points: usize,
    shapes: Vec<f64>,
}

impl ShapeGrid {
    pub(crate) fn new(constant: f64, shape: fn(f64) -> f64, start: Start) -> Self {
        let step = REACH / f64::from(STEPS);
        let logs = (-STEPS..=STEPS).map(|k| ln(constant) + f64::from(k) * step).collect();
        Self { logs, shape, start }
    }

    /// The shapes at these times, counted from `from`.
    pub(crate) fn at(&self, times: &[f64], from: f64, work: &mut WorkCount<'_>) -> Result<Shapes, Error> {
        let mut shapes = Vec::with_capacity(CONSTANTS * times.len());
        for log in &self.logs {
            let constant = exp(*log);
            shapes.extend(times.iter().map(|time| (self.shape)((time - from) / constant)));
            work.spend(1 + times.len() as u64 / 4)?;
        }
        Ok(Shapes { points: times.len(), shapes })
    }

    /// The fit of the curve with these moments; `None` if the best constant lies at an end of the grid.
    pub(crate) fn best(&self, moments: &[f64]) -> Option<Rise> {
        let (weight, speeds) = (moments[0], moments[SPEEDS]);
        let (sums, squares) = moments[1..SPEEDS].split_at(CONSTANTS);
        let products = &moments[SPEEDS + 1..];
        let is_free = self.start == Start::AnySpeed;
        // Product and square of the shape of a constant.
        let of = |k: usize| {
            let mean = if is_free { sums[k] / weight } else { 0.0 };
            (products[k] - mean * speeds, squares[k] - mean * sums[k], mean)
        };
        let gain = |k: usize| {
            let (product, square, _) = of(k);
            if square > 0.0 { product * product / square } else { 0.0 }
        };
        let (mut best, mut most) = (0, gain(0));
        for k in 1..CONSTANTS {
            let own = gain(k);
            if own > most {
                (best, most) = (k, own);
            }
        }
        if best == 0 || best + 1 == CONSTANTS {
            return None;
        }
        let (before, at, after) = (gain(best - 1), gain(best), gain(best + 1));
        let bend = before - 2.0 * at + after;
        // If three gains are equal, the curve does not determine the best constant.
        let offset = if bend < 0.0 { (0.5 * (before - after) / bend).clamp(-1.0, 1.0) } else { 0.0 };
        let between = |of: &dyn Fn(usize) -> f64| {
            let (before, at, after) = (of(best - 1), of(best), of(best + 1));
            at + 0.5 * offset * ((after - before) + offset * (before - 2.0 * at + after))
        };
        let rise = |k: usize| of(k).0 / of(k).1;
        let steady = |k: usize| if is_free { speeds / weight + rise(k) * (1.0 - of(k).2) } else { rise(k) };
        Some(Rise {
            steady: between(&steady),
            rise: between(&rise),
            log_constant: self.logs[best] + offset * (REACH / f64::from(STEPS)),
        })
    }
}

impl Shapes {
    /// Adds the moments of a curve at all times, each with this weight.
    pub(crate) fn add_curve(&self, speeds: &[f64], weight: f64, moments: &mut [f64]) {
        moments[0] += weight * self.points as f64;
        for (k, row) in self.shapes.chunks_exact(self.points).enumerate() {
            moments[1 + k] += weight * row.iter().sum::<f64>();
            moments[1 + CONSTANTS + k] += weight * row.iter().map(|shape| shape * shape).sum::<f64>();
        }
        self.add_speeds(0, speeds, weight, &mut moments[SPEEDS..]);
    }

    /// Adds to the last moments, those from [`SPEEDS`] on, the contribution of further speeds from the point
    /// `from` on.
    pub(crate) fn add_speeds(&self, from: usize, speeds: &[f64], weight: f64, moments: &mut [f64]) {
        let (sum, products) = moments.split_at_mut(1);
        sum[0] += weight * speeds.iter().sum::<f64>();
        for (row, product) in self.shapes.chunks_exact(self.points).zip(products) {
            let shapes = row[from..].iter();
            *product += weight * shapes.zip(speeds).map(|(shape, value)| shape * value).sum::<f64>();
        }
    }
}
