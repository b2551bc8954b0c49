//! What bounds a basin: the stable manifold of a saddle.
//!
//!     cargo run --release -p bouncing-disk --example manifolds
#![allow(clippy::print_stdout, reason = "an example shows its result")]

use std::error::Error;

use bouncing_disk::core::attractors::{AttractorSearch, BasinSettings};
use bouncing_disk::core::chaos::{ManifoldKind, ManifoldSettings};
use bouncing_disk::core::{ImpactMap, ImpactState, Unobserved, Vibration};

fn main() -> Result<(), Box<dyn Error>> {
    let map = ImpactMap::new(Vibration::from_axial_forcing(0.34)?, 0.5)?;
    let saddle = map.period_one_pair(1).expect("born at Gamma = 1/3").saddle;
    let saddle = saddle.orbit(&map)?.expect("an orbit of the map");
    let stable =
        map.manifold(&saddle, ManifoldKind::Stable, &ManifoldSettings::new(30.0, 20_000)?, &Unobserved)?;
    for branch in &stable.branches {
        println!(
            "{:?}: length {:.3} in {} pieces, then {:?}",
            branch.side,
            branch.arclength,
            branch.pieces.len(),
            branch.end
        );
    }

    // Does the basin change across it? Compare starts slightly slower and faster than every fourth impact.
    let found = map.attractors(&AttractorSearch::default(), &Unobserved)?;
    let label = |state: &ImpactState, factor: f64| {
        found.basin_label(
            ImpactState::new(state.phase(), factor * state.velocity())?,
            BasinSettings::default(),
        )
    };
    let (mut changes, mut all) = (0, 0);
    for state in stable.pieces().flat_map(|piece| piece.states.iter().step_by(4)) {
        all += 1;
        changes += usize::from(label(state, 0.999)? != label(state, 1.001)?);
    }
    println!("{changes} of {all} impacts on it lie between two basins");
    Ok(())
}
