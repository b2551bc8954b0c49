//! Beyond the paper: the Lyapunov exponent over the forcing, under the orbit diagram.

mod claims;
mod compute;
mod data;
mod draw;

use bouncing_disk::core::ChatterPolicy;
use bouncing_disk_plot::Figure;

pub use self::data::ExtraLyapunovData;
use crate::claim::Claim;
use crate::experiment::{Experiment, ExperimentError, Quality};
use crate::progress::Progress;

/// Lyapunov exponents over the forcing.
#[derive(Debug)]
pub struct ExtraLyapunov;

impl Experiment for ExtraLyapunov {
    type Data = ExtraLyapunovData;
    const ID: &'static str = "extra-lyapunov";
    const TITLE: &'static str = "Lyapunov exponents over the forcing";
    const DISCUSSION: &'static str = include_str!("extra_lyapunov/discussion.md");
    const CHATTER_POLICY: Option<ChatterPolicy> = Some(ChatterPolicy::Complete);

    fn caption(data: &ExtraLyapunovData) -> String {
        data.caption()
    }

    fn compute(quality: Quality, progress: &dyn Progress) -> Result<ExtraLyapunovData, ExperimentError> {
        compute::compute(quality, progress)
    }

    fn draw(data: &ExtraLyapunovData) -> Result<Figure, ExperimentError> {
        Ok(draw::draw(data))
    }

    fn claims(data: &ExtraLyapunovData) -> Vec<Claim> {
        claims::claims(data)
    }

    fn parameters(data: &ExtraLyapunovData) -> Vec<(String, String)> {
        data.parameters()
    }
}
