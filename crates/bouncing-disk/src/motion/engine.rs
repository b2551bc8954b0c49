//! The event engine: flight, impact, attachment, sticking, sliding, separation. It integrates the equations
//! of motion, Eq. (2), from event to event in closed form.
//!
//! The vertical half of Eq. (2) comes entirely from the core's [`Orbit`] (its `flight/gap.rs` has the
//! parabola of a flight); the engine adds the rotary half (`rotary_change.rs`) and the changes between
//! sticking and sliding while the disk is on the platform (`contact_motion.rs`).

pub(crate) mod sample;

use bouncing_disk_core::map::{Constant, RestitutionLaw};
use bouncing_disk_core::{
    Attachment, ChatterCut, ChatterPolicy, Impact, ImpactMap, Launch, Orbit, OrbitEvent,
};

use crate::error::{Error, moderate};
use crate::motion::chatter::{Chatter, ImpactEnergy, record_impact};
use crate::motion::contact_motion::{Contact, ContactEvent, ContactStep, Placed};
use crate::motion::energy::EnergyLedger;
use crate::motion::event::{Event, EventRecord, Motion};
use crate::motion::friction::Friction;
use crate::motion::impact::{axial_impulse, friction_impact, rebound_velocity};
use crate::motion::initial_condition::InitialCondition;
use crate::motion::phase_time::{PhaseSpan, PhaseTime};
use crate::motion::rotary_change::RotaryChange;
use crate::motion::rotary_change::{change_in_flight, contact_ledger, record_flight_load};
use crate::motion::segment::Segment;
use crate::motion::state::{DiskState, LongSum, Mode, Snapshot};
use crate::parameters::dimensionless::DimensionlessSystem;

/// Where the motion goes next.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Stage {
    /// The orbit knows the next event.
    Flight,
    /// On the platform until it falls away, if ever.
    Contact(Contact),
    /// Nothing more happens.
    Ended,
}

/// The motion of a disk as a lazy sequence of [`EventRecord`]s.
///
/// The sequence ends where nothing more can happen (a disk that rests and sticks for ever) and after an
/// error. A disk that rests for ever may alternate between sticking and sliding for ever. Two engines with
/// the same arguments give the same bits.
///
/// The restitution is the system's, a constant, or follows a law ([`Self::with_law`]).
#[derive(Debug, Clone)]
pub struct Engine<L = Constant> {
    system: DimensionlessSystem,
    friction: Friction,
    /// `None` for a disk that has lain on the platform from the start and never separates.
    orbit: Option<Orbit<L>>,
    stage: Stage,
    now: PhaseTime,
    state: DiskState,
    angle: LongSum,
}

impl Engine {
    /// An engine for a [`crate::System`] or a [`DimensionlessSystem`] one.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] or an error of the core for an illegal start; the first event's own errors come
    /// with that event, except that a start in the air computes its first impact at once.
    pub fn new(
        system: impl TryInto<DimensionlessSystem, Error: Into<Error>>,
        start: InitialCondition,
        policy: ChatterPolicy,
    ) -> Result<Self, Error> {
        let system = system.try_into().map_err(Into::into)?;
        Self::with_map(system, system.map(), start, policy)
    }
}

impl<L: RestitutionLaw> Engine<L> {
    /// An engine for a system whose restitution follows a `law`; the constant one of the system is ignored. A
    /// chatter ends by a `cut`, whose error (rad) is that of the [`Event::Attachment`]: infinite where no
    /// bound is known.
    ///
    /// The law takes dimensionless speeds, in g/omega: divide a speed in m/s by
    /// [`Scales::velocity`](crate::parameters::Scales::velocity).
    ///
    /// ```
    /// use bouncing_disk::core::map::KuwabaraKono;
    /// use bouncing_disk::{Engine, InitialCondition, System};
    /// use bouncing_disk::motion::PAPER_CUT;
    ///
    /// // The dough keeps its restitution at 1 m/s, and has a higher one in slower impacts.
    /// let system = System::pizza_toss();
    /// let law = KuwabaraKono::new(system.disk().restitution(), 1.0 / system.scales().velocity)?;
    /// let start = InitialCondition::Contact { phase: bouncing_disk::core::Phase::new(0.0)?, angular_speed: 0.0 };
    /// let engine = Engine::with_law(system, law, start, PAPER_CUT)?;
    /// for record in engine.take(100) {
    ///     assert!(record?.ledger.relative_closure() < 1e-12);
    /// }
    /// # Ok::<(), bouncing_disk::Error>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`Engine::new`].
    pub fn with_law(
        system: impl TryInto<DimensionlessSystem, Error: Into<Error>>,
        law: L,
        start: InitialCondition,
        cut: ChatterCut,
    ) -> Result<Self, Error> {
        let system = system.try_into().map_err(Into::into)?;
        let map = ImpactMap::with_law(*system.vibration(), law);
        Self::with_map(system, &map, start, ChatterPolicy::Cut(cut))
    }

    fn with_map(
        system: DimensionlessSystem,
        map: &ImpactMap<L>,
        start: InitialCondition,
        policy: ChatterPolicy,
    ) -> Result<Self, Error> {
        let (phase, speed) = match start {
            InitialCondition::Contact { phase, angular_speed }
            | InitialCondition::Launch { phase, angular_speed, .. }
            | InitialCondition::Flight { phase, angular_speed, .. } => (phase, angular_speed),
        };
        moderate("angular_speed", speed)?;
        let angle = system.platform_angle(phase);
        let mut engine = Self {
            system,
            friction: Friction::new(&system),
            orbit: None,
            stage: Stage::Flight,
            now: PhaseTime::in_first_period(phase),
            state: DiskState {
                mode: Mode::Flight,
                height: system.vibration().height(phase),
                axial_velocity: system.vibration().velocity(phase),
                angle,
                angular_speed: speed,
            },
            angle: LongSum::new(angle),
        };
        match start {
            InitialCondition::Contact { .. } => engine.start_in_contact(map, policy)?,
            InitialCondition::Launch { relative_speed, .. } => {
                engine.orbit = Some(map.orbit_from_launch(Launch::new(phase, relative_speed)?, policy));
                engine.state.axial_velocity += relative_speed;
            }
            InitialCondition::Flight { gap, relative_velocity, .. } => {
                engine.orbit = Some(map.orbit_from_drop(phase, gap, relative_velocity, policy)?);
                engine.state.height += gap;
                engine.state.axial_velocity += relative_velocity;
            }
        }
        Ok(engine)
    }

    fn start_in_contact(&mut self, map: &ImpactMap<L>, policy: ChatterPolicy) -> Result<(), Error> {
        let placed = Placed::with_map(
            &self.system,
            map,
            &self.friction,
            self.now.phase,
            self.state.angular_speed,
            policy,
        )?;
        self.orbit = placed.orbit;
        self.state.angular_speed = placed.speed;
        if let Some(contact) = placed.contact {
            self.state.mode = contact.mode();
            self.stage = Stage::Contact(contact);
        }
        Ok(())
    }

    /// The system.
    #[must_use]
    pub const fn system(&self) -> &DimensionlessSystem {
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

    /// Disk and platform `span` after the last event, on the assumption that the next event does not come
    /// before.
    #[must_use]
    pub fn state_after(&self, span: PhaseSpan) -> Snapshot {
        self.segment(None).state_after(&self.system, span)
    }

    /// The energy balance from the last event, or the start, to `span` later, on the assumption that the next
    /// event does not come before: that of an unfinished or endless segment. Added to the ledgers of the
    /// events before, it gives the balance up to any instant.
    ///
    /// ```
    /// use bouncing_disk::core::{ChatterPolicy, Phase};
    /// use bouncing_disk::{Engine, InitialCondition, System};
    /// use bouncing_disk::motion::PhaseSpan;
    ///
    /// // A disk that turns on a platform at rest brakes, and nothing happens before it stops.
    /// let still = System::pizza_toss().with_platform(|hand| (hand.amplitude, hand.twist_amplitude) = (0.0, 0.0))?;
    /// let start = InitialCondition::Contact { phase: Phase::new(0.0)?, angular_speed: 20.0 };
    /// let engine = Engine::new(still, start, ChatterPolicy::Complete)?;
    /// let ledger = engine.ledger_after(PhaseSpan { periods: 1, remainder: 0.0 });
    /// assert!(ledger.friction_loss > 0.0 && ledger.relative_closure() < 1e-12);
    /// # Ok::<(), bouncing_disk::Error>(())
    /// ```
    #[must_use]
    pub fn ledger_after(&self, span: PhaseSpan) -> EnergyLedger {
        self.segment(None).ledger_after(&self.system, span)
    }

    /// Whether the next event is the impact of a flight that starts now: just after a separation or an impact
    /// that does not end in an attachment, or at a start by launch.
    #[must_use]
    pub fn launches(&self) -> bool {
        self.stage == Stage::Flight && self.orbit.as_ref().is_some_and(|orbit| orbit.launch().is_some())
    }

    /// Gives a flight that starts now ([`Self::launches`]) another relative speed >= 0, in units of g/omega;
    /// does nothing at any other time. No ledger counts the energy of this kick.
    ///
    /// # Errors
    /// An error of the core for a negative or non-finite speed.
    pub fn perturb_launch(&mut self, relative_speed: f64) -> Result<(), Error> {
        if self.launches()
            && let Some(orbit) = &mut self.orbit
        {
            orbit.perturb_launch(relative_speed)?;
            self.state.axial_velocity = self.system.vibration().velocity(self.now.phase) + relative_speed;
        }
        Ok(())
    }

    /// Comes to rest after an impact at `now` which left the disk in `state`, with the chatter and the
    /// attachment that ends it: for those who compute the vertical motion elsewhere. The angle is counted from
    /// that of `state`.
    pub(crate) fn rest_after(
        &mut self,
        now: PhaseTime,
        state: DiskState,
        rest: &Attachment,
        chatter: &Chatter,
    ) -> EventRecord {
        self.now = now;
        self.state = state;
        self.angle = LongSum::new(state.angle);
        self.attach_after(rest, chatter)
    }

    /// Lets a contact without end end at `time`, with an event [`Event::Separation`].
    pub(crate) fn pause_at(&mut self, time: PhaseTime) {
        if let Stage::Contact(contact) = &mut self.stage {
            contact.separation = Some(time);
        }
    }

    /// The next event, or `None` after the last one.
    ///
    /// # Errors
    /// Those of the core's flights and of a law of restitution; [`Error::SlipTooLong`]. An error ends the
    /// motion.
    pub fn advance(&mut self) -> Result<Option<EventRecord>, Error> {
        let result = match self.stage {
            Stage::Flight => self.advance_flight(),
            Stage::Contact(contact) => self.advance_contact(contact),
            Stage::Ended => Ok(None),
        };
        if !matches!(result, Ok(Some(_))) {
            self.stage = Stage::Ended;
        }
        result
    }

    fn advance_flight(&mut self) -> Result<Option<EventRecord>, Error> {
        let Some(orbit) = &mut self.orbit else { return Ok(None) };
        Ok(match orbit.advance()? {
            Some(OrbitEvent::Impact(impact)) => {
                let restitution = Orbit::map(orbit).restitution_at(0.0 - impact.velocity)?;
                Some(self.hit(&impact, restitution))
            }
            Some(OrbitEvent::Attachment(rest)) => Some(self.attach(&rest)),
            Some(_) | None => None,
        })
    }

    fn hit(&mut self, impact: &Impact, restitution: f64) -> EventRecord {
        let system = &self.system;
        let span = PhaseSpan { periods: impact.periods, remainder: impact.remainder };
        let change = change_in_flight(system.load(), self.state.angular_speed, span.radians());
        let platform_velocity = system.vibration().velocity(impact.phase);
        let platform_speed = system.platform_angular_speed(impact.phase);
        let slip = change.speed - platform_speed;
        let mut axial = axial_impulse(restitution, impact.velocity);
        let rotary = friction_impact(system.friction(), axial, slip);
        let rebound = rebound_velocity(restitution, impact.velocity);
        // Where the platform falls away, the paper's cut takes the rebound and lets the disk go at once.
        let launch = self.orbit.as_ref().and_then(Orbit::launch);
        let cut = launch.is_some_and(|launch| launch.relative_speed() <= 0.0 && rebound > 0.0);
        let rebound_left = if cut { 0.0 } else { rebound };

        let segment = self.segment(None);
        self.angle.add(change.angle);
        let before = DiskState {
            mode: Mode::Flight,
            height: system.vibration().height(impact.phase),
            axial_velocity: impact.velocity + platform_velocity,
            angle: self.angle.value(),
            angular_speed: change.speed,
        };
        let after = DiskState {
            axial_velocity: rebound_left + platform_velocity,
            angular_speed: rotary.speed_after(change.speed, platform_speed),
            ..before
        };

        let mut ledger = EnergyLedger::default();
        let start = segment.state;
        ledger.record_axial_change(
            [start.axial_velocity, before.axial_velocity],
            [start.height, before.height],
        );
        record_flight_load(&mut ledger, system, start.angular_speed, &change);
        record_impact(
            &mut ledger,
            ImpactEnergy {
                axial,
                relative_velocity: impact.velocity,
                restitution,
                platform_velocity,
                rotary: rotary.impulse,
                slip,
                platform_speed,
            },
        );
        if cut {
            axial -= rebound;
            ledger.record_normal(-rebound * platform_velocity, 0.5 * rebound * rebound);
        }
        record_jump(&mut ledger, &before, &after);

        let time = PhaseTime { periods: self.now.periods + impact.turns, phase: impact.phase };
        let event = Event::Impact {
            axial_impact_velocity: impact.velocity,
            tangential_impact_velocity: slip,
            capped: rotary.capped,
        };
        self.moved_to(time, &after);
        EventRecord {
            time,
            event,
            before,
            after,
            axial_impulse: axial,
            angular_impulse: rotary.impulse,
            ledger,
            segment,
            span,
        }
    }

    fn attach(&mut self, rest: &Attachment) -> EventRecord {
        let (speed, spin) = (chatter_speed(rest), self.state.angular_speed);
        let duration = rest.accumulation.duration;
        let chatter = Chatter::new(&self.system, self.now.phase, speed, spin, duration);
        self.attach_after(rest, &chatter)
    }

    fn attach_after(&mut self, rest: &Attachment, chatter: &Chatter) -> EventRecord {
        let system = &self.system;
        let accumulation = rest.accumulation;
        let cut = is_cut(rest);
        let segment = self.segment((!cut).then_some(rest.last_speed));
        let duration = accumulation.duration;
        let change = change_in_flight(system.load(), chatter.angular_speed, duration - chatter.time);
        let platform_speed = system.platform_angular_speed(accumulation.phase);
        let platform_velocity = system.vibration().velocity(accumulation.phase);
        let mut ledger = chatter.ledger;
        record_flight_load(&mut ledger, system, chatter.angular_speed, &change);

        self.angle.add(chatter.angle + change.angle);
        let start = segment.state;
        let before = DiskState {
            mode: Mode::Flight,
            height: system.vibration().height(accumulation.phase),
            axial_velocity: if cut { start.axial_velocity } else { platform_velocity },
            angle: self.angle.value(),
            angular_speed: change.speed,
        };
        ledger.record_axial_change(
            [start.axial_velocity, before.axial_velocity],
            [start.height, before.height],
        );
        let mut axial = chatter.axial_impulse;
        let mut rotary = chatter.angular_impulse;
        let mut angular_speed = change.speed;
        if cut {
            let speed = rest.last_speed;
            axial -= speed;
            ledger.record_normal(-speed * platform_velocity, 0.5 * speed * speed);
        }
        if chatter.capped {
            // The sequence is infinite: after the last counted impact the disk follows the platform.
            let slip = angular_speed - platform_speed;
            angular_speed = platform_speed;
            rotary -= slip;
            let rest = ImpactEnergy {
                axial: 0.0,
                relative_velocity: 0.0,
                restitution: system.restitution(),
                platform_velocity,
                rotary: -slip,
                slip,
                platform_speed,
            };
            record_impact(&mut ledger, rest);
        }
        let time = PhaseTime { periods: self.now.periods + accumulation.turns, phase: accumulation.phase };
        let contact = Contact::after_attachment(system, &self.friction, time, angular_speed, rest);
        let after =
            DiskState { mode: contact.mode(), axial_velocity: platform_velocity, angular_speed, ..before };
        record_jump(&mut ledger, &before, &after);
        ledger.record_rounding(system.peak_acceleration(), platform_velocity);

        self.moved_to(time, &after);
        self.stage = Stage::Contact(contact);
        EventRecord {
            time,
            event: Event::Attachment { impacts: chatter.impacts, error_bound: accumulation.error_bound },
            before,
            after,
            axial_impulse: axial,
            angular_impulse: rotary,
            ledger,
            segment,
            span: PhaseSpan { periods: 0, remainder: duration },
        }
    }

    fn advance_contact(&mut self, contact: Contact) -> Result<Option<EventRecord>, Error> {
        let step = contact.next(&self.system, &self.friction, self.now, self.state.angular_speed)?;
        Ok(step.map(|step| self.record_contact(contact, &step)))
    }

    /// The record of a step of contact, and the energy of it.
    fn record_contact(&mut self, contact: Contact, step: &ContactStep) -> EventRecord {
        let system = &self.system;
        let ContactStep { time, span, change, .. } = *step;
        let segment = self.segment(None);
        let phases = (self.now.phase, time.phase);
        let mut ledger = contact_ledger(system, &self.friction, &segment.state, phases, span, &change);
        self.angle.add(change.angle);
        let before = DiskState {
            mode: segment.state.mode,
            height: system.vibration().height(time.phase),
            axial_velocity: system.vibration().velocity(time.phase),
            angle: self.angle.value(),
            angular_speed: step.speed,
        };
        let event = match step.event {
            ContactEvent::Separation => Event::Separation,
            ContactEvent::StickToSlip(direction) => Event::StickToSlip(direction),
            ContactEvent::SlipToStick => Event::SlipToStick,
            ContactEvent::SlipReversal(direction) => Event::SlipReversal(direction),
        };
        if matches!(event, Event::SlipToStick | Event::SlipReversal(_)) {
            self.settle(&mut ledger, change, step.speed);
        }
        let next = contact.after(step.event);
        let after = DiskState { mode: next.map_or(Mode::Flight, |next| next.mode()), ..before };
        self.moved_to(time, &after);
        self.stage = next.map_or(Stage::Flight, Stage::Contact);
        EventRecord {
            time,
            event,
            before,
            after,
            axial_impulse: 0.0,
            angular_impulse: 0.0,
            ledger,
            segment,
            span,
        }
    }

    /// Records what rounding has left between the disk's speed at the end of a slip and the platform's.
    fn settle(&self, ledger: &mut EnergyLedger, change: RotaryChange, platform_speed: f64) {
        let slip = change.speed - platform_speed;
        let rest = ImpactEnergy {
            axial: 0.0,
            relative_velocity: 0.0,
            restitution: self.system.restitution(),
            platform_velocity: 0.0,
            rotary: -slip,
            slip,
            platform_speed,
        };
        record_impact(ledger, rest);
        ledger.record_rotary_change(change.speed, platform_speed);
    }

    /// The next event with the segment that it ends; without one, the segment that lasts until `end`: for
    /// ever, or by a slip whose own end is further off than its phase can be resolved.
    pub(crate) fn advance_towards(
        &mut self,
        end: &PhaseTime,
    ) -> Result<(Segment, Option<EventRecord>), Error> {
        let lasting = self.segment(None);
        match self.advance() {
            Ok(record) => Ok((record.map_or(lasting, |record| record.segment), record)),
            Err(Error::SlipTooLong { limit, .. }) if end.since(&lasting.start).radians() <= limit => {
                Ok((lasting, None))
            }
            Err(error) => Err(error),
        }
    }

    const fn segment(&self, chatter_speed: Option<f64>) -> Segment {
        Segment { start: self.now, state: self.state, chatter_speed }
    }

    fn moved_to(&mut self, time: PhaseTime, state: &DiskState) {
        self.now = time;
        self.state = *state;
    }
}

/// A chatter that is summed lasts; one that is cut leaves a speed.
fn is_cut(rest: &Attachment) -> bool {
    rest.accumulation.duration <= 0.0 && rest.last_speed > 0.0
}

/// The launch speed of the chatter that is summed: the paper's cut takes the last one away by an impulse of
/// its own.
pub(crate) fn chatter_speed(rest: &Attachment) -> f64 {
    if is_cut(rest) { 0.0 } else { rest.last_speed }
}

/// Records a jump of the velocities at one height.
pub(crate) fn record_jump(ledger: &mut EnergyLedger, before: &DiskState, after: &DiskState) {
    ledger.record_axial_change([before.axial_velocity, after.axial_velocity], [before.height, after.height]);
    ledger.record_rotary_change(before.angular_speed, after.angular_speed);
}

impl<L: RestitutionLaw> Motion for Engine<L> {
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
        matches!(self.stage, Stage::Contact(Contact { separation: None, .. }) | Stage::Ended)
    }
}

impl<L: RestitutionLaw> Iterator for Engine<L> {
    type Item = Result<EventRecord, Error>;

    fn next(&mut self) -> Option<Self::Item> {
        self.advance().transpose()
    }
}

#[cfg(test)]
mod chatter_tests;
#[cfg(test)]
mod law_tests;
#[cfg(test)]
mod tests;
