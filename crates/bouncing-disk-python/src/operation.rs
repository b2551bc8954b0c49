//! Motors under a load: operating points, curves, stall, the best phase lag.

use bouncing_disk::{
    Estimate, InputSpread, InputTolerance, Motor as Model, OperatingPoint, OperatingSettings, Operation,
    Shortfall,
};
use pyo3::prelude::*;
use pyo3::types::PyTuple;

use crate::arguments::{Count, ProgressCallable, row};
use crate::motor::Motor;
use crate::names::{derived, name};
use crate::real::{Real, optional};
use crate::{long_call, results};

/// How many doubles an operation has.
pub(crate) const COLUMNS: usize = 18;

/// The numbers of an operation; NaN where there are none.
pub(crate) struct Numbers {
    pub(crate) values: [f64; COLUMNS],
    pub(crate) impacts: i64,
    pub(crate) status: u8,
    shortfall: String,
}

/// What the library makes of a load torque: by the inertia, and without units.
const LOAD: [&str; 2] = ["load_acceleration", "load"];

const NONE: Estimate = Estimate { value: f64::NAN, standard_error: f64::NAN };

/// Those of a point, in the order of the fields of `OperatingPoint` in `_results.py`.
fn of_point(point: &OperatingPoint) -> [f64; COLUMNS] {
    let efficiency = point.efficiency.unwrap_or(NONE);
    [
        point.load_torque,
        point.speed.value,
        point.speed.standard_error,
        point.mechanical_power.value,
        point.mechanical_power.standard_error,
        point.input_power.value,
        point.input_power.standard_error,
        point.restitution_loss.value,
        point.restitution_loss.standard_error,
        point.friction_loss.value,
        point.friction_loss.standard_error,
        efficiency.value,
        efficiency.standard_error,
        point.perturbation_power,
        point.energy_residual,
        point.averaged_time,
        point.start_up,
        f64::NAN,
    ]
}

fn shortfall(shortfall: &Shortfall) -> String {
    match shortfall {
        Shortfall::Error { standard_error, wanted } => {
            format!("standard error of the speed {standard_error:?} rad/s, asked for {wanted:?} rad/s")
        }
        Shortfall::Drift { drift, standard_error } => {
            format!("the speed drifts by {drift:?} rad/s, with a standard error of {standard_error:?} rad/s")
        }
        Shortfall::PowerBalance { stored_power, input_power } => {
            format!("the disk stores {stored_power:?} W of the {input_power:?} W that are put in")
        }
        _ => "not settled".to_owned(),
    }
}

pub(crate) fn numbers(operation: &Operation) -> Numbers {
    let impacts = |point: &OperatingPoint| i64::try_from(point.impacts).unwrap_or(i64::MAX);
    match operation {
        Operation::Steady(point) => {
            Numbers { values: of_point(point), impacts: impacts(point), status: 0, shortfall: String::new() }
        }
        Operation::Unsettled(point, lack) => Numbers {
            values: of_point(point),
            impacts: impacts(point),
            status: 1,
            shortfall: shortfall(lack),
        },
        Operation::Runaway { load_torque, acceleration, .. } => {
            let mut values = [f64::NAN; COLUMNS];
            (values[0], values[17]) = (*load_torque, *acceleration);
            Numbers { values, impacts: 0, status: 2, shortfall: String::new() }
        }
        _ => Numbers { values: [f64::NAN; COLUMNS], impacts: 0, status: 1, shortfall: "unknown".to_owned() },
    }
}

/// The arguments that all these calls have.
pub(crate) struct Settings {
    pub(crate) relative_error: Real,
    pub(crate) members: Count,
    pub(crate) most_impacts: Count,
    pub(crate) relaunch_perturbation: Real,
    pub(crate) seed: Count,
}

impl Settings {
    pub(crate) fn checked(self, py: Python<'_>) -> PyResult<OperatingSettings> {
        Ok(OperatingSettings {
            relative_error: self.relative_error.0,
            members: self.members.usize(py, "members")?,
            most_impacts: self.most_impacts.u64(py, "most_impacts")?,
            relaunch_perturbation: self.relaunch_perturbation.0,
            seed: self.seed.u64(py, "seed")?,
        })
    }
}

/// How a motor runs under its load.
///
/// Parameters
/// ----------
/// motor : Motor
/// load_torque : float, optional
///     Load torque (N m); by default that of the data sheet.
/// relative_error : float, default 0.01
///     Standard error of the mean speed that is asked for, relative to the speed without load, in [1e-6,
///     0.5].
/// members : int, default 16
///     Vertical motions that are averaged over, in [4, 4096].
/// most_impacts : int, default 20000000
///     Most impacts of all members together, in [1, 1e15].
/// relaunch_perturbation : float, default 0.001
///     Size of the relaunch perturbation in units of g/omega, in (0, 1].
/// seed : int, default 1
///     Seed of the perturbations.
/// progress : callable, optional
///     Called as ``progress(done, total)`` with the number of impacts.
///
/// Returns
/// -------
/// OperatingPoint
#[pyfunction]
#[pyo3(signature = (
    motor, *, load_torque=None, relative_error=Real(0.01), members=Count::Fits(16),
    most_impacts=Count::Fits(20_000_000), relaunch_perturbation=Real(1e-3), seed=Count::Fits(1), progress=ProgressCallable(None)
), text_signature = "(motor, *, load_torque=None, relative_error=0.01, members=16, most_impacts=20000000, relaunch_perturbation=0.001, \
                     seed=1, progress=None)")]
#[expect(clippy::too_many_arguments, reason = "they are keywords")]
pub(crate) fn operating_point<'py>(
    py: Python<'py>,
    motor: &Bound<'py, Motor>,
    load_torque: Option<Real>,
    relative_error: Real,
    members: Count,
    most_impacts: Count,
    relaunch_perturbation: Real,
    seed: Count,
    progress: ProgressCallable,
) -> PyResult<Bound<'py, PyAny>> {
    let settings =
        Settings { relative_error, members, most_impacts, relaunch_perturbation, seed }.checked(py)?;
    let motor = motor.get().0;
    let load = optional(load_torque).unwrap_or_else(|| motor.load_torque());
    // The unit of a load, m g a_e (N m); of its acceleration there is no range to be told.
    let unit = motor.preload_force() * motor.system().disk().contact_radius();
    let names = LOAD.map(|quantity| name(quantity, &["load_torque"]).given(load).unit(unit, "N m"));
    let operation = long_call::run_named(py, progress.0, &names, |observer| {
        motor.operating_point(load, &settings, observer)
    })?;
    let Numbers { values, impacts, status, shortfall } = numbers(&operation);
    let values = PyTuple::new(py, values)?;
    let name = ["steady", "unsettled", "runaway"][usize::from(status)];
    results::make(py, "OperatingPoint", results::joined(py, values, (impacts, name, shortfall))?)
}

/// Speed, power and efficiency of a motor against its load.
///
/// Parameters
/// ----------
/// motor : Motor
/// load_torques : (n,) array_like
///     Load torques (N m) in place of that of the data sheet.
/// relative_error, members, most_impacts, relaunch_perturbation, seed : optional
///     As of :func:`operating_point`.
/// progress : callable, optional
///     Called as ``progress(done, total)`` with the number of impacts.
///
/// Returns
/// -------
/// TorqueSpeedCurve
#[pyfunction]
#[pyo3(signature = (
    motor, *, load_torques, relative_error=Real(0.01), members=Count::Fits(16), most_impacts=Count::Fits(20_000_000),
    relaunch_perturbation=Real(1e-3), seed=Count::Fits(1), progress=ProgressCallable(None)
), text_signature = "(motor, *, load_torques, relative_error=0.01, members=16, most_impacts=20000000, \
                     relaunch_perturbation=0.001, seed=1, progress=None)")]
#[expect(clippy::too_many_arguments, reason = "they are keywords")]
pub(crate) fn torque_speed_curve<'py>(
    py: Python<'py>,
    motor: &Bound<'py, Motor>,
    load_torques: &Bound<'py, PyAny>,
    relative_error: Real,
    members: Count,
    most_impacts: Count,
    relaunch_perturbation: Real,
    seed: Count,
    progress: ProgressCallable,
) -> PyResult<Bound<'py, PyAny>> {
    let settings =
        Settings { relative_error, members, most_impacts, relaunch_perturbation, seed }.checked(py)?;
    let loads = row(load_torques, "load_torques")?;
    let motor = motor.get().0;
    let [load, acceleration] = LOAD.map(|quantity| derived(quantity, &["load_torques", "motor"]));
    let count = name("number of loads", &["load_torques"]).legal("[1, 1000000] torques");
    let names = [load, acceleration, count, name("load_torque", &["load_torques"])];
    let operations = long_call::run_named(py, progress.0, &names, |observer| {
        motor.torque_speed_curve(&loads, &settings, observer)
    })?;
    let all: Vec<_> = operations.iter().map(numbers).collect();
    let columns: Vec<_> = (0..COLUMNS)
        .map(|column| results::array(py, all.iter().map(|one| one.values[column]).collect()))
        .collect();
    let rest = (
        results::array(py, all.iter().map(|one| one.impacts).collect()),
        results::array(py, all.iter().map(|one| one.status).collect()),
    );
    results::make(py, "TorqueSpeedCurve", results::joined(py, PyTuple::new(py, columns)?, rest)?)
}

/// The load at which a motor stops.
///
/// Parameters
/// ----------
/// motor : Motor
/// relative_error, members, most_impacts, relaunch_perturbation, seed : optional
///     As of :func:`operating_point`.
/// progress : callable, optional
///     Called as ``progress(done, total)`` with the number of impacts.
///
/// Returns
/// -------
/// StallLoad
#[pyfunction]
#[pyo3(signature = (
    motor, *, relative_error=Real(0.01), members=Count::Fits(16), most_impacts=Count::Fits(20_000_000),
    relaunch_perturbation=Real(1e-3), seed=Count::Fits(1), progress=ProgressCallable(None)
), text_signature = "(motor, *, relative_error=0.01, members=16, most_impacts=20000000, relaunch_perturbation=0.001, \
                     seed=1, progress=None)")]
#[expect(clippy::too_many_arguments, reason = "they are keywords")]
pub(crate) fn stall_load<'py>(
    py: Python<'py>,
    motor: &Bound<'py, Motor>,
    relative_error: Real,
    members: Count,
    most_impacts: Count,
    relaunch_perturbation: Real,
    seed: Count,
    progress: ProgressCallable,
) -> PyResult<Bound<'py, PyAny>> {
    let settings =
        Settings { relative_error, members, most_impacts, relaunch_perturbation, seed }.checked(py)?;
    let motor: Model = motor.get().0;
    let stall = long_call::run(py, progress.0, |observer| motor.stall_load(&settings, observer))?;
    let fields = (
        stall.torque.value,
        stall.torque.standard_error,
        stall.share,
        (stall.bracket[0], stall.bracket[1]),
        stall.no_load_speed.value,
        stall.no_load_speed.standard_error,
    );
    results::make(py, "StallLoad", fields)
}

/// How far the speeds or the stall load of a motor lie apart over what its inputs are known to.
///
/// The errors of the other calls hold at exactly the inputs given. The response of a motor to preload and amplitude is rough:
/// here stands what a designer can count on.
///
/// Parameters
/// ----------
/// motor : Motor
/// load_torques : (n,) array_like, optional
///     Load torques (N m) of the speeds; by default the stall load is asked for.
/// tolerance : float, default 0.01
///     Relative tolerance of preload and amplitude, in [0, 0.5].
/// perturbation_decades : float, default 1
///     Decades over which the size of the relaunch perturbation is drawn, in [0, 6].
/// draws : int, default 39
///     Motors that are drawn, in [8, 10000].
/// relative_error, members, most_impacts, relaunch_perturbation, seed : optional
///     As of :func:`operating_point`.
/// progress : callable, optional
///     Called as ``progress(done, total)`` with the number of draws.
///
/// Returns
/// -------
/// list of InputSpread or None
///     One for each load, or that of the stall load alone; None where fewer than four draws have a speed.
#[pyfunction]
#[pyo3(signature = (
    motor, *, load_torques=None, tolerance=Real(0.01), perturbation_decades=Real(1.0), draws=Count::Fits(39),
    relative_error=Real(0.01), members=Count::Fits(16), most_impacts=Count::Fits(20_000_000),
    relaunch_perturbation=Real(1e-3), seed=Count::Fits(1), progress=ProgressCallable(None)
), text_signature = "(motor, *, load_torques=None, tolerance=0.01, perturbation_decades=1.0, draws=39, relative_error=0.01, \
                     members=16, most_impacts=20000000, relaunch_perturbation=0.001, seed=1, progress=None)")]
#[expect(clippy::too_many_arguments, reason = "they are keywords")]
pub(crate) fn input_spreads<'py>(
    py: Python<'py>,
    motor: &Bound<'py, Motor>,
    load_torques: Option<&Bound<'py, PyAny>>,
    tolerance: Real,
    perturbation_decades: Real,
    draws: Count,
    relative_error: Real,
    members: Count,
    most_impacts: Count,
    relaunch_perturbation: Real,
    seed: Count,
    progress: ProgressCallable,
) -> PyResult<Vec<Option<Bound<'py, PyAny>>>> {
    let settings =
        Settings { relative_error, members, most_impacts, relaunch_perturbation, seed }.checked(py)?;
    let (preload, amplitude, draws) = (tolerance.0, tolerance.0, draws.usize(py, "draws")?);
    let tolerance =
        InputTolerance { preload, amplitude, perturbation_decades: perturbation_decades.0, draws };
    let loads = load_torques.map(|loads| row(loads, "load_torques")).transpose()?;
    let motor: Model = motor.get().0;
    let names = [
        name("tolerance of the preload", &["tolerance"]),
        name("number of loads", &["load_torques"]).legal("[1, 1000000] torques"),
        name("load_torque", &["load_torques"]),
        derived("load_acceleration", &["load_torques"]),
    ];
    let spreads = long_call::run_named(py, progress.0, &names, |observer| match &loads {
        Some(loads) => motor.speed_spreads(loads, &settings, &tolerance, observer),
        None => Ok(vec![motor.stall_spread(&settings, &tolerance, observer)?]),
    })?;
    let class = |spread: InputSpread| {
        let InputSpread {
            mean,
            standard_deviation,
            from_to: [low, high],
            draws,
            without,
            unsettled,
            trapped,
            ..
        } = spread;
        let fields = (
            (mean.value, mean.standard_error, standard_deviation.value, standard_deviation.standard_error),
            ((low, high), draws, without, unsettled, trapped),
        );
        results::make(py, "InputSpread", results::joined(py, fields.0, fields.1)?)
    };
    spreads.into_iter().map(|spread| spread.map(class).transpose()).collect()
}

/// The phase lag at which a motor turns fastest.
///
/// Parameters
/// ----------
/// motor : Motor
/// relative_error, members, most_impacts, relaunch_perturbation, seed : optional
///     As of :func:`operating_point`.
/// progress : callable, optional
///     Called as ``progress(done, total)`` with the number of impacts.
///
/// Returns
/// -------
/// BestPhaseLag
#[pyfunction]
#[pyo3(signature = (
    motor, *, relative_error=Real(0.01), members=Count::Fits(16), most_impacts=Count::Fits(20_000_000),
    relaunch_perturbation=Real(1e-3), seed=Count::Fits(1), progress=ProgressCallable(None)
), text_signature = "(motor, *, relative_error=0.01, members=16, most_impacts=20000000, relaunch_perturbation=0.001, \
                     seed=1, progress=None)")]
#[expect(clippy::too_many_arguments, reason = "they are keywords")]
pub(crate) fn best_phase_lag<'py>(
    py: Python<'py>,
    motor: &Bound<'py, Motor>,
    relative_error: Real,
    members: Count,
    most_impacts: Count,
    relaunch_perturbation: Real,
    seed: Count,
    progress: ProgressCallable,
) -> PyResult<Bound<'py, PyAny>> {
    let settings =
        Settings { relative_error, members, most_impacts, relaunch_perturbation, seed }.checked(py)?;
    let motor: Model = motor.get().0;
    let best = long_call::run(py, progress.0, |observer| motor.best_phase_lag(&settings, observer))?;
    let fields = (
        best.phase_lag.value,
        best.phase_lag.standard_error,
        best.speed.value,
        best.speed.standard_error,
        (best.good_from_to[0], best.good_from_to[1]),
    );
    results::make(py, "BestPhaseLag", fields)
}
