//! Fig. 1: the displacement variables of the bouncing-disk system.

mod compute;
mod data;
mod draw;

use std::f64::consts::PI;

use bouncing_disk::core::ChatterPolicy;
use bouncing_disk_plot::Figure;

pub use self::data::Fig01Data;
use crate::experiment::{Experiment, ExperimentError, Quality};
use crate::progress::Progress;

/// Fig. 1.
#[derive(Debug)]
pub struct Fig01;

impl Experiment for Fig01 {
    type Data = Fig01Data;

    const ID: &'static str = "fig01";

    const TITLE: &'static str = "The displacement variables of the bouncing disk";
    const DISCUSSION: &str = include_str!("fig01/discussion.md");
    const CHATTER_POLICY: Option<ChatterPolicy> = Some(ChatterPolicy::Complete);

    fn caption(data: &Fig01Data) -> String {
        format!(
            "The displacement variables of the bouncing-disk system and of pizza tossing, (a) and (c) drawn in perspective and to \
             scale from a computed toss. (a) The disk (x, α) above the oscillating platform (s, β) at the phase τ = {:.3} \
             rad, {:.0} % of its flight after the separation: x = {:.3} m, s = {:.3} m, α = {:.2} rad, β = {:.2} rad. \
             Heights are measured from the platform's mean height, angles from the line on which the \
             platform's mark lies when β = 0; the disk's mark lay over it at the start. (b) A sketch, not to scale: a dough above \
             the hand that tosses it, with the same four variables. (c) The path of a point of the platform at the contact radius a_e, Eq. (1): a \
             closed curve on the surface of a cylinder, with the amplitudes A and a_e Φ; the dot is the point at the \
             instant of (a), the arrows show the sense of the motion, what lies behind the cylinder is dotted. \
             Parameters of Table I except for θ = −π/4, chosen here because the path for θ = 0 encloses no area; the \
             radius of disk and platform, √2 a_g, is that of a uniform disk, their thickness is not to scale.",
            data.phase_rad,
            100.0 * compute::SHARE_OF_FLIGHT,
            data.disk_height_m,
            data.platform_height_m,
            data.disk_angle_rad,
            data.platform_angle_rad,
        )
    }

    fn compute(quality: Quality, progress: &dyn Progress) -> Result<Fig01Data, ExperimentError> {
        compute::compute(quality, progress)
    }

    fn draw(data: &Fig01Data) -> Result<Figure, ExperimentError> {
        Ok(draw::draw(data))
    }

    fn parameters(data: &Fig01Data) -> Vec<(String, String)> {
        let table = &data.table_i;
        [
            ("phase lag θ", format!("{:.2}π (Table I: {})", data.phase_lag_rad / PI, table.phase_lag_rad)),
            ("amplitude angle φ_L", format!("{} rad", table.amplitude_angle_rad.value)),
            ("stroke c", format!("{} m", table.stroke_m.value)),
            ("angular frequency ω", format!("{} rad/s", table.angular_frequency_rad_per_s.value)),
            ("contact radius a_e", format!("{} m", table.contact_radius_m.value)),
            ("radius of gyration a_g", format!("{} m", table.gyration_radius_m.value)),
            ("friction μ", table.friction.value.to_string()),
            ("start", "lowest point of the hand, dough at rest".to_owned()),
        ]
        .map(|(name, value)| (name.to_owned(), value))
        .to_vec()
    }
}
