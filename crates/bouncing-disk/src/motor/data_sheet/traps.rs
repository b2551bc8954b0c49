//! Low-period traps: values of preload, amplitude or frequency at which the rotor repeats a short cycle of
//! flights and rest. There the rotor has the speed of the cycle, which may be anything from zero (the holes
//! of Fig. 11) to more than the speed outside the trap.
//!
//! After every rest the rotor leaves the stator in the same state. Without perturbation the flights from one
//! separation to the next are thus the whole cycle, which P and the restitution determine
//! (docs/numerics-dynamics.md, "Low-period traps"). A motor is trapped if this excursion consists of at most
//! eight long flights and if 64 excursions with relaunches perturbed by up to 1e-3 g/omega have the same mean
//! duration, within 5 %. Nearly all of the 64 then return to the same cycle.
//!
//! **Soft landings.** A separation occurs at sin tau = 1/P, at the height 1 and with the velocity v =
//! sqrt(P^2 - 1) (units of g/omega^2 and g/omega). A rotor that meets the stator with the stator's fastest
//! receding velocity -P has flown for h = v + P. Its height is then 1 + h (v - h/2) = 1 + (v^2 - P^2)/2 =
//! 1/2, which the stator reaches at sin tau = 1/(2 P), near tau = pi. So v + P = pi - asin(1/P) - 1/(2 P) + 2
//! pi n + O(P^-3), and with P = pi Gamma the rotor lands without a shock at
//!
//! ```text
//! Gamma = n + 1/2 - 1/(2 pi P) + O(P^-3)
//! ```
//!
//! At the restitution of Table III the trapping window begins 0.005 to 0.006 below this point and ends 0.05
//! above it, for n from 3 to 100 (a test). Below the window the stator would recede more slowly than the
//! rotor falls.
//!
//! For at least 71 of 72 motors with forcings near 3, 12 and 203, the verdict agrees with the report's
//! regime. The motors in the holes of Fig. 11 have forcings with fractions of 0.496 to 0.545.

use std::f64::consts::{PI, TAU};

use bouncing_disk_core::numerics::random::SplitMix64;
use bouncing_disk_core::run::{Watch, WorkCount};
use bouncing_disk_core::{ChatterPolicy, ImpactMap, Launch, Observer, OrbitEvent, Unobserved};

use crate::error::Error;
use crate::motor::data_sheet::Motor;
use crate::toss::chattering_cycle::{ChatteringCycle, LOCKED_FLIGHTS, LOCKED_WITHIN, LONG_FLIGHT};

/// Number of perturbed relaunches for a rotor whose unperturbed cycle is short.
const RELAUNCHES: u32 = 64;

/// Impacts after which an excursion is abandoned: an unperturbed one, which must be short, and a perturbed
/// one.
const MOST_IMPACTS: u64 = 400;
const MOST_PERTURBED_IMPACTS: u64 = 4_000;

/// Size of the relaunch perturbation (units of g/omega), as in `TransientSettings`.
const PERTURBATION: f64 = 1.0e-3;

/// Seed of the perturbations.
const SEED: u64 = 1;

/// Whether a motor is in a low-period trap, with the evidence.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct TrapVerdict {
    /// Preload as an acceleration g (m/s^2).
    pub preload_acceleration: f64,
    /// Axial forcing parameter Gamma, which determines the verdict together with the restitution.
    pub axial_forcing: f64,
    /// The fractional part of Gamma, in [0, 1): it is about one half in traps with a single flight per cycle.
    pub forcing_fraction: f64,
    /// The unperturbed cycle from one separation to the next, if it consists of at most eight long flights;
    /// `None` if there are more, or if the rotor is never thrown or never rests.
    pub cycle: Option<ChatteringCycle>,
    /// Perturbed relaunches that were tried: 64, or 0 without a cycle.
    pub relaunches: u32,
    /// Number of these relaunches that took as many long flights and periods as the cycle.
    pub returns: u32,
    /// Mean number of the stator's periods from one perturbed relaunch to the next; a lower bound if a motion
    /// had not come to rest within 4000 impacts. `None` without a cycle.
    pub mean_platform_periods: Option<f64>,
    /// Whether the perturbed motor repeats the cycle: its mean number of periods is within 5 % of the
    /// cycle's, as for [`MotorRegime::LowPeriodChattering`](crate::motor::MotorRegime::LowPeriodChattering).
    pub is_trap: bool,
}

impl TrapVerdict {
    /// The share of the perturbed relaunches that returned to the cycle; zero without a cycle.
    #[must_use]
    pub fn return_share(&self) -> f64 {
        if self.relaunches == 0 { 0.0 } else { f64::from(self.returns) / f64::from(self.relaunches) }
    }

    /// The verdict on a vertical motion under a preload.
    pub(crate) fn of(
        map: &ImpactMap,
        preload_acceleration: f64,
        work: &mut WorkCount<'_>,
    ) -> Result<Self, Error> {
        let axial_forcing = map.vibration().peak_acceleration() / PI;
        let mut verdict = Self {
            preload_acceleration,
            axial_forcing,
            forcing_fraction: axial_forcing - axial_forcing.floor(),
            cycle: None,
            relaunches: 0,
            returns: 0,
            mean_platform_periods: None,
            is_trap: false,
        };
        let Some(cycle) = short_cycle(map, work)? else { return Ok(verdict) };
        let mut random = SplitMix64::new(SEED);
        let mut elapsed = 0.0;
        for _ in 0..RELAUNCHES {
            let speed = PERTURBATION * random.unit();
            let Some(excursion) = Excursion::of(map, speed, (MOST_PERTURBED_IMPACTS, usize::MAX), work)?
            else {
                break;
            };
            let same = excursion.cycle.is_some_and(|own| {
                own.platform_periods == cycle.platform_periods && own.long_flights == cycle.long_flights
            });
            verdict.returns += u32::from(same);
            elapsed += excursion.elapsed;
        }
        let mean = elapsed / (TAU * f64::from(RELAUNCHES));
        verdict.cycle = Some(cycle);
        verdict.relaunches = RELAUNCHES;
        verdict.mean_platform_periods = Some(mean);
        verdict.is_trap = (mean / cycle.platform_periods as f64 - 1.0).abs() <= LOCKED_WITHIN;
        Ok(verdict)
    }
}

/// Cost of a summed chatter, in flights.
const FLIGHTS_OF_EXCURSION: u64 = 4;

/// The motion from one separation to the next, or until it was abandoned.
#[derive(Debug, Clone, Copy)]
struct Excursion {
    /// Duration in radians.
    elapsed: f64,
    /// The cycle; `None` if the motion was abandoned.
    cycle: Option<ChatteringCycle>,
}

impl Excursion {
    /// The excursion of a rotor that leaves with this relative speed, abandoned after the given number of
    /// impacts or more long flights; `None` if the platform never falls away.
    fn of(
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

/// The unperturbed cycle, if it is short. Every rest ends with the same separation, so one excursion is the
/// whole cycle.
fn short_cycle(map: &ImpactMap, work: &mut WorkCount<'_>) -> Result<Option<ChatteringCycle>, Error> {
    let excursion = Excursion::of(map, 0.0, (MOST_IMPACTS, LOCKED_FLIGHTS), work)?;
    Ok(excursion.and_then(|excursion| excursion.cycle))
}

/// Cost of building a motor, in flights.
const FLIGHTS_OF_BUILDING: u64 = 8;

/// Which of these preloads, given as accelerations (m/s^2), trap a motor: a verdict for each, in the same
/// order. The acceleration replaces a preload force in the data sheet.
///
/// The observer's items are the preloads.
///
/// ```
/// # use bouncing_disk::core::Unobserved;
/// use bouncing_disk::Motor;
/// use bouncing_disk::motor::low_period_traps;
///
/// let motor = Motor::paper_70_khz();
/// // Gamma is 12.51 in the middle of these: a flight of twelve and a half periods lands softly.
/// let soft = motor.system().platform().peak_acceleration() / (12.51 * std::f64::consts::PI);
/// let verdicts = low_period_traps(&motor, &[0.97 * soft, soft, 1.03 * soft], &Unobserved)?;
/// let trapped: Vec<bool> = verdicts.iter().map(|verdict| verdict.is_trap).collect();
/// assert_eq!(trapped, [false, true, false]);
/// # Ok::<(), bouncing_disk::Error>(())
/// ```
///
/// # Errors
/// [`Error::OutOfRange`] for a preload that is not positive; the errors of the flights.
pub fn low_period_traps(
    motor: &Motor,
    preloads: &[f64],
    observer: &dyn Observer,
) -> Result<Vec<TrapVerdict>, Error> {
    let watch = Watch::begin(observer, 0, preloads.len() as u64)?;
    let mut work = watch.work();
    // Build all of them before judging any, so that an illegal one is an error at once.
    let motors = preloads
        .iter()
        .map(|&preload| -> Result<Motor, Error> {
            work.spend(FLIGHTS_OF_BUILDING)?;
            motor.with(|sheet| {
                sheet.preload_force = None;
                sheet.preload_acceleration = Some(preload);
            })
        })
        .collect::<Result<Vec<_>, _>>()?;
    let mut verdicts = Vec::with_capacity(motors.len());
    for motor in &motors {
        verdicts.push(TrapVerdict::of_motor(motor, &mut work)?);
        watch.finish(1);
    }
    watch.end();
    Ok(verdicts)
}

impl TrapVerdict {
    fn of_motor(motor: &Motor, work: &mut WorkCount<'_>) -> Result<Self, Error> {
        Self::of(motor.rigid_sine()?.dimensionless().map(), motor.preload_acceleration(), work)
    }
}

impl Motor {
    /// Whether the motor with its own preload is in a low-period trap.
    ///
    /// # Errors
    /// The errors of [`Motor::rigid_sine`] and of the flights.
    pub fn trap_verdict(&self) -> Result<TrapVerdict, Error> {
        let watch = Watch::begin(&Unobserved, 0, 1)?;
        TrapVerdict::of_motor(self, &mut watch.work())
    }
}

#[cfg(test)]
mod tests;
