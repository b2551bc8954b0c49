//! What kind of flight follows each launch, as `Vibration::impact_after` decides it.

use core::f64::consts::TAU;

use pulp::{Simd, WithSimd};

use super::platform::Below;
use super::{LANES, Launches, Mask, mask};
use crate::elementary::CREST;
use crate::gap::CrestForm;

/// Coefficients of the pull's bound over half a radian (docs/numerics.md, section 9), rounded up.
const DRIFT_SHARE: f64 = 0.0417;
const BEND_SHARE: f64 = 0.0053;

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
    pub(super) platforms: &'a P,
    pub(super) launches: &'a Launches,
    pub(super) kinds: &'a mut Kinds,
}

impl<P: Below> WithSimd for Classify<'_, P> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { platforms, launches, kinds } = self;
        for lane in 0..LANES {
            let platform = platforms.lane(lane);
            let peak = platform.peak;
            let (angle, speed) = (launches.angle[lane], launches.speed[lane]);
            let cosine = peak * launches.cos[lane];
            let disk_speed = speed + cosine;
            let depth = peak - peak * launches.sin[lane];
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
        }
        for lane in 0..LANES {
            let platform = platforms.lane(lane);
            let (peak, speed) = (platform.peak, launches.speed[lane]);
            let (sine, cosine) = (peak * launches.sin[lane], peak * launches.cos[lane]);
            let pull = 1.0 - sine;
            let drift = if cosine < 0.0 { -cosine } else { 0.0 };
            let returns =
                0.25 * (if pull > 0.0 { pull } else { 0.0 }) + (DRIFT_SHARE * drift + BEND_SHARE * peak);
            kinds.slow[lane] = mask(speed < platform.long_launch_speed) & mask(speed < returns);
        }
        let special = kinds.slow.iter().zip(&kinds.low).fold(0, |any, (slow, low)| any | slow | low);
        kinds.special = special != 0;
    }
}
