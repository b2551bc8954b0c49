//! The platform's vertical vibration, with time in units of 1/omega and length in units of g/omega^2.

use crate::flight::platform::phase::Phase;
use crate::numerics::elementary::{CREST, asin};
use crate::numerics::error::{Error, within};
use crate::numerics::stored::read_checked;
use core::f64::consts::{PI, TAU};

/// The vertical vibration of the platform, P sin tau, with the constants of its flights computed once.
///
/// Its only parameter is P = pi Gamma = A omega^2 / g: the platform's peak acceleration in units of the
/// preload acceleration. In these units P is also its amplitude and its peak speed.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedVibration"))]
pub struct Vibration {
    peak_acceleration: f64,
    /// Phase sigma at which P sin tau rises through 1 (pi/2 if it never does): there a disk at rest separates,
    /// and the curvature of the gap turns positive.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub(crate) separation_angle: f64,
    /// pi - sigma, where the curvature of the gap turns negative again.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub(crate) retention_angle: f64,
    /// P cos sigma: the platform's speed at separation, zero for P <= 1.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub(crate) separation_speed: f64,
    /// P - P sin sigma: how far the platform is below its crest at separation.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub(crate) separation_depth: f64,
    /// The size of a gap at a crest or an inflection that may be pure rounding error, in the crest form.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub(crate) doubtful_gap: f64,
    /// Bounds for launches that certainly clear the first crest.
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
        // sqrt(P^2 - 1) without cancellation near P = 1.
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
    /// Errors of [`Self::new`].
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

impl Vibration {
    /// Weight that a resting disk puts on the platform per unit mass, 1 - P sin tau, in units of g (Eq. 3 as
    /// corrected in docs/errata.md); the disk separates when it falls to zero.
    #[must_use]
    #[inline]
    pub fn contact_force(&self, phase: Phase) -> f64 {
        1.0 - self.peak_acceleration() * phase.sin()
    }
}

/// Share of 1 + P by which the gaps and speeds of [`Crests`] and of the flight bounds must exceed equality: far
/// more than their rounding.
pub(crate) const CLEAR: f64 = 1.0e-9;

/// Share of 1 + P by which a disk at the crest must exceed the speed of one that falls past it.
const CLEAR_FALL: f64 = 1.0e-5;

/// The numbers that decide whether a launch clears the first crest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Crests {
    /// Time from the separation to the crest (rad).
    pub(crate) separation_to_crest: f64,
    /// A disk at least this fast at the crest has not been slower than the platform since the separation.
    pub(crate) rising_speed: f64,
}

impl Crests {
    pub(crate) const fn new(peak: f64, separation_angle: f64, separation_speed: f64) -> Self {
        let separation_to_crest = CREST - separation_angle;
        Self {
            separation_to_crest,
            rising_speed: (separation_speed - separation_to_crest) + CLEAR * (1.0 + peak),
        }
    }

    /// Whether a launch is certain not to be hit before the first crest, unless within half a radian (proof at
    /// the head of `flight/bounds.rs`). `disk_speed` is the speed at launch; `arc_speed` is the negative speed
    /// with which the disk comes down to the height of the crests, NaN if it stays below them.
    #[inline(always)]
    pub(crate) fn surely_cleared(&self, peak: f64, angle: f64, disk_speed: f64, arc_speed: f64) -> bool {
        let ahead = CREST - angle;
        let crest = ahead + if ahead > 0.0 { 0.0 } else { TAU };
        let speed = disk_speed - crest;
        let above = speed - arc_speed >= CLEAR_FALL * (1.0 + peak);
        (crest <= self.separation_to_crest) | (above & ((speed <= 0.0) | (speed >= self.rising_speed)))
    }
}

impl Vibration {
    /// The phase at which a disk at rest on the platform separates, asin(1/P) (Eq. 15), or `None` if the
    /// platform never falls away (P <= 1).
    #[must_use]
    pub fn separation_phase(&self) -> Option<Phase> {
        let p = self.peak_acceleration();
        (p > 1.0).then(|| Phase::from_parts(self.separation_angle, 1.0 / p, self.separation_speed / p))
    }

    /// Whether the platform falls away from a resting disk at this angle (rad) in [0, 2 pi): sigma <= tau <
    /// pi - sigma.
    #[must_use]
    #[inline(always)]
    pub fn falls_away_at(&self, angle: f64) -> bool {
        angle >= self.separation_angle && angle < self.retention_angle
    }

    /// Time from `angle` to the next separation phase sigma, in (0, 2 pi].
    #[inline(always)]
    pub(crate) fn time_to_separation(&self, angle: f64) -> f64 {
        let ahead = self.separation_angle - angle;
        if ahead > 0.0 { ahead } else { ahead + TAU }
    }
}
