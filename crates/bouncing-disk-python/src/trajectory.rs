//! The motion of the engine: its events, and samples between them.

use bouncing_disk::core::Error as CoreError;
use bouncing_disk::core::run::Watch;
use bouncing_disk::{
    DiskState, Engine, Error, Event, EventKind, EventRecord, Mode, PhaseSpan, PlatformState, Scales,
    SlipDirection, Snapshot, System as Model, Trajectory as Motion, toss_trajectory as toss_motion,
};
use pyo3::prelude::*;

use crate::arguments::{Count, ProgressCallable};
use crate::chatter::{ChatterCut, policy};
use crate::diagram::room_for;
use crate::real::{Real, optional};
use crate::start::Start;
use crate::system::System;
use crate::text::Json;
use crate::toss::{energy, initial_spin};
use crate::{errors, long_call, results, text};

/// The most events of a trajectory: each takes some 400 bytes.
const MOST_EVENTS: u64 = 1_000_000;

/// The most samples.
const MOST_SAMPLES: u64 = 1 << 24;

/// What an event counts as for an observer, in flights.
const FLIGHTS_OF_EVENT: u64 = 4;

/// The motion of a disk up to some event, in SI units.
///
/// Made by :func:`simulate` and :func:`toss_trajectory`.
#[pyclass(frozen, eq, module = "bouncing_disk")]
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Trajectory {
    system: Model,
    motion: Motion,
}

/// The place in `TrajectorySamples.MODES`.
fn mode(mode: Mode) -> u8 {
    match mode {
        Mode::Flight => 0,
        Mode::Sticking => 1,
        Mode::Sliding(SlipDirection::Forward) => 2,
        Mode::Sliding(SlipDirection::Backward) => 3,
    }
}

/// The place in `EventTable.KINDS`.
fn kind(event: &Event) -> u8 {
    EventKind::ALL.iter().position(|kind| *kind == event.kind()).map_or(u8::MAX, |place| place as u8)
}

/// The platform in SI units: its state scales as that of the disk.
fn platform(scales: &Scales, state: &PlatformState) -> [f64; 4] {
    let PlatformState { height, axial_velocity, angle, angular_speed } = *state;
    let state =
        scales.state(&DiskState { mode: Mode::Sticking, height, axial_velocity, angle, angular_speed });
    [state.height, state.axial_velocity, state.angle, state.angular_speed]
}

#[pymethods]
impl Trajectory {
    /// The system.
    #[getter]
    fn system(&self) -> System {
        System(self.system)
    }

    /// Time of the start (s), from phase 0 of the first period.
    #[getter]
    fn start_time(&self) -> f64 {
        self.system.scales().time_seconds(self.motion.start())
    }

    /// Time of the last event (s); where no event follows, the time until which the motion was asked for.
    #[getter]
    fn end_time(&self) -> f64 {
        self.system.scales().time_seconds(self.motion.end())
    }

    /// The energy balance of the whole motion, per unit mass.
    #[getter]
    fn energy<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        energy(py, &self.system.scales().energy(&self.motion.ledger()))
    }

    /// Disk and platform at instants of equal distances from the start to the end.
    ///
    /// Parameters
    /// ----------
    /// count : int
    ///     Number of instants, in [2, 2^24].
    ///
    /// Returns
    /// -------
    /// TrajectorySamples
    ///
    /// Raises
    /// ------
    /// ComputationError
    ///     There are no events, and the motion was given no duration.
    ///
    /// Examples
    /// --------
    /// >>> import bouncing_disk as bd
    /// >>> samples = bd.toss_trajectory(bd.System.pizza_toss()).samples(count=200)
    /// >>> round(float(samples.height.max()), 2)  # m
    /// 0.54
    #[pyo3(signature = (*, count), text_signature = "($self, /, *, count)")]
    fn samples<'py>(&self, py: Python<'py>, count: Count) -> PyResult<Bound<'py, PyAny>> {
        let range = "[2, 16777216]";
        let count = count.at_most(py, "count", MOST_SAMPLES, range)?;
        if count < 2 {
            return Err(errors::out_of_range(py, "count", count as f64, range));
        }
        if self.motion.end() == self.motion.start() {
            return Err(errors::no_events(py));
        }
        let scales = self.system.scales();
        let (numbers, modes) = long_call::run(py, None, |observer| {
            let watch = Watch::begin(observer, 0, count)?;
            let mut work = watch.work();
            let mut numbers: [Vec<f64>; 9] = Default::default();
            for column in &mut numbers {
                *column = room_for(count as usize)?;
            }
            let mut modes = room_for(count as usize)?;
            for Snapshot { time, disk, platform: under } in self.motion.uniform(count as usize) {
                let state = scales.state(&disk);
                let [height, velocity, angle, speed] = platform(&scales, &under);
                let row = [
                    scales.time_seconds(time),
                    state.height,
                    state.axial_velocity,
                    state.angle,
                    state.angular_speed,
                    height,
                    velocity,
                    angle,
                    speed,
                ];
                for (column, number) in numbers.iter_mut().zip(row) {
                    column.push(number);
                }
                modes.push(mode(disk.mode));
                work.finish(1)?;
            }
            Ok((numbers, modes))
        })?;
        let [
            time,
            height,
            axial_velocity,
            angle,
            angular_speed,
            platform_height,
            velocity,
            platform_angle,
            speed,
        ] = numbers.map(|column| results::array(py, column));
        let disk = (time, height, axial_velocity, angle, angular_speed);
        let rest = (platform_height, velocity, platform_angle, speed, results::array(py, modes));
        results::make(py, "TrajectorySamples", results::joined(py, disk, rest)?)
    }

    /// The events.
    ///
    /// Returns
    /// -------
    /// EventTable
    ///
    /// Examples
    /// --------
    /// >>> import bouncing_disk as bd
    /// >>> bd.toss_trajectory(bd.System.pizza_toss()).events().names()
    /// ['stick-to-slip', 'separation', 'impact']
    fn events<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let (scales, records) = (self.system.scales(), self.motion.records());
        let row = |of: &dyn Fn(&EventRecord) -> f64| results::array(py, records.iter().map(of).collect());
        let bytes = |of: &dyn Fn(&EventRecord) -> u8| results::array(py, records.iter().map(of).collect());
        let impact = |record: &EventRecord| match record.event {
            Event::Impact { axial_impact_velocity, tangential_impact_velocity, capped } => {
                Some((axial_impact_velocity, tangential_impact_velocity, capped))
            }
            _ => None,
        };
        let chatter = |record: &EventRecord| match record.event {
            Event::Attachment { impacts, error_bound } => Some((impacts, error_bound)),
            _ => None,
        };
        let first = (
            row(&|record| scales.time_seconds(record.time)),
            row(&|record| record.time.phase.angle()),
            bytes(&|record| kind(&record.event)),
            bytes(&|record| mode(record.before.mode)),
            bytes(&|record| mode(record.after.mode)),
            row(&|record| scales.state(&record.after).height),
            row(&|record| scales.state(&record.before).axial_velocity),
            row(&|record| scales.state(&record.after).axial_velocity),
            row(&|record| scales.state(&record.after).angle),
        );
        let rest = (
            row(&|record| scales.state(&record.before).angular_speed),
            row(&|record| scales.state(&record.after).angular_speed),
            row(&|record| impact(record).map_or(f64::NAN, |(velocity, _, _)| velocity * scales.velocity)),
            row(&|record| impact(record).map_or(f64::NAN, |(_, speed, _)| speed * scales.angular_speed)),
            results::array(
                py,
                records.iter().map(|record| impact(record).is_some_and(|(.., capped)| capped)).collect(),
            ),
            results::array(
                py,
                records
                    .iter()
                    .map(|record| chatter(record).map_or(0, |(impacts, _)| impacts as i64))
                    .collect(),
            ),
            row(&|record| chatter(record).map_or(f64::NAN, |(_, bound)| bound)),
        );
        results::make(py, "EventTable", results::joined(py, first, rest)?)
    }

    /// Number of events.
    fn __len__(&self) -> usize {
        self.motion.records().len()
    }

    /// The trajectory as JSON: the system, and the motion as the Rust library stores it.
    ///
    /// Returns
    /// -------
    /// str
    fn to_json(&self) -> PyResult<String> {
        text::stored(&(&self.system, &self.motion))
    }

    /// The trajectory of such a text.
    ///
    /// Parameters
    /// ----------
    /// json : str
    ///     As of :meth:`to_json`.
    ///
    /// Returns
    /// -------
    /// Trajectory
    #[staticmethod]
    fn from_json(py: Python<'_>, json: Json) -> PyResult<Self> {
        json.read(py).map(|(system, motion)| Self { system, motion })
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<text::Reduced<'py>> {
        text::reduced::<Self>(py, self.to_json()?)
    }

    fn __repr__(&self) -> String {
        let (events, start, end) = (self.__len__(), self.start_time(), self.end_time());
        format!("<Trajectory of {events} events from {start:?} s to {end:?} s>")
    }
}

/// The whole toss of a disk from its platform, from the start until it lands.
///
/// Parameters
/// ----------
/// system : System
/// initial_spin : {"absolute-rest", "with-hand"}, default "absolute-rest"
///     Whether the disk does not turn at first, or turns with the platform.
///
/// Returns
/// -------
/// Trajectory
#[pyfunction]
#[pyo3(signature = (system, *, initial_spin="absolute-rest"))]
pub(crate) fn toss_trajectory(
    py: Python<'_>,
    system: &Bound<'_, System>,
    initial_spin: &str,
) -> PyResult<Trajectory> {
    let (system, initial) = (system.get().0, self::initial_spin(initial_spin)?);
    let motion = long_call::short(py, &[], || toss_motion(&system, initial))?;
    Ok(Trajectory { system, motion })
}

/// The motion of a disk, event by event.
///
/// The disk starts on the platform if neither ``gap`` nor ``relative_velocity`` is given, leaves it if the
/// latter is given alone, and is in the air if there is a gap.
///
/// Parameters
/// ----------
/// system : System
/// phase : float, default 0
///     Phase of the platform at the start (rad).
/// angular_speed : float, optional
///     Angular speed of the disk (rad/s); by default that of the platform.
/// gap : float, optional
///     Height above the platform (m), positive.
/// relative_velocity : float, optional
///     Axial velocity relative to the platform (m/s); not negative without a gap.
/// events : int, default 1000
///     The most events, in [1, 1000000].
/// duration : float, optional
///     Time (s), positive, after which the next event is the last one; where none follows, the motion ends then.
/// chatter : ChatterCut, optional
///     How a chatter ends; ``None`` sums it.
/// progress : callable, optional
///     Called as ``progress(done, total)`` with the number of events.
///
/// Returns
/// -------
/// Trajectory
///
/// Examples
/// --------
/// >>> import bouncing_disk as bd
/// >>> motion = bd.simulate(bd.System.pizza_toss(), phase=4.7, events=100)
/// >>> len(motion)
/// 100
#[pyfunction]
#[pyo3(signature = (
    system, *, phase=Real(0.0), angular_speed=None, gap=None, relative_velocity=None,
    events=Count::Fits(1000), duration=None, chatter=None, progress=ProgressCallable(None)
), text_signature = "(system, *, phase=0.0, angular_speed=None, gap=None, relative_velocity=None, events=1000, \
                     duration=None, chatter=None, progress=None)")]
#[expect(clippy::too_many_arguments, reason = "they are keywords")]
pub(crate) fn simulate(
    py: Python<'_>,
    system: &Bound<'_, System>,
    phase: Real,
    angular_speed: Option<Real>,
    gap: Option<Real>,
    relative_velocity: Option<Real>,
    events: Count,
    duration: Option<Real>,
    chatter: Option<&Bound<'_, ChatterCut>>,
    progress: ProgressCallable,
) -> PyResult<Trajectory> {
    let range = "[1, 1000000]";
    let most = events.at_most(py, "events", MOST_EVENTS, range)?;
    if most == 0 {
        return Err(errors::out_of_range(py, "events", 0.0, range));
    }
    let duration = optional(duration);
    if let Some(duration) = duration
        && !(duration > 0.0 && duration.is_finite())
    {
        return Err(errors::out_of_range(py, "duration", duration, "(0, inf) (s)"));
    }
    let system = system.get().0;
    let start = Start::new(phase, angular_speed, gap, relative_velocity);
    let policy = policy(chatter);
    let motion = long_call::run_named(py, progress.0, &start.names(&system), |observer| {
        let mut engine = Engine::new(system, start.condition(&system)?, policy)?;
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
    Ok(Trajectory { system, motion })
}
