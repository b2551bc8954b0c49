//! What the paper says about Fig. 6.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use bouncing_disk::core::elementary::{acos, cos, sin};
use bouncing_disk::core::{PAPER_SHORT_FLIGHT, PAPER_SHORT_FLIGHTS, PAPER_SMALLEST_SPEED};

use super::data::Fig06Data;
use super::{regimes, rotation};
use crate::claim::Claim;
use crate::ledger;

pub(super) const ID: &str = "fig06";
/// The doublings whose Γ is printed.
const PRINTED_DOUBLINGS: usize = 5;
/// The doublings whose ratio of distances is printed.
const PRINTED_RATIOS: std::ops::RangeInclusive<usize> = 2..=4;
/// The Feigenbaum constant.
const FEIGENBAUM: f64 = 4.669_201_609_102_99;

pub(super) fn caption(data: &Fig06Data) -> String {
    format!(
        "Bifurcation diagrams (ε = {}): the attractor followed in Γ from its period-1 orbit at Γ = {} (dark gray) and \
         the chattering orbit of a disk from rest (light gray). (a) Phase of impact; (b) relative axial impact speed; \
         (c), (d) angular speed of the disk just before impact for (θ, Γ_T) = ({}, {}) and ({}, {}). Dotted lines \
         mark the panels of Fig. 7. {} values of Γ, {} impacts each after a transient of {}; chattering ends by the \
         paper's cut. The followed attractor is lost at Γ = {:.5}. At {} values of Γ a disk from rest does not \
         come to rest again but ends on another attractor; nothing is drawn in light gray there.",
        data.restitution,
        data.followed_from,
        data.linear.phase_lag_rad,
        data.linear.angular_forcing,
        lag(data),
        data.semielliptical.angular_forcing,
        data.axial_forcing_values,
        data.examined_impacts,
        data.transient_impacts,
        data.merging.axial_forcing(),
        data.not_chattering.len(),
    )
}

/// θ of (d).
fn lag(data: &Fig06Data) -> String {
    format!("{:.2}π", data.semielliptical.phase_lag_rad / PI).replace('-', "−")
}

pub(super) fn parameters(data: &Fig06Data) -> Vec<(String, String)> {
    let pair = |name: &str, value: String| (name.to_owned(), value);
    vec![
        pair("restitution ε", data.restitution.to_string()),
        pair("axial forcing Γ", format!("{} to {}", data.axial_forcing_range.0, data.axial_forcing_range.1)),
        pair("values of Γ", data.axial_forcing_values.to_string()),
        pair("transient", format!("{} impacts", data.transient_impacts)),
        pair("examined", format!("{} impacts", data.examined_impacts)),
        pair("(c) θ, Γ_T", format!("{}, {}", data.linear.phase_lag_rad, data.linear.angular_forcing)),
        pair("(d) θ, Γ_T", format!("{}, {}", lag(data), data.semielliptical.angular_forcing)),
        pair(
            "chattering",
            format!(
                "cut at |w_A Γ/(ωA)| < {PAPER_SMALLEST_SPEED:e} or after {PAPER_SHORT_FLIGHTS} flights shorter than \
                 {PAPER_SHORT_FLIGHT:e} of a period"
            ),
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
    claims.extend(rotation::claims(data));
    claims.extend(regimes::claims(data));
    claims
}

fn doublings(data: &Fig06Data) -> Vec<Claim> {
    let mut claims = Vec::new();
    for n in 1..=PRINTED_DOUBLINGS {
        let value = data.doublings.get(n - 1).copied().unwrap_or(f64::NAN);
        let mut claim = Claim::printed(&format!("section4.doubling_{n}"), value);
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
    let rounded: Vec<f64> = (1..=PRINTED_DOUBLINGS)
        .filter_map(|n| ledger::number(&format!("section4.doubling_{n}"), 0).ok())
        .map(|printed| printed.value)
        .collect();
    for n in PRINTED_RATIOS {
        let value = ratio(data.doublings.get(n - 2..).unwrap_or_default());
        claims.push(Claim::printed(&format!("section4.doubling_ratio_{n}"), value).note(format!(
            "the printed number is {:.3}, the ratio of the printed, rounded Γ_n; the doubling points to full \
                 precision are {}",
            ratio(rounded.get(n - 2..).unwrap_or_default()),
            data.doublings.iter().map(|value| format!("{value:.10}")).collect::<Vec<_>>().join(", "),
        )));
    }
    let ratios: Vec<f64> = data.doublings.windows(3).map(ratio).collect();
    let last = ratios.last().copied().unwrap_or(f64::NAN);
    claims.push(Claim::printed_statement(
        "section4.ratios_approach_feigenbaum",
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
    let restitution = data.restitution;
    let at_threshold = (1.0 - restitution) / ((1.0 + restitution) * data.period_one_threshold);
    let reached = cos(phase + data.semielliptical.phase_lag_rad);
    vec![
        Claim::printed("section4.period_one_begins", data.period_one_threshold)
            .note("(1 − ε)/(1 + ε) = 1/3 in closed form, printed as 1/3 and as 0.333"),
        Claim::reading(ID, "section4.doubling_1", "upper end of the period-1 window", first),
        Claim::printed("section4.impact_phase_at_doubling", phase / TAU),
        Claim::printed("section4.impact_phase_at_threshold", acos(at_threshold.min(1.0)) / TAU)
            .note("cos τ_imp = (1 − ε)/((1 + ε)Γ) = 1 there"),
        Claim::printed_statement(
            "section4.period_one_attracts",
            data.multiplier_where_followed_from < 1.0,
            format!(
                "its Floquet multipliers have modulus {:.4} at most",
                data.multiplier_where_followed_from
            ),
        ),
        Claim::printed("section4.semielliptical_phase_lag", -phase)
            .note(format!("τ_imp = {:.5}π at the first doubling", phase / PI)),
        Claim::printed("section4.speed_at_doubling", cos(phase))
            .note("the tolerance is that of the two digits of 0.26"),
        Claim::printed_statement(
            "section4.semielliptical_reaches_maximum",
            1.0 - reached < 1.0e-4,
            format!("cos(τ_imp + θ) = {reached:.7} with τ_imp = {:.5}π", phase / PI),
        ),
        Claim::printed_statement(
            "section4.elliptical_not_optimal",
            sin(phase) < 1.0,
            format!(
                "period 1 turns at ωΦ sin τ_imp with θ = −π/2: from 0 at Γ = 1/3 to {:.3} ωΦ at the first doubling",
                sin(phase)
            ),
        ),
        Claim::printed_statement(
            "section4.impact_phase_not_quarter",
            phase < FRAC_PI_2,
            format!("in period 1 τ_imp runs from 0 to {:.4}π", phase / PI),
        ),
    ]
}
