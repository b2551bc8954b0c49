//! The closed sequences of flights above a sine.

use core::f64::consts::PI;

use glam::{DMat2, DVec2};

use super::{Closed, ClosingMap, ContinuationParameter, Scale};
use crate::flight::platform::vibration::Vibration;
use crate::map::impact_map::{ImpactMap, ImpactState};
use crate::numerics::bordered_cyclic::CyclicEquations;
use crate::numerics::elementary::{cos, sin, sin_cos};
use crate::numerics::error::{Error, within};

/// Peak acceleration P and restitution of a map with this parameter, which may be none.
fn strengths(map: &ImpactMap, by: ContinuationParameter, parameter: f64) -> (f64, f64) {
    match by {
        ContinuationParameter::Forcing => (PI * parameter, map.restitution()),
        ContinuationParameter::Restitution => (map.vibration().peak_acceleration(), parameter),
        ContinuationParameter::Number | ContinuationParameter::SecondNumber => (f64::NAN, f64::NAN),
    }
}

impl ClosingMap for ImpactMap {
    fn parameter(&self, by: ContinuationParameter) -> Option<f64> {
        match by {
            ContinuationParameter::Forcing => Some(self.vibration().axial_forcing()),
            ContinuationParameter::Restitution => Some(self.restitution()),
            ContinuationParameter::Number | ContinuationParameter::SecondNumber => None,
        }
    }

    fn with_parameter(&self, by: ContinuationParameter, value: f64) -> Result<Self, Error> {
        match by {
            ContinuationParameter::Forcing => {
                Self::new(Vibration::from_axial_forcing(value)?, self.restitution())
            }
            ContinuationParameter::Restitution => Self::new(*self.vibration(), value),
            ContinuationParameter::Number | ContinuationParameter::SecondNumber => {
                within("number of a family", value, f64::NAN, f64::NAN, "a number of a `DrivenFamily`")?;
                Ok(*self)
            }
        }
    }

    fn restitution(&self) -> f64 {
        Self::restitution(self)
    }

    fn scale(&self, by: ContinuationParameter) -> Scale {
        let forcing = self.vibration().axial_forcing();
        let parameter = if by == ContinuationParameter::Forcing { forcing } else { 1.0 };
        Scale { speed: 1.0 + self.vibration().peak_acceleration(), parameter }
    }

    fn unknowns(&self, state: ImpactState) -> DVec2 {
        let p = self.vibration().peak_acceleration();
        DVec2::new(state.phase().angle(), p * state.phase().cos() - self.restitution() * state.velocity())
    }

    fn time_to_next(&self, state: ImpactState) -> Result<f64, Error> {
        Ok(self.step(state)?.duration())
    }

    fn equations(
        &self,
        by: ContinuationParameter,
        at: &Closed,
        durations: &[f64],
    ) -> Option<CyclicEquations> {
        let n = at.impacts.len();
        let (p, r) = strengths(self, by, at.parameter);
        let mut equations = CyclicEquations::default();
        for (i, &h) in durations.iter().enumerate() {
            let (from, to) = (at.impacts[i], at.impacts[(i + 1) % n]);
            let (_, c) = sin_cos(from.x);
            let (s1, c1) = sin_cos(to.x);
            // The mean slope of the platform's height over the flight, per P.
            let slope = sin_cos(from.x + 0.5 * h).1 * (sin(0.5 * h) / (0.5 * h));
            let landing = from.y - h;
            let flight = from.y - 0.5 * h - p * slope;
            let law = to.y + r * landing - (1.0 + r) * p * c1;
            equations.right.push(DVec2::new(-flight, -law));
            equations
                .own
                .push(DMat2::from_cols(DVec2::new(0.5 - p * (slope - c) / h, r), DVec2::new(1.0, r)));
            equations.next.push(DMat2::from_cols(
                DVec2::new(-0.5 - p * (c1 - slope) / h, (1.0 + r) * p * s1 - r),
                DVec2::new(0.0, 1.0),
            ));
            equations.column.push(match by {
                ContinuationParameter::Forcing => DVec2::new(-PI * slope, -(1.0 + r) * PI * c1),
                ContinuationParameter::Restitution => DVec2::new(0.0, landing - p * c1),
                ContinuationParameter::Number | ContinuationParameter::SecondNumber => DVec2::NAN,
            });
        }
        Some(equations)
    }

    fn velocities(&self, by: ContinuationParameter, at: &Closed, durations: &[f64]) -> Vec<(f64, f64)> {
        let n = at.impacts.len();
        let (p, r) = strengths(self, by, at.parameter);
        let one = |i: usize| {
            let before = (i + n - 1) % n;
            let platform = p * cos(at.impacts[i].x);
            let landing = at.impacts[before].y - durations[before];
            // By the law: u - P cos tau would be a difference of large numbers if the restitution is small.
            (landing - platform, r * (platform - landing))
        };
        (0..n).map(one).collect()
    }
}
