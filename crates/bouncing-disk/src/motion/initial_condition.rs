//! The start of a motion.

use bouncing_disk_core::Phase;

/// The state in which the engine starts, dimensionless (see [`crate::parameters::Scales`] for the units).
///
/// The disk's angle starts at the platform's own angle.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub enum InitialCondition {
    /// The disk lies on the platform. An angular speed within rounding of the platform's is set to the
    /// platform's. If the platform falls away at once (P sin tau >= 1, tau before its end), the disk starts
    /// in flight.
    Contact {
        /// Phase of the platform.
        phase: Phase,
        /// Angular speed of the disk; for the platform's see
        /// [`crate::parameters::DimensionlessSystem::platform_angular_speed`].
        angular_speed: f64,
    },
    /// The disk leaves the platform.
    Launch {
        /// Phase of the platform.
        phase: Phase,
        /// Axial velocity relative to the platform, not negative; zero is legal only if the platform falls
        /// away.
        relative_speed: f64,
        /// Angular speed of the disk.
        angular_speed: f64,
    },
    /// The disk is above the platform.
    Flight {
        /// Phase of the platform.
        phase: Phase,
        /// Height above the platform, in (0, 1e17].
        gap: f64,
        /// Axial velocity relative to the platform, of either sign.
        relative_velocity: f64,
        /// Angular speed of the disk.
        angular_speed: f64,
    },
}

impl InitialCondition {
    /// Phase and angular speed; for a disk off the platform also its distance and its relative velocity.
    pub(crate) const fn parts(&self) -> (Phase, f64, Option<[f64; 2]>) {
        match *self {
            Self::Contact { phase, angular_speed } => (phase, angular_speed, None),
            Self::Launch { phase, relative_speed, angular_speed } => {
                (phase, angular_speed, Some([0.0, relative_speed]))
            }
            Self::Flight { phase, gap, relative_velocity, angular_speed } => {
                (phase, angular_speed, Some([gap, relative_velocity]))
            }
        }
    }
}
