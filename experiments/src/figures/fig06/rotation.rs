//! What the paper says about the rotation in Fig. 6: Eq. (16), the two motions, mean speeds.

use std::f64::consts::{PI, TAU};

use bouncing_disk::core::elementary::cos;

use super::data::{Fig06Data, Slice};
use crate::claim::Claim;

/// Rounding of stored phases and speeds (1e-6) seen through the slopes of Eq. (16), and the slow approach to the
/// orbit next to a doubling.
const STORED: f64 = 1.0e-5;

pub(super) fn claims(data: &Fig06Data) -> Vec<Claim> {
    let mut claims = rotation(data);
    claims.extend(mean_speeds(data));
    claims
}

/// The phase, the angular speeds of (c) and (d) at the period-1 orbits, by rising Γ.
pub(super) fn period_ones(data: &Fig06Data) -> Vec<(&Slice, f64)> {
    let ones = data.followed.iter().filter(|slice| slice.period == Some(1));
    ones.filter_map(|slice| Some((slice, TAU * slice.impact_phase_cycles.first()?))).collect()
}

/// The smallest and the largest of some numbers.
pub(super) fn extent(values: impl IntoIterator<Item = f64>) -> (f64, f64) {
    let start = (f64::INFINITY, f64::NEG_INFINITY);
    values.into_iter().fold(start, |(low, high), value| (low.min(value), high.max(value)))
}

pub(super) fn width(values: &[f64]) -> f64 {
    let (low, high) = extent(values.iter().copied());
    high - low
}

/// How the rotation follows the vertical motion.
fn rotation(data: &Fig06Data) -> Vec<Claim> {
    let ones = period_ones(data);
    let lag = data.semielliptical.phase_lag_rad;
    let miss = |slice: &Slice, phase: f64| {
        let linear = slice.linear_mean - cos(phase + data.linear.phase_lag_rad);
        linear.abs().max((slice.semielliptical_mean - cos(phase + lag)).abs())
    };
    let (_, worst) = extent(ones.iter().map(|(slice, phase)| miss(slice, *phase)));
    let nearest = ones.iter().min_by(|one, other| (one.1 + lag).abs().total_cmp(&(other.1 + lag).abs()));
    let (_, fastest) = extent(ones.iter().map(|(slice, _)| slice.semielliptical_mean));
    let steps = |of: fn(&Slice) -> f64| {
        let steps = ones.windows(2).map(move |pair| of(pair[1].0) - of(pair[0].0));
        extent(steps)
    };
    let ends = |of: fn(&Slice) -> f64| match (ones.first(), ones.last()) {
        (Some((first, _)), Some((last, _))) => format!(
            "{:.4} ωΦ at Γ = {:.4}, {:.4} ωΦ at Γ = {:.4}",
            of(first),
            first.axial_forcing,
            of(last),
            last.axial_forcing
        ),
        _ => "no period-1 orbit".to_owned(),
    };
    let slices = || data.followed.iter().chain(&data.chattering);
    let apart = slices().filter(|slice| !slice.vertical_motions_agree).count();
    let leaves = data.chattering.first().map_or(f64::NAN, |slice| slice.axial_forcing);
    vec![
        Claim::printed_statement(
            "section1.no_bouncing",
            leaves * PI > 1.0,
            format!("the lowest Γ of the diagram at which a disk at rest leaves the platform is {leaves:.5}; 1/π = {:.5}", 1.0 / PI),
        ),
        Claim::printed_statement(
            "section4.rotation_does_not_act_back",
            apart == 0,
            format!(
                "at {apart} of {} values of Γ the vertical motions of (c) and (d) differ in any bit",
                slices().count()
            ),
        ),
        Claim::printed_statement(
            "section4.period_one_speed",
            worst < STORED,
            format!("largest deviation {worst:.1e} ωΦ at {} values of Γ, (c) and (d)", ones.len()),
        ),
        Claim::printed_statement(
            "section4.maximum_speed",
            nearest.is_some_and(|(slice, _)| {
                (fastest - slice.semielliptical_mean).abs() < STORED && (1.0 - STORED..=1.0 + STORED).contains(&fastest)
            }),
            nearest.map_or_else(String::new, |(slice, phase)| {
                format!(
                    "of all period-1 orbits in (d) the fastest, {fastest:.6} ωΦ, is the one with τ_imp + θ nearest to 0: \
                     {:.4} at Γ = {:.4}",
                    phase + lag,
                    slice.axial_forcing
                )
            }),
        ),
        Claim::printed_statement(
            "section4.linear_falls",
            steps(|slice| slice.linear_mean).1 < 0.0,
            ends(|slice| slice.linear_mean),
        ),
        Claim::printed_statement(
            "section4.semielliptical_rises",
            steps(|slice| slice.semielliptical_mean).0 > 0.0,
            ends(|slice| slice.semielliptical_mean),
        ),
        branches(data),
        oscillation(data),
    ]
}

/// The two branches of period 2.
fn branches(data: &Fig06Data) -> Claim {
    // (phase, speed) of the branch of large and of small impact speed.
    let pairs: Vec<[f64; 2]> = between(data, 0, 1)
        .into_iter()
        .filter(|slice| slice.period == Some(2))
        .filter_map(|slice| {
            let ([one, other], [speed, other_speed]) =
                (slice.impact_phase_cycles.get(..2)?, slice.normalised_impact_speed.get(..2)?)
            else {
                return None;
            };
            Some(if speed > other_speed { [*one, *other] } else { [*other, *one] })
        })
        .collect();
    let monotone = |branch: usize, sign: f64| {
        pairs.len() > 1 && pairs.windows(2).all(|pair| sign * (pair[1][branch] - pair[0][branch]) > 0.0)
    };
    let ends = |branch: usize| match (pairs.first(), pairs.last()) {
        (Some(first), Some(last)) => format!("{:.4} to {:.4}", first[branch], last[branch]),
        _ => "none".to_owned(),
    };
    Claim::printed_statement(
        "section4.period_two_branches",
        monotone(0, -1.0) && monotone(1, 1.0),
        format!(
            "τ_imp/2π from {} on the branch of large |w_A|, from {} on that of small |w_A|, at {} values of Γ",
            ends(0),
            ends(1),
            pairs.len()
        ),
    )
}

/// The range of angular speeds beyond period 4.
fn oscillation(data: &Fig06Data) -> Claim {
    let start = data.doublings.get(1).copied().unwrap_or(f64::NAN);
    let beyond: Vec<(f64, f64)> = data
        .followed
        .iter()
        .filter(|slice| slice.axial_forcing > start)
        .map(|slice| (width(&slice.linear), width(&slice.semielliptical)))
        .collect();
    let (_, widest_linear) = extent(beyond.iter().map(|pair| pair.0));
    let (_, widest) = extent(beyond.iter().map(|pair| pair.1));
    Claim::printed_statement(
        "section4.angular_forcing_steadies",
        !beyond.is_empty() && beyond.iter().all(|(linear, semielliptical)| linear < semielliptical),
        format!(
            "the angular speeds at one Γ extend over at most {widest_linear:.3} ωΦ in (c) and {widest:.3} ωΦ in (d), and \
             over less in (c) at each of {} values of Γ",
            beyond.len()
        ),
    )
}

/// The slices between the first and the third doubling.
fn between(data: &Fig06Data, low: usize, high: usize) -> Vec<&Slice> {
    let at = |index: usize| data.doublings.get(index).copied().unwrap_or(f64::NAN);
    data.followed
        .iter()
        .filter(|slice| slice.axial_forcing > at(low) && slice.axial_forcing < at(high))
        .collect()
}

fn mean_speeds(data: &Fig06Data) -> Vec<Claim> {
    let period_two = between(data, 0, 1);
    let period_four = between(data, 1, 2);
    let trend = |of: fn(&Slice) -> f64, sign: f64| {
        let steps = period_two.windows(2).map(|pair| sign * (of(pair[1]) - of(pair[0])));
        let against = steps.clone().filter(|step| *step < 0.0).count();
        let turned = period_four
            .first()
            .zip(period_four.last())
            .is_some_and(|(first, last)| sign * (of(last) - of(first)) < 0.0);
        let value = |slice: Option<&&Slice>| slice.map_or(f64::NAN, |slice| of(slice));
        let evidence = format!(
            "mean speed/(ωΦ) {:.4} just above Γ_1, {:.4} just below Γ_2, {:.4} just below Γ_3; {against} of {} steps \
             between Γ_1 and Γ_2 go the other way",
            value(period_two.first()),
            value(period_two.last()),
            value(period_four.last()),
            period_two.len().saturating_sub(1),
        );
        (against == 0 && !period_two.is_empty(), turned, evidence)
    };
    let (rises, rise_ends, rise) = trend(|slice| slice.linear_mean, 1.0);
    let (falls, fall_ends, fall) = trend(|slice| slice.semielliptical_mean, -1.0);
    let mut claims = vec![
        Claim::printed_statement("section4.linear_rises_in_period_two", rises, rise.as_str()),
        Claim::printed_statement("section4.linear_turns_at_period_four", rise_ends, rise),
        Claim::printed_statement("section4.semielliptical_falls_in_period_two", falls, fall.as_str()),
        Claim::printed_statement("section4.semielliptical_turns_at_period_four", fall_ends, fall)
            .note("where it does not turn it has a kink there: a falling mean falls on, more slowly"),
    ];
    claims.push(three_branches(&period_four));
    claims
}

/// Angular speeds closer than this share of ωΦ look like one branch.
const ONE_BRANCH: f64 = 0.01;

/// Two of the four branches of (d) cross or touch.
fn three_branches(period_four: &[&Slice]) -> Claim {
    let closest = |slice: &Slice| {
        let mut speeds = slice.semielliptical.clone();
        speeds.sort_by(f64::total_cmp);
        speeds.windows(2).map(|pair| pair[1] - pair[0]).fold(f64::INFINITY, f64::min)
    };
    let four: Vec<(f64, f64)> = period_four
        .iter()
        .filter(|slice| slice.period == Some(4))
        .map(|slice| (slice.axial_forcing, closest(slice)))
        .collect();
    let alike = four.iter().filter(|(_, gap)| *gap < ONE_BRANCH).count();
    let nearest = four.iter().min_by(|a, b| a.1.total_cmp(&b.1));
    let evidence = match nearest {
        Some((forcing, gap)) => format!(
            "two of the four speeds lie within {ONE_BRANCH} ωΦ of each other at {alike} of {} values of Γ, closest ({gap:.4}) \
             at Γ = {forcing:.4}: branches cross in the projection",
            four.len(),
        ),
        None => "no value of Γ in the period-4 region".to_owned(),
    };
    Claim::printed_statement("section4.three_branches", alike > 0, evidence)
}
