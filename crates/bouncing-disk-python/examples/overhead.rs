//! Prints the least time (s) of five basins of 1,000 x 1,000 starts: what `benchmarks/overhead.py` compares
//! with.
//!
//!     cargo run --release -p bouncing-disk-python --example overhead
#![allow(clippy::print_stdout, reason = "an example shows its result")]

use std::time::Instant;

use bouncing_disk::Error;
use bouncing_disk::core::attractors::{Axis, BasinSettings, Grid, KnownOrbit};
use bouncing_disk::core::{ImpactMap, ImpactState, Unobserved, Vibration};

fn main() -> Result<(), Error> {
    let map = ImpactMap::new(Vibration::from_axial_forcing(0.45)?, 0.5)?;
    let start = ImpactState::from_normalised(1.2, 1.3)?;
    let Some(orbit) = map.settled_orbit(start, 2000, 64, 1e-7, &Unobserved)? else { return Ok(()) };
    let Ok(radius) = orbit.trapping_radius(&map, 64, &Unobserved) else { return Ok(()) };
    let known = [KnownOrbit::new(orbit, radius)?];
    let grid = Grid::new(Axis::new(0.0, 1.0, 1000)?, Axis::new(0.0, 3.0, 1000)?)?;
    let mut least = f64::INFINITY;
    for _ in 0..5 {
        let began = Instant::now();
        let basins = map.basins(grid, &known, BasinSettings::default(), &Unobserved)?;
        least = least.min(began.elapsed().as_secs_f64());
        assert_eq!(basins.labels().len(), 1_000_000);
    }
    println!("{least}");
    Ok(())
}
