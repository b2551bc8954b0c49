//! Some lanes of a batch, one bit for each.

use super::{LANES, Mask};

/// The bit of each lane.
const BIT: Mask = {
    let mut bits = [0; LANES];
    let mut lane = 0;
    while lane < LANES {
        bits[lane] = 1 << lane;
        lane += 1;
    }
    bits
};

/// The lanes whose bits are set in a mask.
#[inline(always)]
pub(crate) fn lanes_of(mask: &Mask) -> Lanes {
    Lanes(mask.iter().zip(&BIT).fold(0, |all, (mask, bit)| all | (mask & bit)))
}

/// Some lanes of a batch, from the first to the last.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Lanes(u64);

impl Lanes {
    pub(crate) const NONE: Self = Self(0);

    /// The first `count` lanes, which must be between 1 and all.
    #[inline(always)]
    pub(crate) const fn first(count: usize) -> Self {
        debug_assert!(count >= 1 && count <= LANES, "no or too many lanes");
        Self(u64::MAX >> ((LANES - count) % LANES))
    }

    pub(super) const fn is_none(self) -> bool {
        self.0 == 0
    }

    pub(super) const fn count(self) -> usize {
        self.0.count_ones() as usize
    }

    /// The members that are not in `others`.
    #[inline(always)]
    pub(super) const fn without(self, others: Self) -> Self {
        Self(self.0 & !others.0)
    }

    #[inline(always)]
    pub(crate) const fn remove(&mut self, lane: usize) {
        self.0 &= !(1 << (lane % LANES));
    }

    #[inline(always)]
    pub(super) const fn has(self, lane: usize) -> bool {
        self.0 >> (lane % LANES) & 1 != 0
    }
}

impl core::ops::BitAnd for Lanes {
    type Output = Self;

    #[inline(always)]
    fn bitand(self, other: Self) -> Self {
        Self(self.0 & other.0)
    }
}

impl core::ops::BitOr for Lanes {
    type Output = Self;

    #[inline(always)]
    fn bitor(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }
}

impl Iterator for Lanes {
    type Item = usize;

    #[inline(always)]
    fn next(&mut self) -> Option<usize> {
        if self.0 == 0 {
            return None;
        }
        let lane = self.0.trailing_zeros() as usize;
        self.0 &= self.0 - 1;
        Some(lane)
    }
}

impl DoubleEndedIterator for Lanes {
    #[inline(always)]
    fn next_back(&mut self) -> Option<usize> {
        if self.0 == 0 {
            return None;
        }
        let lane = LANES - 1 - self.0.leading_zeros() as usize;
        self.0 &= !(1 << lane);
        Some(lane)
    }
}
