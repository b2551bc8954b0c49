//! Fig. 7: basins of attraction.

mod data;
mod labels;
mod panels;
mod picture;
mod scan;
mod statements;
mod windows;

use rayon::prelude::*;

pub use self::data::Fig07Data;
use crate::claim::Claim;
use crate::experiment::{Experiment, ExperimentError, Quality};
use crate::paper;
use crate::progress::Progress;
use bouncing_disk_plot::Figure;

/// Top of the speed window |w_A Γ/(ωA)|. The paper's window is not in its text: this is the round number at which
/// both fractions that it prints come out (see [`windows`]).
const WINDOW_TOP: f64 = 5.0;

/// Fig. 7.
#[derive(Debug)]
pub struct Fig07;

impl Experiment for Fig07 {
    type Data = Fig07Data;
    const ID: &'static str = "fig07";
    const TITLE: &'static str = "Basins of attraction";
    const READING: &str = include_str!("fig07/reading.md");

    fn caption(data: &Fig07Data) -> String {
        statements::caption(data)
    }

    fn run(quality: Quality, progress: &dyn Progress) -> Result<Fig07Data, ExperimentError> {
        let printed = paper::section_four()?;
        let forcings = printed.axial_forcings_of_fig7;
        let cells = quality.choose(150, 1_000);
        let (rows, columns) = quality.choose((320, 100), (1_600, 400));
        progress.start(5 * cells as u64 + 2 * rows as u64, "rows");
        // Side by side, for each has parts in which one thing follows from another.
        let panels = || {
            forcings
                .into_par_iter()
                .map(|forcing| panels::panel(forcing, printed.restitution, (WINDOW_TOP, cells), progress))
                .collect::<Vec<_>>()
        };
        let decay = || {
            let chaotic = panels::map(forcings[3], printed.restitution)?;
            panels::decay(&chaotic, WINDOW_TOP, quality.choose(60, 150))
        };
        let windows = || windows::windows(&printed, (rows, columns), progress);
        let (panels, (windows, decay)) = rayon::join(panels, || rayon::join(windows, decay));
        // The first error in the order of the panels, whichever comes first in time.
        let panels = panels.into_iter().collect::<Result<_, _>>()?;
        let (windows, decay) = (windows?, decay?);
        let panels: Vec<data::Panel> = panels;
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

    fn draw(data: &Fig07Data) -> Result<Figure, ExperimentError> {
        Ok(picture::draw(data))
    }

    fn claims(data: &Fig07Data) -> Vec<Claim> {
        statements::claims(data)
    }

    fn parameters(data: &Fig07Data) -> Vec<(String, String)> {
        statements::parameters(data)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::claim::{Class, Computed};
    use crate::progress::Silent;

    #[test]
    fn no_statement_of_the_paper_holds_without_data() {
        let mut data = Fig07::run(Quality::Draft, &Silent).expect("runs");
        assert!(Fig07::claims(&data).iter().all(|claim| !claim.lacks_data()));
        data.windows.curve.clear();
        data.along_window.clear();
        data.beyond.clear();
        data.panels[3].boundary_exponents.clear();
        // What is judged by the panels themselves.
        let panels = ["section4.chattering_is_easier", "section4.rest_chatters", "section4.two_attractors"];
        for claim in Fig07::claims(&data) {
            let holds = matches!(claim.computed(), Computed::Boolean(true));
            let own = panels
                .iter()
                .any(|key| matches!(claim.source(), crate::claim::Source::Entry(of) if of == key));
            assert!(!(holds && claim.class() == Class::Paper) || own, "{}", claim.quantity());
        }
    }
}
