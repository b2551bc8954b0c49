//! The next-collision map (Sec. IV): from (tau_imp, w_A, w_T) at one impact to the same three numbers at the
//! next.
//!
//! The first two do not depend on the third: the derivative of the map is block triangular, and its rotary
//! entry is 0 for an impact in which the slip ends and 1 for one that slides throughout.

use bouncing_disk_core::{ChatterPolicy, ImpactState, Phase};

use crate::error::{Error, moderate};
use crate::motion::engine::Engine;
use crate::motion::event::{Event, EventRecord, Motion};
use crate::motion::impact::{axial_impulse, friction_impact, rebound_velocity};
use crate::motion::initial_condition::InitialCondition;
use crate::motion::phase_time::PhaseTime;
use crate::parameters::dimensionless::DimensionlessSystem;

/// The state just before a collision: the paper's tau_imp, w_A and w_T.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct CollisionState {
    /// Phase of the impact, tau_imp.
    pub phase: Phase,
    /// Relative axial velocity w_A (disk minus platform), <= 0, in units of g/omega.
    pub axial_impact_velocity: f64,
    /// Relative angular speed w_T (disk minus platform), in units of g a_e/(a_g^2 omega).
    pub tangential_impact_velocity: f64,
}

impl CollisionState {
    /// The disk's angular speed just before the impact, in units of g a_e/(a_g^2 omega).
    #[must_use]
    pub fn angular_speed(&self, system: &DimensionlessSystem) -> f64 {
        self.tangential_impact_velocity + system.platform_angular_speed(self.phase)
    }

    /// The vertical part of the state.
    ///
    /// # Errors
    /// An error of the core for a positive or non-finite axial velocity.
    pub fn vertical(&self) -> Result<ImpactState, Error> {
        Ok(ImpactState::new(self.phase, self.axial_impact_velocity)?)
    }

    /// The continuation of the motion: the rebound from this impact as a start of an [`Engine`].
    ///
    /// # Errors
    /// [`Error::OutOfRange`] or an error of the core for velocities that no impact can have.
    pub fn rebound(&self, system: &DimensionlessSystem) -> Result<InitialCondition, Error> {
        let vertical = self.vertical()?;
        let slip = moderate("tangential_impact_velocity", self.tangential_impact_velocity)?;
        let axial = axial_impulse(system.restitution(), vertical.velocity());
        let rotary = friction_impact(system.friction(), axial, slip);
        let platform_speed = system.platform_angular_speed(self.phase);
        let angular_speed = rotary.speed_after(platform_speed + slip, platform_speed);
        let relative_speed = rebound_velocity(system.restitution(), vertical.velocity());
        Ok(if relative_speed > 0.0 {
            InitialCondition::Launch { phase: self.phase, relative_speed, angular_speed }
        } else {
            InitialCondition::Contact { phase: self.phase, angular_speed }
        })
    }
}

/// One collision of an orbit.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Collision {
    /// Time of the impact.
    pub time: PhaseTime,
    /// State just before it.
    pub state: CollisionState,
    /// The disk's angular speed just before it, in units of g a_e/(a_g^2 omega).
    pub angular_speed: f64,
    /// Angle through which the disk has turned, in units of g a_e/(a_g omega)^2.
    pub angle: f64,
    /// Whether friction ended the slip during the impact.
    pub capped: bool,
}

/// An item of [`Collisions`].
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub enum CollisionEvent {
    /// An impact.
    Collision(Collision),
    /// The chattering has ended and the disk lies on the platform.
    Attachment {
        /// Time of the attachment.
        time: PhaseTime,
        /// Impacts summed by the complete policy, which are not reported singly.
        summed_impacts: u64,
    },
    /// The platform falls away from the disk.
    Separation {
        /// Time of the separation.
        time: PhaseTime,
        /// The disk's angular speed.
        angular_speed: f64,
        /// Angle through which the disk has turned.
        angle: f64,
    },
}

/// The lazy sequence of a motion's collisions (including kicks), attachments and separations.
///
/// It ends if the disk stays on the platform for ever, and after an error.
#[derive(Debug, Clone)]
pub struct Collisions<M = Engine> {
    motion: M,
}

impl Collisions {
    /// The collisions of a [`crate::System`] or [`DimensionlessSystem`] from a start.
    ///
    /// # Errors
    /// The errors of [`Engine::new`].
    pub fn new(
        system: impl TryInto<DimensionlessSystem, Error: Into<Error>>,
        start: InitialCondition,
        policy: ChatterPolicy,
    ) -> Result<Self, Error> {
        Ok(Self::of(Engine::new(system, start, policy)?))
    }

    /// The collisions that follow the one in `state`, which is not itself reported.
    ///
    /// # Errors
    /// The errors of [`CollisionState::rebound`] and [`Engine::new`].
    pub fn after(
        system: impl TryInto<DimensionlessSystem, Error: Into<Error>>,
        state: CollisionState,
        policy: ChatterPolicy,
    ) -> Result<Self, Error> {
        let system = system.try_into().map_err(Into::into)?;
        Self::new(system, state.rebound(&system)?, policy)
    }

    /// The system.
    #[must_use]
    pub const fn system(&self) -> &DimensionlessSystem {
        self.motion.system()
    }
}

impl<M: Motion<Record = EventRecord>> Collisions<M> {
    /// The collisions of this motion from its current state on.
    #[must_use]
    pub const fn of(motion: M) -> Self {
        Self { motion }
    }

    /// The next event, or `None` after the last one.
    ///
    /// # Errors
    /// The errors of [`Motion::advance`].
    pub fn advance(&mut self) -> Result<Option<CollisionEvent>, Error> {
        while !self.motion.lies_for_ever() {
            let Some(record) = self.motion.advance()? else { break };
            if let Some(event) = collision_event(&record) {
                return Ok(Some(event));
            }
        }
        Ok(None)
    }
}

impl<M: Motion<Record = EventRecord>> Iterator for Collisions<M> {
    type Item = Result<CollisionEvent, Error>;

    fn next(&mut self) -> Option<Self::Item> {
        self.advance().transpose()
    }
}

const fn collision_event(record: &EventRecord) -> Option<CollisionEvent> {
    let time = record.time;
    match record.event {
        Event::Impact { axial_impact_velocity, tangential_impact_velocity, capped }
        | Event::Kick { axial_impact_velocity, tangential_impact_velocity, capped } => {
            Some(CollisionEvent::Collision(Collision {
                time,
                state: CollisionState {
                    phase: time.phase,
                    axial_impact_velocity,
                    tangential_impact_velocity,
                },
                angular_speed: record.before.angular_speed,
                angle: record.before.angle,
                capped,
            }))
        }
        Event::Attachment { impacts, .. } => {
            Some(CollisionEvent::Attachment { time, summed_impacts: impacts })
        }
        Event::Separation => Some(CollisionEvent::Separation {
            time,
            angular_speed: record.after.angular_speed,
            angle: record.after.angle,
        }),
        Event::StickToSlip(_)
        | Event::SlipToStick
        | Event::SlipReversal(_)
        | Event::SlipJump(_)
        | Event::Recontact
        | Event::Turn
        | Event::Joint => None,
    }
}
