//! Where the energy goes: the hand's work during a toss, entry by entry, and a balance that closes to
//! rounding.
//!
//!     cargo run --release -p bouncing-disk --example energy
#![allow(clippy::print_stdout, reason = "an example shows its result")]

use bouncing_disk::toss::{InitialSpin, single_toss};
use bouncing_disk::{Error, System};

fn main() -> Result<(), Error> {
    // A floured hand, over which the dough slides.
    let floured = System::pizza_toss().with_disk(|dough| dough.friction = 0.2)?;
    let toss = single_toss(&floured, InitialSpin::AbsoluteRest)?;

    // Joules per kilogram of dough; every entry is computed on its own, none as the remainder of the others.
    let energy = toss.energy;
    println!("work by the normal force {:7.4} J/kg", energy.normal_work);
    println!("work by friction         {:7.4} J/kg", energy.friction_work);
    println!("lost in friction         {:7.4} J/kg", energy.friction_loss);
    println!("upward motion            {:7.4} J/kg", energy.axial_kinetic_change);
    println!("height                   {:7.4} J/kg", energy.potential_change);
    println!("rotation                 {:7.4} J/kg", energy.rotary_kinetic_change);

    let stored = energy.axial_kinetic_change + energy.potential_change + energy.rotary_kinetic_change;
    let missing = energy.platform_work() - energy.friction_loss - stored;
    assert!(missing.abs() < 1e-13 * energy.platform_work());
    println!("efficiency {:.4}", energy.rotary_kinetic_change / energy.platform_work());
    Ok(())
}
