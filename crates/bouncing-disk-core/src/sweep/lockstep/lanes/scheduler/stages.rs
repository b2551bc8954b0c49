//! The stages of the flights of each kind: computed once their queue is full, and sorted by outcome.

use super::FlightScheduler;
use super::Queue;
use crate::sweep::lockstep::lanes::above::Fly;
use crate::sweep::lockstep::lanes::awaiting;
use crate::sweep::lockstep::lanes::low::{self, Dips};
use crate::sweep::lockstep::lanes::platform::Platform;
use crate::sweep::lockstep::lanes::root::{Advance, Finish, Forms, Search};
use crate::sweep::lockstep::lanes::short::{self, Fate};
use crate::sweep::lockstep::lanes::{Batch, Dispatch, Impacts, LANES, Lanes, Sixteens, Who, lanes_of};

/// Evaluations of low and fallen flights before those that need more are left to the search.
const AT_ONCE: u8 = 2;

/// Flights under search are taken further once there are [`LANES`] of them, until so many are left.
const LEFT: usize = LANES / 2;

impl FlightScheduler {
    pub(super) fn fly_slow(&mut self, batches: &mut [Batch], shared: Option<Platform>) {
        let count = self.slow.len;
        if count == 0 {
            return;
        }
        let (short, impacts) = (&mut self.slow.rows, &mut self.slow_impacts);
        self.dispatch.run(short::Solve { short, count, impacts });
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

    pub(super) fn fly_low(&mut self, batches: &mut [Batch], shared: Option<Platform>) {
        let count = self.low.len;
        if count == 0 {
            return;
        }
        let width = Sixteens::holding(count);
        let Self { dispatch, low: Queue { rows: low, .. }, low_windows: times, masks, .. } = self;
        if let Some(platforms) = shared {
            dispatch.run(low::Windows { width, platforms, low, times, masks });
        } else {
            let platforms = &self.low_platforms;
            dispatch.run(low::Windows { width, platforms, low, times, masks });
        }
        let all = Lanes::first(count);
        let open = lanes_of(&masks.open) & all;
        let clear = lanes_of(&masks.clears) & all.without(open);
        let doubtful = lanes_of(&masks.dips) & all.without(open | clear);
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
        dispatch.run(Advance { width, forms: low, times, evaluations, steps_on });
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
        dispatch.run(Finish { width, forms, times, impacts });
        for k in near {
            land(batches, self.low.who[k], &self.low_impacts, k, self.timed);
        }
    }

    /// Decides whether launches dip below the platform between inflection and crest.
    pub(super) fn settle_dips(&mut self, batches: &mut [Batch], shared: Option<Platform>) {
        let count = self.dips.len;
        if count == 0 {
            return;
        }
        let width = Sixteens::holding(count);
        let Self { dispatch, dips: Queue { rows: low, .. }, dip_windows: times, dip_masks: masks, .. } = self;
        dispatch.run(Dips { width, low, times, masks });
        self.dips.len = 0;
        for k in 0..count {
            let who = self.dips.who[k];
            if self.dip_masks.open[k] != 0 {
                self.low_search.add(who, &self.dips.rows, &self.dip_windows, k, 0);
                if self.low_search.is_full() {
                    self.search_low(batches, LEFT);
                }
            } else if self.dip_masks.clears[k] != 0 {
                self.go_above(batches, who, shared);
            } else {
                self.hard.push(who);
            }
        }
    }

    pub(super) fn fly_above(&mut self, batches: &mut [Batch], shared: Option<Platform>) {
        let count = self.above.len;
        if count == 0 {
            return;
        }
        let width = Sixteens::holding(count);
        let Self { dispatch, timed, above: Queue { rows: arcs, .. }, work, above_impacts: impacts, .. } =
            self;
        let timed = *timed;
        if let Some(platforms) = shared {
            dispatch.run(Fly { width, platforms, arcs, work, impacts, timed });
        } else {
            let platforms = &self.above_platforms;
            dispatch.run(Fly { width, platforms, arcs, work, impacts, timed });
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

    /// Goes on with a lane at the height of the crests, from the time that a first step has led to, or from
    /// zero.
    pub(super) fn keep_falling(&mut self, batches: &mut [Batch], who: Who, reached: f64) {
        let (batch, lane) = (&batches[who.batch as usize], who.lane as usize);
        let platform = batch.platform(lane);
        let place = self.awaiting.place(who);
        self.awaiting.rows.set(place, &batch.arcs, lane, reached);
        self.falling_platform.set(place, &platform);
        if self.awaiting.len == LANES {
            self.fly_awaiting(batches);
        }
    }

    pub(super) fn fly_awaiting(&mut self, batches: &mut [Batch]) {
        let count = self.awaiting.len;
        if count == 0 {
            return;
        }
        let width = Sixteens::holding(count);
        let Self {
            dispatch,
            awaiting: Queue { rows: awaiting, .. },
            falling_platform,
            awaiting_windows: times,
            ..
        } = self;
        dispatch.run(awaiting::Windows { width, awaiting, falling_platform, times });
        let (evaluations, steps_on) = (AT_ONCE, false);
        dispatch.run(Advance { width, forms: awaiting, times, evaluations, steps_on });
        self.awaiting.len = 0;
        let all = Lanes::first(count);
        let open = lanes_of(&falling_platform.open) & all;
        let near = lanes_of(&times.near) & open;
        for k in all.without(open) {
            self.hard.push(self.awaiting.who[k]);
        }
        for k in open.without(near) {
            let (who, forms, windows) = (self.awaiting.who[k], &self.awaiting.rows, &self.awaiting_windows);
            self.awaiting_search.add(who, forms, windows, k, forms.evaluations(k) + (AT_ONCE - 1));
            if self.awaiting_search.is_full() {
                self.search_awaiting(batches, LEFT);
            }
        }
        let Self {
            dispatch,
            awaiting: Queue { rows: forms, .. },
            awaiting_windows: times,
            awaiting_impacts: impacts,
            ..
        } = self;
        dispatch.run(Finish { width, forms, times, impacts });
        for k in near {
            land(batches, self.awaiting.who[k], &self.awaiting_impacts, k, self.timed);
        }
    }

    pub(super) fn search_low(&mut self, batches: &mut [Batch], left: usize) {
        let Self { dispatch, low_search, hard, timed, .. } = self;
        go_on(low_search, *dispatch, left, batches, *timed, hard);
    }

    pub(super) fn search_awaiting(&mut self, batches: &mut [Batch], left: usize) {
        let Self { dispatch, awaiting_search, hard, timed, .. } = self;
        go_on(awaiting_search, *dispatch, left, batches, *timed, hard);
    }
}

/// Goes on with a search until at most `left` flights remain.
#[inline(always)]
fn go_on<F: Forms>(
    search: &mut Search<F>,
    dispatch: Dispatch,
    left: usize,
    batches: &mut [Batch],
    timed: bool,
    hard: &mut Vec<Who>,
) {
    search.go_on(dispatch, left, |who, from, k| land(batches, who, from, k, timed), |who| hard.push(who));
}

#[inline(always)]
fn land(batches: &mut [Batch], who: Who, from: &Impacts, k: usize, timed: bool) {
    let (impacts, lane) = (batches[who.batch as usize].impacts_mut(), who.lane as usize);
    impacts.take(lane, from, k);
    if timed {
        impacts.take_time(lane, from, k);
    }
}
