//! Stable and unstable manifolds of saddles.

use bouncing_disk::core::{
    Manifold, ManifoldBranch, ManifoldEnd, ManifoldKind, ManifoldSettings, PieceEnd, Side,
};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::arguments::{Count, ProgressCallable};
use crate::diagram::room_for;
use crate::impact_map::ImpactMap;
use crate::names::{Name, name};
use crate::periodic_orbit::PeriodicOrbit;
use crate::real::{Real, optional};
use crate::{errors, long_call, results};

/// What the library calls the arguments.
const NAMES: [Name; 9] = [
    name("arclength of a manifold", &["arclength"]),
    name("points of a manifold", &["max_points"]),
    name("chord of a manifold", &["chord"]),
    name("turn of a manifold", &["turn"]),
    name("generations of a manifold", &["max_generations"]),
    name("launch speed of a manifold", &["launch_speed"]),
    name("multiplier of a saddle", &["orbit"]),
    name("real part of a multiplier of a saddle", &["orbit"]),
    name("restitution of an inverse", &["impact_map.restitution"]),
];

/// The name of a side.
pub(crate) const fn side_name(side: Side) -> &'static str {
    match side {
        Side::Later => "later",
        Side::Earlier => "earlier",
    }
}

/// The place in `Manifold.PIECE_ENDS`.
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

/// The place in `Manifold.BRANCH_ENDS`.
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

/// The pieces of all branches, one after the other.
struct Pieces {
    offsets: Vec<i64>,
    phases: Vec<f64>,
    velocities: Vec<f64>,
    branches: Vec<i64>,
    starts: Vec<u8>,
    ends: Vec<u8>,
}

impl Pieces {
    fn of(manifold: &Manifold) -> Result<Self, bouncing_disk::Error> {
        let points = manifold.pieces().map(|piece| piece.states.len()).sum();
        let mut all = Self {
            offsets: vec![0],
            phases: room_for(points)?,
            velocities: room_for(points)?,
            branches: Vec::new(),
            starts: Vec::new(),
            ends: Vec::new(),
        };
        for (branch, place) in manifold.branches.iter().zip(0..) {
            for piece in &branch.pieces {
                all.phases.extend(piece.states.iter().map(|state| state.phase().angle()));
                all.velocities.extend(piece.states.iter().map(|state| state.velocity()));
                all.offsets.push(all.phases.len() as i64);
                all.branches.push(place);
                all.starts.push(piece_end(piece.start));
                all.ends.push(piece_end(piece.end));
            }
        }
        Ok(all)
    }
}

/// The stable or the unstable manifold of a saddle, grown from it piece by piece.
///
/// Lengths are those of the plane of impact phase (rad) and impact velocity in units of 1 + P, with the peak
/// acceleration P.
///
/// Parameters
/// ----------
/// impact_map : ImpactMap
/// orbit : PeriodicOrbit
///     A saddle of this map: one real multiplier inside of the unit circle and one outside.
/// kind : {"unstable", "stable"}, default "unstable"
///     Which one: what comes from the saddle, or what tends to it.
/// arclength : float
///     Length of each branch, in (0, 1e6].
/// max_points : int, default 100000
///     The most points of a branch, in [16, 1e7].
/// chord : float, default 0.05
///     The largest distance between neighbours, in [1e-6, 1].
/// turn : float, default 0.2
///     The largest turn of the polygon (rad), in [0.001, 1].
/// max_generations : int, default 200
///     How often the first piece is mapped at most, in [1, 10000].
/// launch_speed : float, optional
///     The largest own speed after an impact (units of g/omega) that a stable manifold is followed to.
/// progress : callable, optional
///     Called as ``progress(done, total)`` with the number of points.
///
/// Returns
/// -------
/// Manifold
///
/// Examples
/// --------
/// >>> import bouncing_disk as bd
/// >>> bouncing = bd.ImpactMap(axial_forcing=0.45, restitution=0.5)
/// >>> saddle = next(orbit for orbit in bd.periodic_orbits(bouncing, max_impacts=1, max_platform_periods=1)
/// ...     if not orbit.is_stable)
/// >>> manifold = bd.manifold(bouncing, saddle, arclength=5.0)
/// >>> sorted(manifold.branch_end_names())  # One branch ends in the orbit that attracts.
/// ['arclength', 'attracted']
#[pyfunction]
#[pyo3(signature = (
    impact_map, orbit, *, kind="unstable", arclength, max_points=Count::Fits(100_000), chord=Real(0.05),
    turn=Real(0.2), max_generations=Count::Fits(200), launch_speed=None, progress=ProgressCallable(None)
), text_signature = "(impact_map, orbit, *, kind='unstable', arclength, max_points=100000, chord=0.05, turn=0.2, \
                     max_generations=200, launch_speed=None, progress=None)")]
#[expect(clippy::too_many_arguments, reason = "they are keywords")]
pub(crate) fn manifold<'py>(
    py: Python<'py>,
    impact_map: &Bound<'py, ImpactMap>,
    orbit: &Bound<'py, PeriodicOrbit>,
    kind: &str,
    arclength: Real,
    max_points: Count,
    chord: Real,
    turn: Real,
    max_generations: Count,
    launch_speed: Option<Real>,
    progress: ProgressCallable,
) -> PyResult<Bound<'py, PyAny>> {
    let which = match kind {
        "unstable" => ManifoldKind::Unstable,
        "stable" => ManifoldKind::Stable,
        _ => {
            return Err(PyValueError::new_err(format!(
                "kind must be \"unstable\" or \"stable\", and is {kind:?}"
            )));
        }
    };
    let (points, generations) =
        (max_points.usize(py, "max_points")?, max_generations.u32(py, "max_generations")?);
    let settings = ManifoldSettings::new(arclength.0, points)
        .and_then(|settings| settings.with_resolution(chord.0, turn.0)?.with_generations(generations));
    let settings = match optional(launch_speed) {
        Some(speed) => settings.and_then(|settings| settings.with_launch_speed(speed)),
        None => settings,
    };
    let settings = settings.map_err(|error| errors::of_named(py, error, &NAMES))?;
    let (map, orbit) = (impact_map.get().map, &orbit.get().0);
    let (found, pieces) = long_call::run_named(py, progress.0, &NAMES, |observer| {
        let found = map.manifold(orbit, which, &settings, observer)?;
        let pieces = Pieces::of(&found)?;
        Ok((found, pieces))
    })?;
    let branch =
        |of: &dyn Fn(&ManifoldBranch) -> i64| results::array(py, found.branches.iter().map(of).collect());
    let bytes =
        |of: &dyn Fn(&ManifoldBranch) -> u8| results::array(py, found.branches.iter().map(of).collect());
    let points = (
        kind,
        found.multiplier,
        results::array(py, pieces.offsets),
        results::array(py, pieces.phases),
        results::array(py, pieces.velocities),
        results::array(py, pieces.branches),
        results::array(py, pieces.starts),
        results::array(py, pieces.ends),
    );
    let branches = (
        branch(&|branch| branch.impact as i64),
        bytes(&|branch| u8::from(branch.side == Side::Earlier)),
        results::array(py, found.branches.iter().map(|branch| branch.arclength).collect()),
        branch(&|branch| branch.generations.into()),
        bytes(&|branch| branch_end(branch.end)),
    );
    results::make(py, "Manifold", results::joined(py, points, branches)?)
}
