//! Beyond the paper: the best hand motion of a toss under constraints, and what is left of it where inputs are off.

mod claims;
mod compute;
mod data;
mod draw;

use bouncing_disk::core::ChatterPolicy;
use bouncing_disk_plot::Figure;

pub use self::data::ExtraDesignData;
use crate::claim::Claim;
use crate::experiment::{Experiment, ExperimentError, Quality};
use crate::progress::Progress;

/// The best hand motion.
#[derive(Debug)]
pub struct ExtraDesign;

impl Experiment for ExtraDesign {
    type Data = ExtraDesignData;
    const ID: &'static str = "extra-design";
    const TITLE: &'static str = "The best hand motion of a toss under constraints";
    const DISCUSSION: &'static str = include_str!("extra_design/discussion.md");
    const CHATTER_POLICY: Option<ChatterPolicy> = None;

    fn seeds() -> Vec<(&'static str, u64)> {
        vec![("random hand motions", compute::SEED)]
    }

    fn caption(data: &ExtraDesignData) -> String {
        data.caption()
    }

    fn compute(quality: Quality, progress: &dyn Progress) -> Result<ExtraDesignData, ExperimentError> {
        compute::compute(quality, progress)
    }

    fn draw(data: &ExtraDesignData) -> Result<Figure, ExperimentError> {
        Ok(draw::draw(data))
    }

    fn claims(data: &ExtraDesignData) -> Vec<Claim> {
        claims::claims(data)
    }

    fn parameters(data: &ExtraDesignData) -> Vec<(String, String)> {
        data.parameters()
    }
}
