//! Many flights in lockstep: the first impacts of [`LANES`] launches, bit for bit those of
//! [`Vibration::first_impact`].
//!
//! The solver of one flight waits for its own results most of the time. Here each of its steps is a loop over
//! independent lanes. It is short enough for the processor to overlap many lanes, and simple enough for the
//! compiler to turn into vectors of whatever width the processor supports ([`InstructionSet`]). A lane
//! follows the vector path only if every decision on this path is the same as in the solver of one flight
//! (docs/numerics-impacts.md, "Why the bits are the same"). The others are handed to that solver: 2.2 % of
//! the flights of the basin W3 and 2.3 % of the motor W2 (data/performance/README.md).
//!
//! The loops use the functions of the one-flight solver (`GapTaylor`, `CrestForm`, `LaunchForm`, `ShortForm`) in
//! the same order. A lane takes the same *decisions*:
//!
//! - *Above the crests.* A lane takes the step of the model if it stays before the next crest, by 1e-9 turns, so
//!   that rounding cannot decide otherwise. Otherwise it takes Newton's step, or half the way to the crest, by
//!   the solver's rule and from the same numbers. Disks that may come down behind a crest where the platform
//!   falls away faster have two windows. These disks, and flights not near their root after the second or third
//!   evaluation, continue for four evaluations with the windows, steps and brackets of the solver.
//! - *Short.* Newton's iteration of `ShortForm`. Lanes that leave the first piece of constant curvature sign
//!   continue if the gap is positive at the end of the pieces within half a radian and the slopes or the
//!   tangents there exclude a dip.
//! - *Low.* The same comparisons, with gaps beyond doubt, determine the window before the first crest; four
//!   evaluations follow.
//!
//! The first step sorts all launches by the kind of flight that follows (`root.rs`). A batch that rises above
//! the crests as a whole is computed in place; otherwise each kind is collected until [`LANES`] flights fill
//! the vectors (`scheduler.rs`). `sweep/orbit_batch.rs` compares all bits of three million launches of every
//! kind, for each instruction set, with [`ImpactMap::step`]. AVX-512 gave the same bits in an emulator (Bochs
//! 2.7 as Skylake-X) and on a processor (AMD EPYC).

mod above;
mod awaiting;
mod instructions;
mod low;
mod platform;
mod root;
mod scheduler;
mod short;
mod subset;

use pulp::Simd;

use crate::flight::launch::Impact;
use crate::flight::platform::phase::Phase;
use crate::flight::platform::vibration::Vibration;
use crate::map::impact_map::{ImpactMap, ImpactState};
use crate::numerics::elementary::{reduced_of_lane, sin_cos_of_reduced};
use platform::{Platform, PlatformLanes, Platforms};

pub(crate) use instructions::Dispatch;
pub use instructions::InstructionSet;
pub(crate) use scheduler::{FlightScheduler, Purpose};
pub(crate) use subset::{Lanes, lanes_of};

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

/// Sines and cosines of some angles, in two loops: the processor overlaps more iterations of shorter loops.
#[inline(always)]
fn pairs<S: Simd>(width: impl Width, sin: &mut Row, cos: &mut Row, angle: impl Fn(usize) -> f64) {
    scaled_pairs::<S>(width, sin, cos, angle, |_| 1.0);
}

/// [`pairs`], multiplied by a number for each.
#[inline(always)]
fn scaled_pairs<S: Simd>(
    width: impl Width,
    sin: &mut Row,
    cos: &mut Row,
    angle: impl Fn(usize) -> f64,
    scale: impl Fn(usize) -> f64,
) {
    for k in 0..width.lanes() {
        let (reduced, quadrant) = reduced_of_lane(angle(k));
        (sin[k], cos[k]) = (reduced, f64::from_bits(quadrant));
    }
    // The baseline has no instruction for a selection.
    let blends = size_of::<S::f64s>() > size_of::<f64>();
    for k in 0..width.lanes() {
        let (s, c) = sin_cos_of_reduced(sin[k], cos[k].to_bits(), blends);
        (sin[k], cos[k]) = (scale(k) * s, scale(k) * c);
    }
}

/// How many flights a stage computes.
trait Width: Copy {
    fn lanes(self) -> usize;
}

/// All lanes: loops of fixed length.
#[derive(Debug, Clone, Copy)]
struct Whole;

impl Width for Whole {
    #[inline(always)]
    fn lanes(self) -> usize {
        LANES
    }
}

/// Lanes that are taken together: vectors without a remainder.
const SIXTEEN: usize = 16;

/// Whole sixteens of lanes.
#[derive(Debug, Clone, Copy)]
struct Sixteens(usize);

impl Sixteens {
    /// The fewest sixteens that hold `count` flights.
    const fn holding(count: usize) -> Self {
        Self(count.div_ceil(SIXTEEN))
    }
}

impl Width for Sixteens {
    #[inline(always)]
    fn lanes(self) -> usize {
        // Never more lanes; so the compiler sees that they fit into a row.
        SIXTEEN * self.0.min(LANES / SIXTEEN)
    }
}

/// `value` if the mask is set, otherwise +0.
#[inline(always)]
pub(crate) const fn kept(mask: u64, value: f64) -> f64 {
    f64::from_bits(value.to_bits() & mask)
}

/// Launches of all lanes: from the previous impacts, with relative speeds >= 0.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Launches<'a> {
    pub(crate) from: &'a Impacts,
    pub(crate) speed: &'a Row,
}

/// The rows of a batch in flight.
struct Rows<'a> {
    from: &'a Impacts,
    speed: &'a mut Row,
    restitution: &'a Row,
    arcs: &'a mut Arcs,
    impacts: &'a mut Impacts,
}

/// Disks that have come down to the height of the crests.
#[derive(Debug, Clone)]
#[repr(align(64))]
struct Arcs {
    /// Phase minus the whole periods flown, these periods, and the disk's speed, which is negative.
    start: Row,
    free_periods: Row,
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
    /// How many times the phase passed 0 during the flight; stale, like the duration, unless the launch was
    /// set ([`Purpose`]).
    pub(crate) turns: Row,
    /// Duration of the flight (rad), or [`Impacts::BETWEEN_PHASES`].
    pub(crate) duration: Row,
}

/// The platforms above which the lanes fly.
#[derive(Debug, Clone)]
enum Ground {
    Shared(Platform),
    Own(Box<Platforms>),
}

/// The flights of a batch of lanes: platforms, launches and the impacts that follow.
#[derive(Debug, Clone)]
pub(crate) struct Batch {
    ground: Ground,
    /// The impacts, and the previous ones, from which the last flights were launched; the two change places
    /// with every flight.
    impacts: [Impacts; 2],
    last: usize,
    /// The index in `impacts` of the launches: until they are flown, that of the impacts that they follow.
    from: usize,
    /// Relative speeds of the launches.
    speed: Row,
    /// Coefficients of restitution, if every launch follows the previous impact.
    restitution: Row,
    arcs: Arcs,
    vibrations: [Vibration; LANES],
    /// P of every lane.
    pub(crate) peaks: Row,
}

/// A lane of one of several batches.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Who {
    batch: u32,
    lane: u32,
}

impl Who {
    const NONE: Self = Self { batch: 0, lane: 0 };
}

const ROW: Row = [0.0; LANES];

impl Batch {
    /// All lanes on the platform of `vibration`, with an impact at phase 0 and speed 0.
    pub(crate) fn new(vibration: Vibration) -> Self {
        Self {
            ground: Ground::Shared(Platform::from(&vibration)),
            impacts: [Impacts::new(), Impacts::new()],
            last: 0,
            from: 0,
            speed: ROW,
            // One that is never set makes no launch.
            restitution: [f64::NAN; LANES],
            arcs: Arcs::new(),
            vibrations: [vibration; LANES],
            peaks: [vibration.peak_acceleration(); LANES],
        }
    }

    /// All lanes on the platform of a map and with its restitution.
    pub(crate) fn of_map(map: &ImpactMap) -> Self {
        Self { restitution: [map.restitution(); LANES], ..Self::new(*map.vibration()) }
    }

    /// Puts all lanes on the same platform.
    pub(crate) fn share_platform(&mut self, vibration: Vibration) {
        self.ground = Ground::Shared(Platform::from(&vibration));
        self.vibrations = [vibration; LANES];
        self.peaks = [vibration.peak_acceleration(); LANES];
    }

    /// Puts a lane on another platform.
    pub(crate) fn set_platform(&mut self, lane: usize, vibration: Vibration) {
        if self.vibrations[lane] == vibration {
            return;
        }
        self.vibrations[lane] = vibration;
        self.peaks[lane] = vibration.peak_acceleration();
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

    /// The platform of a lane.
    #[inline(always)]
    fn platform(&self, lane: usize) -> Platform {
        match &self.ground {
            Ground::Shared(platform) => *platform,
            Ground::Own(platforms) => platforms.as_ref().lane(lane),
        }
    }

    /// The impacts of all lanes.
    #[inline(always)]
    pub(crate) const fn impacts(&self) -> &Impacts {
        &self.impacts[self.last]
    }

    /// The impacts that the last flights started from.
    #[inline(always)]
    pub(crate) const fn impacts_before(&self) -> &Impacts {
        &self.impacts[1 - self.last]
    }

    /// The launches of all lanes.
    #[inline(always)]
    pub(crate) const fn launches(&self) -> Launches<'_> {
        Launches { from: &self.impacts[self.from], speed: &self.speed }
    }

    #[inline(always)]
    const fn impacts_mut(&mut self) -> &mut Impacts {
        &mut self.impacts[self.last]
    }

    /// Makes room for the impacts of the next flight.
    #[inline(always)]
    const fn turn(&mut self) {
        self.from = self.last;
        self.last = 1 - self.last;
    }

    /// Platforms and rows, after [`Self::turn`].
    #[inline(always)]
    const fn parts(&mut self) -> (&Ground, Rows<'_>) {
        let Self { ground, impacts: [first, second], speed, restitution, arcs, .. } = self;
        let (from, impacts) = if self.last == 0 { (second, first) } else { (first, second) };
        (ground, Rows { from, speed, restitution, arcs, impacts })
    }

    /// Sets the impact of a lane, from which its next launch starts.
    pub(crate) const fn set_impact(&mut self, lane: usize, phase: Phase, velocity: f64) {
        let impacts = self.impacts_mut();
        impacts.angle[lane] = phase.angle();
        impacts.sin[lane] = phase.sin();
        impacts.cos[lane] = phase.cos();
        impacts.velocity[lane] = velocity;
    }

    /// Sets the coefficient of restitution of a lane, for flights that follow the previous impacts.
    pub(crate) const fn set_restitution(&mut self, lane: usize, restitution: f64) {
        self.restitution[lane] = restitution;
    }

    /// Sets the impact of a lane to one of another batch.
    pub(crate) const fn take_impact(&mut self, lane: usize, from: &Self, other: usize) {
        self.impacts_mut().take(lane, from.impacts(), other);
    }

    /// Lets every launch follow the impact of its lane, once its speed is set.
    pub(crate) const fn rebounding(&mut self) -> Rebounding<'_> {
        self.from = self.last;
        let Self { peaks, impacts, last, speed, .. } = self;
        Rebounding { peaks, impacts: &impacts[*last], speed }
    }

    /// Sets the impact of a lane back to the one that its last flight followed.
    pub(crate) const fn stay(&mut self, lane: usize) {
        let velocity = self.launches().from.velocity[lane];
        self.set_impact(lane, self.launch_phase(lane), velocity);
    }

    /// The impact of a lane.
    pub(crate) const fn impact_state(&self, lane: usize) -> ImpactState {
        let impacts = self.impacts();
        ImpactState::of_impact(impacts.phase(lane), impacts.velocity[lane])
    }

    /// Sets the next launch of a lane, in the place of its impact.
    pub(crate) const fn set_launch(&mut self, lane: usize, phase: Phase, speed: f64) {
        self.from = self.last;
        let from = &mut self.impacts[self.last];
        from.angle[lane] = phase.angle();
        from.sin[lane] = phase.sin();
        from.cos[lane] = phase.cos();
        self.speed[lane] = speed;
    }

    /// The phase of a lane's launch.
    pub(crate) const fn launch_phase(&self, lane: usize) -> Phase {
        self.launches().from.phase(lane)
    }
}

/// The rows of launches that follow impacts.
pub(crate) struct Rebounding<'a> {
    pub(crate) peaks: &'a Row,
    pub(crate) impacts: &'a Impacts,
    /// Relative speeds of the launches, to be set.
    pub(crate) speed: &'a mut Row,
}

impl Arcs {
    const fn new() -> Self {
        Self { start: ROW, free_periods: ROW, speed: ROW }
    }

    /// Takes over the arc of a lane as number `k`.
    #[inline(always)]
    const fn take(&mut self, k: usize, others: &Self, lane: usize) {
        self.start[k] = others.start[lane];
        self.free_periods[k] = others.free_periods[lane];
        self.speed[k] = others.speed[lane];
    }
}

impl Impacts {
    /// Stored instead of a duration that follows from the phases of launch and impact and the turns
    /// (`flight::landed`).
    pub(crate) const BETWEEN_PHASES: f64 = -1.0;

    const fn new() -> Self {
        Self { angle: ROW, sin: ROW, cos: [1.0; LANES], velocity: ROW, turns: ROW, duration: ROW }
    }

    const fn phase(&self, lane: usize) -> Phase {
        Phase::from_parts(self.angle[lane], self.sin[lane], self.cos[lane])
    }

    /// Takes over the state of number `k` of others as that of a lane.
    #[inline(always)]
    const fn take(&mut self, lane: usize, others: &Self, k: usize) {
        self.angle[lane] = others.angle[k];
        self.sin[lane] = others.sin[k];
        self.cos[lane] = others.cos[k];
        self.velocity[lane] = others.velocity[k];
    }

    /// Also takes over the duration of the flight.
    #[inline(always)]
    const fn take_time(&mut self, lane: usize, others: &Self, k: usize) {
        self.turns[lane] = others.turns[k];
        self.duration[lane] = others.duration[k];
    }

    fn set(&mut self, lane: usize, impact: &Impact) {
        self.angle[lane] = impact.phase.angle();
        self.sin[lane] = impact.phase.sin();
        self.cos[lane] = impact.phase.cos();
        self.velocity[lane] = impact.velocity;
        self.turns[lane] = impact.turns as f64;
        self.duration[lane] = impact.duration();
    }
}
