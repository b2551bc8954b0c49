//! Beyond the paper: the branches of periodic orbits over the orbit diagram of Fig. 6.

mod branches;
mod checks;
mod claims;
mod compute;
mod data;
mod diagram;
mod draw;

use bouncing_disk::PAPER_CHATTER;
use bouncing_disk::core::ChatterPolicy;
use bouncing_disk_plot::Figure;

pub use self::data::ExtraBranchesData;
use crate::claim::Claim;
use crate::experiment::{Experiment, ExperimentError, Quality};
use crate::progress::Progress;

/// Branches of periodic orbits over the forcing.
#[derive(Debug)]
pub struct ExtraBranches;

impl Experiment for ExtraBranches {
    type Data = ExtraBranchesData;
    const ID: &'static str = "extra-branches";
    const TITLE: &'static str = "Branches of periodic orbits";
    const DISCUSSION: &'static str = include_str!("extra_branches/discussion.md");
    const CHATTER_POLICY: Option<ChatterPolicy> = Some(PAPER_CHATTER);

    fn caption(data: &ExtraBranchesData) -> String {
        data.caption()
    }

    fn compute(quality: Quality, progress: &dyn Progress) -> Result<ExtraBranchesData, ExperimentError> {
        compute::compute(quality, progress)
    }

    fn draw(data: &ExtraBranchesData) -> Result<Figure, ExperimentError> {
        Ok(draw::draw(data))
    }

    fn claims(data: &ExtraBranchesData) -> Vec<Claim> {
        claims::claims(data)
    }

    fn parameters(data: &ExtraBranchesData) -> Vec<(String, String)> {
        data.parameters()
    }
}
