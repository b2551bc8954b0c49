//! The closed sequences of flights over two parameters: a surface in the space of impacts and parameters.

use glam::{DMat2, DVec2};

use crate::numerics::bordered_cyclic::{Condition, CyclicEquations};
use crate::orbits::closing::{Closed, Closing, ClosingMap, ContinuationParameter, settled};

/// Impacts in the unknowns of their map, and two parameters.
#[derive(Debug, Clone)]
pub(super) struct Place {
    pub(super) impacts: Vec<DVec2>,
    pub(super) parameters: [f64; 2],
}

impl Place {
    /// This place moved by `by` times a direction.
    pub(super) fn moved(&self, direction: &Self, by: f64) -> Self {
        let impacts = self.impacts.iter().zip(&direction.impacts).map(|(x, d)| *x + *d * by).collect();
        let [first, second] = self.parameters;
        let [along_first, along_second] = direction.parameters;
        Self { impacts, parameters: [first + by * along_first, second + by * along_second] }
    }

    /// The combination of two directions.
    fn combined(a: (f64, &Self), b: (f64, &Self)) -> Self {
        Self::moved(&Self::moved(&Self::zero(a.1.impacts.len()), a.1, a.0), b.1, b.0)
    }

    fn zero(impacts: usize) -> Self {
        Self { impacts: vec![DVec2::ZERO; impacts], parameters: [0.0; 2] }
    }
}

/// First impact and parameters in the units of the arclength: phase, speed, first and second parameter.
pub(super) type Scaled = [f64; 4];

pub(super) fn dot(a: Scaled, b: Scaled) -> f64 {
    (0..4).fold(0.0, |sum, k| sum + a[k] * b[k])
}

pub(super) fn less(a: Scaled, b: Scaled) -> Scaled {
    core::array::from_fn(|k| a[k] - b[k])
}

/// The closed sequences of flights of one branch, over the parameter of the branch and a second one.
#[derive(Debug, Clone)]
pub(super) struct Surface<M> {
    pub(super) closing: Closing<M>,
    pub(super) parameters: [ContinuationParameter; 2],
    /// The units of speed, of the first and of the second parameter.
    pub(super) scales: [f64; 3],
}

/// The equations at a place and the column of the second parameter.
struct Linear {
    equations: CyclicEquations,
    second: Vec<DVec2>,
}

impl<M: ClosingMap> Surface<M> {
    /// The equations in one of the two parameters, with the other one as it is at a place.
    pub(super) fn section(&self, at: &Place, vary: usize) -> Option<(Closing<M>, Closed)> {
        let fixed = self.parameters[1 - vary];
        let (least, most) = fixed.legal();
        let value = at.parameters[1 - vary];
        if !(least..=most).contains(&value) {
            return None;
        }
        let map = self.closing.map.with_parameter(fixed, value).ok()?;
        let closing = self.closing.beside(map, self.parameters[vary], self.scales[1 + vary]);
        Some((closing, Closed { impacts: at.impacts.clone(), parameter: at.parameters[vary] }))
    }

    pub(super) fn scaled(&self, at: &Place) -> Scaled {
        let (first, [speed, one, other]) = (at.impacts[0], self.scales);
        [first.x, first.y / speed, at.parameters[0] / one, at.parameters[1] / other]
    }

    /// The largest distance of impacts and parameters (scaled).
    pub(super) fn distance(&self, a: &Place, b: &Place) -> f64 {
        self.largest(&a.moved(b, -1.0))
    }

    /// The largest part of a direction (scaled).
    pub(super) fn largest(&self, direction: &Place) -> f64 {
        let [speed, one, other] = self.scales;
        let [first, second] = direction.parameters;
        let parameters = (first / one).abs().max((second / other).abs());
        let impacts = direction.impacts.iter();
        impacts.fold(parameters, |most, part| most.max(part.x.abs()).max((part.y / speed).abs()))
    }

    /// The matrix around the sequence in the unknowns of the map: it has the multipliers of the orbit.
    pub(super) fn around(&self, at: &Place) -> Option<DMat2> {
        let (closing, closed) = self.section(at, 0)?;
        let equations = closing.equations(&closed)?;
        let steps = equations.own.iter().zip(&equations.next);
        let around = steps.fold(DMat2::IDENTITY, |before, (own, next)| -(next.inverse() * *own) * before);
        around.is_finite().then_some(around)
    }

    fn linear(&self, at: &Place) -> Option<Linear> {
        let (closing, closed) = self.section(at, 0)?;
        let equations = closing.equations(&closed)?;
        let (closing, closed) = self.section(at, 1)?;
        Some(Linear { equations, second: closing.equations(&closed)?.column })
    }

    /// The change with these components along two normals (scaled) that satisfies the equations.
    fn change(&self, linear: &Linear, normals: [Scaled; 2], right: [f64; 2]) -> Option<Place> {
        let [speed, one, other] = self.scales;
        let conditions = [0, 1].map(|k| {
            let [phase, own_speed, first, second] = normals[k];
            let parameters = [first / one, second / other];
            Condition { first: DVec2::new(phase, own_speed / speed), parameters, right: right[k] }
        });
        let (impacts, parameters) = linear.equations.solve_two(&linear.second, conditions);
        let change = Place { impacts, parameters };
        self.largest(&change).is_finite().then_some(change)
    }

    /// The place of the surface at these distances from a base along two normals, by Newton's method from a guess,
    /// and the number of steps.
    pub(super) fn corrected(
        &self,
        guess: Place,
        base: Scaled,
        normals: [Scaled; 2],
        distances: [f64; 2],
    ) -> Option<(Place, u32)> {
        let mut at = guess;
        let steps = settled::<M>(|| {
            let moved = less(self.scaled(&at), base);
            let right = [0, 1].map(|k| distances[k] - dot(normals[k], moved));
            let change = self.change(&self.linear(&at)?, normals, right)?;
            let size = self.largest(&change);
            at = at.moved(&change, 1.0);
            (size < 1.0e3).then_some(size)
        })?;
        Some((at, steps))
    }

    /// The two directions of the surface that have the component 1 along one of two normals and 0 along the other.
    pub(super) fn directions(&self, at: &Place, normals: [Scaled; 2]) -> Option<[Place; 2]> {
        let mut linear = self.linear(at)?;
        linear.equations.right.fill(DVec2::ZERO);
        Some([self.change(&linear, normals, [1.0, 0.0])?, self.change(&linear, normals, [0.0, 1.0])?])
    }

    /// The combination of two directions that has the scaled length 1 in first impact and parameters.
    pub(super) fn normalised(&self, a: (f64, &Place), b: (f64, &Place)) -> Option<Place> {
        let direction = Place::combined(a, b);
        let own = self.scaled(&direction);
        let length = dot(own, own).sqrt();
        let unit = Place::zero(direction.impacts.len()).moved(&direction, 1.0 / length);
        (length > 0.0 && self.largest(&unit).is_finite()).then_some(unit)
    }

    /// How a residual of `size` in each equation moves the solution with no component along the normals: one change
    /// for each equation.
    pub(super) fn moved_by_rounding(
        &self,
        at: &Place,
        normals: [Scaled; 2],
        size: f64,
    ) -> Option<Vec<Place>> {
        let mut linear = self.linear(at)?;
        let count = linear.equations.right.len();
        let mut changes = Vec::with_capacity(2 * count);
        for index in 0..count {
            for unit in [DVec2::X, DVec2::Y] {
                linear.equations.right.fill(DVec2::ZERO);
                linear.equations.right[index] = unit * size;
                changes.push(self.change(&linear, normals, [0.0; 2])?);
            }
        }
        Some(changes)
    }
}
