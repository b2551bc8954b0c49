//! Beyond the paper: which preloads trap a motor in a short cycle.

mod claims;
mod compute;
mod data;
mod draw;

use bouncing_disk::core::ChatterPolicy;
use bouncing_disk_plot::Figure;

pub use self::data::ExtraTrapsData;
use crate::claim::Claim;
use crate::experiment::{Experiment, ExperimentError, Quality};
use crate::progress::Progress;

/// Low-period traps over the forcing.
#[derive(Debug)]
pub struct ExtraTraps;

impl Experiment for ExtraTraps {
    type Data = ExtraTrapsData;
    const ID: &'static str = "extra-traps";
    const TITLE: &'static str = "Preloads that trap the motor in a short cycle";
    const DISCUSSION: &'static str = include_str!("extra_traps/discussion.md");
    const CHATTER_POLICY: Option<ChatterPolicy> = Some(ChatterPolicy::Complete);

    fn seeds() -> Vec<(&'static str, u64)> {
        vec![("sampled motors", compute::SEED)]
    }

    fn caption(data: &ExtraTrapsData) -> String {
        data.caption()
    }

    fn compute(quality: Quality, progress: &dyn Progress) -> Result<ExtraTrapsData, ExperimentError> {
        compute::compute(quality, progress)
    }

    fn draw(data: &ExtraTrapsData) -> Result<Figure, ExperimentError> {
        Ok(draw::draw(data))
    }

    fn claims(data: &ExtraTrapsData) -> Vec<Claim> {
        claims::claims(data)
    }

    fn parameters(data: &ExtraTrapsData) -> Vec<(String, String)> {
        data.parameters()
    }
}
