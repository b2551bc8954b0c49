//! Fig. 13: sensitivity of the motor to the five estimated parameters.

mod data;
mod orbits;
mod picture;
mod reading;
mod run;
mod sensitivity;
mod statements;

pub use self::data::Fig13Data;
use crate::claim::Claim;
use crate::experiment::{Experiment, ExperimentError, Quality};
use crate::progress::Progress;
use crate::table::Table;
use bouncing_disk_plot::Figure;

/// Fig. 13.
#[derive(Debug)]
pub struct Fig13;

impl Experiment for Fig13 {
    type Data = Fig13Data;
    const ID: &'static str = "fig13";
    const TITLE: &'static str = "Effect of the estimated parameters on steady-state speed and stall torque";
    const READING: &str = include_str!("fig13/reading.md");

    fn caption(data: &Fig13Data) -> String {
        statements::caption(data)
    }

    fn run(quality: Quality, progress: &dyn Progress) -> Result<Fig13Data, ExperimentError> {
        run::run(quality, progress)
    }

    fn draw(data: &Fig13Data) -> Result<Figure, ExperimentError> {
        Ok(picture::draw(data))
    }

    fn claims(data: &Fig13Data) -> Vec<Claim> {
        statements::claims(data)
    }

    fn parameters(data: &Fig13Data) -> Vec<(String, String)> {
        statements::parameters(data)
    }

    fn table(data: &Fig13Data) -> Option<Table> {
        Some(statements::table(data))
    }
}
