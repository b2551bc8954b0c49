//! The ground of Eq. (1), a platform that moves sinusoidally.
//!
//! The vertical half of Eq. (2) comes entirely from the core's [`Orbit`] (for the parabola of a flight see
//! its `flight/gap.rs`). The rotary half (`rotary_change.rs`) and the changes between sticking and sliding
//! (`contact_motion.rs`) are closed forms.

use bouncing_disk_core::map::{Constant, RestitutionLaw};
use bouncing_disk_core::{
    Attachment, ChatterCut, ChatterPolicy, ImpactMap, Launch, Orbit, OrbitEvent, Phase,
};

use super::{Engine, Ground, Hit, OnGround, Passed, Stage, Step, record_jump};
use crate::error::Error;
use crate::motion::chatter::Chatter;
use crate::motion::contact_motion::{ContactStep, Lying, Placed};
use crate::motion::energy::EnergyLedger;
use crate::motion::event::{Event, EventRecord};
use crate::motion::friction::Friction;
use crate::motion::impact_energy::record_friction_impulse;
use crate::motion::initial_condition::InitialCondition;
use crate::motion::phase_time::{PhaseSpan, PhaseTime};
use crate::motion::rotary_change::{RotaryChange, change_in_flight, contact_ledger, record_flight_load};
use crate::motion::segment::Segment;
use crate::motion::state::{DiskState, LongSum, PlatformState, SlipDirection, Snapshot};
use crate::parameters::dimensionless::DimensionlessSystem;

/// A platform that moves sinusoidally, with a law of restitution.
#[derive(Debug, Clone)]
pub struct SineGround<L = Constant> {
    friction: Friction,
    /// `None` for a disk that has lain on the platform from the start and never separates.
    pub(super) orbit: Option<Orbit<L>>,
}

impl<S: TryInto<DimensionlessSystem, Error: Into<Error>>> OnGround for S {
    type Ground = SineGround;

    fn start(self, start: InitialCondition, policy: ChatterPolicy) -> Result<Engine, Error> {
        let system = self.try_into().map_err(Into::into)?;
        Engine::with_map(system, system.map(), start, policy)
    }
}

impl<L: RestitutionLaw> Engine<SineGround<L>> {
    /// An engine for a system whose restitution follows a `law`; the system's constant one is ignored. A
    /// chatter ends by a `cut`, whose error (rad) is reported in [`Event::Attachment`]; the error is infinite
    /// if no bound is known.
    ///
    /// The law's speeds are dimensionless, in units of g/omega: divide a speed in m/s by
    /// [`Scales::velocity`](crate::parameters::Scales::velocity).
    ///
    /// ```
    /// use bouncing_disk::core::map::KuwabaraKono;
    /// use bouncing_disk::{Engine, InitialCondition, System};
    /// use bouncing_disk::motion::PAPER_CUT;
    ///
    /// // The dough has its usual restitution at 1 m/s, and a higher one in slower impacts.
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
    /// The errors of [`Engine::new`].
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
        let (phase, speed, _) = start.parts();
        let ground = SineGround { friction: Friction::new(&system), orbit: None };
        let mut engine = Self::begin_at(system, ground, phase, speed)?;
        engine.stage = Stage::Flight(());
        match start {
            InitialCondition::Contact { .. } => {
                let friction = &engine.ground.friction;
                let placed = Placed::new(&system, map, friction, phase, speed, policy)?;
                engine.ground.orbit = placed.orbit;
                engine.state.angular_speed = placed.speed;
                if let Some(lying) = placed.lying {
                    engine.state.mode = lying.mode();
                    engine.stage = Stage::Lying(lying);
                }
            }
            InitialCondition::Launch { relative_speed, .. } => {
                let launch = Launch::new(phase, relative_speed)?;
                engine.ground.orbit = Some(map.orbit_from_launch(launch, policy));
                engine.state.axial_velocity += relative_speed;
            }
            InitialCondition::Flight { gap, relative_velocity, .. } => {
                engine.ground.orbit = Some(map.orbit_from_drop(phase, gap, relative_velocity, policy)?);
                engine.state.height += gap;
                engine.state.axial_velocity += relative_velocity;
            }
        }
        Ok(engine)
    }

    /// Disk and platform `span` after the last event, assuming that no event comes before.
    #[must_use]
    pub fn state_after(&self, span: PhaseSpan) -> Snapshot {
        self.segment(None).state_after(&self.system, span)
    }

    /// The energy balance of an unfinished or endless segment: from the last event, or the start, to `span`
    /// later, assuming that no event comes before. Together with the ledgers of the previous events, it is the
    /// balance up to any instant.
    ///
    /// ```
    /// use bouncing_disk::core::{ChatterPolicy, Phase};
    /// use bouncing_disk::{Engine, InitialCondition, System};
    /// use bouncing_disk::motion::PhaseSpan;
    ///
    /// // A disk that turns on a platform at rest brakes, without any event before it stops.
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
        let orbit = self.ground.orbit.as_ref();
        matches!(self.stage, Stage::Flight(())) && orbit.is_some_and(|orbit| orbit.launch().is_some())
    }

    /// Sets the relative speed >= 0, in units of g/omega, of a flight that starts now ([`Self::launches`]);
    /// does nothing at any other time. No ledger includes the energy of this kick.
    ///
    /// # Errors
    /// An error of the core for a negative or non-finite speed.
    pub fn perturb_launch(&mut self, relative_speed: f64) -> Result<(), Error> {
        if self.launches()
            && let Some(orbit) = &mut self.ground.orbit
        {
            orbit.perturb_launch(relative_speed)?;
            self.state.axial_velocity = self.system.vibration().velocity(self.now.phase) + relative_speed;
        }
        Ok(())
    }

    /// Brings the disk to rest after an impact at `now` that left it in `state`, with the chatter and the
    /// attachment that ends it, for a vertical motion computed elsewhere. The angle is counted from `state`.
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
        self.attach(rest, chatter)
    }

    /// The next event and the segment that it ends. Without a next event, the segment lasts until `end`: for
    /// ever, or in a slip whose end is too far away for its phase to be resolved.
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

    fn attach(&mut self, rest: &Attachment, chatter: &Chatter) -> EventRecord {
        let (system, accumulation, cut) = (&self.system, rest.accumulation, is_cut(rest));
        let (start, duration) = (self.state, accumulation.duration);
        let change = change_in_flight(system.load(), chatter.angular_speed, duration - chatter.time);
        let platform = PlatformState::at(system, accumulation.phase);
        let mut ledger = chatter.ledger;
        record_flight_load(&mut ledger, system.load(), chatter.angular_speed, &change);
        let before = DiskState::flying(
            platform.height,
            if cut { start.axial_velocity } else { platform.axial_velocity },
            change.speed,
        );
        ledger.record_axial_change(
            [start.axial_velocity, before.axial_velocity],
            [start.height, before.height],
        );
        let mut axial_impulse = chatter.axial_impulse;
        let mut angular_impulse = chatter.angular_impulse;
        let mut angular_speed = change.speed;
        if cut {
            let speed = rest.last_speed;
            axial_impulse -= speed;
            ledger.record_normal(-speed * platform.axial_velocity, 0.5 * speed * speed);
        }
        if chatter.capped {
            // The sequence is infinite: after the last counted impact the disk follows the platform.
            let slip = angular_speed - platform.angular_speed;
            angular_speed = platform.angular_speed;
            angular_impulse -= slip;
            record_friction_impulse(&mut ledger, -slip, slip, platform.angular_speed);
        }
        let time = PhaseTime { periods: self.now.periods + accumulation.turns, phase: accumulation.phase };
        let lying = Lying::after_attachment(system, &self.ground.friction, time, angular_speed, rest);
        let after = DiskState { axial_velocity: platform.axial_velocity, angular_speed, ..before };
        record_jump(&mut ledger, &before, &after);
        ledger.record_rounding(system.peak_acceleration(), platform.axial_velocity);

        let step = Step { time, span: PhaseSpan { periods: 0, remainder: duration }, duration };
        let event = Event::Attachment { impacts: chatter.impacts, error_bound: accumulation.error_bound };
        let change = RotaryChange { angle: chatter.angle + change.angle, ..change };
        let passed = Passed { change, ledger, before };
        let mut record =
            self.moved(&step, event, passed, after, Stage::Lying(lying), [axial_impulse, angular_impulse]);
        record.segment.chatter_speed = (!cut).then_some(rest.last_speed);
        record
    }

    /// The record of a step of contact, with its energy.
    fn record_contact(&mut self, slip: Option<SlipDirection>, step: &ContactStep) -> EventRecord {
        let ContactStep { time, span, change, .. } = *step;
        let (system, phases) = (&self.system, (self.now.phase, time.phase));
        let mut ledger = contact_ledger(system, &self.ground.friction, &self.state, phases, span, &change);
        let before = DiskState {
            mode: self.state.mode,
            height: system.vibration().height(time.phase),
            axial_velocity: system.vibration().velocity(time.phase),
            angle: 0.0,
            angular_speed: step.speed,
        };
        let event = match (slip, step.next.map(|next| next.slip)) {
            (_, None) => Event::Separation,
            (None, Some(Some(direction))) => Event::StickToSlip(direction),
            (_, Some(None)) => Event::SlipToStick,
            (Some(_), Some(Some(direction))) => Event::SlipReversal(direction),
        };
        if matches!(event, Event::SlipToStick | Event::SlipReversal(_)) {
            // The rounding difference between the disk's speed at the end of a slip and the platform's.
            let slip = change.speed - step.speed;
            record_friction_impulse(&mut ledger, -slip, slip, step.speed);
            ledger.record_rotary_change(change.speed, step.speed);
        }
        let next = step.next.map_or(Stage::Flight(()), Stage::Lying);
        let to = Step { time, span, duration: span.radians() };
        self.moved(&to, event, Passed { change, ledger, before }, before, next, [0.0; 2])
    }
}

impl<L: RestitutionLaw> Ground for SineGround<L> {
    type System = DimensionlessSystem;
    type Flight = ();
    type ContactEnd = PhaseTime;

    fn platform(system: &DimensionlessSystem, phase: Phase) -> PlatformState {
        PlatformState::at(system, phase)
    }

    fn torques(system: &DimensionlessSystem) -> [f64; 2] {
        [system.friction(), system.load()]
    }

    fn end_flight(engine: &mut Engine<Self>, (): (), _: f64) -> Result<Option<EventRecord>, Error> {
        let (now, spin) = (engine.now, engine.state.angular_speed);
        let event = match &mut engine.ground.orbit {
            Some(orbit) => orbit.advance()?.map(|event| (event, orbit)),
            None => None,
        };
        match event {
            Some((OrbitEvent::Impact(impact), orbit)) => {
                let span = PhaseSpan { periods: impact.periods, remainder: impact.remainder };
                let time = PhaseTime { periods: now.periods + impact.turns, phase: impact.phase };
                let hit = Hit {
                    velocity: impact.velocity,
                    restitution: Orbit::map(orbit).restitution_at(0.0 - impact.velocity)?,
                    next: Stage::Flight(()),
                    lets_go: orbit.launch().is_some_and(|launch| launch.relative_speed() <= 0.0),
                };
                Ok(Some(engine.hit(&Step { time, span, duration: span.radians() }, hit, None)))
            }
            Some((OrbitEvent::Attachment(rest), _)) => {
                let duration = rest.accumulation.duration;
                let chatter = Chatter::new(&engine.system, now.phase, chatter_speed(&rest), spin, duration);
                Ok(Some(engine.attach(&rest, &chatter)))
            }
            Some(_) | None => {
                engine.stage = Stage::Ended;
                Ok(None)
            }
        }
    }

    fn end_contact(engine: &mut Engine<Self>, lying: Lying, _: f64) -> Result<Option<EventRecord>, Error> {
        let speed = engine.state.angular_speed;
        let step = lying.next(&engine.system, &engine.ground.friction, engine.now, speed)?;
        if step.is_none() {
            engine.stage = Stage::Ended;
        }
        Ok(step.map(|step| engine.record_contact(lying.slip, &step)))
    }
}

/// Whether the chatter is cut: a summed chatter has a duration, a cut one leaves a speed.
fn is_cut(rest: &Attachment) -> bool {
    rest.accumulation.duration <= 0.0 && rest.last_speed > 0.0
}

/// The launch speed of a summed chatter; the paper's cut removes the last speed by a separate impulse.
pub(crate) fn chatter_speed(rest: &Attachment) -> f64 {
    if is_cut(rest) { 0.0 } else { rest.last_speed }
}

#[cfg(test)]
mod chatter_tests;
#[cfg(test)]
mod law_tests;
#[cfg(test)]
mod tests;
