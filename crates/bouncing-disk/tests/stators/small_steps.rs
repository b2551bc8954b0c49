//! A disk on a stator that yields, in small time steps and SI units: it knows no events but the touch.
//!
//! Steps are Runge-Kutta's of fourth order; a touch is bisected within its step, and a rigid impact is
//! integrated in small steps of its impulse. Rigid contact and stick are no states: a step that starts on the
//! stator and would end in it gets the even force that ends it without relative velocity, and friction is the
//! torque within Coulomb's bounds that opposes the slip at the end of a step. In a soft contact a step ends
//! where the slip reverses: otherwise a regular motion, which always reverses at the same share of a step, has an
//! error of first order. A chatter ends with its first flight below a step. Errors fall with the second power of
//! the step, in flights with the fourth.

use std::f64::consts::{PI, TAU};

use super::{cos, sin};

/// A mode, `mass (q'' + omega/quality q' + omega^2 q) = force sin(drive + phase) - phi N - psi T`.
#[derive(Clone, Copy, Debug)]
pub struct Mode {
    /// Height of the tip per unit of q, and its angle.
    pub phi: f64,
    pub psi: f64,
    pub mass: f64,
    pub omega: f64,
    pub quality: f64,
    pub force: f64,
    pub phase: f64,
}

impl Mode {
    /// A mode that takes no part.
    pub const NONE: Self =
        Self { phi: 0.0, psi: 0.0, mass: 1.0, omega: 1.0, quality: 1.0, force: 0.0, phase: 0.0 };

    /// Coordinate and velocity of the motion without a rotor at a phase of the drive with `omega`.
    pub fn steady(&self, omega: f64, drive: f64) -> [f64; 2] {
        let (re, im) = (self.omega * self.omega - omega * omega, omega * self.omega / self.quality);
        let size = self.force / self.mass / (re * re + im * im);
        let (s, c) = (sin(drive + self.phase), cos(drive + self.phase));
        [size * (re * s - im * c), size * omega * (re * c + im * s)]
    }
}

/// Stator, rotor and contact, in SI units.
#[derive(Clone, Copy, Debug)]
pub struct Motor {
    /// Angular frequency of the drive.
    pub omega: f64,
    pub modes: [Mode; 2],
    /// Prescribed: `twist sin(drive + lag)`, on top of the modes.
    pub twist: f64,
    pub lag: f64,
    pub mass: f64,
    pub gyration_radius: f64,
    pub contact_radius: f64,
    pub gravity: f64,
    pub friction: f64,
    pub restitution: f64,
    /// Torque against a positive speed, always the same.
    pub load: f64,
    /// Stiffness and damping of the contact; rigid without.
    pub spring: Option<(f64, f64)>,
    /// Steps in a period; steps of impulse in each half of a rigid impact.
    pub steps: usize,
    pub impulses: f64,
    /// Largest velocity that is added where a contact ends: no cycle is chosen by rounding.
    pub kick: f64,
}

/// Rotor: height, velocity, angular speed; modes: coordinate and velocity of each.
const X: usize = 0;
const V: usize = 1;
const U: usize = 2;
const Q: [usize; 2] = [3, 5];
/// Integrals over a window: angle; work of the modes' forces, of the prescribed motion; losses in each mode,
/// along the normal of the contact, in friction.
const ANGLE: usize = 7;
const FORCES: usize = 8;
const PRESCRIBED: usize = 9;
const MODES: [usize; 2] = [10, 11];
const NORMAL: usize = 12;
const SLIP: usize = 13;
pub type State = [f64; 14];

/// Steps in contact within one in flight.
const CONTACT: f64 = 8.0;

/// The drive at an instant: acceleration of each mode; prescribed angular speed.
#[derive(Clone, Copy, Debug)]
struct Drive {
    pushes: [f64; 2],
    turn: f64,
}

/// A motor on its way.
#[derive(Clone, Debug)]
pub struct Steps {
    motor: Motor,
    pub state: State,
    /// On the stator.
    pub touching: bool,
    /// Steps done of this period, and the drive at each half step.
    step: usize,
    drives: Vec<Drive>,
    kicks: f64,
}

impl Motor {
    fn inertia(&self) -> f64 {
        self.mass * self.gyration_radius * self.gyration_radius
    }

    /// Gain of relative velocity and slip by unit impulses: along, across (each of the other), slip.
    fn inverse_mass(&self) -> [f64; 3] {
        let rotor = [1.0 / self.mass, 0.0, 1.0 / self.inertia()];
        self.modes.iter().fold(rotor, |[along, cross, across], Mode { phi, psi, mass, .. }| {
            [along + phi * phi / mass, cross + phi * psi / mass, across + psi * psi / mass]
        })
    }

    fn drive(&self, phase: f64) -> Drive {
        Drive {
            pushes: self.modes.map(|mode| mode.force / mode.mass * sin(phase + mode.phase)),
            turn: self.twist * self.omega * cos(phase + self.lag),
        }
    }

    /// Gap, its rate of change, and slip.
    #[inline(always)]
    fn relative(&self, y: &State, drive: &Drive) -> [f64; 3] {
        let rotor = [y[X], y[V], y[U] - drive.turn];
        Q.into_iter().zip(&self.modes).fold(rotor, |[gap, velocity, slip], (q, Mode { phi, psi, .. })| {
            [gap - phi * y[q], velocity - phi * y[q + 1], slip - psi * y[q + 1]]
        })
    }

    /// Rates of change under a normal force, for which a spring has its own, and friction's torque over it.
    #[inline(always)]
    fn rates(&self, y: &State, drive: &Drive, [normal, torque]: [f64; 2]) -> State {
        let mut rates = [0.0; 14];
        (rates[X], rates[V], rates[U], rates[ANGLE]) =
            (y[V], -self.gravity, -self.load / self.inertia(), y[U]);
        for (j, (q, mode)) in Q.into_iter().zip(&self.modes).enumerate() {
            let (drag, push) = (mode.omega / mode.quality * y[q + 1], drive.pushes[j]);
            rates[q] = y[q + 1];
            rates[q + 1] = push - drag - mode.omega * mode.omega * y[q];
            rates[FORCES] += mode.mass * push * y[q + 1];
            rates[MODES[j]] = mode.mass * drag * y[q + 1];
        }
        if normal != 0.0 {
            let [gap, velocity, slip] = self.relative(y, drive);
            let spring = |(k, c): (f64, f64)| (-k * gap - c * velocity).max(0.0);
            let n = if self.spring.is_some() && gap > 0.0 { 0.0 } else { self.spring.map_or(normal, spring) };
            let t = torque * n;
            rates[V] += n / self.mass;
            rates[U] += t / self.inertia();
            for (q, mode) in Q.into_iter().zip(&self.modes) {
                rates[q + 1] -= (mode.phi * n + mode.psi * t) / mode.mass;
            }
            rates[PRESCRIBED] = t * drive.turn;
            (rates[NORMAL], rates[SLIP]) = (-n * velocity, -t * slip);
        }
        rates
    }

    /// The torque over the normal force, within Coulomb's bounds, that opposes the slip at the end of a step.
    fn coulomb(&self, end: impl Fn(f64) -> f64) -> f64 {
        let mut high = self.friction * self.contact_radius;
        let mut low = -high;
        let (mut below, mut above) = (end(low), end(high));
        if below >= 0.0 || above <= 0.0 {
            return if below >= 0.0 { low } else { high };
        }
        for _ in 0..3 {
            let middle = low - below * (high - low) / (above - below);
            let slip = end(middle);
            if slip > 0.0 { (high, above) = (middle, slip) } else { (low, below) = (middle, slip) }
        }
        low - below * (high - low) / (above - below)
    }
}

#[inline(always)]
fn add(y: &State, rates: &State, time: f64) -> State {
    std::array::from_fn(|i| y[i] + rates[i] * time)
}

impl Steps {
    /// A rotor that lies at a step of the period on a stator that moves as without it.
    pub fn new(motor: Motor, step: usize, speed: f64) -> Self {
        let phase = |half: usize| PI * half as f64 / motor.steps as f64;
        let drives: Vec<_> = (0..=2 * motor.steps).map(|half| motor.drive(phase(half))).collect();
        let mut state = [0.0; 14];
        for (j, mode) in motor.modes.iter().enumerate() {
            [state[Q[j]], state[Q[j] + 1]] = mode.steady(motor.omega, phase(2 * step));
        }
        let [gap, velocity, _] = motor.relative(&state, &drives[2 * step]);
        (state[X], state[V], state[U]) = (-gap, -velocity, speed);
        Self { motor, state, touching: true, step, drives, kicks: 0.0 }
    }

    /// State and drive at a share of the step, from those at another.
    fn integrate(&self, from: f64, to: f64, contact: [f64; 2]) -> (State, Drive) {
        let (motor, y, angle) = (&self.motor, &self.state, TAU / self.motor.steps as f64);
        let time = (to - from) * angle / motor.omega;
        let [start, middle, end] = if to - from >= 1.0 {
            [0, 1, 2].map(|half| self.drives[2 * self.step + half])
        } else {
            [from, 0.5 * (from + to), to].map(|share| motor.drive(angle * (self.step as f64 + share)))
        };
        let one = motor.rates(y, &start, contact);
        let two = motor.rates(&add(y, &one, 0.5 * time), &middle, contact);
        let three = motor.rates(&add(y, &two, 0.5 * time), &middle, contact);
        let four = motor.rates(&add(y, &three, time), &end, contact);
        let mean = std::array::from_fn(|i| (one[i] + 2.0 * (two[i] + three[i]) + four[i]) / 6.0);
        (add(y, &mean, time), end)
    }

    /// Adds a normal and a tangential impulse.
    fn push(&mut self, drive: &Drive, [along, across]: [f64; 2]) {
        let (motor, y) = (&self.motor, &mut self.state);
        let before = motor.relative(y, drive);
        y[V] += along / motor.mass;
        y[U] += across / motor.inertia();
        for (q, mode) in Q.into_iter().zip(&motor.modes) {
            y[q + 1] -= (mode.phi * along + mode.psi * across) / mode.mass;
        }
        y[PRESCRIBED] += across * drive.turn;
        let after = motor.relative(y, drive);
        y[NORMAL] -= 0.5 * along * (before[1] + after[1]);
        y[SLIP] -= 0.5 * across * (before[2] + after[2]);
    }

    /// Routh's impact: the restitution ends when it has returned e^2 of the work of the compression.
    fn impact(&mut self, drive: &Drive) {
        let [along, cross, across] = self.motor.inverse_mass();
        let increment =
            (-self.motor.relative(&self.state, drive)[1]).max(0.0) / (along * self.motor.impulses);
        let before = std::mem::take(&mut self.state[NORMAL]);
        let mut end = 0.0;
        for compression in [true, false] {
            loop {
                let [_, velocity, slip] = self.motor.relative(&self.state, drive);
                let torque = self.motor.coulomb(|t| slip + (cross + across * t) * increment);
                let (slope, left) = (along + cross * torque, (self.state[NORMAL] - end).max(0.0));
                let sum = velocity + (velocity * velocity + 2.0 * slope * left).sqrt();
                let rest = if compression { -velocity / slope } else { 2.0 * left / sum.max(1e-300) };
                let impulse = rest.min(increment).max(0.0);
                self.push(drive, [impulse, torque * impulse]);
                if rest <= increment {
                    break;
                }
            }
            end = (1.0 - self.motor.restitution * self.motor.restitution) * self.state[NORMAL];
        }
        self.state[NORMAL] += before;
    }

    /// Goes on by a step.
    pub fn advance(&mut self) {
        let touched = self.touching;
        let (motor, rigid, mut from) = (self.motor, self.motor.spring.is_none(), 0.0);
        let [along, cross, across] = motor.inverse_mass();
        while from < 1.0 {
            let mut to = if self.touching { ((from * CONTACT).floor() + 1.0) / CONTACT } else { 1.0 };
            let slip_at = |to: f64, torque: f64| {
                let (end, drive) = self.integrate(from, to, [1.0, torque]);
                motor.relative(&end, &drive)[2]
            };
            if self.touching && !rigid {
                // A step ends where the slip does.
                let drive = motor.drive(TAU * (self.step as f64 + from) / self.motor.steps as f64);
                let before = motor.relative(&self.state, &drive)[2];
                let after = slip_at(to, -before.signum() * motor.friction * motor.contact_radius);
                let share = before / (before - after);
                if share > 1e-3 && share < 1.0 {
                    to = from + share * (to - from);
                }
            }
            let slip = |torque: f64| slip_at(to, torque);
            let torque = if rigid || !self.touching { 0.0 } else { motor.coulomb(slip) };
            let (mut end, drive) = self.integrate(from, to, [f64::from(u8::from(!rigid)), torque]);
            let [gap, velocity, slip] = motor.relative(&end, &drive);
            if gap > 0.0 || self.touching {
                self.touching = gap <= 0.0;
                if rigid && self.touching {
                    let impulse = |torque: f64| (-velocity / (along + cross * torque)).max(0.0);
                    let torque = motor.coulomb(|torque| slip + (cross + across * torque) * impulse(torque));
                    let time = (to - from) * TAU / motor.omega / self.motor.steps as f64;
                    end = self.integrate(from, to, [impulse(torque) / time, torque]).0;
                    end[X] -= motor.relative(&end, &drive)[0];
                }
                (self.state, from) = (end, to);
                continue;
            }
            let (mut above, mut below) = (from, 1.0);
            for _ in 0..40 {
                let middle = 0.5 * (above + below);
                let (state, drive) = self.integrate(from, middle, [0.0; 2]);
                *(if motor.relative(&state, &drive)[0] > 0.0 { &mut above } else { &mut below }) = middle;
            }
            let (state, drive) = self.integrate(from, below, [0.0; 2]);
            (self.state, self.touching, from) = (state, true, below);
            if rigid {
                self.impact(&drive);
            }
        }
        self.step = (self.step + 1) % self.motor.steps;
        if touched && !self.touching {
            self.kicks = (self.kicks + 0.618_033_988_749_895) % 1.0;
            self.state[V] += self.kicks * motor.kick;
        }
    }

    /// Means over whole periods from here on, in SI units: angular speed, `sqrt(2 <q'^2>)/omega` of the first mode,
    /// powers of the drive, and lost in the modes, along the normal of the contact, and in friction.
    pub fn window(&mut self, periods: usize) -> [f64; 6] {
        self.state[ANGLE..].fill(0.0);
        for _ in 0..periods * self.motor.steps {
            self.advance();
        }
        let (y, motor) = (&self.state, &self.motor);
        let time = TAU / motor.omega * periods as f64;
        let [turned, forces, prescribed, first, second, normal, slip] =
            [ANGLE, FORCES, PRESCRIBED, MODES[0], MODES[1], NORMAL, SLIP].map(|i| y[i] / time);
        let Mode { mass, omega, quality, .. } = motor.modes[0];
        let amplitude = (2.0 * first * quality / (mass * omega)).sqrt() / motor.omega;
        [turned, amplitude, forces + prescribed, first + second, normal, slip]
    }
}
