//! The basins at one forcing: panels (a) to (e).

use bouncing_disk::core::attractors::{Axis, BasinSettings, Grid, KnownOrbit, UNDECIDED};
use bouncing_disk::core::orbits::{Multipliers, PeriodicOrbit};
use bouncing_disk::core::sweep::survival_times;
use bouncing_disk::core::{ChatterPolicy, ImpactMap, ImpactState, Launch, OrbitEvent, Phase, Unobserved};
use bouncing_disk::motion::PAPER_CHATTER;
use serde::Serialize;

use super::WINDOW_TOP;
use super::cells::{ATTRACTOR, CHATTERING, OTHER, STILL_OPEN, boundary_share, exponent, kind, runs};
use crate::experiment::{ExperimentError, Quality};
use crate::figures::shared::map;
use crate::progress::{Progress, advancing};

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

/// An impact: τ_imp/2π and |w_A Γ/(ωA)|.
pub(super) type Spot = (f64, f64);

/// The basins at one Γ.
#[derive(Serialize)]
pub(super) struct Panel {
    pub(super) axial_forcing: f64,
    /// Impacts after which a start that has neither come to rest nor reached a known orbit counts as undecided.
    pub(super) max_impacts: u32,
    /// Rows of cells by rising speed, in a row by phase: runs of equal cells, as `512w33b455w` (w chattering, b the
    /// attractor of the period-doubling route, o another attractor, u undecided).
    pub(super) rows: Vec<String>,
    pub(super) shares: Shares,
    /// Share of the cells that have a neighbour of another kind, with the cells grouped 1, 2, 4, 8 a side.
    pub(super) boundary_shares: [(usize, f64); 4],
    /// The exponents α of boundary share ~ (cell size)^α from each grouping to the next; 2 − α is the boundary's dimension.
    /// Empty where there is no boundary.
    pub(super) boundary_exponents: Vec<f64>,
    /// The same from the finest grouping to the coarsest.
    pub(super) boundary_exponent: Option<f64>,
    /// Lowest |w_A Γ/(ωA)| of a cell that does not chatter; `None` if all do.
    pub(super) lowest_not_chattering: Option<f64>,
    /// Impacts of the attractor of the period-doubling route.
    pub(super) attractor: Vec<Spot>,
    /// Impacts of the chattering orbit from rest; empty if the disk does not come to rest again.
    pub(super) chattering: Vec<Spot>,
    pub(super) others: Vec<Other>,
}

/// Shares of the cells of a panel.
#[derive(Serialize)]
pub(super) struct Shares {
    pub(super) chattering: f64,
    /// End on the attractor of the period-doubling route.
    pub(super) attractor: f64,
    pub(super) other: f64,
    pub(super) undecided: f64,
}

/// A periodic attractor outside the period-doubling route.
#[derive(Serialize)]
pub(super) struct Other {
    pub(super) impacts: Vec<Spot>,
    pub(super) platform_periods: u64,
    /// The larger modulus of its Floquet multipliers.
    pub(super) spectral_radius: f64,
}

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

/// The period-1 orbit, if it attracts.
pub(super) fn period_one(map: &ImpactMap) -> Result<Option<KnownOrbit>, ExperimentError> {
    map.period_one(1).map_or(Ok(None), |state| Ok(known(map, map.refine(&[state])?)))
}

/// A periodic orbit that attracts.
fn known(map: &ImpactMap, orbit: PeriodicOrbit) -> Option<KnownOrbit> {
    let radius = orbit.trapping_radius(map, 64, &Unobserved).ok()?;
    KnownOrbit::new(orbit, radius).ok()
}

/// The attractor on which the orbit from here settles, if it is periodic.
fn settled(
    map: &ImpactMap,
    from: ImpactState,
    transient: usize,
) -> Result<Option<KnownOrbit>, ExperimentError> {
    let orbit = map.settled_orbit(from, transient, LONGEST_PERIOD, 1.0e-8, &Unobserved)?;
    Ok(orbit.and_then(|orbit| known(map, orbit)))
}

/// The attractor that the period-doubling route has led to: a periodic orbit, or a state on a chaotic one.
enum Route {
    Periodic(KnownOrbit),
    Chaotic(ImpactState),
    Gone,
}

fn route(map: &ImpactMap) -> Result<Route, ExperimentError> {
    if let Some(orbit) = period_one(map)? {
        return Ok(Route::Periodic(orbit));
    }
    let Some(saddle) = map.period_one(1) else { return Ok(Route::Gone) };
    // Beyond the first doubling: leave the saddle along the phase.
    let beside = ImpactState::new(Phase::new(saddle.phase().angle() + 1.0e-3)?, saddle.velocity())?;
    let survivor = map.state_after(beside, LONGEST as usize, ChatterPolicy::Complete, &Unobserved)?;
    let Some(state) = survivor else { return Ok(Route::Gone) };
    Ok(settled(map, state, 0)?.map_or(Route::Chaotic(state), Route::Periodic))
}

/// Other periodic attractors, on which undecided cells of a coarse grid settle; `first` and they, in this order.
pub(super) fn with_others(map: &ImpactMap, first: KnownOrbit) -> Result<Vec<KnownOrbit>, ExperimentError> {
    let grid = grid(WINDOW_TOP, COARSE, COARSE)?;
    let settings = BasinSettings { max_impacts: 500, policy: ChatterPolicy::Complete };
    let mut known = vec![first];
    'search: while known.len() < 4 {
        let basins = map.basins(grid, &known, settings, &Unobserved)?;
        for (index, _) in basins.labels().iter().enumerate().filter(|(_, label)| **label == UNDECIDED) {
            if let Some(orbit) = settled(map, start(&grid, index / COARSE, index % COARSE)?, 4_000)? {
                known.push(orbit);
                continue 'search;
            }
        }
        break;
    }
    Ok(known)
}

/// The impacts of one cycle of the disk from rest; empty if it does not come to rest again.
fn chattering(map: &ImpactMap) -> Result<Vec<Spot>, ExperimentError> {
    let Some(leaves) = map.vibration().separation_phase() else { return Ok(Vec::new()) };
    let mut spots = Vec::new();
    for event in map.orbit_from_launch(Launch::new(leaves, 0.0)?, PAPER_CHATTER) {
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

/// The basins at `axial_forcing` with `side` cells a side.
pub(super) fn panel(
    axial_forcing: f64,
    restitution: f64,
    side: usize,
    progress: &dyn Progress,
) -> Result<Panel, ExperimentError> {
    let map = map(axial_forcing, restitution)?;
    let mark = |known: &KnownOrbit| known.orbit().states.iter().copied().map(spot).collect::<Vec<Spot>>();
    let (known, max_impacts, open, attractor) = match route(&map)? {
        Route::Periodic(first) => {
            let impacts = mark(&first);
            (with_others(&map, first)?, LONGEST, STILL_OPEN, impacts)
        }
        Route::Chaotic(state) => {
            let orbit = map.orbit(state, ChatterPolicy::Complete).take(MARKED);
            let impacts = orbit.filter_map(|event| match event {
                Ok(OrbitEvent::Impact(impact)) => Some(spot(impact.into())),
                _ => None,
            });
            (Vec::new(), CAUGHT_BY_CHAOS, ATTRACTOR, impacts.collect())
        }
        Route::Gone => (Vec::new(), LONGEST, STILL_OPEN, Vec::new()),
    };
    let settings = BasinSettings { max_impacts, policy: ChatterPolicy::Complete };
    let basins = map.basins(grid(WINDOW_TOP, side, side)?, &known, settings, &advancing(progress))?;
    let kinds: Vec<u8> = basins.labels().iter().map(|label| kind(*label, open)).collect();
    let share = |kind: u8| kinds.iter().filter(|own| **own == kind).count() as f64 / kinds.len() as f64;
    let boundary_shares = [1, 2, 4, 8].map(|size| (size, boundary_share(&kinds, side, size)));
    let lowest = kinds.iter().position(|kind| *kind != CHATTERING);
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
        boundary_exponent: exponent(boundary_shares[0], boundary_shares[3]),
        boundary_shares,
        lowest_not_chattering: lowest.map(|index| ((index / side) as f64 + 0.5) * (WINDOW_TOP / side as f64)),
        attractor,
        chattering: chattering(&map)?,
        others: known
            .iter()
            .skip(1)
            .map(|known| Other {
                impacts: mark(known),
                platform_periods: known.orbit().platform_periods,
                spectral_radius: Multipliers::of(known.orbit().monodromy).spectral_radius(),
            })
            .collect(),
    })
}

/// The share of the window that has not come to rest after N impacts, against N.
pub(super) fn decay(
    axial_forcing: f64,
    restitution: f64,
    quality: Quality,
) -> Result<Vec<(u32, f64)>, ExperimentError> {
    const COUNTS: [u32; 9] = [20, 50, 100, 200, 300, CAUGHT_BY_CHAOS, 800, 1_600, 3_200];
    let map = map(axial_forcing, restitution)?;
    let side = quality.choose(60, 150);
    let grid = grid(WINDOW_TOP, side, side)?;
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
