//! The impact of disks that rise above the crests: [`Vibration::impact_from_above`](crate::Vibration), many
//! at a time.

use core::f64::consts::TAU;

use pulp::{Simd, WithSimd};

use super::platform::PlatformLanes;
use super::{Arcs, Impacts, LANES, Lanes, Mask, ROW, Row, Width, kept, lanes_of, mask, pairs, scaled_pairs};
use crate::flight::gap::{CrestForm, GapTaylor};
use crate::numerics::elementary::{
    CREST, impact_phase_of_lane, nearby_wrapped_of_lane, nearest_whole, rotated,
};

/// Comparisons that decide which path a lane takes keep this far from a tie (turns; relative to the pull).
const CLEAR: f64 = 1.0e-9;

/// All lanes get a third evaluation if at least one in this many needs it.
const MANY: usize = 4;

/// Intermediate results of all lanes.
#[derive(Debug, Clone)]
#[repr(align(64))]
pub(super) struct Work {
    time: Row,
    /// The time of the second evaluation.
    second: Row,
    /// P sin and P cos at the height of the crests; the pair of the last evaluation.
    platform: Row,
    third: Row,
    sin: Row,
    cos: Row,
    root: Row,
    /// The quadratic step, and the improved one; the Newton step before the last step.
    quadratic: Row,
    step: Row,
    inverse: Row,
    /// Lanes whose steps are those of the search.
    followed: Mask,
    /// Lanes near their root: at the start, or, if followed, surely at the last evaluation.
    near: Mask,
    /// Whether `second` is the time of the second evaluation; otherwise `time` is.
    stepped: bool,
    /// Whether all lanes have landed at the second evaluation.
    pub(super) all: bool,
}

impl Work {
    pub(super) const fn new() -> Self {
        Self {
            time: ROW,
            second: ROW,
            platform: ROW,
            third: ROW,
            sin: ROW,
            cos: ROW,
            root: ROW,
            quadratic: ROW,
            step: ROW,
            inverse: ROW,
            followed: [0; LANES],
            near: [0; LANES],
            stepped: false,
            all: false,
        }
    }

    /// The lanes that have landed.
    #[inline(always)]
    pub(super) fn landed(&self) -> Lanes {
        lanes_of(&self.near)
    }

    /// The time that the first step of the search has reached in a lane that has not landed; zero if unknown.
    #[inline(always)]
    pub(super) const fn reached(&self, k: usize) -> f64 {
        let second = if self.stepped { &self.second } else { &self.time };
        kept(self.followed[k], second[k])
    }
}

/// Flights: two evaluations of the gap, a third one if many lanes need it, and the last step. Lanes that need
/// more are left to the search.
pub(super) struct Fly<'a, P, W> {
    pub(super) width: W,
    pub(super) platforms: P,
    pub(super) arcs: &'a Arcs,
    pub(super) work: &'a mut Work,
    pub(super) impacts: &'a mut Impacts,
    /// Whether the impacts get their turns.
    pub(super) timed: bool,
}

impl<P: PlatformLanes, W: Width> WithSimd for Fly<'_, P, W> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { width, platforms, arcs, work, impacts, timed } = self;
        let Work { platform, third, .. } = &mut *work;
        scaled_pairs::<S>(width, platform, third, |k| arcs.start[k], |k| platforms.lane(k).peak);
        if !first_step(width, platforms, arcs, work) {
            other_first_step(width, platforms, arcs, work);
        }
        work.stepped = false;
        work.all = evaluate::<S, P>(width, platforms, arcs, work);
        if !work.all {
            let missing = Lanes::first(width.lanes()).without(work.landed());
            if missing.count() >= width.lanes() / MANY {
                second_step(width, platforms, arcs, work);
                evaluate::<S, P>(width, platforms, arcs, work);
            }
        }
        last_step(width, platforms, arcs, work);
        if timed {
            impact::<P, true>(width, platforms, arcs, work, impacts);
        } else {
            impact::<P, false>(width, platforms, arcs, work, impacts);
        }
    }
}

/// Gap and derivatives at the height of the crests, with the pair there known: [`taylor`] at the time zero,
/// where products with the time vanish.
#[inline(always)]
fn first_taylor<P: PlatformLanes>(platforms: P, arcs: &Arcs, work: &Work, k: usize) -> GapTaylor {
    let (platform, third) = (work.platform[k], work.third[k]);
    GapTaylor {
        gap: platforms.lane(k).peak - platform,
        slope: arcs.speed[k] - third,
        curvature: platform - 1.0,
        third,
        platform,
    }
}

/// Gap and derivatives at the time reached.
#[inline(always)]
fn taylor<P: PlatformLanes>(platforms: P, arcs: &Arcs, work: &Work, k: usize) -> GapTaylor {
    form(platforms, arcs, k).taylor_of_pair(work.time[k], work.sin[k], work.cos[k])
}

#[inline(always)]
fn form<P: PlatformLanes>(platforms: P, arcs: &Arcs, k: usize) -> CrestForm {
    CrestForm { peak: platforms.lane(k).peak, angle: arcs.start[k], speed: arcs.speed[k], depth: 0.0 }
}

/// Lanes with no crest within a time after the start.
#[inline(always)]
fn meets_no_crest(start: f64, time: f64) -> u64 {
    // In turns; whole numbers are half way between two crests.
    let turns = start * (1.0 / TAU) - (0.75 + CLEAR);
    let ahead = (nearest_whole(turns) - turns) + (0.5 - 2.0 * CLEAR);
    mask(time * (1.0 / TAU) < ahead)
}

/// The step of the model from where the gap is known, given the square roots of its radicands.
#[inline(always)]
fn model_step(width: impl Width, work: &mut Work, taylor: impl Fn(&Work, usize) -> GapTaylor) {
    for k in 0..width.lanes() {
        work.quadratic[k] = taylor(work, k).quadratic_step(work.root[k]);
    }
    for k in 0..width.lanes() {
        work.step[k] = taylor(work, k).corrected_step_of_lane(work.quadratic[k], work.root[k]);
    }
}

/// The first step of the search of one flight; none if the root is near. Returns whether all lanes are
/// followed.
#[inline(always)]
fn first_step<P: PlatformLanes>(width: impl Width, platforms: P, arcs: &Arcs, work: &mut Work) -> bool {
    for k in 0..width.lanes() {
        let taylor = first_taylor(platforms, arcs, work, k);
        let one_window = !two_windows(platforms, arcs, &taylor, k);
        let radicand = taylor.radicand();
        let usable = one_window & mask(taylor.slope < 0.0) & mask(radicand > 0.0);
        work.near[k] = one_window & mask(taylor.is_near_root());
        // NaN if the model is of no use: the step is then NaN too, and no comparison with it holds.
        work.root[k] = f64::from_bits(radicand.sqrt().to_bits() | !usable);
    }
    model_step(width, work, |work, k| first_taylor(platforms, arcs, work, k));
    let mut all = u64::MAX;
    for k in 0..width.lanes() {
        let (start, step) = (arcs.start[k], work.step[k]);
        let inside = mask(step > 0.0) & meets_no_crest(start, step);
        let followed = work.near[k] | inside;
        work.time[k] = kept(!work.near[k], step);
        work.followed[k] = followed;
        all &= followed;
    }
    all == u64::MAX
}

/// Lanes with two windows: behind a crest, where the platform may fall away faster than the disk.
#[inline(always)]
fn two_windows<P: PlatformLanes>(platforms: P, arcs: &Arcs, taylor: &GapTaylor, k: usize) -> u64 {
    let peak = platforms.lane(k).peak;
    mask(taylor.curvature > -CLEAR * (1.0 + peak))
        & mask(taylor.third < CLEAR * peak)
        & mask(arcs.speed[k] > -peak)
}

/// The first step of the search where the model leads nowhere: Newton's, or half way to the crest.
#[inline(always)]
fn other_first_step<P: PlatformLanes>(width: impl Width, platforms: P, arcs: &Arcs, work: &mut Work) {
    let (time, followed) = (work.time, work.followed);
    for k in 0..width.lanes() {
        let taylor = first_taylor(platforms, arcs, work, k);
        let (turned, _) = nearby_wrapped_of_lane(arcs.start[k]);
        let crest = (CREST - turned) + kept(mask(turned >= CREST), TAU);
        let model = mask(work.root[k] > 0.0);
        let newton = -(taylor.gap * (1.0 / taylor.slope));
        let step = if model != 0 { work.step[k] } else { newton };
        let fine = mask(taylor.slope < 0.0) & mask(step > 0.0) & mask(step < crest);
        let next = if fine != 0 { step } else { 0.5 * crest };
        let one_window = !two_windows(platforms, arcs, &taylor, k);
        let astray = !followed[k] & one_window & mask(taylor.gap > 0.0);
        work.time[k] = if astray != 0 { next } else { time[k] };
        work.followed[k] = followed[k] | astray;
    }
}

/// The step after the second evaluation if the root is not near: the step of the search if it stays in the
/// window.
#[inline(always)]
fn second_step<P: PlatformLanes>(width: impl Width, platforms: P, arcs: &Arcs, work: &mut Work) {
    work.second = work.time;
    work.stepped = true;
    for k in 0..width.lanes() {
        work.root[k] = taylor(platforms, arcs, work, k).radicand().sqrt();
    }
    model_step(width, work, |work, k| taylor(platforms, arcs, work, k));
    for k in 0..width.lanes() {
        let taylor = taylor(platforms, arcs, work, k);
        let time = work.second[k];
        let next = time + work.step[k];
        // The window ends where the last evaluation was, or at the crest.
        let later = mask(taylor.gap > 0.0);
        let within = (later & mask(next > time) & meets_no_crest(arcs.start[k], next))
            | (!later & mask(next > 0.0) & mask(next < time));
        let inside = mask(taylor.slope < 0.0) & mask(work.root[k] > 0.0) & within;
        let moves = !mask(taylor.is_near_root()) & inside;
        work.time[k] = if moves != 0 { next } else { time };
    }
}

/// Another evaluation, and the Newton step from there. Returns whether all lanes are near their root.
#[inline(always)]
fn evaluate<S: Simd, P: PlatformLanes>(
    width: impl Width,
    platforms: P,
    arcs: &Arcs,
    work: &mut Work,
) -> bool {
    let Work { time, sin, cos, .. } = &mut *work;
    pairs::<S>(width, sin, cos, |k| arcs.start[k] + time[k]);
    let mut all = u64::MAX;
    for k in 0..width.lanes() {
        let taylor = taylor(platforms, arcs, work, k);
        let inverse = 1.0 / taylor.slope;
        work.inverse[k] = inverse;
        work.step[k] = -(taylor.gap * inverse);
        let near = work.followed[k] & mask(taylor.is_surely_near_root(platforms.lane(k).peak));
        work.near[k] = near;
        all &= near;
    }
    all == u64::MAX
}

/// The last step.
#[inline(always)]
fn last_step<P: PlatformLanes>(width: impl Width, platforms: P, arcs: &Arcs, work: &mut Work) {
    for k in 0..width.lanes() {
        let taylor = taylor(platforms, arcs, work, k);
        work.step[k] = taylor.reverted(work.step[k], work.inverse[k]);
    }
}

#[inline(always)]
fn impact<P: PlatformLanes, const TIMED: bool>(
    width: impl Width,
    platforms: P,
    arcs: &Arcs,
    work: &Work,
    impacts: &mut Impacts,
) {
    for k in 0..width.lanes() {
        let delta = work.step[k];
        let time = work.time[k] + delta;
        let (sin, cos) = rotated(work.sin[k], work.cos[k], delta);
        let velocity = (arcs.speed[k] - time) - platforms.lane(k).peak * cos;
        impacts.angle[k] = arcs.start[k] + time;
        impacts.sin[k] = sin;
        impacts.cos[k] = cos;
        impacts.velocity[k] = kept(mask(velocity < 0.0), velocity);
    }
    for k in 0..width.lanes() {
        let (wrapped, turns) = impact_phase_of_lane(impacts.angle[k]);
        impacts.angle[k] = wrapped;
        if TIMED {
            impacts.turns[k] = arcs.free_periods[k] + turns;
            impacts.duration[k] = Impacts::BETWEEN_PHASES;
        }
    }
}

#[cfg(test)]
mod tests {
    use core::f64::consts::PI;

    use super::*;
    use crate::numerics::testing::spread;

    #[test]
    fn crests_on_the_way_are_seen() {
        let mut missed = 0;
        for k in 0..200_000 {
            let start = PI * (4.0 * spread(k, 0.618_033_99) - 1.0);
            let ahead = (CREST - start).rem_euclid(TAU);
            // Many of them near the crest, before and behind it.
            let beyond = libm::exp10(-12.0 * spread(k, 0.569_840_29)) * if k % 2 == 0 { 1.0 } else { -1.0 };
            let time = ahead + beyond;
            if time > 0.0 {
                let none = meets_no_crest(start, time) != 0;
                assert!(!none || beyond < 0.0, "{start} {time}");
                assert!(none || beyond > -2.0e-8, "{start} {time}");
                missed += u32::from(!none && beyond < 0.0);
            }
        }
        assert!(missed > 0, "no time close enough to a crest");
        for off in [-1.0e-10, 0.0, 1.0e-10] {
            assert_eq!(meets_no_crest(CREST + off, 1.0), 0, "a start next to a crest");
        }
        assert_ne!(meets_no_crest(CREST + 1.0e-7, 1.0), 0);
    }
}
