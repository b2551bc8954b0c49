//! Bounds on sustained speeds: no periodic orbit and no attractor exceeds them. The proof is in
//! docs/numerics-dynamics.md, "Bounded speeds".

use crate::flight::platform::phase::Phase;
use crate::map::impact_map::ImpactMap;

/// The largest factor by which rounding may reduce a bound, which is computed from positive numbers with at
/// most ten roundings.
const ROUNDINGS: f64 = 1.0 + 8.0 * f64::EPSILON;

impl ImpactMap {
    /// The bound M on the disk's own speed |u| after an impact, for every periodic orbit and every attractor.
    /// Here u = w + P cos tau, relative to the ground and not to the platform, in units of g/omega.
    ///
    /// An impact leaves u' = -r V + (1 + r) P cos tau', where the landing speed V satisfies V^2 = u^2 + 2 P
    /// (sin tau - sin tau') <= u^2 + 4 P. Hence |u'| <= f(|u|) = r sqrt(u^2 + 4 P) + (1 + r) P. The slope of f
    /// is below r < 1, so that f has one fixed point,
    ///
    /// M = q + r sqrt(q (q + 4/(1 + r))), q = P/(1 - r),
    ///
    /// and every impact shrinks any excess of |u| over M by at least the factor r. So a disk slower than M
    /// stays slower, a periodic orbit cannot be faster, and every other orbit tends to M or below. A disk at
    /// rest leaves the platform with at most P <= M.
    ///
    /// The bound is rounded upwards. It is P for restitution 0, and grows like 2 P/(1 - r) as the restitution
    /// tends to 1.
    ///
    /// ```
    /// # use bouncing_disk_core::{ImpactMap, Vibration};
    /// let map = ImpactMap::new(Vibration::new(2.0)?, 0.5)?;
    /// let bound = map.launch_speed_bound();
    /// let after_the_next = 0.5 * (bound * bound + 8.0).sqrt() + 3.0;
    /// assert!((after_the_next - bound).abs() < 1e-13);
    /// # Ok::<(), bouncing_disk_core::Error>(())
    /// ```
    #[must_use]
    pub fn launch_speed_bound(&self) -> f64 {
        let r = self.restitution();
        let p = self.vibration().peak_acceleration();
        // A subnormal quotient has lost digits.
        let q = if p > 0.0 { (p / (1.0 - r)).next_up() } else { 0.0 };
        ROUNDINGS * (q + r * (q.sqrt() * (q + 4.0 / (1.0 + r)).sqrt()))
    }

    /// The bound on the impact speed |w_A| (relative to the platform, units of g/omega) of every periodic
    /// orbit and every attractor: sqrt(M^2 + 4 P) + P with the [`Self::launch_speed_bound`] M. The first term
    /// bounds the disk's own landing speed, the second the platform's speed. Rounded upwards.
    ///
    /// Divided by pi it is in the units of the paper's figures
    /// ([`ImpactState::normalised_speed`](crate::ImpactState::normalised_speed)).
    #[must_use]
    pub fn impact_speed_bound(&self) -> f64 {
        let p = self.vibration().peak_acceleration();
        ROUNDINGS * (landing_speed_bound(self.launch_speed_bound(), p) + p)
    }

    /// The bound on the impact speed at this phase: sqrt(M^2 + 2 P (1 - sin tau)) + P cos tau with the
    /// [`Self::launch_speed_bound`] M, since the disk lands at the platform's height there. It is 0 if this
    /// is negative (a platform that falls faster than any disk is not hit). Rounded upwards.
    ///
    /// The impacts within this bound form the trapping region. An orbit that starts there stays, every periodic
    /// orbit and every attractor lies in it, and the distance of every other orbit from it tends to 0.
    ///
    /// ```
    /// # use bouncing_disk_core::{ImpactMap, Phase, Vibration};
    /// let map = ImpactMap::new(Vibration::new(2.0)?, 0.5)?;
    /// // A platform that rises at its fastest is hit hardest.
    /// assert!(map.impact_speed_bound_at(Phase::new(0.0)?) > map.impact_speed_bound_at(Phase::new(3.14)?));
    /// # Ok::<(), bouncing_disk_core::Error>(())
    /// ```
    #[must_use]
    pub fn impact_speed_bound_at(&self, phase: Phase) -> f64 {
        let p = self.vibration().peak_acceleration();
        let launch = self.launch_speed_bound();
        let landing = (launch * launch + 2.0 * p * (1.0 - phase.sin()).max(0.0)).sqrt();
        // While the platform falls, the rounding of the difference is relative to its larger part.
        (landing + p * phase.cos() + (ROUNDINGS - 1.0) * (landing + p)).max(0.0)
    }

    /// The bound on the duration of a flight (rad) of every periodic orbit and every attractor: the
    /// difference of launch and landing velocity, at most M + sqrt(M^2 + 4 P). Rounded upwards.
    #[must_use]
    pub fn flight_duration_bound(&self) -> f64 {
        let launch = self.launch_speed_bound();
        ROUNDINGS * (launch + landing_speed_bound(launch, self.vibration().peak_acceleration()))
    }
}

/// The largest landing speed of a disk launched at this speed, both relative to the ground.
fn landing_speed_bound(launch: f64, peak_acceleration: f64) -> f64 {
    (launch * launch + 4.0 * peak_acceleration).sqrt()
}

#[cfg(test)]
mod tests {
    use core::f64::consts::TAU;

    use super::*;
    use crate::flight::platform::phase::Phase;
    use crate::flight::platform::vibration::Vibration;
    use crate::map::impact_map::ImpactState;
    use crate::numerics::random::SplitMix64;

    fn map(peak_acceleration: f64, restitution: f64) -> ImpactMap {
        ImpactMap::new(Vibration::new(peak_acceleration).expect("legal"), restitution).expect("legal")
    }

    /// The speed after the fastest next impact, as in the proof.
    fn next_bound(map: &ImpactMap, speed: f64) -> f64 {
        let (r, p) = (map.restitution(), map.vibration().peak_acceleration());
        r * (speed * speed + 4.0 * p).sqrt() + (1.0 + r) * p
    }

    #[test]
    fn the_bound_is_the_fixed_point_up_to_the_limits_of_the_parameters() {
        for p in [0.0, 5e-324, 1e-300, 1e-9, 0.3, 1.0, 20.0, 1e4, Vibration::MAX_PEAK_ACCELERATION] {
            for r in [0.0, 5e-324, 1e-9, 0.1, 0.5, 0.9, 0.999_999, 1.0 - f64::EPSILON / 2.0] {
                let map = map(p, r);
                let bound = map.launch_speed_bound();
                assert!(bound.is_finite() && bound >= p, "{p} {r}: {bound}");
                let next = next_bound(&map, bound);
                assert!(next <= bound * (1.0 + 4.0 * f64::EPSILON), "{p} {r}: {next} above {bound}");
                if p >= 1e-300 {
                    assert!(bound - next <= 1e-14 * bound, "{p} {r}: {next} far below {bound}");
                }
                assert!(map.impact_speed_bound() >= bound && map.flight_duration_bound() >= bound);
            }
        }
        assert!((map(2.0, 0.0).launch_speed_bound() - 2.0).abs() < 1e-14, "restitution 0 leaves P");
        assert!(map(0.0, 0.5).launch_speed_bound() <= 0.0, "a platform at rest");
    }

    /// The region is never left, and is no larger than the bound over all phases.
    #[test]
    fn what_starts_in_the_trapping_region_stays_there() {
        let mut random = SplitMix64::new(5);
        let mut nearest: f64 = 0.0;
        for case in 0..2_000 {
            let map = map(if case % 10 == 0 { 0.0 } else { 12.0 * random.unit() }, 0.95 * random.unit());
            let phase = Phase::new(TAU * random.unit()).expect("finite");
            // Includes the boundary itself.
            let share = if case % 3 == 0 { 1.0 } else { random.unit() };
            let mut state =
                ImpactState::new(phase, -share * map.impact_speed_bound_at(phase)).expect("legal");
            for _ in 0..40 {
                let Ok(impact) = map.step(state) else { break };
                state = impact.into();
                let bound = map.impact_speed_bound_at(state.phase());
                assert!(-state.velocity() <= bound, "{map}: {state} beyond {bound}");
                assert!(bound <= map.impact_speed_bound());
                nearest = nearest.max(-state.velocity() / bound);
            }
        }
        assert!(nearest > 0.9, "the bound means something: {nearest}");
    }

    /// The excess over the bound shrinks by r at every impact, and a speed below the bound stays below it.
    #[test]
    fn random_orbits_obey_the_bounds() {
        let mut random = SplitMix64::new(18);
        let mut fastest: f64 = 0.0;
        for _ in 0..2_000 {
            let map = map(20.0 * random.unit(), 0.95 * random.unit());
            let (p, r) = (map.vibration().peak_acceleration(), map.restitution());
            let bound = map.launch_speed_bound();
            let phase = Phase::new(TAU * random.unit()).expect("finite");
            let mut state =
                ImpactState::new(phase, -3.0 * map.impact_speed_bound() * random.unit()).expect("legal");
            let launch = |state: ImpactState| (p * state.phase().cos() - r * state.velocity()).abs();
            let mut excess = (launch(state) - bound).max(0.0);
            for _ in 0..40 {
                let Ok(impact) = map.step(state) else { break };
                let inside = excess <= 0.0;
                state = impact.into();
                let next = (launch(state) - bound).max(0.0);
                assert!(next <= r * excess + 1e-12 * bound, "{map}: {next} after {excess}");
                if inside {
                    assert!(-state.velocity() <= map.impact_speed_bound(), "{map}");
                    assert!(impact.duration() <= map.flight_duration_bound(), "{map}");
                    fastest = fastest.max(launch(state) / bound);
                }
                excess = next;
            }
        }
        assert!(fastest > 0.5, "the bound means something: {fastest}");
    }
}
