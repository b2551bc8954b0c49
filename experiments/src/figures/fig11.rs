//! Fig. 11: steady-state speed and stall torque of the motor against preload.

mod bouncing;
mod claims;
mod compute;
mod draw;
mod trends;

use bouncing_disk::core::ChatterPolicy;
use bouncing_disk::core::numerics::elementary::ln;
use bouncing_disk::estimate::Spread;
use bouncing_disk::motor::TransientSettings;
use bouncing_disk_plot::Figure;
use serde::{Deserialize, Serialize};

use super::motor_case::{Form, MotorCase, MotorStatistics};
use super::numbers::StraightLine;
use super::stall::Stall;
use crate::claims::{Cases, Claim, paper::Preloads};
use crate::experiment::{Experiment, ExperimentError, Quality};
use crate::measured::{Column, Layout, Range, Series};
use crate::progress::Progress;
use crate::table::{Cell, Table};

/// Fig. 11.
#[derive(Debug)]
pub struct Fig11;

impl Experiment for Fig11 {
    type Data = Fig11Data;
    const ID: &'static str = "fig11";
    const TITLE: &'static str = "Effect of preload on steady-state speed and stall torque";
    const DISCUSSION: &str = include_str!("fig11/discussion.md");
    const MEASUREMENTS: &'static [Layout] = &[LAYOUT];
    const CHATTER_POLICY: Option<ChatterPolicy> = Some(ChatterPolicy::Complete);

    fn seeds() -> Vec<(&'static str, u64)> {
        vec![
            ("preloads", compute::PRELOAD_SEED),
            ("ensembles", TransientSettings::default().seed),
            ("bouncing motors that print alike", bouncing::SEED),
            ("runs to stall", super::stall::SEED),
        ]
    }

    fn caption(data: &Fig11Data) -> String {
        let [first, last] = data.printed.preload_accelerations_m_per_s2;
        let [from, to] = data.trend_mn();
        let count = data.curves.first().map_or(0, |curve| curve.points.len());
        format!(
            "Effect of preload on steady-state speed and stall torque: (a), (b) ω/2π = {} kHz; (c), (d) {} kHz, which \
             turns the paper's motor the other way. A = 10⁻⁹ (solid), 10⁻⁸ (dashed) and 10⁻⁷ m (dotted), each over all g = \
             {first} to {last} m/s², since which g goes with which A is not printed; preload is m g with the weight of the \
             20 mm steel ball. Dots, joined to guide the eye: means of {}, {} and {} members at the three amplitudes over {} rise times, which differ \
             in the starting phase and in the seed of a relaunch perturbation below {} g/ω. The preloads are drawn at random, one in each of {count} \
             equal parts of the range for each curve (seed {}). Bars, at a few dots of each curve: standard deviation of the members. \
             Open circles: {} motors on a low-period chattering cycle, {} of them of a single flight (see the claims). Squares in (b) and (d): the load torque that \
             really stalls the motor at A = 10⁻⁸ m and the lowest, the middle and the highest preload of the trends, where the dots are the paper's estimate of it. Grey: {from} \
             to {to} mN. The paper's measurements (crosses) are not in its text.{}",
            data.motor.frequency_hz / 1e3,
            data.printed.frequencies_hz[1] / 1e3,
            data.members[0],
            data.members[1],
            data.members[2],
            data.rises,
            data.relaunch_perturbation,
            data.preload_seed,
            data.holes.low_period,
            data.holes.one_flight,
            data.measured.caption(data),
        )
    }

    fn compute(quality: Quality, progress: &dyn Progress) -> Result<Fig11Data, ExperimentError> {
        compute::compute(quality, progress)
    }

    fn overlay(data: &mut Fig11Data, series: &Series) -> Result<(), ExperimentError> {
        data.measured = read(data, series)?;
        Ok(())
    }

    fn draw(data: &Fig11Data) -> Result<Figure, ExperimentError> {
        Ok(draw::draw(data))
    }

    fn claims(data: &Fig11Data) -> Vec<Claim> {
        claims::claims(data)
    }

    fn parameters(data: &Fig11Data) -> Vec<(String, String)> {
        let motor = &data.motor;
        let pair = |name: &str, value: String| (name.to_owned(), value);
        let own = [
            pair("a_e", format!("{} m", motor.contact_radius_m)),
            pair("a_g", format!("{} m", motor.gyration_radius_m)),
            pair("rotor mass", format!("{:.5} kg", data.rotor_mass_kg)),
            pair("preloads", data.curves.first().map_or(0, |curve| curve.points.len()).to_string()),
            pair("seed of the preloads", data.preload_seed.to_string()),
            pair("members by amplitude", data.members.map(|count| count.to_string()).join(", ")),
            pair("duration", format!("{} ωΦ a_g²/(μ a_e g)", data.rises)),
            pair("relaunch perturbation", format!("{} g/ω", data.relaunch_perturbation)),
        ];
        motor.shared_inputs().into_iter().chain(own).collect()
    }

    fn table(data: &Fig11Data) -> Option<Table> {
        let mut table = Table::new([
            "frequency (Hz)",
            "A (m)",
            "g (m/s^2)",
            "preload (mN)",
            "Gamma",
            "steady speed (rad/s)",
            "its standard deviation (rad/s)",
            "stall acceleration (rad/s^2)",
            "its standard deviation (rad/s^2)",
            "read from",
            "members without fit",
            "S(0)",
            "low-period cycle",
        ]);
        for curve in &data.curves {
            for point in &curve.points {
                let statistics = &point.statistics;
                let stall = statistics.stall_acceleration_rad_per_s2;
                table.push([
                    curve.frequency_hz.into(),
                    curve.amplitude_m.into(),
                    point.preload_acceleration_m_per_s2.into(),
                    point.preload_mn.into(),
                    point.axial_forcing.into(),
                    statistics.steady_speed_rad_per_s.mean.into(),
                    statistics.steady_speed_rad_per_s.deviation.into(),
                    stall.map(|spread| spread.mean).into(),
                    stall.map(|spread| spread.deviation).into(),
                    match statistics.form {
                        Form::Exponential => "exponential",
                        Form::Ramp => "ramp",
                    }
                    .into(),
                    Cell::Integer(statistics.unfitted as i64),
                    point.net_share_at_rest.into(),
                    if statistics.is_low_period() { "low period".into() } else { Cell::Empty },
                ]);
            }
        }
        Some(table)
    }
}

/// The data of Fig. 11.
#[derive(Debug, Serialize, Deserialize)]
pub struct Fig11Data {
    motor: MotorCase,
    printed: Preloads,
    /// Mass of the rotor, a solid steel ball.
    rotor_mass_kg: f64,
    /// Members of an ensemble, by amplitude: the larger the amplitude, the fewer collisions a transient averages over, and the cheaper it is.
    members: [usize; 3],
    rises: f64,
    relaunch_perturbation: f64,
    preload_seed: u64,
    /// By frequency, then amplitude.
    curves: Vec<Curve>,
    /// Of each curve.
    trends: Vec<Trend>,
    /// The motors on a low-period cycle, of all curves.
    holes: Holes,
    /// α̇_ss/t_c over (μ a_e g/a_g²) S(0), the least and the most between the preloads of the trends; motors on a low-period cycle left out.
    estimate_over_balance: [f64; 2],
    /// Its mean over these motors.
    mean_estimate_over_balance: f64,
    /// What stalls the default motor at the lowest, the middle and the highest preload of the trends, by frequency.
    stalls: Vec<StallAt>,
    /// The default motor at full preload with the printed and with a smaller ωΦ.
    reduced_twist: ReducedTwist,
    /// The motor at the second frequency with θ and with θ + π.
    mirrored: Mirrored,
    end_of_bouncing: EndOfBouncing,
    /// A user's own measurements.
    #[serde(default, skip_serializing_if = "MeasuredMotors::is_empty")]
    measured: MeasuredMotors,
}

/// One amplitude at one frequency.
#[derive(Debug, Serialize, Deserialize)]
struct Curve {
    frequency_hz: f64,
    amplitude_m: f64,
    points: Vec<Point>,
    /// Further motors above the preloads of the trends, which are not drawn: the statements about them shall rest on enough.
    further: Vec<Point>,
}

/// One preload.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
struct Point {
    preload_acceleration_m_per_s2: f64,
    preload_mn: f64,
    axial_forcing: f64,
    statistics: MotorStatistics,
    /// S(0): the share of the normal impulse that pushes a rotor held at rest forwards, minus the rest.
    net_share_at_rest: f64,
    /// Steady speed (rad/s) of one orbit that nothing perturbs.
    single_speed_rad_per_s: f64,
    /// Its α̇_ss/t_c (rad/s²), if its speed settles.
    single_stall_rad_per_s2: Option<f64>,
}

/// The stall load at one preload.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
struct StallAt {
    frequency_hz: f64,
    preload_mn: f64,
    stall: Stall,
}

/// A motor whose stator twists less.
#[derive(Debug, Serialize, Deserialize)]
struct ReducedTwist {
    /// ωΦ (rad/s), printed and reduced.
    peak_angular_speeds_rad_per_s: [f64; 2],
    steady_speeds_rad_per_s: [Spread; 2],
    stall_accelerations_rad_per_s2: Option<[Spread; 2]>,
    /// Single orbits that are slower with the reduced one.
    slower: Cases,
}

/// A motor and the same with the phase lag shifted by π.
#[derive(Debug, Serialize, Deserialize)]
struct Mirrored {
    preload_mn: f64,
    phase_lags_rad: [f64; 2],
    steady_speeds_rad_per_s: [Spread; 2],
}

impl Fig11Data {
    /// The range of preloads (mN) of the measured trends.
    fn trend_mn(&self) -> [f64; 2] {
        trend_mn(&self.printed)
    }

    /// m a_g² (kg m²), which makes a torque of an angular acceleration.
    fn moment_of_inertia(&self) -> f64 {
        self.rotor_mass_kg * self.motor.gyration_radius_m * self.motor.gyration_radius_m
    }
}

/// The range of preloads (mN) of the measured trends.
fn trend_mn(printed: &Preloads) -> [f64; 2] {
    printed.measured_range_n.map(|preload| 1e3 * preload)
}

/// One curve: what its motors do inside the preloads of the measured trends, and beside them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Trend {
    frequency_hz: f64,
    amplitude_m: f64,
    /// Inside, of all motors: the middle steady speed, and the middle stall acceleration of single orbits over preload.
    median_speed_rad_per_s: f64,
    single_stall_per_preload_rad_per_s2_mn: f64,
    /// How many single orbits inside have a speed, a torque or both on the trend. One without a stall torque is off it.
    speed: Cases,
    torque: Cases,
    both: Cases,
    /// How many single orbits above the preload of the measured plateau have a torque nearer to the trend than to that plateau.
    no_plateau: Cases,
    /// Exponents of speed and torque inside, of all motors that have them: the median over all pairs of motors, which a few off the trend do not move.
    speed_exponent: Option<f64>,
    torque_exponent: Option<f64>,
    /// The same of the torque above the preload of the measured plateau: 1 on the trend, 0 on a plateau.
    high_torque_exponent: Option<f64>,
    /// How many single orbits below and above do not turn more slowly by a sharp change than the middle of those inside, and how many above not faster.
    no_fall: Cases,
    no_rise_above: Cases,
    /// Middle steady speed of the lowest and of the highest quarter of those beside the preloads of the trends, over that inside.
    outside_over_inside: [f64; 2],
}

/// The motors on a low-period cycle, and what those of a single flight do.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Holes {
    motors: usize,
    low_period: usize,
    one_flight: usize,
    /// Smallest and largest fraction of Γ of the motors on a cycle of one flight, and the difference.
    one_flight_fractions: Option<[f64; 2]>,
    one_flight_window: Option<f64>,
    /// Slowest and fastest steady speed (rad/s) of these, of all motors on a low-period cycle, and of all others.
    one_flight_speeds_rad_per_s: Option<[f64; 2]>,
    low_period_speeds_rad_per_s: Option<[f64; 2]>,
    other_speeds_rad_per_s: Option<[f64; 2]>,
}

/// What bouncing rotors do at Γ < 1/π.
#[derive(Debug, Serialize, Deserialize)]
struct EndOfBouncing {
    seed: u64,
    /// What still prints as the ε of Table III.
    restitutions: [f64; 2],
    /// The largest launch speed (g/ω): A ω²/g of the default motor.
    largest_launch_speed: f64,
    /// How many come to rest for good.
    at_rest: Cases,
    /// The most impacts that one of these needed.
    most_impacts: usize,
    /// The restitution above which a rotor can go on bouncing at some Γ < 1/π.
    threshold_restitution: f64,
    coexisting: Coexisting,
}

/// A rotor that is launched on the period-1 orbit below Γ = 1/π.
#[derive(Debug, Serialize, Deserialize)]
struct Coexisting {
    restitution: f64,
    axial_forcing: f64,
    /// After so many impacts ...
    impacts: usize,
    /// ... it still bounces.
    bounces: bool,
}

/// A measured motor.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
struct MeasuredMotor {
    /// The frequency of the panel.
    panel_frequency_hz: f64,
    frequency_hz: f64,
    preload_mn: f64,
    steady_speed_rad_per_s: f64,
    stall_torque_n_m: f64,
    /// The torque over m a_g².
    stall_acceleration_rad_per_s2: f64,
}

/// The power of the preload to which the stall torque is proportional.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
struct MeasuredExponent {
    panel_frequency_hz: f64,
    value: f64,
    standard_error: f64,
    explained: f64,
    points: usize,
}

/// What was measured and fitted.
#[derive(Debug, Default, Serialize, Deserialize)]
struct MeasuredMotors {
    points: Vec<MeasuredMotor>,
    exponents: Vec<MeasuredExponent>,
}

/// The file.
const LAYOUT: Layout = Layout {
    file: "fig11.csv",
    columns: &[
        Column::value("frequency_hz", Range::Positive),
        Column::value("preload_n", Range::Positive),
        Column::value("steady_speed_rad_per_s", Range::Signed),
        Column::value("stall_torque_n_m", Range::Positive),
    ],
    least_rows: 1,
};

/// A measured frequency that differs by less than this share from that of a panel belongs there: a motor's resonance
/// moves by a few percent.
const SAME_FREQUENCY_WITHIN: f64 = 0.05;

/// Sorts the points into the panels and fits the stall torques of each within the preloads of the trends, as those of
/// the model are.
fn read(data: &Fig11Data, series: &Series) -> Result<MeasuredMotors, ExperimentError> {
    let frequencies = data.printed.frequencies_hz;
    let mut points = Vec::new();
    for (row, [frequency_hz, preload_n, speed, torque]) in series.rows::<4>().enumerate() {
        let near = |panel: &f64| (frequency_hz - panel).abs() <= SAME_FREQUENCY_WITHIN * panel;
        let panel_frequency_hz = frequencies.into_iter().find(near).ok_or_else(|| {
            let legal = frequencies.map(|frequency| frequency.to_string()).join(" or ");
            series.illegal(row, 0, &format!("within {} % of {legal}", 100.0 * SAME_FREQUENCY_WITHIN))
        })?;
        points.push(MeasuredMotor {
            panel_frequency_hz,
            frequency_hz,
            preload_mn: 1e3 * preload_n,
            steady_speed_rad_per_s: speed,
            stall_torque_n_m: torque,
            stall_acceleration_rad_per_s2: torque / data.moment_of_inertia(),
        });
    }
    let [from, to] = data.trend_mn();
    let exponents = frequencies.into_iter().filter_map(|panel_frequency_hz| {
        let logarithms: Vec<(f64, f64)> = points
            .iter()
            .filter(|point| point.panel_frequency_hz.total_cmp(&panel_frequency_hz).is_eq())
            .filter(|point| (from..=to).contains(&point.preload_mn))
            .map(|point| (ln(point.preload_mn), ln(point.stall_torque_n_m)))
            .collect();
        StraightLine::through(&logarithms).map(|line| MeasuredExponent {
            panel_frequency_hz,
            value: line.slope,
            standard_error: line.slope_error,
            explained: line.explained,
            points: logarithms.len(),
        })
    });
    let exponents = exponents.collect();
    Ok(MeasuredMotors { points, exponents })
}

impl MeasuredMotors {
    fn is_empty(&self) -> bool {
        self.points.is_empty()
    }

    /// The points of a panel.
    fn at(&self, frequency_hz: f64) -> Vec<MeasuredMotor> {
        let wanted = |point: &&MeasuredMotor| point.panel_frequency_hz.total_cmp(&frequency_hz).is_eq();
        self.points.iter().filter(wanted).copied().collect()
    }

    /// The words in the panel of the torques, if an exponent could be fitted.
    fn label(&self, frequency_hz: f64) -> Option<String> {
        let wanted = |fit: &&MeasuredExponent| fit.panel_frequency_hz.total_cmp(&frequency_hz).is_eq();
        let fit = self.exponents.iter().find(wanted)?;
        Some(format!(r"measured: exponent ${:.2} \pm {:.2}$", fit.value, fit.standard_error))
    }

    /// What the caption says; nothing when there are no measurements.
    fn caption(&self, data: &Fig11Data) -> String {
        if self.is_empty() {
            return String::new();
        }
        let [from, to] = data.trend_mn();
        let words = data.printed.frequencies_hz.map(|frequency| {
            let khz = frequency / 1e3;
            let fit = self.exponents.iter().find(|fit| fit.panel_frequency_hz.total_cmp(&frequency).is_eq());
            fit.map_or_else(
                || format!("{khz} kHz: fewer than three points at different preloads"),
                |fit| {
                    format!(
                        "{khz} kHz: {:.3} ± {:.3} (R² = {:.4}, {} points)",
                        fit.value, fit.standard_error, fit.explained, fit.points
                    )
                },
            )
        });
        format!(
            " Crosses: measurements read from {}; exponent of their stall torque against preload from {from} to {to} mN: {}.",
            LAYOUT.file,
            words.join("; ")
        )
    }
}
