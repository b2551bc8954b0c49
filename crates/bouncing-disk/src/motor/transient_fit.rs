//! Fits of speed transients that say how far they can be trusted, or why they cannot.
//!
//! The mean curve of an ensemble is fitted, not its members one by one: the mean of fits to curves that scatter is not the
//! fit to what they scatter about. Errors come from resampling. docs/numerics/motors.md, "Fits with intervals", derives
//! how.

mod blocks;
mod members;
mod resamples;
mod shape_grid;

use bouncing_disk_core::numerics::statistics::summing_scale;
use bouncing_disk_core::{Observer, Unobserved, Watch, WorkCount, read_checked};

use self::blocks::Blocks;
use self::members::Members;
use self::resamples::{Intervals, Resampled, Resamples};
use self::shape_grid::{ShapeGrid, exponential, ramp};
use crate::error::{Error, check, not_negative, positive, within_limit};
use crate::motor::ensemble::{MAX_MEMBERS, MAX_SPEEDS};
use crate::motor::fit::{ExponentialFit, RampFit, check_curve};
use crate::motor::fit_refusal::FitRefusal;
use crate::motor::interval_estimate::IntervalEstimate;
use crate::motor::statistics::RiseForm;
use crate::motor::transient::SpeedCurve;

/// The fewest members whose scatter is resampled: with fewer, Student's quantile makes any interval useless.
pub const LEAST_MEMBERS: usize = 5;

/// The fewest points of a curve that is fitted.
const LEAST_POINTS: usize = 8;

/// The fewest points up to the time constant: intervals of a fourth of it lose 0.3 % of the rise by their averaging.
const LEAST_POINTS_OF_RISE: usize = 4;

/// The fewest flights within the time constant: the speed of a rotor that flies is constant, which looks like one that has
/// settled.
const LEAST_FLIGHTS: f64 = 2.0;

/// Curves of more points are averaged in groups before they are fitted.
const MOST_POINTS: usize = 4_096;

/// Ensembles of more members are resampled in groups of neighbours.
const MOST_GROUPS: usize = 512;

/// How near an end of the search a time constant is taken to lie at it.
const AT_LIMIT: f64 = 0.01;

/// What a fit with intervals asks of a curve, and how it is resampled.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedSettings"))]
pub struct FitSettings {
    /// Number of resampled curves, in [200, 100000]. Default 1000: the ends of an interval then scatter by 5 % of its
    /// half width.
    pub resamples: usize,
    /// Seed of the resampling. Default 1.
    pub seed: u64,
    /// The fewest time constants t_c that a curve must last, in [1, 1000]. Default 3: 5 % of the rise may be missing.
    pub least_duration: f64,
    /// The largest root mean square of the residuals, as a share of the steady speed alpha_ss, in (0, 1]. Default 0.1. Noise of
    /// a measurement counts, too: raise it where the noise is known to be larger.
    pub largest_residual: f64,
}

impl Default for FitSettings {
    fn default() -> Self {
        Self { resamples: 1_000, seed: 1, least_duration: 3.0, largest_residual: 0.1 }
    }
}

impl FitSettings {
    fn check(&self) -> Result<(), Error> {
        let resamples = self.resamples as f64;
        check((200..=100_000).contains(&self.resamples), "resamples", resamples, "[200, 100000]")?;
        let least = self.least_duration;
        check((1.0..=1_000.0).contains(&least), "least_duration", least, "[1, 1000] (time constants)")?;
        let largest = self.largest_residual;
        check(largest > 0.0 && largest <= 1.0, "largest_residual", largest, "(0, 1]")?;
        Ok(())
    }
}

read_checked!(FitSettings as UncheckedSettings {
    resamples: usize,
    seed: u64,
    least_duration: f64,
    largest_residual: f64,
});

/// The rise of one form, with intervals.
///
/// The intervals hold the error of the scatter, not that of a form which is not the motor's.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedRise"))]
pub struct RiseEstimate {
    /// Steady speed alpha_ss (rad/s). It depends on the duration where the speed creeps on after the rise: it is
    /// the plateau up to the end of the curve.
    pub steady_speed: IntervalEstimate,
    /// Time constant t_c of the exponential, or the time t_r at which the ramp ends (s). It depends on the duration
    /// where the rise has another form: it is the constant that is best on the whole for a curve of this length.
    pub constant: IntervalEstimate,
    /// The paper's stall acceleration alpha_ss/t_c (rad/s^2): an estimate from the run-up without a load, not the load that
    /// stops the motor. It depends on the duration as both of its parts do.
    pub stall_acceleration: IntervalEstimate,
    /// Root mean square of the residuals (rad/s).
    pub residual: f64,
}

impl RiseEstimate {
    fn check(&self) -> Result<(), Error> {
        positive("constant", self.constant.low)?;
        not_negative("residual", self.residual)?;
        Ok(())
    }

    fn new(intervals: Intervals, residual: f64) -> Result<Self, Error> {
        let Intervals { steady_speed, constant, stall_acceleration } = intervals;
        let rise = Self { steady_speed, constant, stall_acceleration, residual };
        rise.check()?;
        Ok(rise)
    }
}

read_checked!(RiseEstimate as UncheckedRise {
    steady_speed: IntervalEstimate,
    constant: IntervalEstimate,
    stall_acceleration: IntervalEstimate,
    residual: f64,
});

/// A fit of a speed transient with 95 % intervals: of the mean over an ensemble's members, or of one measured curve.
///
/// Times count from the instant at which the motor is switched on, and it starts from rest.
///
/// ```
/// use bouncing_disk::{Error, FitRefusal, FitSettings, System, TransientFit, TransientSettings, ensemble};
///
/// let motor = System::motor();
/// let settings = TransientSettings { duration: 6.0, intervals: 120, ..TransientSettings::default() };
/// let fit = TransientFit::new(&ensemble(&motor, &settings, 8)?.curves, &FitSettings::default())?;
/// assert!(fit.steady_speed().low > 15.0 && fit.steady_speed().high < 23.0);
///
/// // Too short for any statement: the speed still rises at the end.
/// let settings = TransientSettings { duration: 0.4, intervals: 120, ..TransientSettings::default() };
/// let refused = TransientFit::new(&ensemble(&motor, &settings, 8)?.curves, &FitSettings::default());
/// assert!(matches!(refused, Err(Error::FitRefused { .. })));
/// # Ok::<(), bouncing_disk::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedFit"))]
pub struct TransientFit {
    /// The fit of alpha_ss (1 - exp(-t/t_c)).
    pub exponential: RiseEstimate,
    /// The fit of alpha_ss min(t/t_r, 1); `None` where the curve does not determine t_r.
    pub ramp: Option<RiseEstimate>,
    /// The form that leaves the smaller residual.
    pub form: RiseForm,
    /// Last time of the curve (s): what was fitted ends here.
    pub duration: f64,
    /// Points of the curve.
    pub points: usize,
    /// Members whose mean was fitted; 1 for a single measured curve.
    pub members: usize,
}

read_checked!(TransientFit as UncheckedFit {
    exponential: RiseEstimate,
    ramp: Option<RiseEstimate>,
    form: RiseForm,
    duration: f64,
    points: usize,
    members: usize,
});

impl TransientFit {
    fn check(&self) -> Result<(), Error> {
        positive("duration", self.duration)?;
        check(self.points >= LEAST_POINTS, "points", self.points as f64, "[8, inf)")?;
        let members = self.members as f64;
        check(self.members == 1 || self.members >= LEAST_MEMBERS, "members", members, "1 or [5, inf)")?;
        let form = better_form(&self.exponential, self.ramp.as_ref());
        check(
            self.form == form,
            "form (0: exponential, 1: ramp)",
            f64::from(self.form == RiseForm::Ramp),
            "the form with the smaller residual",
        )?;
        Ok(())
    }

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

    /// The paper's stall acceleration alpha_ss/t_c (rad/s^2) of the exponential: an estimate, not the load that stops
    /// the motor.
    #[must_use]
    pub const fn stall_acceleration(&self) -> IntervalEstimate {
        self.exponential.stall_acceleration
    }

    /// Fits the mean curve of the members of an ensemble, with intervals by resampling the members: at least
    /// [`LEAST_MEMBERS`] curves with the same times.
    ///
    /// Curves of more than 4096 points are averaged in groups of points first; more than 512 members are resampled in groups
    /// of neighbours.
    ///
    /// # Errors
    /// [`Error::FitRefused`] says why the fit would mean nothing; [`Error::OutOfRange`] names illegal settings, curves that
    /// cannot be fitted, or times that differ between members; an error of the core for more than
    /// [`MAX_MEMBERS`] members or more than [`MAX_SPEEDS`] speeds of all together.
    pub fn new(members: &[SpeedCurve], settings: &FitSettings) -> Result<Self, Error> {
        Self::new_observed(members, settings, &Unobserved)
    }

    /// [`Self::new`] with an observer; the items are the resampled curves, once for each form.
    ///
    /// # Errors
    /// Those of [`Self::new`]; an error of the core ([`Stopped`](bouncing_disk_core::Error::Stopped)) if the observer
    /// breaks.
    pub fn new_observed(
        members: &[SpeedCurve],
        settings: &FitSettings,
        observer: &dyn Observer,
    ) -> Result<Self, Error> {
        let times = members.first().map_or(&[] as &[f64], |curve| &curve.times);
        for curve in members {
            check_times(times, &curve.times)?;
        }
        let runs: Vec<&[f64]> = members.iter().map(|curve| curve.speeds.as_slice()).collect();
        let flights: f64 = members.iter().map(|curve| curve.impacts as f64 + curve.separations as f64).sum();
        Self::of_members(times, &runs, flights / members.len() as f64, settings, observer)
    }

    /// [`Self::new`] of runs that were measured at the same times (s), each with its speeds (rad/s).
    ///
    /// # Errors
    /// Those of [`Self::new`].
    pub fn of_runs(times: &[f64], runs: &[&[f64]], settings: &FitSettings) -> Result<Self, Error> {
        Self::of_runs_observed(times, runs, settings, &Unobserved)
    }

    /// [`Self::of_runs`] with an observer, as [`Self::new_observed`].
    ///
    /// # Errors
    /// Those of [`Self::new_observed`].
    pub fn of_runs_observed(
        times: &[f64],
        runs: &[&[f64]],
        settings: &FitSettings,
        observer: &dyn Observer,
    ) -> Result<Self, Error> {
        Self::of_members(times, runs, 0.0, settings, observer)
    }

    /// The mean of runs whose members flew so often on the way; 0 where that is not known, or where none left the stator.
    fn of_members(
        times: &[f64],
        runs: &[&[f64]],
        flights: f64,
        settings: &FitSettings,
        observer: &dyn Observer,
    ) -> Result<Self, Error> {
        settings.check()?;
        let members = runs.len();
        if members < LEAST_MEMBERS {
            return refused(FitRefusal::TooFewMembers { members, least: LEAST_MEMBERS });
        }
        within_limit("members of an ensemble", members, MAX_MEMBERS)?;
        within_limit("speeds of an ensemble", members.saturating_mul(times.len()), MAX_SPEEDS)?;
        for speeds in runs {
            check_curve(times, speeds)?;
        }
        let largest = |speeds: &&[f64]| speeds.iter().fold(0.0_f64, |most, speed| most.max(speed.abs()));
        let scale = summing_scale(&runs.iter().map(largest).collect::<Vec<_>>());
        let watch = Watch::begin(observer, 0, 2 * settings.resamples as u64)?;
        let mut work = watch.work();
        let times = Condensed::new(times);
        let groups = members.min(MOST_GROUPS);
        let mut sums = vec![(vec![0.0; times.points()], 0_usize); groups];
        for (member, speeds) in runs.iter().enumerate() {
            let (sum, size) = &mut sums[member * groups / members];
            times.add(speeds, scale, sum);
            *size += 1;
            work.spend(1 + speeds.len() as u64 / 64)?;
        }
        let mut mean = vec![0.0; times.points()];
        for (sum, _) in &sums {
            for (mean, sum) in mean.iter_mut().zip(sum) {
                *mean += sum;
            }
        }
        for mean in &mut mean {
            *mean /= members as f64;
        }
        let of_form = |grid: &ShapeGrid, _: &[f64], work: &mut WorkCount<'_>| {
            Ok(Ok(Box::new(Members::new(grid, &sums, work)?) as Box<dyn Resampled>))
        };
        let fit = Curve { times: &times, speeds: &mean, scale, members, flights }
            .fit(settings, &of_form, &mut work)?;
        watch.end();
        Ok(fit)
    }

    /// Fits one measured curve: times (s, not negative, rising) and speeds (rad/s), with intervals by resampling its residuals
    /// in blocks that are longer than their correlation.
    ///
    /// The residuals must scatter alike along the whole curve. Where runs can be repeated, [`Self::of_runs`]
    /// asks less.
    ///
    /// # Errors
    /// Those of [`Self::new`].
    pub fn of_measured(times: &[f64], speeds: &[f64], settings: &FitSettings) -> Result<Self, Error> {
        Self::of_measured_observed(times, speeds, settings, &Unobserved)
    }

    /// [`Self::of_measured`] with an observer, as [`Self::new_observed`].
    ///
    /// # Errors
    /// Those of [`Self::new_observed`].
    pub fn of_measured_observed(
        times: &[f64],
        speeds: &[f64],
        settings: &FitSettings,
        observer: &dyn Observer,
    ) -> Result<Self, Error> {
        settings.check()?;
        within_limit("speeds of a curve", times.len(), MAX_SPEEDS)?;
        check_curve(times, speeds)?;
        let scale = summing_scale(speeds);
        let watch = Watch::begin(observer, 0, 2 * settings.resamples as u64)?;
        let mut work = watch.work();
        let times = Condensed::new(times);
        let mut curve = vec![0.0; times.points()];
        times.add(speeds, scale, &mut curve);
        let of_form = |grid: &ShapeGrid, fitted: &[f64], work: &mut WorkCount<'_>| {
            let residuals: Vec<f64> = curve.iter().zip(fitted).map(|(speed, fit)| speed - fit).collect();
            Ok(match Blocks::new(&residuals, fitted[fitted.len() - 1]) {
                Ok(blocks) => Ok(Box::new(blocks.at_places(grid, fitted, work)?) as Box<dyn Resampled>),
                Err(refusal) => Err(refusal),
            })
        };
        let fit = Curve { times: &times, speeds: &curve, scale, members: 1, flights: 0.0 }
            .fit(settings, &of_form, &mut work)?;
        watch.end();
        Ok(fit)
    }
}

fn refused<T>(reason: FitRefusal) -> Result<T, Error> {
    Err(Error::FitRefused { reason })
}

/// Checks that a member has the times of the first one.
fn check_times(first: &[f64], own: &[f64]) -> Result<(), Error> {
    check(own.len() == first.len(), "number of times", own.len() as f64, "that of the first member")?;
    for (&own, first) in own.iter().zip(first) {
        check(own.total_cmp(first).is_eq(), "time of a member (s)", own, "that of the first member")?;
    }
    Ok(())
}

/// The form with the smaller residual.
fn better_form(exponential: &RiseEstimate, ramp: Option<&RiseEstimate>) -> RiseForm {
    match ramp {
        Some(ramp) if ramp.residual < exponential.residual => RiseForm::Ramp,
        _ => RiseForm::Exponential,
    }
}

/// The times of a curve, averaged in groups where they are many.
struct Condensed {
    times: Vec<f64>,
    group: usize,
    all: usize,
}

impl Condensed {
    fn new(times: &[f64]) -> Self {
        let group = times.len().div_ceil(MOST_POINTS).max(1);
        let mut condensed = Self { times: Vec::new(), group, all: times.len() };
        condensed.times = vec![0.0; times.len().div_ceil(group)];
        let mut means = std::mem::take(&mut condensed.times);
        add_means(times, group, summing_scale(times), &mut means);
        let scale = summing_scale(times);
        means.iter_mut().for_each(|mean| *mean /= scale);
        condensed.times = means;
        condensed
    }

    fn points(&self) -> usize {
        self.times.len()
    }

    fn add(&self, speeds: &[f64], scale: f64, sum: &mut [f64]) {
        add_means(speeds, self.group, scale, sum);
    }
}

/// Adds the mean of each group of values, scaled.
fn add_means(values: &[f64], group: usize, scale: f64, sums: &mut [f64]) {
    for (values, sum) in values.chunks(group).zip(sums) {
        *sum += values.iter().map(|value| value * scale).sum::<f64>() / values.len() as f64;
    }
}

/// How what is resampled is made for a form, from its grid and the fitted curve.
type OfForm<'f> = dyn Fn(&ShapeGrid, &[f64], &mut WorkCount<'_>) -> Result<Result<Box<dyn Resampled>, FitRefusal>, Error>
    + 'f;

/// The curve that is fitted, its speeds multiplied by `scale`.
struct Curve<'c> {
    times: &'c Condensed,
    speeds: &'c [f64],
    scale: f64,
    members: usize,
    /// Flights of a member, or 0.
    flights: f64,
}

impl Curve<'_> {
    fn fit(
        &self,
        settings: &FitSettings,
        of_form: &OfForm<'_>,
        work: &mut WorkCount<'_>,
    ) -> Result<TransientFit, Error> {
        let times = &self.times.times;
        let exponential_fit = ExponentialFit::counted(times, self.speeds, work)?;
        if let Err(reason) = self.judge(&exponential_fit, settings) {
            return refused(reason);
        }
        let ExponentialFit { steady_speed, time_constant, residual } = exponential_fit;
        let exponential =
            self.rise(exponential, (steady_speed, time_constant, residual), settings, of_form, work)?;
        let exponential = exponential.or_else(refused)?;
        let duration = times[times.len() - 1];
        if exponential.constant.high >= duration {
            let time_constant = exponential.constant.high;
            return refused(FitRefusal::TooShort { duration, time_constant, least: 1.0 });
        }
        let RampFit { steady_speed, rise_time, residual } = RampFit::counted(times, self.speeds, work)?;
        // A ramp that goes on to the end of the curve, or is over before its second point, is no ramp.
        let ramp = if rise_time < duration && rise_time > times[1] {
            self.rise(ramp, (steady_speed, rise_time, residual), settings, of_form, work)?.ok()
        } else {
            None
        };
        let fit = TransientFit {
            form: better_form(&exponential, ramp.as_ref()),
            exponential,
            ramp,
            duration,
            points: self.times.all,
            members: self.members,
        };
        fit.check()?;
        Ok(fit)
    }

    /// Whether the curve lets its fit mean anything.
    fn judge(&self, fit: &ExponentialFit, settings: &FitSettings) -> Result<(), FitRefusal> {
        let times = &self.times.times;
        let (points, last, time_constant) = (times.len(), times[times.len() - 1], fit.time_constant);
        if points < LEAST_POINTS {
            return Err(FitRefusal::TooFewPoints { points, least: LEAST_POINTS });
        }
        if fit.steady_speed.abs() <= 0.0 {
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
        let flights = self.flights * (time_constant / last);
        if self.flights > 0.0 && flights < LEAST_FLIGHTS {
            return Err(FitRefusal::TooFewFlights { flights, time_constant, least: LEAST_FLIGHTS });
        }
        let largest = settings.largest_residual;
        if fit.residual > largest * fit.steady_speed.abs() {
            return Err(FitRefusal::Residual {
                residual: fit.residual / self.scale,
                steady_speed: fit.steady_speed / self.scale,
                largest,
            });
        }
        Ok(())
    }

    /// The fit of a form (steady speed, constant, residual) with its intervals.
    fn rise(
        &self,
        shape: fn(f64) -> f64,
        (steady, constant, residual): (f64, f64, f64),
        settings: &FitSettings,
        of_form: &OfForm<'_>,
        work: &mut WorkCount<'_>,
    ) -> Result<Result<RiseEstimate, FitRefusal>, Error> {
        let times = &self.times.times;
        let grid = ShapeGrid::new(times, constant, shape, work)?;
        let fitted: Vec<f64> = times.iter().map(|time| steady * shape(time / constant)).collect();
        let sample = match of_form(&grid, &fitted, work)? {
            Ok(sample) => sample,
            Err(refusal) => return Ok(Err(refusal)),
        };
        let resamples =
            match Resamples::draw(&grid, sample.as_ref(), settings.resamples, settings.seed, work)? {
                Ok(resamples) => resamples,
                Err(refusal) => return Ok(Err(refusal)),
            };
        let intervals = resamples.intervals(steady / self.scale, constant, self.scale)?;
        Ok(Ok(RiseEstimate::new(intervals, residual / self.scale)?))
    }
}

#[cfg(test)]
mod motor_tests;
#[cfg(test)]
mod tests;
