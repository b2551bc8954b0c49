//! Fig. 3: flow chart of the simulation, from the modes and events that really occur.

mod census;
mod cycle;
mod draw;
mod sprung;

use bouncing_disk::core::ChatterPolicy;
use serde::Serialize;

use self::census::Census;
use self::cycle::ChatteringCycle;
use self::sprung::SprungMotor;
use super::shared::motor::MotorCase;
use crate::claims::{Claim, paper};
use crate::experiment::{ExperimentError, Paper};

/// Fig. 3.
pub(crate) fn fig03(fig: &mut Paper<'_>) -> Result<(), ExperimentError> {
    fig.chattering(ChatterPolicy::Complete);
    let census = Census::new(fig.quality, fig.progress)?;
    let cycle = ChatteringCycle::new(fig.quality)?;
    fig.record("census", &census)?;
    fig.record("cycle", &cycle)?;
    // Without the cap an impact whose available impulse is the larger one would turn the slip round.
    let Census { sliding_impacts, capped_impacts, .. } = census;
    fig.claim(Claim::printed_statement(
        "section2.cap_prevents_reversal",
        (sliding_impacts > 0).then_some(capped_impacts > 0),
        format!(
            "of {sliding_impacts} impacts of a sliding disk the available impulse is larger than the possible one in {capped_impacts}: without the cap the slip would be reversed in these"
        ),
    ));
    sprung_rotor(fig)?;

    fig.caption(format!(
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
    ));
    let list = |values: &[f64]| values.iter().map(f64::to_string).collect::<Vec<_>>().join(", ");
    fig.parameter("peak acceleration Aω²/g", list(&census.peak_accelerations));
    fig.parameter("largest platform speed, in g a_e/(a_g² ω)", list(&census.twist_speeds));
    fig.parameter("phase lag θ (rad)", list(&census.phase_lags_rad));
    fig.parameter("friction μ", list(&census.frictions));
    fig.parameter("restitution ε", list(&census.restitutions));
    fig.parameter("load torque, in m g a_e", list(&census.loads));
    fig.parameter("events of a motion", format!("at most {}", census.longest_motion));
    fig.parameter(
        "inset",
        format!("Γ = {}, ε = {}, complete chattering", cycle.axial_forcing, cycle.restitution),
    );
    fig.draw(draw::draw(&census, &cycle));
    Ok(())
}

/// Springs under the motors of Fig. 10.
#[derive(Serialize)]
struct Sprung {
    /// See `deflection_for_share_m`.
    preload_share: f64,
    motors: Vec<SprungMotor>,
}

/// A rotor on a spring that is compressed by much more than it moves is under a constant preload.
fn sprung_rotor(fig: &mut Paper<'_>) -> Result<(), ExperimentError> {
    /// A spring that is compressed by so many times the rotor's displacement is compressed by "much more" than it.
    const MUCH_GREATER: f64 = 100.0;
    /// A flight under an effectively constant preload lasts as long and falls as fast as one under a constant
    /// preload to this share.
    const SAME_FLIGHT: f64 = 0.01;
    let events = fig.quality.choose(2_000, 20_000);
    let default = MotorCase::table_three()?;
    let motors = paper::section_five()?
        .amplitudes_of_fig10_m
        .map(|amplitude_m| SprungMotor::new(&MotorCase { amplitude_m, ..default }, events))
        .into_iter()
        .collect::<Result<Vec<_>, _>>()?;
    // Hooke's law bounds the preload, which is no test; the test is that the flight hardly differs.
    let same = motors
        .iter()
        .flat_map(|motor| &motor.springs)
        .filter(|flight| flight.deflection_over_travel >= MUCH_GREATER)
        .all(|flight| {
            flight.duration_change.abs() <= SAME_FLIGHT && flight.fall_speed_change.abs() <= SAME_FLIGHT
        });
    let travels: Vec<_> = motors
        .iter()
        .map(|motor| format!("A = {:e} m: {:.2e} m", motor.amplitude_m, motor.travel_m))
        .collect();
    fig.claim(Claim::printed_statement(
        "section1.sprung_rotor",
        same,
        format!(
            "duration and speed of the fall change by at most {} % where δl_0 is {MUCH_GREATER} times the displacement or more, in the first flight of Table III's motor; it moves, from peak to \
             peak, {}. For the phases of the impacts to stay the same δl_0 must be longer by much more than the flight's number of periods",
            100.0 * SAME_FLIGHT,
            travels.join("; ")
        ),
    ));
    fig.record("sprung", &Sprung { preload_share: sprung::SHARE, motors })
}

#[cfg(test)]
mod tests {
    use bouncing_disk::motion::Transition;

    use super::*;
    use crate::progress::Silent;

    #[test]
    fn the_arrows_drawn_are_the_transitions_seen() {
        let census = Census::new(crate::Quality::Draft, &Silent).expect("runs");
        let seen = &census.transitions;
        assert!(seen.iter().eq(&std::collections::BTreeSet::from(Transition::LEGAL)));
        assert!(seen.iter().all(|transition| draw::arrow(*transition).is_some()));
    }
}
