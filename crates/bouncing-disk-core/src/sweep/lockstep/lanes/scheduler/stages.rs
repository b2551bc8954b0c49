//! The stages of the flights of each kind: computed once their queue is full, and sorted by outcome.

use super::FlightScheduler;
use super::Queue;
use crate::sweep::lockstep::lanes::above::Fly;
use crate::sweep::lockstep::lanes::awaiting;
use crate::sweep::lockstep::lanes::low;
use crate::sweep::lockstep::lanes::platform::Platform;
use crate::sweep::lockstep::lanes::root::{Advance, Finish};
use crate::sweep::lockstep::lanes::short::{self, Fate};
use crate::sweep::lockstep::lanes::{Batch, Impacts, LANES, Lanes, Sixteens, Who, lanes_of};

impl FlightScheduler {
    pub(super) fn fly_slow(&mut self, batches: &mut [Batch], shared: Option<Platform>) {
        let count = self.slow.len;
        if count == 0 {
            return;
        }
        let (short, impacts) = (&mut self.slow.rows, &mut self.impacts);
        self.dispatch.run(short::Solve { short, count, impacts });
        self.slow.len = 0;
        let all = Lanes::first(count);
        let landed = self.slow.rows.landed() & all;
        for k in landed {
            land(batches, self.slow.who[k], &self.impacts, k, self.timed);
        }
        for k in all.without(landed) {
            let who = self.slow.who[k];
            match self.slow.rows.fate(k) {
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
        let Self { dispatch, low: Queue { rows: low, .. }, times, impacts, masks, .. } = self;
        if let Some(platforms) = shared {
            dispatch.run(low::Windows { width, platforms, low, times, masks });
        } else {
            let platforms = &self.low_platforms;
            dispatch.run(low::Windows { width, platforms, low, times, masks });
        }
        let all = Lanes::first(count);
        let open = lanes_of(&masks.open) & all;
        let clear = lanes_of(&masks.clears) & all.without(open);
        dispatch.run(Advance { width, forms: &mut *low, times: &mut *times });
        let near = lanes_of(&times.near) & open;
        dispatch.run(Finish { width, forms: low, times, impacts });
        self.low.len = 0;
        for k in near {
            land(batches, self.low.who[k], &self.impacts, k, self.timed);
        }
        for k in clear {
            self.go_above(batches, self.low.who[k], shared);
        }
        for k in all.without(near | clear) {
            self.hard.push(self.low.who[k]);
        }
    }

    pub(super) fn fly_above(&mut self, batches: &mut [Batch], shared: Option<Platform>) {
        let count = self.above.len;
        if count == 0 {
            return;
        }
        let width = Sixteens::holding(count);
        let Self { dispatch, timed, above: Queue { rows: arcs, .. }, work, impacts, .. } = self;
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
            land(batches, self.above.who[k], &self.impacts, k, timed);
        }
        for k in Lanes::first(count).without(landed) {
            self.keep_falling(batches, self.above.who[k], self.work.reached(k));
        }
    }

    /// Goes on with a lane at the height of the crests, from the time that a first step has reached, or from
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
            dispatch, awaiting: Queue { rows: awaiting, .. }, falling_platform, times, impacts, ..
        } = self;
        dispatch.run(awaiting::Windows { width, awaiting, falling_platform, times });
        dispatch.run(Advance { width, forms: &mut *awaiting, times: &mut *times });
        dispatch.run(Finish { width, forms: awaiting, times, impacts });
        self.awaiting.len = 0;
        let all = Lanes::first(count);
        let near = lanes_of(&times.near) & lanes_of(&falling_platform.open) & all;
        for k in all.without(near) {
            self.hard.push(self.awaiting.who[k]);
        }
        for k in near {
            land(batches, self.awaiting.who[k], &self.impacts, k, self.timed);
        }
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
