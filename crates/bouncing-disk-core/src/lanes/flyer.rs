//! Sorts launches by the kind of flight that follows, and computes each kind together.

use super::above::{Fly, Work};
use super::classify::{Classify, Kinds};
use super::fallen::{self, Behind, Fallen};
use super::low::{self, Dips, Low, Verdicts};
use super::platform::{Platform, Platforms};
use super::search::{Advance, Finish, Forms, Search, Times};
use super::short::{self, Fate, Short};
use super::{Arcs, Batch, Dispatch, Ground, Impacts, InstructionSet, LANES, Lanes, Who, lanes_of, wide};
use crate::error::Error;

/// Evaluations of low and fallen flights before those that need more are left to the search.
const AT_ONCE: u8 = 2;

/// Flights under search are taken further once there are [`LANES`] of them, until so many are left.
const LEFT: usize = LANES / 2;

/// Computes the flights of batches of lanes.
#[derive(Debug, Clone)]
pub(crate) struct Flyer {
    dispatch: Dispatch,
    /// Whether impacts get their turns and durations.
    timed: bool,
    kinds: Kinds,
    work: Work,
    slow: Queue<Short>,
    low: Queue<Low>,
    dips: Queue<Low>,
    above: Queue<Arcs>,
    fallen: Queue<Fallen>,
    low_search: Search<Low>,
    fallen_search: Search<Fallen>,
    verdicts: Verdicts,
    dip_verdicts: Verdicts,
    behind: Behind,
    /// Windows: flights of one kind are added to another while their own are read.
    low_windows: Times,
    dip_windows: Times,
    fallen_windows: Times,
    /// The platforms of `low` and of `above`, unless all lanes share one.
    low_platforms: Platforms,
    above_platforms: Platforms,
    slow_impacts: Impacts,
    low_impacts: Impacts,
    above_impacts: Impacts,
    fallen_impacts: Impacts,
    hard: Vec<Who>,
}

/// Flights of one kind, until there are enough of them.
#[derive(Debug, Clone)]
struct Queue<Rows> {
    rows: Rows,
    who: [Who; LANES],
    len: usize,
}

impl<Rows> Queue<Rows> {
    const fn new(rows: Rows) -> Self {
        Self { rows, who: [Who::NONE; LANES], len: 0 }
    }

    /// The place of one more flight; there must be room for it.
    #[inline(always)]
    const fn place(&mut self, who: Who) -> usize {
        let k = self.len % LANES;
        self.who[k] = who;
        self.len = k + 1;
        k
    }
}

impl Flyer {
    /// Flights computed with these instructions; `timed` if the durations of flights and their turns are asked for.
    pub(crate) fn new(set: InstructionSet, timed: bool) -> Self {
        Self {
            dispatch: Dispatch::new(set),
            timed,
            kinds: Kinds::new(),
            work: Work::new(),
            slow: Queue::new(Short::new()),
            low: Queue::new(Low::new()),
            dips: Queue::new(Low::new()),
            above: Queue::new(Arcs::new()),
            fallen: Queue::new(Fallen::new()),
            low_search: Search::new(Low::new()),
            fallen_search: Search::new(Fallen::new()),
            verdicts: Verdicts::new(),
            dip_verdicts: Verdicts::new(),
            behind: Behind::new(),
            low_windows: Times::new(),
            dip_windows: Times::new(),
            fallen_windows: Times::new(),
            low_platforms: Platforms::new(),
            above_platforms: Platforms::new(),
            slow_impacts: Impacts::new(),
            low_impacts: Impacts::new(),
            above_impacts: Impacts::new(),
            fallen_impacts: Impacts::new(),
            hard: Vec::new(),
        }
    }

    /// Runs other loops over lanes with the same instructions.
    pub(crate) const fn dispatch(&self) -> Dispatch {
        self.dispatch
    }

    /// Computes the impacts of the first `lanes` launches of the batches together; `failed` is told of each lane that has
    /// none, and whose impact is then meaningless.
    pub(crate) fn fly(&mut self, batches: &mut [Batch], lanes: usize, mut failed: impl FnMut(usize, Error)) {
        self.hard.clear();
        let shared = shared_platform(batches);
        for number in 0..lanes.div_ceil(LANES).min(batches.len()) {
            batches[number].turn();
            self.fly_batch(batches, number, (lanes - number * LANES).min(LANES), shared);
        }
        self.fly_slow(batches, shared);
        self.fly_low(batches, shared);
        self.settle_dips(batches, shared);
        self.search_low(batches, 0);
        self.fly_above(batches, shared);
        self.fly_fallen(batches);
        self.search_fallen(batches, 0);
        // In the order of the lanes, so that the first failure does not depend on how flights were collected.
        self.hard.sort_unstable_by_key(|who| (who.batch, who.lane));
        for &who in &self.hard {
            let (lane, batch) = (who.lane as usize, &mut batches[who.batch as usize]);
            match batch.vibrations[lane].impact_after(batch.launch_phase(lane), batch.speed[lane]) {
                Ok(impact) => batch.impacts_mut().set(lane, &impact),
                Err(error) => failed(who.batch as usize * LANES + lane, error),
            }
        }
    }

    /// Computes the impacts of one batch where all lanes rise above the crests, else adds its lanes to the queues.
    fn fly_batch(&mut self, batches: &mut [Batch], number: usize, lanes: usize, shared: Option<Platform>) {
        let Self { dispatch, timed, kinds, work, .. } = self;
        let timed = *timed;
        let (ground, launches, arcs, impacts) = batches[number].parts();
        match ground {
            Ground::Shared(platforms) => {
                dispatch.run(Classify { platforms: *platforms, launches, kinds, arcs });
            }
            Ground::Own(platforms) => {
                dispatch.run(Classify { platforms: platforms.as_ref(), launches, kinds, arcs });
            }
        }
        let all = Lanes::first(lanes);
        let who = |lane| Who { batch: number as u32, lane: lane as u32 };
        if !self.kinds.special {
            match ground {
                Ground::Shared(platforms) => {
                    dispatch.run(Fly::<_, LANES> { platforms: *platforms, arcs, work, impacts, timed });
                }
                Ground::Own(platforms) => {
                    dispatch.run(Fly::<_, LANES> {
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
                    self.keep_falling(batches, who(lane), self.work.reached(lane));
                }
            }
            return;
        }
        let (slow, low) = (lanes_of(&self.kinds.slow) & all, lanes_of(&self.kinds.low) & all);
        for lane in slow {
            self.go_slow(batches, who(lane), shared, low.has(lane));
        }
        for lane in low.without(slow) {
            self.go_low(batches, who(lane), shared);
        }
        for lane in all.without(slow | low) {
            self.go_above(batches, who(lane), shared);
        }
    }

    #[inline(always)]
    fn go_slow(&mut self, batches: &mut [Batch], who: Who, shared: Option<Platform>, low: bool) {
        let (batch, lane) = (&batches[who.batch as usize], who.lane as usize);
        let k = self.slow.place(who);
        let platform = shared.unwrap_or_else(|| batch.platform(lane));
        self.slow.rows.set(k, &platform, batch.launches(), lane, low);
        if self.slow.len == LANES {
            self.fly_slow(batches, shared);
        }
    }

    #[inline(always)]
    fn go_low(&mut self, batches: &mut [Batch], who: Who, shared: Option<Platform>) {
        let (batch, lane) = (&batches[who.batch as usize], who.lane as usize);
        let k = self.low.place(who);
        let platform = shared.unwrap_or_else(|| batch.platform(lane));
        self.low.rows.set(k, &platform, batch.launches(), lane);
        if shared.is_none() {
            self.low_platforms.set(k, platform);
        }
        if self.low.len == LANES {
            self.fly_low(batches, shared);
        }
    }

    #[inline(always)]
    fn go_above(&mut self, batches: &mut [Batch], who: Who, shared: Option<Platform>) {
        let (batch, lane) = (&batches[who.batch as usize], who.lane as usize);
        let k = self.above.place(who);
        self.above.rows.take(k, &batch.arcs, lane);
        if shared.is_none() {
            self.above_platforms.set(k, batch.platform(lane));
        }
        if self.above.len == LANES {
            self.fly_above(batches, shared);
        }
    }

    fn fly_slow(&mut self, batches: &mut [Batch], shared: Option<Platform>) {
        let count = self.slow.len;
        if count == 0 {
            return;
        }
        let (short, impacts) = (&mut self.slow.rows, &mut self.slow_impacts);
        wide!(count, N => self.dispatch.run(short::Solve::<N> { short, count, impacts }));
        self.slow.len = 0;
        for k in 0..count {
            let who = self.slow.who[k];
            match self.slow.rows.fate(k) {
                Fate::Landed => land(batches, who, &self.slow_impacts, k, self.timed),
                Fate::GoesLow => self.go_low(batches, who, shared),
                Fate::GoesAbove => self.go_above(batches, who, shared),
                Fate::Doubtful => self.hard.push(who),
            }
        }
    }

    fn fly_low(&mut self, batches: &mut [Batch], shared: Option<Platform>) {
        let count = self.low.len;
        if count == 0 {
            return;
        }
        let Self { dispatch, low: Queue { rows: low, .. }, low_windows: times, verdicts, .. } = self;
        if let Some(platforms) = shared {
            wide!(count, N => dispatch.run(low::Windows::<_, N> { platforms, low, times, verdicts }));
        } else {
            let platforms = &self.low_platforms;
            wide!(count, N => dispatch.run(low::Windows::<_, N> { platforms, low, times, verdicts }));
        }
        let all = Lanes::first(count);
        let open = lanes_of(&verdicts.open) & all;
        let clear = lanes_of(&verdicts.clears) & all.without(open);
        let doubtful = lanes_of(&verdicts.dips) & all.without(open | clear);
        // Before their windows shrink.
        for k in doubtful {
            let slot = self.dips.place(self.low.who[k]);
            self.dips.rows.copy(slot, &self.low.rows, k);
            self.dip_windows.take(slot, &self.low_windows, k);
            if self.dips.len == LANES {
                self.settle_dips(batches, shared);
            }
        }
        let Self { dispatch, low: Queue { rows: low, .. }, low_windows: times, .. } = self;
        let (evaluations, steps_on) = (AT_ONCE, false);
        wide!(count, N => dispatch.run(Advance::<_, N> { forms: low, times, evaluations, steps_on }));
        self.low.len = 0;
        let near = lanes_of(&times.near) & open;
        for k in open.without(near) {
            self.low_search.add(self.low.who[k], &self.low.rows, &self.low_windows, k, AT_ONCE - 1);
            if self.low_search.is_full() {
                self.search_low(batches, LEFT);
            }
        }
        for k in clear {
            self.go_above(batches, self.low.who[k], shared);
        }
        for k in all.without(open | clear | doubtful) {
            self.hard.push(self.low.who[k]);
        }
        let Self {
            dispatch, low: Queue { rows: forms, .. }, low_windows: times, low_impacts: impacts, ..
        } = self;
        wide!(count, N => dispatch.run(Finish::<_, N> { forms, times, impacts }));
        for k in near {
            land(batches, self.low.who[k], &self.low_impacts, k, self.timed);
        }
    }

    /// Decides whether launches dip below the platform between inflection and crest.
    fn settle_dips(&mut self, batches: &mut [Batch], shared: Option<Platform>) {
        let count = self.dips.len;
        if count == 0 {
            return;
        }
        let Self {
            dispatch, dips: Queue { rows: low, .. }, dip_windows: times, dip_verdicts: verdicts, ..
        } = self;
        wide!(count, N => dispatch.run(Dips::<N> { low, times, verdicts }));
        self.dips.len = 0;
        for k in 0..count {
            let who = self.dips.who[k];
            if self.dip_verdicts.open[k] != 0 {
                self.low_search.add(who, &self.dips.rows, &self.dip_windows, k, 0);
                if self.low_search.is_full() {
                    self.search_low(batches, LEFT);
                }
            } else if self.dip_verdicts.clears[k] != 0 {
                self.go_above(batches, who, shared);
            } else {
                self.hard.push(who);
            }
        }
    }

    fn fly_above(&mut self, batches: &mut [Batch], shared: Option<Platform>) {
        let count = self.above.len;
        if count == 0 {
            return;
        }
        let Self { dispatch, timed, above: Queue { rows: arcs, .. }, work, above_impacts: impacts, .. } =
            self;
        let timed = *timed;
        if let Some(platforms) = shared {
            wide!(count, N => dispatch.run(Fly::<_, N> { platforms, arcs, work, impacts, timed }));
        } else {
            let platforms = &self.above_platforms;
            wide!(count, N => dispatch.run(Fly::<_, N> { platforms, arcs, work, impacts, timed }));
        }
        self.above.len = 0;
        let landed = work.landed() & Lanes::first(count);
        for k in landed {
            land(batches, self.above.who[k], &self.above_impacts, k, timed);
        }
        for k in Lanes::first(count).without(landed) {
            self.keep_falling(batches, self.above.who[k], self.work.reached(k));
        }
    }

    /// Goes on with a lane at the height of the crests, from the time that a first step has led to, or from zero.
    fn keep_falling(&mut self, batches: &mut [Batch], who: Who, reached: f64) {
        let (batch, lane) = (&batches[who.batch as usize], who.lane as usize);
        if batch.arcs.regular[lane] == 0 {
            self.hard.push(who);
            return;
        }
        let platform = batch.platform(lane);
        let place = self.fallen.place(who);
        self.fallen.rows.set(place, &batch.arcs, lane, reached);
        self.behind.set(place, &platform);
        if self.fallen.len == LANES {
            self.fly_fallen(batches);
        }
    }

    fn fly_fallen(&mut self, batches: &mut [Batch]) {
        let count = self.fallen.len;
        if count == 0 {
            return;
        }
        let Self { dispatch, fallen: Queue { rows: fallen, .. }, behind, fallen_windows: times, .. } = self;
        wide!(count, N => dispatch.run(fallen::Windows::<N> { fallen, behind, times }));
        let (evaluations, steps_on) = (AT_ONCE, false);
        wide!(count, N => dispatch.run(Advance::<_, N> { forms: fallen, times, evaluations, steps_on }));
        self.fallen.len = 0;
        let all = Lanes::first(count);
        let open = lanes_of(&behind.open) & all;
        let near = lanes_of(&times.near) & open;
        for k in all.without(open) {
            self.hard.push(self.fallen.who[k]);
        }
        for k in open.without(near) {
            let (who, forms, windows) = (self.fallen.who[k], &self.fallen.rows, &self.fallen_windows);
            self.fallen_search.add(who, forms, windows, k, forms.evaluations(k) + (AT_ONCE - 1));
            if self.fallen_search.is_full() {
                self.search_fallen(batches, LEFT);
            }
        }
        let Self {
            dispatch,
            fallen: Queue { rows: forms, .. },
            fallen_windows: times,
            fallen_impacts: impacts,
            ..
        } = self;
        wide!(count, N => dispatch.run(Finish::<_, N> { forms, times, impacts }));
        for k in near {
            land(batches, self.fallen.who[k], &self.fallen_impacts, k, self.timed);
        }
    }

    fn search_low(&mut self, batches: &mut [Batch], left: usize) {
        let Self { dispatch, low_search, hard, timed, .. } = self;
        let timed = *timed;
        low_search.go_on(
            *dispatch,
            left,
            |who, from, k| land(batches, who, from, k, timed),
            |who| hard.push(who),
        );
    }

    fn search_fallen(&mut self, batches: &mut [Batch], left: usize) {
        let Self { dispatch, fallen_search, hard, timed, .. } = self;
        let timed = *timed;
        fallen_search.go_on(
            *dispatch,
            left,
            |who, from, k| land(batches, who, from, k, timed),
            |who| hard.push(who),
        );
    }
}

#[inline(always)]
fn land(batches: &mut [Batch], who: Who, from: &Impacts, k: usize, timed: bool) {
    let (impacts, lane) = (batches[who.batch as usize].impacts_mut(), who.lane as usize);
    impacts.take(lane, from, k);
    if timed {
        impacts.take_time(lane, from, k);
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
