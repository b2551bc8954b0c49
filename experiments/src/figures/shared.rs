//! What several figures share.

pub(crate) mod alike;
pub(crate) mod cylinder;
pub(crate) mod inputs;
pub(crate) mod motor;
pub(crate) mod numbers;
pub(crate) mod stall;
pub(crate) mod statistics;
pub(crate) mod toss;

use bouncing_disk::core::run::in_parallel;
use bouncing_disk::core::{ImpactMap, ImpactState, Vibration};

use self::numbers::six_decimals;
use crate::experiment::ExperimentError;

/// The range of Γ of the diagrams of Fig. 6, to whose end Fig. 7 looks for starts that do not come to rest.
pub(crate) const FORCING_RANGE: (f64, f64) = (0.30, 0.62);

pub(crate) fn map(axial_forcing: f64, restitution: f64) -> Result<ImpactMap, ExperimentError> {
    Ok(ImpactMap::new(Vibration::from_axial_forcing(axial_forcing)?, restitution)?)
}

/// What `of` makes of each item, in their order, over all threads; of several errors the one of the first item.
pub(crate) fn map_in_parallel<T: Sync, R: Send>(
    items: &[T],
    of: impl Fn(&T) -> Result<R, ExperimentError> + Sync,
) -> Result<Vec<R>, ExperimentError> {
    in_parallel(items.len(), |index| of(&items[index])).into_iter().collect()
}

/// The phases of impacts (periods), each once, to six decimals and in their order: a periodic orbit repeats its own.
pub(crate) fn distinct_phases(impacts: &[ImpactState]) -> Vec<f64> {
    let mut phases: Vec<f64> = impacts.iter().map(|impact| six_decimals(impact.phase().cycles())).collect();
    phases.sort_by(f64::total_cmp);
    phases.dedup_by(|one, other| one.total_cmp(other).is_eq());
    phases
}
