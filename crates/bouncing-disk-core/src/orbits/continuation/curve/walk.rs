//! From point to point along a curve of bifurcations, by pseudo-arclength on the surface of closed sequences.

use core::cell::RefCell;

use glam::DVec2;

use super::special::Special;
use super::surface::{Place, Scaled, Surface, dot, less};
use super::{BifurcationKind, Curve, CurveEnd, CurvePoint, SpecialKind, SpecialPoint};
use crate::numerics::error::Error;
use crate::orbits::closing::{Closed, Closing, Flight, turned};
use crate::orbits::continuation::walker::{
    BEYOND, EASY, FEWEST_OF_CLOSED, GROWTH, HARD, LARGEST_CORRECTION, NEIGHBOURS, SMALLEST_STEP, STRAIGHT,
    apart, halved, largest,
};
use crate::orbits::continuation::{Continuation, ContinuedMap, ROUNDED};
use crate::run::WorkCount;

/// Steps across a curve until a point on it is given up, and a step (scaled) above which the slope is updated.
const MAX_STEPS: u32 = 30;
const FAR: f64 = 1.0e-7;

/// The size of a step across a curve that is rounding, and the size below which steps that stop shrinking are
/// rounding.
const ROUNDING: f64 = 1.0e-15;
const NEARLY: f64 = 1.0e-8;

/// How far from a grazing point (rad) the rest of its flight begins, and by how much that may be off.
const ASIDE: f64 = 1.0e-4;
const SAME_FLIGHT: f64 = 1.0e-3;

/// The distance between the halves of an orbit (rad, units of 1 + P) up to which they count as one: the equations
/// are singular there.
const CLOSE: f64 = 1.0e-3;

/// The speed of an impact (units of 1 + P) below which the impact is the reason why a curve cannot be followed
/// further: the derivative grows with the inverse of this speed.
const SLOW: f64 = 1.0e-3;

/// Roundings of the equations, in units of their terms.
const ROUNDINGS: f64 = 16.0;

/// A point of a curve.
#[derive(Debug, Clone)]
pub(super) struct Located {
    pub(super) at: Place,
    /// The direction of the curve, of scaled length 1.
    pub(super) direction: Place,
    /// The normal (scaled) in the surface across the curve, and how the condition changes along it.
    across: Scaled,
    slope: f64,
    /// See [`super::condition::Value::after`].
    pub(super) after: f64,
    pub(super) arclength: f64,
    corrections: u32,
}

/// The course of a curve in one step.
struct Stretch {
    last: Located,
    special: Vec<SpecialPoint>,
    end: Option<CurveEnd>,
}

/// Continues one curve.
#[derive(Debug)]
pub(super) struct CurveWalker<'s, M> {
    pub(super) kind: BifurcationKind,
    pub(super) surface: Surface<M>,
    range: (f64, f64),
    settings: &'s Continuation,
    work: RefCell<WorkCount<'s>>,
}

impl<'s, M: ContinuedMap> CurveWalker<'s, M> {
    pub(super) fn new(
        kind: BifurcationKind,
        closing: Closing<M>,
        start: &Closed,
        range: (f64, f64),
        settings: &'s Continuation,
        work: WorkCount<'s>,
    ) -> Result<(Self, Located), Error> {
        let lost = Error::NoBranch { what: "a curve of bifurcations", parameter: start.parameter };
        let parameters = [closing.by, settings.parameter];
        let second = closing.map.parameter(settings.parameter).ok_or(lost)?;
        let at = Place { impacts: start.impacts.clone(), parameters: [start.parameter, second] };
        let unit = closing.map.scale(settings.parameter).parameter;
        let scales = [closing.scale.speed, closing.scale.parameter, unit];
        // The branch passes through the start at the same second parameter.
        let along = branch_direction(&closing, start).ok_or(lost)?;
        let surface = Surface { closing, parameters, scales };
        let walker = Self { kind, surface, range, settings, work: RefCell::new(work) };
        let located = walker.start(at, [along[0], along[1], along[2], 0.0]).ok_or(lost)?;
        Ok((walker, located))
    }

    /// The start of the curve, in the direction of the settings, from a place where a branch goes in the direction
    /// `branch`.
    fn start(&self, at: Place, branch: Scaled) -> Option<Located> {
        let surface = &self.surface;
        let after = match self.kind {
            BifurcationKind::Graze { flight } => surface.nearest(flight, &at)?,
            _ => 0.0,
        };
        let normals = [[0.0, 0.0, 0.0, 1.0], branch];
        let [second, along] = surface.directions(&at, normals)?;
        let slope = surface.derivative(self.kind, &at, &along, after)?;
        let direction = surface.normalised((1.0, &second), (0.0, &along))?;
        let seed = Located { at, direction, across: branch, slope, after, arclength: 0.0, corrections: 0 };
        let mut start = self.at(&seed, 0.0)?;
        if (start.direction.parameters[1] > 0.0) != self.settings.rising {
            start.direction = surface.normalised((-1.0, &start.direction), (0.0, &start.direction))?;
        }
        Some(start)
    }

    /// The point at this arclength from another one, along its direction.
    pub(super) fn at(&self, base: &Located, step: f64) -> Option<Located> {
        let surface = &self.surface;
        let normals = [surface.scaled(&base.direction), base.across];
        let origin = surface.scaled(&base.at);
        let guess = base.at.moved(&base.direction, step);
        let (mut at, corrections) = surface.corrected(guess, origin, normals, [step, 0.0])?;
        let mut here = surface.value(self.kind, &at, base.after)?;
        let (mut slope, mut side, mut last) = (base.slope, 0.0, f64::INFINITY);
        let mut steps = 0;
        loop {
            let change = -here.value / slope;
            steps += 1;
            if !change.is_finite() || steps > MAX_STEPS {
                return None;
            }
            if change.abs() <= ROUNDING || last <= NEARLY && change.abs() >= 0.5 * last {
                break;
            }
            side += change;
            (at, _) = surface.corrected(at, origin, normals, [step, side])?;
            let next = surface.value(self.kind, &at, here.after)?;
            if change.abs() > FAR {
                slope = (next.value - here.value) / change;
            }
            (here, last) = (next, change.abs());
        }
        let [along, aside] = surface.directions(&at, normals)?;
        let by = [&along, &aside].map(|part| surface.derivative(self.kind, &at, part, here.after));
        let [by_along, by_aside] = [by[0]?, by[1]?];
        let direction = surface.normalised((1.0, &along), (-by_along / by_aside, &aside))?;
        let (unit, side) = (surface.scaled(&direction), surface.scaled(&aside));
        let part = dot(unit, side);
        let across: Scaled = core::array::from_fn(|k| side[k] - part * unit[k]);
        let length = dot(across, across).sqrt();
        let (across, slope) = (across.map(|own| own / length), by_aside / length);
        if !(slope.is_finite() && slope != 0.0) {
            return None;
        }
        let arclength = base.arclength + step;
        Some(Located { at, direction, across, slope, after: here.after, arclength, corrections })
    }

    /// The same, if it is certain enough to be the next point of the same curve.
    fn next(&self, base: &Located, step: f64) -> Option<Located> {
        let next = self.at(base, step)?;
        let surface = &self.surface;
        let cosine = dot(surface.scaled(&base.direction), surface.scaled(&next.direction));
        let guess = base.at.moved(&base.direction, step);
        let moved = surface.distance(&guess, &base.at).max(step);
        let corrected = surface.distance(&guess, &next.at);
        (cosine >= STRAIGHT && corrected <= LARGEST_CORRECTION * moved).then_some(next)
    }

    /// The whole curve from `start` on; the items are its points.
    pub(super) fn walk(self, start: Located) -> Result<Curve<M>, Error> {
        let parameter = start.at.parameters[0];
        let lost = Error::NoBranch { what: "the start of a curve", parameter };
        if self.obstacle(&start, &start)?.is_some() {
            return Err(lost);
        }
        let first = self.point(&start).ok_or(lost)?;
        let (begun, settings) = (start.clone(), self.settings);
        let mut step = settings.first_step;
        let (mut base, mut points, mut special) = (start, vec![first], Vec::new());
        let end = loop {
            if points.len() >= settings.max_points {
                break CurveEnd::PointLimit(points.len());
            }
            self.spend()?;
            let next = self.next(&base, step);
            let stretch = next.as_ref().map(|next| self.stretch(&base, next)).transpose()?.flatten();
            let (Some(next), Some(stretch)) = (next, stretch) else {
                step *= 0.5;
                if step < SMALLEST_STEP {
                    let end = self.border(&base)?.unwrap_or(CurveEnd::StepTooSmall(step));
                    special.extend(self.resonance(&base));
                    break end;
                }
                continue;
            };
            self.work.borrow().watch().finish(1);
            step = match next.corrections {
                ..=EASY => (GROWTH * step).min(settings.largest_step),
                HARD.. => step / GROWTH,
                _ => step,
            };
            let Stretch { last, special: found, mut end } = stretch;
            special.extend(found);
            if end.is_none() && points.len() >= FEWEST_OF_CLOSED && self.passes(&base, &last, &begun) {
                end = Some(CurveEnd::Closed);
            }
            if last.arclength > base.arclength {
                points.extend(self.point(&last));
            }
            if let Some(end) = end {
                special.extend(self.resonance(&last));
                break end;
            }
            base = last;
        };
        let Surface { closing, parameters, .. } = self.surface;
        Ok(Curve { kind: self.kind, parameters, map: closing.map, points, special, end })
    }

    /// The course of the curve from `base` to `next`, as far as it goes; `None` if the step is too long to tell.
    fn stretch(&self, base: &Located, next: &Located) -> Result<Option<Stretch>, Error> {
        let (mut last, mut end) = (next.clone(), None);
        for leaves in [Self::out_of_range, Self::obstacle, Self::halves_meet] {
            let Some(reason) = leaves(self, &last, base)? else { continue };
            let stays = |located: &Located| Ok(leaves(self, located, base)?.is_none());
            let Some((inside, beyond)) = self.change(base, &last, stays)? else { return Ok(None) };
            let reason = leaves(self, &beyond, base)?.unwrap_or(reason);
            // A distance of half a period changes its sign without being small.
            if reason == CurveEnd::Birth && largest(&self.halves(&inside)) > 2.0 * CLOSE {
                continue;
            }
            (last, end) = (inside, Some(reason));
        }
        let mut special = Vec::new();
        for kind in self.special_kinds() {
            match self.special(kind, base, &last)? {
                Special::None => {}
                Special::Unclear => return Ok(None),
                Special::Found(found) => special.push(*found),
            }
        }
        if let Some(CurveEnd::Graze { flight }) = end
            && let Some(point) = self.point(&last)
        {
            let kind = match self.kind {
                BifurcationKind::Fold => Some(SpecialKind::GrazingFold { flight }),
                BifurcationKind::Doubling => Some(SpecialKind::GrazingDoubling { flight }),
                _ => None,
            };
            // The place along the curve at which the gap vanishes.
            let graze = BifurcationKind::Graze { flight };
            let off = self.surface.nearest(flight, &last.at).and_then(|after| {
                let gap = self.surface.value(graze, &last.at, after)?;
                let slope = self.surface.derivative(graze, &last.at, &last.direction, after)?;
                Some((gap.value.abs() + gap.rounding) / slope.abs())
            });
            let off = off.unwrap_or(BEYOND);
            special.extend(kind.map(|kind| self.special_at(kind, point, &last, off)));
        }
        special.sort_by(|a, b| a.point.arclength.total_cmp(&b.point.arclength));
        Ok(Some(Stretch { last, special, end }))
    }

    /// Whether a parameter has left its range.
    fn out_of_range(&self, located: &Located, _base: &Located) -> Result<Option<CurveEnd>, Error> {
        let ranges = [self.range, self.settings.range()];
        Ok((0..2).find_map(|index| {
            let (parameter, value) = (self.surface.parameters[index], located.at.parameters[index]);
            let (low, high) = ranges[index];
            // The forcing of a map, P/pi, is rounded: a start at an end of the range may lie just outside.
            let rounding = if located.arclength > 0.0 { 0.0 } else { ROUNDED * value.abs() };
            if value < low - rounding {
                return Some(CurveEnd::RangeLimit { parameter, value: low });
            }
            (value > high + rounding).then_some(CurveEnd::RangeLimit { parameter, value: high })
        }))
    }

    /// Why a place is not an orbit of the map, apart from the graze of the curve.
    fn obstacle(&self, located: &Located, _base: &Located) -> Result<Option<CurveEnd>, Error> {
        let Some((closing, closed)) = self.surface.section(&located.at, 0) else { return Ok(None) };
        let map = closing.map_at(closed.parameter)?;
        let flights = closing.flights_of(&closed);
        let n = flights.len();
        for (impact, flight) in flights.iter().enumerate() {
            if !(flights[(impact + n - 1) % n].to.1 < 0.0 && flight.from.1 > 0.0) {
                return Ok(Some(CurveEnd::VanishingImpact { impact }));
            }
        }
        for (index, flight) in flights.iter().enumerate() {
            let is_own = self.kind == BifurcationKind::Graze { flight: index };
            let is_met = if is_own {
                self.is_met_elsewhere(&map, flight, located.after)?
            } else {
                map.is_grazed(flight)?
            };
            if is_met {
                return Ok(Some(CurveEnd::Graze { flight: index }));
            }
        }
        Ok(None)
    }

    /// Whether the platform meets a flight before or after its graze.
    fn is_met_elsewhere(&self, map: &M, flight: &Flight, after: f64) -> Result<bool, Error> {
        let found = map.duration_found(flight)?;
        let is_graze = (found - after).abs() <= SAME_FLIGHT;
        if !is_graze && (found - flight.duration).abs() > SAME_FLIGHT {
            return Ok(true);
        }
        let from = after + ASIDE;
        let Some([_, rate, _]) = map.gap(flight, from).filter(|[_, rate, _]| *rate > 0.0) else {
            return Ok(true);
        };
        let rest = Flight { from: (flight.from.0 + from, rate), duration: flight.duration - from, ..*flight };
        Ok((map.duration_found(&rest)? - rest.duration).abs() > SAME_FLIGHT)
    }

    fn halves(&self, located: &Located) -> Vec<DVec2> {
        apart(&located.at.impacts, self.surface.scales[0])
    }

    /// Whether the halves of the orbit have become one.
    fn halves_meet(&self, located: &Located, base: &Located) -> Result<Option<CurveEnd>, Error> {
        let (before, here) = (self.halves(base), self.halves(located));
        let along: f64 = before.iter().zip(&here).map(|(a, b)| a.dot(*b)).sum();
        let meet = !before.is_empty() && (along <= 0.0 || largest(&here) <= CLOSE.min(largest(&before)));
        Ok(meet.then_some(CurveEnd::Birth))
    }

    /// Why no point is found beyond this one: the end of a range in which there are maps, an impact that has almost lost
    /// its speed, or a joint of the platform that an impact reaches.
    fn border(&self, base: &Located) -> Result<Option<CurveEnd>, Error> {
        let beyond = base.at.moved(&base.direction, BEYOND);
        let left = self.out_of_range(&Located { at: beyond, ..base.clone() }, base)?;
        Ok(left.or_else(|| self.obstacle_beyond(base)))
    }

    fn obstacle_beyond(&self, base: &Located) -> Option<CurveEnd> {
        if let Some(impact) = self.slow_impact(base) {
            return Some(CurveEnd::VanishingImpact { impact });
        }
        let impact = self.surface.joint_between(&base.at, &base.at.moved(&base.direction, BEYOND))?;
        Some(CurveEnd::BorderCollision { impact })
    }

    /// An impact that has almost lost its speed.
    pub(super) fn slow_impact(&self, located: &Located) -> Option<usize> {
        let (closing, closed) = self.surface.section(&located.at, 0)?;
        let slow = -SLOW * self.surface.scales[0];
        closing
            .flights_of(&closed)
            .iter()
            .position(|flight| flight.to.1 >= slow)
            .map(|flight| (flight + 1) % closed.impacts.len())
    }

    /// Whether the step from `base` to `next` passes the start of the curve.
    fn passes(&self, base: &Located, next: &Located, begun: &Located) -> bool {
        let [from, to, goal] = [base, next, begun].map(|located| self.surface.scaled(&located.at));
        let direction = self.surface.scaled(&begun.direction);
        // The phase may have advanced by a whole turn.
        let apart = |a: Scaled, b: Scaled| {
            let [phase, rest @ ..] = less(a, b);
            let [speed, first, second] = rest;
            [turned(phase), speed, first, second]
        };
        let (left, over) = (apart(goal, from), apart(to, goal));
        let step = next.arclength - base.arclength;
        dot(direction, left) > 0.0 && dot(direction, over) >= 0.0 && dot(left, left).sqrt() <= 1.1 * step
    }

    /// The last point with a property that holds at `base`, and the first one without it; `None` if the two are not
    /// neighbours on one curve.
    pub(super) fn change(
        &self,
        base: &Located,
        next: &Located,
        holds: impl FnMut(&Located) -> Result<bool, Error>,
    ) -> Result<Option<(Located, Located)>, Error> {
        let at = |part| self.spend().map(|()| self.at(base, part));
        let (last, beyond) = halved((base, next), next.arclength - base.arclength, at, holds)?;
        Ok((self.surface.distance(&last.at, &beyond.at) <= NEIGHBOURS).then_some((last, beyond)))
    }

    fn spend(&self) -> Result<(), Error> {
        self.work.borrow_mut().spend(64 * M::WORK * self.surface.closing.flights() as u64)
    }

    /// The point in the form of the results.
    pub(super) fn point(&self, located: &Located) -> Option<CurvePoint> {
        let (closing, closed) = self.surface.section(&located.at, 0)?;
        let around = self.surface.around(&located.at)?;
        let is_supercritical = match self.kind {
            BifurcationKind::Doubling => {
                self.criticality(located).filter(|(value, error)| value.abs() > *error)
            }
            _ => None,
        };
        Some(CurvePoint {
            parameters: located.at.parameters,
            errors: self.moves(located)?.along,
            states: closing.states(&closed)?,
            trace: around.x_axis.x + around.y_axis.y,
            determinant: around.determinant(),
            arclength: located.arclength,
            is_supercritical: is_supercritical.map(|(value, _)| value > 0.0),
        })
    }

    /// How far rounding moves a point of the curve.
    pub(super) fn moves(&self, located: &Located) -> Option<Moves> {
        let (surface, at) = (&self.surface, &located.at);
        let normals = [surface.scaled(&located.direction), located.across];
        let [_, aside] = surface.directions(at, normals)?;
        let terms = at.impacts.iter().fold(1.0, |most: f64, impact| most.max(impact.y.abs()));
        let rounding = ROUNDINGS * M::WORK as f64 * f64::EPSILON * terms;
        let [first, second] = located.direction.parameters;
        let [one, other] = at.parameters.map(|value| 2.0 * f64::EPSILON * value.abs());
        let mut moves = Moves { across: [one, other], along: [one, other] };
        let value = surface.value(self.kind, at, located.after)?;
        let side = value.rounding.max(value.value.abs()) / located.slope.abs();
        let mut add = |[by_first, by_second]: [f64; 2]| {
            moves.across[0] += by_first.abs();
            moves.across[1] += by_second.abs();
            moves.along[0] += (by_first - by_second * first / second).abs();
            moves.along[1] += (by_second - by_first * second / first).abs();
        };
        add(aside.parameters.map(|part| side * part));
        for change in surface.moved_by_rounding(at, normals, rounding)? {
            if surface.largest(&change) == 0.0 {
                continue;
            }
            let side = -surface.derivative(self.kind, at, &change, located.after)? / located.slope;
            add(change.moved(&aside, side).parameters);
        }
        moves.along = moves.along.map(|move_| if move_.is_finite() { move_ } else { f64::MAX });
        Some(moves)
    }
}

/// How far rounding moves a point of a curve.
pub(super) struct Moves {
    /// The shift of the two parameters across the direction of the curve.
    pub(super) across: [f64; 2],
    /// The shift of the curve along the first parameter and along the second.
    pub(super) along: [f64; 2],
}

/// The direction (scaled; phase, speed, parameter) in which a branch passes through a place.
fn branch_direction<M: ContinuedMap>(closing: &Closing<M>, at: &Closed) -> Option<[f64; 3]> {
    let normals = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let directions = normals.into_iter().enumerate().filter_map(|(axis, normal)| {
        let direction = closing.scaled(&closing.tangent(at, normal)?);
        Some((direction[axis].abs(), direction))
    });
    // The best of these conditions is the one along which the direction is largest.
    directions.max_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, direction)| direction)
}
