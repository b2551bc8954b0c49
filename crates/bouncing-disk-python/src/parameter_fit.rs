//! Parameters of a motor from its measured transients.

use bouncing_disk::{
    FitParameter, FitRange, MeasuredRun, MeasuredSpeeds, MeasuredTransient, ParameterFit,
    ParameterFitSettings, RunPreload,
};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyMapping, PyTuple};

use crate::arguments::{Count, ProgressCallable, columns, row};
use crate::fits::interval;
use crate::motor::Motor;
use crate::names::{Name, derived, name};
use crate::real::{Pair, Real, optional};
use crate::{errors, long_call, results};

/// The parameters that transients may tell.
const PARAMETERS: [FitParameter; 5] = [
    FitParameter::Friction,
    FitParameter::Restitution,
    FitParameter::PhaseLag,
    FitParameter::Amplitude,
    FitParameter::TwistAmplitude,
];

/// Of a motor whose own value lies outside of the range that is given.
const SEARCHED: &str = "within the range that is searched";

/// What the library calls the arguments.
const NAMES: [Name; 22] = [
    name("number of transients", &["transients"]).legal("[1, 1000] transients"),
    name("number of fitted parameters", &["ranges"]).legal("[1, 5] parameters"),
    name("runs", &["transients.speeds"]).legal("[1, inf) runs"),
    name("number of points of the speed curve", &["transients.times"]).legal("[3, inf) points"),
    name("number of speeds", &["transients.speeds"]).legal("one for each time"),
    name("times of the speed curve", &["transients.times"]),
    name("speed", &["transients.speeds"]),
    name("preload", &["transients.preload_acceleration"]),
    name("preload_acceleration", &["transients.preload_acceleration"]),
    derived("square of a measured speed", &["transients.speeds", "speed_error"]),
    derived("variance of a mean speed", &["transients.speeds", "speed_error"]),
    name("upper end of a range", &["ranges"]),
    name("width of the range of the phase lag", &["ranges.phase_lag"]),
    name("friction", &["motor.friction"]).only(SEARCHED),
    name("restitution", &["motor.restitution"]).only(SEARCHED),
    name("phase_lag", &["motor.phase_lag"]).only(SEARCHED),
    name("amplitude", &["motor.amplitude"]).only(SEARCHED),
    name("friction", &["ranges.friction"]),
    name("restitution", &["ranges.restitution"]),
    name("phase_lag", &["ranges.phase_lag"]),
    name("amplitude", &["ranges.amplitude"]),
    name("twist_amplitude", &["ranges.twist_amplitude"]),
];

/// The ranges of a mapping, in its order.
fn ranges(given: &Bound<'_, PyMapping>) -> PyResult<Vec<FitRange>> {
    let mut ranges = Vec::new();
    for item in given.items()? {
        let (name, Pair(low, high)): (String, Pair) = item.extract()?;
        let Some(parameter) = PARAMETERS.into_iter().find(|parameter| parameter.name() == name) else {
            let known: Vec<_> = PARAMETERS.iter().map(|parameter| parameter.name()).collect();
            let text =
                format!("the parameter {name:?} cannot be fitted; those that can are {}", known.join(", "));
            return Err(PyValueError::new_err(text));
        };
        ranges.push(FitRange { parameter, low, high });
    }
    Ok(ranges)
}

/// Runs of one preload.
fn measured(
    py: Python<'_>,
    times: &Bound<'_, PyAny>,
    speeds: &Bound<'_, PyAny>,
    preload_acceleration: f64,
    speed_error: Option<f64>,
) -> PyResult<MeasuredTransient> {
    let times = row(times, "times")?;
    let runs = row(speeds, "speeds").map(|run| vec![run]).or_else(|_| columns(speeds, "speeds"))?;
    let runs = runs.into_iter().zip(0..).map(|(speeds, member)| MeasuredRun {
        member,
        times: times.clone(),
        speeds,
    });
    let runs = MeasuredSpeeds::new(runs.collect()).map_err(|error| errors::of_named(py, error, &NAMES))?;
    Ok(MeasuredTransient { preload: RunPreload::Acceleration(preload_acceleration), runs, speed_error })
}

/// Friction, restitution, phase lag or amplitudes of a motor from its transients, with 95 % intervals.
///
/// Parameters
/// ----------
/// motor : Motor
///     The data sheet, from whose values the search begins.
/// transients : iterable of (times, speeds, preload_acceleration)
///     For each preload the times (n,) (s), the speeds (n,) or (n, m) of one or m runs (rad/s), and the
///     preload acceleration (m/s^2).
/// ranges : mapping
///     The range (low, high) of each parameter that is fitted: of ``friction``, ``restitution``,
///     ``phase_lag``, ``amplitude`` and ``twist_amplitude``.
/// speed_error : float, optional
///     Standard deviation of the error of one measured speed (rad/s).
/// members : int, default 64
///     Computed members at each preload, in [24, 4096].
/// windows : int, default 6
///     Windows of time over whose means a transient is compared, in [1, 12].
/// relaunch_perturbation : float, default 0.001
///     Size of the relaunch perturbation in units of g/omega, in (0, 1].
/// seed : int, default 1
///     Seed of the perturbations and of the resampling.
/// most_evaluations : int, default 100
///     Most evaluations of all motors, in [1, 10000].
/// resamples : int, default 1000
///     Resampled fits, in [200, 100000].
/// largest_misfit : float, default 1
///     The largest misfit that is accepted, at least 1.
/// progress : callable, optional
///     Called as ``progress(done, total)`` with the number of evaluations.
///
/// Returns
/// -------
/// ParameterFit
#[pyfunction]
#[pyo3(signature = (
    motor, *, transients, ranges, speed_error=None, members=Count::Fits(64), windows=Count::Fits(6),
    relaunch_perturbation=Real(1e-3), seed=Count::Fits(1), most_evaluations=Count::Fits(100), resamples=Count::Fits(1000),
    largest_misfit=Real(1.0), progress=ProgressCallable(None)
), text_signature = "(motor, *, transients, ranges, speed_error=None, members=64, windows=6, \
                     relaunch_perturbation=0.001, seed=1, most_evaluations=100, resamples=1000, largest_misfit=1.0, \
                     progress=None)")]
#[expect(clippy::too_many_arguments, reason = "they are keywords")]
pub(crate) fn fit_parameters<'py>(
    py: Python<'py>,
    motor: &Bound<'py, Motor>,
    transients: &Bound<'py, PyAny>,
    ranges: &Bound<'py, PyMapping>,
    speed_error: Option<Real>,
    members: Count,
    windows: Count,
    relaunch_perturbation: Real,
    seed: Count,
    most_evaluations: Count,
    resamples: Count,
    largest_misfit: Real,
    progress: ProgressCallable,
) -> PyResult<Bound<'py, PyAny>> {
    let mut all = Vec::new();
    for transient in transients.try_iter()? {
        let (times, speeds, preload): (Bound<'_, PyAny>, Bound<'_, PyAny>, Real) = transient?.extract()?;
        all.push(measured(py, &times, &speeds, preload.0, optional(speed_error))?);
    }
    let ranges = self::ranges(ranges)?;
    let settings = ParameterFitSettings {
        members: members.usize(py, "members")?,
        windows: windows.usize(py, "windows")?,
        relaunch_perturbation: relaunch_perturbation.0,
        seed: seed.u64(py, "seed")?,
        most_evaluations: most_evaluations.usize(py, "most_evaluations")?,
        resamples: resamples.usize(py, "resamples")?,
        largest_misfit: largest_misfit.0,
    };
    let nominal = motor.get().0;
    let fit = long_call::run_named(py, progress.0, &NAMES, |observer| {
        ParameterFit::new(&nominal, &all, &ranges, &settings, observer)
    })?;
    let (nominal, estimates) = (PyDict::new(py), PyDict::new(py));
    for fitted in &fit.parameters {
        nominal.set_item(fitted.parameter.name(), fitted.nominal)?;
        let estimate = fitted.estimate.as_ref().map(|estimate| interval(py, estimate)).transpose()?;
        estimates.set_item(fitted.parameter.name(), estimate)?;
    }
    let mut undetermined = Vec::new();
    for direction in &fit.undetermined {
        let changes = PyDict::new(py);
        for (parameter, change) in &direction.direction {
            changes.set_item(parameter.name(), change)?;
        }
        undetermined.push((changes, direction.standard_error).into_pyobject(py)?);
    }
    let fields = (
        nominal,
        estimates,
        PyTuple::new(py, undetermined)?,
        Motor(fit.motor),
        fit.misfit,
        fit.degrees_of_freedom,
        fit.evaluations,
    );
    results::make(py, "ParameterFit", fields)
}
