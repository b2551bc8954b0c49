//! An orbit diagram: at which phases the disk lands, as the platform shakes harder (Fig. 6a of the paper).
//!
//!     cargo run --release -p bouncing-disk --example orbit_diagram
#![allow(clippy::print_stdout, reason = "an example shows its result")]

use std::collections::BTreeSet;

use bouncing_disk::Error;
use bouncing_disk::core::sweep::orbit_diagram;
use bouncing_disk::core::{ChatterPolicy, ImpactMap, ImpactState, Unobserved, Vibration};

fn main() -> Result<(), Error> {
    let restitution = 0.5;
    // Forcings around the one at which the period-1 orbit doubles, which is known in closed form.
    let doubling = ImpactMap::first_doubling_forcing(restitution);
    let forcings = [0.8, 0.95, 1.05, 1.10, 1.114, 1.14].map(|ratio| ratio * doubling);

    let mut orbits = Vec::new();
    for forcing in forcings {
        let map = ImpactMap::new(Vibration::from_axial_forcing(forcing)?, restitution)?;
        let orbit = map.period_one(1).expect("it exists for Gamma >= (1 - r)/(1 + r)");
        // Start a little off the orbit: where it is unstable, the motion leaves it at once.
        let start = ImpactState::new(orbit.phase(), 1.01 * orbit.velocity())?;
        orbits.push(map.orbit(start, ChatterPolicy::Complete));
    }

    // Follow all of them at once: 512 impacts of each, after 20,000 that are discarded.
    let columns = orbit_diagram(&orbits, 20_000, 512, &Unobserved)?;
    for (forcing, column) in forcings.iter().zip(&columns) {
        // The phases in whole millionths of a period; `floor` keeps the last one below a whole period.
        let phases: BTreeSet<i64> =
            column.iter().map(|impact| (impact.phase().cycles() * 1e6).floor() as i64).collect();
        let shown: Vec<String> =
            phases.iter().take(4).map(|&phase| format!("{:.3}", phase as f64 / 1e6)).collect();
        println!("Gamma {forcing:.4}: {:3} impact phases, from {}", phases.len(), shown.join(", "));
    }
    Ok(())
}
