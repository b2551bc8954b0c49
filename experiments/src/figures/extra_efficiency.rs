//! Beyond the paper: efficiency of its motor over load and phase lag, and where the energy goes.

mod claims;
mod compute;
mod data;
mod draw;

use bouncing_disk::core::ChatterPolicy;
use bouncing_disk_plot::Figure;

pub use self::data::ExtraEfficiencyData;
use crate::claim::Claim;
use crate::experiment::{Experiment, ExperimentError, Quality};
use crate::progress::Progress;

/// Efficiency over load and phase lag.
#[derive(Debug)]
pub struct ExtraEfficiency;

impl Experiment for ExtraEfficiency {
    type Data = ExtraEfficiencyData;
    const ID: &'static str = "extra-efficiency";
    const TITLE: &'static str = "Efficiency of the motor over load and phase lag";
    const DISCUSSION: &'static str = include_str!("extra_efficiency/discussion.md");
    const CHATTER_POLICY: Option<ChatterPolicy> = Some(ChatterPolicy::Complete);

    fn seeds() -> Vec<(&'static str, u64)> {
        vec![("ensembles", bouncing_disk::OperatingSettings::default().seed), ("check", compute::OTHER_SEED)]
    }

    fn caption(data: &ExtraEfficiencyData) -> String {
        data.caption()
    }

    fn compute(quality: Quality, progress: &dyn Progress) -> Result<ExtraEfficiencyData, ExperimentError> {
        compute::compute(quality, progress)
    }

    fn draw(data: &ExtraEfficiencyData) -> Result<Figure, ExperimentError> {
        Ok(draw::draw(data))
    }

    fn claims(data: &ExtraEfficiencyData) -> Vec<Claim> {
        claims::claims(data)
    }

    fn parameters(data: &ExtraEfficiencyData) -> Vec<(String, String)> {
        data.parameters()
    }
}
