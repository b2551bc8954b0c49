//! The settings of a search for attractors.

use super::cells::VisitedCells;
use crate::attractors::verdict::VerdictSettings;
use crate::numerics::error::{Error, within};
use crate::numerics::stored::read_checked;
use crate::orbits::periodic::MAX_PERIOD;
use crate::orbits::periodic::catalogue::OrbitSearch;

/// Fewest impacts of a start that allow any statement about its motion.
const FEWEST_EACH: u64 = 256;

/// The settings of a search for attractors ([`ImpactMap::attractors`](crate::ImpactMap::attractors)).
///
/// ```
/// use bouncing_disk_core::attractors::AttractorSearch;
///
/// let search = AttractorSearch::default().with_starts(4_000)?.with_orbits(None);
/// assert_eq!(search.starts(), 4_000);
/// # Ok::<(), bouncing_disk_core::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedSearch"))]
pub struct AttractorSearch {
    starts: u32,
    transient: u64,
    impacts: u64,
    longest_period: usize,
    side: u32,
    orbits: Option<OrbitSearch>,
    budget: u64,
}

read_checked!(AttractorSearch as UncheckedSearch {
    starts: u32,
    transient: u64,
    impacts: u64,
    longest_period: usize,
    side: u32,
    orbits: Option<OrbitSearch>,
    #[serde(default = "default_budget")]
    budget: u64,
});

/// The default budget, also for a search stored before the budget existed.
const fn default_budget() -> u64 {
    1 << 28
}

/// The default search.
impl Default for AttractorSearch {
    fn default() -> Self {
        Self {
            starts: 1_024,
            transient: 2_000,
            impacts: 100_000,
            longest_period: 256,
            side: 256,
            orbits: OrbitSearch::new(2, 64).and_then(|search| search.with_starts(48, 48)).ok(),
            budget: default_budget(),
        }
    }
}

impl AttractorSearch {
    /// Largest number of starts.
    pub const MAX_STARTS: u32 = 1 << 18;

    /// Largest number of impacts.
    pub const MAX_IMPACTS: u64 = 1 << 40;

    /// The same search with this number of starts in [0, 2^18], spread evenly over the trapping region.
    /// Default 1,024: if the starts were random, a basin with 1 % of the region would be missed at most once
    /// in 30,000 searches. With 0 starts only the candidates are examined.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for the number.
    pub fn with_starts(self, starts: u32) -> Result<Self, Error> {
        let search = Self { starts, ..self };
        search.check().map(|()| search)
    }

    /// The same search with these numbers of impacts: `transient` in [1, 2^40], which are skipped (default
    /// 2,000), and then `impacts` in [64, 2^40] (default 100,000). Orbits of each aperiodic motion are
    /// followed for the sum of the two numbers. If one of them leaves its motion, all starts are followed as
    /// far; otherwise the other starts are followed for at most twice the transient.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for either number.
    pub fn with_impacts(self, transient: u64, impacts: u64) -> Result<Self, Error> {
        let search = Self { transient, impacts, ..self };
        search.check().map(|()| search)
    }

    /// The same search with this longest period of an attractor (impacts, in [1, 4096]; default 256).
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for the number.
    pub fn with_longest_period(self, longest_period: usize) -> Result<Self, Error> {
        let search = Self { longest_period, ..self };
        search.check().map(|()| search)
    }

    /// The same search with this number of cells in [8, 4096] along both axes of the grid that distinguishes
    /// aperiodic attractors. Default 256.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for the number.
    pub fn with_cells(self, side: u32) -> Result<Self, Error> {
        let search = Self { side, ..self };
        search.check().map(|()| search)
    }

    /// The same search with the periodic orbits that `orbits` finds: attracting ones become candidates however
    /// small their basins. `None` leaves only one-impact orbits, whose closed form costs nothing. Default: two
    /// impacts and 64 periods of the platform, from 48 x 48 starts.
    #[must_use]
    pub const fn with_orbits(self, orbits: Option<OrbitSearch>) -> Self {
        Self { orbits, ..self }
    }

    /// The same search with about this number of impacts at most, in [256 per start, 2^50]; default 2^28,
    /// which takes up to ten seconds on two cores. The search for periodic orbits ([`Self::with_orbits`]) and
    /// the proofs of periods do not count. Many starts are followed for fewer impacts each, and starts still
    /// under way when the budget is used up are undecided.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for the number. A smaller number of [starts](Self::with_starts) allows a smaller
    /// budget.
    pub fn with_budget(self, budget: u64) -> Result<Self, Error> {
        let search = Self { budget, ..self };
        search.check().map(|()| search)
    }

    /// Checks a value that was deserialised.
    fn check(&self) -> Result<(), Error> {
        let most = Self::MAX_IMPACTS as f64;
        within("starts", self.starts.into(), 0.0, Self::MAX_STARTS.into(), "[0, 262144]")?;
        within("transient", self.transient as f64, 1.0, most, "[1, 1099511627776] impacts")?;
        within("impacts", self.impacts as f64, 64.0, most, "[64, 1099511627776]")?;
        let longest = self.longest_period as f64;
        within("longest period", longest, 1.0, MAX_PERIOD as f64, "[1, 4096] impacts")?;
        let (least, most) = VisitedCells::SIDES;
        within("cells along an axis", self.side.into(), least.into(), most.into(), "[8, 4096]")?;
        let least = (FEWEST_EACH * u64::from(self.starts.max(1))) as f64;
        let most = (1_u64 << 50) as f64;
        within("budget", self.budget as f64, least, most, "[256 a start, 2^50]")?;
        Ok(())
    }

    /// The number of starts.
    #[must_use]
    pub const fn starts(&self) -> u32 {
        self.starts
    }

    /// The number of skipped impacts.
    #[must_use]
    pub const fn transient(&self) -> u64 {
        self.transient
    }

    /// Impacts, after the transient, over which orbits of aperiodic motions are followed.
    #[must_use]
    pub const fn impacts(&self) -> u64 {
        self.impacts
    }

    /// The longest period, in impacts.
    #[must_use]
    pub const fn longest_period(&self) -> usize {
        self.longest_period
    }

    /// Cells along each axis.
    #[must_use]
    pub const fn cells(&self) -> u32 {
        self.side
    }

    /// The search for candidates.
    #[must_use]
    pub const fn orbits(&self) -> Option<OrbitSearch> {
        self.orbits
    }

    /// Impacts of the whole search, except for the search for periodic orbits.
    #[must_use]
    pub const fn budget(&self) -> u64 {
        self.budget
    }

    /// The settings with which every start is followed at first: for at most a quarter of the budget, or 96
    /// impacts.
    pub(super) fn first_look(&self) -> VerdictSettings {
        let most = self.budget / (4 * u64::from(self.starts.max(1)));
        let transient = self.transient.min(most / 2);
        let impacts = self.transient.max(64).min(most - transient).max(64);
        VerdictSettings { transient, impacts, ..self.long_look() }
    }

    /// [`Self::long_look`] with at most this number of impacts; `None` if it is too small.
    pub(super) fn look_within(&self, impacts: u64) -> Option<VerdictSettings> {
        let look = self.long_look();
        if impacts >= look.allowed() {
            return Some(look);
        }
        let all = impacts;
        let transient = look.transient.min(all / 2);
        (all >= FEWEST_EACH).then_some(VerdictSettings { transient, impacts: all - transient, ..look })
    }

    /// The settings with which one start of each attractor that is not found at first is followed.
    pub(super) fn long_look(&self) -> VerdictSettings {
        VerdictSettings {
            transient: self.transient,
            impacts: self.impacts,
            longest_period: self.longest_period,
            ..VerdictSettings::default()
        }
    }
}
