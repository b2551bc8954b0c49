//! Sorts launches by the kind of flight that follows; each kind is computed together, in stages.

mod stages;

use crate::flight::first_impact::FASTEST_ARC;
use crate::numerics::error::Error;
use crate::sweep::lockstep::lanes::above::{Fly, Work};
use crate::sweep::lockstep::lanes::awaiting::{Awaiting, FallingPlatform};
use crate::sweep::lockstep::lanes::low::{Low, WindowMasks};
use crate::sweep::lockstep::lanes::platform::{Platform, PlatformLanes, Platforms};
use crate::sweep::lockstep::lanes::root::{Classify, Kinds, Times};
use crate::sweep::lockstep::lanes::short::Short;
use crate::sweep::lockstep::lanes::{
    Arcs, Batch, Dispatch, Ground, Impacts, InstructionSet, LANES, Lanes, Rows, Who, Whole, lanes_of,
};

/// The purpose of the flights.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Purpose {
    /// Orbits of impact maps: every launch follows the previous impact with the restitution of its lane, and
    /// durations are not computed. Launches that are set are ignored.
    Orbits,
    /// Launches that are set; the impacts get their turns and durations.
    Launches,
}

/// Computes the flights of batches of lanes.
#[derive(Debug, Clone)]
pub(crate) struct FlightScheduler {
    dispatch: Dispatch,
    /// Whether the purpose is [`Purpose::Launches`].
    timed: bool,
    kinds: Kinds,
    work: Work,
    slow: Queue<Short>,
    low: Queue<Low>,
    above: Queue<Arcs>,
    awaiting: Queue<Awaiting>,
    masks: WindowMasks,
    falling_platform: FallingPlatform,
    /// The windows, times and impacts of the stage that is computed: its flights land before others go on.
    times: Times,
    impacts: Impacts,
    /// The platforms of `low` and of `above`, unless all lanes share one.
    low_platforms: Platforms,
    above_platforms: Platforms,
    hard: Vec<Who>,
}

impl FlightScheduler {
    /// Flights computed with these instructions.
    pub(crate) fn new(set: InstructionSet, purpose: Purpose) -> Self {
        Self {
            dispatch: Dispatch::new(set),
            timed: purpose == Purpose::Launches,
            kinds: Kinds::new(),
            work: Work::new(),
            slow: Queue::new(Short::new()),
            low: Queue::new(Low::new()),
            above: Queue::new(Arcs::new()),
            awaiting: Queue::new(Awaiting::new()),
            masks: WindowMasks::new(),
            falling_platform: FallingPlatform::new(),
            times: Times::new(),
            impacts: Impacts::new(),
            low_platforms: Platforms::new(),
            above_platforms: Platforms::new(),
            hard: Vec::new(),
        }
    }

    /// Runs other loops over lanes with the same instructions.
    pub(crate) const fn dispatch(&self) -> Dispatch {
        self.dispatch
    }

    /// Computes the impacts of the first `lanes` launches of the batches together, and calls `failed` for
    /// each lane without an impact; the result of such a lane is meaningless.
    pub(crate) fn fly(&mut self, batches: &mut [Batch], lanes: usize, mut failed: impl FnMut(usize, Error)) {
        self.hard.clear();
        let shared = shared_platform(batches);
        for number in 0..lanes.div_ceil(LANES).min(batches.len()) {
            batches[number].turn();
            self.fly_batch(batches, number, (lanes - number * LANES).min(LANES), shared);
        }
        self.fly_slow(batches, shared);
        self.fly_low(batches, shared);
        self.fly_above(batches, shared);
        self.fly_awaiting(batches);
        // In the order of the lanes, so that the first failure does not depend on how flights were collected.
        self.hard.sort_unstable_by_key(|who| (who.batch, who.lane));
        for &who in &self.hard {
            let (lane, batch) = (who.lane as usize, &mut batches[who.batch as usize]);
            match batch.vibrations[lane].impact_after(batch.launch_phase(lane), batch.speed[lane]) {
                Ok(impact) => batch.impacts_mut().set(lane, &impact),
                Err(error) => failed(who.batch as usize * LANES + lane, error),
            }
        }
        #[cfg(debug_assertions)]
        self.assert_clocks(batches, lanes);
    }

    /// Asserts that the velocities at both ends of the flights agree with their turns and durations. Debug
    /// builds only.
    #[cfg(debug_assertions)]
    fn assert_clocks(&self, batches: &[Batch], lanes: usize) {
        if !self.timed {
            return;
        }
        for number in 0..lanes {
            // The impact of a lane that failed means nothing; such lanes are among the hard ones.
            let (batch, lane) = (&batches[number / LANES], number % LANES);
            let who = Who { batch: (number / LANES) as u32, lane: lane as u32 };
            if self.hard.contains(&who) {
                continue;
            }
            let (from, impact) = (batch.launch_phase(lane), batch.impact_state(lane));
            let (turns, known) = (batch.impacts().turns[lane], batch.impacts().duration[lane]);
            let by_phases = turns * core::f64::consts::TAU + (impact.phase().angle() - from.angle());
            let duration = if known >= 0.0 { known } else { by_phases };
            batch.vibrations[lane].assert_clock(
                from,
                batch.speed[lane],
                (impact.phase(), impact.velocity()),
                duration,
            );
            debug_assert!(
                (duration - by_phases).abs() <= 1.0e-14 * (1.0 + duration),
                "{duration} {by_phases}"
            );
        }
    }

    /// Computes the impacts of one batch if all lanes rise above the crests, otherwise adds its lanes to the
    /// queues.
    fn fly_batch(&mut self, batches: &mut [Batch], number: usize, lanes: usize, shared: Option<Platform>) {
        let Self { dispatch, timed, kinds, work, .. } = self;
        let timed = *timed;
        let (ground, rows) = batches[number].parts();
        match ground {
            Ground::Shared(platforms) => classify(*dispatch, *platforms, rows, kinds, timed),
            Ground::Own(platforms) => classify(*dispatch, platforms.as_ref(), rows, kinds, timed),
        }
        let all = Lanes::first(lanes);
        if !self.kinds.special {
            let (ground, Rows { arcs, impacts, .. }) = batches[number].parts();
            match ground {
                Ground::Shared(platforms) => {
                    dispatch.run(Fly { width: Whole, platforms: *platforms, arcs, work, impacts, timed });
                }
                Ground::Own(platforms) => {
                    dispatch.run(Fly {
                        width: Whole,
                        platforms: platforms.as_ref(),
                        arcs,
                        work,
                        impacts,
                        timed,
                    });
                }
            }
            if !self.work.all {
                for lane in all.without(self.work.landed()) {
                    let who = Who { batch: number as u32, lane: lane as u32 };
                    self.keep_falling(batches, who, self.work.reached(lane));
                }
            }
            return;
        }
        let (slow, low) = (lanes_of(&self.kinds.slow) & all, lanes_of(&self.kinds.low) & all);
        self.queue_slow(batches, number, shared, slow, low);
        self.queue_low(batches, number, shared, low.without(slow));
        self.queue_above(batches, number, shared, all.without(slow | low));
    }

    /// Adds slow lanes of a batch to their queue, some of which are also `low`.
    #[inline(always)]
    fn queue_slow(
        &mut self,
        batches: &mut [Batch],
        number: usize,
        shared: Option<Platform>,
        mut lanes: Lanes,
        low: Lanes,
    ) {
        while !lanes.is_none() {
            let (batch, queue) = (&batches[number], &mut self.slow);
            queue.fill(number, &mut lanes, |rows, k, lane| {
                let platform = shared.unwrap_or_else(|| batch.platform(lane));
                rows.set(k, &platform, batch.launches(), lane, low.has(lane));
            });
            if queue.len == LANES {
                self.fly_slow(batches, shared);
            }
        }
    }

    /// Adds lanes of a batch that may be hit before the first crest to their queue.
    #[inline(always)]
    fn queue_low(
        &mut self,
        batches: &mut [Batch],
        number: usize,
        shared: Option<Platform>,
        mut lanes: Lanes,
    ) {
        while !lanes.is_none() {
            let (batch, queue, platforms) = (&batches[number], &mut self.low, &mut self.low_platforms);
            queue.fill(number, &mut lanes, |rows, k, lane| {
                take_low(rows, platforms, k, (batch, lane), shared);
            });
            if queue.len == LANES {
                self.fly_low(batches, shared);
            }
        }
    }

    /// Adds lanes of a batch that rise above the crests to their queue; those that do not come down within
    /// the longest flight are hard.
    #[inline(always)]
    fn queue_above(
        &mut self,
        batches: &mut [Batch],
        number: usize,
        shared: Option<Platform>,
        mut lanes: Lanes,
    ) {
        let speeds = &batches[number].arcs.speed;
        for lane in lanes {
            let comes_down = speeds[lane] >= FASTEST_ARC;
            if !comes_down {
                self.hard.push(Who { batch: number as u32, lane: lane as u32 });
                lanes.remove(lane);
            }
        }
        while !lanes.is_none() {
            let (batch, queue, platforms) = (&batches[number], &mut self.above, &mut self.above_platforms);
            queue.fill(number, &mut lanes, |rows, k, lane| {
                take_above(rows, platforms, k, (batch, lane), shared);
            });
            if queue.len == LANES {
                self.fly_above(batches, shared);
            }
        }
    }

    #[inline(always)]
    fn go_low(&mut self, batches: &mut [Batch], who: Who, shared: Option<Platform>) {
        let (batch, lane) = (&batches[who.batch as usize], who.lane as usize);
        let k = self.low.place(who);
        take_low(&mut self.low.rows, &mut self.low_platforms, k, (batch, lane), shared);
        if self.low.len == LANES {
            self.fly_low(batches, shared);
        }
    }

    #[inline(always)]
    fn go_above(&mut self, batches: &mut [Batch], who: Who, shared: Option<Platform>) {
        let (batch, lane) = (&batches[who.batch as usize], who.lane as usize);
        let comes_down = batch.arcs.speed[lane] >= FASTEST_ARC;
        if !comes_down {
            self.hard.push(who);
            return;
        }
        let k = self.above.place(who);
        take_above(&mut self.above.rows, &mut self.above_platforms, k, (batch, lane), shared);
        if self.above.len == LANES {
            self.fly_above(batches, shared);
        }
    }
}

/// Takes over the launch of a lane that may be hit before the first crest as number `k`.
#[inline(always)]
fn take_low(
    rows: &mut Low,
    platforms: &mut Platforms,
    k: usize,
    (batch, lane): (&Batch, usize),
    shared: Option<Platform>,
) {
    let platform = shared.unwrap_or_else(|| batch.platform(lane));
    rows.set(k, &platform, batch.launches(), lane);
    if shared.is_none() {
        platforms.set(k, platform);
    }
}

/// Takes over the arc of a lane that rises above the crests as number `k`.
#[inline(always)]
fn take_above(
    rows: &mut Arcs,
    platforms: &mut Platforms,
    k: usize,
    (batch, lane): (&Batch, usize),
    shared: Option<Platform>,
) {
    rows.take(k, &batch.arcs, lane);
    if shared.is_none() {
        platforms.set(k, batch.platform(lane));
    }
}

/// Sorts the launches of a batch; those of `timed` flights are set.
fn classify<P: PlatformLanes>(
    dispatch: Dispatch,
    platforms: P,
    rows: Rows<'_>,
    kinds: &mut Kinds,
    timed: bool,
) {
    if timed {
        dispatch.run(Classify::<_, true> { platforms, rows, kinds });
    } else {
        dispatch.run(Classify::<_, false> { platforms, rows, kinds });
    }
}

/// The platform that all lanes share, if they do.
fn shared_platform(batches: &[Batch]) -> Option<Platform> {
    let shared = |batch: &Batch| match &batch.ground {
        Ground::Shared(platform) => Some(*platform),
        Ground::Own(_) => None,
    };
    let first = shared(batches.first()?)?;
    batches.iter().all(|batch| shared(batch) == Some(first)).then_some(first)
}

/// Flights of one kind, until there are enough of them.
#[derive(Debug, Clone)]
pub(super) struct Queue<Rows> {
    pub(super) rows: Rows,
    pub(super) who: [Who; LANES],
    pub(super) len: usize,
}

impl<Rows> Queue<Rows> {
    pub(super) const fn new(rows: Rows) -> Self {
        Self { rows, who: [Who::NONE; LANES], len: 0 }
    }

    /// The place of one more flight; there must be room for it.
    #[inline(always)]
    pub(super) const fn place(&mut self, who: Who) -> usize {
        let k = self.len % LANES;
        self.who[k] = who;
        self.len = k + 1;
        k
    }

    /// Takes flights of a batch from `lanes` until no lane is left or there is no room; `set` receives the
    /// place of each.
    #[inline(always)]
    pub(super) fn fill(
        &mut self,
        batch: usize,
        lanes: &mut Lanes,
        mut set: impl FnMut(&mut Rows, usize, usize),
    ) {
        let mut k = self.len;
        while k < LANES
            && let Some(lane) = lanes.next()
        {
            self.who[k] = Who { batch: batch as u32, lane: lane as u32 };
            set(&mut self.rows, k, lane);
            k += 1;
        }
        self.len = k;
    }
}
