//! The flights of a rotor from one separation to the next.

use std::f64::consts::TAU;

use bouncing_disk_core::{ChatterPolicy, ImpactMap, Launch, OrbitEvent, WorkCount};

use crate::error::Error;
use crate::toss::chattering_cycle::{ChatteringCycle, LONG_FLIGHT};

/// Flights that a summed chatter costs.
const FLIGHTS_OF_EXCURSION: u64 = 4;

/// From a separation to the next one, or to where it was given up.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Excursion {
    /// Radians.
    pub(crate) elapsed: f64,
    /// The round; `None` if it was given up.
    pub(crate) cycle: Option<ChatteringCycle>,
}

impl Excursion {
    /// Of a rotor that leaves with this relative speed, given up after so many impacts or more long flights;
    /// `None` if the platform never falls away.
    pub(crate) fn of(
        map: &ImpactMap,
        speed: f64,
        (most_impacts, most_long): (u64, usize),
        work: &mut WorkCount<'_>,
    ) -> Result<Option<Self>, Error> {
        let Some(separation) = map.vibration().separation_phase() else { return Ok(None) };
        work.spend(FLIGHTS_OF_EXCURSION)?;
        let mut orbit = map.orbit_from_launch(Launch::new(separation, speed)?, ChatterPolicy::Complete);
        let (mut elapsed, mut impacts, mut long_flights) = (0.0, 0, 0);
        while impacts < most_impacts && long_flights <= most_long {
            work.spend(1)?;
            match orbit.advance()? {
                Some(OrbitEvent::Impact(impact)) => {
                    let duration = impact.duration();
                    elapsed += duration;
                    impacts += 1;
                    long_flights += usize::from(duration > LONG_FLIGHT);
                }
                Some(OrbitEvent::Attachment(attachment)) => {
                    let accumulation = attachment.accumulation;
                    let ahead = separation.angle() - accumulation.phase.angle();
                    elapsed += accumulation.duration + if ahead > 0.0 { ahead } else { ahead + TAU };
                    let platform_periods = (elapsed / TAU).round() as u64;
                    let impacts = impacts as usize;
                    let cycle = ChatteringCycle { impacts, platform_periods, long_flights };
                    return Ok(Some(Self { elapsed, cycle: Some(cycle) }));
                }
                // No other event exists.
                Some(_) | None => break,
            }
        }
        Ok(Some(Self { elapsed, cycle: None }))
    }
}
