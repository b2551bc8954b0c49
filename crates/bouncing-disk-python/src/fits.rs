//! Fits of transients.

use std::path::PathBuf;
use std::str::FromStr;

use bouncing_disk::{
    CsvColumns, Error, ExponentialFit, FitSettings, IntervalEstimate, MeasuredSpeeds, RiseEstimate, RiseForm,
    TransientFit, UnknownUnit,
};
use numpy::PyArray1;
use pyo3::prelude::*;

use crate::arguments::{Count, ProgressCallable, columns, row};
use crate::names::{Name, derived, name};
use crate::real::Real;
use crate::{errors, long_call, results};

/// What the library calls the curves that are fitted.
pub(crate) const NAMES: [Name; 8] = [
    name("number of points of the speed curve", &["times"]).legal("[3, inf) points"),
    name("number of speeds", &["speeds"]).legal("one for each time"),
    name("times of the speed curve", &["times"]),
    name("speed", &["speeds"]),
    name("number of times", &["times"]),
    derived("fitted time (s)", &["times", "speeds"]),
    derived("fitted steady speed (rad/s)", &["times", "speeds"]),
    derived("residual of the fit (rad/s)", &["times", "speeds"]),
];

/// The exponential rise 1 - exp(-t/t_c) that fits a speed curve best.
///
/// Parameters
/// ----------
/// times : (n,) array_like
///     Times (s), rising, not negative.
/// speeds : (n,) array_like
///     Speeds (rad/s).
/// progress : callable, optional
///     Called as ``progress(done, total)``.
///
/// Returns
/// -------
/// ExponentialFit
///
/// Examples
/// --------
/// >>> import bouncing_disk as bd
/// >>> import numpy as np
/// >>> times = np.linspace(0.0, 5.0, 100)
/// >>> fit = bd.fit_exponential(times=times, speeds=30.0 * (1.0 - np.exp(-times / 0.8)))
/// >>> round(fit.steady_speed, 3), round(fit.time_constant, 3)
/// (30.0, 0.8)
#[pyfunction]
#[pyo3(signature = (*, times, speeds, progress=ProgressCallable(None)),
       text_signature = "(*, times, speeds, progress=None)")]
pub(crate) fn fit_exponential<'py>(
    py: Python<'py>,
    times: &Bound<'py, PyAny>,
    speeds: &Bound<'py, PyAny>,
    progress: ProgressCallable,
) -> PyResult<Bound<'py, PyAny>> {
    let (times, speeds) = (row(times, "times")?, row(speeds, "speeds")?);
    let fit = long_call::run_named(py, progress.0, &NAMES, |observer| {
        ExponentialFit::new(&times, &speeds, observer)
    })?;
    let fields = (fit.steady_speed, fit.time_constant, fit.residual, fit.stall_acceleration());
    results::make(py, "ExponentialFit", fields)
}

/// An interval as Python has it.
pub(crate) fn interval<'py>(py: Python<'py>, estimate: &IntervalEstimate) -> PyResult<Bound<'py, PyAny>> {
    results::make(py, "IntervalEstimate", (estimate.value, estimate.low, estimate.high))
}

fn rise<'py>(py: Python<'py>, rise: &RiseEstimate) -> PyResult<Bound<'py, PyAny>> {
    let fields = (
        interval(py, &rise.steady_speed)?,
        interval(py, &rise.constant)?,
        interval(py, &rise.stall_acceleration)?,
        rise.start_speed.as_ref().map(|start| interval(py, start)).transpose()?,
        rise.residual,
    );
    results::make(py, "RiseEstimate", fields)
}

/// Steady speed, time constant and stall acceleration of a motor, with 95 % intervals, from runs of it.
///
/// Parameters
/// ----------
/// times : (n,) array_like
///     Times (s), rising; below zero, too, unless the motor starts from rest.
/// speeds : (n,) or (n, m) array_like
///     Speeds (rad/s) of one measured run, or of m runs (5 at least), time by member.
/// resamples : int, default 1000
///     Resampled fits.
/// seed : int, default 1
///     Seed of the resampling.
/// least_duration : float, default 3
///     Time constants that a curve must last.
/// largest_residual : float, default 0.1
///     The largest residual, relative to the steady speed.
/// from_rest : bool, default False
///     Whether the motor rises from rest at time zero. Without it time zero, a dead time and the speed at the start
///     are found from the record, and the intervals are wider.
/// progress : callable, optional
///     Called as ``progress(done, total)``.
///
/// Returns
/// -------
/// TransientFit
///
/// Examples
/// --------
/// >>> import bouncing_disk as bd
/// >>> import numpy as np
/// >>> times = np.linspace(0.01, 5.0, 200)
/// >>> spread = np.array([0.97, 0.98, 0.99, 1.01, 1.02, 1.03])
/// >>> speeds = 30.0 * (1.0 - np.exp(-times / 0.8))[:, np.newaxis] * spread
/// >>> fit = bd.fit_transients(times=times, speeds=speeds)
/// >>> fit.form, fit.members, fit.exponential.steady_speed.low < 30.0 < fit.exponential.steady_speed.high
/// ('exponential', 6, True)
#[pyfunction]
#[pyo3(signature = (
    *, times, speeds, resamples=Count::Fits(1000), seed=Count::Fits(1), least_duration=Real(3.0),
    largest_residual=Real(0.1), from_rest=false, progress=ProgressCallable(None)
), text_signature = "(*, times, speeds, resamples=1000, seed=1, least_duration=3.0, largest_residual=0.1, \
                     from_rest=False, progress=None)")]
#[expect(clippy::too_many_arguments, reason = "they are keywords")]
pub(crate) fn fit_transients<'py>(
    py: Python<'py>,
    times: &Bound<'py, PyAny>,
    speeds: &Bound<'py, PyAny>,
    resamples: Count,
    seed: Count,
    least_duration: Real,
    largest_residual: Real,
    from_rest: bool,
    progress: ProgressCallable,
) -> PyResult<Bound<'py, PyAny>> {
    let times = row(times, "times")?;
    let runs = match row(speeds, "speeds") {
        Ok(speeds) => vec![speeds],
        Err(_) => columns(speeds, "speeds")?,
    };
    let (resamples, seed) = (resamples.usize(py, "resamples")?, seed.u64(py, "seed")?);
    let settings = FitSettings {
        resamples,
        seed,
        least_duration: least_duration.0,
        largest_residual: largest_residual.0,
        from_rest,
    };
    let fit = long_call::run_named(py, progress.0, &NAMES, |observer| {
        let runs: Vec<(&[f64], &[f64])> =
            runs.iter().map(|speeds| (times.as_slice(), speeds.as_slice())).collect();
        TransientFit::of_measured(&runs, &settings, observer)
    })?;
    let form = match fit.form {
        RiseForm::Exponential => "exponential",
        RiseForm::Ramp => "ramp",
    };
    let ramp = fit.ramp.as_ref().map(|ramp| rise(py, ramp)).transpose()?;
    let exponential = rise(py, &fit.exponential)?;
    let fields =
        (exponential, ramp, form, fit.start_time, fit.zero_time(), fit.duration, fit.points, fit.members);
    results::make(py, "TransientFit", fields)
}

/// Times and speeds of a run.
type Run<'py> = (Bound<'py, PyArray1<f64>>, Bound<'py, PyArray1<f64>>);

/// Measured speeds from a file of separated values, as instruments write them.
///
/// The first line that names the columns is the header; units are in the names, in the row below, or given here. Remarks,
/// semicolons, tabs and decimal commas are legal; what is not clear is refused with its line and field.
///
/// Parameters
/// ----------
/// path : path-like
///     The file: times, speeds and, for repeated runs, a number of the run (``member``).
/// time_column, speed_column : str, optional
///     The names of the columns, if they are not known ones; other columns are then passed over.
/// time_unit : {"s", "ms", "us", "min"}, optional
///     The unit of the times.
/// speed_unit : {"rad/s", "rpm", "rev/s", "deg/s"}, optional
///     The unit of the speeds.
///
/// Returns
/// -------
/// list of (times, speeds)
///     Times (s) and angular speeds (rad/s) of each run.
#[pyfunction]
#[pyo3(signature = (path, *, time_column=None, speed_column=None, time_unit=None, speed_unit=None),
       text_signature = "(path, *, time_column=None, speed_column=None, time_unit=None, speed_unit=None)")]
pub(crate) fn read_speeds<'py>(
    py: Python<'py>,
    path: PathBuf,
    time_column: Option<String>,
    speed_column: Option<String>,
    time_unit: Option<&str>,
    speed_unit: Option<&str>,
) -> PyResult<Vec<Run<'py>>> {
    fn unit<T: FromStr<Err = UnknownUnit>>(py: Python<'_>, text: Option<&str>) -> PyResult<Option<T>> {
        text.map(str::parse).transpose().map_err(|error| errors::invalid_text(py, &error))
    }
    let columns = CsvColumns {
        time: time_column,
        speed: speed_column,
        time_unit: unit(py, time_unit)?,
        speed_unit: unit(py, speed_unit)?,
    };
    let read = py.detach(|| MeasuredSpeeds::from_csv_with(&path, &columns));
    let read = read.map_err(|error| errors::of_measured(py, &error))?;
    let arrays = |times: &[f64], speeds: &[f64]| {
        (results::array(py, times.to_vec()), results::array(py, speeds.to_vec()))
    };
    Ok(read.runs().iter().map(|run| arrays(&run.times, &run.speeds)).collect())
}
