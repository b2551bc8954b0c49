//! The computation of the figure.

use bouncing_disk::core::{
    AfterRest, Attractor, AttractorKind, AttractorSearch, Axis, BasinSettings, Grid, ImpactMap, Phase,
    UNDECIDED, Vibration, basin_fractions_over_observed,
};

use super::data::{BasinsAt, ExtraAttractorsData, Found, Kind, Sweep};
use crate::experiment::{ExperimentError, Quality};
use crate::paper;
use crate::progress::{Progress, advancing};

/// Γ of the two sweeps, and the restitution of the second.
const FORCINGS: [[f64; 2]; 2] = [[0.3, 1.2], [0.1, 1.0]];
const RESTITUTION: f64 = 0.8;

/// Γ of the basins.
const FORCING: f64 = 0.35;

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
    let forcings = quality.choose(37, 181);
    let cells = quality.choose(150, 600);
    progress.start(2 * forcings as u64 + cells as u64, "forcings and rows");
    let restitutions = [paper::section_four()?.restitution, RESTITUTION];
    let sweeps = FORCINGS
        .into_iter()
        .zip(restitutions)
        .map(|(range, restitution)| sweep(restitution, even(range, forcings), &search, progress))
        .collect::<Result<_, _>>()?;
    Ok(ExtraAttractorsData { basins: basins(&search, cells, progress)?, search, reach: REACH, sweeps })
}

fn search(quality: Quality) -> Result<AttractorSearch, bouncing_disk::core::Error> {
    let (starts, impacts) = quality.choose((256, (1_000, 20_000)), (2_048, (2_000, 100_000)));
    AttractorSearch::default().with_starts(starts)?.with_impacts(impacts.0, impacts.1)
}

/// Numbers at equal distances, both ends among them.
fn even([from, to]: [f64; 2], count: usize) -> Vec<f64> {
    (0..count).map(|k| from + (to - from) * k as f64 / (count - 1) as f64).collect()
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

fn basins(
    search: &AttractorSearch,
    cells: usize,
    progress: &dyn Progress,
) -> Result<BasinsAt, ExperimentError> {
    let vibration = Vibration::from_axial_forcing(FORCING).map_err(ExperimentError::model)?;
    let map = ImpactMap::new(vibration, RESTITUTION).map_err(ExperimentError::model)?;
    let attractors = map.attractors(search).map_err(ExperimentError::model)?;
    let top = map.impact_speed_bound() / std::f64::consts::PI;
    let axis = |high| Axis::new(0.0, high, cells).map_err(ExperimentError::model);
    let grid = Grid::new(axis(1.0)?, axis(top)?).map_err(ExperimentError::model)?;
    let settings = BasinSettings { max_impacts: 20_000, ..BasinSettings::default() };
    let basins =
        attractors.basins_observed(grid, settings, &advancing(progress)).map_err(ExperimentError::model)?;
    let (mut cells_in_region, mut region) = (vec![0; attractors.all().len()], 0);
    for column in 0..cells {
        let phase = Phase::new(grid.impact_angle(column)).map_err(ExperimentError::model)?;
        let bound = map.impact_speed_bound_at(phase) / std::f64::consts::PI;
        for row in (0..cells).filter(|row| grid.speed().centre(*row) <= bound) {
            region += 1;
            if let Some(number) = usize::from(basins.row(row)[column]).checked_sub(1) {
                cells_in_region[number] += 1;
            }
        }
    }
    let letter = |label: &u8| char::from(b'a' + (*label).min(25));
    Ok(BasinsAt {
        restitution: RESTITUTION,
        axial_forcing: FORCING,
        top,
        cells,
        max_impacts: settings.max_impacts,
        found: attractors.all().iter().enumerate().map(|(number, own)| found(own, number)).collect(),
        rows: (0..cells).map(|row| basins.row(row).iter().map(letter).collect()).collect(),
        undecided_cells: basins.share(UNDECIDED).count(),
        cells_in_region,
        region,
        entropy: basins.entropy(BOX).map_err(ExperimentError::model)?,
        scaling: basins.boundary_scaling(&DISTANCES).map_err(ExperimentError::model)?,
    })
}
