//! Orbit diagrams, survival times and Lyapunov exponents of many orbits.

use bouncing_disk::Error;
use bouncing_disk::core::Error as CoreError;
use bouncing_disk::core::{lyapunov_exponents, orbit_diagram, survival_times};
use numpy::PyArray1;
use pyo3::prelude::*;

use crate::arguments::{Count, ProgressCallable, Starts};
use crate::chatter::{ChatterCut, policy};
use crate::{long_call, results};

/// Impacts of many orbits, one after the other.
struct Columns {
    offsets: Vec<i64>,
    phases: Vec<f64>,
    velocities: Vec<f64>,
}

/// An empty vector with room for so many numbers; their lack is an error.
pub(crate) fn room_for<T>(count: usize) -> Result<Vec<T>, Error> {
    let mut room = Vec::new();
    room.try_reserve_exact(count).map_err(|_| CoreError::TooLarge {
        what: "numbers of a result",
        count: count as u64,
        limit: count as u64,
    })?;
    Ok(room)
}

/// The impacts of many orbits after their transients: an orbit (bifurcation) diagram.
///
/// The four arguments of the starts are numbers or 1-d arrays of the same length.
///
/// Parameters
/// ----------
/// axial_forcing : float or (n,) array_like
///     Axial forcing parameter Gamma of each orbit.
/// restitution : float or (n,) array_like
///     Coefficient of restitution, in [0, 1).
/// impact_phase : float or (n,) array_like
///     Phase of the first impact (rad).
/// normalised_speed : float or (n,) array_like
///     Normalised speed of the first impact, not negative.
/// transient : int, default 3000
///     Impacts of each orbit that are not recorded.
/// recorded : int, default 256
///     Impacts of each orbit that are; of a disk that rests for ever fewer.
/// chatter : ChatterCut, optional
///     How a chatter ends; ``None`` sums it.
/// progress : callable, optional
///     Called as ``progress(done, total)`` with the number of orbits.
///
/// Returns
/// -------
/// OrbitDiagram
///
/// Examples
/// --------
/// >>> import bouncing_disk as bd
/// >>> import numpy as np
/// >>> diagram = bd.orbit_diagram(axial_forcing=np.linspace(0.4, 0.6, 5), restitution=0.5, impact_phase=1.2,
/// ...     normalised_speed=1.3, transient=500, recorded=20)
/// >>> diagram.offsets
/// array([  0,  20,  40,  60,  80, 100])
#[pyfunction]
#[pyo3(signature = (
    *, axial_forcing, restitution, impact_phase, normalised_speed, transient=Count::Fits(3000),
    recorded=Count::Fits(256), chatter=None, progress=ProgressCallable(None)
), text_signature = "(*, axial_forcing, restitution, impact_phase, normalised_speed, transient=3000, recorded=256, \
                     chatter=None, progress=None)")]
#[expect(clippy::too_many_arguments, reason = "they are keywords")]
pub(crate) fn orbit_diagram<'py>(
    py: Python<'py>,
    axial_forcing: &Bound<'py, PyAny>,
    restitution: &Bound<'py, PyAny>,
    impact_phase: &Bound<'py, PyAny>,
    normalised_speed: &Bound<'py, PyAny>,
    transient: Count,
    recorded: Count,
    chatter: Option<&Bound<'py, ChatterCut>>,
    progress: ProgressCallable,
) -> PyResult<Bound<'py, PyAny>> {
    let starts = Starts::new(axial_forcing, restitution, impact_phase, normalised_speed)?;
    let (transient, recorded) = (transient.usize(py, "transient")?, recorded.usize(py, "recorded")?);
    let policy = policy(chatter);
    let columns = long_call::run(py, progress.0, |observer| {
        let columns = orbit_diagram(&starts.orbits(policy)?, transient, recorded, observer)?;
        let impacts = columns.iter().map(Vec::len).sum();
        let mut flat = Columns {
            offsets: room_for(columns.len() + 1)?,
            phases: room_for(impacts)?,
            velocities: room_for(impacts)?,
        };
        flat.offsets.push(0);
        for column in columns {
            flat.phases.extend(column.iter().map(|state| state.phase().angle()));
            flat.velocities.extend(column.iter().map(|state| state.velocity()));
            flat.offsets.push(flat.phases.len() as i64);
        }
        Ok(flat)
    })?;
    results::make(
        py,
        "OrbitDiagram",
        (
            results::array(py, starts.axial_forcing),
            results::array(py, starts.restitution),
            results::array(py, columns.offsets),
            results::array(py, columns.phases),
            results::array(py, columns.velocities),
        ),
    )
}

/// How many impacts each orbit has before the disk comes to rest, at most so many.
///
/// Parameters
/// ----------
/// axial_forcing, restitution, impact_phase, normalised_speed : float or (n,) array_like
///     As of :func:`orbit_diagram`.
/// most : int
///     Impacts after which an orbit is left.
/// chatter : ChatterCut, optional
///     How a chatter ends; ``None`` sums it.
/// progress : callable, optional
///     Called as ``progress(done, total)`` with the number of orbits.
///
/// Returns
/// -------
/// (n,) int64 array
///
/// Examples
/// --------
/// >>> import bouncing_disk as bd
/// >>> bd.survival_times(axial_forcing=[0.59, 0.45], restitution=0.5, impact_phase=1.2,
/// ...     normalised_speed=1.3, most=1000)
/// array([ 218, 1000])
#[pyfunction]
#[pyo3(signature = (
    *, axial_forcing, restitution, impact_phase, normalised_speed, most, chatter=None, progress=ProgressCallable(None)
), text_signature = "(*, axial_forcing, restitution, impact_phase, normalised_speed, most, chatter=None, \
                     progress=None)")]
#[expect(clippy::too_many_arguments, reason = "they are keywords")]
pub(crate) fn survival_times<'py>(
    py: Python<'py>,
    axial_forcing: &Bound<'py, PyAny>,
    restitution: &Bound<'py, PyAny>,
    impact_phase: &Bound<'py, PyAny>,
    normalised_speed: &Bound<'py, PyAny>,
    most: Count,
    chatter: Option<&Bound<'py, ChatterCut>>,
    progress: ProgressCallable,
) -> PyResult<Bound<'py, PyArray1<i64>>> {
    let starts = Starts::new(axial_forcing, restitution, impact_phase, normalised_speed)?;
    let (most, policy) = (most.usize(py, "most")?, policy(chatter));
    let times = long_call::run(py, progress.0, |observer| {
        let times = survival_times(&starts.orbits(policy)?, most, observer)?;
        Ok(times.into_iter().map(|time| time as i64).collect())
    })?;
    Ok(results::array(py, times))
}

/// The largest Lyapunov exponent per impact of each orbit.
///
/// Parameters
/// ----------
/// axial_forcing, restitution, impact_phase, normalised_speed : float or (n,) array_like
///     As of :func:`orbit_diagram`.
/// transient : int, default 1000
///     Impacts before the exponent is measured.
/// impacts : int, default 10000
///     Impacts that it is measured over.
/// progress : callable, optional
///     Called as ``progress(done, total)`` with the number of orbits.
///
/// Returns
/// -------
/// (n,) float64 array
///     Mean logarithmic growth per impact; NaN where the disk comes to rest or grazes the platform.
///
/// Examples
/// --------
/// >>> import bouncing_disk as bd
/// >>> exponents = bd.lyapunov_exponents(axial_forcing=[0.44, 0.56], restitution=0.5, impact_phase=1.2,
/// ...     normalised_speed=1.3)
/// >>> exponents.round(2)
/// array([-0.69,  0.4 ])
#[pyfunction]
#[pyo3(signature = (
    *, axial_forcing, restitution, impact_phase, normalised_speed, transient=Count::Fits(1000),
    impacts=Count::Fits(10000), progress=ProgressCallable(None)
), text_signature = "(*, axial_forcing, restitution, impact_phase, normalised_speed, transient=1000, impacts=10000, \
                     progress=None)")]
#[expect(clippy::too_many_arguments, reason = "they are keywords")]
pub(crate) fn lyapunov_exponents<'py>(
    py: Python<'py>,
    axial_forcing: &Bound<'py, PyAny>,
    restitution: &Bound<'py, PyAny>,
    impact_phase: &Bound<'py, PyAny>,
    normalised_speed: &Bound<'py, PyAny>,
    transient: Count,
    impacts: Count,
    progress: ProgressCallable,
) -> PyResult<Bound<'py, PyArray1<f64>>> {
    let starts = Starts::new(axial_forcing, restitution, impact_phase, normalised_speed)?;
    let (transient, impacts) = (transient.usize(py, "transient")?, impacts.usize(py, "impacts")?);
    let exponents = long_call::run(py, progress.0, |observer| {
        let exponents = lyapunov_exponents(&starts.states()?, transient, impacts, observer)?;
        Ok(exponents.into_iter().map(|exponent| exponent.unwrap_or(f64::NAN)).collect())
    })?;
    Ok(results::array(py, exponents))
}
