//! What the fits of resampled curves say of the error of a fit.

use bouncing_disk_core::WorkCount;
use bouncing_disk_core::elementary::{exp, ln};
use bouncing_disk_core::numerics::random::SplitMix64;

use super::shape_grid::{CONSTANTS, Rise, ShapeGrid};
use crate::error::Error;
use crate::motor::fit_refusal::FitRefusal;
use crate::motor::interval_estimate::IntervalEstimate;

/// The share of the resampled curves that may have no fit on the grid: less than the share beyond an end of the interval.
const MOST_ASTRAY: f64 = 0.01;

/// What is drawn again and again: curves of members, or blocks of residuals at the places where they may lie.
pub(super) trait Resampled {
    /// The products with the shapes of what the curve itself has.
    fn products(&self) -> &[f64];
    /// Draws a curve and sets its products with the shapes.
    fn draw(&self, random: &mut SplitMix64, products: &mut [f64]);
    /// How much wider than the resampled ones the intervals are.
    fn widening(&self) -> f64;
    /// The work of a draw, in flights.
    fn work(&self) -> u64;
}

/// A fit with intervals: steady speed, constant and their quotient.
pub(super) struct Intervals {
    pub(super) steady_speed: IntervalEstimate,
    pub(super) constant: IntervalEstimate,
    pub(super) stall_acceleration: IntervalEstimate,
}

/// The fits of resampled curves.
pub(super) struct Resamples {
    centre: Rise,
    fits: Vec<Rise>,
    widening: f64,
}

impl Resamples {
    pub(super) fn draw(
        grid: &ShapeGrid,
        sample: &dyn Resampled,
        resamples: usize,
        seed: u64,
        work: &mut WorkCount<'_>,
    ) -> Result<Result<Self, FitRefusal>, Error> {
        let Some(centre) = grid.best(sample.products()) else {
            return Ok(Err(FitRefusal::Undetermined { astray: resamples, resamples }));
        };
        let mut random = SplitMix64::new(seed);
        let mut products = [0.0; CONSTANTS];
        let mut fits = Vec::with_capacity(resamples);
        for _ in 0..resamples {
            sample.draw(&mut random, &mut products);
            fits.extend(grid.best(&products));
            work.finish(1)?;
            work.spend(sample.work())?;
        }
        let astray = resamples - fits.len();
        if astray as f64 > MOST_ASTRAY * resamples as f64 {
            return Ok(Err(FitRefusal::Undetermined { astray, resamples }));
        }
        Ok(Ok(Self { centre, fits, widening: sample.widening() }))
    }

    /// The intervals about the values of the fit, in its units: speeds have been multiplied by `scale`.
    pub(super) fn intervals(&self, steady: f64, constant: f64, scale: f64) -> Result<Intervals, Error> {
        let about = |value: f64, of: &dyn Fn(&Rise) -> f64| {
            let (centre, (low, high)) = (of(&self.centre), self.percentiles(of));
            (value + self.widening * (low - centre), value + self.widening * (high - centre))
        };
        let (low, high) = about(steady * scale, &|rise| rise.steady);
        let steady_speed = IntervalEstimate::about(steady, low / scale, high / scale)?;
        let (low, high) = about(ln(constant), &|rise| rise.log_constant);
        let time_constant = IntervalEstimate::about(constant, exp(low), exp(high))?;
        // The quotient by the constant of the fit, so that times of any size neither overflow nor vanish in it.
        let log = ln(constant);
        let (low, high) = about(steady * scale, &|rise| rise.steady * exp(log - rise.log_constant));
        let (low, high) = (low / scale / constant, high / scale / constant);
        let stall_acceleration = IntervalEstimate::about(steady / constant, low, high)?;
        Ok(Intervals { steady_speed, constant: time_constant, stall_acceleration })
    }

    /// The numbers that a fortieth of the fits lie below and above.
    fn percentiles(&self, of: &dyn Fn(&Rise) -> f64) -> (f64, f64) {
        let mut values: Vec<f64> = self.fits.iter().map(of).collect();
        values.sort_by(f64::total_cmp);
        let at = |share: f64| {
            let place = share * (values.len() - 1) as f64;
            let below = place as usize;
            let above = (below + 1).min(values.len() - 1);
            values[below] + (place - below as f64) * (values[above] - values[below])
        };
        (at(0.025), at(0.975))
    }
}

/// A number in 0..count, each as likely as the others.
pub(super) fn index(random: &mut SplitMix64, count: usize) -> usize {
    ((random.unit() * count as f64) as usize).min(count - 1)
}
