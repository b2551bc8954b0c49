//! The search for the least squares, by MINPACK's Levenberg-Marquardt method.

use std::cell::RefCell;

use bouncing_disk_core::run::Watch;
use levenberg_marquardt::{LeastSquaresProblem, LevenbergMarquardt, TerminationReason};
use nalgebra::storage::Owned;
use nalgebra::{DMatrix, DVector, Dyn};

use crate::error::Error;
use crate::estimate::parameter_fit::determined::Directions;
use crate::estimate::parameter_fit::model::{Local, Model, SPAN, mean_of};
use crate::estimate::parameter_fit::parameter::FitParameter;
use crate::estimate::parameter_fit::weights::Weights;
use crate::estimate::refusal::{FitError, FitRefusal, refused};

/// Relative change of the sum of squares, and of the places, at which the search ends: a thirtieth of a
/// standard error changes a sum of one by 1e-3.
const TOLERANCE: f64 = 1.0e-3;

/// How often the motors have been computed, and how often they may be.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Evaluations {
    pub(crate) spent: usize,
    pub(crate) most: usize,
}

impl Evaluations {
    /// Counts one more.
    pub(crate) fn spend(&mut self, watch: &Watch<'_>) -> Result<(), FitError> {
        if self.spent >= self.most {
            return refused(FitRefusal::NotConverged { evaluations: self.spent });
        }
        self.spent += 1;
        watch.set_done(self.spent as u64);
        Ok(())
    }
}

/// A search that has moved by less than this many standard errors has weights and directions that are those
/// of its end. The luck of other vertical motions is about an eighth of one, with 64 members.
const NEAR: f64 = 0.3;

/// A place in the ranges and all that is known there.
pub(crate) struct Linearised {
    pub(crate) places: DVector<f64>,
    pub(crate) local: Local,
    pub(crate) weights: Weights,
    pub(crate) directions: Directions,
}

impl Linearised {
    pub(crate) fn at(
        model: &Model<'_>,
        places: DVector<f64>,
        evaluations: &mut Evaluations,
        watch: &Watch<'_>,
    ) -> Result<Self, FitError> {
        evaluations.spend(watch)?;
        let local = model.with_derivatives(&places, |_| true, watch)?;
        let weights = Weights::of(model, &local)?;
        let directions = Directions::of(&weights, &local);
        Ok(Self { places, local, weights, directions })
    }

    /// The least squares from a place, with the weights and directions of their end.
    pub(crate) fn search(
        model: &Model<'_>,
        start: DVector<f64>,
        evaluations: &mut Evaluations,
        watch: &Watch<'_>,
    ) -> Result<Self, FitError> {
        let mut state = Self::at(model, start, evaluations, watch)?;
        let mut is_near = state.directions.determined.ncols() == 0;
        while !is_near {
            let places = least_squares(model, &state, evaluations, watch)?;
            let next = Self::at(model, places, evaluations, watch)?;
            is_near = next.directions.determined.ncols() == 0 || next.is_near(&state);
            state = next;
        }
        Ok(state)
    }

    /// Whether the weights and directions are those of the other place as well.
    pub(crate) fn is_near(&self, other: &Self) -> bool {
        let moved = &self.directions.derivatives * (&self.places - &other.places);
        self.directions.determined.ncols() == other.directions.determined.ncols() && moved.norm() < NEAR
    }
}

/// The least squares along the directions that are determined, from a place.
///
/// The means follow friction, lag and twist along the vertical motions of that place, and the parameters that
/// change these along their derivatives. So the sum of squares is smooth, and the search cannot select a
/// motion whose squares are small by luck.
struct Search<'a> {
    model: &'a Model<'a>,
    weights: &'a Weights,
    watch: &'a Watch<'a>,
    /// The measured values with which the weighted means are compared.
    target: DVector<f64>,
    from: &'a DVector<f64>,
    directions: &'a Directions,
    along: DVector<f64>,
    state: RefCell<(Evaluations, Option<FitError>)>,
}

impl Search<'_> {
    fn changes_orbit(&self, parameter: usize) -> bool {
        self.model.ranges[parameter].parameter.changes_orbit()
    }

    /// Within the ranges, and near where the derivatives hold.
    fn places(&self) -> DVector<f64> {
        let mut places = self.from + &self.directions.determined * &self.along;
        for (index, place) in places.iter_mut().enumerate() {
            let (from, step) = (self.from[index], if self.changes_orbit(index) { SPAN } else { 2.0 });
            *place = place.clamp(from - step, from + step).clamp(-1.0, 1.0);
        }
        places
    }

    /// The places on the vertical motions of the start, and what the other parameters add to the weighted
    /// means there.
    fn on_orbits(&self) -> (DVector<f64>, DVector<f64>) {
        let (mut places, mut added) = (self.places(), DVector::zeros(self.target.len()));
        for (index, &from) in self.from.iter().enumerate().filter(|&(index, _)| self.changes_orbit(index)) {
            added += self.directions.derivatives.column(index) * (places[index] - from);
            places[index] = from;
        }
        (places, added)
    }

    /// The result of a computation, or `None` once one has failed.
    fn keep<T>(&self, compute: impl FnOnce() -> Result<T, Error>) -> Option<T> {
        let (evaluations, error) = &mut *self.state.borrow_mut();
        match evaluations.spend(self.watch).and_then(|()| Ok(compute()?)) {
            Ok(result) => Some(result),
            Err(failure) => {
                *error = Some(failure);
                None
            }
        }
    }
}

impl LeastSquaresProblem<f64, Dyn, Dyn> for Search<'_> {
    type ResidualStorage = Owned<f64, Dyn>;
    type JacobianStorage = Owned<f64, Dyn, Dyn>;
    type ParameterStorage = Owned<f64, Dyn>;

    fn set_params(&mut self, along: &DVector<f64>) {
        self.along.copy_from(along);
    }

    fn params(&self) -> DVector<f64> {
        self.along.clone()
    }

    fn residuals(&self) -> Option<DVector<f64>> {
        let (places, added) = self.on_orbits();
        let members = self.keep(|| self.model.members(&[places], self.watch))?;
        Some(self.weights.apply(&mean_of(&members[0])) + added - &self.target)
    }

    fn jacobian(&self) -> Option<DMatrix<f64>> {
        let (places, _) = self.on_orbits();
        let shares_orbit = |parameter: FitParameter| !parameter.changes_orbit();
        let local = self.keep(|| self.model.with_derivatives(&places, shares_orbit, self.watch))?;
        let mut weighted = self.directions.derivatives.clone();
        for (index, members) in
            local.derivatives.iter().enumerate().filter(|&(index, _)| !self.changes_orbit(index))
        {
            weighted.set_column(index, &self.weights.apply(&mean_of(members)));
        }
        Some(weighted * &self.directions.determined)
    }
}

/// The place of the least squares along the directions that are determined, from a place.
fn least_squares(
    model: &Model<'_>,
    start: &Linearised,
    evaluations: &mut Evaluations,
    watch: &Watch<'_>,
) -> Result<DVector<f64>, FitError> {
    let Linearised { places: from, local, weights, directions } = start;
    let roughness = mean_of(&local.members) - &local.smooth;
    let search = Search {
        model,
        weights,
        watch,
        target: weights.apply(&(model.measured() + roughness)),
        from,
        directions,
        along: DVector::zeros(directions.determined.ncols()),
        state: RefCell::new((*evaluations, None)),
    };
    // The first step is half of the ranges at most.
    let method = LevenbergMarquardt::new()
        .with_ftol(TOLERANCE)
        .with_xtol(TOLERANCE)
        .with_gtol(TOLERANCE)
        .with_stepbound(1.0)
        .with_scale_diag(false)
        .with_patience(evaluations.most.max(1));
    let (search, report) = method.minimize(search);
    let places = search.places();
    let (spent, error) = search.state.into_inner();
    *evaluations = spent;
    match (error, report.termination) {
        (Some(error), _) => Err(error),
        (None, TerminationReason::LostPatience | TerminationReason::Numerical(_)) => {
            refused(FitRefusal::NotConverged { evaluations: spent.spent })
        }
        // The search ends where it finds no improvement, whatever the reason.
        (None, _) => Ok(places),
    }
}
