//! Resampling the residuals of one measured curve, in blocks longer than their correlation time.
//!
//! Every block stays in place, is scaled to the size of its neighbours and is multiplied by +1 or -1 (a wild
//! bootstrap), so noise may vary along the curve.
//!
//! A block is first divided by 1 minus its leverage, the part that the fit has absorbed, and scaled to the mean square
//! of the seven blocks about it. The small-sample factor uses a quarter of the blocks, at least five, because the rise
//! determines t_c and the plateau alpha_ss.
//!
//! If each residual retains the share phi of the one before, the correlation time is tau = (1 + phi)/(1 - phi)
//! points. The variance of the sum of a block of l points is then sigma^2 l tau, reduced by the share 2
//! phi/((1 - phi^2) l) = (tau - 1/tau)/(2 l), the covariance of neighbouring blocks. Blocks have l >= 2.5
//! (tau - 1/tau) points, at least a 64th of the curve. At most 20 % is missing, for which the factor 1/sqrt(1 -
//! (tau - 1/tau)/(2 l)) compensates.

use bouncing_disk_core::numerics::random::SplitMix64;
use bouncing_disk_core::run::WorkCount;

use crate::error::Error;
use crate::estimate::refusal::FitRefusal;
use crate::estimate::transient_fit::resamples::Resampled;
use crate::estimate::transient_fit::shape_grid::{MOMENTS, OF_SPEEDS, RunSpeeds, SPEEDS, ShapeGrid};
use crate::statistics::correlation_time;
use crate::statistics::small_sample_widening;

/// Fewest blocks; fewer would contain too little information about each other.
const LEAST_BLOCKS: usize = 8;

/// About a quarter of the blocks determine a parameter, as the blocks of the rise determine the time
/// constant; at least this number is assumed.
const LEAST_SAMPLE: usize = 5;

/// Largest number of blocks; more would hardly improve the estimate of the error.
const MOST_BLOCKS: usize = 64;

/// Factor by which a block is longer than the correlation time (docs/numerics-dynamics.md, "Fits with
/// intervals").
const BLOCK_TIMES: f64 = 2.5;

/// Residuals below this share of the steady speed are errors of the search, which ends about this close to the
/// best constant.
const EXACT: f64 = 1.0e-6;

/// Neighbouring blocks on either side that are assumed to have equally large noise.
const NEIGHBOURS: usize = 3;

/// Largest leverage of a block for which its residuals are corrected; beyond it the block alone determines a
/// parameter.
const LARGEST_LEVERAGE: f64 = 0.9;

/// A curve whose residuals are cut into blocks of equal length, except for a longer last one.
pub(crate) struct Blocks {
    fitted: Vec<f64>,
    /// For each block the changes of the moments that depend on speeds.
    changes: Vec<f64>,
    widening: f64,
}

impl Blocks {
    /// The blocks of a curve with these fitted values and their derivatives with respect to the parameters.
    pub(crate) fn new(
        run: &RunSpeeds,
        start: f64,
        fitted: &[f64],
        derivatives: &[Vec<f64>],
        grid: &ShapeGrid,
        work: &mut WorkCount<'_>,
    ) -> Result<Result<Self, FitRefusal>, Error> {
        let points = fitted.len();
        let residuals: Vec<f64> = run.speeds.iter().zip(fitted).map(|(speed, fit)| speed - fit).collect();
        let (parameters, steady) = (derivatives.len(), fitted[points - 1]);
        let squares: f64 = residuals.iter().map(|residual| residual * residual).sum();
        let is_exact = squares <= EXACT * EXACT * steady * steady * points as f64;
        let too_long = |correlated_points| Ok(Err(FitRefusal::Correlated { correlated_points, points }));
        let Some(time) = (if is_exact { Some(1.0) } else { correlation_time(&residuals, parameters) }) else {
            return too_long(0.25 * points as f64);
        };
        let needed = BLOCK_TIMES * (time - 1.0 / time);
        let block = (needed.ceil() as usize).max(points.div_ceil(MOST_BLOCKS)).max(1);
        let blocks = points / block;
        if blocks < LEAST_BLOCKS {
            return too_long(time);
        }
        // Neighbouring blocks share this part of the variance of their sums, which is lost with independent
        // signs.
        let shared = (time - 1.0 / time) / (2.0 * block as f64);
        let leverages = leverages(derivatives);
        let shapes = grid.at(&run.times, start, work)?;
        let mut moments = vec![0.0; MOMENTS];
        shapes.add_curve(fitted, 1.0, &mut moments);
        let ends = |k: usize| (k * block, if k + 1 == blocks { points } else { (k + 1) * block });
        // The fit has absorbed the block's leverage from the part of its residuals that the parameters can
        // imitate.
        let sizes: Vec<[f64; 2]> = (0..blocks)
            .map(|k| {
                let (from, end) = ends(k);
                let left = 1.0 - leverages[from..end].iter().sum::<f64>().min(LARGEST_LEVERAGE);
                let square = residuals[from..end].iter().map(|residual| residual * residual).sum::<f64>();
                let own = square / (end - from) as f64;
                [own, own / (left * left)]
            })
            .collect();
        let mut changes = vec![0.0; OF_SPEEDS * blocks];
        for (k, changes) in changes.chunks_exact_mut(OF_SPEEDS).enumerate() {
            let (from, end) = ends(k);
            let near = &sizes[k.saturating_sub(NEIGHBOURS)..(k + NEIGHBOURS + 1).min(blocks)];
            let noise = near.iter().map(|[_, noise]| noise).sum::<f64>() / near.len() as f64;
            let scale = if sizes[k][0] > 0.0 { (noise / sizes[k][0]).sqrt() } else { 0.0 };
            shapes.add_speeds(from, &residuals[from..end], scale, changes);
            work.spend((end - from) as u64)?;
        }
        let widening = small_sample_widening((blocks / 4).max(LEAST_SAMPLE)) / (1.0 - shared).sqrt();
        Ok(Ok(Self { fitted: moments, changes, widening }))
    }
}

/// The diagonal of the hat matrix, which maps a curve to its fit, by orthogonalising the derivatives one
/// after another.
pub(crate) fn leverages(derivatives: &[Vec<f64>]) -> Vec<f64> {
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let mut leverages = vec![0.0; derivatives.first().map_or(0, Vec::len)];
    let mut directions: Vec<Vec<f64>> = Vec::with_capacity(derivatives.len());
    for derivative in derivatives {
        let mut own = derivative.clone();
        for direction in &directions {
            let along = dot(&own, direction);
            own.iter_mut().zip(direction).for_each(|(own, direction)| *own -= along * direction);
        }
        let norm = dot(&own, &own).sqrt();
        if norm > 0.0 {
            own.iter_mut().for_each(|own| *own /= norm);
            leverages.iter_mut().zip(&own).for_each(|(leverage, own)| *leverage += own * own);
            directions.push(own);
        }
    }
    leverages
}

impl Resampled for Blocks {
    fn moments(&self) -> &[f64] {
        &self.fitted
    }

    fn draw(&self, random: &mut SplitMix64, moments: &mut [f64]) {
        moments.copy_from_slice(&self.fitted);
        for change in self.changes.chunks_exact(OF_SPEEDS) {
            let sign = if random.unit() < 0.5 { -1.0 } else { 1.0 };
            for (moment, change) in moments[SPEEDS..].iter_mut().zip(change) {
                *moment += sign * change;
            }
        }
    }

    fn widening(&self) -> f64 {
        self.widening
    }

    fn work(&self) -> u64 {
        1 + (self.changes.len() / OF_SPEEDS) as u64
    }
}
