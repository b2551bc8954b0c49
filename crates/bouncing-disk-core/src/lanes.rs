//! Many flights in lockstep: the first impacts of [`LANES`] launches, bit for bit those of
//! [`Vibration::first_impact`].
//!
//! The solver of one flight waits for its own results most of the time. Here each step of it is a loop over lanes
//! that do not depend on each other, short enough for the processor to overlap many of them, and plain enough for
//! the compiler to turn into vectors of whatever width the processor has ([`InstructionSet`]). A lane takes the
//! vector path only where every decision on it is the one that the solver of one flight takes; the others are handed to
//! that solver (docs/numerics.md, section 9).

mod above;
mod classify;
mod fallen;
mod list;
mod low;
mod platform;
mod search;
mod short;

use pulp::{Simd, WithSimd};

use crate::error::Error;
use crate::flight::Impact;
use crate::phase::Phase;
use crate::vibration::Vibration;
use above::{Fly, Work};
use classify::{Classify, Kinds};
use fallen::Fallen;
use list::List;
use low::Low;
use platform::{Below, Platform, Platforms};
use search::{Search, Times};
use short::{Fate, Short};

/// Flights in one batch.
pub(crate) const LANES: usize = 64;

/// One number of every lane.
pub(crate) type Row = [f64; LANES];
/// All bits of a lane set or none.
pub(crate) type Mask = [u64; LANES];

#[inline(always)]
pub(crate) const fn mask(condition: bool) -> u64 {
    (condition as u64).wrapping_neg()
}

/// Packed lanes are computed in groups of this many.
const GROUP: usize = 8;

/// `count` lanes rounded up to whole groups.
#[inline(always)]
const fn packed(count: usize) -> usize {
    let lanes = count.div_ceil(GROUP) * GROUP;
    if lanes < LANES { lanes } else { LANES }
}

/// `value` where the mask is set, else +0.
#[inline(always)]
const fn kept(mask: u64, value: f64) -> f64 {
    f64::from_bits(value.to_bits() & mask)
}

/// The vector instructions that lanes are computed with. The results are the same bits.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum InstructionSet {
    /// What every processor of the compilation target has (SSE2 on x86-64).
    Baseline,
    /// AVX2: four lanes at once.
    Avx2,
    /// AVX-512: eight lanes at once.
    Avx512,
}

impl InstructionSet {
    /// All that this processor has, the best one last.
    #[must_use]
    pub fn available() -> Vec<Self> {
        let mut sets = vec![Self::Baseline];
        #[cfg(target_arch = "x86_64")]
        {
            if pulp::x86::V3::try_new().is_some() {
                sets.push(Self::Avx2);
            }
            if pulp::x86::V4::try_new().is_some() {
                sets.push(Self::Avx512);
            }
        }
        sets
    }

    /// The best one that this processor has.
    #[must_use]
    pub fn best() -> Self {
        Self::available().last().copied().unwrap_or(Self::Baseline)
    }
}

/// Runs an operation compiled for an instruction set that was found available.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Dispatch {
    Baseline,
    #[cfg(target_arch = "x86_64")]
    Avx2(pulp::x86::V3),
    #[cfg(target_arch = "x86_64")]
    Avx512(pulp::x86::V4),
}

impl Dispatch {
    /// For `set`, or the next lower one that this processor has.
    fn new(set: InstructionSet) -> Self {
        #[cfg(target_arch = "x86_64")]
        {
            if set == InstructionSet::Avx512
                && let Some(level) = pulp::x86::V4::try_new()
            {
                return Self::Avx512(level);
            }
            if set != InstructionSet::Baseline
                && let Some(level) = pulp::x86::V3::try_new()
            {
                return Self::Avx2(level);
            }
        }
        let _ = set;
        Self::Baseline
    }

    #[inline(always)]
    pub(crate) fn run(self, operation: impl WithSimd<Output = ()>) {
        match self {
            Self::Baseline => operation.with_simd(pulp::Scalar::new()),
            #[cfg(target_arch = "x86_64")]
            Self::Avx2(level) => Simd::vectorize(level, operation),
            #[cfg(target_arch = "x86_64")]
            Self::Avx512(level) => Simd::vectorize(level, operation),
        }
    }
}

/// Launches of all lanes.
#[derive(Debug, Clone)]
#[repr(align(64))]
pub(crate) struct Launches {
    angle: Row,
    sin: Row,
    cos: Row,
    /// Relative speed, >= 0.
    speed: Row,
}

/// Impacts of all lanes.
#[derive(Debug, Clone)]
#[repr(align(64))]
pub(crate) struct Impacts {
    pub(crate) angle: Row,
    pub(crate) sin: Row,
    pub(crate) cos: Row,
    /// Relative velocity, <= 0.
    pub(crate) velocity: Row,
    /// How often the phase passed 0 during the flight.
    pub(crate) turns: Row,
}

/// What the lanes fly above.
#[derive(Debug, Clone)]
enum Ground {
    Shared(Platform),
    Own(Box<Platforms>),
}

/// The flights of a batch of lanes: platforms, launches and the impacts that follow.
#[derive(Debug, Clone)]
pub(crate) struct Batch {
    ground: Ground,
    pub(crate) launches: Launches,
    pub(crate) impacts: Impacts,
    vibrations: [Vibration; LANES],
}

/// Computes the flights of one batch after the other.
#[derive(Debug, Clone)]
pub(crate) struct Flyer {
    scratch: Scratch,
    dispatch: Dispatch,
}

/// Flights of the lanes by their kind.
#[derive(Debug, Clone)]
#[repr(align(64))]
struct Scratch {
    kinds: Kinds,
    above: List,
    slow: List,
    hard: List,
    work: Work,
    short: Short,
    low: Low,
    fallen: Fallen,
    times: Times,
    /// Packed launches, their platforms and their impacts.
    launches: Launches,
    platforms: Platforms,
    impacts: Impacts,
}

const ROW: Row = [0.0; LANES];

impl Batch {
    /// All lanes on the platform of `vibration`, with an impact at phase 0 and speed 0.
    pub(crate) fn new(vibration: Vibration) -> Self {
        Self {
            ground: Ground::Shared(Platform::from(&vibration)),
            launches: Launches::new(),
            impacts: Impacts::new(),
            vibrations: [vibration; LANES],
        }
    }

    /// Puts a lane on another platform.
    pub(crate) fn set_platform(&mut self, lane: usize, vibration: Vibration) {
        if self.vibrations[lane] == vibration {
            return;
        }
        self.vibrations[lane] = vibration;
        match &mut self.ground {
            Ground::Own(platforms) => platforms.set(lane, Platform::from(&vibration)),
            Ground::Shared(_) => {
                let mut platforms = Box::new(Platforms::new());
                for (lane, vibration) in self.vibrations.iter().enumerate() {
                    platforms.set(lane, Platform::from(vibration));
                }
                self.ground = Ground::Own(platforms);
            }
        }
    }

    /// Sets the impact of a lane: what its next launch starts from.
    pub(crate) const fn set_impact(&mut self, lane: usize, phase: Phase, velocity: f64) {
        self.impacts.angle[lane] = phase.angle();
        self.impacts.sin[lane] = phase.sin();
        self.impacts.cos[lane] = phase.cos();
        self.impacts.velocity[lane] = velocity;
    }

    /// Sets every launch to what follows the impact of its lane with this coefficient of restitution.
    pub(crate) fn rebound(&mut self, restitution: &Row) {
        let Self { launches, impacts, .. } = self;
        launches.angle = impacts.angle;
        launches.sin = impacts.sin;
        launches.cos = impacts.cos;
        for ((speed, restitution), velocity) in
            launches.speed.iter_mut().zip(restitution).zip(&impacts.velocity)
        {
            *speed = -restitution * velocity;
        }
    }

    /// The phase of a lane's launch.
    pub(crate) const fn launch_phase(&self, lane: usize) -> Phase {
        Phase::from_parts(self.launches.angle[lane], self.launches.sin[lane], self.launches.cos[lane])
    }

    /// The phase of a lane's impact.
    pub(crate) const fn impact_phase(&self, lane: usize) -> Phase {
        Phase::from_parts(self.impacts.angle[lane], self.impacts.sin[lane], self.impacts.cos[lane])
    }
}

impl Flyer {
    pub(crate) fn new(set: InstructionSet) -> Self {
        let scratch = Scratch {
            kinds: Kinds::new(),
            above: List::new(),
            slow: List::new(),
            hard: List::new(),
            work: Work::new(),
            short: Short::new(),
            low: Low::new(),
            fallen: Fallen::new(),
            times: Times::new(),
            launches: Launches::new(),
            platforms: Platforms::new(),
            impacts: Impacts::new(),
        };
        Self { scratch, dispatch: Dispatch::new(set) }
    }

    /// Runs other loops over lanes with the same instructions.
    pub(crate) const fn dispatch(&self) -> Dispatch {
        self.dispatch
    }

    /// Computes the impacts of the first `lanes` launches; `failed` is told of each lane that has none, and whose impact is
    /// then meaningless.
    pub(crate) fn fly(&mut self, batch: &mut Batch, lanes: usize, mut failed: impl FnMut(usize, Error)) {
        let Batch { ground, launches, impacts, vibrations } = batch;
        match ground {
            Ground::Shared(platform) => self.scratch.fly(self.dispatch, platform, launches, lanes, impacts),
            Ground::Own(platforms) => {
                self.scratch.fly(self.dispatch, platforms.as_ref(), launches, lanes, impacts);
            }
        }
        for lane in self.scratch.hard.iter() {
            let from = Phase::from_parts(launches.angle[lane], launches.sin[lane], launches.cos[lane]);
            match vibrations[lane].impact_after(from, launches.speed[lane]) {
                Ok(impact) => impacts.set(lane, &impact),
                Err(error) => failed(lane, error),
            }
        }
    }
}

impl Scratch {
    /// Computes the impacts of the first `lanes` launches, except those that it lists as `hard`.
    fn fly<P: Below>(
        &mut self,
        dispatch: Dispatch,
        platforms: &P,
        launches: &Launches,
        lanes: usize,
        impacts: &mut Impacts,
    ) {
        self.hard.clear();
        dispatch.run(Classify { platforms, launches, kinds: &mut self.kinds });
        if self.kinds.special {
            self.sort(lanes);
            self.fly_slow(dispatch, platforms, launches, impacts);
            self.fly_low(dispatch, platforms, launches, impacts);
            self.fly_above(dispatch, platforms, launches, impacts);
        } else {
            dispatch.run(Fly { platforms, launches, lanes: LANES, work: &mut self.work, impacts });
            if self.work.all {
                return;
            }
            self.times.lanes.clear();
            for lane in 0..lanes {
                if self.work.landed[lane] == 0 {
                    self.keep_searching(platforms, lane, lane);
                }
            }
        }
        self.search_fallen(dispatch, impacts);
    }

    /// Lists the lanes by kind.
    fn sort(&mut self, lanes: usize) {
        let Self { kinds, above, slow, times, .. } = self;
        let low = &mut times.lanes;
        above.clear();
        slow.clear();
        low.clear();
        for lane in 0..lanes {
            let (is_slow, is_low) = (kinds.slow[lane], kinds.low[lane]);
            slow.push_where(is_slow, lane);
            low.push_where(is_low & !is_slow, lane);
            above.push_where(!(is_low | is_slow), lane);
        }
    }

    fn fly_slow<P: Below>(
        &mut self,
        dispatch: Dispatch,
        platforms: &P,
        launches: &Launches,
        impacts: &mut Impacts,
    ) {
        if self.slow.len() == 0 {
            return;
        }
        self.short.pack(&self.slow, platforms, launches);
        let solve =
            short::Solve { short: &mut self.short, count: self.slow.len(), impacts: &mut self.impacts };
        dispatch.run(solve);
        for (k, lane) in self.slow.iter().enumerate() {
            match self.short.fate(k) {
                Fate::Landed => impacts.take(lane, &self.impacts, k),
                Fate::FliesOn if self.kinds.low[lane] == 0 => self.above.push(lane),
                Fate::FliesOn => self.times.lanes.push(lane),
                Fate::Doubtful => self.hard.push(lane),
            }
        }
    }

    fn fly_low<P: Below>(
        &mut self,
        dispatch: Dispatch,
        platforms: &P,
        launches: &Launches,
        impacts: &mut Impacts,
    ) {
        let Self { low, times, above, hard, .. } = self;
        if times.lanes.len() == 0 {
            return;
        }
        low.pack(&times.lanes, platforms, launches);
        let platforms = platforms.packed(&times.lanes, &mut self.platforms);
        dispatch.run(low::Windows { platforms, low, times });
        for k in 0..times.lanes.len() {
            above.push_where(low.clears[k], times.lanes.lane(k));
            hard.push_where(!(low.clears[k] | times.open[k]), times.lanes.lane(k));
        }
        times.keep_open(low);
        dispatch.run(Search { forms: low, times });
        dispatch.run(low::Land { low, times, impacts: &mut self.impacts });
        for (k, lane) in times.lanes.iter().enumerate() {
            if times.open[k] == 0 {
                hard.push(lane);
            } else {
                impacts.take(lane, &self.impacts, k);
            }
        }
    }

    /// The lanes listed as flying above the crests; those that do not land at once go on to [`Self::search_fallen`].
    fn fly_above<P: Below>(
        &mut self,
        dispatch: Dispatch,
        platforms: &P,
        launches: &Launches,
        impacts: &mut Impacts,
    ) {
        self.times.lanes.clear();
        for (k, lane) in self.above.iter().enumerate() {
            self.launches.angle[k] = launches.angle[lane];
            self.launches.sin[k] = launches.sin[lane];
            self.launches.cos[k] = launches.cos[lane];
            self.launches.speed[k] = launches.speed[lane];
        }
        let below = platforms.packed(&self.above, &mut self.platforms);
        let (work, landings) = (&mut self.work, &mut self.impacts);
        let fly =
            Fly { platforms: below, launches: &self.launches, lanes: self.above.len(), work, impacts: landings };
        dispatch.run(fly);
        for k in 0..self.above.len() {
            let lane = self.above.lane(k);
            if self.work.landed[k] == 0 {
                self.keep_searching(platforms, k, lane);
            } else {
                impacts.take(lane, &self.impacts, k);
            }
        }
    }

    /// Lists a lane, computed as number `k`, for [`Self::search_fallen`].
    fn keep_searching<P: Below>(&mut self, platforms: &P, k: usize, lane: usize) {
        if self.work.regular[k] == 0 {
            self.hard.push(lane);
            return;
        }
        self.fallen.set(self.times.lanes.len(), platforms.lane(lane), &self.work, k);
        self.times.lanes.push(lane);
    }

    fn search_fallen(&mut self, dispatch: Dispatch, impacts: &mut Impacts) {
        let Self { fallen, times, hard, .. } = self;
        if times.lanes.len() == 0 {
            return;
        }
        dispatch.run(fallen::Windows { fallen, times });
        dispatch.run(Search { forms: fallen, times });
        dispatch.run(fallen::Land { fallen, times, impacts: &mut self.impacts });
        for (k, lane) in times.lanes.iter().enumerate() {
            if times.open[k] == 0 {
                hard.push(lane);
            } else {
                impacts.take(lane, &self.impacts, k);
            }
        }
    }
}

impl Launches {
    const fn new() -> Self {
        Self { angle: ROW, sin: ROW, cos: [1.0; LANES], speed: ROW }
    }
}

impl Impacts {
    const fn new() -> Self {
        Self { angle: ROW, sin: ROW, cos: [1.0; LANES], velocity: ROW, turns: ROW }
    }

    /// Takes over number `k` of others as the impact of a lane.
    #[inline(always)]
    const fn take(&mut self, lane: usize, other: &Self, k: usize) {
        self.angle[lane] = other.angle[k];
        self.sin[lane] = other.sin[k];
        self.cos[lane] = other.cos[k];
        self.velocity[lane] = other.velocity[k];
        self.turns[lane] = other.turns[k];
    }

    const fn set(&mut self, lane: usize, impact: &Impact) {
        self.angle[lane] = impact.phase.angle();
        self.sin[lane] = impact.phase.sin();
        self.cos[lane] = impact.phase.cos();
        self.velocity[lane] = impact.velocity;
        self.turns[lane] = impact.turns as f64;
    }
}
