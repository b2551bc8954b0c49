//! What the paper says about Fig. 7.

use bouncing_disk::core::elementary::ln;

use super::data::{Fig07Data, Panel, Search};
use super::picture::forcing_text;
use crate::claim::Claim;

const ID: &str = "fig07";
const SECTION: &str = "Sec. IV B";

pub(super) fn caption(data: &Fig07Data) -> String {
    let others = data.panels.iter().flat_map(|panel| &panel.others).count();
    format!(
        "Basins of attraction in the plane of impact phase and relative axial impact speed, {} × {} cells a panel, \
         ε = {}: white, the chattering orbit (its impacts: black crosses in (a)–(c), red dots in (d), black dots in (e)); \
         black, the attractor of the period-doubling route (white crosses in (a)–(c), yellow dots in (d)); gray, {} not in \
         the paper (red circles). The paper's window is not in its text; here it ends at {}, where both printed fractions come out. (f) Share of the window \
         [0, top] that belongs to the attractors in (a) and (b) against its top; dashed lines: the printed {:.1} % and {:.1} %.",
        data.cells,
        data.cells,
        data.restitution,
        match others {
            0 => "nothing".to_owned(),
            1 => "a further attractor".to_owned(),
            more => format!("{more} further attractors"),
        },
        data.window_top,
        100.0 * data.windows.printed[0],
        100.0 * data.windows.printed[1],
    )
}

pub(super) fn parameters(data: &Fig07Data) -> Vec<(String, String)> {
    let pair = |name: &str, value: String| (name.to_owned(), value);
    let forcings: Vec<String> = data.panels.iter().map(|panel| forcing_text(panel.axial_forcing)).collect();
    let longest: Vec<String> = data.panels.iter().map(|panel| panel.max_impacts.to_string()).collect();
    vec![
        pair("restitution ε", data.restitution.to_string()),
        pair("axial forcing Γ", forcings.join(", ")),
        pair("τ_imp/2π", "0 to 1".to_owned()),
        pair("|w_A Γ/(ωA)|", format!("0 to {}", data.window_top)),
        pair("cells a panel", format!("{} × {}", data.cells, data.cells)),
        pair("impacts followed", longest.join(", ")),
        pair("chattering", "summed in closed form (complete)".to_owned()),
    ]
}

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

fn described(search: &Search) -> String {
    format!(
        "{}: [{:.2}, {:.2}] gives {:.1} % and {:.1} %",
        search.family,
        search.bottom,
        search.top,
        100.0 * search.a,
        100.0 * search.b,
    )
}

fn top_text(top: Option<f64>) -> String {
    top.map_or("no window [0, top] up to 8".to_owned(), |top| format!("the window [0, {top:.3}]"))
}

pub(super) fn claims(data: &Fig07Data) -> Vec<Claim> {
    let mut claims = Vec::new();
    if let [a, b, c, d, e] = &data.panels[..] {
        claims.extend(fractions(data, a, b));
        claims.extend(shapes(data, [a, b, c, d, e]));
    }
    claims
}

fn fractions(data: &Fig07Data, a: &Panel, b: &Panel) -> Vec<Claim> {
    let windows = &data.windows;
    let window = format!(
        "the window is not printed: stated for τ_imp/2π in [0, 1], |w_A Γ/(ωA)| in [0, {}], chosen because both printed \
         fractions come out there, so neither is an independent test",
        data.window_top,
    );
    let searches = |not_chattering: bool| {
        let own = windows.searches.iter().filter(|search| search.not_chattering == not_chattering);
        own.map(described).collect::<Vec<_>>().join("; ")
    };
    let ranges = |tops: &[(f64, f64)]| {
        let ranges: Vec<String> = tops.iter().map(|(low, high)| format!("{low:.3} to {high:.3}")).collect();
        if ranges.is_empty() { "none".to_owned() } else { ranges.join(", ") }
    };
    vec![
        Claim::printed("section4.share_at_fig7a", 100.0 * a.shares.attractor)
            .note(&window)
            .note(accuracy(a.shares.attractor, a, data.cells))
        .note(format!("{} gives the printed number", top_text(windows.top_for_a))),
        Claim::printed("section4.share_at_fig7b", 100.0 * b.shares.attractor)
            .note(&window)
            .note(accuracy(b.shares.attractor, b, data.cells))
        .note(format!("{} gives the printed number", top_text(windows.top_for_b))),
        Claim::reading(
            ID,
            "section4.share_at_fig7b",
            "share of all starts that do not chatter at Γ = 0.486",
            100.0 * b.shares.not_chattering(),
        )
        .note("the printed number read as everything that is not white, which counts a second periodic attractor in")
        .note(accuracy(b.shares.not_chattering(), b, data.cells))
        .note(format!("{} gives the printed number", top_text(windows.top_for_b_not_chattering))),
        Claim::statement(
            ID,
            SECTION,
            "one window [0, top] gives both 11.6 % and 39.1 %",
            !windows.tops_for_both.is_empty(),
            format!(
                "tops up to 8 that give both to the last printed digit: {} with the period-1 orbit alone in (b), {} with \
                 everything that does not chatter. Nearest windows of several families, period-1 orbit alone: {}. Everything \
                 that does not chatter: {}",
                ranges(&windows.tops_for_both),
                ranges(&windows.tops_for_both_not_chattering),
                searches(false),
                searches(true)
            ),
        ),
        Claim::printed_statement(
            "section4.basin_widens",
            b.shares.attractor > a.shares.attractor
                && windows.curve.iter().filter(|point| point.a > 0.0).all(|point| point.b > point.a),
            "holds for every window [0, top] up to 8, panel (f)",
        ),
    ]
}

/// The exponent α of boundary share ~ cell^α between the finest two groupings; 2 - α is the boundary's dimension.
fn uncertainty_exponent(panel: &Panel) -> f64 {
    match panel.boundary_shares[..] {
        [(one, fine), .., (eight, coarse)] => ln(coarse / fine) / ln(eight as f64 / one as f64),
        _ => f64::NAN,
    }
}

fn shapes(data: &Fig07Data, [a, b, c, d, e]: [&Panel; 5]) -> Vec<Claim> {
    let depth =
        |panel: &Panel| panel.lowest_not_chattering.map_or("all".to_owned(), |low| format!("{low:.3}"));
    let step = data.window_top / data.cells as f64;
    let deep = |panel: &Panel| panel.lowest_not_chattering.is_none_or(|low| low > 0.1);
    let (_, last) = data.decay.last().copied().unwrap_or((0, f64::NAN));
    let decay: Vec<String> =
        data.decay.iter().map(|(count, share)| format!("{count}: {:.2} %", 100.0 * share)).collect();
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
    vec![
        Claim::printed_statement(
            "section4.chattering_is_easier",
            [a, b].iter().all(|panel| panel.shares.chattering > panel.shares.attractor),
            format!(
                "of the window, chattering has {:.1} % in (a) and {:.1} % in (b)",
                100.0 * a.shares.chattering,
                100.0 * b.shares.chattering,
            ),
        ),
        Claim::printed_statement(
            "section4.rest_chatters",
            deep(a) && deep(b),
            format!(
                "every start slower than |w_A Γ/(ωA)| = {} chatters in (a), {} in (b), {} in (c), {} in (d); rows are {step} high",
                depth(a),
                depth(b),
                depth(c),
                depth(d),
            ),
        ),
        Claim::statement(
            ID,
            SECTION,
            "the axis w_A = 0 is deep within the chattering basin at Γ = 0.55, too",
            deep(d),
            format!(
                "the slowest start that does not chatter in (d) has |w_A Γ/(ωA)| = {}; deep means farther than 0.1",
                depth(d),
            ),
        ),
        Claim::printed_statement(
            "section4.two_attractors",
            b.others.is_empty(),
            if others.is_empty() {
                "no other attractor was found".to_owned()
            } else {
                format!("{}; it holds {:.2} % of the window", others.join("; "), 100.0 * b.shares.other)
            },
        ),
        Claim::printed_statement(
            "section4.fractal_boundary",
            uncertainty_exponent(d) < 0.9,
            format!(
                "the share of cells at a boundary scales as (cell size)^{:.2}; it would be 1 for a smooth curve, and is {:.2} \
                 in (a)",
                uncertainty_exponent(d),
                uncertainty_exponent(a),
            ),
        ),
        Claim::printed_statement(
            "section4.basin_fills_plane",
            (e.shares.chattering - 1.0).abs() < f64::EPSILON,
            format!(
                "{} of {} cells come to rest within {} impacts. The text refers to Fig. 6(d); Fig. 7(e) shows it",
                (e.shares.chattering * (data.cells * data.cells) as f64).round(),
                data.cells * data.cells,
                e.max_impacts,
            ),
        ),
        Claim::statement(
            ID,
            "Fig. 7(d)",
            "the basin of the chaotic attractor does not depend on the number of impacts after which it is taken as reached",
            data.decay
                .iter()
                .filter(|(count, _)| *count >= d.max_impacts)
                .all(|(_, share)| (share - last).abs() < 5.0e-4),
            format!(
                "share of starts that have not come to rest after N impacts: {}; N = {} is used. A check of this work, not a \
                 statement of the paper",
                decay.join(", "),
                d.max_impacts,
            ),
        ),
    ]
}
