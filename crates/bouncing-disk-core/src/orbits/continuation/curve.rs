//! Curves of folds, doublings and grazes in two parameters, with the points on them where the bifurcation changes
//! (docs/numerics-dynamics.md, "Curves in two parameters").

use core::ops::ControlFlow;

use super::{BifurcationKind, Branch, Continuation, ContinuedMap};
use crate::map::impact_map::{ImpactMap, ImpactState};
use crate::numerics::error::{Error, within};
use crate::orbits::closing::{Closed, Closing, ContinuationParameter};
use crate::orbits::periodic::Multipliers;
use crate::run::{Observer, Progress, Watch};

mod condition;
mod special;
mod surface;
mod walk;

use walk::CurveWalker;

/// A point of a [`Curve`]: an orbit at its bifurcation.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct CurvePoint {
    /// The values of the two parameters.
    pub parameters: [f64; 2],
    /// How far rounding may have moved the curve: along the first parameter at this value of the second, and along
    /// the second at this value of the first. If the curve runs along a parameter, the error along it is the
    /// largest double. At a [`SpecialPoint`] it is the error of its location.
    pub errors: [f64; 2],
    /// The impacts of the orbit, in their order.
    pub states: Vec<ImpactState>,
    /// The trace of the derivative around the orbit.
    pub trace: f64,
    /// The determinant of this derivative.
    pub determinant: f64,
    /// The arclength from the start of the curve, as in [`Continuation::new`] with both parameters.
    pub arclength: f64,
    /// On a curve of doublings, whether the doubled orbit exists where this one is unstable, and so attracts if this
    /// one did: a supercritical doubling. `None` on other curves, and if this is not decided.
    pub is_supercritical: Option<bool>,
}

impl CurvePoint {
    /// The Floquet multipliers.
    #[must_use]
    pub fn multipliers(&self) -> Multipliers {
        Multipliers::of_invariants(self.trace, self.determinant)
    }
}

/// The kind of a point at which the bifurcation of a curve changes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum SpecialKind {
    /// Two curves of folds meet tangentially and end; between them three orbits exist.
    Cusp,
    /// A doubling turns from supercritical to subcritical, and a curve of folds of the doubled orbit begins.
    CriticalityChange,
    /// A flight of the orbit grazes the platform at the fold: a curve of folds ends on a curve of grazes.
    GrazingFold {
        /// The index of the impact before the flight.
        flight: usize,
    },
    /// A flight of the orbit grazes the platform at the doubling: a curve of doublings ends on a curve of
    /// grazes.
    GrazingDoubling {
        /// The index of the impact before the flight.
        flight: usize,
    },
    /// Both multipliers are 1 within 1e-3, the strong resonance 1:1. As the determinant of n rigid impacts is
    /// r^(2n), a curve of folds reaches this point only at its end at restitution 1.
    Resonance11,
    /// Both multipliers are -1 within 1e-3, the strong resonance 1:2: the end of a curve of doublings at
    /// restitution 1.
    Resonance12,
}

impl SpecialKind {
    /// Its name, such as `criticality change`.
    #[must_use]
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Cusp => "cusp",
            Self::CriticalityChange => "criticality change",
            Self::GrazingFold { .. } => "grazing fold",
            Self::GrazingDoubling { .. } => "grazing doubling",
            Self::Resonance11 => "resonance 1:1",
            Self::Resonance12 => "resonance 1:2",
        }
    }
}

/// A point at which the bifurcation of a curve changes.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct SpecialPoint {
    /// Its kind.
    pub kind: SpecialKind,
    /// The orbit there.
    pub point: CurvePoint,
}

/// Why a curve ends.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum CurveEnd {
    /// A parameter reaches this end of its range: to within rounding, or to within 1e-7 of the arclength if there is no
    /// map beyond.
    RangeLimit {
        /// The parameter.
        parameter: ContinuationParameter,
        /// The end of its range.
        value: f64,
    },
    /// A flight touches the platform before its impact: beyond this point an earlier impact prevents it.
    Graze {
        /// The index of the impact before the flight.
        flight: usize,
    },
    /// The speed of an impact falls to zero, or so near to it that the derivative, which grows with its inverse, is no
    /// longer known.
    VanishingImpact {
        /// The index of the impact.
        impact: usize,
    },
    /// An impact reaches a phase at which the acceleration of the platform jumps, and the multipliers with it.
    BorderCollision {
        /// The index of the impact.
        impact: usize,
    },
    /// The second half of the orbit becomes a repetition of the first: a curve of folds ends where the doubling in
    /// which its orbit is born changes its criticality.
    Birth,
    /// The curve is back at its start.
    Closed,
    /// There are as many points as were allowed.
    PointLimit(usize),
    /// Newton's method finds no next point even at this arclength.
    StepTooSmall(f64),
}

impl CurveEnd {
    /// Its name, such as `range limit`.
    #[must_use]
    pub const fn name(&self) -> &'static str {
        match self {
            Self::RangeLimit { .. } => "range limit",
            Self::Graze { .. } => "graze",
            Self::VanishingImpact { .. } => "vanishing impact",
            Self::BorderCollision { .. } => "border collision",
            Self::Birth => "birth",
            Self::Closed => "closed",
            Self::PointLimit(_) => "point limit",
            Self::StepTooSmall(_) => "step too small",
        }
    }
}

/// A curve of bifurcations of one kind in two parameters.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Curve<M = ImpactMap> {
    /// The kind: a fold, a doubling or a graze.
    pub kind: BifurcationKind,
    /// The parameter of the branch from which the curve starts, and the second one.
    pub parameters: [ContinuationParameter; 2],
    /// The map of the branch, with the values of the other parameters.
    pub map: M,
    /// Its points in the order of the arclength.
    pub points: Vec<CurvePoint>,
    /// The points at which the bifurcation changes, in the same order.
    pub special: Vec<SpecialPoint>,
    /// Why the curve ends.
    pub end: CurveEnd,
}

impl<M: ContinuedMap> Curve<M> {
    /// The special points of one kind, in the order of the arclength.
    pub fn of_kind(&self, kind: SpecialKind) -> impl Iterator<Item = &SpecialPoint> {
        self.special.iter().filter(move |special| special.kind == kind)
    }
}

impl<M: ContinuedMap> Branch<M> {
    /// The curve of bifurcations over a second parameter, starting from number `index` of [`Self::bifurcations`],
    /// which must be a fold, a doubling or a graze. `settings` specify the second parameter, its range and steps,
    /// and whether it rises at first; the parameter of the branch stays in `range`.
    ///
    /// Every point is an orbit of the map at its bifurcation; cusps and the other [`SpecialKind`]s are located. Two
    /// special points of one kind within one step are missed: see [`Continuation::with_steps`].
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
    /// // Where the first doubling is at other restitutions.
    /// let second = Continuation::new(ContinuationParameter::Restitution, (0.3, 0.9), true)?;
    /// let curve = branch.curve(0, (0.1, 1.0), &second, &Unobserved)?;
    /// assert_eq!(curve.kind, BifurcationKind::Doubling);
    /// for point in &curve.points {
    ///     let [forcing, restitution] = point.parameters;
    ///     assert!((forcing - ImpactMap::first_doubling_forcing(restitution)).abs() < 1e-14);
    /// }
    /// # Ok::<(), bouncing_disk_core::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::NotOfKind`] if there is no such bifurcation or it is of another kind, if the map has no such second
    /// parameter, or if it is the parameter of the branch; [`Error::OutOfRange`] if a parameter is outside its range at
    /// the start; [`Error::NoBranch`] if no curve is found there; [`Error::Stopped`] if the observer breaks.
    pub fn curve(
        &self,
        index: usize,
        range: (f64, f64),
        settings: &Continuation,
        observer: &dyn Observer,
    ) -> Result<Curve<M>, Error> {
        settings.check()?;
        settings.check_map(&self.map)?;
        let (kind, closing, at) = self.start_of_curve(index, range, settings.parameter)?;
        let watch = Watch::begin(observer, 0, settings.max_points as u64)?;
        let (walker, start) = CurveWalker::new(kind, closing, &at, range, settings, watch.work())?;
        let curve = walker.walk(start)?;
        watch.end();
        Ok(curve)
    }

    /// All curves of the folds, doublings and grazes of this branch, each with the number of its bifurcation. From each
    /// bifurcation a curve is followed in the direction of the first settings and, unless it is closed, in the
    /// direction of the second. A bifurcation from which no curve can be followed, such as one at which two flights
    /// graze, is left out.
    ///
    /// The items of `observer` are the curves.
    ///
    /// # Errors
    /// The errors of [`Self::curve`], except for [`Error::NoBranch`] and bifurcations of other kinds.
    pub fn curves(
        &self,
        range: (f64, f64),
        directions: &[Continuation; 2],
        observer: &dyn Observer,
    ) -> Result<Vec<(usize, Curve<M>)>, Error> {
        let watch = Watch::begin(observer, 0, 2 * self.bifurcations.len() as u64)?;
        let asked = |_: Progress| match watch.ask() {
            Ok(()) => ControlFlow::Continue(()),
            Err(_) => ControlFlow::Break(()),
        };
        let mut found = Vec::new();
        for (index, bifurcation) in self.bifurcations.iter().enumerate() {
            for settings in directions {
                if !has_curve(bifurcation.kind) {
                    break;
                }
                let curve = match self.curve(index, range, settings, &asked) {
                    Err(Error::NoBranch { .. }) => break,
                    other => other?,
                };
                watch.finish(1);
                let is_closed = curve.end == CurveEnd::Closed;
                found.push((index, curve));
                if is_closed {
                    break;
                }
            }
        }
        watch.end();
        Ok(found)
    }

    /// The kind of a bifurcation, the equations of its orbit, and that orbit.
    fn start_of_curve(
        &self,
        index: usize,
        (low, high): (f64, f64),
        second: ContinuationParameter,
    ) -> Result<(BifurcationKind, Closing<M>, Closed), Error> {
        if second == self.parameter {
            let (what, index, expected) =
                ("second parameter", second as usize, "a parameter other than that of the branch");
            return Err(Error::NotOfKind { what, index, count: 2, expected });
        }
        let (least, most) = self.parameter.legal();
        within("low end of a curve", low, least, most, "within the legal range of the parameter")?;
        within(
            "high end of a curve",
            high,
            low.next_up(),
            most,
            "(low end, largest legal value of the parameter]",
        )?;
        let found = self.bifurcations.get(index).filter(|found| has_curve(found.kind));
        let Some(found) = found else {
            let (what, count) = ("bifurcation", self.bifurcations.len());
            return Err(Error::NotOfKind { what, index, count, expected: "a fold, doubling or graze" });
        };
        let parameter = found.point.parameter;
        within("parameter at the start of a curve", parameter, low, high, "within the range of the curve")?;
        let lost = Error::NoBranch { what: "the start of a curve", parameter };
        // At a graze rounding decides which impact the map finds, but not at the point of the branch before.
        let before = self.points.partition_point(|point| point.arclength <= found.point.arclength);
        let near = self
            .points
            .get(before.saturating_sub(1))
            .filter(|near| near.orbit.states.len() == found.point.orbit.states.len());
        let near = near.ok_or(lost)?;
        let map = self.map_at(near.parameter)?;
        let durations = near.orbit.states.iter().map(|&state| map.time_to_next(state));
        let durations = durations.collect::<Result<Vec<_>, _>>()?;
        let (closing, at) = Closing::with_durations(
            &self.map_at(parameter)?,
            self.parameter,
            &found.point.orbit.states,
            &durations,
        );
        Ok((found.kind, closing, at))
    }
}

/// Whether a bifurcation is of a kind that has curves.
const fn has_curve(kind: BifurcationKind) -> bool {
    matches!(kind, BifurcationKind::Fold | BifurcationKind::Doubling | BifurcationKind::Graze { .. })
}

#[cfg(test)]
mod tests;
