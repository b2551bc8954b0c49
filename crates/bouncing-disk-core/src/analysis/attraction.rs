//! How near a start must come to an attracting periodic orbit to count as caught. Sampled tests, not proofs.
//!
//! Distances are in radians; a radian of phase counts as much as the speed P.

use core::f64::consts::TAU;

use crate::analysis::periodic::PeriodicOrbit;
use crate::chatter::policy::ChatterPolicy;
use crate::map::impact_map::{ImpactMap, ImpactState};
use crate::numerics::elementary::sin_cos;
use crate::platform::phase::Phase;

/// Below this radius an orbit is taken not to attract.
const SMALLEST_RADIUS: f64 = 1.0e-5;

/// The first radius that is tried, and the last.
const FIRST_RADIUS: f64 = 0.1;
const LARGEST_RADIUS: f64 = 1.0;

/// Ratio of the radii of circles beyond the first, and the share of the widest one that counts.
const WIDENING: f64 = 1.15;
const SHARE_OF_WIDEST: f64 = 0.7;

/// A start that ends nearer than this has been caught.
const CAUGHT: f64 = 1.0e-6;

/// Starts on each circle of [`PeriodicOrbit::attraction_radius`], and the circles inside the largest one.
const CIRCLE_SAMPLES: u32 = 32;
const CIRCLES: [f64; 4] = [1.0, 0.7, 0.4, 0.2];

/// `samples` states on the circle about `centre`; `None` where a state is not legal (the disk below the platform).
fn circle(
    centre: ImpactState,
    radius: f64,
    scale: f64,
    samples: u32,
) -> impl Iterator<Item = Option<ImpactState>> {
    (0..samples).map(move |sample| {
        let (s, c) = sin_cos(TAU * f64::from(sample) / f64::from(samples));
        let phase = Phase::new(centre.phase().angle() + radius * c).ok()?;
        ImpactState::new(phase, centre.velocity() + radius * scale * s).ok()
    })
}

/// The first of `largest`, `largest`/2, `largest`/4, ... that passes; `None` if even the smallest radius fails.
fn first_halving(largest: f64, passes: impl Fn(f64) -> bool) -> Option<f64> {
    let mut radius = largest;
    while radius > SMALLEST_RADIUS {
        if passes(radius) {
            return Some(radius);
        }
        radius *= 0.5;
    }
    None
}

impl PeriodicOrbit {
    /// A radius within which every orbit is taken to end on this one: on the circles of that radius about its impacts `samples`
    /// starts each stay within four radii and end nearer than they began. Where that holds at 0.1 rad, wider circles are
    /// tried, each 1.15 times the last and with four times as many starts, that must come within 0.1 rad; the radius is
    /// then 0.7 times the widest that passes. `None` if even 1e-5 rad fails (the orbit does not attract, or only
    /// after long excursions: see [`Self::attraction_radius`]).
    #[must_use]
    pub fn trapping_radius(&self, map: &ImpactMap, samples: u32) -> Option<f64> {
        let (scale, samples) = (map.vibration().peak_acceleration(), samples.max(1));
        let all_on_circle = |radius: f64, samples: u32, passes: &dyn Fn(ImpactState) -> bool| {
            self.states
                .iter()
                .all(|&centre| circle(centre, radius, scale, samples).all(|start| start.is_some_and(passes)))
        };
        let inner = first_halving(FIRST_RADIUS, |radius| {
            all_on_circle(radius, samples, &|start| self.traps(map, start, radius, scale))
        })?;
        let mut widest = inner;
        while inner >= FIRST_RADIUS && widest < LARGEST_RADIUS {
            let next = (WIDENING * widest).min(LARGEST_RADIUS);
            if !all_on_circle(next, samples.saturating_mul(4), &|start| {
                self.draws(map, start, inner, 4.0 * next, scale)
            }) {
                break;
            }
            widest = next;
        }
        Some(inner.max(SHARE_OF_WIDEST * widest))
    }

    /// Whether a start comes within `radius` of this orbit, and stays within `bound` on the way.
    fn draws(&self, map: &ImpactMap, start: ImpactState, radius: f64, bound: f64, scale: f64) -> bool {
        let mut state = start;
        for _ in 0..200 * self.period() {
            let distance = self.distance(state, scale);
            if distance <= radius {
                return true;
            }
            match map.step(state) {
                Ok(impact) if distance <= bound => state = impact.into(),
                _ => return false,
            }
        }
        false
    }

    fn traps(&self, map: &ImpactMap, start: ImpactState, radius: f64, scale: f64) -> bool {
        let mut state = start;
        for _ in 0..200 * self.period() {
            match map.step(state) {
                Ok(impact) => state = impact.into(),
                Err(_) => return false,
            }
            if self.distance(state, scale) > 4.0 * radius {
                return false;
            }
        }
        self.distance(state, scale) < radius
    }

    /// Half a radius within which starts on four circles about each impact end on this orbit, however far they
    /// stray before: for orbits with strong shear, whose basin is thin. `None` if even 1e-5 rad fails.
    #[must_use]
    pub fn attraction_radius(&self, map: &ImpactMap) -> Option<f64> {
        let scale = map.vibration().peak_acceleration();
        let ends_here = |start: ImpactState| {
            let end = map.state_after(start, 100 * self.period(), ChatterPolicy::Complete);
            matches!(end, Ok(Some(end)) if self.distance(end, scale) < CAUGHT)
        };
        first_halving(0.05, |radius| {
            self.states.iter().all(|&centre| {
                CIRCLES.iter().all(|part| {
                    circle(centre, part * radius, scale, CIRCLE_SAMPLES)
                        .all(|start| start.is_some_and(ends_here))
                })
            })
        })
        .map(|radius| 0.5 * radius)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analysis::basin::{Axis, BasinSettings, Grid, KnownOrbit};
    use crate::platform::vibration::Vibration;

    fn map(axial_forcing: f64) -> ImpactMap {
        ImpactMap::new(Vibration::from_axial_forcing(axial_forcing).expect("legal"), 0.5).expect("legal")
    }

    #[test]
    fn a_stable_orbit_has_both_radii_and_a_saddle_has_none() {
        let stable = map(0.45);
        let orbit = stable.refine(&[stable.period_one(1).expect("exists")]).expect("refines");
        let (trapping, catching) = (orbit.trapping_radius(&stable, 64), orbit.attraction_radius(&stable));
        assert!(trapping.is_some_and(|radius| radius > 1e-3), "{trapping:?}");
        assert!(catching.is_some_and(|radius| radius > 1e-3), "{catching:?}");
        let doubled = map(0.50);
        let saddle = doubled.refine(&[doubled.period_one(1).expect("exists")]).expect("refines");
        assert_eq!((saddle.trapping_radius(&doubled, 64), saddle.attraction_radius(&doubled)), (None, None));
    }

    /// The attractor of four impacts at Gamma = 0.486 that docs/errata.md describes.
    #[test]
    fn a_sheared_orbit_catches_though_it_does_not_trap() {
        let map = map(0.486);
        let start = ImpactState::from_normalised(0.0660 * TAU, 0.3170).expect("legal");
        let orbit = map.settled_orbit(start, 4_000, 64, 1.0e-8).expect("no failure").expect("settles");
        assert_eq!(orbit.period(), 4);
        assert_eq!(orbit.trapping_radius(&map, 64), None);
        assert!(orbit.attraction_radius(&map).is_some());
    }

    #[test]
    fn a_wide_trap_labels_as_a_narrow_one() {
        let axis = |high| Axis::new(0.0, high, 250).expect("legal");
        let grid = Grid::new(axis(1.0), axis(2.0)).expect("legal");
        for axial_forcing in [0.45, 0.5] {
            let map = map(axial_forcing);
            let start = ImpactState::from_normalised(0.8, 1.3).expect("legal");
            let orbit = map.settled_orbit(start, 4_000, 4, 1.0e-8).expect("no failure").expect("settles");
            let radius = orbit.trapping_radius(&map, 64).expect("attracts");
            assert!(radius > 0.3, "{radius}");
            let labels = |radius| {
                let known = [KnownOrbit::new(orbit.clone(), radius).expect("legal")];
                map.basins(grid, &known, BasinSettings::default()).expect("no failure")
            };
            assert_eq!(labels(radius), labels(0.003), "Gamma {axial_forcing}");
        }
    }
}
