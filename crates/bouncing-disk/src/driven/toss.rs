//! Tosses by a hand that moves in any way, in SI units (Secs. III and IV).

use std::f64::consts::TAU;

use bouncing_disk_core::{ChatterPolicy, Phase};

use super::engine::DrivenEngine;
use super::{DrivenEvent, DrivenStart, DrivenSystem};
use crate::error::{Error, check, finite};
use crate::motion::energy::EnergyLedger;
use crate::motion::si::SiEnergy;
use crate::parameters::disk::Disk;
use crate::parameters::driven_platform::DrivenPlatform;
use crate::toss::MultiTossSettings;

/// Most events without a departure after which a disk counts as one that never leaves.
const MOST_CONTACT_EVENTS: usize = 10_000;

/// A single toss, up to the disk's departure from the hand.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct DrivenToss {
    /// Airborne rotary speed (rad/s).
    pub airborne_speed: f64,
    /// Vertical speed of the disk as it leaves (m/s).
    pub launch_speed: f64,
    /// Time from the start to the departure (s).
    pub time: f64,
    /// Phase of the departure (rad).
    pub phase: f64,
    /// Whether a kink has thrown the disk; else the platform fell away.
    pub kicked: bool,
    /// Rotary energy gained over the work of the hand, as for
    /// [`TossPerformance`](crate::toss::TossPerformance::efficiency).
    pub efficiency: f64,
    /// The energy balance up to the departure (J/kg).
    pub energy: SiEnergy,
}

/// The toss of a disk that lies on the hand at `phase` with this angular speed (rad/s).
///
/// # Errors
/// [`Error::NeverLeaves`] if it stays on the hand; those of [`DrivenSystem::new`].
pub fn single_toss(
    platform: &DrivenPlatform,
    disk: &Disk,
    phase: Phase,
    angular_speed: f64,
) -> Result<DrivenToss, Error> {
    let (system, scales) = (DrivenSystem::new(platform, disk)?, platform.scales(disk));
    let peak_acceleration = system.height().bounds().acceleration;
    let spin = finite("angular_speed", angular_speed)? / scales.angular_speed;
    let start = DrivenStart::Contact { phase, angular_speed: spin };
    let mut ledger = EnergyLedger::default();
    let mut time = 0.0;
    for record in DrivenEngine::new(system, start, ChatterPolicy::Complete)?.take(MOST_CONTACT_EVENTS) {
        let record = record?;
        ledger += record.ledger;
        time += record.span.radians();
        let kicked = matches!(record.event, DrivenEvent::Kick(_)) && disk.restitution() > 0.0;
        if kicked || matches!(record.event, DrivenEvent::Separation) {
            let (state, energy) = (scales.state(&record.after), scales.energy(&ledger));
            return Ok(DrivenToss {
                airborne_speed: state.angular_speed,
                launch_speed: state.axial_velocity,
                time: time * scales.time,
                phase: record.time.phase.angle(),
                kicked,
                efficiency: energy.efficiency(0.0),
                energy,
            });
        }
    }
    Err(Error::NeverLeaves { peak_acceleration })
}

/// An impact of many tosses.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct TossImpact {
    /// Phase (rad).
    pub phase: f64,
    /// Time since the impact before (s).
    pub flight: f64,
    /// Relative axial velocity just before (m/s).
    pub impact_velocity: f64,
    /// Angular speed just after (rad/s).
    pub angular_speed: f64,
}

/// The orbit of many tosses, as far as its impacts show it.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct DrivenTossOrbit {
    /// The impacts examined; fewer where the disk comes to rest for ever.
    pub impacts: Vec<TossImpact>,
    /// After how many impacts phases, velocities and angular speeds repeat within the tolerance.
    pub period: Option<usize>,
    /// How often the disk came to rest on the hand among them.
    pub attachments: u64,
}

/// The orbit of a disk after many tosses from rest on the hand at `phase` with this angular speed (rad/s).
///
/// # Errors
/// [`Error::OutOfRange`] for the settings; those of the flights.
pub fn multi_toss(
    platform: &DrivenPlatform,
    disk: &Disk,
    (phase, angular_speed): (Phase, f64),
    settings: &MultiTossSettings,
) -> Result<DrivenTossOrbit, Error> {
    let examined = settings.examined_impacts;
    let legal = (2..=crate::toss::MAX_EXAMINED).contains(&examined);
    check(legal, "examined_impacts", examined as f64, "[2, 10000000]")?;
    let (system, scales) = (DrivenSystem::new(platform, disk)?, platform.scales(disk));
    let spin = finite("angular_speed", angular_speed)? / scales.angular_speed;
    let start = DrivenStart::Contact { phase, angular_speed: spin };
    let mut engine = DrivenEngine::new(system, start, settings.policy)?;
    engine.with_energy = false;
    let mut orbit = DrivenTossOrbit { impacts: Vec::new(), period: None, attachments: 0 };
    let (mut skipped, mut contact_events, mut flight) = (0, 0, 0.0);
    while orbit.impacts.len() < examined && contact_events < MOST_CONTACT_EVENTS {
        let Some(record) = engine.advance()? else { break };
        flight += record.span.radians();
        contact_events += 1;
        let hit = match record.event {
            DrivenEvent::Impact(hit) | DrivenEvent::Kick(hit) => hit,
            DrivenEvent::Attachment { .. } => {
                orbit.attachments += u64::from(skipped >= settings.transient_impacts);
                continue;
            }
            _ => continue,
        };
        contact_events = 0;
        if skipped < settings.transient_impacts {
            skipped += 1;
        } else {
            orbit.impacts.push(TossImpact {
                phase: record.time.phase.angle(),
                flight: flight * scales.time,
                impact_velocity: hit.axial_impact_velocity * scales.velocity,
                angular_speed: record.after.angular_speed * scales.angular_speed,
            });
        }
        flight = 0.0;
    }
    orbit.period = period_of(&orbit.impacts, settings);
    Ok(orbit)
}

/// The smallest number of impacts after which all of the last two rounds repeat.
fn period_of(impacts: &[TossImpact], settings: &MultiTossSettings) -> Option<usize> {
    let near = |one: f64, other: f64| (one - other).abs() <= settings.tolerance * (1.0 + one.abs());
    let same = |one: &TossImpact, other: &TossImpact| {
        let apart = (one.phase - other.phase).abs();
        apart.min(TAU - apart) <= settings.tolerance
            && near(one.impact_velocity, other.impact_velocity)
            && near(one.angular_speed, other.angular_speed)
    };
    (1..=settings.longest_period.min(impacts.len() / 2)).find(|&period| {
        let round = &impacts[impacts.len() - 2 * period..];
        round[..period].iter().zip(&round[period..]).all(|(one, other)| same(one, other))
    })
}
