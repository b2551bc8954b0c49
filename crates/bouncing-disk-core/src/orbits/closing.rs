//! The equations of a closed sequence of flights and their derivatives with respect to one parameter. With rigid
//! impacts they ignore earlier impacts that would end a flight, and so are smooth through a graze
//! (docs/numerics-dynamics.md, "Branches").

use core::f64::consts::TAU;
use core::fmt::Debug;

use glam::DVec2;

use crate::flight::platform::phase::Phase;
use crate::flight::platform::vibration::Vibration;
use crate::map::impact_map::ImpactState;
use crate::numerics::bordered_cyclic::{Border, CyclicEquations};
use crate::numerics::elementary::nearest_whole;
use crate::numerics::error::Error;

mod sine;

/// Newton steps after which a correction is given up.
const MAX_CORRECTIONS: u32 = 12;

/// The size (scaled) of a Newton step after which one more step reaches rounding.
const NEARLY: f64 = 1.0e-8;

/// The size of a step relative to the previous one: up to the first value convergence is quadratic, above the
/// second the step is rounding.
const FAST: f64 = 0.1;
const STILL: f64 = 0.9;

/// The size of a Newton step that is pure rounding.
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
    /// The number of a family of maps, such as `bouncing_disk_drives::DrivenFamily`.
    Number,
    /// The second number of a family over two numbers, as in `bouncing_disk_drives::DrivenFamily::of_two`.
    SecondNumber,
}

impl ContinuationParameter {
    /// The range in which a map exists and an impact is followed by a flight.
    pub(crate) const fn legal(self) -> (f64, f64) {
        match self {
            Self::Forcing => (0.0, Vibration::MAX_PEAK_ACCELERATION / core::f64::consts::PI),
            Self::Restitution => (f64::MIN_POSITIVE, 1.0 - f64::EPSILON / 2.0),
            Self::Number | Self::SecondNumber => (f64::MIN, f64::MAX),
        }
    }
}

/// The equations of the closed sequences of flights on a map.
pub trait ClosingMap: Clone + Debug {
    /// Whether Newton's method converges quadratically: the derivatives are exact.
    #[doc(hidden)]
    const IS_QUADRATIC: bool = true;

    /// The map's value of a parameter; `None` if it has no such parameter.
    fn parameter(&self, by: ContinuationParameter) -> Option<f64>;

    /// The map with another value of a parameter.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a value without a map.
    fn with_parameter(&self, by: ContinuationParameter, value: f64) -> Result<Self, Error>;

    /// Coefficient of restitution, in [0, 1).
    fn restitution(&self) -> f64;

    /// The units of the arclength.
    #[doc(hidden)]
    fn scale(&self, by: ContinuationParameter) -> Scale;

    /// The unknowns of an impact.
    #[doc(hidden)]
    fn unknowns(&self, state: ImpactState) -> DVec2;

    /// The time (rad) from an impact to the next.
    #[doc(hidden)]
    fn time_to_next(&self, state: ImpactState) -> Result<f64, Error>;

    /// The negative residuals of the equations, and their derivatives.
    #[doc(hidden)]
    fn equations(&self, by: ContinuationParameter, at: &Closed, durations: &[f64])
    -> Option<CyclicEquations>;

    /// Relative velocities (disk minus platform) before and after each impact.
    #[doc(hidden)]
    fn velocities(&self, by: ContinuationParameter, at: &Closed, durations: &[f64]) -> Vec<(f64, f64)>;

    /// Whether the derivative at the next impact is infinite.
    #[doc(hidden)]
    fn is_torn_after(&self, _state: ImpactState) -> bool {
        false
    }
}

/// Impacts and the parameter. An impact is a phase (rad) and a speed (units of g/omega): with rigid impacts the
/// disk's own speed after the impact, otherwise its velocity before the impact.
#[derive(Debug, Clone, PartialEq)]
pub struct Closed {
    /// The impacts.
    pub impacts: Vec<DVec2>,
    /// The parameter.
    pub parameter: f64,
}

impl Closed {
    /// This solution moved by `by` times a direction.
    pub(crate) fn moved(&self, direction: &Self, by: f64) -> Self {
        let impacts = self.impacts.iter().zip(&direction.impacts).map(|(x, d)| *x + *d * by).collect();
        Self { impacts, parameter: self.parameter + by * direction.parameter }
    }
}

/// An angle minus its whole turns, in [-pi, pi].
pub(crate) fn turned(angle: f64) -> f64 {
    angle - TAU * nearest_whole(angle / TAU)
}

/// The units in which changes of the first impact and of the parameter are measured.
#[derive(Debug, Clone, Copy)]
pub struct Scale {
    /// The unit of the speed.
    pub speed: f64,
    /// The unit of the parameter.
    pub parameter: f64,
}

/// A flight from one impact to the next: phase (rad) and relative velocity (g/omega) at either end, and its
/// duration (rad).
#[derive(Debug, Clone, Copy)]
pub struct Flight {
    /// The state just after the first impact.
    pub from: (f64, f64),
    /// The state just before the second impact.
    pub to: (f64, f64),
    /// The time between the two impacts.
    pub duration: f64,
}

/// The plane in which a correction looks for a point: normal to a direction, at this distance from a base
/// (scaled; phase, speed, parameter).
#[derive(Debug, Clone, Copy)]
pub(crate) struct Plane {
    pub(crate) normal: [f64; 3],
    pub(crate) base: [f64; 3],
    pub(crate) distance: f64,
}

/// The number of Newton steps until they are pure rounding; `None` if they do not settle. `step` makes one step
/// and returns its size.
pub(crate) fn settled<M: ClosingMap>(mut step: impl FnMut() -> Option<f64>) -> Option<u32> {
    let mut last = f64::INFINITY;
    for steps in 1..=MAX_CORRECTIONS {
        let size = step()?;
        // Near a singular point the steps shrink slowly, and a small step does not imply a small distance.
        let settled = M::IS_QUADRATIC && size <= FAST * last || size > STILL * last && size <= NEARLY;
        if size <= ROUNDING || last <= NEARLY && settled {
            return Some(steps);
        }
        last = size;
    }
    None
}

/// A sequence of flights that closes, with the properties that are the same all along a branch.
#[derive(Debug, Clone)]
pub(crate) struct Closing<M> {
    /// The map at the start of the branch, which supplies the other parameters.
    pub(crate) map: M,
    pub(crate) by: ContinuationParameter,
    pub(crate) scale: Scale,
    /// The turns of the phase that belong to each flight.
    turns: Vec<f64>,
}

impl<M: ClosingMap> Closing<M> {
    /// The equations that an orbit of `map` satisfies, and the orbit as a solution of them.
    pub(crate) fn of(
        map: &M,
        by: ContinuationParameter,
        states: &[ImpactState],
    ) -> Result<(Self, Closed), Error> {
        let durations = states.iter().map(|&state| map.time_to_next(state)).collect::<Result<Vec<_>, _>>()?;
        Ok(Self::with_durations(map, by, states, &durations))
    }

    /// The same if the durations of the flights are known, at least to within a radian.
    pub(crate) fn with_durations(
        map: &M,
        by: ContinuationParameter,
        states: &[ImpactState],
        durations: &[f64],
    ) -> (Self, Closed) {
        let n = states.len();
        let impacts: Vec<DVec2> = states.iter().map(|state| map.unknowns(*state)).collect();
        let turns = durations.iter().enumerate().map(|(i, duration)| {
            let between = impacts[(i + 1) % n].x - impacts[i].x;
            nearest_whole((duration - between) / TAU)
        });
        let turns = turns.collect();
        let parameter = map.parameter(by).unwrap_or(f64::NAN);
        (Self { map: map.clone(), by, scale: map.scale(by), turns }, Closed { impacts, parameter })
    }

    /// The equations of the same flights on another map, in another parameter.
    pub(crate) fn beside(&self, map: M, by: ContinuationParameter, parameter_scale: f64) -> Self {
        let scale = Scale { parameter: parameter_scale, ..self.scale };
        Self { map, by, scale, turns: self.turns.clone() }
    }

    /// The turns of the phase in each flight.
    pub(crate) fn turns(&self) -> &[f64] {
        &self.turns
    }

    /// The equations of the orbit traversed twice.
    pub(crate) fn twice(&self) -> Self {
        Self { turns: [self.turns.as_slice(), &self.turns].concat(), ..self.clone() }
    }

    /// The equations of the shorter orbit that each half of this one nearly is, and the mean of the two
    /// halves.
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

    /// The map at this parameter, or at the nearest one for which there is a map.
    pub(crate) fn map_at(&self, parameter: f64) -> Result<M, Error> {
        let (least, most) = self.by.legal();
        self.map.with_parameter(self.by, parameter.clamp(least, most))
    }

    /// The duration of a flight.
    pub(crate) fn duration(&self, impacts: &[DVec2], i: usize) -> f64 {
        (impacts[(i + 1) % impacts.len()].x - impacts[i].x) + TAU * self.turns[i]
    }

    fn durations(&self, impacts: &[DVec2]) -> Vec<f64> {
        (0..impacts.len()).map(|i| self.duration(impacts, i)).collect()
    }

    /// The flights of a solution; if it is not an orbit, the velocities may have any sign.
    pub(crate) fn flights_of(&self, at: &Closed) -> Vec<Flight> {
        let (n, durations) = (at.impacts.len(), self.durations(&at.impacts));
        let velocities = self.map.velocities(self.by, at, &durations);
        let one = |i: usize| {
            let to = (i + 1) % n;
            Flight {
                from: (at.impacts[i].x, velocities[i].1),
                to: (at.impacts[to].x, velocities[to].0),
                duration: durations[i],
            }
        };
        (0..n).map(one).collect()
    }

    /// The impacts of a solution; `None` if an impact has no speed.
    pub(crate) fn states(&self, at: &Closed) -> Option<Vec<ImpactState>> {
        let velocities = self.map.velocities(self.by, at, &self.durations(&at.impacts));
        let one = |(impact, (arrival, _)): (&DVec2, (f64, f64))| {
            if arrival >= 0.0 {
                return None;
            }
            ImpactState::new(Phase::new(impact.x).ok()?, arrival).ok()
        };
        at.impacts.iter().zip(velocities).map(one).collect()
    }

    /// The impact at which the derivative of the map is infinite.
    pub(crate) fn impact_lost(&self, at: &Closed) -> Option<usize> {
        let (map, states) = (self.map_at(at.parameter).ok()?, self.states(at)?);
        let flight = states.iter().position(|state| map.is_torn_after(*state))?;
        Some((flight + 1) % states.len())
    }

    /// First impact and parameter in units of the scale.
    pub(crate) fn scaled(&self, at: &Closed) -> [f64; 3] {
        let first = at.impacts[0];
        [first.x, first.y / self.scale.speed, at.parameter / self.scale.parameter]
    }

    /// The negative residuals of the equations, and their derivatives; `None` if a flight has no duration.
    pub(crate) fn equations(&self, at: &Closed) -> Option<CyclicEquations> {
        let durations = self.durations(&at.impacts);
        if !durations.iter().all(|duration| *duration > 0.0 && duration.is_finite()) {
            return None;
        }
        self.map.equations(self.by, at, &durations)
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
        let steps = settled::<M>(|| {
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
            Some(size)
        })?;
        Some((at, steps))
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

    /// The direction in which the orbit flips if a multiplier is -1: the vector that returns with the
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
        // At least one of these two conditions determines the direction.
        let directions = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]].map(|normal| {
            let (direction, _) = equations.solve(self.border(normal, 1.0));
            let longest = size(&direction);
            (longest.is_finite() && longest > 0.0).then_some((direction, longest))
        });
        let shorter = directions.into_iter().flatten().min_by(|a, b| a.1.total_cmp(&b.1));
        shorter.map(|(direction, _)| direction)
    }
}
