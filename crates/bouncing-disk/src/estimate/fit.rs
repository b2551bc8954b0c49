//! Least-squares fits of measured or computed curves.

use crate::display::numbers;
use bouncing_disk_core::numerics::elementary::{exp, exp_m1, ln};
use bouncing_disk_core::numerics::roots::golden_section;
use bouncing_disk_core::numerics::statistics::summing_scale;
use bouncing_disk_core::run::{Watch, WorkCount};
use bouncing_disk_core::{Observer, Unobserved};
use std::fmt::{self, Display, Formatter};

use crate::error::{Error, finite, not_negative, positive};
use crate::motor::rotor::transient::{SpeedCurve, check_curve};

/// Steps of the golden-section search. Each shrinks the interval by 0.618, down to about 1e-9 of the time
/// constant; near its minimum the residual is so flat that rounding hides smaller steps.
const GOLDEN_STEPS: u32 = 42;

/// Trial time constants that bracket the best one: at least this number, with logarithms at most this far
/// apart.
const TRIALS: u32 = 40;
const WIDEST_STEP: f64 = 1.0;

/// Points of a curve that a trial processes in about the time of a flight.
const POINTS_OF_FLIGHT: usize = 2;

/// The fit of alpha_ss (1 - exp(-t/t_c)) to a speed curve (Fig. 10, Fig. 11).
///
/// It accepts any curve and states no error. A [`TransientFit`](crate::estimate::TransientFit) states intervals
/// and rejects curves that determine no time constant.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct ExponentialFit {
    /// Steady speed alpha_ss (rad/s).
    pub steady_speed: f64,
    /// Time constant t_c (s).
    pub time_constant: f64,
    /// Root mean square of the residuals (rad/s).
    pub residual: f64,
}

impl ExponentialFit {
    /// Fits times (s, not negative, rising) and speeds (rad/s) of at least three points.
    ///
    /// The model is linear in the steady speed, so the search is over the time constant alone (variable
    /// projection), in its logarithm, from a tenth of the shortest to a hundred times the longest time.
    ///
    /// A fit to a million points takes seconds. The observer's only item is the fit.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for fewer than three points, lists of different lengths, times that do not rise,
    /// numbers that are not finite, or a result that a double cannot represent.
    pub fn new(times: &[f64], speeds: &[f64], observer: &dyn Observer) -> Result<Self, Error> {
        observed(observer, |work| Self::counted(times, speeds, work))
    }

    /// [`Self::new`] as part of a longer call.
    pub(crate) fn counted(times: &[f64], speeds: &[f64], work: &mut WorkCount<'_>) -> Result<Self, Error> {
        check_curve(times, speeds)?;
        let Saturation { steady, constant, residual, .. } =
            Saturation::of(times, speeds, exponential, Start::FromRest, work)?;
        Ok(Self { steady_speed: steady, time_constant: constant, residual })
    }

    /// The shortest and the longest time constant (s) that the search covers for these times.
    pub(crate) fn searched(times: &[f64]) -> (f64, f64) {
        let last = times[times.len() - 1];
        let first = times.iter().copied().find(|&time| time > 0.0).unwrap_or(last);
        (0.1 * first, 100.0 * last)
    }

    /// The fitted speed (rad/s) at `time` (s).
    #[must_use]
    pub fn speed(&self, time: f64) -> f64 {
        self.steady_speed * exponential(time / self.time_constant)
    }

    /// Stall acceleration alpha_ss/t_c (rad/s^2), which the paper calls the stall torque.
    #[must_use]
    pub fn stall_acceleration(&self) -> f64 {
        self.steady_speed / self.time_constant
    }

    /// Stall torque m a_g^2 alpha_ss/t_c (N m) of a disk of `mass` (kg) and `gyration_radius` (m).
    #[must_use]
    pub fn stall_torque(&self, mass: f64, gyration_radius: f64) -> f64 {
        mass * gyration_radius * gyration_radius * self.stall_acceleration()
    }
}

/// The fit of alpha_ss min(t/t_r, 1): the piecewise linear rise of low-period chattering orbits (Fig. 12).
///
/// [`TransientFit`](crate::estimate::TransientFit) compares it with the exponential, with intervals.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct RampFit {
    /// Steady speed alpha_ss (rad/s).
    pub steady_speed: f64,
    /// Time t_r (s) at which the steady speed is reached.
    pub rise_time: f64,
    /// Root mean square of the residuals (rad/s).
    pub residual: f64,
}

impl RampFit {
    /// Fits the ramp as [`ExponentialFit::new`] fits the exponential.
    ///
    /// # Errors
    /// The errors of [`ExponentialFit::new`].
    pub fn new(times: &[f64], speeds: &[f64]) -> Result<Self, Error> {
        observed(&Unobserved, |work| Self::counted(times, speeds, work))
    }

    /// [`Self::new`] as part of a longer call.
    pub(crate) fn counted(times: &[f64], speeds: &[f64], work: &mut WorkCount<'_>) -> Result<Self, Error> {
        check_curve(times, speeds)?;
        let Saturation { steady, constant, residual, .. } =
            Saturation::of(times, speeds, |x| x.min(1.0), Start::FromRest, work)?;
        Ok(Self { steady_speed: steady, rise_time: constant, residual })
    }

    /// The fitted speed (rad/s) at `time` (s).
    #[must_use]
    pub fn speed(&self, time: f64) -> f64 {
        self.steady_speed * (time / self.rise_time).min(1.0)
    }
}

/// Runs a fit as one observed call.
fn observed<Fit>(
    observer: &dyn Observer,
    fit: impl FnOnce(&mut WorkCount<'_>) -> Result<Fit, Error>,
) -> Result<Fit, Error> {
    let watch = Watch::begin(observer, 0, 1)?;
    let fit = fit(&mut watch.work())?;
    watch.finish(1);
    watch.end();
    Ok(fit)
}

/// 1 - exp(-x).
fn exponential(x: f64) -> f64 {
    -exp_m1(-x)
}

/// The known part of a motor's state at the start of its rise.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Start {
    /// Speed zero at time zero.
    FromRest,
    /// Nothing is known: the speed at time zero is fitted, too.
    AnySpeed,
}

/// The least-squares fit of steady - rise (1 - shape(time/constant)); `rise` is `steady` for a start from
/// rest.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Saturation {
    pub(crate) steady: f64,
    pub(crate) rise: f64,
    pub(crate) constant: f64,
    /// Root mean square of the residuals.
    pub(crate) residual: f64,
}

impl Saturation {
    /// The fit of a legal curve, in its units.
    pub(crate) fn of(
        times: &[f64],
        speeds: &[f64],
        shape: impl Fn(f64) -> f64,
        start: Start,
        work: &mut WorkCount<'_>,
    ) -> Result<Self, Error> {
        let (time_scale, speed_scale) = (summing_scale(times), summing_scale(speeds));
        let scaled =
            |values: &[f64], scale: f64| values.iter().map(|value| value * scale).collect::<Vec<_>>();
        let fit =
            Self::of_scaled(&scaled(times, time_scale), &scaled(speeds, speed_scale), shape, start, work)?;
        Ok(Self {
            constant: positive("fitted time (s)", fit.constant / time_scale)?,
            steady: finite("fitted steady speed (rad/s)", fit.steady / speed_scale)?,
            rise: finite("fitted rise (rad/s)", fit.rise / speed_scale)?,
            residual: not_negative("residual of the fit (rad/s)", fit.residual / speed_scale)?,
        })
    }

    /// [`Self::of`] for numbers whose squares neither overflow nor vanish.
    fn of_scaled(
        times: &[f64],
        speeds: &[f64],
        shape: impl Fn(f64) -> f64,
        start: Start,
        work: &mut WorkCount<'_>,
    ) -> Result<Self, Error> {
        let n = times.len();
        let mean_of = |values: &[f64]| match start {
            Start::FromRest => 0.0,
            Start::AnySpeed => values.iter().sum::<f64>() / n as f64,
        };
        let mean_speed = mean_of(speeds);
        let mut shapes = vec![0.0; n];
        // The best speeds for a given constant, and the remaining residual.
        let mut at = |constant: f64| {
            for (value, &time) in shapes.iter_mut().zip(times) {
                *value = shape(time / constant);
            }
            let mean_shape = mean_of(&shapes);
            let (mut squares, mut products) = (0.0, 0.0);
            for (&value, &speed) in shapes.iter().zip(speeds) {
                let y = value - mean_shape;
                squares += y * y;
                products += y * (speed - mean_speed);
            }
            let rise = if squares > 0.0 { products / squares } else { 0.0 };
            let sum = shapes.iter().zip(speeds).fold(0.0, |sum, (&value, &speed)| {
                let difference = speed - mean_speed - rise * (value - mean_shape);
                sum + difference * difference
            });
            let start_speed = mean_speed - rise * mean_shape;
            Self { constant, steady: start_speed + rise, rise, residual: (sum / n as f64).sqrt() }
        };
        let first = times.iter().copied().find(|&time| time > 0.0).unwrap_or(times[n - 1]);
        // Next to the longest time, a tenth of a subnormal time is as good as the smallest normal number.
        let (low, high) = (ln((0.1 * first).max(f64::MIN_POSITIVE)), ln(100.0 * times[n - 1]));
        let mut cost = |log: f64| {
            work.spend(1 + (n / POINTS_OF_FLIGHT) as u64)?;
            Ok::<_, Error>(at(exp(log)).residual)
        };
        let trials = TRIALS.max(((high - low) / WIDEST_STEP) as u32);
        let step = (high - low) / f64::from(trials);
        let mut best = (f64::INFINITY, 0);
        for trial in 0..=trials {
            let value = cost(low + step * f64::from(trial))?;
            if value < best.0 {
                best = (value, trial);
            }
        }
        let centre = low + step * f64::from(best.1);
        let log =
            golden_section((centre - step).max(low), (centre + step).min(high), GOLDEN_STEPS, &mut cost)?;
        Ok(at(exp(log)))
    }
}

impl SpeedCurve {
    /// The fit of alpha_ss (1 - exp(-t/t_c)).
    ///
    /// # Errors
    /// The errors of [`ExponentialFit::new`].
    pub fn fit(&self) -> Result<ExponentialFit, Error> {
        ExponentialFit::new(&self.times, &self.speeds, &Unobserved)
    }
}

impl Display for ExponentialFit {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let [steady, constant, residual] =
            [self.steady_speed, self.time_constant, self.residual].map(numbers(f));
        write!(f, "{steady} rad/s (1 - exp(-t/{constant} s)), residual {residual} rad/s")
    }
}

impl Display for RampFit {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let [steady, rise, residual] = [self.steady_speed, self.rise_time, self.residual].map(numbers(f));
        write!(f, "{steady} rad/s min(t/{rise} s, 1), residual {residual} rad/s")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{check_stops, refused};

    #[test]
    fn exact_curve_is_recovered() {
        for (steady, constant) in [(20.0, 0.6), (-3.0, 0.01), (1e-3, 40.0)] {
            let times: Vec<f64> = (1..=200).map(|i| f64::from(i) * 0.02).collect();
            let truth = ExponentialFit { steady_speed: steady, time_constant: constant, residual: 0.0 };
            let speeds: Vec<f64> = times.iter().map(|&time| truth.speed(time)).collect();
            let fit = ExponentialFit::new(&times, &speeds, &Unobserved).expect("legal curve");
            // The residual is flat at its minimum, so half of the digits of the time constant are lost.
            assert!((fit.time_constant / constant - 1.0).abs() < 1e-5, "{fit:?}");
            assert!((fit.steady_speed / steady - 1.0).abs() < 1e-5, "{fit:?}");
            assert!((fit.stall_acceleration() - fit.steady_speed / fit.time_constant).abs() <= 0.0);
        }
    }

    /// Root mean square difference between a model and a curve.
    fn misfit(times: &[f64], speeds: &[f64], model: impl Fn(f64) -> f64) -> f64 {
        let squares: Vec<f64> = times
            .iter()
            .zip(speeds)
            .map(|(&time, speed)| (speed - model(time)) * (speed - model(time)))
            .collect();
        (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()
    }

    /// A small change of either parameter increases the sum of squares, and the residual is the root of its
    /// mean.
    #[test]
    fn a_fit_is_where_the_squares_are_least() {
        for (saturation, scatter) in [(0.3, 0.2), (2.0, 0.7), (6.0, 0.05)] {
            let times: Vec<f64> = (0..60).map(|i| 0.1 * f64::from(i) + 0.002 * f64::from(i % 7)).collect();
            let speeds: Vec<f64> = (0..60_u32)
                .zip(&times)
                .map(|(i, time)| {
                    5.0 * exponential(time / saturation) + scatter * f64::from(i * 37 % 11) - scatter
                })
                .collect();
            let curve = ExponentialFit::new(&times, &speeds, &Unobserved).expect("legal curve");
            let ramp = RampFit::new(&times, &speeds).expect("legal curve");
            let of_curve = |steady: f64, constant: f64| {
                misfit(&times, &speeds, |time| steady * (1.0 - exp(-time / constant)))
            };
            let of_ramp =
                |steady: f64, rise: f64| misfit(&times, &speeds, |time| steady * (time / rise).min(1.0));
            let is_least = |steady: f64, constant: f64, residual: f64, misfit: &dyn Fn(f64, f64) -> f64| {
                let least = misfit(steady, constant);
                assert!((residual - least).abs() <= 1e-13 * least, "{residual} {least}");
                for (by_steady, by_constant) in [(1e-3, 0.0), (0.0, 1e-3), (1e-3, 1e-3), (1e-3, -1e-3)] {
                    for sign in [1.0, -1.0] {
                        let (steady, constant) =
                            (steady * (1.0 + sign * by_steady), constant * (1.0 + sign * by_constant));
                        assert!(misfit(steady, constant) > least, "{saturation} {steady} {constant}");
                    }
                }
            };
            is_least(curve.steady_speed, curve.time_constant, curve.residual, &of_curve);
            is_least(ramp.steady_speed, ramp.rise_time, ramp.residual, &of_ramp);
        }
    }

    /// For a curve that has not begun to saturate, or has done so before its first point, the fit ends at the
    /// limit of the search.
    #[test]
    fn time_constants_lie_between_a_tenth_of_the_first_and_a_hundred_times_the_last_time() {
        let times = [0.0, 0.5, 1.0, 2.0, 4.0];
        let straight = ExponentialFit::new(&times, &times, &Unobserved).expect("legal curve");
        assert!((straight.time_constant / 400.0 - 1.0).abs() < 1e-6, "{straight:?}");
        let at_once =
            ExponentialFit::new(&times, &[0.0, 7.0, 7.0, 7.0, 7.0], &Unobserved).expect("legal curve");
        assert!((at_once.time_constant / 0.05 - 1.0).abs() < 1e-6, "{at_once:?}");
        assert!((at_once.steady_speed - 7.0).abs() < 1e-3);
        // A disk that does not turn.
        let still =
            ExponentialFit::new(&times[..3], &[0.0; 3], &Unobserved).expect("three points are enough");
        assert!(still.steady_speed.abs() <= 0.0 && still.residual.abs() <= 0.0, "{still:?}");
    }

    /// The observer of a fit to many points is called at every trial and may stop it there; the result does
    /// not depend on the observer.
    #[test]
    fn a_long_fit_can_be_stopped() {
        let times: Vec<f64> = (1..=20_000).map(|i| f64::from(i) * 0.02).collect();
        let speeds = curve(20.0, 0.6, &times);
        let (asked, done) = check_stops(1, |observer| ExponentialFit::new(&times, &speeds, observer));
        assert!(asked > u64::from(TRIALS) && done.iter().all(|&done| done == 0), "{asked} {done:?}");
    }

    #[test]
    fn the_time_that_is_out_of_order_is_named() {
        for (times, bad) in [
            ([-1e-310, 1.0, 2.0], -1e-310),
            ([0.0, 2.0, 1.0], 1.0),
            ([0.0, 1.0, f64::INFINITY], f64::INFINITY),
            ([0.0, 1.0, f64::NAN], f64::NAN),
            ([f64::NAN, 1.0, 2.0], f64::NAN),
        ] {
            match ExponentialFit::new(&times, &[1.0; 3], &Unobserved) {
                Err(Error::OutOfRange { field: "times of the speed curve", value, .. }) => {
                    assert_eq!(value.to_bits(), bad.to_bits(), "{times:?}");
                }
                other => panic!("{times:?}: {other:?}"),
            }
        }
        assert!(ExponentialFit::new(&[0.0, 1.0, 2.0], &[1.0; 3], &Unobserved).is_ok());
    }

    #[test]
    fn the_stall_torque_is_that_of_a_ring() {
        let fit = ExponentialFit { steady_speed: 30.0, time_constant: 0.25, residual: 0.0 };
        assert!((fit.stall_acceleration() - 120.0).abs() < 1e-12);
        assert!((fit.stall_torque(0.5, 0.2) - 0.5 * 0.04 * 120.0).abs() < 1e-12);
        // After one time constant all but 1/e of the speed has been reached.
        assert!((fit.speed(0.25) - 30.0 * (1.0 - 0.367_879_441_171_442_3)).abs() < 1e-13);
        let ramp = RampFit { steady_speed: 30.0, rise_time: 0.5, residual: 0.0 };
        assert!((ramp.speed(0.125) - 7.5).abs() < 1e-13 && (ramp.speed(0.75) - 30.0).abs() < 1e-13);
    }

    #[test]
    fn ramp_and_exponential_tell_each_other_apart() {
        let times: Vec<f64> = (1..=200).map(|i| f64::from(i) * 0.02).collect();
        let ramp = RampFit { steady_speed: 17.0, rise_time: 2.1, residual: 0.0 };
        let speeds: Vec<f64> = times.iter().map(|&time| ramp.speed(time)).collect();
        let fit = RampFit::new(&times, &speeds).expect("legal curve");
        assert!((fit.rise_time - 2.1).abs() < 1e-4 && (fit.steady_speed - 17.0).abs() < 1e-4, "{fit:?}");
        let other = ExponentialFit::new(&times, &speeds, &Unobserved).expect("legal curve");
        assert!(fit.residual < 1e-3 * other.residual);
    }

    fn curve(steady: f64, constant: f64, times: &[f64]) -> Vec<f64> {
        let truth = ExponentialFit { steady_speed: steady, time_constant: constant, residual: 0.0 };
        times.iter().map(|&time| truth.speed(time)).collect()
    }

    /// Squares of speeds and a hundred times the longest time once overflowed, and a tenth of the shortest time
    /// vanished; the fit was then `Ok` and NaN.
    #[test]
    fn curves_of_any_size_are_fitted() {
        let ordinary: Vec<f64> = (1..=200).map(|i| f64::from(i) * 0.02).collect();
        for (time, speed) in [
            (1.0, 1e300),
            (1.0, 1e-200),
            (1.0, 1e-300),
            (1e306, 1.0),
            (1e-300, 1.0),
            (1e-305, -1e300),
            (1e200, 1e-300),
        ] {
            let times: Vec<f64> = ordinary.iter().map(|value| value * time).collect();
            let fit = ExponentialFit::new(&times, &curve(20.0 * speed, 0.6 * time, &times), &Unobserved)
                .expect("legal");
            assert!((fit.time_constant / (0.6 * time) - 1.0).abs() < 1e-5, "{time} {speed}: {fit:?}");
            assert!((fit.steady_speed / (20.0 * speed) - 1.0).abs() < 1e-5, "{time} {speed}: {fit:?}");
            assert!(fit.residual < 1e-5 * (20.0 * speed).abs(), "{time} {speed}: {fit:?}");
        }
    }

    #[test]
    fn a_denormal_first_time_does_not_spoil_a_fit() {
        let mut times: Vec<f64> = (0..=200).map(|i| f64::from(i) * 0.02).collect();
        for first in [5e-324, 1e-308, 1e-200, 1e-30] {
            times[0] = first;
            let fit = ExponentialFit::new(&times, &curve(20.0, 0.6, &times), &Unobserved).expect("legal");
            assert!((fit.time_constant / 0.6 - 1.0).abs() < 1e-5, "{first}: {fit:?}");
            assert!((fit.steady_speed / 20.0 - 1.0).abs() < 1e-5, "{first}: {fit:?}");
        }
    }

    #[test]
    fn illegal_curves_and_fits_that_no_double_holds_are_refused() {
        let fit = |(times, speeds): (&[f64], &[f64])| ExponentialFit::new(times, speeds, &Unobserved);
        let instants = [0.0, 1.0, 2.0];
        refused("number of points of the speed curve", [(&instants[..2], &instants[..2])], fit);
        refused("number of speeds", [(&instants[..], &instants[..2])], fit);
        refused("times of the speed curve", [(&[0.0, 1.0, 1.0][..], &instants[..])], fit);
        refused("speed", [(&instants[..], &[0.0, f64::NAN, 1.0][..])], fit);
        // Straight lines: the constant is at its limit, a hundred times the longest time.
        let line = |last: f64| [0.25, 0.5, 0.75, 1.0].map(|share| share * last);
        refused("fitted time (s)", [(&line(1.7e308)[..], &line(1.0)[..])], fit);
        refused("fitted steady speed (rad/s)", [(&line(1.0)[..], &line(1.7e308)[..])], fit);
        for fit in [fit((&[0.0, 5e-324, 1e-323], &[0.0, 1.0, 1.0])), fit((&[1.0, 2.0, 3.0], &[0.0; 3]))] {
            assert!(fit.is_err() || fit.is_ok_and(|fit| fit.time_constant > 0.0 && !fit.residual.is_nan()));
        }
    }
}
