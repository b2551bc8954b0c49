//! Disks that have come down to the height of the crests and need more than two evaluations, or have two windows.

use core::f64::consts::{PI, TAU};

use pulp::{Simd, WithSimd};

use super::above::Work;
use super::platform::Platform;
use super::search::{Forms, Times};
use super::{Impacts, ROW, Row, kept, mask, packed};
use crate::elementary::{CREST, nearby_wrapped_of_lane, sin_cos_of_lane};
use crate::gap::{CrestForm, Jet};

/// Packed arcs from the height of the crests.
#[derive(Debug, Clone)]
#[repr(align(64))]
pub(super) struct Fallen {
    peak: Row,
    start: Row,
    fall: Row,
    free_periods: Row,
    /// Where the curvature of the gap is negative again, and the platform's speed and depth there.
    retention: Row,
    retention_speed: Row,
    retention_depth: Row,
    doubtful_gap: Row,
}

impl Forms for Fallen {
    #[inline(always)]
    fn evaluate(&mut self, times: &mut Times, from: usize, to: usize) {
        for k in from..to {
            (times.sin[k], times.cos[k]) = sin_cos_of_lane(self.start[k] + times.time[k]);
        }
    }

    #[inline(always)]
    fn jet(&self, times: &Times, k: usize) -> Jet {
        CrestForm { peak: self.peak[k], angle: self.start[k], speed: -self.fall[k], depth: 0.0 }.jet_of_pair(
            times.time[k],
            times.sin[k],
            times.cos[k],
        )
    }

    #[inline(always)]
    fn swap(&mut self, a: usize, b: usize) {
        self.peak.swap(a, b);
        self.start.swap(a, b);
        self.fall.swap(a, b);
        self.free_periods.swap(a, b);
    }
}

/// The windows of packed arcs, as `impact_from_above` and `bracket_behind_crest` find them, except where a dip must be
/// searched.
pub(super) struct Windows<'a> {
    pub(super) fallen: &'a Fallen,
    pub(super) times: &'a mut Times,
}

impl WithSimd for Windows<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { fallen, times } = self;
        for k in 0..packed(times.lanes.len()) {
            let (fall, peak, retention) = (fallen.fall[k], fallen.peak[k], fallen.retention[k]);
            let (turned, _) = nearby_wrapped_of_lane(fallen.start[k]);
            let behind = mask(turned > CREST) & mask(turned < retention) & mask(fall < peak);
            let end = retention - turned;
            let falling = CrestForm { peak, angle: turned, speed: -fall, depth: 0.0 };
            let gap_at_end = falling.gap_over(fallen.retention_depth[k], end);
            let passed = mask(gap_at_end <= 0.0);
            let (sin, cos) = sin_cos_of_lane(turned);
            let first = -fall - peak * cos;
            let last = (-fall - end) + fallen.retention_speed[k];
            let lowest = CrestForm::lowest_of_tangents(peak - peak * sin, gap_at_end, first, last, end);
            let dips = mask(first < 0.0) & mask(last > 0.0) & mask(lowest <= fallen.doubtful_gap[k]);
            let crest = (CREST - turned) + kept(mask(turned >= CREST), TAU);
            times.lo[k] = kept(behind & !passed, end);
            times.time[k] = times.lo[k];
            times.hi[k] = if behind & passed != 0 { end } else { crest };
            times.open[k] = !behind | passed | !dips;
        }
    }
}

/// Impacts of packed arcs whose search has ended.
pub(super) struct Land<'a> {
    pub(super) fallen: &'a Fallen,
    pub(super) times: &'a Times,
    pub(super) impacts: &'a mut Impacts,
}

impl WithSimd for Land<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { fallen, times, impacts } = self;
        for k in 0..packed(times.lanes.len()) {
            let time = times.time[k];
            let velocity = (-fallen.fall[k] - time) - fallen.peak[k] * times.cos[k];
            let (wrapped, turns) = nearby_wrapped_of_lane(fallen.start[k] + time);
            impacts.angle[k] = kept(mask(wrapped < TAU), wrapped);
            impacts.sin[k] = times.sin[k];
            impacts.cos[k] = times.cos[k];
            impacts.velocity[k] = kept(mask(velocity < 0.0), velocity);
            impacts.turns[k] = fallen.free_periods[k] + turns;
        }
    }
}

impl Fallen {
    pub(super) const fn new() -> Self {
        Self {
            peak: ROW,
            start: ROW,
            fall: ROW,
            free_periods: ROW,
            retention: ROW,
            retention_speed: ROW,
            retention_depth: ROW,
            doubtful_gap: ROW,
        }
    }

    /// Adds an arc that `work` has brought down to the height of the crests.
    #[inline(always)]
    pub(super) fn set(&mut self, k: usize, platform: Platform, work: &Work, from: usize) {
        self.peak[k] = platform.peak;
        self.start[k] = work.start[from];
        self.fall[k] = work.fall[from];
        self.free_periods[k] = work.free_periods[from];
        self.retention[k] = PI - platform.separation_angle;
        self.retention_speed[k] = platform.separation_speed;
        self.retention_depth[k] = platform.separation_depth;
        self.doubtful_gap[k] = platform.doubtful_gap;
    }
}
