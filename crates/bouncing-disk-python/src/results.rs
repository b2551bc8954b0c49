//! Results, which are classes of `bouncing_disk._results`: plain Python, so that they pickle, compare and print as
//! Python's own do.

use numpy::{IntoPyArray, PyArray1, PyArray2, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::PyTuple;

/// The result of a class that is made of these fields, in their order.
pub(crate) fn make<'py>(
    py: Python<'py>,
    class: &str,
    fields: impl IntoPyObject<'py, Target = PyTuple, Output = Bound<'py, PyTuple>, Error: Into<PyErr>>,
) -> PyResult<Bound<'py, PyAny>> {
    static MODULE: PyOnceLock<Py<PyModule>> = PyOnceLock::new();
    let module =
        MODULE.get_or_try_init(py, || Ok::<_, PyErr>(py.import("bouncing_disk._results")?.unbind()))?;
    module.bind(py).getattr(class)?.call1(fields.into_pyobject(py).map_err(Into::into)?)
}

/// An array that takes over the memory of these numbers.
pub(crate) fn array<T: numpy::Element>(py: Python<'_>, numbers: Vec<T>) -> Bound<'_, PyArray1<T>> {
    numbers.into_pyarray(py)
}

/// A matrix that takes over the memory of these numbers, row by row.
pub(crate) fn matrix<T: numpy::Element>(
    py: Python<'_>,
    numbers: Vec<T>,
    shape: [usize; 2],
) -> PyResult<Bound<'_, PyArray2<T>>> {
    numbers.into_pyarray(py).reshape(shape)
}

/// The fields of a result that has more than a tuple of Rust holds.
pub(crate) fn joined<'py>(
    py: Python<'py>,
    first: impl IntoPyObject<'py, Target = PyTuple, Output = Bound<'py, PyTuple>, Error: Into<PyErr>>,
    rest: impl IntoPyObject<'py, Target = PyTuple, Output = Bound<'py, PyTuple>, Error: Into<PyErr>>,
) -> PyResult<Bound<'py, PyTuple>> {
    let first = first.into_pyobject(py).map_err(Into::into)?;
    let rest = rest.into_pyobject(py).map_err(Into::into)?;
    Ok(first.as_sequence().concat(rest.as_sequence())?.cast_into()?)
}
