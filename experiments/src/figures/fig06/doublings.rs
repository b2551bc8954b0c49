//! Where the period-1 orbit begins and where the periods double.

use std::f64::consts::TAU;

use bouncing_disk::core::numerics::roots::bracket_of_width;
use bouncing_disk::core::orbits::{Multipliers, doubling_cascade};
use bouncing_disk::core::{ImpactState, Unobserved};

use super::diagram::{Diagram, Inputs};
use crate::claims::{Claim, all, catalogue};
use crate::experiment::{ExperimentError, Paper};
use crate::figures::shared::map;

/// Width at which the bisection on the threshold ends. The orbit is found next to its birth as far as
/// Newton's iteration goes there; its phase moves with the square root of the distance.
const BRACKET: f64 = 1.0e-9;
/// Doublings that are computed.
const DOUBLINGS: usize = 7;
/// The doublings that are printed.
const PRINTED_DOUBLINGS: usize = 5;
/// The doublings whose ratio of distances is printed.
const PRINTED_RATIOS: std::ops::RangeInclusive<usize> = 2..=4;
/// Why the doublings and the ratios of their distances differ.
const READ_OFF: &str = "inaccurate doubling points, perhaps read off a diagram";
/// The Feigenbaum constant.
const FEIGENBAUM: f64 = 4.669_201_609_102_99;

/// The Γ of the doublings, as far as they can be followed.
pub(super) fn cascade(restitution: f64) -> Vec<f64> {
    let found = doubling_cascade(restitution, DOUBLINGS, &Unobserved).map(|cascade| cascade.doublings);
    found.unwrap_or_default().into_iter().map(|doubling| doubling.axial_forcing).collect()
}

/// (Γ_n − Γ_{n−1})/(Γ_{n+1} − Γ_n) for the middle one of three.
fn ratio(doublings: &[f64]) -> f64 {
    match *doublings {
        [low, middle, high, ..] => (middle - low) / (high - middle),
        _ => f64::NAN,
    }
}

/// The printed doublings.
pub(super) fn claims(fig: &mut Paper<'_>, doublings: &[f64]) -> Result<(), ExperimentError> {
    let printed = (1..=PRINTED_DOUBLINGS)
        .map(|n| Ok(catalogue::number(&format!("section4.doubling_{n}"), 0)?.value))
        .collect::<Result<Vec<f64>, ExperimentError>>()?;
    for n in 1..=PRINTED_DOUBLINGS {
        let value = doublings.get(n - 1).copied().unwrap_or(f64::NAN);
        let claim = Claim::printed(&format!("section4.doubling_{n}"), value).cause(READ_OFF);
        fig.claim(match n {
            3 => claim.note("0.54010 rounds and truncates to 0.5401: the printed 0.5402 is one unit high"),
            5 => claim.note(
                "0.54258 rounds to 0.5426 and truncates to 0.5425, but truncation does not give the printed Γ_2 and Γ_3",
            ),
            _ => claim,
        });
    }
    for n in PRINTED_RATIOS {
        let value = ratio(doublings.get(n - 2..).unwrap_or_default());
        fig.claim(
            Claim::printed(&format!("section4.doubling_ratio_{n}"), value)
                .note(format!(
                    "{:.3} is the ratio of the rounded, printed Γ_n",
                    ratio(printed.get(n - 2..).unwrap_or_default())
                ))
                .cause(READ_OFF),
        );
    }
    let off: Vec<f64> = doublings.windows(3).map(|three| ratio(three) - FEIGENBAUM).collect();
    let words: Vec<String> = off.iter().map(|off| format!("{off:+.4}")).collect();
    fig.claim(Claim::printed_statement(
        "section4.ratios_approach_feigenbaum",
        all(off.windows(2), |pair| pair[1].abs() < pair[0].abs()),
        format!("the ratios differ from 4.66920 by {}", words.join(", ")),
    ));
    fig.record("doublings", &doublings)
}

/// The lowest Γ at which Newton's iteration finds the orbit `first` of one impact in each period.
fn threshold(inputs: Inputs, first: ImpactState) -> Result<f64, ExperimentError> {
    let mut state = first;
    let below = 0.9 * in_closed_form(inputs.restitution);
    let (_, found) = bracket_of_width(below, inputs.followed_from, BRACKET, |forcing| {
        // The same orbit, not another one: one impact in one period of the platform.
        let refined = map(forcing, inputs.restitution)?.refine(&[state]);
        let orbit = refined.ok().filter(|orbit| orbit.platform_periods == 1);
        if let Some(orbit) = &orbit {
            state = orbit.states[0];
        }
        Ok::<_, ExperimentError>(orbit.is_none())
    })?;
    Ok(found)
}

/// Γ at the birth of the period-1 orbit.
pub(super) fn in_closed_form(restitution: f64) -> f64 {
    (1.0 - restitution) / (1.0 + restitution)
}

/// The spectral radius of the period-1 orbit.
pub(super) fn multiplier(axial_forcing: f64, restitution: f64) -> Result<Option<f64>, ExperimentError> {
    let map = map(axial_forcing, restitution)?;
    let orbit = map.period_one(1).and_then(|state| map.refine(&[state]).ok());
    Ok(orbit.map(|orbit| Multipliers::of(orbit.monodromy).spectral_radius()))
}

/// Where the period-1 orbit begins, attracts and doubles its period.
pub(super) fn period_one(
    fig: &mut Paper<'_>,
    diagram: &Diagram,
    doublings: &[f64],
) -> Result<(), ExperimentError> {
    let inputs = diagram.inputs;
    let threshold = diagram.first.map(|first| threshold(inputs, first)).transpose()?;
    fig.record("period_one_threshold", &threshold)?;
    fig.claim(Claim::printed("section4.period_one_begins", threshold.unwrap_or(f64::NAN)).note(format!(
        "found by Newton's iteration; in closed form (1 − ε)/(1 + ε) = {:.9}. Printed as 1/3 and as 0.333",
        in_closed_form(inputs.restitution)
    )));
    let at_doubling = match doublings.first() {
        Some(forcing) => map(*forcing, inputs.restitution)?.period_one(1),
        None => None,
    };
    let phase = at_doubling.map(|state| state.phase().angle());
    fig.record("phase_at_first_doubling_rad", &phase)?;
    fig.claim(Claim::printed(
        "section4.impact_phase_at_doubling",
        phase.map_or(f64::NAN, |phase| phase / TAU),
    ));
    let multiplier_there = multiplier(inputs.followed_from, inputs.restitution)?;
    fig.record("multiplier_where_followed_from", &multiplier_there)?;
    fig.claim(Claim::printed_statement(
        "section4.period_one_attracts",
        multiplier_there.map(|radius| radius < 1.0),
        format!("its Floquet multipliers have modulus {:.4} at most", multiplier_there.unwrap_or(f64::NAN)),
    ));
    let printed = catalogue::number("section4.impact_phase_at_doubling", 0)?.value;
    fig.claim(
        Claim::printed("section4.semielliptical_phase_lag", -TAU * printed)
            .note("printed against printed: −2π times the 0.130 printed as τ_imp/2π"),
    );
    Ok(())
}
