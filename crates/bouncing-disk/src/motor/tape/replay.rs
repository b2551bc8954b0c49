//! Rotors that are carried along a tape.
//!
//! In a contact step the force is constant and the stator's angular speed is linear in time. The slip is
//! therefore also linear and ends at most once, so speed, angle and energies follow exactly.

use std::ops::Range;

use bouncing_disk_core::numerics::elementary::{exp_m1, ln_1p};
use bouncing_disk_core::sweep::LaneLoop;

use super::window::{AxialWindow, RotorWindow, Speeds};
use super::{Knot, Tape};
use crate::motor::batch::rotor_rows::{RotorRows, Row, WIDTH};
use crate::stator::{LoadLine, StatorLedger};

/// The accumulated motion of rotors.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Done {
    /// Angle turned.
    pub(crate) angle: Row,
    /// Integral of the square of the speed.
    pub(crate) square: Row,
    /// Work of the stator by friction, and loss in friction.
    pub(crate) work: Row,
    pub(crate) loss: Row,
    /// Friction impulse on a rotor held at rest, divided by the coefficient of friction.
    pub(crate) held: Row,
    /// Impulse of the load's law, and work done against it.
    pub(crate) law_impulse: Row,
    pub(crate) law_work: Row,
}

impl Done {
    /// Adds the motion of a rotor in a contact step.
    #[inline(always)]
    fn add(&mut self, own: usize, slid: &Slid) {
        self.angle[own] += slid.angle;
        self.square[own] += slid.square;
        self.work[own] += slid.work;
        self.loss[own] += slid.loss;
    }
}

/// Up to eight rotors on one stator and under one law of the load.
#[derive(Debug, Clone)]
pub(crate) struct Rotors {
    pub(crate) rows: RotorRows<Done>,
    pub(crate) count: usize,
    /// Factor by which each rotor has less inertia than its motor's rotor.
    pub(crate) quicker: Row,
    /// The law, in addition to the constant loads of the rows.
    pub(crate) law: Vec<LoadLine>,
    /// The tape's column with the stator's speed; `None` for a sine.
    pub(crate) column: Option<usize>,
}

impl Rotors {
    /// The same rotors with the inertia of their motors.
    pub(crate) fn at_own_inertia(&self) -> Self {
        let mut rotors = Self { quicker: [1.0; WIDTH], ..self.clone() };
        for own in 0..WIDTH {
            rotors.rows.friction[own] /= self.quicker[own];
            rotors.rows.load[own] /= self.quicker[own];
        }
        // Rotors under one law have the same factor.
        for line in &mut rotors.law {
            (line.torque, line.slope) = (line.torque / self.quicker[0], line.slope / self.quicker[0]);
        }
        rotors
    }

    /// The motion of the rotor in this place over a time (rad), starting at this speed.
    pub(crate) fn done(
        &self,
        own: usize,
        before: f64,
        duration: f64,
        stator: Option<(StatorLedger, AxialWindow)>,
    ) -> RotorWindow {
        let (after, done, load) = (self.rows.speed[own], &self.rows.tally, self.rows.load[own]);
        // Impulses are in units of the inertia.
        let inertia = 1.0 / self.quicker[own];
        RotorWindow {
            angle: done.angle[own],
            square: done.square[own],
            held: done.held[own],
            friction_work: inertia * done.work[own],
            friction_loss: inertia * done.loss[own],
            load_work: inertia * (load * done.angle[own] + done.law_work[own]),
            load_impulse: inertia * (load * duration + done.law_impulse[own]),
            kinetic_change: inertia * (0.5 * (after - before) * (after + before)),
            speeds: Speeds::Unknown,
            stator: stator.map(Box::new),
        }
    }

    /// The speed of the rotor in this place at this share of a step that has just been replayed, given its
    /// speed at the start of the step.
    pub(crate) fn within(&self, own: usize, knot: &Knot, share: f64, before: f64) -> f64 {
        if knot.pressed > 0.0 {
            return before + share * (self.rows.speed[own] - before);
        }
        let law = if self.law.is_empty() { 0.0 } else { torque(&self.law, before) };
        before - share * knot.duration * (self.rows.load[own] + law)
    }
}

/// Carries all rotors along these steps of a tape; the first knot is the start.
pub(crate) struct Replay<'a> {
    pub(crate) tape: &'a Tape,
    pub(crate) steps: Range<usize>,
    pub(crate) rotors: &'a mut [Rotors],
}

impl LaneLoop for Replay<'_> {
    #[inline(always)]
    fn run(self) {
        let Range { start, end } = self.steps;
        let knots = &self.tape.knots[start - 1..end];
        for rotors in self.rotors {
            let Rotors { rows, law, column, count, .. } = rotors;
            let column = column.map(|column| &self.tape.speeds[column][start - 1..end]);
            for (index, pair) in knots.windows(2).enumerate() {
                let [before, knot] = [&pair[0], &pair[1]];
                let (from, to) = match column {
                    None if knot.pressed > 0.0 => {
                        // A chord of the sine is on average too low by this factor.
                        let square = knot.duration * knot.duration;
                        let chord = 1.0 + square * (1.0 / 12.0 + square * (1.0 / 120.0));
                        let [from, to] = [before, knot].map(|at| rows.twists(at.sin, at.cos));
                        (from.map(|speed| chord * speed), to.map(|speed| chord * speed))
                    }
                    None => ([0.0; WIDTH], [0.0; WIDTH]),
                    Some(speeds) => ([speeds[index]; WIDTH], [speeds[index + 1]; WIDTH]),
                };
                match (knot.pressed > 0.0, law.is_empty()) {
                    (true, true) => slide(rows, knot, from, to),
                    (true, false) => slide_under(rows, *count, knot, from, to, law),
                    (false, true) => fly(rows, knot.duration),
                    (false, false) => fly_under(rows, *count, knot.duration, law),
                }
                if knot.pressed > 0.0 {
                    hold(&mut rows.tally, knot.pressed, from, to);
                }
                if knot.hit > 0.0 {
                    hit(rows, knot.hit, column.map_or_else(|| rows.twists(knot.sin, knot.cos), |_| to));
                }
            }
        }
    }
}

/// A contact step for all rotors.
#[inline(always)]
fn slide(rows: &mut RotorRows<Done>, knot: &Knot, from: Row, to: Row) {
    for own in 0..WIDTH {
        let step = Step {
            span: knot.duration,
            from: from[own],
            to: to[own],
            friction: rows.friction[own] * knot.pressed,
            load: rows.load[own] * knot.duration,
        };
        let slid = step.slide(rows.speed[own]);
        rows.speed[own] = slid.speed;
        rows.tally.add(own, &slid);
    }
}

/// A contact step for a rotor that is held at rest.
#[inline(always)]
fn hold(done: &mut Done, impulse: f64, from: Row, to: Row) {
    for own in 0..WIDTH {
        let (from, to) = (from[own], to[own]);
        let (size, sum) = (from.abs() + to.abs(), from + to);
        // All of it if the sign is constant, otherwise the difference of the parts on both sides of the
        // reversal.
        let share = if from * to >= 0.0 { sum.signum() } else { sum / size };
        done.held[own] += if size > 0.0 { impulse * share } else { 0.0 };
    }
}

/// A flight of all rotors.
#[inline(always)]
fn fly(rows: &mut RotorRows<Done>, span: f64) {
    for own in 0..WIDTH {
        let (speed, lost) = (rows.speed[own], rows.load[own] * span);
        rows.speed[own] = speed - lost;
        let done = &mut rows.tally;
        done.angle[own] += span * (speed - 0.5 * lost);
        done.square[own] += span * (speed * (speed - lost) + lost * lost * (1.0 / 3.0));
    }
}

/// An impact of all rotors.
#[inline(always)]
fn hit(rows: &mut RotorRows<Done>, impulse: f64, stator: Row) {
    for (own, stator) in stator.into_iter().enumerate() {
        let (slip, most) = (rows.speed[own] - stator, rows.friction[own] * impulse);
        let change = (-slip).max(-most).min(most);
        // A slip that ends becomes exactly zero.
        rows.speed[own] = if slip.abs() <= most { stator } else { rows.speed[own] + change };
        let done = &mut rows.tally;
        done.held[own] += if stator > 0.0 {
            impulse
        } else if stator < 0.0 {
            -impulse
        } else {
            0.0
        };
        done.work[own] += change * stator;
        // The impulse acts at the mean of the slip speeds before and after.
        done.loss[own] -= change * (slip + 0.5 * change);
    }
}

/// A contact step under a law of the load, evaluated at the speed in the middle.
fn slide_under(rows: &mut RotorRows<Done>, count: usize, knot: &Knot, from: Row, to: Row, law: &[LoadLine]) {
    for own in 0..count {
        let speed = rows.speed[own];
        let under = |at: f64| {
            let added = torque(law, at) * knot.duration;
            let step = Step {
                span: knot.duration,
                from: from[own],
                to: to[own],
                friction: rows.friction[own] * knot.pressed,
                load: rows.load[own] * knot.duration + added,
            };
            (step.slide(speed), added)
        };
        let (near, _) = under(speed);
        let (slid, added) = under(0.5 * (speed + near.speed));
        rows.speed[own] = slid.speed;
        rows.tally.add(own, &slid);
        let done = &mut rows.tally;
        done.law_impulse[own] += added;
        done.law_work[own] += added * (slid.angle / knot.duration);
    }
}

/// A flight under a law of the load, exactly, piece by piece.
fn fly_under(rows: &mut RotorRows<Done>, count: usize, span: f64, law: &[LoadLine]) {
    for own in 0..count {
        let load = rows.load[own];
        let (mut left, mut speed) = (span, rows.speed[own]);
        let done = &mut rows.tally;
        while left > 0.0 {
            let braking = load + torque(law, speed);
            let line = line_of(law, speed, braking);
            let (slope, decay) = (line.slope, line.slope * left);
            // The time for which the speed stays on the piece.
            let bound = if braking > 0.0 { line.from } else { line.to };
            let share = slope * (speed - bound) / braking;
            let reach =
                if slope.abs() * left < TINY { (speed - bound) / braking } else { -ln_1p(-share) / slope };
            let (passed, after) = if reach < left && reach > 0.0 {
                (reach, bound)
            } else if decay.abs() < TINY {
                (left, speed - braking * left * (1.0 - 0.5 * decay))
            } else {
                (left, speed + braking * (exp_m1(-decay) / slope))
            };
            let (lost, rate) = (speed - after, slope * passed);
            // Integrals of an exponential that goes from one speed to the other.
            let angle = if rate.abs() < TINY {
                passed * (0.5 * (speed + after) + lost * rate * (1.0 / 12.0))
            } else {
                passed * (speed - braking / slope) + lost / slope
            };
            let mean = angle / passed;
            done.angle[own] += angle;
            done.square[own] += passed * (mean * mean + lost * lost * (1.0 / 12.0));
            done.law_impulse[own] += lost - load * passed;
            done.law_work[own] += 0.5 * lost * (speed + after) - load * angle;
            left -= passed;
            speed = after;
        }
        rows.speed[own] = speed;
    }
}

/// Below this share of a time constant an exponential is computed by its series, to fourth order.
const TINY: f64 = 1.0e-4;

/// The torque of a law at a speed.
pub(crate) fn torque(law: &[LoadLine], speed: f64) -> f64 {
    let line = line_of(law, speed, 0.0);
    line.torque + line.slope * speed
}

/// The piece of a law at a speed; at a node, the piece that a rotor enters if `braking` acts on it.
fn line_of(law: &[LoadLine], speed: f64, braking: f64) -> &LoadLine {
    let index = if braking > 0.0 {
        law.partition_point(|line| line.to < speed)
    } else {
        law.partition_point(|line| line.to <= speed)
    };
    &law[index.min(law.len() - 1)]
}

/// A step of a contact.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Step {
    pub(crate) span: f64,
    /// The stator's angular speed at the start and at the end of the step.
    pub(crate) from: f64,
    pub(crate) to: f64,
    /// Changes of the rotor's speed by friction and by load over the whole step.
    pub(crate) friction: f64,
    pub(crate) load: f64,
}

/// A rotor after a step, and its motion during the step.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Slid {
    pub(crate) speed: f64,
    pub(crate) angle: f64,
    pub(crate) square: f64,
    pub(crate) work: f64,
    pub(crate) loss: f64,
}

impl Step {
    /// The step of a rotor with this speed at the start: the rotor slides, and if its slip ends within the
    /// step, it then sticks or slides the other way.
    #[inline(always)]
    pub(crate) fn slide(self, speed: f64) -> Slid {
        let Self { span, from, to, friction, load } = self;
        let gained = to - from;
        let (slip, pull) = (speed - from, gained + load);
        // The start of a slip from zero: friction holds unless the pull is larger.
        let onset = if pull < -friction {
            1.0
        } else if pull > friction {
            -1.0
        } else {
            0.0
        };
        let direction = if slip > 0.0 {
            1.0
        } else if slip < 0.0 {
            -1.0
        } else {
            onset
        };
        let end = slip - (direction * friction + pull);
        let crosses = direction * end < 0.0;
        let share = if direction == 0.0 {
            0.0
        } else if crosses {
            slip / (slip - end)
        } else {
            1.0
        };
        let rest = 1.0 - share;
        // Up to the end of the slip.
        let middle = from + gained * share;
        let reached = if rest > 0.0 { middle } else { speed - (direction * friction + load) };
        let first = direction * friction * share;
        let slipped = 0.5 * (slip + if rest > 0.0 { 0.0 } else { end });
        // From there on.
        let left = -(onset * friction + pull) * rest;
        let (last, torque, again) = if onset == 0.0 {
            (to, pull * rest, 0.0)
        } else {
            (to + left, -onset * friction * rest, 0.5 * left)
        };
        let last = if rest > 0.0 { last } else { reached };
        Slid {
            speed: last,
            angle: 0.5 * span * (share * (speed + reached) + rest * (reached + last)),
            square: span
                * (1.0 / 3.0)
                * (share * (speed * speed + speed * reached + reached * reached)
                    + rest * (reached * reached + reached * last + last * last)),
            work: 0.5 * (torque * (middle + to) - first * (from + middle)),
            loss: first * slipped + onset * friction * rest * again,
        }
    }
}

#[cfg(test)]
mod tests;
