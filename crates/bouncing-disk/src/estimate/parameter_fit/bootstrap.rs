//! Intervals by resampling members and errors of measurement.

use bouncing_disk_core::numerics::random::SplitMix64;
use bouncing_disk_core::run::WorkCount;
use nalgebra::{DMatrix, DVector};

use crate::error::Error;
use crate::estimate::parameter_fit::model::{Local, Model, mean_of};
use crate::estimate::parameter_fit::weights::Weights;
use crate::statistics::{drawn_index, normal};

/// The differences of the places of resampled fits from that of the fit: one column for each resample, sorted
/// in each row. The best fit follows [`differences`] along `response`.
pub(crate) fn resampled_places(
    model: &Model<'_>,
    local: &Local,
    weights: &Weights,
    response: &DMatrix<f64>,
    work: &mut WorkCount<'_>,
) -> Result<Vec<Vec<f64>>, Error> {
    let mut places = vec![Vec::with_capacity(model.settings.resamples); response.nrows()];
    for difference in differences(model, local) {
        let moved = response * weights.apply(&difference);
        places.iter_mut().zip(moved.iter()).for_each(|(all, &place)| all.push(place));
        work.spend(local.members.nrows() as u64)?;
    }
    places.iter_mut().for_each(|all| all.sort_by(f64::total_cmp));
    Ok(places)
}

/// Differences between a resampled measurement and a model that is the mean of members drawn again: the
/// measurement is the mean of as many members as runs were measured, with errors of measurement.
pub(crate) fn differences<'a>(
    model: &'a Model<'_>,
    local: &'a Local,
) -> impl Iterator<Item = DVector<f64>> + 'a {
    let mut generator = SplitMix64::new(model.settings.seed ^ 0x5EED);
    let members = &local.members;
    let (count, mean) = (members.nrows(), mean_of(members));
    (0..model.settings.resamples).map(move |_| {
        let mut difference = DVector::zeros(members.ncols());
        let mut first = 0;
        for (windows, transient) in model.windows.iter().zip(model.transients) {
            let size = windows.count();
            for (draws, sign) in [(transient.runs.runs().len(), 1.0), (count, -1.0)] {
                let share = sign / draws as f64;
                for _ in 0..draws {
                    let member = drawn_index(&mut generator, count);
                    for column in first..first + size {
                        difference[column] += share * (members[(member, column)] - mean[column]);
                    }
                }
            }
            for (window, variance) in windows.error_variances.iter().enumerate() {
                difference[first + window] += variance.sqrt() * normal(&mut generator);
            }
            // The measured motor is one of those near the smooth mean: draw its difference from this mean as
            // well.
            for residual in local.roughness.iter().flat_map(|rough| &rough.residuals) {
                let luck = normal(&mut generator);
                for window in first..first + size {
                    difference[window] += luck * residual[window];
                }
            }
            first += size;
        }
        difference
    })
}
