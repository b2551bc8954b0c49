//! The directions in the space of the parameters that the data determine independently of each other.

use nalgebra::{DMatrix, DVector, SymmetricEigen};

use crate::estimate::parameter_fit::model::{Local, mean_of};
use crate::estimate::parameter_fit::weights::Weights;

/// The largest standard error of a direction that counts as determined, as a share of half of the ranges: its
/// interval of 95 % is then as wide as they are.
pub(crate) const LARGEST_ERROR: f64 = 0.5;

/// A parameter is independent of an undetermined direction if moving along this direction to the end of the
/// range changes the parameter by less than this share of its standard error.
const LARGEST_SHARE: f64 = 0.5;

/// A direction that is not determined, and its standard error.
pub(crate) type Open = (DVector<f64>, f64);

/// The directions that an information matrix of places determines, and the others with their standard errors; the
/// least uncertain first.
pub(crate) fn split(information: DMatrix<f64>) -> (Vec<DVector<f64>>, Vec<Open>) {
    let eigen = SymmetricEigen::new(information);
    let mut order: Vec<usize> = (0..eigen.eigenvalues.len()).collect();
    order.sort_by(|&a, &b| eigen.eigenvalues[b].total_cmp(&eigen.eigenvalues[a]));
    let (mut determined, mut undetermined) = (Vec::new(), Vec::new());
    for index in order {
        let (value, vector) = (eigen.eigenvalues[index], eigen.eigenvectors.column(index).into_owned());
        let error = if value > 0.0 { 1.0 / value.sqrt() } else { f64::INFINITY };
        if error <= LARGEST_ERROR {
            determined.push(vector);
        } else {
            undetermined.push((vector, error));
        }
    }
    (determined, undetermined)
}

/// The directions in which the weighted means change, and by how much.
#[derive(Debug)]
pub(crate) struct Directions {
    /// Directions that are determined, orthonormal in places: a column each.
    pub(crate) determined: DMatrix<f64>,
    /// Those that are not, with their standard errors, infinite where the means do not change at all.
    pub(crate) undetermined: Vec<Open>,
    /// The weighted derivatives: a column a parameter.
    pub(crate) derivatives: DMatrix<f64>,
}

impl Directions {
    /// From the derivatives of each member. The contribution of chance to the squares of a mean derivative is
    /// subtracted.
    pub(crate) fn of(weights: &Weights, local: &Local) -> Self {
        let derivatives = &local.derivatives;
        if derivatives.is_empty() {
            let none = DMatrix::zeros(local.smooth.len(), 0);
            return Self { determined: DMatrix::zeros(0, 0), undetermined: Vec::new(), derivatives: none };
        }
        let columns: Vec<DVector<f64>> =
            derivatives.iter().map(|members| weights.apply(&mean_of(members))).collect();
        let weighted = DMatrix::from_columns(&columns);
        let count = derivatives.first().map_or(1, DMatrix::nrows);
        let mut information = weighted.transpose() * &weighted;
        for member in 0..count {
            let own: Vec<DVector<f64>> = derivatives
                .iter()
                .zip(&columns)
                .map(|(members, mean)| weights.apply(&members.row(member).transpose()) - mean)
                .collect();
            for i in 0..own.len() {
                for j in 0..own.len() {
                    information[(i, j)] -= own[i].dot(&own[j]) / (count * (count - 1)) as f64;
                }
            }
        }
        for rough in &local.roughness {
            let variance = rough.residuals.iter().map(|residual| weights.apply(residual).norm_squared());
            information[(rough.parameter, rough.parameter)] -= rough.slope_variance * variance.sum::<f64>();
        }
        let (determined, undetermined) = split(information);
        let determined = if determined.is_empty() {
            DMatrix::zeros(derivatives.len(), 0)
        } else {
            DMatrix::from_columns(&determined)
        };
        Self { determined, undetermined, derivatives: weighted }
    }

    /// The change of the places of the best fit for a change of the weighted means, one row for each
    /// parameter.
    pub(crate) fn response(&self) -> DMatrix<f64> {
        let along = &self.derivatives * &self.determined;
        let information = along.transpose() * &along;
        // Determined directions have information that is positive.
        let inverse =
            information.try_inverse().unwrap_or_else(|| DMatrix::zeros(along.ncols(), along.ncols()));
        &self.determined * inverse * along.transpose()
    }

    /// Whether a parameter whose place has this standard error is independent of the undetermined directions.
    pub(crate) fn tells(&self, parameter: usize, error: f64) -> bool {
        let open = self.undetermined.iter().map(|(direction, _)| direction[parameter] * direction[parameter]);
        let open = open.sum::<f64>().sqrt();
        error > 0.0 && error <= LARGEST_ERROR && open <= LARGEST_SHARE * error
    }
}
