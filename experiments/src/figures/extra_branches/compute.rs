//! The computation of the figure.

use bouncing_disk::core::{
    BifurcationKind, BranchEnd, ImpactMap, ImpactState, OrbitSearch, VerdictSettings, doubling_cascade,
};
use rayon::prelude::*;

use super::branches::{self, Branches, Walked};
use super::checks;
use super::data::{CascadePoint, Curve, ExtraBranchesData, Mark, MarkKind};
use super::diagram::{self, Lengths};
use crate::experiment::{ExperimentError, Quality};
use crate::figures::fig06::FORCING_RANGE;
use crate::paper;
use crate::progress::Progress;

/// Γ of panel (b).
const WIDE: (f64, f64) = (0.30, 1.50);

/// Pairs of one impact every k periods up to this k: the next is born above panel (b).
const MOST_PERIODS: u64 = 4;

/// Branches that double from k = 1: those of 2, 4 and 8 impacts.
const DOUBLINGS: usize = 3;

/// Γ at which other orbits are searched for, besides those of Fig. 7.
const SEARCHED: [f64; 4] = [0.36, 0.45, 0.58, 0.602];

/// Impacts and periods of what is searched for.
const SEARCHED_IMPACTS: usize = 3;
const SEARCHED_PERIODS: u64 = 3;

/// Impact speeds (rad, that is g/ω) and phases (cycles) of starts.
const START_SPEEDS: [f64; 3] = [1.5, 4.0, 8.0];
const START_PHASES: [f64; 3] = [0.05, 0.4, 0.8];

pub(super) fn compute(
    quality: Quality,
    progress: &dyn Progress,
) -> Result<ExtraBranchesData, ExperimentError> {
    let section = paper::section_four()?;
    let restitution = section.restitution;
    let lengths =
        quality.choose(Lengths { transient: 600, examined: 60 }, Lengths { transient: 3_000, examined: 200 });
    let (columns, wide_columns, start_columns) = quality.choose((160, 120, 24), (1_000, 800, 200));
    let settings = VerdictSettings {
        transient: lengths.transient as u64,
        impacts: quality.choose(1_000, 4_000),
        ..VerdictSettings::default()
    };
    progress.start(4, "stages");
    let mut searched_axial_forcings: Vec<f64> =
        section.axial_forcings_of_fig7.iter().copied().chain(SEARCHED).collect();
    searched_axial_forcings.sort_by(f64::total_cmp);
    let search = OrbitSearch::new(SEARCHED_IMPACTS, SEARCHED_PERIODS).map_err(ExperimentError::model)?;
    let mut found =
        branches::pairs(restitution, WIDE, MOST_PERIODS, DOUBLINGS).map_err(ExperimentError::model)?;
    progress.advance(1);
    branches::add_searched(&mut found, restitution, &searched_axial_forcings, &search, FORCING_RANGE)
        .map_err(ExperimentError::model)?;
    progress.advance(1);
    let marks = marks(&found.all);
    let pairs = (1..=MOST_PERIODS)
        .map(|k| checks::pair(restitution, k, &marks, WIDE.1))
        .collect::<Result<_, _>>()
        .map_err(ExperimentError::model)?;

    let narrow = diagram::forcings(FORCING_RANGE, columns);
    let above: Vec<f64> = diagram::forcings(WIDE, wide_columns)
        .into_iter()
        .filter(|forcing| *forcing > FORCING_RANGE.1)
        .collect();
    let forcings: Vec<f64> = narrow.iter().chain(&above).copied().collect();
    let walks = (1..=MOST_PERIODS)
        .into_par_iter()
        .map(|k| diagram::followed(restitution, k, &forcings, lengths))
        .collect::<Result<Vec<_>, _>>()
        .map_err(ExperimentError::model)?;
    let followed = walks
        .iter()
        .map(|walk| diagram::columns_of(walk, lengths))
        .collect::<Result<_, _>>()
        .map_err(ExperimentError::model)?;
    let from_rest = diagram::from_rest(restitution, &forcings, lengths).map_err(ExperimentError::model)?;
    progress.advance(1);

    let most_doubled = 1_u64 << DOUBLINGS;
    let walked: Vec<(ImpactMap, ImpactState)> = walks.iter().flatten().map(|at| (at.map, at.state)).collect();
    // Of the pairs beyond the first only the orbits of two impacts are drawn.
    let drawn = |impacts: u64, periods: u64| {
        impacts <= 2 || impacts.is_power_of_two() && impacts <= most_doubled && periods == impacts
    };
    let settled = checks::settled(&found.all, &walked, settings, drawn).map_err(ExperimentError::model)?;
    let starts = starts(restitution, start_columns).map_err(ExperimentError::model)?;
    let few = |impacts: u64, periods: u64| impacts <= SEARCHED_IMPACTS as u64 && periods <= SEARCHED_PERIODS;
    let starts = checks::settled(&found.all, &starts, settings, few).map_err(ExperimentError::model)?;
    progress.advance(1);

    let doublings = cascade(restitution, &found)?;
    Ok(ExtraBranchesData {
        restitution,
        axial_forcing_ranges: [FORCING_RANGE, WIDE],
        transient_impacts: lengths.transient,
        examined_impacts: lengths.examined,
        searched_axial_forcings,
        searched_impacts: SEARCHED_IMPACTS,
        searched_periods: SEARCHED_PERIODS,
        followed,
        from_rest,
        curves: found.all.iter().map(curve).collect(),
        marks,
        pairs,
        doublings,
        settled,
        starts,
        search_orbits: found.search_orbits,
        search_orbits_on_branches: found.on_known_branches,
    })
}

/// Starts all over the range of Fig. 6.
fn starts(
    restitution: f64,
    columns: usize,
) -> Result<Vec<(ImpactMap, ImpactState)>, bouncing_disk::core::Error> {
    let mut starts = Vec::new();
    for forcing in diagram::forcings(FORCING_RANGE, columns) {
        let map = branches::map(forcing, restitution)?;
        for phase in START_PHASES {
            for speed in START_SPEEDS {
                let phase = bouncing_disk::core::Phase::new(std::f64::consts::TAU * phase)?;
                starts.push((map, ImpactState::new(phase, -speed)?));
            }
        }
    }
    Ok(starts)
}

/// The doublings that follow one another, beside those of the cascade's own search.
fn cascade(restitution: f64, found: &Branches) -> Result<Vec<CascadePoint>, ExperimentError> {
    let known = doubling_cascade(restitution, found.cascade.len()).map_err(ExperimentError::model)?;
    let first = |branch: &bouncing_disk::core::Branch| {
        branch.of_kind(BifurcationKind::Doubling).next().map(|doubling| doubling.point.parameter)
    };
    let points = found.cascade.iter().zip(known).filter_map(|(branch, known)| {
        let axial_forcing = first(branch)?;
        Some(CascadePoint { impacts: known.period, axial_forcing, of_cascade: known.axial_forcing })
    });
    Ok(points.collect())
}

fn curve(walked: &Walked) -> Curve {
    let phases = |impact: usize| {
        walked.joints.iter().map(|joint| joint.point.orbit.states[impact].phase().cycles()).collect()
    };
    Curve {
        family: walked.family,
        impacts: walked.impacts(),
        platform_periods: walked.platform_periods(),
        axial_forcings: walked.joints.iter().map(|joint| joint.point.parameter).collect(),
        stable: (0..walked.joints.len() - 1).map(|index| walked.stable_after(index)).collect(),
        impact_phase_cycles: (0..walked.impacts()).map(phases).collect(),
        ends_in_bifurcation: walked.ends.map(|end| end == BranchEnd::Bifurcation),
        lost: walked
            .ends
            .iter()
            .any(|end| matches!(end, BranchEnd::StepTooSmall(_) | BranchEnd::PointLimit(_))),
    }
}

/// The special points of all branches. A birth is the doubling of the other branch.
fn marks(walked: &[Walked]) -> Vec<Mark> {
    let of = |walked: &Walked| {
        let family = walked.family;
        let mark = move |found: &bouncing_disk::core::Bifurcation| {
            let kind = match found.kind {
                BifurcationKind::Doubling | BifurcationKind::Birth => MarkKind::Doubling,
                BifurcationKind::Fold => MarkKind::Fold,
                BifurcationKind::Graze { .. } => MarkKind::Graze,
                BifurcationKind::VanishingImpact { .. } => MarkKind::VanishingImpact,
                _ => return None,
            };
            let orbit = &found.point.orbit;
            Some(Mark {
                kind,
                family,
                impacts: orbit.period(),
                platform_periods: orbit.platform_periods,
                axial_forcing: found.point.parameter,
                impact_phase_cycles: orbit.states.iter().map(|state| state.phase().cycles()).collect(),
            })
        };
        walked.bifurcations.iter().filter_map(mark).collect::<Vec<_>>()
    };
    walked.iter().flat_map(of).collect()
}
