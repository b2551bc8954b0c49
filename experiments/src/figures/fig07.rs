//! Fig. 7: basins of attraction.

mod claims;
mod compute;
mod data;
mod draw;
mod labels;
mod panels;
mod scan;
mod windows;

use bouncing_disk::core::ChatterPolicy;
use bouncing_disk_plot::Figure;

pub use self::data::Fig07Data;
use crate::claims::Claim;
use crate::experiment::{Experiment, ExperimentError, Quality};
use crate::progress::Progress;

/// Fig. 7.
#[derive(Debug)]
pub struct Fig07;

impl Experiment for Fig07 {
    type Data = Fig07Data;
    const ID: &'static str = "fig07";
    const TITLE: &'static str = "Basins of attraction";
    const DISCUSSION: &str = include_str!("fig07/discussion.md");
    const CHATTER_POLICY: Option<ChatterPolicy> = Some(ChatterPolicy::Complete);

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

    fn compute(quality: Quality, progress: &dyn Progress) -> Result<Fig07Data, ExperimentError> {
        compute::compute(quality, progress)
    }

    fn draw(data: &Fig07Data) -> Result<Figure, ExperimentError> {
        Ok(draw::draw(data))
    }

    fn claims(data: &Fig07Data) -> Vec<Claim> {
        claims::claims(data)
    }

    fn parameters(data: &Fig07Data) -> Vec<(String, String)> {
        let pair = |name: &str, value: String| (name.to_owned(), value);
        let forcings: Vec<String> =
            data.panels.iter().map(|panel| draw::forcing_text(panel.axial_forcing)).collect();
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
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::claims::{Class, Computed};
    use crate::progress::Silent;

    #[test]
    fn no_statement_of_the_paper_holds_without_data() {
        let mut data = Fig07::compute(Quality::Draft, &Silent).expect("runs");
        assert!(Fig07::claims(&data).iter().all(|claim| !claim.lacks_data()));
        data.windows.curve.clear();
        data.along_window.clear();
        data.beyond.clear();
        data.panels[3].boundary_exponents.clear();
        // What is judged by the panels themselves.
        let panels =
            ["section4.chattering_is_easier", "section4.rest_chatters", "section4.basin_fills_plane"];
        for claim in Fig07::claims(&data) {
            let holds = matches!(claim.computed, Computed::Boolean(true));
            let own = panels
                .iter()
                .any(|key| matches!(&claim.source, crate::claims::Source::Entry(of) if of == key));
            assert!(!(holds && claim.class == Class::Paper) || own, "{}", claim.quantity);
        }
    }
}
