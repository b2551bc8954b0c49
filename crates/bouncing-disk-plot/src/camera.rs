//! Perspective: points in space seen by a pinhole camera.

use glam::dcamera::rh::view::look_at_affine3;
use glam::{DAffine3, DMat3, DVec3};

/// A pinhole camera whose upright direction is z.
///
/// Lengths at the distance of the target keep their size; nearer ones appear larger.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    eye: DVec3,
    /// Space as seen from the eye: x to the right, y upwards, the target on the negative z axis.
    view: DAffine3,
    distance: f64,
}

impl Camera {
    /// A camera that looks at `target` from `distance` away, at an azimuth (rad, from x towards y) and an
    /// elevation above the horizontal (rad) of less than a right angle.
    pub fn around(target: DVec3, azimuth: f64, elevation: f64, distance: f64) -> Self {
        let back = DMat3::from_rotation_z(azimuth) * DMat3::from_rotation_y(-elevation) * DVec3::X;
        let eye = target + distance * back;
        Self { eye, view: look_at_affine3(eye, target, DVec3::Z), distance }
    }

    /// The position of the eye.
    pub fn eye(&self) -> DVec3 {
        self.eye
    }

    /// The position of a point in the picture, with the target at the origin and `y` upwards.
    pub fn project(&self, point: DVec3) -> (f64, f64) {
        let seen = self.view.transform_point3(point);
        let scale = -self.distance / seen.z;
        (scale * seen.x, scale * seen.y)
    }

    /// Whether a surface at `point` with this outward normal faces the eye.
    pub fn faces(&self, point: DVec3, normal: DVec3) -> bool {
        normal.dot(self.eye - point) > 0.0
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, FRAC_PI_6};

    use super::*;

    #[test]
    fn the_target_is_the_origin_and_near_things_are_larger() {
        let target = DVec3::new(0.3, -0.2, 1.0);
        let camera = Camera::around(target, 0.4, FRAC_PI_6, 5.0);
        let seen = camera.project(target);
        assert!(seen.0.abs() + seen.1.abs() < 1e-14);
        let above = camera.project(target + DVec3::Z);
        assert!(above.0.abs() < 1e-14 && above.1 > 0.8);
        let back = (camera.eye() - target).normalize();
        let right = DVec3::Z.cross(back).normalize();
        let (near, far) = (target + 0.5 * back, target - 0.5 * back);
        let width = |point: DVec3| camera.project(point + right).0 - camera.project(point).0;
        assert!((width(target) - 1.0).abs() < 1e-14);
        assert!(width(near) > 1.0 && width(far) < 1.0);
    }

    #[test]
    fn azimuth_runs_from_x_to_y_and_right_is_ahead_of_it() {
        let camera = Camera::around(DVec3::ZERO, 0.0, 0.0, 10.0);
        assert!((camera.eye() - 10.0 * DVec3::X).length() < 1e-14);
        assert!((camera.project(DVec3::Y).0 - 1.0).abs() < 1e-14);
        assert!(camera.faces(DVec3::X, DVec3::X) && !camera.faces(-DVec3::X, -DVec3::X));
        let behind = Camera::around(DVec3::ZERO, FRAC_PI_2, 0.0, 10.0);
        assert!((behind.project(DVec3::X).0 + 1.0).abs() < 1e-14);
    }
}
