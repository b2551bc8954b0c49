//! The event engine of a disk on a compliant stator.

use std::f64::consts::TAU;

use super::contact::repeats;
use super::record::{Crossing, Launch, SAME, StatorEngine, StatorRecord, StatorState, closing, first_sign};
use super::regime::{
    ANGLE, CLOSING, COS, ContactStiffness, DISPLACEMENTS, GAP, N, ONE, Regime, SIN, SPEED, State, VELOCITIES,
};
use super::{MODES, StatorSystem};
use crate::driven::DrivenStart;
use crate::error::{Error, check, moderate};
use crate::motion::contact_motion::Lying;
use crate::motion::energy::EnergyLedger;
use crate::motion::engine::Stage;
use crate::motion::event::{Energies, Event, Motion, MotionRecord, SteeredMotion};
use crate::motion::phase_time::{PhaseSpan, PhaseTime, legal_span};
use crate::motion::state::{DiskState, LongSum, Mode, SlipDirection};
use crate::motion::stator_ledger::StatorLedger;

impl StatorEngine {
    /// An engine for a disk that starts in contact, with a launch or in the air, on a stator in its steady
    /// motion without a disk. If a disk in contact has the stator's angular speed within rounding, it sticks
    /// or begins to slide.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for an illegal start.
    pub fn new(system: StatorSystem, start: DrivenStart) -> Result<Self, Error> {
        let (phase, speed, parted) = start.parts();
        let [gap, velocity] = parted.unwrap_or_default();
        let mut state = [0.0; N];
        (state[GAP], state[CLOSING]) = (moderate("gap", gap)?, moderate("relative_velocity", velocity)?);
        state[SPEED] = moderate("angular_speed", speed)?;
        check(state[GAP] >= 0.0, "gap", state[GAP], "[0, 1e100]")?;
        Self::begin(system, PhaseTime::in_first_period(phase), state, parted.is_none())
    }

    /// An engine that continues a motion from [`Self::state_after`]. In contact on a rigid stator, the disk is
    /// given the stator's height and velocity.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for numbers that are not finite, and for a disk more than rounding below a rigid
    /// stator.
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
        if system.contact == ContactStiffness::Rigid {
            check(lies || state[GAP] >= -rounding, "gap", state[GAP], "[0, 1e100]")?;
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
            bounds_closely: false,
        };
        engine.line = engine.line_at(engine.state[SPEED]);
        match engine.system.contact {
            ContactStiffness::Rigid if lies => engine.lie_down(),
            ContactStiffness::Soft { stiffness, .. } if lies => {
                if engine.state[GAP] == 0.0 && engine.state[CLOSING] == 0.0 {
                    // The indentation that carries the disk on the stator in its motion without a disk.
                    let load = 1.0 - engine.system.height[0] * engine.state[SIN];
                    engine.state[GAP] = -load.max(0.0) / stiffness;
                }
                engine.press();
            }
            ContactStiffness::Soft { .. } if engine.state[GAP] < 0.0 => engine.press(),
            ContactStiffness::Soft { .. } if engine.state[GAP] == 0.0 && engine.state[CLOSING] == 0.0 => {
                let flow = &engine.system.regimes[engine.line][0].flow;
                if first_sign(flow, &flow.derivative(&closing()), &engine.state) != Some((0, true)) {
                    engine.press();
                }
            }
            ContactStiffness::Rigid if engine.state[GAP] == 0.0 => engine.leave(),
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

    /// Time, disk and modes `span` radians after the last event, if no event comes before. A negative span
    /// and NaN count as zero.
    #[must_use]
    pub fn state_after(&self, span: f64) -> (PhaseTime, StatorState) {
        let span = legal_span(span);
        let state = self.carried(span);
        (self.now.after(PhaseSpan::from_radians(span)), self.stated(&state, self.mode()))
    }

    /// The energy balances of disk and modes from the last event to `span` radians later.
    #[must_use]
    pub fn ledgers_after(&self, span: f64) -> (EnergyLedger, StatorLedger) {
        let span = legal_span(span);
        self.ledgers(span, &self.carried(span))
    }

    /// Whether the disk is known never to leave the stator again, or the motion has ended.
    #[must_use]
    pub const fn lies_for_ever(&self) -> bool {
        matches!(self.stage, Stage::Lying(Lying { end: None, .. }) | Stage::Ended)
    }

    /// Moves the origin of the present motion forward by `span`, during which no event may come.
    pub(crate) fn pause(&mut self, span: f64) -> StatorRecord {
        let span = legal_span(span);
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
        self.record(Event::Joint, self.state(), (ledger, stator), span)
    }

    /// The record of an event without impulses that leaves the disk in its current state.
    pub(super) fn record(
        &self,
        event: Event,
        before: StatorState,
        (ledger, stator): (EnergyLedger, StatorLedger),
        span: f64,
    ) -> StatorRecord {
        StatorRecord {
            time: self.now,
            event,
            before,
            after: self.state(),
            axial_impulse: 0.0,
            angular_impulse: 0.0,
            ledger,
            stator,
            span: PhaseSpan::from_radians(span),
        }
    }

    /// Advances a disk that lies for ever by whole periods, in which everything repeats except the angle and a
    /// drifting speed; returns the energies of one period. `None` if it does not lie for ever or has not
    /// settled yet, or if a load depends on a drifting speed.
    pub(crate) fn skip_periods(&mut self, periods: u64) -> Option<StatorRecord> {
        let Stage::Lying(Lying { end: None, .. }) = self.stage else { return None };
        let mut after = self.clone();
        let record = after.pause(TAU);
        if !repeats(&self.state, &after.state) {
            return None;
        }
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

    /// Ends the present motion `span` radians after the last event, if no event comes before, and continues
    /// with another system in the same units, for example when the drive is switched or the load changes.
    /// Modes and disk are continuous; motions without a mode jump, and the disk keeps its distance.
    pub fn switch(&mut self, span: f64, to: StatorSystem) -> StatorRecord {
        self.switch_units(span, to, 1.0)
    }

    /// [`Self::switch`] to a system whose drive is `faster` times as fast; the record states the values after
    /// the switch in that system's units.
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

    /// Continues with another system or other modes.
    pub(super) fn go_on(&mut self) {
        self.line = self.line_at(self.state[SPEED]);
        match (self.stage, self.system.contact) {
            (Stage::Lying(_), ContactStiffness::Rigid) => self.lie_down(),
            (Stage::Lying(_), ContactStiffness::Soft { .. }) => self.press(),
            (Stage::Flight(Launch::Rebound | Launch::Release(_)), ContactStiffness::Rigid) => self.leave(),
            _ => {}
        }
    }

    /// The next event, or `None` after the last one.
    ///
    /// # Errors
    /// An error of the core if a root search does not converge. An error ends the motion.
    pub fn advance(&mut self) -> Result<Option<StatorRecord>, Error> {
        self.advance_within(f64::INFINITY)
    }

    pub(super) const fn mode(&self) -> Mode {
        self.stage.mode()
    }

    /// The index of the present flow among the regimes of a piece of the load.
    pub(super) const fn regime_index(&self) -> usize {
        match self.mode() {
            Mode::Flight => 0,
            Mode::Sticking => 1,
            Mode::Sliding(SlipDirection::Forward) => 2,
            Mode::Sliding(SlipDirection::Backward) => 3,
        }
    }

    pub(super) fn regime(&self) -> &Regime {
        &self.system.regimes[self.line][self.regime_index()]
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
        let next = match self.stage {
            Stage::Flight(launch) => {
                let line = self.next_line().filter(|(after, _)| *after < limit);
                let mut searched = self.searched;
                let next = self.flight_end(launch, line.map_or(limit, |(after, _)| after), &mut searched);
                self.searched = searched;
                next.map(|next| next.or_else(|| line.map(|(after, line)| (after, Crossing::LoadNode(line)))))
            }
            Stage::Lying(Lying { slip, .. }) => self.contact_end(slip, limit),
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

    fn disk_after(&self, span: f64) -> DiskState {
        self.state_after(span).1.disk
    }

    fn energies_after(&self, span: f64) -> Energies {
        let (disk, stator) = self.ledgers_after(span);
        Energies { disk, stator }
    }

    fn spring_energy(&self, span: f64, _: &DiskState) -> f64 {
        match self.system.contact {
            ContactStiffness::Soft { stiffness, .. } => {
                let gap = self.carried(span.max(0.0))[GAP].min(0.0);
                0.5 * stiffness * gap * gap
            }
            ContactStiffness::Rigid => 0.0,
        }
    }

    fn launches(&self) -> bool {
        matches!(self.stage, Stage::Flight(_))
    }

    fn perturb_launch(&mut self, speed: f64) {
        if let Stage::Flight(launch @ (Launch::Rebound | Launch::Release(_))) = &mut self.stage {
            self.state[CLOSING] += speed;
            self.searched = 0.0;
            if speed > 0.0 {
                *launch = if self.state[GAP] < 0.0 { Launch::Below } else { Launch::Rebound };
            }
        }
    }

    fn pause_contact(&mut self, span: f64) -> Option<Energies> {
        matches!(self.stage, Stage::Lying(_)).then(|| self.pause(span).energies())
    }

    fn modes(&self) -> [[f64; 2]; MODES] {
        self.state().modes
    }

    fn amplitude_after(&self, span: f64) -> Option<f64> {
        (self.system.modes[0].height != 0.0).then(|| self.vibration_after(span)[0].amplitude())
    }

    fn velocities(&self) -> Box<dyn FnMut(f64) -> f64 + '_> {
        if !matches!(self.stage, Stage::Lying(_)) {
            return Box::new(|span| self.disk_after(span).axial_velocity);
        }
        // One expansion serves all times within a step.
        let flow = &self.regime().flow;
        let (mut state, mut passed, mut expanded) = (self.state, 0, flow.expand(&self.state, flow.step()));
        Box::new(move |span| {
            let whole = (span / flow.step()) as u64;
            if passed < whole {
                (passed..whole).for_each(|_| state = flow.advance(&state));
                (passed, expanded) = (whole, flow.expand(&state, flow.step()));
            }
            let mut at = expanded.at(span - whole as f64 * flow.step());
            (at[SIN], at[COS]) = self.phase_after(span);
            self.system.tip(&at)[1] + at[CLOSING]
        })
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
