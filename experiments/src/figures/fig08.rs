//! Fig. 8: the geometry of the ultrasonic motor.

mod compute;
mod data;
mod draw;
mod stator;

use bouncing_disk_plot::Figure;

pub use self::data::Fig08Data;
use crate::experiment::{Experiment, ExperimentError, Quality};
use crate::progress::Progress;

/// Fig. 8.
#[derive(Debug)]
pub struct Fig08;

impl Experiment for Fig08 {
    type Data = Fig08Data;

    const ID: &'static str = "fig08";

    const TITLE: &'static str = "Geometric details of the ultrasonic motor";
    const DISCUSSION: &str = include_str!("fig08/discussion.md");

    fn caption(data: &Fig08Data) -> String {
        format!(
            "Geometric details of the ultrasonic motor (not to scale), with the dimensions that the text gives: the rotor, a \
             steel ball of {} mm diameter with radius of gyration a_g = {} mm; the stator, a pretwisted beam glued to an \
             axially poled piezoelectric transducer, which the ball touches along a circle of radius a_e = {} mm (enlarged at \
             the right). A sinusoidal voltage at a resonance makes the stator's tip vibrate as Eq. (1) describes, s up and \
             down and β about the axis; the arrow in the transducer is its poling. The preload mg is the weight of the ball, reduced by a magnet above it: g is the \
             acceleration that is left. All other \
             dimensions of the drawing are made up: the paper's drawing is not in its text.",
            data.ball_diameter_mm, data.table_iii.gyration_radius_mm, data.table_iii.contact_radius_mm
        )
    }

    fn compute(_quality: Quality, progress: &dyn Progress) -> Result<Fig08Data, ExperimentError> {
        compute::compute(progress)
    }

    fn draw(data: &Fig08Data) -> Result<Figure, ExperimentError> {
        Ok(draw::draw(data))
    }

    fn parameters(data: &Fig08Data) -> Vec<(String, String)> {
        [
            ("ball diameter", format!("{} mm", data.ball_diameter_mm)),
            ("contact radius a_e", format!("{} mm", data.table_iii.contact_radius_mm)),
            ("radius of gyration a_g", format!("{} mm", data.table_iii.gyration_radius_mm)),
            ("density of steel (assumed)", format!("{} kg/m³", data.steel_density_kg_per_m3)),
            ("gravity g", format!("{} m/s²", data.gravity_m_per_s2)),
        ]
        .map(|(name, value)| (name.to_owned(), value))
        .to_vec()
    }
}
