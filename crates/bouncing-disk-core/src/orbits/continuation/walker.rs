//! From point to point along a branch, by pseudo-arclength.

use core::cell::RefCell;

use glam::DVec2;

use super::{
    Bifurcation, BifurcationKind, Branch, BranchEnd, BranchPoint, Continuation, ContinuedMap, ROUNDED,
};
use crate::flight::platform::phase::Phase;
use crate::map::impact_map::ImpactState;
use crate::numerics::error::Error;
use crate::numerics::roots::{bisected_bracket, bracket_of_width};
use crate::orbits::closing::{Closed, Closing, Plane, turned};
use crate::orbits::periodic::PeriodicOrbit;
use crate::orbits::periodic::margin::next_to_margin;
use crate::run::{Observer, Watch, WorkCount};

/// The cosine of the largest angle that the direction turns in one step.
pub(super) const STRAIGHT: f64 = 0.95;

/// The largest correction, relative to the step.
pub(super) const LARGEST_CORRECTION: f64 = 0.3;

/// The numbers of Newton steps up to which the next step is longer and from which it is shorter, and the
/// factor by which a step grows.
pub(super) const EASY: u32 = 4;
pub(super) const HARD: u32 = 7;
pub(super) const GROWTH: f64 = 1.5;

/// Halvings until the bracket of a special point is as narrow as the rounding of the arclength.
const HALVINGS: u32 = 56;

/// The distance (scaled) up to which two points are neighbours on one curve: the rounding of a point on a
/// strongly unstable orbit, far below the distance between two curves that doubles can tell apart.
pub(super) const NEIGHBOURS: f64 = 1.0e-9;

/// Largest difference of a flight's duration (rad) from the one that the map finds.
const SAME_FLIGHT: f64 = 1.0e-8;

/// Roundings of (1 + m1)(1 + m2) for each impact, in units of the size of the derivative.
const FLIP_ROUNDINGS: f64 = 8.0;

/// The fewest points of a branch that counts as closed.
pub(super) const FEWEST_OF_CLOSED: usize = 8;

/// A fold counts as one if the parameter changes by more than this share of itself within this arclength to
/// either side.
const FLAT: f64 = 1.0e-11;
const ASIDE: f64 = 1.0e-3;

/// The smallest arclength of a step.
pub(super) const SMALLEST_STEP: f64 = 1.0e-10;

/// The length of a step that passes a place at which the acceleration of the platform jumps. So short a step may turn
/// by up to a right angle.
const CORNER: f64 = 1.0e-7;

/// If no next point is found, the walker asks the map again after this arclength. The map has lost a flight if the duration
/// is off by more than the second number (rad).
pub(super) const BEYOND: f64 = 1.0e-7;
const LOST: f64 = 1.0e-3;

/// [`ContinuedMap::continued`] from an orbit of the map or of a neighbouring map.
pub(crate) fn continued_from<M: ContinuedMap>(
    map: &M,
    orbit: &PeriodicOrbit,
    settings: &Continuation,
    observer: &dyn Observer,
) -> Result<Branch<M>, Error> {
    settings.check_map(map)?;
    let watch = Watch::begin(observer, 0, settings.max_points as u64)?;
    let (closing, mut at) = Closing::of(map, settings.parameter, &orbit.states)?;
    at.parameter = at.parameter.clamp(settings.low, settings.high);
    let (walker, located) = Walker::new(closing, at, settings, watch.work())?;
    let branch = walker.walk(located)?;
    watch.end();
    Ok(branch)
}

/// A point of the branch with its direction.
#[derive(Debug, Clone)]
pub(super) struct Located {
    pub(super) at: Closed,
    /// The direction, of scaled length 1 in first impact and parameter.
    pub(super) direction: Closed,
    pub(super) arclength: f64,
    pub(super) corrections: u32,
}

/// Start and initial direction of a branch (scaled; phase, speed, parameter), by which its return is
/// recognised.
#[derive(Debug, Clone, Copy)]
struct Start {
    at: [f64; 3],
    direction: [f64; 3],
}

/// The course of a branch in one step.
#[derive(Debug)]
struct Stretch {
    /// The end of the step: the next point, or the end of the branch before it.
    last: Located,
    /// The bifurcations up to there, in the order of the arclength.
    found: Vec<Bifurcation>,
    end: Option<BranchEnd>,
}

/// Continues one orbit.
#[derive(Debug)]
pub(super) struct Walker<'s, M> {
    pub(super) closing: Closing<M>,
    pub(super) settings: &'s Continuation,
    pub(super) work: RefCell<WorkCount<'s>>,
}

impl<'s, M: ContinuedMap> Walker<'s, M> {
    /// Counts the flights of a point: a few Newton steps of all impacts.
    pub(super) fn spend(&self) -> Result<(), Error> {
        self.work.borrow_mut().spend(8 * M::WORK * self.closing.flights() as u64)
    }

    /// A walker that starts from an orbit, in the direction of the settings.
    pub(super) fn new(
        closing: Closing<M>,
        guess: Closed,
        settings: &'s Continuation,
        work: WorkCount<'s>,
    ) -> Result<(Self, Located), Error> {
        let walker = Self { closing, settings, work: RefCell::new(work) };
        let base = walker.closing.scaled(&guess);
        let across = [0.0, 0.0, if settings.rising { 1.0 } else { -1.0 }];
        let plane = Plane { normal: across, base, distance: 0.0 };
        let lost = Error::NoBranch { what: "the orbit to be continued", parameter: guess.parameter };
        let (at, corrections) = walker.closing.corrected(guess, &plane).ok_or(lost)?;
        if walker.is_repeated(&at) {
            return Err(lost);
        }
        let direction = walker.closing.tangent(&at, across).ok_or(lost)?;
        Ok((walker, Located { at, direction, arclength: 0.0, corrections }))
    }

    /// A walker that starts from a doubling, on the branch of twice the period.
    pub(super) fn after_doubling(
        closing: Closing<M>,
        at: Closed,
        settings: &'s Continuation,
        work: WorkCount<'s>,
    ) -> Result<(Self, Located), Error> {
        let n = at.impacts.len();
        let lost = Error::NoBranch { what: "the doubled orbit", parameter: at.parameter };
        let flip = closing.flip_direction(&at).ok_or(lost)?;
        let there_and_back = flip.iter().copied().chain(flip.iter().map(|part| -*part)).collect();
        let walker = Self { closing: closing.twice(), settings, work: RefCell::new(work) };
        let direction = Closed { impacts: there_and_back, parameter: 0.0 };
        let direction = walker.closing.normalised(direction).ok_or(lost)?;
        let at = Closed { impacts: [at.impacts.as_slice(), &at.impacts].concat(), parameter: at.parameter };
        let base = Located { at, direction, arclength: 0.0, corrections: 0 };
        let mut step = settings.first_step;
        while step > SMALLEST_STEP {
            let next = walker.next(&base, step);
            // The orbit itself, traversed twice, is also a solution.
            let doubled = next.filter(|next| {
                let apart = (next.at.impacts[0] - next.at.impacts[n]).length();
                let moved = walker.closing.scaled(&base.direction);
                apart > 0.5 * step * (moved[0].abs() + moved[1].abs())
            });
            if let Some(located) = doubled {
                return Ok((walker, located));
            }
            step *= 0.5;
        }
        Err(lost)
    }

    /// The point at this arclength from another one, along its direction.
    fn at(&self, base: &Located, step: f64) -> Option<Located> {
        let normal = self.closing.scaled(&base.direction);
        let plane = Plane { normal, base: self.closing.scaled(&base.at), distance: step };
        let (at, corrections) = self.closing.corrected(base.at.moved(&base.direction, step), &plane)?;
        let direction = self.closing.tangent(&at, normal)?;
        Some(Located { at, direction, arclength: base.arclength + step, corrections })
    }

    /// The same, if it is certain enough to be the next point of the same branch.
    fn next(&self, base: &Located, step: f64) -> Option<Located> {
        let next = self.at(base, step)?;
        let (before, after) = (self.closing.scaled(&base.direction), self.closing.scaled(&next.direction));
        let cosine = (0..3).fold(0.0, |sum, k| sum + before[k] * after[k]);
        let guess = base.at.moved(&base.direction, step);
        let speed = self.closing.scale.speed;
        let largest = |a: &[DVec2], b: &[DVec2]| {
            a.iter()
                .zip(b)
                .fold(0.0_f64, |most, (a, b)| most.max((a.x - b.x).abs()).max((a.y - b.y).abs() / speed))
        };
        let moved = largest(&guess.impacts, &base.at.impacts).max(step);
        let corrected = largest(&guess.impacts, &next.at.impacts);
        let is_straight = cosine >= STRAIGHT && corrected <= LARGEST_CORRECTION * moved;
        let turns_a_corner = || step <= CORNER && cosine > 0.0 && self.joint_between(base, &next).is_some();
        (is_straight || turns_a_corner()).then_some(next)
    }

    /// The first impact between whose two phases the acceleration of the platform jumps.
    fn joint_between(&self, one: &Located, other: &Located) -> Option<usize> {
        let map = self.closing.map_at(one.at.parameter).ok()?;
        let mut phases = one.at.impacts.iter().zip(&other.at.impacts);
        phases.position(|(one, other)| map.has_joint_between(one.x, other.x))
    }

    /// The whole branch from `start` on; the items are its points.
    pub(super) fn walk(self, start: Located) -> Result<Branch<M>, Error> {
        let Some(first) = self.point(&start)? else {
            let parameter = start.at.parameter;
            return Err(Error::NoBranch { what: "the start of the branch", parameter });
        };
        let [at, direction] = [&start.at, &start.direction].map(|part| self.closing.scaled(part));
        let mut step = self.settings.first_step;
        let (closing, settings) = (&self.closing, self.settings);
        let begun = Start { at, direction };
        let (mut base, mut points, mut bifurcations) = (start, vec![first], Vec::new());
        let end = loop {
            if points.len() >= settings.max_points {
                break BranchEnd::PointLimit(points.len());
            }
            self.spend()?;
            let next = self.next(&base, step);
            let stretch = next.as_ref().map(|next| self.stretch(&base, next)).transpose()?.flatten();
            let (Some(next), Some(stretch)) = (next, stretch) else {
                step *= 0.5;
                if step < SMALLEST_STEP {
                    let end = self.end_at(&base)?;
                    let ends = end.is_some();
                    bifurcations.extend(end);
                    break if ends { BranchEnd::Bifurcation } else { BranchEnd::StepTooSmall(step) };
                }
                continue;
            };
            self.work.borrow().watch().finish(1);
            step = match next.corrections {
                ..=EASY => (GROWTH * step).min(settings.largest_step),
                HARD.. => step / GROWTH,
                _ => step,
            };
            bifurcations.extend(stretch.found);
            let (next, mut end) = (stretch.last, stretch.end);
            if end.is_none() && points.len() >= FEWEST_OF_CLOSED && self.passes(&base, &next, &begun) {
                end = Some(BranchEnd::Closed);
            }
            if next.arclength > base.arclength {
                points.extend(self.point(&next)?);
            }
            if let Some(end) = end {
                break end;
            }
            base = next;
        };
        Ok(Branch { parameter: closing.by, map: closing.map.clone(), points, bifurcations, end })
    }

    /// The reason why the branch ends if there is no next point: a kink at an impact, or a place beyond which the
    /// map has another flight.
    fn end_at(&self, base: &Located) -> Result<Option<Bifurcation>, Error> {
        let map = self.closing.map_at(base.at.parameter)?;
        let on_kink = base.at.impacts.iter().position(|impact| map.is_on_kink(impact.x));
        let kind = match on_kink {
            Some(impact) => Some(BifurcationKind::BorderCollision { impact }),
            None => self.flight_lost(base),
        };
        let Some(kind) = kind else { return Ok(None) };
        Ok(self.point(base)?.map(|point| Bifurcation { kind, point }))
    }

    /// The bifurcation at which the map itself loses a flight just beyond a point, along the branch or in the
    /// parameter alone. Where a force only touches zero, the branch is as steep as a square root.
    fn flight_lost(&self, base: &Located) -> Option<BifurcationKind> {
        let still = vec![DVec2::ZERO; base.at.impacts.len()];
        let aside = Closed { impacts: still, parameter: base.direction.parameter.signum() };
        [&base.direction, &aside].into_iter().find_map(|direction| {
            let beyond = base.at.moved(direction, BEYOND);
            let map = self.closing.map_at(beyond.parameter).ok()?;
            let states = self.closing.states(&beyond)?;
            states.iter().enumerate().find_map(|(flight, state)| {
                let impact = (flight + 1) % states.len();
                // A disk that stays on the platform has no next impact.
                let found = map.time_to_next(*state).unwrap_or(f64::INFINITY);
                let later = found - self.closing.duration(&beyond.impacts, flight);
                if later < -LOST {
                    return Some(BifurcationKind::Graze { flight });
                }
                (later > LOST).then_some(BifurcationKind::VanishingImpact { impact })
            })
        })
    }

    /// The course of the branch from `base` to `next`, as far as it goes. `None` if the step is too long to
    /// tell: every change along a curve lies between two neighbouring points of this curve, otherwise the
    /// step has leapt to another curve.
    fn stretch(&self, base: &Located, next: &Located) -> Result<Option<Stretch>, Error> {
        // Where the parameter turns back: only there it may leave its range and return to it within a step.
        let turn = match self.halves(base, next)? {
            Halves::Unclear => return Ok(None),
            Halves::Meet(birth) => Some(*birth),
            // At the very start of a doubled branch the parameter does not change: that is no fold.
            Halves::Apart if base.direction.parameter * next.direction.parameter < 0.0 => {
                let as_before =
                    |located: &Located| Ok(located.direction.parameter * base.direction.parameter > 0.0);
                let Some((last, beyond)) = self.change(base, next, as_before)? else { return Ok(None) };
                let kind = match self.closing.impact_lost(&last.at) {
                    Some(impact) => BifurcationKind::VanishingImpact { impact },
                    None => self.kind_or_border(BifurcationKind::Fold, &last, &beyond),
                };
                if kind == BifurcationKind::Fold && self.is_vertical(&last) {
                    None
                } else {
                    let point = self.point(&last)?;
                    let is_fold = |point: &BranchPoint| {
                        kind != BifurcationKind::Fold
                            || next_to_margin(point.orbit.monodromy, point.determinant).0
                    };
                    // No multiplier is 1: the differences that give the derivative cross a discontinuity.
                    if !point.as_ref().is_none_or(is_fold) {
                        return Ok(None);
                    }
                    point.map(|point| (last, Bifurcation { kind, point }))
                }
            }
            Halves::Apart => None,
        };
        let (low, high) = self.settings.range();
        let (mut last, mut end) = (next.clone(), None);
        let mut found = Vec::new();
        if let Some((before, turn)) = turn {
            let parameter = turn.point.parameter;
            let rounding = ROUNDED * parameter;
            let outside = parameter < low - rounding || parameter > high + rounding;
            let ends = matches!(turn.kind, BifurcationKind::Birth | BifurcationKind::VanishingImpact { .. });
            if outside || ends {
                last = before;
                let limit = if parameter > high { high } else { low };
                end = Some(if outside { BranchEnd::RangeLimit(limit) } else { BranchEnd::Bifurcation });
            }
            if !outside {
                found.push(turn);
            }
        }
        let inside = |located: &Located| (low..=high).contains(&located.at.parameter);
        if !inside(&last) && end != Some(BranchEnd::Bifurcation) {
            end = Some(BranchEnd::RangeLimit(if last.at.parameter > high { high } else { low }));
            let Some((within, _)) = self.change(base, &last, |located| Ok(inside(located)))? else {
                return Ok(None);
            };
            last = within;
        }
        if last.arclength > base.arclength && self.obstacle(&last.at)?.is_some() {
            // Rarely an orbit is lost and regained within a step: then the first of the two counts.
            let free = |located: &Located| Ok(self.obstacle(&located.at)?.is_none());
            let Some((free, beyond)) = self.change(base, &last, free)? else { return Ok(None) };
            found.retain(|turn: &Bifurcation| {
                turn.kind != BifurcationKind::Birth && turn.point.arclength <= free.arclength
            });
            if let (Some(kind), Some(point)) = (self.obstacle(&beyond.at)?, self.point(&free)?) {
                found.push(Bifurcation { kind, point });
            }
            end = Some(BranchEnd::Bifurcation);
            // There rounding decides which impact is the first: the points end with the last orbit that the
            // map confirms.
            let confirmed = |located: &Located| self.is_confirmed(&located.at);
            last = if confirmed(&free)? { free } else { self.bracket(base, &free, confirmed)?.0 };
        }
        let Some(doubling) = self.doubling(base, &last)? else { return Ok(None) };
        found.extend(doubling);
        found.sort_by(|a, b| a.point.arclength.total_cmp(&b.point.arclength));
        // Near its birth doubles cannot distinguish an orbit of 2m impacts from one of m.
        if found.last().is_some_and(|last| last.kind == BifurcationKind::Birth) {
            last = base.clone();
        }
        Ok(Some(Stretch { last, found, end }))
    }

    /// Whether the parameter is the same to either side up to rounding, as for the orbits of two impacts on parabolas:
    /// then rounding alone turns the branch back.
    fn is_vertical(&self, at: &Located) -> bool {
        [-ASIDE, ASIDE].into_iter().filter_map(|step| self.at(at, step)).any(|beside| {
            let parameter = at.at.parameter;
            (beside.at.parameter - parameter).abs() <= FLAT * parameter.abs()
        })
    }

    /// The doubling between two points, if there is one: a multiplier passes -1 between them, or is -1 within
    /// rounding at the second one or at the start of the branch.
    fn doubling(&self, base: &Located, next: &Located) -> Result<Option<Option<Bifurcation>>, Error> {
        let (Some(before), Some(after)) = (self.point(base)?, self.point(next)?) else {
            return Ok(Some(None));
        };
        let at = |point: BranchPoint| Ok(Some(Some(Bifurcation { kind: BifurcationKind::Doubling, point })));
        let (first, last) = (flip(&before), flip(&after));
        if first == 0.0 {
            return if base.arclength == 0.0 { at(before) } else { Ok(Some(None)) };
        }
        if last == 0.0 {
            return at(after);
        }
        if (first > 0.0) == (last > 0.0) {
            return Ok(Some(None));
        }
        let as_before =
            |located: &Located| Ok(self.point(located)?.is_some_and(|point| flip(&point) * first > 0.0));
        let Some((low, high)) = self.change(base, next, as_before)? else { return Ok(None) };
        let kind = self.kind_or_border(BifurcationKind::Doubling, &low, &high);
        let (Some(low), Some(high)) = (self.point(&low)?, self.point(&high)?) else { return Ok(Some(None)) };
        let point = if flip(&low).abs() <= flip(&high).abs() { low } else { high };
        Ok(Some(Some(Bifurcation { kind, point })))
    }

    /// The kind, or a border collision if an acceleration jumps between the two neighbours.
    fn kind_or_border(&self, kind: BifurcationKind, one: &Located, other: &Located) -> BifurcationKind {
        let border = self.joint_between(one, other);
        border.map_or(kind, |impact| BifurcationKind::BorderCollision { impact })
    }

    /// The result of [`Self::bracket`]; `None` if the two points are not neighbours on one curve.
    fn change(
        &self,
        base: &Located,
        next: &Located,
        holds: impl FnMut(&Located) -> Result<bool, Error>,
    ) -> Result<Option<(Located, Located)>, Error> {
        let (last, beyond) = self.bracket(base, next, holds)?;
        Ok((self.distance(&last.at, &beyond.at) <= NEIGHBOURS).then_some((last, beyond)))
    }

    /// The largest distance of impacts and parameter (scaled).
    pub(super) fn distance(&self, a: &Closed, b: &Closed) -> f64 {
        let scale = self.closing.scale;
        let parameter = (a.parameter - b.parameter).abs() / scale.parameter;
        a.impacts
            .iter()
            .zip(&b.impacts)
            .fold(parameter, |most, (a, b)| most.max((a.x - b.x).abs()).max((a.y - b.y).abs() / scale.speed))
    }

    /// The last point with a property that holds at `base`, and the first one without it, by halvings of the
    /// way to `next`.
    pub(super) fn bracket(
        &self,
        base: &Located,
        next: &Located,
        holds: impl FnMut(&Located) -> Result<bool, Error>,
    ) -> Result<(Located, Located), Error> {
        let at = |part| self.spend().map(|()| self.at(base, part));
        halved((base, next), next.arclength - base.arclength, at, holds)
    }

    /// The reason why a solution is not an orbit of the map.
    fn obstacle(&self, at: &Closed) -> Result<Option<BifurcationKind>, Error> {
        let map = self.closing.map_at(at.parameter)?;
        let flights = self.closing.flights_of(at);
        let n = flights.len();
        for (impact, flight) in flights.iter().enumerate() {
            if !(flights[(impact + n - 1) % n].to.1 < 0.0 && flight.from.1 > 0.0) {
                return Ok(Some(BifurcationKind::VanishingImpact { impact }));
            }
        }
        for (index, flight) in flights.iter().enumerate() {
            if map.is_grazed(flight)? {
                return Ok(Some(BifurcationKind::Graze { flight: index }));
            }
        }
        Ok(None)
    }

    /// Whether the map itself finds these flights.
    fn is_confirmed(&self, at: &Closed) -> Result<bool, Error> {
        let map = self.closing.map_at(at.parameter)?;
        let flights = self.closing.flights_of(at);
        if !flights.iter().all(|flight| flight.to.1 < 0.0 && flight.from.1 > 0.0) {
            return Ok(false);
        }
        for flight in &flights {
            if (map.duration_found(flight)? - flight.duration).abs() > SAME_FLIGHT {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// The point in the form of the results; `None` if it is not an orbit.
    pub(super) fn point(&self, located: &Located) -> Result<Option<BranchPoint>, Error> {
        let at = &located.at;
        let (n, map) = (at.impacts.len(), self.closing.map_at(at.parameter)?);
        let flights = self.closing.flights_of(at);
        let states = (0..n).map(|i| {
            let arrival = flights[(i + n - 1) % n].to.1;
            ImpactState::new(Phase::new(at.impacts[i].x)?, arrival.min(-f64::MIN_POSITIVE))
        });
        let states = states.collect::<Result<Vec<_>, _>>()?;
        let durations: Vec<f64> = flights.iter().map(|flight| flight.duration).collect();
        let Some((orbit, [trace, determinant])) = map.orbit_through(states, &durations) else {
            return Ok(None);
        };
        if orbit.check().is_err() {
            return Ok(None);
        }
        let point =
            BranchPoint { parameter: at.parameter, orbit, trace, determinant, arclength: located.arclength };
        Ok(Some(point))
    }

    /// Whether the step from `base` to `next` passes the start of the branch.
    fn passes(&self, base: &Located, next: &Located, start: &Start) -> bool {
        let [from, to] = [base, next].map(|located| self.closing.scaled(&located.at));
        let (goal, direction) = (start.at, start.direction);
        let along = |a: [f64; 3], b: [f64; 3]| (0..3).fold(0.0, |sum, k| sum + direction[k] * (b[k] - a[k]));
        let distance = (0..3).fold(0.0, |sum, k| sum + (goal[k] - from[k]) * (goal[k] - from[k])).sqrt();
        let step = next.arclength - base.arclength;
        along(from, goal) > 0.0 && along(goal, to) >= 0.0 && distance <= 1.1 * step
    }
}

/// (1 + m1)(1 + m2), or 0 if it is pure rounding.
fn flip(point: &BranchPoint) -> f64 {
    let flip = point.flip_function();
    let PeriodicOrbit { states, monodromy, .. } = &point.orbit;
    let size = 1.0 + monodromy.x_axis.length() + monodromy.y_axis.length();
    let rounding = FLIP_ROUNDINGS * f64::EPSILON * size * states.len() as f64;
    if flip.abs() <= rounding { 0.0 } else { flip }
}

// Where an orbit of 2m impacts is born by the doubling of one of m, both of its halves become that orbit. Its
// own equations have two branches there, so the code locates the birth on the other branch.

/// The distance between the halves (rad, units of 1 + P) below which the forcing does not distinguish an
/// orbit from the repetition of one half: the difference of the forcings grows with the square of this
/// distance.
const REPEATED: f64 = 1.0e-6;

/// The distance between the halves up to which an orbit near its birth counts as there. The equations
/// determine its forcing only to the rounding divided by this distance, but that of the shorter orbit to the
/// rounding.
const CLOSE: f64 = 1.0e-5;

/// The search for the doubling of the shorter orbit begins this far from the last point, in units of the
/// parameter's scale, and doubles the distance at most this many times.
const NEAREST: f64 = 1.0e-10;
const WIDENINGS: u32 = 26;

/// The behaviour of the halves of an orbit between two points.
#[derive(Debug)]
enum Halves {
    /// They stay apart.
    Apart,
    /// They become one at this birth, shortly after this point.
    Meet(Box<(Located, Bifurcation)>),
    /// The points are too far apart to tell.
    Unclear,
}

impl<M: ContinuedMap> Walker<'_, M> {
    fn apart(&self, at: &Closed) -> Vec<DVec2> {
        apart(&at.impacts, self.closing.scale.speed)
    }

    /// Whether the forcing does not distinguish an orbit from a shorter one traversed twice.
    fn is_repeated(&self, at: &Closed) -> bool {
        at.impacts.len().is_multiple_of(2) && largest(&self.apart(at)) <= REPEATED
    }

    /// Whether and where the halves of the orbit meet between two points. Beyond such a point the branch
    /// comes back with its halves swapped.
    fn halves(&self, base: &Located, next: &Located) -> Result<Halves, Error> {
        let before = self.apart(&base.at);
        let as_before = |located: &Located| {
            let here = self.apart(&located.at);
            let along: f64 = before.iter().zip(&here).map(|(a, b)| a.dot(*b)).sum();
            along > 0.0 && largest(&here) > CLOSE.min(largest(&before))
        };
        if before.is_empty() || as_before(next) {
            return Ok(Halves::Apart);
        }
        let (last, beyond) = self.bracket(base, next, |located| Ok(as_before(located)))?;
        if largest(&self.apart(&last.at)) > 2.0 * CLOSE {
            let continuous = self.distance(&last.at, &beyond.at) <= NEIGHBOURS;
            return Ok(if continuous { Halves::Apart } else { Halves::Unclear });
        }
        Ok(self.birth(&last)?.map_or(Halves::Unclear, |birth| Halves::Meet(Box::new((last, birth)))))
    }

    /// The doubling in which the orbit is born, near `last`, on the branch of half its impacts.
    fn birth(&self, last: &Located) -> Result<Option<Bifurcation>, Error> {
        let (half, guess) = self.closing.half(&last.at);
        let half = Walker { closing: half, settings: self.settings, work: self.work.clone() };
        let scale = half.closing.scale.parameter;
        let flip = |parameter: f64| -> Result<Option<(f64, BranchPoint)>, Error> {
            let mut base = half.closing.scaled(&guess);
            base[2] = parameter / scale;
            let plane = Plane { normal: [0.0, 0.0, 1.0], base, distance: 0.0 };
            let Some((at, corrections)) = half.closing.corrected(guess.clone(), &plane) else {
                return Ok(None);
            };
            let located = Located { direction: at.clone(), at, arclength: last.arclength, corrections };
            Ok(half.point(&located)?.map(|point| (point.flip_function(), point)))
        };
        let (least, most) = half.closing.by.legal();
        let mut reach = NEAREST * scale;
        for _ in 0..WIDENINGS {
            let ends = ((guess.parameter - reach).max(least), (guess.parameter + reach).min(most));
            let (Some((low, _)), Some((high, _))) = (flip(ends.0)?, flip(ends.1)?) else { return Ok(None) };
            if (low > 0.0) == (high > 0.0) {
                reach *= 2.0;
                continue;
            }
            let mut nearest: Option<(f64, BranchPoint)> = None;
            bracket_of_width(ends.0, ends.1, 0.0, |parameter| {
                half.spend()?;
                let Some((value, point)) = flip(parameter)? else { return Ok::<_, Error>(false) };
                if nearest.as_ref().is_none_or(|(least, _)| value.abs() <= least.abs()) {
                    nearest = Some((value, point));
                }
                Ok((value > 0.0) == (low > 0.0))
            })?;
            return Ok(nearest.map(|(_, point)| Bifurcation { kind: BifurcationKind::Birth, point }));
        }
        Ok(None)
    }
}

/// The distance of each impact of the second half from that of the first (in units of `speed`), up to whole turns; none
/// for an odd number of impacts.
pub(super) fn apart(impacts: &[DVec2], speed: f64) -> Vec<DVec2> {
    let n = impacts.len();
    let pairs = impacts[..n / 2].iter().zip(&impacts[n / 2..]);
    let turned = |(a, b): (&DVec2, &DVec2)| DVec2::new(turned(b.x - a.x), (b.y - a.y) / speed);
    if n.is_multiple_of(2) { pairs.map(turned).collect() } else { Vec::new() }
}

pub(super) fn largest(apart: &[DVec2]) -> f64 {
    apart.iter().fold(0.0, |most, part| most.max(part.x.abs()).max(part.y.abs()))
}

/// The last point with a property that the first of `ends` has, and the first one without it, by halvings of the
/// arclength between them. `at` finds the point at an arclength from the first end; if there is no point, it
/// counts as lacking the property.
pub(super) fn halved<P: Clone>(
    ends: (&P, &P),
    arclength: f64,
    at: impl Fn(f64) -> Result<Option<P>, Error>,
    mut holds: impl FnMut(&P) -> Result<bool, Error>,
) -> Result<(P, P), Error> {
    let (mut last, mut beyond) = (ends.0.clone(), ends.1.clone());
    bisected_bracket(0.0, arclength, HALVINGS, |part| {
        let Some(located) = at(part)? else { return Ok::<_, Error>(false) };
        let held = holds(&located)?;
        if held {
            last = located;
        } else {
            beyond = located;
        }
        Ok(held)
    })?;
    Ok((last, beyond))
}
