//! What the paper says about Fig. 11.

use std::f64::consts::FRAC_1_PI;

use super::data::{Fig11Data, Point};
use super::trends::{Place, extent, in_range, no_sharp_change, plateau, speed, stall, trends};
use crate::claim::Claim;
use crate::figures::motor_case::{Cycle, Form, perturbation_words, relative_range};
use crate::table::{Cell, Table};

const ID: &str = "fig11";

const SECTION: &str = "Sec. V B";

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
         to {to} mN. The paper's measurements (crosses) are not in its text.{}",
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
        data.measured.caption(data),
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
            format!("at {} kHz: {}; {}", data.printed.frequencies_hz[1] / 1e3, second.stalls, second.speeds),
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
