//! The normal force between platform and disk at rest on it, Eq. (3).

use crate::flight::platform::phase::Phase;
use crate::flight::platform::vibration::Vibration;

impl Vibration {
    /// Weight that a resting disk puts on the platform per unit mass, 1 - P sin tau, in units of g (Eq. 3 as
    /// corrected in docs/errata.md); the disk separates where it falls to zero.
    #[must_use]
    #[inline]
    pub fn contact_force(&self, phase: Phase) -> f64 {
        1.0 - self.peak_acceleration() * phase.sin()
    }
}
