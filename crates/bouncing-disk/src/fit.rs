//! Least-squares fits of measured or computed curves.

use bouncing_disk_core::elementary::{exp, exp_m1, ln};
use serde::{Deserialize, Serialize};

use crate::error::Error;

/// Steps of the golden-section search: the interval shrinks by 0.618 each.
const GOLDEN_STEPS: u32 = 80;

/// Trial time constants that bracket the best one.
const TRIALS: u32 = 60;

/// The fit of alpha_ss (1 - exp(-t/t_c)) to a speed curve (Fig. 10, Fig. 11).
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ExponentialFit {
    /// Steady speed alpha_ss (rad/s).
    pub steady_speed: f64,
    /// Time constant t_c (s).
    pub time_constant: f64,
    /// Root mean square of the residuals (rad/s).
    pub residual: f64,
}

impl ExponentialFit {
    /// Fits times (s, not negative, rising) and speeds (rad/s): at least three points.
    ///
    /// The model is linear in the steady speed, so the search is over the time constant alone (variable
    /// projection), in its logarithm, from a tenth of the shortest to a hundred times the longest time.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for fewer than three points, lists of different lengths, times that do not rise or
    /// numbers that are not finite.
    pub fn new(times: &[f64], speeds: &[f64]) -> Result<Self, Error> {
        let (time_constant, steady_speed, residual) = saturating_fit(times, speeds, exponential)?;
        Ok(Self { steady_speed, time_constant, residual })
    }

    /// The fitted speed (rad/s) at `time` (s).
    #[must_use]
    pub fn speed(&self, time: f64) -> f64 {
        self.steady_speed * exponential(time / self.time_constant)
    }

    /// Stall acceleration alpha_ss/t_c (rad/s^2): what the paper calls the stall torque.
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
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct RampFit {
    /// Steady speed alpha_ss (rad/s).
    pub steady_speed: f64,
    /// Time t_r (s) at which it is reached.
    pub rise_time: f64,
    /// Root mean square of the residuals (rad/s).
    pub residual: f64,
}

impl RampFit {
    /// As [`ExponentialFit::new`], with the ramp instead of the exponential.
    ///
    /// # Errors
    /// As [`ExponentialFit::new`].
    pub fn new(times: &[f64], speeds: &[f64]) -> Result<Self, Error> {
        let (rise_time, steady_speed, residual) = saturating_fit(times, speeds, |x| x.min(1.0))?;
        Ok(Self { steady_speed, rise_time, residual })
    }

    /// The fitted speed (rad/s) at `time` (s).
    #[must_use]
    pub fn speed(&self, time: f64) -> f64 {
        self.steady_speed * (time / self.rise_time).min(1.0)
    }
}

/// 1 - exp(-x).
fn exponential(x: f64) -> f64 {
    -exp_m1(-x)
}

/// The least-squares fit of steady * shape(time/constant): (constant, steady, root mean square residual).
fn saturating_fit(
    times: &[f64],
    speeds: &[f64],
    shape: impl Fn(f64) -> f64,
) -> Result<(f64, f64, f64), Error> {
    let n = times.len();
    let illegal = |field, value, legal| Err(Error::OutOfRange { field, value, legal });
    if n < 3 {
        return illegal("number of points of the speed curve", n as f64, "[3, inf)");
    }
    if speeds.len() != n {
        return illegal("number of speeds", speeds.len() as f64, "the number of times");
    }
    let rising = times.iter().zip(&times[1..]).all(|(a, b)| b > a);
    if !(rising && times[0] >= 0.0 && times[n - 1].is_finite()) {
        return illegal("times of the speed curve", times[0], "finite, not negative, rising (s)");
    }
    if let Some(&bad) = speeds.iter().find(|speed| !speed.is_finite()) {
        return illegal("speed", bad, "finite (rad/s)");
    }
    // The best steady speed for a given constant, and the residual that it leaves.
    let at = |constant: f64| {
        let (mut shapes, mut products) = (0.0, 0.0);
        for (&time, &speed) in times.iter().zip(speeds) {
            let y = shape(time / constant);
            shapes += y * y;
            products += y * speed;
        }
        let steady = if shapes > 0.0 { products / shapes } else { 0.0 };
        let sum = times.iter().zip(speeds).fold(0.0, |sum, (&time, &speed)| {
            let difference = speed - steady * shape(time / constant);
            sum + difference * difference
        });
        (constant, steady, (sum / n as f64).sqrt())
    };
    let first = times.iter().copied().find(|&time| time > 0.0).unwrap_or(times[n - 1]);
    let (low, high) = (ln(0.1 * first), ln(100.0 * times[n - 1]));
    let cost = |log: f64| at(exp(log)).2;
    let step = (high - low) / f64::from(TRIALS);
    let mut best = (f64::INFINITY, 0);
    for trial in 0..=TRIALS {
        let value = cost(low + step * f64::from(trial));
        if value < best.0 {
            best = (value, trial);
        }
    }
    let centre = low + step * f64::from(best.1);
    let log = golden_minimum((centre - step).max(low), (centre + step).min(high), cost);
    Ok(at(exp(log)))
}

/// The minimum of a function with one minimum in [low, high], by golden section.
fn golden_minimum(mut low: f64, mut high: f64, function: impl Fn(f64) -> f64) -> f64 {
    let ratio = 0.5 * (5.0_f64.sqrt() - 1.0);
    let mut inner = [high - ratio * (high - low), low + ratio * (high - low)];
    let mut values = [function(inner[0]), function(inner[1])];
    for _ in 0..GOLDEN_STEPS {
        if values[0] <= values[1] {
            high = inner[1];
            inner[1] = inner[0];
            values[1] = values[0];
            inner[0] = high - ratio * (high - low);
            values[0] = function(inner[0]);
        } else {
            low = inner[0];
            inner[0] = inner[1];
            values[0] = values[1];
            inner[1] = low + ratio * (high - low);
            values[1] = function(inner[1]);
        }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_curve_is_recovered() {
        for (steady, constant) in [(20.0, 0.6), (-3.0, 0.01), (1e-3, 40.0)] {
            let times: Vec<f64> = (1..=200).map(|i| f64::from(i) * 0.02).collect();
            let truth = ExponentialFit { steady_speed: steady, time_constant: constant, residual: 0.0 };
            let speeds: Vec<f64> = times.iter().map(|&time| truth.speed(time)).collect();
            let fit = ExponentialFit::new(&times, &speeds).expect("legal curve");
            // The residual is flat at its minimum: half of the digits of the time constant are lost.
            assert!((fit.time_constant / constant - 1.0).abs() < 1e-5, "{fit:?}");
            assert!((fit.steady_speed / steady - 1.0).abs() < 1e-5, "{fit:?}");
            assert!((fit.stall_acceleration() - fit.steady_speed / fit.time_constant).abs() <= 0.0);
        }
    }

    /// Root of the mean square by which a model misses a curve.
    fn misfit(times: &[f64], speeds: &[f64], model: impl Fn(f64) -> f64) -> f64 {
        let squares: Vec<f64> = times
            .iter()
            .zip(speeds)
            .map(|(&time, speed)| (speed - model(time)) * (speed - model(time)))
            .collect();
        (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()
    }

    /// Neither parameter can be changed a little without the sum of squares growing, and the residual is its mean's root.
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
            let curve = ExponentialFit::new(&times, &speeds).expect("legal curve");
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

    /// A curve that has not begun to saturate, and one that has done so before its first point, end where the search does.
    #[test]
    fn time_constants_lie_between_a_tenth_of_the_first_and_a_hundred_times_the_last_time() {
        let times = [0.0, 0.5, 1.0, 2.0, 4.0];
        let straight = ExponentialFit::new(&times, &times).expect("legal curve");
        assert!((straight.time_constant / 400.0 - 1.0).abs() < 1e-6, "{straight:?}");
        let at_once = ExponentialFit::new(&times, &[0.0, 7.0, 7.0, 7.0, 7.0]).expect("legal curve");
        assert!((at_once.time_constant / 0.05 - 1.0).abs() < 1e-6, "{at_once:?}");
        assert!((at_once.steady_speed - 7.0).abs() < 1e-3);
        // A disk that does not turn.
        let still = ExponentialFit::new(&times[..3], &[0.0; 3]).expect("three points are enough");
        assert!(still.steady_speed.abs() <= 0.0 && still.residual.abs() <= 0.0, "{still:?}");
    }

    #[test]
    fn the_stall_torque_is_that_of_a_ring() {
        let fit = ExponentialFit { steady_speed: 30.0, time_constant: 0.25, residual: 0.0 };
        assert!((fit.stall_acceleration() - 120.0).abs() < 1e-12);
        assert!((fit.stall_torque(0.5, 0.2) - 0.5 * 0.04 * 120.0).abs() < 1e-12);
        // After one time constant all but 1/e of the speed is there.
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
        let other = ExponentialFit::new(&times, &speeds).expect("legal curve");
        assert!(fit.residual < 1e-3 * other.residual);
    }

    #[test]
    fn illegal_curves_are_named() {
        assert!(ExponentialFit::new(&[0.0, 1.0], &[0.0, 1.0]).is_err());
        assert!(ExponentialFit::new(&[0.0, 1.0, 1.0], &[0.0, 1.0, 2.0]).is_err());
        assert!(ExponentialFit::new(&[0.0, 1.0, 2.0], &[0.0, 1.0]).is_err());
        assert!(ExponentialFit::new(&[0.0, 1.0, 2.0], &[0.0, f64::NAN, 1.0]).is_err());
    }
}
