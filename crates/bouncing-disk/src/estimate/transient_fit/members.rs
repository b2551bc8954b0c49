//! Resampling the members of an ensemble.

use bouncing_disk_core::numerics::random::SplitMix64;
use bouncing_disk_core::run::WorkCount;

use crate::error::Error;
use crate::estimate::transient_fit::resamples::Resampled;
use crate::estimate::transient_fit::shape_grid::{MOMENTS, RunSpeeds, ShapeGrid};
use crate::statistics::drawn_index;
use crate::statistics::small_sample_widening;

/// The moments of each run, or group of runs, and of all of them.
pub(crate) struct Members {
    of_runs: Vec<f64>,
    moments: Vec<f64>,
    widening: f64,
}

impl Members {
    /// The moments of runs whose time counts from `start`; `misfit` is the factor by which the intervals are
    /// widened because of the form.
    pub(crate) fn new(
        runs: &[RunSpeeds],
        start: f64,
        misfit: f64,
        grid: &ShapeGrid,
        work: &mut WorkCount<'_>,
    ) -> Result<Self, Error> {
        let mut of_runs = vec![0.0; MOMENTS * runs.len()];
        let mut shapes = grid.at(&runs[0].times, start, work)?;
        for (k, (run, moments)) in runs.iter().zip(of_runs.chunks_exact_mut(MOMENTS)).enumerate() {
            if k > 0 && run.times != runs[k - 1].times {
                shapes = grid.at(&run.times, start, work)?;
            }
            shapes.add_curve(&run.speeds, run.weight, moments);
            work.spend(run.speeds.len() as u64)?;
        }
        let mut moments = vec![0.0; MOMENTS];
        for own in of_runs.chunks_exact(MOMENTS) {
            add(own, &mut moments);
        }
        // Percentiles of few members lie closer together than those of a normal distribution.
        let widening = misfit * small_sample_widening(runs.len() - 1);
        Ok(Self { of_runs, moments, widening })
    }
}

/// Adds moments.
fn add(own: &[f64], sum: &mut [f64]) {
    for (sum, own) in sum.iter_mut().zip(own) {
        *sum += own;
    }
}

impl Resampled for Members {
    fn moments(&self) -> &[f64] {
        &self.moments
    }

    fn draw(&self, random: &mut SplitMix64, moments: &mut [f64]) {
        moments.fill(0.0);
        let runs = self.of_runs.len() / MOMENTS;
        for _ in 0..runs {
            let own = MOMENTS * drawn_index(random, runs);
            add(&self.of_runs[own..own + MOMENTS], moments);
        }
    }

    fn widening(&self) -> f64 {
        self.widening
    }

    fn work(&self) -> u64 {
        1 + (self.of_runs.len() / MOMENTS) as u64
    }
}
