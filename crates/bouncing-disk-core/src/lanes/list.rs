//! Lists of lanes.

use super::LANES;

/// Some lanes, each at most once.
#[derive(Debug, Clone)]
pub(super) struct List {
    lanes: [u8; LANES],
    len: usize,
}

impl List {
    pub(super) const fn new() -> Self {
        Self { lanes: [0; LANES], len: 0 }
    }

    pub(super) const fn len(&self) -> usize {
        self.len
    }

    pub(super) const fn clear(&mut self) {
        self.len = 0;
    }

    pub(super) const fn truncate(&mut self, len: usize) {
        self.len = len;
    }

    /// Adds a lane where all bits of the mask are set, without a branch: which kind of flight a lane makes cannot be
    /// predicted.
    #[inline(always)]
    pub(super) fn push_where(&mut self, mask: u64, lane: usize) {
        self.lanes[self.len % LANES] = lane as u8;
        self.len += (mask & 1) as usize;
    }

    #[inline(always)]
    pub(super) fn push(&mut self, lane: usize) {
        self.push_where(u64::MAX, lane);
    }

    pub(super) const fn swap(&mut self, a: usize, b: usize) {
        self.lanes.swap(a, b);
    }

    #[inline(always)]
    pub(super) fn lane(&self, k: usize) -> usize {
        usize::from(self.lanes[k])
    }

    #[inline(always)]
    pub(super) fn iter(&self) -> impl Iterator<Item = usize> + '_ {
        self.lanes.iter().take(self.len).map(|&lane| usize::from(lane))
    }
}
