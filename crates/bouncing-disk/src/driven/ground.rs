//! The ground of a platform with any periodic motion and rigid or compliant contacts, which finds its next
//! event.

use bouncing_disk_core::chatter::ChatterDuration;
use bouncing_disk_core::chatter::{AfterImpact, ShortFlightCount};
use bouncing_disk_core::numerics::elementary::wrapped_angle;
use bouncing_disk_core::{ChatterPolicy, Phase};
use bouncing_disk_drives::Drive;
use bouncing_disk_drives::compliance::{ContactEnd, Pressed, RelativeState, SpringState, Touch};
use bouncing_disk_drives::drive::TimeAhead;

use super::DrivenSystem;
use super::contact::{Ride, Touching};
use crate::error::Error;
use crate::motion::contact_motion::Lying;
use crate::motion::energy::EnergyLedger;
use crate::motion::engine::{Engine, Ground, Hit, Passed, Stage, StageOn, Step, record_jump};
use crate::motion::event::{Event, EventRecord};
use crate::motion::impact::rebound_velocity;
use crate::motion::impact_energy::record_slip_end;
use crate::motion::phase_time::PhaseSpan;
use crate::motion::rotary_change::RotaryChange;
use crate::motion::state::{DiskState, Mode, PlatformState, SlipDirection};

/// A friction event that precedes the end of a contact by less than this share of the end's time coincides with
/// the end: both times are roots, each with an error of a few roundings of the time.
pub(super) const JOINT: f64 = 16.0 * f64::EPSILON;

/// A platform with any drives of height and angle.
#[derive(Debug, Clone)]
pub struct DrivenGround {
    policy: ChatterPolicy,
    short_flights: ShortFlightCount,
    /// The compliant contact of a disk that lies on the platform.
    pub(super) pressed: Option<Pressed>,
    /// The motion of a disk that never leaves a compliant contact again.
    pub(super) settled: Option<Drive>,
}

/// A flight over a drive.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum DrivenFlight {
    /// A flight from this gap above the platform, with this velocity relative to it.
    Free { gap: f64, velocity: f64 },
    /// A flight from a contact whose force has fallen to zero.
    Separated,
    /// Many short flights, from this launch speed to rest.
    Chatter { speed: f64, chatter: ChatterDuration },
    /// A flight of no duration: a cut removes this launch speed, with this bound on the error of the phase.
    Cut { speed: f64, error: f64 },
}

/// The end of a contact on a drive, and the continuation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DrivenEnd {
    pub(super) ahead: TimeAhead,
    pub(super) then: Then,
}

/// The continuation after the end of a contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Then {
    /// The disk leaves, or is hit.
    Leaves,
    /// The transient of a compliant contact is over: the disk never leaves.
    Settles,
    /// The spring of a compliant contact changes to this state.
    Turns(SpringState),
}

/// The motion of a disk on a driven platform, as a lazy sequence of [`EventRecord`]s.
///
/// The sequence ends when no further event is possible, and after an error. A disk that rests for ever on a
/// moving platform may alternate between sticking and sliding without end.
pub type DrivenEngine = Engine<DrivenGround>;

impl DrivenGround {
    pub(super) fn new(policy: ChatterPolicy) -> Self {
        Self { policy, short_flights: ShortFlightCount::default(), pressed: None, settled: None }
    }
}

impl Ground for DrivenGround {
    type System = DrivenSystem;
    type Flight = DrivenFlight;
    type ContactEnd = DrivenEnd;

    fn platform(system: &DrivenSystem, phase: Phase) -> PlatformState {
        let (s, beta) = (system.height.at(phase.angle()), system.angle.at(phase.angle()));
        PlatformState {
            height: s.height,
            axial_velocity: s.velocity,
            angle: beta.height,
            angular_speed: beta.velocity,
        }
    }

    fn torques(system: &DrivenSystem) -> [f64; 2] {
        [system.friction, system.load]
    }

    fn end_flight(
        engine: &mut DrivenEngine,
        flight: DrivenFlight,
        limit: f64,
    ) -> Result<Option<EventRecord>, Error> {
        match flight {
            DrivenFlight::Free { gap, velocity } => engine.fly(gap, velocity, limit),
            DrivenFlight::Separated => {
                let landing = engine.system.height.impact_after_separation_within(engine.at(), limit)?;
                Ok(landing.map(|landing| engine.land_on(&landing.impact)))
            }
            DrivenFlight::Chatter { speed, chatter } if chatter.duration <= limit => {
                engine.complete(speed, chatter).map(Some)
            }
            // A chatter that cannot be completed in time is followed impact by impact.
            DrivenFlight::Chatter { speed, .. } => engine.fly(0.0, speed, limit),
            DrivenFlight::Cut { speed, error } => engine.cut(speed, error).map(Some),
        }
    }

    fn end_contact(
        engine: &mut DrivenEngine,
        lying: Lying<DrivenEnd>,
        limit: f64,
    ) -> Result<Option<EventRecord>, Error> {
        let at = engine.at();
        let ends = lying.end.map_or(f64::INFINITY, |end| end.ahead.after);
        let kink = engine.system.angle.next_kink(at).filter(|kink| kink.after < ends);
        let to = limit.min(ends).min(kink.map_or(f64::INFINITY, |kink| kink.after));
        let touching = engine.touching(0.0);
        let change = match lying.slip {
            Some(direction) => {
                let slip = engine.state.angular_speed - engine.system.angle.at(at).velocity;
                let speed = (direction.sign() * slip).max(0.0);
                touching.slip_end(direction, at, speed, to)?.map(|span| (span, direction))
            }
            None => touching.stick_end(at, to)?,
        };
        // If nothing pulls at the disk, friction gives way only as the contact ends.
        let change = change.filter(|(span, _)| span + JOINT * (at + span + 1.0) < ends);
        if let Some((span, direction)) = change {
            let to = engine.later(span);
            let (event, next) = match lying.slip {
                Some(_) => {
                    let next = engine.touching(span).onset(to.time.phase.angle(), Some(direction));
                    (next.map_or(Event::SlipToStick, Event::SlipReversal), next)
                }
                None => (Event::StickToSlip(direction), Some(direction)),
            };
            return Ok(Some(engine.change_slip(lying, &to, event, next)));
        }
        if to == f64::INFINITY || limit < ends.min(kink.map_or(f64::INFINITY, |kink| kink.after)) {
            return Ok(None);
        }
        if let Some(kink) = kink {
            let jump = lying.slip.map_or(0.0, |d| d.sign() * engine.slip_speed_at(kink.after, kink.time))
                - kink.velocity_jump;
            let next = SlipDirection::of(jump);
            let event = match (lying.slip, next) {
                (_, None) => Event::SlipToStick,
                (None, Some(direction)) => Event::StickToSlip(direction),
                (Some(before), Some(direction)) if before == direction => Event::SlipJump(direction),
                (_, Some(direction)) => Event::SlipReversal(direction),
            };
            let to = engine.step(kink.after, kink.time);
            return Ok(Some(engine.change_slip(lying, &to, event, next)));
        }
        lying.end.map(|end| engine.leave(lying.slip, end)).transpose()
    }
}

impl DrivenEngine {
    fn fly(&mut self, gap: f64, velocity: f64, limit: f64) -> Result<Option<EventRecord>, Error> {
        let at = self.at();
        if let Some(compliant) = &self.system.compliance {
            let from = RelativeState { time: at, gap, velocity };
            let touch = compliant.touch(from, limit)?;
            return touch.map(|touch| self.begin_contact(from, &touch)).transpose();
        }
        if gap <= 0.0 && velocity < 0.0 {
            let here = self.step_over(0.0, at, 0);
            return Ok(Some(self.hit_by(&here, velocity, f64::INFINITY, None)));
        }
        if gap <= 0.0 && velocity == 0.0 && self.system.height.holds(at) {
            // At a joint a disk may be in flight at zero distance: then it lies on the platform.
            self.put_down(None)?;
            return self.next_within(limit);
        }
        let found = self.system.height.first_impact_within(at, gap, velocity, limit)?;
        Ok(found.map(|landing| self.land_on(&landing.impact)))
    }

    fn land_on(&mut self, impact: &bouncing_disk_core::Impact) -> EventRecord {
        let duration = impact.duration();
        let to = self.step_over(duration, impact.phase.angle(), impact.turns);
        self.hit_by(&to, impact.velocity, duration, None)
    }

    /// An impact with relative `velocity`, or a kick, at the end of a flight of this duration.
    fn hit_by(&mut self, to: &Step, velocity: f64, flight: f64, passed: Option<Passed>) -> EventRecord {
        let restitution = self.system.restitution;
        let next = self.stage_after(to.time.phase.angle(), velocity, flight);
        let lets_go = next == Stage::Flight(DrivenFlight::Free { gap: 0.0, velocity: 0.0 });
        self.hit(to, Hit { velocity, restitution, next, lets_go }, passed)
    }

    /// The stage after an impact with relative `velocity` that ends a flight of this duration.
    fn stage_after(&mut self, at: f64, velocity: f64, flight: f64) -> StageOn<DrivenGround> {
        let surface = (&self.system.height, self.system.restitution);
        let speed = rebound_velocity(self.system.restitution, velocity);
        let DrivenGround { policy, short_flights, .. } = &mut self.ground;
        Stage::Flight(match policy.after_impact(surface, (at, velocity), flight, short_flights) {
            AfterImpact::Launch(velocity) => DrivenFlight::Free { gap: 0.0, velocity },
            AfterImpact::Chatter(chatter) => DrivenFlight::Chatter { speed, chatter },
            AfterImpact::Rest { error } => DrivenFlight::Cut { speed, error },
        })
    }

    /// The rest of a chatter.
    fn complete(&mut self, launch: f64, chatter: ChatterDuration) -> Result<EventRecord, Error> {
        let ChatterDuration { duration, error } = chatter;
        let to = self.later(duration);
        let (start, platform) = (self.state, DrivenGround::platform(&self.system, to.time.phase));
        let rest = self.system.chatter(self.now.phase, launch, start.angular_speed, duration);
        let before = DiskState::flying(platform.height, platform.axial_velocity, rest.angular_speed);
        let angular_speed = if rest.capped { platform.angular_speed } else { rest.angular_speed };
        let after = DiskState { angular_speed, ..before };
        let mut ledger = rest.ledger;
        ledger.record_axial_change(
            [start.axial_velocity, before.axial_velocity],
            [start.height, before.height],
        );
        ledger.record_rounding(self.system.height.bounds().speed, before.axial_velocity);
        let next = Stage::Lying(self.landed(to.time.phase.angle(), after.angular_speed)?);
        let event = Event::Attachment { impacts: rest.impacts, error_bound: error };
        let change = RotaryChange { speed: rest.angular_speed, angle: rest.angle };
        let (passed, impulses) =
            (Passed { change, ledger, before }, [rest.axial_impulse, rest.angular_impulse]);
        let mut record = self.moved(&to, event, passed, after, next, impulses);
        record.segment.chatter_speed = Some(launch);
        Ok(record)
    }

    /// A cut removes the rebound `speed`.
    fn cut(&mut self, speed: f64, error: f64) -> Result<EventRecord, Error> {
        let (at, before) = (self.at(), self.state);
        let platform = self.system.height.at(at).velocity;
        let after = DiskState { axial_velocity: platform, ..before };
        let mut ledger = EnergyLedger::default();
        ledger.record_normal(-speed * platform, 0.5 * speed * speed);
        record_jump(&mut ledger, &before, &after);
        let next = Stage::Lying(self.landed(at, after.angular_speed)?);
        let event = Event::Attachment { impacts: 0, error_bound: error };
        let change = RotaryChange { speed: before.angular_speed, angle: 0.0 };
        let here = Step { time: self.now, span: PhaseSpan::ZERO, duration: 0.0 };
        Ok(self.moved(&here, event, Passed { change, ledger, before }, after, next, [-speed, 0.0]))
    }

    /// The start of a compliant contact.
    fn begin_contact(&mut self, from: RelativeState, touch: &Touch) -> Result<EventRecord, Error> {
        let Touch { duration, state, turns } = *touch;
        let to = self.step_over(duration, state.time, turns);
        let platform = DrivenGround::platform(&self.system, to.time.phase);
        let change = self.flown(duration);
        let before = DiskState::flying(
            platform.height + state.gap,
            platform.axial_velocity + state.velocity,
            change.speed,
        );
        let mut ledger = EnergyLedger::default();
        self.record_flight(&mut ledger, &before, &change);
        self.record_spring(&mut ledger, from.gap, state.gap, true);
        let event = if state.gap < 0.0 {
            Event::Recontact
        } else {
            Event::Impact {
                axial_impact_velocity: state.velocity,
                tangential_impact_velocity: change.speed - platform.angular_speed,
                capped: false,
            }
        };
        let (pressed, next) = self.pressed_from(state, change.speed)?.unzip();
        let next = next.map_or(Stage::Ended, Stage::Lying);
        let record = self.moved(&to, event, Passed { change, ledger, before }, before, next, [0.0; 2]);
        self.ground.pressed = pressed;
        Ok(record)
    }

    /// The end of a contact, or a turn of the spring of a compliant one.
    fn leave(&mut self, slip: Option<SlipDirection>, end: DrivenEnd) -> Result<EventRecord, Error> {
        let DrivenEnd { ahead: TimeAhead { after: span, time: at, velocity_jump: jump }, then } = end;
        let (to, mut passed) = (self.step(span, at), self.passed(span, at));
        let before = passed.before;
        if let Some(pressed) = self.ground.pressed.take() {
            return match then {
                Then::Turns(branch) => {
                    let next = pressed.platform().press_on(branch, pressed.turned(span));
                    let after = self.pressing(&next, before);
                    record_jump(&mut passed.ledger, &before, &after);
                    // If the force drops, friction may no longer hold.
                    let touching = Touching { system: &self.system, ride: Ride::Pressed(&next, 0.0) };
                    let lying = lying_pressed(&next, slip.or_else(|| touching.onset(at, None)))?;
                    self.ground.pressed = Some(next);
                    Ok(self.moved(&to, Event::Turn, passed, after, Stage::Lying(lying), [0.0; 2]))
                }
                Then::Settles => {
                    self.ground.settled = Some(pressed.platform().steady()?);
                    let event = Event::Attachment { impacts: 0, error_bound: 0.0 };
                    let next = Stage::Lying(Lying { slip, end: None });
                    Ok(self.moved(&to, event, passed, before, next, [0.0; 2]))
                }
                Then::Leaves => {
                    let RelativeState { gap, velocity, .. } = pressed.released(span);
                    record_jump(&mut passed.ledger, &before, &before);
                    let next = Stage::Flight(DrivenFlight::Free { gap, velocity });
                    Ok(self.moved(&to, Event::Separation, passed, before, next, [0.0; 2]))
                }
            };
        }
        if jump > 0.0 {
            return Ok(self.hit_by(&to, -jump, f64::INFINITY, Some(passed)));
        }
        let next = if jump < 0.0 {
            DrivenFlight::Free { gap: 0.0, velocity: -jump }
        } else {
            DrivenFlight::Separated
        };
        Ok(self.moved(&to, Event::Separation, passed, before, Stage::Flight(next), [0.0; 2]))
    }

    /// `state` with the height and velocity at which a contact begins, so that the rounding of long contacts
    /// does not accumulate in the distance to the platform.
    fn pressing(&self, pressed: &Pressed, state: DiskState) -> DiskState {
        let from = pressed.from();
        let platform = self.system.height.at(from.time);
        DiskState {
            height: platform.height + from.gap,
            axial_velocity: platform.velocity + from.velocity,
            ..state
        }
    }

    /// Slip speed (disk minus platform, in the direction of the slip) just before the platform's speed jumps.
    fn slip_speed_at(&self, span: f64, time: f64) -> f64 {
        let change = self.change(span, time);
        let Mode::Sliding(direction) = self.state.mode else { return 0.0 };
        (direction.sign() * (change.speed - self.system.angle.velocity_before(time))).max(0.0)
    }

    /// A change between sticking and sliding.
    fn change_slip(
        &mut self,
        lying: Lying<DrivenEnd>,
        to: &Step,
        event: Event,
        slip: Option<SlipDirection>,
    ) -> EventRecord {
        let (span, at) = (to.duration, to.time.phase.angle());
        let mut passed = self.passed(span, at);
        let platform_speed = self.system.angle.at(at).velocity;
        let settles = matches!(event, Event::SlipToStick | Event::SlipReversal(_))
            && self.system.angle.velocity_before(at).to_bits() == platform_speed.to_bits();
        if settles && self.system.friction > 0.0 {
            let speed = passed.change.speed;
            record_slip_end(&mut passed.ledger, speed, speed - platform_speed, platform_speed);
            passed.before.angular_speed = platform_speed;
        }
        let mut after = passed.before;
        if let Some(pressed) = self.ground.pressed.take() {
            let next = pressed.platform().press_on(pressed.spring_state(), pressed.after(span));
            after = self.pressing(&next, after);
            self.ground.pressed = Some(next);
        }
        let end = lying.end.map(|end| {
            let ahead = TimeAhead { after: (end.ahead.after - span).max(0.0), ..end.ahead };
            DrivenEnd { ahead, ..end }
        });
        self.moved(to, event, passed, after, Stage::Lying(Lying { slip, end }), [0.0; 2])
    }
}

/// A disk in a compliant contact, sliding in this direction or sticking.
pub(super) fn lying_pressed(
    pressed: &Pressed,
    slip: Option<SlipDirection>,
) -> Result<Lying<DrivenEnd>, Error> {
    let (after, then) = match pressed.end(f64::INFINITY)? {
        Some(ContactEnd::Release(after)) => (after, Then::Leaves),
        Some(ContactEnd::Settles(after)) => (after, Then::Settles),
        Some(ContactEnd::Turns(after, branch)) => (after, Then::Turns(branch)),
        None => (f64::INFINITY, Then::Leaves),
    };
    let ahead = || {
        let time = wrapped_angle(pressed.from().time + after);
        TimeAhead { after, time, velocity_jump: 0.0 }
    };
    Ok(Lying { slip, end: after.is_finite().then(|| DrivenEnd { ahead: ahead(), then }) })
}
