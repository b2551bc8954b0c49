//! A disk on a platform that moves in any way: Fourier sums, pieces of polynomials, measured waveforms, and
//! schedules of them.
//!
//! The laws are those of [`motion`](crate::motion), with the height s and the angle beta of any platform in
//! place of Eq. (1): in contact the force is N = 1 + s'' (Eq. 3), a disk that slides is accelerated by -sgn(w_T)
//! mu N - l (Eqs. 4 and 12), and an impact has the impulses of Eqs. (5) to (10). What a sine does not have is a
//! *kink*: where the velocity of the platform drops it leaves the disk behind, where it rises it hits the disk
//! at zero distance ([`DrivenEvent::Kick`]), and where its angular speed jumps friction cannot follow.
//!
//! ```
//! use bouncing_disk::System;
//! use bouncing_disk::core::{ChatterPolicy, Phase};
//! use bouncing_disk::driven::{DrivenEngine, DrivenStart, DrivenSystem};
//! use bouncing_disk::parameters::{DrivenPlatform, Waveform};
//!
//! // The dough of Table I on a hand that moves along straight lines.
//! let toss = System::pizza_toss();
//! let hand = DrivenPlatform::new(*toss.platform(), Waveform::Triangle, Waveform::Triangle)?;
//! let system = DrivenSystem::new(&hand, toss.disk())?;
//! let start = DrivenStart::Contact { phase: Phase::new(0.0)?, angular_speed: 0.0 };
//! for record in DrivenEngine::new(system, start, ChatterPolicy::Complete)?.take(20) {
//!     assert!(record?.ledger.relative_closure() < 1e-12);
//! }
//! # Ok::<(), bouncing_disk::Error>(())
//! ```
//!
//! [`single_toss`] and [`multi_toss`] are the tosses of such a hand, [`transient`] and [`speed_curve`] the motor
//! with such a stator; a [`Schedule`] joins several motions, as a start-up does. The vertical motion alone is
//! the core's [`DrivenMap`](crate::core::DrivenMap).

use bouncing_disk_core::Drive;

use crate::error::Error;
use crate::motion::energy::EnergyLedger;
use crate::motion::phase_time::{PhaseSpan, PhaseTime};
use crate::motion::state::{DiskState, SlipDirection};
use crate::parameters::dimensionless::DimensionlessSystem;
use crate::parameters::disk::Disk;
use crate::parameters::driven_platform::{DrivenPlatform, Waveform};

mod chatter;
mod contact;
pub(crate) mod engine;
pub(crate) mod motor;
pub(crate) mod schedule;
pub(crate) mod toss;

pub use crate::motion::initial_condition::InitialCondition as DrivenStart;
pub use crate::parameters::driven_platform::{AfterSchedule, ScheduleSegment};
pub use engine::DrivenEngine;
pub use motor::{SpeedAtLoad, speed_curve, transient};
pub use schedule::{Schedule, ScheduledEngine, ScheduledRecord};
pub use toss::{DrivenToss, DrivenTossOrbit, TossImpact, multi_toss, single_toss};

/// A disk on a platform that moves in any way, without units, as
/// [`DimensionlessSystem`] is for a sine: time in radians of the
/// fundamental, length in g/omega^2, angle in g a_e/(a_g omega)^2.
#[derive(Debug, Clone, PartialEq)]
pub struct DrivenSystem {
    pub(crate) height: Drive,
    pub(crate) angle: Drive,
    pub(crate) friction: f64,
    pub(crate) restitution: f64,
    pub(crate) load: f64,
}

impl DrivenSystem {
    /// The system of these two; [`DrivenPlatform::scales`] has its units.
    ///
    /// # Errors
    /// [`Error::Waveform`] for accelerations beyond 1e8 preloads; [`Error::OutOfRange`] if a unit is too small or
    /// too large for a double.
    pub fn new(platform: &DrivenPlatform, disk: &Disk) -> Result<Self, Error> {
        let scales = platform.scales(disk);
        scales.check()?;
        let sine = platform.platform();
        let (height, angle) = (sine.amplitude() / scales.length, sine.twist_amplitude() / scales.angle);
        Ok(Self {
            height: platform.height().track("height", height, 0.0)?,
            angle: platform.angle().track("angle", angle, sine.phase_lag())?,
            friction: disk.friction(),
            restitution: disk.restitution(),
            load: disk.load_acceleration() / scales.angular_acceleration,
        })
    }

    /// The drive of the height.
    #[must_use]
    pub const fn height(&self) -> &Drive {
        &self.height
    }

    /// The drive of the angle, in the units of the angle.
    #[must_use]
    pub const fn angle(&self) -> &Drive {
        &self.angle
    }

    fn is_ramp(&self) -> bool {
        self.height.duration().is_finite() || self.angle.duration().is_finite()
    }
}

impl TryFrom<DimensionlessSystem> for DrivenSystem {
    type Error = Error;

    /// The platform of Eq. (1) as a Fourier sum.
    fn try_from(system: DimensionlessSystem) -> Result<Self, Error> {
        Ok(Self {
            height: Waveform::Sine.track("height", system.peak_acceleration(), 0.0)?,
            angle: Waveform::Sine.track("angle", system.twist_speed(), system.phase_lag())?,
            friction: system.friction(),
            restitution: system.restitution(),
            load: system.load(),
        })
    }
}

/// An event of the motion on a driven platform.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub enum DrivenEvent {
    /// The disk hits the platform.
    Impact(Hit),
    /// The disk comes to rest on the platform at the end of a chattering sequence.
    Attachment {
        /// Impacts summed.
        impacts: u64,
        /// Bound on the error of its time (rad); infinite for a cut.
        error_bound: f64,
    },
    /// The contact force falls to zero, or the velocity of the platform drops: the disk leaves.
    Separation,
    /// The velocity of the platform rises under the disk and hits it, at zero distance, by the law of impact.
    Kick(Hit),
    /// Friction no longer holds the disk.
    StickToSlip(SlipDirection),
    /// The slip ends and friction holds the disk.
    SlipToStick,
    /// The slip ends and another one begins, in this direction.
    SlipReversal(SlipDirection),
    /// The angular speed of the platform jumps, and the disk slides on in this direction.
    SlipJump(SlipDirection),
    /// A segment of a schedule ends.
    Joint,
}

/// The numbers of an impact.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Hit {
    /// Relative axial velocity w_A (disk minus platform) just before, <= 0, in units of g/omega.
    pub axial_impact_velocity: f64,
    /// Relative angular speed w_T just before, in units of g a_e/(a_g^2 omega).
    pub tangential_impact_velocity: f64,
    /// Whether friction ended the slip within the impact.
    pub capped: bool,
}

/// A [`DrivenEvent`], and what happened since the event before.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct DrivenRecord {
    /// When it happened; the phase is that of the fundamental. In a ramp it is counted from the ramp's start.
    pub time: PhaseTime,
    /// The time since the event before.
    pub span: PhaseSpan,
    /// The event.
    pub event: DrivenEvent,
    /// The disk just before.
    pub before: DiskState,
    /// The disk just after.
    pub after: DiskState,
    /// Axial impulse per unit mass, in units of g/omega; negative only where a cut takes a rebound away.
    pub axial_impulse: f64,
    /// Angular impulse per moment of inertia, in units of g a_e/(a_g^2 omega).
    pub angular_impulse: f64,
    /// The energy balance since the event before, the event itself included.
    pub ledger: EnergyLedger,
}
