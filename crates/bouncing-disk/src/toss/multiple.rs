//! Multiple tosses (Sec. IV): the orbit on which a motion settles, and its class.

use crate::display::numbers;
use std::f64::consts::{PI, TAU};
use std::fmt::{self, Display, Formatter};

use bouncing_disk_core::chaos::{LyapunovEstimate, TangentGrowth};
use bouncing_disk_core::orbits::{MAX_PERIOD, Multipliers, Stability};
use bouncing_disk_core::run::{Watch, WorkCount};
use bouncing_disk_core::{BouncingMap, ChatterPolicy, ImpactState, Observer};

use crate::error::{Error, check, not_negative, room_for};
use crate::motion::event::{EventRecord, Motion};
use crate::motion::initial_condition::InitialCondition;
use crate::motion::phase_time::PhaseTime;
use crate::parameters::dimensionless::DimensionlessSystem;
use crate::toss::chattering_cycle::{ChatteringCycle, LONG_FLIGHT};
use crate::toss::collisions::{Collision, CollisionEvent, Collisions};

/// Largest number of impacts that [`multi_toss`] examines.
pub const MAX_EXAMINED: usize = 10_000_000;

/// The cost of an event, in flights: one that ends a chatter takes longer than a flight.
const FLIGHTS_OF_EVENT: u64 = 4;

/// How long a motion is followed, and the criterion for a periodic one.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct MultiTossSettings {
    /// How a chattering sequence ends. Default [`ChatterPolicy::Complete`].
    pub policy: ChatterPolicy,
    /// Number of impacts that are skipped. Default 4000.
    pub transient_impacts: usize,
    /// Number of impacts that are then examined, from 2 to [`MAX_EXAMINED`]. Default 1024.
    pub examined_impacts: usize,
    /// The longest period (in impacts) that is recognised, up to [`MAX_PERIOD`]; at most half of the impacts
    /// examined are compared. Default 128.
    pub longest_period: usize,
    /// Largest difference of phases (rad) and speeds (relative to 1 + the speed, for rotary ones to 1 + Q) that
    /// counts as equality. Default 1e-9.
    pub tolerance: f64,
}

impl Default for MultiTossSettings {
    fn default() -> Self {
        Self {
            policy: ChatterPolicy::Complete,
            transient_impacts: 4_000,
            examined_impacts: 1_024,
            longest_period: 128,
            tolerance: 1.0e-9,
        }
    }
}

impl MultiTossSettings {
    fn check(&self) -> Result<(), Error> {
        let (examined, period) = (self.examined_impacts, self.longest_period);
        check(examined >= 2, "examined_impacts", examined as f64, "at least 2")?;
        check(period >= 1, "longest_period", period as f64, "at least 1")?;
        not_negative("tolerance", self.tolerance)?;
        Ok(())
    }
}

/// The orbit on which a motion has settled, judged from the impacts examined.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub enum OrbitClass {
    /// The collisions repeat: the last two rounds agree within the tolerance, and a Newton refinement of the
    /// vertical orbit also agrees and is attracting ([`Stability::Stable`]).
    Periodic {
        /// Impacts in one round.
        period: usize,
        /// Periods of the platform in one round.
        platform_periods: u64,
        /// The two Floquet multipliers of the vertical motion.
        vertical: Multipliers,
        /// The rotary multiplier: 0 if the slip ends in an impact of the round, 1 if every impact slides.
        rotary: f64,
    },
    /// The disk repeatedly comes to rest on the platform. It always leaves in the same vertical state, so the
    /// vertical motion is periodic from the first separation on, exactly in theory and up to rounding in
    /// practice. (A long cycle depends on its rounding.)
    Chattering(ChatteringCycle),
    /// Small vertical perturbations certainly grow ([`LyapunovEstimate::grows`]), over enough impacts for
    /// dissipation to act
    /// ([`BouncingMap::transient_impacts`](bouncing_disk_core::BouncingMap::transient_impacts)).
    Chaotic {
        /// Growth rate of a small vertical perturbation per impact, from the derivatives of the map along the
        /// impacts examined.
        lyapunov_exponent: LyapunovEstimate,
    },
    /// None of these is certain from the impacts examined: a long period, a slow
    /// approach, neutral motion, or a transient.
    Undecided {
        /// Impacts examined.
        impacts: usize,
        /// The growth rate, if known: `None` if the disk attached or grazed meanwhile, or for fewer than 17
        /// impacts.
        lyapunov_exponent: Option<LyapunovEstimate>,
    },
    /// The disk rests on the platform for ever.
    AtRest,
}

/// A motion after its transient.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct TossOrbit {
    /// The class of the orbit.
    pub class: OrbitClass,
    /// One round of a periodic orbit, one cycle of a chattering one, otherwise all impacts examined.
    pub collisions: Vec<Collision>,
    /// Mean angular speed over these collisions, in units of g a_e/(a_g^2 omega); `None` at rest.
    pub mean_angular_speed: Option<f64>,
    /// Whether the angular speed also repeats from round to round; `None` if nothing repeats.
    pub rotation_repeats: Option<bool>,
}

/// Follows a motion through its transient and classifies the orbit on which it settles.
///
/// The observer's items are the impacts, both transient and examined.
///
/// # Errors
/// [`Error::OutOfRange`] for the settings; an error of the core for more than [`MAX_EXAMINED`] impacts
/// examined or more than memory can hold; the errors of [`Collisions`].
pub fn multi_toss(
    system: impl TryInto<DimensionlessSystem, Error: Into<Error>>,
    start: InitialCondition,
    settings: MultiTossSettings,
    observer: &dyn Observer,
) -> Result<TossOrbit, Error> {
    toss_orbit(system.try_into().map_err(Into::into)?, start, &settings, observer)
}

/// [`multi_toss`], compiled in this crate, because the caller's crate may not be optimised.
fn toss_orbit(
    system: DimensionlessSystem,
    start: InitialCondition,
    settings: &MultiTossSettings,
    observer: &dyn Observer,
) -> Result<TossOrbit, Error> {
    let collisions = Collisions::new(system, start, settings.policy)?;
    settle(collisions, system.map(), system.twist_speed(), settings, observer)
}

/// [`multi_toss`] on a platform with this impact map and largest angular speed.
pub(crate) fn settle<M: Motion<Record = EventRecord>>(
    mut collisions: Collisions<M>,
    map: &impl BouncingMap,
    twist_speed: f64,
    settings: &MultiTossSettings,
    observer: &dyn Observer,
) -> Result<TossOrbit, Error> {
    settings.check()?;
    let mut skipped = 0;
    let collided = room_for("examined impacts", settings.examined_impacts, MAX_EXAMINED)?;
    let mut window = Examined { collisions: collided, ..Examined::default() };
    let impacts = settings.transient_impacts.saturating_add(settings.examined_impacts);
    let watch = Watch::begin(observer, 0, impacts as u64)?;
    let mut work = watch.work();
    while window.collisions.len() < settings.examined_impacts {
        watch.set_done((skipped + window.collisions.len()) as u64);
        work.spend(FLIGHTS_OF_EVENT)?;
        match collisions.advance()? {
            Some(event) if skipped < settings.transient_impacts => {
                skipped += usize::from(matches!(event, CollisionEvent::Collision(_)));
            }
            Some(event) => window.push(&event),
            None => {
                watch.end();
                return Ok(TossOrbit {
                    class: OrbitClass::AtRest,
                    collisions: Vec::new(),
                    mean_angular_speed: None,
                    rotation_repeats: None,
                });
            }
        }
    }
    let orbit = window.classified(map, twist_speed, settings, &mut work)?;
    watch.end();
    Ok(orbit)
}

/// A separation, and the number of collisions in the window before it.
#[derive(Debug, Clone, Copy)]
struct Leaving {
    before: usize,
    time: PhaseTime,
    angular_speed: f64,
    angle: f64,
}

#[derive(Debug, Default)]
struct Examined {
    collisions: Vec<Collision>,
    leavings: Vec<Leaving>,
    attached: bool,
}

impl Examined {
    fn push(&mut self, event: &CollisionEvent) {
        match *event {
            CollisionEvent::Collision(collision) => self.collisions.push(collision),
            CollisionEvent::Attachment { .. } => self.attached = true,
            CollisionEvent::Separation { time, angular_speed, angle } => {
                self.leavings.push(Leaving { before: self.collisions.len(), time, angular_speed, angle });
            }
        }
    }

    fn classified(
        self,
        map: &impl BouncingMap,
        twist_speed: f64,
        settings: &MultiTossSettings,
        work: &mut WorkCount<'_>,
    ) -> Result<TossOrbit, Error> {
        // Largest difference of angular speeds that count as equal.
        let near = settings.tolerance * (1.0 + twist_speed);
        if let Some((from, to)) = self.cycle(settings.tolerance) {
            return Ok(self.chattering(near, from, to));
        }
        let periodic = if self.attached { None } else { self.periodic(map, near, settings) };
        periodic.map_or_else(|| self.without_period(map, settings, work), Ok)
    }

    /// The last separation, and the previous one at the same phase; on a drive other separations may come
    /// between.
    fn cycle(&self, tolerance: f64) -> Option<(Leaving, Leaving)> {
        let (to, before) = self.leavings.split_last()?;
        let same = |from: &&Leaving| {
            let apart = (from.time.phase.angle() - to.time.phase.angle()).abs();
            apart.min(TAU - apart) <= tolerance
        };
        before.iter().rev().find(same).map(|from| (*from, *to))
    }

    fn chattering(self, near: f64, from: Leaving, to: Leaving) -> TossOrbit {
        let cycle = &self.collisions[from.before..to.before];
        let mut last = from.time;
        let mut long_flights = 0;
        for collision in cycle {
            long_flights += usize::from(collision.time.since(&last).radians() > LONG_FLIGHT);
            last = collision.time;
        }
        let round = to.time.since(&from.time);
        let change = to.angular_speed - from.angular_speed;
        TossOrbit {
            class: OrbitClass::Chattering(ChatteringCycle {
                impacts: cycle.len(),
                platform_periods: round.periods + u64::from(round.remainder > PI),
                long_flights,
            }),
            mean_angular_speed: mean_speed((from.time, from.angle), (to.time, to.angle)),
            rotation_repeats: Some(change.abs() <= near),
            collisions: cycle.to_vec(),
        }
    }

    fn periodic(
        &self,
        map: &impl BouncingMap,
        same_speed: f64,
        settings: &MultiTossSettings,
    ) -> Option<TossOrbit> {
        let last = self.collisions.len() - 1;
        let longest = settings.longest_period.min(self.collisions.len() / 2).min(MAX_PERIOD);
        let near = |a: &Collision, b: &Collision| {
            let apart = (a.time.phase.angle() - b.time.phase.angle()).abs();
            let velocity = a.state.axial_impact_velocity;
            apart.min(TAU - apart) <= settings.tolerance
                && (velocity - b.state.axial_impact_velocity).abs()
                    <= settings.tolerance * (1.0 + velocity.abs())
        };
        let period = (1..=longest).find(|period| {
            (0..*period)
                .all(|back| near(&self.collisions[last - back], &self.collisions[last - back - period]))
        })?;
        let round = &self.collisions[last + 1 - period..];
        let states: Vec<ImpactState> =
            round.iter().map(|collision| collision.state.vertical()).collect::<Result<_, _>>().ok()?;
        let orbit = map.refine(&states).ok()?;
        if orbit.stability() != Stability::Stable {
            return None;
        }
        let before = &self.collisions[last - period];
        let end = &self.collisions[last];
        Some(TossOrbit {
            class: OrbitClass::Periodic {
                period,
                platform_periods: orbit.platform_periods,
                vertical: orbit.multipliers(),
                rotary: if round.iter().any(|collision| collision.capped) { 0.0 } else { 1.0 },
            },
            collisions: round.to_vec(),
            mean_angular_speed: mean_speed((before.time, before.angle), (end.time, end.angle)),
            rotation_repeats: Some((end.angular_speed - before.angular_speed).abs() <= same_speed),
        })
    }

    fn without_period(
        self,
        map: &impl BouncingMap,
        settings: &MultiTossSettings,
        work: &mut WorkCount<'_>,
    ) -> Result<TossOrbit, Error> {
        let (first, last) = (&self.collisions[0], &self.collisions[self.collisions.len() - 1]);
        let mean = mean_speed((first.time, first.angle), (last.time, last.angle));
        let lyapunov_exponent = if self.attached { None } else { growth_rate(map, &self.collisions, work)? };
        let followed = settings.transient_impacts.saturating_add(self.collisions.len()) as f64;
        let class = match lyapunov_exponent {
            Some(lyapunov_exponent) if lyapunov_exponent.grows() && followed >= map.transient_impacts() => {
                OrbitClass::Chaotic { lyapunov_exponent }
            }
            _ => OrbitClass::Undecided { impacts: self.collisions.len(), lyapunov_exponent },
        };
        Ok(TossOrbit { class, mean_angular_speed: mean, rotation_repeats: None, collisions: self.collisions })
    }
}

/// Angle turned divided by time taken.
fn mean_speed(from: (PhaseTime, f64), to: (PhaseTime, f64)) -> Option<f64> {
    let span = to.0.since(&from.0).radians();
    (span > 0.0).then(|| (to.1 - from.1) / span)
}

/// Mean logarithmic growth of a tangent vector per impact; `None` at a graze, where the derivative is
/// unbounded.
fn growth_rate(
    map: &impl BouncingMap,
    collisions: &[Collision],
    work: &mut WorkCount<'_>,
) -> Result<Option<LyapunovEstimate>, Error> {
    let (mut tangent, mut growths) = (TangentGrowth::default(), LyapunovEstimate::growths());
    let Some((_, followed)) = collisions.split_last() else { return Ok(None) };
    for collision in followed {
        work.spend(1)?;
        let state = collision.state.vertical().ok();
        let derivative = state.and_then(|state| map.step_with_derivative(state).ok());
        let Some((_, derivative)) = derivative else { return Ok(None) };
        let growth = tangent.grow(derivative);
        growths.push(growth);
    }
    Ok(LyapunovEstimate::of(&growths).filter(|_| tangent.is_bounded()))
}

impl OrbitClass {
    /// Why an orbit is undecided.
    #[must_use]
    pub fn reason(&self) -> Option<&'static str> {
        let Self::Undecided { lyapunov_exponent, .. } = self else { return None };
        Some(match lyapunov_exponent {
            Some(exponent) if exponent.grows() => "perturbations grow, but the transient may not be over",
            Some(_) => {
                "neither certain growth nor a period was found: the period may be long, the approach slow, or the \
                 motion neutral"
            }
            None => {
                "neither a period nor an exponent was found, because of a rest, a graze, an impact on a kink, or \
                 fewer than 17 impacts"
            }
        })
    }
}

impl Display for OrbitClass {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let n = numbers(f);
        match self {
            Self::Periodic { period, platform_periods, vertical, .. } => write!(
                f,
                "{period} impacts in {platform_periods} periods, largest multiplier {}",
                n(vertical.spectral_radius())
            ),
            Self::Chattering(cycle) => write!(f, "chattering: {cycle}"),
            Self::Chaotic { lyapunov_exponent: LyapunovEstimate { exponent, standard_error, .. } } => {
                write!(f, "chaos, exponent {} +- {} per impact", n(*exponent), n(*standard_error))
            }
            Self::Undecided { impacts, .. } => write!(f, "undecided within {impacts} impacts"),
            Self::AtRest => f.write_str("at rest"),
        }
    }
}

#[cfg(test)]
mod tests {
    use bouncing_disk_core::Unobserved;
    use std::f64::consts::PI;

    use bouncing_disk_core::{ImpactMap, Phase, Vibration};
    use proptest::prelude::*;

    use super::*;
    use crate::parameters::dimensionless::ForcingParameters;
    use crate::testing::{check_stops, refused};
    use crate::toss::collisions::CollisionState;
    use crate::toss::rotary_response::period_one_rotary_speed;

    fn system(axial_forcing: f64, angular_forcing: f64, phase_lag: f64) -> DimensionlessSystem {
        ForcingParameters { axial_forcing, angular_forcing, phase_lag, restitution: 0.5 }.build().unwrap()
    }

    fn period_one(system: &DimensionlessSystem, angular_speed: f64) -> InitialCondition {
        let state = system.map().period_one(1).unwrap();
        let relative_speed = -system.restitution() * state.velocity();
        InitialCondition::Launch { phase: state.phase(), relative_speed, angular_speed }
    }

    fn from_rest(system: &DimensionlessSystem) -> InitialCondition {
        let phase = Phase::new(1.5 * PI).unwrap();
        InitialCondition::Contact { phase, angular_speed: system.platform_angular_speed(phase) }
    }

    #[test]
    fn period_one_tosses_turn_with_the_speed_of_eq_16() {
        for (forcing, angular_forcing, lag) in
            [(0.36, 100.0, 0.0), (0.42, 1.0, -0.26 * PI), (0.45, 30.0, 2.0)]
        {
            let system = system(forcing, angular_forcing, lag);
            let orbit =
                multi_toss(system, period_one(&system, 0.0), MultiTossSettings::default(), &Unobserved)
                    .unwrap();
            let OrbitClass::Periodic { period, platform_periods, vertical, rotary } = orbit.class else {
                panic!("{:?}", orbit.class)
            };
            assert_eq!((period, platform_periods), (1, 1));
            assert!(vertical.spectral_radius() < 1.0);
            assert!(rotary == 0.0, "the disk turns with the platform at every impact");
            let expected = period_one_rotary_speed(&system, system.map().period_one(1).unwrap().phase());
            let speed = orbit.mean_angular_speed.unwrap();
            assert!((speed - expected).abs() <= 1e-9 * (1.0 + system.twist_speed()), "{speed} {expected}");
            assert_eq!(orbit.rotation_repeats, Some(true));
        }
    }

    #[test]
    fn a_disk_from_rest_chatters_below_the_merging_of_the_attractors() {
        for policy in [ChatterPolicy::Complete, crate::motion::PAPER_CHATTER] {
            let system = system(0.48, 1.0, 0.0);
            let settings = MultiTossSettings { policy, transient_impacts: 100, ..Default::default() };
            let orbit = multi_toss(system, from_rest(&system), settings, &Unobserved).unwrap();
            let OrbitClass::Chattering(cycle) = orbit.class else { panic!("{:?}", orbit.class) };
            assert!(cycle.is_single_toss());
            assert_eq!(cycle.long_flights, 1);
            assert_eq!(orbit.rotation_repeats, Some(true));
        }
    }

    #[test]
    fn chaos_and_the_gentle_platform_are_told_apart() {
        let system_of = |forcing| system(forcing, 1.0, 0.0);
        let chaotic = system_of(0.55);
        let start = InitialCondition::Launch {
            phase: Phase::new(0.6).unwrap(),
            relative_speed: 2.1,
            angular_speed: 0.0,
        };
        let orbit = multi_toss(chaotic, start, MultiTossSettings::default(), &Unobserved).unwrap();
        let OrbitClass::Chaotic { lyapunov_exponent } = orbit.class else { panic!("{:?}", orbit.class) };
        assert!(lyapunov_exponent.impacts == 1_023, "{lyapunov_exponent:?}");
        assert!((0.1..1.0).contains(&lyapunov_exponent.exponent), "{lyapunov_exponent:?}");
        let gentle = system_of(0.3);
        let orbit =
            multi_toss(gentle, from_rest(&gentle), MultiTossSettings::default(), &Unobserved).unwrap();
        assert_eq!(orbit.class, OrbitClass::AtRest);
        let orbit = multi_toss(gentle, start, MultiTossSettings::default(), &Unobserved).unwrap();
        assert_eq!(orbit.class, OrbitClass::AtRest);
    }

    #[test]
    fn a_long_motion_can_be_stopped_also_while_it_is_classified() {
        let system = system(0.55, 1.0, 0.0);
        let start = period_one(&system, 0.0);
        let settings =
            MultiTossSettings { transient_impacts: 10_000, examined_impacts: 20_000, ..Default::default() };
        let whole = multi_toss(system, start, settings, &Unobserved).unwrap();
        assert!(matches!(whole.class, OrbitClass::Chaotic { .. }));
        let (asked, _) = check_stops(30_000, |observer| multi_toss(system, start, settings, observer));
        assert!(asked > 15, "{asked}");
    }

    #[test]
    fn bad_settings_and_states_are_refused() {
        let system = system(0.4, 1.0, 0.0);
        let start = period_one(&system, 0.0);
        let d = MultiTossSettings::default();
        let toss = |settings| multi_toss(system, start, settings, &Unobserved);
        refused("examined_impacts", [1], |impacts| {
            toss(MultiTossSettings { examined_impacts: impacts, ..d })
        });
        refused("longest_period", [0], |period| toss(MultiTossSettings { longest_period: period, ..d }));
        refused("tolerance", [f64::NAN], |tolerance| toss(MultiTossSettings { tolerance, ..d }));
        for examined_impacts in [MAX_EXAMINED + 1, usize::MAX] {
            refused(&*examined_impacts.to_string(), [()], |()| {
                toss(MultiTossSettings { examined_impacts, ..d })
            });
        }
        let endless = MultiTossSettings { longest_period: usize::MAX, ..Default::default() };
        assert_eq!(
            multi_toss(system, start, endless, &Unobserved),
            multi_toss(system, start, Default::default(), &Unobserved)
        );
        let rebound = |(axial_impact_velocity, tangential_impact_velocity)| {
            let phase = Phase::new(0.0).expect("finite");
            CollisionState { phase, axial_impact_velocity, tangential_impact_velocity }.rebound(&system)
        };
        refused("axial_impact_velocity", [(1.0, 0.0)], rebound);
        refused("tangential_impact_velocity", [(-1.0, f64::INFINITY)], rebound);
    }

    proptest! {
        /// The next collision agrees with the map, bit for bit, and the rotary derivative is 0 or 1.
        #[test]
        fn the_next_collision_map_is_block_triangular(
            forcing in 0.3_f64..3.0, angular_forcing in 0.0_f64..10.0, lag in -PI..PI,
            angle in 0.0..TAU, speed in 0.2_f64..5.0, slip in -20.0_f64..20.0,
        ) {
            let system = system(forcing, angular_forcing, lag);
            let state = CollisionState {
                phase: Phase::new(angle).unwrap(),
                axial_impact_velocity: -speed,
                tangential_impact_velocity: slip,
            };
            let next = |slip: f64| {
                let state = CollisionState { tangential_impact_velocity: slip, ..state };
                let mut collisions = Collisions::after(system, state, ChatterPolicy::Complete).unwrap();
                match collisions.advance().unwrap() {
                    Some(CollisionEvent::Collision(collision)) => Some(collision),
                    _ => None,
                }
            };
            let Some(one) = next(slip) else { return Ok(()) };
            let impact = system.map().step(state.vertical().unwrap()).unwrap();
            prop_assert_eq!(one.time.phase.angle().to_bits(), impact.phase.angle().to_bits());
            prop_assert_eq!(one.state.axial_impact_velocity.to_bits(), impact.velocity.to_bits());
            let step = 1e-3;
            let limit = 1.5 * speed;
            prop_assume!(((slip.abs() - limit).abs() > 2.0 * step) && slip.abs() > 2.0 * step);
            let other = next(slip + step).unwrap();
            prop_assert_eq!(other.state.axial_impact_velocity.to_bits(), one.state.axial_impact_velocity.to_bits());
            let derivative = (other.state.tangential_impact_velocity - one.state.tangential_impact_velocity) / step;
            let expected = if slip.abs() < limit { 0.0 } else { 1.0 };
            prop_assert!((derivative - expected).abs() < 1e-8, "{derivative}");
        }
    }

    #[test]
    fn the_growth_rate_of_a_periodic_orbit_is_the_logarithm_of_its_multiplier() {
        let vibration = Vibration::from_axial_forcing(0.46).unwrap();
        let map = ImpactMap::new(vibration, 0.5).unwrap();
        let state = map.period_one(1).unwrap();
        let collision = Collision {
            time: PhaseTime::in_first_period(state.phase()),
            state: CollisionState {
                phase: state.phase(),
                axial_impact_velocity: state.velocity(),
                tangential_impact_velocity: 0.0,
            },
            angular_speed: 0.0,
            angle: 0.0,
            capped: true,
        };
        let watch = Watch::begin(&Unobserved, 0, 1).unwrap();
        let rate = growth_rate(&map, &vec![collision; 20_001], &mut watch.work()).unwrap().unwrap();
        let radius = Multipliers::of(map.refine(&[state]).unwrap().monodromy).spectral_radius();
        let expected = bouncing_disk_core::numerics::elementary::ln(radius);
        assert!((rate.exponent - expected).abs() < 1e-3, "{rate:?} {expected}");
        assert!((rate.exponent - expected).abs() < 3.0 * rate.standard_error, "{rate:?} {expected}");
    }

    /// On the orbit born in the fold, perturbations neither grow nor shrink.
    #[test]
    fn neutral_motion_is_no_chaos() {
        for (forcing, restitution) in [(0.3333333333333333, 0.5), (0.25, 0.6)] {
            let forcing = ForcingParameters {
                axial_forcing: forcing,
                angular_forcing: 1.0,
                phase_lag: 0.0,
                restitution,
            };
            let system = forcing.build().unwrap();
            let orbit =
                multi_toss(system, period_one(&system, 0.0), MultiTossSettings::default(), &Unobserved)
                    .unwrap();
            let OrbitClass::Undecided { lyapunov_exponent: Some(exponent), .. } = orbit.class else {
                panic!("{:?}", orbit.class)
            };
            assert!(exponent.exponent.abs() <= exponent.standard_error, "{exponent:?}");
        }
    }
}
