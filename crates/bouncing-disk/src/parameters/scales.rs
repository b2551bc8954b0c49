//! The units of the dimensionless system.

use crate::error::{Error, check};
use crate::parameters::disk::Disk;
use crate::parameters::platform::Platform;

/// The SI values of the units of the dimensionless system.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Scales {
    /// Unit of time 1/omega (s).
    pub time: f64,
    /// Unit of length g/omega^2 (m).
    pub length: f64,
    /// Unit of axial velocity g/omega (m/s); also of the axial impulse per unit mass.
    pub velocity: f64,
    /// Unit of angle g a_e/(a_g omega)^2 (rad).
    pub angle: f64,
    /// Unit of angular speed g a_e/(a_g^2 omega) (rad/s); also of the angular impulse per moment of inertia.
    pub angular_speed: f64,
    /// Unit of angular acceleration g a_e/a_g^2 (rad/s^2).
    pub angular_acceleration: f64,
    /// Unit of axial energy per unit mass (g/omega)^2 (J/kg).
    pub axial_energy: f64,
    /// Unit of rotary energy per unit mass (g a_e/(a_g omega))^2 (J/kg).
    pub rotary_energy: f64,
}

impl Scales {
    pub(crate) fn new(platform: &Platform, disk: &Disk) -> Self {
        Self::of(platform.angular_frequency(), disk)
    }

    /// The units of a disk on a platform with the angular frequency `omega` (rad/s).
    pub(crate) fn of(omega: f64, disk: &Disk) -> Self {
        let preload = disk.preload_acceleration();
        let velocity = preload / omega;
        let gyration = disk.gyration_radius();
        let angular_acceleration = preload * disk.contact_radius() / (gyration * gyration);
        let angular_speed = angular_acceleration / omega;
        let rim_speed = angular_speed * gyration;
        Self {
            time: 1.0 / omega,
            length: velocity / omega,
            velocity,
            angle: angular_speed / omega,
            angular_speed,
            angular_acceleration,
            axial_energy: velocity * velocity,
            rotary_energy: rim_speed * rim_speed,
        }
    }

    /// Checks that no unit is negative, zero, subnormal or infinite: otherwise SI numbers would lose digits,
    /// and times would not advance.
    pub(crate) fn check(&self) -> Result<(), Error> {
        let units = [
            ("unit of time (s)", self.time),
            ("unit of length (m)", self.length),
            ("unit of velocity (m/s)", self.velocity),
            ("unit of angle (rad)", self.angle),
            ("unit of angular speed (rad/s)", self.angular_speed),
            ("unit of angular acceleration (rad/s^2)", self.angular_acceleration),
            ("unit of axial energy (J/kg)", self.axial_energy),
            ("unit of rotary energy (J/kg)", self.rotary_energy),
        ];
        for (field, value) in units {
            check(value > 0.0 && value.is_normal(), field, value, "[2.3e-308, 1.7e308]")?;
        }
        Ok(())
    }
}
