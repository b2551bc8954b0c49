//! A system as a dictionary of two, its platform and its disk: as the library stores it.

use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

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

/// The arguments of the constructor in a dictionary of two.
pub(crate) fn arguments<'py>(parameters: &Bound<'py, PyDict>) -> PyResult<Bound<'py, PyDict>> {
    let arguments = PyDict::new(parameters.py());
    for (key, part) in parameters.iter() {
        let key: String = key.extract()?;
        let known: &[&str] = match key.as_str() {
            "platform" => &PLATFORM,
            "disk" => &DISK,
            _ => return Err(unknown_key(&key)),
        };
        for (name, value) in part.cast::<PyDict>()?.iter() {
            let name: String = name.extract()?;
            if !known.contains(&name.as_str()) {
                return Err(unknown_key(&format!("{key}.{name}")));
            }
            arguments.set_item(name, value)?;
        }
    }
    Ok(arguments)
}

fn unknown_key(key: &str) -> PyErr {
    PyTypeError::new_err(format!("the key {key:?} is unknown"))
}
