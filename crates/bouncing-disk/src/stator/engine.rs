//! The event engine of a disk on a stator that yields.

use std::f64::consts::TAU;
use std::sync::Arc;

use bouncing_disk_core::flight::MAX_FLIGHT_DURATION;
use bouncing_disk_core::numerics::elementary::{exp, exp_m1, hypot, ln_1p, sin_cos};

use super::impact::impact;
use super::linear_flow::{Functional, LinearFlow, Vector, dot};
use super::regime::{
    ANGLE, CLOSING, COS, Contact, DISPLACEMENTS, GAP, Grip, N, ONE, Regime, SIN, SPEED, State, VELOCITIES,
};
use super::{LoadLine, MODES, StatorSystem};
use crate::driven::DrivenStart;
use crate::error::{Error, moderate};
use crate::motion::energy::EnergyLedger;
use crate::motion::event::{Energies, Event, Motion, MotionRecord, SteeredMotion};
use crate::motion::phase_time::{PhaseSpan, PhaseTime};
use crate::motion::state::{DiskState, LongSum, Mode, SlipDirection};
use crate::motion::stator_ledger::StatorLedger;

/// A rebound after which the chatter would last for less than this (rad) ends at once: what the disk and the stator
/// do until then differs by the square of it.
const CHATTER: f64 = 1.0e-7;

/// Rounding of a functional at an event, in units of the sizes of its terms.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// Where rounding calls what slips a stick and what sticks a slip, the present motion goes on for so long (rad).
const TIE: f64 = 1.0e-6;

/// A contact whose modes come back to the same state after a period, within this share of it, repeats for ever.
const SAME: f64 = 1.0e-13;

/// Disk and modes at an instant.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct StatorState {
    /// The disk.
    pub disk: DiskState,
    /// Coordinate and speed of each mode, the steady motion included; zero for a mode that is not there.
    pub modes: [[f64; 2]; MODES],
}

/// An event, with what happened since the one before.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct StatorRecord {
    /// When it happened.
    pub time: PhaseTime,
    /// The event.
    pub event: Event,
    /// Just before.
    pub before: StatorState,
    /// Just after.
    pub after: StatorState,
    /// Axial impulse per unit mass, and angular impulse per moment of inertia; zero without an impact.
    pub axial_impulse: f64,
    /// The same by friction.
    pub angular_impulse: f64,
    /// Energy balance of the disk.
    pub ledger: EnergyLedger,
    /// Energy balance of the modes.
    pub stator: StatorLedger,
    /// Since the event before.
    pub span: PhaseSpan,
}

impl StatorRecord {
    /// The largest of the closures of both ledgers, relative to the sizes of the added terms.
    #[must_use]
    pub fn relative_closure(&self) -> f64 {
        let least = f64::MIN_POSITIVE / f64::EPSILON;
        (self.stator.closure().abs() / self.stator.magnitude.max(least)).max(self.ledger.relative_closure())
    }
}

/// The motion of a mode at an instant, as a sine about its mean place.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Vibration {
    /// Of the coordinate from its mean place.
    pub(crate) distance: f64,
    pub(crate) speed: f64,
    /// Of the sine, in units of that of the drive.
    pub(crate) frequency: f64,
}

impl Vibration {
    fn amplitude(self) -> f64 {
        hypot(self.distance, self.speed / self.frequency)
    }
}

/// What the disk does until the next event.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Stage {
    Flight(Launch),
    Contact { grip: Grip, forever: bool },
    Ended,
}

/// How a flight begins, which says which derivatives of the gap vanish at its start.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Launch {
    /// Above the platform.
    Air,
    /// From the platform with a speed.
    Rebound,
    /// By a force that falls to zero: in a rigid contact with no acceleration, in a soft one below the platform.
    /// With its third derivative.
    Release(f64),
    /// Below the platform of a soft contact, where spring and damper would pull.
    Below,
}

/// The motion of a disk on a stator that yields, as a lazy sequence of [`StatorRecord`]s. It ends where nothing more
/// can happen, and after an error.
#[derive(Debug, Clone)]
pub struct StatorEngine {
    pub(super) system: StatorSystem,
    pub(super) stage: Stage,
    pub(super) now: PhaseTime,
    pub(super) state: State,
    angle: LongSum,
    /// The line of the load.
    pub(super) line: usize,
    /// Changes between stick and slide at the same instant.
    ties: u32,
    /// So long after the last event the disk flies without another one.
    searched: f64,
    /// So long the disk has flown before `now`.
    aloft: f64,
    /// Without it ledgers stay empty.
    pub(crate) with_energy: bool,
}

/// The next event of a stage: after which time, and which.
type Next = Option<(f64, Crossing)>;

/// Bounds of the stator's height and of its acceleration.
pub(super) struct Bounds {
    pub(super) height: f64,
    acceleration: f64,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Crossing {
    /// The gap closes, with this relative velocity.
    Touch(f64),
    /// The force of a soft contact sets in before the spring is free.
    Recontact,
    /// The normal force falls to zero.
    Release,
    /// The slip ends.
    SlipEnd,
    /// Friction gives way, and the disk slides so.
    Slips(Grip),
    /// The speed reaches another line of the load.
    Line(usize),
}

impl Crossing {
    const fn is_of_friction(self) -> bool {
        matches!(self, Self::SlipEnd | Self::Slips(_))
    }
}

impl StatorEngine {
    /// An engine for a disk that starts in contact, by a launch or in the air, on a stator in its steady motion without
    /// a disk. A disk in contact within a rounding of the stator's angular speed sticks or begins to slide.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for an illegal start.
    pub fn new(system: StatorSystem, start: DrivenStart) -> Result<Self, Error> {
        let (phase, gap, velocity, speed) = match start {
            DrivenStart::Contact { phase, angular_speed } => (phase, None, 0.0, angular_speed),
            DrivenStart::Launch { phase, relative_speed, angular_speed } => {
                (phase, Some(0.0), relative_speed, angular_speed)
            }
            DrivenStart::Flight { phase, gap, relative_velocity, angular_speed } => {
                (phase, Some(gap), relative_velocity, angular_speed)
            }
        };
        let mut state = [0.0; N];
        (state[GAP], state[CLOSING]) =
            (moderate("gap", gap.unwrap_or(0.0))?, moderate("relative_velocity", velocity)?);
        state[SPEED] = moderate("angular_speed", speed)?;
        crate::error::check(state[GAP] >= 0.0, "gap", state[GAP], "[0, 1e100]")?;
        Self::begin(system, PhaseTime::in_first_period(phase), state, gap.is_none())
    }

    /// An engine that goes on with a motion, as [`Self::state_after`] gives it: in contact the height and velocity of the
    /// disk on a rigid stator are those of the stator.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for numbers that are not finite, and a disk below a rigid stator by more than rounding.
    pub fn of_state(system: StatorSystem, time: PhaseTime, from: StatorState) -> Result<Self, Error> {
        let mut state = [0.0; N];
        let (sin, cos) = (time.phase.sin(), time.phase.cos());
        for (index, [place, speed]) in from.modes.into_iter().enumerate() {
            let steady = system.steady(index, (sin, cos));
            state[DISPLACEMENTS[index]] = moderate("coordinate of a mode", place)? - steady[0];
            state[VELOCITIES[index]] = moderate("speed of a mode", speed)? - steady[1];
        }
        (state[SIN], state[COS], state[ONE]) = (sin, cos, 1.0);
        let [height, velocity] = system.tip(&state);
        state[GAP] = moderate("height", from.disk.height)? - height;
        state[CLOSING] = moderate("axial_velocity", from.disk.axial_velocity)? - velocity;
        state[SPEED] = moderate("angular_speed", from.disk.angular_speed)?;
        let rounding = 1.0e-12 * (height.abs() + from.disk.height.abs());
        let lies = from.disk.mode != Mode::Flight;
        if system.contact == Contact::Rigid {
            crate::error::check(lies || state[GAP] >= -rounding, "gap", state[GAP], "[0, 1e100]")?;
            state[GAP] = state[GAP].max(0.0);
        }
        let mut engine = Self::begin(system, time, state, lies)?;
        engine.angle = LongSum::new(moderate("angle", from.disk.angle)?);
        Ok(engine)
    }

    fn begin(system: StatorSystem, now: PhaseTime, mut state: State, lies: bool) -> Result<Self, Error> {
        (state[SIN], state[COS], state[ONE]) = (now.phase.sin(), now.phase.cos(), 1.0);
        let stage = Stage::Flight(if state[GAP] > 0.0 { Launch::Air } else { Launch::Rebound });
        let mut engine = Self {
            system,
            stage,
            now,
            state,
            angle: LongSum::new(0.0),
            line: 0,
            ties: 0,
            searched: 0.0,
            aloft: 0.0,
            with_energy: true,
        };
        engine.line = engine.line_at(engine.state[SPEED]);
        match engine.system.contact {
            Contact::Rigid if lies => engine.lie_down(),
            Contact::Soft { stiffness, .. } if lies => {
                if engine.state[GAP] == 0.0 && engine.state[CLOSING] == 0.0 {
                    // The indentation that carries the disk on the stator that moves as it does without it.
                    let load = 1.0 - engine.system.height[0] * engine.state[SIN];
                    engine.state[GAP] = -load.max(0.0) / stiffness;
                }
                engine.press();
            }
            Contact::Soft { .. } if engine.state[GAP] < 0.0 => engine.press(),
            Contact::Soft { .. } if engine.state[GAP] == 0.0 && engine.state[CLOSING] == 0.0 => {
                let flow = &engine.system.regimes[engine.line][0].flow;
                if first_sign(flow, &flow.derivative(&closing()), &engine.state) != Some((0, true)) {
                    engine.press();
                }
            }
            Contact::Rigid if engine.state[GAP] == 0.0 => engine.leave(),
            _ => {}
        }
        Ok(engine)
    }

    /// The system.
    #[must_use]
    pub const fn system(&self) -> &StatorSystem {
        &self.system
    }

    /// The instant of the last event, or of the start.
    #[must_use]
    pub const fn time(&self) -> PhaseTime {
        self.now
    }

    /// Disk and modes just after the last event, or at the start.
    #[must_use]
    pub fn state(&self) -> StatorState {
        self.stated(&self.state, self.mode())
    }

    /// When, and disk and modes, `span` radians after the last event, if no event comes before. A negative span and NaN
    /// count as zero.
    #[must_use]
    pub fn state_after(&self, span: f64) -> (PhaseTime, StatorState) {
        let span = if span > 0.0 { span.min(MAX_FLIGHT_DURATION) } else { 0.0 };
        let state = self.carried(span);
        (self.now.after(PhaseSpan::from_radians(span)), self.stated(&state, self.mode()))
    }

    /// The energy balances of disk and modes from the last event to `span` radians later.
    #[must_use]
    pub fn ledgers_after(&self, span: f64) -> (EnergyLedger, StatorLedger) {
        let span = if span > 0.0 { span.min(MAX_FLIGHT_DURATION) } else { 0.0 };
        self.ledgers(span, &self.carried(span))
    }

    /// The energy of the spring of a contact that takes time, so long after the last event.
    pub(crate) fn spring_energy(&self, span: f64) -> f64 {
        match self.system.contact {
            Contact::Soft { stiffness, .. } => {
                let gap = self.carried(span.max(0.0))[GAP].min(0.0);
                0.5 * stiffness * gap * gap
            }
            Contact::Rigid => 0.0,
        }
    }

    /// Whether a flight begins now.
    pub(crate) const fn launches(&self) -> bool {
        matches!(self.stage, Stage::Flight(_))
    }

    /// Whether the disk never leaves the stator again, as far as is known, or the motion has ended.
    #[must_use]
    pub const fn lies_for_ever(&self) -> bool {
        matches!(self.stage, Stage::Contact { forever: true, .. } | Stage::Ended)
    }

    /// Adds a relative speed >= 0 to a flight that starts now from the stator; does nothing at any other time.
    pub(crate) fn perturb_launch(&mut self, speed: f64) {
        if let Stage::Flight(launch @ (Launch::Rebound | Launch::Release(_))) = &mut self.stage {
            self.state[CLOSING] += speed;
            self.searched = 0.0;
            if speed > 0.0 {
                *launch = if self.state[GAP] < 0.0 { Launch::Below } else { Launch::Rebound };
            }
        }
    }

    /// The amplitude of the first mode, if it moves in height, so long after the last event.
    pub(crate) fn amplitude_after(&self, span: f64) -> Option<f64> {
        (self.system.modes[0].height != 0.0).then(|| self.vibration_after(span)[0].amplitude())
    }

    /// How each mode vibrates so long after the last event: at the frequency of the drive, or at its own resonance if
    /// nothing drives the modes.
    pub(crate) fn vibration_after(&self, span: f64) -> [Vibration; MODES] {
        let state = if span > 0.0 { self.carried(span) } else { self.state };
        let means = self.bent(self.mean_forces(&state, self.aloft + span));
        let still = self.system.modes.iter().all(|mode| mode.steady.iter().all(|part| *part == 0.0));
        std::array::from_fn(|index| {
            let [place, speed] = self.mode_state(index, &state);
            let frequency = if still { self.system.modes[index].stiffness.sqrt() } else { 1.0 };
            Vibration { distance: place - means[index], speed, frequency }
        })
    }

    /// The mean normal force and the mean torque of friction on a disk in this state that is `aloft` for so long: its
    /// weight, and what holds against the load or slips; nothing in a flight that is longer than a period.
    fn mean_forces(&self, state: &State, aloft: f64) -> [f64; 2] {
        match self.stage {
            Stage::Flight(_) if aloft > TAU => [0.0; 2],
            Stage::Contact { grip: grip @ (Grip::Forward | Grip::Backward), .. } => {
                [1.0, -grip.sign() * self.system.base.friction()]
            }
            _ => [1.0, self.held_load(state)],
        }
    }

    /// The load on a disk, as far as friction holds it.
    fn held_load(&self, state: &State) -> f64 {
        let LoadLine { torque, slope, .. } = self.system.lines[self.line];
        let friction = self.system.base.friction();
        (torque + slope * state[SPEED]).clamp(-friction, friction)
    }

    /// Where a constant normal force and torque bend each mode to.
    fn bent(&self, [force, torque]: [f64; 2]) -> [f64; MODES] {
        self.system.modes.map(|mode| {
            if mode.stiffness == 0.0 {
                return 0.0;
            }
            -(mode.by_force * force + mode.by_torque * torque) / mode.stiffness
        })
    }

    /// Moves the origin of the present motion to `span` later, in which time no event comes.
    pub(crate) fn pause(&mut self, span: f64) -> StatorRecord {
        let span = if span > 0.0 { span.min(MAX_FLIGHT_DURATION) } else { 0.0 };
        let state = self.carried(span);
        let (ledger, stator) = if self.with_energy { self.ledgers(span, &state) } else { Default::default() };
        self.now = self.now.after(PhaseSpan::from_radians(span));
        self.state = state;
        self.searched = 0.0;
        (self.state[SIN], self.state[COS]) = (self.now.phase.sin(), self.now.phase.cos());
        self.angle.add(self.state[ANGLE]);
        self.state[ANGLE] = 0.0;
        if span > 0.0
            && let Stage::Flight(launch) = &mut self.stage
        {
            self.aloft += span;
            *launch = if self.state[GAP] < 0.0 { Launch::Below } else { Launch::Air };
        }
        let here = self.state();
        StatorRecord {
            time: self.now,
            event: Event::Joint,
            before: here,
            after: here,
            axial_impulse: 0.0,
            angular_impulse: 0.0,
            ledger,
            stator,
            span: PhaseSpan::from_radians(span),
        }
    }

    /// Moves a disk that lies for ever by whole periods, in which all repeats but the angle and a speed that drifts; the
    /// energies of one of them. `None` where it does not lie for ever, or a load changes with a speed that drifts.
    pub(crate) fn skip_periods(&mut self, periods: u64) -> Option<StatorRecord> {
        let Stage::Contact { forever: true, .. } = self.stage else { return None };
        let mut after = self.clone();
        let record = after.pause(TAU);
        let mut gained = after.state[SPEED] - self.state[SPEED];
        if gained.abs() <= SAME * (1.0 + self.state[SPEED].abs()) {
            gained = 0.0;
        } else if self.system.lines[self.line].slope != 0.0 {
            return None;
        }
        let (count, turned) = (periods as f64, record.after.disk.angle - self.angle.value());
        self.now = self.now.after(PhaseSpan { periods, remainder: 0.0 });
        self.state[SPEED] += count * gained;
        self.angle.add(count * (turned + 0.5 * TAU * gained * (count - 1.0)));
        Some(record)
    }

    /// Stills the modes under a disk that lies at rest, where its weight and its load bend them to.
    pub(crate) fn calm(&mut self) {
        let means = self.bent([1.0, self.held_load(&self.state)]);
        for (index, mean) in means.into_iter().enumerate() {
            let [place, speed] = self.system.steady(index, (self.state[SIN], self.state[COS]));
            (self.state[DISPLACEMENTS[index]], self.state[VELOCITIES[index]]) = (mean - place, -speed);
        }
        self.searched = 0.0;
        self.go_on();
    }

    /// Ends the present motion `span` radians after the last event, if no event comes before, and goes on with another
    /// system of the same units: the drive is switched, or the load changes. Modes and
    /// disk are continuous; what no mode moves jumps, and the disk keeps its distance.
    pub fn switch(&mut self, span: f64, to: StatorSystem) -> StatorRecord {
        self.switch_units(span, to, 1.0)
    }

    /// [`Self::switch`] to a system whose drive is so many times `faster`, in whose units the record says what is after
    /// it.
    pub(crate) fn switch_units(&mut self, span: f64, to: StatorSystem, faster: f64) -> StatorRecord {
        let mut record = self.pause(span);
        let phase = (self.state[SIN], self.state[COS]);
        let longer = faster * faster;
        for index in 0..MODES {
            let (old, new) = (self.system.steady(index, phase), to.steady(index, phase));
            let [place, speed] = [DISPLACEMENTS[index], VELOCITIES[index]];
            self.state[place] = self.state[place] * longer + (old[0] * longer - new[0]);
            self.state[speed] = self.state[speed] * faster + (old[1] * faster - new[1]);
        }
        self.state[GAP] *= longer;
        self.state[CLOSING] *= faster;
        self.state[SPEED] *= faster;
        self.aloft *= faster;
        self.angle.scale(longer);
        self.system = to;
        self.go_on();
        record.after = self.state();
        record
    }

    /// With another system or other modes.
    fn go_on(&mut self) {
        self.line = self.line_at(self.state[SPEED]);
        match (self.stage, self.system.contact) {
            (Stage::Contact { .. }, Contact::Rigid) => self.lie_down(),
            (Stage::Contact { .. }, Contact::Soft { .. }) => self.press(),
            (Stage::Flight(Launch::Rebound | Launch::Release(_)), Contact::Rigid) => self.leave(),
            _ => {}
        }
    }

    /// The next event, or `None` after the last one.
    ///
    /// # Errors
    /// An error of the core where a root does not converge. An error ends the motion.
    pub fn advance(&mut self) -> Result<Option<StatorRecord>, Error> {
        self.advance_within(f64::INFINITY)
    }

    /// The next event if it comes within `limit` radians of the last one. Without one the engine stays where it is.
    pub(crate) fn advance_within(&mut self, limit: f64) -> Result<Option<StatorRecord>, Error> {
        let next = match self.stage {
            Stage::Flight(launch) => {
                let line = self.next_line().filter(|(after, _)| *after < limit);
                let mut searched = self.searched;
                let next = self.flight_end(launch, line.map_or(limit, |(after, _)| after), &mut searched);
                self.searched = searched;
                next.map(|next| next.or_else(|| line.map(|(after, line)| (after, Crossing::Line(line)))))
            }
            Stage::Contact { grip, .. } => self.contact_end(grip, limit),
            Stage::Ended => Ok(None),
        };
        match next {
            Ok(Some((span, crossing))) => Ok(Some(self.cross(span, crossing))),
            Ok(None) => Ok(None),
            Err(error) => {
                self.stage = Stage::Ended;
                Err(error)
            }
        }
    }

    const fn regime_index(&self) -> usize {
        match self.stage {
            Stage::Flight(_) | Stage::Ended => 0,
            Stage::Contact { grip: Grip::Stick, .. } => 1,
            Stage::Contact { grip: Grip::Forward, .. } => 2,
            Stage::Contact { grip: Grip::Backward, .. } => 3,
        }
    }

    pub(super) fn regime(&self) -> &Regime {
        &self.system.regimes[self.line][self.regime_index()]
    }

    pub(super) const fn mode(&self) -> Mode {
        match self.stage {
            Stage::Flight(_) | Stage::Ended => Mode::Flight,
            Stage::Contact { grip: Grip::Stick, .. } => Mode::Sticking,
            Stage::Contact { grip: Grip::Forward, .. } => Mode::Sliding(SlipDirection::Forward),
            Stage::Contact { grip: Grip::Backward, .. } => Mode::Sliding(SlipDirection::Backward),
        }
    }

    pub(super) fn stated(&self, state: &State, mode: Mode) -> StatorState {
        let [height, velocity] = self.system.tip(state);
        StatorState {
            disk: DiskState {
                mode,
                height: height + state[GAP],
                axial_velocity: velocity + state[CLOSING],
                angle: self.angle.value() + state[ANGLE],
                angular_speed: state[SPEED],
            },
            modes: std::array::from_fn(|index| {
                let [place, speed] = self.system.steady(index, (state[SIN], state[COS]));
                [place + state[DISPLACEMENTS[index]], speed + state[VELOCITIES[index]]]
            }),
        }
    }

    /// The first impact of a flight, or the return of the force of a soft contact, when there is none in what is
    /// `searched` of the flight.
    fn flight_end(&self, launch: Launch, limit: f64, searched: &mut f64) -> Result<Next, Error> {
        let regime = self.regime();
        let step = regime.flow.step();
        let soft = self.system.contact != Contact::Rigid;
        let [height, velocity] = self.system.tip(&self.state);
        let (x, v) = (self.state[GAP] + height, self.state[CLOSING] + velocity);
        if self.state[GAP] <= 0.0
            && self.state[CLOSING] < 0.0
            && matches!(launch, Launch::Air | Launch::Rebound)
        {
            return Ok(Some((0.0, Crossing::Touch(self.state[CLOSING]))));
        }
        let highest = self.bounds(&self.state).height;
        let (mut passed, mut state) = (*searched, self.state);
        if passed > 0.0 {
            state = self.flown(passed);
        }
        // A soft contact ends before its spring is free: below the stator the force may set in again.
        let mut inside = soft && passed == 0.0 && self.state[GAP] < 0.0;
        loop {
            if !inside && passed < limit {
                (passed, state) = self.cleared(passed, state);
                *searched = passed;
            }
            let left = limit - passed;
            if left <= 0.0 {
                return Ok(None);
            }
            if passed > MAX_FLIGHT_DURATION {
                let error = bouncing_disk_core::Error::NoConvergence {
                    evaluations: 0,
                    time: passed,
                    gap: state[GAP],
                };
                return Err(error.into());
            }
            // The parabola is rounded in units of its terms.
            let error = if passed > 0.0 {
                0.125 * ROUNDING * (x.abs() + passed * (v.abs() + passed) + highest)
            } else {
                0.0
            };
            let mut gap = regime.gap.along(&state, error);
            if passed == 0.0 && !inside {
                gap = match launch {
                    Launch::Air | Launch::Below => gap,
                    Launch::Rebound => gap.starting_with(&[0.0, self.state[CLOSING]]),
                    Launch::Release(_) if soft => gap.starting_with(&[0.0, self.state[CLOSING]]),
                    Launch::Release(third) => {
                        gap.starting_with(&[0.0, 0.0, 0.0, third.max(f64::MIN_POSITIVE)])
                    }
                };
            }
            if inside {
                let rises = regime.gap.along(&state, error).negated();
                let mut pull = regime.force.along(&state, error).negated();
                if passed == 0.0 && matches!(launch, Launch::Release(_)) {
                    pull = pull.starting_with(&[0.0]);
                }
                let free = rises.first_fall(left)?.map(|[at, _]| at);
                if let Some([at, _]) = pull.first_fall(free.unwrap_or(left))? {
                    return Ok(Some((passed + at, Crossing::Recontact)));
                }
                if let Some(at) = free {
                    inside = false;
                    // On from where the gap is zero.
                    state = self.flown(passed + at);
                    passed += at;
                    state[GAP] = 0.0;
                    if state[CLOSING] > 0.0 {
                        let gap = regime.gap.along(&state, 0.0).starting_with(&[0.0, state[CLOSING]]);
                        if let Some([at, slope]) = gap.first_fall(limit - passed)? {
                            return Ok(Some((passed + at, Crossing::Touch(slope))));
                        }
                        passed += step;
                        state = self.flown(passed);
                    }
                    continue;
                }
            } else if let Some([at, slope]) = match launch {
                Launch::Release(_) if passed == 0.0 && !soft => {
                    let cubed =
                        |[at, slope]: [f64; 2]| [at, slope * ((at / step) * (at / step) * (at / step))];
                    gap.deflated(3).first_fall(left)?.map(cubed)
                }
                _ => gap.first_fall(left)?,
            } && (slope < 0.0 || passed + at > 0.0)
            {
                return Ok(Some((passed + at, Crossing::Touch(slope.min(0.0)))));
            }
            passed += step;
            state = self.flown(passed);
        }
    }

    /// Bounds on what the stator does from a state on, while its modes ring down.
    pub(super) fn bounds(&self, state: &State) -> Bounds {
        let [a, b] = self.system.height;
        let steady = (a * a + b * b).sqrt();
        let mut bounds = Bounds { height: steady, acceleration: steady };
        for (index, mode) in self.system.modes.iter().enumerate() {
            if mode.height != 0.0 {
                let (r, speed) = (state[DISPLACEMENTS[index]], state[VELOCITIES[index]]);
                let ringing = mode.height.abs() * (r * r + speed * speed / mode.stiffness).sqrt();
                bounds.height += ringing;
                bounds.acceleration += ringing * (mode.stiffness + mode.damping * mode.stiffness.sqrt());
            }
        }
        bounds
    }

    /// The time from which on a disk that flies `passed` after the last event may touch the stator again, and the state
    /// then: it is higher than the stator comes, or the gap cannot close yet with the largest acceleration.
    fn cleared(&self, mut passed: f64, mut state: State) -> (f64, State) {
        let step = self.regime().flow.step();
        loop {
            let Bounds { height: highest, acceleration } = self.bounds(&state);
            let [height, velocity] = self.system.tip(&state);
            // When a fall from this height with this velocity ends.
            let lands = |above: f64, velocity: f64, pull: f64| {
                (velocity + (velocity * velocity + 2.0 * pull * above.max(0.0)).sqrt()) / pull
            };
            let (above, v) = (state[GAP] + height - highest, state[CLOSING] + velocity);
            let free = if above > 0.0 { lands(above, v, 1.0) } else { 0.0 };
            let clear = free.max(lands(state[GAP], state[CLOSING], 1.0 + acceleration)) - 0.25 * step;
            if clear < step {
                return (passed, state);
            }
            passed += clear;
            state = self.flown(passed);
        }
    }

    /// Disk and modes in flight, so long after the last event, in closed form.
    fn flown(&self, time: f64) -> State {
        let from = &self.state;
        let mut state = *from;
        let [height, velocity] = self.system.tip(from);
        (state[SIN], state[COS]) = self.phase_after(time);
        for (index, mode) in self.system.modes.iter().enumerate() {
            let ringing = [from[DISPLACEMENTS[index]], from[VELOCITIES[index]]];
            let ringing = if mode.stiffness > 0.0 {
                rung(mode.stiffness, mode.damping, ringing, time)
            } else {
                ringing
            };
            [state[DISPLACEMENTS[index]], state[VELOCITIES[index]]] = ringing;
        }
        let [tip, speed] = self.system.tip(&state);
        let start = from[CLOSING] + velocity;
        state[GAP] = from[GAP] + (time * (start - 0.5 * time) - (tip - height));
        state[CLOSING] = (start - time) - speed;
        let LoadLine { torque, slope, .. } = self.system.lines[self.line];
        let load = torque + slope * from[SPEED];
        let (once, twice) = exponential_integrals(slope, time);
        state[ANGLE] = from[ANGLE] + (time * from[SPEED] - load * twice);
        state[SPEED] = from[SPEED] - load * once;
        state
    }

    /// The line of the load at a speed; at a node that to which the load drives the disk.
    fn line_at(&self, speed: f64) -> usize {
        let lines = &self.system.lines;
        let index = lines.iter().rposition(|line| speed >= line.from).unwrap_or(0);
        let line = &lines[index];
        let falls = line.torque + line.slope * speed > 0.0;
        if speed <= line.from && falls { index.saturating_sub(1) } else { index }
    }

    /// When a disk in flight reaches another line of the load.
    fn next_line(&self) -> Option<(f64, usize)> {
        let LoadLine { from, to, torque, slope } = self.system.lines[self.line];
        let speed = self.state[SPEED];
        let load = torque + slope * speed;
        let (node, next) = if load > 0.0 { (from, self.line.checked_sub(1)?) } else { (to, self.line + 1) };
        let rounding = ROUNDING * (torque.abs() + (slope * speed).abs());
        if load.abs() <= rounding || !node.is_finite() {
            return None;
        }
        // (speed - node)/load is the integral of exp(-slope t).
        let share = ((speed - node) / load).max(0.0);
        let after = if slope == 0.0 {
            share
        } else if slope * share < 1.0 {
            -ln_1p(-slope * share) / slope
        } else {
            return None;
        };
        Some((after, next))
    }

    /// The end of a contact, or of a slide or a stick in it.
    fn contact_end(&mut self, grip: Grip, limit: f64) -> Result<Next, Error> {
        if self.lies_for_ever() {
            return Ok(None);
        }
        let regimes = Arc::clone(&self.system.regimes);
        let regime = &regimes[self.line][self.regime_index()];
        let step = regime.flow.step();
        let mut watched: Vec<(&Functional<N>, Crossing)> = vec![(&regime.force, Crossing::Release)];
        for (node, line) in regime.nodes.iter().zip([self.line.wrapping_sub(1), self.line + 1]) {
            watched.extend(node.iter().map(|node| (node, Crossing::Line(line))));
        }
        if self.system.base.friction() > 0.0 {
            match grip {
                Grip::Stick => {
                    watched.push((&regime.hold[0], Crossing::Slips(Grip::Backward)));
                    watched.push((&regime.hold[1], Crossing::Slips(Grip::Forward)));
                }
                Grip::Forward | Grip::Backward => watched.push((&regime.slip, Crossing::SlipEnd)),
            }
        }
        let mut resting = vec![false; watched.len()];
        let (mut passed, mut state, mut begun) = (0.0, self.state, self.state);
        let mut steps: u64 = 0;
        let whole = (TAU / step + 0.5) as u64;
        loop {
            let left = limit - passed;
            if left <= 0.0 {
                return Ok(None);
            }
            let mut first: Next = None;
            for (index, (functional, crossing)) in watched.iter().enumerate() {
                if resting[index] {
                    continue;
                }
                let error = ROUNDING * (steps as f64).sqrt() * size(functional.now(), &state);
                let (mut along, mut from) = (functional.along(&state, error), 0.0);
                if passed == 0.0 {
                    match first_sign(&regime.flow, functional.now(), &self.state) {
                        Some((order, false))
                            if order > 0 && *crossing == Crossing::Release && self.touches(&self.state) =>
                        {
                            from = TIE;
                        }
                        Some((_, false)) if self.ties < 2 || !crossing.is_of_friction() => {
                            return Ok(Some((0.0, *crossing)));
                        }
                        Some((_, false)) => from = TIE,
                        Some((0, true)) => {}
                        Some((order, true)) if order < 4 => along = along.starting_with(&[0.0; 3][..order]),
                        // It rests at zero, or leaves it too slowly to be told from that yet.
                        _ => {
                            resting[index] = true;
                            continue;
                        }
                    }
                }
                let until = first.map_or(left, |(at, _)| at);
                let mut fall = along.first_fall_from(from, until)?;
                if *crossing == Crossing::Release
                    && let Some([at, _]) = fall
                    && self.touches(&regime.flow.after(&state, at))
                {
                    fall = along.first_fall_from(at + TIE, until)?;
                }
                if let Some([at, _]) = fall
                    && at < until
                {
                    first = Some((at, *crossing));
                }
            }
            if let Some((at, crossing)) = first {
                return Ok(Some((passed + at, crossing)));
            }
            if left < step {
                // What comes later in this step has not been looked for.
                return Ok(None);
            }
            steps += 1;
            passed = steps as f64 * step;
            state = regime.flow.advance(&state);
            // A whole number of steps is a period.
            (state[SIN], state[COS]) = sin_cos(self.now.phase.angle() + (steps % whole) as f64 * step);
            if steps.is_multiple_of(whole) {
                if repeats(&begun, &state) {
                    // Whether the speed drifts to the end of the slide, or to another line of the load.
                    let gained = state[SPEED] - begun[SPEED];
                    let drifts = gained.abs() > SAME * (1.0 + state[SPEED].abs());
                    let slides_on = grip.sign() * gained >= 0.0 || self.system.base.friction() == 0.0;
                    let node = usize::from(gained > 0.0);
                    if !drifts || slides_on && regime.nodes[node].is_none() {
                        self.stage = Stage::Contact { grip, forever: true };
                        return Ok(None);
                    }
                }
                begun = state;
            }
            if passed > MAX_FLIGHT_DURATION {
                return Err(Error::SlipTooLong { duration: passed, limit: MAX_FLIGHT_DURATION });
            }
        }
    }

    /// Whether the force of a rigid contact falls below zero for less than a chatter that is cut: a flight that is no
    /// higher than its rounding.
    fn touches(&self, state: &State) -> bool {
        let flow = &self.regime().flow;
        let slope = flow.derivative(self.regime().force.now());
        let bend = dot(&flow.derivative(&slope), state);
        self.system.contact == Contact::Rigid && bend > 0.0 && dot(&slope, state) > -0.5 * CHATTER * bend
    }

    /// Disk and modes so long after the last event, if no event comes before.
    pub(super) fn carried(&self, time: f64) -> State {
        let flow = &self.regime().flow;
        // In a shorter flight a low gap would be the difference of two heights.
        if !matches!(self.stage, Stage::Contact { .. }) && time > flow.step() {
            return self.flown(time);
        }
        let mut state = self.state;
        let whole = (time / flow.step()) as u64;
        for _ in 0..whole {
            state = flow.advance(&state);
        }
        let rest = time - whole as f64 * flow.step();
        if rest > 0.0 {
            state = flow.after(&state, rest);
        }
        (state[SIN], state[COS]) = self.phase_after(time);
        state
    }

    /// Sine and cosine of the phase so long after the last event. The sum of the phase and a short time is rounded by more
    /// than an energy ledger allows where a mode turns back: so the phase is turned by the time.
    pub(super) fn phase_after(&self, time: f64) -> (f64, f64) {
        if time > 1.0 {
            return sin_cos(self.now.phase.angle() + time);
        }
        let ([from_sin, from_cos], (sin, cos)) = ([self.state[SIN], self.state[COS]], sin_cos(time));
        (from_sin * cos + from_cos * sin, from_cos * cos - from_sin * sin)
    }

    /// The event, after which the engine is there.
    fn cross(&mut self, span: f64, crossing: Crossing) -> StatorRecord {
        let mut state = self.carried(span);
        let rigid = self.system.contact == Contact::Rigid;
        if let Crossing::Touch(velocity) = crossing {
            (state[GAP], state[CLOSING]) = (0.0, velocity);
        }
        let (mut ledger, mut stator) =
            if self.with_energy { self.ledgers(span, &state) } else { Default::default() };
        let before = self.stated(&state, self.mode());
        self.ties = if span == 0.0 && crossing.is_of_friction() { self.ties + 1 } else { 0 };
        let flies_on = self.launches() && matches!(crossing, Crossing::Line(_));
        self.aloft = if flies_on { self.aloft + span } else { 0.0 };
        self.now = self.now.after(PhaseSpan::from_radians(span));
        // The phase of the clock decides.
        (state[SIN], state[COS]) = (self.now.phase.sin(), self.now.phase.cos());
        self.state = state;
        self.searched = 0.0;
        let slip = self.slip();
        let (mut axial, mut angular) = (0.0, 0.0);
        let event = match crossing {
            Crossing::Touch(velocity) if rigid => {
                let (event, impulses) = self.hit(velocity, slip, &mut ledger, &mut stator);
                (axial, angular) = (impulses[0], impulses[1]);
                event
            }
            Crossing::Touch(velocity) => {
                self.press();
                Event::Impact {
                    axial_impact_velocity: velocity,
                    tangential_impact_velocity: slip,
                    capped: false,
                }
            }
            Crossing::Recontact => {
                self.press();
                Event::Recontact
            }
            Crossing::Release => {
                // The force falls through zero: so the gap opens, whatever rounding makes of its derivatives.
                let regime = self.regime();
                let falls = -dot(&regime.flow.derivative(regime.force.now()), &self.state);
                self.stage = Stage::Flight(Launch::Release(0.0));
                if rigid {
                    self.state[CLOSING] = 0.0;
                    let flow = &self.system.regimes[self.line][0].flow;
                    let away = flow.derivative(&closing());
                    let third = dot(&flow.derivative(&away), &self.state);
                    let third = if third > 0.0 { third } else { self.system.mobility()[0][0] * falls };
                    self.stage = Stage::Flight(Launch::Release(third));
                    if first_sign(flow, &away, &self.state) == Some((0, true)) {
                        self.stage = Stage::Flight(Launch::Rebound);
                    }
                }
                Event::Separation
            }
            Crossing::SlipEnd => {
                let spent = self.mode();
                let slid = self.state[SPEED];
                self.state[SPEED] -= slip;
                let [work, loss] = [-slip * self.state[SPEED], 0.5 * slip * slip];
                ledger.record_friction(work, loss, work.abs() + loss);
                ledger.record_rotary_change(slid, self.state[SPEED]);
                match self.onset(Some(spent)) {
                    Grip::Stick => {
                        self.stage = Stage::Contact { grip: Grip::Stick, forever: false };
                        Event::SlipToStick
                    }
                    slide => {
                        self.stage = Stage::Contact { grip: slide, forever: false };
                        Event::SlipReversal(direction(slide))
                    }
                }
            }
            Crossing::Line(line) => {
                let old = self.system.lines[self.line];
                self.state[SPEED] = if line < self.line { old.from } else { old.to };
                self.line = line;
                if let Stage::Flight(launch) = &mut self.stage
                    && span > 0.0
                {
                    *launch = if self.state[GAP] < 0.0 { Launch::Below } else { Launch::Air };
                }
                Event::Joint
            }
            Crossing::Slips(slide) => {
                self.stage = Stage::Contact { grip: slide, forever: false };
                Event::StickToSlip(direction(slide))
            }
        };
        self.angle.add(self.state[ANGLE]);
        self.state[ANGLE] = 0.0;
        let after = self.state();
        StatorRecord {
            time: self.now,
            event,
            before,
            after,
            axial_impulse: axial,
            angular_impulse: angular,
            ledger,
            stator,
            span: PhaseSpan::from_radians(span),
        }
    }

    /// Disk minus stator, angular speeds.
    fn slip(&self) -> f64 {
        self.state[SPEED] - self.system.twist(&self.state)[1]
    }

    /// A rigid impact; the event, and its impulses.
    fn hit(
        &mut self,
        velocity: f64,
        slip: f64,
        ledger: &mut EnergyLedger,
        stator: &mut StatorLedger,
    ) -> (Event, [f64; 2]) {
        let base = self.system.base;
        let mobility = self.system.mobility();
        let mut done = impact(mobility, base.friction(), base.restitution(), [velocity, slip]);
        // Free of each other, disk and stator approach with this acceleration.
        let mut thrown = self.state;
        for (index, mode) in self.system.modes.iter().enumerate() {
            thrown[VELOCITIES[index]] -= mode.by_force * done.normal + mode.by_torque * done.friction;
        }
        let approach = -dot(&self.system.regimes[self.line][0].flow.derivative(&closing()), &thrown);
        let lasts = 2.0 * done.velocity / (approach * (1.0 - base.restitution()));
        let rests = approach > 0.0 && lasts < CHATTER;
        if rests {
            done = impact(mobility, base.friction(), 0.0, [velocity, slip]);
        }
        let before = self.stated(&self.state, Mode::Flight);
        let start = self.state;
        let joint = done.joint;
        let place = |[p, t]: [f64; 2]| {
            let mut state = start;
            for (index, mode) in self.system.modes.iter().enumerate() {
                state[VELOCITIES[index]] -= mode.by_force * p + mode.by_torque * t;
            }
            state
        };
        let (middle, mut end) = (place(joint), place([done.normal, done.friction]));
        if self.with_energy {
            let tip = [&start, &middle, &end].map(|state| self.system.tip(state)[1]);
            let turn = [&start, &middle, &end].map(|state| self.system.twist(state)[1]);
            let along = |speeds: [f64; 3], first: f64, whole: f64| {
                0.5 * ((speeds[0] + speeds[1]) * first + (speeds[1] + speeds[2]) * (whole - first))
            };
            ledger.record_normal(along(tip, joint[0], done.normal), done.normal_loss);
            let work = along(turn, joint[1], done.friction);
            ledger.record_friction(work, done.friction_loss, work.abs() + done.friction_loss);
            let mut given = 0.0;
            for (index, mode) in self.system.modes.iter().enumerate() {
                let speeds = [&start, &middle, &end].map(|state| self.mode_state(index, state)[1]);
                given += mode.height * along(speeds, joint[0], done.normal)
                    + self.system.arm * mode.angle * along(speeds, joint[1], done.friction);
            }
            stator.record(0, 0.0, 0.0, given);
            self.record_modes(stator, &start, &end);
        }
        end[CLOSING] = done.velocity;
        end[SPEED] += done.friction;
        if done.capped {
            end[SPEED] = self.system.twist(&end)[1];
        }
        self.state = end;
        self.line = self.line_at(end[SPEED]);
        if self.with_energy {
            let after = self.stated(&end, Mode::Flight);
            let changed = [before.disk.axial_velocity, before.disk.axial_velocity + done.normal];
            ledger.record_axial_change(changed, [before.disk.height; 2]);
            ledger.record_rotary_change(before.disk.angular_speed, after.disk.angular_speed);
        }
        self.stage = Stage::Flight(Launch::Rebound);
        if rests {
            self.state[CLOSING] = 0.0;
            self.lie_down();
            return (Event::Attachment { impacts: 1, error_bound: lasts }, [done.normal, done.friction]);
        }
        let event = Event::Impact {
            axial_impact_velocity: velocity,
            tangential_impact_velocity: slip,
            capped: done.capped,
        };
        if done.velocity <= 0.0 {
            self.state[CLOSING] = 0.0;
            self.lie_down();
        }
        (event, [done.normal, done.friction])
    }

    /// A disk on a rigid stator without relative velocity: it stays, or flies at once where the stator falls away.
    fn lie_down(&mut self) {
        (self.state[GAP], self.state[CLOSING]) = (0.0, 0.0);
        self.settle_slip();
        let grip = self.onset(None);
        self.stage = Stage::Contact { grip, forever: false };
        if first_sign(&self.regime().flow, self.regime().force.now(), &self.state) == Some((0, false)) {
            self.stage = Stage::Flight(Launch::Rebound);
        }
    }

    /// A disk in flight that touches a rigid stator: with a relative velocity of no more than rounding it flies if the
    /// stator falls away.
    fn leave(&mut self) {
        let [_, tip] = self.system.tip(&self.state);
        if self.state[CLOSING].abs() > ROUNDING * tip.abs() {
            return;
        }
        self.state[CLOSING] = 0.0;
        let flow = &self.system.regimes[self.line][0].flow;
        match first_sign(flow, &flow.derivative(&closing()), &self.state) {
            Some((0, true)) => self.stage = Stage::Flight(Launch::Rebound),
            Some((1, true)) => {
                let third = dot(&flow.derivative(&flow.derivative(&closing())), &self.state);
                self.stage = Stage::Flight(Launch::Release(third));
            }
            _ => self.lie_down(),
        }
    }

    /// A disk in a soft contact, with whatever grip.
    fn press(&mut self) {
        self.settle_slip();
        let grip = self.onset(None);
        self.stage = Stage::Contact { grip, forever: false };
        if first_sign(&self.regime().flow, self.regime().force.now(), &self.state) == Some((0, false)) {
            self.stage = Stage::Flight(if self.state[GAP] < 0.0 { Launch::Below } else { Launch::Rebound });
        }
    }

    /// A slip of no more than rounding is none.
    fn settle_slip(&mut self) {
        let slip = self.system.regimes[self.line][0].slip.now();
        if dot(slip, &self.state).abs() <= 0.125 * ROUNDING * size(slip, &self.state) {
            self.state[SPEED] = self.system.twist(&self.state)[1];
        }
    }

    /// Whether friction holds, or in which direction the disk slides; `spent`: the slide that has just ended.
    fn onset(&self, spent: Option<Mode>) -> Grip {
        if self.system.base.friction() == 0.0 {
            // Nothing holds it.
            return Grip::Forward;
        }
        let slip = self.slip();
        if spent.is_none() {
            match SlipDirection::of(slip) {
                Some(SlipDirection::Forward) => return Grip::Forward,
                Some(SlipDirection::Backward) => return Grip::Backward,
                None => {}
            }
        }
        let stick = &self.system.regimes[self.line][1];
        let gives = |hold: &Functional<N>| {
            let (value, doubt) = (dot(hold.now(), &self.state), ROUNDING * size(hold.now(), &self.state));
            let first = stick.flow.derivative(hold.now());
            value < -doubt || value <= doubt && dot(&first, &self.state) < 0.0
        };
        {
            let before = spent.map(|mode| mode == Mode::Sliding(SlipDirection::Forward));
            if gives(&stick.hold[0]) && before != Some(false) {
                return Grip::Backward;
            }
            if gives(&stick.hold[1]) && before != Some(true) {
                return Grip::Forward;
            }
        }
        Grip::Stick
    }

    /// Coordinate and speed of a mode.
    pub(super) fn mode_state(&self, index: usize, state: &State) -> [f64; 2] {
        let [place, speed] = self.system.steady(index, (state[SIN], state[COS]));
        [place + state[DISPLACEMENTS[index]], speed + state[VELOCITIES[index]]]
    }
}

/// Which derivative of a functional is the first one beyond rounding, and whether it is positive; `None` if none is.
fn first_sign(flow: &LinearFlow<N>, functional: &State, state: &State) -> Option<(usize, bool)> {
    let mut of = *functional;
    for order in 0..6 {
        let value = dot(&of, state);
        if value.abs() > ROUNDING * size(&of, state) {
            return Some((order, value > 0.0));
        }
        of = flow.derivative(&of);
    }
    None
}

pub(super) fn size(functional: &Vector<N>, state: &State) -> f64 {
    functional.iter().zip(state).map(|(a, b)| (a * b).abs()).sum()
}

fn closing() -> State {
    let mut of = [0.0; N];
    of[CLOSING] = 1.0;
    of
}

const fn direction(slide: Grip) -> SlipDirection {
    match slide {
        Grip::Backward => SlipDirection::Backward,
        Grip::Forward | Grip::Stick => SlipDirection::Forward,
    }
}

/// Whether a contact is where it was a period before, but for the angle and the speed of the disk.
fn repeats(before: &State, after: &State) -> bool {
    let size = after[..ANGLE].iter().fold(1.0, |size: f64, value| size.max(value.abs()));
    (0..ANGLE).all(|index| (after[index] - before[index]).abs() <= SAME * size)
}

/// A free oscillation of unit mass with this stiffness and damping, so long after the start.
fn rung(stiffness: f64, damping: f64, [r, v]: [f64; 2], time: f64) -> [f64; 2] {
    if r == 0.0 && v == 0.0 {
        return [0.0; 2];
    }
    let decay = 0.5 * damping;
    let square = (stiffness - decay * decay).max(0.0);
    let frequency = square.sqrt();
    let (sin, cos) = sin_cos(frequency * time);
    // sin(w t)/w, which is t where the damping is critical.
    let share = if frequency * time < 1.0e-9 { time } else { sin / frequency };
    let e = exp(-decay * time);
    [e * (cos * r + share * (v + decay * r)), e * (cos * v - share * (stiffness * r + decay * v))]
}

/// The integral of exp(-rate s) from 0 to `time`, and the integral of that.
fn exponential_integrals(rate: f64, time: f64) -> (f64, f64) {
    let x = rate * time;
    if x == 0.0 {
        return (time, 0.5 * time * time);
    }
    if x.abs() < 0.5 {
        let series = |first: f64| {
            // 1/first! - x/(first + 1)! + ...
            (1..=14).rev().fold(1.0, |sum, k| 1.0 - x / (first + f64::from(k)) * sum)
        };
        return (time * series(1.0), 0.5 * time * time * series(2.0));
    }
    let once = -exp_m1(-x) / rate;
    (once, (time - once) / rate)
}

impl MotionRecord for StatorRecord {
    fn time(&self) -> PhaseTime {
        self.time
    }

    fn event(&self) -> Event {
        self.event
    }

    fn energies(&self) -> Energies {
        Energies { disk: self.ledger, stator: self.stator }
    }
}

impl Motion for StatorEngine {
    type Record = StatorRecord;

    fn time(&self) -> PhaseTime {
        self.now
    }

    fn disk(&self) -> DiskState {
        self.state().disk
    }

    fn advance(&mut self) -> Result<Option<StatorRecord>, Error> {
        self.advance()
    }

    fn lies_for_ever(&self) -> bool {
        self.lies_for_ever()
    }
}

impl SteeredMotion for StatorEngine {
    fn advance_within(&mut self, limit: f64) -> Result<Option<StatorRecord>, Error> {
        self.advance_within(limit)
    }

    fn disk_after(&self, span: f64) -> DiskState {
        self.state_after(span).1.disk
    }

    fn energies_after(&self, span: f64) -> Energies {
        let (disk, stator) = self.ledgers_after(span);
        Energies { disk, stator }
    }

    fn spring_energy(&self, span: f64, _: &DiskState) -> f64 {
        self.spring_energy(span)
    }

    fn launches(&self) -> bool {
        self.launches()
    }

    fn perturb_launch(&mut self, speed: f64) {
        self.perturb_launch(speed);
    }

    fn pause_contact(&mut self, span: f64) -> Option<Energies> {
        (!self.launches()).then(|| self.pause(span).energies())
    }

    fn amplitude_after(&self, span: f64) -> Option<f64> {
        self.amplitude_after(span)
    }

    fn skip_energies(&mut self) {
        self.with_energy = false;
    }
}

impl Iterator for StatorEngine {
    type Item = Result<StatorRecord, Error>;

    fn next(&mut self) -> Option<Self::Item> {
        self.advance().transpose()
    }
}
