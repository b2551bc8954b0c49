//! Upright cylinders seen in perspective, with curves on their surface: the path of a point of the platform (Eq. 1).

use std::f64::consts::TAU;

use bouncing_disk::Platform;
use bouncing_disk::core::Phase;
use bouncing_disk::core::numerics::elementary::{acos, atan2, sin_cos};
use bouncing_disk_plot::{Camera, Colour, Dash, Drawing, Path, Stroke};
use glam::DVec3;
use serde::Serialize;

use crate::experiment::ExperimentError;

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

    /// The body as if of glass, with the circle at height 0 and the line at angle 0.
    pub(crate) fn of_glass(&self, drawing: Drawing, camera: &Camera, opacity: f64, thin: Stroke) -> Drawing {
        let look = Look {
            side: Colour::PALE_GREY,
            face: Colour::WHITE,
            opacity,
            edge: Stroke::new(Colour::GREY, 0.7),
            through: true,
        };
        let (azimuth, _) = self.half_view(camera);
        let level = (0..=360).map(|step| (azimuth + f64::from(step).to_radians(), 0.0));
        let upright = [self.bottom, self.top].map(|height| camera.project(polar(self.radius, 0.0, height)));
        curve(self.drawn(drawing, camera, &look), self.runs(camera, level), thin)
            .stroke(Path::through(upright), thin.dashed(Dash::DashDotted))
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

/// One period of the motion of a point of the platform. The last point is the first one, computed again one period
/// later.
#[derive(Debug, Serialize)]
pub(crate) struct HandPath {
    pub(crate) phase_rad: Vec<f64>,
    pub(crate) angle_rad: Vec<f64>,
    pub(crate) height_m: Vec<f64>,
}

impl HandPath {
    pub(crate) fn new(platform: &Platform, intervals: u32) -> Result<Self, ExperimentError> {
        let mut path = Self { phase_rad: Vec::new(), angle_rad: Vec::new(), height_m: Vec::new() };
        for step in 0..=intervals {
            let angle = TAU * f64::from(step) / f64::from(intervals);
            let phase = Phase::new(angle)?;
            path.phase_rad.push(angle);
            path.angle_rad.push(platform.angle(phase));
            path.height_m.push(platform.height(phase));
        }
        Ok(path)
    }

    pub(crate) fn points(&self) -> impl Iterator<Item = (f64, f64)> + '_ {
        self.angle_rad.iter().copied().zip(self.height_m.iter().copied())
    }

    /// The piece that ends at a share of the period and is `intervals` long.
    pub(crate) fn before(&self, share: f64, intervals: usize) -> impl Iterator<Item = (f64, f64)> + '_ {
        let last = (share * self.phase_rad.len() as f64) as usize;
        self.points().take(last + 1).skip(last.saturating_sub(intervals))
    }

    /// The length of the path in the cylinder's surface, along the polygon of its points.
    pub(crate) fn length(&self, radius: f64) -> f64 {
        self.points().zip(self.points().skip(1)).map(|(one, next)| distance(radius, one, next)).sum()
    }
}

/// The distance of two points in the surface of a cylinder.
fn distance(radius: f64, one: (f64, f64), other: (f64, f64)) -> f64 {
    let (across, up) = (radius * (other.0 - one.0), other.1 - one.1);
    (across * across + up * up).sqrt()
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
