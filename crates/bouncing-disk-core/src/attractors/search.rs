//! The attractors of a map, found without known orbits, and their basins (docs/numerics-dynamics.md,
//! "Attractors").
//!
//! One open start is followed for n = 102,000 impacts, then 1,024 orbits that begin near its impacts, also for n
//! impacts. If all stay, the motion is chaotic. A start then belongs to the motion if, of 512 impacts after the
//! transient, at least half of the share usual on the motion lie in its cells. If one orbit leaves, the motion is
//! a transient: all open starts are followed for n impacts (fewer if there are thousands), and those still on it
//! are its share. If the usual share is below 0.1, cells cannot distinguish motions, and the motion is undecided.

mod basins;
pub(crate) mod cells;
pub(crate) mod find;
mod follow;
pub(crate) mod over_forcing;
pub(crate) mod settings;
mod starts;

use crate::attractors::attracting_map::AttractingMap;
use crate::attractors::basin::{KnownOrbit, Label};
use crate::attractors::verdict::RestCycle;
use crate::map::impact_map::{ImpactMap, ImpactState};
use crate::numerics::error::{Error, finite, not_negative, within};
use crate::numerics::fraction::Fraction;
use crate::numerics::lifetime::Lifetime;
use crate::numerics::stored::read_checked;
use crate::orbits::periodic::PeriodicOrbit;
use crate::run::Observer;
use cells::VisitedCells;
use settings::AttractorSearch;

/// Largest number of attractors apart from the disk at rest: as many as labels can distinguish.
const MOST_ATTRACTORS: usize = 250;

/// The motion of a disk after it has come to rest on the platform.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedAfterRest"))]
#[non_exhaustive]
pub enum AfterRest {
    /// It stays forever: the platform never falls away (P <= 1).
    StaysForEver,
    /// It separates, always in the same way, and comes to rest again.
    RestsAgain(RestCycle),
    /// It separates and does not come to rest again in the search: the rest is not an attractor. The rest
    /// leads to the motion at this index of [`Attractors::all`], as do all starts that come to rest. If this
    /// motion is a transient, the disk may rest again later.
    LeadsTo(usize),
    /// On a drive: rests end at several phases, and different motions follow.
    Several {
        /// Whether each of these motions comes to rest again and again, or stays at rest.
        last: bool,
    },
    /// It separates, and the search does not decide its further motion.
    Undecided,
}

read_checked!(enum AfterRest as UncheckedAfterRest {
    StaysForEver,
    RestsAgain(cycle: RestCycle),
    LeadsTo(attractor: usize),
    Several { last: bool },
    Undecided,
});

impl AfterRest {
    /// The number of the attractor that the rest leads to, in [`Attractors::all`]; `None` if the rest lasts.
    #[must_use]
    pub const fn leads_to(&self) -> Option<usize> {
        match self {
            Self::LeadsTo(attractor) => Some(*attractor),
            Self::StaysForEver | Self::RestsAgain(_) | Self::Several { .. } | Self::Undecided => None,
        }
    }

    /// The parts are checked when they are read; [`Attractors`] checks the number.
    const fn check(&self) -> Result<(), Error> {
        match *self {
            Self::LeadsTo(0) => {
                Err(Error::Unfitting { what: "attractor that a rest leads to", found: 0, expected: 1 })
            }
            _ => Ok(()),
        }
    }
}

/// The cells visited by one orbit of an aperiodic motion, and how long other orbits stay there.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedRecurrence"))]
pub struct Recurrence {
    /// The cells visited in the second half of the orbit's impacts.
    pub cells: VisitedCells,
    /// Impacts over which orbits that began on the motion were followed; for a transient, the number after
    /// which its starts were counted.
    pub impacts: u64,
    /// The number of orbits that did not leave, of at most 1,024 that began on the motion.
    pub orbits: u64,
    /// The last impact of the orbit.
    pub state: ImpactState,
}

read_checked!(Recurrence as UncheckedRecurrence {
    cells: VisitedCells,
    impacts: u64,
    orbits: u64,
    state: ImpactState,
});

impl Recurrence {
    /// Checks deserialised cells: an orbit has visited at least one.
    fn check(&self) -> Result<(), Error> {
        let (cells, impacts) = (self.cells.visited().len() as f64, self.impacts as f64);
        within("visited cells", cells, 1.0, f64::MAX, "at least 1")?;
        within("impacts of an orbit", impacts, 1.0, f64::MAX, "at least 1").map(|_| ())
    }
}

/// The kind of an attractor.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedKind"))]
#[non_exhaustive]
pub enum AttractorKind {
    /// The disk comes to rest on the platform. Every map has such starts; the motion after the rest differs.
    Rest(AfterRest),
    /// A [stable](crate::orbits::Stability) periodic orbit, and its [`PeriodicOrbit::trapping_radius`]; 0 if
    /// there is none, as near a graze.
    Periodic(KnownOrbit),
    /// A periodic orbit with a multiplier that is 1 or -1 within rounding, as at the fold at which two orbits
    /// are born: it attracts from one side only, or rounding decides whether it attracts. Starts approach it
    /// ever more slowly and stay undecided in basins.
    Marginal(PeriodicOrbit),
    /// A motion whose small perturbations certainly grow
    /// ([`Verdict::Chaotic`](crate::attractors::Verdict::Chaotic)). None of [`Recurrence::orbits`] orbits has
    /// left it within [`Recurrence::impacts`] impacts; nothing is claimed beyond this number.
    Chaotic {
        /// The largest Lyapunov exponent per impact.
        exponent: f64,
        /// Its standard error, from batch means.
        standard_error: f64,
        /// The cells it has visited.
        recurrence: Recurrence,
    },
    /// A motion whose small perturbations grow, and which orbits leave, or may leave because they were not
    /// followed long enough for dissipation to act
    /// ([`BouncingMap::transient_impacts`](crate::BouncingMap::transient_impacts)). Its starts are those
    /// still on it after [`Recurrence::impacts`] impacts.
    Transient {
        /// The largest Lyapunov exponent per impact.
        exponent: f64,
        /// Its standard error, from batch means.
        standard_error: f64,
        /// Its mean lifetime, or a bound on it.
        lifetime: Lifetime,
        /// The cells it has visited.
        recurrence: Recurrence,
    },
}

read_checked!(enum AttractorKind as UncheckedKind {
    Rest(after: AfterRest),
    Periodic(known: KnownOrbit),
    Marginal(orbit: PeriodicOrbit),
    Chaotic { exponent: f64, standard_error: f64, recurrence: Recurrence },
    Transient { exponent: f64, standard_error: f64, lifetime: Lifetime, recurrence: Recurrence },
});

impl AttractorKind {
    /// Its name: `rest`, `periodic`, `marginal`, `chaotic` or `transient`.
    #[must_use]
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Rest(_) => "rest",
            Self::Periodic(_) => "periodic",
            Self::Marginal(_) => "marginal",
            Self::Chaotic { .. } => "chaotic",
            Self::Transient { .. } => "transient",
        }
    }

    /// The orbit of a periodic or marginal attractor.
    #[must_use]
    pub const fn orbit(&self) -> Option<&PeriodicOrbit> {
        match self {
            Self::Periodic(known) => Some(known.orbit()),
            Self::Marginal(orbit) => Some(orbit),
            _ => None,
        }
    }

    /// Checks a value that was deserialised.
    fn check(&self) -> Result<(), Error> {
        if let Self::Chaotic { exponent, standard_error, .. }
        | Self::Transient { exponent, standard_error, .. } = self
        {
            finite("exponent", *exponent)?;
            not_negative("standard error of an exponent", *standard_error)?;
        }
        if let Self::Chaotic { recurrence, .. } = self {
            let orbits = recurrence.orbits as f64;
            within("orbits on a chaotic motion", orbits, 1.0, f64::MAX, "at least 1")?;
        }
        Ok(())
    }

    /// The cells visited by an aperiodic motion, and its survival.
    #[must_use]
    pub const fn recurrence(&self) -> Option<&Recurrence> {
        match self {
            Self::Chaotic { recurrence, .. } | Self::Transient { recurrence, .. } => Some(recurrence),
            Self::Rest(_) | Self::Periodic(_) | Self::Marginal(_) => None,
        }
    }

    /// The cycle of a disk that comes to rest again and again: [`RestCycle::is_exact`] tells whether its
    /// numbers hold in exact arithmetic or are chosen by rounding.
    #[must_use]
    pub const fn rest_cycle(&self) -> Option<&RestCycle> {
        match self {
            Self::Rest(AfterRest::RestsAgain(cycle)) => Some(cycle),
            _ => None,
        }
    }

    /// Whether the motion lasts: forever at rest and on an attracting orbit, for [`Recurrence::impacts`]
    /// impacts if it is chaotic. It does not last, at least not certainly, on a marginal orbit, in a
    /// transient, or if the disk rests and may never rest again.
    #[must_use]
    pub const fn lasts(&self) -> bool {
        match self {
            Self::Rest(after) => matches!(
                after,
                AfterRest::StaysForEver | AfterRest::RestsAgain(_) | AfterRest::Several { last: true }
            ),
            Self::Periodic(_) | Self::Chaotic { .. } => true,
            Self::Marginal(_) | Self::Transient { .. } => false,
        }
    }
}

/// `comes to rest for ever`, `periodic orbit: impacts 1, platform periods 1`, and so on; a given precision
/// applies to the exponent. The text numbers attractors from one, like [labels](Attractors::label).
impl core::fmt::Display for AttractorKind {
    fn fmt(&self, formatter: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let digits = formatter.precision().unwrap_or(4);
        match self {
            Self::Rest(AfterRest::StaysForEver) => formatter.write_str("comes to rest for ever"),
            Self::Rest(AfterRest::RestsAgain(cycle)) if cycle.is_exact() => {
                write!(
                    formatter,
                    "comes to rest again and again: platform periods {}",
                    cycle.platform_periods
                )
            }
            Self::Rest(AfterRest::RestsAgain(_)) => {
                formatter.write_str("comes to rest again and again, in a cycle set by rounding")
            }
            Self::Rest(AfterRest::LeadsTo(other)) => {
                write!(formatter, "comes to rest, then attractor {}", other + 1)
            }
            Self::Rest(AfterRest::Several { .. }) => {
                formatter.write_str("comes to rest, then one of several motions")
            }
            Self::Rest(AfterRest::Undecided) => {
                formatter.write_str("comes to rest, then an undecided motion")
            }
            Self::Periodic(known) => {
                let (impacts, periods) = (known.orbit().period(), known.orbit().platform_periods);
                write!(formatter, "periodic orbit: impacts {impacts}, platform periods {periods}")
            }
            Self::Marginal(orbit) => {
                let (impacts, periods) = (orbit.period(), orbit.platform_periods);
                write!(formatter, "marginal periodic orbit: impacts {impacts}, platform periods {periods}")
            }
            Self::Chaotic { exponent, recurrence, .. } => {
                let Recurrence { impacts, orbits, .. } = recurrence;
                write!(formatter, "chaotic: exponent {exponent:.digits$} per impact, ")?;
                write!(formatter, "not left by {orbits} orbits within {impacts} impacts")
            }
            Self::Transient { exponent, lifetime, recurrence, .. } => {
                write!(
                    formatter,
                    "chaotic transient: exponent {exponent:.digits$} per impact, {lifetime}, "
                )?;
                write!(formatter, "starts counted after {} impacts", recurrence.impacts)
            }
        }
    }
}

/// An attractor, and the number of starts that ended on it.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Attractor {
    /// Its kind.
    pub kind: AttractorKind,
    /// The share of starts that ended on it, 0 if it was only a candidate. Its interval is the confidence
    /// interval of the basin's share of the trapping region.
    pub starts: Fraction,
}

/// The attractors of a map: the disk at rest, and all others that were found.
///
/// They are numbered as in [`Self::all`]. The disk at rest is 0; then come the periodic ones by impacts,
/// platform periods and decreasing speed, the marginal ones in the same order, and all others in the order of
/// discovery.
///
/// With serde they can be stored and read for a sine.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Attractors<M = ImpactMap> {
    map: M,
    search: AttractorSearch,
    all: Vec<Attractor>,
}

read_checked!(Attractors as UncheckedAttractors {
    map: ImpactMap,
    search: AttractorSearch,
    all: Vec<Attractor>,
});

#[cfg(feature = "serde")]
impl<'de> serde::Deserialize<'de> for Attractors {
    fn deserialize<D: serde::Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        UncheckedAttractors::deserialize(from)?.try_into().map_err(serde::de::Error::custom)
    }
}

impl Attractors {
    /// Checks deserialised attractors: the disk at rest first, then periodic ones, then all others; no more
    /// than there are labels; orbits of this map; and no more starts than were followed.
    fn check(&self) -> Result<(), Error> {
        let refuse = |what, found: usize, expected: usize| {
            Err(Error::Unfitting { what, found: found as u64, expected: expected as u64 })
        };
        let count = self.all.len();
        if count == 0 || count > MOST_ATTRACTORS + 1 {
            return refuse("attractors", count, MOST_ATTRACTORS + 1);
        }
        let rank = |attractor: &Attractor| match attractor.kind {
            AttractorKind::Rest(_) => 0,
            AttractorKind::Periodic(_) => 1,
            AttractorKind::Marginal(_) => 2,
            AttractorKind::Chaotic { .. } | AttractorKind::Transient { .. } => 3_usize,
        };
        let rests = self.all.iter().filter(|attractor| rank(attractor) == 0).count();
        if rests != 1 {
            return refuse("attractors at rest", rests, 1);
        }
        if let Some(late) = self.all.windows(2).position(|pair| rank(&pair[0]) > rank(&pair[1])) {
            return refuse("attractor out of order", late + 1, late);
        }
        if let AttractorKind::Rest(AfterRest::LeadsTo(target)) = self.all[0].kind
            && target >= count
        {
            return refuse("attractor that a rest leads to", target, count - 1);
        }
        self.all.iter().filter_map(|own| own.kind.orbit()).try_for_each(|own| self.map.check_orbit(own))?;
        let starts = u64::from(self.search.starts());
        if let Some(other) = self.all.iter().find(|attractor| attractor.starts.of() != starts) {
            return refuse("starts of an attractor", other.starts.of() as usize, starts as usize);
        }
        let ended = self.all.iter().map(|attractor| attractor.starts.count()).fold(0, u64::saturating_add);
        if ended > starts {
            return refuse("starts that ended on attractors", ended as usize, starts as usize);
        }
        Ok(())
    }
}

impl<M> Attractors<M> {
    /// The map.
    #[must_use]
    pub const fn map(&self) -> &M {
        &self.map
    }

    /// The settings of the search.
    #[must_use]
    pub const fn search(&self) -> &AttractorSearch {
        &self.search
    }

    /// All attractors; number 0 is the disk at rest.
    #[must_use]
    pub fn all(&self) -> &[Attractor] {
        &self.all
    }

    /// The attractors that last, with their numbers.
    pub fn lasting(&self) -> impl Iterator<Item = (usize, &Attractor)> {
        self.all.iter().enumerate().filter(|(_, attractor)| attractor.kind.lasts())
    }

    /// The starts that ended on none of them. Their perturbations neither certainly grow nor certainly
    /// shrink, as when a motion creeps past a fold; or they shrink but no period was found; or the
    /// [budget](AttractorSearch::budget) was used up.
    #[must_use]
    pub fn undecided(&self) -> Fraction {
        let starts = u64::from(self.search.starts());
        let ended = self.all.iter().map(|attractor| attractor.starts.count()).sum();
        Fraction::new(starts.saturating_sub(ended), starts).unwrap_or_default()
    }

    /// The label of the attractor with this number in [`Self::basins`]:
    /// [`ATTACHED`](crate::attractors::ATTACHED) for the disk at rest, then counting from
    /// [`FIRST_ORBIT`](crate::attractors::FIRST_ORBIT); `None` if there is no such attractor.
    #[must_use]
    pub fn label(&self, number: usize) -> Option<Label> {
        (number < self.all.len()).then(|| label_of(number))
    }

    /// The attractor with this label.
    #[must_use]
    pub fn labelled(&self, label: Label) -> Option<&Attractor> {
        self.all.get(usize::from(label).checked_sub(1)?)
    }

    /// The periodic attractors, numbers 1, 2, ..., in the form needed for basins of known orbits.
    pub fn known(&self) -> impl Iterator<Item = &KnownOrbit> {
        self.all.iter().filter_map(|attractor| match &attractor.kind {
            AttractorKind::Periodic(known) => Some(known),
            _ => None,
        })
    }
}

/// The label of an attractor with an existing number: at most 251.
const fn label_of(number: usize) -> Label {
    number as Label + 1
}

impl<M: AttractingMap> Attractors<M> {
    /// The attractors of a map, found without any known orbit.
    ///
    /// Starts are spread evenly over the trapping region ([`AttractingMap::impact_speed_bound_at`]), which no
    /// attractor can leave, so the result does not depend on a chosen window. Each start is followed until it
    /// rests, or is seen to approach a periodic orbit, which is then refined. One of the remaining starts is
    /// followed for as many impacts as the [search](AttractorSearch::with_impacts) allows, and so are 1,024
    /// orbits that begin near its impacts. If none of these leaves, all starts that return to the visited
    /// cells are on the same attractor. If one leaves, the motion is a [transient](AttractorKind::Transient),
    /// and all starts are followed for the same number of impacts, or fewer if the budget is too small.
    /// Periodic orbits are the same as in [`ImpactMap::periodic_orbits`], except for their first impact.
    ///
    /// Attracting one-impact orbits, known in closed form, and attracting orbits found by
    /// [`AttractorSearch::orbits`] are always included, however small their basins.
    ///
    /// On a drive a rest may end at several phases. If the motions that follow differ, the rest is
    /// [`AfterRest::Several`].
    ///
    /// Two things are not proven. The search misses an attractor whose basin contains no start; its share is
    /// then below the upper end of the [interval](Fraction::interval) for zero starts. And a chaotic motion
    /// may end after more impacts than the stated number.
    ///
    /// The items of `observer` are the starts. Each counts twice: when it has been examined, and when its
    /// attractor is known.
    ///
    /// ```
    /// use bouncing_disk_core::attractors::{AttractorKind, AttractorSearch, Attractors};
    /// use bouncing_disk_core::{ImpactMap, Unobserved, Vibration};
    ///
    /// // Where the paper has two attractors there are three: rest, period 1, and an orbit of four impacts.
    /// let map = ImpactMap::new(Vibration::from_axial_forcing(0.486)?, 0.5)?;
    /// let found = Attractors::find(&map, &AttractorSearch::default(), &Unobserved)?;
    /// let periods: Vec<usize> = found.known().map(|known| known.orbit().period()).collect();
    /// assert_eq!((found.all().len(), periods), (3, vec![1, 4]));
    /// # Ok::<(), bouncing_disk_core::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::TooLarge`] for more than 250 attractors apart from the disk at rest; errors of
    /// [`Vibration::first_impact`](crate::Vibration::first_impact).
    pub fn find(map: &M, search: &AttractorSearch, observer: &dyn Observer) -> Result<Self, Error> {
        find::find(map, search, observer)
    }
}

impl ImpactMap {
    /// The attractors: [`Attractors::find`].
    ///
    /// # Errors
    /// Errors of [`Attractors::find`].
    pub fn attractors(&self, search: &AttractorSearch, observer: &dyn Observer) -> Result<Attractors, Error> {
        Attractors::find(self, search, observer)
    }
}

#[cfg(test)]
mod tests;
