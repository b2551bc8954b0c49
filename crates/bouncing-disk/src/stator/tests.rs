//! The engine of a compliant stator.

use std::f64::consts::TAU;

use bouncing_disk_core::Phase;
use bouncing_disk_core::numerics::random::SplitMix64;

use super::*;
use crate::Engine;
use crate::driven::DrivenStart;
use crate::motion::event::{Event, SteeredMotion};
use crate::parameters::dimensionless::DimensionlessParameters;

fn base(peak: f64, twist: f64, lag: f64, friction: f64, restitution: f64, load: f64) -> DimensionlessSystem {
    let parameters = DimensionlessParameters {
        peak_acceleration: peak,
        twist_speed: twist,
        phase_lag: lag,
        friction,
        restitution,
        load,
    };
    parameters.build().expect("legal")
}

fn start(phase: f64) -> DrivenStart {
    DrivenStart::Contact { phase: Phase::new(phase).expect("finite"), angular_speed: 0.0 }
}

/// The three stators, with masses around the disk's.
fn stators(random: &mut SplitMix64) -> Vec<Vec<YieldingMode>> {
    let mut between = |low: f64, high: f64| low + (high - low) * random.unit();
    let (mass, frequency, quality) = (between(0.2, 20.0), between(0.5, 2.0), between(0.5, 100.0));
    vec![
        vec![YieldingMode::axial(mass, frequency, quality)],
        vec![YieldingMode { angle: between(-2.0, 2.0), ..YieldingMode::axial(mass, 1.0, quality) }],
        vec![
            YieldingMode::axial(mass, frequency, quality),
            YieldingMode::torsional(between(0.2, 20.0), between(0.5, 2.0), between(0.5, 100.0)),
        ],
    ]
}

#[test]
fn energy_is_balanced_in_every_event() {
    let mut random = SplitMix64::new(7);
    for trial in 0..60 {
        let mut between = |low: f64, high: f64| low + (high - low) * random.unit();
        let peak = [1.5, 5.0, 40.0][trial % 3] * between(0.7, 1.3);
        let base = base(
            peak,
            peak * between(0.0, 2.0),
            between(-3.0, 3.0),
            between(0.05, 0.5),
            between(0.0, 0.9),
            between(-0.02, 0.02),
        );
        for modes in stators(&mut random) {
            for contact_time in [None, Some(0.7), Some(5.0)] {
                let arm = 0.5 + random.unit();
                let Ok(system) = StatorSystem::build(&base, &modes, arm, contact_time) else { continue };
                let mut engine = StatorEngine::new(system, start(TAU * random.unit())).expect("legal");
                let mut events = 0;
                for _ in 0..300 {
                    let Some(record) = engine.advance().expect("no failure") else { break };
                    events += 1;
                    assert!(
                        record.relative_closure() < 1e-12,
                        "{trial} {contact_time:?} {modes:?} {base:?} {record:#?}"
                    );
                }
                assert!(events > 0 || engine.lies_for_ever(), "{trial} {contact_time:?}");
            }
        }
    }
}

/// Compares each event with the one that the engine on a rigid stator finds from the same state.
#[test]
fn an_infinite_mass_gives_the_events_of_the_engine() {
    for (peak, twist, lag) in [(1.2, 3.0, 0.4), (4.0, 2.0, -1.0), (30.0, 50.0, 0.0), (197.0, 4e3, 0.2)] {
        let base = base(peak, twist, lag, 0.1, 0.5, 0.01);
        for modes in [
            vec![],
            vec![YieldingMode::axial(1e13, 1.0, 300.0)],
            vec![YieldingMode::axial(1e20, 0.7, 5.0), YieldingMode::torsional(1e20, 1.1, 40.0)],
        ] {
            let system = StatorSystem::new(&base, &modes).expect("legal");
            let mut events = 0;
            for record in Engine::new(base, start(0.3), bouncing_disk_core::ChatterPolicy::Complete)
                .expect("legal")
                .take(400)
            {
                let record = record.expect("no failure");
                let segment = record.segment;
                if segment.chatter_speed.is_some() {
                    continue;
                }
                let time = segment.start;
                let (sin, cos) = (time.phase.sin(), time.phase.cos());
                let modes = std::array::from_fn(|index| system.steady(index, (sin, cos)));
                let from = StatorState { disk: segment.state, modes };
                let mut engine = StatorEngine::of_state(system.clone(), time, from).expect("legal");
                let own = engine.advance().expect("no failure").expect("an event");
                let size = record.span.radians();
                assert!(
                    (own.span.radians() - size).abs() <= 1e-12 * size.max(1.0),
                    "{peak} {modes:?} {own:#?} {record:#?}"
                );
                let same = std::mem::discriminant(&own.event) == std::mem::discriminant(&record.event);
                let rests = matches!(own.event, Event::Attachment { .. });
                assert!(same || rests, "{own:#?} {record:#?}");
                if !rests {
                    let scale = peak + size;
                    assert!(
                        (own.after.disk.axial_velocity - record.after.axial_velocity).abs() <= 1e-12 * scale,
                        "{own:#?} {record:#?}"
                    );
                    assert!(
                        (own.after.disk.angular_speed - record.after.angular_speed).abs()
                            <= 1e-12 * (twist + scale),
                        "{own:#?} {record:#?}"
                    );
                }
                events += 1;
            }
            assert!(events > 20, "{events}");
        }
    }
}

/// m g sqrt(1 + (M/(m Q))^2) < F_0 = M omega^2 A_0/Q: for a disk in steady contact with a stator driven at
/// its free resonance the force then falls to zero.
#[test]
fn a_disk_at_rest_lifts_off_at_the_exact_preload() {
    for (mass, quality) in [(0.3, 50.0), (10.0, 300.0), (300.0, 300.0), (2000.0, 20.0)] {
        let ratio: f64 = mass / quality;
        let peak = (1.0 + ratio * ratio).sqrt() / ratio;
        for (factor, lifts) in [(1.0 - 1e-9, false), (1.0 + 1e-9, true)] {
            let base = base(peak * factor, 0.0, 0.0, 0.0, 0.5, 0.0);
            let system = StatorSystem::new(&base, &[YieldingMode::axial(mass, 1.0, quality)]).expect("legal");
            // The steady motion in contact: (M + m) q'' + d M q' + M q = F - m.
            let force = (peak * factor) * ratio;
            let (re, im) = (mass - (mass + 1.0), ratio);
            let size = re * re + im * im;
            // F cos tau is the force at resonance, where the steady motion without a disk is sin tau.
            let (cosine, sine) = (force * re / size, force * im / size);
            let disk = crate::motion::state::DiskState {
                mode: crate::motion::state::Mode::Sticking,
                height: 0.0,
                axial_velocity: 0.0,
                angle: 0.0,
                angular_speed: 0.0,
            };
            let from = StatorState { disk, modes: [[cosine - 1.0 / mass, sine], [0.0; 2]] };
            let time =
                crate::motion::phase_time::PhaseTime::in_first_period(Phase::new(0.0).expect("finite"));
            let mut engine = StatorEngine::of_state(system, time, from).expect("legal");
            let next = engine.advance().expect("no failure");
            assert_eq!(next.is_some(), lifts, "{mass} {quality} {factor} {next:?}");
        }
    }
}

/// A load with a fan's law: the speed of a free disk has a closed form on each piece, and energy is balanced
/// across nodes and switches of the drive.
#[test]
fn a_load_of_lines_brakes_as_exponentials_and_balances_its_energy() {
    let base = base(5.0, 20.0, 0.2, 0.2, 0.5, 0.0);
    let lines = [
        LoadLine { from: f64::NEG_INFINITY, to: 1.0, torque: 0.0, slope: 0.01 },
        LoadLine { from: 1.0, to: 4.0, torque: -0.03, slope: 0.04 },
        LoadLine { from: 4.0, to: f64::INFINITY, torque: 0.13, slope: 0.0 },
    ];
    let mode = YieldingMode::axial(3.0, 1.0, 30.0);
    for (modes, contact_time) in [(vec![], None), (vec![mode], None), (vec![mode], Some(1.0))] {
        let own = StatorSystem::build(&base, &modes, 0.7, contact_time).expect("legal");
        let loaded = own.clone().with_load(&lines).expect("legal");
        let start = DrivenStart::Flight {
            phase: Phase::new(1.0).expect("finite"),
            gap: 1e4,
            relative_velocity: 0.0,
            angular_speed: 5.0,
        };
        let mut engine = StatorEngine::new(loaded.clone(), start).expect("legal");
        let (mut lines, mut events) = (Vec::new(), 0);
        while events < 400 {
            let Some(record) = engine.advance().expect("no failure") else { break };
            assert!(record.relative_closure() < 1e-12, "{record:#?}");
            events += 1;
            if record.event == Event::Joint {
                let [before, after] = [record.before, record.after].map(|state| state.disk.angular_speed);
                assert!((before - after).abs() < 1e-12, "{record:#?}");
                lines.push((record.span.radians(), record.after.disk.angular_speed));
            }
            if events % 50 == 0 {
                // The drive is switched, or switched off.
                let still =
                    DimensionlessParameters { peak_acceleration: 0.0, twist_speed: 0.0, ..base.parameters() };
                let next = if events % 100 == 0 {
                    loaded.clone()
                } else {
                    own.with_base(&still.build().expect("legal")).expect("legal")
                };
                if !modes.is_empty() {
                    let record = engine.switch(0.0, next);
                    assert!(record.relative_closure() < 1e-12, "{record:#?}");
                }
            }
        }
        // From 5 to 4 at 0.13, and from 4 to 1 as exp(-0.04 t) from 3.25 above 0.75.
        let [first, second, ..] = lines[..] else { panic!("{lines:?}") };
        assert!((first.0 - 1.0 / 0.13).abs() < 1e-13 * first.0 && (first.1 - 4.0).abs() < 1e-13);
        let time = -25.0 * bouncing_disk_core::numerics::elementary::ln(0.25 / 3.25);
        assert!(
            (second.0 - time).abs() < 1e-12 * time && (second.1 - 1.0).abs() < 1e-13,
            "{second:?} {time}"
        );
    }
}

/// Ringing after the drive is switched off, and the rise from rest after it is switched on, follow the closed
/// form of a circuit.
#[test]
fn a_stator_rings_down_and_up_as_its_circuit() {
    use bouncing_disk_core::numerics::elementary::exp;
    let (base, quality) = (base(5.0, 0.0, 0.0, 0.0, 0.5, 0.0), 40.0);
    let system = StatorSystem::new(&base, &[YieldingMode::axial(2.0, 1.0, quality)]).expect("legal");
    let start = DrivenStart::Flight {
        phase: Phase::new(0.0).expect("finite"),
        gap: 1e7,
        relative_velocity: 0.0,
        angular_speed: 0.0,
    };
    let mut engine = StatorEngine::new(system.clone(), start).expect("legal");
    let still =
        DimensionlessParameters { peak_acceleration: 0.0, ..base.parameters() }.build().expect("legal");
    engine.switch(TAU, system.with_base(&still).expect("legal"));
    let (decay, time) = (0.5 / quality, 20.0 * TAU);
    let frequency = (1.0 - decay * decay).sqrt();
    let (sin, cos) = sin_cos(frequency * time);
    // From q = 0, q' = 5.
    let speed = 5.0 * exp(-decay * time) * (cos - decay / frequency * sin);
    assert!((engine.state_after(time).1.modes[0][1] - speed).abs() < 1e-12);
    engine.switch(time, system);
    let [place, speed] = engine.state_after(400.0 * TAU).1.modes[0];
    assert!(place.abs() < 1e-9 && (speed - 5.0).abs() < 1e-9, "{place} {speed}");
}

/// Near the turning point of a mode with much energy little moves: ledgers and gaps of short flights keep
/// their digits.
#[test]
fn short_flights_keep_their_digits() {
    let base = base(3.0, 0.5, 3.0, 0.001, 0.5, 0.001);
    let system = StatorSystem::new(&base, &[YieldingMode::axial(1e6, 1e-3, 3.0)]).expect("legal");
    for (phase, span) in [(4.7027, 2.6e-7), (4.7123889, 1e-9), (1.5709, 1e-5), (4.7, 0.3)] {
        let start = DrivenStart::Flight {
            phase: Phase::new(phase).expect("finite"),
            gap: 1e-3,
            relative_velocity: 0.0,
            angular_speed: 0.1,
        };
        let mut engine = StatorEngine::new(system.clone(), start).expect("legal");
        let ledger = engine.ledgers_after(span).1;
        assert!(ledger.closure().abs() < 1e-14 * ledger.magnitude, "{phase} {span} {ledger:?}");
        engine.state[regime::DISPLACEMENTS[0]] = -1e4;
        let change = engine.carried(span)[regime::GAP] - engine.state[regime::GAP];
        let falls = change - engine.state[regime::CLOSING] * span;
        assert!(falls.abs() < 5.0 * span * span + 1e-18, "{phase} {span} {change} {falls}");
    }
}

/// At P = 1 exactly the force touches zero at the crest, with a rounded phase: an apparent flight of 1e-10 rad
/// must not occur. At P = 1 + 1e-11 a flight of 1.8e-5 rad ends at the right time.
#[test]
fn a_release_at_the_crest_ends_at_once() {
    let disk = |mode: crate::motion::state::Mode| crate::motion::state::DiskState {
        mode,
        height: 1.0,
        axial_velocity: 0.0,
        angle: 0.0,
        angular_speed: 1e-10,
    };
    for (beyond, before, leaves) in [(0.0, 1.5e-10, false), (1e-11, 1e-3, true)] {
        let base = base(1.0 + beyond, 0.5, 0.0, 0.9, 0.001, 0.0);
        let system = StatorSystem::new(&base, &[]).expect("legal");
        let phase = Phase::new(0.25 * TAU - before).expect("finite");
        let time = crate::motion::phase_time::PhaseTime::in_first_period(phase);
        let from = StatorState { disk: disk(crate::motion::state::Mode::Sticking), modes: [[0.0; 2]; 2] };
        let mut engine = StatorEngine::of_state(system, time, from).expect("legal");
        let mut left = 0;
        for _ in 0..6 {
            let launched = engine.launches();
            left += usize::from(launched);
            let Some(record) = engine.advance_within(1.0).expect("no failure") else { break };
            assert!(record.relative_closure() < 1e-12, "{record:#?}");
            assert!(!launched || record.span.radians() < 2e-5, "{record:#?}");
        }
        assert_eq!(left > 0, leaves, "{before}");
    }
}

/// Tests systems at the limits and in between. Between two events the gap stays open, the contact stays
/// pressed, the slip keeps its direction and the grip stays within friction, so no event is missed.
fn attack_seams(count: usize, events: usize) -> usize {
    let mut random = SplitMix64::new(11);
    let mut done = 0;
    let pick = |random: &mut SplitMix64, of: &[f64]| of[(random.unit() * of.len() as f64) as usize];
    for trial in 0..count {
        let peak = pick(&mut random, &[0.3, 1.0, 1.0 + 1e-9, 1.2, 3.0, 30.0, 2000.0]);
        let base = base(
            peak,
            pick(&mut random, &[0.0, 1e-9, 0.5, 20.0, 1e4]),
            pick(&mut random, &[0.0, -1.5, 3.0]),
            pick(&mut random, &[0.0, 1e-3, 0.1, 0.9]),
            pick(&mut random, &[0.0, 1e-3, 0.5, 0.9, 0.999]),
            pick(&mut random, &[0.0, 1e-3, -0.1]),
        );
        let mass = pick(&mut random, &[1e-3, 0.3, 10.0, 1e6]);
        let frequency = pick(&mut random, &[1e-3, 0.5, 1.0 - 1e-9, 1.0, 1.01, 7.0]);
        let quality = pick(&mut random, &[0.5, 0.5 + 1e-9, 3.0, 300.0]);
        let axial = YieldingMode::axial(mass, frequency, quality);
        let torsional = YieldingMode::torsional(pick(&mut random, &[1e-2, 1.0, 1e3]), frequency, quality);
        let twisting = YieldingMode { angle: pick(&mut random, &[-3.0, 0.1, 1.0]), ..axial };
        let modes =
            [vec![], vec![axial], vec![twisting], vec![axial, torsional], vec![torsional]][trial % 5].clone();
        let contact_time = [None, None, Some(0.05), Some(1.0), Some(20.0)][(trial / 5) % 5];
        let Ok(system) = StatorSystem::build(&base, &modes, 0.5, contact_time) else { continue };
        let phase = pick(&mut random, &[0.0, TAU - 1e-15, 0.3, 1.57, 4.7]);
        let mut engine = StatorEngine::new(system.clone(), start(phase)).expect("legal");
        engine.bounds_closely = trial % 2 == 0;
        let mut zero = 0;
        for _ in 0..events {
            let before = engine.clone();
            let Some(record) = engine.advance_within(300.0).unwrap_or_else(|error| {
                panic!("{trial} {error} {:?} {:?} {:?}", before.stage, before.state, system.base.parameters())
            }) else {
                break;
            };
            done += 1;
            let span = record.span.radians();
            let mut windowed = before.clone();
            for share in [0.2, 0.9, 0.95].into_iter().filter(|_| span > 0.0) {
                assert_eq!(windowed.advance_within(share * span).expect("no failure"), None, "{before:?}");
            }
            let same = windowed.advance_within(300.0).expect("no failure");
            assert_eq!(same, Some(record), "{trial} {before:?}");
            zero = if span > 0.0 { 0 } else { zero + 1 };
            assert!(
                zero < 20,
                "an endless loop: {trial} {record:#?} {:?} {:?} {:?}",
                before.stage,
                before.state,
                system.base.parameters()
            );
            let (disk, modes) = (&record.ledger, &record.stator);
            // A stiff contact of long duration is followed in many steps, each of which is rounded.
            let allowed = 1e-12 + 4.0 * f64::EPSILON * span / before.regime().flow.step();
            let axial = (disk.axial_closure().abs(), disk.axial_magnitude);
            let rotary = (disk.rotary_closure().abs(), disk.rotary_magnitude);
            // The force on a mode may be a small difference of forces or torques on the disk: it is judged
            // relative to these, in the units of axial energy.
            let left = axial.0 + 0.5 * rotary.0 + modes.closure().abs();
            let size = axial.1 + 0.5 * rotary.1 + modes.magnitude;
            assert!(
                axial.0 <= allowed * axial.1 && rotary.0 <= allowed * rotary.1 && left <= allowed * size,
                "{trial} {record:#?} {:?} {:?}",
                before.stage,
                before.state
            );
            for k in 1..40 {
                let state = before.carried(span * f64::from(k) / 40.0);
                before.check_within(&state, span);
            }
        }
    }
    done
}

#[test]
fn no_event_is_missed_on_seams() {
    assert!(attack_seams(250, 60) > 2_000);
}

/// A million events, which take some minutes.
#[test]
#[ignore = "takes minutes"]
fn no_event_is_missed_in_a_million() {
    assert!(attack_seams(6_000, 400) > 1_000_000);
}

impl StatorEngine {
    /// Checks that no event has happened yet in this state of the present motion.
    fn check_within(&self, state: &State, span: f64) {
        use crate::motion::engine::Stage;
        use linear_flow::size;
        let regime = self.regime();
        let tolerance = 1e-10 * (1.0 + span);
        let holds = |functional: &linear_flow::Functional<{ regime::N }>, what: &str| {
            let value = linear_flow::dot(functional.now(), state);
            let size = size(functional.now(), state).max(1.0);
            assert!(
                value >= -tolerance * size,
                "{what}: {value} {size} {state:?} {:?} {:?} {:?} {:?}",
                self.stage,
                self.state,
                self.system.base.parameters(),
                self.system.given
            );
        };
        match self.stage {
            Stage::Flight(_)
                if self.system.contact == ContactStiffness::Rigid || state[regime::GAP] > 0.0 =>
            {
                let [tip, _] = self.system.tip(state);
                let size = self.bounds(&self.state).height + tip.abs() + span * span;
                assert!(
                    state[regime::GAP] >= -1e-13 * size,
                    "{state:?} {:?} {:?} {:?} {:?}",
                    self.stage,
                    self.state,
                    self.system.base.parameters(),
                    self.system.given
                );
            }
            Stage::Flight(_) => {
                let value = -linear_flow::dot(regime.force.now(), state);
                assert!(
                    value >= -tolerance * size(regime.force.now(), state).max(1.0),
                    "{state:?} {:?} {:?} {:?} {:?}",
                    self.stage,
                    self.state,
                    self.system.base.parameters(),
                    self.system.given
                );
            }
            Stage::Lying(lying) => {
                holds(&regime.force, "force");
                if self.system.base.friction() > 0.0 {
                    if lying.slip.is_none() {
                        holds(&regime.hold[0], "hold");
                        holds(&regime.hold[1], "hold");
                    } else {
                        holds(&regime.slip, "slip");
                    }
                }
            }
            Stage::Ended => {}
        }
    }
}

/// A motion that is stored at any time, or paused, continues to the same next event.
#[test]
fn a_stored_motion_goes_on() {
    let mut random = SplitMix64::new(23);
    let base = base(4.0, 6.0, 0.4, 0.15, 0.6, 0.01);
    for modes in stators(&mut random) {
        for contact_time in [None, Some(0.9), Some(6.0)] {
            let Ok(system) = StatorSystem::build(&base, &modes, 0.8, contact_time) else { continue };
            let mut engine = StatorEngine::new(system.clone(), start(1.0)).expect("legal");
            for _ in 0..200 {
                let before = engine.clone();
                let Some(next) = engine.advance().expect("no failure") else { break };
                let span = next.span.radians();
                if span < 1e-3 {
                    // In so low a flight the difference of two heights has lost its digits.
                    continue;
                }
                let part = random.unit() * span;
                let (time, state) = before.state_after(part);
                let mut paused = before.clone();
                paused.pause(part);
                let mut stored = StatorEngine::of_state(system.clone(), time, state).expect("legal");
                for resumed in [&mut paused, &mut stored] {
                    let own = resumed.advance().expect("no failure").expect("an event");
                    let near = |own: f64, known: f64| (own - known).abs() < 1e-9 * (1.0 + span);
                    let same = std::mem::discriminant(&own.event) == std::mem::discriminant(&next.event);
                    assert!(
                        same && near(part + own.span.radians(), span),
                        "{part} {own:#?} {next:#?} {before:?}"
                    );
                    assert!(
                        near(own.after.disk.axial_velocity, next.after.disk.axial_velocity),
                        "{part} {span} {own:#?} {next:#?} {:?} {contact_time:?} {modes:?}",
                        before.state
                    );
                    assert!(near(own.after.disk.angular_speed, next.after.disk.angular_speed));
                }
            }
        }
    }
}

/// A fan has a node at rest: the motion of a rotor that rests there, on a still stator or after a slip,
/// continues.
#[test]
fn a_load_with_a_node_at_rest_does_not_stop_the_time() {
    let base = base(3.0, 5.0, 0.3, 0.2, 0.5, 0.0);
    let still = DimensionlessParameters { peak_acceleration: 0.0, twist_speed: 0.0, ..base.parameters() };
    let still = still.build().expect("legal");
    let lines = [
        LoadLine { from: f64::NEG_INFINITY, to: 0.0, torque: 0.0, slope: -0.01 },
        LoadLine { from: 0.0, to: f64::INFINITY, torque: 0.0, slope: 0.01 },
    ];
    for modes in [vec![], vec![YieldingMode::axial(3.0, 1.0, 30.0)]] {
        let system =
            StatorSystem::new(&base, &modes).and_then(|system| system.with_load(&lines)).expect("legal");
        let rest = system.with_base(&still).expect("legal");
        for (from, to) in [(&rest, &system), (&system, &rest)] {
            let mut engine = StatorEngine::new(from.clone(), start(0.3)).expect("legal");
            let run = |engine: &mut StatorEngine, until: f64| {
                let begun = engine.time();
                for _ in 0..3_000 {
                    let left = until - engine.time().since(&begun).radians();
                    if engine.advance_within(left).expect("no failure").is_none() {
                        engine.pause(left);
                        return;
                    }
                }
                panic!("time stands still: {engine:?}");
            };
            run(&mut engine, 300.0);
            engine.switch(0.0, to.clone());
            run(&mut engine, 300.0);
        }
    }
}
