//! Orbits near a fold of a drive's map: whether they exist, how many there are, and where they are
//! (docs/numerics-impacts.md, "Periodic orbits").
//!
//! The end of an iteration proves an orbit only away from folds. An orbit counts as near a fold if |1 - T +
//! D| is below 1e-4 of the size of the derivative, or if the trace changes by more than half of 1 - T + D
//! within twice the error (where the acceleration jumps). Then a curve decides: all sequences of flights that
//! close if the end of the last flight is pushed along the weak direction. This curve is followed to |t| =
//! 7e-4, t the displacement of the first impact along the weak direction. The sign of the derivative of the
//! push brackets the extremes of the push, including corners at which the acceleration jumps. The sign of the
//! push is certain beyond four times the response to 1e-14 in each flight. An extreme within rounding is one
//! marginal orbit, whose errors reach to the certain points on both sides. An orbit that repeats a shorter
//! one within 0.1 rad is near the doubling at which it is born, not near a fold. Its errors include rounding
//! errors with opposite signs in both halves, the direction in which it is weak. If the curve cannot be
//! followed, the orbit counts as marginal.

use core::f64::consts::TAU;

use bouncing_disk_core::ImpactState;
use bouncing_disk_core::orbits::PeriodicOrbit;
use bouncing_disk_core::parts::{Border, CyclicEquations, Shooting, moved, phase_difference, speed_scale};
use glam::{DMat2, DVec2};

use super::MAP_ROUNDING;
use crate::driven_map::DrivenMap;

/// The steps along the curve to either side: the first step, the growth factor, and the number of steps,
/// which reach about 1e-3 rad. Orbits farther apart are found one by one.
const FIRST: f64 = 1.0e-8;
const GROWTH: f64 = 4.0;
const STEPS: usize = 9;

/// Newton's method for a point of the curve: the largest number of steps, the step at which a point counts as
/// found, and the step below which steps that no longer shrink are rounding.
const MOST_CORRECTIONS: usize = 20;
const ROUNDING: f64 = 4.0 * f64::EPSILON;
const NEARLY: f64 = 1.0e-8;

/// Largest number of steps to a zero or an extreme of the push.
const MOST_STEPS: usize = 100;

/// Ratio of a push to its rounding error above which its sign is certain.
const CERTAIN: f64 = 4.0;

/// The curve of all sequences of flights that close if the end of the last flight is pushed along the weak
/// direction, the direction that a period of the orbit changes least.
///
/// The orbits are the zeros of the push. Unlike their equations, the equations of the curve are also regular
/// at a fold.
struct Curve<'m> {
    map: &'m DrivenMap,
    base: ImpactState,
    weak: DVec2,
    scale: f64,
}

/// A point of the curve.
#[derive(Debug, Clone)]
struct Point {
    /// The displacement of the first impact along the weak direction.
    at: f64,
    states: Vec<ImpactState>,
    push: f64,
    /// The derivative of the push along the curve.
    slope: f64,
    shooting: (DMat2, u64),
}

/// The orbits at and near an approximate one.
pub(super) enum Beside {
    /// The orbits that exist, or may exist within rounding, nearest first.
    Orbits(Vec<PeriodicOrbit>),
    /// The push is within rounding of zero everywhere: the orbit is a member of a family.
    Family,
}

impl DrivenMap {
    /// The orbits at and near an approximate one at a fold; `None` if the curve cannot be followed to both
    /// sides until the sign of the push is certain.
    pub(super) fn orbits_beside(&self, orbit: &PeriodicOrbit) -> Option<Beside> {
        let curve = Curve::new(self, orbit)?;
        let middle = curve.point(0.0, &orbit.states)?;
        let (rounding, floor) = curve.rounding(&middle)?;
        let points = curve.followed(middle);
        if points.iter().all(|point| point.push.abs() <= rounding) {
            return Some(Beside::Family);
        }
        // The points whose push is certain, with the extremes of the push between them.
        let mut certain: Vec<&Point> = Vec::new();
        let mut extremes = Vec::new();
        for (index, point) in points.iter().enumerate() {
            if point.push.abs() > rounding {
                certain.push(point);
            }
            if let Some(next) = points.get(index + 1)
                && (point.slope < 0.0) != (next.slope < 0.0)
            {
                extremes.push(curve.extreme(point, next));
            }
        }
        // Beyond an end with an uncertain push there may be more.
        let (first, last) = (certain.first()?, certain.last()?);
        if !(first.at < 0.0 && 0.0 < last.at) {
            return None;
        }
        let mut found = Vec::new();
        for pair in certain.windows(2) {
            let inside = |extreme: &&Point| pair[0].at <= extreme.at && extreme.at <= pair[1].at;
            let own: Vec<&Point> = extremes.iter().filter(inside).collect();
            if let Some(touching) = own.iter().find(|extreme| extreme.push.abs() <= rounding) {
                found.push(curve.orbit(touching, [Some(pair[0].clone()), Some(pair[1].clone())], floor));
                continue;
            }
            let ends: Vec<&Point> = [&[pair[0]], &own[..], &[pair[1]]].concat();
            for ends in ends.windows(2).filter(|ends| (ends[0].push < 0.0) != (ends[1].push < 0.0)) {
                let zero = curve.zero(ends[0], ends[1]);
                let room = rounding / zero.slope.abs();
                let sides = [-room, room].map(|by| curve.point(zero.at + by, &zero.states));
                found.push(curve.orbit(&zero, sides, floor));
            }
        }
        found.sort_by(|(one, _), (other, _)| one.abs().total_cmp(&other.abs()));
        Some(Beside::Orbits(found.into_iter().map(|(_, orbit)| orbit).collect()))
    }
}

impl<'m> Curve<'m> {
    fn new(map: &'m DrivenMap, orbit: &PeriodicOrbit) -> Option<Self> {
        let scale = speed_scale(&orbit.states);
        let DMat2 { x_axis, y_axis } = orbit.monodromy - DMat2::IDENTITY;
        // The rows of the derivative minus 1, velocities in units of the scale; the larger row is more
        // accurate.
        let rows = [DVec2::new(x_axis.x, y_axis.x * scale), DVec2::new(x_axis.y / scale, y_axis.y)];
        let row = if rows[0].dot(rows[0]) > rows[1].dot(rows[1]) { rows[0] } else { rows[1] };
        let length = row.dot(row).sqrt();
        let weak = DVec2::new(row.y / length, -row.x / length * scale);
        weak.is_finite().then_some(Self { map, base: orbit.states[0], weak, scale })
    }

    /// The coefficients of the condition on the first impact.
    fn first(&self) -> DVec2 {
        DVec2::new(self.weak.x, self.weak.y / (self.scale * self.scale))
    }

    /// The equations of a step from these impacts.
    fn equations(&self, shooting: Shooting) -> CyclicEquations {
        let n = shooting.derivatives.len();
        let mut column = vec![DVec2::ZERO; n];
        column[n - 1] = self.weak;
        CyclicEquations {
            own: shooting.derivatives,
            next: vec![-DMat2::IDENTITY; n],
            column,
            right: shooting.right,
        }
    }

    /// The point at this displacement, from impacts nearby.
    fn point(&self, at: f64, guess: &[ImpactState]) -> Option<Point> {
        let (mut states, mut push, mut last) = (guess.to_vec(), 0.0, f64::INFINITY);
        for _ in 0..MOST_CORRECTIONS {
            let shooting = self.map.shoot(&states).ok()?;
            let own = (shooting.monodromy, shooting.turns);
            let mut equations = self.equations(shooting);
            let n = states.len();
            equations.right[n - 1] -= self.weak * push;
            let phase = phase_difference(states[0].phase().angle(), self.base.phase().angle());
            let here = self.first().dot(DVec2::new(phase, states[0].velocity() - self.base.velocity()));
            let border = Border { first: self.first(), parameter: 0.0, right: at - here };
            let (steps, change) = equations.solve(border);
            let size = steps
                .iter()
                .fold(change.abs(), |most, step| most.max(step.x.abs()).max(step.y.abs() / self.scale));
            if !size.is_finite() || !steps.iter().all(|step| step.is_finite()) {
                return None;
            }
            states = moved(&states, &steps)?;
            push += change;
            if size <= ROUNDING || last <= NEARLY && size >= 0.5 * last {
                equations.right.fill(DVec2::ZERO);
                let (_, slope) = equations.solve(Border { right: 1.0, ..border });
                return slope.is_finite().then_some(Point { at, states, push, slope, shooting: own });
            }
            last = size;
        }
        None
    }

    /// The smallest push with a certain sign, and how far the rounding of each flight displaces the impacts
    /// across the weak direction.
    fn rounding(&self, point: &Point) -> Option<(f64, f64)> {
        let equations = self.equations(self.map.shoot(&point.states).ok()?);
        let room = MAP_ROUNDING * self.scale;
        let (mut push, mut floor) = (0.0, ROUNDING * TAU);
        for signs in [DVec2::new(room, room), DVec2::new(room, -room)] {
            let pushed = CyclicEquations { right: vec![signs; point.states.len()], ..equations.clone() };
            let (steps, own) = pushed.solve(Border { first: self.first(), parameter: 0.0, right: 0.0 });
            push += own.abs();
            floor = steps.iter().fold(floor, |most, step| most.max(step.x.abs()).max(step.y.abs()));
        }
        (push.is_finite() && floor.is_finite()).then_some((CERTAIN * push, floor))
    }

    /// The curve through a point, followed to both sides as far as possible.
    fn followed(&self, middle: Point) -> Vec<Point> {
        let mut points = vec![middle];
        for side in [-1.0, 1.0] {
            points.reverse();
            let mut step = FIRST;
            for _ in 0..STEPS {
                let Some(next) = self.point(side * step, &points[points.len() - 1].states) else { break };
                points.push(next);
                step *= GROWTH;
            }
        }
        points
    }

    /// The extreme of the push between two points with slopes of different signs. The slope may jump there.
    fn extreme(&self, low: &Point, high: &Point) -> Point {
        let (mut low, mut high) = (low.clone(), high.clone());
        for _ in 0..MOST_STEPS {
            let at = low.at + 0.5 * (high.at - low.at);
            if high.at - low.at <= ROUNDING * TAU {
                break;
            }
            let Some(middle) = self.point(at, &low.states) else { break };
            if (middle.slope < 0.0) == (low.slope < 0.0) { low = middle } else { high = middle }
        }
        if low.push.abs() <= high.push.abs() { low } else { high }
    }

    /// The zero of the push between two points with pushes of different signs, by Newton steps, or by
    /// bisection if these leave the interval.
    fn zero(&self, low: &Point, high: &Point) -> Point {
        let (mut low, mut high) = (low.clone(), high.clone());
        let nearer =
            |low: &Point, high: &Point| if low.push.abs() <= high.push.abs() { low.at } else { high.at };
        for _ in 0..MOST_STEPS {
            let best = if low.push.abs() <= high.push.abs() { &low } else { &high };
            let newton = best.at - best.push / best.slope;
            let is_inside = low.at < newton && newton < high.at;
            let at = if is_inside { newton } else { low.at + 0.5 * (high.at - low.at) };
            if (at - nearer(&low, &high)).abs() <= ROUNDING {
                break;
            }
            let Some(next) = self.point(at, &best.states) else { break };
            if (next.push < 0.0) == (low.push < 0.0) { low = next } else { high = next }
        }
        if low.push.abs() <= high.push.abs() { low } else { high }
    }

    /// The orbit at a point, and its displacement; the orbit lies between these two sides.
    fn orbit(&self, point: &Point, sides: [Option<Point>; 2], floor: f64) -> (f64, PeriodicOrbit) {
        let trace = |point: &Point| point.shooting.0.x_axis.x + point.shooting.0.y_axis.y;
        let own = trace(point);
        let (mut position_error, mut trace_error) = (floor, MAP_ROUNDING * own.abs());
        for side in sides {
            let Some(side) = side else {
                // If the orbit is this close to its end, the multipliers are meaningless.
                trace_error = f64::MAX;
                continue;
            };
            for (there, here) in side.states.iter().zip(&point.states) {
                let phase = phase_difference(there.phase().angle(), here.phase().angle()).abs();
                position_error = position_error.max(phase).max((there.velocity() - here.velocity()).abs());
            }
            trace_error = trace_error.max((trace(&side) - own).abs());
        }
        let (monodromy, platform_periods) = point.shooting;
        let states = point.states.clone();
        (point.at, PeriodicOrbit { states, platform_periods, monodromy, position_error, trace_error })
    }
}
