//! The motion of the engine: samples for an animation, and the events.

use std::f64::consts::TAU;

use bouncing_disk::core::{ChatterPolicy, Phase, Unobserved};
use bouncing_disk::driven::{DrivenEngine, DrivenSystem};
use bouncing_disk::motion::{
    DiskState, EnergyLedger, EventKind, MAX_SAMPLES, Mode, PhaseSpan, PhaseTime, PlatformState,
    SlipDirection, Snapshot,
};
use bouncing_disk::parameters::{DrivenPlatform, Scales};
use bouncing_disk::toss::CollisionState;
use bouncing_disk::{Engine, Event, EventRecord, InitialCondition, System};
use serde_json::json;

use crate::reply::{Refusal, Reply};
use crate::request::{ImpactStart, MotionStart};

/// Largest number of events of an answer: a disk that chatters on a platform with little restitution has
/// many.
const MOST_EVENTS: usize = 500_000;

/// Largest number of periods of an answer.
const MOST_PERIODS: u64 = 100_000;

/// Energy is per mass from the start to the end (J/kg): the energy supplied by the platform, the losses to impacts,
/// friction and the load, and the gain of the disk since the start. Numbers: a row for each sample with the
/// time, height, angle, velocity and angular speed of the disk, and height, angle, velocity and angular speed
/// of the platform; then a row for each event with its time, phase, normalised speed and tangential velocity
/// of an impact (an angular speed relative to the platform; both else NaN), the angular speed after it and
/// the height. Bytes: modes of the samples, kinds of the events by their place in `event_kinds`.
pub(crate) fn answer(
    system: &System,
    start: MotionStart,
    periods: u64,
    samples_per_period: u64,
) -> Result<Reply, Refusal> {
    let samples = periods.saturating_mul(samples_per_period).saturating_add(1);
    if periods == 0 || periods > MOST_PERIODS {
        return Err(Refusal::out_of_range("periods", periods as f64, "[1, 100000]"));
    }
    if samples_per_period == 0 || samples > MAX_SAMPLES as u64 {
        return Err(Refusal::out_of_range("samples", samples as f64, "at most 2^24 in all periods together"));
    }
    let scales = system.scales();
    let follow = if system.soft_contact().is_some() { soft } else { rigid };
    let Course { begun, snapshots, records, ledger } = follow(system, start, periods, samples_per_period)?;
    let mut numbers = Vec::with_capacity(9 * snapshots.len() + 6 * records.len());
    let mut bytes = Vec::with_capacity(snapshots.len() + records.len());
    for snapshot in &snapshots {
        let disk = scales.state(&snapshot.disk);
        let platform = scales.state(&carried(&snapshot.platform));
        numbers.extend([
            scales.span_seconds(snapshot.time.since(&begun)),
            disk.height,
            disk.angle,
            disk.axial_velocity,
            disk.angular_speed,
            platform.height,
            platform.angle,
            platform.axial_velocity,
            platform.angular_speed,
        ]);
        bytes.push(mode(snapshot.disk.mode));
    }
    for record in &records {
        numbers.push(scales.span_seconds(record.time.since(&begun)));
        numbers.extend(event(&scales, record));
        bytes.push(kind(&record.event));
    }
    let ledger = scales.energy(&ledger);
    let json = json!({
        "samples": snapshots.len(),
        "events": records.len(),
        "event_kinds": EventKind::ALL.map(|kind| kind.to_string()),
        "energy": {
            "platform_work": ledger.normal_work + ledger.friction_work,
            "restitution_loss": ledger.restitution_loss,
            "friction_loss": ledger.friction_loss,
            "load_work": ledger.load_work,
            "stored": ledger.axial_kinetic_change + ledger.potential_change + ledger.rotary_kinetic_change,
        },
    });
    Reply::new(&json, numbers, bytes)
}

/// A motion in the units of the engine.
struct Course {
    begun: PhaseTime,
    snapshots: Vec<Snapshot>,
    records: Vec<EventRecord>,
    ledger: EnergyLedger,
}

impl Course {
    fn new(begun: PhaseTime, snapshots: Vec<Snapshot>) -> Self {
        Self { begun, snapshots, records: Vec::new(), ledger: EnergyLedger::default() }
    }

    fn take(&mut self, record: EventRecord) {
        self.ledger += record.ledger;
        if self.records.len() < MOST_EVENTS {
            self.records.push(record);
        }
    }
}

fn rigid(system: &System, start: MotionStart, periods: u64, samples: u64) -> Result<Course, Refusal> {
    let mut engine = Engine::new(*system, condition(system, start)?, ChatterPolicy::Complete)?;
    let begun = engine.time();
    let span = PhaseSpan { periods, remainder: 0.0 };
    let end = begun.after(span);
    let snapshots = engine.clone().sample(span, (periods * samples + 1) as usize, &Unobserved)?;
    let mut course = Course::new(begun, snapshots);
    // The event after the end, and the motion after the last event, are unfinished.
    let unfinished = loop {
        match engine.advance()? {
            Some(record) if record.time.order(&end).is_gt() => {
                break record.segment.ledger_after(engine.system(), end.since(&record.segment.start));
            }
            Some(record) => course.take(record),
            None => break engine.ledger_after(end.since(&engine.time())),
        }
    };
    course.ledger += unfinished;
    Ok(course)
}

/// A motion with compliant contacts. An impact at the start is the touch of the first one.
fn soft(system: &System, start: MotionStart, periods: u64, samples: u64) -> Result<Course, Refusal> {
    let platform = DrivenPlatform::from(*system.platform()).with_contact(system.soft_contact());
    let (driven, policy) = (DrivenSystem::new(&platform, system.disk())?, ChatterPolicy::Complete);
    let at = |phase| PlatformState::at(system.dimensionless(), phase);
    let mut next = match start {
        MotionStart::Impact { impact_phase, normalised_speed, angular_speed } if normalised_speed > 0.0 => {
            let impact = ImpactStart { impact_phase, normalised_speed }.state()?;
            let mut state = DiskState { mode: Mode::Flight, ..carried(&at(impact.phase())) };
            state.axial_velocity += impact.velocity();
            state.angular_speed = angular_speed / system.scales().angular_speed;
            let begun = PhaseTime { periods: 0, phase: impact.phase() };
            DrivenEngine::of_state(driven, begun, state, policy)?
        }
        start => DrivenEngine::new(driven, condition(system, start)?, policy)?,
    };
    let mut course = Course::new(next.time(), Vec::new());
    let instant = |begun: PhaseTime, index: u64| {
        let share = (index % samples) as f64 / samples as f64;
        begun.after(PhaseSpan { periods: index / samples, remainder: TAU * share })
    };
    let end = instant(course.begun, periods * samples);
    loop {
        let engine = next.clone();
        let record = next.advance()?;
        while course.snapshots.len() as u64 <= periods * samples {
            let time = instant(course.begun, course.snapshots.len() as u64);
            if record.is_some_and(|record| time.order(&record.time).is_ge()) {
                break;
            }
            let (_, disk) = engine.state_after(time.since(&engine.time()).radians());
            course.snapshots.push(Snapshot { time, disk, platform: at(time.phase) });
        }
        match record.filter(|record| record.time.order(&end).is_le()) {
            Some(record) => course.take(record),
            None => {
                course.ledger += engine.ledger_after(end.since(&engine.time()).radians());
                return Ok(course);
            }
        }
    }
}

/// The start in the units of the engine.
fn condition(system: &System, start: MotionStart) -> Result<InitialCondition, Refusal> {
    let (scales, dimensionless) = (system.scales(), system.dimensionless());
    let speed = |angular_speed: f64| angular_speed / scales.angular_speed;
    Ok(match start {
        MotionStart::Impact { impact_phase, normalised_speed, angular_speed } => {
            let impact = ImpactStart { impact_phase, normalised_speed }.state()?;
            let platform_speed = dimensionless.platform_angular_speed(impact.phase());
            let state = CollisionState {
                phase: impact.phase(),
                axial_impact_velocity: impact.velocity(),
                tangential_impact_velocity: speed(angular_speed) - platform_speed,
            };
            state.rebound(dimensionless)?
        }
        MotionStart::Flight { phase, angular_speed, gap, relative_velocity } => InitialCondition::Flight {
            phase: Phase::new(phase)?,
            gap: gap / scales.length,
            relative_velocity: relative_velocity / scales.velocity,
            angular_speed: speed(angular_speed),
        },
    })
}

/// A disk that moves as the platform does, whose state has a meaning in SI units.
const fn carried(platform: &PlatformState) -> DiskState {
    let PlatformState { height, axial_velocity, angle, angular_speed } = *platform;
    DiskState { mode: Mode::Sticking, height, axial_velocity, angle, angular_speed }
}

fn event(scales: &Scales, record: &EventRecord) -> [f64; 5] {
    let after = scales.state(&record.after);
    let (speed, tangential) = match record.event {
        Event::Impact { axial_impact_velocity, tangential_impact_velocity, .. } => {
            (-axial_impact_velocity / std::f64::consts::PI, tangential_impact_velocity * scales.angular_speed)
        }
        _ => (f64::NAN, f64::NAN),
    };
    [record.time.phase.angle(), speed, tangential, after.angular_speed, after.height]
}

const fn mode(mode: Mode) -> u8 {
    match mode {
        Mode::Flight => 0,
        Mode::Sticking => 1,
        Mode::Sliding(SlipDirection::Forward) => 2,
        Mode::Sliding(SlipDirection::Backward) => 3,
    }
}

fn kind(event: &Event) -> u8 {
    EventKind::ALL.iter().position(|kind| *kind == event.kind()).map_or(u8::MAX, |place| place as u8)
}
