//! A pizza toss: how fast the dough spins, what the hand's work becomes, and what friction changes.
//!
//!     cargo run --release -p bouncing-disk --example toss
#![allow(clippy::print_stdout, reason = "an example shows its result")]

use bouncing_disk::toss::{InitialSpin, single_toss, toss_trajectory};
use bouncing_disk::{Error, System};

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

    // Every event until the dough is back: `Scales` converts times and states to seconds, metres and radians.
    let floured = pizza.with_disk(|dough| dough.friction = 0.2)?;
    let (flight, units) = (toss_trajectory(&floured, InitialSpin::AbsoluteRest)?, floured.scales());
    for record in flight.records() {
        let seconds = units.span_seconds(record.time.since(&flight.start()));
        let dough = units.state(&record.before);
        println!(
            "{seconds:.3} s {}: height {:.3} m, {:.2} m/s upwards, {:.2} rad/s",
            record.event.kind(),
            dough.height,
            dough.axial_velocity,
            dough.angular_speed
        );
    }
    Ok(())
}
