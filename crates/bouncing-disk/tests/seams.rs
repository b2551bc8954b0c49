//! Motions of disk and platform from starts and parameters that land on seams: time, speeds and energy must
//! tell the same story.
//!
//! The energy balance alone does not see a clock that is wrong, so the duration of every flight is taken from
//! the velocities at its ends: a disk in free flight loses one unit of axial speed a radian. The load's work
//! must be that of this time.
//!
//! The campaign takes a minute on two cores. It followed 6,000,000 motions through 211,764,663 events and found
//! no fault; 44,172 motions ended because a flight or a slip exceeded the longest that the engine follows.
#![allow(unreachable_pub, reason = "the modules of a test have no public interface")]
#![allow(dead_code, reason = "the generators are shared with the tests of the math core")]
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

#[path = "../../bouncing-disk-core/tests/first_impact/launches.rs"]
mod launches;
#[path = "../../bouncing-disk-core/tests/first_impact/seams.rs"]
mod seams;
#[path = "../../bouncing-disk-core/tests/first_impact/shards.rs"]
mod shards;

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use bouncing_disk::core::{ChatterPolicy, Error as CoreError, Phase, Unobserved};
use bouncing_disk::motion::Mode;
use bouncing_disk::motor::{TransientMember, TransientSettings, transient, transients};
use bouncing_disk::parameters::{DimensionlessParameters, DimensionlessSystem};
use bouncing_disk::{
    DiskParameters, Engine, Error, Event, EventRecord, InitialCondition, PlatformParameters, System,
};

use launches::SplitMix;
use seams::{angle, nearby, one_of, peak};
use shards::Kind;

/// Bound on the closure of the energy balance, relative to what was added up (docs/numerics-impacts.md,
/// "Energy").
const CLOSURE: f64 = 1.0e-13;

/// Bound on how far two carried pairs are off their angles: 8e-13 rad are measured after 1e7 short flights
/// (see `Phase`).
const LARGEST_PARTING: f64 = 2.0e-12;

/// Bound on what the rounding of two phases and four speeds leaves between two durations, relative to those.
const CLOCK: f64 = 4.0e-14;

fn system(random: &mut SplitMix) -> DimensionlessSystem {
    let restitution = one_of(random, &seams::RESTITUTIONS);
    let friction = match random.next() % 4 {
        0 => 0.0,
        1 => one_of(random, &[1.0, 0.5, 0.1]),
        2 => random.decades(-6.0, 3.0),
        _ => random.unit(),
    };
    let exact = match random.next() % 5 {
        0 => 0.0,
        1 => one_of(random, &[1.0, 0.5, PI]),
        // Where friction just holds a disk on a still platform.
        2 => friction,
        3 => random.decades(-12.0, 6.0),
        _ => 3.0 * random.unit(),
    };
    let twist_speed = nearby(random, exact).max(0.0);
    let lag = one_of(random, &[0.0, 0.0, PI, -PI, FRAC_PI_2, -FRAC_PI_2, 0.25 * PI, -0.26 * PI, 3.0]);
    let load = match random.next() % 6 {
        0 | 1 => 0.0,
        // What friction can just carry.
        2 => random.sign() * friction,
        3 => random.sign() * random.decades(-12.0, 2.0),
        _ => friction * random.uniform(-1.0, 1.0),
    };
    DimensionlessParameters {
        peak_acceleration: peak(random, 1.0e4),
        twist_speed,
        phase_lag: nearby(random, lag),
        friction,
        restitution,
        load: nearby(random, load),
    }
    .build()
    .unwrap()
}

fn start(random: &mut SplitMix, system: &DimensionlessSystem) -> InitialCondition {
    let peak = system.peak_acceleration();
    let phase = Phase::new(angle(random, peak)).unwrap();
    let angular_speed = match random.next() % 4 {
        0 => 0.0,
        1 => nearby(random, system.platform_angular_speed(phase)),
        2 => random.uniform(-2.0, 2.0) * (system.twist_speed() + 1.0),
        _ => random.sign() * random.decades(-9.0, 3.0),
    };
    match random.next() % 3 {
        0 => InitialCondition::Contact { phase, angular_speed },
        1 => {
            let case = seams::launch(random, 1.0e4, 400.0);
            let relative_speed = case.speed.min(100.0 * (1.0 + peak));
            InitialCondition::Launch { phase, relative_speed, angular_speed }
        }
        _ => {
            let (case, gap) = seams::drop(random, 1.0e4);
            InitialCondition::Flight {
                phase,
                gap: gap.min(1.0e8),
                relative_velocity: case.speed.clamp(-1e6, 1e6),
                angular_speed,
            }
        }
    }
}

/// How far (rad) a carried sine and cosine are off the angle.
fn parting(phase: Phase) -> f64 {
    let (sin, cos) = libm::sincos(phase.angle());
    (phase.sin() * cos - phase.cos() * sin).abs()
}

/// What the record of one event contradicts, if anything.
fn contradiction(system: &DimensionlessSystem, record: &EventRecord) -> Option<String> {
    let ledger = &record.ledger;
    // A height is that of a phase, whose rounding may exceed that of small energies.
    // The phase of separation, asin(1/P), is known to the rounding of 1/P over its cosine.
    let peak = system.peak_acceleration();
    let separation = if peak > 1.0 { peak / ((peak - 1.0) * (peak + 1.0)).sqrt() } else { 0.0 };
    let platform = peak * f64::EPSILON * (TAU + separation);
    // Energies of the platform follow from the carried pairs, its time from the angles.
    let parted = parting(record.segment.start.phase) + parting(record.time.phase);
    if parted > LARGEST_PARTING {
        return Some(format!("a carried pair is {parted:e} off its angle"));
    }
    let fastest = record.segment.state.axial_velocity.abs().max(record.before.axial_velocity.abs());
    let carried = parted * peak * (1.0 + fastest);
    // A speed is what friction and load leave of each other, known to the rounding of what each of them could
    // do.
    let pulls = system.friction() * (1.0 + system.peak_acceleration()) + system.load().abs();
    let speeds = pulls * record.span.radians()
        + record.segment.state.angular_speed.abs()
        + record.before.angular_speed.abs()
        + system.twist_speed();
    let spin = 16.0 * f64::EPSILON * speeds * speeds;
    let (axial, rotary) = (ledger.axial_closure().abs(), ledger.rotary_closure().abs());
    if !(axial <= CLOSURE * ledger.axial_magnitude + 2.0 * platform + carried + f64::MIN_POSITIVE
        && rotary <= CLOSURE * ledger.rotary_magnitude + spin + f64::MIN_POSITIVE)
    {
        return Some(format!("the energy balance leaves {axial:e} and {rotary:e}"));
    }
    let span = record.span.radians();
    let by_times = record.time.since(&record.segment.start).radians();
    let rounding = CLOCK * (1.0 + span);
    if (by_times - span).abs() > rounding {
        return Some(format!("{by_times:e} rad by the times, {span:e} by the span"));
    }
    let flew = record.segment.state.mode == Mode::Flight && record.segment.chatter_speed.is_none();
    if !(flew && matches!(record.event, Event::Impact { .. })) {
        return None;
    }
    let (left, landed) = (record.segment.state, record.before);
    let lost = left.axial_velocity - landed.axial_velocity;
    // How well the velocities tell the time.
    let doubt = CLOCK * (1.0 + span + left.axial_velocity.abs() + system.peak_acceleration());
    if (lost - span).abs() > doubt {
        return Some(format!("a flight of {span:e} rad loses {lost:e} of its speed"));
    }
    let load = system.load();
    let spin = left.angular_speed.abs() + landed.angular_speed.abs();
    let slowed = left.angular_speed - landed.angular_speed;
    // Subnormal numbers have fewer digits.
    let digits = 4.0 * f64::from_bits(1);
    if (slowed - load * lost).abs() > load.abs() * doubt + CLOCK * spin + digits {
        return Some(format!("the load slows by {slowed:e} in a time for {:e}", load * lost));
    }
    let turned = lost * 0.5 * (left.angular_speed + landed.angular_speed);
    let work = record.ledger.load_work;
    let sizes = load.abs() * spin * (doubt + CLOCK * lost);
    ((work - load * turned).abs() > sizes)
        .then(|| format!("the load's work is {work:e}, not {:e}", load * turned))
}

/// What an attack has seen.
#[derive(Debug, Default)]
struct Tally {
    motions: u64,
    events: u64,
    /// Motions that end because a flight or a slip would be longer than the engine follows.
    refused: u64,
    failures: Vec<String>,
}

/// Events of motions that start on seams.
fn attack(seed: u64, motions: u64, events: usize) -> Tally {
    let mut random = SplitMix::new(seed);
    let mut tally = Tally { motions, ..Tally::default() };
    for motion in 0..motions {
        let system = system(&mut random);
        let start = start(&mut random, &system);
        let policy = one_of(
            &mut random,
            &[ChatterPolicy::Complete, ChatterPolicy::Complete, bouncing_disk::motion::PAPER_CHATTER],
        );
        let told =
            |what: String| format!("seed {seed}, motion {motion}: {system:?} {start:?} {policy:?}: {what}");
        let mut engine = match Engine::new(system, start, policy) {
            Ok(engine) => engine,
            Err(Error::Core(CoreError::NoLiftOff { .. } | CoreError::FlightTooLong { .. })) => {
                tally.refused += 1;
                continue;
            }
            Err(error) => {
                tally.failures.push(told(error.to_string()));
                continue;
            }
        };
        for _ in 0..events {
            match engine.advance() {
                Ok(Some(record)) => {
                    tally.events += 1;
                    if let Some(what) = contradiction(&system, &record) {
                        tally.failures.push(told(format!("{what}: {record:?}")));
                        break;
                    }
                }
                Ok(None) => break,
                Err(
                    Error::SlipTooLong { .. }
                    | Error::Core(CoreError::FlightTooLong { .. } | CoreError::NoLiftOff { .. }),
                ) => {
                    tally.refused += 1;
                    break;
                }
                Err(error) => {
                    tally.failures.push(told(error.to_string()));
                    break;
                }
            }
        }
    }
    tally
}

#[test]
fn motions_from_seams_keep_time_and_energy() {
    let tally = attack(201, 60_000, 40);
    assert!(tally.failures.is_empty(), "{} failed, the first: {}", tally.failures.len(), tally.failures[0]);
    assert!(tally.events > 1_000_000, "{tally:?}");
}

/// The engine's part of the campaign of docs/numerics-impacts.md, "The attack on seams".
///
/// `cargo test --release -p bouncing-disk --test seams -- --ignored campaign --nocapture`
#[test]
#[ignore = "takes minutes"]
fn campaign() {
    shards::run(&[Kind {
        name: "engine",
        shards: 100,
        run: |seed| {
            let Tally { motions, events, refused, failures } = attack(seed, 60_000, 40);
            serde_json::json!({ "motions": motions, "events": events, "refused": refused, "failures": failures })
        },
    }]);
}

/// Motors on seams: many at once are those of one after the other, errors included.
#[test]
fn transients_on_seams_are_those_of_single_motors() {
    let mut random = SplitMix::new(202);
    let mut done = 0;
    for _ in 0..40 {
        let members: Vec<_> = (0..60)
            .filter_map(|seed| {
                let dimensionless = system(&mut random);
                let platform = PlatformParameters {
                    amplitude: dimensionless.peak_acceleration(),
                    twist_amplitude: dimensionless.twist_speed(),
                    angular_frequency: 1.0,
                    phase_lag: 0.25 * PI,
                };
                let disk = DiskParameters {
                    contact_radius: 1.0,
                    gyration_radius: 1.0,
                    friction: dimensionless.friction(),
                    // Next to 1 a slow disk bounces more often in the duration than anybody waits for.
                    restitution: dimensionless.restitution().min(0.9),
                    preload_acceleration: 1.0,
                    load_acceleration: dimensionless.load(),
                };
                let phase = Phase::new(angle(&mut random, dimensionless.peak_acceleration())).unwrap();
                let settings = TransientSettings { duration: 60.0, intervals: 7, seed, ..Default::default() };
                let system = System::new(platform.build().ok()?, disk.build().ok()?).ok()?;
                Some(TransientMember { system, phase, settings })
            })
            .collect();
        for (member, together) in members.iter().zip(transients(&members, &Unobserved).expect("unobserved")) {
            let alone = transient(&member.system, member.phase, &member.settings, &Unobserved);
            assert_eq!(together, alone, "{member:?}");
            done += u32::from(alone.is_ok());
        }
    }
    assert!(done > 1_000, "{done}");
}
