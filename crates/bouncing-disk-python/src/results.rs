//! Results as classes of the Python package: plain Python, so that they pickle, compare and print like
//! Python's own.

use bouncing_disk::Error;
use bouncing_disk::core::Error as CoreError;
use numpy::ndarray::Array2;
use numpy::{Complex64, IntoPyArray, PyArray1, PyArray2};
use pyo3::PyClass;
use pyo3::exceptions::PyValueError;
use pyo3::intern;
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::{PyTuple, PyType};

use crate::arguments::Made;
use crate::errors;

/// The result of a class with these fields, in their order.
macro_rules! make {
    ($py:expr, $class:literal, $($field:expr),+ $(,)?) => {
        $crate::results::made($py, $class, vec![$(pyo3::IntoPyObjectExt::into_bound_py_any($field, $py)?),+])
    };
}
pub(crate) use make;

/// The result of a class made from these fields.
pub(crate) fn made<'py>(py: Python<'py>, class: &str, fields: Vec<Bound<'py, PyAny>>) -> Made<'py> {
    static MODULE: PyOnceLock<Py<PyModule>> = PyOnceLock::new();
    let module = MODULE.get_or_try_init(py, || Ok::<_, PyErr>(py.import("bouncing_disk")?.unbind()))?;
    let (class, fields) = (module.bind(py).getattr(class)?, PyTuple::new(py, fields)?);
    if class.cast::<PyType>()?.is_subclass_of::<PyTuple>()? {
        // A named tuple, whose constructor in Python would take longer than the rest of a toss.
        return py.get_type::<PyTuple>().call_method1(intern!(py, "__new__"), (class, fields));
    }
    class.call1(fields)
}

/// A result with its object of the library.
pub(crate) fn holding<'py, T: Into<PyClassInitializer<T>> + PyClass>(
    made: Bound<'py, PyAny>,
    held: T,
) -> Made<'py> {
    // The classes are frozen, so users change nothing.
    made.getattr("__dict__")?.set_item("_native", Bound::new(made.py(), held)?)?;
    Ok(made)
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
    let all = Array2::from_shape_vec(shape, numbers);
    all.map(|all| all.into_pyarray(py)).map_err(|error| PyValueError::new_err(error.to_string()))
}

/// One number of each item, as an array.
pub(crate) fn column<'py, I, T: numpy::Element>(
    py: Python<'py>,
    items: &[I],
    of: impl Fn(&I) -> T,
) -> Bound<'py, PyArray1<T>> {
    // One loop for all columns of a type: a loop for each column would be compiled separately.
    fn collected<I, T>(items: &[I], of: &dyn Fn(&I) -> T) -> Vec<T> {
        items.iter().map(of).collect()
    }
    array(py, collected(items, &of))
}

/// A count as NumPy's integer.
pub(crate) fn signed(count: u64) -> i64 {
    i64::try_from(count).unwrap_or(i64::MAX)
}

/// Both multipliers as complex numbers.
pub(crate) fn complex(multipliers: bouncing_disk::core::orbits::Multipliers) -> [Complex64; 2] {
    multipliers.pairs().map(|[real, imaginary]| Complex64::new(real, imaginary))
}

/// An empty vector with room for this many numbers; lack of memory is an error.
pub(crate) fn room_for<T>(count: usize) -> Result<Vec<T>, Error> {
    let mut room = Vec::new();
    room.try_reserve_exact(count).map_err(|_| CoreError::TooLarge {
        what: "numbers of a result",
        count: count as u64,
        limit: count as u64,
    })?;
    Ok(room)
}

/// An object that the library stores, as JSON.
pub(crate) fn stored<T: serde::Serialize>(value: &T) -> PyResult<String> {
    serde_json::to_string(value).map_err(|error| PyValueError::new_err(error.to_string()))
}

/// An object that the library has stored; reading runs the checks of its constructor.
pub(crate) fn read<T: serde::de::DeserializeOwned>(py: Python<'_>, json: &str) -> PyResult<T> {
    serde_json::from_str(json).map_err(|error| {
        let place = Some((error.line(), error.column()));
        errors::of_text(py, format!("the text cannot be read: {error}"), place)
    })
}

/// The library's object in a Python object, by which it is compared and stored.
macro_rules! holders {
    ($($(#[$doc:meta])* $name:ident($model:ty) = $shown:path;)*) => {$(
        $(#[$doc])*
        #[pyclass(frozen, eq, module = "bouncing_disk._native")]
        #[derive(Debug, PartialEq)]
        pub(crate) struct $name(pub(crate) $model);

        #[pymethods]
        impl $name {
            fn to_json(&self) -> PyResult<String> {
                $crate::results::stored(&self.0)
            }

            #[staticmethod]
            fn from_json<'py>(py: Python<'py>, json: &str) -> $crate::arguments::Made<'py> {
                $shown(py, $crate::results::read(py, json)?)
            }
        }
    )*};
}
pub(crate) use holders;
