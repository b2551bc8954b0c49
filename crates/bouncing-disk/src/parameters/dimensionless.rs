//! The system in units that never degenerate: time 1/omega, length g/omega^2, angular speed g a_e/(a_g^2
//! omega).
//!
//! The unit of angular speed is the change caused by a friction coefficient of 1 in one radian of phase. It
//! contains no friction coefficient, so a frictionless disk is legal, and no amplitude, so a platform at rest
//! is legal.

use std::f64::consts::PI;

use bouncing_disk_core::numerics::elementary::sin_cos;
use bouncing_disk_core::{ImpactMap, Phase, Vibration};

use crate::error::{Error, finite, moderate, moderate_not_negative};

/// The dimensionless parameters, not yet checked.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct DimensionlessParameters {
    /// P = A omega^2/g = pi Gamma, in [0, 1e8].
    pub peak_acceleration: f64,
    /// Q = a_g^2 Phi omega^2/(a_e g) = pi Gamma_T mu, in [0, 1e100].
    pub twist_speed: f64,
    /// Phase lag theta (rad), finite.
    pub phase_lag: f64,
    /// Coefficient of friction mu, in [0, 1e100].
    pub friction: f64,
    /// Coefficient of restitution, in [0, 1).
    pub restitution: f64,
    /// Load torque l = T_L/(m g a_e), in [-1e100, 1e100]; a positive load decelerates a positive rotation.
    #[cfg_attr(feature = "serde", serde(default))]
    pub load: f64,
}

impl DimensionlessParameters {
    /// Checks the ranges.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] or an error of the core, with the field, its value and its legal range.
    pub fn build(self) -> Result<DimensionlessSystem, Error> {
        let vibration = Vibration::new(self.peak_acceleration)?;
        let map = ImpactMap::new(vibration, self.restitution)?;
        moderate_not_negative("twist_speed", self.twist_speed)?;
        finite("phase_lag", self.phase_lag)?;
        moderate_not_negative("friction", self.friction)?;
        moderate("load", self.load)?;
        let (sin_lag, cos_lag) = sin_cos(self.phase_lag);
        Ok(DimensionlessSystem {
            parameters: self,
            map,
            twist_cosine: self.twist_speed * cos_lag,
            twist_sine: self.twist_speed * sin_lag,
        })
    }
}

/// The four numbers of the paper's Sec. IV, not yet checked.
///
/// A non-zero friction coefficient only scales the rotary motion, so it is set to 1 here; angular speeds are
/// then in units of mu g a_e/(a_g^2 omega).
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ForcingParameters {
    /// Axial forcing parameter Gamma = A omega^2/(pi g), in [0, 3.18e7].
    pub axial_forcing: f64,
    /// Angular forcing parameter Gamma_T = a_g^2 Phi omega^2/(a_e pi g mu), not negative.
    pub angular_forcing: f64,
    /// Phase lag theta (rad), finite.
    pub phase_lag: f64,
    /// Coefficient of restitution, in [0, 1).
    pub restitution: f64,
}

impl ForcingParameters {
    /// Checks the ranges.
    ///
    /// # Errors
    /// The errors of [`DimensionlessParameters::build`].
    pub fn build(self) -> Result<DimensionlessSystem, Error> {
        let vibration = Vibration::from_axial_forcing(self.axial_forcing)?;
        moderate_not_negative("angular_forcing", self.angular_forcing)?;
        DimensionlessParameters {
            peak_acceleration: vibration.peak_acceleration(),
            twist_speed: PI * self.angular_forcing,
            phase_lag: self.phase_lag,
            friction: 1.0,
            restitution: self.restitution,
            load: 0.0,
        }
        .build()
    }
}

/// The dimensionless system that the engine computes.
///
/// The equations of motion (Eq. 2), with the normal force N in units of the disk's weight under preload and
/// the friction torque f in units of m g a_e, read: d(axial velocity)/d tau = N - 1, d(angular speed)/d tau =
/// f - l.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "DimensionlessParameters", into = "DimensionlessParameters"))]
pub struct DimensionlessSystem {
    parameters: DimensionlessParameters,
    map: ImpactMap,
    /// Q cos theta and Q sin theta.
    twist_cosine: f64,
    twist_sine: f64,
}

impl DimensionlessSystem {
    /// The parameters, which can be changed and built again.
    #[must_use]
    pub const fn parameters(&self) -> DimensionlessParameters {
        self.parameters
    }

    /// The impact map of the vertical motion.
    #[must_use]
    pub const fn map(&self) -> &ImpactMap {
        &self.map
    }

    /// The vertical vibration of the platform.
    #[must_use]
    pub const fn vibration(&self) -> &Vibration {
        self.map.vibration()
    }

    /// P = A omega^2/g.
    #[must_use]
    pub const fn peak_acceleration(&self) -> f64 {
        self.parameters.peak_acceleration
    }

    /// Q = a_g^2 Phi omega^2/(a_e g), the largest angular speed of the platform.
    #[must_use]
    pub const fn twist_speed(&self) -> f64 {
        self.parameters.twist_speed
    }

    /// Phase lag theta (rad).
    #[must_use]
    pub const fn phase_lag(&self) -> f64 {
        self.parameters.phase_lag
    }

    /// Coefficient of friction.
    #[must_use]
    pub const fn friction(&self) -> f64 {
        self.parameters.friction
    }

    /// Coefficient of restitution.
    #[must_use]
    pub const fn restitution(&self) -> f64 {
        self.parameters.restitution
    }

    /// Load torque in units of m g a_e.
    #[must_use]
    pub const fn load(&self) -> f64 {
        self.parameters.load
    }

    /// The paper's Gamma.
    #[must_use]
    pub fn axial_forcing(&self) -> f64 {
        self.vibration().axial_forcing()
    }

    /// The paper's Gamma_T, the ratio of the inertial to the frictional torque; `None` without friction.
    #[must_use]
    pub fn angular_forcing(&self) -> Option<f64> {
        (self.friction() > 0.0).then(|| self.twist_speed() / (PI * self.friction()))
    }

    /// Angular speed of the platform, Q cos(tau + theta).
    #[must_use]
    pub fn platform_angular_speed(&self, phase: Phase) -> f64 {
        self.angular_speed_at((phase.sin(), phase.cos()))
    }

    /// [`Self::platform_angular_speed`] at the phase with this sine and cosine.
    pub(crate) fn angular_speed_at(&self, pair: (f64, f64)) -> f64 {
        self.twist_cosine * pair.1 - self.twist_sine * pair.0
    }

    /// Angle of the platform, Q sin(tau + theta).
    #[must_use]
    pub fn platform_angle(&self, phase: Phase) -> f64 {
        self.twist_cosine * phase.sin() + self.twist_sine * phase.cos()
    }

    /// (Q cos theta, Q sin theta).
    pub(crate) const fn twist_components(&self) -> (f64, f64) {
        (self.twist_cosine, self.twist_sine)
    }
}

impl TryFrom<DimensionlessParameters> for DimensionlessSystem {
    type Error = Error;

    fn try_from(parameters: DimensionlessParameters) -> Result<Self, Error> {
        parameters.build()
    }
}

impl From<DimensionlessSystem> for DimensionlessParameters {
    fn from(system: DimensionlessSystem) -> Self {
        system.parameters
    }
}
