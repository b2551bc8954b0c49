//! Crises, and lives beyond them.

use bouncing_disk::core::{Crisis as Core, CrisisSearch, NoCrisis};
use numpy::PyArray1;
use pyo3::prelude::*;

use crate::arguments::{Count, ProgressCallable, row};
use crate::manifold::{side, side_name};
use crate::names::{Name, name};
use crate::periodic_orbit::PeriodicOrbit;
use crate::real::{Pair, Real};
use crate::text::Json;
use crate::{errors, long_call, results, text};

/// The crisis in which an attractor is lost to rest: where the unstable manifold of a saddle on it first touches
/// the stable manifold of a saddle beside it.
///
/// Made by :func:`crisis`.
#[pyclass(frozen, eq, module = "bouncing_disk")]
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Crisis(Core);

/// What the library calls the arguments of a search.
const NAMES: [Name; 7] = [
    name("restitution of a crisis", &["restitution"]),
    name("forcing below a crisis", &["axial_forcing"]),
    name("forcing beyond a crisis", &["axial_forcing"]).legal("(the low end, 3.18e7]"),
    name("samples of a crisis", &["samples"]),
    name("impacts of a crisis", &["impacts"]),
    name("multiplier of a saddle", &["inside"]),
    name("real part of a multiplier of a saddle", &["inside"]),
];

/// What the library calls those of lives.
const LIVES: [Name; 4] = [
    name("orbits beyond a crisis", &["orbits"]),
    name("impacts beyond a crisis", &["impacts"]),
    name("distance from a crisis", &["beyond"]),
    name("axial_forcing", &["beyond"]),
];

#[pymethods]
impl Crisis {
    /// Coefficient of restitution.
    #[getter]
    fn restitution(&self) -> f64 {
        self.0.restitution
    }

    /// Axial forcing parameter Gamma of the tangency.
    #[getter]
    fn axial_forcing(&self) -> f64 {
        self.0.forcing
    }

    /// An estimate of its error.
    #[getter]
    fn forcing_error(&self) -> f64 {
        self.0.forcing_error
    }

    /// The last two values of Gamma of the search by rest: at the first no sample came to rest, at the second some
    /// did.
    #[getter]
    fn bracket(&self) -> (f64, f64) {
        self.0.bracket
    }

    /// The saddle on the attractor, at the crisis.
    #[getter]
    fn inside(&self) -> PeriodicOrbit {
        PeriodicOrbit(self.0.inside.clone())
    }

    /// The saddle whose stable manifold is touched, at the crisis.
    #[getter]
    fn touched(&self) -> PeriodicOrbit {
        PeriodicOrbit(self.0.touched.clone())
    }

    /// Phases of the impacts of the orbit of tangency (rad), shape (n,).
    #[getter]
    fn impact_phase<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        results::array(py, self.0.orbit.iter().map(|state| state.phase().angle()).collect())
    }

    /// Their relative velocities, not positive, in units of g/omega, shape (n,).
    #[getter]
    fn axial_impact_velocity<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        results::array(py, self.0.orbit.iter().map(|state| state.velocity()).collect())
    }

    /// The side of the saddle on which the manifold begins: ``"later"`` or ``"earlier"``.
    #[getter]
    fn side(&self) -> &'static str {
        side_name(self.0.side)
    }

    /// Share of the first piece of the unstable manifold at which the orbit of tangency begins, in [0, 1].
    #[getter]
    fn share(&self) -> f64 {
        self.0.share
    }

    /// How the escaping share of the first piece opens: sqrt(8 (Gamma - Gamma_c)/abs(curvature)).
    #[getter]
    fn curvature(&self) -> f64 {
        self.0.curvature
    }

    /// The exponent of the mean life beyond the crisis, (Gamma - Gamma_c)^-exponent, by the multipliers of the
    /// saddles; None where they do not tell.
    #[getter]
    fn life_exponent(&self) -> Option<f64> {
        self.0.life_exponent()
    }

    /// How long orbits live beyond the crisis, and the power law of their mean life.
    ///
    /// Parameters
    /// ----------
    /// beyond : (n,) array_like
    ///     Distances from the crisis in Gamma, positive.
    /// orbits : int, default 1000
    ///     Orbits at each distance, in [1, 1e6].
    /// impacts : int, default 100000
    ///     Impacts over which an orbit is followed at most, at least 1.
    /// progress : callable, optional
    ///     Called as ``progress(done, total)`` with the orbits at one distance, from 0 on for each.
    ///
    /// Returns
    /// -------
    /// CrisisLives
    #[pyo3(signature = (
        *, beyond, orbits=Count::Fits(1000), impacts=Count::Fits(100_000), progress=ProgressCallable(None)
    ), text_signature = "($self, /, *, beyond, orbits=1000, impacts=100000, progress=None)")]
    fn lives<'py>(
        &self,
        py: Python<'py>,
        beyond: &Bound<'py, PyAny>,
        orbits: Count,
        impacts: Count,
        progress: ProgressCallable,
    ) -> PyResult<Bound<'py, PyAny>> {
        let beyond = row(beyond, "beyond")?;
        let (orbits, impacts) = (orbits.usize(py, "orbits")?, impacts.usize(py, "impacts")?);
        let found = long_call::run_named(py, progress.0, &LIVES, |observer| {
            Ok(self.0.lives_observed(&beyond, orbits, impacts, observer)?)
        })?;
        let row = |of: fn(&bouncing_disk::core::MeanLife) -> f64| {
            results::array(py, found.lives.iter().map(of).collect())
        };
        let (exponent, error, why) = match &found.scaling {
            Ok(law) => (law.exponent, law.standard_error, None),
            Err(reason) => (f64::NAN, f64::NAN, Some(reason.to_string())),
        };
        let infinite = |number: f64| if number < f64::MAX { number } else { f64::INFINITY };
        let fields = (
            row(|life| life.beyond),
            results::array(py, found.lives.iter().map(|life| infinite(life.impacts)).collect()),
            results::array(py, found.lives.iter().map(|life| infinite(life.relative_error)).collect()),
            results::array(py, found.lives.iter().map(|life| life.ended as i64).collect()),
            results::array(py, found.lives.iter().map(|life| life.orbits as i64).collect()),
            exponent,
            error,
            why,
        );
        results::make(py, "CrisisLives", fields)
    }

    /// The crisis as JSON, as the Rust library stores it.
    ///
    /// Returns
    /// -------
    /// str
    fn to_json(&self) -> PyResult<String> {
        text::stored(&self.0)
    }

    /// The crisis of such a text.
    ///
    /// Parameters
    /// ----------
    /// json : str
    ///     As of :meth:`to_json`.
    ///
    /// Returns
    /// -------
    /// Crisis
    #[staticmethod]
    fn from_json(py: Python<'_>, json: Json) -> PyResult<Self> {
        json.read(py).map(Self)
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<text::Reduced<'py>> {
        text::reduced::<Self>(py, self.to_json()?)
    }

    fn __repr__(&self) -> String {
        let (forcing, restitution) = (self.0.forcing, self.0.restitution);
        format!("<Crisis at axial_forcing {forcing:?}, restitution {restitution:?}>")
    }
}

/// Where an attractor is lost to rest as the forcing rises.
///
/// Parameters
/// ----------
/// inside : PeriodicOrbit
///     A saddle on the attractor, or at its edge, of a map in the range.
/// touched : PeriodicOrbit, optional
///     The saddle whose stable manifold is touched; by default the same.
/// restitution : float
///     Coefficient of restitution, in (0, 1).
/// axial_forcing : (float, float)
///     Gamma below the crisis and beyond it.
/// side : {"later", "earlier"}, default "later"
///     On which side of the saddle's first impact its unstable manifold begins.
/// samples : int, default 2048
///     Samples of that manifold, in [64, 1e6].
/// impacts : int, default 200
///     Impacts over which each is followed, in [10, 1e5].
/// progress : callable, optional
///     Called as ``progress(done, total)`` with the number of samples.
///
/// Returns
/// -------
/// Crisis
///
/// Raises
/// ------
/// ComputationError
///     There is none, with the reason as its kind: ``"none-rests"``, ``"rests-before"``, ``"no-fold"`` or
///     ``"not-settled"``.
///
/// Examples
/// --------
/// >>> import bouncing_disk as bd
/// >>> bouncing = bd.ImpactMap(axial_forcing=0.56, restitution=0.5)
/// >>> orbits = bd.periodic_orbits(bouncing, max_impacts=3, max_platform_periods=3)
/// >>> saddle = next(orbit for orbit in orbits if orbit.period == orbit.platform_periods == 3
/// ...     and orbit.multipliers.real.min() > 0.0)
/// >>> found = bd.crisis(saddle, restitution=0.5, axial_forcing=(0.559, 0.562))
/// >>> round(found.axial_forcing, 5)
/// 0.56075
#[pyfunction]
#[pyo3(signature = (
    inside, touched=None, *, restitution, axial_forcing, side="later", samples=Count::Fits(2048),
    impacts=Count::Fits(200), progress=ProgressCallable(None)
), text_signature = "(inside, touched=None, *, restitution, axial_forcing, side='later', samples=2048, impacts=200, \
                     progress=None)")]
#[expect(clippy::too_many_arguments, reason = "they are keywords")]
pub(crate) fn crisis(
    py: Python<'_>,
    inside: &Bound<'_, PeriodicOrbit>,
    touched: Option<&Bound<'_, PeriodicOrbit>>,
    restitution: Real,
    axial_forcing: Pair,
    side: &str,
    samples: Count,
    impacts: Count,
    progress: ProgressCallable,
) -> PyResult<Crisis> {
    let side = self::side(side)?;
    let (samples, impacts) = (samples.u32(py, "samples")?, impacts.u32(py, "impacts")?);
    let search = CrisisSearch::new(restitution.0, axial_forcing.both())
        .and_then(|search| search.with_samples(side, samples, impacts))
        .map_err(|error| errors::of_named(py, error, &NAMES))?;
    let (inside, touched) = (&inside.get().0, &touched.unwrap_or(inside).get().0);
    let found = long_call::run_named(py, progress.0, &NAMES, |observer| {
        Ok(search.crisis_observed(inside, touched, observer)?)
    })?;
    found.map(Crisis).map_err(|reason: NoCrisis| errors::no_crisis(py, &reason))
}
