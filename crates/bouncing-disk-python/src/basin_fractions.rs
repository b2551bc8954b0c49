//! Attractors and the shares of their basins, followed over the forcing.

use bouncing_disk::core::{Attractor, AttractorSearch, BasinFractions as Followed, basin_fractions_over};
use numpy::{PyArray1, PyArray2};
use pyo3::prelude::*;
use pyo3::types::PyTuple;

use crate::arguments::{Count, ProgressCallable, row};
use crate::attractors::{Attractors, SearchArguments};
use crate::names::{Name, name};
use crate::real::Real;
use crate::text::Json;
use crate::{long_call, results, text};

/// What the library calls the arguments.
const NAMES: [Name; 1] = [name("distance from one forcing to the next", &["reach"])];

/// The attractors of impact maps over the axial forcing, each followed from one forcing to the next, with the
/// shares of their basins.
///
/// Made by :func:`basin_fractions_over`. There are n forcings and m attractors; number 0 is the disk at rest.
#[pyclass(frozen, eq, module = "bouncing_disk")]
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct BasinFractions(Followed);

impl BasinFractions {
    /// A number of each attractor at each forcing, NaN where it is not there.
    fn table<'py>(
        &self,
        py: Python<'py>,
        of: impl Fn(&Attractor) -> f64,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let (attractors, forcings) = (self.0.followed.len(), self.0.at.len());
        let mut numbers = Vec::with_capacity(attractors * forcings);
        for number in 0..attractors {
            numbers.extend(self.0.over(number).map(|(_, own)| own.map_or(f64::NAN, &of)));
        }
        results::matrix(py, numbers, [attractors, forcings])
    }
}

#[pymethods]
impl BasinFractions {
    /// Coefficient of restitution.
    #[getter]
    fn restitution(&self) -> f64 {
        self.0.restitution
    }

    /// Axial forcing parameter Gamma, in the order in which they were followed, shape (n,).
    #[getter]
    fn axial_forcing<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        results::array(py, self.0.at.iter().map(|at| at.axial_forcing).collect())
    }

    /// What there is at each forcing: a tuple of n :class:`Attractors`.
    #[getter]
    fn attractors<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        let all = self.0.at.iter().map(|at| Bound::new(py, Attractors(at.attractors.clone())));
        PyTuple::new(py, all.collect::<PyResult<Vec<_>>>()?)
    }

    /// Which of the m attractors each of those at a forcing is: a tuple of n int64 arrays.
    #[getter]
    fn followed<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        let numbers = |own: &[usize]| results::array(py, own.iter().map(|own| *own as i64).collect());
        PyTuple::new(py, self.0.at.iter().map(|at| numbers(&at.followed)))
    }

    /// The first forcing at which each attractor was found, by its number, shape (m,): it appears between
    /// this one and the one before.
    #[getter]
    fn appears<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<i64>> {
        results::array(py, self.0.followed.iter().map(|own| own.appears as i64).collect())
    }

    /// The last forcing at which each was found, by its number, shape (m,): it vanishes between this one and
    /// the next.
    #[getter]
    fn vanishes<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<i64>> {
        results::array(py, self.0.followed.iter().map(|own| own.vanishes as i64).collect())
    }

    /// Share of the starts that end on each attractor at each forcing, shape (m, n); NaN where it is not
    /// there. The starts are spread over all impacts that an attractor can have at this forcing.
    #[getter]
    fn share<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        self.table(py, |own| own.starts.value())
    }

    /// Low end of its 95 % interval, shape (m, n).
    #[getter]
    fn share_low<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        self.table(py, |own| own.starts.interval().0)
    }

    /// High end of its 95 % interval, shape (m, n).
    #[getter]
    fn share_high<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        self.table(py, |own| own.starts.interval().1)
    }

    /// How far each attractor is from where it was at the forcing before (rad; a radian counts as much as the
    /// peak velocity of the platform), shape (m, n); NaN where it appears or is not there, and of the disk at
    /// rest.
    #[getter]
    fn moved<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let (attractors, forcings) = (self.0.followed.len(), self.0.at.len());
        let mut numbers = vec![f64::NAN; attractors * forcings];
        for (index, at) in self.0.at.iter().enumerate() {
            for (own, moved) in at.followed.iter().zip(&at.moved) {
                numbers[own * forcings + index] = moved.unwrap_or(f64::NAN);
            }
        }
        results::matrix(py, numbers, [attractors, forcings])
    }

    /// These with the attractors at more forcings, which follow those that are there: the very same as if all
    /// had been given at once.
    ///
    /// Parameters
    /// ----------
    /// axial_forcing : (k,) array_like
    ///     More values of Gamma.
    /// reach, starts, transient, impacts, longest_period, cells : optional
    ///     As of :func:`basin_fractions_over`.
    /// progress : callable, optional
    ///     Called as ``progress(done, total)`` with the number of forcings.
    ///
    /// Returns
    /// -------
    /// BasinFractions
    #[pyo3(signature = (
        *, axial_forcing, reach=Real(0.3), starts=Count::Fits(1024), transient=Count::Fits(2000),
        impacts=Count::Fits(100_000), longest_period=Count::Fits(256), cells=Count::Fits(256),
        progress=ProgressCallable(None)
    ), text_signature = "($self, /, *, axial_forcing, reach=0.3, starts=1024, transient=2000, impacts=100000, \
                         longest_period=256, cells=256, progress=None)")]
    #[expect(clippy::too_many_arguments, reason = "they are keywords")]
    fn extended(
        &self,
        py: Python<'_>,
        axial_forcing: &Bound<'_, PyAny>,
        reach: Real,
        starts: Count,
        transient: Count,
        impacts: Count,
        longest_period: Count,
        cells: Count,
        progress: ProgressCallable,
    ) -> PyResult<Self> {
        let forcings = row(axial_forcing, "axial_forcing")?;
        let search: AttractorSearch =
            SearchArguments { starts, transient, impacts, longest_period, cells }.search(py)?;
        long_call::run_named(py, progress.0, &NAMES, |observer| {
            Ok(self.0.extended(&forcings, &search, reach.0, observer)?)
        })
        .map(Self)
    }

    /// The number of attractors that were followed.
    fn __len__(&self) -> usize {
        self.0.followed.len()
    }

    /// All of it as JSON, as the Rust library stores it.
    ///
    /// Returns
    /// -------
    /// str
    fn to_json(&self) -> PyResult<String> {
        text::stored(&self.0)
    }

    /// The object of such a text.
    ///
    /// Parameters
    /// ----------
    /// json : str
    ///     As of :meth:`to_json`.
    ///
    /// Returns
    /// -------
    /// BasinFractions
    #[staticmethod]
    fn from_json(py: Python<'_>, json: Json) -> PyResult<Self> {
        json.read(py).map(Self)
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<text::Reduced<'py>> {
        text::reduced::<Self>(py, self.to_json()?)
    }

    fn __repr__(&self) -> String {
        let plural =
            |count: usize, what: &str| format!("{count} {what}{}", if count == 1 { "" } else { "s" });
        format!(
            "<BasinFractions of {} over {}>",
            plural(self.0.followed.len(), "attractor"),
            plural(self.0.at.len(), "forcing")
        )
    }
}

/// The attractors at each of some forcings, which is which, and the shares of their basins.
///
/// Each attractor is the one of the forcing before that is nearest to it, if it is within `reach`; one
/// without such a neighbour appears, and one that is nobody's vanishes. An orbit that doubles its period goes
/// on as the doubled one.
///
/// Parameters
/// ----------
/// restitution : float
///     Coefficient of restitution, in [0, 1).
/// axial_forcing : (n,) array_like
///     Axial forcing parameter Gamma, in the order in which attractors are to be followed; at most 65536.
/// reach : float, default 0.3
///     How far an attractor may be from where it was at the forcing before (rad), in [0, 100].
/// starts, transient, impacts, longest_period, cells : optional
///     As of :func:`attractors`.
/// progress : callable, optional
///     Called as ``progress(done, total)`` with the number of forcings.
///
/// Returns
/// -------
/// BasinFractions
///
/// Examples
/// --------
/// The period-1 orbit appears at Gamma = 1/3; beside it there is the disk at rest:
///
/// >>> import bouncing_disk as bd
/// >>> found = bd.basin_fractions_over(restitution=0.5, axial_forcing=[0.32, 0.36, 0.4], starts=200)
/// >>> found.appears
/// array([0, 1])
/// >>> found.share.shape, bool(found.share[1, 2] > found.share[1, 1])
/// ((2, 3), True)
#[pyfunction]
#[pyo3(signature = (
    *, restitution, axial_forcing, reach=Real(0.3), starts=Count::Fits(1024), transient=Count::Fits(2000),
    impacts=Count::Fits(100_000), longest_period=Count::Fits(256), cells=Count::Fits(256),
    progress=ProgressCallable(None)
), text_signature = "(*, restitution, axial_forcing, reach=0.3, starts=1024, transient=2000, impacts=100000, \
                     longest_period=256, cells=256, progress=None)")]
#[expect(clippy::too_many_arguments, reason = "they are keywords")]
pub(crate) fn basin_fractions_over(
    py: Python<'_>,
    restitution: Real,
    axial_forcing: &Bound<'_, PyAny>,
    reach: Real,
    starts: Count,
    transient: Count,
    impacts: Count,
    longest_period: Count,
    cells: Count,
    progress: ProgressCallable,
) -> PyResult<BasinFractions> {
    let forcings = row(axial_forcing, "axial_forcing")?;
    let search = SearchArguments { starts, transient, impacts, longest_period, cells }.search(py)?;
    let found = long_call::run_named(py, progress.0, &NAMES, |observer| {
        Ok(basin_fractions_over(restitution.0, &forcings, &search, reach.0, observer)?)
    });
    found.map(BasinFractions)
}
