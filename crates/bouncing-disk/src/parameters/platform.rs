//! The vibrating and twisting platform, Eq. (1): the hand, or the stator.

use crate::display::numbers;
use std::f64::consts::PI;
use std::fmt::{self, Display, Formatter};

use bouncing_disk_core::Phase;
use bouncing_disk_core::numerics::elementary::sin_cos;

use crate::error::{Error, finite, not_negative, positive};

/// The parameters of a [`Platform`], not yet checked.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct PlatformParameters {
    /// Amplitude A of the height (m), not negative.
    pub amplitude: f64,
    /// Amplitude Phi of the angle (rad), not negative.
    pub twist_amplitude: f64,
    /// Angular frequency omega (rad/s), positive.
    pub angular_frequency: f64,
    /// Phase lag theta of the twist (rad), any finite number.
    pub phase_lag: f64,
}

impl PlatformParameters {
    /// Checks the ranges.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] with the field, its value and its legal range.
    pub fn build(self) -> Result<Platform, Error> {
        not_negative("amplitude", self.amplitude)?;
        not_negative("twist_amplitude", self.twist_amplitude)?;
        positive("angular_frequency", self.angular_frequency)?;
        finite("phase_lag", self.phase_lag)?;
        let (sin_lag, cos_lag) = sin_cos(self.phase_lag);
        Ok(Platform { parameters: self, sin_lag, cos_lag })
    }
}

/// The platform's motion (Eq. 1): height s = A sin tau, angle beta = Phi sin(tau + theta), with tau = omega
/// t.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "PlatformParameters", into = "PlatformParameters"))]
pub struct Platform {
    parameters: PlatformParameters,
    sin_lag: f64,
    cos_lag: f64,
}

impl Platform {
    /// The parameters, which can be changed and built again.
    #[must_use]
    pub const fn parameters(&self) -> PlatformParameters {
        self.parameters
    }

    /// Amplitude A of the height (m).
    #[must_use]
    pub const fn amplitude(&self) -> f64 {
        self.parameters.amplitude
    }

    /// Amplitude Phi of the angle (rad).
    #[must_use]
    pub const fn twist_amplitude(&self) -> f64 {
        self.parameters.twist_amplitude
    }

    /// Angular frequency omega (rad/s).
    #[must_use]
    pub const fn angular_frequency(&self) -> f64 {
        self.parameters.angular_frequency
    }

    /// Phase lag theta of the twist (rad).
    #[must_use]
    pub const fn phase_lag(&self) -> f64 {
        self.parameters.phase_lag
    }

    /// Height s (m).
    #[must_use]
    pub fn height(&self, phase: Phase) -> f64 {
        self.amplitude() * phase.sin()
    }

    /// Vertical velocity ds/dt (m/s).
    #[must_use]
    pub fn velocity(&self, phase: Phase) -> f64 {
        self.amplitude() * self.angular_frequency() * phase.cos()
    }

    /// Angle beta (rad).
    #[must_use]
    pub fn angle(&self, phase: Phase) -> f64 {
        self.twist_amplitude() * (phase.sin() * self.cos_lag + phase.cos() * self.sin_lag)
    }

    /// Angular speed d beta/dt (rad/s).
    #[must_use]
    pub fn angular_speed(&self, phase: Phase) -> f64 {
        self.peak_angular_speed() * (phase.cos() * self.cos_lag - phase.sin() * self.sin_lag)
    }

    /// Largest angular speed omega Phi (rad/s).
    #[must_use]
    pub fn peak_angular_speed(&self) -> f64 {
        self.angular_frequency() * self.twist_amplitude()
    }

    /// Axial forcing parameter Gamma = A omega^2/(pi g) under a preload acceleration g (m/s^2, positive)
    /// (Sec. I).
    #[must_use]
    pub fn axial_forcing(&self, preload_acceleration: f64) -> f64 {
        self.peak_acceleration() / (PI * preload_acceleration)
    }

    /// Largest vertical acceleration A omega^2 (m/s^2).
    #[must_use]
    pub fn peak_acceleration(&self) -> f64 {
        self.amplitude() * self.angular_frequency() * self.angular_frequency()
    }
}

impl TryFrom<PlatformParameters> for Platform {
    type Error = Error;

    fn try_from(parameters: PlatformParameters) -> Result<Self, Error> {
        parameters.build()
    }
}

impl From<Platform> for PlatformParameters {
    fn from(platform: Platform) -> Self {
        platform.parameters
    }
}

impl Display for Platform {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let own = [self.amplitude(), self.twist_amplitude(), self.angular_frequency(), self.phase_lag()];
        let [a, phi, omega, theta] = own.map(numbers(f));
        write!(f, "A = {a} m, Phi = {phi} rad, omega = {omega} rad/s, theta = {theta} rad")
    }
}
