//! What the paper says about Fig. 4, compared with the data.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

use bouncing_disk::InitialState;
use bouncing_disk::core::elementary::{asin, sin, tan};

use super::consistency::PARAMETER_NAMES;
use super::data::{Best, LagCurve, Reading, TossPoint};
use super::{Fig04Data, TossCase, maximum_index};
use crate::claim::Claim;
use crate::printed::PrintedNumber;

const ID: &str = "fig04";
/// The bound for symmetries that hold exactly but for rounding.
const SYMMETRY_BOUND: f64 = 1e-12;

/// An angle as a multiple of π.
fn pi(angle: f64) -> String {
    format!("{:.4}π", angle / PI)
}

fn curves(data: &Fig04Data, initial: InitialState) -> &[LagCurve] {
    data.families.iter().find(|family| family.initial_state == initial).map_or(&[], |family| &family.curves)
}

fn best(data: &Fig04Data, initial: InitialState) -> Option<&Best> {
    data.best.iter().find(|best| best.initial_state == initial)
}

/// The parameters of a reading that differ from Table I, and the shifts in units of its uncertainties.
fn described(reading: &Reading) -> String {
    let case = &reading.parameters;
    let values = [
        format!("{:.4} m", case.stroke_m),
        format!("{:.2} rad/s", case.angular_frequency_rad_per_s),
        format!("{:.4} m", case.contact_radius_m),
        format!("{:.4} m", case.gyration_radius_m),
        format!("{:.3}", case.friction),
    ];
    let named = PARAMETER_NAMES.iter().zip(values).zip(&reading.shifts);
    let parts = named
        .filter(|(_, shift)| shift.abs() > 1e-9)
        .map(|((name, value), shift)| format!("{name} = {value} ({shift:+.2} of its uncertainty)"));
    parts.collect::<Vec<_>>().join(", ")
}

fn listed(reading: &Reading) -> String {
    let parts = reading.numbers.iter().map(|number| {
        let computed = if number.quantity.starts_with("φ_L") {
            pi(number.computed)
        } else {
            format!("{:.4}", number.computed)
        };
        let verdict = if number.reproduced { "agrees" } else { "differs" };
        format!("{}: {computed}, printed {}, {verdict}", number.quantity, number.printed)
    });
    parts.collect::<Vec<_>>().join("; ")
}

pub(super) fn caption(data: &Fig04Data) -> String {
    let grid = &data.consistency.coarse_grid;
    format!(
        "The performance of pizza tosses with the parameters of Table I: (a) airborne rotation speed, (b) energy \
         efficiency and (c) ratio of airborne speed to the hand's largest speed against the amplitude ratio φ_L = \
         arctan L at phase lags θ = nπ/8, with n at the curves; a circle marks the fastest, most efficient and \
         highest-ratio toss at θ = 0. The dough starts at rest in (a)–(c), and turning with the hand in (a′)–(c′), \
         where its initial spin counts as put in by the hand; the two agree at θ = 0 and π. (d) Airborne speed \
         against the phase of separation τ_sep, which runs from arcsin(g/cω²) = {} to π/2. (e) Airborne speed at \
         θ = 0 for three coefficients of friction; circles mark the maxima. (f) The maximum at θ = 0: Table I as \
         printed, the nearest set of parameters that gives the printed φ_L, speed, efficiency and ratio (distance \
         {:.2} in units of the uncertainties), and ω = {:.2} rad/s of Eq. (14) with a_g = {:.4} m, sampled at {} \
         equal intervals of φ_L, whose best point has all printed numbers; the square is the printed maximum with \
         the rounding of its digits.",
        pi(data.separation.lowest_rad),
        data.consistency.nearest.distance,
        grid.angular_frequency_rad_per_s,
        grid.reading.parameters.gyration_radius_m,
        grid.intervals,
    )
}

pub(super) fn parameters(data: &Fig04Data) -> Vec<(String, String)> {
    let table = &data.table_i;
    [
        ("phase lag θ", "nπ/8, n = 0 … 8".to_owned()),
        ("amplitude angle φ_L", format!("0 to arccos(g/cω²) = {}", pi(data.largest_amplitude_angle_rad))),
        ("stroke c", format!("{} m", table.stroke_m)),
        ("angular frequency ω", format!("{} rad/s", table.angular_frequency_rad_per_s)),
        ("contact radius a_e", format!("{} m", table.contact_radius_m)),
        ("radius of gyration a_g", format!("{} m", table.gyration_radius_m)),
        ("friction μ", format!("{}; (e) {}", table.friction, frictions(data))),
        ("gravity g", format!("{} m/s²", table.preload_acceleration_m_per_s2)),
        ("start", "lowest point of the hand, τ = 3π/2; dough at rest, or turning with the hand".to_owned()),
        ("points of a curve", data.amplitude_angle_rad.len().to_string()),
    ]
    .map(|(name, value)| (name.to_owned(), value))
    .to_vec()
}

fn frictions(data: &Fig04Data) -> String {
    let texts: Vec<_> = data.friction_curves.iter().map(|curve| curve.friction.to_string()).collect();
    texts.join(", ")
}

pub(super) fn claims(data: &Fig04Data) -> Vec<Claim> {
    let mut claims = optimum(data);
    claims.extend(consistency(data));
    claims.extend(dependence(data));
    claims.extend(separation(data));
    claims.extend(symmetry(data));
    claims
}

/// The best toss with the parameters of Table I.
fn optimum(data: &Fig04Data) -> Vec<Claim> {
    let table_i_speed = data.table_i_toss.airborne_speed_rad_per_s;
    let measured = &data.printed.launch_angular_speed_rad_per_s;
    let mut claims = vec![
        Claim::printed("section3.predicted_airborne_speed", table_i_speed)
            .note("the uncertainty is the subject of Table II"),
        Claim::printed_statement(
            "section3.prediction_agrees",
            (table_i_speed - measured.value).abs() <= measured.uncertainty,
            format!("{table_i_speed:.2} rad/s against {measured} rad/s"),
        ),
        Claim::printed("section3.observed_amplitude_angle", data.table_i.amplitude_angle_rad.value),
    ];
    let curves = curves(data, InitialState::AbsoluteRest);
    let relative = best(data, InitialState::RestRelativeToHand);
    if let (Some(absolute), Some(relative)) = (best(data, InitialState::AbsoluteRest), relative) {
        let fastest = maximum_index(curves.iter().map(|curve| curve.fastest.airborne_speed_rad_per_s.abs()));
        let efficient = maximum_index(curves.iter().map(|curve| curve.most_efficient.efficiency));
        let ends = [0, curves.len().saturating_sub(1)];
        let holds = ends.contains(&fastest) && ends.contains(&efficient);
        claims.push(Claim::printed_statement(
            "section3.optimal_phase_lag",
            holds,
            format!(
                "dough at rest at the start: of all phase lags θ = {} is fastest and θ = {} most efficient; dough \
                 that starts with the hand: {:.2} rad/s at θ = {}, φ_L = {}, so that the paper's optimum needs a \
                 start from rest",
                pi(absolute.fastest_phase_lag_rad),
                pi(absolute.most_efficient_phase_lag_rad),
                relative.fastest.airborne_speed_rad_per_s,
                pi(relative.fastest_phase_lag_rad),
                pi(relative.fastest.amplitude_angle_rad),
            ),
        ));
    }
    let Some(curve) = curves.first() else { return claims };
    let (fastest, largest_ratio) = (&curve.fastest, &curve.largest_speed_ratio);
    let grid = &data.consistency.coarse_grid;
    let reason = format!(
        "Table I as printed; all printed numbers come out with {}, both {} and {} to two digits, if the maximum is \
         the best of {} equal intervals of φ_L",
        described(&grid.reading),
        data.table_i.angular_frequency_rad_per_s.value,
        data.table_i.gyration_radius_m.value,
        grid.intervals
    );
    let numbers = [
        ("optimal_amplitude_angle", fastest.amplitude_angle_rad),
        ("optimal_amplitude_ratio", tan(fastest.amplitude_angle_rad)),
        ("largest_airborne_speed", fastest.airborne_speed_rad_per_s),
        ("largest_efficiency", fastest.efficiency),
        ("speed_ratio_at_optimum", fastest.speed_ratio.unwrap_or(f64::NAN)),
        ("largest_speed_ratio", largest_ratio.speed_ratio.unwrap_or(f64::NAN)),
        ("amplitude_angle_of_largest_speed_ratio", largest_ratio.amplitude_angle_rad),
    ];
    for (name, computed) in numbers {
        let mut claim = Claim::printed(&format!("section3.{name}"), computed);
        if claim.unit() == "rad" {
            let note = format!("computed {}, printed {}", pi(computed), claim.printed_text());
            claim = claim.note(note);
        }
        if name == "largest_efficiency" {
            claim = claim.note(format!(
                "{:.3} if the energy lost in friction is not counted as put in; the most efficient toss, at φ_L = \
                 {}, has {:.4}",
                data.lossless_efficiency_of_fastest,
                pi(curve.most_efficient.amplitude_angle_rad),
                curve.most_efficient.efficiency
            ));
        }
        if claim.verdict() == crate::claim::Verdict::Differs {
            claim = claim.note(&reason);
        }
        claims.push(claim);
    }
    claims.extend(beside_the_optimum(data, fastest, largest_ratio));
    claims
}

/// How the optimum compares with the largest ratio and with the observed tosses.
fn beside_the_optimum(data: &Fig04Data, fastest: &TossPoint, largest_ratio: &TossPoint) -> [Claim; 2] {
    let at_optimum = fastest.speed_ratio.unwrap_or(f64::NAN);
    let largest = largest_ratio.speed_ratio.unwrap_or(f64::NAN);
    // The paper calls the difference of the printed ratios negligible.
    let printed = PrintedNumber::read(&data.printed.largest_speed_ratio)
        .zip(PrintedNumber::read(&data.printed.speed_ratio_at_optimum))
        .map_or(f64::NAN, |(largest, at_optimum)| largest.value - at_optimum.value);
    let observed = PrintedNumber::read(&data.printed.observed_amplitude_angle_rad);
    let farthest = observed.map_or(f64::NAN, |angle| angle.value + angle.uncertainty.unwrap_or(0.0));
    [
        Claim::printed_statement(
            "section3.speed_ratio_nearly_largest",
            largest - at_optimum <= printed,
            format!(
                "{at_optimum:.4} at the optimum, {largest:.4} at most; the printed numbers differ by {printed:.2}"
            ),
        ),
        Claim::printed_statement(
            "section3.optimum_differs_from_observed",
            fastest.amplitude_angle_rad > farthest,
            format!(
                "the fastest toss has φ_L = {}, the observed ones at most {} with the printed uncertainty",
                pi(fastest.amplitude_angle_rad),
                pi(farthest)
            ),
        ),
    ]
}

/// Which sets of parameters give the printed numbers.
fn consistency(data: &Fig04Data) -> Vec<Claim> {
    let place = "Sec. III B";
    let text = &data.printed;
    let consistency = &data.consistency;
    let grid = &consistency.coarse_grid;
    let mut claims = Vec::new();
    // Speed and ratio together fix the hand's speed, whatever the friction.
    let table = TossCase::from(&data.table_i);
    let printed = [
        &text.optimal_amplitude_angle_rad,
        &text.largest_airborne_speed_rad_per_s,
        &text.speed_ratio_at_optimum,
    ]
    .map(|text| PrintedNumber::read(text));
    if let [Some(angle), Some(speed), Some(ratio)] = printed {
        let rim = table.stroke_m * table.angular_frequency_rad_per_s / table.contact_radius_m;
        let slowest = rim * sin(angle.value - angle.half_unit);
        let fastest = (speed.value + speed.half_unit) / (ratio.value - ratio.half_unit);
        claims.push(Claim::statement(
            ID,
            place,
            "printed φ_L, speed and speed ratio of the optimum fit Table I's c, ω and a_e",
            slowest <= fastest,
            format!(
                "the hand's largest speed at the printed φ_L is at least {slowest:.2} rad/s; the printed speed and \
                 ratio allow at most {fastest:.2} rad/s, whatever μ and a_g; with a_g alone changed: {}; {}",
                described(&consistency.radius_alone),
                listed(&consistency.radius_alone)
            ),
        ));
    }
    let nearest = &consistency.nearest;
    let first = nearest.numbers.split_last().map_or(&[][..], |(_, first)| first);
    claims.push(Claim::statement(
        ID,
        place,
        "the printed φ_L, speed, efficiency and ratio of the optimum, the largest ratio and the speed of Table I's \
         toss come out together inside Table I's uncertainties",
        first.iter().all(|number| number.reproduced) && nearest.shifts.iter().all(|shift| shift.abs() <= 1.0),
        format!(
            "nearest set: {}; distance {:.2}; {}",
            described(nearest),
            nearest.distance,
            listed(nearest)
        ),
    ));
    let conflict = &consistency.conflict;
    if let Some(printed) = PrintedNumber::read(&text.optimal_amplitude_angle_rad) {
        claims.push(Claim::statement(
            ID,
            place,
            "the printed φ_L of the fastest toss and of the largest ratio are both places of true maxima",
            conflict.optimal_amplitude_angle_rad >= printed.value - printed.half_unit,
            format!(
                "a largest ratio of {:.3} at φ_L = {}, the lowest that round to the printed numbers, needs cω²/g = \
                 {:.3} and μa_e²/a_g² = {:.4}; the fastest toss then has φ_L = {}, and less wherever both are higher",
                conflict.largest_speed_ratio,
                pi(conflict.amplitude_angle_of_largest_speed_ratio_rad),
                conflict.stroke_acceleration,
                conflict.grip,
                pi(conflict.optimal_amplitude_angle_rad),
            ),
        ));
    }
    let range = grid.gyration_radius_range_m.map_or_else(
        || "no a_g gives all numbers".to_owned(),
        |(low, high)| format!("a_g from {low:.4} to {high:.4} m gives all numbers"),
    );
    let printed_frequency = grid.intervals_with_printed_frequency.map_or_else(
        || format!("no grid of up to {} intervals fits", grid.most_intervals),
        |intervals| format!("{intervals} intervals fit"),
    );
    let evidence = format!(
        "Eq. (14) gives ω = {:.3} rad/s before rounding; from 0 to arccos(g/cω²) = {} the points {:?} of {} equal \
         intervals are the angles that the paper prints here and in Fig. 5; ω from {:.2} to {:.2} rad/s fits; {:.1} % \
         of all ranges would fit as few intervals by chance; with ω as printed {printed_frequency}; {range}",
        grid.angular_frequency_rad_per_s,
        pi(grid.largest_amplitude_angle_rad),
        grid.indices,
        grid.intervals,
        grid.frequency_range_rad_per_s.0,
        grid.frequency_range_rad_per_s.1,
        100.0 * grid.share_by_chance,
    );
    for (index, number) in grid.reading.numbers.iter().enumerate() {
        let quantity = format!("{}, as the best of {} intervals", number.quantity, grid.intervals);
        let claim = Claim::reading(ID, &number.key, quantity, number.computed).note(described(&grid.reading));
        claims.push(if index == 0 { claim.note(&evidence) } else { claim });
    }
    claims
}

/// How the optimum depends on friction.
fn dependence(data: &Fig04Data) -> Vec<Claim> {
    let place_of = |friction: f64, angle: f64| format!("{} at μ = {friction}", pi(angle));
    let shown: Vec<_> = data
        .friction_curves
        .iter()
        .map(|curve| (curve.friction, curve.fastest.amplitude_angle_rad))
        .collect();
    let low: Vec<_> = data
        .low_friction
        .iter()
        .map(|optimum| (optimum.friction, optimum.fastest.amplitude_angle_rad))
        .collect();
    let evidence = |optima: &[(f64, f64)]| {
        let parts: Vec<_> = optima.iter().map(|(friction, angle)| place_of(*friction, *angle)).collect();
        parts.join(", ")
    };
    // Halving a small friction coefficient halves the angle.
    let falls = low.windows(2).all(|pair| pair[1].1 < 0.6 * pair[0].1);
    vec![
        Claim::printed_statement(
            "section3.optimum_grows_with_friction",
            shown.windows(2).all(|pair| (pair[1].1 > pair[0].1) == (pair[1].0 > pair[0].0)),
            evidence(&shown),
        ),
        Claim::printed_statement(
            "section3.optimum_vanishes_with_friction",
            falls && !low.is_empty(),
            evidence(&low),
        ),
    ]
}

fn separation(data: &Fig04Data) -> Vec<Claim> {
    let separation = &data.separation;
    let table = TossCase::from(&data.table_i);
    let lowest = asin(1.0 / table.stroke_acceleration());
    let launched = |angle: f64| table.at_angle(angle).toss(InitialState::AbsoluteRest).is_ok();
    vec![
        Claim::printed_statement(
            "section3.no_launch_beyond",
            launched((1.0 - 1e-9) * table.largest_angle()) && !launched((1.0 + 1e-9) * table.largest_angle()),
            format!(
                "a dough on a hand with φ_L just below arccos(g/cω²) = {} is launched, one just above is not",
                pi(table.largest_angle())
            ),
        ),
        Claim::printed_statement(
            "section3.separation_phase",
            separation.deviation_from_formula_rad < SYMMETRY_BOUND,
            format!("largest difference {:.1e} rad", separation.deviation_from_formula_rad),
        ),
        Claim::printed_statement(
            "section3.separation_lowest",
            (separation.lowest_rad - lowest).abs() < SYMMETRY_BOUND,
            format!("{:.6} rad", separation.lowest_rad),
        ),
        Claim::printed_statement(
            "section3.separation_highest",
            (separation.highest_rad - FRAC_PI_4).abs() < 1e-3,
            format!(
                "computed {:.5} rad, {:.1e} rad below π/2: sin τ_sep = g/(cω² cos φ_L) reaches 1 at the end of the \
                 range of φ_L; π/4 is a misprint of π/2",
                separation.highest_rad,
                FRAC_PI_2 - separation.highest_rad
            ),
        ),
    ]
}

fn symmetry(data: &Fig04Data) -> Vec<Claim> {
    let symmetry = &data.symmetry;
    let statements = [
        ("section3.airborne_speed_symmetry", symmetry.airborne_speed_rad_per_s, " rad/s"),
        ("section3.speed_ratio_symmetry", symmetry.speed_ratio, ""),
        ("section3.efficiency_symmetry", symmetry.efficiency, ""),
    ];
    statements
        .into_iter()
        .map(|(key, deviation, unit)| {
            Claim::printed_statement(
                key,
                deviation < SYMMETRY_BOUND,
                format!(
                    "largest deviation {deviation:.1e}{unit} over {} pairs of tosses of both initial states",
                    symmetry.tosses
                ),
            )
        })
        .collect()
}
