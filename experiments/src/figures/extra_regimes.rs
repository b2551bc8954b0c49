//! Beyond the paper: what a disk does for good, over forcing and restitution.

mod claims;
mod compute;
mod data;
mod draw;

use bouncing_disk::core::ChatterPolicy;
use bouncing_disk_plot::Figure;

pub use self::data::ExtraRegimesData;
use crate::claim::Claim;
use crate::experiment::{Experiment, ExperimentError, Quality};
use crate::progress::Progress;

/// Verdicts over forcing and restitution.
#[derive(Debug)]
pub struct ExtraRegimes;

impl Experiment for ExtraRegimes {
    type Data = ExtraRegimesData;
    const ID: &'static str = "extra-regimes";
    const TITLE: &'static str = "What a disk does, over forcing and restitution";
    const DISCUSSION: &'static str = include_str!("extra_regimes/discussion.md");
    const CHATTER_POLICY: Option<ChatterPolicy> = Some(ChatterPolicy::Complete);

    fn caption(data: &ExtraRegimesData) -> String {
        data.caption()
    }

    fn compute(quality: Quality, progress: &dyn Progress) -> Result<ExtraRegimesData, ExperimentError> {
        compute::compute(quality, progress)
    }

    fn draw(data: &ExtraRegimesData) -> Result<Figure, ExperimentError> {
        Ok(draw::draw(data))
    }

    fn claims(data: &ExtraRegimesData) -> Vec<Claim> {
        claims::claims(data)
    }

    fn parameters(data: &ExtraRegimesData) -> Vec<(String, String)> {
        data.parameters()
    }
}
