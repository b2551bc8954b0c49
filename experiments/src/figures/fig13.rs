//! Fig. 13: sensitivity of the motor to the five estimated parameters.

mod compute;
mod draw;
mod orbits;
mod sensitivity;
mod sweeps;

use bouncing_disk::core::ChatterPolicy;
use bouncing_disk::motor::TransientSettings;
use bouncing_disk_plot::Figure;
use serde::{Deserialize, Serialize};

use super::motor_case::{MotorCase, MotorStatistics};
use super::numbers::Concentration;
use crate::claims::{Cases, Claim};
use crate::experiment::{Experiment, ExperimentError, Quality};
use crate::progress::Progress;
use crate::table::{Cell, Table};

/// Fig. 13.
#[derive(Debug)]
pub struct Fig13;

impl Experiment for Fig13 {
    type Data = Fig13Data;
    const ID: &'static str = "fig13";
    const TITLE: &'static str = "Effect of the estimated parameters on steady-state speed and stall torque";
    const DISCUSSION: &str = include_str!("fig13/discussion.md");
    const CHATTER_POLICY: Option<ChatterPolicy> = Some(ChatterPolicy::Complete);

    fn seeds() -> Vec<(&'static str, u64)> {
        vec![("motors that print alike", compute::SEED), ("ensembles", TransientSettings::default().seed)]
    }

    fn caption(data: &Fig13Data) -> String {
        let left_out: usize = sweeps::sweep_points(data).filter(|point| point.stall().is_none()).count();
        let low: usize = sweeps::sweep_points(data).filter(|point| point.statistics.is_low_period()).count();
        format!(
            "Effect of varying (a) μ, (b) ε, (c) θ, (d) A and (e) ωΦ about the default values (μ = {}, ε = {}, θ = {}, A = {:e} m, \
             ωΦ = {} rad/s, g = {} m/s², {} kHz). Crosses, left scales: steady-state speed over ωΦ; dots, right scales: stall torque \
             as an acceleration. Mean and standard deviation of {} members over {} rise times, relaunch perturbation below {} \
             g/ω. Pale: {low} motors on a low-period cycle. {left_out} motors have no meaningful fit and no dot. Dotted: \
             what the phases of the normal impulse predict; dash-dotted: the limit μ a_e g/a_g² of the stall torque; grey vertical lines: the default values. (f) Distribution of the normal impulse over the cycle of the stator. \
             The paper's ranges are not in its text; these are ours.",
            data.motor.friction,
            data.motor.restitution,
            data.motor.phase_lag_rad,
            data.motor.amplitude_m,
            data.motor.peak_angular_speed_rad_per_s,
            data.motor.preload_acceleration_m_per_s2,
            data.motor.frequency_hz / 1e3,
            data.members,
            data.rises,
            data.relaunch_perturbation,
        )
    }

    fn compute(quality: Quality, progress: &dyn Progress) -> Result<Fig13Data, ExperimentError> {
        compute::compute(quality, progress)
    }

    fn draw(data: &Fig13Data) -> Result<Figure, ExperimentError> {
        Ok(draw::draw(data))
    }

    fn claims(data: &Fig13Data) -> Vec<Claim> {
        claims(data)
    }

    fn parameters(data: &Fig13Data) -> Vec<(String, String)> {
        let mut rows = Vec::new();
        for sweep in &data.sweeps {
            if let (Some(first), Some(last)) = (sweep.points.first(), sweep.points.last()) {
                let value = format!(
                    "{:.3e} to {:.3e} {}, {} values",
                    first.value,
                    last.value,
                    sweep.parameter.unit(),
                    sweep.points.len()
                );
                rows.push((sweep.parameter.symbol().to_owned(), value));
            }
        }
        rows.push(("members".to_owned(), data.members.to_string()));
        rows.push(("duration".to_owned(), format!("{} ωΦ a_g²/(μ a_e g)", data.rises)));
        rows.push((
            "relaunch perturbation".to_owned(),
            format!("{} and {} g/ω", data.relaunch_perturbation, data.breaking_perturbation),
        ));
        rows.push(("inputs that print alike, but for ε".to_owned(), data.alike.inputs.clone()));
        rows
    }

    fn table(data: &Fig13Data) -> Option<Table> {
        let mut table = Table::new([
            "parameter",
            "value (SI)",
            "steady speed / (omega Phi)",
            "its standard deviation",
            "stall acceleration (rad/s^2)",
            "its standard deviation (rad/s^2)",
            "members without fit",
            "low-period cycle",
            "predicted speed ratio",
            "predicted stall acceleration (rad/s^2)",
        ]);
        for sweep in &data.sweeps {
            for point in &sweep.points {
                let (statistics, top) = (&point.statistics, point.peak_angular_speed_rad_per_s);
                let stall = statistics.stall_acceleration_rad_per_s2;
                table.push([
                    sweep.parameter.symbol().into(),
                    point.value.into(),
                    point.speed_ratio().into(),
                    (statistics.steady_speed_rad_per_s.deviation / top).into(),
                    stall.map(|spread| spread.mean).into(),
                    stall.map(|spread| spread.deviation).into(),
                    Cell::Integer(statistics.unfitted as i64),
                    if statistics.is_low_period() { "low period".into() } else { Cell::Empty },
                    point.predicted_speed_ratio.into(),
                    point.predicted_stall_acceleration_rad_per_s2.into(),
                ]);
            }
        }
        Some(table)
    }
}

/// The identifier of the figure.
const ID: &str = "fig13";

/// The data of Fig. 13.
#[derive(Debug, Serialize, Deserialize)]
pub struct Fig13Data {
    motor: MotorCase,
    members: usize,
    rises: f64,
    relaunch_perturbation: f64,
    /// The second perturbation, in units of g/ω, which breaks most low-period cycles.
    breaking_perturbation: f64,
    default: MotorStatistics,
    /// In the order of the panels.
    sweeps: Vec<Sweep>,
    /// Where the impulse falls in the cycle, for three ε.
    impulses: Vec<ImpulsePhases>,
    /// Motors that print alike, by ε.
    alike: AlikeMotors,
}

/// A parameter of Fig. 13.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
enum Parameter {
    Friction,
    Restitution,
    PhaseLag,
    Amplitude,
    PeakAngularSpeed,
}

impl Parameter {
    const ALL: [Self; 5] =
        [Self::Friction, Self::Restitution, Self::PhaseLag, Self::Amplitude, Self::PeakAngularSpeed];

    /// The paper's symbol.
    const fn symbol(self) -> &'static str {
        match self {
            Self::Friction => "μ",
            Self::Restitution => "ε",
            Self::PhaseLag => "θ",
            Self::Amplitude => "A",
            Self::PeakAngularSpeed => "ωΦ",
        }
    }

    const fn unit(self) -> &'static str {
        match self {
            Self::Friction | Self::Restitution => "",
            Self::PhaseLag => "rad",
            Self::Amplitude => "m",
            Self::PeakAngularSpeed => "rad/s",
        }
    }

    /// Its value for a motor.
    const fn of(self, motor: &MotorCase) -> f64 {
        match self {
            Self::Friction => motor.friction,
            Self::Restitution => motor.restitution,
            Self::PhaseLag => motor.phase_lag_rad,
            Self::Amplitude => motor.amplitude_m,
            Self::PeakAngularSpeed => motor.peak_angular_speed_rad_per_s,
        }
    }

    /// The motor with this parameter changed.
    const fn set(self, motor: &MotorCase, value: f64) -> MotorCase {
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
#[derive(Debug, Serialize, Deserialize)]
struct Sweep {
    parameter: Parameter,
    points: Vec<SweepPoint>,
}

/// One value of the parameter.
#[derive(Debug, Serialize, Deserialize)]
struct SweepPoint {
    value: f64,
    peak_angular_speed_rad_per_s: f64,
    statistics: MotorStatistics,
    /// From the phases of the impulses: steady speed over ωΦ, and α̇_ss/t_c of the curve fitted as the ensembles are.
    predicted_speed_ratio: f64,
    predicted_stall_acceleration_rad_per_s2: Option<f64>,
    /// Share of the normal impulse within π/4 of τ = 0.
    impulse_share_near_zero: f64,
    /// Means over the impacts that are not summed.
    mean_impact_speed_m_per_s: f64,
    mean_impact_interval_s: f64,
}

impl SweepPoint {
    fn speed_ratio(&self) -> f64 {
        self.statistics.steady_speed_rad_per_s.mean / self.peak_angular_speed_rad_per_s
    }

    fn stall(&self) -> Option<f64> {
        self.statistics.stall_acceleration_rad_per_s2.map(|spread| spread.mean)
    }
}

/// Normal impulse by phase.
#[derive(Debug, Serialize, Deserialize)]
struct ImpulsePhases {
    restitution: f64,
    /// Shares in equal parts of the cycle from τ = −π to π.
    shares: Vec<f64>,
    share_near_zero: f64,
    /// Where in the cycle the normal impulse is concentrated, and the collisions that end a flight of more than half a period.
    impulse: Option<Concentration>,
    collisions: Option<Concentration>,
    /// Share that comes in contact and in summed chattering.
    contact_share: f64,
}

/// Motors whose inputs all print like Table III's, at some values of ε: the same draws of the other inputs at each. Nothing perturbs
/// them.
#[derive(Debug, Serialize, Deserialize)]
struct AlikeMotors {
    /// The ranges drawn from.
    inputs: String,
    /// Motors drawn.
    drawn: usize,
    /// The values of μ, θ and ωΦ that each of them is given, too.
    frictions: Vec<f64>,
    phase_lags_rad: Vec<f64>,
    peak_angular_speeds_rad_per_s: Vec<f64>,
    /// By rising ε.
    prevalence: Vec<Prevalence>,
    /// By draw.
    draws: Vec<Draw>,
}

/// The cycles of these motors at one ε.
#[derive(Debug, Serialize, Deserialize)]
struct Prevalence {
    restitution: f64,
    /// Share of motors of low period.
    share_of_low_period: f64,
    /// Number of flights, and the share of motors with chattering cycles of no more.
    share_up_to: Vec<(usize, f64)>,
    /// Share of motors whose cycle takes at most a hundredth of the rise time, so that the speed rises in lines.
    share_of_short: f64,
    /// Of the motors that settle and whose rise is exponential, how many have an α̇_ss/t_c of at most the limit μ a_e g/a_g².
    within_limit: Cases,
    /// Medians over the motors: steady speed over ωΦ; α̇_ss/t_c over the limit, over those that settle.
    median_speed_ratio: f64,
    median_stall_over_limit: Option<f64>,
}

/// One draw of the inputs other than ε.
#[derive(Debug, Serialize, Deserialize)]
struct Draw {
    /// Slopes of the straight lines through steady speed over ωΦ, and through α̇_ss/t_c over the limit, against ε.
    speed_ratio_slope: Option<f64>,
    stall_over_limit_slope: Option<f64>,
    /// What the second of these lines rises by over the range of ε, over its value at the first ε.
    stall_over_limit_rise: Option<f64>,
    /// The largest α̇_ss/t_c over the limit, at any of the ε.
    largest_stall_over_limit: f64,
    /// The largest steady speed over ωΦ.
    largest_speed_ratio: f64,
    /// Share of the ε at which the exponential fits the transient better than a linear rise to a constant.
    share_of_exponential: f64,
    /// What each parameter changes, in the order of the panels.
    sensitivities: Vec<Sensitivity>,
    /// Share of the variance of steady speed and of α̇_ss/t_c over θ that a cosine explains.
    speed_cosine: Option<f64>,
    stall_cosine: Option<f64>,
    /// Exponents of A in both, over the three printed amplitudes at the printed ε.
    speed_amplitude_exponent: Option<f64>,
    stall_amplitude_exponent: Option<f64>,
}

/// What a parameter changes in a motor that nothing perturbs: by the trend over the range, a straight line in the parameter (of A in its logarithm, of θ a cosine), relative
/// to the motor as printed.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
struct Sensitivity {
    parameter: Parameter,
    /// Change of the steady speed and of α̇_ss/t_c from one end of the range to the other.
    speed_change: Option<f64>,
    stall_change: Option<f64>,
    /// Exponents of both; of θ none.
    speed_exponent: Option<f64>,
    stall_exponent: Option<f64>,
    /// Share of the variance of α̇_ss/t_c that the line explains.
    stall_explained: Option<f64>,
}

impl Draw {
    /// What this parameter changes.
    fn sensitivity(&self, parameter: Parameter) -> Option<&Sensitivity> {
        self.sensitivities.iter().find(|sensitivity| sensitivity.parameter == parameter)
    }
}

fn claims(data: &Fig13Data) -> Vec<Claim> {
    let mut claims = vec![
        sensitivity::cosine(data),
        sensitivity::amplitude(data),
        sensitivity::twist(data),
        sensitivity::friction(data),
        sensitivity::both(data),
        sensitivity::speed_limit(data),
        sensitivity::torque_limit(data),
        orbits::slower_collisions(data),
        orbits::intervals(data),
        orbits::restitution_lowers_both(data),
        orbits::simplistic(data),
        orbits::form(data),
    ];
    claims.push(orbits::prevalent(data));
    claims.extend(orbits::commonness(data));
    claims.extend(orbits::phases_of_impulse(data));
    claims.push(sensitivity::most_sensitive(
        data,
        "section5.speed_sensitivity",
        sensitivity::speed_change,
        [Parameter::PhaseLag, Parameter::Restitution, Parameter::PeakAngularSpeed],
    ));
    claims.push(sensitivity::most_sensitive(
        data,
        "section5.torque_sensitivity",
        sensitivity::stall_change,
        [Parameter::PhaseLag, Parameter::Restitution, Parameter::Friction],
    ));
    claims
}
