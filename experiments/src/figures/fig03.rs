//! Fig. 3: flow chart of the simulation, from the modes and events that really occur.

mod census;
mod cycle;
mod draw;
mod sprung;

use bouncing_disk::core::ChatterPolicy;

use self::census::Census;
use self::cycle::ChatteringCycle;
use self::sprung::{MUCH_GREATER, SprungMotor};
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
            "in {capped_impacts} of {sliding_impacts} impacts of a sliding disk the available impulse exceeds the possible one; without the cap the slip would reverse"
        ),
    ));
    sprung_rotor(fig)?;

    fig.caption(format!(
        "Flow chart of the simulation: the modes flight, sticking and sliding (boxes), the impact, which is an instant (rounded), \
         and the events between them with their conditions; β̈_env = μ a_e N/(m a_g²) is what static friction can give. In {} \
         events of {} systems and starts the engine made the {} transitions drawn and no other. Inset: one computed cycle \
         of disk (dashed) and platform (solid) for Γ = {}, ε = {}, from the collision (c) through the attachment (a), after \
         infinitely many impacts, to the separation (s).",
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

/// A rotor on a spring that is compressed by much more than it moves is under a constant preload.
fn sprung_rotor(fig: &mut Paper<'_>) -> Result<(), ExperimentError> {
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
    let changes = motors.iter().flat_map(|motor| [motor.duration_change, motor.fall_speed_change]);
    let most = changes.map(f64::abs).fold(0.0, f64::max);
    let travels: Vec<_> = motors
        .iter()
        .map(|motor| format!("{:.1e} m at A = {:e} m", motor.travel_m, motor.amplitude_m))
        .collect();
    fig.claim(Claim::printed_statement(
        "section1.sprung_rotor",
        most <= SAME_FLIGHT,
        format!(
            "with δl_0 = {MUCH_GREATER} displacements, duration and fall speed of the first flight change by at most {:.2} %; the rotor moves {}",
            100.0 * most,
            travels.join(", ")
        ),
    ));
    fig.record("sprung", &motors)
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
