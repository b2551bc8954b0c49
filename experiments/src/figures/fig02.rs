//! Fig. 2: trajectories of a tossing hand or a stator.

mod compute;
mod data;
mod draw;

use std::f64::consts::PI;

use bouncing_disk_plot::Figure;

pub use self::data::Fig02Data;
use crate::experiment::{Experiment, ExperimentError, Quality};
use crate::progress::Progress;

/// Fig. 2.
#[derive(Debug)]
pub struct Fig02;

impl Experiment for Fig02 {
    type Data = Fig02Data;

    const ID: &'static str = "fig02";

    const TITLE: &'static str = "Trajectories of tossing hands and stators";
    const DISCUSSION: &str = include_str!("fig02/discussion.md");

    fn caption(data: &Fig02Data) -> String {
        format!(
            "Potential dough-tossing motions and stator trajectories, Eq. (1) on the cylinder of radius a_e in \
             perspective: (a)–(c) the effect of the phase lag θ with φ_L = π/4, and (d)–(f) the effect of the amplitude \
             ratio L = tan φ_L with θ = −π/4. The dot is the point at τ = 0, the arrowheads show the sense of the motion; \
             what lies behind the cylinder is lighter and dotted; thin lines: mean height and β = 0. The text gives θ only \
             for (a), −π/2 (elliptical, Sec. IV A), and for (c), 0 (linear, Sec. III B); −π/4 for the semielliptical (b), \
             φ_L = 0.05π, 0.25π and 0.45π for (d)–(f), and the stroke c = {} a_e are choices made here. (b) and (e) show the same motion: the paper's \
             caption gives φ_L = π/4 to the upper row and θ = −π/4 to the lower one, and the middle panels of both rows have these two.",
            data.stroke_over_contact_radius
        )
    }

    fn compute(quality: Quality, progress: &dyn Progress) -> Result<Fig02Data, ExperimentError> {
        compute::compute(quality, progress)
    }

    fn draw(data: &Fig02Data) -> Result<Figure, ExperimentError> {
        Ok(draw::draw(data))
    }

    fn parameters(data: &Fig02Data) -> Vec<(String, String)> {
        let list = |values: &mut dyn Iterator<Item = f64>| {
            values.map(|angle| format!("{:.2}π", angle / PI)).collect::<Vec<_>>().join(", ")
        };
        let panels = &data.panels;
        [
            ("phase lag θ of (a)–(f)", list(&mut panels.iter().map(|panel| panel.phase_lag_rad))),
            (
                "amplitude angle φ_L of (a)–(f)",
                list(&mut panels.iter().map(|panel| panel.amplitude_angle_rad)),
            ),
            ("stroke c", format!("{} a_e", data.stroke_over_contact_radius)),
        ]
        .map(|(name, value)| (name.to_owned(), value))
        .to_vec()
    }
}
