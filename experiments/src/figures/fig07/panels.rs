//! The basins at one forcing.

use bouncing_disk::core::attractors::{Axis, BasinSettings, Grid, KnownOrbit, UNDECIDED};
use bouncing_disk::core::orbits::Multipliers;
use bouncing_disk::core::sweep::survival_times;
use bouncing_disk::core::{ChatterPolicy, ImpactMap, ImpactState, Launch, OrbitEvent, Phase, Unobserved};

use super::data::{
    ATTRACTOR, CHATTERING, OTHER, Other, Panel, STILL_OPEN, Shares, Spot, boundary_share, exponent, kind,
    runs,
};
use crate::experiment::ExperimentError;
use crate::figures::shared::map;
use crate::progress::{Progress, advancing};

/// Top of the speed window |w_A Γ/(ωA)|. The paper's window is not in its text: this is the round number at which
/// both fractions that it prints come out (see [`super::scan::windows`]).
pub(super) const WINDOW_TOP: f64 = 5.0;
/// Impacts after which a start at chaotic forcing counts as caught by the attractor; see [`decay`].
const CAUGHT_BY_CHAOS: u32 = 400;
/// Impacts after which a start is undecided where all attractors are periodic.
const LONGEST: u32 = 20_000;
/// Impacts of a chaotic attractor or a chattering orbit that are marked.
const MARKED: usize = 600;
/// Cells a side of the coarse grid on which unknown attractors are looked for.
const COARSE: usize = 60;
/// Longest period (impacts) of an attractor that is looked for.
const LONGEST_PERIOD: usize = 64;

pub(super) fn grid(top: f64, rows: usize, columns: usize) -> Result<Grid, ExperimentError> {
    let phase = Axis::new(0.0, 1.0, columns)?;
    let speed = Axis::new(0.0, top, rows)?;
    Grid::new(phase, speed).map_err(ExperimentError::model)
}

fn spot(state: ImpactState) -> Spot {
    (state.phase().cycles(), state.normalised_speed())
}

pub(super) fn start(grid: &Grid, row: usize, column: usize) -> Result<ImpactState, ExperimentError> {
    ImpactState::from_normalised(grid.impact_angle(column), grid.speed().centre(row))
        .map_err(ExperimentError::model)
}

/// The attractor that the period-doubling route has led to: a periodic orbit, or a state on a chaotic one.
enum Route {
    Periodic(KnownOrbit),
    Chaotic(ImpactState),
    Gone,
}

fn route(map: &ImpactMap) -> Result<Route, ExperimentError> {
    let Some(period_one) = map.period_one(1) else { return Ok(Route::Gone) };
    let orbit = map.refine(&[period_one])?;
    if let Ok(radius) = orbit.trapping_radius(map, 64, &Unobserved) {
        return KnownOrbit::new(orbit, radius).map(Route::Periodic).map_err(ExperimentError::model);
    }
    // Beyond the first doubling: leave the saddle along the phase.
    let beside = Phase::new(period_one.phase().angle() + 1.0e-3)?;
    let beside = ImpactState::new(beside, period_one.velocity())?;
    let survivor = map.state_after(beside, LONGEST as usize, ChatterPolicy::Complete, &Unobserved)?;
    let Some(state) = survivor else { return Ok(Route::Gone) };
    let settled = map.settled_orbit(state, 0, LONGEST_PERIOD, 1.0e-8, &Unobserved)?;
    let periodic = settled
        .and_then(|orbit| orbit.trapping_radius(map, 64, &Unobserved).ok().map(|radius| (orbit, radius)));
    let Some((orbit, radius)) = periodic else { return Ok(Route::Chaotic(state)) };
    KnownOrbit::new(orbit, radius).map(Route::Periodic).map_err(ExperimentError::model)
}

/// Other periodic attractors, on which undecided cells of a coarse grid settle.
pub(super) fn others(map: &ImpactMap, first: &KnownOrbit) -> Result<Vec<KnownOrbit>, ExperimentError> {
    let grid = grid(WINDOW_TOP, COARSE, COARSE)?;
    let settings = BasinSettings { max_impacts: 500, policy: ChatterPolicy::Complete };
    let mut known = vec![first.clone()];
    'search: while known.len() < 4 {
        let basins = map.basins(grid, &known, settings, &Unobserved)?;
        for (index, _) in basins.labels().iter().enumerate().filter(|(_, label)| **label == UNDECIDED) {
            let from = start(&grid, index / COARSE, index % COARSE)?;
            let settled = map.settled_orbit(from, 4_000, LONGEST_PERIOD, 1.0e-8, &Unobserved)?;
            if let Some(orbit) = settled
                && let Ok(radius) = orbit.trapping_radius(map, 64, &Unobserved)
            {
                known.push(KnownOrbit::new(orbit, radius)?);
                continue 'search;
            }
        }
        break;
    }
    known.remove(0);
    Ok(known)
}

/// The impacts of one cycle of the disk from rest; empty if it does not come to rest again.
fn chattering(map: &ImpactMap) -> Result<Vec<Spot>, ExperimentError> {
    let Some(leaves) = map.vibration().separation_phase() else { return Ok(Vec::new()) };
    let mut spots = Vec::new();
    for event in map.orbit_from_launch(Launch::new(leaves, 0.0)?, bouncing_disk::motion::PAPER_CHATTER) {
        match event? {
            OrbitEvent::Impact(impact) => spots.push(spot(impact.into())),
            _ => {
                spots.truncate(MARKED);
                return Ok(spots);
            }
        }
        if spots.len() > LONGEST as usize {
            break;
        }
    }
    Ok(Vec::new())
}

/// The basins at `axial_forcing` in the window [0, `top`] with `side` cells a side.
pub(super) fn panel(
    axial_forcing: f64,
    restitution: f64,
    (top, side): (f64, usize),
    progress: &dyn Progress,
) -> Result<Panel, ExperimentError> {
    let map = map(axial_forcing, restitution)?;
    let route = route(&map)?;
    let (known, max_impacts, open) = match &route {
        Route::Periodic(first) => {
            let mut known = vec![first.clone()];
            known.extend(others(&map, first)?);
            (known, LONGEST, STILL_OPEN)
        }
        Route::Chaotic(_) => (Vec::new(), CAUGHT_BY_CHAOS, ATTRACTOR),
        Route::Gone => (Vec::new(), LONGEST, STILL_OPEN),
    };
    let settings = BasinSettings { max_impacts, policy: ChatterPolicy::Complete };
    let basins = map.basins(grid(top, side, side)?, &known, settings, &advancing(progress))?;
    let kinds: Vec<u8> = basins.labels().iter().map(|label| kind(*label, open)).collect();
    let share = |kind: u8| kinds.iter().filter(|own| **own == kind).count() as f64 / kinds.len() as f64;
    let attractor = match route {
        Route::Periodic(known) => known.orbit().states.iter().copied().map(spot).collect(),
        Route::Chaotic(state) => map
            .orbit(state, ChatterPolicy::Complete)
            .take(MARKED)
            .filter_map(|event| match event {
                Ok(OrbitEvent::Impact(impact)) => Some(spot(impact.into())),
                _ => None,
            })
            .collect(),
        Route::Gone => Vec::new(),
    };
    let speed_step = top / side as f64;
    let boundary_shares: Vec<(usize, f64)> =
        [1, 2, 4, 8].into_iter().map(|size| (size, boundary_share(&kinds, side, size))).collect();
    Ok(Panel {
        axial_forcing,
        max_impacts,
        rows: kinds.chunks_exact(side).map(runs).collect(),
        shares: Shares {
            chattering: share(CHATTERING),
            attractor: share(ATTRACTOR),
            other: share(OTHER),
            undecided: share(STILL_OPEN),
        },
        boundary_exponents: boundary_shares
            .windows(2)
            .filter_map(|pair| exponent(pair[0], pair[1]))
            .collect(),
        boundary_exponent: exponent(boundary_shares[0], boundary_shares[boundary_shares.len() - 1]),
        boundary_shares,
        lowest_not_chattering: kinds
            .iter()
            .position(|kind| *kind != CHATTERING)
            .map(|index| ((index / side) as f64 + 0.5) * speed_step),
        attractor,
        chattering: chattering(&map)?,
        others: known
            .iter()
            .skip(1)
            .map(|known| Other {
                impacts: known.orbit().states.iter().copied().map(spot).collect(),
                platform_periods: known.orbit().platform_periods,
                spectral_radius: Multipliers::of(known.orbit().monodromy).spectral_radius(),
            })
            .collect(),
    })
}

/// The share of the window that has not come to rest after N impacts, against N.
pub(super) fn decay(map: &ImpactMap, top: f64, side: usize) -> Result<Vec<(u32, f64)>, ExperimentError> {
    const COUNTS: [u32; 9] = [20, 50, 100, 200, 300, CAUGHT_BY_CHAOS, 800, 1_600, 3_200];
    let grid = grid(top, side, side)?;
    let most = COUNTS[COUNTS.len() - 1];
    let orbits = (0..side * side)
        .map(|index| Ok(map.orbit(start(&grid, index / side, index % side)?, ChatterPolicy::Complete)))
        .collect::<Result<Vec<_>, ExperimentError>>()?;
    let lives = survival_times(&orbits, most as usize, &Unobserved)?;
    let share = |count: u32| {
        lives.iter().filter(|lived| **lived >= count as usize).count() as f64 / lives.len() as f64
    };
    Ok(COUNTS.into_iter().map(|count| (count, share(count))).collect())
}
