//! Where the platform falls away from a disk that rests on it: the separation phase, Eq. (15). Its angle is worked out
//! once, when the vibration is made (`vibration.rs`).

use core::f64::consts::TAU;

use crate::flight::platform::phase::Phase;
use crate::flight::platform::vibration::Vibration;

impl Vibration {
    /// The phase at which a disk at rest on the platform separates, asin(1/P) (Eq. 15), or `None` if the
    /// platform never falls away (P <= 1).
    #[must_use]
    pub fn separation_phase(&self) -> Option<Phase> {
        let p = self.peak_acceleration();
        (p > 1.0).then(|| Phase::from_parts(self.separation_angle, 1.0 / p, self.separation_speed / p))
    }

    /// Whether the platform falls away from a resting disk at this angle (rad) in [0, 2 pi): sigma <= tau <
    /// pi - sigma.
    #[must_use]
    #[inline(always)]
    pub fn falls_away_at(&self, angle: f64) -> bool {
        angle >= self.separation_angle && angle < self.retention_angle
    }

    /// Time from `angle` to the next phase sigma, in (0, 2 pi].
    #[inline(always)]
    pub(crate) fn time_to_separation(&self, angle: f64) -> f64 {
        let ahead = self.separation_angle - angle;
        if ahead > 0.0 { ahead } else { ahead + TAU }
    }
}
