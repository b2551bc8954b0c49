//! Rotors on a sine with a compliant contact, from release to release: one vertical motion carries all
//! rotors, in closed form.
//!
//! The slip q - beta' changes with the platform's speed beta' = Q cos(t + theta), up to the effect of
//! friction and load in the contact, at most d = mu (integral of F) + |l| t. With n = (mu max F + |l|)/Q,
//! beta'' exceeds friction and load if |sin(t + theta)| > n: there the slip is monotonic, and friction cannot
//! hold the rotor. Elsewhere beta' is within Q n^2 of an extreme. So if ||q| - Q| > d + Q n^2, the slip
//! reverses once at each crossing of q and beta', and at no other time. The closed form with q fixed
//! determines the order of the reversals. If friction may hold the rotor, or change the number of its
//! reversals, the general engine decides.

use std::f64::consts::TAU;

use bouncing_disk_core::Phase;
use bouncing_disk_core::numerics::elementary::{acos, atan2, wrapped_angle};

use crate::driven::DrivenSystem;
use crate::motion::phase_time::PhaseTime;
use crate::motor::tape::tap::{Tap, TapIntegrals, TapSolver};
use crate::motor::tape::window::{AxialWindow, RotorWindow};

/// Largest time (rad) by which a reversal may precede its expected time; beyond it the last slip has the
/// wrong sign, and the general engine decides.
const EARLIER: f64 = 1.0e-3;

/// Rotors between two contacts.
#[derive(Debug)]
pub(crate) struct Tapped {
    solver: TapSolver,
    rotors: Vec<TappedRotor>,
    /// Whether the state belongs to the rotors.
    pub(crate) begun: bool,
    pub(crate) time: PhaseTime,
    /// Gap and velocity relative to the platform.
    pub(crate) launch: [f64; 2],
}

#[derive(Debug)]
struct TappedRotor {
    friction: f64,
    load: f64,
    /// Largest angular speed of the platform, the lead of the angle over the height, and the coefficients of
    /// the angular speed for the cosine and the sine of the phase.
    twist: f64,
    lag: f64,
    parts: [f64; 2],
    speed: f64,
    /// The speed after the tap that is being computed.
    next: f64,
    done: RotorWindow,
}

impl Tapped {
    /// The rotors of these systems, which share the height, if the height and the angles are sines; their
    /// state is set by [`Self::begin`].
    pub(crate) fn new<'a>(systems: impl Iterator<Item = &'a DrivenSystem>) -> Option<Self> {
        let mut solver = None;
        let mut rotors = Vec::new();
        for system in systems {
            let angle = &system.angle;
            if angle.next_joint(0.0).is_some() || angle.highest_harmonic() > 1.0 {
                return None;
            }
            if solver.is_none() {
                solver = Some(TapSolver::new(system.compliance.as_ref()?)?);
            }
            let start = angle.at(0.0);
            let parts = [start.velocity, -start.acceleration];
            rotors.push(TappedRotor {
                friction: system.friction,
                load: system.load,
                twist: angle.bounds().speed,
                lag: atan2(parts[1], parts[0]),
                parts,
                speed: 0.0,
                next: 0.0,
                done: RotorWindow::default(),
            });
        }
        let (time, launch) = (PhaseTime::in_first_period(Phase::new(0.0).ok()?), [0.0; 2]);
        Some(Self { solver: solver?, rotors, begun: false, time, launch })
    }

    pub(crate) fn speeds(&self) -> impl Iterator<Item = f64> {
        self.rotors.iter().map(|rotor| rotor.speed)
    }

    /// Continues from this release, or from any other flight.
    pub(crate) fn begin(&mut self, time: PhaseTime, launch: [f64; 2], speeds: impl Iterator<Item = f64>) {
        (self.begun, self.time, self.launch) = (true, time, launch);
        for (rotor, speed) in self.rotors.iter_mut().zip(speeds) {
            rotor.speed = speed;
        }
    }

    /// Advances to the next release; returns the angle that the first rotor turns, or `None` as for
    /// [`Self::tap`].
    pub(crate) fn turn(&mut self) -> Option<f64> {
        self.tap(&mut AxialWindow::default())?;
        Some(self.rotors[0].done.angle)
    }

    /// Advances to the next release, and adds the motion up to it to a window. If the tap cannot be decided
    /// here, nothing changes.
    pub(crate) fn tap(&mut self, axial: &mut AxialWindow) -> Option<()> {
        let [gap, velocity] = self.launch;
        let touch = self.solver.flight(self.time.phase, gap, velocity)?;
        let tap = self.solver.contact(&touch)?;
        let (from, to) = (self.solver.integrals(&tap.start), self.solver.integrals(&tap.end));
        let duration = touch.duration;
        for rotor in &mut self.rotors {
            rotor.carry(&self.solver, duration, &tap, [&from, &to])?;
        }
        for rotor in &mut self.rotors {
            rotor.speed = rotor.next;
        }
        let peak = self.solver.vibration().peak_acceleration();
        axial.normal_work += peak * (to.force_cos - from.force_cos);
        axial.restitution_loss +=
            (to.loss - from.loss) + (self.solver.spring_energy(gap) - self.solver.spring_energy(touch.gap));
        axial.impacts += 1;
        self.launch = [tap.gap, tap.velocity];
        self.time = PhaseTime { periods: self.time.periods + touch.turns + tap.turns, phase: tap.phase };
        Some(())
    }

    /// Adds a relative speed; returns the added energy.
    pub(crate) fn perturb(&mut self, speed: f64) -> f64 {
        let before = self.solver.vibration().velocity(self.time.phase) + self.launch[1];
        self.launch[1] += speed;
        0.5 * speed * (2.0 * before + speed)
    }
}

impl TappedRotor {
    /// The slip of a rotor at this speed, for this sine and cosine of the phase.
    fn slip(&self, speed: f64, sin: f64, cos: f64) -> f64 {
        speed - (self.parts[0] * cos - self.parts[1] * sin)
    }

    /// A flight and a contact; `None` if they cannot be decided here.
    fn carry(
        &mut self,
        solver: &TapSolver,
        flight: f64,
        tap: &Tap,
        [from, to]: [&TapIntegrals; 2],
    ) -> Option<()> {
        let (mu, load) = (self.friction, self.load);
        let speed = self.speed - load * flight;
        self.done =
            RotorWindow { angle: flight * (self.speed - 0.5 * load * flight), ..RotorWindow::default() };
        // Beyond this share of the platform's largest speed, friction and load may exceed its acceleration.
        let near = (mu * tap.largest_force + load.abs()) / self.twist;
        let drift = mu * (to.impulse - from.impulse) + load.abs() * tap.end.after;
        let clear = (speed.abs() - self.twist).abs() > drift + self.twist * near * near;
        if !clear {
            return None;
        }
        let mut direction = self.slip(speed, tap.start.sin, tap.start.cos);
        direction = if direction > 0.0 { 1.0 } else { -1.0 };
        let (mut last, mut before, mut now) = (0.0, *from, speed);
        if speed.abs() < self.twist {
            let cosine = speed / self.twist;
            let corner = acos(cosine);
            let begin = wrapped_angle(tap.angle + self.lag);
            let (mut next, expected) = match begin {
                _ if begin < corner => (corner, -1.0),
                _ if begin < TAU - corner => (TAU - corner, 1.0),
                _ => (TAU + corner, -1.0),
            };
            if direction * expected < 0.0 {
                return None;
            }
            while next - begin < tap.end.after + EARLIER {
                // The platform turns as fast as the rotor there, and accelerates or decelerates.
                let near = solver.instant(&tap.start, next - begin)?;
                let pull = direction * mu;
                let reversal = solver.polished(&tap.start, near, |at| {
                    let turned = self.slip(0.0, at.sin, at.cos);
                    let rising = self.parts[0] * at.sin + self.parts[1] * at.cos;
                    let gained = load * (at.after - last) + pull * (solver.impulse(at) - before.impulse);
                    let [slope, bend, _] = solver.force_slopes(at);
                    [
                        now - gained + turned,
                        rising - load - pull * solver.force(at),
                        -turned - pull * slope,
                        -rising - pull * bend,
                    ]
                })?;
                if reversal.after >= tap.end.after {
                    break;
                }
                if reversal.after <= last {
                    return None;
                }
                let there = solver.integrals(&reversal);
                now = self.slide(direction, now, [&before, &there], reversal.after - last);
                (last, before, direction) = (reversal.after, there, -direction);
                next += if direction > 0.0 { TAU - 2.0 * corner } else { 2.0 * corner };
            }
        }
        now = self.slide(direction, now, [&before, to], tap.end.after - last);
        if direction * self.slip(now, tap.end.sin, tap.end.cos) < 0.0 {
            return None;
        }
        self.next = now;
        Some(())
    }

    /// Adds a slide; returns the speed at its end.
    fn slide(&mut self, direction: f64, speed: f64, [from, to]: [&TapIntegrals; 2], span: f64) -> f64 {
        let (pull, load) = (direction * self.friction, self.load);
        let impulse = to.impulse - from.impulse;
        let lift = (to.lift - from.lift) - from.impulse * span;
        let platform =
            self.parts[0] * (to.force_cos - from.force_cos) - self.parts[1] * (to.force_sin - from.force_sin);
        let rotor = speed * impulse - load * (span * impulse - lift) - 0.5 * pull * impulse * impulse;
        self.done.angle += span * (speed - 0.5 * load * span) - pull * lift;
        self.done.friction_work -= pull * platform;
        self.done.friction_loss += pull * (rotor - platform);
        speed - load * span - pull * impulse
    }
}

#[cfg(test)]
mod tests;
