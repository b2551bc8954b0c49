//! A basin of attraction: which impacts lead to the period-1 orbit, and which to rest (Fig. 7a of the paper).
//!
//!     cargo run --release -p bouncing-disk --example basin
#![allow(clippy::print_stdout, reason = "an example shows its result")]

use bouncing_disk::Error;
use bouncing_disk::core::attractors::{ATTACHED, Axis, BasinSettings, FIRST_ORBIT, Grid, KnownOrbit};
use bouncing_disk::core::{ImpactMap, Unobserved, Vibration};

fn main() -> Result<(), Error> {
    let map = ImpactMap::new(Vibration::from_axial_forcing(0.34)?, 0.5)?;

    // The orbit whose basin we want, and how near to it a start counts as caught.
    let start = map.period_one(1).expect("it exists from Gamma = 1/3 on");
    let orbit = map.refine(&[start])?;
    let radius = orbit.trapping_radius(&map, 64, &Unobserved).expect("the orbit attracts");
    let known = [KnownOrbit::new(orbit, radius)?];

    // Impact phases of one period, and normalised speeds up to 5.
    let grid = Grid::new(Axis::new(0.0, 1.0, 64)?, Axis::new(0.0, 5.0, 20)?)?;
    let basins = map.basins(grid, &known, BasinSettings::default(), &Unobserved)?;
    for row in (0..grid.speed().cells()).rev() {
        let text: String =
            basins.row(row).iter().map(|&label| if label == FIRST_ORBIT { '#' } else { '.' }).collect();
        println!("{text}");
    }
    println!(
        "{:.3} bounce for ever, {:.3} come to rest",
        basins.fraction(FIRST_ORBIT),
        basins.fraction(ATTACHED)
    );
    Ok(())
}
