//! How objects show themselves, and their hashes.

use bouncing_disk::core::numerics::digest::Digest;
use pyo3::PyTypeInfo;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyString, PyType};

use crate::errors;

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

/// The JSON of a dictionary of plain values, by Python's own writer: its doubles are read back with the same
/// bits.
pub(crate) fn to_json(dictionary: &Bound<'_, PyDict>) -> PyResult<String> {
    dictionary.py().import("json")?.call_method1("dumps", (dictionary,))?.extract()
}

/// A text that is to be read. What is no `str` is a type error.
pub(crate) struct Json(String);

impl<'a, 'py> FromPyObject<'a, 'py> for Json {
    type Error = PyErr;

    fn extract(object: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        let text = object.cast::<PyString>()?;
        match text.to_cow() {
            Ok(text) => Ok(Self(text.into_owned())),
            Err(error) => {
                let position = error.value(object.py()).getattr("start")?.extract()?;
                Err(errors::no_unicode(object.py(), position))
            }
        }
    }
}

impl Json {
    /// The text.
    pub(crate) fn as_str(&self) -> &str {
        &self.0
    }

    /// What the library has stored; its checks are those of a value that is made.
    pub(crate) fn read<T: serde::de::DeserializeOwned>(&self, py: Python<'_>) -> PyResult<T> {
        serde_json::from_str(&self.0).map_err(|error| errors::unreadable(py, &error))
    }
}

/// What the library stores, as JSON.
pub(crate) fn stored<T: serde::Serialize>(value: &T) -> PyResult<String> {
    serde_json::to_string(value).map_err(|error| PyValueError::new_err(error.to_string()))
}

/// What pickles an object of a class with `from_json`.
pub(crate) type Reduced<'py> = (Bound<'py, PyAny>, (Bound<'py, PyType>, String));

/// The reduced form of an object of a class with `from_json`.
pub(crate) fn reduced<'py, C: PyTypeInfo>(py: Python<'py>, json: String) -> PyResult<Reduced<'py>> {
    let restore = py.import("bouncing_disk._results")?.getattr("_restored")?;
    Ok((restore, (py.get_type::<C>(), json)))
}
