//! Attractors of the map, their basins on a grid and over the forcing, and measures of basins.

use bouncing_disk::core::{
    Error as CoreError,
    attractors::{
        AfterRest, AttractingMap, Attractor, AttractorKind, AttractorSearch, Attractors as AttractorsModel,
        Axis, BasinSettings, Basins, BoundaryFit, Grid, KnownOrbit, Label, RestCycle,
        basin_fractions_over as fractions_over,
    },
    orbits::PeriodicOrbit as OrbitModel,
};
use bouncing_disk::drives::DrivenMap;
use bouncing_disk::{Error, Observer, Progress};
use numpy::{PyArray2, PyArrayMethods, PyUntypedArrayMethods};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyTuple;

use crate::arguments::{Arguments, Count, Made, Real, held};
use crate::errors;
use crate::orbits::{PeriodicOrbit, shown_orbit};
use crate::parameters::{Map, on_map, python_map};
use crate::results::{array, column, holders, holding, make, matrix, room_for};

holders! {
    /// The contents of an `Attractors`.
    Attractors(AttractorsModel) = shown_attractors;
}

/// The contents of an `Attractors` on another drive, or with a compliant contact.
#[pyclass(frozen, eq, module = "bouncing_disk._native")]
#[derive(Debug, PartialEq)]
pub(crate) struct DrivenAttractors(AttractorsModel<DrivenMap>);

/// Starts on each tested circle for the radius of a known orbit.
const SAMPLES: u32 = 64;

fn shown_attractor<'py>(py: Python<'py>, label: Option<Label>, own: &Attractor) -> Made<'py> {
    let mut leads_to = None;
    let (mut radius, mut exponent, mut error) = (f64::NAN, f64::NAN, f64::NAN);
    let (mut mean_life, mut mean_life_interval) = (f64::NAN, (f64::NAN, f64::NAN));
    match &own.kind {
        AttractorKind::Rest(AfterRest::LeadsTo(other)) => leads_to = Some(*other),
        AttractorKind::Periodic(known) => radius = known.radius(),
        AttractorKind::Chaotic { exponent: growth, standard_error, .. } => {
            (exponent, error) = (*growth, *standard_error);
        }
        AttractorKind::Transient { exponent: growth, standard_error, lifetime, .. } => {
            (exponent, error) = (*growth, *standard_error);
            mean_life = lifetime.mean().unwrap_or(f64::NAN);
            mean_life_interval = lifetime.interval();
        }
        _ => {}
    }
    make!(
        py,
        "Attractor",
        own.kind.name(),
        label,
        own.kind.orbit().map(|orbit| shown_orbit(py, orbit.clone())).transpose()?,
        radius,
        exponent,
        error,
        own.kind.recurrence().map(|recurrence| recurrence.impacts),
        mean_life,
        mean_life_interval,
        own.starts.value(),
        own.starts.interval(),
        own.kind.lasts(),
        leads_to,
        own.kind.to_string(),
        own.kind.rest_cycle().is_none_or(RestCycle::is_exact),
    )
}

fn shown_attractors(py: Python<'_>, found: AttractorsModel) -> Made<'_> {
    let map = python_map(py, found.map())?;
    holding(shown_of(map, &found)?, Attractors(found))
}

fn shown_of<'py, M>(map: Bound<'py, PyAny>, found: &AttractorsModel<M>) -> Made<'py> {
    let py = map.py();
    let all = found.all().iter().enumerate();
    let all = all.map(|(number, own)| shown_attractor(py, found.label(number), own));
    let all = PyTuple::new(py, all.collect::<PyResult<Vec<_>>>()?)?;
    make!(py, "Attractors", map, all, found.undecided().value())
}

fn search(a: &Arguments<'_>) -> PyResult<AttractorSearch> {
    a.take_settings("AttractorSearch")?;
    let (starts, cells, longest) = (a.u32("starts")?, a.u32("cells")?, a.usize("longest_period")?);
    let (transient, impacts, budget) = (a.u64("transient")?, a.u64("impacts")?, a.u64("budget")?);
    AttractorSearch::default()
        .with_starts(0)
        .and_then(|search| search.with_budget(budget)?.with_starts(starts))
        .and_then(|search| {
            search.with_impacts(transient, impacts)?.with_longest_period(longest)?.with_cells(cells)
        })
        .map_err(|error| a.refused(error))
}

/// The attractors of a map.
#[pyfunction]
pub(crate) fn attractors(a: Arguments<'_>) -> Made<'_> {
    let (map, search) = (a.map()?, search(&a)?);
    let Map { sine, other, .. } = map.get();
    let Some(other) = other else {
        return shown_attractors(a.py(), a.run(|observer| Ok(sine.attractors(&search, observer)?))?);
    };
    let found = a.run(|observer| Ok(AttractorsModel::find(&other.0, &search, observer)?))?;
    holding(shown_of(a.get("impact_map")?, &found)?, DrivenAttractors(found))
}

/// The grid of the arguments.
fn grid(a: &Arguments<'_>) -> PyResult<Grid> {
    let axis = |range: &'static str, cells: &'static str| {
        let (low, high) = a.pair(range)?;
        // Both axes have the same names in the library.
        Axis::new(low, high, a.usize(cells)?).map_err(|error| match error {
            CoreError::OutOfRange { field, value, legal } => {
                errors::out_of_range(a.py(), if field == "axis cells" { cells } else { range }, value, legal)
            }
            error => a.refused(error),
        })
    };
    let (phase, speed) = (axis("phase_range", "phases")?, axis("speed_range", "speeds")?);
    Grid::new(phase, speed).map_err(|error| a.refused(error))
}

fn basin_settings(a: &Arguments<'_>) -> PyResult<BasinSettings> {
    Ok(BasinSettings { max_impacts: a.u32("max_impacts")?, policy: a.policy()? })
}

/// The basins as Python's class.
fn shown_basins<'py>(
    map: Bound<'py, PyAny>,
    grid: &Grid,
    labels: Vec<Label>,
    meaning: Vec<String>,
) -> Made<'py> {
    let py = map.py();
    let centres = |axis: &Axis| array(py, (0..axis.cells()).map(|cell| axis.centre(cell)).collect());
    let (phase, speed) = (grid.phase(), grid.speed());
    make!(
        py,
        "Basins",
        map,
        matrix(py, labels, [speed.cells(), phase.cells()])?,
        centres(phase),
        centres(speed),
        (phase.low(), phase.high()),
        (speed.low(), speed.high()),
        PyTuple::new(py, meaning)?,
    )
}

/// The labels in their own vector.
fn labels(basins: &Basins) -> Result<Vec<Label>, Error> {
    let mut labels = room_for(basins.labels().len())?;
    labels.extend_from_slice(basins.labels());
    Ok(labels)
}

/// The basins of all attractors.
#[pyfunction]
pub(crate) fn basins_of(a: Arguments<'_>) -> Made<'_> {
    let (grid, settings) = (grid(&a)?, basin_settings(&a)?);
    let (labels, meaning) = if let Ok(driven) = a.held::<DrivenAttractors>("self") {
        let found = &driven.get().0;
        (a.run(|observer| labels(&found.basins(grid, settings, observer)?))?, meaning(found.all()))
    } else {
        let found = a.held::<Attractors>("self")?;
        let found = &found.get().0;
        (a.run(|observer| labels(&found.basins(grid, settings, observer)?))?, meaning(found.all()))
    };
    shown_basins(a.get("self")?.getattr("impact_map")?, &grid, labels, meaning)
}

/// The meanings of the labels of these attractors.
fn meaning(all: &[Attractor]) -> Vec<String> {
    let words = all.iter().map(|attractor| attractor.kind.to_string());
    std::iter::once("undecided".to_owned()).chain(words).collect()
}

/// The orbits of the argument `known_orbits`, each with a radius if one is given.
fn known_orbits(known: &Bound<'_, PyAny>) -> PyResult<Vec<(OrbitModel, Option<f64>)>> {
    const WRONG: &str = "known_orbits must hold orbits, or pairs of an orbit and a radius";
    let mut orbits = Vec::new();
    for item in known.try_iter()? {
        let item = item?;
        let pair = item.extract::<(Bound<'_, PyAny>, Real)>();
        let (orbit, radius) = pair.map_or((item, None), |(orbit, radius)| (orbit, Some(radius.0)));
        let orbit = held::<PeriodicOrbit>(&orbit, "known_orbits").map_err(|_| PyTypeError::new_err(WRONG))?;
        orbits.push((orbit.get().0.clone(), radius));
    }
    Ok(orbits)
}

/// An orbit with its radius, which is computed if it is not given.
fn known(
    map: &impl AttractingMap,
    (orbit, radius): (OrbitModel, Option<f64>),
    observer: &dyn Observer,
) -> Result<KnownOrbit, Error> {
    // The progress of the search does not predict that of the rows.
    let quiet = |progress: Progress| observer.observe(Progress { done: 0, ..progress });
    let radius = match radius {
        Some(radius) => radius,
        None => orbit.trapping_radius(map, SAMPLES, &quiet)?,
    };
    Ok(KnownOrbit::new(orbit, radius)?)
}

/// The basins of known orbits.
#[pyfunction]
pub(crate) fn basins(a: Arguments<'_>) -> Made<'_> {
    let (map, grid, settings) = (a.map()?, grid(&a)?, basin_settings(&a)?);
    let orbits = a.given("known_orbits")?.map_or_else(|| Ok(Vec::new()), |known| known_orbits(&known))?;
    let mut meaning = vec!["undecided".to_owned(), "comes to rest".to_owned()];
    meaning.extend(orbits.iter().map(|(orbit, _)| {
        format!("periodic orbit: impacts {}, platform periods {}", orbit.period(), orbit.platform_periods)
    }));
    let map = map.get();
    let labels = a.run(|observer| {
        on_map!(map, |map| {
            let known = orbits.into_iter().map(|orbit| known(map, orbit, observer));
            let known = known.collect::<Result<Vec<_>, _>>()?;
            labels(&map.basins(grid, &known, settings, observer)?)
        })
    })?;
    shown_basins(a.get("impact_map")?, &grid, labels, meaning)
}

/// The basins of a result of these calls.
fn given_basins(a: &Arguments<'_>) -> PyResult<Basins> {
    let wrong = || PyTypeError::new_err("basins must be a Basins, made by basins() or Attractors.basins()");
    let labels = a.get("basins")?.getattr("labels").map_err(|_| wrong())?;
    let labels = labels.cast_into::<PyArray2<u8>>().map_err(|_| wrong())?.readonly();
    let columns = labels.shape()[1];
    let mut all = room_for(labels.len()).map_err(|error| a.refused(error))?;
    all.extend(labels.as_array().iter());
    Basins::of_labels(all, columns).map_err(|error| a.refused(error))
}

/// The entropy of basins.
#[pyfunction]
pub(crate) fn basin_entropy(a: Arguments<'_>) -> Made<'_> {
    let (side, basins) = (a.usize("box_side")?, given_basins(&a)?);
    let found = a.run(|_| Ok(basins.entropy(side)?))?;
    make!(
        a.py(),
        "BasinEntropy",
        found.box_side,
        found.boxes,
        found.boundary_boxes,
        found.undecided_cells,
        found.labels,
        found.entropy,
        found.boundary_entropy,
    )
}

/// How the share of uncertain cells grows with their distance.
#[pyfunction]
pub(crate) fn boundary_scaling(a: Arguments<'_>) -> Made<'_> {
    let (mut distances, py) = (Vec::new(), a.py());
    for distance in a.get("distances")?.try_iter()? {
        distances.push(distance?.extract::<Count>()?.u32(py, "distances")? as usize);
    }
    let basins = given_basins(&a)?;
    let found = a.run(|observer| Ok(basins.boundary_scaling(&distances, observer)?))?;
    let none = f64::NAN;
    let (fit, exponent, error, dimension, slopes) = match found.fit {
        BoundaryFit::PowerLaw { exponent, standard_error, dimension, slopes } => {
            ("power-law", exponent, standard_error, dimension, slopes)
        }
        BoundaryFit::NoPowerLaw { slopes } => ("no-power-law", none, none, none, slopes),
        _ => ("too-few", none, none, none, (none, none)),
    };
    let shares = &found.shares;
    make!(
        py,
        "BoundaryScaling",
        column(py, shares, |share| share.distance as i64),
        column(py, shares, |share| share.uncertain.count() as i64),
        shares.first().map_or(0, |share| share.uncertain.of()),
        fit,
        exponent,
        error,
        dimension,
        slopes,
    )
}

/// Attractors and the shares of their basins, followed over the forcing.
#[pyfunction]
pub(crate) fn basin_fractions_over(a: Arguments<'_>) -> Made<'_> {
    let (restitution, forcings, py) = (a.real("restitution")?, a.row("axial_forcing")?, a.py());
    let (search, reach) = (search(&a)?, a.real("reach")?);
    let found = a.run(|observer| Ok(fractions_over(restitution, &forcings, &search, reach, observer)?))?;
    let (attractors, forcings) = (found.followed.len(), found.at.len());
    // A number of each attractor at each forcing, NaN where the attractor is absent.
    let table = |of: &dyn Fn(&Attractor) -> f64| {
        let rows =
            (0..attractors).flat_map(|number| found.over(number).map(|(_, own)| own.map_or(f64::NAN, of)));
        matrix(py, rows.collect(), [attractors, forcings])
    };
    let mut moved = vec![f64::NAN; attractors * forcings];
    for (index, at) in found.at.iter().enumerate() {
        for (own, by) in at.followed.iter().zip(&at.moved) {
            moved[own * forcings + index] = by.unwrap_or(f64::NAN);
        }
    }
    let each = found.at.iter().map(|at| shown_attractors(py, at.attractors.clone()));
    make!(
        py,
        "BasinFractions",
        found.restitution,
        column(py, &found.at, |at| at.axial_forcing),
        PyTuple::new(py, each.collect::<PyResult<Vec<_>>>()?)?,
        PyTuple::new(py, found.at.iter().map(|at| column(py, &at.followed, |own| *own as i64)))?,
        column(py, &found.followed, |own| own.appears as i64),
        column(py, &found.followed, |own| own.vanishes as i64),
        table(&|own| own.starts.value())?,
        table(&|own| own.starts.interval().0)?,
        table(&|own| own.starts.interval().1)?,
        matrix(py, moved, [attractors, forcings])?,
    )
}
