//! The events that end segments of motion.

use crate::display::numbers;
use crate::error::Error;
use crate::motion::energy::EnergyLedger;
use crate::motion::phase_time::{PhaseSpan, PhaseTime};
use crate::motion::segment::Segment;
use crate::motion::state::{DiskState, SlipDirection, Snapshot};
use crate::motion::stator_ledger::{MODES, StatorLedger};
use crate::parameters::dimensionless::DimensionlessSystem;
use std::fmt::{self, Display, Formatter};
use std::ops::AddAssign;

/// An event.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
#[non_exhaustive]
pub enum Event {
    /// The disk hits the platform. In a compliant contact this is the start of the contact, whose impulses are
    /// distributed over the time until the separation.
    Impact {
        /// Relative axial velocity w_A (disk minus platform) just before it, <= 0, in units of g/omega.
        axial_impact_velocity: f64,
        /// Relative angular speed w_T (disk minus platform) just before it, in units of g a_e/(a_g^2 omega).
        tangential_impact_velocity: f64,
        /// Whether friction ended the slip during the impact; otherwise the disk slid throughout.
        capped: bool,
    },
    /// The disk comes to rest on the platform at the end of a chattering sequence, whose impulses the record
    /// sums.
    Attachment {
        /// Number of impacts summed.
        impacts: u64,
        /// Bound on the error of the attachment phase (rad). Infinite if no bound is known, and for the cut
        /// of a chatter with constant restitution, as in the paper. Zero for a compliant contact, for which
        /// attachment is defined as the time at which the transient is 1e-18 of the force.
        #[cfg_attr(
            feature = "serde",
            serde(deserialize_with = "bouncing_disk_core::stored::infinite_if_none")
        )]
        error_bound: f64,
    },
    /// The platform falls away from the disk; on a [driven](crate::driven) platform its velocity may also
    /// drop.
    Separation,
    /// Friction no longer holds the disk.
    StickToSlip(SlipDirection),
    /// The slip ends and friction holds the disk.
    SlipToStick,
    /// The slip ends, friction does not hold the disk, and it slips the other way, in this direction.
    SlipReversal(SlipDirection),
    /// The velocity of the platform jumps up under the disk at a kink and hits it, at zero distance, by the
    /// law of impact. The fields are as in [`Self::Impact`].
    Kick {
        /// Relative axial velocity just before it, < 0.
        axial_impact_velocity: f64,
        /// Relative angular speed just before it.
        tangential_impact_velocity: f64,
        /// Whether friction ended the slip during the impact.
        capped: bool,
    },
    /// The angular speed of the platform jumps, and the disk continues to slide, in this direction.
    SlipJump(SlipDirection),
    /// In a compliant contact, the force returns before the spring is free.
    Recontact,
    /// In a compliant contact without a damper, the spring begins to load, to unload or to hold still.
    Turn,
    /// The load or the drive of a compliant stator changes, as its table specifies.
    Joint,
}

/// An event, with the segment of motion that it ended.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct EventRecord {
    /// Time of the event.
    pub time: PhaseTime,
    /// The event.
    pub event: Event,
    /// The disk just before it.
    pub before: DiskState,
    /// The disk just after it.
    pub after: DiskState,
    /// Axial impulse per unit mass in units of g/omega, zero except in impacts and attachments. Not negative,
    /// except at the attachment of a cut ([`ChatterPolicy::Cut`](bouncing_disk_core::ChatterPolicy::Cut)),
    /// which removes the small velocity left by a rebound.
    pub axial_impulse: f64,
    /// Angular impulse per moment of inertia in units of g a_e/(a_g^2 omega).
    pub angular_impulse: f64,
    /// Energy balance of the segment and the event.
    pub ledger: EnergyLedger,
    /// The segment since the previous event.
    pub segment: Segment,
    /// Duration of the segment.
    pub span: PhaseSpan,
}

/// The energy balances of a disk and of the stator under it.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Energies {
    /// Energy balance of the disk.
    pub disk: EnergyLedger,
    /// Energy balance of the stator's modes; zero for a prescribed motion.
    pub stator: StatorLedger,
}

impl AddAssign for Energies {
    fn add_assign(&mut self, other: Self) {
        self.disk += other.disk;
        self.stator += other.stator;
    }
}

/// The record of an event in any motion.
pub trait MotionRecord {
    /// Time of the event.
    fn time(&self) -> PhaseTime;

    /// The event.
    fn event(&self) -> Event;

    /// The energy balances from the previous event to this one inclusive.
    fn energies(&self) -> Energies;
}

impl MotionRecord for EventRecord {
    fn time(&self) -> PhaseTime {
        self.time
    }

    fn event(&self) -> Event {
        self.event
    }

    fn energies(&self) -> Energies {
        Energies { disk: self.ledger, stator: StatorLedger::default() }
    }
}

/// A motion as a sequence of events, from an [`Engine`](crate::Engine), a
/// [`DrivenEngine`](crate::driven::DrivenEngine) or a [`StatorEngine`](crate::stator::StatorEngine).
pub trait Motion {
    /// The record of an event.
    type Record: MotionRecord;

    /// The instant of the last event, or of the start.
    fn time(&self) -> PhaseTime;

    /// The disk just after the last event, or at the start.
    fn disk(&self) -> DiskState;

    /// The next event, or `None` after the last one.
    ///
    /// # Errors
    /// The errors of the flights. An error ends the motion.
    fn advance(&mut self) -> Result<Option<Self::Record>, Error>;

    /// Whether the disk lies on the platform and never leaves it again, or the motion has ended.
    fn lies_for_ever(&self) -> bool;
}

/// A motion that can be followed to any time and perturbed, as needed by a motor. All spans are in radians
/// since the last event and are valid if no event comes before their end.
pub(crate) trait SteeredMotion: Motion + Send {
    /// The next event if it comes within `limit`. Otherwise the motion stays at its last event.
    fn advance_within(&mut self, limit: f64) -> Result<Option<Self::Record>, Error>;

    /// The disk `span` later.
    fn disk_after(&self, span: f64) -> DiskState;

    /// The axial velocity of the disk as a function of the `span`, called with increasing spans.
    fn velocities(&self) -> Box<dyn FnMut(f64) -> f64 + '_> {
        Box::new(|span| self.disk_after(span).axial_velocity)
    }

    /// The energy balances over this `span`.
    fn energies_after(&self, span: f64) -> Energies;

    /// The energy of the spring of a compliant contact `span` later, when the disk is in this `state`.
    fn spring_energy(&self, span: f64, state: &DiskState) -> f64;

    /// Whether a flight begins now; on a compliant stator, whether the disk is in flight.
    fn launches(&self) -> bool;

    /// Adds a relative speed >= 0 (g/omega) to a flight that starts now; does nothing at any other time.
    fn perturb_launch(&mut self, speed: f64);

    /// If the disk lies on a compliant stator, continues from `span` later and returns the energy balances up
    /// to then; otherwise the contact would be followed from the last event again. Any other motion stays at
    /// its last event and returns `None`.
    fn pause_contact(&mut self, _span: f64) -> Option<Energies> {
        None
    }

    /// Coordinates and speeds of the modes of a compliant stator at the last event; zero on any other platform.
    fn modes(&self) -> [[f64; 2]; MODES] {
        [[0.0; 2]; MODES]
    }

    /// The amplitude of the axial mode of a compliant stator `span` later.
    fn amplitude_after(&self, _span: f64) -> Option<f64> {
        None
    }

    /// Omits energies that take long to compute from the records; a run-up does not need them.
    fn skip_energies(&mut self);
}

impl EventRecord {
    /// Disk and platform during the segment, at the given `fraction` of it in [0, 1] from its start.
    #[must_use]
    pub fn evaluate(&self, system: &DimensionlessSystem, fraction: f64) -> Snapshot {
        self.segment.evaluate(system, self.span, fraction)
    }
}

impl Display for Event {
    /// Prints its numbers in the units of the motion.
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let n = numbers(f);
        write!(f, "{}", self.kind())?;
        match self {
            Self::Impact { axial_impact_velocity, tangential_impact_velocity, capped }
            | Self::Kick { axial_impact_velocity, tangential_impact_velocity, capped } => {
                let ends = if *capped { ", slip ends" } else { "" };
                write!(
                    f,
                    " with w_A = {} g/omega, w_T = {} g a_e/(a_g^2 omega)",
                    n(*axial_impact_velocity),
                    n(*tangential_impact_velocity)
                )?;
                f.write_str(ends)
            }
            Self::Attachment { impacts, error_bound } => {
                write!(f, " after {impacts} summed impacts, phase within {} rad", n(*error_bound))
            }
            Self::StickToSlip(direction) | Self::SlipReversal(direction) | Self::SlipJump(direction) => {
                write!(f, ", {direction}")
            }
            Self::Separation | Self::SlipToStick | Self::Recontact | Self::Turn | Self::Joint => Ok(()),
        }
    }
}
