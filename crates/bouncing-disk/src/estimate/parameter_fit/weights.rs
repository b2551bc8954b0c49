//! The weights of the squares: the scatter of the means of a measured transient.

use bouncing_disk_core::numerics::elementary::ln;
use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

use crate::error::{Error, finite};
use crate::estimate::parameter_fit::model::{Local, Model, mean_of};

/// The error of interpolating a computed curve, as a share of the largest mean: no mean counts as known
/// better than this.
const RESOLUTION: f64 = 1.0e-4;

/// One block of the covariance for each preload, as its lower triangular root.
#[derive(Debug)]
pub(crate) struct Weights {
    blocks: Vec<Cholesky<f64, Dyn>>,
}

impl Weights {
    /// By the scatter of computed members, in as many runs as were measured, the errors of measurement, and
    /// what smoothing leaves.
    pub(crate) fn of(model: &Model<'_>, local: &Local) -> Result<Self, Error> {
        let members = &local.members;
        let (count, mean) = (members.nrows() as f64, mean_of(members));
        let (mut blocks, mut first) = (Vec::with_capacity(model.windows.len()), 0);
        for (windows, transient) in model.windows.iter().zip(model.transients) {
            let size = windows.count();
            let mean = mean.rows(first, size).transpose();
            let scatter =
                DMatrix::from_fn(members.nrows(), size, |member, i| members[(member, first + i)] - mean[i]);
            let largest = windows.measured.iter().chain(mean.iter());
            let largest = largest.fold(0.0_f64, |most, mean| most.max(mean.abs()));
            let runs = transient.runs.runs().len() as f64;
            // The inverse of an estimated covariance is too large by the first factor; the computed mean has
            // an error, too.
            let factor =
                (count - 1.0) / (count - size as f64 - 2.0) * (1.0 / runs + 1.0 / count) / (count - 1.0);
            let mut covariance = scatter.transpose() * &scatter * factor;
            for residual in local.roughness.iter().flat_map(|rough| &rough.residuals) {
                let own = residual.rows(first, size);
                covariance += own * own.transpose();
            }
            let resolution = RESOLUTION * largest;
            for (i, variance) in windows.error_variances.iter().enumerate() {
                covariance[(i, i)] += variance + resolution * resolution;
            }
            finite("variance of a mean speed", covariance.trace())?;
            let Some(block) = Cholesky::new(covariance) else {
                return Err(Error::OutOfRange {
                    field: "largest mean speed of a transient",
                    value: largest,
                    legal: "[1e-150, 1e150] (rad/s)",
                });
            };
            blocks.push(block);
            first += size;
        }
        Ok(Self { blocks })
    }

    /// The logarithm of the determinant of the covariance.
    pub(crate) fn ln_determinant(&self) -> f64 {
        let diagonals = self.blocks.iter().map(|block| block.l_dirty().diagonal());
        diagonals.map(|diagonal| diagonal.iter().map(|&root| 2.0 * ln(root)).sum::<f64>()).sum()
    }

    /// Numbers that are independent and of variance one where those of the windows scatter as these do.
    pub(crate) fn apply(&self, statistics: &DVector<f64>) -> DVector<f64> {
        let (mut weighted, mut first) = (statistics.clone(), 0);
        for block in &self.blocks {
            let size = block.l_dirty().nrows();
            // The diagonal of a root is positive.
            let _ = block.l_dirty().solve_lower_triangular_mut(&mut weighted.rows_mut(first, size));
            first += size;
        }
        weighted
    }
}
