//! Fig. 7: basins of attraction.

mod claims;
mod data;
mod draw;
mod panels;
mod scan;

use bouncing_disk::core::ChatterPolicy;

pub(crate) use self::data::Fig07Data;
use self::{panels::WINDOW_TOP, scan::windows};
use super::shared::map;
use crate::claims::paper;
use crate::experiment::{ExperimentError, Paper, Quality, named};
use crate::figures::shared::map_in_parallel;
use crate::progress::Progress;

/// Fig. 7.
pub(crate) fn fig07(fig: &mut Paper<'_>) -> Result<(), ExperimentError> {
    fig.chattering(ChatterPolicy::Complete);
    let data = &compute(fig.quality, fig.progress)?;
    fig.caption(caption(data));
    fig.parameters(parameters(data));
    fig.claims(claims::claims(data));
    fig.draw(draw::draw(data));
    fig.data(data)
}

fn compute(quality: Quality, progress: &dyn Progress) -> Result<Fig07Data, ExperimentError> {
    let printed = paper::section_four()?;
    let forcings = printed.axial_forcings_of_fig7;
    let cells = quality.choose(150, 1_000);
    let (rows, columns) = quality.choose((320, 100), (1_600, 400));
    progress.start(5 * cells as u64 + 2 * rows as u64, "rows");
    // Side by side, for each has parts in which one thing follows from another.
    let panel = |forcing: &f64| panels::panel(*forcing, printed.restitution, (WINDOW_TOP, cells), progress);
    let panels = || map_in_parallel(&forcings, panel);
    let decay = || {
        let chaotic = map(forcings[3], printed.restitution)?;
        panels::decay(&chaotic, WINDOW_TOP, quality.choose(60, 150))
    };
    let windows = || windows(&printed, (rows, columns), progress);
    let (panels, (windows, decay)) = rayon::join(panels, || rayon::join(windows, decay));
    let (panels, windows, decay) = (panels?, windows?, decay?);
    let [_, b, ..] = &panels[..] else {
        return Err(ExperimentError::NoData { quantity: "panels".to_owned() });
    };
    let traced = match b.others.first() {
        Some(other) => scan::traced(b.axial_forcing, other, printed.restitution)?,
        None => None,
    };
    Ok(Fig07Data {
        restitution: printed.restitution,
        window_top: WINDOW_TOP,
        cells,
        panels,
        windows,
        decay,
        along_window: scan::along_window(&printed, quality)?,
        beyond: scan::beyond(&printed, WINDOW_TOP, quality)?,
        rest: scan::rest(&forcings, printed.restitution)?,
        traced,
    })
}

fn caption(data: &Fig07Data) -> String {
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

fn parameters(data: &Fig07Data) -> Vec<(String, String)> {
    let forcings: Vec<String> =
        data.panels.iter().map(|panel| draw::forcing_text(panel.axial_forcing)).collect();
    let longest: Vec<String> = data.panels.iter().map(|panel| panel.max_impacts.to_string()).collect();
    named([
        ("restitution ε", data.restitution.to_string()),
        ("axial forcing Γ", forcings.join(", ")),
        ("τ_imp/2π", "0 to 1".to_owned()),
        ("|w_A Γ/(ωA)|", format!("0 to {}", data.window_top)),
        ("cells a panel", format!("{} × {}", data.cells, data.cells)),
        ("impacts followed", longest.join(", ")),
        ("chattering", "summed in closed form (complete)".to_owned()),
    ])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::claims::{Class, Computed};
    use crate::progress::Silent;

    #[test]
    fn no_statement_of_the_paper_holds_without_data() {
        let mut data = compute(Quality::Draft, &Silent).expect("runs");
        assert!(claims::claims(&data).iter().all(|claim| !claim.lacks_data()));
        data.windows.curve.clear();
        data.along_window.clear();
        data.beyond.clear();
        data.panels[3].boundary_exponents.clear();
        // Claims that the panels themselves decide.
        let panels =
            ["section4.chattering_is_easier", "section4.rest_chatters", "section4.basin_fills_plane"];
        for claim in claims::claims(&data) {
            let holds = matches!(claim.computed, Computed::Boolean(true));
            let own = claim.key.as_deref().is_some_and(|key| panels.contains(&key));
            assert!(!(holds && claim.class == Class::Paper) || own, "{}", claim.quantity);
        }
    }
}
