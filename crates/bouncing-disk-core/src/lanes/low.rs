//! Impacts before the first crest: `Vibration::bracket_before_crest_of_launch` and the search in its window, many at a
//! time.

use core::f64::consts::TAU;

use pulp::{Simd, WithSimd};

use super::list::List;
use super::platform::Below;
use super::search::{Forms, Times};
use super::{Impacts, LANES, Launches, Mask, ROW, Row, kept, mask, packed};
use crate::elementary::{CREST, nearby_wrapped_of_lane, sin_cos_of_lane};
use crate::flight::SHORT_FLIGHT;
use crate::gap::{CrestForm, Jet, LaunchForm};

/// Packed launches that may land before the first crest.
#[derive(Debug, Clone)]
#[repr(align(64))]
pub(super) struct Low {
    angle: Row,
    speed: Row,
    peak: Row,
    /// P sin and P cos at launch.
    sine: Row,
    cosine: Row,
    /// 1 - cos and sin of the time.
    versine: Row,
    sine_of_time: Row,
    /// Launches that clear the crest after all.
    pub(super) clears: Mask,
}

impl Forms for Low {
    #[inline(always)]
    fn evaluate(&mut self, times: &mut Times, from: usize, to: usize) {
        for k in from..to {
            (times.sin[k], times.cos[k]) = sin_cos_of_lane(self.angle[k] + times.time[k]);
        }
        self.turn(times, from, to);
    }

    #[inline(always)]
    fn jet(&self, times: &Times, k: usize) -> Jet {
        let of_time = (self.versine[k], self.sine_of_time[k]);
        self.form(k).jet_of_pairs(times.time[k], (times.sin[k], times.cos[k]), of_time)
    }

    #[inline(always)]
    fn swap(&mut self, a: usize, b: usize) {
        self.angle.swap(a, b);
        self.speed.swap(a, b);
        self.peak.swap(a, b);
        self.sine.swap(a, b);
        self.cosine.swap(a, b);
        self.versine.swap(a, b);
        self.sine_of_time.swap(a, b);
    }
}

/// The windows of packed launches.
pub(super) struct Windows<'a, P> {
    pub(super) platforms: &'a P,
    pub(super) low: &'a mut Low,
    pub(super) times: &'a mut Times,
}

impl<P: Below> WithSimd for Windows<'_, P> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { platforms, low, times } = self;
        window(platforms, low, times, packed(times.lanes.len()));
    }
}

#[inline(always)]
fn window<P: Below>(platforms: &P, low: &mut Low, times: &mut Times, lanes: usize) {
    let mut any_clear = 0;
    for k in 0..lanes {
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
        times.open[k] = certain & (concave | convex);
        let clears = certain & !concave & mask(at_crest > doubt);
        low.clears[k] = clears;
        any_clear |= clears;
    }
    if any_clear == 0 {
        return;
    }
    // Above the crest, without a dip before it where the gap does not first fall and then rise.
    for k in 0..lanes {
        let form = low.form(k);
        let (first, last) = (form.slope_of_lane(times.lo[k]), form.slope_of_lane(times.hi[k]));
        low.clears[k] &= mask(first >= 0.0) | mask(last <= 0.0);
    }
}

/// Impacts of packed launches whose search has ended.
pub(super) struct Land<'a> {
    pub(super) low: &'a mut Low,
    pub(super) times: &'a Times,
    pub(super) impacts: &'a mut Impacts,
}

impl WithSimd for Land<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { low, times, impacts } = self;
        let lanes = packed(times.lanes.len());
        low.turn(times, 0, lanes);
        for k in 0..lanes {
            // The velocity is the slope of the launch form at the impact.
            let time = times.time[k];
            let velocity = low.form(k).slope_of(time, (low.versine[k], low.sine_of_time[k]));
            let (wrapped, turns) = nearby_wrapped_of_lane(low.angle[k] + time);
            impacts.angle[k] = kept(mask(wrapped < TAU), wrapped);
            impacts.sin[k] = times.sin[k];
            impacts.cos[k] = times.cos[k];
            impacts.velocity[k] = kept(mask(velocity < 0.0), velocity);
            impacts.turns[k] = turns;
        }
    }
}

impl Low {
    pub(super) const fn new() -> Self {
        Self {
            angle: ROW,
            speed: ROW,
            peak: ROW,
            sine: ROW,
            cosine: ROW,
            versine: ROW,
            sine_of_time: ROW,
            clears: [0; LANES],
        }
    }

    #[inline(always)]
    fn form(&self, k: usize) -> LaunchForm {
        LaunchForm {
            angle: self.angle[k],
            peak: self.peak[k],
            speed: self.speed[k],
            sine: self.sine[k],
            cosine: self.cosine[k],
        }
    }

    #[inline(always)]
    fn turn(&mut self, times: &Times, from: usize, to: usize) {
        for k in from..to {
            (self.versine[k], self.sine_of_time[k]) = LaunchForm::versine_and_sine_of_lane(times.time[k]);
        }
    }

    /// Packs the launches of the lanes listed.
    pub(super) fn pack<P: Below>(&mut self, lanes: &List, platforms: &P, launches: &Launches) {
        for (k, lane) in lanes.iter().enumerate() {
            let peak = platforms.lane(lane).peak;
            self.angle[k] = launches.angle[lane];
            self.speed[k] = launches.speed[lane];
            self.peak[k] = peak;
            self.sine[k] = peak * launches.sin[lane];
            self.cosine[k] = peak * launches.cos[lane];
        }
    }
}
