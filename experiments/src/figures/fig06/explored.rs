//! The crisis in which the followed attractor is lost to chattering, what the orbits visit there and beyond it, and the period
//! doublings at finer steps of Γ.

use std::f64::consts::PI;

use bouncing_disk::InitialCondition;
use bouncing_disk::core::numerics::roots::bracket_of_width;
use bouncing_disk::core::orbits::follow_attractor;
use bouncing_disk::core::sweep::{orbit_diagram, survival_times};
use bouncing_disk::core::{ChatterPolicy, ImpactState, Launch, Orbit, Phase, Unobserved};
use bouncing_disk::motor::{NormalImpulses, PhasedImpulse};
use bouncing_disk::parameters::ForcingParameters;
use bouncing_disk::toss::{MultiTossSettings, OrbitClass, multi_toss};

use super::data::{BestLag, Column, Explored, Merging, OneImpactDecides, Shadow, Visited};
use super::slices::{Inputs, no_orbit, start};
use crate::experiment::{ExperimentError, Quality};
use crate::figures::shared::map_in_parallel;
use crate::figures::shared::numbers::occupied_arc;
use crate::figures::shared::{distinct_phases, map};

/// Γ inside the chaotic range, where the starts of all trials lie on the attractor.
const SAFE_FORCING: f64 = 0.5555;
/// Γ at which the attractor is long gone.
const LOST_FORCING: f64 = 0.567;
/// Orbits tried.
const STARTS: usize = 8;
/// Width at which the bisection ends.
const BRACKET: f64 = 1.0e-7;

/// States on the followed attractor at [`SAFE_FORCING`].
pub(super) fn starts(first: ImpactState, inputs: Inputs) -> Result<Vec<ImpactState>, ExperimentError> {
    let Inputs { restitution, followed_from, .. } = inputs;
    let forcings = (0..).map(|i| followed_from + 1.0e-4 * f64::from(i)).take_while(|f| *f < SAFE_FORCING);
    let mut state = first;
    for followed in follow_attractor(restitution, forcings, first, 300, ChatterPolicy::Complete) {
        state = followed?.state;
    }
    let map = map(SAFE_FORCING, restitution)?;
    let mut states = Vec::new();
    while states.len() < STARTS {
        match map.state_after(state, 1_000, ChatterPolicy::Complete, &Unobserved)? {
            Some(next) => states.push(next),
            None => break,
        }
        state = states[states.len() - 1];
    }
    Ok(states)
}

/// The orbits of all starts at each Γ.
fn orbits(forcings: &[f64], starts: &[ImpactState], restitution: f64) -> Result<Vec<Orbit>, ExperimentError> {
    let mut orbits = Vec::with_capacity(forcings.len() * starts.len());
    for &forcing in forcings {
        let map = map(forcing, restitution)?;
        orbits.extend(starts.iter().map(|&start| map.orbit(start, ChatterPolicy::Complete)));
    }
    Ok(orbits)
}

/// The last bracket (survived, lost). Its few orbits are advanced one by one: the next Γ is known only when they are done, and
/// k bisections ahead at once are (2^k − 1)/k times as many orbits, which takes back most of what lanes gain.
fn bracket(starts: &[ImpactState], restitution: f64, impacts: usize) -> Result<(f64, f64), ExperimentError> {
    bracket_of_width(SAFE_FORCING, LOST_FORCING, BRACKET, |forcing| {
        let orbits = orbits(&[forcing], starts, restitution)?;
        let lives = survival_times(&orbits, impacts, &Unobserved)?;
        Ok(lives.into_iter().all(|lived| lived == impacts))
    })
}

/// Locates the crisis of the attractor that is followed from `first`.
pub(super) fn merging(
    first: ImpactState,
    inputs: Inputs,
    impacts: usize,
) -> Result<Merging, ExperimentError> {
    let starts = starts(first, inputs)?;
    let restitution = inputs.restitution;
    let (whole, tenth) = rayon::join(
        || bracket(&starts, restitution, impacts),
        || bracket(&starts, restitution, impacts / 10),
    );
    let ((survived, lost), (survived_in_a_tenth, lost_in_a_tenth)) = (whole?, tenth?);
    let forcings: Vec<f64> = (0..16).map(|i| 0.5600 + 0.0001 * f64::from(i)).collect();
    let lives = survival_times(&orbits(&forcings, &starts, restitution)?, impacts / 10, &Unobserved)?;
    let mean_life_impacts = forcings
        .into_iter()
        .zip(lives.chunks(starts.len().max(1)))
        .map(|(forcing, lives)| (forcing, lives.iter().sum::<usize>() as f64 / lives.len() as f64))
        .collect();
    Ok(Merging {
        impacts,
        starts: starts.len(),
        survived,
        lost,
        survived_in_a_tenth,
        lost_in_a_tenth,
        mean_life_impacts,
    })
}

/// Just before and just after the crisis: so far from it. An orbit that starts on the attractor then stays
/// near it for some 1500 impacts on the mean before it comes to rest for the first time.
const BESIDE: f64 = 1.0e-4;
/// Impacts before and after the crisis.
const VISITING: usize = 20_000;
/// Cells of the plane of phase (periods) and speed |w_A Γ/(ωA)| a unit: near are cells next to each other.
const CELLS: f64 = 100.0;
/// Columns of cells, over one period.
const COLUMNS: usize = CELLS as usize;
/// Impacts of an orbit beyond the crisis that are compared with the saddle.
const SHADOWING: usize = 2_000;
/// Starts, on the attractor just before the crisis, of the orbits that show the saddle: those that have not
/// come to rest after so many impacts are next to it in the middle of them.
const SADDLE_STARTS: usize = 4_000;
/// See [`SADDLE_STARTS`].
const SADDLE_LIFE: usize = 40;
/// Impacts in the middle of each of these orbits.
const SADDLE_IMPACTS: usize = 4;

/// Rows of cells, from the speed 0 up.
#[derive(Clone, Copy)]
struct Grid {
    rows: usize,
}

impl Grid {
    /// Up to a speed.
    fn up_to(largest_speed: f64) -> Self {
        Self { rows: (CELLS * largest_speed) as usize + 1 }
    }

    /// The cells that some states lie in, row by row.
    fn occupied(self, states: &[ImpactState]) -> Vec<bool> {
        let mut occupied = vec![false; COLUMNS * self.rows];
        for state in states {
            if let Some(cell) = occupied.get_mut(Self::cell(state)) {
                *cell = true;
            }
        }
        occupied
    }

    fn cell(state: &ImpactState) -> usize {
        let row = (CELLS * state.normalised_speed()) as usize;
        row * COLUMNS + (CELLS * state.phase().cycles()) as usize
    }

    /// The cells next to some of `cells` or in it; the last column touches the first.
    fn near(self, cells: &[bool]) -> Vec<bool> {
        let mut near = vec![false; cells.len()];
        for (index, _) in cells.iter().enumerate().filter(|(_, occupied)| **occupied) {
            let (row, column) = (index / COLUMNS, index % COLUMNS);
            for row in row.saturating_sub(1)..(row + 2).min(self.rows) {
                for across in [COLUMNS - 1, 0, 1] {
                    near[row * COLUMNS + (column + across) % COLUMNS] = true;
                }
            }
        }
        near
    }
}

/// The share that is true.
fn share(of: impl ExactSizeIterator<Item = bool>) -> f64 {
    let all = of.len().max(1);
    of.filter(|holds| *holds).count() as f64 / all as f64
}

fn largest_speed(states: &[ImpactState]) -> f64 {
    states.iter().map(ImpactState::normalised_speed).fold(0.0, f64::max)
}

fn visited(axial_forcing: f64, states: &[ImpactState]) -> Visited {
    Visited {
        axial_forcing,
        impacts: states.len(),
        arc_cycles: occupied_arc(states.iter().map(|state| state.phase().cycles())).unwrap_or_default(),
        largest_speed: largest_speed(states),
        cells: Grid::up_to(largest_speed(states)).occupied(states).into_iter().filter(|cell| *cell).count(),
    }
}

/// The orbit of a disk from rest, where it leaves the platform at all.
fn orbit_from_rest(axial_forcing: f64, inputs: Inputs) -> Result<Orbit, ExperimentError> {
    let map = map(axial_forcing, inputs.restitution)?;
    let leaves = map.vibration().separation_phase().ok_or_else(|| no_orbit(axial_forcing))?;
    Launch::new(leaves, 0.0)
        .map(|launch| map.orbit_from_launch(launch, bouncing_disk::motion::PAPER_CHATTER))
        .map_err(ExperimentError::model)
}

/// The impacts of some orbits, as many of each.
fn recorded(orbits: &[Orbit], impacts: usize) -> Result<Vec<Vec<ImpactState>>, ExperimentError> {
    orbit_diagram(orbits, 0, impacts, &Unobserved).map_err(ExperimentError::model)
}

/// States on the chaotic saddle at this Γ, near which orbits from the attractor before the crisis stay for a
/// while.
fn saddle(
    axial_forcing: f64,
    from: &[ImpactState],
    inputs: Inputs,
) -> Result<Vec<ImpactState>, ExperimentError> {
    let map = map(axial_forcing, inputs.restitution)?;
    let orbits: Vec<Orbit> = from
        .iter()
        .take(SADDLE_STARTS)
        .map(|state| map.orbit(*state, bouncing_disk::motion::PAPER_CHATTER))
        .collect();
    let lives = survival_times(&orbits, SADDLE_LIFE, &Unobserved)?;
    let stay: Vec<Orbit> = orbits
        .into_iter()
        .zip(lives)
        .filter(|(_, lived)| *lived >= SADDLE_LIFE)
        .map(|(orbit, _)| orbit)
        .collect();
    let states = orbit_diagram(&stay, SADDLE_LIFE / 2, SADDLE_IMPACTS, &Unobserved)?;
    Ok(states.concat())
}

/// The widening at the crisis and the shadow beyond. `cycles` are those of a disk from rest, by Γ.
pub(super) fn explored(
    first: ImpactState,
    inputs: Inputs,
    merging: &Merging,
    cycles: &[(f64, Option<usize>)],
) -> Result<Explored, ExperimentError> {
    let crisis = merging.axial_forcing();
    let start = *starts(first, inputs)?.first().ok_or_else(|| no_orbit(crisis))?;
    let orbit_at = |forcing: f64| -> Result<Orbit, ExperimentError> {
        Ok(map(forcing, inputs.restitution)?.orbit(start, bouncing_disk::motion::PAPER_CHATTER))
    };
    let (before, after) = (crisis - BESIDE, crisis + BESIDE);
    // The start lies on the attractor at a slightly lower Γ; a few impacts take it to the present one.
    let beside = orbit_diagram(&[orbit_at(before)?, orbit_at(after)?], 100, VISITING, &Unobserved)?;
    let chattering = recorded(&[orbit_from_rest(before, inputs)?], VISITING)?;
    let union: Vec<ImpactState> = beside[0].iter().chain(&chattering[0]).copied().collect();
    let after = visited(after, &beside[1]);
    let beyond = cycles.iter().filter(|(forcing, cycle)| *forcing > crisis && cycle.is_some());
    let shadow = |&(axial_forcing, _): &(f64, Option<usize>)| {
        let saddle = saddle(axial_forcing, &beside[0], inputs)?;
        let states = recorded(&[orbit_from_rest(axial_forcing, inputs)?], SHADOWING)?;
        // A row more than that of the largest speed: the cells next to it.
        let highest = largest_speed(&states[0]).max(after.largest_speed).max(largest_speed(&saddle));
        let grid = Grid { rows: Grid::up_to(highest).rows + 1 };
        let near = grid.near(&grid.occupied(&saddle));
        let plane = Grid::up_to(after.largest_speed);
        Ok(Shadow {
            axial_forcing,
            share_near: share(states[0].iter().map(|state| near[Grid::cell(state)])),
            share_of_plane: share(near[..COLUMNS * plane.rows].iter().copied()),
        })
    };
    Ok(Explored {
        before: visited(before, &beside[0]),
        before_with_chattering: visited(before, &union),
        shadows: beyond.map(shadow).collect::<Result<_, ExperimentError>>()?,
        after,
    })
}

/// The Γ of the enlarged part of the diagram.
pub(super) const ZOOM: (f64, f64) = (0.5390, 0.5430);
/// Impacts at each Γ of it before any is kept: next to a doubling an orbit attracts slowly.
const ZOOM_TRANSIENT: usize = 3_000;
/// Impacts at each Γ of it that are kept.
const ZOOM_IMPACTS: usize = 128;

/// The followed attractor in the enlarged part, from a state on it at a lower Γ.
pub(super) fn zoom(
    from: ImpactState,
    inputs: Inputs,
    quality: Quality,
) -> Result<Vec<Column>, ExperimentError> {
    let steps = quality.choose(80, 480);
    let (low, high) = ZOOM;
    let forcings = (0..=steps).map(|step| low + (high - low) * f64::from(step) / f64::from(steps));
    let followed = follow_attractor(
        inputs.restitution,
        forcings,
        from,
        ZOOM_TRANSIENT,
        bouncing_disk::motion::PAPER_CHATTER,
    )
    .collect::<Result<Vec<_>, _>>()?;
    let orbits: Vec<Orbit> =
        followed.iter().map(|at| at.map.orbit(at.state, bouncing_disk::motion::PAPER_CHATTER)).collect();
    let states = recorded(&orbits, ZOOM_IMPACTS)?;
    Ok(followed
        .iter()
        .zip(states)
        .map(|(at, states)| Column {
            axial_forcing: at.axial_forcing,
            impact_phase_cycles: distinct_phases(&states),
        })
        .collect())
}

/// The lags tried, in steps: wherever an orbit spends its impacts between phase 0 and a quarter of a period,
/// the best lag is there.
const LAGS_DEG: std::ops::RangeInclusive<i32> = -9..=2;
/// Distance of two lags (degrees).
pub(super) const LAG_STEP_DEG: i32 = 10;

/// The best phase lag of the followed attractor at some states of it, and of a disk from rest at some Γ, for
/// both Γ_T of Fig. 6.
pub(super) fn best_lags(
    followed: &[(f64, ImpactState)],
    from_rest_at: &[f64],
    inputs: Inputs,
    settings: MultiTossSettings,
) -> Result<Vec<BestLag>, ExperimentError> {
    let forcings = [inputs.semielliptical.angular_forcing, inputs.linear.angular_forcing];
    let starts: Vec<(f64, Option<ImpactState>, f64)> = followed
        .iter()
        .map(|(forcing, state)| (*forcing, Some(*state)))
        .chain(from_rest_at.iter().map(|forcing| (*forcing, None)))
        .flat_map(|(forcing, state)| forcings.map(|angular| (forcing, state, angular)))
        .collect();
    map_in_parallel(&starts, |&(axial_forcing, state, angular_forcing)| {
        let mut best = BestLag {
            axial_forcing,
            angular_forcing,
            followed: state.is_some(),
            period: None,
            speed: f64::NEG_INFINITY,
        };
        for step in LAGS_DEG {
            let phase_lag = PI * f64::from(step * LAG_STEP_DEG) / 180.0;
            let system = ForcingParameters {
                axial_forcing,
                angular_forcing,
                phase_lag,
                restitution: inputs.restitution,
            }
            .build()?;
            let orbit = multi_toss(system, start(&system, state, true)?, settings, &Unobserved)?;
            let speed = orbit.mean_angular_speed.unwrap_or_default() / system.twist_speed();
            if speed > best.speed {
                let period = match orbit.class {
                    OrbitClass::Periodic { period, .. } => Some(period),
                    _ => None,
                };
                best = BestLag { speed, period, ..best };
            }
        }
        Ok(best)
    })
}

/// The largest Γ up to which cycles are looked for in which one impact has most of the impulse: where the
/// paper's own motor operates.
const LARGEST_FORCING: f64 = 3.0;
/// Γ_T of the motors simulated there: as in a motor, it leaves the speed to change little in one impact.
const LARGE_ANGULAR_FORCING: f64 = 1.0e4;
/// Impacts of a cycle from rest, at least.
const WEIGHED_IMPACTS: usize = 400;

/// The values of Γ beyond `from` at which more than half of the impulse of a disk from rest comes at one
/// phase, and the mean speed of a motor with the lag that is best for this phase.
pub(super) fn one_impact_decides(
    from: f64,
    restitution: f64,
    quality: Quality,
) -> Result<OneImpactDecides, ExperimentError> {
    let count = quality.choose(300_u32, 2_400);
    let forcing = |index: u32| from + (LARGEST_FORCING - from) * (f64::from(index) + 0.5) / f64::from(count);
    let settings = MultiTossSettings {
        transient_impacts: WEIGHED_IMPACTS,
        examined_impacts: 10 * WEIGHED_IMPACTS,
        ..MultiTossSettings::default()
    };
    let forcings: Vec<f64> = (0..count).map(forcing).collect();
    let found = map_in_parallel(&forcings, |&axial_forcing| {
        let impulses = NormalImpulses::of(&map(axial_forcing, restitution)?, WEIGHED_IMPACTS, 0.0)?;
        let largest = impulses.impacts.iter().max_by(|one, other| one.impulse.total_cmp(&other.impulse));
        let Some(&PhasedImpulse { phase, .. }) = largest else { return Ok(None) };
        // The median of cos(τ + θ) is 1 where most of the impulse comes at the phase −θ.
        if impulses.balance(-phase).steady_speed() < AT_MAXIMUM {
            return Ok(None);
        }
        let system = ForcingParameters {
            axial_forcing,
            angular_forcing: LARGE_ANGULAR_FORCING,
            phase_lag: -phase,
            restitution,
        }
        .build()?;
        let angular_speed = system.twist_speed();
        let start = InitialCondition::Contact { phase: Phase::new(1.5 * PI)?, angular_speed };
        let orbit = multi_toss(system, start, settings, &Unobserved)?;
        Ok(Some(BestLag {
            axial_forcing,
            angular_forcing: LARGE_ANGULAR_FORCING,
            followed: false,
            period: None,
            speed: orbit.mean_angular_speed.unwrap_or_default() / angular_speed,
        }))
    })?;
    Ok(OneImpactDecides {
        axial_forcing_range: (from, LARGEST_FORCING),
        tried: count as usize,
        angular_forcing: LARGE_ANGULAR_FORCING,
        found: found.into_iter().flatten().collect(),
    })
}

/// A speed of at least this share of ωΦ is the maximum, here and everywhere: it differs by rounding.
pub(super) const AT_MAXIMUM: f64 = 1.0 - 1.0e-9;
