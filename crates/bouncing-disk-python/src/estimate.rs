//! Speed transients of motors, and what measured ones say: fits of rises, of braking and of parameters.

use std::str::FromStr;

use bouncing_disk::Error;
use bouncing_disk::core::Phase;
use bouncing_disk::estimate::{
    BrakingFit, BrakingRotor, CsvColumns, ExponentialFit, FitParameter, FitRange, FitSettings,
    IntervalEstimate, MeasuredRun, MeasuredSpeeds, MeasuredTransient, ParameterFit, ParameterFitSettings,
    RiseEstimate, RiseForm, RunPreload, Spread, TransientFit, UnknownUnit,
};
use bouncing_disk::motor::{SpeedCurve, TransientMember, TransientSettings};
use numpy::{PyArray1, PyArray2};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyMapping, PyTuple};

use crate::arguments::{Arguments, Count, Made, Numbers, Pair, Real, common_length, held, row, runs};
use crate::errors;
use crate::parameters::{System, shown_motor};
use crate::results::{array, column, make, matrix, room_for};

/// Curves as two matrices, time by member.
struct Matrices {
    shape: [usize; 2],
    times: Vec<f64>,
    speeds: Vec<f64>,
    impacts: Vec<i64>,
    separations: Vec<i64>,
}

impl Matrices {
    /// Those of curves of the same number of points.
    fn of(curves: &[SpeedCurve], points: usize) -> Result<Self, Error> {
        let shape = [points, curves.len()];
        let (mut times, mut speeds) = (room_for(points * curves.len())?, room_for(points * curves.len())?);
        for point in 0..points {
            times.extend(curves.iter().map(|curve| curve.times.get(point).copied().unwrap_or(f64::NAN)));
            speeds.extend(curves.iter().map(|curve| curve.speeds.get(point).copied().unwrap_or(f64::NAN)));
        }
        let impacts = curves.iter().map(|curve| curve.impacts as i64).collect();
        let separations = curves.iter().map(|curve| curve.separations as i64).collect();
        Ok(Self { shape, times, speeds, impacts, separations })
    }

    fn shown(self, py: Python<'_>) -> PyResult<Shown<'_>> {
        let times = matrix(py, self.times, self.shape)?;
        let speeds = matrix(py, self.speeds, self.shape)?;
        Ok((times, speeds, array(py, self.impacts), array(py, self.separations)))
    }
}

/// The same as NumPy has it.
type Shown<'py> = (
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray1<i64>>,
    Bound<'py, PyArray1<i64>>,
);

fn settings(a: &Arguments<'_>, seed: u64) -> PyResult<TransientSettings> {
    Ok(TransientSettings {
        duration: a.real("duration")?,
        intervals: a.usize("intervals")?,
        relaunch_perturbation: a.real("relaunch_perturbation")?,
        seed,
        policy: a.policy()?,
    })
}

/// The speed of one motor from rest.
#[pyfunction]
pub(crate) fn transient(a: Arguments<'_>) -> Made<'_> {
    let (system, settings, phase) = (a.system()?, settings(&a, a.u64("seed")?)?, a.real("phase")?);
    let curve =
        a.run(|observer| bouncing_disk::motor::transient(&system, Phase::new(phase)?, &settings, observer))?;
    let (py, impacts, separations) = (a.py(), curve.impacts, curve.separations);
    make!(py, "SpeedCurve", array(py, curve.times), array(py, curve.speeds), impacts, separations)
}

/// One of some kind, or as many as there are members.
fn each<'py, T>(
    given: &Bound<'py, PyAny>,
    one: impl Fn(&Bound<'py, PyAny>) -> PyResult<T>,
) -> PyResult<(Vec<T>, Option<usize>)> {
    if let Ok(own) = one(given) {
        return Ok((vec![own], None));
    }
    let all = given.try_iter()?.map(|item| one(&item?)).collect::<PyResult<Vec<_>>>()?;
    let count = all.len();
    Ok((all, Some(count)))
}

/// The speeds of many motors from rest.
#[pyfunction]
pub(crate) fn transients(a: Arguments<'_>) -> Made<'_> {
    let py = a.py();
    let system = |item: &Bound<'_, PyAny>| Ok(held::<System>(item, "systems")?.get().0);
    let (systems, many_systems) = each(&a.get("systems")?, system)?;
    let phases = a.given("phases")?.map_or_else(|| Ok(Numbers::one(0.0)), |_| a.numbers("phases"))?;
    let seed = |item: &Bound<'_, PyAny>| item.extract::<Count>()?.u64(py, "seeds");
    let (seeds, many_seeds) =
        a.given("seeds")?.map_or_else(|| Ok((vec![1], None)), |seeds| each(&seeds, seed))?;
    let members =
        common_length(&[("systems", many_systems), ("phases", phases.len()), ("seeds", many_seeds)])?;
    let common = settings(&a, 1)?;
    let matrices = a.run(|observer| {
        let mut all = room_for(members)?;
        for member in 0..members {
            let system = systems[if many_systems.is_some() { member } else { 0 }];
            let seed = seeds[if many_seeds.is_some() { member } else { 0 }];
            let settings = TransientSettings { seed, ..common };
            all.push(TransientMember { system, phase: Phase::new(phases.get(member))?, settings });
        }
        let curves =
            bouncing_disk::motor::transients(&all, observer)?.into_iter().collect::<Result<Vec<_>, _>>()?;
        Matrices::of(&curves, common.intervals)
    })?;
    let (times, speeds, impacts, separations) = matrices.shown(py)?;
    make!(py, "SpeedCurves", times, speeds, impacts, separations)
}

/// A single value has neither deviation nor error.
fn shown_spread<'py>(py: Python<'py>, spread: &Spread, members: usize) -> Made<'py> {
    let of_many = |number: f64| if members > 1 { number } else { f64::NAN };
    make!(py, "Spread", spread.mean, of_many(spread.deviation), of_many(spread.standard_error))
}

/// The transients of one motor from many phases.
#[pyfunction]
pub(crate) fn ensemble(a: Arguments<'_>) -> Made<'_> {
    let (system, members, settings) = (a.system()?, a.usize("members")?, settings(&a, a.u64("seed")?)?);
    let (runs, matrices) = a.run(|observer| {
        let runs = bouncing_disk::estimate::TransientEnsemble::new(&system, &settings, members, observer)?;
        let matrices = Matrices::of(&runs.curves, settings.intervals)?;
        Ok((runs, matrices))
    })?;
    let py = a.py();
    let (times, speeds, impacts, separations) = matrices.shown(py)?;
    make!(
        py,
        "TransientEnsemble",
        times,
        speeds,
        impacts,
        separations,
        column(py, &runs.fits, |fit| fit.steady_speed),
        column(py, &runs.fits, |fit| fit.time_constant),
        column(py, &runs.fits, |fit| fit.residual),
        shown_spread(py, &runs.steady_speed, members)?,
        shown_spread(py, &runs.time_constant, members)?,
        shown_spread(py, &runs.stall_acceleration, members)?,
    )
}

/// The exponential rise that fits a speed curve best.
#[pyfunction]
pub(crate) fn fit_exponential(a: Arguments<'_>) -> Made<'_> {
    let (times, speeds) = (a.row("times")?, a.row("speeds")?);
    let fit = a.run(|observer| ExponentialFit::new(&times, &speeds, observer))?;
    let stall = fit.stall_acceleration();
    make!(a.py(), "ExponentialFit", fit.steady_speed, fit.time_constant, fit.residual, stall)
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

/// The coefficient of friction from the speeds of a rotor that slides on a platform at rest.
#[pyfunction]
pub(crate) fn fit_braking(a: Arguments<'_>) -> Made<'_> {
    let (times, speeds, py) = (a.row("times")?, a.row("speeds")?, a.py());
    let rotor = BrakingRotor {
        normal_force: a.real("normal_force")?,
        mass: a.real("mass")?,
        contact_radius: a.real("contact_radius")?,
        gyration_radius: a.real("gyration_radius")?,
    };
    let fit = py.detach(|| BrakingFit::new(&times, &speeds, &rotor)).map_err(|error| a.refused(error))?;
    make!(
        py,
        "BrakingFit",
        interval(py, &fit.friction)?,
        interval(py, &fit.deceleration)?,
        fit.sliding_until,
        fit.points,
        fit.correlation_time,
        fit.residual,
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
