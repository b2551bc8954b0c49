//! The equations of a closed sequence of flights and of their derivatives by one parameter. They ignore
//! earlier impacts that would end a flight, and so are smooth through a graze
//! (docs/numerics/dynamics.md, "Branches").

use core::f64::consts::{PI, TAU};

use glam::{DMat2, DVec2};

use crate::flight::platform::phase::Phase;
use crate::flight::platform::vibration::Vibration;
use crate::map::impact_map::{ImpactMap, ImpactState};
use crate::numerics::bordered_cyclic::{Border, CyclicEquations};
use crate::numerics::elementary::{cos, nearest_whole, sin, sin_cos};
use crate::numerics::error::Error;

/// Newton steps until a correction is given up.
const MAX_CORRECTIONS: u32 = 12;

/// A Newton step (scaled) after which one more reaches the rounding.
const NEARLY: f64 = 1.0e-8;

/// The share of the step before up to which a step is one of quadratic convergence, and the one from which on
/// it is rounding.
const FAST: f64 = 0.1;
const STILL: f64 = 0.9;

/// A Newton step that is rounding.
const ROUNDING: f64 = 1.0e-15;

/// The parameter in which an orbit is continued.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum ContinuationParameter {
    /// The axial forcing Gamma, above 0.
    Forcing,
    /// The coefficient of restitution, in (0, 1).
    Restitution,
}

impl ContinuationParameter {
    /// Its value for a map.
    #[must_use]
    pub fn of(self, map: &ImpactMap) -> f64 {
        match self {
            Self::Forcing => map.vibration().axial_forcing(),
            Self::Restitution => map.restitution(),
        }
    }

    /// The range in which a map exists, and in which an impact is followed by a flight.
    pub(crate) const fn legal(self) -> (f64, f64) {
        match self {
            Self::Forcing => (0.0, Vibration::MAX_PEAK_ACCELERATION / core::f64::consts::PI),
            Self::Restitution => (f64::MIN_POSITIVE, 1.0 - f64::EPSILON / 2.0),
        }
    }
}

/// Impacts (phase in rad, the disk's own speed after the impact in units of g/omega) and the parameter.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Closed {
    pub(crate) impacts: Vec<DVec2>,
    pub(crate) parameter: f64,
}

impl Closed {
    /// This much of a direction further.
    pub(crate) fn moved(&self, direction: &Self, by: f64) -> Self {
        let impacts = self.impacts.iter().zip(&direction.impacts).map(|(x, d)| *x + *d * by).collect();
        Self { impacts, parameter: self.parameter + by * direction.parameter }
    }
}

/// An angle less its whole turns, in [-pi, pi].
pub(crate) fn turned(angle: f64) -> f64 {
    angle - TAU * nearest_whole(angle / TAU)
}

/// The units in which changes of the first impact and of the parameter are measured.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Scale {
    pub(crate) speed: f64,
    pub(crate) parameter: f64,
}

/// The plane in which a correction looks for a point: at this distance from a base, across a direction
/// (scaled; phase, speed, parameter).
#[derive(Debug, Clone, Copy)]
pub(crate) struct Plane {
    pub(crate) normal: [f64; 3],
    pub(crate) base: [f64; 3],
    pub(crate) distance: f64,
}

/// A sequence of flights that closes, with the properties that are the same all along a branch.
#[derive(Debug, Clone)]
pub(crate) struct Closing {
    /// The map at the start of the branch: where the other parameters come from.
    pub(crate) map: ImpactMap,
    pub(crate) by: ContinuationParameter,
    pub(crate) scale: Scale,
    /// The turns of the phase that belong to each flight.
    turns: Vec<f64>,
}

impl Closing {
    /// The equations of an orbit of `map`, and the orbit in their unknowns.
    pub(crate) fn of(
        map: &ImpactMap,
        by: ContinuationParameter,
        states: &[ImpactState],
    ) -> Result<(Self, Closed), Error> {
        let (p, r) = (map.vibration().peak_acceleration(), map.restitution());
        let n = states.len();
        let impact = |state: &ImpactState| {
            DVec2::new(state.phase().angle(), p * state.phase().cos() - r * state.velocity())
        };
        let impacts: Vec<DVec2> = states.iter().map(impact).collect();
        let mut turns = Vec::with_capacity(n);
        for (i, &state) in states.iter().enumerate() {
            let between = impacts[(i + 1) % n].x - impacts[i].x;
            turns.push(nearest_whole((map.step(state)?.duration() - between) / TAU));
        }
        let parameter = by.of(map);
        let of_parameter = if by == ContinuationParameter::Forcing { parameter } else { 1.0 };
        let scale = Scale { speed: 1.0 + p, parameter: of_parameter };
        Ok((Self { map: *map, by, scale, turns }, Closed { impacts, parameter }))
    }

    /// The turns of the phase in each flight.
    pub(crate) fn turns(&self) -> &[f64] {
        &self.turns
    }

    /// The equations of the orbit gone through twice.
    pub(crate) fn twice(&self) -> Self {
        Self { turns: [self.turns.as_slice(), &self.turns].concat(), ..self.clone() }
    }

    /// The equations of the shorter orbit whose repetition both halves of this one are nearly, and the mean
    /// of both.
    pub(crate) fn half(&self, at: &Closed) -> (Self, Closed) {
        let n = self.turns.len() / 2;
        let (first, second) = at.impacts.split_at(n);
        let mean = |(a, b): (&DVec2, &DVec2)| DVec2::new(a.x + 0.5 * turned(b.x - a.x), 0.5 * (a.y + b.y));
        let impacts = first.iter().zip(second).map(mean).collect();
        let mut turns = self.turns[..n].to_vec();
        // The last flight of the first half ends on the first impact instead of on its copy.
        turns[n - 1] += nearest_whole((second[0].x - first[0].x) / TAU);
        (Self { turns, ..self.clone() }, Closed { impacts, parameter: at.parameter })
    }

    /// The number of flights.
    pub(crate) fn flights(&self) -> usize {
        self.turns.len()
    }

    /// Peak acceleration P and restitution.
    pub(crate) fn strengths(&self, parameter: f64) -> (f64, f64) {
        match self.by {
            ContinuationParameter::Forcing => (PI * parameter, self.map.restitution()),
            ContinuationParameter::Restitution => (self.map.vibration().peak_acceleration(), parameter),
        }
    }

    /// The map at this parameter, or at the nearest one for which there is a map.
    pub(crate) fn map_at(&self, parameter: f64) -> Result<ImpactMap, Error> {
        let (least, most) = self.by.legal();
        let parameter = parameter.clamp(least, most);
        match self.by {
            ContinuationParameter::Forcing => {
                ImpactMap::new(Vibration::from_axial_forcing(parameter)?, self.map.restitution())
            }
            ContinuationParameter::Restitution => ImpactMap::new(*self.map.vibration(), parameter),
        }
    }

    /// The duration of a flight.
    pub(crate) fn duration(&self, impacts: &[DVec2], i: usize) -> f64 {
        (impacts[(i + 1) % impacts.len()].x - impacts[i].x) + TAU * self.turns[i]
    }

    /// Relative velocities (disk minus platform) before and after each impact.
    pub(crate) fn velocities(&self, at: &Closed) -> Vec<(f64, f64)> {
        let n = at.impacts.len();
        let (p, r) = self.strengths(at.parameter);
        let one = |i: usize| {
            let before = (i + n - 1) % n;
            let platform = p * cos(at.impacts[i].x);
            let landing = at.impacts[before].y - self.duration(&at.impacts, before);
            // By the law: u - P cos tau would be a difference of large numbers where the restitution is
            // small.
            (landing - platform, r * (platform - landing))
        };
        (0..n).map(one).collect()
    }

    /// The impacts of a solution; `None` where one has no speed.
    pub(crate) fn states(&self, at: &Closed) -> Option<Vec<ImpactState>> {
        let one = |(impact, (arrival, _)): (&DVec2, (f64, f64))| {
            if arrival >= 0.0 {
                return None;
            }
            ImpactState::new(Phase::new(impact.x).ok()?, arrival).ok()
        };
        at.impacts.iter().zip(self.velocities(at)).map(one).collect()
    }

    /// First impact and parameter in units of the scale.
    pub(crate) fn scaled(&self, at: &Closed) -> [f64; 3] {
        let first = at.impacts[0];
        [first.x, first.y / self.scale.speed, at.parameter / self.scale.parameter]
    }

    /// How far the equations are from being satisfied, negative, and their derivatives; `None` where a flight
    /// has no duration.
    pub(crate) fn equations(&self, at: &Closed) -> Option<CyclicEquations> {
        let n = at.impacts.len();
        let (p, r) = self.strengths(at.parameter);
        let mut equations = CyclicEquations::default();
        for i in 0..n {
            let (from, to) = (at.impacts[i], at.impacts[(i + 1) % n]);
            let h = self.duration(&at.impacts, i);
            if !(h > 0.0 && h.is_finite()) {
                return None;
            }
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
            equations.column.push(match self.by {
                ContinuationParameter::Forcing => DVec2::new(-PI * slope, -(1.0 + r) * PI * c1),
                ContinuationParameter::Restitution => DVec2::new(0.0, landing - p * c1),
            });
        }
        Some(equations)
    }

    /// The border of a plane, for a step or a direction from `at`.
    fn border(&self, normal: [f64; 3], right: f64) -> Border {
        let [phase, speed, parameter] = normal;
        let first = DVec2::new(phase, speed / self.scale.speed);
        Border { first, parameter: parameter / self.scale.parameter, right }
    }

    /// The solution in a plane by Newton's method from a guess, and how many steps it took; `None` if it does
    /// not settle.
    pub(crate) fn corrected(&self, guess: Closed, plane: &Plane) -> Option<(Closed, u32)> {
        let mut at = guess;
        let mut last = f64::INFINITY;
        for step in 1..=MAX_CORRECTIONS {
            let equations = self.equations(&at)?;
            let here = self.scaled(&at);
            let along = (0..3).fold(0.0, |sum, k| sum + plane.normal[k] * (here[k] - plane.base[k]));
            let (steps, change) = equations.solve(self.border(plane.normal, plane.distance - along));
            let size = steps.iter().fold((change / self.scale.parameter).abs(), |most, step| {
                most.max(step.x.abs()).max((step.y / self.scale.speed).abs())
            });
            if !(size < 1.0e3 && steps.iter().all(|step| step.is_finite())) {
                return None;
            }
            at = at.moved(&Closed { impacts: steps, parameter: change }, 1.0);
            // Next to a singular point the steps shrink slowly, and a small one does not tell of a small
            // distance.
            let settled = size <= FAST * last || size > STILL * last && size <= NEARLY;
            if size <= ROUNDING || last <= NEARLY && settled {
                return Some((at, step));
            }
            last = size;
        }
        None
    }

    /// The direction of the branch, of scaled length 1 in first impact and parameter, on the side of
    /// `normal`.
    pub(crate) fn tangent(&self, at: &Closed, normal: [f64; 3]) -> Option<Closed> {
        let mut equations = self.equations(at)?;
        equations.right.fill(DVec2::ZERO);
        let (impacts, parameter) = equations.solve(self.border(normal, 1.0));
        self.normalised(Closed { impacts, parameter })
    }

    /// A direction with the scaled length 1 in first impact and parameter.
    pub(crate) fn normalised(&self, direction: Closed) -> Option<Closed> {
        let length = self.scaled(&direction).iter().fold(0.0, |sum, part| sum + part * part).sqrt();
        if !(length > 0.0 && length.is_finite()) {
            return None;
        }
        let Closed { impacts, parameter } = direction;
        let impacts: Vec<_> = impacts.into_iter().map(|part| part / length).collect();
        impacts
            .iter()
            .all(|part| part.is_finite())
            .then_some(Closed { impacts, parameter: parameter / length })
    }

    /// The direction in which the orbit flips where a multiplier is -1: the vector that returns with the
    /// opposite sign.
    pub(crate) fn flip_direction(&self, at: &Closed) -> Option<Vec<DVec2>> {
        let mut equations = self.equations(at)?;
        equations.right.fill(DVec2::ZERO);
        let last = equations.next.len() - 1;
        equations.next[last] = -equations.next[last];
        let size = |direction: &[DVec2]| {
            direction
                .iter()
                .fold(0.0_f64, |most, part| most.max(part.x.abs()).max((part.y / self.scale.speed).abs()))
        };
        // Of two conditions one at least is not blind for it.
        let directions = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]].map(|normal| {
            let (direction, _) = equations.solve(self.border(normal, 1.0));
            let longest = size(&direction);
            (longest.is_finite() && longest > 0.0).then_some((direction, longest))
        });
        let shorter = directions.into_iter().flatten().min_by(|a, b| a.1.total_cmp(&b.1));
        shorter.map(|(direction, _)| direction)
    }
}
