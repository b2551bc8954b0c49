//! The coefficient of friction from a measured braking curve, with its interval (Eq. 17, Fig. 9).
//!
//! docs/numerics/motors.md, "Friction from a braking curve", derives the fitted part and the error.

use bouncing_disk_core::numerics::statistics::summing_scale;

use crate::error::{Error, check, finite, not_negative, positive, within_limit};
use crate::estimate::interval::IntervalEstimate;
use crate::estimate::refusal::{FitError, FitRefusal, refused};
use crate::motor::batch::members::MAX_SPEEDS;
use crate::motor::rotor::transient::check_rows;
use crate::statistics::correlation_time;
use crate::statistics::group_means;
use crate::statistics::student_quantile;

/// The fewest points of the sliding part.
const LEAST_POINTS: usize = 8;

/// The fewest independent points of the sliding part: the line takes two, and one is left for the error.
const LEAST_INDEPENDENT: f64 = 3.0;

/// Curves of more points are averaged in groups before they are fitted.
const MOST_POINTS: usize = 4_096;

/// The fitted part ends where the line has fallen to this share of its first speed: after that the disk may
/// stick.
const SPEED_LEFT: f64 = 0.05;

/// The deceleration may differ by this share between the first and the last half of the sliding part.
const LARGEST_CHANGE: f64 = 0.2;

/// Residuals below this share of the largest speed are rounding.
const EXACT: f64 = 1.0e-9;

/// A fitted line selects the points of the sliding part for the next line, until the selection stays the
/// same, at most so often.
const ROUNDS: usize = 50;

/// The rotor whose braking was measured.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct BrakingRotor {
    /// Normal force N (N), positive: the preload, m g.
    pub normal_force: f64,
    /// Mass m of the disk (kg), positive.
    pub mass: f64,
    /// Effective contact radius a_e (m), positive.
    pub contact_radius: f64,
    /// Radius of gyration a_g (m), positive.
    pub gyration_radius: f64,
}

impl BrakingRotor {
    /// The coefficient of friction mu = -m a_g^2 alpha_brake/(a_e N) of a disk that brakes with this angular
    /// acceleration alpha_brake (rad/s^2), Eq. (17): not positive for a disk with a positive angular speed,
    /// since it slows down. The caption of Fig. 9 writes the same letter for its absolute value.
    ///
    /// It is Eq. (12) of a sliding disk, solved for mu.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] names the field, its value and its legal range.
    pub fn friction(&self, angular_acceleration: f64) -> Result<f64, Error> {
        let slowing = finite("angular_acceleration", angular_acceleration)?;
        check(slowing <= 0.0, "angular_acceleration", slowing, "(-inf, 0] (rad/s^2)")?;
        positive("normal_force", self.normal_force)?;
        positive("mass", self.mass)?;
        positive("contact_radius", self.contact_radius)?;
        positive("gyration_radius", self.gyration_radius)?;
        let inertia = self.mass * self.gyration_radius * self.gyration_radius;
        check(inertia.is_normal(), "moment of inertia", inertia, "[2.3e-308, 1.7e308] (kg m^2)")?;
        let arm = self.contact_radius * self.normal_force;
        check(arm.is_normal(), "contact radius times normal force", arm, "[2.3e-308, 1.7e308] (N m)")?;
        not_negative("friction", -inertia * angular_acceleration / arm)
    }
}

/// The straight line of a braking curve and the friction that follows, with 95 % intervals.
///
/// ```
/// use bouncing_disk::estimate::{BrakingFit, BrakingRotor};
///
/// // Synthetic: 50 rad/s that fall by 20 rad/s^2, and a standstill.
/// let times: Vec<f64> = (0..300).map(|i| 0.01 * f64::from(i)).collect();
/// let speeds: Vec<f64> = times.iter().map(|time| (50.0 - 20.0 * time).max(0.0)).collect();
/// let rotor =
///     BrakingRotor { normal_force: 0.5, mass: 0.05, contact_radius: 0.002, gyration_radius: 0.01 };
/// let fit = BrakingFit::new(&times, &speeds, &rotor)?;
/// assert!((fit.friction.value - 0.1).abs() < 1e-12);
/// # Ok::<(), bouncing_disk::estimate::FitError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct BrakingFit {
    /// Angular deceleration -alpha_brake (rad/s^2), positive whichever way the disk turns.
    pub deceleration: IntervalEstimate,
    /// Coefficient of friction mu, by Eq. (17). Its interval is that of the deceleration, without the
    /// uncertainty of the rotor.
    pub friction: IntervalEstimate,
    /// Last time of the sliding part (s), which begins with the first point.
    pub sliding_until: f64,
    /// Points of the sliding part.
    pub points: usize,
    /// Integrated correlation time of the residuals (s); the mean time between two points where they are
    /// independent.
    pub correlation_time: f64,
    /// Root mean square of the residuals of the sliding part (rad/s).
    pub residual: f64,
}

impl BrakingFit {
    /// Fits times (s, rising) and speeds (rad/s) of a disk that slides on a platform at rest from the first
    /// point on, and may stop at the end. A disk that turns backwards has negative speeds.
    ///
    /// The fit omits the standstill. It cuts the curve where a straight line before and zero speed after the
    /// cut leave the smallest squares, and uses the part before the cut in which the line keeps more than 5 %
    /// of its first speed. The error allows for residuals that are correlated and vary in size along the
    /// curve. Curves of more than 4096 points are first averaged in groups of points.
    ///
    /// # Errors
    /// [`FitError::Refused`] where the speed does not fall, the sliding part has fewer than eight points, its
    /// deceleration changes by more than a fifth, or its residuals are correlated for too long;
    /// [`Error::OutOfRange`] names the illegal number of the curve or the rotor; an error of the core for
    /// more than [`MAX_SPEEDS`] points.
    pub fn new(times: &[f64], speeds: &[f64], rotor: &BrakingRotor) -> Result<Self, FitError> {
        rotor.friction(0.0)?;
        within_limit("speeds of a curve", times.len(), MAX_SPEEDS)?;
        check_rows(times, speeds)?;
        if speeds.iter().all(|speed| speed.abs() <= 0.0) {
            return refused(FitRefusal::NotBraking { deceleration: 0.0, low: 0.0 });
        }
        let (all, group) = (times.len(), times.len().div_ceil(MOST_POINTS));
        let (time_scale, speed_scale) = (summing_scale(times), summing_scale(speeds));
        let (times, speeds) =
            (group_means(times, group, time_scale), group_means(speeds, group, speed_scale));
        // For both directions of rotation.
        let turn = speeds.iter().sum::<f64>();
        let sign = if turn < 0.0 { -1.0 } else { 1.0 };
        let speeds: Vec<f64> = speeds.iter().map(|speed| sign * speed).collect();
        let slope_unit = time_scale / speed_scale;
        let points = sliding_points(&times, &speeds);
        let (times, speeds) = (&times[..points], &speeds[..points]);
        if points < LEAST_POINTS {
            return refused(FitRefusal::TooFewPoints { points, least: LEAST_POINTS });
        }
        let line = BrakingLine::through(times, speeds);
        let residuals = line.residuals(times, speeds);
        let largest = speeds.iter().fold(0.0_f64, |most, speed| most.max(speed.abs()));
        if let Some((first, last)) = bent(times, speeds, &line, largest) {
            let (first_half, last_half) = (-first * slope_unit, -last * slope_unit);
            return refused(FitRefusal::NotStraight { first_half, last_half });
        }
        let Some(scatter) = Scatter::of(&residuals, 2, largest) else {
            let correlated_points = points as f64 / LEAST_INDEPENDENT;
            return refused(FitRefusal::Correlated { correlated_points, points });
        };
        let reach = student_quantile(scatter.degrees) * scatter.error_of(&line, times, &residuals);
        let (deceleration, low) = (-line.slope, -line.slope - reach);
        if low.is_nan() || low <= 0.0 {
            let (deceleration, low) = (deceleration * slope_unit, low * slope_unit);
            return refused(FitRefusal::NotBraking { deceleration, low });
        }
        let [deceleration, low, high] = [deceleration, low, deceleration + reach].map(|own| own * slope_unit);
        let deceleration = IntervalEstimate::about(deceleration, low, high)?;
        let friction = IntervalEstimate::about(
            rotor.friction(-deceleration.value)?,
            rotor.friction(-deceleration.low)?,
            rotor.friction(-deceleration.high)?,
        )?;
        let lasts = times[points - 1] - times[0];
        Ok(Self {
            deceleration,
            friction,
            sliding_until: times[points - 1] / time_scale,
            points: (points * group).min(all),
            correlation_time: scatter.correlated_points * (lasts / (points - 1) as f64) / time_scale,
            residual: scatter.residual / speed_scale,
        })
    }
}

/// A straight line of the least squares.
#[derive(Debug, Clone, Copy)]
struct BrakingLine {
    slope: f64,
    /// Its middle, through which it passes.
    time: f64,
    speed: f64,
    /// Sum of the squared distances of the times from their middle.
    spread: f64,
}

impl BrakingLine {
    fn through(times: &[f64], speeds: &[f64]) -> Self {
        let n = times.len() as f64;
        let (time, speed) = (times.iter().sum::<f64>() / n, speeds.iter().sum::<f64>() / n);
        let spread: f64 = times.iter().map(|own| (own - time) * (own - time)).sum();
        let product: f64 = times.iter().zip(speeds).map(|(own, value)| (own - time) * (value - speed)).sum();
        Self { slope: product / spread, time, speed, spread }
    }

    fn at(&self, time: f64) -> f64 {
        self.speed + self.slope * (time - self.time)
    }

    fn residuals(&self, times: &[f64], speeds: &[f64]) -> Vec<f64> {
        times.iter().zip(speeds).map(|(&time, speed)| speed - self.at(time)).collect()
    }
}

/// The noise of a measured curve, from the residuals of a fit.
struct Scatter {
    /// Root mean square of the residuals.
    residual: f64,
    /// Mean square of the noise, of which the fit has taken a part.
    noise: f64,
    correlated_points: f64,
    /// Independent parts less fitted parameters.
    degrees: f64,
    /// The share of the residuals that the fit absorbs because they are correlated, beyond that of
    /// uncorrelated ones.
    taken: f64,
}

impl Scatter {
    /// Of a fit with so many parameters to speeds up to the `largest`; `None` where hardly any part is
    /// independent.
    fn of(residuals: &[f64], parameters: usize, largest: f64) -> Option<Self> {
        let points = residuals.len() as f64;
        let square = residuals.iter().map(|residual| residual * residual).sum::<f64>() / points;
        let is_exact = square <= EXACT * EXACT * largest * largest;
        let correlated_points = if is_exact { 1.0 } else { correlation_time(residuals, parameters)? };
        let independent = points / correlated_points;
        let degrees = independent - parameters as f64;
        let noise = square * independent / degrees;
        let taken = (independent / degrees) * (1.0 - parameters as f64 / points);
        (degrees >= LEAST_INDEPENDENT - 2.0).then_some(Self {
            residual: square.sqrt(),
            noise,
            correlated_points,
            degrees,
            taken,
        })
    }

    /// The standard error of a line's slope, the larger of two: for noise of constant size, and for noise
    /// that is at each point as large as its residual, corrected for the part that the line absorbs.
    fn error_of(&self, line: &BrakingLine, times: &[f64], residuals: &[f64]) -> f64 {
        let squares = times.iter().zip(residuals).map(|(own, residual)| {
            let from_middle = own - line.time;
            let leverage = 1.0 / times.len() as f64 + from_middle * from_middle / line.spread;
            let weighted = from_middle * residual / (1.0 - leverage);
            weighted * weighted
        });
        let own = squares.sum::<f64>() / line.spread * self.taken;
        (self.noise.max(own) * self.correlated_points / line.spread).sqrt()
    }
}

/// The slopes of the first and the last half, if they differ by more than a fifth of the slope of the whole,
/// and by more than chance. A bend looks like a long correlation: the residuals of the halves have less of
/// it.
fn bent(times: &[f64], speeds: &[f64], line: &BrakingLine, largest: f64) -> Option<(f64, f64)> {
    let half = times.len() / 2;
    let ((first_times, last_times), (first_speeds, last_speeds)) =
        (times.split_at(half), speeds.split_at(half));
    let (first, last) =
        (BrakingLine::through(first_times, first_speeds), BrakingLine::through(last_times, last_speeds));
    let change = (first.slope - last.slope).abs();
    if line.slope >= 0.0 || change <= LARGEST_CHANGE * line.slope.abs() {
        return None;
    }
    let mut residuals = first.residuals(first_times, first_speeds);
    residuals.extend(last.residuals(last_times, last_speeds));
    let by_chance = Scatter::of(&residuals, 4, largest).is_some_and(|scatter| {
        let (of_first, of_last) = residuals.split_at(half);
        let first = scatter.error_of(&first, first_times, of_first);
        let last = scatter.error_of(&last, last_times, of_last);
        change <= student_quantile(scatter.degrees) * (first * first + last * last).sqrt()
    });
    (!by_chance).then_some((first.slope, last.slope))
}

/// The number of points before the standstill, less those at which the line is almost at rest.
fn sliding_points(times: &[f64], speeds: &[f64]) -> usize {
    let mut points = points_before_standstill(times, speeds);
    // A line through fewer points is another line, so the selection of the part repeats.
    for _ in 0..ROUNDS {
        if points < LEAST_POINTS {
            break;
        }
        let line = BrakingLine::through(&times[..points], &speeds[..points]);
        if line.slope >= 0.0 {
            break;
        }
        let left = SPEED_LEFT * line.at(times[0]);
        let kept = times[..points].iter().take_while(|&&time| line.at(time) > left).count();
        if kept == points {
            break;
        }
        points = kept;
    }
    points
}

/// The cut that leaves the smallest squares: of a line before it, and of the speeds behind it.
fn points_before_standstill(times: &[f64], speeds: &[f64]) -> usize {
    let behind: f64 = speeds.iter().map(|speed| speed * speed).sum();
    let (mut best, mut least) = (0, f64::INFINITY);
    // Sums about running means, of one more point each.
    let (mut time, mut speed, mut spread, mut product, mut squares) = (0.0, 0.0, 0.0, 0.0, 0.0);
    let mut rest = behind;
    for (k, (&own_time, &own_speed)) in times.iter().zip(speeds).enumerate() {
        let count = (k + 1) as f64;
        let (by_time, by_speed) = (own_time - time, own_speed - speed);
        time += by_time / count;
        speed += by_speed / count;
        spread += by_time * (own_time - time);
        product += by_time * (own_speed - speed);
        squares += by_speed * (own_speed - speed);
        rest -= own_speed * own_speed;
        if k >= 1 {
            let missed = (squares - product * product / spread).max(0.0) + rest.max(0.0);
            if missed <= least {
                (best, least) = (k + 1, missed);
            }
        }
    }
    best
}

#[cfg(test)]
mod tests;
