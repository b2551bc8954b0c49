//! Compliant contacts compared with an integration in small steps.

use bouncing_disk_core::numerics::elementary::{cos, sin};
use proptest::prelude::*;

use super::*;
use crate::testing::small_steps::{Law, Spring};

/// Steps per radian of the fastest change.
const STEPS: f64 = 400.0;

/// Follows each segment of `events` events from the state at its start.
fn follow(law: &Law, system: &DrivenSystem, events: usize) -> Result<[usize; 8], TestCaseError> {
    let compliance = *system.compliance.as_ref().expect("a contact that takes time").compliance();
    let fastest = 1.0 + compliance.stiffness().sqrt() + compliance.damping();
    let start = DrivenStart::Contact { phase: phase_at(0.3), angular_speed: 0.0 };
    let mut engine = DrivenEngine::new(system.clone(), start, ChatterPolicy::Complete).expect("legal");
    let mut counts = [0; 8];
    for _ in 0..events {
        let Some(record) = engine.advance().expect("no failure") else { break };
        let segment = record.segment;
        let span = record.span.radians();
        prop_assert!(record.ledger.relative_closure() < 1e-12, "{record:?}");
        let kind = match record.event {
            Event::Impact { .. } => 0,
            Event::Separation => 1,
            Event::StickToSlip(_) => 2,
            Event::SlipToStick => 3,
            Event::SlipReversal(_) => 4,
            Event::Recontact => 5,
            Event::Turn => 6,
            _ => 7,
        };
        counts[kind] += 1;
        let relative = |state: &DiskState, t: f64| {
            [state.height - law.peak * sin(t), state.axial_velocity - law.peak * cos(t), state.angular_speed]
        };
        let from = segment.start.phase.angle();
        let mut state = relative(&segment.state, from);
        if segment.state.mode == Mode::Flight && state[0] > 0.0 || span > 60.0 {
            continue;
        }
        let scale = 1.0 + law.peak + state[1].abs();
        let steps = (span * fastest * STEPS).ceil().max(1.0);
        let h = span / steps;
        let mut k = 0.0;
        while k < steps {
            let t = from + k * h;
            let before = state[1];
            state = law.step(t, state, h, segment.state.mode);
            k += 1.0;
            // No event has happened that the engine has missed.
            let force = law.force(t + h, state, before);
            let slack = 1e-4 * scale * (1.0 + fastest);
            match segment.state.mode {
                Mode::Flight => prop_assert!(state[0] > -1e-6 * scale || force < slack, "{record:?} {force}"),
                mode => {
                    let platform = law.turn(t + h);
                    prop_assert!(state[0] < 1e-6 * scale, "{record:?} {state:?}");
                    if let Mode::Sliding(direction) = mode {
                        let slip = direction.sign() * (state[2] - platform);
                        prop_assert!(slip > -1e-4 * (1.0 + law.twist), "{record:?} {slip}");
                    } else {
                        let needed = law.needed(t + h).abs();
                        let most = law.friction * (force + slack);
                        prop_assert!(needed < most + 1e-6 * (1.0 + law.twist), "{record:?} {needed} {most}");
                    }
                }
            }
        }
        let to = record.time.phase.angle();
        let found = relative(&record.before, to);
        let spin = 1.0 + law.twist + law.friction * scale * fastest;
        for (index, size) in [(0, scale), (1, scale * fastest), (2, spin)] {
            let off = (state[index] - found[index]).abs();
            prop_assert!(off < 2e-5 * size, "{index}: {off:e}\n{state:?}\n{found:?}\n{record:?}");
        }
    }
    Ok(counts)
}

fn law_and_system(
    hysteretic: bool,
    (peak, twist, lag): (f64, f64, f64),
    (friction, load, restitution): (f64, f64, f64),
    contact_time: f64,
) -> (Law, DrivenSystem) {
    let drive = |amplitude: f64, angle: f64| Drive::fourier(&[(amplitude, angle)]).expect("legal");
    let rigid = DrivenSystem {
        height: drive(peak, 0.0),
        angle: drive(twist, lag),
        friction,
        restitution,
        load,
        compliance: None,
    };
    let system = if hysteretic {
        rigid.with_hysteretic_contact(contact_time)
    } else {
        rigid.with_contact_time(contact_time)
    }
    .expect("legal");
    let compliance = *system.compliance.as_ref().expect("there").compliance();
    let spring = Spring {
        loading: compliance.stiffness(),
        unloading: compliance.unloading_stiffness(),
        damping: compliance.damping(),
    };
    (Law { peak, twist, lag, friction, load, spring: Some(spring) }, system)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]

    #[test]
    fn an_integration_in_small_steps_finds_the_same_events(
        hysteretic in any::<bool>(),
        shape in (0.1..20.0_f64, 0.0..20.0_f64, -3.0..3.0_f64),
        disk in (0.05..1.0_f64, -0.03..0.03_f64, 0.02..0.98_f64),
        contact_time in -2.0..1.5_f64,
    ) {
        let time = bouncing_disk_core::numerics::elementary::exp(contact_time * std::f64::consts::LN_10);
        let (law, system) = law_and_system(hysteretic, shape, disk, time);
        follow(&law, &system, 40)?;
    }
}

#[test]
fn all_events_of_a_contact_that_takes_time_happen() {
    let mut counts = [0; 8];
    // The last one is critically damped: its terms have a factor t.
    for (hysteretic, peak, restitution, time) in [
        (false, 20.0, 0.5, 3.7),
        (true, 20.0, 0.5, 3.7),
        (false, 62.0, 0.5, 113.0),
        (false, 0.3, 0.5, 2.0),
        (false, 20.0, bouncing_disk_core::numerics::elementary::exp(-2.0), 3.7),
    ] {
        let disk = (0.3, 0.02, restitution);
        let (law, system) = law_and_system(hysteretic, (peak, 5.0, -0.4), disk, time);
        let found = follow(&law, &system, 200).expect("agreement");
        counts = [0, 1, 2, 3, 4, 5, 6, 7].map(|k| counts[k] + found[k]);
    }
    assert!(counts.iter().all(|&count| count > 0), "{counts:?}");
}

/// Short slides under a fast platform, the second near the resonance of the spring: the slip is a small
/// difference of the platform's speeds.
#[test]
fn the_energy_of_a_short_slide_closes_to_the_rounding_of_what_it_is_made_of() {
    for (peak, load, restitution, time) in [
        (19.273_260_356_603_608, 0.014_379_157_219_716_733, 0.02, 1.0),
        (19.095_595_288_791_34, 0.012_126_755_008_538_975, 0.283_985_682_164_076_6, 1.882_022_7),
    ] {
        let (law, system) = law_and_system(true, (peak, 0.0, 0.0), (0.05, load, restitution), time);
        follow(&law, &system, 40).expect("agreement");
    }
}
