//! The computation of the figure.

use std::f64::consts::PI;

use bouncing_disk::core::{
    AfterRest, Attractor, AttractorKind, AttractorSearch, Attractors, Axis, BasinSettings, Basins, Grid,
    ImpactMap, Phase, UNDECIDED, Vibration, basin_fractions_over_observed,
};

use super::data::{BasinsAt, Boundary, ExtraAttractorsData, Found, Kind, Sweep};
use crate::experiment::{ExperimentError, Quality};
use crate::paper;
use crate::progress::{Progress, advancing, sharing};

/// Γ of the two sweeps, and the restitution of the second.
const FORCINGS: [[f64; 2]; 2] = [[0.3, 1.2], [0.1, 1.0]];
const RESTITUTION: f64 = 0.8;

/// Γ and restitution of the basins, and the impacts after which a cell is undecided.
const BASINS: (f64, f64, u32) = (0.35, RESTITUTION, 20_000);

/// The farthest that an attractor may move from one Γ to the next (rad).
const REACH: f64 = 0.3;

/// Distances of uncertain cells.
const DISTANCES: [usize; 5] = [1, 2, 4, 8, 16];

/// Cells along each side of a box of the entropy.
const BOX: usize = 5;

pub(super) fn compute(
    quality: Quality,
    progress: &dyn Progress,
) -> Result<ExtraAttractorsData, ExperimentError> {
    let search = search(quality).map_err(ExperimentError::model)?;
    let forcings = quality.choose(36, 180);
    let cells = quality.choose(150, 600);
    progress.start(2 * forcings as u64 + 4 * cells as u64, "forcings and rows");
    let restitutions = [paper::section_four()?.restitution, RESTITUTION];
    let sweeps = FORCINGS
        .into_iter()
        .zip(restitutions)
        .map(|(range, restitution)| sweep(restitution, middles(range, forcings), &search, progress))
        .collect::<Result<_, _>>()?;
    // Before the basin of the paper's restitution has a fractal boundary, and after.
    let [before, _, _, after, _] = paper::section_four()?.axial_forcings_of_fig7;
    let boundaries = [(before, restitutions[0], 20_000), (after, restitutions[0], 1_000), BASINS]
        .into_iter()
        .map(|case| boundary(case, &search, cells, progress))
        .collect::<Result<_, _>>()?;
    let basins = basins(&search, cells, progress)?;
    Ok(ExtraAttractorsData { basins, boundaries, search, reach: REACH, sweeps })
}

fn search(quality: Quality) -> Result<AttractorSearch, bouncing_disk::core::Error> {
    let (starts, impacts) = quality.choose((256, (1_000, 20_000)), (2_048, (2_000, 100_000)));
    AttractorSearch::default().with_starts(starts)?.with_impacts(impacts.0, impacts.1)
}

/// The middles of equal parts of a range: its round ends are births of orbits.
fn middles([from, to]: [f64; 2], count: usize) -> Vec<f64> {
    (0..count).map(|k| from + (to - from) * (k as f64 + 0.5) / count as f64).collect()
}

fn sweep(
    restitution: f64,
    axial_forcings: Vec<f64>,
    search: &AttractorSearch,
    progress: &dyn Progress,
) -> Result<Sweep, ExperimentError> {
    let over =
        basin_fractions_over_observed(restitution, &axial_forcings, search, REACH, &advancing(progress))
            .map_err(ExperimentError::model)?;
    let found = over.at.iter().map(|at| {
        let all = at.attractors.all().iter().zip(&at.followed);
        all.map(|(attractor, followed)| found(attractor, *followed)).collect()
    });
    let leaves = |at: &&bouncing_disk::core::AttractorsAt| {
        matches!(at.attractors.all()[0].kind, AttractorKind::Rest(AfterRest::LeadsTo(_)))
    };
    Ok(Sweep {
        restitution,
        found: found.collect(),
        followed: over.followed.iter().map(|own| (own.appears, own.vanishes)).collect(),
        rest_is_left: over.at.iter().filter(leaves).map(|at| at.axial_forcing).collect(),
        undecided_starts: over.at.iter().map(|at| at.attractors.undecided().count()).sum(),
        axial_forcings,
    })
}

fn found(attractor: &Attractor, followed: usize) -> Found {
    let (kind, period) = match &attractor.kind {
        AttractorKind::Rest(_) => (Kind::Rest, None),
        AttractorKind::Periodic(known) => {
            let (impacts, periods) = (known.orbit().period(), known.orbit().platform_periods);
            let ratio = periods / impacts as u64;
            let kind = match (periods.is_multiple_of(impacts as u64), ratio) {
                (true, 1) => Kind::Once,
                (true, 2) => Kind::Twice,
                (true, 3) => Kind::Thrice,
                (true, _) => Kind::Longer,
                (false, _) => Kind::Mixed,
            };
            (kind, Some((impacts, periods)))
        }
        AttractorKind::Chaotic { .. } => (Kind::Chaotic, None),
        _ => (Kind::Unclassified, None),
    };
    let starts = (attractor.starts.count(), attractor.starts.of());
    Found { kind, period, followed, starts, interval: attractor.starts.interval() }
}

/// The basins of a case up to the bound of the impact speed: attractors, grid, labels.
fn labelled(
    (forcing, restitution, max_impacts): (f64, f64, u32),
    search: &AttractorSearch,
    cells: usize,
    progress: &dyn Progress,
) -> Result<(Attractors, Grid, Basins), ExperimentError> {
    let vibration = Vibration::from_axial_forcing(forcing).map_err(ExperimentError::model)?;
    let map = ImpactMap::new(vibration, restitution).map_err(ExperimentError::model)?;
    let attractors = map.attractors(search).map_err(ExperimentError::model)?;
    let axis = |high| Axis::new(0.0, high, cells).map_err(ExperimentError::model);
    let grid = Grid::new(axis(1.0)?, axis(map.impact_speed_bound() / PI)?).map_err(ExperimentError::model)?;
    let settings = BasinSettings { max_impacts, ..BasinSettings::default() };
    let basins = attractors.basins_observed(grid, settings, &sharing(progress, cells as u64));
    Ok((attractors, grid, basins.map_err(ExperimentError::model)?))
}

fn boundary(
    case: (f64, f64, u32),
    search: &AttractorSearch,
    cells: usize,
    progress: &dyn Progress,
) -> Result<Boundary, ExperimentError> {
    let (_, _, basins) = labelled(case, search, cells, progress)?;
    Ok(Boundary {
        axial_forcing: case.0,
        restitution: case.1,
        undecided_cells: basins.share(UNDECIDED).count(),
        entropy: basins.entropy(BOX).map_err(ExperimentError::model)?,
        scaling: basins.boundary_scaling(&DISTANCES).map_err(ExperimentError::model)?,
    })
}

fn basins(
    search: &AttractorSearch,
    cells: usize,
    progress: &dyn Progress,
) -> Result<BasinsAt, ExperimentError> {
    let (attractors, grid, basins) = labelled(BASINS, search, cells, progress)?;
    let map = attractors.map();
    let (mut cells_in_region, mut region) = (vec![0; attractors.all().len()], 0);
    for column in 0..cells {
        let phase = Phase::new(grid.impact_angle(column)).map_err(ExperimentError::model)?;
        let bound = map.impact_speed_bound_at(phase) / PI;
        for row in (0..cells).filter(|row| grid.speed().centre(*row) <= bound) {
            region += 1;
            if let Some(number) = usize::from(basins.row(row)[column]).checked_sub(1) {
                cells_in_region[number] += 1;
            }
        }
    }
    let letter = |label: &u8| char::from(b'a' + (*label).min(25));
    Ok(BasinsAt {
        restitution: BASINS.1,
        axial_forcing: BASINS.0,
        top: grid.speed().high(),
        cells,
        max_impacts: BASINS.2,
        found: attractors.all().iter().enumerate().map(|(number, own)| found(own, number)).collect(),
        rows: (0..cells).map(|row| basins.row(row).iter().map(letter).collect()).collect(),
        undecided_cells: basins.share(UNDECIDED).count(),
        cells_in_region,
        region,
    })
}
