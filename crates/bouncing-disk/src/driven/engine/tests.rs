mod compliance;

use bouncing_disk_drives::Drive;
use proptest::prelude::*;

use super::*;
use crate::motion::engine::Engine;
use crate::motion::event::Event;
use crate::parameters::driven_platform::Waveform;
use crate::testing::{self, refused};

/// Largest rounding difference, relative to the magnitudes compared.
const ROUNDING: f64 = 1e-12;

/// Compares each event of the sine's engine with the event that the engine of the Fourier sum finds from the
/// same state.
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
        // Rounding decides whether a slip that only touches zero ends there.
        let rate = [SlipDirection::Forward, SlipDirection::Backward]
            .map(|direction| {
                Touching { system: &driven, ride: Ride::Platform(&driven.height) }
                    .growth(direction, record.time.phase.angle())
                    .0[0]
                    .abs()
            })
            .into_iter()
            .fold(f64::INFINITY, f64::min);
        let slip_ends = matches!(record.event, Event::SlipToStick | Event::SlipReversal(_));
        let grazes = slip_ends && rate < 1e-6 * spin;
        // The end of a slip that falls slowly is as uncertain as its speed divided by the rate.
        let slow = if slip_ends { 0.02 * spin / rate } else { 0.0 };
        let Some(mut found) = own.advance().expect("no failure") else {
            prop_assert!(grazes, "{record:?}");
            break;
        };
        let (mut span, mut ledger, mut impulse) = (found.span.radians(), found.ledger, found.angular_impulse);
        if let Event::Attachment { .. } = record.event {
            while !matches!(found.event, Event::Attachment { .. }) {
                found = own.advance().expect("no failure").expect("an event");
                span += found.span.radians();
                ledger += found.ledger;
                impulse += found.angular_impulse;
            }
        }
        prop_assert!(ledger.relative_closure() < ROUNDING, "{:e} {found:?}", ledger.relative_closure());
        let kind = std::mem::discriminant(&found.event);
        if grazes && kind != std::mem::discriminant(&record.event) {
            break;
        }
        prop_assert!(kind == std::mem::discriminant(&record.event), "{found:?}\n{record:?}");
        let index = match found.event {
            Event::Impact { .. } => 0,
            Event::Attachment { .. } => 1,
            Event::Separation => 2,
            Event::StickToSlip(_) => 3,
            Event::SlipToStick => 4,
            Event::SlipReversal(_) => 5,
            _ => 6,
        };
        counts[index] += 1;
        let near = |one: f64, other: f64, size: f64| {
            (one - other).abs() <= ROUNDING * (size + one.abs() + other.abs())
        };
        // A root of a slow fall is uncertain in inverse proportion to its slope.
        prop_assert!(near(span, record.span.radians(), 1.0 + slow), "{span} {record:?}\n{found:?}");
        for (one, other) in [(found.before, record.before), (found.after, record.after)] {
            prop_assert!(near(one.height, other.height, size * (1.0 + span + slow)), "{one:?} {other:?}");
            prop_assert!(
                near(one.axial_velocity, other.axial_velocity, size * (1.0 + span + slow)),
                "{one:?} {other:?}"
            );
            prop_assert!(
                near(one.angular_speed, other.angular_speed, spin * (1.0 + span + slow)),
                "{one:?} {other:?} {record:?}"
            );
            prop_assert!(
                near(one.angle, other.angle, spin * (1.0 + span + slow) * (1.0 + span + slow)),
                "{one:?} {other:?}"
            );
            // Rounding decides whether the last impact of a chatter ends a slip of one rounding.
            let slip = other.angular_speed - system.platform_angular_speed(record.time.phase);
            let hidden = matches!(record.event, Event::Attachment { .. }) && near(slip, 0.0, spin);
            prop_assert!(one.mode == other.mode || hidden, "{one:?} {other:?} {record:?}");
        }
        prop_assert!(
            near(impulse, record.angular_impulse, spin * (1.0 + span + slow)),
            "{impulse} {record:?}"
        );
        let magnitude = (spin * spin + record.ledger.rotary_magnitude) * (1.0 + span + slow);
        prop_assert!(
            near(ledger.friction_loss, record.ledger.friction_loss, magnitude),
            "{found:?} {record:?}"
        );
        // The next event from the same state: a launch by its own relative speed, which conversion to a
        // velocity would round.
        let speed = match record.event {
            Event::Impact { axial_impact_velocity, .. } => -system.restitution() * axial_impact_velocity,
            _ => 0.0,
        };
        match record.event {
            Event::Impact { .. } => {
                own.now = PhaseTime { phase: phase_at(record.time.phase.angle()), ..record.time };
                (own.state, own.angle) = (record.after, LongSum::new(record.after.angle));
                let launched = DrivenFlight::Free { gap: 0.0, velocity: speed };
                own.stage = match own.stage {
                    Stage::Flight(DrivenFlight::Cut { error, .. }) => {
                        Stage::Flight(DrivenFlight::Cut { speed, error })
                    }
                    Stage::Flight(DrivenFlight::Free { velocity, .. }) if velocity > 0.0 => {
                        Stage::Flight(launched)
                    }
                    Stage::Flight(DrivenFlight::Chatter { .. }) if speed > 0.0 => Stage::Flight(launched),
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

    /// On platforms of all kinds, each ledger closes and agrees with the change of the states, and a motion
    /// resumed between two events meets the same next event.
    #[test]
    fn energy_is_balanced_on_every_platform(
        system in systems(), phase in testing::phase(), speed in 0.0..3.0_f64, spin in -2.0..2.0_f64,
        policy in testing::policy(), share in 0.01..0.99_f64,
    ) {
        let start = DrivenStart::Launch { phase, relative_speed: 0.01 + speed, angular_speed: spin };
        let mut engine = DrivenEngine::new(system.clone(), start, policy).expect("legal");
        for _ in 0..60 {
            let (before, mut twin) = (engine.clone(), engine.clone());
            let Some(record) = engine.advance().expect("no failure") else { break };
            let (start, ledger) = (before.state, record.ledger);
            prop_assert!(ledger.relative_closure() < ROUNDING, "{:e} {record:?}", ledger.relative_closure());
            let gained = |from: f64, to: f64| 0.5 * (to - from) * (to + from);
            for (entry, change, size) in [
                (ledger.axial_kinetic_change, gained(start.axial_velocity, record.after.axial_velocity), ledger.axial_magnitude),
                (ledger.potential_change, record.after.height - start.height, ledger.axial_magnitude),
                (ledger.rotary_kinetic_change, gained(start.angular_speed, record.after.angular_speed), ledger.rotary_magnitude),
            ] {
                prop_assert!((entry - change).abs() <= ROUNDING * (1.0 + size), "{entry} {change} {record:?}");
            }
            if record.event == Event::Separation {
                let twin = DrivenEngine::of_state(system.clone(), record.time, record.after, policy);
                let next = twin.expect("legal").advance().expect("no failure").expect("an event");
                prop_assert!(matches!(next.event, Event::Impact { .. }), "{next:?} after {record:?}");
            }
            let span = share * record.span.radians();
            let rest = twin.ledger_after(span);
            prop_assert!(rest.relative_closure() < ROUNDING, "{:e} {span} {before:?}", rest.relative_closure());
            if span > 1e-3 && !matches!(before.stage, Stage::Flight(DrivenFlight::Chatter { .. })) {
                let (time, state) = twin.state_after(span);
                twin = DrivenEngine::of_state(system.clone(), time, state, policy).expect("legal");
                let next = twin.advance().expect("no failure").expect("an event");
                let ends = |event| matches!(event, Event::SlipToStick | Event::SlipReversal(_));
                let same = std::mem::discriminant(&next.event) == std::mem::discriminant(&record.event);
                // A slip may end where the angular acceleration jumps: rounding decides whether before or
                // after.
                prop_assert!(same || ends(next.event) && ends(record.event), "{next:?}\n{record:?}");
                let error = (span + next.span.radians() - record.span.radians()).abs();
                // A slow impact is as uncertain as the height divided by its speed.
                let speed = match record.event {
                    Event::Impact { axial_impact_velocity, .. } => axial_impact_velocity.abs(),
                    _ => 1.0,
                };
                let bound = 1e-11 + 1e-14 * ledger.axial_magnitude / speed;
                prop_assert!(error < bound, "{error:e} {next:?}\n{record:?}");
            }
        }
    }
}

fn waveforms() -> impl Strategy<Value = Waveform> {
    prop_oneof![
        Just(Waveform::Sine),
        Just(Waveform::Triangle),
        (0.05..0.95_f64).prop_map(Waveform::Sawtooth),
        Just(Waveform::Parabolas),
        Just(Waveform::Cubics),
        proptest::collection::vec((-0.5..0.5_f64, 0.0..6.0_f64), 0..5).prop_map(Waveform::Fourier),
        proptest::collection::vec(-1.0..1.0_f64, 3..12).prop_map(Waveform::Sampled),
    ]
}

fn systems() -> impl Strategy<Value = DrivenSystem> {
    let friction = prop_oneof![1 => Just(0.0), 5 => 0.01..1.5_f64];
    let restitution = prop_oneof![1 => Just(0.0), 5 => 0.0..0.95_f64, 1 => Just(1.0 - 1e-9)];
    let load = prop_oneof![1 => Just(0.0), 2 => -0.5..0.5_f64];
    let track = |of| {
        (waveforms(), 0.0..4.0_f64, 0.0..6.0_f64)
            .prop_map(move |(shape, amplitude, lag)| shape.track(of, amplitude, lag).expect("legal"))
    };
    (track("height"), track("angle"), friction, restitution, load).prop_map(
        |(height, angle, friction, restitution, load)| DrivenSystem {
            height,
            angle,
            friction,
            restitution,
            load,
            compliance: None,
        },
    )
}

/// The comparison includes each kind of event that occurs on a sine.
#[test]
fn the_comparison_meets_every_event() {
    let mut counts = [0; 7];
    for k in 0..40_u64 {
        let spread = |j: u64| testing::golden_spread(7 * k + j);
        let system = crate::parameters::DimensionlessParameters {
            peak_acceleration: 1.05 + spread(0),
            twist_speed: 2.0 * spread(1),
            phase_lag: 6.0 * spread(2),
            friction: 0.1 + spread(3),
            restitution: 0.5 * spread(4),
            load: 0.2 * spread(5),
        };
        let phase = bouncing_disk_core::Phase::new(6.0 * spread(6)).expect("finite");
        let start = DrivenStart::Contact { phase, angular_speed: 0.3 };
        let found = compare(system.build().expect("legal"), start, ChatterPolicy::Complete, 200);
        let found = found.unwrap_or_else(|error| panic!("{k}: {error}"));
        counts.iter_mut().zip(found).for_each(|(sum, count)| *sum += count);
    }
    assert!(counts[..6].iter().all(|&count| count > 10), "{counts:?}");
}

/// A disk on a platform whose height and angle are triangle waves, of speed u and angular speed b. Derived by
/// hand: the platform leaves the disk behind at the crest, and the disk returns after 4 u with -2 u; at the
/// trough it is hit with 2 u; after the angular speed drops by 2 b it slides for 2 b/mu and loses 2 b^2.
#[test]
fn kinks_leave_hit_and_turn_as_derived_by_hand() {
    let (u, b, quarter) = (0.3, 0.2, 0.25 * std::f64::consts::TAU);
    let track = |speed: f64| Waveform::Triangle.track("height", speed * quarter, 0.0).expect("legal");
    let system = DrivenSystem {
        height: track(u),
        angle: track(b),
        friction: 0.5,
        restitution: 0.4,
        load: 0.0,
        compliance: None,
    };
    let still = DrivenSystem { height: track(0.0), ..system.clone() };
    let near = |one: f64, other: f64| (one - other).abs() < 1e-14;
    let start = |phase: f64, angular_speed| DrivenStart::Contact {
        phase: bouncing_disk_core::Phase::new(phase).expect("finite"),
        angular_speed,
    };
    let mut engine =
        DrivenEngine::new(system.clone(), start(0.0, b), ChatterPolicy::Complete).expect("legal");
    let parted = engine.advance().expect("no failure").expect("an event");
    assert!(parted.event == Event::Separation && near(parted.span.radians(), quarter), "{parted:?}");
    let mut faster = engine.clone();
    faster.perturb_launch(0.1);
    let later = faster.advance().expect("no failure").expect("an event");
    assert!(near(later.span.radians(), 4.0 * u + 0.2), "{later:?}");
    let landed = engine.advance().expect("no failure").expect("an event");
    let Event::Impact { axial_impact_velocity, .. } = landed.event else { panic!("{landed:?}") };
    assert!(near(landed.span.radians(), 4.0 * u) && near(axial_impact_velocity, -2.0 * u), "{landed:?}");

    let mut engine =
        DrivenEngine::new(system, start(2.0 * quarter, -b), ChatterPolicy::Complete).expect("legal");
    let kicked = engine.advance().expect("no failure").expect("an event");
    let Event::Kick { axial_impact_velocity, tangential_impact_velocity, capped } = kicked.event else {
        panic!("{kicked:?}")
    };
    assert!(near(axial_impact_velocity, -2.0 * u) && near(tangential_impact_velocity, -2.0 * b));
    assert!(near(kicked.axial_impulse, 2.8 * u) && near(kicked.after.axial_velocity, 1.8 * u), "{kicked:?}");
    // Friction can give 0.5 x 2.8 u = 0.42 of the 0.4 that ends the slip.
    assert!(capped && near(kicked.after.angular_speed, b) && kicked.ledger.relative_closure() < ROUNDING);

    let mut engine = DrivenEngine::new(still, start(0.0, b), ChatterPolicy::Complete).expect("legal");
    let slips = engine.advance().expect("no failure").expect("an event");
    assert!(slips.event == Event::StickToSlip(SlipDirection::Forward), "{slips:?}");
    let sticks = engine.advance().expect("no failure").expect("an event");
    assert!(sticks.event == Event::SlipToStick && near(sticks.span.radians(), 4.0 * b), "{sticks:?}");
    assert!(near(sticks.ledger.friction_loss, 2.0 * b * b), "{sticks:?}");
}

#[test]
fn bad_starts_and_states_are_refused_by_name() {
    let system = DrivenSystem::try_from(*crate::System::pizza_toss().dimensionless()).expect("legal");
    let phase = bouncing_disk_core::Phase::new(1.0).expect("finite");
    let policy = ChatterPolicy::Complete;
    let of = |(gap, relative_velocity, angular_speed)| {
        let start = DrivenStart::Flight { phase, gap, relative_velocity, angular_speed };
        DrivenEngine::new(system.clone(), start, policy)
    };
    refused("gap = -1", [(-1.0, 0.0, 0.0)], of);
    refused("relative_velocity", [(1.0, f64::NAN, 0.0)], of);
    refused("angular_speed", [(1.0, 0.0, f64::INFINITY)], of);
    let (time, state) = of((1.0, 0.0, 0.0)).expect("legal").state_after(0.1);
    let go_on = |state| DrivenEngine::of_state(system.clone(), time, state, policy);
    refused("height above the platform", [-10.0], |height| go_on(DiskState { height, ..state }));
    refused("height", [f64::NAN], |height| go_on(DiskState { height, ..state }));
    refused("angle", [f64::INFINITY], |angle| go_on(DiskState { angle, ..state }));
}

/// The search for the last period of such a slip once ran among numbers so large that doubles skip whole
/// numbers.
#[test]
fn a_slip_that_friction_hardly_ends_is_too_long() {
    let system = DrivenSystem {
        height: Drive::fourier(&[(0.5, 0.0)]).expect("legal"),
        angle: Drive::fourier(&[(0.1, 0.0)]).expect("legal"),
        friction: 0.3,
        restitution: 0.5,
        load: -0.299_999_999_999_999_93,
        compliance: None,
    };
    let start = DrivenStart::Contact {
        phase: bouncing_disk_core::Phase::new(0.0).expect("finite"),
        angular_speed: 10.0,
    };
    let mut engine = DrivenEngine::new(system, start, ChatterPolicy::Complete).expect("legal");
    assert!(matches!(engine.advance(), Err(Error::SlipTooLong { .. })));
    assert!(matches!(engine.advance(), Ok(None)));
}

/// An engine for a disk in flight at the lowest point of a platform without a twist, at zero distance and with
/// this relative velocity; and the platform's velocity there.
fn flying_at_the_platform(height: Drive, relative: f64) -> (DrivenEngine, f64) {
    let system = DrivenSystem {
        angle: Drive::fourier(&[]).expect("legal"),
        height,
        friction: 0.3,
        restitution: 0.5,
        load: 0.0,
        compliance: None,
    };
    let phase = phase_at(1.5 * std::f64::consts::PI);
    let at = system.height.at(phase.angle());
    let state = DiskState {
        mode: Mode::Flight,
        height: at.height,
        axial_velocity: at.velocity + relative,
        angle: 0.0,
        angular_speed: 0.0,
    };
    let time = PhaseTime::in_first_period(phase);
    let engine = DrivenEngine::of_state(system, time, state, ChatterPolicy::Complete).expect("legal");
    (engine, at.velocity)
}

/// A disk that moves with a platform pressing against it is in contact, even if its state says flight.
#[test]
fn a_state_of_flight_at_the_platform_is_one_of_contact() {
    for height in [Waveform::Parabolas, Waveform::Sine] {
        let height = height.track("height", 1.5, 0.0).expect("legal");
        let (mut engine, _) = flying_at_the_platform(height, 0.0);
        assert_eq!(engine.state().mode, Mode::Sticking);
        let next = engine.advance().expect("no failure").expect("leaves");
        assert!(next.event == Event::Separation && next.span.radians() > 0.1, "{next:?}");
        // Invalid spans count as zero, and too long ones are limited.
        for span in [f64::NAN, -1.0, f64::INFINITY] {
            assert!(engine.state_after(span).1.height.is_finite());
        }
    }
}

/// If the platform's velocity changes under a disk from one engine to the next, the disk is hit or left behind
/// at once.
#[test]
fn a_state_that_moves_against_the_platform_is_hit_or_leaves() {
    let next = |relative| {
        let height = Drive::fourier(&[(1.5, 0.0)]).expect("legal");
        let (mut engine, platform) = flying_at_the_platform(height, relative);
        let next = engine.advance().expect("no failure").expect("an impact");
        let Event::Impact { axial_impact_velocity, .. } = next.event else { panic!("{next:?}") };
        (axial_impact_velocity, next.span.radians(), next.after.axial_velocity - platform)
    };
    let (impact, span, rebound) = next(-0.25);
    assert!((impact + 0.25).abs() < 1e-15 && span <= 0.0, "{impact} {span}");
    assert!((rebound - 0.125).abs() < 1e-15, "{rebound}");
    // A disk that leaves falls back about 2 v/(1 + s'') later.
    let (impact, span, _) = next(0.25);
    assert!(span > 0.1 && impact < -0.1, "{impact} {span}");
}
