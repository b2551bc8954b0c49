//! Fig. 8: the geometry of the ultrasonic motor.

mod picture;
mod stator;

use bouncing_disk::core::elementary::asin;
use serde::{Deserialize, Serialize};

use crate::claim::Claim;
use crate::experiment::{Experiment, ExperimentError, Quality};
use crate::paper::{self, STEEL_DENSITY, TableThree};
use crate::progress::Progress;
use bouncing_disk_plot::Figure;

/// Carbon and stainless steels lie between these densities (kg/m³; handbook values, not in the paper).
const STEEL_DENSITIES: [f64; 2] = [7700.0, 8000.0];

/// Fig. 8.
#[derive(Debug)]
pub struct Fig08;

/// The data of Fig. 8.
#[derive(Debug, Serialize, Deserialize)]
pub struct Fig08Data {
    table_iii: TableThree,
    ball_diameter_mm: f64,
    steel_density_kg_per_m3: f64,
    steel_densities_kg_per_m3: [f64; 2],
    gravity_m_per_s2: f64,
    ball_mass_kg: f64,
    ball_weight_n: f64,
    /// For the two ends of the range of densities.
    ball_weights_n: [f64; 2],
    /// sqrt(2/5) of the radius: a homogeneous sphere.
    gyration_radius_mm: f64,
    /// Between the axis and the normal of the ball where it touches the stator.
    contact_angle_rad: f64,
    /// How far the ball reaches into the circle of contact.
    contact_depth_mm: f64,
    preloads_n: [f64; 2],
    /// Preload over mass.
    preload_accelerations_m_per_s2: [f64; 2],
    preload_acceleration_range_m_per_s2: [f64; 2],
}

impl Experiment for Fig08 {
    type Data = Fig08Data;

    const ID: &'static str = "fig08";

    const TITLE: &'static str = "Geometric details of the ultrasonic motor";
    const READING: &str = include_str!("fig08/reading.md");

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

    fn run(_quality: Quality, progress: &dyn Progress) -> Result<Fig08Data, ExperimentError> {
        progress.start(1, "checks");
        let table_iii = paper::table_three()?;
        let section = paper::section_five()?;
        let preloads = paper::preloads()?;
        let gravity = section.gravity_m_per_s2;
        let mass = section.rotor_mass_kg();
        let radius_mm = 500.0 * section.rotor_diameter_m;
        let volume_m3 = mass / STEEL_DENSITY;
        let contact = table_iii.contact_radius_mm;
        progress.advance(1);
        Ok(Fig08Data {
            ball_diameter_mm: 2.0 * radius_mm,
            steel_density_kg_per_m3: STEEL_DENSITY,
            steel_densities_kg_per_m3: STEEL_DENSITIES,
            gravity_m_per_s2: gravity,
            ball_mass_kg: mass,
            ball_weight_n: gravity * mass,
            ball_weights_n: STEEL_DENSITIES.map(|density| gravity * density * volume_m3),
            gyration_radius_mm: 0.4_f64.sqrt() * radius_mm,
            contact_angle_rad: asin(contact / radius_mm),
            contact_depth_mm: radius_mm - (radius_mm * radius_mm - contact * contact).sqrt(),
            preloads_n: preloads.measured_range_n,
            preload_accelerations_m_per_s2: preloads.measured_range_n.map(|preload| preload / mass),
            preload_acceleration_range_m_per_s2: preloads.preload_accelerations_m_per_s2,
            table_iii,
        })
    }

    fn draw(data: &Fig08Data) -> Result<Figure, ExperimentError> {
        Ok(picture::figure(data))
    }

    fn claims(data: &Fig08Data) -> Vec<Claim> {
        claims(data)
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

fn claims(data: &Fig08Data) -> Vec<Claim> {
    let id = Fig08::ID;
    let milli = |newton: f64| 1e3 * newton;
    let [low, high] = data.preload_accelerations_m_per_s2;
    let [least, most] = data.preload_acceleration_range_m_per_s2;
    let [light, heavy] = data.ball_weights_n;
    let [low_density, high_density] = data.steel_densities_kg_per_m3;
    let weight = format!(
        "the ball weighs {:.1} mN with a density of {} kg/m³, an assumption since the paper prints neither; {:.0} to {:.0} mN \
         from {low_density} to {high_density} kg/m³",
        milli(data.ball_weight_n),
        data.steel_density_kg_per_m3,
        milli(light),
        milli(heavy)
    );
    let [least_preload, most_preload] = data.preloads_n;
    vec![Claim::statement(
        id,
        "this work",
        "the measured preloads, read in mN, are below the weight of the ball, and their g lies in the simulated range",
        least_preload < most_preload && most_preload < light && least <= low && high <= most,
        format!(
            "{weight}. Preloads of {:.0} to {:.0} mN over the mass are g = {low:.2} to {high:.2} m/s², simulated are \
                 {least} to {most} m/s². The printed unit, mNm, is that of a torque",
            milli(least_preload),
            milli(most_preload)
        ),
    )]
}
