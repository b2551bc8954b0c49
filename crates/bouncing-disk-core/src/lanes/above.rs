//! The impact of disks that rise above the crests: [`Vibration::impact_from_above`](crate::Vibration), many at a time.

use core::f64::consts::TAU;

use pulp::{Simd, WithSimd};

use super::platform::Below;
use super::{Arcs, Impacts, LANES, Mask, ROW, Row, kept, mask};
use crate::elementary::{nearby_wrapped_of_lane, nearest_whole, rotated, sin_cos_of_lane};
use crate::gap::{CrestForm, Jet};

/// Comparisons that decide which path a lane takes keep this far from a tie (radians; relative to the pull).
const CLEAR: f64 = 1.0e-9;

/// Intermediate results of all lanes.
#[derive(Debug, Clone)]
#[repr(align(64))]
pub(super) struct Work {
    /// Where the first step leads.
    time: Row,
    sin: Row,
    cos: Row,
    root: Row,
    step: Row,
    inverse: Row,
    /// Lanes whose first step is that of the search.
    stepped: Mask,
    /// Lanes landed.
    pub(super) landed: Mask,
    /// Whether all lanes have landed.
    pub(super) all: bool,
}

impl Work {
    pub(super) const fn new() -> Self {
        Self {
            time: ROW,
            sin: ROW,
            cos: ROW,
            root: ROW,
            step: ROW,
            inverse: ROW,
            stepped: [0; LANES],
            landed: [0; LANES],
            all: false,
        }
    }
}

impl Work {
    /// Where the first step of a lane has led; zero if it was none of the search.
    #[inline(always)]
    pub(super) fn reached(&self, k: usize) -> f64 {
        kept(self.stepped[k], self.time[k])
    }
}

/// Flights: two evaluations of the gap and the last step. Lanes that need more are left to the search.
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
        for k in 0..N {
            (work.sin[k], work.cos[k]) = sin_cos_of_lane(arcs.start[k] + work.time[k]);
        }
        last_step::<P, N>(platforms, arcs, work);
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
        // No crest between the start and the step's end.
        let crests = |angle: f64| nearest_whole(angle * (1.0 / TAU) - 0.75);
        let within = mask(crests(start + (step + CLEAR)) <= crests(start - CLEAR));
        let inside = mask(jet.slope < 0.0) & mask(step > 0.0) & mask(work.root[k] > 0.0) & within;
        // Behind a crest, the platform falling away faster than the disk may fall: two windows.
        let two_windows = mask(jet.curvature > -CLEAR)
            & mask(jet.third < CLEAR * platforms.lane(k).peak)
            & mask(arcs.fall[k] < platforms.lane(k).peak);
        work.time[k] = kept(!near, step);
        let regular = arcs.regular[k] & !two_windows;
        work.stepped[k] = regular & inside & !near;
        work.landed[k] = regular & (near | inside);
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
