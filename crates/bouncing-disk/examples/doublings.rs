//! The doubling cascade: its forcings to the rounding, and Feigenbaum's constants from them.
//!
//!     cargo run --release -p bouncing-disk --example doublings
#![allow(clippy::print_stdout, reason = "an example shows its result")]

use std::error::Error;

use bouncing_disk::core::Unobserved;
use bouncing_disk::core::orbits::{doubling_cascade, feigenbaum_estimates};

fn main() -> Result<(), Box<dyn Error>> {
    let cascade = doubling_cascade(0.5, 10, &Unobserved)?.doublings;
    for doubling in &cascade {
        println!(
            "{:2}: period {:3} to {:4} at Gamma = {:.13} +- {:.0e}",
            doubling.number,
            doubling.period,
            2 * doubling.period,
            doubling.axial_forcing,
            doubling.forcing_error
        );
    }
    // Estimates need seven doublings; in doubles, ten give the best ones.
    if let Some(estimate) = feigenbaum_estimates(&cascade).last() {
        println!("delta = {:.6} +- {:.0e}", estimate.delta, estimate.delta_error);
        println!("alpha = {:.6} +- {:.0e}", estimate.alpha, estimate.alpha_error);
    }
    Ok(())
}
