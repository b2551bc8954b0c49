//! One member of an ensemble: a vertical motion with all rotors on it, in windows of time.

use std::f64::consts::TAU;
use std::ops::RangeInclusive;

use bouncing_disk_core::numerics::random::SplitMix64;
use bouncing_disk_core::run::WorkCount;

use crate::error::Error;
use crate::motor::batch::members::starting_phase;
use crate::motor::operation::followed::Followed;
use crate::motor::operation::settings::OperatingSettings;
use crate::motor::stator::Stator;
use crate::motor::tape::source::Source;
use crate::motor::tape::taped::Taped;
use crate::motor::tape::window::Window;
use crate::parameters::dimensionless::DimensionlessSystem;
use crate::stator::StatorEngine;

/// An angular speed above which no rotor under a braking load stays, nor comes to: that of the platform, and
/// what friction brakes in a period. Without friction a rotor keeps its speed, and starts at rest.
pub(crate) fn far_above(system: &DimensionlessSystem) -> f64 {
    let friction = system.friction();
    if friction > 0.0 { system.twist_speed() + TAU * friction } else { 0.0 }
}

/// Members are thrown up as fast as the platform moves at most, times this.
const MOST_THROWN: f64 = 3.0;

/// Every second member starts with a throw where that may decide what becomes of it; the others start from rest.
pub(crate) const fn is_thrown(index: usize) -> bool {
    index % 2 == 1
}

/// Numbers that fill (0, 1) evenly.
fn golden_share(index: usize) -> f64 {
    (index as f64 * 0.618_033_988_749_894_8).fract()
}

/// A member of the ensemble: it starts at a phase and with a stream of random numbers of its own.
#[derive(Debug)]
pub(crate) enum Member {
    /// Rotors on the tape of a vertical motion.
    Taped(Box<Taped>),
    /// Each rotor acts back on its stator.
    Yielding(Box<Followed<StatorEngine>>),
}

impl Member {
    /// The member of this `index` among so many as `settings` says. The first `bracketed` of the systems have
    /// two rotors, one from far below all steady speeds and one, behind those of all systems, from as far
    /// above; the others start at rest. Each system has its stator, all of one kind.
    pub(crate) fn new(
        systems: &[DimensionlessSystem],
        stators: &[Stator],
        bracketed: usize,
        index: usize,
        settings: &OperatingSettings,
    ) -> Result<Self, Error> {
        let phase = starting_phase(settings.seed, index, settings.members)?;
        let seed = SplitMix64::seed_of_stream(settings.seed, index as u64);
        let perturbation = (settings.relaunch_perturbation, seed);
        let from_below = |own| (own, if own < bracketed { -far_above(&systems[own]) } else { 0.0 });
        let from_above = |own| (own, far_above(&systems[own]));
        let starts: Vec<(usize, f64)> =
            (0..systems.len()).map(from_below).chain((0..bracketed).map(from_above)).collect();
        let thrown = is_thrown(index).then(|| MOST_THROWN * golden_share(index));
        if let Some(source) = Source::new(&stators[0], &systems[0], (phase, thrown), perturbation)? {
            let rotor = |&(motor, speed): &(usize, f64)| (stators[motor].rotor(&systems[motor]), speed);
            return Ok(Self::Taped(Box::new(Taped::new(source, starts.iter().map(rotor)))));
        }
        let own = |&(motor, speed): &(usize, f64)| Some((stators[motor].yielded()?, speed));
        Ok(Self::Yielding(Box::new(Followed::on_yielding(
            starts.iter().filter_map(own),
            phase,
            perturbation,
        )?)))
    }

    /// Whether its motion was found to repeat itself.
    pub(crate) const fn repeats(&self) -> bool {
        match self {
            Self::Taped(member) => member.repeats(),
            Self::Yielding(_) => false,
        }
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
            Self::Yielding(member) => member.general_window(duration, &impacts, true, work),
        }
    }
}
