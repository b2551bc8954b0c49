//! Upright cylinders seen in perspective, with curves on their surface.

use std::f64::consts::TAU;

use bouncing_disk::core::numerics::elementary::{acos, atan2, sin_cos};
use bouncing_disk_plot::{Camera, Colour, Dash, Drawing, Path, Stroke};
use glam::DVec3;

const CIRCLE_POINTS: u32 = 120;

/// An upright cylinder about the z axis.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cylinder {
    pub(crate) radius: f64,
    pub(crate) bottom: f64,
    pub(crate) top: f64,
}

/// A piece of a curve that is either in view or behind the surface.
#[derive(Clone, Debug)]
pub(crate) struct Run {
    pub(crate) in_view: bool,
    pub(crate) points: Vec<(f64, f64)>,
}

/// A point in space, in cylindrical coordinates.
pub(crate) fn polar(radius: f64, angle: f64, height: f64) -> DVec3 {
    let (sine, cosine) = sin_cos(angle);
    DVec3::new(radius * cosine, radius * sine, height)
}

/// An arc about the z axis as it appears.
pub(crate) fn arc(camera: &Camera, radius: f64, (from, to): (f64, f64), height: f64) -> Vec<(f64, f64)> {
    (0..=CIRCLE_POINTS)
        .map(|step| from + (to - from) * f64::from(step) / f64::from(CIRCLE_POINTS))
        .map(|angle| camera.project(polar(radius, angle, height)))
        .collect()
}

/// A circle about the z axis as it appears.
pub(crate) fn circle(camera: &Camera, radius: f64, height: f64) -> Path {
    Path::through(arc(camera, radius, (0.0, TAU), height)).close()
}

impl Cylinder {
    /// Half the range of angles in view, about the azimuth of the eye.
    fn half_view(&self, camera: &Camera) -> (f64, f64) {
        let eye = camera.eye();
        let away = (eye.x * eye.x + eye.y * eye.y).sqrt();
        (atan2(eye.y, eye.x), acos((self.radius / away).min(1.0)))
    }

    /// The two angles at which the surface turns out of view, in the order of the angle.
    pub(crate) fn edges(&self, camera: &Camera) -> [f64; 2] {
        let (azimuth, half) = self.half_view(camera);
        [azimuth - half, azimuth + half]
    }

    /// Whether a point of the surface is in view.
    pub(crate) fn shows(&self, camera: &Camera, angle: f64) -> bool {
        let normal = polar(1.0, angle, 0.0);
        camera.faces(self.radius * normal, normal)
    }

    /// A curve (angle, height) on the surface, cut where it goes out of view.
    pub(crate) fn runs(&self, camera: &Camera, curve: impl IntoIterator<Item = (f64, f64)>) -> Vec<Run> {
        let mut runs: Vec<Run> = Vec::new();
        for (angle, height) in curve {
            let point = camera.project(polar(self.radius, angle, height));
            let in_view = self.shows(camera, angle);
            match runs.last_mut() {
                Some(run) if run.in_view == in_view => run.points.push(point),
                Some(run) => {
                    // The pieces meet.
                    run.points.push(point);
                    runs.push(Run { in_view, points: vec![point] });
                }
                None => runs.push(Run { in_view, points: vec![point] }),
            }
        }
        runs
    }

    /// The body with its upper face, seen from above; `through` shows the far rim of the bottom as well.
    pub(crate) fn drawn(&self, drawing: Drawing, camera: &Camera, look: &Look) -> Drawing {
        let [first, last] = self.edges(camera);
        let mut outline = arc(camera, self.radius, (first, last), self.bottom);
        outline.extend(arc(camera, self.radius, (last, first), self.top));
        let body = Path::through(outline).close();
        let face = circle(camera, self.radius, self.top);
        let mut drawing =
            drawing.fill(body.clone(), look.side, look.opacity).fill(face.clone(), look.face, look.opacity);
        if look.through {
            let far = Path::through(arc(camera, self.radius, (last, first + TAU), self.bottom));
            drawing = drawing.stroke(far, faint(look.edge));
        }
        drawing.stroke(body, look.edge).stroke(face, look.edge)
    }
}

/// How a cylinder looks.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Look {
    pub(crate) side: Colour,
    pub(crate) face: Colour,
    pub(crate) opacity: f64,
    pub(crate) edge: Stroke,
    pub(crate) through: bool,
}

/// The lines of what lies behind a surface.
pub(crate) fn faint(stroke: Stroke) -> Stroke {
    Stroke {
        colour: stroke.colour.mixed(Colour::WHITE, 0.45),
        width: 0.75 * stroke.width,
        ..stroke.dashed(Dash::Dotted)
    }
}

/// A curve with its hidden parts lighter and dotted.
pub(crate) fn curve(mut drawing: Drawing, runs: Vec<Run>, stroke: Stroke) -> Drawing {
    let (seen, hidden): (Vec<_>, Vec<_>) = runs.into_iter().partition(|run| run.in_view);
    for run in hidden {
        drawing = drawing.stroke(Path::through(run.points), faint(stroke));
    }
    for run in seen {
        drawing = drawing.stroke(Path::through(run.points), stroke);
    }
    drawing
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_circle_is_cut_where_the_outline_is() {
        let cylinder = Cylinder { radius: 1.0, bottom: -1.0, top: 1.0 };
        let camera = Camera::around(DVec3::ZERO, 0.3, 0.4, 6.0);
        let [first, last] = cylinder.edges(&camera);
        assert!(cylinder.shows(&camera, first + 1e-9) && !cylinder.shows(&camera, first - 1e-9));
        assert!(cylinder.shows(&camera, last - 1e-9) && !cylinder.shows(&camera, last + 1e-9));
        let around = (0..=1000).map(|step| (TAU * f64::from(step) / 1000.0, 0.2));
        let runs = cylinder.runs(&camera, around);
        assert_eq!(runs.iter().map(|run| run.in_view).collect::<Vec<_>>(), [true, false, true]);
    }
}
