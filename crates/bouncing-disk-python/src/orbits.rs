//! Orbits of the impact map: its steps, periodic orbits, their branches and doublings.

use bouncing_disk::core::{
    BouncingMap as _, ImpactMap, ImpactState, Vibration,
    attractors::AttractingMap as _,
    orbits::{
        BifurcationKind, Branch as BranchModel, BranchEnd, BranchPoint, ClosingMap as _, Continuation,
        ContinuationParameter, ContinuedMap, Curve as CurveModel, CurveEnd, OrbitSearch,
        PeriodicOrbit as OrbitModel, SpecialKind, Stability, doubling_cascade as doubling_cascade_of,
        feigenbaum_estimates,
    },
};
use bouncing_disk::drives::{DrivenFamily, driven_doubling_cascade};
use pyo3::prelude::*;
use pyo3::types::PyTuple;

use crate::arguments::{Arguments, Made, common_length, first_impact};
use crate::errors;
use crate::parameters::{Map, on_map, pair, state};
use crate::results::{array, column, complex, holders, holding, make, matrix};

holders! {
    /// The contents of a `PeriodicOrbit`.
    PeriodicOrbit(OrbitModel) = shown_orbit;
    /// The contents of a `Branch`.
    Branch(BranchModel) = shown_own_branch;
}

/// The contents of a `Branch` on another drive, or with a compliant contact, and the number that is varied.
#[pyclass(frozen, eq, module = "bouncing_disk._native")]
#[derive(Debug, PartialEq)]
pub(crate) struct DrivenBranch(BranchModel<DrivenFamily>, String);

/// A periodic orbit for Python.
pub(crate) fn shown_orbit(py: Python<'_>, orbit: OrbitModel) -> Made<'_> {
    let states = &orbit.states;
    let (x, y) = (orbit.monodromy.x_axis, orbit.monodromy.y_axis);
    let made = make!(
        py,
        "PeriodicOrbit",
        column(py, states, |state| state.phase().angle()),
        column(py, states, |state| state.velocity()),
        column(py, states, |state| state.normalised_speed()),
        orbit.period(),
        orbit.platform_periods,
        matrix(py, vec![x.x, y.x, x.y, y.y], [2, 2])?,
        array(py, complex(orbit.multipliers()).to_vec()),
        orbit.stability() == Stability::Stable,
        orbit.stability().to_string(),
    )?;
    holding(made, PeriodicOrbit(orbit))
}

/// The impact that is so many steps later.
#[pyfunction]
pub(crate) fn iterate(a: Arguments<'_>) -> PyResult<(f64, f64)> {
    let (map, impacts) = (a.map()?, a.u64("impacts")?);
    let (phase, velocity) = (a.real("impact_phase")?, a.real("axial_impact_velocity")?);
    let map = map.get();
    a.run(|observer| {
        let start = state(phase, velocity)?;
        Ok(pair(on_map!(map, |map| map.iterate(start, impacts, observer)?)))
    })
}

/// The periodic orbit near a guess.
#[pyfunction]
pub(crate) fn refine(a: Arguments<'_>) -> Made<'_> {
    let (map, phases) = (a.map()?, a.row("impact_phase")?);
    let velocities = a.numbers("axial_impact_velocity")?;
    common_length(&[("impact_phase", Some(phases.len())), ("axial_impact_velocity", velocities.len())])?;
    let map = map.get();
    let orbit = a.run(|_| {
        let impacts = phases.iter().enumerate().map(|(index, phase)| state(*phase, velocities.get(index)));
        let guess = impacts.collect::<Result<Vec<_>, _>>()?;
        Ok(on_map!(map, |map| map.refine(&guess)?))
    })?;
    shown_orbit(a.py(), orbit)
}

/// The attracting orbit that a start settles on.
#[pyfunction]
pub(crate) fn settled_orbit(a: Arguments<'_>) -> PyResult<Option<Bound<'_, PyAny>>> {
    let (map, phase, speed) = (a.map()?, a.real("impact_phase")?, a.real("normalised_speed")?);
    let (transient, longest) = (a.usize("transient")?, a.usize("longest_period")?);
    let (tolerance, map) = (a.real("tolerance")?, map.get());
    let orbit = a.run(|observer| {
        let start = first_impact(phase, speed)?;
        Ok(on_map!(map, |map| map.settled_orbit(start, transient, longest, tolerance, observer)?))
    })?;
    orbit.map(|orbit| shown_orbit(a.py(), orbit)).transpose()
}

/// The radius within which a start counts as caught by an orbit.
#[pyfunction]
pub(crate) fn trapping_radius(a: Arguments<'_>) -> PyResult<f64> {
    let (map, orbit) = (a.map()?, a.held::<PeriodicOrbit>("self")?);
    let (orbit, samples) = (&orbit.get().0, a.count("samples", 1 << 20, "[1, 1048576]")? as u32);
    let map = map.get();
    a.run(|observer| Ok(on_map!(map, |map| orbit.trapping_radius(map, samples, observer)?)))
}

/// The periodic orbits of few impacts.
#[pyfunction]
pub(crate) fn periodic_orbits(a: Arguments<'_>) -> PyResult<Vec<Bound<'_, PyAny>>> {
    let (map, impacts, periods) = (a.map()?, a.usize("max_impacts")?, a.u64("max_platform_periods")?);
    let (phases, speeds) = (a.u32("phases")?, a.u32("speeds")?);
    let search = OrbitSearch::new(impacts, periods).and_then(|search| search.with_starts(phases, speeds));
    let search = search.map_err(|error| a.refused(error))?;
    let map = map.get();
    let orbits = a.run(|observer| Ok(on_map!(map, |map| map.orbits_found(&search, observer)?)))?;
    orbits.into_iter().map(|orbit| shown_orbit(a.py(), orbit)).collect()
}

/// The words of a continuation's parameter.
const PARAMETERS: [(&str, ContinuationParameter); 2] =
    [("axial_forcing", ContinuationParameter::Forcing), ("restitution", ContinuationParameter::Restitution)];

/// The name of a kind, and the impact that it refers to.
fn kind(kind: BifurcationKind) -> (String, Option<usize>) {
    let impact = match kind {
        BifurcationKind::Graze { flight } => Some(flight),
        BifurcationKind::VanishingImpact { impact } | BifurcationKind::BorderCollision { impact } => {
            Some(impact)
        }
        _ => None,
    };
    (kind.name().replace(' ', "-"), impact)
}

fn shown_own_branch(py: Python<'_>, branch: BranchModel) -> Made<'_> {
    let parameter = PARAMETERS.into_iter().find(|(_, parameter)| *parameter == branch.parameter);
    let made = shown_branch(py, &branch, parameter.map_or("unknown", |(name, _)| name))?;
    holding(made, Branch(branch))
}

fn shown_driven_branch(py: Python<'_>, branch: BranchModel<DrivenFamily>, parameter: String) -> Made<'_> {
    let made = shown_branch(py, &branch, &parameter)?;
    holding(made, DrivenBranch(branch, parameter))
}

fn shown_branch<'py, M: ContinuedMap>(
    py: Python<'py>,
    branch: &BranchModel<M>,
    parameter: &str,
) -> Made<'py> {
    let points = &branch.points;
    let period = points.first().map_or(0, |point| point.orbit.period());
    // A number of each impact of each orbit, orbit by impact.
    let impacts = |of: fn(&ImpactState) -> f64| {
        let rows = points.iter().flat_map(|point| {
            (0..period).map(move |index| point.orbit.states.get(index).map_or(f64::NAN, of))
        });
        matrix(py, rows.collect(), [points.len(), period])
    };
    let mut bifurcations = Vec::new();
    for found in &branch.bifurcations {
        let ((name, impact), point) = (kind(found.kind), &found.point);
        let orbit = shown_orbit(py, point.orbit.clone())?;
        bifurcations.push(make!(py, "Bifurcation", name, point.parameter, point.arclength, impact, orbit)?);
    }
    let end = match branch.end {
        BranchEnd::RangeLimit(end) => format!("the parameter reaches {end:?}"),
        BranchEnd::Bifurcation => "the orbit ends in the last bifurcation".to_owned(),
        BranchEnd::Closed => "the branch is back at its start".to_owned(),
        BranchEnd::PointLimit(points) => format!("there are {points} points"),
        BranchEnd::StepTooSmall(arclength) => format!("no next point at the arclength {arclength:?}"),
        _ => "unknown".to_owned(),
    };
    let multipliers = points.iter().flat_map(|point| complex(point.multipliers())).collect();
    make!(
        py,
        "Branch",
        parameter,
        column(py, points, |point| point.parameter),
        column(py, points, |point| point.arclength),
        impacts(|state| state.phase().angle())?,
        impacts(ImpactState::velocity)?,
        impacts(ImpactState::normalised_speed)?,
        matrix(py, multipliers, [points.len(), 2])?,
        column(py, points, BranchPoint::is_stable),
        end,
        PyTuple::new(py, bifurcations)?,
    )
}

fn continuation(a: &Arguments<'_>, parameter: ContinuationParameter, rising: bool) -> PyResult<Continuation> {
    a.take_settings("Continuation")?;
    let (first, largest, points) = (a.real("first_step")?, a.real("largest_step")?, a.usize("max_points")?);
    Continuation::new(parameter, a.pair("parameter_range")?, rising)
        .and_then(|settings| settings.with_steps(first, largest, points))
        .map_err(|error| a.refused(error))
}

/// The branch of periodic orbits through one of them.
#[pyfunction]
pub(crate) fn continued(a: Arguments<'_>) -> Made<'_> {
    let (map, orbit) = (a.map()?, a.held::<PeriodicOrbit>("orbit")?);
    let (Map { sine, other, .. }, orbit, rising) = (map.get(), &orbit.get().0, a.of("rising")?);
    let Some(other) = other else {
        let settings = continuation(&a, a.choice("parameter", &PARAMETERS)?, rising)?;
        return shown_own_branch(a.py(), a.run(|observer| Ok(sine.continued(orbit, &settings, observer)?))?);
    };
    let settings = continuation(&a, ContinuationParameter::Number, rising)?;
    let number: String = a.of("parameter")?;
    let family = other.1.family(sine, &number).map_err(|error| a.refused(error))?;
    let branch = a.run(|observer| Ok(family.continued(orbit, &settings, observer)?))?;
    shown_driven_branch(a.py(), branch, number)
}

/// The branch of twice the period that begins at a doubling.
#[pyfunction]
pub(crate) fn switched(a: Arguments<'_>) -> Made<'_> {
    let index = a.usize("index")?;
    if let Ok(branch) = a.held::<DrivenBranch>("self") {
        let DrivenBranch(branch, number) = branch.get();
        let settings = continuation(&a, ContinuationParameter::Number, true)?;
        let switched = a.run(|observer| Ok(branch.switched(index, &settings, observer)?))?;
        return shown_driven_branch(a.py(), switched, number.clone());
    }
    let branch = a.held::<Branch>("self")?;
    let branch = &branch.get().0;
    let settings = continuation(&a, branch.parameter, true)?;
    shown_own_branch(a.py(), a.run(|observer| Ok(branch.switched(index, &settings, observer)?))?)
}

/// The curves of the folds, doublings and grazes of a branch over a second parameter.
#[pyfunction]
pub(crate) fn curves(a: Arguments<'_>) -> PyResult<Vec<Bound<'_, PyAny>>> {
    let (map, range) = (a.map()?, a.pair("branch_range")?);
    let Map { sine, other, .. } = map.get();
    if let (Some(other), Ok(branch)) = (other, a.held::<DrivenBranch>("branch")) {
        let (DrivenBranch(branch, first), second) = (branch.get(), a.of::<String>("parameter")?);
        let family = other.1.family_of_two(sine, [first, &second]).map_err(|error| a.refused(error))?;
        let start = branch.map.parameter(branch.parameter).unwrap_or(f64::NAN);
        let map = family.with_parameter(branch.parameter, start).map_err(|error| a.refused(error))?;
        let branch = BranchModel { map, ..branch.clone() };
        return curves_of(&a, &branch, range, ContinuationParameter::SecondNumber, [first, &second]);
    }
    let branch = a.held::<Branch>("branch")?;
    let (branch, second) = (&branch.get().0, a.choice("parameter", &PARAMETERS)?);
    let name = |wanted| PARAMETERS.iter().find(|own| own.1 == wanted).map_or("unknown", |own| own.0);
    curves_of(&a, branch, range, second, [name(branch.parameter), name(second)])
}

fn curves_of<'py, M: ContinuedMap + Send + Sync>(
    a: &Arguments<'py>,
    branch: &BranchModel<M>,
    range: (f64, f64),
    second: ContinuationParameter,
    names: [&str; 2],
) -> PyResult<Vec<Bound<'py, PyAny>>> {
    let both = [continuation(a, second, true)?, continuation(a, second, false)?];
    let found = a.run(|observer| Ok(branch.curves(range, &both, observer)?))?;
    found.iter().map(|(index, curve)| shown_curve(a.py(), *index, curve, names)).collect()
}

fn shown_curve<'py, M>(py: Python<'py>, index: usize, curve: &CurveModel<M>, names: [&str; 2]) -> Made<'py> {
    let points = &curve.points;
    let period = points.first().map_or(0, |point| point.states.len());
    let impacts = |of: fn(&ImpactState) -> f64| {
        let rows = points.iter().flat_map(|point| point.states.iter().map(of)).collect();
        matrix(py, rows, [points.len(), period])
    };
    let flat = |pairs: Vec<[f64; 2]>| pairs.into_iter().flatten().collect::<Vec<_>>();
    let mut special = Vec::new();
    for found in &curve.special {
        let flight = match found.kind {
            SpecialKind::GrazingFold { flight } | SpecialKind::GrazingDoubling { flight } => Some(flight),
            _ => None,
        };
        let (name, point) = (found.kind.name().replace(' ', "-"), &found.point);
        let (values, errors) = (point.parameters, point.errors);
        let phases = column(py, &point.states, |state| state.phase().angle());
        special.push(make!(
            py,
            "SpecialPoint",
            name,
            (values[0], values[1]),
            (errors[0], errors[1]),
            point.arclength,
            flight,
            phases,
            column(py, &point.states, ImpactState::velocity)
        )?);
    }
    let end = match curve.end {
        CurveEnd::RangeLimit { parameter, value } => {
            let own = names[usize::from(parameter == curve.parameters[1])];
            format!("{own} reaches {value:?}")
        }
        CurveEnd::Graze { flight } => format!("flight {flight} touches the platform"),
        CurveEnd::VanishingImpact { impact } => format!("impact {impact} loses its speed"),
        CurveEnd::BorderCollision { impact } => format!("impact {impact} reaches a joint of the platform"),
        CurveEnd::Birth => "the orbit becomes one of half the period".to_owned(),
        CurveEnd::Closed => "the curve is back at its start".to_owned(),
        CurveEnd::PointLimit(points) => format!("there are {points} points"),
        CurveEnd::StepTooSmall(arclength) => format!("no next point at the arclength {arclength:?}"),
        _ => "unknown".to_owned(),
    };
    let multipliers = points.iter().flat_map(|point| complex(point.multipliers())).collect();
    let decided = points.iter().map(|point| point.is_supercritical.map_or(0, |own| if own { 1 } else { -1 }));
    make!(
        py,
        "Curve",
        kind(curve.kind).0,
        index,
        (names[0], names[1]),
        matrix(py, flat(points.iter().map(|point| point.parameters).collect()), [points.len(), 2])?,
        matrix(py, flat(points.iter().map(|point| point.errors).collect()), [points.len(), 2])?,
        column(py, points, |point| point.arclength),
        impacts(|state| state.phase().angle())?,
        impacts(ImpactState::velocity)?,
        matrix(py, multipliers, [points.len(), 2])?,
        array(py, decided.collect::<Vec<i64>>()),
        end,
        PyTuple::new(py, special)?,
    )
}

/// One orbit of a branch.
#[pyfunction]
pub(crate) fn branch_orbit(a: Arguments<'_>) -> Made<'_> {
    let index = a.usize("index")?;
    let own = |points: &[BranchPoint]| points.get(index).map(|point| point.orbit.clone());
    let orbit = match a.held::<DrivenBranch>("self") {
        Ok(branch) => own(&branch.get().0.points),
        Err(_) => own(&a.held::<Branch>("self")?.get().0.points),
    };
    match orbit {
        Some(orbit) => shown_orbit(a.py(), orbit),
        None => Err(errors::out_of_range(a.py(), "index", index as f64, "less than the number of orbits")),
    }
}

/// The period doublings of the orbit of one impact, and Feigenbaum's numbers from them.
#[pyfunction]
pub(crate) fn doubling_cascade(a: Arguments<'_>) -> Made<'_> {
    let (restitution, count, py) = (a.real("restitution")?, a.usize("count")?, a.py());
    let platform = a.platform()?;
    let cascade = a.run(move |observer| {
        let Some(platform) = platform else {
            return Ok(doubling_cascade_of(restitution, count, observer)?);
        };
        let sine = move |forcing| ImpactMap::new(Vibration::from_axial_forcing(forcing)?, restitution);
        // Finds a fault of the map before the search builds many.
        platform.map(&sine(1.0)?)?;
        let maps = move |forcing| platform.map(&sine(forcing).ok()?).ok();
        Ok(driven_doubling_cascade(maps, count, observer)?)
    })?;
    let (cascade, ended_by) = (cascade.doublings, cascade.ended_by.map(|error| error.to_string()));
    let estimates = feigenbaum_estimates(&cascade);
    make!(
        py,
        "DoublingCascade",
        column(py, &cascade, |one| one.period as i64),
        column(py, &cascade, |one| one.axial_forcing),
        column(py, &cascade, |one| one.forcing_error),
        column(py, &cascade, |one| one.multiplier),
        column(py, &cascade, |one| one.width),
        column(py, &cascade, |one| one.graze_margin),
        column(py, &estimates, |one| one.number as i64),
        column(py, &estimates, |one| one.delta),
        column(py, &estimates, |one| one.delta_error),
        column(py, &estimates, |one| one.alpha),
        column(py, &estimates, |one| one.alpha_error),
        ended_by,
    )
}
