//! Fig. 9: the coefficient of friction from the deceleration of the rotor.

mod compute;
mod data;
mod draw;

use bouncing_disk::core::ChatterPolicy;
use bouncing_disk_plot::Figure;

use self::compute::SEED;
pub use self::data::Fig09Data;
use super::braking_record::{DECELERATIONS, Deceleration, FRICTIONS, decelerations, friction_words};
use crate::experiment::{Experiment, ExperimentError, Quality};
use crate::measured::{Layout, Series};
use crate::progress::Progress;

/// Fig. 9.
#[derive(Debug)]
pub struct Fig09;

impl Experiment for Fig09 {
    type Data = Fig09Data;
    const ID: &'static str = "fig09";
    const TITLE: &'static str = "Coefficient of friction from the rotor's deceleration";
    const DISCUSSION: &str = include_str!("fig09/discussion.md");
    const MEASUREMENTS: &'static [Layout] = &[DECELERATIONS, FRICTIONS];
    const CHATTER_POLICY: Option<ChatterPolicy> = Some(ChatterPolicy::Complete);

    fn seeds() -> Vec<(&'static str, u64)> {
        vec![("readings of the friction", SEED)]
    }

    fn caption(data: &Fig09Data) -> String {
        let own: Vec<String> = data.measured_decelerations.iter().map(Deceleration::words).collect();
        let own = [own.join("; "), data.measured_words.clone()].join(" ");
        let own = if own.trim().is_empty() {
            String::new()
        } else {
            format!(" Crosses: a user's own measurements: {}.", own.trim())
        };
        format!(
            "Determining the coefficient of friction between rotor and stator. (a) Speed of the model's rotor after the \
             motor is switched off at {} rad/s, at the lowest, the middle and the highest preload of Sec. V B, with the fitted \
             line −α̈_brake (t − t_c) (dashed) from which Eq. (17) gives μ; a residual vibration of the stator is not \
             modelled. (b) μ against preload: circles, recovered from the model's curves; dots, a synthetic record, not \
             measured, drawn from the log-normal distribution with the printed mean {} and standard deviation {} (seed {}); \
             line, the printed mean. The paper's points are not in its text.{own}",
            data.first_speed_rad_per_s, data.printed_mean, data.printed_deviation, SEED
        )
    }

    fn compute(_: Quality, progress: &dyn Progress) -> Result<Fig09Data, ExperimentError> {
        compute::compute(progress)
    }

    fn overlay(data: &mut Fig09Data, series: &Series) -> Result<(), ExperimentError> {
        if series.layout().file == DECELERATIONS.file {
            let case = &data.case;
            let inertia = data.rotor_mass_kg * case.gyration_radius_m * case.gyration_radius_m;
            data.measured_decelerations = decelerations(series, inertia, case.contact_radius_m)?;
        } else {
            data.measured_frictions =
                series.rows::<2>().map(|[preload, friction]| (preload, friction)).collect();
            data.measured_words = friction_words(series)?;
        }
        Ok(())
    }

    fn draw(data: &Fig09Data) -> Result<Figure, ExperimentError> {
        Ok(draw::draw(data))
    }

    fn parameters(data: &Fig09Data) -> Vec<(String, String)> {
        vec![
            ("coefficient of friction μ of the model".to_owned(), data.case.friction.to_string()),
            ("contact radius a_e".to_owned(), format!("{} m", data.case.contact_radius_m)),
            ("radius of gyration a_g".to_owned(), format!("{} m", data.case.gyration_radius_m)),
            ("mass of the rotor".to_owned(), format!("{:.4} kg", data.rotor_mass_kg)),
            (
                "synthetic record".to_owned(),
                format!(
                    "mean {:.3}, standard deviation {:.3}, slope {:.2} ± {:.2} 1/N",
                    data.synthetic_spread.mean,
                    data.synthetic_spread.deviation,
                    data.synthetic_slope_per_n,
                    data.synthetic_slope_error_per_n
                ),
            ),
        ]
    }
}
