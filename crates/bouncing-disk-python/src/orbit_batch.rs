//! Many orbits of the impact map, advanced together: the bare map, without a question after each impact.

use bouncing_disk::Error;
use bouncing_disk::core::run::Watch;
use bouncing_disk::core::sweep::OrbitBatch;
use bouncing_disk::core::{ImpactMap, ImpactState};
use numpy::PyArray1;
use pyo3::prelude::*;
use rayon::prelude::*;

use crate::arguments::{Count, ProgressCallable, Starts};
use crate::diagram::room_for;
use crate::{long_call, results};

/// Orbits that one thread advances together: what stays in its cache.
const TOGETHER: usize = 1024;

/// The last impact of each orbit as Python has it.
type PhasesAndVelocities<'py> = (Bound<'py, PyArray1<f64>>, Bound<'py, PyArray1<f64>>);

/// The impacts that so many steps lead to, of one share of the orbits.
fn advanced(
    starts: &[(ImpactMap, ImpactState)],
    impacts: u64,
    watch: &Watch<'_>,
) -> Result<Vec<ImpactState>, Error> {
    let mut batch = OrbitBatch::new(starts.iter().copied());
    let mut work = watch.work();
    for _ in 0..impacts {
        batch.step()?;
        watch.finish(starts.len() as u64);
        work.spend(starts.len() as u64)?;
    }
    Ok((0..batch.len()).filter_map(|index| batch.state(index)).collect())
}

/// The impacts of many orbits that are so many steps later, each from its own start: the fastest way through the map.
///
/// Unlike :func:`orbit_diagram` it does not ask whether the disk comes to rest: a chatter goes on impact by impact.
///
/// Parameters
/// ----------
/// axial_forcing, restitution, impact_phase, normalised_speed : float or (n,) array_like
///     As of :func:`orbit_diagram`.
/// impacts : int
///     Number of steps.
/// progress : callable, optional
///     Called as ``progress(done, total)`` with the number of impacts of all orbits.
///
/// Returns
/// -------
/// ((n,) float64 array, (n,) float64 array)
///     Phase (rad) and relative velocity (not positive, in units of g/omega) of the last impact of each orbit.
///
/// Raises
/// ------
/// ComputationError
///     An orbit has no next impact.
///
/// Examples
/// --------
/// >>> import bouncing_disk as bd
/// >>> phases, velocities = bd.iterate_orbits(axial_forcing=0.45, restitution=0.5, impact_phase=[0.7, 0.8],
/// ...     normalised_speed=1.3, impacts=200)
/// >>> bool(abs(phases[0] - phases[1]) < 1e-12)  # Both are on the period-1 orbit.
/// True
#[pyfunction]
#[pyo3(signature = (
    *, axial_forcing, restitution, impact_phase, normalised_speed, impacts, progress=ProgressCallable(None)
), text_signature = "(*, axial_forcing, restitution, impact_phase, normalised_speed, impacts, progress=None)")]
pub(crate) fn iterate_orbits<'py>(
    py: Python<'py>,
    axial_forcing: &Bound<'py, PyAny>,
    restitution: &Bound<'py, PyAny>,
    impact_phase: &Bound<'py, PyAny>,
    normalised_speed: &Bound<'py, PyAny>,
    impacts: Count,
    progress: ProgressCallable,
) -> PyResult<PhasesAndVelocities<'py>> {
    let starts = Starts::new(axial_forcing, restitution, impact_phase, normalised_speed)?;
    let impacts = impacts.u64(py, "impacts")?;
    let (phases, velocities) = long_call::run(py, progress.0, |observer| {
        let starts = starts.states()?;
        let total = impacts.saturating_mul(starts.len() as u64);
        let watch = Watch::begin(observer, 0, total)?;
        // Collected in order, so that the error is that of the first share whatever the threads do.
        let shares: Vec<Result<Vec<ImpactState>, Error>> =
            starts.par_chunks(TOGETHER).map(|share| advanced(share, impacts, &watch)).collect();
        let (mut phases, mut velocities) = (room_for(starts.len())?, room_for(starts.len())?);
        for share in shares {
            let share = share?;
            phases.extend(share.iter().map(|state| state.phase().angle()));
            velocities.extend(share.iter().map(|state| state.velocity()));
        }
        watch.end();
        Ok((phases, velocities))
    })?;
    Ok((results::array(py, phases), results::array(py, velocities)))
}
