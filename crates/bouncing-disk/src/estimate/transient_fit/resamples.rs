//! The error of a fit from fits of resampled curves.

use bouncing_disk_core::numerics::random::SplitMix64;
use bouncing_disk_core::run::WorkCount;

use crate::error::Error;
use crate::estimate::refusal::FitRefusal;
use crate::estimate::transient_fit::shape_grid::{MOMENTS, Rise, ShapeGrid};
use crate::statistics::percentile;

/// The share of the resampled curves that may have no fit on the grid: less than the share beyond an end of
/// the interval.
const MOST_ASTRAY: f64 = 0.01;

/// The resampled units: curves of members, or blocks of residuals.
pub(crate) trait Resampled {
    /// The moments of the curve itself.
    fn moments(&self) -> &[f64];
    /// Samples a curve at random and sets its moments.
    fn draw(&self, random: &mut SplitMix64, moments: &mut [f64]);
    /// The factor by which the intervals are wider than the resampled ones.
    fn widening(&self) -> f64;
    /// The cost of a sample, in flights.
    fn work(&self) -> u64;
}

/// The fits of resampled curves.
pub(crate) struct Resamples {
    centre: Rise,
    fits: Vec<Rise>,
    widening: f64,
}

impl Resamples {
    pub(crate) fn draw(
        grid: &ShapeGrid,
        sample: &dyn Resampled,
        resamples: usize,
        seed: u64,
        work: &mut WorkCount<'_>,
    ) -> Result<Result<Self, FitRefusal>, Error> {
        let Some(centre) = grid.best(sample.moments()) else {
            return Ok(Err(FitRefusal::Undetermined { astray: resamples, resamples }));
        };
        let mut random = SplitMix64::new(seed);
        let mut moments = [0.0; MOMENTS];
        let mut fits = Vec::with_capacity(resamples);
        for _ in 0..resamples {
            sample.draw(&mut random, &mut moments);
            fits.extend(grid.best(&moments));
            work.finish(1)?;
            work.spend(sample.work())?;
        }
        let astray = resamples - fits.len();
        if astray as f64 > MOST_ASTRAY * resamples as f64 {
            return Ok(Err(FitRefusal::Undetermined { astray, resamples }));
        }
        Ok(Ok(Self { centre, fits, widening: sample.widening() }))
    }

    /// The fit of the moments of the curve itself.
    pub(crate) const fn centre(&self) -> Rise {
        self.centre
    }

    /// The ends of the interval about a value of the fit; `of` computes the value from each resampled fit.
    pub(crate) fn about(&self, value: f64, of: &dyn Fn(&Rise) -> f64) -> (f64, f64) {
        let (centre, (low, high)) = (of(&self.centre), self.percentiles(of));
        (value + self.widening * (low - centre), value + self.widening * (high - centre))
    }

    /// The values below and above which one fit in forty lies.
    fn percentiles(&self, of: &dyn Fn(&Rise) -> f64) -> (f64, f64) {
        let mut values: Vec<f64> = self.fits.iter().map(of).collect();
        values.sort_by(f64::total_cmp);
        (percentile(&values, 0.025), percentile(&values, 0.975))
    }
}
