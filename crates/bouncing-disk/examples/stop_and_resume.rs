//! A grid of basins that is stopped, stored, read again and finished, and one that is made in parts.
//!
//!     cargo run --release -p bouncing-disk --example stop_and_resume
#![allow(clippy::print_stdout, reason = "an example shows its result")]

use std::error::Error;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicU32, Ordering};

use bouncing_disk::Progress;
use bouncing_disk::core::attractors::{AttractorSearch, Axis, BasinRun, BasinSettings, Basins, Grid};
use bouncing_disk::core::{Error as CoreError, ImpactMap, Unobserved, Vibration};

fn main() -> Result<(), Box<dyn Error>> {
    let map = ImpactMap::new(Vibration::from_axial_forcing(0.45)?, 0.5)?;
    let found = map.attractors(&AttractorSearch::default(), &Unobserved)?;
    let grid = Grid::new(Axis::new(0.0, 1.0, 120)?, Axis::new(0.0, 5.0, 120)?)?;
    let settings = BasinSettings::default();
    let whole = found.basins(grid, settings, &Unobserved)?;

    // A run of basins needs the periodic attractors. This observer stops it at its fourth call.
    let known: Vec<_> = found.known().cloned().collect();
    let calls = AtomicU32::new(0);
    let stop = |_: Progress| {
        if calls.fetch_add(1, Ordering::Relaxed) < 3 {
            ControlFlow::Continue(())
        } else {
            ControlFlow::Break(())
        }
    };
    let mut run = BasinRun::new(map, grid, &known, settings)?;
    let stopped = run.advance(&stop);
    println!("stopped before the end: {}", matches!(stopped, Err(CoreError::Stopped { .. })));
    // Needs the feature `float_roundtrip` of serde_json: without it a third of all numbers change a last bit.
    let stored = serde_json::to_string(&run)?;
    let mut run: BasinRun = serde_json::from_str(&stored)?;
    run.advance(&bouncing_disk::Unobserved)?;
    println!("the same basins after it was stored: {}", run.into_basins()? == whole);

    // Rows may be computed anywhere, in any order; attractors without a period are recognised, too.
    let upper = found.basins_of_rows(grid, 60..120, settings, &Unobserved)?;
    let lower = found.basins_of_rows(grid, 0..60, settings, &Unobserved)?;
    println!("the same basins from two halves: {}", Basins::stacked([lower, upper])? == whole);
    Ok(())
}
