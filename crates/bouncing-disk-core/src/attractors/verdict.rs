//! The long-term behaviour of an orbit of the impact map: a verdict with its evidence, for one start or many
//! in lockstep.

mod display;
mod proof;
pub(crate) mod returns;
pub(crate) mod witness;

use crate::chatter::policy::ChatterPolicy;
use crate::flight::platform::phase::Phase;
use crate::map::impact_map::{ImpactMap, ImpactState};
use crate::numerics::error::{Error, finite, not_negative, within};
use crate::numerics::stored::read_checked;
use crate::orbits::periodic::{MAX_PERIOD, Multipliers};
use crate::run::{Observer, Progress, Unobserved};
use crate::sweep::bouncing_map::BouncingMap;
use crate::sweep::lyapunov::LyapunovEstimate;
use crate::sweep::sweep_with;
use witness::Witness;

/// The long-term behaviour of an orbit, with the evidence. Impacts and rests are counted under
/// [`ChatterPolicy::Complete`].
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedVerdict"))]
#[non_exhaustive]
pub enum Verdict {
    /// The orbit came so near to an attracting periodic orbit that it was seen to converge to it. The
    /// periodic orbit is a solution of [`ImpactMap::refine`] with the smallest period. Its multipliers lie
    /// inside the unit circle by more than [their error](crate::orbits::PeriodicOrbit::multiplier_error), and
    /// the disk does not chatter to rest after any of its impacts.
    Periodic {
        /// Impacts of one period of the orbit.
        impacts: u64,
        /// Periods of the platform in one period of the orbit, at least 1.
        platform_periods: u64,
        /// Its Floquet multipliers.
        multipliers: Multipliers,
        /// One of its impacts, from which all others follow.
        state: ImpactState,
        /// The distance of the followed orbit from it (rad; a radian counts as much as the speed P).
        distance: f64,
        /// Impacts after which this was observed.
        after: u64,
        /// 1 if the disk came to rest on the way, 0 if not. According to [`ImpactMap::basin_label`] a start
        /// with a rest is in the basin of the attached disk, because the flight from a rest begins again.
        rests: u64,
    },
    /// Small perturbations grow by more than neutral motion, the escape from a periodic orbit and the error
    /// of the exponent can explain ([`LyapunovEstimate::grows`]), over enough impacts for dissipation to act
    /// ([`BouncingMap::transient_impacts`]). A finite number of impacts cannot distinguish an attractor from
    /// a longer transient.
    Chaotic {
        /// The largest exponent per impact.
        exponent: f64,
        /// Its standard error: scatter, drift and rounding.
        standard_error: f64,
        /// Impacts over which it was measured, after the transient.
        impacts: u64,
        /// Periods of the platform during these impacts.
        platform_periods: u64,
        /// 1 if the disk came to rest earlier, 0 if not.
        rests: u64,
    },
    /// The disk comes to rest on the platform, separates, and comes to rest again: as it always separates in
    /// the same way, this repeats forever, and no perturbation survives the rest.
    Chattering {
        /// The cycle that repeats.
        cycle: RestCycle,
        /// Impacts before the rest that begins the cycle.
        after: u64,
    },
    /// The disk has come to rest on a platform that never falls away from it: a sine with P <= 1, or a
    /// compliant contact that holds it.
    AtRest {
        /// Phase at which it comes to rest.
        phase: Phase,
        /// Earlier impacts, except summed ones.
        after: u64,
    },
    /// The allowed number of impacts leads to no certain answer.
    Undecided {
        /// The reason.
        reason: UndecidedReason,
        /// 1 if the disk came to rest earlier, 0 if not.
        rests: u64,
    },
}

/// One round of a disk that comes to rest again and again: from one separation to the next.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedCycle"))]
pub struct RestCycle {
    /// Impacts, except summed ones.
    pub impacts: u64,
    /// Periods of the platform, at least 1.
    pub platform_periods: u64,
    /// Flights that last longer than half a period of the platform. The short flights of a chatter have no
    /// end: their number depends on how they are summed rather than on the motion.
    pub long_flights: u64,
    /// The largest deviation of the impacts of the round from exact arithmetic due to rounding (rad and
    /// g/omega), to first order; capped at 1.
    pub rounding_error: f64,
    /// Whether the numbers above hold in exact arithmetic.
    pub trust: CycleTrust,
}

/// Whether a [`RestCycle`] holds in exact arithmetic.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedTrust"))]
#[non_exhaustive]
pub enum CycleTrust {
    /// Rounding is far too small to change a flight.
    Exact,
    /// The round is so long that rounding has grown to the size of the motion: another program finds another
    /// cycle. All such cycles share only statistics, such as the growth between two rests.
    ChosenByRounding {
        /// The mean logarithmic growth of a small perturbation per flight, over the flights from the first
        /// impact of the round to the rest; `None` if one of them grazes.
        exponent: Option<f64>,
        /// Its standard error; `None` for fewer than 16 flights.
        standard_error: Option<f64>,
    },
}

/// The reason why there is no verdict.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedReason"))]
#[non_exhaustive]
pub enum UndecidedReason {
    /// The exponent is not farther from zero than neutral motion and its error can explain
    /// ([`LyapunovEstimate::threshold`]), and no period up to the longest was proved.
    ExponentNearZero {
        /// The largest exponent per impact.
        exponent: f64,
        /// Its standard error.
        standard_error: f64,
    },
    /// Perturbations shrink, but no period up to the longest was proved: the period is longer, or the
    /// approach is too slow.
    NoPeriodFound {
        /// The largest exponent per impact.
        exponent: f64,
        /// Its standard error.
        standard_error: f64,
    },
    /// The orbit stays at a periodic orbit that does not certainly attract: the larger modulus of its
    /// multipliers is 1 within their error, or above 1 if the start was on the orbit to the last bits.
    OnPeriodicOrbit {
        /// Impacts of one period of the orbit.
        impacts: u64,
        /// Periods of the platform in one period of the orbit, at least 1.
        platform_periods: u64,
        /// Its Floquet multipliers.
        multipliers: Multipliers,
        /// The error of the multipliers
        /// ([`PeriodicOrbit::multiplier_error`](crate::orbits::PeriodicOrbit::multiplier_error)).
        multiplier_error: f64,
        /// One of its impacts.
        state: ImpactState,
    },
    /// The disk has come to rest in a compliant contact, and no bound proves that it stays.
    RestNotProven {
        /// Its phase.
        phase: Phase,
        /// Earlier impacts.
        after: u64,
    },
    /// Perturbations grow, but the orbit was not followed long enough for dissipation to end a transient.
    TransientMayLast {
        /// The largest exponent per impact.
        exponent: f64,
        /// Its standard error.
        standard_error: f64,
        /// Impacts needed, including the transient ([`BouncingMap::transient_impacts`]).
        needed: f64,
    },
    /// An impact has zero speed, or one so small that the derivative overflows a double; or the impact is at
    /// a kink of a drive, where there is no derivative.
    Grazing {
        /// Impacts up to this one.
        impacts: u64,
        /// Its phase.
        phase: Phase,
    },
}

read_checked!(enum Verdict as UncheckedVerdict {
    Periodic {
        impacts: u64, platform_periods: u64, multipliers: Multipliers, state: ImpactState, distance: f64,
        after: u64, rests: u64,
    },
    Chaotic { exponent: f64, standard_error: f64, impacts: u64, platform_periods: u64, rests: u64 },
    Chattering { cycle: RestCycle, after: u64 },
    AtRest { phase: Phase, after: u64 },
    Undecided { reason: UndecidedReason, rests: u64 },
});

read_checked!(RestCycle as UncheckedCycle {
    impacts: u64,
    platform_periods: u64,
    long_flights: u64,
    rounding_error: f64,
    trust: CycleTrust,
});

read_checked!(enum CycleTrust as UncheckedTrust {
    Exact,
    ChosenByRounding { exponent: Option<f64>, standard_error: Option<f64> },
});

read_checked!(enum UndecidedReason as UncheckedReason {
    ExponentNearZero { exponent: f64, standard_error: f64 },
    NoPeriodFound { exponent: f64, standard_error: f64 },
    OnPeriodicOrbit {
        impacts: u64, platform_periods: u64, multipliers: Multipliers, multiplier_error: f64,
        state: ImpactState,
    },
    RestNotProven { phase: Phase, after: u64 },
    TransientMayLast { exponent: f64, standard_error: f64, needed: f64 },
    Grazing { impacts: u64, phase: Phase },
});

/// Checks a count that is at least one.
fn at_least_one(field: &'static str, count: u64) -> Result<(), Error> {
    within(field, count as f64, 1.0, f64::MAX, "at least 1").map(|_| ())
}

fn check_exponent(exponent: f64, standard_error: f64) -> Result<(), Error> {
    finite("exponent", exponent)?;
    not_negative("standard error of an exponent", standard_error).map(|_| ())
}

fn check_rests(rests: u64) -> Result<(), Error> {
    within("rests before the verdict", rests as f64, 0.0, 1.0, "0 or 1").map(|_| ())
}

impl Verdict {
    /// Checks that a deserialised verdict could come from [`ImpactMap::verdict`].
    fn check(&self) -> Result<(), Error> {
        match *self {
            Self::Periodic { impacts, platform_periods, multipliers, state, distance, rests, .. } => {
                at_least_one("impacts of a period", impacts)?;
                at_least_one("platform periods", platform_periods)?;
                let radius = multipliers.spectral_radius();
                within("modulus of a multiplier", radius, 0.0, 1.0_f64.next_down(), "[0, 1)")?;
                let fastest = 0.0_f64.next_down();
                within("velocity of a periodic orbit", state.velocity(), f64::MIN, fastest, "below 0")?;
                not_negative("distance", distance)?;
                check_rests(rests)
            }
            Self::Chaotic { exponent, standard_error, impacts, rests, .. } => {
                check_exponent(exponent, standard_error)?;
                at_least_one("impacts", impacts)?;
                let least = LyapunovEstimate { exponent, standard_error, impacts }.threshold();
                within(
                    "exponent of chaos",
                    exponent,
                    least,
                    f64::MAX,
                    "above the exponent of neutral motion",
                )?;
                check_rests(rests)
            }
            Self::Undecided { rests, .. } => check_rests(rests),
            Self::Chattering { .. } | Self::AtRest { .. } => Ok(()),
        }
    }
}

impl RestCycle {
    /// Checks a value that was deserialised.
    fn check(&self) -> Result<(), Error> {
        at_least_one("impacts of a cycle", self.impacts)?;
        at_least_one("platform periods", self.platform_periods)?;
        let (long, all) = (self.long_flights as f64, self.impacts as f64);
        within("long flights", long, 0.0, all, "at most one before each impact")?;
        within("rounding error of a cycle", self.rounding_error, 0.0, 1.0, "[0, 1]").map(|_| ())
    }

    /// Whether the numbers of the cycle hold in exact arithmetic.
    #[must_use]
    pub const fn is_exact(&self) -> bool {
        matches!(self.trust, CycleTrust::Exact)
    }
}

impl CycleTrust {
    /// Checks a value that was deserialised.
    fn check(&self) -> Result<(), Error> {
        match *self {
            Self::ChosenByRounding { exponent, standard_error } => {
                check_exponent(exponent.unwrap_or(0.0), standard_error.unwrap_or(0.0))
            }
            Self::Exact => Ok(()),
        }
    }
}

impl UndecidedReason {
    /// Checks a value that was deserialised.
    fn check(&self) -> Result<(), Error> {
        match *self {
            Self::ExponentNearZero { exponent, standard_error }
            | Self::NoPeriodFound { exponent, standard_error } => check_exponent(exponent, standard_error),
            Self::TransientMayLast { exponent, standard_error, needed } => {
                not_negative("impacts of a transient", needed)?;
                check_exponent(exponent, standard_error)
            }
            Self::OnPeriodicOrbit { impacts, platform_periods, multiplier_error, .. } => {
                at_least_one("impacts of a period", impacts)?;
                at_least_one("platform periods", platform_periods)?;
                not_negative("error of a multiplier", multiplier_error).map(|_| ())
            }
            Self::Grazing { impacts, .. } => at_least_one("impacts", impacts),
            Self::RestNotProven { .. } => Ok(()),
        }
    }
}

impl ImpactMap {
    /// The long-term behaviour of the orbit from `state`.
    ///
    /// ```
    /// use bouncing_disk_core::attractors::{Verdict, VerdictSettings};
    /// use bouncing_disk_core::{ImpactMap, ImpactState, Vibration};
    ///
    /// let map = ImpactMap::new(Vibration::from_axial_forcing(0.45)?, 0.5)?;
    /// let start = ImpactState::from_normalised(1.2, 1.3)?;
    /// let verdict = map.verdict(start, VerdictSettings::default())?;
    /// assert!(matches!(verdict, Verdict::Periodic { impacts: 1, platform_periods: 1, .. }));
    /// # Ok::<(), bouncing_disk_core::Error>(())
    /// ```
    ///
    /// # Errors
    /// Errors of [`verdicts`].
    pub fn verdict(&self, state: ImpactState, settings: VerdictSettings) -> Result<Verdict, Error> {
        verdict(self, state, settings)
    }
}

fn verdict<M: BouncingMap>(map: &M, state: ImpactState, settings: VerdictSettings) -> Result<Verdict, Error> {
    let mut verdicts = verdicts(&[(map.clone(), state)], settings, &Unobserved)?;
    verdicts.pop().ok_or(Error::Stopped { done: 0, total: 1 })
}

/// The long-term behaviour of the orbits of all `starts`, in order. Orbits on a sine advance in lockstep,
/// with the same bits as [`ImpactMap::verdict`].
///
/// The items of `observer` are the orbits. [`each_verdict`] keeps the verdicts of a stopped call.
///
/// ```
/// use bouncing_disk_core::attractors::{Verdict, VerdictSettings, verdicts};
/// use bouncing_disk_core::{ImpactMap, ImpactState, Unobserved, Vibration};
///
/// // From order to chaos: the motion of a disk over the forcing.
/// let start = ImpactState::from_normalised(1.2, 1.3)?;
/// let starts = (0..20)
///     .map(|k| {
///         let vibration = Vibration::from_axial_forcing(0.2 + 0.02 * f64::from(k))?;
///         Ok((ImpactMap::new(vibration, 0.5)?, start))
///     })
///     .collect::<Result<Vec<_>, bouncing_disk_core::Error>>()?;
/// let verdicts = verdicts(&starts, VerdictSettings::default(), &Unobserved)?;
/// assert!(matches!(verdicts[0], Verdict::AtRest { .. }));
/// assert!(matches!(verdicts[10], Verdict::Periodic { .. }));
/// # Ok::<(), bouncing_disk_core::Error>(())
/// ```
///
/// # Errors
/// Errors of [`VerdictSettings::check`] and of [`sweep`](crate::sweep::sweep()).
pub fn verdicts<M: BouncingMap>(
    starts: &[(M, ImpactState)],
    settings: VerdictSettings,
    observer: &dyn Observer,
) -> Result<Vec<Verdict>, Error> {
    let mut all = Vec::new();
    let start = |index: usize| Ok::<_, Error>(Some(starts[index].clone()));
    each_verdict(starts.len(), start, settings, observer, |verdict| all.extend(verdict))?;
    Ok(all)
}

/// [`verdicts`] of `count` orbits without keeping starts or verdicts: `start` creates the start with a given
/// index when it is needed, and `each` receives the verdicts in order, `None` for a missing start. Memory use
/// does not depend on the number of orbits. The items of the observer are the orbits.
///
/// # Errors
/// Errors of [`verdicts`] and of `start`; [`Error::Stopped`] if the observer breaks.
pub fn each_verdict<M: BouncingMap, E: From<Error>>(
    count: usize,
    mut start: impl FnMut(usize) -> Result<Option<(M, ImpactState)>, E>,
    settings: VerdictSettings,
    observer: &dyn Observer,
    mut each: impl FnMut(Option<Verdict>),
) -> Result<(), E> {
    settings.check()?;
    let total = count as u64;
    // At least one call of the observer, even without orbits.
    for first in (0..count.max(1)).step_by(M::TOGETHER) {
        let block: Vec<_> =
            (first..count.min(first + M::TOGETHER)).map(&mut start).collect::<Result<_, E>>()?;
        let starts: Vec<_> = block.iter().flatten().collect();
        let orbits: Vec<M::Orbit> =
            starts.iter().map(|(map, state)| map.orbit(*state, ChatterPolicy::Complete)).collect();
        let done = |done: u64| first as u64 + done;
        let shifted = |progress: Progress| observer.observe(Progress { done: done(progress.done), total });
        let found = sweep_with(
            &orbits,
            |index| Witness::new((&starts[index].0, starts[index].1), settings),
            Witness::see,
            |witness| Ok(witness.verdict()),
            &shifted,
        );
        let found = found.map_err(|error| match error {
            Error::Stopped { done: own, .. } => Error::Stopped { done: done(own), total },
            other => other,
        })?;
        let mut found = found.into_iter();
        block.iter().for_each(|start| each(start.as_ref().and_then(|_| found.next())));
    }
    Ok(())
}

/// The largest tolerance for a return.
const LARGEST_TOLERANCE: f64 = 1.0e-2;

/// The fewest impacts that an exponent is measured over: batches of four.
const FEWEST_IMPACTS: f64 = 64.0;

/// The settings for following an orbit to its verdict.
///
/// An orbit that repeats or rests is decided as soon as this is observed. The others are followed for
/// `transient` + `impacts` impacts. After a rest on a platform that falls away the count starts again, once
/// for each phase at which the rest ends.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedSettings"))]
pub struct VerdictSettings {
    /// Impacts before the exponent is measured. Default 2,000.
    pub transient: u64,
    /// Impacts over which the exponent is measured, at least 64. Default 100,000.
    pub impacts: u64,
    /// The longest period searched for, in impacts, in [1, 4096]. Default 256. Between two calls of an
    /// observer the proof of a period makes at most about fifty times this number of flights, plus 8,192.
    pub longest_period: usize,
    /// The distance between an impact and an earlier one below which a period is tried (rad, and relative
    /// speed), in (0, 0.01]. Default 1e-7. It decides how soon a period is found; its existence is then
    /// proved.
    pub tolerance: f64,
}

impl Default for VerdictSettings {
    fn default() -> Self {
        Self { transient: 2_000, impacts: 100_000, longest_period: 256, tolerance: 1.0e-7 }
    }
}

read_checked!(VerdictSettings as UncheckedSettings {
    transient: u64,
    impacts: u64,
    longest_period: usize,
    tolerance: f64,
});

impl VerdictSettings {
    /// Checks the ranges.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] names the field that is out of its range.
    pub fn check(&self) -> Result<(), Error> {
        within("impacts", self.impacts as f64, FEWEST_IMPACTS, f64::MAX, "at least 64")?;
        let longest = self.longest_period as f64;
        within("longest period", longest, 1.0, MAX_PERIOD as f64, "[1, 4096] impacts")?;
        let least = f64::from_bits(1);
        within("tolerance", self.tolerance, least, LARGEST_TOLERANCE, "(0, 0.01]")?;
        Ok(())
    }

    /// Impacts after which an orbit is abandoned.
    pub(crate) const fn allowed(&self) -> u64 {
        self.transient.saturating_add(self.impacts)
    }
}

#[cfg(test)]
mod tests;
