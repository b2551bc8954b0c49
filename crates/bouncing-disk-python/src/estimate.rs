//! Speed transients of motors, and fits of measured ones: of their rise and of the motor's parameters.

use std::str::FromStr;

use bouncing_disk::Error;
use bouncing_disk::estimate::{
    CsvColumns, FitParameter, FitRange, FitSettings, IntervalEstimate, MeasuredRun, MeasuredSpeeds,
    MeasuredTransient, ParameterFit, ParameterFitSettings, RiseEstimate, RiseForm, RunPreload, Spread,
    TransientEnsemble, TransientFit, UnknownUnit,
};
use bouncing_disk::motor::{SpeedCurve, TransientSettings};
use numpy::PyArray1;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyMapping, PyTuple};

use crate::arguments::{Arguments, Made, Pair, Real, row, runs};
use crate::errors;
use crate::parameters::shown_motor;
use crate::results::{array, column, make, matrix, room_for};

/// One value tells neither deviation nor error.
fn shown_spread<'py>(py: Python<'py>, spread: &Spread, members: usize) -> Made<'py> {
    let of_many = |number: f64| if members > 1 { number } else { f64::NAN };
    make!(py, "Spread", spread.mean, of_many(spread.deviation), of_many(spread.standard_error))
}

/// The transients of one motor from many phases.
#[pyfunction]
pub(crate) fn ensemble(a: Arguments<'_>) -> Made<'_> {
    let (system, members, py) = (a.system()?, a.usize("members")?, a.py());
    let settings = TransientSettings {
        duration: a.real("duration")?,
        intervals: a.usize("intervals")?,
        relaunch_perturbation: a.real("relaunch_perturbation")?,
        seed: a.u64("seed")?,
        policy: a.policy()?,
    };
    let (runs, times, speeds) = a.run(|observer| {
        let runs = TransientEnsemble::new(&system, &settings, members, observer)?;
        // A number of each member at each time, time by member.
        let table = |of: fn(&SpeedCurve) -> &[f64]| {
            let mut numbers = room_for(settings.intervals * members)?;
            for point in 0..settings.intervals {
                numbers.extend(runs.curves.iter().map(|curve| of(curve)[point]));
            }
            Ok::<_, Error>(numbers)
        };
        let (times, speeds) = (table(|curve| &curve.times)?, table(|curve| &curve.speeds)?);
        Ok((runs, times, speeds))
    })?;
    let shape = [settings.intervals, members];
    make!(
        py,
        "TransientEnsemble",
        matrix(py, times, shape)?,
        matrix(py, speeds, shape)?,
        column(py, &runs.curves, |curve| curve.impacts as i64),
        column(py, &runs.curves, |curve| curve.separations as i64),
        column(py, &runs.fits, |fit| fit.steady_speed),
        column(py, &runs.fits, |fit| fit.time_constant),
        column(py, &runs.fits, |fit| fit.residual),
        shown_spread(py, &runs.steady_speed, members)?,
        shown_spread(py, &runs.time_constant, members)?,
        shown_spread(py, &runs.stall_acceleration, members)?,
    )
}

fn interval<'py>(py: Python<'py>, estimate: &IntervalEstimate) -> Made<'py> {
    make!(py, "IntervalEstimate", estimate.value, estimate.low, estimate.high)
}

fn rise<'py>(py: Python<'py>, rise: &RiseEstimate) -> Made<'py> {
    make!(
        py,
        "RiseEstimate",
        interval(py, &rise.steady_speed)?,
        interval(py, &rise.constant)?,
        interval(py, &rise.stall_acceleration)?,
        rise.start_speed.as_ref().map(|start| interval(py, start)).transpose()?,
        rise.residual,
    )
}

/// Steady speed, time constant and stall acceleration of a motor from runs of it.
#[pyfunction]
pub(crate) fn fit_transients(a: Arguments<'_>) -> Made<'_> {
    let (times, runs, py) = (a.row("times")?, runs(&a.get("speeds")?, "speeds")?, a.py());
    let settings = FitSettings {
        resamples: a.usize("resamples")?,
        seed: a.u64("seed")?,
        least_duration: a.real("least_duration")?,
        largest_residual: a.real("largest_residual")?,
        from_rest: a.of("from_rest")?,
    };
    let fit = a.run_fit(|observer| {
        let runs: Vec<(&[f64], &[f64])> =
            runs.iter().map(|speeds| (times.as_slice(), speeds.as_slice())).collect();
        TransientFit::of_measured(&runs, &settings, observer)
    })?;
    make!(
        py,
        "TransientFit",
        rise(py, &fit.exponential)?,
        fit.ramp.as_ref().map(|ramp| rise(py, ramp)).transpose()?,
        if fit.form == RiseForm::Ramp { "ramp" } else { "exponential" },
        fit.start_time,
        fit.zero_time(),
        fit.duration,
        fit.points,
        fit.members,
    )
}

/// Times and speeds of a run.
type Run<'py> = (Bound<'py, PyArray1<f64>>, Bound<'py, PyArray1<f64>>);

/// Measured speeds from a file of separated values.
#[pyfunction]
pub(crate) fn read_speeds(a: Arguments<'_>) -> PyResult<Vec<Run<'_>>> {
    fn unit<T: FromStr<Err = UnknownUnit>>(a: &Arguments<'_>, name: &str) -> PyResult<Option<T>> {
        let text: Option<String> = a.of(name)?;
        text.map(|text| text.parse()).transpose().map_err(|error| errors::invalid_text(a.py(), &error))
    }
    let (path, py): (std::path::PathBuf, _) = (a.of("path")?, a.py());
    let columns = CsvColumns {
        time: a.of("time_column")?,
        speed: a.of("speed_column")?,
        time_unit: unit(&a, "time_unit")?,
        speed_unit: unit(&a, "speed_unit")?,
    };
    let read = py.detach(|| MeasuredSpeeds::from_csv_with(&path, &columns));
    let read = read.map_err(|error| errors::of_measured(py, &error))?;
    let arrays = |run: &MeasuredRun| (array(py, run.times.clone()), array(py, run.speeds.clone()));
    Ok(read.runs().iter().map(arrays).collect())
}

/// The parameters that transients may tell.
const PARAMETERS: [FitParameter; 5] = [
    FitParameter::Friction,
    FitParameter::Restitution,
    FitParameter::PhaseLag,
    FitParameter::Amplitude,
    FitParameter::TwistAmplitude,
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

/// The runs of one preload.
fn measured(
    a: &Arguments<'_>,
    given: &Bound<'_, PyAny>,
    speed_error: Option<f64>,
) -> PyResult<MeasuredTransient> {
    let (times, speeds, preload): (Bound<'_, PyAny>, Bound<'_, PyAny>, Real) = given.extract()?;
    let times = row(&times, "times")?;
    let runs = runs(&speeds, "speeds")?.into_iter().zip(0..);
    let runs = runs.map(|(speeds, member)| MeasuredRun { member, times: times.clone(), speeds });
    let runs = MeasuredSpeeds::new(runs.collect()).map_err(|error| a.refused(error))?;
    Ok(MeasuredTransient { preload: RunPreload::Acceleration(preload.0), runs, speed_error })
}

/// Parameters of a motor from its transients.
#[pyfunction]
pub(crate) fn fit_parameters(a: Arguments<'_>) -> Made<'_> {
    let (motor, speed_error, py) = (a.motor()?, a.optional("speed_error")?, a.py());
    let all = a.get("transients")?.try_iter()?.map(|transient| measured(&a, &transient?, speed_error));
    let (all, ranges) = (all.collect::<PyResult<Vec<_>>>()?, ranges(&a.of("ranges")?)?);
    let settings = ParameterFitSettings {
        members: a.usize("members")?,
        windows: a.usize("windows")?,
        relaunch_perturbation: a.real("relaunch_perturbation")?,
        seed: a.u64("seed")?,
        most_evaluations: a.usize("most_evaluations")?,
        resamples: a.usize("resamples")?,
        largest_misfit: a.real("largest_misfit")?,
    };
    let fit = a.run_fit(|observer| ParameterFit::new(&motor, &all, &ranges, &settings, observer))?;
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
    make!(
        py,
        "ParameterFit",
        nominal,
        estimates,
        PyTuple::new(py, undetermined)?,
        shown_motor(py, &fit.motor)?,
        fit.misfit,
        fit.degrees_of_freedom,
        fit.evaluations,
    )
}
