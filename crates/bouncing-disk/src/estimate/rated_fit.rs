//! What nobody knows of a motor, fitted to the few points that its maker prints: rated torque and speed, speed without
//! load, stall torque, each under its own conditions.
//!
//! A smooth stand-in for the motor is computed at some hundred places of the ranges; what the points exclude by it, and
//! by its own errors, is excluded. docs/numerics/motors.md, "Parameters from rated points".

mod emulator;
pub(crate) mod point;
mod surface;

use std::ops::ControlFlow;

use bouncing_disk_core::numerics::elementary::pow;
use bouncing_disk_core::numerics::random::SplitMix64;
use bouncing_disk_core::numerics::statistics::NORMAL_975;
use bouncing_disk_core::run::{Watch, in_parallel};
use bouncing_disk_core::{Observer, Progress};
use nalgebra::DVector;

use crate::error::{Error, check, positive, within_limit};
use crate::estimate::parameter_fit::estimate::{AcceptedRange, UndeterminedDirection};
use crate::estimate::parameter_fit::parameter::{FitParameter, FitRange, check_ranges};
use crate::estimate::parameter_fit::{named, rare_misfit};
use crate::estimate::rated_fit::emulator::Response;
use crate::estimate::rated_fit::point::RatedPoint;
use crate::estimate::rated_fit::surface::{Profile, Surface};
use crate::estimate::refusal::{FitError, FitRefusal, refused};
use crate::motor::data_sheet::Motor;
use crate::motor::operation::of_motor::operations;
use crate::motor::operation::point::{Operation, Shortfall};
use crate::motor::operation::settings::OperatingSettings;

/// Places that are computed at once, on machines with any number of threads: what is found depends on it.
const BATCH: usize = 2;

/// Most points of a fit.
const MOST_POINTS: usize = 100;

/// Most fitted parameters and uncertain conditions together: places of more coordinates would need more motors than
/// anybody computes.
const MOST_COORDINATES: usize = 16;

/// An uncertain condition is followed up to so many standard errors.
pub(crate) const ERRORS: f64 = 3.0;

/// No speed counts as known better than this share of the stator's largest one.
const RESOLUTION: f64 = 1e-3;

/// Where the stand-in's variance is below this share of that of the points, it is good enough.
const SETTLED: f64 = 0.25;

/// How rated points are fitted.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct RatedFitSettings {
    /// Most places of the ranges at which all points are computed, in [8, 400]. Default 120. Fewer are taken where
    /// these are enough.
    pub most_evaluations: usize,
    /// How a point is computed. Default: 6 members, an error of 0.02, at most 500,000 impacts.
    pub operating: OperatingSettings,
    /// The largest accepted sum of squares, as a multiple of the value that one of 10,000 sound fits exceeds, at least
    /// 1. Default 1.
    pub largest_misfit: f64,
}

impl Default for RatedFitSettings {
    fn default() -> Self {
        let operating = OperatingSettings {
            relative_error: 0.02,
            members: 6,
            most_impacts: 500_000,
            ..OperatingSettings::default()
        };
        Self { most_evaluations: 120, operating, largest_misfit: 1.0 }
    }
}

/// A parameter, and what the points leave of its range.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct RatedEstimate {
    /// The parameter, and the range that was searched.
    pub range: FitRange,
    /// Its value in the data sheet (SI).
    pub nominal: f64,
    /// The best value (SI), if there is one accepted range with two ends.
    pub value: Option<f64>,
    /// The ranges that the points do not exclude with 95 % confidence, the lowest first; several are not decided between.
    pub accepted: Vec<AcceptedRange>,
}

/// A point as the fitted motor has it.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct FittedPoint {
    /// The printed speed (rad/s).
    pub printed: f64,
    /// The speed of the fitted motor (rad/s).
    pub fitted: f64,
    /// Standard error of their difference (rad/s).
    pub standard_error: f64,
}

/// Parameters of a motor fitted to rated points.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct RatedFit {
    /// The fitted parameters, in the order of their ranges.
    pub parameters: Vec<RatedEstimate>,
    /// The combinations of parameters that the points do not determine near the best values, the least uncertain first.
    pub undetermined: Vec<UndeterminedDirection>,
    /// The motor with the best values, one of many where something is not determined.
    pub motor: Motor,
    /// The points, in their order.
    pub points: Vec<FittedPoint>,
    /// The remaining sum of weighted squares.
    pub misfit: f64,
    /// Its expectation: the number of points minus the number of determined directions, 0 or more.
    pub degrees_of_freedom: usize,
    /// Places at which the points were computed.
    pub evaluations: usize,
    /// Whether they were enough: otherwise more evaluations, or more impacts of each, would narrow the ranges.
    pub settled: bool,
}

/// What is fitted.
struct Model<'a> {
    nominal: &'a Motor,
    points: &'a [RatedPoint],
    ranges: &'a [FitRange],
    settings: &'a RatedFitSettings,
    /// Point and condition of each coordinate beyond the ranges.
    uncertain: Vec<(usize, usize)>,
    /// The speed (rad/s) at which the scale of each point bends.
    bends: Vec<f64>,
}

/// A speed on a scale that is bounded: a load that overpowers a motor has one end of it.
fn bent(speed: f64, bend: f64) -> f64 {
    speed / (1.0 + (speed / bend) * (speed / bend)).sqrt()
}

fn unbent(value: f64, bend: f64) -> f64 {
    let share = (value / bend).clamp(-1.0 + 1e-9, 1.0 - 1e-9);
    value / (1.0 - share * share).sqrt()
}

/// The derivative of the bounded scale.
fn bending(speed: f64, bend: f64) -> f64 {
    let stretch = 1.0 + (speed / bend) * (speed / bend);
    1.0 / (stretch * stretch.sqrt())
}

impl RatedFit {
    /// Fits the parameters that have a range to the points. All else is taken from the data sheet.
    ///
    /// The items of `observer` are the evaluations that the search may take.
    ///
    /// # Errors
    /// [`FitError::Refused`] for points that no parameters in their ranges explain; [`Error::OutOfRange`] for illegal
    /// settings, points and ranges, and for a parameter that the motor does not have; [`Error::BothGiven`] where a
    /// condition of a point takes the place of a parameter. Those of [`operations`](crate::motor::operations).
    pub fn new(
        nominal: &Motor,
        points: &[RatedPoint],
        ranges: &[FitRange],
        settings: &RatedFitSettings,
        observer: &dyn Observer,
    ) -> Result<Self, FitError> {
        let model = Model::new(nominal, points, ranges, settings)?;
        let watch = Watch::begin(observer, 0, settings.most_evaluations as u64)?;
        let coordinates = ranges.len() + model.uncertain.len();
        let first = (8 + 6 * coordinates).min(settings.most_evaluations);
        let mut nodes = design(coordinates, first, settings.operating.seed);
        let mut values = model.compute(&nodes, 0, &watch)?;
        let mut surface = model.surface(&nodes, &values, None, &watch)?;
        let (profiles, settled) = loop {
            let profiles = surface.profiles(&|| watch.ask().is_ok());
            watch.ask()?;
            let left = settings.most_evaluations - nodes.len();
            let more = surface.doubtful(&profiles, BATCH.max(1 + coordinates / 2).min(left));
            if more.is_empty() {
                let settled = surface.is_settled(&profiles);
                break (profiles, settled);
            }
            values.extend(model.compute(&more, nodes.len(), &watch)?);
            nodes.extend(more);
            surface = model.surface(&nodes, &values, Some(&surface), &watch)?;
        };
        watch.end();
        model.result(&surface, &profiles, (nodes.len(), settled))
    }

    /// What the points leave of a parameter's range; `None` if it was not fitted.
    #[must_use]
    pub fn estimate(&self, parameter: FitParameter) -> Option<&RatedEstimate> {
        self.parameters.iter().find(|fitted| fitted.range.parameter == parameter)
    }
}

/// Places that fill a cube evenly: multiples of the powers of the number that is the golden ratio in one dimension.
fn design(coordinates: usize, count: usize, seed: u64) -> Vec<DVector<f64>> {
    let mut ratio = 1.5;
    for _ in 0..60 {
        ratio = pow(1.0 + ratio, 1.0 / (coordinates as f64 + 1.0));
    }
    let mut generator = SplitMix64::new(seed ^ 0xDE51);
    let lines: Vec<_> =
        (1..=coordinates).map(|power| (pow(ratio, -(power as f64)), generator.unit())).collect();
    let place = |index: usize| {
        let along = lines.iter().map(|(step, start)| {
            let turns = start + step * index as f64;
            2.0 * (turns - turns.floor()) - 1.0
        });
        DVector::from_iterator(coordinates, along)
    };
    (0..count).map(place).collect()
}

impl<'a> Model<'a> {
    fn new(
        nominal: &'a Motor,
        points: &'a [RatedPoint],
        ranges: &'a [FitRange],
        settings: &'a RatedFitSettings,
    ) -> Result<Self, Error> {
        let evaluations = settings.most_evaluations;
        check((8..=400).contains(&evaluations), "most_evaluations", evaluations as f64, "[8, 400]")?;
        settings.operating.check()?;
        let multiple = settings.largest_misfit;
        check(multiple >= 1.0 && multiple.is_finite(), "largest_misfit", multiple, "[1, inf)")?;
        check(!points.is_empty(), "number of points", 0.0, "[1, 100]")?;
        within_limit("rated points", points.len(), MOST_POINTS)?;
        check_ranges(nominal, ranges)?;
        let mut uncertain = Vec::new();
        for (index, point) in points.iter().enumerate() {
            point.check(ranges)?;
            let repeats = points[..index].iter().filter(|before| before.has_conditions_of(point)).count();
            check(
                repeats == 0,
                "points under the same conditions",
                (repeats + 1) as f64,
                "1: take their mean",
            )?;
            let errors = point.conditions.iter().enumerate().filter(|(_, condition)| condition.error > 0.0);
            uncertain.extend(errors.map(|(condition, _)| (index, condition)));
        }
        within_limit(
            "fitted parameters and uncertain conditions",
            ranges.len() + uncertain.len(),
            MOST_COORDINATES,
        )?;
        let mut model = Self { nominal, points, ranges, settings, uncertain, bends: Vec::new() };
        let middle = DVector::zeros(ranges.len() + model.uncertain.len());
        for (index, point) in points.iter().enumerate() {
            // The ends of all ranges together, and the sheet's own values.
            for end in [-1.0, 1.0] {
                model.motor(&middle.add_scalar(end), index)?;
            }
            let own = point.motor(nominal, &[])?;
            let bend = own.system().platform().peak_angular_speed().max(point.speed.abs());
            model.bends.push(positive("largest angular speed of the stator", bend)?);
        }
        Ok(model)
    }

    /// The motor at these places under the conditions of a point.
    fn motor(&self, places: &DVector<f64>, point: usize) -> Result<Motor, Error> {
        let mut off = vec![0.0; self.points[point].conditions.len()];
        for (place, (own, condition)) in places.iter().skip(self.ranges.len()).zip(&self.uncertain) {
            if *own == point {
                off[*condition] = ERRORS * place * self.points[point].conditions[*condition].error;
            }
        }
        self.points[point].motor(self.nominal, &off)?.with(|sheet| {
            for (range, place) in self.ranges.iter().zip(places.iter()) {
                range.parameter.set(sheet, range.value_at(*place));
            }
        })
    }

    /// The coordinates that a point depends on.
    fn coordinates_of(&self, point: usize) -> Vec<usize> {
        let own = self.uncertain.iter().enumerate().filter(|(_, (index, _))| *index == point);
        (0..self.ranges.len()).chain(own.map(|(index, _)| self.ranges.len() + index)).collect()
    }

    /// The bounded speeds of all points at these places, with their standard errors; `before` others have been computed.
    fn compute(
        &self,
        places: &[DVector<f64>],
        before: usize,
        watch: &Watch<'_>,
    ) -> Result<Vec<Vec<Response>>, Error> {
        let ask = |_: Progress| watch.ask().map_or(ControlFlow::Break(()), ControlFlow::Continue);
        let of_place = |index: usize| {
            let motors = (0..self.points.len()).map(|point| self.motor(&places[index], point));
            let seed = SplitMix64::seed_of_stream(self.settings.operating.seed, (before + index) as u64);
            let settings = OperatingSettings { seed, ..self.settings.operating };
            let all = operations(&motors.collect::<Result<Vec<_>, _>>()?, &settings, &ask)?;
            watch.finish(1);
            Ok(all.iter().zip(&self.bends).map(|(row, bend)| response_of(row.operation(), *bend)).collect())
        };
        let results = in_parallel(places.len(), of_place).into_iter().collect();
        watch.ask()?;
        results
    }

    fn surface(
        &self,
        nodes: &[DVector<f64>],
        values: &[Vec<Response>],
        earlier: Option<&Surface>,
        watch: &Watch<'_>,
    ) -> Result<Surface, Error> {
        let measured = self.points.iter().zip(&self.bends).map(|(point, bend)| {
            let error = point.speed_error * bending(point.speed, *bend);
            (bent(point.speed, *bend), error * error + RESOLUTION * RESOLUTION * bend * bend)
        });
        let coordinates = (0..self.points.len()).map(|point| self.coordinates_of(point)).collect();
        let surface =
            Surface::new(self.ranges.len(), measured.collect(), coordinates, nodes, values, earlier, &|| {
                watch.ask().is_ok()
            });
        watch.ask()?;
        surface.ok_or(Error::OutOfRange { field: "speeds of the points", value: f64::NAN, legal: "finite" })
    }

    fn result(
        &self,
        surface: &Surface,
        profiles: &[Profile],
        (evaluations, settled): (usize, bool),
    ) -> Result<RatedFit, FitError> {
        let places = &surface.best;
        let directions = surface.directions();
        let misfit = surface.deviance(places);
        let determined = self.ranges.len() - directions.len();
        let degrees_of_freedom = self.points.len().saturating_sub(determined);
        let largest = self.settings.largest_misfit * rare_misfit(degrees_of_freedom.max(1) as f64);
        // The likeliest place need not be that of the least misfit.
        let least =
            profiles.iter().flat_map(|profile| &profile.nodes).map(|node| node.1).fold(misfit, f64::min);
        if least > largest {
            return refused(FitRefusal::Misfit { misfit: least, degrees_of_freedom, largest });
        }
        let rigid = 0.1 / self.nominal.parameters().drive_frequency;
        let parameters = self.ranges.iter().zip(profiles).enumerate().map(|(index, (range, profile))| {
            let accepted: Vec<AcceptedRange> = profile
                .accepted
                .iter()
                .map(|ends| {
                    let [low, high] = ends.map(|end| (end.abs() < 1.0).then(|| range.value_at(end)));
                    let is_time = range.parameter == FitParameter::ContactTime;
                    AcceptedRange {
                        parameter: range.parameter,
                        low: low.filter(|low| !is_time || *low >= rigid),
                        high,
                    }
                })
                .collect();
            let is_one = matches!(accepted.as_slice(), [AcceptedRange { low: Some(_), high: Some(_), .. }]);
            RatedEstimate {
                range: *range,
                nominal: range.parameter.of(self.nominal),
                value: is_one.then(|| range.value_at(places[index])),
                accepted,
            }
        });
        let points = self.points.iter().zip(&self.bends).zip(surface.fitted(places));
        let points = points.map(|((point, bend), (value, variance))| {
            let fitted = unbent(value, *bend);
            FittedPoint {
                printed: point.speed,
                fitted,
                standard_error: variance.sqrt() / bending(fitted, *bend),
            }
        });
        let parameters: Vec<_> = parameters.collect();
        // As the data sheet, without the conditions of a point.
        let motor = self.nominal.with(|sheet| {
            for (range, place) in self.ranges.iter().zip(places.iter()) {
                range.parameter.set(sheet, range.value_at(*place));
            }
        })?;
        Ok(RatedFit {
            parameters,
            undetermined: directions
                .iter()
                .map(|(direction, error)| named(self.ranges, direction, *error))
                .collect(),
            motor,
            points: points.collect(),
            misfit,
            degrees_of_freedom,
            evaluations,
            settled,
        })
    }
}

/// The bounded speed of an operation. What is left of its start-up has a sign, which other places share.
fn response_of(operation: &Operation, bend: f64) -> Response {
    let Some(point) = operation.point() else {
        return Response { value: -bend.copysign(operation.load_torque()), error: 0.0, bias: 0.0 };
    };
    let speed = point.speed.value;
    let bias = match operation {
        Operation::Unsettled(_, Shortfall::Drift { drift, .. }) => {
            drift.abs() + NORMAL_975 * point.speed.standard_error
        }
        Operation::Unsettled(_, Shortfall::Start { spread, .. }) => *spread,
        Operation::Unsettled(_, Shortfall::PowerBalance { stored_power, input_power }) => {
            bend * (stored_power / input_power).abs().min(1.0)
        }
        _ => 0.0,
    };
    let of = |error: f64| (error * bending(speed, bend)).min(bend);
    Response { value: bent(speed, bend), error: of(point.speed.standard_error), bias: of(bias) }
}

#[cfg(test)]
mod tests;
