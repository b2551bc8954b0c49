//! Fig. 6: bifurcation diagrams of the bouncing disk.

mod chattering;
mod contact;
mod data;
mod dimension;
mod explored;
mod merging;
mod period_one;
mod picture;
mod regimes;
mod rotation;
mod scan;
mod statements;

pub use self::data::Fig06Data;
pub(super) use self::scan::FORCING_RANGE;
use crate::claim::Claim;
use crate::draw::Figure;
use crate::experiment::{Experiment, ExperimentError, Quality};
use crate::progress::Progress;

/// Fig. 6.
#[derive(Debug)]
pub struct Fig06;

impl Experiment for Fig06 {
    type Data = Fig06Data;
    const ID: &'static str = "fig06";
    const TITLE: &'static str = "Bifurcation diagrams";
    const READING: &str = include_str!("fig06/reading.md");

    fn caption(data: &Fig06Data) -> String {
        statements::caption(data)
    }

    fn run(quality: Quality, progress: &dyn Progress) -> Result<Fig06Data, ExperimentError> {
        scan::run(quality, progress)
    }

    fn draw(data: &Fig06Data) -> Result<Figure, ExperimentError> {
        Ok(picture::draw(data))
    }

    fn claims(data: &Fig06Data) -> Vec<Claim> {
        statements::claims(data)
    }

    fn parameters(data: &Fig06Data) -> Vec<(String, String)> {
        statements::parameters(data)
    }
}
