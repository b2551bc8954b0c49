//! Fig. 10(a)-(c): transient speed curves of the motor and their fits, for both readings of Table III.

mod data;
mod measured;
mod picture;
mod run;
mod statements;

pub use self::data::Fig10Data;
use crate::claim::Claim;
use crate::experiment::{Experiment, ExperimentError, Quality};
use crate::measured::{Layout, Series};
use crate::progress::Progress;
use bouncing_disk_plot::Figure;

/// Fig. 10.
#[derive(Debug)]
pub struct Fig10;

impl Experiment for Fig10 {
    type Data = Fig10Data;

    const ID: &'static str = "fig10";

    const TITLE: &'static str = "Transient speed curves of the ultrasonic motor";
    const READING: &str = include_str!("fig10/reading.md");

    const MEASUREMENTS: &'static [Layout] = &[measured::LAYOUT];

    fn caption(data: &Fig10Data) -> String {
        statements::caption(data)
    }

    fn run(quality: Quality, progress: &dyn Progress) -> Result<Fig10Data, ExperimentError> {
        run::run(quality, progress)
    }

    fn overlay(data: &mut Fig10Data, series: &Series) -> Result<(), ExperimentError> {
        data.measured = measured::trials(series)?;
        Ok(())
    }

    fn draw(data: &Fig10Data) -> Result<Figure, ExperimentError> {
        Ok(picture::draw(data))
    }

    fn claims(data: &Fig10Data) -> Vec<Claim> {
        statements::claims(data)
    }

    fn parameters(data: &Fig10Data) -> Vec<(String, String)> {
        statements::parameters(data)
    }
}
