//! The computation of the figure.

use std::f64::consts::PI;

use bouncing_disk::core::{
    ATTACHED, Axis, BasinSettings, BifurcationKind, Branch, Continuation, ContinuationParameter, Error,
    FIRST_ORBIT, Grid, ImpactMap, ImpactState, KnownOrbit, Label, Manifold, ManifoldKind, ManifoldSettings,
    OrbitSearch, PeriodicOrbit, Phase, Stability, Vibration,
};

use super::data::{ExtraManifoldsData, Panel, Spot, ThirdAttractor};
use crate::experiment::{ExperimentError, Quality};
use crate::figures::manifold_lines::lines;
use crate::paper;
use crate::progress::{Progress, advancing};

/// Top of the window of speeds, that of Fig. 7.
const WINDOW_TOP: f64 = 5.0;
/// How far from a manifold a pair of starts lies to either side (rad, units of g/omega).
const ASIDE: f64 = 1.0e-6;
/// Pairs of starts of a panel.
const PAIRS: usize = 400;
/// Impacts after which a start counts as one that does not come to rest.
const IMPACTS: u32 = 1_000;

pub(super) fn compute(
    quality: Quality,
    progress: &dyn Progress,
) -> Result<ExtraManifoldsData, ExperimentError> {
    let printed = paper::section_four()?;
    let cells = quality.choose(80, 600);
    let arclength = quality.choose(150.0, 1_500.0);
    let [a, b, c, d, _] = printed.axial_forcings_of_fig7;
    progress.start(4 * cells as u64, "rows");
    let mut panels = Vec::new();
    for (forcing, has_third) in [(a, false), (b, true), (c, false), (d, false)] {
        let made = panel(forcing, printed.restitution, has_third, (cells, arclength), progress);
        panels.push(made.map_err(ExperimentError::model)?);
    }
    let third = third(b, printed.restitution).map_err(ExperimentError::model)?;
    let third =
        third.ok_or_else(|| ExperimentError::NoData { quantity: "the third attractor".to_owned() })?;
    Ok(ExtraManifoldsData { restitution: printed.restitution, window_top: WINDOW_TOP, cells, panels, third })
}

fn map(axial_forcing: f64, restitution: f64) -> Result<ImpactMap, Error> {
    ImpactMap::new(Vibration::from_axial_forcing(axial_forcing)?, restitution)
}

/// All periodic orbits of few impacts.
fn orbits(map: &ImpactMap) -> Result<Vec<PeriodicOrbit>, Error> {
    Ok(map.periodic_orbits(&OrbitSearch::new(4, 2)?.with_starts(64, 64)?)?.orbits)
}

fn attracts(orbit: &PeriodicOrbit) -> bool {
    orbit.stability() == Stability::Stable
}

/// The basins at one forcing; with the third attractor also the manifold of the saddle that is born with it.
fn panel(
    forcing: f64,
    restitution: f64,
    with_third: bool,
    (cells, arclength): (usize, f64),
    progress: &dyn Progress,
) -> Result<Panel, Error> {
    let map = map(forcing, restitution)?;
    let orbits = orbits(&map)?;
    let mut known = Vec::new();
    for orbit in orbits.iter().filter(|orbit| attracts(orbit)) {
        known.push(KnownOrbit::new(orbit.clone(), orbit.trapping_radius(&map, 64)?)?);
    }
    let settings = BasinSettings { max_impacts: IMPACTS, ..BasinSettings::default() };
    let grid = Grid::new(Axis::new(0.0, 1.0, cells)?, Axis::new(0.0, WINDOW_TOP, cells)?)?;
    let basins = map.basins_observed(grid, &known, settings, &advancing(progress))?;
    let kinds: Vec<u8> = basins.labels().iter().map(|label| kind(*label, &known)).collect();
    let mut saddles: Vec<PeriodicOrbit> = Vec::new();
    if let Some(pair) = map.period_one_pair(1) {
        saddles.extend(pair.saddle.orbit(&map)?);
    }
    if with_third {
        // Of the saddles of two impacts in one period the one with both multipliers positive.
        saddles.extend(orbits.iter().filter(|orbit| is_partner(orbit)).cloned());
    }
    let fastest = PI * (forcing + restitution * WINDOW_TOP);
    let wanted = ManifoldSettings::new(arclength, 400_000)?.with_launch_speed(fastest)?;
    let mut manifolds = Vec::new();
    for saddle in &saddles {
        manifolds.push(map.manifold(saddle, ManifoldKind::Stable, &wanted)?);
    }
    let (pairs, different) = across(&map, &manifolds, &known, settings)?;
    let marked = Marked::of(&manifolds, cells);
    let (borders, borders_on_manifold) = marked.borders(&kinds);
    Ok(Panel {
        axial_forcing: forcing,
        rows: kinds
            .chunks(cells)
            .map(|row| row.iter().map(|kind| char::from(b'0' + kind)).collect())
            .collect(),
        saddles: saddles.iter().flat_map(|orbit| &orbit.states).map(|state| spot(*state)).collect(),
        arclength: manifolds.iter().flat_map(|own| &own.branches).fold(0.0, |sum, own| sum + own.arclength),
        manifolds: manifolds.iter().flat_map(|own| lines(own, spot)).collect(),
        pairs,
        different,
        borders,
        borders_on_manifold,
    })
}

/// A saddle of two impacts in one period, both multipliers positive: what is born in a fold.
fn is_partner(orbit: &PeriodicOrbit) -> bool {
    let trace = orbit.monodromy.x_axis.x + orbit.monodromy.y_axis.y;
    orbit.period() == 2 && orbit.platform_periods == 1 && trace > 2.0
}

/// At rest; not; on a known orbit of another number of impacts than periods.
fn kind(label: Label, known: &[KnownOrbit]) -> u8 {
    if label == ATTACHED {
        return 0;
    }
    let caught = label.checked_sub(FIRST_ORBIT).and_then(|index| known.get(usize::from(index)));
    let other = caught.is_some_and(|own| own.orbit().period() as u64 != own.orbit().platform_periods);
    if other { 2 } else { 1 }
}

fn spot(state: ImpactState) -> Spot {
    (state.phase().cycles(), state.normalised_speed())
}

/// Pairs of starts on both sides of the manifolds, and how many become different things.
fn across(
    map: &ImpactMap,
    manifolds: &[Manifold],
    known: &[KnownOrbit],
    settings: BasinSettings,
) -> Result<(usize, usize), Error> {
    let segments: Vec<_> = manifolds
        .iter()
        .flat_map(Manifold::pieces)
        .flat_map(|piece| piece.states.windows(2))
        .filter(|pair| (pair[1].phase().angle() - pair[0].phase().angle()).abs() < PI)
        .collect();
    let (mut pairs, mut different) = (0, 0);
    for pair in segments.iter().step_by(segments.len().div_ceil(PAIRS).max(1)) {
        let along =
            (pair[1].phase().angle() - pair[0].phase().angle(), pair[1].velocity() - pair[0].velocity());
        let length = (along.0 * along.0 + along.1 * along.1).sqrt();
        let aside = |by: f64| {
            let phase = Phase::new(pair[0].phase().angle() - by * along.1 / length)?;
            ImpactState::new(phase, pair[0].velocity() + by * along.0 / length)
        };
        let (Ok(left), Ok(right)) = (aside(ASIDE), aside(-ASIDE)) else { continue };
        let label = |start: ImpactState| map.basin_label(start, known, settings);
        pairs += 1;
        different += usize::from(label(left)? != label(right)?);
    }
    Ok((pairs, different))
}

/// The cells that manifolds run through.
struct Marked {
    cells: usize,
    marked: Vec<bool>,
}

impl Marked {
    fn of(manifolds: &[Manifold], cells: usize) -> Self {
        let mut marked = vec![false; cells * cells];
        let size = cells as f64;
        for piece in manifolds.iter().flat_map(|own| lines(own, spot)) {
            for pair in piece.windows(2) {
                let by = (pair[1].0 - pair[0].0, pair[1].1 - pair[0].1);
                let steps = (4.0 * size * by.0.abs().max(by.1.abs() / WINDOW_TOP)).ceil().max(1.0) as usize;
                for step in 0..=steps {
                    let share = step as f64 / steps as f64;
                    let column = (size * (pair[0].0 + share * by.0)) as usize;
                    let row = (size * (pair[0].1 + share * by.1) / WINDOW_TOP) as usize;
                    if column < cells && row < cells {
                        marked[row * cells + column] = true;
                    }
                }
            }
        }
        Self { cells, marked }
    }

    /// Whether a cell or one of its neighbours is marked.
    fn near(&self, row: usize, column: usize) -> bool {
        let around = |middle: usize| middle.saturating_sub(1)..=(middle + 1).min(self.cells - 1);
        around(row).any(|row| around(column).any(|column| self.marked[row * self.cells + column]))
    }

    /// Borders between neighbouring cells of different kinds, and how many of them are near a manifold.
    fn borders(&self, kinds: &[u8]) -> (usize, usize) {
        let (mut all, mut near) = (0, 0);
        for row in 0..self.cells {
            for column in 0..self.cells {
                let own = kinds[row * self.cells + column];
                for (other_row, other_column) in [(row + 1, column), (row, column + 1)] {
                    if other_row < self.cells
                        && other_column < self.cells
                        && kinds[other_row * self.cells + other_column] != own
                    {
                        all += 1;
                        near += usize::from(self.near(row, column) || self.near(other_row, other_column));
                    }
                }
            }
        }
        (all, near)
    }
}

/// The branch of the third attractor, an orbit of more impacts than periods.
fn third(forcing: f64, restitution: f64) -> Result<Option<ThirdAttractor>, Error> {
    let map = map(forcing, restitution)?;
    let found = orbits(&map)?;
    let other = |orbit: &&PeriodicOrbit| attracts(orbit) && orbit.period() as u64 != orbit.platform_periods;
    let Some(orbit) = found.iter().find(other) else { return Ok(None) };
    let way = |rising: bool| {
        Continuation::new(ContinuationParameter::Forcing, (0.4, 0.6), rising)?.with_steps(0.001, 0.01, 10_000)
    };
    let at = |branch: &Branch, kind: BifurcationKind| {
        branch.of_kind(kind).next().map(|found| (found.point.parameter, found.point.orbit.clone()))
    };
    let (down, up) = (map.continued(orbit, &way(false)?)?, map.continued(orbit, &way(true)?)?);
    let (Some((birth, parent)), Some((doubling, _))) =
        (at(&down, BifurcationKind::Birth), at(&up, BifurcationKind::Doubling))
    else {
        return Ok(None);
    };
    let map = down.map_at(birth)?;
    for rising in [false, true] {
        let branch = map.continued(&map.refine(&parent.states)?, &way(rising)?)?;
        if let Some((fold, _)) = at(&branch, BifurcationKind::Fold) {
            return Ok(Some(ThirdAttractor { impacts: orbit.period(), fold, birth, doubling }));
        }
    }
    Ok(None)
}
