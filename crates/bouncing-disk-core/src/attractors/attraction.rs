//! The distance from an attracting periodic orbit within which a start counts as captured: a proven radius,
//! and a wider one supported by samples (docs/numerics-dynamics.md, "Radii of attraction").
//!
//! Distances are in radians; a radian of phase counts as much as the speed P.

use core::f64::consts::{PI, TAU};

use glam::{DMat2, DVec2};

use super::attracting_map::AttractingMap;
use crate::flight::platform::phase::Phase;
use crate::map::impact_map::{ImpactMap, ImpactState};
use crate::numerics::elementary::{asin, sin_cos};
use crate::numerics::error::Error;
use crate::orbits::periodic::{PeriodicOrbit, distance};
use crate::run::{Observer, Watch, WorkCount};

/// The first radius tried, the largest, and the one at which the search gives up.
const FIRST_RADIUS: f64 = 0.1;
const LARGEST_RADIUS: f64 = 1.0;
const SMALLEST_RADIUS: f64 = 1.0e-5;

/// Ratio of the radii of successive wider circles, and the ratio of the result to the widest radius.
const WIDENING: f64 = 1.15;
const SHARE_OF_WIDEST: f64 = 0.7;

/// Largest number of impacts of an orbit that is tested for trapping circles.
const SHORT: usize = 8;

/// Settings of the test whether starts return nearer to their initial impact. They are the largest radius, the
/// smallest one, the circles of each trial as shares of its radius, the starts on each circle, and the ratio
/// of the result to the radius.
const LARGEST_CIRCLE: f64 = 0.05;
const SMALLEST_CIRCLE: f64 = 1.0e-8;
const CIRCLES: [f64; 3] = [1.0, 0.5, 0.25];
const CIRCLE_SAMPLES: u32 = 16;
const SHARE_OF_CIRCLE: f64 = 0.5;

/// A start is near enough to stop at the first number, a share of its initial distance. A slower start, as
/// near a doubling or a fold, must at least be nearer after the second number of rounds of the orbit. The
/// third is the largest distance allowed meanwhile, as a multiple of the initial distance.
const NEARER: f64 = 0.125;
const ROUNDS: u32 = 200;
const STRAYING: f64 = 4.0;

/// The largest region whose contraction is tried, the margin for rounding in the bounds, and the smallest
/// region, in roundings.
const LARGEST_REGION: f64 = 0.5;
const ROUNDINGS: f64 = 0.99;
const SMALLEST_REGION: f64 = 64.0 * f64::EPSILON;

/// Squarings of the derivative around the orbit: its 2^64th power is zero in doubles.
const SQUARINGS: u32 = 64;

/// A number known to lie within a radius about a centre.
#[derive(Clone, Copy)]
struct Ball(f64, f64);

impl Ball {
    fn plus(self, other: Self) -> Self {
        Self(self.0 + other.0, self.1 + other.1)
    }

    fn times(self, other: Self) -> Self {
        let radius = self.0.abs() * other.1 + self.1 * (other.0.abs() + other.1);
        Self(self.0 * other.0, radius)
    }

    fn scaled(self, by: f64) -> Self {
        Self(by * self.0, by.abs() * self.1)
    }

    /// Infinite if the ball contains zero.
    fn inverse(self) -> Self {
        let least = self.0.abs() - self.1;
        Self(1.0 / self.0, if least > 0.0 { self.1 / (self.0.abs() * least) } else { f64::INFINITY })
    }
}

/// A flight of the orbit: from one impact to the next.
struct Flight {
    from: ImpactState,
    to: ImpactState,
    duration: f64,
    /// The derivative of the map, velocities in units of P.
    derivative: DMat2,
    /// The largest eigenvalue of the form that measures distances about `from`.
    largest: f64,
}

/// Velocities in units of P.
fn in_units(derivative: DMat2, p: f64) -> DMat2 {
    let (x, y) = (derivative.x_axis, derivative.y_axis);
    DMat2::from_cols(DVec2::new(x.x, x.y / p), DVec2::new(p * y.x, y.y))
}

/// The larger eigenvalue of a symmetric matrix.
fn largest_eigenvalue(form: DMat2) -> f64 {
    let (a, b, d) = (form.x_axis.x, form.x_axis.y, form.y_axis.y);
    let half = 0.5 * (a - d);
    0.5 * (a + d) + (half * half + b * b).sqrt()
}

impl Flight {
    /// A bound on the change of the derivative (Frobenius norm) from the orbit's flight to another flight
    /// whose impacts lie within `reach` of the orbit's.
    fn change_of_derivative(&self, map: &ImpactMap, reach: f64) -> f64 {
        let (p, r) = (map.vibration().peak_acceleration(), map.restitution());
        let wave = |at: ImpactState| (Ball(at.phase().sin(), reach), Ball(at.phase().cos(), reach));
        let ((s, c), (s1, c1)) = (wave(self.from), wave(self.to));
        let h = Ball(self.duration, 2.0 * reach);
        // The formulas of the derivative, in order.
        let arrival = Ball(self.to.velocity(), p * reach).inverse();
        let by_phase = s.times(h).plus(c1).plus(c.scaled(-1.0)).scaled(p).times(arrival);
        let by_speed = h.scaled(r).times(arrival);
        let phase_by_phase = Ball(1.0, 0.0).plus(by_phase);
        let platform = s1.scaled(p);
        let speed_by_phase = s.scaled(-p).plus(by_phase.scaled(-1.0)).plus(platform.times(phase_by_phase));
        let speed_by_speed = by_speed.scaled(-1.0).plus(platform.times(by_speed));
        let parts = [by_phase.1, p * by_speed.1, speed_by_phase.1 / p, speed_by_speed.1];
        parts.iter().fold(0.0, |sum, part| sum + part * part).sqrt()
    }

    /// Whether no start within `reach` hits the platform before the flight's end. An earlier impact would
    /// first appear as a graze, a minimum of the gap, while the platform falls away faster than the disk.
    fn is_clear(&self, map: &ImpactMap, reach: f64) -> bool {
        let (p, r) = (map.vibration().peak_acceleration(), map.restitution());
        if p <= 1.0 {
            return true;
        }
        let (angle, sin) = (self.from.phase().angle(), self.from.phase().sin());
        let speed = p * self.from.phase().cos() - r * self.from.velocity();
        let gap = |t: f64| p * (sin - sin_cos(angle + t).0) + (speed - 0.5 * t) * t;
        let slope = |t: f64| speed - t - p * sin_cos(angle + t).1;
        let (first, last) = (-2.0 * reach, self.duration + 2.0 * reach);
        let launch = r * (p * reach - self.from.velocity());
        let room = reach * ((1.0 + p + p * r) * (last + 2.0 * reach) + launch);
        let room_of_slope = reach * (1.0 + p + p * r);
        let separation = asin(1.0 / p);
        let begin = separation - angle;
        let turns = ((first - (PI - separation - angle)) / TAU).ceil().max(0.0);
        let mut start = begin + TAU * turns;
        while start < last {
            let end = start + PI - 2.0 * separation;
            let (mut low, mut high) = (start.max(first), end.min(last));
            // If the launch lies in this stretch, the gap rises from zero throughout.
            let from_launch = start <= -reach && end >= reach;
            start += TAU;
            if from_launch {
                continue;
            }
            if slope(low) >= 0.0 {
                high = low;
            } else if slope(high) <= 0.0 {
                low = high;
            }
            while high - low > f64::EPSILON * last {
                let middle = 0.5 * (low + high);
                if middle <= low || middle >= high {
                    break;
                }
                if slope(middle) < 0.0 { low = middle } else { high = middle }
            }
            if !(gap(low) > room || slope(low).abs() > room_of_slope) {
                return false;
            }
        }
        true
    }
}

/// The flights of an attracting orbit. The forms Q_i = 1 + D_i^T Q_(i+1) D_i measure distances from its
/// impacts: a form is, to first order, the sum of the squares of this distance and all later ones, so that
/// each step reduces it.
fn flights(map: &ImpactMap, orbit: &PeriodicOrbit) -> Result<Vec<Flight>, Error> {
    let p = map.vibration().peak_acceleration();
    let n = orbit.states.len();
    let mut flights = Vec::with_capacity(n);
    for (i, &from) in orbit.states.iter().enumerate() {
        let (impact, derivative) = map.step_with_derivative(from)?;
        let (to, derivative) = (orbit.states[(i + 1) % n], in_units(derivative, p));
        flights.push(Flight { from, to, duration: impact.duration(), derivative, largest: 1.0 });
    }
    let pulled_back = |form: DMat2, by: DMat2| by.transpose() * form * by;
    let mut form = DMat2::ZERO;
    for flight in flights.iter().rev() {
        form = DMat2::IDENTITY + pulled_back(form, flight.derivative);
    }
    let mut around = in_units(orbit.monodromy, p);
    for _ in 0..SQUARINGS {
        form += pulled_back(form, around);
        around *= around;
    }
    for flight in flights.iter_mut().rev() {
        form = DMat2::IDENTITY + pulled_back(form, flight.derivative);
        flight.largest = largest_eigenvalue(form);
    }
    Ok(flights)
}

impl PeriodicOrbit {
    /// A radius (rad) about each impact of this orbit within which every start provably ends on it, up to the
    /// rounding of the bounds.
    ///
    /// The linearised map contracts in suitable norms. The exact map then contracts wherever its derivative
    /// differs from the derivative on the orbit by less than the margin of this contraction. The code bounds
    /// the difference over the whole region, and shows that no flight from there hits the platform earlier.
    ///
    /// # Errors
    /// [`Error::NotAnOrbit`] for an orbit of another map; [`Error::NotAttracting`] unless the orbit is
    /// [stable](Self::stability); [`Error::NothingProven`] if the region would be no larger than the
    /// rounding, as near a graze; errors of [`Vibration::first_impact`](crate::Vibration::first_impact).
    pub fn proven_radius(&self, map: &ImpactMap) -> Result<f64, Error> {
        map.check_attracting(self)?;
        let flights = flights(map, self)?;
        let n = flights.len();
        let widest = flights.iter().fold(1.0_f64, |most, flight| most.max(flight.largest));
        let contracts = |reach: f64| {
            flights.iter().enumerate().all(|(i, flight)| {
                // sqrt(1 - 1/L), and its difference from 1.
                let (own, next) = (1.0 / flight.largest, flights[(i + 1) % n].largest);
                let left = own / (1.0 + (1.0 - own).max(0.0).sqrt());
                flight.change_of_derivative(map, reach) * next.sqrt() <= ROUNDINGS * left
                    && flight.is_clear(map, reach)
            })
        };
        let mut reach = LARGEST_REGION;
        while reach > SMALLEST_REGION * widest {
            if contracts(reach) {
                return Ok(ROUNDINGS * reach / widest.sqrt());
            }
            reach *= 0.5;
        }
        Err(Error::NothingProven { region: reach })
    }

    /// The radius (rad) within which a start counts as captured by this orbit: the
    /// [proven](AttractingMap::proven_radius) radius, or a larger one supported by samples.
    ///
    /// For an orbit of at most eight impacts it is the first radius of 0.1, 0.05, ... rad that traps:
    /// `samples` starts on a circle of this radius about each impact stay within four radii of the orbit, and
    /// end within one radius. If 0.1 rad already traps, wider circles are tried, each 1.15 times the last and
    /// with four times as many starts. A circle passes if all its starts come within 0.1 rad of the orbit;
    /// the result is 0.7 times the radius of the last circle before the first that fails, and at least 0.1
    /// rad.
    ///
    /// A longer orbit, and one with a shear so strong that no radius traps, gets a weaker test: 16 starts on
    /// each of three circles about each impact, with the radii R, R/2 and R/4 for R = 0.05, 0.025, ... rad.
    /// Every start must return to within an eighth of its initial distance from that impact, however far it
    /// strays on the way. If it approaches more slowly, it must be nearer than initially after 200 rounds of
    /// the orbit, and never farther away than four times its initial distance. The result is half of the
    /// first R that passes.
    ///
    /// The items of `observer` are the starts; their total is an upper bound.
    ///
    /// # Errors
    /// [`Error::NotAnOrbit`] for an orbit of another map; [`Error::NotAttracting`] unless the orbit is
    /// [stable](Self::stability); errors of [`Self::proven_radius`] if samples find no radius either.
    pub fn trapping_radius<M: AttractingMap>(
        &self,
        map: &M,
        samples: u32,
        observer: &dyn Observer,
    ) -> Result<f64, Error> {
        let proven = map.proven_radius(self);
        if let Err(refused @ (Error::NotAnOrbit { .. } | Error::NotAttracting { .. })) = proven {
            return Err(refused);
        }
        let (scale, samples) = (map.speed_scale(), samples.max(1));
        let more = samples.saturating_mul(4);
        let most = halvings() * u64::from(samples) + widenings() * u64::from(more);
        let watch = Watch::begin(observer, 0, most.saturating_mul(self.period() as u64))?;
        let mut search = Search { map, scale, work: watch.work() };
        let trapping = if self.period() <= SHORT { self.sampled(&mut search, samples, more)? } else { None };
        let least = proven.as_ref().copied().unwrap_or(0.0);
        let sampled = match trapping {
            Some(radius) => Some(radius),
            None => self.sampled_circles(&mut search, least)?,
        };
        watch.end();
        match (sampled, proven) {
            (Some(sampled), _) => Ok(sampled.max(least)),
            (None, proven) => proven,
        }
    }

    /// The widened radius of circles that trap; `None` if even the smallest does not trap.
    fn sampled(
        &self,
        search: &mut Search<'_, impl AttractingMap>,
        samples: u32,
        more: u32,
    ) -> Result<Option<f64>, Error> {
        let inner = first_halving(FIRST_RADIUS, SMALLEST_RADIUS, |radius| {
            search.all_on_circle(self, radius, samples, |search, start, _| self.traps(search, start, radius))
        })?;
        let Some(inner) = inner else { return Ok(None) };
        let mut widest = inner;
        while inner >= FIRST_RADIUS && widest < LARGEST_RADIUS {
            let next = (WIDENING * widest).min(LARGEST_RADIUS);
            let drawn = |search: &mut Search<'_, _>, start, _| self.draws(search, start, inner, 4.0 * next);
            if !search.all_on_circle(self, next, more, drawn)? {
                break;
            }
            widest = next;
        }
        Ok(Some(inner.max(SHARE_OF_WIDEST * widest)))
    }

    /// Half the radius of the circles from which starts return nearer; `None` if it is not above `least`.
    fn sampled_circles(
        &self,
        search: &mut Search<'_, impl AttractingMap>,
        least: f64,
    ) -> Result<Option<f64>, Error> {
        let smallest = SMALLEST_CIRCLE.max(least / SHARE_OF_CIRCLE);
        let radius = first_halving(LARGEST_CIRCLE, smallest, |radius| {
            for part in CIRCLES {
                let from = part * radius;
                let returns = |search: &mut Search<'_, _>, start, centre| {
                    search.returns_nearer(self.period() as u64, (start, centre), from)
                };
                if !search.all_on_circle(self, from, CIRCLE_SAMPLES, returns)? {
                    return Ok(false);
                }
            }
            Ok(true)
        })?;
        Ok(radius.map(|radius| SHARE_OF_CIRCLE * radius))
    }

    /// The work of a flight and of its distance from this orbit, in units of an observer.
    fn flights_of_step(&self) -> u64 {
        1 + self.period() as u64 / 16
    }

    /// Whether a start comes within `radius` of this orbit, and stays within `bound` on the way.
    fn draws(
        &self,
        search: &mut Search<'_, impl AttractingMap>,
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

    fn traps(
        &self,
        search: &mut Search<'_, impl AttractingMap>,
        start: ImpactState,
        radius: f64,
    ) -> Result<bool, Error> {
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
}

/// The first of `largest`, `largest`/2, `largest`/4, ... that passes; `None` if all above `smallest` fail.
fn first_halving(
    largest: f64,
    smallest: f64,
    mut passes: impl FnMut(f64) -> Result<bool, Error>,
) -> Result<Option<f64>, Error> {
    let mut radius = largest;
    while radius > smallest {
        if passes(radius)? {
            return Ok(Some(radius));
        }
        radius *= 0.5;
    }
    Ok(None)
}

/// The largest number of circles from the first radius down.
fn halvings() -> u64 {
    core::iter::successors(Some(FIRST_RADIUS), |radius| Some(0.5 * radius))
        .take_while(|radius| *radius > SMALLEST_RADIUS)
        .count() as u64
}

/// The largest number of circles beyond the first.
fn widenings() -> u64 {
    core::iter::successors(Some(FIRST_RADIUS), |radius| Some(WIDENING * radius))
        .take_while(|radius| *radius < LARGEST_RADIUS)
        .count() as u64
}

/// The state of the search for a radius: the map, the scale of its speeds, and the work so far.
struct Search<'w, M> {
    map: &'w M,
    scale: f64,
    work: WorkCount<'w>,
}

impl<M: AttractingMap> Search<'_, M> {
    /// Whether all starts on the circles of this radius about the impacts of the orbit pass. A start below
    /// the platform fails.
    fn all_on_circle(
        &mut self,
        orbit: &PeriodicOrbit,
        radius: f64,
        samples: u32,
        mut passes: impl FnMut(&mut Self, ImpactState, ImpactState) -> Result<bool, Error>,
    ) -> Result<bool, Error> {
        for &centre in &orbit.states {
            for sample in 0..samples {
                let (s, c) = sin_cos(TAU * f64::from(sample) / f64::from(samples));
                let velocity = centre.velocity() + radius * self.scale * s;
                let start = Phase::new(centre.phase().angle() + radius * c)
                    .and_then(|phase| ImpactState::new(phase, velocity));
                let Ok(start) = start else { return Ok(false) };
                if !passes(self, start, centre)? {
                    return Ok(false);
                }
                self.work.finish(1)?;
            }
        }
        Ok(true)
    }

    /// Whether a start returns nearer to `centre`, the impact of the orbit near which it began, by the rule
    /// of [`PeriodicOrbit::trapping_radius`]. A verdict requires less: that the orbit approaches any of the
    /// impacts.
    fn returns_nearer(
        &mut self,
        period: u64,
        (start, centre): (ImpactState, ImpactState),
        from: f64,
    ) -> Result<bool, Error> {
        let mut state = start;
        let (mut last, mut farthest) = (from, from);
        for _ in 0..ROUNDS {
            self.work.spend(period)?;
            let Ok(next) = self.map.steps(state, period) else { return Ok(false) };
            state = next;
            last = distance(state, centre, self.scale);
            farthest = farthest.max(last);
            if last <= NEARER * from {
                return Ok(true);
            }
        }
        Ok(last < from && farthest <= STRAYING * from)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::attractors::basin::{Axis, BasinSettings, Grid, KnownOrbit};
    use crate::map::impact_map::map;
    use crate::numerics::random::SplitMix64;
    use crate::run::Unobserved;

    /// The orbit of one impact every k periods that attracts from its birth to its doubling.
    fn node(map: &ImpactMap, k: u64) -> PeriodicOrbit {
        map.refine(&[map.period_one(k).expect("exists")]).expect("refines")
    }

    fn settled(map: &ImpactMap, phase: f64, speed: f64) -> PeriodicOrbit {
        let start = ImpactState::from_normalised(phase, speed).expect("legal");
        map.settled_orbit(start, 4_000, 64, 1.0e-8, &Unobserved).expect("no failure").expect("settles")
    }

    #[test]
    fn an_orbit_that_does_not_attract_says_so() {
        let doubling = ImpactMap::first_doubling_forcing(0.5);
        for forcing in [0.5, doubling + 1e-4, doubling + 1e-12, doubling, 1.0 / 3.0] {
            let map = map(forcing, 0.5);
            for radius in
                [node(&map, 1).trapping_radius(&map, 64, &Unobserved), node(&map, 1).proven_radius(&map)]
            {
                assert!(matches!(radius, Err(Error::NotAttracting { .. })), "{forcing}: {radius:?}");
            }
        }
    }

    /// Every start within the proven radius ends on the orbit, even on the edge; and every attracting orbit
    /// has such a radius.
    #[test]
    fn starts_within_the_proven_radius_end_on_the_orbit() {
        let mut random = SplitMix64::new(6);
        let mut narrowest = f64::INFINITY;
        for case in 0..60 {
            let restitution = [0.0, 0.3, 0.5, 0.8, 0.95][case % 5];
            let k = 1 + case as u64 % 9;
            let born = k as f64 * (1.0 - restitution) / (1.0 + restitution);
            let height =
                2.0 * (1.0 + restitution * restitution) / (PI * (1.0 + restitution) * (1.0 + restitution));
            let share = 0.02 + 0.95 * random.unit();
            let map = map((born * born + share * share * height * height).sqrt(), restitution);
            let pair = map.period_one_pair(k).expect("exists");
            let Some(orbit) = pair.node.orbit(&map).expect("no failure") else { continue };
            let radius = orbit.proven_radius(&map).expect("attracts");
            assert!(orbit.trapping_radius(&map, 16, &Unobserved).expect("attracts") >= radius);
            narrowest = narrowest.min(radius);
            let p = map.vibration().peak_acceleration();
            for sample in 0..20 {
                let (s, c) = sin_cos(TAU * random.unit());
                let reach = if sample < 10 { radius } else { radius * random.unit() };
                let centre = orbit.states[0];
                let phase = Phase::new(centre.phase().angle() + reach * c).expect("finite");
                let mut state = ImpactState::new(phase, centre.velocity() + reach * p * s).expect("legal");
                for _ in 0..2_000 {
                    state = map.step(state).expect("flies").into();
                }
                assert!(orbit.distance(state, p) < 1e-9 + 1e-2 * radius, "{map} {k}: {radius} {state}");
            }
        }
        assert!(narrowest > 1e-8, "{narrowest}");
    }

    /// One impact every eight periods: samples once found no circle that traps it.
    #[test]
    fn a_fast_orbit_has_the_radius_that_its_attractor_has() {
        let map = map(0.9, 0.8);
        let orbit = node(&map, 8);
        let (radius, proven) = (orbit.trapping_radius(&map, 64, &Unobserved), orbit.proven_radius(&map));
        assert_eq!(radius, Ok(0.025));
        assert!(proven.as_ref().is_ok_and(|proven| *proven > 1e-5), "{proven:?}");
    }

    /// Close to its birth and to its doubling an orbit attracts slowly, or only from nearby.
    #[test]
    fn the_ends_of_a_window_have_smaller_radii() {
        let radius = |forcing| {
            let map = map(forcing, 0.5);
            node(&map, 1).trapping_radius(&map, 64, &Unobserved).expect("attracts")
        };
        let wide = radius(0.4);
        for above in [1e-3, 1e-6, 1e-9] {
            let found = radius(1.0 / 3.0 + above);
            assert!(found < wide && found > 1e-13, "{above}: {found}");
        }
        let doubling = ImpactMap::first_doubling_forcing(0.5);
        assert!(radius(doubling - 1e-3) > 1e-5 && radius(doubling - 1e-9) > 1e-15);
    }

    /// The attractor of four impacts at Gamma = 0.486 that docs/errata.md describes, and period 1 near its
    /// doubling.
    #[test]
    fn sheared_and_slow_orbits_have_a_radius() {
        let map = map(0.486, 0.5);
        let orbit = settled(&map, 0.0660 * TAU, 0.3170);
        assert_eq!(orbit.period(), 4);
        assert!(orbit.trapping_radius(&map, 64, &Unobserved).is_ok_and(|radius| radius > 1e-5));
        assert!(node(&map, 1).trapping_radius(&map, 64, &Unobserved).is_ok_and(|radius| radius > 0.1));
    }

    #[test]
    fn a_wide_trap_labels_as_a_narrow_one() {
        let axis = |high| Axis::new(0.0, high, 250).expect("legal");
        let grid = Grid::new(axis(1.0), axis(2.0)).expect("legal");
        for axial_forcing in [0.45, 0.5] {
            let map = map(axial_forcing, 0.5);
            let orbit = settled(&map, 0.8, 1.3);
            let radius = orbit.trapping_radius(&map, 64, &Unobserved).expect("attracts");
            assert!(radius > 0.3, "{radius}");
            let labels = |radius| {
                let known = [KnownOrbit::new(orbit.clone(), radius).expect("legal")];
                map.basins(grid, &known, BasinSettings::default(), &Unobserved).expect("no failure")
            };
            assert_eq!(labels(radius), labels(0.003), "Gamma {axial_forcing}");
        }
    }
}
