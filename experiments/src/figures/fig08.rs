//! Fig. 8: the geometry of the ultrasonic motor.

use std::f64::consts::{FRAC_PI_2, TAU};

use bouncing_disk::core::numerics::elementary::sin_cos;
use bouncing_disk_plot::{
    Anchor, Camera, Colour, Dash, Drawing, Figure, Fill, Path, Rect, SINGLE_COLUMN, Stroke, Style, TextStyle,
};
use glam::DVec3;

use super::shared::cylinder::{Cylinder, Look, arc, polar};
use crate::claims::paper;
use crate::experiment::{ExperimentError, Paper};

/// The printed dimensions (mm), and how far the ball reaches into the circle of contact.
#[derive(Clone, Copy, Debug)]
struct Ball {
    diameter: f64,
    radius: f64,
    contact_radius: f64,
    depth: f64,
}

/// Fig. 8.
pub(crate) fn fig08(fig: &mut Paper<'_>) -> Result<(), ExperimentError> {
    let table_iii = paper::table_three()?;
    let diameter = 1e3 * paper::section_five()?.rotor_diameter_m;
    let (radius, contact_radius) = (0.5 * diameter, table_iii.contact_radius_mm);
    let gyration_radius = table_iii.gyration_radius_mm;
    let depth = radius - (radius * radius - contact_radius * contact_radius).sqrt();
    fig.record("table_iii", &table_iii)?;
    fig.record("ball_diameter_mm", &diameter)?;
    fig.record("contact_depth_mm", &depth)?;

    fig.caption(format!(
        "Geometric details of the ultrasonic motor, not to scale. The rotor is a steel ball of {} mm diameter, radius of gyration \
         a_g = {} mm. The stator, a pretwisted beam on an axially poled piezoelectric transducer, touches it along a circle of \
         radius a_e = {} mm (enlarged). At a resonance its tip moves as in Eq. (1), s up and down and β about the axis. A magnet \
         above the ball reduces the preload mg; g is the remaining acceleration. All other dimensions are made up.",
        diameter, gyration_radius, contact_radius
    ));
    fig.parameter("ball diameter", format!("{diameter} mm"));
    fig.parameter("contact radius a_e", format!("{contact_radius} mm"));
    fig.parameter("radius of gyration a_g", format!("{gyration_radius} mm"));

    let ball = Ball { diameter, radius, contact_radius, depth };
    let shown = Rect::new(2.0, 2.0, SINGLE_COLUMN - 4.0, HEIGHT - 4.0);
    fig.draw(Figure::new(SINGLE_COLUMN, HEIGHT).drawing(motor(ball, shown)).drawing(contact(ball, CONTACT)));
    Ok(())
}

const HEIGHT: f64 = 262.0;
/// Azimuth and elevation of the eye (rad), its distance, and all lengths but the ball's and a_e's: made up,
/// in mm.
const AZIMUTH: f64 = 0.5;
const ELEVATION: f64 = 0.25;
const DISTANCE: f64 = 260.0;
const BEAM_LENGTH: f64 = 26.0;
const TRANSDUCER: (f64, f64) = (9.0, 10.0);
const MAGNET: (f64, f64) = (5.0, 7.0);
const MAGNET_GAP: f64 = 5.0;
/// Where the enlarged contact is drawn.
const CONTACT: Rect = Rect::new(SINGLE_COLUMN - 92.0, 86.0, 88.0, 74.0);

fn black() -> Stroke {
    Stroke::new(Colour::BLACK, 0.7)
}

/// Leaders and auxiliary lines.
fn fine() -> Stroke {
    Stroke::new(Colour::GREY, 0.5)
}

fn chain() -> Stroke {
    Stroke::new(Colour::DARK_GREY, 0.6).dashed(Dash::DashDotted)
}

fn small(anchor: Anchor) -> TextStyle {
    TextStyle::new(anchor).size(8.0)
}

fn look(colour: Colour) -> Look {
    Look {
        side: colour.mixed(Colour::WHITE, 0.45),
        face: colour.mixed(Colour::WHITE, 0.75),
        opacity: 1.0,
        edge: black(),
        through: false,
    }
}

/// A beam of rectangular cross-section whose section turns uniformly with height.
#[derive(Clone, Copy, Debug)]
struct Beam {
    half_width: f64,
    half_thickness: f64,
    bottom: f64,
    top: f64,
    /// Turn of the section at the bottom, and from there to the top (rad).
    turned: f64,
    twist: f64,
}

impl Beam {
    const SLICES: u32 = 40;

    fn corner(&self, index: usize, share: f64) -> DVec3 {
        let (across, along) = [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)][index % 4];
        let (across, along) = (across * self.half_width, along * self.half_thickness);
        let (sine, cosine) = sin_cos(self.turned + share * self.twist);
        let height = self.bottom + share * (self.top - self.bottom);
        DVec3::new(cosine * across - sine * along, sine * across + cosine * along, height)
    }

    /// The normal of a slice's face, and whether the face is turned to the eye.
    fn face(&self, camera: &Camera, side: usize, (low, high): (f64, f64)) -> (DVec3, bool) {
        let from = self.corner(side, low);
        let normal = (self.corner(side + 1, low) - from).cross(self.corner(side, high) - from);
        (normal.normalize_or_zero(), camera.faces(from, normal))
    }

    /// The faces turned to the eye, slice by slice from below, then their edges and the upper face.
    fn drawn(&self, mut drawing: Drawing, camera: &Camera, colour: Colour, edge: Stroke) -> Drawing {
        let share = |slice: u32| f64::from(slice) / f64::from(Self::SLICES);
        let slices = (0..Self::SLICES).map(|slice| (share(slice), share(slice + 1)));
        let shown = |index: usize, share: f64| camera.project(self.corner(index, share));
        let towards = camera.eye().normalize_or_zero();
        for (low, high) in slices.clone() {
            for side in 0..4 {
                let (normal, true) = self.face(camera, side, (low, high)) else { continue };
                let corners = [(side, low), (side + 1, low), (side + 1, high), (side, high)];
                let shade = colour.mixed(Colour::WHITE, 0.25 + 0.55 * normal.dot(towards).max(0.0));
                let face = Path::through(corners.map(|(index, share)| shown(index, share))).close();
                // The hairline closes the seam between slices.
                drawing = drawing.fill(face.clone(), shade, 1.0).stroke(face, Stroke::new(shade, 0.3));
            }
        }
        for index in 0..4 {
            for (low, high) in slices.clone() {
                // An edge belongs to two faces.
                if [index, index + 3].into_iter().any(|side| self.face(camera, side, (low, high)).1) {
                    let ends = [low, high].map(|share| shown(index, share));
                    drawing = drawing.stroke(Path::through(ends), edge);
                }
            }
        }
        for side in (0..4).filter(|side| self.face(camera, *side, (0.0, share(1))).1) {
            drawing = drawing.stroke(Path::through([shown(side, 0.0), shown(side + 1, 0.0)]), edge);
        }
        let top = Path::through((0..4).map(|index| shown(index, 1.0))).close();
        drawing.fill(top.clone(), colour.mixed(Colour::WHITE, 0.7), 1.0).stroke(top, edge)
    }
}

fn motor(ball: Ball, area: Rect) -> Drawing {
    let camera = Camera::around(DVec3::ZERO, AZIMUTH, ELEVATION, DISTANCE);
    let radius = ball.radius;
    // The ball's centre is the origin; the circle of contact lies below it.
    let tip = ball.depth - radius;
    let foot = tip - BEAM_LENGTH;
    let mut drawing = Drawing::with_equal_scales(area, (-16.5, 33.0), (-51.0, 27.0));
    let at = |height: f64| camera.project(DVec3::new(0.0, 0.0, height));
    let transducer = Cylinder { radius: TRANSDUCER.0, bottom: foot - TRANSDUCER.1, top: foot };
    drawing = transducer.drawn(drawing, &camera, &look(Colour::ORANGE));
    let beam = Beam {
        half_width: 4.2,
        half_thickness: 1.6,
        bottom: foot,
        top: tip,
        turned: AZIMUTH - 0.2,
        twist: FRAC_PI_2,
    };
    drawing = beam.drawn(drawing, &camera, Colour::GREY, Stroke::new(Colour::DARK_GREY, 0.6));
    // The ball's centre is also that of the picture.
    let steel = Style::from(black()).fill(Colour::SKY.mixed(Colour::WHITE, 0.55));
    let gleam = Fill::new(Colour::WHITE, 0.8);
    drawing = drawing.ellipse((0.0, 0.0), (radius, radius), steel);
    drawing = drawing.ellipse((-0.35 * radius, 0.4 * radius), (0.22 * radius, 0.16 * radius), gleam);
    let magnet_foot = radius + MAGNET_GAP;
    let magnet = Cylinder { radius: MAGNET.0, bottom: magnet_foot, top: magnet_foot + MAGNET.1 };
    drawing = drawing.stroke(Path::through([at(magnet.top), at(magnet.top + 5.0)]), chain());
    drawing = magnet.drawn(drawing, &camera, &look(Colour::VERMILION));
    let turn = arc(&camera, 0.62 * radius, (AZIMUTH - 1.1, AZIMUTH + 1.1), 0.0);
    let preload = [(0.0, 0.75 * radius), (0.0, 0.04 * radius)];
    drawing = drawing
        .stroke(Path::through([at(radius), at(magnet.bottom - 1.2)]), chain())
        .arrow(turn, Stroke::new(Colour::BLACK, 0.9))
        .text((0.0, -0.47 * radius), Anchor::Centre, r"$\alpha$")
        .arrow(preload, Stroke::new(Colour::VERMILION, 1.4));
    drawing = sizes(drawing, ball, &camera, tip);
    let middle = 0.5 * (transducer.top + transducer.bottom);
    let front = |height: f64| camera.project(polar(TRANSDUCER.0, AZIMUTH, height));
    drawing = drawing
        .arrow([front(middle - 3.0), front(middle + 2.2)], Stroke::new(Colour::BLACK, 1.1))
        .text((front(middle).0 + 1.2, front(middle).1), small(Anchor::LeftCentre), "poling");
    drawing = source(drawing, &camera, &transducer);
    let edge = drawing.local((CONTACT.left + 2.0, CONTACT.top + 0.5 * CONTACT.height));
    drawing = drawing
        .ellipse((0.0, at(tip).1), (2.2, 1.6), fine())
        .stroke(Path::through([(2.2, at(tip).1), edge]), fine());
    // The names of the parts: from where, to which height, and the words.
    let level = |height: f64| at(height).1;
    let names: [(_, _, &[&str]); 5] = [
        ((4.0, level(magnet.top - 3.0)), level(magnet.top - 1.0), &["magnet", "(reduces the preload)"]),
        ((0.7, 0.45 * radius), 10.5, &["preload $mg$"]),
        ((0.80 * radius, 0.35 * radius), 6.0, &["steel ball (rotor)"]),
        ((3.0, level(foot + 8.0)), level(foot + 6.0), &["pretwisted beam", "(stator)"]),
        ((7.5, level(foot - 5.0)), level(foot - 5.0), &["piezoelectric", "transducer,", "axially poled"]),
    ];
    for (from, height, lines) in names {
        drawing = drawing.stroke(Path::through([from, (16.0, height)]), fine());
        for (index, line) in lines.iter().enumerate() {
            let at = (17.0, height - 3.4 * index as f64);
            drawing = drawing.text(at, small(Anchor::LeftCentre), *line);
        }
    }
    drawing
}

/// The diameter of the ball, and how the tip of the beam moves.
fn sizes(mut drawing: Drawing, Ball { diameter, radius, .. }: Ball, camera: &Camera, tip: f64) -> Drawing {
    let side = -radius - 3.2;
    for height in [-radius, radius] {
        drawing = drawing.stroke(Path::through([(0.0, height), (side - 1.0, height)]), fine());
    }
    let style = TextStyle::new(Anchor::Middle).size(8.5).rotated(90.0);
    drawing = drawing.double_arrow((side, -radius), (side, radius), black()).text(
        (side - 2.0, 0.0),
        style,
        format!("{diameter} mm").as_str(),
    );
    let swing = arc(camera, 6.6, (AZIMUTH - 0.75, AZIMUTH + 0.75), tip - 4.0);
    let back: Vec<_> = swing.iter().rev().copied().collect();
    let middle = swing[swing.len() / 2];
    let (lift, level) = (-9.0, camera.project(DVec3::new(0.0, 0.0, tip)).1);
    drawing
        .arrow(swing, black())
        .arrow(back, black())
        .text((middle.0, middle.1 - 2.3), Anchor::Centre, r"$\beta$")
        .double_arrow((lift, level - 9.0), (lift, level - 3.0), black())
        .text((lift - 1.0, level - 6.0), Anchor::RightCentre, "$s$")
}

/// A sinusoidal voltage between the faces of the transducer.
fn source(drawing: Drawing, camera: &Camera, transducer: &Cylinder) -> Drawing {
    let side = |height: f64| camera.project(polar(transducer.radius, AZIMUTH - FRAC_PI_2, height));
    let (top, bottom) = (side(transducer.top - 0.6), side(transducer.bottom + 0.6));
    let (x, middle) = (top.0 - 4.0, 0.5 * (top.1 + bottom.1));
    let size = 2.1;
    let wave = (0..=24).map(|step| {
        let share = f64::from(step) / 24.0;
        (x + size * 0.7 * (2.0 * share - 1.0), middle + 0.45 * size * sin_cos(TAU * share).0)
    });
    drawing
        .stroke(Path::through([top, (x, top.1), (x, middle + size)]), black())
        .stroke(Path::through([bottom, (x, bottom.1), (x, middle - size)]), black())
        .ellipse((x, middle), (size, size), Style::from(black()).fill(Colour::WHITE))
        .stroke(Path::through(wave), black())
}

/// The circle of contact, enlarged: a cut through the axis with the ball above the tip of the stator.
fn contact(Ball { radius, contact_radius: touch, depth, .. }: Ball, area: Rect) -> Drawing {
    let mut drawing = Drawing::with_equal_scales(area, (-2.9, 2.9), (-2.6, 2.3));
    let rim = (0.0, -0.05);
    let frame = 2.75;
    drawing = drawing.ellipse(rim, (frame, 2.3), Style::from(fine()).fill(Colour::WHITE));
    // The ball's outline near the axis; heights from the circle of contact.
    let below = |across: f64| radius - (radius * radius - across * across).sqrt() - depth;
    let outline: Vec<(f64, f64)> =
        (-40..=40).map(|step| 2.3 * f64::from(step) / 40.0).map(|across| (across, below(across))).collect();
    let mut cap = outline.clone();
    cap.extend([(2.3, 1.0), (-2.3, 1.0)]);
    drawing = drawing
        .fill(Path::through(cap).close(), Colour::SKY.mixed(Colour::WHITE, 0.55), 1.0)
        .stroke(Path::through(outline), black());
    // The rim of the stator's tip, cut on both sides of the axis.
    for side in [-1.0, 1.0] {
        let wall = [(touch, 0.0), (touch + 0.55, -0.25), (touch + 0.55, -0.9), (touch, -0.9)];
        let wall = Path::through(wall.map(|(across, up)| (side * across, up))).close();
        drawing = drawing.fill(wall.clone(), Colour::LIGHT_GREY, 1.0).stroke(wall, black());
    }
    drawing
        .stroke(Path::through([(0.0, 1.15), (0.0, -1.3)]), chain())
        .stroke(Path::through([(touch, -0.95), (touch, -1.3)]), fine())
        .double_arrow((0.0, -1.17), (touch, -1.17), black())
        .text((0.0, -1.65), small(Anchor::Centre), format!("$a_e = {touch}$ mm").as_str())
        .text((0.0, 1.55), small(Anchor::Centre), "contact")
}
