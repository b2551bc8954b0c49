//! The statements of the paper about Fig. 4, compared with the data.

use std::f64::consts::PI;

use bouncing_disk::toss::InitialSpin;

use super::data::{Best, Fig04Data, LagCurve, TossPoint};
use crate::claims::judging::{LINE_WIDTH, trend};
use crate::claims::paper::Uncertain;
use crate::claims::printed::PrintedNumber;
use crate::claims::{self as claim, Claim};
use crate::figures::shared::numbers;

/// The lags θ = nπ/8 with n a multiple of this are linear motions.
const LINEAR_LAGS: u32 = 8;
/// An angle as a multiple of π.
pub(super) fn pi(angle: f64) -> String {
    format!("{:.4}π", angle / PI)
}

fn curves(data: &Fig04Data, initial: InitialSpin) -> &[LagCurve] {
    data.families.iter().find(|family| family.initial_state == initial).map_or(&[], |family| &family.curves)
}

fn best(data: &Fig04Data, initial: InitialSpin) -> Option<&Best> {
    data.best.iter().find(|best| best.initial_state == initial)
}

/// The parameters of the even grid that differ from Table I, and by how much of its uncertainties.
fn described(data: &Fig04Data) -> String {
    let (case, table) = (&data.consistency.coarse_grid.reading.parameters, &data.table_i);
    let shift = |value: f64, printed: &Uncertain| (value - printed.value) / printed.uncertainty;
    format!(
        "ω = {:.2} rad/s ({:+.2} of its uncertainty), a_g = {:.4} m ({:+.2} of its uncertainty)",
        case.angular_frequency_rad_per_s,
        shift(case.angular_frequency_rad_per_s, &table.angular_frequency_rad_per_s),
        case.gyration_radius_m,
        shift(case.gyration_radius_m, &table.gyration_radius_m),
    )
}

pub(super) fn claims(data: &Fig04Data) -> Vec<Claim> {
    let mut claims = optimum(data);
    claims.push(dependence(data));
    claims.push(separation(data));
    claims
}

/// Why the optimum of Table I as printed is another one.
const OTHER_OPTIMUM: &str = "Table I has its optimum at another φ_L";

/// A curve at an angle, linear between its points.
fn at(angles: &[f64], curve: &[f64], angle: f64) -> f64 {
    let points = || angles.iter().zip(curve);
    let between = points().zip(points().skip(1)).find(|(_, (end, _))| **end >= angle);
    between.map_or(f64::NAN, |((from, one), (to, other))| one + (other - one) * (angle - from) / (to - from))
}

/// By how much a curve at an angle is lower than its maximum, as a share of what it spans.
fn lower_at(angles: &[f64], curve: &[f64], angle: f64) -> f64 {
    let (low, high) = numbers::extent(curve.iter().copied());
    (high - at(angles, curve, angle)) / (high - low)
}

/// The angles at which a curve is lower than its maximum by no more than a line's width: the first and the
/// last, and their share.
fn accepted(angles: &[f64], curve: &[f64]) -> (String, f64) {
    let (low, high) = numbers::extent(curve.iter().copied());
    let as_high = angles.iter().zip(curve).filter(|(_, value)| high - **value <= LINE_WIDTH * (high - low));
    let as_high: Vec<f64> = as_high.map(|(angle, _)| *angle).collect();
    let (from, to) = numbers::extent(as_high.iter().copied());
    let share = as_high.len() as f64 / angles.len() as f64;
    (
        format!("places from {} to {} are as high, {:.0} % of those drawn", pi(from), pi(to), 100.0 * share),
        share,
    )
}

/// The best toss with the parameters of Table I.
fn optimum(data: &Fig04Data) -> Vec<Claim> {
    let table_i_speed = data.table_i_toss.airborne_speed_rad_per_s;
    let mut claims = vec![
        Claim::printed("section3.predicted_airborne_speed", table_i_speed)
            .note("its printed uncertainty is answered by table2"),
    ];
    claims.extend(optimal_phase_lag(data));
    let Some(curve) = curves(data, InitialSpin::AbsoluteRest).first() else { return claims };
    let fastest = &curve.fastest;
    let grid = &data.consistency.coarse_grid;
    let reason = format!(
        "all printed numbers come out with {}, if the maximum is the best of {} equal intervals of φ_L",
        described(data),
        grid.intervals
    );
    let numbers = [
        ("optimal_amplitude_angle", fastest.amplitude_angle_rad),
        ("largest_airborne_speed", fastest.airborne_speed_rad_per_s),
        ("largest_efficiency", fastest.efficiency),
        ("speed_ratio_at_optimum", fastest.speed_ratio.unwrap_or(f64::NAN)),
    ];
    for (name, computed) in numbers {
        let mut claim = in_turns(Claim::printed(&format!("section3.{name}"), computed), computed);
        if name == "optimal_amplitude_angle" {
            let printed = PrintedNumber::read(&data.printed.optimal_amplitude_angle_rad);
            let angle = printed.map_or(f64::NAN, |printed| printed.value);
            let (angles, speeds) = (&data.amplitude_angle_rad, &curve.airborne_speed_rad_per_s);
            let (places, share) = accepted(angles, speeds);
            claim = claim.at_printed_place(lower_at(angles, speeds, angle), share).note(places);
        }
        if name == "largest_efficiency" {
            claim = claim.note(format!(
                "{:.3} if the energy lost in friction is not counted as put in",
                data.lossless_efficiency_of_fastest,
            ));
        }
        if claim.verdict == claim::Verdict::Differs {
            claim = claim.note(&reason);
        }
        claims.push(claim.cause(OTHER_OPTIMUM));
    }
    claims.push(one_optimum(data, curve));
    claims.extend(largest_ratio(data, curve).into_iter().flatten());
    claims.extend(beside_the_optimum(data, fastest));
    claims
}

/// An angle is also given as a multiple of π, as it is printed.
fn in_turns(claim: Claim, computed: f64) -> Claim {
    if claim.unit == "rad" {
        let note = format!("computed {}, printed {}", pi(computed), claim.printed);
        return claim.note(note);
    }
    claim
}

fn optimal_phase_lag(data: &Fig04Data) -> Option<Claim> {
    let absolute = best(data, InitialSpin::AbsoluteRest)?;
    let relative = best(data, InitialSpin::RestRelativeToHand)?;
    let drawn = curves(data, InitialSpin::AbsoluteRest);
    let best = |of: fn(&LagCurve) -> f64| drawn.iter().max_by(|one, other| of(one).total_cmp(&of(other)));
    let fastest = best(|curve| curve.fastest.airborne_speed_rad_per_s.abs())?;
    let efficient = best(|curve| curve.most_efficient.efficiency)?;
    // A lag of π is the same motion the other way.
    let linear = |curve: &LagCurve| curve.n.is_multiple_of(LINEAR_LAGS);
    Some(Claim::printed_statement(
        "section3.optimal_phase_lag",
        linear(fastest) && linear(efficient),
        format!(
            "dough at rest at the start: of all phase lags and φ_L the fastest toss has θ = {} and the most efficient θ = {} (or π \
             more). A dough that starts with the hand is fastest, {:.2} rad/s, at θ = {}, φ_L = {}",
            pi(absolute.fastest_phase_lag_rad),
            pi(absolute.most_efficient_phase_lag_rad),
            relative.fastest.airborne_speed_rad_per_s,
            pi(relative.fastest_phase_lag_rad),
            pi(relative.fastest.amplitude_angle_rad),
        ),
    ))
}

/// The paper reads one φ_L for the largest speed and the largest efficiency off its curves.
fn one_optimum(data: &Fig04Data, curve: &LagCurve) -> Claim {
    let (fastest, efficient) = (&curve.fastest, &curve.most_efficient);
    let apart = (fastest.amplitude_angle_rad - efficient.amplitude_angle_rad).abs();
    let lower = lower_at(&data.amplitude_angle_rad, &curve.efficiency, fastest.amplitude_angle_rad);
    Claim::printed_statement(
        "section3.one_optimum",
        lower <= LINE_WIDTH,
        format!(
            "θ = 0: the airborne speed is largest at φ_L = {}, the efficiency at {}, {} apart. At the first the efficiency is {:.4}, at the \
             second {:.4}: lower by {:.2} % of what the curve spans",
            pi(fastest.amplitude_angle_rad),
            pi(efficient.amplitude_angle_rad),
            pi(apart),
            fastest.efficiency,
            efficient.efficiency,
            100.0 * lower,
        ),
    )
}

/// max |ν| and its place are read off the drawn curves.
fn largest_ratio(data: &Fig04Data, linear: &LagCurve) -> Option<Vec<Claim>> {
    let at_zero = &linear.largest_speed_ratio;
    let drawn = curves(data, InitialSpin::AbsoluteRest)
        .iter()
        .max_by(|one, other| size(&one.largest_speed_ratio).total_cmp(&size(&other.largest_speed_ratio)))?;
    let angle = PrintedNumber::read(&data.printed.amplitude_angle_of_largest_speed_ratio_rad)?;
    let ratios: Vec<f64> = linear.speed_ratio.iter().map(|ratio| ratio.unwrap_or(f64::NAN)).collect();
    let known: Vec<f64> = ratios.iter().copied().filter(|ratio| !ratio.is_nan()).collect();
    let angles = &data.amplitude_angle_rad[ratios.len() - known.len()..];
    let (places, share) = accepted(angles, &known);
    let all = curves(data, InitialSpin::AbsoluteRest);
    let highest = size(&drawn.largest_speed_ratio);
    let as_high = all.iter().filter(|curve| highest - size(&curve.largest_speed_ratio) <= LINE_WIDTH).count();
    Some(vec![
        Claim::printed("section3.largest_speed_ratio", highest)
            .note(format!("of the curves drawn, θ = nπ/8, that of n = {}", drawn.n)),
        in_turns(
            Claim::printed("section3.amplitude_angle_of_largest_speed_ratio", at_zero.amplitude_angle_rad),
            at_zero.amplitude_angle_rad,
        )
        .at_printed_place(lower_at(angles, &known, angle.value), share)
        .note(places),
        Claim::printed("section3.phase_lag_of_largest_speed_ratio", drawn.phase_lag_rad)
            .at_printed_place((highest - size(at_zero)).max(0.0), as_high as f64 / all.len() as f64),
    ])
}

/// |ν| of a toss.
fn size(toss: &TossPoint) -> f64 {
    toss.speed_ratio.map_or(f64::NAN, f64::abs)
}

/// How the optimum compares with the largest ratio and with the observed tosses.
fn beside_the_optimum(data: &Fig04Data, fastest: &TossPoint) -> Vec<Claim> {
    let at_optimum = data.speed_ratio_at_printed_optimum;
    let drawn = curves(data, InitialSpin::AbsoluteRest).iter().map(|curve| size(&curve.largest_speed_ratio));
    let largest = drawn.max_by(f64::total_cmp);
    // The paper calls negligible at most the difference of two ratios that print like its two.
    let negligible = PrintedNumber::read(&data.printed.largest_speed_ratio)
        .zip(PrintedNumber::read(&data.printed.speed_ratio_at_optimum))
        .map(|(largest, at_optimum)| {
            largest.value - at_optimum.value + largest.half_unit + at_optimum.half_unit
        });
    let observed = PrintedNumber::read(&data.printed.observed_amplitude_angle_rad);
    let farthest = observed.map(|angle| angle.value + angle.uncertainty.unwrap_or(0.0));
    let between = &data.compromise;
    vec![
        Claim::printed_statement(
            "section3.speed_ratio_nearly_largest",
            largest.zip(negligible).zip(at_optimum).map(|((largest, negligible), ratio)| largest - ratio <= negligible),
            format!(
                "{:.4} at the printed optimum φ_L = {}, {:.4} at our own, {:.4} at most; the paper calls negligible what lies between two ratios \
                 that print as {} and {}, at most {:.3}",
                at_optimum.unwrap_or(f64::NAN),
                data.printed.optimal_amplitude_angle_rad,
                size(fastest),
                largest.unwrap_or(f64::NAN),
                data.printed.speed_ratio_at_optimum,
                data.printed.largest_speed_ratio,
                negligible.unwrap_or(f64::NAN),
            ),
        )
        .cause(OTHER_OPTIMUM),
        Claim::printed_statement(
            "section3.optimum_differs_from_observed",
            farthest.map(|farthest| fastest.amplitude_angle_rad > farthest),
            format!(
                "the fastest toss has φ_L = {}, the observed ones at most {} with the printed uncertainty",
                pi(fastest.amplitude_angle_rad),
                pi(farthest.unwrap_or(f64::NAN))
            ),
        ),
        Claim::printed_statement(
            "section3.compromise",
            between.least_slip_angle_rad < between.fastest_toss_angle_rad
                && between.fastest_toss_angle_rad < between.fastest_hand_at_separation_angle_rad,
            format!(
                "θ = 0: the dough slips least at φ_L = {} and is fastest at {}; the hand is fastest as the dough leaves at {} ({:.2} rad/s), and its largest speed \
                 ωΦ grows up to the end of the range, {}. So there is an optimum without any slip, too, because τ_sep moves away from the hand's fastest moment",
                pi(between.least_slip_angle_rad),
                pi(between.fastest_toss_angle_rad),
                pi(between.fastest_hand_at_separation_angle_rad),
                between.hand_speed_at_separation_rad_per_s,
                pi(data.largest_amplitude_angle_rad),
            ),
        ),
    ]
}

/// How the optimum depends on friction.
fn dependence(data: &Fig04Data) -> Claim {
    let shown = data.friction_curves.iter().map(|curve| (curve.friction, curve.fastest.amplitude_angle_rad));
    let low = data.low_friction.iter().map(|low| (low.friction, low.fastest.amplitude_angle_rad));
    let mut optima: Vec<_> = shown.chain(low).collect();
    optima.sort_by(|one, other| one.0.total_cmp(&other.0));
    let parts: Vec<_> =
        optima.iter().map(|(friction, angle)| format!("{} at μ = {friction}", pi(*angle))).collect();
    Claim::printed_statement(
        "section3.optimum_grows_with_friction",
        trend(optima.iter().copied(), 1.0),
        parts.join(", "),
    )
}

fn separation(data: &Fig04Data) -> Claim {
    Claim::printed("section3.separation_highest", data.separation.highest_rad)
        .note(
            "sin τ_sep = g/(cω² cos φ_L) reaches 1 at the end of the range of φ_L; π/4 is a misprint of π/2",
        )
        .cause("π/4 misprinted for π/2")
}
