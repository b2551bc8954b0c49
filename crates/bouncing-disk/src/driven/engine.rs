//! Engines on a driven platform: their start, their continuation from a state, and the motion between two
//! events.

use std::f64::consts::TAU;

use bouncing_disk_core::ChatterPolicy;
use bouncing_disk_core::numerics::elementary::wrapped_angle;
use bouncing_disk_drives::Drive;
use bouncing_disk_drives::compliance::{Pressed, RelativeState};
use bouncing_disk_drives::drive::TimeAhead;

use super::contact::{Ride, Touching};
use super::ground::{DrivenEnd, DrivenEngine, DrivenFlight, DrivenGround, JOINT, Then, lying_pressed};
use super::{DrivenStart, DrivenSystem};
use crate::error::{Error, check, moderate};
use crate::motion::contact_motion::{Lying, SAME_SPEED};
use crate::motion::energy::EnergyLedger;
use crate::motion::engine::{OnGround, Passed, Stage, Step};
use crate::motion::event::{Energies, EventRecord, SteeredMotion};
use crate::motion::phase_time::{PhaseSpan, PhaseTime, legal_span, phase_at};
use crate::motion::rotary_change::RotaryChange;
use crate::motion::state::{DiskState, LongSum, Mode, SlipDirection};
use crate::motion::stator_ledger::StatorLedger;

/// A resumed disk whose height or velocity agrees with the platform's within this share is given the platform's
/// value: the change of units and the evaluation of the drive each cause a few rounding errors.
const SAME_PLACE: f64 = 1.0e-12;

impl OnGround for DrivenSystem {
    type Ground = DrivenGround;

    fn start(self, start: DrivenStart, policy: ChatterPolicy) -> Result<DrivenEngine, Error> {
        let (phase, speed, parted) = start.parts();
        // A phase carried through an orbit may have its own stored sine.
        let phase = phase_at(phase.angle());
        let mut engine = DrivenEngine::begin_at(self, DrivenGround::new(policy), phase, speed)?;
        match parted {
            None => engine.put_down(None)?,
            Some([gap, velocity]) => {
                // The core checks the numbers of its flights.
                engine.system.height().first_impact_within(phase.angle(), gap, velocity, 0.0)?;
                engine.take_off(gap, velocity);
            }
        }
        Ok(engine)
    }
}

impl DrivenEngine {
    /// An engine that continues a motion with the disk in `state`, as returned by [`Self::state_after`]. In
    /// contact, the disk's height and axial velocity are set to the platform's, whatever `state` contains. A
    /// state includes neither the number of short flights that a cut has counted nor a chatter that is being
    /// summed.
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
        let time = PhaseTime { phase: phase_at(time.phase.angle()), ..time };
        let mut engine = Self::begin(system, DrivenGround::new(policy), time);
        engine.resume(state)?;
        Ok(engine)
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
            let relative = RelativeState { time: self.at(), gap, velocity };
            self.state = state;
            if gap > 0.0 || state.mode == Mode::Flight && compliant.force(relative) <= 0.0 {
                self.stage = Stage::Flight(DrivenFlight::Free { gap, velocity });
                self.state.mode = Mode::Flight;
                return Ok(());
            }
            return self.press(relative);
        }
        if state.mode == Mode::Flight {
            let gap = state.height - platform.height;
            let rounding = SAME_PLACE * (state.height.abs() + platform.height.abs());
            check(gap >= -rounding, "height above the platform", gap, "[0, inf) (g/omega^2)")?;
            let velocity = state.axial_velocity - platform.axial_velocity;
            let parted = gap > rounding
                || velocity.abs()
                    > 4.0 * f64::EPSILON * (state.axial_velocity.abs() + platform.axial_velocity.abs());
            let end = self.system.height.contact_end(self.at(), f64::INFINITY)?;
            let separates =
                |end: TimeAhead| end.after <= JOINT * (1.0 + end.time) && end.velocity_jump == 0.0;
            if parted {
                self.take_off(gap.max(0.0), velocity);
            } else if end.is_some_and(separates) {
                self.stage = Stage::Flight(DrivenFlight::Separated);
            } else {
                self.put_down(None)?;
            }
        } else {
            self.put_down(Some(state.mode))?;
        }
        Ok(())
    }

    /// A disk placed on the platform; if it moves with the platform within rounding, it keeps its previous
    /// `mode`.
    pub(super) fn put_down(&mut self, mode: Option<Mode>) -> Result<(), Error> {
        let at = self.at();
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
        let mut lying = self.landed(at, self.state.angular_speed)?;
        if let (true, Some(Mode::Sliding(direction))) = (moves_along, mode) {
            lying.slip = Some(direction);
        }
        self.lie(lying);
        Ok(())
    }

    fn take_off(&mut self, gap: f64, velocity: f64) {
        self.state.mode = Mode::Flight;
        self.state.height += gap;
        self.state.axial_velocity += velocity;
        self.stage = Stage::Flight(DrivenFlight::Free { gap, velocity });
    }

    fn lie(&mut self, lying: Lying<DrivenEnd>) {
        self.state.mode = lying.mode();
        self.stage = Stage::Lying(lying);
    }

    /// A disk that presses on a compliant contact.
    fn press(&mut self, from: RelativeState) -> Result<(), Error> {
        if let Some((pressed, lying)) = self.pressed_from(from, self.state.angular_speed)? {
            self.lie(lying);
            self.ground.pressed = Some(pressed);
        }
        Ok(())
    }

    /// A compliant contact from this state on, for a disk with this angular speed.
    pub(super) fn pressed_from(
        &self,
        from: RelativeState,
        angular_speed: f64,
    ) -> Result<Option<(Pressed, Lying<DrivenEnd>)>, Error> {
        let Some(compliant) = &self.system.compliance else { return Ok(None) };
        let pressed = compliant.press(from);
        let touching = Touching { system: &self.system, ride: Ride::Pressed(&pressed, 0.0) };
        let slip = SlipDirection::of(angular_speed - self.system.angle.at(from.time).velocity)
            .or_else(|| touching.onset(from.time, None));
        let lying = lying_pressed(&pressed, slip)?;
        Ok(Some((pressed, lying)))
    }

    /// A disk that has come to rest on the platform at `at`, with this angular speed.
    pub(super) fn landed(&self, at: f64, angular_speed: f64) -> Result<Lying<DrivenEnd>, Error> {
        let slip = SlipDirection::of(angular_speed - self.system.angle.at(at).velocity)
            .or_else(|| self.touching(0.0).onset(at, None));
        let end = self.ridden().contact_end(at, f64::INFINITY)?;
        Ok(Lying { slip, end: end.map(|ahead| DrivenEnd { ahead, then: Then::Leaves }) })
    }

    /// The support of the disk, `after` the last event.
    pub(super) fn touching(&self, after: f64) -> Touching<'_> {
        let ride = match &self.ground.pressed {
            Some(pressed) => Ride::Pressed(pressed, after),
            None => Ride::Platform(self.ridden()),
        };
        Touching { system: &self.system, ride }
    }

    /// The drive of the platform on which the disk lies.
    fn ridden(&self) -> &Drive {
        self.ground.settled.as_ref().unwrap_or(&self.system.height)
    }

    /// The time and the disk `span` radians after the last event, if no event comes before. A chatter that is
    /// being summed counts as rest. A negative span and NaN count as zero, and a span above
    /// [`MAX_FLIGHT_DURATION`](bouncing_disk_core::flight::MAX_FLIGHT_DURATION) is reduced to it.
    #[must_use]
    pub fn state_after(&self, span: f64) -> (PhaseTime, DiskState) {
        let span = legal_span(span);
        let time = self.later(span).time;
        let change = self.change(span, time.phase.angle());
        let mut state = self.drifted(span, time.phase.angle(), change);
        state.angle = self.state.angle + change.angle;
        (time, state)
    }

    /// The energy balance from the last event to `span` radians later, as for [`Self::state_after`].
    #[must_use]
    pub fn ledger_after(&self, span: f64) -> EnergyLedger {
        let span = legal_span(span);
        self.passed(span, wrapped_angle(self.at() + span)).ledger
    }

    /// The gap and the relative velocity at the start of a flight, if one begins now.
    pub(crate) const fn flight(&self) -> Option<[f64; 2]> {
        match self.stage {
            Stage::Flight(DrivenFlight::Free { gap, velocity }) => Some([gap, velocity]),
            _ => None,
        }
    }

    /// Continues from the release of a compliant contact, or from any other flight, with the angle reset to
    /// zero.
    pub(crate) fn fly_from(&mut self, time: PhaseTime, [gap, velocity]: [f64; 2], angular_speed: f64) {
        self.now = PhaseTime { phase: phase_at(time.phase.angle()), ..time };
        let platform = self.system.height.at(self.at());
        self.angle = LongSum::new(0.0);
        self.state = DiskState::flying(platform.height + gap, platform.velocity + velocity, angular_speed);
        (self.ground.pressed, self.ground.settled) = (None, None);
        self.stage = Stage::Flight(DrivenFlight::Free { gap, velocity });
    }

    /// The time of the drive at the last event, in [0, 2 pi).
    pub(super) const fn at(&self) -> f64 {
        self.now.phase.angle()
    }

    /// The step to an event `duration` later, at the time `at` of the drive; the number of periods passed
    /// follows from both.
    pub(super) fn step(&self, duration: f64, at: f64) -> Step {
        self.step_over(duration, at, ((self.at() + duration - at) / TAU + 0.5) as u64)
    }

    /// The step to an event `duration` later, at the time `at` of the drive, which has passed zero `turns`
    /// times by then.
    pub(super) fn step_over(&self, duration: f64, at: f64, turns: u64) -> Step {
        let time = PhaseTime { periods: self.now.periods.saturating_add(turns), phase: phase_at(at) };
        Step { time, span: PhaseSpan::from_radians(duration), duration }
    }

    pub(super) fn later(&self, duration: f64) -> Step {
        self.step(duration, wrapped_angle(self.at() + duration))
    }

    /// The rotary motion over the next `span`, to the time `at` of the drive.
    pub(super) fn change(&self, span: f64, at: f64) -> RotaryChange {
        match self.state.mode {
            Mode::Flight => self.flown(span),
            Mode::Sticking => RotaryChange {
                speed: self.system.angle.velocity_before(at),
                angle: self.system.angle.at(at).height - self.system.angle.at(self.at()).height,
            },
            Mode::Sliding(direction) => {
                self.touching(0.0).slide(direction, self.state.angular_speed, self.at(), span)
            }
        }
    }

    /// The motion over the next `span` without an event, to the time `at` of the drive.
    pub(super) fn passed(&self, span: f64, at: f64) -> Passed {
        let change = self.change(span, at);
        let before = self.drifted(span, at, change);
        Passed { change, ledger: self.ledger_of(span, at, &before, change), before }
    }

    /// The disk at the end of the `span`, without its angle.
    fn drifted(&self, span: f64, at: f64, change: RotaryChange) -> DiskState {
        let (state, height) = (&self.state, &self.system.height);
        let (height, axial_velocity) = match (state.mode, self.stage) {
            (Mode::Flight, Stage::Flight(DrivenFlight::Chatter { chatter, .. }))
                if span >= chatter.duration =>
            {
                (height.at(at).height, height.at(at).velocity)
            }
            (Mode::Flight, _) => {
                (state.height + span * (state.axial_velocity - 0.5 * span), state.axial_velocity - span)
            }
            _ if self.ground.pressed.is_some() => {
                let (gained, lifted) = self.touching(0.0).ride.change(self.at(), span);
                (state.height + (span * state.axial_velocity + lifted), state.axial_velocity + gained)
            }
            _ if self.ground.settled.is_some() => {
                let (from, to) = (self.ridden().at(self.at()), self.ridden().at(at));
                (
                    state.height + (to.height - from.height),
                    state.axial_velocity + (to.velocity - from.velocity),
                )
            }
            _ if span > 0.0 => (height.at(at).height, height.velocity_before(at)),
            _ => (state.height, state.axial_velocity),
        };
        DiskState { mode: state.mode, height, axial_velocity, angle: 0.0, angular_speed: change.speed }
    }

    /// The energy balance of the next `span` without an event, up to the state `end`.
    fn ledger_of(&self, span: f64, at: f64, end: &DiskState, change: RotaryChange) -> EnergyLedger {
        let mut ledger = EnergyLedger::default();
        let start = self.state;
        self.record_flight(&mut ledger, end, &change);
        if start.mode == Mode::Flight {
            let gap = |state: &DiskState, at| state.height - self.system.height.at(at).height;
            self.record_spring(&mut ledger, gap(&start, self.at()), gap(end, at), true);
            return ledger;
        }
        if self.system.compliance.is_some() {
            let (work, loss, gap) = self.touching(0.0).normal_work(&start, self.at(), span);
            ledger.record_normal(work, loss);
            self.record_spring(&mut ledger, gap[0], gap[1], false);
        } else {
            // The integral of (1 + s'') s'.
            let (from, to) = (start.axial_velocity, end.axial_velocity);
            ledger.record_normal((end.height - start.height) + 0.5 * (to - from) * (to + from), 0.0);
        }
        if let Mode::Sliding(direction) = start.mode {
            if self.with_energy {
                let slip = start.angular_speed - self.system.angle.at(self.at()).velocity;
                let speed = (direction.sign() * slip).max(0.0);
                let work = self.touching(0.0).slide_work(direction, self.at(), speed, span);
                let mu = self.system.friction;
                ledger.record_friction(
                    -direction.sign() * mu * work.carried,
                    mu * work.slipped,
                    mu * work.size,
                );
                // The angle is a small difference of the angles that friction and load would cause alone.
                let size = span * (start.angular_speed.abs() + (self.system.load.abs() + mu) * span);
                ledger.record_load(0.0, self.system.load.abs() * size);
            }
        } else {
            // The friction torque is l + beta''; its product with beta' is integrated.
            let (from, to) = (start.angular_speed, change.speed);
            let work = self.system.load * change.angle + 0.5 * (to - from) * (to + from);
            ledger.record_friction(work, 0.0, 0.5 * (to * to + from * from));
        }
        ledger
    }

    /// Records the change of the spring's energy between two gaps; if `lost`, no force acts and the damper
    /// absorbs it.
    pub(super) fn record_spring(&self, ledger: &mut EnergyLedger, from: f64, to: f64, lost: bool) {
        let Some(compliant) = &self.system.compliance else { return };
        let energy = |gap| compliant.spring_energy(gap);
        ledger.record_spring([energy(from), energy(to)]);
        if lost {
            ledger.record_normal(0.0, energy(from) - energy(to));
        }
    }
}

impl SteeredMotion for DrivenEngine {
    fn advance_within(&mut self, limit: f64) -> Result<Option<EventRecord>, Error> {
        self.next_within(limit)
    }

    fn disk_after(&self, span: f64) -> DiskState {
        self.state_after(span).1
    }

    fn energies_after(&self, span: f64) -> Energies {
        Energies { disk: self.ledger_after(span), stator: StatorLedger::default() }
    }

    fn spring_energy(&self, span: f64, state: &DiskState) -> f64 {
        let Some(compliant) = &self.system.compliance else { return 0.0 };
        let at = wrapped_angle(self.at() + span);
        compliant.spring_energy(state.height - self.system.height.at(at).height)
    }

    fn launches(&self) -> bool {
        matches!(self.stage, Stage::Flight(DrivenFlight::Free { .. } | DrivenFlight::Separated))
    }

    fn perturb_launch(&mut self, speed: f64) {
        if speed <= 0.0 {
            return;
        }
        let (gap, velocity) = match self.stage {
            Stage::Flight(DrivenFlight::Separated) => (0.0, speed),
            // A compliant contact ends before its spring is free.
            Stage::Flight(DrivenFlight::Free { gap, velocity }) if gap <= 0.0 && velocity >= 0.0 => {
                (gap, velocity + speed)
            }
            _ => return,
        };
        self.state.axial_velocity += speed;
        self.stage = Stage::Flight(DrivenFlight::Free { gap, velocity });
    }

    fn skip_energies(&mut self) {
        self.with_energy = false;
    }
}

#[cfg(test)]
mod tests;
