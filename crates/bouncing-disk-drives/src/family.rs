//! Closed sequences of flights in a family of driven maps that differ in one or two numbers.

use core::f64::consts::TAU;
use core::fmt::{self, Debug, Formatter};
use std::sync::Arc;

use bouncing_disk_core::numerics::elementary::wrapped_angle;
use bouncing_disk_core::orbits::{ClosingMap, ContinuationParameter, ContinuedMap, PeriodicOrbit};
use bouncing_disk_core::parts::{Closed, CyclicEquations, Flight, SAME, Scale, finite, within};
use bouncing_disk_core::{Error, ImpactState, Phase};
use glam::{DMat2, DVec2};

use crate::drive::Drive;
use crate::driven_map::DrivenMap;

/// The step, in units of the number, of the finite differences that approximate the derivative of the
/// equations with respect to the number. Their error slows Newton's method but does not move the solution.
/// Near a point at which a force just touches zero, the map varies like a square root.
const DIFFERENCE: f64 = 1.0e-9;

/// Two changes whose ratio is above this do not belong to one curve.
const BROKEN: f64 = 10.0;

/// An impact closer to a joint than this distance (rad) counts as on the joint.
const ON_JOINT: f64 = 1.0e-9;

/// A jump of the acceleration below this share of its bound is ignored.
const JUMP: f64 = 1.0e-9;

/// Size above which a derivative counts as infinite.
const TORN: f64 = 1.0e7;

/// A family of driven maps that differ in one number: any parameter of the drive or of the contact, or the
/// forcing.
///
/// ```
/// use bouncing_disk_core::orbits::{BifurcationKind, Continuation, ContinuationParameter, ContinuedMap as _};
/// use bouncing_disk_core::{ImpactState, Phase, Unobserved};
/// use bouncing_disk_drives::{Drive, DrivenFamily, DrivenMap};
///
/// // A sine with a second harmonic, which grows.
/// let with = |second: f64| {
///     let drive = Drive::fourier(&[(1.45, 0.0), (second, 0.3)]).ok()?;
///     DrivenMap::new(drive, 0.5).ok()
/// };
/// let family = DrivenFamily::new(0.0, 1.0, with)?;
/// let orbit = family.map().refine(&[ImpactState::new(Phase::new(0.77)?, -4.19)?])?;
/// let settings = Continuation::new(ContinuationParameter::Number, (-1.0, 1.0), true)?;
/// let branch = family.continued(&orbit, &settings, &Unobserved)?;
/// assert!(branch.of_kind(BifurcationKind::Doubling).next().is_some());
/// # Ok::<(), bouncing_disk_core::Error>(())
/// ```
#[derive(Clone)]
pub struct DrivenFamily {
    map: DrivenMap,
    numbers: [f64; 2],
    units: [f64; 2],
    /// Whether the maps also differ in the second number.
    is_of_two: bool,
    maps: Arc<dyn Fn([f64; 2]) -> Option<DrivenMap> + Send + Sync>,
}

impl Debug for DrivenFamily {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.debug_struct("DrivenFamily")
            .field("map", &self.map)
            .field("numbers", &self.numbers)
            .field("units", &self.units)
            .finish_non_exhaustive()
    }
}

/// Two families are equal if their present maps, numbers and units are.
impl PartialEq for DrivenFamily {
    fn eq(&self, other: &Self) -> bool {
        (&self.map, self.numbers, self.units) == (&other.map, other.numbers, other.units)
    }
}

impl DrivenFamily {
    /// The family of maps over a number, whose present value is `number`; `maps` returns `None` if there is
    /// no map. In the arclength of a branch, a change of the number by `unit` > 0 counts as much as a radian.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if there is no map now, or for a unit that is not positive and finite.
    pub fn new(
        number: f64,
        unit: f64,
        maps: impl Fn(f64) -> Option<DrivenMap> + Send + Sync + 'static,
    ) -> Result<Self, Error> {
        let family = Self::of_two([number, 0.0], [unit, 1.0], move |[number, _]| maps(number))?;
        Ok(Self { is_of_two: false, ..family })
    }

    /// A family over two numbers, for curves of bifurcations in their plane
    /// ([`Branch::curve`](bouncing_disk_core::orbits::Branch::curve)).
    ///
    /// ```
    /// use bouncing_disk_core::orbits::{BifurcationKind, Continuation, ContinuationParameter, ContinuedMap as _};
    /// use bouncing_disk_core::{ImpactState, Phase, Unobserved};
    /// use bouncing_disk_drives::{Drive, DrivenFamily, DrivenMap};
    ///
    /// // Where the doubling is as amplitude and phase of a second harmonic vary.
    /// let with = |[second, phase]: [f64; 2]| {
    ///     DrivenMap::new(Drive::fourier(&[(1.45, 0.0), (second, phase)]).ok()?, 0.5).ok()
    /// };
    /// let family = DrivenFamily::of_two([0.0, 0.3], [1.0, 1.0], with)?;
    /// let orbit = family.map().refine(&[ImpactState::new(Phase::new(0.77)?, -4.19)?])?;
    /// let first = Continuation::new(ContinuationParameter::Number, (-1.0, 1.0), true)?;
    /// let branch = family.continued(&orbit, &first, &Unobserved)?;
    /// assert_eq!(branch.bifurcations[0].kind, BifurcationKind::Doubling);
    /// let second = Continuation::new(ContinuationParameter::SecondNumber, (0.3, 0.4), true)?;
    /// let curve = branch.curve(0, (-1.0, 1.0), &second, &Unobserved)?;
    /// assert!((curve.points.last().expect("some").parameters[1] - 0.4).abs() < 1e-12);
    /// # Ok::<(), bouncing_disk_core::Error>(())
    /// ```
    ///
    /// # Errors
    /// The errors of [`Self::new`], for either number.
    pub fn of_two(
        numbers: [f64; 2],
        units: [f64; 2],
        maps: impl Fn([f64; 2]) -> Option<DrivenMap> + Send + Sync + 'static,
    ) -> Result<Self, Error> {
        for unit in units {
            within("unit of a number", unit, f64::MIN_POSITIVE, f64::MAX, "(0, inf)")?;
        }
        let map = member(&maps, numbers)?;
        Ok(Self { map, numbers, units, is_of_two: true, maps: Arc::new(maps) })
    }

    /// The present map.
    #[must_use]
    pub const fn map(&self) -> &DrivenMap {
        &self.map
    }

    /// The same family with another unit.
    pub(crate) fn with_unit(self, unit: f64) -> Self {
        Self { units: [unit, self.units[1]], ..self }
    }

    /// The two numbers, with one of them replaced.
    fn numbers_with(&self, by: ContinuationParameter, value: f64) -> [f64; 2] {
        let [first, second] = self.numbers;
        if by == ContinuationParameter::SecondNumber { [first, value] } else { [value, second] }
    }

    /// The map with another value of a number.
    fn map_with(&self, by: ContinuationParameter, value: f64) -> Option<DrivenMap> {
        (self.maps)(self.numbers_with(by, value))
    }

    /// Residuals of a flight and of the impact after it, in the smooth equations.
    fn residual(map: &DrivenMap, from: DVec2, to: DVec2, h: f64) -> DVec2 {
        if map.compliant().is_some() {
            return released(map, from, to, h).map_or(DVec2::NAN, |(residual, _)| residual);
        }
        let r = map.restitution();
        let slope = mean_slope(map.drive(), from.x, to.x, h);
        let law = to.y + r * (from.y - h) - (1.0 + r) * map.drive().velocity(to.x);
        DVec2::new(from.y - 0.5 * h - slope, law)
    }

    /// The derivative of the residual with respect to the number, from the maps below, at and above its
    /// value. If the three residuals do not lie on one curve, as near a graze, the two closer ones are used.
    fn by_number(maps: &[(f64, DrivenMap)], from: DVec2, to: DVec2, h: f64) -> DVec2 {
        let mut steps = maps.windows(2).map(|pair| {
            let change = Self::residual(&pair[1].1, from, to, h) - Self::residual(&pair[0].1, from, to, h);
            (change, pair[1].0 - pair[0].0)
        });
        let (Some((below, low)), second) = (steps.next(), steps.next()) else { return DVec2::NAN };
        let Some((above, high)) = second else { return below / low };
        let [small, large] = [below.length(), above.length()];
        if large > BROKEN * small {
            below / low
        } else if small > BROKEN * large || !large.is_finite() {
            above / high
        } else {
            (below + above) / (low + high)
        }
    }
}

fn member(maps: &dyn Fn([f64; 2]) -> Option<DrivenMap>, numbers: [f64; 2]) -> Result<DrivenMap, Error> {
    for number in numbers {
        finite("number of a family", number)?;
    }
    let none = Error::OutOfRange { field: "number of a family", value: numbers[0], legal: "one with a map" };
    maps(numbers).ok_or(none)
}

/// The mean slope of the height over a flight between these phases.
fn mean_slope(drive: &Drive, from: f64, to: f64, h: f64) -> f64 {
    if drive.next_joint(from).is_some() {
        return (drive.height(to) - drive.height(from)) / h;
    }
    // So that a short flight keeps its accuracy.
    drive.velocity(from) + drive.change(from, h).1 / h
}

/// The distance by which the release after the one at `from` misses the one at `to`, and its derivative with
/// respect to `from`.
fn released(map: &DrivenMap, from: DVec2, to: DVec2, h: f64) -> Option<(DVec2, DMat2)> {
    let state = ImpactState::new(Phase::new(from.x).ok()?, from.y).ok()?;
    let (landing, derivative) = map.step_with_derivative(state).ok()?;
    Some((DVec2::new(h - landing.impact.duration(), to.y - landing.impact.velocity), derivative))
}

impl ClosingMap for DrivenFamily {
    const IS_QUADRATIC: bool = false;

    fn parameter(&self, by: ContinuationParameter) -> Option<f64> {
        match by {
            ContinuationParameter::Number => Some(self.numbers[0]),
            ContinuationParameter::SecondNumber if self.is_of_two => Some(self.numbers[1]),
            _ => None,
        }
    }

    fn with_parameter(&self, by: ContinuationParameter, value: f64) -> Result<Self, Error> {
        let numbers = self.numbers_with(by, value);
        Ok(Self { map: member(&*self.maps, numbers)?, numbers, ..self.clone() })
    }

    fn restitution(&self) -> f64 {
        self.map.restitution()
    }

    fn scale(&self, by: ContinuationParameter) -> Scale {
        let unit = self.units[usize::from(by == ContinuationParameter::SecondNumber)];
        Scale { speed: 1.0 + self.map.drive().bounds().speed, parameter: unit }
    }

    fn unknowns(&self, state: ImpactState) -> DVec2 {
        let phase = state.phase().angle();
        if self.map.compliant().is_some() {
            return DVec2::new(phase, state.velocity());
        }
        DVec2::new(phase, self.map.drive().velocity(phase) - self.map.restitution() * state.velocity())
    }

    fn time_to_next(&self, state: ImpactState) -> Result<f64, Error> {
        Ok(self.map.step(state)?.impact.duration())
    }

    fn equations(
        &self,
        by: ContinuationParameter,
        at: &Closed,
        durations: &[f64],
    ) -> Option<CyclicEquations> {
        let map = self.map_with(by, at.parameter)?;
        let (n, r, drive) = (at.impacts.len(), map.restitution(), map.drive());
        let unit = self.scale(by).parameter;
        let beside = |step: f64| {
            let number = at.parameter + step * unit;
            self.map_with(by, number).map(|map| (number, map))
        };
        let here = Some((at.parameter, map.clone()));
        let maps: Vec<_> = [beside(-DIFFERENCE), here, beside(DIFFERENCE)].into_iter().flatten().collect();
        let mut equations = CyclicEquations::default();
        for (i, &h) in durations.iter().enumerate() {
            let (from, to) = (at.impacts[i], at.impacts[(i + 1) % n]);
            equations.column.push(Self::by_number(&maps, from, to, h));
            if map.compliant().is_some() {
                let (residual, derivative) = released(&map, from, to, h)?;
                equations.right.push(-residual);
                equations.own.push(-derivative);
                equations.next.push(DMat2::IDENTITY);
                continue;
            }
            equations.right.push(-Self::residual(&map, from, to, h));
            let (start, end) = (drive.at(from.x), drive.at(to.x));
            let slope = mean_slope(drive, from.x, to.x, h);
            equations.own.push(DMat2::from_cols(
                DVec2::new(0.5 - (slope - start.velocity) / h, r),
                DVec2::new(1.0, r),
            ));
            equations.next.push(DMat2::from_cols(
                DVec2::new(-0.5 - (end.velocity - slope) / h, -(1.0 + r) * end.acceleration - r),
                DVec2::new(0.0, 1.0),
            ));
        }
        Some(equations)
    }

    fn velocities(&self, by: ContinuationParameter, at: &Closed, durations: &[f64]) -> Vec<(f64, f64)> {
        let n = at.impacts.len();
        // Where there is no map, there is no impact.
        let Some(map) = self.map_with(by, at.parameter) else { return vec![(0.0, 0.0); n] };
        let r = map.restitution();
        let one = |i: usize| {
            if map.compliant().is_some() {
                return (at.impacts[i].y, -r * at.impacts[i].y);
            }
            let before = (i + n - 1) % n;
            let arrival = at.impacts[before].y - durations[before] - map.drive().velocity(at.impacts[i].x);
            (arrival, -r * arrival)
        };
        (0..n).map(one).collect()
    }

    /// True if the force of a compliant contact just touches zero.
    fn is_torn_after(&self, state: ImpactState) -> bool {
        let is_infinite = |derivative: DMat2| {
            let most = derivative.x_axis.abs().max_element().max(derivative.y_axis.abs().max_element());
            most.is_nan() || most > TORN
        };
        self.map.compliant().is_some()
            && self.map.step_with_derivative(state).is_ok_and(|(_, derivative)| is_infinite(derivative))
    }
}

impl ContinuedMap for DrivenFamily {
    const WORK: u64 = 32;

    fn check_orbit(&self, orbit: &PeriodicOrbit) -> Result<(), Error> {
        self.map.check_orbit(orbit)
    }

    /// Whether the first impact occurs earlier.
    fn is_grazed(&self, flight: &Flight) -> Result<bool, Error> {
        Ok(self.duration_found(flight)? < flight.duration - ON_JOINT)
    }

    fn gap(&self, flight: &Flight, after: f64) -> Option<[f64; 3]> {
        // A compliant contact has no flights of its own.
        if self.map.compliant().is_some() {
            return None;
        }
        let (drive, (phase, speed)) = (self.map.drive(), flight.from);
        let (start, there) = (drive.at(phase), drive.at(phase + after));
        let gap = speed * after
            - 0.5 * after * after
            - (mean_slope(drive, phase, phase + after, after) - start.velocity) * after;
        Some([gap, speed + start.velocity - after - there.velocity, -1.0 - there.acceleration])
    }

    fn duration_found(&self, flight: &Flight) -> Result<f64, Error> {
        // For these contacts the equations are the map's own.
        if self.map.compliant().is_some() {
            return Ok(flight.duration);
        }
        let (time, speed) = (wrapped_angle(flight.from.0), flight.from.1);
        Ok(self.map.drive().first_impact_from(time, 0.0, speed)?.impact.duration())
    }

    fn orbit_through(
        &self,
        states: Vec<ImpactState>,
        durations: &[f64],
    ) -> Option<(PeriodicOrbit, [f64; 2])> {
        let (n, r) = (states.len() as i32, self.map.restitution());
        let mut orbit = self.map.orbit_through(states).ok()?;
        if orbit.platform_periods != (durations.iter().sum::<f64>() / TAU).round() as u64 {
            return None;
        }
        if orbit.position_error.is_nan() || orbit.position_error > 0.5 * SAME {
            (orbit.position_error, orbit.trace_error) = (0.5 * SAME, f64::MAX);
        }
        let determinant = if self.map.compliant().is_none() {
            (0..n).fold(1.0, |product, _| product * (r * r))
        } else {
            orbit.determinant()
        };
        let trace = orbit.monodromy.x_axis.x + orbit.monodromy.y_axis.y;
        Some((orbit, [trace, determinant]))
    }

    fn has_joint_between(&self, from: f64, to: f64) -> bool {
        let drive = self.map.drive();
        let (low, high) = (from.min(to) - ON_JOINT, from.max(to) + ON_JOINT);
        let Some(joint) = drive.next_joint(low) else { return false };
        let before = wrapped_angle(joint.time - ON_JOINT);
        let jump = (drive.acceleration(joint.time) - drive.acceleration(before)).abs();
        joint.after <= high - low
            && (jump > JUMP * (1.0 + drive.bounds().acceleration) || joint.velocity_jump != 0.0)
    }

    fn is_on_kink(&self, phase: f64) -> bool {
        let kink = self.map.drive().next_kink(phase - ON_JOINT);
        kink.is_some_and(|kink| kink.after <= 2.0 * ON_JOINT)
    }
}
