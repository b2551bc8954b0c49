//! The disk: the dough, or the rotor.

use crate::display::numbers;
use crate::error::{Error, check, finite, not_negative, positive, restitution};
use std::fmt::{self, Display, Formatter};

/// The parameters of a [`Disk`], not yet checked.
///
/// The mass is not a parameter, as it multiplies every equation. Energies are per unit mass.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct DiskParameters {
    /// Effective contact radius a_e (m), positive: where the friction force acts.
    pub contact_radius: f64,
    /// Radius of gyration a_g (m), positive.
    pub gyration_radius: f64,
    /// Coefficient of friction mu, static and kinetic, not negative.
    pub friction: f64,
    /// Coefficient of restitution, in [0, 1).
    pub restitution: f64,
    /// Preload acceleration g (m/s^2), positive.
    pub preload_acceleration: f64,
    /// Angular deceleration by a constant load torque, T_L/(m a_g^2) (rad/s^2), any finite number; a positive
    /// load decelerates a positive rotation. Zero if absent in a serialised form.
    #[cfg_attr(feature = "serde", serde(default))]
    pub load_acceleration: f64,
}

impl DiskParameters {
    /// The same disk, of `mass` m (kg), with a load `torque` T_L (N m), which decelerates it by T_L/(m a_g^2).
    /// The mass is not needed elsewhere.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a torque that is not finite, a mass that is not positive, and a moment of
    /// inertia m a_g^2 that a double cannot represent.
    pub fn with_load_torque(mut self, torque: f64, mass: f64) -> Result<Self, Error> {
        finite("torque", torque)?;
        positive("mass", mass)?;
        positive("gyration_radius", self.gyration_radius)?;
        let inertia = mass * self.gyration_radius * self.gyration_radius;
        check(inertia.is_normal(), "moment of inertia", inertia, "[2.3e-308, 1.7e308] (kg m^2)")?;
        self.load_acceleration = torque / inertia;
        Ok(self)
    }

    /// mu a_e g/a_g^2 (rad/s^2): the acceleration if friction always pushed one way. The mean normal force is
    /// the weight, whatever the orbit, so no larger mean acceleration is possible.
    #[must_use]
    pub fn friction_acceleration(&self) -> f64 {
        self.friction * self.contact_radius * self.preload_acceleration
            / (self.gyration_radius * self.gyration_radius)
    }

    /// Checks the ranges.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] with the field, its value and its legal range.
    pub fn build(self) -> Result<Disk, Error> {
        positive("contact_radius", self.contact_radius)?;
        positive("gyration_radius", self.gyration_radius)?;
        not_negative("friction", self.friction)?;
        restitution(self.restitution)?;
        positive("preload_acceleration", self.preload_acceleration)?;
        finite("load_acceleration", self.load_acceleration)?;
        Ok(Disk { parameters: self })
    }
}

/// A disk with legal parameters.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "DiskParameters", into = "DiskParameters"))]
pub struct Disk {
    parameters: DiskParameters,
}

impl Disk {
    /// The parameters, which can be changed and built again.
    #[must_use]
    pub const fn parameters(&self) -> DiskParameters {
        self.parameters
    }

    /// Effective contact radius a_e (m).
    #[must_use]
    pub const fn contact_radius(&self) -> f64 {
        self.parameters.contact_radius
    }

    /// Radius of gyration a_g (m).
    #[must_use]
    pub const fn gyration_radius(&self) -> f64 {
        self.parameters.gyration_radius
    }

    /// Coefficient of friction mu.
    #[must_use]
    pub const fn friction(&self) -> f64 {
        self.parameters.friction
    }

    /// Coefficient of restitution.
    #[must_use]
    pub const fn restitution(&self) -> f64 {
        self.parameters.restitution
    }

    /// Preload acceleration g (m/s^2).
    #[must_use]
    pub const fn preload_acceleration(&self) -> f64 {
        self.parameters.preload_acceleration
    }

    /// mu a_e g/a_g^2 (rad/s^2): [`DiskParameters::friction_acceleration`].
    #[must_use]
    pub fn friction_acceleration(&self) -> f64 {
        self.parameters.friction_acceleration()
    }

    /// Angular deceleration by the load (rad/s^2).
    #[must_use]
    pub const fn load_acceleration(&self) -> f64 {
        self.parameters.load_acceleration
    }
}

impl TryFrom<DiskParameters> for Disk {
    type Error = Error;

    fn try_from(parameters: DiskParameters) -> Result<Self, Error> {
        parameters.build()
    }
}

impl From<Disk> for DiskParameters {
    fn from(disk: Disk) -> Self {
        disk.parameters
    }
}

impl Display for Disk {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let [a_e, a_g, load] =
            [self.contact_radius(), self.gyration_radius(), self.load_acceleration()].map(numbers(f));
        let [mu, restitution, g] =
            [self.friction(), self.restitution(), self.preload_acceleration()].map(numbers(f));
        write!(f, "a_e = {a_e} m, a_g = {a_g} m, mu = {mu}, restitution = {restitution}, g = {g} m/s^2")?;
        if self.load_acceleration() != 0.0 { write!(f, ", load = {load} rad/s^2") } else { Ok(()) }
    }
}
