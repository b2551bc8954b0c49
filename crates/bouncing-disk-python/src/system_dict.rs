//! A system as a dictionary of two, its platform and its disk: as the library stores it.

use bouncing_disk::{DiskParameters, PlatformParameters};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::real::Real;

/// The names of the arguments that are about the platform.
pub(crate) const PLATFORM: [&str; 4] = ["amplitude", "twist_amplitude", "angular_frequency", "phase_lag"];
/// Those of the disk.
pub(crate) const DISK: [&str; 6] = [
    "contact_radius",
    "gyration_radius",
    "friction",
    "restitution",
    "preload_acceleration",
    "load_acceleration",
];

/// The dictionary of these numbers, those of the platform first.
pub(crate) fn to(py: Python<'_>, numbers: [f64; 10]) -> PyResult<Bound<'_, PyDict>> {
    let (all, platform, disk) = (PyDict::new(py), PyDict::new(py), PyDict::new(py));
    for (name, value) in PLATFORM.iter().zip(numbers) {
        platform.set_item(name, value)?;
    }
    for (name, value) in DISK.iter().zip(&numbers[PLATFORM.len()..]) {
        disk.set_item(name, value)?;
    }
    all.set_item("platform", platform)?;
    all.set_item("disk", disk)?;
    Ok(all)
}

/// A system as it is stored.
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct SystemParts {
    pub(crate) platform: PlatformParameters,
    pub(crate) disk: DiskParameters,
}

/// The numbers of a part, in the order of `known`; those with a default may be missing.
fn numbers<const N: usize>(
    all: &Bound<'_, PyDict>,
    part: &str,
    known: [&str; N],
    default: &str,
) -> PyResult<[f64; N]> {
    let Some(given) = all.get_item(part)? else {
        return Err(PyTypeError::new_err(format!("the key {part:?} is missing")));
    };
    let given = given.cast::<PyDict>()?;
    for key in given.keys() {
        if !known.iter().any(|name| key.eq(*name).unwrap_or(false)) {
            return Err(PyTypeError::new_err(format!("the key {part}.{key} is unknown")));
        }
    }
    let mut numbers = [0.0; N];
    for (name, number) in known.iter().zip(&mut numbers) {
        match given.get_item(name)? {
            Some(value) => {
                let told = |error: PyErr| {
                    let text = format!("{part}.{name}: {}", error.value(all.py()));
                    if error.is_instance_of::<PyTypeError>(all.py()) {
                        PyTypeError::new_err(text)
                    } else {
                        error
                    }
                };
                *number = value.extract::<Real>().map_err(told)?.0;
            }
            None if *name == default => {}
            None => return Err(PyTypeError::new_err(format!("the key {part}.{name} is missing"))),
        }
    }
    Ok(numbers)
}

/// The parts of a system in a dictionary of two.
pub(crate) fn parts(parameters: &Bound<'_, PyDict>) -> PyResult<SystemParts> {
    for key in parameters.keys() {
        if !["platform", "disk"].iter().any(|part| key.eq(*part).unwrap_or(false)) {
            return Err(PyTypeError::new_err(format!("the key {} is unknown", key.repr()?)));
        }
    }
    let [amplitude, twist_amplitude, angular_frequency, phase_lag] =
        numbers(parameters, "platform", PLATFORM, "phase_lag")?;
    let [contact_radius, gyration_radius, friction, restitution, preload_acceleration, load_acceleration] =
        numbers(parameters, "disk", DISK, "load_acceleration")?;
    Ok(SystemParts {
        platform: PlatformParameters { amplitude, twist_amplitude, angular_frequency, phase_lag },
        disk: DiskParameters {
            contact_radius,
            gyration_radius,
            friction,
            restitution,
            preload_acceleration,
            load_acceleration,
        },
    })
}
