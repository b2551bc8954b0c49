//! The coefficient of friction from a deceleration (Eq. 17, Fig. 9).

use crate::error::{Error, check, finite, not_negative, positive};

/// The rotor whose braking was measured.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct BrakingRotor {
    /// Normal force N (N), positive: the preload, m g.
    pub normal_force: f64,
    /// Mass m of the disk (kg), positive.
    pub mass: f64,
    /// Effective contact radius a_e (m), positive.
    pub contact_radius: f64,
    /// Radius of gyration a_g (m), positive.
    pub gyration_radius: f64,
}

impl BrakingRotor {
    /// The coefficient of friction mu = -m a_g^2 alpha_brake/(a_e N) of a disk that brakes with this angular
    /// acceleration alpha_brake (rad/s^2), Eq. (17). For a positive angular speed the acceleration is negative
    /// or zero, since the disk slows down. The caption of Fig. 9 uses the same letter for its absolute value.
    ///
    /// This is Eq. (12) for a sliding disk, solved for mu.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] with the field, its value and its legal range.
    pub fn friction(&self, angular_acceleration: f64) -> Result<f64, Error> {
        let slowing = finite("angular_acceleration", angular_acceleration)?;
        check(slowing <= 0.0, "angular_acceleration", slowing, "(-inf, 0] (rad/s^2)")?;
        positive("normal_force", self.normal_force)?;
        positive("mass", self.mass)?;
        positive("contact_radius", self.contact_radius)?;
        positive("gyration_radius", self.gyration_radius)?;
        let inertia = self.mass * self.gyration_radius * self.gyration_radius;
        check(inertia.is_normal(), "moment of inertia", inertia, "[2.3e-308, 1.7e308] (kg m^2)")?;
        let arm = self.contact_radius * self.normal_force;
        check(arm.is_normal(), "contact radius times normal force", arm, "[2.3e-308, 1.7e308] (N m)")?;
        not_negative("friction", -inertia * angular_acceleration / arm)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::refused;

    /// m a_g^2 = 5e-6 kg m^2 times 20 rad/s^2 over a_e N = 1e-3 N m.
    const ROTOR: BrakingRotor =
        BrakingRotor { normal_force: 0.5, mass: 0.05, contact_radius: 0.002, gyration_radius: 0.01 };

    #[test]
    fn eq_17_on_round_numbers() {
        assert!((ROTOR.friction(-20.0).expect("legal") - 0.1).abs() < 1e-15);
        assert!(ROTOR.friction(0.0).expect("legal").abs() <= 0.0);
    }

    #[test]
    fn what_is_illegal_of_a_rotor_is_refused() {
        let slowed = |rotor: BrakingRotor| rotor.friction(-20.0);
        refused("normal_force", [BrakingRotor { normal_force: 0.0, ..ROTOR }], slowed);
        refused("mass", [BrakingRotor { mass: -1.0, ..ROTOR }], slowed);
        refused("contact_radius", [f64::NAN, 0.0], |contact_radius| {
            slowed(BrakingRotor { contact_radius, ..ROTOR })
        });
        refused("gyration_radius", [BrakingRotor { gyration_radius: f64::INFINITY, ..ROTOR }], slowed);
        // The square underflows, and once made the friction vanish.
        refused("moment of inertia", [BrakingRotor { gyration_radius: 1e-170, ..ROTOR }], slowed);
        let product = "contact radius times normal force";
        refused(product, [BrakingRotor { contact_radius: 1e-320, ..ROTOR }], slowed);
        // The product overflows, and once made the friction vanish.
        refused(product, [BrakingRotor { contact_radius: 1e160, normal_force: 1e160, ..ROTOR }], slowed);
        refused("angular_acceleration", [20.0, f64::NAN], |acceleration| ROTOR.friction(acceleration));
    }
}
