//! The impact of disks that rise above the crests: [`Vibration::impact_from_above`](crate::Vibration), many at a time.

use core::f64::consts::TAU;

use pulp::{Simd, WithSimd};

use super::{Impacts, LANES, Launches, Platforms, Work, kept, mask};
use crate::elementary::{
    CREST, crest_interval, nearby_wrapped_of_lane, nearest_periods, rotated, sin_cos_of_lane,
};
use crate::flight::MAX_FLIGHT_DURATION;
use crate::gap::{CrestForm, Jet};

/// Phases this close (rad) to where the one-flight solver decides otherwise are left to it.
const DOUBTFUL_PHASE: f64 = 1.0e-9;

/// From the launch to the first evaluation and the first step.
pub(super) struct Prepare<'a> {
    pub(super) platforms: &'a Platforms,
    pub(super) launches: &'a Launches,
    pub(super) work: &'a mut Work,
}

/// The second evaluation and the last step.
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
        evaluate_pairs_at_start(work);
        quadratic_root(platforms, work);
        quadratic_step(platforms, work);
        corrected_step(platforms, work);
        first_step(platforms, work);
    }
}

impl WithSimd for Land<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { platforms, work, impacts } = self;
        evaluate_pairs(work);
        newton_step(platforms, work);
        last_step(platforms, work);
        impact(platforms, work, impacts);
        for lane in 0..LANES {
            work.settled[lane] |= work.regular[lane] & work.clears[lane] & !work.slow[lane];
        }
    }
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

#[inline(always)]
fn evaluate_pairs_at_start(work: &mut Work) {
    for lane in 0..LANES {
        (work.sin[lane], work.cos[lane]) = sin_cos_of_lane(work.start[lane]);
    }
}

#[inline(always)]
fn evaluate_pairs(work: &mut Work) {
    for lane in 0..LANES {
        (work.sin[lane], work.cos[lane]) = sin_cos_of_lane(work.start[lane] + work.time[lane]);
    }
}

/// Gap and derivatives of a lane at the time reached, with the pair there known.
#[inline(always)]
fn jet(platforms: &Platforms, work: &Work, lane: usize, time: f64) -> Jet {
    CrestForm { peak: platforms.peak[lane], angle: work.start[lane], speed: -work.fall[lane], depth: 0.0 }
        .jet_of_pair(time, work.sin[lane], work.cos[lane])
}

#[inline(always)]
fn quadratic_root(platforms: &Platforms, work: &mut Work) {
    for lane in 0..LANES {
        work.root[lane] = jet(platforms, work, lane, 0.0).radicand().sqrt();
    }
}

#[inline(always)]
fn quadratic_step(platforms: &Platforms, work: &mut Work) {
    for lane in 0..LANES {
        work.step[lane] = jet(platforms, work, lane, 0.0).quadratic_step(work.root[lane]);
    }
}

#[inline(always)]
fn corrected_step(platforms: &Platforms, work: &mut Work) {
    for lane in 0..LANES {
        work.step[lane] = jet(platforms, work, lane, 0.0).corrected_step(work.step[lane], work.root[lane]);
    }
}

/// Takes the step where the solver of one flight would, or none if the root is near already.
#[inline(always)]
fn first_step(platforms: &Platforms, work: &mut Work) {
    for lane in 0..LANES {
        let jet = jet(platforms, work, lane, 0.0);
        let (start, next) = (work.start[lane], work.step[lane]);
        let near = mask(jet.is_near_root());
        let doubt = DOUBTFUL_PHASE * (1.0 + platforms.peak[lane]);
        let behind_crest = mask(jet.third < doubt) & mask(jet.curvature > -doubt);
        let dips = behind_crest & mask(work.fall[lane] < platforms.peak[lane]);
        let before_crest = mask(
            crest_interval(start - DOUBTFUL_PHASE).to_bits()
                == crest_interval(start + next + DOUBTFUL_PHASE).to_bits(),
        );
        let fine = mask(jet.slope < 0.0) & mask(next > 0.0) & before_crest;
        work.time[lane] = kept(!near, next);
        work.regular[lane] &= (near | fine) & !dips;
    }
}

#[inline(always)]
fn newton_step(platforms: &Platforms, work: &mut Work) {
    for lane in 0..LANES {
        let jet = jet(platforms, work, lane, work.time[lane]);
        let inverse = 1.0 / jet.slope;
        work.inverse[lane] = inverse;
        work.step[lane] = -(jet.gap * inverse);
        work.regular[lane] &= mask(jet.is_near_root());
    }
}

#[inline(always)]
fn last_step(platforms: &Platforms, work: &mut Work) {
    for lane in 0..LANES {
        let jet = jet(platforms, work, lane, 0.0);
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
