//! The crisis in which the followed attractor is lost to chattering, and what orbits visit just before it, just after it and
//! beyond.

use std::collections::BTreeSet;

use bouncing_disk::core::chaos::CrisisSearch;
use bouncing_disk::core::sweep::{orbit_diagram, survival_times};
use bouncing_disk::core::{ChatterPolicy, ImpactState, Launch, Orbit, Unobserved};
use bouncing_disk::motion::PAPER_CHATTER;
use serde::Serialize;

use super::diagram::{Diagram, Slice, sampled};
use super::{SAMPLED, no_orbit};
use crate::claims::{Claim, all, paper};
use crate::experiment::{ExperimentError, Paper, Quality};
use crate::figures::shared::map;
use crate::figures::shared::numbers::{extent, occupied_arc};

/// The search runs from so far below to so far above the Γ that the paper prints, or about which the diagram loses the attractor.
const SEARCHED: (f64, f64) = (0.0055, 0.0060);
/// Orbits that the search follows at each Γ.
const FOLLOWED: u32 = 64;
/// Values of Γ, a ten-thousandth apart, at which mean lives are taken: of so many orbits, of so many impacts at most.
const LIVES: u32 = 16;
/// See [`LIVES`].
const LIVE_ORBITS: usize = 8;
/// See [`LIVES`].
const LONGEST_LIFE: usize = 40_000;

#[derive(Serialize)]
pub(super) struct Merging {
    /// Γ of the crisis.
    pub(super) axial_forcing: f64,
    /// At the first of these orbits on the attractor survive; at the second one comes to rest.
    bracket: (f64, f64),
    /// Impacts of the saddle that the attractor touches, if it is known.
    touched_impacts: Option<usize>,
    /// Γ, and the mean number of impacts before the disk attaches (at most [`LONGEST_LIFE`]).
    mean_life_impacts: Vec<(f64, f64)>,
    /// A state on the attractor a little below the crisis.
    #[serde(skip)]
    start: ImpactState,
}

/// Rounded to so many decimals: ends of searches that do not depend on the grid of the diagram.
pub(super) fn rounded(value: f64, decimals: u32) -> f64 {
    let unit = f64::from(10_u32.pow(decimals));
    (value * unit).round() / unit
}

/// Locates the crisis of the followed attractor; `None` if it is not lost where the diagram ends it.
pub(super) fn merging(diagram: &Diagram, quality: Quality) -> Result<Option<Merging>, ExperimentError> {
    let restitution = diagram.inputs.restitution;
    let Some(last) = diagram.followed.last() else { return Ok(None) };
    let printed = paper::section_four()?.merging;
    let about = if (last.axial_forcing - printed).abs() < SEARCHED.0 { printed } else { last.axial_forcing };
    let range = (rounded(about - SEARCHED.0, 4), rounded(about + SEARCHED.1, 4));
    let search = CrisisSearch::new(restitution, range)?;
    let search = search.with_samples(FOLLOWED, quality.choose(100_000, 400_000))?;
    let Ok(crisis) = search.crisis(None, &Unobserved)? else { return Ok(None) };

    let below = map(crisis.bracket.0, restitution)?;
    let from = (1e3 * crisis.bracket.1).floor() / 1e3;
    let forcings: Vec<f64> = (0..LIVES).map(|index| from + 0.0001 * f64::from(index)).collect();
    let (mut state, mut orbits) = (Some(crisis.attractor), Vec::new());
    while orbits.len() < LIVE_ORBITS * forcings.len()
        && let Some(start) = state
    {
        for &forcing in &forcings {
            orbits.push(map(forcing, restitution)?.orbit(start, ChatterPolicy::Complete));
        }
        state = below.state_after(start, 1_000, ChatterPolicy::Complete, &Unobserved)?;
    }
    let lives = survival_times(&orbits, LONGEST_LIFE, &Unobserved)?;
    let mean_life_impacts = forcings.iter().enumerate().map(|(index, &forcing)| {
        let own = lives.iter().skip(index).step_by(forcings.len());
        (forcing, own.clone().sum::<usize>() as f64 / own.count() as f64)
    });
    Ok(Some(Merging {
        axial_forcing: crisis.forcing,
        bracket: crisis.bracket,
        touched_impacts: crisis.tangency.ok().map(|tangency| tangency.touched.period()),
        mean_life_impacts: mean_life_impacts.collect(),
        start: crisis.attractor,
    }))
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
/// The saddle: of so many starts on the attractor before the crisis those orbits that have not come to rest after
/// [`SADDLE_LIFE`] impacts are next to it in the middle of them, for a few impacts.
const SADDLE_STARTS: usize = 4_000;
/// See [`SADDLE_STARTS`].
const SADDLE_LIFE: usize = 40;
/// See [`SADDLE_STARTS`].
const SADDLE_IMPACTS: usize = 4;

/// A cell of the plane: its row, from the speed 0 up, and its column.
fn cell(state: &ImpactState) -> (usize, usize) {
    ((CELLS * state.normalised_speed()) as usize, (CELLS * state.phase().cycles()) as usize)
}

/// The cells that some states lie in or next to; the last column touches the first.
fn near(states: &[ImpactState]) -> BTreeSet<(usize, usize)> {
    let cells: BTreeSet<_> = states.iter().map(cell).collect();
    let around = |(row, column): (usize, usize)| {
        let rows = row.saturating_sub(1)..=row + 1;
        rows.flat_map(move |row| [COLUMNS - 1, 0, 1].map(|across| (row, (column + across) % COLUMNS)))
    };
    cells.into_iter().flat_map(around).collect()
}

/// The part of the plane of phase and speed that orbits visit.
#[derive(Serialize)]
struct Visited {
    axial_forcing: f64,
    impacts: usize,
    /// Occupied arc of the phases, in periods.
    arc_cycles: f64,
    /// Largest |w_A Γ/(ωA)|.
    largest_speed: f64,
    /// Cells of the plane visited, a hundredth of a period wide and a hundredth high.
    cells: usize,
}

impl Visited {
    fn of(axial_forcing: f64, states: &[ImpactState]) -> Self {
        Self {
            axial_forcing,
            impacts: states.len(),
            arc_cycles: occupied_arc(states.iter().map(|state| state.phase().cycles())).unwrap_or_default(),
            largest_speed: states.iter().map(ImpactState::normalised_speed).fold(0.0, f64::max),
            cells: states.iter().map(cell).collect::<BTreeSet<_>>().len(),
        }
    }
}

/// How many impacts of the orbit from rest lie near the chaotic saddle at the same Γ.
#[derive(Serialize)]
struct Shadow {
    axial_forcing: f64,
    /// Share of the impacts within a hundredth or two of the saddle, in periods and in |w_A Γ/(ωA)|.
    share_near: f64,
    /// Share of the plane, up to the largest speed just after the crisis, that is so near.
    share_of_plane: f64,
}

/// The first impacts of a disk from rest.
fn from_rest(
    axial_forcing: f64,
    restitution: f64,
    impacts: usize,
) -> Result<Vec<ImpactState>, ExperimentError> {
    let map = map(axial_forcing, restitution)?;
    let leaves = map.vibration().separation_phase().ok_or_else(|| no_orbit(axial_forcing))?;
    let orbit = map.orbit_from_launch(Launch::new(leaves, 0.0)?, PAPER_CHATTER);
    Ok(orbit_diagram(&[orbit], 0, impacts, &Unobserved)?.concat())
}

/// The widening at the crisis and the shadow of the attractor beyond it.
pub(super) fn crisis(
    fig: &mut Paper<'_>,
    diagram: &Diagram,
    doublings: &[f64],
    merging: Option<&Merging>,
) -> Result<(), ExperimentError> {
    fig.record("merging", &merging)?;
    fig.claim(merging.map_or_else(
        || Claim::printed("section4.merging", f64::NAN),
        |of| {
            let touched = of.touched_impacts.map_or_else(String::new, |impacts| {
                format!("the attractor touches a saddle of {impacts} impacts; ")
            });
            let away = |forcing: f64| (forcing - of.axial_forcing).abs();
            Claim::printed("section4.merging", of.axial_forcing).note(format!(
                "{touched}none of {FOLLOWED} orbits on it rests {:.0e} below, one rests {:.0e} above",
                away(of.bracket.0),
                away(of.bracket.1),
            ))
        },
    ));
    let mut shadows = Vec::new();
    let mut widths = None;
    if let Some(merging) = merging {
        let (crisis, restitution) = (merging.axial_forcing, diagram.inputs.restitution);
        let orbit = |forcing: f64, start: ImpactState| -> Result<Orbit, ExperimentError> {
            Ok(map(forcing, restitution)?.orbit(start, PAPER_CHATTER))
        };
        let beside = [crisis - BESIDE, crisis + BESIDE];
        // The start lies on the attractor at a slightly lower Γ; a few impacts take it to the present one.
        let orbits = [orbit(beside[0], merging.start)?, orbit(beside[1], merging.start)?];
        let visited = orbit_diagram(&orbits, 100, VISITING, &Unobserved)?;
        let chattering = from_rest(beside[0], restitution, VISITING)?;
        let [before, after] = [0, 1].map(|side| Visited::of(beside[side], &visited[side]));
        let rows = (CELLS * after.largest_speed) as usize + 1;
        let beyond: Vec<f64> = diagram.resting().into_iter().filter(|forcing| *forcing > crisis).collect();
        for axial_forcing in sampled(SAMPLED, &beyond) {
            let starts = visited[0].iter().take(SADDLE_STARTS);
            let orbits: Vec<Orbit> =
                starts.map(|state| orbit(axial_forcing, *state)).collect::<Result<_, _>>()?;
            let lives = survival_times(&orbits, SADDLE_LIFE, &Unobserved)?;
            let lasting = orbits.into_iter().zip(lives).filter(|(_, lived)| *lived >= SADDLE_LIFE);
            let lasting: Vec<Orbit> = lasting.map(|(orbit, _)| orbit).collect();
            let near = near(&orbit_diagram(&lasting, SADDLE_LIFE / 2, SADDLE_IMPACTS, &Unobserved)?.concat());
            let states = from_rest(axial_forcing, restitution, SHADOWING)?;
            let shadowing = states.iter().filter(|state| near.contains(&cell(state))).count();
            let share = |count: usize, of: usize| count as f64 / of.max(1) as f64;
            shadows.push(Shadow {
                axial_forcing,
                share_near: share(shadowing, states.len()),
                share_of_plane: share(near.iter().filter(|(row, _)| *row < rows).count(), COLUMNS * rows),
            });
        }
        let union = Visited::of(beside[0], &[&visited[0][..], &chattering].concat());
        widths = Some([before, union, after]);
    }
    fig.claims([widening(diagram, doublings, widths.as_ref()), shadow(&shadows)]);
    let explored = widths.map(|[before, before_with_chattering, after]| Explored {
        before,
        before_with_chattering,
        after,
        shadows,
    });
    fig.record("explored", &explored)
}

#[derive(Serialize)]
struct Explored {
    /// The attractor just before the crisis; the same with as many impacts of a disk from rest there.
    before: Visited,
    before_with_chattering: Visited,
    /// The orbit that starts on that attractor, just after the crisis.
    after: Visited,
    /// Beyond the crisis, at some Γ at which a disk from rest comes to rest again.
    shadows: Vec<Shadow>,
}

/// Just after the crisis against just before it.
fn widening(diagram: &Diagram, doublings: &[f64], widths: Option<&[Visited; 3]>) -> Claim {
    // The widening of the attractor on the whole way from the doublings to the crisis.
    let chaotic = chaotic(diagram, doublings);
    let arc = |slice: &Slice| occupied_arc(slice.impact_phase_cycles.iter().copied()).unwrap_or_default();
    let fastest = |slice: &Slice| slice.normalised_impact_speed.iter().copied().fold(0.0, f64::max);
    let arcs = extent(chaotic.iter().map(|slice| arc(slice)));
    let speeds = extent(chaotic.iter().map(|slice| fastest(slice)));
    let widths = widths.filter(|_| !chaotic.is_empty());
    let sudden = widths.map(|[before, _, after]| {
        after.arc_cycles - before.arc_cycles > arcs.1 - arcs.0
            && after.largest_speed - before.largest_speed > speeds.1 - speeds.0
    });
    let words = widths.map_or_else(String::new, |[before, _, after]| {
        format!(
            "arc of the phases {:.3} to {:.3} of a period at the crisis, {:.3} to {:.3} before; largest speed {:.3} to {:.3}, {:.3} to {:.3} before",
            before.arc_cycles, after.arc_cycles, arcs.0, arcs.1, before.largest_speed, after.largest_speed, speeds.0, speeds.1,
        )
    });
    Claim::printed_statement("section4.sudden_widening", sudden, words)
}

/// The slices of the followed attractor beyond the last doubling that are not periodic.
fn chaotic<'a>(diagram: &'a Diagram, doublings: &[f64]) -> Vec<&'a Slice> {
    let beyond = diagram.between(doublings.last().copied().unwrap_or(f64::NAN), f64::INFINITY);
    beyond.into_iter().filter(|slice| slice.period.is_none()).collect()
}

/// The orbits beyond the merging follow the chaotic saddle that the attractor has become, each at its own Γ.
fn shadow(shadows: &[Shadow]) -> Claim {
    let over_plane = extent(shadows.iter().map(|of| of.share_near / of.share_of_plane));
    let mean = |of: fn(&Shadow) -> f64| shadows.iter().map(of).sum::<f64>() / shadows.len().max(1) as f64;
    Claim::printed_statement(
        "section4.orbits_shadow_attractor",
        all(shadows, |of| of.share_near > of.share_of_plane),
        format!(
            "next to the saddle lie {:.3} of the impacts from rest and {:.3} of the plane, on average over {} Γ; at each Γ {:.1} times as many or more",
            mean(|of| of.share_near),
            mean(|of| of.share_of_plane),
            shadows.len(),
            over_plane.0,
        ),
    )
}
