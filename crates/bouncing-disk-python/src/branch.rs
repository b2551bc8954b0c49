//! Branches of periodic orbits, and the doubling cascade.

use bouncing_disk::Error;
use bouncing_disk::core::{
    BifurcationKind, Branch as Core, BranchEnd, Continuation, ContinuationParameter, Error as CoreError,
    ImpactState, doubling_cascade, feigenbaum_estimates,
};
use numpy::{Complex64, PyArray1, PyArray2};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyTuple;

use crate::arguments::{Count, ProgressCallable};
use crate::impact_map::ImpactMap;
use crate::names::{Name, name};
use crate::periodic_orbit::{PeriodicOrbit, complex};
use crate::real::{Pair, Real};
use crate::text::Json;
use crate::{errors, long_call, results, text};

/// A branch of periodic orbits, stable and unstable, along a parameter.
///
/// Made by :func:`continued` and :meth:`Branch.switched`. Arrays have one row for each orbit, n in all.
#[pyclass(frozen, eq, module = "bouncing_disk")]
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Branch(Core);

/// How an orbit is continued, as Python gives it.
struct Settings {
    parameter: ContinuationParameter,
    range: Pair,
    rising: bool,
    first_step: Real,
    largest_step: Real,
    max_points: Count,
}

impl Settings {
    fn checked(self, py: Python<'_>) -> PyResult<Continuation> {
        let points = self.max_points.usize(py, "max_points")?;
        Continuation::new(self.parameter, self.range.both(), self.rising)
            .and_then(|settings| settings.with_steps(self.first_step.0, self.largest_step.0, points))
            .map_err(|error| errors::of_named(py, error, &NAMES))
    }
}

/// What the library calls the arguments of a continuation.
const NAMES: [Name; 7] = [
    name("low end of a continuation", &["parameter_range"]),
    name("high end of a continuation", &["parameter_range"]),
    name("largest step", &["largest_step"]),
    name("first step", &["first_step"]),
    name("points of a branch", &["max_points"]),
    name("restitution of a continuation", &["impact_map.restitution"]),
    // The orbit's own value, which must lie in the range.
    name("parameter of a continuation", &["parameter_range"]),
];

fn parameter(name: &str) -> PyResult<ContinuationParameter> {
    match name {
        "axial_forcing" => Ok(ContinuationParameter::Forcing),
        "restitution" => Ok(ContinuationParameter::Restitution),
        _ => Err(PyValueError::new_err(format!(
            "parameter must be \"axial_forcing\" or \"restitution\", and is {name:?}"
        ))),
    }
}

/// A kind by its name, and the impact that it is about.
fn kind(kind: BifurcationKind) -> (&'static str, Option<usize>) {
    match kind {
        BifurcationKind::Doubling => ("doubling", None),
        BifurcationKind::Fold => ("fold", None),
        BifurcationKind::Graze { flight } => ("graze", Some(flight)),
        BifurcationKind::VanishingImpact { impact } => ("vanishing-impact", Some(impact)),
        BifurcationKind::Birth => ("birth", None),
        _ => ("unknown", None),
    }
}

impl Branch {
    fn row(
        &self,
        py: Python<'_>,
        of: impl Fn(&bouncing_disk::core::BranchPoint) -> f64,
    ) -> Py<PyArray1<f64>> {
        results::array(py, self.0.points.iter().map(of).collect()).unbind()
    }

    /// A number of each impact of each orbit, orbit by impact.
    fn impacts<'py>(
        &self,
        py: Python<'py>,
        of: impl Fn(&ImpactState) -> f64,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let period = self.0.points.first().map_or(0, |point| point.orbit.period());
        let mut numbers = Vec::with_capacity(period * self.0.points.len());
        for point in &self.0.points {
            let states = &point.orbit.states;
            numbers.extend((0..period).map(|index| states.get(index).map_or(f64::NAN, &of)));
        }
        results::matrix(py, numbers, [self.0.points.len(), period])
    }
}

#[pymethods]
impl Branch {
    /// The parameter that is varied: ``"axial_forcing"`` or ``"restitution"``.
    #[getter]
    fn parameter(&self) -> &'static str {
        match self.0.parameter {
            ContinuationParameter::Forcing => "axial_forcing",
            ContinuationParameter::Restitution => "restitution",
            _ => "unknown",
        }
    }

    /// The parameter of each orbit, shape (n,).
    #[getter]
    fn values(&self, py: Python<'_>) -> Py<PyArray1<f64>> {
        self.row(py, |point| point.parameter)
    }

    /// Arclength from the start of the branch, shape (n,).
    #[getter]
    fn arclength(&self, py: Python<'_>) -> Py<PyArray1<f64>> {
        self.row(py, |point| point.arclength)
    }

    /// Phases of the impacts of each orbit (rad), shape (n, period).
    #[getter]
    fn impact_phase<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        self.impacts(py, |state| state.phase().angle())
    }

    /// Relative velocities of the impacts of each orbit, not positive, in units of g/omega, shape (n,
    /// period).
    #[getter]
    fn axial_impact_velocity<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        self.impacts(py, ImpactState::velocity)
    }

    /// Normalised speeds of the impacts of each orbit, shape (n, period).
    #[getter]
    fn normalised_speed<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        self.impacts(py, ImpactState::normalised_speed)
    }

    /// Floquet multipliers of each orbit, complex, shape (n, 2).
    #[getter]
    fn multipliers<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<Complex64>>> {
        let all = self.0.points.iter().flat_map(|point| complex(point.multipliers())).collect();
        results::matrix(py, all, [self.0.points.len(), 2])
    }

    /// Whether each orbit attracts, bool, shape (n,).
    #[getter]
    fn is_stable<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<bool>> {
        results::array(py, self.0.points.iter().map(bouncing_disk::core::BranchPoint::is_stable).collect())
    }

    /// Why the branch ends, in words.
    #[getter]
    fn end(&self) -> String {
        match self.0.end {
            BranchEnd::RangeLimit(end) => format!("the parameter reaches {end:?}"),
            BranchEnd::Bifurcation => "the orbit ends in the last bifurcation".to_owned(),
            BranchEnd::Closed => "the branch is back at its start".to_owned(),
            BranchEnd::PointLimit(points) => format!("there are {points} points"),
            BranchEnd::StepTooSmall(arclength) => format!("no next point at the arclength {arclength:?}"),
            _ => "unknown".to_owned(),
        }
    }

    /// The bifurcations on the way: a tuple of :class:`Bifurcation`.
    #[getter]
    fn bifurcations<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        let mut all = Vec::new();
        for found in &self.0.bifurcations {
            let (name, impact) = kind(found.kind);
            let orbit = PeriodicOrbit(found.point.orbit.clone());
            let fields = (name, found.point.parameter, found.point.arclength, impact, orbit);
            all.push(results::make(py, "Bifurcation", fields)?);
        }
        PyTuple::new(py, all)
    }

    /// One orbit of the branch.
    ///
    /// Parameters
    /// ----------
    /// index : int
    ///     Which one, from 0.
    ///
    /// Returns
    /// -------
    /// PeriodicOrbit
    fn orbit(&self, py: Python<'_>, index: Count) -> PyResult<PeriodicOrbit> {
        let place = index.usize(py, "index")?;
        let Some(point) = self.0.points.get(place) else {
            return Err(errors::out_of_range(py, "index", place as f64, "less than the number of orbits"));
        };
        Ok(PeriodicOrbit(point.orbit.clone()))
    }

    /// The branch of twice the period that begins at a doubling.
    ///
    /// Parameters
    /// ----------
    /// index : int
    ///     Which of :attr:`bifurcations`.
    /// parameter_range : (float, float)
    ///     Lowest and highest value of the parameter.
    /// first_step, largest_step, max_points, progress : optional
    ///     As of :func:`continued`.
    ///
    /// Returns
    /// -------
    /// Branch
    #[pyo3(signature = (
        *, index, parameter_range, first_step=Real(0.01), largest_step=Real(0.05), max_points=Count::Fits(10_000),
        progress=ProgressCallable(None)
    ), text_signature = "($self, /, *, index, parameter_range, first_step=0.01, largest_step=0.05, max_points=10000, \
                         progress=None)")]
    #[expect(clippy::too_many_arguments, reason = "they are keywords")]
    fn switched(
        &self,
        py: Python<'_>,
        index: Count,
        parameter_range: Pair,
        first_step: Real,
        largest_step: Real,
        max_points: Count,
        progress: ProgressCallable,
    ) -> PyResult<Self> {
        let index = index.usize(py, "index")?;
        let (parameter, range) = (self.0.parameter, parameter_range);
        let settings = Settings { parameter, range, rising: true, first_step, largest_step, max_points };
        let settings = settings.checked(py)?;
        long_call::run_named(py, progress.0, &NAMES, |observer| {
            Ok(self.0.switched(index, &settings, observer)?)
        })
        .map(Self)
    }

    /// Number of orbits.
    fn __len__(&self) -> usize {
        self.0.points.len()
    }

    /// The branch as JSON, as the Rust library stores it.
    fn to_json(&self) -> PyResult<String> {
        text::stored(&self.0)
    }

    /// The branch of such a text.
    ///
    /// Parameters
    /// ----------
    /// json : str
    ///     As of :meth:`to_json`.
    ///
    /// Returns
    /// -------
    /// Branch
    #[staticmethod]
    fn from_json(py: Python<'_>, json: Json) -> PyResult<Self> {
        json.read(py).map(Self)
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<text::Reduced<'py>> {
        text::reduced::<Self>(py, self.to_json()?)
    }

    fn __repr__(&self) -> String {
        let (orbits, bifurcations) = (self.__len__(), self.0.bifurcations.len());
        format!("<Branch in {} of {orbits} orbits and {bifurcations} bifurcations>", self.parameter())
    }
}

/// The branch of periodic orbits through one of them, through folds and along unstable parts.
///
/// Parameters
/// ----------
/// impact_map : ImpactMap
/// orbit : PeriodicOrbit
///     An orbit of this map.
/// parameter : {"axial_forcing", "restitution"}, default "axial_forcing"
///     What is varied.
/// parameter_range : (float, float)
///     Its lowest and highest value.
/// rising : bool, default True
///     Whether it goes towards higher values at first.
/// first_step, largest_step : float, default 0.01, 0.05
///     Arclength of the first and of the largest step, in [1e-9, 1].
/// max_points : int, default 10000
///     The most orbits, in [2, 1000000].
/// progress : callable, optional
///     Called as ``progress(done, total)`` with the number of orbits.
///
/// Returns
/// -------
/// Branch
///
/// Examples
/// --------
/// >>> import bouncing_disk as bd
/// >>> bouncing = bd.ImpactMap(axial_forcing=0.45, restitution=0.5)
/// >>> orbit = bouncing.settled_orbit(impact_phase=1.2, normalised_speed=1.3)
/// >>> branch = bd.continued(bouncing, orbit, parameter_range=(0.1, 0.6))
/// >>> [(found.kind, round(found.parameter, 6)) for found in branch.bifurcations]
/// [('doubling', 0.486003)]
#[pyfunction]
#[pyo3(signature = (
    impact_map, orbit, *, parameter="axial_forcing", parameter_range, rising=true, first_step=Real(0.01),
    largest_step=Real(0.05), max_points=Count::Fits(10_000), progress=ProgressCallable(None)
), text_signature = "(impact_map, orbit, *, parameter='axial_forcing', parameter_range, rising=True, first_step=0.01, \
                     largest_step=0.05, max_points=10000, progress=None)")]
#[expect(clippy::too_many_arguments, reason = "they are keywords")]
pub(crate) fn continued(
    py: Python<'_>,
    impact_map: &Bound<'_, ImpactMap>,
    orbit: &Bound<'_, PeriodicOrbit>,
    parameter: &str,
    parameter_range: Pair,
    rising: bool,
    first_step: Real,
    largest_step: Real,
    max_points: Count,
    progress: ProgressCallable,
) -> PyResult<Branch> {
    let (parameter, range) = (self::parameter(parameter)?, parameter_range);
    let settings = Settings { parameter, range, rising, first_step, largest_step, max_points }.checked(py)?;
    let (map, orbit) = (impact_map.get().map, &orbit.get().0);
    long_call::run_named(py, progress.0, &NAMES, |observer| Ok(map.continued(orbit, &settings, observer)?))
        .map(Branch)
}

/// The period doublings of the orbit with one impact per period of the platform, and Feigenbaum's numbers
/// from them.
///
/// Parameters
/// ----------
/// restitution : float
///     Coefficient of restitution, in (0, 1).
/// count : int
///     Number of doublings, in [1, 13].
/// progress : callable, optional
///     Called as ``progress(done, total)`` with the number of doublings.
///
/// Returns
/// -------
/// DoublingCascade
///
/// Examples
/// --------
/// >>> import bouncing_disk as bd
/// >>> bd.doubling_cascade(restitution=0.5, count=3).axial_forcing.round(4)
/// array([0.486 , 0.5307, 0.5401])
#[pyfunction]
#[pyo3(signature = (*, restitution, count, progress=ProgressCallable(None)),
       text_signature = "(*, restitution, count, progress=None)")]
pub(crate) fn doubling_cascade<'py>(
    py: Python<'py>,
    restitution: Real,
    count: Count,
    progress: ProgressCallable,
) -> PyResult<Bound<'py, PyAny>> {
    let count = count.usize(py, "count")?;
    let cascade = long_call::run(py, progress.0, |observer| {
        doubling_cascade(restitution.0, count, observer).map_err(|error: CoreError| Error::from(error))
    })?;
    let estimates = feigenbaum_estimates(&cascade);
    let row = |of: fn(&bouncing_disk::core::CascadeDoubling) -> f64| {
        results::array(py, cascade.iter().map(of).collect())
    };
    let estimate = |of: fn(&bouncing_disk::core::FeigenbaumEstimate) -> f64| {
        results::array(py, estimates.iter().map(of).collect())
    };
    let fields = (
        results::array(py, cascade.iter().map(|one| one.period as i64).collect()),
        row(|one| one.axial_forcing),
        row(|one| one.forcing_error),
        row(|one| one.multiplier),
        row(|one| one.width),
        row(|one| one.graze_margin),
        results::array(py, estimates.iter().map(|one| one.number as i64).collect()),
        estimate(|one| one.delta),
        estimate(|one| one.delta_error),
        estimate(|one| one.alpha),
        estimate(|one| one.alpha_error),
    );
    results::make(py, "DoublingCascade", fields)
}
