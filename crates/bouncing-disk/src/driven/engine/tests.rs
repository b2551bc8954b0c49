use proptest::prelude::*;

use super::*;
use crate::motion::engine::Engine;
use crate::motion::event::Event;
use crate::testing;

/// What rounding leaves, relative to the sizes of what is compared.
const ROUNDING: f64 = 1e-12;

/// The event that the sine's engine calls this one.
fn of_sine(event: &Event) -> DrivenEvent {
    match *event {
        Event::Impact { axial_impact_velocity, tangential_impact_velocity, capped } => {
            DrivenEvent::Impact(Hit { axial_impact_velocity, tangential_impact_velocity, capped })
        }
        Event::Attachment { impacts, error_bound } => DrivenEvent::Attachment { impacts, error_bound },
        Event::Separation => DrivenEvent::Separation,
        Event::StickToSlip(direction) => DrivenEvent::StickToSlip(direction),
        Event::SlipToStick => DrivenEvent::SlipToStick,
        Event::SlipReversal(direction) => DrivenEvent::SlipReversal(direction),
    }
}

/// Compares each event of the sine's engine with that of the Fourier sum from the same state before.
fn compare(
    system: crate::parameters::DimensionlessSystem,
    start: DrivenStart,
    policy: ChatterPolicy,
    events: usize,
) -> Result<[usize; 7], TestCaseError> {
    let mut counts = [0; 7];
    let driven = DrivenSystem::try_from(system).expect("legal");
    let Ok(mut engine) = Engine::new(system, start, policy) else { return Ok(counts) };
    let size = 1.0 + system.peak_acceleration();
    let spin = 1.0 + system.twist_speed() + system.friction() * size;
    let mut own = DrivenEngine::new(driven.clone(), start, policy).expect("legal");
    for _ in 0..events {
        let Ok(Some(record)) = engine.advance() else { break };
        let Some(mut found) = own.advance().expect("no failure") else {
            prop_assert!(false, "{record:?}");
            break;
        };
        let (mut span, mut ledger, mut impulse) = (found.span.radians(), found.ledger, found.angular_impulse);
        if let Event::Attachment { .. } = record.event {
            while !matches!(found.event, DrivenEvent::Attachment { .. }) {
                found = own.advance().expect("no failure").expect("an event");
                span += found.span.radians();
                ledger += found.ledger;
                impulse += found.angular_impulse;
            }
        }
        prop_assert!(ledger.relative_closure() < ROUNDING, "{:e} {found:?}", ledger.relative_closure());
        let kind = std::mem::discriminant(&found.event);
        prop_assert!(kind == std::mem::discriminant(&of_sine(&record.event)), "{found:?}\n{record:?}");
        let index = match found.event {
            DrivenEvent::Impact(_) => 0,
            DrivenEvent::Attachment { .. } => 1,
            DrivenEvent::Separation => 2,
            DrivenEvent::StickToSlip(_) => 3,
            DrivenEvent::SlipToStick => 4,
            DrivenEvent::SlipReversal(_) => 5,
            _ => 6,
        };
        counts[index] += 1;
        let near = |one: f64, other: f64, size: f64| {
            (one - other).abs() <= ROUNDING * (size + one.abs() + other.abs())
        };
        // A root of a slow fall is as uncertain as its slope is small.
        prop_assert!(near(span, record.span.radians(), 1.0), "{span} {record:?}\n{found:?}");
        for (one, other) in [(found.before, record.before), (found.after, record.after)] {
            prop_assert!(near(one.height, other.height, size), "{one:?} {other:?}");
            prop_assert!(near(one.axial_velocity, other.axial_velocity, size + span), "{one:?} {other:?}");
            prop_assert!(
                near(one.angular_speed, other.angular_speed, spin * (1.0 + span)),
                "{one:?} {other:?} {record:?}"
            );
            prop_assert!(
                near(one.angle, other.angle, spin * (1.0 + span) * (1.0 + span)),
                "{one:?} {other:?}"
            );
            prop_assert!(one.mode == other.mode, "{one:?} {other:?} {record:?}");
        }
        prop_assert!(near(impulse, record.angular_impulse, spin), "{impulse} {record:?}");
        let magnitude = spin * spin + record.ledger.rotary_magnitude;
        prop_assert!(
            near(ledger.friction_loss, record.ledger.friction_loss, magnitude),
            "{found:?} {record:?}"
        );
        // The next event from the same state: a launch by its own speed, which a velocity would round.
        let speed = match record.event {
            Event::Impact { axial_impact_velocity, .. } => -system.restitution() * axial_impact_velocity,
            _ => 0.0,
        };
        match record.event {
            Event::Impact { .. } => {
                own.now = Clock { at: record.time.phase.angle(), periods: record.time.periods };
                (own.state, own.angle) = (record.after, LongSum::new(record.after.angle));
                own.stage = match own.stage {
                    Stage::Cut { error, .. } => Stage::Cut { speed, error },
                    Stage::Flight { velocity, .. } if velocity > 0.0 => {
                        Stage::Flight { gap: 0.0, velocity: speed }
                    }
                    Stage::Chatter { .. } if speed > 0.0 => Stage::Flight { gap: 0.0, velocity: speed },
                    other => other,
                };
            }
            Event::Separation => {}
            _ => {
                own =
                    DrivenEngine::of_state(driven.clone(), record.time, record.after, policy).expect("legal");
            }
        }
    }
    Ok(counts)
}

proptest! {
    #[test]
    fn a_sine_as_a_fourier_sum_has_the_events_of_the_engine((system, start, policy) in testing::motion()) {
        compare(system, start, policy, 40)?;
    }
}
