//! Fig. 14: growth of the dough over multiple tosses.

mod compute;
mod data;
mod draw;

use bouncing_disk_plot::Figure;

use self::compute::{FRAMES_PER_S, SCATTER, SEED};
pub use self::data::Fig14Data;
use super::dough_record::{DIAMETERS, Growth};
use crate::claims::Claim;
use crate::experiment::{Experiment, ExperimentError, Quality};
use crate::measured::{Layout, Series};
use crate::progress::Progress;

/// Fig. 14.
#[derive(Debug)]
pub struct Fig14;

impl Experiment for Fig14 {
    type Data = Fig14Data;
    const ID: &'static str = "fig14";
    const TITLE: &'static str = "Growth of the dough over multiple tosses";
    const DISCUSSION: &str = include_str!("fig14/discussion.md");
    const MEASUREMENTS: &'static [Layout] = &[DIAMETERS];

    fn seeds() -> Vec<(&'static str, u64)> {
        vec![("record", SEED)]
    }

    fn caption(data: &Fig14Data) -> String {
        let measured = data
            .measured
            .as_ref()
            .map_or(String::new(), |growth| format!(" Crosses: a user's own diameters, {}.", growth.words()));
        format!(
            "Diameter of the dough against time. Black: the printed least-squares line d/d₀ = 1 + {} (t − {}). Arrows: \
             starts of the tosses n = 3 to 12, evenly spaced so that the printed growth of {} % lies between the first and \
             the last. Dots: a synthetic record, not measured, on that line with a relative scatter of {} at {} frames a \
             second (seed {SEED}); dashed: the line fitted to it, slope {:.4} ± {:.4} 1/s. The paper's points are not in its \
             text.{measured}",
            data.slope_per_s,
            data.start_s,
            100.0 * data.growth,
            SCATTER,
            FRAMES_PER_S,
            data.synthetic_slope_per_s,
            data.synthetic_slope_error_per_s,
        )
    }

    fn compute(_: Quality, progress: &dyn Progress) -> Result<Fig14Data, ExperimentError> {
        compute::compute(progress)
    }

    fn overlay(data: &mut Fig14Data, series: &Series) -> Result<(), ExperimentError> {
        data.measured = Some(Growth::of(series)?);
        Ok(())
    }

    fn draw(data: &Fig14Data) -> Result<Figure, ExperimentError> {
        Ok(draw::draw(data))
    }

    fn claims(data: &Fig14Data) -> Vec<Claim> {
        let toss_s = data.duration_s / f64::from(data.tosses_between);
        vec![Claim::printed("appendix.growth_per_toss", data.growth_per_toss_percent).note(format!(
            "the printed growth over the {} tosses from the start of the first to the start of the last; on the printed \
             line it takes {:.2} s, {toss_s:.3} s a toss",
            data.tosses_between, data.duration_s
        ))]
    }

    fn parameters(data: &Fig14Data) -> Vec<(String, String)> {
        vec![
            ("start of the line".to_owned(), format!("{} s", data.start_s)),
            ("slope of d/d₀".to_owned(), format!("{} 1/s", data.slope_per_s)),
            ("synthetic scatter of d".to_owned(), format!("{SCATTER}, {FRAMES_PER_S} frames a second")),
        ]
    }
}
