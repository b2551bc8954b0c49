//! Resampling the members of an ensemble.

use bouncing_disk_core::WorkCount;
use bouncing_disk_core::numerics::random::SplitMix64;

use super::resamples::{Resampled, index};
use super::shape_grid::{CONSTANTS, ShapeGrid};
use crate::error::Error;
use crate::motor::interval_estimate::small_sample_widening;

/// The mean curve of an ensemble as the mean over its groups of members, each with its size.
pub(super) struct Members {
    sizes: Vec<f64>,
    /// For each group the products of the sum of its members.
    group_products: Vec<f64>,
    products: Vec<f64>,
}

impl Members {
    /// Of the sums of the curves in each group, and the sizes of the groups.
    pub(super) fn new(
        grid: &ShapeGrid,
        sums: &[(Vec<f64>, usize)],
        work: &mut WorkCount<'_>,
    ) -> Result<Self, Error> {
        let mut members = Self {
            sizes: sums.iter().map(|(_, size)| *size as f64).collect(),
            group_products: vec![0.0; CONSTANTS * sums.len()],
            products: vec![0.0; CONSTANTS],
        };
        for ((sum, _), products) in sums.iter().zip(members.group_products.chunks_exact_mut(CONSTANTS)) {
            grid.add_products(0, sum, products);
            work.spend(sum.len() as u64)?;
        }
        let mut all = vec![0.0; CONSTANTS];
        members.mean_of(0..sums.len(), &mut all);
        members.products = all;
        Ok(members)
    }

    /// The products of the mean over these groups.
    fn mean_of(&self, groups: impl Iterator<Item = usize>, products: &mut [f64]) {
        products.fill(0.0);
        let mut size = 0.0;
        for group in groups {
            size += self.sizes[group];
            let of_group = &self.group_products[CONSTANTS * group..];
            for (product, value) in products.iter_mut().zip(of_group) {
                *product += value;
            }
        }
        for product in products {
            *product /= size;
        }
    }
}

impl Resampled for Members {
    fn products(&self) -> &[f64] {
        &self.products
    }

    fn draw(&self, random: &mut SplitMix64, products: &mut [f64]) {
        let groups = self.sizes.len();
        self.mean_of((0..groups).map(|_| index(random, groups)), products);
    }

    fn widening(&self) -> f64 {
        small_sample_widening(self.sizes.len())
    }

    fn work(&self) -> u64 {
        1 + self.sizes.len() as u64
    }
}
