//! Fig. 2: trajectories of a tossing hand or a stator.

mod picture;

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

use bouncing_disk::core::elementary::{asin, sin, tan};
use bouncing_disk::{Platform, Stroke};
use serde::{Deserialize, Serialize};

use super::hand_path::HandPath;
use crate::claim::Claim;
use crate::experiment::{Experiment, ExperimentError, Quality};
use crate::paper;
use crate::progress::Progress;
use bouncing_disk_plot::Figure;

/// The shape of a path does not depend on its size: the contact radius is 1 m here, the stroke this many of it.
const CONTACT_RADIUS: f64 = 1.0;
const STROKE: f64 = 1.5;

/// Any frequency gives the same path.
const ANGULAR_FREQUENCY: f64 = 1.0;

/// θ of (a)–(c) and φ_L of (d)–(f): for (a) Sec. IV A names θ, for (c) Sec. III B; the others are not in the text.
const PHASE_LAGS: [f64; 3] = [-FRAC_PI_2, -FRAC_PI_4, 0.0];
const AMPLITUDE_ANGLES: [f64; 3] = [0.05 * PI, 0.25 * PI, 0.45 * PI];

/// Quantities that should vanish or agree do so within this share: a hundred roundings.
const ROUNDING: f64 = 100.0 * f64::EPSILON;

/// Fig. 2.
#[derive(Debug)]
pub struct Fig02;

/// The data of Fig. 2; lengths in units of the contact radius.
#[derive(Debug, Serialize, Deserialize)]
pub struct Fig02Data {
    stroke_over_contact_radius: f64,
    panels: Vec<Trajectory>,
}

/// One trajectory.
#[derive(Debug, Serialize, Deserialize)]
struct Trajectory {
    phase_lag_rad: f64,
    amplitude_angle_rad: f64,
    amplitude_over_contact_radius: f64,
    twist_amplitude_rad: f64,
    /// Lengths of the path are in units of the contact radius.
    path: HandPath,
    /// On the unrolled cylinder, in units of the contact radius squared; from the points of the path.
    enclosed_area: f64,
    /// π A a_e Φ sin θ, the same in closed form but for the sense.
    area_of_ellipse: f64,
    /// Minor over major axis of the ellipse on the unrolled cylinder.
    axis_ratio: f64,
}

impl Trajectory {
    fn new(phase_lag: f64, amplitude_angle: f64, intervals: u32) -> Result<Self, ExperimentError> {
        let stroke = Stroke {
            stroke: STROKE,
            amplitude_angle,
            contact_radius: CONTACT_RADIUS,
            angular_frequency: ANGULAR_FREQUENCY,
            phase_lag,
        };
        let platform = Platform::from_stroke(stroke).map_err(ExperimentError::model)?;
        let path = HandPath::new(&platform, intervals)?;
        let (up, across) = (platform.amplitude(), CONTACT_RADIUS * platform.twist_amplitude());
        let product = up * across * sin(phase_lag);
        // The axes p, q of the ellipse satisfy p² + q² = A² + (a_e Φ)² and p q = A a_e Φ |sin θ|.
        let doubled = (2.0 * product.abs() / (up * up + across * across)).min(1.0);
        Ok(Self {
            phase_lag_rad: phase_lag,
            amplitude_angle_rad: amplitude_angle,
            amplitude_over_contact_radius: up,
            twist_amplitude_rad: platform.twist_amplitude(),
            enclosed_area: path.enclosed_area(CONTACT_RADIUS),
            area_of_ellipse: PI * product,
            axis_ratio: tan(0.5 * asin(doubled)),
            path,
        })
    }
}

fn pi(angle: f64) -> String {
    format!("{:.2}π", angle / PI)
}

impl Experiment for Fig02 {
    type Data = Fig02Data;

    const ID: &'static str = "fig02";

    const TITLE: &'static str = "Trajectories of tossing hands and stators";
    const READING: &str = include_str!("fig02/reading.md");

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

    fn run(quality: Quality, progress: &dyn Progress) -> Result<Fig02Data, ExperimentError> {
        let intervals = quality.choose(120, 720);
        let printed_angle = paper::value("section1.amplitude_angle_of_fig2_abc")?;
        let printed_lag = paper::value("section1.phase_lag_of_fig2_def")?;
        let lags = PHASE_LAGS.map(|lag| (lag, printed_angle));
        let ratios = AMPLITUDE_ANGLES.map(|angle| (printed_lag, angle));
        progress.start((lags.len() + ratios.len()) as u64, "trajectories");
        let mut panels = Vec::new();
        for (lag, angle) in lags.into_iter().chain(ratios) {
            panels.push(Trajectory::new(lag, angle, intervals)?);
            progress.advance(1);
        }
        Ok(Fig02Data { stroke_over_contact_radius: STROKE / CONTACT_RADIUS, panels })
    }

    fn draw(data: &Fig02Data) -> Result<Figure, ExperimentError> {
        Ok(picture::figure(data))
    }

    fn claims(data: &Fig02Data) -> Vec<Claim> {
        claims(data)
    }

    fn parameters(data: &Fig02Data) -> Vec<(String, String)> {
        let list = |values: &mut dyn Iterator<Item = f64>| values.map(pi).collect::<Vec<_>>().join(", ");
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

fn claims(data: &Fig02Data) -> Vec<Claim> {
    let panels = &data.panels;
    let ratio_fault = panels
        .iter()
        .map(|panel| {
            let ratio = panel.twist_amplitude_rad / panel.amplitude_over_contact_radius;
            (ratio / tan(panel.amplitude_angle_rad) - 1.0).abs()
        })
        .fold(0.0, f64::max);
    let ratios: Vec<_> = panels
        .iter()
        .map(|panel| format!("{}: {:.3}", pi(panel.amplitude_angle_rad), tan(panel.amplitude_angle_rad)))
        .collect();
    let shapes: Vec<_> = panels
        .iter()
        .map(|panel| {
            format!(
                "θ = {}, φ_L = {}: {:.4}, {:.4} a_e²",
                pi(panel.phase_lag_rad),
                pi(panel.amplitude_angle_rad),
                panel.axis_ratio,
                panel.enclosed_area.abs()
            )
        })
        .collect();
    let family = match &panels[..] {
        [ellipse, semi, line, low, middle, high] => Some(
            line.axis_ratio <= ROUNDING
                && line.enclosed_area.abs() <= ROUNDING
                && semi.axis_ratio > line.axis_ratio
                && ellipse.axis_ratio > semi.axis_ratio
                && low.axis_ratio > 0.0
                && middle.axis_ratio > low.axis_ratio
                && high.axis_ratio > 0.0
                && middle.axis_ratio > high.axis_ratio,
        ),
        _ => None,
    };
    vec![
        Claim::printed_statement(
            "section1.amplitude_ratio",
            (!panels.is_empty()).then_some(ratio_fault <= ROUNDING),
            format!(
                "L at the six φ_L: {}; largest relative difference of a_e Φ/A from tan φ_L: {ratio_fault:.1e}",
                ratios.join(", ")
            ),
        ),
        Claim::printed_statement(
            "section1.family_of_motions",
            family,
            format!(
                "minor over major axis and enclosed area of the ellipse on the unrolled cylinder: {}. The curve of θ = 0 \
                 encloses nothing, an ellipse is widest at θ = −π/2, the semielliptical curves lie between",
                shapes.join("; ")
            ),
        ),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::progress::Silent;

    /// The polygon of n points of an ellipse has sin(2π/n)/(2π/n) of its area.
    #[test]
    fn the_path_encloses_the_area_of_its_ellipse() {
        let data = Fig02::run(Quality::Paper, &Silent).expect("runs");
        for panel in &data.panels {
            let step = 2.0 * PI / (panel.path.phase_rad.len() - 1) as f64;
            let polygon = panel.area_of_ellipse.abs() * sin(step) / step;
            assert!((panel.enclosed_area.abs() - polygon).abs() < 1e-13, "{panel:?}");
        }
    }
}
