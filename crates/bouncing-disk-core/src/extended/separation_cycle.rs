//! The cycle of a disk that comes to rest: from one separation to the next, in as many digits as it takes.
//!
//! After every rest the disk leaves the platform in the same state, so that the orbit from there to its next
//! rest is the whole cycle. In doubles a rounding decides which cycle that is, as soon as the rounding has
//! grown to the size of the orbit (docs/numerics/dynamics.md, "The true sticking cycle").

use crate::error::{Error, within};
use crate::extended::exact_orbit::{ExactOrbit, Followed};
use crate::map::impact_map::{ImpactMap, OrbitEvent};
use crate::observer::{Observer, Unobserved, Watch};
use crate::{ChatterPolicy, Launch, read_checked};

mod stored;

/// Bits of the first attempt.
const FIRST_BITS: usize = 256;

/// Bits by which two computations of a cycle differ that must agree: other roundings from the first one on.
const OTHER_BITS: usize = 61;

/// By how much the phase (rad) may differ at which the disk comes to rest in both.
const SAME_PHASE: f64 = 1.0e-9;

/// Bits in a decimal digit.
const BITS_PER_DIGIT: f64 = core::f64::consts::LOG2_10;

/// How far a cycle is followed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedBudget"))]
pub struct CycleBudget {
    /// Impacts of a cycle, from 1 to 10^7.
    pub max_impacts: u64,
    /// Decimal digits of the arithmetic, from 20 to 100,000.
    pub max_digits: usize,
}

read_checked!(CycleBudget as UncheckedBudget { max_impacts: u64, max_digits: usize });

impl CycleBudget {
    /// Checks what is read or given.
    fn check(&self) -> Result<(), Error> {
        within("impacts of a cycle", self.max_impacts as f64, 1.0, 1.0e7, "[1, 10000000]")?;
        within("digits of a cycle", self.max_digits as f64, 20.0, 1.0e5, "[20, 100000]")?;
        Ok(())
    }
}

/// 5,000 impacts and 4,000 digits: some seconds.
impl Default for CycleBudget {
    fn default() -> Self {
        Self { max_impacts: 5_000, max_digits: 4_000 }
    }
}

/// A cycle from separation to separation.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedCycle"))]
pub struct SeparationCycle {
    /// Impacts from the separation until the chatter that ends in rest is summed, as an
    /// [`Orbit`](crate::Orbit) under
    /// [`ChatterPolicy::Complete`] counts them.
    pub impacts: u64,
    /// Periods of the platform from one separation to the next.
    pub platform_periods: u64,
    /// The phase (rad) at which the disk comes to rest.
    pub rest_phase: f64,
    /// Decimal digits that the arithmetic had; one with 18 more gave the same cycle.
    pub digits: usize,
    /// Decimal digits that the orbit has lost: an error grows by this power of ten, at most, on the way.
    pub lost_digits: f64,
    /// Impacts of the cycle that doubles follow to 1e-3 rad.
    pub impacts_in_doubles: u64,
    /// The cycle that doubles find instead or as well, `None` if they find none in ten times as many impacts.
    pub in_doubles: Option<DoublesCycle>,
}

/// The cycle of the same map in doubles.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct DoublesCycle {
    /// Impacts until it comes to rest.
    pub impacts: u64,
    /// Periods of the platform from one separation to the next.
    pub platform_periods: u64,
}

impl SeparationCycle {
    /// Whether doubles find this very cycle: all its impacts, not only their number.
    #[must_use]
    pub fn is_that_of_doubles(&self) -> bool {
        let here = DoublesCycle { impacts: self.impacts, platform_periods: self.platform_periods };
        self.impacts_in_doubles == self.impacts && self.in_doubles == Some(here)
    }
}

/// What became of the search for a cycle.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedOutcome"))]
#[non_exhaustive]
pub enum SeparationOutcome {
    /// The disk comes to rest: this is the cycle.
    Cycle(SeparationCycle),
    /// The platform never falls away from a disk at rest (P <= 1).
    NeverSeparates,
    /// No rest within the impacts of the budget.
    NoRestWithin {
        /// Impacts that were followed.
        impacts: u64,
        /// Decimal digits lost on the way.
        lost_digits: f64,
        /// Impacts that doubles follow to 1e-3 rad.
        impacts_in_doubles: u64,
    },
    /// More digits than the budget allows would be needed to go on.
    DigitsSpent {
        /// Impacts that were followed.
        impacts: u64,
        /// Decimal digits that the arithmetic had.
        digits: usize,
    },
    /// A flight comes so near to another impact that doubles cannot tell which is the first.
    UnsureFlight {
        /// Impacts before it.
        impacts: u64,
        /// How near it comes, in units of g/omega^2.
        margin: f64,
    },
    /// Two computations with different digits did not give the same cycle.
    Disagreement {
        /// Impacts of the cycle in the first one.
        impacts: u64,
        /// Its decimal digits.
        digits: usize,
    },
}

read_checked!(SeparationCycle as UncheckedCycle {
    impacts: u64,
    platform_periods: u64,
    rest_phase: f64,
    digits: usize,
    lost_digits: f64,
    impacts_in_doubles: u64,
    in_doubles: Option<DoublesCycle>,
});

read_checked!(enum SeparationOutcome as UncheckedOutcome {
    Cycle(cycle: SeparationCycle),
    NeverSeparates,
    NoRestWithin { impacts: u64, lost_digits: f64, impacts_in_doubles: u64 },
    DigitsSpent { impacts: u64, digits: usize },
    UnsureFlight { impacts: u64, margin: f64 },
    Disagreement { impacts: u64, digits: usize },
});

/// The true cycle of a disk that leaves the platform from rest, of the map whose peak acceleration P and
/// restitution are exactly the doubles that `map` holds. A map with other digits has another cycle, as soon
/// as the cycle is longer than doubles can follow.
///
/// The digits are doubled until the errors that have grown leave enough of them at the end, and the cycle is
/// computed once more with other ones: both must agree. Each flight begins from the proven first impact in
/// doubles and is continued by Newton's iteration; a flight for which the first impact is in doubt in doubles
/// ends the search ([`SeparationOutcome::UnsureFlight`]).
///
/// ```
/// use bouncing_disk_core::extended::{CycleBudget, SeparationOutcome, separation_cycle};
/// use bouncing_disk_core::{ImpactMap, Vibration};
///
/// let map = ImpactMap::new(Vibration::from_axial_forcing(0.4)?, 0.2)?;
/// let outcome = separation_cycle(map, CycleBudget::default())?;
/// let SeparationOutcome::Cycle(cycle) = outcome else { panic!("{outcome:?}") };
/// assert!(cycle.is_that_of_doubles());
/// # Ok::<(), bouncing_disk_core::Error>(())
/// ```
///
/// # Errors
/// [`Error::OutOfRange`] for the budget; those of [`Vibration::first_impact`](crate::Vibration::first_impact).
pub fn separation_cycle(map: ImpactMap, budget: CycleBudget) -> Result<SeparationOutcome, Error> {
    separation_cycle_observed(map, budget, &Unobserved)
}

/// [`separation_cycle`] with an observer; the items are the impacts of the computation under way.
///
/// # Errors
/// Those of [`separation_cycle`]; [`Error::Stopped`] if the observer breaks.
pub fn separation_cycle_observed(
    map: ImpactMap,
    budget: CycleBudget,
    observer: &dyn Observer,
) -> Result<SeparationOutcome, Error> {
    budget.check()?;
    let watch = Watch::begin(observer, 0, budget.max_impacts)?;
    if map.vibration().separation_phase().is_none() {
        watch.end();
        return Ok(SeparationOutcome::NeverSeparates);
    }
    let most = ((budget.max_digits as f64 * BITS_PER_DIGIT) as usize).max(FIRST_BITS);
    let mut bits = FIRST_BITS;
    let outcome = loop {
        let first = ExactOrbit::new(map, bits)?.follow(budget.max_impacts, &watch)?;
        let digits = (bits as f64 / BITS_PER_DIGIT) as usize;
        match first {
            Followed::Spent { .. } if bits < most => bits = (2 * bits).min(most),
            Followed::Spent { impacts } => break SeparationOutcome::DigitsSpent { impacts, digits },
            Followed::Unsure { impacts, margin } => {
                break SeparationOutcome::UnsureFlight { impacts, margin };
            }
            Followed::Flying { impacts, lost_bits, impacts_in_doubles } => {
                let lost_digits = lost_bits / BITS_PER_DIGIT;
                break SeparationOutcome::NoRestWithin { impacts, lost_digits, impacts_in_doubles };
            }
            Followed::Rest { impacts, periods, phase, lost_bits, impacts_in_doubles } => {
                watch.set_done(0);
                let again = ExactOrbit::new(map, bits + OTHER_BITS)?.follow(budget.max_impacts, &watch)?;
                let agrees = matches!(again, Followed::Rest { impacts: also, periods: as_well, phase: there, .. }
                    if also == impacts && as_well == periods && (there - phase).abs() <= SAME_PHASE);
                if !agrees {
                    break SeparationOutcome::Disagreement { impacts, digits };
                }
                break SeparationOutcome::Cycle(SeparationCycle {
                    impacts,
                    platform_periods: periods,
                    rest_phase: phase,
                    digits,
                    lost_digits: lost_bits / BITS_PER_DIGIT,
                    impacts_in_doubles,
                    in_doubles: cycle_in_doubles(map, 10 * impacts, &watch)?,
                });
            }
        }
        watch.set_done(0);
    };
    watch.end();
    Ok(outcome)
}

/// The cycle that doubles find within so many impacts.
fn cycle_in_doubles(map: ImpactMap, most: u64, watch: &Watch<'_>) -> Result<Option<DoublesCycle>, Error> {
    let Some(phase) = map.vibration().separation_phase() else { return Ok(None) };
    let mut work = watch.work();
    let (mut impacts, mut periods) = (0, 0);
    let mut orbit = map.orbit_from_launch(Launch::new(phase, 0.0)?, ChatterPolicy::Complete);
    while impacts <= most {
        work.spend(1)?;
        match orbit.advance()? {
            Some(OrbitEvent::Impact(impact)) => {
                impacts += 1;
                periods += impact.turns;
            }
            Some(OrbitEvent::Attachment(rest)) => {
                let to_separation = rest.separation.map_or(0, |(_, turns)| turns);
                let platform_periods = periods + rest.accumulation.turns + to_separation;
                return Ok(Some(DoublesCycle { impacts, platform_periods }));
            }
            None => return Ok(None),
        }
    }
    Ok(None)
}

#[cfg(test)]
mod tests;
