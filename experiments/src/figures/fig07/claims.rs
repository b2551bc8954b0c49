//! The statements of the paper about Fig. 7.

use super::data::{Fig07Data, Panel, TopShares};
use super::draw::forcing_text;
use crate::claims::{self as claim, Claim};

const ID: &str = "fig07";
/// What was chosen so that both printed fractions come out.
const FITTED: &str = "the window's top speed, 5, was chosen so that both printed fractions come out";
/// Deep within a basin: no other start below this |w_A Γ/(ωA)|, a fiftieth of the window. The results are far
/// from it on either side.
const DEEP: f64 = 0.1;
/// The boundary share of a smooth curve falls as the first power of the cell size; a grid finds 0.97 to 1.02
/// for one.
const SMOOTH_FROM: f64 = 0.9;

/// Fraction, binomial error, and the share of cells at a boundary, in words.
fn accuracy(share: f64, panel: &Panel, cells: usize) -> String {
    let binomial = (share * (1.0 - share)).sqrt() / cells as f64;
    let boundary = panel.boundary_shares.first().map_or(0.0, |(_, share)| *share);
    format!(
        "{:.2} % ± {:.2} % (binomial, {cells} × {cells} cells); {:.1} % of the cells have a neighbour of another kind, half of \
         which bounds the error of the grid",
        100.0 * share,
        100.0 * binomial,
        100.0 * boundary,
    )
}

fn top_text(top: Option<f64>) -> String {
    top.map_or("no window [0, top] up to 8".to_owned(), |top| format!("the window [0, {top:.3}]"))
}

pub(super) fn claims(data: &Fig07Data) -> Vec<Claim> {
    let mut claims = Vec::new();
    if let [a, b, _, d, e] = &data.panels[..] {
        claims.extend(fractions(data, a, b));
        claims.extend(ease(data, a, b));
        claims.extend(shapes(data, [a, b, d, e]));
    }
    claims
}

fn fractions(data: &Fig07Data, a: &Panel, b: &Panel) -> Vec<Claim> {
    let windows = &data.windows;
    let window = format!(
        "the window is not printed: stated for τ_imp/2π in [0, 1], |w_A Γ/(ωA)| in [0, {}]",
        data.window_top,
    );
    vec![
        Claim::printed("section4.share_at_fig7a", 100.0 * a.shares.attractor)
            .fitted(FITTED)
            .note(&window)
            .note(accuracy(a.shares.attractor, a, data.cells))
            .note(format!("{} gives the printed number", top_text(windows.top_for_a))),
        Claim::printed("section4.share_at_fig7b", 100.0 * b.shares.attractor)
            .fitted(FITTED)
            .note(&window)
            .note(accuracy(b.shares.attractor, b, data.cells))
            .note(format!("{} gives the printed number", top_text(windows.top_for_b))),
        Claim::printed_statement(
            "section4.basin_widens",
            claim::all(windows.curve.iter().filter(|point| point.a > 0.0), |point| point.b > point.a),
            format!(
                "at each of {} windows [0, top] up to 8 that hold any of the basin at Γ = {}, panel (f)",
                windows.curve.iter().filter(|point| point.a > 0.0).count(),
                a.axial_forcing
            ),
        ),
    ]
}

/// Shares along the period-1 window.
fn ease(data: &Fig07Data, a: &Panel, b: &Panel) -> Vec<Claim> {
    let at = |top: usize| -> Vec<(f64, TopShares)> {
        let own = data.along_window.iter();
        own.filter_map(|at| Some((at.axial_forcing, *at.shares.get(top)?))).collect()
    };
    let tops = data.along_window.first().map_or(0, |at| at.shares.len());
    // By the top of the window: the Γ with the largest share of the period-1 orbit.
    let best: Vec<f64> = (0..tops)
        .filter_map(|top| {
            at(top).into_iter().max_by(|one, other| one.1.period_one.total_cmp(&other.1.period_one))
        })
        .map(|(forcing, _)| forcing)
        .collect();
    let last = data.along_window.last().map_or(f64::NAN, |at| at.axial_forcing);
    let first = data.along_window.first().map_or(f64::NAN, |at| at.axial_forcing);
    let all: Vec<(f64, TopShares)> = (0..tops).flat_map(at).collect();
    let least =
        all.iter().map(|(_, shares)| shares.chattering - shares.period_one).fold(f64::INFINITY, f64::min);
    vec![
        Claim::printed_statement(
            "section4.semielliptical_is_easiest",
            claim::all(&best, |forcing| *forcing >= last),
            format!(
                "of {} values of Γ from {first} to {last} it is where the period-1 orbit has the largest share of each of {tops} windows",
                data.along_window.len(),
            ),
        ),
        Claim::printed_statement(
            "section4.chattering_is_easier",
            claim::all(
                all.iter()
                    .map(|(_, shares)| (shares.chattering, shares.period_one))
                    .chain([a, b].map(|panel| (panel.shares.chattering, panel.shares.attractor))),
                |(chattering, period_one)| chattering > period_one,
            ),
            format!(
                "at {} values of Γ its share of {tops} windows is larger than that of period 1 by {:.1} % at least",
                data.along_window.len(),
                100.0 * least,
            ),
        ),
    ]
}

/// The basin of the chattering orbit beyond the merging.
fn fills(data: &Fig07Data, e: &Panel) -> Claim {
    let cells = data.cells * data.cells;
    let others: Vec<_> = data.beyond.iter().filter(|at| at.not_at_rest > 0).collect();
    let share = |of: fn(f64, f64) -> f64, start: f64| {
        let shares = others.iter().map(|at| at.not_at_rest as f64 / at.starts as f64);
        100.0 * shares.fold(start, of)
    };
    let counterexamples = match (others.first(), others.last()) {
        (Some(first), Some(last)) => format!(
            "at {} of them, Γ = {:.4} to {:.4}, {:.1} to {:.1} % of the starts never do",
            others.len(),
            first.axial_forcing,
            last.axial_forcing,
            share(f64::min, f64::INFINITY),
            share(f64::max, f64::NEG_INFINITY),
        ),
        _ => "at each of them all starts come to rest".to_owned(),
    };
    Claim::printed_statement(
        "section4.basin_fills_plane",
        (e.shares.chattering - 1.0).abs() < f64::EPSILON,
        format!(
            "in Fig. 7(e), Γ = {}, {:.0} of {cells} cells come to rest within {} impacts. Beyond the merging {} values from {:.3} to {:.3} were tried with {} starts each: {counterexamples}",
            forcing_text(e.axial_forcing),
            e.shares.chattering * cells as f64,
            e.max_impacts,
            data.beyond.len(),
            data.beyond.first().map_or(f64::NAN, |at| at.axial_forcing),
            data.beyond.last().map_or(f64::NAN, |at| at.axial_forcing),
            data.beyond.first().map_or(0, |at| at.starts),
        ),
    )
}

/// Where the further attractor comes from, in words.
fn traced(data: &Fig07Data) -> String {
    data.traced.as_ref().map_or_else(String::new, |of| {
        format!(
            "; it can be followed down to Γ = {:.5}, where it has {} impacts, doubles its period at {:.5}, and up to {:.5}",
            of.appears,
            of.period_where_it_appears.map_or("no period".to_owned(), |period| period.to_string()),
            of.doubles.unwrap_or(f64::NAN),
            of.lost,
        )
    })
}

/// The further attractor at the Γ of panel (b).
fn third_attractor(data: &Fig07Data, b: &Panel) -> Claim {
    let others: Vec<String> = b
        .others
        .iter()
        .map(|other| {
            let impacts: Vec<String> =
                other.impacts.iter().map(|(phase, speed)| format!("({phase:.4}, {speed:.4})")).collect();
            format!(
                "{} impacts in {} periods at (τ_imp/2π, |w_A Γ/(ωA)|) = {}, largest multiplier {:.3}",
                other.impacts.len(),
                other.platform_periods,
                impacts.join(" "),
                other.spectral_radius,
            )
        })
        .collect();
    Claim::statement(
        ID,
        "Fig. 7(b)",
        "at Γ = 0.486 there is an attractor that is neither the chattering orbit nor that of period 1",
        !b.others.is_empty(),
        format!(
            "{}; it holds {:.2} % of the window{}",
            others.join("; "),
            100.0 * b.shares.other,
            traced(data)
        ),
    )
}

fn shapes(data: &Fig07Data, [a, b, d, e]: [&Panel; 4]) -> Vec<Claim> {
    let depth =
        |panel: &Panel| panel.lowest_not_chattering.map_or("all".to_owned(), |low| format!("{low:.3}"));
    let deep = |panel: &Panel| panel.lowest_not_chattering.is_none_or(|low| low > DEEP);
    let rest: Vec<String> = data
        .rest
        .iter()
        .map(|at| format!("{} of {} at Γ = {}", at.come_to_rest, at.starts, forcing_text(at.axial_forcing)))
        .collect();
    let exponents = |panel: &Panel| {
        let exponents: Vec<String> =
            panel.boundary_exponents.iter().map(|exponent| format!("{exponent:.2}")).collect();
        exponents.join(", ")
    };
    vec![
        Claim::printed_statement(
            "section4.rest_chatters",
            claim::all([a, b], deep),
            format!(
                "every start slower than |w_A Γ/(ωA)| = {} chatters in (a), {} in (b), where deep means farther than {DEEP}. Of disks at rest, let go where the platform falls away, there come to rest again: {}",
                depth(a),
                depth(b),
                rest.join(", "),
            ),
        ),
        third_attractor(data, b),
        Claim::printed_statement(
            "section4.fractal_boundary",
            claim::all(&d.boundary_exponents, |exponent| *exponent < SMOOTH_FROM),
            format!(
                "whether the exponents are below {SMOOTH_FROM}, where smooth boundaries have 1: from one size of cells to twice it the share of cells at a boundary grows with the exponents {} of the size, in all {:.2}: a boundary of \
                 dimension {:.2}; in (a), where it is smooth, with {}",
                exponents(d),
                d.boundary_exponent.unwrap_or(f64::NAN),
                2.0 - d.boundary_exponent.unwrap_or(f64::NAN),
                exponents(a),
            ),
        ),
        fills(data, e),
    ]
}
