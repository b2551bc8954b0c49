//! Fig. 8: the geometry of the ultrasonic motor.

mod picture;
mod stator;

use std::f64::consts::PI;

use serde::{Deserialize, Serialize};

use crate::claim::{Claim, PrintedNumber};
use crate::draw::Figure;
use crate::experiment::{Experiment, ExperimentError, Quality};
use crate::paper::{self, TableThree};
use crate::progress::Progress;

/// Density of steel (kg/m³): not in the paper. Plain carbon steel has 7850; carbon and stainless steels lie between
/// the other two.
const STEEL_DENSITY: f64 = 7850.0;
const STEEL_DENSITIES: [f64; 2] = [7700.0, 8000.0];

/// Diameter of the rotor, a steel ball (Sec. V).
const BALL_DIAMETER_MM: f64 = 20.0;

/// The preloads of the experiments (Sec. V B), printed in mNm and read in mN, and the range of g of the simulations.
const PRELOADS_MN: [f64; 2] = [80.0, 280.0];
const PRELOAD_ACCELERATIONS: [f64; 2] = [0.1, 10.0];

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
    ball_weight_mn: f64,
    /// For the two ends of the range of densities.
    ball_weights_mn: [f64; 2],
    /// sqrt(2/5) of the radius: a homogeneous sphere.
    gyration_radius_mm: f64,
    /// Between the axis and the normal of the ball where it touches the stator.
    contact_angle_rad: f64,
    /// How far the ball reaches into the circle of contact.
    contact_depth_mm: f64,
    preloads_mn: [f64; 2],
    /// Preload over mass.
    preload_accelerations_m_per_s2: [f64; 2],
    preload_acceleration_range_m_per_s2: [f64; 2],
}

impl Experiment for Fig08 {
    type Data = Fig08Data;

    const ID: &'static str = "fig08";

    const TITLE: &'static str = "Geometric details of the ultrasonic motor";

    fn caption(data: &Fig08Data) -> String {
        format!(
            "Geometric details of the ultrasonic motor (not to scale), with the dimensions that the text gives: the rotor, a \
             steel ball of {} mm diameter with radius of gyration a_g = {} mm; the stator, a pretwisted beam glued to an \
             axially poled piezoelectric transducer, which the ball touches along a circle of radius a_e = {} mm (enlarged at \
             the right). A sinusoidal voltage at a resonance makes the stator's tip vibrate as Eq. (1) describes, s up and \
             down and β about the axis; P is the poling. The preload is the weight of the ball, reduced by a magnet above it. All other \
             dimensions of the drawing are made up: the paper's drawing is not in its text.",
            data.ball_diameter_mm, data.table_iii.gyration_radius_mm, data.table_iii.contact_radius_mm
        )
    }

    fn run(_quality: Quality, progress: &dyn Progress) -> Result<Fig08Data, ExperimentError> {
        progress.start(1, "checks");
        let table_iii = paper::table_three()?;
        let gravity = paper::section_five()?.gravity_m_per_s2;
        let radius_mm = 0.5 * BALL_DIAMETER_MM;
        let radius = 1e-3 * radius_mm;
        let mass = |density: f64| density * (4.0 / 3.0) * PI * radius * radius * radius;
        let weight = |density: f64| 1e3 * gravity * mass(density);
        let contact = table_iii.contact_radius_mm;
        progress.advance(1);
        Ok(Fig08Data {
            ball_diameter_mm: BALL_DIAMETER_MM,
            steel_density_kg_per_m3: STEEL_DENSITY,
            steel_densities_kg_per_m3: STEEL_DENSITIES,
            gravity_m_per_s2: gravity,
            ball_mass_kg: mass(STEEL_DENSITY),
            ball_weight_mn: weight(STEEL_DENSITY),
            ball_weights_mn: STEEL_DENSITIES.map(weight),
            gyration_radius_mm: 0.4_f64.sqrt() * radius_mm,
            contact_angle_rad: bouncing_disk::core::elementary::asin(contact / radius_mm),
            contact_depth_mm: radius_mm - (radius_mm * radius_mm - contact * contact).sqrt(),
            preloads_mn: PRELOADS_MN,
            preload_accelerations_m_per_s2: PRELOADS_MN.map(|preload| 1e-3 * preload / mass(STEEL_DENSITY)),
            preload_acceleration_range_m_per_s2: PRELOAD_ACCELERATIONS,
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
    let printed = data.table_iii.gyration_radius_mm.to_string();
    let gravity = data.gravity_m_per_s2;
    let [low, high] = data.preload_accelerations_m_per_s2;
    let [least, most] = data.preload_acceleration_range_m_per_s2;
    let density = format!(
        "density of steel {} kg/m³, an assumption: the paper gives none; from {} to {} kg/m³ the ball weighs {:.0} to {:.0} mN",
        data.steel_density_kg_per_m3,
        data.steel_densities_kg_per_m3[0],
        data.steel_densities_kg_per_m3[1],
        data.ball_weights_mn[0],
        data.ball_weights_mn[1]
    );
    let fits = PrintedNumber::read(&printed).is_some();
    vec![
        Claim::number(
            id,
            "Table III",
            "a_g of a steel ball of 20 mm diameter",
            "mm",
            printed,
            data.gyration_radius_mm,
        )
        .note(if fits { "sqrt(2/5) of the radius: a homogeneous sphere" } else { "not a number" }),
        Claim::statement(
            id,
            "Sec. V B",
            "the preloads from 80 to 280 are possible with the ball's own weight as full preload, read in mN",
            data.preloads_mn[1] < data.ball_weights_mn[0] && least <= low && high <= most && high < gravity,
            format!(
                "the ball weighs {:.1} mN ({density}); over its mass the preloads are g = {low:.2} to {high:.2} m/s², inside \
                 the simulated {least} to {most} m/s². The printed unit, mNm, is that of a torque",
                data.ball_weight_mn
            ),
        ),
    ]
}
