//! The numbers of Fig. 13, and what is read off its sweeps.

use bouncing_disk::core::numerics::elementary::{cos, ln};
use serde::Serialize;

use crate::claims::Cases;
use crate::figures::shared::motor::{MotorCase, MotorStatistics};
pub(super) use crate::figures::shared::numbers::extent;
use crate::figures::shared::numbers::{Concentration, StraightLine};

/// The identifier of the figure.
pub(super) const ID: &str = "fig13";

/// The data of Fig. 13.
#[derive(Debug, Serialize)]
pub(crate) struct Fig13Data {
    pub(super) motor: MotorCase,
    pub(super) members: usize,
    pub(super) rises: f64,
    pub(super) relaunch_perturbation: f64,
    /// The second perturbation, in units of g/ω, which breaks most low-period cycles.
    pub(super) breaking_perturbation: f64,
    pub(super) default: MotorStatistics,
    /// In the order of the panels.
    pub(super) sweeps: Vec<Sweep>,
    /// Where the impulse falls in the cycle, for three ε.
    pub(super) impulses: Vec<ImpulsePhases>,
    /// Motors that print alike, by ε.
    pub(super) alike: AlikeMotors,
}

/// A parameter of Fig. 13.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Parameter {
    Friction,
    Restitution,
    PhaseLag,
    Amplitude,
    PeakAngularSpeed,
}

impl Parameter {
    pub(super) const ALL: [Self; 5] =
        [Self::Friction, Self::Restitution, Self::PhaseLag, Self::Amplitude, Self::PeakAngularSpeed];

    /// The paper's symbol.
    pub(super) const fn symbol(self) -> &'static str {
        match self {
            Self::Friction => "μ",
            Self::Restitution => "ε",
            Self::PhaseLag => "θ",
            Self::Amplitude => "A",
            Self::PeakAngularSpeed => "ωΦ",
        }
    }

    pub(super) const fn unit(self) -> &'static str {
        match self {
            Self::Friction | Self::Restitution => "",
            Self::PhaseLag => "rad",
            Self::Amplitude => "m",
            Self::PeakAngularSpeed => "rad/s",
        }
    }

    /// Its value for a motor.
    pub(super) const fn of(self, motor: &MotorCase) -> f64 {
        match self {
            Self::Friction => motor.friction,
            Self::Restitution => motor.restitution,
            Self::PhaseLag => motor.phase_lag_rad,
            Self::Amplitude => motor.amplitude_m,
            Self::PeakAngularSpeed => motor.peak_angular_speed_rad_per_s,
        }
    }

    /// The motor with this parameter changed.
    pub(super) const fn set(self, motor: &MotorCase, value: f64) -> MotorCase {
        let mut case = *motor;
        *(match self {
            Self::Friction => &mut case.friction,
            Self::Restitution => &mut case.restitution,
            Self::PhaseLag => &mut case.phase_lag_rad,
            Self::Amplitude => &mut case.amplitude_m,
            Self::PeakAngularSpeed => &mut case.peak_angular_speed_rad_per_s,
        }) = value;
        case
    }
}

/// One panel.
#[derive(Debug, Serialize)]
pub(super) struct Sweep {
    pub(super) parameter: Parameter,
    pub(super) points: Vec<SweepPoint>,
}

/// One value of the parameter.
#[derive(Debug, Serialize)]
pub(super) struct SweepPoint {
    pub(super) value: f64,
    pub(super) peak_angular_speed_rad_per_s: f64,
    pub(super) statistics: MotorStatistics,
    /// From the phases of the impulses: steady speed over ωΦ, and α̇_ss/t_c of the curve fitted as the
    /// ensembles are.
    pub(super) predicted_speed_ratio: f64,
    pub(super) predicted_stall_acceleration_rad_per_s2: Option<f64>,
    /// Means over the impacts that are not summed.
    pub(super) mean_impact_speed_m_per_s: f64,
    pub(super) mean_impact_interval_s: f64,
}

impl SweepPoint {
    pub(super) fn speed_ratio(&self) -> f64 {
        self.statistics.steady_speed_rad_per_s.mean / self.peak_angular_speed_rad_per_s
    }

    pub(super) fn stall(&self) -> Option<f64> {
        self.statistics.stall_acceleration_rad_per_s2.map(|spread| spread.mean)
    }
}

/// Normal impulse by phase.
#[derive(Debug, Serialize)]
pub(super) struct ImpulsePhases {
    pub(super) restitution: f64,
    /// Shares in equal parts of the cycle from τ = −π to π.
    pub(super) shares: Vec<f64>,
    /// Where in the cycle the normal impulse is concentrated, and the collisions that end a flight of more than half a period.
    pub(super) impulse: Option<Concentration>,
    pub(super) collisions: Option<Concentration>,
}

/// Motors whose inputs all print like Table III's, at some values of ε: the same draws of the other inputs at
/// each. Nothing perturbs them.
#[derive(Debug, Serialize)]
pub(super) struct AlikeMotors {
    /// The ranges drawn from.
    pub(super) inputs: String,
    /// Motors drawn.
    pub(super) drawn: usize,
    /// What most of them do with other values of each parameter, in the order of the panels.
    pub(super) ranges: Vec<AlikeRange>,
    /// By rising ε.
    pub(super) prevalence: Vec<Prevalence>,
    /// By draw.
    pub(super) draws: Vec<Draw>,
}

/// The middle nine tenths of these motors with other values of one parameter.
#[derive(Debug, Serialize)]
pub(super) struct AlikeRange {
    pub(super) parameter: Parameter,
    pub(super) values: Vec<f64>,
    /// Steady speed over ωΦ, and α̇_ss/t_c (rad/s²) of those that settle, at each value.
    pub(super) speed_ratio: Vec<[f64; 2]>,
    pub(super) stall_acceleration_rad_per_s2: Vec<[f64; 2]>,
}

/// The cycles of these motors at one ε.
#[derive(Debug, Serialize)]
pub(super) struct Prevalence {
    pub(super) restitution: f64,
    /// Share of motors of low period.
    pub(super) share_of_low_period: f64,
    /// Number of flights, and the share of motors with chattering cycles of no more.
    pub(super) share_up_to: Vec<(usize, f64)>,
    /// Share of motors whose cycle takes at most a hundredth of the rise time, so that the speed rises in
    /// lines.
    pub(super) share_of_short: f64,
    /// Of the motors that settle and whose rise is exponential, how many have an α̇_ss/t_c of at most the
    /// limit μ a_e g/a_g².
    pub(super) within_limit: Cases,
}

/// One draw of the inputs other than ε.
#[derive(Debug, Serialize)]
pub(super) struct Draw {
    /// Slopes of the straight lines through steady speed over ωΦ, and through α̇_ss/t_c over the limit,
    /// against ε.
    pub(super) speed_ratio_slope: Option<f64>,
    pub(super) stall_over_limit_slope: Option<f64>,
    /// The rise of the second of these lines over the range of ε, relative to its value at the first ε.
    pub(super) stall_over_limit_rise: Option<f64>,
    /// Share of the ε at which the exponential fits the transient better than a linear rise to a constant.
    pub(super) share_of_exponential: f64,
    /// The effect of each parameter, in the order of the panels.
    pub(super) sensitivities: Vec<Sensitivity>,
    /// Share of the variance of steady speed and of α̇_ss/t_c over θ that a cosine explains.
    pub(super) speed_cosine: Option<f64>,
    pub(super) stall_cosine: Option<f64>,
}

/// The effect of a parameter on a motor that nothing perturbs: by the trend over the range, a straight line
/// in the parameter (of A in its logarithm, of θ a cosine), relative to the motor as printed.
#[derive(Clone, Copy, Debug, Serialize)]
pub(super) struct Sensitivity {
    pub(super) parameter: Parameter,
    /// Change of the steady speed and of α̇_ss/t_c from one end of the range to the other.
    pub(super) speed_change: Option<f64>,
    pub(super) stall_change: Option<f64>,
    /// Exponents of both; of θ none.
    pub(super) speed_exponent: Option<f64>,
    pub(super) stall_exponent: Option<f64>,
    /// Share of the variance of α̇_ss/t_c that the line explains.
    pub(super) stall_explained: Option<f64>,
}

impl Draw {
    /// The effect of this parameter.
    pub(super) fn sensitivity(&self, parameter: Parameter) -> Option<&Sensitivity> {
        self.sensitivities.iter().find(|sensitivity| sensitivity.parameter == parameter)
    }
}

pub(super) fn sweep_points(data: &Fig13Data) -> impl Iterator<Item = &SweepPoint> {
    data.sweeps.iter().flat_map(|sweep| &sweep.points)
}

pub(super) fn sweep(data: &Fig13Data, parameter: Parameter) -> Option<&Sweep> {
    data.sweeps.iter().find(|sweep| sweep.parameter == parameter)
}

/// What is read from a point: the steady speed in rad/s, or the stall acceleration.
pub(super) type Quantity = fn(&SweepPoint) -> Option<f64>;

pub(super) fn speed(point: &SweepPoint) -> Option<f64> {
    Some(point.statistics.steady_speed_rad_per_s.mean)
}

/// How far α̇_ss/t_c is above the largest acceleration that friction gives, as a share of it.
pub(super) fn stall_over_limit(data: &Fig13Data, parameter: Parameter, point: &SweepPoint) -> Option<f64> {
    let limit = parameter.set(&data.motor, point.value).largest_acceleration();
    Some(point.stall()?.abs() / limit)
}

pub(super) fn stall(point: &SweepPoint) -> Option<f64> {
    point.stall()
}

/// All points drawn, those on a low-period cycle among them, as (value, quantity).
pub(super) fn read(data: &Fig13Data, parameter: Parameter, of: Quantity) -> Vec<(f64, f64)> {
    let points = sweep(data, parameter).map_or(&[][..], |sweep| &sweep.points);
    points.iter().filter_map(|point| of(point).map(|value| (point.value, value))).collect()
}

/// How many of the points of a sweep a low-period cycle governs, in words.
pub(super) fn low_period_words(data: &Fig13Data, parameter: Parameter) -> String {
    let points = sweep(data, parameter).map_or(&[][..], |sweep| &sweep.points);
    let low = points.iter().filter(|point| point.statistics.is_low_period()).count();
    format!("{low} of {} motors on a low-period cycle", points.len())
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

/// By how much a quantity changes over the range of a parameter: along a straight line, of A in its logarithm, of θ along a cosine.
pub(super) fn trend_change(parameter: Parameter, points: &[(f64, f64)]) -> Option<f64> {
    let (first, last) = (points.first()?.0, points.last()?.0);
    match parameter {
        Parameter::PhaseLag => cosine_fit(points).map(|fit| 2.0 * fit.0),
        Parameter::Amplitude => {
            let logarithms: Vec<_> = points.iter().map(|(x, y)| (ln(*x), *y)).collect();
            Some(StraightLine::through(&logarithms)?.slope * (ln(last) - ln(first)))
        }
        _ => Some(StraightLine::through(points)?.slope * (last - first)),
    }
}

pub(super) fn words(line: Option<StraightLine>) -> String {
    line.map_or_else(|| "no fit".to_owned(), |line| format!("{:+.3} ± {:.3}", line.slope, line.slope_error))
}
