//! Fig. 12: transient speed curves of long-period and low-period chattering.

mod data;
mod picture;
mod run;
mod statements;

pub use self::data::Fig12Data;
use crate::claim::Claim;
use crate::experiment::{Experiment, ExperimentError, Quality};
use crate::progress::Progress;
use bouncing_disk_plot::Figure;

/// Fig. 12.
#[derive(Debug)]
pub struct Fig12;

impl Experiment for Fig12 {
    type Data = Fig12Data;
    const ID: &'static str = "fig12";
    const TITLE: &'static str = "Speed transients of long-period and low-period chattering";
    const READING: &str = include_str!("fig12/reading.md");

    fn caption(data: &Fig12Data) -> String {
        statements::caption(data)
    }

    fn run(quality: Quality, progress: &dyn Progress) -> Result<Fig12Data, ExperimentError> {
        run::run(quality, progress)
    }

    fn draw(data: &Fig12Data) -> Result<Figure, ExperimentError> {
        Ok(picture::draw(data))
    }

    fn claims(data: &Fig12Data) -> Vec<Claim> {
        statements::claims(data)
    }

    fn parameters(data: &Fig12Data) -> Vec<(String, String)> {
        statements::parameters(data)
    }
}
