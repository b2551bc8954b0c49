//! The events that end segments of motion.

use crate::display::numbers;
use crate::motion::energy::EnergyLedger;
use crate::motion::phase_time::{PhaseSpan, PhaseTime};
use crate::motion::segment::Segment;
use crate::motion::state::{DiskState, SlipDirection, Snapshot};
use crate::parameters::dimensionless::DimensionlessSystem;
use std::fmt::{self, Display, Formatter};

/// An event.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
#[non_exhaustive]
pub enum Event {
    /// The disk hits the platform.
    Impact {
        /// Relative axial velocity w_A (disk minus platform) just before, <= 0, in units of g/omega.
        axial_impact_velocity: f64,
        /// Relative angular speed w_T (disk minus platform) just before, in units of g a_e/(a_g^2 omega).
        tangential_impact_velocity: f64,
        /// Whether friction ended the slip within the impact; otherwise the disk slid throughout.
        capped: bool,
    },
    /// The disk comes to rest on the platform at the end of a chattering sequence, whose impulses the record
    /// sums.
    Attachment {
        /// Impacts summed.
        impacts: u64,
        /// Bound on the error of the attachment phase (rad); infinite for the cut of a chatter with constant
        /// restitution, as in the paper, and where no bound is known.
        #[cfg_attr(
            feature = "serde",
            serde(deserialize_with = "bouncing_disk_core::stored::infinite_if_none")
        )]
        error_bound: f64,
    },
    /// The platform falls away from the disk.
    Separation,
    /// Friction no longer holds the disk.
    StickToSlip(SlipDirection),
    /// The slip ends and friction holds the disk.
    SlipToStick,
    /// The slip ends, friction does not hold the disk, and it slips the other way, in this direction.
    SlipReversal(SlipDirection),
}

/// An event, with the segment of motion that it ended.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct EventRecord {
    /// When it happened.
    pub time: PhaseTime,
    /// The event.
    pub event: Event,
    /// The disk just before.
    pub before: DiskState,
    /// The disk just after.
    pub after: DiskState,
    /// Axial impulse per unit mass in units of g/omega, zero except in impacts and attachments. Not negative,
    /// except at the attachment of a cut ([`ChatterPolicy::Cut`](bouncing_disk_core::ChatterPolicy::Cut)),
    /// which removes the small velocity left by a rebound.
    pub axial_impulse: f64,
    /// Angular impulse per moment of inertia in units of g a_e/(a_g^2 omega).
    pub angular_impulse: f64,
    /// Energy balance of the segment and the event.
    pub ledger: EnergyLedger,
    /// The segment since the event before.
    pub segment: Segment,
    /// Its duration.
    pub span: PhaseSpan,
}

impl EventRecord {
    /// Disk and platform during the segment, `fraction` of it in [0, 1] after its start.
    #[must_use]
    pub fn evaluate(&self, system: &DimensionlessSystem, fraction: f64) -> Snapshot {
        self.segment.evaluate(system, self.span, fraction)
    }
}

impl Display for Event {
    /// With its numbers in the units of the motion.
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let n = numbers(f);
        write!(f, "{}", self.kind())?;
        match self {
            Self::Impact { axial_impact_velocity, tangential_impact_velocity, capped } => {
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
            Self::StickToSlip(direction) | Self::SlipReversal(direction) => write!(f, ", {direction}"),
            Self::Separation | Self::SlipToStick => Ok(()),
        }
    }
}
