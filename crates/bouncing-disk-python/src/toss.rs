//! Tosses and trajectories: the motion of the engine, in SI units.

use bouncing_disk::core::{Error as CoreError, Phase, run::Watch};
use bouncing_disk::driven;
use bouncing_disk::motion::{
    DiskState, EventKind, Mode, PhaseSpan, PlatformState, SiEnergy, SiState, SlipDirection, Snapshot,
};
use bouncing_disk::parameters::{Contact, Scales};
use bouncing_disk::toss::{
    InitialSpin, RotaryOutcome, TossPerformance, rotary_response as response, single_toss as toss,
    toss_trajectory as toss_motion,
};
use bouncing_disk::{
    Engine, Error, Event, EventRecord, InitialCondition, System as SystemModel, Trajectory as Motion,
};
use pyo3::prelude::*;

use crate::arguments::{Arguments, Made, Real, choice, extracted, held};
use crate::orbits::PeriodicOrbit;
use crate::parameters::{System, python_system};
use crate::results::{array, column, holders, holding, make, room_for};
use crate::{errors, long_call, parameters};

holders! {
    /// The contents of a `Trajectory`: the system, and the motion.
    Trajectory((SystemModel, Motion)) = shown_trajectory;
}

/// The most events of a trajectory: each takes about 400 bytes.
const MOST_EVENTS: u64 = 1_000_000;

/// The most samples.
const MOST_SAMPLES: u64 = 1 << 24;

/// The work of an event, in flights.
const FLIGHTS_OF_EVENT: u64 = 4;

const SPINS: [(&str, InitialSpin); 2] =
    [("absolute-rest", InitialSpin::AbsoluteRest), ("with-hand", InitialSpin::RestRelativeToHand)];

fn shown_energy<'py>(py: Python<'py>, energy: &SiEnergy) -> Made<'py> {
    make!(
        py,
        "Energy",
        energy.normal_work,
        energy.friction_work,
        energy.restitution_loss,
        energy.friction_loss,
        energy.load_work,
        energy.axial_kinetic_change,
        energy.potential_change,
        energy.rotary_kinetic_change,
    )
}

fn shown_toss<'py>(py: Python<'py>, toss: &TossPerformance) -> Made<'py> {
    make!(
        py,
        "TossPerformance",
        toss.airborne_speed,
        toss.efficiency,
        toss.speed_ratio,
        toss.separation_phase,
        toss.sliding_at_separation,
        toss.launch_speed,
        toss.rotary_energy_gain,
        shown_energy(py, &toss.energy)?,
    )
}

/// The toss of a disk from its platform.
///
/// Callers request thousands a second, so it takes no dictionary.
#[pyfunction]
pub(crate) fn single_toss<'py>(
    system: &Bound<'py, PyAny>,
    initial_spin: &Bound<'py, PyAny>,
    drive: &Bound<'py, PyAny>,
    contact_time: &Bound<'py, PyAny>,
) -> Made<'py> {
    let (py, system) = (system.py(), held::<System>(system, "system")?.get().0);
    let initial = choice(initial_spin, "initial_spin", &SPINS)?;
    let drive = parameters::drive_of(drive)?.unwrap_or_default();
    let time = extracted::<Option<Real>>(contact_time, "contact_time")?;
    let done = long_call::caught(|| {
        let contact = time.map(|Real(time)| Contact { time: Some(time), ..Contact::default() });
        let system = if contact.is_some() { system.with_contact(contact)? } else { system };
        if drive.is_sine() && system.soft_contact().is_none() {
            return toss(&system, initial);
        }
        if drive.start_phase.is_some() {
            return Err(Error::StartPhase);
        }
        let hand = system.driven_platform(&drive)?;
        driven::single_toss(&hand, system.disk(), None, initial)
    })?;
    shown_toss(py, &done.map_err(|error| errors::of(py, error))?)
}

/// The start of the motion of a call, given in SI units.
fn start(a: &Arguments<'_>, system: &SystemModel) -> PyResult<impl Fn() -> Result<InitialCondition, Error>> {
    let (phase, angular_speed) = (a.real("phase")?, a.optional("angular_speed")?);
    let (gap, velocity) = (a.optional("gap")?, a.optional("relative_velocity")?);
    let (system, scales) = (*system, system.scales());
    Ok(move || {
        let phase = Phase::new(phase)?;
        let own = system.dimensionless().platform_angular_speed(phase);
        let angular_speed = angular_speed.map_or(own, |speed| speed / scales.angular_speed);
        let velocity = velocity.map(|velocity| velocity / scales.velocity);
        Ok(match (gap, velocity) {
            (None, None) => InitialCondition::Contact { phase, angular_speed },
            (None, Some(relative_speed)) => InitialCondition::Launch { phase, relative_speed, angular_speed },
            (Some(gap), velocity) => InitialCondition::Flight {
                phase,
                gap: gap / scales.length,
                relative_velocity: velocity.unwrap_or(0.0),
                angular_speed,
            },
        })
    })
}

/// The index into `TrajectorySamples.MODES`.
fn mode(mode: Mode) -> u8 {
    match mode {
        Mode::Flight => 0,
        Mode::Sticking => 1,
        Mode::Sliding(SlipDirection::Forward) => 2,
        Mode::Sliding(SlipDirection::Backward) => 3,
    }
}

/// The index into `EventTable.KINDS`.
fn kind(event: &Event) -> u8 {
    EventKind::ALL.iter().position(|kind| *kind == event.kind()).map_or(u8::MAX, |place| place as u8)
}

fn shown_trajectory(py: Python<'_>, (system, motion): (SystemModel, Motion)) -> Made<'_> {
    let scales = system.scales();
    let made = make!(
        py,
        "Trajectory",
        python_system(py, &system)?,
        scales.time_seconds(motion.start()),
        scales.time_seconds(motion.end()),
        motion.records().len(),
        shown_energy(py, &scales.energy(&motion.ledger()))?,
    )?;
    holding(made, Trajectory((system, motion)))
}

/// The platform in SI units: its state scales like the disk's.
fn platform(scales: &Scales, state: &PlatformState) -> SiState {
    let PlatformState { height, axial_velocity, angle, angular_speed } = *state;
    scales.state(&DiskState { mode: Mode::Sticking, height, axial_velocity, angle, angular_speed })
}

/// Disk and platform at equidistant instants.
#[pyfunction]
pub(crate) fn samples(a: Arguments<'_>) -> Made<'_> {
    const RANGE: &str = "[2, 16777216]";
    let (trajectory, count, py) =
        (a.held::<Trajectory>("self")?, a.count("count", MOST_SAMPLES, RANGE)?, a.py());
    if count < 2 {
        return Err(errors::out_of_range(py, "count", count as f64, RANGE));
    }
    let (system, motion) = &trajectory.get().0;
    if motion.end() == motion.start() {
        return Err(errors::no_events(py));
    }
    let scales = system.scales();
    let (numbers, modes) = a.run(|observer| {
        let watch = Watch::begin(observer, 0, count)?;
        let mut work = watch.work();
        let mut numbers: [Vec<f64>; 9] = Default::default();
        for column in &mut numbers {
            *column = room_for(count as usize)?;
        }
        let mut modes = room_for(count as usize)?;
        for Snapshot { time, disk, platform: under } in motion.uniform(count as usize) {
            let (state, under) = (scales.state(&disk), platform(&scales, &under));
            let of = |state: &SiState| [state.height, state.axial_velocity, state.angle, state.angular_speed];
            let row = [scales.time_seconds(time)].into_iter().chain(of(&state)).chain(of(&under));
            for (column, number) in numbers.iter_mut().zip(row) {
                column.push(number);
            }
            modes.push(mode(disk.mode));
            work.finish(1)?;
        }
        Ok((numbers, modes))
    })?;
    let mut fields: Vec<_> = numbers.into_iter().map(|column| array(py, column).into_any()).collect();
    fields.push(array(py, modes).into_any());
    crate::results::made(py, "TrajectorySamples", fields)
}

/// The events of a trajectory.
#[pyfunction]
pub(crate) fn events(a: Arguments<'_>) -> Made<'_> {
    let (trajectory, py) = (a.held::<Trajectory>("self")?, a.py());
    let (system, motion) = &trajectory.get().0;
    let (scales, records) = (system.scales(), motion.records());
    let impact = |record: &EventRecord| match record.event {
        Event::Impact { axial_impact_velocity, tangential_impact_velocity, capped } => {
            (axial_impact_velocity, tangential_impact_velocity, capped)
        }
        _ => (f64::NAN, f64::NAN, false),
    };
    let chatter = |record: &EventRecord| match record.event {
        Event::Attachment { impacts, error_bound } => (impacts as i64, error_bound),
        _ => (0, f64::NAN),
    };
    make!(
        py,
        "EventTable",
        column(py, records, |record| scales.time_seconds(record.time)),
        column(py, records, |record| record.time.phase.angle()),
        column(py, records, |record| kind(&record.event)),
        column(py, records, |record| mode(record.before.mode)),
        column(py, records, |record| mode(record.after.mode)),
        column(py, records, |record| scales.state(&record.after).height),
        column(py, records, |record| scales.state(&record.before).axial_velocity),
        column(py, records, |record| scales.state(&record.after).axial_velocity),
        column(py, records, |record| scales.state(&record.after).angle),
        column(py, records, |record| scales.state(&record.before).angular_speed),
        column(py, records, |record| scales.state(&record.after).angular_speed),
        column(py, records, |record| impact(record).0 * scales.velocity),
        column(py, records, |record| impact(record).1 * scales.angular_speed),
        column(py, records, |record| impact(record).2),
        column(py, records, |record| chatter(record).0),
        column(py, records, |record| chatter(record).1),
    )
}

/// The whole toss of a disk from its platform.
#[pyfunction]
pub(crate) fn toss_trajectory(a: Arguments<'_>) -> Made<'_> {
    let (system, initial) = (a.rigid_system()?, a.choice("initial_spin", &SPINS)?);
    let motion = long_call::short(&a, || toss_motion(&system, initial))?;
    shown_trajectory(a.py(), (system, motion))
}

/// The motion of a disk, event by event.
#[pyfunction]
pub(crate) fn simulate(a: Arguments<'_>) -> Made<'_> {
    const RANGE: &str = "[1, 1000000]";
    let (system, policy, py) = (a.rigid_system()?, a.policy()?, a.py());
    let start = start(&a, &system)?;
    let (most, duration) = (a.count("events", MOST_EVENTS, RANGE)?, a.optional("duration")?);
    if most == 0 {
        return Err(errors::out_of_range(py, "events", 0.0, RANGE));
    }
    if let Some(duration) = duration
        && !(duration > 0.0 && duration.is_finite())
    {
        return Err(errors::out_of_range(py, "duration", duration, "(0, inf) (s)"));
    }
    let motion = a.run(|observer| {
        let mut engine = Engine::new(system, start()?, policy)?;
        let (scales, begun) = (system.scales(), engine.time());
        let watch = Watch::begin(observer, 0, most)?;
        let (mut work, mut seen, mut stopped) = (watch.work(), 0, false);
        let radians = duration.map_or(0.0, |duration| duration / scales.time);
        let end = begun.after(PhaseSpan::from_radians(radians));
        let motion = Motion::record_until(&mut engine, end, |record| {
            seen += 1;
            watch.finish(1);
            stopped = work.spend(FLIGHTS_OF_EVENT).is_err();
            let late = |duration| scales.span_seconds(record.time.since(&begun)) >= duration;
            stopped || seen >= most || duration.is_some_and(late)
        })?;
        if stopped {
            return Err(Error::from(CoreError::Stopped { done: seen, total: most }));
        }
        Ok(motion)
    })?;
    shown_trajectory(py, (system, motion))
}

/// The fate of the spin of a disk on a periodic orbit.
#[pyfunction]
pub(crate) fn rotary_response(a: Arguments<'_>) -> Made<'_> {
    let (system, orbit, py) = (a.rigid_system()?, a.held::<PeriodicOrbit>("orbit")?, a.py());
    let (unit, none) = (system.scales().angular_speed, f64::NAN);
    let found = long_call::short(&a, || response(system.dimensionless(), &orbit.get().0))?;
    let (outcome, own, limit, change) = match &found {
        RotaryOutcome::Steady(own) => ("steady", Some(own), none, none),
        RotaryOutcome::Kept { limit } => ("kept", None, limit.map_or(none, |limit| limit * unit), none),
        RotaryOutcome::Runaway { change } => ("runaway", None, none, change * unit),
        _ => ("unknown", None, none, none),
    };
    let speeds = |speeds: &[f64]| column(py, speeds, |speed| speed * unit);
    let sliding = own.map_or(&[][..], |own| &own.sliding);
    make!(
        py,
        "RotaryResponse",
        outcome,
        found.multiplier().unwrap_or(none),
        speeds(own.map_or(&[], |own| &own.angular_speeds)),
        speeds(own.map_or(&[], |own| &own.slips)),
        column(py, sliding, |slides| slides.map_or(0, |direction| direction.sign() as i64)),
        own.map_or(none, |own| own.stick_margin * unit),
        own.map_or(none, |own| own.mean_angular_speed * unit),
        limit,
        change,
    )
}
