//! What an impact map says of the chatter that follows a launch.

use crate::chatter::accumulation::{Accumulation, ChatterImpact};
use crate::chatter::impact_series::ChatterSeries;
use crate::flight::launch::Launch;
use crate::map::impact_map::{ImpactMap, ImpactState};

impl ImpactMap {
    /// How the disk leaves the platform after an impact: with restitution times its speed.
    #[must_use]
    pub const fn rebound(&self, impact: ImpactState) -> Launch {
        let speed = -self.restitution() * impact.velocity();
        Launch::known(impact.phase(), speed)
    }

    /// The accumulation point of the chatter that follows a launch, or `None` unless a bound shows that the disk chatters to
    /// rest and the closed form is exact to 1e-16 rad, for the pull 1 - P sin tau that P and the carried pair give. Next to
    /// weightlessness one rounding of P or of the phase is another pull, and the duration another one: that is the
    /// conditioning of the problem and not counted in the bound.
    ///
    /// The accumulation point lies before the next separation. A chatter that ends before it has changed the phase has the
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

    /// The chatter after a launch in closed form, for one that [`Self::accumulation`] accepts with a duration above 0 and a
    /// restitution above 0: every impact of it, and their sums, at once.
    #[must_use]
    pub fn chatter_series(&self, launch: Launch) -> ChatterSeries {
        self.vibration().chatter_series(launch.phase(), launch.relative_speed(), self.restitution())
    }

    /// The impacts of the chatter after a launch that [`Self::accumulation`] accepts with a duration above 0, until they
    /// carry less than 1e-17 of the first one's impulse or are launched with less than the smallest normal number.
    ///
    /// They are computed one after the other as they are asked for, and there are 39/(1 - r) of them: next to r = 1 that
    /// may take for ever. [`Self::chatter_series`] has every one of them, and their sums, at once.
    pub fn chatter_impacts(&self, launch: Launch) -> impl Iterator<Item = ChatterImpact> + use<> {
        self.vibration().chatter_impacts(launch.phase(), launch.relative_speed(), self.restitution())
    }

    /// Whether the disk is certain to chatter to rest after a launch before the platform falls away: proven long before
    /// [`Self::accumulation`] can say where.
    #[must_use]
    #[inline]
    pub fn chatters_to_rest(&self, launch: Launch) -> bool {
        self.vibration().chatters_to_rest(launch.phase(), launch.relative_speed(), self.restitution())
    }
}
