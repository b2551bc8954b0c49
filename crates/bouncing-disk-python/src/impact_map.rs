//! The impact map of the vertical motion.

use bouncing_disk::core::{ImpactMap as Map, Vibration};
use bouncing_disk::{Error, System as Model};
use numpy::PyArray2;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arguments::{Count, ProgressCallable, first_impact, numbers, row};
use crate::impact_state::{INVERSE, PHASE, pair, state};
use crate::names::name;
use crate::periodic_orbit::PeriodicOrbit;
use crate::real::{Real, optional};
use crate::system::System;
use crate::text::Json;
use crate::{errors, long_call, results, text};

/// The map from one impact of a bouncing disk to the next, without units.
///
/// An impact is its phase (rad) and the velocity of the disk relative to the platform just before
/// (``axial_impact_velocity``, not positive, in units of g/omega); the paper's normalised impact speed is
/// that by -pi.
///
/// Parameters
/// ----------
/// axial_forcing : float, optional
///     Axial forcing parameter Gamma = A omega^2/(pi g). This one or the next is needed.
/// peak_acceleration : float, optional
///     Peak acceleration A omega^2/g of the platform.
/// restitution : float
///     Coefficient of restitution, in [0, 1).
///
/// Examples
/// --------
/// >>> import bouncing_disk as bd
/// >>> bouncing = bd.ImpactMap(axial_forcing=0.45, restitution=0.5)
/// >>> phase, velocity = bouncing.period_one()
/// >>> after, _ = bouncing.step(impact_phase=phase, axial_impact_velocity=velocity)
/// >>> abs(after - phase) < 1e-15
/// True
#[pyclass(frozen, eq, module = "bouncing_disk")]
#[derive(Debug, Clone)]
pub(crate) struct ImpactMap {
    pub(crate) map: Map,
    /// Gamma as it was given: what is computed from the peak acceleration may differ in the last place.
    axial_forcing: Option<f64>,
}

/// Two maps are equal that compute the same.
impl PartialEq for ImpactMap {
    fn eq(&self, other: &Self) -> bool {
        self.map == other.map
    }
}

impl ImpactMap {
    /// The map with this peak acceleration.
    pub(crate) fn of(map: Map) -> Self {
        Self { map, axial_forcing: None }
    }

    fn arguments<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let arguments = PyDict::new(py);
        match self.axial_forcing {
            Some(forcing) => arguments.set_item("axial_forcing", forcing)?,
            None => arguments.set_item("peak_acceleration", self.map.vibration().peak_acceleration())?,
        }
        arguments.set_item("restitution", self.map.restitution())?;
        Ok(arguments)
    }
}

/// The arguments as they stand in a text.
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct Written {
    axial_forcing: Option<f64>,
    peak_acceleration: Option<f64>,
    restitution: f64,
}

#[pymethods]
impl ImpactMap {
    #[new]
    #[pyo3(signature = (*, axial_forcing=None, peak_acceleration=None, restitution))]
    fn new(
        py: Python<'_>,
        axial_forcing: Option<Real>,
        peak_acceleration: Option<Real>,
        restitution: Real,
    ) -> PyResult<Self> {
        let (axial_forcing, peak_acceleration) = (optional(axial_forcing), optional(peak_acceleration));
        let (one, other) = ("axial_forcing", "peak_acceleration");
        let vibration = match (axial_forcing, peak_acceleration) {
            (Some(forcing), None) => Vibration::from_axial_forcing(forcing).map_err(Error::from),
            (None, Some(peak)) => Vibration::new(peak).map_err(Error::from),
            (None, None) => Err(Error::NeitherGiven { one, other }),
            (Some(_), Some(_)) => Err(Error::BothGiven { one, other }),
        };
        let map = vibration.and_then(|vibration| Ok(Map::new(vibration, restitution.0)?));
        map.map(|map| Self { map, axial_forcing }).map_err(|error| errors::of(py, error))
    }

    /// The vertical motion of a system.
    #[staticmethod]
    fn of_system(py: Python<'_>, system: &Bound<'_, System>) -> PyResult<Self> {
        let system: &Model = &system.get().0;
        let vibration = Vibration::new(system.peak_acceleration()).map_err(|error| errors::of(py, error))?;
        Map::new(vibration, system.disk().restitution()).map(Self::of).map_err(|error| errors::of(py, error))
    }

    /// Axial forcing parameter Gamma = A omega^2/(pi g).
    #[getter]
    fn axial_forcing(&self) -> f64 {
        self.axial_forcing.unwrap_or_else(|| self.map.vibration().axial_forcing())
    }

    /// Peak acceleration of the platform in units of the preload acceleration.
    #[getter]
    fn peak_acceleration(&self) -> f64 {
        self.map.vibration().peak_acceleration()
    }

    /// Coefficient of restitution.
    #[getter]
    fn restitution(&self) -> f64 {
        self.map.restitution()
    }

    /// The largest normalised impact speed of every attractor and periodic orbit.
    #[getter]
    fn normalised_speed_bound(&self) -> f64 {
        self.map.impact_speed_bound() / std::f64::consts::PI
    }

    /// The next impact.
    ///
    /// No rule ends a chatter: a chattering disk is followed through ever smaller impacts.
    ///
    /// Parameters
    /// ----------
    /// impact_phase : float
    ///     Phase of this impact (rad).
    /// axial_impact_velocity : float
    ///     Its relative velocity, not positive, in units of g/omega.
    ///
    /// Returns
    /// -------
    /// (float, float)
    ///     Phase and velocity of the next impact.
    #[pyo3(signature = (*, impact_phase, axial_impact_velocity))]
    fn step(&self, py: Python<'_>, impact_phase: Real, axial_impact_velocity: Real) -> PyResult<(f64, f64)> {
        let from = (impact_phase.0, axial_impact_velocity.0);
        long_call::short(py, &[PHASE], || Ok(pair(self.map.step(state(from.0, from.1)?)?.into())))
    }

    /// The impact before this one: the only one that :meth:`step` takes there.
    ///
    /// Parameters
    /// ----------
    /// impact_phase, axial_impact_velocity : float
    ///     As of :meth:`step`.
    ///
    /// Returns
    /// -------
    /// (float, float)
    ///     Phase and velocity of the impact before.
    #[pyo3(signature = (*, impact_phase, axial_impact_velocity))]
    fn step_back(
        &self,
        py: Python<'_>,
        impact_phase: Real,
        axial_impact_velocity: Real,
    ) -> PyResult<(f64, f64)> {
        let state = || state(impact_phase.0, axial_impact_velocity.0);
        long_call::short(py, &[PHASE, INVERSE], || Ok(pair(self.map.step_back(state()?)?)))
    }

    /// The impact that is so many steps later.
    ///
    /// Parameters
    /// ----------
    /// impact_phase, axial_impact_velocity : float
    ///     As of :meth:`step`.
    /// impacts : int
    ///     Number of steps.
    /// progress : callable, optional
    ///     Called as ``progress(done, total)`` with the number of impacts.
    ///
    /// Returns
    /// -------
    /// (float, float)
    ///     Phase and velocity of that impact.
    #[pyo3(signature = (*, impact_phase, axial_impact_velocity, impacts, progress=ProgressCallable(None)),
           text_signature = "($self, /, *, impact_phase, axial_impact_velocity, impacts, progress=None)")]
    fn iterate(
        &self,
        py: Python<'_>,
        impact_phase: Real,
        axial_impact_velocity: Real,
        impacts: Count,
        progress: ProgressCallable,
    ) -> PyResult<(f64, f64)> {
        let impacts = impacts.u64(py, "impacts")?;
        long_call::run_named(py, progress.0, &[PHASE], |observer| {
            let from = state(impact_phase.0, axial_impact_velocity.0)?;
            Ok(pair(self.map.iterate(from, impacts, observer)?))
        })
    }

    /// The derivative of the next impact by this one.
    ///
    /// Parameters
    /// ----------
    /// impact_phase, axial_impact_velocity : float
    ///     As of :meth:`step`.
    ///
    /// Returns
    /// -------
    /// (2, 2) float64 array
    ///     Rows: next phase and velocity; columns: by this phase and velocity (rad, units of g/omega).
    #[pyo3(signature = (*, impact_phase, axial_impact_velocity))]
    fn derivative<'py>(
        &self,
        py: Python<'py>,
        impact_phase: Real,
        axial_impact_velocity: Real,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let derivative = long_call::short(py, &[PHASE], || {
            Ok(self.map.step_with_derivative(state(impact_phase.0, axial_impact_velocity.0)?)?.1)
        })?;
        let (x, y) = (derivative.x_axis, derivative.y_axis);
        results::matrix(py, vec![x.x, y.x, x.y, y.y], [2, 2])
    }

    /// The orbit with one impact every so many periods of the platform, in closed form.
    ///
    /// Parameters
    /// ----------
    /// platform_periods : int, default 1
    ///     At least 1.
    ///
    /// Returns
    /// -------
    /// (float, float) or None
    ///     Phase and velocity of its impact; None below the forcing at which it is born.
    #[pyo3(signature = (*, platform_periods=Count::Fits(1)),
           text_signature = "($self, /, *, platform_periods=1)")]
    fn period_one(&self, py: Python<'_>, platform_periods: Count) -> PyResult<Option<(f64, f64)>> {
        let periods = match platform_periods {
            Count::Fits(0) => return Err(errors::out_of_range(py, "platform_periods", 0.0, "at least 1")),
            other => other.u64(py, "platform_periods")?,
        };
        long_call::short(py, &[], || Ok(self.map.period_one(periods).map(pair)))
    }

    /// The periodic orbit next to a guess, stable or not, by Newton's method on all impacts.
    ///
    /// Parameters
    /// ----------
    /// impact_phase : (n,) array_like
    ///     Phases of the impacts of one period (rad), in their order.
    /// axial_impact_velocity : (n,) array_like
    ///     Their relative velocities, not positive, in units of g/omega.
    ///
    /// Returns
    /// -------
    /// PeriodicOrbit
    #[pyo3(signature = (*, impact_phase, axial_impact_velocity))]
    fn refine(
        &self,
        py: Python<'_>,
        impact_phase: &Bound<'_, PyAny>,
        axial_impact_velocity: &Bound<'_, PyAny>,
    ) -> PyResult<PeriodicOrbit> {
        let phases = row(impact_phase, "impact_phase")?;
        let velocities = numbers(axial_impact_velocity, "axial_impact_velocity")?;
        crate::arguments::common_length(&[
            ("impact_phase", Some(phases.len())),
            ("axial_impact_velocity", velocities.len()),
        ])?;
        let names = [
            PHASE,
            name("impacts of a periodic orbit", &["impact_phase"]).legal("[1, 4096] impacts"),
            name("period", &["impact_phase"]),
        ];
        let orbit = long_call::run_named(py, None, &names, |_| {
            let impacts =
                phases.iter().enumerate().map(|(index, phase)| state(*phase, velocities.get(index)));
            Ok(self.map.refine(&impacts.collect::<Result<Vec<_>, _>>()?)?)
        })?;
        Ok(PeriodicOrbit(orbit))
    }

    /// The attracting periodic orbit that the orbit from an impact settles on.
    ///
    /// Parameters
    /// ----------
    /// impact_phase : float
    ///     Phase of the impact (rad).
    /// normalised_speed : float
    ///     Its normalised speed, not negative.
    /// transient : int, default 2000
    ///     Impacts before a period is looked for.
    /// longest_period : int, default 64
    ///     The longest period, in impacts, up to 4096.
    /// tolerance : float, default 1e-7
    ///     How near an orbit must come to itself to count as periodic (rad, and relative speed).
    /// progress : callable, optional
    ///     Called as ``progress(done, total)`` with the number of impacts.
    ///
    /// Returns
    /// -------
    /// PeriodicOrbit or None
    ///     None if the disk comes to rest or shows no period.
    #[pyo3(signature = (
        *, impact_phase, normalised_speed, transient=Count::Fits(2000), longest_period=Count::Fits(64),
        tolerance=Real(1e-7), progress=ProgressCallable(None)
    ), text_signature = "($self, /, *, impact_phase, normalised_speed, transient=2000, longest_period=64, \
                         tolerance=1e-7, progress=None)")]
    #[expect(clippy::too_many_arguments, reason = "they are keywords")]
    fn settled_orbit(
        &self,
        py: Python<'_>,
        impact_phase: Real,
        normalised_speed: Real,
        transient: Count,
        longest_period: Count,
        tolerance: Real,
        progress: ProgressCallable,
    ) -> PyResult<Option<PeriodicOrbit>> {
        let (transient, longest) =
            (transient.usize(py, "transient")?, longest_period.usize(py, "longest_period")?);
        let names = [name("longest period", &["longest_period"])];
        let orbit = long_call::run_named(py, progress.0, &names, |observer| {
            let start = first_impact(impact_phase.0, normalised_speed.0)?;
            Ok(self.map.settled_orbit(start, transient, longest, tolerance.0, observer)?)
        })?;
        Ok(orbit.map(PeriodicOrbit))
    }

    /// The arguments that make this map.
    fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        self.arguments(py)
    }

    /// The map of such arguments.
    ///
    /// Parameters
    /// ----------
    /// parameters : dict
    ///     As of :meth:`to_dict`.
    ///
    /// Returns
    /// -------
    /// ImpactMap
    #[staticmethod]
    fn from_dict<'py>(py: Python<'py>, parameters: &Bound<'py, PyDict>) -> PyResult<Bound<'py, PyAny>> {
        py.get_type::<Self>().call((), Some(parameters))
    }

    /// The arguments that make this map, as JSON.
    fn to_json(&self, py: Python<'_>) -> PyResult<String> {
        text::to_json(&self.arguments(py)?)
    }

    /// The map of such a text.
    ///
    /// Parameters
    /// ----------
    /// json : str
    ///     As of :meth:`to_json`.
    ///
    /// Returns
    /// -------
    /// ImpactMap
    #[staticmethod]
    fn from_json(py: Python<'_>, json: Json) -> PyResult<Self> {
        let Written { axial_forcing, peak_acceleration, restitution } = json.read(py)?;
        Self::new(py, axial_forcing.map(Real), peak_acceleration.map(Real), Real(restitution))
    }

    fn __getnewargs_ex__<'py>(&self, py: Python<'py>) -> PyResult<((), Bound<'py, PyDict>)> {
        Ok(((), self.arguments(py)?))
    }

    fn __hash__(&self) -> u64 {
        text::hash(&[self.map.vibration().peak_acceleration(), self.map.restitution()])
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        text::call("ImpactMap", &self.arguments(py)?)
    }
}
