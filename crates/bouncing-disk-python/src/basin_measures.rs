//! Measures of basins: their entropy, and the dimension of their boundary.

use bouncing_disk::core::{Basins, BoundaryFit, BoundaryScaling};
use numpy::{PyArray2, PyArrayMethods, PyUntypedArrayMethods};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;

use crate::arguments::{Count, ProgressCallable};
use crate::diagram::room_for;
use crate::names::{Name, name};
use crate::{errors, long_call, results};

/// What the library calls the argument of an entropy, and the grid that both measures have.
const ENTROPY: [Name; 3] = [
    name("cells along a box", &["box_side"]),
    name("columns of basins", &["basins"]),
    name("label of basins", &["basins"]),
];
/// The same of a scaling.
const SCALING: [Name; 3] = [
    name("distance of cells", &["distances"]),
    name("columns of basins", &["basins"]),
    name("label of basins", &["basins"]),
];

/// The basins of a result of :func:`basins`.
fn basins_of(py: Python<'_>, basins: &Bound<'_, PyAny>, names: &[Name]) -> PyResult<Basins> {
    let wrong = || PyTypeError::new_err("basins must be a Basins, as of basins() and Attractors.basins()");
    let labels = basins.getattr("labels").map_err(|_| wrong())?;
    let labels = labels.cast_into::<PyArray2<u8>>().map_err(|_| wrong())?.readonly();
    let columns = labels.shape()[1];
    let fail = |error| errors::of_named(py, error, names);
    let mut all = room_for(labels.len()).map_err(fail)?;
    all.extend(labels.as_array().iter());
    Basins::of_labels(all, columns).map_err(|error| fail(error.into()))
}

/// The entropy of basins: how uncertain the end of a start is that is known up to a box of cells.
///
/// A. Daza and others, Sci. Rep. 6, 31416 (2016). A boundary entropy above ln 2 says that the boundary is not
/// smooth, where boxes are small beside the basins; a smaller one says nothing.
///
/// Parameters
/// ----------
/// basins : Basins
///     As of :func:`basins` and :meth:`Attractors.basins`; undecided cells count as a basin of their own.
/// box_side : int, default 5
///     Cells along each side of a box, at least 2 and at most those of the shorter side of the grid.
///
/// Returns
/// -------
/// BasinEntropy
///
/// Examples
/// --------
/// >>> import bouncing_disk as bd
/// >>> found = bd.attractors(bd.ImpactMap(axial_forcing=0.34, restitution=0.5))
/// >>> entropy = bd.basin_entropy(found.basins(phases=100, speeds=100))
/// >>> entropy.boxes, entropy.boundary_boxes > 0
/// (400, True)
#[pyfunction]
#[pyo3(signature = (basins, *, box_side=Count::Fits(5)), text_signature = "(basins, *, box_side=5)")]
pub(crate) fn basin_entropy<'py>(
    py: Python<'py>,
    basins: &Bound<'py, PyAny>,
    box_side: Count,
) -> PyResult<Bound<'py, PyAny>> {
    let side = box_side.usize(py, "box_side")?;
    let basins = basins_of(py, basins, &ENTROPY)?;
    let found = long_call::run_named(py, None, &ENTROPY, |_| Ok(basins.entropy(side)?))?;
    let fields = (
        found.box_side,
        found.boxes,
        found.boundary_boxes,
        found.undecided_cells,
        found.labels,
        found.entropy,
        found.boundary_entropy,
    );
    results::make(py, "BasinEntropy", fields)
}

/// How the share of uncertain cells grows with their distance: the dimension of a boundary of basins.
///
/// S. W. McDonald and others, Physica D 17, 125 (1985). A cell is uncertain if there is another label than
/// its own in the square up to a distance along both axes. The cells that count are those farther from the
/// edges of the grid than the largest distance; undecided cells count as a basin of their own.
///
/// Parameters
/// ----------
/// basins : Basins
///     As of :func:`basins` and :meth:`Attractors.basins`.
/// distances : iterable of int, default (1, 2, 4, 8)
///     Distances in cells, rising from 1 at least, the last less than half the shorter side of the grid.
/// progress : callable, optional
///     Called as ``progress(done, total)`` with the number of rows of cells, once for each distance.
///
/// Returns
/// -------
/// BoundaryScaling
///
/// Examples
/// --------
/// The basin of the period-1 orbit just beyond its birth has a smooth boundary:
///
/// >>> import bouncing_disk as bd
/// >>> found = bd.attractors(bd.ImpactMap(axial_forcing=0.34, restitution=0.5))
/// >>> grid = found.basins(phases=120, speeds=120, max_impacts=20_000)
/// >>> scaling = bd.boundary_scaling(grid, distances=[1, 2, 4])
/// >>> scaling.fit, scaling.dimension < 1.2
/// ('power-law', True)
#[pyfunction]
#[pyo3(signature = (basins, *, distances=None, progress=ProgressCallable(None)),
       text_signature = "(basins, *, distances=(1, 2, 4, 8), progress=None)")]
pub(crate) fn boundary_scaling<'py>(
    py: Python<'py>,
    basins: &Bound<'py, PyAny>,
    distances: Option<&Bound<'py, PyAny>>,
    progress: ProgressCallable,
) -> PyResult<Bound<'py, PyAny>> {
    let mut all = Vec::new();
    match distances {
        Some(distances) => {
            for distance in distances.try_iter()? {
                all.push(distance?.extract::<Count>()?.usize(py, "distances")?);
            }
        }
        None => all.extend([1, 2, 4, 8]),
    }
    let basins = basins_of(py, basins, &SCALING)?;
    let found = long_call::run_named(py, progress.0, &SCALING, |observer| {
        Ok(basins.boundary_scaling(&all, observer)?)
    })?;
    made(py, &found)
}

fn made<'py>(py: Python<'py>, found: &BoundaryScaling) -> PyResult<Bound<'py, PyAny>> {
    const NONE: (f64, f64) = (f64::NAN, f64::NAN);
    let (fit, exponent, error, dimension, slopes) = match found.fit {
        BoundaryFit::PowerLaw { exponent, standard_error, dimension, slopes } => {
            ("power-law", exponent, standard_error, dimension, slopes)
        }
        BoundaryFit::NoPowerLaw { slopes } => ("no-power-law", f64::NAN, f64::NAN, f64::NAN, slopes),
        _ => ("too-few", f64::NAN, f64::NAN, f64::NAN, NONE),
    };
    let shares = &found.shares;
    let fields = (
        results::array(py, shares.iter().map(|share| share.distance as i64).collect()),
        results::array(py, shares.iter().map(|share| share.uncertain.count() as i64).collect()),
        shares.first().map_or(0, |share| share.uncertain.of()),
        fit,
        exponent,
        error,
        dimension,
        slopes,
    );
    results::make(py, "BoundaryScaling", fields)
}
