//! What the paper says about Fig. 6.

use std::f64::consts::{PI, TAU};

use bouncing_disk::core::elementary::cos;

use super::data::{Fig06Data, Slice};
use crate::claim::Claim;

const ID: &str = "fig06";
const CAPTION: &str = "Fig. 6 caption";
const SECTION: &str = "Sec. IV A";

/// Γ₁ to Γ₅ as printed.
const PRINTED_DOUBLINGS: [&str; 5] = ["0.486", "0.531", "0.5402", "0.5421", "0.5425"];
/// The ratios of their distances as printed.
const PRINTED_RATIOS: [&str; 3] = ["4.891", "4.842", "4.750"];
/// The Feigenbaum constant.
const FEIGENBAUM: f64 = 4.669_201_609_102_99;

pub(super) fn caption(data: &Fig06Data) -> String {
    format!(
        "Bifurcation diagrams (ε = {}): the attractor followed in Γ from its period-1 orbit at Γ = {} (dark gray) and \
         the chattering orbit of a disk from rest (light gray). (a) Phase of impact; (b) relative axial impact speed; \
         (c), (d) angular speed of the disk just before impact for (θ, Γ_T) = (0, {}) and (−0.26π, {}). Dotted lines \
         mark the panels of Fig. 7. {} values of Γ, {} impacts each after a transient of {}; chattering ends by the \
         paper's cut. The followed attractor is lost at Γ = {:.5}. At {} values of Γ a disk from rest does not \
         come to rest again but ends on another attractor; nothing is drawn in light gray there.",
        data.restitution,
        data.followed_from,
        data.linear.angular_forcing,
        data.semielliptical.angular_forcing,
        data.axial_forcing_values,
        data.examined_impacts,
        data.transient_impacts,
        data.merging.axial_forcing(),
        data.not_chattering.len(),
    )
}

pub(super) fn parameters(data: &Fig06Data) -> Vec<(String, String)> {
    let pair = |name: &str, value: String| (name.to_owned(), value);
    vec![
        pair("restitution ε", data.restitution.to_string()),
        pair("axial forcing Γ", format!("{} to {}", data.axial_forcing_range.0, data.axial_forcing_range.1)),
        pair("values of Γ", data.axial_forcing_values.to_string()),
        pair("transient", format!("{} impacts", data.transient_impacts)),
        pair("examined", format!("{} impacts", data.examined_impacts)),
        pair("(c) θ, Γ_T", format!("0, {}", data.linear.angular_forcing)),
        pair("(d) θ, Γ_T", format!("−0.26π, {}", data.semielliptical.angular_forcing)),
        pair(
            "chattering",
            "cut at |w_A Γ/(ωA)| < 10⁻⁶ or after 20 flights shorter than 10⁻⁴ of a period".to_owned(),
        ),
    ]
}

/// Distance ratio (Γ_n - Γ_{n-1})/(Γ_{n+1} - Γ_n) for the middle one of three.
fn ratio(doublings: &[f64]) -> f64 {
    match *doublings {
        [low, middle, high, ..] => (middle - low) / (high - middle),
        _ => f64::NAN,
    }
}

pub(super) fn claims(data: &Fig06Data) -> Vec<Claim> {
    let mut claims = doublings(data);
    claims.extend(period_one(data));
    claims.extend(mean_speeds(data));
    claims.extend(chattering(data));
    claims
}

fn doublings(data: &Fig06Data) -> Vec<Claim> {
    let mut claims = Vec::new();
    for (n, printed) in (1..).zip(PRINTED_DOUBLINGS) {
        let value = data.doublings.get(n - 1).copied().unwrap_or(f64::NAN);
        let mut claim = Claim::number(ID, CAPTION, format!("Γ_{n}, period doubling"), "", printed, value);
        claim = match n {
            3 => claim.note(
                "0.54010 rounds and truncates to 0.5401: the printed 0.5402 is one unit high, as a value read where \
                 the doubled branches can first be told apart",
            ),
            5 => claim.note(
                "0.54258 rounds to 0.5426; 0.5425 is it truncated, but truncation does not give the printed Γ_2 = \
                 0.531 (0.53066) or Γ_3 = 0.5402 (0.54010), so no one rule gives all five",
            ),
            _ => claim,
        };
        claims.push(claim);
    }
    for (n, printed) in (2..).zip(PRINTED_RATIOS) {
        let value = ratio(data.doublings.get(n - 2..).unwrap_or_default());
        let rounded: Vec<f64> =
            PRINTED_DOUBLINGS[n - 2..].iter().filter_map(|text| text.parse().ok()).collect();
        claims.push(
            Claim::number(
                ID,
                CAPTION,
                format!("(Γ_{n} − Γ_{})/(Γ_{} − Γ_{n})", n - 1, n + 1),
                "",
                printed,
                value,
            )
            .note(format!(
                "the printed number is {:.3}, the ratio of the printed, rounded Γ_n; the doubling points to full \
                 precision are {}",
                ratio(&rounded),
                data.doublings.iter().map(|value| format!("{value:.10}")).collect::<Vec<_>>().join(", "),
            )),
        );
    }
    let ratios: Vec<f64> = data.doublings.windows(3).map(ratio).collect();
    let last = ratios.last().copied().unwrap_or(f64::NAN);
    claims.push(Claim::statement(
        ID,
        CAPTION,
        "the ratios approach the Feigenbaum constant 4.669",
        (last - FEIGENBAUM).abs() < 0.01,
        format!(
            "ratios {}; the last differs from 4.66920 by {:+.4}",
            ratios.iter().map(|ratio| format!("{ratio:.4}")).collect::<Vec<_>>().join(", "),
            last - FEIGENBAUM,
        ),
    ));
    claims
}

fn period_one(data: &Fig06Data) -> Vec<Claim> {
    let phase = data.phase_at_first_doubling_rad;
    let first = data.doublings.first().copied().unwrap_or(f64::NAN);
    vec![
        Claim::number(
            ID,
            SECTION,
            "lower end of the period-1 window",
            "",
            "0.333",
            data.period_one_threshold,
        )
        .note("(1 − ε)/(1 + ε) = 1/3 in closed form, printed as 1/3 and as 0.333"),
        Claim::number(ID, SECTION, "upper end of the period-1 window", "", "0.486", first),
        Claim::number(ID, SECTION, "τ_imp/2π of period 1 at the first bifurcation", "", "0.130", phase / TAU),
        Claim::number(ID, SECTION, "τ_imp/2π of period 1 at Γ = 1/3", "", "0", 0.0)
            .note("cos τ_imp = (1 − ε)/((1 + ε)Γ) = 1 there"),
        Claim::statement(
            ID,
            SECTION,
            "the period-1 orbit exists and attracts at Γ = 0.335, where following starts",
            data.multiplier_where_followed_from < 1.0,
            format!(
                "its Floquet multipliers have modulus {:.4} at most",
                data.multiplier_where_followed_from
            ),
        ),
        Claim::number(ID, SECTION, "τ_imp of period 1 at Γ = 0.486", "rad", "0.26π", phase),
        Claim::number(
            ID,
            SECTION,
            "steady speed/(ωΦ) of period 1 at Γ = 0.486 for θ = 0",
            "",
            "0.685",
            cos(phase),
        )
        .within((cos(0.255 * PI) - cos(0.265 * PI)) * 0.5)
        .note("printed as cos(0.26π); the tolerance is that of the two digits of 0.26"),
        Claim::statement(
            ID,
            SECTION,
            "θ = −0.26π reaches the maximum speed ωΦ at Γ = 0.486",
            1.0 - cos(phase - 0.26 * PI) < 1.0e-4,
            format!("cos(τ_imp + θ) = {:.7} with τ_imp = {:.5}π", cos(phase - 0.26 * PI), phase / PI),
        ),
    ]
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
        Claim::statement(
            ID,
            SECTION,
            "(c): the mean speed rises in the period-2 region",
            rises,
            rise.as_str(),
        ),
        Claim::statement(ID, SECTION, "(c): it turns at the period-4 bifurcation", rise_ends, rise),
        Claim::statement(
            ID,
            SECTION,
            "(d): the mean speed falls in the period-2 region",
            falls,
            fall.as_str(),
        ),
        Claim::statement(ID, SECTION, "(d): it turns at the period-4 bifurcation", fall_ends, fall)
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
    Claim::statement(
        ID,
        SECTION,
        "(d) may appear to have three branches in what is a period-4 region",
        alike > 0,
        evidence,
    )
}

fn chattering(data: &Fig06Data) -> Vec<Claim> {
    let merging = &data.merging;
    let single = &data.single_tosses;
    let policies = &data.policies;
    let beyond: Vec<f64> =
        data.not_chattering.iter().copied().filter(|forcing| *forcing > merging.axial_forcing()).collect();
    let cycles = || data.chattering.iter().filter_map(|slice| slice.period);
    let (shortest, longest) = (cycles().min().unwrap_or_default(), cycles().max().unwrap_or_default());
    let periods = single.periods_beyond.map_or("no".to_owned(), |(low, high)| format!("{low} to {high}"));
    vec![
        Claim::number(
            ID,
            "Sec. IV B",
            "Γ above which the attractors merge",
            "",
            "0.561",
            merging.axial_forcing(),
        )
        .note(format!(
            "bisection on the survival of {} orbits of the followed attractor for {} impacts: {:.7} survived, {:.7} lost; \
             with a tenth of the impacts the crisis comes out at {:.7}; uncertainty {:.0e}. Bisection can only err \
             upwards, by the time an orbit takes to find a new gap",
            merging.starts,
            merging.impacts,
            merging.survived,
            merging.lost,
            0.5 * (merging.survived_in_a_tenth + merging.lost_in_a_tenth),
            merging.uncertainty(),
        )),
        Claim::statement(
            ID,
            SECTION,
            "for Γ < 0.52 the chattering orbit follows the pattern of single tosses",
            single.first_other >= 0.52,
            format!(
                "the disk comes to rest once in every period up to Γ = {:.6} only; from there to 0.52 it does so at \
                 {:.0} % of the Γ, and a cycle takes {periods} periods where it comes to rest at all",
                single.last,
                100.0 * single.share_beyond,
            ),
        ),
        Claim::statement(
            ID,
            SECTION,
            "chattering orbits are eventually periodic",
            data.chattering.iter().all(|slice| slice.period.is_some()),
            format!(
                "at {} values of Γ the disk comes to rest again, after {shortest} to {longest} impacts. After every rest it \
                 leaves in the same vertical state, so the vertical motion repeats; a long cycle depends on its rounding. At \
                 {} further values a disk from rest does not come to rest again within 20000 impacts: it ends on an attractor \
                 that bounces",
                data.chattering.len(),
                data.not_chattering.len(),
            ),
        ),
        Claim::statement(
            ID,
            "Sec. IV B",
            "beyond the merging a disk from rest chatters at every Γ of the diagram",
            beyond.is_empty(),
            match (beyond.first(), beyond.last()) {
                (Some(first), Some(last)) => format!(
                    "at {} values of Γ from {first:.4} to {last:.4} it ends on another attractor; the basin of the chattering \
                     orbit does not fill the phase space there",
                    beyond.len(),
                ),
                _ => "holds".to_owned(),
            },
        ),
        Claim::statement(
            ID,
            SECTION,
            "cutting the chattering short does not change the chattering orbits",
            policies.different_cycles == 0,
            format!(
                "at {} of {} values of Γ the cycle has another length when the infinite sequence is summed{}; where the \
                 rotation repeats from cycle to cycle under both the mean speeds differ by at most {:.1e} ωΦ in (c) ({} values) and \
                 {:.1e} ωΦ in (d) ({} values). A statement of this work, not of the paper",
                policies.different_cycles,
                policies.compared,
                policies.first_different.map_or(String::new(), |forcing| format!(" (first at Γ = {forcing:.4})")),
                policies.largest_difference_linear,
                policies.settled_linear,
                policies.largest_difference_semielliptical,
                policies.settled_semielliptical,
            ),
        ),
    ]
}
