//! The statements of the paper about Fig. 6.

use std::f64::consts::TAU;

use super::data::Fig06Data;
use super::{regimes, rotation};
use crate::claims::{self as claim, Claim, catalogue};

/// The doublings whose Γ is printed.
const PRINTED_DOUBLINGS: usize = 5;
/// The doublings whose ratio of distances is printed.
const PRINTED_RATIOS: std::ops::RangeInclusive<usize> = 2..=4;
/// Why the doublings and the ratios of their distances differ.
const READ_OFF: &str = "misprinted doublings, perhaps read off a diagram";
/// The Feigenbaum constant.
const FEIGENBAUM: f64 = 4.669_201_609_102_99;

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
    claims.extend(introduction(data));
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
        claims.push(claim.cause(READ_OFF));
    }
    let rounded: Vec<f64> = (1..=PRINTED_DOUBLINGS)
        .filter_map(|n| catalogue::number(&format!("section4.doubling_{n}"), 0).ok())
        .map(|printed| printed.value)
        .collect();
    for n in PRINTED_RATIOS {
        let value = ratio(data.doublings.get(n - 2..).unwrap_or_default());
        claims.push(Claim::printed(&format!("section4.doubling_ratio_{n}"), value).note(format!(
            "the printed number is {:.3}, the ratio of the printed, rounded Γ_n; the doubling points to full \
                 precision are {}",
            ratio(rounded.get(n - 2..).unwrap_or_default()),
            data.doublings.iter().map(|value| format!("{value:.10}")).collect::<Vec<_>>().join(", "),
        ))
        .cause(READ_OFF));
    }
    let ratios: Vec<f64> = data.doublings.windows(3).map(ratio).collect();
    let last = ratios.last().copied().unwrap_or(f64::NAN);
    claims.push(Claim::printed_statement(
        "section4.ratios_approach_feigenbaum",
        claim::all(ratios.windows(2), |pair| (pair[1] - FEIGENBAUM).abs() < (pair[0] - FEIGENBAUM).abs()),
        format!(
            "each ratio is nearer than the one before: {}; the last differs from 4.66920 by {:+.4}",
            ratios.iter().map(|ratio| format!("{ratio:.4}")).collect::<Vec<_>>().join(", "),
            last - FEIGENBAUM,
        ),
    ));
    claims
}

/// A number that is printed twice is compared with itself, and its first print with the data.
fn printed(key: &str) -> f64 {
    catalogue::number(key, 0).map_or(f64::NAN, |printed| printed.value)
}

fn period_one(data: &Fig06Data) -> Vec<Claim> {
    let phase = data.phase_at_first_doubling_rad;
    let printed_phase = TAU * printed("section4.impact_phase_at_doubling");
    vec![
        Claim::printed("section4.period_one_begins", data.period_one_threshold).note(format!(
            "the lowest Γ at which Newton's iteration finds the orbit; in closed form (1 − ε)/(1 + ε) = {:.9}. Printed as 1/3 and as 0.333",
            (1.0 - data.restitution) / (1.0 + data.restitution)
        )),
        Claim::printed("section4.impact_phase_at_doubling", phase / TAU),
        Claim::printed_statement(
            "section4.period_one_attracts",
            data.multiplier_where_followed_from < 1.0,
            format!(
                "its Floquet multipliers have modulus {:.4} at most",
                data.multiplier_where_followed_from
            ),
        ),
        Claim::printed("section4.semielliptical_phase_lag", -printed_phase)
            .note("printed against printed: −2π times the 0.130 printed as τ_imp/2π"),
    ]
}

/// The statements of Sec. I about the vertical and the rotary motion.
fn introduction(data: &Fig06Data) -> Vec<Claim> {
    let motions = &data.motions;
    let (_, fullest) = rotation::extent(motions.iter().map(|motion| motion.highest / motion.height_bound));
    let (_, elastic) = rotation::extent(motions.iter().map(|motion| motion.restitution));
    let (_, farthest) = rotation::extent(motions.iter().map(|motion| motion.turned_in_second_half.abs()));
    vec![
        Claim::printed_statement(
            "section1.displacement_bounded",
            claim::all(motions, |motion| motion.highest <= motion.height_bound),
            format!(
                "{} motions from rest at the Γ of Fig. 7 and restitutions {} to {elastic}: at most {fullest:.2} of the height that energy allows for ever at the restitution",
                motions.len(),
                data.restitution
            ),
        ),
        Claim::printed_statement(
            "section1.unbounded_rotation",
            claim::any(motions, |motion| {
                let (first, second) = (motion.turned_in_first_half, motion.turned_in_second_half);
                // As far again in the second half, and far more than the platform's own 2Φ.
                first * second > 0.0 && second.abs() > 0.5 * first.abs() && second.abs() > 100.0
            }),
            format!(
                "with θ and Γ_T of (d) up to {farthest:.0} Φ in the second half of the impacts, and as far in the first"
            ),
        ),
    ]
}
