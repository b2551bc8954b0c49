//! Beyond the paper: what the attractor of Fig. 6 touches where it is lost, and how long orbits live beyond.

mod claims;
mod compute;
mod data;
mod draw;

use bouncing_disk::core::ChatterPolicy;
use bouncing_disk_plot::Figure;

pub use self::data::ExtraCrisisData;
use crate::claim::Claim;
use crate::experiment::{Experiment, ExperimentError, Quality};
use crate::progress::Progress;

/// The crisis of the attractor of Fig. 6.
#[derive(Debug)]
pub struct ExtraCrisis;

impl Experiment for ExtraCrisis {
    type Data = ExtraCrisisData;
    const ID: &'static str = "extra-crisis";
    const TITLE: &'static str = "The crisis: a tangency, and the lives beyond it";
    const DISCUSSION: &'static str = include_str!("extra_crisis/discussion.md");
    const CHATTER_POLICY: Option<ChatterPolicy> = Some(ChatterPolicy::Complete);

    fn caption(data: &ExtraCrisisData) -> String {
        data.caption()
    }

    fn compute(quality: Quality, progress: &dyn Progress) -> Result<ExtraCrisisData, ExperimentError> {
        compute::compute(quality, progress)
    }

    fn draw(data: &ExtraCrisisData) -> Result<Figure, ExperimentError> {
        Ok(draw::draw(data))
    }

    fn claims(data: &ExtraCrisisData) -> Vec<Claim> {
        claims::claims(data)
    }

    fn parameters(data: &ExtraCrisisData) -> Vec<(String, String)> {
        data.parameters()
    }
}
