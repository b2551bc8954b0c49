//! The crisis at which the chaotic attractor of Fig. 6 is lost: what it touches, and where.
//!
//!     cargo run --release -p bouncing-disk --example crisis
#![allow(clippy::print_stdout, reason = "an example shows its result")]

use std::error::Error;

use bouncing_disk::core::{CrisisSearch, ImpactMap, OrbitSearch, Vibration};

fn main() -> Result<(), Box<dyn Error>> {
    let map = ImpactMap::new(Vibration::from_axial_forcing(0.56)?, 0.5)?;
    // The saddle at the edge of the attractor: of three impacts in three periods of the platform, with
    // positive multipliers.
    let orbits = map.periodic_orbits(&OrbitSearch::new(3, 3)?)?.orbits;
    let saddle = orbits
        .iter()
        .find(|orbit| {
            let trace = orbit.monodromy.x_axis.x + orbit.monodromy.y_axis.y;
            orbit.period() == 3 && orbit.platform_periods == 3 && trace > 2.0
        })
        .expect("found");
    match CrisisSearch::new(0.5, (0.559, 0.562))?.crisis(saddle, saddle)? {
        Ok(crisis) => {
            println!("crisis at Gamma = {:.10} +- {:.0e}", crisis.forcing, crisis.forcing_error);
            println!("its tangency returns to the saddle in {} impacts", crisis.orbit.len());
            println!("life beyond it: power {:.4?}", crisis.life_exponent());
        }
        Err(reason) => println!("none: {reason:?}"),
    }
    Ok(())
}
