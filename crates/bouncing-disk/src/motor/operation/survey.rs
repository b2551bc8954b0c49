//! The vertical motions that coexist on a rigid stator, and how long irregular ones last.
//!
//! Only the disk is followed, so a thousand contacts take a millisecond. It starts from rest or from throws,
//! and is followed until the motion repeats or the longest run ends. All loads, lags and rotors share the
//! result. For compliant contacts there are 8 starts from rest and 8 throws with up to three times the
//! platform's largest speed. For rigid impacts there are 16 throws, because a disk that comes to rest
//! continues like one that starts from rest. A run is limited to 20,000 touches on a sine with compliant
//! contacts, which are computed in closed form, and to 2,000 otherwise. The life of an irregular motion is
//! counted from touch 256 to the last touch more than 5 % away from the final cycle. With compliant contacts
//! further throws follow, 16 at a time, until 64 irregular motions have ended, none of at least 16 has ended,
//! or 600,000 touches or 256 starts are spent. Rigid impacts on a stator with kinks are not surveyed.

use std::f64::consts::TAU;

use bouncing_disk_core::Phase;
use bouncing_disk_core::run::{Watch, WorkCount, in_parallel};

use crate::error::Error;
use crate::motor::batch::members::{golden_share, turn_of_seed};
use crate::motor::operation::member::{is_thrown, thrown};
use crate::motor::stator::Stator;
use crate::motor::tape::Tape;
use crate::motor::tape::cycle::Cycle;
use crate::motor::tape::recurrence::{Key, Recurrence, Repeats, Touch};
use crate::motor::tape::source::Source;
use crate::parameters::dimensionless::DimensionlessSystem;

/// Number of starts that are followed together, and their largest total number.
const STARTS: usize = 16;
const MOST_STARTS: usize = 16 * STARTS;

/// Number of ended irregular motions after which their mean life is known well enough. Until then further
/// starts follow, as long as all starts together have had fewer touches than the second number.
const ENOUGH_ENDS: u64 = 64;
const MOST_TOUCHES: u64 = 600_000;

/// A start whose motion repeats before this number of touches was already on its way to the cycle.
const SETTLED: u64 = 256;

/// Largest number of steps of a motion per touch.
const STEPS_OF_TOUCH: u64 = 8;

/// Touches after which the state is stored.
const MARK: u64 = 16;

/// Largest number of states per start from which a rotor may continue.
const MOST_STATES: usize = 16;

/// Largest number of touches after a start that is followed in closed form, and after a start that an engine
/// follows or with rigid impacts.
const LONGEST: u64 = 20_000;
const SHORTEST: u64 = 2_000;

/// The motions of a disk on a stator.
#[derive(Debug)]
pub(crate) struct Survey {
    pub(crate) cycles: Vec<Surveyed>,
    /// States in irregular motions, beginning with one of each; `None` for rigid impacts, for which rotors
    /// start from rest.
    pub(crate) irregular: Option<Vec<Source>>,
    /// Number of starts from rest that were irregular to the last.
    pub(crate) from_rest: usize,
    pub(crate) life: Lived,
}

/// A cycle, the number of starts from rest that reached it, and a disk on it.
#[derive(Debug)]
pub(crate) struct Surveyed {
    pub(crate) source: Source,
    pub(crate) repeats: Repeats,
    pub(crate) from_rest: usize,
    cycle: Cycle,
}

/// For how long irregular motions were observed (rad), in total and at most, and how many of them ended.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Lived {
    pub(crate) total: f64,
    pub(crate) longest: f64,
    pub(crate) ended: u64,
}

impl Lived {
    /// Adds a motion that was observed for this long.
    pub(crate) fn add(&mut self, lasted: f64, has_ended: bool) {
        self.total += lasted;
        self.longest = self.longest.max(lasted);
        self.ended += u64::from(has_ended);
    }
}

impl Survey {
    /// The motions of a disk of this system, from phases that the seed rotates; `None` for a compliant
    /// stator, and for rigid impacts on a stator with kinks.
    pub(crate) fn of(
        stator: &Stator,
        system: &DimensionlessSystem,
        seed: u64,
        watch: &Watch<'_>,
    ) -> Result<Option<Self>, Error> {
        if stator.yields() || !stator.takes_time() && stator.has_kinks() {
            return Ok(None);
        }
        let start = |index: usize| {
            let phase = Phase::new(TAU * (golden_share(index) + turn_of_seed(seed)))?;
            Source::new(stator, system, (phase, thrown(index)), (0.0, 0))
        };
        let mut found = Self { cycles: Vec::new(), irregular: None, from_rest: 0, life: Lived::default() };
        if !stator.takes_time() {
            for followed in in_parallel(STARTS, |own| Followed::of(start(2 * own + 1)?, &mut watch.work())) {
                let followed = followed?;
                if followed.repeats.is_some() {
                    found.add_cycle(followed, false, &mut watch.work())?;
                }
            }
            return Ok(Some(found));
        }
        let (mut irregular, mut later, mut touches) = (Vec::new(), Vec::new(), 0);
        for begun in (0..MOST_STARTS).step_by(STARTS) {
            // Starts from rest are all among the first.
            let index = |own: usize| if begun == 0 { own } else { 2 * (begun + own) + 1 };
            let all = in_parallel(STARTS, |own| Followed::of(start(index(own))?, &mut watch.work()));
            for (own, followed) in all.into_iter().enumerate() {
                let mut followed = followed?;
                touches += followed.touches;
                let from_rest = begun == 0 && !is_thrown(own);
                let (states, repeats) = (std::mem::take(&mut followed.states), followed.repeats.is_some());
                let lasted = if repeats {
                    found.add_cycle(followed, from_rest, &mut watch.work())?
                } else {
                    found.from_rest += usize::from(from_rest);
                    followed.time
                };
                let mut states = states.into_iter().filter(|(time, _)| *time < lasted);
                if let Some((settled, first)) = states.next() {
                    irregular.push(first);
                    later.extend(states.map(|(_, state)| state));
                    found.life.add(lasted - settled, repeats);
                }
            }
            let ends = found.life.ended;
            let is_known =
                irregular.is_empty() || irregular.len() >= STARTS && (ends == 0 || ends >= ENOUGH_ENDS);
            if is_known || touches >= MOST_TOUCHES {
                break;
            }
        }
        irregular.extend(later);
        found.irregular = Some(irregular);
        Ok(Some(found))
    }

    /// Adds the cycle of a motion that repeats; returns how long (rad) the motion lasted before it was on its
    /// way to the cycle.
    fn add_cycle(
        &mut self,
        followed: Followed,
        from_rest: bool,
        work: &mut WorkCount<'_>,
    ) -> Result<f64, Error> {
        let Followed { mut source, marks, repeats: Some(repeats), .. } = followed else { return Ok(0.0) };
        let cycle = Cycle::record(&mut source, repeats, Vec::new(), work)?;
        let far = marks.iter().rev().find(|(_, key)| !cycle.is_near(key));
        let lasted = far.map_or(0.0, |(time, _)| *time);
        match self.cycles.iter_mut().find(|known| known.cycle.is_same(&cycle)) {
            Some(known) => known.from_rest += usize::from(from_rest),
            None => {
                let from_rest = usize::from(from_rest);
                self.cycles.push(Surveyed { source, repeats, from_rest, cycle });
            }
        }
        Ok(lasted)
    }
}

/// A start that was followed.
struct Followed {
    source: Source,
    /// Selected touches, each with its time (rad).
    marks: Vec<(f64, Key)>,
    states: Vec<(f64, Source)>,
    repeats: Option<Repeats>,
    time: f64,
    touches: u64,
}

impl Followed {
    fn of(mut source: Source, work: &mut WorkCount<'_>) -> Result<Self, Error> {
        let is_rigid = !source.takes_time();
        let longest = if matches!(source, Source::Taps(_)) { LONGEST } else { SHORTEST };
        let mut tape = Tape::new(source.phase(), 0.0, Vec::new());
        let mut recurrence = Recurrence::default();
        let (mut marks, mut states, mut repeats) = (Vec::new(), Vec::new(), None);
        let (mut time, mut touches, mut steps) = (0.0, 0, 0);
        while touches < longest && repeats.is_none() && steps < STEPS_OF_TOUCH * longest {
            steps += 1;
            let touch = source.record(&mut tape, work)?;
            let lasted = tape.axial.duration;
            time += lasted;
            tape.restart();
            repeats = recurrence.add(touch, lasted);
            let Touch::At(key) = touch else {
                // A disk that comes to rest continues as from rest.
                if is_rigid {
                    break;
                }
                continue;
            };
            touches += 1;
            if touches % MARK == 0 {
                marks.push((time, key));
            }
            if touches % SETTLED == 0 && states.len() < MOST_STATES {
                states.push((time, source.clone()));
            }
        }
        Ok(Self { source, marks, states, repeats, time, touches })
    }
}
