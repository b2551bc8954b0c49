//! Branches of the vertical motion on a stator of held amplitude, followed from one amplitude to the next.
//!
//! An irregular motion also counts if the minimum of its required drive exceeds the available drive by less
//! than 10 % of 2/drive, because the recoil of the real stator within a period can make up for this excess.

use std::cell::Cell;

use bouncing_disk_core::numerics::elementary::{atan2, hypot, wrapped_angle};
use bouncing_disk_core::run::WorkCount;
use bouncing_disk_core::{ChatterPolicy, Phase};
use bouncing_disk_drives::compliance::Compliance;
use roots::{Convergency, find_root_regula_falsi};

use super::{Held, add};
use crate::driven::{DrivenEngine, DrivenStart, DrivenSystem};
use crate::error::Error;
use crate::motion::phase_time::PhaseTime;
use crate::motion::state::{DiskState, Mode};
use crate::motor::tape::Tape;
use crate::motor::tape::recurrence::{Recurrence, Touch};
use crate::motor::tape::source::{Source, bare};
use crate::stator::{MODES, ModeLaw, StatorState, StatorSystem};

/// Steps per period during a contact, for a motion that does not repeat and for a cycle.
const RESOLUTIONS: [f64; 2] = [64.0, 1024.0];

/// Number of events during which a motion may settle, and number of touches over which the force is averaged
/// if the motion does not repeat.
const SETTLING: u64 = 300;
const AVERAGED: u64 = 400;

/// Largest number of times that a step along a branch is halved while the required drive changes by more than
/// the share `JUMP` of the force, because a motion may be lost there.
const HALVINGS: u32 = 3;
const JUMP: f64 = 0.1;

/// After this number of partial steps, the remainder is taken in one step.
const MOST_PARTS: u32 = 6;

/// The required drive equals the available one if they differ by less than the share `FOUND` of the force,
/// for a motion that repeats and for a motion that scatters. The amplitude is also known if the ends of its
/// bracket differ by less than the shares `SAME`.
const FOUND: [f64; 2] = [1.0e-7, 1.0e-3];
const SAME: [f64; 2] = [1.0e-9, 1.0e-3];
const MOST_STEPS: usize = 60;

/// A drive that differs from the available one by more than this share of the force was found at a jump. If
/// the required drive never falls to the available one, but misses it by less than this, the motor may still
/// reach the motion, because the real stator recoils.
const NEAR: f64 = 0.1;

/// A vertical motion on a sine, and the drive that maintains the sine.
#[derive(Debug, Clone, Copy)]
struct Motion {
    time: PhaseTime,
    /// The disk; height and velocity are relative to the platform.
    disk: DiskState,
    /// The required drive: the components with the sine and the cosine of the stator's phase.
    asked: [f64; 2],
    /// Whether the motion was found to repeat.
    repeats: bool,
}

/// The present point on a branch of motions.
#[derive(Debug, Clone, Copy)]
pub(super) struct Branch {
    amplitude: f64,
    motion: Motion,
}

/// A search for held amplitudes.
pub(super) struct Search<'a, 'w> {
    system: &'a StatorSystem,
    mode: ModeLaw,
    /// M (f^2 - 1) and M d; the drive and its magnitude follow.
    pub(super) stiffness: [f64; 2],
    drive: [f64; 2],
    pub(super) force: f64,
    /// The largest harmonic of the contact force, as a share of the drive.
    share: f64,
    compliance: Option<Compliance>,
    perturbation: (f64, u64),
    work: &'a mut WorkCount<'w>,
}

impl<'a, 'w> Search<'a, 'w> {
    pub(super) fn new(
        system: &'a StatorSystem,
        perturbation: (f64, u64),
        work: &'a mut WorkCount<'w>,
    ) -> Result<Self, Error> {
        let (mode, free) = (system.modes[0], system.base().peak_acceleration());
        let stiffness = [mode.weight * (mode.stiffness - 1.0), mode.weight * mode.damping];
        let drive = stiffness.map(|part| free * part);
        let force = hypot(drive[0], drive[1]);
        let compliance = system.contact_time().map(|time| Compliance::new(time, system.base().restitution()));
        let (compliance, share) = (compliance.transpose()?, 2.0 / force);
        Ok(Self { system, mode, stiffness, drive, force, share, compliance, perturbation, work })
    }

    /// The response of a disk that never leaves the stator, divided by the motion of the stator: 1 in a rigid
    /// contact, (k + ic)/(k + ic - 1) in a compliant one.
    pub(super) fn follows(&self) -> [f64; 2] {
        self.compliance.map_or([1.0, 0.0], |own| {
            let (k, c) = (own.stiffness(), own.damping());
            let size = (k - 1.0) * (k - 1.0) + c * c;
            [(k * (k - 1.0) + c * c) / size, -c / size]
        })
    }

    /// The motion of a disk that lies on the stator for ever, which is linear and exact.
    pub(super) fn lying(&self) -> Result<Option<Held>, Error> {
        let [re, im] = self.follows();
        let asked = [self.stiffness[0] - re, self.stiffness[1] - im];
        let amplitude = self.force / hypot(asked[0], asked[1]);
        if amplitude * hypot(re, im) > 1.0 {
            return Ok(None);
        }
        let phase = Phase::new(0.0)?;
        let sag = self.compliance.map_or(0.0, |own| 1.0 / own.stiffness());
        let disk = DiskState {
            mode: Mode::Sticking,
            height: amplitude * im - sag,
            axial_velocity: amplitude * (re - 1.0),
            angle: 0.0,
            angular_speed: 0.0,
        };
        let motion = Motion { time: PhaseTime::in_first_period(phase), disk, asked, repeats: true };
        self.held(&Branch { amplitude, motion }, true).map(Some)
    }

    /// A held amplitude, with the stator's phase relative to the drive.
    fn held(&self, &Branch { amplitude, motion }: &Branch, is_stable: bool) -> Result<Held, Error> {
        let ahead = atan2(self.drive[1], self.drive[0]) - atan2(motion.asked[1], motion.asked[0]);
        let phase = motion.time.phase;
        let sag = 1.0 / (self.mode.weight * self.mode.stiffness);
        let mut modes = [[0.0; 2]; MODES];
        modes[0] = [amplitude * phase.sin() - sag, amplitude * phase.cos()];
        let mut disk = motion.disk;
        (disk.height, disk.axial_velocity) = (disk.height + modes[0][0], disk.axial_velocity + modes[0][1]);
        let time = PhaseTime::in_first_period(Phase::new(wrapped_angle(phase.angle() - ahead))?);
        let compression = self.system.compression();
        Ok(Held { amplitude, is_stable, ahead, sag, compression, time, state: StatorState { disk, modes } })
    }

    fn platform(&self, amplitude: f64) -> Result<DrivenSystem, Error> {
        let rigid = bare(amplitude, self.system.base().restitution())?;
        match self.system.contact_time() {
            None => Ok(rigid),
            Some(time) => rigid.with_contact_time(time),
        }
    }

    /// A disk placed on a stator.
    pub(super) fn start(&mut self, amplitude: f64) -> Result<Branch, Error> {
        let start = DrivenStart::Contact { phase: Phase::new(0.0)?, angular_speed: 0.0 };
        let engine = DrivenEngine::new(self.platform(amplitude)?, start, ChatterPolicy::Complete)?;
        Ok(Branch { amplitude, motion: self.settled(amplitude, engine)? })
    }

    /// The motion that a disk reaches at an amplitude from its motion at another amplitude.
    fn carried(&mut self, amplitude: f64, from: &Motion) -> Result<Motion, Error> {
        let phase = from.time.phase;
        let mut disk = from.disk;
        (disk.height, disk.axial_velocity) =
            (disk.height + amplitude * phase.sin(), disk.axial_velocity + amplitude * phase.cos());
        let platform = self.platform(amplitude)?;
        let time = PhaseTime::in_first_period(phase);
        let engine = DrivenEngine::of_state(platform, time, disk, ChatterPolicy::Complete)?;
        self.settled(amplitude, engine)
    }

    fn settled(&mut self, amplitude: f64, engine: DrivenEngine) -> Result<Motion, Error> {
        let mut source = Source::of_engine(engine, self.perturbation);
        let mut tape = Tape::new(source.phase(), RESOLUTIONS[0], Vec::new());
        let (mut recurrence, mut repeats) = (Recurrence::default(), None);
        for _ in 0..SETTLING {
            let touch = source.record(&mut tape, self.work)?;
            repeats = recurrence.add(touch, tape.axial.duration);
            tape.restart();
            if repeats.is_some() {
                break;
            }
        }
        // A single cycle determines everything.
        tape.resolution = RESOLUTIONS[usize::from(repeats.is_some())];
        let mut left = repeats.map_or(AVERAGED, |repeats| repeats.touches);
        let mut sums = [0.0; 3];
        while left > 0 {
            left -= u64::from(source.record(&mut tape, self.work)? != Touch::None);
            for knots in tape.knots.windows(2) {
                let (from, to) = (knots[0], knots[1]);
                let force = to.pressed / to.duration.max(f64::MIN_POSITIVE);
                sums[0] += to.pressed + to.hit;
                sums[1] += force * (from.cos - to.cos) + to.hit * to.sin;
                sums[2] += force * (to.sin - from.sin) + to.hit * to.cos;
            }
            tape.restart();
        }
        // The mean force is 1.
        let [whole, sine, cosine] = sums;
        let scale = if whole > 0.0 { 2.0 / whole } else { 0.0 };
        let [re, im] = self.stiffness;
        let asked = [re * amplitude + scale * sine, im * amplitude + scale * cosine];
        let time = source.time();
        let mut disk = source.disk().unwrap_or(DiskState::flying(0.0, 0.0, 0.0));
        disk.height -= amplitude * time.phase.sin();
        disk.axial_velocity -= amplitude * time.phase.cos();
        Ok(Motion { time, disk, asked, repeats: repeats.is_some() })
    }

    /// The excess of the required drive over the available drive, as a share of the available drive.
    fn excess(&self, motion: &Motion) -> f64 {
        hypot(motion.asked[0], motion.asked[1]) / self.force - 1.0
    }

    /// Follows a branch over these amplitudes, and adds the held amplitudes, and the one at which the drive
    /// comes nearest without reaching the available one.
    pub(super) fn follow(
        &mut self,
        branch: &mut Branch,
        amplitudes: impl Iterator<Item = f64>,
        found: &mut Vec<Held>,
    ) -> Result<(), Error> {
        let mut nearest: Option<Branch> = None;
        let (mut falls, mut off) = (false, NEAR * self.share);
        for target in amplitudes {
            let mut steps = 0;
            while branch.amplitude.to_bits() != target.to_bits() {
                let next = self.next(branch, target, if steps < MOST_PARTS { HALVINGS } else { 0 })?;
                steps += 1;
                let ends = [&*branch, &next].map(|own| self.excess(&own.motion));
                if ends[0] * ends[1] < 0.0
                    && let Some(held) = self.root([branch, &next], ends)?
                {
                    let is_stable = (ends[0] < 0.0) == (branch.amplitude < next.amplitude);
                    add(found, self.held(&held, is_stable)?);
                }
                // The drive has a minimum here.
                if falls && ends[1] > ends[0] && ends[0] > 0.0 && ends[0] < off {
                    (off, nearest) = (ends[0], Some(*branch));
                }
                falls = ends[1] < ends[0];
                *branch = next;
            }
        }
        if let Some(nearest) = nearest {
            add(found, self.held(&nearest, true)?);
        }
        Ok(())
    }

    /// The next point of a branch on the way to an amplitude; the step is shortened if the drive would change
    /// by much.
    fn next(&mut self, branch: &Branch, target: f64, halvings: u32) -> Result<Branch, Error> {
        let (mut amplitude, known) = (target, self.excess(&branch.motion));
        let mut motion = self.carried(amplitude, &branch.motion)?;
        for _ in 0..halvings {
            if (self.excess(&motion) - known).abs() <= JUMP * self.share {
                break;
            }
            amplitude = 0.5 * (branch.amplitude + amplitude);
            motion = self.carried(amplitude, &branch.motion)?;
        }
        Ok(Branch { amplitude, motion })
    }

    /// The amplitude between two at which the required drive equals the available one; `None` if the required
    /// drive jumps over it.
    fn root(&mut self, [from, to]: [&Branch; 2], ends: [f64; 2]) -> Result<Option<Branch>, Error> {
        let at = |place: f64| from.amplitude + (to.amplitude - from.amplitude) * place;
        let share = self.share;
        let (mut failure, repeats) = (None, Cell::new(true));
        let excess = |place: f64| {
            if place <= 0.0 || place >= 1.0 {
                return ends[usize::from(place >= 1.0)];
            }
            match self.carried(at(place), &from.motion) {
                Ok(motion) => {
                    repeats.set(motion.repeats);
                    self.excess(&motion)
                }
                Err(error) => {
                    failure = Some(error);
                    0.0
                }
            }
        };
        let place = find_root_regula_falsi(0.0, 1.0, excess, &mut Bracket { repeats: &repeats, share });
        if let Some(error) = failure {
            return Err(error);
        }
        let Ok(place) = place else { return Ok(None) };
        let amplitude = at(place);
        let motion = self.carried(amplitude, &from.motion)?;
        Ok((self.excess(&motion).abs() < NEAR * share).then_some(Branch { amplitude, motion }))
    }
}

/// The criterion by which a held amplitude counts as known.
struct Bracket<'a> {
    /// Whether the last motion repeats.
    repeats: &'a Cell<bool>,
    share: f64,
}

impl Convergency<f64> for Bracket<'_> {
    fn is_root_found(&mut self, excess: f64) -> bool {
        excess.abs() < self.share * FOUND[usize::from(!self.repeats.get())]
    }

    fn is_converged(&mut self, one: f64, other: f64) -> bool {
        (one - other).abs() < SAME[usize::from(!self.repeats.get())]
    }

    fn is_iteration_limit_reached(&mut self, steps: usize) -> bool {
        steps >= MOST_STEPS
    }
}
