//! One test per equation of the paper, on an SI system of no special values, through the public interface
//! only.
//!
//! Eqs. (14) and (17) have theirs beside the items that implement them.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::f64::consts::{FRAC_PI_2, PI};

use bouncing_disk::core::numerics::elementary::{asin, cos, sin, tan};
use bouncing_disk::core::{ChatterPolicy, Phase};
use bouncing_disk::motion::Mode;
use bouncing_disk::parameters::Stroke;
use bouncing_disk::toss::period_one_rotary_speed;
use bouncing_disk::{
    DiskParameters, Engine, Event, EventRecord, InitialCondition, Platform, PlatformParameters, System,
};

const OMEGA: f64 = 20.0;
const G: f64 = 9.8;
const CONTACT_RADIUS: f64 = 0.13;
const GYRATION_RADIUS: f64 = 0.11;
const FRICTION: f64 = 0.4;
const RESTITUTION: f64 = 0.6;

fn system(axial_forcing: f64, twist_amplitude: f64, phase_lag: f64) -> System {
    let platform = PlatformParameters {
        amplitude: axial_forcing * PI * G / (OMEGA * OMEGA),
        twist_amplitude,
        angular_frequency: OMEGA,
        phase_lag,
    };
    let disk = DiskParameters {
        contact_radius: CONTACT_RADIUS,
        gyration_radius: GYRATION_RADIUS,
        friction: FRICTION,
        restitution: RESTITUTION,
        preload_acceleration: G,
        load_acceleration: 0.0,
    };
    System::new(platform.build().unwrap(), disk.build().unwrap()).unwrap()
}

fn phase(angle: f64) -> Phase {
    Phase::new(angle).unwrap()
}

/// The first `count` events of a disk that starts on the platform at phase 4 without turning.
fn events(system: &System, count: usize) -> Vec<EventRecord> {
    let start = InitialCondition::Contact { phase: phase(4.0), angular_speed: 0.0 };
    let mut engine = Engine::new(system, start, ChatterPolicy::Complete).unwrap();
    (0..count).map(|_| engine.advance().unwrap().unwrap()).collect()
}

fn assert_near(value: f64, expected: f64, scale: f64) {
    assert!((value - expected).abs() <= 1e-12 * scale, "{value} against {expected}");
}

#[test]
fn equation_1_the_platform_moves_as_two_sines() {
    let system = system(0.7, 0.3, 0.8);
    let platform = system.platform();
    for time in [0.0, 0.02, 0.11, 0.3] {
        let at = phase(OMEGA * time);
        assert_near(platform.height(at), platform.amplitude() * sin(OMEGA * time), 1.0);
        assert_near(platform.angle(at), 0.3 * sin(OMEGA * time + 0.8), 1.0);
    }
}

/// In contact the disk's angular acceleration is T_f/(m a_g^2), and in flight only gravity acts.
#[test]
fn equation_2_the_disk_obeys_newton() {
    let system = system(0.7, 0.3, 0.8);
    let scales = system.scales();
    for record in events(&system, 40) {
        let at = |fraction| record.evaluate(system.dimensionless(), fraction);
        let [before, middle, after] = [0.5 - 1e-3, 0.5, 0.5 + 1e-3].map(at);
        let step = scales.span_seconds(record.span) * 1e-3;
        if step < 1e-6 {
            continue;
        }
        let rate = |of: fn(&bouncing_disk::motion::SiState) -> f64| {
            (of(&scales.state(&after.disk)) - of(&scales.state(&before.disk))) / (2.0 * step)
        };
        let (axial, rotary) = (rate(|disk| disk.axial_velocity), rate(|disk| disk.angular_speed));
        let platform_acceleration = -system.platform().amplitude() * OMEGA * OMEGA * middle.time.phase.sin();
        let normal = if middle.disk.mode == Mode::Flight { 0.0 } else { G + platform_acceleration };
        // The difference quotient is off by step^2/6 of the third derivative.
        let error = 1e-4 * OMEGA * OMEGA;
        assert!((axial - (normal - G)).abs() < error, "{axial} {normal} {record:?}");
        let torque = FRICTION * CONTACT_RADIUS / (GYRATION_RADIUS * GYRATION_RADIUS) * normal;
        let expected = match middle.disk.mode {
            Mode::Flight => 0.0,
            Mode::Sliding(direction) => -direction.sign() * torque,
            Mode::Sticking => -0.3 * OMEGA * OMEGA * sin(middle.time.phase.angle() + 0.8),
        };
        assert!((rotary - expected).abs() < error, "{rotary} {expected} {record:?}");
    }
}

#[test]
fn equation_3_contact_is_lost_where_the_normal_force_falls_to_zero() {
    let system = system(0.7, 0.0, 0.0);
    let separation = events(&system, 8).into_iter().find(|record| record.event == Event::Separation).unwrap();
    let vibration = system.dimensionless().vibration();
    assert!(vibration.contact_force(separation.time.phase).abs() < 1e-15);
    assert!(vibration.contact_force(phase(4.0)) > 0.0);
    assert_near(G * vibration.contact_force(phase(4.0)), G - 0.7 * PI * G * sin(4.0), G);
}

/// A twist within the friction envelope carries a resting disk along, a stronger one slides under it.
#[test]
fn equation_4_static_friction_holds_within_its_envelope() {
    // Without lift-off, sin tau = 0 at the largest twist acceleration for a lag of pi/2: N = m g there.
    let envelope = FRICTION * CONTACT_RADIUS / (GYRATION_RADIUS * GYRATION_RADIUS) * G;
    for (share, slides) in [(0.99, false), (1.01, true)] {
        let twist_amplitude = share * envelope / (OMEGA * OMEGA);
        let system = system(0.0, twist_amplitude, FRAC_PI_2);
        let start = InitialCondition::Contact {
            phase: phase(FRAC_PI_2),
            angular_speed: system.dimensionless().platform_angular_speed(phase(FRAC_PI_2)),
        };
        let mut engine = Engine::new(system, start, ChatterPolicy::Complete).unwrap();
        assert_eq!(engine.state().mode, Mode::Sticking);
        let event = engine.advance().unwrap();
        assert_eq!(
            matches!(event.map(|record| record.event), Some(Event::StickToSlip(_))),
            slides,
            "{event:?}"
        );
    }
}

fn impacts(system: &System) -> Vec<(EventRecord, f64, f64, bool)> {
    let found: Vec<_> = events(system, 400)
        .into_iter()
        .filter_map(|record| match record.event {
            Event::Impact { axial_impact_velocity, tangential_impact_velocity, capped } => {
                Some((record, axial_impact_velocity, tangential_impact_velocity, capped))
            }
            _ => None,
        })
        .collect();
    assert!(found.len() > 100);
    found
}

#[test]
fn equation_5_the_axial_impulse_is_the_change_of_momentum() {
    for (record, ..) in impacts(&system(0.9, 0.2, 0.3)) {
        let change = record.after.axial_velocity - record.before.axial_velocity;
        assert_near(record.axial_impulse, change, 1.0 + change.abs());
    }
}

#[test]
fn equation_6_the_rebound_is_the_restitution_times_the_approach() {
    let system = system(0.9, 0.2, 0.3);
    for (record, before, ..) in impacts(&system) {
        let platform = system.dimensionless().vibration().velocity(record.time.phase);
        assert_near(record.before.axial_velocity - platform, before, 10.0);
        assert_near(record.after.axial_velocity - platform, -RESTITUTION * before, 10.0);
    }
}

#[test]
fn equation_7_the_axial_impulse_follows_from_the_approach() {
    for (record, before, ..) in impacts(&system(0.9, 0.2, 0.3)) {
        assert_near(record.axial_impulse, (1.0 + RESTITUTION) * -before, 1.0 + before.abs());
    }
}

#[test]
fn equation_8_a_slip_throughout_takes_the_available_impulse() {
    let sliding = impacts(&system(0.9, 2.0, 0.3)).into_iter().filter(|(.., capped)| !capped);
    let mut count = 0;
    for (record, _, slip, _) in sliding {
        assert_near(record.angular_impulse, -slip.signum() * FRICTION * record.axial_impulse, 10.0);
        count += 1;
    }
    assert!(count > 10, "{count}");
}

#[test]
fn equation_9_a_slip_that_ends_takes_the_stopping_impulse() {
    let system = system(0.9, 0.05, 0.3);
    let mut count = 0;
    for (record, _, slip, _) in impacts(&system).into_iter().filter(|(.., capped)| *capped) {
        assert_near(record.angular_impulse, -slip, 1.0 + slip.abs());
        let platform = system.dimensionless().platform_angular_speed(record.time.phase);
        assert_near(record.after.angular_speed, platform, 1.0 + platform.abs());
        count += 1;
    }
    assert!(count > 10, "{count}");
}

#[test]
fn equation_10_the_smaller_impulse_is_taken() {
    for twist_amplitude in [0.05, 0.3, 2.0] {
        for (record, _, slip, capped) in impacts(&system(0.9, twist_amplitude, 0.3)) {
            let available = FRICTION * record.axial_impulse;
            assert_eq!(capped, slip.abs() <= available);
            assert_near(record.angular_impulse.abs(), available.min(slip.abs()), 1.0 + available);
        }
    }
}

/// At the impact, and never before it in the flight, the parabola meets the platform.
#[test]
fn equation_11_a_flight_ends_where_the_parabola_meets_the_platform() {
    let system = system(0.9, 0.2, 0.3);
    for (record, ..) in impacts(&system) {
        let end = record.evaluate(system.dimensionless(), 1.0);
        assert_near(end.disk.height, end.platform.height, 10.0);
        for k in 1..200 {
            let there = record.evaluate(system.dimensionless(), f64::from(k) / 200.0);
            assert!(there.disk.height >= there.platform.height - 1e-12, "{k} {record:?}");
        }
    }
}

/// Sliding contact against a sum over 20,000 steps of the midpoint rule.
#[test]
fn equation_12_sliding_contact_integrates_the_friction() {
    let system = system(0.7, 2.0, 0.8);
    let slide = events(&system, 40)
        .into_iter()
        .find(|record| matches!(record.before.mode, Mode::Sliding(_)) && record.span.radians() > 0.5)
        .unwrap();
    let Mode::Sliding(direction) = slide.before.mode else { unreachable!() };
    let first = slide.evaluate(system.dimensionless(), 0.0);
    let (steps, start, span) = (20_000, first.time.phase.angle(), slide.span.radians());
    let width = span / f64::from(steps);
    let sum: f64 = (0..steps)
        .map(|k| 1.0 - 0.7 * PI * sin(start + (f64::from(k) + 0.5) * width))
        .map(|normal| -direction.sign() * FRICTION * normal * width)
        .sum();
    assert!((slide.before.angular_speed - first.disk.angular_speed - sum).abs() < 1e-7);
}

#[test]
fn equation_13_a_stroke_and_its_angle_give_both_amplitudes() {
    let stroke = Stroke {
        stroke: 0.25,
        amplitude_angle: 0.55,
        contact_radius: CONTACT_RADIUS,
        angular_frequency: OMEGA,
        phase_lag: 0.0,
    };
    let platform = Platform::from_stroke(stroke).unwrap();
    assert_near(platform.amplitude(), 0.25 * cos(0.55), 1.0);
    assert_near(CONTACT_RADIUS * platform.twist_amplitude(), 0.25 * sin(0.55), 1.0);
    assert_near(CONTACT_RADIUS * platform.twist_amplitude() / platform.amplitude(), tan(0.55), 1.0);
}

#[test]
fn equation_15_the_platform_falls_away_at_the_arc_sine() {
    for axial_forcing in [0.32, 0.5, 2.0, 70.0] {
        let vibration = *system(axial_forcing, 0.0, 0.0).dimensionless().vibration();
        let leaves = vibration.separation_phase().unwrap().angle();
        assert_near(leaves, asin(1.0 / (PI * axial_forcing)), 1.0 / (1.0 - 1.0 / (PI * axial_forcing)));
    }
    assert_eq!(system(0.31, 0.0, 0.0).dimensionless().vibration().separation_phase(), None);
}

/// A disk on the period-1 orbit ends at the platform's speed at impact, largest for a phase lag of minus its
/// phase.
#[test]
fn equation_16_period_one_turns_with_the_platform_at_impact() {
    let at = |lag: f64| {
        let system = system(0.3, 0.4, lag);
        let orbit = system.dimensionless().map().period_one(1).unwrap();
        let start = InitialCondition::Launch {
            phase: orbit.phase(),
            relative_speed: -RESTITUTION * orbit.velocity(),
            angular_speed: 0.0,
        };
        let mut engine = Engine::new(system, start, ChatterPolicy::Complete).unwrap();
        for _ in 0..500 {
            engine.advance().unwrap().unwrap();
        }
        let expected = period_one_rotary_speed(system.dimensionless(), orbit.phase());
        assert!((engine.state().angular_speed - expected).abs() < 1e-9 * (1.0 + expected.abs()));
        let peak = system.scales().angular_speed * expected / system.platform().peak_angular_speed();
        (peak, orbit.phase().angle())
    };
    let (_, impact_phase) = at(0.0);
    assert_near(at(-impact_phase).0, 1.0, 1.0);
    assert_near(at(0.0).0, cos(impact_phase), 1.0);
}
