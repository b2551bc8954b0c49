//! From point to point along a branch.

use core::cell::RefCell;
use core::f64::consts::TAU;

use glam::{DMat2, DVec2};

use super::tip::BranchTip;
use super::{Bifurcation, BifurcationKind, Branch, BranchEnd, BranchPoint, Continuation};
use crate::analysis::closing::{Closed, Closing, Plane};
use crate::analysis::periodic::PeriodicOrbit;
use crate::error::Error;
use crate::flight::impact::Impact;
use crate::flight::launch::Launch;
use crate::map::impact_map::ImpactState;
use crate::numerics::roots::bisected_bracket;
use crate::observer::WorkCount;
use crate::platform::phase::Phase;

/// The cosine of the largest angle that the direction turns in one step.
const STRAIGHT: f64 = 0.95;

/// The largest correction, relative to the step.
const LARGEST_CORRECTION: f64 = 0.3;

/// Newton steps up to which the arclength of a step grows, and from which it shrinks; by these factors.
const EASY: u32 = 4;
const HARD: u32 = 7;
const GROWTH: f64 = 1.5;

/// The smallest arclength of a step.
pub(super) const SMALLEST_STEP: f64 = 1.0e-10;

/// Halvings until the bracket of a special point is at the rounding of the arclength.
pub(super) const HALVINGS: u32 = 56;

/// A branch is not taken to be closed before so many points.
const FEWEST_OF_CLOSED: usize = 8;

/// A point of the branch with its direction.
#[derive(Debug, Clone)]
pub(super) struct Located {
    pub(super) at: Closed,
    /// Of scaled length 1 in first impact and parameter.
    pub(super) direction: Closed,
    pub(super) arclength: f64,
    pub(super) corrections: u32,
}

/// Where a branch began, and in which direction (scaled; phase, speed, parameter): whether it is back there.
#[derive(Debug, Clone, Copy)]
pub(super) struct Start {
    pub(super) at: [f64; 3],
    pub(super) direction: [f64; 3],
}

/// A walk under way: all that the rest of it depends on.
#[derive(Debug)]
pub(super) struct Underway {
    pub(super) start: Start,
    pub(super) base: Located,
    pub(super) step: f64,
    pub(super) points: Vec<BranchPoint>,
    pub(super) bifurcations: Vec<Bifurcation>,
}

/// What ends a branch where it is no orbit of the map any more.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Obstacle {
    Graze { flight: usize },
    VanishingImpact { impact: usize },
}

/// Continues one orbit.
#[derive(Debug)]
pub(super) struct Walker<'s> {
    pub(super) closing: Closing,
    pub(super) settings: &'s Continuation,
    pub(super) work: RefCell<WorkCount<'s>>,
}

impl<'s> Walker<'s> {
    /// Counts the flights of a point: some Newton steps of all impacts.
    pub(super) fn spend(&self) -> Result<(), Error> {
        self.work.borrow_mut().spend(8 * self.closing.flights() as u64)
    }

    /// From an orbit, in the direction of the settings.
    pub(super) fn new(
        closing: Closing,
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
        let direction = walker.closing.tangent(&at, across).ok_or(lost)?;
        Ok((walker, Located { at, direction, arclength: 0.0, corrections }))
    }

    /// To go on with a branch.
    pub(super) const fn resumed(closing: Closing, settings: &'s Continuation, work: WorkCount<'s>) -> Self {
        Self { closing, settings, work: RefCell::new(work) }
    }

    /// From a doubling, onto the branch of twice the period.
    pub(super) fn after_doubling(
        closing: Closing,
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
            // The orbit itself, gone through twice, is a solution, too.
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

    /// The same, if it is certain enough to be the next one of the same branch.
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
        (cosine >= STRAIGHT && corrected <= LARGEST_CORRECTION * moved).then_some(next)
    }

    /// The whole branch from `start` on; the items are its points.
    pub(super) fn walk(self, start: Located) -> Result<Branch, Error> {
        let Some(first) = self.point(&start)? else {
            let parameter = start.at.parameter;
            return Err(Error::NoBranch { what: "the start of the branch", parameter });
        };
        let [at, direction] = [&start.at, &start.direction].map(|part| self.closing.scaled(part));
        let step = self.settings.first_step;
        self.go_on(Underway {
            start: Start { at, direction },
            base: start,
            step,
            points: vec![first],
            bifurcations: Vec::new(),
        })
    }

    /// The rest of a branch.
    pub(super) fn go_on(self, underway: Underway) -> Result<Branch, Error> {
        let (closing, settings) = (&self.closing, self.settings);
        let Underway { start, mut base, mut step, mut points, mut bifurcations } = underway;
        let mut tip = None;
        let end = loop {
            if points.len() >= settings.max_points {
                tip = Some(BranchTip::of(closing, settings, start, base, step));
                break BranchEnd::PointLimit(points.len());
            }
            self.spend()?;
            let Some(mut next) = self.next(&base, step) else {
                step *= 0.5;
                if step < SMALLEST_STEP {
                    break BranchEnd::StepTooSmall(step);
                }
                continue;
            };
            self.work.borrow().watch().finish(1);
            let taken = step;
            step = match next.corrections {
                ..=EASY => (GROWTH * step).min(settings.largest_step),
                HARD.. => step / GROWTH,
                _ => step,
            };
            // Where it ends within this step, the step ends there.
            let mut end = None;
            if self.is_born(&base, &next) {
                end = Some(match self.birth(&base, &next, taken)? {
                    Some(birth) => {
                        bifurcations.push(birth);
                        BranchEnd::Bifurcation
                    }
                    None => BranchEnd::StepTooSmall(taken),
                });
                next = base.clone();
            }
            if end.is_none() {
                let (low, high) = settings.range();
                let inside = |located: &Located| (low..=high).contains(&located.at.parameter);
                if !inside(&next) {
                    end = Some(BranchEnd::RangeLimit(if next.at.parameter > high { high } else { low }));
                    next = self.bracket(&base, taken, &next, |located| Ok(inside(located)))?.0;
                }
                let obstacle = if next.arclength > base.arclength { self.obstacle(&next.at)? } else { None };
                if obstacle.is_some() {
                    // Rarely an orbit is lost and regained within a step: what comes first counts.
                    let free = |located: &Located| Ok(self.obstacle(&located.at)?.is_none());
                    let (last, beyond) = self.bracket(&base, next.arclength - base.arclength, &next, free)?;
                    self.on_the_way(&base, &last, &mut bifurcations)?;
                    if let (Some(obstacle), Some(point)) = (self.obstacle(&beyond.at)?, self.point(&last)?) {
                        let kind = match obstacle {
                            Obstacle::Graze { flight } => BifurcationKind::Graze { flight },
                            Obstacle::VanishingImpact { impact } => {
                                BifurcationKind::VanishingImpact { impact }
                            }
                        };
                        bifurcations.push(Bifurcation { kind, point });
                    }
                    (next, end) = (last, Some(BranchEnd::Bifurcation));
                } else {
                    self.on_the_way(&base, &next, &mut bifurcations)?;
                }
            }
            if end.is_none() && points.len() >= FEWEST_OF_CLOSED && self.passes(&base, &next, &start) {
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
        Ok(Branch { parameter: closing.by, map: closing.map, points, bifurcations, end, tip })
    }

    /// The doublings and folds between two points, in their order.
    fn on_the_way(&self, base: &Located, next: &Located, found: &mut Vec<Bifurcation>) -> Result<(), Error> {
        let step = next.arclength - base.arclength;
        let (Some(before), Some(after)) = (self.point(base)?, self.point(next)?) else { return Ok(()) };
        let mut here = Vec::new();
        let flip = |point: &BranchPoint| 1.0 + point.trace + point.determinant;
        if (flip(&before) > 0.0) != (flip(&after) > 0.0) {
            let as_before = |located: &Located| {
                Ok(self.point(located)?.is_some_and(|point| (flip(&point) > 0.0) == (flip(&before) > 0.0)))
            };
            let (low, high) = self.bracket(base, step, next, as_before)?;
            let nearer =
                |a: BranchPoint, b: BranchPoint| if flip(&a).abs() <= flip(&b).abs() { a } else { b };
            if let (Some(low), Some(high)) = (self.point(&low)?, self.point(&high)?) {
                here.push(Bifurcation { kind: BifurcationKind::Doubling, point: nearer(low, high) });
            }
        }
        // At the very start of a doubled branch the parameter does not change: that is no fold.
        let turns = base.direction.parameter * next.direction.parameter < 0.0;
        if turns {
            let as_before =
                |located: &Located| Ok(located.direction.parameter * base.direction.parameter > 0.0);
            let (low, _) = self.bracket(base, step, next, as_before)?;
            here.extend(self.point(&low)?.map(|point| Bifurcation { kind: BifurcationKind::Fold, point }));
        }
        here.sort_by(|a, b| a.point.arclength.total_cmp(&b.point.arclength));
        found.extend(here);
        Ok(())
    }

    /// The last point with a property that holds at `base`, and the first one without it, by halvings of a
    /// step.
    fn bracket(
        &self,
        base: &Located,
        step: f64,
        next: &Located,
        mut holds: impl FnMut(&Located) -> Result<bool, Error>,
    ) -> Result<(Located, Located), Error> {
        let (mut last, mut beyond) = (base.clone(), next.clone());
        bisected_bracket(0.0, step, HALVINGS, |part| {
            self.spend()?;
            // A point that is not found is taken to lie beyond.
            let Some(located) = self.at(base, part) else { return Ok::<_, Error>(false) };
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

    /// What makes it no orbit of the map.
    fn obstacle(&self, at: &Closed) -> Result<Option<Obstacle>, Error> {
        let map = self.closing.map_at(at.parameter)?;
        let velocities = self.closing.velocities(at);
        for (impact, &(arrival, launch)) in velocities.iter().enumerate() {
            if !(arrival < 0.0 && launch > 0.0) {
                return Ok(Some(Obstacle::VanishingImpact { impact }));
            }
        }
        for (flight, &(_, speed)) in velocities.iter().enumerate() {
            let launch = Launch::known(Phase::new(at.impacts[flight].x)?, speed);
            let following = (flight + 1) % velocities.len();
            let impact = Impact {
                periods: 0,
                remainder: self.closing.duration(&at.impacts, flight),
                turns: 0,
                phase: Phase::new(at.impacts[following].x)?,
                velocity: velocities[following].0,
                evaluations: 0,
            };
            if map.vibration().graze_margin(launch, &impact) <= 0.0 {
                return Ok(Some(Obstacle::Graze { flight }));
            }
        }
        Ok(None)
    }

    /// The point in the form of the results; `None` where it is no orbit.
    pub(super) fn point(&self, located: &Located) -> Result<Option<BranchPoint>, Error> {
        let at = &located.at;
        let (n, map) = (at.impacts.len(), self.closing.map_at(at.parameter)?);
        let states = at.impacts.iter().zip(self.closing.velocities(at)).map(|(impact, (arrival, _))| {
            ImpactState::new(Phase::new(impact.x)?, arrival.min(-f64::MIN_POSITIVE))
        });
        let states = states.collect::<Result<Vec<_>, _>>()?;
        let (mut monodromy, mut determinant, mut total) = (DMat2::IDENTITY, 1.0, 0.0);
        for i in 0..n {
            let h = self.closing.duration(&at.impacts, i);
            monodromy = map.derivative(states[i], states[(i + 1) % n], h) * monodromy;
            determinant *= map.restitution() * map.restitution();
            total += h;
        }
        let platform_periods = (total / TAU).round() as u64;
        let trace = monodromy.x_axis.x + monodromy.y_axis.y;
        let orbit = PeriodicOrbit::of(&map, states, platform_periods, monodromy);
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
