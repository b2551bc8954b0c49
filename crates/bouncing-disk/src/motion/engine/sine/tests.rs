use std::cmp::Ordering;
use std::f64::consts::{FRAC_PI_2, TAU};

use bouncing_disk_core::{Phase, Vibration};
use proptest::prelude::*;

use super::*;
use crate::motion::friction::MAX_CONTACT_EVENTS;
use crate::motion::state::Mode;
use crate::parameters::dimensionless::{DimensionlessParameters, ForcingParameters};
use crate::testing::{self, small_steps::Law};

/// Rounding of a ledger's closure relative to the magnitudes of its terms.
const CLOSURE: f64 = 1.0e-13;

/// Rounding of states that are computed in two ways, relative to the magnitudes involved.
const ROUNDING: f64 = 1.0e-12;

fn records(
    system: &DimensionlessSystem,
    start: InitialCondition,
    policy: ChatterPolicy,
    count: usize,
) -> Vec<EventRecord> {
    Engine::new(*system, start, policy)
        .and_then(|engine| engine.take(count).collect())
        .unwrap_or_else(|error| panic!("{error} for {system:?} {start:?}"))
}

fn slip(system: &DimensionlessSystem, record: &EventRecord, state: &DiskState) -> f64 {
    state.angular_speed - system.platform_angular_speed(record.time.phase)
}

/// Mechanical energy (axial, rotary).
fn energy(state: &DiskState) -> (f64, f64) {
    (
        0.5 * state.axial_velocity * state.axial_velocity + state.height,
        0.5 * state.angular_speed * state.angular_speed,
    )
}

/// Friction that nearly holds the load lets the disk slide for thousands of periods. The angle is then a small
/// difference of the angles that the two would cause alone. The balance accounts for its rounding, and the
/// angle is v^2/(2 (mu - l)) to the accuracy of mu and l.
#[test]
fn a_slip_that_friction_and_load_all_but_hold_closes_its_balance() {
    let phase = Phase::new(2.884_361_746_820_472).unwrap();
    let mut long = 0;
    for (friction, peak_acceleration, twist_speed) in [
        (0.072_764_355_802_913_67, 0.0, 0.0),
        (0.1, 0.0, 0.0),
        (0.1, 0.5, 0.0),
        (0.1, 0.0, 0.05),
        (1.3, 0.9, 0.01),
    ] {
        for exponent in 1..=40 {
            for speed in [0.104_885_647_927_958_9, 1e-3, 7.0, 100.0] {
                let excess =
                    friction * bouncing_disk_core::numerics::elementary::exp(-0.75 * f64::from(exponent));
                let parameters = DimensionlessParameters {
                    peak_acceleration,
                    twist_speed,
                    phase_lag: 0.3,
                    friction,
                    restitution: 0.5,
                    load: -(friction - excess),
                };
                let system = parameters.build().unwrap();
                let start = InitialCondition::Contact { phase, angular_speed: speed };
                let Ok(records) = Engine::new(system, start, ChatterPolicy::Complete)
                    .and_then(|engine| engine.take(4).collect::<Result<Vec<_>, _>>())
                else {
                    // Too long for its end to be resolved.
                    continue;
                };
                for record in &records {
                    let ledger = &record.ledger;
                    assert!(
                        ledger.relative_closure() <= CLOSURE,
                        "{:e} {record:?}",
                        ledger.relative_closure()
                    );
                }
                let Some(slip) = records.first() else { continue };
                long += usize::from(slip.span.periods > 100);
                if peak_acceleration == 0.0 && twist_speed == 0.0 {
                    let net = friction + system.load();
                    let expected = speed * speed / (2.0 * net);
                    let turned = slip.after.angle - slip.segment.state.angle;
                    let known = 8.0 * f64::EPSILON * (friction / net) * expected
                        + f64::EPSILON * slip.after.angle.abs();
                    assert!((turned - expected).abs() <= known, "{turned} {expected} {slip:?}");
                }
            }
        }
    }
    assert!(long > 100, "{long}");
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, ..ProptestConfig::default() })]

    /// Energy is balanced in every event, and no loss is negative.
    #[test]
    fn every_ledger_closes((system, start, policy) in testing::motion()) {
        for record in records(&system, start, policy, 60) {
            let ledger = &record.ledger;
            prop_assert!(ledger.relative_closure() <= CLOSURE, "{:e} {record:?}", ledger.relative_closure());
            prop_assert!(ledger.restitution_loss >= 0.0);
            prop_assert!(ledger.friction_loss >= -CLOSURE * ledger.rotary_magnitude, "{record:?}");
        }
    }

    /// The ledgers agree with the changes of the states.
    #[test]
    fn ledgers_tell_the_change_of_the_states((system, start, policy) in testing::motion()) {
        for record in records(&system, start, policy, 40) {
            let (axial, rotary) = energy(&record.segment.state);
            let (axial_after, rotary_after) = energy(&record.after);
            let ledger = &record.ledger;
            let axial_change = ledger.axial_kinetic_change + ledger.potential_change;
            prop_assert!((axial_after - axial - axial_change).abs() <= CLOSURE * ledger.axial_magnitude);
            prop_assert!(
                (rotary_after - rotary - ledger.rotary_kinetic_change).abs()
                    <= CLOSURE * ledger.rotary_magnitude
            );
        }
    }

    /// A flight conserves the axial energy and the momentum balance holds over impacts.
    #[test]
    fn flights_conserve_energy((system, start, policy) in testing::motion()) {
        for record in records(&system, start, policy, 40) {
            if let Event::Impact { .. } = record.event {
                let (before, after) = (energy(&record.segment.state).0, energy(&record.before).0);
                let scale = record.segment.state.axial_velocity.abs().max(record.before.axial_velocity.abs());
                let height = record.segment.state.height.abs().max(record.before.height.abs());
                // A velocity is the sum of the relative one and the platform's, and is known to their
                // rounding.
                let speeds = scale + system.peak_acceleration() + record.axial_impulse;
                prop_assert!((after - before).abs() <= CLOSURE * (scale * speeds + height), "{record:?}");
                let change = record.after.axial_velocity - record.segment.state.axial_velocity;
                let expected = record.axial_impulse - record.span.radians();
                prop_assert!(
                    (change - expected).abs() <= CLOSURE * (scale + record.axial_impulse + record.span.radians()),
                    "{record:?}"
                );
            }
            if let Event::Attachment { .. } = record.event {
                let change = record.after.axial_velocity - record.segment.state.axial_velocity;
                let expected = record.axial_impulse - record.span.radians();
                let scale = system.peak_acceleration() + record.axial_impulse.abs();
                prop_assert!((change - expected).abs() <= CLOSURE * scale, "{record:?}");
            }
        }
    }

    /// Friction opposes the slip, never reverses it, and stays within its cone.
    #[test]
    fn friction_opposes_the_slip_and_never_reverses_it((system, start, policy) in testing::motion()) {
        for record in records(&system, start, policy, 60) {
            if let Event::Impact { tangential_impact_velocity, capped, .. } = record.event {
                prop_assert!(record.angular_impulse * tangential_impact_velocity <= 0.0);
                let after = slip(&system, &record, &record.after);
                prop_assert!(after * tangential_impact_velocity >= 0.0, "{record:?}");
                prop_assert!(!capped || after == 0.0);
                let cone = system.friction() * record.axial_impulse;
                prop_assert!(record.angular_impulse.abs() <= cone * (1.0 + 2.0 * f64::EPSILON));
            }
        }
    }

    /// On a platform at rest nothing gains energy.
    #[test]
    fn a_still_platform_gives_no_energy(
        system in testing::system_with(Just(0.0).boxed()), phase in testing::phase(), policy in testing::policy(),
        gap in 1e-6..10.0_f64, spin in -5.0..5.0_f64,
    ) {
        let system = DimensionlessParameters { twist_speed: 0.0, load: 0.0, ..system.parameters() }.build().unwrap();
        let start = InitialCondition::Flight { phase, gap, relative_velocity: 0.0, angular_speed: spin };
        for record in records(&system, start, policy, 100) {
            let (axial, rotary) = energy(&record.segment.state);
            let (axial_after, rotary_after) = energy(&record.after);
            prop_assert!(axial_after <= axial * (1.0 + 1e-14) + 1e-300, "{record:?}");
            prop_assert!(rotary_after <= rotary);
        }
    }

    /// The dense motion passes through the events, stays above the platform, slips in the direction of its
    /// mode, and sticks only where friction can hold it.
    #[test]
    fn dense_motion_respects_its_mode((system, start, policy) in testing::motion()) {
        let mut last = *Engine::new(system, start, policy).unwrap().state();
        let peak = system.peak_acceleration();
        let spin = system.twist_speed();
        let (twist_cosine, twist_sine) = system.twist_components();
        for record in records(&system, start, policy, 40) {
            prop_assert_eq!(record.segment.state, last);
            last = record.after;
            let end = record.evaluate(&system, 1.0);
            let speed = peak + 1.0 + record.segment.state.axial_velocity.abs();
            prop_assert!((end.disk.height - record.before.height).abs() <= ROUNDING * speed * speed, "{record:?}");
            // The rates count for at least a radian, because the ends are known to the rounding of their
            // phases.
            let turned = spin
                + record.segment.state.angular_speed.abs()
                + (system.load().abs() + system.friction() * (1.0 + peak)) * (1.0 + record.span.radians());
            prop_assert!(
                (end.disk.angular_speed - record.before.angular_speed).abs() <= ROUNDING * turned,
                "{record:?} {end:?}"
            );
            let angle = record.before.angle.abs() + turned * (1.0 + record.span.radians());
            prop_assert!((end.disk.angle - record.before.angle).abs() <= ROUNDING * angle, "{record:?} {end:?}");
            for step in 0..=16 {
                let now = record.evaluate(&system, f64::from(step) / 16.0);
                let slip = now.disk.angular_speed - now.platform.angular_speed;
                let gap = now.disk.height - now.platform.height;
                match record.segment.state.mode {
                    Mode::Flight => prop_assert!(gap >= -ROUNDING * speed * speed, "{gap} {record:?} {now:?}"),
                    Mode::Sticking => {
                        let phase = now.time.phase;
                        let needed = system.load() - (twist_cosine * phase.sin() + twist_sine * phase.cos());
                        let cone = system.friction() * system.vibration().contact_force(phase);
                        let scale = system.load().abs() + spin + system.friction() * (1.0 + peak);
                        prop_assert!(needed.abs() <= cone + ROUNDING * scale, "{record:?} {now:?}");
                    }
                    Mode::Sliding(direction) => {
                        prop_assert!(direction.sign() * slip >= -ROUNDING * turned, "{slip} {record:?} {now:?}");
                    }
                }
                if record.segment.state.mode != Mode::Flight {
                    let force = system.vibration().contact_force(now.time.phase);
                    prop_assert!(force >= -ROUNDING * peak, "{record:?} {now:?}");
                }
            }
        }
    }

    /// Time never decreases, and a segment of contact has a bounded number of events.
    #[test]
    fn contact_events_are_few((system, start, policy) in testing::motion()) {
        let mut time = PhaseTime::in_first_period(Phase::new(0.0).unwrap());
        let mut contact = 0;
        for record in records(&system, start, policy, 200) {
            prop_assert!(record.time.order(&time) != Ordering::Less);
            time = record.time;
            match record.event {
                Event::StickToSlip(_) | Event::SlipToStick | Event::SlipReversal(_) => contact += 1,
                _ => contact = 0,
            }
            if system.vibration().separation_phase().is_some() {
                prop_assert!(contact <= MAX_CONTACT_EVENTS, "{contact} {record:?}");
            } else {
                let periods = 1 + usize::try_from(time.periods).unwrap();
                prop_assert!(contact <= MAX_CONTACT_EVENTS * periods, "{contact} {record:?}");
            }
        }
    }

    /// A disk without friction is never held, unless nothing accelerates it.
    #[test]
    fn nothing_holds_a_disk_without_friction((system, start, policy) in testing::motion()) {
        let twist_speed = system.twist_speed() + 0.1;
        let system =
            DimensionlessParameters { friction: 0.0, twist_speed, ..system.parameters() }.build().unwrap();
        for record in records(&system, start, policy, 60) {
            prop_assert!(record.after.mode != Mode::Sticking, "{record:?}");
            // At the end of a slip the speed agrees with the platform's to the rounding of its phase.
            let rounding = ROUNDING
                * (twist_speed + system.load().abs() * (1.0 + record.span.radians())
                    + record.segment.state.angular_speed.abs());
            prop_assert!(record.ledger.friction_loss.abs() <= rounding * rounding, "{record:?}");
        }
    }

    /// The same arguments produce the same bits.
    #[test]
    fn the_engine_is_deterministic((system, start, policy) in testing::motion()) {
        prop_assert_eq!(records(&system, start, policy, 50), records(&system, start, policy, 50));
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, ..ProptestConfig::default() })]

    /// The vertical motion agrees with the map, bit for bit.
    #[test]
    fn engine_and_map_agree_bit_for_bit(
        (system, start, policy) in testing::motion(), speed in 0.01..3.0_f64, phase in testing::phase(),
    ) {
        let start = match start {
            InitialCondition::Flight { .. } => start,
            _ => InitialCondition::Launch { phase, relative_speed: speed, angular_speed: 0.3 },
        };
        let mut orbit = match start {
            InitialCondition::Flight { phase, gap, relative_velocity, .. } => {
                system.map().orbit_from_drop(phase, gap, relative_velocity, policy)
            }
            _ => bouncing_disk_core::Launch::new(phase, speed).map(|launch| system.map().orbit_from_launch(launch, policy)),
        }
        .unwrap();
        let mut separation = None;
        for record in records(&system, start, policy, 3000) {
            match record.event {
                Event::Impact { axial_impact_velocity, .. } => {
                    let Some(OrbitEvent::Impact(impact)) = orbit.advance().unwrap() else { panic!("{record:?}") };
                    prop_assert_eq!(record.time.phase, impact.phase);
                    prop_assert_eq!(axial_impact_velocity.to_bits(), impact.velocity.to_bits());
                    prop_assert_eq!(record.span.periods, impact.periods);
                    prop_assert_eq!(record.span.remainder.to_bits(), impact.remainder.to_bits());
                }
                Event::Attachment { .. } => {
                    let Some(OrbitEvent::Attachment(rest)) = orbit.advance().unwrap() else { panic!("{record:?}") };
                    prop_assert_eq!(record.time.phase, rest.accumulation.phase);
                    separation = rest.separation;
                }
                Event::Separation => prop_assert_eq!(Some(record.time.phase), separation.map(|at| at.0)),
                _ => {}
            }
        }
    }
}

fn lively() -> DimensionlessSystem {
    ForcingParameters { axial_forcing: 0.6, angular_forcing: 1.0, phase_lag: 0.0, restitution: 0.5 }
        .build()
        .unwrap()
}

/// Impacts and half-periods follow Zeno's sums: a drop from height h comes to rest after
/// sqrt(2 h) (1 + r)/(1 - r).
#[test]
fn a_drop_on_a_still_platform_comes_to_rest_after_zenos_time() {
    for restitution in [0.0, 0.1, 0.5, 0.8, 0.95] {
        for gap in [1e-6, 0.3, 40.0] {
            let system = DimensionlessParameters {
                peak_acceleration: 0.0,
                twist_speed: 0.0,
                phase_lag: 0.0,
                friction: 0.3,
                restitution,
                load: 0.0,
            }
            .build()
            .unwrap();
            let phase = Phase::new(0.0).unwrap();
            let start = InitialCondition::Flight { phase, gap, relative_velocity: 0.0, angular_speed: 0.0 };
            let last = records(&system, start, ChatterPolicy::Complete, 10_000).pop().unwrap();
            assert!(matches!(last.event, Event::Attachment { .. }));
            assert_eq!(last.after.mode, Mode::Sticking);
            let time = last.time.periods as f64 * TAU + last.time.phase.angle();
            let expected = (2.0 * gap).sqrt() * (1.0 + restitution) / (1.0 - restitution);
            assert!((time - expected).abs() <= 1e-13 * expected, "{time} {expected}");
        }
    }
}

/// The impulses of a complete chatter agree with those of the explicit bounces under the paper's policy.
#[test]
fn chatter_sums_agree_with_explicit_bounces() {
    let system = lively();
    let phase = Phase::new(4.0).unwrap();
    let start = InitialCondition::Launch { phase, relative_speed: 0.05, angular_speed: 5.0 };
    let totals = [ChatterPolicy::Complete, crate::motion::PAPER_CHATTER].map(|policy| {
        let mut totals = (0.0, 0.0, 0.0);
        for record in Engine::new(system, start, policy).unwrap() {
            let record = record.unwrap();
            totals.0 += record.axial_impulse;
            totals.1 += record.angular_impulse;
            totals.2 += record.ledger.restitution_loss;
            if matches!(record.event, Event::Attachment { .. }) {
                break;
            }
        }
        totals
    });
    // The cut removes speeds below pi 1e-6.
    assert!((totals[0].0 - totals[1].0).abs() < 2e-5, "{totals:?}");
    assert!((totals[0].1 - totals[1].1).abs() < 2e-5, "{totals:?}");
    assert!((totals[0].2 - totals[1].2).abs() < 1e-9, "{totals:?}");
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, max_global_rejects: 100_000, ..ProptestConfig::default() })]

    /// Compares the contact solver with small steps of the friction law itself.
    #[test]
    fn contact_events_are_those_of_a_fine_time_integration(
        peak in prop_oneof![Just(0.0), 0.0..1.0_f64, 1.0..1.5_f64], twist in 0.0..3.0_f64, lag in -3.0..3.0_f64,
        friction in 0.05..1.5_f64, load in prop_oneof![Just(0.0), -0.5..0.5_f64], angle in 0.0..TAU,
        spin in prop_oneof![Just(None), (-3.0..3.0_f64).prop_map(Some)],
    ) {
        let system = DimensionlessParameters {
            peak_acceleration: peak, twist_speed: twist, phase_lag: lag, friction, restitution: 0.5, load,
        }
        .build()
        .unwrap();
        let phase = Phase::new(angle).unwrap();
        let spin = spin.unwrap_or_else(|| system.platform_angular_speed(phase));
        let engine = Engine::new(system, InitialCondition::Contact { phase, angular_speed: spin }, ChatterPolicy::Complete);
        let engine = engine.unwrap();
        prop_assume!(engine.state().mode != Mode::Flight);
        let until = match system.vibration().separation_phase() {
            Some(at) => {
                let at = PhaseTime { periods: u64::from(at.angle() <= angle), phase: at };
                at.since(&engine.time()).radians() - 1e-2
            }
            None => 12.0,
        };
        let from = engine.time();
        let found: Vec<_> = engine
            .map(|record| record.unwrap())
            .map(|record| {
                let kind = match record.event {
                    Event::StickToSlip(_) => "slips",
                    Event::SlipToStick => "sticks",
                    Event::SlipReversal(_) => "reverses",
                    _ => "other",
                };
                (angle + record.time.since(&from).radians(), kind)
            })
            .take_while(|event| event.0 < angle + until)
            .collect();
        // The steps cannot resolve events that crowd together.
        prop_assume!(found.windows(2).all(|pair| pair[1].0 - pair[0].0 > 2e-2));
        prop_assume!(found.first().is_none_or(|first| first.0 - angle > 2e-2));
        let law = Law { peak, twist, lag, friction, load, spring: None };
        let expected = law.events_on_platform(angle, spin, angle + until);
        let last_certain = angle + until - 1e-2;
        let certain = |events: &[(f64, &'static str)]| -> Vec<(f64, &'static str)> {
            events.iter().copied().filter(|event| event.0 < last_certain).collect()
        };
        let (found, expected) = (certain(&found), certain(&expected));
        prop_assert!(found.len() == expected.len(), "{found:?} {expected:?}");
        for (one, other) in found.iter().zip(&expected) {
            prop_assert!(one.1 == other.1 && (one.0 - other.0).abs() < 1e-4, "{found:?} {expected:?}");
        }
    }
}

/// A disk at rest on a gentle platform slips for ever, slowly, and one that friction holds ends the sequence.
#[test]
fn a_resting_disk_slips_periodically_or_ends() {
    let gentle = DimensionlessParameters {
        peak_acceleration: 0.5,
        twist_speed: 2.0,
        phase_lag: 0.3,
        friction: 0.5,
        restitution: 0.5,
        load: 0.0,
    };
    let start = InitialCondition::Contact { phase: Phase::new(1.0).unwrap(), angular_speed: 0.0 };
    let slipping = records(&gentle.build().unwrap(), start, ChatterPolicy::Complete, 5000);
    assert_eq!(slipping.len(), 5000);
    assert!(slipping.iter().all(|record| record.before.mode != Mode::Flight));
    let held = DimensionlessParameters { twist_speed: 0.2, ..gentle }.build().unwrap();
    let end = records(&held, start, ChatterPolicy::Complete, 5000);
    assert_eq!(end.len(), 1);
    assert_eq!(end[0].event, Event::SlipToStick);
}

/// Braking on a still platform: the speed falls by mu per radian.
#[test]
fn a_still_platform_brakes_the_disk_uniformly() {
    let system = DimensionlessParameters {
        peak_acceleration: 0.0,
        twist_speed: 0.0,
        phase_lag: 0.0,
        friction: 0.1,
        restitution: 0.5,
        load: 0.02,
    }
    .build()
    .unwrap();
    let start = InitialCondition::Contact { phase: Phase::new(0.0).unwrap(), angular_speed: 7.0e5 };
    let end = records(&system, start, ChatterPolicy::Complete, 10);
    assert_eq!(end.len(), 1);
    let expected = 7.0e5 / 0.12;
    assert!((end[0].span.radians() - expected).abs() < 1e-15 * expected);
    let turned = 0.5 * 7.0e5 * expected;
    assert!((end[0].after.angle - turned).abs() < 1e-14 * turned);
    let forever = InitialCondition::Contact { phase: Phase::new(0.0).unwrap(), angular_speed: 1e9 };
    let error = Engine::new(system, forever, ChatterPolicy::Complete).unwrap().next().unwrap().unwrap_err();
    assert!(matches!(error, Error::SlipTooLong { .. }), "{error}");
}

/// The next flight starts with the perturbed launch, and its ledger closes.
#[test]
fn a_perturbed_launch_flies_with_its_new_speed() {
    let system = lively();
    let start = InitialCondition::Contact { phase: Phase::new(4.0).unwrap(), angular_speed: 0.0 };
    let mut engine = Engine::new(system, start, ChatterPolicy::Complete).unwrap();
    engine.perturb_launch(0.5).unwrap();
    let resting = system.vibration().velocity(Phase::new(4.0).unwrap());
    assert_eq!(engine.state().axial_velocity.to_bits(), resting.to_bits());
    while engine.advance().unwrap().unwrap().event != Event::Separation {}
    assert!(engine.launches());
    engine.perturb_launch(1e-3).unwrap();
    let platform = PlatformState::at(&system, engine.time().phase);
    assert!((engine.state().axial_velocity - (platform.axial_velocity + 1e-3)).abs() < 1e-15);
    let record = engine.advance().unwrap().unwrap();
    assert!(record.ledger.relative_closure() < CLOSURE);
    let vibration = Vibration::from_axial_forcing(0.6).unwrap();
    let launch = bouncing_disk_core::Launch::new(record.segment.start.phase, 1e-3).unwrap();
    assert_eq!(vibration.first_impact(launch).unwrap().phase, record.time.phase);
    assert!(engine.perturb_launch(-1.0).is_err());
}

/// If the platform falls away, a disk placed on it flies at once.
#[test]
fn a_platform_that_falls_away_launches_the_disk_at_once() {
    let start = InitialCondition::Contact { phase: Phase::new(FRAC_PI_2).unwrap(), angular_speed: 0.0 };
    let engine = Engine::new(lively(), start, ChatterPolicy::Complete).unwrap();
    assert_eq!(engine.state().mode, Mode::Flight);
    assert!(engine.launches());
}

/// Long flights at 70 kHz: energy is balanced to rounding over 1e5 events, and the angle is the integral of
/// the angular speed.
#[test]
fn motor_flights_close_and_the_angle_does_not_drift() {
    let mut worst = (0.0_f64, 0.0_f64, 0.0_f64);
    for amplitude in [1e-9, 1e-8, 1e-7] {
        for policy in [ChatterPolicy::Complete, crate::motion::PAPER_CHATTER] {
            let system = testing::motor(amplitude, 0.0);
            let start = InitialCondition::Contact { phase: Phase::new(0.0).unwrap(), angular_speed: 0.0 };
            let mut angle = *Engine::new(system, start, policy).unwrap().state();
            let mut energy_error = 0.0_f64;
            for record in Engine::new(system, start, policy).unwrap().take(20_000) {
                let record = record.unwrap();
                worst.0 = worst.0.max(record.ledger.relative_closure());
                if let Event::Impact { .. } = record.event {
                    let (from, to) = (energy(&record.segment.state).0, energy(&record.before).0);
                    energy_error =
                        energy_error.max((from - to).abs() / (from.abs() + system.peak_acceleration()));
                    let mean = 0.5 * (record.segment.state.angular_speed + record.before.angular_speed);
                    let expected = angle.angle + mean * record.span.radians();
                    worst.2 = worst.2.max((record.before.angle - expected).abs() / (1.0 + expected.abs()));
                }
                angle = record.after;
            }
            worst.1 = worst.1.max(energy_error);
        }
    }
    println!("worst closure {:e}, worst flight energy {:e}, angle {:e}", worst.0, worst.1, worst.2);
    assert!(worst.0 < 1e-14 && worst.1 < 1e-12 && worst.2 < 1e-14, "{worst:?}");
}

/// A cut also removes the rebound if the platform falls away: the disk leaves with the platform's velocity,
/// and the energy balance includes the removed energy.
#[test]
fn a_cut_where_the_platform_falls_away_lets_the_disk_go_at_once() {
    let system =
        ForcingParameters { axial_forcing: 1.2, angular_forcing: 2.0, phase_lag: 0.2, restitution: 0.5 };
    let system = system.build().expect("legal");
    // Every impact is slow enough.
    let policy = ChatterPolicy::Cut(ChatterCut::new(1e3, 0.0, 1).expect("legal"));
    let mut cuts = 0;
    for k in 0..40 {
        let phase = Phase::new(0.1 * f64::from(k)).expect("finite");
        let start = InitialCondition::Launch { phase, relative_speed: 0.7, angular_speed: 1.0 };
        for record in records(&system, start, policy, 6) {
            assert!(record.ledger.relative_closure() <= CLOSURE, "{record:?}");
            if matches!(record.event, Event::Impact { .. }) {
                let platform = system.vibration().velocity(record.time.phase);
                if record.after.mode == Mode::Flight
                    && system.vibration().falls_away_at(record.time.phase.angle())
                {
                    cuts += 1;
                    assert!((record.after.axial_velocity - platform).abs() <= 1e-15, "{record:?}");
                }
            }
        }
    }
    assert!(cuts > 5, "{cuts}");
}
