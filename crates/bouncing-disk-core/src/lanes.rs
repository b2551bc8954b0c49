//! Many flights in lockstep: the first impacts of [`LANES`] launches, bit for bit those of
//! [`Vibration::first_impact`].
//!
//! The solver of one flight waits for its own results most of the time. Here each step of it is a loop over lanes
//! that do not depend on each other, short enough for the processor to overlap many of them, and plain enough for
//! the compiler to turn into vectors of whatever width the processor has ([`InstructionSet`]). A lane takes the
//! vector path only where every decision on it is the one that the solver of one flight takes; the others are handed to
//! that solver (docs/numerics.md, section 9).

mod above;
mod low;
mod short;

use pulp::{Simd, WithSimd};

use crate::error::Error;
use crate::flight::Impact;
use crate::phase::Phase;
use crate::vibration::Vibration;

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
pub(crate) const fn kept(mask: u64, value: f64) -> f64 {
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

/// The platforms of all lanes.
#[derive(Debug, Clone)]
#[repr(align(64))]
pub(crate) struct Platforms {
    pub(crate) peak: Row,
    separation_angle: Row,
    separation_speed: Row,
    separation_depth: Row,
    doubtful_gap: Row,
    long_launch_speed: Row,
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

/// Intermediate results of all lanes.
#[derive(Debug, Clone)]
#[repr(align(64))]
struct Work {
    start: Row,
    free_periods: Row,
    fall: Row,
    /// The window that holds the root, and the time reached.
    lo: Row,
    hi: Row,
    time: Row,
    sin: Row,
    cos: Row,
    root: Row,
    step: Row,
    inverse: Row,
    /// Lanes whose flight from above the crests is certain.
    regular: Mask,
    /// Lanes near the root at the time reached.
    near: Mask,
    /// Lanes that clear the first crest.
    clears: Mask,
    /// Lanes that may land within half a radian.
    slow: Mask,
    /// Lanes that have been landed, or left to the solver of one flight.
    settled: Mask,
}

/// The flights of a batch of lanes: platforms, launches and the impacts that follow.
#[derive(Debug, Clone)]
pub(crate) struct Batch {
    pub(crate) platforms: Platforms,
    pub(crate) launches: Launches,
    pub(crate) impacts: Impacts,
    vibrations: [Vibration; LANES],
}

/// Computes the flights of one batch after the other.
#[derive(Debug, Clone)]
pub(crate) struct Flyer {
    work: Work,
    short: short::Short,
    low: low::Low,
    dispatch: Dispatch,
}

const ROW: Row = [0.0; LANES];

impl Batch {
    /// All lanes on the platform of `vibration`, with an impact at phase 0 and speed 0.
    pub(crate) fn new(vibration: Vibration) -> Self {
        let mut batch = Self {
            platforms: Platforms {
                peak: ROW,
                separation_angle: ROW,
                separation_speed: ROW,
                separation_depth: ROW,
                doubtful_gap: ROW,
                long_launch_speed: ROW,
            },
            launches: Launches { angle: ROW, sin: ROW, cos: [1.0; LANES], speed: ROW },
            impacts: Impacts { angle: ROW, sin: ROW, cos: [1.0; LANES], velocity: ROW, turns: ROW },
            vibrations: [vibration; LANES],
        };
        for lane in 0..LANES {
            batch.set_platform(lane, vibration);
        }
        batch
    }

    /// Puts a lane on another platform.
    pub(crate) fn set_platform(&mut self, lane: usize, vibration: Vibration) {
        self.vibrations[lane] = vibration;
        let platforms = &mut self.platforms;
        platforms.peak[lane] = vibration.peak_acceleration();
        platforms.separation_angle[lane] = vibration.separation_angle;
        platforms.separation_speed[lane] = vibration.separation_speed;
        platforms.separation_depth[lane] = vibration.separation_depth;
        platforms.doubtful_gap[lane] = vibration.doubtful_gap;
        platforms.long_launch_speed[lane] = vibration.long_launch_speed;
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
        let work = Work {
            start: ROW,
            free_periods: ROW,
            fall: ROW,
            lo: ROW,
            hi: ROW,
            time: ROW,
            sin: ROW,
            cos: ROW,
            root: ROW,
            step: ROW,
            inverse: ROW,
            regular: [0; LANES],
            near: [0; LANES],
            clears: [0; LANES],
            slow: [0; LANES],
            settled: [0; LANES],
        };
        Self { work, short: short::Short::new(), low: low::Low::new(), dispatch: Dispatch::new(set) }
    }

    /// Runs other loops over lanes with the same instructions.
    pub(crate) const fn dispatch(&self) -> Dispatch {
        self.dispatch
    }

    /// Computes the impacts of the first `lanes` launches; `failed` is told of each lane that has none, and whose impact is
    /// then meaningless.
    pub(crate) fn fly(&mut self, batch: &mut Batch, lanes: usize, mut failed: impl FnMut(usize, Error)) {
        let Self { work, short, low, dispatch } = self;
        let Batch { platforms, launches, impacts, vibrations } = batch;
        dispatch.run(above::Prepare { platforms, launches, work });
        if short.collect(lanes, platforms, launches, work) {
            dispatch.run(short::Solve { short });
            short.judge(work);
        }
        let any_low = low.collect(lanes, platforms, launches, work);
        if any_low {
            dispatch.run(low::Solve { low });
            low.judge(work);
        }
        dispatch.run(above::Land { platforms, work, impacts });
        short.land(impacts);
        if any_low {
            low.land(work, impacts);
        }
        for (lane, vibration) in vibrations.iter().enumerate().take(lanes) {
            if work.settled[lane] != 0 {
                continue;
            }
            let from = Phase::from_parts(launches.angle[lane], launches.sin[lane], launches.cos[lane]);
            match vibration.impact_after(from, launches.speed[lane]) {
                Ok(impact) => impacts.set(lane, &impact),
                Err(error) => failed(lane, error),
            }
        }
    }
}

impl Impacts {
    const fn set(&mut self, lane: usize, impact: &Impact) {
        self.angle[lane] = impact.phase.angle();
        self.sin[lane] = impact.phase.sin();
        self.cos[lane] = impact.phase.cos();
        self.velocity[lane] = impact.velocity;
        self.turns[lane] = impact.turns as f64;
    }
}

impl Batch {
    /// Sets the launch of a lane.
    pub(crate) const fn set_launch(&mut self, lane: usize, phase: Phase, speed: f64) {
        self.launches.angle[lane] = phase.angle();
        self.launches.sin[lane] = phase.sin();
        self.launches.cos[lane] = phase.cos();
        self.launches.speed[lane] = speed;
    }

    /// The relative speed of a lane's launch.
    pub(crate) const fn launch_speed(&self, lane: usize) -> f64 {
        self.launches.speed[lane]
    }

    /// Phases of all launches (rad).
    pub(crate) const fn launch_angles(&self) -> &Row {
        &self.launches.angle
    }
}

impl Flyer {
    /// Writes the durations of those flights of the last [`Self::fly`] over the first `lanes` lanes whose impact was searched in
    /// the time since the launch: the phases do not tell them to the last bit. The other durations stay.
    pub(crate) fn write_durations(&self, batch: &Batch, lanes: usize, durations: &mut Row) {
        self.short.write_durations(durations);
        self.low.write_durations(durations);
        for (lane, vibration) in batch.vibrations.iter().enumerate().take(lanes) {
            if self.work.settled[lane] == 0
                && let Ok(impact) =
                    vibration.impact_after(batch.launch_phase(lane), batch.launches.speed[lane])
            {
                durations[lane] = impact.duration();
            }
        }
    }
}
