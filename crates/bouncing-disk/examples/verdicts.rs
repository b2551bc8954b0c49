//! What the disk does for good, one forcing after the other, with the evidence.
//!
//!     cargo run --release -p bouncing-disk --example verdicts
#![allow(clippy::print_stdout, reason = "an example shows its result")]

use std::error::Error;

use bouncing_disk::core::attractors::{VerdictSettings, verdicts};
use bouncing_disk::core::{ImpactMap, ImpactState, Unobserved, Vibration};

fn main() -> Result<(), Box<dyn Error>> {
    let forcings = [0.30, 0.40, 0.50, 0.535, 0.555, 0.70, 1.50, 2.73];
    let starts = forcings
        .iter()
        .map(|&forcing| {
            let vibration = Vibration::from_axial_forcing(forcing)?;
            Ok((ImpactMap::new(vibration, 0.5)?, ImpactState::from_normalised(1.2, 1.3)?))
        })
        .collect::<Result<Vec<_>, bouncing_disk::core::Error>>()?;
    for (forcing, verdict) in forcings.iter().zip(verdicts(&starts, VerdictSettings::default(), &Unobserved)?)
    {
        println!("Gamma = {forcing:5}: {verdict}");
    }
    Ok(())
}
