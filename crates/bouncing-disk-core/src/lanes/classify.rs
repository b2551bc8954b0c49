//! What kind of flight follows each launch, as `Vibration::impact_after` decides it, and the free flight of disks that rise
//! above the crests.

use pulp::{Simd, WithSimd};

use super::platform::Below;
use super::{Arcs, LANES, Launches, Mask, mask};
use crate::elementary::nearest_periods;
use crate::flight::LONGEST_FALL;
use crate::shortcuts::may_return_soon;

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

pub(super) struct Classify<'a, P> {
    pub(super) platforms: P,
    pub(super) launches: Launches<'a>,
    pub(super) kinds: &'a mut Kinds,
    pub(super) arcs: &'a mut Arcs,
}

impl<P: Below> WithSimd for Classify<'_, P> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { platforms, launches, kinds, arcs } = self;
        for lane in 0..LANES {
            let peak = platforms.lane(lane).peak;
            let speed = launches.speed[lane];
            let (sine, cosine) = (peak * launches.from.sin[lane], peak * launches.from.cos[lane]);
            let disk_speed = speed + cosine;
            // Not a number where the disk stays below the crests: no comparison with it holds.
            arcs.fall[lane] = (disk_speed * disk_speed - 2.0 * (peak - sine)).sqrt();
            kinds.slow[lane] = mask(may_return_soon(peak, sine, cosine, speed));
            arcs.start[lane] = disk_speed;
        }
        let (mut special, mut endless) = (0, 0);
        for lane in 0..LANES {
            let platform = platforms.lane(lane);
            let (angle, disk_speed, fall) = (launches.from.angle[lane], arcs.start[lane], arcs.fall[lane]);
            // Down to the height of the crests the disk flies free.
            let (periods, rest) = nearest_periods(disk_speed + fall);
            arcs.free_periods[lane] = periods;
            arcs.start[lane] = angle + rest;
            let low = !mask(platform.crests.surely_cleared(platform.peak, angle, disk_speed, fall));
            kinds.low[lane] = low;
            special |= low | kinds.slow[lane];
            endless |= !mask(fall <= LONGEST_FALL);
        }
        kinds.special = (special | endless) != 0;
    }
}
