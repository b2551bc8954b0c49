//! Both Lyapunov exponents of many orbits, with their errors.

use bouncing_disk::core::{LyapunovOutcome, lyapunov_spectra};
use pyo3::prelude::*;

use crate::arguments::{Count, ProgressCallable, Starts};
use crate::diagram::room_for;
use crate::{long_call, results};

/// The numbers of one orbit; NaN where there are none.
struct Numbers {
    outcome: u8,
    exponents: [f64; 4],
    impacts: i64,
    phase: f64,
}

/// The places of `LyapunovSpectra.OUTCOMES`.
fn numbers(outcome: &LyapunovOutcome) -> Numbers {
    let count = |impacts: u64| i64::try_from(impacts).unwrap_or(i64::MAX);
    let none = Numbers { outcome: 1, exponents: [f64::NAN; 4], impacts: 0, phase: f64::NAN };
    match outcome {
        LyapunovOutcome::Exponents(found) => Numbers {
            outcome: 0,
            exponents: [
                found.largest,
                found.standard_error,
                found.second.unwrap_or(f64::NEG_INFINITY),
                found.exact_sum.unwrap_or(f64::NEG_INFINITY),
            ],
            impacts: count(found.impacts),
            ..none
        },
        LyapunovOutcome::Rested { impacts } => Numbers { impacts: count(*impacts), ..none },
        LyapunovOutcome::Grazed { impacts, phase } => {
            Numbers { outcome: 2, impacts: count(*impacts), phase: phase.angle(), ..none }
        }
        _ => none,
    }
}

/// Both Lyapunov exponents per impact of each orbit, with the standard error of the largest.
///
/// Parameters
/// ----------
/// axial_forcing, restitution, impact_phase, normalised_speed : float or (n,) array_like
///     As of :func:`orbit_diagram`.
/// transient : int, default 1000
///     Impacts before the exponents are measured.
/// impacts : int, default 10000
///     Impacts that they are measured over, at least 16.
/// progress : callable, optional
///     Called as ``progress(done, total)`` with the number of orbits.
///
/// Returns
/// -------
/// LyapunovSpectra
///
/// Examples
/// --------
/// >>> import bouncing_disk as bd
/// >>> spectra = bd.lyapunov_spectra(axial_forcing=[0.2, 0.55], restitution=0.5, impact_phase=1.2, normalised_speed=1.3)
/// >>> spectra.names()
/// ['rested', 'exponents']
/// >>> bool(spectra.largest[1] > 10 * spectra.standard_error[1])  # Chaos.
/// True
#[pyfunction]
#[pyo3(signature = (
    *, axial_forcing, restitution, impact_phase, normalised_speed, transient=Count::Fits(1000),
    impacts=Count::Fits(10_000), progress=ProgressCallable(None)
), text_signature = "(*, axial_forcing, restitution, impact_phase, normalised_speed, transient=1000, impacts=10000, \
                     progress=None)")]
#[expect(clippy::too_many_arguments, reason = "they are keywords")]
pub(crate) fn lyapunov_spectra<'py>(
    py: Python<'py>,
    axial_forcing: &Bound<'py, PyAny>,
    restitution: &Bound<'py, PyAny>,
    impact_phase: &Bound<'py, PyAny>,
    normalised_speed: &Bound<'py, PyAny>,
    transient: Count,
    impacts: Count,
    progress: ProgressCallable,
) -> PyResult<Bound<'py, PyAny>> {
    let starts = Starts::new(axial_forcing, restitution, impact_phase, normalised_speed)?;
    let (transient, impacts) = (transient.u64(py, "transient")?, impacts.u64(py, "impacts")?);
    let all = long_call::run(py, progress.0, |observer| {
        let outcomes = lyapunov_spectra(&starts.states()?, transient, impacts, observer)?;
        let mut all = room_for(outcomes.len())?;
        all.extend(outcomes.iter().map(numbers));
        Ok(all)
    })?;
    let exponent = |place: usize| results::array(py, all.iter().map(|one| one.exponents[place]).collect());
    let fields = (
        results::array(py, starts.axial_forcing),
        results::array(py, starts.restitution),
        results::array(py, all.iter().map(|one| one.outcome).collect()),
        exponent(0),
        exponent(1),
        exponent(2),
        exponent(3),
        results::array(py, all.iter().map(|one| one.impacts).collect()),
        results::array(py, all.iter().map(|one| one.phase).collect()),
    );
    results::make(py, "LyapunovSpectra", fields)
}
