//! Basins of attraction on a grid.

use bouncing_disk::core::{
    Axis, BasinSettings, Basins, Grid, ImpactMap as Map, KnownOrbit, Label, PeriodicOrbit as Orbit,
};
use bouncing_disk::{Error, Observer, Progress};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyTuple;

use crate::arguments::{Count, ProgressCallable};
use crate::chatter::{ChatterCut, policy};
use crate::diagram::room_for;
use crate::impact_map::ImpactMap;
use crate::names::{Name, Named, name};
use crate::periodic_orbit::PeriodicOrbit;
use crate::real::{Pair, Real};
use crate::{errors, long_call, results};

/// Starts on each circle that is tried for the radius of a known orbit.
const SAMPLES: u32 = 64;

/// What the library calls the ends and the cells of an axis of phases.
const PHASE_AXIS: [Name; 4] = [
    name("axis low end", &["phase_range"]),
    name("axis high end", &["phase_range"]),
    name("axis cells", &["phases"]),
    name("impact phase", &["phase_range"]),
];
/// The same of speeds.
const SPEED_AXIS: [Name; 5] = [
    name("axis low end", &["speed_range"]),
    name("axis high end", &["speed_range"]),
    name("axis cells", &["speeds"]),
    name("lowest normalised speed", &["speed_range"]),
    name("highest normalised speed", &["speed_range"]),
];

/// A grid as Python gives it.
pub(crate) struct GridArguments {
    pub(crate) phases: Count,
    pub(crate) phase_range: Pair,
    pub(crate) speeds: Count,
    pub(crate) speed_range: Pair,
}

impl GridArguments {
    /// The grid, if it is legal.
    pub(crate) fn grid(self, py: Python<'_>) -> PyResult<Grid> {
        let (phases, speeds) = (self.phases.usize(py, "phases")?, self.speeds.usize(py, "speeds")?);
        let axis = |range: Pair, cells, names: &[Name]| Axis::new(range.0, range.1, cells).named(names);
        let grid = axis(self.phase_range, phases, &PHASE_AXIS).and_then(|phase| {
            let speed = axis(self.speed_range, speeds, &SPEED_AXIS)?;
            Grid::new(phase, speed).named(&SPEED_AXIS).named(&PHASE_AXIS)
        });
        grid.map_err(|error| errors::of(py, error))
    }
}

/// The basins as Python has them.
pub(crate) fn result<'py>(
    py: Python<'py>,
    impact_map: &Bound<'py, ImpactMap>,
    grid: &Grid,
    labels: Vec<Label>,
    meaning: Vec<String>,
) -> PyResult<Bound<'py, PyAny>> {
    let centres = |axis: &Axis| (0..axis.cells()).map(|cell| axis.centre(cell)).collect();
    let labels = results::matrix(py, labels, [grid.speed().cells(), grid.phase().cells()])?;
    let (phase, speed) =
        (results::array(py, centres(grid.phase())), results::array(py, centres(grid.speed())));
    let range = |axis: &Axis| (axis.low(), axis.high());
    let (phases, speeds) = (range(grid.phase()), range(grid.speed()));
    let meaning = PyTuple::new(py, meaning)?;
    results::make(py, "Basins", (impact_map, labels, phase, speed, phases, speeds, meaning))
}

/// The labels in a vector of their own.
pub(crate) fn labels(basins: &Basins) -> Result<Vec<Label>, Error> {
    let mut labels = room_for(basins.labels().len())?;
    labels.extend_from_slice(basins.labels());
    Ok(labels)
}

/// What is told of a periodic orbit by a label.
pub(crate) fn told(orbit: &Orbit) -> String {
    format!("periodic orbit: impacts {}, platform periods {}", orbit.period(), orbit.platform_periods)
}

/// The orbits of an argument, each with a radius if one is given.
fn known_orbits(known: &Bound<'_, PyAny>) -> PyResult<Vec<(Orbit, Option<f64>)>> {
    let mut orbits = Vec::new();
    for item in known.try_iter()? {
        let item = item?;
        orbits.push(if let Ok(orbit) = item.cast::<PeriodicOrbit>() {
            (orbit.get().0.clone(), None)
        } else if let Ok((orbit, radius)) = item.extract::<(Bound<'_, PeriodicOrbit>, Real)>() {
            (orbit.get().0.clone(), Some(radius.0))
        } else {
            return Err(PyTypeError::new_err(
                "known_orbits must hold orbits, or pairs of an orbit and a radius",
            ));
        });
    }
    Ok(orbits)
}

/// An orbit with its radius, which is sought where it is not given.
fn known(
    map: &Map,
    (orbit, radius): (Orbit, Option<f64>),
    observer: &dyn Observer,
) -> Result<KnownOrbit, Error> {
    // How far the search is says nothing about the rows that are to come.
    let quiet = |progress: Progress| observer.observe(Progress { done: 0, ..progress });
    let radius = match radius {
        Some(radius) => radius,
        None => orbit.trapping_radius(map, SAMPLES, &quiet)?,
    };
    Ok(KnownOrbit::new(orbit, radius)?)
}

/// Which starts come to rest and which end on known periodic orbits, on a grid of impacts.
///
/// :func:`attractors` finds the orbits by itself; its ``basins`` are of all attractors.
///
/// Parameters
/// ----------
/// impact_map : ImpactMap
/// phases : int, default 400
///     Cells along the impact phase, up to 100000.
/// phase_range : (float, float), default (0, 1)
///     Lowest and highest impact phase, in periods.
/// speeds : int, default 300
///     Cells along the normalised impact speed, up to 100000.
/// speed_range : (float, float), default (0, 3)
///     Lowest and highest normalised speed.
/// known_orbits : iterable, optional
///     Attracting orbits, at most 250, each a :class:`PeriodicOrbit` or a pair of one and the radius (rad)
///     within which a start counts as caught; without a radius it is the
///     :meth:`PeriodicOrbit.trapping_radius`.
/// max_impacts : int, default 2000
///     Impacts after which a start is left undecided.
/// chatter : ChatterCut, optional
///     How a chatter ends; ``None`` sums it.
/// progress : callable, optional
///     Called as ``progress(done, total)`` with the number of rows.
///
/// Returns
/// -------
/// Basins
///
/// Examples
/// --------
/// >>> import bouncing_disk as bd
/// >>> bouncing = bd.ImpactMap(axial_forcing=0.34, restitution=0.5)
/// >>> phase, velocity = bouncing.period_one()
/// >>> orbit = bouncing.refine(impact_phase=[phase], axial_impact_velocity=[velocity])
/// >>> basins = bd.basins(bouncing, phases=64, speeds=20, speed_range=(0.0, 5.0), known_orbits=[orbit])
/// >>> basins.labels.shape, basins.labels.dtype
/// ((20, 64), dtype('uint8'))
/// >>> basins.share(bd.FIRST_ORBIT) + basins.share(bd.ATTACHED)
/// 1.0
#[pyfunction]
#[pyo3(signature = (
    impact_map, *, phases=Count::Fits(400), phase_range=Pair(0.0, 1.0), speeds=Count::Fits(300),
    speed_range=Pair(0.0, 3.0), known_orbits=None, max_impacts=Count::Fits(2000), chatter=None,
    progress=ProgressCallable(None)
), text_signature = "(impact_map, *, phases=400, phase_range=(0.0, 1.0), speeds=300, speed_range=(0.0, 3.0), \
                     known_orbits=None, max_impacts=2000, chatter=None, progress=None)")]
#[expect(clippy::too_many_arguments, reason = "they are keywords")]
pub(crate) fn basins<'py>(
    py: Python<'py>,
    impact_map: &Bound<'py, ImpactMap>,
    phases: Count,
    phase_range: Pair,
    speeds: Count,
    speed_range: Pair,
    known_orbits: Option<&Bound<'py, PyAny>>,
    max_impacts: Count,
    chatter: Option<&Bound<'py, ChatterCut>>,
    progress: ProgressCallable,
) -> PyResult<Bound<'py, PyAny>> {
    let grid = GridArguments { phases, phase_range, speeds, speed_range }.grid(py)?;
    let settings =
        BasinSettings { max_impacts: max_impacts.u32(py, "max_impacts")?, policy: policy(chatter) };
    let orbits = known_orbits.map_or_else(|| Ok(Vec::new()), self::known_orbits)?;
    let mut meaning = vec!["undecided".to_owned(), "comes to rest".to_owned()];
    meaning.extend(orbits.iter().map(|(orbit, _)| told(orbit)));
    let map = impact_map.get().map;
    let names = [
        name("attraction radius", &["known_orbits"]),
        name("number of known orbits", &["known_orbits"]).legal("[0, 250] orbits"),
    ];
    let labels = long_call::run_named(py, progress.0, &names, |observer| {
        let known = orbits.into_iter().map(|orbit| known(&map, orbit, observer));
        let known = known.collect::<Result<Vec<_>, _>>()?;
        labels(&map.basins(grid, &known, settings, observer)?)
    })?;
    result(py, impact_map, &grid, labels, meaning)
}
