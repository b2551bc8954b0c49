//! The event engine: flight, impact, attachment, sticking, sliding, separation.
//!
//! The vertical motion comes entirely from the core's [`Orbit`]; the engine adds the rotary motion and the changes
//! between sticking and sliding while the disk is on the platform.

use std::cmp::Ordering;
use std::f64::consts::PI;

use bouncing_disk_core::{Attachment, ChatterPolicy, Impact, Launch, Orbit, OrbitEvent, Phase};

use crate::error::{Error, moderate};
use crate::motion::chatter::{Chatter, ImpactEnergy, record_impact};
use crate::motion::contact::{Friction, Spent};
use crate::motion::energy::EnergyLedger;
use crate::motion::event::{Event, EventRecord};
use crate::motion::impact::{axial_impulse, friction_impact, rebound_velocity};
use crate::motion::initial_condition::InitialCondition;
use crate::motion::phase_time::{PhaseSpan, PhaseTime};
use crate::motion::rotary_change::{
    RotaryChange, change_in_contact, change_in_flight, contact_ledger, record_flight_load,
};
use crate::motion::segment::Segment;
use crate::motion::state::{DiskState, LongSum, Mode, SlipDirection, Snapshot};
use crate::parameters::dimensionless::DimensionlessSystem;

/// An angular speed this close to the platform's at the start, relative to the sum of both sizes and the platform's
/// largest one, is the platform's: four units in the last place.
pub(crate) const SAME_SPEED: f64 = 4.0 * f64::EPSILON;

/// Where the motion goes next.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Stage {
    /// The orbit knows the next event.
    Flight,
    /// On the platform until it falls away, if ever.
    Contact { separation: Option<PhaseTime> },
    /// Nothing more happens.
    Ended,
}

/// The motion of a disk as a lazy sequence of [`EventRecord`]s.
///
/// The sequence ends where nothing more can happen (a disk that rests and sticks for ever) and after an error. A
/// disk that rests for ever may change between sticking and sliding for ever. Two engines with the same
/// arguments give the same bits.
#[derive(Debug, Clone)]
pub struct Engine {
    system: DimensionlessSystem,
    friction: Friction,
    /// `None` for a disk that has lain on the platform from the start and never separates.
    orbit: Option<Orbit>,
    stage: Stage,
    now: PhaseTime,
    state: DiskState,
    angle: LongSum,
}

impl Engine {
    /// An engine for a [`crate::System`] or a [`DimensionlessSystem`] one.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] or an error of the core for an illegal start; the first event's own errors come with
    /// that event, except that a start in the air finds its first impact at once.
    pub fn new(
        system: impl Into<DimensionlessSystem>,
        start: InitialCondition,
        policy: ChatterPolicy,
    ) -> Result<Self, Error> {
        let system = system.into();
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
            InitialCondition::Contact { .. } => engine.start_in_contact(policy)?,
            InitialCondition::Launch { relative_speed, .. } => {
                engine.orbit =
                    Some(system.map().orbit_from_launch(Launch::new(phase, relative_speed)?, policy));
                engine.state.axial_velocity += relative_speed;
            }
            InitialCondition::Flight { gap, relative_velocity, .. } => {
                engine.orbit = Some(system.map().orbit_from_drop(phase, gap, relative_velocity, policy)?);
                engine.state.height += gap;
                engine.state.axial_velocity += relative_velocity;
            }
        }
        Ok(engine)
    }

    fn start_in_contact(&mut self, policy: ChatterPolicy) -> Result<(), Error> {
        let phase = self.now.phase;
        let mut separation = None;
        if let Some(leaves) = self.system.vibration().separation_phase() {
            // The core's own interval: from separation to its mirror image about the crest.
            let falls_away = phase.angle() >= leaves.angle() && phase.angle() < PI - leaves.angle();
            let from = if falls_away { phase } else { leaves };
            self.orbit = Some(self.system.map().orbit_from_launch(Launch::new(from, 0.0)?, policy));
            if falls_away {
                return Ok(());
            }
            separation =
                Some(PhaseTime { periods: u64::from(leaves.angle() <= phase.angle()), phase: leaves });
        }
        let platform_speed = self.system.platform_angular_speed(phase);
        let slip = self.state.angular_speed - platform_speed;
        if slip.abs() <= SAME_SPEED * (self.state.angular_speed.abs() + self.system.twist_speed()) {
            self.state.angular_speed = platform_speed;
        }
        self.state.mode = self.contact_mode(phase, self.state.angular_speed);
        self.stage = Stage::Contact { separation };
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

    /// Disk and platform `span` after the last event, on the assumption that the next event does not come before.
    #[must_use]
    pub fn state_after(&self, span: PhaseSpan) -> Snapshot {
        self.segment(None).state_after(&self.system, span)
    }

    /// Whether the next event is the impact of a flight that starts now: just after a separation or an impact that
    /// does not end in an attachment, or at a start by launch.
    #[must_use]
    pub fn launches(&self) -> bool {
        self.stage == Stage::Flight && self.orbit.as_ref().is_some_and(|orbit| orbit.launch().is_some())
    }

    /// Gives a flight that starts now ([`Self::launches`]) another relative speed >= 0, in units of g/omega; does
    /// nothing at any other time. No ledger books the energy of this kick.
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

    /// The next event, or `None` after the last one.
    ///
    /// # Errors
    /// Those of the core's flights; [`Error::SlipTooLong`]. The motion has ended after one.
    pub fn advance(&mut self) -> Result<Option<EventRecord>, Error> {
        let result = match self.stage {
            Stage::Flight => self.advance_flight(),
            Stage::Contact { separation } => self.advance_contact(separation),
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
            Some(OrbitEvent::Impact(impact)) => Some(self.hit(&impact)),
            Some(OrbitEvent::Attachment(rest)) => Some(self.attach(&rest)),
            Some(_) | None => None,
        })
    }

    fn hit(&mut self, impact: &Impact) -> EventRecord {
        let system = &self.system;
        let span = PhaseSpan { periods: impact.periods, remainder: impact.remainder };
        let change = change_in_flight(system, self.state.angular_speed, span.radians());
        let platform_velocity = system.vibration().velocity(impact.phase);
        let platform_speed = system.platform_angular_speed(impact.phase);
        let slip = change.speed - platform_speed;
        let mut axial = axial_impulse(system.restitution(), impact.velocity);
        let rotary = friction_impact(system.friction(), axial, slip);
        let rebound = rebound_velocity(system.restitution(), impact.velocity);
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
            angular_speed: if rotary.capped { platform_speed } else { change.speed + rotary.impulse },
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
                restitution: system.restitution(),
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
        let system = &self.system;
        let accumulation = rest.accumulation;
        let from = self.now.phase;
        let cut = accumulation.error_bound.is_infinite();
        let segment = self.segment((!cut).then_some(rest.last_speed));
        let duration = accumulation.duration;
        // The paper's cut takes the last launch speed away by an impulse of its own.
        let chatter_speed = if cut { 0.0 } else { rest.last_speed };
        let chatter = Chatter::new(system, from, chatter_speed, self.state.angular_speed, duration);
        let change = change_in_flight(system, chatter.angular_speed, duration - chatter.time);
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
            // The sequence goes on for ever: what it does after the last impact counted is to follow the platform.
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
        let after = DiskState {
            mode: self.contact_mode(accumulation.phase, angular_speed),
            axial_velocity: platform_velocity,
            angular_speed,
            ..before
        };
        record_jump(&mut ledger, &before, &after);
        ledger.record_rounding(system.peak_acceleration(), platform_velocity);

        let time = PhaseTime { periods: self.now.periods + accumulation.turns, phase: accumulation.phase };
        let separation =
            rest.separation.map(|(phase, turns)| PhaseTime { periods: time.periods + turns, phase });
        self.moved_to(time, &after);
        self.stage = Stage::Contact { separation };
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

    fn advance_contact(&mut self, separation: Option<PhaseTime>) -> Result<Option<EventRecord>, Error> {
        let phase = self.now.phase;
        let limit = separation.map(|at| at.since(&self.now).radians());
        let due = match self.state.mode {
            Mode::Sliding(direction) => {
                let slip = self.state.angular_speed - self.system.platform_angular_speed(phase);
                self.friction
                    .slip_end(direction, phase, direction.sign() * slip, limit)?
                    .map(|span| (span, Event::SlipToStick))
            }
            Mode::Sticking | Mode::Flight => self
                .friction
                .stick_end(phase)
                .filter(|(time, _)| limit.is_none_or(|limit| *time < limit))
                .map(|(time, direction)| (PhaseSpan::from_radians(time), Event::StickToSlip(direction))),
        };
        let (time, event) = match (due, separation) {
            (Some((span, event)), _) => {
                // Rounding must not carry an event past the separation.
                let time = self.now.after(span);
                (separation.filter(|at| time.order(at) == Ordering::Greater).unwrap_or(time), event)
            }
            (None, Some(at)) => (at, Event::Separation),
            (None, None) => return Ok(None),
        };
        Ok(Some(self.contact_event(time, event, separation)))
    }

    fn contact_event(&mut self, time: PhaseTime, event: Event, separation: Option<PhaseTime>) -> EventRecord {
        let system = &self.system;
        let span = time.since(&self.now);
        let from = self.now.phase;
        let segment = self.segment(None);
        let change = change_in_contact(system, &segment.state, from, time.phase, span);
        let mut ledger =
            contact_ledger(system, &self.friction, &segment.state, (from, time.phase), span, &change);
        let platform_speed = system.platform_angular_speed(time.phase);
        self.angle.add(change.angle);
        let mut before = DiskState {
            mode: segment.state.mode,
            height: system.vibration().height(time.phase),
            axial_velocity: system.vibration().velocity(time.phase),
            angle: self.angle.value(),
            angular_speed: change.speed,
        };
        let (event, mode) = match (event, segment.state.mode) {
            (Event::StickToSlip(direction), _) => (event, Mode::Sliding(direction)),
            (Event::SlipToStick, Mode::Sliding(direction)) => {
                self.settle(&mut ledger, change, platform_speed);
                before.angular_speed = platform_speed;
                // A slip that begins and ends at the same instant is one of rounding: let nothing slip again here.
                let idle = span == PhaseSpan::ZERO
                    && SlipDirection::of(segment.state.angular_speed - system.platform_angular_speed(from))
                        .is_none();
                let spent = if idle { Spent::Both } else { Spent::One(direction) };
                match self.friction.onset(time.phase, spent) {
                    Some(next) => (Event::SlipReversal(next), Mode::Sliding(next)),
                    None => (Event::SlipToStick, Mode::Sticking),
                }
            }
            _ => (Event::Separation, Mode::Flight),
        };
        let after = DiskState { mode, ..before };
        self.moved_to(time, &after);
        self.stage = if mode == Mode::Flight { Stage::Flight } else { Stage::Contact { separation } };
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

    /// The mode of a disk on the platform with this angular speed.
    fn contact_mode(&self, phase: Phase, angular_speed: f64) -> Mode {
        let slip = angular_speed - self.system.platform_angular_speed(phase);
        SlipDirection::of(slip)
            .or_else(|| self.friction.onset(phase, Spent::None))
            .map_or(Mode::Sticking, Mode::Sliding)
    }

    const fn segment(&self, chatter_speed: Option<f64>) -> Segment {
        Segment { start: self.now, state: self.state, chatter_speed }
    }

    fn moved_to(&mut self, time: PhaseTime, state: &DiskState) {
        self.now = time;
        self.state = *state;
    }
}

/// Records a jump of the velocities at one height.
fn record_jump(ledger: &mut EnergyLedger, before: &DiskState, after: &DiskState) {
    ledger.record_axial_change([before.axial_velocity, after.axial_velocity], [before.height, after.height]);
    ledger.record_rotary_change(before.angular_speed, after.angular_speed);
}

impl Iterator for Engine {
    type Item = Result<EventRecord, Error>;

    fn next(&mut self) -> Option<Self::Item> {
        self.advance().transpose()
    }
}

#[cfg(test)]
mod chatter_tests;
#[cfg(test)]
mod tests;
