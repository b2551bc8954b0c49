//! Fig. 6: bifurcation diagrams of the bouncing disk.

mod chattering;
mod contact;
mod data;
mod dimension;
mod explored;
mod merging;
mod period_one;
mod picture;
mod regimes;
mod rotation;
mod scan;
mod statements;

pub use self::data::Fig06Data;
pub(super) use self::scan::FORCING_RANGE;
use crate::claim::Claim;
use crate::experiment::{Experiment, ExperimentError, Quality};
use crate::progress::Progress;
use bouncing_disk_plot::Figure;

/// Fig. 6.
#[derive(Debug)]
pub struct Fig06;

impl Experiment for Fig06 {
    type Data = Fig06Data;
    const ID: &'static str = "fig06";
    const TITLE: &'static str = "Bifurcation diagrams";
    const READING: &str = include_str!("fig06/reading.md");

    fn caption(data: &Fig06Data) -> String {
        statements::caption(data)
    }

    fn run(quality: Quality, progress: &dyn Progress) -> Result<Fig06Data, ExperimentError> {
        scan::run(quality, progress)
    }

    fn draw(data: &Fig06Data) -> Result<Figure, ExperimentError> {
        Ok(picture::draw(data))
    }

    fn claims(data: &Fig06Data) -> Vec<Claim> {
        statements::claims(data)
    }

    fn parameters(data: &Fig06Data) -> Vec<(String, String)> {
        statements::parameters(data)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::claim::{Class, Computed};
    use crate::progress::Silent;

    /// What is judged over a list of data is not judged where the list is empty.
    #[test]
    fn no_statement_of_the_paper_holds_without_data() {
        let mut data = Fig06::run(Quality::Draft, &Silent).expect("runs");
        assert!(Fig06::claims(&data).iter().all(|claim| !claim.lacks_data()));
        data.followed.clear();
        data.chattering.clear();
        data.doublings.clear();
        data.contact.clear();
        data.motions.clear();
        data.torque_ratios.clear();
        data.transfers.clear();
        data.lyapunov_exponents.clear();
        data.best_lags.clear();
        data.explored.shadows.clear();
        data.period_one.lags.clear();
        data.period_one.orbits = 0;
        // The multiplier of one orbit is one number, not a list.
        let single = ["the period-1 orbit exists and attracts at Γ = 0.335, where following starts"];
        for claim in Fig06::claims(&data) {
            let holds = matches!(claim.computed(), Computed::Boolean(true));
            let judged = matches!(claim.class(), Class::Paper | Class::Identity);
            assert!(!(holds && judged) || single.contains(&claim.quantity()), "{}", claim.quantity());
        }
    }
}
