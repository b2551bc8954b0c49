//! Attachments as events, from the chatter with the slowest launch to the one with the most impacts.

use std::f64::consts::TAU;

use bouncing_disk_core::numerics::elementary::pow;
use bouncing_disk_core::{ImpactState, Phase, Vibration};

use super::*;
use crate::parameters::dimensionless::DimensionlessParameters;
use crate::testing::golden_spread;

const CLOSURE: f64 = 1.0e-13;

/// The largest legal restitution.
const LAST: f64 = 1.0 - f64::EPSILON / 2.0;

impl Engine {
    /// The attachment that the orbit is about to report, for a disk in the engine's state.
    pub(crate) fn attached_after(mut self, orbit: Orbit) -> EventRecord {
        self.ground.orbit = Some(orbit);
        self.advance().unwrap().unwrap()
    }
}

/// An engine whose next event is the end of the chatter after this launch, if that is certain.
fn about_to_attach(system: DimensionlessSystem, phase: Phase, speed: f64, spin: f64) -> Option<Engine> {
    let start = InitialCondition::Launch { phase, relative_speed: speed, angular_speed: spin };
    let mut engine = Engine::new(system, start, ChatterPolicy::Complete).unwrap();
    let impact = ImpactState::new(phase, -speed / system.restitution()).unwrap();
    let orbit = system.map().orbit(impact, ChatterPolicy::Complete);
    engine.ground.orbit = orbit.launch().is_none().then_some(orbit);
    engine.ground.orbit.is_some().then_some(engine)
}

fn attachments(
    restitution: f64,
    peak_acceleration: f64,
) -> impl Iterator<Item = (DimensionlessSystem, EventRecord)> {
    (0..400_u64).filter_map(move |k| {
        let pick = |stride: u64| golden_spread(stride * k + stride / 3);
        let system = DimensionlessParameters {
            peak_acceleration,
            twist_speed: [0.0, 1.0, 0.3, 1e-3, 100.0][(k / 3 % 5) as usize],
            phase_lag: 6.0 * pick(5) - 3.0,
            friction: [0.0, 0.3, 1.0, 0.01][(k % 4) as usize],
            restitution,
            load: [0.0, 0.2, -0.2, 0.29, 0.3, -3.0][(k / 4 % 6) as usize],
        }
        .build()
        .unwrap();
        let phase = match (k % 3, system.vibration().separation_phase()) {
            (0, Some(at)) => Phase::new(at.angle() - pow(10.0, -1.0 - 15.3 * pick(7))).unwrap(),
            _ => Phase::new(TAU * pick(11)).unwrap(),
        };
        let slowest = [-7.0, -16.0, -40.0, -323.3][(k / 5 % 4) as usize];
        let speed = pow(10.0, slowest * (0.2 + 0.8 * pick(3)));
        let slip = pow(10.0, -20.0 * pick(13)) * (pick(17) - 0.5) * [0.0, 1.0, 1.0][(k % 3) as usize];
        let spin = system.platform_angular_speed(phase) + slip;
        let record = about_to_attach(system, phase, speed, spin)?.advance().unwrap().unwrap();
        Some((system, record))
    })
}

/// Energy, momentum and states at the end of every chatter, however slow, long or close to a separation.
#[test]
fn every_attachment_closes_its_balance() {
    for restitution in [pow(2.0, -60.0), 0.5, 0.7246, 0.9, 0.99, 0.9999, 1.0 - 1e-7, 1.0 - 1e-12, LAST] {
        for peak in [0.0, 1e-9, 0.5, 1.0, 1.000_000_267_196_965_4, 2.0, 197.39, 1e8] {
            let mut count = 0;
            for (system, record) in attachments(restitution, peak) {
                let ledger = &record.ledger;
                assert!(ledger.relative_closure() <= CLOSURE, "{:e} {record:?}", ledger.relative_closure());
                assert!(ledger.friction_loss >= -CLOSURE * ledger.rotary_magnitude, "{record:?}");
                let momentum = record.after.axial_velocity - record.segment.state.axial_velocity;
                let expected = record.axial_impulse - record.span.radians();
                let scale = peak + record.axial_impulse;
                assert!((momentum - expected).abs() <= CLOSURE * scale + 1e-300, "{record:?}");
                let spin = record.after.angular_speed - record.segment.state.angular_speed;
                let expected = record.angular_impulse - system.load() * record.span.radians();
                let scale = system.twist_speed()
                    + record.segment.state.angular_speed.abs()
                    + record.axial_impulse
                    + system.load().abs() * record.span.radians();
                assert!((spin - expected).abs() <= CLOSURE * scale + 1e-300, "{record:?}");
                count += 1;
            }
            assert!(count > 50, "{count} {restitution} {peak}");
        }
    }
}

/// In the middle of a chatter the height of the disk above the platform is at most that of the current
/// flight, and its angle lies between those at the start and the end.
#[test]
fn the_middle_of_every_chatter_is_known() {
    for restitution in [0.9, 1.0 - 1e-4, 1.0 - 1e-7, LAST] {
        for peak in [0.0, 0.5, 2.0] {
            for (system, record) in attachments(restitution, peak) {
                let speed = record.segment.chatter_speed.unwrap();
                for share in [0.0, 1e-6, 0.25, 0.5, 0.999_999, 1.0] {
                    let now = record.evaluate(&system, share);
                    let gap = now.disk.height - now.platform.height;
                    let relative = now.disk.axial_velocity - now.platform.axial_velocity;
                    let rounding = 4e-15 * (peak + record.span.radians()) + 1e-300;
                    let left = 1.01 * (1.0 - share) * speed + 2e-15 * (peak + 1.0) + 1e-300;
                    assert!(
                        relative.abs() <= left.max(1.01 * speed + rounding),
                        "{share} {now:?} {record:?}"
                    );
                    assert!(gap >= -rounding && gap <= 0.6 * speed * record.span.radians() + rounding);
                    let most = (system.friction() * record.axial_impulse
                        + (system.load().abs() + system.twist_speed()) * record.span.radians())
                        * (1.0 + 1e-9);
                    let spin = now.disk.angular_speed - record.segment.state.angular_speed;
                    let size = record.segment.state.angular_speed.abs() + system.twist_speed();
                    assert!(spin.abs() <= most + 1e-15 * size, "{share} {now:?} {record:?}");
                }
            }
        }
    }
}

/// A launch whose speed once stayed at the smallest double for ever, and a restitution near 1: the attachment
/// is one event.
#[test]
fn chatters_that_never_ended_are_one_event() {
    let peak = 1.000_000_267_196_965_4;
    let vibration = Vibration::new(peak).unwrap();
    let before = vibration.separation_phase().unwrap().angle();
    let mut ended = 0;
    for (restitution, speed) in [
        (0.7246, 2.2e-308),
        (0.7246, 5e-324),
        (0.5, 5e-324),
        (LAST, 1e-40),
        (LAST, 5e-324),
        (1.0 - 1e-7, 1e-20),
    ] {
        for angle in [before - 1e-3, before - 1e-9, before - 4e-16, 4.0] {
            let system = DimensionlessParameters {
                peak_acceleration: peak,
                twist_speed: 0.3,
                phase_lag: 0.4,
                friction: 0.2,
                restitution,
                load: 0.1,
            }
            .build()
            .unwrap();
            let phase = Phase::new(angle).unwrap();
            let Some(mut engine) = about_to_attach(system, phase, speed, 0.1) else { continue };
            let record = engine.advance().unwrap().unwrap();
            assert!(matches!(record.event, Event::Attachment { .. }));
            assert!(record.ledger.relative_closure() <= CLOSURE);
            ended += 1;
        }
    }
    assert!(ended >= 12, "{ended}");
}
