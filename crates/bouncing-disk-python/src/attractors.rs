//! The attractors of a map, and their basins.

use bouncing_disk::core::{
    AfterRest, AttractorKind, AttractorSearch, Attractors as Found, BasinSettings, RestCycle,
};
use pyo3::prelude::*;
use pyo3::types::PyTuple;

use crate::arguments::{Count, ProgressCallable};
use crate::basins::{GridArguments, labels, result};
use crate::chatter::{ChatterCut, policy};
use crate::impact_map::ImpactMap;
use crate::names::{Named, name};
use crate::periodic_orbit::PeriodicOrbit;
use crate::real::Pair;
use crate::text::Json;
use crate::{errors, long_call, results, text};

/// The attractors of an impact map: the disk at rest, and all others that were found.
///
/// Made by :func:`attractors`.
#[pyclass(frozen, eq, module = "bouncing_disk")]
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Attractors(pub(crate) Found);

#[pymethods]
impl Attractors {
    /// The map.
    #[getter]
    fn impact_map(&self) -> ImpactMap {
        ImpactMap::of(*self.0.map())
    }

    /// The disk at rest, which is number 0, and all other attractors: a tuple of :class:`Attractor`.
    #[getter]
    fn all<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        let mut all = Vec::new();
        for (number, attractor) in self.0.all().iter().enumerate() {
            let (mut orbit, mut leads_to) = (None, None);
            let (mut radius, mut exponent, mut error) = (f64::NAN, f64::NAN, f64::NAN);
            let kind = match &attractor.kind {
                AttractorKind::Rest(after) => {
                    if let AfterRest::LeadsTo(other) = after {
                        leads_to = Some(*other);
                    }
                    "rest"
                }
                AttractorKind::Periodic(known) => {
                    (orbit, radius) = (Some(PeriodicOrbit(known.orbit().clone())), known.radius());
                    "periodic"
                }
                AttractorKind::Marginal(own) => {
                    orbit = Some(PeriodicOrbit(own.clone()));
                    "marginal"
                }
                AttractorKind::Chaotic { exponent: growth, standard_error, .. } => {
                    (exponent, error) = (*growth, *standard_error);
                    "chaotic"
                }
                _ => "unclassified",
            };
            let fields = (
                kind,
                self.0.label(number),
                orbit,
                radius,
                exponent,
                error,
                attractor.starts.value(),
                attractor.starts.interval(),
                attractor.kind.lasts(),
                leads_to,
                attractor.kind.to_string(),
                attractor.kind.rest_cycle().is_none_or(RestCycle::is_exact),
            );
            all.push(results::make(py, "Attractor", fields)?);
        }
        PyTuple::new(py, all)
    }

    /// The share of the starts that ended on none of them.
    #[getter]
    fn undecided(&self) -> f64 {
        self.0.undecided().value()
    }

    /// Their basins on a grid of impacts.
    ///
    /// Parameters
    /// ----------
    /// phases, phase_range, speeds, speed_range, max_impacts, chatter : optional
    ///     As of :func:`basins`.
    /// progress : callable, optional
    ///     Called as ``progress(done, total)`` with the number of rows.
    ///
    /// Returns
    /// -------
    /// Basins
    #[pyo3(signature = (
        *, phases=Count::Fits(400), phase_range=Pair(0.0, 1.0), speeds=Count::Fits(300), speed_range=Pair(0.0, 3.0),
        max_impacts=Count::Fits(2000), chatter=None, progress=ProgressCallable(None)
    ), text_signature = "($self, /, *, phases=400, phase_range=(0.0, 1.0), speeds=300, speed_range=(0.0, 3.0), \
                         max_impacts=2000, chatter=None, progress=None)")]
    #[expect(clippy::too_many_arguments, reason = "they are keywords")]
    fn basins<'py>(
        &self,
        py: Python<'py>,
        phases: Count,
        phase_range: Pair,
        speeds: Count,
        speed_range: Pair,
        max_impacts: Count,
        chatter: Option<&Bound<'py, ChatterCut>>,
        progress: ProgressCallable,
    ) -> PyResult<Bound<'py, PyAny>> {
        let grid = GridArguments { phases, phase_range, speeds, speed_range }.grid(py)?;
        let settings =
            BasinSettings { max_impacts: max_impacts.u32(py, "max_impacts")?, policy: policy(chatter) };
        let found =
            long_call::run(py, progress.0, |observer| labels(&self.0.basins(grid, settings, observer)?))?;
        let mut told = vec!["undecided".to_owned()];
        told.extend(self.0.all().iter().map(|attractor| attractor.kind.to_string()));
        let map = Bound::new(py, self.impact_map())?;
        result(py, &map, &grid, found, told)
    }

    /// Number of attractors, the disk at rest among them.
    fn __len__(&self) -> usize {
        self.0.all().len()
    }

    /// The attractors as JSON, as the Rust library stores them.
    ///
    /// Returns
    /// -------
    /// str
    fn to_json(&self) -> PyResult<String> {
        text::stored(&self.0)
    }

    /// The attractors of such a text.
    ///
    /// Parameters
    /// ----------
    /// json : str
    ///     As of :meth:`to_json`.
    ///
    /// Returns
    /// -------
    /// Attractors
    #[staticmethod]
    fn from_json(py: Python<'_>, json: Json) -> PyResult<Self> {
        json.read(py).map(Self)
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<text::Reduced<'py>> {
        text::reduced::<Self>(py, self.to_json()?)
    }

    fn __repr__(&self) -> String {
        let all: Vec<_> = self.0.all().iter().map(|attractor| attractor.kind.to_string()).collect();
        format!("<Attractors: {}>", all.join("; "))
    }
}

/// How attractors are looked for, as Python says it.
pub(crate) struct SearchArguments {
    pub(crate) starts: Count,
    pub(crate) transient: Count,
    pub(crate) impacts: Count,
    pub(crate) longest_period: Count,
    pub(crate) cells: Count,
}

impl SearchArguments {
    /// The search, if it is legal.
    pub(crate) fn search(self, py: Python<'_>) -> PyResult<AttractorSearch> {
        let (starts, cells) = (self.starts.u32(py, "starts")?, self.cells.u32(py, "cells")?);
        let (transient, impacts) = (self.transient.u64(py, "transient")?, self.impacts.u64(py, "impacts")?);
        let longest = self.longest_period.usize(py, "longest_period")?;
        AttractorSearch::default()
            .with_starts(starts)
            .and_then(|search| {
                search.with_impacts(transient, impacts)?.with_longest_period(longest)?.with_cells(cells)
            })
            .named(&[name("longest period", &["longest_period"]), name("cells along an axis", &["cells"])])
            .map_err(|error| errors::of(py, error))
    }
}

/// The attractors of a map, without being told.
///
/// Parameters
/// ----------
/// impact_map : ImpactMap
/// starts : int, default 1024
///     Starts, spread evenly over all impacts that an attractor can have, in [0, 2^18].
/// transient : int, default 2000
///     Impacts that are not looked at, at least 1.
/// impacts : int, default 100000
///     Impacts over which one orbit of each attractor is followed that is not periodic, at least 64.
/// longest_period : int, default 256
///     The longest period, in impacts, in [1, 4096].
/// cells : int, default 256
///     Cells along each axis by which attractors are told apart that are not periodic, in [8, 4096].
/// progress : callable, optional
///     Called as ``progress(done, total)``.
///
/// Returns
/// -------
/// Attractors
///
/// Examples
/// --------
/// >>> import bouncing_disk as bd
/// >>> found = bd.attractors(bd.ImpactMap(axial_forcing=0.486, restitution=0.5))
/// >>> [attractor.orbit.period for attractor in found.all if attractor.orbit is not None]
/// [1, 4]
#[pyfunction]
#[pyo3(signature = (
    impact_map, *, starts=Count::Fits(1024), transient=Count::Fits(2000), impacts=Count::Fits(100_000),
    longest_period=Count::Fits(256), cells=Count::Fits(256), progress=ProgressCallable(None)
), text_signature = "(impact_map, *, starts=1024, transient=2000, impacts=100000, longest_period=256, cells=256, \
                     progress=None)")]
#[expect(clippy::too_many_arguments, reason = "they are keywords")]
pub(crate) fn attractors(
    py: Python<'_>,
    impact_map: &Bound<'_, ImpactMap>,
    starts: Count,
    transient: Count,
    impacts: Count,
    longest_period: Count,
    cells: Count,
    progress: ProgressCallable,
) -> PyResult<Attractors> {
    let search = SearchArguments { starts, transient, impacts, longest_period, cells }.search(py)?;
    let map = impact_map.get().map;
    long_call::run(py, progress.0, |observer| Ok(map.attractors(&search, observer)?)).map(Attractors)
}
