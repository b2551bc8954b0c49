//! Fig. 2: trajectories of a tossing hand or a stator.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

use bouncing_disk::Platform;
use bouncing_disk::parameters::Stroke as HandStroke;
use bouncing_disk_plot::{Anchor, Camera, Colour, Drawing, Figure, Grid, Margins, Rect, Stroke, TextStyle};
use glam::DVec3;
use serde::Serialize;

use super::shared::cylinder::{Cylinder, HandPath, curve, faint, polar};
use crate::claims::paper;
use crate::experiment::{ExperimentError, Paper};

/// The stroke c in contact radii. The shape of a path does not depend on its size.
const STROKE: f64 = 1.5;

/// θ of (a)–(c) and φ_L of (d)–(f): for (a) Sec. IV A names θ, for (c) Sec. III B; the others are not in the
/// text.
const PHASE_LAGS: [f64; 3] = [-FRAC_PI_2, -FRAC_PI_4, 0.0];
const AMPLITUDE_ANGLES: [f64; 3] = [0.05 * PI, 0.25 * PI, 0.45 * PI];

/// One trajectory; lengths are in contact radii.
#[derive(Debug, Serialize)]
struct Trajectory {
    phase_lag_rad: f64,
    amplitude_angle_rad: f64,
    path: HandPath,
}

/// Fig. 2.
pub(crate) fn fig02(fig: &mut Paper<'_>) -> Result<(), ExperimentError> {
    let intervals = fig.quality.choose(120, 720);
    let angle_of_upper_row = paper::value("section1.amplitude_angle_of_fig2_abc")?;
    let lag_of_lower_row = paper::value("section1.phase_lag_of_fig2_def")?;
    let upper = PHASE_LAGS.map(|lag| (lag, angle_of_upper_row));
    let lower = AMPLITUDE_ANGLES.map(|angle| (lag_of_lower_row, angle));
    let trajectories = upper.into_iter().chain(lower).map(|(phase_lag, amplitude_angle)| {
        // Any contact radius and any frequency give the same path.
        let stroke = HandStroke {
            stroke: STROKE,
            amplitude_angle,
            contact_radius: 1.0,
            angular_frequency: 1.0,
            phase_lag,
        };
        let path = HandPath::new(&Platform::from_stroke(stroke)?, intervals)?;
        Ok(Trajectory { phase_lag_rad: phase_lag, amplitude_angle_rad: amplitude_angle, path })
    });
    let panels = trajectories.collect::<Result<Vec<_>, ExperimentError>>()?;
    fig.record("stroke_over_contact_radius", &STROKE)?;
    fig.record("panels", &panels)?;

    fig.caption(format!(
        "Potential dough-tossing motions and stator trajectories, Eq. (1) on the cylinder of radius a_e: (a)–(c) the effect of \
         the phase lag θ with φ_L = π/4, (d)–(f) of the amplitude ratio L = tan φ_L with θ = −π/4. Dot: τ = 0; arrowheads: \
         sense of the motion; dotted: behind the cylinder. The text gives θ for (a), −π/2, and (c), 0; the θ of \
         (b), the φ_L of (d)–(f) and the stroke c = {} a_e are chosen here. (b) and (e) show the same motion.",
        STROKE
    ));
    let list = |of: fn(&Trajectory) -> f64| {
        panels.iter().map(|panel| format!("{:.2}π", of(panel) / PI)).collect::<Vec<_>>().join(", ")
    };
    fig.parameter("phase lag θ of (a)–(f)", list(|panel| panel.phase_lag_rad));
    fig.parameter("amplitude angle φ_L of (a)–(f)", list(|panel| panel.amplitude_angle_rad));
    fig.parameter("stroke c", format!("{STROKE} a_e"));

    let margins = Margins { left: 2.0, right: 2.0, top: 4.0, bottom: 2.0 };
    let grid = Grid::new(WIDTH, HEIGHT, 2, 3).margins(margins).gaps(2.0, 6.0);
    let mut figure = Figure::new(WIDTH, HEIGHT);
    for (index, (trajectory, name)) in panels.iter().zip(NAMES).enumerate() {
        figure = figure.drawing(panel(trajectory, index, name, grid.cell(index / 3, index % 3)));
    }
    fig.draw(figure);
    Ok(())
}

const WIDTH: f64 = 340.0;
const HEIGHT: f64 = 306.0;
/// Azimuth and elevation of the eye (rad) and its distance in contact radii.
const AZIMUTH: f64 = 0.15;
const ELEVATION: f64 = 0.45;
const DISTANCE: f64 = 9.0;
/// Half the length of the cylinders, in contact radii.
const HALF_LENGTH: f64 = 1.6;
/// The length of the arrowheads in points, and where they are, as shares of the period.
const HEAD: f64 = 8.0;
const HEADS: [f64; 2] = [0.15, 0.65];

/// Where the name of the dot stands, from the dot, so that it meets no curve.
type Name = ((f64, f64), Anchor);

/// See [`Name`]; in the order of the panels.
const NAMES: [Name; 6] = [
    ((0.14, 0.14), Anchor::LeftCentre),
    ((0.10, -0.24), Anchor::LeftCentre),
    ((0.08, -0.18), Anchor::LeftCentre),
    ((-0.10, -0.16), Anchor::RightCentre),
    ((0.10, -0.24), Anchor::LeftCentre),
    ((0.04, 0.20), Anchor::LeftCentre),
];

fn panel(data: &Trajectory, index: usize, (place, anchor): Name, area: Rect) -> Drawing {
    let camera = Camera::around(DVec3::ZERO, AZIMUTH, ELEVATION, DISTANCE);
    let cylinder = Cylinder { radius: 1.0, bottom: -HALF_LENGTH, top: HALF_LENGTH };
    let drawing = Drawing::with_equal_scales(area, (-1.25, 1.25), (-2.5, 2.05));
    let mut drawing = cylinder.of_glass(drawing, &camera, 0.6, Stroke::new(Colour::GREY, 0.6));
    let stroke = Stroke::new(Colour::BLUE, 1.5);
    drawing = curve(drawing, cylinder.runs(&camera, data.path.points()), stroke);
    for share in HEADS {
        for run in cylinder.runs(&camera, data.path.before(share, 3)) {
            let stroke = if run.in_view { stroke } else { faint(stroke) };
            drawing = drawing.arrow_with_head(run.points, stroke, HEAD);
        }
    }
    if let Some((angle, height)) = data.path.points().next() {
        let at = camera.project(polar(1.0, angle, height));
        let colour = if cylinder.shows(&camera, angle) { Colour::BLACK } else { Colour::GREY };
        drawing = drawing.ellipse(at, (0.06, 0.06), colour).text(
            (at.0 + place.0, at.1 + place.1),
            TextStyle::new(anchor).size(8.0),
            r"$\tau = 0$",
        );
    }
    let number = |angle: f64| match format!("{:.2}", angle / PI).trim_end_matches('0').trim_end_matches('.') {
        "0" => "0".to_owned(),
        "0.25" => r"\pi/4".to_owned(),
        "-0.25" => r"-\pi/4".to_owned(),
        "-0.5" => r"-\pi/2".to_owned(),
        other => format!(r"{other}\pi"),
    };
    let below =
        format!(r"$\theta = {},\;\phi_L = {}$", number(data.phase_lag_rad), number(data.amplitude_angle_rad));
    let corner = drawing.local((area.left + 2.0, area.top + 6.0));
    let foot = drawing.local((area.left + 0.5 * area.width, area.bottom() - 4.0));
    drawing.text(foot, Anchor::Middle, below).text(
        corner,
        Anchor::LeftCentre,
        ["(a)", "(b)", "(c)", "(d)", "(e)", "(f)"][index],
    )
}
