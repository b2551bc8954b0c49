//! Fig. 7: basins of attraction.

mod basins;
mod cells;
mod picture;
mod reached;
mod windows;

use bouncing_disk::core::ChatterPolicy;

use self::basins::Panel;
use self::windows::Windows;
use super::shared::map_in_parallel;
use crate::claims::{Claim, all, paper};
use crate::experiment::{ExperimentError, Paper};

/// Top of the speed window |w_A Γ/(ωA)|. The paper's window is not in its text: this is the round number at which
/// both shares that it prints come out ([`windows`]).
const WINDOW_TOP: f64 = 5.0;
/// The boundary share of a smooth curve falls as the first power of the cell size; a grid finds 0.97 to 1.02
/// for one.
const SMOOTH_FROM: f64 = 0.9;

/// Fig. 7.
pub(crate) fn fig07(fig: &mut Paper<'_>) -> Result<(), ExperimentError> {
    let section = &paper::section_four()?;
    let (restitution, forcings) = (section.restitution, section.axial_forcings_of_fig7);
    let (quality, progress) = (fig.quality, fig.progress);
    let cells = quality.choose(150, 800);
    let grid = quality.choose((320, 100), (900, 240));
    fig.chattering(ChatterPolicy::Complete);
    fig.record("restitution", &restitution)?;
    fig.record("window_top", &WINDOW_TOP)?;
    fig.record("cells", &cells)?;

    progress.start(5 * cells as u64 + 2 * grid.0 as u64, "rows");
    // Side by side, for each has parts in which one thing follows from another.
    let panel = |forcing: &f64| basins::panel(*forcing, restitution, cells, progress);
    let (panels, (windows, decay)) = rayon::join(
        || map_in_parallel(&forcings, panel),
        || {
            let decay = || basins::decay(forcings[3], restitution, quality);
            rayon::join(|| Windows::of(section, grid, progress), decay)
        },
    );
    let (panels, windows) = (panels?, windows?);
    fig.record("panels", &panels)?;
    fig.record("windows", &windows)?;
    // At the Γ of (d): impacts N, and the share of the window that has not come to rest after N of them.
    fig.record("decay", &decay?)?;
    let [a, b, _, d, e] = &panels[..] else {
        return Err(ExperimentError::NoData { quantity: "panels".to_owned() });
    };

    // The printed 11.6 % and 39.1 %.
    windows::claims(fig, &windows, cells, [a, b]);
    reached::along_window(fig, section, [a, b])?;
    reached::from_rest(fig, section, [a, b])?;
    reached::third_attractor(fig, restitution, b)?;
    fig.claim(fractal(d, a));
    reached::beyond(fig, section, cells, e)?;

    let listed = |of: fn(&Panel) -> String| panels.iter().map(of).collect::<Vec<_>>().join(", ");
    fig.parameter("restitution ε", restitution);
    fig.parameter("axial forcing Γ", listed(|panel| forcing_text(panel.axial_forcing)));
    fig.parameter("τ_imp/2π", "0 to 1");
    fig.parameter("|w_A Γ/(ωA)|", format!("0 to {WINDOW_TOP}"));
    fig.parameter("cells a panel", format!("{cells} × {cells}"));
    fig.parameter("impacts followed", listed(|panel| panel.max_impacts.to_string()));
    fig.parameter("chattering", "summed in closed form (complete)");
    let [low, high] = windows.printed.map(|share| 100.0 * share);
    fig.caption(format!(
        "Basins of attraction, {cells} × {cells} cells a panel, ε = {restitution}. White: the chattering orbit (impacts: \
         black crosses in (a)–(c), red dots in (d), black dots in (e)). Black: the attractor of the period-doubling route \
         (white crosses, yellow dots in (d)). Gray: another attractor (red circles). The window is not printed; \
         it ends at {WINDOW_TOP}, which gives both printed shares. (f) Share of the window [0, top] of the attractors in \
         (a) and (b) against its top; dashed: the printed {low:.1} % and {high:.1} %.",
    ));
    fig.draw(picture::draw(&panels, cells, &windows));
    Ok(())
}

/// At least two decimals.
fn forcing_text(forcing: f64) -> String {
    let text = forcing.to_string();
    if text.len() < 4 { format!("{forcing:.2}") } else { text }
}

/// The claim that the boundary in `panel` is fractal, and the one in `smooth` is not.
fn fractal(panel: &Panel, smooth: &Panel) -> Claim {
    let words = |panel: &Panel| {
        panel
            .boundary_exponents
            .iter()
            .map(|exponent| format!("{exponent:.2}"))
            .collect::<Vec<_>>()
            .join(", ")
    };
    Claim::printed_statement(
        "section4.fractal_boundary",
        all(&panel.boundary_exponents, |exponent| *exponent < SMOOTH_FROM),
        format!(
            "cells at the boundary grow with the power {} of their size, below {SMOOTH_FROM}: a boundary of dimension {:.2}; in (a), where it is smooth, with {}",
            words(panel),
            2.0 - panel.boundary_exponent.unwrap_or(f64::NAN),
            words(smooth),
        ),
    )
}
