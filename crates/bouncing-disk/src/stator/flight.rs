//! A flight over a compliant stator, in closed form, and its end.
//!
//! Let u be the steady motion of the tip and R = (r^2 + r'^2/f^2)^(1/2) the amplitude of each ringing mode,
//! which never grows. No search is needed while the parabola of the disk is above |u| + sum of R, the highest
//! the tip can rise. Nor is a search needed until the gap g, g' = w, closes with the acceleration b = 1 + a,
//! where a = |u| + sum of R (f^2 + d f): a time of (w + (w^2 + 2 b g)^(1/2))/b. After that time both bounds are
//! computed again from the remaining ringing, until they skip less than a step, whose polynomial is then
//! searched.
//!
//! On a stator slowed down by the disk, steady motion and ringing nearly cancel. Tapes of operating points
//! therefore also use the sum C = S + sum of h R of the complex amplitudes S of the tip, u = Re S e^(i tau),
//! and R of the modes, r = Re R e^(z tau), z = -d/2 + i (f^2 - d^2/4)^(1/2). Relative to e^(i tau), R changes
//! over a time t by at most |R| |z - i| t. So the tip stays below |C| + t sum of |h R (z - i)| for a time t,
//! here the time of a fall to the mean height. The acceleration is bounded likewise, with -S and z^2 R instead
//! of S and R.

use bouncing_disk_core::flight::MAX_FLIGHT_DURATION;
use bouncing_disk_core::numerics::elementary::{exp, exp_m1, hypot, ln_1p, sin_cos};

use super::LoadLine;
use super::record::{Crossing, Launch, Next, ROUNDING, StatorEngine};
use super::regime::{
    ANGLE, CLOSING, COS, ContactStiffness, DISPLACEMENTS, GAP, SIN, SPEED, State, VELOCITIES,
};
use crate::error::Error;
use crate::motion::engine::Stage;

/// Bounds on the stator's height and on its acceleration.
pub(super) struct Bounds {
    pub(super) height: f64,
    acceleration: f64,
}

impl StatorEngine {
    /// The first impact of a flight, or the return of a compliant contact's force, given that there is none
    /// in the part already `searched`.
    pub(super) fn flight_end(&self, launch: Launch, limit: f64, searched: &mut f64) -> Result<Next, Error> {
        let regime = self.regime();
        let step = regime.flow.step();
        let soft = self.system.contact != ContactStiffness::Rigid;
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
        // A compliant contact ends before its spring is free: below the stator the force may return.
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
            // The rounding of the parabola is proportional to its terms.
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
                    // Continue from the root of the gap.
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

    /// Bounds on the stator's motion after a given state, while its modes ring down.
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

    /// The bounds for a limited time (rad), with steady motion and ringing taken together. On a stator that a
    /// disk has slowed down, the two nearly cancel as long as their relative phases hardly change.
    fn bounds_within(&self, state: &State, time: f64) -> Bounds {
        let always = self.bounds(state);
        if !self.bounds_closely {
            return always;
        }
        // Both as real parts of complex numbers that rotate with the drive.
        let [a, b] = self.system.height;
        let (sin, cos) = (state[SIN], state[COS]);
        let steady = [a * sin + b * cos, b * sin - a * cos];
        let (mut place, mut pull) = (steady, steady.map(|part| -part));
        let (mut moved, mut pulled) = (0.0, 0.0);
        for (index, mode) in self.system.modes.iter().enumerate().filter(|(_, mode)| mode.height != 0.0) {
            let decay = 0.5 * mode.damping;
            let frequency = (mode.stiffness - decay * decay).max(0.0).sqrt();
            if frequency < decay {
                return always;
            }
            let (r, speed) = (state[DISPLACEMENTS[index]], state[VELOCITIES[index]]);
            let [re, im] = [mode.height * r, -mode.height * ((speed + decay * r) / frequency)];
            let [square, turn] = [decay * decay - frequency * frequency, -2.0 * decay * frequency];
            place = [place[0] + re, place[1] + im];
            pull = [pull[0] + (square * re - turn * im), pull[1] + (square * im + turn * re)];
            // |exp(z t) - 1| is at most |z| t where exp(z t) decays.
            let leaves = hypot(decay, frequency - 1.0) * time * hypot(re, im);
            moved += leaves;
            pulled += mode.stiffness * leaves;
        }
        Bounds {
            height: always.height.min(hypot(place[0], place[1]) + moved),
            acceleration: always.acceleration.min(hypot(pull[0], pull[1]) + pulled),
        }
    }

    /// The earliest time at which a disk that has flown for `passed` since the last event may touch the stator
    /// again, and the state at that time. Until then, the disk is higher than the stator's maximum, or even the
    /// largest acceleration cannot close the gap.
    fn cleared(&self, mut passed: f64, mut state: State) -> (f64, State) {
        let step = self.regime().flow.step();
        loop {
            let [height, velocity] = self.system.tip(&state);
            // The end of a fall from this height with this velocity.
            let lands = |above: f64, velocity: f64, pull: f64| {
                (velocity + (velocity * velocity + 2.0 * pull * above.max(0.0)).sqrt()) / pull
            };
            let v = state[CLOSING] + velocity;
            // Until the disk falls to the mean height of the stator, whose highest position is no lower.
            let within = lands(state[GAP] + height, v, 1.0);
            let Bounds { height: highest, acceleration } = self.bounds_within(&state, within);
            let above = state[GAP] + height - highest;
            let free = if above > 0.0 { lands(above, v, 1.0) } else { 0.0 };
            let closes = lands(state[GAP], state[CLOSING], 1.0 + acceleration);
            let closes = if self.bounds_closely { closes.min(within) } else { closes };
            let clear = free.max(closes) - 0.25 * step;
            if clear < step {
                return (passed, state);
            }
            passed += clear;
            state = self.flown(passed);
        }
    }

    /// Disk and modes at this time after the last event, if no event comes before.
    pub(super) fn carried(&self, time: f64) -> State {
        let flow = &self.regime().flow;
        // In a shorter flight a low gap would be a difference of two heights.
        if !matches!(self.stage, Stage::Lying(_)) && time > flow.step() {
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

    /// Disk and modes in flight at this time after the last event, in closed form.
    pub(super) fn flown(&self, time: f64) -> State {
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

    /// Sine and cosine of the phase at this time after the last event. Adding a short time to the phase would
    /// cause more rounding than an energy ledger allows at a mode's turning point, so the pair is rotated
    /// instead.
    pub(super) fn phase_after(&self, time: f64) -> (f64, f64) {
        if time > 1.0 {
            return sin_cos(self.now.phase.angle() + time);
        }
        let ([from_sin, from_cos], (sin, cos)) = ([self.state[SIN], self.state[COS]], sin_cos(time));
        (from_sin * cos + from_cos * sin, from_cos * cos - from_sin * sin)
    }

    /// The time at which a disk in flight reaches another piece of the load.
    pub(super) fn next_line(&self) -> Option<(f64, usize)> {
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

    /// The piece of the load at a speed; at a node, the one towards which the load drives the disk.
    pub(super) fn line_at(&self, speed: f64) -> usize {
        let lines = &self.system.lines;
        let index = lines.iter().rposition(|line| speed >= line.from).unwrap_or(0);
        let line = &lines[index];
        let falls = line.torque + line.slope * speed > 0.0;
        if speed <= line.from && falls { index.saturating_sub(1) } else { index }
    }
}

/// A free oscillation of unit mass with this stiffness and damping, at this time after the start.
fn rung(stiffness: f64, damping: f64, [r, v]: [f64; 2], time: f64) -> [f64; 2] {
    if r == 0.0 && v == 0.0 {
        return [0.0; 2];
    }
    let decay = 0.5 * damping;
    let square = (stiffness - decay * decay).max(0.0);
    let frequency = square.sqrt();
    let (sin, cos) = sin_cos(frequency * time);
    // sin(w t)/w, which tends to t at critical damping.
    let share = if frequency * time < 1.0e-9 { time } else { sin / frequency };
    let e = exp(-decay * time);
    [e * (cos * r + share * (v + decay * r)), e * (cos * v - share * (stiffness * r + decay * v))]
}

/// The integral of exp(-rate s) from 0 to `time`, and the integral of that integral.
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
