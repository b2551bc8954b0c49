//! The event engine: the motion of a disk from event to event, on a platform that moves sinusoidally or
//! with any periodic motion.
//!
//! A [`Ground`] finds the next event, in closed form or as a first root. The effect of an event on the disk,
//! and its record with the energy, are the same on every ground and implemented here.

pub(crate) mod sample;
pub(crate) mod sine;

use std::fmt::Debug;

use bouncing_disk_core::{ChatterPolicy, Phase};

use crate::error::{Error, moderate};
use crate::motion::contact_motion::Lying;
use crate::motion::energy::EnergyLedger;
use crate::motion::event::{Event, EventRecord, Motion};
use crate::motion::impact::rebound_velocity;
use crate::motion::impact_energy::impact;
use crate::motion::initial_condition::InitialCondition;
use crate::motion::phase_time::{PhaseSpan, PhaseTime};
use crate::motion::rotary_change::{RotaryChange, change_in_flight, record_flight_load};
use crate::motion::segment::Segment;
use crate::motion::state::{DiskState, LongSum, Mode, PlatformState};

pub use sine::SineGround;
pub(crate) use sine::chatter_speed;

/// A kind of platform under the disk, which determines its motion and the next event.
///
/// The trait is sealed; it is implemented by [`SineGround`] and, for platforms with any periodic motion, by
/// [`DrivenGround`](crate::driven::DrivenGround).
pub trait Ground: Debug + Clone {
    /// Disk and platform.
    type System: Debug + Clone;
    /// The data of a flight beyond the state of the disk.
    type Flight: Debug + Clone + Copy + PartialEq;
    /// The end of a contact, if it ends.
    type ContactEnd: Debug + Clone + Copy + PartialEq;

    /// The platform at a phase.
    fn platform(system: &Self::System, phase: Phase) -> PlatformState;

    /// Friction and load.
    fn torques(system: &Self::System) -> [f64; 2];

    #[doc(hidden)]
    /// The event that ends a flight, if it comes within `limit` radians of the last event.
    ///
    /// # Errors
    /// The errors of the core's flights.
    fn end_flight(
        engine: &mut Engine<Self>,
        flight: Self::Flight,
        limit: f64,
    ) -> Result<Option<EventRecord>, Error>;

    #[doc(hidden)]
    /// The next event of a disk that lies on the platform, if it comes within `limit` radians of the last
    /// event.
    ///
    /// # Errors
    /// [`Error::SlipTooLong`], and errors of the core's root search.
    fn end_contact(
        engine: &mut Engine<Self>,
        lying: Lying<Self::ContactEnd>,
        limit: f64,
    ) -> Result<Option<EventRecord>, Error>;
}

/// A system on which an engine can start: a [`System`](crate::System), a
/// [`DimensionlessSystem`](crate::parameters::DimensionlessSystem) or a
/// [`DrivenSystem`](crate::driven::DrivenSystem).
pub trait OnGround {
    /// The kind of platform.
    type Ground: Ground;

    /// The engine of [`Engine::new`].
    ///
    /// # Errors
    /// The errors of [`Engine::new`].
    fn start(self, start: InitialCondition, policy: ChatterPolicy) -> Result<Engine<Self::Ground>, Error>;
}

/// The disk's motion until the next event.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Stage<Flight, End> {
    /// It flies.
    Flight(Flight),
    /// It lies on the platform.
    Lying(Lying<End>),
    /// No further event.
    Ended,
}

impl<Flight, End> Stage<Flight, End> {
    /// The disk's mode of motion.
    pub(crate) const fn mode(&self) -> Mode {
        match self {
            Self::Flight(_) | Self::Ended => Mode::Flight,
            Self::Lying(lying) => lying.mode(),
        }
    }
}

/// The [`Stage`] on a ground.
pub(crate) type StageOn<G> = Stage<<G as Ground>::Flight, <G as Ground>::ContactEnd>;

/// The time from the last event to the next one.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Step {
    pub(crate) time: PhaseTime,
    pub(crate) span: PhaseSpan,
    /// The span in radians, not rounded by its whole periods.
    pub(crate) duration: f64,
}

/// The disk's motion from the last event up to the next one.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Passed {
    pub(crate) change: RotaryChange,
    pub(crate) ledger: EnergyLedger,
    /// The disk just before the event, without its angle, which the engine accumulates.
    pub(crate) before: DiskState,
}

/// An impact as determined by the ground.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Hit<S> {
    /// Relative velocity before.
    pub(crate) velocity: f64,
    pub(crate) restitution: f64,
    /// The stage that follows.
    pub(crate) next: S,
    /// Whether a cut removes the rebound and the disk flies at once, because the platform falls away.
    pub(crate) lets_go: bool,
}

/// The motion of a disk as a lazy sequence of [`EventRecord`]s.
///
/// The sequence ends when no further event is possible (a disk rests and sticks for ever) and after an error.
/// A disk that rests for ever may alternate between sticking and sliding without end. Two engines with the same
/// arguments produce the same bits.
///
/// On the sine the restitution is the system's constant, or follows a law ([`Self::with_law`]).
/// [`DrivenEngine`](crate::driven::DrivenEngine) is the engine on a platform with any periodic motion.
#[derive(Debug, Clone)]
pub struct Engine<G: Ground = SineGround> {
    pub(crate) system: G::System,
    /// The ground's own part of the state of the motion.
    pub(crate) ground: G,
    pub(crate) stage: StageOn<G>,
    pub(crate) now: PhaseTime,
    pub(crate) state: DiskState,
    pub(crate) angle: LongSum,
    /// If false, the ledgers of slides on a drive stay empty; a run-up does not need them.
    pub(crate) with_energy: bool,
}

impl<G: Ground> Engine<G> {
    /// An engine for a [`crate::System`], a [`DimensionlessSystem`](crate::parameters::DimensionlessSystem)
    /// or a [`DrivenSystem`](crate::driven::DrivenSystem), and a disk that starts in contact, with a launch
    /// or in the air. If the platform falls away, a disk that starts in contact flies at once; an angular
    /// speed within rounding of the platform's is set to it. The angle starts at the platform's.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] or an error of the core for an illegal start. Errors of the first event are
    /// returned with that event. There are two exceptions: a start in the air on the sine computes its first
    /// impact at once, and a start in contact on a drive computes the end of the contact.
    pub fn new<S: OnGround<Ground = G>>(
        system: S,
        start: InitialCondition,
        policy: ChatterPolicy,
    ) -> Result<Self, Error> {
        system.start(start, policy)
    }

    /// A disk that moves with the platform, before it is placed or takes off.
    pub(crate) fn begin(system: G::System, ground: G, now: PhaseTime) -> Self {
        let platform = G::platform(&system, now.phase);
        let state = DiskState {
            mode: Mode::Flight,
            height: platform.height,
            axial_velocity: platform.axial_velocity,
            angle: platform.angle,
            angular_speed: platform.angular_speed,
        };
        let angle = LongSum::new(platform.angle);
        Self { system, ground, stage: Stage::Ended, now, state, angle, with_energy: true }
    }

    /// [`Self::begin`] with the angular speed of a start.
    pub(crate) fn begin_at(system: G::System, ground: G, phase: Phase, speed: f64) -> Result<Self, Error> {
        let speed = moderate("angular_speed", speed)?;
        let mut engine = Self::begin(system, ground, PhaseTime::in_first_period(phase));
        engine.state.angular_speed = speed;
        Ok(engine)
    }

    /// The system.
    #[must_use]
    pub const fn system(&self) -> &G::System {
        &self.system
    }

    /// The instant of the last event, or of the start.
    #[must_use]
    pub const fn time(&self) -> PhaseTime {
        self.now
    }

    /// The disk's state just after the last event, or at the start.
    #[must_use]
    pub const fn state(&self) -> &DiskState {
        &self.state
    }

    /// The next event, or `None` after the last one.
    ///
    /// # Errors
    /// The errors of the core's flights and of a law of restitution; [`Error::SlipTooLong`]. An error ends
    /// the motion.
    pub fn advance(&mut self) -> Result<Option<EventRecord>, Error> {
        self.next_within(f64::INFINITY)
    }

    /// The next event if it comes within `limit` radians of the last one.
    pub(crate) fn next_within(&mut self, limit: f64) -> Result<Option<EventRecord>, Error> {
        let result = match self.stage {
            Stage::Flight(flight) => G::end_flight(self, flight, limit),
            Stage::Lying(lying) => G::end_contact(self, lying, limit),
            Stage::Ended => Ok(None),
        };
        if result.is_err() {
            self.stage = Stage::Ended;
        }
        result
    }

    /// An impact at the end of a flight, or a kick at the end of a contact; `passed` describes the motion
    /// before it.
    pub(crate) fn hit(&mut self, to: &Step, hit: Hit<StageOn<G>>, passed: Option<Passed>) -> EventRecord {
        let Hit { velocity, restitution, next, lets_go } = hit;
        let platform = G::platform(&self.system, to.time.phase);
        let kicked = passed.is_some();
        let mut passed = passed.unwrap_or_else(|| {
            let change = self.flown(to.duration);
            let before = DiskState::flying(platform.height, velocity + platform.axial_velocity, change.speed);
            let mut ledger = EnergyLedger::default();
            self.record_flight(&mut ledger, &before, &change);
            Passed { change, ledger, before }
        });
        let Passed { change, before, .. } = passed;
        let ledger = &mut passed.ledger;
        let rebound = rebound_velocity(restitution, velocity);
        let cut = lets_go && rebound > 0.0;
        let [friction, _] = G::torques(&self.system);
        let done = impact(
            ledger,
            (friction, restitution),
            [velocity, platform.axial_velocity],
            [change.speed, platform.angular_speed],
        );
        let mut axial_impulse = done.axial;
        if cut {
            axial_impulse -= rebound;
            ledger.record_normal(-rebound * platform.axial_velocity, 0.5 * rebound * rebound);
        }
        let after = DiskState {
            axial_velocity: if cut { 0.0 } else { rebound } + platform.axial_velocity,
            angular_speed: done.speed,
            ..before
        };
        record_jump(ledger, &before, &after);
        let (axial_impact_velocity, tangential_impact_velocity, capped) = (velocity, done.slip, done.capped);
        let event = if kicked {
            Event::Kick { axial_impact_velocity, tangential_impact_velocity, capped }
        } else {
            Event::Impact { axial_impact_velocity, tangential_impact_velocity, capped }
        };
        self.moved(to, event, passed, after, next, [axial_impulse, done.rotary])
    }

    /// The rotary motion of a flight.
    pub(crate) fn flown(&self, span: f64) -> RotaryChange {
        let [_, load] = G::torques(&self.system);
        change_in_flight(load, self.state.angular_speed, span)
    }

    /// Records the changes of energy from the last event to `end`, and the work of the load.
    pub(crate) fn record_flight(&self, ledger: &mut EnergyLedger, end: &DiskState, change: &RotaryChange) {
        let (start, [_, load]) = (&self.state, G::torques(&self.system));
        ledger.record_axial_change([start.axial_velocity, end.axial_velocity], [start.height, end.height]);
        record_flight_load(ledger, load, start.angular_speed, change);
    }

    /// The record of an event with these impulses. It leaves the engine at the event with the disk in the
    /// state `after`; the angle is accumulated here, and the mode follows from the `next` stage.
    pub(crate) fn moved(
        &mut self,
        to: &Step,
        event: Event,
        passed: Passed,
        mut after: DiskState,
        next: StageOn<G>,
        [axial_impulse, angular_impulse]: [f64; 2],
    ) -> EventRecord {
        let Passed { change, ledger, mut before } = passed;
        self.angle.add(change.angle);
        before.angle = self.angle.value();
        after.angle = before.angle;
        after.mode = next.mode();
        let segment = self.segment(None);
        (self.now, self.state, self.stage) = (to.time, after, next);
        EventRecord {
            time: to.time,
            event,
            before,
            after,
            axial_impulse,
            angular_impulse,
            ledger,
            segment,
            span: to.span,
        }
    }

    pub(crate) const fn segment(&self, chatter_speed: Option<f64>) -> Segment {
        Segment { start: self.now, state: self.state, chatter_speed }
    }
}

/// Records a jump of the velocities at constant height.
pub(crate) fn record_jump(ledger: &mut EnergyLedger, before: &DiskState, after: &DiskState) {
    ledger.record_axial_change([before.axial_velocity, after.axial_velocity], [before.height, after.height]);
    ledger.record_rotary_change(before.angular_speed, after.angular_speed);
}

impl<G: Ground> Motion for Engine<G> {
    type Record = EventRecord;

    fn time(&self) -> PhaseTime {
        self.now
    }

    fn disk(&self) -> DiskState {
        self.state
    }

    fn advance(&mut self) -> Result<Option<EventRecord>, Error> {
        self.advance()
    }

    fn lies_for_ever(&self) -> bool {
        matches!(self.stage, Stage::Lying(Lying { end: None, .. }) | Stage::Ended)
    }
}

impl<G: Ground> Iterator for Engine<G> {
    type Item = Result<EventRecord, Error>;

    fn next(&mut self) -> Option<Self::Item> {
        self.advance().transpose()
    }
}
