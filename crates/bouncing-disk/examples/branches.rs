//! A branch of periodic orbits: from its birth in a fold through its period doubling, and the branch that
//! begins there.
//!
//!     cargo run --release -p bouncing-disk --example branches
#![allow(clippy::print_stdout, reason = "an example shows its result")]

use std::error::Error;

use bouncing_disk::core::orbits::{Branch, Continuation, ContinuationParameter, ContinuedMap as _};
use bouncing_disk::core::{ImpactMap, Unobserved, Vibration};

fn print(name: &str, branch: &Branch) {
    println!("{name}: {} points, then {:?}", branch.points.len(), branch.end);
    for bifurcation in &branch.bifurcations {
        println!("  {:?} at Gamma = {:.12}", bifurcation.kind, bifurcation.point.parameter);
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let map = ImpactMap::new(Vibration::from_axial_forcing(0.45)?, 0.5)?;
    let node = map.period_one_pair(1).expect("born at Gamma = 1/3").node;
    let orbit = node.orbit(&map)?.expect("an orbit of the map");

    // Towards lower forcing: back to the fold, where the node and the saddle are born, and along the saddle.
    let falling = Continuation::new(ContinuationParameter::Forcing, (0.2, 0.7), false)?;
    print("period 1, falling", &map.continued(&orbit, &falling, &Unobserved)?);
    // Towards higher forcing: along the unstable orbit that no simulation shows.
    let rising = Continuation::new(ContinuationParameter::Forcing, (0.2, 0.7), true)?;
    let branch = map.continued(&orbit, &rising, &Unobserved)?;
    print("period 1, rising", &branch);
    // The branch that begins in its first bifurcation.
    print("period 2", &branch.switched(0, &rising, &Unobserved)?);
    Ok(())
}
