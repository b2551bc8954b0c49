//! Impacts before the first crest: `Vibration::bracket_before_crest_of_launch`, and the form of the gap for
//! the search in its window, many at a time.

use core::f64::consts::TAU;

use pulp::{Simd, WithSimd};

use super::platform::{Platform, PlatformLanes};
use super::root::{Forms, Times};
use super::{Impacts, LANES, Launches, Mask, ROW, Row, Sixteens, Width, kept, mask, pairs};
use crate::flight::bounds::clears_by_tangents;
use crate::flight::gap::SHORT_FLIGHT;
use crate::flight::gap::{CrestForm, LaunchForm};
use crate::numerics::elementary::{CREST, impact_phase_of_lane};

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
pub(super) struct WindowMasks {
    pub(super) open: Mask,
    pub(super) clears: Mask,
}

impl WindowMasks {
    pub(super) const fn new() -> Self {
        Self { open: [0; LANES], clears: [0; LANES] }
    }
}

impl Forms for Low {
    #[inline(always)]
    fn evaluate<S: Simd>(&mut self, width: impl Width, times: &mut Times) {
        let Times { time, sin, cos, .. } = &mut *times;
        pairs::<S>(width, sin, cos, |k| self.angle[k] + time[k]);
        self.turn::<S>(width, times);
        for k in 0..width.lanes() {
            let (form, of_time) = (self.form(times, k), (self.versine[k], self.sine_of_time[k]));
            times.gap[k] = form.gap_of(times.time[k], of_time);
            times.slope[k] = form.slope_of(times.time[k], of_time);
        }
    }

    #[inline(always)]
    fn land<S: Simd>(&mut self, width: impl Width, times: &Times, impacts: &mut Impacts) {
        self.turn::<S>(width, times);
        for k in 0..width.lanes() {
            // The velocity is the slope of the launch form at the impact.
            let time = times.time[k];
            let velocity = self.form(times, k).slope_of(time, (self.versine[k], self.sine_of_time[k]));
            let (wrapped, turns) = impact_phase_of_lane(self.angle[k] + time);
            impacts.angle[k] = wrapped;
            impacts.sin[k] = times.sin[k];
            impacts.cos[k] = times.cos[k];
            impacts.velocity[k] = kept(mask(velocity < 0.0), velocity);
            impacts.turns[k] = turns;
            // As a whole period and a rest.
            let period = kept(mask(time >= TAU), TAU);
            impacts.duration[k] = period + (time - period);
        }
    }
}

/// The windows of launches.
pub(super) struct Windows<'a, P> {
    pub(super) width: Sixteens,
    pub(super) platforms: P,
    pub(super) low: &'a Low,
    pub(super) times: &'a mut Times,
    pub(super) masks: &'a mut WindowMasks,
}

impl<P: PlatformLanes> WithSimd for Windows<'_, P> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { width, platforms, low, times, masks } = self;
        for k in 0..width.lanes() {
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
            masks.open[k] = certain & (concave | convex);
            let clears = mask(clears_by_tangents(
                peak,
                platform.separation_speed,
                (inflection, at_inflection),
                (crest, at_crest),
                speed + cosine,
            ));
            masks.clears[k] = clears;
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
    fn turn<S: Simd>(&mut self, width: impl Width, times: &Times) {
        pairs::<S>(width, &mut self.versine, &mut self.sine_of_time, |k| 0.5 * times.time[k]);
        for k in 0..width.lanes() {
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::flight::launch::Launch;
    use crate::flight::launch::launch_that_may_dip;
    use crate::flight::platform::vibration::Vibration;
    use crate::sweep::lockstep::lanes::{Dispatch, InstructionSet};

    /// Launches about as fast as the platform at its fastest: the decisions on their windows are those of
    /// single flights.
    #[test]
    fn windows_are_those_of_single_flights() {
        let vibration = Vibration::new(2.0).expect("legal");
        let (platform, width) = (Platform::from(&vibration), Sixteens::holding(LANES));
        let dispatch = Dispatch::new(InstructionSet::best());
        let (mut low, mut times, mut masks) = (Low::new(), Times::new(), WindowMasks::new());
        let (mut open, mut clear) = (0, 0);
        for block in 0..2_000 {
            let launches: [_; LANES] = core::array::from_fn(|k| {
                let (phase, speed) = launch_that_may_dip(&vibration, (block * LANES + k) as u64);
                Launch::new(phase, speed.max(0.0)).expect("legal")
            });
            for (k, launch) in launches.iter().enumerate() {
                low.angle[k] = launch.phase().angle();
                low.speed[k] = launch.relative_speed();
                low.sine[k] = platform.peak * launch.phase().sin();
                low.cosine[k] = platform.peak * launch.phase().cos();
            }
            let (forms, windows, verdict) = (&mut low, &mut times, &mut masks);
            dispatch.run(Windows { width, platforms: platform, low: forms, times: windows, masks: verdict });
            for (k, launch) in launches.iter().enumerate() {
                let single = vibration.bracket_before_crest_of_launch(&low.form(&times, k), &mut 0);
                let found = single.map(|(bracket, guess)| (bracket.lo, bracket.hi, guess));
                if masks.open[k] != 0 {
                    assert_eq!(found, Some((times.lo[k], times.hi[k], times.time[k])), "{launch:?}");
                    open += 1;
                } else if masks.clears[k] != 0 {
                    assert_eq!(found, None, "{launch:?}");
                    clear += 1;
                }
            }
        }
        assert!(open > 500 && clear > 500, "{open} and {clear}");
    }
}
