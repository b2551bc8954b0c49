//! What kind of flight follows each launch, as `Vibration::impact_after` decides it, and the free flight of disks that rise
//! above the crests.

use core::f64::consts::TAU;

use pulp::{Simd, WithSimd};

use super::platform::Below;
use super::{Arcs, LANES, Launches, Mask, mask};
use crate::elementary::{CREST, nearest_periods};
use crate::flight::MAX_FLIGHT_DURATION;
use crate::gap::CrestForm;
use crate::shortcuts::may_return_soon;

/// Kinds of launches; one that is neither rises above the crests.
#[derive(Debug, Clone)]
#[repr(align(64))]
pub(super) struct Kinds {
    /// May land within half a radian.
    pub(super) slow: Mask,
    /// May be hit before the first crest.
    pub(super) low: Mask,
    /// Whether any lane is slow or low.
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
        let mut any_slow = 0;
        for lane in 0..LANES {
            let platform = platforms.lane(lane);
            let peak = platform.peak;
            let (angle, speed) = (launches.from.angle[lane], launches.speed[lane]);
            let cosine = peak * launches.from.cos[lane];
            let disk_speed = speed + cosine;
            let depth = peak - peak * launches.from.sin[lane];
            let rising = CrestForm { peak, angle, speed: disk_speed, depth };
            let ahead = platform.separation_angle - angle;
            let inflection = if ahead > 0.0 { ahead } else { ahead + TAU };
            let crest = inflection + (CREST - platform.separation_angle);
            let from_falling_away = mask(angle >= platform.separation_angle) & mask(angle < CREST);
            let doubtful = platform.doubtful_gap;
            let above = mask(rising.gap_over(platform.separation_depth, inflection) > doubtful)
                & mask(rising.gap_over(0.0, crest) > doubtful);
            let no_dip =
                mask(disk_speed - inflection >= platform.separation_speed) | mask(disk_speed <= crest);
            kinds.low[lane] = !(from_falling_away | (above & no_dip));
            let slow = mask(speed < platform.long_launch_speed);
            kinds.slow[lane] = slow;
            any_slow |= slow;
            // Down to the height of the crests the disk flies free. Not a number where it stays below: no comparison with it
            // holds.
            let fall = (disk_speed * disk_speed - 2.0 * depth).sqrt();
            let free = disk_speed + fall;
            let (periods, rest) = nearest_periods(free);
            arcs.fall[lane] = fall;
            arcs.free_periods[lane] = periods;
            arcs.start[lane] = angle + rest;
            arcs.regular[lane] = mask(free <= MAX_FLIGHT_DURATION);
        }
        if any_slow != 0 {
            slow(platforms, launches, kinds);
        }
        let special = kinds.slow.iter().zip(&kinds.low).fold(0, |any, (slow, low)| any | slow | low);
        kinds.special = special != 0;
    }
}

/// Marks the launches that may land within half a radian.
#[inline(always)]
fn slow<P: Below>(platforms: P, launches: Launches<'_>, kinds: &mut Kinds) {
    for lane in 0..LANES {
        let platform = platforms.lane(lane);
        let (peak, speed) = (platform.peak, launches.speed[lane]);
        let (sine, cosine) = (peak * launches.from.sin[lane], peak * launches.from.cos[lane]);
        kinds.slow[lane] &= mask(may_return_soon(peak, sine, cosine, speed));
    }
}
