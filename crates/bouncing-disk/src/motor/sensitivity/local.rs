//! Local sensitivities: the exponent of the power law that relates the steady speed or the stall torque to a
//! parameter, for small changes (Fig. 13).
//!
//! **On one vertical motion.** Friction, twist, lag, radii and load do not affect the vertical motion, so the
//! same perturbed orbits serve for all steps. If q± are a member's values at ±s, (q₊ − q₋)/2 is odd in s. A
//! least-squares cubic a s + b s³ through s = 0.04, 0.08, 0.12 and 0.16 gives the member's slope a. The
//! derivative is the mean slope over the mean of q, with the standard error of a ratio of means. If the slope
//! of a polynomial with a third term c s⁵ differs from a by more than 1.96 errors of the difference, the
//! excess is added to the error in quadrature (`curvature`). Lags vary by radians and loads by shares of μ m
//! g a_e, because both may be zero. A member's stall torque is the zero of the straight line through its
//! speeds under five loads, up to 0.06 μ m g a_e from the stall load.
//!
//! *Test.* The rotary motion depends on friction, twist and radii only through μ and Q = a_g² Φ ω²/(a_e g).
//! Hence the no-load speed is ω Φ times a function of Q/μ, and the stall torque is μ m g a_e times another
//! function of Q/μ. If the speed has the exponent x in friction, its exponents in twist, contact radius and
//! radius of gyration are 1 − x, x and −2 x. If the stall torque has the exponent y in twist, the other
//! exponents are 1 − y, 1 − y and 2 y.
//!
//! **The vertical motion.** Speeds as functions of amplitude, preload, restitution and frequency are rough at
//! every scale: only trends are meaningful. Motors are sampled, one in each equal part of a stated range,
//! because a grid could hit or miss the traps; motors in a low-period trap are counted and excluded. The
//! exponent, which depends on the range, is the slope of a straight line through the rest over the logarithm
//! of the parameter. Its standard error follows from the scatter about the line. The frequency is varied at a
//! fixed largest angular speed of the stator.
//!
//! *Coverage.* For each parameter of two motors, 92 to 98 of 100 intervals at the 95 % level contain the mean
//! exponent of the steady speed (`motor/sensitivity/local/tests.rs`).

use bouncing_disk_core::numerics::elementary::{exp, hypot, ln};
use bouncing_disk_core::numerics::random::SplitMix64;
use bouncing_disk_core::numerics::statistics::{NORMAL_975, mean};
use bouncing_disk_core::{Observer, Progress};

use crate::error::{Error, check, positive};
use crate::motor::data_sheet::Motor;
use crate::motor::operation::loaded_motor::LoadedMotor;
use crate::motor::operation::point::Estimate;
use crate::motor::operation::settings::OperatingSettings;
use crate::motor::operation::steady_run::operate;
use crate::motor::sensitivity::parameter::{SensitivityParameter, SensitivityQuantity};
use crate::statistics::student_quantile;

/// Steps of the central differences: changes of the logarithm of a parameter, of the phase lag in radians, or
/// of the load in units of mu m g a_e. Upwards and downwards they need eight rotors, one full row.
const STEPS: [f64; 4] = [0.16, 0.12, 0.08, 0.04];

/// Loads relative to the stall load, as shares of mu m g a_e, at which the speeds are computed. The stall
/// load of each member is the zero of a straight line through its speeds.
const SHARES: [f64; 5] = [-0.06, -0.03, 0.0, 0.03, 0.06];

/// The fewest motors for a regression.
const LEAST_POINTS: usize = 5;

/// Settings for computing local sensitivities.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct SensitivitySettings {
    /// Settings for the operation of each motor.
    pub operating: OperatingSettings,
    /// Half of the range over which motors are sampled, in the logarithm of a parameter of the vertical
    /// motion; in (0, 2]. Default 0.2: from 82 % to 122 % of the motor's own value.
    pub half_range: f64,
    /// The number of motors sampled over this range, in [5, 10000]. Default 24.
    pub points: usize,
}

impl Default for SensitivitySettings {
    fn default() -> Self {
        Self { operating: OperatingSettings::default(), half_range: 0.2, points: 24 }
    }
}

impl SensitivitySettings {
    fn check(&self) -> Result<(), Error> {
        self.operating.check()?;
        let legal = self.half_range > 0.0 && self.half_range <= 2.0;
        check(legal, "half_range", self.half_range, "(0, 2]")?;
        let points = (LEAST_POINTS..=10_000).contains(&self.points);
        check(points, "points", self.points as f64, "[5, 10000]")?;
        Ok(())
    }
}

/// How a sensitivity was computed.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum SensitivityMethod {
    /// Central differences of rotors on the same vertical motions.
    SharedMotion {
        /// The standard error due to the scatter of the members.
        scatter: f64,
        /// The error of fitting a cubic to the differences, estimated by adding a fifth-order term. This
        /// error is zero if the scatter alone explains the change of the slope.
        curvature: f64,
    },
    /// A straight line through motors with different vertical motions, sampled over the range in the
    /// settings.
    Regression {
        /// Number of motors to which the line is fitted.
        points: usize,
        /// Number of motors omitted because they are in a low-period trap.
        traps: usize,
        /// Standard deviation of the motors about the line, relative to their mean.
        scatter: f64,
    },
}

/// The dependence of a quantity on a parameter, for small changes of a motor.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct LocalSensitivity {
    /// The parameter.
    pub parameter: SensitivityParameter,
    /// d ln(quantity)/d ln(parameter); for the phase lag, d ln(quantity)/d theta (1/rad); for the load
    /// torque, the derivative of ln(quantity) with respect to the torque in units of mu m g a_e.
    pub derivative: Estimate,
    /// How the derivative was computed.
    pub method: SensitivityMethod,
}

impl Motor {
    /// The dependence of the steady speed or the stall torque on these parameters for small changes of the
    /// motor, in the order of the parameters.
    ///
    /// The observer's items are ensembles of motors that share a vertical motion.
    ///
    /// ```no_run
    /// # use bouncing_disk::core::Unobserved;
    /// use bouncing_disk::Motor;
    /// use bouncing_disk::motor::{SensitivityParameter, SensitivityQuantity, SensitivitySettings};
    ///
    /// let motor = Motor::paper_70_khz();
    /// let all = motor.local_sensitivities(
    ///     SensitivityQuantity::SteadySpeed,
    ///     &[SensitivityParameter::Friction, SensitivityParameter::PeakAngularSpeed],
    ///     &SensitivitySettings::default(), &Unobserved)?;
    /// // The speed without load hardly depends on friction, but strongly on the speed of the stator.
    /// assert!(all[0].derivative.value < 0.1 && all[1].derivative.value > 0.9);
    /// # Ok::<(), bouncing_disk::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for illegal settings, for a parameter of zero, which has no logarithm, and for a
    /// parameter that leaves its range; [`Error::DoesNotTurn`] for a motor that does not turn;
    /// [`Error::Overpowered`] for a load larger than friction can hold; [`Error::TooFewMotors`] if too few
    /// motors are outside traps; the errors of [`Motor::rigid_sine`] and [`Motor::operating_point`].
    pub fn local_sensitivities(
        &self,
        quantity: SensitivityQuantity,
        parameters: &[SensitivityParameter],
        settings: &SensitivitySettings,
        observer: &dyn Observer,
    ) -> Result<Vec<LocalSensitivity>, Error> {
        settings.check()?;
        self.rigid_sine()?;
        let shared: Vec<_> =
            parameters.iter().copied().filter(|parameter| parameter.shares_vertical_motion()).collect();
        let others = parameters.len() - shared.len();
        let total = (usize::from(!shared.is_empty()) + others * settings.points) as u64;
        let mut done = 0;
        let mut shared = if shared.is_empty() {
            Vec::new()
        } else {
            let observer = |_: Progress| observer.observe(Progress { done: 0, total });
            let results = by_differences(self, quantity, &shared, settings, &observer)?;
            done += 1;
            results
        }
        .into_iter();
        let mut results = Vec::with_capacity(parameters.len());
        for &parameter in parameters {
            let known = if parameter.shares_vertical_motion() { shared.next() } else { None };
            results.push(match known {
                Some(known) => known,
                None => by_regression(self, parameter, settings, &mut |motor| {
                    let item = done;
                    done += 1;
                    let observer = |_: Progress| observer.observe(Progress { done: item, total });
                    quantity_of(motor, quantity, &settings.operating, &observer)
                })?,
            });
        }
        // The answer does not matter, as nothing is left to stop.
        let _ = observer.observe(Progress { done: total, total });
        Ok(results)
    }
}

/// The quantity of a motor.
pub(crate) fn quantity_of(
    motor: &Motor,
    quantity: SensitivityQuantity,
    settings: &OperatingSettings,
    observer: &dyn Observer,
) -> Result<Estimate, Error> {
    match quantity {
        SensitivityQuantity::SteadySpeed => {
            let operation = motor.operating_point(motor.load_torque(), settings, observer)?;
            let loaded = LoadedMotor::of_sine(motor)?;
            operation.point().map(|point| point.speed).ok_or(Error::Overpowered { load: loaded.load() })
        }
        SensitivityQuantity::StallTorque => Ok(motor.stall_load(settings, observer)?.torque),
    }
}

/// The motor after a step in the logarithm of a parameter, or in the parameter itself if it may be zero.
fn moved(motor: &Motor, parameter: SensitivityParameter, step: f64) -> Result<Motor, Error> {
    let value = parameter.of(motor);
    let value = match parameter {
        SensitivityParameter::PhaseLag => value + step,
        SensitivityParameter::LoadTorque => value + step * motor.largest_torque(),
        _ => positive(parameter.name(), value)? * exp(step),
    };
    parameter.set(motor, value)
}

/// The sensitivities to all parameters that do not affect the vertical motion: the rotors for all parameters
/// and steps run on one ensemble of orbits.
fn by_differences(
    motor: &Motor,
    quantity: SensitivityQuantity,
    parameters: &[SensitivityParameter],
    settings: &SensitivitySettings,
    observer: &dyn Observer,
) -> Result<Vec<LocalSensitivity>, Error> {
    let mut motors = vec![motor.clone()];
    for &parameter in parameters {
        for step in STEPS {
            motors.push(moved(motor, parameter, step)?);
            motors.push(moved(motor, parameter, -step)?);
        }
    }
    let [middle, above] = member_values(&motors, motor, quantity, &settings.operating, observer)?;
    let own = Estimate::of(&middle[0])?;
    let standing = Error::DoesNotTurn { speed: own.value, standard_error: own.standard_error };
    if own.value.abs() <= 4.0 * own.standard_error {
        return Err(standing);
    }
    // For the odd polynomials of two and three terms through the differences, for each member.
    let [cubic, quintic] = [slope_weights(2), slope_weights(3)];
    let left_out = std::array::from_fn(|step| cubic[step] - quintic[step]);
    let slope = |values: &[Vec<f64>], first: usize, weights: &[f64; STEPS.len()]| {
        let pairs = || values[first..].chunks_exact(2).zip(weights);
        let of_member = |member: usize| {
            pairs().map(|(pair, weight)| 0.5 * weight * (pair[0][member] - pair[1][member])).sum::<f64>()
        };
        let signed = |value: f64| own.value.signum() * value;
        let slopes: Vec<f64> = (0..values[0].len()).map(|member| signed(of_member(member))).collect();
        let divisors: Vec<f64> = values[0].iter().map(|&value| signed(value)).collect();
        Estimate::of_ratio(&slopes, &divisors).ok_or(standing)
    };
    let mut results = Vec::with_capacity(parameters.len());
    for (index, &parameter) in parameters.iter().enumerate() {
        let first = 1 + 2 * STEPS.len() * index;
        let derivative = slope(&middle, first, &cubic)?.bounded_by(slope(&above, first, &cubic)?);
        let missing = slope(&middle, first, &left_out)?;
        let scatter = derivative.standard_error;
        let curvature = (missing.value.abs() - NORMAL_975 * missing.standard_error).max(0.0);
        results.push(LocalSensitivity {
            parameter,
            derivative: Estimate { standard_error: hypot(scatter, curvature), ..derivative },
            method: SensitivityMethod::SharedMotion { scatter, curvature },
        });
    }
    Ok(results)
}

/// The weights of the values at the steps in the slope at zero of the least-squares odd polynomial with this
/// number of terms, which are made orthogonal one by one.
fn slope_weights(terms: usize) -> [f64; STEPS.len()] {
    let dot = |one: &[f64; STEPS.len()], other: &[f64; STEPS.len()]| {
        one.iter().zip(other).map(|(one, other)| one * other).sum::<f64>()
    };
    let mut basis: Vec<([f64; STEPS.len()], f64)> = Vec::with_capacity(terms);
    let (mut powers, mut weights) = (STEPS, [0.0; STEPS.len()]);
    for term in 0..terms {
        let (mut values, mut slope) = (powers, if term == 0 { 1.0 } else { 0.0 });
        for (other, other_slope) in &basis {
            let share = dot(&powers, other) / dot(other, other);
            values.iter_mut().zip(other).for_each(|(value, other)| *value -= share * other);
            slope -= share * other_slope;
        }
        let part = slope / dot(&values, &values);
        weights.iter_mut().zip(values).for_each(|(weight, value)| *weight += part * value);
        basis.push((values, slope));
        powers.iter_mut().zip(STEPS).for_each(|(power, step)| *power *= step * step);
    }
    weights
}

/// The quantity for each motor and member, all on the same vertical motions: averaged over the rotors from
/// far below and far above all steady speeds, and for the rotor from above.
fn member_values(
    motors: &[Motor],
    nominal: &Motor,
    quantity: SensitivityQuantity,
    settings: &OperatingSettings,
    observer: &dyn Observer,
) -> Result<[Vec<Vec<f64>>; 2], Error> {
    let speeds = |loaded: &[LoadedMotor<'_>]| {
        let results = operate(loaded, settings, observer)?;
        match results.speeds.iter().position(Vec::is_empty) {
            Some(index) => Err(Error::Overpowered { load: loaded[index].load() }),
            None => Ok([results.speeds, results.speeds_from_above]),
        }
    };
    match quantity {
        SensitivityQuantity::SteadySpeed => {
            speeds(&motors.iter().map(LoadedMotor::of_sine).collect::<Result<Vec<_>, _>>()?)
        }
        SensitivityQuantity::StallTorque => {
            let stall = nominal.stall_load(settings, observer)?.share;
            let shares = SHARES.map(|offset| (stall + offset).clamp(-0.999, 0.999));
            let mut loaded = Vec::with_capacity(motors.len() * shares.len());
            for motor in motors {
                for share in shares {
                    loaded.push(LoadedMotor::of_sine(motor)?.with_load(share * motor.largest_torque())?);
                }
            }
            let torques = |speeds: Vec<Vec<f64>>| {
                let of_motor = |(speeds, motor): (&[Vec<f64>], &Motor)| {
                    let of_member =
                        |member: usize| crossing(&shares, |k| speeds[k][member]) * motor.largest_torque();
                    (0..speeds[0].len()).map(of_member).collect()
                };
                speeds.chunks_exact(shares.len()).zip(motors).map(of_motor).collect()
            };
            Ok(speeds(&loaded)?.map(torques))
        }
    }
}

/// The straight line through motors sampled over a range: one at random in each of its equal parts, because a
/// grid could systematically hit or miss the values that trap a motor.
fn by_regression(
    motor: &Motor,
    parameter: SensitivityParameter,
    settings: &SensitivitySettings,
    quantity_of: &mut dyn FnMut(&Motor) -> Result<Estimate, Error>,
) -> Result<LocalSensitivity, Error> {
    let centre = positive(parameter.name(), parameter.of(motor))?;
    let mut random = SplitMix64::new(settings.operating.seed);
    let (mut offsets, mut values, mut traps) = (Vec::new(), Vec::new(), 0);
    for index in 0..settings.points {
        let share = (index as f64 + random.unit()) / settings.points as f64;
        let offset = settings.half_range * (2.0 * share - 1.0);
        let motor = parameter.set(motor, centre * exp(offset))?;
        if motor.trap_verdict()?.is_trap {
            traps += 1;
        } else {
            values.push(quantity_of(&motor)?.value);
            offsets.push(ln(parameter.of(&motor) / centre));
        }
    }
    if values.len() < LEAST_POINTS {
        return Err(Error::TooFewMotors { left: values.len(), traps, needed: LEAST_POINTS });
    }
    let line = RegressionLine::through(&offsets, &values);
    if line.centre.abs() <= 4.0 * line.scatter / (values.len() as f64).sqrt() {
        let standard_error = line.scatter / (values.len() as f64).sqrt();
        return Err(Error::DoesNotTurn { speed: line.centre, standard_error });
    }
    Ok(LocalSensitivity {
        parameter,
        derivative: Estimate {
            value: line.slope / line.centre,
            standard_error: line.slope_error / line.centre.abs(),
        },
        method: SensitivityMethod::Regression {
            points: values.len(),
            traps,
            scatter: line.scatter / line.centre.abs(),
        },
    })
}

/// A least-squares line.
struct RegressionLine {
    /// The value of the line at offset zero.
    centre: f64,
    slope: f64,
    slope_error: f64,
    /// Standard deviation from the line.
    scatter: f64,
}

impl RegressionLine {
    fn through(offsets: &[f64], values: &[f64]) -> Self {
        let (x, y) = (mean(offsets), mean(values));
        let (mut square, mut product) = (0.0, 0.0);
        for (offset, value) in offsets.iter().zip(values) {
            square += (offset - x) * (offset - x);
            product += (offset - x) * (value - y);
        }
        let slope = product / square;
        let rests = offsets.iter().zip(values).map(|(offset, value)| value - y - slope * (offset - x));
        let rest = rests.map(|rest| rest * rest).sum::<f64>();
        let variance = rest / (values.len() as f64 - 2.0);
        Self {
            centre: y - slope * x,
            slope,
            // Half of Student's interval divided by 1.96, as for all estimates.
            slope_error: (variance / square).sqrt() * student_quantile(values.len() as f64 - 2.0)
                / NORMAL_975,
            scatter: variance.sqrt(),
        }
    }
}

/// The position at which the least-squares line through the speeds at these shares vanishes.
fn crossing(shares: &[f64], speed: impl Fn(usize) -> f64) -> f64 {
    let x = mean(shares);
    let y = mean(&(0..shares.len()).map(&speed).collect::<Vec<_>>());
    let (mut square, mut product) = (0.0, 0.0);
    for (k, share) in shares.iter().enumerate() {
        square += (share - x) * (share - x);
        product += (share - x) * (speed(k) - y);
    }
    x - y * square / product
}

#[cfg(test)]
mod tests;
