//! Fig. 3: flow chart of the simulation, from the modes and events that really occur.

mod census;
mod draw;
mod sprung;

use bouncing_disk::core::ChatterPolicy;
use serde::Serialize;

use self::census::{Census, ChatteringCycle, census, cycle};
use self::sprung::{Sprung, sprung};
use crate::claims::{self as claim, Claim};
use crate::experiment::{ExperimentError, Paper, named};

/// Fig. 3.
pub(crate) fn fig03(fig: &mut Paper<'_>) -> Result<(), ExperimentError> {
    fig.chattering(ChatterPolicy::Complete);
    let (quality, progress) = (fig.quality, fig.progress);
    let census = census(quality, progress)?;
    let cycle = cycle(quality)?;
    let sprung = sprung(quality)?;
    let data = &Fig03Data { census, cycle, sprung };
    fig.caption(caption(data));
    fig.parameters(parameters(data));
    fig.claims(vec![sprung_rotor(data), cap(&data.census)]);
    fig.draw(draw::draw(&data.census, &data.cycle));
    fig.data(data)
}

fn caption(data: &Fig03Data) -> String {
    let (census, cycle) = (&data.census, &data.cycle);
    format!(
        "Model simulation flow chart: the modes flight, sticking and sliding (boxes), the impact, which is an instant \
         (rounded), and the events between them. Every arrow is a transition that the engine was seen to make: {} \
         events of {} systems and starts were counted, and only the {} transitions drawn occurred \
         (rebound and attachments share the collision). At the arrows: their conditions; β̈_env = μ a_e N/(m a_g²) is what static friction can give. A cycle \
         starts with the collision. The inset shows a computed trajectory of the disk (dashed line) and of the platform (solid line), time from the collision, \
         for one cycle of the simulation, starting with collision (c), attachment (a) after infinitely many impacts, and ending with \
         separation (s), for Γ = {}, ε = {}; the flight before the collision is lighter.",
        census.events,
        census.motions,
        census.transitions.len(),
        cycle.axial_forcing,
        cycle.restitution
    )
}

fn parameters(data: &Fig03Data) -> Vec<(String, String)> {
    let (census, cycle) = (&data.census, &data.cycle);
    let list = |values: &[f64]| values.iter().map(f64::to_string).collect::<Vec<_>>().join(", ");
    named([
        ("peak acceleration Aω²/g", list(&census.peak_accelerations)),
        ("largest platform speed, in g a_e/(a_g² ω)", list(&census.twist_speeds)),
        ("phase lag θ (rad)", list(&census.phase_lags_rad)),
        ("friction μ", list(&census.frictions)),
        ("restitution ε", list(&census.restitutions)),
        ("load torque, in m g a_e", list(&census.loads)),
        ("events of a motion", format!("at most {}", census.longest_motion)),
        ("inset", format!("Γ = {}, ε = {}, complete chattering", cycle.axial_forcing, cycle.restitution)),
    ])
}

/// The data of Fig. 3.
#[derive(Debug, Serialize)]
pub(crate) struct Fig03Data {
    census: Census,
    cycle: ChatteringCycle,
    sprung: Sprung,
}

/// A spring that is compressed by so many times the rotor's displacement is compressed by "much more" than it.
const MUCH_GREATER: f64 = 100.0;

/// A flight under an effectively constant preload lasts as long and falls as fast as one under a constant
/// preload to this share.
const SAME_FLIGHT: f64 = 0.01;

/// The spring's change of preload, and what it does to a flight.
fn sprung_rotor(data: &Fig03Data) -> Claim {
    let sprung = &data.sprung;
    let flights = sprung.motors.iter().flat_map(|motor| &motor.springs);
    // Hooke's law bounds the preload, which is no test; the test is that the flight hardly differs.
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

/// Without the cap an impact whose available impulse is the larger one would turn the slip round.
fn cap(census: &Census) -> Claim {
    let Census { sliding_impacts, capped_impacts, .. } = census;
    Claim::printed_statement(
        "section2.cap_prevents_reversal",
        claim::all(Some(*capped_impacts).filter(|_| *sliding_impacts > 0), |capped| capped > 0),
        format!(
            "of {sliding_impacts} impacts of a sliding disk the available impulse is larger than the possible one in {capped_impacts}: without the cap the slip would be reversed in these"
        ),
    )
}

#[cfg(test)]
mod tests {
    use bouncing_disk::motion::Transition;

    use super::*;
    use crate::progress::Silent;

    #[test]
    fn the_arrows_drawn_are_the_transitions_seen() {
        let census = census(crate::Quality::Draft, &Silent).expect("runs");
        let seen = &census.transitions;
        assert!(seen.iter().eq(&std::collections::BTreeSet::from(Transition::LEGAL)));
        assert!(seen.iter().all(|transition| draw::arrow(*transition).is_some()));
    }
}
