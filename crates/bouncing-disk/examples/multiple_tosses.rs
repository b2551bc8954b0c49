//! Many tosses: what the dough settles on when it is never laid to rest by hand.
//!
//!     cargo run --release -p bouncing-disk --example multiple_tosses
#![allow(clippy::print_stdout, reason = "an example shows its result")]

use bouncing_disk::core::{Phase, Unobserved};
use bouncing_disk::toss::{MultiTossSettings, OrbitClass, multi_toss};
use bouncing_disk::{Error, InitialCondition, System};

fn main() -> Result<(), Error> {
    let start = InitialCondition::Contact { phase: Phase::new(0.0)?, angular_speed: 0.0 };
    for amplitude in [0.02, 0.05, 0.1, 0.2] {
        let hand = System::pizza_toss().with_platform(|hand| hand.amplitude = amplitude)?;
        let orbit = multi_toss(hand, start, MultiTossSettings::default(), &Unobserved)?;
        let answer = match orbit.class {
            OrbitClass::AtRest => "stays on the hand".to_owned(),
            OrbitClass::Chattering { .. } => {
                format!("bounces {} times, chatters to rest, leaves again", orbit.collisions.len())
            }
            OrbitClass::Periodic { period, .. } => format!("repeats after {period} impacts"),
            _ => "neither repeats nor rests".to_owned(),
        };
        println!("amplitude {amplitude:.3} m, Gamma {:.3}: {answer}", hand.axial_forcing());
    }
    Ok(())
}
