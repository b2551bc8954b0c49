//! Beyond the paper: all attractors of a map, and how much of its starts each of them has.

mod claims;
mod compute;
mod data;
mod draw;

use bouncing_disk::core::ChatterPolicy;
use bouncing_disk_plot::Figure;

pub use self::data::ExtraAttractorsData;
use crate::claim::Claim;
use crate::experiment::{Experiment, ExperimentError, Quality};
use crate::progress::Progress;

/// Attractors over the forcing, and their basins at one.
#[derive(Debug)]
pub struct ExtraAttractors;

impl Experiment for ExtraAttractors {
    type Data = ExtraAttractorsData;
    const ID: &'static str = "extra-attractors";
    const TITLE: &'static str = "All attractors, and the shares of their basins";
    const DISCUSSION: &'static str = include_str!("extra_attractors/discussion.md");
    const CHATTER_POLICY: Option<ChatterPolicy> = Some(ChatterPolicy::Complete);

    fn caption(data: &ExtraAttractorsData) -> String {
        data.caption()
    }

    fn compute(quality: Quality, progress: &dyn Progress) -> Result<ExtraAttractorsData, ExperimentError> {
        compute::compute(quality, progress)
    }

    fn draw(data: &ExtraAttractorsData) -> Result<Figure, ExperimentError> {
        Ok(draw::draw(data))
    }

    fn claims(data: &ExtraAttractorsData) -> Vec<Claim> {
        claims::claims(data)
    }

    fn parameters(data: &ExtraAttractorsData) -> Vec<(String, String)> {
        data.parameters()
    }
}
