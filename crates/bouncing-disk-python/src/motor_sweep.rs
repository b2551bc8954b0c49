//! A motor in steady operation over one or two of its parameters.

use bouncing_disk::{MotorField, MotorSweep, SweepAxis};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyMapping, PyTuple};

use crate::arguments::{Count, ProgressCallable, row};
use crate::motor::Motor;
use crate::names::name;
use crate::operation::{COLUMNS, Settings, numbers};
use crate::real::Real;
use crate::system_names::OF_MOTOR;
use crate::{errors, long_call, results};

/// The axes of a mapping, in its order.
fn axes(given: &Bound<'_, PyMapping>) -> PyResult<Vec<SweepAxis>> {
    let mut axes = Vec::new();
    for item in given.items()? {
        let (name, values): (String, Bound<'_, PyAny>) = item.extract()?;
        let parameter: MotorField =
            name.parse().map_err(|unknown| PyValueError::new_err(format!("axes: {unknown}")))?;
        axes.push(SweepAxis::new(parameter, row(&values, &name)?));
    }
    Ok(axes)
}

/// Speed, power and efficiency of a motor over one or two parameters of its data sheet.
///
/// Cells that share a vertical motion are computed on one orbit. A parameter takes the place of its alternative: a
/// sweep over ``preload_force`` of a motor with a ``preload_acceleration`` has the force alone.
///
/// Parameters
/// ----------
/// motor : Motor
/// axes : mapping of str to (n,) array_like
///     One or two arguments of :class:`Motor` with their values (SI); the first axis is that of the rows.
/// relative_error, members, most_impacts, relaunch_perturbation, seed : optional
///     As of :func:`operating_point`, for each cell.
/// progress : callable, optional
///     Called as ``progress(done, total)`` with the number of cells.
///
/// Returns
/// -------
/// MotorMap
///
/// Examples
/// --------
/// >>> import bouncing_disk as bd
/// >>> motor = bd.Motor(drive_frequency=70e3, amplitude=1e-8, peak_angular_speed=30.0, mass=1e-3,
/// ...     contact_radius=1.25e-3, gyration_radius=6.3e-3, preload_acceleration=9.8, friction=0.1, restitution=0.5)
/// >>> axes = {"friction": [0.1, 0.2], "load_torque": [0.0, 0.5 * motor.largest_torque, 1.5 * motor.largest_torque]}
/// >>> found = bd.motor_map(motor, axes=axes, relative_error=0.05)
/// >>> found.speed.shape, found.names()[0]
/// ((2, 3), ['steady', 'steady', 'runaway'])
#[pyfunction]
#[pyo3(signature = (
    motor, *, axes, relative_error=Real(0.01), members=Count::Fits(16), most_impacts=Count::Fits(20_000_000),
    relaunch_perturbation=Real(1e-3), seed=Count::Fits(1), progress=ProgressCallable(None)
), text_signature = "(motor, *, axes, relative_error=0.01, members=16, most_impacts=20000000, \
                     relaunch_perturbation=0.001, seed=1, progress=None)")]
#[expect(clippy::too_many_arguments, reason = "they are keywords")]
pub(crate) fn motor_map<'py>(
    py: Python<'py>,
    motor: &Bound<'py, Motor>,
    axes: &Bound<'py, PyMapping>,
    relative_error: Real,
    members: Count,
    most_impacts: Count,
    relaunch_perturbation: Real,
    seed: Count,
    progress: ProgressCallable,
) -> PyResult<Bound<'py, PyAny>> {
    let settings =
        Settings { relative_error, members, most_impacts, relaunch_perturbation, seed }.checked(py)?;
    let given = self::axes(axes)?;
    let shape = PyTuple::new(py, given.iter().map(|axis| axis.values.len()))?;
    let values = PyDict::new(py);
    for axis in &given {
        values.set_item(axis.parameter.name(), results::array(py, axis.values.clone()))?;
    }
    let mut names = vec![name("number of axes of a sweep", &["axes"]).legal("1 or 2 axes")];
    names.extend(MotorField::ALL.map(|field| name(field.name(), &["axes"])));
    names.extend(OF_MOTOR.map(|quantity| quantity.of_values_in(&["axes"])));
    let sweep = MotorSweep::new(motor.get().0, given, settings)
        .map_err(|error| errors::of_named(py, error, &names))?;
    let found = long_call::run_named(py, progress.0, &names, |observer| sweep.run(observer))?;
    let all: Vec<_> = found.cells().iter().map(numbers).collect();
    let shaped = |column: Bound<'py, PyAny>| column.call_method1("reshape", (&shape,));
    let mut fields = Vec::new();
    for column in 0..COLUMNS {
        let numbers = all.iter().map(|one| one.values[column]).collect::<Vec<f64>>();
        fields.push(shaped(results::array(py, numbers).into_any())?);
    }
    fields.push(shaped(results::array(py, all.iter().map(|one| one.impacts).collect()).into_any())?);
    fields.push(shaped(results::array(py, all.iter().map(|one| one.status).collect()).into_any())?);
    fields.extend([motor.clone().into_any(), values.into_any()]);
    results::make(py, "MotorMap", PyTuple::new(py, fields)?)
}
