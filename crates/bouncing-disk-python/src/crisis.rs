//! Crises, and lives beyond them.

use bouncing_disk::core::{Crisis as Core, CrisisSearch, LifeAfterRest, NoCrisis, Tangency};
use numpy::PyArray1;
use pyo3::prelude::*;

use crate::arguments::{Count, ProgressCallable, row};
use crate::manifold::side_name;
use crate::names::{Name, name};
use crate::periodic_orbit::PeriodicOrbit;
use crate::real::{Pair, Real};
use crate::text::Json;
use crate::{errors, long_call, results, text};

/// The crisis in which a chaotic attractor begins to lose orbits to rest.
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

impl Crisis {
    fn tangency(&self) -> Option<&Tangency> {
        self.0.tangency.as_ref().ok()
    }
}

#[pymethods]
impl Crisis {
    /// Coefficient of restitution.
    #[getter]
    fn restitution(&self) -> f64 {
        self.0.restitution
    }

    /// Axial forcing parameter Gamma of the tangency; without one the middle of the bracket.
    #[getter]
    fn axial_forcing(&self) -> f64 {
        self.0.forcing
    }

    /// The error of that: half of the bracket, or its part below the tangency.
    #[getter]
    fn forcing_error(&self) -> f64 {
        self.0.forcing_error
    }

    /// The values of Gamma between which the crisis lies by the lives of orbits, the first one in 95 of 100 searches.
    #[getter]
    fn bracket(&self) -> (f64, f64) {
        self.0.bracket
    }

    /// Whether the disk soon rests again after it came to rest, and so for ever: the attractor is lost. Otherwise it
    /// lives on after a rest, which has become a part of the attractor. None where it depends on the forcing.
    #[getter]
    fn is_boundary_crisis(&self) -> Option<bool> {
        match self.0.after_rest {
            LifeAfterRest::Short { .. } => Some(true),
            LifeAfterRest::Long { .. } => Some(false),
            LifeAfterRest::Varied { .. } => None,
        }
    }

    /// Why no tangency is known that is the reason; None where one is.
    #[getter]
    fn no_tangency(&self) -> Option<String> {
        self.0.tangency.as_ref().err().map(ToString::to_string)
    }

    /// The saddle on the attractor, at the crisis; None without a tangency, as all below.
    #[getter]
    fn inside(&self) -> Option<PeriodicOrbit> {
        self.tangency().map(|own| PeriodicOrbit(own.inside.clone()))
    }

    /// The saddle whose stable manifold is touched, at the crisis.
    #[getter]
    fn touched(&self) -> Option<PeriodicOrbit> {
        self.tangency().map(|own| PeriodicOrbit(own.touched.clone()))
    }

    /// Phases of the impacts of the orbit of tangency (rad), shape (n,).
    #[getter]
    fn impact_phase<'py>(&self, py: Python<'py>) -> Option<Bound<'py, PyArray1<f64>>> {
        self.tangency()
            .map(|own| results::array(py, own.orbit.iter().map(|state| state.phase().angle()).collect()))
    }

    /// Their relative velocities, not positive, in units of g/omega, shape (n,).
    #[getter]
    fn axial_impact_velocity<'py>(&self, py: Python<'py>) -> Option<Bound<'py, PyArray1<f64>>> {
        self.tangency()
            .map(|own| results::array(py, own.orbit.iter().map(|state| state.velocity()).collect()))
    }

    /// The side of the saddle on which the manifold begins: ``"later"`` or ``"earlier"``.
    #[getter]
    fn side(&self) -> Option<&'static str> {
        self.tangency().map(|own| side_name(own.side))
    }

    /// Share of the first piece of the unstable manifold at which the orbit of tangency begins, in [0, 1].
    #[getter]
    fn share(&self) -> Option<f64> {
        self.tangency().map(|own| own.share)
    }

    /// How the escaping share of the first piece opens: sqrt(8 (Gamma - Gamma_c)/abs(curvature)).
    #[getter]
    fn curvature(&self) -> Option<f64> {
        self.tangency().map(|own| own.curvature)
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
            Ok(self.0.lives(&beyond, orbits, impacts, observer)?)
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

/// Where a chaotic attractor begins to lose orbits to rest as the forcing rises.
///
/// Orbits on the attractor are followed to a bracket; a tangency of manifolds within it refines the result.
///
/// Parameters
/// ----------
/// inside : PeriodicOrbit, optional
///     A saddle on the attractor, or at its edge. By default the attractor is the one that the period-1 orbit leads
///     to, and the saddles are looked for.
/// touched : PeriodicOrbit, optional
///     The saddle whose stable manifold is touched; by default the same.
/// restitution : float
///     Coefficient of restitution, in (0, 1).
/// axial_forcing : (float, float)
///     Gamma below the crisis and beyond it.
/// samples : int, default 64
///     Orbits that are followed at each forcing, in [16, 1e6].
/// impacts : int, default 2000000
///     Impacts of all of them together, in [1e4, 1e12]; 200 at least of each. More make the bracket narrower.
/// progress : callable, optional
///     Called as ``progress(done, total)`` with the number of impacts.
///
/// Returns
/// -------
/// Crisis
///
/// Raises
/// ------
/// ComputationError
///     There is none, with the reason as its kind: ``"not-born"``, ``"not-followed"``, ``"none-rests"``,
///     ``"rests-before"``, ``"not-chaotic"``, ``"lives-do-not-shrink"`` or ``"other-reason"``.
///
/// Examples
/// --------
/// >>> import bouncing_disk as bd
/// >>> found = bd.crisis(restitution=0.5, axial_forcing=(0.559, 0.562), impacts=400_000)
/// >>> round(found.axial_forcing, 5)
/// 0.56075
#[pyfunction]
#[pyo3(signature = (
    inside=None, touched=None, *, restitution, axial_forcing, samples=Count::Fits(64),
    impacts=Count::Fits(2_000_000), progress=ProgressCallable(None)
), text_signature = "(inside=None, touched=None, *, restitution, axial_forcing, samples=64, impacts=2000000, \
                     progress=None)")]
#[expect(clippy::too_many_arguments, reason = "they are keywords")]
pub(crate) fn crisis(
    py: Python<'_>,
    inside: Option<&Bound<'_, PeriodicOrbit>>,
    touched: Option<&Bound<'_, PeriodicOrbit>>,
    restitution: Real,
    axial_forcing: Pair,
    samples: Count,
    impacts: Count,
    progress: ProgressCallable,
) -> PyResult<Crisis> {
    let (samples, impacts) = (samples.u32(py, "samples")?, impacts.u64(py, "impacts")?);
    let search = CrisisSearch::new(restitution.0, axial_forcing.both())
        .and_then(|search| search.with_samples(samples, impacts))
        .map_err(|error| errors::of_named(py, error, &NAMES))?;
    let saddles = inside.or(touched).map(|inside| (&inside.get().0, &touched.unwrap_or(inside).get().0));
    let found =
        long_call::run_named(py, progress.0, &NAMES, |observer| Ok(search.crisis(saddles, observer)?))?;
    found.map(Crisis).map_err(|reason: NoCrisis| errors::no_crisis(py, &reason))
}
