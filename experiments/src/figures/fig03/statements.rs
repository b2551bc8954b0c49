//! What the paper says about the simulation, compared with the census.

use bouncing_disk::{EventKind, Transition};

use super::Fig03Data;
use crate::claim::Claim;

/// The equations of motion are obeyed to this share of the terms that balance: thousands of roundings, since the
/// equations add several terms, and an instant is found where their sum vanishes.
const LAW_BOUND: f64 = 1e-12;

fn name(transition: &Transition) -> String {
    format!("{:?} –{:?}→ {:?}", transition.from, transition.event, transition.to)
}

fn none(names: &[String]) -> String {
    if names.is_empty() { "none".to_owned() } else { names.join(", ") }
}

/// A law that holds if all of its faults are within the bound.
fn law(key: &str, motions: u64, faults: &[(&str, f64)]) -> Claim {
    let parts: Vec<_> = faults.iter().map(|(what, fault)| format!("{what}: {fault:.1e}")).collect();
    Claim::printed_statement(
        key,
        faults.iter().all(|(_, fault)| *fault <= LAW_BOUND),
        format!(
            "largest faults in {motions} computed motions, as shares of the terms that balance: {}",
            parts.join("; ")
        ),
    )
}

pub(super) fn claims(data: &Fig03Data) -> Vec<Claim> {
    let (census, laws) = (&data.census, &data.census.laws);
    let motions = census.motions;
    vec![
        law(
            "section2.contact_force",
            motions,
            &[
                ("x = s and ẋ = ṡ in contact", laws.contact_motion),
                ("N below zero", laws.negative_force),
                ("N where the disk leaves", laws.force_at_separation),
            ],
        ),
        law(
            "section2.friction_torque",
            motions,
            &[
                ("torque that holds a sticking disk beyond μ a_e N", laws.holding_torque),
                ("change of a sliding disk's speed", laws.sliding_speed),
            ],
        ),
        law(
            "section2.rebound",
            motions,
            &[("relative velocity after an impact", laws.rebound), ("axial impulse", laws.axial_impulse)],
        ),
        Claim::printed_statement(
            "section2.frictional_impulse",
            laws.frictional_impulse <= LAW_BOUND && laws.reversals == 0,
            format!(
                "largest difference from the smaller of the two in {motions} computed motions, as a share of the terms: \
                 {:.1e}; impacts that reverse the relative rotation: {}",
                laws.frictional_impulse, laws.reversals
            ),
        ),
        law(
            "section2.flight",
            motions,
            &[
                ("height against the parabola", laws.flight),
                ("parabola against the platform at the impact", laws.impact),
                ("disk below the platform on the way", laws.overlap),
            ],
        ),
        phases(data),
        law(
            "section2.contact_phases",
            motions,
            &[
                ("torque below the limit where the slip begins", laws.slip_onset),
                ("sliding speed where the slip ends", laws.slip_end),
            ],
        )
        .note("where friction cannot hold the disk as its slip ends, it slips on the other way: a transition that the text \
               does not name"),
        cycle(data),
    ]
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
    let ends = seen().filter(|seen| seen.event == EventKind::Separation).count();
    Claim::printed_statement(
        "section2.four_phases",
        missing.is_empty() && forbidden.is_empty() && census.failures == 0,
        format!(
            "of {} events in {} motions: {}; legal and never seen: {}; seen and not legal: {}; motions that ended with an \
             error: {}; {ends} contact phases end with a separation",
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
        cycle.collision_cycles < cycle.attachment_cycles && cycle.attachment_cycles < cycle.separation_cycles,
        format!(
            "at Γ = {}, ε = {}: collision {:.4}, attachment {:.4} and separation {:.4} periods after the separation \
             before; the attachment sums infinitely many impacts after {} computed one by one",
            cycle.axial_forcing,
            cycle.restitution,
            cycle.collision_cycles,
            cycle.attachment_cycles,
            cycle.separation_cycles,
            cycle.impacts
        ),
    )
}
