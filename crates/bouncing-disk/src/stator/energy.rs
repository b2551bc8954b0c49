//! The energy balances of a motion between two events.

use super::LoadLine;
use super::record::StatorEngine;
use super::regime::{ANGLE, COS, ContactStiffness, DISPLACEMENTS, GAP, Regime, SIN, State, VELOCITIES};
use crate::motion::energy::EnergyLedger;
use crate::motion::engine::Stage;
use crate::motion::stator_ledger::StatorLedger;

impl StatorEngine {
    pub(super) fn record_modes(&self, stator: &mut StatorLedger, from: &State, to: &State) {
        for (index, mode) in self.system.modes.iter().enumerate().filter(|(_, mode)| mode.weight > 0.0) {
            let ([q0, v0], [q1, v1]) = (self.mode_state(index, from), self.mode_state(index, to));
            let f = mode.stiffness;
            stator.energy_change += 0.5 * mode.weight * ((v1 - v0) * (v1 + v0) + f * (q1 - q0) * (q1 + q0));
            stator.magnitude += 0.5 * mode.weight * (v0 * v0 + v1 * v1 + f * (q0 * q0 + q1 * q1));
        }
    }

    /// The energy balances from the last event to `state`, `span` later, without an event.
    pub(super) fn ledgers(&self, span: f64, state: &State) -> (EnergyLedger, StatorLedger) {
        let (mut ledger, mut stator) = (EnergyLedger::default(), StatorLedger::default());
        let mode = self.mode();
        let (start, end) = (self.stated(&self.state, mode).disk, self.stated(state, mode).disk);
        ledger.record_axial_change([start.axial_velocity, end.axial_velocity], [start.height, end.height]);
        ledger.record_rotary_change(start.angular_speed, end.angular_speed);
        ledger.record_rounding(self.bounds(&self.state).height + span, end.axial_velocity);
        let turned = end.angle - start.angle;
        let LoadLine { torque, slope, .. } = self.system.lines[self.line];
        stator.load_impulse = torque * span + slope * (state[ANGLE] - self.state[ANGLE]);
        if slope == 0.0 {
            let load = torque * (state[ANGLE] - self.state[ANGLE]);
            ledger.record_load(load, load.abs() + (torque * turned).abs());
        } else if matches!(self.stage, Stage::Flight(_)) {
            // No other force turns the disk.
            let [from, to] = [start.angular_speed, end.angular_speed];
            let load = 0.5 * (from - to) * (from + to);
            ledger.record_load(load, load.abs());
        }
        self.record_modes(&mut stator, &self.state, state);
        match self.stage {
            Stage::Lying(_) => self.record_contact(span, &mut ledger, &mut stator),
            // In a short flight the closed forms are differences of two works over almost a whole period.
            _ if span < self.regime().flow.step() => {
                let Regime { flow, works, .. } = self.regime();
                works.record_part(flow, &self.state, span, (&mut ledger, &mut stator));
            }
            _ => self.record_flight(span, state, &mut stator),
        }
        if let ContactStiffness::Soft { stiffness, .. } = self.system.contact {
            let energy = |gap: f64| 0.5 * stiffness * gap.min(0.0) * gap.min(0.0);
            let (from, to) = (energy(self.state[GAP]), energy(state[GAP]));
            ledger.record_spring([from, to]);
            if !matches!(self.stage, Stage::Lying(_)) {
                // Without a contact force the damper takes it.
                ledger.record_normal(0.0, from - to);
            }
        }
        (ledger, stator)
    }

    /// Work of the drive and loss in the modes during a flight, in closed form.
    fn record_flight(&self, span: f64, state: &State, stator: &mut StatorLedger) {
        for (index, mode) in self.system.modes.iter().enumerate().filter(|(_, mode)| mode.weight > 0.0) {
            let (f, d) = (mode.stiffness, mode.damping);
            let ringing = |state: &State| [state[DISPLACEMENTS[index]], state[VELOCITIES[index]]];
            let (from, to) = (ringing(&self.state), ringing(state));
            let energy = |[r, v]: [f64; 2]| 0.5 * (v * v + f * r * r);
            // In the steady motion (u, u'): integrals of u'^2, u' r' and u r'. The last two use (exp(i tau)
            // x)' = (B + i) exp(i tau) x for the ringing x' = B x.
            let [a, b] = mode.steady;
            let (s0, c0, s1, c1) = (self.state[SIN], self.state[COS], state[SIN], state[COS]);
            let wave = |s: f64, c: f64| a * b * (s * s - c * c) * -0.5 + (a * a - b * b) * 0.5 * s * c;
            let steady = 0.5 * (a * a + b * b) * span + (wave(s1, c1) - wave(s0, c0));
            let cross = |s: f64, c: f64, x: [f64; 2]| cross_integral(f, d, x, (c, s));
            let (late, early) = (cross(s1, c1, to), cross(s0, c0, from));
            // Integrals of cos(tau) r' and sin(tau) r'.
            let (with_cos, with_sin) = (late.0 - early.0, late.1 - early.1);
            let speed = a * with_cos - b * with_sin;
            let place = a * with_sin + b * with_cos;
            let loss = d * (steady + 2.0 * speed) + (energy(from) - energy(to));
            // The drive's force is the one that sustains the steady motion: (f - 1) u + d u'.
            let [u0, u1] = [[s0, c0], [s1, c1]].map(|[s, c]| a * s + b * c);
            let drive = (f - 1.0) * (0.5 * (u1 - u0) * (u1 + u0) + place) + d * (steady + speed);
            stator.record(index, mode.weight * drive, mode.weight * loss, 0.0);
            stator.magnitude += mode.weight * (energy(from) + energy(to));
        }
    }

    /// Works and losses during a contact.
    fn record_contact(&self, span: f64, ledger: &mut EnergyLedger, stator: &mut StatorLedger) {
        let Regime { flow, works, .. } = self.regime();
        let (mut state, mut passed) = (self.state, 0.0);
        while span - passed >= flow.step() {
            state = works.record_step(flow, &state, (&mut *ledger, &mut *stator));
            passed += flow.step();
            (state[SIN], state[COS]) = self.phase_after(passed);
        }
        works.record_part(flow, &state, span - passed, (ledger, stator));
    }
}

/// The integrals of cos(tau) r' and sin(tau) r' of a ringing x = (r, r'), up to a constant: the second
/// component of (B + i)^-1 x exp(i tau).
fn cross_integral(stiffness: f64, damping: f64, [r, v]: [f64; 2], (cos, sin): (f64, f64)) -> (f64, f64) {
    // B + i = [[i, 1], [-f, i - d]]; its inverse has the second row [f, i]/(f - 1 - i d).
    let (re, im) = (stiffness * r, v);
    let (p, q) = (stiffness - 1.0, -damping);
    let size = p * p + q * q;
    let (x, y) = ((re * p + im * q) / size, (im * p - re * q) / size);
    (x * cos - y * sin, x * sin + y * cos)
}
