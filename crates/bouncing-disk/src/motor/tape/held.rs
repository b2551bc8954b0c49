//! Held amplitudes: amplitudes of a stator with a compliant height at which a run may start.
//!
//! Let the stator move as a sine of amplitude A, whatever the disk does. The first harmonic of the contact
//! force then determines the drive that would maintain this motion. Amplitudes at which the required drive
//! equals the available one are close to the steady amplitudes, including unstable ones and those that no run
//! from rest reaches (docs/numerics-dynamics.md, "The tape of the force").
//!
//! The contact force under s = A sin sigma has the first harmonic N1 = <2 N sin sigma> + i <2 N cos sigma>.
//! Let f be the resonance of the mode relative to the drive, and psi the phase by which the stator leads the
//! drive. The drive that maintains this motion is (D A + N1) exp(i psi), D = M (f^2 - 1 + i f/Q). At a held
//! amplitude the magnitude |D A + N1| equals the available drive, and the phase of the equation determines
//! psi. An amplitude is stable if a larger one needs a larger drive.
//!
//! - N is never negative and has the mean 1, so |N1| <= 2. Hence A is within 2/|D| of the free amplitude. N
//!   supplies no power to the stator, so A <= |drive|/Im D.
//! - A disk that never leaves the stator follows it linearly: N1 = -kappa A, with kappa = 1 in a rigid
//!   contact and kappa = (k + i c)/(k + i c - 1) in a compliant one, as long as |kappa| A <= 1. This state is
//!   exact.
//! - Otherwise the disk is followed from amplitude to amplitude, upwards and downwards, and regula falsi
//!   narrows a change of sign (`held/branch.rs`). If the required drive jumps across the available one, there
//!   is no root.
//!
//! Held amplitudes neglect the recoil of the stator: at M = 3 the error of the amplitude is 0.1 % for a
//! tapped motion, and up to a third for a chaotic motion.

mod branch;

use bouncing_disk_core::Phase;
use bouncing_disk_core::numerics::elementary::{exp, hypot, ln, sin_cos};
use bouncing_disk_core::run::WorkCount;

use crate::error::Error;
use crate::motion::phase_time::PhaseTime;
use crate::motion::state::{DiskState, Mode};
use crate::motor::tape::held::branch::Search;
use crate::stator::{StatorState, StatorSystem};

/// Ratio of neighbouring amplitudes of a branch, and the smallest number of amplitudes.
const RATIO: f64 = 1.18;
const LEAST_AMPLITUDES: f64 = 6.0;

/// Two held amplitudes that differ by less than this share are the same amplitude, found twice on two
/// branches or because of scatter.
const ONE: f64 = 0.05;

/// Largest difference of the starts of two members at one held amplitude, as a share of the stator's speed.
const APART: f64 = 1.0e-6;

/// A motion of disk and stator that the drive would maintain if the stator moved as a sine.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Held {
    /// Amplitude in units of g/omega^2.
    pub(crate) amplitude: f64,
    /// Whether a larger amplitude needs a larger drive.
    pub(crate) is_stable: bool,
    /// The lead (rad) of the stator's phase over its phase without a disk, and the stator's deflection by the
    /// disk's weight.
    ahead: f64,
    sag: f64,
    /// Indentation of a contact by the preload.
    compression: f64,
    /// Disk and stator in this motion, at this phase of the drive.
    time: PhaseTime,
    state: StatorState,
}

/// The start of a disk on a stator that moves with a held amplitude.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum DiskStart {
    /// On the motion that belongs to the amplitude; a start in flight is perturbed by a tiny amount,
    /// proportional to this share.
    OnMotion(f64),
    /// At rest on the stator at this phase of the drive; a disk that lies there for ever starts on its linear
    /// motion.
    AtRest(Phase),
    /// Thrown up at this phase with this multiple of the stator's speed, unless the disk lies on the stator
    /// for ever.
    Thrown(Phase, f64),
}

impl Held {
    /// The start of a run at this held amplitude.
    pub(crate) fn start(&self, disk: DiskStart) -> (PhaseTime, StatorState) {
        let mut state = self.state;
        let (phase, speed, mode) = match disk {
            DiskStart::OnMotion(share) => {
                if state.disk.mode == Mode::Flight {
                    state.disk.axial_velocity += APART * share * self.amplitude;
                }
                return (self.time, state);
            }
            DiskStart::AtRest(_) | DiskStart::Thrown(..) if self.state.disk.mode != Mode::Flight => {
                return (self.time, state);
            }
            DiskStart::AtRest(phase) => (phase, 0.0, Mode::Sticking),
            DiskStart::Thrown(phase, share) => (phase, share * self.amplitude, Mode::Flight),
        };
        let (sin, cos) = sin_cos(phase.angle() + self.ahead);
        state.modes[0] = [self.amplitude * sin - self.sag, self.amplitude * cos];
        state.disk = DiskState::flying(state.modes[0][0], state.modes[0][1] + speed, 0.0);
        state.disk.mode = mode;
        if mode != Mode::Flight {
            state.disk.height -= self.compression;
        }
        (PhaseTime::in_first_period(phase), state)
    }
}

/// The held amplitudes of a stator with one mode, which moves in height, in rising order; empty without a
/// drive. Relaunches from rigid contacts are perturbed by speeds up to this size from a stream with this
/// seed.
pub(crate) fn held_amplitudes(
    system: &StatorSystem,
    perturbation: (f64, u64),
    work: &mut WorkCount<'_>,
) -> Result<Vec<Held>, Error> {
    let free = system.base().peak_acceleration();
    if free == 0.0 || system.modes[0].height == 0.0 {
        return Ok(Vec::new());
    }
    let mut search = Search::new(system, perturbation, work)?;
    let mut found: Vec<Held> = search.lying()?.into_iter().collect();
    // The mean force is 1 and it never pulls, so its first harmonic is at most 2; it supplies no power.
    let [re, im] = search.follows();
    let size = hypot(search.stiffness[0], search.stiffness[1]);
    let least = (1.0 / hypot(re, im)).max(free - 2.0 / size);
    let most = (free + 2.0 / size).min(search.force / search.stiffness[1]);
    if least < most {
        let range = ln((most + ONE * (most - least)) / least);
        let steps = (range / ln(RATIO)).max(LEAST_AMPLITUDES).ceil() as u32;
        let at = |step: u32| least * exp(range * (f64::from(step) / f64::from(steps)));
        let mut both = || {
            let mut branch = search.start(least)?;
            search.follow(&mut branch, (1..=steps).map(at), &mut found)?;
            search.follow(&mut branch, (0..steps).rev().map(at), &mut found)
        };
        // A branch that cannot be computed gives no starts.
        if let Err(error @ Error::Core(bouncing_disk_core::Error::Stopped { .. })) = both() {
            return Err(error);
        }
    }
    found.sort_by(|one, other| one.amplitude.total_cmp(&other.amplitude));
    Ok(found)
}

/// Adds a held amplitude if it is new.
fn add(found: &mut Vec<Held>, held: Held) {
    let is_known = |known: &Held| {
        known.is_stable == held.is_stable && (known.amplitude / held.amplitude - 1.0).abs() < ONE
    };
    if !found.iter().any(is_known) {
        found.push(held);
    }
}

#[cfg(test)]
mod tests;
