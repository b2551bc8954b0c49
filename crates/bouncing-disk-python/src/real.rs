//! Real numbers as Python passes them, one or a pair.

use pyo3::exceptions::{PyOverflowError, PyTypeError, PyValueError};
use pyo3::intern;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyFloat};

use crate::arguments::refuse_masked;

/// A real number: of Python, of NumPy, an array of no dimensions, or what has `__float__`.
///
/// `float()` makes numbers of truths, of texts in arrays, and of complex numbers, whose imaginary part it
/// drops; all these are type errors here, as they are in arrays.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Real(pub(crate) f64);

impl<'a, 'py> FromPyObject<'a, 'py> for Real {
    type Error = PyErr;

    fn extract(object: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        if let Ok(number) = object.cast::<PyFloat>() {
            return Ok(Self(number.value()));
        }
        refuse_truth(&object)?;
        if let Some(dtype) = object.getattr_opt(intern!(object.py(), "dtype"))? {
            let kind: String = dtype.getattr(intern!(object.py(), "kind"))?.extract()?;
            let dimensions: usize = object.getattr(intern!(object.py(), "ndim"))?.extract()?;
            if !["i", "u", "f"].contains(&kind.as_str()) || dimensions > 0 {
                let what = if dimensions > 0 { "an array" } else { "a number" };
                return Err(PyTypeError::new_err(format!(
                    "must be one real number, and is {what} of {dtype}"
                )));
            }
            refuse_masked(&object)?;
        }
        match object.extract::<f64>() {
            Ok(number) => Ok(Self(number)),
            // An integer beyond all doubles is a value outside of every range.
            Err(error) if error.is_instance_of::<PyOverflowError>(object.py()) => {
                Ok(Self(if object.lt(0)? { f64::NEG_INFINITY } else { f64::INFINITY }))
            }
            Err(error) => Err(error),
        }
    }
}

/// Refuses True and False, which Python takes for 1 and 0.
pub(crate) fn refuse_truth(object: &Bound<'_, PyAny>) -> PyResult<()> {
    if object.is_instance_of::<PyBool>() {
        return Err(PyTypeError::new_err("must be a number, and is a bool"));
    }
    Ok(())
}

/// The number of an argument that may be left out.
pub(crate) fn optional(number: Option<Real>) -> Option<f64> {
    number.map(|number| number.0)
}

/// Two real numbers in a tuple or list.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Pair(pub(crate) f64, pub(crate) f64);

impl<'a, 'py> FromPyObject<'a, 'py> for Pair {
    type Error = PyErr;

    fn extract(object: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        let numbers: Vec<Real> = object.extract()?;
        match numbers[..] {
            [Real(one), Real(other)] => Ok(Self(one, other)),
            _ => Err(PyValueError::new_err(format!("must be two numbers, and is {}", numbers.len()))),
        }
    }
}

impl Pair {
    /// Both, as the library has them.
    pub(crate) const fn both(self) -> (f64, f64) {
        (self.0, self.1)
    }
}
