//! The points at which the bifurcation of a curve changes.

use super::surface::dot;
use super::walk::{CurveWalker, Located};
use super::{BifurcationKind, CurvePoint, SpecialKind, SpecialPoint};
use crate::numerics::error::Error;
use crate::orbits::closing::{Closed, Plane};
use crate::orbits::continuation::ContinuedMap;

/// The largest amplitude (scaled) of the doubled orbit from which its bend is computed, and how many times it is
/// halved. The bend is extrapolated to amplitude 0; the effect of rounding grows with the inverse cube of the
/// amplitude.
const AMPLITUDE: f64 = 1.6e-2;
const HALVINGS: usize = 8;

/// The error of the bend over the differences between extrapolated bends.
const SAFETY: f64 = 16.0;

/// The largest change of the parameters along a cusp, per arclength.
const STILL: f64 = 1.0e-5;

/// Rounding of the direction of a curve, from differences of its condition.
const DIRECTION_ROUNDING: f64 = 1.0e-8;

/// How near to 1, per impact, the determinant is where a curve ends at restitution 1.
const RESONANT: f64 = 1.0e-6;

/// A special point between two points of a curve.
pub(super) enum Special {
    None,
    Found(Box<SpecialPoint>),
    /// The points are too far apart to tell.
    Unclear,
}

impl<M: ContinuedMap> CurveWalker<'_, M> {
    /// The kinds that can be between two points.
    pub(super) fn special_kinds(&self) -> Vec<SpecialKind> {
        match self.kind {
            BifurcationKind::Fold => vec![SpecialKind::Cusp],
            BifurcationKind::Doubling => vec![SpecialKind::CriticalityChange],
            BifurcationKind::Graze { flight } => {
                vec![SpecialKind::GrazingFold { flight }, SpecialKind::GrazingDoubling { flight }]
            }
            _ => Vec::new(),
        }
    }

    /// The special point of this kind between two points.
    pub(super) fn special(
        &self,
        kind: SpecialKind,
        base: &Located,
        next: &Located,
    ) -> Result<Special, Error> {
        let step = next.arclength - base.arclength;
        let signs = (self.sign(kind, base, base), self.sign(kind, next, base));
        let (Some((first, at_first)), Some((last, at_last))) = signs else { return Ok(Special::None) };
        if step <= 0.0 || first == 0.0 || (first > 0.0) == (last > 0.0) {
            return Ok(Special::None);
        }
        let as_before = |located: &Located| {
            Ok(self.sign(kind, located, base).is_some_and(|(value, _)| value * first > 0.0))
        };
        let Some((last_before, beyond)) = self.change(base, next, as_before)? else {
            return Ok(Special::Unclear);
        };
        let Some((_, error)) = self.sign(kind, &last_before, base) else { return Ok(Special::None) };
        if kind == SpecialKind::Cusp && self.moves_on(&last_before).min(self.moves_on(&beyond)) > STILL {
            return Ok(Special::None);
        }
        // From the smaller slope and the largest error, because a single error may be small by chance.
        let part = last_before.arclength - base.arclength;
        let slope = (first.abs() / part).min(last.abs() / (step - part));
        let off = error.max(at_first).max(at_last) / slope;
        let point = self.point(&last_before);
        Ok(point.map_or(Special::None, |point| {
            let mut special = self.special_at(kind, point, &last_before, off);
            // The parameters are stationary at a cusp, so their second derivative counts.
            let bend = [0, 1].map(|k| next.direction.parameters[k] - base.direction.parameters[k]);
            for (own, bend) in special.point.errors.iter_mut().zip(bend) {
                *own += (bend / step).abs() * off * off;
            }
            Special::Found(Box::new(special))
        }))
    }

    /// A special point, which may be off by this arclength.
    pub(super) fn special_at(
        &self,
        kind: SpecialKind,
        point: CurvePoint,
        located: &Located,
        off: f64,
    ) -> SpecialPoint {
        let across = self.moves(located).map_or([f64::MAX; 2], |moves| moves.across);
        let errors = [0, 1].map(|k| across[k] + (located.direction.parameters[k] * off).abs());
        SpecialPoint { kind, point: CurvePoint { errors, ..point } }
    }

    /// The strong resonance at the end of a curve.
    pub(super) fn resonance(&self, last: &Located) -> Option<SpecialPoint> {
        let kind = match self.kind {
            BifurcationKind::Fold => SpecialKind::Resonance11,
            BifurcationKind::Doubling => SpecialKind::Resonance12,
            _ => return None,
        };
        let point = self.point(last)?;
        let is_one = (1.0 - point.determinant).abs() <= RESONANT * point.states.len() as f64;
        is_one.then(|| self.special_at(kind, point, last, 0.0))
    }

    /// The function that changes its sign at a special point, and its error.
    fn sign(&self, kind: SpecialKind, located: &Located, base: &Located) -> Option<(f64, f64)> {
        let of = |kind| {
            let value = self.surface.value(kind, &located.at, 0.0)?;
            Some((value.value, value.rounding))
        };
        match kind {
            SpecialKind::Cusp => {
                let [_, _, first, second] = self.surface.scaled(&located.direction);
                let along = dot(self.surface.scaled(&base.direction), [0.0, 0.0, first, second]);
                Some((along, DIRECTION_ROUNDING * self.moves_on(base)))
            }
            SpecialKind::CriticalityChange => self.criticality(located),
            SpecialKind::GrazingFold { .. } => of(BifurcationKind::Fold),
            SpecialKind::GrazingDoubling { .. } => of(BifurcationKind::Doubling),
            SpecialKind::Resonance11 | SpecialKind::Resonance12 => None,
        }
    }

    /// The change of the parameters (scaled) per arclength.
    fn moves_on(&self, located: &Located) -> f64 {
        let [_, _, first, second] = self.surface.scaled(&located.direction);
        first.abs().max(second.abs())
    }

    /// A number that is positive if the doubled orbit exists where the orbit is unstable, and its error.
    ///
    /// At the amplitude d the doubled orbit exists at the parameter p0 + b d^2; there 1 + T + D of the orbit itself has
    /// the sign of b d(1 + T + D)/dp. The sign is not decided if an impact has almost no speed.
    pub(super) fn criticality(&self, located: &Located) -> Option<(f64, f64)> {
        let surface = &self.surface;
        if self.slow_impact(located).is_some() {
            return None;
        }
        let [_, _, first, second] = surface.scaled(&located.direction);
        // In the parameter that is more across the curve.
        let vary = usize::from(second.abs() < first.abs());
        let (closing, closed) = surface.section(&located.at, vary)?;
        let n = closed.impacts.len();
        let flip = closing.flip_direction(&closed)?;
        let there_and_back: Vec<_> = flip.iter().copied().chain(flip.iter().map(|part| -*part)).collect();
        let twice = closing.twice();
        let direction = twice.normalised(Closed { impacts: there_and_back, parameter: 0.0 })?;
        let start = Closed {
            impacts: [closed.impacts.as_slice(), &closed.impacts].concat(),
            parameter: closed.parameter,
        };
        let (normal, base) = (twice.scaled(&direction), twice.scaled(&start));
        let scale = twice.scale.parameter;
        let moved = |distance: f64| {
            let plane = Plane { normal, base, distance };
            let (at, _) = twice.corrected(start.moved(&direction, distance), &plane)?;
            // The orbit itself, traversed twice, is also a solution.
            let apart = (at.impacts[0] - at.impacts[n]).length();
            let expected = 2.0 * (direction.impacts[0] * distance).length();
            (apart > 0.5 * expected).then_some((at.parameter - closed.parameter) / scale)
        };
        // The odd powers of the amplitude cancel.
        let bend = |d: f64| Some((moved(d)? + moved(-d)?) / (2.0 * d * d));
        let (exact, error) = extrapolated(bend)?;
        let mut normals = [[0.0; 4]; 2];
        (normals[0][2 + vary], normals[1][3 - vary]) = (1.0, 1.0);
        let [along, _] = surface.directions(&located.at, normals)?;
        let slope = surface.derivative(self.kind, &located.at, &along, 0.0)?;
        Some((-exact * slope, error * slope.abs()))
    }
}

/// The limit at 0 of an even function, and its error, by extrapolation from halved amplitudes (C. J. F. Ridders, Adv.
/// Eng. Softw. 4, 75 (1982)). Amplitudes at which the function is not known are left out.
fn extrapolated(function: impl Fn(f64) -> Option<f64>) -> Option<(f64, f64)> {
    let (mut best, mut row) = (None::<(f64, f64)>, Vec::<f64>::new());
    for halving in 0..HALVINGS {
        let Some(value) = function(AMPLITUDE / f64::from(1_u32 << halving)) else {
            row.clear();
            continue;
        };
        let mut next = vec![value];
        let mut power = 1.0;
        for (order, before) in row.iter().enumerate() {
            power *= 4.0;
            let better = (power * next[order] - before) / (power - 1.0);
            // Also the value of the same order from the previous amplitude: two numbers may agree by chance,
            // three hardly.
            let same = row.get(order + 1).copied().unwrap_or(f64::INFINITY);
            let apart = |other: f64| (better - other).abs();
            let error = SAFETY * apart(next[order]).max(apart(*before)).max(apart(same));
            if best.is_none_or(|(_, least)| error < least) {
                best = Some((better, error));
            }
            next.push(better);
        }
        row = next;
    }
    best
}
