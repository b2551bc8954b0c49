//! Fig. 2: trajectories of a tossing hand or a stator.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

use bouncing_disk::Platform;
use bouncing_disk::parameters::Stroke as HandStroke;
use bouncing_disk_plot::{
    Anchor, Camera, Colour, Dash, Drawing, Figure, Grid, Margins, Path, Rect, Stroke, TextStyle,
};
use glam::DVec3;
use serde::Serialize;

use super::shared::cylinder::{Cylinder, HandPath, Look, curve, faint, polar};
use crate::claims::paper;
use crate::experiment::{ExperimentError, Paper, named};

/// Fig. 2.
pub(crate) fn fig02(fig: &mut Paper<'_>) -> Result<(), ExperimentError> {
    let (quality, progress) = (fig.quality, fig.progress);
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
    let data = &Fig02Data { stroke_over_contact_radius: STROKE / CONTACT_RADIUS, panels };
    fig.caption(format!(
        "Potential dough-tossing motions and stator trajectories, Eq. (1) on the cylinder of radius a_e in \
         perspective: (a)–(c) the effect of the phase lag θ with φ_L = π/4, and (d)–(f) the effect of the amplitude \
         ratio L = tan φ_L with θ = −π/4. The dot is the point at τ = 0, the arrowheads show the sense of the motion; \
         what lies behind the cylinder is lighter and dotted; thin lines: mean height and β = 0. The text gives θ only \
         for (a), −π/2 (elliptical, Sec. IV A), and for (c), 0 (linear, Sec. III B); −π/4 for the semielliptical (b), \
         φ_L = 0.05π, 0.25π and 0.45π for (d)–(f), and the stroke c = {} a_e are choices made here. (b) and (e) show the same motion: the paper's \
         caption gives φ_L = π/4 to the upper row and θ = −π/4 to the lower one, and the middle panels of both rows have these two.",
        data.stroke_over_contact_radius
    ));
    fig.parameters(parameters(data));
    fig.draw(draw(data)?);
    fig.data(data)
}

fn parameters(data: &Fig02Data) -> Vec<(String, String)> {
    let list = |values: &mut dyn Iterator<Item = f64>| {
        values.map(|angle| format!("{:.2}π", angle / PI)).collect::<Vec<_>>().join(", ")
    };
    let panels = &data.panels;
    named([
        ("phase lag θ of (a)–(f)", list(&mut panels.iter().map(|panel| panel.phase_lag_rad))),
        ("amplitude angle φ_L of (a)–(f)", list(&mut panels.iter().map(|panel| panel.amplitude_angle_rad))),
        ("stroke c", format!("{} a_e", data.stroke_over_contact_radius)),
    ])
}

fn draw(data: &Fig02Data) -> Result<Figure, ExperimentError> {
    let margins = Margins { left: 2.0, right: 2.0, top: 4.0, bottom: 2.0 };
    let grid = Grid::new(WIDTH, HEIGHT, 2, 3).margins(margins).gaps(2.0, 6.0);
    let letters = ["a", "b", "c", "d", "e", "f"];
    let panels = data.panels.iter().zip(letters.into_iter().zip(NAMES)).enumerate();
    Ok(panels.fold(Figure::new(WIDTH, HEIGHT), |figure, (index, (trajectory, (letter, name)))| {
        figure.drawing(panel(trajectory, letter, name, grid.cell(index / 3, index % 3)))
    }))
}

/// The data of Fig. 2; lengths in units of the contact radius.
#[derive(Debug, Serialize)]
pub(crate) struct Fig02Data {
    stroke_over_contact_radius: f64,
    panels: Vec<Trajectory>,
}

/// One trajectory.
#[derive(Debug, Serialize)]
struct Trajectory {
    phase_lag_rad: f64,
    amplitude_angle_rad: f64,
    /// Lengths of the path are in units of the contact radius.
    path: HandPath,
}

/// The shape of a path does not depend on its size: the contact radius is 1 m here, the stroke this many of
/// it.
const CONTACT_RADIUS: f64 = 1.0;
const STROKE: f64 = 1.5;

/// Any frequency gives the same path.
const ANGULAR_FREQUENCY: f64 = 1.0;

/// θ of (a)–(c) and φ_L of (d)–(f): for (a) Sec. IV A names θ, for (c) Sec. III B; the others are not in the
/// text.
const PHASE_LAGS: [f64; 3] = [-FRAC_PI_2, -FRAC_PI_4, 0.0];
const AMPLITUDE_ANGLES: [f64; 3] = [0.05 * PI, 0.25 * PI, 0.45 * PI];

impl Trajectory {
    fn new(phase_lag: f64, amplitude_angle: f64, intervals: u32) -> Result<Self, ExperimentError> {
        let stroke = HandStroke {
            stroke: STROKE,
            amplitude_angle,
            contact_radius: CONTACT_RADIUS,
            angular_frequency: ANGULAR_FREQUENCY,
            phase_lag,
        };
        let platform = Platform::from_stroke(stroke)?;
        let path = HandPath::new(&platform, intervals)?;
        Ok(Self { phase_lag_rad: phase_lag, amplitude_angle_rad: amplitude_angle, path })
    }
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

fn panel(data: &Trajectory, letter: &str, name: Name, area: Rect) -> Drawing {
    let camera = Camera::around(DVec3::ZERO, AZIMUTH, ELEVATION, DISTANCE);
    let cylinder = Cylinder { radius: 1.0, bottom: -HALF_LENGTH, top: HALF_LENGTH };
    let look = Look {
        side: Colour::PALE_GREY,
        face: Colour::WHITE,
        opacity: 0.6,
        edge: Stroke::new(Colour::GREY, 0.7),
        through: true,
    };
    let thin = Stroke::new(Colour::GREY, 0.6);
    let mut drawing = Drawing::with_equal_scales(area, (-1.25, 1.25), (-2.5, 2.05));
    drawing = cylinder.drawn(drawing, &camera, &look);
    let level = (0..=360).map(|step| (AZIMUTH + f64::from(step).to_radians(), 0.0));
    drawing = curve(drawing, cylinder.runs(&camera, level), thin);
    let upright = [-HALF_LENGTH, HALF_LENGTH].map(|height| camera.project(polar(1.0, 0.0, height)));
    drawing = drawing.stroke(Path::through(upright), thin.dashed(Dash::DashDotted));
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
        let (place, anchor) = name;
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
    drawing.text(foot, Anchor::Middle, below).text(corner, Anchor::LeftCentre, format!("({letter})").as_str())
}
