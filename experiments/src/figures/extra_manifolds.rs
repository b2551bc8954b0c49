//! Beyond the paper: the stable manifolds of the saddles over the basins of Fig. 7, and the branches of its third attractor.

mod claims;
mod compute;
mod data;
mod draw;

use bouncing_disk::core::ChatterPolicy;
use bouncing_disk_plot::Figure;

pub use self::data::ExtraManifoldsData;
use crate::claim::Claim;
use crate::experiment::{Experiment, ExperimentError, Quality};
use crate::progress::Progress;

/// Stable manifolds over the basins of Fig. 7.
#[derive(Debug)]
pub struct ExtraManifolds;

impl Experiment for ExtraManifolds {
    type Data = ExtraManifoldsData;
    const ID: &'static str = "extra-manifolds";
    const TITLE: &'static str = "Stable manifolds over the basins of Fig. 7";
    const DISCUSSION: &'static str = include_str!("extra_manifolds/discussion.md");
    const CHATTER_POLICY: Option<ChatterPolicy> = Some(ChatterPolicy::Complete);

    fn caption(data: &ExtraManifoldsData) -> String {
        data.caption()
    }

    fn compute(quality: Quality, progress: &dyn Progress) -> Result<ExtraManifoldsData, ExperimentError> {
        compute::compute(quality, progress)
    }

    fn draw(data: &ExtraManifoldsData) -> Result<Figure, ExperimentError> {
        Ok(draw::draw(data))
    }

    fn claims(data: &ExtraManifoldsData) -> Vec<Claim> {
        claims::claims(data)
    }

    fn parameters(data: &ExtraManifoldsData) -> Vec<(String, String)> {
        data.parameters()
    }
}
