//! A tape of the normal force: the vertical motion of a disk, recorded once and replayed by any number of rotors.
//!
//! If friction does not act back on the height, the vertical motion affects a rotor only through the time and
//! strength of the normal force. A tape stores this as [`Knot`]s. Each knot contains the phase of the drive,
//! the impulse of contact over the step that ends at the knot, and the impulse of an impact at the end of
//! this step. Within the step the force and the stator's angular acceleration are assumed constant. A
//! [`replay`] carries rotors of any inertia, friction, load, phase lag and twist along the tape
//! (docs/numerics-dynamics.md, "The tape of the force").

pub(crate) mod cycle;
mod engine;
pub(crate) mod held;
pub(crate) mod left;
pub(crate) mod recurrence;
pub(crate) mod replay;
mod rigid;
pub(crate) mod source;
pub(crate) mod tap;
pub(crate) mod taped;
pub(crate) mod tapped;
mod taps;
pub(crate) mod window;

use std::f64::consts::TAU;

use bouncing_disk_core::numerics::elementary::sin_cos;
use bouncing_disk_drives::Drive;

use crate::motor::tape::window::AxialWindow;
use crate::stator::StatorLedger;

/// Fewest steps into which a contact is divided, however short it is, to resolve the rise and fall of the
/// force.
const LEAST_STEPS: f64 = 6.0;

/// The end of a step of a tape, in radians of the drive and units of m g/omega.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Knot {
    /// Duration of the step.
    pub(crate) duration: f64,
    /// Sine and cosine of the phase at the end of the step.
    pub(crate) sin: f64,
    pub(crate) cos: f64,
    /// Impulse of the contact over the step; zero in flight.
    pub(crate) pressed: f64,
    /// Impulse of an impact at the end of the step.
    pub(crate) hit: f64,
}

/// A recorded part of a vertical motion.
#[derive(Debug, Clone, Default)]
pub(crate) struct Tape {
    /// The knots; the first is the start.
    pub(crate) knots: Vec<Knot>,
    /// The stator's angular speed at the knots, for each non-sinusoidal twist.
    pub(crate) speeds: Vec<Vec<f64>>,
    /// Steps per period of the drive during a contact; zero for one step per contact.
    pub(crate) resolution: f64,
    /// Energies and impacts of the recorded motion.
    pub(crate) axial: AxialWindow,
    pub(crate) stator: StatorLedger,
    twists: Vec<Drive>,
}

impl Tape {
    /// A tape that begins at this phase (rad), for stators with these twists.
    pub(crate) fn new(phase: f64, resolution: f64, twists: Vec<Drive>) -> Self {
        let speeds = vec![Vec::new(); twists.len()];
        let mut tape = Self { resolution, twists, speeds, ..Self::default() };
        tape.begin(phase);
        tape
    }

    /// The non-sinusoidal twists of the stators.
    pub(crate) fn twists(&self) -> Vec<Drive> {
        self.twists.clone()
    }

    /// Empties the tape, which then begins at this phase (rad).
    pub(crate) fn begin(&mut self, phase: f64) {
        self.knots.clear();
        self.speeds.iter_mut().for_each(Vec::clear);
        (self.axial, self.stator) = Default::default();
        let (sin, cos) = sin_cos(phase);
        self.push(Knot { sin, cos, ..Knot::default() }, phase);
    }

    /// Empties the tape, which then continues from its last knot.
    pub(crate) fn restart(&mut self) {
        let last = self.knots.len() - 1;
        self.knots.drain(..last);
        self.speeds.iter_mut().for_each(|speeds| drop(speeds.drain(..last)));
        (self.axial, self.stator) = Default::default();
    }

    /// Number of steps for a contact of this duration; one if only the motion is required.
    pub(crate) fn steps(&self, duration: f64) -> u32 {
        if self.resolution == 0.0 {
            return 1;
        }
        (duration * (self.resolution / TAU)).ceil().clamp(LEAST_STEPS, f64::from(u32::MAX)) as u32
    }

    /// Adds a knot at this phase (rad, in any turn). Of two knots at one instant, the second is after a kink
    /// of the twist.
    pub(crate) fn push(&mut self, knot: Knot, phase: f64) {
        let after_kink = knot.duration == 0.0 && !self.knots.is_empty() && knot.hit == 0.0;
        self.knots.push(knot);
        for (twist, speeds) in self.twists.iter().zip(&mut self.speeds) {
            let at = phase.rem_euclid(TAU);
            speeds.push(if after_kink || knot.hit > 0.0 {
                twist.at(at).velocity
            } else {
                twist.velocity_before(at)
            });
        }
    }

    /// The time from this phase to the next kink of a stator's twist, if it is within the limit.
    fn next_kink(&self, phase: f64, within: f64) -> Option<f64> {
        let at = phase.rem_euclid(TAU);
        let kinks = self.twists.iter().filter_map(|twist| twist.next_kink(at));
        kinks.map(|kink| kink.after).filter(|after| *after > 0.0 && *after < within).reduce(f64::min)
    }

    /// Adds a contact of this duration from this phase (rad) on; `impulse` returns the impulse up to a time
    /// after the start of the contact.
    pub(crate) fn press(&mut self, phase: f64, duration: f64, mut impulse: impl FnMut(f64) -> f64) {
        self.axial.pressed += duration;
        let steps = self.steps(duration);
        let step = duration / f64::from(steps);
        let (mut after, mut before) = (0.0, impulse(0.0));
        let mut index = 0_u32;
        while after < duration {
            let next = if index + 1 >= steps { duration } else { step * f64::from(index + 1) };
            let kink = self.next_kink(phase + after, next - after);
            let to = kink.map_or(next, |kink| after + kink);
            let now = impulse(to);
            let (sin, cos) = sin_cos(phase + to);
            // The force cannot pull, but rounding may make a small force negative.
            let knot = Knot { duration: to - after, sin, cos, pressed: (now - before).max(0.0), hit: 0.0 };
            self.push(knot, phase + to);
            if kink.is_some() {
                self.push(Knot { duration: 0.0, pressed: 0.0, ..knot }, phase + to);
            } else {
                index += 1;
            }
            (after, before) = (to, now);
        }
    }
}
