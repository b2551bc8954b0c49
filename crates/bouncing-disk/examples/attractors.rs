//! All attractors at one forcing without being told, and what their basins are like.
//!
//!     cargo run --release -p bouncing-disk --example attractors
#![allow(clippy::print_stdout, reason = "an example shows its result")]

use std::error::Error;

use bouncing_disk::core::attractors::{AttractorKind, AttractorSearch, Axis, BasinSettings, Grid};
use bouncing_disk::core::{ImpactMap, Unobserved, Vibration};

fn main() -> Result<(), Box<dyn Error>> {
    // Fig. 7(b) of the paper, which has two attractors there.
    let map = ImpactMap::new(Vibration::from_axial_forcing(0.486)?, 0.5)?;
    println!("no attractor has a faster impact than {:.3}", map.impact_speed_bound());
    let found = map.attractors(&AttractorSearch::default(), &Unobserved)?;
    for attractor in found.all() {
        let (share, (low, high)) = (attractor.starts.value(), attractor.starts.interval());
        let what = match &attractor.kind {
            AttractorKind::Rest(_) => "at rest, again and again".to_owned(),
            AttractorKind::Periodic(known) => {
                let radius = known.orbit().multipliers().spectral_radius();
                format!("period {}, largest multiplier {radius:.6}", known.orbit().period())
            }
            _ => "without a period".to_owned(),
        };
        println!("{what}: {:.1} % of the starts ({:.1} to {:.1})", 100.0 * share, 100.0 * low, 100.0 * high);
    }

    // The window of Fig. 7.
    let grid = Grid::new(Axis::new(0.0, 1.0, 150)?, Axis::new(0.0, 5.0, 150)?)?;
    let basins = found.basins(grid, BasinSettings::default(), &Unobserved)?;
    let entropy = basins.entropy(5)?;
    println!("basin entropy {:.3}, on the boundary {:.3?}", entropy.entropy, entropy.boundary_entropy);
    println!("uncertain shares: {:?}", basins.boundary_scaling(&[1, 2, 4, 8], &Unobserved)?.fit);
    Ok(())
}
