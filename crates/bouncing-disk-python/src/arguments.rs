//! What Python passes: numbers, counts, arrays, starts of orbits.

use bouncing_disk::Error;
use bouncing_disk::core::{ChatterPolicy, ImpactMap, ImpactState, Orbit, Vibration};
use numpy::{PyArrayDyn, PyArrayMethods, PyUntypedArray, PyUntypedArrayMethods};
use pyo3::exceptions::{PyOverflowError, PyTypeError, PyValueError};
use pyo3::intern;
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;

use crate::errors;
use crate::names::{Named, name};
use crate::real::refuse_truth;

/// A whole number as Python has it: one that is negative or too large is told as a value, not as an overflow.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Count {
    /// One that fits.
    Fits(u64),
    /// One that does not, as nearly as a double has it.
    Outside(f64),
}

impl<'a, 'py> FromPyObject<'a, 'py> for Count {
    type Error = PyErr;

    fn extract(object: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        refuse_truth(&object)?;
        match object.extract::<u64>() {
            Ok(count) => Ok(Self::Fits(count)),
            Err(error) if error.is_instance_of::<PyOverflowError>(object.py()) => {
                let negative = object.lt(0)?;
                let beyond = if negative { f64::NEG_INFINITY } else { f64::INFINITY };
                Ok(Self::Outside(object.extract::<f64>().unwrap_or(beyond)))
            }
            Err(error) => Err(error),
        }
    }
}

impl Count {
    /// The number, if it is at most `most`.
    pub(crate) fn at_most(
        self,
        py: Python<'_>,
        field: &'static str,
        most: u64,
        range: &'static str,
    ) -> PyResult<u64> {
        match self {
            Self::Fits(count) if count <= most => Ok(count),
            Self::Fits(count) => Err(errors::out_of_range(py, field, count as f64, range)),
            Self::Outside(value) => Err(errors::out_of_range(py, field, value, range)),
        }
    }

    /// A number of 64 bits.
    pub(crate) fn u64(self, py: Python<'_>, field: &'static str) -> PyResult<u64> {
        self.at_most(py, field, u64::MAX, "[0, 18446744073709551615]")
    }

    /// A number of 32 bits.
    pub(crate) fn u32(self, py: Python<'_>, field: &'static str) -> PyResult<u32> {
        self.at_most(py, field, u32::MAX.into(), "[0, 4294967295]").map(|count| count as u32)
    }

    /// A number of items.
    pub(crate) fn usize(self, py: Python<'_>, field: &'static str) -> PyResult<usize> {
        self.at_most(py, field, u32::MAX.into(), "[0, 4294967295]").map(|count| count as usize)
    }
}

/// Real numbers: one, or a row of them.
#[derive(Debug, Clone)]
pub(crate) struct Numbers {
    values: Vec<f64>,
    scalar: bool,
}

impl Numbers {
    /// The number of an item of a call that has so many: one number is that of all.
    pub(crate) fn get(&self, index: usize) -> f64 {
        if self.scalar { self.values[0] } else { self.values[index] }
    }

    /// The numbers of all items.
    pub(crate) fn spread(&self, items: usize) -> Vec<f64> {
        if self.scalar { vec![self.values[0]; items] } else { self.values.clone() }
    }

    /// How many there are; `None` for one that goes with any.
    pub(crate) fn len(&self) -> Option<usize> {
        (!self.scalar).then_some(self.values.len())
    }
}

/// Refuses masked values: NumPy takes what is below a mask for values, so that gaps of measurements would count.
pub(crate) fn refuse_masked(object: &Bound<'_, PyAny>) -> PyResult<()> {
    let py = object.py();
    static IS_MASKED: PyOnceLock<Py<PyAny>> = PyOnceLock::new();
    let masked = || Ok::<_, PyErr>(py.import("numpy.ma")?.getattr("is_masked")?.unbind());
    if object.hasattr(intern!(py, "_mask"))?
        && IS_MASKED.get_or_try_init(py, masked)?.bind(py).call1((object,))?.is_truthy()?
    {
        return Err(PyTypeError::new_err("an array has masked values: take them out, or fill them, before"));
    }
    Ok(())
}

fn as_array<'py>(object: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
    static AS_ARRAY: PyOnceLock<Py<PyAny>> = PyOnceLock::new();
    let py = object.py();
    let import = || Ok::<_, PyErr>(py.import("numpy")?.getattr("asarray")?.unbind());
    refuse_masked(object)?;
    AS_ARRAY.get_or_try_init(py, import)?.bind(py).call1((object,))
}

/// An array of real numbers with one of these numbers of dimensions, as doubles.
fn doubles<'py>(
    object: &Bound<'py, PyAny>,
    name: &str,
    dimensions: &[usize],
) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
    let array = as_array(object)?;
    let untyped = array.cast::<PyUntypedArray>()?;
    let kind: String = untyped.dtype().as_any().getattr(intern!(object.py(), "kind"))?.extract()?;
    if !["i", "u", "f"].contains(&kind.as_str()) {
        let dtype = untyped.dtype();
        return Err(PyTypeError::new_err(format!("{name} must hold real numbers, and holds {dtype}")));
    }
    if !dimensions.contains(&untyped.ndim()) {
        let shape = untyped.shape();
        let wanted = if dimensions == [2] { "a 2-d array" } else { "a number or a 1-d array" };
        return Err(PyValueError::new_err(format!("{name} must be {wanted}, and has the shape {shape:?}")));
    }
    Ok(array.call_method1(intern!(object.py(), "astype"), ("float64",))?.cast_into()?)
}

/// A number or a row of numbers.
pub(crate) fn numbers(object: &Bound<'_, PyAny>, name: &str) -> PyResult<Numbers> {
    let array = doubles(object, name, &[0, 1])?;
    let read = array.try_readonly().map_err(|error| PyValueError::new_err(error.to_string()))?;
    Ok(Numbers { values: read.as_array().iter().copied().collect(), scalar: array.ndim() == 0 })
}

/// A row of numbers.
pub(crate) fn row(object: &Bound<'_, PyAny>, name: &str) -> PyResult<Vec<f64>> {
    let numbers = numbers(object, name)?;
    if numbers.scalar {
        return Err(PyValueError::new_err(format!("{name} must be a 1-d array, and is a number")));
    }
    Ok(numbers.values)
}

/// The columns of a matrix.
pub(crate) fn columns(object: &Bound<'_, PyAny>, name: &str) -> PyResult<Vec<Vec<f64>>> {
    let array = doubles(object, name, &[2])?;
    let read = array.try_readonly().map_err(|error| PyValueError::new_err(error.to_string()))?;
    let view = read.as_array();
    let columns = view.shape().get(1).copied().unwrap_or(0);
    Ok((0..columns)
        .map(|column| view.index_axis(numpy::ndarray::Axis(1), column).iter().copied().collect())
        .collect())
}

/// The one length of several arguments, each a number or a row; of numbers alone one item.
pub(crate) fn common_length(all: &[(&str, Option<usize>)]) -> PyResult<usize> {
    let mut found: Option<(&str, usize)> = None;
    for (name, length) in all {
        let Some(length) = *length else { continue };
        match found {
            Some((other, expected)) if expected != length => {
                return Err(PyValueError::new_err(format!(
                    "{other} and {name} must have the same length, and have {expected} and {length}"
                )));
            }
            _ => found = Some((name, length)),
        }
    }
    Ok(found.map_or(1, |(_, length)| length))
}

/// The impact of a phase and a normalised speed.
pub(crate) fn first_impact(impact_phase: f64, normalised_speed: f64) -> Result<ImpactState, Error> {
    let speed = name("axial_impact_velocity", &["normalised_speed"]).given(normalised_speed);
    ImpactState::from_normalised(impact_phase, normalised_speed)
        .named(&[name("phase", &["impact_phase"]), speed.legal("[0, 5.7e307]")])
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
    /// Those of four arguments that go together.
    pub(crate) fn new(
        axial_forcing: &Bound<'_, PyAny>,
        restitution: &Bound<'_, PyAny>,
        impact_phase: &Bound<'_, PyAny>,
        normalised_speed: &Bound<'_, PyAny>,
    ) -> PyResult<Self> {
        let forcing = numbers(axial_forcing, "axial_forcing")?;
        let restitution = numbers(restitution, "restitution")?;
        let impact_phase = numbers(impact_phase, "impact_phase")?;
        let normalised_speed = numbers(normalised_speed, "normalised_speed")?;
        let items = common_length(&[
            ("axial_forcing", forcing.len()),
            ("restitution", restitution.len()),
            ("impact_phase", impact_phase.len()),
            ("normalised_speed", normalised_speed.len()),
        ])?;
        Ok(Self {
            axial_forcing: forcing.spread(items),
            restitution: restitution.spread(items),
            impact_phase,
            normalised_speed,
        })
    }

    /// The map with the first impact of an index below the number of forcings.
    pub(crate) fn state(&self, index: usize) -> Result<(ImpactMap, ImpactState), Error> {
        let vibration = Vibration::from_axial_forcing(self.axial_forcing[index])?;
        let map = ImpactMap::new(vibration, self.restitution[index])?;
        Ok((map, first_impact(self.impact_phase.get(index), self.normalised_speed.get(index))?))
    }

    /// The maps with the first impacts.
    pub(crate) fn states(&self) -> Result<Vec<(ImpactMap, ImpactState)>, Error> {
        (0..self.axial_forcing.len()).map(|index| self.state(index)).collect()
    }

    /// The orbits.
    pub(crate) fn orbits(&self, policy: ChatterPolicy) -> Result<Vec<Orbit>, Error> {
        Ok(self.states()?.into_iter().map(|(map, state)| map.orbit(state, policy)).collect())
    }
}

/// What is told how far a call is: `None`, or a callable.
#[derive(Debug)]
pub(crate) struct ProgressCallable(pub(crate) Option<Py<PyAny>>);

impl<'a, 'py> FromPyObject<'a, 'py> for ProgressCallable {
    type Error = PyErr;

    fn extract(object: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        if object.is_none() {
            return Ok(Self(None));
        }
        if !object.is_callable() {
            return Err(PyTypeError::new_err("progress must be a callable or None"));
        }
        Ok(Self(Some(object.to_owned().unbind())))
    }
}
