//! The computation of Fig. 7.

use rayon::prelude::*;

use super::data::{self, Fig07Data};
use super::panels::{self, WINDOW_TOP};
use super::scan;
use super::windows::windows;
use crate::claims::paper;
use crate::experiment::{ExperimentError, Quality};
use crate::progress::Progress;

pub(super) fn compute(quality: Quality, progress: &dyn Progress) -> Result<Fig07Data, ExperimentError> {
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
    let windows = || windows(&printed, (rows, columns), progress);
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
