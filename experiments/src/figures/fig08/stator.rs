//! A pretwisted beam in perspective.

use bouncing_disk::core::numerics::elementary::sin_cos;
use bouncing_disk_plot::{Camera, Colour, Drawing, Path, Stroke};
use glam::DVec3;

/// A beam of rectangular cross-section whose section turns uniformly with height.
#[derive(Clone, Copy, Debug)]
pub(super) struct Beam {
    pub(super) half_width: f64,
    pub(super) half_thickness: f64,
    pub(super) bottom: f64,
    pub(super) top: f64,
    /// Turn of the section at the bottom, and from there to the top (rad).
    pub(super) turned: f64,
    pub(super) twist: f64,
}

const SLICES: u32 = 40;

impl Beam {
    fn corner(&self, index: usize, share: f64) -> DVec3 {
        let (across, along) = [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)][index % 4];
        let (across, along) = (across * self.half_width, along * self.half_thickness);
        let (sine, cosine) = sin_cos(self.turned + share * self.twist);
        let height = self.bottom + share * (self.top - self.bottom);
        DVec3::new(cosine * across - sine * along, sine * across + cosine * along, height)
    }

    /// The faces turned to the eye, slice by slice from below, then their edges and the upper face.
    pub(super) fn drawn(
        &self,
        mut drawing: Drawing,
        camera: &Camera,
        colour: Colour,
        edge: Stroke,
    ) -> Drawing {
        let share = |slice: u32| f64::from(slice) / f64::from(SLICES);
        let towards = camera.eye().normalize_or_zero();
        for slice in 0..SLICES {
            for side in 0..4 {
                let (low, high) = (share(slice), share(slice + 1));
                let corners = [(side, low), (side + 1, low), (side + 1, high), (side, high)]
                    .map(|(n, s)| self.corner(n, s));
                let normal = (corners[1] - corners[0]).cross(corners[3] - corners[0]).normalize_or_zero();
                if !camera.faces(corners[0], normal) {
                    continue;
                }
                let shade = colour.mixed(Colour::WHITE, 0.25 + 0.55 * normal.dot(towards).max(0.0));
                let face = Path::through(corners.map(|corner| camera.project(corner))).close();
                // The hairline closes the seam between slices.
                drawing = drawing.fill(face.clone(), shade, 1.0).stroke(face, Stroke::new(shade, 0.3));
            }
        }
        for index in 0..4 {
            for slice in 0..SLICES {
                let (low, high) = (share(slice), share(slice + 1));
                let seen = [index, index + 3].into_iter().any(|side| {
                    let normal = (self.corner(side + 1, low) - self.corner(side, low))
                        .cross(self.corner(side, high) - self.corner(side, low));
                    camera.faces(self.corner(index, low), normal)
                });
                if seen {
                    let ends = [low, high].map(|share| camera.project(self.corner(index, share)));
                    drawing = drawing.stroke(Path::through(ends), edge);
                }
            }
        }
        for side in 0..4 {
            let (from, to) = (self.corner(side, 0.0), self.corner(side + 1, 0.0));
            let normal = (to - from).cross(self.corner(side, share(1)) - from);
            if camera.faces(from, normal) {
                drawing = drawing.stroke(Path::through([from, to].map(|point| camera.project(point))), edge);
            }
        }
        let top = Path::through((0..4).map(|index| camera.project(self.corner(index, 1.0)))).close();
        drawing.fill(top.clone(), colour.mixed(Colour::WHITE, 0.7), 1.0).stroke(top, edge)
    }
}
