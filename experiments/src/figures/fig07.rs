//! Fig. 7: basins of attraction.

mod data;
mod labels;
mod panels;
mod picture;
mod statements;
mod windows;

pub use self::data::Fig07Data;
use crate::claim::Claim;
use crate::draw::Figure;
use crate::experiment::{Experiment, ExperimentError, Quality};
use crate::progress::Progress;

/// Coefficient of restitution of Sec. IV.
const RESTITUTION: f64 = 0.5;

/// Γ of the panels.
const FORCINGS: [f64; 5] = [0.34, 0.486, 0.50, 0.55, 0.60];

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

    fn caption(data: &Fig07Data) -> String {
        statements::caption(data)
    }

    fn run(quality: Quality, progress: &dyn Progress) -> Result<Fig07Data, ExperimentError> {
        let cells = quality.choose(150, 1_000);
        let (rows, columns) = quality.choose((320, 100), (1_600, 400));
        progress.start(5 * cells as u64 + 2 * rows as u64, "rows");
        let panels = FORCINGS
            .into_iter()
            .map(|forcing| panels::panel(forcing, (WINDOW_TOP, cells), progress))
            .collect::<Result<Vec<_>, _>>()?;
        let windows = windows::windows((FORCINGS[0], FORCINGS[1]), (rows, columns), progress)?;
        let decay = panels::decay(FORCINGS[3], WINDOW_TOP, quality.choose(60, 150))?;
        Ok(Fig07Data { restitution: RESTITUTION, window_top: WINDOW_TOP, cells, panels, windows, decay })
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
