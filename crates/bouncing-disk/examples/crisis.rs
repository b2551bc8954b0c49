//! The crisis at which the chaotic attractor of Fig. 6 is lost: what it touches, and where.
//!
//!     cargo run --release -p bouncing-disk --example crisis
#![allow(clippy::print_stdout, reason = "an example shows its result")]

use std::error::Error;

use bouncing_disk::core::Unobserved;
use bouncing_disk::core::chaos::CrisisSearch;

fn main() -> Result<(), Box<dyn Error>> {
    // At which forcing do orbits on the attractor of the period-1 orbit begin to come to rest?
    match CrisisSearch::new(0.5, (0.559, 0.562))?.crisis(None, &Unobserved)? {
        Ok(crisis) => {
            println!("crisis at Gamma = {:.7} +- {:.0e}", crisis.forcing, crisis.forcing_error);
            if let Ok(tangency) = &crisis.tangency {
                let saddle = &tangency.touched;
                println!(
                    "it touches a saddle of {} impacts in {} periods",
                    saddle.period(),
                    saddle.platform_periods
                );
            }
            println!("life beyond it: power {:.4?}", crisis.life_exponent());
        }
        Err(reason) => println!("none: {reason}"),
    }
    Ok(())
}
