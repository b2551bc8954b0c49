//! Flights of one kind that wait for others.

use crate::lockstep::lanes::{LANES, Who};

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
}
