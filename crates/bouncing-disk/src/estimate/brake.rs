//! Braking, Eq. (17): the friction coefficient from the deceleration of a disk on a platform at rest.

use crate::error::{Error, check, finite, not_negative, positive};

/// A disk that slides on a platform at rest, and how its angular speed changes.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Braking {
    /// Angular acceleration (rad/s^2) of a disk with a positive angular speed: not positive, since it slows down.
    pub angular_acceleration: f64,
    /// Normal force N (N), positive: the preload, m g.
    pub normal_force: f64,
    /// Mass m of the disk (kg), positive.
    pub mass: f64,
    /// Effective contact radius a_e (m), positive.
    pub contact_radius: f64,
    /// Radius of gyration a_g (m), positive.
    pub gyration_radius: f64,
}

impl Braking {
    fn check(&self) -> Result<(), Error> {
        let slowing = finite("angular_acceleration", self.angular_acceleration)?;
        check(slowing <= 0.0, "angular_acceleration", slowing, "(-inf, 0] (rad/s^2)")?;
        positive("normal_force", self.normal_force)?;
        positive("mass", self.mass)?;
        positive("contact_radius", self.contact_radius)?;
        positive("gyration_radius", self.gyration_radius)?;
        Ok(())
    }
}

/// The coefficient of friction mu = -m a_g^2 alpha_brake/(a_e N) of a disk that brakes (Eq. 17).
///
/// It is Eq. (12) of a sliding disk, solved for mu. The sign is that of Eq. (17): alpha_brake is an acceleration and
/// negative; the caption of Fig. 9 writes the same letter for its absolute value.
///
/// # Errors
/// [`Error::OutOfRange`] names the field, its value and its legal range.
pub fn friction_from_braking(braking: &Braking) -> Result<f64, Error> {
    braking.check()?;
    let inertia = braking.mass * braking.gyration_radius * braking.gyration_radius;
    check(inertia.is_normal(), "moment of inertia", inertia, "[2.3e-308, 1.7e308] (kg m^2)")?;
    let arm = braking.contact_radius * braking.normal_force;
    check(arm.is_normal(), "contact radius times normal force", arm, "[2.3e-308, 1.7e308] (N m)")?;
    not_negative("friction", -inertia * braking.angular_acceleration / arm)
}

#[cfg(test)]
mod tests {
    use super::*;

    const BRAKING: Braking = Braking {
        angular_acceleration: -20.0,
        normal_force: 0.5,
        mass: 0.05,
        contact_radius: 0.002,
        gyration_radius: 0.01,
    };

    #[test]
    fn eq_17_on_round_numbers() {
        // m a_g^2 = 5e-6 kg m^2, times 20 rad/s^2 is a torque of 1e-4 N m; a_e N = 1e-3 N m.
        let friction = friction_from_braking(&BRAKING).expect("legal");
        assert!((friction - 0.1).abs() < 1e-15, "{friction}");
        let none = friction_from_braking(&Braking { angular_acceleration: 0.0, ..BRAKING }).expect("legal");
        assert!(none.abs() <= 0.0);
    }

    #[test]
    fn eq_17_refuses_what_does_not_brake() {
        for (braking, name) in [
            (Braking { angular_acceleration: 20.0, ..BRAKING }, "angular_acceleration"),
            (Braking { angular_acceleration: f64::NAN, ..BRAKING }, "angular_acceleration"),
            (Braking { normal_force: 0.0, ..BRAKING }, "normal_force"),
            (Braking { mass: -1.0, ..BRAKING }, "mass"),
            (Braking { contact_radius: 0.0, ..BRAKING }, "contact_radius"),
            (Braking { gyration_radius: f64::INFINITY, ..BRAKING }, "gyration_radius"),
            (Braking { contact_radius: 1e-320, ..BRAKING }, "contact radius times normal force"),
            // Their product overflows, and the friction vanished.
            (
                Braking { contact_radius: 1e160, normal_force: 1e160, ..BRAKING },
                "contact radius times normal force",
            ),
            // Its square vanishes, and with it the friction did.
            (Braking { gyration_radius: 1e-170, ..BRAKING }, "moment of inertia"),
        ] {
            let error = friction_from_braking(&braking).expect_err("illegal");
            assert!(matches!(error, Error::OutOfRange { field, .. } if field == name), "{error}");
        }
    }
}
