//! Beyond the paper: the orbit diagram with a constant restitution and with that of viscoelastic bodies.

mod claims;
mod compute;
mod data;
mod draw;

use bouncing_disk::core::ChatterPolicy;
use bouncing_disk_plot::Figure;

pub use self::data::ExtraRestitutionLawData;
use crate::claim::Claim;
use crate::experiment::{Experiment, ExperimentError, Quality};
use crate::progress::Progress;

/// Two laws of restitution.
#[derive(Debug)]
pub struct ExtraRestitutionLaw;

impl Experiment for ExtraRestitutionLaw {
    type Data = ExtraRestitutionLawData;
    const ID: &'static str = "extra-restitution-law";
    const TITLE: &'static str = "The orbit diagram under two laws of restitution";
    const DISCUSSION: &'static str = include_str!("extra_restitution_law/discussion.md");
    const CHATTER_POLICY: Option<ChatterPolicy> = Some(bouncing_disk::PAPER_CHATTER);

    fn seeds() -> Vec<(&'static str, u64)> {
        vec![]
    }

    fn caption(data: &ExtraRestitutionLawData) -> String {
        data.caption()
    }

    fn compute(
        quality: Quality,
        progress: &dyn Progress,
    ) -> Result<ExtraRestitutionLawData, ExperimentError> {
        compute::compute(quality, progress)
    }

    fn draw(data: &ExtraRestitutionLawData) -> Result<Figure, ExperimentError> {
        Ok(draw::draw(data))
    }

    fn claims(data: &ExtraRestitutionLawData) -> Vec<Claim> {
        claims::claims(data)
    }

    fn parameters(data: &ExtraRestitutionLawData) -> Vec<(String, String)> {
        data.parameters()
    }
}
