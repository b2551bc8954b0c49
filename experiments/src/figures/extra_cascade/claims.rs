//! What the cascade shows, and its check.

use super::data::{Cascade, Constants, Doubling, ExtraCascadeData};
use crate::claim::Claim;

const ID: &str = "extra-cascade";
const PLACE: &str = "this work";

/// Γ_1 in double-doubles against its closed form.
const CLOSED_FORM: f64 = 1e-28;

/// What doubles hold of Γ_n.
const DOUBLES: f64 = 1e-13;

pub(super) fn claims(data: &ExtraCascadeData) -> Vec<Claim> {
    let mut claims = Vec::new();
    for cascade in &data.cascades {
        let Some(last) = cascade.estimates.last() else { continue };
        let (extended, own) = (&last.extended, &last.in_doubles);
        let of = |name: &str| format!("{name}, ε = {}, from {} doublings", cascade.restitution, last.number);
        let note = "expected: the published constant; the tolerance is the stated error";
        claims.push(
            Claim::expected(
                ID,
                PLACE,
                of("Feigenbaum's δ"),
                "",
                (data.published_delta, extended.delta_error),
                extended.delta,
            )
            .note(note),
        );
        claims.push(
            Claim::expected(
                ID,
                PLACE,
                of("Feigenbaum's α"),
                "",
                (data.published_alpha, extended.alpha_error),
                extended.alpha,
            )
            .note(note),
        );
        claims.push(
            Claim::expected(
                ID,
                PLACE,
                of("Feigenbaum's δ in doubles"),
                "",
                (data.published_delta, own.delta_error),
                own.delta,
            )
            .note(format!(
                "{note}, {} times that of double-doubles",
                times(own.delta_error, extended.delta_error)
            )),
        );
    }
    let all = |of: fn(&Doubling) -> f64| {
        data.cascades.iter().flat_map(|cascade| &cascade.doublings).map(of).fold(0.0_f64, f64::max)
    };
    let closed =
        data.cascades.iter().map(|cascade| cascade.closed_form_deviation.abs()).fold(0.0_f64, f64::max);
    claims.push(
        Claim::expected(
            ID,
            PLACE,
            "Γ_1 in double-doubles, less its closed form: the largest deviation",
            "",
            (0.0, CLOSED_FORM),
            closed,
        )
        .note("the search uses the closed form in doubles as its start alone"),
    );
    claims.push(
        Claim::expected(
            ID,
            PLACE,
            "Γ_n in doubles, less those in double-doubles: the largest deviation",
            "",
            (0.0, DOUBLES),
            all(|doubling| doubling.true_error_in_doubles),
        )
        .note(format!(
            "the multiplier that doubles leave there is off −1 by up to {:.0e}",
            all(|doubling| doubling.multiplier_error_in_doubles)
        )),
    );
    let within = |doubling: &Doubling| doubling.true_error_in_doubles <= doubling.forcing_error_in_doubles;
    claims.push(Claim::statement(
        ID,
        PLACE,
        "every Γ_n in doubles is within the error that is stated for it",
        (!data.cascades.is_empty())
            .then(|| data.cascades.iter().flat_map(|cascade| &cascade.doublings).all(within)),
        "against double-doubles",
    ));
    let delta: fn(&Constants) -> (f64, f64) = |constants| (constants.delta, constants.delta_error);
    let alpha: fn(&Constants) -> (f64, f64) = |constants| (constants.alpha, constants.alpha_error);
    for (name, of) in [("δ", delta), ("α", alpha)] {
        let (holding, tried) = confirmed(&data.cascades, of);
        claims.push(Claim::statement(
            ID,
            PLACE,
            format!("every stated error of {name} holds the next value"),
            (tried > 0).then_some(holding == tried),
            format!("{holding} of {tried}"),
        ));
    }
    claims
}

/// How many times one number is the other, in words.
fn times(large: f64, small: f64) -> String {
    format!("{:.0e}", large / small)
}

/// How many estimates, of those with one behind them, have it within their error.
fn confirmed(cascades: &[Cascade], of: fn(&Constants) -> (f64, f64)) -> (usize, usize) {
    let pairs = cascades.iter().flat_map(|cascade| cascade.estimates.windows(2));
    let judged: Vec<bool> = pairs
        .map(|pair| {
            let ((value, error), (next, _)) = (of(&pair[0].extended), of(&pair[1].extended));
            (next - value).abs() <= error
        })
        .collect();
    (judged.iter().filter(|held| **held).count(), judged.len())
}
