//! The impact of disks that rise above the crests: [`Vibration::impact_from_above`](crate::Vibration), many at a time.

use core::f64::consts::TAU;

use pulp::{Simd, WithSimd};

use super::platform::Below;
use super::{Arcs, Impacts, LANES, Mask, ROW, Row, kept, mask};
use crate::elementary::{CREST, nearby_wrapped_of_lane, nearest_whole, rotated, sin_cos_of_lane};
use crate::gap::{CrestForm, Jet};

/// Comparisons that decide which path a lane takes keep this far from a tie (radians; relative to the pull).
const CLEAR: f64 = 1.0e-9;

/// One in so many lanes must need a third evaluation for all to get one.
const MANY: usize = 4;

/// Intermediate results of all lanes.
#[derive(Debug, Clone)]
#[repr(align(64))]
pub(super) struct Work {
    time: Row,
    /// Where the first step of the search leads; zero where it is another one.
    pub(super) reached: Row,
    sin: Row,
    cos: Row,
    root: Row,
    step: Row,
    inverse: Row,
    /// Lanes whose first step is not that of the model.
    astray: Mask,
    /// Lanes landed.
    pub(super) landed: Mask,
    /// Whether all lanes have landed.
    pub(super) all: bool,
}

impl Work {
    pub(super) const fn new() -> Self {
        Self {
            time: ROW,
            reached: ROW,
            sin: ROW,
            cos: ROW,
            root: ROW,
            step: ROW,
            inverse: ROW,
            astray: [0; LANES],
            landed: [0; LANES],
            all: false,
        }
    }
}

/// Flights: two evaluations of the gap, a third one if many lanes need it, and the last step. Lanes that need more are left
/// to the search.
pub(super) struct Fly<'a, P, const N: usize> {
    pub(super) platforms: P,
    pub(super) arcs: &'a Arcs,
    pub(super) work: &'a mut Work,
    pub(super) impacts: &'a mut Impacts,
}

impl<P: Below, const N: usize> WithSimd for Fly<'_, P, N> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { platforms, arcs, work, impacts } = self;
        for k in 0..N {
            (work.sin[k], work.cos[k]) = sin_cos_of_lane(arcs.start[k]);
        }
        first_step::<P, N>(platforms, arcs, work);
        if work.astray.iter().take(N).fold(0, |any, astray| any | astray) != 0 {
            other_first_step::<P, N>(platforms, arcs, work);
        }
        for k in 0..N {
            (work.sin[k], work.cos[k]) = sin_cos_of_lane(arcs.start[k] + work.time[k]);
        }
        last_step::<P, N>(platforms, arcs, work);
        let missing: u64 = (0..N).map(|k| mask(work.reached[k] > 0.0) & !work.landed[k] & 1).sum();
        if missing >= (N / MANY) as u64 {
            second_step::<P, N>(platforms, arcs, work);
            for k in 0..N {
                (work.sin[k], work.cos[k]) = sin_cos_of_lane(arcs.start[k] + work.time[k]);
            }
            last_step::<P, N>(platforms, arcs, work);
        }
        impact::<P, N>(platforms, arcs, work, impacts);
    }
}

/// Gap and derivatives at the height of the crests, with the pair there known: [`jet`] at the time zero, where products
/// with the time vanish.
#[inline(always)]
fn first_jet<P: Below>(platforms: P, arcs: &Arcs, work: &Work, k: usize) -> Jet {
    let peak = platforms.lane(k).peak;
    let (platform, third) = (peak * work.sin[k], peak * work.cos[k]);
    Jet {
        gap: peak - platform,
        slope: -arcs.fall[k] - third,
        curvature: platform - 1.0,
        third,
        platform,
        sin: work.sin[k],
        cos: work.cos[k],
    }
}

/// Gap and derivatives at the time reached.
#[inline(always)]
fn jet<P: Below>(platforms: P, arcs: &Arcs, work: &Work, k: usize) -> Jet {
    form(platforms, arcs, k).jet_of_pair(work.time[k], work.sin[k], work.cos[k])
}

#[inline(always)]
fn form<P: Below>(platforms: P, arcs: &Arcs, k: usize) -> CrestForm {
    CrestForm { peak: platforms.lane(k).peak, angle: arcs.start[k], speed: -arcs.fall[k], depth: 0.0 }
}

/// Lanes with no crest between the start and so much later.
#[inline(always)]
fn meets_no_crest(start: f64, time: f64) -> u64 {
    let crests = |angle: f64| nearest_whole(angle * (1.0 / TAU) - 0.75);
    mask(crests(start + (time + CLEAR)) <= crests(start - CLEAR))
}

/// The first step of the search of one flight; none where the root is near.
#[inline(always)]
fn first_step<P: Below, const N: usize>(platforms: P, arcs: &Arcs, work: &mut Work) {
    for k in 0..N {
        work.root[k] = first_jet(platforms, arcs, work, k).radicand().sqrt();
    }
    for k in 0..N {
        work.step[k] = first_jet(platforms, arcs, work, k).quadratic_step(work.root[k]);
    }
    for k in 0..N {
        work.step[k] = first_jet(platforms, arcs, work, k).corrected_step(work.step[k], work.root[k]);
    }
    for k in 0..N {
        let jet = first_jet(platforms, arcs, work, k);
        let (start, step) = (arcs.start[k], work.step[k]);
        let near = mask(jet.is_near_root());
        let within = meets_no_crest(start, step);
        let inside = mask(jet.slope < 0.0) & mask(step > 0.0) & mask(work.root[k] > 0.0) & within;
        // Behind a crest, the platform falling away faster than the disk may fall: two windows.
        let two_windows = mask(jet.curvature > -CLEAR)
            & mask(jet.third < CLEAR * platforms.lane(k).peak)
            & mask(arcs.fall[k] < platforms.lane(k).peak);
        work.time[k] = kept(!near, step);
        let regular = arcs.regular[k] & !two_windows;
        work.reached[k] = kept(regular & inside & !near, step);
        work.astray[k] = regular & !inside & !near & mask(jet.gap > 0.0);
        work.landed[k] = regular & (near | inside);
    }
}

/// The first step of the search where the model leads nowhere: Newton's, or half way to the crest.
#[inline(always)]
fn other_first_step<P: Below, const N: usize>(platforms: P, arcs: &Arcs, work: &mut Work) {
    for k in 0..N {
        let jet = first_jet(platforms, arcs, work, k);
        let (turned, _) = nearby_wrapped_of_lane(arcs.start[k]);
        let crest = (CREST - turned) + kept(mask(turned >= CREST), TAU);
        let model = mask(work.root[k] > 0.0);
        let newton = -(jet.gap * (1.0 / jet.slope));
        let step = if model != 0 { work.step[k] } else { newton };
        let fine = mask(jet.slope < 0.0) & mask(step > 0.0) & mask(step < crest);
        let next = if fine != 0 { step } else { 0.5 * crest };
        let astray = work.astray[k];
        work.time[k] = if astray != 0 { next } else { work.time[k] };
        work.reached[k] = if astray != 0 { next } else { work.reached[k] };
        work.landed[k] |= astray;
    }
}

/// The step after the second evaluation, where the root is not near: that of the search if it stays in the window.
#[inline(always)]
fn second_step<P: Below, const N: usize>(platforms: P, arcs: &Arcs, work: &mut Work) {
    for k in 0..N {
        work.root[k] = jet(platforms, arcs, work, k).radicand().sqrt();
    }
    for k in 0..N {
        work.step[k] = jet(platforms, arcs, work, k).quadratic_step(work.root[k]);
    }
    for k in 0..N {
        work.step[k] = jet(platforms, arcs, work, k).corrected_step(work.step[k], work.root[k]);
    }
    for k in 0..N {
        let jet = jet(platforms, arcs, work, k);
        let (time, reached) = (work.time[k], work.reached[k]);
        let next = time + work.step[k];
        // The window ends where the last evaluation was, or at the crest.
        let later = mask(jet.gap > 0.0);
        let within = (later & mask(next > time) & meets_no_crest(arcs.start[k], next))
            | (!later & mask(next > 0.0) & mask(next < time));
        let inside = mask(jet.slope < 0.0) & mask(work.root[k] > 0.0) & within;
        let moves = !work.landed[k] & mask(reached > 0.0) & inside;
        work.time[k] = if moves != 0 { next } else { time };
        work.landed[k] |= moves;
    }
}

#[inline(always)]
fn last_step<P: Below, const N: usize>(platforms: P, arcs: &Arcs, work: &mut Work) {
    for k in 0..N {
        let jet = jet(platforms, arcs, work, k);
        let inverse = 1.0 / jet.slope;
        work.inverse[k] = inverse;
        work.step[k] = -(jet.gap * inverse);
        work.landed[k] &= mask(jet.is_near_root());
    }
    for k in 0..N {
        let jet = jet(platforms, arcs, work, k);
        work.step[k] = jet.reverted(work.step[k], work.inverse[k]);
    }
}

#[inline(always)]
fn impact<P: Below, const N: usize>(platforms: P, arcs: &Arcs, work: &mut Work, impacts: &mut Impacts) {
    let mut all = u64::MAX;
    for k in 0..N {
        let delta = work.step[k];
        let time = work.time[k] + delta;
        let (sin, cos) = rotated(work.sin[k], work.cos[k], delta);
        let velocity = (-arcs.fall[k] - time) - platforms.lane(k).peak * cos;
        let (wrapped, turns) = nearby_wrapped_of_lane(arcs.start[k] + time);
        impacts.angle[k] = kept(mask(wrapped < TAU), wrapped);
        impacts.sin[k] = sin;
        impacts.cos[k] = cos;
        impacts.velocity[k] = kept(mask(velocity < 0.0), velocity);
        impacts.turns[k] = arcs.free_periods[k] + turns;
        impacts.duration[k] = Impacts::BETWEEN_PHASES;
        all &= work.landed[k];
    }
    work.all = all == u64::MAX;
}
