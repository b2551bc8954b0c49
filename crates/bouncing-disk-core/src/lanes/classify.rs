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
        let (mut special, mut endless) = (0, 0);
        for lane in 0..LANES {
            let platform = platforms.lane(lane);
            let peak = platform.peak;
            let (angle, speed) = (launches.from.angle[lane], launches.speed[lane]);
            let (sine, cosine) = (peak * launches.from.sin[lane], peak * launches.from.cos[lane]);
            let disk_speed = speed + cosine;
            let depth = peak - sine;
            // Down to the height of the crests the disk flies free. Not a number where it stays below: no comparison with it
            // holds.
            let fall = (disk_speed * disk_speed - 2.0 * depth).sqrt();
            let free = disk_speed + fall;
            let (periods, rest) = nearest_periods(free);
            arcs.fall[lane] = fall;
            arcs.free_periods[lane] = periods;
            arcs.start[lane] = angle + rest;
            let low = !mask(platform.crests.surely_cleared(peak, angle, disk_speed, fall));
            let slow = mask(may_return_soon(peak, sine, cosine, speed));
            kinds.low[lane] = low;
            kinds.slow[lane] = slow;
            special |= low | slow;
            endless |= !mask(fall <= LONGEST_FALL);
        }
        kinds.special = (special | endless) != 0;
    }
}
