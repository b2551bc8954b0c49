//! One member of an ensemble: a vertical motion with all rotors on it, in windows of time.

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

/// An angular speed above which no rotor under a braking load stays, nor comes to: that of the platform, and
/// what friction brakes in a period. Without friction a rotor keeps its speed, and starts at rest.
pub(crate) fn far_above(system: &DimensionlessSystem) -> f64 {
    far_from(system, 1.0)
}

/// The same of a rotor with so many times less inertia.
fn far_from(system: &DimensionlessSystem, quicker: f64) -> f64 {
    let friction = quicker * system.friction();
    if friction > 0.0 { system.twist_speed() + TAU * friction } else { 0.0 }
}

/// A rotor with so many times less inertia than another one shows how much less that one has matters.
const TWICE: f64 = 2.0;

/// Members are thrown up as fast as the platform moves at most, times this.
const MOST_THROWN: f64 = 3.0;

/// Every second member starts with a throw or on a held amplitude where that may decide what becomes of it; the others
/// start from rest.
pub(crate) const fn is_thrown(index: usize) -> bool {
    index % 2 == 1
}

/// The root of ten.
const HALF_DECADE: f64 = 3.162_277_660_168_379_5;

/// Of four members one has a smaller and one a larger perturbation, at either end of a decade: they show what its size
/// does. The size of this index: 0 for that of the settings, 1 and 2 for the others.
pub(crate) const fn size_of_perturbation(index: usize) -> usize {
    (index % 4).saturating_sub(1)
}

/// With fewer members all have the perturbation of the settings: the scatter at one size would not be known.
pub(crate) const LEAST_FOR_DECADE: usize = 8;

/// Its factor.
fn of_decade(index: usize) -> f64 {
    [1.0, 1.0 / HALF_DECADE, HALF_DECADE][size_of_perturbation(index)]
}

/// How fast the disk of this index is thrown up, in units of the platform's largest speed; not at all of one that starts
/// from rest.
pub(crate) fn thrown(index: usize) -> Option<f64> {
    is_thrown(index).then(|| MOST_THROWN * golden_share(index))
}

/// With so many times the disk's mass for each radian that the stator rings, a run from rest takes too long to settle.
const SLOWEST: f64 = 1.0e5;

/// A stator whose amplitude takes longer (rad) to fall by a factor e is not left alone to do so.
pub(crate) const LONGEST_DECAY: f64 = 1.0e5;

/// Of a stator with so many times the disk's mass a flight changes the amplitude by less than is stated.
const HEAVY: f64 = 100.0;

/// Where members start on a stator that yields.
#[derive(Debug, Clone, Default)]
pub(crate) struct Starts {
    yields: bool,
    /// The stable held amplitudes.
    held: Vec<Held>,
    /// Whether no member starts on a stator at rest, and whether none starts off the motion of a held amplitude.
    slow: bool,
    rings: bool,
    /// Whether none starts where the stator is without a rotor: it takes too long to leave that.
    slowest: bool,
    /// How far a contact is pressed in by the preload.
    compression: f64,
}

impl Starts {
    /// Of this stator; none where it does not yield. Where friction acts back on it no amplitude is held.
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

    /// The largest acceleration (g) on a held amplitude: a disk slows the stator down to them.
    pub(crate) fn largest(&self) -> Option<f64> {
        self.held.iter().map(|own| own.amplitude).reduce(f64::max)
    }

    /// Whether the member of this index starts with rotor and stator at rest, or on the lowest held amplitude, to which that
    /// comes.
    pub(crate) const fn is_from_rest(&self, index: usize) -> bool {
        !is_thrown(index) && (index.is_multiple_of(4) || !self.yields || self.slowest)
    }

    /// Where the member of this index and phase starts. Every second one is on each held amplitude in turn, on its motion
    /// or thrown up. Of the others one half starts with the stator at rest, or where it takes too long to settle from there
    /// on the lowest amplitude, to which a run from rest comes, too; the other half with the stator as it moves without a
    /// rotor, unless that takes too long to leave.
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

/// A member of the ensemble: it starts at a phase and with a stream of random numbers of its own.
#[derive(Debug)]
pub(crate) enum Member {
    /// Rotors on the tape of a vertical motion.
    Taped(Box<Taped>),
    /// A rotor that acts back on its stator.
    Coupled(Box<Coupled>),
}

impl Member {
    /// The member of this `index` among so many as `settings` says. The first `bracketed` of the systems have
    /// two rotors, one from far below all steady speeds and one, behind those of all systems, from as far
    /// above; the others start at rest. Each system has its stator, all of one kind. A rotor on a tape has so many times
    /// less inertia than its motor (`quicker`); if some have, a third rotor of each of the first systems has half of
    /// that.
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
            // No bound from both sides: each rotor has a vertical motion of its own.
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

    /// The same on a motion that is known to repeat itself.
    pub(crate) fn on(self, repeats: Repeats) -> Self {
        match self {
            Self::Taped(member) => Self::Taped(Box::new(member.on(repeats))),
            Self::Coupled(_) => self,
        }
    }

    /// What its motion was found to repeat.
    pub(crate) const fn repeats(&self) -> Option<Repeats> {
        match self {
            Self::Taped(member) => member.repeats(),
            Self::Coupled(member) => member.repeats(),
        }
    }

    /// Other members have come to cycles with these touches.
    pub(crate) fn know(&mut self, cycles: &[&[Key]]) {
        match self {
            Self::Taped(member) => member.know(cycles),
            Self::Coupled(member) => member.know(cycles),
        }
    }

    /// The cycle that its motion repeats, if it was found to do so.
    pub(crate) fn cycle(&mut self, work: &mut WorkCount<'_>) -> Result<Option<Cycle>, Error> {
        match self {
            Self::Taped(member) => member.cycle(work),
            Self::Coupled(member) => member.cycle(work),
        }
    }

    /// The rotors of a cycle in the order of this member's, whose speeds lie within these sizes.
    pub(crate) fn on_cycle(&self, cycle: &Cycle, largest: &[f64]) -> [Window; 2] {
        match self {
            Self::Taped(member) => member.on_cycle(cycle, largest),
            Self::Coupled(_) => cycle.windows(&[], &[], largest, &LaneRunner::new(InstructionSet::best())),
        }
    }

    /// How long (rad) it was followed.
    pub(crate) fn followed(&self) -> f64 {
        match self {
            Self::Taped(member) => member.followed,
            Self::Coupled(member) => member.followed(),
        }
    }

    /// Where the disk and a stator that yields are.
    pub(crate) fn left(&self) -> Option<Left> {
        match self {
            Self::Taped(member) => member.left(),
            Self::Coupled(member) => Some(member.left()),
        }
    }

    /// Goes on from a state of disk and stator, such as another member was left in; rotors on a tape keep their speeds.
    pub(crate) fn go_on_from(&mut self, (time, state): (PhaseTime, StatorState)) -> Result<(), Error> {
        match self {
            Self::Taped(member) => member.go_on_from(time, state),
            Self::Coupled(member) => member.go_on_from(time, state),
        }
    }

    /// Starts from a state of disk and stator, with its rotors at the speeds that they have.
    pub(crate) fn set_off(&mut self, (time, mut state): (PhaseTime, StatorState)) -> Result<(), Error> {
        if let Self::Coupled(member) = self {
            state.disk.angular_speed = member.angular_speed();
        }
        self.go_on_from((time, state))
    }

    /// The next window: of `duration` rad at least, and of a number of impacts in a range, whatever the
    /// duration; up to the end of an event. Rotors that never bounce have periods instead of impacts.
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
