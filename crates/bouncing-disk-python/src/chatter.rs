//! What ends a chattering sequence.

use bouncing_disk::PAPER_CUT;
use bouncing_disk::core::{ChatterCut as Cut, ChatterPolicy};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arguments::Count;
use crate::real::Real;
use crate::text::Json;
use crate::{errors, text};

/// Put a chattering disk on the platform by a rule, as simulations do that follow it impact by impact.
///
/// Without one (``chatter=None``) the infinite sequence of impacts is summed in closed form.
///
/// Parameters
/// ----------
/// smallest_speed : float
///     Normalised impact speed, not negative, below which the disk is put on the platform.
/// short_flight : float
///     Duration, not negative, in periods of the platform, below which a flight is short.
/// short_flights : int
///     How many consecutive short flights put the disk on the platform, at least 1.
///
/// Examples
/// --------
/// >>> import bouncing_disk as bd
/// >>> bd.ChatterCut(smallest_speed=1e-6, short_flight=0.01, short_flights=50)
/// ChatterCut(smallest_speed=1e-06, short_flight=0.01, short_flights=50)
#[pyclass(frozen, eq, module = "bouncing_disk")]
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ChatterCut(Cut);

/// The arguments as they stand in a text.
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct Written {
    smallest_speed: f64,
    short_flight: f64,
    short_flights: u64,
}

#[pymethods]
impl ChatterCut {
    #[new]
    #[pyo3(signature = (*, smallest_speed, short_flight, short_flights))]
    fn new(py: Python<'_>, smallest_speed: Real, short_flight: Real, short_flights: Count) -> PyResult<Self> {
        let flights = short_flights.at_most(py, "short_flights", u32::MAX.into(), "[1, 4294967295]")?;
        Cut::new(smallest_speed.0, short_flight.0, flights as u32)
            .map(Self)
            .map_err(|error| errors::of(py, error))
    }

    /// The rule of the paper's simulations.
    #[staticmethod]
    fn paper() -> Self {
        Self(PAPER_CUT)
    }

    /// Normalised impact speed below which the disk is put on the platform.
    #[getter]
    fn smallest_speed(&self) -> f64 {
        self.0.smallest_speed()
    }

    /// Duration in periods of the platform below which a flight is short.
    #[getter]
    fn short_flight(&self) -> f64 {
        self.0.short_flight()
    }

    /// How many consecutive short flights put the disk on the platform.
    #[getter]
    fn short_flights(&self) -> u32 {
        self.0.short_flights()
    }

    /// The arguments of the constructor.
    ///
    /// Returns
    /// -------
    /// dict
    fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let dictionary = PyDict::new(py);
        dictionary.set_item("smallest_speed", self.smallest_speed())?;
        dictionary.set_item("short_flight", self.short_flight())?;
        dictionary.set_item("short_flights", self.short_flights())?;
        Ok(dictionary)
    }

    /// The cut of such a dictionary.
    ///
    /// Parameters
    /// ----------
    /// parameters : dict
    ///     As of :meth:`to_dict`.
    ///
    /// Returns
    /// -------
    /// ChatterCut
    #[staticmethod]
    fn from_dict<'py>(py: Python<'py>, parameters: &Bound<'py, PyDict>) -> PyResult<Bound<'py, PyAny>> {
        py.get_type::<Self>().call((), Some(parameters))
    }

    /// The arguments as JSON, which the Rust library reads as well.
    ///
    /// Returns
    /// -------
    /// str
    fn to_json(&self, py: Python<'_>) -> PyResult<String> {
        text::to_json(&self.to_dict(py)?)
    }

    /// The cut of such a text.
    ///
    /// Parameters
    /// ----------
    /// json : str
    ///     As of :meth:`to_json`.
    ///
    /// Returns
    /// -------
    /// ChatterCut
    #[staticmethod]
    fn from_json(py: Python<'_>, json: Json) -> PyResult<Self> {
        let Written { smallest_speed, short_flight, short_flights } = json.read(py)?;
        Self::new(py, Real(smallest_speed), Real(short_flight), Count::Fits(short_flights))
    }

    fn __getnewargs_ex__<'py>(&self, py: Python<'py>) -> PyResult<((), Bound<'py, PyDict>)> {
        Ok(((), self.to_dict(py)?))
    }

    fn __hash__(&self) -> u64 {
        let flights = f64::from(self.short_flights());
        text::hash(&[self.smallest_speed(), self.short_flight(), flights])
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        text::call("ChatterCut", &self.to_dict(py)?)
    }
}

/// The policy of an argument `chatter`.
pub(crate) fn policy(chatter: Option<&Bound<'_, ChatterCut>>) -> ChatterPolicy {
    chatter.map_or(ChatterPolicy::Complete, |cut| ChatterPolicy::Cut(cut.get().0))
}
