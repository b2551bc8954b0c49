//! The vertical motion of the rotor: whether it lifts off, and whether its flights repeat.
//!
//! The verdict comes from computed motions, not from formulas: from the orbit that the unperturbed model
//! repeats, and from a perturbed motion, which shows whether this orbit survives (docs/numerics-dynamics.md,
//! "Regime").
//!
//! At P <= 1 the rotor never lifts off. Otherwise `multi_toss` classifies the unperturbed motion from rest
//! over 2048 impacts; a motion that never rests first settles for 100,000 impacts. A periodic orbit is
//! refined by Newton's method. A motion without rest and with a positive Lyapunov exponent is chaotic. A
//! flight is long if it exceeds half a period, because a chatter has infinitely many short ones.

use std::f64::consts::TAU;
use std::fmt::{self, Display, Formatter};

use bouncing_disk_core::numerics::random::SplitMix64;
use bouncing_disk_core::run::Watch;
use bouncing_disk_core::{ChatterPolicy, ImpactMap, Launch, Observer, OrbitEvent, Phase};

use crate::display::rough;
use crate::error::Error;
use crate::motion::initial_condition::InitialCondition;
use crate::motor::rotor::transient::FLIGHTS_OF_EVENT;
use crate::parameters::dimensionless::{DimensionlessParameters, DimensionlessSystem};
use crate::toss::chattering_cycle::{ChatteringCycle, LONG_FLIGHT};
use crate::toss::chattering_cycle::{EXAMINED_IMPACTS, LOCKED_FLIGHTS, LOCKED_WITHIN};
use crate::toss::multiple::{MultiTossSettings, OrbitClass, multi_toss};
use crate::toss::single::TOSS_START;

/// Impacts over which the perturbed motion is followed.
const FOLLOWED_IMPACTS: u64 = 20_000;

/// Largest number of impacts over which the perturbed motion is followed, if it has rested fewer than
/// [`FEW_RESTS`] times.
const MOST_IMPACTS: u64 = 10 * FOLLOWED_IMPACTS;

/// See [`MOST_IMPACTS`].
const FEW_RESTS: u64 = 16;

/// Impacts during which a motion that does not rest settles before it is examined.
const SETTLING_IMPACTS: usize = 100_000;

/// Size of the relaunch perturbation (units of g/omega), as in `TransientSettings`.
const PERTURBATION: f64 = 1.0e-3;

/// Seed of the perturbations.
const SEED: u64 = 1;

/// The vertical motion of the rotor from rest on the stator. Other motions may coexist, which a rotor that is
/// thrown may reach.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum MotorRegime {
    /// The stator never falls away under the rotor (P <= 1), so the rotor is carried and never thrown.
    NoLiftOff,
    /// The flights repeat, without rest.
    Periodic {
        /// Impacts per cycle.
        impacts: usize,
        /// Periods of the stator per cycle.
        platform_periods: u64,
    },
    /// The rotor comes to rest after few flights, and repeats the same cycle when perturbed: a trap, in which
    /// the speed rises along straight lines.
    LowPeriodChattering(ChatteringCycle),
    /// The rotor comes to rest now and then, after many flights, or after a number of flights that a small
    /// perturbation changes.
    LongChattering {
        /// Mean number of periods of the stator between two separations of the perturbed motion.
        platform_periods: f64,
        /// The number of rests observed; a mean over few rests is rough.
        rests: u64,
    },
    /// The flights do not repeat, the rotor does not rest, and small differences grow, all within 200 000
    /// impacts; the chaos may be transient.
    Chaotic {
        /// Growth rate of a small vertical perturbation per impact, positive.
        lyapunov_exponent: f64,
    },
    /// The flights do not repeat, the rotor does not rest, and small differences do not grow within
    /// `impacts`: a motion that settles slowly, or a very long period.
    Undecided {
        /// Impacts examined.
        impacts: usize,
    },
}

impl MotorRegime {
    /// Whether the motion repeats a short cycle. The rotor's speed then has almost no statistical error,
    /// however far it is from the speeds of neighbouring motors.
    #[must_use]
    pub const fn is_locked(&self) -> bool {
        matches!(self, Self::NoLiftOff | Self::Periodic { .. } | Self::LowPeriodChattering(_))
    }
}

impl Display for MotorRegime {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoLiftOff => f.write_str("no lift-off"),
            Self::Periodic { impacts, platform_periods } => {
                write!(f, "periodic: {impacts} impacts in {platform_periods} periods")
            }
            Self::LowPeriodChattering(cycle) => write!(f, "low-period chattering: {cycle}"),
            Self::LongChattering { platform_periods, rests } => {
                let periods = rough(*platform_periods);
                write!(f, "long chattering: {periods} periods from rest to rest on average, over {rests}")
            }
            Self::Chaotic { lyapunov_exponent } => {
                write!(f, "chaotic: Lyapunov exponent {} per impact", rough(*lyapunov_exponent))
            }
            Self::Undecided { impacts } => write!(f, "undecided after {impacts} impacts"),
        }
    }
}

/// The observed statistics of a perturbed motion.
#[derive(Debug, Clone, Copy, Default)]
struct Seen {
    long_flights: u64,
    /// Total duration of the long flights (rad).
    flown: f64,
    /// Sum of the speeds of the impacts that end long flights (g/omega).
    speeds: f64,
    separations: u64,
    /// Time from the first separation to the last one (rad).
    elapsed: f64,
}

impl Seen {
    /// Follows a rotor from rest through its relaunches, each with a small random speed.
    fn of(map: &ImpactMap, separation: Phase, observer: &dyn Observer) -> Result<Self, Error> {
        let watch = Watch::begin(observer, 0, MOST_IMPACTS)?;
        let mut work = watch.work();
        let mut random = SplitMix64::new(SEED);
        let mut perturbation = || PERTURBATION * random.unit();
        let launch = Launch::new(separation, perturbation())?;
        let mut orbit = map.orbit_from_launch(launch, ChatterPolicy::Complete);
        let (mut seen, mut time, mut impacts) = (Self::default(), 0.0, 0);
        while impacts < FOLLOWED_IMPACTS || seen.separations < FEW_RESTS && impacts < MOST_IMPACTS {
            watch.set_done(impacts);
            work.spend(FLIGHTS_OF_EVENT)?;
            match orbit.advance()? {
                Some(OrbitEvent::Impact(impact)) => {
                    let duration = impact.duration();
                    time += duration;
                    if duration > LONG_FLIGHT {
                        seen.long_flights += 1;
                        seen.flown += duration;
                        seen.speeds -= impact.velocity;
                    }
                    impacts += 1;
                }
                Some(OrbitEvent::Attachment(attachment)) => {
                    let accumulation = attachment.accumulation;
                    let ahead = separation.angle() - accumulation.phase.angle();
                    time += accumulation.duration + if ahead > 0.0 { ahead } else { ahead + TAU };
                    orbit.perturb_launch(perturbation())?;
                    seen.separations += 1;
                    seen.elapsed = time;
                }
                // No other event exists, and a rotor that was once thrown is thrown again after every rest.
                Some(_) | None => break,
            }
        }
        watch.end();
        Ok(seen)
    }

    /// The means over the long flights.
    fn flights(&self) -> Option<MeanFlight> {
        let count = self.long_flights as f64;
        let mean = MeanFlight { periods: self.flown / (TAU * count), impact_speed: self.speeds / count };
        (self.long_flights > 0).then_some(mean)
    }

    /// Mean periods of the stator between two separations.
    fn periods_between_rests(&self) -> Option<f64> {
        (self.separations > 0).then(|| self.elapsed / (TAU * self.separations as f64))
    }
}

/// Means over the flights longer than half a period, as a chatter has infinitely many short ones.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct MeanFlight {
    /// Duration in periods of the stator.
    pub(crate) periods: f64,
    /// Speed of the impact that ends the flight (g/omega).
    pub(crate) impact_speed: f64,
}

/// The regime, and the means over the long flights.
pub(crate) fn regime(
    system: &DimensionlessSystem,
    observer: &dyn Observer,
) -> Result<(MotorRegime, Option<MeanFlight>), Error> {
    let map = system.map();
    let Some(separation) = map.vibration().separation_phase() else {
        return Ok((MotorRegime::NoLiftOff, None));
    };
    let seen = Seen::of(map, separation, observer)?;
    let class = settled(system, 0, observer)?;
    // A motion that has not settled is given the time to do so, unless it comes to rest.
    let class = match class {
        OrbitClass::Chaotic { .. } | OrbitClass::Undecided { .. } if seen.separations == 0 => {
            settled(system, SETTLING_IMPACTS, observer)?
        }
        class => class,
    };
    let long = seen
        .periods_between_rests()
        .map(|platform_periods| MotorRegime::LongChattering { platform_periods, rests: seen.separations });
    let regime = match class {
        OrbitClass::AtRest => MotorRegime::NoLiftOff,
        OrbitClass::Periodic { period, platform_periods, .. } => {
            MotorRegime::Periodic { impacts: period, platform_periods }
        }
        OrbitClass::Chattering(cycle) if survives(cycle, &seen) => MotorRegime::LowPeriodChattering(cycle),
        OrbitClass::Chattering(cycle) => {
            // The perturbed motion was not seen to repeat a rest, so only the cycle is known.
            let platform_periods = cycle.platform_periods as f64;
            long.unwrap_or(MotorRegime::LongChattering { platform_periods, rests: 1 })
        }
        OrbitClass::Chaotic { lyapunov_exponent } => {
            long.unwrap_or(MotorRegime::Chaotic { lyapunov_exponent: lyapunov_exponent.exponent })
        }
        OrbitClass::Undecided { impacts, .. } => long.unwrap_or(MotorRegime::Undecided { impacts }),
    };
    Ok((regime, seen.flights()))
}

/// Whether the perturbed motion repeats a short cycle, judged by its mean time between separations.
fn survives(cycle: ChatteringCycle, seen: &Seen) -> bool {
    let near = |periods: f64| (periods / cycle.platform_periods as f64 - 1.0).abs() <= LOCKED_WITHIN;
    cycle.long_flights <= LOCKED_FLIGHTS && seen.periods_between_rests().is_some_and(near)
}

/// The motion on which the unperturbed motion from rest settles, without the rotation, which never acts back
/// on it.
fn settled(
    system: &DimensionlessSystem,
    transient_impacts: usize,
    observer: &dyn Observer,
) -> Result<OrbitClass, Error> {
    let vertical =
        DimensionlessParameters { twist_speed: 0.0, friction: 0.0, load: 0.0, ..system.parameters() };
    let settings = MultiTossSettings {
        policy: ChatterPolicy::Complete,
        transient_impacts,
        examined_impacts: EXAMINED_IMPACTS,
        ..MultiTossSettings::default()
    };
    let start = InitialCondition::Contact { phase: Phase::new(TOSS_START)?, angular_speed: 0.0 };
    Ok(multi_toss(vertical.build()?, start, settings, observer)?.class)
}
