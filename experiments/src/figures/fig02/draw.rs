//! The drawing of Fig. 2.

use std::f64::consts::PI;

use bouncing_disk_plot::{
    Anchor, Camera, Colour, Dash, Drawing, Figure, Grid, Margins, Path, Rect, Stroke, TextStyle,
};
use glam::DVec3;

use super::data::{Fig02Data, Trajectory};
use crate::figures::cylinder::{Cylinder, Look, curve, faint, polar};

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

pub(super) fn draw(data: &Fig02Data) -> Figure {
    let margins = Margins { left: 2.0, right: 2.0, top: 4.0, bottom: 2.0 };
    let grid = Grid::new(WIDTH, HEIGHT, 2, 3).margins(margins).gaps(2.0, 6.0);
    let letters = ["a", "b", "c", "d", "e", "f"];
    let panels = data.panels.iter().zip(letters.into_iter().zip(NAMES)).enumerate();
    panels.fold(Figure::new(WIDTH, HEIGHT), |figure, (index, (trajectory, (letter, name)))| {
        figure.drawing(panel(trajectory, letter, name, grid.cell(index / 3, index % 3)))
    })
}
