//! The search in a window, `GapForm::root`, of many flights at once.

use crate::flight::bounds::{arc_speed, may_return_soon};
use crate::flight::first_impact::FASTEST_ARC;
use crate::flight::gap::GapTaylor;
use crate::numerics::elementary::{nearest_periods, rotated};
use crate::sweep::lockstep::lanes::platform::PlatformLanes;
use crate::sweep::lockstep::lanes::{Impacts, LANES, Mask, ROW, Row, Rows, Sixteens, Width, mask};
use pulp::{Simd, WithSimd};

/// Evaluations before the last step: flights that need more are left to the solver of one flight.
const EVALUATIONS: usize = 4;

/// Flights in one of the forms of the gap.
pub(super) trait Forms {
    /// Evaluates gaps, slopes and the pairs of the phases at the times reached.
    fn evaluate<S: Simd>(&mut self, width: impl Width, times: &mut Times);

    /// The impacts of flights whose times and pairs are those of the impact.
    fn land<S: Simd>(&mut self, width: impl Width, times: &Times, impacts: &mut Impacts);
}

/// Times reached, the windows that hold the roots, and the gaps there.
#[derive(Debug, Clone)]
#[repr(align(64))]
pub(super) struct Times {
    /// P.
    pub(super) peak: Row,
    pub(super) lo: Row,
    pub(super) hi: Row,
    pub(super) time: Row,
    pub(super) gap: Row,
    pub(super) slope: Row,
    pub(super) sin: Row,
    pub(super) cos: Row,
    root: Row,
    step: Row,
    pub(super) near: Mask,
}

impl Times {
    pub(super) const fn new() -> Self {
        Self {
            peak: ROW,
            lo: ROW,
            hi: ROW,
            time: ROW,
            gap: ROW,
            slope: ROW,
            sin: ROW,
            cos: ROW,
            root: ROW,
            step: ROW,
            near: [0; LANES],
        }
    }

    /// Gap and derivatives at the time evaluated last.
    #[inline(always)]
    pub(super) fn taylor(&self, k: usize) -> GapTaylor {
        let platform = self.peak[k] * self.sin[k];
        GapTaylor {
            gap: self.gap[k],
            slope: self.slope[k],
            curvature: platform - 1.0,
            third: self.peak[k] * self.cos[k],
            platform,
        }
    }
}

/// Evaluations, each but the first after a step if the root is not near.
pub(super) struct Advance<'a, F> {
    pub(super) width: Sixteens,
    pub(super) forms: &'a mut F,
    pub(super) times: &'a mut Times,
}

/// The last step, and the impacts.
pub(super) struct Finish<'a, F> {
    pub(super) width: Sixteens,
    pub(super) forms: &'a mut F,
    pub(super) times: &'a mut Times,
    pub(super) impacts: &'a mut Impacts,
}

impl<F: Forms> WithSimd for Advance<'_, F> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { width, forms, times } = self;
        for evaluation in 1..=EVALUATIONS {
            forms.evaluate::<S>(width, times);
            for k in 0..width.lanes() {
                times.near[k] = mask(times.taylor(k).is_near_root());
            }
            if evaluation < EVALUATIONS {
                step(width, times);
            }
        }
    }
}

#[inline(always)]
fn step(width: impl Width, times: &mut Times) {
    for k in 0..width.lanes() {
        times.root[k] = times.taylor(k).radicand().sqrt();
    }
    for k in 0..width.lanes() {
        times.step[k] = times.taylor(k).quadratic_step(times.root[k]);
    }
    for k in 0..width.lanes() {
        let taylor = times.taylor(k);
        let root = times.root[k];
        let model = taylor.corrected_step_of_lane(times.step[k], root);
        let newton = -(taylor.gap * (1.0 / taylor.slope));
        times.step[k] = if root > 0.0 { model } else { newton };
    }
    for k in 0..width.lanes() {
        let (gap, slope, t) = (times.gap[k], times.slope[k], times.time[k]);
        let above = gap > 0.0;
        let lo = if above { t } else { times.lo[k] };
        let hi = if above { times.hi[k] } else { t };
        let next = t + times.step[k];
        let fine = mask(slope < 0.0) & mask(next > lo) & mask(next < hi);
        let next = if fine != 0 { next } else { 0.5 * (lo + hi) };
        times.time[k] = if times.near[k] != 0 { t } else { next };
        times.lo[k] = lo;
        times.hi[k] = hi;
    }
}

impl<F: Forms> WithSimd for Finish<'_, F> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { width, forms, times, impacts } = self;
        for k in 0..width.lanes() {
            times.step[k] = times.taylor(k).last_step();
        }
        for k in 0..width.lanes() {
            let delta = times.step[k];
            (times.sin[k], times.cos[k]) = rotated(times.sin[k], times.cos[k], delta);
            times.time[k] += delta;
        }
        forms.land::<S>(width, times, impacts);
    }
}

/// Kinds of launches; a launch of neither kind rises above the crests.
#[derive(Debug, Clone)]
#[repr(align(64))]
pub(super) struct Kinds {
    /// May land within half a radian.
    pub(super) slow: Mask,
    /// May be hit before the first crest.
    pub(super) low: Mask,
    /// Whether any lane is slow or low, or does not come down within the longest flight.
    pub(super) special: bool,
}

impl Kinds {
    pub(super) const fn new() -> Self {
        Self { slow: [0; LANES], low: [0; LANES], special: false }
    }
}

/// Sorts the launches of a batch: those that are `SET`, otherwise those that follow the previous impacts.
pub(super) struct Classify<'a, P, const SET: bool> {
    pub(super) platforms: P,
    pub(super) rows: Rows<'a>,
    pub(super) kinds: &'a mut Kinds,
}

impl<P: PlatformLanes, const SET: bool> WithSimd for Classify<'_, P, SET> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { platforms, rows: Rows { from, speed: speeds, restitution, arcs, .. }, kinds } = self;
        for lane in 0..LANES {
            let peak = platforms.lane(lane).peak;
            let speed = if SET { speeds[lane] } else { -restitution[lane] * from.velocity[lane] };
            let (sine, cosine) = (peak * from.sin[lane], peak * from.cos[lane]);
            let disk_speed = speed + cosine;
            // No comparison with a NaN holds.
            arcs.speed[lane] = arc_speed(disk_speed, peak - sine);
            kinds.slow[lane] = mask(may_return_soon(peak, sine, cosine, speed));
            arcs.start[lane] = disk_speed;
            if !SET {
                speeds[lane] = speed;
            }
        }
        let (mut special, mut endless) = (0, 0);
        for lane in 0..LANES {
            let platform = platforms.lane(lane);
            let (angle, disk_speed, speed) = (from.angle[lane], arcs.start[lane], arcs.speed[lane]);
            // Down to the height of the crests the disk flies free.
            let (periods, rest) = nearest_periods(disk_speed - speed);
            if SET {
                arcs.free_periods[lane] = periods;
            }
            arcs.start[lane] = angle + rest;
            let low = !mask(platform.crests.surely_cleared(platform.peak, angle, disk_speed, speed));
            kinds.low[lane] = low;
            special |= low | kinds.slow[lane];
            endless |= !mask(speed >= FASTEST_ARC);
        }
        kinds.special = (special | endless) != 0;
    }
}
