//! How objects show themselves, and their hashes.

use bouncing_disk::core::numerics::digest::Digest;
use pyo3::PyTypeInfo;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyType};

/// The call that makes an object: `Name(one=1.0, other=2.0)`.
pub(crate) fn call(name: &str, arguments: &Bound<'_, PyDict>) -> PyResult<String> {
    let mut parts = Vec::new();
    for (key, value) in arguments.iter() {
        parts.push(format!("{}={}", key.str()?, value.repr()?));
    }
    Ok(format!("{name}({})", parts.join(", ")))
}

/// A hash of numbers: equal for those that compare equal.
pub(crate) fn hash(numbers: &[f64]) -> u64 {
    let mut digest = Digest::new();
    for number in numbers {
        // Minus zero equals zero.
        digest.number(number + 0.0);
    }
    digest.value()
}

/// The JSON of a dictionary of plain values, by Python's own writer: its doubles are read back with the same bits.
pub(crate) fn to_json(dictionary: &Bound<'_, PyDict>) -> PyResult<String> {
    dictionary.py().import("json")?.call_method1("dumps", (dictionary,))?.extract()
}

/// The dictionary of a text.
pub(crate) fn from_json<'py>(py: Python<'py>, json: &str) -> PyResult<Bound<'py, PyDict>> {
    Ok(py.import("json")?.call_method1("loads", (json,))?.cast_into()?)
}

/// What the library stores, as JSON.
pub(crate) fn stored<T: serde::Serialize>(value: &T) -> PyResult<String> {
    serde_json::to_string(value).map_err(|error| PyValueError::new_err(error.to_string()))
}

/// What the library has stored; its checks are those of a value that is made.
pub(crate) fn restored<T: serde::de::DeserializeOwned>(json: &str) -> PyResult<T> {
    serde_json::from_str(json).map_err(|error| PyValueError::new_err(error.to_string()))
}

/// What pickles an object of a class with `from_json`.
pub(crate) type Reduced<'py> = (Bound<'py, PyAny>, (Bound<'py, PyType>, String));

/// The reduced form of an object of a class with `from_json`.
pub(crate) fn reduced<'py, C: PyTypeInfo>(py: Python<'py>, json: String) -> PyResult<Reduced<'py>> {
    let restore = py.import("bouncing_disk._results")?.getattr("_restored")?;
    Ok((restore, (py.get_type::<C>(), json)))
}
