//! The events of a disk on a compliant stator, and the rigid impact.

use super::impact::impact;
use super::linear_flow::dot;
use super::record::{CHATTER, Crossing, Launch, StatorEngine, StatorRecord, closing, first_sign, lying};
use super::regime::{ANGLE, CLOSING, COS, ContactStiffness, GAP, SIN, SPEED, VELOCITIES};
use crate::motion::energy::EnergyLedger;
use crate::motion::engine::Stage;
use crate::motion::event::{Event, SteeredMotion};
use crate::motion::impact_energy::record_slip_end;
use crate::motion::phase_time::PhaseSpan;
use crate::motion::state::Mode;
use crate::motion::stator_ledger::StatorLedger;

impl StatorEngine {
    /// Moves the engine to an event.
    pub(super) fn cross(&mut self, span: f64, crossing: Crossing) -> StatorRecord {
        let mut state = self.carried(span);
        let rigid = self.system.contact == ContactStiffness::Rigid;
        if let Crossing::Touch(velocity) = crossing {
            (state[GAP], state[CLOSING]) = (0.0, velocity);
        }
        let (mut ledger, mut stator) =
            if self.with_energy { self.ledgers(span, &state) } else { Default::default() };
        let before = self.stated(&state, self.mode());
        self.ties = if span == 0.0 && crossing.is_of_friction() { self.ties + 1 } else { 0 };
        let flies_on = self.launches() && matches!(crossing, Crossing::LoadNode(_));
        self.aloft = if flies_on { self.aloft + span } else { 0.0 };
        self.now = self.now.after(PhaseSpan::from_radians(span));
        // The phase of the clock takes precedence.
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
                // The force falls through zero, so the gap opens, however its derivatives are rounded.
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
                let spent = if let Stage::Lying(lying) = self.stage { lying.slip } else { None };
                let slid = self.state[SPEED];
                self.state[SPEED] -= slip;
                record_slip_end(&mut ledger, slid, slip, self.state[SPEED]);
                let next = self.onset(spent);
                self.stage = lying(next);
                next.map_or(Event::SlipToStick, Event::SlipReversal)
            }
            Crossing::LoadNode(line) => {
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
            Crossing::Slips(direction) => {
                self.stage = lying(Some(direction));
                Event::StickToSlip(direction)
            }
        };
        self.angle.add(self.state[ANGLE]);
        self.state[ANGLE] = 0.0;
        let record = self.record(event, before, (ledger, stator), span);
        StatorRecord { axial_impulse: axial, angular_impulse: angular, ..record }
    }

    /// A rigid impact; returns the event and its impulses.
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
        // While separate, disk and stator approach with this acceleration.
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
}
