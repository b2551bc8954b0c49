//! What the paper says about Fig. 5, compared with the data.

use std::f64::consts::PI;

use super::compute::FIRST_PHASE_LAG;
use super::data::{Column, Dependence, Fig05Data, Toss};
use crate::claims::{self as claim, Claim};

/// The share of the hand's speed that a dough in a firm grip may lack.
const NEARLY_NOTHING: f64 = 0.01;
/// The hand's speed at the lowest point, cos(3π/2 + θ), is known to this share of the largest one.
const ROUNDING: f64 = 100.0 * f64::EPSILON;
pub(super) fn pi(angle: f64) -> String {
    format!("{:.3}π", angle / PI)
}

/// The toss at θ_1 of a column.
fn first(column: &Column) -> Option<&Toss> {
    column.tosses.first()
}

/// A quantity of the tosses at θ_1, by column, as text.
fn listed(data: &Fig05Data, value: impl Fn(&Column, &Toss) -> String) -> String {
    let parts = data.columns.iter().filter_map(|column| {
        first(column).map(|toss| format!("φ_L = {}: {}", column.printed, value(column, toss)))
    });
    parts.collect::<Vec<_>>().join("; ")
}

fn values(data: &Fig05Data, value: impl Fn(&Column, &Toss) -> f64) -> Vec<f64> {
    data.columns.iter().filter_map(|column| first(column).map(|toss| value(column, toss))).collect()
}

fn rises(values: &[f64]) -> Option<bool> {
    claim::all(values.windows(2), |pair| pair[0] < pair[1])
}

fn falls(values: &[f64]) -> Option<bool> {
    claim::all(values.windows(2), |pair| pair[0] > pair[1])
}

/// Whether all of several statements hold; `None` where one of them has no data.
fn both<const N: usize>(statements: [Option<bool>; N]) -> Option<bool> {
    statements.into_iter().try_fold(true, |so_far, holds| Some(so_far && holds?))
}

pub(super) fn claims(data: &Fig05Data) -> Vec<Claim> {
    let mut claims = amplitude_ratio(data);
    claims.extend(limits(data));
    claims.extend(phase_lag(data));
    claims
}

/// What φ_L does.
fn amplitude_ratio(data: &Fig05Data) -> Vec<Claim> {
    let slip_share =
        |_: &Column, toss: &Toss| toss.slip_at_separation_rad_per_s / toss.hand_speed_at_separation_rad_per_s;
    let slips = values(data, slip_share);
    let point = &data.grid_point;
    let height = values(data, |_, toss| toss.apex_height_m);
    let speed = values(data, |_, toss| toss.airborne_speed_rad_per_s);
    vec![
        Claim::printed_statement(
            "section3.slip_at_high_angle",
            both([
                data.columns.last().and_then(first).map(|toss| toss.sliding_at_separation),
                rises(&slips),
            ]),
            listed(data, |column, toss| {
                format!(
                    "{} at the separation, {:.2} rad/s or {:.1} % behind the hand, sliding for {:.0} % of the contact",
                    if toss.sliding_at_separation { "slides" } else { "sticks" },
                    toss.slip_at_separation_rad_per_s,
                    100.0 * slip_share(column, toss),
                    100.0 * toss.sliding_share_of_contact
                )
            }),
        )
        .note("θ = 0. At low φ_L the dough slides only in the last moments, where N falls to zero, and then ahead of the hand; φ_L = π/2 itself \
               is out of reach, since the dough does not leave beyond arccos(g/cω²)"),
        Claim::printed_statement(
            "section3.middle_column_is_fastest",
            match speed[..] {
                [low, middle, high] => Some(middle > low && middle > high),
                _ => None,
            },
            listed(data, |_, toss| format!("airborne speed {:.2} rad/s", toss.airborne_speed_rad_per_s)),
        )
        .note("θ = 0; the fastest toss with Table I's parameters has another φ_L, see fig04"),
        Claim::printed_statement(
            "section3.height_falls_with_angle",
            falls(&height),
            listed(data, |_, toss| format!("apex {:.3} m above the hand's mean height", toss.apex_height_m)),
        ),
        Claim::printed("section3.amplitude_angle_of_fig5c", point.amplitude_angle_rad)
            .fitted("the number of equal intervals of φ_L, the smallest with which all three printed angles are points of the grid")
            .note(format!(
                "computed {:.4}π: point {} of {} equal intervals from 0 to arccos(g/cω²) = {:.4}π with ω = {:.3} rad/s of Eq. (14), see fig04",
                point.amplitude_angle_rad / PI,
                point.index,
                point.intervals,
                point.largest_amplitude_angle_rad / PI,
                point.angular_frequency_rad_per_s
            )),
    ]
}

/// Enough force and friction.
fn limits(data: &Fig05Data) -> Vec<Claim> {
    let shares =
        |missing: &[f64]| missing.iter().map(|share| format!("{share:.1e}")).collect::<Vec<_>>().join(", ");
    let grips: Vec<_> = data
        .firm_grip
        .iter()
        .map(|grip| format!("μ = {}: {}", grip.friction, shares(&grip.missing_share)))
        .collect();
    let converges = claim::all(0..data.columns.len(), |column| {
        let missing: Vec<f64> = data
            .firm_grip
            .iter()
            .filter_map(|grip| grip.missing_share.get(column))
            .map(|share| share.abs())
            .collect();
        // At Table I's friction a dough that is behind the hand may cross its speed as the friction grows.
        falls(missing.get(1..).unwrap_or_default()) == Some(true)
            && missing.last().is_some_and(|last| *last < NEARLY_NOTHING)
    });
    vec![Claim::printed_statement(
        "section3.no_slip_at_separation",
        converges,
        format!(
            "share of the hand's speed at τ_sep that the dough lacks (negative: it is ahead), for the three φ_L at \
             θ = 0: {}; it vanishes as μ grows. Just before τ_sep it always slides, since N falls to zero",
            grips.join("; ")
        ),
    )]
}

/// What θ does.
fn phase_lag(data: &Fig05Data) -> Vec<Claim> {
    let lags = &data.lags;
    let late = |wanted: fn(f64) -> bool| {
        lags.iter().filter(move |lag| wanted(lag.phase_lag_rad)).map(|lag| lag.late_gain_rad_per_s)
    };
    let at_zero = late(|lag| lag == FIRST_PHASE_LAG).next();
    let reduced = at_zero.and_then(|zero| claim::all(late(|lag| lag > 0.0), |gain| gain < zero));
    let at_rest =
        ROUNDING * data.columns.iter().map(|own| own.largest_hand_speed_rad_per_s).fold(0.0, f64::max);
    let reversed =
        claim::all(lags, |lag| (lag.phase_lag_rad < 0.0) == (lag.lowest_speed_rad_per_s < -at_rest));
    let described = |value: fn(&Dependence) -> f64| {
        // No minus sign before a zero.
        let shown = |number: f64| if number.abs() < at_rest { 0.0 } else { number };
        let parts = lags.iter().map(|lag| format!("θ = {}: {:.2}", pi(lag.phase_lag_rad), shown(value(lag))));
        parts.collect::<Vec<_>>().join("; ")
    };
    let angle = &data.printed.optimal_amplitude_angle_rad;
    vec![
        Claim::printed_statement(
            "section3.positive_lag_torque",
            reduced,
            format!(
                "speed gained in the second half of the contact (rad/s), φ_L = {angle}: {}",
                described(|lag| lag.late_gain_rad_per_s)
            ),
        ),
        Claim::printed_statement(
            "section3.negative_lag_torque",
            reversed,
            format!(
                "the dough starts at rest; its lowest speed in contact (rad/s), φ_L = {angle}: {}",
                described(|lag| lag.lowest_speed_rad_per_s)
            ),
        ),
    ]
}
