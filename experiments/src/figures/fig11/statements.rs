//! What the paper says about Fig. 11.

use std::f64::consts::FRAC_1_PI;

use bouncing_disk::core::elementary::ln;

use super::data::{Curve, Fig11Data, Point};
use crate::claim::Claim;
use crate::figures::motor_case::{Cycle, Form, perturbation_words, relative_range};
use crate::figures::regression::StraightLine;
use crate::table::{Cell, Table};

const ID: &str = "fig11";
const SECTION: &str = "Sec. V B";

/// Largest difference of a fitted exponent from 1 at which stall torque counts as proportional to preload.
const PROPORTIONAL_WITHIN: f64 = 0.1;

/// Largest exponent (of either sign, with two standard errors) at which the steady speed counts as relatively independent of the preload:
/// over the 3.5-fold range of preloads it then changes by 13 % at most.
const INDEPENDENT_WITHIN: f64 = 0.1;

/// A change of the steady speed by more than this share of its mean is sharp.
const SHARP: f64 = 0.2;

/// A torque within this factor of another one has the same order of magnitude.
const ORDER_OF_MAGNITUDE: f64 = 10.0;

pub(super) fn caption(data: &Fig11Data) -> String {
    let [first, last] = data.printed.preload_accelerations_m_per_s2;
    let [from, to] = data.trend_mn();
    format!(
        "Effect of preload on steady-state speed and stall torque: (a), (b) ω/2π = {} kHz; (c), (d) {} kHz, which \
         turns the paper's motor the other way. A = 10⁻⁹ (solid), 10⁻⁸ (dashed) and 10⁻⁷ m (dotted), each over all g = \
         {first} to {last} m/s², since which g goes with which A is not printed; preload is m g with the weight of the \
         20 mm steel ball. Dots with bars: mean and standard deviation of {} members over {} rise times, which differ \
         in the starting phase and in the seed of a relaunch perturbation below {} g/ω; joined to guide the eye. \
         Open circles: {} motors on a low-period chattering cycle, nearly all of a single flight (see the claims). Grey: {from} \
         to {to} mN. The paper's measurements (crosses) are not in its text.",
        data.motor.frequency_hz / 1e3,
        data.printed.frequencies_hz[1] / 1e3,
        data.members,
        data.rises,
        data.relaunch_perturbation,
        data.curves
            .iter()
            .flat_map(|curve| &curve.points)
            .filter(|point| point.statistics.is_low_period())
            .count(),
    )
}

pub(super) fn parameters(data: &Fig11Data) -> Vec<(String, String)> {
    let motor = &data.motor;
    let pair = |name: &str, value: String| (name.to_owned(), value);
    vec![
        pair("μ", motor.friction.to_string()),
        pair("ε", motor.restitution.to_string()),
        pair("θ", format!("{} rad", motor.phase_lag_rad)),
        pair("ωΦ", format!("{} rad/s", motor.peak_angular_speed_rad_per_s)),
        pair("a_e", format!("{} m", motor.contact_radius_m)),
        pair("a_g", format!("{} m", motor.gyration_radius_m)),
        pair("rotor mass", format!("{:.5} kg", data.rotor_mass_kg)),
        pair("preloads", data.curves.first().map_or(0, |curve| curve.points.len()).to_string()),
        pair("members", data.members.to_string()),
        pair("duration", format!("{} ωΦ a_g²/(μ a_e g)", data.rises)),
        pair("relaunch perturbation", format!("{} g/ω", data.relaunch_perturbation)),
    ]
}

pub(super) fn table(data: &Fig11Data) -> Table {
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
                if statistics.is_low_period() { statistics.cycle.words().into() } else { Cell::Empty },
            ]);
        }
    }
    table
}

/// The points of a curve between the preloads of the trends; with or without those on a low-period cycle.
fn in_range<'a>(data: &Fig11Data, curve: &'a Curve, with_locked: bool) -> Vec<&'a Point> {
    let [from, to] = data.trend_mn();
    let inside = curve.points.iter().filter(|point| (from..=to).contains(&point.preload_mn));
    inside.filter(|point| with_locked || !point.statistics.is_low_period()).collect()
}

/// The straight line through the logarithms of preload and of what `of` reads, and the relative range of that.
fn power_law(points: &[&Point], of: fn(&Point) -> Option<f64>) -> Option<(StraightLine, f64)> {
    let read: Vec<(f64, f64)> = points
        .iter()
        .filter_map(|point| of(point).map(|value| (point.preload_mn, value.abs())))
        .filter(|(_, value)| *value > 0.0)
        .collect();
    let logarithms: Vec<_> = read.iter().map(|(x, y)| (ln(*x), ln(*y))).collect();
    let values: Vec<_> = read.iter().map(|point| point.1).collect();
    StraightLine::through(&logarithms).map(|line| (line, relative_range(&values)))
}

fn stall(point: &Point) -> Option<f64> {
    point.statistics.stall_acceleration_rad_per_s2.map(|spread| spread.mean)
}

fn speed(point: &Point) -> Option<f64> {
    Some(point.statistics.steady_speed_rad_per_s.mean)
}

fn name(curve: &Curve) -> String {
    format!("{:e} m", curve.amplitude_m)
}

pub(super) fn claims(data: &Fig11Data) -> Vec<Claim> {
    let [default, second] = data.printed.frequencies_hz.map(|frequency| trends(data, frequency));
    let mut claims = vec![
        Claim::printed_statement(
            "section5.torque_proportional_to_preload",
            default.proportional,
            default.stalls,
        ),
        Claim::printed_statement(
            "section5.speed_independent_of_preload",
            default.independent,
            default.speeds,
        ),
        Claim::printed_statement(
            "section5.both_frequencies",
            default.proportional == second.proportional && default.independent == second.independent,
            format!("at 184 kHz: {}; {}", second.stalls, second.speeds),
        ),
        no_sharp_change(data, "section5.no_sharp_fall", 0, |place| place != Place::Inside, -1.0),
        plateau(data),
        no_sharp_change(data, "section5.no_sharp_rise", 1, |place| place == Place::Above, 1.0),
        everywhere(data),
        no_bouncing(data),
        magnitudes(data),
    ];
    for (frequency, table) in data.printed.frequencies_hz.iter().zip(&data.perturbations) {
        let speeds: Vec<f64> =
            table.iter().map(|effect| effect.statistics.steady_speed_rad_per_s.mean).collect();
        claims.push(Claim::statement(
            ID,
            "our ensemble",
            format!(
                "at {} kHz and the middle of the preloads the steady speed does not depend on the relaunch perturbation from 1e-5 \
                 to 1e-1 g/ω (within 5 %)",
                frequency / 1e3
            ),
            relative_range(&speeds) <= 0.05,
            format!(
                "steady speed (rad/s), stall acceleration (rad/s²) by perturbation: {}",
                perturbation_words(table)
            ),
        ));
    }
    claims
}

/// Whether the trends hold at one frequency, and the numbers.
struct Trends {
    proportional: bool,
    stalls: String,
    independent: bool,
    speeds: String,
}

/// Proportional stall torque and constant speed.
fn trends(data: &Fig11Data, frequency_hz: f64) -> Trends {
    let (mut proportional, mut independent) = (true, true);
    let (mut stalls, mut speeds) = (Vec::new(), Vec::new());
    for curve in at_frequency(data, frequency_hz) {
        let chaotic = in_range(data, curve, false);
        let all = in_range(data, curve, true);
        let left_out = all.len() - chaotic.len();
        match power_law(&chaotic, stall) {
            Some((line, _)) => {
                proportional &= (line.slope - 1.0).abs() <= PROPORTIONAL_WITHIN;
                stalls.push(format!(
                    "{}: {:.3} ± {:.3} (R² = {:.4}; {} points, {left_out} on a low-period cycle left out)",
                    name(curve),
                    line.slope,
                    line.slope_error,
                    line.explained,
                    chaotic.len(),
                ));
            }
            None => proportional = false,
        }
        match power_law(&chaotic, speed).zip(power_law(&all, speed)) {
            Some(((line, range), (_, full_range))) => {
                independent &= line.slope.abs() + 2.0 * line.slope_error <= INDEPENDENT_WITHIN;
                speeds.push(format!(
                    "{}: {:+.3} ± {:.3}, range {:.1} % of the mean ({:.1} % with the {left_out} on a low-period cycle)",
                    name(curve),
                    line.slope,
                    line.slope_error,
                    100.0 * range,
                    100.0 * full_range,
                ));
            }
            None => independent = false,
        }
    }
    Trends {
        proportional,
        stalls: format!("exponent of stall acceleration against preload: {}", stalls.join("; ")),
        independent,
        speeds: format!("exponent of steady speed against preload: {}", speeds.join("; ")),
    }
}

fn at_frequency(data: &Fig11Data, frequency_hz: f64) -> impl Iterator<Item = &Curve> {
    data.curves.iter().filter(move |curve| curve.frequency_hz.total_cmp(&frequency_hz).is_eq())
}

/// A preload against the range of the trends.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Place {
    Below,
    Inside,
    Above,
}

/// That no steady speed at the preloads `wanted` leaves the range of those inside by more than [`SHARP`] of their mean,
/// downwards for a negative `direction`.
fn no_sharp_change(
    data: &Fig11Data,
    key: &str,
    frequency: usize,
    wanted: fn(Place) -> bool,
    direction: f64,
) -> Claim {
    let [from, to] = data.trend_mn();
    let place = |point: &Point| match point.preload_mn {
        preload if preload < from => Place::Below,
        preload if preload > to => Place::Above,
        _ => Place::Inside,
    };
    let mut holds = true;
    let mut words = Vec::new();
    for curve in at_frequency(data, data.printed.frequencies_hz[frequency]) {
        let speeds = |chosen: &dyn Fn(Place) -> bool| -> Vec<f64> {
            let chaotic = curve.points.iter().filter(|point| !point.statistics.is_low_period());
            chaotic.filter(|point| chosen(place(point))).filter_map(speed).collect()
        };
        let inside = speeds(&|place| place == Place::Inside);
        let outside = speeds(&wanted);
        let mean = inside.iter().sum::<f64>() / inside.len() as f64;
        let farthest =
            outside.iter().map(|speed| direction * (speed - mean)).fold(f64::NEG_INFINITY, f64::max);
        holds &= !outside.is_empty() && farthest <= SHARP * mean;
        let (slow, fast) = extent(&outside);
        words.push(format!("{}: {slow:.1} to {fast:.1} rad/s, mean inside {mean:.1}", name(curve)));
    }
    Claim::printed_statement(
        key,
        holds,
        format!(
            "steady speeds outside the range, motors on a low-period cycle left out: {}",
            words.join("; ")
        ),
    )
}

/// The same of all motors, with those on a low-period cycle.
fn everywhere(data: &Fig11Data) -> Claim {
    let points: Vec<&Point> = data.curves.iter().flat_map(|curve| &curve.points).collect();
    let low: Vec<&&Point> = points.iter().filter(|point| point.statistics.is_low_period()).collect();
    let one_flight = low.iter().filter(|point| point.statistics.cycle.is_one_flight());
    let fractions: Vec<f64> = one_flight.map(|point| point.axial_forcing.rem_euclid(1.0)).collect();
    let (least, most) = extent(&fractions);
    let others =
        points.iter().filter(|point| !point.statistics.is_low_period()).filter_map(|point| speed(point));
    let (slow, fast) = extent(&others.collect::<Vec<_>>());
    let (low_slow, low_fast) = extent(&low.iter().filter_map(|point| speed(point)).collect::<Vec<_>>());
    Claim::statement(
        ID,
        SECTION,
        "the trends hold at every preload and amplitude, also where the chattering is of low period",
        low.iter().all(|point| speed(point).is_some_and(|speed| (slow..=fast).contains(&speed))),
        format!(
            "{} of {} motors are on a low-period cycle, {} of them of a single flight: it lasts about Γ periods, and where the \
             fraction of Γ is {least:.3} to {most:.3} it ends near τ = π, where the stator recedes as fast as the rotor \
             falls. Such a rotor lands softly, rides up with the stator through a half cycle in which cos τ takes both \
             signs equally, and hardly turns: {low_slow:.1} to {low_fast:.1} rad/s, all others {slow:.1} to {fast:.1} rad/s",
            low.len(),
            points.len(),
            fractions.len(),
        ),
    )
}

/// Smallest and largest value.
fn extent(values: &[f64]) -> (f64, f64) {
    values
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(*value), high.max(*value)))
}

fn no_bouncing(data: &Fig11Data) -> Claim {
    let holds = data
        .end_of_bouncing
        .iter()
        .all(|gentle| (gentle.axial_forcing < FRAC_1_PI) == (gentle.cycle == Cycle::AtRest));
    let evidence = data
        .end_of_bouncing
        .iter()
        .map(|gentle| format!("πΓ = {:.3}: {}", gentle.axial_forcing / FRAC_1_PI, gentle.cycle.words()));
    Claim::statement(
        ID,
        SECTION,
        "the rotor does not bounce when Γ < 1/π",
        holds,
        format!("at full preload, from rest: {}", evidence.collect::<Vec<_>>().join("; ")),
    )
}

/// The exponent of the stall torque above the preload of the measured plateau: 0 there, 1 on the trend.
fn plateau(data: &Fig11Data) -> Claim {
    let from = 1e3 * data.printed.plateau_n;
    let mut none = true;
    let mut words = Vec::new();
    for curve in at_frequency(data, data.printed.frequencies_hz[0]) {
        let high =
            curve.points.iter().filter(|point| point.preload_mn > from && !point.statistics.is_low_period());
        if let Some((line, _)) = power_law(&high.collect::<Vec<_>>(), stall) {
            none &= line.slope - 2.0 * line.slope_error > 0.0;
            words.push(format!("{}: {:.2} ± {:.2}", name(curve), line.slope, line.slope_error));
        }
    }
    Claim::printed_statement(
        "section5.no_plateau",
        none && !words.is_empty(),
        format!("exponent of stall acceleration against preload above {from} mN: {}", words.join("; ")),
    )
}

fn magnitudes(data: &Fig11Data) -> Claim {
    let points = || data.curves.iter().flat_map(|curve| in_range(data, curve, false));
    let inertia = data.moment_of_inertia();
    let torques: Vec<f64> = points().filter_map(stall).map(|value| 1e6 * inertia * value).collect();
    let speeds: Vec<f64> = points().filter_map(speed).collect();
    let ((low, high), (slow, fast)) = (extent(&torques), extent(&speeds));
    let share = |point: &Point, errors: f64| {
        let limit = data.motor.largest_acceleration() / data.motor.preload_acceleration_m_per_s2;
        let spread = point.statistics.stall_acceleration_rad_per_s2?;
        let value = spread.mean - errors * spread.standard_error;
        Some(value / (limit * point.preload_acceleration_m_per_s2))
    };
    let (least, most) = extent(&points().filter_map(|point| share(point, 0.0)).collect::<Vec<_>>());
    let (_, surely) = extent(&points().filter_map(|point| share(point, 2.0)).collect::<Vec<_>>());
    Claim::statement(
        ID,
        "Sec. V C",
        "the stall torque has the order of magnitude of its limit μ a_e m g and does not exceed it",
        surely <= 1.0 && least >= 1.0 / ORDER_OF_MAGNITUDE,
        format!(
            "between {} and {} mN, low-period motors left out: {slow:.1} to {fast:.1} rad/s and {low:.1} to {high:.1} µN m, \
             {least:.2} to {most:.2} of the limit; two standard errors below the means, {surely:.2} at most",
            data.trend_mn()[0],
            data.trend_mn()[1],
        ),
    )
}
