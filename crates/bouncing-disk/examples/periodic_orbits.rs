//! All periodic orbits of few impacts at one forcing, and how stable they are.
//!
//!     cargo run --release -p bouncing-disk --example periodic_orbits
#![allow(clippy::print_stdout, reason = "an example shows its result")]

use std::error::Error;

use bouncing_disk::core::orbits::OrbitSearch;
use bouncing_disk::core::{ImpactMap, Unobserved, Vibration};

fn main() -> Result<(), Box<dyn Error>> {
    // Past the second period doubling.
    let map = ImpactMap::new(Vibration::from_axial_forcing(0.535)?, 0.5)?;
    // At most four impacts in at most four periods of the platform.
    let found = map.periodic_orbits(&OrbitSearch::new(4, 4)?, &Unobserved)?;
    println!("impacts periods  first phase  |multiplier|");
    for orbit in &found.orbits {
        let radius = orbit.multipliers().spectral_radius();
        let phase = orbit.states[0].phase().angle();
        let attracts = if radius < 1.0 { "attracts" } else { "" };
        println!(
            "{:7} {:7} {:12.6} {:13.5}  {attracts}",
            orbit.period(),
            orbit.platform_periods,
            phase,
            radius
        );
    }
    let coverage = found.coverage;
    println!("{} starts up to an impact speed of {:.3}", coverage.starts, coverage.impact_speed_bound);
    println!(
        "found again from a grid of twice the distance: {} of {}",
        coverage.found_by_coarser,
        found.orbits.len()
    );
    Ok(())
}
