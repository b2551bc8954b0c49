//! Disks that have come down to the height of the crests and need more than two or three evaluations, or
//! have two windows.

use core::f64::consts::{PI, TAU};

use pulp::{Simd, WithSimd};

use super::platform::Platform;
use super::root::{Forms, Times};
use super::{Arcs, Impacts, LANES, Mask, ROW, Row, Sixteens, Width, kept, mask, pairs};
use crate::flight::gap::CrestForm;
use crate::numerics::elementary::{CREST, impact_phase_of_lane, nearby_wrapped_of_lane, sin_cos_of_lane};

/// Arcs from the height of the crests.
#[derive(Debug, Clone)]
#[repr(align(64))]
pub(super) struct Awaiting {
    start: Row,
    speed: Row,
    free_periods: Row,
    /// The time that a first step has reached, or zero.
    reached: Row,
}

impl Forms for Awaiting {
    #[inline(always)]
    fn evaluate<S: Simd>(&mut self, width: impl Width, times: &mut Times) {
        let Times { time, sin, cos, .. } = &mut *times;
        pairs::<S>(width, sin, cos, |k| self.start[k] + time[k]);
        for k in 0..width.lanes() {
            let form =
                CrestForm { peak: times.peak[k], angle: self.start[k], speed: self.speed[k], depth: 0.0 };
            let taylor = form.taylor_of_pair(times.time[k], times.sin[k], times.cos[k]);
            times.gap[k] = taylor.gap;
            times.slope[k] = taylor.slope;
        }
    }

    #[inline(always)]
    fn land<S: Simd>(&mut self, width: impl Width, times: &Times, impacts: &mut Impacts) {
        for k in 0..width.lanes() {
            let time = times.time[k];
            let velocity = (self.speed[k] - time) - times.peak[k] * times.cos[k];
            let (wrapped, turns) = impact_phase_of_lane(self.start[k] + time);
            impacts.angle[k] = wrapped;
            impacts.sin[k] = times.sin[k];
            impacts.cos[k] = times.cos[k];
            impacts.velocity[k] = kept(mask(velocity < 0.0), velocity);
            impacts.turns[k] = self.free_periods[k] + turns;
            impacts.duration[k] = Impacts::BETWEEN_PHASES;
        }
    }
}

/// Where the platform falls away below each arc.
#[derive(Debug, Clone)]
#[repr(align(64))]
pub(super) struct FallingPlatform {
    peak: Row,
    /// Where the curvature of the gap is negative again, and the platform's speed and depth there.
    retention: Row,
    retention_speed: Row,
    retention_depth: Row,
    doubtful_gap: Row,
    /// Arcs with a window.
    pub(super) open: Mask,
}

/// The windows of arcs, as `impact_from_above` and `bracket_behind_crest` find them, except where a dip must
/// be searched.
pub(super) struct Windows<'a> {
    pub(super) width: Sixteens,
    pub(super) awaiting: &'a Awaiting,
    pub(super) falling_platform: &'a mut FallingPlatform,
    pub(super) times: &'a mut Times,
}

impl WithSimd for Windows<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { width, awaiting, falling_platform: platforms, times } = self;
        for k in 0..width.lanes() {
            let (speed, peak, retention) = (awaiting.speed[k], platforms.peak[k], platforms.retention[k]);
            let (turned, _) = nearby_wrapped_of_lane(awaiting.start[k]);
            let behind = mask(turned > CREST) & mask(turned < retention) & mask(speed > -peak);
            let end = retention - turned;
            let falling = CrestForm { peak, angle: turned, speed, depth: 0.0 };
            let gap_at_end = falling.gap_over(platforms.retention_depth[k], end);
            let passed = mask(gap_at_end <= 0.0);
            let (sin, cos) = sin_cos_of_lane(turned);
            let first = speed - peak * cos;
            let last = (speed - end) + platforms.retention_speed[k];
            let lowest = CrestForm::lowest_of_tangents(peak - peak * sin, gap_at_end, first, last, end);
            let dips = mask(first < 0.0) & mask(last > 0.0) & mask(lowest <= platforms.doubtful_gap[k]);
            let crest = (CREST - turned) + kept(mask(turned >= CREST), TAU);
            times.peak[k] = peak;
            times.lo[k] = kept(behind & !passed, end);
            times.time[k] = if awaiting.reached[k] > 0.0 { awaiting.reached[k] } else { times.lo[k] };
            times.hi[k] = if behind & passed != 0 { end } else { crest };
            platforms.open[k] = !behind | passed | !dips;
        }
    }
}

impl Awaiting {
    pub(super) const fn new() -> Self {
        Self { start: ROW, speed: ROW, free_periods: ROW, reached: ROW }
    }

    /// Sets lane `k` to arc `from` of `arcs`; `reached` is the time that a first step has reached, or zero.
    #[inline(always)]
    pub(super) fn set(&mut self, k: usize, arcs: &Arcs, from: usize, reached: f64) {
        self.reached[k] = reached;
        self.start[k] = arcs.start[from];
        self.speed[k] = arcs.speed[from];
        self.free_periods[k] = arcs.free_periods[from];
    }
}

impl FallingPlatform {
    pub(super) const fn new() -> Self {
        Self {
            peak: ROW,
            retention: ROW,
            retention_speed: ROW,
            retention_depth: ROW,
            doubtful_gap: ROW,
            open: [0; LANES],
        }
    }

    #[inline(always)]
    pub(super) const fn set(&mut self, k: usize, platform: &Platform) {
        self.peak[k] = platform.peak;
        self.retention[k] = PI - platform.separation_angle;
        self.retention_speed[k] = platform.separation_speed;
        self.retention_depth[k] = platform.separation_depth;
        self.doubtful_gap[k] = platform.doubtful_gap;
    }
}
