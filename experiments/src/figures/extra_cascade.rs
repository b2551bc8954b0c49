//! Beyond the paper: the doubling cascade to many digits, and Feigenbaum's constants from it.

mod claims;
mod compute;
mod data;
mod draw;

use bouncing_disk_plot::Figure;

pub use self::data::ExtraCascadeData;
use crate::claim::Claim;
use crate::experiment::{Experiment, ExperimentError, Quality};
use crate::progress::Progress;
use crate::table::Table;

/// The doubling cascade.
#[derive(Debug)]
pub struct ExtraCascade;

impl Experiment for ExtraCascade {
    type Data = ExtraCascadeData;
    const ID: &'static str = "extra-cascade";
    const TITLE: &'static str = "The doubling cascade";
    const DISCUSSION: &'static str = include_str!("extra_cascade/discussion.md");

    fn caption(data: &ExtraCascadeData) -> String {
        data.caption()
    }

    fn compute(quality: Quality, progress: &dyn Progress) -> Result<ExtraCascadeData, ExperimentError> {
        compute::compute(quality, progress)
    }

    fn draw(data: &ExtraCascadeData) -> Result<Figure, ExperimentError> {
        Ok(draw::draw(data))
    }

    fn claims(data: &ExtraCascadeData) -> Vec<Claim> {
        claims::claims(data)
    }

    fn parameters(data: &ExtraCascadeData) -> Vec<(String, String)> {
        data.parameters()
    }

    fn table(data: &ExtraCascadeData) -> Option<Table> {
        Some(data.table())
    }
}
