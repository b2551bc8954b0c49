//! Flights of one kind that wait for others.

use crate::sweep::lockstep::lanes::{LANES, Lanes, Who};

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

    /// Takes flights of a batch from `lanes` until there are none or no more room; `set` is given the place of each.
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
