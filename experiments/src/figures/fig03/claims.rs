//! What the paper says about the simulation, compared with the census.

use bouncing_disk::{EventKind, Transition};

use super::data::Fig03Data;
use crate::claim::{self, Claim};

/// The equations of motion are obeyed to this share of the terms that balance: thousands of roundings, since
/// the equations add several terms, and an instant is found where their sum vanishes.
const LAW_BOUND: f64 = 1e-12;
/// A spring that is compressed by so many times the rotor's displacement is compressed by "much more" than it.
const MUCH_GREATER: f64 = 100.0;
/// A flight under an effectively constant preload lasts as long and falls as fast as one under a constant preload to this share.
const SAME_FLIGHT: f64 = 0.01;

fn name(transition: &Transition) -> String {
    format!("{:?} –{:?}→ {:?}", transition.from, transition.event, transition.to)
}

fn none(names: &[String]) -> String {
    if names.is_empty() { "none".to_owned() } else { names.join(", ") }
}

/// A law that holds if all of its faults are within the bound, where each of them was looked for.
fn law(key: &str, motions: u64, faults: &[(&str, f64, u64)]) -> Claim {
    let parts: Vec<_> = faults
        .iter()
        .map(|(what, fault, checks)| format!("{what}: {fault:.1e} ({checks} checked)"))
        .collect();
    Claim::printed_statement(
        key,
        within(faults),
        format!(
            "largest faults in {motions} computed motions, as shares of the terms that balance: {}",
            parts.join("; ")
        ),
    )
}

/// Whether all faults are within the bound; `None` where one of them was never looked for.
fn within(faults: &[(&str, f64, u64)]) -> Option<bool> {
    let checked = faults.iter().all(|(_, _, checks)| *checks > 0);
    claim::all(faults, |(_, fault, _)| *fault <= LAW_BOUND).filter(|_| checked)
}

pub(super) fn claims(data: &Fig03Data) -> Vec<Claim> {
    let (census, laws, checked) = (&data.census, &data.census.laws, &data.census.laws.checked);
    let motions = census.motions;
    let contacts = checked.sticking + checked.sliding;
    vec![
        law(
            "section2.contact_force",
            motions,
            &[
                ("x = s and ẋ = ṡ in contact", laws.contact_motion, contacts),
                ("N below zero", laws.negative_force, contacts),
                ("N where the disk leaves", laws.force_at_separation, checked.separations),
            ],
        ),
        law(
            "section2.friction_torque",
            motions,
            &[
                ("torque that holds a sticking disk beyond μ a_e N", laws.holding_torque, checked.sticking),
                ("change of a sliding disk's speed", laws.sliding_speed, checked.sliding),
            ],
        ),
        law(
            "section2.rebound",
            motions,
            &[
                ("relative velocity after an impact", laws.rebound, checked.impacts),
                ("axial impulse", laws.axial_impulse, checked.impacts),
            ],
        ),
        law(
            "section2.frictional_impulse",
            motions,
            &[
                ("difference from the smaller of the two", laws.frictional_impulse, checked.impacts),
                ("impacts that reverse the relative rotation", laws.reversals as f64, checked.impacts),
            ],
        ),
        law(
            "section2.flight",
            motions,
            &[
                ("height against the parabola", laws.flight, checked.flights),
                ("parabola against the platform at the impact", laws.impact, checked.impacts),
                ("disk below the platform on the way", laws.overlap, checked.flights),
            ],
        ),
        attachment(data),
        phases(data),
        law(
            "section2.contact_phases",
            motions,
            &[
                ("torque below the limit where the slip begins", laws.slip_onset, checked.slip_onsets),
                ("sliding speed where the slip ends", laws.slip_end, checked.slip_ends),
            ],
        )
        .note("where friction cannot hold the disk as its slip ends, it slips on the other way: a transition that the text \
               does not name"),
        cycle(data),
        sprung_rotor(data),
    ]
}

/// Impacts without rebound, at either sign of N.
fn attachment(data: &Fig03Data) -> Claim {
    let seen = &data.census.attachments;
    let pressed = seen.pressed_attached + seen.pressed_launched;
    let unpressed = seen.unpressed_attached + seen.unpressed_launched;
    Claim::printed_statement(
        "section2.attachment_condition",
        (pressed > 0 && unpressed > 0).then_some(seen.pressed_launched == 0 && seen.unpressed_attached == 0),
        format!(
            "impacts without rebound (ε = 0): of {pressed} with N > 0, {} were followed by contact; of {unpressed} with N ≤ 0, {} by a flight",
            seen.pressed_attached, seen.unpressed_launched
        ),
    )
}

/// The spring's change of preload, and what it does to a flight.
fn sprung_rotor(data: &Fig03Data) -> Claim {
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

fn phases(data: &Fig03Data) -> Claim {
    let census = &data.census;
    let seen = || census.transitions.iter().map(|counted| counted.transition);
    let missing: Vec<_> =
        Transition::LEGAL.iter().filter(|legal| !seen().any(|seen| seen == **legal)).map(name).collect();
    let forbidden: Vec<_> = seen().filter(|seen| !seen.is_legal()).map(|seen| name(&seen)).collect();
    let counts: Vec<_> = census
        .transitions
        .iter()
        .map(|counted| format!("{}: {}", name(&counted.transition), counted.number))
        .collect();
    let (laws, checked) = (&census.laws, &census.laws.checked);
    let closed = within(&[
        ("flight", laws.flight, checked.flights),
        ("impact", laws.axial_impulse, checked.impacts),
        ("sticking", laws.contact_motion, checked.sticking),
        ("sliding", laws.sliding_speed, checked.sliding),
    ]);
    let ends = seen().filter(|seen| seen.event == EventKind::Separation).count();
    Claim::printed_statement(
        "section2.four_phases",
        (census.events > 0).then_some(
            missing.is_empty() && forbidden.is_empty() && census.failures == 0 && closed == Some(true),
        ),
        format!(
            "of {} events in {} motions: {}; legal and never seen: {}; seen and not legal: {}; motions that ended with an \
             error: {}; {ends} contact phases end with a separation; the closed forms hold to {LAW_BOUND:e}",
            census.events,
            census.motions,
            counts.join(", "),
            none(&missing),
            none(&forbidden),
            census.failures
        ),
    )
}

fn cycle(data: &Fig03Data) -> Claim {
    let cycle = &data.cycle;
    Claim::printed_statement(
        "section2.one_cycle",
        (cycle.impacts > 0)
            .then_some(0.0 < cycle.attachment_cycles && cycle.attachment_cycles < cycle.separation_cycles),
        format!(
            "at Γ = {}, ε = {}: attachment {:.4} and separation {:.4} periods after the collision; the attachment sums infinitely many impacts \
             after {} computed one by one",
            cycle.axial_forcing,
            cycle.restitution,
            cycle.attachment_cycles,
            cycle.separation_cycles,
            cycle.impacts
        ),
    )
}
