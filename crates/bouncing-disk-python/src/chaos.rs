//! The long-term behaviour of orbits: diagrams, lifetimes, exponents, verdicts, manifolds and crises.

use bouncing_disk::Error;
use bouncing_disk::core::{
    attractors::{CycleTrust, UndecidedReason, Verdict, VerdictSettings, each_verdict},
    chaos::{
        Crisis as CrisisModel, CrisisEvent, CrisisKind, CrisisSearch, LyapunovOutcome, Manifold,
        ManifoldBranch, ManifoldEnd, ManifoldKind, ManifoldSettings, NoCrisis, PieceEnd, Side,
    },
};
use numpy::{Complex64, PyArray1};
use pyo3::prelude::*;

use crate::arguments::{Arguments, Made, Starts};
use crate::errors;
use crate::orbits::{PeriodicOrbit, shown_orbit};
use crate::results::{array, column, complex, holders, holding, make, matrix, room_for, signed};

holders! {
    /// The contents of a `Crisis`.
    Crisis(CrisisModel) = shown_crisis;
}

/// Rows of impacts, one after the other.
struct Rows {
    offsets: Vec<i64>,
    phases: Vec<f64>,
    velocities: Vec<f64>,
}

impl Rows {
    fn of<'a>(
        rows: impl Iterator<Item = &'a [bouncing_disk::core::ImpactState]> + Clone,
    ) -> Result<Self, Error> {
        let impacts = rows.clone().map(<[_]>::len).sum();
        let mut flat = Self { offsets: vec![0], phases: room_for(impacts)?, velocities: room_for(impacts)? };
        for row in rows {
            flat.phases.extend(row.iter().map(|state| state.phase().angle()));
            flat.velocities.extend(row.iter().map(|state| state.velocity()));
            flat.offsets.push(flat.phases.len() as i64);
        }
        Ok(flat)
    }
}

/// A call with the map and the first impact of an index: on the sine, or on another platform.
macro_rules! on_any_platform {
    ($starts:expr, $platform:expr, |$start:ident| $call:expr) => {
        match $platform {
            None => {
                let $start = |index: usize| $starts.state(index);
                $call
            }
            Some(platform) => {
                let $start = |index: usize| {
                    let (map, state) = $starts.state(index)?;
                    Ok::<_, Error>((platform.map(&map)?, state))
                };
                $call
            }
        }
    };
}

/// The impacts of many orbits after their transients.
#[pyfunction]
pub(crate) fn orbit_diagram(a: Arguments<'_>) -> Made<'_> {
    let (starts, policy, py) = (Starts::of(&a)?, a.policy()?, a.py());
    let (transient, recorded) = (a.usize("transient")?, a.usize("recorded")?);
    let platform = a.platform()?;
    let rows = a.run(|observer| {
        let columns = on_any_platform!(starts, &platform, |start| {
            let orbit = |index| start(index).map(|(map, state)| map.orbit(state, policy));
            let orbits = (0..starts.axial_forcing.len()).map(orbit).collect::<Result<Vec<_>, _>>()?;
            bouncing_disk::core::sweep::orbit_diagram(&orbits, transient, recorded, observer)?
        });
        Rows::of(columns.iter().map(Vec::as_slice))
    })?;
    make!(
        py,
        "OrbitDiagram",
        array(py, starts.axial_forcing),
        array(py, starts.restitution),
        array(py, rows.offsets),
        array(py, rows.phases),
        array(py, rows.velocities),
    )
}

/// The largest Lyapunov exponent of each orbit.
#[pyfunction]
pub(crate) fn lyapunov_exponents(a: Arguments<'_>) -> PyResult<Bound<'_, PyArray1<f64>>> {
    let (starts, transient, impacts) = (Starts::of(&a)?, a.usize("transient")?, a.usize("impacts")?);
    let platform = a.platform()?;
    let exponents = a.run(|observer| {
        on_any_platform!(starts, &platform, |start| {
            let all = (0..starts.axial_forcing.len()).map(start).collect::<Result<Vec<_>, _>>()?;
            Ok(bouncing_disk::core::chaos::lyapunov_exponents(&all, transient, impacts, observer)?)
        })
    })?;
    Ok(column(a.py(), &exponents, |exponent| exponent.unwrap_or(f64::NAN)))
}

/// The exponents of one orbit: the index into `LyapunovSpectra.OUTCOMES`; the largest exponent with its error, the
/// second and the sum; the impacts; the phase of a graze. Missing numbers are NaN.
type Exponents = (u8, [f64; 4], i64, f64);

fn exponents(outcome: &LyapunovOutcome) -> Exponents {
    let (none, forgotten) = (f64::NAN, f64::NEG_INFINITY);
    match outcome {
        LyapunovOutcome::Exponents(found) => {
            // A compliant contact has two exponents, whose sum is not known.
            let unknown = if found.second.is_some() { none } else { forgotten };
            let (second, sum) = (found.second.unwrap_or(forgotten), found.exact_sum.unwrap_or(unknown));
            (0, [found.largest, found.standard_error, second, sum], signed(found.impacts), none)
        }
        LyapunovOutcome::Rested { impacts } => (1, [none; 4], signed(*impacts), none),
        LyapunovOutcome::Grazed { impacts, phase } => (2, [none; 4], signed(*impacts), phase.angle()),
        _ => (1, [none; 4], 0, none),
    }
}

/// Both Lyapunov exponents of each orbit.
#[pyfunction]
pub(crate) fn lyapunov_spectra(a: Arguments<'_>) -> Made<'_> {
    let (starts, transient, impacts) = (Starts::of(&a)?, a.u64("transient")?, a.u64("impacts")?);
    let platform = a.platform()?;
    let all = a.run(|observer| {
        let outcomes = on_any_platform!(starts, &platform, |start| {
            let all = (0..starts.axial_forcing.len()).map(start).collect::<Result<Vec<_>, _>>()?;
            bouncing_disk::core::chaos::lyapunov_spectra(&all, transient, impacts, observer)?
        });
        let mut all = room_for(outcomes.len())?;
        all.extend(outcomes.iter().map(exponents));
        Ok(all)
    })?;
    let py = a.py();
    make!(
        py,
        "LyapunovSpectra",
        array(py, starts.axial_forcing),
        array(py, starts.restitution),
        column(py, &all, |one| one.0),
        column(py, &all, |one| one.1[0]),
        column(py, &all, |one| one.1[1]),
        column(py, &all, |one| one.1[2]),
        column(py, &all, |one| one.1[3]),
        column(py, &all, |one| one.2),
        column(py, &all, |one| one.3),
    )
}

/// The numbers of one verdict; numbers that it lacks are 0 or NaN.
#[derive(Debug, Clone, Copy)]
struct Evidence {
    /// The index into `Verdicts.KINDS`.
    kind: u8,
    /// The index into `Verdicts.REASONS`.
    reason: u8,
    period: u64,
    platform_periods: u64,
    after: u64,
    rests: u64,
    exponent: f64,
    standard_error: f64,
    rounding_error: f64,
    multipliers: [Complex64; 2],
}

/// No verdict.
const NOTHING: Evidence = Evidence {
    kind: 4,
    reason: 0,
    period: 0,
    platform_periods: 0,
    after: 0,
    rests: 0,
    exponent: f64::NAN,
    standard_error: f64::NAN,
    rounding_error: f64::NAN,
    multipliers: [Complex64::new(f64::NAN, f64::NAN); 2],
};

/// The index of the reason into `Verdicts.REASONS`, with its numbers.
fn undecided(reason: &UndecidedReason, rests: u64) -> Evidence {
    let nothing = Evidence { rests, ..NOTHING };
    match *reason {
        UndecidedReason::ExponentNearZero { exponent, standard_error } => {
            Evidence { reason: 1, exponent, standard_error, ..nothing }
        }
        UndecidedReason::NoPeriodFound { exponent, standard_error } => {
            Evidence { reason: 2, exponent, standard_error, ..nothing }
        }
        UndecidedReason::Grazing { impacts, .. } => Evidence { reason: 3, after: impacts, ..nothing },
        UndecidedReason::OnPeriodicOrbit { impacts, platform_periods, multipliers, .. } => Evidence {
            reason: 4,
            period: impacts,
            platform_periods,
            multipliers: complex(multipliers),
            ..nothing
        },
        UndecidedReason::TransientMayLast { exponent, standard_error, .. } => {
            Evidence { reason: 5, exponent, standard_error, ..nothing }
        }
        UndecidedReason::RestNotProven { after, .. } => Evidence { reason: 6, after, ..nothing },
        _ => nothing,
    }
}

fn evidence(verdict: &Verdict) -> Evidence {
    match verdict {
        Verdict::Periodic { impacts, platform_periods, multipliers, after, rests, .. } => Evidence {
            kind: 0,
            period: *impacts,
            platform_periods: *platform_periods,
            after: *after,
            rests: *rests,
            multipliers: complex(*multipliers),
            ..NOTHING
        },
        Verdict::Chaotic { exponent, standard_error, rests, .. } => Evidence {
            kind: 1,
            exponent: *exponent,
            standard_error: *standard_error,
            rests: *rests,
            ..NOTHING
        },
        Verdict::Chattering { cycle, after } => {
            let (exponent, standard_error) = match cycle.trust {
                CycleTrust::ChosenByRounding { exponent, standard_error } => (exponent, standard_error),
                _ => (None, None),
            };
            Evidence {
                kind: 2,
                period: cycle.impacts,
                platform_periods: cycle.platform_periods,
                after: *after,
                rests: 1,
                exponent: exponent.unwrap_or(f64::NAN),
                standard_error: standard_error.unwrap_or(f64::NAN),
                rounding_error: cycle.rounding_error,
                ..NOTHING
            }
        }
        Verdict::AtRest { after, .. } => Evidence { kind: 3, after: *after, rests: 1, ..NOTHING },
        Verdict::Undecided { reason, rests } => undecided(reason, *rests),
        _ => NOTHING,
    }
}

/// The long-term motion of the orbit of each start.
#[pyfunction]
pub(crate) fn verdicts(a: Arguments<'_>) -> Made<'_> {
    let (starts, platform, py) = (Starts::of(&a)?, a.platform()?, a.py());
    let settings = VerdictSettings {
        transient: a.u64("transient")?,
        impacts: a.u64("impacts")?,
        longest_period: a.usize("longest_period")?,
        tolerance: a.real("tolerance")?,
    };
    let all = a.run(|observer| {
        let count = starts.axial_forcing.len();
        let mut all = room_for(count)?;
        on_any_platform!(starts, &platform, |start| {
            // An illegal start is rejected before any orbit is followed.
            (0..count).try_for_each(|index| start(index).map(|_| ()))?;
            let start = |index: usize| start(index).map(Some);
            let each = |verdict: Option<Verdict>| all.extend(verdict.as_ref().map(evidence));
            each_verdict(count, start, settings, observer, each)?;
        });
        Ok(all)
    })?;
    let multipliers = all.iter().flat_map(|one| one.multipliers).collect();
    make!(
        py,
        "Verdicts",
        array(py, starts.axial_forcing),
        array(py, starts.restitution),
        column(py, &all, |one| one.kind),
        column(py, &all, |one| one.reason),
        column(py, &all, |one| signed(one.period)),
        column(py, &all, |one| signed(one.platform_periods)),
        column(py, &all, |one| signed(one.after)),
        column(py, &all, |one| signed(one.rests)),
        column(py, &all, |one| one.exponent),
        column(py, &all, |one| one.standard_error),
        column(py, &all, |one| one.rounding_error),
        matrix(py, multipliers, [all.len(), 2])?,
    )
}

/// The index into `Manifold.PIECE_ENDS`.
fn piece_end(end: PieceEnd) -> u8 {
    match end {
        PieceEnd::Saddle => 0,
        PieceEnd::Graze => 1,
        PieceEnd::Rest => 2,
        PieceEnd::TooFast => 3,
        PieceEnd::Cut => 4,
        _ => u8::MAX,
    }
}

/// The index into `Manifold.BRANCH_ENDS`.
fn branch_end(end: ManifoldEnd) -> u8 {
    match end {
        ManifoldEnd::Arclength => 0,
        ManifoldEnd::Points => 1,
        ManifoldEnd::Generations => 2,
        ManifoldEnd::Attracted => 3,
        ManifoldEnd::Lost => 4,
        _ => u8::MAX,
    }
}

/// The stable or the unstable manifold of a saddle.
#[pyfunction]
pub(crate) fn manifold(a: Arguments<'_>) -> Made<'_> {
    let (map, orbit, py) = (a.map()?, a.held::<PeriodicOrbit>("orbit")?, a.py());
    let map = map.get().rigid_sine(py)?;
    let kind = a.choice("kind", &[("unstable", ManifoldKind::Unstable), ("stable", ManifoldKind::Stable)])?;
    let (points, generations) = (a.usize("max_points")?, a.u32("max_generations")?);
    let (chord, turn, launch) = (a.real("chord")?, a.real("turn")?, a.optional("launch_speed")?);
    let settings = ManifoldSettings::new(a.real("arclength")?, points)
        .and_then(|settings| settings.with_resolution(chord, turn)?.with_generations(generations));
    let settings = match launch {
        Some(speed) => settings.and_then(|settings| settings.with_launch_speed(speed)),
        None => settings,
    };
    let (settings, orbit) = (settings.map_err(|error| a.refused(error))?, &orbit.get().0);
    let (found, rows) = a.run(|observer| {
        let found: Manifold = map.manifold(orbit, kind, &settings, observer)?;
        let pieces: Vec<_> = found.pieces().map(|piece| piece.states.as_slice()).collect();
        let rows = Rows::of(pieces.iter().copied())?;
        Ok((found, rows))
    })?;
    let branches: &[ManifoldBranch] = &found.branches;
    let pieces: Vec<_> = branches
        .iter()
        .zip(0_i64..)
        .flat_map(|(branch, place)| branch.pieces.iter().map(move |piece| (piece, place)))
        .collect();
    make!(
        py,
        "Manifold",
        a.get("kind")?,
        found.multiplier,
        array(py, rows.offsets),
        array(py, rows.phases),
        array(py, rows.velocities),
        column(py, &pieces, |(_, branch)| *branch),
        column(py, &pieces, |(piece, _)| piece_end(piece.start)),
        column(py, &pieces, |(piece, _)| piece_end(piece.end)),
        column(py, branches, |branch| branch.impact as i64),
        column(py, branches, |branch| u8::from(branch.side == Side::Earlier)),
        column(py, branches, |branch| branch.arclength),
        column(py, branches, |branch| i64::from(branch.generations)),
        column(py, branches, |branch| branch_end(branch.end)),
    )
}

fn shown_crisis(py: Python<'_>, crisis: CrisisModel) -> Made<'_> {
    let own = crisis.tangency.as_ref().ok();
    let kind = crisis.kind();
    let is_boundary_crisis = match kind {
        CrisisKind::Undecided => None,
        kind => Some(matches!(kind, CrisisKind::Boundary | CrisisKind::OtherAttractor)),
    };
    let side = |side| if side == Side::Later { "later" } else { "earlier" };
    let made = make!(
        py,
        "Crisis",
        crisis.restitution,
        crisis.forcing,
        crisis.forcing_error,
        crisis.bracket,
        kind.name(),
        is_boundary_crisis,
        crisis.tangency.as_ref().err().map(ToString::to_string),
        own.map(|own| shown_orbit(py, own.inside.clone())).transpose()?,
        own.map(|own| shown_orbit(py, own.touched.clone())).transpose()?,
        own.map(|own| column(py, &own.orbit, |state| state.phase().angle())),
        own.map(|own| column(py, &own.orbit, |state| state.velocity())),
        own.map(|own| side(own.side)),
        own.map(|own| own.share),
        own.map(|own| own.curvature),
        crisis.life_exponent(),
    )?;
    holding(made, Crisis(crisis))
}

/// The search that these arguments describe.
fn crisis_search(a: &Arguments<'_>, restitution: f64) -> PyResult<CrisisSearch> {
    let (samples, impacts) = (a.u32("samples")?, a.u64("impacts")?);
    let merging = CrisisEvent::BandMerging { bands: a.u32("bands")? };
    let events = [("rest", CrisisEvent::Rest), ("band merging", merging), ("growth", CrisisEvent::Growth)];
    let event = a.choice("event", &events)?;
    CrisisSearch::new(restitution, a.pair("axial_forcing")?)
        .and_then(|search| search.with_samples(samples, impacts)?.for_event(event))
        .map_err(|error| a.refused(error))
}

/// The crisis at each restitution, or `None`.
#[pyfunction]
pub(crate) fn crises(a: Arguments<'_>) -> PyResult<Vec<Option<Bound<'_, PyAny>>>> {
    let restitutions = a.row("restitution")?;
    let search = crisis_search(&a, restitutions.first().copied().unwrap_or(f64::NAN))?;
    let found = a.run(|observer| Ok(search.over_restitution(&restitutions, observer)?))?;
    found
        .into_iter()
        .map(|crisis| crisis.ok().map(|crisis| shown_crisis(a.py(), crisis)).transpose())
        .collect()
}

/// Where a chaotic attractor begins to lose orbits, merges its bands or becomes larger.
#[pyfunction]
pub(crate) fn crisis(a: Arguments<'_>) -> Made<'_> {
    let search = crisis_search(&a, a.real("restitution")?)?;
    let saddle = |name: &str| a.given(name)?.map(|_| a.held::<PeriodicOrbit>(name)).transpose();
    let (inside, touched) = (saddle("inside")?, saddle("touched")?);
    let first = inside.as_ref().or(touched.as_ref());
    let saddles = first.map(|first| (&first.get().0, &touched.as_ref().unwrap_or(first).get().0));
    let found = a.run(|observer| Ok(search.crisis(saddles, observer)?))?;
    let none = |reason: NoCrisis| errors::of_kind(a.py(), format!("there is no crisis: {reason}"), &reason);
    shown_crisis(a.py(), found.map_err(none)?)
}

/// Lifetimes of orbits beyond a crisis.
#[pyfunction]
pub(crate) fn lives(a: Arguments<'_>) -> Made<'_> {
    let (crisis, beyond, py) = (a.held::<Crisis>("self")?, a.row("beyond")?, a.py());
    let (crisis, orbits, impacts) = (&crisis.get().0, a.usize("orbits")?, a.usize("impacts")?);
    let found = a.run(|observer| Ok(crisis.lives(&beyond, orbits, impacts, observer)?))?;
    let (exponent, error, why) = match &found.scaling {
        Ok(law) => (law.exponent, law.standard_error, None),
        Err(reason) => (f64::NAN, f64::NAN, Some(reason.to_string())),
    };
    let infinite = |number: f64| if number < f64::MAX { number } else { f64::INFINITY };
    make!(
        py,
        "CrisisLives",
        column(py, &found.lives, |life| life.beyond),
        column(py, &found.lives, |life| infinite(life.impacts)),
        column(py, &found.lives, |life| infinite(life.relative_error)),
        column(py, &found.lives, |life| life.ended as i64),
        column(py, &found.lives, |life| life.orbits as i64),
        exponent,
        error,
        why,
    )
}
