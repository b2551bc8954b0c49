//! A disk on a compliant stator, whose vibration modes react to the impacts and to friction.
//!
//! The tip of the stator has the height s = sum of phi_j q_j and the angle beta = sum of psi_j q_j. Without a
//! disk the drive maintains the steady sine of [`motion`](crate::motion). The deviation r_j of a mode's
//! coordinate from that sine obeys
//!
//! ```text
//! r_j'' + d_j r_j' + f_j^2 r_j = -(h_j N + l_j T)
//! ```
//!
//! with the normal force N >= 0 and the torque T of friction on the disk. Between two events the motion is a
//! linear flow, so the first root of gap, force or slip is found with certainty. Impacts obey the law of
//! Routh and Stronge, which cannot create energy (docs/numerics-dynamics.md).
//!
//! ```
//! use bouncing_disk::System;
//! use bouncing_disk::driven::DrivenStart;
//! use bouncing_disk::core::Phase;
//! use bouncing_disk::stator::{StatorEngine, StatorSystem, YieldingMode};
//!
//! // The paper's motor, whose stator weighs ten times as much as the rotor and has a quality factor of 300.
//! let system = StatorSystem::new(System::motor().dimensionless(), &[YieldingMode::axial(10.0, 1.0, 300.0)])?;
//! let start = DrivenStart::Contact { phase: Phase::new(0.3)?, angular_speed: 0.0 };
//! for record in StatorEngine::new(system, start)?.take(20) {
//!     assert!(record?.relative_closure() < 1e-12);
//! }
//! # Ok::<(), bouncing_disk::Error>(())
//! ```

mod contact;
mod crossing;
mod energy;
mod engine;
mod flight;
mod impact;
mod linear_flow;
mod record;
mod regime;
#[cfg(test)]
mod tests;
mod vibration;
mod works;

use std::sync::Arc;

use bouncing_disk_core::numerics::elementary::sin_cos;
use bouncing_disk_drives::compliance::Compliance;

use crate::error::{Error, check, finite};
use crate::motion::state::{Mode, SlipDirection};
use crate::parameters::contact::ContactLaw;
use crate::parameters::dimensionless::DimensionlessSystem;
use crate::parameters::stator::{QUALITIES, QUALITIES_IN_WORDS};
use crate::parameters::system::System;

pub use crate::motion::stator_ledger::{MODES, StatorLedger};
pub use record::{StatorEngine, StatorRecord, StatorState};
use regime::{COS, ContactStiffness, DISPLACEMENTS, Regime, SIN, State, VELOCITIES};

/// Least and largest duration (rad) of an isolated impact on a compliant stator.
pub const CONTACT_TIMES: [f64; 2] = [1.0e-2, 1.0e4];

/// The largest share of the jamming friction that is accepted; closer to a jam, the motion is too fast for the
/// steps.
const NEAREST_JAM: f64 = 0.99;

/// The modes of motion of the disk, in the order in which their flows are stored.
const REGIMES: [Mode; 4] = [
    Mode::Flight,
    Mode::Sticking,
    Mode::Sliding(SlipDirection::Forward),
    Mode::Sliding(SlipDirection::Backward),
];

/// Range of mode frequencies, in units of the drive frequency.
const FREQUENCIES: [f64; 2] = [1.0e-3, 1.0e3];

/// A mode of the compliant stator, in dimensionless form.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct YieldingMode {
    /// Effective mass at the tip over the mass of the disk; for a mode that only twists, its inertia over the
    /// disk's moment of inertia. In [1e-6, 1e20].
    pub mass: f64,
    /// Resonance frequency over the drive frequency, in [1e-3, 1e3].
    pub frequency: f64,
    /// Quality factor, in [0.5, 1e5].
    pub quality: f64,
    /// Height of the tip per unit of the coordinate: 1, or 0 for a mode that only twists.
    pub height: f64,
    /// Angle of the tip per unit of the coordinate, in units of a_e/a_g^2 for a mode that moves in height; 1
    /// for a mode that only twists.
    pub angle: f64,
}

impl YieldingMode {
    /// A mode that moves in height only.
    #[must_use]
    pub const fn axial(mass: f64, frequency: f64, quality: f64) -> Self {
        Self { mass, frequency, quality, height: 1.0, angle: 0.0 }
    }

    /// A mode that twists only.
    #[must_use]
    pub const fn torsional(inertia: f64, frequency: f64, quality: f64) -> Self {
        Self { mass: inertia, frequency, quality, height: 0.0, angle: 1.0 }
    }
}

/// A linear piece of a load: torque + slope times the speed, between two speeds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LoadLine {
    /// Lower end; minus infinity for the first line.
    pub from: f64,
    /// Upper end; infinity for the last line.
    pub to: f64,
    /// Torque at speed 0, even if the piece does not reach that speed.
    pub torque: f64,
    /// Change of the torque per unit of speed.
    pub slope: f64,
}

/// The coefficients of a mode's equation of motion.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct ModeLaw {
    /// f^2 and d.
    pub(crate) stiffness: f64,
    pub(crate) damping: f64,
    /// phi and psi.
    pub(crate) height: f64,
    pub(crate) angle: f64,
    /// h and l.
    pub(crate) by_force: f64,
    pub(crate) by_torque: f64,
    /// Mass in the units of axial energy.
    pub(crate) weight: f64,
    /// Coefficients of the sine and the cosine of the phase in the steady motion of the coordinate without a
    /// disk.
    pub(crate) steady: [f64; 2],
}

/// A disk on a compliant stator, in dimensionless form; [`DimensionlessSystem`] is its counterpart on a
/// prescribed platform.
#[derive(Debug, Clone)]
pub struct StatorSystem {
    pub(crate) base: DimensionlessSystem,
    pub(crate) modes: [ModeLaw; MODES],
    /// Steady height and angle without a disk: coefficients of the sine and the cosine of the phase.
    pub(crate) height: [f64; 2],
    pub(crate) angle: [f64; 2],
    /// (a_e/a_g)^2: rotary energy in units of axial energy.
    pub(crate) arm: f64,
    pub(crate) contact: ContactStiffness,
    /// The pieces of the load by rising speed, and the flows on each of them.
    pub(crate) lines: Vec<LoadLine>,
    pub(crate) regimes: Arc<Vec<[Regime; 4]>>,
    given: Vec<YieldingMode>,
    contact_time: Option<f64>,
}

impl PartialEq for StatorSystem {
    fn eq(&self, other: &Self) -> bool {
        (self.base, self.arm, self.contact_time) == (other.base, other.arm, other.contact_time)
            && (&self.given, &self.lines) == (&other.given, &other.lines)
    }
}

impl StatorSystem {
    /// The system on a stator with these modes, at most two, whose steady motion without a disk is
    /// `system`'s. A motion without a mode is prescribed. Impacts are rigid, and the radii a_e and a_g are
    /// equal, which matters for modes that move in height and twist ([`Self::build`]).
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for numbers outside the ranges of [`YieldingMode`], more than [`MODES`] modes, a
    /// mode that moves neither in height nor in angle, two modes that move in height or two that twist, and
    /// friction so strong that a sliding disk could jam.
    pub fn new(system: &DimensionlessSystem, modes: &[YieldingMode]) -> Result<Self, Error> {
        Self::build(system, modes, 1.0, None)
    }

    /// Like [`Self::new`], with `arm` = (a_e/a_g)^2 and optional compliant contacts: an isolated impact on a
    /// rigid platform lasts `contact_time` (rad of the drive) and has the system's restitution.
    ///
    /// # Errors
    /// The errors of [`Self::new`]; for a contact time, also the errors of [`Compliance::new`], within
    /// [`CONTACT_TIMES`].
    pub fn build(
        system: &DimensionlessSystem,
        modes: &[YieldingMode],
        arm: f64,
        contact_time: Option<f64>,
    ) -> Result<Self, Error> {
        check(modes.len() <= MODES, "number of modes", modes.len() as f64, "[0, 2]")?;
        check((1.0e-6..=1.0e6).contains(&arm), "arm (a_e/a_g)^2", arm, "[1e-6, 1e6]")?;
        let [least, most] = FREQUENCIES;
        for mode in modes {
            check((1.0e-6..=1.0e20).contains(&mode.mass), "mass of a mode", mode.mass, "[1e-6, 1e20]")?;
            let range = "[1e-3, 1e3]";
            check((least..=most).contains(&mode.frequency), "frequency of a mode", mode.frequency, range)?;
            check(QUALITIES.contains(&mode.quality), "quality of a mode", mode.quality, QUALITIES_IN_WORDS)?;
            check(mode.angle.abs() <= 1.0e6, "angle of a mode", mode.angle, "[-1e6, 1e6]")?;
            let is_one = |value: f64| (value - 1.0).abs() <= 0.0;
            let pure = mode.height == 0.0 && is_one(mode.angle);
            check(is_one(mode.height) || pure, "height of a mode", mode.height, "1, or 0 if the angle is 1")?;
        }
        if let [one, other] = modes {
            let twice =
                (one.height != 0.0 && other.height != 0.0) || (one.angle != 0.0 && other.angle != 0.0);
            check(!twice, "number of modes that move the same way", 2.0, "[0, 1]")?;
        }
        let (sin, cos) = sin_cos(system.phase_lag());
        let (peak, twist) = (system.peak_acceleration(), system.twist_speed());
        let height = [peak, 0.0];
        // beta' = Q cos(tau + theta).
        let angle = [twist * cos, twist * sin];
        let mut laws = [ModeLaw::default(); MODES];
        for (law, mode) in laws.iter_mut().zip(modes) {
            let axial = mode.height != 0.0;
            *law = ModeLaw {
                stiffness: mode.frequency * mode.frequency,
                damping: mode.frequency / mode.quality,
                height: mode.height,
                angle: mode.angle,
                by_force: if axial { 1.0 / mode.mass } else { 0.0 },
                by_torque: if axial { arm * mode.angle / mode.mass } else { 1.0 / mode.mass },
                weight: if axial { mode.mass } else { arm * mode.mass },
                steady: if axial { height } else { angle },
            };
        }
        // One mode that moves in height and twists has one coordinate, so the steady angle is proportional to
        // the height.
        let angle = laws
            .iter()
            .find(|law| law.height != 0.0 && law.angle != 0.0)
            .map_or(angle, |law| [law.angle * height[0], law.angle * height[1]]);
        let contact = match contact_time {
            None => ContactStiffness::Rigid,
            Some(time) => {
                let [least, most] = CONTACT_TIMES;
                let compliance = Compliance::new(time, system.restitution())?;
                let share = 1.0 / laws.iter().fold(1.0, |sum, law| sum + law.height * law.by_force);
                let own = compliance.with_reduced_mass(share)?.contact_time();
                check(
                    (least..=most).contains(&own),
                    "contact time of an isolated impact on this stator",
                    own,
                    "[0.01, 1e4] (rad): below, use rigid impacts",
                )?;
                ContactStiffness::Soft { stiffness: compliance.stiffness(), damping: compliance.damping() }
            }
        };
        let mut built = Self {
            base: *system,
            modes: laws,
            height,
            angle,
            arm,
            contact,
            lines: vec![LoadLine {
                from: f64::NEG_INFINITY,
                to: f64::INFINITY,
                torque: system.load(),
                slope: 0.0,
            }],
            regimes: Arc::default(),
            given: modes.to_vec(),
            contact_time,
        };
        built.check_jam()?;
        built.regimes = built.moving();
        Ok(built)
    }

    fn moving(&self) -> Arc<Vec<[Regime; 4]>> {
        let regimes = |line| REGIMES.map(|mode| Regime::new(self, line, mode));
        Arc::new(self.lines.iter().map(regimes).collect())
    }

    /// This system with an additional load whose torque is continuous and piecewise linear in the speed.
    /// Torques and speeds are in the units of the system.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for pieces that leave gaps or do not meet, and for slopes outside [-1, 1e3].
    pub fn with_load(mut self, lines: &[LoadLine]) -> Result<Self, Error> {
        let mut reached = f64::NEG_INFINITY;
        for line in lines {
            let follows = line.from.total_cmp(&reached).is_eq() && line.to > line.from;
            check(follows, "start of a line of the load", line.from, "the end of the line before it")?;
            let slope = line.slope;
            check((-1.0..=1.0e3).contains(&slope), "slope of the load", slope, "[-1, 1e3] (dimensionless)")?;
            finite("torque of the load", line.torque)?;
            reached = line.to;
        }
        for pair in lines.windows(2) {
            let [here, there] = [pair[0], pair[1]].map(|line| line.torque + line.slope * pair[1].from);
            // Each torque at speed 0 has a rounding error proportional to the torques at the ends of its
            // piece.
            let size = |line: &LoadLine| {
                let ends = [line.from, line.to].into_iter().filter(|end| end.is_finite());
                line.torque.abs() + ends.map(|end| (line.slope * end).abs()).fold(0.0, f64::max)
            };
            let size = size(&pair[0]) + size(&pair[1]);
            check(
                (here - there).abs() <= 1.0e-9 * size,
                "jump of the load",
                there - here,
                "0, because adjacent lines must meet",
            )?;
        }
        check(reached == f64::INFINITY, "end of the load", reached, "infinity")?;
        let constant = self.base.load();
        self.lines = lines.iter().map(|line| LoadLine { torque: line.torque + constant, ..*line }).collect();
        self.regimes = self.moving();
        Ok(self)
    }

    /// The same stator with another disk, load or steady motion.
    pub(crate) fn with_base(&self, base: &DimensionlessSystem) -> Result<Self, Error> {
        Self::build(base, &self.given, self.arm, self.contact_time)?.with_load(&self.law())
    }

    /// The additional load if it does not depend on the speed.
    pub(crate) fn constant_law(&self) -> Option<f64> {
        let first = self.lines[0];
        let varies = self
            .lines
            .iter()
            .any(|line| line.slope != 0.0 || line.torque.to_bits() != first.torque.to_bits());
        (!varies).then(|| first.torque - self.base.load())
    }

    /// Whether the stator has modes.
    pub(crate) const fn yields(&self) -> bool {
        !self.given.is_empty()
    }

    /// Whether a mode twists, so that friction acts back on it.
    pub(crate) fn twists(&self) -> bool {
        self.given.iter().any(|mode| mode.angle != 0.0)
    }

    /// The longest time (rad) in which an amplitude falls by a factor e without a disk; zero without modes.
    pub(crate) fn decay_time(&self) -> f64 {
        let times = self.given.iter().zip(&self.modes).map(|(_, mode)| 2.0 / mode.damping);
        times.fold(0.0, f64::max)
    }

    /// Mass over the disk's, times quality, of the mode that moves in height: the disk needs about this many
    /// radians to change the amplitude by its weight. Zero without such a mode.
    pub(crate) fn ringing(&self) -> f64 {
        let axial = self.given.iter().find(|mode| mode.height != 0.0);
        axial.map_or(0.0, |mode| mode.mass * mode.quality)
    }

    /// Duration (rad) of an isolated contact on a rigid platform.
    pub(crate) const fn contact_time(&self) -> Option<f64> {
        self.contact_time
    }

    /// Duration (rad) of an isolated impact on this stator, and the share of the speed that it preserves;
    /// `None` for rigid impacts.
    pub(crate) fn isolated_contact(&self) -> Option<[f64; 2]> {
        let compliance = Compliance::new(self.contact_time?, self.base.restitution()).ok()?;
        let own = compliance.with_reduced_mass(1.0 / self.mobility()[0][0]).ok()?;
        Some([own.contact_time(), own.restitution()])
    }

    /// The pieces of the additional load.
    pub(crate) fn law(&self) -> Vec<LoadLine> {
        let constant = self.base.load();
        self.lines.iter().map(|line| LoadLine { torque: line.torque - constant, ..*line }).collect()
    }

    /// The same stator without the additional load.
    pub(crate) fn without_law(&self) -> Result<Self, Error> {
        let line = LoadLine { from: f64::NEG_INFINITY, to: f64::INFINITY, torque: 0.0, slope: 0.0 };
        self.clone().with_load(&[line])
    }

    /// Indentation of a contact by the preload alone.
    pub(crate) const fn compression(&self) -> f64 {
        match self.contact {
            ContactStiffness::Rigid => 0.0,
            ContactStiffness::Soft { stiffness, .. } => 1.0 / stiffness,
        }
    }

    /// Whether contacts are compliant.
    pub(crate) const fn takes_time(&self) -> bool {
        self.contact_time.is_some()
    }

    /// The amplitude of a mode whose damping loses this energy in a time (rad), as if it moved sinusoidally
    /// at the drive frequency.
    pub(crate) fn amplitude(&self, mode: usize, loss: f64, time: f64) -> f64 {
        let ModeLaw { weight, damping, .. } = self.modes[mode];
        (2.0 * loss / (weight * damping * time)).sqrt()
    }

    /// The system of a disk of this mass (kg) on the stator of `system`.
    ///
    /// # Errors
    /// The errors of [`Self::build`]; [`Error::BothGiven`] for a contact with hysteresis.
    pub fn of_system(system: &System, mass: f64) -> Result<Self, Error> {
        let (disk, omega) = (system.disk(), system.platform().angular_frequency());
        let gyration = disk.gyration_radius();
        let turn = gyration * gyration / disk.contact_radius();
        let modes: Vec<_> = system
            .stator()
            .iter()
            .flat_map(|stator| stator.modes().to_vec())
            .map(|mode| YieldingMode {
                mass: if mode.height == 0.0 {
                    mode.mass / (mass * gyration * gyration)
                } else {
                    mode.mass / mass
                },
                frequency: mode.angular_frequency / omega,
                quality: mode.quality,
                height: mode.height,
                angle: if mode.height == 0.0 { mode.angle } else { mode.angle * turn },
            })
            .collect();
        let contact_time = match system.soft_contact() {
            None => None,
            Some((ContactLaw::Damper, time)) => Some(time * omega),
            Some((ContactLaw::Hysteresis, _)) => {
                return Err(Error::BothGiven { one: "stator", other: "contact.law" });
            }
        };
        let arm = disk.contact_radius() / gyration;
        Self::build(system.dimensionless(), &modes, arm * arm, contact_time)
    }

    /// The mobility matrix: relative speeds per unit of the impulses P and T, [[w by P, w by T], [u by P, u
    /// by T]].
    pub(crate) fn mobility(&self) -> [[f64; 2]; 2] {
        let mut b = [[1.0, 0.0], [0.0, 1.0]];
        for mode in &self.modes {
            b[0][0] += mode.height * mode.by_force;
            b[0][1] += mode.height * mode.by_torque;
            b[1][0] += mode.angle * mode.by_force;
            b[1][1] += mode.angle * mode.by_torque;
        }
        b
    }

    /// Rejects friction so strong that the force it causes could stop the disk (Painleve's paradox).
    fn check_jam(&self) -> Result<(), Error> {
        let b = self.mobility();
        let (friction, own) = (self.base.friction() * b[0][1].abs(), b[0][0]);
        check(
            friction <= NEAREST_JAM * own,
            "friction",
            self.base.friction(),
            "below the friction that jams a disk sliding on this stator",
        )?;
        Ok(())
    }

    /// The system on a rigid stator.
    #[must_use]
    pub const fn base(&self) -> &DimensionlessSystem {
        &self.base
    }

    /// Steady coordinate and speed of a mode without a disk, at a phase with this sine and cosine.
    pub(crate) fn steady(&self, mode: usize, (sin, cos): (f64, f64)) -> [f64; 2] {
        let [a, b] = self.modes[mode].steady;
        [a * sin + b * cos, a * cos - b * sin]
    }

    /// Height and velocity of the tip.
    pub(crate) fn tip(&self, state: &State) -> [f64; 2] {
        self.moved(self.height, |mode| mode.height, state)
    }

    /// Angle and angular speed of the tip.
    pub(crate) fn twist(&self, state: &State) -> [f64; 2] {
        self.moved(self.angle, |mode| mode.angle, state)
    }

    fn moved(&self, [a, b]: [f64; 2], share: impl Fn(&ModeLaw) -> f64, state: &State) -> [f64; 2] {
        let (sin, cos) = (state[SIN], state[COS]);
        let (mut place, mut speed) = (a * sin + b * cos, a * cos - b * sin);
        for (index, mode) in self.modes.iter().enumerate() {
            place += share(mode) * state[DISPLACEMENTS[index]];
            speed += share(mode) * state[VELOCITIES[index]];
        }
        [place, speed]
    }
}
