//! Fits of unknown motor parameters to measured run-ups, braking tails and the few points in a maker's
//! catalogue (rated torque and speed, no-load speed, stall torque), each under its own conditions.
//!
//! A smooth emulator of the motor is fitted to computed points of the ranges. Parameters are excluded if their
//! emulated speeds differ from the measurements by more than the errors of both allow
//! (docs/numerics-dynamics.md, "Parameters from measurements").
//!
//! Let C be the covariance of a transient's W means over M members, and n the number of measured runs. At the
//! parameters nearest to the measurement Sigma = C/n (M - 1)/(M - W - 2); the factor makes the inverse of an
//! estimated covariance unbiased. In the basis of the root of Sigma the means of a run are independent with
//! variance one. The basis is rotated so that the differences that no smooth response explains are independent
//! too: a motion that locks is faster or slower in all windows and must count once. No mean counts as known to
//! better than 1e-3 of the largest. At other parameters, the variances come from the members computed there.

mod display;
mod emulator;
pub(crate) mod estimate;
pub(crate) mod parameter;
pub(crate) mod point;
mod surface;
pub(crate) mod transient;

use std::ops::ControlFlow;

use bouncing_disk_core::numerics::elementary::{exp, pow};
use bouncing_disk_core::numerics::random::SplitMix64;
use bouncing_disk_core::numerics::statistics::{NORMAL_975, mean, standard_deviation};
use bouncing_disk_core::run::{Watch, in_parallel};
use bouncing_disk_core::{Observer, Progress};
use nalgebra::{Cholesky, DMatrix, DVector, Dyn, SymmetricEigen};

use crate::error::{Error, check, positive, within_limit};
use crate::estimate::motor_fit::emulator::Response;
use crate::estimate::motor_fit::estimate::{AcceptedRange, UndeterminedDirection};
use crate::estimate::motor_fit::parameter::{FitParameter, FitRange, check_ranges};
use crate::estimate::motor_fit::point::RatedPoint;
use crate::estimate::motor_fit::surface::{Profile, Surface};
use crate::estimate::motor_fit::transient::{Computed, MeasuredTransient, Observed};
use crate::estimate::refusal::{FitError, FitRefusal, refused};
use crate::motor::data_sheet::Motor;
use crate::motor::operation::of_motor::operations;
use crate::motor::operation::point::{Estimate, Operation, Shortfall};
use crate::motor::operation::settings::OperatingSettings;

/// Number of points computed at once, the same for any number of threads, because the result depends on it.
const BATCH: usize = 2;

/// The same for transients.
const BATCH_OF_TRANSIENTS: usize = 20;

/// Largest number of measured points of a fit.
const MOST_POINTS: usize = 100;

/// Largest number of fitted parameters and uncertain conditions together; more dimensions would need too many
/// computed motors.
const MOST_COORDINATES: usize = 16;

/// Range of an uncertain condition, in standard errors.
pub(crate) const ERRORS: f64 = 3.0;

/// No speed counts as known to better than this share of the stator's largest speed.
const RESOLUTION: f64 = 1e-3;

/// Largest number of transients of a fit.
const MOST_TRANSIENTS: usize = 100;

/// The interpolation error of a computed curve, as a share of the largest mean: no mean counts as known to
/// better than this.
const CURVE_RESOLUTION: f64 = 1e-3;

/// Points within this distance, as a share of half the ranges, are used to estimate the deviations from a
/// smooth response near the truth.
const NEAR: f64 = 0.5;

/// An offset or a drift of the measured speeds, in standard errors, beyond which the fit is rejected.
const SIGNIFICANT: f64 = 4.0;

/// The quantile of the normal distribution that one sample in 10,000 exceeds.
const RARE: f64 = 3.719_016_485_455_709;

/// The emulator is good enough if its variance is below this share of the points' variance.
const SETTLED: f64 = 0.25;

/// Settings of a fit of motor parameters.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct MotorFitSettings {
    /// Largest number of parameter sets at which all measurements are computed, in [8, 400]. Default 200.
    /// Fewer are used if they suffice.
    pub most_evaluations: usize,
    /// How a point is computed. Default: 6 members, an error of 0.02, at most 500,000 impacts.
    pub operating: OperatingSettings,
    /// Computed members of each transient, which determine the scatter of a run, in [16, 4096]. Default 32.
    pub members: usize,
    /// The largest accepted sum of squares, as a multiple of the value that one of 10,000 sound fits exceeds.
    /// At least 1, which is the default.
    pub largest_misfit: f64,
}

impl Default for MotorFitSettings {
    fn default() -> Self {
        let operating = OperatingSettings {
            relative_error: 0.02,
            members: 6,
            most_impacts: 500_000,
            ..OperatingSettings::default()
        };
        Self { most_evaluations: 200, operating, members: 32, largest_misfit: 1.0 }
    }
}

/// A parameter, and the part of its range that the measurements allow.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct FittedParameter {
    /// The parameter, and the range that was searched.
    pub range: FitRange,
    /// The data sheet's value (SI).
    pub nominal: f64,
    /// The best value (SI), if there is exactly one accepted range and it has two ends.
    pub value: Option<f64>,
    /// The ranges that the measurements do not exclude with 95 % confidence, in rising order; if there are
    /// several, the data do not decide between them.
    pub accepted: Vec<AcceptedRange>,
}

/// A measured point compared with the fitted motor.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct FittedPoint {
    /// The catalogue speed (rad/s).
    pub printed: f64,
    /// The speed of the fitted motor (rad/s).
    pub fitted: f64,
    /// Standard error of their difference (rad/s).
    pub standard_error: f64,
}

/// Parameters of a motor fitted to run-ups, braking tails and rated points.
///
/// ```
/// use bouncing_disk::core::{Phase, Unobserved};
/// use bouncing_disk::Motor;
/// use bouncing_disk::estimate::{
///     FitParameter, FitRange, MeasuredRun, MeasuredSpeeds, MeasuredTransient, MotorFit, MotorFitSettings,
///     TransientKind,
/// };
/// use bouncing_disk::motor::{TransientSettings, transient};
///
/// // Synthetic: a run of the paper's motor with friction 0.2 instead of the 0.1 in its data sheet. Its clock is off.
/// let sheet = Motor::paper_70_khz();
/// let built = sheet.with(|sheet| sheet.friction = 0.2)?;
/// let settings = TransientSettings { duration: 2.0, intervals: 200, ..TransientSettings::default() };
/// let curve = transient(built.system(), Phase::new(1.0)?, &settings, &Unobserved)?;
/// let times = curve.times.iter().map(|time| time + 0.3).collect();
/// let runs = MeasuredSpeeds::new(vec![MeasuredRun { member: 0, times, speeds: curve.speeds }])?;
/// let measured = MeasuredTransient::new(TransientKind::RunUp, runs);
///
/// let friction = FitRange { parameter: FitParameter::Friction, low: 0.05, high: 1.0 };
/// let settings = MotorFitSettings::default();
/// let fit = MotorFit::new(&sheet, &[], &[measured], &[friction], &settings, &Unobserved)?;
/// let found = fit.estimate(FitParameter::Friction).expect("fitted").value.expect("determined");
/// assert!((found - 0.2).abs() < 0.04);
/// let switched_on = fit.switched_on[0].expect("a run-up");
/// assert!((switched_on.value - 0.3).abs() < 0.05);
/// # Ok::<(), bouncing_disk::estimate::FitError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct MotorFit {
    /// The fitted parameters, in the order of their ranges.
    pub parameters: Vec<FittedParameter>,
    /// The combinations of parameters that the measurements do not determine near the best values, the least uncertain
    /// first.
    pub undetermined: Vec<UndeterminedDirection>,
    /// The motor with the best values, one of many if a combination is undetermined.
    pub motor: Motor,
    /// The points, in the given order.
    pub points: Vec<FittedPoint>,
    /// Time at which the motor was switched on (s), on the clock of the first run of each transient; `None`
    /// for a braking tail.
    pub switched_on: Vec<Option<Estimate>>,
    /// The remaining sum of weighted squares.
    pub misfit: f64,
    /// Its expectation: the number of points and of means of the transients minus the number of determined
    /// directions, at least 0.
    pub degrees_of_freedom: usize,
    /// Number of points of the ranges at which all measurements were computed.
    pub evaluations: usize,
    /// Whether that number sufficed: otherwise more evaluations, or more impacts in each, would narrow the
    /// ranges.
    pub settled: bool,
}

/// The fitted model.
struct Model<'a> {
    nominal: &'a Motor,
    points: &'a [RatedPoint],
    transients: &'a [MeasuredTransient],
    observed: Vec<Observed>,
    /// The transformations that make the means of each transient independent.
    bases: Vec<Basis>,
    ranges: &'a [FitRange],
    settings: &'a MotorFitSettings,
    /// Point and condition of each coordinate that follows the ranges.
    uncertain: Vec<(usize, usize)>,
    /// The speed (rad/s) at which the scale of each point saturates.
    bends: Vec<f64>,
}

/// A speed on a bounded scale: loads that overpower a motor all map to one end of it.
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

impl MotorFit {
    /// Fits the parameters that have a range to points, transients or both. Everything else is taken from the
    /// data sheet.
    ///
    /// The observer's items are the evaluations that the search may use.
    ///
    /// # Errors
    /// [`FitError::Refused`] for measurements that no parameters in their ranges explain, transients with too
    /// few points or without a rise, and speeds with an offset or a drift. [`Error::OutOfRange`] for illegal
    /// settings, points and ranges, and for a parameter that the motor does not have; [`Error::BothGiven`] if
    /// a condition of a point replaces a parameter. The errors of [`operations`](crate::motor::operations).
    pub fn new(
        nominal: &Motor,
        points: &[RatedPoint],
        transients: &[MeasuredTransient],
        ranges: &[FitRange],
        settings: &MotorFitSettings,
        observer: &dyn Observer,
    ) -> Result<Self, FitError> {
        let mut model = Model::new(nominal, (points, transients), ranges, settings)?;
        let watch = Watch::begin(observer, 0, settings.most_evaluations as u64)?;
        let coordinates = ranges.len() + model.uncertain.len();
        let first = if transients.is_empty() { 8 + 6 * coordinates } else { 40 + 40 * coordinates };
        let first = first.min(settings.most_evaluations);
        let mut nodes = design(coordinates, first, settings.operating.seed);
        let mut values = model.compute(&nodes, 0, &watch)?;
        model.bases = model.bases_near(&values)?;
        let mut surface = model.surface(&nodes, &values, None, &watch)?;
        let (profiles, settled) = loop {
            let profiles = surface.profiles(&|| watch.ask().is_ok());
            watch.ask()?;
            let left = settings.most_evaluations - nodes.len();
            // Computing transients at a point takes less time than the search for the point.
            let batch =
                if transients.is_empty() { BATCH.max(1 + coordinates / 2) } else { BATCH_OF_TRANSIENTS };
            let more = surface.doubtful(&profiles, batch.min(left));
            if more.is_empty() {
                let settled = surface.is_settled(&profiles);
                break (profiles, settled);
            }
            values.extend(model.compute(&more, nodes.len(), &watch)?);
            nodes.extend(more);
            surface = model.surface(&nodes, &values, Some(&surface), &watch)?;
        };
        let fit = model.result(&surface, &profiles, (nodes.len(), settled), &watch)?;
        watch.end();
        Ok(fit)
    }

    /// The result for a parameter; `None` if it was not fitted.
    #[must_use]
    pub fn estimate(&self, parameter: FitParameter) -> Option<&FittedParameter> {
        self.parameters.iter().find(|fitted| fitted.range.parameter == parameter)
    }
}

/// Points that fill a cube evenly: multiples of the powers of a generalised golden ratio.
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
        (points, transients): (&'a [RatedPoint], &'a [MeasuredTransient]),
        ranges: &'a [FitRange],
        settings: &'a MotorFitSettings,
    ) -> Result<Self, FitError> {
        let evaluations = settings.most_evaluations;
        check((8..=400).contains(&evaluations), "most_evaluations", evaluations as f64, "[8, 400]")?;
        settings.operating.check()?;
        let multiple = settings.largest_misfit;
        check(multiple >= 1.0 && multiple.is_finite(), "largest_misfit", multiple, "[1, inf)")?;
        let members = settings.members;
        check((16..=4096).contains(&members), "members", members as f64, "[16, 4096]")?;
        check(points.len() + transients.len() > 0, "number of points and transients", 0.0, "[1, 200]")?;
        within_limit("rated points", points.len(), MOST_POINTS)?;
        within_limit("transients", transients.len(), MOST_TRANSIENTS)?;
        check_ranges(nominal, ranges)?;
        let mut uncertain = Vec::new();
        for (index, point) in points.iter().enumerate() {
            point.check(ranges)?;
            let repeats = points[..index].iter().filter(|before| before.has_conditions_of(point)).count();
            check(
                repeats == 0,
                "points under the same conditions",
                (repeats + 1) as f64,
                "1 (replace points under the same conditions by their mean)",
            )?;
            let errors = point.conditions.iter().enumerate().filter(|(_, condition)| condition.error > 0.0);
            uncertain.extend(errors.map(|(condition, _)| (index, condition)));
        }
        within_limit(
            "fitted parameters and uncertain conditions",
            ranges.len() + uncertain.len(),
            MOST_COORDINATES,
        )?;
        let observed = transients.iter().map(|transient| Observed::of(transient, ranges));
        let observed = observed.collect::<Result<Vec<_>, FitError>>()?;
        let (bases, bends) = (Vec::new(), Vec::new());
        let mut model =
            Self { nominal, points, transients, observed, bases, ranges, settings, uncertain, bends };
        let middle = DVector::zeros(ranges.len() + model.uncertain.len());
        for (index, point) in points.iter().enumerate() {
            // All ends of the ranges together, and the sheet's own values.
            for end in [-1.0, 1.0] {
                model.motor(&middle.add_scalar(end), index)?;
            }
            let own = point.motor(nominal, &[])?;
            let bend = own.system().platform().peak_angular_speed().max(point.speed.abs());
            model.bends.push(positive("largest angular speed of the stator", bend)?);
        }
        for transient in 0..transients.len() {
            for end in [-1.0, 1.0] {
                model.run(&middle.add_scalar(end), transient)?;
            }
        }
        Ok(model)
    }

    /// The motor at this point under the conditions of a transient.
    fn run(&self, places: &DVector<f64>, transient: usize) -> Result<Motor, Error> {
        let mut sheet = self.nominal.parameters().clone();
        for (range, place) in self.ranges.iter().zip(places.iter()) {
            range.parameter.set(&mut sheet, range.value_at(*place));
        }
        self.transients[transient].motor(sheet)
    }

    /// The motor at this point under the conditions of a measured point.
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

    /// The coordinates on which a measured point depends.
    fn coordinates_of(&self, point: usize) -> Vec<usize> {
        let own = self.uncertain.iter().enumerate().filter(|(_, (index, _))| *index == point);
        (0..self.ranges.len()).chain(own.map(|(index, _)| self.ranges.len() + index)).collect()
    }

    /// The predicted measurements at these points, after `before` other points.
    fn compute(&self, places: &[DVector<f64>], before: usize, watch: &Watch<'_>) -> Result<Vec<Node>, Error> {
        let of_place = |index: usize| {
            let seed = SplitMix64::seed_of_stream(self.settings.operating.seed, (before + index) as u64);
            let node = self.node(&places[index], seed, watch);
            watch.finish(1);
            node
        };
        let results = in_parallel(places.len(), of_place).into_iter().collect();
        watch.ask()?;
        results
    }

    fn node(&self, place: &DVector<f64>, seed: u64, watch: &Watch<'_>) -> Result<Node, Error> {
        let ask = |_: Progress| watch.ask().map_or(ControlFlow::Break(()), ControlFlow::Continue);
        let mut speeds = Vec::new();
        if !self.points.is_empty() {
            let motors = (0..self.points.len()).map(|point| self.motor(place, point));
            let settings = OperatingSettings { seed, ..self.settings.operating };
            let rows = operations(&motors.collect::<Result<Vec<_>, _>>()?, &settings, &ask)?;
            speeds =
                rows.iter().zip(&self.bends).map(|(row, bend)| response_of(row.operation(), *bend)).collect();
        }
        let transients = self.observed.iter().enumerate().map(|(index, observed)| {
            let seed = SplitMix64::seed_of_stream(seed, index as u64 + 1);
            observed.compute(&self.run(place, index)?, (self.settings.members, seed), &ask)
        });
        Ok(Node { speeds, transients: transients.collect::<Result<_, _>>()? })
    }

    /// For each transient the basis of its means at the computed point nearest to the measurements.
    fn bases_near(&self, nodes: &[Node]) -> Result<Vec<Basis>, Error> {
        let of_transient = |(index, observed): (usize, &Observed)| {
            let all = nodes.iter().enumerate().filter_map(|(node, own)| {
                let computed = &own.transients[index];
                let root = Cholesky::new(computed.covariance(observed))?;
                let turn = DMatrix::identity(observed.means.len(), observed.means.len());
                let basis = Basis { root, turn, node };
                let distance = basis.of(&(computed.mean() - &observed.means)).norm_squared();
                distance.is_finite().then_some((distance, basis))
            });
            let nearest = all.min_by(|one, other| one.0.total_cmp(&other.0)).map(|(_, basis)| basis);
            nearest.ok_or(Error::OutOfRange {
                field: "largest mean speed of a transient",
                value: observed.means.amax(),
                legal: "[1e-150, 1e150] (rad/s)",
            })
        };
        self.observed.iter().enumerate().map(of_transient).collect()
    }

    /// The surface in bases in which its residuals are independent.
    fn surface(
        &mut self,
        places: &[DVector<f64>],
        nodes: &[Node],
        earlier: Option<&Surface>,
        watch: &Watch<'_>,
    ) -> Result<Surface, Error> {
        let surface = self.surface_in(places, nodes, earlier, watch)?;
        if self.bases.is_empty() {
            return Ok(surface);
        }
        let mut first = self.points.len();
        for (basis, observed) in self.bases.iter_mut().zip(&self.observed) {
            let count = observed.means.len();
            let mut covariance = DMatrix::zeros(count, count);
            for (node, place) in places.iter().enumerate() {
                let far = (place - &places[basis.node]).norm_squared();
                let off = surface.left_out(node).rows(first, count).into_owned();
                covariance += &off * off.transpose() * exp(-far / (2.0 * NEAR * NEAR));
            }
            basis.turn(covariance);
            first += count;
        }
        self.surface_in(places, nodes, Some(&surface), watch)
    }

    fn surface_in(
        &self,
        places: &[DVector<f64>],
        nodes: &[Node],
        earlier: Option<&Surface>,
        watch: &Watch<'_>,
    ) -> Result<Surface, Error> {
        let points = self.points.iter().zip(&self.bends).map(|(point, bend)| {
            let error = point.speed_error * bending(point.speed, *bend);
            (bent(point.speed, *bend), error * error + RESOLUTION * RESOLUTION * bend * bend)
        });
        let means = self.observed.iter().zip(&self.bases);
        let means = means.flat_map(|(own, basis)| basis.of(&own.means).iter().copied().collect::<Vec<_>>());
        let measured = points.chain(means.map(|mean| (mean, 0.0))).collect();
        let of_point = (0..self.points.len()).map(|point| self.coordinates_of(point));
        let of_means = self.observed.iter().flat_map(|own| 0..own.means.len());
        let of_means = of_means.map(|_| (0..self.ranges.len()).collect());
        let coordinates = of_point.chain(of_means).collect();
        let values: Vec<Vec<Response>> = nodes
            .iter()
            .map(|node| {
                let transients = node.transients.iter().zip(&self.observed).zip(&self.bases);
                let means =
                    transients.flat_map(|((computed, observed), basis)| computed.responses(observed, basis));
                node.speeds.iter().copied().chain(means).collect()
            })
            .collect();
        let surface =
            Surface::new(self.ranges.len(), measured, coordinates, places, &values, earlier, &|| {
                watch.ask().is_ok()
            });
        watch.ask()?;
        surface.ok_or(Error::OutOfRange { field: "measured speeds", value: f64::NAN, legal: "finite" })
    }

    /// Rejects transients in which an offset or a drift of the speeds explains too much of the squares; the
    /// fitted parameters would otherwise explain part of it.
    fn check_speeds(&self, surface: &Surface, least: f64) -> Result<(), FitError> {
        let mut first = self.points.len();
        for (transient, ((own, observed), basis)) in
            self.transients.iter().zip(&self.observed).zip(&self.bases).enumerate()
        {
            let along = |added: &dyn Fn(f64) -> f64| {
                let own = basis.of(&observed.change(own, added));
                let mut along = DVector::zeros(first + own.len());
                along.rows_mut(first, own.len()).copy_from(&own);
                surface.amount(&along)
            };
            let least = least.max(SIGNIFICANT * SIGNIFICANT);
            let squares = |(amount, error): (f64, f64)| (amount / error) * (amount / error);
            let (added, drifting) = (along(&|_| 1.0), along(&|time| time));
            if squares(added).max(squares(drifting)) > least {
                let ((offset, of_offset), (drift, of_drift)) = (added, drifting);
                return refused(if squares(added) > squares(drifting) {
                    FitRefusal::Offset { transient, offset, standard_error: of_offset }
                } else {
                    FitRefusal::Drift { transient, drift, standard_error: of_drift }
                });
            }
            first += observed.means.len();
        }
        Ok(())
    }

    /// The time at which the motor was switched on, on the clock of the first run of each transient.
    fn switched_on(&self, place: &DVector<f64>, watch: &Watch<'_>) -> Result<Vec<Option<Estimate>>, Error> {
        let node = self.node(place, self.settings.operating.seed, watch)?;
        let all = node.transients.iter().zip(&self.observed).map(|(computed, observed)| {
            let half = &computed.halfway;
            let switched = Estimate {
                value: observed.halfway[0] - mean(half),
                standard_error: standard_deviation(half),
            };
            (!observed.is_braking()).then_some(switched)
        });
        Ok(all.collect())
    }

    fn result(
        &self,
        surface: &Surface,
        profiles: &[Profile],
        (evaluations, settled): (usize, bool),
        watch: &Watch<'_>,
    ) -> Result<MotorFit, FitError> {
        let places = &surface.best;
        let directions = surface.directions();
        let misfit = surface.deviance(places);
        let determined = self.ranges.len() - directions.len();
        let means: usize = self.observed.iter().map(|own| own.means.len()).sum();
        let degrees_of_freedom = (self.points.len() + means).saturating_sub(determined);
        let largest = self.settings.largest_misfit * rare_misfit(degrees_of_freedom.max(1) as f64);
        // The most likely point need not have the least misfit.
        let least =
            profiles.iter().flat_map(|profile| &profile.nodes).map(|node| node.1).fold(misfit, f64::min);
        if least > largest {
            // If an offset or a drift explains the excess, the error names it.
            self.check_speeds(surface, least - largest)?;
            return refused(FitRefusal::Misfit { misfit: least, degrees_of_freedom, largest });
        }
        self.check_speeds(surface, 0.0)?;
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
            FittedParameter {
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
        // Like the data sheet, without the conditions of a point.
        let motor = self.nominal.with(|sheet| {
            for (range, place) in self.ranges.iter().zip(places.iter()) {
                range.parameter.set(sheet, range.value_at(*place));
            }
        })?;
        Ok(MotorFit {
            parameters,
            undetermined: directions
                .iter()
                .map(|(direction, error)| named(self.ranges, direction, *error))
                .collect(),
            motor,
            points: points.collect(),
            switched_on: self.switched_on(places, watch)?,
            misfit,
            degrees_of_freedom,
            evaluations,
            settled,
        })
    }
}

/// The predicted measurements at a point.
struct Node {
    speeds: Vec<Response>,
    transients: Vec<Computed>,
}

impl Computed {
    fn mean(&self) -> DVector<f64> {
        self.means.iter().sum::<DVector<f64>>() / self.means.len() as f64
    }

    /// The factor by which the inverse of an estimated covariance is too large.
    fn widening(&self) -> f64 {
        let (members, means) = (self.means.len() as f64, self.means[0].len() as f64);
        (members - 1.0) / (members - means - 2.0)
    }

    /// The covariance of the means over as many runs as were measured.
    fn covariance(&self, observed: &Observed) -> DMatrix<f64> {
        let (mean, size) = (self.mean(), self.means[0].len());
        let mut sum = DMatrix::zeros(size, size);
        for own in &self.means {
            let off = own - &mean;
            sum += &off * off.transpose();
        }
        let resolution = CURVE_RESOLUTION * observed.means.amax();
        sum * (self.widening() / (self.means.len() - 1) as f64 / observed.runs() as f64)
            + DMatrix::identity(size, size) * (resolution * resolution)
    }

    /// The means, transformed to independent numbers whose variance is one near the truth.
    fn responses(&self, observed: &Observed, basis: &Basis) -> Vec<Response> {
        let members: Vec<DVector<f64>> = self.means.iter().map(|means| basis.of(means)).collect();
        let (mean, count) = (basis.of(&self.mean()), members.len() as f64);
        let resolution = CURVE_RESOLUTION * observed.means.amax();
        let mut least = DVector::zeros(mean.len());
        for column in DMatrix::identity(mean.len(), mean.len()).column_iter() {
            let own = basis.of(&(column * resolution));
            least += own.component_mul(&own);
        }
        let of = |index: usize| {
            let off = members.iter().map(|own| (own[index] - mean[index]) * (own[index] - mean[index]));
            let variance = off.sum::<f64>() / (count - 1.0);
            let scatter = variance * self.widening() / observed.runs() as f64;
            let error = (variance / count).sqrt();
            Response { value: mean[index], error, bias: 0.0, scatter: scatter + least[index] }
        };
        (0..mean.len()).map(of).collect()
    }
}

/// The transformation that makes the means of a transient independent near the truth. It accounts for the
/// scatter of runs, and for the differences between neighbouring motors that no smooth response explains (a
/// motor that locks to a cycle is faster or slower in all windows together).
struct Basis {
    root: Cholesky<f64, Dyn>,
    turn: DMatrix<f64>,
    /// The node near the truth.
    node: usize,
}

impl Basis {
    /// Means, or differences of means, in this basis, in which the means of a run have variance one.
    fn of(&self, means: &DVector<f64>) -> DVector<f64> {
        let mut own = means.clone();
        // The diagonal of a Cholesky factor is positive.
        let _ = self.root.l_dirty().solve_lower_triangular_mut(&mut own);
        &self.turn * own
    }

    /// Rotates the basis so that these differences of means become independent, too.
    fn turn(&mut self, covariance: DMatrix<f64>) {
        self.turn = SymmetricEigen::new(covariance).eigenvectors.transpose() * &self.turn;
    }
}

/// An undetermined direction as changes of the named parameters, scaled so that the largest change is 1.
fn named(ranges: &[FitRange], direction: &DVector<f64>, standard_error: f64) -> UndeterminedDirection {
    let changes = ranges.iter().zip(direction.iter());
    let changes: Vec<_> =
        changes.map(|(range, place)| (range.parameter, place * range.half_width())).collect();
    let largest = changes
        .iter()
        .fold(0.0, |most: f64, (_, change)| if change.abs() > most.abs() { *change } else { most });
    UndeterminedDirection {
        direction: changes.into_iter().map(|(parameter, change)| (parameter, change / largest)).collect(),
        standard_error: standard_error * largest.abs(),
    }
}

/// The misfit that one fit in 10,000 exceeds if its expectation is `expected`, by Wilson and Hilferty's
/// approximation of the chi-squared quantile.
fn rare_misfit(expected: f64) -> f64 {
    let spread = 2.0 / (9.0 * expected);
    let root = 1.0 - spread + RARE * spread.sqrt();
    expected * root * root * root
}

/// The bounded speed of an operation. The bias from its start-up has the same sign at other points.
fn response_of(operation: &Operation, bend: f64) -> Response {
    let Some(point) = operation.point() else {
        return Response {
            value: -bend.copysign(operation.load_torque()),
            error: 0.0,
            bias: 0.0,
            scatter: 0.0,
        };
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
    Response { value: bent(speed, bend), error: of(point.speed.standard_error), bias: of(bias), scatter: 0.0 }
}

#[cfg(test)]
mod tests;
