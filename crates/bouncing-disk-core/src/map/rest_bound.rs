//! When a chatter under any law of restitution is over at the latest: the error of a cut.

use crate::map::impact_map::{ImpactMap, ImpactState};
use crate::map::restitution_law::RestitutionLaw;

/// Rounding of the bound, with room to spare.
const ROUNDING: f64 = 1.0e-12;

/// How often the window is drawn in to the bound that it gave.
const WINDOWS: u32 = 4;

impl<L: RestitutionLaw> ImpactMap<L> {
    /// A time (rad) within which the disk comes to rest after an impact, for good until the platform falls
    /// away: a bound on the error of a cut that puts the disk on the platform at this impact. `None` where no
    /// bound is known: where the law has no [`rebound_sum`](RestitutionLaw::rebound_sum), or where the
    /// chatter is so long that the pull 1 - P sin tau may change by much. For the pull that P and the carried
    /// pair give (docs/numerics/restitution.md, "The error of a cut").
    ///
    /// ```
    /// # use bouncing_disk_core::map::KuwabaraKono;
    /// # use bouncing_disk_core::{ImpactMap, ImpactState, Phase, Vibration};
    /// // On a still platform the flights after an impact at speed v last (5/2) v^(4/5) together, where x = v^(1/5).
    /// let law = KuwabaraKono::new(0.5, 0.25)?;
    /// let map = ImpactMap::with_law(Vibration::new(0.0)?, law);
    /// let bound = map.comes_to_rest_within(ImpactState::new(Phase::new(1.0)?, -1e-5)?).expect("still");
    /// assert!((bound - 2.5e-4).abs() < 1e-8);
    /// # Ok::<(), bouncing_disk_core::Error>(())
    /// ```
    #[must_use]
    pub fn comes_to_rest_within(&self, impact: ImpactState) -> Option<f64> {
        let launches = self.law().rebound_sum(0.0 - impact.velocity())?;
        let phase = impact.phase();
        let (peak, pull) = (self.vibration().peak_acceleration(), self.vibration().contact_force(phase));
        let drift = self.vibration().velocity(phase).abs();
        // Also refuses what is no number.
        if !(launches >= 0.0 && pull > 0.0) {
            return None;
        }
        let mut window = 4.0 * launches / pull;
        let mut bound = None;
        for _ in 0..WINDOWS {
            let rate = (drift + peak * window).min(peak);
            let least = pull - rate * window;
            let share = rate * launches / (least * least);
            let together = 2.0 * launches / (least * (1.0 - share)) * (1.0 + ROUNDING);
            if !(least > 0.0 && share < 1.0 && together <= window) {
                break;
            }
            bound = Some(together);
            window = together;
        }
        bound
    }
}
