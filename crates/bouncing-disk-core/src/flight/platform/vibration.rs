//! The platform's vertical vibration, in units where time is 1/omega and length g/omega^2.

use core::f64::consts::PI;

use crate::flight::platform::crests::Crests;
use crate::flight::platform::phase::Phase;
use crate::numerics::elementary::{CREST, asin};
use crate::numerics::error::{Error, within};
use crate::read_checked;

/// The vertical vibration of the platform, P sin tau, with what its flights need worked out once.
///
/// The one parameter is P = pi Gamma = A omega^2 / g: the platform's peak acceleration in units of the preload
/// acceleration. In these units P is also its amplitude and its peak speed.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedVibration"))]
pub struct Vibration {
    peak_acceleration: f64,
    /// Phase sigma at which P sin tau rises through 1 (pi/2 if it never does): a disk at rest separates, and
    /// the curvature of the gap turns positive.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub(crate) separation_angle: f64,
    /// pi - sigma: the curvature of the gap turns negative again.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub(crate) retention_angle: f64,
    /// P cos sigma: the platform's speed at separation, zero for P <= 1.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub(crate) separation_speed: f64,
    /// P - P sin sigma: how far the platform is below its crest at separation.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub(crate) separation_depth: f64,
    /// A gap at a crest or an inflection that may be rounding only, in the crest form.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub(crate) doubtful_gap: f64,
    /// Which launches clear the first crest for certain.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub(crate) crests: Crests,
}

/// Both forcing parameters: `Gamma = 0.45 (P = 1.4137)`.
impl core::fmt::Display for Vibration {
    fn fmt(&self, formatter: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(formatter, "Gamma = {} (P = {})", self.axial_forcing(), self.peak_acceleration)
    }
}

read_checked!(Vibration as UncheckedVibration { peak_acceleration: f64 } => Vibration::new);

impl Vibration {
    /// Largest peak acceleration accepted (units of g).
    pub const MAX_PEAK_ACCELERATION: f64 = 1.0e8;

    /// A vibration with peak acceleration P = A omega^2 / g = pi Gamma, from 0 (still platform) to
    /// [`Self::MAX_PEAK_ACCELERATION`].
    ///
    /// # Errors
    /// [`Error::OutOfRange`] outside that range or for NaN.
    pub fn new(peak_acceleration: f64) -> Result<Self, Error> {
        let p = within(
            "peak_acceleration",
            peak_acceleration,
            0.0,
            Self::MAX_PEAK_ACCELERATION,
            "[0, 1e8] (units of the preload acceleration)",
        )?;
        // sqrt(P^2 - 1) without cancellation next to P = 1.
        let (separation_angle, separation_speed, separation_depth) = if p > 1.0 {
            (asin(1.0 / p), ((p - 1.0) * (p + 1.0)).sqrt(), p - 1.0)
        } else {
            (CREST, 0.0, 0.0)
        };
        Ok(Self {
            peak_acceleration: p,
            separation_angle,
            retention_angle: PI - separation_angle,
            separation_speed,
            separation_depth,
            doubtful_gap: 1.0e-14 * (1.0 + p),
            crests: Crests::new(p, separation_angle, separation_speed),
        })
    }

    /// A platform that does not vibrate.
    pub(crate) const fn still() -> Self {
        Self {
            peak_acceleration: 0.0,
            separation_angle: CREST,
            retention_angle: PI - CREST,
            separation_speed: 0.0,
            separation_depth: 0.0,
            doubtful_gap: 1.0e-14,
            crests: Crests::new(0.0, CREST, 0.0),
        }
    }

    /// A vibration with the paper's axial forcing parameter Gamma = A omega^2 / (pi g).
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn from_axial_forcing(axial_forcing: f64) -> Result<Self, Error> {
        within(
            "axial_forcing",
            axial_forcing,
            0.0,
            Self::MAX_PEAK_ACCELERATION / PI,
            "[0, 3.18e7] (A omega^2 / (pi g))",
        )?;
        Self::new(PI * axial_forcing)
    }

    /// Peak acceleration P in units of the preload acceleration.
    #[must_use]
    #[inline(always)]
    pub const fn peak_acceleration(&self) -> f64 {
        self.peak_acceleration
    }

    /// The paper's Gamma = P / pi.
    #[must_use]
    pub fn axial_forcing(&self) -> f64 {
        self.peak_acceleration / PI
    }

    /// Height of the platform P sin tau, in units of g/omega^2.
    #[must_use]
    #[inline]
    pub fn height(&self, phase: Phase) -> f64 {
        self.peak_acceleration * phase.sin()
    }

    /// Velocity of the platform P cos tau, in units of g/omega.
    #[must_use]
    #[inline]
    pub fn velocity(&self, phase: Phase) -> f64 {
        self.peak_acceleration * phase.cos()
    }

    /// Acceleration of the platform -P sin tau, in units of g.
    #[must_use]
    #[inline]
    pub fn acceleration(&self, phase: Phase) -> f64 {
        -self.peak_acceleration * phase.sin()
    }
}
