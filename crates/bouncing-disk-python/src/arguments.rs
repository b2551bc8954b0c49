//! The arguments of a call by their names, each checked as it is read.
//!
//! Python defines the signatures: a function there passes its `locals()`, and this crate makes its result.

use std::fmt::{self, Display, Formatter};

use bouncing_disk::Error;
use bouncing_disk::core::attractors::AttractorSearch;
use bouncing_disk::core::orbits::{Continuation, ContinuationParameter};
use bouncing_disk::core::{ImpactMap, ImpactState, Vibration};
use bouncing_disk::estimate::FitError;
use bouncing_disk::motor::OperatingSettings;
use numpy::{PyArrayDyn, PyArrayMethods, PyUntypedArray, PyUntypedArrayMethods};
use pyo3::PyClass;
use pyo3::exceptions::{PyKeyError, PyOverflowError, PyTypeError, PyValueError};
use pyo3::intern;
use pyo3::prelude::*;
use pyo3::pyclass::boolean_struct::True;
use pyo3::sync::PyOnceLock;
use pyo3::types::{
    IntoPyDict, PyBool, PyByteArray, PyBytes, PyDict, PyFloat, PyFrozenSet, PyMapping, PyMemoryView, PySet,
    PyString,
};
use pythonize::pythonize;
use serde::de::DeserializeOwned;
use serde_json::Value;

use crate::errors;

/// The result of a call.
pub(crate) type Made<'py> = PyResult<Bound<'py, PyAny>>;

/// The arguments of a call.
pub(crate) struct Arguments<'py>(pub(crate) Bound<'py, PyDict>);

impl<'a, 'py> FromPyObject<'a, 'py> for Arguments<'py> {
    type Error = PyErr;

    fn extract(object: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        Ok(Self(object.to_owned().cast_into()?))
    }
}

/// An argument of some type, or an entry of one; a type error names it.
pub(crate) fn extracted<'py, T: for<'a> FromPyObject<'a, 'py>>(
    value: &Bound<'py, PyAny>,
    name: impl Display,
) -> PyResult<T> {
    let extracted: Result<T, PyErr> = value.extract::<T>().map_err(Into::into);
    extracted.map_err(|error| named(value.py(), error, name))
}

/// An error, which names the argument if it is a type error.
fn named(py: Python<'_>, error: PyErr, name: impl Display) -> PyErr {
    if !error.is_instance_of::<PyTypeError>(py) {
        return error;
    }
    PyTypeError::new_err(format!("argument '{name}': {}", error.value(py)))
}

impl<'py> Arguments<'py> {
    pub(crate) fn py(&self) -> Python<'py> {
        self.0.py()
    }

    /// Any argument, as it was given.
    pub(crate) fn get(&self, name: &str) -> Made<'py> {
        self.0.get_item(name)?.ok_or_else(|| PyKeyError::new_err(name.to_owned()))
    }

    /// An optional argument.
    pub(crate) fn given(&self, name: &str) -> PyResult<Option<Bound<'py, PyAny>>> {
        Ok(Some(self.get(name)?).filter(|value| !value.is_none()))
    }

    /// An argument of some type.
    pub(crate) fn of<T: for<'a> FromPyObject<'a, 'py>>(&self, name: &str) -> PyResult<T> {
        extracted(&self.get(name)?, name)
    }

    pub(crate) fn real(&self, name: &str) -> PyResult<f64> {
        Ok(self.of::<Real>(name)?.0)
    }

    pub(crate) fn optional(&self, name: &str) -> PyResult<Option<f64>> {
        Ok(self.of::<Option<Real>>(name)?.map(|real| real.0))
    }

    pub(crate) fn pair(&self, name: &str) -> PyResult<(f64, f64)> {
        pair(&self.get(name)?, &Place::Argument(name)).map(Into::into)
    }

    /// The items of a list.
    pub(crate) fn list(&self, name: &str) -> PyResult<Vec<Bound<'py, PyAny>>> {
        let (given, place) = (self.get(name)?, Place::Argument(name));
        items(&given, &place)?.ok_or_else(|| place.wrong(&given, "a list"))
    }

    /// The two ends of each of the named `ranges`.
    pub(crate) fn ranges(&self) -> PyResult<Vec<(String, [f64; 2])>> {
        let place = Place::Argument("ranges");
        let range = |(name, given): (String, Bound<'_, PyAny>)| {
            let ends = pair(&given, &Place::Entry(&place, &name))?;
            Ok((name, ends))
        };
        self.entries("ranges")?.into_iter().map(range).collect()
    }

    /// The entries of a table, by their names.
    pub(crate) fn entries(&self, name: &str) -> PyResult<Vec<(String, Bound<'py, PyAny>)>> {
        entries(&self.get(name)?, &Place::Argument(name))
    }

    /// The table of a file that an argument is; `None` if it is not given.
    pub(crate) fn table<T: DeserializeOwned>(&self, name: &str) -> PyResult<Option<T>> {
        let Some(given) = self.given(name)? else { return Ok(None) };
        self.read(name, plain(&given, &Place::Argument(name))?).map(Some)
    }

    /// The library's object for plain values.
    pub(crate) fn read<T: DeserializeOwned>(&self, name: &str, values: Value) -> PyResult<T> {
        let wrong = |error| errors::of_text(self.py(), format!("the {name} cannot be read: {error}"), None);
        serde_json::from_value(values).map_err(wrong)
    }

    /// A whole number up to `most`.
    pub(crate) fn count(&self, name: &str, most: u64, range: &str) -> PyResult<u64> {
        self.of::<Count>(name)?.at_most(self.py(), name, most, range)
    }

    pub(crate) fn u64(&self, name: &str) -> PyResult<u64> {
        self.of::<Count>(name)?.u64(self.py(), name)
    }

    pub(crate) fn u32(&self, name: &str) -> PyResult<u32> {
        self.of::<Count>(name)?.u32(self.py(), name)
    }

    /// A number of items, below 2^32 in every call.
    pub(crate) fn usize(&self, name: &str) -> PyResult<usize> {
        self.u32(name).map(|count| count as usize)
    }

    /// One of the words of a `Literal`.
    pub(crate) fn choice<T: Copy>(&self, name: &str, choices: &[(&str, T)]) -> PyResult<T> {
        choice(&self.get(name)?, name, choices)
    }

    /// A number or a row of numbers.
    pub(crate) fn numbers(&self, name: &str) -> PyResult<Numbers> {
        numbers(&self.get(name)?, name)
    }

    /// A row of numbers.
    pub(crate) fn row(&self, name: &str) -> PyResult<Vec<f64>> {
        row(&self.get(name)?, name)
    }

    /// The contents of an object of the package.
    pub(crate) fn held<T: PyClass<Frozen = True>>(&self, name: &str) -> PyResult<Bound<'py, T>> {
        held(&self.get(name)?, name)
    }

    /// Makes arguments of the keywords `settings` of the call, the others at the defaults of this class.
    pub(crate) fn take_settings(&self, class: &str) -> PyResult<()> {
        let (all, given) = (default_settings(self.py(), class)?, self.of::<Bound<'_, PyDict>>("settings")?);
        for name in given.keys() {
            if !all.contains(&name)? {
                return Err(PyTypeError::new_err(format!("unexpected keyword argument '{name}'")));
            }
        }
        all.update(given.as_mapping())?;
        self.0.update(all.as_mapping())
    }

    /// The exception of an error of the library, in the words of this call.
    pub(crate) fn refused(&self, error: impl Into<FitError>) -> PyErr {
        errors::of_call(self.py(), error, &self.0)
    }
}

/// The defaults of the keywords that a class of settings has in Python: those of the library.
#[pyfunction]
pub(crate) fn default_settings<'py>(py: Python<'py>, class: &str) -> PyResult<Bound<'py, PyDict>> {
    let (search, range) = (AttractorSearch::default(), (0.0, 1.0));
    let all = match class {
        "AttractorSearch" => {
            let (starts, cells, longest) = (search.starts(), search.cells(), search.longest_period());
            let all = [("starts", u64::from(starts)), ("transient", search.transient())];
            let more = [("impacts", search.impacts()), ("longest_period", longest as u64)];
            let last = [("cells", cells.into()), ("budget", search.budget())];
            return [all, more, last].concat().into_py_dict(py);
        }
        "Continuation" => {
            let own = Continuation::new(ContinuationParameter::Forcing, range, true);
            pythonize(py, &own.map_err(|error| errors::of(py, error))?)?
        }
        _ => pythonize(py, &OperatingSettings::default())?,
    };
    let all = all.cast_into::<PyDict>()?;
    ["parameter", "low", "high", "rising"].iter().for_each(|argument| _ = all.del_item(argument));
    Ok(all)
}

/// The contents of an object of the package.
pub(crate) fn held<'py, T: PyClass<Frozen = True>>(
    object: &Bound<'py, PyAny>,
    name: &str,
) -> PyResult<Bound<'py, T>> {
    let inner = object.getattr(intern!(object.py(), "_native")).ok().and_then(|own| own.cast_into().ok());
    inner.ok_or_else(|| {
        let own = T::NAME;
        PyTypeError::new_err(format!("argument '{name}' must be a {own}, not {}", object.get_type()))
    })
}

/// One of the words of a `Literal`.
pub(crate) fn choice<T: Copy>(given: &Bound<'_, PyAny>, name: &str, choices: &[(&str, T)]) -> PyResult<T> {
    let given: &str = given.extract().map_err(|_| PyTypeError::new_err(format!("{name} must be a text")))?;
    let found = choices.iter().find(|(word, _)| *word == given).map(|(_, choice)| *choice);
    found.ok_or_else(|| {
        let words: Vec<_> = choices.iter().map(|(word, _)| format!("{word:?}")).collect();
        PyValueError::new_err(format!("{name} must be {}, not {given:?}", words.join(" or ")))
    })
}

/// A real number: of Python, of NumPy, a 0-d array, or an object with `__float__`.
///
/// `float()` accepts booleans, texts in arrays, and complex numbers, whose imaginary part it drops; here all
/// these are type errors, as in arrays.
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
                return Err(PyTypeError::new_err(format!("must be one real number, not {what} of {dtype}")));
            }
            refuse_masked(&object)?;
        }
        match object.extract::<f64>() {
            Ok(number) => Ok(Self(number)),
            // An integer beyond all doubles is outside every range.
            Err(error) if error.is_instance_of::<PyOverflowError>(object.py()) => {
                Ok(Self(if object.lt(0)? { f64::NEG_INFINITY } else { f64::INFINITY }))
            }
            Err(error) => Err(error),
        }
    }
}

/// Entries that are a text, or a list of texts.
const TEXTS: [&str; 6] = ["angle", "geometry", "height", "kind", "law", "materials"];

/// Entries that are a list.
const LISTS: [&str; 8] =
    ["factors", "fourier", "materials", "pieces", "sampled", "speeds", "times", "torques"];

/// Entries that are a list of lists.
const NESTED: [&str; 2] = ["fourier", "pieces"];

/// Entries that are a table, or a list of tables.
const TABLES: [&str; 6] = ["angle", "contact", "drive", "height", "load", "stator"];

/// The place of a value among the arguments of a call, such as `stator.mass` or `height.sampled[3]`.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Place<'a> {
    Argument(&'a str),
    Entry(&'a Self, &'a str),
    Item(&'a Self, usize),
}

impl Display for Place<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Argument(name) => f.write_str(name),
            Self::Entry(table, name) => write!(f, "{table}.{name}"),
            Self::Item(list, index) => write!(f, "{list}[{index}]"),
        }
    }
}

impl Place<'_> {
    /// The name of the entry that is or holds the value.
    const fn name(&self) -> &str {
        match self {
            Self::Argument(name) | Self::Entry(_, name) => name,
            Self::Item(list, _) => list.name(),
        }
    }

    fn is_one_of(&self, names: &[&str]) -> bool {
        names.contains(&self.name())
    }

    /// Whether a list belongs here.
    fn takes_list(&self) -> bool {
        self.is_one_of(if matches!(self, Self::Item(..)) { &NESTED } else { &LISTS })
    }

    /// The expected type, in words.
    fn expected(&self) -> &'static str {
        if self.takes_list() {
            "a list"
        } else if self.is_one_of(&TABLES) {
            if self.is_one_of(&TEXTS) { "a name or a table (a dictionary)" } else { "a table (a dictionary)" }
        } else if self.is_one_of(&TEXTS) {
            "a text"
        } else {
            "one real number"
        }
    }

    /// The error of a value of another type.
    fn wrong(&self, value: &Bound<'_, PyAny>, expected: &str) -> PyErr {
        let found =
            value.get_type().name().map_or_else(|_| "something else".to_owned(), |name| name.to_string());
        PyTypeError::new_err(format!("argument '{self}': must be {expected}, not {found}"))
    }
}

/// A value as in a file: a text, a finite number, or a list or a table of them. NumPy's numbers and arrays
/// count as numbers and lists; nothing else does.
pub(crate) fn plain(value: &Bound<'_, PyAny>, place: &Place<'_>) -> PyResult<Value> {
    let wrong = || Err(place.wrong(value, place.expected()));
    let takes_list = place.takes_list();
    let takes_number = !place.is_one_of(&TABLES)
        && !place.is_one_of(&TEXTS)
        && (!takes_list || matches!(place, Place::Item(..)));
    // Most samples are floats, and the general path takes far longer.
    if takes_number && value.is_instance_of::<PyFloat>() {
        return number(value, place).map(Value::from);
    }
    if value.cast::<PyMapping>().is_ok() {
        if takes_list || !place.is_one_of(&TABLES) {
            return wrong();
        }
        // Like an argument that is None, such an entry is not given.
        let given = entries(value, place)?.into_iter().filter(|(_, own)| !own.is_none());
        return given
            .map(|(name, own)| {
                let own = plain(&own, &Place::Entry(place, &name))?;
                Ok((name, own))
            })
            .collect();
    }
    if let Ok(text) = value.cast::<PyString>() {
        return if place.is_one_of(&TEXTS) && !takes_list { Ok(text.to_str()?.into()) } else { wrong() };
    }
    match items(value, place)? {
        Some(items) if takes_list => {
            let items = items.iter().enumerate();
            items.map(|(index, item)| plain(item, &Place::Item(place, index))).collect()
        }
        None if takes_number => number(value, place).map(Value::from),
        _ => wrong(),
    }
}

/// A finite number.
fn number(value: &Bound<'_, PyAny>, place: &Place<'_>) -> PyResult<f64> {
    let Real(number) = extracted(value, place)?;
    if !number.is_finite() {
        return Err(errors::out_of_range(value.py(), &place.to_string(), number, "(-inf, inf)"));
    }
    Ok(number)
}

/// The items of a list, an array or another ordered collection; `None` for other objects.
fn items<'py>(value: &Bound<'py, PyAny>, place: &Place<'_>) -> PyResult<Option<Vec<Bound<'py, PyAny>>>> {
    let is_unordered = value.is_instance_of::<PySet>() || value.is_instance_of::<PyFrozenSet>();
    let is_bytes = value.is_instance_of::<PyBytes>()
        || value.is_instance_of::<PyByteArray>()
        || value.is_instance_of::<PyMemoryView>();
    if is_unordered || is_bytes || value.is_instance_of::<PyString>() {
        return Ok(None);
    }
    refuse_masked(value).map_err(|error| named(value.py(), error, place))?;
    // 0-d arrays, like other objects that are not collections, are not iterable.
    value.try_iter().map_or(Ok(None), |items| items.collect::<PyResult<_>>().map(Some))
}

/// The entries of a table, by their names.
pub(crate) fn entries<'py>(
    table: &Bound<'py, PyAny>,
    place: &Place<'_>,
) -> PyResult<Vec<(String, Bound<'py, PyAny>)>> {
    let Ok(table) = table.cast::<PyMapping>() else {
        return Err(place.wrong(table, "a table (a dictionary)"));
    };
    let entry = |item: Bound<'py, PyAny>| {
        let (name, value): (Bound<'_, PyAny>, _) = item.extract()?;
        Ok((name.extract().map_err(|_| place.wrong(&name, "a table whose names are texts"))?, value))
    };
    table.items()?.iter().map(entry).collect()
}

/// Two numbers; the range of their quantity is the library's.
pub(crate) fn pair(value: &Bound<'_, PyAny>, place: &Place<'_>) -> PyResult<[f64; 2]> {
    let items = items(value, place)?.ok_or_else(|| place.wrong(value, "two numbers"))?;
    let [low, high] = items.as_slice() else {
        return Err(PyValueError::new_err(format!("{place} must be two numbers, but has {}", items.len())));
    };
    let number = |value, index| extracted::<Real>(value, Place::Item(place, index));
    Ok([number(low, 0)?.0, number(high, 1)?.0])
}

/// Rejects True and False, which Python takes for 1 and 0.
fn refuse_truth(object: &Bound<'_, PyAny>) -> PyResult<()> {
    if object.is_instance_of::<PyBool>() {
        return Err(PyTypeError::new_err("must be a number, not a bool"));
    }
    Ok(())
}

/// A whole number. A negative or too large one becomes a double, so that its value is reported and not an
/// overflow.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Count(pub(crate) Result<u64, f64>);

impl<'a, 'py> FromPyObject<'a, 'py> for Count {
    type Error = PyErr;

    fn extract(object: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        refuse_truth(&object)?;
        match object.extract::<u64>() {
            Ok(count) => Ok(Self(Ok(count))),
            Err(error) if error.is_instance_of::<PyOverflowError>(object.py()) => {
                let beyond = if object.lt(0)? { f64::NEG_INFINITY } else { f64::INFINITY };
                Ok(Self(Err(object.extract::<f64>().unwrap_or(beyond))))
            }
            Err(error) => Err(error),
        }
    }
}

impl Count {
    /// The number, if it is at most `most`.
    pub(crate) fn at_most(self, py: Python<'_>, field: &str, most: u64, range: &str) -> PyResult<u64> {
        match self.0 {
            Ok(count) if count <= most => Ok(count),
            Ok(count) => Err(errors::out_of_range(py, field, count as f64, range)),
            Err(value) => Err(errors::out_of_range(py, field, value, range)),
        }
    }

    pub(crate) fn u64(self, py: Python<'_>, field: &str) -> PyResult<u64> {
        self.at_most(py, field, u64::MAX, "[0, 18446744073709551615]")
    }

    pub(crate) fn u32(self, py: Python<'_>, field: &str) -> PyResult<u32> {
        self.at_most(py, field, u32::MAX.into(), "[0, 4294967295]").map(|count| count as u32)
    }
}

/// Real numbers: one, or a row of them.
#[derive(Debug, Clone)]
pub(crate) struct Numbers {
    values: Vec<f64>,
    scalar: bool,
}

impl Numbers {
    /// The number for an item of a call: a single number applies to all items.
    pub(crate) fn get(&self, index: usize) -> f64 {
        if self.scalar { self.values[0] } else { self.values[index] }
    }

    /// The length; `None` for a single number, which fits any length.
    pub(crate) fn len(&self) -> Option<usize> {
        (!self.scalar).then_some(self.values.len())
    }

    fn spread(&self, items: usize) -> Vec<f64> {
        (0..items).map(|index| self.get(index)).collect()
    }
}

/// Rejects masked values: NumPy would read the values below the mask, and count gaps as measurements.
fn refuse_masked(object: &Bound<'_, PyAny>) -> PyResult<()> {
    let py = object.py();
    static IS_MASKED: PyOnceLock<Py<PyAny>> = PyOnceLock::new();
    let masked = || Ok::<_, PyErr>(py.import("numpy.ma")?.getattr("is_masked")?.unbind());
    if object.hasattr(intern!(py, "_mask"))?
        && IS_MASKED.get_or_try_init(py, masked)?.bind(py).call1((object,))?.is_truthy()?
    {
        return Err(PyTypeError::new_err("an array has masked values: remove or fill them first"));
    }
    Ok(())
}

/// An array of real numbers with one of these numbers of dimensions, as doubles.
fn doubles<'py>(
    object: &Bound<'py, PyAny>,
    name: &str,
    dimensions: &[usize],
) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
    static AS_ARRAY: PyOnceLock<Py<PyAny>> = PyOnceLock::new();
    let py = object.py();
    let import = || Ok::<_, PyErr>(py.import("numpy")?.getattr("asarray")?.unbind());
    refuse_masked(object)?;
    let array = AS_ARRAY.get_or_try_init(py, import)?.bind(py).call1((object,))?;
    let untyped = array.cast::<PyUntypedArray>()?;
    let kind: String = untyped.dtype().as_any().getattr(intern!(py, "kind"))?.extract()?;
    if !["i", "u", "f"].contains(&kind.as_str()) {
        let dtype = untyped.dtype();
        return Err(PyTypeError::new_err(format!("{name} must contain real numbers, not {dtype}")));
    }
    if !dimensions.contains(&untyped.ndim()) {
        let shape = untyped.shape();
        let wanted = if dimensions == [2] { "a 2-d array" } else { "a number or a 1-d array" };
        return Err(PyValueError::new_err(format!("{name} must be {wanted}, but has the shape {shape:?}")));
    }
    Ok(array.call_method1(intern!(py, "astype"), ("float64",))?.cast_into()?)
}

fn numbers(object: &Bound<'_, PyAny>, name: &str) -> PyResult<Numbers> {
    let array = doubles(object, name, &[0, 1])?;
    let read = array.try_readonly().map_err(|error| PyValueError::new_err(error.to_string()))?;
    Ok(Numbers { values: read.as_array().iter().copied().collect(), scalar: array.ndim() == 0 })
}

/// A row of numbers.
pub(crate) fn row(object: &Bound<'_, PyAny>, name: &str) -> PyResult<Vec<f64>> {
    let numbers = numbers(object, name)?;
    if numbers.scalar {
        return Err(PyValueError::new_err(format!("{name} must be a 1-d array, not a number")));
    }
    Ok(numbers.values)
}

/// The runs of measured speeds: one row, or the columns of a matrix.
pub(crate) fn runs(object: &Bound<'_, PyAny>, name: &str) -> PyResult<Vec<Vec<f64>>> {
    if let Ok(one) = row(object, name) {
        return Ok(vec![one]);
    }
    let array = doubles(object, name, &[2])?;
    let read = array.try_readonly().map_err(|error| PyValueError::new_err(error.to_string()))?;
    let view = read.as_array();
    let columns = view.shape().get(1).copied().unwrap_or(0);
    let column = |index| view.index_axis(numpy::ndarray::Axis(1), index).iter().copied().collect();
    Ok((0..columns).map(column).collect())
}

/// The common length of several arguments, each a number or a row; 1 if all are numbers.
pub(crate) fn common_length(all: &[(&str, Option<usize>)]) -> PyResult<usize> {
    let mut found: Option<(&str, usize)> = None;
    for (name, length) in all {
        let Some(length) = *length else { continue };
        match found {
            Some((other, expected)) if expected != length => {
                return Err(PyValueError::new_err(format!(
                    "{other} and {name} must have the same length, but have {expected} and {length}"
                )));
            }
            _ => found = Some((name, length)),
        }
    }
    Ok(found.map_or(1, |(_, length)| length))
}

/// The impact of a phase and a normalised speed.
pub(crate) fn first_impact(impact_phase: f64, normalised_speed: f64) -> Result<ImpactState, Error> {
    ImpactState::from_normalised(impact_phase, normalised_speed).map_err(|error| match error {
        // The caller gave the speed, and the library's velocity is -pi times it.
        bouncing_disk::core::Error::OutOfRange { field: "axial_impact_velocity", .. } => {
            Error::OutOfRange { field: "normalised_speed", value: normalised_speed, legal: "[0, 5.7e307]" }
        }
        error => error.into(),
    })
}

/// The starts of orbits: four numbers each.
pub(crate) struct Starts {
    /// Gamma of each.
    pub(crate) axial_forcing: Vec<f64>,
    /// Restitution of each.
    pub(crate) restitution: Vec<f64>,
    impact_phase: Numbers,
    normalised_speed: Numbers,
}

impl Starts {
    /// The starts of four arguments that go together.
    pub(crate) fn of(a: &Arguments<'_>) -> PyResult<Self> {
        const NAMES: [&str; 4] = ["axial_forcing", "restitution", "impact_phase", "normalised_speed"];
        let mut all = Vec::new();
        for name in NAMES {
            all.push(a.numbers(name)?);
        }
        let lengths: Vec<_> = NAMES.into_iter().zip(all.iter().map(Numbers::len)).collect();
        let items = common_length(&lengths)?;
        Ok(Self {
            axial_forcing: all[0].spread(items),
            restitution: all[1].spread(items),
            impact_phase: all.swap_remove(2),
            normalised_speed: all.swap_remove(2),
        })
    }

    /// The map with the first impact of an index below the number of forcings.
    pub(crate) fn state(&self, index: usize) -> Result<(ImpactMap, ImpactState), Error> {
        let vibration = Vibration::from_axial_forcing(self.axial_forcing[index])?;
        let map = ImpactMap::new(vibration, self.restitution[index])?;
        Ok((map, first_impact(self.impact_phase.get(index), self.normalised_speed.get(index))?))
    }
}
