//! Fig. 1: the displacement variables of the bouncing-disk system.

mod picture;

use std::f64::consts::{FRAC_PI_4, PI, SQRT_2};

use bouncing_disk::core::elementary::sin;
use bouncing_disk::{Event, InitialSpin, Platform, toss_trajectory};
use serde::{Deserialize, Serialize};

use super::hand_path::HandPath;
use super::toss_case::TossCase;
use crate::claim::Claim;
use crate::experiment::{Experiment, ExperimentError, Quality};
use crate::paper::{self, TableOne};
use crate::progress::Progress;
use bouncing_disk_plot::Figure;

/// Phase lag of the motion shown. Table I has 0, for which the path of a point is a mere arc.
const PHASE_LAG: f64 = -FRAC_PI_4;

/// The instant shown, as a share of the flight.
const SHARE_OF_FLIGHT: f64 = 0.18;

/// Two lengths that should be one agree within this share of the stroke: a hundred roundings.
const ROUNDING: f64 = 100.0 * f64::EPSILON;

/// Fig. 1.
#[derive(Debug)]
pub struct Fig01;

/// The data of Fig. 1: the toss of Table I with another phase lag, and one instant of it.
#[derive(Debug, Serialize, Deserialize)]
pub struct Fig01Data {
    table_i: TableOne,
    phase_lag_rad: f64,
    contact_radius_m: f64,
    /// The radius of a uniform disk with Table I's radius of gyration.
    disk_radius_m: f64,
    amplitude_m: f64,
    twist_amplitude_rad: f64,
    phase_rad: f64,
    platform_height_m: f64,
    platform_angle_rad: f64,
    disk_height_m: f64,
    disk_angle_rad: f64,
    path: HandPath,
    /// Largest difference of the platform from Eq. (1), over the amplitudes.
    equation_fault: f64,
}

/// The platform of the model against Eq. (1), over the amplitudes.
fn equation_fault(platform: &Platform, path: &HandPath) -> f64 {
    let points = path.phase_rad.iter().zip(path.points());
    points
        .map(|(phase, (angle, height))| {
            let turned = platform.twist_amplitude() * sin(phase + platform.phase_lag());
            let raised = platform.amplitude() * sin(*phase);
            let angle_fault = (angle - turned).abs() / platform.twist_amplitude();
            angle_fault.max((height - raised).abs() / platform.amplitude())
        })
        .fold(0.0, f64::max)
}

impl Experiment for Fig01 {
    type Data = Fig01Data;

    const ID: &'static str = "fig01";

    const TITLE: &'static str = "The displacement variables of the bouncing disk";
    const READING: &str = include_str!("fig01/reading.md");

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
            100.0 * SHARE_OF_FLIGHT,
            data.disk_height_m,
            data.platform_height_m,
            data.disk_angle_rad,
            data.platform_angle_rad,
        )
    }

    fn run(quality: Quality, progress: &dyn Progress) -> Result<Fig01Data, ExperimentError> {
        progress.start(1, "toss");
        let table_i = paper::table_one()?;
        let case = TossCase::from(&table_i).at_lag(PHASE_LAG);
        let system = case.system()?;
        let scales = system.scales();
        let trajectory =
            toss_trajectory(&system, InitialSpin::AbsoluteRest).map_err(ExperimentError::model)?;
        let flight = trajectory.records().iter().find(|record| matches!(record.event, Event::Impact { .. }));
        let Some(flight) = flight else {
            let peak_acceleration = system.peak_acceleration();
            return Err(ExperimentError::model(bouncing_disk::Error::NeverLeaves { peak_acceleration }));
        };
        let instant = flight.evaluate(system.dimensionless(), SHARE_OF_FLIGHT);
        let disk = scales.state(&instant.disk);
        let platform = system.platform();
        let path = HandPath::new(platform, quality.choose(120, 720))?;
        progress.advance(1);
        Ok(Fig01Data {
            phase_lag_rad: PHASE_LAG,
            contact_radius_m: case.contact_radius_m,
            disk_radius_m: SQRT_2 * case.gyration_radius_m,
            amplitude_m: platform.amplitude(),
            twist_amplitude_rad: platform.twist_amplitude(),
            phase_rad: instant.time.phase.angle(),
            platform_height_m: platform.height(instant.time.phase),
            platform_angle_rad: platform.angle(instant.time.phase),
            disk_height_m: disk.height,
            disk_angle_rad: disk.angle,
            equation_fault: equation_fault(platform, &path),
            path,
            table_i,
        })
    }

    fn draw(data: &Fig01Data) -> Result<Figure, ExperimentError> {
        Ok(picture::figure(data))
    }

    fn claims(data: &Fig01Data) -> Vec<Claim> {
        let gap = data.path.closing_gap(data.contact_radius_m);
        let area = data.path.enclosed_area(data.contact_radius_m);
        let stroke = data.table_i.stroke_m.value;
        let motion = Claim::printed_statement(
            "section1.platform_motion",
            (!data.path.phase_rad.is_empty()).then_some(data.equation_fault <= ROUNDING),
            format!(
                "largest difference of the platform's height and angle from Eq. (1) at {} phases, over the amplitudes: {:.1e}",
                data.path.phase_rad.len(),
                data.equation_fault
            ),
        );
        let curve = Claim::printed_statement(
            "section1.closed_curves",
            gap.map(|gap| gap <= ROUNDING * stroke && area.abs() > ROUNDING * stroke * stroke),
            format!(
                "after one period the point is {:.1e} m from where it was; on the unrolled cylinder of radius a_e \
                 its path encloses {:.4} m²",
                gap.unwrap_or(f64::NAN),
                area.abs()
            ),
        );
        vec![motion, curve]
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
