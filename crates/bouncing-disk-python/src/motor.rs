//! Motors: data sheets, operating points, stall, sweeps, traps and sensitivities.

use bouncing_disk::motor::{
    AxialMotion, BestSearch, Estimate, InputSpread, InputTolerance, Life, MotorField, MotorRegime,
    MotorSweep, OperatingPoint, OperatingRow, OperatingSettings, Operation, SearchRange, SensitivityMethod,
    SensitivityParameter, SensitivityQuantity, SensitivitySettings, Shortfall, StallLoad, SweepAxis,
    SweepQuantity, TrapVerdict, UnknownMotorField,
};
use numpy::PyArray1;
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyString, PyTuple};

use crate::arguments::{Arguments, Made, row};
use crate::parameters::Motor;
use crate::results::{column, made, make, signed};

/// The report of a data sheet before anything turns.
#[pyfunction]
pub(crate) fn report(a: Arguments<'_>) -> Made<'_> {
    let (motor, none) = (a.held::<Motor>("self")?.get().0.clone(), f64::NAN);
    let report = a.run(|observer| motor.report(observer))?;
    let (name, impacts, platform_periods, rests, exponent) = match &report.regime {
        MotorRegime::NoLiftOff => ("no-lift-off", 0, none, 0, none),
        MotorRegime::Periodic { impacts, platform_periods } => {
            ("periodic", *impacts as u64, *platform_periods as f64, 0, none)
        }
        MotorRegime::LowPeriodChattering(cycle) => {
            ("low-period-chattering", cycle.impacts as u64, cycle.platform_periods as f64, 0, none)
        }
        MotorRegime::LongChattering { platform_periods, rests } => {
            ("long-chattering", 0, *platform_periods, *rests, none)
        }
        MotorRegime::Chaotic { lyapunov_exponent } => ("chaotic", 0, none, 0, *lyapunov_exponent),
        MotorRegime::Undecided { impacts } => ("undecided", *impacts as u64, none, 0, none),
        _ => ("unknown", 0, none, 0, none),
    };
    make!(
        a.py(),
        "MotorReport",
        report.axial_forcing,
        report.angular_forcing,
        report.peak_acceleration,
        name,
        impacts,
        platform_periods,
        rests,
        exponent,
        report.periods_per_flight,
        report.largest_torque,
        report.static_deflection,
        report.preload_change_bound,
        PyTuple::new(a.py(), motor.warnings().iter().map(ToString::to_string))?,
        report.to_string(),
    )
}

/// What follows from the stator of a data sheet, by name.
#[pyfunction]
pub(crate) fn stator_report(a: Arguments<'_>) -> PyResult<Option<Bound<'_, PyDict>>> {
    let Some(report) = a.held::<Motor>("self")?.get().0.stator_report() else { return Ok(None) };
    let rows = PyDict::new(a.py());
    report.rows().try_for_each(|(name, value, _)| rows.set_item(name, value))?;
    Ok(Some(rows))
}

/// The index into `OperatingPoints.STATUSES` of a missing branch.
const NO_BRANCH: u8 = 4;

/// Number of doubles of an operation.
const COLUMNS: usize = 7 + 2 * SweepQuantity::WITH_STATOR.len();

/// The numbers of an operation in the order of the fields of `OperatingPoints`, NaN if missing; its impacts, and
/// the index into `OperatingPoints.STATUSES`.
type Numbers = ([f64; COLUMNS], i64, u8);

fn of_point(operation: &Operation, point: &OperatingPoint) -> [f64; COLUMNS] {
    let none = Estimate { value: f64::NAN, standard_error: f64::NAN };
    let mut values = [f64::NAN; COLUMNS];
    values[0] = point.load_torque;
    for (index, quantity) in SweepQuantity::WITH_STATOR.into_iter().enumerate() {
        let estimate = quantity.of(operation).unwrap_or(none);
        (values[1 + 2 * index], values[2 + 2 * index]) = (estimate.value, estimate.standard_error);
    }
    let power = point.perturbation_power;
    let rest = [point.load_torque_error, power, point.energy_residual, point.averaged_time, point.start_up];
    values[COLUMNS - 6..COLUMNS - 1].copy_from_slice(&rest);
    values
}

fn numbers(operation: &Operation) -> Numbers {
    let nothing = [f64::NAN; COLUMNS];
    match operation {
        Operation::Steady(point) => (of_point(operation, point), signed(point.impacts), 0),
        Operation::Unsettled(point, Shortfall::Start { .. }) => {
            (of_point(operation, point), signed(point.impacts), 3)
        }
        Operation::Unsettled(point, _) => (of_point(operation, point), signed(point.impacts), 1),
        Operation::Runaway { load_torque, acceleration, .. } => {
            let mut values = nothing;
            (values[0], values[COLUMNS - 1]) = (*load_torque, *acceleration);
            (values, 0, 2)
        }
        _ => (nothing, 0, 1),
    }
}

/// `OperatingPoints.MOTIONS`.
const MOTIONS: [&str; 4] = ["none", "irregular", "periodic", "contact"];

/// The index into `MOTIONS` and the mean lifetime (s) of an operation, if known.
fn motion_of(operation: Option<&Operation>) -> (u8, f64) {
    named(operation.and_then(Operation::point).map(|point| point.motion))
}

fn named(motion: Option<AxialMotion>) -> (u8, f64) {
    match motion {
        Some(AxialMotion::Irregular { life: Life::Mean(life) }) => (1, life.value),
        Some(AxialMotion::Irregular { .. }) => (1, f64::NAN),
        Some(AxialMotion::Periodic { .. }) => (2, f64::NAN),
        Some(AxialMotion::Contact) => (3, f64::NAN),
        _ => (0, f64::NAN),
    }
}

/// The columns of the operations under many loads; the last field holds the further branches.
fn columns<'py>(
    py: Python<'py>,
    rows: &[OperatingRow],
    shape: Option<&Bound<'py, PyTuple>>,
) -> PyResult<Vec<Bound<'py, PyAny>>> {
    let most = rows.iter().map(|row| row.branches.len()).max().unwrap_or(0);
    let others = (1..most).map(|branch| {
        let mut fields = columns_of(py, rows, branch, shape)?;
        fields.push(PyTuple::empty(py).into_any());
        made(py, "OperatingPoints", fields)
    });
    let others = PyTuple::new(py, others.collect::<PyResult<Vec<_>>>()?)?;
    let mut fields = columns_of(py, rows, 0, shape)?;
    fields.push(others.into_any());
    Ok(fields)
}

/// The columns of a branch, NaN where a row has no such branch.
fn columns_of<'py>(
    py: Python<'py>,
    rows: &[OperatingRow],
    branch: usize,
    shape: Option<&Bound<'py, PyTuple>>,
) -> PyResult<Vec<Bound<'py, PyAny>>> {
    let operations: Vec<_> = rows.iter().map(|row| row.branches.get(branch)).collect();
    let nothing = ([f64::NAN; COLUMNS], 0, NO_BRANCH);
    let all: Vec<_> = operations.iter().map(|operation| operation.map_or(nothing, numbers)).collect();
    let doubles = (0..COLUMNS).map(|index| column(py, &all, |(values, ..)| values[index]).into_any());
    let mut fields: Vec<_> = doubles.collect();
    fields.push(column(py, &all, |(_, impacts, _)| *impacts).into_any());
    fields.push(column(py, &all, |(.., status)| *status).into_any());
    let motions: Vec<_> = operations.into_iter().map(motion_of).collect();
    fields.push(column(py, &motions, |(motion, _)| *motion).into_any());
    fields.push(column(py, &motions, |(_, life)| *life).into_any());
    let shaped = |field: Bound<'py, PyAny>| match shape {
        Some(shape) => field.call_method1("reshape", (shape,)),
        None => Ok(field),
    };
    fields.into_iter().map(shaped).collect()
}

/// The settings of a call that runs a motor.
fn settings(a: &Arguments<'_>) -> PyResult<OperatingSettings> {
    a.take_settings("OperatingSettings")?;
    Ok(OperatingSettings {
        relative_error: a.real("relative_error")?,
        members: a.usize("members")?,
        most_impacts: a.u64("most_impacts")?,
        relaunch_perturbation: a.real("relaunch_perturbation")?,
        seed: a.u64("seed")?,
    })
}

/// Speed, power and efficiency of a motor against its load.
#[pyfunction]
pub(crate) fn torque_speed_curve(a: Arguments<'_>) -> Made<'_> {
    let (motor, settings) = (a.motor()?, settings(&a)?);
    let motor = a.moved(&motor)?;
    let loads = match a.given("load_torques")? {
        Some(loads) => row(&loads, "load_torques")?,
        // As on the command line: a load law already contains a torque.
        None if motor.load().is_some() => vec![0.0],
        None => (0..=10).map(|tenths| 0.1 * f64::from(tenths) * motor.largest_torque()).collect(),
    };
    let rows = a.run(|observer| motor.torque_speed_curve(&loads, &settings, observer))?;
    made(a.py(), "TorqueSpeedCurve", columns(a.py(), &rows, None)?)
}

/// The load at which a motor stops.
#[pyfunction]
pub(crate) fn stall_load(a: Arguments<'_>) -> Made<'_> {
    let (motor, settings) = (a.motor()?, settings(&a)?);
    let motor = a.moved(&motor)?;
    let stall = a.run(|observer| motor.stall_load(&settings, observer))?;
    shown_stall(a.py(), &stall)
}

fn shown_stall<'py>(py: Python<'py>, stall: &StallLoad) -> Made<'py> {
    let others = stall.others.iter().map(|other| shown_stall(py, other)).collect::<PyResult<Vec<_>>>()?;
    let nothing = Estimate { value: f64::NAN, standard_error: f64::NAN };
    let blocked = stall.blocked_torque.unwrap_or(nothing);
    let (motion, life) = named(Some(stall.motion));
    make!(
        py,
        "StallLoad",
        stall.torque.value,
        stall.torque.standard_error,
        stall.share,
        (stall.bracket[0], stall.bracket[1]),
        stall.no_load_speed.value,
        stall.no_load_speed.standard_error,
        blocked.value,
        blocked.standard_error,
        MOTIONS[usize::from(motion)],
        life,
        PyTuple::new(py, others)?,
    )
}

fn shown_spread<'py>(py: Python<'py>, spread: &InputSpread) -> Made<'py> {
    make!(
        py,
        "InputSpread",
        spread.mean.value,
        spread.mean.standard_error,
        spread.standard_deviation.value,
        spread.standard_deviation.standard_error,
        (spread.from_to[0], spread.from_to[1]),
        spread.draws,
        spread.without,
        spread.unsettled,
        spread.trapped,
    )
}

/// The spread of a motor's speed or stall load over the tolerances of its inputs.
#[pyfunction]
pub(crate) fn input_spreads(a: Arguments<'_>) -> PyResult<Vec<Option<Bound<'_, PyAny>>>> {
    let (motor, settings, tolerance) = (a.motor()?, settings(&a)?, a.real("tolerance")?);
    let tolerance = InputTolerance {
        preload: tolerance,
        amplitude: tolerance,
        perturbation_decades: a.real("perturbation_decades")?,
        draws: a.usize("draws")?,
    };
    let loads = a.given("load_torques")?.map(|loads| row(&loads, "load_torques")).transpose()?;
    let spreads = a.run(|observer| match &loads {
        Some(loads) => motor.speed_spreads(loads, &settings, &tolerance, observer),
        None => Ok(vec![motor.stall_spread(&settings, &tolerance, observer)?]),
    })?;
    spreads
        .iter()
        .map(|spread| spread.as_ref().map(|spread| shown_spread(a.py(), spread)).transpose())
        .collect()
}

/// The best of a quantity over one or two fields of the data sheet.
#[pyfunction]
pub(crate) fn best(a: Arguments<'_>) -> Made<'_> {
    let (motor, settings, py) = (a.motor()?, settings(&a)?, a.py());
    let refused = |name: &str, why: String| PyValueError::new_err(format!("{name}: {why}"));
    let mut ranges = Vec::new();
    for (name, given) in a.entries("over")? {
        let field =
            name.parse().map_err(|unknown: UnknownMotorField| refused("over", unknown.to_string()))?;
        let ends = row(&given, &name)?;
        let &[low, high] = &ends[..] else {
            return Err(refused("over", format!("{name} has {} ends, but needs two", ends.len())));
        };
        ranges.push(SearchRange { field, low, high });
    }
    let objective = a.of::<String>("of")?.parse().map_err(|why| refused("of", why))?;
    let bounds = a.of::<Vec<String>>("where")?;
    let bounds = bounds.iter().map(|bound| bound.parse().map_err(|why| refused("where", why)));
    let sought = BestSearch { objective, ranges, bounds: bounds.collect::<PyResult<_>>()? };
    let best = a.run(|observer| motor.best(&sought, &settings, observer))?;
    let [values, errors, good] = [(); 3].map(|()| PyDict::new(py));
    for own in &best.values {
        let name = own.field.name();
        values.set_item(name, own.value.value)?;
        errors.set_item(name, own.value.standard_error)?;
        good.set_item(name, own.good_from_to.map(|[low, high]| (low, high)))?;
    }
    let at_end: Vec<&str> =
        best.values.iter().filter(|own| own.is_at_end).map(|own| own.field.name()).collect();
    let bounds: Vec<(f64, f64)> = best.bounds.iter().map(|own| (own.value, own.standard_error)).collect();
    make!(
        py,
        "Best",
        objective.name(),
        best.value.value,
        best.value.standard_error,
        values,
        errors,
        good,
        at_end,
        bounds,
        best.row.branches.len(),
    )
}

/// A motor in steady operation over one or two of its parameters.
#[pyfunction]
pub(crate) fn motor_map(a: Arguments<'_>) -> Made<'_> {
    let (motor, settings, py) = (a.motor()?, settings(&a)?, a.py());
    let (mut axes, values) = (Vec::new(), PyDict::new(py));
    for (name, given) in a.entries("over")? {
        let parameter: MotorField =
            name.parse().map_err(|unknown| PyValueError::new_err(format!("over: {unknown}")))?;
        let axis = SweepAxis::new(parameter, row(&given, &name)?);
        values.set_item(parameter.name(), column(py, &axis.values, |value| *value))?;
        axes.push(axis);
    }
    let shape = PyTuple::new(py, axes.iter().map(|axis| axis.values.len()))?;
    let continued: bool = a.of("continued")?;
    let sweep = MotorSweep::new(motor, axes, settings);
    let sweep = sweep.and_then(|sweep| if continued { sweep.continued() } else { Ok(sweep) });
    let sweep = sweep.map_err(|error| a.refused(error))?;
    let found = a.run(|observer| sweep.run(observer))?;
    let mut fields = columns(py, found.cells(), Some(&shape))?;
    fields.extend([a.get("motor")?, values.into_any()]);
    made(py, "MotorMap", fields)
}

/// The numbers of the cycle without perturbation: impacts, periods of the stator, long flights; 0 where there
/// is none.
fn round(verdict: &TrapVerdict) -> [i64; 3] {
    verdict.cycle.map_or([0; 3], |cycle| {
        [cycle.impacts as i64, cycle.platform_periods as i64, cycle.long_flights as i64]
    })
}

/// Which preloads trap a motor in a short cycle of flights and rest.
#[pyfunction]
pub(crate) fn low_period_traps(a: Arguments<'_>) -> Made<'_> {
    let (motor, preloads, py) = (a.motor()?, a.row("preload_accelerations")?, a.py());
    let found = a.run(|observer| bouncing_disk::motor::low_period_traps(&motor, &preloads, observer))?;
    make!(
        py,
        "LowPeriodTraps",
        column(py, &found, |one| one.preload_acceleration),
        column(py, &found, |one| one.axial_forcing),
        column(py, &found, |one| one.is_trap),
        column(py, &found, |one| round(one)[0]),
        column(py, &found, |one| round(one)[1]),
        column(py, &found, |one| round(one)[2]),
        column(py, &found, |one| i64::from(one.relaunches)),
        column(py, &found, |one| i64::from(one.returns)),
        column(py, &found, |one| one.mean_platform_periods.unwrap_or(f64::NAN)),
    )
}

/// The low-period trap that is nearest to a motor.
#[pyfunction]
pub(crate) fn nearest_trap(a: Arguments<'_>) -> PyResult<Option<Bound<'_, PyAny>>> {
    let (motor, range) = (a.motor()?, a.real("relative_range")?);
    let found = a.run(|observer| motor.nearest_trap(range, observer))?;
    let Some(trap) = found else { return Ok(None) };
    let [impacts, periods, flights] = round(&trap.verdict);
    let made = make!(
        a.py(),
        "NearestTrap",
        trap.relative_distance,
        trap.preload_acceleration,
        trap.amplitude,
        trap.drive_frequency,
        (trap.forcing_from_to[0], trap.forcing_from_to[1]),
        trap.forcing_step,
        impacts,
        periods,
        flights,
        trap.verdict.return_share(),
    );
    made.map(Some)
}

fn quantity(a: &Arguments<'_>) -> PyResult<SensitivityQuantity> {
    let quantities = [
        ("steady-speed", SensitivityQuantity::SteadySpeed),
        ("stall-torque", SensitivityQuantity::StallTorque),
    ];
    a.choice("quantity", &quantities)
}

/// The parameter of a name.
fn parameter(name: &str) -> PyResult<SensitivityParameter> {
    SensitivityParameter::ALL.into_iter().find(|parameter| parameter.name() == name).ok_or_else(|| {
        let known: Vec<_> = SensitivityParameter::ALL.iter().map(|parameter| parameter.name()).collect();
        PyValueError::new_err(format!("the parameter {name:?} is unknown; there are {}", known.join(", ")))
    })
}

/// The parameters of the argument `parameters`; by default those that share one vertical motion.
fn parameters(a: &Arguments<'_>) -> PyResult<Vec<SensitivityParameter>> {
    let Some(names) = a.given("parameters")? else {
        let all = SensitivityParameter::ALL.into_iter();
        return Ok(all.filter(|parameter| parameter.shares_vertical_motion()).collect());
    };
    if names.is_instance_of::<PyString>() {
        return Err(PyTypeError::new_err("parameters must be a list of names, not one text"));
    }
    names.try_iter()?.map(|one| parameter(&one?.extract::<String>()?)).collect()
}

/// Values with their errors, as two arrays.
type Estimates<'py> = [Bound<'py, PyArray1<f64>>; 2];

fn estimates<'py, T>(py: Python<'py>, all: &[T], of: fn(&T) -> Estimate) -> Estimates<'py> {
    [column(py, all, |one| of(one).value), column(py, all, |one| of(one).standard_error)]
}

/// The sensitivities of a motor to its parameters near its data sheet.
#[pyfunction]
pub(crate) fn local_sensitivities(a: Arguments<'_>) -> Made<'_> {
    let (motor, operating, py) = (a.motor()?, settings(&a)?, a.py());
    let (half_range, points) = (a.real("half_range")?, a.usize("points")?);
    let settings = SensitivitySettings { operating, half_range, points };
    let (chosen, asked) = (parameters(&a)?, quantity(&a)?);
    let found = a.run(|observer| motor.local_sensitivities(asked, &chosen, &settings, observer))?;
    let [derivative, error] = estimates(py, &found, |one| one.derivative);
    let methods = found.iter().map(|one| match one.method {
        SensitivityMethod::SharedMotion { .. } => "shared-motion",
        SensitivityMethod::Regression { .. } => "regression",
        _ => "unknown",
    });
    let traps = column(py, &found, |one| match one.method {
        SensitivityMethod::Regression { traps, .. } => traps as i64,
        _ => 0,
    });
    make!(
        py,
        "LocalSensitivities",
        PyTuple::new(py, found.iter().map(|one| one.parameter.name()))?,
        derivative,
        error,
        PyTuple::new(py, methods)?,
        traps,
        a.get("quantity")?,
    )
}
