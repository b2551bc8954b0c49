//! Speed transients of motors, and fits of measured ones.

use std::str::FromStr;

use bouncing_disk::estimate::{
    CsvColumns, FitParameter, FitRange, FitSettings, IntervalEstimate, MeasuredRun, MeasuredSpeeds, MotorFit,
    MotorFitSettings, RatedCondition, RatedPoint, RiseEstimate, RiseForm, Spread, TransientEnsemble,
    TransientFit, UnknownUnit,
};
use bouncing_disk::motor::{
    MotorField, MotorParameters, OperatingSettings, SpeedCurve, TransientMember, TransientSettings,
};
use bouncing_disk::parameters::DriveParameters;
use bouncing_disk::{Error, System as SystemModel};
use numpy::PyArray1;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arguments::{Arguments, Made, Place, Real, entries, extracted, runs};
use crate::errors;
use crate::parameters::Motor;
use crate::results::{array, column, make, matrix, room_for};

/// One value has neither deviation nor error.
fn shown_spread<'py>(py: Python<'py>, spread: &Spread, members: usize) -> Made<'py> {
    let of_many = |number: f64| if members > 1 { number } else { f64::NAN };
    make!(py, "Spread", spread.mean, of_many(spread.deviation), of_many(spread.standard_error))
}

/// The transients of one motor from many phases.
#[pyfunction]
pub(crate) fn ensemble(a: Arguments<'_>) -> Made<'_> {
    let (members, py) = (a.usize("members")?, a.py());
    let settings = TransientSettings {
        duration: a.real("duration")?,
        intervals: a.usize("intervals")?,
        relaunch_perturbation: a.real("relaunch_perturbation")?,
        seed: a.u64("seed")?,
        policy: a.policy()?,
    };
    // A transient on a prescribed stator does not depend on the mass.
    let of_system = |system: SystemModel| {
        system.driven_platform(&DriveParameters::default())?;
        MotorParameters::of_system(&system, 1.0).build()
    };
    let motor = match a.held::<Motor>("system") {
        Ok(motor) => motor.get().0.clone(),
        Err(_) => of_system(a.system()?).map_err(|error| a.refused(error))?,
    };
    let system = *motor.system();
    let motor = a.moved(&motor)?;
    let (runs, times, speeds) = a.run(|observer| {
        let members_of_it = TransientMember::of_ensemble(&system, &settings, members)?;
        let curves = motor.transients(&members_of_it, observer)?;
        let runs = TransientEnsemble::of_results(curves.into_iter().map(Ok).collect(), observer)?;
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

/// A rated point from its numbers by name.
fn rated_point(numbers: &Bound<'_, PyAny>, place: &Place<'_>) -> PyResult<RatedPoint> {
    let mut point = RatedPoint { speed: f64::NAN, speed_error: 0.0, conditions: Vec::new() };
    let mut errors = Vec::new();
    for (name, value) in entries(numbers, place)? {
        let Real(value) = extracted(&value, Place::Entry(place, &name))?;
        let field = |name: &str| {
            name.parse::<MotorField>().map_err(|unknown| PyValueError::new_err(format!("points: {unknown}")))
        };
        match (name.as_str(), name.strip_suffix("_error")) {
            ("speed", _) => point.speed = value,
            ("speed_error", _) => point.speed_error = value,
            (_, Some(of)) => errors.push((field(of)?, value)),
            (name, None) => point.conditions.push(RatedCondition { field: field(name)?, value, error: 0.0 }),
        }
    }
    for (field, error) in errors {
        let own = point.conditions.iter_mut().find(|own| own.field == field);
        let missing =
            || PyValueError::new_err(format!("points: the error of {field} needs a value of {field}"));
        own.ok_or_else(missing)?.error = error;
    }
    Ok(point)
}

/// Parameters of a motor from rated points.
#[pyfunction]
pub(crate) fn fit_rated_points(a: Arguments<'_>) -> Made<'_> {
    let (motor, py) = (a.motor()?, a.py());
    let place = Place::Argument("points");
    let points = a.list("points")?.into_iter().enumerate();
    let points = points.map(|(index, point)| rated_point(&point, &Place::Item(&place, index)));
    let points = points.collect::<PyResult<Vec<_>>>()?;
    let mut ranges = Vec::new();
    for (name, [low, high]) in a.ranges()? {
        let parameter = FitParameter::ALL.into_iter().find(|parameter| parameter.name() == name);
        let all = FitParameter::ALL.map(FitParameter::name).join(", ");
        let unknown =
            || PyValueError::new_err(format!("ranges: {name:?} cannot be fitted; choose from {all}"));
        ranges.push(FitRange { parameter: parameter.ok_or_else(unknown)?, low, high });
    }
    let defaults = MotorFitSettings::default();
    let operating = OperatingSettings {
        seed: a.u64("seed")?,
        most_impacts: a.u64("most_impacts")?,
        ..defaults.operating
    };
    let settings = MotorFitSettings { most_evaluations: a.usize("most_evaluations")?, operating, ..defaults };
    let fit = a.run_fit(|observer| MotorFit::new(&motor, &points, &[], &ranges, &settings, observer))?;
    let (accepted, fitted) = (PyDict::new(py), |of: fn(&_) -> f64| column(py, &fit.points, of));
    for own in &fit.parameters {
        let ends: Vec<_> = own.accepted.iter().map(|range| (range.low, range.high)).collect();
        accepted.set_item(own.range.parameter.name(), ends)?;
    }
    make!(
        py,
        "RatedFit",
        accepted,
        fitted(|point| point.fitted),
        fitted(|point| point.standard_error),
        fit.misfit,
        fit.degrees_of_freedom,
        fit.evaluations,
        fit.settled,
        format!("{fit:.3}"),
    )
}

/// Times and speeds of a run.
type Run<'py> = (Bound<'py, PyArray1<f64>>, Bound<'py, PyArray1<f64>>);

/// Measured speeds from a file of separated values.
#[pyfunction]
pub(crate) fn read_speeds(a: Arguments<'_>) -> PyResult<Vec<Run<'_>>> {
    fn unit<T: FromStr<Err = UnknownUnit>>(a: &Arguments<'_>, name: &str) -> PyResult<Option<T>> {
        let text: Option<String> = a.of(name)?;
        let unknown = |error: UnknownUnit| errors::of_text(a.py(), error.to_string(), None);
        text.map(|text| text.parse()).transpose().map_err(unknown)
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
