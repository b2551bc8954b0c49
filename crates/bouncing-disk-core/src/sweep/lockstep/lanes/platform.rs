//! The platforms below the lanes: one for all of them, or one for each.

use super::{ROW, Row};
use crate::flight::platform::vibration::Crests;
use crate::flight::platform::vibration::Vibration;

/// The numbers of a platform that flights above it need (see [`Vibration`]).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Platform {
    pub(super) peak: f64,
    pub(super) separation_angle: f64,
    pub(super) separation_speed: f64,
    pub(super) separation_depth: f64,
    pub(super) doubtful_gap: f64,
    pub(super) crests: Crests,
}

impl From<&Vibration> for Platform {
    fn from(vibration: &Vibration) -> Self {
        Self {
            peak: vibration.peak_acceleration(),
            separation_angle: vibration.separation_angle,
            separation_speed: vibration.separation_speed,
            separation_depth: vibration.separation_depth,
            doubtful_gap: vibration.doubtful_gap,
            crests: vibration.crests,
        }
    }
}

/// The platforms of lanes that have one each.
#[derive(Debug, Clone)]
#[repr(align(64))]
pub(crate) struct Platforms {
    peak: Row,
    separation_angle: Row,
    separation_speed: Row,
    separation_depth: Row,
    doubtful_gap: Row,
    separation_to_crest: Row,
    rising_speed: Row,
}

/// The platform below a lane. A shared one stays in registers, which is why there are two kinds.
pub(super) trait PlatformLanes: Copy {
    fn lane(self, lane: usize) -> Platform;
}

impl PlatformLanes for Platform {
    #[inline(always)]
    fn lane(self, _: usize) -> Platform {
        self
    }
}

impl PlatformLanes for &Platforms {
    #[inline(always)]
    fn lane(self, lane: usize) -> Platform {
        Platform {
            peak: self.peak[lane],
            separation_angle: self.separation_angle[lane],
            separation_speed: self.separation_speed[lane],
            separation_depth: self.separation_depth[lane],
            doubtful_gap: self.doubtful_gap[lane],
            crests: Crests {
                separation_to_crest: self.separation_to_crest[lane],
                rising_speed: self.rising_speed[lane],
            },
        }
    }
}

impl Platforms {
    /// Still platforms.
    pub(super) const fn new() -> Self {
        Self {
            peak: ROW,
            separation_angle: ROW,
            separation_speed: ROW,
            separation_depth: ROW,
            doubtful_gap: ROW,
            separation_to_crest: ROW,
            rising_speed: ROW,
        }
    }

    #[inline(always)]
    pub(super) const fn set(&mut self, lane: usize, platform: Platform) {
        self.peak[lane] = platform.peak;
        self.separation_angle[lane] = platform.separation_angle;
        self.separation_speed[lane] = platform.separation_speed;
        self.separation_depth[lane] = platform.separation_depth;
        self.doubtful_gap[lane] = platform.doubtful_gap;
        self.separation_to_crest[lane] = platform.crests.separation_to_crest;
        self.rising_speed[lane] = platform.crests.rising_speed;
    }
}
