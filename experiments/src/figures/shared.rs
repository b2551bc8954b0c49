//! What several figures share.

pub(crate) mod alike;
pub(crate) mod cylinder;
pub(crate) mod motor;
pub(crate) mod numbers;
pub(crate) mod stall;
pub(crate) mod toss;

use bouncing_disk::core::chaos::Manifold;
use bouncing_disk::core::numerics::elementary::{exp, ln};
use bouncing_disk::core::run::in_parallel;
use bouncing_disk::core::{ImpactMap, ImpactState, Vibration};

use self::numbers::six_decimals;
use crate::experiment::ExperimentError;

/// The range of Γ of the diagrams of Fig. 6, to whose end Fig. 7 looks for starts that do not come to rest.
pub(crate) const FORCING_RANGE: (f64, f64) = (0.30, 0.62);

pub(crate) fn map(axial_forcing: f64, restitution: f64) -> Result<ImpactMap, ExperimentError> {
    Ok(ImpactMap::new(Vibration::from_axial_forcing(axial_forcing)?, restitution)?)
}

/// The value at a share of the way between two ends, in equal ratios.
pub(crate) fn between((from, to): (f64, f64), share: f64) -> f64 {
    exp(ln(from) + (ln(to) - ln(from)) * share)
}

/// `count` values at equal ratios from one end to the other.
pub(crate) fn logarithmic(ends: (f64, f64), count: usize) -> Vec<f64> {
    (0..count).map(|k| between(ends, k as f64 / (count - 1) as f64)).collect()
}

/// What `of` makes of each item, in their order, over all threads; of several errors the one of the first item.
pub(crate) fn map_in_parallel<T: Sync, R: Send>(
    items: &[T],
    of: impl Fn(&T) -> Result<R, ExperimentError> + Sync,
) -> Result<Vec<R>, ExperimentError> {
    in_parallel(items.len(), |index| of(&items[index])).into_iter().collect()
}

/// The pieces of a manifold with their impacts at these places, cut where the first coordinate, a phase in periods of
/// the platform, jumps by more than half a period; without pieces of a single impact.
pub(crate) fn lines(manifold: &Manifold, spot: impl Fn(ImpactState) -> (f64, f64)) -> Vec<Vec<(f64, f64)>> {
    let mut lines = Vec::new();
    for piece in manifold.pieces() {
        let mut current: Vec<(f64, f64)> = Vec::new();
        for state in &piece.states {
            let next = spot(*state);
            if current.last().is_some_and(|last| (last.0 - next.0).abs() > 0.5) {
                lines.push(std::mem::take(&mut current));
            }
            current.push(next);
        }
        lines.push(current);
    }
    lines.retain(|line| line.len() > 1);
    lines
}

/// The phases of impacts (periods), each once, to six decimals and in their order: a periodic orbit repeats its own.
pub(crate) fn distinct_phases(impacts: &[ImpactState]) -> Vec<f64> {
    let mut phases: Vec<f64> = impacts.iter().map(|impact| six_decimals(impact.phase().cycles())).collect();
    phases.sort_by(f64::total_cmp);
    phases.dedup_by(|one, other| one.total_cmp(other).is_eq());
    phases
}
