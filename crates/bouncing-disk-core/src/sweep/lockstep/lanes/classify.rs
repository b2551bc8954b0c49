//! What kind of flight follows each launch, as `Vibration::impact_after` decides it, and the free flight of disks that rise
//! above the crests.

use pulp::{Simd, WithSimd};

use super::platform::PlatformLanes;
use super::{LANES, Mask, Rows, mask};
use crate::flight::bounds::{arc_speed, may_return_soon};
use crate::flight::first_impact::FASTEST_ARC;
use crate::numerics::elementary::nearest_periods;

/// Kinds of launches; one that is neither rises above the crests.
#[derive(Debug, Clone)]
#[repr(align(64))]
pub(super) struct Kinds {
    /// May land within half a radian.
    pub(super) slow: Mask,
    /// May be hit before the first crest.
    pub(super) low: Mask,
    /// Whether any lane is slow, low or does not come down within the longest flight.
    pub(super) special: bool,
}

impl Kinds {
    pub(super) const fn new() -> Self {
        Self { slow: [0; LANES], low: [0; LANES], special: false }
    }
}

/// Sorts the launches of a batch: those that are `SET`, else those that follow the impacts before.
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
            // No comparison holds with what is not a number.
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
