//! Resampling the residuals of one measured curve, in blocks that are longer than their memory.

use bouncing_disk_core::WorkCount;
use bouncing_disk_core::numerics::random::SplitMix64;

use super::resamples::{Resampled, index};
use super::shape_grid::{CONSTANTS, ShapeGrid};
use crate::error::Error;
use crate::motor::correlation::correlation_time;
use crate::motor::fit_refusal::FitRefusal;
use crate::motor::interval_estimate::small_sample_widening;

/// The fewest blocks: fewer would say too little about each other.
const LEAST_BLOCKS: usize = 8;

/// The most blocks: more would say hardly more about the error, and cost the square of their number.
const MOST_BLOCKS: usize = 64;

/// What a block is longer than the correlation time by (docs/numerics/motors.md, "Fits with intervals").
const BLOCK_TIMES: f64 = 2.5;

/// Residuals below this share of the steady speed are those of the search, which ends about so near the best constant.
const EXACT: f64 = 1.0e-6;

/// Parameters of a rise.
const PARAMETERS: usize = 2;

/// Residuals cut into blocks of one length; what is left over at the end takes the beginning of a block.
pub(super) struct Blocks {
    block: usize,
    blocks: usize,
    residuals: Vec<f64>,
    /// What the resampled deviations lack.
    lacking: f64,
}

impl Blocks {
    /// Of the residuals of the fit of a curve that reaches the steady speed `steady`.
    pub(super) fn new(residuals: &[f64], steady: f64) -> Result<Self, FitRefusal> {
        let points = residuals.len();
        let squares: f64 = residuals.iter().map(|residual| residual * residual).sum();
        let is_exact = squares <= EXACT * EXACT * steady * steady * points as f64;
        let too_long = |correlated_points| FitRefusal::Correlated { correlated_points, points };
        let time = if is_exact {
            1.0
        } else {
            correlation_time(residuals, PARAMETERS).ok_or_else(|| too_long(0.25 * points as f64))?
        };
        let independent = points as f64 / time;
        let needed = BLOCK_TIMES * (time - 1.0 / time);
        let block = (needed.ceil() as usize).max(points.div_ceil(MOST_BLOCKS)).max(1);
        let blocks = points / block;
        if blocks < LEAST_BLOCKS {
            return Err(too_long(time));
        }
        // Neighbouring blocks share this part of the variance of their sums, which resampling loses.
        let shared = (time - 1.0 / time) / (2.0 * block as f64);
        let fitted = PARAMETERS as f64 / independent;
        let lacking = 1.0 / ((1.0 - shared) * (1.0 - fitted)).sqrt();
        let mean = residuals.iter().sum::<f64>() / points as f64;
        let residuals = residuals.iter().map(|residual| residual - mean).collect();
        Ok(Self { block, blocks, residuals, lacking })
    }

    /// The products of every block at every place, and of the fitted curve.
    pub(super) fn at_places(
        &self,
        grid: &ShapeGrid,
        fitted: &[f64],
        work: &mut WorkCount<'_>,
    ) -> Result<PlacedBlocks, Error> {
        let points = self.residuals.len();
        let places = points.div_ceil(self.block);
        let mut at_places = vec![0.0; CONSTANTS * places * self.blocks];
        let mut rows = at_places.chunks_exact_mut(CONSTANTS);
        for place in 0..places {
            let from = place * self.block;
            let length = self.block.min(points - from);
            for (block, products) in (0..self.blocks).zip(&mut rows) {
                let start = block * self.block;
                grid.add_products(from, &self.residuals[start..start + length], products);
            }
            work.spend(1 + (self.blocks * length) as u64)?;
        }
        let mut products = vec![0.0; CONSTANTS];
        grid.add_products(0, fitted, &mut products);
        let widening = self.lacking * small_sample_widening(self.blocks);
        Ok(PlacedBlocks { blocks: self.blocks, places, at_places, products, widening })
    }
}

/// Blocks whose products at each place are known.
pub(super) struct PlacedBlocks {
    blocks: usize,
    places: usize,
    at_places: Vec<f64>,
    products: Vec<f64>,
    widening: f64,
}

impl Resampled for PlacedBlocks {
    fn products(&self) -> &[f64] {
        &self.products
    }

    fn draw(&self, random: &mut SplitMix64, products: &mut [f64]) {
        products.copy_from_slice(&self.products);
        for place in 0..self.places {
            let row = place * self.blocks + index(random, self.blocks);
            for (product, value) in products.iter_mut().zip(&self.at_places[CONSTANTS * row..]) {
                *product += value;
            }
        }
    }

    fn widening(&self) -> f64 {
        self.widening
    }

    fn work(&self) -> u64 {
        1 + self.places as u64
    }
}
