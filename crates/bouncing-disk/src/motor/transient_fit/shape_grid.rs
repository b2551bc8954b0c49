//! Least-squares fits of many curves that have the same times, by products with shapes that are computed once.

use bouncing_disk_core::WorkCount;
use bouncing_disk_core::elementary::{exp, exp_m1, ln};

use crate::error::Error;

/// Reach of the grid to either side, in the logarithm of the constant: a factor of five.
const REACH: f64 = 1.6;

/// Steps of the grid to either side. The parabola through three of them is off the best constant by less than 1e-4 of it,
/// far below any interval.
const STEPS: i32 = 80;

/// Constants of the grid.
pub(super) const CONSTANTS: usize = 2 * STEPS as usize + 1;

/// 1 - exp(-x).
pub(super) fn exponential(x: f64) -> f64 {
    -exp_m1(-x)
}

/// min(x, 1).
pub(super) fn ramp(x: f64) -> f64 {
    x.min(1.0)
}

/// steady * shape(t/constant) of the least squares.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Rise {
    pub(super) steady: f64,
    pub(super) log_constant: f64,
}

/// Shapes at the times of a curve, for constants about that of its fit.
///
/// For a given constant the best steady speed is (f.y)/(f.f) and the sum of squares is y.y - (f.y)^2/(f.f): all that a
/// curve y has to do with it is its products with the shapes f, which are linear in y. The products of a sum
/// of curves are the sums of their products.
pub(super) struct ShapeGrid {
    points: usize,
    logs: Vec<f64>,
    shapes: Vec<f64>,
    squares: Vec<f64>,
}

impl ShapeGrid {
    pub(super) fn new(
        times: &[f64],
        constant: f64,
        shape: fn(f64) -> f64,
        work: &mut WorkCount<'_>,
    ) -> Result<Self, Error> {
        let (points, centre) = (times.len(), ln(constant));
        let mut grid = Self {
            points,
            logs: Vec::with_capacity(CONSTANTS),
            shapes: Vec::with_capacity(CONSTANTS * points),
            squares: Vec::with_capacity(CONSTANTS),
        };
        for step in -STEPS..=STEPS {
            let log = centre + f64::from(step) * (REACH / f64::from(STEPS));
            let constant = exp(log);
            let row = grid.shapes.len();
            grid.shapes.extend(times.iter().map(|&time| shape(time / constant)));
            grid.logs.push(log);
            grid.squares.push(grid.shapes[row..].iter().map(|shape| shape * shape).sum());
            work.spend(1 + points as u64 / 4)?;
        }
        Ok(grid)
    }

    /// Adds to `products` those of part of a curve, from the point `from` on, with the shapes.
    pub(super) fn add_products(&self, from: usize, values: &[f64], products: &mut [f64]) {
        for (row, product) in self.shapes.chunks_exact(self.points).zip(products) {
            let shapes = row[from..].iter();
            *product += shapes.zip(values).map(|(shape, value)| shape * value).sum::<f64>();
        }
    }

    /// The fit of the curve that has these products; `None` where the best constant lies at an end of the grid.
    pub(super) fn best(&self, products: &[f64]) -> Option<Rise> {
        let gain = |k: usize| products[k] * products[k] / self.squares[k];
        let best = (0..CONSTANTS).fold(0, |best, k| if gain(k) > gain(best) { k } else { best });
        if best == 0 || best + 1 == CONSTANTS {
            return None;
        }
        let (before, at, after) = (gain(best - 1), gain(best), gain(best + 1));
        let bend = before - 2.0 * at + after;
        // Where three gains are alike the curve does not say which constant is best.
        let offset = if bend < 0.0 { (0.5 * (before - after) / bend).clamp(-1.0, 1.0) } else { 0.0 };
        let steady = |k: usize| products[k] / self.squares[k];
        let (before, at, after) = (steady(best - 1), steady(best), steady(best + 1));
        Some(Rise {
            steady: at + 0.5 * offset * ((after - before) + offset * (before - 2.0 * at + after)),
            log_constant: self.logs[best] + offset * (REACH / f64::from(STEPS)),
        })
    }
}
