//! Impacts before the first crest: `Vibration::bracket_before_crest_of_launch`, and the form of the gap for the search
//! in its window, many at a time.

use core::f64::consts::TAU;

use pulp::{Simd, WithSimd};

use super::platform::{Below, Platform};
use super::search::{Forms, Times};
use super::{Impacts, LANES, Launches, Mask, ROW, Row, kept, mask, pairs};
use crate::elementary::{CREST, nearby_wrapped_of_lane};
use crate::flight::SHORT_FLIGHT;
use crate::gap::{CrestForm, LaunchForm};
use crate::shortcuts::{clears, clears_by_tangents};

/// Launches that may land before the first crest.
#[derive(Debug, Clone)]
#[repr(align(64))]
pub(super) struct Low {
    angle: Row,
    speed: Row,
    /// P sin and P cos at launch.
    sine: Row,
    cosine: Row,
    /// 1 - cos and sin of the time.
    versine: Row,
    sine_of_time: Row,
}

/// Launches with a window, and those that clear the crest after all.
#[derive(Debug, Clone)]
#[repr(align(64))]
pub(super) struct Verdicts {
    pub(super) open: Mask,
    pub(super) clears: Mask,
    /// Launches that clear inflection and crest, but may dip between the two.
    pub(super) dips: Mask,
}

impl Verdicts {
    pub(super) const fn new() -> Self {
        Self { open: [0; LANES], clears: [0; LANES], dips: [0; LANES] }
    }
}

impl Forms for Low {
    #[inline(always)]
    fn evaluate<S: Simd, const N: usize>(&mut self, times: &mut Times) {
        let Times { time, sin, cos, .. } = &mut *times;
        pairs::<S, N>(sin, cos, |k| self.angle[k] + time[k]);
        self.turn::<S, N>(times);
        for k in 0..N {
            let (form, of_time) = (self.form(times, k), (self.versine[k], self.sine_of_time[k]));
            times.gap[k] = form.gap_of(times.time[k], of_time);
            times.slope[k] = form.slope_of(times.time[k], of_time);
        }
    }

    #[inline(always)]
    fn land<S: Simd, const N: usize>(&mut self, times: &Times, impacts: &mut Impacts) {
        self.turn::<S, N>(times);
        for k in 0..N {
            // The velocity is the slope of the launch form at the impact.
            let time = times.time[k];
            let velocity = self.form(times, k).slope_of(time, (self.versine[k], self.sine_of_time[k]));
            let (wrapped, turns) = nearby_wrapped_of_lane(self.angle[k] + time);
            impacts.angle[k] = kept(mask(wrapped < TAU), wrapped);
            impacts.sin[k] = times.sin[k];
            impacts.cos[k] = times.cos[k];
            impacts.velocity[k] = kept(mask(velocity < 0.0), velocity);
            impacts.turns[k] = turns;
            // As a whole period and a rest.
            let period = kept(mask(time >= TAU), TAU);
            impacts.duration[k] = period + (time - period);
        }
    }

    #[inline(always)]
    fn copy(&mut self, to: usize, others: &Self, from: usize) {
        self.angle[to] = others.angle[from];
        self.speed[to] = others.speed[from];
        self.sine[to] = others.sine[from];
        self.cosine[to] = others.cosine[from];
    }

    #[inline(always)]
    fn copy_within(&mut self, to: usize, from: usize) {
        self.angle[to] = self.angle[from];
        self.speed[to] = self.speed[from];
        self.sine[to] = self.sine[from];
        self.cosine[to] = self.cosine[from];
    }
}

/// The windows of launches.
pub(super) struct Windows<'a, P, const N: usize> {
    pub(super) platforms: P,
    pub(super) low: &'a Low,
    pub(super) times: &'a mut Times,
    pub(super) verdicts: &'a mut Verdicts,
}

impl<P: Below, const N: usize> WithSimd for Windows<'_, P, N> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { platforms, low, times, verdicts } = self;
        for k in 0..N {
            let platform = platforms.lane(k);
            let (angle, speed, peak) = (low.angle[k], low.speed[k], platform.peak);
            let (sine, cosine) = (low.sine[k], low.cosine[k]);
            let rising = CrestForm { peak, angle, speed: speed + cosine, depth: peak - sine };
            let ahead = platform.separation_angle - angle;
            let inflection = if ahead > 0.0 { ahead } else { ahead + TAU };
            let crest = inflection + (CREST - platform.separation_angle);
            let at_inflection = rising.gap_over(platform.separation_depth, inflection);
            let at_crest = rising.gap_over(0.0, crest);
            let doubt = platform.doubtful_gap;
            let late = mask(inflection > SHORT_FLIGHT);
            let concave = late & mask(at_inflection < -doubt);
            let certain = mask(crest > SHORT_FLIGHT) & (mask(at_inflection.abs() > doubt) | !late);
            let convex = !concave & mask(at_crest < -doubt);
            let parabola = 2.0 * speed / (1.0 - sine);
            let inside = mask(parabola > SHORT_FLIGHT) & mask(parabola < inflection);
            let from = if late != 0 { inflection } else { SHORT_FLIGHT };
            times.lo[k] = if concave != 0 { SHORT_FLIGHT } else { from };
            times.hi[k] = if concave != 0 { inflection } else { crest };
            let guess = if inside != 0 { parabola } else { inflection };
            times.time[k] = if concave != 0 { guess } else { from };
            times.peak[k] = peak;
            verdicts.open[k] = certain & (concave | convex);
            let clears = mask(clears_by_tangents(
                peak,
                platform.separation_speed,
                (inflection, at_inflection),
                (crest, at_crest),
                speed + cosine,
            ));
            verdicts.clears[k] = clears;
            verdicts.dips[k] = certain & !concave & mask(at_crest > doubt) & !clears;
        }
    }
}

/// The first step of `GapForm::dip` for launches whose windows are those of a dip: whether the middle of the window is below
/// the platform beyond doubt (open, the window then ends there), or the tangent there shows that there is no dip.
pub(super) struct Dips<'a, const N: usize> {
    pub(super) low: &'a mut Low,
    pub(super) times: &'a mut Times,
    pub(super) verdicts: &'a mut Verdicts,
}

impl<const N: usize> WithSimd for Dips<'_, N> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { low, times, verdicts } = self;
        for k in 0..N {
            times.time[k] = 0.5 * (times.lo[k] + times.hi[k]);
        }
        low.evaluate::<S, N>(times);
        for k in 0..N {
            let (lo, hi, t) = (times.lo[k], times.hi[k], times.time[k]);
            let (gap, slope) = (times.gap[k], times.slope[k]);
            let far = if slope < 0.0 { hi } else { lo };
            verdicts.open[k] = mask(clears(-gap, times.peak[k]));
            verdicts.clears[k] = mask(gap > 0.0) & mask(gap + slope * (far - t) > 0.0);
            times.hi[k] = t;
            times.time[k] = lo;
        }
    }
}

impl Low {
    pub(super) const fn new() -> Self {
        Self { angle: ROW, speed: ROW, sine: ROW, cosine: ROW, versine: ROW, sine_of_time: ROW }
    }

    #[inline(always)]
    fn form(&self, times: &Times, k: usize) -> LaunchForm {
        LaunchForm {
            angle: self.angle[k],
            peak: times.peak[k],
            speed: self.speed[k],
            sine: self.sine[k],
            cosine: self.cosine[k],
        }
    }

    #[inline(always)]
    fn turn<S: Simd, const N: usize>(&mut self, times: &Times) {
        pairs::<S, N>(&mut self.versine, &mut self.sine_of_time, |k| 0.5 * times.time[k]);
        for k in 0..N {
            let half = (self.versine[k], self.sine_of_time[k]);
            (self.versine[k], self.sine_of_time[k]) = LaunchForm::versine_and_sine_of_half(half);
        }
    }

    /// Sets number `k` to the launch of a lane.
    #[inline(always)]
    pub(super) fn set(&mut self, k: usize, platform: &Platform, launches: Launches<'_>, lane: usize) {
        let peak = platform.peak;
        self.angle[k] = launches.from.angle[lane];
        self.speed[k] = launches.speed[lane];
        self.sine[k] = peak * launches.from.sin[lane];
        self.cosine[k] = peak * launches.from.cos[lane];
    }
}
