//! A disk on a platform with any periodic motion: Fourier sums, piecewise polynomials, measured waveforms.
//!
//! The laws are the same as in [`motion`](crate::motion), but the height s and the angle beta of Eq. (1) may
//! be any periodic functions. In contact the force is N = 1 + s'' (Eq. 3), and a sliding disk accelerates at
//! -sgn(w_T) mu N - l (Eqs. 4 and 12). Impacts follow Eqs. (5) to (10). Unlike the sine, a drive may have
//! *kinks*, at which its velocity jumps. If the height's velocity jumps down, the platform leaves the disk
//! behind; if it jumps up, the platform hits a disk in contact ([`Event::Kick`](crate::Event::Kick)); if the
//! angular speed jumps, friction cannot follow.
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
//! [`single_toss`] and [`multi_toss`] compute the tosses of such a hand; a [`Motor`](crate::Motor) has such a
//! stator if its sheet has a [drive](crate::motor::MotorParameters::drive). If one motion follows another, as
//! in a start-up, [`DrivenEngine::of_state`] continues from the state at the end of the previous one. The
//! core's [`DrivenMap`](crate::drives::DrivenMap) describes the vertical motion alone.

use bouncing_disk_drives::Drive;
use bouncing_disk_drives::compliance::{Compliance, CompliantPlatform};

use crate::error::Error;
use crate::parameters::contact::ContactLaw;
use crate::parameters::dimensionless::DimensionlessSystem;
use crate::parameters::disk::Disk;
use crate::parameters::driven_platform::{DrivenPlatform, Waveform};
use crate::parameters::system::System;

mod chatter;
mod contact;
pub(crate) mod engine;
mod ground;
pub(crate) mod toss;

pub use crate::motion::initial_condition::InitialCondition as DrivenStart;
pub use ground::{DrivenEngine, DrivenGround};
pub use toss::{multi_toss, single_toss};

/// A disk on a platform with any drives of height and angle, in dimensionless form; [`DimensionlessSystem`] is
/// its counterpart for the sine. Time is in radians of the fundamental, length in g/omega^2, angle in g
/// a_e/(a_g omega)^2.
#[derive(Debug, Clone, PartialEq)]
pub struct DrivenSystem {
    pub(crate) height: Drive,
    pub(crate) angle: Drive,
    pub(crate) friction: f64,
    pub(crate) restitution: f64,
    pub(crate) load: f64,
    /// A compliant contact instead of the law of impact.
    pub(crate) compliance: Option<CompliantPlatform>,
}

impl DrivenSystem {
    /// The system of this platform and this disk; [`DrivenPlatform::scales`] states its units.
    ///
    /// # Errors
    /// [`Error::Waveform`] for accelerations beyond 1e8 preloads; [`Error::OutOfRange`] if a unit is too
    /// small or too large for a double. With compliant contacts, also the errors of
    /// [`Self::with_contact_time`].
    pub fn new(platform: &DrivenPlatform, disk: &Disk) -> Result<Self, Error> {
        let scales = platform.scales(disk);
        scales.check()?;
        let sine = platform.platform();
        let (height, angle) = (sine.amplitude() / scales.length, sine.twist_amplitude() / scales.angle);
        let rigid = Self {
            height: platform.height().track("height", height, 0.0)?,
            angle: platform.angle().track("angle", angle, sine.phase_lag())?,
            friction: disk.friction(),
            restitution: disk.restitution(),
            load: disk.load_acceleration() / scales.angular_acceleration,
            compliance: None,
        };
        rigid.with_contact(platform.contact(), sine.angular_frequency())
    }

    /// This system with compliant contacts of this law and duration (s), on a platform of this angular
    /// frequency.
    fn with_contact(self, contact: Option<(ContactLaw, f64)>, angular_frequency: f64) -> Result<Self, Error> {
        match contact {
            None => Ok(self),
            Some((ContactLaw::Damper, time)) => self.with_contact_time(time * angular_frequency),
            Some((ContactLaw::Hysteresis, time)) => self.with_hysteretic_contact(time * angular_frequency),
        }
    }

    /// This system with the load, friction and phase lag of another motor on the same stator.
    pub(crate) fn for_motor(&self, stator: &DrivenPlatform, motor: &System) -> Result<Self, Error> {
        let own = motor.dimensionless();
        let (lag, known) = (motor.platform().phase_lag(), stator.platform().phase_lag());
        let angle = if lag.to_bits() == known.to_bits() {
            self.angle.clone()
        } else {
            let amplitude = stator.platform().twist_amplitude() / motor.scales().angle;
            stator.angle().track("angle", amplitude, lag)?
        };
        Ok(Self { angle, friction: own.friction(), load: own.load(), ..self.clone() })
    }

    /// This system with a compliant contact: an isolated impact lasts `contact_time` (rad) and has the
    /// system's restitution. A [`ChatterPolicy`](crate::core::ChatterPolicy) has no effect, because a chatter
    /// is then a finite number of contacts. [`multi_toss`] returns an error for such a system.
    ///
    /// # Errors
    /// The errors of [`Compliance::new`] and [`CompliantPlatform::new`].
    pub fn with_contact_time(self, contact_time: f64) -> Result<Self, Error> {
        let compliance = Compliance::new(contact_time, self.restitution)?;
        self.with_compliance(compliance)
    }

    /// Like [`Self::with_contact_time`], with a spring that [unloads](Compliance::hysteretic) at a lower
    /// stiffness instead of a damper.
    ///
    /// # Errors
    /// The errors of [`Self::with_contact_time`].
    pub fn with_hysteretic_contact(self, contact_time: f64) -> Result<Self, Error> {
        let compliance = Compliance::hysteretic(contact_time, self.restitution)?;
        self.with_compliance(compliance)
    }

    fn with_compliance(mut self, compliance: Compliance) -> Result<Self, Error> {
        self.compliance = Some(CompliantPlatform::new(self.height.clone(), compliance)?);
        Ok(self)
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
            compliance: None,
        })
    }
}
