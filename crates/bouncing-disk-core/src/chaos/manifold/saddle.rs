//! An impact of a saddle, with its multipliers and eigendirections.

use glam::{DMat2, DVec2};

use super::{ManifoldKind, of_saddle};
use crate::map::impact_map::{ImpactMap, ImpactState};
use crate::numerics::error::Error;
use crate::orbits::periodic::{Multipliers, PeriodicOrbit};

/// One impact of a saddle.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Saddle {
    pub(crate) state: ImpactState,
    /// Flights around the orbit.
    pub(crate) flights: usize,
    pub(crate) unstable: f64,
    pub(crate) stable: f64,
    /// The derivative around the orbit.
    derivative: DMat2,
    /// One unit of the velocity in units of 1 + P.
    pub(crate) per_velocity: f64,
}

impl Saddle {
    /// The impact number `impact` of an orbit of `map`.
    pub(crate) fn of(map: &ImpactMap, orbit: &PeriodicOrbit, impact: usize) -> Result<Self, Error> {
        map.check_orbit(orbit)?;
        let n = orbit.period();
        let state = orbit.states[impact % n];
        let mut derivative = DMat2::IDENTITY;
        for i in 0..n {
            let (_, own) = map.step_with_derivative(orbit.states[(impact + i) % n])?;
            derivative = own * derivative;
        }
        // The speeds cancel around the orbit: r^(2 n) exactly.
        let r = map.restitution();
        let determinant = (0..n).fold(1.0, |product, _| product * (r * r));
        let trace = derivative.x_axis.x + derivative.y_axis.y;
        let (unstable, stable) = of_saddle(Multipliers::of_invariants(trace, determinant))?;
        let per_velocity = 1.0 / (1.0 + map.vibration().peak_acceleration());
        Ok(Self { state, flights: n, unstable, stable, derivative, per_velocity })
    }

    /// The multiplier of a manifold.
    pub(crate) const fn multiplier(&self, kind: ManifoldKind) -> f64 {
        match kind {
            ManifoldKind::Stable => self.stable,
            ManifoldKind::Unstable => self.unstable,
        }
    }

    /// The direction (phase, velocity) of a manifold at the saddle, of length 1 in the units of manifolds,
    /// pointing to later phases.
    pub(crate) fn direction(&self, kind: ManifoldKind) -> DVec2 {
        let DMat2 { x_axis, y_axis } = self.derivative;
        let multiplier = self.multiplier(kind);
        // The row of the matrix that does not vanish.
        let by_first = DVec2::new(y_axis.x, multiplier - x_axis.x);
        let by_second = DVec2::new(multiplier - y_axis.y, x_axis.y);
        let length = |direction: DVec2| {
            let scaled = DVec2::new(direction.x, direction.y * self.per_velocity);
            scaled.dot(scaled).sqrt()
        };
        let direction = if length(by_first) > length(by_second) { by_first } else { by_second };
        let direction = direction / length(direction);
        let later = direction.x > 0.0 || (direction.x == 0.0 && direction.y > 0.0);
        if later { direction } else { -direction }
    }

    /// The coordinates of a displacement (phase, velocity) from the saddle, along the unstable and the stable
    /// direction.
    pub(crate) fn coordinates(&self, displacement: DVec2) -> DVec2 {
        let columns =
            DMat2::from_cols(self.direction(ManifoldKind::Unstable), self.direction(ManifoldKind::Stable));
        columns.inverse() * displacement
    }
}
