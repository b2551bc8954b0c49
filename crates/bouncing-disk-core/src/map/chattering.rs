//! The chatter that follows a launch of an impact map.
//!
//! **The error of a cut.** On a platform with a constant pull a, S(v) is the sum of the launch speeds after an
//! impact at speed v, and the flights last (2/a) S(v) in total.
//!
//! As the platform moves, the pull changes, and with it the speed of return. Over a window of length W after
//! the impact, let the pull be at least alpha > 0 and change at a rate of at most delta. With b = P cos tau,
//! delta = min(|b| + P W, P) and alpha = a - delta W satisfy this.
//!
//! A flight in the window lasts at most 2 w/alpha, in which the pull changes by at most 2 delta w/alpha. Under
//! the least pull of the flight the disk rises by at most w^2/(2 least), and it falls back under at most the
//! greatest pull. So it returns with a speed of at most w sqrt(1 + 2 delta w/alpha^2) <= w (1 + K w), K =
//! delta/alpha^2. Hence v_(n+1) <= (1 + K r v_n) r v_n, and
//!
//! ```text
//! v_n - v_(n+1) >= (1 - r - K r^2 v_n) v_n >= (1 - theta)(1 - r) v_n,    theta = K S(v_0),
//! ```
//!
//! because r v_n/(1 - r) <= S(v_n) <= S(v_0). If theta < 1, the sum of the launch speeds exceeds S(v_0) by a
//! factor of at most 1/(1 - theta), and all flights together last at most
//!
//! ```text
//! T = (2/alpha) S(v_0)/(1 - theta).
//! ```
//!
//! If T <= W, all impacts lie in the window, by induction: each further flight needs w_n <= S(v_n), and the sum
//! up to v_n leaves at least this much. `ImpactMap::comes_to_rest_within` starts with the window 4 S/a, narrows
//! it to T up to three times, and returns the last bound, or `None` if the first window fails.
//!
//! The cut puts the disk on the platform up to T too early. Because the pull lasts over T, both motions rest
//! before the platform falls away, and leave it at the same phase. The omitted height is below w^2/(2 alpha).
//! The omitted axial impulses are the integral of the pull over the remaining time minus w, at most a' T,
//! where a' <= a + delta T is the greatest pull; friction in contact can transmit as much. So the error of
//! the angular speed is at most 2 mu a' T.

use crate::chatter::accumulation::{Accumulation, ChatterImpact};
use crate::chatter::impact_series::ChatterSeries;
use crate::flight::launch::Launch;
use crate::map::impact_map::{ImpactMap, ImpactState};
use crate::map::restitution_law::RestitutionLaw;

impl ImpactMap {
    /// The launch of the disk after an impact, at the impact speed times the restitution.
    #[must_use]
    pub const fn rebound(&self, impact: ImpactState) -> Launch {
        let speed = -self.restitution() * impact.velocity();
        Launch::known(impact.phase(), speed)
    }

    /// The accumulation point of the chatter that follows a launch. `None` unless a bound shows that the disk
    /// chatters to rest and that the closed form is exact to 1e-16 rad, for the pull 1 - P sin tau computed
    /// from P and the carried pair. Near weightlessness one rounding of P or of the phase changes the pull
    /// and the duration; this conditioning of the problem is not part of the bound.
    ///
    /// The accumulation point lies before the next separation. A chatter too short to change the phase has the
    /// duration 0.
    ///
    /// ```
    /// # use bouncing_disk_core::{ImpactMap, Launch, Phase, Vibration};
    /// // On a still platform the flights last 2 w, 2 w r, ...: 2 w/(1 - r) together.
    /// let map = ImpactMap::new(Vibration::new(0.0)?, 0.5)?;
    /// let rest = map.accumulation(Launch::new(Phase::new(1.0)?, 1e-3)?).expect("chatters to rest");
    /// assert!((rest.duration - 4e-3).abs() < 1e-15);
    /// # Ok::<(), bouncing_disk_core::Error>(())
    /// ```
    #[must_use]
    #[inline]
    pub fn accumulation(&self, launch: Launch) -> Option<Accumulation> {
        self.vibration().accumulation(launch.phase(), launch.relative_speed(), self.restitution())
    }

    /// The chatter after a launch in closed form: all its impacts and their sums at once. The launch must be
    /// one that [`Self::accumulation`] accepts with a duration above 0, and the restitution above 0.
    #[must_use]
    pub fn chatter_series(&self, launch: Launch) -> ChatterSeries {
        self.vibration().chatter_series(launch.phase(), launch.relative_speed(), self.restitution())
    }

    /// The impacts of the chatter after a launch that [`Self::accumulation`] accepts with a duration above 0.
    /// They end when an impact carries less than 1e-17 of the first one's impulse, or if its launch speed is
    /// below the smallest normal number.
    ///
    /// They are computed lazily. There are 39/(1 - r) of them, so near r = 1 this may take forever.
    /// [`Self::chatter_series`] returns all of them and their sums at once.
    pub fn chatter_impacts(&self, launch: Launch) -> impl Iterator<Item = ChatterImpact> + use<> {
        self.vibration().chatter_impacts(launch.phase(), launch.relative_speed(), self.restitution())
    }

    /// Whether the disk is certain to chatter to rest after a launch before the platform falls away. This is
    /// proven long before [`Self::accumulation`] can locate the accumulation point.
    #[must_use]
    #[inline]
    pub fn chatters_to_rest(&self, launch: Launch) -> bool {
        self.vibration().chatters_to_rest(launch.phase(), launch.relative_speed(), self.restitution())
    }
}

/// A generous bound on the relative rounding error of the result.
const ROUNDING: f64 = 1.0e-12;

/// The number of windows tried; each after the first is as long as the bound from the previous one.
const WINDOWS: u32 = 4;

impl<L: RestitutionLaw> ImpactMap<L> {
    /// A time (rad) within which the disk comes to rest after an impact, before the platform falls away. It
    /// bounds the error of a cut that puts the disk on the platform at this impact. It is `None` if no bound is
    /// known: the law has no [`rebound_sum`](RestitutionLaw::rebound_sum), or the chatter is so long that the
    /// pull 1 - P sin tau may change considerably. The bound holds for the pull computed from P and the carried
    /// pair (derived at the head of this file).
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
        // NaN fails here too.
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
