//! What a motor depends on: next to its data sheet, and over ranges of its parameters.

use bouncing_disk::{
    ElementaryEffects, Estimate, ParameterRange, SamplingSettings, SensitivityMethod, SensitivityParameter,
    SensitivityQuantity, SensitivitySettings, SobolIndices,
};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyMapping, PyTuple};

use crate::arguments::{Count, ProgressCallable};
use crate::motor::Motor;
use crate::names::{Name, name};
use crate::operation::Settings;
use crate::real::{Pair, Real};
use crate::system_names::{MOTOR_NAMES, OF_MOTOR};
use crate::{long_call, results};

/// The quantity of an argument.
fn quantity(name: &str) -> PyResult<SensitivityQuantity> {
    match name {
        "steady-speed" => Ok(SensitivityQuantity::SteadySpeed),
        "stall-torque" => Ok(SensitivityQuantity::StallTorque),
        _ => Err(PyValueError::new_err(format!(
            "quantity must be \"steady-speed\" or \"stall-torque\", and is {name:?}"
        ))),
    }
}

/// The parameter of a name.
fn parameter(name: &str) -> PyResult<SensitivityParameter> {
    SensitivityParameter::ALL.into_iter().find(|parameter| parameter.name() == name).ok_or_else(|| {
        let known: Vec<_> = SensitivityParameter::ALL.iter().map(|parameter| parameter.name()).collect();
        PyValueError::new_err(format!("the parameter {name:?} is unknown; there are {}", known.join(", ")))
    })
}

/// The ranges of a mapping, in its order.
fn ranges(given: &Bound<'_, PyMapping>) -> PyResult<Vec<ParameterRange>> {
    let mut ranges = Vec::new();
    for item in given.items()? {
        let (name, Pair(low, high)): (String, Pair) = item.extract()?;
        ranges.push((parameter(&name)?, [low, high]));
    }
    Ok(ranges)
}

/// What the library calls the arguments of samples over ranges.
const NAMES: [Name; 4] = [
    name("number of ranges", &["ranges"]).legal("[1, 64] ranges"),
    name("range (low)", &["ranges"]),
    name("range (high)", &["ranges"]).legal("[the low end, inf)"),
    name("range (width)", &["ranges"]),
];

/// What motors with other parameters may be refused for, by where the values come from.
fn motor_names(argument: &'static [&'static str; 1]) -> [Name; MOTOR_NAMES] {
    OF_MOTOR.map(|quantity| quantity.of_values_in(argument))
}

/// The names that parameters have in a data sheet.
fn sheet_names(argument: &'static [&'static str; 1]) -> [Name; 10] {
    let preload = |parameter: SensitivityParameter| match parameter {
        SensitivityParameter::Preload => "preload_acceleration",
        other => other.name(),
    };
    SensitivityParameter::ALL.map(|parameter| name(preload(parameter), argument))
}

/// Values with their errors, as two arrays.
fn columns<'py, T>(
    py: Python<'py>,
    all: &[T],
    of: fn(&T) -> Estimate,
) -> (Bound<'py, numpy::PyArray1<f64>>, Bound<'py, numpy::PyArray1<f64>>) {
    let values = all.iter().map(|one| of(one).value).collect();
    let errors = all.iter().map(|one| of(one).standard_error).collect();
    (results::array(py, values), results::array(py, errors))
}

/// How the steady speed or the stall torque of a motor depends on its parameters next to its data sheet.
///
/// Parameters
/// ----------
/// motor : Motor
/// parameters : sequence of str, optional
///     Which ones, of ``friction``, ``peak_angular_speed``, ``phase_lag``, ``contact_radius``,
///     ``gyration_radius``, ``load_torque``, ``amplitude``, ``preload``, ``restitution`` and
///     ``drive_frequency``; by default the first six, which share one vertical motion.
/// quantity : {"steady-speed", "stall-torque"}, default "steady-speed"
///     What is asked for.
/// half_range : float, default 0.2
///     Half the range, in the logarithm of a parameter of the vertical motion, over which motors are drawn, in
///     (0, 2].
/// points : int, default 24
///     Motors that are drawn over it, in [5, 10000].
/// relative_error, members, most_impacts, relaunch_perturbation, seed : optional
///     As of :func:`operating_point`.
/// progress : callable, optional
///     Called as ``progress(done, total)`` with the number of ensembles.
///
/// Returns
/// -------
/// LocalSensitivities
///
/// Examples
/// --------
/// >>> import bouncing_disk as bd
/// >>> motor = bd.Motor(drive_frequency=70e3, amplitude=1e-8, peak_angular_speed=30.0, mass=1e-3,
/// ...     contact_radius=1.25e-3, gyration_radius=6.3e-3, preload_acceleration=9.8, friction=0.1, restitution=0.5)
/// >>> found = bd.local_sensitivities(motor, parameters=["friction", "peak_angular_speed"], relative_error=0.05)
/// >>> bool(found.derivative[0] < 0.5 < found.derivative[1])  # The speed follows the stator, not the friction.
/// True
#[pyfunction]
#[pyo3(signature = (
    motor, *, parameters=None, quantity="steady-speed", half_range=Real(0.2), points=Count::Fits(24),
    relative_error=Real(0.01), members=Count::Fits(16), most_impacts=Count::Fits(20_000_000),
    relaunch_perturbation=Real(1e-3), seed=Count::Fits(1), progress=ProgressCallable(None)
), text_signature = "(motor, *, parameters=None, quantity='steady-speed', half_range=0.2, points=24, relative_error=0.01, \
                     members=16, most_impacts=20000000, relaunch_perturbation=0.001, seed=1, progress=None)")]
#[expect(clippy::too_many_arguments, reason = "they are keywords")]
pub(crate) fn local_sensitivities<'py>(
    py: Python<'py>,
    motor: &Bound<'py, Motor>,
    parameters: Option<&Bound<'py, PyAny>>,
    quantity: &str,
    half_range: Real,
    points: Count,
    relative_error: Real,
    members: Count,
    most_impacts: Count,
    relaunch_perturbation: Real,
    seed: Count,
    progress: ProgressCallable,
) -> PyResult<Bound<'py, PyAny>> {
    let operating =
        Settings { relative_error, members, most_impacts, relaunch_perturbation, seed }.checked(py)?;
    let settings =
        SensitivitySettings { operating, half_range: half_range.0, points: points.usize(py, "points")? };
    let chosen: Vec<_> = match parameters {
        None => {
            let all = SensitivityParameter::ALL.into_iter();
            all.filter(|parameter| parameter.shares_vertical_motion()).collect()
        }
        Some(names) => {
            if names.is_instance_of::<pyo3::types::PyString>() {
                return Err(PyTypeError::new_err("parameters must be names, and is one text"));
            }
            let mut chosen = Vec::new();
            for one in names.try_iter()? {
                chosen.push(parameter(&one?.extract::<String>()?)?);
            }
            chosen
        }
    };
    let (model, asked) = (motor.get().0, self::quantity(quantity)?);
    let names = [&sheet_names(&["motor"])[..], &motor_names(&["motor"])].concat();
    let found = long_call::run_named(py, progress.0, &names, |observer| {
        model.local_sensitivities(asked, &chosen, &settings, observer)
    })?;
    let names = PyTuple::new(py, found.iter().map(|one| one.parameter.name()))?;
    let (derivative, error) = columns(py, &found, |one| one.derivative);
    let methods = PyTuple::new(
        py,
        found.iter().map(|one| match one.method {
            SensitivityMethod::SharedMotion { .. } => "shared-motion",
            SensitivityMethod::Regression { .. } => "regression",
            _ => "unknown",
        }),
    )?;
    let traps = found.iter().map(|one| match one.method {
        SensitivityMethod::Regression { traps, .. } => traps as i64,
        _ => 0,
    });
    let fields = (names, derivative, error, methods, results::array(py, traps.collect()), quantity);
    results::make(py, "LocalSensitivities", fields)
}

/// What the two calls over ranges share.
struct Sample {
    ranges: Vec<ParameterRange>,
    quantity: SensitivityQuantity,
    sampling: SamplingSettings,
    operating: bouncing_disk::OperatingSettings,
    names: Vec<Name>,
}

impl Sample {
    fn of(
        py: Python<'_>,
        given: &Bound<'_, PyMapping>,
        asked: &str,
        rows: Count,
        sampling_seed: Count,
        settings: Settings,
    ) -> PyResult<Self> {
        Ok(Self {
            ranges: ranges(given)?,
            quantity: quantity(asked)?,
            sampling: SamplingSettings {
                rows: rows.usize(py, "rows")?,
                seed: sampling_seed.u64(py, "sampling_seed")?,
            },
            operating: settings.checked(py)?,
            names: [&NAMES[..], &sheet_names(&["ranges"]), &motor_names(&["ranges"])].concat(),
        })
    }

    fn parameters<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        PyTuple::new(py, self.ranges.iter().map(|(parameter, _)| parameter.name()))
    }
}

/// Which share of the variance of the steady speed or the stall torque each parameter has over its range (Sobol').
///
/// Parameters
/// ----------
/// motor : Motor
/// ranges : mapping of str to (float, float)
///     The range of each parameter (SI), over which it is spread evenly; names as of :func:`local_sensitivities`.
/// quantity : {"steady-speed", "stall-torque"}, default "steady-speed"
///     What is asked for.
/// rows : int, default 256
///     Rows of the sample, in [8, 1000000]; with d parameters each takes d + 2 motors.
/// sampling_seed : int, default 1
///     Seed of the sample.
/// relative_error, members, most_impacts, relaunch_perturbation, seed : optional
///     As of :func:`operating_point`.
/// progress : callable, optional
///     Called as ``progress(done, total)`` with the number of rows.
///
/// Returns
/// -------
/// SobolIndices
#[pyfunction]
#[pyo3(signature = (
    motor, *, ranges, quantity="steady-speed", rows=Count::Fits(256), sampling_seed=Count::Fits(1),
    relative_error=Real(0.01), members=Count::Fits(16), most_impacts=Count::Fits(20_000_000),
    relaunch_perturbation=Real(1e-3), seed=Count::Fits(1), progress=ProgressCallable(None)
), text_signature = "(motor, *, ranges, quantity='steady-speed', rows=256, sampling_seed=1, relative_error=0.01, \
                     members=16, most_impacts=20000000, relaunch_perturbation=0.001, seed=1, progress=None)")]
#[expect(clippy::too_many_arguments, reason = "they are keywords")]
pub(crate) fn sobol_indices<'py>(
    py: Python<'py>,
    motor: &Bound<'py, Motor>,
    ranges: &Bound<'py, PyMapping>,
    quantity: &str,
    rows: Count,
    sampling_seed: Count,
    relative_error: Real,
    members: Count,
    most_impacts: Count,
    relaunch_perturbation: Real,
    seed: Count,
    progress: ProgressCallable,
) -> PyResult<Bound<'py, PyAny>> {
    let settings = Settings { relative_error, members, most_impacts, relaunch_perturbation, seed };
    let sample = Sample::of(py, ranges, quantity, rows, sampling_seed, settings)?;
    let model = motor.get().0;
    let found: Vec<SobolIndices> = long_call::run_named(py, progress.0, &sample.names, |observer| {
        let Sample { quantity, ranges, sampling, operating, .. } = &sample;
        model.sobol_indices(*quantity, ranges, *sampling, operating, observer)
    })?;
    let (first, first_error) = columns(py, &found, |one| one.first);
    let (total, total_error) = columns(py, &found, |one| one.total);
    let fields = (sample.parameters(py)?, first, first_error, total, total_error, quantity);
    results::make(py, "SobolIndices", fields)
}

/// By how much the steady speed or the stall torque changes with each parameter over its range (Morris): a cheap
/// ranking.
///
/// Parameters
/// ----------
/// motor : Motor
/// ranges, quantity : optional
///     As of :func:`sobol_indices`.
/// rows : int, default 64
///     Trajectories of the sample, in [8, 1000000]; with d parameters each takes d + 1 motors.
/// sampling_seed, relative_error, members, most_impacts, relaunch_perturbation, seed : optional
///     As of :func:`sobol_indices`.
/// progress : callable, optional
///     Called as ``progress(done, total)`` with the number of trajectories.
///
/// Returns
/// -------
/// ElementaryEffects
#[pyfunction]
#[pyo3(signature = (
    motor, *, ranges, quantity="steady-speed", rows=Count::Fits(64), sampling_seed=Count::Fits(1),
    relative_error=Real(0.01), members=Count::Fits(16), most_impacts=Count::Fits(20_000_000),
    relaunch_perturbation=Real(1e-3), seed=Count::Fits(1), progress=ProgressCallable(None)
), text_signature = "(motor, *, ranges, quantity='steady-speed', rows=64, sampling_seed=1, relative_error=0.01, \
                     members=16, most_impacts=20000000, relaunch_perturbation=0.001, seed=1, progress=None)")]
#[expect(clippy::too_many_arguments, reason = "they are keywords")]
pub(crate) fn elementary_effects<'py>(
    py: Python<'py>,
    motor: &Bound<'py, Motor>,
    ranges: &Bound<'py, PyMapping>,
    quantity: &str,
    rows: Count,
    sampling_seed: Count,
    relative_error: Real,
    members: Count,
    most_impacts: Count,
    relaunch_perturbation: Real,
    seed: Count,
    progress: ProgressCallable,
) -> PyResult<Bound<'py, PyAny>> {
    let settings = Settings { relative_error, members, most_impacts, relaunch_perturbation, seed };
    let sample = Sample::of(py, ranges, quantity, rows, sampling_seed, settings)?;
    let model = motor.get().0;
    let found: Vec<ElementaryEffects> = long_call::run_named(py, progress.0, &sample.names, |observer| {
        let Sample { quantity, ranges, sampling, operating, .. } = &sample;
        model.elementary_effects(*quantity, ranges, *sampling, operating, observer)
    })?;
    let (mean, mean_error) = columns(py, &found, |one| one.mean);
    let (size, size_error) = columns(py, &found, |one| one.mean_size);
    let (deviation, deviation_error) = columns(py, &found, |one| one.deviation);
    let parameters = sample.parameters(py)?;
    let fields = (parameters, mean, mean_error, size, size_error, deviation, deviation_error, quantity);
    results::make(py, "ElementaryEffects", fields)
}
