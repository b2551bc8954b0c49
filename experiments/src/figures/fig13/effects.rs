//! How a motor answers to one parameter: read in the same way from the means of ensembles and from single orbits.

use bouncing_disk::core::numerics::elementary::{cos, ln};
use serde::Serialize;

use crate::claims::Cases;
use crate::claims::judging::trend;
use crate::figures::shared::inputs::{Input, motor as inputs};
use crate::figures::shared::motor::{MotorCase, MotorStatistics};
use crate::figures::shared::numbers::{self, StraightLine};

/// A motor with one value of a parameter: the mean of an ensemble, or a single orbit.
#[derive(Clone, Copy, Debug)]
pub(super) struct Reading {
    pub(super) value: f64,
    pub(super) speed_rad_per_s: f64,
    /// Steady speed over ωΦ.
    pub(super) speed_ratio: f64,
    /// α̇_ss/t_c, and the same over μ a_e g/a_g²; `None` where the speed does not settle.
    pub(super) stall_rad_per_s2: Option<f64>,
    pub(super) stall_over_limit: Option<f64>,
    /// Whether the exponential fits the transient better than a linear rise to a constant.
    pub(super) is_exponential: bool,
}

impl Reading {
    /// The mean of an ensemble.
    pub(super) fn of(value: f64, case: &MotorCase, statistics: &MotorStatistics) -> Self {
        let speed = statistics.steady_speed_rad_per_s.mean;
        let stall = statistics.stall_acceleration_rad_per_s2.map(|spread| spread.mean);
        Self {
            value,
            speed_rad_per_s: speed,
            speed_ratio: speed / case.peak_angular_speed_rad_per_s,
            stall_rad_per_s2: stall,
            stall_over_limit: stall.map(|stall| stall / case.largest_acceleration()),
            is_exponential: statistics.is_exponential,
        }
    }

    /// Whether neither is above the maximum that ωΦ or μ sets; `None` where the paper does not define the stall torque, because
    /// the transient is not exponential.
    pub(super) fn is_within_limits(&self) -> Option<bool> {
        let stall = self.stall_over_limit.filter(|_| self.is_exponential)?;
        Some(self.speed_ratio.abs() <= 1.0 && stall.abs() <= 1.0)
    }
}

/// A motor with several values of one parameter.
#[derive(Debug)]
pub(super) struct Varied {
    pub(super) parameter: Input<MotorCase>,
    pub(super) readings: Vec<Reading>,
}

/// What is read.
pub(super) type Quantity = fn(&Reading) -> Option<f64>;

pub(super) fn speed(reading: &Reading) -> Option<f64> {
    Some(reading.speed_rad_per_s)
}

pub(super) fn stall(reading: &Reading) -> Option<f64> {
    reading.stall_rad_per_s2
}

impl Varied {
    /// As (value, quantity), motors on a low-period cycle among them.
    pub(super) fn points(&self, of: Quantity) -> Vec<(f64, f64)> {
        self.readings.iter().filter_map(|reading| Some((reading.value, of(reading)?))).collect()
    }

    fn line(&self, of: Quantity) -> Option<StraightLine> {
        let coordinate = |x: f64| if self.parameter == inputs::AMPLITUDE { ln(x) } else { x };
        let points = self.points(of).into_iter().map(|(x, y)| (coordinate(x), y));
        StraightLine::through(&points.collect::<Vec<_>>())
    }

    /// By how much a quantity changes over the range of the parameter: along a straight line, of A in its logarithm, of θ along a
    /// cosine.
    fn change(&self, of: Quantity) -> Option<f64> {
        let points = self.points(of);
        let (first, last) = (points.first()?.0, points.last()?.0);
        if self.parameter == inputs::PHASE_LAG {
            return cosine_fit(&points).map(|fit| 2.0 * fit.0);
        }
        let slope = self.line(of)?.slope;
        let logarithmic = self.parameter == inputs::AMPLITUDE;
        Some(slope * if logarithmic { ln(last) - ln(first) } else { last - first })
    }

    fn sensitivity(&self, default: &Reading, exponent: Exponent) -> Sensitivity {
        let change = |of: Quantity| Some((self.change(of)? / of(default)?).abs());
        let exponent =
            |of: Quantity| exponent(&self.points(of)).filter(|_| self.parameter != inputs::PHASE_LAG);
        Sensitivity {
            parameter: self.parameter,
            speed_change: change(speed),
            stall_change: change(stall),
            speed_exponent: exponent(speed),
            stall_exponent: exponent(stall),
            stall_explained: self.line(stall).map(|line| line.explained),
        }
    }
}

/// How an exponent is found from (value, quantity).
pub(super) type Exponent = fn(&[(f64, f64)]) -> Option<f64>;

/// Of many values: the middle one of all pairs, which a few motors on short cycles do not move.
pub(super) fn middle_exponent(points: &[(f64, f64)]) -> Option<f64> {
    numbers::median_exponent(points.iter().copied())
}

/// Of few values: that of the straight line through the logarithms.
pub(super) fn line_exponent(points: &[(f64, f64)]) -> Option<f64> {
    let positive = points.iter().filter(|(x, y)| *x > 0.0 && *y > 0.0);
    let logarithms: Vec<_> = positive.map(|(x, y)| (ln(*x), ln(*y))).collect();
    StraightLine::through(&logarithms).map(|line| line.slope)
}

/// The effect of a parameter by the trend over its range, a straight line in the parameter (of A in its logarithm, of θ a
/// cosine), relative to the motor as printed.
#[derive(Clone, Copy, Debug, Serialize)]
pub(super) struct Sensitivity {
    pub(super) parameter: Input<MotorCase>,
    /// Change of the steady speed and of α̇_ss/t_c from one end of the range to the other.
    pub(super) speed_change: Option<f64>,
    pub(super) stall_change: Option<f64>,
    /// Exponents of both; of θ none.
    pub(super) speed_exponent: Option<f64>,
    pub(super) stall_exponent: Option<f64>,
    /// Share of the variance of α̇_ss/t_c that the line explains.
    pub(super) stall_explained: Option<f64>,
}

/// The effects of all five parameters.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Effects {
    /// Slopes of the straight lines through steady speed over ωΦ, and through α̇_ss/t_c over the limit, against ε.
    speed_ratio_slope: Option<f64>,
    stall_over_limit_slope: Option<f64>,
    /// The rise of the second of these lines over the range of ε, relative to its value at the first ε.
    pub(super) stall_over_limit_rise: Option<f64>,
    /// Share of the ε at which the exponential fits the transient better than a linear rise to a constant.
    pub(super) share_of_exponential: f64,
    /// The effect of each parameter, in the order of the panels.
    pub(super) sensitivities: Vec<Sensitivity>,
    /// Share of the variance of steady speed and of α̇_ss/t_c over θ that a cosine explains.
    pub(super) speed_cosine: Option<f64>,
    pub(super) stall_cosine: Option<f64>,
    /// Pairs of ε of which the larger has the lower steady speed, and the lower α̇_ss/t_c.
    #[serde(skip)]
    pub(super) falls: [Cases; 2],
}

impl Effects {
    /// Of a motor with other values of each parameter, in the order of the panels; `default` is the motor as printed.
    pub(super) fn of(sweeps: &[Varied; 5], default: &Reading, exponent: Exponent) -> Self {
        let [_, by_restitution, by_lag, ..] = sweeps;
        let readings = &by_restitution.readings;
        let range =
            readings.last().zip(readings.first()).map_or(0.0, |(last, first)| last.value - first.value);
        let over_limit = by_restitution.line(|reading| reading.stall_over_limit);
        let exponential = readings.iter().filter(|reading| reading.is_exponential).count();
        Self {
            speed_ratio_slope: by_restitution
                .line(|reading| Some(reading.speed_ratio))
                .map(|line| line.slope),
            stall_over_limit_slope: over_limit.map(|line| line.slope),
            stall_over_limit_rise: over_limit.map(|line| line.slope * range / line.intercept),
            share_of_exponential: exponential as f64 / readings.len() as f64,
            sensitivities: sweeps.iter().map(|sweep| sweep.sensitivity(default, exponent)).collect(),
            speed_cosine: cosine_fit(&by_lag.points(speed)).map(|fit| fit.1),
            stall_cosine: cosine_fit(&by_lag.points(stall)).map(|fit| fit.1),
            falls: [speed as Quantity, stall].map(|of| trend(by_restitution.points(of), -1.0)),
        }
    }

    /// The effect of this parameter.
    pub(super) fn parameter(&self, parameter: Input<MotorCase>) -> Option<&Sensitivity> {
        self.sensitivities.iter().find(|sensitivity| sensitivity.parameter == parameter)
    }
}

/// y = c cos θ by least squares: c, and the share of the variance that it explains. `None` of fewer than three points.
pub(super) fn cosine_fit(points: &[(f64, f64)]) -> Option<(f64, f64)> {
    if points.len() < 3 {
        return None;
    }
    let (mut products, mut squares) = (0.0, 0.0);
    for (angle, value) in points {
        products += cos(*angle) * value;
        squares += cos(*angle) * cos(*angle);
    }
    let factor = products / squares;
    let mean = points.iter().map(|point| point.1).sum::<f64>() / points.len() as f64;
    let (mut rest, mut all) = (0.0, 0.0);
    for (angle, value) in points {
        let (off, from_mean) = (value - factor * cos(*angle), value - mean);
        rest += off * off;
        all += from_mean * from_mean;
    }
    Some((factor, 1.0 - rest / all))
}
