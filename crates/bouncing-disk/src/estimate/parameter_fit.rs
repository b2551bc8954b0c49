//! Parameters of a motor, with intervals, fitted to its transients at one preload or several; and the
//! combinations of parameters that these transients do not determine.
//!
//! Because the motor is chaotic, the fit compares means of the speed over windows of time, weighted by their
//! scatter; docs/numerics/motors.md, "Parameters from transients", derives the weights, and which parameters
//! transients can determine.

mod bootstrap;
mod contact_time;
pub(crate) mod determined;
mod display;
pub(crate) mod estimate;
pub(crate) mod measured_transient;
mod model;
pub(crate) mod parameter;
mod search;
pub(crate) mod settings;
mod weights;
mod windows;

use bouncing_disk_core::Observer;
use bouncing_disk_core::numerics::statistics::NORMAL_975;
use bouncing_disk_core::run::Watch;
use nalgebra::DVector;

use crate::error::{Error, check, within_limit};
use crate::estimate::interval::IntervalEstimate;
use crate::estimate::parameter_fit::bootstrap::resampled_places;
use crate::estimate::parameter_fit::contact_time::{MOST_TIMES, scan};
use crate::estimate::parameter_fit::estimate::{AcceptedRange, ParameterEstimate, UndeterminedDirection};
use crate::estimate::parameter_fit::measured_transient::MeasuredTransient;
use crate::estimate::parameter_fit::model::{Model, mean_of};
use crate::estimate::parameter_fit::parameter::{FitParameter, FitRange, check_ranges};
use crate::estimate::parameter_fit::search::{Evaluations, Linearised};
use crate::estimate::parameter_fit::settings::ParameterFitSettings;
use crate::estimate::parameter_fit::windows::{INTERVALS, Windows};
use crate::estimate::refusal::{FitError, FitRefusal, refused};
use crate::motor::data_sheet::Motor;
use crate::statistics::percentile;
use crate::statistics::small_sample_widening;

/// Most transients of one fit: more than any experiment has, and a bound on the work.
const MOST_TRANSIENTS: usize = 1_000;

/// The quantile of the normal distribution that one draw in 10,000 exceeds.
const RARE: f64 = 3.719_016_485_455_709;

/// The offset of a clock, in its standard errors, beyond which the fit is refused.
const SIGNIFICANT: f64 = 3.0;

/// A parameter within this share of half its range from an end counts as lying at the end.
const AT_END: f64 = 1.0e-6;

/// Parameters of a motor fitted to its transients.
///
/// ```
/// use bouncing_disk::core::{Phase, Unobserved};
/// use bouncing_disk::Motor;
/// use bouncing_disk::estimate::{
///     FitParameter, FitRange, MeasuredRun, MeasuredSpeeds, MeasuredTransient, ParameterFit,
///     ParameterFitSettings, RunPreload,
/// };
/// use bouncing_disk::motor::{TransientSettings, transient};
///
/// // Synthetic: a run of the paper's motor with a friction of 0.2, where its data sheet says 0.1.
/// let sheet = Motor::paper_70_khz();
/// let built = sheet.with(|sheet| sheet.friction = 0.2)?;
/// let settings = TransientSettings { duration: 2.0, intervals: 200, ..TransientSettings::default() };
/// let curve = transient(built.system(), Phase::new(1.0)?, &settings, &Unobserved)?;
/// let run = MeasuredRun { member: 0, times: curve.times, speeds: curve.speeds };
/// let measured = MeasuredTransient {
///     preload: RunPreload::Acceleration(9.8),
///     runs: MeasuredSpeeds::new(vec![run])?,
///     speed_error: None,
/// };
///
/// let friction = FitRange { parameter: FitParameter::Friction, low: 0.05, high: 1.0 };
/// let settings = ParameterFitSettings::default();
/// let fit = ParameterFit::new(&sheet, &[measured], &[friction], &settings, &Unobserved)?;
/// let found = fit.estimate(FitParameter::Friction).expect("determined");
/// assert!((found.value - 0.2).abs() < 0.04);
/// // Printed, it is a table.
/// assert!(fit.to_string().contains("friction   0.1"));
/// # Ok::<(), bouncing_disk::estimate::FitError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ParameterFit {
    /// The fitted parameters, in the order of their ranges: at least one, and none twice.
    pub parameters: Vec<ParameterEstimate>,
    /// The combinations of parameters that the transients do not determine, as directions in the space of all
    /// fitted parameters, the least uncertain first. The search does not move the motor along such a
    /// direction: its place there is that of the data sheet, or, for a direction that lost its determination
    /// during the search, the place reached by then.
    pub undetermined: Vec<UndeterminedDirection>,
    /// Where the contact time is fitted, the ranges that the transients do not exclude, the shortest times first:
    /// several are not decided between. Its estimate exists if there is one range with two ends. A time at which the
    /// search does not converge is not excluded, and the other parameters then have no estimates.
    pub contact_times: Vec<AcceptedRange>,
    /// The motor with the fitted parameters, at the preload of its data sheet.
    pub motor: Motor,
    /// The remaining weighted sum of squares, not negative.
    pub misfit: f64,
    /// The expected misfit: the number of means minus the number of determined directions, among which a contact
    /// time is not counted.
    pub degrees_of_freedom: usize,
    /// How often the search has computed all motors, at least once.
    pub evaluations: usize,
}

impl ParameterFit {
    /// Fits the parameters that have a range to the transients, which may be at different preloads. Every
    /// other value, including the load, is taken from the data sheet, except the preload, which each
    /// transient has.
    ///
    /// The items of `observer` are the evaluations that the search may spend.
    ///
    /// # Errors
    /// [`FitError::Refused`] with the reason why the fit would be meaningless: too few points, a motor that
    /// stays at rest, times that do not count from the switch-on, a parameter at the end of its range, a
    /// search that does not converge, a model that does not describe the transients. [`Error::NeverLeaves`]
    /// for a motor whose rotor never leaves the stator at the preload of a transient; [`Error::OutOfRange`]
    /// for illegal settings, no transient, no range, two ranges of one parameter, and a range that is illegal
    /// or does not contain the data sheet's value.
    pub fn new(
        nominal: &Motor,
        transients: &[MeasuredTransient],
        ranges: &[FitRange],
        settings: &ParameterFitSettings,
        observer: &dyn Observer,
    ) -> Result<Self, FitError> {
        let model = checked(nominal, transients, ranges, settings)?;
        let scanned = ranges.iter().find(|range| range.parameter == FitParameter::ContactTime);
        let contact_times = if scanned.is_some() { MOST_TIMES } else { 1 };
        let watch = Watch::begin(observer, 0, (contact_times * settings.most_evaluations) as u64)?;
        let fit = if let Some(range) = scanned {
            scan(&model, *range, &watch)?
        } else {
            let mut evaluations = Evaluations { spent: 0, most: settings.most_evaluations };
            let state = Linearised::search(&model, model.start(), &mut evaluations, &watch)?;
            Self::of(&model, &state, evaluations.spent, &watch)?
        };
        watch.end();
        Ok(fit)
    }

    fn of(
        model: &Model<'_>,
        state: &Linearised,
        evaluations: usize,
        watch: &Watch<'_>,
    ) -> Result<Self, FitError> {
        check_clocks(model, state, watch)?;
        let Linearised { places, local, weights, directions } = state;
        let misfit = weights.apply(&(model.measured() - &local.smooth)).norm_squared();
        let degrees_of_freedom = model.statistics().saturating_sub(directions.determined.ncols());
        let widening = widening_for(misfit, degrees_of_freedom, model)?;
        let parameters = Self::estimates(model, state, widening, watch)?;
        let undetermined = directions.undetermined.iter();
        Ok(Self {
            parameters,
            undetermined: undetermined
                .map(|(direction, error)| named(&model.ranges, direction, *error))
                .collect(),
            contact_times: Vec::new(),
            motor: model.motor(places)?,
            misfit,
            degrees_of_freedom,
            evaluations,
        })
    }

    /// The parameters of a search, whose intervals are wider by a factor.
    fn estimates(
        model: &Model<'_>,
        state: &Linearised,
        widening: f64,
        watch: &Watch<'_>,
    ) -> Result<Vec<ParameterEstimate>, FitError> {
        let Linearised { places, local, weights, directions } = state;
        let response = directions.response();
        let resampled = resampled_places(model, local, weights, &response, &mut watch.work())?;
        let mut parameters = Vec::with_capacity(model.ranges.len());
        for (index, range) in model.ranges.iter().enumerate() {
            let (low, high) = (percentile(&resampled[index], 0.025), percentile(&resampled[index], 0.975));
            let place = places[index];
            let mut estimate = None;
            if directions.tells(index, (high - low) / (2.0 * NORMAL_975)) {
                let value = range.value_at(place);
                if place.abs() >= 1.0 - AT_END {
                    return refused(FitRefusal::AtRangeEnd {
                        parameter: range.parameter,
                        value,
                        low: range.low,
                        high: range.high,
                    });
                }
                let end = |from: f64| range.value_at(place + widening * from);
                estimate = Some(IntervalEstimate::about(value, end(low), end(high))?);
            }
            let nominal = range.parameter.of(&model.nominal);
            parameters.push(ParameterEstimate { parameter: range.parameter, nominal, estimate });
        }
        Ok(parameters)
    }

    /// The value and interval of a parameter; `None` if it was not fitted or is not determined.
    #[must_use]
    pub fn estimate(&self, parameter: FitParameter) -> Option<IntervalEstimate> {
        self.parameters.iter().find(|fitted| fitted.parameter == parameter).and_then(|fitted| fitted.estimate)
    }
}

/// The model, if the input is legal.
fn checked<'a>(
    nominal: &Motor,
    transients: &'a [MeasuredTransient],
    ranges: &[FitRange],
    settings: &'a ParameterFitSettings,
) -> Result<Model<'a>, FitError> {
    settings.check()?;
    nominal.system().prescribed()?;
    check(!transients.is_empty(), "number of transients", 0.0, "[1, 1000]")?;
    within_limit("transients", transients.len(), MOST_TRANSIENTS)?;
    check_ranges(nominal, ranges)?;
    // Not every restitution is legal together with a contact time.
    let scanned = ranges.iter().find(|range| range.parameter == FitParameter::ContactTime);
    let lasting =
        nominal.with(|sheet| scanned.iter().for_each(|time| time.parameter.set(sheet, time.high)))?;
    for (range, end) in ranges.iter().flat_map(|range| [(range, range.low), (range, range.high)]) {
        lasting.with(|sheet| range.parameter.set(sheet, end))?;
    }
    let mut windows = Vec::with_capacity(transients.len());
    for transient in transients {
        transient.check_for_fit()?;
        let peak_acceleration = transient.motor(nominal)?.system().peak_acceleration();
        if peak_acceleration <= 1.0 {
            return Err(Error::NeverLeaves { peak_acceleration }.into());
        }
        windows.push(Windows::of(transient, settings.windows, transient.error_variance()?, 0.0));
    }
    Ok(Model { nominal: nominal.clone(), transients, ranges: ranges.to_vec(), settings, windows })
}

/// Refuses transients whose times do not count from the switch-on. To first order an offset of the clock
/// changes the means in proportion to the acceleration; of this change only the part that the fitted
/// parameters cannot imitate shows in the residual.
fn check_clocks(model: &Model<'_>, state: &Linearised, watch: &Watch<'_>) -> Result<(), FitError> {
    let Linearised { places, local, weights, directions } = state;
    let step = |windows: &Windows| windows.duration / INTERVALS as f64;
    let all = || model.windows.iter().zip(model.transients);
    // This step needs no variances of the errors.
    let windows =
        all().map(|(own, transient)| Windows::of(transient, model.settings.windows, 0.0, step(own)));
    let moved =
        Model { windows: windows.collect(), ..model.clone() }.members(std::slice::from_ref(places), watch)?;
    let gained = mean_of(&moved[0]) - mean_of(&local.members);
    let rest = weights.apply(&(model.measured() - &local.smooth));
    let response = directions.response();
    let mut first = 0;
    for (transient, windows) in model.windows.iter().enumerate() {
        let mut along = DVector::zeros(gained.len());
        let own = first..first + windows.count();
        own.for_each(|index| along[index] = gained[index] / step(windows));
        first += windows.count();
        let along = weights.apply(&along);
        let open = &along - &directions.derivatives * (&response * &along);
        let standard_error = sample_widening(model) / open.norm();
        let early = open.dot(&rest) / open.norm_squared();
        if early.abs() > SIGNIFICANT * standard_error {
            return refused(FitRefusal::ShiftedClock { transient, early, standard_error });
        }
    }
    Ok(())
}

/// The factor by which a small number of members, and a large but accepted misfit, widen the intervals.
fn widening_for(misfit: f64, degrees: usize, model: &Model<'_>) -> Result<f64, FitError> {
    let widening = sample_widening(model);
    if degrees == 0 {
        return Ok(widening);
    }
    let expected = degrees as f64;
    let rare = rare_misfit(expected);
    let largest = model.settings.largest_misfit * rare;
    if misfit > largest {
        return refused(FitRefusal::Misfit { misfit, degrees_of_freedom: degrees, largest });
    }
    Ok(if misfit > rare { widening * (misfit / expected).sqrt() } else { widening })
}

/// The misfit that one fit of 10,000 exceeds, whose mean is `expected`: Wilson and Hilferty's approximation of
/// the quantile of chi-squared.
pub(crate) fn rare_misfit(expected: f64) -> f64 {
    let spread = 2.0 / (9.0 * expected);
    let root = 1.0 - spread + RARE * spread.sqrt();
    expected * root * root * root
}

/// The factor by which a small number of computed members widens the intervals: their scatter is uncertain,
/// so are the weights, and scatter and weights come from the same members.
fn sample_widening(model: &Model<'_>) -> f64 {
    let windows = model.windows.iter().map(Windows::count).max().unwrap_or(1) as f64;
    let members = model.settings.members as f64;
    let weights = 1.0 + (windows - 1.0) / (members - windows - 4.0);
    let shared = (members - 1.0) / (members - windows);
    small_sample_widening(model.settings.members) * (weights * shared).sqrt()
}

/// An undetermined direction as changes of the named parameters, the largest change scaled to 1.
pub(crate) fn named(ranges: &[FitRange], direction: &DVector<f64>, error: f64) -> UndeterminedDirection {
    let changes = ranges.iter().zip(direction.iter()).map(|(range, along)| along * range.half_width());
    let changes: Vec<f64> = changes.collect();
    let largest =
        changes.iter().fold(0.0_f64, |most, change| if change.abs() > most.abs() { *change } else { most });
    let direction =
        ranges.iter().zip(&changes).map(|(range, change)| (range.parameter, change / largest)).collect();
    UndeterminedDirection { direction, standard_error: error * largest.abs() }
}

#[cfg(test)]
mod tests;
