//! Periodic orbits of the impact map.

use bouncing_disk::core::{Multipliers, OrbitSearch, PeriodicOrbit as Orbit, Stability};
use numpy::{Complex64, PyArray1, PyArray2};
use pyo3::prelude::*;

use crate::arguments::{Count, ProgressCallable};
use crate::impact_map::ImpactMap;
use crate::names::name;
use crate::text::Json;
use crate::{errors, long_call, results, text};

/// A periodic orbit of the impact map, stable or not.
///
/// Orbits are made by :func:`periodic_orbits`, :meth:`ImpactMap.refine` and :meth:`ImpactMap.settled_orbit`.
#[pyclass(frozen, eq, module = "bouncing_disk")]
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PeriodicOrbit(pub(crate) Orbit);

/// Both multipliers as complex numbers.
pub(crate) fn complex(multipliers: Multipliers) -> [Complex64; 2] {
    match multipliers {
        Multipliers::Real(large, small) => [Complex64::new(large, 0.0), Complex64::new(small, 0.0)],
        Multipliers::Complex { real, imaginary } => {
            [Complex64::new(real, imaginary), Complex64::new(real, -imaginary)]
        }
    }
}

#[pymethods]
impl PeriodicOrbit {
    /// Phase of each impact of one period (rad), shape (period,).
    #[getter]
    fn impact_phase<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        results::array(py, self.0.states.iter().map(|state| state.phase().angle()).collect())
    }

    /// Relative velocity of each impact, not positive, in units of g/omega, shape (period,).
    #[getter]
    fn axial_impact_velocity<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        results::array(py, self.0.states.iter().map(|state| state.velocity()).collect())
    }

    /// Normalised speed of each impact, shape (period,).
    #[getter]
    fn normalised_speed<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        results::array(py, self.0.states.iter().map(|state| state.normalised_speed()).collect())
    }

    /// Number of impacts in one period of the orbit.
    #[getter]
    fn period(&self) -> usize {
        self.0.period()
    }

    /// Periods of the platform that one period of the orbit takes.
    #[getter]
    fn platform_periods(&self) -> u64 {
        self.0.platform_periods
    }

    /// The derivative of the map around the orbit, from its first impact, shape (2, 2).
    #[getter]
    fn monodromy<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let (x, y) = (self.0.monodromy.x_axis, self.0.monodromy.y_axis);
        results::matrix(py, vec![x.x, y.x, x.y, y.y], [2, 2])
    }

    /// The two Floquet multipliers, complex, the one of larger modulus first, shape (2,).
    #[getter]
    fn multipliers<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<Complex64>> {
        results::array(py, complex(self.0.multipliers()).to_vec())
    }

    /// Whether the orbit attracts: both multipliers lie inside of the unit circle by more than their uncertainty.
    #[getter]
    fn is_stable(&self) -> bool {
        self.0.stability() == Stability::Stable
    }

    /// ``"attracts"``, ``"unstable"``, or ``"marginal"`` where a multiplier is 1 or -1 within rounding.
    #[getter]
    fn stability(&self) -> String {
        self.0.stability().to_string()
    }

    /// A radius within which every orbit is proven to end on this one.
    ///
    /// Parameters
    /// ----------
    /// impact_map : ImpactMap
    ///     The map that it is an orbit of.
    ///
    /// Returns
    /// -------
    /// float
    ///     In radians (a radian counts as much as the peak velocity of the platform).
    ///
    /// Raises
    /// ------
    /// ComputationError
    ///     ``"not-attracting"`` unless the orbit attracts; ``"nothing-proven"`` next to a graze.
    fn proven_radius(&self, py: Python<'_>, impact_map: &Bound<'_, ImpactMap>) -> PyResult<f64> {
        let map = impact_map.get().map;
        self.0.proven_radius(&map).map_err(|error| errors::of(py, error))
    }

    /// The radius within which a start counts as caught by this orbit: the proven one, or a larger one that samples
    /// support.
    ///
    /// Parameters
    /// ----------
    /// impact_map : ImpactMap
    ///     The map that it is an orbit of.
    /// samples : int, default 64
    ///     Starts on each circle that is tried.
    /// progress : callable, optional
    ///     Called as ``progress(done, total)`` with the number of starts.
    ///
    /// Returns
    /// -------
    /// float
    ///     In radians (a radian counts as much as the peak velocity of the platform).
    ///
    /// Raises
    /// ------
    /// ComputationError
    ///     ``"not-attracting"`` unless the orbit attracts; ``"nothing-proven"`` next to a graze, where samples find
    ///     no radius, either.
    #[pyo3(signature = (impact_map, *, samples=Count::Fits(64), progress=ProgressCallable(None)),
           text_signature = "($self, /, impact_map, *, samples=64, progress=None)")]
    fn trapping_radius(
        &self,
        py: Python<'_>,
        impact_map: &Bound<'_, ImpactMap>,
        samples: Count,
        progress: ProgressCallable,
    ) -> PyResult<f64> {
        let samples = samples.at_most(py, "samples", 1 << 20, "[1, 1048576]")? as u32;
        let map = impact_map.get().map;
        long_call::run(py, progress.0, |observer| Ok(self.0.trapping_radius(&map, samples, observer)?))
    }

    /// The orbit as JSON, as the Rust library stores it.
    ///
    /// Returns
    /// -------
    /// str
    fn to_json(&self) -> PyResult<String> {
        text::stored(&self.0)
    }

    /// The orbit of such a text.
    ///
    /// Parameters
    /// ----------
    /// json : str
    ///     As of :meth:`to_json`.
    ///
    /// Returns
    /// -------
    /// PeriodicOrbit
    #[staticmethod]
    fn from_json(py: Python<'_>, json: Json) -> PyResult<Self> {
        json.read(py).map(Self)
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<text::Reduced<'py>> {
        text::reduced::<Self>(py, self.to_json()?)
    }

    fn __repr__(&self) -> String {
        let stable = match self.0.stability() {
            Stability::Stable => "stable",
            Stability::Marginal => "marginal",
            Stability::Unstable => "unstable",
        };
        let (impacts, periods) = (self.period(), self.platform_periods());
        let plural = |count: u64, what: &str| format!("{count} {what}{}", if count == 1 { "" } else { "s" });
        format!(
            "<{stable} PeriodicOrbit of {} in {} of the platform>",
            plural(impacts as u64, "impact"),
            plural(periods, "period")
        )
    }
}

/// The periodic orbits of few impacts, stable and unstable.
///
/// Those of one impact come from the closed form and are complete. All others are found from a grid of
/// starts, which proves nothing about what it did not find.
///
/// Parameters
/// ----------
/// impact_map : ImpactMap
/// max_impacts : int
///     The most impacts of an orbit, in [1, 64].
/// max_platform_periods : int
///     The most periods of the platform that it takes, in [1, 10000].
/// phases, speeds : int, default 96
///     Starts along each axis, in [2, 4096].
/// progress : callable, optional
///     Called as ``progress(done, total)`` with the number of starts.
///
/// Returns
/// -------
/// list of PeriodicOrbit
///     By rising number of impacts, then of platform periods, then by falling speed.
///
/// Examples
/// --------
/// >>> import bouncing_disk as bd
/// >>> bouncing = bd.ImpactMap(axial_forcing=0.5, restitution=0.5)
/// >>> orbits = bd.periodic_orbits(bouncing, max_impacts=2, max_platform_periods=2)
/// >>> [orbit.period for orbit in orbits if orbit.is_stable]
/// [2]
#[pyfunction]
#[pyo3(signature = (
    impact_map, *, max_impacts, max_platform_periods, phases=Count::Fits(96), speeds=Count::Fits(96),
    progress=ProgressCallable(None)
), text_signature = "(impact_map, *, max_impacts, max_platform_periods, phases=96, speeds=96, progress=None)")]
pub(crate) fn periodic_orbits(
    py: Python<'_>,
    impact_map: &Bound<'_, ImpactMap>,
    max_impacts: Count,
    max_platform_periods: Count,
    phases: Count,
    speeds: Count,
    progress: ProgressCallable,
) -> PyResult<Vec<PeriodicOrbit>> {
    let impacts = max_impacts.usize(py, "max_impacts")?;
    let periods = max_platform_periods.u64(py, "max_platform_periods")?;
    let (phases, speeds) = (phases.u32(py, "phases")?, speeds.u32(py, "speeds")?);
    let search = OrbitSearch::new(impacts, periods).and_then(|search| search.with_starts(phases, speeds));
    let names = [
        name("impacts of an orbit", &["max_impacts"]),
        name("platform periods of an orbit", &["max_platform_periods"]),
        name("starts along the phase", &["phases"]),
        name("starts along the speed", &["speeds"]),
    ];
    let search = search.map_err(|error| errors::of_named(py, error, &names))?;
    let map = impact_map.get().map;
    let found = long_call::run(py, progress.0, |observer| Ok(map.periodic_orbits(&search, observer)?))?;
    Ok(found.orbits.into_iter().map(PeriodicOrbit).collect())
}
