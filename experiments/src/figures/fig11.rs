//! Fig. 11: steady-state speed and stall torque of the motor against preload.

mod bouncing;
mod data;
mod measured;
mod picture;
mod statements;
mod trends;

pub use self::data::Fig11Data;
use crate::claim::Claim;
use crate::experiment::{Experiment, ExperimentError, Quality};
use crate::measured::{Layout, Series};
use crate::progress::Progress;
use crate::table::Table;
use bouncing_disk_plot::Figure;

/// Fig. 11.
#[derive(Debug)]
pub struct Fig11;

impl Experiment for Fig11 {
    type Data = Fig11Data;
    const ID: &'static str = "fig11";
    const TITLE: &'static str = "Effect of preload on steady-state speed and stall torque";
    const READING: &str = include_str!("fig11/reading.md");
    const MEASUREMENTS: &'static [Layout] = &[measured::LAYOUT];

    fn caption(data: &Fig11Data) -> String {
        statements::caption(data)
    }

    fn run(quality: Quality, progress: &dyn Progress) -> Result<Fig11Data, ExperimentError> {
        data::run(quality, progress)
    }

    fn overlay(data: &mut Fig11Data, series: &Series) -> Result<(), ExperimentError> {
        data.measured = measured::read(data, series)?;
        Ok(())
    }

    fn draw(data: &Fig11Data) -> Result<Figure, ExperimentError> {
        Ok(picture::draw(data))
    }

    fn claims(data: &Fig11Data) -> Vec<Claim> {
        statements::claims(data)
    }

    fn parameters(data: &Fig11Data) -> Vec<(String, String)> {
        statements::parameters(data)
    }

    fn table(data: &Fig11Data) -> Option<Table> {
        Some(statements::table(data))
    }
}
