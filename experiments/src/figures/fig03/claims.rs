//! What the paper says about a rotor on a spring.

use super::data::Fig03Data;
use crate::claims::{self as claim, Claim};

/// A spring that is compressed by so many times the rotor's displacement is compressed by "much more" than it.
const MUCH_GREATER: f64 = 100.0;
/// A flight under an effectively constant preload lasts as long and falls as fast as one under a constant preload to this share.
const SAME_FLIGHT: f64 = 0.01;

/// The spring's change of preload, and what it does to a flight.
pub(super) fn sprung_rotor(data: &Fig03Data) -> Claim {
    let sprung = &data.sprung;
    let flights = sprung.motors.iter().flat_map(|motor| &motor.springs);
    // Hooke's law bounds the preload, which is no test; what has to be seen is that the flight hardly differs.
    let same = claim::all(flights.filter(|flight| flight.deflection_over_travel >= MUCH_GREATER), |flight| {
        flight.duration_change.abs() <= SAME_FLIGHT && flight.fall_speed_change.abs() <= SAME_FLIGHT
    });
    let travels: Vec<_> = sprung
        .motors
        .iter()
        .map(|motor| format!("A = {:e} m: {:.2e} m", motor.amplitude_m, motor.travel_m))
        .collect();
    Claim::printed_statement(
        "section1.sprung_rotor",
        same,
        format!(
            "duration and speed of the fall change by at most {} % where δl_0 is {MUCH_GREATER} times the displacement or more, in the first flight of Table III's motor; it moves, from peak to \
             peak, {}. For the phases of the impacts to stay the same δl_0 must be longer by much more than the flight's number of periods",
            100.0 * SAME_FLIGHT,
            travels.join("; ")
        ),
    )
}
