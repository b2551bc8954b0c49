//! One member of an ensemble: a vertical motion and all rotors on it, in windows of time.
//!
//! Let a compliant stator have the mass M (in units of the disk's) and the quality Q. A quarter of the
//! members start with the stator at rest; they decide the first branch. Another quarter start with the
//! stator's motion without a rotor, and half start at held amplitudes. If M Q exceeds 1e5, a stator at rest
//! would ring for the whole run, so members from rest start at the lowest held amplitude instead. If Q also
//! exceeds 5e4, all members start at held amplitudes. Windows last at least 1.5 Q radians, so that the
//! omitted start-up is three times as long as the slowest decay of an amplitude by a factor e. Above Q = 5e4
//! they last at least 0.45 Q.

use std::f64::consts::TAU;
use std::ops::RangeInclusive;

use bouncing_disk_core::Phase;
use bouncing_disk_core::numerics::random::SplitMix64;
use bouncing_disk_core::run::WorkCount;
use bouncing_disk_core::sweep::{InstructionSet, LaneRunner};

use crate::error::Error;
use crate::motion::phase_time::PhaseTime;
use crate::motion::state::{DiskState, Mode};
use crate::motor::batch::members::{golden_share, starting_phase};
use crate::motor::operation::coupled::Coupled;
use crate::motor::operation::settings::OperatingSettings;
use crate::motor::stator::Stator;
use crate::motor::tape::cycle::Cycle;
use crate::motor::tape::held::{DiskStart, Held, held_amplitudes};
use crate::motor::tape::left::Left;
use crate::motor::tape::recurrence::{Key, Repeats};
use crate::motor::tape::source::Source;
use crate::motor::tape::taped::{Taped, resolution};
use crate::motor::tape::window::Window;
use crate::parameters::dimensionless::DimensionlessSystem;
use crate::stator::{MODES, StatorState};

/// An angular speed above which no rotor under a braking load rises or remains: the platform's largest speed
/// plus the loss of speed by friction in a period. Zero without friction, because a rotor then keeps the
/// speed with which it starts.
pub(crate) fn far_above(system: &DimensionlessSystem) -> f64 {
    far_from(system, 1.0)
}

/// The same for a rotor with `quicker` times less inertia.
fn far_from(system: &DimensionlessSystem, quicker: f64) -> f64 {
    let friction = quicker * system.friction();
    if friction > 0.0 { system.twist_speed() + TAU * friction } else { 0.0 }
}

/// Ratio of inertias by which the effect of a reduced inertia is estimated.
const TWICE: f64 = 2.0;

/// Largest speed with which members are thrown, in units of the platform's largest speed.
const MOST_THROWN: f64 = 3.0;

/// Whether a member starts with a throw or at a held amplitude, as every second member does if this may
/// affect the outcome; the others start from rest.
pub(crate) const fn is_thrown(index: usize) -> bool {
    index % 2 == 1
}

/// The root of ten.
const HALF_DECADE: f64 = 3.162_277_660_168_379_5;

/// Of every four members, one has a smaller and one a larger perturbation, at the two ends of a decade; this
/// shows the effect of its size. Returns the number of the size for this index: 0 for the size in the
/// settings, 1 for the smaller and 2 for the larger one.
pub(crate) const fn size_of_perturbation(index: usize) -> usize {
    (index % 4).saturating_sub(1)
}

/// Smallest number of members for perturbations of several sizes; with fewer members, all use the
/// perturbation of the settings, because the scatter at each size would be unknown.
pub(crate) const LEAST_FOR_DECADE: usize = 8;

/// The factor by which the perturbation differs from the settings.
fn of_decade(index: usize) -> f64 {
    [1.0, 1.0 / HALF_DECADE, HALF_DECADE][size_of_perturbation(index)]
}

/// The speed with which the disk of the member with this index is thrown, in units of the platform's largest
/// speed; `None` for a start from rest.
pub(crate) fn thrown(index: usize) -> Option<f64> {
    is_thrown(index).then(|| MOST_THROWN * golden_share(index))
}

/// Largest product of mass ratio and ringing time of a stator at which runs start from rest; beyond it, a run
/// takes too long to settle.
const SLOWEST: f64 = 1.0e5;

/// Longest decay time (rad, by a factor e) of an amplitude that is left to ring down.
pub(crate) const LONGEST_DECAY: f64 = 1.0e5;

/// Mass ratio of stator and disk above which a flight changes the amplitude by less than the stated error.
const HEAVY: f64 = 100.0;

/// The starts of members on a compliant stator.
#[derive(Debug, Clone, Default)]
pub(crate) struct Starts {
    yields: bool,
    /// The stable held amplitudes.
    held: Vec<Held>,
    /// Whether no member starts on a stator at rest or away from the motion of a held amplitude.
    slow: bool,
    rings: bool,
    /// Whether no member starts with the stator's motion without a rotor, because leaving this motion would
    /// take too long.
    slowest: bool,
    /// Indentation of a contact by the preload.
    compression: f64,
}

impl Starts {
    /// The starts for this stator; empty if the stator is rigid. If friction acts back on the stator, there
    /// are no held amplitudes.
    pub(crate) fn new(
        stator: &Stator,
        settings: &OperatingSettings,
        work: &mut WorkCount<'_>,
    ) -> Result<Self, Error> {
        let Some(system) = stator.yielded().filter(|own| own.yields()) else { return Ok(Self::default()) };
        let compression = system.compression();
        if system.twists() {
            return Ok(Self { yields: true, compression, ..Self::default() });
        }
        let perturbation = (settings.relaunch_perturbation, settings.seed);
        let mut held = held_amplitudes(system, perturbation, work)?;
        held.retain(|own| own.is_stable);
        let slow = system.ringing() > SLOWEST;
        let rings = slow && system.modes[0].weight < HEAVY;
        let slowest = slow && system.decay_time() > LONGEST_DECAY;
        Ok(Self { yields: true, held, slow, rings, slowest, compression })
    }

    /// Whether members start on different amplitudes.
    pub(crate) const fn has_many(&self) -> bool {
        self.held.len() > 1
    }

    /// The largest acceleration (g) at a held amplitude: a disk slows the stator down to such an amplitude.
    pub(crate) fn largest(&self) -> Option<f64> {
        self.held.iter().map(|own| own.amplitude).reduce(f64::max)
    }

    /// Whether the member with this index starts with rotor and stator at rest, or at the lowest held
    /// amplitude, which a start from rest reaches.
    pub(crate) const fn is_from_rest(&self, index: usize) -> bool {
        !is_thrown(index) && (index.is_multiple_of(4) || !self.yields || self.slowest)
    }

    /// The start of the member with this index and phase. Every second member starts at one of the held
    /// amplitudes in turn, on the motion that belongs to it or thrown up. Half of the others start with the
    /// stator at rest; if settling from rest takes too long, they start at the lowest held amplitude, which a
    /// run from rest also reaches. The other half start with the stator's motion without a rotor, unless
    /// leaving this motion takes too long.
    pub(crate) fn of(&self, index: usize, phase: Phase) -> Option<(PhaseTime, StatorState)> {
        let (count, share) = (self.held.len(), golden_share(index));
        let (turn, disk) = match (is_thrown(index), index / 2 / count.max(1) % 2) {
            (true, 1) => (index / 2 % count.max(1), DiskStart::Thrown(phase, MOST_THROWN * share)),
            (true, _) => (index / 2 % count.max(1), DiskStart::OnMotion(share)),
            (false, _) if index % 4 == 2 && !self.slowest || !self.yields => return None,
            (false, _) if self.slow && count > 0 => (0, DiskStart::AtRest(phase)),
            (false, _) => return Some(at_rest(phase, self.compression)),
        };
        let disk = if self.rings { DiskStart::OnMotion(share) } else { disk };
        self.held.get(turn).map(|held| held.start(disk))
    }
}

/// A disk that lies on a stator at rest.
fn at_rest(phase: Phase, compression: f64) -> (PhaseTime, StatorState) {
    let mut disk = DiskState::flying(-compression, 0.0, 0.0);
    disk.mode = Mode::Sticking;
    (PhaseTime::in_first_period(phase), StatorState { disk, modes: [[0.0; 2]; MODES] })
}

/// A member of the ensemble, with its own starting phase and stream of random numbers.
#[derive(Debug)]
pub(crate) enum Member {
    /// Rotors on the tape of a vertical motion.
    Taped(Box<Taped>),
    /// A rotor that acts back on its stator.
    Coupled(Box<Coupled>),
}

impl Member {
    /// The member with this `index` among the number of members in `settings`. Each of the first `bracketed`
    /// systems has two rotors: one starts far below all steady speeds, and one equally far above. The rotors
    /// from above are listed after the first rotors of all systems. Each of the other systems has one rotor,
    /// which starts at rest. The stators of the systems are all of one kind. A rotor on a tape has `quicker`
    /// times less inertia than its motor; if any inertia is reduced, each of the first systems has a third
    /// rotor with half of its reduced inertia.
    pub(crate) fn new(
        systems: &[DimensionlessSystem],
        stators: &[Stator],
        bracketed: usize,
        index: usize,
        quicker: &[f64],
        from: Option<&Source>,
        settings: &OperatingSettings,
    ) -> Result<Self, Error> {
        let phase = starting_phase(settings.seed, index, settings.members)?;
        let seed = SplitMix64::seed_of_stream(settings.seed, index as u64);
        let factor = if settings.members >= LEAST_FOR_DECADE { of_decade(index) } else { 1.0 };
        let perturbation = (settings.relaunch_perturbation * factor, seed);
        if let Stator::Yielding(system) = &stators[0]
            && stators[0].acts_back()
        {
            // The speed cannot be bracketed, as each rotor has its own vertical motion.
            let speed = if is_thrown(index) { far_above(&systems[0]) } else { 0.0 };
            return Ok(Self::Coupled(Box::new(Coupled::new(system, phase, speed, perturbation)?)));
        }
        let far = |own: usize| far_from(&systems[own], quicker[own]);
        let from_below = |own| (own, if own < bracketed { -far(own) } else { 0.0 }, quicker[own]);
        let from_above = |own| (own, far(own), quicker[own]);
        let mut starts: Vec<(usize, f64, f64)> =
            (0..systems.len()).map(from_below).chain((0..bracketed).map(from_above)).collect();
        if quicker.iter().any(|quicker| *quicker > 1.0) {
            starts.extend((0..bracketed).map(|own| (own, 0.0, TWICE * quicker[own])));
        }
        let source = match from {
            Some(source) => source.clone(),
            None => Source::new(&stators[0], &systems[0], (phase, None), perturbation)?,
        };
        let rotor = |&(motor, speed, quicker): &(usize, f64, f64)| {
            (stators[motor].rotor(&systems[motor]), speed, quicker)
        };
        Ok(Self::Taped(Box::new(Taped::new(
            source,
            resolution(settings.relative_error),
            starts.iter().map(rotor),
        ))))
    }

    /// The same member, on a motion that is known to repeat.
    pub(crate) fn on(self, repeats: Repeats) -> Self {
        match self {
            Self::Taped(member) => Self::Taped(Box::new(member.on(repeats))),
            Self::Coupled(_) => self,
        }
    }

    /// The cycle that the member was found to repeat.
    pub(crate) const fn repeats(&self) -> Option<Repeats> {
        match self {
            Self::Taped(member) => member.repeats(),
            Self::Coupled(member) => member.repeats(),
        }
    }

    /// Registers cycles with these touches that other members have reached.
    pub(crate) fn know(&mut self, cycles: &[&[Key]]) {
        match self {
            Self::Taped(member) => member.know(cycles),
            Self::Coupled(member) => member.know(cycles),
        }
    }

    /// The cycle that the motion repeats, if one was found.
    pub(crate) fn cycle(&mut self, work: &mut WorkCount<'_>) -> Result<Option<Cycle>, Error> {
        match self {
            Self::Taped(member) => member.cycle(work),
            Self::Coupled(member) => member.cycle(work),
        }
    }

    /// The motion of this member's rotors, in their order, in a cycle; their speeds lie within the limits
    /// `largest`.
    pub(crate) fn on_cycle(&self, cycle: &Cycle, largest: &[f64]) -> [Window; 2] {
        match self {
            Self::Taped(member) => member.on_cycle(cycle, largest),
            Self::Coupled(_) => cycle.windows(&[], &[], largest, &LaneRunner::new(InstructionSet::best())),
        }
    }

    /// The time (rad) for which the member was followed.
    pub(crate) fn followed(&self) -> f64 {
        match self {
            Self::Taped(member) => member.followed,
            Self::Coupled(member) => member.followed(),
        }
    }

    /// The state of the disk and of a compliant stator.
    pub(crate) fn left(&self) -> Option<Left> {
        match self {
            Self::Taped(member) => member.left(),
            Self::Coupled(member) => Some(member.left()),
        }
    }

    /// Continues from a state of disk and stator, such as the final state of another member; rotors on a tape
    /// keep their speeds.
    pub(crate) fn go_on_from(&mut self, (time, state): (PhaseTime, StatorState)) -> Result<(), Error> {
        match self {
            Self::Taped(member) => member.go_on_from(time, state),
            Self::Coupled(member) => member.go_on_from(time, state),
        }
    }

    /// Starts from a state of disk and stator, with the rotors at their present speeds.
    pub(crate) fn set_off(&mut self, (time, mut state): (PhaseTime, StatorState)) -> Result<(), Error> {
        if let Self::Coupled(member) = self {
            state.disk.angular_speed = member.angular_speed();
        }
        self.go_on_from((time, state))
    }

    /// The next window, up to the end of an event. It lasts for at least `duration` rad, but the number of
    /// its impacts stays within `impacts`. For rotors that never bounce, periods count instead of impacts.
    pub(crate) fn next_window(
        &mut self,
        duration: f64,
        impacts: RangeInclusive<u64>,
        work: &mut WorkCount<'_>,
    ) -> Result<Window, Error> {
        match self {
            Self::Taped(member) => member.next_window(duration, &impacts, work),
            Self::Coupled(member) => member.next_window(duration, &impacts, work),
        }
    }
}

#[cfg(test)]
mod tests;
