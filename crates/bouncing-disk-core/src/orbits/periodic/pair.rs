//! The two orbits with one impact every k periods of the platform, in closed form (docs/numerics-dynamics.md,
//! "Orbits with one impact").

use core::f64::consts::TAU;

use super::{Multipliers, PeriodicOrbit};
use crate::flight::platform::phase::Phase;
use crate::map::impact_map::{ImpactMap, ImpactState};
use crate::numerics::error::Error;

/// Largest difference, relative to the flight, between the first impact or its speed and the closed form at
/// which they still count as equal. The root is simple: an earlier one is at least 2 |w_A|/(1 + P) away,
/// which is 3e-8 of a flight for the largest P.
const SAME_IMPACT: f64 = 1.0e-9;

/// One of the two orbits with one impact every k periods of the platform, in closed form.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct PeriodOneOrbit {
    /// The impact: cos tau = k (1 - r)/((1 + r) Gamma), w_A = -2 pi k/(1 + r).
    pub state: ImpactState,
    /// The periods k >= 1 of the platform from one impact to the next.
    pub platform_periods: u64,
    /// Trace of the derivative of the map at this impact: 1 + r^2 - (1 + r)^2 P sin tau.
    pub trace: f64,
    /// Determinant of the derivative of the map at this impact: r^2, in [0, 1].
    pub determinant: f64,
}

impl PeriodOneOrbit {
    fn new(phase: Phase, platform_periods: u64, map: &ImpactMap) -> Option<Self> {
        let r = map.restitution();
        let state = ImpactState::new(phase, -TAU * platform_periods as f64 / (1.0 + r)).ok()?;
        let (sum, determinant) = (1.0 + r, r * r);
        let trace = 1.0 + determinant - sum * sum * (map.vibration().peak_acceleration() * phase.sin());
        Some(Self { state, platform_periods, trace, determinant })
    }

    /// The Floquet multipliers.
    #[must_use]
    pub fn multipliers(&self) -> Multipliers {
        Multipliers::of_invariants(self.trace, self.determinant)
    }

    /// Whether the closed form is an orbit of this map: no earlier impact ends its flight, and the disk does
    /// take off.
    ///
    /// # Errors
    /// Errors of [`ImpactMap::step`] except [`Error::NoLiftOff`].
    pub fn is_admissible(&self, map: &ImpactMap) -> Result<bool, Error> {
        let flight = TAU * self.platform_periods as f64;
        let room = SAME_IMPACT * flight;
        // The conditions of the closed form. A flight magnifies the rounding of its phase by P^2.
        let r = map.restitution();
        let peak = map.vibration().peak_acceleration();
        let platform = peak * self.state.phase().cos() - 0.5 * flight * ((1.0 - r) / (1.0 + r));
        let impact = self.state.velocity() + flight / (1.0 + r);
        if platform.abs() > room + 4.0 * f64::EPSILON * peak || impact.abs() > room {
            return Ok(false);
        }
        match map.step(self.state) {
            Ok(impact) => Ok((impact.duration() - flight).abs() <= room),
            Err(Error::NoLiftOff { .. }) => Ok(false),
            Err(error) => Err(error),
        }
    }

    /// The orbit as a [`PeriodicOrbit`]; `None` if it is not admissible.
    ///
    /// # Errors
    /// Errors of [`Self::is_admissible`].
    pub fn orbit(&self, map: &ImpactMap) -> Result<Option<PeriodicOrbit>, Error> {
        if !self.is_admissible(map)? {
            return Ok(None);
        }
        let (_, monodromy) = map.step_with_derivative(self.state)?;
        Ok(Some(PeriodicOrbit::of(map, vec![self.state], self.platform_periods, monodromy)))
    }
}

/// Both orbits with one impact every k periods of the platform. They are born together, at the fold at
/// Gamma = k (1 - r)/(1 + r).
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct PeriodOnePair {
    /// The orbit with its phase in [0, pi/2]: a node or focus that attracts from the fold to its period
    /// doubling.
    pub node: PeriodOneOrbit,
    /// The orbit with the opposite phase, in [3 pi/2, 2 pi) (0 at the fold): a saddle with positive
    /// multipliers.
    pub saddle: PeriodOneOrbit,
}

impl ImpactMap {
    /// Both orbits with one impact every `platform_periods` >= 1 periods of the platform; `None` below their
    /// birth at Gamma = k (1 - r)/(1 + r).
    ///
    /// An earlier impact may still prevent one of them: see [`PeriodOneOrbit::is_admissible`].
    ///
    /// ```
    /// # use bouncing_disk_core::{ImpactMap, Vibration};
    /// let map = ImpactMap::new(Vibration::from_axial_forcing(0.45)?, 0.5)?;
    /// let pair = map.period_one_pair(1).expect("born at Gamma = 1/3");
    /// assert!(pair.node.multipliers().spectral_radius() < 1.0 && pair.node.is_admissible(&map)?);
    /// assert!(pair.saddle.multipliers().spectral_radius() > 1.0 && pair.saddle.is_admissible(&map)?);
    /// # Ok::<(), bouncing_disk_core::Error>(())
    /// ```
    #[must_use]
    pub fn period_one_pair(&self, platform_periods: u64) -> Option<PeriodOnePair> {
        if platform_periods == 0 {
            return None;
        }
        let early = self.period_one(platform_periods)?.phase();
        // Mirroring rounds the angle, but not sine and cosine.
        let late = if early.angle() > 0.0 {
            Phase::from_parts(TAU - early.angle(), -early.sin(), early.cos())
        } else {
            early
        };
        let node = PeriodOneOrbit::new(early, platform_periods, self)?;
        Some(PeriodOnePair { node, saddle: PeriodOneOrbit::new(late, platform_periods, self)? })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::map::impact_map::map;

    /// The closed form against the derivative of the exact map, for both orbits, stable and unstable.
    #[test]
    fn multipliers_are_those_of_the_map_to_1e_14() {
        let mut admissible = 0;
        for tenths in 1..10 {
            let r = f64::from(tenths) / 10.0;
            for k in 1..=3 {
                let birth = k as f64 * (1.0 - r) / (1.0 + r);
                for above in [1e-6, 0.01, 0.1, 0.3, 1.0] {
                    let map = map(birth + above, r);
                    let pair = map.period_one_pair(k).expect("above its birth");
                    for orbit in [pair.node, pair.saddle] {
                        let Some(found) = orbit.orbit(&map).expect("no failure") else { continue };
                        admissible += 1;
                        let monodromy = found.monodromy;
                        let trace = monodromy.x_axis.x + monodromy.y_axis.y;
                        let size = 1.0 + monodromy.x_axis.length().max(monodromy.y_axis.length());
                        assert!((trace - orbit.trace).abs() <= 1e-14 * size, "{map} {k}: {trace} {orbit:?}");
                        let products = (monodromy.x_axis.x * monodromy.y_axis.y).abs() + 1.0;
                        let determinant = monodromy.determinant();
                        assert!((determinant - orbit.determinant).abs() <= 1e-14 * products, "{map} {k}");
                        assert_eq!(found.platform_periods, k);
                    }
                    let Multipliers::Real(large, small) = pair.saddle.multipliers() else {
                        panic!("a saddle: {pair:?}")
                    };
                    assert!(large > 1.0 && small > 0.0 && small < 1.0);
                }
            }
        }
        assert!(admissible > 150, "{admissible}");
    }

    #[test]
    fn the_pair_is_one_orbit_at_the_fold_and_none_before() {
        // cos tau = 0.5/1.5/(1/3) is 1 exactly.
        let third = 1.0_f64 / 3.0;
        let at =
            [third.next_down(), third, third.next_up()].map(|forcing| map(forcing, 0.5).period_one_pair(1));
        let closed =
            at.iter().flatten().find(|pair| pair.node.state.phase().angle() <= 0.0).expect("the fold");
        assert_eq!(closed.node, closed.saddle);
        assert_eq!(closed.node.multipliers(), Multipliers::Real(1.0, 0.25));
        assert_eq!(map(0.33, 0.5).period_one_pair(1), None);
        assert_eq!(map(0.45, 0.5).period_one_pair(0), None);
        assert_eq!(map(0.0, 0.5).period_one_pair(1), None);
        assert_eq!(map(0.9, 0.5).period_one_pair(3), None);
        assert_eq!(map(0.9, 0.5).period_one_pair(u64::MAX), None);
    }

    /// By hand: at a phase just before pi/2 the platform is near its highest point, and not higher until the
    /// next impact. At a phase just after 3 pi/2 it soon outruns the disk.
    #[test]
    fn on_fast_platforms_one_orbit_of_each_pair_is_admissible() {
        for forcing in [1e3, 1e4, 1e6] {
            let [own, other] = [0.5, 0.5001].map(|r| map(forcing, r));
            let faster = map(1.0001 * forcing, 0.5);
            for k in 1..=3 {
                let pair = own.period_one_pair(k).expect("born at k/3");
                let cosine = k as f64 / 3.0 / forcing;
                assert!((pair.node.state.phase().cos() - cosine).abs() < 4e-16, "{forcing} {k}");
                assert_eq!(pair.node.is_admissible(&own), Ok(true), "{forcing} {k}");
                assert_eq!(pair.saddle.is_admissible(&own), Ok(false), "{forcing} {k}");
                for another in [&other, &faster] {
                    assert_eq!(pair.node.is_admissible(another), Ok(false), "{forcing} {k}");
                }
            }
        }
    }

    /// If the platform outruns the disk, the closed form is not an orbit of the map.
    #[test]
    fn an_orbit_that_is_forestalled_says_so() {
        let fast = map(3.0, 0.5);
        let pair = fast.period_one_pair(1).expect("exists");
        assert_eq!(pair.saddle.is_admissible(&fast), Ok(false));
        assert_eq!(pair.saddle.orbit(&fast), Ok(None));
        // Without restitution the disk leaves a platform that falls away, and rests on one that does not.
        let plastic = map(1.05, 0.0);
        let pair = plastic.period_one_pair(1).expect("exists from Gamma = 1 on");
        assert_eq!(pair.saddle.is_admissible(&plastic), Ok(false));
        assert_eq!(pair.node.determinant.to_bits(), 0.0_f64.to_bits());
    }
}
