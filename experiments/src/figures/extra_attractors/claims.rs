//! What the attractors show, and their check.

use bouncing_disk::core::numerics::fraction::Fraction;
use bouncing_disk::core::{BoundaryFit, ImpactMap, Vibration};

use super::data::{Boundary, ExtraAttractorsData, Found, Sweep};
use crate::claim::{self, Claim};

const ID: &str = "extra-attractors";
const PLACE: &str = "this work";

/// Standard errors by which the share of the starts may differ from that of the cells of a grid: one in a thousand
/// would be farther away by chance.
const FAR: f64 = 3.3;

/// The share of uncertain cells at a smooth boundary grows as the first power of the distance; a grid finds a little less.
const SMOOTH_FROM: f64 = 0.9;

pub(super) fn claims(data: &ExtraAttractorsData) -> Vec<Claim> {
    let several: Vec<String> = data
        .sweeps
        .iter()
        .map(|sweep| {
            let (most, forcing) = sweep.most();
            format!(
                "restitution {}: several beside rest at {} of {} forcings, at most {most}, first at Γ = {forcing:.4}; {} attractors are \
                 followed, {} starts are undecided",
                sweep.restitution,
                sweep.several(),
                sweep.axial_forcings.len(),
                sweep.followed.len() - 1,
                sweep.undecided_starts,
            )
        })
        .collect();
    let left: Vec<String> = data
        .sweeps
        .iter()
        .map(|sweep| format!("restitution {}: {} forcings", sweep.restitution, sweep.rest_is_left.len()))
        .collect();
    vec![
        Claim::statement(
            ID,
            PLACE,
            "for the restitution 0.8 there are forcings with more attractors beside rest than for that of the paper",
            match &data.sweeps[..] {
                [paper, higher] => Some(higher.most().0 > paper.most().0),
                _ => None,
            },
            several.join(". "),
        ),
        outside(data),
        as_a_grid(data),
        Claim::statement(
            ID,
            PLACE,
            "there are forcings at which a disk that has come to rest never does so again",
            claim::any(&data.sweeps, |sweep| !sweep.rest_is_left.is_empty()),
            left.join(", "),
        ),
        boundary(data),
    ]
}

/// Orbits with one impact, against their closed form.
fn outside(data: &ExtraAttractorsData) -> Claim {
    let orbits = data.sweeps.iter().flat_map(|sweep| {
        let at = sweep.found.iter().zip(&sweep.axial_forcings);
        at.flat_map(move |(found, forcing)| found.iter().map(move |own| (sweep, *forcing, own)))
    });
    let single: Vec<_> = orbits
        .filter_map(|(sweep, forcing, own)| match own.period {
            Some((1, periods)) => Some((sweep, forcing, periods)),
            _ => None,
        })
        .collect();
    let attracts = |(sweep, forcing, periods): &(&Sweep, f64, u64)| {
        let vibration = Vibration::from_axial_forcing(*forcing).ok()?;
        let pair = ImpactMap::new(vibration, sweep.restitution).ok()?.period_one_pair(*periods)?;
        Some(pair.node.multipliers().spectral_radius() < 1.0)
    };
    Claim::statement(
        ID,
        PLACE,
        "orbits of one impact are found between their birth and their doubling alone",
        claim::all(&single, |orbit| attracts(orbit) == Some(true)),
        format!("{} of them, against multipliers in closed form", single.len()),
    )
}

/// The shares of the starts against those of the cells of a grid.
fn as_a_grid(data: &ExtraAttractorsData) -> Claim {
    let basins = &data.basins;
    let near = |(own, cells): (&Found, &u64)| {
        let share = *cells as f64 / basins.region as f64;
        Fraction::new(own.starts.0, own.starts.1).is_ok_and(|starts| {
            let (low, high) = starts.wilson(FAR);
            low <= share && share <= high
        })
    };
    let words = basins.found.iter().zip(&basins.cells_in_region).map(|(own, cells)| {
        let grid = 100.0 * *cells as f64 / basins.region as f64;
        format!("{}: {:.2} % and {grid:.2} %", own.name(), 100.0 * own.share())
    });
    Claim::statement(
        ID,
        PLACE,
        "the shares of the starts are those of the cells of (c) that lie in the region",
        claim::all(basins.found.iter().zip(&basins.cells_in_region), near),
        format!(
            "within 3.3 standard errors; {} of {} cells are undecided. {}",
            basins.undecided_cells,
            basins.cells * basins.cells,
            words.collect::<Vec<_>>().join(", ")
        ),
    )
}

/// The boundaries: a smooth one, and one that is not. That in between is told with its numbers: where most cells are
/// uncertain a grid shows no power law.
fn boundary(data: &ExtraAttractorsData) -> Claim {
    let holds = match &data.boundaries[..] {
        [before, _, most] => {
            let smooth = matches!(before.scaling.fit, BoundaryFit::PowerLaw { exponent, .. } if exponent > SMOOTH_FROM);
            let ln_2 = std::f64::consts::LN_2;
            Some(smooth && most.entropy.boundary_entropy.is_some_and(|own| own > ln_2))
        }
        _ => None,
    };
    Claim::statement(
        ID,
        PLACE,
        "the boundary of the basin is smooth at the first of the forcings of (d), and at the third S_bb exceeds ln 2, the most that a box has which a smooth curve cuts",
        holds,
        data.boundaries.iter().map(Boundary::words).collect::<Vec<_>>().join(". "),
    )
}
