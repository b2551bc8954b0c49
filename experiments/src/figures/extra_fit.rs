//! Beyond the paper: fits of synthetic transients with their intervals, and durations at which they are refused.

mod claims;
mod compute;
mod data;
mod draw;

use bouncing_disk::core::ChatterPolicy;
use bouncing_disk_plot::Figure;

pub use self::data::ExtraFitData;
use crate::claim::Claim;
use crate::experiment::{Experiment, ExperimentError, Quality};
use crate::progress::Progress;

/// Fits with intervals.
#[derive(Debug)]
pub struct ExtraFit;

impl Experiment for ExtraFit {
    type Data = ExtraFitData;
    const ID: &'static str = "extra-fit";
    const TITLE: &'static str = "What a transient tells of steady speed and time constant";
    const DISCUSSION: &'static str = include_str!("extra_fit/discussion.md");
    const CHATTER_POLICY: Option<ChatterPolicy> = None;

    fn seeds() -> Vec<(&'static str, u64)> {
        vec![("synthetic transients", compute::SEED)]
    }

    fn caption(data: &ExtraFitData) -> String {
        data.caption()
    }

    fn compute(quality: Quality, progress: &dyn Progress) -> Result<ExtraFitData, ExperimentError> {
        compute::compute(quality, progress)
    }

    fn draw(data: &ExtraFitData) -> Result<Figure, ExperimentError> {
        Ok(draw::draw(data))
    }

    fn claims(data: &ExtraFitData) -> Vec<Claim> {
        claims::claims(data)
    }

    fn parameters(data: &ExtraFitData) -> Vec<(String, String)> {
        data.parameters()
    }
}
