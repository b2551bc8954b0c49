//! Impacts before the first crest: `Vibration::bracket_before_crest_of_launch` and the search in its window, many at a
//! time.

use core::f64::consts::TAU;

use pulp::{Simd, WithSimd};

use super::{Impacts, LANES, Launches, Mask, Platforms, ROW, Row, Work, mask, packed};
use crate::elementary::{CREST, nearby_wrapped_of_lane, rotated, sin_cos_of_lane};
use crate::flight::SHORT_FLIGHT;
use crate::gap::{CrestForm, Jet, LaunchForm};

/// Steps before the last one; flights that need more are left to the solver of one flight.
const STEPS: usize = 5;

/// Packed launches that may land before the first crest.
#[derive(Debug, Clone)]
#[repr(align(64))]
pub(super) struct Low {
    count: usize,
    lane: [u8; LANES],
    angle: Row,
    speed: Row,
    /// P, and P sin and P cos at launch.
    peak: Row,
    sine: Row,
    cosine: Row,
    /// Phase, speed and depth below the crest at the separation; the gap below which a sign is in doubt.
    separation_angle: Row,
    separation_depth: Row,
    doubtful_gap: Row,
    /// The window that holds the root, and the time reached.
    lo: Row,
    hi: Row,
    time: Row,
    sin: Row,
    cos: Row,
    versine: Row,
    sine_of_time: Row,
    step: Row,
    /// Launches with a window, and those that clear the crest after all.
    bracketed: Mask,
    clears: Mask,
    near: Mask,
}

/// Windows, and the search in them.
pub(super) struct Solve<'a> {
    pub(super) low: &'a mut Low,
}

impl WithSimd for Solve<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let low = self.low;
        let lanes = packed(low.count);
        window(low, lanes);
        for _ in 0..STEPS {
            evaluate(low, lanes);
            model_step(low, lanes);
            advance(low, lanes);
            if low.near[..lanes]
                .iter()
                .zip(&low.bracketed[..lanes])
                .all(|(near, bracketed)| near | !bracketed == u64::MAX)
            {
                break;
            }
        }
        evaluate(low, lanes);
        finish(low, lanes);
        // The velocity is the slope of the launch form at the impact.
        for k in 0..lanes {
            (low.versine[k], low.sine_of_time[k]) = LaunchForm::versine_and_sine_of_lane(low.time[k]);
        }
    }
}

#[inline(always)]
const fn form(low: &Low, k: usize) -> LaunchForm {
    LaunchForm {
        angle: low.angle[k],
        peak: low.peak[k],
        speed: low.speed[k],
        sine: low.sine[k],
        cosine: low.cosine[k],
    }
}

#[inline(always)]
fn window(low: &mut Low, lanes: usize) {
    for k in 0..lanes {
        let (angle, speed, peak) = (low.angle[k], low.speed[k], low.peak[k]);
        let separation = low.separation_angle[k];
        let rising = CrestForm { peak, angle, speed: speed + low.cosine[k], depth: peak - low.sine[k] };
        let ahead = separation - angle;
        let inflection = if ahead > 0.0 { ahead } else { ahead + TAU };
        let crest = inflection + (CREST - separation);
        let at_inflection = rising.gap_over(low.separation_depth[k], inflection);
        let at_crest = rising.gap_over(0.0, crest);
        let doubt = low.doubtful_gap[k];
        let late = mask(inflection > SHORT_FLIGHT);
        let concave = late & mask(at_inflection < -doubt);
        let certain = mask(crest > SHORT_FLIGHT) & (mask(at_inflection.abs() > doubt) | !late);
        let convex = !concave & mask(at_crest < -doubt);
        let parabola = 2.0 * speed / (1.0 - low.sine[k]);
        let inside = mask(parabola > SHORT_FLIGHT) & mask(parabola < inflection);
        let from = if late != 0 { inflection } else { SHORT_FLIGHT };
        low.lo[k] = if concave != 0 { SHORT_FLIGHT } else { from };
        low.hi[k] = if concave != 0 { inflection } else { crest };
        let guess = if inside != 0 { parabola } else { inflection };
        low.time[k] = if concave != 0 { guess } else { from };
        low.bracketed[k] = certain & (concave | convex);
        low.clears[k] = certain & !concave & mask(at_crest > doubt);
        low.near[k] = 0;
    }
    if low.clears[..lanes].iter().all(|&clears| clears == 0) {
        return;
    }
    // Above the crest, without a dip before it where the gap does not first fall and then rise.
    for k in 0..lanes {
        low.step[k] = form(low, k).slope_of_lane(low.lo[k]);
    }
    for k in 0..lanes {
        let slope = form(low, k).slope_of_lane(low.hi[k]);
        low.clears[k] &= mask(low.step[k] >= 0.0) | mask(slope <= 0.0);
    }
}

#[inline(always)]
fn evaluate(low: &mut Low, lanes: usize) {
    for k in 0..lanes {
        (low.sin[k], low.cos[k]) = sin_cos_of_lane(low.angle[k] + low.time[k]);
    }
    for k in 0..lanes {
        (low.versine[k], low.sine_of_time[k]) = LaunchForm::versine_and_sine_of_lane(low.time[k]);
    }
}

#[inline(always)]
fn jet(low: &Low, k: usize) -> Jet {
    form(low, k).jet_of_pairs(low.time[k], (low.sin[k], low.cos[k]), (low.versine[k], low.sine_of_time[k]))
}

#[inline(always)]
fn model_step(low: &mut Low, lanes: usize) {
    for k in 0..lanes {
        let jet = jet(low, k);
        let radicand = jet.radicand();
        let root = radicand.sqrt();
        let step = jet.corrected_step(jet.quadratic_step(root), root);
        let newton = -(jet.gap * (1.0 / jet.slope));
        low.step[k] = if radicand > 0.0 { step } else { newton };
    }
}

#[inline(always)]
fn advance(low: &mut Low, lanes: usize) {
    for k in 0..lanes {
        let jet = jet(low, k);
        let t = low.time[k];
        let near = mask(jet.is_near_root());
        let above = jet.gap > 0.0;
        let lo = if above { t } else { low.lo[k] };
        let hi = if above { low.hi[k] } else { t };
        let next = t + low.step[k];
        let fine = mask(jet.slope < 0.0) & mask(next > lo) & mask(next < hi);
        let next = if fine != 0 { next } else { 0.5 * (lo + hi) };
        low.time[k] = if near != 0 { t } else { next };
        low.lo[k] = lo;
        low.hi[k] = hi;
        low.near[k] = near;
    }
}

#[inline(always)]
fn finish(low: &mut Low, lanes: usize) {
    for k in 0..lanes {
        let jet = jet(low, k);
        low.bracketed[k] &= mask(jet.is_near_root());
        let delta = jet.last_step();
        (low.sin[k], low.cos[k]) = rotated(low.sin[k], low.cos[k], delta);
        low.time[k] += delta;
    }
}

impl Low {
    pub(super) const fn new() -> Self {
        const MASK: Mask = [0; LANES];
        Self {
            count: 0,
            lane: [0; LANES],
            angle: ROW,
            speed: ROW,
            peak: ROW,
            sine: ROW,
            cosine: ROW,
            separation_angle: ROW,
            separation_depth: ROW,
            doubtful_gap: ROW,
            lo: ROW,
            hi: ROW,
            time: ROW,
            sin: ROW,
            cos: ROW,
            versine: ROW,
            sine_of_time: ROW,
            step: ROW,
            bracketed: MASK,
            clears: MASK,
            near: MASK,
        }
    }

    /// Packs those of the first `lanes` launches that do not clear the first crest for certain; false if there are none.
    pub(super) fn collect(
        &mut self,
        lanes: usize,
        platforms: &Platforms,
        launches: &Launches,
        work: &Work,
    ) -> bool {
        self.count = 0;
        for lane in 0..lanes {
            if (work.clears[lane] | work.settled[lane]) != 0 {
                continue;
            }
            let (k, peak) = (self.count, platforms.peak[lane]);
            self.lane[k] = lane as u8;
            self.angle[k] = launches.angle[lane];
            self.speed[k] = launches.speed[lane];
            self.peak[k] = peak;
            self.sine[k] = peak * launches.sin[lane];
            self.cosine[k] = peak * launches.cos[lane];
            self.separation_angle[k] = platforms.separation_angle[lane];
            self.separation_depth[k] = platforms.separation_depth[lane];
            self.doubtful_gap[k] = platforms.doubtful_gap[lane];
            self.count += 1;
        }
        self.count > 0
    }

    /// Lets the lanes that clear the crest after all take the ordinary path.
    pub(super) fn judge(&self, work: &mut Work) {
        for k in 0..self.count {
            work.clears[usize::from(self.lane[k])] = self.clears[k];
        }
    }

    /// Writes the landings.
    pub(super) fn land(&self, work: &mut Work, impacts: &mut Impacts) {
        for k in 0..self.count {
            if self.bracketed[k] == 0 {
                continue;
            }
            let lane = usize::from(self.lane[k]);
            let time = self.time[k];
            let velocity = form(self, k).slope_of(time, (self.versine[k], self.sine_of_time[k]));
            let (wrapped, turns) = nearby_wrapped_of_lane(self.angle[k] + time);
            impacts.angle[lane] = if wrapped < TAU { wrapped } else { 0.0 };
            impacts.sin[lane] = self.sin[k];
            impacts.cos[lane] = self.cos[k];
            impacts.velocity[lane] = if velocity < 0.0 { velocity } else { 0.0 };
            impacts.turns[lane] = turns;
            work.settled[lane] = u64::MAX;
        }
    }
}

impl Low {
    /// Writes the durations of the flights that have landed.
    pub(super) fn write_durations(&self, durations: &mut Row) {
        for k in 0..self.count {
            if self.bracketed[k] != 0 {
                durations[usize::from(self.lane[k])] = self.time[k];
            }
        }
    }
}
