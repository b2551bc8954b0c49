//! What the paper says about Fig. 4, compared with the data.

use std::f64::consts::{FRAC_PI_2, PI};

use bouncing_disk::InitialSpin;
use bouncing_disk::core::elementary::{asin, tan};

use super::consistency::PARAMETER_NAMES;
use super::data::{Best, CoarseGrid, Fig04Data, LagCurve, LagOptimum, RatioSearch, Reading, TossPoint};
use crate::claim::{self, Claim};
use crate::figures::samples;
use crate::figures::toss_case::TossCase;
use crate::judging::{LINE_WIDTH, trend};
use crate::printed::PrintedNumber;

const ID: &str = "fig04";
/// The bound for symmetries that hold exactly but for rounding.
const SYMMETRY_BOUND: f64 = 1e-12;
/// The lags θ = nπ/8 with n a multiple of this are linear motions.
const LINEAR_LAGS: u32 = 8;
/// A speed ratio this close to its largest is as large: the lag of a maximum is known to 1e-8, and the ratio
/// falls with its square.
const RATIO_BOUND: f64 = 1e-9;

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

pub(super) fn claims(data: &Fig04Data) -> Vec<Claim> {
    let mut claims = optimum(data);
    claims.extend(consistency(data));
    claims.push(dependence(data));
    claims.extend(separation(data));
    claims.extend(symmetry(data));
    claims
}

/// Why the optimum of Table I as printed is another one.
const OTHER_OPTIMUM: &str = "Table I has its optimum at another φ_L";

/// By how much a curve at an angle is lower than its maximum, as a share of what it spans.
fn lower_at(angles: &[f64], curve: &[f64], angle: f64) -> f64 {
    let (low, high) = samples::extent(curve.iter().copied());
    let points = || angles.iter().zip(curve);
    let between = points().zip(points().skip(1)).find(|(_, (end, _))| **end >= angle);
    let there = between
        .map_or(f64::NAN, |((from, one), (to, other))| one + (other - one) * (angle - from) / (to - from));
    (high - there) / (high - low)
}

/// The angles at which a curve is lower than its maximum by no more than a line's width.
fn accepted(angles: &[f64], curve: &[f64]) -> String {
    let (low, high) = samples::extent(curve.iter().copied());
    let as_high = angles.iter().zip(curve).filter(|(_, value)| high - **value <= LINE_WIDTH * (high - low));
    let (from, to) = samples::extent(as_high.map(|(angle, _)| *angle));
    format!("places from {} to {} are as high", pi(from), pi(to))
}

/// The best toss with the parameters of Table I.
fn optimum(data: &Fig04Data) -> Vec<Claim> {
    let table_i_speed = data.table_i_toss.airborne_speed_rad_per_s;
    let measured = &data.printed.launch_angular_speed_rad_per_s;
    let observed = &data.table_i.amplitude_angle_rad;
    let mut claims = vec![
        Claim::printed("section3.predicted_airborne_speed", table_i_speed)
            .note("its printed uncertainty is answered by table2"),
        Claim::printed_statement(
            "section3.prediction_agrees",
            (table_i_speed - measured.value).abs() <= measured.uncertainty,
            format!(
                "{table_i_speed:.2} rad/s against {measured} rad/s; no evidence for the model: Eq. (14) computes ω and φ_L from this \
                 very speed, and a dough that leaves without slip has it back but for the factor cos τ_sep and the rounding of \
                 Table I"
            ),
        ),
        Claim::printed("section3.observed_amplitude_angle", observed.value)
            .note(format!("Table I's {observed} rad in other units: ± {}", pi(observed.uncertainty))),
    ];
    claims.extend(optimal_phase_lag(data));
    let Some(curve) = curves(data, InitialSpin::AbsoluteRest).first() else { return claims };
    let fastest = &curve.fastest;
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
            claim = claim.at_printed_place(lower_at(angles, speeds, angle)).note(accepted(angles, speeds));
        }
        if name == "largest_efficiency" {
            claim = claim.note(format!(
                "{:.3} if the energy lost in friction is not counted as put in",
                data.lossless_efficiency_of_fastest,
            ));
        }
        if claim.verdict() == claim::Verdict::Differs {
            claim = claim.note(&reason);
        }
        claims.push(claim.cause(OTHER_OPTIMUM));
    }
    claims.extend(amplitude_ratio(data));
    claims.push(one_optimum(data, curve));
    claims.extend(largest_ratio(data, curve).into_iter().flatten());
    claims.extend(beside_the_optimum(data, fastest));
    claims
}

/// An angle is also given as a multiple of π, as it is printed.
fn in_turns(claim: Claim, computed: f64) -> Claim {
    if claim.unit() == "rad" {
        let note = format!("computed {}, printed {}", pi(computed), claim.printed_text());
        return claim.note(note);
    }
    claim
}

/// The printed L is the tangent of the printed φ_L.
fn amplitude_ratio(data: &Fig04Data) -> Option<Claim> {
    let printed = PrintedNumber::read(&data.printed.optimal_amplitude_angle_rad)?;
    Some(Claim::printed("section3.optimal_amplitude_ratio", tan(printed.value)).note(format!(
        "the tangent of the printed φ_L = {}: printed against printed",
        data.printed.optimal_amplitude_angle_rad
    )))
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
            "dough at rest at the start: of all phase lags and φ_L the fastest toss has θ = {:.1e}π and the most efficient θ = {:.1e}π (or π \
             more); a linear path is a helix on the cylinder. A dough that starts with the hand is fastest, {:.2} rad/s, at θ = {}, φ_L = {}: \
             the paper's optimum needs a start from rest, as Sec. III A says",
            absolute.fastest_phase_lag_rad / PI,
            absolute.most_efficient_phase_lag_rad / PI,
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

fn search(data: &Fig04Data, initial: InitialSpin) -> Option<&RatioSearch> {
    data.largest_ratio.iter().find(|search| search.initial_state == initial)
}

/// The sampled amplitude angles at which the best lag gives a ratio as large as any.
fn plateau(search: &RatioSearch) -> impl Iterator<Item = &LagOptimum> {
    search.over_lags.iter().filter(|optimum| optimum.speed_ratio >= search.largest.speed_ratio - RATIO_BOUND)
}

/// What the search over all lags has found, in words.
fn found(search: &RatioSearch) -> String {
    let angles = plateau(search).map(|optimum| optimum.amplitude_angle_rad);
    let off = plateau(search)
        .map(|optimum| (optimum.phase_lag_rad + optimum.separation_phase_rad).abs())
        .fold(0.0, f64::max);
    format!(
        "largest |ν| = {:.6}, at every sampled φ_L up to {} (of {} samples), where θ = −τ_sep to {off:.0e} rad",
        search.largest.speed_ratio,
        pi(angles.fold(0.0, f64::max)),
        search.over_lags.len(),
    )
}

/// max |ν| and its place are read off the drawn curves; over all lags it is another one.
fn largest_ratio(data: &Fig04Data, linear: &LagCurve) -> Option<Vec<Claim>> {
    let absolute = search(data, InitialSpin::AbsoluteRest)?;
    let relative = search(data, InitialSpin::RestRelativeToHand)?;
    let at_zero = &linear.largest_speed_ratio;
    let drawn = curves(data, InitialSpin::AbsoluteRest)
        .iter()
        .max_by(|one, other| size(&one.largest_speed_ratio).total_cmp(&size(&other.largest_speed_ratio)))?;
    let angle = PrintedNumber::read(&data.printed.amplitude_angle_of_largest_speed_ratio_rad)?;
    let ratios: Vec<f64> = linear.speed_ratio.iter().map(|ratio| ratio.unwrap_or(f64::NAN)).collect();
    let known: Vec<f64> = ratios.iter().copied().filter(|ratio| !ratio.is_nan()).collect();
    let angles = &data.amplitude_angle_rad[ratios.len() - known.len()..];
    let over_all = format!(
        "dough at rest at the start: {}; turning with the hand: {}. There the hand is fastest just as the dough leaves, and friction holds the \
         dough up to then where tan φ_L ≤ (μa_e²/a_g²) cos τ_sep, up to φ_L = {}",
        found(absolute),
        found(relative),
        pi(data.held_to_separation_angle_rad)
    );
    let key = "section3.largest_speed_ratio";
    Some(vec![
        Claim::printed(key, size(&drawn.largest_speed_ratio))
            .note(format!("of the curves drawn, θ = nπ/8, that of n = {}", drawn.n)),
        Claim::reading(ID, key, "largest |ν| of all φ_L and θ", absolute.largest.speed_ratio).note(over_all),
        in_turns(
            Claim::printed("section3.amplitude_angle_of_largest_speed_ratio", at_zero.amplitude_angle_rad),
            at_zero.amplitude_angle_rad,
        )
        .at_printed_place(lower_at(angles, &known, angle.value))
        .note(accepted(angles, &known)),
        Claim::printed("section3.phase_lag_of_largest_speed_ratio", drawn.phase_lag_rad)
            .at_printed_place((size(&drawn.largest_speed_ratio) - size(at_zero)).max(0.0)),
    ])
}

/// |ν| of a toss.
fn size(toss: &TossPoint) -> f64 {
    toss.speed_ratio.map_or(f64::NAN, f64::abs)
}

/// How the optimum compares with the largest ratio and with the observed tosses.
fn beside_the_optimum(data: &Fig04Data, fastest: &TossPoint) -> Vec<Claim> {
    let at_optimum = size(fastest);
    let drawn = curves(data, InitialSpin::AbsoluteRest).iter().map(|curve| size(&curve.largest_speed_ratio));
    let largest = drawn.max_by(f64::total_cmp);
    // What the paper calls negligible: whatever two ratios that print like its two differ by.
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
            largest.zip(negligible).map(|(largest, negligible)| largest - at_optimum <= negligible),
            format!(
                "{at_optimum:.4} at the optimum, {:.4} at most; the paper calls negligible what lies between two ratios that print as {} and {}, at \
                 most {:.3}",
                largest.unwrap_or(f64::NAN),
                data.printed.speed_ratio_at_optimum,
                data.printed.largest_speed_ratio,
                negligible.unwrap_or(f64::NAN),
            ),
        ),
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

/// Which sets of parameters give the printed numbers.
fn consistency(data: &Fig04Data) -> Vec<Claim> {
    let place = "Sec. III B";
    let text = &data.printed;
    let consistency = &data.consistency;
    let mut claims = Vec::new();
    let hand = &consistency.hand_speed;
    claims.push(Claim::statement(
        ID,
        place,
        "printed φ_L, speed and speed ratio of the optimum fit Table I's c, ω and a_e",
        hand.least_rad_per_s <= hand.most_rad_per_s,
        format!(
            "the hand's largest speed at the printed φ_L is at least {:.2} rad/s; the printed speed and ratio allow at most {:.2} rad/s, whatever μ and a_g; \
             with a_g alone changed: {}; {}",
            hand.least_rad_per_s,
            hand.most_rad_per_s,
            described(&consistency.radius_alone),
            listed(&consistency.radius_alone)
        ),
    ));
    let nearest = &consistency.nearest;
    let first = nearest.numbers.split_last().map_or(&[][..], |(_, first)| first);
    claims.push(Claim::statement(
        ID,
        place,
        "the printed φ_L, speed, efficiency and ratio of the optimum, the largest ratio at θ = 0 and the speed of Table I's \
         toss come out together inside Table I's uncertainties",
        claim::all(first, |number| number.reproduced)
            .zip(claim::all(&nearest.shifts, |shift| shift.abs() <= 1.0))
            .map(|(reproduced, within)| reproduced && within),
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
            "the printed φ_L of the fastest toss and of the largest ratio are both places of true maxima at θ = 0",
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
    claims.extend(even_grid(&consistency.coarse_grid));
    claims
}

/// What an even grid of amplitude angles gives.
fn even_grid(grid: &CoarseGrid) -> impl Iterator<Item = Claim> + '_ {
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
    grid.reading.numbers.iter().enumerate().map(move |(index, number)| {
        let quantity = format!("{}, as the best of {} intervals", number.quantity, grid.intervals);
        let claim = Claim::reading(ID, &number.key, quantity, number.computed)
            .fitted("a_g, and the number of intervals")
            .note(described(&grid.reading));
        if index == 0 { claim.note(&evidence) } else { claim }
    })
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

fn separation(data: &Fig04Data) -> Vec<Claim> {
    let separation = &data.separation;
    let table = TossCase::from(&data.table_i);
    let lowest = asin(1.0 / table.stroke_acceleration());
    let launches = &data.no_launch;
    vec![
        Claim::printed_statement(
            "section3.no_launch_beyond",
            launches.launched_just_below && launches.launched_beyond == 0,
            format!(
                "a dough on a hand with φ_L just below arccos(g/cω²) = {} is launched; of {} hands beyond, up to π/2, {} launch it",
                pi(data.largest_amplitude_angle_rad),
                launches.tried_beyond,
                launches.launched_beyond
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
        Claim::printed("section3.separation_highest", separation.highest_rad).note(format!(
            "{:.1e} rad below π/2: sin τ_sep = g/(cω² cos φ_L) reaches 1 at the end of the range of φ_L; π/4 is a misprint of π/2",
            FRAC_PI_2 - separation.highest_rad
        ))
        .cause("π/4 misprinted for π/2"),
    ]
}

fn symmetry(data: &Fig04Data) -> [Claim; 2] {
    let symmetry = &data.symmetry;
    let pairs = format!("over {} pairs of tosses of both initial states", symmetry.tosses);
    let some = |holds: bool| (symmetry.tosses > 0).then_some(holds);
    [
        Claim::printed_statement(
            "section3.airborne_speed_symmetry",
            some(symmetry.airborne_speed_rad_per_s < SYMMETRY_BOUND && symmetry.speed_ratio < SYMMETRY_BOUND),
            format!(
                "largest deviations {:.1e} rad/s and {:.1e} {pairs}; the ratio is the speed over ωΦ, which does not change",
                symmetry.airborne_speed_rad_per_s, symmetry.speed_ratio
            ),
        ),
        Claim::printed_statement(
            "section3.efficiency_symmetry",
            some(symmetry.efficiency < SYMMETRY_BOUND),
            format!("largest deviation {:.1e} {pairs}", symmetry.efficiency),
        ),
    ]
}
