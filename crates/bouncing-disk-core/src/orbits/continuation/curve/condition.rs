//! The conditions of a fold, a doubling and a graze.

use super::BifurcationKind;
use super::surface::{Place, Surface};
use crate::orbits::closing::Flight;
use crate::orbits::continuation::ContinuedMap;

/// Newton steps to the minimum of a gap.
const MAX_STEPS: u32 = 30;

/// Samples of the gap in a radian, to find its smallest minimum.
const SAMPLES: f64 = 64.0;

/// The step (scaled) of the differences that tell how a condition changes along a direction.
const DIFFERENCE: f64 = 1.0e-5;

/// The step of a one-sided difference, and of a difference near a jump, relative to [`DIFFERENCE`].
const ONE_SIDED: f64 = 1.0e-3;

/// Roundings of a condition, in units of its terms.
const ROUNDINGS: f64 = 8.0;

/// The value of a condition, with its error by rounding.
#[derive(Debug, Clone, Copy)]
pub(super) struct Value {
    pub(super) value: f64,
    pub(super) rounding: f64,
    /// The time (rad) from the launch to the minimum of the gap; 0 if there is none.
    pub(super) after: f64,
}

impl<M: ContinuedMap> Surface<M> {
    /// The function that vanishes at a bifurcation of this kind. `after` is the time of the minimum at a place nearby.
    pub(super) fn value(&self, kind: BifurcationKind, at: &Place, after: f64) -> Option<Value> {
        if let BifurcationKind::Graze { flight } = kind {
            let (closing, closed) = self.section(at, 0)?;
            let map = closing.map_at(closed.parameter).ok()?;
            return lowest(&map, closing.flights_of(&closed).get(flight)?, after);
        }
        let around = self.around(at)?;
        let (trace, determinant) = (around.x_axis.x + around.y_axis.y, around.determinant());
        let size = 1.0 + around.x_axis.length() + around.y_axis.length();
        let rounding = ROUNDINGS * f64::EPSILON * size * at.impacts.len() as f64;
        let trace = if kind == BifurcationKind::Fold { -trace } else { trace };
        Some(Value { value: 1.0 + trace + determinant, rounding, after: 0.0 })
    }

    /// The change of this function along a direction.
    pub(super) fn derivative(
        &self,
        kind: BifurcationKind,
        at: &Place,
        direction: &Place,
        after: f64,
    ) -> Option<f64> {
        let mut step = DIFFERENCE / self.largest(direction);
        if self.joint_between(&at.moved(direction, -step), &at.moved(direction, step)).is_some() {
            step *= ONE_SIDED;
        }
        let value = |by: f64| Some(self.value(kind, &at.moved(direction, by), after)?.value);
        let derivative = match (value(step), value(-step)) {
            (Some(after), Some(before)) => (after - before) / (2.0 * step),
            // Near the end of a parameter's range there are maps on only one side.
            _ => {
                let step = ONE_SIDED * step;
                let here = value(0.0)?;
                value(step).map_or_else(
                    || Some((here - value(-step)?) / step),
                    |after| Some((after - here) / step),
                )?
            }
        };
        derivative.is_finite().then_some(derivative)
    }

    /// The first impact between whose two phases the acceleration of the platform jumps.
    pub(super) fn joint_between(&self, one: &Place, other: &Place) -> Option<usize> {
        let (closing, closed) = self.section(one, 0)?;
        let map = closing.map_at(closed.parameter).ok()?;
        let mut phases = one.impacts.iter().zip(&other.impacts);
        phases.position(|(one, other)| map.has_joint_between(one.x, other.x))
    }

    /// When a flight comes nearest to the platform on its way.
    pub(super) fn nearest(&self, flight: usize, at: &Place) -> Option<f64> {
        let (closing, closed) = self.section(at, 0)?;
        let map = closing.map_at(closed.parameter).ok()?;
        let flight = *closing.flights_of(&closed).get(flight)?;
        let samples = (SAMPLES * (1.0 + flight.duration)) as u32;
        let mut nearest: Option<Value> = None;
        let mut falls = false;
        for sample in 1..samples {
            let after = flight.duration * f64::from(sample) / f64::from(samples);
            let [_, rate, _] = map.gap(&flight, after)?;
            if falls
                && rate >= 0.0
                && let Some(low) = lowest(&map, &flight, after)
                && nearest.is_none_or(|near| low.value < near.value)
            {
                nearest = Some(low);
            }
            falls = rate < 0.0;
        }
        nearest.map(|low| low.after)
    }
}

/// The minimum of the gap of a flight near a time after its launch.
fn lowest<M: ContinuedMap>(map: &M, flight: &Flight, near: f64) -> Option<Value> {
    let (mut after, mut last) = (near, f64::INFINITY);
    for _ in 0..MAX_STEPS {
        let [_, rate, second] = map.gap(flight, after)?;
        let step = -rate / second;
        if !(second > 0.0 && step.is_finite()) {
            return None;
        }
        after += step;
        // The gap is stationary there: half the digits are enough.
        if step.abs() <= 1.0e-9 || step.abs() >= last && step.abs() <= 1.0e-6 {
            let within = 0.0 < after && after < flight.duration;
            let [value, ..] = map.gap(flight, after)?;
            let terms = flight.from.1.abs() * after + after * after;
            let rounding = ROUNDINGS * f64::EPSILON * (1.0 + terms);
            return within.then_some(Value { value, rounding, after });
        }
        last = step.abs();
    }
    None
}
