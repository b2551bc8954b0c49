//! How near a start must come to an attracting periodic orbit to count as caught. Sampled tests, not proofs.
//!
//! Distances are in radians; a radian of phase counts as much as the speed P.

use core::f64::consts::TAU;

use crate::analysis::periodic::PeriodicOrbit;
use crate::chatter::policy::ChatterPolicy;
use crate::error::Error;
use crate::map::impact_map::{ImpactMap, ImpactState};
use crate::numerics::elementary::sin_cos;
use crate::observer::{Observer, Unobserved, Watch, WorkCount};
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

/// The largest circle that is tried.
const LARGEST_CIRCLE: f64 = 0.05;

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
fn first_halving(
    largest: f64,
    mut passes: impl FnMut(f64) -> Result<bool, Error>,
) -> Result<Option<f64>, Error> {
    let mut radius = largest;
    while radius > SMALLEST_RADIUS {
        if passes(radius)? {
            return Ok(Some(radius));
        }
        radius *= 0.5;
    }
    Ok(None)
}

/// How many radii there are at most from this one down.
fn halvings(largest: f64) -> u64 {
    core::iter::successors(Some(largest), |radius| Some(0.5 * radius))
        .take_while(|radius| *radius > SMALLEST_RADIUS)
        .count() as u64
}

/// How many circles there are at most beyond the first.
fn widenings() -> u64 {
    core::iter::successors(Some(FIRST_RADIUS), |radius| Some(WIDENING * radius))
        .take_while(|radius| *radius < LARGEST_RADIUS)
        .count() as u64
}

/// What the radii are found with: the map, the scale of its speeds, and the work so far.
struct Search<'w> {
    map: &'w ImpactMap,
    scale: f64,
    work: WorkCount<'w>,
}

impl Search<'_> {
    /// Whether all starts on the circles of this radius about the impacts of the orbit pass.
    fn all_on_circles(
        &mut self,
        orbit: &PeriodicOrbit,
        radius: f64,
        samples: u32,
        mut passes: impl FnMut(&mut Self, ImpactState) -> Result<bool, Error>,
    ) -> Result<bool, Error> {
        for &centre in &orbit.states {
            for start in circle(centre, radius, self.scale, samples) {
                let Some(start) = start else { return Ok(false) };
                if !passes(self, start)? {
                    return Ok(false);
                }
                self.work.finish(1)?;
            }
        }
        Ok(true)
    }
}

impl PeriodicOrbit {
    /// A radius within which every orbit is taken to end on this one: on the circles of that radius about its impacts `samples`
    /// starts each stay within four radii and end nearer than they began. Where that holds at 0.1 rad, wider circles are
    /// tried, each 1.15 times the last and with four times as many starts, that must come within 0.1 rad; the radius is
    /// then 0.7 times the widest that passes. `None` if even 1e-5 rad fails (the orbit does not attract, or only
    /// after long excursions: see [`Self::attraction_radius`]).
    #[must_use]
    pub fn trapping_radius(&self, map: &ImpactMap, samples: u32) -> Option<f64> {
        // Nobody stops it, and a start that fails is not trapped: there is no error.
        self.trapping_radius_observed(map, samples, &Unobserved).unwrap_or(None)
    }

    /// [`Self::trapping_radius`] with an observer; the items are the starts, as many as there are at most.
    ///
    /// # Errors
    /// [`Error::Stopped`] if the observer breaks.
    pub fn trapping_radius_observed(
        &self,
        map: &ImpactMap,
        samples: u32,
        observer: &dyn Observer,
    ) -> Result<Option<f64>, Error> {
        let (scale, samples) = (map.vibration().peak_acceleration(), samples.max(1));
        let more = samples.saturating_mul(4);
        let most = halvings(FIRST_RADIUS) * u64::from(samples) + widenings() * u64::from(more);
        let watch = Watch::begin(observer, 0, most.saturating_mul(self.period() as u64))?;
        let mut search = Search { map, scale, work: watch.work() };
        let inner = first_halving(FIRST_RADIUS, |radius| {
            search.all_on_circles(self, radius, samples, |search, start| self.traps(search, start, radius))
        })?;
        let Some(inner) = inner else {
            watch.end();
            return Ok(None);
        };
        let mut widest = inner;
        while inner >= FIRST_RADIUS && widest < LARGEST_RADIUS {
            let next = (WIDENING * widest).min(LARGEST_RADIUS);
            let drawn = |search: &mut Search<'_>, start| self.draws(search, start, inner, 4.0 * next);
            if !search.all_on_circles(self, next, more, drawn)? {
                break;
            }
            widest = next;
        }
        watch.end();
        Ok(Some(inner.max(SHARE_OF_WIDEST * widest)))
    }

    /// How near a start must come to this orbit to count as caught by it: the [`Self::trapping_radius`], or, of an
    /// orbit with strong shear that traps no circle (one of two impacts in four periods, for example), the
    /// [`Self::attraction_radius`]. `None` if it has neither.
    #[must_use]
    pub fn catching_radius(&self, map: &ImpactMap, samples: u32) -> Option<f64> {
        // Nobody stops it, and a start that fails is not caught: there is no error.
        self.catching_radius_observed(map, samples, &Unobserved).unwrap_or(None)
    }

    /// [`Self::catching_radius`] with an observer, which sees the two searches one after the other.
    ///
    /// # Errors
    /// [`Error::Stopped`] if the observer breaks.
    pub fn catching_radius_observed(
        &self,
        map: &ImpactMap,
        samples: u32,
        observer: &dyn Observer,
    ) -> Result<Option<f64>, Error> {
        match self.trapping_radius_observed(map, samples, observer)? {
            Some(radius) => Ok(Some(radius)),
            None => self.attraction_radius_observed(map, observer),
        }
    }

    /// What a flight and its distance from this orbit count as for an observer.
    fn flights_of_step(&self) -> u64 {
        1 + self.period() as u64 / 16
    }

    /// Whether a start comes within `radius` of this orbit, and stays within `bound` on the way.
    fn draws(
        &self,
        search: &mut Search<'_>,
        start: ImpactState,
        radius: f64,
        bound: f64,
    ) -> Result<bool, Error> {
        let mut state = start;
        for _ in 0..200 * self.period() {
            search.work.spend(self.flights_of_step())?;
            let distance = self.distance(state, search.scale);
            if distance <= radius {
                return Ok(true);
            }
            match search.map.step(state) {
                Ok(impact) if distance <= bound => state = impact.into(),
                _ => return Ok(false),
            }
        }
        Ok(false)
    }

    fn traps(&self, search: &mut Search<'_>, start: ImpactState, radius: f64) -> Result<bool, Error> {
        let mut state = start;
        for _ in 0..200 * self.period() {
            search.work.spend(self.flights_of_step())?;
            match search.map.step(state) {
                Ok(impact) => state = impact.into(),
                Err(_) => return Ok(false),
            }
            if self.distance(state, search.scale) > 4.0 * radius {
                return Ok(false);
            }
        }
        Ok(self.distance(state, search.scale) < radius)
    }

    /// Half a radius within which starts on four circles about each impact end on this orbit, however far they
    /// stray before: for orbits with strong shear, whose basin is thin. `None` if even 1e-5 rad fails.
    #[must_use]
    pub fn attraction_radius(&self, map: &ImpactMap) -> Option<f64> {
        // Nobody stops it, and a start that fails is not attracted: there is no error.
        self.attraction_radius_observed(map, &Unobserved).unwrap_or(None)
    }

    /// [`Self::attraction_radius`] with an observer; the items are the starts, as many as there are at most.
    ///
    /// # Errors
    /// [`Error::Stopped`] if the observer breaks.
    pub fn attraction_radius_observed(
        &self,
        map: &ImpactMap,
        observer: &dyn Observer,
    ) -> Result<Option<f64>, Error> {
        let scale = map.vibration().peak_acceleration();
        let circles = halvings(LARGEST_CIRCLE) * (CIRCLES.len() * self.period()) as u64;
        let watch = Watch::begin(observer, 0, circles.saturating_mul(CIRCLE_SAMPLES.into()))?;
        let mut search = Search { map, scale, work: watch.work() };
        let ends_here = |search: &mut Search<'_>, start: ImpactState| {
            let (impacts, work) = (100 * self.period(), &mut search.work);
            let tick = &mut |impacts| work.spend(impacts);
            match search.map.state_after_ticked(start, impacts, ChatterPolicy::Complete, tick) {
                Ok(end) => Ok(end.is_some_and(|end| self.distance(end, scale) < CAUGHT)),
                Err(stopped @ Error::Stopped { .. }) => Err(stopped),
                Err(_) => Ok(false),
            }
        };
        let radius = first_halving(LARGEST_CIRCLE, |radius| {
            for part in CIRCLES {
                if !search.all_on_circles(self, part * radius, CIRCLE_SAMPLES, ends_here)? {
                    return Ok(false);
                }
            }
            Ok(true)
        })?;
        watch.end();
        Ok(radius.map(|radius| 0.5 * radius))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analysis::basin::{Axis, BasinSettings, Grid, KnownOrbit};
    use crate::platform::vibration::Vibration;
    use crate::testing::StopAfter;

    fn map(axial_forcing: f64) -> ImpactMap {
        ImpactMap::new(Vibration::from_axial_forcing(axial_forcing).expect("legal"), 0.5).expect("legal")
    }

    #[test]
    fn a_stable_orbit_has_both_radii_and_a_saddle_has_none() {
        let stable = map(0.45);
        let orbit = stable.refine(&[stable.period_one(1).expect("exists")]).expect("refines");
        let (trapping, attraction) = (orbit.trapping_radius(&stable, 64), orbit.attraction_radius(&stable));
        assert!(trapping.is_some_and(|radius| radius > 1e-3), "{trapping:?}");
        assert!(attraction.is_some_and(|radius| radius > 1e-3), "{attraction:?}");
        let doubled = map(0.50);
        let saddle = doubled.refine(&[doubled.period_one(1).expect("exists")]).expect("refines");
        assert_eq!((saddle.trapping_radius(&doubled, 64), saddle.attraction_radius(&doubled)), (None, None));
        assert_eq!(
            (orbit.catching_radius(&stable, 64), saddle.catching_radius(&doubled, 64)),
            (trapping, None)
        );
    }

    /// The attractor of four impacts at Gamma = 0.486 that docs/errata.md describes.
    #[test]
    fn a_sheared_orbit_catches_though_it_does_not_trap() {
        let map = map(0.486);
        let start = ImpactState::from_normalised(0.0660 * TAU, 0.3170).expect("legal");
        let orbit = map.settled_orbit(start, 4_000, 64, 1.0e-8).expect("no failure").expect("settles");
        assert_eq!(orbit.period(), 4);
        assert_eq!(orbit.trapping_radius(&map, 64), None);
        let attraction = orbit.attraction_radius(&map);
        assert!(attraction.is_some());
        assert_eq!(orbit.catching_radius(&map, 64), attraction);
        // The second search can be stopped, too: the first takes as many starts as it always does.
        let first = StopAfter::calls(u64::MAX);
        assert_eq!(orbit.trapping_radius_observed(&map, 64, &first), Ok(None));
        let stopped = orbit.catching_radius_observed(&map, 64, &StopAfter::calls(first.asked() + 2));
        assert!(matches!(stopped, Err(Error::Stopped { total: 6_656, .. })), "{stopped:?}");
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

    #[test]
    fn searches_of_a_radius_can_be_stopped_and_end_with_all_starts() {
        let map = map(0.45);
        let orbit = map.refine(&[map.period_one(1).expect("exists")]).expect("refines");
        let stopped = orbit.trapping_radius_observed(&map, u32::MAX, &StopAfter::calls(3));
        assert!(matches!(stopped, Err(Error::Stopped { done: 1..16_400, .. })), "{stopped:?}");
        let stopped = orbit.attraction_radius_observed(&map, &StopAfter::calls(2));
        assert!(matches!(stopped, Err(Error::Stopped { done: 1.., total: 1_664 })), "{stopped:?}");
        let most = StopAfter::calls(u64::MAX);
        let radius = orbit.trapping_radius_observed(&map, 64, &most).expect("nobody stops it");
        assert_eq!(radius, orbit.trapping_radius(&map, 64));
        // Fourteen halvings, and seventeen wider circles with four times as many starts.
        assert_eq!((most.last().done, most.last().total), (5_248, 5_248));
    }
}
