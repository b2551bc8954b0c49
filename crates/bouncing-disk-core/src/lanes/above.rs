//! The impact of disks that rise above the crests: [`Vibration::impact_from_above`](crate::Vibration), many at a time.

use core::f64::consts::{PI, TAU};

use pulp::{Simd, WithSimd};

use super::{Impacts, LANES, Launches, Platforms, Work, kept, mask};
use crate::elementary::{CREST, nearby_wrapped_of_lane, nearest_periods, rotated, sin_cos_of_lane};
use crate::flight::MAX_FLIGHT_DURATION;
use crate::gap::{CrestForm, Jet};

/// Evaluations after the first two, made only while a lane needs them.
const MORE_EVALUATIONS: usize = 2;

/// From the launch to the first evaluation and the first step.
pub(super) struct Prepare<'a> {
    pub(super) platforms: &'a Platforms,
    pub(super) launches: &'a Launches,
    pub(super) work: &'a mut Work,
}

/// The second evaluation, more where they are needed, and the last step.
pub(super) struct Land<'a> {
    pub(super) platforms: &'a Platforms,
    pub(super) work: &'a mut Work,
    pub(super) impacts: &'a mut Impacts,
}

impl WithSimd for Prepare<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { platforms, launches, work } = self;
        clear_first_crest(platforms, launches, work);
        fall_to_crest_height(platforms, launches, work);
        window(platforms, work);
        evaluate(work);
        advance(platforms, work);
    }
}

impl WithSimd for Land<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { platforms, work, impacts } = self;
        evaluate(work);
        for _ in 0..MORE_EVALUATIONS {
            if newton_step(platforms, work) {
                break;
            }
            advance(platforms, work);
            evaluate(work);
            newton_step(platforms, work);
        }
        last_step(platforms, work);
        impact(platforms, work, impacts);
        for lane in 0..LANES {
            work.settled[lane] |= ordinary(work, lane) & work.near[lane];
        }
    }
}

/// Whether a lane lands from above the crests.
#[inline(always)]
const fn ordinary(work: &Work, lane: usize) -> u64 {
    work.regular[lane] & work.clears[lane] & !work.slow[lane]
}

/// Marks the lanes that are not hit before the first crest for certain, as `impact_after` decides it.
#[inline(always)]
fn clear_first_crest(platforms: &Platforms, launches: &Launches, work: &mut Work) {
    for lane in 0..LANES {
        let (angle, speed) = (launches.angle[lane], launches.speed[lane]);
        let peak = platforms.peak[lane];
        let separation = platforms.separation_angle[lane];
        let disk_speed = speed + peak * launches.cos[lane];
        let depth = peak - peak * launches.sin[lane];
        let rising = CrestForm { peak, angle, speed: disk_speed, depth };
        let ahead = separation - angle;
        let inflection = if ahead > 0.0 { ahead } else { ahead + TAU };
        let crest = inflection + (CREST - separation);
        let from_falling_away = mask(angle >= separation) & mask(angle < CREST);
        let doubtful = platforms.doubtful_gap[lane];
        let above = mask(rising.gap_over(platforms.separation_depth[lane], inflection) > doubtful)
            & mask(rising.gap_over(0.0, crest) > doubtful);
        let no_dip =
            mask(disk_speed - inflection >= platforms.separation_speed[lane]) | mask(disk_speed <= crest);
        work.clears[lane] = from_falling_away | (above & no_dip);
        work.settled[lane] = 0;
        work.slow[lane] = mask(speed < platforms.long_launch_speed[lane]);
    }
}

/// Down to the height of the crests the disk flies free.
#[inline(always)]
fn fall_to_crest_height(platforms: &Platforms, launches: &Launches, work: &mut Work) {
    for lane in 0..LANES {
        let peak = platforms.peak[lane];
        let disk_speed = launches.speed[lane] + peak * launches.cos[lane];
        let depth = peak - peak * launches.sin[lane];
        // Not a number where the disk stays below: no comparison with it holds.
        let fall = (disk_speed * disk_speed - 2.0 * depth).sqrt();
        work.fall[lane] = fall;
        work.step[lane] = disk_speed + fall;
    }
    for lane in 0..LANES {
        let free = work.step[lane];
        let (periods, rest) = nearest_periods(free);
        work.free_periods[lane] = periods;
        work.start[lane] = launches.angle[lane] + rest;
        work.regular[lane] = mask(free <= MAX_FLIGHT_DURATION);
    }
}

/// The window of the root, as `impact_from_above` and `bracket_behind_crest` find it, except where a dip must be searched.
#[inline(always)]
fn window(platforms: &Platforms, work: &mut Work) {
    let mut any = 0;
    for lane in 0..LANES {
        let (turned, _) = nearby_wrapped_of_lane(work.start[lane]);
        let retention = PI - platforms.separation_angle[lane];
        let behind =
            mask(turned > CREST) & mask(turned < retention) & mask(work.fall[lane] < platforms.peak[lane]);
        work.lo[lane] = 0.0;
        work.hi[lane] = (CREST - turned) + kept(mask(turned >= CREST), TAU);
        work.time[lane] = 0.0;
        any |= behind;
    }
    if any == 0 {
        return;
    }
    for lane in 0..LANES {
        let (fall, peak) = (work.fall[lane], platforms.peak[lane]);
        let (turned, _) = nearby_wrapped_of_lane(work.start[lane]);
        let retention = PI - platforms.separation_angle[lane];
        let behind = mask(turned > CREST) & mask(turned < retention) & mask(fall < peak);
        let end = retention - turned;
        let falling = CrestForm { peak, angle: turned, speed: -fall, depth: 0.0 };
        let gap_at_end = falling.gap_over(platforms.separation_depth[lane], end);
        let passed = mask(gap_at_end <= 0.0);
        let (sin, cos) = sin_cos_of_lane(turned);
        let first = -fall - peak * cos;
        let last = (-fall - end) + platforms.separation_speed[lane];
        let lowest = CrestForm::lowest_of_tangents(peak - peak * sin, gap_at_end, first, last, end);
        let dips = mask(first < 0.0) & mask(last > 0.0) & mask(lowest <= platforms.doubtful_gap[lane]);
        work.lo[lane] = kept(behind & !passed, end);
        work.time[lane] = work.lo[lane];
        work.hi[lane] = if behind & passed != 0 { end } else { work.hi[lane] };
        work.regular[lane] &= !behind | passed | !dips;
    }
}

#[inline(always)]
fn evaluate(work: &mut Work) {
    for lane in 0..LANES {
        (work.sin[lane], work.cos[lane]) = sin_cos_of_lane(work.start[lane] + work.time[lane]);
    }
}

/// Gap and derivatives of a lane at the time reached, with the pair there known.
#[inline(always)]
fn jet(platforms: &Platforms, work: &Work, lane: usize) -> Jet {
    CrestForm { peak: platforms.peak[lane], angle: work.start[lane], speed: -work.fall[lane], depth: 0.0 }
        .jet_of_pair(work.time[lane], work.sin[lane], work.cos[lane])
}

/// One step of the search of one flight; none where the root is near.
#[inline(always)]
fn advance(platforms: &Platforms, work: &mut Work) {
    for lane in 0..LANES {
        work.root[lane] = jet(platforms, work, lane).radicand().sqrt();
    }
    for lane in 0..LANES {
        work.step[lane] = jet(platforms, work, lane).quadratic_step(work.root[lane]);
    }
    for lane in 0..LANES {
        work.step[lane] = jet(platforms, work, lane).corrected_step(work.step[lane], work.root[lane]);
    }
    for lane in 0..LANES {
        let jet = jet(platforms, work, lane);
        let t = work.time[lane];
        let near = mask(jet.is_near_root());
        let above = jet.gap > 0.0;
        let lo = if above { t } else { work.lo[lane] };
        let hi = if above { work.hi[lane] } else { t };
        let next = t + work.step[lane];
        let falls = mask(jet.slope < 0.0);
        let inside = falls & mask(next > lo) & mask(next < hi);
        let next = if inside != 0 { next } else { 0.5 * (lo + hi) };
        work.time[lane] = if near != 0 { t } else { next };
        work.lo[lane] = lo;
        work.hi[lane] = hi;
        // Newton's step is left to the solver of one flight.
        work.regular[lane] &= near | !falls | mask(work.root[lane] > 0.0);
    }
}

#[inline(always)]
fn newton_step(platforms: &Platforms, work: &mut Work) -> bool {
    let mut all = u64::MAX;
    for lane in 0..LANES {
        let jet = jet(platforms, work, lane);
        let inverse = 1.0 / jet.slope;
        work.inverse[lane] = inverse;
        work.step[lane] = -(jet.gap * inverse);
        let near = mask(jet.is_near_root());
        work.near[lane] = near;
        all &= near | !ordinary(work, lane);
    }
    all == u64::MAX
}

#[inline(always)]
fn last_step(platforms: &Platforms, work: &mut Work) {
    for lane in 0..LANES {
        let jet = jet(platforms, work, lane);
        work.step[lane] = jet.reverted(work.step[lane], work.inverse[lane]);
    }
}

#[inline(always)]
fn impact(platforms: &Platforms, work: &Work, impacts: &mut Impacts) {
    for lane in 0..LANES {
        let delta = work.step[lane];
        let time = work.time[lane] + delta;
        let (sin, cos) = rotated(work.sin[lane], work.cos[lane], delta);
        let velocity = (-work.fall[lane] - time) - platforms.peak[lane] * cos;
        let (wrapped, turns) = nearby_wrapped_of_lane(work.start[lane] + time);
        impacts.angle[lane] = kept(mask(wrapped < TAU), wrapped);
        impacts.sin[lane] = sin;
        impacts.cos[lane] = cos;
        impacts.velocity[lane] = kept(mask(velocity < 0.0), velocity);
        impacts.turns[lane] = work.free_periods[lane] + turns;
    }
}
