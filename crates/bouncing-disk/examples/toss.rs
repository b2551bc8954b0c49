//! A pizza toss: how fast the dough spins, what the hand's work becomes, and what friction changes.
//!
//!     cargo run --release -p bouncing-disk --example toss
#![allow(clippy::print_stdout, reason = "an example shows its result")]

use bouncing_disk::{Error, InitialSpin, System, single_toss};

fn main() -> Result<(), Error> {
    // Table I of the paper: the dough rests in the hand at its lowest point, and is thrown.
    let pizza = System::pizza_toss();
    let toss = single_toss(&pizza, InitialSpin::AbsoluteRest)?;
    println!("airborne speed {:.2} rad/s, launch speed {:.2} m/s", toss.airborne_speed, toss.launch_speed);
    println!("efficiency {:.3}: the share of the hand's work that is found in the spin", toss.efficiency);

    // The same toss with one parameter changed. An illegal value is an error that names it.
    for friction in [0.05, 0.2, 0.6] {
        let floured = pizza.with_disk(|dough| dough.friction = friction)?;
        let toss = single_toss(&floured, InitialSpin::AbsoluteRest)?;
        println!(
            "friction {friction:.2}: {:5.2} rad/s, efficiency {:.3}",
            toss.airborne_speed, toss.efficiency
        );
    }
    Ok(())
}
