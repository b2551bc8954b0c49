//! The disk above the platform, and the dough above the hand, at one instant of a toss.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use bouncing_disk::core::numerics::elementary::{atan2, sin, sin_cos};
use bouncing_disk_plot::{Anchor, Camera, Colour, Dash, Drawing, Path, Rect, Stroke, TextStyle};
use glam::DVec3;

use crate::figures::shared::cylinder::{Cylinder, Look, arc, circle, faint, polar};

/// Azimuth and elevation of the eye (rad) and its distance in stroke lengths.
pub(super) const AZIMUTH: f64 = 0.8;
pub(super) const ELEVATION: f64 = 0.42;
pub(super) const DISTANCE: f64 = 9.0;
/// Where the outline of what is drawn lies on the left and on the right (rad).
pub(super) const LEFT: f64 = AZIMUTH - FRAC_PI_2;
const RIGHT: f64 = AZIMUTH + FRAC_PI_2;
/// Thickness of disk and platform over their radius.
const THICKNESS: f64 = 0.12;
/// Where the arcs of the angles are drawn, over the disk's radius.
const ANGLE_ARC: f64 = 0.82;
/// Where the sketched fingers point (rad): to the left of the picture.
const FINGERS: f64 = LEFT - 0.2;

pub(super) fn thin() -> Stroke {
    Stroke::new(Colour::DARK_GREY, 0.6)
}

fn chain() -> Stroke {
    thin().dashed(Dash::DashDotted)
}

fn small(anchor: Anchor, colour: Colour) -> TextStyle {
    TextStyle::new(anchor).size(8.0).colour(colour)
}

/// A letter in the upper left corner of a drawing of which only the area is known.
pub(super) fn letter(drawing: Drawing, area: Rect, text: &str) -> Drawing {
    let corner = drawing.local((area.left + 2.0, area.top + 6.0));
    drawing.text(corner, Anchor::LeftCentre, text)
}

/// The instant of (a) and (b), and the eye that sees it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scene {
    pub(super) camera: Camera,
    pub(super) radius: f64,
    /// Where the axis begins.
    pub(super) low: f64,
    /// Height and angle.
    pub(super) platform: (f64, f64),
    pub(super) disk: (f64, f64),
}

impl Scene {
    fn line(&self, from: DVec3, to: DVec3) -> Path {
        Path::through([self.camera.project(from), self.camera.project(to)])
    }

    /// A piece of the axis.
    fn axis(&self, from: f64, to: f64) -> Path {
        self.line(DVec3::new(0.0, 0.0, from), DVec3::new(0.0, 0.0, to))
    }

    /// Where the axis ends.
    fn high(&self) -> f64 {
        self.disk.0 + 0.75 * self.radius
    }

    /// The upper face of the disk: its height is that of its lower face.
    fn top(&self) -> f64 {
        self.disk.0 + THICKNESS * self.radius
    }

    /// A point at a distance from the axis in radii of the disk.
    fn at(&self, distance: f64, angle: f64, height: f64) -> (f64, f64) {
        self.camera.project(polar(distance * self.radius, angle, height))
    }

    /// The area with the lower part of the axis and the circle of height 0.
    fn framed(&self, area: Rect, across: (f64, f64)) -> Drawing {
        let up = |height: f64| self.camera.project(DVec3::new(0.0, 0.0, height)).1;
        let range = (across.0 * self.radius, across.1 * self.radius);
        Drawing::with_equal_scales(area, range, (up(self.low), up(self.high())))
            .stroke(self.axis(self.low, self.platform.0), chain())
            .stroke(circle(&self.camera, self.radius, 0.0), faint(Stroke::new(Colour::BLACK, 1.0)))
    }

    /// The line of angle 0, a mark at `angle` and the arc between them.
    fn turn(&self, drawing: Drawing, (height, angle): (f64, f64), colour: Colour) -> Drawing {
        let centre = DVec3::new(0.0, 0.0, height);
        let swept = arc(&self.camera, ANGLE_ARC * self.radius, (0.0, angle), height);
        drawing
            .stroke(self.line(centre, polar(self.radius, 0.0, height)), thin().dashed(Dash::Dashed))
            .stroke(self.line(centre, polar(self.radius, angle, height)), Stroke::new(colour, 1.2))
            .arrow(swept, Stroke::new(Colour::BLACK, 0.9))
    }

    /// The name of an angle, in its middle.
    fn named(&self, drawing: Drawing, (height, angle): (f64, f64), name: &str) -> Drawing {
        drawing.text(self.at(0.56, 0.5 * angle, height), Anchor::Centre, name)
    }

    /// A disk with its upper face at `height` and a mark at `angle`.
    fn turned(&self, drawing: Drawing, (height, angle): (f64, f64), colour: Colour) -> Drawing {
        let body = Cylinder { radius: self.radius, bottom: height - THICKNESS * self.radius, top: height };
        let look = Look {
            side: colour.mixed(Colour::WHITE, 0.45),
            face: colour.mixed(Colour::WHITE, 0.80),
            opacity: 1.0,
            edge: Stroke::new(colour.mixed(Colour::BLACK, 0.25), 0.8),
            through: false,
        };
        self.turn(body.drawn(drawing, &self.camera, &look), (height, angle), colour)
    }

    /// The heights s and x, at the left of the outline, from the platform's mean height.
    fn heights(&self, mut drawing: Drawing) -> Drawing {
        let radius = self.radius;
        for (distance, height, name) in [(1.30, self.platform.0, "$s$"), (1.62, self.disk.0, "$x$")] {
            let foot = self.at(distance, LEFT, 0.0);
            let head = (foot.0, self.at(distance, LEFT, height).1);
            let edge = self.at(1.02, LEFT, height);
            drawing = drawing
                .stroke(Path::through([edge, (foot.0 - 0.06 * radius, edge.1)]), thin())
                .arrow([foot, head], Stroke::new(Colour::BLACK, 0.9))
                .text((head.0 - 0.09 * radius, 0.5 * (foot.1 + head.1)), Anchor::RightCentre, name);
        }
        drawing.stroke(Path::through([self.at(1.0, LEFT, 0.0), self.at(1.75, LEFT, 0.0)]), thin())
    }

    pub(super) fn system(&self, area: Rect) -> Drawing {
        let (bottom, top) = (self.disk.0, self.top());
        let upper = (top, self.disk.1);
        let mut drawing = self.turned(self.framed(area, (-1.85, 1.25)), self.platform, Colour::BLUE);
        drawing = drawing.stroke(self.axis(self.platform.0, bottom), chain());
        drawing = self.turned(drawing, upper, Colour::VERMILION);
        drawing = self.heights(drawing.stroke(self.axis(top, self.high()), chain()));
        drawing = self.named(drawing, self.platform, r"$\beta$");
        drawing = self.named(drawing, upper, r"$\alpha$");
        let middle = bottom + 0.5 * (THICKNESS * self.radius);
        for (name, height, colour) in
            [("disk", middle, Colour::VERMILION), ("platform", self.platform.0, Colour::BLUE)]
        {
            let style = small(Anchor::LeftCentre, colour.mixed(Colour::BLACK, 0.25));
            drawing = drawing.text(self.at(1.08, RIGHT, height), style, name);
        }
        letter(drawing, area, "(a)")
    }

    /// The dough above the hand, from plain shapes, at the heights and angles of (a).
    pub(super) fn sketch(&self, area: Rect) -> Drawing {
        let (palm, bottom, top) = (self.platform.0, self.disk.0, self.top());
        let mut drawing = self.framed(area, (-1.80, 1.60));
        let skin = Colour::ORANGE.mixed(Colour::WHITE, 0.72);
        let edge = Colour::ORANGE.mixed(Colour::BLACK, 0.45);
        let parts = HAND.map(|part| self.bar(part, FINGERS + self.platform.1, palm));
        // The outline of the hand is what its parts leave of their own outlines.
        for part in &parts {
            drawing = drawing.stroke(part.clone(), Stroke::new(edge, 1.8));
        }
        for part in parts {
            drawing = drawing.fill(part, skin, 1.0);
        }
        drawing = self.named(self.turn(drawing, self.platform, edge), self.platform, r"$\beta$");
        drawing = drawing.stroke(self.axis(palm, bottom), chain());
        // The dough: its rim at several heights gives the side.
        let dough = Colour::rgb(222, 190, 130);
        let dark = dough.mixed(Colour::BLACK, 0.45);
        let rim_edge = Stroke::new(dark, 0.9);
        let rim = |height: f64| self.outline(bulges(self.disk.1), height);
        drawing = drawing.stroke(rim(bottom), rim_edge);
        for layer in 0..=8 {
            drawing = drawing.fill(rim(bottom + (top - bottom) * f64::from(layer) / 8.0), dough, 1.0);
        }
        drawing = drawing.fill(rim(top), dough.mixed(Colour::WHITE, 0.55), 1.0).stroke(rim(top), rim_edge);
        let upper = (top, self.disk.1);
        drawing = self.named(self.turn(drawing, upper, dark), upper, r"$\alpha$");
        drawing = self.heights(drawing.stroke(self.axis(top, self.high()), chain()));
        let beside = self.at(1.10, RIGHT, bottom + 0.5 * THICKNESS * self.radius);
        let under = self.at(0.95, RIGHT, palm - 0.45 * self.radius);
        let foot = drawing.local((area.left + 0.62 * area.width, area.bottom() - 4.0));
        drawing = drawing
            .text(beside, small(Anchor::LeftCentre, dark), "dough")
            .text(under, small(Anchor::LeftCentre, edge), "hand")
            .text(foot, small(Anchor::Left, Colour::DARK_GREY), "(sketch)");
        letter(drawing, area, "(b)")
    }

    /// A closed outline in a horizontal plane, in radii of the disk, as it appears.
    fn outline(&self, points: impl Iterator<Item = (f64, f64)>, height: f64) -> Path {
        Path::through(points.map(|(distance, angle)| self.at(distance, angle, height))).close()
    }

    /// A rounded bar in a horizontal plane.
    fn bar(&self, [x, y, to_x, to_y, half]: [f64; 5], turned: f64, height: f64) -> Path {
        let along = atan2(to_y - y, to_x - x);
        let end = |centre: (f64, f64), from: f64| {
            (0..=24).map(move |step| {
                let (sine, cosine) = sin_cos(from + PI * f64::from(step) / 24.0);
                (centre.0 + half * cosine, centre.1 + half * sine)
            })
        };
        let points = end((to_x, to_y), along - FRAC_PI_2).chain(end((x, y), along + FRAC_PI_2));
        self.outline(points.map(|(x, y)| ((x * x + y * y).sqrt(), turned + atan2(y, x))), height)
    }
}

/// The parts of the sketched hand, from end to end with a half width, in radii of the dough: along the
/// fingers and across.
const HAND: [[f64; 5]; 7] = [
    [-1.75, 0.00, -0.45, 0.00, 0.24],
    [-0.42, 0.00, 0.05, 0.00, 0.46],
    [0.20, 0.36, 0.62, 0.50, 0.10],
    [0.25, 0.13, 0.86, 0.19, 0.11],
    [0.25, -0.12, 0.88, -0.14, 0.11],
    [0.20, -0.35, 0.72, -0.45, 0.10],
    [-0.40, 0.38, 0.02, 0.78, 0.12],
];

/// The rim of the sketched dough: a circle with a few bulges.
fn bulges(turned: f64) -> impl Iterator<Item = (f64, f64)> {
    (0..100).map(move |step| {
        let angle = TAU * f64::from(step) / 100.0;
        (1.0 + 0.035 * sin(3.0 * angle + 0.4) + 0.02 * sin(5.0 * angle), angle + turned)
    })
}
