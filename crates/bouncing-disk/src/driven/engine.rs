//! The event engine on a driven platform.

use std::f64::consts::TAU;

use bouncing_disk_core::chatter::{AfterImpact, ShortFlightCount};
use bouncing_disk_core::flight::{
    Branch, ChatterDuration, ContactEnd, MAX_FLIGHT_DURATION, Pressed, RelativeState, TimeAhead, Touch,
};
use bouncing_disk_core::numerics::elementary::wrapped_angle;
use bouncing_disk_core::{ChatterPolicy, Drive};

use super::contact::{Ride, Touching};
use super::{DrivenStart, DrivenSystem};
use crate::error::{Error, moderate};
use crate::motion::contact_motion::SAME_SPEED;
use crate::motion::energy::EnergyLedger;
use crate::motion::engine::record_jump;
use crate::motion::event::{Energies, Event, EventRecord, Motion, SteeredMotion};
use crate::motion::impact::rebound_velocity;
use crate::motion::phase_time::{PhaseSpan, PhaseTime, phase_at};
use crate::motion::rotary_change::{RotaryChange, change_in_flight};
use crate::motion::segment::Segment;
use crate::motion::state::{DiskState, LongSum, Mode, SlipDirection};
use crate::motion::stator_ledger::StatorLedger;

/// Events of friction that come this much before the end of a contact, relative to its time, are the end
/// itself: both times are roots, each with an error of some roundings of the time.
const JOINT: f64 = 16.0 * f64::EPSILON;

/// A height or velocity of a resumed disk that differs from the platform's by this share is the platform's:
/// the change of units and the evaluation of the drive leave some roundings each.
const SAME_PLACE: f64 = 1.0e-12;

/// What the disk does until the next event.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Stage {
    /// It flies, from this far above the platform and with this velocity relative to it.
    Flight {
        gap: f64,
        velocity: f64,
    },
    /// It leaves a contact that ends by a force that falls to zero.
    Separated,
    /// It chatters from this launch speed to the rest.
    Chatter {
        speed: f64,
        chatter: ChatterDuration,
    },
    /// A cut puts it on the platform.
    Cut {
        speed: f64,
        error: f64,
    },
    /// It lies on the platform.
    Contact(Contact),
    Ended,
}

#[derive(Debug, Clone, Copy, PartialEq)]
struct Contact {
    slip: Option<SlipDirection>,
    end: Option<TimeAhead>,
    /// What follows the end.
    then: Then,
}

/// What follows the end of a contact.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Then {
    /// The disk leaves, or is hit.
    Leaves,
    /// The transient of a contact that takes time is over: the disk never leaves.
    Settles,
    /// The spring of such a contact does this.
    Turns(Branch),
}

/// The instant of an event, for the drive and for the record.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Clock {
    /// Time of the drive, in [0, 2 pi).
    at: f64,
    periods: u64,
}

/// The motion of a disk on a driven platform, as a lazy sequence of [`EventRecord`]s.
///
/// The sequence ends where nothing more can happen, and after an error. A disk that rests for ever on a
/// platform that moves may stick and slide for ever.
#[derive(Debug, Clone)]
pub struct DrivenEngine {
    system: DrivenSystem,
    policy: ChatterPolicy,
    short_flights: ShortFlightCount,
    stage: Stage,
    now: Clock,
    state: DiskState,
    angle: LongSum,
    /// The contact that takes time, in [`Stage::Contact`].
    pressed: Option<Pressed>,
    /// How a disk moves that never leaves such a contact.
    settled: Option<Drive>,
    /// Without it the ledgers of slides stay empty: a motor does not need them.
    pub(crate) with_energy: bool,
}

impl DrivenEngine {
    /// An engine for a disk that starts in contact, by a launch or in the air. Where the platform falls away,
    /// a disk that starts in contact flies at once; the angular speed of a disk in contact counts as the
    /// platform's within rounding. The angle starts at the platform's.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] or an error of the core for an illegal start.
    pub fn new(system: DrivenSystem, start: DrivenStart, policy: ChatterPolicy) -> Result<Self, Error> {
        let (phase, gap, relative_velocity, speed) = match start {
            DrivenStart::Contact { phase, angular_speed } => (phase, None, 0.0, angular_speed),
            DrivenStart::Launch { phase, relative_speed, angular_speed } => {
                (phase, Some(0.0), relative_speed, angular_speed)
            }
            DrivenStart::Flight { phase, gap, relative_velocity, angular_speed } => {
                (phase, Some(gap), relative_velocity, angular_speed)
            }
        };
        let now = Clock { at: phase.angle(), periods: 0 };
        let mut engine = Self::begin(system, now, policy);
        engine.state.angular_speed = moderate("angular_speed", speed)?;
        match gap {
            None => engine.put_down(None)?,
            Some(gap) => {
                // The core checks the numbers of its flights.
                engine.system.height().first_impact_within(now.at, gap, relative_velocity, 0.0)?;
                engine.take_off(gap, relative_velocity);
            }
        }
        Ok(engine)
    }

    /// An engine that goes on with a motion: the disk in `state`, as [`Self::state_after`] gives it. In
    /// contact its height and axial velocity are those of the platform, whatever `state` has. How many short
    /// flights a cut has counted, and a chatter that is being summed, are not in a state.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a height below the platform by more than rounding, and for numbers that are
    /// not finite.
    pub fn of_state(
        system: DrivenSystem,
        time: PhaseTime,
        state: DiskState,
        policy: ChatterPolicy,
    ) -> Result<Self, Error> {
        let mut engine = Self::begin(system, Clock { at: time.phase.angle(), periods: time.periods }, policy);
        engine.resume(state)?;
        Ok(engine)
    }

    fn begin(system: DrivenSystem, now: Clock, policy: ChatterPolicy) -> Self {
        let (s, beta) = (system.height.at(now.at), system.angle.at(now.at));
        let state = DiskState {
            mode: Mode::Flight,
            height: s.height,
            axial_velocity: s.velocity,
            angle: beta.height,
            angular_speed: beta.velocity,
        };
        Self {
            angle: LongSum::new(state.angle),
            system,
            policy,
            short_flights: ShortFlightCount::default(),
            stage: Stage::Ended,
            now,
            state,
            pressed: None,
            settled: None,
            with_energy: true,
        }
    }

    fn resume(&mut self, state: DiskState) -> Result<(), Error> {
        for (field, value) in [
            ("height", state.height),
            ("axial_velocity", state.axial_velocity),
            ("angle", state.angle),
            ("angular_speed", state.angular_speed),
        ] {
            moderate(field, value)?;
        }
        let platform = self.state;
        self.state.angular_speed = state.angular_speed;
        self.state.angle = state.angle;
        self.angle = LongSum::new(state.angle);
        if let Some(compliant) = &self.system.compliance {
            let (gap, velocity) =
                (state.height - platform.height, state.axial_velocity - platform.axial_velocity);
            let relative = RelativeState { time: self.now.at, gap, velocity };
            self.state = state;
            if gap > 0.0 || state.mode == Mode::Flight && compliant.force(relative) <= 0.0 {
                self.stage = Stage::Flight { gap, velocity };
                self.state.mode = Mode::Flight;
                return Ok(());
            }
            return self.press(relative);
        }
        if state.mode == Mode::Flight {
            let gap = state.height - platform.height;
            let rounding = SAME_PLACE * (state.height.abs() + platform.height.abs());
            crate::error::check(gap >= -rounding, "height above the platform", gap, "[0, inf) (g/omega^2)")?;
            let velocity = state.axial_velocity - platform.axial_velocity;
            let parted = gap > rounding
                || velocity.abs()
                    > 4.0 * f64::EPSILON * (state.axial_velocity.abs() + platform.axial_velocity.abs());
            let end = self.system.height.contact_end(self.now.at, f64::INFINITY)?;
            let separates =
                |end: TimeAhead| end.after <= JOINT * (1.0 + end.time) && end.velocity_jump == 0.0;
            if parted {
                self.take_off(gap.max(0.0), velocity);
            } else if end.is_some_and(separates) {
                self.stage = Stage::Separated;
            } else {
                self.put_down(None)?;
            }
        } else {
            self.put_down(Some(state.mode))?;
        }
        Ok(())
    }

    /// A disk that is put on the platform; one that moves with it within rounding keeps the `mode` it has
    /// had.
    fn put_down(&mut self, mode: Option<Mode>) -> Result<(), Error> {
        let at = self.now.at;
        if let Some(compliant) = &self.system.compliance {
            let resting = compliant.resting(at);
            self.state.height += resting.gap;
            if resting.gap == 0.0 {
                self.take_off(0.0, 0.0);
                return Ok(());
            }
            return self.press(resting);
        }
        let (s, beta) = (self.system.height.at(at), self.system.angle.at(at));
        if !self.system.height.holds(at) {
            self.take_off(0.0, 0.0);
            return Ok(());
        }
        let speed = self.state.angular_speed;
        let pull = self.system.load.abs()
            + beta.acceleration.abs()
            + self.system.friction * (1.0 + s.acceleration.abs());
        let rounding = 4.0 * SAME_SPEED * (speed.abs() + self.system.angle.bounds().speed + at * pull);
        let moves_along = (speed - beta.velocity).abs() <= rounding;
        if moves_along {
            self.state.angular_speed = beta.velocity;
        }
        self.land()?;
        if let (true, Some(Mode::Sliding(direction)), Stage::Contact(contact)) =
            (moves_along, mode, &mut self.stage)
        {
            contact.slip = Some(direction);
            self.state.mode = Mode::Sliding(direction);
        }
        Ok(())
    }

    fn take_off(&mut self, gap: f64, velocity: f64) {
        self.state.mode = Mode::Flight;
        self.state.height += gap;
        self.state.axial_velocity += velocity;
        self.stage = Stage::Flight { gap, velocity };
    }

    /// A disk that presses on a contact that takes time.
    fn press(&mut self, from: RelativeState) -> Result<(), Error> {
        let Some(compliant) = &self.system.compliance else { return Ok(()) };
        let pressed = compliant.press(from);
        let touching = Touching { system: &self.system, ride: Ride::Pressed(&pressed, 0.0) };
        let slip = SlipDirection::of(self.state.angular_speed - self.system.angle.at(from.time).velocity)
            .or_else(|| touching.onset(from.time, None));
        self.press_on(pressed, slip)
    }

    /// `state` with the height and velocity at which a contact begins: what the roundings of long contacts
    /// leave of the distance to the platform does not add up.
    fn pressing(&self, pressed: &Pressed, state: DiskState) -> DiskState {
        let from = pressed.from();
        let platform = self.system.height.at(from.time);
        DiskState {
            height: platform.height + from.gap,
            axial_velocity: platform.velocity + from.velocity,
            ..state
        }
    }

    fn press_on(&mut self, pressed: Pressed, slip: Option<SlipDirection>) -> Result<(), Error> {
        let from = *pressed.from();
        let (after, then) = match pressed.end(f64::INFINITY)? {
            Some(ContactEnd::Release(after)) => (after, Then::Leaves),
            Some(ContactEnd::Settles(after)) => (after, Then::Settles),
            Some(ContactEnd::Turns(after, branch)) => (after, Then::Turns(branch)),
            None => (f64::INFINITY, Then::Leaves),
        };
        let ahead = |after| {
            let time = wrapped_angle(from.time + after);
            TimeAhead { after, time, velocity_jump: 0.0 }
        };
        let end = after.is_finite().then(|| ahead(after));
        self.state.mode = mode_of(slip);
        self.stage = Stage::Contact(Contact { slip, end, then });
        self.pressed = Some(pressed);
        Ok(())
    }

    /// What presses the disk on, `after` the last event.
    fn touching(&self, after: f64) -> Touching<'_> {
        let ride = match &self.pressed {
            Some(pressed) => Ride::Pressed(pressed, after),
            None => Ride::Platform(self.ridden()),
        };
        Touching { system: &self.system, ride }
    }

    /// How the platform moves the disk that lies on it.
    fn ridden(&self) -> &Drive {
        self.settled.as_ref().unwrap_or(&self.system.height)
    }

    /// A disk that has come to rest on the platform, at its angular speed.
    fn land(&mut self) -> Result<(), Error> {
        let at = self.now.at;
        let slip = SlipDirection::of(self.state.angular_speed - self.system.angle.at(at).velocity)
            .or_else(|| self.touching(0.0).onset(at, None));
        self.state.mode = mode_of(slip);
        let end = self.ridden().contact_end(at, f64::INFINITY)?;
        self.stage = Stage::Contact(Contact { slip, end, then: Then::Leaves });
        Ok(())
    }

    /// The system.
    #[must_use]
    pub const fn system(&self) -> &DrivenSystem {
        &self.system
    }

    /// The instant of the last event, or of the start.
    #[must_use]
    pub fn time(&self) -> PhaseTime {
        self.record_time(self.now)
    }

    /// The disk's state just after the last event, or at the start.
    #[must_use]
    pub const fn state(&self) -> &DiskState {
        &self.state
    }

    /// Whether a flight begins now.
    pub(crate) const fn launches(&self) -> bool {
        matches!(self.stage, Stage::Flight { .. } | Stage::Separated)
    }

    /// When, and the disk, `span` radians after the last event, if no event comes before. A chatter that is
    /// being summed counts as rest. A negative span and NaN count as zero, a longer one than
    /// [`MAX_FLIGHT_DURATION`] as that.
    #[must_use]
    pub fn state_after(&self, span: f64) -> (PhaseTime, DiskState) {
        let span = legal_span(span);
        let to = self.later(span);
        let change = self.change(span, to.at);
        let mut state = self.drifted(span, to.at, change);
        state.angle = self.state.angle + change.angle;
        (self.record_time(to), state)
    }

    /// The energy of the spring of a contact that takes time, in the `state` so long after the last event.
    pub(crate) fn spring_energy(&self, span: f64, state: &DiskState) -> f64 {
        let Some(compliant) = &self.system.compliance else { return 0.0 };
        compliant.spring_energy(state.height - self.system.height.at(self.later(span).at).height)
    }

    /// The energy balance from the last event to `span` radians later, as for [`Self::state_after`].
    #[must_use]
    pub fn ledger_after(&self, span: f64) -> EnergyLedger {
        let span = legal_span(span);
        let at = self.later(span).at;
        self.ledger_of(span, at, self.change(span, at))
    }

    /// The next event, or `None` after the last one.
    ///
    /// # Errors
    /// Those of the core's flights; [`Error::SlipTooLong`]. An error ends the motion.
    pub fn advance(&mut self) -> Result<Option<EventRecord>, Error> {
        self.advance_within(f64::INFINITY)
    }

    /// The next event if it comes within `limit` radians of the last one. Without one the engine stays where
    /// it is.
    pub(crate) fn advance_within(&mut self, limit: f64) -> Result<Option<EventRecord>, Error> {
        let result = match self.stage {
            Stage::Flight { gap, velocity } => self.fly(gap, velocity, limit),
            Stage::Separated => {
                let landing = self.system.height.impact_after_separation_within(self.now.at, limit);
                landing
                    .map(|landing| landing.map(|landing| self.land_on(&landing.impact)))
                    .map_err(Error::from)
            }
            Stage::Chatter { speed, chatter } if chatter.duration <= limit => {
                self.complete(speed, chatter).map(Some)
            }
            // What cannot be completed in time is followed impact by impact.
            Stage::Chatter { speed, .. } => self.fly(0.0, speed, limit),
            Stage::Cut { speed, error } => self.cut(speed, error).map(Some),
            Stage::Contact(contact) => self.touch(contact, limit),
            Stage::Ended => Ok(None),
        };
        if result.is_err() {
            self.stage = Stage::Ended;
        }
        result
    }

    /// The gap and the relative velocity at the start of a flight, if one begins now.
    pub(crate) const fn flight(&self) -> Option<[f64; 2]> {
        match self.stage {
            Stage::Flight { gap, velocity } => Some([gap, velocity]),
            _ => None,
        }
    }

    /// Goes on from the release of a contact that takes time, or from any other flight, with the angle at
    /// zero.
    pub(crate) fn fly_from(&mut self, time: PhaseTime, [gap, velocity]: [f64; 2], angular_speed: f64) {
        self.now = Clock { at: time.phase.angle(), periods: time.periods };
        let platform = self.system.height.at(self.now.at);
        self.angle = LongSum::new(0.0);
        self.state = DiskState {
            mode: Mode::Flight,
            height: platform.height + gap,
            axial_velocity: platform.velocity + velocity,
            angle: 0.0,
            angular_speed,
        };
        (self.pressed, self.settled, self.stage) = (None, None, Stage::Flight { gap, velocity });
    }

    /// Adds a relative speed >= 0 (g/omega) to a flight that starts now; does nothing at any other time.
    pub(crate) fn perturb_launch(&mut self, speed: f64) {
        let (gap, velocity) = match self.stage {
            Stage::Separated => (0.0, speed),
            // A contact that takes time ends before its spring is free.
            Stage::Flight { gap, velocity } if gap <= 0.0 && velocity >= 0.0 => (gap, velocity + speed),
            _ => return,
        };
        self.state.axial_velocity += speed;
        self.stage = Stage::Flight { gap, velocity };
    }

    fn fly(&mut self, gap: f64, velocity: f64, limit: f64) -> Result<Option<EventRecord>, Error> {
        if let Some(compliant) = &self.system.compliance {
            let from = RelativeState { time: self.now.at, gap, velocity };
            let touch = compliant.touch(from, limit)?;
            return touch.map(|touch| self.begin_contact(from, &touch)).transpose();
        }
        if gap <= 0.0 && velocity < 0.0 {
            return Ok(Some(self.hit(0.0, self.now, velocity, f64::INFINITY, false)));
        }
        if gap <= 0.0 && velocity == 0.0 && self.system.height.holds(self.now.at) {
            // At a joint a disk may fly at zero distance: it lies on the platform.
            self.put_down(None)?;
            return self.advance_within(limit);
        }
        let found = self.system.height.first_impact_within(self.now.at, gap, velocity, limit)?;
        Ok(found.map(|landing| self.land_on(&landing.impact)))
    }

    /// The start of a contact that takes time.
    fn begin_contact(&mut self, from: RelativeState, touch: &Touch) -> Result<EventRecord, Error> {
        let Touch { duration: span, state, .. } = *touch;
        let to = Clock { at: state.time, periods: self.now.periods + touch.turns };
        let change = self.change(span, to.at);
        let (s, beta) = (self.system.height.at(to.at), self.system.angle.at(to.at));
        let before = DiskState {
            mode: Mode::Flight,
            height: s.height + state.gap,
            axial_velocity: s.velocity + state.velocity,
            angle: 0.0,
            angular_speed: change.speed,
        };
        let mut ledger = EnergyLedger::default();
        self.record_flight(&mut ledger, &before, &change);
        self.record_spring(&mut ledger, from.gap, state.gap, true);
        let event = if state.gap < 0.0 {
            Event::Recontact
        } else {
            Event::Impact {
                axial_impact_velocity: state.velocity,
                tangential_impact_velocity: change.speed - beta.velocity,
                capped: false,
            }
        };
        let mut record = self.moved(span, to, event, change.angle, (before, before), ledger);
        self.press(state)?;
        record.after.mode = self.state.mode;
        Ok(record)
    }

    /// The change of the spring's energy between two gaps, lost in the damper where no force acts.
    fn record_spring(&self, ledger: &mut EnergyLedger, from: f64, to: f64, lost: bool) {
        let Some(compliant) = &self.system.compliance else { return };
        let energy = |gap| compliant.spring_energy(gap);
        ledger.record_spring([energy(from), energy(to)]);
        if lost {
            ledger.record_normal(0.0, energy(from) - energy(to));
        }
    }

    /// The end of a contact that takes time, `span` after the last event.
    fn release(
        &mut self,
        pressed: &Pressed,
        contact: Contact,
        span: f64,
        to: Clock,
    ) -> Result<EventRecord, Error> {
        let change = self.change(span, to.at);
        let mut ledger = self.ledger_of(span, to.at, change);
        let before = self.drifted(span, to.at, change);
        if let Then::Turns(branch) = contact.then {
            let next = pressed.platform().press_on(branch, pressed.turned(span));
            let after = self.pressing(&next, before);
            record_jump(&mut ledger, &before, &after);
            let mut record = self.moved(span, to, Event::Turn, change.angle, (before, after), ledger);
            // Where the force drops, friction may not hold any more.
            let touching = Touching { system: &self.system, ride: Ride::Pressed(&next, 0.0) };
            let slip = contact.slip.or_else(|| touching.onset(to.at, None));
            self.press_on(next, slip)?;
            record.after.mode = self.state.mode;
            return Ok(record);
        }
        if contact.then == Then::Settles {
            self.settled = Some(pressed.platform().steady()?);
            let event = Event::Attachment { impacts: 0, error_bound: 0.0 };
            let record = self.moved(span, to, event, change.angle, (before, before), ledger);
            self.pressed = None;
            self.stage = Stage::Contact(Contact { end: None, then: Then::Leaves, ..contact });
            return Ok(record);
        }
        let released = pressed.released(span);
        let after = DiskState { mode: Mode::Flight, ..before };
        record_jump(&mut ledger, &before, &after);
        let record = self.moved(span, to, Event::Separation, change.angle, (before, after), ledger);
        self.pressed = None;
        self.stage = Stage::Flight { gap: released.gap, velocity: released.velocity };
        Ok(record)
    }

    fn land_on(&mut self, impact: &bouncing_disk_core::Impact) -> EventRecord {
        let span = impact.duration();
        let to = Clock { at: impact.phase.angle(), periods: self.now.periods + impact.turns };
        self.hit(span, to, impact.velocity, span, false)
    }

    /// An impact with relative `velocity` `span` after the last event, or a kick, at the end of a flight of
    /// this duration.
    fn hit(&mut self, span: f64, to: Clock, velocity: f64, flight: f64, kick: bool) -> EventRecord {
        let (s, beta) = (self.system.height.at(to.at), self.system.angle.at(to.at));
        let change = self.change(span, to.at);
        let mut ledger = EnergyLedger::default();
        let before = match self.state.mode {
            Mode::Flight => {
                let before = DiskState {
                    mode: Mode::Flight,
                    height: s.height,
                    axial_velocity: velocity + s.velocity,
                    angle: 0.0,
                    angular_speed: change.speed,
                };
                self.record_flight(&mut ledger, &before, &change);
                before
            }
            _ => {
                ledger = self.ledger_of(span, to.at, change);
                self.drifted(span, to.at, change)
            }
        };
        let restitution = self.system.restitution;
        let rebound = rebound_velocity(restitution, velocity);
        let stage = self.stage_after(to.at, velocity, flight);
        // Where the platform falls away, a cut takes the rebound and lets the disk go at once.
        let cut = rebound > 0.0 && stage == Stage::Flight { gap: 0.0, velocity: 0.0 };
        let speeds = [change.speed, beta.velocity];
        let impact = self.system.impact(&mut ledger, restitution, [velocity, s.velocity], speeds);
        let mut axial = impact.axial;
        if cut {
            axial -= rebound;
            ledger.record_normal(-rebound * s.velocity, 0.5 * rebound * rebound);
        }
        let after = DiskState {
            mode: Mode::Flight,
            axial_velocity: if cut { 0.0 } else { rebound } + s.velocity,
            angular_speed: impact.speed,
            ..before
        };
        record_jump(&mut ledger, &before, &after);
        let (axial_impact_velocity, tangential_impact_velocity, capped) =
            (velocity, impact.slip, impact.capped);
        let event = if kick {
            Event::Kick { axial_impact_velocity, tangential_impact_velocity, capped }
        } else {
            Event::Impact { axial_impact_velocity, tangential_impact_velocity, capped }
        };
        let record = self.moved(span, to, event, change.angle, (before, after), ledger);
        self.stage = stage;
        EventRecord { axial_impulse: axial, angular_impulse: impact.rotary, ..record }
    }

    /// What follows an impact with relative `velocity` that ends a flight of this duration.
    fn stage_after(&mut self, at: f64, velocity: f64, flight: f64) -> Stage {
        let surface = (&self.system.height, self.system.restitution);
        let speed = rebound_velocity(self.system.restitution, velocity);
        match self.policy.after_impact(surface, (at, velocity), flight, &mut self.short_flights) {
            AfterImpact::Launch(velocity) => Stage::Flight { gap: 0.0, velocity },
            AfterImpact::Chatter(chatter) => Stage::Chatter { speed, chatter },
            AfterImpact::Rest { error } => Stage::Cut { speed, error },
        }
    }

    /// The rest of a chatter.
    fn complete(&mut self, launch: f64, chatter: ChatterDuration) -> Result<EventRecord, Error> {
        let ChatterDuration { duration, error } = chatter;
        let to = self.later(duration);
        let (s, beta) = (self.system.height.at(to.at), self.system.angle.at(to.at));
        let rest = self.system.chatter(self.now.at, launch, self.state.angular_speed, duration);
        let mut ledger = rest.ledger;
        let before = DiskState {
            mode: Mode::Flight,
            height: s.height,
            axial_velocity: s.velocity,
            angle: 0.0,
            angular_speed: rest.speed,
        };
        let after =
            DiskState { angular_speed: if rest.capped { beta.velocity } else { rest.speed }, ..before };
        let start = self.state;
        ledger.record_axial_change([start.axial_velocity, s.velocity], [start.height, s.height]);
        ledger.record_rounding(self.system.height.bounds().speed, s.velocity);
        let event = Event::Attachment { impacts: rest.impacts, error_bound: error };
        let mut record = self.moved(duration, to, event, rest.angle, (before, after), ledger);
        self.land()?;
        record.after.mode = self.state.mode;
        record.segment.chatter_speed = Some(launch);
        let (axial_impulse, angular_impulse) = (rest.axial_impulse, rest.angular_impulse);
        Ok(EventRecord { axial_impulse, angular_impulse, ..record })
    }

    /// A cut takes the rebound `speed` away.
    fn cut(&mut self, speed: f64, error: f64) -> Result<EventRecord, Error> {
        let platform = self.system.height.at(self.now.at).velocity;
        let before = self.state;
        let after = DiskState { axial_velocity: platform, ..before };
        let mut ledger = EnergyLedger::default();
        ledger.record_normal(-speed * platform, 0.5 * speed * speed);
        record_jump(&mut ledger, &before, &after);
        let event = Event::Attachment { impacts: 0, error_bound: error };
        let mut record = self.moved(0.0, self.now, event, 0.0, (before, after), ledger);
        self.land()?;
        record.after.mode = self.state.mode;
        Ok(EventRecord { axial_impulse: -speed, ..record })
    }

    /// A disk on the platform, to the next event.
    fn touch(&mut self, contact: Contact, limit: f64) -> Result<Option<EventRecord>, Error> {
        let at = self.now.at;
        let ends = contact.end.map_or(f64::INFINITY, |end| end.after);
        let kink = self.system.angle.next_kink(at).filter(|kink| kink.after < ends);
        let to = limit.min(ends).min(kink.map_or(f64::INFINITY, |kink| kink.after));
        let slip = |direction: SlipDirection| {
            (direction.sign() * (self.state.angular_speed - self.system.angle.at(at).velocity)).max(0.0)
        };
        let change = match contact.slip {
            Some(direction) => {
                self.touching(0.0).slip_end(direction, at, slip(direction), to)?.map(|span| (span, direction))
            }
            None => self.touching(0.0).stick_end(at, to)?,
        };
        // Where nothing pulls at the disk, friction gives way as the contact ends.
        let change = change.filter(|(span, _)| span + JOINT * (at + span + 1.0) < ends);
        if let Some((span, direction)) = change {
            return Ok(Some(match contact.slip {
                Some(_) => self.end_slip(contact, direction, span),
                None => {
                    let to = self.later(span);
                    self.change_contact(contact, span, to, Event::StickToSlip(direction), Some(direction))
                }
            }));
        }
        if to == f64::INFINITY || limit < ends.min(kink.map_or(f64::INFINITY, |kink| kink.after)) {
            return Ok(None);
        }
        if let Some(kink) = kink {
            let jump = contact.slip.map_or(0.0, |d| d.sign() * self.slip_speed_at(kink.after, kink.time))
                - kink.velocity_jump;
            let next = SlipDirection::of(jump);
            let event = match (contact.slip, next) {
                (_, None) => Event::SlipToStick,
                (None, Some(direction)) => Event::StickToSlip(direction),
                (Some(before), Some(direction)) if before == direction => Event::SlipJump(direction),
                (_, Some(direction)) => Event::SlipReversal(direction),
            };
            let to = self.clock_at(kink.after, kink.time);
            return Ok(Some(self.change_contact(contact, kink.after, to, event, next)));
        }
        let Some(TimeAhead { after: span, time, velocity_jump: jump }) = contact.end else { return Ok(None) };
        let to = self.clock_at(span, time);
        if let Some(pressed) = self.pressed.clone() {
            return self.release(&pressed, contact, span, to).map(Some);
        }
        if jump > 0.0 {
            return Ok(Some(self.hit(span, to, -jump, f64::INFINITY, true)));
        }
        let change = self.change(span, to.at);
        let ledger = self.ledger_of(span, to.at, change);
        let before = self.drifted(span, to.at, change);
        let after = DiskState { mode: Mode::Flight, ..before };
        let record = self.moved(span, to, Event::Separation, change.angle, (before, after), ledger);
        self.stage = if jump < 0.0 { Stage::Flight { gap: 0.0, velocity: -jump } } else { Stage::Separated };
        Ok(Some(record))
    }

    /// Slip speed (disk minus platform, in the direction of the slip) just before the platform's speed jumps.
    fn slip_speed_at(&self, span: f64, time: f64) -> f64 {
        let change = self.change(span, time);
        let Mode::Sliding(direction) = self.state.mode else { return 0.0 };
        (direction.sign() * (change.speed - self.system.angle.velocity_before(time))).max(0.0)
    }

    fn end_slip(&mut self, contact: Contact, direction: SlipDirection, span: f64) -> EventRecord {
        let to = self.later(span);
        let next = self.touching(span).onset(to.at, Some(direction));
        let event = next.map_or(Event::SlipToStick, Event::SlipReversal);
        self.change_contact(contact, span, to, event, next)
    }

    /// A change between sticking and sliding.
    fn change_contact(
        &mut self,
        contact: Contact,
        span: f64,
        to: Clock,
        event: Event,
        slip: Option<SlipDirection>,
    ) -> EventRecord {
        let change = self.change(span, to.at);
        let mut ledger = self.ledger_of(span, to.at, change);
        let mut before = self.drifted(span, to.at, change);
        let platform_speed = self.system.angle.at(to.at).velocity;
        let settles = matches!(event, Event::SlipToStick | Event::SlipReversal(_))
            && self.system.angle.velocity_before(to.at).to_bits() == platform_speed.to_bits();
        if settles && self.system.friction > 0.0 {
            // What rounding has left of the slip.
            let slip = change.speed - platform_speed;
            let (work, loss) = (-slip * platform_speed, 0.5 * slip * slip);
            ledger.record_friction(work, loss, work.abs() + loss);
            ledger.record_rotary_change(change.speed, platform_speed);
            before.angular_speed = platform_speed;
        }
        let mut after = DiskState { mode: mode_of(slip), ..before };
        let next = self
            .pressed
            .as_ref()
            .map(|pressed| pressed.platform().press_on(pressed.branch(), pressed.after(span)));
        if let Some(next) = &next {
            after = self.pressing(next, after);
        }
        let record = self.moved(span, to, event, change.angle, (before, after), ledger);
        self.pressed = next;
        let end = contact.end.map(|end| TimeAhead { after: (end.after - span).max(0.0), ..end });
        self.stage = Stage::Contact(Contact { slip, end, ..contact });
        record
    }

    /// The rotary motion over the next `span`, to the time `at` of the drive.
    fn change(&self, span: f64, at: f64) -> RotaryChange {
        match self.state.mode {
            Mode::Flight => change_in_flight(self.system.load, self.state.angular_speed, span),
            Mode::Sticking => RotaryChange {
                speed: self.system.angle.velocity_before(at),
                angle: self.system.angle.at(at).height - self.system.angle.at(self.now.at).height,
            },
            Mode::Sliding(direction) => {
                self.touching(0.0).slide(direction, self.state.angular_speed, self.now.at, span)
            }
        }
    }

    /// The disk then, without its angle.
    fn drifted(&self, span: f64, at: f64, change: RotaryChange) -> DiskState {
        let state = &self.state;
        let (height, axial_velocity) = match (state.mode, self.stage) {
            (Mode::Flight, Stage::Chatter { chatter, .. }) if span >= chatter.duration => {
                (self.system.height.at(at).height, self.system.height.at(at).velocity)
            }
            (Mode::Flight, _) => {
                (state.height + span * (state.axial_velocity - 0.5 * span), state.axial_velocity - span)
            }
            _ if self.pressed.is_some() => {
                let (gained, lifted) = self.touching(0.0).ride.change(self.now.at, span);
                (state.height + (span * state.axial_velocity + lifted), state.axial_velocity + gained)
            }
            _ if self.settled.is_some() => {
                let (from, to) = (self.ridden().at(self.now.at), self.ridden().at(at));
                (
                    state.height + (to.height - from.height),
                    state.axial_velocity + (to.velocity - from.velocity),
                )
            }
            _ if span > 0.0 => (self.system.height.at(at).height, self.system.height.velocity_before(at)),
            _ => (state.height, state.axial_velocity),
        };
        DiskState { mode: state.mode, height, axial_velocity, angle: 0.0, angular_speed: change.speed }
    }

    fn record_flight(&self, ledger: &mut EnergyLedger, end: &DiskState, change: &RotaryChange) {
        let start = &self.state;
        ledger.record_axial_change([start.axial_velocity, end.axial_velocity], [start.height, end.height]);
        let work = self.system.load * change.angle;
        ledger.record_rotary_change(start.angular_speed, change.speed);
        ledger.record_load(work, work.abs());
    }

    /// The energy balance of the next `span` without an event.
    fn ledger_of(&self, span: f64, at: f64, change: RotaryChange) -> EnergyLedger {
        let mut ledger = EnergyLedger::default();
        let (start, end) = (self.state, self.drifted(span, at, change));
        self.record_flight(&mut ledger, &end, &change);
        if start.mode == Mode::Flight {
            let gap = |state: &DiskState, at| state.height - self.system.height.at(at).height;
            self.record_spring(&mut ledger, gap(&start, self.now.at), gap(&end, at), true);
            return ledger;
        }
        if self.system.compliance.is_some() {
            let (work, loss, gap) = self.touching(0.0).normal_work(&start, self.now.at, span);
            ledger.record_normal(work, loss);
            self.record_spring(&mut ledger, gap[0], gap[1], false);
        } else {
            // The integral of (1 + s'') s'.
            let (from, to) = (start.axial_velocity, end.axial_velocity);
            ledger.record_normal((end.height - start.height) + 0.5 * (to - from) * (to + from), 0.0);
        }
        if let Mode::Sliding(direction) = start.mode {
            if self.with_energy {
                let slip = start.angular_speed - self.system.angle.at(self.now.at).velocity;
                let work = self.touching(0.0).slide_work(
                    direction,
                    self.now.at,
                    (direction.sign() * slip).max(0.0),
                    span,
                );
                let mu = self.system.friction;
                ledger.record_friction(
                    -direction.sign() * mu * work.carried,
                    mu * work.slipped,
                    mu * work.size,
                );
                // The angle is a small difference of what friction and load would give alone.
                let size = span * (start.angular_speed.abs() + (self.system.load.abs() + mu) * span);
                ledger.record_load(0.0, self.system.load.abs() * size);
            }
        } else {
            // The friction torque is l + beta'': integrated times beta'.
            let (from, to) = (start.angular_speed, change.speed);
            let work = self.system.load * change.angle + 0.5 * (to - from) * (to + from);
            ledger.record_friction(work, 0.0, 0.5 * (to * to + from * from));
        }
        ledger
    }

    /// The record of an event, after which the engine is there.
    fn moved(
        &mut self,
        span: f64,
        to: Clock,
        event: Event,
        turned: f64,
        (mut before, mut after): (DiskState, DiskState),
        ledger: EnergyLedger,
    ) -> EventRecord {
        self.angle.add(turned);
        before.angle = self.angle.value();
        after.angle = before.angle;
        let segment = Segment { start: self.time(), state: self.state, chatter_speed: None };
        self.now = to;
        self.state = after;
        EventRecord {
            time: self.time(),
            event,
            before,
            after,
            axial_impulse: 0.0,
            angular_impulse: 0.0,
            ledger,
            segment,
            span: PhaseSpan::from_radians(span),
        }
    }

    fn later(&self, span: f64) -> Clock {
        self.clock_at(span, wrapped_angle(self.now.at + span))
    }

    /// The clock `span` later, where the drive is at `at`.
    fn clock_at(&self, span: f64, at: f64) -> Clock {
        let turns = ((self.now.at + span - at) / TAU + 0.5) as u64;
        Clock { at, periods: self.now.periods.saturating_add(turns) }
    }

    fn record_time(&self, clock: Clock) -> PhaseTime {
        PhaseTime { periods: clock.periods, phase: phase_at(wrapped_angle(clock.at)) }
    }
}

const fn legal_span(span: f64) -> f64 {
    if span > 0.0 { span.min(MAX_FLIGHT_DURATION) } else { 0.0 }
}

const fn mode_of(slip: Option<SlipDirection>) -> Mode {
    match slip {
        Some(direction) => Mode::Sliding(direction),
        None => Mode::Sticking,
    }
}

impl Motion for DrivenEngine {
    type Record = EventRecord;

    fn time(&self) -> PhaseTime {
        self.time()
    }

    fn disk(&self) -> DiskState {
        self.state
    }

    fn advance(&mut self) -> Result<Option<EventRecord>, Error> {
        self.advance()
    }

    fn lies_for_ever(&self) -> bool {
        matches!(self.stage, Stage::Contact(Contact { end: None, .. }) | Stage::Ended)
    }
}

impl SteeredMotion for DrivenEngine {
    fn advance_within(&mut self, limit: f64) -> Result<Option<EventRecord>, Error> {
        self.advance_within(limit)
    }

    fn disk_after(&self, span: f64) -> DiskState {
        self.state_after(span).1
    }

    fn energies_after(&self, span: f64) -> Energies {
        Energies { disk: self.ledger_after(span), stator: StatorLedger::default() }
    }

    fn spring_energy(&self, span: f64, state: &DiskState) -> f64 {
        self.spring_energy(span, state)
    }

    fn launches(&self) -> bool {
        self.launches()
    }

    fn perturb_launch(&mut self, speed: f64) {
        self.perturb_launch(speed);
    }

    fn pause_contact(&mut self, _: f64) -> Option<Energies> {
        None
    }

    fn amplitude_after(&self, _: f64) -> Option<f64> {
        None
    }

    fn skip_energies(&mut self) {
        self.with_energy = false;
    }
}

impl Iterator for DrivenEngine {
    type Item = Result<EventRecord, Error>;

    fn next(&mut self) -> Option<Self::Item> {
        self.advance().transpose()
    }
}

#[cfg(test)]
mod tests;
