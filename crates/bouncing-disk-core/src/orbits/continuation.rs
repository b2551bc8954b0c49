//! Branches of periodic orbits in a parameter: through folds and along unstable parts, with the bifurcations
//! on the way (docs/numerics-dynamics.md, "Branches").
//!
//! The mean slope of the sine is computed as cos(tau + h/2) sin(h/2)/(h/2), without cancellation, and for
//! other drives by `Drive::change`. Two branches of the equations meet at a birth: there the parameter is a
//! constant plus c d^2, with the distance d between the halves of the orbit, and is determined only to eps/d.
//! For d <= 1e-6 it differs from the constant, its value at the birth, by at most c 1e-12. An orbit on
//! another drive ends where the map finds an earlier first impact. On parabolas all orbits of two impacts
//! exist only at the forcing of the doubling, so a branch whose parameter is constant within 1e-11 over an
//! arclength of 1e-3 to either side has no fold: rounding alone turns it back.
//!
//! At a doubling, one component of the first impact of the flipping vector phi is set to 1: the one for which
//! the vector is shorter. In doubles the map misses the dip v^2 of an impact with a speed v below the root of
//! the rounding, so a branch stops up to about 1e-8 of the parameter before an impact vanishes.

use core::ops::ControlFlow;

use crate::map::impact_map::{ImpactMap, ImpactState};
use crate::numerics::error::{Error, finite, within};
use crate::numerics::stored::read_checked;
use crate::orbits::cascade::MAX_DOUBLINGS;
use crate::orbits::closing::{Closing, ClosingMap, ContinuationParameter, Flight};
use crate::orbits::periodic::{Multipliers, PeriodicOrbit, Stability, phase_difference};
use crate::run::{Observer, Progress, Watch};

pub(super) mod curve;
mod sine;
pub(super) mod walker;

use walker::Walker;

/// Largest relative difference of a map's forcing from the one that it was made from: the roundings of a
/// product and a quotient with pi.
const ROUNDED: f64 = 4.0 * f64::EPSILON;

/// The settings of a continuation: parameter, range and resolution.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedContinuation"))]
pub struct Continuation {
    parameter: ContinuationParameter,
    low: f64,
    high: f64,
    rising: bool,
    first_step: f64,
    largest_step: f64,
    max_points: usize,
}

read_checked!(Continuation as UncheckedContinuation {
    parameter: ContinuationParameter,
    low: f64,
    high: f64,
    rising: bool,
    first_step: f64,
    largest_step: f64,
    max_points: usize,
});

impl Continuation {
    /// The largest number of points of a branch.
    pub const MAX_POINTS: usize = 1_000_000;

    /// A continuation in `parameter` between `low` < `high`. It starts towards higher values if `rising`,
    /// otherwise towards lower ones.
    ///
    /// The arclength is measured in the first impact and the parameter. Its units are a radian, a speed of
    /// 1 + P, and the forcing at the start (for the restitution: 1). The first step is 0.01, the largest
    /// 0.05, and there are at most 10,000 points: see [`Self::with_steps`].
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if the range is empty or exceeds the parameter's range.
    pub fn new(
        parameter: ContinuationParameter,
        (low, high): (f64, f64),
        rising: bool,
    ) -> Result<Self, Error> {
        let settings =
            Self { parameter, low, high, rising, first_step: 0.01, largest_step: 0.05, max_points: 10_000 };
        settings.check().map(|()| settings)
    }

    /// The same continuation with another first step and largest step (arclength, in [1e-9, 1]), and at most
    /// `max_points` in [2, 1e6].
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for any of these numbers, and for a first step above the largest.
    pub fn with_steps(self, first_step: f64, largest_step: f64, max_points: usize) -> Result<Self, Error> {
        let settings = Self { first_step, largest_step, max_points, ..self };
        settings.check().map(|()| settings)
    }

    /// Checks a value that was deserialised.
    pub(super) fn check(&self) -> Result<(), Error> {
        let (least, most) = self.parameter.legal();
        within(
            "low end of a continuation",
            self.low,
            least,
            most,
            "within the legal range of the parameter",
        )?;
        within(
            "high end of a continuation",
            self.high,
            self.low.next_up(),
            most,
            "(low end, largest legal value of the parameter]",
        )?;
        within("largest step", self.largest_step, 1.0e-9, 1.0, "[1e-9, 1]")?;
        within("first step", self.first_step, 1.0e-9, self.largest_step, "[1e-9, largest step]")?;
        within("points of a branch", self.max_points as f64, 2.0, Self::MAX_POINTS as f64, "[2, 1000000]")?;
        Ok(())
    }

    /// Checks that the map is within the range, and that its restitution is not 0.
    pub(super) fn check_map<M: ContinuedMap>(&self, map: &M) -> Result<(), Error> {
        within("restitution of a continuation", map.restitution(), f64::MIN_POSITIVE, 1.0, "(0, 1)")?;
        let (what, index, count) = ("parameter of a continuation", self.parameter as usize, 3);
        let expected = "a parameter of this map";
        let Some(parameter) = map.parameter(self.parameter) else {
            return Err(Error::NotOfKind { what, index, count, expected });
        };
        // The forcing of a map, P/pi, is rounded: a map made for an end of the range may lie just outside.
        let rounding = ROUNDED * parameter.abs();
        if parameter < self.low - rounding || parameter > self.high + rounding || parameter.is_nan() {
            within(what, parameter, self.low, self.high, "[low, high] of the `Continuation`")?;
        }
        Ok(())
    }

    /// The parameter.
    #[must_use]
    pub const fn parameter(&self) -> ContinuationParameter {
        self.parameter
    }

    /// The range of the parameter, low and high end.
    #[must_use]
    pub const fn range(&self) -> (f64, f64) {
        (self.low, self.high)
    }

    /// The largest number of points.
    #[must_use]
    pub const fn max_points(&self) -> usize {
        self.max_points
    }
}

/// A map whose periodic orbits can be continued in a parameter. The parameters of [`ImpactMap`] are its
/// forcing and its restitution; that of `bouncing_disk_drives::DrivenFamily` is its number.
pub trait ContinuedMap: ClosingMap {
    /// The work of a flight, in units of a flight above a sine.
    #[doc(hidden)]
    const WORK: u64 = 1;

    /// Checks that `orbit` is an orbit of this map: that each of its impacts leads to the next one.
    ///
    /// # Errors
    /// [`Error::NotAnOrbit`] and other errors of [`ImpactMap::check_orbit`](crate::ImpactMap::check_orbit).
    fn check_orbit(&self, orbit: &PeriodicOrbit) -> Result<(), Error>;

    /// Whether the platform meets the disk between two impacts.
    #[doc(hidden)]
    fn is_grazed(&self, flight: &Flight) -> Result<bool, Error>;

    /// The gap of a flight at a time (rad) after its launch, and its first two derivatives; `None` if flights are not
    /// known, as with compliant contacts.
    #[doc(hidden)]
    fn gap(&self, _flight: &Flight, _after: f64) -> Option<[f64; 3]> {
        None
    }

    /// The duration that this map finds for a flight.
    #[doc(hidden)]
    fn duration_found(&self, flight: &Flight) -> Result<f64, Error>;

    /// The orbit with these impacts, and the trace and determinant of the derivative around it.
    #[doc(hidden)]
    fn orbit_through(&self, states: Vec<ImpactState>, durations: &[f64])
    -> Option<(PeriodicOrbit, [f64; 2])>;

    /// Whether the acceleration of the platform jumps between two phases (rad), or within rounding of them.
    #[doc(hidden)]
    fn has_joint_between(&self, _from: f64, _to: f64) -> bool {
        false
    }

    /// Whether the velocity of the platform jumps at this phase.
    #[doc(hidden)]
    fn is_on_kink(&self, _phase: f64) -> bool {
        false
    }

    /// The branch of periodic orbits through `orbit`, an orbit of this map, by continuation in the
    /// pseudo-arclength: through folds, and along unstable parts, until it ends
    /// ([`BranchEnd`]).
    ///
    /// Doublings, folds and the end of the orbit are located to within rounding. Two bifurcations of one kind
    /// within one step are missed: see [`Continuation::with_steps`].
    ///
    /// The items of `observer` are the allowed points.
    ///
    /// ```
    /// # use bouncing_disk_core::orbits::{BifurcationKind, Continuation, ContinuationParameter, ContinuedMap as _};
    /// # use bouncing_disk_core::{ImpactMap, Unobserved, Vibration};
    /// let map = ImpactMap::new(Vibration::from_axial_forcing(0.45)?, 0.5)?;
    /// let orbit = map.refine(&[map.period_one(1).expect("it exists")])?;
    /// let rising = Continuation::new(ContinuationParameter::Forcing, (0.1, 0.6), true)?;
    /// let branch = map.continued(&orbit, &rising, &Unobserved)?;
    /// let doubling = branch.of_kind(BifurcationKind::Doubling).next().expect("the first doubling");
    /// assert!((doubling.point.parameter - ImpactMap::first_doubling_forcing(0.5)).abs() < 1e-14);
    /// # Ok::<(), bouncing_disk_core::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if the parameter of this map is outside the range, or the restitution is 0;
    /// [`Error::NotOfKind`] if it has no such parameter; [`Error::NotAnOrbit`] if `orbit` is not an orbit of
    /// this map; [`Error::NoBranch`] if it is not isolated: start near a fold or a birth, not on it.
    fn continued(
        &self,
        orbit: &PeriodicOrbit,
        settings: &Continuation,
        observer: &dyn Observer,
    ) -> Result<Branch<Self>, Error> {
        settings.check()?;
        orbit.check()?;
        settings.check_map(self)?;
        self.check_orbit(orbit)?;
        self.continued_from(orbit, settings, observer)
    }

    /// The first `count` period doublings (`count` in [1, [`MAX_DOUBLINGS`]]) from `orbit` on: the first on
    /// its branch, the second on the branch that begins there, and so on. There are fewer if a branch ends
    /// before it doubles.
    ///
    /// The items of `observer` are the doublings.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for the count; the errors of [`Self::continued`] and [`Branch::switched`].
    fn doublings(
        &self,
        orbit: &PeriodicOrbit,
        settings: &Continuation,
        count: usize,
        observer: &dyn Observer,
    ) -> Result<Vec<LocatedDoubling>, Error> {
        within("count", count as f64, 1.0, MAX_DOUBLINGS as f64, "[1, 13]")?;
        let watch = Watch::begin(observer, 0, count as u64)?;
        let asked = |_: Progress| {
            if watch.ask().is_ok() { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
        };
        let of_all = |error| match error {
            Error::Stopped { .. } => {
                let Progress { done, total } = watch.progress();
                Error::Stopped { done, total }
            }
            other => other,
        };
        let mut branch = self.continued(orbit, settings, &asked).map_err(of_all)?;
        let mut found = Vec::new();
        while let Some((index, doubling)) = branch.first_doubling() {
            found.push(doubling);
            watch.finish(1);
            if found.len() == count {
                break;
            }
            branch = branch.switched(index, settings, &asked).map_err(of_all)?;
        }
        watch.end();
        Ok(found)
    }

    /// [`Self::continued`] from an orbit of this map or of a neighbouring map.
    ///
    /// # Errors
    /// Errors of [`Self::continued`] except [`Error::NotAnOrbit`].
    // The explorer draws branches with it.
    #[doc(hidden)]
    fn continued_from(
        &self,
        orbit: &PeriodicOrbit,
        settings: &Continuation,
        observer: &dyn Observer,
    ) -> Result<Branch<Self>, Error> {
        walker::continued_from(self, orbit, settings, observer)
    }
}

/// A periodic orbit on a branch.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedPoint"))]
pub struct BranchPoint {
    /// The value of the varied parameter.
    pub parameter: f64,
    /// The orbit, an exact orbit of the map: no earlier impact ends a flight.
    pub orbit: PeriodicOrbit,
    /// The trace of the derivative around the orbit.
    pub trace: f64,
    /// The determinant of this derivative, in [-1, 1]; for n rigid impacts r^(2 n).
    pub determinant: f64,
    /// The arclength from the start of the branch (see [`Continuation::new`]).
    pub arclength: f64,
}

read_checked!(BranchPoint as UncheckedPoint {
    parameter: f64,
    orbit: PeriodicOrbit,
    trace: f64,
    determinant: f64,
    arclength: f64,
});

impl BranchPoint {
    /// Checks a value that was deserialised.
    fn check(&self) -> Result<(), Error> {
        finite("parameter of a branch", self.parameter)?;
        finite("trace", self.trace)?;
        within("determinant", self.determinant, -1.0, 1.0, "[-1, 1]")?;
        within("arclength", self.arclength, 0.0, f64::MAX, "[0, inf)")?;
        Ok(())
    }

    /// The Floquet multipliers.
    #[must_use]
    pub fn multipliers(&self) -> Multipliers {
        Multipliers::of_invariants(self.trace, self.determinant)
    }

    /// (1 + m1)(1 + m2) of the multipliers.
    pub fn flip_function(&self) -> f64 {
        1.0 + self.trace + self.determinant
    }

    /// Whether the orbit attracts beyond any rounding error ([`Stability::Stable`]).
    #[must_use]
    pub fn is_stable(&self) -> bool {
        self.orbit.stability() == Stability::Stable
    }
}

/// The kind of a special point of a branch.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum BifurcationKind {
    /// A multiplier is -1: a branch of twice the period begins here ([`Branch::switched`]).
    Doubling,
    /// A multiplier is 1, and the branch turns back in the parameter.
    Fold,
    /// A flight touches the platform before its impact: beyond this point an earlier impact prevents it.
    Graze {
        /// The index of the impact before the flight.
        flight: usize,
    },
    /// The speed of an impact falls to zero, or the force of a compliant contact only touches zero: beyond
    /// this point the disk passes without this impact, or is not released there.
    VanishingImpact {
        /// The index of the impact.
        impact: usize,
    },
    /// An impact passes a phase at which the acceleration of the platform jumps, and the multipliers with it:
    /// an orbit gains or loses its stability, or the branch turns back in the parameter. If the velocity
    /// jumps, the branch ends.
    BorderCollision {
        /// The index of the impact.
        impact: usize,
    },
    /// The second half of the orbit becomes a repetition of the first: the orbit is born here, in a doubling
    /// of its half.
    Birth,
}

impl BifurcationKind {
    /// Its name, such as `vanishing impact`.
    #[must_use]
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Doubling => "doubling",
            Self::Fold => "fold",
            Self::Graze { .. } => "graze",
            Self::VanishingImpact { .. } => "vanishing impact",
            Self::BorderCollision { .. } => "border collision",
            Self::Birth => "birth",
        }
    }
}

/// A special point of a branch.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Bifurcation {
    /// Its kind.
    pub kind: BifurcationKind,
    /// The orbit at this point. At a graze and at a vanishing impact it is the last orbit whose speeds and
    /// gaps have the right signs, to their accuracy. Rounding decides there which impact the map finds first,
    /// so the last of [`Branch::points`] is an orbit that the map confirms. At a birth it is the orbit that
    /// doubles its period, with half the impacts.
    pub point: BranchPoint,
}

/// A period doubling, with the error of its parameter.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct LocatedDoubling {
    /// The orbit at the doubling.
    pub point: BranchPoint,
    /// The error of the parameter due to the errors of the orbit: the error of the trace over its slope.
    pub parameter_error: f64,
    /// The largest distance (rad) of an impact from the one half a period later; 0 for a single impact.
    pub width: f64,
}

/// The reason why a branch ends.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum BranchEnd {
    /// The parameter reaches this end of its range: the last orbit lies there to within rounding, or to 1e-9
    /// near a birth just beyond.
    RangeLimit(f64),
    /// The orbit ceases to exist or to be prime at the last bifurcation of the branch.
    Bifurcation,
    /// The branch is back at its start.
    Closed,
    /// The branch has the largest allowed number of points.
    PointLimit(usize),
    /// Newton's method finds no next point even at this arclength: because of rounding, at the end of a
    /// family's range, or for an unknown reason.
    StepTooSmall(f64),
}

/// A branch of periodic orbits.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Branch<M = ImpactMap> {
    /// The varied parameter.
    pub parameter: ContinuationParameter,
    /// The map at the start of the branch, with the values of the other parameters.
    pub map: M,
    /// The orbits in the order of the arclength; the last one lies at the end, or within a step of the birth
    /// that ends the branch.
    pub points: Vec<BranchPoint>,
    /// The bifurcations on the way, in the order of the arclength.
    pub bifurcations: Vec<Bifurcation>,
    /// The reason why the branch ends.
    pub end: BranchEnd,
}

impl<M: ContinuedMap> Branch<M> {
    /// The bifurcations of one kind, in the order of the arclength.
    pub fn of_kind(&self, kind: BifurcationKind) -> impl Iterator<Item = &Bifurcation> {
        self.bifurcations.iter().filter(move |bifurcation| bifurcation.kind == kind)
    }

    /// The first doubling, and its number among the bifurcations.
    pub(super) fn first_doubling(&self) -> Option<(usize, LocatedDoubling)> {
        let is_doubling = |found: &Bifurcation| found.kind == BifurcationKind::Doubling;
        let index = self.bifurcations.iter().position(is_doubling)?;
        let point = &self.bifurcations[index].point;
        let after = self.points.partition_point(|other| other.arclength <= point.arclength);
        let after = after.clamp(1, self.points.len().checked_sub(1)?.max(1));
        let [one, other] = [after - 1, after].map(|index| self.points.get(index));
        let slope = one.zip(other).map_or(f64::NAN, |(one, other)| {
            (other.flip_function() - one.flip_function()) / (other.parameter - one.parameter)
        });
        let (states, half) = (&point.orbit.states, point.orbit.period() / 2);
        let apart = |(one, other): (&ImpactState, &ImpactState)| {
            phase_difference(one.phase().angle(), other.phase().angle()).abs()
        };
        let width = states[..half].iter().zip(&states[half..]).map(apart).fold(0.0, f64::max);
        let rounding = 2.0 * f64::EPSILON * point.parameter.abs();
        let parameter_error = point.orbit.trace_error / slope.abs() + rounding;
        Some((index, LocatedDoubling { point: point.clone(), parameter_error, width }))
    }

    /// The map at a value of the parameter.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a value outside its range.
    pub fn map_at(&self, parameter: f64) -> Result<M, Error> {
        self.map.with_parameter(self.parameter, parameter)
    }

    /// The branch of twice the period that begins at number `index` of this branch's [`Self::bifurcations`],
    /// which must be a doubling. Its first point is the first one after the doubling. The settings' `rising`
    /// is ignored, because the branch may go to either side.
    ///
    /// The items of `observer` are the allowed points.
    ///
    /// # Errors
    /// [`Error::NotOfKind`] if there is no such bifurcation or it is not a doubling; [`Error::NoBranch`] if
    /// no doubled orbit is found; the errors of [`ContinuedMap::continued`].
    pub fn switched(
        &self,
        index: usize,
        settings: &Continuation,
        observer: &dyn Observer,
    ) -> Result<Self, Error> {
        settings.check()?;
        let doubling = self.bifurcations.get(index).filter(|found| found.kind == BifurcationKind::Doubling);
        let Some(doubling) = doubling else {
            let (what, count, expected) = ("bifurcation", self.bifurcations.len(), "a doubling");
            return Err(Error::NotOfKind { what, index, count, expected });
        };
        let watch = Watch::begin(observer, 0, settings.max_points as u64)?;
        let map = self.map_at(doubling.point.parameter)?;
        let (closing, at) = Closing::of(&map, settings.parameter, &doubling.point.orbit.states)?;
        let (walker, located) = Walker::after_doubling(closing, at, settings, watch.work())?;
        let branch = walker.walk(located)?;
        watch.end();
        Ok(branch)
    }
}

#[cfg(test)]
mod tests;
