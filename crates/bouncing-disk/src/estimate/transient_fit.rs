//! Fits of speed transients that state how far they can be trusted, or why they cannot.
//!
//! The fit is to the mean curve of an ensemble rather than to each member, because the mean of fits to
//! scattered curves is not the fit to their mean. Errors come from resampling. docs/numerics-dynamics.md, "Fits
//! with intervals", derives the method.

mod blocks;
mod members;
mod onset;
mod resamples;
mod shape_grid;

use bouncing_disk_core::numerics::elementary::{exp, ln};
use bouncing_disk_core::numerics::statistics::summing_scale;
use bouncing_disk_core::run::{Watch, WorkCount};
use bouncing_disk_core::{Observer, Unobserved};

use crate::error::{check, within_limit};
use crate::estimate::fit::{ExponentialFit, Saturation, Start};
use crate::estimate::interval::IntervalEstimate;
use crate::estimate::refusal::{FitError, FitRefusal, refused};
use crate::estimate::transient_fit::blocks::Blocks;
use crate::estimate::transient_fit::members::Members;
use crate::estimate::transient_fit::onset::{LEAST_POINTS, rows_before_rise};
use crate::estimate::transient_fit::resamples::{Resampled, Resamples};
use crate::estimate::transient_fit::shape_grid::{Rise, RunSpeeds, ShapeGrid, exponential, ramp};
use crate::motor::batch::members::{MAX_MEMBERS, MAX_SPEEDS};
use crate::motor::rotor::transient::SpeedCurve;
use crate::motor::rotor::transient::{check_curve, check_rows};
use crate::statistics::group_means;

/// Fewest members whose scatter is resampled; with fewer, Student's quantile makes any interval useless.
pub const LEAST_MEMBERS: usize = 5;

/// Fewest points up to the time constant; averages over a quarter of the time constant lose 0.3 % of the rise.
const LEAST_POINTS_OF_RISE: usize = 4;

/// Fewest flights within the time constant: a flying rotor has a constant speed, which looks settled.
const LEAST_FLIGHTS: f64 = 2.0;

/// Curves with more points are averaged in groups before they are fitted.
const MOST_POINTS: usize = 4_096;

/// Ensembles with more members are resampled in groups of neighbours.
const MOST_GROUPS: usize = 512;

/// A rise below this share of the steady speed counts as rounding.
const NO_RISE: f64 = 1.0e-9;

/// The data contradict a start from rest if the fitted initial speed differs from the expected one by more
/// than this multiple of the distance to the end of its interval: three standard errors.
const DENIED: f64 = 1.5;

/// Intervals are widened if the mean over runs deviates from its fit by more than this multiple of its
/// standard error.
const LARGEST_MISFIT: f64 = 2.0;

/// Distance from an end of the search within which a time constant counts as lying at that end.
const AT_LIMIT: f64 = 0.01;

/// Requirements on a curve for a fit with intervals, and the settings of the resampling.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct FitSettings {
    /// Number of resampled curves, in [200, 100000]. Default 1000, with which the ends of an interval scatter
    /// by 5 % of its half width.
    pub resamples: usize,
    /// Seed of the resampling. Default 1.
    pub seed: u64,
    /// Shortest duration of a curve in time constants t_c, in [1, 1000]. Default 3, so 5 % of the rise may be
    /// missing.
    pub least_duration: f64,
    /// Largest root mean square of the residuals, as a share of the steady speed alpha_ss, in (0, 1]. Default
    /// 0.1. Measurement noise counts, too: raise the limit if the noise is known to be larger.
    pub largest_residual: f64,
    /// Whether the times of a measurement count from the instant at which the speed begins to rise from rest.
    /// Default false: time zero, a dead time and the speed at the start are estimated from the record, and
    /// the intervals are wider. A record that contradicts `true` is rejected.
    pub from_rest: bool,
}

impl Default for FitSettings {
    fn default() -> Self {
        Self { resamples: 1_000, seed: 1, least_duration: 3.0, largest_residual: 0.1, from_rest: false }
    }
}

impl FitSettings {
    fn check(&self) -> Result<(), FitError> {
        let resamples = self.resamples as f64;
        check((200..=100_000).contains(&self.resamples), "resamples", resamples, "[200, 100000]")?;
        let least = self.least_duration;
        check((1.0..=1_000.0).contains(&least), "least_duration", least, "[1, 1000] (time constants)")?;
        let largest = self.largest_residual;
        check(largest > 0.0 && largest <= 1.0, "largest_residual", largest, "(0, 1]")?;
        Ok(())
    }
}

/// The fit of one form of rise, with intervals.
///
/// The intervals cover the scatter, but not the error of a form that differs from the motor's.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct RiseEstimate {
    /// Steady speed alpha_ss (rad/s). If the speed still creeps up after the rise, this is the plateau up to
    /// the end of the curve and depends on the duration.
    pub steady_speed: IntervalEstimate,
    /// Time constant t_c of the exponential, or the time t_r in which the ramp rises from rest (s). If the
    /// rise has another form, this is the best constant for a curve of this length and depends on the
    /// duration.
    pub constant: IntervalEstimate,
    /// The paper's stall acceleration alpha_ss/t_c (rad/s^2): an estimate from the run-up without load, not
    /// the load that stops the motor. It depends on the duration, as do alpha_ss and t_c.
    pub stall_acceleration: IntervalEstimate,
    /// Speed (rad/s) at the start time of the fit; `None` if the motor starts from rest at time zero.
    pub start_speed: Option<IntervalEstimate>,
    /// Root mean square of the residuals (rad/s).
    pub residual: f64,
}

/// The form of curve from which a stall acceleration is computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum RiseForm {
    /// alpha_ss (1 - exp(-t/t_c)): stall acceleration alpha_ss/t_c.
    Exponential,
    /// alpha_ss min(t/t_r, 1): stall acceleration alpha_ss/t_r.
    Ramp,
}

/// A fit of a speed transient with 95 % intervals: of the mean over an ensemble's members, or of one measured
/// curve.
///
/// A computed motor starts from rest at time zero. For a measured motor the fit assumes neither, unless
/// [`FitSettings::from_rest`] is set: it fits alpha_ss - b exp(-t/t_c) from the start of the rise on. A later
/// start and a higher initial speed change the same number b. So the fit can state when the curve would have
/// been at rest ([`Self::zero_time`]), but not which of the two applies.
///
/// ```
/// # use bouncing_disk::core::Unobserved;
/// use bouncing_disk::System;
/// use bouncing_disk::estimate::{
///     FitError, FitRefusal, FitSettings, TransientEnsemble, TransientFit,
/// };
/// use bouncing_disk::motor::TransientSettings;
///
/// let motor = System::motor();
/// let settings = TransientSettings { duration: 6.0, intervals: 120, ..TransientSettings::default() };
/// let fit = TransientFit::new(&TransientEnsemble::new(&motor, &settings, 8, &Unobserved)?.curves, &FitSettings::default())?;
/// assert!(fit.steady_speed().low > 15.0 && fit.steady_speed().high < 23.0);
///
/// // Too short: the speed still rises at the end.
/// let settings = TransientSettings { duration: 0.4, intervals: 120, ..TransientSettings::default() };
/// let refused = TransientFit::new(&TransientEnsemble::new(&motor, &settings, 8, &Unobserved)?.curves, &FitSettings::default());
/// assert!(matches!(refused, Err(FitError::Refused(_))));
/// # Ok::<(), bouncing_disk::estimate::FitError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct TransientFit {
    /// The fit of alpha_ss (1 - exp(-t/t_c)), or of alpha_ss - b exp(-t/t_c).
    pub exponential: RiseEstimate,
    /// The fit of alpha_ss min(t/t_r, 1), or of alpha_ss - b max(1 - t/t_r, 0); `None` if the curve does not
    /// determine t_r.
    pub ramp: Option<RiseEstimate>,
    /// The form with the smaller residual.
    pub form: RiseForm,
    /// Time (s) of the first fitted row; 0 for a start from rest. The rows before it have constant speed:
    /// they precede the switch-on or fall in a dead time.
    pub start_time: f64,
    /// Last time of the curve (s), where the fit ends.
    pub duration: f64,
    /// Number of points of the curve; for several runs with different times, of all runs.
    pub points: usize,
    /// Number of members whose mean was fitted; 1 for a single measured curve.
    pub members: usize,
}

impl TransientFit {
    /// Steady speed alpha_ss (rad/s) of the exponential.
    #[must_use]
    pub const fn steady_speed(&self) -> IntervalEstimate {
        self.exponential.steady_speed
    }

    /// Time constant t_c (s) of the exponential.
    #[must_use]
    pub const fn time_constant(&self) -> IntervalEstimate {
        self.exponential.constant
    }

    /// The paper's stall acceleration alpha_ss/t_c (rad/s^2) of the exponential: an estimate, not the load
    /// that stops the motor.
    #[must_use]
    pub const fn stall_acceleration(&self) -> IntervalEstimate {
        self.exponential.stall_acceleration
    }

    /// The fit of the form with the smaller residual. If that is the ramp, the exponential may rise on to a
    /// steady speed that no motor reaches.
    #[must_use]
    pub fn better(&self) -> &RiseEstimate {
        self.ramp.as_ref().filter(|_| self.form == RiseForm::Ramp).unwrap_or(&self.exponential)
    }

    /// The speed of the better form (rad/s) at `time` (s), not before [`Self::start_time`].
    #[must_use]
    pub fn better_speed(&self, time: f64) -> f64 {
        let own = self.better();
        let start = own.start_speed.map_or(0.0, |start| start.value);
        let rise = own.steady_speed.value - start;
        // The ramp's time constant is for a rise from rest.
        let (shape, constant): (fn(f64) -> f64, f64) = match self.form {
            RiseForm::Exponential => (exponential, own.constant.value),
            RiseForm::Ramp => (ramp, own.constant.value * (rise / own.steady_speed.value)),
        };
        start + rise * shape((time - self.start_time) / constant)
    }

    /// The speed of the fitted exponential (rad/s) at `time` (s), not before [`Self::start_time`].
    #[must_use]
    pub fn speed(&self, time: f64) -> f64 {
        let steady = self.exponential.steady_speed.value;
        let start = self.exponential.start_speed.map_or(0.0, |start| start.value);
        start + (steady - start) * exponential((time - self.start_time) / self.exponential.constant.value)
    }

    /// The time (s) at which the fitted exponential is at rest: the switch-on and its dead time, if the motor
    /// rises from rest. Minus infinity if it starts at or above its steady speed.
    #[must_use]
    pub fn zero_time(&self) -> f64 {
        let start = self.exponential.start_speed.map_or(0.0, |start| start.value);
        let left = 1.0 - start / self.exponential.steady_speed.value;
        let behind = if left > 0.0 { ln(left) } else { f64::NEG_INFINITY };
        self.start_time + self.exponential.constant.value * behind
    }

    /// Fits the mean curve of the members of a computed ensemble, which start from rest at time zero.
    /// Intervals come from resampling the members: at least [`LEAST_MEMBERS`] curves with equal times.
    ///
    /// Curves of more than 4096 points are first averaged in groups of points; more than 512 members are
    /// resampled in groups of neighbours.
    ///
    /// # Errors
    /// [`FitError::Refused`] with the reason why the fit would be meaningless;
    /// [`Error::OutOfRange`](crate::Error::OutOfRange) for illegal settings, curves that cannot be fitted, or
    /// times that differ between members; an error of the core for more than [`MAX_MEMBERS`] members or more
    /// than [`MAX_SPEEDS`] speeds in total.
    pub fn new(members: &[SpeedCurve], settings: &FitSettings) -> Result<Self, FitError> {
        settings.check()?;
        let times = members.first().map_or(&[] as &[f64], |curve| &curve.times);
        for curve in members {
            let (own, first) = (&curve.times, times);
            check(own.len() == first.len(), "number of times", own.len() as f64, "equal for all members")?;
            for (&own, first) in own.iter().zip(first) {
                check(own.total_cmp(first).is_eq(), "time of a member (s)", own, "equal for all members")?;
            }
            check_curve(own, &curve.speeds)?;
        }
        let runs: Vec<_> = members.iter().map(|curve| (times, curve.speeds.as_slice())).collect();
        let flights: f64 = members.iter().map(|curve| curve.impacts as f64 + curve.separations as f64).sum();
        let watch = Watch::begin(&Unobserved, 0, 2 * settings.resamples as u64)?;
        let rows = Rows::of(&runs, Some(flights / members.len() as f64), &mut watch.work())?;
        rows.fit(Start::FromRest, settings, &mut watch.work())
    }

    /// The fit of measured runs, each with its times (s, rising, possibly below zero) and speeds (rad/s). The
    /// intervals of a single run come from its residuals, whose noise may be correlated and vary along the
    /// curve; those of at least [`LEAST_MEMBERS`] runs come from their scatter.
    ///
    /// The observer's items are the resampled curves, once for each form.
    ///
    /// # Errors
    /// The errors of [`Self::new`]; [`FitRefusal::NotFromRest`] if the settings assume a start from rest and
    /// the runs contradict this.
    pub fn of_measured(
        runs: &[(&[f64], &[f64])],
        settings: &FitSettings,
        observer: &dyn Observer,
    ) -> Result<Self, FitError> {
        settings.check()?;
        for (times, speeds) in runs {
            if settings.from_rest { check_curve(times, speeds) } else { check_rows(times, speeds) }?;
        }
        let fits = if settings.from_rest { 4 } else { 2 };
        let watch = Watch::begin(observer, 0, fits * settings.resamples as u64)?;
        let mut work = watch.work();
        let rows = Rows::of(runs, None, &mut work)?;
        let fit = if settings.from_rest {
            let free = rows.fit(Start::AnySpeed, settings, &mut work);
            let fit = rows.fit(Start::FromRest, settings, &mut work)?;
            match free {
                Ok(free) => fit.refuse_other_start(&free)?,
                Err(FitError::Refused(_)) => {}
                Err(other) => return Err(other),
            }
            fit
        } else {
            rows.fit(Start::AnySpeed, settings, &mut work)?
        };
        watch.end();
        Ok(fit)
    }

    /// Rejects a start from rest that contradicts a fit without this assumption.
    fn refuse_other_start(&self, free: &Self) -> Result<(), FitError> {
        let (own, other, shape): (_, _, fn(f64) -> f64) = match free.form {
            RiseForm::Exponential => (Some(self.exponential), Some(free.exponential), exponential),
            RiseForm::Ramp => (self.ramp, free.ramp, ramp),
        };
        let (Some(own), Some(start)) = (own, other.and_then(|rise| rise.start_speed)) else { return Ok(()) };
        let by = own.steady_speed.value * shape(free.start_time / own.constant.value) - start.value;
        let reach = if by > 0.0 { start.high - start.value } else { start.value - start.low };
        if by.abs() > DENIED * reach {
            let (zero_time, start_time) = (free.zero_time(), free.start_time);
            return refused(FitRefusal::NotFromRest { start_time, start_speed: start, zero_time });
        }
        Ok(())
    }
}

/// The form with the smaller residual.
fn better_form(exponential: &RiseEstimate, ramp: Option<&RiseEstimate>) -> RiseForm {
    match ramp {
        Some(ramp) if ramp.residual < exponential.residual => RiseForm::Ramp,
        _ => RiseForm::Exponential,
    }
}

/// The fitted runs and their mean; speeds are multiplied by `scale`.
struct Rows {
    runs: Vec<RunSpeeds>,
    /// Means over groups of neighbouring rows, as many per group as there are runs. If the runs have equal
    /// times, the rows of a group have the same time.
    times: Vec<f64>,
    speeds: Vec<f64>,
    have_same_times: bool,
    scale: f64,
    members: usize,
    points: usize,
    /// Number of flights of a computed member, or 0.
    flights: f64,
}

impl Rows {
    /// The rows of legal curves. If the number of flights is known, the curves are computed ones.
    fn of(
        curves: &[(&[f64], &[f64])],
        flights: Option<f64>,
        work: &mut WorkCount<'_>,
    ) -> Result<Self, FitError> {
        let members = curves.len();
        if members < LEAST_MEMBERS && (members != 1 || flights.is_some()) {
            return refused(FitRefusal::TooFewMembers { members, least: LEAST_MEMBERS });
        }
        within_limit("members of an ensemble", members, MAX_MEMBERS)?;
        let all: usize = curves.iter().map(|(times, _)| times.len()).sum();
        within_limit("speeds of an ensemble", all, MAX_SPEEDS)?;
        let largest =
            |(_, speeds): &(&[f64], &[f64])| speeds.iter().fold(0.0_f64, |most, speed| most.max(speed.abs()));
        let scale = summing_scale(&curves.iter().map(largest).collect::<Vec<_>>());
        let have_same_times = curves.iter().all(|(times, _)| *times == curves[0].0);
        let groups = if have_same_times { members.min(MOST_GROUPS) } else { members };
        let mut runs: Vec<RunSpeeds> = Vec::with_capacity(groups);
        for (member, (times, speeds)) in curves.iter().enumerate() {
            let group = times.len().div_ceil(MOST_POINTS);
            let own = group_means(speeds, group, scale);
            if member * groups / members < runs.len() {
                let run = &mut runs[member * groups / members];
                run.weight += 1.0;
                run.speeds.iter_mut().zip(&own).for_each(|(mean, own)| *mean += (own - *mean) / run.weight);
            } else {
                let unit = summing_scale(times);
                let times = group_means(times, group, unit).iter().map(|time| time / unit).collect();
                runs.push(RunSpeeds { times, speeds: own, weight: 1.0 });
            }
            work.spend(1 + speeds.len() as u64 / 64)?;
        }
        let points = if have_same_times { curves[0].0.len() } else { all };
        let mut rows = Self {
            runs,
            times: Vec::new(),
            speeds: Vec::new(),
            have_same_times,
            scale,
            members,
            points,
            flights: flights.unwrap_or(0.0),
        };
        rows.average();
        Ok(rows)
    }

    /// The weight, time and speed of every row of all runs, sorted by time.
    fn sorted(&self) -> Vec<[f64; 3]> {
        let of = |run: &RunSpeeds| {
            let rows = run.times.iter().zip(&run.speeds).map(|(&time, &speed)| [run.weight, time, speed]);
            rows.collect::<Vec<_>>()
        };
        let mut rows: Vec<[f64; 3]> = self.runs.iter().flat_map(of).collect();
        if self.runs.len() > 1 {
            rows.sort_by(|a, b| a[1].total_cmp(&b[1]));
        }
        rows
    }

    fn average(&mut self) {
        let unit = summing_scale(&self.runs[0].times);
        for rows in self.sorted().chunks(self.runs.len()) {
            let weight: f64 = rows.iter().map(|row| row[0]).sum();
            let mean =
                |of: &dyn Fn(&[f64; 3]) -> f64| rows.iter().map(|row| row[0] * of(row)).sum::<f64>() / weight;
            let is_one = rows.iter().all(|row| row[1].total_cmp(&rows[0][1]).is_eq());
            self.times.push(if is_one { rows[0][1] } else { mean(&|row| row[1] * unit) / unit });
            self.speeds.push(mean(&|row| row[2]));
        }
    }

    /// The ratio of the residual of the mean curve to its standard error if it is so large that the curve has
    /// another form, otherwise 1.
    fn misfit(&self, of: impl Fn(f64) -> f64, from: f64, parameters: usize) -> f64 {
        let (mut residual, mut expected, mut points) = (0.0, 0.0, 0.0);
        let runs = self.runs.len();
        for rows in self.sorted().chunks_exact(runs).filter(|rows| rows[0][1] >= from) {
            let differences: Vec<f64> = rows.iter().map(|row| row[2] - of(row[1])).collect();
            let mean = differences.iter().sum::<f64>() / runs as f64;
            let squares: f64 = differences.iter().map(|own| (own - mean) * (own - mean)).sum();
            expected += squares / (runs * (runs - 1)) as f64;
            residual += mean * mean;
            points += 1.0;
        }
        let misfit = (residual * points / ((points - parameters as f64) * expected)).sqrt();
        if misfit > LARGEST_MISFIT && misfit.is_finite() { misfit } else { 1.0 }
    }

    fn fit(
        &self,
        start: Start,
        settings: &FitSettings,
        work: &mut WorkCount<'_>,
    ) -> Result<TransientFit, FitError> {
        let before = if start == Start::AnySpeed && self.times.len() > LEAST_POINTS {
            rows_before_rise(&self.times, &self.speeds, work)?
        } else {
            0
        };
        let start_time = if start == Start::AnySpeed { self.times[before] } else { 0.0 };
        let times: Vec<f64> = self.times[before..].iter().map(|time| time - start_time).collect();
        let part = FittedRows { rows: self, start, start_time, times, speeds: &self.speeds[before..] };
        let curve = Saturation::of(&part.times, part.speeds, exponential, start, work)?;
        if let Err(reason) = part.judge(&curve, settings) {
            return refused(reason);
        }
        let exponential = part.rise(exponential, &curve, settings, work)?.or_else(refused)?;
        let duration = part.times[part.times.len() - 1];
        if exponential.constant.high >= duration {
            let time_constant = exponential.constant.high;
            return refused(FitRefusal::TooShort { duration, time_constant, least: 1.0 });
        }
        let curve = Saturation::of(&part.times, part.speeds, ramp, start, work)?;
        // A ramp that lasts to the end of the curve, or ends before its second point, does not count.
        let is_ramp =
            curve.constant < duration && curve.constant > part.times[1] && curve.rise / curve.steady > 0.0;
        let ramp = if is_ramp { part.rise(ramp, &curve, settings, work)?.ok() } else { None };
        Ok(TransientFit {
            form: better_form(&exponential, ramp.as_ref()),
            exponential,
            ramp,
            start_time,
            duration: self.times[self.times.len() - 1],
            points: self.points,
            members: self.members,
        })
    }
}

/// The fitted part of the rows: from the start of the rise, which is time zero.
struct FittedRows<'r> {
    rows: &'r Rows,
    start: Start,
    start_time: f64,
    times: Vec<f64>,
    speeds: &'r [f64],
}

impl FittedRows<'_> {
    /// Whether the fit of the mean curve is meaningful.
    fn judge(&self, fit: &Saturation, settings: &FitSettings) -> Result<(), FitRefusal> {
        let times = &self.times;
        let (points, last, time_constant) = (times.len(), times[times.len() - 1], fit.constant);
        if points < LEAST_POINTS {
            return Err(FitRefusal::TooFewPoints { points, least: LEAST_POINTS });
        }
        if fit.rise.abs() <= NO_RISE * fit.steady.abs() {
            return Err(FitRefusal::NoRise);
        }
        let (shortest, longest) = ExponentialFit::searched(times);
        if time_constant <= shortest * (1.0 + AT_LIMIT) || time_constant >= longest * (1.0 - AT_LIMIT) {
            return Err(FitRefusal::AtSearchLimit { time_constant, shortest, longest });
        }
        let least = settings.least_duration;
        if last < least * time_constant {
            return Err(FitRefusal::TooShort { duration: last, time_constant, least });
        }
        let rising = times.iter().filter(|&&time| time <= time_constant).count();
        if rising < LEAST_POINTS_OF_RISE {
            let least = LEAST_POINTS_OF_RISE;
            return Err(FitRefusal::TooCoarse { points: rising, time_constant, least });
        }
        let flights = self.rows.flights * (time_constant / last);
        if self.rows.flights > 0.0 && flights < LEAST_FLIGHTS {
            return Err(FitRefusal::TooFewFlights { flights, time_constant, least: LEAST_FLIGHTS });
        }
        let largest = settings.largest_residual;
        if fit.residual > largest * fit.steady.abs() {
            return Err(FitRefusal::Residual {
                residual: fit.residual / self.rows.scale,
                steady_speed: fit.steady / self.rows.scale,
                largest,
            });
        }
        Ok(())
    }

    /// The rows of a run from the start on.
    fn of_run(&self, run: &RunSpeeds) -> RunSpeeds {
        let before = run.times.iter().take_while(|&&time| time < self.start_time).count();
        let (times, speeds) = (run.times[before..].to_vec(), run.speeds[before..].to_vec());
        RunSpeeds { times, speeds, weight: run.weight }
    }

    /// The fit of a form with its intervals.
    fn rise(
        &self,
        shape: fn(f64) -> f64,
        fit: &Saturation,
        settings: &FitSettings,
        work: &mut WorkCount<'_>,
    ) -> Result<Result<RiseEstimate, FitRefusal>, FitError> {
        let grid = ShapeGrid::new(fit.constant, shape, self.start);
        let at = |time: f64, constant: f64| fit.steady - fit.rise * (1.0 - shape(time / constant));
        let parameters = if self.start == Start::AnySpeed { 3 } else { 2 };
        let runs: Vec<RunSpeeds> = self.rows.runs.iter().map(|run| self.of_run(run)).collect();
        let runs: Vec<RunSpeeds> = runs.into_iter().filter(|run| !run.times.is_empty()).collect();
        let sample: Box<dyn Resampled> = if let [run] = runs.as_slice() {
            let row =
                |of: &dyn Fn(f64) -> f64| run.times.iter().map(|time| of(time - self.start_time)).collect();
            let fitted: Vec<f64> = row(&|time| at(time, fit.constant));
            let step = 1.0e-6;
            let mut derivatives: Vec<Vec<f64>> = vec![
                row(&|time| shape(time / fit.constant)),
                row(&|time| (at(time, fit.constant * (1.0 + step)) - at(time, fit.constant)) / step),
            ];
            if self.start == Start::AnySpeed {
                derivatives.push(vec![1.0; run.times.len()]);
            }
            match Blocks::new(run, self.start_time, &fitted, &derivatives, &grid, work)? {
                Ok(blocks) => Box::new(blocks),
                Err(refusal) => return Ok(Err(refusal)),
            }
        } else {
            // A computed motor has its own form, which the fit does not claim to match.
            let is_measured = self.rows.flights <= 0.0;
            let curve = |time: f64| at(time - self.start_time, fit.constant);
            let misfit = if is_measured { self.rows.misfit(curve, self.start_time, parameters) } else { 1.0 };
            Box::new(Members::new(&runs, self.start_time, misfit, &grid, work)?)
        };
        Ok(match Resamples::draw(&grid, sample.as_ref(), settings.resamples, settings.seed, work)? {
            Ok(resamples) => Ok(self.estimate(shape(2.0) >= 1.0, fit, &resamples)?),
            Err(refusal) => Err(refusal),
        })
    }

    /// The values of a fit with the intervals of its resamples.
    fn estimate(
        &self,
        is_ramp: bool,
        fit: &Saturation,
        resamples: &Resamples,
    ) -> Result<RiseEstimate, FitError> {
        let (scale, centre) = (self.rows.scale, resamples.centre());
        // If rows do not have equal times, their mean deviates from its fit; all rows together do not.
        let Rise { steady, rise, log_constant } = if self.rows.have_same_times {
            Rise { steady: fit.steady, rise: fit.rise, log_constant: ln(fit.constant) }
        } else {
            centre
        };
        let constant = if self.rows.have_same_times { fit.constant } else { exp(log_constant) };
        // A ramp that starts at a non-zero speed would take another time to rise from rest.
        let is_part = is_ramp && self.start == Start::AnySpeed;
        let from_rest =
            |own: &Rise| if is_part { (own.steady / own.rise).max(f64::MIN_POSITIVE) } else { 1.0 };
        let own = Rise { steady, rise, log_constant };
        let (low, high) = resamples.about(steady, &|own| own.steady);
        let steady_speed = IntervalEstimate::about(steady / scale, low / scale, high / scale)?;
        let constant = constant * from_rest(&own);
        let log = ln(constant);
        let (low, high) = resamples.about(log, &|own| own.log_constant + ln(from_rest(own)));
        let time_constant = IntervalEstimate::about(constant, exp(low), exp(high))?;
        // Take the quotient by the fit's constant, so that times of any size neither overflow nor vanish.
        let quotient = |own: &Rise| own.steady * exp(log - own.log_constant) / from_rest(own);
        let (low, high) = resamples.about(steady, &quotient);
        let [value, low, high] = [steady, low, high].map(|speed| speed / scale / constant);
        let stall_acceleration = IntervalEstimate::about(value, low, high)?;
        let start = steady - rise;
        let (low, high) = resamples.about(start, &|own| own.steady - own.rise);
        let start_speed = IntervalEstimate::about(start / scale, low / scale, high / scale)?;
        Ok(RiseEstimate {
            steady_speed,
            constant: time_constant,
            stall_acceleration,
            start_speed: (self.start == Start::AnySpeed).then_some(start_speed),
            residual: fit.residual / scale,
        })
    }
}

#[cfg(test)]
mod motor_tests;
#[cfg(test)]
mod tests;
